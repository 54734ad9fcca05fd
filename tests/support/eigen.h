// Eigen for tests that also include rooms which use it: the library's copy under its usual name (base/algebra.h).
// Include it first.
#pragma once
#include "base/algebra.h"
#define Eigen hf_eigen
#include <Eigen/Dense>
#undef Eigen
namespace Eigen = hf_eigen;
