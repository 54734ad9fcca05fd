// Joins vertices within a tolerance, in time near linear for any input.
//
// Space is cut into cells with a diagonal below the tolerance, so the points of a cell belong together without a
// comparison. Cells up to two apart are joined when a point of one is near a point of the other (near_points.h), unless
// they are joined already.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/near_points.h"
#include "mesh/weld.h"

namespace hf_inner::mesh {
namespace {

// The diagonal of a cell is 0.99 tolerances. Points a tolerance apart lie at most two cells apart. Both hold from 1.733
// to 2; the middle of the range would cost a few more cells.
constexpr double cells_per_tolerance = 1.75;
constexpr Index cell_reach = 2;
// Pairs up to which two cells are compared without a tree. 16 takes up to a third longer, 256 up to a quarter.
constexpr std::int64_t most_pairs = 64;
// Shares of the time for a million scattered points. They change reported progress only.
constexpr float numbering_begins = 0.1f, sorting_begins = 0.4f, joining_begins = 0.7f;

struct Place {
  Index x, y, z;  // its cell
  Index number;
};

bool cell_before(const Place& a, const Place& b) noexcept {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

struct NearCell {
  Index x, y, z;
  Index first, last;        // its points
  Index smallest;           // its smallest place, and of a joined set the smallest of the set
  Index tree = Mesh::none;  // the root, once it was needed
};

class ToleranceWeld {
 public:
  ToleranceWeld(double tolerance, Memory& memory)
      : nearness_(tolerance),
        memory_(memory),
        points_(&memory),
        cells_(&memory),
        sets_(&memory),
        cell_of_(&memory),
        tree_(points_, nearness_, memory) {}

  // Different places in, per place the smallest place of its set out.
  Vector<Index> run(const Vector<Vec3>& places) {
    report(numbering_begins);
    make_cells(places);
    join_cells();
    Vector<Index> smallest(places.size(), &memory_);
    for (std::size_t i = 0; i < places.size(); ++i) {
      poller_.due();
      smallest[i] = cells_[at(set_of(cell_of_[i]))].smallest;
    }
    return smallest;
  }

 private:
  void number_cells(const Vector<Vec3>& places, double Vec3::*axis, Vector<Place>& out, Index Place::*cell);
  void make_cells(const Vector<Vec3>& places);
  void join_cells();
  void join(Index a, Index b);
  bool cells_near(Index a, Index b);
  Index tree_of(Index cell);
  Index set_of(Index cell) noexcept {
    while (sets_[at(cell)] != cell) cell = sets_[at(cell)] = sets_[at(sets_[at(cell)])];
    return cell;
  }

  const Nearness nearness_;
  Memory& memory_;
  Vector<Vec3> points_;     // the places, cell after cell
  Vector<NearCell> cells_;  // ascending
  Vector<Index> sets_;      // of cells, by union-find
  Vector<Index> cell_of_;   // per place
  PointTree tree_;
  Poller poller_;
};

// Numbers along one axis. A gap of more than two cells starts a new row of cells, so numbers are exact at any distance.
// A place takes four numbers at most: they fit 31 bits for every mesh that is accepted.
void ToleranceWeld::number_cells(const Vector<Vec3>& places, double Vec3::*axis, Vector<Place>& out,
                                 Index Place::*cell) {
  struct Mark {
    double x;
    Index place;
  };
  Vector<Mark> marks(places.size(), &memory_);
  for (std::size_t i = 0; i < places.size(); ++i) marks[i] = {places[i].*axis, static_cast<Index>(i)};
  std::sort(marks.begin(), marks.end(), [&](const Mark& a, const Mark& b) {
    poller_.due();
    return a.x < b.x;
  });
  const double side = nearness_.tolerance() / cells_per_tolerance;
  double origin = marks[0].x, before = marks[0].x;
  Index base = 0, number = 0;
  for (const Mark& mark : marks) {
    poller_.due();
    if (nearness_.scaled(mark.x - before) > cell_reach * side) {
      origin = mark.x;
      base = number + cell_reach + 1;
    }
    number = base + static_cast<Index>(nearness_.scaled(mark.x - origin) / side);
    out[at(mark.place)].*cell = number;
    before = mark.x;
  }
}

void ToleranceWeld::make_cells(const Vector<Vec3>& places) {
  Vector<Place> order(places.size(), &memory_);
  number_cells(places, &Vec3::x, order, &Place::x);
  number_cells(places, &Vec3::y, order, &Place::y);
  number_cells(places, &Vec3::z, order, &Place::z);
  for (std::size_t i = 0; i < places.size(); ++i) order[i].number = static_cast<Index>(i);
  report(sorting_begins);
  std::sort(order.begin(), order.end(), [&](const Place& a, const Place& b) {
    poller_.due();
    return cell_before(a, b) || (!cell_before(b, a) && a.number < b.number);
  });
  points_.resize(places.size());
  cell_of_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    poller_.due();
    const Place& place = order[i];
    if (i == 0 || cell_before(order[i - 1], place))
      cells_.push_back({place.x, place.y, place.z, static_cast<Index>(i), 0, place.number});
    cells_.back().last = static_cast<Index>(i) + 1;
    points_[i] = places[at(place.number)];
    cell_of_[at(place.number)] = static_cast<Index>(cells_.size()) - 1;
  }
  sets_.resize(cells_.size());
  std::iota(sets_.begin(), sets_.end(), 0);
}

// Every pair of near cells once. Columns of cells lie together, so a cursor per neighbouring column moves on with the
// cells and never back.
void ToleranceWeld::join_cells() {
  struct Cursor {
    Index dx, dy, cell;
  };
  constexpr std::size_t columns = std::size_t{2} * cell_reach * (cell_reach + 1);
  Cursor cursors[columns];
  std::size_t used = 0;
  for (Index dx = 0; dx <= cell_reach; ++dx) {
    for (Index dy = dx == 0 ? 1 : -cell_reach; dy <= cell_reach; ++dy) cursors[used++] = {dx, dy, 0};
  }
  const Index count = static_cast<Index>(cells_.size());
  const auto join_column = [&](Index from, Index x, Index y, Index z, Index own) {
    for (Index k = from; k < count; ++k) {
      const NearCell& other = cells_[at(k)];
      if (other.x != x || other.y != y || other.z > z + cell_reach) return;
      join(own, k);
    }
  };
  constexpr Index cells_per_report = 4096;  // below a millisecond; a report costs a few nanoseconds
  for (Index c = 0; c < count; ++c) {
    const Index x = cells_[at(c)].x, y = cells_[at(c)].y, z = cells_[at(c)].z;
    if (c % cells_per_report == 0)
      report(joining_begins + (1 - joining_begins) * static_cast<float>(c) / static_cast<float>(count));
    join_column(c + 1, x, y, z, c);
    for (Cursor& cursor : cursors) {
      const auto before = [&](const NearCell& o) {
        return o.x != x + cursor.dx   ? o.x < x + cursor.dx
               : o.y != y + cursor.dy ? o.y < y + cursor.dy
                                      : o.z < z - cell_reach;
      };
      while (cursor.cell < count && before(cells_[at(cursor.cell)])) {
        ++cursor.cell;
        poller_.due();
      }
      join_column(cursor.cell, x + cursor.dx, y + cursor.dy, z, c);
    }
  }
}

void ToleranceWeld::join(Index a, Index b) {
  poller_.due();
  const Index x = set_of(a), y = set_of(b);
  if (x == y || !cells_near(a, b)) return;
  const Index root = std::min(x, y);
  sets_[at(std::max(x, y))] = root;
  cells_[at(root)].smallest = std::min(cells_[at(x)].smallest, cells_[at(y)].smallest);
}

bool ToleranceWeld::cells_near(Index a, Index b) {
  const NearCell &p = cells_[at(a)], &q = cells_[at(b)];
  if (std::int64_t{p.last - p.first} * (q.last - q.first) <= most_pairs)
    return tree_.near(p.first, p.last, q.first, q.last);
  const Index root = tree_of(a);
  return tree_.near(root, tree_of(b));
}

Index ToleranceWeld::tree_of(Index cell) {
  NearCell& own = cells_[at(cell)];
  if (own.tree == Mesh::none) own.tree = tree_.add(own.first, own.last);
  return own.tree;
}

}  // namespace

Vector<Index> weld_tolerance(const MeshInput& input, Memory& memory) {
  const double tolerance = input.weld_tolerance;
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "weld_tolerance must be a finite number above 0, in the unit of the positions");
  Vector<Index> representative(&memory);
  {
    const ProgressRange range(0, numbering_begins);
    representative = weld_exact(input, memory);
  }
  Poller poller;
  Vector<Index> vertex_of(&memory), place_of(input.vertex_count, &memory);  // of places, of vertices
  Vector<Vec3> places(&memory);
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    poller.due();
    if (representative[v] != static_cast<Index>(v)) {
      place_of[v] = place_of[at(representative[v])];
      continue;
    }
    place_of[v] = static_cast<Index>(places.size());
    vertex_of.push_back(static_cast<Index>(v));
    places.push_back({input.positions.get(v, 0), input.positions.get(v, 1), input.positions.get(v, 2)});
  }
  const Vector<Index> smallest = ToleranceWeld(tolerance, memory).run(places);
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) representative[v] = vertex_of[at(smallest[at(place_of[v])])];
  report(1);
  return representative;
}

}  // namespace hf_inner::mesh
