// Computes the weights of all vertices for one set of inputs.
#include <algorithm>

#include "base/unit_weights.h"
#include "weights/constants.h"
#include "weights/pieces.h"
#include "weights/weights.h"

namespace hf_inner::weights {
namespace {

// Shares of progress when the solution stands, and when the pins are solved.
constexpr float progress_solved = 0.8f, progress_pinned = 0.9f;

// Reads the smooth weights of vertices: the solution's, or those that pins changed.
class SmoothRows {
 public:
  SmoothRows(const Solution& solution, const PinnedField* pinned, Memory& memory) : bones(&memory), from_(&memory) {
    const std::size_t count = solution.column_of.size();
    for (std::size_t b = 0; b < count; ++b) {
      const Index pin = pinned ? pinned->column_of[b] : -1, plain = solution.column_of[b];
      if (pin < 0 && plain < 0) continue;
      bones.push_back(static_cast<Index>(b));
      from_.push_back(pin >= 0 ? Column{pinned->field.data() + pin, pinned->bone_of.size()}
                               : Column{solution.field.data() + plain, solution.width()});
    }
  }
  double get(Index v, std::size_t column) const noexcept { return from_[column].data[at(v) * from_[column].stride]; }
  Vector<Index> bones;

 private:
  struct Column {
    const double* data;
    std::size_t stride;
  };
  Vector<Column> from_;
};

// One computation, with what its steps share.
class Computation {
 public:
  Computation(const surface::Core& core, WeightState& state, std::int32_t influences)
      : core_(core),
        memory_(*core.memory),
        state_(state),
        influences_(influences),
        rows_(*state.solution, state.pinned.get(), memory_),
        pin_of_(at(core.size()), -1, &memory_),
        locked_(state.inputs->bones.head.size(), 0, &memory_),
        solved_(at(core.mesh.component_count()), 0, &memory_),
        carriers_(memory_),
        rigid_rows_(&memory_),
        rigid_of_(&memory_) {}

  void run() {
    mark();
    carriers_ = find_carriers(core_.mesh, solved_, memory_, *core_.jobs);
    mean_of_rigid();
    const std::size_t n = at(core_.size()), k = at(influences_);
    state_.joints.resize(n * k);
    state_.weights.resize(n * k);
    state_.origin.resize(n);
    for_ranges(*core_.jobs, n, vertex_piece, [&](std::size_t begin, std::size_t end) {
      Vector<Share> shares(&memory_), locked(&memory_);
      for (std::size_t v = begin; v < end; ++v) write(static_cast<Index>(v), shares, locked);
    });
    state_.nearest_of_isolated = nearest_of_isolated(core_.mesh, memory_);
    count();
  }

 private:
  bool is_locked(Index bone) const noexcept { return locked_[at(bone)] != 0; }

  void mark() {
    const Solution& solution = *state_.solution;
    for (std::size_t c = 0; c < solved_.size(); ++c) solved_[c] = solution.informants.by_piece[c] > 0;
    if (state_.pinned) {
      const PinSites& pins = state_.pinned->sites;
      for (std::size_t s = 0; s < pins.sites.size(); ++s) {
        solved_[at(pins.sites[s].component)] = 1;
        if (pins.sites[s].is_vertex()) pin_of_[at(pins.sites[s].vertex[0])] = pins.pin[s];
      }
    }
    if (state_.inputs->locks) {
      for (const Index b : state_.inputs->locks->bones) locked_[at(b)] = 1;
    }
    const Vector<std::uint8_t>& deforms = state_.inputs->bones.deforms;
    first_bone_ = static_cast<Index>(std::find(deforms.begin(), deforms.end(), 1) - deforms.begin());
  }

  void mean_of_rigid() {
    rigid_of_.assign(solved_.size(), -1);
    Index rows = 0;
    for (std::size_t c = 0; c < rigid_of_.size(); ++c) {
      if (carriers_.rigid[c]) rigid_of_[c] = rows++;
    }
    const std::size_t width = rows_.bones.size();
    rigid_rows_.assign(at(rows) * width, 0.0);
    for (Index v = 0; rows > 0 && v < core_.size(); ++v) {
      const Index row = rigid_of_[at(core_.mesh.component[at(v)])];
      for (std::size_t c = 0; row >= 0 && c < width; ++c)
        rigid_rows_[at(row) * width + c] += rows_.get(carriers_.of[at(v)], c);
    }
    Vector<double> size(at(rows), 0.0, &memory_);
    for (const Index c : core_.mesh.component) {
      if (rigid_of_[at(c)] >= 0) size[at(rigid_of_[at(c)])] += 1;
    }
    for (std::size_t i = 0; i < rigid_rows_.size(); ++i) rigid_rows_[i] /= size[i / width];
  }

  void write(Index v, Vector<Share>& shares, Vector<Share>& locked) const {
    shares.clear();
    locked.clear();
    const std::size_t piece = at(core_.mesh.component[at(v)]);
    const Index pin = pin_of_[at(v)], rigid = rigid_of_[piece], carrier = carriers_.of[at(v)];
    Origin origin = state_.solution->informants.screening[at(v)] > 0 ? Origin::informed : Origin::solved;
    if (pin >= 0) {
      origin = Origin::pinned;
      const Pins& pins = state_.inputs->pins;
      for (Index i = pins.start[at(pin)]; i < pins.start[at(pin) + 1]; ++i)
        shares.push_back({pins.bone[at(i)], pins.share[at(i)]});
    } else if (carrier < 0) {  // no piece is solved
      origin = Origin::carried;
      const Span<const Index> own = state_.solution->informants.of(v);
      for (const Index b : own) shares.push_back({b, 1.0 / static_cast<double>(own.size())});
      if (own.empty()) shares.push_back({first_bone_, 1.0});
    } else {
      const std::size_t width = rows_.bones.size();
      if (rigid >= 0 || carrier != v) origin = rigid >= 0 ? Origin::rigid : Origin::carried;
      for (std::size_t c = 0; c < width; ++c) {
        const double w = rigid >= 0 ? rigid_rows_[at(rigid) * width + c] : rows_.get(carrier, c);
        if (w > 0 && !is_locked(rows_.bones[c])) shares.push_back({rows_.bones[c], w});
      }
      if (state_.inputs->locks) {
        const Locks& locks = *state_.inputs->locks;
        for (std::size_t i = 0; i < locks.bones.size(); ++i) {
          const float units = locks.units[at(v) * locks.bones.size() + i];
          if (units > 0) locked.push_back({locks.bones[i], static_cast<double>(units)});
        }
        std::sort(locked.begin(), locked.end(), [](const Share& a, const Share& b) {
          return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
        });
      }
      if (shares.empty() && locked.empty()) shares.push_back({first_bone_, 1.0});
    }
    state_.origin[at(v)] = origin;
    const std::size_t row = at(v) * at(influences_);
    write_influences(shares, locked, origin != Origin::pinned, influences_, &state_.joints[row], &state_.weights[row]);
  }

  void count() const {
    WeightCounts& counts = state_.counts;
    for (const Index v : core_.mesh.inner_of_given)
      ++counts.by_origin[static_cast<std::size_t>(v < 0 ? Origin::isolated : state_.origin[at(v)])];
    counts.pieces_carried = carriers_.carried_pieces;
    counts.pieces_rigid = carriers_.rigid_pieces;
    counts.blind = state_.solution->informants.blind;
  }

  const surface::Core& core_;
  Memory& memory_;
  WeightState& state_;
  const std::int32_t influences_;
  const SmoothRows rows_;
  Vector<Index> pin_of_;         // by vertex, or -1
  Vector<std::uint8_t> locked_;  // by bone
  Vector<std::uint8_t> solved_;  // by piece
  Carriers carriers_;
  Vector<double> rigid_rows_;
  Vector<Index> rigid_of_;  // by piece: its row
  Index first_bone_ = 0;
};

bool same(const Bones& a, const Bones& b) noexcept {
  const auto equal = [](const Vector<Vec3>& p, const Vector<Vec3>& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                      [](const Vec3& x, const Vec3& y) { return x.x == y.x && x.y == y.y && x.z == y.z; });
  };
  return a.has_tails == b.has_tails && a.parent == b.parent && a.deforms == b.deforms && equal(a.head, b.head) &&
         equal(a.tail, b.tail) && equal(a.axis, b.axis);
}

}  // namespace

std::shared_ptr<const WeightState> Weights::compute(const Inputs& inputs) const {
  const surface::Core& core = *surface_->core;
  const auto next = make_shared_in<WeightState>(memory(), memory());
  next->inputs = inputs;
  if (state_) {
    next->counts.factorisations = state_->counts.factorisations;
    next->counts.path_solves = state_->counts.path_solves;
  }
  {
    const ProgressRange range(0.0f, progress_solved);
    if (state_ && same(state_->inputs->bones, inputs->bones)) {
      next->solution = state_->solution;
    } else {
      next->solution = Solution::make(surface_, inputs->bones);
      ++next->counts.factorisations;
    }
  }
  if (inputs->pins.count() > 0) {
    const ProgressRange range(progress_solved, progress_pinned);
    next->pinned = PinnedField::make(next->solution, inputs->pins, state_ ? state_->pinned.get() : nullptr);
    next->counts.factorisations += next->pinned->factorisations;
    next->counts.path_solves += next->pinned->path_solves;
  }
  report(progress_pinned);
  Computation(core, *next, influences_).run();
  return next;
}

}  // namespace hf_inner::weights
