// SPDX-License-Identifier: MIT
#include "verdigris/render/reflectance.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "verdigris/render/microfacet.h"

namespace verdigris {
namespace {

constexpr int kNodes = ReflectanceRow::kNodes;
// chosen: brdf_test.cpp holds the table to 0.003 of a table with 64 times as many points.
constexpr int kPoints = 1024;
constexpr int kMeanPoints = 512;  // of the means, over the table's own interpolation

// Nodes lie at squares, closer where the reflectance bends: towards grazing.
float node_cosine(int i) {
    const float x = float(i) / (kNodes - 1);
    return std::max(x * x, 1e-4f);
}

struct Row {
    float mean_whole = 0, mean_dielectric = 0;
    Reflectance nodes[kNodes];
};

Reflectance interpolated(const Reflectance* nodes, float cosine) {
    const float x = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * (kNodes - 1);
    const int i = std::min(int(x), kNodes - 2);
    const float t = x - float(i);
    const Reflectance &a = nodes[i], &b = nodes[i + 1];
    return {a.scale + (b.scale - a.scale) * t, a.bias + (b.bias - a.bias) * t,
            a.dielectric + (b.dielectric - a.dielectric) * t};
}

// G2 / G1(v) of visible facets is what one scattering reflects [Heitz2018, Eq. 19].
Reflectance once_scattered(float cosine, float alpha) {
    const Vec3F v{std::sqrt(std::max(0.0f, 1 - cosine * cosine)), 0, cosine};
    double scale = 0, bias = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const Vec3F h = visible_half(v, alpha, sobol_point(i, 0, 0));
        const Vec3F l = reflected(v, h);
        if (l.z <= 0) continue;
        const float shown =
            smith_visibility(v.z, l.z, alpha) * 2 * l.z * (v.z + smith_root(v.z, alpha));
        const float fresnel = fifth_power(1 - std::clamp(dot(v, h), 0.0f, 1.0f));
        scale += double(shown * (1 - fresnel));
        bias += double(shown * fresnel);
    }
    return {float(scale / kPoints), float(bias / kPoints), 0};
}

Row made_row(int r) {
    const float alpha = alpha_of(float(r) / (kNodes - 1));
    Row row;
    for (int i = 0; i < kNodes; ++i) row.nodes[i] = once_scattered(node_cosine(i), alpha);
    const auto mean = [&](auto value) {
        double sum = 0;
        for (int k = 0; k < kMeanPoints; ++k) {
            const double cosine = (k + 0.5) / kMeanPoints;
            sum += 2 * cosine * double(value(interpolated(row.nodes, float(cosine))));
        }
        return float(sum / kMeanPoints);
    };
    row.mean_whole = mean([](const Reflectance& e) { return e.whole(); });
    const float again = again_scattered(kDielectricF0, row.mean_whole);
    for (Reflectance& e : row.nodes) {
        e.dielectric = kDielectricF0 * e.scale + e.bias + again * (1 - e.whole());
    }
    row.mean_dielectric = mean([](const Reflectance& e) { return e.dielectric; });
    return row;
}

const std::vector<Row>& table() {
    static const std::vector<Row> rows = [] {
        // On one thread: the first to ask may be a task of a parallel loop. One that waited here
        // for tasks of its own could be handed another tile meanwhile, ask again, and wait for
        // itself.
        std::vector<Row> made;
        for (int r = 0; r < kNodes; ++r) made.push_back(made_row(r));
        return made;
    }();
    return rows;
}

}  // namespace

float again_scattered(float f0, float mean_whole) {
    const float mean_fresnel = f0 + (1 - f0) / 21;  // derived: Schlick's, cosine-weighted
    return mean_fresnel * mean_fresnel * mean_whole / (1 - mean_fresnel * (1 - mean_whole));
}

ReflectanceRow::ReflectanceRow(float roughness) {
    const std::vector<Row>& rows = table();
    const float x = std::clamp(roughness, 0.0f, 1.0f) * (kNodes - 1);
    const int i = std::min(int(x), kNodes - 2);
    const Row &a = rows[std::size_t(i)], &b = rows[std::size_t(i + 1)];
    weight_ = x - float(i);
    low_ = a.nodes;
    high_ = b.nodes;
    mean_whole_ = a.mean_whole + (b.mean_whole - a.mean_whole) * weight_;
    mean_dielectric_ = a.mean_dielectric + (b.mean_dielectric - a.mean_dielectric) * weight_;
}

Reflectance ReflectanceRow::at(float cosine) const {
    const Reflectance a = interpolated(low_, cosine), b = interpolated(high_, cosine);
    return {a.scale + (b.scale - a.scale) * weight_, a.bias + (b.bias - a.bias) * weight_,
            a.dielectric + (b.dielectric - a.dielectric) * weight_};
}

}  // namespace verdigris
