// Handles proposed for a character: its skeleton names them, says what holds, and gives a head or a hand as a whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assets/creature.h"
#include "hf/hf.hpp"
#include "support/creature.h"

namespace {

using samples::Creature;

constexpr uint32_t slots = 4;

// A creature of samples/assets as arrays of a host, which tests change.
struct Host {
  std::vector<float> positions, weights, rest, binds;
  std::vector<uint32_t> triangles, joints, parents;
  std::vector<std::string> names;

  explicit Host(const char* name, uint32_t vertices = 3000) {
    const Creature& made = hf_test::creature(name, vertices);
    positions = made.positions;
    triangles = made.triangles;
    for (uint32_t v = 0; v < made.vertex_count(); ++v) {
      joints.insert(joints.end(), made.joints[v].begin(), made.joints[v].end());
      weights.insert(weights.end(), made.weights[v].begin(), made.weights[v].end());
    }
    const std::vector<double> world = samples::rest_pose(made);
    for (size_t j = 0; j < made.skeleton.size(); ++j) {
      const samples::Joint& joint = made.skeleton[j];
      add_joint(joint.name, joint.parent < 0 ? HF_NO_INDEX : static_cast<uint32_t>(joint.parent), joint.translation);
      std::fill_n(binds.end() - 16, 16, 0.0f);
      for (size_t c = 0; c < 4; ++c) binds[16 * j + 5 * c] = 1;
      for (size_t c = 0; c < 3; ++c) binds[16 * j + 12 + c] = -static_cast<float>(world[16 * j + 12 + c]);
    }
  }
  // A joint that no skin names.
  uint32_t add_joint(const std::string& name, uint32_t parent, const std::array<double, 3>& place) {
    names.push_back(name);
    parents.push_back(parent);
    for (const double p : place) rest.push_back(static_cast<float>(p));
    rest.insert(rest.end(), {0, 0, 0, 1, 1, 1, 1});
    binds.insert(binds.end(), 16, 0.0f);
    return static_cast<uint32_t>(names.size() - 1);
  }
  uint32_t joint(const std::string& name) const {
    return static_cast<uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
  // A closed box of 8 vertices that one joint moves.
  void add_box(const std::array<float, 3>& middle, float half, uint32_t joint_number) {
    const uint32_t first = vertex_count();
    for (uint32_t k = 0; k < 8; ++k) {
      for (size_t c = 0; c < 3; ++c) positions.push_back(middle[c] + (k >> c & 1 ? half : -half));
      joints.insert(joints.end(), {joint_number, 0, 0, 0});
      weights.insert(weights.end(), {1, 0, 0, 0});
    }
    constexpr uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      for (const uint32_t k : {f[0], f[1], f[2], f[0], f[2], f[3]}) triangles.push_back(first + k);
    }
  }
  hf::Surface surface(bool linked = false) const {
    hf_surface_desc desc = HF_INIT(hf_surface_desc);
    const std::vector<uint16_t> of(joints.begin(), joints.end());
    hf_links_desc links = HF_INIT(hf_links_desc);
    links.mode = HF_LINK_PIECES;
    links.influence_count = slots;
    links.joints = of.data();
    links.weights = weights.data();
    links.joint_parents = parents.data();
    links.joint_count = static_cast<uint32_t>(parents.size());
    if (linked) desc.links = &links;
    desc.positions = HF_ARRAY(positions.data(), vertex_count());
    desc.triangles = HF_ARRAY(triangles.data(), triangles.size() / 3);
    return hf::Surface(desc);
  }
  // The weight that the joints of a set have at a vertex.
  double weight(uint32_t v, const std::set<uint32_t>& of) const {
    double sum = 0;
    for (size_t k = slots * v; k < slots * (v + 1); ++k)
      sum += of.count(joints[k]) ? static_cast<double>(weights[k]) : 0;
    return sum;
  }
  bool is_below(uint32_t joint_number, uint32_t other) const {
    while (joint_number != HF_NO_INDEX && joint_number != other) joint_number = parents[joint_number];
    return joint_number == other;
  }
};

struct Found {
  std::vector<hf_handle_proposal> list;
  std::vector<uint32_t> regions;  // by vertex
  std::vector<hf_joint_info> joints;

  std::vector<uint32_t> region(uint32_t number) const {
    std::vector<uint32_t> out;
    for (uint32_t v = 0; v < regions.size(); ++v) {
      if (regions[v] == number) out.push_back(v);
    }
    return out;
  }
  uint32_t of_role(int32_t role, int32_t side) const {
    for (uint32_t i = 0; i < list.size(); ++i) {
      if (list[i].role == role && list[i].side == side) return i;
    }
    return HF_NO_INDEX;
  }
};

hf_skeleton skeleton_of(const Host& host, bool with_skin = true) {
  std::string names;
  for (const std::string& name : host.names) names += name + "\n";
  hf_skin_desc skin = HF_INIT(hf_skin_desc);
  skin.vertex_count = host.vertex_count();
  skin.triangle_count = static_cast<uint32_t>(host.triangles.size() / 3);
  skin.influence_count = slots;
  skin.positions = host.positions.data();
  skin.triangles = host.triangles.data();
  skin.joints = host.joints.data();
  skin.weights = host.weights.data();
  hf_skeleton_desc desc = HF_INIT(hf_skeleton_desc);
  desc.joint_count = static_cast<uint32_t>(host.names.size());
  desc.names = names.c_str();
  desc.parents = host.parents.data();
  desc.rest = host.rest.data();
  desc.inverse_binds = host.binds.data();
  if (with_skin) desc.skin = &skin;
  hf_skeleton out = nullptr;
  EXPECT_EQ(hf_skeleton_create(&desc, &out), HF_OK);
  return out;
}

Found propose(const Host& host, const hf::Surface& surface, bool with_skeleton = true) {
  Found out;
  out.regions.resize(host.vertex_count());
  out.list.resize(HF_HANDLE_LIMIT);
  out.joints.resize(host.names.size());
  const hf_skeleton skeleton = skeleton_of(host);
  uint32_t count = 0;
  EXPECT_EQ(hf_skeleton_get_joints(skeleton, static_cast<uint32_t>(out.joints.size()), out.joints.data(), &count),
            HF_OK);
  hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
  if (with_skeleton) desc.skeleton = skeleton;
  desc.out_regions = out.regions.data();
  EXPECT_EQ(hf_surface_propose_handles(surface.get(), &desc, HF_HANDLE_LIMIT, out.list.data(), &count), HF_OK);
  out.list.resize(count);
  hf_skeleton_destroy(skeleton);
  return out;
}

Found propose(const Host& host) { return propose(host, host.surface()); }

TEST(CharacterHandles, TheLowestJointThatMovesMostOfARegionNamesItAndAPartHasItsFirstJoint) {
  for (const char* name : {"biped", "horse"}) {
    SCOPED_TRACE(name);
    const Host host(name);
    const Found found = propose(host);
    ASSERT_GE(found.list.size(), 5u);
    size_t parts = 0;
    for (uint32_t i = 0; i < found.list.size(); ++i) {
      const hf_handle_proposal& proposal = found.list[i];
      EXPECT_EQ(proposal.following, proposal.pinned ? 1.0 : 0.25);
      ASSERT_NE(proposal.joint, HF_NO_INDEX);
      const hf_joint_info& info = found.joints[proposal.joint];
      if (proposal.role == HF_ROLE_HEAD || proposal.role == HF_ROLE_HAND || proposal.role == HF_ROLE_FOOT) {
        EXPECT_EQ(proposal.role, info.role);
        EXPECT_EQ(proposal.side, info.side);
        const uint32_t above = host.parents[proposal.joint];
        EXPECT_NE(found.joints[above].role, info.role) << "not the first of the part";
        ++parts;
        continue;
      }
      // by hand: the share that each joint moves with all below it
      const std::vector<uint32_t> region = found.region(i);
      uint32_t expected = HF_NO_INDEX;
      for (uint32_t j = 0; j < host.names.size(); ++j) {
        double moved = 0, all = 0;
        for (const uint32_t v : region) {
          for (size_t k = slots * v; k < slots * (v + 1); ++k) {
            const double weight = static_cast<double>(host.weights[k]);
            all += weight;
            if (host.is_below(host.joints[k], j)) moved += weight;
          }
        }
        const bool lower = expected == HF_NO_INDEX || host.is_below(j, expected);
        if (moved > 0.5 * all && lower) expected = j;
      }
      EXPECT_EQ(proposal.joint, expected);
    }
    EXPECT_EQ(parts, 5u);  // a head, and two hands or feet on each side
    for (const int32_t side : {HF_SIDE_LEFT, HF_SIDE_RIGHT}) {
      const uint32_t foot = found.of_role(HF_ROLE_FOOT, side);
      ASSERT_NE(foot, HF_NO_INDEX);
      EXPECT_EQ(found.list[foot].pinned, 1);
    }
    const uint32_t head = found.of_role(HF_ROLE_HEAD, HF_SIDE_MIDDLE);
    ASSERT_NE(head, HF_NO_INDEX);
    EXPECT_EQ(found.list[head].pinned, 0);
  }
}

// The left arm is drawn out until its hand stands on the ground, as that of an ape.
TEST(CharacterHandles, AHandOnTheGroundDoesNotHold) {
  Host host("biped");
  std::set<uint32_t> hand;
  for (uint32_t j = 0; j < host.names.size(); ++j) {
    if (host.is_below(j, host.joint("hand_L"))) hand.insert(j);
  }
  float lowest = 1e9f;
  for (uint32_t v = 0; v < host.vertex_count(); ++v) {
    if (host.weight(v, hand) > 0.99) lowest = std::min(lowest, host.positions[3 * v + 1]);
  }
  std::set<uint32_t> arm = hand;
  arm.insert(host.joint("lower_arm_L"));
  for (uint32_t v = 0; v < host.vertex_count(); ++v)
    host.positions[3 * v + 1] -= lowest * static_cast<float>(host.weight(v, hand));
  const hf::Surface surface = host.surface();
  const Found plain = propose(host, surface, false), found = propose(host, surface);
  const auto holds_hand = [&](const Found& in) {
    return std::any_of(in.list.begin(), in.list.end(),
                       [&](const hf_handle_proposal& p) { return p.pinned && host.weight(p.vertex, hand) > 0.5; });
  };
  EXPECT_TRUE(holds_hand(plain));
  EXPECT_FALSE(holds_hand(found));
  const uint32_t left = found.of_role(HF_ROLE_HAND, HF_SIDE_LEFT);
  ASSERT_NE(left, HF_NO_INDEX);
  EXPECT_EQ(found.list[left].pinned, 0);
  EXPECT_NE(found.list[left].reason, HF_HANDLE_REASON_FOOT);
}

TEST(CharacterHandles, TheRegionOfAHeadIsTheWholeSkullWhichKeepsItsShape) {
  for (const char* name : {"biped", "horse"}) {
    SCOPED_TRACE(name);
    const Host host(name);
    const hf::Surface surface = host.surface();
    const Found found = propose(host, surface);
    const uint32_t head = found.of_role(HF_ROLE_HEAD, HF_SIDE_MIDDLE);
    ASSERT_NE(head, HF_NO_INDEX);
    const std::vector<uint32_t> region = found.region(head);
    const std::set<uint32_t> inside(region.begin(), region.end());
    std::set<uint32_t> skull;
    for (uint32_t j = 0; j < host.names.size(); ++j) {
      const int32_t role = found.joints[j].role;
      if (role == HF_ROLE_HEAD || role == HF_ROLE_JAW || role == HF_ROLE_EYE) skull.insert(j);
    }
    size_t whole = 0;
    for (uint32_t v = 0; v < host.vertex_count(); ++v) {
      const double weight = host.weight(v, skull);
      if (weight > 0.51 || weight < 0.49) {
        EXPECT_EQ(inside.count(v), weight > 0.5 ? 1u : 0u) << v;
      }
      whole += weight > 0.51;
    }
    EXPECT_GT(whole, 20u);
    hf::Pose pose(surface);
    std::vector<uint32_t> counts, vertices;
    for (uint32_t i = 0; i < found.list.size(); ++i) {
      const std::vector<uint32_t> own = found.region(i);
      counts.push_back(static_cast<uint32_t>(own.size()));
      vertices.insert(vertices.end(), own.begin(), own.end());
    }
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = static_cast<uint32_t>(counts.size());
    desc.region_counts = counts.data();
    desc.region_vertices = vertices.data();
    std::vector<uint32_t> numbers(counts.size());
    ASSERT_EQ(hf_pose_add_handles(pose.get(), &desc, numbers.data()), HF_OK);
    ASSERT_EQ(hf_pose_set_free_rotations(pose.get(), 1, &numbers[head], 1), HF_OK);
    const hf_transform pull = {{0, 0, 0, 0}, {0.2, 0.1, 0.1}};
    ASSERT_EQ(hf_pose_set_transform(pose.get(), numbers[head], &pull), HF_OK);
    std::vector<float> posed(host.positions.size());
    ASSERT_EQ(hf_deform(pose.get(), posed.data(), nullptr), HF_OK);
    const auto length = [&](const std::vector<float>& at, uint32_t a, uint32_t b) {
      double sum = 0;
      for (size_t c = 0; c < 3; ++c) {
        const double d = static_cast<double>(at[3 * a + c]) - static_cast<double>(at[3 * b + c]);
        sum += d * d;
      }
      return std::sqrt(sum);
    };
    for (size_t k = 0; k < host.triangles.size(); ++k) {
      const uint32_t a = host.triangles[k], b = host.triangles[k - k % 3 + (k + 1) % 3];
      if (!inside.count(a) || !inside.count(b)) continue;
      EXPECT_NEAR(length(posed, a, b), length(host.positions, a, b), 1e-5);
    }
  }
}

TEST(CharacterHandles, RegionsAreDisjointAndThoseOfPlacesAndRadiiCanAllBeAdded) {
  // the middle of the chest of the finer biped is beside vertices of the arms
  for (const auto& [name, vertices] :
       {std::pair("biped", 3000u), {"biped", 20000u}, {"horse", 3000u}, {"bull", 3000u}}) {
    SCOPED_TRACE(name);
    const Host host(name, vertices);
    const hf::Surface surface = host.surface();
    const Found found = propose(host, surface);
    hf::Pose pose(surface);
    for (const hf_handle_proposal& p : found.list)
      EXPECT_EQ(hf_pose_add_handle_at(pose.get(), p.position, p.radius, nullptr), HF_OK);
    for (uint32_t i = 0; i < found.list.size(); ++i) EXPECT_EQ(found.regions[found.list[i].vertex], i);
  }
}

TEST(CharacterHandles, TheTrunkIsWhatTheSpineMovesAndANeckIsFreeBesideAHead) {
  for (const char* name : {"biped", "horse", "bull"}) {
    SCOPED_TRACE(name);
    const Host host(name);
    const Found found = propose(host);
    std::set<uint32_t> spine, parts;
    for (uint32_t j = 0; j < host.names.size(); ++j) {
      if (found.joints[j].role == HF_ROLE_SPINE || found.joints[j].role == HF_ROLE_SHOULDER) spine.insert(j);
    }
    uint32_t trunk = HF_NO_INDEX;
    for (uint32_t i = 0; i < found.list.size(); ++i) {
      const int32_t role = found.list[i].role;
      if (role == HF_ROLE_HEAD || role == HF_ROLE_HAND || role == HF_ROLE_FOOT) parts.insert(i);
      if (found.list[i].reason == HF_HANDLE_REASON_MIDDLE) trunk = i;
    }
    ASSERT_NE(trunk, HF_NO_INDEX);
    EXPECT_EQ(found.list[trunk].pinned, 1);
    EXPECT_EQ(found.list[trunk].role, HF_ROLE_SPINE);
    for (const uint32_t v : found.region(trunk)) EXPECT_GT(host.weight(v, spine), 0.2) << v;
    for (size_t t = 0; t < host.triangles.size(); t += 3) {
      bool in_trunk = false, in_part = false;
      for (size_t c = 0; c < 3; ++c) {
        const uint32_t own = found.regions[host.triangles[t + c]];
        in_trunk = in_trunk || own == trunk;
        in_part = in_part || parts.count(own) > 0;
      }
      EXPECT_FALSE(in_trunk && in_part);
    }
  }
}

// The head draws its neck out, and neither chest nor shoulders.
TEST(CharacterHandles, AHeadThatIsDraggedLeavesTheChestOfAnUprightBody) {
  const Host host("biped");
  const hf::Surface surface = host.surface();
  const Found found = propose(host, surface);
  const uint32_t head = found.of_role(HF_ROLE_HEAD, HF_SIDE_MIDDLE);
  ASSERT_NE(head, HF_NO_INDEX);
  std::set<uint32_t> chest, neck;
  for (uint32_t j = 0; j < host.names.size(); ++j) {
    const int32_t role = found.joints[j].role;
    if (role == HF_ROLE_SHOULDER) chest.insert(j);
    if (role == HF_ROLE_NECK || role == HF_ROLE_HEAD) neck.insert(j);
    if (role == HF_ROLE_NECK && found.joints[host.parents[j]].role == HF_ROLE_SPINE) chest.insert(host.parents[j]);
  }
  ASSERT_GE(chest.size(), 1u);
  hf::Pose pose(surface);
  std::vector<uint32_t> counts, vertices;
  uint32_t number = HF_NO_INDEX;
  for (uint32_t i = 0; i < found.list.size(); ++i) {
    if (!found.list[i].pinned && i != head) continue;
    if (i == head) number = static_cast<uint32_t>(counts.size());
    const std::vector<uint32_t> own = found.region(i);
    counts.push_back(static_cast<uint32_t>(own.size()));
    vertices.insert(vertices.end(), own.begin(), own.end());
  }
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = static_cast<uint32_t>(counts.size());
  desc.region_counts = counts.data();
  desc.region_vertices = vertices.data();
  std::vector<uint32_t> numbers(counts.size());
  ASSERT_EQ(hf_pose_add_handles(pose.get(), &desc, numbers.data()), HF_OK);
  number = numbers[number];
  ASSERT_EQ(hf_pose_set_free_rotations(pose.get(), 1, &number, 1), HF_OK);
  ASSERT_EQ(hf_pose_set_following(pose.get(), 1, &number, found.list[head].following), HF_OK);
  const hf_transform pull = {{0, 0, 0, 0}, {0, 0.3, 0}};
  ASSERT_EQ(hf_pose_set_transform(pose.get(), number, &pull), HF_OK);
  std::vector<float> posed(host.positions.size());
  ASSERT_EQ(hf_deform(pose.get(), posed.data(), nullptr), HF_OK);
  double rise = 0, count = 0;
  for (uint32_t v = 0; v < host.vertex_count(); ++v) {
    if (host.weight(v, chest) < 0.6 || host.weight(v, neck) > 0) continue;
    rise += static_cast<double>(posed[3 * v + 1]) - static_cast<double>(host.positions[3 * v + 1]);
    count += 1;
  }
  ASSERT_GT(count, 20);
  std::printf("%.0f vertices of the chest rise by %.5f of the drag\n", count, rise / count / 0.3);
  EXPECT_LT(rise / count, 0.005 * 0.3);
}

// A head of its own on a body whose neck was cut off: the trunk holds far from it, so that its upper part is drawn out.
TEST(CharacterHandles, AHeadWithoutANeckDrawsOutTheUpperPartOfTheTrunk) {
  Host host("biped");
  const Found whole = propose(host);
  std::set<uint32_t> head, spine;
  uint32_t skull = HF_NO_INDEX;
  for (uint32_t j = 0; j < host.names.size(); ++j) {
    const int32_t role = whole.joints[j].role;
    if (role == HF_ROLE_NECK || role == HF_ROLE_HEAD || role == HF_ROLE_JAW || role == HF_ROLE_EAR) head.insert(j);
    if (role == HF_ROLE_SPINE) spine.insert(j);
    if (role == HF_ROLE_HEAD && skull == HF_NO_INDEX) skull = j;
  }
  ASSERT_NE(skull, HF_NO_INDEX);
  std::vector<uint32_t> kept;
  std::array<float, 3> rim = {0, 0, 0};
  float count = 0;
  for (size_t t = 0; t < host.triangles.size(); t += 3) {
    const uint32_t* corner = &host.triangles[t];
    const auto stays = [&](uint32_t v) { return host.weight(v, head) < 0.2; };
    if (std::all_of(corner, corner + 3, stays)) kept.insert(kept.end(), corner, corner + 3);
    for (size_t k = 0; k < 3; ++k) {
      if (std::all_of(corner, corner + 3, stays) || !stays(corner[k])) continue;
      for (size_t c = 0; c < 3; ++c) rim[c] += host.positions[3 * corner[k] + c];
      ++count;
    }
  }
  ASSERT_GT(count, 0);
  for (float& c : rim) c /= count;
  host.triangles = kept;
  constexpr float half = 0.12f;
  host.add_box({rim[0], rim[1] + half + 0.01f, rim[2]}, half, skull);
  const Found found = propose(host, host.surface(true));
  const uint32_t trunk = found.of_role(HF_ROLE_SPINE, HF_SIDE_MIDDLE);
  ASSERT_NE(trunk, HF_NO_INDEX);
  ASSERT_EQ(found.list[trunk].pinned, 1);
  const auto off = [&](uint32_t v) {
    const float* p = &host.positions[3 * size_t{v}];
    return std::hypot(p[0] - rim[0], p[1] - rim[1], p[2] - rim[2]);
  };
  float nearest = 1e9f, far = 0;
  const std::vector<uint32_t> held = found.region(trunk);
  EXPECT_GT(held.size(), 20u);
  for (const uint32_t v : held) nearest = std::min(nearest, off(v));
  for (const uint32_t v : kept) {
    if (host.weight(v, spine) > 0.5) far = std::max(far, off(v));
  }
  std::printf("the trunk holds from %.3f of %.3f\n", static_cast<double>(nearest), static_cast<double>(far));
  EXPECT_GT(nearest, 0.45f * far);
  // with its neck, the body holds its chest
  float chest = 1e9f;
  for (const uint32_t v : whole.region(whole.of_role(HF_ROLE_SPINE, HF_SIDE_MIDDLE))) chest = std::min(chest, off(v));
  EXPECT_LT(chest, 0.3f * far);
}

// A knot of the tail is a piece of its own, with two ends.
// The head has a hundredth of some vertices: the neck moves the skull.
TEST(CharacterHandles, ANeckThatMovesTheHeadIsItsJoint) {
  Host host("biped");
  const uint32_t neck = host.joint("neck"), head = host.joint("head");
  for (uint32_t v = 0; v < host.vertex_count(); ++v) {
    size_t most = slots * v, spare = slots * v;
    for (size_t k = slots * v; k < slots * (v + 1); ++k) {
      if (host.is_below(host.joints[k], head)) host.joints[k] = neck;
      if (host.weights[k] > host.weights[most]) most = k;
      if (host.weights[k] < host.weights[spare]) spare = k;
    }
    if (host.joints[most] != neck || host.weights[spare] > 0) continue;
    host.joints[spare] = head;
    host.weights[spare] = 0.01f;
    host.weights[most] -= 0.01f;
  }
  const Found found = propose(host);
  const uint32_t skull = found.of_role(HF_ROLE_HEAD, HF_SIDE_MIDDLE);
  ASSERT_NE(skull, HF_NO_INDEX);
  EXPECT_EQ(found.list[skull].joint, neck);
  EXPECT_EQ(found.list[skull].pinned, 0);
  for (uint32_t v = 0; v < host.vertex_count(); ++v)
    EXPECT_EQ(found.regions[v] == skull, host.weight(v, {neck, head}) > 0.5) << v;
}

TEST(CharacterHandles, ATailHasOneHandleAtItsEnd) {
  Host host("horse");
  host.add_box({0, 0.9f, -1.4f}, 0.2f, host.joint("tail_2"));
  const hf::Surface surface = host.surface();
  const Found plain = propose(host, surface, false), found = propose(host, surface);
  const auto on_tail = [&](const hf_handle_proposal& p) {
    for (uint32_t j = p.pinned ? HF_NO_INDEX : host.joints[slots * p.vertex]; j != HF_NO_INDEX; j = host.parents[j]) {
      if (host.names[j].rfind("tail", 0) == 0) return true;
    }
    return false;
  };
  EXPECT_GE(std::count_if(plain.list.begin(), plain.list.end(), on_tail), 2);
  EXPECT_EQ(std::count_if(found.list.begin(), found.list.end(), on_tail), 1);
  const uint32_t tail = found.of_role(HF_ROLE_TAIL, HF_SIDE_MIDDLE);
  ASSERT_NE(tail, HF_NO_INDEX);
  const uint32_t joint = found.list[tail].joint;
  EXPECT_EQ(std::count(host.parents.begin(), host.parents.end(), joint), 0) << host.names[joint];
}

TEST(CharacterHandles, TheBoxOfAControlGetsNoProposalAndAHeldBoxDoes) {
  Host host("biped");
  const uint32_t control = host.add_joint("Z_Cube", HF_NO_INDEX, {0, 2.4, 0});
  const uint32_t first = host.vertex_count();
  host.add_box({0, 2.4f, 0}, 0.25f, control);
  const uint32_t second = host.vertex_count();
  host.add_box({1.5f, 1, 0}, 0.25f, host.joint("hand_L"));
  const hf::Surface surface = host.surface();
  const auto count_on = [&](const Found& in, uint32_t from, uint32_t to) {
    return std::count_if(in.regions.begin() + from, in.regions.begin() + to,
                         [](uint32_t r) { return r != HF_NO_INDEX; });
  };
  const Found plain = propose(host, surface, false), found = propose(host, surface);
  EXPECT_GT(count_on(plain, first, second), 0);
  EXPECT_EQ(count_on(found, first, second), 0);
  EXPECT_GT(count_on(found, second, host.vertex_count()), 0);
}

TEST(CharacterHandles, ASkinOfAnotherMeshIsRefusedAndASkeletonWithoutOneGivesItsJoints) {
  const Host host("biped"), other("horse");
  const hf::Surface surface = host.surface();
  const hf_skeleton wrong = skeleton_of(other), bare = skeleton_of(host, false);
  hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
  uint32_t count = 777;
  desc.skeleton = wrong;
  EXPECT_EQ(hf_surface_propose_handles(surface.get(), &desc, 0, nullptr, &count), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(count, 777u);
  desc.skeleton = bare;
  std::vector<hf_handle_proposal> list(HF_HANDLE_LIMIT);
  ASSERT_EQ(hf_surface_propose_handles(surface.get(), &desc, HF_HANDLE_LIMIT, list.data(), &count), HF_OK);
  list.resize(count);
  EXPECT_TRUE(std::any_of(list.begin(), list.end(), [&](const auto& p) { return p.joint == host.joint("head"); }));
  hf_skeleton_destroy(wrong);
  hf_skeleton_destroy(bare);
}

}  // namespace
