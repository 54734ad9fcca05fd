// From inner vertices back to the vertices as given: every welded copy gets its vertex's row.
#pragma once
#include <algorithm>
#include <cstring>

#include "base/span.h"
#include "engine/site_solver.h"

namespace hf_inner::capi {

// row(inner, values) fills `width` (at most 64) numbers. Isolated vertices get what isolated(entry, values) fills in,
// or zeros without it.
using IsolatedRow = void (*)(const Mesh::Isolated& entry, double* values);

template <class Row>
void scatter(const Core& core, std::size_t width, const Rows& out, IsolatedRow isolated, Row&& row) {
  const std::size_t count = core.mesh.report.vertex_count;
  constexpr std::size_t piece = 32768, most = 64;
  core.jobs->for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    double values[most];
    const std::size_t end = std::min(count, (p + std::size_t{1}) * piece);
    for (std::size_t v = p * piece; v < end; ++v) {
      const std::int32_t inner = core.mesh.inner_of_given[v];
      if (inner == Mesh::none) continue;
      row(static_cast<std::size_t>(inner), values);
      for (std::size_t c = 0; c < width; ++c) out.set(v, c, values[c]);
    }
  });
  for (const Mesh::Isolated& entry : core.mesh.isolated) {
    double values[most] = {0};
    if (isolated) isolated(entry, values);
    for (std::size_t c = 0; c < width; ++c) out.set(static_cast<std::size_t>(entry.given), c, values[c]);
  }
}

// The field of a solver, from where the engine has it to the vertices as given.
class FieldWriter final : public FieldSink {
 public:
  FieldWriter(const Core& core, void* out, bool is_double, std::size_t stride) noexcept
      : core_(core), out_(static_cast<char*>(out)), is_double_(is_double), stride_(stride) {}
  void take(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) override {
    if (is_double_) return write<double>(first, count, z, row);
    write<float>(first, count, z, row);
  }

 private:
  template <class T>
  void write(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) const {
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

  // M: the number of channels when known as the code is compiled, else 0. The rows of z are read in no order, so they
  // are asked for some vertices ahead.
  template <class T, std::size_t M>
  void write_rows(std::int32_t first, std::size_t count, const double* z, const std::int32_t* row) const {
    const std::size_t vertices = core_.mesh.report.vertex_count, m = M > 0 ? M : count;
    const std::int32_t* inner = core_.mesh.inner_of_given.data();
    const auto source_of = [&](std::int32_t i) { return z + static_cast<std::size_t>(row ? row[i] : i) * m; };
    constexpr std::size_t piece = 16384, ahead = 24;
    core_.jobs->for_each(static_cast<std::uint32_t>((vertices + piece - 1) / piece), [&](std::uint32_t p) {
      const std::size_t end = std::min(vertices, (p + std::size_t{1}) * piece);
      char* target = out_ + p * piece * stride_ + static_cast<std::size_t>(first) * sizeof(T);
      for (std::size_t v = p * piece; v < end; ++v, target += stride_) {
        if (v + ahead < end && inner[v + ahead] != Mesh::none) __builtin_prefetch(source_of(inner[v + ahead]));
        T values[M > 0 ? M : 1];
        if (inner[v] == Mesh::none) {
          for (std::size_t c = 0; c < m; ++c) std::memset(target + c * sizeof(T), 0, sizeof(T));
          continue;
        }
        const double* source = source_of(inner[v]);
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

  const Core& core_;
  char* out_;
  bool is_double_;
  std::size_t stride_;
};

inline void put(Vec3 p, double* values) noexcept { values[0] = p.x, values[1] = p.y, values[2] = p.z; }
inline void put_rest(const Mesh::Isolated& entry, double* values) { put(entry.position, values); }
inline void put_up(const Mesh::Isolated&, double* values) { put({0, 0, 1}, values); }

// Inner vertices of a list of vertices as given; isolated ones are Mesh::none. Throws HF_ERROR_OUT_OF_RANGE with the
// position in the list.
inline void append_inner(const Mesh& mesh, std::size_t count, const std::uint32_t* vertices, const char* name,
                         Vector<std::int32_t>& out) {
  for (std::size_t i = 0; i < count; ++i) {
    if (vertices[i] >= mesh.report.vertex_count) {
      fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(i),
           "entry %zu of %s: vertex %u, but there are %u vertices", i, name, vertices[i], mesh.report.vertex_count);
    }
    out.push_back(mesh.inner_of_given[vertices[i]]);
  }
}

// Sum of the region sizes, each at least 1; start has count + 1 entries.
inline void append_starts(std::uint32_t count, const std::uint32_t* sizes, std::uint32_t limit, const char* name,
                          Vector<std::uint32_t>& start) {
  std::uint64_t total = 0;
  start.push_back(0);
  for (std::uint32_t r = 0; r < count; ++r) {
    if (sizes[r] == 0) fail(HF_ERROR_EMPTY, r, "%s[%u] is 0; a region has at least one vertex", name, r);
    total += sizes[r];
    if (total > std::uint64_t{4} * limit)
      fail(HF_ERROR_TOO_LARGE, r, "the regions name %llu vertices; the mesh has %u",
           static_cast<unsigned long long>(total), limit);
    start.push_back(static_cast<std::uint32_t>(total));
  }
}

}  // namespace hf_inner::capi
