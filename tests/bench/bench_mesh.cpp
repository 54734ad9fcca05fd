#include "bench/bench_mesh.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "assets/creature.h"
#include "assets/creature_design.h"
#include "assets/even_mesh.h"
#include "assets/shapes.h"
#include "common/mesh_file.h"

namespace bench {
namespace {

using Key = std::pair<Family, std::pair<uint32_t, uint32_t>>;

// One mesh per family and size: a creature of 300,000 vertices takes seconds to make.
std::shared_ptr<const Mesh> stored(Family family, uint32_t nu, uint32_t nv) {
  static std::mutex mutex;
  static std::map<Key, std::shared_ptr<const Mesh>> store;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<const Mesh>& mesh = store[{family, {nu, nv}}];
  if (mesh) return mesh;
  samples::ShapeMesh shape = family == Family::torus
                                 ? samples::jittered_torus(nu, nv)
                                 : samples::welded_surface(samples::make_creature("horse", nu * nv));
  const std::string thousands = std::to_string(std::lround(shape.vertex_count() / 1000.0));
  mesh = std::make_shared<Mesh>(
      Mesh{thousands + "K_" + family_name(family), std::move(shape.positions), std::move(shape.triangles)});
  return mesh;
}

}  // namespace

const char* family_name(Family family) { return family == Family::torus ? "torus" : "creature"; }

std::shared_ptr<const Mesh> make_mesh(Family family, Size size, bool small) {
  if (small) return stored(family, 52, 53);
  switch (size) {
    case Size::k42:
      return stored(family, 205, 206);
    case Size::k84:
      return stored(family, 290, 290);
    case Size::k173:
      return stored(family, 416, 416);
    case Size::k304:
      break;
  }
  return stored(family, 551, 552);
}

std::shared_ptr<const Mesh> make_mesh(Family family, uint32_t vertices) {
  const uint32_t side = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(vertices))));
  return stored(family, side, side);
}

std::shared_ptr<const Mesh> make_scan(uint32_t vertices) {
  const samples::Design horse = samples::design_horse();
  // the number of vertices grows with the inverse square of the spacing
  double spacing = 0.02;
  samples::TriangleMesh scan;
  for (int round = 0; round < 3; ++round) {
    scan = samples::polygonise(horse.body, spacing, 0, 1e-5);
    spacing *= std::sqrt(static_cast<double>(scan.points.size()) / vertices);
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->name = std::to_string(std::lround(vertices / 1000.0)) + "K_scan";
  for (const glm::dvec3& p : scan.points) mesh->positions.insert(mesh->positions.end(), {p.x, p.y, p.z});
  for (const samples::Triangle& t : scan.triangles) mesh->triangles.insert(mesh->triangles.end(), t.begin(), t.end());
  return mesh;
}

std::vector<std::shared_ptr<const Mesh>> real_meshes() {
  const char* given = std::getenv("HF_SHARED_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(given ? given : HF_SOURCE_DIR "/../shared/data") / "meshes";
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const char* name : {"armadillo_43k", "armadillo_50k"}) {
    const std::filesystem::path file = folder / (std::string(name) + ".obj");
    if (!std::filesystem::exists(file)) continue;
    const samples::SurfaceMesh surface = samples::read_mesh_file(file);
    auto mesh = std::make_shared<Mesh>();
    mesh->name = name;
    for (const glm::dvec3& p : surface.positions) mesh->positions.insert(mesh->positions.end(), {p.x, p.y, p.z});
    mesh->triangles = surface.triangles;
    meshes.push_back(std::move(mesh));
  }
  if (meshes.empty()) std::printf("no shared data folder here: the real scans are left out\n");
  return meshes;
}

}  // namespace bench
