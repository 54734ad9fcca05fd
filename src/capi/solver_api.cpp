// hf/mesh.h: creating and looking at solvers.
#include <algorithm>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "factor/factor_bytes.h"
#include "hf/field.h"

namespace hf_inner::capi {
namespace {

// A std allocator straight on the host's hooks, for the Memory object itself.
template <class T>
struct HookAllocator {
  using value_type = T;
  explicit HookAllocator(const hf_allocator& given) noexcept : hooks(given) {}
  template <class U>
  HookAllocator(const HookAllocator<U>& other) noexcept : hooks(other.hooks) {}
  T* allocate(std::size_t count) {
    void* block = hooks.allocate ? hooks.allocate(hooks.user, count * sizeof(T), alignof(T))
                                 : ::operator new(count * sizeof(T), std::nothrow);
    if (!block) throw std::bad_alloc();
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t count) noexcept {
    if (hooks.allocate) {
      hooks.release(hooks.user, block, count * sizeof(T), alignof(T));
    } else {
      ::operator delete(block);
    }
  }
  template <class U>
  bool operator==(const HookAllocator<U>& other) const noexcept {
    return hooks.allocate == other.hooks.allocate && hooks.user == other.hooks.user;
  }
  template <class U>
  bool operator!=(const HookAllocator<U>& other) const noexcept {
    return !(*this == other);
  }
  hf_allocator hooks;
};

struct Options {
  CoreOptions core;
  EngineKind engine;
  std::uint32_t channels, threads, site_limit;
  double penalty;
};

Options read_options(const hf_create_desc& desc) {
  Options options;
  check_choice(desc.weld, 3, "weld");
  check_choice(desc.operator_kind, 4, "operator_kind");
  check_choice(desc.field_kind, 3, "field_kind");
  check_choice(desc.engine, 3, "engine");
  check_choice(desc.ordering, 3, "ordering");
#ifndef HF_WITH_GPL
  if (desc.engine == HF_ENGINE_UPDOWN)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "HF_ENGINE_UPDOWN needs a build with HF_WITH_GPL; use HF_ENGINE_GREEN, which gives the same field");
  if (desc.ordering == HF_ORDERING_METIS)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "HF_ORDERING_METIS needs a build with HF_WITH_GPL; use HF_ORDERING_NESTED_DISSECTION");
#endif
  if ((desc.allocator.allocate == nullptr) != (desc.allocator.release == nullptr))
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "allocator: set both allocate and release, or neither");
  options.core.operator_kind = static_cast<OperatorKind>(desc.operator_kind);
  options.core.field_kind = static_cast<FieldKind>(desc.field_kind);
  options.core.ordering = desc.ordering == HF_ORDERING_METIS            ? Ordering::metis
                          : desc.ordering == HF_ORDERING_MINIMUM_DEGREE ? Ordering::minimum_degree
                                                                        : Ordering::nested_dissection;
  options.engine = static_cast<EngineKind>(desc.engine);
  options.channels = count_of(desc.channel_count, 1, 1, 64, "channel_count");
  options.threads = count_of(desc.thread_count, 1, 1, 256, "thread_count");
  options.site_limit = desc.site_limit ? desc.site_limit : 100000;
  if (desc.penalty != 0 && !(desc.penalty > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "penalty is %g; it must be above 0, or 0 for 1e8", desc.penalty);
  options.penalty = desc.penalty > 0 ? std::min(desc.penalty, 1e10) : 1e8;
  return options;
}

// 0 is eight triangles per vertex of the vertex limit: dirty meshes have more than a surface needs, none has that many.
void check_triangle_count(std::uint32_t count, std::uint32_t limit, std::uint32_t vertex_limit) {
  if (limit != 0 && count > limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u triangles; the triangle_limit is %u", count, limit);
  if (limit == 0 && count / 8 > vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "%u triangles; without a triangle_limit at most eight per vertex of the vertex_limit %u are taken", count,
         vertex_limit);
}

void read_saved_factor(const hf_create_desc& desc, CoreOptions& options) {
  const hf_factor_desc saved = read_struct(desc.saved_factor, "saved_factor");
  require(saved.bytes, "saved_factor->bytes");
  if (saved.byte_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "saved_factor->byte_count is 0");
  options.saved_factor = {static_cast<const std::uint8_t*>(saved.bytes), saved.byte_count};
  options.borrow_factor = saved.borrow != 0;
  const Ordering ordering = check_saved_factor(options.saved_factor);
  if (desc.ordering != 0 && options.ordering != ordering)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "ordering is %d, but the saved factor has ordering %d; set it to 0 to take the factor's", desc.ordering,
         static_cast<int>(ordering));
}

void count_given(SolverObject& solver) {
  const Mesh& mesh = solver.field.core().mesh;
  solver.given_count.assign(mesh.report.component_count, 0);
  for (const std::int32_t v : mesh.inner_of_given) {
    if (v != Mesh::none) ++solver.given_count[static_cast<std::size_t>(mesh.component[static_cast<std::size_t>(v)])];
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_create(const hf_create_desc* given, hf_solver* out_solver) {
  return guarded("hf_create", [&] {
    require(out_solver, "out_solver");
    *out_solver = nullptr;
    const hf_create_desc desc = read_struct(given, "desc");
    Options options = read_options(desc);
    if (desc.vertex_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "vertex_count is 0");
    if (desc.triangle_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "triangle_count is 0");
    if (desc.positions && desc.positions_f64)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "positions and positions_f64 are both set; set one");
    if (!desc.positions && !desc.positions_f64)
      fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "positions and positions_f64 are both NULL");
    require(desc.triangles, "triangles");
    const std::uint32_t limit = desc.vertex_limit ? desc.vertex_limit : 20000000;
    if (desc.vertex_count > limit)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices; the vertex_limit is %u", desc.vertex_count, limit);
    check_triangle_count(desc.triangle_count, desc.triangle_limit, limit);

    MeshInput input;
    input.vertex_count = desc.vertex_count, input.triangle_count = desc.triangle_count;
    input.positions = rows_of(desc.positions, desc.positions_f64, desc.position_stride, "position_stride");
    input.triangles = desc.triangles;
    input.weld = static_cast<Weld>(desc.weld);
    input.weld_tolerance = static_cast<double>(desc.weld_tolerance);

    std::shared_ptr<ProgressObject> progress;
    if (desc.saved_factor) read_saved_factor(desc, options.core);
    if (desc.progress) progress = get<ProgressObject>(desc.progress, Kind::progress, "progress");
    options.core.progress = progress ? &progress->progress : nullptr;

    auto memory = std::allocate_shared<Memory>(HookAllocator<Memory>(desc.allocator), desc.allocator,
                                               std::uint64_t{desc.memory_limit_mb} << 20);
    Memory& pool = *memory;
    auto jobs = make_shared_in<JobRunner>(pool, options.threads, desc.job_runner);
    std::shared_ptr<const Core> core;
    try {
      core = Core::make(input, options.core, memory, std::move(jobs));
    } catch (const Error& error) {
      if (error.code() == HF_ERROR_CANCELLED && progress) progress->progress.reset();  // one cancel stops one call
      throw;
    }
    const auto solver = make_owner_in<SolverObject>(memory, std::move(core), options.engine, options.penalty,
                                                    static_cast<std::int32_t>(options.channels), options.site_limit);
    count_given(*solver);
    *out_solver = reinterpret_cast<hf_solver>(insert(solver));
  });
}

hf_result hf_clone(hf_solver handle, hf_solver* out_solver) {
  return guarded("hf_clone", [&] {
    require(out_solver, "out_solver");
    *out_solver = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const Reading reading(*solver);
    *out_solver = reinterpret_cast<hf_solver>(insert(make_owner_in<SolverObject>(solver->memory, *solver)));
  });
}

void hf_destroy(hf_solver solver) {
  const FloatEnvironment environment;
  remove(reinterpret_cast<std::uintptr_t>(solver), Kind::solver);
}

hf_result hf_get_mesh_report(hf_solver handle, hf_mesh_report* out_report) {
  return guarded("hf_get_mesh_report", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    check_struct(out_report, "out_report");
    const MeshReport& found = solver->field.core().mesh.report;
    hf_mesh_report report{};
    report.vertex_count = found.vertex_count;
    report.triangle_count = found.triangle_count;
    report.welded_vertex_count = found.welded_vertex_count;
    report.component_count = found.component_count;
    report.isolated_vertex_count = found.isolated_vertex_count;
    report.degenerate_triangle_count = found.degenerate_triangle_count;
    report.collapsed_triangle_count = found.collapsed_triangle_count;
    report.duplicate_triangle_count = found.duplicate_triangle_count;
    report.non_manifold_edge_count = found.non_manifold_edge_count;
    report.flipped_edge_count = found.flipped_edge_count;
    report.boundary_edge_count = found.boundary_edge_count;
    report.negative_edge_count = found.negative_edge_count;
    report.smallest_angle = static_cast<float>(found.smallest_angle);
    report.bounding_box_diagonal = found.bounding_box_diagonal;
    write_struct(out_report, report);
  });
}

hf_result hf_get_components(hf_solver handle, uint32_t vertex_count, uint32_t* out_components) {
  return guarded("hf_get_components", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    require(out_components, "out_components");
    const Mesh& mesh = solver->field.core().mesh;
    if (vertex_count != mesh.report.vertex_count)
      fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "vertex_count is %u; the mesh has %u vertices", vertex_count,
           mesh.report.vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      const std::int32_t inner = mesh.inner_of_given[v];
      out_components[v] = inner == Mesh::none
                              ? HF_NO_INDEX
                              : static_cast<std::uint32_t>(mesh.component[static_cast<std::size_t>(inner)]);
    }
  });
}

hf_result hf_get_statistics(hf_solver handle, hf_statistics* out_statistics) {
  return guarded("hf_get_statistics", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*solver);
    const Core& core = solver->field.core();
    const FactorStatistics& factor = core.factor->statistics();
    const EngineCounters counters = solver->field.engine().counters();
    hf_statistics statistics{};
    statistics.unknown_count = static_cast<std::uint32_t>(core.size());
    statistics.weld_ms = core.times.weld_ms;
    statistics.operator_ms = core.times.operator_ms;
    statistics.ordering_ms = factor.ordering_ms;
    statistics.symbolic_ms = factor.symbolic_ms;
    statistics.numeric_ms = factor.numeric_ms;
    statistics.factor_entries = factor.entries;
    statistics.factor_bytes = factor.bytes;
    statistics.factor_flops = factor.flops;
    statistics.memory_bytes = static_cast<double>(solver->memory->live_bytes());
    statistics.peak_memory_bytes = static_cast<double>(solver->memory->peak_bytes());
    statistics.site_memory_bytes = counters.bytes;
    statistics.site_count = solver->field.sites().count();
    statistics.factorisation_count = counters.factorisations;
    statistics.path_solve_count = counters.path_solves;
    statistics.sweep_count = counters.sweeps;
    statistics.engine = static_cast<std::uint32_t>(solver->field.engine().kind());
    statistics.thread_count = core.jobs->thread_count();
    statistics.last_route = static_cast<std::uint32_t>(counters.last_route);
    statistics.rebase_count = counters.rebases, statistics.dense_edit_count = counters.dense_edits;
    statistics.dense_row_count = counters.dense_rows, statistics.eliminated_count = counters.eliminated;
    statistics.rebase_advised = counters.rebase_advised;
    statistics.predicted_dense_ms = counters.dense_ms, statistics.predicted_rebase_ms = counters.rebase_ms;
    statistics.load_ms = factor.load_ms, statistics.factor_loaded = factor.loaded,
    statistics.factor_borrowed = factor.borrowed;
    // the engines count the factor of hf_create as made
    if (factor.loaded && statistics.factorisation_count > 0 && solver->field.engine().kind() == EngineKind::green)
      --statistics.factorisation_count;
    write_struct(out_statistics, statistics);
  });
}

}  // extern "C"
