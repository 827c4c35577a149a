// SPDX-License-Identifier: MIT
// A page to look at while working on the viewer:
//   node sample.mjs TEMPLATE OUTPUT.html [FOLDER]
// Without a folder: a made brushed copper plate on which patina grows. With one: its PNG frames, a
// straight line from an early state to the last.
import { readdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { PNG } from "pngjs";
import { encodeBlob, kMaterial, picture, random } from "./synthetic.mjs";

const [template, output, folder] = process.argv.slice(2);

/** Smooth noise in [0, 1]: octaves of interpolated random grids, stretched by (sx, sy). */
function clouds(width, height, seed, cell, sx, sy) {
  const out = new Float64Array(width * height);
  let weight = 0;
  for (let octave = 0, size = cell, gain = 1; octave < 5 && size > 1; octave++, size /= 2, gain *= 0.55) {
    const next = random(seed + octave), w = Math.ceil(width / (size * sx)) + 2, h = Math.ceil(height / (size * sy)) + 2;
    const grid = Float64Array.from({ length: w * h }, () => next());
    const ease = (t) => t * t * (3 - 2 * t);
    for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) {
      const u = x / (size * sx), v = y / (size * sy), i = Math.floor(u), j = Math.floor(v);
      const a = ease(u - i), b = ease(v - j), at = (p, q) => grid[(j + q) * w + i + p];
      out[y * width + x] += gain * ((at(0, 0) * (1 - a) + at(1, 0) * a) * (1 - b) + (at(0, 1) * (1 - a) + at(1, 1) * a) * b);
    }
    weight += gain;
  }
  return out.map((v) => v / weight);
}

/** Bright brushed copper, and where and how fast it goes brown and then green. */
function madeCopper(width, height) {
  const brush = clouds(width, height, 3, 6, 24, 0.35), tone = clouds(width, height, 11, 90, 1.4, 1);
  const where = clouds(width, height, 29, 70, 1, 1.2), fine = clouds(width, height, 41, 9, 1, 1);
  const base = [], rate = [];
  for (let i = 0; i < width * height; i++) {
    const shade = 0.9 + 0.28 * (tone[i] - 0.5) + 0.22 * (brush[i] - 0.5);
    const start = [0.87, 0.60, 0.47].map((c) => Math.min(c * shade, 0.98));
    const y = Math.floor(i / width) / height;
    const grown = Math.min(Math.max((where[i] + 0.35 * (fine[i] - 0.5) + 0.12 * y - 0.5) * 7, 0), 1);
    const end = [0.36, 0.62, 0.55].map((c, k) => {
      const brown = [0.55, 0.37, 0.29][k] * shade;
      return brown + grown * (c * (0.8 + 0.5 * (fine[i] - 0.5)) - brown);
    });
    base.push(...start);
    rate.push(...end.map((v, k) => (v - start[k]) / 40));
  }
  return { title: "Made copper plate", width, height, base, rate };
}

async function fromFolder(name) {
  const files = (await readdir(name)).filter((f) => f.endsWith(".png")).sort();
  const early = Math.floor(files.length * 0.25);
  const read = async (at) => {
    const png = PNG.sync.read(await readFile(path.join(name, files[at])));
    const rgb = [];
    for (let i = 0; i < png.width * png.height; i++) for (let k = 0; k < 3; k++) rgb.push(png.data[i * 4 + k] / 255);
    return { width: png.width, height: png.height, rgb };
  };
  const mean = async (from, count) => {
    const all = await Promise.all(Array.from({ length: count }, (_, i) => read(from + i)));
    return { ...all[0], rgb: all[0].rgb.map((_, i) => all.reduce((s, f) => s + f.rgb[i], 0) / count) };
  };
  const a = await mean(early - 2, 5), b = await mean(files.length - 9, 9);
  return { title: path.basename(name), width: a.width, height: a.height, base: a.rgb,
    rate: b.rgb.map((v, i) => (v - a.rgb[i]) / 40) };
}

const { title, width, height, base, rate } = folder ? await fromFolder(folder) : madeCopper(320, 256);
const n = width * height, blob = (values, channels) => encodeBlob(values, channels, width, height).blob;
const filled = (value) => blob(new Array(n).fill(value), 1);
const glint = (i) => [0, 1, 2].every((k) => base[i * 3 + k] > 0.97);
const doc = {
  format: "verdigris-viewer/1", title, version: "0.1.0", width, height, context: 10,
  units_observed: 98.4, horizons: [5, 10, 20, 40],
  forecaster: { name: "affinergb full order 1", explanation: "One drift of color for the whole plate: on " +
    "frames held back from the context it was 12 % closer than assuming that nothing changes." },
  guards: [
    { id: "long_horizon", severity: "caution", sentence: "+40 lies beyond twice the 10 units observed; such a forecast has not been tested." },
    { id: "out_of_gamut", severity: "info", sentence: "At +40, 3 % of the pixels reach black or white and are held there." }],
  origins: [
    { map: "albedo", origin: "modeled", sentence: "The forecast frame, as the camera would record it." },
    { map: "normal", origin: "modeled", sentence: "From the height map; the camera never saw relief." },
    { map: "roughness", origin: "assumed", sentence: "Constants of bare copper and of patina, mixed by coverage." },
    { map: "metallic", origin: "assumed", sentence: "The same mixture between a conductor and a salt." },
    { map: "height", origin: "modeled", sentence: "From the brightness and the coverage." }],
  trajectory: { kind: "law", order: 1, context: 10, clamp: true, base: blob(base, 3), rate: blob(rate, 3), curvature: null },
  observed: [-9, -6, -3, 0].map((unit) => ({ unit, image: picture(base.map((v, i) => v + unit * rate[i]), width, height) })),
  material: { ...kMaterial, normalizer: 0.3, tau: 0.02 },
  canvas: blob(base, 3), dead_zone: filled(0.02), active: filled(1),
  luma_fill: blob(Array.from({ length: n }, (_, i) => (glint(i) ? 0.6 : -1)), 1),
};
const page = (await readFile(template, "utf8")).replace("@@VERDIGRIS_DATA@@",
  () => JSON.stringify(doc).replaceAll("<", "\\u003c"));
await writeFile(output, page);
