// SPDX-License-Identifier: MIT
#include "verdigris/render/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

using Corner = std::uint32_t;  // 3 * triangle + which
constexpr std::uint32_t kNone = ~0u;

Corner next(Corner c) {
    return c % 3 == 2 ? c - 2 : c + 1;
}
Corner previous(Corner c) {
    return c % 3 == 0 ? c + 2 : c - 1;
}

// What makes two vertices one.
struct Key {
    float v[8];
    bool operator<(const Key& other) const {
        return std::lexicographical_compare(v, v + 8, other.v, other.v + 8);
    }
    bool operator==(const Key& other) const { return std::equal(v, v + 8, other.v); }
};
Key key_of(const Shape& s, std::uint32_t i) {
    const Vec3F p = s.positions[i], n = s.normals[i];
    const TextureCoordinate c = s.coordinates[i];
    return {{p.x, p.y, p.z, n.x, n.y, n.z, c.u, c.v}};
}

// For every vertex the first one that equals it.
std::vector<std::uint32_t> welded(const Shape& shape) {
    std::vector<std::uint32_t> order(shape.vertex_count()), first(shape.vertex_count());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Key ka = key_of(shape, a), kb = key_of(shape, b);
        return ka == kb ? a < b : ka < kb;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && key_of(shape, order[i]) == key_of(shape, order[i - 1]);
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

// Of a triangle: the direction in which u grows, and which way its map is turned.
struct FaceSpace {
    Vec3F along_u;
    bool mirrored = false, empty = false;  // empty: no area on the map
};
FaceSpace face_space(const Shape& s, const std::array<std::uint32_t, 3>& t) {
    const auto& c = s.coordinates;
    const float u2 = c[t[1]].u - c[t[0]].u, u3 = c[t[2]].u - c[t[0]].u;
    const float v2 = c[t[1]].v - c[t[0]].v, v3 = c[t[2]].v - c[t[0]].v;
    const float area = u2 * v3 - u3 * v2;
    const Vec3F d2 = s.positions[t[1]] - s.positions[t[0]];
    const Vec3F d3 = s.positions[t[2]] - s.positions[t[0]];
    // v counts down: a map that is not mirrored has a negative area.
    FaceSpace f{unit_or_zero((d2 * v3 - d3 * v2) * (area < 0 ? -1.0f : 1.0f)), area > 0, false};
    f.empty = std::abs(area) <= 1e-30f || dot(f.along_u, f.along_u) == 0;
    return f;
}

// Corners of one vertex, joined where their triangles share an edge there.
class Fans {
  public:
    // `vertex` of a corner, after welding.
    template <class Vertex>
    void group(const std::vector<Corner>& corners, const std::vector<FaceSpace>& faces,
               Vertex vertex) {
        const std::size_t count = corners.size();
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0u);
        leaving_.clear();
        arriving_.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            leaving_.push_back({vertex(next(corners[i])), i});
            arriving_.push_back({vertex(previous(corners[i])), i});
        }
        std::sort(leaving_.begin(), leaving_.end());
        std::sort(arriving_.begin(), arriving_.end());
        // An edge that one triangle leaves along and another arrives along is shared, once.
        for (std::size_t a = 0, b = 0; a < count && b < count;) {
            if (leaving_[a].first != arriving_[b].first) {
                (leaving_[a].first < arriving_[b].first ? a : b)++;
                continue;
            }
            const std::uint32_t i = leaving_[a++].second, j = arriving_[b++].second;
            const FaceSpace &f = faces[corners[i] / 3], &g = faces[corners[j] / 3];
            if (f.empty || g.empty || f.mirrored == g.mirrored) join(i, j);
        }
    }
    std::uint32_t of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

  private:
    void join(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t a = of(i), b = of(j);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::uint32_t> parent_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaving_, arriving_;
};

Vec3F flattened(Vec3F v, Vec3F normal) {
    return unit_or_zero(v - normal * dot(normal, v));
}

// A face's direction in the plane of the vertex, weighted by the angle of its corner there.
Vec3F share(const Shape& s, Corner c, Vec3F normal, const FaceSpace& face) {
    const auto at = [&](Corner k) { return s.positions[s.triangles[k / 3][k % 3]]; };
    const Vec3F a = flattened(at(previous(c)) - at(c), normal);
    const Vec3F b = flattened(at(next(c)) - at(c), normal);
    const float angle = std::acos(std::clamp(dot(a, b), -1.0f, 1.0f));
    return flattened(face.along_u, normal) * angle;
}

}  // namespace

void make_tangents(Shape& shape) {
    const std::vector<std::uint32_t> same = welded(shape);
    const auto corner_count = Corner(3 * shape.triangles.size());
    const auto vertex = [&](Corner c) { return same[shape.triangles[c / 3][c % 3]]; };
    std::vector<FaceSpace> faces;
    faces.reserve(shape.triangles.size());
    for (const auto& t : shape.triangles) faces.push_back(face_space(shape, t));

    // Corners in the order of their vertices.
    std::vector<std::uint32_t> begin(shape.vertex_count() + 1, 0);
    for (Corner c = 0; c < corner_count; ++c) ++begin[vertex(c) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Corner> corners(corner_count);
    std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
    for (Corner c = 0; c < corner_count; ++c) corners[fill[vertex(c)]++] = c;

    Shape made;
    made.triangles.resize(shape.triangles.size());
    made.hides_itself = shape.hides_itself;
    made.beyond = shape.beyond;
    Fans fans;
    std::vector<Corner> around;
    std::vector<std::uint32_t> number;  // of the new vertex of each fan
    for (std::uint32_t v = 0; v < shape.vertex_count(); ++v) {
        if (begin[v] == begin[v + 1]) continue;
        around.assign(corners.begin() + begin[v], corners.begin() + begin[v + 1]);
        fans.group(around, faces, vertex);
        number.assign(around.size(), kNone);
        const Vec3F normal = shape.normals[v];
        for (std::uint32_t i = 0; i < around.size(); ++i) {
            const FaceSpace& face = faces[around[i] / 3];
            std::uint32_t& n = number[fans.of(i)];
            if (n == kNone) {
                n = std::uint32_t(made.vertex_count());
                made.positions.push_back(shape.positions[v]);
                made.normals.push_back(normal);
                made.coordinates.push_back(shape.coordinates[v]);
                made.tangents.push_back({{}, 0});
            }
            Tangent& tangent = made.tangents[n];
            if (!face.empty) {
                tangent.direction = tangent.direction + share(shape, around[i], normal, face);
                tangent.sign = face.mirrored ? -1.0f : 1.0f;
            }
            made.triangles[around[i] / 3][around[i] % 3] = n;
        }
    }
    for (std::size_t i = 0; i < made.vertex_count(); ++i) {
        Tangent& t = made.tangents[i];
        t.direction = unit_or_zero(t.direction);
        if (dot(t.direction, t.direction) == 0) t.direction = frame_around(made.normals[i]).tangent;
        if (t.sign == 0) t.sign = 1;
    }
    shape = std::move(made);
}

}  // namespace verdigris
