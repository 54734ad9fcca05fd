#include "factor/dissection.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/progress.h"
#include "base/stable_sort.h"
#include "factor/leaf_order.h"
#include "factor/minimum_degree.h"
#include "factor/multilevel.h"

namespace hf_inner::factor {
namespace {

// Parts of the graph up to this many vertices (leaves) are ordered by minimum degree. At half the value: the factor's
// size changes by -2 to +1 %, in more time. At twice the value: by +1 to +3 %, in less time.
constexpr std::int32_t leaf_size = 180;
// A leaf (small part of the graph) counts at most this many neighbours outside (its halo), which bounds its table of
// bits. Halving or doubling it gives the same order on the test meshes torus and scan.
constexpr std::int32_t halo_limit = 1500;
// A part of the graph up to this many vertices is ordered by one thread's job: smaller jobs balance the threads better
// but cost more. With twice the value, 2,000 to 3,000 vertices take 1.4 times as long on two threads; with half of it,
// the same time. No result depends on it.
constexpr std::int32_t task_size = 2000;
// Parts of the graph are cut in rounds (waves) until there are this many; then each becomes one thread's job. With half
// and twice the value, the ordering takes the same time within 5 %. No result depends on it.
constexpr std::size_t most_parts = 64;
// A part of the graph is not split but ordered whole if its separator would be a larger share of it. Halving or
// doubling it gives the same order on the test meshes torus and scan.
constexpr double most_separator = 0.75;
// Reported progress of one round of cuts, and of all rounds at most. The remaining parts share the rest, by the number
// of unknowns they order.
constexpr float progress_step = 0.05f, progress_cut = 0.4f;

// A part of the graph, with its own vertex numbers. Its vertices take the places [begin, begin + size) of the order.
struct Part {
  std::int32_t size = 0, begin = 0;
  Buffer<std::int32_t> storage;  // id, start and neighbour, one after the other
  Buffer<float> point;
  std::int32_t* id() noexcept { return storage.data(); }
  std::int32_t* start() noexcept { return storage.data() + size; }
  std::int32_t* neighbour() noexcept { return start() + size + 1; }
  const std::int32_t* id() const noexcept { return storage.data(); }
  void allocate(Memory& memory, std::int32_t vertices, std::size_t edges, bool points) {
    size = vertices;
    storage.allocate(memory, 2 * static_cast<std::size_t>(vertices) + 2 + edges);
    if (points) point.allocate(memory, 3 * static_cast<std::size_t>(vertices));
  }
  GraphView view() noexcept { return {size, start(), neighbour(), point.empty() ? nullptr : point.data(), nullptr}; }
};

// A range of places in the order, which a separator fills.
struct Range {
  std::int32_t begin, end;
};

// Scratch of one thread.
struct Workspace {
  Workspace(Memory& memory, std::int32_t unknowns)
      : bisection(memory),
        leaf(memory),
        side(&memory),
        number(&memory),
        halo(&memory),
        local_of(memory, static_cast<std::size_t>(unknowns)),
        found(&memory),
        separators(&memory) {
    std::fill(local_of.begin(), local_of.end(), -1);
  }
  MultilevelBisection bisection;
  LeafOrder leaf;
  Vector<std::uint8_t> side;
  Vector<std::int32_t> number, halo;
  Buffer<std::int32_t> local_of;  // by unknown: its number inside the leaf (part that is not cut), or -1
  Vector<std::int32_t> found;
  Vector<Range> separators;
};

class Dissection {
 public:
  Dissection(const SymmetricMatrix& matrix, Coordinates coordinates, Memory& memory, JobRunner& jobs,
             std::int32_t* order)
      : matrix_(matrix), coordinates_(coordinates), memory_(memory), jobs_(jobs), order_(order), free_(&memory) {}

  void run() {
    std::pmr::vector<Part> parts(&memory_);
    parts.push_back(whole());
    // At first there are few parts of the graph, so all are cut in a round (wave), each by one thread.
    bool cutting = true;
    float done = 0;
    while (cutting && parts.size() < most_parts) {
      report(done);
      done = std::min(progress_cut, done + progress_step);
      const std::size_t count = parts.size();
      std::pmr::vector<Part> next(2 * count, &memory_);
      cutting = false;
      for (const Part& part : parts) cutting |= part.size > task_size;
      if (!cutting) break;
      jobs_.for_each(static_cast<std::uint32_t>(count), [&](std::uint32_t k) {
        Part part = std::move(parts[k]);
        if (part.size <= task_size) {
          next[2 * k] = std::move(part);
          return;
        }
        with_workspace([&](Workspace& workspace) { split(std::move(part), workspace, next[2 * k], next[2 * k + 1]); });
      });
      parts.clear();
      for (Part& part : next) {
        if (part.size > 0) parts.push_back(std::move(part));
      }
    }
    // The largest parts of the graph come first. The order of the jobs only changes the waiting time.
    stable_sort(
        parts, [](const Part& a, const Part& b) { return a.size > b.size; }, memory_);
    cut_share_ = done;
    jobs_.for_each(static_cast<std::uint32_t>(parts.size()), [&](std::uint32_t k) {
      with_workspace([&](Workspace& workspace) { finish(std::move(parts[k]), workspace); });
    });
    sort_separators();
    report(1.0f);
  }

 private:
  Part whole() {
    const std::int32_t n = matrix_.size();
    Part part;
    part.allocate(memory_, n, matrix_.row.size() - static_cast<std::size_t>(n), !coordinates_.empty());
    std::int32_t k = 0;
    for (std::int32_t v = 0; v < n; ++v) {
      part.id()[v] = v;
      part.start()[v] = k;
      for (std::int32_t e = matrix_.column_start[v]; e < matrix_.column_start[v + 1]; ++e) {
        if (matrix_.row[e] != v) part.neighbour()[k++] = matrix_.row[e];
      }
    }
    part.start()[n] = k;
    if (!coordinates_.empty()) std::copy(coordinates_.begin(), coordinates_.end(), part.point.begin());
    return part;
  }

  // Cuts a part of the graph in two. It orders the part whole if it is small or cannot be cut. The separator takes the
  // last places of the order.
  void split(Part part, Workspace& workspace, Part& left, Part& right) {
    poll();
    if (part.size <= leaf_size) return order_leaf(part, workspace);
    workspace.side.resize(static_cast<std::size_t>(part.size));
    std::uint8_t* side = workspace.side.data();
    const Cut cut = workspace.bisection.run(part.view(), side);
    // A separator that takes most of the part is useless.
    if (!cut.usable() || cut.separator > most_separator * part.size) return order_whole(part);
    std::int32_t size[3] = {0, 0, 0};
    std::size_t edges[3] = {0, 0, 0};
    workspace.number.resize(static_cast<std::size_t>(part.size));
    for (std::int32_t v = 0; v < part.size; ++v) {
      workspace.number[v] = size[side[v]]++;
      edges[side[v]] += static_cast<std::size_t>(part.start()[v + 1] - part.start()[v]);
    }
    left.begin = part.begin;
    right.begin = part.begin + size[side_left];
    extract(part, workspace, side_left, size[side_left], edges[side_left], left);
    extract(part, workspace, side_right, size[side_right], edges[side_right], right);
    std::int32_t* last = order_ + part.begin + size[side_left] + size[side_right];
    for (std::int32_t v = 0; v < part.size; ++v) {
      if (side[v] == side_between) *last++ = part.id()[v];
    }
    workspace.separators.push_back({part.begin + size[side_left] + size[side_right], part.begin + part.size});
  }

  // Any order inside a separator gives a factor of the same size. Vertices next to the same parts of the graph are put
  // side by side, so that a part's rows in the separator are consecutive. The sort key is the first eliminated
  // neighbour.
  void sort_separators() {
    const std::int32_t n = matrix_.size();
    Buffer<std::int32_t> position(memory_, static_cast<std::size_t>(n));
    for (std::int32_t k = 0; k < n; ++k) position[order_[k]] = k;
    jobs_.for_each(static_cast<std::uint32_t>(free_.size()), [&](std::uint32_t w) {
      Vector<std::pair<std::int32_t, std::int32_t>> keyed(&memory_);
      for (const Range& range : free_[w]->separators) {
        keyed.clear();
        for (std::int32_t k = range.begin; k < range.end; ++k) {
          const std::int32_t v = order_[k];
          std::int32_t key = n;
          for (std::int32_t e = matrix_.column_start[v]; e < matrix_.column_start[v + 1]; ++e)
            key = std::min(key, position[matrix_.row[e]]);
          keyed.emplace_back(key, v);
        }
        std::sort(keyed.begin(), keyed.end());
        for (std::int32_t k = range.begin; k < range.end; ++k)
          order_[k] = keyed[static_cast<std::size_t>(k - range.begin)].second;
      }
    });
  }

  void extract(Part& part, const Workspace& workspace, std::uint8_t side, std::int32_t size, std::size_t edges,
               Part& out) {
    out.allocate(memory_, size, edges, !part.point.empty());
    const std::uint8_t* side_of = workspace.side.data();
    const std::int32_t* number = workspace.number.data();
    const std::int32_t *start = part.start(), *neighbour = part.neighbour(), *id = part.id();
    std::int32_t *out_start = out.start(), *out_neighbour = out.neighbour(), *out_id = out.id();
    const float* point = part.point.data();
    float* out_point = out.point.data();
    std::int32_t k = 0, v = 0;
    for (std::int32_t u = 0; u < part.size; ++u) {
      if (side_of[u] != side) continue;
      out_id[v] = id[u];
      out_start[v] = k;
      if (point)
        std::copy(point + 3 * static_cast<std::size_t>(u), point + 3 * static_cast<std::size_t>(u) + 3,
                  out_point + 3 * static_cast<std::size_t>(v));
      for (std::int32_t e = start[u]; e < start[u + 1]; ++e) {
        const std::int32_t w = neighbour[e];
        out_neighbour[k] = number[w];
        k += side_of[w] == side;
      }
      ++v;
    }
    out.start()[size] = k;
  }

  // Orders a part of the graph completely: cuts it, orders one half, then the other (depth first). The list of parts
  // that wait then stays short.
  void finish(Part first, Workspace& workspace) {
    std::pmr::vector<Part> waiting(&memory_);
    waiting.push_back(std::move(first));
    while (!waiting.empty()) {
      Part part = std::move(waiting.back());
      waiting.pop_back();
      Part left, right;
      const std::int32_t size = part.size;
      split(std::move(part), workspace, left, right);
      report_ordered(size - left.size - right.size);
      if (left.size > 0) waiting.push_back(std::move(left));
      if (right.size > 0) waiting.push_back(std::move(right));
    }
  }

  // Reports unknowns that have their place. Called by jobs.
  void report_ordered(std::int32_t count) {
    const float all = static_cast<float>(ordered_.fetch_add(count, std::memory_order_relaxed) + count);
    report(cut_share_ + (1 - cut_share_) * all / static_cast<float>(matrix_.size()));
  }

  void order_leaf(const Part& part, Workspace& workspace) {
    const std::int32_t n = part.size;
    for (std::int32_t v = 0; v < n; ++v) workspace.local_of[part.id()[v]] = v;
    workspace.halo.clear();
    for (std::int32_t v = 0; v < n; ++v) {
      const std::int32_t unknown = part.id()[v];
      for (std::int32_t e = matrix_.column_start[unknown]; e < matrix_.column_start[unknown + 1]; ++e) {
        const std::int32_t u = matrix_.row[e];
        if (workspace.local_of[u] >= 0 || static_cast<std::int32_t>(workspace.halo.size()) >= halo_limit) continue;
        workspace.local_of[u] = n + static_cast<std::int32_t>(workspace.halo.size());
        workspace.halo.push_back(u);
      }
    }
    workspace.leaf.reset(n, static_cast<std::int32_t>(workspace.halo.size()));
    for (std::int32_t v = 0; v < n; ++v) {
      const std::int32_t unknown = part.id()[v];
      for (std::int32_t e = matrix_.column_start[unknown]; e < matrix_.column_start[unknown + 1]; ++e) {
        const std::int32_t u = workspace.local_of[matrix_.row[e]];
        if (u >= 0 && u != v) workspace.leaf.add_edge(v, u);
      }
    }
    for (std::int32_t v = 0; v < n; ++v) workspace.local_of[part.id()[v]] = -1;
    for (const std::int32_t u : workspace.halo) workspace.local_of[u] = -1;
    workspace.found.resize(static_cast<std::size_t>(n));
    workspace.leaf.run(workspace.found.data());
    for (std::int32_t k = 0; k < n; ++k) order_[part.begin + k] = part.id()[workspace.found[k]];
  }

  void order_whole(Part& part) {
    Buffer<std::int32_t> local;
    order_graph_by_minimum_degree(part.size, part.start(), part.neighbour(), memory_, local);
    for (std::int32_t k = 0; k < part.size; ++k) order_[part.begin + k] = part.id()[local[k]];
  }

  template <class Work>
  void with_workspace(Work&& work) {
    std::shared_ptr<Workspace> workspace;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      if (!free_.empty()) {
        workspace = free_.back();
        free_.pop_back();
      } else
        free_.reserve(++made_);
    }
    if (!workspace) workspace = make_shared_in<Workspace>(memory_, memory_, matrix_.size());
    work(*workspace);
    std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(workspace));
  }

  const SymmetricMatrix& matrix_;
  Coordinates coordinates_;
  Memory& memory_;
  JobRunner& jobs_;
  std::int32_t* order_;
  std::mutex mutex_;
  Vector<std::shared_ptr<Workspace>> free_;
  std::size_t made_ = 0;
  float cut_share_ = 0;                   // of progress, when the waves end
  std::atomic<std::int32_t> ordered_{0};  // unknowns of the parts since then
};

}  // namespace

void order_by_dissection(const SymmetricMatrix& matrix, Coordinates coordinates, Memory& memory, JobRunner& jobs,
                         Buffer<std::int32_t>& order) {
  order.allocate(memory, static_cast<std::size_t>(matrix.size()));
  if (matrix.size() == 0) return;
  Dissection(matrix, coordinates, memory, jobs, order.data()).run();
}

}  // namespace hf_inner::factor
