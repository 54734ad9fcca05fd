#include "remesh/fit.h"

#include <algorithm>
#include <cmath>

#include "base/stable_sort.h"
#include "remesh/coarsen.h"
#include "remesh/constants.h"
#include "remesh/quad_faults.h"
#include "remesh/refine.h"
#include "remesh/relax.h"
#include "remesh/unfold.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

enum Step : std::int32_t { release, snap, split, widen, subdivide, collapse, given_up };

struct Place {
  QuadMiss miss;
  std::int32_t vertex = none;  // the vertex that the step changes
  double before = 0, after = 0;
  QuadFaults faults_before, faults_after;
};

struct Tried {
  Vec3 point;
  std::int32_t step;  // the step (release, snap, ...) to try next
};

class Fitter {
 public:
  Fitter(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, const FitOptions& options,
         Memory& memory)
      : surface_(surface),
        distance_(distance),
        mesh_(mesh),
        options_(options),
        memory_(memory),
        misses_(&memory),
        after_(&memory),
        tried_(&memory),
        known_(memory),
        most_faces_(static_cast<std::int32_t>(fit_most_faces * mesh.face_count())) {}

  double run() {
    double deviation = measure(mesh_, misses_);
    Vector<Place> chosen(&memory_);
    for (std::int32_t round = 0; round < fit_rounds && !misses_.empty(); ++round) {
      report(static_cast<float>(round) / static_cast<float>(fit_rounds));
      const std::int32_t step = choose(chosen);
      if (step == given_up) break;
      if (chosen.empty()) continue;
      QuadMesh trial = mesh_;
      take(step, chosen, trial);
      unfold_corners(surface_, options_.edge_length, trial, memory_);
      double now = measure(trial, after_);
      compare(trial, chosen);
      const auto helped = [&](const Place& place) {
        return place.after < fit_gain * place.before && place.faults_after.turned <= place.faults_before.turned &&
               place.faults_after.crossing <= place.faults_before.crossing;
      };
      const auto failed = chosen.begin() + static_cast<std::ptrdiff_t>(stable_partition(chosen, helped, memory_));
      for (auto place = failed; place != chosen.end(); ++place) next_step(place->miss.point, step + 1);
      for (auto place = chosen.begin(); place != failed; ++place) next_step(place->miss.point, release);
      if (failed == chosen.begin()) continue;
      if (failed != chosen.end()) {
        chosen.erase(failed, chosen.end());
        trial = mesh_;
        take(step, chosen, trial);
        unfold_corners(surface_, options_.edge_length, trial, memory_);
        now = measure(trial, after_);
        if (total(after_) >= total(misses_)) {
          for (const Place& place : chosen) next_step(place.miss.point, step + 1);
          continue;
        }
      }
      mesh_ = std::move(trial);
      misses_.swap(after_);
      deviation = now;
    }
    return deviation;
  }

 private:
  double measure(QuadMesh& mesh, Vector<QuadMiss>& misses) {
    distance_.turn_quads(mesh, &known_);
    misses.clear();
    return distance_.measure(mesh, options_.tolerance, &misses, &known_);
  }
  double excess(const QuadMiss& miss) const {
    return miss.distance * miss.distance - options_.tolerance * options_.tolerance;
  }
  double total(const Vector<QuadMiss>& misses) const {
    double sum = 0;
    for (const QuadMiss& miss : misses) sum += excess(miss);
    return sum;
  }

  Tried* find_tried(const Vec3& point) {
    Tried* best = nullptr;
    for (Tried& tried : tried_)
      if (norm(tried.point - point) < fit_same_place * options_.edge_length &&
          (!best || norm(tried.point - point) < norm(best->point - point)))
        best = &tried;
    return best;
  }
  void next_step(const Vec3& point, std::int32_t step) {
    if (Tried* tried = find_tried(point)) {
      tried->step = step;
    } else {
      tried_.push_back({point, step});
    }
  }

  // Tells whether a vertex of the surface is on a border.
  bool on_border(std::int32_t v) const {
    std::int32_t h = surface_.out[v];
    do {
      if (!surface_.is_real(h)) return true;
      h = surface_.turn_left(h);
    } while (h != surface_.out[v]);
    return false;
  }

  std::int32_t component_of(const SurfacePoint& point) const {
    return surface_.component[surface_.tail[3 * point.triangle]];
  }

  // Returns the vertex that a fitting step (release, snap, ...) would change. It is a corner of the quad at a missed
  // place: the nearest one for which the step is allowed.
  std::int32_t vertex_for(std::int32_t step, const QuadMiss& miss, const VertexFans& fans) const {
    const std::int32_t f = miss.face, *c = mesh_.quad(f);
    if (step == collapse) return can_collapse(mesh_, fans, f, 0) || can_collapse(mesh_, fans, f, 1) ? c[0] : none;
    if (step > snap && mesh_.face_count() >= most_faces_) return none;
    std::int32_t best = none;
    const std::int32_t component = component_of(target(miss));
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t v = c[k];
      bool may = !mesh_.border[v] || (step == snap && miss.vertex >= 0 && on_border(miss.vertex));
      // A place of a lost component does not draw vertices of others.
      if (step == snap || step == split) may = may && component_of(mesh_.location[v]) == component;
      if (step == release) may = may && mesh_.pinned[v] == QuadMesh::snapped && miss.vertex == QuadMiss::of_quads;
      if (step == snap) may = may && !mesh_.pinned[v];
      if (step == split || step == widen) may = may && fans.valence(v) >= 4;
      if (may && (best == none || norm(mesh_.position[v] - miss.point) < norm(mesh_.position[best] - miss.point)))
        best = v;
    }
    return best;
  }

  // Chooses the fitting step (release, snap, ...) of this round: the earliest one that any place too far from the
  // surface still has to try. The list `chosen` gets the places with this step. No two of them are near each other.
  std::int32_t choose(Vector<Place>& chosen) {
    Vector<Place> places(&memory_);
    std::int32_t step = given_up;
    for (const QuadMiss& miss : misses_) {
      const Tried* tried = find_tried(miss.point);
      if (tried && tried->step == given_up) continue;
      const bool near_one = std::any_of(places.begin(), places.end(), [&](const Place& place) {
        return norm(place.miss.point - miss.point) < options_.edge_length;
      });
      if (near_one) continue;
      Place place;
      place.miss = miss;
      places.push_back(place);
      step = std::min(step, tried ? tried->step : std::int32_t{release});
    }
    chosen.clear();
    const VertexFans fans(mesh_, memory_);
    Table<std::uint8_t> blocked(mesh_.position.size(), 0, memory_), around = blocked;
    for (Place& place : places) {
      const Tried* tried = find_tried(place.miss.point);
      if ((tried ? tried->step : std::int32_t{release}) != step) continue;
      place.vertex = vertex_for(step, place.miss, fans);
      if (place.vertex == none) {
        next_step(place.miss.point, step + 1);
        continue;
      }
      if (blocked[place.vertex]) continue;
      chosen.push_back(place);
      around.assign(around.size(), 0);
      around[place.vertex] = 1;
      grow_marks(mesh_, fit_apart, around);
      for (std::int32_t v = 0; v < around.size(); ++v) blocked[v] = blocked[v] || around[v];
    }
    return step;
  }

  // Returns the surface point to which a missed place of the mesh should come.
  SurfacePoint target(const QuadMiss& miss) const {
    SurfacePoint at;
    if (miss.vertex < 0) return distance_.nearest(miss.point);
    std::int32_t h = surface_.out[miss.vertex];
    while (!surface_.is_real(h)) h = surface_.turn_left(h);
    at.triangle = h / 3;
    at.weight[h % 3] = 1;
    return at;
  }

  void put(QuadMesh& mesh, std::int32_t v, const SurfacePoint& at, std::uint8_t pin) const {
    mesh.location[v] = at;
    mesh.position[v] = position_of(surface_, at);
    mesh.pinned[v] = pin;
  }

  void relax(QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& moving) const {
    grow_marks(mesh, rings, moving);
    RelaxOptions relax;
    relax.rounds = fit_relax_rounds;
    relax.edge_length = options_.edge_length;
    relax.moving = &moving;
    relax_quads(surface_, mesh, relax, memory_);
  }

  void take(std::int32_t step, const Vector<Place>& places, QuadMesh& mesh) const {
    Table<std::uint8_t> moving(mesh.position.size(), 0, memory_);
    if (step == collapse) {
      Vector<QuadMiss> list(&memory_);
      for (const Place& place : places) list.push_back(place.miss);
      collapse_misses(surface_, mesh, list, moving, memory_);
      return relax(mesh, fit_rings, moving);
    }
    if (step == subdivide) {
      for (const Place& place : places) moving[place.vertex] = 1;
      refine_quads(surface_, mesh, moving, memory_);
      moving.resize(mesh.position.size(), 1);
      relax(mesh, fit_rings, moving);
      snap_nearest(places, mesh, moving);
      return relax(mesh, fit_resnap_rings, moving);
    }
    for (const Place& place : places) {
      moving[place.vertex] = 1;
      if (step == release) {
        const std::int32_t* c = mesh.quad(place.miss.face);
        for (std::int32_t k = 0; k < 4; ++k)
          if (mesh.pinned[c[k]] == QuadMesh::snapped) {
            mesh.pinned[c[k]] = QuadMesh::free;
            moving[c[k]] = 1;
          }
        continue;
      }
      if (step == snap) {
        put(mesh, place.vertex, target(place.miss), QuadMesh::snapped);
        continue;
      }
      const std::int32_t v = split_vertex(mesh, place.vertex, place.miss.point, memory_);
      moving.push_back(1);
      if (step == split) put(mesh, v, target(place.miss), QuadMesh::snapped);
      if (step == widen)
        put(mesh, v, walk_surface(surface_, mesh.location[v], 0.5 * (place.miss.point - mesh.position[v])),
            QuadMesh::free);
    }
    relax(mesh, fit_rings + (step <= snap ? fit_snap_rings : 0), moving);
  }

  // For each missed place, snaps the nearest vertex that may move to it.
  void snap_nearest(const Vector<Place>& places, QuadMesh& mesh, const Table<std::uint8_t>& moving) const {
    for (const Place& place : places) {
      std::int32_t best = none;
      const std::int32_t component = component_of(target(place.miss));
      for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
        if (!moving[v] || mesh.pinned[v] || mesh.border[v]) continue;
        if (component_of(mesh.location[v]) != component) continue;
        if (best == none || norm(mesh.position[v] - place.miss.point) < norm(mesh.position[best] - place.miss.point))
          best = v;
      }
      if (best != none) put(mesh, best, target(place.miss), QuadMesh::snapped);
    }
  }

  void compare(const QuadMesh& trial, Vector<Place>& places) const {
    for (Place& place : places) {
      const double radius = fit_reach * options_.edge_length;
      for (const QuadMiss& miss : misses_)
        if (norm(miss.point - place.miss.point) < radius) place.before += excess(miss);
      for (const QuadMiss& miss : after_)
        if (norm(miss.point - place.miss.point) < radius) place.after += excess(miss);
      place.faults_before = faults_near(mesh_, place.miss.point, radius, memory_);
      place.faults_after = faults_near(trial, place.miss.point, radius, memory_);
    }
  }

  const FluxSurface& surface_;
  const QuadDistance& distance_;
  QuadMesh& mesh_;
  const FitOptions& options_;
  Memory& memory_;
  Vector<QuadMiss> misses_, after_;  // places too far from the surface, in mesh_ and in the trial
  Vector<Tried> tried_;
  NearFaces known_;
  std::int32_t most_faces_;
};

}  // namespace

double fit_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, const FitOptions& options,
                 Memory& memory) {
  return Fitter(surface, distance, mesh, options, memory).run();
}

}  // namespace hf_inner::remesh
