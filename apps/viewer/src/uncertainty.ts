// SPDX-License-Identifier: MIT
// How far off each pixel may be, as a map and over the material.
import * as THREE from "three";
import { type SpreadDocument } from "./data";
import { lawAt } from "./law";
import { magmaTexture } from "./magma";
import { laidOver } from "./uncertainty_shaders";

/** Half width of the nominal 80 % interval in standard deviations: two-sided, Student's t with 5
 * degrees of freedom at unit variance. */
export const kHalfWidth80 = 1.1432148684060779;

/** What all pixels share (mean of the channels) and what each has for itself, at an age. */
export function variances(spread: SpreadDocument, age: number): [number, number] {
  if (!(age > 0)) return [0, 0];   // observed: nothing is forecast
  const channels = (spread.common[0] + spread.common[1] + spread.common[2]) / 3;
  const [common, own] = lawAt(spread.nodes, age);
  return [channels * common, own];
}

/** What the flat view and the materials share. */
export interface Overlay {
  u_magma: THREE.IUniform<THREE.Texture>;
  u_over: THREE.IUniform<number>;   // 1 where the map is laid over the material, else 0
}

export function makeOverlay(): Overlay {
  return { u_magma: { value: magmaTexture() }, u_over: { value: 0 } };
}

/** Lays the map over what is lit, as paint that no light changes: its colors are those of the legend. */
export function paintOver(material: THREE.MeshStandardMaterial, overlay: Overlay, map: THREE.Texture): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, overlay, { u_unsure: { value: map } });
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${laidOver}\nvoid main() {`)
      .replace("#include <opaque_fragment>",
        "outgoingLight = laid_over(outgoingLight, texture2D(u_unsure, vMapUv));\n#include <opaque_fragment>");
  };
}
