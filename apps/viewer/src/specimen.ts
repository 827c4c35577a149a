// SPDX-License-Identifier: MIT
// The document as textures: the trajectory's images, the recipe's images, the observed frames.
import * as THREE from "three";
import {
  type Blob16, type Codes, PageFault, type ViewerDocument, decodeCodes, decodePicture, packRgba,
} from "./data";

export interface Between { from: THREE.Texture; to: THREE.Texture; mix: number }

export class Specimen {
  readonly width: number;
  readonly height: number;
  base!: THREE.Texture;
  rate!: THREE.Texture;
  curvature!: THREE.Texture;
  canvas!: THREE.Texture;     // C and luma_fill
  zone!: THREE.Texture;       // dead_zone, active
  share: THREE.Texture | null = null;   // root of Spread::own, mean of its channels
  private observed: { unit: number; texture: THREE.Texture }[] = [];
  private stack: { unit: number; codes: Codes | null }[] = [];
  // A network's frames go to the GPU when they are looked at: fifty of them at 512 x 512 in float
  // would be 210 MB.
  private readonly uploaded = new Map<number, THREE.DataTexture>();

  private constructor(readonly document: ViewerDocument) {
    this.width = document.width;
    this.height = document.height;
  }

  static async load(document: ViewerDocument, maxTextureSize: number): Promise<Specimen> {
    if (document.width > maxTextureSize || document.height > maxTextureSize) {
      throw new PageFault(
        `This device shows textures up to ${maxTextureSize} pixels; the specimen is larger.`);
    }
    const self = new Specimen(document);
    const decode = (blob: Blob16) => decodeCodes(blob, document.width, document.height);
    const t = document.trajectory;
    const law = t.kind === "law" ? t : null;
    const [canvas, fill, zone, active, share, base, rate, curvature, ...frames] = await Promise.all([
      decode(document.canvas), decode(document.luma_fill), decode(document.dead_zone),
      decode(document.active), document.spread ? decode(document.spread.own) : null, decode(t.base), law ? decode(law.rate) : null,
      law?.curvature ? decode(law.curvature) : null,
      ...(t.kind === "frames" ? t.frames.map(decode) : [])]);
    self.canvas = self.texture(packRgba(canvas, fill));
    self.zone = self.texture(packRgba(zone, active));
    if (share) self.share = self.single(share);
    self.base = self.texture(packRgba(base));
    self.rate = rate ? self.texture(packRgba(rate)) : self.base;
    self.curvature = curvature ? self.texture(packRgba(curvature)) : self.rate;
    if (t.kind === "frames") {
      self.stack = [{ unit: 0, codes: null },
        ...frames.map((codes, i) => ({ unit: t.horizons[i]!, codes }))];
    }
    const earlier = document.observed.filter((o) => o.unit < 0);
    const pictures = await Promise.all(earlier.map((o) => decodePicture(o.image)));
    self.observed = earlier.map((o, i) => ({ unit: o.unit, texture: self.picture(pictures[i]!) }));
    self.observed.push({ unit: 0, texture: self.base });
    return self;
  }

  get firstUnit(): number { return this.observed[0]!.unit; }
  get lastUnit(): number { return Math.max(...this.document.horizons, 1); }

  /** The observed frames around a negative age. */
  observedAt(age: number): Between {
    const { from, to, mix } = between(this.observed, age);
    return { from: this.observed[from]!.texture, to: this.observed[to]!.texture, mix };
  }
  /** A network's frames around an age; null for a law, which needs none. */
  framesAt(age: number): Between | null {
    if (this.stack.length < 2) return null;
    const { from, to, mix } = between(this.stack, age);
    for (const [i, texture] of this.uploaded) {
      if (i === from || i === to) continue;
      texture.dispose();
      this.uploaded.delete(i);
    }
    return { from: this.frame(from), to: this.frame(to), mix };
  }

  private frame(i: number): THREE.Texture {
    const codes = this.stack[i]!.codes;
    if (!codes) return this.base;
    const ready = this.uploaded.get(i) ?? this.texture(packRgba(codes));
    this.uploaded.set(i, ready);
    return ready;
  }

  private texture(rgba: Float32Array): THREE.DataTexture {
    const t = new THREE.DataTexture(rgba, this.width, this.height, THREE.RGBAFormat, THREE.FloatType);
    return asIs(t);
  }

  /** One float per texel. */
  private single(of: Codes): THREE.DataTexture {
    const values = Float32Array.from(of.codes, (code) => of.offset + of.scale * code);
    return asIs(new THREE.DataTexture(values, this.width, this.height, THREE.RedFormat, THREE.FloatType));
  }

  private picture(image: ImageBitmap): THREE.Texture {
    if (image.width !== this.width || image.height !== this.height) {
      throw new PageFault("An observed frame in this page has another size than the forecast.");
    }
    return asIs(new THREE.Texture(image));
  }
}

function asIs<T extends THREE.Texture>(t: T): T {
  t.minFilter = t.magFilter = THREE.NearestFilter;
  t.generateMipmaps = false;
  t.flipY = false;
  t.needsUpdate = true;
  return t;
}

function between(list: { unit: number }[], age: number): { from: number; to: number; mix: number } {
  let from = 0;
  while (from + 2 < list.length && list[from + 1]!.unit <= age) from++;
  const to = Math.min(from + 1, list.length - 1), span = list[to]!.unit - list[from]!.unit;
  const mix = span > 0 ? Math.min(Math.max((age - list[from]!.unit) / span, 0), 1) : 0;
  return { from, to, mix };
}
