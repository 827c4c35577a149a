// SPDX-License-Identifier: MIT
// The viewer of a real run against the maps that C++ wrote:
//   node compare_with_maps.mjs OUT [SCREENSHOT_DIR]
import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import path from "node:path";
import { PNG } from "pngjs";
import { drawn, executable, openPage, readMaps, withBrowser } from "./browser.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const [out, shots] = process.argv.slice(2);
const label = (h) => "u" + (Number.isInteger(h) ? String(h).padStart(3, "0")
  : String(Math.floor(h)).padStart(3, "0") + "_" + Math.round((h % 1) * 10));
const load = async (file) => PNG.sync.read(await readFile(file), { skipRescale: true });
const find = async (folder, suffix) => {
  const name = (await readdir(folder)).find((f) => f.endsWith(suffix));
  assert.ok(name, `no ${suffix} in ${folder}`);
  return path.join(folder, name);
};

/** Mean and largest difference over the channels of a PNG, in units of full scale. */
function compare(got, png, channels) {
  const full = png.depth === 16 ? 65535 : 255;
  let sum = 0, worst = 0;
  for (let i = 0; i < png.width * png.height; i++) {
    for (const [k, from] of channels.entries()) {
      const value = got.channels === 3 ? got.data[i * 3 + k] : got.data[i];
      const d = Math.abs(Math.min(Math.max(value, 0), 1) - png.data[i * 4 + from] / full);
      sum += d;
      worst = Math.max(worst, d);
    }
  }
  return { mean: sum / (png.width * png.height * channels.length), worst };
}

await withBrowser(async (context) => {
  const { page, complaints, requests } = await openPage(context, path.join(out, "viewer.html"),
    { stage: Boolean(shots) });
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, []);
  assert.equal(await page.locator("#fault").isVisible(), false, await page.locator("#fault").textContent());
  const info = await page.evaluate(() => ({ width: window.verdigris.info.width,
    height: window.verdigris.info.height, horizons: window.verdigris.info.horizons,
    uncertainty: window.verdigris.info.uncertainty }));
  let compared = 0;
  for (const horizon of [0, ...info.horizons]) {
    const packs = await readdir(path.join(out, "textures"));
    const pack = packs.find((p) => p.endsWith("_" + label(horizon)));
    assert.ok(pack, `no texture pack for ${label(horizon)} among ${packs}`);
    const folder = path.join(out, "textures", pack);
    const maps = await readMaps(page, horizon, ["albedo", "roughness", "metallic", "normal", "coverage"]);
    for (const [map, suffix, channels] of [["albedo", "_Color.png", [0, 1, 2]], ["roughness", "_Roughness.png", [0]],
      ["metallic", "_Metalness.png", [0]], ["normal", "_NormalGL.png", [0, 1, 2]]]) {
      const png = await load(await find(folder, suffix));
      const got = maps[map];
      if (got.width !== png.width || got.height !== png.height) {
        console.log(`skipped ${map}: the viewer's copy is reduced (${got.width}x${got.height})`);
        continue;
      }
      if (map === "normal") got.data = got.data.map((v) => v * 0.5 + 0.5);
      const { mean, worst } = compare(got, png, channels);
      console.log(`+${horizon} ${map}: mean ${(mean * 255).toFixed(3)}/255, worst ${(worst * 255).toFixed(2)}/255`);
      assert.ok(mean < 1 / 255 && worst < 3 / 255, `${map} at +${horizon} disagrees`);
      compared++;
    }
    if (horizon > 0) {
      const png = await load(path.join(out, "material", `coverage_${label(horizon)}.png`));
      const got = maps.coverage;
      if (got.width === png.width) {
        const { mean, worst } = compare(got, png, [0]);
        console.log(`+${horizon} coverage: mean ${(mean * 255).toFixed(3)}/255, worst ${(worst * 255).toFixed(2)}/255`);
        assert.ok(mean < 0.5 / 255 && worst < 3 / 255, `coverage at +${horizon} disagrees`);
        compared++;
      }
    }
  }
  assert.ok(compared > 0, "nothing was compared");
  // What C++ says of all pixels in numbers is the root mean square of what the shader says of each.
  for (const { horizon, pixel_80 } of info.uncertainty ?? []) {
    const { uncertainty } = await readMaps(page, horizon, ["uncertainty"]);
    const moving = uncertainty.data.filter((v) => v > 0);
    const got = 255 * Math.sqrt(moving.reduce((s, v) => s + v * v, 0) / moving.length);
    console.log(`+${horizon} half width: ${got.toFixed(3)}/255 of ${moving.length} pixels, told ${(255 * pixel_80).toFixed(3)}/255`);
    assert.ok(Math.abs(got - 255 * pixel_80) < 0.02, `the half widths at +${horizon} disagree`);
  }
  if (shots) {
    const last = info.horizons[info.horizons.length - 1];
    const shoot = async (name) => { await drawn(page); await page.screenshot({ path: path.join(shots, name) }); };
    await page.evaluate(() => window.verdigris.setAge(0));
    await shoot("sphere_observed.png");
    await page.evaluate((h) => window.verdigris.setAge(h), last);
    await shoot("sphere_last.png");
    for (const key of ["p", "c", "w", "3", "7"]) {
      await page.keyboard.press(key);
      await shoot(`key_${key}.png`);
    }
  }
});
