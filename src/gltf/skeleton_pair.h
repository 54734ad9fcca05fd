// Two models whose skeletons are understood: the clip of one on the joints of the other, and how well a pose follows.
//
//   const SkeletonPair pair({source, source_mesh}, {target, target_mesh});
//   if (pair.refusal().empty()) JointClip clip = pair.play(source.animations[0], times, {});
//
// The room retarget turns the joints (retarget/retarget.h); this library has a copy of that room inside. Joints are
// nodes, by index: names may repeat, and nodes of no skin may stand between joints.
#ifndef HF_GLTF_SKELETON_PAIR_H
#define HF_GLTF_SKELETON_PAIR_H

#include <memory>
#include <string>
#include <vector>

#include "gltf/animate.h"
#include "gltf/regions.h"

namespace hf_gltf {

struct JointSide {
  const Model& model;
  const FlatMesh& mesh;        // in the pose of rest; may be empty
  const Axes* axes = nullptr;  // given by the caller, or null
  const Pose* rest = nullptr;  // a pose in which both are alike; null: the pose of the file
};

struct JointOptions {
  bool in_place = false;   // the straight travel along the ground is taken out
  bool ground = true;      // feet reach their places and nothing sinks
  bool foot_path = false;  // feet follow the scaled path of the source's; else legs point as the source's
  double stride = 1;       // times the ratio of leg lengths
  double scale = 0;        // of travel; 0: found
};

struct JointClip {
  std::vector<double> times;
  std::vector<Pose> source, target;  // of every node
  bool same = false;                 // equal skeletons: keys are copied
  double scale = 1;
  std::string scale_from;
  size_t joints = 0;                   // of the target that follow
  std::vector<std::string> unmatched;  // joints of the source's body without a partner
  std::vector<std::string> staying;    // joints of the target's body without one
  double drop = 0;                     // how far the hips sank so that feet reach, in units of the target
  double hover = 0;                    // see RetargetReport
  bool foot_path = false;              // as asked
  double frame_ms = 0;
  glm::dvec3 travel{0, 0, 0};  // of the target, that was taken out
  bool moves = false;          // the body moves at all in this clip
  std::vector<int> riders;     // nodes of the target that were put on joints, see riders.h
};

// How far bones of arms and legs point elsewhere than the source's, in degrees, over all frames. Where
// the bodies do not stand alike the turns since rest are compared.
struct LimbFit {
  std::string name;  // "left arm"
  double mean = 0, worst = 0;
};
struct PoseFit {
  std::vector<LimbFit> limbs;                 // limbs with a partner
  size_t compared = 0;                        // limbs with a bone whose both ends are joints
  double degrees = -1, worst = 0;             // mean over them, below 0: unknown; worst frame of the worst limb
  double trunk_degrees = 0, trunk_worst = 0;  // hips to neck, since rest
  size_t source_limbs = 0, target_limbs = 0;  // arms and legs, and wings and fins with a partner
  bool flaps = false;                         // wings or fins are among them
  // Arms and legs of the target that nothing leads, or whose first joint is far from its vertices, and arms and legs of
  // the source without a partner for which the target has a limb of unknown part. A share of the arms and legs of the
  // body that has more.
  double unmatched = 0;
};

// Gives the first clips of a model keys for riders of joints (riders.h) that the clips do not move. bound: the target
// with these clips put in. For clips that name joints alone, such as the clips of bind_clips.
void add_riders(const Model& target, Model& bound, size_t clips);

class SkeletonPair {
 public:
  // Throws std::runtime_error if a chain that is named on both bodies has another part, side or number on each.
  SkeletonPair(const JointSide& source, const JointSide& target);
  ~SkeletonPair();
  // Why joints cannot lead, a sentence; empty: they can.
  const std::string& refusal() const;
  // Whether both skeletons are understood, alike or not.
  bool understood() const;
  // Whether both bodies have one pair of legs or none.
  bool two_legged() const;
  // Whether both have two pairs.
  bool four_legged() const;
  // Nodes of the target with a mesh beside the skeleton for which no clip shows a joint to follow. They do not move.
  // Scenery is among them.
  const std::vector<int>& left_behind() const;
  // How uneven the rest poses are from which the motion counts. It measures how far arms and legs are from mirroring
  // each other, beyond the limit of a standing body. 0: both stand. 1: twice the limit.
  double unevenness() const;
  // "2 legs and 2 arms"
  std::string limbs_text() const;
  // The node over all joints of the target that could carry the travel.
  int target_root() const;
  JointClip play(const Animation& clip, const std::vector<double>& times, const JointOptions& options) const;
  PoseFit fit(const std::vector<Pose>& source, const std::vector<Pose>& target) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> in_;
};

}  // namespace hf_gltf

#endif
