#include "skeleton/parts.h"

#include <algorithm>
#include <cmath>

#include "skeleton/legs.h"

namespace hf_inner::skeleton {
namespace {

double bone(const Body& body, const Vector<Index>& path, std::size_t k) {
  return norm(body.pivots[at(path[k + 1])] - body.pivots[at(path[k])]);
}

void set_from(Body& body, const Vector<Index>& path, std::size_t first, std::size_t last, Role role) {
  for (std::size_t k = first; k < last && k < path.size(); ++k) body.roles[at(path[k])] = role;
}

// Gives a role to the joints that hang on a limb but are not on its path. Below the hand or foot, `end`, they are
// fingers or toes, if their names do not say that they are loose. Higher up they are none, such as a holster.
void set_digits(Body& body, const Limb& limb, int side, std::size_t end, Role role) {
  const auto& path = limb.paths[side];
  const std::size_t first = std::min(end, path.size() - 1);
  for (const Index j : body.subtree(limb.roots[side])) {
    if (std::find(path.begin(), path.end(), j) != path.end()) continue;
    const bool digit = body.names[at(j)].named != NameClass::loose && body.is_below(j, path[first]);
    body.roles[at(j)] = digit ? role : Role::other;
  }
}

// The place of the foot: its name, else the ankle; the length of the path: there is none.
std::size_t find_foot(const Body& body, const Vector<Index>& path, std::size_t first) {
  const auto is_foot = [&](Index j) { return body.named && body.names[at(j)].foot; };
  if (!std::all_of(path.begin(), path.end(), is_foot)) {  // "foot" in every name: it is the limb's
    for (std::size_t k = first + 1; k < path.size(); ++k) {
      if (is_foot(path[k])) return k;
    }
  }
  const std::size_t ankle = ankle_of(body, path, first);
  return ankle > first && !body.names[at(path[ankle])].twist ? ankle : path.size();
}

// A collar bone: by its name, else the first of three bones before the hand, or of more if it is below .6 of the
// second.
bool has_collar(const Body& body, const Limb& limb, const Vector<Index>& path, std::size_t hand) {
  const JointName& first = body.names[at(path[0])];
  if (body.named && path.size() > 2 && (first.named == NameClass::trunk || first.collar)) return true;
  if (hand > 1 && leads_out(body, limb)) return true;
  if (hand > 2 && limb.named == NameClass::leg && has_hip_bone(body, limb)) return true;        // a raised leg
  const bool says_nothing = first.named == NameClass::none || first.named == NameClass::loose;  // a sleeve carries it
  if (!says_nothing || hand < 3) return false;
  return hand == 3 || bone(body, path, 0) < 0.6 * bone(body, path, 1);
}

// Returns the place of the hand in the path of an arm: the first joint with its name, else the last joint before
// fingers. The length of the path means that the arm has no hand, as an arm of two joints.
std::size_t find_hand(const Body& body, const Limb& limb, const Vector<Index>& path) {
  const std::size_t collars = leads_out(body, limb) ? 1 : 0;
  for (std::size_t k = 0; k < path.size() && body.named; ++k) {
    if (!body.names[at(path[k])].hand) continue;
    if (k == 0) return path.size();  // a hand on the trunk is the whole arm
    // A hand that is longer than the arm above it is a forearm: the second of two bones was named by its end.
    const bool forearm =
        k == collars + 1 && k + 1 == path.size() && body.reaches[at(path[k])] > bone(body, path, k - 1);
    return forearm ? path.size() : k;
  }
  const Index last = path.back();
  const auto fingers = body.children_of(last);
  if (body.named && body.names[at(last)].lower) return path.size();
  if (fingers.empty() && path.size() <= collars + 2) return path.size();
  // Fingers that start far from the last joint start at a wrist without a joint.
  if (!fingers.empty() && path.size() > 1) {
    double nearest = 1e300;
    for (const Index c : fingers) nearest = std::min(nearest, norm(body.pivots[at(c)] - body.pivots[at(last)]));
    if (nearest > branching * bone(body, path, path.size() - 2)) return path.size();
  }
  return path.size() - 1;
}

}  // namespace

void assign_leg(Body& body, const Limb& limb, int side) {
  const auto& path = limb.paths[side];
  const JointName& first_name = body.names[at(path[0])];
  // A joint of the pelvis or a shoulder blade above the leg. If the whole leg has the name of the trunk, the name
  // does not tell pelvis and leg apart.
  const bool pelvis = first_name.named == NameClass::trunk && limb.named != NameClass::trunk;
  // Shoulder, elbow and foot are a whole leg: then the shoulder is the thigh.
  const bool blade = first_name.collar && body.named && path.size() > 3;
  const bool named = (pelvis && path.size() > 2) || blade;
  const std::size_t first = named ? 1 : thigh_of(body, limb);
  const std::size_t foot = find_foot(body, path, first);
  set_digits(body, limb, side, foot, Role::toe);
  set_from(body, path, 0, first, Role::shoulder);
  set_from(body, path, first, foot, Role::leg);
  set_from(body, path, foot, foot + 1, Role::foot);
  set_from(body, path, foot + 1, path.size(), Role::toe);
}

void assign_arm(Body& body, const Limb& limb, int side) {
  const auto& path = limb.paths[side];
  const std::size_t hand = find_hand(body, limb, path), first = has_collar(body, limb, path, hand) ? 1 : 0;
  set_digits(body, limb, side, hand, Role::finger);
  set_from(body, path, 0, first, Role::shoulder);
  set_from(body, path, first, hand, Role::arm);
  set_from(body, path, hand, hand + 1, Role::hand);
  set_from(body, path, hand + 1, path.size(), Role::finger);
}

}  // namespace hf_inner::skeleton
