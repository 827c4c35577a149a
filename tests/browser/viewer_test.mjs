// SPDX-License-Identifier: MIT
// The viewer in a real browser, on made documents:  node viewer_test.mjs TEMPLATE [SCREENSHOT_DIR]
import assert from "node:assert/strict";
import path from "node:path";
import { PNG } from "pngjs";
import { drawn, executable, openPage, readMap, readMaps, withBrowser } from "./browser.mjs";
import { suite } from "./suite.mjs";
import { makeDocument, reference } from "./synthetic.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const shots = process.argv[3];

/** Share of the pixels that differ: the browser may draw the rim of a badge twice in two ways. */
function unlike(one, other) {
  const [a, b] = [one, other].map((shot) => PNG.sync.read(shot).data);
  let differing = 0;
  for (let i = 0; i < a.length; i += 4) {
    if ([0, 1, 2].some((k) => Math.abs(a[i + k] - b[i + k]) > 8)) differing++;
  }
  return differing / (a.length / 4);
}
const { page_of, test, done } = await suite(process.argv[2]);

await withBrowser(async (context) => {
  const open = async (options, name, view = {}) => {
    const made = makeDocument(options);
    return { made, ...(await openPage(context, await page_of(made.doc, name), view)) };
  };
  const names = ["albedo", "coverage", "height", "roughness", "metallic", "normal"];

  // One page with a stage for all that is done to a page: lighting it takes seconds in software.
  const shown = await open({ width: 64, height: 48 }, "shown");
  const page_at_rest = async () => {
    const { page } = shown;
    await page.setViewportSize({ width: 760, height: 560 });
    if (await page.locator("#wipe-toggle").getAttribute("aria-pressed") === "true") await page.keyboard.press("w");
    await page.keyboard.press("s");
    await page.evaluate(() => {
      document.activeElement.blur();
      window.verdigris.setAge(0);
    });
    await drawn(page);
    return shown;
  };

  const cases = [["not smoothed", { order: 1, material: { height_sigma: 0, micro_sigma: 0 } }],
    ["linear", { order: 1 }], ["linear unclamped", { order: 1, clamp: false }],
    ["accelerating", { order: 2 }], ["held", { order: 0 }], ["tall", { order: 1, width: 12, height: 51 }],
    ["accelerating unclamped", { order: 2, clamp: false }], ["stack of frames", { kind: "frames" }]];
  for (const [name, options] of cases) {
    await test(`maps agree with the equations: ${name}`, async () => {
      const { page, made, complaints, requests } =
        await open(options, name.replaceAll(" ", "_"), { stage: false });
      assert.equal(await page.locator("#fault").isVisible(), false);
      for (const age of [0, 0.7, 5, 12.3, 20]) {
        const truth = reference(made, age), maps = await readMaps(page, age, names);
        for (const map of names) {
          const got = maps[map];
          assert.equal(got.width, made.doc.width);
          assert.equal(got.data.length, truth[map].length);
          const worst = got.data.reduce((w, v, i) => Math.max(w, Math.abs(v - truth[map][i])), 0);
          assert.ok(worst < 1e-3 && !got.data.some(Number.isNaN), `${map} at +${age}: off by ${worst}`);
          if (map === "coverage" && age === 20 && options.order !== 0) {
            assert.ok(Math.max(...got.data) > 0.2, "the made case covers nothing: it tests nothing");
          }
          if (map === "coverage" && age === 0) assert.equal(Math.max(...got.data), 0);
        }
      }
      if (options.kind === "frames") {   // the other kind is drawn by the tests of the controls
        await page.setViewportSize({ width: 400, height: 400 });
        await drawn(page);
      }
      assert.deepEqual(complaints, []);
      assert.deepEqual(requests, []);
      await page.close();
    });
  }

  await test("observed ages crossfade and carry no coverage", async () => {
    const { page, made } = await open({}, "observed", { stage: false });
    const { albedo: half, coverage } = await readMaps(page, -4, ["albedo", "coverage"]);
    const older = made.truth.base.map((v, i) => Math.min(Math.max(v - 8 * made.truth.rate[i], 0), 1));
    const expected = made.truth.base.map((v, i) => (v + older[i]) / 2);
    const worst = half.data.reduce((w, v, i) => Math.max(w, Math.abs(v - expected[i])), 0);
    assert.ok(worst < 3 / 255, `off by ${worst}`);
    assert.equal(Math.max(...coverage.data), 0);
    await page.close();
  });

  await test("counted from the start, observed ages carry coverage by the same equation", async () => {
    const made = makeDocument({});
    made.doc.material.observed_is_clean = false;
    const { page } = await openPage(context, await page_of(made.doc, "from_start"), { stage: false });
    const maps = await readMaps(page, -6, ["albedo", "coverage"]);
    const albedo = maps.albedo.data, coverage = maps.coverage.data;
    const m = made.doc.material, t = made.truth;
    const worst = coverage.reduce((w, p, i) => {
      const change = [0, 1, 2].reduce((s, k) => s + Math.abs(albedo[i * 3 + k] - t.canvas[i * 3 + k]), 0) / 3;
      const expected = t.active[i] > 0.75 ? Math.min(Math.max((change - t.zone[i]) / m.normalizer, 0), 1) ** m.coverage_exponent : 0;
      return Math.max(w, Math.abs(p - expected));
    }, 0);
    assert.ok(Math.max(...coverage) > 0.05, "nothing is covered: it tests nothing");
    assert.ok(worst < 1e-3, `off by ${worst}`);
    await page.close();
  });

  await test("the slider changes the picture, by mouse, keyboard and ticks", async () => {
    const { page, complaints } = await page_at_rest();
    const canvas = page.locator("#view");
    const slider = page.getByRole("slider", { name: "Age in accelerated units" });
    const before = await canvas.screenshot();
    assert.match(await slider.getAttribute("aria-valuetext"), /last observed frame/);
    await slider.focus();
    await page.keyboard.press("End");
    assert.match(await slider.getAttribute("aria-valuetext"), /forecast, \+20\.0 accelerated units/);
    await drawn(page);
    assert.ok(!before.equals(await canvas.screenshot()), "the picture did not change");
    await page.getByRole("button", { name: "Go to the forecast at +10 units" }).click();
    assert.match(await page.locator("#readout").textContent(), /\+10\.0/);
    await page.keyboard.press("Home");
    assert.match(await slider.getAttribute("aria-valuetext"), /observed, 8\.0 units before/);
    await page.keyboard.press("ArrowRight");
    assert.match(await slider.getAttribute("aria-valuetext"), /7\.5 units before/);
    await page.evaluate(() => window.verdigris.setAge(12.34));
    assert.equal(await page.evaluate(() => window.verdigris.age), 12.34);
    assert.doesNotMatch(await page.locator("body").innerText(), /\b(years?|months?|days?)\b/i);
    assert.deepEqual(complaints, []);
  });

  await test("a long recording does not squeeze the forecast: the axis breaks at now, in units", async () => {
    const made = makeDocument({});
    made.doc.observed[0].unit = -100;
    const { page, complaints } = await openPage(context, await page_of(made.doc, "long"), { stage: false });
    const slider = page.locator("#slider");
    await slider.scrollIntoViewIfNeeded();
    const box = await slider.boundingBox();
    const width = async (zone) => (await page.locator(`#zones .${zone}`).boundingBox())?.width ?? 0;
    const ahead = await width("forecast");
    assert.ok(ahead >= 0.69 * (ahead + await width("observed")), `the forecast has ${ahead} of ${box.width}`);
    assert.equal(await page.locator("#zones .break").count(), 1);
    assert.match(await page.locator("#zones .observed").textContent(), /tighter scale/);
    assert.match(await page.locator("#panel").textContent(), /scale changes at now/);
    const ticks = await page.locator("#ticks button").allTextContents();
    for (const label of ["\u2212100", "\u221250", "now", "+5", "+10", "+20"]) assert.ok(ticks.includes(label), `${label} in ${ticks}`);
    // By mouse: the thumb's center runs from half a thumb to the width less half a thumb.
    const go = (share) => page.mouse.click(box.x + 10 + (box.width - 20) * share, box.y + box.height / 2);
    const age = () => page.evaluate(() => window.verdigris.age);
    const unitsPerPixel = [100 / 0.3 / (box.width - 20), 20 / 0.7 / (box.width - 20)];
    for (const [share, expected, k] of [[0.15, -50, 0], [0.65, 10, 1], [0.3, 0, 0]]) {
      await go(share);
      const got = await age();
      assert.ok(Math.abs(got - expected) <= 1.1 * unitsPerPixel[k], `${got} at ${share}, not ${expected}`);
      assert.match(await slider.getAttribute("aria-valuetext"), expected < -1 ? /observed, [45]\d\.\d units before/ : /forecast|observed/);
    }
    // By keyboard: the same half unit on both sides, by fives with the page keys.
    await page.evaluate(() => window.verdigris.setAge(-0.5));
    await slider.focus();
    for (const [key, to] of [["ArrowRight", 0], ["ArrowUp", 0.5], ["ArrowLeft", 0], ["ArrowDown", -0.5], ["PageUp", 0],
      ["PageUp", 5], ["PageDown", 0], ["Shift+ArrowLeft", -5], ["Home", -100], ["End", 20]]) {
      await page.keyboard.press(key);
      assert.equal(await age(), to, key);
    }
    assert.deepEqual(complaints, []);
    await page.close();
  });

  await test("an axis with nothing observed, or nothing delivered, still works", async () => {
    for (const [change, first, last] of [[{ observed: [] }, 0, 20], [{ horizons: [] }, -8, 1],
      [{ observed: [], horizons: [] }, 0, 1]]) {
      const { doc } = makeDocument({});
      const { page, complaints } = await openPage(context, await page_of({ ...doc, ...change }, "bare"), { stage: false });
      assert.equal(await page.locator("#fault").isVisible(), false);
      for (const [key, to] of [["Home", first], ["End", last]]) {
        await page.keyboard.press(key);
        assert.equal(await page.evaluate(() => window.verdigris.age), to, key);
      }
      assert.equal(await page.locator("#zones .break").count(), first === -8 ? 1 : 0);
      assert.deepEqual(complaints, []);
      await page.close();
    }
  });

  await test("past the trust limit the page says so, and not before", async () => {
    const made = makeDocument({});
    made.doc.context = 4;
    const { page } = await openPage(context, await page_of(made.doc, "trust"), { stage: false });
    for (const [age, beyond] of [[-3, false], [0, false], [8, false], [8.1, true], [20, true]]) {
      await page.evaluate((a) => window.verdigris.setAge(a), age);
      assert.equal(await page.locator("#caution").isVisible(), beyond, `at ${age}`);
    }
    assert.match(await page.locator("#caution").textContent(), /past \+8, twice the 4 frames fitted/);
    assert.ok(await page.locator("#zones .beyond").isVisible());
    await page.close();
  });

  await test("a forecast that holds still says so; coverage from the start too", async () => {
    const made = makeDocument({ order: 0 });
    made.doc.material.observed_is_clean = false;
    const { page } = await openPage(context, await page_of(made.doc, "still"), { stage: false });
    const words = async () => [await page.locator("#badge").textContent(), await page.locator("#readout").textContent()];
    assert.deepEqual(await words(), ["observed", "last observed frame"]);
    await page.evaluate(() => window.verdigris.setAge(5));
    assert.deepEqual(await words(), ["forecast, held", "forecast, +5.0 accelerated units, held"]);
    await page.keyboard.press("7");
    assert.equal(await page.locator("#legend-low").textContent(), "as at the start");
    await page.close();
  });

  await test("play moves the age and pauses", async () => {
    const { page } = await page_at_rest();
    const age = () => page.evaluate(() => window.verdigris.age);
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForFunction(() => window.verdigris.age > 0.5, null, { timeout: 8000 });
    await page.getByRole("button", { name: "Pause" }).click();
    const stopped = await age();
    await page.waitForTimeout(400);
    assert.equal(await age(), stopped);
  });

  await test("shapes, maps and wipe each change the picture and say so", async () => {
    const { page, complaints } = await page_at_rest();
    const canvas = page.locator("#stage");
    await page.evaluate(() => window.verdigris.setAge(15));
    const seen = [];
    const look = async (what) => {
      await drawn(page);
      const shot = await canvas.screenshot();
      assert.ok(!seen.some((s) => s.equals(shot)), `${what} shows nothing new`);
      seen.push(shot);
    };
    await look("sphere");
    for (const shape of ["Plane", "Curved"]) {
      await page.getByRole("button", { name: shape, exact: true }).click();
      await look(shape);
    }
    for (const map of ["Albedo", "Normal", "Roughness", "Metallic", "Height", "Coverage"]) {
      const button = page.getByRole("button", { name: map, exact: true });
      await button.click();
      assert.equal(await button.getAttribute("aria-pressed"), "true");
      await look(map);
    }
    assert.match(await page.locator("#legend").innerText(), /as observed\s+fully changed/);
    await page.locator("#view").hover();
    await page.mouse.wheel(0, -1500);
    await look("zoomed map");
    await page.locator("#view").focus();
    await page.keyboard.press("ArrowLeft");
    await look("moved map");
    await page.keyboard.press("0");
    await page.evaluate(() => document.activeElement.blur());
    await drawn(page);
    const again = await canvas.screenshot();
    assert.ok(unlike(seen.at(-1), seen.at(-3)) > 0.05, "the moved map is where it was");
    assert.ok(unlike(again, seen.at(-3)) < 0.001, "0 does not show all of the map again");
    await page.keyboard.press("1");
    await page.keyboard.press("w");
    assert.equal(await page.locator("#wipe-toggle").getAttribute("aria-pressed"), "true");
    await look("wipe");
    const border = page.getByRole("slider", { name: /Comparison border/ });
    const at = await border.getAttribute("aria-valuenow");
    await border.focus();
    await page.keyboard.press("ArrowRight");
    assert.notEqual(await border.getAttribute("aria-valuenow"), at);
    await look("moved wipe");
    assert.deepEqual(complaints, []);
  });

  await test("everything can be reached by Tab and has a name", async () => {
    const { page } = await page_at_rest();
    const focusable = await page.locator("button:visible, input:visible, [tabindex='0']:visible").count();
    const names = new Set();
    await page.locator("body").click({ position: { x: 5, y: 5 } });
    for (let i = 0; i < focusable + 5; i++) {
      await page.keyboard.press("Tab");
      names.add(await page.evaluate(() => {
        const e = document.activeElement;
        return e === document.body ? "" : `${e.tagName} ${e.getAttribute("aria-label") ?? e.textContent}`;
      }));
    }
    names.delete("");
    assert.ok(names.size >= focusable - 1, `reached ${names.size} of ${focusable}: ${[...names].join("; ")}`);
    for (const name of names) assert.match(name, /\S+ \S/, `no name: ${name}`);
  });

  await test("text from outside stays text", async () => {
    const title = `</script><img src=x onerror="window.hacked=1"><b>bold</b>`;
    const { page, complaints } = await open({ title }, "hostile", { stage: false });
    assert.equal(await page.locator("#title").textContent(), title);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.deepEqual(complaints, []);
    // Even if markup got in, the page's policy runs nothing but the viewer's own script.
    await page.evaluate(() => {
      document.body.insertAdjacentHTML("beforeend", `<img src=x onerror="window.hacked=1">`);
      const script = document.createElement("script");
      script.textContent = "window.hacked=2";
      document.body.append(script);
    });
    await page.waitForTimeout(300);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.ok(complaints.some((c) => /Content Security Policy/.test(c)), complaints.join("; "));
    await page.close();
  });

  await test("damaged data and missing WebGL get a sentence", async () => {
    const { doc } = makeDocument({});
    const damaged = structuredClone(doc);
    damaged.trajectory.rate.data = damaged.canvas.data.slice(0, 40);
    for (const [bad, pattern] of [[damaged, /damaged/], [{ ...doc, horizons: undefined }, /damaged/],
      [{ format: "other" }, /another viewer/]]) {
      const { page } = await openPage(context, await page_of(bad, "bad"));
      await page.locator("#fault").waitFor({ state: "visible", timeout: 5000 });
      assert.match(await page.locator("#fault").textContent(), pattern);
      await page.close();
    }
    const page = await context.newPage();
    await page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
    await page.goto(`file://${await page_of(doc, "nogl")}`);
    await page.locator("#fault").waitFor({ state: "visible", timeout: 5000 });
    assert.match(await page.locator("#fault").textContent(), /WebGL 2/);
    await page.close();
  });

  await test("a phone shows it all", async () => {
    const { page } = await page_at_rest();
    await page.setViewportSize({ width: 390, height: 844 });
    await drawn(page);
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(overflow <= 0, `${overflow} pixels wider than the screen`);
    for (const id of ["#slider", "#play", "#view"]) assert.ok(await page.locator(id).isVisible());
    assert.ok((await page.locator("#stage").boundingBox()).height > 250);
    const reach = await page.evaluate(() => [...document.querySelectorAll("button, input")]
      .filter((e) => e.offsetParent && !e.closest("#maps"))
      .every((e) => e.getBoundingClientRect().right <= window.innerWidth + 8));
    assert.ok(reach, "a control lies outside the screen");
    await page.keyboard.press("7");
    const picked = await page.getByRole("button", { name: "Coverage", exact: true }).boundingBox();
    assert.ok(picked.x >= 0 && picked.x + picked.width <= 390, "the map that a key picked is out of sight");
    if (shots) await page.screenshot({ path: path.join(shots, "phone.png") });
  });
});
await done();
