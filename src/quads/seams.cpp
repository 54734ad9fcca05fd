#include "quads/seams.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

int modulo(int k) noexcept { return k & 3; }

// Adds i^quarters factor other to a sum.
void add(SeamSum& sum, const SeamSum& other, Complex factor) {
  for (const SeamTerm& term : other) {
    const auto found = std::lower_bound(sum.begin(), sum.end(), term.parameter,
                                        [](const SeamTerm& a, std::int32_t p) { return a.parameter < p; });
    if (found != sum.end() && found->parameter == term.parameter) {
      found->factor += factor * term.factor;
    } else {
      sum.insert(found, SeamTerm{term.parameter, factor * term.factor});
    }
  }
  sum.erase(
      std::remove_if(sum.begin(), sum.end(), [](const SeamTerm& t) { return field::length_of(t.factor) < no_factor; }),
      sum.end());
}

void turn(SeamSum& sum, Complex factor) {
  for (SeamTerm& term : sum) term.factor *= factor;
}

class Cutter {
 public:
  Cutter(const remesh::FluxSurface& surface, const FaceCross& crosses, Seams& out, Memory& memory)
      : s_(surface),
        crosses_(crosses),
        out_(out),
        memory_(memory),
        degree_(surface.vertex_count(), 0, memory),
        border_(surface.vertex_count(), none, memory),
        seam_(surface.half_count(), none, memory),
        seams_(memory),
        sums_(&memory),
        forward_(surface.half_count(), 0, memory),
        forced_(surface.vertex_count(), 0, memory),
        parent_(memory),
        order_(memory) {}

  void run() {
    comb();
    prune();
    find_seams();
    grow_trees();
    solve_nodes();
    place_corners();
  }

 private:
  struct Seam {
    std::int32_t from, to;  // node keys
    int transition;         // of the half-edges along the seam
    bool known;
  };
  bool regular(std::int32_t v) const noexcept { return modulo(crosses_.index[v]) == 0; }
  bool is_node(std::int32_t v) const noexcept {
    return degree_[v] > 0 && (degree_[v] != 2 || !regular(v) || border_[v] != none);
  }
  // The border vertices of one loop are one node.
  std::int32_t key(std::int32_t v) const noexcept { return border_[v] != none ? border_[v] : v; }

  // Turns the crosses so that they agree across the edges of a spanning tree of the triangles.
  void comb() {
    const std::int32_t triangles = s_.real_triangles;
    remesh::Table<std::int8_t> rotation(triangles, 0, memory_);
    remesh::Table<std::uint8_t> seen(triangles, 0, memory_);
    out_.cut.assign(s_.half_count(), 1);
    out_.transition.assign(s_.half_count(), 0);
    remesh::Table<std::int32_t> queue(memory_);
    Poller poller;
    for (std::int32_t start = 0; start < triangles; ++start) {
      if (seen[start]) continue;
      queue.clear();
      queue.push_back(start);
      seen[start] = 1;
      for (std::int32_t next = 0; next < queue.size(); ++next) {
        poller.due();
        const std::int32_t f = queue[next];
        for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
          const std::int32_t g = s_.twin[h];
          if (!s_.is_real(g) || seen[g / 3]) continue;
          seen[g / 3] = 1;
          out_.cut[h] = out_.cut[g] = 0;
          // direction_g = i^turn[g] direction_f, and both are to be the same.
          rotation[g / 3] = static_cast<std::int8_t>(modulo(rotation[f] - crosses_.turn[g]));
          queue.push_back(g / 3);
        }
      }
    }
    out_.direction.assign(triangles, Complex(1, 0));
    for (std::int32_t f = 0; f < triangles; ++f) out_.direction[f] = quarter_turned(crosses_.direction[f], rotation[f]);
    for (std::int32_t h = 0; h < s_.half_count(); ++h) {
      const std::int32_t g = s_.twin[h];
      if (!s_.is_real(h) || !s_.is_real(g)) {
        out_.cut[h] = 0;
        if (s_.is_real(h)) {
          const std::int32_t apex = s_.tail[remesh::FluxSurface::previous(g)];
          border_[s_.tail[h]] = apex;
          border_[s_.head(h)] = apex;
        }
        continue;
      }
      out_.transition[h] =
          static_cast<std::int8_t>(out_.cut[h] ? modulo(-(crosses_.turn[h] + rotation[h / 3] - rotation[g / 3])) : 0);
    }
  }

  void prune() {
    remesh::Table<std::int32_t> stack(memory_);
    for (std::int32_t h = 0; h < s_.half_count(); ++h) degree_[s_.tail[h]] += out_.cut[h];
    const auto dead_end = [&](std::int32_t v) { return degree_[v] == 1 && regular(v) && border_[v] == none; };
    for (std::int32_t v = 0; v < s_.first_apex; ++v) {
      if (dead_end(v)) stack.push_back(v);
    }
    while (!stack.empty()) {
      const std::int32_t v = stack.back();
      stack.pop_back();
      if (!dead_end(v)) continue;
      std::int32_t h = s_.out[v];
      while (!out_.cut[h]) h = s_.turn_left(h);
      const std::int32_t g = s_.twin[h], w = s_.head(h);
      out_.cut[h] = out_.cut[g] = 0;
      out_.transition[h] = out_.transition[g] = 0;
      --degree_[v];
      --degree_[w];
      if (dead_end(w)) stack.push_back(w);
    }
  }

  void find_seams() {
    for (const bool rest : {false, true}) {
      for (std::int32_t start = 0; start < s_.half_count(); ++start) {
        const std::int32_t node = s_.tail[start];
        // A closed seam without a node starts anywhere.
        if (!out_.cut[start] || seam_[start] != none || !(is_node(node) || rest)) continue;
        if (rest) forced_[node] = 1;
        const std::int32_t number = seams_.size();
        Seam seam{key(node), none, out_.transition[start], false};
        for (std::int32_t h = start;;) {
          if (out_.transition[h] != seam.transition)
            fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
                 "the angles of some triangles are lost in rounding; remove triangles without area, or weld with a "
                 "tolerance");
          seam_[h] = number;
          seam_[s_.twin[h]] = number;
          forward_[h] = 1;
          ++out_.cut_edges;
          const std::int32_t v = s_.head(h);
          if (at_node(v)) {
            seam.to = key(v);
            break;
          }
          std::int32_t g = s_.turn_left(s_.twin[h]);
          while (!out_.cut[g]) g = s_.turn_left(g);
          h = g;
        }
        seams_.push_back(seam);
      }
    }
  }
  bool at_node(std::int32_t v) const noexcept { return is_node(v) || forced_[v]; }

  // By how much a border turns at v, in radians; 0 inside.
  double sharpness(std::int32_t v) const noexcept {
    if (border_[v] == none) return 0;
    double angle = 0;
    const std::int32_t begin = s_.out[v];
    for (std::int32_t h = begin;;) {
      if (s_.is_real(h)) {
        const Complex a = crosses_.edge[h], b = -crosses_.edge[remesh::FluxSurface::previous(h)];
        angle += field::angle_of(b * std::conj(a));
      }
      h = s_.turn_left(h);
      if (h == begin) break;
    }
    return std::fabs(angle - half_turn);
  }

  // Makes a spanning tree of the seams of every component, chooses the root, the vertex at 0, and the parameters.
  void grow_trees() {
    const std::int32_t n = s_.vertex_count();
    remesh::Table<std::int32_t> start(n + 1, 0, memory_), list(2 * seams_.size(), none, memory_);
    for (const Seam& seam : seams_) {
      ++start[seam.from + 1];
      ++start[seam.to + 1];
    }
    for (std::int32_t v = 0; v < n; ++v) start[v + 1] += start[v];
    remesh::Table<std::int32_t> cursor = start;
    for (std::int32_t i = 0; i < seams_.size(); ++i) {
      list[cursor[seams_[i].from]++] = i;
      list[cursor[seams_[i].to]++] = i;
    }
    // By component: the best root. Borders first, then odd singularities, which never halve whole numbers.
    remesh::Table<std::int32_t> root(s_.component_count, none, memory_), singular(s_.component_count, 0, memory_),
        any(s_.component_count, none, memory_);
    const auto rank = [&](std::int32_t v) {
      return v == none ? 0 : s_.is_apex(v) ? 4 : crosses_.index[v] % 2 != 0 ? 3 : !regular(v) ? 2 : 1;
    };
    remesh::Table<double> corner(s_.component_count, -1.0, memory_);
    for (std::int32_t v = 0; v < n; ++v) {
      std::int32_t& best = root[s_.component[v]];
      // Without singularities, the sharpest corner of a border is held: it lies on the grid anyway.
      if (!s_.is_apex(v) && sharpness(v) > corner[s_.component[v]]) {
        any[s_.component[v]] = v;
        corner[s_.component[v]] = sharpness(v);
      }
      if (!s_.is_apex(v)) singular[s_.component[v]] += !regular(v);
      if ((start[v + 1] > start[v] || s_.is_apex(v)) && rank(v) > rank(best)) best = v;
    }
    parent_.assign(n, none);
    remesh::Table<std::uint8_t> seen(n, 0, memory_), tree(seams_.size(), 0, memory_);
    for (std::int32_t c = 0; c < s_.component_count; ++c) {
      if (root[c] == none) continue;
      std::int32_t next = order_.size();
      order_.push_back(root[c]);
      seen[root[c]] = 1;
      for (; next < order_.size(); ++next) {
        const std::int32_t v = order_[next];
        for (std::int32_t i = start[v]; i < start[v + 1]; ++i) {
          const Seam& seam = seams_[list[i]];
          const std::int32_t w = seam.from == v ? seam.to : seam.from;
          if (seen[w]) continue;
          seen[w] = 1;
          tree[list[i]] = 1;
          parent_[w] = list[i];
          order_.push_back(w);
        }
      }
    }
    out_.parameter.assign(n, Seams::free);
    remesh::Table<std::uint8_t> held(s_.component_count, 0, memory_);
    for (std::int32_t v = 0; v < s_.first_apex; ++v) {
      const std::int32_t c = s_.component[v];
      if (regular(v)) continue;
      ++out_.singularity_count;
      if (v == root[c]) continue;
      if (!held[c]) {
        held[c] = 1;
        out_.parameter[v] = Seams::depends;
        out_.fixed.push_back({v, SeamSum(&memory_), true});
        continue;
      }
      out_.parameter[v] = out_.parameter_count++;
    }
    for (std::int32_t c = 0; c < s_.component_count; ++c) {
      if (held[c]) continue;
      if (root[c] != none && !s_.is_apex(root[c]) && !regular(root[c]))
        fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the crosses of a component have one singularity only");
      out_.parameter[any[c]] = Seams::depends;
      out_.fixed.push_back({any[c], SeamSum(&memory_), false});
    }
    sums_.resize(static_cast<std::size_t>(seams_.size()), SeamSum(&memory_));
    for (std::int32_t i = 0; i < seams_.size(); ++i) {
      if (!tree[i]) make_free(i);
    }
    for (const std::int32_t v : order_) {
      if (s_.is_apex(v) && parent_[v] != none) make_free(parent_[v]);
    }
  }
  void make_free(std::int32_t seam) {
    sum_of(seam).push_back({out_.parameter_count++, Complex(1, 0)});
    seams_[seam].known = true;
  }
  SeamSum& sum_of(std::int32_t seam) { return sums_[static_cast<std::size_t>(seam)]; }

  // The t of a half-edge, in its own sense: i^transition on the right, plus t.
  SeamSum offset_of(std::int32_t h) {
    SeamSum sum(sum_of(seam_[h]), &memory_);
    if (!forward_[h]) turn(sum, -quarter_turned(Complex(1, 0), out_.transition[h]));
    return sum;
  }

  // Turns around a node, starting before the cut edge `first`. Writes product and sum of the turns; the seam `unknown`
  // counts as 0 and its factor is written.
  void around(std::int32_t first, std::int32_t unknown, int& product, SeamSum& sum, Complex& factor) {
    product = 0;
    factor = 0;
    sum.clear();
    std::int32_t h = first;
    do {
      if (out_.cut[h]) {
        const int k = out_.transition[h];
        const Complex step = quarter_turned(Complex(1, 0), k);
        turn(sum, step);
        factor *= step;
        product = modulo(product + k);
        if (seam_[h] == unknown) {
          factor += forward_[h] ? Complex(1, 0) : -step;
        } else {
          add(sum, offset_of(h), 1);
        }
      }
      h = s_.turn_left(h);
    } while (h != first);
  }

  void solve_nodes() {
    for (std::int32_t i = order_.size(); i-- > 0;) {
      const std::int32_t v = order_[i], seam = parent_[v];
      if (s_.is_apex(v)) continue;  // a turn around a border does not lead back to a vertex
      int product = 0;
      Complex factor = 0;
      SeamSum sum(&memory_);
      const std::int32_t first = first_cut(v);
      around(first, seam, product, sum, factor);
      // (1 - i^product) z = factor t + sum
      SeamSum right(&memory_);
      const Complex lever = Complex(1, 0) - quarter_turned(Complex(1, 0), product);
      if (seam == none) {  // the root
        if (product == 0) {
          if (!sum.empty())
            fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the crosses of a component without singularities do not close");
          continue;
        }
        turn(sum, 1.0 / lever);
        out_.parameter[v] = Seams::depends;
        out_.fixed.push_back({v, SeamSum(sum, &memory_), true});  // a plain copy would leave this memory
        continue;
      }
      if (out_.parameter[v] >= 0) right.push_back({out_.parameter[v], lever});  // z = 0 at the vertex that is held
      add(right, sum, -1);
      if (field::length_of(factor) < no_factor)
        fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "a seam does not count at its own node");
      turn(right, 1.0 / factor);
      sum_of(seam) = right;
      seams_[seam].known = true;
    }
  }

  // The first cut half-edge that leaves v. At a vertex inside a seam: the one along the seam, so that the sector on its
  // right is the base of all such vertices.
  std::int32_t first_cut(std::int32_t v) {
    std::int32_t h = s_.out[v];
    while (!out_.cut[h] || (!at_node(v) && !forward_[h])) h = s_.turn_left(h);
    return h;
  }

  void place_corners() {
    out_.unit.assign(s_.half_count(), 0);
    out_.offset.assign(s_.half_count(), none);
    remesh::Table<std::int32_t> of_seam(seams_.size(), none, memory_);
    const auto push = [&](const SeamSum& sum) {
      out_.offsets.push_back(sum);
      return static_cast<std::int32_t>(out_.offsets.size()) - 1;
    };
    for (std::int32_t v = 0; v < s_.first_apex; ++v) {
      if (degree_[v] == 0) continue;
      std::int32_t first;
      if (border_[v] != none) {
        first = s_.out[v];
        while (s_.is_real(first)) first = s_.turn_left(first);
        while (!s_.is_real(first)) first = s_.turn_left(first);
      } else {
        first = first_cut(v);
      }
      int product = 0;
      SeamSum sum(&memory_);
      std::int32_t offset = none, h = first;
      do {
        if (out_.cut[h]) {
          turn(sum, quarter_turned(Complex(1, 0), out_.transition[h]));
          add(sum, offset_of(h), 1);
          product = modulo(product + out_.transition[h]);
          if (sum.empty()) {
            offset = none;
          } else if (!at_node(v)) {
            std::int32_t& shared = of_seam[seam_[h]];
            if (shared == none) shared = push(sum);
            offset = shared;
          } else {
            offset = push(sum);
          }
        }
        out_.unit[h] = static_cast<std::int8_t>(product);
        out_.offset[h] = offset;
        h = s_.turn_left(h);
      } while (h != first);
    }
  }

  const remesh::FluxSurface& s_;
  const FaceCross& crosses_;
  Seams& out_;
  Memory& memory_;
  remesh::Table<std::int32_t> degree_, border_, seam_;
  remesh::Table<Seam> seams_;
  Vector<SeamSum> sums_;                 // t by seam
  remesh::Table<std::uint8_t> forward_;  // by half-edge: 1 along its seam
  remesh::Table<std::uint8_t> forced_;   // by vertex: 1 where a closed seam without a node starts
  remesh::Table<std::int32_t> parent_;   // by node key: the seam to its parent in the tree
  remesh::Table<std::int32_t> order_;    // node keys, parents before children
};

}  // namespace

Seams Seams::make(const remesh::FluxSurface& surface, const FaceCross& crosses, Memory& memory) {
  Seams out(memory);
  Cutter(surface, crosses, out, memory).run();
  return out;
}

}  // namespace hf_inner::quads
