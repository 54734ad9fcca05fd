// A factor as bytes: saved by an authoring tool, loaded by a game in milliseconds instead of being made again.
//
// Layout, little-endian: a header of 88 bytes (magic, version, sizes, pattern hash, checksum of all that follows it),
// then order, first columns, row counts, rows, padding to 8, numbers. Loading checks length, checksum, and that the
// index lists describe a supernodal factor; bytes that do not are refused, whatever they hold. Cost: one pass over the
// bytes.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"
#include "factor/factor.h"

namespace hf {

std::uint64_t saved_factor_size(const Factor& factor);

// Writes exactly saved_factor_size bytes; fails with HF_ERROR_TOO_SMALL when `out` is smaller.
void save_factor(const Factor& factor, Span<std::uint8_t> out);

// `unknowns`: the size the caller expects. Throws HF_ERROR_INVALID_ARGUMENT for bytes that are no such factor,
// HF_ERROR_UNSUPPORTED for those of another version.
std::shared_ptr<const Factor> load_factor(Span<const std::uint8_t> bytes, std::int32_t unknowns, Memory& memory,
                                          JobRunner* jobs = nullptr);

}  // namespace hf
