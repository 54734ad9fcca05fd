// Compares the places of meshes without a skin with the places of joints, in the clips of the model.
#include "gltf/riders.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/progress.h"
#include "gltf/pose_numbers.h"

namespace hf_gltf {
namespace {

// A node keeps its place on a joint within this, in boxes: a constraint that was baked lags. Half of it loses a watch
// on the wrist of a runner; double takes a hand that swings for the hand that holds.
constexpr double rides_within = 1e-2;
// Below this share of it joints are alike, and the nearest counts: less is rounding, more takes a collar that hardly
// moves for the chest.
constexpr double alike = 0.005;
// Clips that are read, and times of each. A few poses of a body show which nodes move together; more cost time.
constexpr size_t rider_clips = 8, times_of_clip = 6;
// Comparisons of two transforms in one search. A body of 100 joints takes at most 15,000 for a node, and most joints
// are out after the first few, so the search can compare thousands of nodes. Half of it loses props in a large scene;
// double costs another tenth of a second there.
constexpr size_t most_comparisons = 1'000'000;
// A transform whose volume is below this share of the product of its axes is flat: no node can follow it. Half or
// double changes nothing, as rounding is far below and bones are far above.
constexpr double flat = 1e-9;

struct RiderCandidate {
  int node = -1;
  glm::dvec3 low{1e300}, high{-1e300};  // of its vertices, at rest
  glm::dvec3 middle() const { return 0.5 * (low + high); }
};

// Whether a node, or one above it, is a joint of a skin.
bool hangs_on_joint(const Model& model, const std::vector<uint8_t>& bound, int node) {
  for (; node >= 0; node = model.nodes[static_cast<size_t>(node)].parent)
    if (bound[static_cast<size_t>(node)]) return true;
  return false;
}

// The node that moves a mesh by itself: the lowest one at or over it that clips move and that carries no joint; else
// the node of the mesh. Props of one group may follow different joints.
int moved_above(const Model& model, const std::vector<uint8_t>& animated, const std::vector<uint8_t>& carries,
                int node) {
  for (int n = node; n >= 0 && !carries[static_cast<size_t>(n)]; n = model.nodes[static_cast<size_t>(n)].parent)
    if (animated[static_cast<size_t>(n)]) return n;
  return node;
}

std::vector<RiderCandidate> find_candidates(const Model& model, const FlatMesh& mesh) {
  std::vector<uint8_t> bound(model.nodes.size(), 0), carries(model.nodes.size(), 0), animated(model.nodes.size(), 0);
  for (const Skin& skin : model.skins)
    for (const int joint : skin.joints) bound[static_cast<size_t>(joint)] = 1;
  for (size_t n = 0; n < bound.size(); ++n)
    for (int k = static_cast<int>(n); bound[n] && k >= 0 && !carries[static_cast<size_t>(k)];
         k = model.nodes[static_cast<size_t>(k)].parent)
      carries[static_cast<size_t>(k)] = 1;
  for (const Animation& clip : model.animations)
    for (const Channel& channel : clip.channels) animated[static_cast<size_t>(channel.node)] = 1;
  std::vector<RiderCandidate> out;
  std::vector<int> places(model.nodes.size(), -1);  // in out, by node
  for (const FlatPart& part : mesh.parts) {
    if (model.nodes[static_cast<size_t>(part.node)].skin >= 0 || hangs_on_joint(model, bound, part.node)) continue;
    const int node = moved_above(model, animated, carries, part.node);
    int& at = places[static_cast<size_t>(node)];
    if (at < 0) {
      at = static_cast<int>(out.size());
      out.push_back(RiderCandidate{node});
    }
    RiderCandidate& found = out[static_cast<size_t>(at)];
    for (uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      found.low = glm::min(found.low, mesh.positions[v]);
      found.high = glm::max(found.high, mesh.positions[v]);
    }
  }
  return out;
}

bool is_flat(const glm::dmat4& m) {
  const double volume = std::abs(glm::determinant(glm::dmat3(m)));
  return !std::isfinite(volume) || !(volume > flat * glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]));
}

// How far the corners of a box move at most between two transforms. Infinity: one of them is not finite.
double moved_by(const RiderCandidate& c, const glm::dmat4& a, const glm::dmat4& b) {
  double out = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p(corner & 1 ? c.high.x : c.low.x, corner & 2 ? c.high.y : c.low.y,
                       corner & 4 ? c.high.z : c.low.z, 1);
    const double moved = glm::length(glm::dvec3((a - b) * p));
    if (!std::isfinite(moved)) return std::numeric_limits<double>::infinity();
    out = std::max(out, moved);
  }
  return out;
}

// Looks for the joints that nodes follow, in sampled poses of the clips. Transforms are kept for joints and candidates
// alone: a file can have 30,000 other nodes.
class Search {
 public:
  Search(const Model& model, const FlatMesh& mesh, const Pose& rest, const std::vector<uint8_t>& body,
         const std::vector<RiderCandidate>& candidates)
      : within_(rides_within * SurfaceBox(mesh).diagonal()) {
    for (size_t j = 0; j < body.size(); ++j)
      if (body[j]) nodes_.push_back(static_cast<int>(j));
    joints_ = nodes_.size();
    for (const RiderCandidate& c : candidates) nodes_.push_back(c.node);
    at_rest_ = kept(global_matrices(model, rest));
    for (size_t k = 0; k < std::min(model.animations.size(), rider_clips); ++k) {
      const Animation& clip = model.animations[k];
      for (size_t t = 0; t < times_of_clip; ++t) {
        hf_inner::poll();
        const double share = static_cast<double>(t) / static_cast<double>(times_of_clip - 1);
        poses_.push_back(kept(global_matrices(model, sample(model, clip, share * clip_duration(clip)))));
      }
    }
    if (poses_.empty()) return;
    for (const glm::dmat4& m : poses_[0]) from_first_.push_back(is_flat(m) ? glm::dmat4(0) : glm::inverse(m));
  }

  // Adds the result for candidate k.
  void look(const RiderCandidate& c, size_t k, Riders& out) {
    const size_t node = joints_ + k;
    if (is_flat(at_rest_[node])) return;  // it is not seen
    bool body_moves = false;
    int best = -1;
    // A joint that it follows from its rest on is better than one that only clips keep at its side.
    for (const std::vector<glm::dmat4>* first : {&at_rest_, poses_.empty() ? &at_rest_ : &poses_[0]}) {
      best = nearest_still(c, node, *first, body_moves);
      if (best < 0) continue;
      const auto joint = static_cast<size_t>(best);
      out.known.push_back({c.node, nodes_[joint], glm::inverse((*first)[joint]) * (*first)[node]});
      return;
    }
    if (!body_moves || !still(c, node)) out.unknown.push_back(c.node);
  }

 private:
  std::vector<glm::dmat4> kept(const std::vector<glm::dmat4>& globals) const {
    std::vector<glm::dmat4> out;
    for (const int node : nodes_) out.push_back(globals[static_cast<size_t>(node)]);
    return out;
  }
  // Against the first pose of the clips, in the space of the model.
  bool still(const RiderCandidate& c, size_t n) {
    return std::all_of(poses_.begin(), poses_.end(), [&](const std::vector<glm::dmat4>& globals) {
      ++comparisons_;
      return moved_by(c, globals[n] * from_first_[n], glm::dmat4(1)) <= within_;
    });
  }
  // The joint that moves and against which a node moves least in the clips, then the nearest; -1: none is good enough.
  int nearest_still(const RiderCandidate& c, size_t node, const std::vector<glm::dmat4>& first, bool& body_moves) {
    int best = -1;
    double least = within_, nearest = std::numeric_limits<double>::infinity();
    if (is_flat(first[node])) return best;
    const glm::dmat4 back = glm::inverse(at_rest_[node]);
    const glm::dvec4 middle(c.middle(), 1);
    for (size_t j = 0; j < joints_ && !poses_.empty() && comparisons_ < most_comparisons; ++j) {
      hf_inner::poll();
      if (is_flat(first[j]) || is_flat(at_rest_[j]) || still(c, j)) continue;
      body_moves = true;
      const glm::dmat4 offset = glm::inverse(first[j]) * first[node] * back;
      double off = alike * within_;
      for (size_t p = 0; p < poses_.size() && off <= least; ++p, ++comparisons_)
        off = std::max(off, moved_by(c, poses_[p][j] * offset, poses_[p][node] * back));
      const double distance = glm::distance(glm::dvec3(first[j][3]), glm::dvec3(first[node] * back * middle));
      if (off > least || (off == least && distance >= nearest)) continue;
      least = off;
      nearest = distance;
      best = static_cast<int>(j);
    }
    return comparisons_ < most_comparisons ? best : -1;  // a joint that was not compared may be better
  }

  std::vector<int> nodes_;  // joints of the body, then candidates
  size_t joints_ = 0, comparisons_ = 0;
  std::vector<glm::dmat4> at_rest_, from_first_;
  std::vector<std::vector<glm::dmat4>> poses_;
  double within_;
};

// The transform of the parent in the space of the model.
glm::dmat4 above_of(const Model& model, const Pose& pose, int node) {
  glm::dmat4 out(1);
  for (int n = model.nodes[static_cast<size_t>(node)].parent; n >= 0; n = model.nodes[static_cast<size_t>(n)].parent)
    out = local_matrix(pose[static_cast<size_t>(n)]) * out;
  return out;
}

}  // namespace

Riders find_riders(const Model& model, const FlatMesh& mesh, const Pose& rest, const std::vector<uint8_t>& body) {
  Riders out;
  if (model.skins.empty()) return out;
  std::vector<RiderCandidate> candidates = find_candidates(model, mesh);
  if (candidates.empty()) return out;
  const auto depth = [&](int node) {
    size_t count = 0;
    for (; node >= 0; node = model.nodes[static_cast<size_t>(node)].parent) ++count;
    return count;
  };
  // A rider may hang on another: it is placed after that one.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const RiderCandidate& a, const RiderCandidate& b) { return depth(a.node) < depth(b.node); });
  Search search(model, mesh, rest, body, candidates);
  for (size_t k = 0; k < candidates.size(); ++k) search.look(candidates[k], k, out);
  return out;
}

void place_riders(const Model& model, const Riders& riders, Pose& pose) {
  if (riders.known.empty()) return;
  const std::vector<glm::dmat4> globals = global_matrices(model, pose);
  for (const Rider& rider : riders.known) {
    const glm::dmat4 above = above_of(model, pose, rider.node), &joint = globals[static_cast<size_t>(rider.joint)];
    if (is_flat(above) || is_flat(joint)) continue;  // it is not seen, or there is no joint to follow
    NodePose node = pose[static_cast<size_t>(rider.node)];
    node.fixed = true;
    node.matrix = glm::inverse(above) * joint * rider.on_joint;
    std::vector<double> trs;
    append_trs({node}, trs);
    if (std::all_of(trs.begin(), trs.end(), [](double x) { return std::isfinite(x); }))
      pose[static_cast<size_t>(rider.node)] = pose_of({node}, trs).front();
  }
}

}  // namespace hf_gltf
