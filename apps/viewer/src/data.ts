// SPDX-License-Identifier: MIT
// The document that deliver/ writes (docs/VIEWER_DATA.md), decoded.

export interface Blob16 { channels: number; scale: number; offset: number; data: string }
export interface Guard { id: string; severity: string; sentence: string }
export interface MapOrigin { map: string; origin: string; sentence: string }
export interface LawDocument {
  kind: "law"; order: number; context: number; clamp: boolean;
  /** [horizon, phi, phi2], linear from 0 to and between them; null: a polynomial of order 0 to 2. */
  nodes?: [number, number, number][] | null;
  base: Blob16; rate: Blob16; curvature: Blob16 | null;
}
export interface FramesDocument { kind: "frames"; base: Blob16; horizons: number[]; frames: Blob16[] }

export interface MaterialConstants {
  coverage_exponent: number; roughness_clean: number; roughness_patina: number;
  roughness_gamma: number; micro_roughness: number; metallic_patina: number;
  metallic_clean: number; metallic_gamma: number; height_patina_weight: number;
  height_sigma: number; micro_sigma: number; micro_range: number; normal_scale: number;
  normal_gain: number; tau: number; normalizer: number; reference_horizon: number;
  observed_is_clean: boolean;
}

export interface ViewerDocument {
  format: string; title: string; version: string; width: number; height: number;
  context: number; units_observed: number; horizons: number[];
  /** Half widths of nominal intervals, encoded sRGB in 0..1; null or absent: none is stated. */
  uncertainty?: { horizon: number; mean_80: number; mean_95: number; pixel_80: number; pixel_95: number }[] | null;
  /** Null or absent: none is stated. */
  spread?: SpreadDocument | null;
  forecaster: { name: string; explanation: string };
  guards: Guard[]; origins: MapOrigin[];
  trajectory: LawDocument | FramesDocument;
  observed: { unit: number; image: string }[];
  material: MaterialConstants;
  canvas: Blob16; dead_zone: Blob16; active: Blob16; luma_fill: Blob16;
}

/** How far off the forecast may be, per pixel (docs/VIEWER_DATA.md). */
export interface SpreadDocument {
  common: [number, number, number];
  /** [horizon, variance that all pixels share, variance of each], linear from 0 to and between them. */
  nodes: [number, number, number][];
  /** Where the colors of the map end. */
  full_codes: number;
  /** Root of the pixels' shares of the latter; 0: held. */
  own: Blob16;
}

/** An error whose message is a sentence for the person at the screen. */
export class PageFault extends Error {}

export function readDocument(): ViewerDocument {
  const text = document.getElementById("verdigris-data")?.textContent ?? "";
  let parsed: ViewerDocument;
  try {
    parsed = JSON.parse(text) as ViewerDocument;
  } catch {
    throw new PageFault("This page holds no forecast: it is the empty template, or it was cut short.");
  }
  if (parsed.format !== "verdigris-viewer/1") {
    throw new PageFault(`This page was made for another viewer (${String(parsed.format)}).`);
  }
  return parsed;
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** An image as it travels: half the memory of its floats. */
export interface Codes { channels: number; scale: number; offset: number; codes: Uint16Array }

/** Base64, zlib, left difference mod 2^16. Interleaved channels. */
export async function decodeCodes(blob: Blob16, width: number, height: number): Promise<Codes> {
  const stream = new Blob([bytesOf(blob.data)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const raw = await new Response(stream).arrayBuffer();
  const c = blob.channels, count = width * height * c;
  if (raw.byteLength !== count * 2) throw new PageFault("The forecast in this page is damaged.");
  const view = new DataView(raw), codes = new Uint16Array(count);
  const above = new Uint16Array(c), left = new Uint16Array(c);
  for (let y = 0, i = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      for (let k = 0; k < c; k++, i++) {
        const value = (view.getUint16(i * 2, true) + (x === 0 ? above[k]! : left[k]!)) & 0xffff;
        left[k] = value;
        if (x === 0) above[k] = value;
        codes[i] = value;
      }
    }
  }
  return { channels: c, scale: blob.scale, offset: blob.offset, codes };
}

/** RGBA floats per texel: the channels of `color`, then the one of `extra`. */
export function packRgba(color: Codes, extra?: Codes): Float32Array {
  const c = color.channels, n = color.codes.length / c, out = new Float32Array(n * 4);
  for (let i = 0; i < n; i++) {
    for (let k = 0; k < c; k++) out[i * 4 + k] = color.offset + color.scale * color.codes[i * c + k]!;
    if (extra) out[i * 4 + c] = extra.offset + extra.scale * extra.codes[i]!;
  }
  return out;
}

/** An 8-bit picture as it was written: no color management, no premultiplied alpha. */
export async function decodePicture(uri: string): Promise<ImageBitmap> {
  const [head, data] = uri.split(",");
  if (!head?.startsWith("data:image/png;base64") || !data) {
    throw new PageFault("An observed frame in this page is damaged.");
  }
  return createImageBitmap(new Blob([bytesOf(data)], { type: "image/png" }), {
    colorSpaceConversion: "none", premultiplyAlpha: "none",
  });
}
