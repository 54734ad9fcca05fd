// Compiles directions.inl for four lanes with -mavx2. The library chooses it at run time.
#include "field/directions.h"
#include "field/directions.inl"

namespace hf_inner::field {

void add_directions_avx2(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;
void add_directions_avx2(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept {
  add_directions_range(job, begin, end);
}

}  // namespace hf_inner::field
