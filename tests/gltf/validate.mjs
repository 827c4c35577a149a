// SPDX-License-Identifier: MIT
// node validate.mjs a.glb b.glb ...: Khronos' glTF validator on each file. Any error or warning
// fails (status 1); infos and hints are listed. Needs `npm ci` in this folder, no network after.
import {readFile} from 'node:fs/promises';
import {validateBytes} from 'gltf-validator';

const severities = ['error', 'warning', 'info', 'hint'];
const paths = process.argv.slice(2);
if (paths.length === 0) {
  console.error('usage: node validate.mjs FILE.glb ...');
  process.exit(2);
}

let failed = false;
for (const path of paths) {
  let report;
  try {
    report = await validateBytes(new Uint8Array(await readFile(path)), {uri: path, maxIssues: 100});
  } catch (error) {
    console.error(`${path}: ${error.message ?? error}`);
    failed = true;
    continue;
  }
  const {numErrors, numWarnings, numInfos, numHints, messages} = report.issues;
  for (const {severity, code, pointer, message} of messages) {
    console.log(`${path}: ${severities[severity]} ${code} at ${pointer ?? '(file)'}: ${message}`);
  }
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ` +
              `${numHints} hints`);
  failed ||= numErrors > 0 || numWarnings > 0;
}
process.exit(failed ? 1 : 0);
