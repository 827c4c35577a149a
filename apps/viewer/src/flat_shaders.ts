// SPDX-License-Identifier: MIT
// One map flat on the screen. Output is display-ready: encoded colors, data as gray.
import { laidOver } from "./uncertainty_shaders";

export const flatVertex = `
in vec3 position;
in vec2 uv;
uniform vec2 u_scale, u_shift;
out vec2 v_uv;
void main() {
  v_uv = vec2(uv.x, 1.0 - uv.y);
  gl_Position = vec4(position.xy * u_scale + u_shift, 0.0, 1.0);
}
`;

export const flatFragment = `
precision highp float;
precision highp sampler2D;
uniform sampler2D u_albedo, u_orm, u_normal, u_coverage;
uniform int u_map;
uniform bool u_texels;   // so near that the pixels themselves are of interest
in vec2 v_uv;
out vec4 result;
${laidOver}
vec3 heat(float t) {   // dark to bright, readable in gray: coverage is no color of the metal
  return clamp(vec3(1.5 * t, 1.6 * t * t, 0.35 + 0.9 * t - 1.25 * t * t + t * t * t * 0.6), 0.0, 1.0);
}
void main() {
  vec2 size = vec2(textureSize(u_orm, 0));
  vec2 uv = u_texels ? (floor(v_uv * size) + 0.5) / size : v_uv;
  vec2 dx = dFdx(v_uv), dy = dFdy(v_uv);   // of the unsnapped: else mipmaps show at the steps
  vec4 orm = textureGrad(u_orm, uv, dx, dy);
  vec4 unsure = textureGrad(u_unsure, uv, dx, dy);
  vec3 v = laid_over(textureGrad(u_albedo, uv, dx, dy).rgb, unsure);
  v = mix(v * 12.92, 1.055 * pow(max(v, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
  if (u_map == 2) v = textureGrad(u_normal, uv, dx, dy).rgb;
  if (u_map == 3) v = vec3(orm.g);
  if (u_map == 4) v = vec3(orm.b);
  if (u_map == 5) v = vec3(orm.a);
  if (u_map == 6) v = heat(texelFetch(u_coverage, ivec2(uv * size), 0).a);
  // What is held has no interval: gray, and no color of the scale.
  if (u_map == 7) v = mix(vec3(0.2, 0.212, 0.224), unsure_color(unsure_share(unsure)), unsure.a);
  result = vec4(clamp(v, 0.0, 1.0), 1.0);
}
`;
