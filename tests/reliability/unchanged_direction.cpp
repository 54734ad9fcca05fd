// Direction fields: constraints that come, go, move and turn; clones.
#include <cmath>

#include "unchanged.h"
#include "support/arrays.h"

namespace unchanged {
namespace {

using DirectionBranch = Clonable<hf_direction, hf_direction_destroy, Nothing>;

class Directions final : public Subject {
 public:
  Directions(World& given, Random& random) : Subject(given) {
    desc_.degree = random.pick({0u, 1u, 2u, 4u});
    desc_.site_limit = random.pick({0u, 0u, 9u});
    hf_direction made = nullptr;
    if (hf_direction_create(world.surface, &desc_, &made) == HF_OK) branches_.emplace_back(made, Nothing());
  }
  bool ready() const { return !branches_.empty(); }

  void glance(State& state) override {
    for (const DirectionBranch& b : branches_) {
      hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
      state.begin("statistics of a direction field");
      state.add(hf_direction_get_statistics(b.handle, &statistics));
      statistics.sweep_count = 0;
      add_struct(state, statistics);
      state.add(hf_direction_get_site_count(b.handle));
    }
  }
  void look(State& state) override {
    for (const DirectionBranch& b : branches_) {
      look_at_field(b, state);
      const Sites sites = sites_of(b);
      state.begin("constraints");
      state.add(sites.numbers);
      state.add(sites.vertices);
      state.add(sites.vectors);
      std::vector<hf_singularity> list(world.shape->count());
      std::uint32_t count = 0;
      state.begin("singularities");
      state.add(hf_direction_get_singularities(b.handle, world.shape->count(), list.data(), &count));
      state.add(count);
      state.add(list.data(), count * sizeof list[0]);
    }
  }
  std::string compare_fresh() override {
    for (const DirectionBranch& b : branches_) {
      const Sites sites = sites_of(b);
      if (sites.numbers.empty()) continue;
      hf_direction fresh = nullptr;
      std::vector<double> field(3 * world.shape->vertices()), other(field);
      hf_result result = hf_direction_create(world.surface, &desc_, &fresh);
      if (result == HF_OK)
        result = hf_direction_add_sites(fresh, static_cast<std::uint32_t>(sites.numbers.size()), sites.vertices.data(),
                                        sites.vectors.data(), nullptr);
      if (result == HF_OK) result = hf_direction_solve(fresh, OUT(other.data()), nullptr);
      if (result == HF_OK) result = hf_direction_solve(b.handle, OUT(field.data()), nullptr);
      hf_direction_destroy(fresh);
      if (result != HF_OK) return std::string("a fresh direction field: ") + hf_result_get_name(result);
      const double off = apart(field, other);
      if (!(off <= 1e-9)) return "a fresh direction field differs by " + text(off);
    }
    return {};
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct DirectionCalls;
  struct Sites {
    std::vector<std::uint32_t> numbers, vertices;
    std::vector<double> vectors;
  };
  DirectionBranch& any(Random& random) { return branches_[random.below(static_cast<std::uint32_t>(branches_.size()))]; }
  Sites sites_of(const DirectionBranch& b) const {
    std::uint32_t count = hf_direction_get_site_count(b.handle);
    Sites sites{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count), std::vector<double>(3 * count)};
    hf_direction_get_sites(b.handle, count, sites.numbers.data(), sites.vertices.data(), sites.vectors.data(), &count);
    return sites;
  }
  std::uint64_t look_at_field(const DirectionBranch& b, State& state) const {
    std::vector<double> field(3 * world.shape->vertices());
    hf_solve_info info = HF_INIT(hf_solve_info);
    state.begin("direction field");
    state.add(hf_direction_solve(b.handle, OUT(field.data()), &info));
    state.add(field);
    add_struct(state, info);
    return state.last();
  }
  std::uint64_t field_of(const DirectionBranch& b) {
    world.memory.disarm();
    State state;
    return look_at_field(b, state);
  }
  // Largest difference over the longest vector. A field of degree n answers with one of n directions: any may stand.
  double apart(const std::vector<double>& a, const std::vector<double>& b) const {
    double most = 0, scale = 1e-300;
    for (std::size_t v = 0; v < a.size(); v += 3) {
      double minus = 0, plus = 0, across = 0, size = 0, other = 0;
      for (std::size_t k = v; k < v + 3; ++k) {
        minus += (a[k] - b[k]) * (a[k] - b[k]);
        plus += (a[k] + b[k]) * (a[k] + b[k]);
        across += a[k] * b[k];
        size += a[k] * a[k];
        other += b[k] * b[k];
      }
      size = std::sqrt(size);
      other = std::sqrt(other);
      scale = std::fmax(scale, size);
      double off = std::sqrt(minus);
      if (desc_.degree >= 2) off = std::fmin(off, std::sqrt(plus));
      if (desc_.degree == 4 && size > 0)
        off = std::fmin(off, std::fmax(std::fabs(size - other), std::fabs(across) / size));
      most = std::fmax(most, std::isfinite(off) ? off : HUGE_VAL);
    }
    return most / scale;
  }
  std::vector<std::uint32_t> numbers(const DirectionBranch& b, Random& random) const {
    const Sites there = sites_of(b);
    std::vector<std::uint32_t> list(1 + random.below(3));
    for (std::uint32_t& n : list)
      n = there.numbers.empty() || random.one_in(15)
              ? random.below(20)
              : there.numbers[random.below(static_cast<std::uint32_t>(there.numbers.size()))];
    return list;
  }
  std::vector<double> values(std::size_t count, Random& random) const {
    std::vector<double> list(count);
    for (double& v : list) v = random.number();
    return list;
  }
  std::vector<std::uint32_t> vertices(std::size_t count, Random& random) const {
    std::vector<std::uint32_t> list(count);
    for (std::uint32_t& v : list) v = random.index(world.shape->vertices());
    return list;
  }

  hf_direction_desc desc_ = HF_INIT(hf_direction_desc);
  std::vector<DirectionBranch> branches_;
};

struct DirectionCalls {
  static Directions& of(Subject& s) { return static_cast<Directions&>(s); }

  static hf_result add(Subject& subject, Random& random) {
    Directions& s = of(subject);
    DirectionBranch& b = s.any(random);
    const std::size_t count = random.one_in(10) ? 10 + random.below(30) : 1 + random.below(4);
    const std::vector<std::uint32_t> at = s.vertices(count, random);
    const std::vector<double> vectors = s.values(3 * count, random);
    std::vector<std::uint32_t> out(count);
    return hf_direction_add_sites(b.handle, static_cast<std::uint32_t>(count), at.data(), vectors.data(), out.data());
  }
  static hf_result change(Subject& subject, Random& random) {
    Directions& s = of(subject);
    DirectionBranch& b = s.any(random);
    const std::vector<std::uint32_t> list = s.numbers(b, random), to = s.vertices(list.size(), random);
    const std::vector<double> values = s.values(3 * list.size(), random);
    const std::uint32_t count = static_cast<std::uint32_t>(list.size());
    switch (random.below(4)) {
      case 0:
        return hf_direction_remove_sites(b.handle, count, list.data());
      case 1:
        return hf_direction_move_sites(b.handle, count, list.data(), to.data());
      case 2:
        return hf_direction_set_vectors(b.handle, count, list.data(), values.data());
      default:
        return hf_direction_rotate_sites(b.handle, count, list.data(), values.data());
    }
  }
  static hf_result clone(Subject& subject, Random& random) {
    Directions& s = of(subject);
    return s.Subject::clone(s.branches_, random, hf_direction_clone, [&](const auto& b) { return s.field_of(b); });
  }
  static hf_result go_back(Subject& subject, Random& random) {
    Directions& s = of(subject);
    return s.Subject::go_back(s.branches_, random, [&](const auto& b) { return s.field_of(b); });
  }
  static hf_result make(Subject& subject, Random& random) {
    Directions& s = of(subject);
    hf_direction_desc desc = HF_INIT(hf_direction_desc);
    desc.degree = random.pick({0u, 1u, 3u, 4u});
    desc.reserved = random.one_in(20);
    desc.progress = s.world.progress();
    hf_direction made = s.branches_[0].handle;
    const hf_result result = hf_direction_create(s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused direction field is no NULL");
    return hf_direction_destroy(made), result;
  }
  static hf_result destroy(Subject& subject, Random&) {
    Directions& s = of(subject);
    if (s.branches_.size() < 2) return skipped;
    s.branches_.pop_back();
    return HF_OK;
  }
  static hf_result solve(Subject& subject, Random& random) {
    Directions& s = of(subject);
    const DirectionBranch& b = s.any(random);
    std::vector<float> field(3 * s.world.shape->vertices());
    hf_solve_info info = HF_INIT(hf_solve_info);
    std::uint32_t count = 0;
    hf_singularity one;
    if (random.one_in(3)) return hf_direction_get_singularities(b.handle, random.below(2), &one, &count);
    if (random.one_in(3)) return hf_direction_get_sites(b.handle, 1, &count, nullptr, nullptr, &count);
    return hf_direction_solve(b.handle, OUT_ROWS(field.data(), random.one_in(9) ? 3 : 0), random.spoiled(info));
  }
};

const std::vector<Command>& Directions::commands() const {
  static const std::vector<Command> table = {
      {"hf_direction_add_sites", 8, DirectionCalls::add}, {"an edit of directions", 10, DirectionCalls::change},
      {"hf_direction_clone", 5, DirectionCalls::clone},   {"back to a clone", 4, DirectionCalls::go_back},
      {"hf_direction_create", 1, DirectionCalls::make},   {"hf_direction_destroy", 1, DirectionCalls::destroy},
      {"a direction field", 4, DirectionCalls::solve},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_directions(World& world, Random& random) {
  auto made = std::make_unique<Directions>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
