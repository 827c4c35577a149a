// SPDX-License-Identifier: MIT
#include "verdigris/render/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

struct Reference {
    Shape shape;  // a vertex per corner
    std::vector<Tangent> tangents;
};

std::map<std::string, Reference> references() {
    std::map<std::string, Reference> all;
    std::ifstream file(VERDIGRIS_MIKKTSPACE_CSV);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string name, cell;
        std::getline(cells, name, ',');
        std::vector<float> v;
        while (std::getline(cells, cell, ',')) v.push_back(std::stof(cell));
        Reference& r = all[name];
        const auto i = std::uint32_t(r.shape.vertex_count());
        r.shape.positions.push_back({v.at(0), v[1], v[2]});
        r.shape.normals.push_back({v.at(3), v[4], v[5]});
        r.shape.coordinates.push_back({v.at(6), v[7]});
        r.tangents.push_back({{v.at(8), v[9], v[10]}, v.at(11)});
        if (i % 3 == 2) r.shape.triangles.push_back({i - 2, i - 1, i});
    }
    return all;
}

TEST(Tangents, AreThoseOfTheReferenceCode) {
    const auto all = references();
    ASSERT_EQ(all.size(), 4u);
    for (const auto& [name, reference] : all) {
        Shape shape = reference.shape;
        make_tangents(shape);
        ASSERT_EQ(shape.triangles.size(), reference.shape.triangles.size());
        EXPECT_LT(shape.vertex_count(), reference.shape.vertex_count()) << name;
        for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t i = shape.triangles[t][c];
                const std::uint32_t j = reference.shape.triangles[t][c];
                EXPECT_EQ(shape.positions[i], reference.shape.positions[j]);
                const Vec3F d = shape.tangents[i].direction - reference.tangents[j].direction;
                EXPECT_LT(length(d), 2e-5f) << name << ", triangle " << t << ", corner " << c;
                EXPECT_EQ(shape.tangents[i].sign, reference.tangents[j].sign) << name;
            }
        }
    }
}

// The formulas of the built-in shapes against the algorithm: a smooth shape's tangents agree.
void expect_own_tangents(const Shape& own, float least_cosine) {
    Shape made = own;
    make_tangents(made);
    std::size_t far = 0;
    for (std::size_t t = 0; t < own.triangles.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
            const Tangent &a = own.tangents[own.triangles[t][c]],
                          &b = made.tangents[made.triangles[t][c]];
            // At a pole every direction is along u.
            if (std::abs(own.positions[own.triangles[t][c]].y) > 0.999f) continue;
            far += dot(a.direction, b.direction) < least_cosine || a.sign != b.sign;
        }
    }
    EXPECT_EQ(far, 0u);
}

TEST(Tangents, OfTheShapesAreTheirFormulas) {
    expect_own_tangents(plate_shape(1.5), 0.999999f);
    expect_own_tangents(sphere_shape(64), 0.999f);
    expect_own_tangents(drape_shape(200), 0.98f);
}

TEST(Tangents, ATriangleWithoutAreaOnTheMapStillGetsAFrame) {
    Shape s;
    s.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    s.coordinates = {{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}};
    s.triangles = {{0, 1, 2}};
    make_tangents(s);
    for (const Tangent& t : s.tangents) {
        EXPECT_NEAR(length(t.direction), 1, 1e-5f);
        EXPECT_NEAR(t.direction.z, 0, 1e-5f);
    }
}

}  // namespace
}  // namespace verdigris
