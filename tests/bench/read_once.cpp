#include "bench/read_once.h"

#include <algorithm>
#include <vector>

#include "bench/bench_support.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace bench {
namespace {

constexpr size_t block = 32;  // doubles of one step in one stream

// Sums `count` doubles (a multiple of streams * block) as `streams` runs side by side.
using Sum = double (*)(const double* numbers, size_t count, size_t streams);

double sum_plain(const double* numbers, size_t count, size_t streams) {
  const size_t length = count / streams;
  double a = 0, b = 0, c = 0, d = 0;
  for (size_t i = 0; i < length; i += 4) {
    for (size_t s = 0; s < streams; ++s) {
      const double* p = numbers + s * length + i;
      a += p[0];
      b += p[1];
      c += p[2];
      d += p[3];
    }
  }
  return a + b + c + d;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) double sum_avx2(const double* numbers, size_t count, size_t streams) {
  const size_t length = count / streams;
  __m256d a = _mm256_setzero_pd(), b = a, c = a, d = a;
  for (size_t i = 0; i < length; i += block) {
    for (size_t s = 0; s < streams; ++s) {
      const double* p = numbers + s * length + i;
      for (size_t half = 0; half < block; half += 16) {
        a = _mm256_add_pd(a, _mm256_loadu_pd(p + half));
        b = _mm256_add_pd(b, _mm256_loadu_pd(p + half + 4));
        c = _mm256_add_pd(c, _mm256_loadu_pd(p + half + 8));
        d = _mm256_add_pd(d, _mm256_loadu_pd(p + half + 12));
      }
    }
  }
  double lanes[4];
  _mm256_storeu_pd(lanes, _mm256_add_pd(_mm256_add_pd(a, b), _mm256_add_pd(c, d)));
  return lanes[0] + lanes[1] + lanes[2] + lanes[3];
}

__attribute__((target("avx512f"))) double sum_avx512(const double* numbers, size_t count, size_t streams) {
  const size_t length = count / streams;
  __m512d a = _mm512_setzero_pd(), b = a, c = a, d = a;
  for (size_t i = 0; i < length; i += block) {
    for (size_t s = 0; s < streams; ++s) {
      const double* p = numbers + s * length + i;
      a = _mm512_add_pd(a, _mm512_loadu_pd(p));
      b = _mm512_add_pd(b, _mm512_loadu_pd(p + 8));
      c = _mm512_add_pd(c, _mm512_loadu_pd(p + 16));
      d = _mm512_add_pd(d, _mm512_loadu_pd(p + 24));
    }
  }
  double lanes[8], total = 0;
  _mm512_storeu_pd(lanes, _mm512_add_pd(_mm512_add_pd(a, b), _mm512_add_pd(c, d)));
  for (const double lane : lanes) total += lane;
  return total;
}
#endif

Sum widest_sum() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return sum_avx512;
  if (__builtin_cpu_supports("avx2")) return sum_avx2;
#endif
  return sum_plain;
}

}  // namespace

Reader::Reader(double bytes, uint32_t threads) : jobs_(threads), sums_(memory_, threads) {
  const size_t unit = size_t{threads} * 4 * block;
  data_.allocate(memory_, std::max<size_t>(1, static_cast<size_t>(bytes / 8) / unit) * unit);
  std::fill(data_.begin(), data_.end(), 1.0);
  double best = 0;
  for (const size_t streams : {1, 2, 4}) {
    std::vector<double> times;
    for (int i = 0; i < 9; ++i) times.push_back(pass(streams));
    if (best == 0 || median(times) < best) {
      best = median(times);
      streams_ = streams;
    }
  }
}

double Reader::ms() { return pass(streams_); }

double Reader::pass(size_t streams) {
  const Sum sum = widest_sum();
  const size_t share = data_.size() / sums_.size();
  const double ms = time_ms([&] {
    jobs_.for_each(static_cast<uint32_t>(sums_.size()),
                   [&](uint32_t t) { sums_[t] = sum(data_.data() + t * share, share, streams); });
  });
  volatile double sink = 0;
  for (const double s : sums_) sink = sink + s;
  return ms;
}

double read_once_ms(double bytes, uint32_t threads) {
  Reader reader(bytes, threads);
  return take_turns({{"read", [&] { return reader.ms(); }}}, 5)["read"];
}

}  // namespace bench
