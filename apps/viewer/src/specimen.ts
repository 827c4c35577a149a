// SPDX-License-Identifier: MIT
// The document as textures: the trajectory's images, the recipe's images, the observed frames.
import * as THREE from "three";
import { type Blob16, type ViewerDocument, decodeBlob, decodePicture, packRgba } from "./data";

export interface Between { from: THREE.Texture; to: THREE.Texture; mix: number }

export class Specimen {
  readonly width: number;
  readonly height: number;
  base!: THREE.Texture;
  rate!: THREE.Texture;
  curvature!: THREE.Texture;
  canvas!: THREE.Texture;     // C and luma_fill
  zone!: THREE.Texture;       // dead_zone, active
  private observed: { unit: number; texture: THREE.Texture }[] = [];
  private stack: { unit: number; texture: THREE.Texture }[] = [];

  private constructor(readonly document: ViewerDocument, readonly floatTargets: boolean) {
    this.width = document.width;
    this.height = document.height;
  }

  static async load(document: ViewerDocument, renderer: THREE.WebGLRenderer): Promise<Specimen> {
    const limit = renderer.capabilities.maxTextureSize;
    if (document.width > limit || document.height > limit) {
      throw new Error(`This device shows textures up to ${limit} pixels; the specimen is larger.`);
    }
    const self = new Specimen(document, renderer.extensions.has("EXT_color_buffer_float"));
    const decode = (blob: Blob16) => decodeBlob(blob, document.width, document.height);
    const rgb = async (blob: Blob16) => self.texture(packRgba(await decode(blob), null));
    const t = document.trajectory;
    const [canvas, fill, zone, active] = await Promise.all([
      decode(document.canvas), decode(document.luma_fill), decode(document.dead_zone),
      decode(document.active)]);
    self.canvas = self.texture(packRgba(canvas, fill));
    const pair = new Float32Array(zone.length * 4);
    for (let i = 0; i < zone.length; i++) {
      pair[i * 4] = zone[i]!;
      pair[i * 4 + 1] = active[i]!;
    }
    self.zone = self.texture(pair);
    self.base = await rgb(t.base);
    self.rate = t.kind === "law" ? await rgb(t.rate) : self.base;
    self.curvature = t.kind === "law" && t.curvature ? await rgb(t.curvature) : self.rate;
    if (t.kind === "frames") {
      self.stack = [{ unit: 0, texture: self.base }];
      for (const [i, blob] of t.frames.entries()) {
        self.stack.push({ unit: t.horizons[i]!, texture: await rgb(blob) });
      }
    }
    for (const o of document.observed) {
      if (o.unit < 0) {
        self.observed.push({ unit: o.unit, texture: self.picture(await decodePicture(o.image)) });
      }
    }
    self.observed.push({ unit: 0, texture: self.base });
    return self;
  }

  get firstUnit(): number { return this.observed[0]!.unit; }
  get lastUnit(): number { return Math.max(...this.document.horizons, 1); }
  get observedUnits(): number[] { return this.observed.map((o) => o.unit); }

  /** The observed frames around a negative age. */
  observedAt(age: number): Between { return between(this.observed, age); }
  /** A network's frames around an age; null for a law, which needs none. */
  framesAt(age: number): Between | null {
    return this.stack.length > 1 ? between(this.stack, age) : null;
  }

  private texture(rgba: Float32Array): THREE.DataTexture {
    const t = new THREE.DataTexture(rgba, this.width, this.height, THREE.RGBAFormat, THREE.FloatType);
    t.minFilter = t.magFilter = THREE.NearestFilter;
    t.generateMipmaps = false;
    t.needsUpdate = true;
    return t;
  }

  private picture(image: ImageBitmap): THREE.Texture {
    if (image.width !== this.width || image.height !== this.height) {
      throw new Error("An observed frame in this page has another size than the forecast.");
    }
    const t = new THREE.Texture(image);
    t.minFilter = t.magFilter = THREE.NearestFilter;
    t.generateMipmaps = false;
    t.flipY = false;
    t.needsUpdate = true;
    return t;
  }
}

function between(list: { unit: number; texture: THREE.Texture }[], age: number): Between {
  let i = 0;
  while (i + 2 < list.length && list[i + 1]!.unit <= age) i++;
  const a = list[i]!, b = list[Math.min(i + 1, list.length - 1)]!;
  const span = b.unit - a.unit;
  const mix = span > 0 ? Math.min(Math.max((age - a.unit) / span, 0), 1) : 0;
  return { from: a.texture, to: b.texture, mix };
}
