// Compares the places of meshes without a skin with those of joints, in the clips of the model.
#include "gltf/riders.h"

#include <algorithm>
#include <cmath>

#include "gltf/pose_numbers.h"

namespace hf_gltf {
namespace {

// A node keeps its place on a joint within this, in boxes: a constraint that was baked lags. Half of it loses a watch
// on the wrist of a runner; double takes a hand that swings for the hand that holds.
constexpr double rides_within = 1e-2;
// Below this share of it joints are alike, and the nearest counts: less is rounding, more takes a collar that hardly
// moves for the chest.
constexpr double alike = 0.005;
// Clips that are read, and times of each. A body shows in few poses what moves with what; more cost time.
constexpr size_t most_clips = 8, times_of_clip = 6;

struct Candidate {
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

// The topmost node over a mesh that clips move and that carries no joint; else the node of the mesh.
int moved_above(const Model& model, const std::vector<uint8_t>& animated, const std::vector<uint8_t>& carries,
                int node) {
  int found = node;
  for (int n = node; n >= 0 && !carries[static_cast<size_t>(n)]; n = model.nodes[static_cast<size_t>(n)].parent)
    if (animated[static_cast<size_t>(n)]) found = n;
  return found;
}

std::vector<Candidate> find_candidates(const Model& model, const FlatMesh& mesh) {
  std::vector<uint8_t> bound(model.nodes.size(), 0), carries(model.nodes.size(), 0), animated(model.nodes.size(), 0);
  for (const Skin& skin : model.skins)
    for (const int joint : skin.joints) bound[static_cast<size_t>(joint)] = 1;
  for (size_t n = 0; n < bound.size(); ++n)
    for (int k = static_cast<int>(n); bound[n] && k >= 0 && !carries[static_cast<size_t>(k)];
         k = model.nodes[static_cast<size_t>(k)].parent)
      carries[static_cast<size_t>(k)] = 1;
  for (const Animation& clip : model.animations)
    for (const Channel& channel : clip.channels) animated[static_cast<size_t>(channel.node)] = 1;
  std::vector<Candidate> out;
  for (const FlatPart& part : mesh.parts) {
    if (model.nodes[static_cast<size_t>(part.node)].skin >= 0 || hangs_on_joint(model, bound, part.node)) continue;
    const int node = moved_above(model, animated, carries, part.node);
    auto found = std::find_if(out.begin(), out.end(), [&](const Candidate& c) { return c.node == node; });
    if (found == out.end()) found = out.insert(out.end(), Candidate{node});
    for (uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      found->low = glm::min(found->low, mesh.positions[v]);
      found->high = glm::max(found->high, mesh.positions[v]);
    }
  }
  return out;
}

std::vector<std::vector<glm::dmat4>> sampled_globals(const Model& model) {
  std::vector<std::vector<glm::dmat4>> out;
  for (size_t k = 0; k < std::min(model.animations.size(), most_clips); ++k) {
    const Animation& clip = model.animations[k];
    for (size_t t = 0; t < times_of_clip; ++t) {
      const double share = static_cast<double>(t) / static_cast<double>(times_of_clip - 1);
      out.push_back(global_matrices(model, sample(model, clip, share * clip_duration(clip))));
    }
  }
  return out;
}

// How far the corners of a box move at most between two transforms.
double moved_by(const Candidate& c, const glm::dmat4& a, const glm::dmat4& b) {
  double out = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p(corner & 1 ? c.high.x : c.low.x, corner & 2 ? c.high.y : c.low.y,
                       corner & 4 ? c.high.z : c.low.z, 1);
    out = std::max(out, glm::length(glm::dvec3((a - b) * p)));
  }
  return out;
}

}  // namespace

Riders find_riders(const Model& model, const FlatMesh& mesh, const Pose& rest, const std::vector<uint8_t>& body) {
  Riders out;
  if (model.skins.empty()) return out;
  const std::vector<Candidate> candidates = find_candidates(model, mesh);
  if (candidates.empty()) return out;
  const std::vector<glm::dmat4> at_rest = global_matrices(model, rest);
  const std::vector<std::vector<glm::dmat4>> poses = sampled_globals(model);
  const double within = rides_within * SurfaceBox(mesh).diagonal();
  for (const Candidate& c : candidates) {
    const auto node = static_cast<size_t>(c.node);
    const glm::dmat4 back = glm::inverse(at_rest[node]);
    // Against the first pose of the clips, in the space of the model.
    const auto still = [&](size_t n) {
      return std::all_of(poses.begin(), poses.end(), [&](const auto& globals) {
        return moved_by(c, globals[n] * glm::inverse(poses[0][n]), glm::dmat4(1)) <= within;
      });
    };
    // How far it moves against a joint in the clips.
    const auto moves_on = [&](size_t j, const std::vector<glm::dmat4>& first) {
      const glm::dmat4 offset = glm::inverse(first[j]) * first[node] * back;
      double out = 0;
      for (const std::vector<glm::dmat4>& globals : poses)
        out = std::max(out, moved_by(c, globals[j] * offset, globals[node] * back));
      return out;
    };
    bool body_moves = false;
    int best = -1;
    // A joint on which it rides from its rest on is better than one that clips alone keep at its side.
    for (const std::vector<glm::dmat4>* first : {&at_rest, poses.empty() ? &at_rest : &poses[0]}) {
      double least = within, nearest = 1e300;
      for (size_t j = 0; j < body.size() && !poses.empty(); ++j) {
        if (!body[j] || still(j)) continue;
        body_moves = true;
        const double off = std::max(moves_on(j, *first), alike * within);
        const double distance = glm::distance(glm::dvec3(at_rest[j][3]), c.middle());
        if (off > least || (off == least && distance >= nearest)) continue;
        least = off;
        nearest = distance;
        best = static_cast<int>(j);
      }
      if (best < 0) continue;
      out.known.push_back({c.node, best, glm::inverse((*first)[static_cast<size_t>(best)]) * (*first)[node]});
      break;
    }
    if (best < 0 && (!body_moves || !still(node))) out.unknown.push_back(c.node);
  }
  return out;
}

void place_riders(const Model& model, const Riders& riders, Pose& pose) {
  if (riders.known.empty()) return;
  const std::vector<glm::dmat4> globals = global_matrices(model, pose);
  std::vector<NodePose> placed;
  for (const Rider& rider : riders.known) {
    const int parent = model.nodes[static_cast<size_t>(rider.node)].parent;
    const glm::dmat4 above = parent < 0 ? glm::dmat4(1) : globals[static_cast<size_t>(parent)];
    NodePose node = pose[static_cast<size_t>(rider.node)];
    node.fixed = true;
    node.matrix = glm::inverse(above) * globals[static_cast<size_t>(rider.joint)] * rider.on_joint;
    std::vector<double> trs;
    append_trs({node}, trs);
    placed.push_back(pose_of({node}, trs).front());
  }
  for (size_t k = 0; k < placed.size(); ++k) pose[static_cast<size_t>(riders.known[k].node)] = placed[k];
}

}  // namespace hf_gltf
