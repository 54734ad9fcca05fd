// played_frames OUT.glb FRAMES_DIR MESH: the animation hf_deform_script wrote, read again and played at its keys, gives
// the frames it wrote as .obj, in the vertex order of the mesh. Exit code 0 when they agree.
#include <cmath>
#include <cstdio>
#include <exception>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"

int main(int count, char** arguments) {
  using namespace samples;
  using namespace hf_gltf;
  if (count != 4) return 2;
  try {
    const Model model = read_gltf(arguments[1]);
    const FlatMesh flat = flatten(model);
    const SurfaceMesh mesh = read_mesh_file(arguments[3]);
    const std::vector<double> times = key_times(model.animations.at(0));
    double worst = 0, moved = 0;
    for (size_t k = 0; k < times.size(); ++k) {
      char name[32];
      std::snprintf(name, sizeof name, "frame_%04zu.obj", k);
      const SurfaceMesh frame = read_mesh_file(std::filesystem::path(arguments[2]) / name);
      const std::vector<glm::dvec3> played = posed_positions(model, flat, model.animations[0], times[k]);
      if (frame.positions.size() != mesh.positions.size() || played.size() != mesh.positions.size() ||
          frame.triangles != mesh.triangles) {
        std::fprintf(stderr, "%s: vertices or triangles are not those of the mesh\n", name);
        return 1;
      }
      for (size_t v = 0; v < played.size(); ++v) {
        worst = std::fmax(worst, glm::length(played[v] - frame.positions[v]));
        moved = std::fmax(moved, glm::length(mesh.positions[v] - frame.positions[v]));
      }
    }
    std::printf("%zu frames, played within %.1e, moved by up to %.2f\n", times.size(), worst, moved);
    return worst < 1e-5 && moved > 0.1 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "played_frames: %s\n", error.what());
    return 1;
  }
}
