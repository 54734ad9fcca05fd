// posed_points FILE CLIP TIMES: the vertices of a model at the times (with commas between) of a clip, all in one line
// for each. CLIP - is the rest pose, an empty one the first clip. A model without triangles gives the places of its
// nodes.
#include <cstdio>
#include <exception>
#include <sstream>

#include "gltf/animate.h"
#include "gltf/gltf_read.h"

int main(int count, char** arguments) {
  using namespace hf_gltf;
  if (count != 4) return 2;
  try {
    const Model model = read_gltf(arguments[1]);
    const FlatMesh mesh = flatten(model);
    const std::string wanted = arguments[2];
    std::stringstream times(arguments[3]);
    for (std::string time; std::getline(times, time, ',');) {
      Pose pose = rest_pose(model);
      bool found = wanted == "-";
      for (const Animation& clip : model.animations)
        if (!found && (wanted.empty() || clip.name == wanted)) {
          found = true;
          pose = sample(model, clip, std::stod(time));
        }
      if (!found) throw std::runtime_error(wanted + " is no clip of " + model.name);
      std::vector<glm::dvec3> points = posed_positions(model, mesh, pose);
      if (mesh.triangles.empty())
        for (const glm::dmat4& world : global_matrices(model, pose)) points.emplace_back(world[3]);
      for (const glm::dvec3& p : points) std::printf("%.9g %.9g %.9g ", p.x, p.y, p.z);
      std::printf("\n");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "posed_points: %s\n", error.what());
    return 1;
  }
}
