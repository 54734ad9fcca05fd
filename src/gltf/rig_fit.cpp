// See rig_fit.h.
#include "gltf/rig_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "base/compiler.h"

namespace hf_gltf {
namespace {

// Weights were chosen on every 25th run of the choosing half of hf_transfer_table --own-skin.
// The weight k of turns from rest (rig_fit.h), over the mean diagonal of the normal matrix there. 2e-4 and 5e-3 give as
// many spikes.
constexpr double keep_rest = 1e-3;
// The same for the difference from the frames beside. With 0 a robot's jump and a fox's gallop have a spike each.
constexpr double keep_even = 0.01;
// The weight k_m of misses that change from frame to frame, beside 1 for misses (rig_fit.h): trades places that are met
// for motion without jumps. Twelve runs have 36 spikes with 0, and none with 3. A value of 10 reduces the largest
// accelerations more, and needs more passes.
constexpr double keep_miss = 3;
// Passes over the clip, there and back, at most. With 20, a man who walks like a wolf accelerates 1.26 instead of 1.28
// times as much as his source.
constexpr int most_rounds = 10;
// A pass skips a frame if neither it nor the frames beside it moved a vertex by more than this share of the box before.
// More saves passes and leaves errors that are not quite even. On every 60th run half takes 7 % more fits and double 9
// % fewer. No figure changes.
constexpr double settled = 2e-5;
// Frames in which no vertex moves by more than this share of the box are one: trades still poses for slow motion. Half
// and double change no figure there.
constexpr double hold_step = 1e-5;
// The weight of all ties together, beside 1 for all vertices. It trades feet that slide for pieces that stay together.
// From 0 to 100, the opening of a knight's run on a robot falls from .096 to .016 of the box. The slides of its feet
// double.
constexpr double tie_weight = 10;
// The weight of a vertex of a foot that stands, beside 1, so that it does not slide. 3000 halves slides, and makes four
// times as many spikes.
constexpr double foot_weight = 300;
// The weight of the depth of a vertex under the ground, beside 1: trades parts that sink for a motion that is met less
// well. On every 10th run of that half, 43 runs sink by more than 0.01 of the box with 0. With 100 it is 3, from 300 on
// none. The deepest sinks 0.058 with 0, 0.0055 with 1000, and 0.0045 with 3000.
constexpr double ground_weight = 1000;
// A system has up to six unknowns a joint, so memory grows as their square and a step as their cube. This many joints
// take 250 MB, or 700 if all of them shift. Characters have 20 to 500.
constexpr size_t most_joints = 1000;
constexpr double moved = 1e-3;  // of the diagonal: a clip that moves a joint less does not move it
// Levenberg's and Marquardt's damping, of each diagonal entry. A step that raises the energy is damped more.
constexpr double first_damping = 1e-3, least_damping = 1e-6, more_damping = 8, less_damping = 0.2;
constexpr int most_steps = 40, most_attempts = 8;  // a frame takes some 5 from the one before
constexpr double still_enough = 1e-6;              // a step that lowers the energy by a smaller share ends the fit
constexpr double most_turn = 0.7;                  // of a joint in a step, in radians
constexpr double lift = 1e-9;                      // of the mean diagonal of its kind: joints that move nothing stay

// The rotation of a matrix whose columns may be scaled.
glm::dquat rotation_of(const glm::dmat4& matrix) {
  glm::dmat3 m(matrix);
  for (int c = 0; c < 3; ++c) m[c] = glm::length(m[c]) > 0 ? glm::normalize(m[c]) : m[c];
  if (glm::determinant(m) < 0) m = -m;
  return glm::normalize(glm::quat_cast(m));
}

// How far the model's own clips move a node from a place, in the frame of its parent.
double farthest_shift(const Model& model, int node, const glm::dvec3& from) {
  double out = 0;
  for (const Animation& animation : model.animations) {
    for (const Channel& channel : animation.channels) {
      if (channel.node != node || channel.path != Path::translation) continue;
      for (const double time : channel.times) {
        const std::vector<double> t = sample_channel(channel, time);
        out = std::max(out, glm::distance(glm::dvec3(t[0], t[1], t[2]), from));
      }
    }
  }
  return out;
}

glm::dvec3 rotation_vector(glm::dquat q) {
  if (q.w < 0) q = -q;
  const glm::dvec3 v(q.x, q.y, q.z);
  const double s = glm::length(v);
  return s < 1e-12 ? 2.0 * v : 2 * std::atan2(s, q.w) / s * v;
}

glm::dquat exponential(const glm::dvec3& w) {
  const double angle = glm::length(w);
  return angle < 1e-12 ? glm::normalize(glm::dquat(1, 0.5 * w.x, 0.5 * w.y, 0.5 * w.z))
                       : glm::angleAxis(angle, w / angle);
}

glm::dvec3 place_of(const std::vector<double>& frame, size_t vertex) {
  return {frame[3 * vertex], frame[3 * vertex + 1], frame[3 * vertex + 2]};
}

// The furthest that a vertex moves.
double step_between(const std::vector<double>& from, const std::vector<double>& to) {
  double out = 0;
  for (size_t v = 0; 3 * v < from.size(); ++v) {
    const glm::dvec3 step = place_of(to, v) - place_of(from, v);
    out = std::max(out, glm::dot(step, step));
  }
  return std::sqrt(out);
}

// A hold: frames beside each other that are alike. They get one pose, and so do the first and the last of a loop.
struct Hold {
  size_t frame = 0;             // its first
  double count = 0, pause = 0;  // frames, and time to the next hold
  RigPose pose;
  std::vector<double> miss;  // x y z of every flat vertex: from its place in the frame to that in the pose
  double changed = std::numeric_limits<double>::infinity();  // by how much that changed last, at most
};
struct Holds {
  std::vector<Hold> all;
  std::vector<size_t> of_frame;
  bool loop = false;
};

Holds holds_of(const std::vector<double>& times, const std::vector<std::vector<double>>& frames, double most_step) {
  Holds out;
  const auto alike = [&](size_t a, size_t b) { return step_between(frames[a], frames[b]) < most_step; };
  for (size_t f = 0; f < frames.size(); ++f) {
    if (f == 0 || !alike(out.all.back().frame, f)) {
      if (f > 0) out.all.back().pause = times[f] - times[f - 1];
      out.all.emplace_back().frame = f;
    }
    ++out.all.back().count;
    out.of_frame.push_back(out.all.size() - 1);
  }
  out.loop = out.all.size() > 3 && alike(0, frames.size() - 1);
  if (!out.loop) return out;
  out.all.front().count += out.all.back().count;
  out.all.pop_back();
  for (size_t& hold : out.of_frame) hold %= out.all.size();
  return out;
}

// Solves the positive definite system in place by Cholesky. A finished row also goes into the column of the other
// triangle. So the innermost loop runs along rows, two numbers of two steps at once, without a sum that waits for its
// last term.
HF_LOOSE_VECTOR(Two, double, 2);
void solve(std::vector<double>& m, std::vector<double>& b) {
  const size_t n = b.size();
  for (size_t i = 0; i < n; ++i) {
    double* row = &m[i * n];
    size_t k = 0;
    for (; k + 2 <= i; k += 2) {
      const double *first = &m[k * n], *second = &m[(k + 1) * n];
      const double x = row[k] / first[k], y = (row[k + 1] - x * first[k + 1]) / second[k + 1];
      row[k] = x;
      row[k + 1] = y;
      size_t j = k + 2;
      for (; j + 2 <= i; j += 2) {
        Two& at = *reinterpret_cast<Two*>(row + j);
        at = at - x * *reinterpret_cast<const Two*>(first + j) - y * *reinterpret_cast<const Two*>(second + j);
      }
      for (; j < i; ++j) row[j] = row[j] - x * first[j] - y * second[j];
      row[i] = row[i] - x * x - y * y;
    }
    if (k < i) {
      row[k] /= m[k * n + k];
      row[i] -= row[k] * row[k];
    }
    row[i] = std::sqrt(std::max(row[i], 1e-300));
    for (k = 0; k < i; ++k) {
      m[k * n + i] = row[k];
      b[i] -= row[k] * b[k];
    }
    b[i] /= row[i];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) b[i] -= m[i * n + k] * b[k];
    b[i] /= m[i * n + i];
  }
}

// Nodes with a matrix get translation, rotation and scale where that says the same.
Pose decomposed(Pose pose) {
  for (NodePose& node : pose) {
    if (!node.fixed) continue;
    const glm::dmat4 m = node.matrix;
    NodePose out = node;
    out.fixed = false;
    out.translation = glm::dvec3(m[3]);
    out.rotation = rotation_of(m);
    for (int c = 0; c < 3; ++c) out.scale[c] = glm::length(glm::dvec3(m[c]));
    if (glm::determinant(glm::dmat3(m)) < 0) out.scale = -out.scale;
    const glm::dmat4 again = local_matrix(out);
    double worst = 0;
    for (int c = 0; c < 4; ++c) worst = std::max(worst, glm::length(again[c] - m[c]));
    if (worst < 1e-5 * (1 + glm::length(out.translation))) node = out;
  }
  return pose;
}

}  // namespace

// Sums of the rows over pairs of slots: what energy, gradient and matrix need of the vertices.
class RigFit::Moments {
 public:
  explicit Moments(size_t slots) : slots_(slots), goal_(slots, glm::dmat3x4(0.0)) {}
  // The matrix part of a row.
  void add(const Row& row, double weight) {
    for (const Term& a : row.terms)
      for (const Term& b : row.terms) {
        if (b.slot < a.slot) continue;
        const auto [known, fresh] = number_.try_emplace(a.slot * slots_ + b.slot, pairs_.size());
        if (fresh) pairs_.push_back({a.slot, b.slot, glm::dmat4(0)});
        glm::dmat4& sum = pairs_[known->second].sum;
        for (int c = 0; c < 4; ++c) sum[c] += weight * b.at[c] * a.at;
      }
  }
  // The goal of a row.
  void want(const Row& row, double weight, const glm::dvec3& goal) {
    for (const Term& a : row.terms)
      for (int c = 0; c < 3; ++c) goal_[a.slot][c] += weight * goal[c] * a.at;
    squares_ += weight * glm::dot(goal, goal);
  }
  struct Pair {
    size_t first, second;  // first <= second
    glm::dmat4 sum;        // of weight * first's place * second's place
  };
  const std::vector<Pair>& pairs() const { return pairs_; }
  const glm::dmat3x4& goal(size_t slot) const { return goal_[slot]; }
  double squares() const { return squares_; }

 private:
  size_t slots_;
  std::unordered_map<size_t, size_t> number_;  // of a pair of slots: its place in pairs_
  std::vector<Pair> pairs_;
  std::vector<glm::dmat3x4> goal_;  // of weight * place * goal
  double squares_ = 0;
};

// One linear system of the fit.
struct RigFit::System {
  std::vector<double> matrix, rhs;
};

RigFit::RigFit(const Model& model, const FlatMesh& mesh, const std::vector<RigTie>& ties)
    : model_(model), whole_rest_(decomposed(rest_pose(model))), joint_of_node_(model.nodes.size(), -1) {
  diagonal_ = SurfaceBox(mesh).diagonal();
  find_joints();
  if (joints_.empty())
    throw std::runtime_error(model.name + " has no skin to keep: leave --onto-skin out, and it gets a new one");
  if (joints_.size() > most_joints)
    throw std::runtime_error(model.name + " has " + std::to_string(joints_.size()) + " joints, and at most " +
                             std::to_string(most_joints) + " can be fitted: take --as skin or --as morph");
  find_vertices(mesh);
  find_ties(mesh, ties);
  keep_moving_nodes();
  Moments moments(slots_.size());
  for (const Row& row : vertices_) moments.add(row, row.weight);
  still_ = std::make_shared<const Moments>(moments);
  for (const Tie& tie : ties_) moments.add(tie.row, tie.row.weight);
  const System at_rest = system({moments, glm::dvec3(0), nullptr, nullptr, 0, 0, 0, 0}, rest_);
  double mean = 0;
  for (const Joint& joint : joints_)
    for (int c = 0; c < 3; ++c)
      mean += at_rest.matrix[static_cast<size_t>(joint.rotation + c) * (unknowns_ + 1)] /
              (3 * static_cast<double>(joints_.size()));
  stiffness_ = keep_rest * mean;
  evenness_ = keep_even * mean;
}

// Joints at or above an influence, parents first.
void RigFit::find_joints() {
  std::vector<char> used(model_.nodes.size(), 0), is_joint(model_.nodes.size(), 0), carries(model_.nodes.size(), 0);
  for (const Skin& skin : model_.skins)
    for (const int node : skin.joints) is_joint[static_cast<size_t>(node)] = 1;
  for (const Node& node : model_.nodes) {
    if (node.mesh < 0 || node.skin < 0) continue;
    const Skin& skin = model_.skins[static_cast<size_t>(node.skin)];
    for (const Primitive& primitive : model_.meshes[static_cast<size_t>(node.mesh)].primitives) {
      for (const Influences& influences : primitive.influences) {
        for (size_t k = 0; k < influences.weights.size(); ++k) {
          if (!(influences.weights[k] > 0)) continue;
          carries[static_cast<size_t>(skin.joints[influences.joints[k]])] = 1;
          for (int n = skin.joints[influences.joints[k]]; n >= 0 && !used[static_cast<size_t>(n)];
               n = model_.nodes[static_cast<size_t>(n)].parent)
            used[static_cast<size_t>(n)] = is_joint[static_cast<size_t>(n)];
        }
      }
    }
  }
  std::vector<int> order;
  for (size_t n = 0; n < model_.nodes.size(); ++n)
    if (model_.nodes[n].parent < 0) order.push_back(static_cast<int>(n));
  for (size_t i = 0; i < order.size(); ++i)
    for (const int child : model_.nodes[static_cast<size_t>(order[i])].children) order.push_back(child);
  for (const int node : order) {
    const auto n = static_cast<size_t>(node);
    if (!used[n] || whole_rest_[n].fixed) continue;
    Joint joint;
    joint.node = node;
    joint.parent = joint_above(model_.nodes[n].parent);
    joint_of_node_[n] = static_cast<int>(joints_.size());
    joints_.push_back(joint);
  }
  number_unknowns(carries);
}

// Every joint turns; some shift. The path of a body goes into one joint. If two joints move the same vertices, only the
// upper of the joints that the model's own clips move shifts. carries: by node, whether vertices follow it.
void RigFit::number_unknowns(const std::vector<char>& carries) {
  const Pose& rest = whole_rest_;
  const std::vector<glm::dmat4> globals = global_matrices(model_, rest);
  // By joint: its only child, if the joint moves no other vertices than the child.
  std::vector<int> children(joints_.size(), 0), only(joints_.size(), -1);
  for (size_t j = 0; j < joints_.size(); ++j) {
    const int up = joints_[j].parent;
    if (up >= 0 && ++children[static_cast<size_t>(up)] == 1) only[static_cast<size_t>(up)] = static_cast<int>(j);
  }
  for (size_t n = 0; n < model_.nodes.size(); ++n) {
    const bool holds = carries[n] || (model_.nodes[n].mesh >= 0 && model_.nodes[n].skin < 0);
    const int above = holds ? joint_above(static_cast<int>(n)) : -1;
    if (above >= 0) children[static_cast<size_t>(above)] = 2;
  }
  std::vector<char> moving(joints_.size(), 0), done(joints_.size(), 0);  // done: one above shifts the same vertices
  for (size_t j = 0; j < joints_.size(); ++j) {
    const auto n = static_cast<size_t>(joints_[j].node);
    // in world units: the clip's path under the parent's rest transform
    const int up = model_.nodes[n].parent;
    const double unit = up < 0 ? 1.0 : glm::length(glm::dvec3(globals[static_cast<size_t>(up)][0]));
    moving[j] = farthest_shift(model_, joints_[j].node, rest[n].translation) * unit > moved * diagonal_;
  }
  for (size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = joints_[j];
    joint.rotation = static_cast<int>(unknowns_);
    unknowns_ += 3;
    bool shifts = moving[j] != 0;
    if (joint.parent < 0 && !shifts) {
      shifts = true;
      for (size_t below = j; children[below] == 1 && shifts;) {
        below = static_cast<size_t>(only[below]);
        shifts = !moving[below];
      }
    }
    shifts = shifts && !done[j];
    if (children[j] == 1) done[static_cast<size_t>(only[j])] = shifts || done[j];
    if (!shifts) continue;
    joint.translation = static_cast<int>(unknowns_);
    unknowns_ += 3;
    ++shifting_;
  }
}

int RigFit::joint_above(int node) const {
  for (; node >= 0; node = model_.nodes[static_cast<size_t>(node)].parent)
    if (joint_of_node_[static_cast<size_t>(node)] >= 0) return joint_of_node_[static_cast<size_t>(node)];
  return -1;
}

// The nodes of joints and slots, and all above them. Until here, joints and slots name nodes of the model.
void RigFit::keep_moving_nodes() {
  std::vector<int> movers, number(model_.nodes.size(), -1);
  for (const Joint& joint : joints_) movers.push_back(joint.node);
  for (const Slot& slot : slots_) movers.push_back(slot.node);
  for (const int node : with_parents(model_, movers)) {
    const int parent = model_.nodes[static_cast<size_t>(node)].parent;
    number[static_cast<size_t>(node)] = static_cast<int>(nodes_.size());
    nodes_.push_back({node, parent < 0 ? -1 : number[static_cast<size_t>(parent)]});
    rest_.nodes.push_back(whole_rest_[static_cast<size_t>(node)]);
  }
  for (Joint& joint : joints_) joint.node = number[static_cast<size_t>(joint.node)];
  for (Slot& slot : slots_) slot.node = number[static_cast<size_t>(slot.node)];
}

Pose RigFit::whole(const RigPose& pose) const {
  Pose out = whole_rest_;
  for (size_t n = 0; n < nodes_.size(); ++n) out[static_cast<size_t>(nodes_[n].of_model)] = pose.nodes[n];
  return out;
}

std::vector<glm::dmat4> RigFit::globals_of(const RigPose& pose) const {
  std::vector<glm::dmat4> out;
  out.reserve(nodes_.size());
  for (size_t n = 0; n < nodes_.size(); ++n) {
    const glm::dmat4 local = local_matrix(pose.nodes[n]);
    const int up = nodes_[n].parent;
    out.push_back(up < 0 ? local : out[static_cast<size_t>(up)] * local);
  }
  return out;
}

// The slots: joints of skins, and nodes that carry a part without a skin.
size_t RigFit::slot_of(int node, const glm::dmat4& bind, int key) {
  const auto known = slot_number_.find({node, key});
  if (known != slot_number_.end()) return known->second;
  Slot slot;
  slot.node = node;
  slot.bind = bind;
  for (int n = node; n >= 0 && slot.joint < 0; n = model_.nodes[static_cast<size_t>(n)].parent)
    slot.joint = joint_of_node_[static_cast<size_t>(n)];
  slots_.push_back(slot);
  return slot_number_[{node, key}] = slots_.size() - 1;
}

void RigFit::find_vertices(const FlatMesh& mesh) {
  std::vector<double> area(mesh.welded_count, 0.0);
  std::vector<uint32_t> copies(mesh.welded_count, 0);
  uint32_t count = 0;  // of welded vertices on the surface
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (copies[mesh.welded[v]]++ == 0) count += !mesh.loose[v];
  }
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 &a = mesh.positions[mesh.triangles[t]], &b = mesh.positions[mesh.triangles[t + 1]],
                     &c = mesh.positions[mesh.triangles[t + 2]];
    for (size_t k = 0; k < 3; ++k)
      area[mesh.welded[mesh.triangles[t + k]]] += glm::length(glm::cross(b - a, c - a)) / 6;
  }
  double total = 0;
  for (const double a : area) total += a;
  vertices_.resize(mesh.positions.size());
  for (const FlatPart& part : mesh.parts) {
    const int skin = model_.nodes[static_cast<size_t>(part.node)].skin;
    const Primitive& primitive =
        model_.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    for (uint32_t i = 0; i < part.vertex_count; ++i) {
      const uint32_t flat = part.first_vertex + i, w = mesh.welded[flat];
      if (mesh.loose[flat]) continue;
      Row& row = vertices_[flat];
      // half by area and half by count, so that small feet matter
      row.weight = (0.5 * area[w] / std::max(total, 1e-300) + 0.5 / count) / copies[w];
      const glm::dvec4 place(glm::dvec3(primitive.positions[i]), 1);
      if (skin < 0 || primitive.influences.empty()) {
        row.terms.push_back({slot_of(part.node, glm::dmat4(1), -1), place});
        continue;
      }
      const Skin& from = model_.skins[static_cast<size_t>(skin)];
      const Influences& influences = primitive.influences[i];
      for (size_t k = 0; k < influences.weights.size(); ++k) {
        if (!(influences.weights[k] > 0)) continue;
        const uint16_t joint = influences.joints[k];
        row.terms.push_back({slot_of(from.joints[joint], glm::dmat4(from.inverse_bind[joint]), skin),
                             static_cast<double>(influences.weights[k]) * place});
      }
    }
  }
}

// The rows of ties: from the point of the triangle to the vertex.
void RigFit::find_ties(const FlatMesh& mesh, const std::vector<RigTie>& ties) {
  for (const RigTie& tie : ties) {
    Tie out;
    out.tie = tie;
    out.row = vertices_[tie.vertex];
    out.row.weight = tie_weight / static_cast<double>(ties.size());
    glm::dvec3 apart = mesh.positions[tie.vertex];
    for (int c = 0; c < 3; ++c) {
      if (!(tie.shares[c] > 0)) continue;
      apart -= tie.shares[c] * mesh.positions[tie.corners[c]];
      for (Term term : vertices_[tie.corners[c]].terms) {
        term.at *= -tie.shares[c];
        out.row.terms.push_back(term);
      }
    }
    out.length = glm::length(apart);
    ties_.push_back(std::move(out));
  }
}

std::vector<glm::dmat4x3> RigFit::slot_matrices(const std::vector<glm::dmat4>& globals,
                                                const glm::dvec3& centre) const {
  std::vector<glm::dmat4x3> out;
  for (const Slot& slot : slots_) {
    out.emplace_back(globals[static_cast<size_t>(slot.node)] * slot.bind);
    out.back()[3] -= centre;
  }
  return out;
}

glm::dvec3 RigFit::turned(const RigPose& pose, const RigPose& from, const std::vector<glm::dmat4>& globals,
                          const Joint& joint) const {
  const auto node = static_cast<size_t>(joint.node);
  const int up = nodes_[node].parent;
  const glm::dquat parent = up < 0 ? glm::dquat(1, 0, 0, 0) : rotation_of(globals[static_cast<size_t>(up)]);
  return parent * rotation_vector(pose.nodes[node].rotation * glm::conjugate(from.nodes[node].rotation));
}

// The depth of a vertex under the ground, 0 or more.
double RigFit::depth(const Task& task, const std::vector<glm::dmat4x3>& at, size_t vertex) const {
  if (!task.ground->sinking.empty() && task.ground->sinking[vertex]) return 0;
  double out = task.floor;
  for (const Term& term : vertices_[vertex].terms) out -= glm::dot(task.ground->up, at[term.slot] * term.at);
  return std::max(out, 0.0);
}

double RigFit::energy(const Task& task, const RigPose& pose) const {
  const Moments& moments = task.moments;
  const std::vector<glm::dmat4> globals = globals_of(pose);
  const std::vector<glm::dmat4x3> at = slot_matrices(globals, task.centre);
  double out = moments.squares();
  for (const Moments::Pair& pair : moments.pairs()) {
    const glm::dmat4x3 product = at[pair.first] * pair.sum;
    double sum = 0;
    for (int c = 0; c < 4; ++c) sum += glm::dot(product[c], at[pair.second][c]);
    out += pair.first == pair.second ? sum : 2 * sum;
  }
  for (size_t s = 0; s < slots_.size(); ++s) {
    const glm::dmat3x4& goal = moments.goal(s);
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 4; ++k) out -= 2 * at[s][k][c] * goal[c][k];
  }
  for (const Joint& joint : joints_) {
    const glm::dvec3 turn = turned(pose, rest_, globals, joint);
    out += task.stiffness * glm::dot(turn, turn);
    if (!task.middle) continue;
    const glm::dvec3 off = turned(pose, *task.middle, globals, joint);
    out += task.evenness * glm::dot(off, off);
  }
  for (size_t v = 0; task.ground && v < vertices_.size(); ++v) {
    const double deep = depth(task, at, v);
    out += task.lifting * vertices_[v].weight * deep * deep;
  }
  return out;
}

// Adds the vertices under the ground to the normal equations: a row for each.
void RigFit::add_ground(const Task& task, const std::vector<glm::dmat4>& globals, const std::vector<glm::dmat4x3>& at,
                        System& to) const {
  std::vector<glm::dvec4> moved(joints_.size(), glm::dvec4(0));  // weight times place, and the weight
  std::vector<std::pair<size_t, double>> row;
  for (size_t v = 0; v < vertices_.size(); ++v) {
    const double deep = depth(task, at, v), weight = task.lifting * vertices_[v].weight;
    if (!(deep > 0)) continue;
    std::fill(moved.begin(), moved.end(), glm::dvec4(0));
    for (const Term& term : vertices_[v].terms)
      for (int j = slots_[term.slot].joint; j >= 0; j = joints_[static_cast<size_t>(j)].parent)
        moved[static_cast<size_t>(j)] += glm::dvec4(at[term.slot] * term.at, term.at.w);
    row.clear();
    for (size_t j = 0; j < joints_.size(); ++j) {
      if (moved[j] == glm::dvec4(0)) continue;
      const Joint& joint = joints_[j];
      const glm::dvec3 from = glm::dvec3(globals[static_cast<size_t>(joint.node)][3]) - task.centre,
                       turn = glm::cross(glm::dvec3(moved[j]) - moved[j].w * from, task.ground->up);
      for (int c = 0; c < 3; ++c) {
        row.emplace_back(static_cast<size_t>(joint.rotation + c), turn[c]);
        if (joint.translation >= 0)
          row.emplace_back(static_cast<size_t>(joint.translation + c), moved[j].w * task.ground->up[c]);
      }
    }
    for (const auto& [a, x] : row) {
      to.rhs[a] += weight * deep * x;
      for (const auto& [b, y] : row) to.matrix[a * unknowns_ + b] += weight * x * y;
    }
  }
}

// The normal equations: sums over the tree of the moments.
RigFit::System RigFit::system(const Task& task, const RigPose& pose) const {
  const Moments& moments = task.moments;
  const glm::dvec3& centre = task.centre;
  const RigPose* middle = task.middle;
  const std::vector<glm::dmat4> globals = globals_of(pose);
  const std::vector<glm::dmat4x3> at = slot_matrices(globals, centre);
  const size_t count = joints_.size(), n = unknowns_;
  struct Block {
    glm::dmat3 product{0.0};  // of places
    glm::dvec3 first{0.0};    // place of the first times the weight of the second
    double weight = 0;
  };
  std::vector<Block> blocks(count * count);
  std::vector<glm::dmat4x3> left(slots_.size());
  for (size_t s = 0; s < slots_.size(); ++s) left[s] = glm::transpose(moments.goal(s));
  const auto add = [&](size_t a, size_t b, const glm::dmat4& sum) {
    const int i = slots_[a].joint, j = slots_[b].joint;
    const glm::dmat4x3 moved = at[a] * sum;
    left[b] -= moved;
    if (i < 0 || j < 0) return;
    Block& block = blocks[static_cast<size_t>(i) * count + static_cast<size_t>(j)];
    block.product += moved * glm::transpose(at[b]);
    block.first += moved[3];
    block.weight += sum[3][3];
  };
  for (const Moments::Pair& pair : moments.pairs()) {
    add(pair.first, pair.second, pair.sum);
    if (pair.first != pair.second) add(pair.second, pair.first, glm::transpose(pair.sum));
  }
  const auto sum_up = [](Block& into, const Block& from) {
    into.product += from.product;
    into.first += from.first;
    into.weight += from.weight;
  };
  for (size_t a = count; a-- > 0;)
    if (joints_[a].parent >= 0)
      for (size_t b = 0; b < count; ++b)
        sum_up(blocks[static_cast<size_t>(joints_[a].parent) * count + b], blocks[a * count + b]);
  for (size_t b = count; b-- > 0;)
    if (joints_[b].parent >= 0)
      for (size_t a = 0; a < count; ++a)
        sum_up(blocks[a * count + static_cast<size_t>(joints_[b].parent)], blocks[a * count + b]);
  std::vector<glm::dvec3> torque(count, glm::dvec3(0)), force(count, glm::dvec3(0));
  for (size_t s = 0; s < slots_.size(); ++s) {
    if (slots_[s].joint < 0) continue;
    const auto j = static_cast<size_t>(slots_[s].joint);
    for (int c = 0; c < 4; ++c) torque[j] += glm::cross(at[s][c], left[s][c]);
    force[j] += left[s][3];
  }
  for (size_t a = count; a-- > 0;)
    if (joints_[a].parent >= 0) {
      torque[static_cast<size_t>(joints_[a].parent)] += torque[a];
      force[static_cast<size_t>(joints_[a].parent)] += force[a];
    }
  System out;
  out.matrix.assign(n * n, 0.0);
  out.rhs.assign(n, 0.0);
  const auto entry = [&](int row, int column) -> double& {
    return out.matrix[static_cast<size_t>(row) * n + static_cast<size_t>(column)];
  };
  for (size_t a = 0; a < count; ++a) {
    const glm::dvec3 from = glm::dvec3(globals[static_cast<size_t>(joints_[a].node)][3]) - centre;
    const glm::dvec3 turn = torque[a] - glm::cross(from, force[a]), rest = turned(pose, rest_, globals, joints_[a]),
                     off = middle ? turned(pose, *middle, globals, joints_[a]) : glm::dvec3(0);
    for (int c = 0; c < 3; ++c) {
      out.rhs[static_cast<size_t>(joints_[a].rotation + c)] =
          turn[c] - task.stiffness * rest[c] - task.evenness * off[c];
      if (joints_[a].translation >= 0) out.rhs[static_cast<size_t>(joints_[a].translation + c)] = force[a][c];
    }
    for (size_t b = 0; b < count; ++b) {
      const Block &here = blocks[a * count + b], &there = blocks[b * count + a];
      const glm::dvec3 to = glm::dvec3(globals[static_cast<size_t>(joints_[b].node)][3]) - centre;
      const glm::dmat3 arms = here.product - glm::outerProduct(from, there.first) - glm::outerProduct(here.first, to) +
                              here.weight * glm::outerProduct(from, to);
      const double trace = arms[0][0] + arms[1][1] + arms[2][2];
      const glm::dvec3 arm = here.first - here.weight * from;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
          entry(joints_[a].rotation + r, joints_[b].rotation + c) = (r == c ? trace : 0.0) - arms[r][c];
        if (joints_[b].translation < 0) continue;
        for (int c = 0; c < 3; ++c) {
          glm::dvec3 axis(0);
          axis[c] = 1;
          const double value = glm::cross(arm, axis)[r];
          entry(joints_[a].rotation + r, joints_[b].translation + c) = value;
          entry(joints_[b].translation + c, joints_[a].rotation + r) = value;
        }
        if (joints_[a].translation >= 0) entry(joints_[a].translation + r, joints_[b].translation + r) = here.weight;
      }
    }
  }
  if (task.ground) add_ground(task, globals, at, out);
  return out;
}

// A step of the pose; turns of more than 0.7 radians are cut.
RigPose RigFit::stepped(const RigPose& pose, const std::vector<double>& step) const {
  const std::vector<glm::dmat4> globals = globals_of(pose);
  RigPose out = pose;
  for (const Joint& joint : joints_) {
    const auto node = static_cast<size_t>(joint.node);
    const int up = nodes_[node].parent;
    const glm::dmat4 above = up < 0 ? glm::dmat4(1) : globals[static_cast<size_t>(up)];
    const glm::dquat parent = rotation_of(above);
    const auto r = static_cast<size_t>(joint.rotation);
    glm::dvec3 turn(step[r], step[r + 1], step[r + 2]);
    if (glm::length(turn) > most_turn) turn *= most_turn / glm::length(turn);
    out.nodes[node].rotation =
        glm::normalize(glm::conjugate(parent) * exponential(turn) * parent * pose.nodes[node].rotation);
    if (joint.translation < 0) continue;
    const auto t = static_cast<size_t>(joint.translation);
    out.nodes[node].translation += glm::inverse(glm::dmat3(above)) * glm::dvec3(step[t], step[t + 1], step[t + 2]);
  }
  return out;
}

RigPose RigFit::fit(const std::vector<double>& frame, const RigPose& start, const std::vector<double>& firm,
                    const Beside& beside, const RigGround* ground, size_t number) const {
  const RigPose* middle = beside.middle;
  const auto place = [&](uint32_t v) { return place_of(frame, v); };
  // places count from the middle, so that sums keep their digits far from the origin
  glm::dvec3 centre(0);
  const auto counts = [](const Row& row) { return row.weight > 0; };  // loose parts do not
  const auto count = static_cast<double>(std::count_if(vertices_.begin(), vertices_.end(), counts));
  for (uint32_t v = 0; v < vertices_.size(); ++v)
    if (counts(vertices_[v])) centre += place(v) / count;
  Moments moments = *still_;
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    const Row& row = vertices_[v];
    const double more = firm.empty() ? 0.0 : row.weight * beside.firm * foot_weight * firm[v];
    if (more > 0) {
      moments.add(row, more);
      moments.want(row, more, place(v) - centre);
    }
    moments.want(row, row.weight, (beside.moved ? place_of(*beside.moved, v) : place(v)) - centre);
  }
  for (const Tie& tie : ties_) {
    glm::dvec3 apart = place(tie.tie.vertex);
    for (int c = 0; c < 3; ++c)
      if (tie.tie.shares[c] > 0) apart -= tie.tie.shares[c] * place(tie.tie.corners[c]);
    const double length = glm::length(apart);
    const double weight = beside.rest * tie.row.weight;
    moments.add(tie.row, weight);
    moments.want(tie.row, weight, length > tie.length ? tie.length / length * apart : apart);
  }
  const Task task = {moments,
                     centre,
                     middle,
                     ground,
                     ground ? ground->heights[number] - glm::dot(ground->up, centre) : 0.0,
                     beside.rest * stiffness_,
                     beside.rest * evenness_,
                     beside.firm * ground_weight};
  RigPose pose = start;
  double now = energy(task, pose), damping = first_damping;
  const size_t n = unknowns_;
  // Turns and shifts have means of their own: the ratio of their diagonals is the unit squared.
  std::vector<size_t> shifts(n, 0);
  for (const Joint& joint : joints_)
    for (int c = 0; c < 3 && joint.translation >= 0; ++c) shifts[static_cast<size_t>(joint.translation + c)] = 1;
  for (int round = 0; round < most_steps; ++round) {
    const System to = system(task, pose);
    double mean[2] = {0, 0}, count[2] = {0, 0};
    for (size_t i = 0; i < n; ++i) {
      mean[shifts[i]] += to.matrix[i * (n + 1)];
      ++count[shifts[i]];
    }
    for (int kind = 0; kind < 2; ++kind) mean[kind] /= std::max(1.0, count[kind]);
    const double before = now;
    for (int attempt = 0; attempt < most_attempts && now == before; ++attempt) {
      std::vector<double> matrix = to.matrix, step = to.rhs;
      for (size_t i = 0; i < n; ++i) matrix[i * (n + 1)] += damping * matrix[i * (n + 1)] + lift * mean[shifts[i]];
      for (const Joint& joint : joints_)
        for (int c = 0; c < 3; ++c)
          matrix[static_cast<size_t>(joint.rotation + c) * (n + 1)] += task.stiffness + (middle ? task.evenness : 0);
      solve(matrix, step);
      RigPose next = stepped(pose, step);
      const double then = energy(task, next);
      if (then < now) {
        pose = std::move(next);
        now = then;
        damping = std::max(damping * less_damping, least_damping);
      } else
        damping *= more_damping;
    }
    if (before - now < still_enough * before) break;
  }
  return pose;
}

// The distance of the vertices of a pose from the vertices of a frame.
std::vector<double> RigFit::missed(const RigPose& pose, const std::vector<double>& frame) const {
  const std::vector<glm::dmat4x3> at = slot_matrices(globals_of(pose), glm::dvec3(0));
  std::vector<double> out;
  out.reserve(frame.size());
  for (size_t v = 0; v < vertices_.size(); ++v) {
    glm::dvec3 miss = -place_of(frame, v);
    for (const Term& term : vertices_[v].terms) miss += at[term.slot] * term.at;
    out.insert(out.end(), {miss.x, miss.y, miss.z});
  }
  return out;
}

std::vector<RigPose> RigFit::fit_all(const std::vector<double>& times, const std::vector<std::vector<double>>& frames,
                                     const std::function<std::vector<double>(size_t)>& firm,
                                     const RigGround* ground) const {
  Holds holds = holds_of(times, frames, hold_step * diagonal_);
  const size_t count = holds.all.size();
  const auto meet = [&](Hold& hold, const RigPose& start, const Beside& beside) {
    hold.pose = fit(frames[hold.frame], start, firm(hold.frame), beside, ground, hold.frame);
    const std::vector<double> before = std::move(hold.miss);
    hold.miss = missed(hold.pose, frames[hold.frame]);
    if (!before.empty()) hold.changed = step_between(before, hold.miss);
  };
  for (size_t h = 0; h < count; ++h) meet(holds.all[h], h == 0 ? rest_ : holds.all[h - 1].pose, {});
  // Then each follows those beside it, there and back, until it and they stay where they are. If there are only two,
  // neither lies between others: each would lag behind the other.
  for (int round = 0; round < most_rounds && count > 2; ++round) {
    for (size_t k = 0; k < count; ++k) {
      const size_t h = round % 2 == 0 ? k : count - 1 - k;
      Hold& hold = holds.all[h];
      const Hold *left = h > 0        ? &holds.all[h - 1]
                         : holds.loop ? &holds.all.back()
                                      : nullptr,
                 *right = h + 1 < count ? &holds.all[h + 1]
                          : holds.loop  ? &holds.all.front()
                                        : nullptr;
      const double changed = std::max({hold.changed, left ? left->changed : 0, right ? right->changed : 0});
      if (changed < settled * diagonal_) continue;
      const double pull = keep_miss / (hold.count + keep_miss * ((left ? 1 : 0) + (right ? 1 : 0))),
                   own = hold.count / keep_miss * pull;
      std::vector<double> moved = frames[hold.frame];
      for (const Hold* beside : {left, right})
        for (size_t i = 0; beside && i < moved.size(); ++i) moved[i] += pull * beside->miss[i];
      const double share = left && right ? left->pause / std::max(left->pause + hold.pause, 1e-300) : 0.5;
      const RigPose &first = (left ? left : right)->pose, &last = (right ? right : left)->pose;
      RigPose middle = hold.pose;
      for (const Joint& joint : joints_) {
        const auto node = static_cast<size_t>(joint.node);
        middle.nodes[node].rotation = glm::slerp(first.nodes[node].rotation, last.nodes[node].rotation, share);
      }
      meet(hold, hold.pose, {&middle, &moved, own, (1 + 2 * keep_miss) * own});
    }
  }
  std::vector<RigPose> out;
  for (const size_t hold : holds.of_frame) out.push_back(holds.all[hold].pose);
  return out;
}

Animation RigFit::clip(const std::string& name, const std::vector<double>& times,
                       const std::vector<RigPose>& poses) const {
  Animation out;
  out.name = name;
  for (const Joint& joint : joints_) {
    const auto node = static_cast<size_t>(joint.node);
    Channel rotation, translation;
    rotation.node = translation.node = nodes_[node].of_model;
    rotation.path = Path::rotation;
    rotation.width = 4;
    rotation.times.assign(times.begin(), times.end());
    translation.times = rotation.times;
    glm::dquat before(1, 0, 0, 0);
    for (const RigPose& pose : poses) {
      glm::dquat q = pose.nodes[node].rotation;
      if (glm::dot(q, before) < 0) q = -q;
      before = q;
      for (const double value : {q.x, q.y, q.z, q.w}) rotation.values.push_back(static_cast<float>(value));
      for (int c = 0; c < 3; ++c) translation.values.push_back(static_cast<float>(pose.nodes[node].translation[c]));
    }
    out.channels.push_back(std::move(rotation));
    if (joint.translation >= 0) out.channels.push_back(std::move(translation));
  }
  return out;
}

}  // namespace hf_gltf
