// SPDX-License-Identifier: MIT
// The document that deliver/ writes (docs/VIEWER_DATA.md), decoded.

export interface Blob16 { channels: number; scale: number; offset: number; data: string }
export interface Guard { id: string; severity: string; sentence: string }
export interface MapOrigin { map: string; origin: string; sentence: string }
export interface LawDocument {
  kind: "law"; order: number; context: number; clamp: boolean;
  base: Blob16; rate: Blob16; curvature: Blob16 | null;
}
export interface FramesDocument { kind: "frames"; base: Blob16; horizons: number[]; frames: Blob16[] }

export interface MaterialConstants {
  coverage_exponent: number; roughness_clean: number; roughness_patina: number;
  roughness_gamma: number; micro_roughness: number; metallic_patina: number;
  metallic_clean: number; metallic_gamma: number; height_patina_weight: number;
  height_sigma: number; micro_sigma: number; micro_range: number; normal_scale: number;
  normal_gain: number; tau: number; normalizer: number; reference_horizon: number;
}

export interface ViewerDocument {
  format: string; title: string; version: string; width: number; height: number;
  context: number; units_observed: number; horizons: number[];
  forecaster: { name: string; explanation: string };
  guards: Guard[]; origins: MapOrigin[];
  trajectory: LawDocument | FramesDocument;
  observed: { unit: number; image: string }[];
  material: MaterialConstants;
  canvas: Blob16; dead_zone: Blob16; active: Blob16; luma_fill: Blob16;
}

export function readDocument(): ViewerDocument {
  const text = document.getElementById("verdigris-data")?.textContent ?? "";
  let parsed: ViewerDocument;
  try {
    parsed = JSON.parse(text) as ViewerDocument;
  } catch {
    throw new Error("This page holds no forecast: it is the empty template, or it was cut short.");
  }
  if (parsed.format !== "verdigris-viewer/1") {
    throw new Error(`This page was made for another viewer (${String(parsed.format)}).`);
  }
  return parsed;
}

/** Base64, zlib, left difference mod 2^16, then offset + scale * u16. Interleaved channels. */
export async function decodeBlob(blob: Blob16, width: number, height: number): Promise<Float32Array> {
  const binary = atob(blob.data);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const raw = await new Response(stream).arrayBuffer();
  const c = blob.channels, count = width * height * c;
  if (raw.byteLength !== count * 2) throw new Error("The forecast in this page is damaged.");
  const view = new DataView(raw);
  const out = new Float32Array(count);
  const above = new Uint16Array(c), left = new Uint16Array(c);
  for (let y = 0, i = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      for (let k = 0; k < c; k++, i++) {
        const from = x === 0 ? above[k]! : left[k]!;
        const value = (view.getUint16(i * 2, true) + from) & 0xffff;
        left[k] = value;
        if (x === 0) above[k] = value;
        out[i] = blob.offset + blob.scale * value;
      }
    }
  }
  return out;
}

/** Four channels per texel: three of `rgb` and one of `a` (or 1). */
export function packRgba(rgb: Float32Array, a: Float32Array | null): Float32Array {
  const n = rgb.length / 3, out = new Float32Array(n * 4);
  for (let i = 0; i < n; i++) {
    out[i * 4] = rgb[i * 3]!;
    out[i * 4 + 1] = rgb[i * 3 + 1]!;
    out[i * 4 + 2] = rgb[i * 3 + 2]!;
    out[i * 4 + 3] = a ? a[i]! : 1;
  }
  return out;
}

/** An 8-bit picture as it was written: no color management, no premultiplied alpha. */
export async function decodePicture(uri: string): Promise<ImageBitmap> {
  const response = await fetch(uri);
  return createImageBitmap(await response.blob(), {
    colorSpaceConversion: "none", premultiplyAlpha: "none",
  });
}
