#include "table.h"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace invariance {

namespace {

bool same(const char* a, const char* b) { return std::strcmp(a, b) == 0; }

// The arrays hold the same numbers, so the results have the same bits.
bool is_form(const Change& change) {
  for (const char* name : {"doubles", "16-bit indices", "strides", "faces"}) {
    if (same(change.name, name)) return true;
  }
  return false;
}

}  // namespace

const std::vector<Noun>& nouns() {
  static const std::vector<Noun> list = {
      {"report", "counts, angle, box and pieces; what was added is taken off", measure_report, 1e-6,
       "counts are equal; the angle is a float", false},
      {"picking", "rays and nearest vertices", measure_picking, 1e-9, "rounding", false},
      {"links", "automatic links and a field across them", measure_links, 1e-7, "rounding", false},
      {"graph", "a field on the edges as a graph", measure_graph, 1e-9, "rounding", false},
      {"harmonic field", "hard sites at vertices", measure_harmonic, 1e-9, "of the range of the sites", false},
      {"sites at places", "in triangles, on discs, soft", measure_places, 1e-9, "of the range of the sites", false},
      {"other operators", "clamped, uniform, cotangent", measure_operators, 1e-9, "of the range of the sites", false},
      {"bi-harmonic field", "hard sites at vertices", measure_biharmonic, 1e-6, "of the range of the sites", false},
      {"screened field", "follows targets", measure_screened, 1e-9, "of the range of the sites", false},
      {"preview", "single precision", measure_preview, 1e-5, "the header's error of previews, crowded sites", false},
      {"vector field", "three channels, projected", measure_vectors, 1e-9, "rounding", false},
      {"direction field", "vectors and lines", measure_direction, 1e-7, "rounding", false},
      {"singularities", "triangles and indices", measure_singularities, 0, "equal", false},
      {"iso-lines", "levels, lines and their lengths", measure_isolines, 1e-9, "rounding", false},
      {"critical points", "vertices, kinds and indices", measure_critical, 0, "equal", false},
      {"exact distances", "one source and three", measure_exact, 1e-9, "exact up to rounding, of the box", false},
      {"front distances", "one source and three", measure_front, 1e-9, "rounding, of the box", false},
      {"heat distances", "one source and three", measure_heat, 1e-6, "rounding, of the box", false},
      {"paths", "lengths of shortest paths", measure_paths, 1e-9, "exact up to rounding, of the box", false},
      {"map", "a disc laid out in a plane", measure_map, 1e-9, "exact up to rounding, of the box", false},
      {"tips", "of a field with sources", measure_poisson_tips, 1e-6, "does not depend on the order of the vertices",
       false},
      {"geodesic tips", "of mean distances", measure_geodesic_tips, 1e-6,
       "does not depend on the order of the vertices", false},
      {"streamlines", "ends and lengths of lines through vertices", measure_flow, 1e-6, "rounding", false},
      {"pose", "three handles, smooth", measure_pose, 1e-6, "of the box", false},
      {"refined pose", "eight steps of lengths", measure_refined_pose, 1e-6, "of the box", false},
      {"paper's pose", "three handles", measure_paper_pose, 1e-6, "of the box", false},
      {"layers", "a fourth handle on layer 1", measure_layers, 1e-6, "of the box", false},
      {"proposals", "places, radii, reasons", measure_proposals, 1e-6, "does not depend on the order of the vertices",
       false},
      {"region", "membrane and thin plate", measure_region, 1e-6, "of the box", false},
      {"detail", "carried to another region", measure_detail, 1e-6, "of the box", false},
      {"quads", "places and number", measure_quads, 0.06, "an edge of the quads, of the box", true},
      {"weights", "five bones, and two", measure_weights, 1e-5, "weights are floats", false},
      {"carried from", "weights to clothes", measure_carry_from, 1e-5, "weights are floats", false},
      {"carried to", "weights from clothes", measure_carry_to, 1e-5, "weights are floats", false},
      {"mirrored weights", "across a given plane", measure_mirror, 1e-5, "weights are floats", false},
      {"transfer from", "the source has the change", measure_transfer_from, 1e-6, "of the box", false},
      {"transfer to", "the target has the change", measure_transfer_to, 1e-6, "of the box", false},
      {"stretch to", "the target has the change", measure_stretch, 1e-6, "of the box", false},
  };
  return list;
}

double tolerance_of(const Change& change, const Noun& noun, const Exception** why) {
  *why = nullptr;
  for (const Exception& e : exceptions()) {
    if (e.noun != nullptr && !same(e.noun, noun.name)) continue;
    if (e.change == nullptr ? is_form(change) : !same(e.change, change.name)) continue;
    *why = &e;
    return e.tolerance;
  }
  return is_form(change) ? 0 : noun.tolerance;
}

int judge(const Table& table) {
  int misses = 0;
  for (std::size_t n = 0; n < table.size(); ++n) {
    for (std::size_t c = 0; c < table[n].size(); ++c) {
      const Cell& cell = table[n][c];
      const Exception* why = nullptr;
      const double tolerance = tolerance_of(changes()[c], nouns()[n], &why);
      if ((cell.worst <= tolerance && cell.refused.empty()) || std::isinf(tolerance)) continue;
      ++misses;
      std::printf("MISSED %s, %s: %.2g > %.2g at %s%s%s\n", changes()[c].name, nouns()[n].name, cell.worst, tolerance,
                  cell.where.c_str(), cell.refused.empty() ? "" : "; refused: ", cell.refused.c_str());
    }
  }
  return misses;
}

}  // namespace invariance
