// Compiles directions.inl for eight lanes with -mavx512f. The library chooses it at run time.
#include "field/directions.h"
#include "field/directions.inl"

namespace hf_inner::field {

void add_directions_avx512(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;
void add_directions_avx512(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept {
  add_directions_range(job, begin, end);
}

}  // namespace hf_inner::field
