// Graphs for tests, surfaces of them, and the dense answer to a field problem on one, made from the definitions alone.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <Eigen/Core>
#include <map>
#include <random>
#include <vector>

#include "hf/hf.h"
#include "support/arrays.h"
#include "support/dense.h"
#include "support/peers.h"

namespace graph_test {

struct Graph {
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> edges;  // two vertices each
  std::vector<double> weights, masses;
  std::int32_t allow_negative = 0;

  void add(std::uint32_t a, std::uint32_t b, double weight) {
    edges.insert(edges.end(), {a, b});
    weights.push_back(weight);
  }
  hf_graph_desc desc() const {
    hf_graph_desc d = HF_INIT(hf_graph_desc);
    d.vertex_count = vertex_count;
    d.edges = HF_ARRAY(edges.data(), weights.size());
    d.weights = HF_ARRAY(weights.data(), weights.size());
    d.allow_negative = allow_negative;
    if (!masses.empty()) d.masses = HF_ARRAY(masses.data(), masses.size());
    return d;
  }
};

inline std::string last_message() {
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  return std::string(detail.function) + ": " + detail.message;
}

// A surface of a graph, and solvers on it; destroyed with the object.
struct Surface {
  explicit Surface(const hf_graph_desc& desc) {
    EXPECT_EQ(hf_surface_create_graph(&desc, &handle), HF_OK) << last_message();
  }
  explicit Surface(const Graph& graph) : Surface(graph.desc()) {}
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  ~Surface() { hf_surface_destroy(handle); }
  hf_surface handle = nullptr;
};
struct Solver {
  Solver(hf_surface surface, std::int32_t field_kind, std::int32_t engine = ENGINE_GREEN) {
    hf_solver_desc desc = HF_INIT(hf_solver_desc);
    desc.field_kind = field_kind;
    EXPECT_EQ(create_with(engine, surface, &desc, &handle), HF_OK) << last_message();
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  ~Solver() { hf_solver_destroy(handle); }
  hf_solver handle = nullptr;
};

struct Sites {
  std::vector<std::uint32_t> vertices;
  std::vector<double> values, stiffness;
};
inline void add(hf_solver solver, const Sites& sites) {
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = static_cast<std::uint32_t>(sites.vertices.size());
  desc.vertices = sites.vertices.data();
  desc.values = sites.values.data();
  if (!sites.stiffness.empty()) desc.stiffness = sites.stiffness.data();
  ASSERT_EQ(hf_add_sites(solver, &desc, nullptr), HF_OK) << last_message();
}
inline std::vector<double> field(hf_solver solver, std::size_t vertex_count) {
  std::vector<double> values(vertex_count, -99);
  EXPECT_EQ(hf_solver_solve(solver, OUT(values.data()), nullptr), HF_OK) << last_message();
  return values;
}
inline std::vector<double> fluxes(hf_solver solver) {
  hf_sites_info info = HF_INIT(hf_sites_info);
  EXPECT_EQ(hf_solver_get_sites(solver, &info), HF_OK);
  std::vector<double> flux(info.count);
  info.capacity = info.count;
  info.flux = flux.data();
  EXPECT_EQ(hf_solver_get_sites(solver, &info), HF_OK);
  return flux;
}

// Components by vertex, -1 for vertices without an edge. Numbered by their lowest vertex.
inline std::vector<int> components(const Graph& graph) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> sums;
  for (std::size_t e = 0; e < graph.weights.size(); ++e)
    sums[std::minmax(graph.edges[2 * e], graph.edges[2 * e + 1])] += graph.weights[e];
  std::vector<int> label(graph.vertex_count), seen(graph.vertex_count, 0);
  for (std::uint32_t v = 0; v < graph.vertex_count; ++v) label[v] = static_cast<int>(v);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, w] : sums) {
      if (edge.first == edge.second || w == 0) continue;
      seen[edge.first] = seen[edge.second] = 1;
      const int least = std::min(label[edge.first], label[edge.second]);
      changed = changed || label[edge.first] != least || label[edge.second] != least;
      label[edge.first] = label[edge.second] = least;
    }
  }
  std::map<int, int> number;
  for (std::uint32_t v = 0; v < graph.vertex_count; ++v) {
    if (seen[v])
      label[v] = number.try_emplace(label[v], static_cast<int>(number.size())).first->second;
    else
      label[v] = -1;
  }
  return label;
}

// The field and the fluxes of sites, from the saddle-point system of the whole graph in the caller's unit.
struct Dense {
  Eigen::VectorXd field, flux;
};
inline Eigen::MatrixXd operator_of(const Graph& graph, const std::vector<int>& component, std::int32_t field_kind) {
  const int n = static_cast<int>(graph.vertex_count);
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t e = 0; e < graph.weights.size(); ++e) {
    const int a = static_cast<int>(graph.edges[2 * e]), b = static_cast<int>(graph.edges[2 * e + 1]);
    if (a == b) continue;
    const double w = graph.weights[e];
    l(a, b) -= w;
    l(b, a) -= w;
    l(a, a) += w;
    l(b, b) += w;
  }
  if (field_kind == HF_FIELD_HARMONIC) return l;
  Eigen::VectorXd mass = Eigen::VectorXd::Ones(n);
  for (int c = 0; field_kind == HF_FIELD_BIHARMONIC && !graph.masses.empty() && c < n; ++c) {
    double sum = 0, count = 0;
    for (int v = 0; v < n; ++v) {
      if (component[static_cast<std::size_t>(v)] == c) {
        sum += graph.masses[static_cast<std::size_t>(v)];
        count += 1;
      }
    }
    for (int v = 0; v < n; ++v) {
      if (component[static_cast<std::size_t>(v)] == c)
        mass[v] = graph.masses[static_cast<std::size_t>(v)] / (sum / count);
    }
  }
  return l * mass.cwiseInverse().asDiagonal() * l;
}
inline Dense dense_field(const Graph& graph, std::int32_t field_kind, const Sites& sites) {
  const std::vector<int> component = components(graph);
  const Eigen::MatrixXd k = operator_of(graph, component, field_kind);
  const int n = static_cast<int>(graph.vertex_count), m = static_cast<int>(sites.vertices.size());
  std::vector<int> reached(graph.vertex_count, 0);
  for (const std::uint32_t v : sites.vertices) reached[static_cast<std::size_t>(component[v])] = 1;
  std::vector<double> mean(graph.vertex_count, 0), count(graph.vertex_count, 0);
  for (int v = 0; v < n; ++v) {
    const int c = component[static_cast<std::size_t>(v)];
    if (c >= 0) {
      mean[static_cast<std::size_t>(c)] += std::fabs(k(v, v));
      count[static_cast<std::size_t>(c)] += 1;
    }
  }
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + m);
  for (int v = 0; v < n; ++v) {
    const int c = component[static_cast<std::size_t>(v)];
    if (c >= 0 && reached[static_cast<std::size_t>(c)])
      a.row(v).head(n) = k.row(v);
    else
      a(v, v) = 1;
  }
  for (int i = 0; i < m; ++i) {
    const std::size_t s = static_cast<std::size_t>(i);
    const int v = static_cast<int>(sites.vertices[s]);
    const std::size_t c = static_cast<std::size_t>(component[sites.vertices[s]]);
    a(v, n + i) -= 1;
    a(n + i, v) += 1;
    b[n + i] = sites.values[s];
    if (!sites.stiffness.empty() && sites.stiffness[s] > 0) a(n + i, n + i) = count[c] / (sites.stiffness[s] * mean[c]);
  }
  // Rows are scaled, since weights may have any unit.
  for (int r = 0; r < n + m; ++r) {
    const double size = a.row(r).cwiseAbs().maxCoeff();
    if (r < n && size > 0) {
      a.row(r) /= size;
      b[r] /= size;
    }
  }
  const Eigen::VectorXd x = hf_test::DenseSolver(a, hf_test::DenseSolver::full).solve(b);
  return {x.head(n), x.tail(m)};
}

// Up to four components, vertices without edges, parallel edges, self loops and edges of weight 0.
inline Graph random_graph(std::uint32_t seed, std::uint32_t vertex_count) {
  std::mt19937 random(seed);
  const auto pick = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  Graph graph;
  graph.vertex_count = vertex_count;
  const std::uint32_t parts = 1 + pick(4);
  for (std::uint32_t e = 0; e < 3 * vertex_count; ++e) {
    const std::uint32_t part = pick(parts);
    const std::uint32_t a = pick(vertex_count) / parts * parts + part, b = pick(vertex_count) / parts * parts + part;
    if (a >= vertex_count || b >= vertex_count || a % 11 == 3 || b % 11 == 3) continue;
    graph.add(a, b, pick(9) == 0 ? 0.0 : std::exp((static_cast<double>(pick(1000)) - 500) / 250));
    if (pick(5) == 0) graph.add(b, a, 0.1 + pick(3));
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v) graph.masses.push_back(0.2 + 0.01 * pick(300));
  return graph;
}

// Hard and soft sites at different vertices that have an edge.
inline Sites random_sites(std::uint32_t seed, const Graph& graph, std::size_t count) {
  std::mt19937 random(seed);
  const std::vector<int> component = components(graph);
  std::vector<std::uint32_t> usable;
  for (std::uint32_t v = 0; v < graph.vertex_count; ++v) {
    if (component[v] >= 0) usable.push_back(v);
  }
  Sites sites;
  for (std::size_t i = 0; i < count && !usable.empty(); ++i) {
    const std::size_t at = random() % usable.size();
    sites.vertices.push_back(usable[at]);
    usable.erase(usable.begin() + static_cast<std::ptrdiff_t>(at));
    sites.values.push_back(static_cast<double>(random() % 2001) / 1000 - 1);
    sites.stiffness.push_back(random() % 3 == 0 ? 0.01 * static_cast<double>(1 + random() % 500) : 0.0);
  }
  return sites;
}

}  // namespace graph_test
