// No mesh and no skeleton leaves a vertex without weights, and none fails.
#include <random>

#include "base/error.h"
#include "support/dirty_meshes.h"
#include "weights/pieces.h"
#include "weights_support.h"

namespace {

using namespace hf_test;
using hf_inner::weights::Weights;

// Specks, holes, doubled faces, shells, flipped triangles, another scale, moved vertices.
PlainMesh damaged(std::uint32_t seed) {
  PlainMesh mesh = tube(10, 16, 6);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto chance = [&](std::uint32_t of) { return random() % of == 0; };
  if (chance(3)) {
    for (int i = 0; i < 5; ++i) {
      PlainMesh speck = tube(3, 2, 0.02);
      for (std::size_t p = 0; p < speck.positions.size(); ++p)
        speck.positions[p] = 0.02 * speck.positions[p] + any(random);
      append(mesh, speck, 3 + 4 * any(random));
    }
  }
  if (chance(3)) append(mesh, PlainMesh(mesh), 0);  // doubled faces
  if (chance(3)) append(mesh, tube(6, 5, 3), 1);    // a shell inside
  std::vector<std::uint32_t> kept;
  const bool holes = chance(2), flips = chance(2), inside_out = chance(6);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    if (holes && chance(9)) continue;
    const bool turn = inside_out || (flips && chance(5));
    kept.insert(kept.end(),
                {mesh.triangles[t], mesh.triangles[t + (turn ? 2 : 1)], mesh.triangles[t + (turn ? 1 : 2)]});
  }
  mesh.triangles = kept;
  if (chance(3)) {
    for (double& x : mesh.positions) {
      if (chance(40)) x += 0.5 * any(random);
    }
  }
  if (chance(4)) mesh.triangles.insert(mesh.triangles.end(), {0, 1, 0, 2, 2, 2});
  if (chance(4)) {  // a needle and a fan on one edge
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t tip = mesh.vertex_count();
      mesh.positions.insert(mesh.positions.end(), {any(random), 1 + 1e-9 * any(random), any(random)});
      mesh.triangles.insert(mesh.triangles.end(), {0, 1, tip});
    }
  }
  const double scale = chance(3) ? std::pow(10.0, 6 * any(random)) : 1;
  for (double& x : mesh.positions) x *= scale;
  return mesh;
}

hf_inner::weights::Bones skeleton(hf_inner::Memory& memory, const PlainMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed + 1000);
  std::uniform_real_distribution<double> any(-1, 1);
  double size = 0;
  for (const double x : mesh.positions) size = std::max(size, std::fabs(x));
  hf_inner::weights::Bones bones = chain(memory, 1 + static_cast<int>(random() % 9), size);
  bones.has_tails = random() % 3 != 0;
  for (std::size_t b = 0; b < bones.head.size(); ++b) {
    switch (random() % 6) {
      case 0:
        bones.tail[b] = bones.head[b];  // no length
        break;
      case 1:
        bones.head[b].y += 3 * size * any(random);  // outside
        break;
      case 2:
        if (b > 0) {
          bones.head[b] = bones.head[b - 1];
          bones.tail[b] = bones.tail[b - 1];
        }  // coincident
        break;
      case 3:
        if (random() % 8 == 0) bones.head[b].x = 1e300 * any(random);
        break;
      default:
        break;
    }
  }
  if (random() % 10 == 0) {
    for (auto& p : bones.head) p.z += 1e4 * size;  // no mesh near
    for (auto& p : bones.tail) p.z += 1e4 * size;
  }
  return bones;
}

TEST(DamagedWeights, NoVariantFailsAndNoVertexIsBare) {
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const PlainMesh mesh = damaged(seed);
    const auto skin = skin_of(mesh);
    const Weights weights(skin, seed % 2 ? 4 : 8, skeleton(*skin->core->memory, mesh, seed));
    expect_valid(weights, "seed " + std::to_string(seed));
  }
}

// Three pieces, of which the first is solved: the small one is rigid, the large one follows the nearest vertices.
TEST(DamagedWeights, PiecesWithoutInformationFindTheirCarriers) {
  PlainMesh mesh = tube(8, 9, 6);
  append(mesh, tube(8, 9, 6), 2);  // crosses the first
  PlainMesh speck = tube(3, 2, 0.1);
  for (double& x : speck.positions) x *= 0.1;
  append(mesh, speck, 10);
  const auto core = make_core(mesh);
  hf_inner::Memory& memory = *core->memory;
  hf_inner::Vector<std::uint8_t> solved(3, 0, &memory);
  const auto none = hf_inner::weights::find_carriers(core->mesh, solved, memory, *core->jobs);
  EXPECT_EQ(none.of[0], -1);
  solved[0] = 1;
  const auto found = hf_inner::weights::find_carriers(core->mesh, solved, memory, *core->jobs);
  EXPECT_EQ(found.carried_pieces, 1u);
  EXPECT_EQ(found.rigid_pieces, 1u);
  EXPECT_EQ(found.rigid[2], 1);
  for (Index v = 0; v < core->size(); ++v) {
    double best = HUGE_VAL;
    for (Index w = 0; w < core->size(); ++w) {
      const double d = norm(core->mesh.positions[at(v)] - core->mesh.positions[at(w)]);
      if (core->mesh.component[at(w)] == 0 && d < best) best = d;
    }
    EXPECT_LE(hf_inner::norm(core->mesh.positions[at(v)] - core->mesh.positions[at(found.of[at(v)])]),
              best * (1 + 1e-12));
    if (core->mesh.component[at(v)] == 0) {
      EXPECT_EQ(found.of[at(v)], v);
    }
  }
}

TEST(DamagedWeights, DirtyMeshesTakeWeights) {
  for (const auto& [name, mesh] : dirty_meshes()) {
    for (const auto kind : {hf_inner::mesh::OperatorKind::intrinsic_delaunay, hf_inner::mesh::OperatorKind::clamped,
                            hf_inner::mesh::OperatorKind::uniform}) {
      hf_inner::surface::CoreOptions options;
      options.operator_kind = kind;
      const auto core = make_core(mesh, 1, options);
      const auto skin = hf_inner::make_owner_in<hf_inner::weights::SkinSurface>(core->memory, core);
      const Weights weights(skin, 4, skeleton(*core->memory, mesh, 7));
      expect_valid(weights, name);
    }
  }
}

}  // namespace
