// Previews: computes the field with a single-precision copy of the factor. A sweep then reads half the bytes of a sweep
// in double precision.
//
// The dense part and the paths are in double, and the backward sweep is in single precision. The error is about 1e-6 of
// the range of the site values. A correction (green_refine.cpp) computes the residuals r and g of the present field and
// flux in double. It solves for the changes du and dlambda with two single-precision sweeps:
//
//     K du - W dlambda = r,  W'du + D dlambda = g
//
// Each correction reduces the error by the relative error of the two sweeps. So the error that remains is about the
// size of the last correction times that factor. If sites are inside the factor after a rebase, or if it is an edited
// one, a preview is the exact field. A correction costs a product with K and two single-precision sweeps.
//
// A field that takes corrections in double (bi-harmonic, long, crowded) may have no digit in single precision. Nothing
// is known of the error of its preview without a correction. With corrections, the last one measures it.
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "solve/green.h"

namespace hf_inner::solve {
namespace {

// Error of a preview (a field from a single-precision sweep), relative to the range of the site values: the largest
// seen on difficult sets of sites. A smaller number would promise too much there. A larger one would ask hosts for
// corrections they do not need. Half and double pass the 70 tests of the engine.
constexpr double sweep_error = 1e-5;
// Share of a preview's error that its first correction leaves. It is above the 3e-4 seen on 304,000 vertices. The share
// of later corrections is measured. Half and double pass the 70 tests of the engine.
constexpr double first_shrink = 2e-3;
// The estimated error of a preview is at least this share of the range of the site values: rounding in double. Half and
// double pass the 70 tests of the engine.
constexpr double least_error = 1e-13;

}  // namespace

// Returns the widest range of the site values over all components, for channels first .. first + count - 1.
double GreenSolver::value_range(const double* values, Index channels, Index first, Index count) const {
  Vector<double> low(&memory()), high(&memory());
  value_extent(values, channels, first, count, low, high);
  double range = 0;
  for (std::size_t i = 0; i < low.size(); ++i) range = std::max(range, high[i] - low[i]);
  return range;
}

void GreenSolver::solve_preview(const double* values, Index channels, Index corrections, double* field,
                                PreviewInfo& info) const {
  info = PreviewInfo{};
  if (state().base || core_->factored) {
    solve(values, channels, field, nullptr);
    info.exact = true;
    return;
  }
  const std::shared_ptr<const factor::PreviewFactor> single =
      core_->preview.get(*core_->factor, memory(), *core_->jobs);
  info.bytes = single->bytes();
  const bool is_measured = is_refined();
  info.corrections = corrections;
  const std::size_t n = at(core_->size()), stride = at(channels), widest = at(std::min(channels, channel_block));
  surface::Workspace z(core_->workspaces, n * widest);
  surface::Workspace scratch(core_->workspaces, (n * widest + 1) / 2);
  Answer answer(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    const double range = value_range(values, channels, first, count);
    std::fill_n(z.data(), n * m, 0.0);
    system_.find_centres(values, channels, first, count, answer);
    system_.solve_dense(values, channels, first, count, nullptr, answer);
    system_.combine(answer, count, z.data());
    Step sweeps;
    sweeps.single = single.get();
    sweeps.scratch = reinterpret_cast<float*>(scratch.data());
    single->backward(z.data(), count, sweeps.scratch, *core_->jobs);
    system_.count_sweeps(1);
    write_field(z.data(), channels, first, count, answer, field);
    copy_hard_values(values, channels, first, count, [&](Index v) { return field + at(v) * stride + at(first); });

    double error = is_measured ? HUGE_VAL : sweep_error * range, last = 0;
    for (Index step = 0; step < corrections; ++step) {
      refine(values, channels, first, count, z.data(), answer, field, sweeps);
      const double shrinks = is_measured ? 1.0 : last > 0 ? std::min(1.0, sweeps.largest / last) : first_shrink;
      error = sweeps.largest * shrinks;
      last = sweeps.largest;
    }
    if (corrections > 0) info.largest_correction = std::max(info.largest_correction, sweeps.largest);
    info.value_range = std::max(info.value_range, range);
    info.error_estimate = std::max(info.error_estimate, std::max(error, least_error * range));
  }
}

}  // namespace hf_inner::solve
