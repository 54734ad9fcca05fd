// Implements hf_surface_propose_handles of hf/pose.h.
#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "deform/intake.h"
#include "hf/pose.h"

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" hf_result hf_surface_propose_handles(hf_surface handle, const hf_handle_proposals_desc* given,
                                                uint32_t capacity, hf_handle_proposal* out_proposals,
                                                uint32_t* out_count) {
  return guarded("hf_surface_propose_handles", [&] {
    const std::shared_ptr<const Core> shared = harmonic_core(handle, "proposed handles");
    const hf_handle_proposals_desc desc = read_optional(given, "desc");
    const ProposalOptions options = read_proposal_options(desc);
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
      out.reason = static_cast<std::int32_t>(from.reason);
      out.pinned = from.pinned ? 1 : 0;
      out.joint = from.joint;
      out.radius = from.radius;
      out.length = from.length;
      put(from.position, out.position);
      out_proposals[i] = out;
    }
  });
}
