// Saved factors and the single-precision copy.
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "factor/bytes_hash.h"
#include "factor/factor_bytes.h"
#include "factor/preview.h"
#include "factor/supernodal_factor.h"
#include "unit/factor/matrices.h"

namespace {

class FactorBytes : public testing::Test {
 protected:
  static constexpr std::uint64_t matrix_hash = 0x1234;
  static constexpr std::size_t header = 128;

  std::shared_ptr<const hf_inner::factor::Factor> make(const hf_inner::SymmetricMatrix& a, hf_inner::JobRunner& jobs) {
    return hf_inner::factor::Factor::make(a, {}, hf_inner::factor::FactorOptions{}, memory, jobs);
  }
  std::shared_ptr<const hf_inner::factor::Factor> make(const hf_inner::SymmetricMatrix& a) { return make(a, one); }
  std::vector<std::uint8_t> save(const hf_inner::factor::Factor& factor) {
    std::vector<std::uint8_t> bytes(hf_inner::factor::saved_factor_size(factor), 0xAB);
    hf_inner::factor::save_factor(factor, matrix_hash, {bytes.data(), bytes.size()}, memory, two);
    return bytes;
  }
  std::shared_ptr<const hf_inner::factor::Factor> load(hf_inner::Span<const std::uint8_t> bytes, std::int32_t n,
                                                       bool borrow = false) {
    hf_inner::factor::LoadOptions options;
    options.unknowns = n;
    options.matrix_hash = matrix_hash;
    options.borrow = borrow;
    return hf_inner::factor::load_factor(bytes, options, memory, two);
  }
  hf_result code_of(const std::vector<std::uint8_t>& bytes, std::int32_t n) {
    try {
      load(bytes, n);
    } catch (const hf_inner::Error& error) {
      return error.code();
    }
    return HF_OK;
  }
  // Both checksums of changed bytes are set right, so that the other checks have to hold alone.
  void repair(std::vector<std::uint8_t>& bytes) {
    const std::uint64_t body = hf_inner::factor::hash_bytes(bytes.data() + header, bytes.size() - header, memory, one,
                                                            [](std::uint64_t, std::uint64_t) {});
    std::memcpy(bytes.data() + 88, &body, 8);
    const std::uint64_t head = hf_inner::factor::hash_piece(bytes.data(), header - 8);
    std::memcpy(bytes.data() + header - 8, &head, 8);
  }
  // A copy aligned for reading in place.
  hf_inner::Buffer<std::uint8_t> aligned(const std::vector<std::uint8_t>& bytes) {
    hf_inner::Buffer<std::uint8_t> copy(memory, bytes.size());
    std::memcpy(copy.data(), bytes.data(), bytes.size());
    return copy;
  }
  hf_inner::Memory memory;
  hf_inner::JobRunner one{1};
  hf_inner::JobRunner two{2};
};

TEST_F(FactorBytes, a_loaded_factor_sweeps_to_the_same_bits_and_refactors) {
  for (const std::int32_t side : {1, 2, 40}) {
    const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, side, side);
    const auto factor = make(a);
    const std::vector<std::uint8_t> bytes = save(*factor);
    EXPECT_EQ(save(*make(a, two)), bytes);
    const hf_inner::Buffer<std::uint8_t> in_place = aligned(bytes);
    for (const bool borrow : {false, true}) {
      const auto loaded = load({in_place.data(), in_place.size()}, a.size(), borrow);
      EXPECT_TRUE(loaded->statistics().loaded);
      EXPECT_EQ(loaded->statistics().borrowed, borrow);
      EXPECT_EQ(loaded->statistics().numeric_ms, 0);
      EXPECT_EQ(loaded->statistics().entries, factor->statistics().entries);
      std::vector<double> x(static_cast<std::size_t>(a.size())), y;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<double>(i));
      y = x;
      factor->forward(x.data(), 1, one);
      factor->backward(x.data(), 1, one);
      loaded->forward(y.data(), 1, two);
      loaded->backward(y.data(), 1, two);
      EXPECT_EQ(x, y);
      EXPECT_EQ(save(*loaded), bytes);
      EXPECT_EQ(save(*loaded->refactor(a, {}, memory, two)), bytes);
    }
    EXPECT_EQ(std::vector<std::uint8_t>(in_place.begin(), in_place.end()), bytes) << "borrowed bytes were written to";
  }
}

TEST_F(FactorBytes, the_hash_is_the_same_for_any_threads_and_sees_every_bit) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{200},
                                   static_cast<std::size_t>(hf_inner::factor::hash_piece_bytes) + 13}) {
    std::vector<std::uint8_t> bytes(length);
    for (std::size_t k = 0; k < length; ++k) bytes[k] = static_cast<std::uint8_t>(k * 37 + 5);
    const std::uint64_t expected = hf_inner::factor::hash_array(bytes.data(), length, memory, one);
    EXPECT_EQ(hf_inner::factor::hash_array(bytes.data(), length, memory, two), expected);
    const std::size_t step = length > 1000 ? 997 : 1;
    for (std::size_t k = 0; k < length; k += step) {
      for (int bit = 0; bit < 8; ++bit) {
        bytes[k] ^= static_cast<std::uint8_t>(1 << bit);
        EXPECT_NE(hf_inner::factor::hash_array(bytes.data(), length, memory, one), expected);
        bytes[k] ^= static_cast<std::uint8_t>(1 << bit);
      }
    }
    bytes.push_back(0);
    EXPECT_NE(hf_inner::factor::hash_array(bytes.data(), length + 1, memory, one), expected);
  }
}

TEST_F(FactorBytes, the_hash_of_a_matrix_sees_pattern_numbers_and_grounds) {
  hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 9, 8);
  const std::vector<std::int32_t> ground = {0, 40};
  const std::vector<double> weight = {1.0, 2.0};
  const std::uint64_t expected = hf_inner::factor::hash_matrix(a, ground, weight, memory, one);
  EXPECT_EQ(hf_inner::factor::hash_matrix(a, ground, weight, memory, two), expected);
  a.value[17] = std::nextafter(a.value[17], 1e300);
  EXPECT_NE(hf_inner::factor::hash_matrix(a, ground, weight, memory, one), expected);
  a.value[17] = std::nextafter(a.value[17], -1e300);
  EXPECT_EQ(hf_inner::factor::hash_matrix(a, ground, weight, memory, one), expected);
  a.row[3] += 1;
  EXPECT_NE(hf_inner::factor::hash_matrix(a, ground, weight, memory, one), expected);
  a.row[3] -= 1;
  EXPECT_NE(hf_inner::factor::hash_matrix(a, std::vector<std::int32_t>{0, 41}, weight, memory, one), expected);
  EXPECT_NE(hf_inner::factor::hash_matrix(a, ground, std::vector<double>{1.0, 2.5}, memory, one), expected);
}

TEST_F(FactorBytes, foreign_matrices_sizes_versions_byte_orders_and_every_truncation_are_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 6, 6);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  EXPECT_EQ(code_of(bytes, 36), HF_OK);
  EXPECT_EQ(code_of(bytes, 37), HF_ERROR_INVALID_ARGUMENT);
  hf_inner::factor::LoadOptions other;
  other.unknowns = 36;
  other.matrix_hash = matrix_hash + 1;
  EXPECT_THROW(hf_inner::factor::load_factor(bytes, other, memory, one), hf_inner::Error);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_EQ(code_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}, 36),
              HF_ERROR_INVALID_ARGUMENT);
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_EQ(code_of(longer, 36), HF_ERROR_INVALID_ARGUMENT);
  for (const std::size_t field : {std::size_t{8}, std::size_t{12}}) {  // version, byte order
    std::vector<std::uint8_t> future = bytes;
    future[field] += 1;
    EXPECT_EQ(code_of(future, 36), HF_ERROR_UNSUPPORTED);
  }
  std::vector<std::uint8_t> small(bytes.size() - 1);
  EXPECT_THROW(hf_inner::factor::save_factor(*make(a), matrix_hash, {small.data(), small.size()}, memory, one),
               hf_inner::Error);
}

TEST_F(FactorBytes, borrowed_bytes_that_are_not_aligned_are_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 6, 6);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  hf_inner::Buffer<std::uint8_t> block(memory, bytes.size() + 64);
  for (const std::size_t offset : {std::size_t{0}, std::size_t{8}, std::size_t{1}, std::size_t{32}}) {
    std::memcpy(block.data() + offset, bytes.data(), bytes.size());
    const hf_inner::Span<const std::uint8_t> given(block.data() + offset, bytes.size());
    EXPECT_NO_THROW(load(given, 36));
    if (offset == 0) {
      EXPECT_NO_THROW(load(given, 36, true));
    } else {
      EXPECT_THROW(load(given, 36, true), hf_inner::Error);
    }
  }
}

TEST_F(FactorBytes, every_flipped_bit_is_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 4, 4);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::uint8_t> damaged = bytes;
      damaged[k] ^= static_cast<std::uint8_t>(1 << bit);
      ASSERT_NE(code_of(damaged, 16), HF_OK) << "byte " << k << " bit " << bit;
    }
  }
}

TEST_F(FactorBytes, numbers_that_are_not_finite_and_diagonals_that_are_not_positive_are_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 7, 5);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  const auto factor = make(a);
  const hf_inner::factor::Symbolic& symbolic =
      static_cast<const hf_inner::factor::SupernodalFactor&>(*factor).symbolic();
  const std::size_t numbers = static_cast<std::size_t>(symbolic.stored_entries);
  const std::size_t values = bytes.size() - (8 * (numbers + 64) + 63) / 64 * 64;
  const double bad[] = {std::nan(""), HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = 0; k < numbers; ++k) {
    for (const double value : bad) {
      std::vector<std::uint8_t> forged = bytes;
      std::memcpy(forged.data() + values + 8 * k, &value, 8);
      repair(forged);
      ASSERT_EQ(code_of(forged, 35), HF_ERROR_INVALID_ARGUMENT) << "number " << k;
    }
  }
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    std::int64_t at = symbolic.value_start[s];
    for (std::int32_t j = 0; j < symbolic.columns(s); ++j, at += j + 1) {
      for (const double value : {0.0, -0.0, -1.0}) {
        std::vector<std::uint8_t> forged = bytes;
        std::memcpy(forged.data() + values + 8 * static_cast<std::size_t>(at), &value, 8);
        repair(forged);
        ASSERT_EQ(code_of(forged, 35), HF_ERROR_INVALID_ARGUMENT) << "supernode " << s << " column " << j;
      }
    }
  }
}

TEST_F(FactorBytes, row_lists_that_do_not_go_on_in_their_parent_are_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 12, 9);
  const auto factor = make(a);
  const std::vector<std::uint8_t> bytes = save(*factor);
  const hf_inner::factor::Symbolic& symbolic =
      static_cast<const hf_inner::factor::SupernodalFactor&>(*factor).symbolic();
  const std::size_t n = 108, supernodes = static_cast<std::size_t>(symbolic.supernodes);
  const auto padded = [](std::size_t size) { return (size + 63) / 64 * 64; };
  const std::size_t rows = header + padded(4 * n) + padded(4 * (supernodes + 1)) + padded(4 * supernodes);
  int forged_lists = 0;
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    const std::int32_t parent = symbolic.parent[s], count = symbolic.below(s);
    for (std::int32_t k = 1; k < count; ++k) {
      const std::int32_t* list = symbolic.row_list(s);
      const std::int32_t* up = symbolic.row_list(parent);
      for (std::int32_t row = list[k - 1] + 1; row < (k + 1 < count ? list[k + 1] : 108); ++row) {
        if (row < symbolic.first[parent + 1] || std::count(up, up + symbolic.below(parent), row)) continue;
        std::vector<std::uint8_t> forged = bytes;
        std::memcpy(forged.data() + rows + 4 * static_cast<std::size_t>(symbolic.row_start[s] + k), &row, 4);
        repair(forged);
        ASSERT_EQ(code_of(forged, 108), HF_ERROR_INVALID_ARGUMENT) << "supernode " << s << " row " << row;
        ++forged_lists;
      }
    }
  }
  EXPECT_GT(forged_lists, 100);
}

TEST_F(FactorBytes, forged_bytes_with_right_checksums_never_crash) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 9, 8);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  const std::size_t lists = bytes.size() / 4;  // the index lists lie in front of the numbers
  std::mt19937 random(1);
  int accepted = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> forged = bytes;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = 16 + random() % ((round % 3 == 0 ? bytes.size() : lists) - 16);
      if ((at >= 48 && at < 56) || (at >= 80 && at < 96) || at / 8 == header / 8 - 1) continue;  // the hashes
      switch (round % 4) {
        case 0:
          forged[at] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          forged[at] = static_cast<std::uint8_t>(forged[at] + 1);
          break;
        case 2:
          forged[at] ^= static_cast<std::uint8_t>(1u << random() % 8);
          break;
        default:
          std::swap(forged[at / 4 * 4], forged[at / 4 * 4 + (at >= header && at + 8 < lists ? 4 : 0)]);
          break;
      }
    }
    repair(forged);
    const hf_inner::Buffer<std::uint8_t> in_place = aligned(forged);
    try {
      const auto factor = load({in_place.data(), in_place.size()}, 72, round % 2);
      ++accepted;
      std::vector<double> z(72 * 3, 1.0);
      factor->forward(z.data(), 3, two);
      factor->backward(z.data(), 3, two);
      try {
        factor->refactor(a, {}, memory, one);
      } catch (const hf_inner::Error&) {
      }
      const std::int32_t start[] = {0, 1, 2}, row[] = {5, 60};
      const double value[] = {1, 1};
      std::int32_t group[2], column[2];
      hf_inner::Vector<std::shared_ptr<const hf_inner::factor::PathGroup>> groups(&memory);
      factor->solve_paths({{start, 3}, {row, 2}, {value, 2}}, memory, one, groups, {group, 2}, {column, 2});
    } catch (const hf_inner::Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(accepted, 2000);  // changed numbers are as good as any
}

TEST_F(FactorBytes, the_single_precision_copy_sweeps_to_single_precision_and_the_same_bits_for_any_threads) {
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, hf_test::torus(150, 90, 0.25));
  const auto factor = make(a);
  const auto preview = hf_inner::factor::PreviewFactor::make(*factor, memory, two);
  EXPECT_LT(preview->bytes(), 0.55 * factor->statistics().bytes);
  for (const std::int32_t channels : {1, 2, 3, 8}) {
    std::vector<double> z(static_cast<std::size_t>(a.size() * channels));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = std::sin(0.3 * static_cast<double>(i));
    std::vector<float> x(z.begin(), z.end()), y = x;
    factor->backward(z.data(), channels, one);
    preview->backward(x.data(), channels, one);
    preview->backward(y.data(), channels, two);
    EXPECT_EQ(x, y);
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      worst = std::max(worst, std::abs(z[i] - static_cast<double>(x[i])));
      size = std::max(size, std::abs(z[i]));
    }
    EXPECT_LT(worst, 1e-5 * size);
    EXPECT_GT(worst, 0);
  }
}

}  // namespace
