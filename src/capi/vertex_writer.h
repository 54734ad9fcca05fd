// Writes the values of welded vertices to the vertices of the caller. Every welded copy gets the row of its vertex.
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/compiler.h"
#include "base/error.h"
#include "base/span.h"
#include "mesh/places.h"
#include "solve/site_solver.h"

namespace hf_inner::capi {

// Vertices of one thread's job where points, or rows of a field, are written: smaller jobs cost more to start, larger
// ones leave threads idle. On one thread half and double of a field's take as long within 7 % on a torus of 202,500
// vertices. No result depends on them.
constexpr std::size_t points_piece = 32768, field_piece = 16384;
// A loop asks for the row that it reads this many vertices later, since rows lie in random order. More leave the cache
// again, fewer come late. On a torus of 202,500 vertices 12 and 48 take as long within 4 %. Without it eight channels
// take a tenth longer.
constexpr std::size_t rows_ahead = 24;

// Calls visit(given, inner) on all threads, for `count` vertices of the caller from `first` on. inner is as in
// visit_given. core: a Core or a Geometry.
template <class Shape, class Visit>
void for_each_given(const Shape& core, std::size_t first, std::size_t count, Visit&& visit) {
  constexpr std::size_t piece = points_piece;
  core.jobs->for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t begin = first + p * piece, end = std::min(first + count, begin + piece);
    mesh::visit_given(core.mesh, begin, end, visit);
  });
}

inline void put(Vec3 p, double* values) noexcept {
  values[0] = p.x;
  values[1] = p.y;
  values[2] = p.z;
}

// Finds the first vertex of the caller's mesh with a number that is too large for the caller's array. All threads look
// at once.
class Overflow {
 public:
  explicit Overflow(bool is_double) noexcept
      : most_(is_double ? std::numeric_limits<double>::max() : static_cast<double>(std::numeric_limits<float>::max())) {
  }
  void look(std::size_t v, double value) noexcept {
    if (!(std::fabs(value) > most_)) return;
    std::size_t known = first_.load(std::memory_order_relaxed);
    while (v < known && !first_.compare_exchange_weak(known, v, std::memory_order_relaxed)) continue;
  }
  // Throws HF_ERROR_TOO_LARGE (index = vertex).
  void check() const {
    const std::size_t v = first_.load(std::memory_order_relaxed);
    if (v == none) return;
    const bool is_float = most_ < std::numeric_limits<double>::max();
    fail(HF_ERROR_TOO_LARGE, static_cast<std::uint32_t>(v), "the result at vertex %zu is beyond %g: %s", v, most_,
         is_float ? "take doubles, or scale the input down" : "scale the input down");
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const double most_;
  std::atomic<std::size_t> first_{none};
};

// A pose moves the surface up to farthest_pose box diagonals away. Parts that bend between its handles may go some
// times as far. A larger factor would refuse float positions of meshes that fit.
constexpr double float_room = 1e3 * mesh::farthest_pose;
// Refuses float positions of poses of a mesh that may leave the range of floats. It is asked before the frame, since a
// refused call changes no pose. Throws HF_ERROR_TOO_LARGE (index = an isolated vertex, or none).
inline void require_float_positions(const mesh::Mesh& mesh) {
  constexpr double most = static_cast<double>(std::numeric_limits<float>::max());
  const Vec3 c = mesh.centre;
  const double reach = std::max({std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)}) + float_room * mesh.scale;
  if (!(reach <= most))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "the mesh is %g wide; floats may not hold poses of it: take positions as doubles, or scale the mesh down",
         mesh.scale);
  Overflow overflow(false);
  for (const mesh::Mesh::Isolated& entry : mesh.isolated) {
    for (const double x : {entry.position.x, entry.position.y, entry.position.z})
      overflow.look(static_cast<std::size_t>(entry.given), x);
  }
  overflow.check();
}

// Fills the row of an isolated vertex. A null function pointer stands for a row of zeros.
using IsolatedRow = void (*)(const mesh::Mesh::Isolated& entry, double* values);
inline void put_rest(const mesh::Mesh::Isolated& entry, double* values) { put(entry.position, values); }
inline void put_up(const mesh::Mesh::Isolated&, double* values) { put({0, 0, 1}, values); }

// Writes rows of `width` numbers for the caller's vertices first .. first + count - 1. row(inner, values) fills the row
// of a welded vertex. Row 0 of `out` is the row of vertex `first`.
template <class Shape, class Row>
void write_range(const Shape& core, std::size_t first, std::size_t count, std::size_t width, const Rows& out,
                 IsolatedRow isolated, Row&& row) {
  for_each_given(core, first, count, [&](std::size_t v, std::int32_t inner) {
    if (inner == mesh::Mesh::none) return;
    double values[solve::most_channels];
    row(static_cast<std::size_t>(inner), values);
    for (std::size_t c = 0; c < width; ++c) out.set(v - first, c, values[c]);
  });
  for (const mesh::Mesh::Isolated& entry : core.mesh.isolated) {
    const std::size_t v = static_cast<std::size_t>(entry.given);
    if (v < first || v >= first + count) continue;
    double values[solve::most_channels] = {0};
    if (isolated) isolated(entry, values);
    for (std::size_t c = 0; c < width; ++c) out.set(v - first, c, values[c]);
  }
}

template <class Shape, class Row>
void write_vertices(const Shape& core, std::size_t width, const Rows& out, IsolatedRow isolated, Row&& row) {
  write_range(core, 0, core.mesh.report.vertex_count, width, out, isolated, row);
}

// Writes the points of all vertices. It is faster than write_vertices, because it makes no call per number. With
// keeps_order, the welded vertices are the caller's vertices in the same order, and a plain loop suffices.
template <class Real, class Point>
void write_points_as(const surface::Core& core, bool keeps_order, Span<const Point> points, const Rows& out,
                     IsolatedRow isolated) {
  char* const bytes = out.bytes();
  const std::size_t stride = out.stride();
  const auto write_row = [&](std::size_t v, const double x, const double y, const double z) {
    const Real row[3] = {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)};
    std::memcpy(bytes + v * stride, row, sizeof row);
  };
  const bool aligned = reinterpret_cast<std::uintptr_t>(bytes) % alignof(Real) == 0;
  if (keeps_order && aligned && stride == 3 * sizeof(Real)) {
    Real* const numbers = reinterpret_cast<Real*>(bytes);
    constexpr std::size_t piece = points_piece;
    const std::size_t count = core.mesh.report.vertex_count;
    core.jobs->for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
      const auto* from = &points.data()->x;
      for (std::size_t i = 3 * p * piece; i < 3 * std::min(count, (p + std::size_t{1}) * piece); ++i)
        numbers[i] = static_cast<Real>(from[i]);
    });
    return;
  }
  for_each_given(core, 0, core.mesh.report.vertex_count, [&](std::size_t v, std::int32_t inner) {
    if (inner == mesh::Mesh::none) return;
    const Point x = points[static_cast<std::size_t>(inner)];
    write_row(v, static_cast<double>(x.x), static_cast<double>(x.y), static_cast<double>(x.z));
  });
  for (const mesh::Mesh::Isolated& entry : core.mesh.isolated) {
    double values[3] = {0, 0, 0};
    isolated(entry, values);
    write_row(static_cast<std::size_t>(entry.given), values[0], values[1], values[2]);
  }
}
template <class Point>
void write_points(const surface::Core& core, bool keeps_order, Span<const Point> points, const Rows& out,
                  IsolatedRow isolated) {
  if (out.is_double()) return write_points_as<double>(core, keeps_order, points, out, isolated);
  write_points_as<float>(core, keeps_order, points, out, isolated);
}

// Receives the field of a solver from the engine and writes it to the caller's array. Call check() at the end.
class FieldWriter final : public solve::FieldSink {
 public:
  FieldWriter(const surface::Core& core, const Rows& out) noexcept
      : core_(core), out_(out.bytes()), is_double_(out.is_double()), stride_(out.stride()) {}
  void take(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) override {
    if (is_double_) return write<double>(first, count, z, row);
    write<float>(first, count, z, row);
  }
  // Throws as Overflow.
  void check() const { overflow_.check(); }

 private:
  template <class T>
  void write(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) {
    switch (count) {
      case 1:
        return write_rows<T, 1>(first, 1, z, row);
      case 3:
        return write_rows<T, 3>(first, 3, z, row);
      case 8:
        return write_rows<T, 8>(first, 8, z, row);
      default:
        return write_rows<T, 0>(first, static_cast<std::size_t>(count), z, row);
    }
  }

  // Copies the field z of the engine to the caller's rows. M is the number of channels if the compiler knows it, else
  // 0. The rows of z are read in random order, so the loop prefetches rows some vertices ahead.
  template <class T, std::size_t M>
  void write_rows(std::int32_t first, std::size_t count, const double* z, const std::int32_t* row) {
    const std::size_t vertices = core_.mesh.report.vertex_count, m = M > 0 ? M : count;
    const std::int32_t* inner = core_.mesh.inner_of_given.data();
    const auto source_of = [&](std::int32_t i) { return z + static_cast<std::size_t>(row ? row[i] : i) * m; };
    constexpr std::size_t piece = field_piece, ahead = rows_ahead;
    core_.jobs->for_each(static_cast<std::uint32_t>((vertices + piece - 1) / piece), [&](std::uint32_t p) {
      const std::size_t end = std::min(vertices, (p + std::size_t{1}) * piece);
      char* target = out_ + p * piece * stride_ + static_cast<std::size_t>(first) * sizeof(T);
      for (std::size_t v = p * piece; v < end; ++v, target += stride_) {
        if (v + ahead < end && inner[v + ahead] != mesh::Mesh::none) HF_PREFETCH(source_of(inner[v + ahead]));
        T values[M > 0 ? M : 1];
        if (inner[v] == mesh::Mesh::none) {
          for (std::size_t c = 0; c < m; ++c) std::memset(target + c * sizeof(T), 0, sizeof(T));
          continue;
        }
        const double* source = source_of(inner[v]);
        if (sizeof(T) == sizeof(float)) {  // doubles hold every field
          for (std::size_t c = 0; c < m; ++c) overflow_.look(v, source[c]);
        }
        if (M > 0) {
          for (std::size_t c = 0; c < M; ++c) values[c] = static_cast<T>(source[c]);
          std::memcpy(target, values, M * sizeof(T));
          continue;
        }
        for (std::size_t c = 0; c < m; ++c) {
          values[0] = static_cast<T>(source[c]);
          std::memcpy(target + c * sizeof(T), values, sizeof(T));
        }
      }
    });
  }

  const surface::Core& core_;
  char* out_;
  bool is_double_;
  std::size_t stride_;
  Overflow overflow_{false};
};

}  // namespace hf_inner::capi
