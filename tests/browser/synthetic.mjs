// SPDX-License-Identifier: MIT
// A made document and the maps it must give: the equations of docs/VIEWER_DATA.md in doubles,
// written independently of the shaders and of the C++.
import { deflateSync } from "node:zlib";
import { PNG } from "pngjs";

export function random(seed) {
  let s = seed >>> 0;
  return () => {
    s = (Math.imul(s, 1664525) + 1013904223) >>> 0;
    return s / 4294967296;
  };
}

/** Encodes, and returns what a reader will decode. */
export function encodeBlob(values, channels, width, height) {
  let lo = Infinity, hi = -Infinity;
  for (const v of values) { lo = Math.min(lo, v); hi = Math.max(hi, v); }
  const scale = (hi - lo) / 65535 || 1e-9;
  const q = values.map((v) => Math.round((v - lo) / scale));
  const bytes = Buffer.alloc(values.length * 2);
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) for (let k = 0; k < channels; k++) {
    const i = (y * width + x) * channels + k;
    const from = x > 0 ? q[i - channels] : y > 0 ? q[i - channels * width] : 0;
    bytes.writeUInt16LE((q[i] - from) & 0xffff, i * 2);
  }
  return { blob: { channels, scale, offset: lo, data: deflateSync(bytes).toString("base64") },
    decoded: q.map((v) => lo + scale * v) };
}

export function picture(rgb, width, height) {
  const png = new PNG({ width, height });
  for (let i = 0; i < width * height; i++) {
    for (let k = 0; k < 3; k++) png.data[i * 4 + k] = Math.round(Math.min(Math.max(rgb[i * 3 + k], 0), 1) * 255);
    png.data[i * 4 + 3] = 255;
  }
  return "data:image/png;base64," + PNG.sync.write(png).toString("base64");
}

export const kMaterial = { coverage_exponent: 0.85, roughness_clean: 0.16, roughness_patina: 0.88,
  roughness_gamma: 0.75, micro_roughness: 0.06, metallic_patina: 0.03, metallic_clean: 0.97,
  metallic_gamma: 1.25, height_patina_weight: 0.45, height_sigma: 1.0, micro_sigma: 2.0,
  micro_range: 0.02, normal_scale: 2.6, normal_gain: 8, tau: 0.01, normalizer: 0.2, reference_horizon: 20, observed_is_clean: true };

export function makeDocument({ width = 37, height = 29, order = 1, clamp = true, kind = "law", title = "made plate",
  material: changed = {} }) {
  const next = random(7 + order), n = width * height, reach = 9;
  const base = [], rate = [], curvature = [], canvas = [], zone = [], active = [], fill = [];
  for (let i = 0; i < n; i++) {
    const x = i % width, y = Math.floor(i / width);
    const inside = x > 2 && y > 2 && x < width - 3 && y < height - 2 ? 1 : 0;
    for (let k = 0; k < 3; k++) {
      // Some channels start at the very border, with drifts both ways: in place or back inside.
      const b = i % 11 === 3 ? (next() < 0.5 ? 0 : 1) : 0.15 + 0.6 * next();
      base.push(b);
      canvas.push(b + 0.02 * (next() - 0.5));
      rate.push(inside ? 0.04 * (next() - 0.6) : 0);
      curvature.push(inside ? 0.001 * (next() - 0.5) : 0);
    }
    const deviation = [0, 1, 2].reduce((s, k) => s + Math.abs(base[i * 3 + k] - canvas[i * 3 + k]), 0) / 3;
    zone.push(Math.max(0.01, deviation));
    active.push(!inside ? 0 : x > 14 && x < 18 ? 0.5 : 1);   // backdrop, under a glint, specimen
    fill.push(x > 14 && x < 18 ? 0.4 : -1);
  }
  const material = { ...kMaterial, ...changed };
  const put = (values, channels) => encodeBlob(values, channels, width, height);
  const b = { base: put(base, 3), rate: put(rate, 3), curvature: put(curvature, 3), canvas: put(canvas, 3),
    zone: put(zone, 1), active: put(active, 1), fill: put(fill, 1) };
  const stackHorizons = [2, 5, 20];
  const stack = stackHorizons.map((h) => put(base.map((v, i) => v + h * rate[i]), 3));
  const older = base.map((v, i) => v - 8 * rate[i]);
  const doc = {
    format: "verdigris-viewer/1", title, version: "0.0.0", width, height, context: 10, units_observed: 40,
    horizons: [5, 10, 20], forecaster: { name: "made", explanation: "Made for a test." },
    guards: [{ id: "long_horizon", severity: "caution", sentence: "Beyond +20 is a guess." }],
    origins: [{ map: "albedo", origin: "modeled", sentence: "The frame itself." }],
    trajectory: kind === "law"
      ? { kind, order, context: reach + 1, clamp, base: b.base.blob, rate: b.rate.blob,
        curvature: order === 2 ? b.curvature.blob : null }
      : { kind, base: b.base.blob, horizons: stackHorizons, frames: stack.map((s) => s.blob) },
    observed: [{ unit: -8, image: picture(older, width, height) }, { unit: 0, image: picture(base, width, height) }],
    material, canvas: b.canvas.blob, dead_zone: b.zone.blob, active: b.active.blob, luma_fill: b.fill.blob,
  };
  const truth = { base: b.base.decoded, rate: b.rate.decoded, curvature: b.curvature.decoded,
    canvas: b.canvas.decoded, zone: b.zone.decoded, active: b.active.decoded, fill: b.fill.decoded,
    stackHorizons, stack: stack.map((s) => s.decoded), reach };
  return { doc, truth };
}

/** The horizon at which a pixel's drift is frozen, found by stepping and bisection, not in closed form. */
function frozen(truth, i, h, order) {
  const leaves = (t) => [0, 1, 2].some((k) => {
    const v = value(truth, i * 3 + k, t, order);
    return v < 0 || v > 1;
  });
  const steps = 4000;
  for (let s = 1; s <= steps; s++) {
    if (!leaves((h * s) / steps)) continue;
    let lo = (h * (s - 1)) / steps, hi = (h * s) / steps;
    for (let j = 0; j < 50; j++) { const mid = (lo + hi) / 2; if (leaves(mid)) hi = mid; else lo = mid; }
    return lo;
  }
  return h;
}
function value(truth, j, h, order) {
  let v = truth.base[j] + (order > 0 ? h * truth.rate[j] : 0);
  if (order === 2) v += ((truth.reach + h) ** 2 - truth.reach ** 2) * truth.curvature[j];
  return v;
}

export function reference({ doc, truth }, h) {
  const { width, height, material: m } = doc, n = width * height, t = doc.trajectory;
  const albedo = new Float64Array(n * 3), coverage = new Float64Array(n), luma = new Float64Array(n);
  for (let i = 0; i < n; i++) {
    let change = 0;
    const at = t.kind === "law" && t.clamp && t.order > 0 ? frozen(truth, i, h, t.order) : h;
    for (let k = 0; k < 3; k++) {
      const j = i * 3 + k;
      if (t.kind === "law") albedo[j] = value(truth, j, at, t.order);
      else {
        const units = [0, ...truth.stackHorizons], frames = [truth.base, ...truth.stack];
        let s = 0;
        while (s + 2 < units.length && units[s + 1] <= h) s++;
        const f = Math.min(Math.max((h - units[s]) / (units[s + 1] - units[s]), 0), 1);
        albedo[j] = frames[s][j] * (1 - f) + frames[s + 1][j] * f;
      }
      change += Math.abs(albedo[j] - truth.canvas[j]) / 3;
    }
    const p = Math.min(Math.max((change - truth.zone[i]) / m.normalizer, 0), 1);
    coverage[i] = truth.active[i] > 0.75 ? p ** m.coverage_exponent : 0;
    luma[i] = truth.fill[i] >= 0 ? truth.fill[i]
      : 0.2126 * albedo[i * 3] + 0.7152 * albedo[i * 3 + 1] + 0.0722 * albedo[i * 3 + 2];
  }
  const clampAt = (v, hi) => Math.min(Math.max(v, 0), hi - 1);
  const gaussian = (image, sigma) => {
    if (sigma === 0) return image;
    const r = Math.ceil(3 * sigma), taps = [];
    for (let i = -r; i <= r; i++) taps.push(Math.exp(-0.5 * (i / sigma) ** 2));
    const sum = taps.reduce((a, b) => a + b);
    const run = (source, dx, dy) => source.map((_, i) => {
      const x = i % width, y = Math.floor(i / width);
      return taps.reduce((s, w, j) =>
        s + (w / sum) * source[clampAt(y + (j - r) * dy, height) * width + clampAt(x + (j - r) * dx, width)], 0);
    });
    return run(run(image, 1, 0), 0, 1);
  };
  const smooth = gaussian(luma, m.height_sigma);
  const tall = smooth.map((v, i) =>
    Math.min(Math.max((1 - m.height_patina_weight) * v + m.height_patina_weight * coverage[i], 0), 1));
  const low = gaussian(tall, m.micro_sigma);
  const surface = coverage.map((p, i) => truth.active[i] < 0.25 ? 1 : p);   // the backdrop is no metal
  const roughness = tall.map((v, i) => Math.min(Math.max(
    m.roughness_clean + (m.roughness_patina - m.roughness_clean) * surface[i] ** m.roughness_gamma +
    Math.min(Math.max((v - low[i]) / m.micro_range, -1), 1) * m.micro_roughness, 0.04), 1));
  const metallic = surface.map((p) =>
    m.metallic_patina + (m.metallic_clean - m.metallic_patina) * (1 - p) ** m.metallic_gamma);
  const normal = new Float64Array(n * 3), k = (m.normal_scale * m.normal_gain) / 8;
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) {
    const at = (dx, dy) => tall[clampAt(y + dy, height) * width + clampAt(x + dx, width)];
    const gx = at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1);
    const gy = at(-1, 1) + 2 * at(0, 1) + at(1, 1) - at(-1, -1) - 2 * at(0, -1) - at(1, -1);
    const length = Math.hypot(k * gx, k * gy, 1);
    normal.set([(-k * gx) / length, (k * gy) / length, 1 / length], (y * width + x) * 3);
  }
  return { albedo, coverage, height: tall, roughness, metallic, normal };
}
