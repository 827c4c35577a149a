// SPDX-License-Identifier: MIT
// A picture by three.js in headless Chromium (scripts/render_comparison.sh).
//   node render_three.mjs MAPS model.glb sky.exr SIZE out.png
import { mkdtemp, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { executable, withBrowser } from "./browser.mjs";

if (!executable) {
  console.error("no Chromium found (set VERDIGRIS_CHROMIUM): three.js is left out");
  process.exit(77);
}
const [maps, glb, sky, size, out] = process.argv.slice(2);
const here = path.dirname(fileURLToPath(import.meta.url));
const bundle = await build({ entryPoints: [path.join(here, "render_page.ts")], bundle: true,
  write: false, format: "iife", logLevel: "warning" });
const folder = await mkdtemp(path.join(tmpdir(), "verdigris-render-"));
const code = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script");
await writeFile(path.join(folder, "page.html"), `<!doctype html><meta charset="utf-8"><script>${code}</script>`);
const base64 = async (file) => (await readFile(file)).toString("base64");
const map = async (ending) =>
  base64(path.join(maps, (await readdir(maps)).find((f) => f.endsWith(ending))));
try {
  await withBrowser(async (context) => {
    const page = await context.newPage();
    page.on("pageerror", (e) => { throw e; });
    await page.goto(`file://${path.join(folder, "page.html")}`);
    const url = await page.evaluate((given) => window.draw(given), { glb: await base64(glb),
      sky: await base64(sky), color: await map("_Color.png"), normal: await map("_NormalGL.png"),
      orm: await map("_ORM.png"), size: Number(size) });
    await writeFile(out, Buffer.from(url.split(",")[1], "base64"));
  });
} finally {
  await rm(folder, { recursive: true, force: true });
}
