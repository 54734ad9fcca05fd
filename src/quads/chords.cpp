#include "quads/chords.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// A chord waits for the next round if its mean edge has become longer than this many times the one it was sorted by.
// Smaller spreads the removed chords more evenly, larger takes fewer rounds. Below 1 no chord would go. With 1.0 and
// 2.4, 14 or more of 21 runs stay the same. Some of the others get better and some worse.
constexpr double later = 1.2;
// Two feature edges at a vertex that turn by more than 60 degrees make a corner, which stays: the cosine between them.
// With 30 degrees, 41 % fewer chords can go. A sheet with holes that should have 100 quads then has 425 instead of 341.
// With 90 degrees 13 of 20 runs stay the same. Mean distances of the others fall by 3 to 10 %.
constexpr double most_bend = -0.5;

// A closed row of quads keeps at least so many: around a rod, or along it over both its ends. With 2 a box of six quads
// can become two flat ones. In 33 runs of models with parts, 4 and 2 differ in one. Its largest distance is 4.1 % with
// 4 and 6.9 % with 2.
constexpr std::int32_t least_ring = 4;

class Collapser {
 public:
  Collapser(QuadComplex& quads, std::int32_t hub, Memory& memory)
      : q_(quads),
        most_walked_(hub),
        memory_(memory),
        dead_(quads.quad_count(), 0, memory),
        crossed_(quads.quad_count(), 0, memory),
        in_fan_(quads.tail.size(), 0, memory),
        leader_(quads.vertices.position.size(), none, memory),
        start_(leader_),
        place_(leader_),
        hub_(leader_),
        gaps_(quads.vertices.position.size(), 0, memory),
        quads_at_(gaps_),
        piece_(quads.quad_count(), none, memory),
        size_(memory),
        corners_(quads.vertices.position.size(), 0, memory),
        at_border_(corners_),
        halves_(memory),
        classes_(memory),
        fan_(memory),
        neighbours_(memory),
        moved_(memory),
        joins_(memory),
        undo_(memory) {
    remesh::Table<std::uint8_t> sides(q_.vertices.position.size(), 0, memory);
    for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
      if (!q_.feature[h] || (q_.twin[h] != none && q_.twin[h] < h)) continue;
      for (const std::int32_t v : {q_.tail[h], q_.head(h)})
        sides[v] = static_cast<std::uint8_t>(std::min(sides[v] + 1, 3));
    }
    find_pieces();
    for (std::int32_t v = 0; v < corners_.size(); ++v) corners_[v] = sides[v] == 1 || sides[v] > 2;
    bent_corners();
    for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
      ++quads_at_[q_.tail[h]];
      if (q_.twin[h] == none) at_border_[q_.tail[h]] = at_border_[q_.head(h)] = 1;
    }
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
      remesh::Table<std::uint8_t> seen(q_.tail.size(), 0, memory_);
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
          alive -= quads_;
          ++removed;
          changed = true;
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
  void find_pieces() {
    remesh::Table<std::int32_t> stack(memory_);
    for (std::int32_t f = 0; f < q_.quad_count(); ++f) {
      if (piece_[f] != none) continue;
      piece_[f] = size_.size();
      size_.push_back(0);
      stack.push_back(f);
      while (!stack.empty()) {
        const std::int32_t g = stack.back();
        stack.pop_back();
        ++size_[piece_[g]];
        for (std::int32_t h = 4 * g; h < 4 * g + 4; ++h) {
          const std::int32_t next = q_.twin[h] == none ? none : q_.twin[h] / 4;
          if (next != none && piece_[next] == none) {
            piece_[next] = piece_[g];
            stack.push_back(next);
          }
        }
      }
    }
  }

  // Vertices where a feature turns sharply.
  void bent_corners() {
    remesh::Table<Vec3> before(corners_.size(), Vec3{}, memory_);
    remesh::Table<std::uint8_t> has(corners_.size(), 0, memory_);
    for (std::int32_t h = 0; h < q_.tail.size(); ++h) {
      if (!q_.feature[h] || (q_.twin[h] != none && q_.twin[h] < h)) continue;
      const std::int32_t ends[2] = {q_.tail[h], q_.head(h)};
      for (int k = 0; k < 2; ++k) {
        const std::int32_t v = ends[k];
        const Vec3 way = unit_vector(q_.vertices.position[ends[1 - k]] - q_.vertices.position[v]);
        if (has[v] && dot(before[v], way) > most_bend) corners_[v] = 1;
        has[v] = 1;
        before[v] = way;
      }
    }
  }

  // Collects the half-edges that the chord through h crosses, each edge with both; counts its quads.
  void walk(std::int32_t h) {
    halves_.clear();
    quads_ = 0;
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
    classes_.clear();
    joins_.clear();
    moved_.clear();
    const bool good = plan();
    if (good) apply();
    for (const std::int32_t v : classes_) leader_[v] = hub_[v] = none;
    return good;
  }

  bool plan() {
    // Three quads around a point are a triangle, which one quad is not.
    if (quads_ == 2 && size_[piece_[halves_[0] / 4]] == 3) return false;
    const remesh::Table<std::uint8_t>&pinned = q_.vertices.pinned, &border = q_.vertices.border;
    for (const std::int32_t h : halves_) {
      for (const std::int32_t v : {q_.tail[h], q_.head(h)}) {
        if (leader_[v] == none) {
          leader_[v] = v;
          classes_.push_back(v);
        }
      }
    }
    std::int32_t merged = 0, edges = 0, twice = 0;
    for (const std::int32_t h : halves_) {
      twice += h % 4 == 0 && crossed_[h / 4] == 15;
      if (q_.twin[h] != none && q_.twin[h] < h) continue;
      ++edges;
      const std::int32_t v = q_.tail[h], w = q_.head(h);
      const bool held = pinned[v] != remesh::QuadMesh::free && pinned[w] != remesh::QuadMesh::free;
      if ((held && !q_.feature[h]) || (corners_[v] && corners_[w])) return false;
      if (border[v] && border[w] && q_.twin[h] != none) return false;
      const std::int32_t a = find(v), b = find(w);
      if (a == b) continue;
      leader_[std::max(a, b)] = std::min(a, b);
      ++merged;
    }
    if (!keeps_rings()) return false;
    // A circle of crossed edges may only be the sides of a quad that the chord crosses twice.
    if (merged != edges - twice) return false;
    if (!find_hubs(twice)) return false;
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

  // Whether every closed row of quads across the chord keeps enough of them.
  bool keeps_rings() const noexcept {
    for (const std::int32_t h : halves_) {
      if (is_crossed(QuadComplex::next(h))) continue;
      const std::int32_t first = QuadComplex::next(h);
      std::int32_t left = 0, quads = 0;
      for (std::int32_t g = first; g != none && quads < 2 * least_ring;) {
        left += !crossed_[g / 4];
        ++quads;
        g = q_.twin[QuadComplex::opposite(g)];
        if (g == first && left < least_ring) return false;
        if (g == first) break;
      }
    }
    return true;
  }

  bool is_hub(std::int32_t v) const noexcept { return quads_at_[v] > most_walked_; }

  // Finds the classes that have a hub, and checks them in the mesh as it is. A tree of edges that becomes a point
  // leaves one fan, with one gap if the tree meets the border once. So faults can only lie at the vertices that join
  // the hub.
  bool find_hubs(std::int32_t twice) {
    bool any = false;
    for (const std::int32_t v : classes_) {
      if (!is_hub(v)) continue;
      std::int32_t& hub = hub_[find(v)];
      if (hub != none || twice > 0) return false;
      hub = v;
      any = true;
    }
    if (!any) return true;
    for (const std::int32_t v : classes_) gaps_[find(v)] += at_border_[v];
    for (const std::int32_t h : halves_) {
      start_[q_.tail[h]] = h;
      start_[q_.head(h)] = QuadComplex::next(h);
      gaps_[find(q_.tail[h])] -= q_.twin[h] == none;
    }
    bool good = true;
    for (const std::int32_t v : classes_) {
      const std::int32_t c = find(v);
      if (hub_[c] != none) good = good && gaps_[c] <= 1 && (v == hub_[c] ? keeps_quads(v) : check_around(v, c));
    }
    for (const std::int32_t v : classes_) {
      gaps_[v] = 0;
      start_[v] = none;
    }
    return good;
  }
  bool keeps_quads(std::int32_t hub) const noexcept {
    std::int32_t left = quads_at_[hub];
    for (const std::int32_t h : halves_) left -= q_.tail[h] == hub || q_.head(h) == hub;
    return left >= 3;
  }
  // Checks the faces around v, which joins the hub of class c, and notes its half-edges in moved_.
  bool check_around(std::int32_t v, std::int32_t c) {
    const std::int32_t first = first_of_fan(start_[v]);
    for (std::int32_t h = first; h != none;) {
      const std::int32_t last = QuadComplex::previous(h);
      if (!crossed_[h / 4]) {
        moved_.push_back(h);
        // A quad with a third corner in the class has two of its edges at a neighbour.
        if (!check_edge(QuadComplex::next(h), c) || !check_edge(last, c)) return false;
      }
      h = q_.twin[last];
      if (h == first) break;
    }
    return true;
  }
  // Whether the vertex that h leaves will have one edge to class c. check_fan counts the edges of a class.
  bool check_edge(std::int32_t h, std::int32_t c) {
    const std::int32_t v = q_.tail[h];
    if (leader_[v] != none) return find(v) != c && hub_[find(v)] == none;
    if (is_hub(v)) return false;
    std::int32_t edges = 0;
    const std::int32_t first = first_of_fan(h);
    for (std::int32_t g = first; g != none;) {
      edges += class_of(q_.head(g)) == c;
      const std::int32_t last = QuadComplex::previous(g);
      g = q_.twin[last];
      edges += g == none && class_of(q_.tail[last]) == c;
      if (g == first) break;
    }
    return edges == 1;
  }
  // The half-edge where the fan of h begins: h, or the one at the border.
  std::int32_t first_of_fan(std::int32_t h) const noexcept {
    for (std::int32_t first = h; q_.twin[first] != none;) {
      first = QuadComplex::next(q_.twin[first]);
      if (first == h) return h;
      if (q_.twin[first] == none) return first;
    }
    return h;
  }

  // Checks the fans of all other merged vertices in the mesh as it will be.
  bool check() {
    // By class: a half-edge that leaves it in a quad that stays.
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g == none) continue;
        start_[find(q_.tail[g])] = g;
        start_[find(q_.head(g))] = QuadComplex::next(g);
      }
    }
    bool good = true;
    apply_joins(true);
    for (const std::int32_t v : classes_) {
      if (find(v) == v && hub_[v] == none) good = good && start_[v] != none && check_fan(v);
    }
    if (good) {
      // All half-edges of the classes must lie in the fans that were walked.
      for (const Join& j : joins_) {
        for (const std::int32_t g : {j.a, j.b})
          good = good && (g == none || (is_walked(g) && is_walked(QuadComplex::next(g))));
      }
    }
    for (const std::int32_t h : fan_) in_fan_[h] = 0;
    fan_.clear();
    for (const std::int32_t v : classes_) start_[v] = none;
    if (!good) apply_joins(false);
    return good;
  }

  bool is_walked(std::int32_t h) noexcept { return in_fan_[h] || hub_[find(q_.tail[h])] != none; }

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
    std::int32_t corners = 0;
    const std::int32_t first = first_of_fan(start_[c]);
    const bool border = q_.twin[first] == none;
    for (std::int32_t h = first; h != none;) {
      if (class_of(q_.tail[h]) != c || in_fan_[h]) return false;
      in_fan_[h] = 1;
      fan_.push_back(h);
      ++corners;
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
    remesh::QuadMesh& all = q_.vertices;
    remesh::Table<Vec3> sum(memory_);
    remesh::Table<std::int32_t> count(memory_);
    for (const std::int32_t v : classes_) {
      const std::int32_t c = find(v);
      if (place_[c] == none) {
        place_[c] = sum.size();
        sum.push_back(Vec3{});
        count.push_back(0);
      }
      sum[place_[c]] = sum[place_[c]] + all.position[v];
      ++count[place_[c]];
    }
    remesh::Table<std::int32_t> best(sum.size(), none, memory_);
    const auto rank = [&](std::int32_t v) {
      return corners_[v] ? 3 : all.pinned[v] != remesh::QuadMesh::free ? 2 : all.border[v] ? 1 : 0;
    };
    const auto away = [&](std::int32_t v, std::int32_t i) { return norm(all.position[v] - (1.0 / count[i]) * sum[i]); };
    for (const std::int32_t v : classes_) {
      const std::int32_t i = place_[find(v)];
      if (best[i] == none || rank(v) > rank(best[i]) || (rank(v) == rank(best[i]) && away(v, i) < away(best[i], i)))
        best[i] = v;
    }
    for (const std::int32_t h : halves_) {
      if (dead_[h / 4]) continue;
      dead_[h / 4] = 1;
      --size_[piece_[h / 4]];
      for (std::int32_t k = 0; k < 4; ++k) --quads_at_[q_.tail[h / 4 * 4 + k]];
    }
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g != none) q_.feature[g] = j.feature;
      }
    }
    keep_hubs(best);
    for (const std::int32_t v : classes_) {
      const std::int32_t to = best[place_[find(v)]];
      if (v == to) continue;
      quads_at_[to] += quads_at_[v];
      quads_at_[v] = 0;
      at_border_[to] |= at_border_[v];
    }
    // Half-edges around the classes belong to the joins' fans.
    for (const Join& j : joins_) {
      for (const std::int32_t g : {j.a, j.b}) {
        if (g == none) continue;
        rename(g, best);
        rename(QuadComplex::next(g), best);
      }
    }
    for (const std::int32_t v : classes_) place_[v] = none;
  }
  // A hub keeps its number and gets the data of the best vertex of its class. The half-edges of the others get its
  // number.
  void keep_hubs(remesh::Table<std::int32_t>& best) {
    remesh::QuadMesh& all = q_.vertices;
    for (const std::int32_t h : moved_) q_.tail[h] = hub_[find(q_.tail[h])];
    for (const std::int32_t v : classes_) {
      const std::int32_t c = find(v), hub = hub_[c];
      if (c != v || hub == none) continue;
      const std::int32_t from = best[place_[c]];
      all.location[hub] = all.location[from];
      all.position[hub] = all.position[from];
      all.pinned[hub] = all.pinned[from];
      all.border[hub] = all.border[from];
      all.scale[hub] = all.scale[from];
      corners_[hub] = corners_[from];
      best[place_[c]] = hub;
    }
  }
  // Gives the whole fan of h its new vertex.
  void rename(std::int32_t h, remesh::Table<std::int32_t>& best) {
    const std::int32_t v = q_.tail[h];
    if (leader_[v] == none) return;
    std::int32_t& to = best[place_[find(v)]];
    if (to == none || hub_[find(v)] != none) return;
    const std::int32_t first = first_of_fan(h);
    for (std::int32_t g = first; g != none;) {
      q_.tail[g] = to;
      g = q_.twin[QuadComplex::previous(g)];
      if (g == first) break;
    }
    to = none;
  }

  struct Join {
    std::int32_t a, b;
    std::uint8_t feature;
  };
  struct Undo {
    std::int32_t half, twin;
  };
  QuadComplex& q_;
  const std::int32_t most_walked_;  // quads at a vertex that is no hub
  Memory& memory_;
  remesh::Table<std::uint8_t> dead_, crossed_;  // by quad; crossed_: one bit for every side that the chord crosses
  remesh::Table<std::uint8_t> in_fan_;          // by half-edge
  // By vertex. Numbers of the classes of vertices that become one.
  remesh::Table<std::int32_t> leader_, start_, place_;
  remesh::Table<std::int32_t> hub_,
      gaps_;  // by leader: the hub of the class; the gaps that the border makes in its fan
  remesh::Table<std::int32_t> quads_at_;
  remesh::Table<std::int32_t> piece_, size_;         // by quad, its piece; by piece, the quads that are left
  remesh::Table<std::uint8_t> corners_, at_border_;  // whether it must stay; whether it lies on a border
  remesh::Table<std::int32_t> halves_, classes_, fan_, neighbours_;
  remesh::Table<std::int32_t> moved_;  // half-edges that leave vertices which join a hub
  remesh::Table<Join> joins_;
  remesh::Table<Undo> undo_;
  std::int32_t quads_ = 0;  // of the chord
};

}  // namespace

std::int32_t collapse_chords(QuadComplex& quads, std::int32_t wanted, std::int32_t least, Memory& memory,
                             std::int32_t hub) {
  return quads.quad_count() > wanted ? Collapser(quads, hub, memory).run(wanted, least) : 0;
}

}  // namespace hf_inner::quads
