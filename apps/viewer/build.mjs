// SPDX-License-Identifier: MIT
// Bundles src/ into one self-contained HTML template:  node build.mjs [OUTPUT]
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { mkdir, readFile, rename, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const output = path.resolve(process.argv[2] ?? path.join(here, "dist", "viewer.html"));

const bundle = await build({
  entryPoints: [path.join(here, "src", "main.ts")],
  bundle: true, minify: true, write: false, format: "iife", target: "es2022",
  legalComments: "none", charset: "ascii", logLevel: "warning",
});
const css = await build({
  entryPoints: [path.join(here, "src", "styles.css")],
  bundle: true, minify: true, write: false, logLevel: "warning",
});
const three = path.join(here, "node_modules/three");
const { version } = JSON.parse(await readFile(path.join(three, "package.json"), "utf8"));
const license = (await readFile(path.join(three, "LICENSE"), "utf8")).trim();
const banner = `<!-- Verdigris viewer, MIT license. Contains three.js ${version}:\n\n${license}\n-->`;
// "</script" inside the bundle would end the element; in JavaScript strings "<\/" is the same.
const script = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script");
const template = await readFile(path.join(here, "src", "index.html"), "utf8");
// The page's policy names these two texts: nothing else in it can run or style.
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
const style = css.outputFiles[0].text;
const parts = {
  "@@SCRIPT_HASH@@": hash(script), "@@STYLE_HASH@@": hash(style),
  "@@BANNER@@": banner, "@@STYLE@@": style, "@@SCRIPT@@": script,
};
let html = template;
for (const [token, text] of Object.entries(parts)) {
  if (html.split(token).length !== 2) throw new Error(`${token} must be in index.html exactly once`);
  html = html.replace(token, () => text);
}
if (html.split("@@VERDIGRIS_DATA@@").length !== 2) {
  throw new Error("@@VERDIGRIS_DATA@@ must be in the template exactly once");
}
await mkdir(path.dirname(output), { recursive: true });
await writeFile(output + ".tmp", html);
await rename(output + ".tmp", output);
console.log(`${output}: ${(html.length / 1024).toFixed(0)} KiB`);
