// A factor as bytes: saved by an authoring tool, loaded by a game in milliseconds instead of being made again.
//
// Layout, little-endian, every section on a multiple of 64 bytes, zeros between them:
// - a header of 128 bytes. It holds magic, version, byte order, sizes, ordering, matrix hash and checksum of the rest.
// - the order of the unknowns. Then first columns, row counts and rows of the supernodes.
// - the numbers, supernodes last to first: packed triangles with inverted diagonals, and row blocks.
// - 64 zeros that sweeps may read over.
//
// Loading checks length and checksum, that the lists describe a supernodal factor, that every number is finite and
// every diagonal positive; bytes that fail are refused, whatever they hold. The checksum finds damage, not forgery:
// forged bytes can give a wrong factor, but never one that reads or writes outside its arrays. Cost: one pass over the
// bytes, in parallel, and the lists.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"
#include "factor/factor.h"

namespace hf_inner {

// Alignment of bytes that are read in place: a cache line.
constexpr std::size_t saved_factor_alignment = 64;

struct LoadOptions {
  std::int32_t unknowns = 0;      // size of the matrix the factor must belong to
  std::uint64_t matrix_hash = 0;  // and its hash_matrix
  bool borrow = false;            // read the numbers in place: the bytes outlive every factor made from them
};

// Hash of the pattern and the numbers of a matrix, and of the values added to its diagonal. Another mesh, another
// operator or other positions give another hash.
std::uint64_t hash_matrix(const SymmetricMatrix& matrix, Span<const std::int32_t> extra_row,
                          Span<const double> extra_value, Memory& memory, JobRunner& jobs);

std::uint64_t saved_factor_size(const Factor& factor);

// Writes exactly saved_factor_size bytes; fails with HF_ERROR_TOO_SMALL when `out` is smaller. The same factor gives
// the same bytes. matrix_hash: of the matrix the factor was made of.
void save_factor(const Factor& factor, std::uint64_t matrix_hash, Span<std::uint8_t> out, Memory& memory,
                 JobRunner& jobs);

// Reads the header alone: throws HF_ERROR_INVALID_ARGUMENT for bytes that are no saved factor or have the wrong length,
// HF_ERROR_UNSUPPORTED for those of another version or byte order. Returns the ordering the factor was made with.
Ordering check_saved_factor(Span<const std::uint8_t> bytes);

// Throws as check_saved_factor. The hash_matrix that the bytes were saved with.
std::uint64_t saved_matrix_hash(Span<const std::uint8_t> bytes);

// Throws as check_saved_factor, and HF_ERROR_INVALID_ARGUMENT for a factor of another matrix, for damaged bytes, and
// for a borrowed block that is not aligned. On failure nothing is kept.
std::shared_ptr<const Factor> load_factor(Span<const std::uint8_t> bytes, const LoadOptions& options, Memory& memory,
                                          JobRunner& jobs);

}  // namespace hf_inner
