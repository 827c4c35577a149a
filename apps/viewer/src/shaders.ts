// SPDX-License-Identifier: MIT
// Stage 3 on the GPU: the equations of docs/VIEWER_DATA.md, one pass each. Texel (x, y) is pixel
// (x, y) of the images, row 0 on top. The same equations in C++ are verdigris/material/.

const header = `
precision highp float;
precision highp sampler2D;
`;

export const vertex = `
in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }
`;

const coverage = `
uniform sampler2D u_canvas;      // C, luma_fill
uniform sampler2D u_zone;        // dead_zone, active
uniform float u_normalizer, u_exponent;
float coverage_of(vec3 x, ivec2 at) {
  vec2 zone = texelFetch(u_zone, at, 0).rg;
  vec3 d = abs(x - texelFetch(u_canvas, at, 0).rgb);
  float p = clamp(((d.r + d.g + d.b) / 3.0 - zone.r) / u_normalizer, 0.0, 1.0);
  return zone.g > 0.75 && p > 0.0 ? pow(p, u_exponent) : 0.0;
}
`;

/** X = base + phi(h) rate + phi2(h) curvature, frozen per pixel where it would leave [0, 1]. */
export const lawFrame = `${header}
uniform sampler2D u_base, u_rate, u_curvature;
uniform float u_horizon, u_reach;   // reach: n - 1
uniform int u_order;
uniform bool u_tabulated;
uniform vec2 u_phi;                 // phi and phi2 of a law with nodes
uniform bool u_clamp;
out vec4 result;
${coverage}
const float kNever = 1e30;
// First h > 0 where c h^2 + b h + start leaves the side of \`bound\` that [0, 1] is on.
float first_crossing(float start, float b, float c, float bound) {
  float outward = bound > 0.5 ? 1.0 : -1.0;
  float d = (start - bound) * outward > 0.0 ? 0.0 : start - bound;   // a rounding step outside
  if (d == 0.0) {
    if (b * outward > 0.0 || (b == 0.0 && c * outward > 0.0)) return 0.0;
    float other = c == 0.0 ? kNever : -b / c;
    return other > 0.0 ? other : kNever;
  }
  if (c == 0.0) {
    float h = b == 0.0 ? kNever : -d / b;
    return h > 0.0 ? h : kNever;
  }
  float disc = b * b - 4.0 * c * d;
  if (disc < 0.0) return kNever;
  float q = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(disc));
  float h1 = q / c, h2 = q == 0.0 ? kNever : d / q;
  float h = kNever;
  if (h1 > 0.0) h = h1;
  if (h2 > 0.0) h = min(h, h2);
  return h;
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 base = texelFetch(u_base, at, 0).rgb;
  vec3 x = base;
  if (u_tabulated) {
    vec3 change = u_phi.x * texelFetch(u_rate, at, 0).rgb + u_phi.y * texelFetch(u_curvature, at, 0).rgb;
    float share = 1.0;
    if (u_clamp) {
      for (int k = 0; k < 3; k++) {
        share = min(share, first_crossing(base[k], change[k], 0.0, 0.0));
        share = min(share, first_crossing(base[k], change[k], 0.0, 1.0));
      }
    }
    x = base + share * change;
  } else if (u_order > 0) {
    vec3 rate = texelFetch(u_rate, at, 0).rgb;
    vec3 curve = u_order > 1 ? texelFetch(u_curvature, at, 0).rgb : vec3(0.0);
    vec3 slope = rate + 2.0 * u_reach * curve;
    float h = u_horizon;
    if (u_clamp) {
      for (int k = 0; k < 3; k++) {
        h = min(h, first_crossing(base[k], slope[k], curve[k], 0.0));
        h = min(h, first_crossing(base[k], slope[k], curve[k], 1.0));
      }
    }
    x = base + h * slope + h * h * curve;
  }
  result = vec4(x, coverage_of(x, at));
}
`;

/** A network's frames: linear between two of them. */
export const stackFrame = `${header}
uniform sampler2D u_from, u_to;
uniform float u_mix;
out vec4 result;
${coverage}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 x = mix(texelFetch(u_from, at, 0).rgb, texelFetch(u_to, at, 0).rgb, u_mix);
  result = vec4(x, coverage_of(x, at));
}
`;

/** Observed frames crossfade; the observed state is the clean state by definition: p = 0. */
export const observedFrame = `${header}
uniform sampler2D u_from, u_to;
uniform float u_mix;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = vec4(mix(texelFetch(u_from, at, 0).rgb, texelFetch(u_to, at, 0).rgb, u_mix), 0.0);
}
`;

/** A Gaussian along one axis over what `float sample_at(ivec2)` gives; borders replicated. */
const gaussian = `
uniform ivec2 u_size;
uniform float u_sigma;
float smoothed(ivec2 at, ivec2 along) {
  int radius = int(ceil(3.0 * u_sigma));   // 0 where sigma is 0: only the middle, never divided
  float sum = sample_at(at), weights = 1.0;
  for (int i = 1; i <= radius; i++) {
    float t = float(i) / u_sigma, w = exp(-0.5 * t * t);
    ivec2 one = clamp(at - i * along, ivec2(0), u_size - 1);
    ivec2 other = clamp(at + i * along, ivec2(0), u_size - 1);
    sum += w * (sample_at(one) + sample_at(other));
    weights += 2.0 * w;
  }
  return sum / weights;
}
`;

/** Horizontal Gaussian of the luma (glints filled). */
export const lumaAcross = `${header}
uniform sampler2D u_frame, u_canvas;
out vec4 result;
float sample_at(ivec2 at) {
  float fill = texelFetch(u_canvas, at, 0).a;
  return fill >= 0.0 ? fill : dot(texelFetch(u_frame, at, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
}
${gaussian}
void main() { result = vec4(smoothed(ivec2(gl_FragCoord.xy), ivec2(1, 0)), 0.0, 0.0, 1.0); }
`;

/** Vertical Gaussian, then the height: luma blended with the coverage. */
export const heightDown = `${header}
uniform sampler2D u_across, u_frame;
uniform float u_weight;
out vec4 result;
float sample_at(ivec2 at) { return texelFetch(u_across, at, 0).r; }
${gaussian}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float p = texelFetch(u_frame, at, 0).a;
  float luma = smoothed(at, ivec2(0, 1));
  result = vec4(clamp((1.0 - u_weight) * luma + u_weight * p, 0.0, 1.0), 0.0, 0.0, 1.0);
}
`;

/** One direction of the low-pass behind the micro-roughness. */
export const blur = `${header}
uniform sampler2D u_source;
uniform ivec2 u_step;
out vec4 result;
float sample_at(ivec2 at) { return texelFetch(u_source, at, 0).r; }
${gaussian}
void main() { result = vec4(smoothed(ivec2(gl_FragCoord.xy), u_step), 0.0, 0.0, 1.0); }
`;

/** Occlusion (none), roughness, metallic, height. */
export const ormMap = `${header}
uniform sampler2D u_frame, u_height, u_low, u_zone;
uniform vec3 u_rough, u_metal;    // clean, patina, gamma
uniform float u_micro, u_range;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float p = texelFetch(u_frame, at, 0).a;
  float h = texelFetch(u_height, at, 0).r;
  bool backdrop = texelFetch(u_zone, at, 0).g < 0.25;   // no metal
  float micro = clamp((h - texelFetch(u_low, at, 0).r) / u_range, -1.0, 1.0) * u_micro;
  float grown = backdrop ? 1.0 : p > 0.0 ? pow(p, u_rough.z) : 0.0;
  float bare = backdrop ? 0.0 : p < 1.0 ? pow(1.0 - p, u_metal.z) : 0.0;
  float rough = clamp(u_rough.x + (u_rough.y - u_rough.x) * grown + micro, 0.04, 1.0);
  float metal = u_metal.y + (u_metal.x - u_metal.y) * bare;
  result = vec4(1.0, rough, metal, h);
}
`;

/** Tangent-space normal, +Y up, packed into [0, 1]. */
export const normalMap = `${header}
uniform sampler2D u_height;
uniform ivec2 u_size;
uniform float u_scale;
out vec4 result;
float h(ivec2 at) { return texelFetch(u_height, clamp(at, ivec2(0), u_size - 1), 0).r; }
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  float a = h(p + ivec2(-1, -1)), b = h(p + ivec2(0, -1)), c = h(p + ivec2(1, -1));
  float d = h(p + ivec2(-1, 0)), f = h(p + ivec2(1, 0));
  float g = h(p + ivec2(-1, 1)), i = h(p + ivec2(0, 1)), j = h(p + ivec2(1, 1));
  float dx = (c + 2.0 * f + j) - (a + 2.0 * d + g);
  float dy = (g + 2.0 * i + j) - (a + 2.0 * b + c);
  vec3 n = normalize(vec3(-u_scale * dx, u_scale * dy, 1.0));
  result = vec4(n * 0.5 + 0.5, 1.0);
}
`;

/** The frame as albedo, linear: what a renderer filters and lights. */
export const albedoMap = `${header}
uniform sampler2D u_frame;
out vec4 result;
void main() {
  vec3 v = clamp(texelFetch(u_frame, ivec2(gl_FragCoord.xy), 0).rgb, 0.0, 1.0);
  v = mix(v / 12.92, pow((v + 0.055) / 1.055, vec3(2.4)), step(0.04045, v));
  result = vec4(v, 1.0);
}
`;
