#include "weights/solution.h"

#include <algorithm>

#include "base/error.h"
#include "weights/constants.h"
#include "weights/rigid_pieces.h"

namespace hf_inner::weights {

SkinSurface::SkinSurface(std::shared_ptr<const surface::Core> harmonic)
    : core(std::move(harmonic)), skin(core->mesh, *core->memory) {}

Solution::Solution(std::shared_ptr<const SkinSurface> shape)
    : surface(std::move(shape)),
      faults(surface->core->memory.get()),
      informs(surface->core->memory.get()),
      informants(*surface->core->memory),
      bone_of(surface->core->memory.get()),
      column_of(surface->core->memory.get()) {}

namespace {

// Shares of progress when the informants are found, and when the operator is factorised.
constexpr float progress_informed = 0.3f, progress_factorised = 0.5f;

// Returns the screening H by vertex. On pieces where A H is so small that rounding would lose it beside K, H is scaled
// up.
Vector<double> visible_screening(const surface::Core& core, const Informants& informants) {
  const std::size_t pieces = at(core.mesh.component_count());
  Vector<double> mass(pieces, 0.0, core.memory.get());
  Vector<double> out(informants.screening.begin(), informants.screening.end(), core.memory.get());
  for (std::size_t v = 0; v < out.size(); ++v) mass[at(core.mesh.component[v])] += core.areas[v] * out[v];
  for (std::size_t v = 0; v < out.size(); ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    const double least = least_mass * core.mean_diagonal[c];
    if (mass[c] > 0 && mass[c] < least) out[v] *= least / mass[c];
  }
  return out;
}

// Areas of needles can be 0, so that a piece has information but no mass. Its vertices lose their information.
void drop_massless(const surface::Core& core, Informants& informants) {
  Vector<double> mass(at(core.mesh.component_count()), 0.0, core.memory.get());
  for (std::size_t v = 0; v < informants.screening.size(); ++v)
    mass[at(core.mesh.component[v])] += core.areas[v] * informants.screening[v];
  for (std::size_t c = 0; c < mass.size(); ++c) {
    if (mass[c] > 0) continue;
    informants.informed -= informants.by_piece[c];
    informants.by_piece[c] = 0;
  }
  for (std::size_t v = 0; v < informants.screening.size(); ++v) {
    if (!(mass[at(core.mesh.component[v])] > 0)) informants.screening[v] = 0;
  }
}

std::shared_ptr<const solve::ScreenedOperator> factorise(const std::shared_ptr<const surface::Core>& core,
                                                         const Informants& informants) {
  const Vector<double> screening = visible_screening(*core, informants);
  for (std::size_t i = 0;; ++i) {
    solve::ScreenedOptions options;
    options.least_weight = weight_floors[i];
    try {
      return solve::ScreenedOperator::make(core, screening, options);
    } catch (const Error& error) {
      if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE || i + 1 == std::size(weight_floors)) throw;
    }
  }
}

// Gives pieces one bone. column: by piece, or -1 where the weights stay.
void make_rigid(Solution& made, const Vector<Index>& column) {
  const std::size_t width = made.width();
  const mesh::Mesh& mesh = made.surface->core->mesh;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index own = column[at(mesh.component[at(v)])];
    if (own < 0) continue;
    double* const row = made.field.data() + at(v) * width;
    std::fill_n(row, width, 0.0);
    row[own] = 1;
  }
}

}  // namespace

std::shared_ptr<const Solution> Solution::make(std::shared_ptr<const SkinSurface> shape, const Bones& bones) {
  const std::shared_ptr<const surface::Core> core = shape->core;
  Memory& memory = *core->memory;
  if (std::find(bones.deforms.begin(), bones.deforms.end(), 1) == bones.deforms.end())
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no joint deforms; set deforms of at least one to 1");
  const auto made = make_owner_in<Solution>(core->memory, std::move(shape));
  const mesh::SkinShape& skin = made->surface->skin;
  const Vector<BoneSegment> segments = bone_segments(bones, core->mesh, skin, memory);
  made->faults = bone_faults(bones.count(), segments, skin, memory);
  made->informants = find_informants(core->mesh, skin, segments, memory, *core->jobs);
  drop_massless(*core, made->informants);
  report(progress_informed);

  made->informs.assign(at(bones.count()), 0);
  made->column_of.assign(at(bones.count()), -1);
  for (Index v = 0; v < core->size(); ++v) {
    if (made->informants.screening[at(v)] > 0) {
      for (const Index b : made->informants.of(v)) ++made->informs[at(b)];
    }
  }
  for (Index b = 0; b < bones.count(); ++b) {
    if (made->informs[at(b)] > 0) {
      made->column_of[at(b)] = static_cast<Index>(made->bone_of.size());
      made->bone_of.push_back(b);
    } else if (bones.deforms[at(b)]) {
      made->faults[at(b)] |= bone_informs_none;
    }
  }
  made->screened = factorise(core, made->informants);
  report(progress_factorised);

  const std::size_t width = made->width();
  made->field.allocate(memory, at(core->size()) * width);
  const ProgressRange range(progress_factorised, 1.0f);
  made->screened->solve(static_cast<Index>(width), made->field.data(), width,
                        [&](Index v, Index first, Index count, double* p) {
                          const Span<const Index> own = made->informants.of(v);
                          for (const Index b : own) {
                            const Index column = made->column_of[at(b)] - first;
                            if (column >= 0 && column < count) p[column] = 1.0 / static_cast<double>(own.size());
                          }
                        });
  make_rigid(*made, rigid_columns(*made, bones, segments));
  return made;
}

}  // namespace hf_inner::weights
