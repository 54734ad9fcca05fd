// The same bits whatever the number of threads, stage by stage: ordering, factor, sweeps, paths, fields under edits, a
// rebase, previews; and the same bits when the factor came through bytes.
#include <gtest/gtest.h>

#include <cstring>

#include "base/index.h"
#include "factor/bytes_hash.h"
#include "factor/factor_bytes.h"
#include "support/engines.h"
#include "support/hard_meshes.h"
#include "unit/solve/edit_script.h"

namespace {

using hf_inner::at;
using hf_test::EditScript;
using hf_test::PlainMesh;

// Hash of each stage under its name.
using Stages = std::vector<std::pair<std::string, std::uint64_t>>;

class Recorder {
 public:
  explicit Recorder(std::shared_ptr<const hf_inner::surface::Core> c) : core_(std::move(c)) {}
  template <class T>
  void add(std::string name, const T* values, std::size_t count) {
    stages.emplace_back(std::move(name), hf_inner::factor::hash_array(values, count, memory_, one_));
  }
  std::vector<double> wave(std::size_t count) const {
    std::vector<double> z(count);
    for (std::size_t i = 0; i < count; ++i) z[i] = std::sin(0.37 * static_cast<double>(i) + 1);
    return z;
  }

  void factor_and_sweeps() {
    const hf_inner::factor::Factor& factor = *core_->factor;
    add("ordering", factor.order().data(), factor.order().size());
    std::vector<std::uint8_t> bytes(hf_inner::factor::saved_factor_size(factor));
    hf_inner::factor::save_factor(factor, hf_inner::surface::grounded_hash(*core_), {bytes.data(), bytes.size()},
                                  *core_->memory, *core_->jobs);
    add("saved factor", bytes.data(), bytes.size());
    const std::size_t n = static_cast<std::size_t>(core_->size());
    const auto preview = core_->preview.get(factor, *core_->memory, *core_->jobs);
    for (const std::int32_t m : {1, 3, 8}) {
      const std::vector<double> start = wave(n * static_cast<std::size_t>(m));
      const std::string name = " sweep of " + std::to_string(m);
      std::vector<double> z = start;
      factor.forward(z.data(), m, *core_->jobs);
      add("forward" + name, z.data(), z.size());
      z = start;
      factor.backward(z.data(), m, *core_->jobs);
      add("backward" + name, z.data(), z.size());
      std::vector<float> f(start.begin(), start.end());
      preview->forward(f.data(), m, *core_->jobs);
      add("single forward" + name, f.data(), f.size());
      f.assign(start.begin(), start.end());
      preview->backward(f.data(), m, *core_->jobs);
      add("single backward" + name, f.data(), f.size());
    }
  }

  void paths() {
    const hf_inner::factor::Factor& factor = *core_->factor;
    const std::int32_t n = factor.size(), count = 150;
    std::vector<std::int32_t> start = {0}, row, group(count), column(count);
    std::vector<double> value;
    for (std::int32_t i = 0; i < count; ++i) {
      row.push_back(static_cast<std::int32_t>((std::int64_t{i} * 7919 + 13) % n));
      value.push_back(1.0 + 0.01 * i);
      start.push_back(static_cast<std::int32_t>(row.size()));
    }
    hf_inner::Vector<std::shared_ptr<const hf_inner::factor::PathGroup>> groups(core_->memory.get());
    factor.solve_paths({start, row, value}, *core_->memory, *core_->jobs, groups, {group.data(), group.size()},
                       {column.data(), column.size()});
    add("path groups", group.data(), group.size());
    const std::vector<double> z = wave(static_cast<std::size_t>(n));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<double> gram(32 * 32, 0.0), projected(32, 0.0), combined(static_cast<std::size_t>(n), 0.0);
      factor.gram(*groups[g], *groups[0], gram.data(), 32);
      for (std::int32_t i = groups[g]->count(); i < 32; ++i) std::fill_n(gram.begin() + 32 * i, 32, 0.0);
      add("gram " + std::to_string(g), gram.data(), static_cast<std::size_t>(groups[g]->count()) * 32);
      factor.project(*groups[g], z.data(), 1, projected.data());
      add("project " + std::to_string(g), projected.data(), static_cast<std::size_t>(groups[g]->count()));
      factor.combine(*groups[g], z.data(), 1, combined.data());
      add("combine " + std::to_string(g), combined.data(), combined.size());
    }
  }

  void fields(int channels) {
    EditScript script(core_, {hf_test::EngineKind::green}, channels, 77, 0);
    hf_inner::field::ScalarField& field = *script.fields[0];
    std::vector<double> u(static_cast<std::size_t>(core_->size() * channels));
    const auto solve = [&](const char* name) {
      field.solve(u.data());
      add(name, u.data(), u.size());
      hf_inner::Vector<double> flux(core_->memory.get());
      field.flux(flux);
      add(std::string(name) + ", flux", flux.data(), flux.size());
      for (std::int32_t corrections = 0; corrections < 2; ++corrections) {
        field.solve_preview(corrections, u.data());
        add(std::string(name) + ", preview", u.data(), u.size());
      }
    };
    script.apply(0, 0, 0, 300);
    solve("after 300 sites");
    script.apply(40, 20, 30, 25);
    solve("after edits");
    for (int i = 0; i < 10; ++i) script.step(200, 10);
    solve("after more edits");
    script.apply(0, 0, 0, 200, true);
    field.prepare_rebase();
    script.apply(0, 0, 0, 1);
    solve("after a rebase");
    EXPECT_GT(field.engine().counters().eliminated, 100u);
    script.apply(30, 10, 10, 20);
    solve("after edits on a rebase");
    const std::vector<std::int32_t> probes = {0, 5, core_->size() / 2, core_->size() - 1};
    std::vector<double> at(probes.size() * static_cast<std::size_t>(channels));
    field.solve_at(probes, at.data());
    add("at four vertices", at.data(), at.size());
  }

  Stages stages;

 private:
  std::shared_ptr<const hf_inner::surface::Core> core_;
  hf_inner::Memory memory_;
  hf_inner::JobRunner one_{1};
};

Stages stages_of(const std::shared_ptr<const hf_inner::surface::Core>& core) {
  Recorder recorder(core);
  recorder.factor_and_sweeps();
  recorder.paths();
  recorder.fields(1);
  recorder.fields(3);
  return recorder.stages;
}

PlainMesh large_and_dirty() {
  PlainMesh mesh = hf_test::torus(170, 140);
  append(mesh, hf_test::slab_with_holes(3, 6), 20);
  append(mesh, hf_test::dirty(8), 100);
  return mesh;
}

TEST(Determinism, every_stage_gives_the_same_bits_for_one_two_and_four_threads) {
  const PlainMesh mesh = large_and_dirty();
  const Stages expected = stages_of(hf_test::make_core(mesh, 1));
  ASSERT_GT(expected.size(), 60u);
  for (const std::uint32_t threads : {2u, 4u}) {
    const Stages got = stages_of(hf_test::make_core(mesh, threads));
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_EQ(got[i], expected[i]) << threads << " threads, " << got[i].first;
  }
}

TEST(Determinism, a_factor_from_bytes_gives_the_same_bits_at_every_stage) {
  const PlainMesh mesh = large_and_dirty();
  const auto made = hf_test::make_core(mesh, 1);
  const Stages expected = stages_of(made);
  hf_inner::Buffer<std::uint8_t> bytes(*made->memory, hf_inner::factor::saved_factor_size(*made->factor));
  hf_inner::factor::save_factor(*made->factor, hf_inner::surface::grounded_hash(*made), {bytes.data(), bytes.size()},
                                *made->memory, *made->jobs);
  for (const bool borrow : {false, true}) {
    hf_inner::surface::CoreOptions options;
    options.saved_factor = {bytes.data(), bytes.size()};
    options.borrow_factor = borrow;
    const Stages got = stages_of(hf_test::make_core(mesh, 2, options));
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_EQ(got[i], expected[i]) << "borrow " << borrow << ", " << got[i].first;
  }
}

}  // namespace
