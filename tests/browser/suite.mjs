// SPDX-License-Identifier: MIT
// A list of named checks on pages made from one template; says which failed.
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";

export async function suite(templateFile) {
  const template = await readFile(templateFile, "utf8");
  const folder = await mkdtemp(path.join(tmpdir(), "verdigris-viewer-"));
  let failures = 0;
  return {
    /** The page of a document, as deliver/ writes it. */
    async page_of(doc, name) {
      const file = path.join(folder, `${name}.html`);
      const json = JSON.stringify(doc).replaceAll("<", "\\u003c");
      await writeFile(file, template.replace("@@VERDIGRIS_DATA@@", () => json));
      return file;
    },
    async test(name, work) {
      const start = performance.now(), took = () => `(${((performance.now() - start) / 1000).toFixed(1)} s)`;
      try {
        await work();
        console.log(`ok    ${name} ${took()}`);
      } catch (error) {
        failures++;
        console.log(`FAIL  ${name} ${took()}\n      ${error.message}`);
      }
    },
    async done() {
      await rm(folder, { recursive: true, force: true });
      if (failures) { console.log(`${failures} failures`); process.exit(1); }
    },
  };
}
