// SPDX-License-Identifier: MIT
// The mapping behind the age slider, as pure functions:  node age_scale_test.mjs
import assert from "node:assert/strict";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const source = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../apps/viewer/src/age_scale.ts");
const { outputFiles } = await build({ entryPoints: [source], bundle: true, write: false, format: "esm" });
const { ageScale, evenStep, kForecastShare, toAge, toTrack } =
  await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
const near = (a, b, by, what) => assert.ok(Math.abs(a - b) <= by, `${what}: ${a}, not ${b}`);

// Known answers: 100 observed units leave the forecast 0.7; 9 against 50 stay linear.
const long = ageScale(-100, 50), short = ageScale(-9, 50);
assert.deepEqual([long.broken, short.broken], [true, false]);
for (const [age, track] of [[-100, 0], [-50, 0.15], [0, 0.3], [25, 0.65], [50, 1]]) {
  near(toTrack(long, age), track, 1e-12, `${age} on the broken scale`);
}
for (const age of [-9, -3.3, 0, 0.1, 50]) near(toTrack(short, age), (age + 9) / 59, 1e-12, `${age} on the linear scale`);

for (const [first, last] of [[-100, 50], [-9, 50], [-21.4, 50], [-21.5, 50], [-1e4, 0.5], [-0.01, 1], [0, 50],
  [0, 1], [-100, 0], [0, 0]]) {
  const scale = ageScale(first, last), name = `${first} to ${last}`, span = last - first;
  // The forecast's room, and no break without need.
  if (first < 0 && last > 0) {
    assert.ok(1 - scale.now >= kForecastShare - 1e-12, `${name}: the forecast is squeezed`);
    assert.equal(scale.broken, last / span < kForecastShare, name);
  } else assert.equal(scale.broken, false, name);
  // Ends, and what lies past them.
  if (span > 0) {
    assert.deepEqual([toTrack(scale, first), toTrack(scale, last)], [0, 1], name);
    assert.deepEqual([toTrack(scale, first - 1), toTrack(scale, last + 1)], [0, 1], name);
    near(toAge(scale, -0.1), first, 1e-12, name);
    near(toAge(scale, 1.1), last, 1e-12, name);
  }
  // Round trip and monotony over the whole axis.
  let before = -1;
  for (let i = 0; i <= 2000 && span > 0; i++) {
    const age = first + (span * i) / 2000, track = toTrack(scale, age);
    assert.ok(track > before, `${name}: not rising at ${age}`);
    before = track;
    near(toAge(scale, track), age, 1e-9 * span, `${name}: round trip`);
    near(toTrack(scale, toAge(scale, i / 2000)), i / 2000, 1e-9, `${name}: round trip of the track`);
  }
  // No jump at now, from either side and both ways.
  near(toTrack(scale, 0), scale.now, 0, name);
  near(toAge(scale, scale.now), 0, 0, name);
  for (const e of [1e-9, 1e-6]) {   // the slopes, and a little for rounding
    near(toTrack(scale, -e * span), scale.now, 1.001 * e * (first ? span / -first : 1), `${name}: before now`);
    near(toTrack(scale, e * span), scale.now, 1.001 * e * (last ? span / last : 1), `${name}: after now`);
    near(toAge(scale, scale.now - e), 0, 1.001 * e * -first / (scale.now || 1), `${name}: left of now`);
    near(toAge(scale, scale.now + e), 0, 1.001 * e * last / (1 - scale.now || 1), `${name}: right of now`);
  }
  // Notches: 1, 2 or 5 times a power of ten, and never too many.
  const step = evenStep(scale, 15);
  assert.ok(span / step <= 15 + 1e-6, `${name}: ${span / step} steps`);
  assert.match(step.toExponential(), /^[125]e/, name);
}
assert.equal(evenStep(long, 15), 10);
console.log("ok    the age scale");
