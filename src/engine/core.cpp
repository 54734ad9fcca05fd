#include "engine/core.h"

#include <algorithm>
#include <cmath>

#include "base/timer.h"

namespace hf {

Buffer<double> WorkspacePool::take(std::size_t size) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto it = free_.begin(); it != free_.end(); ++it) {
      if (it->size() < size) continue;
      Buffer<double> found = std::move(*it);
      free_.erase(it);
      return found;
    }
  }
  Buffer<double> fresh(memory_, size);
  if (zeroed_) std::fill(fresh.begin(), fresh.end(), 0.0);
  return fresh;
}

void WorkspacePool::give(Buffer<double>&& buffer) noexcept {
  try {
    const std::lock_guard<std::mutex> lock(mutex_);
    constexpr std::size_t most = 8;  // more callers at once than this allocate their own
    if (free_.size() < most) {
      free_.push_back(std::move(buffer));
      return;
    }
    // keep the larger ones
    const auto smallest =
        std::min_element(free_.begin(), free_.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (smallest->size() < buffer.size()) *smallest = std::move(buffer);
  } catch (...) {
    // no room to remember it: the buffer is released by its owner
  }
}

Core::Core(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner)
    : memory(std::move(owner)),
      jobs(std::move(runner)),
      mesh(*memory),
      topology(*memory),
      weights(memory.get()),
      laplacian(*memory),
      ground(memory.get()),
      mean_diagonal(memory.get()),
      workspaces(*memory),
      zeroed_workspaces(*memory, true) {}

namespace {

// Mean diagonal and ground vertex of every component.
void find_grounds(Core& core) {
  const std::size_t components = static_cast<std::size_t>(core.mesh.component_count());
  core.ground.assign(components, Mesh::none);
  core.mean_diagonal.assign(components, 0.0);
  Vector<double> count(components, 0.0, core.memory.get());
  const SymmetricMatrix& k = core.laplacian;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    const std::size_t c = static_cast<std::size_t>(core.mesh.component[static_cast<std::size_t>(v)]);
    if (core.ground[c] == Mesh::none) core.ground[c] = v;
    const auto begin = k.row.begin() + k.column_start[static_cast<std::size_t>(v)],
               end = k.row.begin() + k.column_start[static_cast<std::size_t>(v) + 1];
    core.mean_diagonal[c] +=
        std::fabs(k.value[static_cast<std::size_t>(std::lower_bound(begin, end, v) - k.row.begin())]);
    count[c] += 1;
  }
  for (std::size_t c = 0; c < components; ++c) {
    core.mean_diagonal[c] /= count[c];
    if (!(core.mean_diagonal[c] > 0)) core.mean_diagonal[c] = 1;
  }
}

}  // namespace

std::shared_ptr<const Core> Core::make(const MeshInput& input, const CoreOptions& options,
                                       std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs) {
  Memory& pool = *memory;
  std::shared_ptr<Core> core = make_owner_in<Core>(memory, memory, std::move(jobs));
  report(options.progress, 0.0f);
  Timer weld_timer;
  core->mesh = Mesh::make(input, pool);
  core->times.weld_ms = weld_timer.milliseconds();
  report(options.progress, 0.1f);

  Timer operator_timer;
  core->topology = Topology::make(core->mesh, pool);
  core->weights = edge_weights(core->mesh, core->topology, OperatorKind::cotangent, pool);
  MeshReport& found = core->mesh.report;
  found.negative_edge_count = count_negative(core->weights);
  if (options.operator_kind != OperatorKind::cotangent)
    core->weights = edge_weights(core->mesh, core->topology, options.operator_kind, pool);
  count_edges(core->mesh, core->topology, found);
  core->laplacian = hf::laplacian(core->topology, core->weights, pool);
  find_grounds(*core);
  core->ordering = options.ordering;
  core->times.operator_ms = operator_timer.milliseconds();
  report(options.progress, 0.2f);

  if (options.need_factor) {
    const Vector<float> coordinates = ordering_coordinates(core->mesh, pool);
    FactorOptions factor_options;
    factor_options.ordering = options.ordering;
    core->factor = Factor::make(grounded(*core), coordinates, factor_options, pool, *core->jobs);
  }
  report(options.progress, 1.0f);
  return core;
}

SymmetricMatrix grounded(const Core& core) {
  SymmetricMatrix a(*core.memory);
  a.column_start.assign(core.laplacian.column_start.begin(), core.laplacian.column_start.end());
  a.row.assign(core.laplacian.row.begin(), core.laplacian.row.end());
  a.value.assign(core.laplacian.value.begin(), core.laplacian.value.end());
  for (std::size_t c = 0; c < core.ground.size(); ++c) {
    const std::int32_t g = core.ground[c];
    const auto begin = a.row.begin() + a.column_start[static_cast<std::size_t>(g)],
               end = a.row.begin() + a.column_start[static_cast<std::size_t>(g) + 1];
    a.value[static_cast<std::size_t>(std::lower_bound(begin, end, g) - a.row.begin())] += core.mean_diagonal[c];
  }
  return a;
}

Vector<float> ordering_coordinates(const Mesh& mesh, Memory& memory) {
  Vector<float> coordinates(&memory);
  coordinates.reserve(3 * mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    coordinates.push_back(static_cast<float>(p.x));
    coordinates.push_back(static_cast<float>(p.y));
    coordinates.push_back(static_cast<float>(p.z));
  }
  return coordinates;
}

}  // namespace hf
