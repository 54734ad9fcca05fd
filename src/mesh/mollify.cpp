#include "mesh/mollify.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Number of triangles or edges that one thread's job takes. Half and twice the value take the same time within 10 %,
// the noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t mollify_piece = 16384;
// At most this many rounds lengthen edges of thin triangles. After them, one length is added to every edge. It bounds
// the time. Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr int most_rounds = 64;
// An edge grows by this factor more than needed, so that rounding does not break the triangle inequality. More moves
// fields without need. Without it, and with twice the excess, fields on eight shapes move by 1e-9 of their range.
constexpr double overshoot = 1.0001;

void find_lengths(const Mesh& mesh, const Topology& topology, MollifiedLengths& out, JobRunner* jobs) {
  const std::size_t edges = at(topology.edge_count());
  for_each(jobs, static_cast<std::uint32_t>((edges + mollify_piece - 1) / mollify_piece), [&](std::uint32_t p) {
    for (std::size_t e = p * mollify_piece; e < std::min(edges, (p + std::size_t{1}) * mollify_piece); ++e) {
      const Index first = topology.first(static_cast<Index>(e)), second = topology.second(static_cast<Index>(e));
      out.length[e] = norm(mesh.positions[at(second)] - mesh.positions[at(first)]);
      for (Index i = topology.edge_triangle_start[e]; i < topology.edge_triangle_start[e + 1]; ++i)
        out.edge_of_side[at(topology.corner(i))] = static_cast<Index>(e);
    }
  });
}

// Returns how much b + c - a of a triangle with edges a >= b >= c is below the margin of mollify.h, or 0. Sets
// `longest` to its longest side.
double missing(const double length[3], double floor, std::size_t& longest) noexcept {
  longest = 0;
  for (std::size_t k = 1; k < 3; ++k) longest = length[k] > length[longest] ? k : longest;
  const double a = length[longest], b = length[(longest + 1) % 3], c = length[(longest + 2) % 3];
  const double gap = std::min(b, c) - (a - std::max(b, c)), wanted = mollify_closing * std::max(a, floor);
  return gap < wanted ? overshoot * wanted - gap : 0.0;
}

}  // namespace

MollifiedLengths MollifiedLengths::make(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs) {
  MollifiedLengths out(memory);
  const std::size_t edges = at(topology.edge_count()), triangles = at(mesh.triangle_count());
  out.length.resize(edges);
  out.edge_of_side.resize(3 * triangles);
  find_lengths(mesh, topology, out, jobs);
  double sum = 0;
  for (const double l : out.length) sum += l;
  const double floor = sum > 0 ? mollify_floor * sum / static_cast<double>(edges) : 1.0;

  const std::uint32_t pieces = static_cast<std::uint32_t>((triangles + mollify_piece - 1) / mollify_piece);
  struct Thin {
    std::uint32_t triangle;
    std::size_t longest;
    double missing;
  };
  Vector<Vector<Thin>> thin(&memory);
  for (std::uint32_t p = 0; p < pieces; ++p) thin.emplace_back();
  Vector<double> raise(&memory);
  for (int round = 0;; ++round) {
    for_each(jobs, pieces, [&](std::uint32_t p) {
      thin[p].clear();
      for (std::size_t t = p * mollify_piece; t < std::min(triangles, (p + std::size_t{1}) * mollify_piece); ++t) {
        double length[3];
        for (std::size_t k = 0; k < 3; ++k) length[k] = out.length[at(out.edge_of_side[3 * t + k])];
        std::size_t longest = 0;
        const double more = missing(length, floor, longest);
        if (more > 0) thin[p].push_back({static_cast<std::uint32_t>(t), longest, more});
      }
    });
    std::size_t count = 0;
    double most = 0;
    for (const auto& list : thin) {
      count += list.size();
      for (const Thin& t : list) most = std::max(most, t.missing);
    }
    if (round == 0) out.thin_count = static_cast<std::uint32_t>(count);
    if (count == 0) return out;
    if (out.changed.empty()) {
      out.changed.assign(edges, 0);
      raise.assign(edges, 0.0);
    }
    if (round == most_rounds) {
      for (double& l : out.length) l += most;
      std::fill(out.changed.begin(), out.changed.end(), std::uint8_t{1});
      return out;
    }
    for (const auto& list : thin) {
      for (const Thin& t : list) {
        for (std::size_t k = 1; k < 3; ++k) {
          const std::size_t e = at(out.edge_of_side[3 * std::size_t{t.triangle} + (t.longest + k) % 3]);
          raise[e] = std::max(raise[e], 0.5 * t.missing);
          out.changed[e] = 1;
        }
      }
    }
    for (const auto& list : thin) {
      for (const Thin& t : list) {
        for (std::size_t k = 1; k < 3; ++k) {
          const std::size_t e = at(out.edge_of_side[3 * std::size_t{t.triangle} + (t.longest + k) % 3]);
          out.length[e] += raise[e];
          raise[e] = 0;
        }
      }
    }
  }
}

}  // namespace hf_inner::mesh
