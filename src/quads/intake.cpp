#include "quads/intake.h"

#include <cmath>
#include <limits>

#include "base/arguments.h"
#include "mesh/vertex_lists.h"
#include "quads/poles.h"

namespace hf_inner::quads {
namespace {

// Refuse mistakes; no result depends on them. hf/quads.h states them.
constexpr std::uint32_t most_wanted_faces = 10000000;
// 16 times the usual rounds.
constexpr std::uint32_t most_relax_count = 1000;
// As shares of the box: below, a mesh would have 10^8 faces; above, none.
constexpr double least_edge_length = 1e-4, most_edge_length = 1.0;
constexpr double most_crease = 3.1416;  // a half turn, with what callers round
// Each irregular vertex is looked for among all vertices: 1,000 take 0.3 s on 300,000. hf/quads.h states it.
constexpr std::uint32_t most_poles = 1000;
// A normal of symmetry_plane is as long as the caller likes, but its square must be a number.
constexpr double least_normal = 1e-150, most_normal = 1e150;

// Returns the edge length in box diagonals.
double read_edge_length(const mesh::Mesh& mesh, double length) {
  check_finite(length, "edge_length");
  if (length == 0) return default_edge_length;
  const double share = length / mesh.scale;
  if (share < least_edge_length || share > most_edge_length)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "edge_length is %g; on this mesh it must be %g to %g, or 0", length,
         least_edge_length * mesh.scale, most_edge_length * mesh.scale);
  return share;
}

// Returns the rounds of relaxation.
std::int32_t read_relax_count(std::uint32_t given) {
  if (given > most_relax_count && given != HF_NO_INDEX)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "relax_count is %u; it must be up to %u, or HF_NO_INDEX", given,
         most_relax_count);
  return given == 0 ? default_relax_rounds : given == HF_NO_INDEX ? 0 : static_cast<std::int32_t>(given);
}

void read_guides(const surface::Core& core, const hf_quads_desc& desc, Vector<QuadGuide>& out) {
  if (desc.guide_count == 0) {
    if (desc.guide_vertices || desc.guide_vectors || desc.guide_weights)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "guide_count is 0, but arrays of guides are given");
    return;
  }
  require(desc.guide_vertices, "guide_vertices");
  require(desc.guide_vectors, "guide_vectors");
  if (desc.guide_count > mesh::most_elements)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "guide_count is %u; it must be up to %u", desc.guide_count,
         mesh::most_elements);
  Vector<Index> inner(core.memory.get());
  mesh::append_usable(core.mesh, desc.guide_count, desc.guide_vertices, "guide_vertices", inner);
  for (std::uint32_t i = 0; i < desc.guide_count; ++i) {
    const double* given = desc.guide_vectors + std::size_t{3} * i;
    if (!is_finite_point(given)) fail(HF_ERROR_NON_FINITE, i, "guide_vectors[%u] is not finite", i);
    const Vec3 vector{given[0], given[1], given[2]};
    if (!(norm(unit_vector(vector)) > 0))
      fail(HF_ERROR_INVALID_ARGUMENT, i, "guide_vectors[%u] is 0; give a direction along the surface", i);
    const double weight = desc.guide_weights ? static_cast<double>(desc.guide_weights[i]) : 1.0;
    if (!std::isfinite(weight)) fail(HF_ERROR_NON_FINITE, i, "guide_weights[%u] is not finite", i);
    if (!(weight > 0) || weight > 1)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "guide_weights[%u] is %g; it must be above 0 and up to 1", i, weight);
    out.push_back({inner[i], vector, weight, static_cast<Index>(i)});
  }
}

void read_poles(const surface::Core& core, const hf_quads_desc& desc, const FieldQuadOptions& options,
                QuadLists& lists) {
  if (desc.irregular_count == 0) {
    if (desc.irregular_points || desc.irregular_valences || desc.irregular_directions)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "irregular_count is 0, but arrays of poles are given");
    return;
  }
  require(desc.irregular_points, "irregular_points");
  require(desc.irregular_valences, "irregular_valences");
  if (desc.irregular_count > most_poles)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "irregular_count is %u; it must be up to %u", desc.irregular_count,
         most_poles);
  Vector<QuadPole>& poles = lists.poles;
  for (std::uint32_t i = 0; i < desc.irregular_count; ++i) {
    const double* point = desc.irregular_points + std::size_t{3} * i;
    if (!is_finite_point(point)) fail(HF_ERROR_NON_FINITE, i, "irregular_points[%u] is not finite", i);
    if (desc.irregular_valences[i] != 3 && desc.irregular_valences[i] != 5)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "irregular_valences[%u] is %u; it must be 3 or 5", i,
           desc.irregular_valences[i]);
    QuadPole pole;
    pole.place = mesh::read_point_near(core.mesh, point, "pole", i);
    pole.quads = static_cast<std::int32_t>(desc.irregular_valences[i]);
    if (desc.irregular_directions) {
      const double* direction = desc.irregular_directions + std::size_t{3} * i;
      if (!is_finite_point(direction)) fail(HF_ERROR_NON_FINITE, i, "irregular_directions[%u] is not finite", i);
      pole.direction = unit_vector({direction[0], direction[1], direction[2]});
    }
    poles.push_back(pole);
  }
  double edge = options.edge_length;
  if (options.faces > 0) {
    double area = 0;
    for (const double own : mesh::vertex_areas(core.mesh, *core.memory)) area += own;
    edge = std::sqrt(area / options.faces);
  }
  add_pole_guides(core, poles, edge, lists.guides);
}

void read_crease_edges(const surface::Core& core, const hf_quads_desc& desc, Vector<Index>& out) {
  if (desc.crease_count == 0) {
    if (desc.crease_edges) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "crease_count is 0, but crease_edges is given");
    return;
  }
  require(desc.crease_edges, "crease_edges");
  if (desc.crease_count > static_cast<std::uint32_t>(core.topology().edge_count()))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "crease_count is %u; the mesh has %d edges", desc.crease_count,
         core.topology().edge_count());
  for (std::uint32_t i = 0; i < desc.crease_count; ++i) {
    const std::uint32_t* given = desc.crease_edges + std::size_t{2} * i;
    const Index a = mesh::usable_vertex(core.mesh, given[0], i, "crease_edges"),
                b = mesh::usable_vertex(core.mesh, given[1], i, "crease_edges");
    const Index e = a == b ? mesh::Mesh::none : core.topology().edge_between(a, b);
    if (e == mesh::Mesh::none)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "crease_edges[%u]: no triangle has an edge from vertex %u to vertex %u", i,
           given[0], given[1]);
    out.push_back(e);
  }
}

std::optional<mesh::MirrorPlane> read_plane(const mesh::Mesh& mesh, const double* given) {
  for (int k = 0; k < 4; ++k) {
    if (!std::isfinite(given[k])) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "symmetry_plane[%d] is not finite", k);
  }
  const Vec3 normal{given[0], given[1], given[2]};
  const double length = norm(normal);
  if (length == 0 && given[3] == 0) return std::nullopt;
  if (!(length > least_normal && length < most_normal))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "symmetry_plane has a normal of length %g; it must be %g to %g, or all four numbers 0", length, least_normal,
         most_normal);
  mesh::MirrorPlane plane;
  plane.normal = (1 / length) * normal;
  plane.offset = (given[3] / length - dot(plane.normal, mesh.centre)) / mesh.scale;
  return plane;
}

}  // namespace

FieldQuadOptions read_field_quad_options(std::shared_ptr<const surface::Core> core, const hf_quads_desc& desc,
                                         QuadLists& lists) {
  if (desc.face_count > most_wanted_faces)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "face_count is %u; it must be up to %u", desc.face_count,
         most_wanted_faces);
  const double crease = desc.crease_angle;
  check_finite(crease, "crease_angle");
  if (crease < 0 || crease > most_crease)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "crease_angle is %g; it must be 0 to %g", crease, most_crease);
  FieldQuadOptions options;
  options.crease = crease;
  options.relax = read_relax_count(desc.relax_count);
  options.edge_length = read_edge_length(core->mesh, desc.edge_length);
  options.faces = static_cast<std::int32_t>(desc.face_count);
  read_crease_edges(*core, desc, lists.edges);
  read_guides(*core, desc, lists.guides);
  read_poles(*core, desc, options, lists);
  options.crease_edges = {lists.edges.data(), lists.edges.size()};
  options.guides = {lists.guides.data(), lists.guides.size()};
  options.poles = {lists.poles.data(), lists.poles.size()};
  options.plane = read_plane(core->mesh, desc.symmetry_plane);
  options.core = std::move(core);
  return options;
}

}  // namespace hf_inner::quads
