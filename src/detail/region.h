// A region of a surface under edit, with its base surface: the field of the three coordinates with the surface as
// boundary values,
//
//     K_II u_I = -K_IS p_S      I inside, S sites (region_shape.h); membrane for K = L, thin plate for K = L M^-1 L
//
// on the factor of the core. S are hard sites of an engine (K u = W lambda, W'u = p_S). All other vertices of the mesh
// are unknowns, and S separates I from the rest. An edit compares the sites before and after; sites that stay cost
// nothing. A state is immutable, so records, clones and carried detail share it.
//
// Cost of an edit: paths and dense rows of the new sites, then a backward sweep of three channels. The sweep runs over
// the elimination paths of I if it is small (whole_sweep_share), else over the whole factor. All or nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "base/history.h"
#include "base/progress.h"
#include "detail/curve.h"
#include "detail/region_shape.h"
#include "engine/site_solver.h"

namespace hf_inner {

// The surface that regions lie on: positions of the vertices as given, in the caller's unit.
struct RegionSurface {
  RegionSurface(std::shared_ptr<const Core> shared, Vector<Vec3>&& given);
  Vec3 position(std::int32_t inner) const noexcept {
    return positions[static_cast<std::size_t>(core->mesh.given_of_inner[static_cast<std::size_t>(inner)])];
  }
  // The same, centred and scaled, for lengths, areas and normals: squares in the caller's unit may overflow.
  Vec3 scaled_position(std::int32_t inner) const noexcept { return core->mesh.to_inner(position(inner)); }
  std::shared_ptr<const Core> core;
  Vector<Vec3> positions;   // by vertex as given
  Vector<Vec3> normal_sum;  // by inner vertex: sum of the cross products of its triangles, scaled
};

// Positions by vertex as given: `given`, or where it is empty those of the mesh. Throws HF_ERROR_NON_FINITE (index =
// vertex as given).
Vector<Vec3> positions_of(const Core& core, const ConstRows& given);

struct RegionEdit {
  Span<const std::int32_t> curve;  // points, inner vertices; empty: none
  CurveSide side = CurveSide::smaller;
  std::int32_t seed = -1;
  std::int32_t rings = 0;
  Span<const std::int32_t> remove, add;  // inner vertices
};

struct RegionState {
  RegionState(const RegionSurface& surface, std::shared_ptr<const RegionShape> shape, Memory& memory);
  std::shared_ptr<const RegionShape> shape;
  std::shared_ptr<const SiteSolver> engine;
  Vector<std::int32_t> slot;  // By site of the shape.
  Vector<Vec3> base;          // By vertex inside, in the caller's unit.
  Vector<Vec3> outer_normal;  // By rim vertex: cross products of its triangles that do not move, summed, scaled.
  std::int32_t first = -1;    // Inner vertex where rims are matched: the first point of the curve; -1: none.
  std::uint32_t inserted = 0, removed = 0, kept = 0;  // Sites of the last edit.
  bool whole_sweep = false;
  double area = 0, base_area = 0;  // On the scaled mesh.
};

class Region {
 public:
  explicit Region(std::shared_ptr<const RegionSurface> surface);
  Region(const Region& other);  // without the undo stack

  // Throws the errors of hf_region_edit that concern the region itself.
  void edit(const RegionEdit& edit);
  void record() { history_.record(std::shared_ptr<const RegionState>(state_)); }
  void undo();
  void redo();

  const std::shared_ptr<const RegionSurface>& surface() const noexcept { return surface_; }
  const std::shared_ptr<const RegionState>& state() const noexcept { return state_; }
  const Core& core() const noexcept { return *surface_->core; }

 private:
  Memory& memory() const noexcept { return *surface_->core->memory; }

  std::shared_ptr<const RegionSurface> surface_;
  std::shared_ptr<const RegionState> state_;
  History<std::shared_ptr<const RegionState>> history_;
};

}  // namespace hf_inner
