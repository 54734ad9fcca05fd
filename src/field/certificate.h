// How right a field is, measured on the equations it stands for (certificate.cpp).
#pragma once
#include <cstdint>

#include "field/scalar_field.h"

namespace hf_inner {

// Errors are relative to the range of the site values of a component and channel: where all are equal, to their size.
struct Certificate {
  double value_range = 0;  // largest less smallest site value, the widest over components and channels
  double residual = 0;     // of a vertex, in K's own diagonal: how far it is from the weighted mean of its neighbours
  double site_error = 0;   // of what a site demands
  double overshoot = 0;    // how far the field leaves the range of the site values; 0 when not checked
  bool overshoot_checked = false;
  std::int32_t vertex = Mesh::none;  // inner vertex of the largest of the three
};

// Solves the field and checks it; what is not finite counts as infinitely wrong. Throws HF_ERROR_NO_SITES.
Certificate certify(const ScalarField& field);

}  // namespace hf_inner
