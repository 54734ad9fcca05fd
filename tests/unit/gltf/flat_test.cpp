// Flattening, welding, shared normals, and the ways back: scatter, bake, colours, a computed skin.
#include <gtest/gtest.h>

#include <random>

#include "gltf/animate.h"
#include "gltf/gltf_write.h"
#include "gltf/skin_write.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

// A cube as exporters store it: 24 vertices, one per corner and face normal.
Model split_cube() {
  Primitive primitive;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = -1; side <= 1; side += 2) {
      const auto first = static_cast<uint32_t>(primitive.positions.size());
      glm::vec3 normal(0);
      normal[axis] = static_cast<float>(side);
      for (int corner = 0; corner < 4; ++corner) {
        glm::vec3 p = normal;
        p[(axis + 1) % 3] = corner == 0 || corner == 3 ? -1.0f : 1.0f;
        p[(axis + 2) % 3] = corner < 2 ? -1.0f : 1.0f;
        primitive.positions.push_back(p);
        primitive.normals.push_back(normal);
      }
      const uint32_t a = side > 0 ? 1 : 2, b = side > 0 ? 2 : 1;
      for (const uint32_t i : {0u, a, b}) primitive.indices.push_back(first + i);
      for (const uint32_t i : {0u, a + 1, b + 1}) primitive.indices.push_back(first + i);
    }
  }
  Model model;
  model.meshes.resize(1);
  model.meshes[0].primitives.push_back(primitive);
  model.nodes.resize(1);
  model.nodes[0].mesh = 0;
  model.scene_roots = {0};
  return model;
}

double volume(const std::vector<glm::dvec3>& p, const std::vector<uint32_t>& triangles) {
  double sum = 0;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    sum += glm::dot(p[triangles[t]], glm::cross(p[triangles[t + 1]], p[triangles[t + 2]])) / 6;
  }
  return sum;
}

TEST(FlatMesh, ASplitCubeIsSixPiecesAsStoredAndOneOfEightVerticesWelded) {
  const FlatMesh mesh = flatten(split_cube());
  EXPECT_EQ(mesh.vertex_count(), 24u);
  EXPECT_EQ(mesh.triangle_count(), 12u);
  EXPECT_EQ(mesh.welded_count, 8u);
  EXPECT_EQ(count_components(mesh.triangles, nullptr, 24), 6u);
  EXPECT_EQ(count_components(mesh.triangles, &mesh.welded, 8), 1u);
  EXPECT_NEAR(volume(mesh.positions, mesh.triangles), 8, 1e-12);
}

TEST(FlatMesh, PlusAndMinusZeroAreOnePosition) {
  std::vector<uint32_t> welded;
  EXPECT_EQ(weld_positions({{0.0, 1, 2}, {-0.0, 1, 2}, {0, 1, 2 + 1e-9}}, welded), 2u);
  EXPECT_EQ(welded, (std::vector<uint32_t>{0, 0, 1}));
  EXPECT_EQ(weld_positions({{0.0, 1, 2}, {5, 1, 2}, {0, 1, 2 + 1e-9}}, welded, 1e-6), 2u);
  EXPECT_EQ(welded, (std::vector<uint32_t>{0, 1, 0}));
}

TEST(FlatMesh, WeldingWithAToleranceJoinsAcrossCellBorders) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 200; ++i) points.emplace_back(number(random), number(random), number(random));
  const double tolerance = 0.15;
  std::vector<uint32_t> welded;
  const uint32_t count = weld_positions(points, welded, tolerance);
  // all pairs, transitively
  std::vector<size_t> root(points.size());
  for (size_t i = 0; i < root.size(); ++i) root[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t j = 0; j < points.size(); ++j) {
        if (glm::distance(points[i], points[j]) <= tolerance && root[j] < root[i]) {
          root[i] = root[j];
          changed = true;
        }
      }
    }
  }
  uint32_t expected = 0;
  for (size_t i = 0; i < root.size(); ++i) expected += root[i] == i;
  EXPECT_EQ(count, expected);
  EXPECT_GT(count, 1u);
  EXPECT_LT(count, 200u);
  for (size_t i = 0; i < root.size(); ++i) EXPECT_EQ(welded[i], welded[root[i]]);
}

TEST(FlatMesh, RestIsTheWorldPoseAndMirroredNodesKeepTheirOutside) {
  Model model = split_cube();
  model.nodes[0].scale = {-1, 2, 1};
  model.nodes[0].translation = {10, 0, 0};
  const FlatMesh mesh = flatten(model);
  EXPECT_TRUE(mesh.parts[0].mirrored);
  EXPECT_NEAR(volume(mesh.positions, mesh.triangles), 16, 1e-12);
  const auto normals = welded_normals(mesh, mesh.positions, true);
  for (size_t v = 0; v < normals.size(); ++v) {
    EXPECT_LT(glm::distance(normals[v], mesh.normals[v]), 1e-6f) << v;
  }
}

TEST(FlatMesh, SharedNormalsAreAreaWeightedAndEqualOnAllCopies) {
  const FlatMesh mesh = flatten(split_cube());
  const auto shared = welded_normals(mesh, mesh.positions);
  for (size_t v = 0; v < shared.size(); ++v) {
    for (size_t w = 0; w < shared.size(); ++w) {
      if (mesh.welded[v] == mesh.welded[w]) {
        EXPECT_EQ(shared[v], shared[w]);
      }
    }
  }
  // by hand: sum of the cross products of all triangles at the welded vertex
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    glm::dvec3 sum(0);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (size_t c = 0; c < 3; ++c) {
        if (mesh.welded[mesh.triangles[t + c]] != mesh.welded[v]) continue;
        const auto &p = mesh.positions[mesh.triangles[t]], &q = mesh.positions[mesh.triangles[t + 1]],
                   &r = mesh.positions[mesh.triangles[t + 2]];
        sum += glm::cross(q - p, r - p);
      }
    }
    EXPECT_LT(glm::distance(glm::dvec3(shared[v]), glm::normalize(sum)), 1e-6);
  }
  const auto creased = welded_normals(mesh, mesh.positions, true);
  for (size_t v = 0; v < creased.size(); ++v) EXPECT_LT(glm::distance(creased[v], mesh.normals[v]), 1e-6f);
}

TEST(FlatMesh, PartsSayWhereAVertexComesFrom) {
  Model model = split_cube();
  model.nodes.resize(3);
  model.nodes[1].mesh = model.nodes[2].mesh = 0;
  model.nodes[2].translation = {5, 0, 0};
  model.scene_roots = {0, 2};  // node 1 is not in the scene
  const FlatMesh mesh = flatten(model);
  ASSERT_EQ(mesh.parts.size(), 2u);
  EXPECT_EQ(mesh.part_of_vertex(23).node, 0);
  EXPECT_EQ(mesh.part_of_vertex(24).node, 2);
  EXPECT_EQ(mesh.part_of_vertex(47).first_vertex, 24u);
  EXPECT_THROW(mesh.part_of_vertex(48), std::runtime_error);
  FlattenOptions options;
  options.nodes = {2};
  EXPECT_EQ(flatten(model, options).vertex_count(), 24u);
  options.max_vertices = 23;
  EXPECT_THROW(flatten(model, options), std::runtime_error);
}

// Two joints; every vertex follows both, with a node hierarchy that turns and scales.
Model skinned_cube() {
  Model model = split_cube();
  model.nodes.resize(3);
  model.nodes[1].children = {2};
  model.nodes[2].parent = 1;
  model.nodes[1].rotation = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 3)));
  model.nodes[1].scale = {3, 3, 3};
  model.nodes[2].translation = {0.5f, 0.25f, 1};
  model.nodes[0].skin = 0;
  model.nodes[0].translation = {7, 7, 7};
  Skin skin;
  skin.joints = {1, 2};
  skin.inverse_bind = {glm::mat4(1), glm::mat4(1)};
  skin.inverse_bind[1][3] = glm::vec4(-0.1f, 0, 0, 1);
  model.skins.push_back(skin);
  Primitive& primitive = model.meshes[0].primitives[0];
  primitive.targets.resize(1);
  for (const glm::vec3& p : primitive.positions) {
    Influences o;
    o.joints = {0, 1};
    o.weights = {0.25f + 0.25f * (p.x + 1), 0.75f - 0.25f * (p.x + 1)};
    primitive.influences.push_back(o);
    primitive.targets[0].positions.push_back(0.1f * p);
  }
  model.nodes[0].weights = {0.5f};
  model.scene_roots = {0, 1};
  return model;
}

TEST(Scatter, NewRestPositionsComeBackFromAPlainAndASkinnedModel) {
  for (const bool skinned : {false, true}) {
    Model model = skinned ? skinned_cube() : split_cube();
    if (!skinned) model.nodes[0].rotation = glm::angleAxis(0.3f, glm::vec3(0, 1, 0));
    const FlatMesh mesh = flatten(model);
    EXPECT_EQ(mesh.welded_count, 8u);
    std::vector<glm::dvec3> wanted = mesh.positions;
    for (glm::dvec3& p : wanted) p = 1.1 * p + glm::dvec3(0.1 * p.y, 0.2, 0);
    scatter(model, mesh, wanted);
    const FlatMesh again = flatten(model);
    EXPECT_EQ(again.welded_count, 8u);  // seams stay closed to the last bit
    for (size_t v = 0; v < wanted.size(); ++v) EXPECT_LT(glm::distance(again.positions[v], wanted[v]), 1e-5) << v;
    const auto normals = welded_normals(mesh, wanted);
    for (size_t v = 0; v < wanted.size(); ++v) EXPECT_LT(glm::distance(again.normals[v], normals[v]), 1e-5f) << v;
  }
}

TEST(Scatter, AMeshUsedTwiceIsCopiedSoThatEachNodeGetsItsOwn) {
  Model model = split_cube();
  model.nodes.resize(2);
  model.nodes[1].mesh = 0;
  model.nodes[1].translation = {5, 0, 0};
  model.scene_roots = {0, 1};
  const FlatMesh mesh = flatten(model);
  std::vector<glm::dvec3> wanted = mesh.positions;
  for (size_t v = 24; v < 48; ++v) wanted[v] += glm::dvec3(0, 3, 0);
  scatter(model, mesh, wanted);
  EXPECT_EQ(model.meshes.size(), 2u);
  const FlatMesh again = flatten(model);
  for (size_t v = 0; v < wanted.size(); ++v) EXPECT_LT(glm::distance(again.positions[v], wanted[v]), 1e-6) << v;
}

TEST(Scatter, WrongSizesAndNanAreRefusedAndChangeNothing) {
  Model model = split_cube();
  const FlatMesh mesh = flatten(model);
  std::vector<glm::dvec3> wanted = mesh.positions;
  wanted.pop_back();
  EXPECT_THROW(scatter(model, mesh, wanted), std::runtime_error);
  wanted = mesh.positions;
  wanted[3].x = NAN;
  EXPECT_NE(message_of([&] { scatter(model, mesh, wanted); }).find("vertex 3"), std::string::npos);
  EXPECT_EQ(model.meshes[0].primitives[0].positions, split_cube().meshes[0].primitives[0].positions);
}

TEST(Scatter, WhatAScaleOfZeroCollapsesStaysAsStoredAndIsSaid) {
  Model model = split_cube();
  model.nodes.push_back(model.nodes[0]);  // the same cube beside it, collapsed
  model.nodes[1].scale = {1, 0, 1};
  model.scene_roots = {0, 1};
  const FlatMesh mesh = flatten(model);
  std::vector<glm::dvec3> wanted = mesh.positions;
  for (glm::dvec3& p : wanted) p += glm::dvec3(1, 2, 3);
  scatter(model, mesh, wanted);
  const FlatMesh again = flatten(model);
  for (size_t v = 0; v < wanted.size(); ++v) {
    EXPECT_LT(glm::distance(again.positions[v], v < 24 ? wanted[v] : mesh.positions[v]), 1e-6) << v;
  }
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0].compare(0, 11, "24 vertices"), 0) << model.warnings[0];
}

TEST(Bake, APosedFrameBecomesAStillModelInWorldSpace) {
  const Model model = skinned_cube();
  const FlatMesh mesh = flatten(model);
  const Model still = bake(model, mesh, mesh.positions);
  EXPECT_TRUE(still.skins.empty());
  const FlatMesh again = flatten(still);
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(again.positions[v], float_rounded(mesh.positions[v]));
  }
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_NO_THROW(check_model(still));
}

// The computed skin must reproduce x -> sum w (R x + t) at the keys, and stand in the rest pose without a clip.
TEST(SkinModel, KeysReproduceTheMotionAndRestIsUntouched) {
  const Model source = skinned_cube();
  const FlatMesh mesh = flatten(source);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  SkinDescription skin;
  skin.influences_per_vertex = 3;
  const size_t joints = 4, frames = 5;
  for (size_t j = 0; j < joints; ++j) {
    skin.joints.push_back({"cluster_" + std::to_string(j), {number(random), number(random), number(random)}});
  }
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    for (uint32_t k = 0; k < 3; ++k) {
      skin.vertex_joints.push_back((mesh.welded[v] + k) % joints);
      skin.vertex_weights.push_back(1.0f + static_cast<float>(k));
    }
  }
  SkinClip clip;
  clip.name = "walk";
  for (size_t f = 0; f < frames; ++f) {
    clip.times.push_back(0.25 * static_cast<double>(f));
    for (size_t j = 0; j < joints; ++j) {
      const glm::dquat q = glm::normalize(glm::dquat(number(random), number(random), number(random), number(random)));
      clip.rotations.push_back(f % 2 == 0 ? q : -q);
      clip.translations.emplace_back(number(random), number(random), number(random));
    }
  }
  skin.clips.push_back(clip);
  const Model model = skin_model(source, mesh, skin);
  EXPECT_NO_THROW(check_model(model));
  const std::string bytes = gltf_bytes(model, true);
  const Model back = read_gltf_bytes({bytes.begin(), bytes.end()}, "skin.glb");
  const FlatMesh flat = flatten(back);
  ASSERT_EQ(flat.vertex_count(), mesh.vertex_count());
  EXPECT_EQ(flat.triangles, mesh.triangles);
  EXPECT_EQ(flat.welded_count, mesh.welded_count);
  for (size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_LT(glm::distance(flat.positions[v], mesh.positions[v]), 1e-6);
  for (size_t f = 0; f < frames; ++f) {
    const auto posed = posed_positions(back, flat, back.animations.at(0), clip.times[f]);
    for (size_t v = 0; v < posed.size(); ++v) {
      glm::dvec3 expected(0);
      for (size_t k = 0; k < 3; ++k) {
        const size_t motion = f * joints + skin.vertex_joints[3 * v + k];
        expected +=
            (static_cast<double>(k) + 1) / 6 * (clip.rotations[motion] * mesh.positions[v] + clip.translations[motion]);
      }
      EXPECT_LT(glm::distance(posed[v], expected), 2e-6) << "frame " << f << ", vertex " << v;
    }
  }
  // sign continuity: neighbouring keys never lie on opposite half spheres
  for (const Channel& channel : back.animations[0].channels) {
    if (channel.path != Path::rotation) continue;
    for (size_t k = 1; k < channel.times.size(); ++k) {
      float dot = 0;
      for (size_t c = 0; c < 4; ++c) dot += channel.values[4 * k + c] * channel.values[4 * k - 4 + c];
      EXPECT_GE(dot, 0);
    }
  }
}

// Twenty nodes with one mesh, the last five with another material: two primitives, the vertices in their order.
TEST(SkinModel, NeighboursOfOneLookBecomeOnePrimitive) {
  Model source = split_cube();
  source.materials.resize(2);
  source.meshes.push_back(source.meshes[0]);
  source.meshes[1].primitives[0].material = 1;
  source.nodes.clear();
  source.scene_roots.clear();
  for (int i = 0; i < 20; ++i) {
    Node node;
    node.mesh = i < 15 ? 0 : 1;
    node.translation.x = 3 * static_cast<float>(i);
    source.nodes.push_back(node);
    source.scene_roots.push_back(i);
  }
  const FlatMesh mesh = flatten(source);
  SkinDescription skin;
  skin.influences_per_vertex = 1;
  skin.joints.push_back({"all", {0, 0, 0}});
  skin.vertex_joints.assign(mesh.positions.size(), 0);
  skin.vertex_weights.assign(mesh.positions.size(), 1);
  const Model model = skin_model(source, mesh, skin);
  EXPECT_NO_THROW(check_model(model));
  ASSERT_EQ(model.meshes.size(), 1u);
  ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
  EXPECT_EQ(model.meshes[0].primitives[0].positions.size(), 15u * 24);
  EXPECT_EQ(model.meshes[0].primitives[1].material, 1);
  const FlatMesh flat = flatten(model);
  EXPECT_EQ(flat.triangles, mesh.triangles);
  for (size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_LT(glm::distance(flat.positions[v], mesh.positions[v]), 1e-5);
}

// Tangents are joined too; numbers of the host's own and what a primitive carries keep primitives apart.
TEST(SkinModel, NeighboursWithTangentsJoinAndThoseThatCarryMoreStay) {
  Model source = split_cube();
  source.asset = R"({"copyright":"somebody"})";
  Primitive& own = source.meshes[0].primitives[0];
  const auto count = own.positions.size();
  for (const glm::vec3& n : own.normals)
    own.tangents.emplace_back(
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0))), 1);
  if (own.normals.empty()) {
    own.normals.assign(count, {0, 0, 1});
    own.tangents.assign(count, {1, 0, 0, 1});
  }
  source.meshes.resize(3, source.meshes[0]);
  CarriedNumbers ids;
  ids.component = 5121;
  ids.type = 1;
  ids.count = count;
  ids.bytes.assign(count, 7);
  source.meshes[1].primitives[0].carried_attributes.emplace_back("_ID", ids);
  source.meshes[2].primitives[0].carried.extras = "3";
  source.nodes.clear();
  source.scene_roots.clear();
  for (const int mesh : {0, 0, 1, 1, 2, 2}) {
    Node node;
    node.mesh = mesh;
    node.translation.x = 3 * static_cast<float>(source.nodes.size());
    source.scene_roots.push_back(static_cast<int>(source.nodes.size()));
    source.nodes.push_back(node);
  }
  const FlatMesh mesh = flatten(source);
  SkinDescription skin;
  skin.influences_per_vertex = 1;
  skin.joints.push_back({"all", {0, 0, 0}});
  skin.vertex_joints.assign(mesh.positions.size(), 0);
  skin.vertex_weights.assign(mesh.positions.size(), 1);
  const Model model = skin_model(source, mesh, skin);
  EXPECT_NO_THROW(check_model(model));
  EXPECT_EQ(model.asset, source.asset);
  const std::vector<Primitive>& made = model.meshes[0].primitives;
  ASSERT_EQ(made.size(), 4u);
  for (const Primitive& primitive : made) EXPECT_EQ(primitive.tangents.size(), primitive.positions.size());
  EXPECT_EQ(made[0].positions.size(), 2 * count);
  EXPECT_EQ(made[1].carried_attributes[0].second.bytes, ids.bytes);
  EXPECT_EQ(made[3].carried.extras, "3");
}

TEST(SkinModel, WrongDescriptionsAreRefusedByName) {
  const Model source = split_cube();
  const FlatMesh mesh = flatten(source);
  SkinDescription good;
  good.influences_per_vertex = 1;
  good.joints.push_back({"a", {0, 0, 0}});
  good.vertex_joints.assign(24, 0);
  good.vertex_weights.assign(24, 1);
  EXPECT_NO_THROW(skin_model(source, mesh, good));
  SkinDescription bad = good;
  bad.vertex_joints[5] = 1;
  EXPECT_NE(message_of([&] { skin_model(source, mesh, bad); }).find("vertex 5"), std::string::npos);
  bad = good;
  bad.vertex_weights[7] = 0;
  EXPECT_NE(message_of([&] { skin_model(source, mesh, bad); }).find("vertex 7"), std::string::npos);
  bad = good;
  bad.clips.push_back({"c", {0}, {glm::dquat(2, 0, 0, 0)}, {glm::dvec3(0)}});
  EXPECT_NE(message_of([&] { skin_model(source, mesh, bad); }).find("frame 0, joint 0"), std::string::npos);
}

}  // namespace
