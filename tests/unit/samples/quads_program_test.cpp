// hf_quads run as a user runs it: its figures, its polygons read back, its picture, and what bad input is answered.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "assets/creature.h"
#include "assets/creature_gltf.h"
#include "assets/face_gltf.h"
#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "quads/surface_distance.h"
#include "support/creature.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using namespace hf_gltf;
using samples_test::TemporaryFolder;

int run(const std::string& arguments, std::string& output) {
  return hf_test::run(hf_test::quoted(HF_QUADS_PROGRAM) + " " + arguments, output);
}

std::string line_of(const std::string& text, const std::string& begin) {
  const size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at);
}

// Two squares, and a third that stands across both.
TEST(QuadsProgram, CountsFacesThatCross) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "cross.obj").string();
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                         "v .5 .5 -1\nv 1.5 .4 -1\nv 1.5 .5 1\nv .5 .4 1\nv 5 5 5\nv 6 5 5\nv 5 6 5\n"
                         "f 1 2 3 4\nf 2 5 6 3\nf 7 8 9 10\nf 11 12 13\n";
  std::string text;
  ASSERT_EQ(run("\"" + file + "\" --measure \"" + file + "\"", text), 0) << text;
  EXPECT_NE(text.find("crossing    3 faces"), std::string::npos) << text;
}

// A box keeps its twelve creases. Two ridges nearer than an edge are too near for large quads, and are named.
TEST(QuadsProgram, NamesCreasesThatAreReleased) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "plate.obj").string();
  const int count = 40;  // ridges along y, of a plate of 1 by 1 with 80 strips
  {
    std::ofstream plate(file);
    for (int i = 0; i <= 2 * count; ++i) {
      for (const double y : {0.0, 1.0})
        plate << "v " << 0.5 * i / count << " " << y << " " << (i % 2 ? 0.02 : 0) << "\n";
    }
    for (int i = 0; i < 2 * count; ++i)
      plate << "f " << 2 * i + 1 << " " << 2 * i + 3 << " " << 2 * i + 4 << "\n"
            << "f " << 2 * i + 1 << " " << 2 * i + 4 << " " << 2 * i + 2 << "\n";
  }
  std::string text;
  ASSERT_EQ(run("\"" + file + "\" --faces 100 --crease 30 --relax 0", text), 0) << text;
  EXPECT_EQ(text.find("creases     79 of 79"), std::string::npos) << text;
  EXPECT_NE(text.find("are released"), std::string::npos) << text;
  ASSERT_EQ(run("\"" + file + "\" --faces 100 --crease 120 --relax 0", text), 0) << text;
  EXPECT_NE(text.find("creases     0 of 0 edges"), std::string::npos) << text;
  EXPECT_EQ(text.find("are released"), std::string::npos) << text;
}

// A disc without a vertex inside: its triangles are long and thin, and each place lies in the boxes of thousands.
TEST(QuadsProgram, SaysWhatItDoesNotMeasure) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "disc.off").string(), out = (folder.path / "quads.obj").string();
  const int corners = 6000;
  {
    std::ofstream disc(file);
    disc << "OFF\n" << corners << " " << corners - 2 << " 0\n";
    for (int i = 0; i < corners; ++i)
      disc << std::cos(6.283185307179586 * i / corners) << " " << std::sin(6.283185307179586 * i / corners) << " 0\n";
    for (int i = 1; i + 1 < corners; ++i) disc << "3 0 " << i << " " << i + 1 << "\n";
  }
  std::string text;
  ASSERT_EQ(run("\"" + file + "\" -o \"" + out + "\"", text), 0) << text;
  EXPECT_NE(text.find("Euler characteristic 1 (surface 1), directed edges once: yes"), std::string::npos) << text;
  EXPECT_NE(text.find("crossing    not counted"), std::string::npos) << text;
  EXPECT_NE(text.find("Hausdorff   not measured"), std::string::npos) << text;
}

TEST(QuadsProgram, WritesQuadsAndSaysWhatTheyAreWorth) {
  const TemporaryFolder folder;
  const ShapeMesh cactus = hf_test::cactus(1500);
  SurfaceMesh mesh;
  for (size_t i = 0; i < cactus.positions.size(); i += 3)
    mesh.positions.push_back({cactus.positions[i], cactus.positions[i + 1], cactus.positions[i + 2]});
  mesh.triangles = cactus.triangles;
  const std::string in = (folder.path / "cactus.obj").string(), out = (folder.path / "quads.obj").string(),
                    png = (folder.path / "quads.png").string();
  write_mesh_file(mesh, in);
  std::string text, again;
  ASSERT_EQ(run("\"" + in + "\" --edge 4% -o \"" + out + "\" --sheet \"" + png + "\"", text), 0) << text;
  for (const char* word : {"Euler characteristic 2 (surface 2)", "repeated corners: none", "100.00 % of the faces",
                           "valence", "crossing    0 faces", "aspect", "angle off", "Hausdorff"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  const SurfaceMesh back = read_mesh_file(out);
  ASSERT_FALSE(back.face_sizes.empty());
  for (const uint32_t size : back.face_sizes) EXPECT_EQ(size, 4u);
  EXPECT_EQ(back.positions.size(), back.face_sizes.size() + 2);  // closed quads of genus 0
  EXPECT_GT(fs::file_size(png), 10000u);
  ASSERT_EQ(run("\"" + in + "\" --measure \"" + out + "\"", again), 0) << again;
  for (const char* line : {"valence", "irregular", "aspect", "angle off", "Hausdorff"})
    EXPECT_EQ(line_of(again, line), line_of(text, line)) << line;
  EXPECT_EQ(run("\"" + in + "\" --edge -1", text), 1);
  EXPECT_EQ(run("\"" + in + "\" --bogus", text), 1);
  EXPECT_NE(text.find("--bogus"), std::string::npos) << text;
  EXPECT_EQ(run("", text), 1);
}

// A torus with a stroke along its top, on one side of the plane.
TEST(QuadsProgram, FollowsStrokesAndMirrors) {
  const TemporaryFolder folder;
  const ShapeMesh torus = samples::jittered_torus(80, 50);
  SurfaceMesh mesh;
  for (size_t i = 0; i < torus.positions.size(); i += 3)
    mesh.positions.push_back({torus.positions[i], torus.positions[i + 1], torus.positions[i + 2]});
  mesh.triangles = torus.triangles;
  const std::string in = (folder.path / "torus.ply").string(), out = (folder.path / "quads.obj").string(),
                    strokes = (folder.path / "strokes.json").string();
  write_mesh_file(mesh, in);
  double top = 0, ring = 0;
  for (const glm::dvec3& p : mesh.positions) {
    top = std::max(top, p.y);
    ring = std::max(ring, std::hypot(p.x, p.z));
  }
  ring -= top;
  std::ofstream(strokes) << "{\"strokes\": [{\"points\": [[" << 0.75 * ring << ", " << top << ", " << -0.45 * ring
                         << "], [" << 1.0 * ring << ", " << top << ", " << 0.0 << "], [" << 0.95 * ring << ", " << top
                         << ", " << 0.5 * ring << "]], \"weight\": 0.8}]}";
  const std::string call = "\"" + in + "\" --faces 1500 --symmetry x -o \"" + out + "\"";
  std::string text;
  std::vector<glm::dvec3> plain;
  for (const bool guided : {false, true}) {
    ASSERT_EQ(run(call + (guided ? " --strokes \"" + strokes + "\"" : ""), text), 0) << text;
    EXPECT_NE(text.find("Euler characteristic 0 (surface 0)"), std::string::npos) << text;
    const SurfaceMesh back = read_mesh_file(out);
    size_t images = 0;
    for (const glm::dvec3& p : back.positions) {
      for (const glm::dvec3& q : back.positions) images += glm::distance(q, {-p.x, p.y, p.z}) < 1e-6;
    }
    EXPECT_EQ(images, back.positions.size());
    if (guided) {
      EXPECT_TRUE(back.positions.size() != plain.size() || back.positions != plain) << "the stroke changed nothing";
    }
    plain = back.positions;
  }
  // another place of the plane, where nothing mirrors
  EXPECT_EQ(run("\"" + in + "\" --faces 500 --symmetry x=0.8", text), 1);
  EXPECT_NE(text.find("not symmetric"), std::string::npos) << text;
  for (const char* wrong : {"w", "x=", "x=1e", "xx"}) {
    EXPECT_EQ(run("\"" + in + "\" --symmetry " + wrong, text), 1) << wrong;
    EXPECT_NE(text.find("--symmetry takes"), std::string::npos) << text;
  }
  for (const char* wrong :
       {"{\"strokes\": []}", "{\"strokes\": [{\"points\": [[0, 0, 0]]}]}",
        "{\"strokes\": [{\"points\": [[0, 0, 0], [0, 0, 0]]}]}", "{\"strokes\": [{\"points\": [[0, 0], [1, 0, 0]]}]}",
        "{\"strokes\": [{\"points\": [[0, 0, 0], [1, 0, 0]], \"weight\": 2}]}",
        "{\"strokes\": [{\"points\": [[0, 0, 0], [1e9, 0, 0]]}]}"}) {
    std::ofstream(strokes) << wrong;
    EXPECT_EQ(run("\"" + in + "\" --strokes \"" + strokes + "\"", text), 1) << wrong;
    EXPECT_NE(text.find("strokes"), std::string::npos) << text;
  }
}

// The least distance of an irregular vertex of that many edges to a place.
double nearest_pole(const SurfaceMesh& mesh, const glm::dvec3& place, uint32_t quads) {
  std::vector<uint32_t> count(mesh.positions.size());
  for (const uint32_t corner : mesh.face_vertices) ++count[corner];
  double least = 1e9;
  for (size_t v = 0; v < count.size(); ++v) {
    if (count[v] == quads) least = std::min(least, glm::distance(mesh.positions[v], place));
  }
  return least;
}

TEST(QuadsProgram, PutsPolesWhereAFileSays) {
  const TemporaryFolder folder;
  const ShapeMesh shape = samples::sphere(20);
  SurfaceMesh mesh;
  for (size_t i = 0; i < shape.positions.size(); i += 3)
    mesh.positions.push_back({shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]});
  mesh.triangles = shape.triangles;
  const std::string in = (folder.path / "shape.ply").string(), out = (folder.path / "quads.obj").string(),
                    poles = (folder.path / "irregular.json").string();
  write_mesh_file(mesh, in);
  const glm::dvec3 three = mesh.positions[1200], five = mesh.positions[2700];
  const auto text_of = [](const glm::dvec3& p) {
    return "[" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + "]";
  };
  std::ofstream(poles) << "{\"irregular\": [{\"point\": " << text_of(three)
                       << ", \"valence\": 3, \"direction\": [0.2, 1, 0.1]}, {\"point\": " << text_of(five)
                       << ", \"valence\": 5}]}";
  const std::string call = "\"" + in + "\" --faces 1500 -o \"" + out + "\"";
  std::string text;
  ASSERT_EQ(run(call, text), 0) << text;
  const SurfaceMesh plain = read_mesh_file(out);
  double edge = 0;
  for (size_t i = 0; i < plain.face_vertices.size(); ++i)
    edge += glm::distance(plain.positions[plain.face_vertices[i]],
                          plain.positions[plain.face_vertices[i % 4 == 3 ? i - 3 : i + 1]]);
  edge /= static_cast<double>(plain.face_vertices.size());
  EXPECT_GT(nearest_pole(plain, three, 3), 2 * edge);
  EXPECT_GT(nearest_pole(plain, five, 5), 2 * edge);
  ASSERT_EQ(run(call + " --irregular \"" + poles + "\"", text), 0) << text;
  EXPECT_NE(text.find("Euler characteristic 2 (surface 2)"), std::string::npos) << text;
  const SurfaceMesh placed = read_mesh_file(out);
  EXPECT_LT(nearest_pole(placed, three, 3), edge);
  EXPECT_LT(nearest_pole(placed, five, 5), edge);
  // the file and the entry are named
  const std::pair<const char*, const char*> wrongs[] = {
      {"{\"irregular\": []}", "no irregular vertex"},
      {"{\"pole\": []}", "pole"},
      {"{\"irregular\": [{\"point\": [0, 0, 0]}]}", "irregular[0]: the key \"valence\""},
      {"{\"irregular\": [{\"valence\": 3}]}", "irregular[0]: the key \"point\""},
      {"{\"irregular\": [{\"point\": [0, 0], \"valence\": 3}]}", "irregular[0].point"},
      {"{\"irregular\": [{\"point\": [0, 0, 0], \"valence\": 3}, {\"point\": [0, 0, 0], \"valence\": 4}]}",
       "irregular[1].valence"},
      {"{\"irregular\": [{\"point\": [0, 0, 0], \"valence\": 3.5}]}", "irregular[0].valence"},
      {"{\"irregular\": [{\"point\": [0, 0, 0], \"valence\": 3, \"direction\": [0, 0, 0]}]}", "irregular[0].direction"},
      {"{\"irregular\": [{\"point\": [0, 0, 0], \"valence\": 3, \"weight\": 1}]}", "irregular[0]: the key \"weight\""}};
  for (const auto& [wrong, entry] : wrongs) {
    std::ofstream(poles) << wrong;
    EXPECT_EQ(run("\"" + in + "\" --irregular \"" + poles + "\"", text), 1) << wrong;
    EXPECT_NE(text.find("irregular.json"), std::string::npos) << text;
    EXPECT_NE(text.find(entry, text.find("irregular.json") + 10), std::string::npos) << text;
  }
}

// The longest side of a triangle in texture coordinates over its length in space.
double most_stretched(const Model& model, const FlatMesh& flat) {
  double most = 0;
  for (const FlatPart& part : flat.parts) {
    const Primitive& p = model.meshes[static_cast<size_t>(model.nodes[static_cast<size_t>(part.node)].mesh)]
                             .primitives[static_cast<size_t>(part.primitive)];
    for (size_t i = 0; i < p.indices.size(); ++i) {
      const uint32_t a = p.indices[i], b = p.indices[i % 3 == 2 ? i - 2 : i + 1];
      const double length = glm::distance(flat.positions[part.first_vertex + a], flat.positions[part.first_vertex + b]);
      if (length > 0) most = std::max(most, glm::distance(p.texcoords[0][a], p.texcoords[0][b]) / length);
    }
  }
  return most;
}

// A model, and its quads as hf_quads writes them, read back.
struct Remade {
  Remade(const Model& model, uint32_t faces) {
    const TemporaryFolder folder;
    const fs::path in = folder.path / "in.glb", out = folder.path / "out.glb";
    write_gltf(model, in);
    const int code =
        run("\"" + in.string() + "\" --faces " + std::to_string(faces) + " -o \"" + out.string() + "\"", text);
    EXPECT_EQ(code, 0) << text;
    if (code != 0) return;
    before = read_gltf(in);
    after = read_gltf(out);
    old_flat = flatten(before);
    flat = flatten(after);
    // Each vertex of the quads lies on a triangle of the model.
    const SharedSoup soup{&old_flat.positions, old_flat.triangles};
    const NearestPoint nearest(soup);
    triangle.resize(flat.vertex_count());
    weights.resize(flat.vertex_count());
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (uint32_t v = 0; v < flat.vertex_count(); ++v) {
      nearest.distance(flat.positions[v], &triangle[v]);
      const uint32_t* c = &old_flat.triangles[3 * size_t{triangle[v]}];
      const glm::dvec3 a = old_flat.positions[c[0]], x = old_flat.positions[c[1]] - a, y = old_flat.positions[c[2]] - a,
                       d = flat.positions[v] - a;
      const double xx = dot(x, x), xy = dot(x, y), yy = dot(y, y), area = xx * yy - xy * xy;
      const double s = (yy * dot(d, x) - xy * dot(d, y)) / area, t = (xx * dot(d, y) - xy * dot(d, x)) / area;
      weights[v] = {1 - s - t, s, t};
      low = glm::min(low, flat.positions[v]);
      high = glm::max(high, flat.positions[v]);
    }
    size = glm::distance(low, high);
  }
  // How far the vertices are from where their triangles are, in the mean and at most, and how far seams open; over
  // size.
  struct Apart {
    double mean, most, opened;
  };
  Apart compare(const std::vector<glm::dvec3>& was, const std::vector<glm::dvec3>& is) const {
    Apart out{0, 0, 0};
    std::vector<glm::dvec3> of_weld(flat.welded_count, glm::dvec3(NAN));
    for (uint32_t v = 0; v < flat.vertex_count(); ++v) {
      const uint32_t* c = &old_flat.triangles[3 * size_t{triangle[v]}];
      const glm::dvec3 at = weights[v].x * was[c[0]] + weights[v].y * was[c[1]] + weights[v].z * was[c[2]];
      out.most = std::max(out.most, glm::distance(at, is[v]) / size);
      out.mean += glm::distance(at, is[v]) / size;
      glm::dvec3& first = of_weld[flat.welded[v]];
      if (std::isnan(first.x)) first = is[v];
      out.opened = std::max(out.opened, glm::distance(first, is[v]) / size);
    }
    out.mean /= flat.vertex_count();
    return out;
  }

  std::string text;
  Model before, after;
  FlatMesh old_flat, flat;
  std::vector<uint32_t> triangle;
  std::vector<glm::dvec3> weights;
  double size = 1;
};

// A horse as quads: it walks as before, no seam of its texture opens, and no quad is painted across a seam.
TEST(QuadsProgram, AModelKeepsItsMotionAndLook) {
  const Remade horse(to_model(hf_test::creature("horse", 6000)), 2500);
  ASSERT_EQ(horse.after.skins.size(), 1u) << horse.text;
  EXPECT_EQ(horse.after.skins[0].joints, horse.before.skins[0].joints);
  ASSERT_EQ(horse.after.animations.size(), horse.before.animations.size());
  ASSERT_GT(horse.flat.vertex_count(), horse.flat.welded_count) << "the seams of the texture";

  // Fans: as many as faces were said to be.
  size_t faces = 0;
  for (const FlatPart& part : horse.flat.parts) {
    const Primitive& p =
        horse.after.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    EXPECT_EQ(p.carried.extensions, "{\"FB_ngon_encoding\":{}}");
    for (size_t i = 0; i < p.indices.size(); i += 3) faces += i == 0 || p.indices[i] != p.indices[i - 3];
  }
  EXPECT_NE(horse.text.find(" " + std::to_string(faces) + " faces in "), std::string::npos) << faces << horse.text;

  for (size_t clip = 0; clip < horse.before.animations.size(); ++clip) {
    for (const double time : {0.2, 0.5, 0.9}) {
      const Remade::Apart apart =
          horse.compare(posed_positions(horse.before, horse.old_flat, horse.before.animations[clip], time),
                        posed_positions(horse.after, horse.flat, horse.after.animations[clip], time));
      EXPECT_LT(apart.opened, 1e-6) << horse.before.animations[clip].name;
      EXPECT_LT(apart.mean, 0.002) << horse.before.animations[clip].name;
      EXPECT_LT(apart.most, 0.02) << horse.before.animations[clip].name;
    }
  }
  EXPECT_LT(most_stretched(horse.after, horse.flat), 2 * most_stretched(horse.before, horse.old_flat));
}

// Tangents lie along the quads. Numbers of a host's own come from the nearest corner: a mean of two is neither.
TEST(QuadsProgram, TangentsAndNumbersOfTheHostStay) {
  constexpr uint32_t side = 24;
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;
  for (uint32_t i = 0; i <= side; ++i) {
    for (uint32_t j = 0; j <= side; ++j) {
      positions.emplace_back(1.0 * i / side, 1.0 * j / side, 0.1 * std::sin(4.0 * i / side));
      const uint32_t v = i * (side + 1) + j;
      if (i < side && j < side)
        triangles.insert(triangles.end(), {v, v + side + 1, v + 1, v + 1, v + side + 1, v + side + 2});
    }
  }
  Model model = make_model("sheet", positions, triangles);
  Primitive& p = model.meshes[0].primitives[0];
  CarriedNumbers ids;
  ids.component = 5121;
  ids.type = 1;
  ids.count = positions.size();
  for (const glm::dvec3& at : positions) {
    p.tangents.emplace_back(1, 0, 0, -1);
    ids.bytes.push_back(std::lround(side * at.x) % 2 == 0 ? 10 : 200);
  }
  p.carried_attributes.emplace_back("_ID", ids);
  const Remade sheet(model, 200);
  ASSERT_FALSE(sheet.after.meshes.empty()) << sheet.text;
  const Primitive& quads = sheet.after.meshes[0].primitives[0];
  ASSERT_EQ(quads.tangents.size(), quads.positions.size());
  ASSERT_EQ(quads.carried_attributes.size(), 1u);
  const CarriedNumbers& out = quads.carried_attributes[0].second;
  ASSERT_EQ(out.bytes.size(), quads.positions.size());
  int near_column = 0;
  for (size_t v = 0; v < quads.positions.size(); ++v) {
    EXPECT_NEAR(glm::dot(glm::vec3(quads.tangents[v]), quads.normals[v]), 0, 1e-5f) << v;
    EXPECT_NEAR(quads.tangents[v].y, 0, 0.02f) << v;
    EXPECT_EQ(quads.tangents[v].w, -1);
    // corners of one column have one number, those of the next the other; near a column its own counts
    EXPECT_TRUE(out.bytes[v] == 10 || out.bytes[v] == 200) << v;
    const float place = side * quads.positions[v].x;
    const long column = std::lround(place);
    if (std::abs(place - static_cast<float>(column)) < 0.25f) {
      EXPECT_EQ(out.bytes[v], column % 2 == 0 ? 10 : 200) << v;
      ++near_column;
    }
  }
  EXPECT_GT(near_column, 50);
}

// A face as quads: each of its 52 shapes moves it as before.
TEST(QuadsProgram, AFaceKeepsItsShapes) {
  const Remade face(to_model(make_face(80, 60, false), "face", true), 4000);
  const auto posed = [](const Model& model, const FlatMesh& flat, size_t shape) {
    Pose pose = rest_pose(model);
    for (NodePose& node : pose) {
      if (shape < node.weights.size()) node.weights[shape] = 1;
    }
    return posed_positions(model, flat, pose);
  };
  ASSERT_FALSE(face.after.meshes.empty()) << face.text;
  ASSERT_EQ(face.after.meshes[0].target_names, face.before.meshes[0].target_names);
  ASSERT_EQ(face.after.meshes[0].target_names.size(), 52u);
  double moved = 0;
  for (size_t shape = 0; shape < 52; ++shape) {
    const auto was = posed(face.before, face.old_flat, shape);
    const Remade::Apart apart = face.compare(was, posed(face.after, face.flat, shape));
    EXPECT_LT(apart.most, 1e-5) << shape;  // shapes are linear, and single precision
    for (size_t v = 0; v < was.size(); ++v)
      moved = std::max(moved, glm::distance(was[v], face.old_flat.positions[v]) / face.size);
  }
  EXPECT_GT(moved, 0.02) << "shapes that move nothing prove nothing";
}

}  // namespace
