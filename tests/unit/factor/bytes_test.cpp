// Saved factors and the single-precision copy.
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "factor/factor_bytes.h"
#include "factor/preview.h"
#include "factor/supernodal_factor.h"
#include "unit/factor/matrices.h"

namespace {

class FactorBytes : public testing::Test {
 protected:
  std::shared_ptr<const hf::Factor> make(const hf::SymmetricMatrix& a) {
    return hf::Factor::make(a, {}, hf::FactorOptions{}, memory, one);
  }
  std::vector<std::uint8_t> save(const hf::Factor& factor) {
    std::vector<std::uint8_t> bytes(hf::saved_factor_size(factor));
    hf::save_factor(factor, {bytes.data(), bytes.size()});
    return bytes;
  }
  std::shared_ptr<const hf::Factor> load(const std::vector<std::uint8_t>& bytes, std::int32_t n) {
    return hf::load_factor({bytes.data(), bytes.size()}, n, memory);
  }
  hf_result code_of(const std::vector<std::uint8_t>& bytes, std::int32_t n) {
    try {
      load(bytes, n);
    } catch (const hf::Error& error) {
      return error.code();
    }
    return HF_OK;
  }
  hf::Memory memory;
  hf::JobRunner one{1};
  hf::JobRunner two{2};
};

TEST_F(FactorBytes, a_loaded_factor_sweeps_to_the_same_bits_and_refactors) {
  for (const std::int32_t side : {1, 2, 40}) {
    const hf::SymmetricMatrix a = hf_test::grid_laplacian(memory, side, side);
    const auto factor = make(a);
    const auto loaded = load(save(*factor), a.size());
    std::vector<double> x(static_cast<std::size_t>(a.size())), y;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<double>(i));
    y = x;
    factor->forward(x.data(), 1, one), factor->backward(x.data(), 1, one);
    loaded->forward(y.data(), 1, two), loaded->backward(y.data(), 1, two);
    const std::vector<std::uint8_t> bytes = save(*factor);
    EXPECT_EQ(save(*hf::load_factor({bytes.data(), bytes.size()}, a.size(), memory, &two)), bytes);
    EXPECT_EQ(x, y);
    EXPECT_EQ(save(*loaded), save(*factor));
    EXPECT_EQ(save(*loaded->refactor(a, {}, memory, two)), save(*factor));
  }
}

TEST_F(FactorBytes, foreign_sizes_versions_and_every_truncation_are_refused) {
  const hf::SymmetricMatrix a = hf_test::grid_laplacian(memory, 6, 6);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  EXPECT_EQ(code_of(bytes, 36), HF_OK);
  EXPECT_EQ(code_of(bytes, 37), HF_ERROR_INVALID_ARGUMENT);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_EQ(code_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}, 36),
              HF_ERROR_INVALID_ARGUMENT);
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_EQ(code_of(longer, 36), HF_ERROR_INVALID_ARGUMENT);
  std::vector<std::uint8_t> future = bytes;
  future[8] = 2;
  EXPECT_EQ(code_of(future, 36), HF_ERROR_UNSUPPORTED);
  std::vector<std::uint8_t> small(bytes.size() - 1);
  EXPECT_THROW(hf::save_factor(*make(a), {small.data(), small.size()}), hf::Error);
}

TEST_F(FactorBytes, every_flipped_bit_is_refused) {
  const hf::SymmetricMatrix a = hf_test::grid_laplacian(memory, 4, 4);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::uint8_t> damaged = bytes;
      damaged[k] ^= static_cast<std::uint8_t>(1 << bit);
      ASSERT_NE(code_of(damaged, 16), HF_OK) << "byte " << k << " bit " << bit;
    }
  }
}

// The checksums are repaired after the damage, so that the structural checks have to hold alone.
std::uint64_t checksum(const std::uint8_t* bytes, std::uint64_t length) {
  std::uint64_t chain[4] = {1, 2, 3, 4};
  const auto mix = [](std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * 0x9E3779B97F4A7C15ull;
    return state ^ (state >> 32);
  };
  std::uint64_t k = 0;
  for (; k + 32 <= length; k += 32) {
    std::uint64_t word[4];
    std::memcpy(word, bytes + k, sizeof word);
    for (int c = 0; c < 4; ++c) chain[c] = mix(chain[c], word[c]);
  }
  for (; k < length; ++k) chain[k & 3] = mix(chain[k & 3], bytes[k]);
  return mix(mix(chain[0], chain[1]), mix(chain[2], chain[3]) ^ length);
}

TEST_F(FactorBytes, forged_lists_with_right_checksums_never_crash) {
  const hf::SymmetricMatrix a = hf_test::grid_laplacian(memory, 9, 8);
  const std::vector<std::uint8_t> bytes = save(*make(a));
  std::mt19937 random(1);
  int accepted = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> forged = bytes;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = 12 + random() % (bytes.size() - 12);
      if (at >= 72 && at < 88) continue;
      forged[at] = round % 2 ? static_cast<std::uint8_t>(random()) : static_cast<std::uint8_t>(forged[at] + 1);
    }
    const std::uint64_t body = checksum(forged.data() + 88, forged.size() - 88);
    std::memcpy(forged.data() + 72, &body, 8);
    const std::uint64_t head = checksum(forged.data(), 80);
    std::memcpy(forged.data() + 80, &head, 8);
    try {
      const auto factor = load(forged, 72);
      ++accepted;
      std::vector<double> z(72 * 3, 1.0);
      factor->forward(z.data(), 3, two), factor->backward(z.data(), 3, two);
      try {
        factor->refactor(a, {}, memory, one);
      } catch (const hf::Error&) {
      }
      const std::int32_t start[] = {0, 1, 2}, row[] = {5, 60};
      const double value[] = {1, 1};
      std::int32_t group[2], column[2];
      hf::Vector<std::shared_ptr<const hf::PathGroup>> groups(&memory);
      factor->solve_paths({{start, 3}, {row, 2}, {value, 2}}, memory, one, groups, {group, 2}, {column, 2});
    } catch (const hf::Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(accepted, 2000);  // changed numbers are as good as any
}

TEST_F(FactorBytes, the_single_precision_copy_sweeps_to_single_precision_and_the_same_bits_for_any_threads) {
  const hf::SymmetricMatrix a = hf_test::cotangent_matrix(memory, hf_test::torus(150, 90, 0.25));
  const auto factor = make(a);
  const auto preview = hf::PreviewFactor::make(*factor, memory, two);
  EXPECT_LT(preview->bytes(), 0.55 * factor->statistics().bytes);
  for (const std::int32_t channels : {1, 2, 3, 8}) {
    std::vector<double> z(static_cast<std::size_t>(a.size() * channels));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = std::sin(0.3 * static_cast<double>(i));
    std::vector<float> x(z.begin(), z.end()), y = x;
    factor->backward(z.data(), channels, one);
    preview->backward(x.data(), channels, one), preview->backward(y.data(), channels, two);
    EXPECT_EQ(x, y);
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      worst = std::max(worst, std::abs(z[i] - static_cast<double>(x[i]))), size = std::max(size, std::abs(z[i]));
    EXPECT_LT(worst, 1e-5 * size);
    EXPECT_GT(worst, 0);
  }
}

}  // namespace
