// Gives coordinates to components without a region: the coordinates of the surface beside them (see pair_fields.h).
//
// A uniform grid with about two vertices per cell finds the nearest vertex of a component that has a region. The other
// vertices relax by Gauss-Seidel steps on the clamped Laplacian of their component, in vertex order. The result
// therefore depends only on the mesh. The time is linear in the vertices of these components times the sweeps.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/pair_fields.h"

namespace hf_inner::transfer {
namespace {

// The points sorted into the cells of a uniform grid. The grid spans their bounding box.
class PointGrid {
 public:
  PointGrid(const surface::Core& core, Span<const std::uint8_t> reached)
      : positions_(core.mesh.positions), start_(core.memory.get()), points_(core.memory.get()) {
    std::size_t count = 0;
    Vec3 low{no_height, no_height, no_height}, high = -1.0 * low;
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (!reached[at(core.mesh.component[v])]) continue;
      const Vec3 p = positions_[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      ++count;
    }
    low_ = low;
    // The cube root of the number of points per cell, by whole numbers.
    const double cells = static_cast<double>(count) / points_per_cell;
    const auto cube = [](double x) { return x * x * x; };
    for (cells_ = 1; cells_ < most_cells && cube(cells_ + 1) <= cells;) ++cells_;
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, least_extent});
    cell_size_ = extent / cells_;
    start_.assign(at(cells_ * cells_ * cells_) + 1, 0);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (reached[at(core.mesh.component[v])]) ++start_[cell_of(positions_[v]) + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    points_.resize(count);
    Vector<std::int32_t> next(start_, core.memory.get());
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (reached[at(core.mesh.component[v])])
        points_[at(next[cell_of(positions_[v])]++)] = static_cast<std::int32_t>(v);
    }
  }

  // Returns the nearest point, the one with the smallest number among equals. best: its squared distance.
  std::int32_t nearest(Vec3 p, double& best) const {
    std::int32_t found = -1;
    best = std::numeric_limits<double>::infinity();
    const std::int32_t cx = cell(p.x - low_.x), cy = cell(p.y - low_.y), cz = cell(p.z - low_.z);
    for (std::int32_t shell = 0; shell <= cells_; ++shell) {
      // All cells outside the shells of cells searched so far are at least `safe` away.
      if (found >= 0) {
        const double safe = (shell - 1) * cell_size_;
        if (safe > 0 && best <= safe * safe) break;
      }
      for (std::int32_t z = cz - shell; z <= cz + shell; ++z) {
        for (std::int32_t y = cy - shell; y <= cy + shell; ++y) {
          for (std::int32_t x = cx - shell; x <= cx + shell; ++x) {
            const bool on_shell = std::abs(x - cx) == shell || std::abs(y - cy) == shell || std::abs(z - cz) == shell;
            if (on_shell && inside(x) && inside(y) && inside(z)) search(index(x, y, z), p, found, best);
          }
        }
      }
    }
    return found;
  }

 private:
  bool inside(std::int32_t i) const noexcept { return i >= 0 && i < cells_; }
  std::int32_t cell(double offset) const noexcept {
    return static_cast<std::int32_t>(std::clamp(offset / cell_size_, 0.0, cells_ - 1.0));
  }
  std::size_t index(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
    return at((z * cells_ + y) * cells_ + x);
  }
  std::size_t cell_of(Vec3 p) const noexcept {
    return index(cell(p.x - low_.x), cell(p.y - low_.y), cell(p.z - low_.z));
  }
  void search(std::size_t c, Vec3 p, std::int32_t& found, double& best) const {
    for (std::int32_t i = start_[c]; i < start_[c + 1]; ++i) {
      const std::int32_t v = points_[at(i)];
      const Vec3 d = positions_[at(v)] - p;
      const double distance = dot(d, d);
      if (distance < best || (distance == best && v < found)) {
        best = distance;
        found = v;
      }
    }
  }

  const SharedVector<Vec3>& positions_;
  Vec3 low_;
  double cell_size_ = 1;
  std::int32_t cells_ = 1;
  Vector<std::int32_t> start_, points_;
};

struct Member {
  std::int32_t vertex = 0, host = 0;
  double distance = 0;
};

void relax(const surface::Core& core, Span<const Member> free, std::int32_t channels, double* field) {
  const auto& topology = core.topology();
  const std::size_t width = at(channels);
  Vector<double> mean(width, 0.0, core.memory.get());
  double floor = 0;
  for (const double w : core.weights()) floor += std::abs(w);
  floor = least_weight_share * floor / static_cast<double>(std::max<std::size_t>(1, core.weights().size()));
  for (std::int32_t sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (const Member& member : free) {
      std::fill(mean.begin(), mean.end(), 0.0);
      double sum = 0;
      for (std::int32_t e = topology.neighbour_start[at(member.vertex)];
           e < topology.neighbour_start[at(member.vertex) + 1]; ++e) {
        const double w = std::max(floor, core.weights()[at(topology.neighbour_edge[at(e)])]);
        const double* row = field + at(topology.neighbour[at(e)]) * width;
        for (std::size_t j = 0; j < width; ++j) mean[j] += w * row[j];
        sum += w;
      }
      double* row = field + at(member.vertex) * width;
      for (std::size_t j = 0; j < width; ++j) {
        const double value = mean[j] / sum;
        change = std::max(change, std::abs(value - row[j]));
        row[j] = value;
      }
    }
    if (change < still_enough) break;
  }
}

}  // namespace

void attach_islands(const surface::Core& core, Span<const std::uint8_t> reached, std::int32_t channels, double* field) {
  Memory& memory = *core.memory;
  const std::size_t width = at(channels);
  const PointGrid grid(core, reached);
  Vector<Vector<Member>> islands(reached.size(), &memory);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    const std::int32_t component = core.mesh.component[at(v)];
    if (reached[at(component)]) continue;
    Member member;
    member.vertex = v;
    member.host = grid.nearest(core.mesh.positions[at(v)], member.distance);
    islands[at(component)].push_back(member);
  }
  Vector<double> mean(width, 0.0, &memory);
  for (auto& members : islands) {
    if (members.empty()) continue;
    std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.vertex < b.vertex;
    });
    const std::size_t held = std::min(members.size(), std::max(least_held, members.size() / held_divisor));
    Vec3 low{no_height, no_height, no_height}, high = -1.0 * low;
    std::fill(mean.begin(), mean.end(), 0.0);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Vec3 p = core.mesh.positions[at(members[i].vertex)];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      if (i >= held) continue;
      for (std::size_t j = 0; j < width; ++j)
        mean[j] += field[at(members[i].host) * width + j] / static_cast<double>(held);
    }
    // All vertices of a small component get the mean field values of the surface beside it. In a larger one, vertices
    // that do not keep such values start from the mean.
    const bool rigid = norm(high - low) < rigid_island;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const double* from = !rigid && i < held ? field + at(members[i].host) * width : mean.data();
      std::copy(from, from + width, field + at(members[i].vertex) * width);
    }
    if (!rigid) relax(core, {members.data() + held, members.size() - held}, channels, field);
  }
}

}  // namespace hf_inner::transfer
