#include "field/scalar_field.h"

#include <algorithm>

#include "base/error.h"
#include "surface/vertex_map.h"

namespace hf_inner::field {
namespace {

// Refuses counts that no valid list can have, before any list is read and before any allocation depends on them.
void check_counts(const FieldEdit& edit, std::uint32_t there) {
  solve::check_site_count(edit.remove_count, there);
  const std::uint32_t left = there - edit.remove_count;
  solve::check_site_count(edit.move_count, left);
  solve::check_site_count(edit.set_count, left);
}

}  // namespace

ScalarField::ScalarField(std::shared_ptr<const surface::Core> core, std::int32_t channels, std::uint32_t site_limit,
                         std::shared_ptr<solve::SiteSolver> engine)
    : core_(std::move(core)),
      site_limit_(site_limit),
      sites_(*core_->memory, channels),
      engine_(engine ? std::move(engine) : solve::SiteSolver::make(core_)) {}

ScalarField::ScalarField(const ScalarField& other)
    : core_(other.core_),
      site_limit_(other.site_limit_),
      sites_(other.sites_, *core_->memory),
      engine_(other.engine_->clone()),
      screening_(other.screening_) {}

void ScalarField::prepare_rebase() {
  if (preparing_.exchange(1))
    fail(HF_ERROR_BUSY, HF_NO_INDEX, "another thread is preparing a rebase of this solver; wait for it");
  try {
    std::optional<Prepared> made;
    {
      const std::lock_guard<std::mutex> lock(guard_);
      made.emplace(*this);
    }
    // Uses one thread only: edits and solves on other threads use the threads of the core meanwhile.
    JobRunner alone(1);
    made->engine->rebase(alone);
    const std::lock_guard<std::mutex> lock(guard_);
    prepared_ = std::move(made);
  } catch (...) {
    preparing_ = 0;
    throw;
  }
  preparing_ = 0;
}

// Replaces the engine (the solver of the equations) by the one that prepare_rebase made, with the sites of an edit.
// Returns false if there is none, or if it cannot take these sites; it then waits as it was.
bool ScalarField::adopt(const solve::SiteSet& next) noexcept {
  if (!prepared_ || prepared_->core != core_ || prepared_->screening != screening_) return false;
  try {
    const solve::SiteDifference since(prepared_->sites, next, memory());
    if (!since.empty()) prepared_->engine->edit(since.edit());
  } catch (...) {
    return false;  // the present engine decides about the edit
  }
  prepared_->engine->succeed(*engine_);
  engine_ = std::move(prepared_->engine);
  return true;
}

void ScalarField::edit(const FieldEdit& edit, std::uint32_t* out_sites) {
  const std::lock_guard<std::mutex> lock(guard_);
  check_counts(edit, sites_.count());
  solve::SiteSet next(sites_, memory());
  Vector<std::uint32_t> numbers(&memory());
  next.remove(edit.remove_count, edit.remove_sites);
  next.move(*core_, edit.move_count, edit.move_sites, edit.move_to, site_limit_);
  next.set_values(edit.set_count, edit.set_sites, edit.set_values);
  next.add(*core_, edit.add, edit.add_holds, site_limit_, numbers);
  const solve::SiteDifference difference(sites_, next, memory());
  if (!adopt(next) && !difference.empty()) {
    try {
      engine_->edit(difference.edit());
    } catch (Error& error) {
      if (error.code() != HF_ERROR_CONFLICT || error.index() >= difference.add.size()) throw;
      // The error index of the engine (the solver of the equations) is a position in its own list of sites. Finds the
      // position in the caller's list instead.
      const std::size_t found = static_cast<std::size_t>(difference.add[error.index()]);
      const std::int32_t owner = next.slots()[found].owner;
      const std::uint32_t slot = static_cast<std::uint32_t>(owner >= 0 ? owner : difference.add[error.index()]);
      for (std::uint32_t i = 0; i < edit.add.count; ++i) {
        if (numbers[i] == slot)
          fail(HF_ERROR_CONFLICT, i,
               "site %u of the batch depends linearly on hard sites that are there (a triangle takes three independent "
               "points); leave it out or make it soft",
               i);
      }
      for (std::uint32_t i = 0; i < edit.move_count; ++i) {
        if (edit.move_sites[i] == slot)
          fail(HF_ERROR_CONFLICT, i,
               "entry %u of the list: at its new place site %u depends linearly on hard sites that are there; choose "
               "another place",
               i, slot);
      }
      throw;
    }
  }
  prepared_.reset();
  sites_.swap(next);
  if (out_sites) std::copy(numbers.begin(), numbers.end(), out_sites);
}

void ScalarField::set_screening(Span<const double> strength, const double* target) {
  const std::lock_guard<std::mutex> lock(guard_);
  if (!engine_->takes_screening() || core_->field_kind != mesh::FieldKind::harmonic || core_->mesh.is_graph())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "only harmonic fields on a mesh can be screened, in solvers of hf_create; make such a solver");
  std::shared_ptr<const solve::Screening> screening;
  if (!strength.empty()) screening = solve::Screening::make(core_, strength, target, sites_.channels());
  std::shared_ptr<solve::SiteSolver> engine =
      screening ? make_owner_in<solve::ScreenedSolver>(core_->memory, screening) : solve::SiteSolver::make(core_);
  take_engine(std::move(engine));
  screening_ = std::move(screening);
}

// Replaces the engine by one without sites, which gets all of them.
void ScalarField::take_engine(std::shared_ptr<solve::SiteSolver> engine) {
  const solve::SiteDifference difference(solve::SiteSet(memory(), sites_.channels()), sites_, memory());
  if (!difference.empty()) engine->edit(difference.edit());
  prepared_.reset();
  engine_ = std::move(engine);
}

void ScalarField::move_to(std::shared_ptr<const surface::Core> core) {
  const std::lock_guard<std::mutex> lock(guard_);
  std::shared_ptr<const surface::VertexMap> map;
  if (!core->mesh.shares(core_->mesh))
    map = make_shared_in<surface::VertexMap>(memory(), core_->mesh, core->mesh, memory());
  std::shared_ptr<solve::SiteSolver> engine = engine_->on(core, map);
  if (!engine)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a baseline stays on its surface; make the solver with hf_create");
  std::shared_ptr<const solve::Screening> screening;
  if (screening_ && map)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "the solver is screened, and the surface has other triangles: take the screening off, move, and set it again");
  if (screening_) {
    const Vector<double>& target = screening_->target;
    screening =
        solve::Screening::make(core, screening_->strength, target.empty() ? nullptr : target.data(), sites_.channels());
    engine = make_owner_in<solve::ScreenedSolver>(core->memory, screening);
  }
  solve::SiteSet next(sites_, memory());
  next.take_core(*core_, *core);
  sites_.swap(next);
  try {
    take_engine(std::move(engine));
  } catch (...) {
    sites_.swap(next);
    throw;
  }
  screening_ = std::move(screening);
  core_ = std::move(core);
}

void ScalarField::require_sites() const {
  if (sites_.count() == 0 && !(screening_ && screening_->reaches_any))
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the solver has no sites; add at least one before solving");
}

void ScalarField::solve(double* field) const {
  require_sites();
  engine_->solve(sites_.values(), sites_.channels(), field, nullptr);
}

void ScalarField::solve_into(solve::FieldSink& sink) const {
  require_sites();
  engine_->solve_into(sites_.values(), sites_.channels(), sink);
}

solve::PreviewInfo ScalarField::solve_preview(std::int32_t corrections, double* field) const {
  require_sites();
  solve::PreviewInfo info;
  engine_->solve_preview(sites_.values(), sites_.channels(), corrections, field, info);
  return info;
}

void ScalarField::solve_at(Span<const std::int32_t> vertices, double* out) const {
  require_sites();
  engine_->solve_at(sites_.values(), sites_.channels(), vertices, out);
}

void ScalarField::flux(Vector<double>& out, double* field) const {
  // After an undo the engine may have slots for more sites than the site set.
  const std::size_t channels = static_cast<std::size_t>(sites_.channels()), slots = sites_.slots().size();
  out.assign(std::max(slots, static_cast<std::size_t>(engine_->slot_count())) * channels, 0.0);
  // The engine green computes fluxes without a sweep; other engines need to solve for the field.
  if (sites_.count() > 0) engine_->solve(sites_.values(), sites_.channels(), field, out.data());
  out.resize(slots * channels);
}

void ScalarField::site_flux(Vector<double>& out) const {
  flux(out);
  const std::size_t m = static_cast<std::size_t>(sites_.channels());
  for (std::size_t s = 0; s < sites_.slots().size(); ++s) {
    const std::int32_t owner = sites_.slots()[s].owner;
    for (std::size_t c = 0; owner >= 0 && c < m; ++c) out[static_cast<std::size_t>(owner) * m + c] += out[s * m + c];
  }
  for (std::size_t s = 0; s < sites_.slots().size(); ++s) {
    const solve::SiteSet::Slot& slot = sites_.slots()[s];
    if (!slot.is_site()) continue;
    const double unit = core_->flux_unit(slot.site.component);
    for (std::size_t c = 0; c < m; ++c) out[s * m + c] = unit * out[s * m + c];
  }
}

}  // namespace hf_inner::field
