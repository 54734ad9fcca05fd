// The site set above the engines: numbers, duplicates, batches that are all or nothing.
#include "field/scalar_field.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/engines.h"
#include "support/meshes.h"

namespace {

std::vector<double> field_of(const hf_inner::field::ScalarField& field) {
  std::vector<double> u(static_cast<std::size_t>(field.core().size() * field.sites().channels()));
  field.solve(u.data());
  return u;
}

hf_inner::field::FieldEdit adding(const std::vector<std::uint32_t>& vertices, const std::vector<double>& values) {
  hf_inner::field::FieldEdit edit;
  edit.add.count = static_cast<std::uint32_t>(vertices.size());
  edit.add.vertices = vertices.data();
  edit.add_holds.values = values.data();
  return edit;
}

hf_result code_of(hf_inner::field::ScalarField& field, const hf_inner::field::FieldEdit& edit,
                  std::uint32_t* index = nullptr) {
  try {
    field.edit(edit, nullptr);
  } catch (const hf_inner::Error& error) {
    if (index) *index = error.index();
    return error.code();
  }
  return HF_OK;
}

class ScalarFieldTest : public testing::TestWithParam<hf_test::EngineKind> {
 protected:
  std::shared_ptr<const hf_inner::surface::Core> core = hf_test::make_core(hf_test::torus(24, 18));
  hf_inner::field::ScalarField field{core, 1, 1000, hf_test::make_engine(GetParam(), core)};
};

TEST_P(ScalarFieldTest, a_failing_batch_changes_nothing) {
  field.edit(adding({1, 50, 200}, {0, 1, 2}), nullptr);
  const auto before = field_of(field);
  std::uint32_t index = 0;
  EXPECT_EQ(code_of(field, adding({3, 4, 50}, {1, 1, 1}), &index), HF_ERROR_DUPLICATE);
  EXPECT_EQ(index, 2u);
  EXPECT_EQ(code_of(field, adding({3, 50}, {1, 9}), &index), HF_ERROR_CONFLICT);
  EXPECT_EQ(code_of(field, adding({3, 3}, {1, 1})), HF_ERROR_DUPLICATE);
  EXPECT_EQ(code_of(field, adding({3, 99999}, {1, 1}), &index), HF_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code_of(field, adding({3}, {std::nan("")})), HF_ERROR_NON_FINITE);
  const std::uint32_t absent[] = {0, 9};
  hf_inner::field::FieldEdit edit;
  edit.remove_count = 2;
  edit.remove_sites = absent;
  EXPECT_EQ(code_of(field, edit, &index), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(field.sites().count(), 3u);
  EXPECT_EQ(before, field_of(field));
}

TEST_P(ScalarFieldTest, sites_may_swap_places) {
  field.edit(adding({1, 50}, {0, 1}), nullptr);
  const auto before = field_of(field);
  const std::uint32_t both[] = {0, 1}, to[] = {50, 1};
  hf_inner::field::FieldEdit edit;
  edit.move_count = 2;
  edit.move_sites = both;
  edit.move_to.count = 2;
  edit.move_to.vertices = to;
  field.edit(edit, nullptr);
  const auto after = field_of(field);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(before[i], 1 - after[i], 1e-6);
}

TEST_P(ScalarFieldTest, new_values_factorise_nothing_and_solve_no_path) {
  field.edit(adding({1, 50}, {0, 1}), nullptr);
  const auto before = field.engine().counters();
  const std::uint32_t site[] = {1};
  const double value[] = {4};
  hf_inner::field::FieldEdit edit;
  edit.set_count = 1;
  edit.set_sites = site;
  edit.set_values = value;
  field.edit(edit, nullptr);
  EXPECT_NEAR(field_of(field)[50], 4, 1e-6);
  EXPECT_EQ(field.engine().counters().factorisations, before.factorisations);
  EXPECT_EQ(field.engine().counters().path_solves, before.path_solves);
}

TEST_P(ScalarFieldTest, a_copy_goes_its_own_way) {
  field.edit(adding({1, 50}, {0, 1}), nullptr);
  const auto before = field_of(field);
  hf_inner::field::ScalarField copy(field);
  copy.edit(adding({90}, {7}), nullptr);
  EXPECT_EQ(before, field_of(field));
  EXPECT_NEAR(field_of(copy)[90], 7, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Engine, ScalarFieldTest, testing::ValuesIn(hf_test::engines()));

}  // namespace
