#include "transfer/thin_parts.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/skin_shape.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

Vector<std::uint8_t> thin_vertices(const surface::Geometry& geometry, Memory& memory, JobRunner& jobs) {
  const mesh::Mesh& mesh = geometry.mesh;
  const std::size_t n = mesh.positions.size();
  const mesh::SkinShape shape(mesh, memory);
  Vector<std::uint8_t> shallow(n, std::uint8_t{0}, &memory);
  for_ranges(jobs, n, owner_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 through = mesh.positions[v] - thin_width * shape.normals()[v];
      shallow[v] = shape.crosses(mesh.positions[v], through, mesh.component[v], mesh::Mesh::none, true);
    }
  });
  // The normals of a rim point along the sheet: there a neighbour tells.
  Vector<std::uint8_t> out(shallow, &memory);
  const mesh::Topology& topology = geometry.topology();
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    const std::size_t a = at(topology.first(e)), b = at(topology.second(e));
    out[a] |= shallow[b];
    out[b] |= shallow[a];
  }
  return out;
}

Vector<std::uint8_t> idle_vertices(const surface::Geometry& geometry, const double* field, std::size_t width,
                                   Memory& memory) {
  const mesh::Mesh& mesh = geometry.mesh;
  const mesh::Topology& topology = geometry.topology();
  Vector<std::uint8_t> out(mesh.positions.size(), std::uint8_t{1}, &memory);
  Poller poller;
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    poller.due();
    const std::size_t a = at(topology.first(e)), b = at(topology.second(e));
    const double most = idle_slope * norm(mesh.positions[a] - mesh.positions[b]);
    bool changes = false;
    for (std::size_t h = 0; h < width; ++h)
      changes = changes || std::abs(field[a * width + h] - field[b * width + h]) > most;
    if (changes) out[a] = out[b] = 0;
  }
  return out;
}

}  // namespace hf_inner::transfer
