// Plays the motion of one skeleton on another: joint transforms in, joint transforms out, one frame at a time.
//
//   const Character a = know_character(source_input, memory), b = know_character(target_input, memory);
//   Retarget retarget({source_input, a, nullptr}, {target_input, b, nullptr}, {}, memory);
//   retarget.frame(source_trs, seconds, target_trs);  // for each frame
//
// A joint of the target turns as its partner of the source has turned since rest, seen from the body. Limbs whose
// rests differ are aligned about shoulder and hip first, so T, A and crouch meet. Chains of unequal length share their
// turns by arc length. The hips travel by the ratio of leg lengths. On top, feet go where the feet of the source are
// over the ground; soles, tails, necks and the trunk stay above it. A part that the source puts deep into the ground
// goes as deep. Lengths of bones never change. A joint without a partner keeps its rest under its parent. Two equal
// skeletons are noticed: their keys are copied.
//
// A frame depends on its source pose and on the state of the feet. The state says whether a foot is planted, and how
// far the foot is moved to keep its place. It comes from the frames since the last reset and fades within a step. With
// lock_feet off there is no state: a low foot is planted. Then a scrubbed timeline gives the bits of a played one.
//
// The object keeps no pointer of the caller. A frame allocates nothing. One object serves one thread at a time.
#pragma once
#include <cstdint>
#include <memory>

#include "base/memory.h"
#include "skeleton/character.h"

namespace hf_inner::retarget {

// Which joint gets the travel over the ground. keep: the hips. to_root: the topmost joint above the hips. in_place: no
// joint, the body stays in its place.
enum class RootMotion : std::int32_t { keep, to_root, in_place };

struct RetargetOptions {
  RootMotion root_motion = RootMotion::keep;
  bool align_rests = true;
  bool goals = true;      // feet reach their places, nothing sinks into the ground
  bool lock_feet = true;  // planted feet slide no more than the feet of the source
  // Feet of people go where the feet of the source are from its hips, scaled, as the feet of animals do, and legs
  // follow. Otherwise legs point as the legs of the source. It brings feet to the ground that hover because the source
  // folds its legs and stands on large feet.
  bool foot_path = false;
  bool copy_same = true;  // keys are copied between equal skeletons
  double scale = 0;       // times the travel of the source; 0: the ratio of leg lengths
  // The velocity of the ground under a clip on the spot, in the space of the source, in units per second. 0: the ground
  // rests. find_ground_velocity finds it.
  double ground_velocity[3] = {0, 0, 0};
};

// One of the two characters: the input of know_character and its result. rest: a pose in which both characters stand
// alike, 10 numbers per joint: translation, rotation x y z w and scale, relative to the parent. Null: the rest pose of
// the input.
struct RetargetSide {
  const skeleton::CharacterInput& input;
  const skeleton::Character& character;
  const double* rest = nullptr;
};

// The part of the source that leads the arm, wing or fin of the target on one side: the same part, else a wing or a fin
// if the target has none of that kind. other: there is none. Arms do not lead wings and fins: they rest spread where
// arms hang, so that a walk would fold them down.
skeleton::Role flapping_partner(const skeleton::Character& source, const skeleton::Character& target,
                                skeleton::Side side, skeleton::Role role);

enum class ScaleSource : std::int32_t { given, legs, hips, height };
const char* scale_source_name(ScaleSource source) noexcept;

// How one chain of the target follows its partner. Each angle lies between a bone of the target and the same bone of
// the source, in degrees. The figures count all frames since the last reset. They are 0 for a chain of one joint, and
// for a chain whose rest is not aligned.
struct ChainReport {
  skeleton::Role role = skeleton::Role::other;
  skeleton::Side side = skeleton::Side::middle;
  std::uint32_t source_joints = 0, target_joints = 0;
  double mean_degrees = 0, worst_degrees = 0;
};

struct RetargetReport {
  explicit RetargetReport(Memory& memory) : chains(&memory), unmatched_source(&memory), unmatched_target(&memory) {}
  bool same_skeleton = false;
  double scale = 1;  // of travel
  ScaleSource scale_source = ScaleSource::legs;
  std::uint32_t matched_joints = 0;  // joints of the target that follow
  Vector<ChainReport> chains;        // in the order of the chains of the target
  // Joints of each body that have no partner.
  Vector<std::uint32_t> unmatched_source, unmatched_target;
  std::uint64_t frames = 0;  // since the last reset
  double limb_degrees = 0;   // mean angle of arms and legs over the frames
  // How far planted feet would travel without the goals, over `scale` times the travel of the source. A clip on the
  // spot needs the least correction of the feet if the body moves at scale x stride times the speed of the clip.
  double stride = 1;
  double deepest_drop = 0;  // how far the hips sank so that feet reach, in units of the target
  // The height of the lowest sole above the lowest sole of the source while the source stands. It is the mean over
  // these frames, in legs of the target. Without goals it is 0.
  double hover = 0;
};

// Finds the velocity of the soles where they touch the ground. It is 0 if the clip travels. poses: `count` frames of 10
// numbers per joint, `seconds` apart.
void find_ground_velocity(const RetargetSide& source, const double* poses, std::uint32_t count, double seconds,
                          double velocity[3], Memory& memory);

class Retargeter;

class Retarget {
 public:
  // Throws Error: a character does not belong to its input (index = joint), no joint has a partner, an option is out of
  // range.
  Retarget(const RetargetSide& source, const RetargetSide& target, const RetargetOptions& options, Memory& memory);
  ~Retarget();
  Retarget(Retarget&&) noexcept;
  Retarget& operator=(Retarget&&) noexcept;

  // source: the pose to follow, 10 numbers per joint of the source. target: receives 10 numbers per joint of the
  // target. seconds: the time since the last frame; 0 for the first frame and for a repeated frame. Throws Error for a
  // number that is not finite and for a rotation of length 0 (index = joint). The object is then as before.
  void frame(const double* source, double seconds, double* target);
  // Forgets the offsets of the feet and the figures of the report. Call it where the clip jumps.
  void reset() noexcept;
  const RetargetReport& report() const noexcept;
  // Writes the joint of the source that each joint of the target follows, the nearer of two. Entries of joints without
  // a partner stay.
  void partners(std::uint32_t* out) const noexcept;
  // Takes the state of the feet and the figures of a retarget that was made of the same sides and options.
  void copy_state(const Retarget& other);

 private:
  std::shared_ptr<Retargeter> self_;
};

}  // namespace hf_inner::retarget
