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

export async function withBrowser(work) {
  const profile = await mkdtemp(path.join(tmpdir(), "verdigris-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: executable, headless: true,
    // Small: software rendering of the stage is what takes the time.
    viewport: { width: 760, height: 560 },
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader",
      "--allow-file-access-from-files"],
  });
  try {
    return await work(context);
  } finally {
    await context.close();
    await rm(profile, { recursive: true, force: true });
  }
}

/** Opens a page from the file system; collects console complaints and network requests. */
export async function openPage(context, file) {
  const page = await context.newPage();
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
  await page.evaluate(() => window.verdigris.ready.catch(() => undefined));
  return { page, complaints, requests };
}

/** A map as the GPU computed it, at an age. */
export async function readMap(page, age, name) {
  return page.evaluate(([a, n]) => {
    window.verdigris.setAge(a);
    const m = window.verdigris.readMap(n);
    return { width: m.width, height: m.height, channels: m.channels, data: Array.from(m.data) };
  }, [age, name]);
}
