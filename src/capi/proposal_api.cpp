// Implements hf_propose_handles of hf/pose.h.
#include <cmath>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/vertex_lists.h"
#include "capi/vertex_writer.h"
#include "deform/proposals.h"
#include "hf/pose.h"

namespace hf_inner::capi {
namespace {

static_assert(static_cast<int>(HandleReason::foot) == HF_HANDLE_REASON_FOOT &&
                  static_cast<int>(HandleReason::tip) == HF_HANDLE_REASON_TIP &&
                  static_cast<int>(HandleReason::end) == HF_HANDLE_REASON_END &&
                  static_cast<int>(HandleReason::joint) == HF_HANDLE_REASON_JOINT &&
                  static_cast<int>(HandleReason::middle) == HF_HANDLE_REASON_MIDDLE,
              "hf/pose.h states other reasons");

Vec3 read_up(const double* up) {
  const Vec3 given{up[0], up[1], up[2]};
  if (!std::isfinite(up[0]) || !std::isfinite(up[1]) || !std::isfinite(up[2]))
    fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "up is not finite");
  // scaled first, so that the square of a large or small number does not leave the range
  const double largest = std::max({std::fabs(given.x), std::fabs(given.y), std::fabs(given.z)});
  if (!(largest > 0)) return {0, 1, 0};
  const Vec3 scaled{given.x / largest, given.y / largest, given.z / largest};
  return (1 / norm(scaled)) * scaled;
}

void check_skeleton(const hf_propose_desc& desc) {
  if (desc.joint_count == 0) return;
  constexpr std::uint32_t most = 65536;  // joints: bounds what a wrong count reads; skins of scene files have 16 bits
  if (desc.joint_count > most)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; it must be at most %u", desc.joint_count, most);
  require(desc.joints, "joints"), require(desc.parents, "parents");
  for (std::uint32_t j = 0; j < desc.joint_count; ++j) {
    const double* p = desc.joints + 3 * std::size_t{j};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      fail(HF_ERROR_NON_FINITE, j, "joint %u is not finite", j);
    if (desc.parents[j] != HF_NO_INDEX && desc.parents[j] >= desc.joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, j, "the parent of joint %u is %u; there are %u joints", j, desc.parents[j],
           desc.joint_count);
  }
}

ProposalOptions read_options(const hf_propose_desc& desc) {
  ProposalOptions options;
  options.up = read_up(desc.up);
  if (desc.least_length != 0 && !(desc.least_length > 0 && desc.least_length <= 10))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "least_length is %g; it is a share of the box diagonal above 0 and up to 10, or 0 for 0.05",
         static_cast<double>(desc.least_length));
  options.least_length = desc.least_length > 0 ? static_cast<double>(desc.least_length) : 0.05;
  options.limit = count_of(desc.limit, 32, 1, HF_HANDLE_LIMIT, "limit");
  check_skeleton(desc);
  if (desc.joint_count == 0) return options;
  options.joints = {desc.joints, 3 * std::size_t{desc.joint_count}};
  options.parents = {desc.parents, desc.joint_count};
  return options;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" hf_result hf_propose_handles(hf_surface handle, const hf_propose_desc* given, uint32_t capacity,
                                        hf_handle_proposal* out_proposals, uint32_t* out_count) {
  return guarded("hf_propose_handles", [&] {
    const std::shared_ptr<const Core> shared = harmonic_core(handle, "proposed handles");
    const hf_propose_desc desc = read_optional(given, "desc");
    const ProposalOptions options = read_options(desc);
    require_either(out_proposals, out_count, "out_proposals and out_count");
    const Core& core = *shared;
    const Vector<HandleProposal> found = with_progress(desc.progress, [&] { return propose_handles(core, options); });
    const std::uint32_t count = static_cast<std::uint32_t>(found.size());
    write_count(out_count, count);
    check_capacity(out_proposals, capacity, count, "capacity");
    for (std::uint32_t i = 0; out_proposals && i < count; ++i) {
      const HandleProposal& from = found[i];
      hf_handle_proposal out{};
      out.vertex = given_vertex(core.mesh, from.vertex);
      out.component = static_cast<std::uint32_t>(core.mesh.component[static_cast<std::size_t>(from.vertex)]);
      out.reason = static_cast<std::int32_t>(from.reason), out.pinned = from.pinned ? 1 : 0;
      out.joint = from.joint, out.radius = from.radius, out.length = from.length;
      put(from.position, out.position);
      out_proposals[i] = out;
    }
  });
}
