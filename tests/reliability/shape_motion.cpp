// Transfers, skin weights and links of a sequence of bytes (shape_play.h).
#include <algorithm>

#include "shape_play.h"
#include "support/arrays.h"
#include "support/peers.h"

namespace shapes {

// A surface moved by another one, or by itself. The source at rest gives the target at rest; a frame gives the same
// bits again; the frame changes nothing else.
bool Player::transfer() {
  const unsigned how = bytes_.take();
  Mesh other;
  Surface second;
  const bool itself = how & 1;
  if (!itself) {
    other = take_mesh();
    const hf_surface_desc desc = reliability::surface_desc(other);
    if (!done("hf_surface_create", hf_surface_create(&desc, second.out()), HF_ERROR_EMPTY)) return false;
  }
  const Mesh& target = itself ? mesh_ : other;
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  std::int32_t kind = static_cast<std::int32_t>(how / 2 % 4);
  desc.ground = how & 8 ? HF_GROUND_OFF : HF_GROUND_KEEP;
  if (kind == 3) kind = TRANSFER_FIELDS;
  desc.mode = mode_of(kind);
  desc.cluster_count = how & 16 ? 6 : 0;
  Owned<hf_transfer, hf_transfer_destroy> transfer;
  expect(HF_OK, create_transfer_with(kind, surface_, itself ? surface_ : second, &desc, transfer.out()),
         "hf_transfer_create");
  const std::uint32_t flags[] = {0,
                                 HF_PAIR_TRUNK | HF_PAIR_ANCHOR,
                                 HF_PAIR_FOOT,
                                 HF_PAIR_TAIL,
                                 HF_PAIR_SINKS,
                                 HF_PAIR_CONTACT,
                                 HF_PAIR_NECK,
                                 HF_PAIR_ARM};
  std::vector<std::uint32_t> counts[2], vertices[2], of;
  const unsigned pairs = 1 + bytes_.take() % 5;
  for (unsigned i = 0; i < pairs; ++i) {
    of.push_back(flags[bytes_.take() % 8]);
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t n = side == 0 ? mesh_.vertex_count() : target.vertex_count(), first = bytes_.take() % n;
      counts[side].push_back(1 + bytes_.take() % 3);
      for (std::uint32_t k = 0; k < counts[side].back(); ++k) vertices[side].push_back((first + k) % n);
    }
  }
  hf_pairs_desc added = HF_INIT(hf_pairs_desc);
  added.pair_count = pairs;
  added.flags = of.data();
  added.source_counts = counts[0].data();
  added.source_vertices = vertices[0].data();
  added.target_counts = counts[1].data();
  added.target_vertices = vertices[1].data();
  if (!done("hf_transfer_add_pairs", hf_transfer_add_pairs(transfer, &added, nullptr), HF_ERROR_CONFLICT,
            HF_ERROR_INVALID_ARGUMENT))
    return false;

  const std::vector<double> rest(mesh_.positions.begin(), mesh_.positions.end());
  const auto frame = [&](const std::vector<double>& source) {
    std::vector<double> out(target.positions.size());
    hf_transfer_frame f = HF_INIT(hf_transfer_frame);
    f.source_positions = HF_ARRAY(source.data(), source.size() / 3);
    f.target_positions = ROWS_OUT(out.data());
    expect(HF_OK, hf_transfer_apply(transfer, &f), "hf_transfer_apply");
    hold(finite(out), "hf_transfer_apply: not finite");
    return out;
  };
  std::vector<std::uint8_t> sinking(target.vertex_count(), 2);
  if (kind != TRANSFER_STRETCH || how & 32) {
    if (done("hf_transfer_get_sinking", hf_transfer_get_sinking(transfer, sinking.data()), HF_ERROR_UNSUPPORTED))
      hold(*std::max_element(sinking.begin(), sinking.end()) <= 1, "hf_transfer_get_sinking: neither 0 nor 1");
  }
  const std::vector<double> moved = frame(posed());
  const std::vector<double> still = frame(rest);
  double size = 0, off = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    const double at = static_cast<double>(target.positions[i]);
    size = std::max(size, std::fabs(at));
    off = std::max(off, std::fabs(still[i] - at));
  }
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  expect(HF_OK, hf_transfer_get_info(transfer, &info), "hf_transfer_get_info");
  // aligned limbs take the direction of the source's
  hold(info.aligned_count > 0 || off <= 1e-4 * size,
       "a source at rest gives a target that is off by " + std::to_string(off / size));
  hold(frame(posed()) == moved, "hf_transfer_apply: other bits of the same frame");
  hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
  dials.stride = 0.5;
  dials.hip_height_share = how & 64 ? 0.2 : -0.2;
  dials.tail_follow = 1;
  dials.arm_space = 0.5;
  dials.long_follow = 0.5;
  expect(HF_OK, hf_transfer_set_dials(transfer, &dials), "hf_transfer_set_dials");
  frame(posed());
  expect(HF_OK, hf_transfer_set_dials(transfer, nullptr), "hf_transfer_set_dials");
  hold(frame(posed()) == moved, "hf_transfer_apply: neutral dials give other bits");
  return true;
}

// What hf/weights.h promises: descending, of sum exactly 1.
void Player::check_weights(const char* call, const hf_weights_out& out) const {
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    float sum = 0;
    const float* w = out.weights + v * out.influence_count;
    for (std::size_t k = 0; k < out.influence_count; ++k) {
      hold(w[k] >= 0 && (k == 0 || w[k] <= w[k - 1]), std::string(call) + ": weights are not descending");
      sum += w[k];
    }
    hold(sum == 1, std::string(call) + ": weights of another sum than 1");
  }
}

// Weights of bones through the mesh, of pins, and the same weights carried to the mesh itself and mirrored.
bool Player::weights() {
  const unsigned how = bytes_.take(), count = 1 + bytes_.take() % 5;
  std::vector<double> heads, tails;
  std::vector<std::uint32_t> parents;
  for (unsigned i = 0; i < count; ++i) {
    const std::uint32_t a = take_vertex(), b = take_vertex();
    for (std::size_t k = 0; k < 3; ++k) {
      heads.push_back(0.8 * static_cast<double>(mesh_.positions[3 * a + k]));
      tails.push_back(0.8 * static_cast<double>(mesh_.positions[3 * b + k]));
    }
    parents.push_back(i == 0 ? HF_NO_INDEX : bytes_.take() % i);
  }
  hf_joints_desc bones = HF_INIT(hf_joints_desc);
  bones.joint_count = count;
  bones.heads = heads.data();
  bones.tails = how & 1 ? nullptr : tails.data();
  bones.parents = parents.data();
  Owned<hf_weights, hf_weights_destroy> made;
  const std::uint32_t each = how & 2 ? 8 : 4;
  expect(HF_OK, hf_weights_create(surface_, &bones, each, made.out()), "hf_weights_create");
  std::vector<std::uint32_t> joints(8 * std::size_t{mesh_.vertex_count()});
  std::vector<float> weights(joints.size());
  const auto fresh_out = [&] {
    hf_weights_out out = HF_INIT(hf_weights_out);
    out.vertex_capacity = mesh_.vertex_count();
    out.joints = joints.data();
    out.weights = weights.data();
    return out;
  };
  hf_weights_out out = fresh_out();
  expect(HF_OK, hf_weights_get(made, &out), "hf_weights_get");
  check_weights("hf_weights_create", out);
  if (how & 4) {
    const std::vector<std::uint32_t> pinned = take_vertices(3);
    const std::vector<std::uint32_t> to(pinned.size(), count - 1);
    const std::vector<float> whole(pinned.size(), 1.0f);
    hf_pins_desc pins = HF_INIT(hf_pins_desc);
    pins.pin_count = static_cast<std::uint32_t>(pinned.size());
    pins.vertices = pinned.data();
    pins.influence_count = 1;
    pins.joints = to.data();
    pins.weights = whole.data();
    std::vector<float> before(weights);
    const bool held = done("hf_weights_set_pins", hf_weights_set_pins(made, &pins), HF_ERROR_DUPLICATE,
                           HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE);
    expect(HF_OK, hf_weights_get(made, &out), "hf_weights_get");
    check_weights("hf_weights_set_pins", out);
    if (!held) hold(before == weights, "refused pins changed the weights");
    for (const std::uint32_t v : pinned)
      hold(!held || (joints[each * v] == count - 1 && weights[each * v] == 1), "a pin does not hold");
  }
  const std::vector<std::uint32_t> from_joints(joints.begin(), joints.begin() + each * mesh_.vertex_count());
  const std::vector<float> from_weights(weights.begin(), weights.begin() + each * mesh_.vertex_count());
  if (how & 8) {
    hf_weights_transfer_desc carry = HF_INIT(hf_weights_transfer_desc);
    carry.source_influence_count = each;
    carry.joints = from_joints.data();
    carry.weights = from_weights.data();
    hf_weights_out to = fresh_out();
    expect(HF_OK, hf_weights_transfer(surface_, surface_, &carry, &to, nullptr), "hf_weights_transfer");
    check_weights("hf_weights_transfer", to);
  }
  if (how & 16) {
    hf_weights_mirror_desc mirror = HF_INIT(hf_weights_mirror_desc);
    const double plane[6] = {0, 0, 0, how & 32 ? 1.0 : 0.0, how & 32 ? 0.0 : 1.0, 0.5};
    mirror.joint_count = count;
    mirror.heads = heads.data();
    mirror.plane = how & 64 ? plane : nullptr;
    mirror.source_influence_count = each;
    mirror.joints = from_joints.data();
    mirror.weights = from_weights.data();
    mirror.to = static_cast<int>(bytes_.take() % 3);
    hf_weights_out to = fresh_out();
    if (done("hf_weights_mirror", hf_weights_mirror(surface_, &mirror, &to, nullptr, nullptr, nullptr, nullptr),
             HF_ERROR_EMPTY))
      check_weights("hf_weights_mirror", to);
  }
  return true;
}

// Links with joints and tags; the links of a surface given back make the same ones.
bool Player::links() {
  const unsigned how = bytes_.take();
  const std::uint32_t n = mesh_.vertex_count();
  hf_links_desc desc = HF_INIT(hf_links_desc);
  desc.mode = HF_LINK_PIECES;
  std::vector<std::uint16_t> joints(n);
  std::vector<float> weights(n, 1.0f);
  std::vector<std::uint32_t> tags(n), light;
  for (std::uint32_t v = 0; v < n; ++v) {
    joints[v] = static_cast<std::uint16_t>(v / 40 % 3);
    tags[v] = v / (how & 16 ? 55 : 200);
  }
  if (how & 1) {
    desc.influence_count = 1;
    desc.joints = joints.data();
    desc.weights = weights.data();
  }
  if (how & 2) desc.tags = tags.data();
  if (how & 4) desc.distance = diagonal_ * (how & 8 ? 0.5 : 0.001);
  if (how & 32) light = take_vertices(2);
  desc.light_count = static_cast<std::uint32_t>(light.size());
  desc.light_vertices = light.empty() ? nullptr : light.data();
  Surface linked, again;
  if (!done("hf_surface_relink", hf_surface_relink(surface_, &desc, nullptr, linked.out()),
            HF_ERROR_INVALID_ARGUMENT))
    return false;
  const auto links_of = [](hf_surface surface) {
    std::uint32_t count = 0;
    expect(HF_OK, hf_surface_get_links(surface, 0, nullptr, &count), "hf_surface_get_links");
    std::vector<hf_link> out(count);
    expect(HF_OK, hf_surface_get_links(surface, count, out.data(), &count), "hf_surface_get_links");
    return out;
  };
  const std::vector<hf_link> found = links_of(linked);
  for (const hf_link& link : found) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      hold(link.barycentrics[k] >= 0 && (link.corners[k] < n || link.barycentrics[k] == 0), "a link ends nowhere");
      sum += link.barycentrics[k];
    }
    hold(link.vertex < n && std::fabs(sum - 1) <= 1e-9, "a link starts nowhere");
    hold(std::isfinite(link.length) && link.length >= 0 && link.weight > 0, "a link without length or weight");
  }
  std::vector<double> gaps(found.size());
  const std::vector<double> bent = posed();
  const hf_array measured = HF_ARRAY(bent.data(), bent.size() / 3);
  hf_gaps_info opened = HF_INIT(hf_gaps_info);
  expect(
      HF_OK,
      hf_surface_measure_gaps(linked, &measured, static_cast<std::uint32_t>(gaps.size()), gaps.data(), &opened),
      "hf_surface_measure_gaps");
  hold(opened.link_count == gaps.size() && std::isfinite(opened.worst), "another count of gaps");
  hold(finite(gaps), "a gap is not finite");
  if (found.empty()) return true;
  hf_links_desc list = HF_INIT(hf_links_desc);
  list.mode = HF_LINK_LIST;
  list.links = found.data();
  list.link_count = static_cast<std::uint32_t>(found.size());
  expect(HF_OK, hf_surface_relink(surface_, &list, nullptr, again.out()), "hf_surface_relink with its own links");
  const std::vector<hf_link> same = links_of(again);
  hold(same.size() == found.size(), "links given back are others");
  for (std::size_t i = 0; i < same.size(); ++i)
    hold(same[i].vertex == found[i].vertex && std::fabs(same[i].length - found[i].length) <= 1e-6 * diagonal_,
         "a link given back is another");
  return true;
}

}  // namespace shapes
