// Meshes and fields that are degenerate but ordinary: two-sided sheets, collapsed triangles, flat fields.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hf/hf.h"

namespace reliability {

struct DegenerateMesh {
  std::string name;
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  bool in_float = false;  // given as float positions
  std::int32_t weld = HF_WELD_EXACT;
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangles.size() / 3); }
};

std::vector<DegenerateMesh> degenerate_meshes();

struct DegenerateField {
  std::string name;
  std::vector<double> values;
};

// By vertex of a mesh.
std::vector<DegenerateField> degenerate_fields(const DegenerateMesh& mesh);

// An allocator whose blocks lie behind bytes that are no numbers of use: a read before a block is not luckily 0.
hf_allocator padded_allocator();

}  // namespace reliability
