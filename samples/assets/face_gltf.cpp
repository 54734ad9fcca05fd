// See face_gltf.h.
#include "assets/face_gltf.h"

#include "gltf/flat_mesh.h"

namespace samples {

using namespace hf_gltf;

Model to_model(const Face& face, const std::string& name, bool shapes) {
  Model model = make_model(name, to_points(face.mesh.positions), face.mesh.triangles);
  MeshData& mesh = model.meshes.front();
  Primitive& primitive = mesh.primitives.front();
  Material material;
  material.name = "skin";
  material.base_color = {0.75f, 0.55f, 0.45f, 1};
  material.metallic = 0;
  material.double_sided = true;
  model.materials.push_back(material);
  primitive.material = 0;
  if (!shapes) return model;
  FlatMesh flat;
  flat.positions = to_points(face.mesh.positions);
  flat.triangles = face.mesh.triangles;
  flat.weld();
  mesh.target_names = face.shape_names;
  mesh.weights.assign(face.shapes.size(), 0.0f);
  for (const std::vector<double>& shape : face.shapes) {
    const std::vector<glm::dvec3> posed = to_points(shape);
    const std::vector<glm::vec3> normals = welded_normals(flat, posed);
    MorphTarget morph;
    for (size_t v = 0; v < posed.size(); ++v) {
      morph.positions.push_back(glm::vec3(posed[v] - flat.positions[v]));
      morph.normals.push_back(normals[v] - primitive.normals[v]);
    }
    primitive.targets.push_back(std::move(morph));
  }
  Animation blink;
  blink.name = "blink";
  Channel channel;
  channel.path = Path::weights;
  channel.node = 0;
  channel.width = face.shapes.size();
  channel.times = {0, 0.15f, 0.3f};
  channel.values.assign(3 * channel.width, 0.0f);
  channel.values[channel.width] = channel.values[channel.width + 1] = 1;
  blink.channels.push_back(channel);
  model.animations.push_back(blink);
  return model;
}

}  // namespace samples
