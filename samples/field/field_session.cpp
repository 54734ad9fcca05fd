#include "field/field_session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "common/limits.h"

namespace samples {
namespace {

// Places of a list, as the library takes them. triangles: corners of the file's triangles.
struct Batch {
  Batch(const std::vector<SiteArgument>& sites, bool with_values, const std::vector<uint32_t>& triangles) {
    desc.site_count = static_cast<uint32_t>(sites.size());
    bool soft = false, at_vertices = true;
    for (const SiteArgument& site : sites) {
      at_vertices = at_vertices && site.place.is_vertex();
      places.push_back(place_of(site.place, triangles));
      vertices.push_back(places.back().corners[0]);
      values.insert(values.end(), site.values.begin(), site.values.end());
      stiffness.push_back(site.stiffness);
      soft = soft || site.stiffness > 0;
    }
    if (at_vertices)
      desc.vertices = vertices.data();
    else
      desc.places = places.data();
    if (with_values) desc.values = values.data();
    if (with_values && soft) desc.stiffness = stiffness.data();
  }
  template <class Place>
  static hf_place place_of(const Place& place, const std::vector<uint32_t>& triangles) {
    if (place.is_vertex()) return {{place.vertex, place.vertex, place.vertex}, 0, {1, 0, 0}};
    if (place.triangle >= triangles.size() / 3)
      throw std::runtime_error("there is no triangle " + std::to_string(place.triangle));
    const uint32_t* corner = &triangles[3 * size_t(place.triangle)];
    return {{corner[0], corner[1], corner[2]}, 0, {place.weights[0], place.weights[1], place.weights[2]}};
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  std::vector<uint32_t> vertices;
  std::vector<hf_place> places;
  std::vector<double> values, stiffness;
};

hf_scalars scalars(const std::vector<double>& field) {
  hf_scalars desc = HF_INIT(hf_scalars);
  desc.values_f64 = field.data();
  return desc;
}

// The area-weighted normal of every given vertex, not normalised.
std::vector<glm::dvec3> normals_of(const SurfaceMesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0));
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    const glm::dvec3 a = mesh.positions[mesh.triangles[t]];
    const glm::dvec3 n =
        glm::cross(mesh.positions[mesh.triangles[t + 1]] - a, mesh.positions[mesh.triangles[t + 2]] - a);
    for (size_t k = 0; k < 3; ++k) normals[mesh.triangles[t + k]] += n;
  }
  return normals;
}

// A unit vector along the surface: the axis that lies flattest, projected.
std::vector<double> tangent(const glm::dvec3& normal, size_t turn) {
  const double length = glm::length(normal);
  const glm::dvec3 n = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
  glm::dvec3 axis(0);
  const int flattest = std::fabs(n.x) <= std::fabs(n.y) && std::fabs(n.x) <= std::fabs(n.z) ? 0
                       : std::fabs(n.y) <= std::fabs(n.z)                                   ? 1
                                                                                            : 2;
  axis[flattest] = turn % 2 ? -1 : 1;
  const glm::dvec3 v = glm::normalize(axis - glm::dot(axis, n) * n);
  return {v.x, v.y, v.z};
}

}  // namespace

void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(std::string(detail.function) + ": " + detail.message + " (" + hf_result_get_name(result) +
                           ")");
}

Session::Session(const SurfaceMesh& mesh, const FieldOptions& options)
    : vertex_count_(static_cast<uint32_t>(mesh.positions.size())),
      components_(options.kind == FieldType::vector || options.kind == FieldType::direction ? 3 : 1) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = vertex_count_;
  desc.positions_f64 = mesh.positions.empty() ? nullptr : &mesh.positions[0].x;
  if (mesh.face_sizes.empty()) {
    desc.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
    desc.triangles = mesh.triangles.data();
  } else {
    desc.face_count = static_cast<uint32_t>(mesh.face_sizes.size());
    desc.face_sizes = mesh.face_sizes.data();
    desc.corner_count = static_cast<uint32_t>(mesh.face_vertices.size());
    desc.corners = mesh.face_vertices.data();
  }
  triangles_ = mesh.triangles;
  desc.operator_kind = options.operator_kind;
  desc.weld = options.weld;
  desc.thread_count = options.threads;
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  if (options.links) desc.links = &links;
  hf_solver_desc sites = HF_INIT(hf_solver_desc);
  sites.engine = options.engine;
  sites.channel_count = options.kind == FieldType::vector ? 3 : 1;
  if (options.kind == FieldType::biharmonic) desc.field_kind = sites.field_kind = HF_FIELD_BIHARMONIC;
  limit_surface(desc);
  check(hf_surface_create(&desc, &surface_));
  hf_result result = hf_create(surface_, &sites, &solver_);
  if (result == HF_OK && options.kind == FieldType::direction)
    result = hf_direction_create(surface_, nullptr, &direction_);
  if (result != HF_OK) {
    hf_solver_destroy(solver_);
    hf_surface_destroy(surface_);
  }
  check(result);
}

void Session::change_directions(const Edit& edit) {
  std::vector<uint32_t> vertices, numbers;
  std::vector<double> vectors;
  for (const SiteArgument& site : edit.sites) {
    if (!site.place.is_vertex() || site.stiffness > 0)
      throw std::runtime_error("the sites of a direction field are hard and lie at vertices");
    vertices.push_back(site.place.vertex);
    vectors.insert(vectors.end(), site.values.begin(), site.values.end());
  }
  const uint32_t count = static_cast<uint32_t>(edit.sites.size());
  if (edit.kind == Edit::Kind::add) {
    numbers.resize(count);
    check(hf_direction_add_sites(direction_, count, vertices.data(), vectors.data(), numbers.data()));
    for (size_t i = 0; i < count; ++i) sites_[edit.sites[i].place] = numbers[i];
  } else if (edit.kind == Edit::Kind::move) {
    std::vector<uint32_t> to;
    for (size_t i = 0; i < count; i += 2) {
      numbers.push_back(number(edit.sites[i].place));
      to.push_back(vertices[i + 1]);
    }
    check(hf_direction_move_sites(direction_, count / 2, numbers.data(), to.data()));
    for (size_t i = 0; i < count; i += 2) sites_.erase(edit.sites[i].place);
    for (size_t i = 0; i < count; i += 2) sites_[edit.sites[i + 1].place] = numbers[i / 2];
  } else {
    for (const SiteArgument& site : edit.sites) numbers.push_back(number(site.place));
    if (edit.kind == Edit::Kind::set) {
      check(hf_direction_set_vectors(direction_, count, numbers.data(), vectors.data()));
    } else {
      check(hf_direction_remove_sites(direction_, count, numbers.data()));
      for (const SiteArgument& site : edit.sites) sites_.erase(site.place);
    }
  }
}

std::vector<hf_singularity> Session::singularities() const {
  if (!direction_) return {};
  uint32_t count = 0;
  check(hf_direction_get_singularities(direction_, 0, nullptr, &count));
  std::vector<hf_singularity> found(count);
  if (count > 0) check(hf_direction_get_singularities(direction_, count, found.data(), &count));
  return found;
}

Session::State Session::copy() const {
  State state{nullptr, nullptr, sites_};
  check(direction_ ? hf_direction_clone(direction_, &state.direction) : hf_solver_clone(solver_, &state.solver));
  return state;
}

void Session::destroy(std::vector<State>& states) {
  for (const State& state : states) {
    hf_direction_destroy(state.direction);
    hf_solver_destroy(state.solver);
  }
  states.clear();
}

void Session::apply(const Edit& edit) {
  if (edit.kind == Edit::Kind::undo || edit.kind == Edit::Kind::redo) {
    auto& from = edit.kind == Edit::Kind::undo ? past_ : undone_;
    if (from.empty())
      throw std::runtime_error(edit.kind == Edit::Kind::undo ? "there is no edit to undo" : "there is no edit to redo");
    (edit.kind == Edit::Kind::undo ? undone_ : past_).push_back({solver_, direction_, sites_});
    solver_ = from.back().solver;
    direction_ = from.back().direction;
    sites_ = from.back().sites;
    from.pop_back();
    return;
  }
  std::vector<State> before{copy()};
  try {
    direction_ ? change_directions(edit) : change(edit);
  } catch (...) {
    destroy(before);
    throw;
  }
  past_.push_back(before[0]);
  destroy(undone_);
}

std::vector<double> Session::solve(hf_solve_info& info) const {
  std::vector<double> field(vertex_count_ * components_);
  info = HF_INIT(hf_solve_info);
  if (direction_) {
    check(hf_direction_solve_f64(direction_, field.data(), 0, &info));
  } else if (components_ == 3) {
    check(hf_solver_solve_vectors_f64(solver_, field.data(), 0, nullptr, &info));
  } else {
    check(hf_solver_solve_f64(solver_, field.data(), 0, &info));
  }
  return field;
}

std::vector<glm::dvec3> Session::positions(const SurfaceMesh& mesh) const {
  std::vector<glm::dvec3> points;
  for (const auto& [place, number] : sites_) {
    (void)number;
    if (place.triangle == no_triangle) {
      points.push_back(mesh.positions[place.vertex]);
    } else {
      glm::dvec3 p(0);
      for (size_t k = 0; k < 3; ++k)
        p += place.weights[k] * mesh.positions[mesh.triangles[3 * size_t(place.triangle) + k]];
      points.push_back(p);
    }
  }
  return points;
}

uint32_t Session::number(const Place& place) const {
  const auto found = sites_.find(place);
  if (found == sites_.end())
    throw std::runtime_error("there is no site at " +
                             std::string(place.is_vertex()
                                             ? "vertex " + std::to_string(place.vertex)
                                             : "that point of triangle " + std::to_string(place.triangle)));
  return found->second;
}

void Session::change(const Edit& edit) {
  std::vector<uint32_t> numbers;
  switch (edit.kind) {
    case Edit::Kind::add: {
      const Batch batch(edit.sites, true, triangles_);
      numbers.resize(edit.sites.size());
      check(hf_add_sites(solver_, &batch.desc, numbers.data()));
      for (size_t i = 0; i < numbers.size(); ++i) sites_[edit.sites[i].place] = numbers[i];
      break;
    }
    case Edit::Kind::remove:
      for (const SiteArgument& site : edit.sites) numbers.push_back(number(site.place));
      check(hf_remove_sites(solver_, static_cast<uint32_t>(numbers.size()), numbers.data()));
      for (const SiteArgument& site : edit.sites) sites_.erase(site.place);
      break;
    case Edit::Kind::move: {
      std::vector<SiteArgument> to;
      for (size_t i = 0; i < edit.sites.size(); i += 2) {
        numbers.push_back(number(edit.sites[i].place));
        to.push_back(edit.sites[i + 1]);
      }
      const Batch batch(to, false, triangles_);
      check(hf_solver_move_sites(solver_, static_cast<uint32_t>(numbers.size()), numbers.data(), &batch.desc));
      for (size_t i = 0; i < edit.sites.size(); i += 2) sites_.erase(edit.sites[i].place);
      for (size_t i = 0; i < to.size(); ++i) sites_[to[i].place] = numbers[i];
      break;
    }
    case Edit::Kind::set: {
      std::vector<double> values;
      for (const SiteArgument& site : edit.sites) {
        numbers.push_back(number(site.place));
        values.insert(values.end(), site.values.begin(), site.values.end());
      }
      check(hf_solver_set_values(solver_, static_cast<uint32_t>(numbers.size()), numbers.data(), values.data()));
      break;
    }
    case Edit::Kind::undo:
    case Edit::Kind::redo:
      break;
  }
}

std::vector<bool> Session::reached(const std::vector<double>& field) const {
  std::vector<uint32_t> component(vertex_count_);
  check(hf_surface_get_components(surface_, vertex_count_, component.data(), nullptr));
  std::set<uint32_t> found;
  if (direction_) {  // vectors are 0 where no site reaches
    for (size_t i = 0; i < field.size(); ++i)
      if (field[i] != 0) found.insert(component[i / 3]);
  } else {
    std::vector<uint32_t> served(hf_solver_get_site_count(solver_));
    hf_sites_info info = HF_INIT(hf_sites_info);
    info.capacity = static_cast<uint32_t>(served.size());
    info.components = served.data();
    check(hf_solver_get_sites(solver_, &info));
    found.insert(served.begin(), served.end());
  }
  std::vector<bool> reached(vertex_count_);
  for (uint32_t v = 0; v < vertex_count_; ++v) reached[v] = found.count(component[v]) > 0;
  return reached;
}

std::vector<hf_extremity> Session::extremities(int kind) const {
  hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
  desc.kind = kind;
  uint32_t count = 0;
  check(hf_surface_find_extremities(surface_, &desc, 0, nullptr, &count));
  std::vector<hf_extremity> found(count);
  check(hf_surface_find_extremities(surface_, &desc, count, found.data(), &count));
  return found;
}

std::vector<double> Session::distance(const std::vector<uint32_t>& sources) const {
  hf_geodesics raw = nullptr;
  check(hf_geodesics_create(surface_, nullptr, &raw));
  const std::unique_ptr<std::remove_pointer_t<hf_geodesics>, void (*)(hf_geodesics)> geodesics(raw,
                                                                                               hf_geodesics_destroy);
  std::vector<double> distance(vertex_count_);
  check(hf_geodesics_solve_f64(raw, static_cast<uint32_t>(sources.size()), sources.data(), distance.data(), 0));
  return distance;
}

std::vector<double> Session::levels(const std::vector<double>& field, int spacing, int count) const {
  std::vector<double> levels(static_cast<size_t>(count));
  const hf_scalars desc = scalars(field);
  check(hf_surface_space_levels(surface_, &desc, spacing, static_cast<uint32_t>(count), levels.data()));
  return levels;
}

std::vector<IsoLine> Session::isolines(const std::vector<double>& field, const std::vector<double>& levels) const {
  hf_isolines lines = HF_INIT(hf_isolines);
  const hf_scalars desc = scalars(field);
  const uint32_t level_count = static_cast<uint32_t>(levels.size());
  check(hf_surface_trace_isolines(surface_, &desc, level_count, levels.data(), &lines));
  std::vector<double> positions(3 * size_t(lines.point_count));
  std::vector<uint32_t> starts(size_t(lines.line_count) + 1), of_level(lines.line_count);
  std::vector<int32_t> closed(lines.line_count);
  if (lines.line_count == 0) return {};
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  lines.line_levels = of_level.data();
  lines.line_closed = closed.data();
  check(hf_surface_trace_isolines(surface_, &desc, level_count, levels.data(), &lines));
  std::vector<IsoLine> found(lines.line_count);
  for (size_t l = 0; l < found.size(); ++l) {
    found[l].level = of_level[l];
    found[l].closed = closed[l] != 0;
    for (size_t i = starts[l]; i < starts[l + 1]; ++i)
      found[l].points.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
  }
  return found;
}

std::vector<hf_critical_point> Session::critical_points(const std::vector<double>& field,
                                                        hf_critical_info& info) const {
  info = HF_INIT(hf_critical_info);
  const hf_scalars desc = scalars(field);
  check(hf_surface_find_critical_points(surface_, &desc, 0, nullptr, &info));
  std::vector<hf_critical_point> points(info.point_count);
  check(hf_surface_find_critical_points(surface_, &desc, info.point_count, points.data(), &info));
  return points;
}

std::vector<SiteArgument> propose_sites(const SurfaceMesh& mesh, const Session& session, int extremities) {
  std::vector<uint32_t> vertices, component(mesh.positions.size());
  check(
      hf_surface_get_components(session.surface(), static_cast<uint32_t>(component.size()), component.data(), nullptr));
  std::map<uint32_t, int> count{{HF_NO_INDEX, 2}};
  for (const hf_extremity& tip : session.extremities(extremities)) {
    vertices.push_back(tip.vertex);
    ++count[tip.component];
  }
  for (uint32_t v = 0; v < component.size(); ++v) {
    int& there = count[component[v]];
    if (there == 0) {
      vertices.push_back(v);
      there = 1;
    }
  }
  // where there is only one, the vertex farthest from it
  const std::vector<double> distance = session.distance(vertices);
  std::map<uint32_t, uint32_t> farthest;
  for (uint32_t v = 0; v < component.size(); ++v) {
    if (count[component[v]] != 1) continue;
    const auto [entry, first] = farthest.try_emplace(component[v], v);
    if (!first && distance[v] > distance[entry->second]) entry->second = v;
  }
  for (const auto& [name, vertex] : farthest) {
    if (distance[vertex] > 0) vertices.push_back(vertex);
  }
  const std::vector<glm::dvec3> normals = normals_of(mesh);
  std::vector<SiteArgument> sites;
  for (size_t i = 0; i < vertices.size(); ++i) {
    SiteArgument site;
    site.place.vertex = vertices[i];
    site.values =
        session.components() == 3 ? tangent(normals[vertices[i]], i) : std::vector<double>{static_cast<double>(i % 2)};
    sites.push_back(site);
  }
  return sites;
}

}  // namespace samples
