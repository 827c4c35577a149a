// SPDX-License-Identifier: MIT
// report.html as the library writes it:  node report_test.mjs SAMPLE_RESULTS_PROGRAM [SCREENSHOT_DIR]
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { drawn, executable, openPage, withBrowser } from "./browser.mjs";

if (!executable) {
  console.log("skipped: no Chromium found (set VERDIGRIS_CHROMIUM)");
  process.exit(77);
}
const [sample, shots] = process.argv.slice(2);
const folder = await mkdtemp(path.join(tmpdir(), "verdigris-report-"));
process.on("exit", () => execFileSync("rm", ["-rf", folder]));
execFileSync(sample, [folder]);
const file = path.join(folder, "report.html");
const drawings = existsSync(path.join(folder, "figures"));   // without gnuplot there are none
const html = await readFile(file, "utf8");
const { figures } = JSON.parse(/<script id="verdigris-data"[^>]*>(.*?)<\/script>/s.exec(html)[1]);
const ids = Object.keys(figures);
assert.equal(ids.length, 4);

let failures = 0;
async function test(name, work) {
  try {
    await work();
    console.log(`ok    ${name}`);
  } catch (error) {
    failures++;
    console.log(`FAIL  ${name}\n      ${error.message}`);
  }
}
const shoot = async (page, name) => {
  if (shots) await page.screenshot({ path: path.join(shots, `report_${name}.png`), fullPage: true });
};
const column = (page, n) => page.locator("#table-gains tbody").evaluateAll((bodies, i) => bodies.map(
  (body) => [...body.rows].filter((row) => !row.classList.contains("group")).map((row) => row.cells[i].textContent)), n);

await withBrowser(async (context) => {
  const { page, complaints, requests } = await openPage(context, file);
  await page.setViewportSize({ width: 1200, height: 900 });
  await page.waitForTimeout(600);   // redrawn for the new width

  await test("every figure is a chart; nothing complains, nothing is requested", async () => {
    for (const id of ids) {
      assert.equal(await page.locator(`#figure-${id} .chart svg`).count(), 1, id);
      if (drawings) assert.equal(await page.locator(`#figure-${id} .drawing`).isVisible(), false, id);
    }
    assert.deepEqual(complaints, []);
    assert.deepEqual(requests, []);
    await shoot(page, "light");
  });

  await test("a tooltip says what the table would", async () => {
    const layers = figures.blocks.concat[0].layer;
    const points = layers.find((layer) => layer.mark.type === "point");
    const { series, x_says, y_says } = points.data.values[1];
    assert.equal(x_says, "block 2");
    const mark = page.locator("#figure-blocks .chart .mark-symbol.role-mark path").nth(1);
    await mark.hover({ force: true });
    const tip = page.locator(".vg-tooltip.visible");
    await tip.waitFor({ timeout: 5000 });
    const said = await tip.textContent();
    for (const words of [series, x_says, y_says]) assert.ok(said.includes(words), `${said} lacks ${words}`);
    assert.match(y_says, /^[+−][0-9.]+ % \[[+−][0-9.]+ %, [+−][0-9.]+ %\]$/);
    await page.mouse.move(0, 0);
  });

  await test("a click on the legend leaves one series", async () => {
    const faint = () => page.locator("#figure-blocks .chart .mark-symbol.role-mark path").evaluateAll(
      (paths) => paths.filter((p) => Number(p.getAttribute("opacity") ?? 1) < 0.5).length);
    assert.equal(await faint(), 0);
    await page.locator("#figure-blocks .chart .role-legend-label text").first().click({ force: true });
    await drawn(page);
    assert.equal(await faint(), 12, "two of three series of six points are faint");
    await page.locator("#figure-blocks .chart .role-legend-label text").first().dblclick({ force: true });
  });

  await test("a table of two directions fits beside the contents", async () => {
    await page.setViewportSize({ width: 1280, height: 900 });
    const [inside, place] = await page.locator(".table:has(#table-settings)").evaluate((t) => [t.scrollWidth, t.clientWidth]);
    assert.ok(inside <= place, `${inside} px in ${place}`);
    assert.ok(await page.locator("nav").evaluate((n) => n.offsetWidth < 300), "the contents are no column");
    await page.setViewportSize({ width: 1200, height: 900 });
    await page.waitForTimeout(600);
  });

  await test("tables sort within their groups, and what is missing stays last", async () => {
    const given = await column(page, 1);
    assert.deepEqual(given, [["4.20", "3.93", "12.0"], ["5.10", "5.35", "NaN"]]);
    const heading = page.locator("#table-gains thead th").nth(1);
    await heading.locator("button").click();
    assert.deepEqual(await column(page, 1), [["3.93", "4.20", "12.0"], ["5.10", "5.35", "NaN"]]);
    assert.equal(await heading.getAttribute("aria-sort"), "ascending");
    await heading.locator("button").click();
    assert.deepEqual(await column(page, 1), [["12.0", "4.20", "3.93"], ["5.35", "5.10", "NaN"]]);
    await heading.locator("button").click();
    assert.deepEqual(await column(page, 1), given);
    assert.equal(await heading.getAttribute("aria-sort"), null);
    await page.locator("#table-gains thead button").nth(2).click();   // negative numbers, n/a
    assert.deepEqual((await column(page, 0))[0], ["affine, per channel", "affinergb", "persistence"]);
    await page.locator("#table-gains thead button").first().click();  // words
    assert.deepEqual((await column(page, 0))[0], ["affine, per channel", "affinergb", "persistence"]);
    assert.equal(await page.locator("#table-gains [aria-sort]").count(), 1);
  });

  await test("in the dark the colors are their lighter twins", async () => {
    const inks = () => page.locator("#figure-horizons .chart path").evaluateAll(
      (paths) => paths.map((p) => p.getAttribute("stroke")));
    assert.ok((await inks()).includes("#0072b2"));
    await page.emulateMedia({ colorScheme: "dark" });
    await page.waitForFunction(() => [...document.querySelectorAll("#figure-crowd .chart path")]
      .some((p) => p.getAttribute("stroke") === "#56a8dc"));
    assert.ok(!(await inks()).includes("#0072b2"));
    await shoot(page, "dark");
    await page.emulateMedia({ colorScheme: "light" });
    await page.waitForFunction(() => [...document.querySelectorAll("#figure-crowd .chart path")]
      .some((p) => p.getAttribute("stroke") === "#0072b2"));
  });

  if (drawings) {
    await test("on paper the drawings stand where the charts were", async () => {
      await page.emulateMedia({ media: "print" });
      assert.equal(await page.locator("#figure-drift .chart").isVisible(), false);
      assert.equal(await page.locator("#figure-drift .drawing").isVisible(), true);
      assert.equal(await page.locator("nav").isVisible(), false);
      await page.emulateMedia({ media: "screen" });
    });
  }

  await test("a telephone's page is not wider than the telephone", async () => {
    await page.setViewportSize({ width: 390, height: 800 });
    await page.waitForFunction(() => document.querySelector("#figure-drift .chart svg").clientWidth <= 390);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px too wide`);
    await shoot(page, "phone");
  });
  assert.deepEqual([complaints, requests], [[], []], "at the end");
});

const static_page = (name, page, complaints) => test(name, async () => {
  assert.deepEqual(complaints, []);
  assert.equal(await page.locator("thead button").count(), 0);
  assert.equal(await page.locator("h2").first().isVisible(), true);
  const images = await page.locator(".drawing").evaluateAll((all) => all.map((i) => i.naturalWidth));
  assert.equal(images.length, drawings ? 4 : 0);
  assert.ok(images.every((width) => width > 300), `${images}`);
  for (const id of drawings ? ids : []) assert.equal(await page.locator(`#figure-${id} .drawing`).isVisible(), true);
  await shoot(page, name.replace(/\W+/g, "_"));
});
await withBrowser(async (context) => {
  const page = await context.newPage();
  await page.goto(`file://${file}`);
  await static_page("with scripts off the drawings are there", page, []);
}, { javaScriptEnabled: false });
await withBrowser(async (context) => {
  const plain = path.join(folder, "plain.html");
  assert.ok(!(await readFile(plain, "utf8")).includes("<script"));
  const { page, complaints } = await openPage(context, plain);
  await static_page("the page without scripts", page, complaints);
});
await rm(folder, { recursive: true, force: true });
if (failures) {
  console.log(`${failures} failures`);
  process.exit(1);
}
