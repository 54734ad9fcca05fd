#include "rig_family.h"

#include <algorithm>

namespace hf_test {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

Vec3 turned(Vec3 v, Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * hf_inner::cross(axis, v) + ((1 - c) * hf_inner::dot(axis, v)) * axis;
}

}  // namespace

int Rig::add(const std::string& name, int parent, Vec3 pivot, Role role, Side side) {
  joints.push_back({name, parent, pivot, role, side, false, true, false});
  return static_cast<int>(joints.size()) - 1;
}

int Rig::add_helper(const std::string& name, int parent, Vec3 pivot) {
  joints.push_back({name, parent, pivot, Role::other, Side::middle, true, false, false});
  return static_cast<int>(joints.size()) - 1;
}

// Three rings of four corners with two caps.
void Rig::add_box(int owner, Vec3 a, Vec3 b, double wide) {
  const Vec3 d = hf_inner::unit_vector(b - a);
  const Vec3 x = hf_inner::unit_vector(hf_inner::cross(d, std::fabs(d.z) > 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1}));
  const Vec3 z = hf_inner::cross(x, d);
  const std::uint32_t first = static_cast<std::uint32_t>(points.size());
  for (int ring = 0; ring < 3; ++ring) {
    for (int k = 0; k < 4; ++k) {
      const double u = k == 0 || k == 3 ? wide : -wide, v = k < 2 ? wide : -wide;
      points.push_back(a + 0.5 * ring * (b - a) + u * x + v * z);
      owners.push_back(owner);
    }
  }
  const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    for (const std::uint32_t c : {p, q, r, p, r, s}) triangles.push_back(first + c);
  };
  for (std::uint32_t ring = 0; ring < 2; ++ring) {
    for (std::uint32_t k = 0; k < 4; ++k)
      quad(4 * ring + k, 4 * ring + (k + 1) % 4, 4 * ring + 4 + (k + 1) % 4, 4 * ring + 4 + k);
  }
  quad(0, 1, 2, 3);
  quad(11, 10, 9, 8);
}

void Rig::add_block(int owner, Vec3 low, Vec3 high) {
  const std::size_t first = points.size();
  const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  add_box(owner, {middle.x, low.y, middle.z}, {middle.x, high.y, middle.z}, 1);
  for (std::size_t v = first; v < points.size(); ++v) {
    points[v].x = middle.x + half.x * (points[v].x > middle.x ? 1 : -1);
    points[v].z = middle.z + half.z * (points[v].z > middle.z ? 1 : -1);
  }
}

void Rig::turn(int joint, Vec3 axis, double degrees) {
  std::vector<bool> below(joints.size(), false);
  below[static_cast<std::size_t>(joint)] = true;
  const Vec3 about = joints[static_cast<std::size_t>(joint)].pivot;
  for (std::size_t j = static_cast<std::size_t>(joint) + 1; j < joints.size(); ++j)
    below[j] = joints[j].parent >= 0 && below[static_cast<std::size_t>(joints[j].parent)];
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (below[j]) joints[j].pivot = about + turned(joints[j].pivot - about, axis, degree * degrees);
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (below[static_cast<std::size_t>(owners[v])])
      points[v] = about + turned(points[v] - about, axis, degree * degrees);
  }
}

int Rig::find(const std::string& name) const {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == name) return static_cast<int>(j);
  }
  return -1;
}

Vec3 Placing::along(Vec3 v) const {
  if (mirrored) v.x = -v.x;
  v = turned(v, {0, 1, 0}, degree * yaw);
  return z_up ? Vec3{v.x, -v.z, v.y} : v;
}

Vec3 Placing::operator()(Vec3 p) const { return scale * along(p) + offset; }

PlacedRig::PlacedRig(const Rig& given, const Placing& place) : rig(given), placing(place) {
  // Every joint has a rotation of its own: they must not matter.
  std::vector<std::array<Vec3, 4>> world;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const RigJoint& joint = rig.joints[j];
    const Vec3 axis =
        hf_inner::unit_vector({std::sin(1.0 + static_cast<double>(j)), std::cos(2.0 * static_cast<double>(j)), 0.3});
    std::array<Vec3, 4> frame;
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t c = 0; c < 3; ++c)
      frame[c] = placing.scale * placing.along(turned(axes[c], axis, 0.7 * static_cast<double>(j)));
    frame[3] = placing(joint.pivot);
    world.push_back(frame);
  }
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const RigJoint& joint = rig.joints[j];
    const std::array<Vec3, 4>& frame = world[j];
    std::array<Vec3, 4> local = frame;
    if (joint.parent >= 0) {
      const auto& p = world[static_cast<std::size_t>(joint.parent)];
      const double s = 1 / (placing.scale * placing.scale);
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec3 v = c < 3 ? frame[c] : frame[3] - p[3];
        local[c] = {s * hf_inner::dot(v, p[0]), s * hf_inner::dot(v, p[1]), s * hf_inner::dot(v, p[2])};
      }
    }
    for (std::size_t c = 0; c < 4; ++c)
      matrices.insert(matrices.end(), {local[c].x, local[c].y, local[c].z, c == 3 ? 1.0 : 0.0});
    names.push_back(joint.name.c_str());
    parents.push_back(joint.parent);
    any_declared |= joint.declared;
    roles.push_back(joint.declared ? static_cast<std::int32_t>(joint.role) : -1);
    sides.push_back(static_cast<std::int32_t>(joint.side));
  }
  for (std::size_t v = 0; v < rig.points.size(); ++v) {
    const Vec3 p = placing(rig.points[v]);
    positions.insert(positions.end(), {p.x, p.y, p.z});
    vertex_joints.push_back(rig.owners[v]);
  }
  triangles = rig.triangles;
}

hf_inner::skeleton::CharacterInput PlacedRig::input() const {
  hf_inner::skeleton::CharacterInput in;
  in.joint_count = static_cast<std::uint32_t>(parents.size());
  in.names = names.data();
  in.parents = parents.data();
  in.matrices = matrices.data();
  in.vertex_count = static_cast<std::uint32_t>(vertex_joints.size());
  in.positions = positions.data();
  in.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  in.triangles = triangles.data();
  in.vertex_joints = vertex_joints.data();
  if (any_declared) {
    in.roles = roles.data();
    in.sides = sides.data();
  }
  return in;
}

std::string PlacedRig::faults(const hf_inner::skeleton::Character& found, bool judge_roles) const {
  std::string out;
  const auto axis = [&](const char* name, Vec3 is, Vec3 truth) {
    if (hf_inner::dot(is, truth) < 0.99)
      out += std::string(name) + " is " + std::to_string(is.x) + " " + std::to_string(is.y) + " " +
             std::to_string(is.z) + "; ";
  };
  const Vec3 up = placing.along({0, 1, 0}), forward = placing.along({0, 0, 1});
  axis("up", found.up, up);
  axis("forward", found.forward, forward);
  axis("left", found.left, hf_inner::cross(up, forward));
  for (std::size_t j = 0; j < rig.joints.size() && judge_roles; ++j) {
    const RigJoint& joint = rig.joints[j];
    if (joint.helper && found.kinds[j] == hf_inner::skeleton::JointKind::body) out += joint.name + " is of the body; ";
    if (!joint.judged) continue;
    // A mirrored body has its left on the other side.
    const Side side = !placing.mirrored || joint.side == Side::middle ? joint.side
                      : joint.side == Side::left                      ? Side::right
                                                                      : Side::left;
    if (found.roles[j] != joint.role || found.sides[j] != side)
      out += joint.name + " (" + std::to_string(j) + ") is " + hf_inner::skeleton::role_name(found.roles[j]) + " " +
             std::to_string(static_cast<int>(found.sides[j])) + ", not " + hf_inner::skeleton::role_name(joint.role) +
             " " + std::to_string(static_cast<int>(side)) + "; ";
  }
  return out;
}

}  // namespace hf_test
