// SPDX-License-Identifier: MIT
// The stage: three shapes under a photographer's studio, seen through Khronos PBR Neutral.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { type Bake } from "./bake";

export type Shape = "sphere" | "plane" | "curved";

/** A dark room with soft boxes: what metal needs to look like metal is something to reflect. */
function studio(): THREE.Scene {
  const room = new THREE.Scene();
  const wall = new THREE.Mesh(
    new THREE.SphereGeometry(12, 32, 16),
    new THREE.MeshBasicMaterial({ color: 0x2b2d31, side: THREE.BackSide }));
  room.add(wall);
  const floor = new THREE.Mesh(new THREE.CircleGeometry(11, 48),
    new THREE.MeshBasicMaterial({ color: 0x4a4642 }));
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -4;
  room.add(floor);
  const box = (w: number, h: number, at: [number, number, number], light: number, tint = 0xffffff) => {
    const color = new THREE.Color(tint).multiplyScalar(light);
    const panel = new THREE.Mesh(new THREE.PlaneGeometry(w, h),
      new THREE.MeshBasicMaterial({ color, side: THREE.DoubleSide, toneMapped: false }));
    panel.position.set(...at);
    panel.lookAt(0, 0, 0);
    room.add(panel);
  };
  box(7, 5, [0, 7.5, 1.5], 7);                    // overhead soft box
  box(2.2, 7, [-7.5, 1.5, 3], 8, 0xfff4e8);       // strip on the left, a little warm
  box(1.4, 6, [7.8, 1, 1.5], 7, 0xeaf2ff);        // strip on the right, a little cool
  box(5, 3, [2.5, 1.5, 8.5], 1.6);                // fill from behind the camera
  box(6, 1.2, [0, 2, -8], 3);                     // rim
  return room;
}

/** glTF's texture origin is the upper left corner: turn v around. */
function flipV(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const uv = geometry.getAttribute("uv") as THREE.BufferAttribute;
  for (let i = 0; i < uv.count; i++) uv.setY(i, 1 - uv.getY(i));
  return geometry;
}

/** The texture repeats (mirrored) so that its pixels stay about square on the shape. */
function scaleUv(geometry: THREE.BufferGeometry, u: number, v: number): THREE.BufferGeometry {
  const uv = geometry.getAttribute("uv") as THREE.BufferAttribute;
  for (let i = 0; i < uv.count; i++) uv.setXY(i, uv.getX(i) * u, uv.getY(i) * v);
  return geometry;
}

/** A sheet bent over a quarter turn and a bit: how cladding meets a corner. */
function bentSheet(aspect: number): THREE.BufferGeometry {
  const radius = 1.15, turn = 2.2, height = Math.min(2.1, (radius * turn) / aspect);
  const geometry = new THREE.PlaneGeometry(1, 1, 96, 24);
  const p = geometry.getAttribute("position") as THREE.BufferAttribute;
  for (let i = 0; i < p.count; i++) {
    const angle = p.getX(i) * turn;
    p.setXYZ(i, radius * Math.sin(angle), p.getY(i) * height, radius * (Math.cos(angle) - 0.75));
  }
  geometry.computeVertexNormals();
  return geometry;
}

export class Stage {
  readonly controls: OrbitControls;
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.1, 50);
  private readonly scene = new THREE.Scene();
  private readonly mesh: THREE.Mesh;
  private readonly geometries: Record<Shape, THREE.BufferGeometry>;
  private readonly materials = new Map<Bake, THREE.MeshStandardMaterial>();
  shape: Shape = "sphere";

  constructor(private readonly renderer: THREE.WebGLRenderer, aspect: number, onChange: () => void) {
    renderer.toneMapping = THREE.NeutralToneMapping;
    renderer.toneMappingExposure = 1.0;
    const pmrem = new THREE.PMREMGenerator(renderer);
    this.scene.environment = pmrem.fromScene(studio(), 0.012, 0.1, 50).texture;
    pmrem.dispose();
    this.scene.background = new THREE.Color(0x17181b);
    const key = new THREE.DirectionalLight(0xfff6ec, 1.4);   // grazing: shows the relief
    key.position.set(-3.5, 4, 3);
    this.scene.add(key);
    const w = aspect >= 1 ? 2.3 : 2.3 * aspect, h = w / aspect;
    // Around the sphere the image is twice its height: two mirrored copies side by side.
    this.geometries = {
      sphere: scaleUv(flipV(new THREE.SphereGeometry(1.12, 96, 64)), Math.max(1, Math.round(2 / aspect)), 1),
      plane: flipV(new THREE.PlaneGeometry(w, h)),
      curved: flipV(bentSheet(aspect)),
    };
    this.mesh = new THREE.Mesh(this.geometries.sphere);
    this.mesh.rotation.y = -0.6;
    this.scene.add(this.mesh);
    this.camera.position.set(0.4, 0.5, 4.9);
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.enablePan = false;
    this.controls.minDistance = 1.6;
    this.controls.maxDistance = 9;
    this.controls.addEventListener("change", onChange);
    this.controls.update();
  }

  setShape(shape: Shape): void {
    this.shape = shape;
    this.mesh.geometry = this.geometries[shape];
    this.mesh.rotation.y = shape === "sphere" ? -0.6 : 0;
    this.camera.position.set(shape === "plane" ? 0.7 : 0.4, shape === "plane" ? 0.35 : 0.5, 4.9);
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
    this.camera.aspect = width / height;
    // On a narrow screen the shape must still fit across.
    this.camera.fov = this.camera.aspect < 1 ? Math.min(32 / this.camera.aspect, 60) : 32;
    this.camera.updateProjectionMatrix();
  }

  draw(bake: Bake): void {
    this.mesh.material = this.materialOf(bake);
    this.renderer.render(this.scene, this.camera);
  }

  private materialOf(bake: Bake): THREE.MeshStandardMaterial {
    let material = this.materials.get(bake);
    if (!material) {
      material = new THREE.MeshStandardMaterial({
        map: bake.albedo.texture, normalMap: bake.normal.texture,
        roughnessMap: bake.orm.texture, metalnessMap: bake.orm.texture,
        roughness: 1, metalness: 1, envMapIntensity: 1, side: THREE.DoubleSide,
        // The normal map is +Y up while v points down, as in glTF.
        normalScale: new THREE.Vector2(1, -1),
      });
      this.materials.set(bake, material);
    }
    return material;
  }
}
