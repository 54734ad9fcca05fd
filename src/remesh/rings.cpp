#include "remesh/rings.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "remesh/constants.h"
#include "remesh/loop_line.h"
#include "remesh/ring_levels.h"

namespace hf_inner {
namespace {

constexpr std::int32_t none = -1;

class Builder {
 public:
  Builder(const FluxField& field, const ArcGraph& graph, const Table<double>& lines_at, const RingOptions& options,
          Memory& memory, RingMesh& out)
      : field_(field),
        surface_(field.surface()),
        graph_(graph),
        lines_at_(lines_at),
        options_(options),
        memory_(memory),
        out_(out),
        line_(memory),
        lower_line_(memory),
        index_of_edge_(surface_.half_count(), none, memory),
        arc_of_edge_(surface_.half_count(), none, memory),
        ended_(memory),
        arrivals_(&memory),
        by_arc_(&memory) {}

  void run() {
    for (std::int32_t i = 0; i < graph_.critical.size(); ++i) {
      if (graph_.down_start[i] == graph_.down_start[i + 1]) {
        start_at_source(i);
      } else {
        pass_saddle(i);
      }
      for (std::int32_t j = graph_.up_start[i]; j < graph_.up_start[i + 1]; ++j) climb(graph_.up_arc[j]);
      report(static_cast<float>(i + 1) / static_cast<float>(graph_.critical.size()));
    }
  }

 private:
  struct Arrival {
    std::int32_t from;  // the node below on its flow line
    FluxPoint point;
    double place;
  };

  bool is_extremum(std::int32_t v) const { return field_.sign_changes(v) == 0; }
  std::int32_t last_ring(std::int32_t arc) const { return out_.ring_start[arc + 1] - 1; }

  void build(std::int32_t r, LoopLine& line) {
    const Ring& ring = out_.rings[r];
    line.build(field_, {ring.threshold, ring.seed}, ring.value, ring.border);
  }
  // Makes r the current ring of nodes: builds its polyline and numbers the edges that it crosses.
  void begin_ring(std::int32_t r) {
    build(r, line_);
    for (std::int32_t i = 0; i < line_.edges().size(); ++i) index_of_edge_[line_.edges()[i]] = i;
    out_.rings[r].length = line_.length();
  }
  void finish_ring(std::int32_t r) {
    for (const std::int32_t h : line_.edges()) index_of_edge_[h] = none;
    Ring& ring = out_.rings[r];
    std::int32_t n = ring.node;
    for (std::int32_t i = 0; i < ring.count; ++i, n = out_.nodes[n].next)
      out_.location[n] = line_.location(out_.nodes[n].place);
  }

  std::int32_t add_node(std::int32_t r, double place, FluxPoint point, std::int32_t down) {
    RingNode node;
    node.ring = r, node.place = place, node.point = point, node.down = down;
    const std::int32_t n = out_.nodes.push_back(node);
    out_.location.push_back({});
    ended_.push_back(0);
    if (down != none) out_.nodes[down].up = n;
    ++out_.rings[r].count;
    return n;
  }
  void link(std::int32_t a, std::int32_t b) { out_.nodes[a].next = b, out_.nodes[b].previous = a; }
  // Adds a node behind the node `after` on its ring.
  std::int32_t insert(std::int32_t after, double place) {
    const std::int32_t r = out_.nodes[after].ring, before = out_.nodes[after].next;
    const std::int32_t n = add_node(r, place, line_.at(place), none);
    link(after, n), link(n, before);
    out_.nodes[n].place = place - line_.length() * std::floor(place / line_.length());
    return n;
  }
  double gap(std::int32_t n) const {  // length of the ring up to the next node
    const double length = out_.rings[out_.nodes[n].ring].length;
    double g = out_.nodes[out_.nodes[n].next].place - out_.nodes[n].place;
    if (out_.nodes[n].next == n) return length;
    return g < 0 ? g + length : g;
  }
  // Adds `count` nodes, evenly spaced in the gap behind node n.
  void fill(std::int32_t n, std::int32_t count) {
    const double from = out_.nodes[n].place, width = gap(n);
    for (std::int32_t k = 1; k <= count; ++k) n = insert(n, from + width * k / (count + 1));
  }

  void start_at_source(std::int32_t i) {
    const std::int32_t v = graph_.critical[i];
    for (std::int32_t j = graph_.up_start[i]; j < graph_.up_start[i + 1]; ++j) {
      const std::int32_t r = out_.ring_start[graph_.up_arc[j]];
      begin_ring(r);
      double count = options_.uniform ? 2 * std::round(line_.length() / options_.edge_length / 2) : lines_at_[v];
      count = std::max(count, surface_.is_apex(v) ? least_lines : least_beside_site());
      const std::int32_t n = static_cast<std::int32_t>(std::min(count, most_nodes));
      std::int32_t first = none, last = none;
      double sum = 0;
      std::int32_t edge = 0;
      for (std::int32_t k = 0; k < n; ++k) {
        FluxPoint p;
        double place;
        if (options_.uniform) {
          place = line_.length() * (k + 0.5) / n, p = line_.at(place);
        } else {
          const double want = graph_.arcs[graph_.up_arc[j]].flux * (k + 0.5) / n;
          while (edge + 1 < line_.edges().size() && sum + field_.flux(line_.edges()[edge]) < want)
            sum += field_.flux(line_.edges()[edge++]);
          p = {line_.edges()[edge], want - sum}, place = line_.place(edge, p.offset);
        }
        const std::int32_t node = add_node(r, place, p, none);
        if (first == none) first = node;
        if (last != none) link(last, node);
        last = node;
      }
      link(last, first);
      out_.rings[r].node = first;
      complete_ring(r);
    }
  }

  double least_beside_site() const { return options_.uniform ? least_nodes_at_site : least_lines; }

  void pass_saddle(std::int32_t i) {
    const std::int32_t v = graph_.critical[i], rank = field_.rank(v);
    if (graph_.up_start[i] == graph_.up_start[i + 1]) return;  // a sink, where lines end
    Table<std::int32_t> loop(memory_);
    Table<std::int32_t> marked(memory_);
    auto mark = [&](const Loop& at, std::int32_t arc) {
      walk_loop(field_, at, loop);
      for (const std::int32_t h : loop) arc_of_edge_[h] = arc, marked.push_back(h);
    };
    for (std::int32_t j = graph_.up_start[i]; j < graph_.up_start[i + 1]; ++j)
      mark({rank + 1, graph_.arcs[graph_.up_arc[j]].seed}, graph_.up_arc[j]);
    by_arc_.clear();
    for (std::int32_t j = graph_.down_start[i]; j < graph_.down_start[i + 1]; ++j) {
      const Ring& below = out_.rings[last_ring(graph_.down_arc[j])];
      std::int32_t n = below.node;
      for (std::int32_t k = 0; k < below.count; ++k, n = out_.nodes[n].next) {
        if (ended_[n]) continue;
        FluxPoint p = out_.nodes[n].point;
        while (p.half != none && field_.rank(surface_.head(p.half)) <= rank) p = field_.up(p);
        if (p.half == none || arc_of_edge_[p.half] == none) fail_off_arc();
        by_arc_.push_back({n, p, static_cast<double>(arc_of_edge_[p.half])});
      }
    }
    for (const std::int32_t h : marked) arc_of_edge_[h] = none;
    marked.clear();
    for (std::int32_t j = graph_.down_start[i]; j < graph_.down_start[i + 1]; ++j) {
      const Arc& arc = graph_.arcs[graph_.down_arc[j]];
      mark({rank, graph_.loop(field_, arc, arc.last - arc.first).seed}, graph_.down_arc[j]);
    }
    for (std::int32_t j = graph_.up_start[i]; j < graph_.up_start[i + 1]; ++j) {
      const std::int32_t arc = graph_.up_arc[j];
      arrivals_.clear();
      for (const Arrival& a : by_arc_)
        if (static_cast<std::int32_t>(a.place) == arc) arrivals_.push_back(a);
      arrive(out_.ring_start[arc], true, rank);
    }
    for (const std::int32_t h : marked) arc_of_edge_[h] = none;
  }

  void climb(std::int32_t arc) {
    for (std::int32_t r = out_.ring_start[arc] + 1; r < out_.ring_start[arc + 1]; ++r) {
      arrivals_.clear();
      const Ring& below = out_.rings[r - 1];
      std::int32_t n = below.node;
      for (std::int32_t k = 0; k < below.count; ++k, n = out_.nodes[n].next)
        if (!ended_[n]) arrivals_.push_back({n, out_.nodes[n].point, 0});
      arrive(r, false, 0);
    }
  }

  // Adds the nodes of ring r for the flow lines that reach it. They come from one ring below in its order, or through a
  // saddle from several rings.
  void arrive(std::int32_t r, bool saddle, std::int32_t rank) {
    begin_ring(r);
    const std::int32_t threshold = out_.rings[r].threshold;
    for (Arrival& a : arrivals_) {
      while (a.point.half != none && field_.rank(surface_.head(a.point.half)) < threshold) a.point = field_.up(a.point);
      if (a.point.half == none || index_of_edge_[a.point.half] == none) fail_off_arc();
      a.place = line_.place(index_of_edge_[a.point.half], a.point.offset);
    }
    const std::int32_t count = static_cast<std::int32_t>(arrivals_.size());
    if (saddle) {
      std::sort(arrivals_.begin(), arrivals_.end(),
                [](const Arrival& a, const Arrival& b) { return a.place < b.place; });
    } else if (count > 1) {
      // The new ring's nodes have the order of the ring below, where their lines come from. This finds the first node.
      std::size_t begin = 0;
      double drop = -1;
      for (std::size_t k = 0; k < arrivals_.size(); ++k) {
        const double fall = arrivals_[(k + arrivals_.size() - 1) % arrivals_.size()].place - arrivals_[k].place;
        if (fall > drop) drop = fall, begin = k;
      }
      std::rotate(arrivals_.begin(), arrivals_.begin() + static_cast<std::ptrdiff_t>(begin), arrivals_.end());
      for (std::size_t k = 1; k < arrivals_.size(); ++k)
        arrivals_[k].place = std::max(arrivals_[k].place, arrivals_[k - 1].place);
    }
    std::int32_t first = none, last = none;
    for (const Arrival& a : arrivals_) {
      const std::int32_t n = add_node(r, a.place, a.point, a.from);
      if (first == none) first = n;
      if (last != none) link(last, n);
      last = n;
    }
    if (first != none) link(last, first), out_.rings[r].node = first;
    if (saddle) {
      if (out_.rings[r].count < 2) join_down(r, rank);
      fill_saddle_ring(r);
    }
    complete_ring(r);
  }

  // Adds two neighbouring flow lines from ring r of nodes down to a ring below the saddle with this rank. They start
  // half way around ring r from its only node, and end between two neighbouring nodes. Only the first line is traced;
  // the second runs beside it.
  void join_down(std::int32_t r, std::int32_t rank) {
    const std::int32_t only = out_.rings[r].node;
    const double place = only == none ? 0.0 : out_.nodes[only].place + line_.length() / 2;
    std::int32_t n;
    if (only == none) {
      n = add_node(r, place, line_.at(place), none);
      link(n, n), out_.rings[r].node = n;
    } else {
      n = insert(only, place);
    }
    FluxPoint p = out_.nodes[n].point;
    while (p.half != none && field_.rank(surface_.tail[p.half]) >= rank) p = field_.down(p);
    if (p.half == none || arc_of_edge_[p.half] == none) fail_off_arc();
    const std::int32_t below = last_ring(arc_of_edge_[p.half]);
    while (p.half != none && field_.rank(surface_.tail[p.half]) >= out_.rings[below].threshold) p = field_.down(p);
    if (p.half == none) fail_off_arc();
    build(below, lower_line_);
    const double low_place = lower_line_.place_of(p);
    // The new nodes follow the last node before that place, or the last of all nodes.
    std::int32_t after = out_.rings[below].node, best = none, m = after;
    for (std::int32_t k = 0; k < out_.rings[below].count; ++k, m = out_.nodes[m].next) {
      if (out_.nodes[m].place <= low_place && (best == none || out_.nodes[m].place >= out_.nodes[best].place)) best = m;
      if (out_.nodes[m].place >= out_.nodes[after].place) after = m;
    }
    if (best != none) after = best;
    const std::int32_t m2 = insert(n, out_.nodes[n].place + second_line * gap(n));
    const double from = out_.nodes[after].place, width = gap(after);
    for (int k = 1; k <= 2; ++k) {
      double at = from + width * k / 3;
      at -= lower_line_.length() * std::floor(at / lower_line_.length());
      const std::int32_t low = add_node(below, at, lower_line_.at(at), none), before = out_.nodes[after].next;
      link(after, low), link(low, before);
      out_.location[low] = lower_line_.location(at);
      const std::int32_t high = k == 1 ? n : m2;
      out_.nodes[low].up = high, out_.nodes[high].down = low;
      after = low;
    }
  }

  // Tells whether the gap behind node n of a ring is adjacent to the saddle: its two flow lines are not neighbours on
  // one ring below.
  bool is_at_saddle(std::int32_t n) const {
    const std::int32_t a = out_.nodes[n].down, b = out_.nodes[out_.nodes[n].next].down;
    if (a == none || b == none) return true;
    if (a == b) return true;
    std::int32_t m = out_.nodes[a].next;
    while (m != a && ended_[m]) m = out_.nodes[m].next;  // skips lines that end; all others continue
    return m != b;
  }

  // Completes a ring above a saddle: makes the number of nodes even. In kind uniform (lines may start anywhere) it also
  // fills the widest gap at the saddle, with nodes about an edge length apart.
  void fill_saddle_ring(std::int32_t r) {
    std::int32_t widest = none, n = out_.rings[r].node;
    double width = -1;
    for (std::int32_t k = 0; k < out_.rings[r].count; ++k, n = out_.nodes[n].next)
      if (is_at_saddle(n) && gap(n) > width) width = gap(n), widest = n;
    if (widest == none) return;
    std::int32_t wanted = out_.rings[r].count % 2;
    if (options_.uniform) {
      const double more = width / options_.edge_length - 1 - wanted;
      wanted += 2 * std::max(0, static_cast<std::int32_t>(std::lround(std::min(more, most_nodes) / 2)));
    }
    fill(widest, wanted);
  }

  // Completes ring r of nodes: applies the rules of rings.h.
  void complete_ring(std::int32_t r) {
    const Ring& ring = out_.rings[r];
    const std::int32_t upper = graph_.arcs[ring.arc].upper;
    const bool last = r == last_ring(ring.arc);
    const double least = last && is_extremum(upper) && !surface_.is_apex(upper) ? least_beside_site() : least_lines;
    if (ring.count % 2) fill(widest_gap(r), 1);
    while (out_.rings[r].count < least) fill(widest_gap(r), 2);
    if (options_.uniform) {
      add_pairs(r);
      if (!last) end_pairs(r);
    }
    finish_ring(r);
  }

  std::int32_t widest_gap(std::int32_t r) const {
    std::int32_t n = out_.rings[r].node, best = n;
    for (std::int32_t k = 0; k < out_.rings[r].count; ++k, n = out_.nodes[n].next)
      if (gap(n) > gap(best)) best = n;
    return best;
  }

  void add_pairs(std::int32_t r) {
    const double widest = widest_gap_length * options_.edge_length;
    std::int32_t n = out_.rings[r].node;
    for (std::int32_t k = out_.rings[r].count; k > 0; --k) {
      const std::int32_t following = out_.nodes[n].next;
      if (gap(n) > widest && out_.nodes[n].down != none && out_.nodes[following].down != none) fill(n, 2);
      n = following;
    }
  }

  void end_pairs(std::int32_t r) {
    const double narrowest = narrowest_gaps_length * options_.edge_length;
    struct Candidate {
      double width;
      std::int32_t node;
    };
    Vector<Candidate> list(&memory_);
    std::int32_t n = out_.rings[r].node, lined = 0;
    for (std::int32_t k = 0; k < out_.rings[r].count; ++k, n = out_.nodes[n].next) {
      ++lined;
      const std::int32_t b = out_.nodes[n].next, c = out_.nodes[b].next;
      const double width = gap(n) + gap(b) + gap(c);
      if (width < narrowest) list.push_back({width, n});
    }
    std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) {
      return a.width != b.width ? a.width < b.width : a.node < b.node;
    });
    for (const Candidate& candidate : list) {
      if (lined <= least_lined) return;
      const std::int32_t a = candidate.node, b = out_.nodes[a].next, c = out_.nodes[b].next, d = out_.nodes[c].next;
      if (ended_[a] || ended_[b] || ended_[c] || ended_[d]) continue;
      if (out_.nodes[b].down == none || out_.nodes[c].down == none) continue;
      ended_[b] = ended_[c] = 1, lined -= 2;
    }
  }

  [[noreturn]] static void fail_off_arc() {
    fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "a flux line left its arc; report it with the mesh");
  }

  const FluxField& field_;
  const FluxSurface& surface_;
  const ArcGraph& graph_;
  const Table<double>& lines_at_;
  const RingOptions& options_;
  Memory& memory_;
  RingMesh& out_;
  LoopLine line_, lower_line_;
  Table<std::int32_t> index_of_edge_, arc_of_edge_;
  Table<std::uint8_t> ended_;
  Vector<Arrival> arrivals_, by_arc_;
};

}  // namespace

RingMesh make_rings(const FluxField& field, const ArcGraph& graph, const Table<double>& lines_at,
                    const RingOptions& options, Memory& memory) {
  RingMesh out(memory);
  place_rings(field, graph, options, memory, out);
  Builder builder(field, graph, lines_at, options, memory, out);
  builder.run();
  return out;
}

}  // namespace hf_inner
