// Methods of a retarget: the motion of one skeleton on another (hf/skeleton.h, hf/retarget.h). They need no mesh.
#include "arguments.h"

namespace hf_godot {
namespace {

// retarget_create(names, parents, rest of the source, names, parents, rest of the target, options = {})
Value retarget_create(Surface& s, const Arguments& a) {
  const auto source = skeleton_of(at(a, 0), at(a, 1), at(a, 2)), target = skeleton_of(at(a, 3), at(a, 4), at(a, 5));
  auto desc = make<hf_retarget_desc>();
  read_options(at(a, 6), {{"root_motion", &desc.root_motion}, {"leave_out", &desc.leave_out}, {"scale", &desc.scale}});
  make_again(s.retarget, [&](hf_retarget* out) { return hf_retarget_create(source.get(), target.get(), &desc, out); });
  s.joints.resize(at(a, 2).list.size());
  s.target_joints = at(a, 5).list.size();
  return done();
}

// retarget_solve(pose of the source, seconds since the last frame): the pose of the target, 10 numbers for each joint
Value retarget_solve(Surface& s, const Arguments& a) {
  if (at(a, 0).list.size() != s.joints.size()) fail("the pose must hold 10 numbers for each joint of the source");
  std::copy(a[0].list.begin(), a[0].list.end(), s.joints.begin());
  Value value;
  value.kind = Value::reals;
  value.floats.resize(s.target_joints);
  check(hf_retarget_solve(s.retarget.get(), s.joints.data(), at(a, 1).number, value.floats.data()));
  return value;
}

// retarget_reset(): the clip jumps
Value retarget_reset(Surface& s, const Arguments&) {
  check(hf_retarget_reset(s.retarget.get()));
  return done();
}

Value retarget_info(Surface& s, const Arguments&) {
  auto info = make<hf_retarget_info>();
  check(hf_retarget_get_info(s.retarget.get(), &info));
  return named({{"matched_joint_count", info.matched_joint_count},
                {"chain_count", info.chain_count},
                {"same_skeleton", info.same_skeleton},
                {"scale", info.scale},
                {"limb_angle", info.limb_angle},
                {"stride_share", info.stride_share}});
}

}  // namespace

const std::vector<Entry>& retarget_methods() {
  static const std::vector<Entry> all = {{"retarget_create", 6, 7, retarget_create},
                                         {"retarget_solve", 1, 2, retarget_solve},
                                         {"retarget_reset", 0, 0, retarget_reset},
                                         {"retarget_info", 0, 0, retarget_info}};
  return all;
}

}  // namespace hf_godot
