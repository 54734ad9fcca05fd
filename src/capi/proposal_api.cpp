// Implements hf_surface_propose_handles of hf/pose.h.
#include "capi/skeleton_object.h"
#include "capi/vertex_writer.h"
#include "deform/intake.h"
#include "hf/pose.h"

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" hf_result hf_surface_propose_handles(hf_surface handle, const hf_handle_proposals_desc* given,
                                                uint32_t capacity, hf_handle_proposal* out_proposals,
                                                uint32_t* out_count) {
  return guarded("hf_surface_propose_handles", [&] {
    const std::shared_ptr<const surface::Core> shared = harmonic_core(handle, "proposed handles");
    const hf_handle_proposals_desc desc = read_optional(given, "desc");
    const auto object = desc.skeleton ? get<SkeletonObject>(desc.skeleton, "desc->skeleton") : nullptr;
    const surface::Core& core = *shared;
    const deform::ProposalOptions options =
        deform::read_proposal_options(desc, core.mesh, object ? object->skeleton.get() : nullptr);
    require_either(out_proposals, out_count, "out_proposals and out_count");
    const deform::Proposals proposals =
        with_progress(desc.progress, [&] { return deform::propose_handles(core, options); });
    const Vector<deform::HandleProposal>& found = proposals.list;
    const std::uint32_t count = static_cast<std::uint32_t>(found.size());
    write_count(out_count, count);
    check_capacity(out_proposals, capacity, count, "capacity");
    for (std::uint32_t i = 0; out_proposals && i < count; ++i) {
      const deform::HandleProposal& from = found[i];
      hf_handle_proposal out{};
      out.vertex = mesh::given_vertex(core.mesh, from.vertex);
      out.component = static_cast<std::uint32_t>(core.mesh.component[static_cast<std::size_t>(from.vertex)]);
      out.reason = static_cast<std::int32_t>(from.reason);
      out.pinned = from.pinned ? 1 : 0;
      out.joint = from.joint;
      out.role = static_cast<std::int32_t>(from.role);
      out.side = static_cast<std::int32_t>(from.side);
      out.radius = from.radius;
      out.length = from.length;
      out.following = from.following;
      put(from.position, out.position);
      out_proposals[i] = out;
    }
    for (std::size_t v = 0; desc.out_regions && v < core.mesh.inner_of_given.size(); ++v) {
      const std::int32_t inner = core.mesh.inner_of_given[v];
      const std::int32_t own = inner == mesh::Mesh::none ? -1 : proposals.region[static_cast<std::size_t>(inner)];
      desc.out_regions[v] = own < 0 ? HF_NO_INDEX : static_cast<std::uint32_t>(own);
    }
  });
}
