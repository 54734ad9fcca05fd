// Implements hf/peers.h. Compiled with the room peers, in builds with HF_WITH_PEERS only.
#include "capi/create.h"
#include "capi/objects.h"
#include "field/intake.h"
#include "hf/peers.h"
#include "peers/intake.h"
#include "peers/paper_pose.h"
#include "peers/paper_transfer.h"
#include "peers/refactor.h"
#include "peers/updown.h"

namespace hf_inner::capi {
namespace {

// A solver of the engine that make(core) returns.
template <class Make>
std::shared_ptr<SolverObject> make_solver(hf_surface handle, const hf_solver_desc& desc, Make&& make) {
  const auto surface = get<SurfaceObject>(handle, "surface");
  const field::SolverOptions options = field::read_solver_options(desc);
  return with_progress(desc.progress, [&] {
    const std::shared_ptr<const surface::Core> core = surface->surface.core(options.field_kind);
    return make_owner_in<SolverObject>(surface->memory, core, options, make(core));
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_peer_updown_create(hf_surface surface, const hf_solver_desc* desc, double penalty, hf_solver* out_solver) {
  return create("hf_peer_updown_create", out_solver, "out_solver", [&] {
    get<SurfaceObject>(surface, "surface");
    const hf_solver_desc given = read_optional(desc, "desc");
    const double weight = peers::read_penalty(penalty);
    peers::require_updown();
    return make_solver(surface, given, [&](std::shared_ptr<const surface::Core> core) {
      return peers::make_updown_solver(std::move(core), weight);
    });
  });
}

hf_result hf_peer_refactor_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver) {
  return create("hf_peer_refactor_create", out_solver, "out_solver", [&] {
    get<SurfaceObject>(surface, "surface");
    return make_solver(surface, read_optional(desc, "desc"), [&](const std::shared_ptr<const surface::Core>& core) {
      return make_owner_in<peers::RefactorSolver>(core->memory, core);
    });
  });
}

hf_result hf_peer_pose_create(hf_surface surface, const hf_pose_desc* desc, uint32_t rim_site_count,
                              hf_pose* out_pose) {
  deform::PoseOptions options;
  options.rim_site_count = rim_site_count;
  options.scheme = peers::paper_scheme();
  return create_pose("hf_peer_pose_create", surface, desc, options, out_pose);
}

hf_result hf_peer_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                                  hf_transfer* out_transfer) {
  transfer::TransferOptions options;
  options.scheme = peers::paper_clusters();
  return create_transfer("hf_peer_transfer_create", source, target, desc, options, out_transfer);
}

}  // extern "C"
