// The corpus: generated bodies, and models of the shared data where they are.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "assets/creature.h"
#include "assets/face.h"
#include "assets/shapes.h"
#include "body.h"
#include "common/mesh_file.h"
#include "support/creature.h"

namespace invariance {
namespace {

Body made(const std::string& name, const samples::ShapeMesh& mesh) {
  return make_body(name, mesh.positions, mesh.triangles);
}

Body creature(const std::string& name, std::uint32_t vertices) {
  return made(name, samples::welded_surface(hf_test::creature(name, vertices)));
}

// A sphere among five smaller ones that touch nothing: a body of pieces.
samples::ShapeMesh beads() {
  samples::ShapeMesh out = samples::sphere(6);
  const double places[][4] = {{1.25, 0.1, 0, 0.2},
                              {-1.26, 0.3, 0.1, 0.21},
                              {0.1, 1.3, 0.2, 0.25},
                              {0.2, -0.1, 1.24, 0.19},
                              {0.9, 1.05, 0.1, 0.15}};
  for (const auto& place : places) {
    const samples::ShapeMesh bead = samples::sphere(3);
    const std::uint32_t base = out.vertex_count();
    for (std::size_t i = 0; i < bead.positions.size(); ++i)
      out.positions.push_back(place[i % 3] + place[3] * bead.positions[i]);
    for (const std::uint32_t v : bead.triangles) out.triangles.push_back(base + v);
  }
  return out;
}

// Every vertex by a hundredth of an edge off, so that no two parts are alike.
samples::ShapeMesh uneven(samples::ShapeMesh mesh, double share) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] += share * (samples::hash_to_unit(3, i) - 0.5);
  return mesh;
}

// Many models have parts that are alike, left and right, and rounding chooses between their answers. A body has none:
// each coordinate is moved by up to a thousandth of an edge.
Body uneven_body(const Body& body) {
  double edge = 0;
  for (const auto& t : body.triangles) edge += length(body.points[t[1]] - body.points[t[0]]);
  edge /= static_cast<double>(body.triangles.size());
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
  for (const Vec& p : body.points) {
    for (const double x : p) xyz.push_back(x + 2e-3 * edge * (samples::hash_to_unit(5, xyz.size()) - 0.5));
  }
  for (const auto& t : body.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  return make_body(body.name, xyz, triangles);
}

void add_made(std::vector<Body>& out, bool full) {
  out.push_back(creature("horse", full ? 900 : 500));
  out.push_back(made("torus", samples::jittered_torus(26, 15)));
  out.push_back(made("beads", uneven(beads(), 0.01)));
  out.push_back(made("bumpy plane", uneven(samples::bumpy_plane(17, 19), 0.01)));
  if (!full) return;
  out.push_back(creature("bull", 900));
  out.push_back(creature("biped", 900));
  out.push_back(made("cactus", hf_test::cactus(700)));
  out.push_back(made("sphere", uneven(samples::sphere(8), 0.02)));
  out.push_back(made("box", uneven(samples::box(1, 2, 0.7, 6, 12, 4), 0.01)));
  out.push_back(made("bar", uneven(samples::bar(5), 0.01)));
  out.push_back(made("cylinder", uneven(samples::cylinder(4, 20), 0.01)));
  out.push_back(uneven_body(made("face", samples::make_face(40, 30, false).mesh)));
}

// Sound ones of a few hundred to 7,000 vertices.
const char* const shared_models[] = {"gltf/khr_Fox.glb",
                                     "meshes/cgal_eight.off",  // the quick form has these two
                                     "gltf/CesiumMan.glb",
                                     "gltf/RiggedFigure.glb",
                                     "gltf/Duck.glb",
                                     "gltf/q_Spider.glb",
                                     "gltf/pirate.glb",
                                     "gltf/kenney.glb",
                                     "gltf/RobotExpressive.glb",
                                     "gltf/q_Cow.glb",
                                     "gltf/q_Fox.glb",
                                     "gltf/q_Horse.glb",
                                     "gltf/q_Husky.glb",
                                     "gltf/q_Frog.glb",
                                     "gltf/q_Trex.glb",
                                     "gltf/q_Manta_ray.glb",
                                     "gltf/q_Man_Casual.glb",
                                     "meshes/cgal_double-torus-example.off",
                                     "meshes/cgal_oblong.off",
                                     "meshes/cgal_mpi_triang.off",
                                     "meshes/cgal_bones.off",
                                     "meshes/cgal_knot1.off",
                                     "meshes/cgal_elephant.off",
                                     "meshes/cgal_triceratops.off",
                                     "meshes/goathead.obj",
                                     "meshes/koala_low_resolution.obj",
                                     "meshes/wingnut.obj",
                                     "meshes/bunny_6k_adaptive.off",
                                     "gltf/alien.glb"};  // of cubes: an edge of four triangles
constexpr std::size_t quick_models = 2;

Body read_body(const std::filesystem::path& file) {
  const samples::SurfaceMesh mesh = samples::read_mesh_file(file);
  std::vector<double> xyz;
  for (const auto& p : mesh.positions) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  return uneven_body(make_body(file.stem().string(), xyz, mesh.triangles));
}

}  // namespace

Body body_of_file(const std::string& file) { return read_body(file); }

std::vector<Body> corpus(bool full) {
  std::vector<Body> out;
  add_made(out, full);
  const char* given = std::getenv("HF_SHARED_DATA");
  const std::filesystem::path folder =
      given ? std::filesystem::path(given) : std::filesystem::path(HF_SOURCE_DIR) / ".." / "shared" / "data";
  std::size_t count = 0, missing = 0;
  for (const char* name : shared_models) {
    if (!full && count++ == quick_models) break;
    const std::filesystem::path file = folder / name;
    if (!std::filesystem::exists(file)) {
      ++missing;
      continue;
    }
    out.push_back(read_body(file));
  }
  if (missing > 0) std::printf("skipped: %zu models of %s that are not here\n", missing, folder.string().c_str());
  return out;
}

}  // namespace invariance
