// Bodies of known truth in the conventions of many tools: joints, names, helpers, a skin of boxes.
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "skeleton/character.h"

namespace hf_test {

using hf_inner::Vec3;
using hf_inner::skeleton::Role;
using hf_inner::skeleton::Side;

struct RigJoint {
  std::string name;
  int parent = -1;
  Vec3 pivot;
  Role role = Role::other;
  Side side = Side::middle;
  bool helper = false;    // carries nothing
  bool judged = true;     // its role is part of the truth
  bool declared = false;  // as in a VRM file
};

// Axes before placing: y up, z forward, x left.
struct Rig {
  std::vector<RigJoint> joints;
  std::vector<Vec3> points;
  std::vector<int> owners;
  std::vector<std::uint32_t> triangles;

  int add(const std::string& name, int parent, Vec3 pivot, Role role, Side side = Side::middle);
  int add_helper(const std::string& name, int parent, Vec3 pivot);
  // A box about the line from a to b, of half widths x and z, that a joint owns.
  void add_box(int owner, Vec3 a, Vec3 b, double wide);
  // An upright box between two corners.
  void add_block(int owner, Vec3 low, Vec3 high);
  // Turns what hangs on a joint, and its vertices, about it.
  void turn(int joint, Vec3 axis, double degrees);
  int find(const std::string& name) const;
};

// Where a rig stands: scaled, turned about y, put on its own up axis, mirrored.
struct Placing {
  double scale = 1, yaw = 0;  // degrees
  bool z_up = false, mirrored = false;
  Vec3 offset;
  Vec3 operator()(Vec3 p) const;  // a place
  Vec3 along(Vec3 v) const;       // a direction
};

// The arrays of a placed rig, and its truth.
struct PlacedRig {
  std::vector<const char*> names;
  std::vector<std::int32_t> parents, vertex_joints, roles, sides;
  std::vector<double> matrices, positions;
  std::vector<std::uint32_t> triangles;
  const Rig& rig;
  Placing placing;
  bool any_declared = false;
  PlacedRig(const Rig& given, const Placing& place);
  hf_inner::skeleton::CharacterInput input() const;
  // What is wrong with a result, or nothing. roles: axes alone are judged otherwise.
  std::string faults(const hf_inner::skeleton::Character& found, bool judge_roles = true) const;
};

enum class Rest { t, a, crouched };
struct BodyShape {
  double leg = 1, arm = 1, head = 1;
  int spine = 3;
  Rest rest = Rest::t;
  double aside = 0;  // knees and feet stand this much further out than the hips
};

extern const std::vector<std::string> biped_conventions;
Rig make_biped(const std::string& convention, const BodyShape& shape);

extern const std::vector<std::string> beasts;
Rig make_beast(const std::string& kind, bool named);

}  // namespace hf_test
