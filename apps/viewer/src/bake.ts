// SPDX-License-Identifier: MIT
// Bakes the maps of one age into textures: a few full-screen passes, run only when the age changes.
// Float where the device can draw to it (EXT_color_buffer_float: nearly all), else half, else bytes.
import * as THREE from "three";
import { type MaterialConstants } from "./data";
import { lawAt } from "./law";
import { type Specimen } from "./specimen";
import * as shaders from "./shaders";
import { kHalfWidth80, variances } from "./uncertainty";
import { unsureMap } from "./uncertainty_shaders";

/** The maps that can be read back or looked at flat. */
export type MapName = "albedo" | "normal" | "roughness" | "metallic" | "height" | "coverage" | "uncertainty";

type Uniforms = Record<string, THREE.IUniform>;

function pass(fragmentShader: string, uniforms: Uniforms): THREE.RawShaderMaterial {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: shaders.vertex, fragmentShader, uniforms,
    depthTest: false, depthWrite: false, blending: THREE.NoBlending,
  });
}

const triangle = new THREE.BufferGeometry().setAttribute(
  "position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));

/** What this device can draw into. Maps in half float: 8-bit normals show as steps on bare metal. */
function drawable(renderer: THREE.WebGLRenderer):
    { float: THREE.TextureDataType; map: THREE.TextureDataType } {
  if (renderer.extensions.has("EXT_color_buffer_float")) {
    return { float: THREE.FloatType, map: THREE.HalfFloatType };
  }
  const half = renderer.extensions.has("EXT_color_buffer_half_float");
  const type = half ? THREE.HalfFloatType : THREE.UnsignedByteType;
  return { float: type, map: type };
}

export class Bake {
  /** What a MeshStandardMaterial reads. */
  readonly albedo: THREE.WebGLRenderTarget;
  readonly normal: THREE.WebGLRenderTarget;
  readonly orm: THREE.WebGLRenderTarget;
  /** X and coverage, encoded sRGB, float. */
  readonly frame: THREE.WebGLRenderTarget;
  /** Where the forecaster says how far off it may be; drawn only when asked for. */
  readonly unsure: THREE.WebGLRenderTarget | null = null;
  age = Number.NaN;

  private readonly float: THREE.TextureDataType;
  private readonly across: THREE.WebGLRenderTarget;
  private readonly height: THREE.WebGLRenderTarget;
  private readonly low: THREE.WebGLRenderTarget;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly mesh = new THREE.Mesh(triangle);
  private readonly size: THREE.Vector2;
  private readonly law: THREE.RawShaderMaterial;
  private readonly stack: THREE.RawShaderMaterial;
  private readonly observed: THREE.RawShaderMaterial;
  private readonly chain: [THREE.RawShaderMaterial, THREE.WebGLRenderTarget][];
  private readonly albedoPass: THREE.RawShaderMaterial;
  private readonly normalPass: THREE.RawShaderMaterial;
  private readonly ormPass: THREE.RawShaderMaterial;
  private readonly unsurePass: THREE.RawShaderMaterial | null = null;
  private unsureAge = Number.NaN;

  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly specimen: Specimen) {
    const { width, height } = specimen;
    const m: MaterialConstants = specimen.document.material;
    this.size = new THREE.Vector2(width, height);
    const { float, map } = drawable(renderer);
    this.float = float;
    const albedoSpace = map === THREE.UnsignedByteType ? THREE.SRGBColorSpace : THREE.NoColorSpace;
    this.frame = this.data();
    this.across = this.data();
    this.height = this.data();
    this.low = this.data();
    this.albedo = this.map(map, albedoSpace);
    this.normal = this.map(map, THREE.NoColorSpace);
    this.orm = this.map(map, THREE.NoColorSpace);

    const covered: Uniforms = {
      u_canvas: { value: specimen.canvas }, u_zone: { value: specimen.zone },
      u_normalizer: { value: m.normalizer }, u_exponent: { value: m.coverage_exponent },
    };
    const trajectory = specimen.document.trajectory;
    const reach = trajectory.kind === "law" ? trajectory.context - 1 : 0;
    this.law = pass(shaders.lawFrame, {
      ...covered, u_base: { value: specimen.base }, u_rate: { value: specimen.rate },
      u_curvature: { value: specimen.curvature }, u_horizon: { value: 0 },
      u_reach: { value: reach },
      u_order: { value: trajectory.kind === "law" ? trajectory.order : 0 },
      u_clamp: { value: trajectory.kind === "law" && trajectory.clamp },
      u_tabulated: { value: trajectory.kind === "law" && !!trajectory.nodes },
      u_phi: { value: new THREE.Vector2() },
    });
    const mix = () => ({ u_from: { value: null }, u_to: { value: null }, u_mix: { value: 0 } });
    this.stack = pass(shaders.stackFrame, { ...covered, ...mix() });
    this.observed = pass(shaders.observedFrame, mix());

    const size = { u_size: { value: this.size } };
    const frame = { u_frame: { value: this.frame.texture } };
    const micro = { u_sigma: { value: m.micro_sigma } };
    const luma = { u_sigma: { value: m.height_sigma } };
    const step = (x: number, y: number) => ({ u_step: { value: new THREE.Vector2(x, y) } });
    this.chain = [
      [pass(shaders.lumaAcross, { ...frame, ...size, ...luma, u_canvas: { value: specimen.canvas } }),
        this.across],
      [pass(shaders.heightDown, { ...frame, ...size, ...luma,
        u_across: { value: this.across.texture }, u_weight: { value: m.height_patina_weight } }),
        this.height],
      [pass(shaders.blur, { ...size, ...micro, ...step(1, 0),
        u_source: { value: this.height.texture } }), this.across],
      [pass(shaders.blur, { ...size, ...micro, ...step(0, 1),
        u_source: { value: this.across.texture } }), this.low],
    ];
    this.albedoPass = pass(shaders.albedoMap, frame);
    this.normalPass = pass(shaders.normalMap, { ...size, u_height: { value: this.height.texture },
      u_scale: { value: m.normal_scale * m.normal_gain / 8 } });
    this.ormPass = pass(shaders.ormMap, { ...frame, u_height: { value: this.height.texture },
      u_low: { value: this.low.texture }, u_zone: { value: specimen.zone },
      u_rough: { value: new THREE.Vector3(m.roughness_clean, m.roughness_patina, m.roughness_gamma) },
      u_metal: { value: new THREE.Vector3(m.metallic_clean, m.metallic_patina, m.metallic_gamma) },
      u_micro: { value: m.micro_roughness }, u_range: { value: m.micro_range } });
    const spread = specimen.document.spread;
    if (spread && specimen.share) {
      this.unsure = this.map(map, THREE.NoColorSpace);
      this.unsurePass = pass(unsureMap, { u_share: { value: specimen.share },
        u_variance: { value: new THREE.Vector2() }, u_half: { value: kHalfWidth80 },
        u_full: { value: spread.full_codes / 255 } });
    }
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** Units from the last observed frame: negative is observed, positive is forecast. */
  bake(age: number): void {
    if (age === this.age) return;
    this.age = age;
    this.draw(this.framePass(age), this.frame);
    for (const [material, target] of this.chain) this.draw(material, target);
    this.draw(this.albedoPass, this.albedo);
    this.draw(this.normalPass, this.normal);
    this.draw(this.ormPass, this.orm);
  }

  /** Half widths at the age last baked. Apart from bake(): who does not look does not wait. */
  bakeUncertainty(): void {
    if (!this.unsure || this.age === this.unsureAge) return;
    this.unsureAge = this.age;
    this.draw(this.unsureAt(this.age), this.unsure);
  }

  /** Full-resolution floats of a map at the age last baked, row 0 on top. */
  read(name: MapName): { width: number; height: number; channels: number; data: Float32Array } {
    const { x: width, y: height } = this.size;
    const first = { albedo: 0, normal: 0, roughness: 1, metallic: 2, height: 3, coverage: 3, uncertainty: 0 }[name];
    const channels = name === "albedo" || name === "normal" ? 3 : 1;
    const rgba = name === "albedo" || name === "coverage" ? this.pixels(this.frame)
      : name === "normal" ? this.redrawn(this.normalPass)
      : name === "uncertainty" ? this.redrawn(this.unsureAt(this.age)) : this.redrawn(this.ormPass);
    const unpack = name === "normal" ? (v: number) => v * 2 - 1 : (v: number) => v;
    const out = new Float32Array(width * height * channels);
    for (let i = 0; i < width * height; i++) {
      for (let k = 0; k < channels; k++) out[i * channels + k] = unpack(rgba[i * 4 + first + k]!);
    }
    return { width, height, channels, data: out };
  }

  private unsureAt(age: number): THREE.RawShaderMaterial {
    const spread = this.specimen.document.spread;
    if (!spread || !this.unsurePass) throw new Error("This forecast does not say how far off it may be.");
    (this.unsurePass.uniforms.u_variance!.value as THREE.Vector2).fromArray(variances(spread, age));
    return this.unsurePass;
  }

  /** A map once more in the type of the data: the textures are made for looking at. */
  private redrawn(material: THREE.RawShaderMaterial): Float32Array {
    const target = this.data();
    try {
      this.draw(material, target);
      return this.pixels(target);
    } finally {
      target.dispose();
    }
  }

  private pixels(target: THREE.WebGLRenderTarget): Float32Array {
    const { x: width, y: height } = this.size, n = width * height * 4;
    const read = (into: Float32Array | Uint16Array | Uint8Array) =>
      this.renderer.readRenderTargetPixels(target, 0, 0, width, height, into);
    if (this.float === THREE.FloatType) {
      const out = new Float32Array(n);
      read(out);
      return out;
    }
    const codes = this.float === THREE.HalfFloatType ? new Uint16Array(n) : new Uint8Array(n);
    read(codes);
    return Float32Array.from(codes, (c) =>
      codes instanceof Uint16Array ? THREE.DataUtils.fromHalfFloat(c) : c / 255);
  }

  private data(): THREE.WebGLRenderTarget {
    return new THREE.WebGLRenderTarget(this.size.x, this.size.y, {
      type: this.float, format: THREE.RGBAFormat, minFilter: THREE.NearestFilter,
      magFilter: THREE.NearestFilter, depthBuffer: false, generateMipmaps: false,
    });
  }

  private map(type: THREE.TextureDataType, colorSpace: THREE.ColorSpace): THREE.WebGLRenderTarget {
    const target = new THREE.WebGLRenderTarget(this.size.x, this.size.y, {
      type, format: THREE.RGBAFormat, depthBuffer: false, generateMipmaps: true, colorSpace,
      minFilter: THREE.LinearMipmapLinearFilter, magFilter: THREE.LinearFilter,
      anisotropy: Math.min(8, this.renderer.capabilities.getMaxAnisotropy()),
    });
    target.texture.wrapS = target.texture.wrapT = THREE.MirroredRepeatWrapping;
    return target;
  }

  private framePass(age: number): THREE.RawShaderMaterial {
    const between = age < 0 ? this.specimen.observedAt(age) : this.specimen.framesAt(age);
    if (!between) {
      this.law.uniforms.u_horizon!.value = Math.max(age, 0);
      const law = this.specimen.document.trajectory;
      if (law.kind === "law" && law.nodes) {
        (this.law.uniforms.u_phi!.value as THREE.Vector2).fromArray(lawAt(law.nodes, Math.max(age, 0)));
      }
      return this.law;
    }
    // Where the start of the recording is the clean state, observed frames carry coverage too.
    const clean = this.specimen.document.material.observed_is_clean;
    const material = age < 0 && clean ? this.observed : this.stack;
    material.uniforms.u_from!.value = between.from;
    material.uniforms.u_to!.value = between.to;
    material.uniforms.u_mix!.value = between.mix;
    return material;
  }

  private draw(material: THREE.Material, target: THREE.WebGLRenderTarget): void {
    this.mesh.material = material;
    const before = this.renderer.getRenderTarget();
    const scissor = this.renderer.getScissorTest();
    this.renderer.setScissorTest(false);
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene, this.camera);
    this.renderer.setRenderTarget(before);
    this.renderer.setScissorTest(scissor);
  }
}
