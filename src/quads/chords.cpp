#include "quads/chords.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner {
namespace {

// A chord whose mean edge has become longer than this many times the one it was sorted by waits for the next round:
// smaller spreads the removed chords more evenly, larger takes fewer rounds. Below 1 no chord would go. With 1.0, 16 of
// 21 runs stay the same, with 2.4 14 do; some of the others get better and some worse.
constexpr double later = 1.2;
// Two feature edges at a vertex that turn by more than 60 degrees make a corner, which stays: the cosine between them.
// With 30 degrees, 41 % fewer chords can go: a sheet with holes that should have 100 quads has 425 instead of 341. With
// 90 degrees 13 of 20 runs stay the same, and mean distances fall by 3 to 10 %.
constexpr double most_bend = -0.5;

class Collapser {
 public:
  Collapser(QuadComplex& quads, Memory& memory)
      : q_(quads),
        memory_(memory),
        dead_(quads.quad_count(), 0, memory),
        crossed_(quads.quad_count(), 0, memory),
        in_fan_(quads.tail.size(), 0, memory),
        leader_(quads.vertices.position.size(), none, memory),
        start_(leader_),
        place_(leader_),
        corners_(quads.vertices.position.size(), 0, memory),
        halves_(memory),
        classes_(memory),
        fan_(memory),
        neighbours_(memory),
        joins_(memory),
        undo_(memory) {
    Table<std::uint8_t> sides(q_.vertices.position.size(), 0, memory);
    for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
      if (!q_.feature[h] || (q_.twin[h] != none && q_.twin[h] < h)) continue;
      for (const std::int32_t v : {q_.tail[h], q_.head(h)})
        sides[v] = static_cast<std::uint8_t>(std::min(sides[v] + 1, 3));
    }
    for (std::int32_t v = 0; v < corners_.size(); ++v) corners_[v] = sides[v] == 1 || sides[v] > 2;
    bent_corners();
  }

  std::int32_t run(std::int32_t wanted, std::int32_t least) {
    std::int32_t alive = q_.quad_count(), removed = 0;
    struct Chord {
      double cost;
      std::int32_t half, quads;
    };
    Vector<Chord> list(&memory_);
    for (bool changed = true; changed && alive > wanted;) {
      changed = false;
      // Every chord by its first half-edge.
      list.clear();
      Table<std::uint8_t> seen(q_.tail.size(), 0, memory_);
      Poller poller;
      for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
        poller.due();
        if (dead_[h / 4] || seen[h]) continue;
        walk(h);
        for (const std::int32_t c : halves_) seen[c] = 1;
        list.push_back({mean_length(), h, static_cast<std::int32_t>(quads_)});
        clear_walk();
      }
      std::sort(list.begin(), list.end(),
                [](const Chord& a, const Chord& b) { return a.cost != b.cost ? a.cost < b.cost : a.half < b.half; });
      for (const Chord& chord : list) {
        poll();
        if (alive <= wanted) break;
        if (dead_[chord.half / 4]) continue;
        walk(chord.half);
        if (alive - quads_ >= least && mean_length() <= later * chord.cost && collapse()) {
          alive -= quads_, ++removed, changed = true;
        }
        clear_walk();
      }
    }
    if (removed > 0) {
      q_.remove(dead_, memory_);
      q_.split_fans(memory_);
    }
    return removed;
  }

 private:
  // Vertices where a feature turns sharply.
  void bent_corners() {
    Table<Vec3> before(corners_.size(), Vec3{}, memory_);
    Table<std::uint8_t> has(corners_.size(), 0, memory_);
    for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
      if (!q_.feature[h] || (q_.twin[h] != none && q_.twin[h] < h)) continue;
      const std::int32_t ends[2] = {q_.tail[h], q_.head(h)};
      for (int k = 0; k < 2; ++k) {
        const std::int32_t v = ends[k];
        const Vec3 way = unit_vector(q_.vertices.position[ends[1 - k]] - q_.vertices.position[v]);
        if (has[v] && dot(before[v], way) > most_bend) corners_[v] = 1;
        has[v] = 1, before[v] = way;
      }
    }
  }

  // Collects the half-edges that the chord through h crosses, each edge with both; counts its quads.
  void walk(std::int32_t h) {
    halves_.clear(), quads_ = 0;
    stack_push(h);
    for (std::int32_t i = 0; i < halves_.size(); ++i) {
      const std::int32_t g = halves_[i];
      stack_push(QuadComplex::opposite(g));
      if (q_.twin[g] != none) stack_push(q_.twin[g]);
    }
  }
  void stack_push(std::int32_t h) {
    const std::uint8_t bit = static_cast<std::uint8_t>(1 << (h % 4));
    if (crossed_[h / 4] & bit) return;
    if (!crossed_[h / 4]) ++quads_;
    crossed_[h / 4] = static_cast<std::uint8_t>(crossed_[h / 4] | bit);
    halves_.push_back(h);
  }
  void clear_walk() {
    for (const std::int32_t h : halves_) crossed_[h / 4] = 0;
  }
  double mean_length() const {
    double sum = 0;
    for (const std::int32_t h : halves_)
      sum += norm(q_.vertices.position[q_.head(h)] - q_.vertices.position[q_.tail[h]]);
    return sum / std::max(halves_.size(), 1);
  }
  bool is_crossed(std::int32_t h) const noexcept { return (crossed_[h / 4] >> (h % 4)) & 1; }

  std::int32_t find(std::int32_t v) noexcept {
    while (leader_[v] != v) v = leader_[v] = leader_[leader_[v]];
    return v;
  }
  std::int32_t class_of(std::int32_t v) noexcept { return leader_[v] == none ? v : find(v); }

  // Removes the chord of the last walk if the mesh stays valid.
  bool collapse() {
    classes_.clear(), joins_.clear();
    const bool good = plan();
    if (good) apply();
    for (const std::int32_t v : classes_) leader_[v] = none;
    return good;
  }

  bool plan() {
    const Table<std::uint8_t>&pinned = q_.vertices.pinned, &border = q_.vertices.border;
    for (const std::int32_t h : halves_) {
      for (const std::int32_t v : {q_.tail[h], q_.head(h)}) {
        if (leader_[v] == none) leader_[v] = v, classes_.push_back(v);
      }
    }
    std::int32_t merged = 0, edges = 0, twice = 0;
    for (const std::int32_t h : halves_) {
      twice += h % 4 == 0 && crossed_[h / 4] == 15;
      if (q_.twin[h] != none && q_.twin[h] < h) continue;
      ++edges;
      const std::int32_t v = q_.tail[h], w = q_.head(h);
      const bool held = pinned[v] != QuadMesh::free && pinned[w] != QuadMesh::free;
      if ((held && !q_.feature[h]) || (corners_[v] && corners_[w])) return false;
      if (border[v] && border[w] && q_.twin[h] != none) return false;
      const std::int32_t a = find(v), b = find(w);
      if (a == b) continue;
      leader_[std::max(a, b)] = std::min(a, b), ++merged;
    }
    // A circle of crossed edges may only be the sides of a quad that the chord crosses twice.
    if (merged != edges - twice) return false;
    // Quads on the two sides of the chord become neighbours.
    for (const std::int32_t h : halves_) {
      for (const std::int32_t side : {QuadComplex::next(h), QuadComplex::previous(h)}) {
        if (is_crossed(side)) continue;
        const std::int32_t g = q_.twin[side];
        if (g != none && crossed_[g / 4]) continue;
        std::int32_t across = side;
        std::uint8_t feature = q_.feature[side];
        while (true) {
          across = q_.twin[QuadComplex::opposite(across)];
          if (across == none) break;
          feature = static_cast<std::uint8_t>(feature | q_.feature[across]);
          if (!crossed_[across / 4]) break;
        }
        if (g == none && across == none) return false;
        joins_.push_back({g, across, feature});
      }
    }
    return check();
  }

  // Checks the fans of all merged vertices in the mesh as it will be.
  bool check() {
    // By class: a half-edge that leaves it in a quad that stays.
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g == none) continue;
        start_[find(q_.tail[g])] = g, start_[find(q_.head(g))] = QuadComplex::next(g);
      }
    }
    bool good = true;
    apply_joins(true);
    for (const std::int32_t v : classes_) {
      if (find(v) == v) good = good && start_[v] != none && check_fan(v);
    }
    if (good) {
      // All half-edges of the classes must lie in the fans that were walked.
      for (const Join& j : joins_) {
        for (const std::int32_t g : {j.a, j.b})
          good = good && (g == none || (in_fan_[g] && in_fan_[QuadComplex::next(g)]));
      }
    }
    for (const std::int32_t h : fan_) in_fan_[h] = 0;
    fan_.clear();
    for (const std::int32_t v : classes_) start_[v] = none;
    if (!good) apply_joins(false);
    return good;
  }

  void apply_joins(bool forward) {
    if (forward) {
      undo_.clear();
      for (const Join& j : joins_) {
        for (const std::int32_t g : {j.a, j.b}) {
          if (g != none) undo_.push_back({g, q_.twin[g]});
        }
      }
      for (const Join& j : joins_) q_.join(j.a, j.b);
    } else {
      for (const Undo& u : undo_) q_.twin[u.half] = u.twin;
    }
  }

  bool check_fan(std::int32_t c) {
    neighbours_.clear();
    std::int32_t first = start_[c], corners = 0;
    bool border = false;
    for (std::int32_t h = first;;) {
      if (q_.twin[h] == none) {
        first = h, border = true;
        break;
      }
      h = QuadComplex::next(q_.twin[h]);
      if (h == first) break;
    }
    for (std::int32_t h = first; h != none;) {
      if (class_of(q_.tail[h]) != c || in_fan_[h]) return false;
      in_fan_[h] = 1, fan_.push_back(h), ++corners;
      neighbours_.push_back(class_of(q_.head(h)));
      const std::int32_t far = class_of(q_.head(QuadComplex::next(h)));
      if (far == c) return false;
      const std::int32_t last = QuadComplex::previous(h);
      if (q_.twin[last] == none) neighbours_.push_back(class_of(q_.tail[last]));
      h = q_.twin[last];
      if (h == first) break;
    }
    if (!border && corners < 3) return false;
    std::sort(neighbours_.begin(), neighbours_.end());
    for (std::int32_t i = 0; i < neighbours_.size(); ++i) {
      if (neighbours_[i] == c || (i > 0 && neighbours_[i] == neighbours_[i - 1])) return false;
    }
    return true;
  }

  void apply() {
    // The joins are done. Vertices of a class take the place of the best: a corner, a feature, a border, the middle.
    QuadMesh& all = q_.vertices;
    Table<Vec3> sum(memory_);
    Table<std::int32_t> count(memory_);
    for (const std::int32_t v : classes_) {
      const std::int32_t c = find(v);
      if (place_[c] == none) place_[c] = sum.size(), sum.push_back(Vec3{}), count.push_back(0);
      sum[place_[c]] = sum[place_[c]] + all.position[v], ++count[place_[c]];
    }
    Table<std::int32_t> best(sum.size(), none, memory_);
    const auto rank = [&](std::int32_t v) {
      return corners_[v] ? 3 : all.pinned[v] != QuadMesh::free ? 2 : all.border[v] ? 1 : 0;
    };
    const auto away = [&](std::int32_t v, std::int32_t i) { return norm(all.position[v] - (1.0 / count[i]) * sum[i]); };
    for (const std::int32_t v : classes_) {
      const std::int32_t i = place_[find(v)];
      if (best[i] == none || rank(v) > rank(best[i]) || (rank(v) == rank(best[i]) && away(v, i) < away(best[i], i)))
        best[i] = v;
    }
    for (const std::int32_t h : halves_) dead_[h / 4] = 1;
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g != none) q_.feature[g] = j.feature;
      }
    }
    // Half-edges around the classes are those of the joins' fans.
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g == none) continue;
        rename(g, best), rename(QuadComplex::next(g), best);
      }
    }
    for (const std::int32_t v : classes_) place_[v] = none;
  }
  // Gives the whole fan of h its new vertex.
  void rename(std::int32_t h, const Table<std::int32_t>& best) {
    const std::int32_t v = q_.tail[h];
    if (leader_[v] == none) return;
    const std::int32_t to = best[place_[find(v)]];
    std::int32_t first = h;
    while (q_.twin[first] != none) {
      first = QuadComplex::next(q_.twin[first]);
      if (first == h) break;
    }
    for (std::int32_t g = first; g != none;) {
      q_.tail[g] = to;
      g = q_.twin[QuadComplex::previous(g)];
      if (g == first) break;
    }
  }

  struct Join {
    std::int32_t a, b;
    std::uint8_t feature;
  };
  struct Undo {
    std::int32_t half, twin;
  };
  QuadComplex& q_;
  Memory& memory_;
  Table<std::uint8_t> dead_, crossed_;          // by quad; crossed_: one bit for every side that the chord crosses
  Table<std::uint8_t> in_fan_;                  // by half-edge
  Table<std::int32_t> leader_, start_, place_;  // by vertex: of the classes of vertices that become one
  Table<std::uint8_t> corners_;                 // by vertex: whether it must stay
  Table<std::int32_t> halves_, classes_, fan_, neighbours_;
  Table<Join> joins_;
  Table<Undo> undo_;
  std::int32_t quads_ = 0;  // of the chord
};

}  // namespace

std::int32_t collapse_chords(QuadComplex& quads, std::int32_t wanted, std::int32_t least, Memory& memory) {
  return quads.quad_count() > wanted ? Collapser(quads, memory).run(wanted, least) : 0;
}

}  // namespace hf_inner
