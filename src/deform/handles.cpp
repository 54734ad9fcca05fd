#include "deform/handles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "deform/constants.h"
#include "deform/rest.h"
#include "surface/rim.h"

namespace hf_inner::deform {
namespace {

// Chooses `count` vertices of a handle's boundary ring by farthest-point sampling. It takes one vertex of every
// component first, so that each component has sites.
Vector<std::int32_t> sample_ring(const mesh::Mesh& mesh, const Vector<std::int32_t>& ring, std::uint32_t count,
                                 Memory& memory) {
  Vector<std::int32_t> chosen(&memory);
  chosen.reserve(std::min<std::size_t>(ring.size(), count));
  Vector<double> distance(ring.size(), std::numeric_limits<double>::infinity(), &memory);
  const auto take = [&](std::size_t k) {
    chosen.push_back(ring[k]);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 d = mesh.positions[ring[i]] - mesh.positions[ring[k]];
      distance[i] = std::min(distance[i], dot(d, d));
    }
    distance[k] = -1;
  };
  Vector<std::int32_t> components(&memory);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::int32_t component = mesh.component[ring[k]];
    if (std::find(components.begin(), components.end(), component) != components.end()) continue;
    components.push_back(component);
    take(k);
  }
  while (chosen.size() < count && chosen.size() < ring.size())
    take(static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin()));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// Returns the number of fields to solve. The fields sum to 1, so the field of the last handle follows from the others.
std::int32_t solved_channels(std::size_t handle_count) noexcept {
  return handle_count < 2 ? static_cast<std::int32_t>(handle_count) : static_cast<std::int32_t>(handle_count) - 1;
}

// Writes the handles' fields at one vertex. The solved values are clipped and scaled, so that they sum to 1 over the
// handles of the component.
void finish_vertex(std::int32_t v, const double* solved, std::int32_t channels, std::int32_t owner,
                   Span<const std::int32_t> present, HandleFields& fields) {
  const std::int32_t handle_count = static_cast<std::int32_t>(fields.leak.size());
  double* const out = fields.at(v);
  std::fill_n(out, handle_count, 0.0);
  if (present.empty()) return;
  if (owner >= 0 || present.size() == 1) {
    out[owner >= 0 ? owner : present[0]] = 1;
    return;
  }
  double sum = 0, others = 0;
  for (std::int32_t i = 0; i < channels; ++i) others += solved[i];
  if (present.size() == static_cast<std::size_t>(handle_count)) {  // most: all handles are on one component
    for (std::int32_t i = 0; i < channels; ++i) sum += out[i] = std::clamp(solved[i], 0.0, 1.0);
    if (channels < handle_count) sum += out[channels] = std::clamp(1.0 - others, 0.0, 1.0);
    const double whole = sum > 0 ? sum : static_cast<double>(handle_count);
    for (std::int32_t i = 0; i < handle_count; ++i) out[i] = sum > 0 ? out[i] / whole : 1.0 / whole;
    return;
  }
  for (const std::int32_t i : present) {
    const double value = std::clamp(i < channels ? solved[i] : 1.0 - others, 0.0, 1.0);
    out[i] = value;
    sum += value;
  }
  for (const std::int32_t i : present) out[i] = sum > 0 ? out[i] / sum : 1.0 / static_cast<double>(present.size());
}

}  // namespace

void check_region_count(std::size_t there, std::size_t added, const char* noun) {
  if (added == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "%s_count is 0", noun);
  if (there + added > handle_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%zu %ss and %zu more; at most %u are possible", there, noun, added,
         handle_limit);
}

std::shared_ptr<HandleRegion> make_region(const surface::Core& core, Span<const std::int32_t> vertices,
                                          std::uint32_t rim_site_count, Memory& memory) {
  const mesh::Mesh& mesh = core.mesh;
  const mesh::Topology& topology = core.topology();
  auto region = make_shared_in<HandleRegion>(memory, memory);
  region->vertices.assign(vertices.begin(), vertices.end());
  std::sort(region->vertices.begin(), region->vertices.end());
  region->vertices.erase(std::unique(region->vertices.begin(), region->vertices.end()), region->vertices.end());
  const auto inside = [&](std::int32_t v) {
    return std::binary_search(region->vertices.begin(), region->vertices.end(), v);
  };
  Vector<std::int32_t> ring(&memory);
  Vec3 sum;
  for (const std::int32_t v : region->vertices) {
    sum = sum + mesh.positions[v];
    bool rim = surface::couples_outward(core, v, inside);
    for (std::int32_t k = topology.neighbour_start[v]; !rim && k < topology.neighbour_start[v + 1]; ++k)
      rim = !inside(topology.neighbour[k]);
    if (rim) ring.push_back(v);
  }
  region->centroid = (1.0 / static_cast<double>(region->vertices.size())) * sum;
  region->component = mesh.component[region->vertices.front()];
  if (rim_site_count != 0 && rim_site_count < ring.size()) {
    region->sites = sample_ring(mesh, ring, rim_site_count, memory);
  } else {
    region->sites = std::move(ring);
  }
  return region;
}

std::int32_t vertex_near(const surface::Core& core, Vec3 point) noexcept {
  std::int32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t v = 0; v < core.size(); ++v) {
    const Vec3 d = core.mesh.positions[v] - point;
    if (dot(d, d) < least) {
      least = dot(d, d);
      nearest = v;
    }
  }
  return nearest;
}

Vector<std::int32_t> RegionSearch::from(std::int32_t nearest, Vec3 point, double radius) {
  const mesh::Topology& topology = core_.topology();
  Vector<std::int32_t> region(1, nearest, core_.memory.get());
  seen_[nearest] = 1;
  for (std::size_t at = 0; at < region.size(); ++at) {
    const std::int32_t v = region[at];
    for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
      const std::int32_t u = topology.neighbour[k];
      if (seen_[u] || !(norm(core_.mesh.positions[u] - point) <= radius)) continue;
      region.push_back(u);
      seen_[u] = 1;
    }
  }
  for (const std::int32_t v : region) seen_[v] = 0;
  std::sort(region.begin(), region.end());
  return region;
}

// How far a point is from the nearest neighbour of a vertex.
double neighbour_distance(const surface::Core& core, std::int32_t v, Vec3 point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t k = core.topology().neighbour_start[v]; k < core.topology().neighbour_start[v + 1]; ++k)
    least = std::min(least, norm(core.mesh.positions[core.topology().neighbour[k]] - point));
  return least;
}

bool is_spike(Span<const std::int32_t> region, double radius) noexcept {
  return region.size() == 1 && radius < least_radius;
}

namespace {

// Where the region of a place begins.
struct RegionCentre {
  std::int32_t vertex;
  Vec3 point;
};

RegionCentre centre_of(const surface::Core& core, const mesh::Places& places, const mesh::PlaceReader& reader,
                       std::uint32_t r) {
  if (places.points) {
    const Vec3 point = mesh::read_point_near(core.mesh, places.points + 3 * std::size_t{r}, "point", r);
    return {vertex_near(core, point), point};
  }
  const mesh::SurfacePlace place = reader.read(r);
  const auto corner = [&](int k) { return core.mesh.positions[place.vertex[k]]; };
  Vec3 point = corner(0);
  int nearest = 0;
  if (!place.is_vertex()) point = place.weight[0] * point;
  for (int k = 1; k < 3 && place.vertex[k] != mesh::Mesh::none; ++k) point = point + place.weight[k] * corner(k);
  for (int k = 1; k < 3 && place.vertex[k] != mesh::Mesh::none; ++k)
    nearest = norm(corner(k) - point) < norm(corner(nearest) - point) ? k : nearest;
  return {place.vertex[nearest], point};
}

}  // namespace

void regions_near(const surface::Core& core, const mesh::Places& places, const double* radii,
                  Vector<std::uint32_t>& start, Vector<std::int32_t>& vertices) {
  start.push_back(0);
  mesh::Places surface = places;
  surface.points = nullptr;  // of points, vertices count and not triangles
  const mesh::PlaceReader reader(core.mesh, surface, *core.memory);
  RegionSearch search(core);
  for (std::uint32_t r = 0; r < places.count; ++r) {
    const RegionCentre centre = centre_of(core, places, reader, r);
    if (!std::isfinite(radii[r])) fail(HF_ERROR_NON_FINITE, r, "the radius of place %u is not finite", r);
    if (radii[r] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, r, "the radius of place %u is %g; it must not be negative", r, radii[r]);
    const double radius = radii[r] / core.mesh.scale;
    const Vector<std::int32_t> region = search.from(centre.vertex, centre.point, radius);
    if (is_spike(region, radius))
      fail(HF_ERROR_INVALID_ARGUMENT, r,
           "the radius of place %u is %g and holds one vertex, which pulls a spike. Make it larger (the next vertex is "
           "%.3g away), or name the vertex in region_vertices",
           r, radii[r], core.mesh.scale * neighbour_distance(core, region.front(), centre.point));
    vertices.insert(vertices.end(), region.begin(), region.end());
    start.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
}

Reach::Reach(const mesh::Mesh& mesh, const Handles& handles, Memory& memory)
    : owner(mesh.vertex_count(), -1, &memory),
      component_start(mesh.component_count() + 1, 0, &memory),
      handle(&memory) {
  // A handle may reach into several components; each pair of handle and component counts once.
  Vector<std::int32_t> last_handle(mesh.component_count(), -1, &memory);
  const auto for_pairs = [&](auto&& use) {
    std::fill(last_handle.begin(), last_handle.end(), -1);
    for (std::size_t i = 0; i < handles.size(); ++i) {
      for (const std::int32_t v : handles[i].region->vertices) {
        const std::int32_t c = mesh.component[v];
        if (last_handle[c] == static_cast<std::int32_t>(i)) continue;
        last_handle[c] = static_cast<std::int32_t>(i);
        use(c, static_cast<std::int32_t>(i));
      }
    }
  };
  for_pairs([&](std::int32_t c, std::int32_t) { ++component_start[c + 1]; });
  for (std::int32_t c = 0; c < mesh.component_count(); ++c) component_start[c + 1] += component_start[c];
  handle.resize(component_start.back());
  Vector<std::int32_t> next(component_start, &memory);
  for_pairs([&](std::int32_t c, std::int32_t i) { handle[next[c]++] = i; });
  for (std::size_t i = 0; i < handles.size(); ++i) {
    for (const std::int32_t v : handles[i].region->vertices) owner[v] = static_cast<std::int32_t>(i);
  }
}

void set_handle_sites(const surface::Core& core, solve::SiteSolver& solver, const Handles& before,
                      const Handles& handles, Memory& memory) {
  std::size_t same = 0;
  std::int32_t first = 0;
  for (; same < std::min(before.size(), handles.size()) && before[same].region == handles[same].region; ++same)
    first += static_cast<std::int32_t>(handles[same].region->sites.size());
  Vector<std::int32_t> remove(&memory), add(&memory);
  Vector<solve::Site> sites(&memory);
  for (std::size_t i = same; i < before.size(); ++i) {
    for (std::size_t k = 0; k < before[i].region->sites.size(); ++k)
      remove.push_back(first + static_cast<std::int32_t>(remove.size()));
  }
  for (std::size_t i = same; i < handles.size(); ++i) {
    for (const std::int32_t v : handles[i].region->sites) {
      add.push_back(first + static_cast<std::int32_t>(add.size()));
      sites.push_back(solve::Site::at_vertex(core.mesh, v));
      sites.back().part = static_cast<std::int32_t>(i);
    }
  }
  if (remove.empty() && add.empty()) return;
  solve::SiteEdit edit;
  edit.remove = remove;
  edit.add = add;
  edit.sites = sites;
  edit.history_free = true;
  solver.edit(edit);
}

namespace {

// The solved channels by vertex, in the order of the factor where `row` is given.
struct Solved {
  const double* z;
  const std::int32_t* row;
  std::size_t width;
  const double* at(std::int32_t v) const noexcept { return z + width * static_cast<std::size_t>(row ? row[v] : v); }
};

// Makes fields of solved channels.
class FieldFinish final : public solve::FieldSink {
 public:
  FieldFinish(const surface::Core& core, const solve::SiteSolver& solver, const Handles& handles, const Reach& reach,
              std::int32_t channels, HandleFields& fields)
      : core_(core), solver_(solver), handles_(handles), reach_(reach), channels_(channels), fields_(fields) {}

  // A block that has all channels is read where it lies. Others are gathered first.
  void take(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) override {
    if (count == channels_) return finish({z, row, static_cast<std::size_t>(count)});
    const std::size_t width = static_cast<std::size_t>(channels_), block = static_cast<std::size_t>(count);
    if (!all_) all_.emplace(core_.workspaces, width * static_cast<std::size_t>(core_.size()));
    for_vertex_pieces(*core_.jobs, core_.size(), [&](std::int32_t from, std::int32_t to) {
      const Solved solved{z, row, block};
      for (std::int32_t v = from; v < to; ++v)
        std::copy_n(solved.at(v), block, all_->data() + width * static_cast<std::size_t>(v) + first);
    });
    if (first + count == channels_) finish({all_->data(), nullptr, width});
  }
  void finish(const Solved& solved) {
    measure_leak(solved);
    for_vertex_pieces(*core_.jobs, core_.size(), [&](std::int32_t first, std::int32_t last) {
      for (std::int32_t v = first; v < last; ++v)
        finish_vertex(v, solved.at(v), channels_, reach_.owner[v], reach_.handles_of(core_.mesh.component[v]), fields_);
    });
  }

 private:
  // The leak is the error of the fields on the handles' regions, where some ring vertices are no sites. It is measured
  // before any correction, in all components that have sites.
  void measure_leak(const Solved& solved) {
    const std::int32_t handle_count = static_cast<std::int32_t>(handles_.size());
    for (std::int32_t owner = 0; owner < handle_count; ++owner) {
      for (const std::int32_t v : handles_[owner].region->vertices) {
        if (solver_.site_count(core_.mesh.component[v]) == 0) continue;
        const double* u = solved.at(v);
        double others = 0;
        for (std::int32_t i = 0; i < handle_count; ++i) {
          const double value = i < channels_ ? u[i] : 1.0 - others;
          others += value;
          fields_.leak[i] = std::max(fields_.leak[i], std::fabs(value - (i == owner ? 1.0 : 0.0)));
        }
      }
    }
  }

  const surface::Core& core_;
  const solve::SiteSolver& solver_;
  const Handles& handles_;
  const Reach& reach_;
  std::int32_t channels_;
  HandleFields& fields_;
  std::optional<surface::Workspace> all_;
};

}  // namespace

HandleFields solve_handle_fields(const surface::Core& core, solve::SiteSolver& solver, const Handles& handles,
                                 const Reach& reach, Memory& memory) {
  const std::int32_t n = core.size(), channels = solved_channels(handles.size());
  HandleFields fields(n, static_cast<std::int32_t>(handles.size()), memory);
  const std::size_t width = static_cast<std::size_t>(channels);
  FieldFinish finish(core, solver, handles, reach, channels, fields);
  bool any_site = false;
  for (const Handle& handle : handles) any_site = any_site || !handle.region->sites.empty();
  if (!any_site) {
    surface::Workspace zeros(core.workspaces, width * static_cast<std::size_t>(n));
    std::fill_n(zeros.data(), width * static_cast<std::size_t>(n), 0.0);
    finish.finish({zeros.data(), nullptr, width});
    return fields;
  }
  Vector<double> values(width * static_cast<std::size_t>(solver.slot_count()), 0.0, &memory);
  std::size_t slot = 0;
  for (std::int32_t i = 0; i < channels; ++i) {
    for (std::size_t k = 0; k < handles[i].region->sites.size(); ++k, ++slot)
      values[width * slot + static_cast<std::size_t>(i)] = 1;
  }
  solver.solve_into(values.data(), channels, finish);
  return fields;
}

}  // namespace hf_inner::deform
