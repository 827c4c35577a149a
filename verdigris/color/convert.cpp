// SPDX-License-Identifier: MIT
#include "verdigris/color/convert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace verdigris {
namespace {

// Linear sRGB to XYZ, rounded to four digits as [IEC61966-2-1] prints it, rows summing to the
// D65 white (0.9505, 1, 1.0890). The inverse is computed, never typed.
constexpr std::array<std::array<double, 3>, 3> kXyzFromRgb{
    {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
constexpr double kWhiteX = 0.9505, kWhiteY = 1.0, kWhiteZ = 1.0890;

constexpr std::array<std::array<double, 3>, 3> inverse(
    const std::array<std::array<double, 3>, 3>& m) {
    const auto minor = [&](int r, int c) {
        const int r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
        return m[std::size_t(r0)][std::size_t(c0)] * m[std::size_t(r1)][std::size_t(c1)] -
               m[std::size_t(r0)][std::size_t(c1)] * m[std::size_t(r1)][std::size_t(c0)];
    };
    const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    std::array<std::array<double, 3>, 3> out{};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) out[std::size_t(r)][std::size_t(c)] = minor(c, r) / det;
    return out;
}
constexpr auto kRgbFromXyz = inverse(kXyzFromRgb);

std::array<float, 3> multiply(const std::array<std::array<double, 3>, 3>& m, double a, double b,
                              double c) {
    return {float(m[0][0] * a + m[0][1] * b + m[0][2] * c),
            float(m[1][0] * a + m[1][1] * b + m[1][2] * c),
            float(m[2][0] * a + m[2][1] * b + m[2][2] * c)};
}

// [CIE15] with the exact rational constants: delta = 6/29.
constexpr double kDelta = 6.0 / 29.0;
double lab_curve(double t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}
double lab_curve_inverse(double f) {
    return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0 / 29.0);
}

float unit(float v) {
    return v > 0 ? std::min(v, 1.0f) : 0.0f;
}  // NaN compares false: 0

}  // namespace

float linear_from_srgb(float v) {
    const float a = std::fabs(v);
    const float l = a <= 0.04045f ? a / 12.92f : std::pow((a + 0.055f) / 1.055f, 2.4f);
    return std::copysign(l, v);
}

float srgb_from_linear(float v) {
    const float a = std::fabs(v);
    const float e = a <= 0.0031308f ? a * 12.92f : 1.055f * std::pow(a, 1 / 2.4f) - 0.055f;
    return std::copysign(e, v);
}

LinearF linear_from_srgb(SrgbF c) {
    return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}
SrgbF srgb_from_linear(LinearF c) {
    return {srgb_from_linear(c.r), srgb_from_linear(c.g), srgb_from_linear(c.b)};
}

Xyz xyz_from_linear(LinearF c) {
    const auto v = multiply(kXyzFromRgb, c.r, c.g, c.b);
    return {v[0], v[1], v[2]};
}
LinearF linear_from_xyz(Xyz c) {
    const auto v = multiply(kRgbFromXyz, c.x, c.y, c.z);
    return {v[0], v[1], v[2]};
}

Lab lab_from_xyz(Xyz c) {
    const double fx = lab_curve(c.x / kWhiteX), fy = lab_curve(c.y / kWhiteY),
                 fz = lab_curve(c.z / kWhiteZ);
    return {float(116 * fy - 16), float(500 * (fx - fy)), float(200 * (fy - fz))};
}
Xyz xyz_from_lab(Lab c) {
    const double fy = (c.l + 16) / 116.0, fx = fy + c.a / 500.0, fz = fy - c.b / 200.0;
    return {float(kWhiteX * lab_curve_inverse(fx)), float(kWhiteY * lab_curve_inverse(fy)),
            float(kWhiteZ * lab_curve_inverse(fz))};
}
Lab lab_from_srgb(SrgbF c) {
    return lab_from_xyz(xyz_from_linear(linear_from_srgb(c)));
}

SrgbF srgb_from_u8(SrgbU8 c) {
    return {float(c.r) / 255.0f, float(c.g) / 255.0f, float(c.b) / 255.0f};
}
SrgbF srgb_from_u16(SrgbU16 c) {
    return {float(c.r) / 65535.0f, float(c.g) / 65535.0f, float(c.b) / 65535.0f};
}
std::uint8_t u8_from_unit(float v) {
    return std::uint8_t(unit(v) * 255.0f + 0.5f);
}
std::uint16_t u16_from_unit(float v) {
    return std::uint16_t(unit(v) * 65535.0f + 0.5f);
}
SrgbU8 u8_from_srgb(SrgbF c) {
    return {u8_from_unit(c.r), u8_from_unit(c.g), u8_from_unit(c.b)};
}
SrgbU16 u16_from_srgb(SrgbF c) {
    return {u16_from_unit(c.r), u16_from_unit(c.g), u16_from_unit(c.b)};
}

}  // namespace verdigris
