// Keeps feature edges (borders, creases) on lines of the grid.
//
// A feature edge runs along u or along v in the map of its triangle. So the other coordinate is the same at both ends,
// and it is a whole number. Every such equation joins two real unknowns: x_a = +-x_b + (a sum of parameters of the
// seams). Unknowns that are joined become one: a line. Lines are kept as trees (union-find with signs and sums). Where
// an equation closes a circle, it is one between parameters alone. It is then solved for a parameter that is a sum
// of whole multiples of the others, so that whole numbers stay whole. An equation without such a parameter is left out
// and counted.
#pragma once
#include "quads/seams.h"

namespace hf_inner::quads {

struct RealTerm {
  std::int32_t number;  // 2 parameter + part; part 0 is real, part 1 imaginary
  double factor;
};
using RealSum = Vector<RealTerm>;  // by ascending number

// Adds factor other to a sum.
void add_to(RealSum& sum, const RealSum& other, double factor);
// The real (part 0) or imaginary (part 1) part of a complex sum.
RealSum part_of(const SeamSum& sum, int part, Memory& memory);

class FeatureLines {
 public:
  FeatureLines(const remesh::FluxSurface& surface, const Seams& seams, Memory& memory);
  // Adds the equation of half-edge h of a real triangle. edge: its vector in the triangle's frame.
  void add(std::int32_t h, std::complex<double> edge);

  // Coordinate `part` of vertex v: a line with a sign, plus a sum of parameters.
  struct Place {
    explicit Place(Memory& memory) : sum(&memory) {}
    std::int32_t line = -1;  // -1: the sum alone
    double sign = 1;
    RealSum sum;
  };
  // Whether the coordinate is on a line, or a sum of parameters because of one.
  bool has(std::int32_t v, int part) const noexcept { return slot_[2 * v + part] >= 0; }
  Place place(std::int32_t v, int part);
  // The line of an edge that was added; -1 where its coordinate is a sum of parameters.
  std::int32_t line_of(std::int32_t h, std::complex<double> edge);
  // Replaces parameters that equations were solved for.
  void reduce(RealSum& sum) const;
  bool is_solved(std::int32_t number) const noexcept { return solved_[number] >= 0; }
  std::int32_t line_count() const noexcept { return slots_; }  // lines have numbers below this, not all are used
  std::int32_t left_out() const noexcept { return left_out_; }

 private:
  int part_along(std::int32_t h, std::complex<double> edge) const noexcept;
  // Which coordinate of the vertex at the tail of h is coordinate `part` in the map of its triangle.
  int own_part(std::int32_t h, int part) const noexcept { return (seams_.unit[h] & 1) == 0 ? part : 1 - part; }
  Place corner(std::int32_t h, int part);
  Place find(std::int32_t slot);
  void equate(const Place& a, const Place& b);
  void relate(RealSum sum);

  const remesh::FluxSurface& surface_;
  const Seams& seams_;
  Memory& memory_;
  remesh::Table<std::int32_t> slot_;  // by vertex and part
  // By slot: x = sign x_parent + sum; at a root, parent is the slot itself, or -1 where the sum is its value.
  remesh::Table<std::int32_t> parent_;
  remesh::Table<double> sign_;
  Vector<RealSum> sum_;
  std::int32_t slots_ = 0, left_out_ = 0;
  remesh::Table<std::int32_t> solved_;  // by real parameter: its place in solutions_, or -1
  Vector<RealSum> solutions_;
  remesh::Table<std::int32_t> path_;
};

}  // namespace hf_inner::quads
