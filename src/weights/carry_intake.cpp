#include "weights/carry_intake.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/arguments.h"
#include "base/elementary.h"
#include "mesh/link_constants.h"
#include "weights/bone_names.h"
#include "weights/constants.h"
#include "weights/intake.h"

namespace hf_inner::weights {
namespace {

// Checks the arrays of a desc: weights of every vertex, joints below most_bones.
template <class Desc>
GivenWeights read_given(const Desc& desc, const mesh::Mesh& mesh, std::uint32_t limit) {
  if (desc.source_influence_count < 1 || desc.source_influence_count > mesh::most_skin_joints)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "source_influence_count is %u; it must be 1 to %u",
         desc.source_influence_count, mesh::most_skin_joints);
  require(desc.joints, "joints");
  require(desc.weights, "weights");
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    for (std::uint32_t k = 0; k < desc.source_influence_count; ++k) {
      const std::size_t i = std::size_t{v} * desc.source_influence_count + k;
      const float w = desc.weights[i];
      if (!std::isfinite(w)) fail(HF_ERROR_NON_FINITE, v, "weight %u of vertex %u is not finite", k, v);
      if (w < 0)
        fail(HF_ERROR_INVALID_ARGUMENT, v, "weight %u of vertex %u is %g; it must not be negative", k, v,
             static_cast<double>(w));
      if (w > 0 && desc.joints[i] >= limit)
        fail(HF_ERROR_OUT_OF_RANGE, v, "joint %u of vertex %u is %u; it must be below %u", k, v, desc.joints[i], limit);
    }
  }
  return {desc.source_influence_count, desc.joints, desc.weights};
}

// scale: of the mesh with the weights.
template <class Desc>
MatchOptions match_options(const Desc& desc, double scale) {
  require_zero(desc.reserved);
  check_finite(desc.distance, "distance");
  check_finite(desc.angle, "angle");
  if (desc.distance < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "distance is below 0");
  if (desc.angle < 0 || desc.angle > most_angle)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "angle is %g; it must be 0 to %g radians", desc.angle, most_angle);
  MatchOptions out;
  out.distance = desc.distance == 0 ? carry_distance : desc.distance / scale;
  const double angle = desc.angle == 0 ? carry_angle : desc.angle;
  out.cosine = angle >= any_angle ? -2 : cosine(angle) - equal_cosine;
  out.influences = weights_per_vertex(desc.influence_count);
  return out;
}

void read_partners(const hf_weights_mirror_desc& desc, MirrorBones& bones) {
  for (std::uint32_t b = 0; desc.partners && b < desc.joint_count; ++b) {
    const std::uint32_t partner = desc.partners[b];
    if (partner == HF_NO_INDEX) continue;
    if (partner >= desc.joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, b, "the partner of joint %u is %u, but there are %u joints", b, partner,
           desc.joint_count);
    const std::uint32_t back = desc.partners[partner];
    if (back != HF_NO_INDEX && back != b)
      fail(HF_ERROR_INVALID_ARGUMENT, b, "the partner of joint %u is %u, but the partner of %u is %u", b, partner,
           partner, back);
  }
  // Partners of the caller come before names: bones that names pair with others lose those partners.
  const auto set = [&](std::uint32_t b, std::uint32_t partner) {
    const Index old = bones.partner[b];
    if (old >= 0 && at(old) != partner && bones.partner[at(old)] == static_cast<Index>(b)) bones.partner[at(old)] = -1;
    bones.partner[b] = static_cast<Index>(partner);
    bones.given[b] = 1;
  };
  for (std::uint32_t b = 0; desc.partners && b < desc.joint_count; ++b) {
    if (desc.partners[b] != HF_NO_INDEX) {
      set(b, desc.partners[b]);
      set(desc.partners[b], b);
    }
  }
}

}  // namespace

Span<const char> read_bone_names(const char* names, std::size_t bones, Memory& memory) {
  if (!names) return {};
  const Span<const char> text{names, std::strlen(names)};
  const std::size_t lines = split_names(text, memory).size();
  if (lines != bones)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "names has %zu lines, but there are %zu joints; end each with a newline", lines, bones);
  return text;
}

GivenWeights read_carried(const hf_weights_transfer_desc& desc, const mesh::Mesh& source) {
  return read_given(desc, source, most_bones);
}

MatchOptions read_carry(const hf_weights_transfer_desc& desc, const mesh::Mesh& source) {
  return match_options(desc, source.scale);
}

GivenWeights read_mirrored(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh) {
  return read_given(desc, mesh, desc.joint_count);
}

MirrorBones read_mirror_bones(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh, Memory& memory) {
  MirrorBones bones(memory);
  check_bones(desc.joint_count, desc.heads);
  const auto clamped = [](double x) { return std::min(std::max(x, -farthest), farthest); };
  for (std::uint32_t b = 0; b < desc.joint_count; ++b) {
    const Vec3 inner = mesh.to_inner(read_bone_point(desc.heads, b, "heads"));
    bones.heads.push_back({clamped(inner.x), clamped(inner.y), clamped(inner.z)});
  }
  bones.partner = pair_names(read_bone_names(desc.names, desc.joint_count, memory), desc.joint_count, memory);
  bones.given.assign(desc.joint_count, 0);
  read_partners(desc, bones);
  return bones;
}

MirrorOptions read_mirror(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh) {
  MirrorOptions options;
  options.carry = match_options(desc, mesh.scale);
  check_choice(desc.to, 3, "to");
  options.to = static_cast<MirrorTo>(desc.to);
  if (!desc.plane) return options;
  for (int i = 0; i < 6; ++i) {
    if (!std::isfinite(desc.plane[i])) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "number %d of plane is not finite", i);
  }
  const double* n = desc.plane + 3;
  const double most = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
  if (!(most > 0)) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the normal of plane has no length");
  const Vec3 scaled{n[0] / most, n[1] / most, n[2] / most};
  options.has_plane = true;
  options.plane.normal = (1 / norm(scaled)) * scaled;
  options.plane.offset = dot(options.plane.normal, mesh.to_inner({desc.plane[0], desc.plane[1], desc.plane[2]}));
  return options;
}

}  // namespace hf_inner::weights
