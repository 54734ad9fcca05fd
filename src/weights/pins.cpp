#include "weights/pins.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "mesh/geodesic_disc.h"
#include "weights/constants.h"

namespace hf_inner::weights {

PinSites::PinSites(const Pins& pins, const surface::Core& core, Memory& memory) : sites(&memory), pin(&memory) {
  Vector<Index> owner(at(core.size()), -1, &memory);
  const auto add = [&](const solve::Site& site, Index p) {
    if (site.is_vertex()) {
      Index& there = owner[at(site.vertex[0])];
      if (there >= 0)
        fail(HF_ERROR_DUPLICATE, static_cast<std::uint32_t>(p),
             "pin %d covers a vertex of pin %d; leave one out or make its radius smaller", p, there);
      there = p;
    }
    sites.push_back(site);
    pin.push_back(p);
  };
  for (std::size_t p = 0; p < pins.count(); ++p) {
    const solve::Site& place = pins.places[p];
    if (!(pins.radius[p] > 0)) {
      add(place, static_cast<Index>(p));
      continue;
    }
    for (const mesh::DiscVertex& v :
         mesh::geodesic_disc(core.mesh, core.topology(), place.vertex, place.weight, pins.radius[p], memory))
      add(solve::Site::at_vertex(core.mesh, v.vertex), static_cast<Index>(p));
    if (sites.empty() || pin.back() != static_cast<Index>(p)) add(place, static_cast<Index>(p));
  }
}

bool PinSites::operator==(const PinSites& other) const noexcept {
  return pin == other.pin &&
         std::equal(sites.begin(), sites.end(), other.sites.begin(), [](const solve::Site& a, const solve::Site& b) {
           return std::equal(a.vertex, a.vertex + 3, b.vertex) && std::equal(a.weight, a.weight + 3, b.weight);
         });
}

namespace {

std::shared_ptr<const solve::ConstraintSystem> make_system(const solve::ScreenedOperator& screened,
                                                           const PinSites& pins) {
  Memory& memory = *screened.core->memory;
  const auto system = make_shared_in<solve::ConstraintSystem>(memory, screened.view());
  Vector<Index> slots(pins.sites.size(), &memory);
  std::iota(slots.begin(), slots.end(), 0);
  try {
    system->edit({{}, slots, pins.sites});
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_CONFLICT || error.index() >= pins.pin.size()) throw;
    const Index pin = pins.pin[error.index()];
    fail(HF_ERROR_CONFLICT, static_cast<std::uint32_t>(pin),
         "pin %d depends on the other pins of its triangle; a triangle takes three independent points", pin);
  }
  return system;
}

// The weight of a bone that a pin gives.
double share_of(const Pins& pins, std::size_t pin, Index bone) noexcept {
  double sum = 0;
  for (Index i = pins.start[pin]; i < pins.start[pin + 1]; ++i) sum += pins.bone[at(i)] == bone ? pins.share[at(i)] : 0;
  return sum;
}

}  // namespace

std::shared_ptr<const PinnedField> PinnedField::make(std::shared_ptr<const Solution> solution, const Pins& pins,
                                                     const PinnedField* before) {
  const surface::Core& core = *solution->surface->core;
  Memory& memory = *core.memory;
  const auto made = make_owner_in<PinnedField>(core.memory, memory);
  made->sites = PinSites(pins, core, memory);
  if (before && before->solution == solution && before->sites == made->sites) {
    made->system = before->system;
  } else {
    made->system = make_system(*solution->screened, made->sites);
    made->path_solves = made->system->counts().path_solves;
    made->factorisations = made->system->counts().rebases;
  }
  // A bone's field changes if it misses the weight of some pin.
  const std::size_t bones = solution->column_of.size(), width = solution->width(), sites = made->sites.sites.size();
  Vector<std::uint8_t> pinned(bones, 0, &memory);
  for (const Index b : pins.bone) pinned[at(b)] = 1;
  made->column_of.assign(bones, -1);
  Vector<double> values(&memory), column(sites, &memory);
  Vector<Vector<double>> columns(&memory);
  for (std::size_t b = 0; b < bones; ++b) {
    const Index old = solution->column_of[b];
    if (old < 0 && !pinned[b]) continue;
    bool misses = false;
    for (std::size_t s = 0; s < sites; ++s) {
      const solve::Site& site = made->sites.sites[s];
      double present = 0;
      for (int k = 0; k < 3 && old >= 0; ++k) {
        if (site.vertex[k] >= 0) present += site.weight[k] * solution->field[at(site.vertex[k]) * width + at(old)];
      }
      column[s] = share_of(pins, at(made->sites.pin[s]), static_cast<Index>(b));
      misses |= std::fabs(column[s] - present) > pin_tolerance;
    }
    if (!misses) continue;
    made->column_of[b] = static_cast<Index>(made->bone_of.size());
    made->bone_of.push_back(static_cast<Index>(b));
    columns.push_back(column);
  }
  const std::size_t m = made->bone_of.size(), n = at(core.size());
  values.resize(sites * m);
  for (std::size_t c = 0; c < m; ++c) {
    for (std::size_t s = 0; s < sites; ++s) values[s * m + c] = columns[c][s];
  }
  made->field.allocate(memory, n * m);
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t c = 0; c < m; ++c) {
      const Index old = solution->column_of[at(made->bone_of[c])];
      made->field[v * m + c] = old < 0 ? 0.0 : solution->field[v * width + at(old)];
    }
  }
  solution->screened->add_sites(*made->system, values.data(), static_cast<Index>(m), made->field.data(), m);
  made->solution = std::move(solution);
  return made;
}

}  // namespace hf_inner::weights
