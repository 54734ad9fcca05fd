// Bodies of other plans, of known truth.
#include "rig_family.h"

namespace hf_test {

const std::vector<std::string> beasts = {"horse",  "fox with hands", "horse of backs", "bird",
                                         "spider", "fish",           "snake",          "tyrannosaur"};

namespace {

struct Beast {
  bool named;
  Rig rig;
  std::string text(const std::string& name) const { return named ? name : std::string(); }

  int central(const std::string& name, int parent, Vec3 from, Vec3 to, Role role, double wide) {
    const int joint = rig.add(text(name), parent, from, role);
    rig.add_box(joint, from, to, wide);
    return joint;
  }

  struct Part {
    std::string name;
    Role role;
    Vec3 pivot;  // of the left side
  };
  // Joints of a limb on both sides; the last part ends at `tip`.
  void limb(int parent, const std::vector<Part>& parts, Vec3 tip, double wide, bool block = false) {
    for (const Side side : {Side::left, Side::right}) {
      const auto placed = [&](Vec3 p) { return side == Side::left ? p : Vec3{-p.x, p.y, p.z}; };
      int last = parent;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const Vec3 a = placed(parts[k].pivot), b = placed(k + 1 < parts.size() ? parts[k + 1].pivot : tip);
        last = rig.add(text(parts[k].name + (side == Side::left ? ".L" : ".R")), last, a, parts[k].role, side);
        if (block && k + 1 == parts.size())
          rig.add_block(last, {a.x - wide, 0, a.z - 0.5 * wide}, {a.x + wide, a.y + wide, a.z + 2.5 * wide});
        else
          rig.add_box(last, a, b, wide);
      }
    }
  }

  // backs: legs have the name of the back on which they hang, as where a rig was grown by extruding bones.
  void four_legs(bool hands, bool backs = false) {
    const int root = rig.add_helper(text("root"), -1, {0, 0, 0});
    const int hips = central("Hips", root, {0, 1.2, -0.5}, {0, 1.2, -0.2}, Role::spine, 0.17);
    const int spine = central("Spine1", hips, {0, 1.22, -0.2}, {0, 1.2, 0.2}, Role::spine, 0.18);
    const int chest = central("Chest", spine, {0, 1.2, 0.2}, {0, 1.2, 0.5}, Role::spine, 0.17);
    const int neck = central("Neck", chest, {0, 1.35, 0.5}, {0, 1.75, 0.8}, Role::neck, 0.09);
    const int head = central("Head", neck, {0, 1.75, 0.8}, {0, 1.6, 1.15}, Role::head, 0.1);
    limb(head, {{"Ear", Role::ear, {0.07, 1.85, 0.8}}}, {0.09, 2.0, 0.8}, 0.02);
    const int tail = central("Tail1", hips, {0, 1.25, -0.62}, {0, 1.0, -0.85}, Role::tail, 0.04);
    central("Tail2", tail, {0, 1.0, -0.85}, {0, 0.7, -0.95}, Role::tail, 0.03);
    if (backs) {
      limb(chest,
           {{"Back.001", Role::leg, {0.15, 1.0, 0.4}},
            {"Back.002", Role::leg, {0.15, 0.55, 0.35}},
            {"f_hoof", Role::foot, {0.15, 0.12, 0.4}}},
           {0.15, 0, 0.5}, 0.05, true);
      limb(hips,
           {{"Back", Role::leg, {0.15, 1.05, -0.5}},
            {"Back.011", Role::leg, {0.15, 0.75, -0.4}},
            {"Back.012", Role::leg, {0.15, 0.45, -0.62}},
            {"b_hoof", Role::foot, {0.15, 0.12, -0.55}}},
           {0.15, 0, -0.5}, 0.05, true);
      return;
    }
    if (hands) {
      limb(chest,
           {{"UpperArm", Role::leg, {0.15, 1.0, 0.4}},
            {"ForeArm", Role::leg, {0.15, 0.55, 0.35}},
            {"Hand", Role::foot, {0.15, 0.12, 0.4}}},
           {0.15, 0, 0.5}, 0.05, true);
    } else {
      limb(chest,
           {{"FrontUpperLeg", Role::leg, {0.15, 1.0, 0.4}},
            {"FrontLowerLeg", Role::leg, {0.15, 0.55, 0.35}},
            {"FrontFoot", Role::foot, {0.15, 0.12, 0.4}}},
           {0.15, 0, 0.5}, 0.05, true);
    }
    limb(hips,
         {{"BackUpperLeg", Role::leg, {0.15, 1.05, -0.5}},
          {"BackLowerLeg", Role::leg, {0.15, 0.75, -0.4}},
          {"BackCannonLeg", Role::leg, {0.15, 0.45, -0.62}},
          {"BackFoot", Role::foot, {0.15, 0.12, -0.55}}},
         {0.15, 0, -0.5}, 0.05, true);
  }

  // A body on two legs; wings or short arms in front of them.
  void two_legs(bool bird) {
    const int body = central("Body", -1, {0, 1.0, -0.15}, {0, 1.15, 0.3}, Role::spine, 0.18);
    const int neck = central("Neck", body, {0, 1.2, 0.35}, {0, 1.5, 0.55}, Role::neck, 0.07);
    const int head = central("Head", neck, {0, 1.5, 0.55}, {0, 1.5, 0.95}, Role::head, 0.11);
    central("Jaw", head, {0, 1.42, 0.6}, {0, 1.36, 0.95}, Role::jaw, 0.04);
    const int tail = central("Tail1", body, {0, 1.0, -0.35}, {0, 1.0, -0.7}, Role::tail, 0.08);
    central("Tail2", tail, {0, 1.0, -0.7}, {0, 1.0, -1.2}, Role::tail, 0.05);
    limb(body,
         {{"UpperLeg", Role::leg, {0.15, 0.9, -0.1}},
          {"LowerLeg", Role::leg, {0.15, 0.55, 0.08}},
          {"Foot", Role::foot, {0.15, 0.12, -0.08}}},
         {0.15, 0, 0.1}, 0.06, true);
    if (bird)
      limb(body,
           {{"Wing1", Role::wing, {0.2, 1.2, 0.1}},
            {"Wing2", Role::wing, {0.7, 1.25, 0.1}},
            {"Wing3", Role::wing, {1.2, 1.25, 0.0}}},
           {1.7, 1.2, -0.1}, 0.03);
    else
      limb(body, {{"FrontLeg", Role::arm, {0.18, 0.95, 0.3}}, {"FrontLowerLeg", Role::arm, {0.2, 0.8, 0.4}}},
           {0.2, 0.75, 0.55}, 0.03);
  }

  // The head carries the front legs, as that of a spider does.
  void spider() {
    const int body = central("Body", -1, {0, 0.5, 0}, {0, 0.5, 0.25}, Role::spine, 0.2);
    const int head = central("Head", body, {0, 0.5, 0.3}, {0, 0.5, 0.6}, Role::head, 0.13);
    for (int k = 0; k < 4; ++k) {
      const double z = 0.3 - 0.2 * k, out = 0.9 * std::sin(0.5 + 0.7 * k), along = 0.8 * std::cos(0.5 + 0.7 * k);
      limb(k < 2 ? head : body,
           {{"Leg" + std::to_string(k + 1), Role::leg, {0.2, 0.5, z}},
            {"LegLower" + std::to_string(k + 1), Role::leg, {0.2 + 0.5 * out, 0.85, z + 0.5 * along}}},
           {0.2 + out, 0.0, z + along}, 0.03);
    }
  }

  void fish() {
    const int body = central("Body", -1, {0, 0, 0.1}, {0, 0, 0.5}, Role::spine, 0.2);
    central("Head", body, {0, 0, 0.5}, {0, 0, 0.9}, Role::head, 0.17);
    const int tail = central("Tail1", body, {0, 0, -0.2}, {0, 0, -0.6}, Role::tail, 0.12);
    central("Tail2", tail, {0, 0, -0.6}, {0, 0, -1.1}, Role::tail, 0.06);
    limb(body, {{"Fin", Role::fin, {0.2, -0.05, 0.3}}}, {0.5, -0.1, 0.1}, 0.02);
  }

  void snake() {
    int last = -1;
    for (int k = 0; k < 8; ++k) {
      const double z = 0.3 * (4 - k);
      const Role role = k == 0 ? Role::head : k < 4 ? Role::spine : Role::tail;
      last = central(k == 0  ? "Head"
                     : k < 4 ? "Spine" + std::to_string(k)
                             : "Tail" + std::to_string(k),
                     last, {0, 0.1, z}, {0, 0.1, z - 0.3}, role, k == 0 ? 0.12 : 0.1 - 0.008 * k);
    }
  }
};

}  // namespace

Rig make_beast(const std::string& kind, bool named) {
  Beast beast{named, {}};
  if (kind == "horse") beast.four_legs(false);
  if (kind == "fox with hands") beast.four_legs(true);
  if (kind == "horse of backs") beast.four_legs(false, true);
  if (kind == "bird") beast.two_legs(true);
  if (kind == "tyrannosaur") beast.two_legs(false);
  if (kind == "spider") beast.spider();
  if (kind == "fish") beast.fish();
  if (kind == "snake") beast.snake();
  return beast.rig;
}

}  // namespace hf_test
