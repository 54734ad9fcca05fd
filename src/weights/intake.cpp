#include "weights/intake.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "mesh/place_reader.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

// Refuses parents in a circle: a walk from every bone up, which ends where an earlier walk was.
void check_parents(const Bones& bones, Memory& memory) {
  Vector<Index> walk(bones.head.size(), -1, &memory);
  for (Index b = 0; b < bones.count(); ++b) {
    for (Index up = b; up >= 0 && walk[at(up)] < 0; up = bones.parent[at(up)]) {
      walk[at(up)] = b;
      const Index next = bones.parent[at(up)];
      if (next >= 0 && walk[at(next)] == b)
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(next), "joint %d is an ancestor of itself", next);
    }
  }
}

solve::Site pin_site(const mesh::Mesh& mesh, const mesh::SurfacePlace& place) noexcept {
  solve::Site site;
  std::copy_n(place.vertex, 3, site.vertex);
  std::copy_n(place.weight, 3, site.weight);
  site.component = mesh.component[at(place.vertex[0])];
  return site;
}

void read_pin_weights(const hf_pins_desc& desc, std::uint32_t i, std::uint32_t bones, Pins& pins) {
  double sum = 0;
  const std::size_t first = pins.share.size();
  for (std::uint32_t k = 0; k < desc.influence_count; ++k) {
    const std::size_t entry = std::size_t{i} * desc.influence_count + k;
    const std::uint32_t joint = desc.joints[entry];
    const double weight = static_cast<double>(desc.weights[entry]);
    if (joint >= bones)
      fail(HF_ERROR_OUT_OF_RANGE, i, "influence %u of pin %u is joint %u, but there are %u joints", k, i, joint, bones);
    if (!std::isfinite(weight)) fail(HF_ERROR_NON_FINITE, i, "weight %u of pin %u is not finite", k, i);
    if (weight < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "weight %u of pin %u is %g; it must not be negative", k, i, weight);
    if (!(weight > 0)) continue;
    sum += weight;
    // A bone named twice counts once, with both weights.
    std::size_t there = first;
    while (there < pins.bone.size() && pins.bone[there] != static_cast<Index>(joint)) ++there;
    if (there < pins.bone.size()) {
      pins.share[there] += weight;
    } else {
      pins.bone.push_back(static_cast<Index>(joint));
      pins.share.push_back(weight);
    }
  }
  if (!(sum > 0)) fail(HF_ERROR_INVALID_ARGUMENT, i, "the weights of pin %u are all 0; one must be above 0", i);
  for (std::size_t k = first; k < pins.share.size(); ++k) pins.share[k] /= sum;
  pins.start.push_back(static_cast<Index>(pins.bone.size()));
}

// The weights of locks by inner vertex, in the order of `bones`.
void read_lock_values(const mesh::Mesh& mesh, std::uint32_t count, const float* values, Vector<float>& out) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t given = mesh::given_vertex(mesh, v);
    for (std::uint32_t i = 0; i < count; ++i) {
      const float value = values[std::size_t{given} * count + i];
      if (!std::isfinite(value)) fail(HF_ERROR_NON_FINITE, given, "value %u of vertex %u is not finite", i, given);
      if (value < 0 || value > 1)
        fail(HF_ERROR_INVALID_ARGUMENT, given, "value %u of vertex %u is %g; it must be 0 to 1", i, given,
             static_cast<double>(value));
      out.push_back(value);
    }
  }
}

}  // namespace

void check_bones(std::uint32_t joint_count, const double* heads) {
  require_list(joint_count, heads, "joint_count", "heads");
  if (joint_count > most_bones)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; the limit is %u", joint_count, most_bones);
}

Vec3 read_bone_point(const double* points, std::uint32_t i, const char* name) {
  const double* p = points + 3 * std::size_t{i};
  if (!is_finite_point(p)) fail(HF_ERROR_NON_FINITE, i, "%s: the point of joint %u is not finite", name, i);
  return {p[0], p[1], p[2]};
}

void read_first_bones(const hf_joints_desc& desc, Bones& bones, Memory& memory) {
  if (desc.sources)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "sources is set, but there were no joints before; set it to NULL");
  read_bones(desc, bones, memory);
}

void read_bones(const hf_joints_desc& desc, Bones& bones, Memory& memory) {
  check_bones(desc.joint_count, desc.heads);
  if (desc.tails && desc.axes) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "tails and axes are both set; set one");
  bones.has_tails = desc.tails != nullptr;
  for (std::uint32_t b = 0; b < desc.joint_count; ++b) {
    bones.head.push_back(read_bone_point(desc.heads, b, "heads"));
    if (desc.tails) bones.tail.push_back(read_bone_point(desc.tails, b, "tails"));
    if (desc.axes) bones.axis.push_back(unit_vector(read_bone_point(desc.axes, b, "axes")));
    const std::uint32_t parent = desc.parents ? desc.parents[b] : HF_NO_INDEX;
    if (parent != HF_NO_INDEX && parent >= desc.joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, b, "the parent of joint %u is %u, but there are %u joints", b, parent,
           desc.joint_count);
    bones.parent.push_back(parent == HF_NO_INDEX ? -1 : static_cast<Index>(parent));
    const std::int32_t deforms = desc.deforms ? desc.deforms[b] : 1;
    if (deforms != 0 && deforms != 1)
      fail(HF_ERROR_INVALID_ARGUMENT, b, "deforms of joint %u is %d; it must be 0 or 1", b, deforms);
    bones.deforms.push_back(static_cast<std::uint8_t>(deforms));
  }
  check_parents(bones, memory);
}

Vector<Index> read_sources(const hf_joints_desc& desc, std::uint32_t before, Memory& memory) {
  Vector<Index> sources(&memory);
  Vector<std::uint8_t> named(before, 0, &memory);
  for (std::uint32_t b = 0; desc.sources && b < desc.joint_count; ++b) {
    const std::uint32_t source = desc.sources[b];
    if (source == HF_NO_INDEX) {
      sources.push_back(-1);
      continue;
    }
    if (source >= before)
      fail(HF_ERROR_OUT_OF_RANGE, b, "the source of joint %u is %u, but there were %u joints", b, source, before);
    if (named[source]) fail(HF_ERROR_DUPLICATE, b, "the source %u of joint %u is named twice", source, b);
    named[source] = 1;
    sources.push_back(static_cast<Index>(source));
  }
  return sources;
}

void read_pins(const hf_pins_desc& desc, const mesh::Mesh& mesh, std::uint32_t bones, Pins& pins, Memory& memory) {
  require_zero(desc.reserved);
  if (desc.pin_count == 0) return;
  const mesh::Places places(desc.pin_count, desc.vertices, desc.places, desc.points);
  require(desc.joints, "joints");
  require(desc.weights, "weights");
  if (desc.influence_count < 1 || desc.influence_count > most_influences)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "influence_count is %u; it must be 1 to %d", desc.influence_count,
         most_influences);
  if (desc.pin_count > mesh.report.vertex_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "pin_count is %u; the mesh has %u vertices", desc.pin_count,
         mesh.report.vertex_count);
  const mesh::PlaceReader reader(mesh, places, memory);
  for (std::uint32_t i = 0; i < desc.pin_count; ++i) {
    pins.places.push_back(pin_site(mesh, reader.read(i)));
    const double radius = desc.radii ? desc.radii[i] : 0.0;
    if (!std::isfinite(radius)) fail(HF_ERROR_NON_FINITE, i, "the radius of pin %u is not finite", i);
    if (radius < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "the radius of pin %u is %g; it must not be negative", i, radius);
    pins.radius.push_back(radius / mesh.scale);
    read_pin_weights(desc, i, bones, pins);
  }
}

LockInput read_locks(const mesh::Mesh& mesh, std::uint32_t joint_count, std::uint32_t count, const std::uint32_t* bones,
                     const float* values, Memory& memory) {
  if (count > joint_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "lock_count is %u, but there are %u joints", count, joint_count);
  if (count > 0) require(bones, "joints");
  LockInput locks(&memory);
  Vector<std::uint8_t> named(joint_count, 0, &memory);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (bones[i] >= joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of joints is %u, but there are %u joints", i, bones[i], joint_count);
    if (named[bones[i]]) fail(HF_ERROR_DUPLICATE, i, "entry %u of joints names joint %u again", i, bones[i]);
    named[bones[i]] = 1;
    locks.bones.push_back(static_cast<Index>(bones[i]));
  }
  if (values && count > 0) read_lock_values(mesh, count, values, locks.values);
  return locks;
}

std::uint32_t bone_flags(std::uint32_t faults) noexcept {
  const bool odd = (faults & (bone_no_length | bone_coincident | bone_outside)) != 0;
  return odd && (faults & bone_informs_none) ? faults | HF_JOINT_HELPER : faults;
}

BoneFlagCounts count_bone_flags(Span<const std::uint32_t> faults) noexcept {
  BoneFlagCounts out;
  for (const std::uint32_t of_bone : faults) {
    const std::uint32_t flags = bone_flags(of_bone);
    out.no_length += (flags & HF_JOINT_NO_LENGTH) != 0;
    out.coincident += (flags & HF_JOINT_COINCIDENT) != 0;
    out.informs_none += (flags & HF_JOINT_INFORMS_NONE) != 0;
    out.outside += (flags & HF_JOINT_OUTSIDE) != 0;
    out.helper += (flags & HF_JOINT_HELPER) != 0;
  }
  return out;
}

}  // namespace hf_inner::weights
