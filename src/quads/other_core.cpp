#include "quads/other_core.h"

#include "quads/poles.h"

namespace hf_inner::quads {

std::shared_ptr<const surface::Core> core_like(const surface::Core& whole, Span<const Vec3> position,
                                               Span<const Index> corner) {
  Vector<std::uint32_t> corners(corner.begin(), corner.end(), whole.memory.get());
  mesh::MeshInput input;
  input.vertex_count = static_cast<std::uint32_t>(position.size());
  input.triangle_count = static_cast<std::uint32_t>(corners.size() / 3);
  input.positions = {&position[0].x, sizeof(Vec3)};
  input.triangles = IndexRows(corners.data(), 3);
  input.weld = mesh::Weld::none;
  surface::CoreOptions options;
  options.operator_kind = whole.geometry->operator_kind;
  options.ordering = whole.ordering;
  options.flop_limit = whole.flop_limit;
  options.formed_valence = whole.formed_valence;
  return surface::Core::make(input, options, whole.memory, whole.jobs);
}

OtherOptions::OtherOptions(const FieldQuadOptions& given, std::shared_ptr<const surface::Core> core, double length)
    : options_(given), lists_(*core->memory) {
  options_.plane.reset();
  options_.edge_length = length / core->mesh.scale;
  options_.core = std::move(core);
}

void OtherOptions::add_guide(const QuadGuide& guide, Index vertex) {
  lists_.guides.push_back(guide);
  lists_.guides.back().vertex = options_.core->mesh.inner_of_given[at(vertex)];
}

void OtherOptions::add_crease(Index a, Index b) {
  const mesh::Mesh& mesh = options_.core->mesh;
  const Index found = options_.core->topology().edge_between(mesh.inner_of_given[at(a)], mesh.inner_of_given[at(b)]);
  if (found != mesh::Mesh::none) lists_.edges.push_back(found);
}

void OtherOptions::add_pole(const QuadPole& pole) {
  lists_.poles.push_back(pole);
  lists_.poles.back().place = options_.core->mesh.to_inner(pole.place);
}

void OtherOptions::add_pole_guides() {
  hf_inner::quads::add_pole_guides(*options_.core, lists_.poles, options_.edge_length, lists_.guides);
}

const FieldQuadOptions& OtherOptions::get() noexcept {
  options_.guides = {lists_.guides.data(), lists_.guides.size()};
  options_.crease_edges = {lists_.edges.data(), lists_.edges.size()};
  options_.poles = {lists_.poles.data(), lists_.poles.size()};
  return options_;
}

}  // namespace hf_inner::quads
