// SPDX-License-Identifier: MIT
// aged.glb through three.js' loader: the right map in the right slot, the right way up.
//   node gltf_loads.mjs OUT
import assert from "node:assert/strict";
import { mkdtemp, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { PNG } from "pngjs";
import { executable, withBrowser } from "./browser.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const out = process.argv[2];
const here = path.dirname(fileURLToPath(import.meta.url));
const bundle = await build({ entryPoints: [path.join(here, "gltf_page.ts")], bundle: true,
  write: false, format: "iife", logLevel: "warning" });
const folder = await mkdtemp(path.join(tmpdir(), "verdigris-gltf-"));
const file = path.join(folder, "page.html");
const code = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script");
await writeFile(file, `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script>${code}</script>`);

const pack = (await readdir(path.join(out, "textures"))).find((p) => p.endsWith("_u000"));
const load = async (suffix) => {
  const dir = path.join(out, "textures", pack);
  const name = (await readdir(dir)).find((f) => f.endsWith(suffix));
  return PNG.sync.read(await readFile(path.join(dir, name)));
};
const worst = (got, png, channel, from = channel) => {
  let w = 0;
  for (let i = 0; i < png.width * png.height; i++) {
    w = Math.max(w, Math.abs(got[i * 4 + channel] - png.data[i * 4 + from]));
  }
  return w;
};

await withBrowser(async (context) => {
  const page = await context.newPage();
  const errors = [];
  page.on("pageerror", (e) => errors.push(e.message));
  page.on("console", (m) => { if (m.type() === "error") errors.push(m.text()); });
  await page.goto(`file://${file}`);
  const glb = (await readFile(path.join(out, "aged.glb"))).toString("base64");
  const got = await page.evaluate((b) => window.load(b), glb);
  assert.deepEqual(errors, []);
  const color = await load("_Color.png"), rough = await load("_Roughness.png");
  const metal = await load("_Metalness.png"), normal = await load("_NormalGL.png");
  assert.deepEqual([got.width, got.height], [color.width, color.height]);
  assert.equal(got.colorSpace, "srgb");
  assert.equal(got.flipped, false);
  assert.equal(got.sameOrm, true);
  assert.deepEqual(got.factors, [1, 1]);
  assert.equal(got.tangents, true);
  for (const k of [0, 1, 2]) {
    assert.ok(worst(got.color, color, k) <= 1, `color channel ${k}`);
    assert.ok(worst(got.normal, normal, k) <= 1, `normal channel ${k}`);
  }
  assert.ok(worst(got.orm, rough, 1, 0) <= 1, "roughness is not in green");
  assert.ok(worst(got.orm, metal, 2, 0) <= 1, "metallic is not in blue");
  assert.ok(got.orm.every((v, i) => i % 4 !== 0 || v === 255), "red is not full occlusion");
  // glTF: the texture's first row is at the top, so v = 0 where y is largest.
  assert.equal(got.corners.length, 4);
  for (const { y, v } of got.corners) assert.equal(v, y > 0 ? 0 : 1);
  assert.ok(got.variants.length >= 2 && got.materials === got.variants.length, `variants: ${got.variants}`);
  console.log(`${got.variants.length} variants: ${got.variants.join(" | ")}`);
});
await rm(folder, { recursive: true, force: true });
