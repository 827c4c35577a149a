// SPDX-License-Identifier: MIT
// The half width of the interval per pixel, and its colors.

/** Half width (encoded sRGB), its share of the scale, 0, 1 where something moves. */
export const unsureMap = `
precision highp float;
precision highp sampler2D;
uniform sampler2D u_share;
uniform vec2 u_variance;         // of what all share, of what each has for itself
uniform float u_half, u_full;
out vec4 result;
void main() {
  float root = texelFetch(u_share, ivec2(gl_FragCoord.xy), 0).r;
  float moves = root > 0.0 ? 1.0 : 0.0;
  float width = moves * u_half * sqrt(u_variance.x + u_variance.y * root * root);
  result = vec4(width, min(width / u_full, 1.0), 0.0, moves);
}
`;

/** Encoded color of a filtered texel of that map; its share is that of what moves around it. */
export const unsureColor = `
uniform sampler2D u_magma;
float unsure_share(vec4 at) { return at.a > 0.0 ? clamp(at.g / at.a, 0.0, 1.0) : 0.0; }
vec3 unsure_color(float share) {
  return texelFetch(u_magma, ivec2(int(share * 255.0 + 0.5), 0), 0).rgb;
}
`;

/** The same over a linear color, which turns gray under it: copper is a color of the legend. */
export const laidOver = `
uniform sampler2D u_unsure;
uniform float u_over;
${unsureColor}
vec3 laid_over(vec3 light, vec4 at) {
  float share = unsure_share(at);
  // chosen: what is surest by far stays as it is, and nothing jumps where the forecast begins.
  float paint = u_over * at.a * smoothstep(0.0, 0.15, share);
  vec3 color = unsure_color(share);
  color = mix(color / 12.92, pow((color + 0.055) / 1.055, vec3(2.4)), step(0.04045, color));
  float gray = min(dot(light, vec3(0.2126, 0.7152, 0.0722)), 1.0);
  return mix(light, mix(vec3(gray), color, 0.6), paint);
}
`;
