// SPDX-License-Identifier: MIT
// How far off each pixel may be, in a real browser:  node uncertainty_test.mjs TEMPLATE [SCREENSHOT_DIR]
import assert from "node:assert/strict";
import path from "node:path";
import { PNG } from "pngjs";
import { drawn, executable, openPage, readMap, readMaps, withBrowser } from "./browser.mjs";
import { suite } from "./suite.mjs";
import { encodeBlob, makeDocument, random } from "./synthetic.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const shots = process.argv[3];
const { page_of, test, done } = await suite(process.argv[2]);

/** A document that says how far off it may be. `even`: every pixel that moves has the same share. */
function unsure({ even = false, ...options } = {}) {
  const made = makeDocument(options), { width, height } = made.doc, next = random(3);
  const roots = made.truth.active.map((a) => (a === 0 ? 0 : even ? 1 : 0.5 + 4 * next() ** 3));
  const own = encodeBlob(roots, 1, width, height);
  own.decoded = own.decoded.map((v, i) => { assert.equal(v > 0, roots[i] > 0); return v; });
  const code = 1 / 255;
  made.doc.spread = { common: [0.4, 1.5, 0.8], full_codes: 12, own: own.blob,
    nodes: [[1, (0.2 * code) ** 2, (1 * code) ** 2], [8, (2 * code) ** 2, (1.5 * code) ** 2], [20, (5 * code) ** 2, (3 * code) ** 2]] };
  made.doc.uncertainty = [{ horizon: 20, mean_80: 0.025, mean_95: 0.04, pixel_80: 0.03, pixel_95: 0.05 }];
  made.truth.roots = own.decoded;
  return made;
}

/** docs/VIEWER_DATA.md in doubles, channel by channel as the C++ has it. */
function halfWidth({ doc: { spread }, truth }, i, age) {
  if (age <= 0 || truth.roots[i] === 0) return 0;
  const nodes = [[0, 0, 0], ...spread.nodes], last = nodes.at(-1);
  const after = nodes.findIndex((n) => n[0] >= age);
  const at = (k) => {
    if (after < 0) return last[k];
    const [a, b] = [nodes[after - 1], nodes[after]];
    return a[k] + ((age - a[0]) / (b[0] - a[0])) * (b[k] - a[k]);
  };
  const squares = spread.common.map((c) => at(1) * c + at(2) * truth.roots[i] ** 2);
  return 1.1432148684060779 * Math.sqrt(squares.reduce((s, v) => s + v) / 3);
}

/** The color of the stage's picture at a share of its width and height. */
async function colorAt(page, x, y) {
  const png = PNG.sync.read(await page.locator("#stage").screenshot());
  const i = (Math.round(y * png.height) * png.width + Math.round(x * png.width)) * 4;
  return [...png.data.subarray(i, i + 3)];
}

await withBrowser(async (context) => {
  const open = async (made, name, view = {}) => ({ made, ...(await openPage(context, await page_of(made.doc, name), view)) });
  const button = (page, name) => page.getByRole("button", { name, exact: true });
  const setAge = (page, age) => page.evaluate((a) => window.verdigris.setAge(a), age);

  for (const [name, options] of [["law", {}], ["frames", { kind: "frames" }], ["even", { even: true, width: 12, height: 51 }]]) {
    await test(`half widths agree with the equations: ${name}`, async () => {
      const { page, made, complaints } = await open(unsure(options), `agree_${name}`, { stage: false });
      assert.equal(await page.locator("#fault").isVisible(), false);
      for (const age of [-4, 0, 0.3, 1, 5, 12.3, 20]) {
        const got = await readMap(page, age, "uncertainty");
        assert.equal(got.channels, 1);
        assert.equal(got.data.length, made.doc.width * made.doc.height);
        got.data.forEach((v, i) => {
          const expected = halfWidth(made, i, age);
          assert.ok(Math.abs(v - expected) < 2e-6, `pixel ${i} at ${age}: ${v}, not ${expected}`);
        });
        assert.equal(Math.max(...got.data) > 0, age > 0);
      }
      assert.deepEqual(complaints, []);
      await page.close();
    });
  }

  await test("no spread: no button, no key, no word of it", async () => {
    for (const spread of [undefined, null]) {
      const { doc } = makeDocument({});
      const { page, complaints } = await openPage(context, await page_of({ ...doc, spread }, "none"), { stage: false });
      assert.equal(await button(page, "Uncertainty").count(), 0);
      assert.equal(await page.locator("#over-toggle").isVisible(), false);
      await page.keyboard.press("7");
      for (const key of ["8", "u", "9", "0"]) await page.keyboard.press(key);
      assert.equal(await button(page, "Coverage").getAttribute("aria-pressed"), "true");
      assert.equal(await page.locator("#over-toggle").getAttribute("aria-pressed"), "false");
      assert.doesNotMatch(await page.locator("#help").textContent(), /uncertainty/i);
      assert.match(await page.locator("#help").textContent(), /1 \u2026 7/);
      assert.equal(await page.evaluate(() => {
        try { window.verdigris.readMap("uncertainty"); return "read"; } catch (e) { return e.message; }
      }), "This forecast does not say how far off it may be.");
      assert.deepEqual(complaints, []);
      await page.close();
    }
  });

  // One page with a stage for the rest: lighting it takes seconds in software.
  const { page, made, complaints } = await open(unsure({ even: true, width: 64, height: 48 }), "shown");
  const canvas = page.locator("#view"), legend = page.locator("#legend");

  await test("key 8 shows the map in the colors of its legend", async () => {
    // An age at which every pixel that moves is at 128 of 255: there magma is #b73779 (Matplotlib).
    let low = 0, high = 20;
    while (high - low > 1e-9) {
      const middle = (low + high) / 2, i = made.truth.roots.findIndex((r) => r > 0);
      if (halfWidth(made, i, middle) < (12 / 255) * (128 / 255)) low = middle; else high = middle;
    }
    await setAge(page, low);
    await page.keyboard.press("8");
    await drawn(page);
    assert.equal(await button(page, "Uncertainty").getAttribute("aria-pressed"), "true");
    assert.equal(await button(page, "Uncertainty").getAttribute("aria-keyshortcuts"), "8");
    await page.waitForFunction(() => document.getElementById("live").textContent === "uncertainty map");
    assert.deepEqual(await page.locator("#legend span:visible").allTextContents(), ["0", "", "12 codes of 255 or more",
      "Nominally 4 times in 5 a pixel is off by at most this (root mean square of R, G, B). Gray: held."]);
    assert.match(await page.locator("#legend-bar").evaluate((e) => getComputedStyle(e).backgroundImage),
      /rgb\(0, 0, 4\).*rgb\(183, 55, 121\).*rgb\(252, 253, 191\)/);
    const near = (got, expected) => got.every((v, k) => Math.abs(v - expected[k]) <= 3);
    const middle = await colorAt(page, 0.5, 0.5);
    assert.ok(near(middle, [183, 55, 121]), `the middle is ${middle}`);
    await setAge(page, low / 4);   // the scale stays: what is less far off is darker
    await drawn(page);
    const earlier = await colorAt(page, 0.5, 0.5);
    const sum = (c) => c[0] + c[1] + c[2];
    assert.ok(sum(earlier) < sum(middle) - 30, `${earlier} is not darker than ${middle}`);
    await setAge(page, -3);
    await drawn(page);
    assert.ok(near(await colorAt(page, 0.5, 0.5), [0, 0, 4]));
    assert.match(await legend.textContent(), /Observed: nothing is forecast/);
    // The backdrop at the left border of the map: gray, at any age.
    const png = PNG.sync.read(await page.locator("#stage").screenshot()), row = Math.round(png.height / 2) * png.width;
    const grays = Array.from({ length: png.width }, (_, x) => [...png.data.subarray((row + x) * 4, (row + x) * 4 + 3)])
      .filter((c) => near(c, [51, 54, 57])).length;
    assert.ok(grays > 8, `${grays} gray pixels across the backdrop`);
    assert.deepEqual(complaints, []);
  });

  await test("key U lays it over lit material and albedo, and takes it off again", async () => {
    await page.keyboard.press("4");
    await setAge(page, 20);
    const toggle = page.getByRole("button", { name: "Overlay of the uncertainty" });
    const pressed = () => toggle.getAttribute("aria-pressed");
    assert.equal(await pressed(), "false");
    await page.keyboard.press("u");   // on a map that cannot carry it: the lit material
    assert.equal(await pressed(), "true");
    assert.equal(await button(page, "Lit").getAttribute("aria-pressed"), "true");
    assert.match(await legend.textContent(), /12 codes of 255 or more.*Unpainted: surest, or held/);
    await page.waitForFunction(() => document.getElementById("live").textContent === "uncertainty over the material");
    // The mean color of the middle: the picture gives way to the legend, so pixels cannot be compared.
    const look = async (age) => {
      await setAge(page, age);
      await drawn(page);
      const { width, height, data } = PNG.sync.read(await canvas.screenshot()), mean = [0, 0, 0];
      const [dx, dy] = [Math.round(width / 16), Math.round(height / 8)], n = 4 * dx * dy;
      for (let y = height / 2 - dy; y < height / 2 + dy; y++) for (let x = width / 2 - dx; x < width / 2 + dx; x++) {
        for (let k = 0; k < 3; k++) mean[k] += data[(Math.floor(y) * width + Math.floor(x)) * 4 + k] / n;
      }
      return mean;
    };
    const apart = (a, b) => Math.max(...a.map((v, k) => Math.abs(v - b[k])));
    for (const view of ["1", "2"]) {
      await page.keyboard.press(view);
      if (await pressed() !== "true") await toggle.click();
      const under = await readMaps(page, 20, ["albedo", "roughness"]);
      const over = [await look(20), await look(0)];
      await page.evaluate(() => document.activeElement.blur());
      await page.keyboard.press("u");
      assert.equal(await pressed(), "false");
      assert.equal(await legend.isVisible(), view === "2");
      const bare = [await look(20), await look(0)];
      assert.ok(apart(over[0], bare[0]) > 25, `the overlay changes nothing: ${over[0]} over ${bare[0]}`);
      // A smaller sphere mirrors something else: only flat can this be compared.
      if (view === "2") assert.ok(apart(over[1], bare[1]) < 12, `what was observed is painted over: ${over[1]} over ${bare[1]}`);
      // What is looked at is no map: those stay as they are.
      const maps = await readMaps(page, 20, ["albedo", "roughness"]);
      for (const name of ["albedo", "roughness"]) assert.deepEqual(maps[name].data, under[name].data);
    }
    assert.deepEqual(complaints, []);
  });

  await test("the legend stands on the stage, off the picture and off the labels, at any width", async () => {
    await setAge(page, 20);
    for (const [width, height] of [[1280, 800], [1000, 640], [760, 560], [390, 844], [320, 700]]) {
      await page.setViewportSize({ width, height });
      for (const keys of [["8"], ["1", "u"], ["w"], ["8"]]) {   // the map, the overlay, with the wipe, the map with it
        for (const key of keys) await page.keyboard.press(key);
        await drawn(page);
        const at = `${width} wide after ${keys}`;
        const stage = await page.locator("#stage").boundingBox(), box = await legend.boundingBox();
        assert.ok(box.x >= stage.x && box.x + box.width <= stage.x + stage.width && box.y >= stage.y &&
          box.y + box.height <= stage.y + stage.height, `the legend leaves the stage, ${at}`);
        const cut = await legend.evaluate((e) => [...e.querySelectorAll("span")].filter((s) => s.scrollWidth > s.clientWidth + 1 && s.clientWidth > 0).length);
        assert.equal(cut, 0, `a label is cut, ${at}`);
        for (const label of ["#wipe-left", "#wipe-right", "#badge"]) {
          const other = await page.locator(label).boundingBox();
          if (!other) continue;
          assert.ok(other.x + other.width <= box.x || box.x + box.width <= other.x || other.y + other.height <= box.y ||
            box.y + box.height <= other.y, `the legend lies on ${label}, ${at}`);
        }
        const above = await colorAt(page, 0.42, (box.y - stage.y - 3) / stage.height);   // beside the border of the wipe
        assert.ok(Math.max(...above) - Math.min(...above) < 40, `the picture (${above}) reaches under the legend, ${at}`);
        if (shots) await page.screenshot({ path: path.join(shots, `unsure_${width}_${keys.join("")}_${await page.locator("#wipe-toggle").getAttribute("aria-pressed")}.png`) });
      }
      await page.keyboard.press("w");
      await page.keyboard.press("u");
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(overflow <= 0, `${overflow} pixels wider than the screen at ${width}`);
    }
    assert.deepEqual(complaints, []);
  });
});
await done();
