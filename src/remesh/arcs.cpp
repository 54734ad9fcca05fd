#include "remesh/arcs.h"

#include <algorithm>

#include "base/error.h"

namespace hf_inner {

void walk_loop(const FluxField& field, Loop loop, Table<std::int32_t>& out) {
  const FluxSurface& s = field.surface();
  out.clear();
  for (std::int32_t h = loop.seed;;) {
    out.push_back(h);
    // This half-edge goes from high to low, in the triangle to the right. `opposite` is the third corner of that
    // triangle.
    const std::int32_t t = s.twin[h];
    const std::int32_t opposite = s.tail[FluxSurface::previous(t)];
    h = field.rank(opposite) < loop.threshold ? FluxSurface::previous(t) : FluxSurface::next(t);
    if (h == loop.seed) return;
    if (out.size() > s.half_count()) fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "a level loop does not close");
  }
}

Loop ArcGraph::loop(const FluxField& field, const Arc& arc, std::int32_t below) const {
  if (below == 0) return {field.rank(arc.lower) + 1, arc.seed};
  const FluxSurface& s = field.surface();
  const std::int32_t v = vertices[arc.first + below - 1];
  std::int32_t g = s.out[v];
  while (!field.rises(g)) g = s.turn_left(g);
  return {field.rank(v) + 1, g};
}

ArcGraph::ArcGraph(const FluxField& field, Memory& memory)
    : critical(memory),
      arcs(memory),
      vertices(memory),
      up_start(memory),
      up_arc(memory),
      down_start(memory),
      down_arc(memory) {
  const FluxSurface& s = field.surface();
  const std::int32_t n = s.vertex_count();
  Table<std::int32_t> number(n, -1, memory);  // by vertex: number of a critical vertex, or -1
  for (std::int32_t r = 0; r < n; ++r) {
    const std::int32_t v = field.by_rank(r);
    if (field.sign_changes(v) != 2) number[v] = critical.push_back(v);
  }
  Table<std::uint8_t> seen(n, 0, memory);
  Table<std::int32_t> loop_edges(memory);
  Vector<std::int32_t> heap(&memory);  // ranks
  const auto later = std::greater<std::int32_t>();
  up_start.push_back(0);
  for (std::int32_t i = 0; i < critical.size(); ++i) {
    const std::int32_t v = critical[i], begin = s.out[v];
    Table<std::int32_t> done(memory);  // edges at v whose level loops already belong to arcs
    for (std::int32_t g = begin;;) {
      if (field.rises(g) && std::find(done.begin(), done.end(), g) == done.end()) {
        Arc arc;
        arc.lower = v, arc.seed = g, arc.first = vertices.size();
        walk_loop(field, {field.rank(v) + 1, g}, loop_edges);
        heap.clear();
        for (const std::int32_t h : loop_edges) {
          arc.flux += field.flux(h);
          if (s.tail[h] == v) done.push_back(h);
          heap.push_back(field.rank(s.head(h)));
        }
        std::make_heap(heap.begin(), heap.end(), later);
        // The level loop moves up past the vertices above it one by one, the lowest first, until it meets a critical
        // vertex.
        while (arc.upper < 0) {
          if (heap.empty()) fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "an arc of level loops has no upper end");
          std::pop_heap(heap.begin(), heap.end(), later);
          const std::int32_t w = field.by_rank(heap.back());
          heap.pop_back();
          if (number[w] >= 0) {
            arc.upper = w;
          } else if (!seen[w]) {
            seen[w] = 1, vertices.push_back(w);
            const std::int32_t start = s.out[w];
            for (std::int32_t e = start;;) {
              if (field.rises(e)) {
                heap.push_back(field.rank(s.head(e)));
                std::push_heap(heap.begin(), heap.end(), later);
              }
              e = s.turn_left(e);
              if (e == start) break;
            }
          }
        }
        arc.last = vertices.size();
        up_arc.push_back(arcs.push_back(arc));
      }
      g = s.turn_left(g);
      if (g == begin) break;
    }
    up_start.push_back(up_arc.size());
  }
  down_start.assign(critical.size() + 1, 0);
  for (const Arc& arc : arcs) ++down_start[number[arc.upper] + 1];
  for (std::int32_t i = 0; i < critical.size(); ++i) down_start[i + 1] += down_start[i];
  down_arc.assign(arcs.size(), 0);
  Table<std::int32_t> fill(memory);
  for (std::int32_t i = 0; i < critical.size(); ++i) fill.push_back(down_start[i]);
  for (std::int32_t a = 0; a < arcs.size(); ++a) down_arc[fill[number[arcs[a].upper]]++] = a;
}

}  // namespace hf_inner
