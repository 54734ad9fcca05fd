// Plays the motion of one skeleton on another: joint transforms in, joint transforms out, one frame at a time.
//
//   const Character a = know_character(source_input, memory), b = know_character(target_input, memory);
//   Retarget retarget({source_input, a, nullptr}, {target_input, b, nullptr}, {}, memory);
//   retarget.frame(source_trs, seconds, target_trs);  // for each frame
//
// A joint of the target turns as its partner of the source has turned since rest, seen from the body. Limbs whose
// rests differ are aligned about shoulder and hip first, so T, A and crouch meet. Chains of unequal length share their
// turns by arc length. The hips travel by the ratio of leg lengths. On top, feet go where the feet of the source are
// over the ground; soles, tails, necks and the trunk stay above it. Lengths of bones never change. A joint without a
// partner keeps its rest under its parent. Two equal skeletons are noticed: their keys are copied.
//
// What a frame depends on: its source pose, and for each foot whether it stands and an offset that holds it where it
// stands. Both come from the frames since the last reset, and fade within a step. With lock_feet off a frame depends on
// its source pose alone: a foot stands where it is low. Then a scrubbed timeline gives the bits of a played one.
//
// The object keeps no pointer of the caller. A frame allocates nothing. One object serves one thread at a time.
#pragma once
#include <cstdint>
#include <memory>

#include "base/memory.h"
#include "skeleton/character.h"

namespace hf_inner {

// keep: the hips carry the travel. to_root: the topmost joint above the hips carries it over the ground, and the hips
// the rest. in_place: the travel over the ground is left out.
enum class RootMotion : std::int32_t { keep, to_root, in_place };

struct RetargetOptions {
  RootMotion root_motion = RootMotion::keep;
  bool align_rests = true;
  bool goals = true;      // of feet and ground
  bool lock_feet = true;  // standing feet slide no more than those of the source
  bool copy_same = true;  // equal skeletons
  double scale = 0;       // of travel; 0: found from the legs
  // How the ground moves below a clip that runs on the spot, in the space of the source, units a second; 0: it rests.
  // find_ground_velocity finds it.
  double ground_velocity[3] = {0, 0, 0};
};

// What know_character was given and what it found. rest: 10 numbers a joint (translation, rotation x y z w, scale,
// relative to the parent), a pose in which both characters stand alike; null: the rest of the input.
struct RetargetSide {
  const CharacterInput& input;
  const Character& character;
  const double* rest = nullptr;
};

enum class ScaleSource : std::int32_t { given, legs, hips, height };
const char* scale_source_name(ScaleSource source) noexcept;

// How one chain of the target follows. The angles are between the directions of its bones and those of the source, in
// degrees, over the frames since the last reset; they are 0 for chains of one joint and for those that are not aligned.
struct ChainReport {
  Role role = Role::other;
  Side side = Side::middle;
  std::uint32_t source_joints = 0, target_joints = 0;
  double mean_degrees = 0, worst_degrees = 0;
};

struct RetargetReport {
  explicit RetargetReport(Memory& memory) : chains(&memory), unmatched_source(&memory), unmatched_target(&memory) {}
  bool same_skeleton = false;
  double scale = 1;
  ScaleSource scale_source = ScaleSource::legs;
  std::uint32_t matched_joints = 0;                         // of the target
  Vector<ChainReport> chains;                               // pairs, in the order of the target's chains
  Vector<std::uint32_t> unmatched_source, unmatched_target;  // joints of the body without a partner
  std::uint64_t frames = 0;                                 // since the last reset
  double limb_degrees = 0;                                  // mean over arms and legs and frames
  // How far standing feet go by the turns of their legs alone, over `scale` times that of the source. A clip on the spot
  // that is moved at scale x stride times its speed needs the least holding of feet.
  double stride = 1;
  double deepest_drop = 0;                                  // of the hips, so that feet reach; in units of the target
};

// The velocity that the soles of a clip have where they stand: 0 if the clip travels. poses: count frames of 10 numbers
// for each joint, `seconds` apart.
void find_ground_velocity(const RetargetSide& source, const double* poses, std::uint32_t count, double seconds,
                          double velocity[3], Memory& memory);

class Retargeter;

class Retarget {
 public:
  // Throws Error, with the joint as index, if a side is not what its character was made of, if no joint of the two has
  // a partner, or if an option is out of range.
  Retarget(const RetargetSide& source, const RetargetSide& target, const RetargetOptions& options, Memory& memory);
  ~Retarget();
  Retarget(Retarget&&) noexcept;
  Retarget& operator=(Retarget&&) noexcept;

  // source: 10 numbers for each joint of the source. target: as many for each joint of the target; all are written.
  // seconds: since the last frame; 0 for the first and for a frame that is shown again. A number that is not finite
  // or a rotation of 0 throws Error with the joint, and nothing has changed.
  void frame(const double* source, double seconds, double* target);
  // Forgets the offsets of the feet and the figures of the report. Call it where the clip jumps.
  void reset() noexcept;
  const RetargetReport& report() const noexcept;

 private:
  std::shared_ptr<Retargeter> self_;
};

}  // namespace hf_inner
