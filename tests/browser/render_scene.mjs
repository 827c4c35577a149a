// SPDX-License-Identifier: MIT
// What scripts/render_comparison.sh gives to every renderer: a sphere or a tilted plate as GLB, and
// surroundings as OpenEXR.   node render_scene.mjs sphere|plate|sky FILE
import { writeFileSync } from "node:fs";

/** Rings of a sphere; the map covers the front half, and the back mirrored. */
function sphere(rings = 128) {
  const m = { position: [], normal: [], tangent: [], uv: [], index: [] };
  for (const front of [1, -1]) {
    const first = m.position.length / 3;
    for (let y = 0; y <= rings; y++) {
      for (let x = 0; x <= rings; x++) {
        const a = (x / rings - 0.5) * Math.PI + (front > 0 ? 0 : Math.PI), p = y / rings * Math.PI;
        const n = [Math.sin(p) * Math.sin(a), Math.cos(p), Math.sin(p) * Math.cos(a)];
        m.position.push(...n);
        m.normal.push(...n);
        m.tangent.push(front * Math.cos(a), 0, -front * Math.sin(a), front);
        m.uv.push(front > 0 ? x / rings : 1 - x / rings, y / rings);
        if (x < rings && y < rings) {
          const i = first + y * (rings + 1) + x, j = i + rings + 1;
          m.index.push(i, j, j + 1, i, j + 1, i + 1);
        }
      }
    }
  }
  return m;
}

function plate() {
  const c = Math.cos(0.35), s = Math.sin(0.35);   // leans back
  return { position: [-1, c, -s, 1, c, -s, -1, -c, s, 1, -c, s],
    normal: [0, 1, 2, 3].flatMap(() => [0, s, c]),
    tangent: [0, 1, 2, 3].flatMap(() => [1, 0, 0, 1]),
    uv: [0, 0, 1, 0, 0, 1, 1, 1], index: [0, 2, 3, 0, 3, 1] };
}

function glb(m) {
  const parts = [new Float32Array(m.position), new Float32Array(m.normal),
    new Float32Array(m.tangent), new Float32Array(m.uv), new Uint32Array(m.index)];
  const bytes = parts.map((p) => Buffer.from(p.buffer));
  const types = ["VEC3", "VEC3", "VEC4", "VEC2", "SCALAR"], wide = [3, 3, 4, 2, 1];
  let offset = 0;
  const views = bytes.map((b) => ({ buffer: 0, byteOffset: (offset += b.length) - b.length, byteLength: b.length }));
  const axis = (pick) => [0, 1, 2].map((k) => pick(...m.position.filter((_, i) => i % 3 === k).slice(0, 60000)));
  let json = JSON.stringify({ asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, name: "object" }],
    meshes: [{ primitives: [{ indices: 4,
      attributes: { POSITION: 0, NORMAL: 1, TANGENT: 2, TEXCOORD_0: 3 } }] }],
    accessors: parts.map((p, i) => ({ bufferView: i, componentType: i === 4 ? 5125 : 5126,
      count: p.length / wide[i], type: types[i],
      ...(i === 0 ? { min: axis(Math.min), max: axis(Math.max) } : {}) })),
    bufferViews: views, buffers: [{ byteLength: offset }] });
  json += " ".repeat((4 - json.length % 4) % 4);
  const head = Buffer.alloc(20), mid = Buffer.alloc(8);
  [0x46546C67, 2, 28 + json.length + offset, json.length, 0x4E4F534A]
    .forEach((v, i) => head.writeUInt32LE(v, 4 * i));
  mid.writeUInt32LE(offset, 0);
  mid.writeUInt32LE(0x004E4942, 4);
  return Buffer.concat([head, Buffer.from(json), mid, ...bytes]);
}

/** Radiance along a direction: a dim room and three softboxes without edges. */
function room(x, y, z) {
  const box = (bx, by, bz, sharp) => {
    const l = Math.hypot(bx, by, bz);
    return Math.exp(sharp * ((x * bx + y * by + z * bz) / l - 1));
  };
  const base = 0.18 + (y < 0 ? 0.14 * -y : -0.08 * y);
  return base + 6 * box(-0.9, 0.8, 1, 14) + 5 * box(1, 0.2, 0.1, 30) + 3 * box(0.1, 1, -0.3, 12);
}

/** Uncompressed float scanlines [EXR]. */
function exr(width, height) {
  const text = (s) => Buffer.from(s + "\0");
  const u32 = (...v) => Buffer.concat(v.map((n) => { const b = Buffer.alloc(4); b.writeInt32LE(n); return b; }));
  const f32 = (v) => { const b = Buffer.alloc(4); b.writeFloatLE(v); return b; };
  const attribute = (name, type, value) =>
    Buffer.concat([text(name), text(type), u32(value.length), value]);
  const channel = (name) => Buffer.concat([text(name), u32(2, 0, 1, 1)]);
  const box = u32(0, 0, width - 1, height - 1);
  const head = Buffer.concat([u32(20000630, 2),
    attribute("channels", "chlist", Buffer.concat([..."BGR"].map(channel).concat(Buffer.from([0])))),
    attribute("compression", "compression", Buffer.from([0])),
    attribute("dataWindow", "box2i", box), attribute("displayWindow", "box2i", box),
    attribute("lineOrder", "lineOrder", Buffer.from([0])),
    attribute("pixelAspectRatio", "float", f32(1)),
    attribute("screenWindowCenter", "v2f", Buffer.concat([f32(0), f32(0)])),
    attribute("screenWindowWidth", "float", f32(1)), Buffer.from([0])]);
  const line = 12 * width, offsets = Buffer.alloc(8 * height), lines = [];
  for (let y = 0; y < height; y++) {
    offsets.writeBigUInt64LE(BigInt(head.length + 8 * height + y * (8 + line)), 8 * y);
    const row = new Float32Array(3 * width), v = Math.PI * (y + 0.5) / height;
    for (let x = 0; x < width; x++) {
      const a = 2 * Math.PI * ((x + 0.5) / width - 0.5);
      row.fill(room(Math.sin(v) * Math.cos(a), Math.cos(v), Math.sin(v) * Math.sin(a)), x, x + 1);
    }
    row.copyWithin(width, 0, width);
    row.copyWithin(2 * width, 0, width);
    lines.push(u32(y, line), Buffer.from(row.buffer));
  }
  return Buffer.concat([head, offsets, ...lines]);
}

const [what, file] = process.argv.slice(2);
writeFileSync(file, what === "sky" ? exr(512, 256) : glb(what === "sphere" ? sphere() : plate()));
