// Saves a factor as bytes, so that a game loads it in milliseconds instead of computing it.
//
// The layout is little-endian. Every section starts at a multiple of 64 bytes, with zeros between sections:
// - a header of 128 bytes, with magic, version, byte order, sizes, ordering, matrix hash and checksum of the rest;
// - the order of the unknowns, then first columns, row counts and rows of the supernodes;
// - the numbers, supernodes from last to first: packed triangles with inverted diagonals, and row blocks;
// - 64 numbers of value 0, which sweeps may read behind the end.
//
// Loading checks the length and the checksum. It also checks that the lists describe a supernodal factor, that every
// number is finite, and that every diagonal is positive. Bytes that fail a check are refused. The checksum finds
// damage, not forgery: forged bytes can give a wrong factor, but never one that reads or writes outside its arrays.
// Cost: one parallel pass over the bytes, and a serial pass over the lists.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"
#include "factor/factor.h"

namespace hf_inner::factor {

// Alignment of bytes that are read in place: a cache line.
constexpr std::size_t saved_factor_alignment = 64;

struct LoadOptions {
  std::int32_t unknowns = 0;      // size of the matrix the factor must belong to
  std::uint64_t matrix_hash = 0;  // hash_matrix of that matrix
  bool borrow = false;            // read the numbers in place; the bytes must outlive every factor made from them
};

// Returns a hash of the pattern and the numbers of a matrix, and of the values added to its diagonal. It changes
// with the mesh, its vertex positions and the operator.
std::uint64_t hash_matrix(const SymmetricMatrix& matrix, Span<const std::int32_t> extra_row,
                          Span<const double> extra_value, Memory& memory, JobRunner& jobs);

std::uint64_t saved_factor_size(const Factor& factor);

// Writes exactly saved_factor_size bytes. Throws HF_ERROR_TOO_SMALL when `out` is smaller. The same factor gives the
// same bytes. matrix_hash: hash of the factored matrix.
void save_factor(const Factor& factor, std::uint64_t matrix_hash, Span<std::uint8_t> out, Memory& memory,
                 JobRunner& jobs);

// Reads only the header, and returns the ordering of the factor. Throws HF_ERROR_INVALID_ARGUMENT for bytes that are no
// saved factor or have the wrong length, and HF_ERROR_UNSUPPORTED for another version or byte order.
Ordering check_saved_factor(Span<const std::uint8_t> bytes);

// Returns the matrix hash that was saved with the bytes. Throws the errors of check_saved_factor.
std::uint64_t saved_matrix_hash(Span<const std::uint8_t> bytes);

// Loads a factor. Throws the errors of check_saved_factor. Throws HF_ERROR_INVALID_ARGUMENT for a factor of another
// matrix, for damaged bytes, and for a borrowed block that is not aligned. A failed call keeps no memory.
std::shared_ptr<const Factor> load_factor(Span<const std::uint8_t> bytes, const LoadOptions& options, Memory& memory,
                                          JobRunner& jobs);

}  // namespace hf_inner::factor
