// SPDX-License-Identifier: MIT
// Tangents by the port of MikkTSpace's reference code that comes with three.js (and says where it
// corrects it), for the meshes that verdigris/render/tangents_test.cpp checks ours on:
//   node tests/render/mikktspace.mjs > tests/render/mikktspace.csv
// A row per corner of a triangle: mesh, position, normal, texture coordinate (v down, as glTF), then
// the tangent and its sign as glTF counts it.
import { generateTangents } from
  "../../apps/viewer/node_modules/three/examples/jsm/libs/mikktspace.module.js";

// A pure function of a whole number, in [0, 1).
const noise = (i) => { const v = Math.sin(i * 12.9898) * 43758.5453; return v - Math.floor(v); };
const unit = (v) => { const l = Math.hypot(...v); return v.map((x) => x / l); };

/** A bumpy grid of quads; `uv(s, t, x, y)` lays the map. */
function grid(n, uv) {
  const corner = (x, y) => {
    const s = x / n, t = y / n, k = y * (n + 1) + x;
    return { p: [s * 2 - 1, t * 2 - 1, 0.3 * noise(k + 1)],
             n: unit([noise(k + 100) - 0.5, noise(k + 200) - 0.5, 1.5]) };
  };
  const corners = [];
  for (let y = 0; y < n; ++y) {
    for (let x = 0; x < n; ++x) {
      for (const [i, j] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]) {
        corners.push({ ...corner(x + i, y + j), t: uv((x + i) / n, (y + j) / n, x, y) });
      }
    }
  }
  return corners;
}

const meshes = {
  plain: grid(4, (s, t) => [s, 1 - t]),
  // u runs back in the right half: both signs meet along the middle.
  mirrored: grid(4, (s, t) => [Math.abs(2 * s - 1), 1 - t]),
  // The map of every other column is turned by a quarter: a seam between columns.
  seams: grid(4, (s, t, x) => (x % 2 ? [t, s] : [s, 1 - t])),
  skewed: grid(4, (s, t) => [s + 0.4 * t * t, 1 - t + 0.3 * s * t]),
};

const lines = ["mesh,px,py,pz,nx,ny,nz,u,v,tx,ty,tz,sign"];
for (const [name, corners] of Object.entries(meshes)) {
  const p = new Float32Array(corners.flatMap((c) => c.p));
  const n = new Float32Array(corners.flatMap((c) => c.n));
  const t = new Float32Array(corners.flatMap((c) => c.t));
  const tangents = generateTangents(p, n, t);
  corners.forEach((_, i) => {
    const numbers = [...p.slice(3 * i, 3 * i + 3), ...n.slice(3 * i, 3 * i + 3),
      ...t.slice(2 * i, 2 * i + 2), ...tangents.slice(4 * i, 4 * i + 3)].map((v) => v.toFixed(9));
    // Its sign is for v up; glTF's v is down.
    lines.push([name, ...numbers, -tangents[4 * i + 3]].join(","));
  });
}
console.log(lines.join("\n"));
