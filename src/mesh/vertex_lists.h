// Reads lists of vertices and regions that the caller names.
#pragma once
#include "base/arguments.h"
#include "mesh/places.h"

namespace hf_inner::mesh {

// Appends the welded vertex of every vertex in the caller's list, or Mesh::none for an isolated vertex. Throws
// HF_ERROR_OUT_OF_RANGE with the position in the list.
inline void append_inner(const Mesh& mesh, std::size_t count, const std::uint32_t* vertices, const char* name,
                         Vector<std::int32_t>& out) {
  for (std::size_t i = 0; i < count; ++i) out.push_back(inner_vertex(mesh, vertices[i], i, name));
}

// Same as append_inner, but throws HF_ERROR_INVALID_ARGUMENT for an isolated vertex.
inline void append_usable(const Mesh& mesh, std::size_t count, const std::uint32_t* vertices, const char* name,
                          Vector<std::int32_t>& out) {
  for (std::size_t i = 0; i < count; ++i) out.push_back(usable_vertex(mesh, vertices[i], i, name));
}

// Refuses a list that is longer than the number of vertices.
inline void check_vertex_count(const Mesh& mesh, std::uint32_t count, const char* name) {
  if (count > mesh.report.vertex_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%s is %u; the mesh has %u vertices", name, count, mesh.report.vertex_count);
}

// Reads a list of vertices. Refuses NULL and lists that are longer than the number of vertices.
inline void read_list(const Mesh& mesh, std::uint32_t count, const std::uint32_t* vertices, const char* count_name,
                      const char* name, Vector<std::int32_t>& out) {
  require(vertices, name);
  check_vertex_count(mesh, count, count_name);
  append_usable(mesh, count, vertices, name, out);
}

// Sums the sizes of the regions. `start` gets count + 1 entries: where each region starts.
inline void append_starts(std::uint32_t count, const std::uint32_t* sizes, std::uint32_t limit,
                          Vector<std::uint32_t>& start) {
  // A region may name welded copies and repeats. A list this many times as long as the mesh is a mistake. Less refuses
  // regions that name copies at seams: a horse with 4,400 vertices has 1,093 places.
  constexpr std::uint64_t most_repeats = 4;
  std::uint64_t total = 0;
  start.push_back(0);
  for (std::uint32_t r = 0; r < count; ++r) {
    total += sizes[r];
    if (total > most_repeats * limit)
      fail(HF_ERROR_TOO_LARGE, r, "the regions name %llu vertices; the mesh has %u",
           static_cast<unsigned long long>(total), limit);
    start.push_back(static_cast<std::uint32_t>(total));
  }
}

// Regions of one surface, as lists one after the other.
struct Regions {
  Regions(const Mesh& mesh, std::uint32_t count, const std::uint32_t* sizes, const std::uint32_t* list,
          const char* name, Memory* memory)
      : start(memory), vertices(memory) {
    append_starts(count, sizes, mesh.report.vertex_count, start);
    append_usable(mesh, start.back(), list, name, vertices);
  }
  Span<const std::int32_t> operator[](std::uint32_t r) const noexcept {
    return {vertices.data() + start[r], start[r + 1] - start[r]};
  }
  Vector<std::uint32_t> start;
  Vector<std::int32_t> vertices;
};

}  // namespace hf_inner::mesh
