// Makes handles: regions of vertices that move rigidly. Their boundary rings are sites, and each handle has one
// harmonic field.
//
//     K phi_i = 0 away from the rings,   phi_i = 1 on the ring of handle i, 0 on the rings of the others
//
// This is Section 5.1 of Xu, Zhang, Cohen-Or and Xiong 2009; K is the Laplacian. A ring vertex is a vertex of the
// region with a neighbour outside. Behind a full ring a harmonic field is constant, so the ring alone is enough. The
// paper uses only samples of the ring as sites, which is cheaper. Values then leak between the samples, and the leak is
// measured. Afterwards the fields are made exact on the regions, clipped to [0, 1] and scaled to sum 1. Cost: one path
// solve per site, one backward sweep per handle. A failed call changes nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/constants.h"
#include "mesh/place_reader.h"
#include "solve/site_solver.h"

namespace hf_inner::deform {

// Bounds the regions of a pose or a transfer, each called `noun`. Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE.
void check_region_count(std::size_t there, std::size_t added, const char* noun);

// The part of a handle that never changes.
struct HandleRegion {
  explicit HandleRegion(Memory& memory) : vertices(&memory), sites(&memory) {}
  Vector<std::int32_t> vertices;  // inner, ascending
  Vector<std::int32_t> sites;     // ring vertices that are sites, ascending; none when the region fills its components
  Vec3 centroid;                  // mean of the vertices, in the unit of the scaled mesh
  std::int32_t component = 0;     // component of the first vertex
};

struct Handle {
  std::uint32_t number = 0;
  std::shared_ptr<const HandleRegion> region;
};

// The handles of a pose, in the order of their fields.
using Handles = Vector<Handle>;

// Makes the region of a handle. vertices: inner vertices without Mesh::none; repeated ones count once.
// rim_site_count: number of boundary ring vertices used as sites, 0 for the whole ring.
std::shared_ptr<HandleRegion> make_region(const surface::Core& core, Span<const std::int32_t> vertices,
                                          std::uint32_t rim_site_count, Memory& memory);

// Returns the vertex nearest to a point, in the unit of the scaled mesh.
std::int32_t vertex_near(const surface::Core& core, Vec3 point) noexcept;

// Finds the vertices within a radius of a point. Point and radius are in the unit of the scaled mesh. A region starts
// at a vertex near the point, which always belongs to it. It contains those vertices that are edge-connected to that
// vertex inside the radius. One search finds many regions: each costs its own size.
class RegionSearch {
 public:
  explicit RegionSearch(const surface::Core& core)
      : core_(core), seen_(static_cast<std::size_t>(core.size()), 0, core.memory.get()) {}
  const surface::Core& core() const noexcept { return core_; }
  // Returns the region in ascending order.
  Vector<std::int32_t> from(std::int32_t nearest, Vec3 point, double radius);
  // The same from the vertex nearest to the point. Costs a pass over the mesh.
  Vector<std::int32_t> near(Vec3 point, double radius) { return from(vertex_near(core_, point), point, radius); }

 private:
  const surface::Core& core_;
  Vector<std::uint8_t> seen_;  // all 0 between two searches
};

// Whether a radius is so small that its region is one vertex, which pulls a spike. One vertex of a coarse mesh is none.
bool is_spike(Span<const std::int32_t> region, double radius) noexcept;

// Does the same as RegionSearch for places and radii, in the unit of the caller's mesh. A point in space stands for its
// nearest vertex, any other place for the nearest of its corners. Region r is vertices[start[r] .. start[r + 1]).
// Throws as PlaceReader does, HF_ERROR_NON_FINITE, or HF_ERROR_INVALID_ARGUMENT for a radius that is negative, or makes
// a spike; index: r.
void regions_near(const surface::Core& core, const mesh::Places& places, const double* radii,
                  Vector<std::uint32_t>& start, Vector<std::int32_t>& vertices);

// Lists which handle owns each vertex, and which handles have vertices in each component.
struct Reach {
  Reach(const mesh::Mesh& mesh, const Handles& handles, Memory& memory);
  Vector<std::int32_t> owner;            // by vertex: index of its handle, or -1
  Vector<std::int32_t> component_start;  // handles of component c: handle[start[c] .. start[c + 1]), ascending
  Vector<std::int32_t> handle;
  Span<const std::int32_t> handles_of(std::int32_t component) const noexcept {
    const auto first = static_cast<std::size_t>(component_start[component]),
               last = static_cast<std::size_t>(component_start[component + 1]);
    return {handle.data() + first, last - first};
  }
};

// The field of one handle: one number per vertex, `stride` numbers apart.
template <class Number>
struct FieldColumn {
  Number* first;
  std::size_t stride;
  Number& operator[](std::int32_t v) const noexcept { return first[stride * static_cast<std::size_t>(v)]; }
};

struct HandleFields {
  HandleFields(std::int32_t vertex_count, std::int32_t handle_count, Memory& memory)
      : values(memory, static_cast<std::size_t>(vertex_count) * static_cast<std::size_t>(handle_count)),
        leak(handle_count, 0.0, &memory) {}
  FieldColumn<const double> of(std::int32_t handle) const noexcept { return {values.data() + handle, leak.size()}; }
  FieldColumn<double> of(std::int32_t handle) noexcept { return {values.data() + handle, leak.size()}; }
  // The values of all handles at a vertex. Fields are read vertex by vertex, so they lie side by side.
  const double* at(std::int32_t v) const noexcept { return values.data() + leak.size() * static_cast<std::size_t>(v); }
  double* at(std::int32_t v) noexcept { return values.data() + leak.size() * static_cast<std::size_t>(v); }
  Buffer<double> values;  // vertex by vertex
  Vector<double> leak;    // largest error of the field on the regions, per handle
};

// Gives the solver the sites of `handles`. before: the handles whose sites it has. Slots count the sites of all
// handles, one handle after the other. The solver then gives the bits of one that never had other sites. Cost: the
// elimination paths of the first handle that differs and of all later ones.
void set_handle_sites(const surface::Core& core, solve::SiteSolver& solver, const Handles& before,
                      const Handles& handles, Memory& memory);

// Solves the fields of all handles at once. solver: has the sites of these handles (set_handle_sites).
HandleFields solve_handle_fields(const surface::Core& core, solve::SiteSolver& solver, const Handles& handles,
                                 const Reach& reach, Memory& memory);

}  // namespace hf_inner::deform
