// SPDX-License-Identifier: MIT
#include "verdigris/render/model.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/render/model_accessor.h"
#include "verdigris/render/model_matrix.h"
#include "verdigris/render/tangents.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr int kMostDepth = 64;          // of nodes, and of the JSON around them
constexpr float kMostDistance = 1e12f;  // the square of its square is still a number
// Of nodes and of the parts of their meshes: with a few bytes one is asked for a million times.
constexpr std::size_t kMostVisits = 1'000'000;
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kMeshopt = "EXT_meshopt_compression";

[[noreturn]] void refuse(const std::string& where, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, where);
}

// Words of a file, fit for a terminal: no escape sequences, no page of text.
std::string printable(const std::string& text, std::size_t most) {
    std::string shown = text.substr(0, std::min(text.find('\n'), most));
    for (char& c : shown) {
        if (c < ' ' || c > '~') c = '?';
    }
    return shown;
}

std::uint32_t little_endian(const std::vector<std::byte>& b, std::size_t at) {
    return std::uint32_t(b[at]) | std::uint32_t(b[at + 1]) << 8 | std::uint32_t(b[at + 2]) << 16 |
           std::uint32_t(b[at + 3]) << 24;
}

// What tinygltf does not check itself, or checks by recursion.
void check_container(const std::string& where, const std::vector<std::byte>& bytes) {
    if (bytes.size() < 20 || little_endian(bytes, 0) != 0x46546C67) {
        refuse(where, "is not a GLB (binary glTF)");
    }
    if (little_endian(bytes, 4) != 2) refuse(where, "is not a GLB of glTF 2.0");
    const std::size_t json = little_endian(bytes, 12);
    if (little_endian(bytes, 8) > bytes.size() || json > bytes.size() - 20) {
        refuse(where, "is truncated: the GLB ends early");
    }
    if (little_endian(bytes, 16) != 0x4E4F534A) refuse(where, "is a GLB without its JSON");
    int depth = 0;
    bool text = false;
    for (std::size_t i = 20; i < 20 + json; ++i) {
        const char c = char(bytes[i]);
        if (text) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                text = false;
            }
        } else if (c == '"') {
            text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMostDepth) refuse(where, "is a GLB whose JSON is nested too deep");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

tinygltf::Model parsed(const std::string& where, const std::vector<std::byte>& bytes) {
    check_container(where, bytes);
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    // Materials are not looked at: no picture is decoded, no other file is opened.
    loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    std::string elsewhere;  // the first other file that it asks for
    tinygltf::FsCallbacks none{};
    none.user_data = &elsewhere;
    none.FileExists = [](const std::string& path, void* asked) {
        auto& first = *static_cast<std::string*>(asked);
        if (first.empty()) first = path;
        return false;
    };
    none.ExpandFilePath = [](const std::string& path, void*) { return path; };
    none.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
        return false;
    };
    none.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                             void*) { return false; };
    loader.SetFsCallbacks(none);
    std::string errors, warnings;
    bool read = false;
    try {
        read = loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                           reinterpret_cast<const unsigned char*>(bytes.data()),
                                           unsigned(bytes.size()));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        errors = "its parts do not fit together";  // what() speaks of tinygltf's containers
    }
    if (!read && !elsewhere.empty()) {
        refuse(where, fmt::format("keeps a part of itself in another file ('{}'), which is not "
                                  "read; export it as one .glb",
                                  printable(elsewhere, 80)));
    }
    if (!read) {
        const std::string first = printable(errors, 120);
        refuse(where, "is not a valid GLB" + (first.empty() ? "" : ": " + first));
    }
    return model;
}

// Walks the nodes and puts their triangles together.
class Assembly {
  public:
    Assembly(const std::string& where, const tinygltf::Model& model)
        : where_(where), model_(model) {}

    Shape shape() {
        check_extensions();
        const int wanted = model_.defaultScene >= 0 ? model_.defaultScene : 0;
        if (model_.scenes.empty()) {
            for (int i = 0; i < int(model_.meshes.size()); ++i) add_mesh(i, Matrix4{});
        } else {
            if (wanted >= int(model_.scenes.size())) refuse(where_, "has no such scene");
            for (const int node : model_.scenes[std::size_t(wanted)].nodes) {
                add_node(node, Matrix4{}, 0);
            }
        }
        if (shape_.triangles.empty()) refuse(where_, "holds no triangles");
        check_area();
        if (!has_tangents_) {
            shape_.tangents.clear();
            make_tangents(shape_);
        }
        shape_.beyond = Beyond::repeat;
        return std::move(shape_);
    }

  private:
    // What says how a material looks, not where it lies, does not matter here.
    void check_extensions() const {
        for (const std::string& name : model_.extensionsRequired) {
            const auto begins = [&](const char* with) { return name.rfind(with, 0) == 0; };
            if (name == "KHR_mesh_quantization" || name == "KHR_lights_punctual" ||
                begins("KHR_materials_") || begins("KHR_texture_") || begins("EXT_texture_")) {
                continue;
            }
            if (name == kDraco || name == kMeshopt) refuse_compressed(name);
            refuse(where_, fmt::format("needs '{}', an extension of glTF that is not read",
                                       printable(name, 40)));
        }
    }

    [[noreturn]] void refuse_compressed(const std::string& how) const {
        refuse(where_, fmt::format("is compressed ({}), which is not read", how));
    }

    // Of points and lines alone there would be an empty picture and no reason for it.
    void check_area() const {
        for (const auto& t : shape_.triangles) {
            const auto at = [&](std::size_t k) { return shape_.positions[t[k]]; };
            const auto side = [&](std::size_t k) {
                return std::array<double, 3>{double(at(k).x) - double(at(0).x),
                                             double(at(k).y) - double(at(0).y),
                                             double(at(k).z) - double(at(0).z)};
            };
            const std::array<double, 3> a = side(1), b = side(2);
            if (a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2] ||
                a[0] * b[1] != a[1] * b[0]) {
                return;
            }
        }
        refuse(where_, "holds no triangle with an area: nothing of it could be seen");
    }

    void add_node(int index, const Matrix4& parent, int depth) {
        if (index < 0 || index >= int(model_.nodes.size())) refuse(where_, "has no such node");
        if (depth > kMostDepth) refuse(where_, "has nodes within nodes, too deep or in a circle");
        count_visit();
        const tinygltf::Node& node = model_.nodes[std::size_t(index)];
        const std::optional<Matrix4> own =
            matrix_of(node.matrix, node.translation, node.rotation, node.scale);
        if (!own) refuse(where_, fmt::format("has a node ({}) moved by what is no number", index));
        const Matrix4 matrix = parent * *own;
        if (node.mesh >= 0) add_mesh(node.mesh, matrix);
        for (const int child : node.children) add_node(child, matrix, depth + 1);
    }

    void count_visit() {
        if (++visits_ > kMostVisits) refuse(where_, "has more nodes and meshes than can be drawn");
    }

    void add_mesh(int index, const Matrix4& matrix) {
        if (index < 0 || index >= int(model_.meshes.size())) refuse(where_, "has no such mesh");
        for (const tinygltf::Primitive& p : model_.meshes[std::size_t(index)].primitives) {
            count_visit();
            add_primitive(p, matrix);
        }
    }

    Accessor attribute(const tinygltf::Primitive& p, const char* name, int components) const {
        const auto found = p.attributes.find(name);
        if (found == p.attributes.end()) return {};
        return open_accessor(where_, model_, found->second, name, components);
    }

    void add_primitive(const tinygltf::Primitive& p, const Matrix4& matrix) {
        const bool drawn = p.mode == TINYGLTF_MODE_TRIANGLES || p.mode == -1 ||
                           p.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                           p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (!drawn) return;  // points and lines
        for (const char* packed : {kDraco, kMeshopt}) {
            if (p.extensions.count(packed) != 0) refuse_compressed(packed);
        }
        const Accessor positions = attribute(p, "POSITION", 3);
        const Accessor normals = attribute(p, "NORMAL", 3);
        const Accessor tangents = attribute(p, "TANGENT", 4);
        const Accessor coordinates = attribute(p, "TEXCOORD_0", 2);
        if (!positions.valid()) return;
        if (!coordinates.valid()) {
            refuse(where_,
                   "has a mesh without texture coordinates, so no map can be laid on it; unwrap it "
                   "(in Blender: UV > Smart UV Project) and export it again");
        }
        const std::size_t count = positions.count();
        for (const Accessor* a : {&normals, &tangents, &coordinates}) {
            if (a->valid() && a->count() != count) {
                refuse(where_, "has a mesh whose attributes differ in length");
            }
        }
        std::vector<std::uint32_t> order = vertex_order(p, count);
        if (order.empty()) return;
        if (shape_.triangles.size() + order.size() / 3 > kMaxTriangles) {
            refuse(where_, fmt::format("has more than {} triangles", kMaxTriangles));
        }
        has_tangents_ = has_tangents_ && tangents.valid() && normals.valid();

        const Matrix3 turn = matrix.linear();
        const Matrix3 normal_turn = turn.cofactors();  // keeps normals normal under any scale
        const bool mirrored = turn.determinant() < 0;
        const auto first = std::uint32_t(shape_.vertex_count());
        const bool flat = !normals.valid();
        std::vector<std::uint32_t> used;  // empty: all
        if (!flat && count > order.size()) used = only_used(order);
        const std::size_t made = flat ? order.size() : used.empty() ? count : used.size();
        for (std::size_t k = 0; k < made; ++k) {
            const std::size_t i = flat ? order[k] : used.empty() ? k : used[k];
            const auto at = positions.read<3>(i);
            const Vec3F moved = matrix.moved({at[0], at[1], at[2]});
            if (!(dot(moved, moved) < kMostDistance * kMostDistance)) {
                refuse(where_, "has vertices that lie immensely far away");
            }
            shape_.positions.push_back(moved);
            const auto uv = coordinates.read<2>(i);
            shape_.coordinates.push_back({uv[0], uv[1]});
            Vec3F n{0, 0, 1};
            Tangent t;
            if (!flat) {
                const auto v = normals.read<3>(i);
                n = unit_or_zero(normal_turn * Vec3F{v[0], v[1], v[2]});
            }
            if (has_tangents_) {
                const auto v = tangents.read<4>(i);
                t = {unit_or_zero(turn * Vec3F{v[0], v[1], v[2]}),
                     (v[3] < 0 ? -1.0f : 1.0f) * (mirrored ? -1.0f : 1.0f)};
            }
            shape_.normals.push_back(n);
            shape_.tangents.push_back(t);
        }
        for (std::size_t k = 0; k + 2 < order.size(); k += 3) {
            std::array<std::uint32_t, 3> t{};
            for (std::size_t c = 0; c < 3; ++c) {
                t[c] = first + (flat ? std::uint32_t(k + c) : order[k + c]);
            }
            if (mirrored) std::swap(t[1], t[2]);
            if (flat) flatten(t);
            shape_.triangles.push_back(t);
        }
    }

    // The vertices that triangles have, in their order; `order` then counts in these. So no node
    // that shows a mesh again takes more memory than its triangles do.
    static std::vector<std::uint32_t> only_used(std::vector<std::uint32_t>& order) {
        std::vector<std::uint32_t> used = order;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& i : order) {
            i = std::uint32_t(std::lower_bound(used.begin(), used.end(), i) - used.begin());
        }
        return used;
    }

    void flatten(const std::array<std::uint32_t, 3>& t) {
        const auto at = [&](std::size_t c) { return shape_.positions[t[c]]; };
        const Vec3F n = unit_or_zero(cross(at(1) - at(0), at(2) - at(0)));
        for (const std::uint32_t i : t) shape_.normals[i] = n;
    }

    // Three vertices per triangle, whatever the mode.
    std::vector<std::uint32_t> vertex_order(const tinygltf::Primitive& p, std::size_t count) const {
        std::vector<std::uint32_t> listed;
        if (p.indices >= 0) {
            const Accessor indices = open_accessor(where_, model_, p.indices, "indices", 1);
            listed.reserve(indices.count());
            for (std::size_t i = 0; i < indices.count(); ++i) {
                const std::uint32_t index = indices.index(i);
                if (index >= count)
                    refuse(where_, "has a triangle with a vertex that is not there");
                listed.push_back(index);
            }
        } else {
            for (std::size_t i = 0; i < count; ++i) listed.push_back(std::uint32_t(i));
        }
        const std::size_t n = listed.size();
        std::vector<std::uint32_t> order;
        if (p.mode == TINYGLTF_MODE_TRIANGLE_STRIP || p.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            const bool fan = p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
            for (std::size_t i = 0; i + 2 < n; ++i) {
                const std::size_t odd = fan ? 0 : i % 2;
                order.insert(order.end(),
                             {listed[fan ? 0 : i], listed[i + 1 + odd], listed[i + 2 - odd]});
            }
        } else {
            listed.resize(n - n % 3);
            order = std::move(listed);
        }
        return order;
    }

    const std::string& where_;
    const tinygltf::Model& model_;
    Shape shape_;
    bool has_tangents_ = true;
    std::size_t visits_ = 0;
};

}  // namespace

Shape read_model(const std::filesystem::path& path) {
    const std::string where = path.string();
    const tinygltf::Model model = parsed(where, read_file(path));
    return Assembly(where, model).shape();
}

}  // namespace verdigris
