// hf/hf.hpp - C++17 wrapper of hf.h: handles destroy themselves, failures are exceptions, arrays are vectors.
//
// It is header only. Every function only forwards to the C function of the same name.
//
//   hf::Surface surface(positions, triangles);
//   hf::Solver solver(surface);
//   solver.add_sites({0, 41}, {0.0, 1.0});
//   std::vector<float> field = solver.solve();
#ifndef HF_HF_HPP
#define HF_HF_HPP

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hf/hf.h"

namespace hf {

// Thrown when a call of hf fails. what() returns "function: message (HF_ERROR_...)".
class Error : public std::runtime_error {
 public:
  explicit Error(const hf_error_detail& detail)
      : std::runtime_error(std::string(detail.function) + ": " + detail.message + " (" +
                           hf_result_get_name(detail.code) + ")"),
        code_(detail.code),
        index_(detail.index) {}
  hf_result code() const noexcept { return code_; }
  uint32_t index() const noexcept { return index_; }

 private:
  hf_result code_;
  uint32_t index_;
};

inline void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw Error(detail);
}

// Makes a struct of defaults: every field is zero except struct_size.
template <class Desc>
Desc make() {
  Desc desc = Desc();
  desc.struct_size = static_cast<uint32_t>(sizeof(Desc));
  return desc;
}

// Owns one handle. It can be moved but not copied.
template <class Raw, void (*destroy)(Raw)>
class Handle {
 public:
  Handle() noexcept = default;
  explicit Handle(Raw raw) noexcept : raw_(raw) {}
  Handle(Handle&& other) noexcept : raw_(std::exchange(other.raw_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      destroy(raw_);
      raw_ = std::exchange(other.raw_, nullptr);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { destroy(raw_); }
  Raw get() const noexcept { return raw_; }
  explicit operator bool() const noexcept { return raw_ != nullptr; }

 private:
  Raw raw_ = nullptr;
};

// Undo and redo of one object. A state is a clone, so it shares memory with the object: history.record(solver.clone()).
template <class State>
class History {
 public:
  // Keeps a state. Call it before an edit. It forgets what was undone.
  void record(State state) {
    past_.push_back(std::move(state));
    undone_.clear();
  }
  // Exchanges the object with the last record. Throws Error (HF_ERROR_EMPTY) without one.
  void undo(State& object) { exchange(past_, undone_, object, "nothing is recorded; call record before the edits"); }
  // Exchanges the object with what the last undo took away.
  void redo(State& object) { exchange(undone_, past_, object, "nothing was undone since the last record"); }

 private:
  static void exchange(std::vector<State>& from, std::vector<State>& to, State& object, const char* nothing) {
    if (from.empty()) {
      hf_error_detail detail{};
      detail.code = HF_ERROR_EMPTY;
      detail.index = HF_NO_INDEX;
      std::snprintf(detail.message, sizeof detail.message, "%s", nothing);
      throw Error(detail);
    }
    to.push_back(std::exchange(object, std::move(from.back())));
    from.pop_back();
  }
  std::vector<State> past_, undone_;
};

// A handle of a clone: clone_of(handle, hf_solver_clone).
template <class Raw, void (*destroy)(Raw)>
Handle<Raw, destroy> clone_of(const Handle<Raw, destroy>& handle, hf_result (*clone)(Raw, Raw*)) {
  Raw raw = nullptr;
  check(clone(handle.get(), &raw));
  return Handle<Raw, destroy>(raw);
}

class Progress {
 public:
  Progress() {
    hf_progress raw = nullptr;
    check(hf_progress_create(&raw));
    handle_ = Handle<hf_progress, hf_progress_destroy>(raw);
  }
  double fraction() const {
    double value = 0;
    check(hf_progress_get_fraction(handle_.get(), &value));
    return value;
  }
  void cancel() { check(hf_progress_cancel(handle_.get())); }
  hf_progress get() const noexcept { return handle_.get(); }

 private:
  Handle<hf_progress, hf_progress_destroy> handle_;
};

// A Surface holds the mesh, which it welds and factorises once. All classes below are made on a surface; their objects
// may outlive it.
class Surface {
 public:
  explicit Surface(const hf_surface_desc& desc) : vertices_(desc.vertex_count) {
    hf_surface raw = nullptr;
    check(hf_surface_create(&desc, &raw));
    handle_ = Handle<hf_surface, hf_surface_destroy>(raw);
  }
  // Makes a surface of a graph: two vertices for each edge, and its weight. Fields work on it; what needs triangles
  // does not (hf_surface_create_graph).
  explicit Surface(const hf_graph_desc& desc) : vertices_(desc.vertex_count) {
    hf_surface raw = nullptr;
    check(hf_surface_create_graph(&desc, &raw));
    handle_ = Handle<hf_surface, hf_surface_destroy>(raw);
  }
  static Surface from_graph(uint32_t vertex_count, const std::vector<uint32_t>& edges,
                            const std::vector<double>& weights) {
    if (edges.size() != 2 * weights.size()) throw std::invalid_argument("edges hold two vertices for each weight");
    auto desc = make<hf_graph_desc>();
    desc.vertex_count = vertex_count;
    desc.edge_count = static_cast<uint32_t>(weights.size());
    desc.edges = edges.data();
    desc.weights = weights.data();
    return Surface(desc);
  }
  // Makes a surface. positions: x, y, z of each vertex. triangles: three vertices each.
  Surface(const std::vector<float>& positions, const std::vector<uint32_t>& triangles)
      : Surface(mesh(positions, triangles)) {}
  // Makes a surface of faces with any number of corners. offsets: the corners of face f are corners[offsets[f]] to
  // corners[offsets[f + 1] - 1].
  Surface(const std::vector<float>& positions, const std::vector<uint32_t>& offsets,
          const std::vector<uint32_t>& corners)
      : Surface(mesh(positions, offsets, corners)) {}

  hf_surface get() const noexcept { return handle_.get(); }
  uint32_t vertex_count() const noexcept { return vertices_; }
  hf_surface_info info() const {
    auto info = make<hf_surface_info>();
    check(hf_surface_get_info(get(), &info));
    return info;
  }
  hf_surface_report report() const {
    auto report = make<hf_surface_report>();
    check(hf_surface_get_report(get(), &report));
    return report;
  }
  hf_surface_statistics statistics() const {
    auto statistics = make<hf_surface_statistics>();
    check(hf_surface_get_statistics(get(), &statistics));
    return statistics;
  }
  std::vector<uint32_t> components() const {
    std::vector<uint32_t> components(vertices_);
    check(hf_surface_get_components(get(), vertices_, components.data(), nullptr));
    return components;
  }
  // Returns the links between pieces. You can edit them and give them back through relinked(), with light_vertices.
  std::vector<hf_link> links() const {
    uint32_t count = 0;
    check(hf_surface_get_links(get(), 0, nullptr, &count));
    std::vector<hf_link> links(count);
    if (count > 0) check(hf_surface_get_links(get(), count, links.data(), &count));
    return links;
  }
  // Returns the piece of every vertex, and HF_NO_INDEX for isolated vertices.
  std::vector<uint32_t> pieces() const {
    std::vector<uint32_t> pieces(vertices_);
    check(hf_surface_get_pieces(get(), vertices_, pieces.data(), nullptr, nullptr));
    return pieces;
  }
  // Returns a surface of the same mesh with other links.
  Surface relinked(const hf_links_desc& links) const {
    hf_surface raw = nullptr;
    check(hf_surface_relink(get(), &links, nullptr, &raw));
    return Surface(raw, vertices_);
  }
  // Returns how far linked pieces have opened in these positions: x, y, z of each vertex.
  hf_gaps_info gaps(const std::vector<float>& positions) const {
    if (positions.size() != size_t{3} * vertices_) throw std::invalid_argument("positions hold three numbers a vertex");
    auto desc = make<hf_gaps_desc>();
    desc.positions = positions.data();
    auto info = make<hf_gaps_info>();
    check(hf_surface_measure_gaps(get(), &desc, 0, nullptr, &info));
    return info;
  }
  // Returns the factor as bytes. Pass them to hf_surface_create in hf_surface_desc::saved_factor.
  std::vector<uint8_t> save(int32_t field_kind = HF_FIELD_HARMONIC) const {
    size_t size = 0;
    check(hf_surface_save(get(), field_kind, nullptr, 0, nullptr, &size));
    std::vector<uint8_t> bytes(size);
    check(hf_surface_save(get(), field_kind, nullptr, size, bytes.data(), &size));
    return bytes;
  }
  // Finds the first triangle on a ray. desc: null for the rest positions.
  hf_hit cast_ray(const double (&origin)[3], const double (&direction)[3], const hf_pick_desc* desc = nullptr) const {
    auto hit = make<hf_hit>();
    check(hf_surface_cast_ray(get(), origin, direction, desc, &hit));
    return hit;
  }
  uint32_t find_vertex(const double (&point)[3], const hf_pick_desc* desc = nullptr) const {
    uint32_t vertex = HF_NO_INDEX;
    check(hf_surface_find_vertex(get(), point, desc, &vertex, nullptr));
    return vertex;
  }

 private:
  Surface(hf_surface raw, uint32_t vertices) : handle_(raw), vertices_(vertices) {}
  static hf_surface_desc mesh(const std::vector<float>& positions, const std::vector<uint32_t>& triangles) {
    auto desc = make<hf_surface_desc>();
    if (positions.size() % 3 != 0 || triangles.size() % 3 != 0)
      throw std::invalid_argument("positions and triangles hold three numbers each");
    desc.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    desc.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
    desc.positions = positions.data();
    desc.triangles = triangles.data();
    return desc;
  }
  static hf_surface_desc mesh(const std::vector<float>& positions, const std::vector<uint32_t>& offsets,
                              const std::vector<uint32_t>& corners) {
    auto desc = make<hf_surface_desc>();
    if (positions.size() % 3 != 0) throw std::invalid_argument("positions hold three numbers each");
    if (offsets.empty()) throw std::invalid_argument("offsets hold one number more than there are faces");
    desc.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    desc.face_count = static_cast<uint32_t>(offsets.size() - 1);
    desc.corner_count = static_cast<uint32_t>(corners.size());
    desc.positions = positions.data();
    desc.face_starts = offsets.data();
    desc.corners = corners.data();
    return desc;
  }
  Handle<hf_surface, hf_surface_destroy> handle_;
  uint32_t vertices_ = 0;
};

// A set of sites on a surface. It solves the field through them.
class Solver {
 public:
  explicit Solver(const Surface& surface, uint32_t channel_count = 1) : Solver(surface, channels(channel_count)) {}
  Solver(const Surface& surface, const hf_solver_desc& desc)
      : channels_(desc.channel_count ? desc.channel_count : 1), vertices_(surface.vertex_count()) {
    hf_solver raw = nullptr;
    check(hf_create(surface.get(), &desc, &raw));
    handle_ = Handle<hf_solver, hf_solver_destroy>(raw);
  }

  hf_solver get() const noexcept { return handle_.get(); }
  Solver clone() const {
    hf_solver raw = nullptr;
    check(hf_solver_clone(get(), &raw));
    return Solver(raw, channels_, vertices_);
  }

  // Adds hard sites at vertices. values: channel_count per site. Returns the numbers of the sites.
  std::vector<uint32_t> add_sites(const std::vector<uint32_t>& vertices, const std::vector<double>& values) {
    need(values.size(), vertices.size() * channels_, "values");
    auto desc = make<hf_sites_desc>();
    desc.site_count = size(vertices);
    desc.vertices = vertices.data();
    desc.values = values.data();
    return add_sites(desc);
  }
  std::vector<uint32_t> add_sites(const hf_sites_desc& desc) {
    std::vector<uint32_t> numbers(desc.site_count);
    check(hf_add_sites(get(), &desc, numbers.data()));
    return numbers;
  }
  // Adds one hard site at a vertex, with the same value in every channel. Returns its number.
  uint32_t add_site(uint32_t vertex, double value = 0) {
    const std::vector<double> values(channels_, value);
    uint32_t number = HF_NO_INDEX;
    check(hf_solver_add_site(get(), vertex, values.data(), &number));
    return number;
  }
  void remove_sites(const std::vector<uint32_t>& sites) { check(hf_remove_sites(get(), size(sites), sites.data())); }
  void move_sites(const std::vector<uint32_t>& sites, const std::vector<uint32_t>& vertices) {
    auto to = make<hf_sites_desc>();
    to.site_count = size(vertices);
    to.vertices = vertices.data();
    check(hf_solver_move_sites(get(), size(sites), sites.data(), &to));
  }
  void set_values(const std::vector<uint32_t>& sites, const std::vector<double>& values) {
    need(values.size(), sites.size() * channels_, "values");
    check(hf_solver_set_values(get(), size(sites), sites.data(), values.data()));
  }
  // (K + A H) u = A H p + W lambda; empty screening removes it. p: [vertex][channel], or empty for 0.
  void set_screening(const std::vector<double>& screening, const std::vector<double>& targets = {}) {
    if (!screening.empty()) need(screening.size(), vertices_, "screening");
    if (!targets.empty()) need(targets.size(), vertices_ * channels_, "targets");
    check(hf_solver_set_screening(get(), screening.empty() ? nullptr : screening.data(),
                                  targets.empty() ? nullptr : targets.data()));
  }
  uint32_t site_count() const noexcept { return hf_solver_get_site_count(get()); }
  hf_solver_info info() const {
    auto info = make<hf_solver_info>();
    check(hf_solver_get_info(get(), &info));
    return info;
  }

  std::vector<float> solve(hf_solve_info* info = nullptr) const {
    std::vector<float> field(size_t{vertices_} * channels_);
    check(hf_solve(get(), field.data(), 0, info));
    return field;
  }
  std::vector<double> solve_f64(hf_solve_info* info = nullptr) const {
    std::vector<double> field(size_t{vertices_} * channels_);
    check(hf_solver_solve_f64(get(), field.data(), 0, info));
    return field;
  }
  std::vector<double> solve_at(const std::vector<uint32_t>& vertices) const {
    std::vector<double> values(vertices.size() * channels_);
    check(hf_solver_solve_at(get(), size(vertices), vertices.data(), values.data()));
    return values;
  }
  // Call this on a thread of your own while other threads edit and solve; see hf_solver_prepare_rebase.
  void prepare_rebase() { check(hf_solver_prepare_rebase(get())); }
  // Solves quickly in single precision; see hf_solver_solve_preview.
  std::vector<float> solve_preview(uint32_t correction_count = 0, hf_preview_info* info = nullptr) const {
    std::vector<float> field(size_t{vertices_} * channels_);
    check(hf_solver_solve_preview(get(), field.data(), 0, correction_count, info));
    return field;
  }
  void release_preview() { check(hf_solver_release_preview(get())); }
  // Throws when the error of the field exceeds the tolerance. 0 means the default of the engine.
  hf_certificate certify(double tolerance = 0) const {
    auto certificate = make<hf_certificate>();
    certificate.tolerance = tolerance;
    check(hf_solver_certify(get(), &certificate));
    return certificate;
  }
  hf_solver_statistics statistics() const {
    auto statistics = make<hf_solver_statistics>();
    check(hf_solver_get_statistics(get(), &statistics));
    return statistics;
  }

 private:
  Solver(hf_solver raw, uint32_t channels, uint32_t vertices)
      : handle_(raw), channels_(channels), vertices_(vertices) {}
  static hf_solver_desc channels(uint32_t count) {
    auto desc = make<hf_solver_desc>();
    desc.channel_count = count;
    return desc;
  }
  static uint32_t size(const std::vector<uint32_t>& list) { return static_cast<uint32_t>(list.size()); }
  static void need(size_t given, size_t wanted, const char* name) {
    if (given != wanted)
      throw std::invalid_argument(std::string(name) + ": " + std::to_string(given) + " given, " +
                                  std::to_string(wanted) + " needed");
  }

  Handle<hf_solver, hf_solver_destroy> handle_;
  uint32_t channels_ = 1, vertices_ = 0;
};

// Computes a direction field on a surface. All vectors are three numbers each.
class Direction {
 public:
  explicit Direction(const Surface& surface, uint32_t degree = 1) : vertices_(surface.vertex_count()) {
    auto desc = make<hf_direction_desc>();
    desc.degree = degree;
    hf_direction raw = nullptr;
    check(hf_direction_create(surface.get(), &desc, &raw));
    handle_ = Handle<hf_direction, hf_direction_destroy>(raw);
  }
  // Makes a copy with the same constraints. The copy shares the factor.
  Direction clone() const {
    hf_direction raw = nullptr;
    check(hf_direction_clone(get(), &raw));
    Direction made;
    made.handle_ = Handle<hf_direction, hf_direction_destroy>(raw);
    made.vertices_ = vertices_;
    return made;
  }
  hf_direction get() const noexcept { return handle_.get(); }
  std::vector<uint32_t> add_sites(const std::vector<uint32_t>& vertices, const std::vector<double>& vectors) {
    need(vectors.size(), vertices.size());
    std::vector<uint32_t> numbers(vertices.size());
    check(hf_direction_add_sites(get(), size(vertices), vertices.data(), vectors.data(), numbers.data()));
    return numbers;
  }
  void remove_sites(const std::vector<uint32_t>& sites) {
    check(hf_direction_remove_sites(get(), size(sites), sites.data()));
  }
  void move_site(uint32_t site, uint32_t vertex) { check(hf_direction_move_sites(get(), 1, &site, &vertex)); }
  void rotate_site(uint32_t site, double angle) { check(hf_direction_rotate_sites(get(), 1, &site, &angle)); }
  void set_vectors(const std::vector<uint32_t>& sites, const std::vector<double>& vectors) {
    need(vectors.size(), sites.size());
    check(hf_direction_set_vectors(get(), size(sites), sites.data(), vectors.data()));
  }
  uint32_t site_count() const noexcept { return hf_direction_get_site_count(get()); }
  std::vector<float> solve(hf_solve_info* info = nullptr) const {
    std::vector<float> vectors(size_t{vertices_} * 3);
    check(hf_direction_solve(get(), vectors.data(), 0, info));
    return vectors;
  }
  std::vector<hf_singularity> singularities() const {
    uint32_t count = 0;
    check(hf_direction_get_singularities(get(), 0, nullptr, &count));
    std::vector<hf_singularity> found(count);
    if (count) check(hf_direction_get_singularities(get(), count, found.data(), &count));
    return found;
  }

 private:
  static uint32_t size(const std::vector<uint32_t>& list) { return static_cast<uint32_t>(list.size()); }
  static void need(size_t numbers, size_t sites) {
    if (numbers != 3 * sites) throw std::invalid_argument("vectors: three numbers for each site are needed");
  }
  Direction() = default;
  Handle<hf_direction, hf_direction_destroy> handle_;
  uint32_t vertices_ = 0;
};

// The functions of hf/analysis.h follow. A field holds one value per vertex.
inline hf_scalars scalars(const Surface& surface, const std::vector<double>& field) {
  if (field.size() != surface.vertex_count())
    throw std::invalid_argument("field: one value for each vertex of the mesh is needed");
  auto desc = make<hf_scalars>();
  desc.values_f64 = field.data();
  return desc;
}

// spacing: HF_LEVELS_*.
inline std::vector<double> space_levels(const Surface& surface, const std::vector<double>& field, int32_t spacing,
                                        uint32_t count) {
  const hf_scalars desc = scalars(surface, field);
  std::vector<double> levels(count);
  check(hf_surface_space_levels(surface.get(), &desc, spacing, count, levels.data()));
  return levels;
}

struct Isolines {
  std::vector<uint32_t> point_edges;  // two vertices per point
  std::vector<double> parameters, positions;
  std::vector<uint32_t> line_starts, line_levels;
  std::vector<int32_t> line_closed;
};
inline Isolines trace_isolines(const Surface& surface, const std::vector<double>& field,
                               const std::vector<double>& levels) {
  const hf_scalars desc = scalars(surface, field);
  const uint32_t level_count = static_cast<uint32_t>(levels.size());
  auto raw = make<hf_isolines>();
  check(hf_surface_trace_isolines(surface.get(), &desc, level_count, levels.data(), &raw));
  Isolines lines;
  lines.point_edges.resize(size_t{raw.point_count} * 2);
  lines.parameters.resize(raw.point_count);
  lines.positions.resize(size_t{raw.point_count} * 3);
  lines.line_starts.resize(size_t{raw.line_count} + 1);
  lines.line_levels.resize(raw.line_count);
  lines.line_closed.resize(raw.line_count);
  raw.point_capacity = raw.point_count;
  raw.line_capacity = raw.line_count;
  raw.point_edges = lines.point_edges.data();
  raw.parameters = lines.parameters.data();
  raw.positions = lines.positions.data();
  raw.line_starts = lines.line_starts.data();
  raw.line_levels = lines.line_levels.data();
  raw.line_closed = lines.line_closed.data();
  check(hf_surface_trace_isolines(surface.get(), &desc, level_count, levels.data(), &raw));
  return lines;
}

inline std::vector<hf_critical_point> find_critical_points(const Surface& surface, const std::vector<double>& field) {
  const hf_scalars desc = scalars(surface, field);
  auto info = make<hf_critical_info>();
  check(hf_surface_find_critical_points(surface.get(), &desc, 0, nullptr, &info));
  std::vector<hf_critical_point> points(info.point_count);
  if (!points.empty())
    check(hf_surface_find_critical_points(surface.get(), &desc, info.point_count, points.data(), &info));
  return points;
}

// Finds the tips of a shape, the longest tip first. desc: null for the defaults.
inline std::vector<hf_extremity> find_extremities(const Surface& surface, const hf_extremities_desc* desc = nullptr) {
  // 256 tips are enough in practice; with more, the search runs a second time
  std::vector<hf_extremity> found(256);
  uint32_t count = 0;
  hf_result result =
      hf_surface_find_extremities(surface.get(), desc, static_cast<uint32_t>(found.size()), found.data(), &count);
  if (result == HF_ERROR_TOO_SMALL) {
    found.resize(count);
    result = hf_surface_find_extremities(surface.get(), desc, count, found.data(), &count);
  }
  check(result);
  found.resize(count);
  return found;
}

// Proposes handles for the first drag of a mesh; pinned ones come first. desc: null for the defaults.
inline std::vector<hf_handle_proposal> propose_handles(const Surface& surface,
                                                       const hf_handle_proposals_desc* desc = nullptr) {
  std::vector<hf_handle_proposal> found(HF_HANDLE_LIMIT);  // no list is longer
  uint32_t count = 0;
  check(hf_surface_propose_handles(surface.get(), desc, HF_HANDLE_LIMIT, found.data(), &count));
  found.resize(count);
  return found;
}

class Geodesics {
 public:
  explicit Geodesics(const Surface& surface, const hf_geodesics_desc* desc = nullptr)
      : vertices_(surface.vertex_count()) {
    hf_geodesics raw = nullptr;
    check(hf_geodesics_create(surface.get(), desc, &raw));
    handle_ = Handle<hf_geodesics, hf_geodesics_destroy>(raw);
  }
  hf_geodesics get() const noexcept { return handle_.get(); }
  std::vector<double> distance(const std::vector<uint32_t>& sources) const {
    std::vector<double> distances(vertices_);
    check(hf_geodesics_solve_f64(get(), static_cast<uint32_t>(sources.size()), sources.data(), distances.data(), 0));
    return distances;
  }
  // The shortest path between two points: xyz of its corners. Empty where no path leads.
  std::vector<double> path(const hf_surface_point& from, const hf_surface_point& to) const {
    hf_path path = HF_INIT(hf_path);
    check(hf_geodesics_find_path(get(), &from, &to, &path));
    std::vector<double> positions(size_t{3} * path.point_count);
    path.point_capacity = path.point_count;
    path.positions = positions.data();
    check(hf_geodesics_find_path(get(), &from, &to, &path));
    return positions;
  }
  // The surface around a point laid out in a plane: two coordinates per vertex, NaN beyond the radius (0: no bound).
  std::vector<double> map(const hf_surface_point& centre, double radius = 0) const {
    std::vector<double> coordinates(2 * vertices_);
    check(hf_geodesics_get_map(get(), &centre, radius, coordinates.data(), nullptr));
    return coordinates;
  }

 private:
  Handle<hf_geodesics, hf_geodesics_destroy> handle_;
  uint32_t vertices_ = 0;
};

// Holds a quad mesh (hf/quads.h) with all its arrays.
struct QuadMesh {
  std::vector<double> positions, barycentrics;  // three numbers per vertex
  std::vector<uint32_t> faces;                  // four vertices per quad
  std::vector<uint32_t> triangles;              // the triangle of the given mesh in which each quad vertex lies
  std::vector<uint32_t> corners;  // three per quad vertex: the vertices of the given mesh that barycentrics belong to
  hf_quads_info info;
};
// Keeps a quad mesh, to make it again while the user drags strokes, creases and irregular vertices.
class Quads {
 public:
  explicit Quads(const Surface& surface, const hf_quads_desc* desc = nullptr) {
    hf_quads raw = nullptr;
    check(hf_quads_create(surface.get(), desc, &raw));
    handle_ = Handle<hf_quads, hf_quads_destroy>(raw);
  }
  hf_quads get() const noexcept { return handle_.get(); }
  // When it throws, the mesh is what it was.
  void update(const hf_quads_desc& desc) { check(hf_quads_update(get(), &desc)); }
  hf_quads_info info() const {
    auto info = make<hf_quads_info>();
    check(hf_quads_get_info(get(), &info));
    return info;
  }
  QuadMesh mesh() const {
    QuadMesh mesh;
    mesh.info = info();
    mesh.positions.resize(size_t{mesh.info.vertex_count} * 3);
    mesh.barycentrics.resize(mesh.positions.size());
    mesh.triangles.resize(mesh.info.vertex_count);
    mesh.corners.resize(mesh.positions.size());
    mesh.faces.resize(size_t{mesh.info.face_count} * 4);
    auto out = make<hf_quads_mesh>();
    out.vertex_capacity = mesh.info.vertex_count;
    out.face_capacity = mesh.info.face_count;
    out.positions = mesh.positions.data();
    out.faces = mesh.faces.data();
    out.triangles = mesh.triangles.data();
    out.barycentrics = mesh.barycentrics.data();
    out.corners = mesh.corners.data();
    check(hf_quads_get_mesh(get(), &out));
    return mesh;
  }

 private:
  Handle<hf_quads, hf_quads_destroy> handle_;
};
inline QuadMesh make_quads(const Surface& surface, const hf_quads_desc* desc = nullptr) {
  return Quads(surface, desc).mesh();
}

// Holds streamlines of a field. One Flow can trace many fields on its surface.
struct Streamlines {
  std::vector<double> positions, values;  // three numbers and one per point
  std::vector<uint32_t> line_starts, line_ends;
};
class Flow {
 public:
  explicit Flow(const Surface& surface) {
    hf_flow raw = nullptr;
    check(hf_flow_create(surface.get(), &raw));
    handle_ = Handle<hf_flow, hf_flow_destroy>(raw);
  }
  hf_flow get() const noexcept { return handle_.get(); }
  // Traces `wanted` lines, or one line through every seed. It traces a second time only when the lines need more room
  // than those of the last call.
  Streamlines trace(const Surface& surface, const std::vector<double>& field, uint32_t wanted,
                    const std::vector<uint32_t>& seeds = {}) {
    const hf_scalars values = scalars(surface, field);
    auto out = make<hf_streamlines>();
    out.wanted_count = wanted;
    out.seed_count = static_cast<uint32_t>(seeds.size());
    out.seeds = seeds.data();
    Streamlines lines;
    for (uint32_t points = points_, count = lines_;;) {
      lines.positions.resize(size_t{points} * 3);
      lines.values.resize(points);
      lines.line_starts.resize(size_t{count} + 1);
      lines.line_ends.resize(size_t{count} * 2);
      out.point_capacity = points;
      out.line_capacity = count;
      out.positions = lines.positions.data();
      out.values = lines.values.data();
      out.line_starts = lines.line_starts.data();
      out.line_ends = lines.line_ends.data();
      const hf_result result = hf_flow_trace(get(), &values, &out);
      if (result != HF_ERROR_TOO_SMALL) {
        check(result);
        break;
      }
      points = points_ = out.point_count + out.point_count / 4;
      count = lines_ = out.line_count;
    }
    lines.positions.resize(size_t{out.point_count} * 3);
    lines.values.resize(out.point_count);
    lines.line_starts.resize(size_t{out.line_count} + 1);
    lines.line_ends.resize(size_t{out.line_count} * 2);
    return lines;
  }

 private:
  Handle<hf_flow, hf_flow_destroy> handle_;
  uint32_t points_ = 4096, lines_ = 64;
};

// Holds a region of a surface (hf/region.h) and its smooth base (the region without detail), and morphs between the
// two.
class Region {
 public:
  // positions: the surface of weight 0, or empty for the positions of the mesh. base: HF_BASE_*.
  explicit Region(const Surface& surface, const std::vector<float>& positions = {}, int32_t base = HF_BASE_DEFAULT)
      : vertices_(surface.vertex_count()) {
    if (!positions.empty() && positions.size() != size_t{vertices_} * 3)
      throw std::invalid_argument("positions: three numbers per vertex are needed");
    auto desc = make<hf_region_desc>();
    desc.base = base;
    if (!positions.empty()) desc.positions = positions.data();
    hf_region raw = nullptr;
    check(hf_region_create(surface.get(), &desc, &raw));
    handle_ = Handle<hf_region, hf_region_destroy>(raw);
  }
  hf_region get() const noexcept { return handle_.get(); }
  Region clone() const {
    hf_region raw = nullptr;
    check(hf_region_clone(get(), &raw));
    return Region(raw, vertices_);
  }
  void edit(const hf_region_edit_desc& desc) { check(hf_region_edit(get(), &desc)); }
  // Makes the region what a closed curve through these vertices encloses. kind: HF_CURVE_*.
  void enclose(const std::vector<uint32_t>& points, int32_t side = HF_SIDE_SMALLER, uint32_t seed_vertex = 0,
               int32_t kind = HF_CURVE_STRAIGHT) {
    auto curve = make<hf_curve_desc>();
    curve.point_count = static_cast<uint32_t>(points.size());
    curve.vertices = points.data();
    curve.side = side;
    curve.seed_vertex = seed_vertex;
    curve.kind = kind;
    auto desc = make<hf_region_edit_desc>();
    desc.curve = &curve;
    edit(desc);
  }
  // Grows the region by rings of vertices, or shrinks it if `rings` is negative.
  void grow(int32_t rings) {
    auto desc = make<hf_region_edit_desc>();
    desc.ring_count = rings;
    edit(desc);
  }
  void add_vertices(const std::vector<uint32_t>& vertices) {
    auto desc = make<hf_region_edit_desc>();
    desc.add_count = static_cast<uint32_t>(vertices.size());
    desc.add_vertices = vertices.data();
    edit(desc);
  }
  void remove_vertices(const std::vector<uint32_t>& vertices) {
    auto desc = make<hf_region_edit_desc>();
    desc.remove_count = static_cast<uint32_t>(vertices.size());
    desc.remove_vertices = vertices.data();
    edit(desc);
  }
  hf_region_info info() const {
    auto info = make<hf_region_info>();
    check(hf_region_get_info(get(), &info));
    return info;
  }
  // list: HF_REGION_*.
  std::vector<uint32_t> vertices(int32_t list = HF_REGION_INSIDE) const {
    uint32_t count = 0;
    check(hf_region_get_vertices(get(), list, 0, nullptr, &count));
    std::vector<uint32_t> found(count);
    check(hf_region_get_vertices(get(), list, count, found.data(), &count));
    return found;
  }
  // Returns the corners of the last curve: x, y, z of each.
  std::vector<double> curve() const {
    uint32_t count = 0;
    check(hf_region_get_curve(get(), 0, nullptr, &count));
    std::vector<double> points(size_t{3} * count);
    if (count > 0) check(hf_region_get_curve(get(), count, points.data(), &count));
    return points;
  }
  // out_normals: null, or a vector that receives the normals.
  std::vector<float> morph(double weight, std::vector<float>* out_normals = nullptr) const {
    return morphed(vertices_, weight, out_normals,
                   [&](const hf_morph_desc* desc) { return hf_region_morph(get(), desc); });
  }

 private:
  friend class Detail;
  Region(hf_region raw, uint32_t vertices) : handle_(raw), vertices_(vertices) {}
  template <class Write>
  static std::vector<float> morphed(uint32_t vertices, double weight, std::vector<float>* out_normals, Write&& write) {
    std::vector<float> positions(size_t{vertices} * 3);
    auto desc = make<hf_morph_desc>();
    desc.weight = weight;
    desc.positions = positions.data();
    if (out_normals) {
      out_normals->resize(positions.size());
      desc.normals = out_normals->data();
    }
    check(write(&desc));
    return positions;
  }
  Handle<hf_region, hf_region_destroy> handle_;
  uint32_t vertices_ = 0;
};

// The detail of one region (its offset from a smooth base), carried to another region.
class Detail {
 public:
  Detail(const Region& source, const Region& target, const hf_detail_desc* desc = nullptr)
      : vertices_(target.vertices_) {
    hf_detail raw = nullptr;
    check(hf_detail_create(source.get(), target.get(), desc, &raw));
    handle_ = Handle<hf_detail, hf_detail_destroy>(raw);
  }
  hf_detail get() const noexcept { return handle_.get(); }
  std::vector<float> morph(double weight, std::vector<float>* out_normals = nullptr) const {
    return Region::morphed(vertices_, weight, out_normals,
                           [&](const hf_morph_desc* desc) { return hf_detail_morph(get(), desc); });
  }

 private:
  Handle<hf_detail, hf_detail_destroy> handle_;
  uint32_t vertices_ = 0;
};

class Pose {
 public:
  explicit Pose(const Surface& surface, const hf_pose_desc* desc = nullptr) : vertices_(surface.vertex_count()) {
    hf_pose raw = nullptr;
    check(hf_pose_create(surface.get(), desc, &raw));
    handle_ = Handle<hf_pose, hf_pose_destroy>(raw);
  }
  hf_pose get() const noexcept { return handle_.get(); }
  Pose clone() const {
    hf_pose raw = nullptr;
    check(hf_pose_clone(get(), &raw));
    return Pose(raw, vertices_);
  }
  // Adds one handle for each region of vertices. in_place: it starts where the posed surface stands, not at rest.
  std::vector<uint32_t> add_handles(const std::vector<std::vector<uint32_t>>& regions, uint32_t layer = 0,
                                    bool in_place = false) {
    std::vector<uint32_t> counts, vertices, numbers(regions.size());
    for (const auto& region : regions) {
      counts.push_back(static_cast<uint32_t>(region.size()));
      vertices.insert(vertices.end(), region.begin(), region.end());
    }
    auto desc = make<hf_handles_desc>();
    desc.handle_count = static_cast<uint32_t>(regions.size());
    desc.layer = layer;
    desc.in_place = in_place;
    desc.region_counts = counts.data();
    desc.region_vertices = vertices.data();
    check(hf_pose_add_handles(get(), &desc, numbers.data()));
    return numbers;
  }
  void remove_handles(const std::vector<uint32_t>& handles) {
    check(hf_pose_remove_handles(get(), static_cast<uint32_t>(handles.size()), handles.data()));
  }
  void set_transform(uint32_t handle, const hf_transform& transform) {
    check(hf_pose_set_transform(get(), handle, &transform));
  }
  // Adds a handle: the vertex nearest to a point at rest, and all vertices edge-connected to it within a radius of the
  // point. in_place: as in add_handles.
  uint32_t add_handle(const double (&point)[3], double radius, uint32_t layer = 0, bool in_place = false) {
    auto desc = make<hf_handles_desc>();
    desc.handle_count = 1;
    desc.points = point;
    desc.radii = &radius;
    desc.layer = layer;
    desc.in_place = in_place;
    uint32_t number = 0;
    check(hf_pose_add_handles(get(), &desc, &number));
    return number;
  }
  // The matrix takes rest positions to posed positions; it is stored column by column.
  void set_matrix(uint32_t handle, const double (&matrix)[16]) {
    check(hf_pose_set_matrices(get(), 1, &handle, matrix));
  }
  uint32_t handle_count() const noexcept { return hf_pose_get_handle_count(get()); }
  hf_pose_info info() const {
    auto info = make<hf_pose_info>();
    check(hf_pose_get_info(get(), &info));
    return info;
  }
  hf_handle_info handle(uint32_t number) const {
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(get(), number, &info));
    return info;
  }
  std::vector<float> deform(hf_deform_info* info = nullptr) {
    std::vector<float> positions(size_t{vertices_} * 3);
    check(hf_deform(get(), positions.data(), info));
    return positions;
  }

 private:
  Pose(hf_pose raw, uint32_t vertices) : handle_(raw), vertices_(vertices) {}
  Handle<hf_pose, hf_pose_destroy> handle_;
  uint32_t vertices_ = 0;
};

class Transfer {
 public:
  Transfer(const Surface& source, const Surface& target, const hf_transfer_desc* desc = nullptr)
      : source_vertices_(source.vertex_count()), target_vertices_(target.vertex_count()) {
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.get(), target.get(), desc, &raw));
    handle_ = Handle<hf_transfer, hf_transfer_destroy>(raw);
  }
  hf_transfer get() const noexcept { return handle_.get(); }
  uint32_t add_pair(const std::vector<uint32_t>& source, const std::vector<uint32_t>& target, uint32_t flags = 0) {
    const uint32_t source_count = static_cast<uint32_t>(source.size()),
                   target_count = static_cast<uint32_t>(target.size());
    auto desc = make<hf_pairs_desc>();
    desc.pair_count = 1;
    desc.flags = &flags;
    desc.source_counts = &source_count;
    desc.source_vertices = source.data();
    desc.target_counts = &target_count;
    desc.target_vertices = target.data();
    uint32_t number = HF_NO_INDEX;
    check(hf_transfer_add_pairs(get(), &desc, &number));
    return number;
  }
  void remove_pair(uint32_t pair) { check(hf_transfer_remove_pairs(get(), 1, &pair)); }
  hf_transfer_info info() const {
    auto out = make<hf_transfer_info>();
    check(hf_transfer_get_info(get(), &out));
    return out;
  }
  // Sets what an animator turns while the transfer plays; neutral without an argument.
  void set_dials(const hf_transfer_dials* dials = nullptr) { check(hf_transfer_set_dials(get(), dials)); }
  hf_transfer_dials dials() const {
    auto out = make<hf_transfer_dials>();
    check(hf_transfer_get_dials(get(), &out));
    return out;
  }
  // 1 for every target vertex that may sink into the ground.
  std::vector<uint8_t> sinking() const {
    std::vector<uint8_t> out(target_vertices_);
    check(hf_transfer_get_sinking(get(), out.data()));
    return out;
  }
  // Poses the target after one posed frame of the source. The positions are in the source's vertex order.
  std::vector<float> apply(const std::vector<float>& source_positions) {
    if (source_positions.size() != size_t{source_vertices_} * 3)
      throw std::invalid_argument("source_positions: three numbers for each vertex of the source are needed");
    std::vector<float> positions(size_t{target_vertices_} * 3);
    auto frame = make<hf_transfer_frame>();
    frame.source_positions = source_positions.data();
    frame.target_positions = positions.data();
    check(hf_transfer_apply(get(), &frame));
    return positions;
  }

 private:
  Handle<hf_transfer, hf_transfer_destroy> handle_;
  uint32_t source_vertices_ = 0, target_vertices_ = 0;
};

// The joints of a skeleton, in the unit and frame of the mesh.
struct Joints {
  std::vector<double> heads;      // three numbers per joint
  std::vector<double> tails;      // the same, or empty: heads are joints
  std::vector<double> axes;       // without tails: where each joint points, or empty
  std::vector<uint32_t> parents;  // HF_NO_INDEX for a root; empty: all are roots
  std::vector<int32_t> deforms;   // empty: all deform
  std::vector<uint32_t> sources;  // set_joints: the number before, or empty
  size_t count() const noexcept { return heads.size() / 3; }
};

// Weights of all vertices: influence_count joints each, descending.
struct VertexWeights {
  uint32_t influence_count = 0;
  std::vector<uint32_t> joints;
  std::vector<float> weights;
  std::vector<uint8_t> origins;  // HF_WEIGHTS_* by vertex
};

// Names of joints as the library takes them: one line for each.
inline std::string joint_lines(const std::vector<std::string>& names) {
  std::string lines;
  for (const std::string& name : names) lines += name + "\n";
  return lines;
}

// Skin weights of a surface from a skeleton.
class Weights {
 public:
  // influence_count: 4 or 8 joints per vertex.
  Weights(const Surface& surface, const Joints& joints, uint32_t influence_count = 4) {
    const hf_joints_desc desc = describe(joints);
    hf_weights raw = nullptr;
    check(hf_weights_create(surface.get(), &desc, influence_count, &raw));
    handle_ = Handle<hf_weights, hf_weights_destroy>(raw);
  }
  hf_weights get() const noexcept { return handle_.get(); }
  Weights clone() const {
    hf_weights raw = nullptr;
    check(hf_weights_clone(get(), &raw));
    return Weights(raw);
  }
  void set_joints(const Joints& joints) {
    const hf_joints_desc desc = describe(joints);
    check(hf_weights_set_joints(get(), &desc));
  }
  void set_pins(const hf_pins_desc& pins) { check(hf_weights_set_pins(get(), &pins)); }
  // values: joints.size() numbers per vertex, or empty for the present weights.
  void set_locks(const std::vector<uint32_t>& joints, const std::vector<float>& values = {}) {
    if (!values.empty() && values.size() != size_t{info().vertex_count} * joints.size())
      throw std::invalid_argument("values: one number per vertex and joint is needed");
    check(hf_weights_set_locks(get(), static_cast<uint32_t>(joints.size()), joints.data(),
                               values.empty() ? nullptr : values.data()));
  }
  VertexWeights weights() const {
    auto out = make<hf_weights_out>();
    check(hf_weights_get(get(), &out));
    VertexWeights found;
    found.influence_count = out.influence_count;
    const size_t vertices = out.vertex_count, entries = vertices * out.influence_count;
    found.joints.resize(entries);
    found.weights.resize(entries);
    found.origins.resize(vertices);
    out.vertex_capacity = out.vertex_count;
    out.joints = found.joints.data();
    out.weights = found.weights.data();
    out.origins = found.origins.data();
    check(hf_weights_get(get(), &out));
    return found;
  }
  // Flags of HF_JOINT_* by joint. vertex_counts: null, or receives how many vertices ask for each joint.
  std::vector<uint32_t> joints(std::vector<uint32_t>* vertex_counts = nullptr) const {
    uint32_t count = 0;
    check(hf_weights_get_joints(get(), 0, nullptr, nullptr, &count));
    std::vector<uint32_t> flags(count);
    if (vertex_counts) vertex_counts->resize(count);
    check(hf_weights_get_joints(get(), count, flags.data(), vertex_counts ? vertex_counts->data() : nullptr, &count));
    return flags;
  }
  // Why each joint looks like a helper: bits of HF_HELPER_*. names: one for each joint, or empty.
  std::vector<uint32_t> helpers(const std::vector<std::string>& names = {}) const {
    uint32_t count = 0;
    check(hf_weights_get_helpers(get(), nullptr, 0, nullptr, &count));
    std::vector<uint32_t> reasons(count);
    const std::string lines = joint_lines(names);
    check(hf_weights_get_helpers(get(), names.empty() ? nullptr : lines.c_str(), count, reasons.data(), nullptr));
    return reasons;
  }
  hf_weights_info info() const {
    auto info = make<hf_weights_info>();
    check(hf_weights_get_info(get(), &info));
    return info;
  }

 private:
  explicit Weights(hf_weights raw) : handle_(raw) {}
  static hf_joints_desc describe(const Joints& joints) {
    const size_t count = joints.count();
    const auto fits = [&](size_t size, size_t width) { return size == 0 || size == count * width; };
    if (joints.heads.size() % 3 != 0 || !fits(joints.tails.size(), 3) || !fits(joints.axes.size(), 3) ||
        !fits(joints.parents.size(), 1) || !fits(joints.deforms.size(), 1) || !fits(joints.sources.size(), 1))
      throw std::invalid_argument("joints: all lists need as many joints as heads");
    auto desc = make<hf_joints_desc>();
    desc.joint_count = static_cast<uint32_t>(count);
    desc.heads = joints.heads.data();
    if (!joints.tails.empty()) desc.tails = joints.tails.data();
    if (!joints.axes.empty()) desc.axes = joints.axes.data();
    if (!joints.parents.empty()) desc.parents = joints.parents.data();
    if (!joints.deforms.empty()) desc.deforms = joints.deforms.data();
    if (!joints.sources.empty()) desc.sources = joints.sources.data();
    return desc;
  }
  Handle<hf_weights, hf_weights_destroy> handle_;
};

namespace detail {
// Room for the weights of a surface, as an hf_weights_out.
inline hf_weights_out room_for(VertexWeights& found, uint32_t vertices, uint32_t influence_count) {
  found.influence_count = influence_count == 0 ? 4 : influence_count;
  const size_t entries = size_t{vertices} * found.influence_count;
  found.joints.resize(entries);
  found.weights.resize(entries);
  found.origins.resize(vertices);
  auto out = make<hf_weights_out>();
  out.vertex_capacity = vertices;
  out.joints = found.joints.data();
  out.weights = found.weights.data();
  out.origins = found.origins.data();
  return out;
}
inline uint32_t influences_of(const VertexWeights& given, const Surface& surface) {
  const size_t entries = size_t{surface.vertex_count()} * given.influence_count;
  if (given.joints.size() != entries || given.weights.size() != entries)
    throw std::invalid_argument("joints and weights: influence_count of each vertex of the surface are needed");
  return given.influence_count;
}
}  // namespace detail

// Carries weights to another surface. options: distance, angle and influence_count count. info: null, or receives
// counts.
inline VertexWeights transfer_weights(const Surface& source, const VertexWeights& given, const Surface& target,
                                   hf_weights_transfer_desc options = make<hf_weights_transfer_desc>(),
                                   hf_weights_transfer_info* info = nullptr) {
  options.source_influence_count = detail::influences_of(given, source);
  options.joints = given.joints.data();
  options.weights = given.weights.data();
  VertexWeights found;
  hf_weights_out out = detail::room_for(found, target.vertex_count(), options.influence_count);
  check(hf_weights_transfer(source.get(), target.get(), &options, &out, info));
  return found;
}

// Mirrors weights. options: plane, partners, to, distance, angle and influence_count count. heads: three numbers for
// each joint. names: one for each joint, or empty.
inline VertexWeights mirror_weights(const Surface& surface, const VertexWeights& given,
                                    const std::vector<double>& heads, const std::vector<std::string>& names = {},
                                    hf_weights_mirror_desc options = make<hf_weights_mirror_desc>(),
                                    hf_weights_mirror_info* info = nullptr, std::vector<uint32_t>* partners = nullptr,
                                    std::vector<uint32_t>* pairings = nullptr) {
  const std::string lines = joint_lines(names);
  options.joint_count = static_cast<uint32_t>(heads.size() / 3);
  options.heads = heads.data();
  options.names = names.empty() ? nullptr : lines.c_str();
  options.source_influence_count = detail::influences_of(given, surface);
  options.joints = given.joints.data();
  options.weights = given.weights.data();
  if (partners) partners->resize(options.joint_count);
  if (pairings) pairings->resize(options.joint_count);
  VertexWeights found;
  hf_weights_out out = detail::room_for(found, surface.vertex_count(), options.influence_count);
  check(hf_weights_mirror(surface.get(), &options, &out, partners ? partners->data() : nullptr,
                          pairings ? pairings->data() : nullptr, info));
  return found;
}

}  // namespace hf

#endif
