// SPDX-License-Identifier: MIT
// One map, flat, as large as fits.
import * as THREE from "three";
import { type Bake } from "./bake";
import { flatFragment, flatVertex } from "./shaders";

export const kMaps = ["lit", "albedo", "normal", "roughness", "metallic", "height", "coverage"] as const;
export type MapView = (typeof kMaps)[number];

export class FlatView {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: flatVertex, fragmentShader: flatFragment,
    uniforms: { u_frame: { value: null }, u_orm: { value: null }, u_normal: { value: null },
      u_map: { value: 0 }, u_fit: { value: new THREE.Vector2(1, 1) } },
    depthTest: false, depthWrite: false,
  });

  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly aspect: number) {
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.material);
    quad.frustumCulled = false;
    this.scene.add(quad);
    this.scene.background = new THREE.Color(0x17181b);
  }

  draw(bake: Bake, view: MapView, stageAspect: number): void {
    const u = this.material.uniforms;
    u.u_frame!.value = bake.frame.texture;
    u.u_orm!.value = bake.orm.texture;
    u.u_normal!.value = bake.normal.texture;
    u.u_map!.value = kMaps.indexOf(view);
    const fit = this.aspect / stageAspect, margin = 0.92;
    (u.u_fit!.value as THREE.Vector2).set(
      fit > 1 ? margin : margin * fit, fit > 1 ? margin / fit : margin);
    this.renderer.render(this.scene, this.camera);
  }
}
