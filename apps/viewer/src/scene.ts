// SPDX-License-Identifier: MIT
// The stage: the material on a shape in the studio, seen through Khronos PBR Neutral.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { type Bake } from "./bake";
import { type Shape, makeShape } from "./shapes";
import { Studio } from "./studio";
import { type Overlay, paintOver } from "./uncertainty";

export class Stage {
  readonly controls: OrbitControls;
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.1, 50);
  readonly studio: Studio;
  private readonly scene = new THREE.Scene();
  private readonly mesh = new THREE.Mesh();
  private readonly geometries = new Map<Shape, THREE.BufferGeometry>();
  private readonly size = new THREE.Vector2(1, 1);
  private below = 0;
  private readonly materials = new Map<Bake, THREE.MeshStandardMaterial>();

  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly aspect: number,
              private readonly overlay: Overlay, onChange: () => void) {
    renderer.toneMapping = THREE.NeutralToneMapping;
    renderer.toneMappingExposure = 1.0;
    this.studio = new Studio(renderer, this.scene);
    this.scene.add(this.mesh);
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.enablePan = false;
    this.controls.minDistance = 1.6;
    this.controls.maxDistance = 9;
    this.setShape("sphere");
    this.controls.addEventListener("change", onChange);
  }

  setShape(shape: Shape): void {
    const geometry = this.geometries.get(shape) ?? makeShape(shape, this.aspect);
    this.geometries.set(shape, geometry);
    this.mesh.geometry = geometry;
    geometry.computeBoundingBox();
    const size = geometry.boundingBox!.getSize(new THREE.Vector3());
    this.studio.ground(geometry.boundingBox!.min.y, size.x, Math.max(size.z, 0.8));
    // A flat mirror is dull head on, so the sheets are met at an angle.
    const at = { sphere: [0.5, 0.55, 4.85], plane: [1.5, 0.7, 4.6], curved: [1.15, 1.0, 4.75] }[shape];
    this.camera.position.set(at[0]!, at[1]!, at[2]!);
    this.controls.update();
  }

  turn(around: number, up: number): void {
    const offset = new THREE.Spherical().setFromVector3(this.camera.position);
    offset.theta += around;
    offset.phi = Math.min(Math.max(offset.phi - up, 0.15), Math.PI - 0.15);
    this.camera.position.setFromSpherical(offset);
    this.controls.update();
  }

  resize(width: number, height: number): void {
    this.size.set(width, height);
    this.fit(this.below);
  }

  /** The shape stands above a legend that takes `below` pixels from the bottom. */
  private fit(below: number): void {
    const { x: width, y: height } = this.size, free = Math.max(height - below, height / 2);
    this.below = below;
    this.camera.aspect = width / height;
    // On a narrow screen the shape must still fit across.
    const fov = this.camera.aspect < 1 ? Math.min(32 / this.camera.aspect, 60) : 32;
    const half = Math.tan(THREE.MathUtils.degToRad(fov / 2));
    // Where there is room beside it, what the legend takes from the height is taken from the size.
    const smaller = Math.max(Math.min(height, width) / Math.min(free, width), 1);
    this.camera.fov = THREE.MathUtils.radToDeg(2 * Math.atan(half * smaller));
    this.camera.setViewOffset(width, height, 0, (height - free) / 2, width, height);
  }

  draw(bake: Bake, below: number): void {
    if (below !== this.below) this.fit(below);
    this.studio.setUp();
    this.mesh.material = this.materialOf(bake);
    this.renderer.render(this.scene, this.camera);
  }

  private materialOf(bake: Bake): THREE.MeshStandardMaterial {
    let material = this.materials.get(bake);
    if (!material) {
      material = new THREE.MeshStandardMaterial({
        map: bake.albedo.texture, normalMap: bake.normal.texture,
        roughnessMap: bake.orm.texture, metalnessMap: bake.orm.texture,
        roughness: 1, metalness: 1,
        // The normal map is +Y up while v points down, as in glTF.
        normalScale: new THREE.Vector2(1, -1),
      });
      if (bake.unsure) paintOver(material, this.overlay, bake.unsure.texture);
      this.materials.set(bake, material);
    }
    return material;
  }
}
