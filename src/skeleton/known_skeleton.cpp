// Reads hf_skeleton_desc and hf_skin_desc.
#include "skeleton/known_skeleton.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/arguments.h"
#include "skeleton/constants.h"
#include "skeleton/rest_transforms.h"

namespace hf_inner::skeleton {
namespace {

constexpr std::uint32_t most_influences = 64;  // as for weights to transfer

template <class From, class To>
void copy_array(const From* from, std::size_t count, Vector<To>& to) {
  to.assign(from, from + count);
}

void read_names(const char* given, std::uint32_t count, KnownSkeleton& out) {
  const std::size_t length = std::strlen(given);
  out.text.assign(given, given + length + 1);
  std::size_t begin = 0;
  while (begin < length) {
    out.names.push_back(out.text.data() + begin);
    while (begin < length && out.text[begin] != '\n') ++begin;
    if (begin > 0 && out.text[begin] == '\n' && out.text[begin - 1] == '\r') out.text[begin - 1] = 0;
    out.text[begin++] = 0;
  }
  // A last joint without a name may be an empty line or none.
  if (out.names.size() + 1 == count && (length == 0 || given[length - 1] == '\n')) out.names.push_back("");
  if (out.names.size() != count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "names has %zu lines; there are %u joints, and each needs one",
         out.names.size(), count);
}

void read_parents(const std::uint32_t* given, std::uint32_t count, Vector<std::int32_t>& out) {
  out.reserve(count);
  for (std::uint32_t j = 0; j < count; ++j) {
    if (given[j] != HF_NO_INDEX && given[j] >= count)
      fail(HF_ERROR_OUT_OF_RANGE, j, "parents[%u] is %u; it must be below %u, or HF_NO_INDEX", j, given[j], count);
    out.push_back(static_cast<std::int32_t>(given[j]));  // HF_NO_INDEX becomes -1
  }
}

// A joint with an inverse bind matrix is named by a skin. Where none is, all may be.
const std::uint8_t* read_bound(const Vector<double>& inverse_binds, Vector<std::uint8_t>& out) {
  for (std::size_t k = 0; k < inverse_binds.size(); k += 16) {
    const double* const m = inverse_binds.data() + k;
    out.push_back(std::any_of(m, m + 16, [](double v) { return v != 0; }));
  }
  return std::find(out.begin(), out.end(), 1) == out.end() ? nullptr : out.data();
}

void read_skin(const hf_skin_desc& skin, std::uint32_t joint_count, KnownSkeleton& out) {
  require_list(skin.vertex_count, skin.positions, "vertex_count", "positions");
  check_flag(skin.at_rest, "at_rest");
  require_zero(skin.reserved);
  if (skin.influence_count < 1 || skin.influence_count > most_influences)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "influence_count is %u; it must be 1 to %u", skin.influence_count,
         most_influences);
  if (skin.triangle_count > 0) require(skin.triangles, "triangles");
  require(skin.joints, "joints");
  require(skin.weights, "weights");
  if (skin.vertex_count > HF_NO_INDEX / most_influences)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "vertex_count is %u; at most %u are taken", skin.vertex_count,
         HF_NO_INDEX / most_influences);
  const std::size_t width = skin.influence_count, entries = width * skin.vertex_count;
  for (std::size_t k = 0; k < entries; ++k) {
    const std::uint32_t vertex = static_cast<std::uint32_t>(k / width);
    const float w = skin.weights[k];
    if (!std::isfinite(w)) fail(HF_ERROR_NON_FINITE, vertex, "a weight of vertex %u is not finite", vertex);
    if (w < 0) fail(HF_ERROR_INVALID_ARGUMENT, vertex, "a weight of vertex %u is below 0", vertex);
    if (skin.joints[k] >= joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, vertex, "vertex %u names joint %u; there are %u joints", vertex, skin.joints[k],
           joint_count);
  }
  copy_array(skin.positions, 3 * std::size_t{skin.vertex_count}, out.positions);
  copy_array(skin.joints, entries, out.joints);
  copy_array(skin.weights, entries, out.weights);
  if (skin.triangle_count > 0) copy_array(skin.triangles, 3 * std::size_t{skin.triangle_count}, out.triangles);
  out.starts.reserve(skin.vertex_count + 1);
  for (std::uint32_t v = 0; v <= skin.vertex_count; ++v) out.starts.push_back(v * skin.influence_count);
  out.input.vertex_count = skin.vertex_count;
  out.input.positions = out.positions.data();
  out.input.influence_starts = out.starts.data();
  out.input.influence_joints = out.joints.data();
  out.input.influence_weights = out.weights.data();
  out.input.triangle_count = skin.triangle_count;
  out.input.triangles = out.triangles.data();
}

const double* read_axis(const float* given, Vec3& out) {
  if (!given) return nullptr;
  out = {given[0], given[1], given[2]};
  return &out.x;
}

}  // namespace

KnownSkeleton::KnownSkeleton(const hf_skeleton_desc& desc, const hf_skin_desc* skin, std::shared_ptr<Memory> owner)
    : memory(std::move(owner)),
      text(memory.get()),
      names(memory.get()),
      parents(memory.get()),
      roles(memory.get()),
      sides(memory.get()),
      bound(memory.get()),
      rest(memory.get()),
      inverse_binds(memory.get()),
      travels(memory.get()),
      positions(memory.get()),
      weights(memory.get()),
      triangles(memory.get()),
      joints(memory.get()),
      starts(memory.get()),
      character(*memory) {
  require_zero(desc.reserved);
  require_list(desc.joint_count, desc.parents, "joint_count", "parents");
  require(desc.rest, "rest");
  const std::uint32_t count = desc.joint_count;
  if (count > most_joints)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; at most %u are taken", count, most_joints);
  input.joint_count = count;
  read_parents(desc.parents, count, parents);
  input.parents = parents.data();
  copy_array(desc.rest, 10 * std::size_t{count}, rest);
  input.trs = rest.data();
  if (desc.names) {
    read_names(desc.names, count, *this);
    input.names = names.data();
  }
  if (desc.inverse_binds) {
    copy_array(desc.inverse_binds, 16 * std::size_t{count}, inverse_binds);
    input.inverse_binds = inverse_binds.data();
    input.bound = read_bound(inverse_binds, bound);
  }
  if (desc.roles) {
    copy_array(desc.roles, count, roles);
    input.roles = roles.data();
  }
  if (desc.sides) {
    copy_array(desc.sides, count, sides);
    input.sides = sides.data();
  }
  if (desc.travel_count > 0) {
    require(desc.travels, "travels");
    copy_array(desc.travels, 3 * std::size_t{desc.travel_count}, travels);
    input.travel_count = desc.travel_count;
    input.travels = travels.data();
  }
  input.up = read_axis(desc.up, up);
  input.forward = read_axis(desc.forward, forward);
  if (skin) {
    read_skin(*skin, count, *this);
    if (input.bound && !skin->at_rest) pose_skin_at_rest(input, positions, *memory);
  }
  character = know_character(input, *memory);
}

}  // namespace hf_inner::skeleton
