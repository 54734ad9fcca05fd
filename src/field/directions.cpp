#include "field/directions.h"

#include "field/directions.inl"

namespace hf_inner::field {

#ifdef HF_DIRECTIONS_X86
void add_directions_avx2(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;
void add_directions_avx512(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;
#endif

void add_directions(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept {
#ifdef HF_DIRECTIONS_X86
  if (HF_PROCESSOR_HAS("avx512f")) return add_directions_avx512(job, begin, end);
  if (HF_PROCESSOR_HAS("avx2")) return add_directions_avx2(job, begin, end);
#endif
  add_directions_range(job, begin, end);
}

}  // namespace hf_inner::field
