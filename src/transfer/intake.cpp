#include "transfer/intake.h"

#include <algorithm>

#include "base/arguments.h"

namespace hf_inner::transfer {

void read_transfer_options(const hf_transfer_desc& desc, TransferOptions& options) {
  options.mode = desc.mode;
  options.cluster_count = desc.cluster_count;
  options.kernel_width = desc.kernel_width;
  options.scale = desc.scale;
  options.alignment_angle = desc.alignment_angle;
  check_choice(desc.ground, 2, "ground");
  options.keep_ground = desc.ground == HF_GROUND_KEEP;
  std::copy_n(desc.source_axes, 9, options.source_axes);
  std::copy_n(desc.target_axes, 9, options.target_axes);
}

Dials read_dials(const hf_transfer_dials& desc) {
  require_zero(desc.reserved);
  Dials out;
  out.stride = desc.stride == 0 ? 1.0 : desc.stride;
  out.hip_height_share = desc.hip_height_share;
  out.neck_follow = desc.neck_follow;
  out.tail_follow = desc.tail_follow;
  out.arm_space = desc.arm_space;
  out.long_follow = desc.long_follow;
  return out;
}

Vector<Vec3> read_rest(const hf_array& given, const surface::Core& core, const char* name) {
  Vector<Vec3> out(core.memory.get());
  const ConstRows rows = read_reals(given, 3, core.mesh.report.vertex_count, "vertices", name);
  if (!rows) return out;
  for (const std::int32_t v : core.mesh.given_of_inner) {
    const std::size_t row = static_cast<std::size_t>(v);
    out.push_back({rows.get(row, 0), rows.get(row, 1), rows.get(row, 2)});
  }
  return out;
}

PairsInput read_pairs(const Transfer& transfer, const hf_pairs_desc& desc, Memory& memory) {
  deform::check_region_count(0, desc.pair_count, "pair");  // before lists of that length are read
  require(desc.source_counts, "source_counts");
  require(desc.source_vertices, "source_vertices");
  require(desc.target_counts, "target_counts");
  require(desc.target_vertices, "target_vertices");
  PairsInput input(mesh::Regions(transfer.source().mesh, desc.pair_count, desc.source_counts, desc.source_vertices,
                                 "source_vertices", &memory),
                   mesh::Regions(transfer.target().mesh, desc.pair_count, desc.target_counts, desc.target_vertices,
                                 "target_vertices", &memory),
                   memory);
  for (std::uint32_t p = 0; p < desc.pair_count; ++p)
    input.pairs.push_back({input.source[p], input.target[p], desc.flags ? desc.flags[p] : 0});
  return input;
}

FrameRows read_rows(const hf_transfer_frame& frame, std::size_t source_vertices, std::size_t target_vertices) {
  return {need_reals(&frame.source_positions, 3, source_vertices, "vertices of the source", "source_positions"),
          write_reals(frame.target_positions, 3, target_vertices, "vertices of the target", "target_positions"),
          write_reals(frame.target_normals, 3, target_vertices, "vertices of the target", "target_normals")};
}

Span<const PairHold> read_holds(const hf_transfer_frame& frame, PairHold* room) {
  if (frame.hold_count > HF_PAIR_LIMIT)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u holds in a frame; a transfer has at most %d pairs", frame.hold_count,
         HF_PAIR_LIMIT);
  if (frame.hold_count > 0) {
    require(frame.hold_pairs, "hold_pairs");
    require(frame.hold_positions, "hold_positions");
  }
  for (std::uint32_t i = 0; i < frame.hold_count; ++i) {
    const double* place = frame.hold_positions + 3 * std::size_t{i};
    room[i] = {frame.hold_pairs[i], {place[0], place[1], place[2]}};
  }
  return {room, frame.hold_count};
}

}  // namespace hf_inner::transfer
