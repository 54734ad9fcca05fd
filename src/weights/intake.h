// Reads bones, pins and locks of the caller: checks them and turns them into the data of this room.
#pragma once
#include "hf/weights.h"
#include "weights/weights.h"

namespace hf_inner::weights {

// Checks the count of bones and their heads. Throws HF_ERROR_EMPTY, HF_ERROR_NULL_POINTER or HF_ERROR_TOO_LARGE.
void check_bones(std::uint32_t joint_count, const double* heads);
// Returns point i of a list. name: the list in the text of errors. Throws HF_ERROR_NON_FINITE.
Vec3 read_bone_point(const double* points, std::uint32_t i, const char* name);

// Appends the bones to `bones`. sources of the desc are not read. Throws as hf_weights_create says.
void read_bones(const hf_joints_desc& desc, Bones& bones, Memory& memory);
// The same where there were no bones before: sources must be NULL.
void read_first_bones(const hf_joints_desc& desc, Bones& bones, Memory& memory);

// Returns by new bone the number it had before, -1 for a new one; empty: the same numbers. before: their count. Throws
// as hf_weights_set_joints says.
Vector<Index> read_sources(const hf_joints_desc& desc, std::uint32_t before, Memory& memory);

// Appends the pins to `pins`. bones: their count. Throws as hf_weights_set_pins says.
void read_pins(const hf_pins_desc& desc, const mesh::Mesh& mesh, std::uint32_t bones, Pins& pins, Memory& memory);

// Locked bones and their weights [inner vertex][bones]; no weights: the present ones stay.
struct LockInput {
  explicit LockInput(Memory* memory) : bones(memory), values(memory) {}
  Vector<Index> bones;
  Vector<float> values;
};
// joint_count: of the skeleton. values: [vertex of the caller][count], or null. Throws as hf_weights_set_locks says.
LockInput read_locks(const mesh::Mesh& mesh, std::uint32_t joint_count, std::uint32_t count, const std::uint32_t* bones,
                     const float* values, Memory& memory);

// The flags HF_JOINT_* of a bone with these faults. A bone that no vertex needs and that is a point, a copy or outside
// is proposed as a helper.
std::uint32_t bone_flags(std::uint32_t faults) noexcept;
// How many bones have each flag. faults: by bone.
struct BoneFlagCounts {
  std::uint32_t no_length = 0, coincident = 0, informs_none = 0, outside = 0, helper = 0;
};
BoneFlagCounts count_bone_flags(Span<const std::uint32_t> faults) noexcept;

}  // namespace hf_inner::weights
