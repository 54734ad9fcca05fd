// Implements hf/transfer.h: transfers.
#include "capi/create.h"
#include "capi/objects.h"
#include "capi/skin_out.h"
#include "capi/vertex_writer.h"
#include "deform/intake.h"
#include "deform/normals.h"
#include "hf/transfer.h"
#include "transfer/intake.h"

namespace hf_inner::capi {
namespace {

// Holds the working memory for normals of the target. It is made at the first frame that asks for normals.
struct NormalRoom {
  NormalRoom(const surface::Core& core, Memory& memory)
      : rest(core, memory),
        sums(memory, static_cast<std::size_t>(core.size())),
        normals(memory, static_cast<std::size_t>(core.size())) {}
  const deform::Rest rest;
  Buffer<deform::NormalSum> sums;
  Buffer<deform::Normal> normals;
};

struct TransferObject final : Object {
  static constexpr Kind kind_of = Kind::transfer;
  TransferObject(std::shared_ptr<const surface::Core> source, std::shared_ptr<const surface::Core> target,
                 const transfer::TransferOptions& options)
      : Object(kind_of, target->memory),
        source_memory(source->memory),
        transfer(std::move(source), std::move(target), options),
        source_posed(*memory, static_cast<std::size_t>(transfer.source().size())),
        target_posed(*memory, static_cast<std::size_t>(transfer.target().size())) {}
  std::shared_ptr<Memory> source_memory;  // outlives the transfer
  transfer::Transfer transfer;
  OwnedMutex preparing;  // readers solve the fields of new pairs one after the other
  Buffer<Vec3> source_posed, target_posed;
  std::shared_ptr<NormalRoom> normals;
};

// Writes figures that fill() takes from a transfer. One thread at a time does so, as the first solves fields.
template <class Figures, class Fill>
hf_result write_figures(const char* function, hf_transfer handle, Figures* out, const char* name, const Fill& fill) {
  return guarded(function, [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    check_struct(out, name);
    const Reading reading(*object);
    const std::lock_guard<OwnedMutex> lock(object->preparing);
    Figures figures{};
    fill(object->transfer, figures);
    write_struct(out, figures);
  });
}

}  // namespace

hf_result create_transfer(const char* function, hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                          transfer::TransferOptions options, hf_transfer* out_transfer) {
  return create(function, out_transfer, "out_transfer", [&] {
    get<SurfaceObject>(source, "source", 0);
    get<SurfaceObject>(target, "target", 1);
    const hf_transfer_desc given = read_optional(desc, "desc");
    transfer::read_transfer_options(given, options);
    const auto from = unedited_core(source, "source", 0), to = unedited_core(target, "target", 1);
    const Vector<Vec3> source_rest = transfer::read_rest(given.source_rest, *from, "source_rest"),
                       target_rest = transfer::read_rest(given.target_rest, *to, "target_rest");
    options.source_rest = {source_rest.data(), source_rest.size()};
    options.target_rest = {target_rest.data(), target_rest.size()};
    return make_owner_in<TransferObject>(to->memory, from, to, options);
  });
}

}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                             hf_transfer* out_transfer) {
  return create_transfer("hf_transfer_create", source, target, desc, {}, out_transfer);
}

void hf_transfer_destroy(hf_transfer transfer) { destroy<TransferObject>(transfer); }

hf_result hf_transfer_add_pairs(hf_transfer handle, const hf_pairs_desc* given, uint32_t* out_pairs) {
  return guarded("hf_transfer_add_pairs", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    const hf_pairs_desc desc = read_struct(given, "pairs");
    const Changing changing(*object);
    const transfer::PairsInput input = transfer::read_pairs(object->transfer, desc, *object->memory);
    with_progress(desc.progress, [&] { object->transfer.add_pairs(input.pairs, out_pairs, desc.progress != nullptr); });
  });
}

hf_result hf_transfer_remove_pairs(hf_transfer handle, uint32_t pair_count, const uint32_t* pairs) {
  return guarded("hf_transfer_remove_pairs", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    require_list(pair_count, pairs, "pair_count", "pairs");
    const Changing changing(*object);
    object->transfer.remove_pairs({pairs, pair_count});
  });
}

hf_result hf_transfer_get_pair(hf_transfer handle, uint32_t pair, hf_pair_info* out_info) {
  return write_figures("hf_transfer_get_pair", handle, out_info, "out_info",
                       [&](transfer::Transfer& transfer, hf_pair_info& info) {
                         const transfer::PairInfo found = transfer.pair_info(pair);
                         info.flags = found.flags;
                         info.source_leak = found.source_leak;
                         info.target_leak = found.target_leak;
                         info.alignment_angle = found.alignment_angle;
                         info.confidence = found.confidence;
                         info.alignment_share = found.alignment_share;
                         info.aligned = found.alignment_share > 0 ? 1 : 0;
                         info.crossed = found.crossed ? 1 : 0;
                       });
}

hf_result hf_transfer_get_info(hf_transfer handle, hf_transfer_info* out_info) {
  return write_figures("hf_transfer_get_info", handle, out_info, "out_info",
                       [](transfer::Transfer& transfer, hf_transfer_info& info) {
                         info.cluster_count = static_cast<std::uint32_t>(transfer.cluster_count());
                         info.pair_count = transfer.pair_count();
                         for (const std::uint32_t pair : transfer.pairs()) {
                           const transfer::PairInfo found = transfer.pair_info(pair);
                           info.aligned_count += found.alignment_share > 0 ? 1u : 0u;
                           info.crossed_count += found.crossed ? 1u : 0u;
                         }
                         info.scale = transfer.scale();
                         info.scale_found = transfer.scale_found() ? 1 : 0;
                       });
}

hf_result hf_transfer_get_statistics(hf_transfer handle, hf_transfer_statistics* out_statistics) {
  return write_figures("hf_transfer_get_statistics", handle, out_statistics, "out_statistics",
                       [](transfer::Transfer& transfer, hf_transfer_statistics& statistics) {
                         // The counters include the surface's own factor as the first factorisation.
                         statistics.source_factorisation_count = transfer.source_counters().factorisations - 1;
                         statistics.target_factorisation_count = transfer.target_counters().factorisations - 1;
                       });
}

hf_result hf_transfer_set_rigid_pieces(hf_transfer handle, uint32_t vertex_count, const uint32_t* vertices) {
  return guarded("hf_transfer_set_rigid_pieces", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    const Changing changing(*object);
    object->transfer.set_rigid_pieces(
        deform::read_rigid_pieces(object->transfer.target(), vertex_count, vertices, *object->memory));
  });
}

hf_result hf_transfer_set_dials(hf_transfer handle, const hf_transfer_dials* dials) {
  return guarded("hf_transfer_set_dials", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    const hf_transfer_dials given = read_optional(dials, "dials");
    const Changing changing(*object);
    object->transfer.set_dials(transfer::read_dials(given));
  });
}

hf_result hf_transfer_get_dials(hf_transfer handle, hf_transfer_dials* out_dials) {
  return guarded("hf_transfer_get_dials", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    check_struct(out_dials, "out_dials");
    const Reading reading(*object);
    const transfer::Dials& set = object->transfer.dials();
    hf_transfer_dials dials{};
    dials.stride = set.stride;
    dials.hip_height_share = set.hip_height_share;
    dials.neck_follow = set.neck_follow;
    dials.tail_follow = set.tail_follow;
    dials.arm_space = set.arm_space;
    dials.long_follow = set.long_follow;
    write_struct(out_dials, dials);
  });
}

hf_result hf_transfer_apply(hf_transfer handle, const hf_transfer_frame* given) {
  return guarded("hf_transfer_apply", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    const hf_transfer_frame frame = read_struct(given, "frame");
    const transfer::FrameRows rows = transfer::read_rows(frame, object->transfer.source().mesh.report.vertex_count,
                                                         object->transfer.target().mesh.report.vertex_count);
    transfer::PairHold holds[HF_PAIR_LIMIT];
    const Span<const transfer::PairHold> held = transfer::read_holds(frame, holds);
    const Changing changing(*object);
    if (rows.positions && !rows.positions.is_double()) require_float_positions(object->transfer.target().mesh);
    const mesh::Mesh& source = object->transfer.source().mesh;
    for (std::size_t v = 0; v < source.given_of_inner.size(); ++v) {
      const std::size_t row = static_cast<std::size_t>(source.given_of_inner[v]);
      object->source_posed[v] = {rows.posed.get(row, 0), rows.posed.get(row, 1), rows.posed.get(row, 2)};
    }
    const surface::Core& target = object->transfer.target();
    std::shared_ptr<NormalRoom> room = object->normals;
    if (rows.normals && !room) room = make_shared_in<NormalRoom>(*object->memory, target, *object->memory);
    object->transfer.apply(object->source_posed.data(), object->target_posed.data(), held);
    object->normals = room;
    if (rows.positions)
      write_vertices(target, 3, rows.positions, put_rest,
                     [&](std::size_t v, double* values) { put(object->target_posed[v], values); });
    if (rows.normals) {
      deform::vertex_normals(target.mesh, room->rest, object->target_posed.data(), room->sums.data(),
                             room->normals.data(), *target.jobs);
      write_vertices(target, 3, rows.normals, put_up,
                     [&](std::size_t v, double* values) { put(deform::to_vec3(room->normals[v]), values); });
    }
  });
}

hf_result hf_transfer_get_sinking(hf_transfer handle, uint8_t* out_sinking) {
  return guarded("hf_transfer_get_sinking", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    require(out_sinking, "out_sinking");
    const Reading reading(*object);
    const std::lock_guard<OwnedMutex> lock(object->preparing);
    const std::uint8_t* sinking = object->transfer.sinking();
    const mesh::Mesh& mesh = object->transfer.target().mesh;
    for (std::size_t v = 0; v < mesh.inner_of_given.size(); ++v) {
      const std::int32_t inner = mesh.inner_of_given[v];
      out_sinking[v] = sinking && inner != mesh::Mesh::none ? sinking[inner] : 0;
    }
  });
}

hf_result hf_transfer_get_skin(hf_transfer handle, hf_skin_info* inout_skin) {
  return guarded("hf_transfer_get_skin", [&] {
    const auto object = get<TransferObject>(handle, "transfer");
    SkinOut out(inout_skin);
    const Reading reading(*object);
    const std::lock_guard<OwnedMutex> lock(object->preparing);
    object->transfer.skin_motion(nullptr, nullptr, nullptr);  // refuses modes without a skin before anything is written
    Memory* memory = object->memory.get();
    const mesh::Mesh& mesh = object->transfer.target().mesh;
    const std::size_t joints = object->transfer.joint_count();
    out.write_counts(joints, mesh.report.vertex_count);
    Vector<Vec3> pivots(joints, memory), places(joints, memory);
    Vector<deform::Quaternion> rotations(joints, memory);
    object->transfer.skin_motion(pivots.data(), rotations.data(), places.data());
    for (std::size_t j = 0; j < joints; ++j)  // a transfer's joints never stretch
      out.write_joint(j, pivots[j], rotations[j], places[j], deform::Quaternion(), {1, 1, 1});
    out.write_vertices(mesh, [&](std::int32_t inner, std::uint32_t* joint, float* weight) {
      weight[0] = 1;  // isolated vertices follow the first joint
      if (inner != mesh::Mesh::none) object->transfer.skin_weights(inner, out.influence_count(), joint, weight);
    });
  });
}

}  // extern "C"
