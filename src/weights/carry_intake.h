// Reads what a caller carries and mirrors: weights by vertex, options, names and partners of bones.
#pragma once
#include "hf/weights.h"
#include "weights/mirror.h"

namespace hf_inner::weights {

// The names of bones, empty for null. Throws HF_ERROR_INVALID_ARGUMENT if there is not one line for each bone.
Span<const char> read_bone_names(const char* names, std::size_t bones, Memory& memory);

// source: the mesh with the weights. They throw as hf_weights_transfer says.
GivenWeights read_carried(const hf_weights_transfer_desc& desc, const mesh::Mesh& source);
MatchOptions read_carry(const hf_weights_transfer_desc& desc, const mesh::Mesh& source);

// They throw as hf_weights_mirror says.
GivenWeights read_mirrored(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh);
MirrorOptions read_mirror(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh);
MirrorBones read_mirror_bones(const hf_weights_mirror_desc& desc, const mesh::Mesh& mesh, Memory& memory);

}  // namespace hf_inner::weights
