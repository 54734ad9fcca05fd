// One human body, named and built as tools do.
#include "rig_words.h"

namespace hf_test {

const std::vector<std::string> biped_conventions = {
    "mixamo", "unreal",          "unity",      "rigify",     "rigify org", "rigify rows",
    "vrm",    "ready player me", "kaykit",     "quaternius", "biped",      "poser",
    "dots",   "words",           "portuguese", "numbers",    "none"};

namespace {

struct Builder {
  const BodyShape& shape;
  const Words& words;
  const std::string& convention;
  Rig rig;
  int root = -1, hips = -1, chest = -1, head = -1;

  bool has(const char* part) const { return words.parts.count(part) > 0; }
  std::string name(const char* part, Side side = Side::middle, int number = 0) const {
    std::string text = words.parts.at(part);
    const auto replace = [&](char c, const std::string& by) {
      if (const auto at = text.find(c); at != std::string::npos) text.replace(at, 1, by);
    };
    replace('#', side == Side::left ? words.left : words.right);
    replace('%', number > 0 ? std::to_string(number) : "");
    return text;
  }

  void trunk() {
    const double hip = 0.95 * shape.leg;
    if (has("root")) root = rig.add_helper(name("root"), -1, {0, 0, 0});
    if (convention == "rigify rows") root = rig.add_helper("root", -1, {0, 0, 0});
    hips = rig.add(name("hips"), root, {0, hip + 0.05, 0}, Role::spine);
    rig.add_block(hips, {-0.16, hip - 0.06, -0.1}, {0.16, hip + 0.1, 0.1});
    int last = hips;
    for (int k = 0; k < shape.spine; ++k) {
      const double y = hip + 0.12 + 0.36 * k / shape.spine;
      last = rig.add(name("spine", Side::middle, k + 1), last, {0, y, -0.01}, Role::spine);
      rig.add_block(last, {-0.17, y, -0.1}, {0.17, y + 0.36 / shape.spine, 0.11});
    }
    chest = last;
    const int skin_chest = chest;
    if (convention == "rigify rows") second_row();
    const double top = hip + 0.5;
    if (has("neck")) {
      last = rig.add(name("neck"), skin_chest, {0, top, -0.01}, Role::neck);
      rig.add_block(last, {-0.06, top, -0.06}, {0.06, top + 0.08, 0.05});
    }
    head = rig.add(name("head"), last, {0, top + 0.08, 0}, Role::head);
    const double s = shape.head;
    rig.add_block(head, {-0.09 * s, top + 0.08, -0.09 * s}, {0.09 * s, top + 0.08 + 0.25 * s, 0.11 * s});
    if (has("headend")) rig.add_helper(name("headend"), head, {0, top + 0.08 + 0.25 * s, 0});
    if (has("hair")) {
      rig.joints[static_cast<std::size_t>(rig.add(name("hair"), head, {0, top + 0.2, -0.09 * s}, Role::other))].judged =
          false;
      rig.add_block(static_cast<int>(rig.joints.size()) - 1, {-0.05, top - 0.2, -0.13 * s},
                    {0.05, top + 0.2, -0.1 * s});
    }
    for (const Side side : {Side::left, Side::right}) {
      if (!has("eye")) continue;
      const double x = (side == Side::left ? 1 : -1) * 0.04 * s;
      const int eye = rig.add(name("eye", side), head, {x, top + 0.08 + 0.12 * s, 0.09 * s}, Role::eye, side);
      rig.add_block(eye, {x - 0.01, top + 0.07 + 0.12 * s, 0.09 * s}, {x + 0.01, top + 0.09 + 0.12 * s, 0.115 * s});
    }
  }

  // A row of bones without skin beside those of the trunk, on which arms and legs hang. The bones of the skin carry the
  // head.
  void second_row() {
    const int first = hips, last = chest;
    int above = root;
    for (int j = first; j <= last; ++j) {
      const RigJoint by = rig.joints[static_cast<std::size_t>(j)];
      above = rig.add("ORG" + by.name.substr(3), above, by.pivot, Role::spine);
      if (j == first) hips = above;
    }
    chest = above;
  }

  // A twist in the chain halves the bone; one beside it hangs on the bone.
  int bone(const char* part, Side side, int parent, Vec3 from, Vec3 to, Role role, double wide) {
    int joint = rig.add(name(part, side), parent, from, role, side);
    const std::string more = std::string(part) + "+";
    if (!has(more.c_str())) {
      rig.add_box(joint, from, to, wide);
      return joint;
    }
    const Vec3 middle = 0.5 * (from + to);
    rig.add_box(joint, from, middle, wide);
    joint = rig.add(name(more.c_str(), side), joint, middle, role, side);
    rig.add_box(joint, middle, to, wide);
    return joint;
  }

  void twist(const char* part, Side side, int on, Vec3 from, Vec3 to, double place, Role role, double wide) {
    if (!has(part)) return;
    const int joint = rig.add(name(part, side), on, from + place * (to - from), role, side);
    rig.add_box(joint, from + 0.5 * (to - from), from + 0.9 * (to - from), 1.1 * wide);
  }

  void arm(Side side) {
    const double s = side == Side::left ? 1 : -1, y = 0.95 * shape.leg + 0.44, a = shape.arm;
    const Vec3 shoulder{s * 0.19, y, 0}, elbow{s * (0.19 + 0.27 * a), y, -0.01}, wrist{s * (0.19 + 0.52 * a), y, 0};
    int parent = chest;
    if (has("collar")) {
      parent = rig.add(name("collar", side), chest, {s * 0.05, y, 0}, Role::shoulder, side);
      rig.add_box(parent, {s * 0.06, y, 0}, shoulder, 0.05);
    }
    const int upper = bone("arm", side, parent, shoulder, elbow, Role::arm, 0.045);
    twist("twist", side, upper, shoulder, elbow, 0.0, Role::arm, 0.045);
    const int lower = bone("forearm", side, upper, elbow, wrist, Role::arm, 0.04);
    twist("twist2", side, lower, elbow, wrist, 0.9, Role::arm, 0.04);
    const int hand = rig.add(name("hand", side), lower, wrist, Role::hand, side);
    rig.add_box(hand, wrist, wrist + Vec3{s * 0.09, 0, 0}, 0.03);
    for (const auto& [first, second, z] : {std::tuple{"thumb1", "thumb2", 0.04}, std::tuple{"index1", "index2", 0.0}}) {
      if (!has(first)) continue;
      const Vec3 p = wrist + Vec3{s * (z > 0 ? 0.03 : 0.09), 0, z}, q = p + Vec3{s * 0.04, 0, z > 0 ? 0.02 : 0.0};
      const int f = rig.add(name(first, side), hand, p, Role::finger, side);
      rig.add_box(f, p, q, 0.01);
      rig.add_box(rig.add(name(second, side), f, q, Role::finger, side), q, q + Vec3{s * 0.03, 0, 0}, 0.01);
    }
    if (shape.rest != Rest::t)
      rig.turn(upper - (has("arm+") ? 1 : 0), {0, 0, 1}, s * (shape.rest == Rest::a ? -45 : -70));
  }

  void leg(Side side) {
    const double s = side == Side::left ? 1 : -1, l = shape.leg, x = s * (0.1 + shape.aside);
    const Vec3 hip{s * 0.1, 0.95 * l, 0}, knee{x, 0.5 * l, 0.02}, ankle{x, 0.08, -0.02}, ball{x, 0.03, 0.11};
    int on = hips;
    if (has("buttock")) {
      const Vec3 above = hip + Vec3{0, 0.02 * l, 0};
      on = rig.add(name("buttock", side), hips, above, Role::shoulder, side);
      rig.add_box(on, above, hip, 0.06);
    }
    const int thigh = bone("thigh", side, on, hip, knee, Role::leg, 0.065);
    twist("twist3", side, thigh, hip, knee, 0.4, Role::leg, 0.065);
    const int shin = bone("shin", side, thigh, knee, ankle, Role::leg, 0.05);
    const int foot = rig.add(name("foot", side), convention == "quaternius" ? root : shin, ankle, Role::foot, side);
    const double front = has("toe") ? 0.11 : 0.18;
    rig.add_block(foot, {x - 0.045, 0, -0.08}, {x + 0.045, 0.09, front});
    if (has("toe")) {
      const int toe = rig.add(name("toe", side), foot, ball, Role::toe, side);
      rig.add_block(toe, {x - 0.045, 0, 0.11}, {x + 0.045, 0.05, 0.18});
      if (has("toeend")) rig.add_helper(name("toeend", side), toe, {x, 0.02, 0.18});
    }
    if (shape.rest != Rest::crouched || convention == "quaternius") return;
    const int upper = thigh - (has("thigh+") ? 1 : 0), lower = shin - (has("shin+") ? 1 : 0);
    rig.turn(upper, {1, 0, 0}, -50);
    rig.turn(lower, {1, 0, 0}, 75);
    rig.turn(foot, {1, 0, 0}, -25);
  }

  // Controls: roots, IK targets, poles, mechanism bones; some point upward, as the heel rolls of KayKit.
  void controls() {
    if (convention == "mixamo" || convention == "unity" || convention == "words") return;
    const int top = root >= 0 ? root : rig.add_helper("root", -1, {0, 0, 0});
    for (const Side side : {Side::left, Side::right}) {
      const double s = side == Side::left ? 1 : -1;
      const std::string l = side == Side::left ? "l" : "r", u = side == Side::left ? "L" : "R";
      const int heel = rig.add_helper("control-heel-roll." + l, top, {s * 0.1, 0, -0.08});
      rig.add_helper("control-toe-roll." + l, heel, {s * 0.1, 0.3, 0.18});
      rig.add_helper("knee_pole." + u, rig.add_helper("foot_ik." + u, top, {s * 0.1, 0.08, -0.02}),
                     {s * 0.1, 0.6, 0.6});
      rig.add_helper("MCH-hand_ik." + u, top, {s * 0.7, 1.4, 0});
      rig.add_helper("ik_hand_" + l, top, {s * 0.6, 1.3, 0.1});
    }
  }

  // The tree of a Rigify rig carries nothing: each of its bones has a child that deforms.
  void move_skin_to_children() {
    const std::size_t count = rig.joints.size();
    std::vector<int> child(count, -1);
    for (std::size_t j = 0; j < count; ++j) {
      if (rig.joints[j].name.rfind("ORG-", 0) != 0) continue;
      RigJoint copy = rig.joints[j];
      copy.name.replace(0, 3, "DEF");
      copy.parent = static_cast<int>(j);
      child[j] = static_cast<int>(rig.joints.size());
      rig.joints.push_back(copy);
    }
    for (int& owner : rig.owners)
      owner = child[static_cast<std::size_t>(owner)] >= 0 ? child[static_cast<std::size_t>(owner)] : owner;
  }

  void rename() {
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
      if (convention == "none") rig.joints[j].name = "";
      if (convention == "numbers") rig.joints[j].name = "Bone." + std::to_string(j);
      if (convention == "vrm" && rig.joints[j].judged) rig.joints[j].declared = true;
    }
  }
};

}  // namespace

Rig make_biped(const std::string& convention, const BodyShape& shape) {
  Builder builder{shape, words_of(convention == "rigify rows" ? "rigify" : convention), convention, {}};
  builder.trunk();
  for (const Side side : {Side::left, Side::right}) {
    builder.arm(side);
    builder.leg(side);
  }
  builder.controls();
  if (convention == "rigify org") builder.move_skin_to_children();
  builder.rename();
  return builder.rig;
}

}  // namespace hf_test
