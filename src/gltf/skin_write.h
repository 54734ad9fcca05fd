// A computed motion as a skinned glTF: per-frame rigid joint motions and per-vertex weights become a skin and a clip.
//
// The joints are direct children of one root node, each with its pivot c at the given point. A joint's motion takes x
// to R x + t. Its node has translation R c + t, rotation R and inverse bind matrix translate(-c). So interpolation
// between keys turns about the pivot and not about the origin. A joint that stretches by s along its axes B takes x to
// R B diag(s) B' (x - c) + R c + t. Its node has rotation R B, scale s and inverse bind matrix B' translate(-c). Keys
// are LINEAR. Quaternion signs are made continuous. Vertex positions are the rest positions in world space. Materials
// and texture coordinates of every primitive are kept. Neighbouring primitives of one look become one.
#ifndef HF_GLTF_SKIN_WRITE_H
#define HF_GLTF_SKIN_WRITE_H

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/model.h"

namespace hf_gltf {

struct SkinJoint {
  std::string name;
  glm::dvec3 pivot{0, 0, 0};
  glm::dquat axes{1, 0, 0, 0};
};

// rotations[f * joints + j], translations the same: the motion x -> R x + t of joint j at times[f]. The array scales is
// the same, or none: the stretch about the pivot before.
struct SkinClip {
  std::string name;
  std::vector<double> times;  // increasing, from 0
  std::vector<glm::dquat> rotations;
  std::vector<glm::dvec3> translations;
  std::vector<glm::dvec3> scales = {};
};

struct SkinDescription {
  std::vector<SkinJoint> joints;
  // influences_per_vertex (1 to 8) joints and weights per flat vertex; weights >= 0, normalised here.
  uint32_t influences_per_vertex = 4;
  std::vector<uint32_t> vertex_joints;
  std::vector<float> vertex_weights;
  std::vector<SkinClip> clips;
};

// Throws std::runtime_error naming the joint, vertex or frame that does not fit.
Model skin_model(const Model& source, const FlatMesh& mesh, const SkinDescription& skin);

// The contents of a file beside its shape: copyright, extras, cameras, lights. Nodes that carry them stand where they
// stood at rest, at the top of the scene.
void keep_carried(const Model& from, Model& out);

// Gives the only mesh of `out`, the flat mesh of `from` vertex by vertex, the morph targets of `from`. Targets of equal
// names in several meshes are one.
void keep_shapes(const Model& from, const FlatMesh& mesh, Model& out);

}  // namespace hf_gltf

#endif
