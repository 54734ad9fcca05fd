// Reads handles, transforms, requests of frames and options of proposals.
#pragma once
#include "deform/pose_stack.h"
#include "deform/proposals.h"
#include "hf/pose.h"

namespace hf_inner::deform {

// Regions of handles to add. Region r is vertices[start[r] .. start[r + 1]).
struct HandleInput {
  explicit HandleInput(Memory* memory) : start(memory), vertices(memory) {}
  Vector<std::uint32_t> start;
  Vector<std::int32_t> vertices;  // inner; Mesh::none for an isolated one
  bool by_places = false;         // the regions lie around places
  std::uint32_t layer = 0;
  HandleKind kind;
};
// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER,
// HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE as hf_pose_add_handles says.
HandleInput read_handles(const surface::Core& core, const hf_handles_desc& desc, Memory& memory);
// Adds the handles. Throws as PoseStack::add_handles. The index of HF_ERROR_CONFLICT is the region where regions lie
// around points.
void add_handles(PoseStack& pose, const HandleInput& input, Span<std::uint32_t> out_numbers);

// Checks a list of handles. Throws HF_ERROR_EMPTY, HF_ERROR_NULL_POINTER or HF_ERROR_TOO_LARGE.
void check_handles(std::uint32_t count, const std::uint32_t* handles);
// Returns the inner vertices of a list, which may be empty. Throws HF_ERROR_NULL_POINTER, HF_ERROR_TOO_LARGE,
// HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT.
Vector<std::int32_t> read_rigid_pieces(const surface::Core& core, std::uint32_t count, const std::uint32_t* vertices,
                                       Memory& memory);
// Throws HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT.
void check_following(double following);
// Returns the steps. Throws HF_ERROR_INVALID_ARGUMENT.
std::uint32_t read_refine(std::int32_t refine);
HandleTransform read_transform(const hf_transform& given) noexcept;

// The vertices of the caller's mesh that hf_pose_deform writes.
struct VertexRange {
  std::uint32_t first, count;
  bool whole;
};
// Throws HF_ERROR_OUT_OF_RANGE.
VertexRange read_range(const hf_deform_desc& desc, std::uint32_t vertex_count);

// Returns what a frame asks for, without its arrays. Throws HF_ERROR_INVALID_ARGUMENT for flags.
DeformRequest read_request(const hf_deform_desc& desc);

// Throws HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE, HF_ERROR_NULL_POINTER or
// HF_ERROR_OUT_OF_RANGE as hf_surface_propose_handles says. skeleton: from the desc, or null. It outlives the options.
ProposalOptions read_proposal_options(const hf_handle_proposals_desc& desc, const mesh::Mesh& mesh,
                                      const skeleton::KnownSkeleton* skeleton);

}  // namespace hf_inner::deform
