// The data that the steps of a retarget share.
#pragma once
#include "retarget/rig.h"

namespace hf_inner::retarget {

// A joint of the target turns as one joint of the source, or between two: across x turn x post. A limb of one bone
// turns further, to the line from root to tip of the source's limb.
struct Follow {
  Index target = -1, a = -1, b = -1;
  double share = 0;
  Turn post_a, post_b;
  Index line = -1;  // the chain pair of that limb
};

// Two chains whose bones are compared for the report, and how the bones of the target are turned at rest.
struct ChainPair {
  explicit ChainPair(Memory& memory) : source(memory), target(memory), align(&memory) {}
  Segments source, target;
  skeleton::Role role = skeleton::Role::other;
  skeleton::Side side = skeleton::Side::middle;
  Vector<Turn> align;  // of each segment of the target
  bool compared = false;
  double sum = 0, worst = 0;  // degrees, over bones and frames
};

// A foot of the target, and the foot of the source that it follows.
struct FootPair {
  explicit FootPair(Memory& memory)
      : below(&memory),
        source_was(&memory),
        target_was(&memory),
        source_now(&memory),
        target_now(&memory),
        places(&memory),
        bends(&memory) {}
  Index source = -1, target = -1;  // legs of the rigs
  bool aligned = false;
  Vec3 stance;          // from hip to foot at rest: target less source, in the axes of the target; not aligned
  Vec3 knee;            // where the knee points at rest
  double tilt = 1;      // the share of the foot's tilt that is kept
  Vector<Index> below;  // the foot and the joints below it

  // State: the offset, how far the foot is planted, and the soles of the last frame. Soles of the target are without
  // the offset.
  Vec3 offset;
  double standing = 0;  // 0 to 1
  bool known = false;
  double walked = 0,
         walked_by = 0;  // sums over planted soles: own step x scaled step of the source; the square of the latter
  Vector<Vec3> source_was, target_was;

  // Of the frame.
  Vector<Vec3> source_now, target_now;
  Vector<Vec3> places;  // ends of its segments, before the leg is bent
  Vector<Turn> bends;   // added to the turns of its segments
  double height = 0;    // of the source's sole, in its legs
  Vec3 step;            // of the source's sole since the last frame
  Vec3 knee_now;
  Vec3 goal;  // of the ankle
};

// A part of the body that stays over the ground, as far as its partner in the source does.
struct GroundPart {
  explicit GroundPart(Memory& memory)
      : arm(memory), source(&memory), target(&memory), below(&memory), places(&memory), bends(&memory) {}
  enum class Way { lift, pitch, bend } way = Way::lift;  // the body rises, the part turns up, the arm bends
  Index root = -1;                                       // where it turns
  Segments arm;
  Vector<SkinPoint> source, target;
  Vector<Index> below;  // joints that follow and hang on the root
  Vector<Vec3> places;
  Vector<Turn> bends;
};

// How joints of an equal skeleton are copied.
struct SameSkeleton {
  explicit SameSkeleton(Memory& memory) : partners(&memory) {}
  bool found = false, exact = false;
  Vector<Index> partners;  // of each joint of the target, -1: none
  double bones = 1;        // lengths of bones of the target over the source's
  Turn turn;               // of the target's world against the source's
  double scale = 1;        // of places in the world
  Index root = -1;         // of the target, above the hips
};

class Retargeter {
 public:
  Retargeter(const RetargetSide& source, const RetargetSide& target, const RetargetOptions& options, Memory& memory);
  void frame(const double* source, double seconds, double* target);
  void reset() noexcept;
  const RetargetReport& report() const noexcept { return report_; }
  void partners(std::uint32_t* out) const noexcept;
  void copy_state(const Retargeter& other);

  // The steps of creation and of a frame, in their files.
  void match_chains(const RetargetSide& source, const RetargetSide& target);  // match.cpp
  void find_scale();                                                          // frame.cpp
  void find_same(const RetargetSide& source, const RetargetSide& target);     // same.cpp
  void copy_same(const double* source, double* target);                       // same.cpp
  void turn_joints();                                                         // frame.cpp
  Turn line_turn(const Segments& limb) const;                                 // frame.cpp
  void find_root();                                                           // frame.cpp
  void move_root();                                                           // frame.cpp
  void move_travel();                                                         // frame.cpp
  void find_feet();                                                           // feet_find.cpp
  void meet_goals(double seconds);                                            // feet.cpp
  void find_parts(const RetargetSide& source, const RetargetSide& target);    // ground.cpp
  void lift_trunk();                                                          // ground.cpp
  void clear_ground();                                                        // ground.cpp
  void write_joints(double* target) const;                                    // frame.cpp
  void measure();                                                             // report.cpp
  void measure_hover();                                                       // feet.cpp

  Memory& memory;
  RetargetOptions options;
  Rig source, target;
  Turn across;  // from directions of the source to directions of the target
  Stance from, to;
  Vector<std::uint8_t> wanted;  // joints of the target that follow
  Vector<Follow> follows;
  Vector<ChainPair> pairs;
  Vector<FootPair> feet;
  Vector<GroundPart> parts;
  SameSkeleton same;
  double scale = 1;               // of travel
  double height_scale = 1;        // of heights
  Vec3 source_hips, target_hips;  // at rest
  Vec3 mover_place;
  Index root = -1;      // the topmost joint above the mover
  bool people = false;  // both stand upright: legs are aligned
  double hover_sum = 0, hover_frames = 0;
  Vector<Vec3> points;  // of one sole
  RetargetReport report_;
};

}  // namespace hf_inner::retarget
