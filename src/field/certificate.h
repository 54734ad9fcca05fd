// Measures the error of a field on the equations that it must satisfy (certificate.cpp).
#pragma once
#include <cstdint>

#include "field/scalar_field.h"

namespace hf_inner {

// Errors are relative to the range of the site values of a component and channel: where all are equal, to their size.
struct Certificate {
  double value_range = 0;  // widest range of the site values of a component and channel
  double residual = 0;     // distance of a vertex from the weighted mean of its neighbours
  double site_error = 0;   // largest error of the condition of a site
  double overshoot = 0;    // how far the field leaves the range of the site values; 0 when not checked
  double error = 0;        // of the field: a bound, or an estimate (certificate.cpp)
  bool overshoot_checked = false;
  std::int32_t vertex = Mesh::none;  // inner vertex of the largest of error, site_error and overshoot
};

// The tolerance asked for; for 0 that of the engine. Throws HF_ERROR_INVALID_ARGUMENT unless it is above 0 and finite.
double certificate_tolerance(double asked, EngineKind engine);

// Solves the field and checks it; a number that is not finite has an infinite error. Throws HF_ERROR_NO_SITES.
Certificate certify(const ScalarField& field);

}  // namespace hf_inner
