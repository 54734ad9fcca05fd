// Reads the options, pairs and holds of a transfer.
#pragma once
#include "mesh/vertex_lists.h"
#include "transfer/transfer.h"

namespace hf_inner::transfer {

// Writes the options of a desc; others stay. The constructor of Transfer checks them.
void read_transfer_options(const hf_transfer_desc& desc, TransferOptions& options);

// Returns a rest pose by inner vertex; empty where none is given. name: of the array, for errors.
Vector<Vec3> read_rest(const hf_array& given, const surface::Core& core, const char* name);

Dials read_dials(const hf_transfer_dials& desc);  // Transfer::set_dials checks them

// Pairs and the regions that they refer to.
struct PairsInput {
  PairsInput(mesh::Regions&& from, mesh::Regions&& to, Memory& memory)
      : source(std::move(from)), target(std::move(to)), pairs(&memory) {}
  mesh::Regions source, target;
  Vector<PairInput> pairs;
};
// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_RANGE or HF_ERROR_INVALID_ARGUMENT
// as hf_transfer_add_pairs says.
PairsInput read_pairs(const Transfer& transfer, const hf_pairs_desc& desc, Memory& memory);

// The arrays of a frame.
struct FrameRows {
  ConstRows posed;
  Rows positions, normals;
};
// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC or HF_ERROR_TOO_SMALL (stride).
FrameRows read_rows(const hf_transfer_frame& frame, std::size_t source_vertices, std::size_t target_vertices);

// Returns the holds of a frame, which it writes to `room`: HF_PAIR_LIMIT entries. Throws HF_ERROR_TOO_LARGE or
// HF_ERROR_NULL_POINTER.
Span<const PairHold> read_holds(const hf_transfer_frame& frame, PairHold* room);

}  // namespace hf_inner::transfer
