#include "deform/skin.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::deform {
namespace {

// The next numbers fit the joints of a skin to the posed surface. With stretching joints, the skin of a lifted plane is
// within 0.2 % of the box, with rigid joints within 2.5 %. Bends and twists come within 0.1 % instead of 0.6 %.
//
// At most this many vertices fit the joints. Fewer take less time. Meshes with fewer use all, as a bent tube does: half
// and double change nothing.
constexpr double skin_vertices = 20000;
// One round fits every joint of a skin once: each takes an eighth of the time. On a bent tube half leaves a mean
// distance of 0.1525 % instead of 0.1519, double changes nothing.
constexpr int skin_rounds = 8;
// One round fits the rotation of a joint, then its stretch. They end early: half and double change nothing on a bent
// tube.
constexpr int stretch_rounds = 6;
// This share of a joint's second moments (how far its vertices spread along each axis) is added to them. A joint
// without extent in a direction keeps the scale 1 there. More would hold joints back. Half and double leave the
// distances of a bent tube, 0.152 % in the mean, the same to four digits.
constexpr double stretch_ballast = 1e-6;
// A joint shrinks to this scale at most, so scales stay positive. It is a guard: half and double change nothing on a
// bent tube.
constexpr double least_stretch = 1e-3;

struct JointMotion {
  Quaternion rotation;
  Vec3 stretch{1, 1, 1};
  Vec3 translation;
};

// Returns the linear part R B diag(s) B' of a joint's motion: rotation R, stretch s along the axes B.
Mat3 linear_part(const JointMotion& motion, const Mat3& axes) noexcept {
  return motion.rotation.toRotationMatrix() * (axes * to_eigen(motion.stretch).asDiagonal() * axes.transpose());
}

// Fits the joints of a skin to the posed surface by least squares, in the unit of the scaled mesh.
class JointFit {
 public:
  JointFit(const Pose& pose, std::uint32_t influence_count, bool stretching, const Vector<Quaternion>& axes,
           Memory& memory)
      : pose_(pose),
        stretching_(stretching),
        axes_(&memory),
        start_(&memory),
        row_(&memory),
        rest_(&memory),
        residual_(&memory),
        area_(&memory) {
    const surface::Core& core = pose.core();
    const ClusterWeights& table = *pose.weights();
    joint_count_ = static_cast<std::size_t>(table.cluster_count);
    for (const Quaternion& q : axes) axes_.push_back(q.toRotationMatrix());
    start_.assign(joint_count_ + 1, 0);
    Vector<std::int32_t> chosen(&memory);
    for (std::int32_t v = 0; v < core.size(); ++v) {
      if (table.start[v + 1] - table.start[v] < 2) continue;  // a vertex on one joint needs no fit
      if (scattered(static_cast<std::uint32_t>(v)) * core.size() < skin_vertices) chosen.push_back(v);
    }
    std::uint32_t joint[most_joints];
    float weight[most_joints];
    for (const bool count_only : {true, false}) {
      Vector<std::int32_t> next(start_, &memory);
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        skin_weights(pose, chosen[i], influence_count, joint, weight);
        for (std::uint32_t k = 0; k < influence_count; ++k) {
          if (weight[k] <= 0) continue;
          if (count_only) {
            ++start_[joint[k] + 1];
          } else {
            row_[next[joint[k]]++] = {static_cast<std::int32_t>(i), static_cast<double>(weight[k])};
          }
        }
      }
      if (!count_only) break;
      for (std::size_t j = 0; j < joint_count_; ++j) start_[j + 1] += start_[j];
      row_.resize(start_[joint_count_]);
    }
    for (const std::int32_t v : chosen) {
      rest_.push_back(core.mesh.positions[v]);
      residual_.push_back(-1.0 * blend_vertex(core.mesh, table, pose.cluster_transforms().data(), v));
      area_.push_back(std::max(pose.rest().area[v], least_vertex_area));
    }
  }

  // Fits every joint in each of skin_rounds rounds. The residual (blended minus posed position) is kept up to date.
  void run(JointMotion* motion) {
    for (std::size_t j = 0; j < joint_count_; ++j) move(j, motion[j], 1);
    const std::size_t handles = static_cast<std::size_t>(pose_.weights()->handle_count);
    for (int round = 0; round < skin_rounds; ++round) {
      for (std::size_t j = handles; j < joint_count_; ++j) {
        move(j, motion[j], -1);
        motion[j] = fit(j, motion[j]);
        move(j, motion[j], 1);
      }
    }
  }

 private:
  struct Item {
    std::int32_t vertex;  // index into the chosen vertices
    double weight;
  };

  void move(std::size_t j, const JointMotion& motion, double sign) noexcept {
    const Mat3 r = linear_part(motion, axes_[j]);
    for (std::int32_t k = start_[j]; k < start_[j + 1]; ++k) {
      const Item& item = row_[k];
      residual_[item.vertex] =
          residual_[item.vertex] + sign * item.weight * (r * rest_[item.vertex] + motion.translation);
    }
  }

  // Fits joint j. The caller has taken joint j out of the residual, so the joint should move each vertex to -residual /
  // weight.
  JointMotion fit(std::size_t j, const JointMotion& present) const noexcept {
    double total = 0;
    Vec3 from, to;
    for (std::int32_t k = start_[j]; k < start_[j + 1]; ++k) {
      const Item& item = row_[k];
      const double w = area_[item.vertex] * item.weight;
      total += w * item.weight;
      from = from + w * item.weight * rest_[item.vertex];
      to = to + -w * residual_[item.vertex];
    }
    if (!(total > 0)) return present;
    from = (1.0 / total) * from;
    to = (1.0 / total) * to;
    Mat3 target, rest;
    for (std::int32_t k = start_[j]; k < start_[j + 1]; ++k) {
      const Item& item = row_[k];
      const double w = area_[item.vertex] * item.weight;
      const Vec3 arm = rest_[item.vertex] - from;
      add_outer(target, w, -1.0 * residual_[item.vertex] - item.weight * to, arm);
      add_outer(rest, w * item.weight, arm, arm);
    }
    JointMotion motion = present;
    if (stretching_) {
      fit_stretch(target, rest, axes_[j], motion);
    } else {
      motion.rotation = best_rotation(target, present.rotation);
    }
    motion.translation = to - linear_part(motion, axes_[j]) * from;
    return motion;
  }

  // Minimises |R B s B' - target rest^-1| in the norm of the rest moments. Rotation R and stretch s are found in turn.
  static void fit_stretch(const Mat3& target, const Mat3& rest, const Mat3& axes, JointMotion& motion) noexcept {
    const Mat3 seen = axes.transpose() * rest * axes;
    const double ballast = stretch_ballast * seen.trace();
    for (int round = 0; round < stretch_rounds; ++round) {
      const Mat3 along = (motion.rotation.toRotationMatrix() * axes).transpose() * target * axes;
      hf_eigen::Vector3d s;
      for (int i = 0; i < 3; ++i)
        s(i) = std::max(least_stretch, (along(i, i) + ballast) / std::max(seen(i, i) + ballast, least_moment));
      motion.stretch = to_vec3(s);
      motion.rotation = best_rotation(target * (axes * s.asDiagonal() * axes.transpose()), motion.rotation);
    }
  }

  const Pose& pose_;
  const bool stretching_;
  Vector<Mat3> axes_;
  std::size_t joint_count_ = 0;
  Vector<std::int32_t> start_;
  Vector<Item> row_;
  Vector<Vec3> rest_, residual_;
  Vector<double> area_;
};

}  // namespace

Vec3 skinned(const Skin& skin, std::size_t j, Vec3 p) noexcept {
  const JointMotion motion{skin.rotation[j], skin.stretch[j], {}};
  return linear_part(motion, skin.axes[j].toRotationMatrix()) * (p - skin.pivot[j]) + skin.place[j];
}

Skin make_skin(const Pose& pose, std::uint32_t influence_count, bool stretching, Memory& memory) {
  const surface::Core& core = pose.core();
  const mesh::Mesh& mesh = core.mesh;
  const ClusterWeights& weights = *pose.weights();
  const std::size_t clusters = static_cast<std::size_t>(weights.cluster_count);
  Skin skin(memory);
  Vector<Vec3> sum(clusters, Vec3(), &memory);
  Vector<double> total(clusters, 0.0, &memory);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k) {
      const double w = weights.weight[k] * std::max(pose.rest().area[v], least_vertex_area);
      sum[weights.cluster[k]] = sum[weights.cluster[k]] + w * mesh.positions[v];
      total[weights.cluster[k]] += w;
    }
  }
  const Span<const Affine> transforms = pose.cluster_transforms();
  Vector<JointMotion> motion(clusters, JointMotion(), &memory);
  for (std::size_t c = 0; c < clusters; ++c) skin.pivot.push_back(total[c] > 0 ? (1.0 / total[c]) * sum[c] : Vec3());
  Vector<Mat3> spread(clusters, Mat3::Zero(), &memory);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k) {
      const std::int32_t c = weights.cluster[k];
      const Vec3 arm = mesh.positions[v] - skin.pivot[c];
      add_outer(spread[c], weights.weight[k] * std::max(pose.rest().area[v], least_vertex_area), arm, arm);
    }
  }
  for (std::size_t c = 0; c < clusters; ++c) {
    const Vec3 pivot = skin.pivot[c];
    skin.axes.push_back(Quaternion(principal_axes(spread[c]).axes));
    if (!pose.posed()) continue;
    Mat3 linear;
    const auto& a = transforms[c].a;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) linear(i, j) = a[i][j];
    }
    motion[c].rotation = best_rotation(linear, Quaternion());
    motion[c].translation = linear * pivot + Vec3{a[0][3], a[1][3], a[2][3]} - rotate(motion[c].rotation, pivot);
  }
  if (pose.posed()) JointFit(pose, influence_count, stretching, skin.axes, memory).run(motion.data());
  for (std::size_t c = 0; c < clusters; ++c) {
    const Mat3 linear = linear_part(motion[c], skin.axes[c].toRotationMatrix());
    skin.place.push_back(mesh.to_given(linear * skin.pivot[c] + motion[c].translation));
    skin.pivot[c] = mesh.to_given(skin.pivot[c]);
    skin.rotation.push_back(motion[c].rotation);
    skin.stretch.push_back(motion[c].stretch);
  }
  skin.rest_joint = weights.unreached_vertex_count > 0 || mesh.report.isolated_vertex_count > 0;
  if (skin.rest_joint) {
    skin.pivot.push_back(mesh.centre);
    skin.place.push_back(mesh.centre);
    skin.rotation.push_back(Quaternion());
    skin.axes.push_back(Quaternion());
    skin.stretch.push_back({1, 1, 1});
  }
  return skin;
}

void skin_weights(const Pose& pose, std::int32_t vertex, std::uint32_t count, std::uint32_t* joints, float* weights) {
  const ClusterWeights& table = *pose.weights();
  std::fill_n(joints, count, 0u);
  std::fill_n(weights, count, 0.0f);
  const std::int32_t first = vertex < 0 ? 0 : table.start[vertex], last = vertex < 0 ? 0 : table.start[vertex + 1];
  if (first == last) {
    joints[0] = static_cast<std::uint32_t>(table.cluster_count);
    weights[0] = 1;
    return;
  }
  // Insertion sort keeps the largest weights; a vertex has only a few.
  double kept[most_joints] = {0};
  std::uint32_t used = 0;
  for (std::int32_t k = first; k < last; ++k) {
    std::uint32_t at = used < count ? used++ : count;
    if (at == count) {
      if (table.weight[k] <= kept[count - 1]) continue;
      at = count - 1;
    }
    for (; at > 0 && kept[at - 1] < table.weight[k]; --at) {
      kept[at] = kept[at - 1];
      joints[at] = joints[at - 1];
    }
    kept[at] = table.weight[k];
    joints[at] = static_cast<std::uint32_t>(table.cluster[k]);
  }
  double sum = 0;
  for (std::uint32_t i = 0; i < used; ++i) sum += kept[i];
  constexpr double steps = 16777216;  // 2^24
  double left = steps;
  for (std::uint32_t i = used; i-- > 1;) {
    const double whole = std::floor(steps * kept[i] / sum + 0.5);
    weights[i] = static_cast<float>(whole / steps);
    left -= whole;
    if (whole == 0) joints[i] = 0;
  }
  weights[0] = static_cast<float>(left / steps);
}

}  // namespace hf_inner::deform
