// SPDX-License-Identifier: MIT
// One picture by three.js, of what `verdigris render --scene model.glb --light sky.exr` shows.
import { Color, EquirectangularReflectionMapping, Mesh, MeshStandardMaterial, NeutralToneMapping, NoColorSpace,
  PerspectiveCamera, PMREMGenerator, Scene, SRGBColorSpace, Texture, WebGLRenderer, DataTexture, RGBAFormat } from "three";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

const bytesOf = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer;

async function texture(base64: string, color: boolean): Promise<Texture> {
  const blob = new Blob([bytesOf(base64)], { type: "image/png" });
  const t = new Texture(await createImageBitmap(blob, { colorSpaceConversion: "none" }));
  t.colorSpace = color ? SRGBColorSpace : NoColorSpace;
  t.flipY = false;
  t.anisotropy = 8;
  t.needsUpdate = true;
  return t;
}

async function draw(given: { glb: string; sky: string; color: string; normal: string; orm: string; size: number }) {
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(given.size, given.size);
  renderer.toneMapping = NeutralToneMapping;
  const exr = new EXRLoader().parse(bytesOf(given.sky));
  const sky = new DataTexture(exr.data as never, exr.width, exr.height, RGBAFormat, exr.type);
  sky.colorSpace = exr.colorSpace ?? NoColorSpace;
  sky.mapping = EquirectangularReflectionMapping;
  // EXRLoader stores the last row first.
  sky.flipY = false;
  sky.needsUpdate = true;
  const scene = new Scene();
  scene.background = new Color(0.1, 0.1, 0.1);
  scene.environment = new PMREMGenerator(renderer).fromEquirectangular(sky).texture;
  const orm = await texture(given.orm, false);
  const material = new MeshStandardMaterial({ map: await texture(given.color, true), roughnessMap: orm,
    metalnessMap: orm, normalMap: await texture(given.normal, false), roughness: 1, metalness: 1 });
  const gltf = await new GLTFLoader().parseAsync(bytesOf(given.glb), "");
  gltf.scene.traverse((o) => { if (o instanceof Mesh) o.material = material; });
  gltf.scene.rotation.y = 0.4;
  scene.add(gltf.scene);
  gltf.scene.updateMatrixWorld();
  let radius = 0;
  gltf.scene.traverse((o) => {
    if (!(o instanceof Mesh)) return;
    o.geometry.computeBoundingSphere();
    const p = o.geometry.getAttribute("position");
    for (let i = 0; i < p.count; i++) radius = Math.max(radius, Math.hypot(p.getX(i), p.getY(i), p.getZ(i)));
  });
  gltf.scene.scale.setScalar(1 / radius);
  const camera = new PerspectiveCamera(26, 1, 0.1, 50);
  camera.position.set(0, 1.3, 5.1);
  camera.lookAt(0, 0, 0);
  renderer.render(scene, camera);
  return renderer.domElement.toDataURL("image/png");
}
(window as unknown as { draw: typeof draw }).draw = draw;
