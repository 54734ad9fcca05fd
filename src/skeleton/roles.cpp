// Gives every joint of the body its role and side.
#include <algorithm>
#include <cmath>

#include "base/principal_axes.h"
#include "base/stable_sort.h"
#include "skeleton/body.h"
#include "skeleton/parts.h"

namespace hf_inner::skeleton {
namespace {

// The third extent of a limb's vertices against the second: of a wing or a fin it is small.
double flatness(const Body& body, const Limb& limb) {
  Mat3 moments = Mat3::Zero();
  for (const Index root : limb.roots) {
    hf_eigen::Vector3d sum = hf_eigen::Vector3d::Zero();
    Mat3 squares = Mat3::Zero();
    double count = 0;
    body.for_points_below(root, [&](Vec3 p) {
      const hf_eigen::Vector3d v(p.x, p.y, p.z);
      sum += v;
      squares += v * v.transpose();
      count += 1;
    });
    if (count > 0) moments += squares - sum * sum.transpose() / count;
  }
  const hf_eigen::Vector3d m = principal_axes(moments).moment;
  return m[1] > 0 ? std::sqrt(std::max(0.0, m[2]) / m[1]) : 1;
}

// The head of a spider carries legs. Hair that reaches the ground is no leg: what has it stands upright.
bool is_leg_on_head(const Body& body, const Limb& limb) {
  return limb.named == NameClass::leg || (limb.named == NameClass::none && limb.stands && body.trunk < upright_trunk);
}

Role role_on_head(const Limb& limb) {
  switch (limb.named) {
    case NameClass::eye:
      return Role::eye;
    case NameClass::antenna:
      return Role::antenna;
    case NameClass::ear:
      return Role::ear;
    case NameClass::jaw:
      return Role::jaw;
    default:
      return Role::other;
  }
}

bool ends_in_foot(const Body& body, const Limb& limb) {
  return std::all_of(std::begin(limb.paths), std::end(limb.paths), [&](const Vector<Index>& path) {
    return std::any_of(path.begin(), path.end(), [&](Index j) { return body.named && body.names[at(j)].foot; });
  });
}

// Arms without names that reach the ground beside legs that have names: these begin lower on an upright body.
bool hangs_over_legs(const Body& body, const Limb& limb) {
  const auto height = [&](const Limb& l) { return body.height_of(body.pivots[at(l.roots[0])]); };
  return body.trunk > upright_trunk && std::any_of(body.limbs.begin(), body.limbs.end(), [&](const Limb& other) {
           return other.named == NameClass::leg && other.stands &&
                  height(limb) > height(other) + 2 * standing * body.height;
         });
}

// The only limbs without names that reach the ground, farther aside than down: no body that is not upright stands on
// them. A ray lies on its fins.
bool lies_on(const Body& body, const Limb& limb, std::size_t standing_count) {
  if (!limb.stands || standing_count != 1 || body.trunk > upright_trunk) return false;
  double aside = 0, down = 0;
  for (const auto& path : limb.paths) {
    const Vec3 way = body.pivots[at(path.back())] - body.pivots[at(path.front())];
    aside += std::fabs(dot(way, body.left));
    down -= dot(way, body.up);
  }
  return aside > down;
}

Role role_of_limb(const Body& body, const Limb& limb, std::size_t standing_count) {
  if (body.head >= 0 && body.head != body.root && body.is_below(limb.carrier, body.head))
    return is_leg_on_head(body, limb) ? Role::leg : role_on_head(limb);
  const bool large = limb.length > 0.1 * body.height, upright = body.trunk > upright_trunk;
  switch (limb.named) {
    case NameClass::wing:
      return Role::wing;
    case NameClass::fin:
      return Role::fin;
    case NameClass::ear:
      return Role::ear;
    case NameClass::eye:
      return Role::eye;
    case NameClass::antenna:
      return Role::antenna;
    case NameClass::leg:
      return Role::leg;
    // On four legs a limb that stands is a leg, even if its name says arm: the front legs of a fox have hands. A limb
    // that ends in a foot is a leg too, also while the body rears.
    case NameClass::arm:
      if (ends_in_foot(body, limb)) return Role::leg;
      return limb.stands && !upright && standing_count > 1 ? Role::leg : Role::arm;
    // A trunk does not stand on the ground. A leg can have its name if its bones were extruded from the back.
    case NameClass::trunk:
      return limb.stands ? Role::leg : Role::other;
    case NameClass::none:
    case NameClass::digit:
      break;
    default:
      return Role::other;
  }
  if (!large) return Role::other;
  if (lies_on(body, limb, standing_count)) return Role::fin;
  if (limb.stands && !hangs_over_legs(body, limb)) return Role::leg;
  if (flatness(body, limb) < 0.15 && limb.length > 0.3 && limb.paths[0].size() < 4) return Role::wing;
  return Role::arm;
}

// A limb with the name of a leg that does not stand while longer ones do is an arm: the front legs of a tyrannosaur.
bool is_raised_leg(const Body& body, const Limb& limb) {
  if (limb.role != Role::leg || limb.stands || limb.low < 2 * standing) return false;
  double longest = 0;
  for (const Limb& other : body.limbs) {
    if (other.stands && other.named == NameClass::leg) longest = std::max(longest, other.length);
  }
  return limb.length < 0.8 * longest;
}

// A limb between legs that is made like them is a leg that an insect lifts.
bool is_lifted_leg(const Body& body, const Limb& limb) {
  if (limb.role != Role::arm || limb.named != NameClass::none) return false;
  bool before = false, behind = false;
  for (const Limb& other : body.limbs) {
    if (other.role != Role::leg || other.paths[0].size() != limb.paths[0].size()) continue;
    before |= other.place > limb.place;
    behind |= other.place < limb.place;
  }
  return before && behind;
}

void assign_limb_roles(Body& body) {
  const std::size_t standing_count = static_cast<std::size_t>(
      std::count_if(body.limbs.begin(), body.limbs.end(), [](const Limb& l) { return l.stands; }));
  for (Limb& limb : body.limbs) limb.role = role_of_limb(body, limb, standing_count);
  for (Limb& limb : body.limbs) {
    if (is_raised_leg(body, limb)) limb.role = Role::arm;
  }
  for (Limb& limb : body.limbs) {
    if (is_lifted_leg(body, limb)) limb.role = Role::leg;
  }
  double longest_arm = 0;
  for (const Limb& limb : body.limbs) {
    if (limb.role == Role::arm) longest_arm = std::max(longest_arm, limb.length);
  }
  for (Limb& limb : body.limbs) {
    if (limb.role == Role::arm && 2 * limb.length < longest_arm) limb.role = Role::other;
  }
  stable_sort(
      body.limbs, [](const Limb& a, const Limb& b) { return a.place > b.place; }, body.memory);
}

void set(Body& body, Index joint, Role role) { body.roles[at(joint)] = role; }

// The hips' side: sides by place, since names may use the sides of the viewer.
void assign_sides(Body& body) {
  for (const Limb& limb : body.limbs) {
    for (int side = 0; side < 2; ++side) {
      for (const Index j : body.subtree(limb.roots[side])) body.sides[at(j)] = side == 0 ? Side::left : Side::right;
    }
  }
}

// Returns the place in the path to the head at which a limb begins: the place of a central joint. Where arms hang on a
// second row of bones, such as the controls of a Rigify rig, it is the nearest one. A pair on something at one side,
// such as a pack, does not begin there: 0.
std::size_t nearest_below_head(const Body& body, const Vector<Index>& path, Index carrier) {
  std::size_t nearest = 0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    if (path[k] == carrier) return k;
    const auto apart = [&](std::size_t i) { return norm(body.pivots[at(path[i])] - body.pivots[at(carrier)]); };
    if (apart(k) < apart(nearest)) nearest = k;
  }
  const bool aside = std::fabs(body.lateral(body.pivots[at(carrier)])) > 2 * central;
  return body.head == carrier || aside ? 0 : nearest;
}

// Arms of an upright body may hang on a control at its hips. The joints above it that lie far below the shoulders carry
// the trunk, and are no neck. Returns the last one in the path to the head, or the carrier.
std::size_t last_below_arms(const Body& body, const Vector<Index>& path, std::size_t carrier, const Limb& limb) {
  if (!(body.trunk > upright_trunk)) return carrier;
  const auto height = [&](Index j) { return body.height_of(body.pivots[at(j)]); };
  const double shoulders = std::min(height(limb.roots[0]), height(limb.roots[1]));
  std::size_t last = carrier;
  while (last + 2 < path.size() && height(path[last + 1]) < shoulders - below_shoulders * body.height) ++last;
  return last;
}

// From the root of the tree to the head: spine, and neck after the last arm or front leg, or by its name.
void assign_trunk(Body& body, Vector<std::uint8_t>& given) {
  if (body.head < 0) return;
  Vector<Index> path(&body.memory);
  for (Index j = body.head; j >= 0; j = body.carriers[at(j)]) path.push_back(j);
  std::reverse(path.begin(), path.end());
  const Limb* hind = nullptr;
  for (const Limb& limb : body.limbs) {
    if (limb.role == Role::leg) hind = &limb;  // sorted from the front
  }
  std::size_t chest = 0;
  for (const Limb& limb : body.limbs) {
    const bool fore = limb.role == Role::arm || limb.role == Role::wing || (limb.role == Role::leg && &limb != hind);
    if (!fore) continue;
    const std::size_t carrier = nearest_below_head(body, path, limb.carrier);
    chest = std::max(chest, limb.role == Role::arm ? last_below_arms(body, path, carrier, limb) : carrier);
  }
  const auto is_neck = [&](Index j) { return body.names[at(j)].named == NameClass::neck; };
  const auto named = std::find_if(path.begin(), path.end(), is_neck);
  const std::size_t first_neck = named != path.end() ? static_cast<std::size_t>(named - path.begin()) : chest + 1;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (given[at(path[k])]) continue;
    given[at(path[k])] = 1;
    set(body, path[k], path[k] == body.head ? Role::head : k >= first_neck ? Role::neck : Role::spine);
  }
}

// Whether what hangs on a joint ends in the middle, behind the hind legs.
bool leads_behind(const Body& body, Index joint, double hind_place) {
  const Index tip = body.tree[at(body.ends[at(body.places[at(joint)])]) - 1];
  return dot(body.means[at(tip)], body.forward) < hind_place - 1.5 * central &&
         std::fabs(body.lateral(body.pivots[at(tip)])) < 2 * central;
}

// A tail has the name of the spine where an animal was made of the bones of a person. Such a tail leads behind the hind
// legs, and no limb hangs on it. A part behind an upright body is on its back.
bool is_tail(const Body& body, Index joint, double hind_place) {
  const Index p = body.carriers[at(joint)];
  if (p >= 0 && body.roles[at(p)] == Role::tail) return true;
  const bool bare = std::none_of(body.limbs.begin(), body.limbs.end(),
                                 [&](const Limb& limb) { return body.is_below(limb.carrier, joint); });
  return body.trunk < upright_trunk && joint != body.root && bare && leads_behind(body, joint, hind_place);
}

Role central_role(const Body& body, Index joint, double hind_place) {
  const bool on_head = body.head >= 0 && body.head != body.root && body.is_below(joint, body.head);
  switch (body.names[at(joint)].named) {
    case NameClass::jaw:
      return Role::jaw;
    case NameClass::tail:
      return Role::tail;
    case NameClass::neck:
      return Role::neck;
    case NameClass::trunk:
      return on_head ? Role::other : is_tail(body, joint, hind_place) ? Role::tail : Role::spine;
    case NameClass::wing:
      return Role::wing;
    case NameClass::fin:
      return Role::fin;
    case NameClass::eye:
      return Role::eye;
    case NameClass::ear:
      return Role::ear;
    case NameClass::antenna:
      return Role::antenna;
    case NameClass::none:
      break;
    default:
      return Role::other;
  }
  if (on_head) return Role::other;
  const Index p = body.carriers[at(joint)];
  if (p >= 0 && (body.roles[at(p)] == Role::tail)) return Role::tail;
  if (body.head == body.root) return Role::spine;
  return leads_behind(body, joint, hind_place) ? Role::tail : Role::other;
}

void assign_rest(Body& body, Vector<std::uint8_t>& given) {
  double hind = dot(body.pivots[at(body.root)], body.forward);
  for (const Limb& limb : body.limbs) {
    if (limb.role == Role::leg) hind = limb.place;
  }
  for (const Index j : body.tree) {
    if (given[at(j)]) continue;
    given[at(j)] = 1;
    const Index p = body.carriers[at(j)];
    const bool loose_parent = p >= 0 && body.roles[at(p)] == Role::other && body.names[at(j)].named == NameClass::none;
    set(body, j, j == body.root ? Role::spine : loose_parent ? Role::other : central_role(body, j, hind));
  }
}

// Declared roles win; joints along a bone get its role. The sides of a pair follow from its places, because a
// declaration may be older than a mirroring of the body.
void take_declared_roles(Body& body) {
  for (Index j = 0; j < body.count; ++j) {
    const Index p = body.carriers[at(j)];
    if (body.kinds[at(j)] == JointKind::twist && p >= 0) {
      body.roles[at(j)] = body.roles[at(p)];
      body.sides[at(j)] = body.sides[at(p)];
    }
  }
  for (std::size_t j = 0; body.input.roles && j < at(body.count); ++j) {
    if (body.input.roles[j] < 0) continue;
    body.roles[j] = static_cast<Role>(body.input.roles[j]);
    if (body.input.sides && body.mates[j] < 0) body.sides[j] = static_cast<Side>(body.input.sides[j]);
  }
}

// Clothes and held things have no role. Like a tail or a wing they may hang lower than the feet.
bool hangs(Role role) {
  return role == Role::other || role == Role::tail || role == Role::wing || role == Role::fin || role == Role::ear ||
         role == Role::antenna;
}

// The feet of a body are at the ground, and parts that hang on it are not.
void find_ground(Body& body) {
  double feet = 1e300, trunk = 1e300;
  for (std::size_t v = 0; v < body.points.size(); ++v) {
    const Index owner = body.owners[v];
    if (owner < 0) continue;
    const Role role = body.roles[at(owner)];
    const bool arm = role == Role::arm || role == Role::hand || role == Role::finger;
    if (hangs(role) || (arm && body.trunk > upright_trunk)) continue;
    double& low = role == Role::leg || role == Role::foot || role == Role::toe ? feet : trunk;
    low = std::min(low, dot(body.points[v], body.up));
  }
  // A body that stands on its hands or lies has its trunk below its feet.
  if (feet < trunk + standing * body.height) body.ground = std::max(body.ground, std::min(feet, trunk));
}

}  // namespace

void assign_roles(Body& body) {
  const std::size_t n = at(body.count);
  body.roles.assign(n, Role::other);
  body.sides.assign(n, Side::middle);
  Vector<std::uint8_t> given(n, 0, &body.memory);
  assign_limb_roles(body);
  assign_sides(body);
  for (const Limb& limb : body.limbs) {
    for (int side = 0; side < 2; ++side) {
      for (const Index j : body.subtree(limb.roots[side])) {
        set(body, j, limb.role);
        given[at(j)] = 1;
      }
      if (limb.role == Role::leg) assign_leg(body, limb, side);
      if (limb.role == Role::arm) assign_arm(body, limb, side);
    }
  }
  assign_trunk(body, given);
  assign_rest(body, given);
  take_declared_roles(body);
  find_ground(body);
}

}  // namespace hf_inner::skeleton
