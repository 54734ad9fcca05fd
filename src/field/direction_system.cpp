#include "field/direction_system.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/progress.h"
#include "base/timer.h"
#include "factor/ordering.h"

namespace hf_inner::field {
namespace {

// If the surface's operator lacks more than this share of the mesh edges, the mesh gets an ordering of its own. A few
// missing edges cost little. Many fill the factor: on a jittered torus of 120,000 vertices the work grew two hundred
// times.
constexpr double missing_share = 1e-4;
// Vertices of one thread's job. Half and double take the same time within 2 % (torus of 102,400 vertices, two threads).
constexpr std::size_t piece = 8192;
// Reported progress after the connection, and after an order of the system's own, which is seldom needed.
constexpr float progress_connection = 0.05f, progress_ordered_directions = 0.3f;

// Returns the number of mesh edges that the surface's operator does not have.
double missing_edges(const surface::Core& core) {
  const SymmetricMatrix& k = core.matrix();
  std::size_t missing = 0;
  for (std::size_t v = 0; v < at(core.size()); ++v) {
    Index i = k.column_start[v];
    for (Index j = core.topology().neighbour_start[v]; j < core.topology().neighbour_start[v + 1]; ++j) {
      while (i < k.column_start[v + 1] && k.row[at(i)] < core.topology().neighbour[at(j)]) ++i;
      missing += i == k.column_start[v + 1] || k.row[at(i)] != core.topology().neighbour[at(j)];
    }
  }
  return static_cast<double>(missing / 2);
}

}  // namespace

DirectionMatrix::DirectionMatrix(std::shared_ptr<const surface::Core> given, Index n)
    : core(std::move(given)),
      degree(n),
      connection(Connection::make(core->mesh, core->topology(), *core->memory)),
      position(core->memory.get()),
      order(core->size(), core->memory.get()),
      matrix(*core->memory) {
  Timer timer;
  report(progress_connection);
  {
    const ProgressRange range(progress_connection, progress_ordered_directions);
    make_order();
  }
  make_matrix();
  operator_ms = timer.milliseconds();
}

std::shared_ptr<const factor::Factor> DirectionMatrix::factorise(const SymmetricMatrix& like) const {
  const ProgressRange range(progress_ordered_directions, 1.0f);
  factor::FactorOptions options;
  options.ordering = factor::Ordering::natural;  // the unknowns stand in the order of the surface's factor
  options.flop_limit = core->flop_limit;
  return factor::Factor::make(like, {}, options, *core->memory, *core->jobs);
}

DirectionSystem::DirectionSystem(std::shared_ptr<const surface::Core> given, Index n)
    : DirectionMatrix(std::move(given), n),
      beta(core->memory.get()),
      pins(core->memory.get()),
      pin_paths(*core->memory) {
  make_pins();
}

solve::PinnedOperator DirectionSystem::pinned_operator() const noexcept {
  solve::PinnedOperator a;
  a.matrix = &matrix;
  a.factor = factor.get();
  a.pins = pins;
  a.pin_weight = beta;
  a.paths = &pin_paths;
  a.memory = core->memory.get();
  a.jobs = core->jobs.get();
  return a;
}

void DirectionMatrix::make_order() {
  const Span<const Index> own = core->factor->position();
  position.assign(own.begin(), own.end());
  if (missing_edges(*core) > missing_share * core->topology().edge_count()) {
    const SymmetricMatrix graph = mesh::laplacian(core->topology(), core->weights(), *core->memory, core->jobs.get());
    const Vector<float> coordinates = surface::ordering_coordinates(core->mesh, *core->memory);
    Buffer<Index> made;
    hf_inner::factor::make_order(graph, {coordinates.data(), coordinates.size()}, core->ordering, *core->memory,
                                 *core->jobs, made);
    for (Index k = 0; k < core->size(); ++k) position[at(made[k])] = k;
  }
  for (Index v = 0; v < core->size(); ++v) order[at(position[at(v)])] = v;
}

// Writes the matrix in real 2 x 2 blocks. A diagonal block is the identity times the sum of the vertex's weights. The
// block between two neighbours is -w R, with w the weight of their edge and R the rotation from the column's frame to
// the row's frame.
void DirectionMatrix::make_matrix() {
  const mesh::Topology& topology = core->topology();
  const std::size_t n = at(core->size());
  const Vector<double> weights =
      mesh::edge_weights(core->mesh, topology, mesh::OperatorKind::clamped, *core->memory, core->jobs.get());
  matrix.column_start.resize(2 * n + 1);
  matrix.column_start[0] = 0;
  Poller poller;
  for (std::size_t p = 0; p < n; ++p) {
    poller.due();
    const std::size_t v = at(order[p]);
    const Index length = 2 * (topology.neighbour_start[v + 1] - topology.neighbour_start[v] + 1);
    for (std::size_t part = 0; part < 2; ++part)
      matrix.column_start[2 * p + part + 1] = matrix.column_start[2 * p + part] + length;
  }
  matrix.row.resize(at(matrix.column_start[2 * n]));
  poll();
  matrix.value.resize(matrix.row.size());
  for_ranges(*core->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
    struct Neighbour {
      Index position, vertex, edge;
    };
    Vector<Neighbour> ring(&*core->memory);
    for (std::size_t p = begin; p < end; ++p) {
      const Index v = order[p];
      ring.assign(1, Neighbour{static_cast<Index>(p), v, -1});
      double sum = 0;
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)], e = topology.neighbour_edge[at(i)];
        ring.push_back({position[at(w)], w, e});
        sum += weights[at(e)];
      }
      std::sort(ring.begin(), ring.end(),
                [](const Neighbour& a, const Neighbour& b) { return a.position < b.position; });
      Index to[2] = {matrix.column_start[2 * p], matrix.column_start[2 * p + 1]};
      for (const Neighbour& other : ring) {
        double block[2][2] = {{sum, 0}, {0, sum}};  // [row part][column part]
        if (other.edge >= 0) {
          const double w = weights[at(other.edge)], turn = degree * connection.turn(topology, other.edge, other.vertex);
          block[0][0] = block[1][1] = -w * cosine(turn);
          block[0][1] = w * sine(turn);
          block[1][0] = -block[0][1];
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

// Chooses the pinned unknowns, factorises the matrix A = G G' with raised diagonals there, and solves their elimination
// paths Y_g = G^-1 e_g. It also computes C = Y_g'Y_g - I / beta, with beta the amount by which the diagonals are
// raised.
void DirectionSystem::make_pins() {
  const std::size_t components = core->ground.size();
  beta.assign(components, 0.0);
  Vector<double> count(components, 0.0, &*core->memory);
  Poller poller;
  for (Index v = 0; v < core->size(); ++v) {
    poller.due();
    const std::size_t c = at(core->mesh.component[at(v)]);
    beta[c] += matrix.value[matrix.diagonal(unknown(v, 0))];
    count[c] += 1;
  }
  SymmetricMatrix a(*core->memory);
  a.column_start.assign(matrix.column_start.begin(), matrix.column_start.end());
  a.row.assign(matrix.row.begin(), matrix.row.end());
  poll();
  a.value.assign(matrix.value.begin(), matrix.value.end());
  poll();
  Vector<Index> start(1, 0, &*core->memory);
  for (std::size_t c = 0; c < components; ++c) {
    beta[c] = beta[c] > 0 ? beta[c] / count[c] : 1.0;
    for (Index part = 0; part < 2; ++part) {
      pins.push_back(unknown(core->ground[c], part));
      start.push_back(static_cast<Index>(pins.size()));
      a.value[a.diagonal(pins.back())] += beta[c];
    }
  }
  factor = factorise(a);
  const Vector<double> ones(pins.size(), 1.0, &*core->memory);
  pin_paths.group.resize(pins.size());
  pin_paths.column.resize(pins.size());
  factor->solve_paths({start, pins, ones}, *core->memory, *core->jobs, pin_paths.groups, pin_paths.group,
                      pin_paths.column);
  double tile[factor::PathGroup::capacity * factor::PathGroup::capacity];
  for (std::size_t i = 0; i < pins.size(); ++i) {
    for (std::size_t j = i / 2 * 2; j < i / 2 * 2 + 2; ++j) {
      factor->gram(*pin_paths.groups[at(pin_paths.group[i])], *pin_paths.groups[at(pin_paths.group[j])], tile,
                   factor::PathGroup::capacity);
      pin_paths.corner.push_back(tile[pin_paths.column[i] * factor::PathGroup::capacity + pin_paths.column[j]] -
                                 (i == j ? 1 / beta[i / 2] : 0.0));
    }
  }
}

}  // namespace hf_inner::field
