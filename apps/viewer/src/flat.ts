// SPDX-License-Identifier: MIT
// One map, flat: as large as fits, or nearer.
import * as THREE from "three";
import { type Bake } from "./bake";
import { type ViewerDocument } from "./data";
import { flatFragment, flatVertex } from "./flat_shaders";
import { type Overlay } from "./uncertainty";

export const kMaps = ["lit", "albedo", "normal", "roughness", "metallic", "height", "coverage",
  "uncertainty"] as const;
export type MapView = (typeof kMaps)[number];

/** Those that a document has. */
export function mapsOf(doc: ViewerDocument): readonly MapView[] {
  return doc.spread ? kMaps : kMaps.filter((name) => name !== "uncertainty");
}

/** How to read a map. `scale`: what its two ends mean, for those that are one number. */
const kMapNotes: Record<MapView, { note: string; scale?: [string, string] }> = {
  lit: { note: "" },
  albedo: { note: "The frame itself; the light it was recorded in is still in it." },
  normal: { note: "Which way the surface faces: red to the right, green up." },
  roughness: { note: "", scale: ["mirror-smooth", "matte"] },
  metallic: { note: "", scale: ["patina", "bare metal"] },
  height: { note: "", scale: ["low", "high (relative)"] },
  coverage: { note: "", scale: ["as observed", "fully changed"] },
  uncertainty: { note: "" },   // in numbers: legend.ts
};

export function mapNote(view: MapView, observedIsClean: boolean): { note: string; scale?: [string, string] } {
  // Where the clean state is the start, what was observed since counts as change too.
  if (view === "coverage" && !observedIsClean) return { note: "", scale: ["as at the start", "fully changed"] };
  return kMapNotes[view];
}

const kNearest = 32;        // chosen: a texel of a 256-pixel map is then about 100 screen pixels
const kShowTexels = 5;      // screen pixels per texel from which texels are shown as squares

export class FlatView {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly scale = new THREE.Vector2();
  private readonly shift = new THREE.Vector2();   // what the hand moved
  private readonly place = new THREE.Vector2();
  private readonly material: THREE.RawShaderMaterial;
  private readonly fit = new THREE.Vector2(1, 1);
  private zoom = 1;
  private lift = 0;   // of the middle of the free space over that of the stage, -1 to 1 across it

  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly aspect: number,
              private readonly texelsAcross: number, overlay: Overlay) {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: flatVertex, fragmentShader: flatFragment,
      uniforms: { u_albedo: { value: null }, u_coverage: { value: null }, u_orm: { value: null },
        u_normal: { value: null }, u_map: { value: 0 }, u_texels: { value: false },
        u_scale: { value: this.scale }, u_shift: { value: this.place },
        u_unsure: { value: null }, ...overlay },
      depthTest: false, depthWrite: false,
    });
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.material);
    quad.frustumCulled = false;
    this.scene.add(quad);
  }

  /** `below`: where the legend begins, in pixels from the bottom of the stage. */
  draw(bake: Bake, view: MapView, width: number, height: number, below: number): void {
    // Room for the legend below and the badge above: 52 pixels each, or what the legend takes.
    const above = 52, room = Math.max(above, below + 12);
    const tall = Math.max(1 - (above + room) / height, 0.4), wide = 0.94;
    this.lift = Math.min((room - above) / height, 1 - tall);
    const across = Math.min(wide, (tall * height * this.aspect) / width);
    this.fit.set(across, (across * width) / this.aspect / height);
    this.scale.copy(this.fit).multiplyScalar(this.zoom);
    this.keepInSight();
    this.place.set(this.shift.x, this.shift.y + this.lift);
    const u = this.material.uniforms;
    u.u_albedo!.value = bake.albedo.texture;
    u.u_coverage!.value = bake.frame.texture;
    u.u_orm!.value = bake.orm.texture;
    u.u_normal!.value = bake.normal.texture;
    u.u_unsure!.value = bake.unsure?.texture ?? null;
    u.u_map!.value = kMaps.indexOf(view);
    u.u_texels!.value = (this.scale.x * width) / this.texelsAcross > kShowTexels;
    this.renderer.render(this.scene, this.camera);
  }

  /** Nearer by `factor`, keeping the point at (x, y) in place: -1 to 1 across the stage, y up. */
  zoomAt(factor: number, x: number, y: number): void {
    const before = this.zoom;
    this.zoom = Math.min(Math.max(before * factor, 1), kNearest);
    const by = this.zoom / before;
    const up = y - this.lift;
    this.shift.set(x + (this.shift.x - x) * by, up + (this.shift.y - up) * by);
  }
  /** In the same units. */
  pan(dx: number, dy: number): void { this.shift.add({ x: dx, y: dy }); }
  reset(): void {
    this.zoom = 1;
    this.shift.set(0, 0);
  }

  private keepInSight(): void {
    for (const k of ["x", "y"] as const) {
      const room = Math.max(this.fit[k] * this.zoom - 0.92, 0);
      this.shift[k] = Math.min(Math.max(this.shift[k], -room), room);
    }
  }
}
