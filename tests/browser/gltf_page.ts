// SPDX-License-Identifier: MIT
// Loads a GLB with three.js' own loader, with no extension, and tells what it found.
import { Mesh, MeshStandardMaterial, type Texture } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

async function pixels(texture: Texture): Promise<number[]> {
  const image = texture.image as ImageBitmap;
  const canvas = document.createElement("canvas");
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(image, 0, 0);
  return Array.from(context.getImageData(0, 0, image.width, image.height).data);
}

/** The attributes are interleaved: read them through their accessors. */
function corners(mesh: Mesh): { y: number; v: number }[] {
  const position = mesh.geometry.getAttribute("position"), uv = mesh.geometry.getAttribute("uv");
  return Array.from({ length: position.count }, (_, i) => ({ y: position.getY(i), v: uv.getY(i) }));
}

async function load(base64: string) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer, "");
  let mesh: Mesh | undefined;
  gltf.scene.traverse((o) => { if (o instanceof Mesh) mesh = o; });
  const material = mesh!.material as MeshStandardMaterial;
  return {
    width: (material.map!.image as ImageBitmap).width,
    height: (material.map!.image as ImageBitmap).height,
    colorSpace: material.map!.colorSpace,
    sameOrm: material.roughnessMap === material.metalnessMap,
    flipped: material.map!.flipY,
    factors: [material.roughness, material.metalness],
    tangents: mesh!.geometry.getAttribute("tangent") !== undefined,
    corners: corners(mesh!),
    color: await pixels(material.map!),
    orm: await pixels(material.roughnessMap!),
    normal: await pixels(material.normalMap!),
    materials: (await gltf.parser.getDependencies("material")).length,
    variants: (gltf.parser.json.extensions?.KHR_materials_variants?.variants ?? [])
      .map((v: { name: string }) => v.name),
  };
}
(window as unknown as { load: typeof load }).load = load;
