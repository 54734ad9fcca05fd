// A region of a surface that the user edits, and its smooth base surface.
//
// The base surface replaces the vertices inside the region by a smooth field u. It interpolates the positions p around
// the region:
//
//     K_II u_I = -K_IS p_S      I: vertices inside, S: sites around them (region_shape.h)
//
// K is the Laplacian L for a membrane, and L M^-1 L for a thin plate. The sites S are hard constraints of an engine,
// which uses the factor of the whole surface. S separates I from the rest, so the other vertices do not matter. An edit
// adds and removes only the sites that change. A state is immutable, so records, clones and carried detail share it.
//
// An edit solves the elimination paths and dense rows of the new sites, then runs one backward sweep for three
// coordinates. For a small region (whole_sweep_share) the sweep covers only the elimination paths of I. A failed edit
// changes nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "base/progress.h"
#include "detail/curve.h"
#include "detail/region_shape.h"
#include "mesh/surface_curve.h"
#include "solve/site_solver.h"

namespace hf_inner::detail {

// The surface on which regions lie. Positions have one row per vertex of the caller's mesh, in the caller's unit.
struct RegionSurface {
  RegionSurface(std::shared_ptr<const surface::Core> shared, Vector<Vec3>&& given);
  Vec3 position(std::int32_t inner) const noexcept {
    return positions[static_cast<std::size_t>(core->mesh.given_of_inner[static_cast<std::size_t>(inner)])];
  }
  Vec3 position(const mesh::CurvePoint& point) const noexcept;
  // Returns the position centred and scaled. Lengths, areas and normals use it, because squares in the caller's unit
  // may overflow.
  Vec3 scaled_position(std::int32_t inner) const noexcept { return core->mesh.to_inner(position(inner)); }
  std::shared_ptr<const surface::Core> core;
  Vector<Vec3> positions;   // by vertex of the caller's mesh
  Vector<Vec3> normal_sum;  // by inner vertex: sum of the cross products of its triangles, scaled
};

// Returns one position per vertex of the caller's mesh: `given`, or the mesh's own positions if `given` is empty.
// Throws HF_ERROR_NON_FINITE; index: the vertex of the caller's mesh.
Vector<Vec3> positions_of(const surface::Core& core, const ConstRows& given);

// How the points of a curve are joined.
enum class CurveKind : std::int32_t { straight = 0, edges = 1 };

struct RegionEdit {
  Span<const mesh::CurvePoint> curve;  // the curve's points; empty: no curve
  CurveKind kind = CurveKind::straight;
  CurveSide side = CurveSide::smaller;
  std::int32_t seed = -1;
  std::int32_t rings = 0;
  Span<const std::int32_t> remove, add;  // inner vertices
};

struct RegionState {
  RegionState(const RegionSurface& surface, std::shared_ptr<const RegionShape> shape, Memory& memory);
  std::shared_ptr<const RegionShape> shape;
  std::shared_ptr<const solve::SiteSolver> engine;
  Vector<std::int32_t> slot;  // number of each site (constrained vertex around the region) in the engine.
  Vector<Vec3> base;          // positions of the smooth base surface by vertex inside, in the caller's unit.
  // By vertex around the region: scaled sum of the cross products of its triangles outside the region.
  Vector<Vec3> outer_normal;
  std::int32_t first = -1;  // vertex that matches on carried detail: of the rim, nearest to the curve's first point
  std::shared_ptr<const Vector<Vec3>> curve;          // the last curve, in the caller's unit; null: none
  std::uint32_t inserted = 0, removed = 0, kept = 0;  // counts of sites in the last edit.
  bool whole_sweep = false;
  double area = 0, base_area = 0;  // of the region and of its base surface, on the scaled mesh.
};

class Region {
 public:
  explicit Region(std::shared_ptr<const RegionSurface> surface);
  Region(const Region& other);

  // Throws those errors of hf_region_edit that concern the region itself.
  void edit(const RegionEdit& edit);

  const std::shared_ptr<const RegionSurface>& surface() const noexcept { return surface_; }
  const std::shared_ptr<const RegionState>& state() const noexcept { return state_; }
  const surface::Core& core() const noexcept { return *surface_->core; }

 private:
  Memory& memory() const noexcept { return *surface_->core->memory; }

  std::shared_ptr<const RegionSurface> surface_;
  std::shared_ptr<const RegionState> state_;
};

}  // namespace hf_inner::detail
