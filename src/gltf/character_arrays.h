// A model as the plain arrays that know_character (skeleton/character.h) takes.
#ifndef HF_GLTF_CHARACTER_ARRAYS_H
#define HF_GLTF_CHARACTER_ARRAYS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/animate.h"
#include "gltf/model.h"

namespace hf_gltf {

struct CharacterArrays {
  std::vector<std::string> texts;
  std::vector<const char*> names;  // of texts, one for each node
  std::vector<std::int32_t> parents, vertex_joints, roles, sides;
  std::vector<double> matrices, inverse_binds, positions, weights, travels;
  std::vector<std::uint8_t> bound;
  std::vector<std::uint32_t> triangles, starts, joints;
  double up[3] = {0, 1, 0};
  double forward[3] = {0, 0, 1};
  bool declared = false;  // the file or the caller says what some joints are
  bool faces = false;     // the file says where forward is

  // Leaves loose vertices of the mesh out. pose: the pose in which the positions of the mesh are.
  CharacterArrays(const Model& model, const FlatMesh& mesh, const Pose& pose);
  CharacterArrays(const Model& model, const FlatMesh& mesh) : CharacterArrays(model, mesh, rest_pose(model)) {}
  CharacterArrays(const CharacterArrays&) = delete;
  CharacterArrays& operator=(const CharacterArrays&) = delete;

  // Input: CharacterInput. Its pointers are into this object. Up is glTF's.
  template <class Input>
  Input input() const {
    Input in;
    in.joint_count = static_cast<std::uint32_t>(parents.size());
    in.names = names.data();
    in.parents = parents.data();
    in.matrices = matrices.data();
    in.inverse_binds = inverse_binds.data();
    in.bound = bound.data();
    in.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    in.positions = positions.data();
    in.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    in.triangles = triangles.data();
    in.influence_starts = starts.data();
    in.influence_joints = joints.data();
    in.influence_weights = weights.data();
    in.vertex_joints = vertex_joints.data();
    in.up = up;
    in.travel_count = static_cast<std::uint32_t>(travels.size() / 3);
    in.travels = travels.data();
    if (declared) {
      in.roles = roles.data();
      in.sides = sides.data();
    }
    if (faces) in.forward = forward;
    return in;
  }

 private:
  void add_nodes(const Model& model, const FlatMesh& mesh, const Pose& pose);
  void add_surface(const Model& model, const FlatMesh& mesh);
  void add_declared(const Model& model);
  void add_said(const Model& model);
  void add_travels(const Model& model);
  void declare(const std::string& bone, int node);
};

}  // namespace hf_gltf

#endif
