// SPDX-License-Identifier: MIT
// What the metal reflects. A photographer lights metal with large soft boxes and lets the rest go
// dark; a surface that reflects an even room looks like plastic. All intensities chosen by eye on
// bare copper (roughness 0.16) and on matte patina.
import * as THREE from "three";

const roomVertex = `
varying vec3 v_at;
void main() { v_at = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }
`;
/** Dim walls that brighten upward, a warm floor that brightens toward the object. */
const roomFragment = `
varying vec3 v_at;
void main() {
  vec3 d = normalize(v_at);
  vec3 wall = mix(vec3(0.035, 0.037, 0.042), vec3(0.20, 0.21, 0.225), smoothstep(-0.15, 0.9, d.y));
  vec3 floor_ = mix(vec3(0.05, 0.045, 0.04), vec3(0.30, 0.27, 0.24), smoothstep(-0.25, -0.95, d.y));
  gl_FragColor = vec4(d.y < -0.12 ? mix(wall, floor_, smoothstep(-0.12, -0.3, d.y)) : wall, 1.0);
}
`;
const boxVertex = `
varying vec2 v_uv;
void main() { v_uv = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }
`;
/** A soft box is brightest in the middle and has a soft rim: so does its reflection. */
const boxFragment = `
varying vec2 v_uv;
uniform vec3 u_light;
void main() {
  vec2 e = smoothstep(0.0, 0.16, v_uv) * smoothstep(0.0, 0.16, 1.0 - v_uv);
  vec2 c = v_uv - 0.5;
  gl_FragColor = vec4(u_light * (1.0 - 0.9 * dot(c, c)), e.x * e.y);
}
`;

interface SoftBox { size: [number, number]; at: [number, number, number]; light: number; tint: number }
const kBoxes: SoftBox[] = [
  { size: [8, 5], at: [0, 7.6, 1.0], light: 7, tint: 0xffffff },         // overhead
  { size: [2.6, 9], at: [-7.4, 1.2, 3.4], light: 8.5, tint: 0xfff1e2 },  // key strip, a little warm
  { size: [1.3, 8], at: [7.6, 0.8, 1.0], light: 8, tint: 0xe8f1ff },     // edge strip, a little cool
  { size: [6, 4], at: [3.2, 2.4, 8.2], light: 1.3, tint: 0xffffff },     // fill, behind the camera
  { size: [9, 1.6], at: [0, 2.6, -8.2], light: 4, tint: 0xf4f7ff },      // rim
  { size: [7, 5], at: [-4.2, -1.4, 7.4], light: 0.8, tint: 0xffffff },    // what a sheet met at an angle mirrors
  { size: [5, 1.4], at: [-2, -4.6, 6.6], light: 0.9, tint: 0xffe9d6 },   // reflector on the floor
];

function studioRoom(): THREE.Scene {
  const room = new THREE.Scene();
  room.add(new THREE.Mesh(new THREE.SphereGeometry(12, 48, 32), new THREE.ShaderMaterial({
    vertexShader: roomVertex, fragmentShader: roomFragment, side: THREE.BackSide,
    toneMapped: false, depthWrite: false })));
  for (const { size, at, light, tint } of kBoxes) {
    const panel = new THREE.Mesh(new THREE.PlaneGeometry(...size), new THREE.ShaderMaterial({
      vertexShader: boxVertex, fragmentShader: boxFragment, transparent: true, toneMapped: false,
      side: THREE.DoubleSide, depthWrite: false,
      uniforms: { u_light: { value: new THREE.Color(tint).multiplyScalar(light) } } }));
    panel.position.set(...at);
    panel.lookAt(0, 0, 0);
    room.add(panel);
  }
  return room;
}

/** The soft boxes as an environment, a key light that grazes the relief, and a shadow below. */
export class Studio {
  private readonly key = new THREE.DirectionalLight(0xfff4e6, 1.1);
  private readonly shadow: THREE.Mesh;
  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly scene: THREE.Scene) {
    scene.add(this.key);
    this.shadow = new THREE.Mesh(new THREE.PlaneGeometry(5, 5), new THREE.ShaderMaterial({
      vertexShader: boxVertex, transparent: true, depthWrite: false, toneMapped: false,
      fragmentShader: `varying vec2 v_uv;
        void main() { float r = 2.0 * length(v_uv - 0.5);
          gl_FragColor = vec4(0.0, 0.0, 0.0, 0.62 * pow(max(1.0 - r, 0.0), 2.0)); }` }));
    this.shadow.rotation.x = -Math.PI / 2;   // one-sided: from below it is not in the way
    scene.add(this.shadow);
    this.turn(0);
  }

  /** Before the first picture. The costliest step of the start, so a page without a stage skips it. */
  setUp(): void {
    if (this.scene.environment) return;
    const pmrem = new THREE.PMREMGenerator(this.renderer);
    // chosen: 0.006 rad of blur removes the cube map's stairs from a mirror-like reflection.
    this.scene.environment = pmrem.fromScene(studioRoom(), 0.006, 0.1, 50).texture;
    pmrem.dispose();
  }

  /** Turns all lights around the object; radians. */
  turn(angle: number): void {
    this.scene.environmentRotation.y = angle;
    this.key.position.set(-3.5, 4, 3).applyAxisAngle(new THREE.Vector3(0, 1, 0), angle);
  }

  /** Puts the shadow under an object that ends at `y` and is `width` x `depth`. */
  ground(y: number, width: number, depth: number): void {
    this.shadow.position.y = y - 0.03;
    this.shadow.scale.set(width / 2.6, depth / 2.6, 1);
  }
}
