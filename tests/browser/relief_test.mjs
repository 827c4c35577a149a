// SPDX-License-Identifier: MIT
// A bump must look raised on every shape, also where the image is mirrored: the flanks that face
// the light get brighter, the others darker.   node relief_test.mjs TEMPLATE [SCREENSHOT_DIR]
import assert from "node:assert/strict";
import path from "node:path";
import { PNG } from "pngjs";
import { drawn, executable, openPage, withBrowser } from "./browser.mjs";
import { suite } from "./suite.mjs";
import { encodeBlob, makeDocument } from "./synthetic.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const { page_of, test, done } = await suite(process.argv[2]);
const shots = process.argv[3];

/** A gray matte plate with one round bump in the middle (or the same plate, flat). */
function plate(bump) {
  const width = 96, height = 96, { doc } = makeDocument({ width, height, order: 0 });
  const blob = (values, channels) => encodeBlob(values, channels, width, height).blob;
  const gray = blob(new Array(width * height * 3).fill(0.6), 3);
  const tall = Array.from({ length: width * height }, (_, i) => {
    const x = (i % width) - 47.5, y = Math.floor(i / width) - 47.5;
    return 0.2 + 0.5 * Math.exp(-(x * x + y * y) / (2 * 14 * 14));
  });
  Object.assign(doc.trajectory, { base: gray, rate: gray });
  Object.assign(doc.material, { roughness_clean: 0.95, metallic_clean: 0, metallic_patina: 0,
    micro_roughness: 0, height_patina_weight: 0, normal_scale: bump ? 4 : 0 });
  return Object.assign(doc, { canvas: gray, luma_fill: blob(tall, 1), observed: [] });
}

/** Mean brightness of a patch; (x, y) from the middle of the picture, in shares of its height. */
function patch(png, x, y) {
  const r = Math.round(png.height * 0.03), cx = Math.round(png.width / 2 + x * png.height);
  const cy = Math.round(png.height / 2 + y * png.height);
  let sum = 0, n = 0;
  for (let j = cy - r; j <= cy + r; j++) for (let i = cx - r; i <= cx + r; i++, n++) {
    const at = (j * png.width + i) * 4;
    sum += (png.data[at] + png.data[at + 1] + png.data[at + 2]) / 3;
  }
  return sum / n;
}

const views = {
  "plane": { keys: ["p"], reach: 0.1 },
  "curved sheet": { keys: ["c"], reach: 0.08 },
  "sphere, front": { keys: ["s"], reach: 0.1 },
  // Half around: light and camera both behind, where the image is mirrored.
  "sphere, back": { keys: ["s"], behind: true, reach: 0.1 },
};

await withBrowser(async (context) => {
  const pictures = {};
  for (const kind of ["flat", "bump"]) {
    const { page } = await openPage(context, await page_of(plate(kind === "bump"), kind));
    for (const [name, { keys, behind }] of Object.entries(views)) {
      for (const key of keys) await page.keyboard.press(key);
      if (behind) {
        await page.locator("#light").fill("180");
        // 26 times ArrowRight on the picture, in one go: each press by itself waits for a picture.
        await page.locator("#view").evaluate((view) => {
          for (let i = 0; i < 26; i++) view.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
        });
      }
      await drawn(page);
      const shot = await page.locator("#view").screenshot(
        shots ? { path: path.join(shots, `relief_${kind}_${name.replace(/\W+/g, "_")}.png`) } : {});
      (pictures[name] ??= {})[kind] = PNG.sync.read(shot);
    }
    await page.close();
  }
  for (const [name, { reach }] of Object.entries(views)) {
    await test(`a bump looks raised: ${name}`, () => {
      const gain = (x, y) => patch(pictures[name].bump, x * reach, y * reach) - patch(pictures[name].flat, x * reach, y * reach);
      // The key light and the strongest boxes are above and to the left.
      const [above, below, left, right] = [gain(0, -1), gain(0, 1), gain(-1, 0), gain(1, 0)];
      assert.ok(above > below + 5, `top ${above.toFixed(1)}, bottom ${below.toFixed(1)}`);
      assert.ok(left > right + 5, `left ${left.toFixed(1)}, right ${right.toFixed(1)}`);
    });
  }
});
await done();
