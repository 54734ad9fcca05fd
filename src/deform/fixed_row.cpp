#include "deform/fixed_row.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::deform {

double fix_row(Span<const std::uint16_t> cluster, Span<const float> weight, std::uint32_t count, std::uint32_t total,
               FixedRow& out) noexcept {
  // the heaviest, by insertion; of equal ones the one with the lower number
  double kept[most_row_entries], sum = 0;
  std::uint32_t used = 0;
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double w = static_cast<double>(weight[k]);
    if (used == count && !(w > kept[used - 1])) continue;
    std::uint32_t at = used < count ? used++ : used - 1;
    for (; at > 0 && w > kept[at - 1]; --at) {
      kept[at] = kept[at - 1];
      out.cluster[at] = out.cluster[at - 1];
    }
    kept[at] = w;
    out.cluster[at] = cluster[k];
  }
  for (std::uint32_t i = 0; i < used; ++i) sum += kept[i];

  // rounded down, and the units left over to the largest remainders
  double rest[most_row_entries];
  std::uint32_t left = total;
  for (std::uint32_t i = 0; i < used; ++i) {
    const double exact = total * kept[i] / sum, whole = std::floor(exact);
    out.units[i] = static_cast<std::uint32_t>(whole);
    rest[i] = exact - whole;
    left -= out.units[i];
  }
  for (; left > 0; --left) {
    const std::size_t most = static_cast<std::size_t>(std::max_element(rest, rest + used) - rest);
    ++out.units[most];
    rest[most] -= 1;
  }
  double change = 1 - sum;  // of the weights that were left out
  for (std::uint32_t i = 0; i < used; ++i) change += std::fabs(out.units[i] / static_cast<double>(total) - kept[i]);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i >= used) out.units[i] = 0;
    if (out.units[i] == 0) out.cluster[i] = out.cluster[0];
  }
  return 0.5 * change;
}

}  // namespace hf_inner::deform
