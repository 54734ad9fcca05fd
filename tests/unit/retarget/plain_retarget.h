// The plain peer, as a game programmer would write it in an afternoon: joints are paired by their names, each turns
// since rest as its partner does, and the hips travel by the ratio of the legs. It aligns no rests and has no goals.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "retarget/turns.h"
#include "skeleton/character.h"

namespace hf_test {

class PlainRetarget {
 public:
  PlainRetarget(const hf_inner::skeleton::CharacterInput& source, const hf_inner::skeleton::CharacterInput& target);
  // 10 numbers a joint, in and out.
  void frame(const double* source, double* target) const;

 private:
  struct Bone {
    hf_inner::retarget::Turn turn;
    hf_inner::Vec3 place;
    double scale = 1;
  };
  struct Rig {
    std::vector<std::int32_t> parents;
    std::vector<std::size_t> order;    // parents first
    std::map<std::string, int> parts;  // such as "left thigh"
    std::vector<double> trs;
    std::vector<Bone> rest;
    hf_inner::retarget::Turn axes;  // left, up and forward at rest
    double leg = 0;                 // hip to foot

    explicit Rig(const hf_inner::skeleton::CharacterInput& input);
    Bone posed(const std::vector<Bone>& bones, std::size_t joint, const double* trs) const;
    std::vector<Bone> pose(const double* trs) const;
  };
  Rig source_, target_;
  std::vector<int> partners_;  // of each joint of the target, or -1
};

// "left thigh" for mixamorig:LeftUpLeg, thigh_l, J_Bip_L_UpperLeg and upperleg.l; empty for what is no bone of a body.
std::string plain_part(const std::string& name);

}  // namespace hf_test
