// Bookkeeping of a design: names, pairs, mirrored flesh.
#include "creature_design.h"

#include <stdexcept>

namespace samples {
namespace {

dvec3 mirrored(const dvec3& p) { return {-p.x, p.y, p.z}; }

Blob mirrored(const Blob& blob) {
  Blob result = blob;
  result.a = mirrored(blob.a);
  result.b = mirrored(blob.b);
  const dmat3 mirror(dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1));
  result.to_local = mirror * blob.to_local * mirror;
  return result;
}

bool exists(const Design& design, const std::string& name) {
  for (const Joint& joint : design.joints) {
    if (joint.name == name) return true;
  }
  return false;
}

}  // namespace

uint32_t Design::joint(const std::string& wanted) const {
  for (uint32_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == wanted) return j;
  }
  throw std::runtime_error("the design has no joint named " + wanted);
}

uint32_t Design::add_joint(const std::string& joint_name, const std::string& parent, const dvec3& position) {
  Joint added;
  added.name = joint_name;
  added.parent = parent.empty() ? -1 : static_cast<int32_t>(joint(parent));
  const dvec3 local = parent.empty() ? position : position - at(parent);
  added.translation = {local.x, local.y, local.z};
  joints.push_back(added);
  rest.push_back(position);
  return static_cast<uint32_t>(joints.size() - 1);
}

void Design::add_pair(const std::string& joint_name, const std::string& parent, const dvec3& left_position) {
  for (const char* suffix : {"_L", "_R"}) {
    const std::string own_side = parent + suffix;
    add_joint(joint_name + suffix, exists(*this, own_side) ? own_side : parent,
              suffix[1] == 'L' ? left_position : mirrored(left_position));
  }
}

void Design::flesh(const std::string& joint_name, Blob blob, double detail) {
  blob.joint = joint(joint_name);
  blob.detail = detail;
  body.blobs.push_back(blob);
}

void Design::flesh_pair(const std::string& joint_name, const Blob& left_blob, double detail) {
  const bool paired = exists(*this, joint_name + "_L");
  flesh(paired ? joint_name + "_L" : joint_name, left_blob, detail);
  flesh(paired ? joint_name + "_R" : joint_name, mirrored(left_blob), detail);
}

void Design::chart(const std::vector<std::string>& names, const dvec3& axis) {
  ChartGroup group;
  group.axis = normalize(axis);
  for (const std::string& joint_name : names) group.joints.push_back(joint(joint_name));
  groups.push_back(group);
}

void Design::chart_pair(const std::vector<std::string>& names, const dvec3& left_axis) {
  for (const char* suffix : {"_L", "_R"}) {
    std::vector<std::string> own_side;
    for (const std::string& joint_name : names) own_side.push_back(joint_name + suffix);
    chart(own_side, suffix[1] == 'L' ? left_axis : mirrored(left_axis));
  }
}

}  // namespace samples
