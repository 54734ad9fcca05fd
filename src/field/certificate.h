// Measures how well a field satisfies its own equations.
#pragma once
#include <cstdint>

#include "field/scalar_field.h"

namespace hf_inner::field {

// The errors of a field. Each error is relative to the range of the site values of its component and channel, and of
// its targets where it is screened. If all are equal, it is relative to their size.
struct Certificate {
  double value_range = 0;  // widest range of the site values of a component and channel
  double residual = 0;     // distance of a vertex from the weighted mean of its neighbours
  double site_error = 0;   // largest error of the condition of a site
  double overshoot = 0;    // how far the field leaves the range of the site values; 0 when not checked
  double error = 0;        // of the field: a bound, or an estimate (certificate.cpp)
  bool overshoot_checked = false;
  std::int32_t vertex = mesh::Mesh::none;  // inner vertex of the largest of error, site_error and overshoot
};

// Returns the tolerance of the caller, or the tolerance of the engine for 0. Throws HF_ERROR_INVALID_ARGUMENT unless
// the tolerance is above 0 and finite.
double certificate_tolerance(double asked, const solve::SiteSolver& engine);

// Solves the field and measures its errors. A value that is not finite has an infinite error. Throws HF_ERROR_EMPTY.
Certificate certify(const ScalarField& field);

// Throws HF_ERROR_INACCURATE if an error is above the tolerance. vertex: its vertex in the caller's mesh.
void require_accuracy(const Certificate& found, double tolerance, std::uint32_t vertex);

}  // namespace hf_inner::field
