// Ten thousand random edits (insert, remove, move, values; vertices and points in triangles; hard and soft; batches of
// one to many; batches that must be refused) on surfaces of several components, of genus above one, and dirty ones, all
// engines in lockstep, against the dense oracle or a fresh elimination.
#include "factor/factor_bytes.h"
#include "support/engines.h"
#include "support/full.h"
#include "support/hard_meshes.h"
#include "unit/solve/edit_script.h"

namespace {

using hf_test::EditScript;
using hf_test::engines;
using hf_test::PlainMesh;

PlainMesh several_components() {
  PlainMesh mesh = hf_test::grid(7, 5, 1, 0.3);
  append(mesh, hf_test::torus(10, 7), 20);
  append(mesh, hf_test::grid(2, 2, 0.01), 40);
  append(mesh, hf_test::grid(4, 3, 1000), 60);
  return mesh;
}

// A factor's round trip through bytes: the core that a host with a saved factor works on.
std::shared_ptr<const hf_inner::surface::Core> loaded_core(const PlainMesh& mesh) {
  const auto made = hf_test::make_core(mesh);
  std::vector<std::uint8_t> bytes(hf_inner::factor::saved_factor_size(*made->factor));
  hf_inner::factor::save_factor(*made->factor, hf_inner::surface::grounded_hash(*made), {bytes.data(), bytes.size()},
                                *made->memory, *made->jobs);
  hf_inner::surface::CoreOptions options;
  options.saved_factor = bytes;
  return hf_test::make_core(mesh, 1, options);
}

void expect_dense_oracle(const EditScript& script, double tolerance, double updown_tolerance) {
  if (script.count() == 0) return;
  std::vector<hf_inner::solve::Site> used;
  Eigen::MatrixXd values;
  script.present(used, values);
  script.expect_fields(hf_test::dense_field(*script.core, used, values), used, tolerance, updown_tolerance);
}

// Field of a fresh elimination of the present sites.
void expect_fresh_elimination(const EditScript& script, double tolerance) {
  if (script.count() == 0) return;
  std::vector<hf_inner::solve::Site> used;
  Eigen::MatrixXd values;
  script.present(used, values);
  const auto solver = hf_test::make_engine(hf_test::EngineKind::refactor, script.core);
  std::vector<std::int32_t> slots(used.size());
  std::vector<double> s;
  for (std::size_t i = 0; i < used.size(); ++i) {
    slots[i] = static_cast<std::int32_t>(i);
    for (Eigen::Index c = 0; c < values.cols(); ++c) s.push_back(values(static_cast<Eigen::Index>(i), c));
  }
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = used;
  solver->edit(edit);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> u(script.core->size(), values.cols());
  solver->solve(s.data(), static_cast<std::int32_t>(values.cols()), u.data(), nullptr);
  script.expect_fields(u, used, tolerance, 0);
}

// So many edits around a population that comes and goes, with refused batches between them.
template <class Check>
void run(EditScript& script, int edits, int population, int checkpoints, Check&& check) {
  int done = 0, next = 0;
  while (done < edits) {
    const int phase = done / std::max(1, edits / 8) % 4;  // a few sites, many, none to a few, many in large batches
    const int around = phase == 0 ? 4 : phase == 2 ? 1 : population;
    done += script.step(around, phase == 3 ? 40 : phase == 1 ? 8 : 3);
    if (script.below(12) == 0) script.refused_step();
    if (done < next) continue;
    next += edits / checkpoints;
    SCOPED_TRACE(testing::Message() << "after " << done << " edits");
    check();
    if (testing::Test::HasFailure()) return;
  }
}

struct Surface {
  const char* name;
  PlainMesh (*make)();
};
void PrintTo(const Surface& s, std::ostream* out) { *out << s.name; }

class EditScripts : public testing::TestWithParam<Surface> {};

TEST_P(EditScripts, give_the_dense_oracles_field_with_every_engine) {
  const auto core = hf_test::make_core(GetParam().make());
  for (std::uint32_t seed = 1; seed <= (hf_test::is_full() ? 10u : 1u); ++seed) {
    EditScript script(core, engines(), 2, seed, seed % 2 ? 0.0 : 1e4);
    run(script, 10000, 25, hf_test::is_full() ? 200 : 40,
        [&] { expect_dense_oracle(script, 1e-10, script.shift != 0 ? 1e-3 : 1e-5); });
  }
}

TEST_P(EditScripts, stay_exact_when_sites_were_moved_into_the_factor) {
  for (const bool loaded : {false, true}) {
    const auto core = loaded ? loaded_core(GetParam().make()) : hf_test::make_core(GetParam().make());
    EditScript script(core, {hf_test::EngineKind::green}, 1, 31 + loaded, 1e4);
    int checked_inside = 0, checked_freed = 0;
    for (int round = 0; round < (hf_test::is_full() ? 40 : 5); ++round) {
      SCOPED_TRACE(testing::Message() << "loaded " << loaded << " round " << round);
      script.apply(0, 0, 0, core->size() / 4, true);  // hard vertices, all at once
      script.fields[0]->prepare_rebase();
      for (int done = 0, next = 0; done < 250;) {
        done += script.step(core->size() / 5, 4);
        if (script.below(12) == 0) script.refused_step();
        if (done < next) continue;
        next += 25;
        const hf_inner::solve::EngineCounters counters = script.fields[0]->engine().counters();
        checked_inside += counters.eliminated > 5;
        checked_freed += counters.eliminated > 5 && counters.dense_rows > 5;
        expect_dense_oracle(script, 1e-10, 0);
        if (HasFailure()) return;
      }
      if (round % 2) script.apply(static_cast<int>(script.count()), 0, 0, 0);
    }
    EXPECT_GE(script.fields[0]->engine().counters().rebases, 4u);
    EXPECT_GT(checked_inside, 10) << "hardly any field was solved with sites in the factor";
    EXPECT_GT(checked_freed, 5) << "... and edits on top of them";
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EditScripts,
                         testing::Values(Surface{"several_components", several_components},
                                         Surface{"genus_three", [] { return hf_test::slab_with_holes(3, 2); }},
                                         Surface{"dirty", [] { return hf_test::dirty(); }}),
                         [](const auto& info) { return info.param.name; });

TEST(LongEditScripts, agree_with_a_fresh_elimination_and_never_refactor_below_the_threshold) {
  PlainMesh mesh = hf_test::torus(90, 70);
  append(mesh, hf_test::slab_with_holes(4, 5), 20);
  append(mesh, hf_test::dirty(20), 100);
  const auto core = hf_test::make_core(mesh);
  EditScript script(core, {hf_test::EngineKind::green}, 1, 5, 1e4);
  run(script, hf_test::is_full() ? 100000 : 10000, 60, hf_test::is_full() ? 60 : 12, [&] {
    expect_fresh_elimination(script, 1e-10);
    EXPECT_EQ(script.fields[0]->engine().counters().factorisations, 1u);
    EXPECT_EQ(script.fields[0]->engine().counters().rebases, 0u);
  });
}

}  // namespace
