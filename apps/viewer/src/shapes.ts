// SPDX-License-Identifier: MIT
// What the material is put on. None of them stretches the image: the sphere shows it once in front
// and mirrored behind, the sheets follow it along their length.
import * as THREE from "three";

export type Shape = "sphere" | "plane" | "curved";
export const kShapes: readonly Shape[] = ["sphere", "plane", "curved"];

const kRadius = 1.12;

/**
 * The front half-sphere seen along z is a disc; the disc is the middle of the image, at equal
 * distances from its center (azimuthal equidistant: true in the middle, pi/2 wider at the rim).
 * The back half carries the same, so the image meets itself at the rim: no seam, no pole.
 */
function sphere(aspect: number): THREE.BufferGeometry {
  const geometry = new THREE.SphereGeometry(kRadius, 160, 100);   // even: the rim lies on vertices
  const p = geometry.getAttribute("position") as THREE.BufferAttribute;
  const uv = geometry.getAttribute("uv") as THREE.BufferAttribute;
  for (let i = 0; i < p.count; i++) {
    const x = p.getX(i) / kRadius, y = p.getY(i) / kRadius, z = Math.abs(p.getZ(i)) / kRadius;
    const across = Math.hypot(x, y);
    const r = Math.atan2(across, z) / Math.PI;   // 0 in the middle, 0.5 at the rim
    const u = across > 0 ? (r * x) / across : 0, v = across > 0 ? (r * y) / across : 0;
    uv.setXY(i, 0.5 + u / Math.max(aspect, 1), 0.5 - v * Math.min(aspect, 1));
  }
  return geometry;
}

/** Where a sheet is at arc length s in [0, 1], and its tangent angle there. */
type Profile = (s: number) => { x: number; z: number; angle: number };

/** Integrates a tangent angle along a length into a centered curve. */
function profileOf(angle: (s: number) => number, length: number, steps: number): Profile {
  const xs = [0], zs = [0];
  for (let i = 0; i < steps; i++) {
    const a = angle((i + 0.5) / steps);
    xs.push(xs[i]! + (Math.cos(a) * length) / steps);
    zs.push(zs[i]! + (Math.sin(a) * length) / steps);
  }
  const cx = xs[steps]! / 2, cz = (Math.max(...zs) + Math.min(...zs)) / 2;
  return (s) => {
    const t = Math.min(Math.max(s, 0), 1) * steps, i = Math.min(Math.floor(t), steps - 1), f = t - i;
    return { x: xs[i]! * (1 - f) + xs[i + 1]! * f - cx, z: zs[i]! * (1 - f) + zs[i + 1]! * f - cz,
      angle: angle(s) };
  };
}

/**
 * A sheet of metal with a rounded border. Rows and columns run over front and rim: parameter t in
 * [0, 1] is the face, what lies outside bends back around the border.
 */
function sheet(profile: Profile, length: number, height: number, columns: number): THREE.BufferGeometry {
  const radius = 0.022, arc = 5;   // chosen: a rim that catches light and is no frame
  const line = (cells: number) => [
    ...Array.from({ length: arc }, (_, i) => ({ t: 0, bend: -((arc - i) / arc) * Math.PI })),
    ...Array.from({ length: cells + 1 }, (_, i) => ({ t: i / cells, bend: 0 })),
    ...Array.from({ length: arc }, (_, i) => ({ t: 1, bend: ((i + 1) / arc) * Math.PI }))];
  const across = line(columns), down = line(24);
  const position: number[] = [], normal: number[] = [], uv: number[] = [], index: number[] = [];
  for (const { t: v, bend: tilt } of down) {
    for (const { t: s, bend } of across) {
      const { x, z, angle } = profile(s), nx = -Math.sin(angle), nz = Math.cos(angle);
      // Around the border the normal swings from the face's to the outward direction to the back's.
      const a = Math.abs(bend) > 0 ? bend : 0, b = Math.abs(tilt) > 0 ? tilt : 0;
      const face = Math.min(Math.cos(a), Math.cos(b));
      const out = Math.sin(a) * (b === 0 ? 1 : Math.abs(Math.cos(b / 2)));
      const low = Math.sin(b) * (a === 0 ? 1 : Math.abs(Math.cos(a / 2)));
      const n = new THREE.Vector3(face * nx + out * Math.cos(angle), -low, face * nz + out * Math.sin(angle));
      const depth = face - 1;
      position.push(x + radius * (depth * nx + out * Math.cos(angle)), (0.5 - v) * height - radius * low,
        z + radius * (depth * nz + out * Math.sin(angle)));
      n.normalize();
      normal.push(n.x, n.y, n.z);
      uv.push(s + (bend * radius) / length, v + (tilt * radius) / height);
    }
  }
  const w = across.length;
  for (let j = 0; j + 1 < down.length; j++) for (let i = 0; i + 1 < w; i++) {
    const q = j * w + i;
    index.push(q, q + w, q + 1, q + w, q + w + 1, q + 1);
  }
  const back = position.length / 3;   // the other side, from border to border
  for (const [j, v] of [[0, 0], [1, 1]] as const) for (let i = 0; i <= columns; i++) {
    const { x, z, angle } = profile(i / columns), nx = -Math.sin(angle), nz = Math.cos(angle);
    position.push(x - 2 * radius * nx, (0.5 - v) * height, z - 2 * radius * nz);
    normal.push(-nx, 0, -nz);
    uv.push(i / columns, v);
    if (j === 0 && i < columns) {
      const q = back + i, r = q + columns + 1;
      index.push(q, q + 1, r, r, q + 1, r + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uv, 2));
  geometry.setIndex(index);
  return geometry;
}

export function makeShape(shape: Shape, aspect: number): THREE.BufferGeometry {
  if (shape === "sphere") return sphere(aspect);
  const length = aspect >= 1 ? 2.3 : 2.3 * aspect, height = length / aspect;
  if (shape === "plane") return sheet(profileOf(() => 0, length, 1), length, height, 24);
  // An S, as cladding sweeps around a building: convex and hollow in one piece.
  const by = Math.min(1.18, 2.1 / height);   // the bend takes a fifth of the width
  const wave = profileOf((s) => 0.95 * Math.cos(2 * Math.PI * (s - 0.08)), length * by, 96);
  return sheet(wave, length * by, height * by, 96);
}
