// Weights carried from one surface to another: exact on the same surface, none missing on 200 garments, close to the
// best fit on levels of detail.
#include "base/error.h"
#include "carry_support.h"
#include "support/decimate.h"

namespace {

using namespace hf_test;
using hf_inner::weights::FilledWeights;
using hf_inner::weights::Origin;

const Body& body_of(std::size_t kind) {
  static const Body bodies[3] = {make_body("biped", 1500), make_body("horse", 1500), make_body("bull", 1500)};
  return bodies[kind];
}

TEST(CarriedWeights, TheSameSurfaceGetsItsWeightsBack) {
  const Body& body = body_of(0);
  const auto core = make_core(body.mesh);
  const FilledWeights found = carry(core, body.given(), core);
  EXPECT_EQ(found.by_origin[static_cast<std::size_t>(Origin::matched)], body.mesh.vertex_count());
  EXPECT_EQ(faults_of(found, body.mesh.vertex_count(), body.heads.size()), 0u);
  double worst = 0;
  for (Index v = 0; v < core->size(); ++v) {
    const std::size_t given = at(core->mesh.given_of_inner[at(v)]);
    for (std::size_t k = 0; k < 4; ++k) {
      const double w = static_cast<double>(body.weights[4 * given + k]);
      if (w > 0) worst = std::max(worst, std::fabs(share_of(found, at(v), body.joints[4 * given + k]) - w));
    }
  }
  EXPECT_LT(worst, 1e-6);
}

// Half of a tube has a source beside it. The other half is filled in, and its weights lie between those of the rim.
TEST(CarriedWeights, VerticesWithoutAMatchAreFilledIn) {
  const PlainMesh source = around_line({0, 0, 0}, {2, 0, 0}, 1, 1, 24, 9),
                  target = around_line({0, 0, 0}, {4, 0, 0}, 1.02, 1.02, 16, 21);
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
  for (std::uint32_t v = 0; v < source.vertex_count(); ++v) {
    const float along = static_cast<float>(source.positions[3 * v] / 2);
    joints.insert(joints.end(), {7, 3});
    weights.insert(weights.end(), {1 - along, along});
  }
  const auto to = make_core(target);
  const FilledWeights found = carry(make_core(source), {2, joints.data(), weights.data()}, to);
  EXPECT_EQ(faults_of(found, target.vertex_count(), 8), 0u);
  EXPECT_GT(found.by_origin[static_cast<std::size_t>(Origin::solved)], 100u);
  for (Index v = 0; v < to->size(); ++v) {
    const double x = target.positions[3 * at(to->mesh.given_of_inner[at(v)])];
    const double expected = std::min(x / 2, 1.0);
    EXPECT_NEAR(share_of(found, at(v), 3), expected, 0.02) << x;
    EXPECT_EQ(found.origin[at(v)], x < 2.05 ? Origin::matched : x > 2.25 ? Origin::solved : found.origin[at(v)]) << x;
  }
}

// The nearest point of two sheets back to back is the one whose normal agrees, although the other is nearer.
TEST(CarriedWeights, ThePointWhoseNormalAgreesIsTaken) {
  PlainMesh source = grid(8, 8, 1), back = source, target = grid(5, 5, 1.4);
  for (std::size_t p = 2; p < back.positions.size(); p += 3) back.positions[p] = 0.1;
  for (std::size_t t = 0; t < back.triangles.size(); t += 3) std::swap(back.triangles[t], back.triangles[t + 1]);
  append(source, back, 0);
  for (std::size_t p = 2; p < target.positions.size(); p += 3) target.positions[p] = 0.09;
  std::vector<std::uint32_t> joints(source.vertex_count());
  for (std::size_t v = 0; v < joints.size(); ++v) joints[v] = v >= joints.size() / 2;
  const std::vector<float> weights(joints.size(), 1.0f);
  const auto to = make_core(target);
  FilledWeights found = carry(make_core(source), {1, joints.data(), weights.data()}, to);
  for (Index v = 0; v < to->size(); ++v) EXPECT_EQ(share_of(found, at(v), 0), 1.0);
  hf_inner::weights::MatchOptions any = carry_options();
  any.cosine = -2;
  found = carry(make_core(source), {1, joints.data(), weights.data()}, to, any);
  for (Index v = 0; v < to->size(); ++v) EXPECT_EQ(share_of(found, at(v), 1), 1.0);
}

TEST(CarriedWeights, SourceVerticesWithoutWeightsGiveNone) {
  const PlainMesh source = grid(8, 8, 1), target = grid(11, 11, 8.0 / 11);
  std::vector<std::uint32_t> joints(source.vertex_count(), 5);
  std::vector<float> weights(source.vertex_count(), 0.0f);
  const auto from = make_core(source), to = make_core(target);
  EXPECT_THROW(carry(from, {1, joints.data(), weights.data()}, to), hf_inner::Error);
  weights[40] = 0.25f;  // one vertex gives the weights of all
  const FilledWeights found = carry(from, {1, joints.data(), weights.data()}, to);
  EXPECT_EQ(faults_of(found, target.vertex_count(), 6), 0u);
  for (Index v = 0; v < to->size(); ++v) EXPECT_EQ(share_of(found, at(v), 5), 1.0);
}

TEST(CarriedWeights, APointWithoutWeightsTakesTheSameInEveryOrderOfTheFaces) {
  const PlainMesh mesh = grid(8, 8, 1, 0.3);
  const std::uint32_t bare = 40;  // every vertex has a joint of its own but this one
  std::vector<std::uint32_t> joints(mesh.vertex_count());
  std::vector<float> weights(mesh.vertex_count(), 1.0f);
  for (std::uint32_t v = 0; v < joints.size(); ++v) joints[v] = v;
  weights[bare] = 0;
  const hf_inner::weights::GivenWeights given{1, joints.data(), weights.data()};
  const auto to = make_core(mesh);
  const FilledWeights expected = carry(make_core(mesh), given, to);
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    PlainMesh turned = mesh;
    for (std::uint32_t t = turned.triangle_count(); t-- > 0;) {
      const std::uint32_t other = random() % (t + 1), turn = random() % 3;
      std::swap_ranges(&turned.triangles[3 * t], &turned.triangles[3 * t] + 3, &turned.triangles[3 * other]);
      std::rotate(&turned.triangles[3 * t], &turned.triangles[3 * t] + turn, &turned.triangles[3 * t] + 3);
    }
    const FilledWeights found = carry(make_core(turned), given, to);
    for (const std::uint32_t joint : joints)
      EXPECT_NEAR(share_of(found, bare, joint), share_of(expected, bare, joint), 1e-6) << joint;
  }
}

TEST(CarriedWeights, TwoHundredGarmentsHaveNoBareVertex) {
  std::shared_ptr<const hf_inner::surface::Core> cores[3];
  for (std::size_t k = 0; k < 3; ++k) cores[k] = make_core(body_of(k).mesh);
  std::size_t vertices = 0;
  std::uint32_t by_origin[8] = {};
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const Body& body = body_of(seed / 4 % 3);
    const PlainMesh mesh = garment(body, seed);
    const auto core = make_core(mesh);
    const FilledWeights found = carry(cores[seed / 4 % 3], body.given(), core, carry_options(seed % 2 ? 4 : 8));
    EXPECT_EQ(faults_of(found, at(core->size()), body.heads.size()), 0u) << "seed " << seed;
    EXPECT_EQ(found.nearest_of_isolated.size(), core->mesh.isolated.size());
    for (int o = 0; o < 8; ++o) by_origin[o] += found.by_origin[o];
    vertices += mesh.vertex_count();
  }
  std::uint32_t sum = 0;
  for (const std::uint32_t count : by_origin) sum += count;
  EXPECT_EQ(sum, vertices);
  // The garments ask for every way in which a vertex gets weights.
  for (const Origin o : {Origin::matched, Origin::solved, Origin::carried, Origin::rigid, Origin::isolated})
    EXPECT_GT(by_origin[static_cast<std::size_t>(o)], 0u) << static_cast<int>(o);
  std::printf("garments: %zu vertices, %u matched, %u solved, %u carried, %u rigid, %u isolated\n", vertices,
              by_origin[6], by_origin[1], by_origin[3], by_origin[4], by_origin[5]);
}

TEST(CarriedWeights, ThreadsDoNotChangeTheBits) {
  const Body& body = body_of(1);
  const PlainMesh mesh = garment(body, 13);
  const auto source = make_core(body.mesh);
  const auto single = make_core(mesh, 1), quadruple = make_core(mesh, 4);  // they own the memory of the weights
  const FilledWeights one = carry(source, body.given(), single), four = carry(source, body.given(), quadruple);
  EXPECT_EQ(one.weights, four.weights);
  EXPECT_EQ(one.joints, four.joints);
}

// Discs of a body lose their weights and are filled in again. Returns the mean difference from the true weights there.
double fill_error(std::size_t kind, hf_inner::mesh::FieldKind field) {
  const Body& body = body_of(kind);
  hf_inner::surface::CoreOptions options;
  options.field_kind = field;
  const auto core = make_core(body.mesh, 1, options);
  const hf_inner::mesh::Mesh& mesh = core->mesh;
  double error = 0;
  std::size_t count = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const hf_inner::Vec3 centre = mesh.positions[(seed * 977u + 13u) % mesh.positions.size()];
    const auto known = [&](Index v) { return norm(mesh.positions[at(v)] - centre) > 0.04 + 0.01 * (seed % 6); };
    hf_inner::Memory& memory = *core->memory;
    hf_inner::weights::Fill fill(core, memory);
    fill.known = hf_inner::weights::read_rows(mesh, body.given(), known, memory);
    fill.origin.assign(at(core->size()), Origin::matched);
    hf_inner::weights::WeightRows guessed(memory);
    for (Index v = 0; v < core->size(); ++v) guessed.close();
    const FilledWeights found = fill_weights(fill, guessed, 4);
    for (Index v = 0; v < core->size(); ++v) {
      if (known(v)) continue;
      const std::size_t given = at(mesh.given_of_inner[at(v)]);
      double same = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = static_cast<double>(body.weights[4 * given + k]);
        if (w > 0) same += std::min(w, share_of(found, at(v), body.joints[4 * given + k]));
      }
      error += 1 - same;
      ++count;
    }
  }
  return error / static_cast<double>(count);
}

TEST(CarriedWeights, BiharmonicFillsComeNearerToTheTruthThanHarmonicOnes) {
  double harmonic = 0, biharmonic = 0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const double one = fill_error(kind, hf_inner::mesh::FieldKind::harmonic),
                 two = fill_error(kind, hf_inner::mesh::FieldKind::biharmonic);
    std::printf("%zu: share that other joints move: harmonic %.4f, bi-harmonic %.4f\n", kind, one, two);
    harmonic += one;
    biharmonic += two;
  }
  EXPECT_LT(biharmonic, 0.75 * harmonic);
  EXPECT_LT(biharmonic, 3 * 0.2);
}

}  // namespace
