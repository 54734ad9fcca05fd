// A rebase made on one thread while another edits and solves, and the counts that tell of it.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <thread>

#include "base/error.h"
#include "base/index.h"
#include "field/scalar_field.h"
#include "support/engines.h"
#include "support/meshes.h"
#include "surface/edited_core.h"

namespace {

using hf_inner::at;
std::vector<std::uint32_t> add(hf_inner::field::ScalarField& field, const std::vector<std::uint32_t>& vertices) {
  std::vector<double> values;
  for (const std::uint32_t v : vertices) values.push_back(std::sin(0.7 * v));
  hf_inner::field::FieldEdit edit;
  edit.add.count = static_cast<std::uint32_t>(vertices.size());
  edit.add.vertices = vertices.data();
  edit.add_holds.values = values.data();
  std::vector<std::uint32_t> numbers(vertices.size());
  field.edit(edit, numbers.data());
  return numbers;
}
void remove(hf_inner::field::ScalarField& field, const std::vector<std::uint32_t>& numbers) {
  hf_inner::field::FieldEdit edit;
  edit.remove_count = static_cast<std::uint32_t>(numbers.size());
  edit.remove_sites = numbers.data();
  field.edit(edit, nullptr);
}
std::vector<double> solve(const hf_inner::field::ScalarField& field) {
  std::vector<double> u(at(field.core().size()));
  field.solve(u.data());
  return u;
}
// The field of the same sites by elimination.
std::vector<double> oracle(const hf_inner::field::ScalarField& field) {
  hf_inner::field::ScalarField fresh(field.shared_core(), 1, 100000,
                                     hf_test::make_engine(hf_test::EngineKind::refactor, field.shared_core()));
  std::vector<std::uint32_t> vertices;
  for (const auto& slot : field.sites().slots()) {
    if (slot.used()) vertices.push_back(slot.given_vertex);
  }
  add(fresh, vertices);
  return solve(fresh);
}
double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}
std::vector<std::uint32_t> every(std::uint32_t begin, std::uint32_t end, std::uint32_t step) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t v = begin; v < end; v += step) out.push_back(v);
  return out;
}

TEST(Rebase, waits_for_the_next_edit_which_brings_it_up_to_date) {
  const auto core = hf_test::make_core(hf_test::torus(80, 60));
  hf_inner::field::ScalarField field(core, 1, 100000);
  const auto first = add(field, every(0, 4800, 50));
  field.prepare_rebase();
  EXPECT_EQ(field.engine().counters().rebases, 0u);
  const std::vector<double> before = solve(field);
  remove(field, {first[3], first[9]});
  const hf_inner::solve::EngineCounters counters = field.engine().counters();
  EXPECT_EQ(counters.rebases, 1u);
  EXPECT_EQ(counters.factorisations, 2u);
  EXPECT_EQ(counters.eliminated, 94u);
  EXPECT_EQ(counters.dense_rows, 2u);  // the freed ones
  EXPECT_EQ(counters.last_route, hf_inner::solve::EditRoute::dense);
  EXPECT_LE(worst(solve(field), oracle(field)), 1e-11);
  add(field, {150, 450});  // the very vertices again
  EXPECT_LE(worst(solve(field), before), 1e-11);
}

TEST(Rebase, takes_in_what_changed_between) {
  const auto core = hf_test::make_core(hf_test::torus(80, 60));
  hf_inner::field::ScalarField field(core, 1, 100000);
  const auto first = add(field, every(0, 4800, 50));
  std::atomic<bool> done{false};
  std::thread other([&] {
    field.prepare_rebase();
    done = true;
  });
  std::vector<std::uint32_t> numbers;
  int rounds = 0;
  do {
    for (const std::uint32_t n : add(field, {static_cast<std::uint32_t>(1 + 50 * (rounds % 90) + rounds / 90)}))
      numbers.push_back(n);
    EXPECT_GE(solve(field)[0], -1.0);
    ++rounds;
  } while (!done && rounds < 2000);
  other.join();
  remove(field, {first[7]});
  EXPECT_EQ(field.engine().counters().rebases, 1u);
  EXPECT_LE(worst(solve(field), oracle(field)), 1e-10);
  remove(field, numbers);
  EXPECT_LE(worst(solve(field), oracle(field)), 1e-10);
}

// Calls `meanwhile` once, in the first allocation of at least `bytes`.
struct Interrupt {
  std::size_t bytes = SIZE_MAX;
  std::function<void()> meanwhile;
  static void* allocate(void* user, std::size_t size, std::size_t alignment) {
    Interrupt& self = *static_cast<Interrupt*>(user);
    if (size >= self.bytes) {
      self.bytes = SIZE_MAX;
      self.meanwhile();
    }
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  }
  static void release(void*, void* block, std::size_t, std::size_t) { std::free(block); }
};

TEST(Rebase, of_a_surface_that_was_left_meanwhile_is_dropped) {
  Interrupt interrupt;
  auto memory = std::make_shared<hf_inner::Memory>(hf_allocator{Interrupt::allocate, Interrupt::release, &interrupt});
  const auto plain = hf_test::make_core(hf_test::torus(80, 60), 1, {}, memory);
  auto stiffness = std::make_shared<hf_inner::Vector<double>>(at(plain->size()), 1.0, memory.get());
  for (std::size_t v = 400; v < 450; ++v) (*stiffness)[v] = 50;
  const auto edited = hf_inner::surface::edit_core(plain, {stiffness});
  hf_inner::field::ScalarField field(plain, 1, 100000);
  add(field, every(0, 4800, 50));
  interrupt.meanwhile = [&] { field.move_to(edited); };
  interrupt.bytes =
      static_cast<std::size_t>(plain->factor->statistics().stored_entries * 8);  // the numbers of a factor
  field.prepare_rebase();
  EXPECT_EQ(&field.core(), edited.get());
  add(field, {1});
  EXPECT_EQ(field.engine().counters().rebases, 0u);
  EXPECT_LE(worst(solve(field), oracle(field)), 1e-10);
}

TEST(Rebase, says_what_it_cannot_do) {
  const auto core = hf_test::make_core(hf_test::torus(20, 14));
  const auto code_of = [](hf_inner::field::ScalarField& field) {
    try {
      field.prepare_rebase();
    } catch (const hf_inner::Error& error) {
      return error.code();
    }
    return static_cast<hf_result>(HF_OK);
  };
  hf_inner::field::ScalarField green(core, 1, 100),
      refactor(core, 1, 100, hf_test::make_engine(hf_test::EngineKind::refactor, core));
  EXPECT_EQ(code_of(green), HF_ERROR_EMPTY);
  EXPECT_EQ(code_of(refactor), HF_ERROR_UNSUPPORTED);
}

TEST(Decisions, are_counted_with_what_the_cost_model_said) {
  const auto core = hf_test::make_core(hf_test::torus(80, 60));
  hf_inner::field::ScalarField field(core, 1, 100000);
  EXPECT_EQ(field.engine().counters().last_route, hf_inner::solve::EditRoute::none);
  const auto few = add(field, {5, 701, 2001});
  hf_inner::solve::EngineCounters counters = field.engine().counters();
  EXPECT_EQ(counters.last_route, hf_inner::solve::EditRoute::dense);
  EXPECT_EQ(counters.dense_edits, 1u);
  EXPECT_EQ(counters.dense_rows, 3u);
  EXPECT_GT(counters.dense_ms, 0);
  EXPECT_GT(counters.rebase_ms, counters.dense_ms);
  add(field, every(6, 4800, 2));
  counters = field.engine().counters();
  EXPECT_EQ(counters.last_route, hf_inner::solve::EditRoute::rebase);
  EXPECT_LT(counters.rebase_ms, counters.dense_ms);
  EXPECT_EQ(counters.rebases, 1u);
  EXPECT_GT(counters.eliminated, 2000u);
  EXPECT_EQ(counters.dense_rows, 0u);
  remove(field, few);
}

TEST(PartialSolve, has_the_bits_of_the_whole_field_and_solves_no_path) {
  const auto core = hf_test::make_core(hf_test::torus(80, 60), 2);
  hf_inner::field::ScalarField field(core, 1, 100000);
  add(field, every(0, 4800, 37));
  const std::vector<double> whole = solve(field);
  const std::uint32_t paths = field.engine().counters().path_solves;
  for (int start = 0; start < 40; ++start) {
    std::vector<std::int32_t> vertices;
    for (int i = 0; i < 12; ++i) vertices.push_back((start * 119 + i * i * 31) % 4800);
    std::vector<double> some(vertices.size());
    field.solve_at(vertices, some.data());
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], whole[at(vertices[i])]);
  }
  EXPECT_EQ(field.engine().counters().path_solves, paths);
}

}  // namespace
