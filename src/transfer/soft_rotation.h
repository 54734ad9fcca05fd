// A rotation that follows a moment matrix, and never jumps when the matrix changes a little.
//
// best_rotation (deform/rotation.h) gives argmax tr(R' S). It jumps where two rotations are equally good: for a thin
// tip, whose moments are nearly collinear, noise then decides the twist. Let b be the quaternion of a guide, and N(S)
// the matrix of Horn 1987. This function gives instead q = P b / |P b|, P = (I + k N / m)^m, which tends to exp(k N). P
// is positive definite, so b' P b > 0, and q depends smoothly on S and b. Eigenvectors of N whose eigenvalue is smaller
// by a gap g count less by exp(-k g). So q is the best rotation where it is certain, and stays near the guide where it
// is not. If S = R A with A positive and b is R, then q is R: rigid motions stay exact. No earlier frame has an
// influence. A call costs five products of symmetric 4 x 4 matrices and allocates nothing.
#pragma once
#include "deform/rotation.h"

namespace hf_inner::transfer {

// sharpness: k. Non-finite input gives the guide.
deform::Quaternion soft_rotation(const Mat3& s, const deform::Quaternion& guide, double sharpness) noexcept;

}  // namespace hf_inner::transfer
