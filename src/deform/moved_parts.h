// Finds the joint, the role and the part of a region of the mesh, from the skin of a character.
//
// A joint also moves the vertices that the joints below it move. The joint of a region is the lowest joint that moves
// more than half of it: a hand, not one of its fingers. The role of a region is the role that has most of its weights.
// A joint without a role takes the role of the limb it hangs on.
//
// A part is a head with jaw and eyes, a hand with its fingers, or a foot with its toes. A vertex belongs to the part
// that has more than half of its weight. The pinned trunk becomes a part too (add_trunk). Cost: a pass over the weights
// when it is made; a pass over the joints for each region. Throws only if memory runs out.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "skeleton/known_skeleton.h"
#include "surface/core.h"

namespace hf_inner::deform {

constexpr std::uint32_t no_joint = 0xffffffffu;

struct BodyRole {
  skeleton::Role role = skeleton::Role::other;
  skeleton::Side side = skeleton::Side::middle;
};

class MovedParts {
 public:
  // If the skeleton has a skin, the skin has the vertices of the caller's mesh. Both arguments outlive this object.
  MovedParts(const surface::Core& core, const skeleton::KnownSkeleton& known);

  // Whether roles are known well enough to decide which handles are pinned.
  bool knows_roles() const noexcept;
  // Returns no_joint where no joint moves more than half of the region.
  std::uint32_t joint_of(Span<const std::int32_t> region);
  // The role and side of a joint, or of the limb it hangs on.
  BodyRole role_of(std::uint32_t joint) const noexcept {
    return joint == no_joint ? BodyRole() : BodyRole{role_[joint], side_[joint]};
  }
  // Returns the role and side that have most of the weights in a region.
  BodyRole main_role_of(Span<const std::int32_t> region) const noexcept;
  // Whether a limb of this role moves freely: an arm, a head, a tail. stands: the limb is on the ground. Arms of a body
  // that is not upright may then be front legs, and do not move freely.
  bool hangs_free(skeleton::Role role, bool stands) const noexcept;
  // The chain (skeleton/character.h) of a joint, or of the joint it hangs on; -1: none.
  std::int32_t chain_of(std::uint32_t joint) const noexcept { return joint == no_joint ? -1 : chain_[joint]; }
  // Whether a foot hangs on a chain.
  bool has_foot(std::int32_t chain) const noexcept { return chain >= 0 && has_foot_[static_cast<std::size_t>(chain)]; }
  // Whether no joint of the skin moves most of a region: the box of a control.
  bool is_unmoved(Span<const std::int32_t> region) const noexcept;
  // Whether the mesh has vertices that no joint of the skin moves.
  bool has_unmoved() const noexcept { return has_unmoved_; }

  std::size_t part_count() const noexcept { return part_role_.size(); }
  // The part that has more than half of the vertices of a region, or -1.
  std::int32_t part_of(Span<const std::int32_t> region) const;
  Span<const std::int32_t> vertices_of(std::size_t part) const noexcept {
    return {vertex_.data() + start_[part], static_cast<std::size_t>(start_[part + 1] - start_[part])};
  }
  BodyRole role_of_part(std::size_t part) const noexcept { return {part_role_[part], side_[part_joint_[part]]}; }
  // The joint that the part begins with.
  std::uint32_t joint_of_part(std::size_t part) const noexcept { return part_joint_[part]; }
  // Adds a part of the role spine and returns its number. vertices: ascending, in no part yet.
  std::int32_t add_trunk(Span<const std::int32_t> vertices);
  // Whether the spine moves a vertex, and no head, hand or foot is within free_rings edges or a link of it. So a neck
  // between a pinned trunk and a head stays free.
  bool is_of_spine(std::int32_t vertex) const noexcept {
    return beside_[static_cast<std::size_t>(vertex)] == 0 && main_role_of({&vertex, 1}).role == skeleton::Role::spine;
  }
  // Whether the vertex is one that the chest of an upright body moves: the last joint of the spine before neck or head,
  // or a shoulder. Without it a head that is dragged draws the chest to a neck. free_rings as above.
  bool is_of_chest(std::int32_t vertex) const noexcept {
    return !beside_[static_cast<std::size_t>(vertex)] && is_chest(vertex);
  }
  // Whether joints of the spine move most of a vertex, and not what hangs on them, as a cape.
  bool is_in_trunk(std::int32_t vertex) const noexcept;
  // Where the head of an upright body is linked to the chest, the mean. NULL if there is a neck or an edge between
  // them.
  const Vec3* head_on_chest() const noexcept { return head_on_chest_ ? &head_base_ : nullptr; }
  // The part of a joint, or -1.
  std::int32_t part_of_joint(std::uint32_t joint) const noexcept { return joint_part_[joint]; }

 private:
  void read_roles();
  void read_chains();
  void take_necks();
  void find_unmoved();
  void find_vertices();
  void find_beside();
  void find_chest();
  void find_head_base();
  bool is_chest(std::int32_t vertex) const noexcept;
  // Calls visit(joint, weight) for the joints of an inner vertex.
  template <class Visit>
  void for_joints(std::int32_t v, Visit&& visit) const;

  const surface::Core& core_;
  const skeleton::KnownSkeleton& known_;
  Memory& memory_;
  Vector<std::uint32_t> order_;  // joints, parents first
  Vector<skeleton::Role> role_;  // by joint, inherited where a joint has none
  Vector<skeleton::Side> side_;
  Vector<std::int32_t> chain_, joint_part_;
  Vector<skeleton::Role> part_role_;  // head, hand, foot or spine
  Vector<std::uint32_t> part_joint_;
  Vector<std::uint8_t> has_foot_;  // by chain
  Vector<std::uint8_t> unmoved_;   // by inner vertex
  bool has_unmoved_ = false;
  Vector<std::int32_t> vertex_part_;     // by inner vertex, or -1
  Vector<std::uint8_t> beside_;          // by inner vertex: 1 in a part, and free_rings edges or a link around it
  Vector<std::int32_t> start_, vertex_;  // vertices of part p: vertex_[start_[p] .. start_[p + 1])
  Vector<std::uint8_t> chest_;           // by joint
  Vector<double> moved_;                 // by joint: scratch of joint_of
  bool head_on_chest_ = false;
  Vec3 head_base_;
};

}  // namespace hf_inner::deform
