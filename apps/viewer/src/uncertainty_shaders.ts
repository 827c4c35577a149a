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
  // chosen: the surer, the more is seen of the material itself, and nothing jumps where the
  // forecast begins. Painted alike everywhere, the surest of all would be black.
  float paint = u_over * at.a * smoothstep(0.0, 0.6, share);
  // Mixed as encoded: in linear light what is bright in the picture would pass for unsure.
  float gray = min(dot(light, vec3(0.2126, 0.7152, 0.0722)), 1.0);
  gray = gray > 0.0031308 ? 1.055 * pow(gray, 1.0 / 2.4) - 0.055 : gray * 12.92;
  vec3 color = mix(vec3(gray), unsure_color(share), 0.65);
  color = mix(color / 12.92, pow((color + 0.055) / 1.055, vec3(2.4)), step(0.04045, color));
  return mix(light, color, paint);
}
`;
