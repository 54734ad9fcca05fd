// Joints and their clips, of hf_gltf/gltf.h.
#include <algorithm>
#include <cmath>

#include "gltf/animate.h"
#include "gltf/api_arguments.h"
#include "gltf/clip_binding.h"
#include "gltf/pose_numbers.h"

namespace hf_gltf {
namespace {

constexpr size_t numbers = 10;  // of a joint

void write_floats(const Pose& pose, float* to) {
  std::vector<double> trs;
  append_trs(pose, trs);
  std::transform(trs.begin(), trs.end(), to, [](double x) { return static_cast<float>(x); });
}

Pose read_pose(const Pose& rest, const float* from, size_t frame) {
  std::vector<double> trs(from, from + numbers * rest.size());
  for (size_t j = 0; j < rest.size(); ++j) {
    double* const q = trs.data() + numbers * j + 3;
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0))
      throw Failure(HF_ERROR_INVALID_ARGUMENT,
                    "frame " + std::to_string(frame) + ": the rotation of joint " + std::to_string(j) +
                        " is 0; give a quaternion x y z w of length 1",
                    static_cast<uint32_t>(frame));
    for (int c = 0; c < 4; ++c) q[c] /= length;
  }
  return pose_of(rest, trs);
}

}  // namespace

std::string joint_names(const Model& model) {
  std::string out;
  for (const Node& node : model.nodes) out += node.name + "\n";
  size_t at = 0;
  for (const Node& node : model.nodes) {
    std::replace(out.begin() + static_cast<std::ptrdiff_t>(at),
                 out.begin() + static_cast<std::ptrdiff_t>(at + node.name.size()), '\n', ' ');
    at += node.name.size() + 1;
  }
  return out;
}

}  // namespace hf_gltf

using namespace hf_gltf;

extern "C" {

hf_result hf_gltf_model_get_skeleton(hf_gltf_model model, const hf_gltf_skeleton* out_skeleton) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    const hf_gltf_skeleton& out = sized(out_skeleton, "out_skeleton");
    const Model& of = object->model;
    if (out.names) {
      const std::string names = joint_names(of);
      if (out.name_capacity <= names.size())
        throw Failure(HF_ERROR_TOO_SMALL, "name_capacity is " + std::to_string(out.name_capacity) + "; " +
                                              std::to_string(names.size() + 1) + " are needed");
      std::copy_n(names.c_str(), names.size() + 1, out.names);
    }
    for (size_t j = 0; out.parents && j < of.nodes.size(); ++j)
      out.parents[j] = of.nodes[j].parent < 0 ? HF_NO_INDEX : static_cast<uint32_t>(of.nodes[j].parent);
    if (out.rest) write_floats(rest_pose(of), out.rest);
    if (!out.inverse_binds) return;
    std::fill_n(out.inverse_binds, 16 * of.nodes.size(), 0.0f);
    for (const Skin& skin : of.skins) {
      for (size_t k = 0; k < skin.joints.size(); ++k) {
        float* const to = out.inverse_binds + 16 * static_cast<size_t>(skin.joints[k]);
        for (int column = 0; column < 4; ++column)
          for (int row = 0; row < 4; ++row)
            to[4 * column + row] = static_cast<float>(skin.inverse_bind[k][column][row]);
      }
    }
  });
}

hf_result hf_gltf_model_pose_joints(hf_gltf_model model, uint32_t clip, double time, float* joints) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    const size_t at = numbered(clip, object->model.animations.size(), "clip");
    need(joints, "joints");
    need_finite(&time, 1, 1, "time");
    write_floats(sample(object->model, object->model.animations[at], time), joints);
  });
}

hf_result hf_gltf_model_add_joint_clip(hf_gltf_model model, const hf_gltf_joints_desc* desc) {
  return guarded(__func__, [&] {
    const Changing<ModelObject> object(model, "model");
    const hf_gltf_joints_desc& given = sized(desc, "desc");
    const std::vector<double> times = times_of(given.times, given.frame_count);
    need(given.joints, "joints");
    const Pose rest = rest_pose(object->model);
    const size_t row = numbers * rest.size();
    need_finite(given.joints, row * times.size(), row, "frame");
    std::vector<Pose> poses;
    for (size_t f = 0; f < times.size(); ++f) poses.push_back(read_pose(rest, given.joints + row * f, f));
    insert_clip(object->model, 0, clip_of_poses(object->model, given.name ? given.name : "", times, poses));
  });
}

}  // extern "C"
