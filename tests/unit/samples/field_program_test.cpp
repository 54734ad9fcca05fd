// hf_field run as a user runs it: every kind of field on generated surfaces, its text, glb and picture read back, the
// glb under the Khronos validator where that is there; and on every mesh of the shared data in the long form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "assets/shapes.h"
#include "common/limits.h"
#include "common/mesh_file.h"
#include "gltf/gltf_read.h"
#include "support/creature.h"
#include "support/full.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using namespace hf_gltf;
using samples_test::TemporaryFolder;

struct Result {
  int status = -1;
  std::string output;
};

Result run(const std::string& arguments) {
  Result result;
  result.status = hf_test::run(hf_test::quoted(HF_FIELD_PROGRAM) + " " + arguments, result.output);
  return result;
}

SurfaceMesh surface(const ShapeMesh& shape) {
  SurfaceMesh mesh;
  for (size_t i = 0; i < shape.positions.size(); i += 3)
    mesh.positions.push_back({shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]});
  mesh.triangles = shape.triangles;
  return mesh;
}

std::vector<std::vector<double>> rows_of(const fs::path& file) {
  std::vector<std::vector<double>> rows;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (double value; words >> value;) rows.back().push_back(value);
  }
  return rows;
}

// Line primitives of a written file, as segment ends.
std::vector<glm::dvec3> segments_of(const fs::path& file) {
  const Model model = read_gltf(file);
  std::vector<glm::dvec3> ends;
  for (const MeshData& mesh : model.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.topology != Topology::lines) continue;
      for (const uint32_t i : primitive.indices) ends.push_back(glm::dvec3(primitive.positions[i]));
    }
  }
  return ends;
}

std::string modules() {
  const char* given = std::getenv("HF_NODE_MODULES");
  for (const fs::path& place : {fs::path(given ? given : ""), fs::path(HF_BUILD_DIR "/npm/node_modules")}) {
    if (!place.empty() && fs::is_directory(place / "gltf-validator")) return place.string();
  }
  return {};
}

TEST(FieldProgram, output_follows_links_and_leaves_devices_alone) {
  TemporaryFolder folder;
  const fs::path mesh_file = folder.path / "cactus.obj", out = folder.path / "field.txt";
  write_mesh_file(surface(hf_test::cactus(600)), mesh_file);
  const auto written = [&](const std::string& name) {
    return run(hf_test::quoted(mesh_file) + " --site 0=0 --site 9=1 --out " + hf_test::quoted(folder.path / name));
  };
  samples_test::write_text(out, "old");
  fs::permissions(out, fs::perms(0600));
  fs::create_symlink("field.txt", folder.path / "link");
  fs::create_symlink("/dev/full", folder.path / "full");
  fs::create_symlink("/dev/null", folder.path / "null");
  EXPECT_EQ(written("link").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_GT(rows_of(out).size(), 100u);
  EXPECT_EQ(fs::status(out).permissions(), fs::perms(0600));
  const Result full = written("full");
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.output.find("full: cannot be written: No space left"), std::string::npos) << full.output;
  EXPECT_EQ(written("null").status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/full") && fs::is_character_file("/dev/null"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 5);
}

TEST(FieldProgram, writes_every_kind_of_field_as_text_glb_and_picture) {
  TemporaryFolder folder;
  const fs::path mesh_file = folder.path / "cactus.obj", glbs = folder.path / "glb";
  fs::create_directory(glbs);
  const SurfaceMesh mesh = surface(hf_test::cactus(2500));
  write_mesh_file(mesh, mesh_file);
  const struct {
    const char *kind, *more;
    size_t components;
  } kinds[] = {{"harmonic", "--isolines 12 --levels length --critical-points", 1},
               {"biharmonic", "--isolines 5 --levels area", 1},
               {"vector", "", 3},
               {"direction", "", 3}};
  for (const auto& kind : kinds) {
    const fs::path base = folder.path / kind.kind, glb = glbs / (std::string(kind.kind) + ".glb");
    const Result result = run(hf_test::quoted(mesh_file) + " --kind " + kind.kind + " --extremities " + kind.more +
                              " --out " + hf_test::quoted(base.string() + ".txt") + " --glb " + hf_test::quoted(glb) +
                              " --png " + hf_test::quoted(base.string() + ".png"));
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("extremities 4"), std::string::npos) << result.output;
    const auto rows = rows_of(base.string() + ".txt");
    ASSERT_EQ(rows.size(), mesh.positions.size());
    for (const auto& row : rows) {
      ASSERT_EQ(row.size(), kind.components);
      for (const double value : row) ASSERT_TRUE(std::isfinite(value));
    }
    const std::vector<glm::dvec3> ends = segments_of(glb);
    EXPECT_GT(ends.size(), 200u) << kind.kind;
    EXPECT_GT(fs::file_size(base.string() + ".png"), 20000u);
    if (std::string(kind.kind) == "harmonic") {
      EXPECT_NE(result.output.find("indices sum to 2, Euler characteristic 2"), std::string::npos) << result.output;
    }
    if (std::string(kind.kind) == "direction") {
      EXPECT_NE(result.output.find("indices sum to 2"), std::string::npos) << result.output;
    }
  }
  const std::string validator = modules();
  if (validator.empty()) {
    std::printf("npm's gltf-validator is not there (HF_NODE_MODULES): the glb files are not validated\n");
    return;
  }
  const std::string command = "node \"" HF_SOURCE_DIR "/tests/unit/gltf/validate.mjs\" \"" + validator + "\" " +
                              hf_test::quoted(glbs) + " > " + hf_test::quoted(folder.path / "report.txt") + " 2>&1";
  std::ifstream report(folder.path / "report.txt");
  EXPECT_EQ(std::system(command.c_str()), 0) << std::string(std::istreambuf_iterator<char>(report), {});
}

// Two bodies, a site on one: the other is said and hatched in two greys, whatever the kind of field.
TEST(FieldProgram, hatches_what_no_site_reaches) {
  TemporaryFolder folder;
  const fs::path mesh_file = folder.path / "two.obj", glb = folder.path / "two.glb";
  SurfaceMesh mesh = surface(sphere(8));
  const auto count = static_cast<uint32_t>(mesh.positions.size());
  const std::vector<uint32_t> first = mesh.triangles;
  for (uint32_t v = 0; v < count; ++v) mesh.positions.push_back(mesh.positions[v] + glm::dvec3(5, 0, 0));
  for (const uint32_t v : first) mesh.triangles.push_back(v + count);
  mesh.normals.clear();
  write_mesh_file(mesh, mesh_file);
  for (const std::string kind :
       {"harmonic --site 0=1", "biharmonic --site 0=1", "vector --site 0=0,1,0", "direction --site 0=1,0.5,0"}) {
    const Result result =
        run(hf_test::quoted(mesh_file) + " --no-links --kind " + kind + " --glb " + hf_test::quoted(glb));
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find(std::to_string(count) + " vertices are reached by no site"), std::string::npos)
        << kind << result.output;
    const Model model = read_gltf(glb);
    std::set<float> greys[2];
    for (const MeshData& data : model.meshes) {
      for (const Primitive& primitive : data.primitives) {
        for (size_t v = 0; v < primitive.colors.size(); ++v) {
          const glm::vec4& c = primitive.colors[v];
          if (c.r == c.g && c.g == c.b) greys[primitive.positions[v].x > 2.5f].insert(c.r);
        }
      }
    }
    EXPECT_EQ(greys[0].size(), 0u) << kind;
    EXPECT_EQ(greys[1].size(), 2u) << kind;
  }
}

TEST(FieldProgram, draws_iso_lines_that_lie_on_their_levels) {
  TemporaryFolder folder;
  const fs::path mesh_file = folder.path / "cylinder.obj", glb = folder.path / "lines.glb";
  const SurfaceMesh mesh = surface(cylinder(6, 40));
  write_mesh_file(mesh, mesh_file);
  uint32_t top = 0, bottom = 0;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].y > mesh.positions[top].y) top = v;
    if (mesh.positions[v].y < mesh.positions[bottom].y) bottom = v;
  }
  const Result result = run(hf_test::quoted(mesh_file) + " --site " + std::to_string(top) + "=1 --site " +
                            std::to_string(bottom) + "=0 --isolines 7 --levels length --glb " + hf_test::quoted(glb));
  ASSERT_EQ(result.status, 0) << result.output;
  const std::vector<glm::dvec3> ends = segments_of(glb);
  ASSERT_FALSE(ends.empty());
  // closed lines: every point ends as many segments as it starts, so the segments add up to nothing
  glm::dvec3 sum(0);
  for (size_t i = 0; i + 1 < ends.size(); i += 2) sum += ends[i + 1] - ends[i];
  EXPECT_LT(glm::length(sum), 1e-4);
  for (const glm::dvec3& p : ends) EXPECT_LT(std::hypot(p.x, p.z), 0.501);
}

TEST(FieldProgram, refuses_what_does_not_fit_together_with_a_sentence) {
  TemporaryFolder folder;
  const fs::path mesh_file = folder.path / "sphere.obj";
  write_mesh_file(surface(sphere(6)), mesh_file);
  const struct {
    const char *arguments, *says;
  } cases[] = {{"", "no sites given"},
               {"--site 0=1,2", "must be three numbers"},
               {"--site 0=1,0,0", "takes one"},
               {"--kind vector --site 0=1", "takes vectors"},
               {"--kind vector --site 0=1,0,0 --isolines 5", "scalar field"},
               {"--kind tensor --site 0=1", "is none of harmonic"},
               {"--levels width --site 0=1", "is none of value"},
               {"--site 0=1 --isolines 99999", "--isolines must be"},
               {"--site 9999=1", "hf_add_sites"},
               {"--kind direction --site 5:1,0,0=1,0,0", "lie at vertices"},
               {"--sheet", "--sheet needs"}};
  for (const auto& row : cases) {
    const Result result = run(hf_test::quoted(mesh_file) + " " + row.arguments);
    EXPECT_EQ(result.status, 1) << row.arguments;
    EXPECT_NE(result.output.find(row.says), std::string::npos) << row.arguments << ": " << result.output;
  }
  const auto script = [&](const std::string& text) {
    samples_test::write_text(folder.path / "edits.txt", text);
    return run(hf_test::quoted(mesh_file) + " --site 0=1 --script " + hf_test::quoted(folder.path / "edits.txt"))
        .output;
  };
  EXPECT_NE(script("\xef\xbb\xbf add\n").find("edits.txt:1: no place given"), std::string::npos);
  EXPECT_NE(script("\xff\xfe# add\n").find("the text is UTF-16; save it as UTF-8"), std::string::npos);
}

TEST(FieldProgram, refuses_a_soup_by_its_size_and_names_the_option_that_lets_it_through) {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "soup.off";
  constexpr uint32_t vertices = 3500, triangles = 20000;
  uint32_t random = 1;
  const auto below = [&](uint32_t most) { return (random = random * 1664525u + 1013904223u, (random >> 8) % most); };
  {
    std::ofstream out(file);
    out << "OFF\n" << vertices << " " << triangles << " 0\n";
    for (uint32_t v = 0; v < vertices; ++v) out << below(1000) << " " << below(1000) << " " << below(1000) << "\n";
    for (uint32_t t = 0; t < triangles; ++t)
      out << "3 " << below(vertices) << " " << below(vertices) << " " << below(vertices) << "\n";
  }
  const auto field = [&](const std::string& options) {
    return run(hf_test::quoted(file) + " --site 0=1 --out " + hf_test::quoted(folder.path / "field.txt") + options);
  };
  const auto says = [](const Result& result, const std::string& text) {
    EXPECT_EQ(result.status, 1) << result.output;
    EXPECT_NE(result.output.find(text), std::string::npos) << result.output;
  };
  const Result refused = field("");
  says(refused, "the work_limit_gflop is 4");
  says(refused, "--work-limit N raises it");
  EXPECT_FALSE(fs::exists(folder.path / "field.txt"));
  says(field(" --work-limit 100 --memory-limit 20"), "--memory-limit N raises it");
  says(field(" --work-limit 0"), "--work-limit takes a number");
  EXPECT_EQ(field(" --work-limit 100").status, 0);
}

TEST(Limits, let_sound_meshes_through_by_the_size_that_triangles_give_them) {
  const auto limits = [](uint32_t vertices, uint32_t triangles) {
    auto desc = hf_surface_desc();
    desc.positions.count = vertices;
    desc.triangles.count = triangles;
    limit_surface(desc);
    return std::pair<uint32_t, uint32_t>(desc.work_limit_gflop, desc.memory_limit_mb);
  };
  EXPECT_EQ(limits(4, 4), std::make_pair(4u, 129u));
  EXPECT_EQ(limits(1000000, 200), limits(200, 200));     // vertices that no triangle names
  EXPECT_EQ(limits(400000, 868000).first, 3200u);        // 20 n^2; a lattice of struts takes 278, bi-harmonic 2,688
  EXPECT_EQ(limits(20000000, 40000000).first, 100000u);  // 4 * 10^12 operations are needed
  EXPECT_GT(limits(400000, 868000).second, 19 * 400000u / 1024);
  auto faces = hf_surface_desc();
  auto polygons = hf_faces_desc();
  faces.positions.count = 90000;
  polygons.sizes.count = 45000;
  polygons.corners.count = 180000;
  faces.faces = &polygons;
  limit_surface(faces);
  EXPECT_EQ(faces.work_limit_gflop, 162u);
}

// A surface of many holes makes many whole numbers. The sizes are those of a cheese of genus 133 that takes 650 MiB.
TEST(Limits, of_quads_know_the_genus_and_stay_bounded) {
  const auto memory = [](uint32_t vertices, uint32_t triangles, bool quads) {
    auto desc = hf_surface_desc();
    desc.positions.count = vertices;
    desc.triangles.count = triangles;
    if (quads) {
      limit_quads(desc, 0);
    } else {
      limit_surface(desc);
    }
    return desc.memory_limit_mb;
  };
  EXPECT_EQ(memory(10000, 19996, true), memory(10000, 19996, false));  // a sphere
  EXPECT_EQ(memory(10000, 15000, true), memory(10000, 15000, false));  // one with a border
  EXPECT_GT(memory(8629, 17786, true), 700u);
  EXPECT_LE(memory(30000, 200000, true), 3 * memory(30000, 200000, false));  // triangles at random
}

TEST(FieldProgram, is_finite_with_every_kind_of_field_on_every_mesh) {
  TemporaryFolder folder;
  std::string list;
  const char* given = std::getenv("HF_SHARED_DATA");
  const fs::path shared = (given ? fs::path(given) : fs::path(HF_SOURCE_DIR) / "../shared/data") / "meshes";
  if (!fs::is_directory(shared)) GTEST_SKIP() << shared << " is not there";
  const bool full = hf_test::is_full();
  for (const auto& entry : fs::directory_iterator(shared)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".obj" && extension != ".off" && extension != ".ply") continue;
    // the short form leaves the large scans out
    if (full || entry.file_size() < 110000) list += " " + hf_test::quoted(entry.path());
  }
  const Result result = run("--png " + hf_test::quoted(folder.path / "sheet") + " --sheet" + list);
  EXPECT_EQ(result.status, 0) << result.output;
  for (const char* kind : {"harmonic", "biharmonic", "vector", "direction", "isolines", "critical"})
    EXPECT_TRUE(fs::exists(folder.path / (std::string("sheet_") + kind + ".png"))) << kind;
}

}  // namespace
