// SPDX-License-Identifier: MIT
// Where rays meet a shape (Embree behind).
#pragma once

#include <cstdint>
#include <memory>

#include "verdigris/render/shape.h"

namespace verdigris {

struct RayHit {
    bool hit = false;
    float distance = 0;
    std::uint32_t triangle = 0;
    float second = 0, third = 0;  ///< barycentric shares of the second and the third corner
    Vec3F face;                   ///< of the triangle, not of length 1, to its front
};

/// Keeps a copy of the positions; the shape need not outlive it.
class Tracer {
  public:
    /// Throws Error{failed} if memory runs out. About 0.25 s and 100 MB per million triangles; on
    /// one thread, because a tree that is built on several need not be the same twice.
    explicit Tracer(const Shape& shape);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    /// The nearest hit along a unit direction. For any number of threads.
    RayHit nearest(Vec3F from, Vec3F direction) const;
    bool blocked(Vec3F from, Vec3F direction) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace verdigris
