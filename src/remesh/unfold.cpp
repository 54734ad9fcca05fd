#include "remesh/unfold.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "remesh/constants.h"
#include "remesh/relax.h"

namespace hf_inner::remesh {
namespace {

Vec3 area_vector(const Vec3* p) noexcept { return cross(p[2] - p[0], p[3] - p[1]); }

class Unfolder {
 public:
  Unfolder(const FluxSurface& surface, double edge_length, QuadMesh& mesh, Memory& memory)
      : surface_(surface),
        edge_length_(edge_length),
        mesh_(mesh),
        memory_(memory),
        fans_(mesh, memory),
        old_position_(memory),
        old_location_(memory) {
    old_position_ = mesh.position;
    old_location_ = mesh.location;
  }

  // Returns whether any vertex moved.
  bool run() {
    Table<std::int32_t> todo(memory_);
    bool moved = false;
    for (std::int32_t round = 0; round < unfold_rounds; ++round) {
      poll();
      gather(todo);
      if (todo.size() == 0) break;
      bool any = false;
      for (std::int32_t i = 0; i < todo.size(); ++i) any = improve(todo[i]) || any;
      moved = moved || any;
      if (!any) break;
    }
    return moved;
  }

  // Takes back the moves of vertices that are farther from the surface than before.
  double hold(const QuadDistance& distance, double away) {
    Vector<QuadMiss> misses(&memory_);
    for (std::int32_t round = 0; round < unfold_returns; ++round) {
      distance.turn_quads(mesh_);
      misses.clear();
      const double now = distance.measure(mesh_, away, &misses);
      if (misses.empty()) return std::min(now, away);
      Table<std::uint8_t> back(mesh_.position.size(), 0, memory_);
      for (const QuadMiss& miss : misses) {
        for (std::int32_t k = 0; k < 4; ++k) back[mesh_.quad(miss.face)[k]] = 1;
      }
      grow_marks(mesh_, round, back);
      for (std::int32_t v = 0; v < mesh_.position.size(); ++v) {
        if (back[v]) restore(v);
      }
    }
    for (std::int32_t v = 0; v < mesh_.position.size(); ++v) restore(v);
    distance.turn_quads(mesh_);
    return away;
  }

 private:
  static constexpr std::int32_t none = -1;

  // The vertices of quads with a turned corner that may move.
  void gather(Table<std::int32_t>& todo) const {
    Table<std::uint8_t> marked(mesh_.position.size(), 0, memory_);
    for (std::int32_t f = 0; f < mesh_.face_count(); ++f) {
      if (least_sine(f) > 0) continue;
      for (std::int32_t k = 0; k < 4; ++k) marked[mesh_.quad(f)[k]] = 1;
    }
    todo.clear();
    for (std::int32_t v = 0; v < mesh_.position.size(); ++v) {
      if (marked[v] && (mesh_.border[v] || mesh_.pinned[v] != QuadMesh::feature)) todo.push_back(v);
    }
  }

  // Calls use(sine) for each corner of a quad.
  template <class Use>
  void for_sines(std::int32_t f, Use&& use) const {
    const std::int32_t* c = mesh_.quad(f);
    const Vec3 p[4] = {mesh_.position[c[0]], mesh_.position[c[1]], mesh_.position[c[2]], mesh_.position[c[3]]};
    const Vec3 n = unit(area_vector(p));
    for (std::int32_t k = 0; k < 4; ++k) use(dot(cross(unit(p[(k + 1) % 4] - p[k]), unit(p[(k + 3) % 4] - p[k])), n));
  }
  double least_sine(std::int32_t f) const {
    double least = 1;
    for_sines(f, [&](double sine) { least = std::min(least, sine); });
    return least;
  }
  double energy(std::int32_t v) const {
    double sum = 0;
    for (std::int32_t i = fans_.start[v]; i < fans_.start[v + 1]; ++i) {
      for_sines(fans_.face[i], [&](double sine) {
        const double miss = std::max(0.0, unfold_margin - sine);
        sum += miss * miss;
      });
    }
    return sum;
  }

  // A vertex and the best of the places that it was offered.
  struct Best {
    std::int32_t vertex;
    SurfacePoint place;
    Vec3 position;
    double before, energy;
  };
  Best start(std::int32_t v) const {
    const double before = energy(v);
    return {v, mesh_.location[v], mesh_.position[v], before, before};
  }
  void offer(const SurfacePoint& place, Best& best) {
    mesh_.position[best.vertex] = position_of(surface_, place);
    const double e = energy(best.vertex);
    if (e < best.energy) {
      best.energy = e;
      best.place = place;
      best.position = mesh_.position[best.vertex];
    }
  }
  // Moves the vertex to the best place. Returns whether it moved.
  bool take(const Best& best) {
    mesh_.position[best.vertex] = best.position;
    mesh_.location[best.vertex] = best.place;
    return best.energy < best.before;
  }

  bool improve(std::int32_t v) { return mesh_.border[v] ? slide(v) : move(v); }

  // Moves a vertex to the best of some places around it. Returns whether it moved.
  bool move(std::int32_t v) {
    const SurfacePoint from = mesh_.location[v];
    const Vec3 origin = mesh_.position[v];
    Best best = start(v);
    Vec3 centre;
    std::int32_t count = 0;
    Vec3 normal;
    for (std::int32_t i = fans_.start[v]; i < fans_.start[v + 1]; ++i) {
      const std::int32_t* c = mesh_.quad(fans_.face[i]);
      const Vec3 p[4] = {mesh_.position[c[0]], mesh_.position[c[1]], mesh_.position[c[2]], mesh_.position[c[3]]};
      normal = normal + area_vector(p);
      for (std::int32_t k = 0; k < 4; ++k) {
        if (c[k] != v) {
          centre = centre + mesh_.position[c[k]];
          ++count;
        }
      }
    }
    const Vec3 axis = std::fabs(normal.x) < std::fabs(normal.y) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = unit(cross(normal, axis)), y = unit(cross(normal, x));
    for (double length = unfold_reach * edge_length_; length > unfold_least * edge_length_; length *= 0.5) {
      for (const double a : {-1.0, 0.0, 1.0}) {
        for (const double b : {-1.0, 0.0, 1.0}) {
          if (a == 0 && b == 0) continue;
          offer(walk_surface(surface_, from, length * (a * x + b * y)), best);
        }
      }
      if (best.energy < best.before) break;
    }
    if (count > 0) offer(walk_surface(surface_, from, (1.0 / count) * centre - origin), best);
    return take(best);
  }

  // The half-edge of the border that a place lies on, or none.
  std::int32_t border_edge(const SurfacePoint& place) const {
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t h = 3 * place.triangle + k;
      if (!surface_.is_real(surface_.twin[h]) && std::fabs(place.weight[(k + 2) % 3]) < on_border) return h;
    }
    return none;
  }
  std::int32_t next_border(std::int32_t h) const {
    h = FluxSurface::next(h);
    while (surface_.is_real(surface_.twin[h])) h = FluxSurface::next(surface_.twin[h]);
    return h;
  }
  std::int32_t previous_border(std::int32_t h) const {
    h = FluxSurface::previous(h);
    while (surface_.is_real(surface_.twin[h])) h = FluxSurface::previous(surface_.twin[h]);
    return h;
  }
  Vec3 vector_of(std::int32_t h) const {
    return surface_.position[surface_.head(h)] - surface_.position[surface_.tail[h]];
  }
  bool is_straight(std::int32_t h, std::int32_t g) const {
    return dot(unit(vector_of(h)), unit(vector_of(g))) > straight_border;
  }

  // Whether a place of vertex v is away from the other corners of its quads.
  bool is_apart(std::int32_t v, Vec3 place) const {
    for (std::int32_t i = fans_.start[v]; i < fans_.start[v + 1]; ++i) {
      const std::int32_t* c = mesh_.quad(fans_.face[i]);
      for (std::int32_t k = 0; k < 4; ++k) {
        const double before = norm(mesh_.position[c[k]] - old_position_[v]);
        if (c[k] != v && norm(mesh_.position[c[k]] - place) < unfold_apart * std::min(edge_length_, before))
          return false;
      }
    }
    return true;
  }

  // Moves a vertex of a border along it, but not over its corners. Returns whether it moved.
  bool slide(std::int32_t v) {
    const SurfacePoint from = mesh_.location[v];
    const std::int32_t edge = border_edge(from);
    if (edge == none) return false;
    Best best = start(v);
    const double share = from.weight[(edge + 1) % 3];  // of the way along the edge
    if (share < on_border && !is_straight(previous_border(edge), edge)) return false;
    if (share > 1 - on_border && !is_straight(edge, next_border(edge))) return false;
    for (double length = unfold_reach * edge_length_; length > unfold_least * edge_length_; length *= 0.5) {
      for (const bool forward : {false, true}) {
        std::int32_t h = edge;
        double at = share, left = length;
        while (true) {
          const double size = norm(vector_of(h)), rest = (forward ? 1 - at : at) * size;
          if (rest >= left) {
            at += (forward ? left : -left) / size;
            SurfacePoint place;
            place.triangle = h / 3;
            place.weight[h % 3] = 1 - at;
            place.weight[(h + 1) % 3] = at;
            if (is_apart(v, position_of(surface_, place))) offer(place, best);
            break;
          }
          const std::int32_t g = forward ? next_border(h) : previous_border(h);
          if (!is_straight(h, g) || g == edge) break;
          left -= rest;
          h = g;
          at = forward ? 0 : 1;
        }
      }
      if (best.energy < best.before) break;
    }
    return take(best);
  }

  void restore(std::int32_t v) {
    mesh_.position[v] = old_position_[v];
    mesh_.location[v] = old_location_[v];
  }

  const FluxSurface& surface_;
  double edge_length_;
  QuadMesh& mesh_;
  Memory& memory_;
  VertexFans fans_;
  Table<Vec3> old_position_;
  Table<SurfacePoint> old_location_;
};

}  // namespace

void unfold_corners(const FluxSurface& surface, double edge_length, QuadMesh& mesh, Memory& memory) {
  Unfolder(surface, edge_length, mesh, memory).run();
}

double unfold_quads(const FluxSurface& surface, const QuadDistance& distance, double edge_length, double away,
                    QuadMesh& mesh, Memory& memory) {
  Unfolder unfolder(surface, edge_length, mesh, memory);
  return unfolder.run() ? unfolder.hold(distance, away) : away;
}

}  // namespace hf_inner::remesh
