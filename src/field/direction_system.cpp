// See direction_solver.h.
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/timer.h"
#include "factor/ordering.h"
#include "field/direction_columns.h"
#include "field/direction_solver.h"

namespace hf_inner {
namespace {

// Edges of the mesh that the surface's operator does not have.
std::size_t missing_edges(const Core& core) {
  const SymmetricMatrix& k = core.laplacian;
  std::size_t missing = 0;
  for (std::size_t v = 0; v < at(core.size()); ++v) {
    Index i = k.column_start[v];
    for (Index j = core.topology.neighbour_start[v]; j < core.topology.neighbour_start[v + 1]; ++j) {
      while (i < k.column_start[v + 1] && k.row[at(i)] < core.topology.neighbour[at(j)]) ++i;
      missing += i == k.column_start[v + 1] || k.row[at(i)] != core.topology.neighbour[at(j)];
    }
  }
  return missing / 2;
}

}  // namespace

DirectionSystem::DirectionSystem(std::shared_ptr<const Core> given, std::int32_t n)
    : core(std::move(given)),
      degree(n),
      connection(Connection::make(core->mesh, core->topology, *core->memory)),
      position(core->memory.get()),
      matrix(*core->memory),
      beta(core->memory.get()),
      ground_groups(core->memory.get()),
      ground_group(core->memory.get()),
      ground_column(core->memory.get()),
      ground_block(core->memory.get()) {
  Timer timer;
  make_order();
  make_matrix();
  operator_ms = timer.milliseconds();
  make_grounds();
}

// A few edges across the separators cost little; many, and the factor fills (two hundred times the work on a jittered
// torus of 120,000 vertices).
void DirectionSystem::make_order() {
  const Span<const Index> own = core->factor->position();
  position.assign(own.begin(), own.end());
  if (10000 * missing_edges(*core) <= at(core->topology.edge_count())) return;
  const SymmetricMatrix graph = laplacian(core->topology, core->weights, *core->memory, core->jobs.get());
  const Vector<float> coordinates = ordering_coordinates(core->mesh, *core->memory);
  Buffer<Index> order;
  hf_inner::make_order(graph, {coordinates.data(), coordinates.size()}, core->ordering, *core->memory, *core->jobs, nullptr,
                 order);
  for (Index k = 0; k < core->size(); ++k) position[at(order[k])] = k;
}

// Row and column pairs of the real 2 x 2 blocks: w I on the diagonal, -w R between neighbours, R the turn from column
// to row.
void DirectionSystem::make_matrix() {
  const Topology& topology = core->topology;
  const std::size_t n = at(core->size());
  const Vector<double> weights =
      edge_weights(core->mesh, topology, OperatorKind::clamped, *core->memory, core->jobs.get());
  Vector<Index> order(n, core->memory.get());
  for (std::size_t v = 0; v < n; ++v) order[at(position[v])] = static_cast<Index>(v);
  matrix.column_start.resize(2 * n + 1);
  matrix.column_start[0] = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const std::size_t v = at(order[p]);
    const Index length = 2 * (topology.neighbour_start[v + 1] - topology.neighbour_start[v] + 1);
    for (std::size_t part = 0; part < 2; ++part)
      matrix.column_start[2 * p + part + 1] = matrix.column_start[2 * p + part] + length;
  }
  matrix.row.resize(at(matrix.column_start[2 * n])), matrix.value.resize(matrix.row.size());
  constexpr std::size_t piece = 8192;
  core->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t strip) {
    struct Neighbour {
      Index position, vertex, edge;
    };
    Vector<Neighbour> ring(&*core->memory);
    for (std::size_t p = strip * piece; p < std::min(n, (strip + std::size_t{1}) * piece); ++p) {
      const Index v = order[p];
      ring.assign(1, Neighbour{static_cast<Index>(p), v, -1});
      double sum = 0;
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)], e = topology.neighbour_edge[at(i)];
        ring.push_back({position[at(w)], w, e}), sum += weights[at(e)];
      }
      std::sort(ring.begin(), ring.end(),
                [](const Neighbour& a, const Neighbour& b) { return a.position < b.position; });
      Index to[2] = {matrix.column_start[2 * p], matrix.column_start[2 * p + 1]};
      for (const Neighbour& other : ring) {
        double block[2][2] = {{sum, 0}, {0, sum}};  // [row part][column part]
        if (other.edge >= 0) {
          const double w = weights[at(other.edge)], turn = degree * connection.turn(topology, other.edge, other.vertex);
          block[0][0] = block[1][1] = -w * std::cos(turn);
          block[1][0] = -w * std::sin(turn), block[0][1] = w * std::sin(turn);
        }
        for (std::size_t column = 0; column < 2; ++column) {
          for (std::size_t row = 0; row < 2; ++row) {
            matrix.row[at(to[column])] = 2 * other.position + static_cast<Index>(row);
            matrix.value[at(to[column]++)] = block[row][column];
          }
        }
      }
    }
  });
}

// Grounds, the factor of A, and the grounds' own paths with C.
void DirectionSystem::make_grounds() {
  const std::size_t components = core->ground.size();
  beta.assign(components, 0.0);
  Vector<double> count(components, 0.0, &*core->memory);
  const auto diagonal = [&](const SymmetricMatrix& a, Index u) {
    const auto begin = a.row.begin() + a.column_start[at(u)], end = a.row.begin() + a.column_start[at(u) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, u) - a.row.begin());
  };
  for (Index v = 0; v < core->size(); ++v)
    beta[at(core->mesh.component[at(v)])] += matrix.value[diagonal(matrix, unknown(v, 0))],
        count[at(core->mesh.component[at(v)])] += 1;
  SymmetricMatrix a(*core->memory);
  a.column_start.assign(matrix.column_start.begin(), matrix.column_start.end());
  a.row.assign(matrix.row.begin(), matrix.row.end()), a.value.assign(matrix.value.begin(), matrix.value.end());
  UnitColumns columns(*core->memory);
  for (std::size_t c = 0; c < components; ++c) {
    beta[c] = beta[c] > 0 ? beta[c] / count[c] : 1.0;
    for (Index part = 0; part < 2; ++part) {
      a.value[diagonal(a, unknown(core->ground[c], part))] += beta[c];
      columns.append(unknown(core->ground[c], part));
    }
  }
  FactorOptions options;
  options.ordering = Ordering::natural;  // the unknowns stand in the order of the surface's factor
  factor = Factor::make(a, {}, options, *core->memory, *core->jobs);
  ground_group.resize(2 * components), ground_column.resize(2 * components);
  factor->solve_paths(columns.view(), *core->memory, *core->jobs, ground_groups, ground_group, ground_column);
  ground_block.assign(4 * components, 0.0);
  double tile[PathGroup::capacity * PathGroup::capacity];
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const PathGroup &p = *ground_groups[at(ground_group[2 * c + i])],
                        &q = *ground_groups[at(ground_group[2 * c + j])];
        factor->gram(p, q, tile, PathGroup::capacity);
        ground_block[4 * c + 2 * i + j] =
            tile[ground_column[2 * c + i] * PathGroup::capacity + ground_column[2 * c + j]] -
            (i == j ? 1 / beta[c] : 0.0);
      }
    }
  }
}

}  // namespace hf_inner
