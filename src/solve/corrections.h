// Says when the corrections of a field end (green_refine.cpp).
#pragma once
#include <algorithm>

namespace hf_inner::solve {

// If the dense system of the sites has a pivot below this share of its diagonal, its solution may have fewer than ten
// correct digits. The field then takes corrections with the true operator, each of two sweeps or more. A larger number
// would add corrections that do not change the field. Half and double change no bit on eight shapes with three points
// in one triangle.
constexpr double crowded_share = 1e-4;

class Corrections {
 public:
  // Corrections of one field. A chain of 500,000 triangles takes two, a damaged factor uses them all. Half and double
  // change no bit on eight shapes with needles, loose pieces and a long ribbon.
  static constexpr int most = 6;

  // largest: what the last correction changed most, as a share of the range. True if the field needs another one. The
  // first solve changed the field by its whole range, and every correction shrinks the error by about the same factor.
  bool go_on(double largest) noexcept {
    const double shrink = largest / last_;
    const bool helps = count_ == 0 || shrink <= least_progress;
    last_ = largest;
    return ++count_ < most && helps && !(unlike_shrink * largest * std::min(1.0, shrink) <= small_change);
  }

 private:
  // Share of the range that the next correction may still change. Smaller adds sweeps that move the last digits, larger
  // shows on chains of 500,000 triangles. Half and double change no bit on eight shapes with needles, loose pieces and
  // a long ribbon.
  static constexpr double small_change = 1e-12;
  // A correction can be this much larger than the ratio of the two before it says. With 1, a bi-harmonic field around a
  // hub stopped at 8e-12 of its range; a larger number adds corrections that change nothing.
  static constexpr double unlike_shrink = 10;
  // A correction larger than this share of the one before no longer helps. A larger share adds corrections that are all
  // rounding, a smaller one could stop too early. A quarter and 1 change no bit on eight shapes, one of them a long
  // ribbon.
  static constexpr double least_progress = 0.5;
  double last_ = 1;
  int count_ = 0;
};

}  // namespace hf_inner::solve
