// SPDX-License-Identifier: MIT
// Starts the Chromium of the system, headless, with software WebGL and no way out to the network.
import { existsSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { chromium } from "playwright-core";

const candidates = [process.env.VERDIGRIS_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome"].filter(Boolean);
export const executable = candidates.find((p) => existsSync(p));

/** `options`: of the context, on top of these: {javaScriptEnabled: false}. */
export async function withBrowser(work, options = {}) {
  const profile = await mkdtemp(path.join(tmpdir(), "verdigris-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: executable, headless: true,
    // Small: software rendering of the stage is what takes the time.
    viewport: { width: 760, height: 560 },
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader",
      "--allow-file-access-from-files"],
    ...options,
  });
  try {
    return await work(context);
  } finally {
    await context.close();
    await rm(profile, { recursive: true, force: true });
  }
}

/**
 * Opens a page from the file system; collects console complaints and network requests. Without a
 * stage the window is so low that the controls leave no room for the picture: the page then draws
 * none, and the seconds of its lighting in software are saved where only maps or words are of
 * interest.
 */
export async function openPage(context, file, { stage = true } = {}) {
  const page = await context.newPage();
  if (!stage) await page.setViewportSize({ width: 760, height: 60 });
  const complaints = [], requests = [];
  page.on("console", (m) => {
    // Chromium's own remarks about software rendering are not the page's.
    if (["error", "warning"].includes(m.type()) &&
        !/GPU stall|GL Driver Message|software WebGL|swiftshader/i.test(m.text())) {
      complaints.push(`${m.type()}: ${m.text()}`);
    }
  });
  page.on("pageerror", (e) => complaints.push(`exception: ${e.message}`));
  page.on("request", (r) => {
    if (!/^(file|data|blob):/.test(r.url())) requests.push(r.url());
  });
  await page.goto(`file://${path.resolve(file)}`);
  await page.evaluate(() => window.verdigris?.ready.catch(() => undefined));
  return { page, complaints, requests };
}

/** Maps as the GPU computed them, at an age: {name: {width, height, channels, data}}. */
export async function readMaps(page, age, names) {
  const maps = await page.evaluate(([a, wanted]) => {
    window.verdigris.setAge(a);
    const text = (floats) => {   // base64: as JSON a million numbers take longer than the maps
      const bytes = new Uint8Array(floats.buffer), parts = [];
      for (let i = 0; i < bytes.length; i += 32768) {
        parts.push(String.fromCharCode(...bytes.subarray(i, i + 32768)));
      }
      return btoa(parts.join(""));
    };
    return wanted.map((name) => {
      const m = window.verdigris.readMap(name);
      return [name, { ...m, data: text(m.data) }];
    });
  }, [age, names]);
  return Object.fromEntries(maps.map(([name, m]) => {
    const bytes = Uint8Array.from(Buffer.from(m.data, "base64"));   // a copy: its start is aligned
    return [name, { ...m, data: new Float32Array(bytes.buffer) }];
  }));
}

/** One map as above. */
export async function readMap(page, age, name) {
  return (await readMaps(page, age, [name]))[name];
}

/** Until what was asked for before is drawn: the page redraws in the next frame. */
export async function drawn(page) {
  await page.evaluate(() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(() => done()))));
}
