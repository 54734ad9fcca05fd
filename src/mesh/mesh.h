// The mesh that all of src works on: vertices are welded, centred and scaled, triangles are usable, components are
// known.
//
// Mesh::make checks the input, welds vertices, cuts faces, drops triangles with two equal corners, sets doubled faces
// aside, numbers the components and counts faults of the mesh. An inner vertex is a welded vertex of at least one
// usable triangle. Maps lead from inner vertices back to the vertices of the caller. An inner position is p' = (p -
// centre) / scale, with the diagonal of the box of all inner vertices as scale. So no result depends on the unit or the
// offset of the input. Cost: O(n log n) for the weld, O(n) for the rest. After a failure no memory stays allocated.
#pragma once
#include <cstdint>
#include <cstring>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/shared_vector.h"
#include "base/span.h"
#include "base/vec3.h"
#include "mesh/faces.h"

namespace hf_inner::mesh {

using Triangle = std::int32_t[3];

enum class Weld : std::int32_t { exact = 0, none = 1, tolerance = 2 };

struct MeshInput {
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;
  ConstRows positions;  // vertex_count x 3
  IndexRows triangles;  // triangle_count x 3
  FaceRows faces;       // instead of triangles, if it has any; triangle_count is then 0
  Weld weld = Weld::exact;
  double weld_tolerance = 0;
};

struct MeshReport {
  std::uint32_t vertex_count = 0, triangle_count = 0, welded_vertex_count = 0, component_count = 0,
                isolated_vertex_count = 0;
  std::uint32_t degenerate_triangle_count = 0, collapsed_triangle_count = 0, duplicate_triangle_count = 0;
  std::uint32_t non_manifold_edge_count = 0, flipped_edge_count = 0, boundary_edge_count = 0, negative_edge_count = 0;
  std::uint32_t inside_out_count = 0;  // closed components that face inwards
  std::int32_t first_inside_out = -1;  // the first vertex of one, inner numbers
  double smallest_angle = 0, bounding_box_diagonal = 0;
};

// Largest number of vertices, triangles, or edges of a graph. Arrays hold up to six entries for each, and their indices
// must fit 31 bits.
constexpr std::uint32_t most_elements = 0x7fffffffu / 6;

// Copies share their arrays.
struct Mesh {
  static constexpr std::int32_t none = -1;

  explicit Mesh(Memory& memory)
      : positions(memory),
        corners(memory),
        inner_of_given(memory),
        given_of_inner(memory),
        triangle_of_given(memory),
        doubled(memory),
        turned(memory),
        refilled(memory),
        faces(memory),
        component(memory),
        isolated(memory),
        returned(memory),
        cuts(memory) {}

  // Throws HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE (index = triangle or face), HF_ERROR_NON_FINITE (index = vertex),
  // HF_ERROR_INVALID_ARGUMENT, or std::bad_alloc. jobs: threads to use; null = the calling thread, with the same
  // result.
  static Mesh make(const MeshInput& input, Memory& memory, JobRunner* jobs = nullptr);

  std::int32_t vertex_count() const noexcept { return static_cast<std::int32_t>(positions.size()); }
  std::int32_t triangle_count() const noexcept { return static_cast<std::int32_t>(corners.size() / 3); }
  std::int32_t component_count() const noexcept { return static_cast<std::int32_t>(report.component_count); }
  // The triangle or face as given that usable triangle t belongs to.
  std::uint32_t given_of_triangle(std::int32_t t) const noexcept;
  const std::int32_t* triangle(std::int32_t t) const noexcept {
    return corners.data() + std::size_t{3} * static_cast<std::size_t>(t);
  }
  // Whether both have the same vertices and triangles, because one was made of the other and shares its arrays.
  bool shares(const Mesh& other) const noexcept {
    return given_of_inner.data() == other.given_of_inner.data() &&
           given_of_inner.size() == other.given_of_inner.size() && corners.data() == other.corners.data();
  }
  // Returns the inner vertex that is true and comes first in the caller's order, or none.
  template <class True>
  std::int32_t first_of_given(True&& is_true) const {
    for (const std::int32_t v : inner_of_given) {
      if (v != none && is_true(v)) return v;
    }
    return none;
  }
  // A surface made of a graph (graph.h) has no triangles; one made of a mesh always has some.
  bool is_graph() const noexcept { return corners.empty(); }
  // to_given converts an inner position to the caller's frame: centre + scale p. to_inner converts back.
  Vec3 to_given(Vec3 p) const noexcept { return centre + scale * p; }
  Vec3 to_inner(Vec3 p) const noexcept { return (1.0 / scale) * (p - centre); }

  // By inner vertex: its position, centred and scaled.
  SharedVector<Vec3> positions;
  // The inner vertices of every usable triangle, three each.
  SharedVector<std::int32_t> corners;
  // By given vertex: its inner vertex, or none for an isolated one.
  SharedVector<std::int32_t> inner_of_given;
  // By inner vertex: the first of the caller's vertices that were welded to it. Ascending, unless the caller's order
  // is bad for the cache (vertex_order.h).
  SharedVector<std::int32_t> given_of_inner;
  // By given triangle: its usable triangle, or none. By given face: the first triangle of its cut, or none. A doubled
  // one has the triangle of the first.
  SharedVector<std::int32_t> triangle_of_given;
  // A given triangle, or one of the cut of a given face, that lies on a usable triangle and was set aside
  // (doubled_faces.h). A first one whose usable triangle was turned round is listed too.
  struct Doubled {
    std::int32_t given;
    std::int32_t corner[3];  // inner vertices, in the caller's order
    bool mirrored;           // it runs against the usable triangle
  };
  // Ascending by `given`.
  SharedVector<Doubled> doubled;
  // The given vertices whose faces all run against the usable ones, ascending: the copies on the second side of a
  // two-sided sheet. Their normals are the opposite ones.
  SharedVector<std::int32_t> turned;
  // Usable triangles that a patch gave another number (mesh_patch.h), ascending.
  struct Refilled {
    std::int32_t triangle, given;
  };
  SharedVector<Refilled> refilled;
  // Empty if the caller gave triangles.
  Faces faces;
  // Meshes of one family with the same one number the vertices alike that they share (mesh_patch.h).
  std::shared_ptr<const char> numbering;
  // By inner vertex: the number of its component.
  SharedVector<std::int32_t> component;
  struct Isolated {
    std::int32_t given;
    Vec3 position;  // as given
  };
  // The given vertices without a usable triangle, ascending. They keep their places when the rest is posed.
  SharedVector<Isolated> isolated;
  // The given vertices that were isolated and came in again by patches, ascending; one that came twice is listed twice.
  // A vertex that came in again is another unknown than before (vertex_map.h).
  SharedVector<std::int32_t> returned;
  // A corner that a cut gave another vertex (cut_edges.h). All numbers are the caller's.
  struct CutCorner {
    std::int32_t triangle, corner, vertex, copied;
  };
  // All cuts since the mesh was made, in their order.
  SharedVector<CutCorner> cuts;
  Vec3 centre;
  double scale = 1;
  MeshReport report;
};

// Finds the smallest angle of a mesh, and counts triangles of zero area that its intake did not set aside.
void measure_triangles(const Mesh& mesh, MeshReport& report, JobRunner* jobs, Memory& memory);

}  // namespace hf_inner::mesh
