// See pair_fields.h.
#include "transfer/pair_fields.h"

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "deform/rest.h"

namespace hf_inner::transfer {
namespace {
constexpr std::int32_t none = -1;
}  // namespace

PairFields::PairFields(std::shared_ptr<const surface::Core> core)
    : core_(std::move(core)),
      solver_(solve::SiteSolver::make(core_)),
      owner_(at(core_->size()), none, core_->memory.get()),
      regions_(core_->memory.get()) {}

PairFields::PairFields(const PairFields& other)
    : core_(other.core_),
      solver_(other.solver_->clone()),
      owner_(other.owner_, core_->memory.get()),
      regions_(other.regions_, core_->memory.get()) {}

void PairFields::add(Span<const std::uint32_t> numbers, Span<const Span<const std::int32_t>> regions,
                     const char* side) {
  Memory& memory = *core_->memory;
  // All entries are checked before anything changes.
  Vector<std::int32_t> claimed(owner_, &memory);
  std::uint32_t position = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].empty()) {
      fail(HF_ERROR_EMPTY, static_cast<std::uint32_t>(i),
           "pair %zu of the batch has no vertex on the %s; give at least one", i, side);
    }
    for (const std::int32_t v : regions[i]) {
      if (v < 0 || v >= core_->size()) {
        fail(HF_ERROR_OUT_OF_RANGE, position, "entry %u of the %s regions is not a vertex of the surface", position,
             side);
      }
      const auto mine = static_cast<std::int32_t>(numbers[i]);
      if (claimed[at(v)] != none && claimed[at(v)] != mine) {
        fail(HF_ERROR_CONFLICT, position,
             "entry %u of the %s regions belongs to another pair already; regions must not overlap", position, side);
      }
      claimed[at(v)] = mine;
      ++position;
    }
  }

  owner_.swap(claimed);
  const deform::Handles before = listed();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (regions_.size() <= numbers[i]) regions_.resize(numbers[i] + 1);
    regions_[numbers[i]] = deform::make_region(*core_, regions[i], 0, memory);
  }
  deform::set_handle_sites(*core_, *solver_, before, listed(), memory);
}

void PairFields::remove(Span<const std::uint32_t> numbers) {
  const deform::Handles before = listed();
  for (const std::uint32_t number : numbers) {
    for (const std::int32_t v : regions_[number]->vertices) owner_[at(v)] = none;
    regions_[number].reset();
  }
  deform::set_handle_sites(*core_, *solver_, before, listed(), *core_->memory);
}

deform::Handles PairFields::listed() const {
  deform::Handles handles(core_->memory.get());
  for (std::size_t number = 0; number < regions_.size(); ++number) {
    if (regions_[number]) handles.push_back({static_cast<std::uint32_t>(number), regions_[number]});
  }
  return handles;
}

void PairFields::solve(Span<const std::uint32_t> numbers, double* field, double* leaks) const {
  Memory& memory = *core_->memory;
  deform::Handles handles(&memory);
  for (const std::uint32_t number : numbers) handles.push_back({number, regions_[number]});
  const deform::Reach reach(core_->mesh, handles, memory);
  const deform::HandleFields fields = deform::solve_handle_fields(*core_, *solver_, handles, reach, memory);
  const std::size_t count = numbers.size();
  deform::for_vertex_pieces(*core_->jobs, core_->size(), [&](std::int32_t first, std::int32_t last) {
    std::copy(fields.at(first), fields.at(last), field + count * at(first));
  });
  std::copy(fields.leak.begin(), fields.leak.end(), leaks);
  Vector<std::uint8_t> reached(at(core_->mesh.component_count()), std::uint8_t{0}, &memory);
  bool any_island = false;
  for (std::size_t c = 0; c < reached.size(); ++c) {
    reached[c] = !reach.handles_of(static_cast<std::int32_t>(c)).empty();
    any_island = any_island || !reached[c];
  }
  if (any_island) attach_islands(*core_, {reached.data(), reached.size()}, static_cast<std::int32_t>(count), field);
}

}  // namespace hf_inner::transfer
