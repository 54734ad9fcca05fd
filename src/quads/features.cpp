#include "quads/features.h"

#include <algorithm>
#include <cmath>

#include "quads/numbers.h"

namespace hf_inner::quads {

void add_to(RealSum& sum, const RealSum& other, double factor) {
  for (const RealTerm& term : other) {
    const auto found = std::lower_bound(sum.begin(), sum.end(), term.number,
                                        [](const RealTerm& a, std::int32_t n) { return a.number < n; });
    if (found != sum.end() && found->number == term.number) {
      found->factor += factor * term.factor;
    } else {
      sum.insert(found, RealTerm{term.number, factor * term.factor});
    }
  }
  sum.erase(std::remove_if(sum.begin(), sum.end(), [](const RealTerm& t) { return std::fabs(t.factor) < no_factor; }),
            sum.end());
}

RealSum part_of(const SeamSum& sum, int part, Memory& memory) {
  RealSum out(&memory);
  for (const SeamTerm& term : sum) {
    // (a + i b) (x + i y) = a x - b y + i (b x + a y)
    const double of_real = part == 0 ? term.factor.real() : term.factor.imag(),
                 of_imaginary = part == 0 ? -term.factor.imag() : term.factor.real();
    if (std::fabs(of_real) >= no_factor) out.push_back({2 * term.parameter, of_real});
    if (std::fabs(of_imaginary) >= no_factor) out.push_back({2 * term.parameter + 1, of_imaginary});
  }
  return out;
}

FeatureLines::FeatureLines(const remesh::FluxSurface& surface, const Seams& seams, Memory& memory)
    : surface_(surface),
      seams_(seams),
      memory_(memory),
      slot_(2 * surface.vertex_count(), none, memory),
      parent_(memory),
      sign_(memory),
      sum_(&memory),
      solved_(2 * seams.parameter_count, none, memory),
      solutions_(&memory),
      path_(memory) {}

void FeatureLines::reduce(RealSum& sum) const {
  RealSum out(&memory_);
  for (const RealTerm& term : sum) {
    if (solved_[term.number] >= 0) {
      add_to(out, solutions_[static_cast<std::size_t>(solved_[term.number])], term.factor);
    } else {
      add_to(out, RealSum(1, term, &memory_), 1);
    }
  }
  sum.swap(out);
}

FeatureLines::Place FeatureLines::find(std::int32_t slot) {
  // Every slot on the way becomes a child of the root: a line of n edges may be a chain of n slots.
  path_.clear();
  for (; slot != none && parent_[slot] != slot; slot = parent_[slot]) path_.push_back(slot);
  Place place(memory_);
  place.line = slot;
  for (std::int32_t i = path_.size(); i-- > 0;) {
    const std::int32_t s = path_[i];
    RealSum& sum = sum_[static_cast<std::size_t>(s)];
    // x_s = sign_s x_parent + sum_s, and x_parent = sign x_line + sum
    if (parent_[s] != none) {
      add_to(sum, place.sum, sign_[s]);
      place.sign *= sign_[s];
    }
    place.sum = sum;
    parent_[s] = slot;
    sign_[s] = place.sign;
  }
  return place;
}

std::int32_t FeatureLines::line_of(std::int32_t h, Complex edge) {
  return find(slot_[2 * surface_.tail[h] + own_part(h, part_along(h, edge))]).line;
}

FeatureLines::Place FeatureLines::place(std::int32_t v, int part) {
  std::int32_t& slot = slot_[2 * v + part];
  if (slot == none) {
    slot = slots_++;
    sum_.emplace_back();
    sign_.push_back(1.0);
    const std::int32_t parameter = seams_.parameter[v];
    if (parameter == Seams::free) {
      parent_.push_back(slot);
    } else {
      parent_.push_back(none);
      if (parameter >= 0) {
        sum_.back().push_back({2 * parameter + part, 1.0});
      } else {
        for (const Seams::Fixed& fixed : seams_.fixed) {
          if (fixed.vertex == v) sum_.back() = part_of(fixed.sum, part, memory_);
        }
      }
    }
  }
  return find(slot);
}

// Coordinate `part` of the corner at the tail of h, in the map of its triangle.
FeatureLines::Place FeatureLines::corner(std::int32_t h, int part) {
  // i^k (x + i y): the real part is x, -y, -x, y for k = 0 .. 3, the imaginary part y, x, -y, -x.
  const int k = seams_.unit[h] & 3, own = own_part(h, part);
  const double sign = part == 0 ? (k == 1 || k == 2 ? -1 : 1) : (k == 2 || k == 3 ? -1 : 1);
  Place out = place(surface_.tail[h], own);
  out.sign *= sign;
  RealSum sum(&memory_);
  add_to(sum, out.sum, sign);
  if (seams_.offset[h] >= 0)
    add_to(sum, part_of(seams_.offsets[static_cast<std::size_t>(seams_.offset[h])], part, memory_), 1);
  out.sum.swap(sum);
  return out;
}

// The coordinate that stays along an edge.
int FeatureLines::part_along(std::int32_t h, Complex edge) const noexcept {
  const Complex image = edge * std::conj(seams_.direction[h / 3]);
  return std::fabs(image.real()) > std::fabs(image.imag()) ? 1 : 0;
}

void FeatureLines::add(std::int32_t h, Complex edge) {
  const int part = part_along(h, edge);
  const Place a = corner(h, part), b = corner(remesh::FluxSurface::next(h), part);
  equate(a, b);
}

void FeatureLines::equate(const Place& a, const Place& b) {
  if (a.line == none && b.line != none) return equate(b, a);
  RealSum difference(&memory_);  // b - a
  add_to(difference, b.sum, 1);
  add_to(difference, a.sum, -1);
  if (a.line == b.line) {
    if (a.line == none || a.sign == b.sign) return relate(std::move(difference));
    ++left_out_;  // 2 x = sum, and half a sum need not be whole
    return;
  }
  // x_a = sign_a (sign_b x_b + difference)
  RealSum sum(&memory_);
  add_to(sum, difference, a.sign);
  parent_[a.line] = b.line;
  sign_[a.line] = a.sign * b.sign;
  sum_[static_cast<std::size_t>(a.line)].swap(sum);
}

// Takes in that a sum of parameters is 0.
void FeatureLines::relate(RealSum sum) {
  reduce(sum);
  if (sum.empty()) return;
  for (std::size_t i = sum.size(); i-- > 0;) {
    const RealTerm pivot = sum[i];
    const bool whole = std::all_of(sum.begin(), sum.end(), [&](const RealTerm& t) {
      const double share = t.factor / pivot.factor;
      return std::fabs(share - std::nearbyint(share)) < no_factor;
    });
    if (!whole) continue;
    RealSum solution(&memory_);
    add_to(solution, sum, -1 / pivot.factor);
    solution.erase(
        std::find_if(solution.begin(), solution.end(), [&](const RealTerm& t) { return t.number == pivot.number; }));
    for (RealSum& other : solutions_) {
      const auto found =
          std::find_if(other.begin(), other.end(), [&](const RealTerm& t) { return t.number == pivot.number; });
      if (found == other.end()) continue;
      const double factor = found->factor;
      other.erase(found);
      add_to(other, solution, factor);
    }
    solved_[pivot.number] = static_cast<std::int32_t>(solutions_.size());
    solutions_.push_back(solution);
    return;
  }
  ++left_out_;
}

}  // namespace hf_inner::quads
