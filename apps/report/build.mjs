// SPDX-License-Identifier: MIT
// Bundles src/ into one self-contained HTML template:  node build.mjs [OUTPUT]
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdir, readFile, readdir, rename, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const output = path.resolve(process.argv[2] ?? path.join(here, "dist", "report.html"));

const bundle = await build({
  entryPoints: [path.join(here, "src", "main.ts")],
  bundle: true, minify: true, write: false, format: "iife", target: "es2022", metafile: true,
  legalComments: "none", charset: "ascii", logLevel: "warning", absWorkingDir: here,
});
const css = await build({
  entryPoints: [path.join(here, "src", "styles.css")],
  bundle: true, minify: true, write: false, logLevel: "warning",
});

/** The licenses of what is in the bundle: each text once, with the packages that it covers. */
async function licenses(inputs) {
  const folders = new Set(Object.keys(inputs)
    .map((file) => /^node_modules\/(@[^/]+\/)?[^/]+/.exec(file)?.[0]).filter(Boolean));
  const byText = new Map();
  for (const folder of [...folders].sort()) {
    const root = path.join(here, folder);
    const { name, version, license } = JSON.parse(await readFile(path.join(root, "package.json"), "utf8"));
    const file = (await readdir(root)).find((f) => /^licen[cs]e/i.test(f));
    // Packages of Vega's own repository ship without the file: theirs is Vega's.
    const fallback = path.join(here, "node_modules", "vega", "LICENSE");
    const from = file ? path.join(root, file) : license === "BSD-3-Clause" && name.startsWith("vega") ? fallback : "";
    if (!from || !existsSync(from)) throw new Error(`${name} ships no license`);
    const text = (await readFile(from, "utf8")).trim();
    byText.set(text, [...(byText.get(text) ?? []), `${name} ${version}`]);
  }
  return [...byText].map(([text, names]) => `${names.join(", ")}:\n\n${text}`).join("\n\n----\n\n");
}
const contained = (await licenses(bundle.metafile.inputs)).replaceAll("--", "- -");
const banner = `<!-- Verdigris report, MIT license. Contains\n\n${contained}\n-->`;
// "</script" inside the bundle would end the element; in JavaScript strings "<\/" is the same.
const script = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script");
const style = css.outputFiles[0].text;
// The page's policy names these two texts: nothing else in it can run or style.
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
const policy = `default-src 'none'; script-src '${hash(script)}'; style-src '${hash(style)}'; ` +
  "img-src data:; base-uri 'none'; form-action 'none'";
const parts = { "@@BANNER@@": banner, "@@POLICY@@": policy, "@@STYLE@@": style, "@@SCRIPT@@": script };
let html = await readFile(path.join(here, "src", "index.html"), "utf8");
for (const [token, text] of Object.entries(parts)) {
  if (html.split(token).length !== 2) throw new Error(`${token} must be in index.html exactly once`);
  html = html.replace(token, () => text);
}
for (const token of ["@@VERDIGRIS_TITLE@@", "@@VERDIGRIS_BODY@@", "@@VERDIGRIS_DATA@@"]) {
  if (html.split(token).length !== 2) throw new Error(`${token} must be in the template exactly once`);
}
await mkdir(path.dirname(output), { recursive: true });
await writeFile(output + ".tmp", html);
await rename(output + ".tmp", output);
console.log(`${output}: ${(html.length / 1024).toFixed(0)} KiB`);
