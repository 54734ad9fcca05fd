// Discs and handle regions hold their inside apart from the rest, also with an operator whose edges are not the mesh's.
#include "surface/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deform/handles.h"
#include "field/scalar_field.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

std::shared_ptr<const hf_inner::surface::Core> core_of(const hf_test::PlainMesh& mesh,
                                                       hf_inner::mesh::OperatorKind kind) {
  hf_inner::surface::CoreOptions options;
  options.operator_kind = kind;
  return hf_test::make_core(mesh, 1, options);
}

constexpr hf_inner::mesh::OperatorKind kinds[] = {hf_inner::mesh::OperatorKind::cotangent,
                                                  hf_inner::mesh::OperatorKind::intrinsic_delaunay};

TEST(Rim, of_a_disc_keeps_its_inside_at_the_value_of_the_site) {
  for (const hf_inner::mesh::OperatorKind kind : kinds) {
    const auto core = core_of(hf_test::torus(60, 30, 0.4, 3), kind);
    hf_inner::field::ScalarField field(core, 1, 10000);
    const std::uint32_t vertices[] = {100, 1000};
    const double values[] = {2, -1}, radii[] = {0.8, 0.7};
    hf_inner::field::FieldEdit edit;
    edit.add.count = 2;
    edit.add.vertices = vertices;
    edit.add_holds.radii = radii;
    edit.add_holds.values = values;
    field.edit(edit, nullptr);
    std::vector<double> u(static_cast<std::size_t>(core->size()));
    field.solve(u.data());
    int inside = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
      const double d = core->mesh.scale * norm(core->mesh.positions[v] - core->mesh.positions[100]);
      if (d > 0.5) continue;
      ++inside;
      EXPECT_NEAR(u[v], 2, 1e-12) << "vertex " << v << ", " << d << " away";
    }
    EXPECT_GT(inside, 20);
  }
}

TEST(Rim, of_a_region_lets_nothing_of_the_field_through) {
  for (const hf_inner::mesh::OperatorKind kind : kinds) {
    const auto core = core_of(hf_test::sheared_patch(30, 24, 2.5), kind);
    hf_inner::Memory& memory = *core->memory;
    std::vector<std::int32_t> left, right;
    for (std::int32_t v = 0; v < core->size(); ++v) {
      const int column = v % 31;
      if (column < 8) left.push_back(v);
      if (column > 22) right.push_back(v);
    }
    const auto solver = hf_inner::solve::SiteSolver::make(core);
    std::vector<std::int32_t> slots;
    std::vector<hf_inner::solve::Site> sites;
    std::vector<double> values;
    for (const auto* region : {&left, &right}) {
      const auto made = hf_inner::deform::make_region(*core, *region, 0, memory);
      EXPECT_LT(made->sites.size(), region->size());
      for (const std::int32_t v : made->sites) {
        slots.push_back(static_cast<std::int32_t>(slots.size()));
        sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, v));
        values.push_back(region == &left ? 0.0 : 1.0);
      }
    }
    hf_inner::solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = sites;
    solver->edit(edit);
    std::vector<double> u(static_cast<std::size_t>(core->size()));
    solver->solve(values.data(), 1, u.data(), nullptr);
    for (const std::int32_t v : left) EXPECT_NEAR(u[static_cast<std::size_t>(v)], 0, 1e-12);
    for (const std::int32_t v : right) EXPECT_NEAR(u[static_cast<std::size_t>(v)], 1, 1e-12);
  }
}

}  // namespace
