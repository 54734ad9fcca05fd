// Creature to Model, field by field.
#include "assets/creature_gltf.h"

namespace samples {
namespace {

Primitive primitive_of(const Creature& creature) {
  Primitive primitive;
  std::vector<glm::vec2> texcoords;
  for (size_t v = 0; v < creature.vertex_count(); ++v) {
    const float *p = &creature.positions[3 * v], *n = &creature.normals[3 * v], *c = &creature.colors[3 * v];
    primitive.positions.push_back({p[0], p[1], p[2]});
    primitive.normals.push_back({n[0], n[1], n[2]});
    primitive.colors.push_back({c[0], c[1], c[2], 1});
    texcoords.push_back({creature.texcoords[2 * v], creature.texcoords[2 * v + 1]});
    Influences influences;
    for (size_t k = 0; k < 4; ++k) {
      influences.joints[k] = creature.joints[v][k];
      influences.weights[k] = creature.weights[v][k];
    }
    primitive.influences.push_back(influences);
  }
  primitive.texcoords.push_back(texcoords);
  primitive.indices = creature.triangles;
  primitive.material = 0;
  return primitive;
}

Animation animation_of(const Clip& clip) {
  Animation animation;
  animation.name = clip.name;
  for (size_t j = 0; j < clip.joints.size(); ++j) {
    const auto add = [&](Path path, size_t width, const std::vector<float>& values) {
      if (values.empty()) return;
      Channel channel;
      channel.node = static_cast<int>(j);
      channel.path = path;
      channel.width = width;
      channel.times = clip.times;
      channel.values = values;
      animation.channels.push_back(channel);
    };
    add(Path::translation, 3, clip.joints[j].translations);
    add(Path::rotation, 4, clip.joints[j].rotations);
  }
  return animation;
}

}  // namespace

Model to_model(const Creature& creature) {
  Model model;
  model.name = creature.name;
  // joint j is node j; the skinned mesh comes last
  Skin skin;
  skin.name = creature.name;
  std::vector<glm::vec3> world;
  for (size_t j = 0; j < creature.skeleton.size(); ++j) {
    const Joint& joint = creature.skeleton[j];
    Node node;
    node.name = joint.name;
    node.parent = joint.parent;
    node.translation = {joint.translation[0], joint.translation[1], joint.translation[2]};
    world.push_back(node.translation);
    if (joint.parent >= 0) {
      model.nodes[size_t(joint.parent)].children.push_back(static_cast<int>(j));
      world.back() += world[size_t(joint.parent)];
    } else {
      model.scene_roots.push_back(static_cast<int>(j));
      skin.skeleton = static_cast<int>(j);
    }
    model.nodes.push_back(node);
    skin.joints.push_back(static_cast<int>(j));
    glm::mat4 inverse_bind(1.0f);
    inverse_bind[3] = glm::vec4(-world.back(), 1);
    skin.inverse_bind.push_back(inverse_bind);
  }
  Node body;
  body.name = creature.name;
  body.mesh = 0;
  body.skin = 0;
  model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(body);
  model.skins.push_back(skin);
  MeshData mesh;
  mesh.name = creature.name;
  mesh.primitives.push_back(primitive_of(creature));
  model.meshes.push_back(mesh);
  Material material;
  material.name = "coat";
  material.base_color = {creature.base_color[0], creature.base_color[1], creature.base_color[2], 1};
  material.metallic = 0;
  material.roughness = 0.75f;
  model.materials.push_back(material);
  for (const Clip& clip : creature.clips) model.animations.push_back(animation_of(clip));
  return model;
}

}  // namespace samples
