#include "quads/counted_quads.h"

#include <algorithm>
#include <cmath>

#include "quads/numbers.h"
#include "remesh/coarsen.h"

namespace hf_inner::quads {
namespace {

// Where pieces between the lines are no discs, the next edge length is this share of the one before: smaller takes less
// tries, larger leaves less quads to remove. At 0.5, 19 % more corners are turned over in 21 runs. At 0.85, four tries
// do not suffice for a sheet with holes: it gets the quads of its triangles, 118 times as many as wanted.
constexpr double shorter = 0.7;
// At most this many shorter edges are tried. Then triangles are split into quads, which can be many. With 2, a sheet
// with holes gets 119 times as many as wanted. With 8 five runs that need a try stay the same.
constexpr std::int32_t most_tries = 4;
// The same where lines of creases or borders were left out. Shorter edges do not bring them back. A comb of 64,000
// corners fails four times and takes 1.4 s; with one try it takes 1.3 s. No shared mesh that leaves lines out needs a
// try, with creases of 20 and 30 degrees.
constexpr std::int32_t tries_without_lines = 1;
// A number of faces this near to the wanted one is good. The result is 1.4 % off on average. At 0.01 it is 1.0 %, with
// a tenth more tries. At 0.04 it is 2.2 %. Then 2 of 15 runs take 2.4 times as long: fitting aims twice (fitted_error).
constexpr double faces_error = 0.02;
// At most this many tries to come so near. With 2 the result is 1.9 % off on average, with 8 it is 1.3 %.
constexpr std::int32_t count_tries = 4;
// A component smaller than so many quads that loses its shape gets the fewest quads there can be, six or one. A value
// of 12 changes two of 16 runs of models with parts: irregular vertices by 6 % at most. A value of 48 changes four. A
// spider at 800 quads then has 18 instead of 52 % irregular vertices, but the rods of a model of 21 parts are 3.0
// instead of 1.1 % off.
constexpr double few_quads = 24;

double area_of(const remesh::FluxSurface& surface, std::int32_t t) {
  const Vec3 a = surface.position[surface.tail[3 * t]];
  return 0.5 *
         norm(cross(surface.position[surface.tail[3 * t + 1]] - a, surface.position[surface.tail[3 * t + 2]] - a));
}

// The quads of `a` in the components with first[component], and the quads of `b` in the others.
QuadComplex joined(const QuadComplex& a, const remesh::Table<std::int32_t>& component_a,
                   const remesh::Table<std::uint8_t>& first, const QuadComplex& b,
                   const remesh::Table<std::int32_t>& component_b, Memory& memory) {
  QuadComplex all(memory);
  remesh::Table<std::uint8_t> take(memory);
  for (const std::int32_t c : component_a) take.push_back(first[c]);
  all.append(a, take, memory);
  take.clear();
  for (const std::int32_t c : component_b) take.push_back(!first[c]);
  all.append(b, take, memory);
  return all;
}
}  // namespace

double area_of(const remesh::FluxSurface& surface) {
  double sum = 0;
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) sum += area_of(surface, t);
  return sum;
}

double miss_of(double ratio) noexcept { return std::max(ratio, 1 / std::max(ratio, 1e-9)) - 1; }

QuadSource::QuadSource(const remesh::FluxSurface& surface, GridMapper& mapper,
                       const remesh::Table<std::uint8_t>& features, bool once, bool strict, Memory& memory)
    : surface_(surface),
      mapper_(mapper),
      features_(features),
      once_(once),
      strict_(strict),
      memory_(memory),
      substitute_(memory),
      of_substitute_(surface.component_count, 0, memory),
      area_(surface.component_count, 0.0, memory),
      creased_(surface.component_count, 0, memory) {
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    const std::int32_t c = surface.component[surface.tail[h]];
    if (h % 3 == 0) area_[c] += area_of(surface, h / 3);
    creased_[c] |= features[h] && surface.is_real(surface.twin[h]);
  }
}

QuadSource::Found QuadSource::find_in_map(double length, bool untangled, FieldQuadReport& report) {
  const GridMap map = mapper_.make(length, untangled);
  Found out(memory_);
  std::int32_t backward = 0;
  out.quads = extract_quads(surface_, map, features_, backward, memory_);
  RepairReport repaired;
  repair_quads(surface_, out.quads, repaired, memory_);
  out.component = components_of(surface_, out.quads, memory_);
  out.sound = find_sound(surface_, out.quads, out.component, area_, memory_);
  report.turned_over = map.turned_over;
  report.roundings = map.roundings;
  report.backward = backward;
  report.removed = repaired.removed;
  report.added = repaired.added;
  return out;
}

QuadSource::Found QuadSource::find(double length, bool untangled, FieldQuadReport& report) {
  ++report.tries;
  Found found = find_in_map(length, untangled, report);
  if (std::find(found.sound.begin(), found.sound.end(), 0) == found.sound.end()) return found;
  // Lines that run to and fro in a fold can be the only ones around a thin part.
  FieldQuadReport unused;
  const Found other = find_in_map(length, !untangled, unused);
  remesh::Table<std::uint8_t> keep(found.sound.size(), 0, memory_);
  for (std::int32_t c = 0; c < keep.size(); ++c) keep[c] = found.sound[c] || !other.sound[c];
  found.quads = joined(found.quads, found.component, keep, other.quads, other.component, memory_);
  found.component = components_of(surface_, found.quads, memory_);
  for (std::int32_t c = 0; c < keep.size(); ++c) found.sound[c] |= other.sound[c];
  return found;
}

QuadComplex QuadSource::make(double length, bool untangled, FieldQuadReport& report) {
  report.substitutes = 0;
  Found found = find(length, untangled, report);
  remesh::Table<std::uint8_t>& sound = found.sound;
  remesh::Table<std::uint8_t> missing(sound.size(), 0, memory_), small(sound.size(), 0, memory_);
  // A component of one quad in the map gets quads with the corners of its outline.
  remesh::Table<std::int32_t> count(sound.size(), 0, memory_);
  for (const std::int32_t c : found.component) ++count[c];
  for (std::int32_t c = 0; c < sound.size(); ++c)
    small[c] =
        (!sound[c] || count[c] == 1) && !of_substitute_[c] && !creased_[c] && area_[c] < few_quads * length * length;
  substitute_.append(least_quads(surface_, area_, small, memory_), memory_);
  bool any = false, all = true;
  for (std::int32_t c = 0; c < sound.size(); ++c) {
    of_substitute_[c] |= small[c];
    report.substitutes += !sound[c];
    missing[c] = !sound[c] && !of_substitute_[c];
    any |= missing[c] != 0;
    sound[c] = sound[c] && !(count[c] == 1 && of_substitute_[c]);
    all = all && sound[c];
  }
  if (any && strict_) throw LostComponent{};
  if (any) substitute(length, untangled, missing, report);
  if (all) return std::move(found.quads);
  return joined(found.quads, found.component, sound, substitute_, components_of(surface_, substitute_, memory_),
                memory_);
}

void QuadSource::substitute(double length, bool untangled, remesh::Table<std::uint8_t>& missing,
                            FieldQuadReport& report) {
  const std::int32_t tries = mapper_.left_out() > 0 ? tries_without_lines : most_tries;
  for (std::int32_t i = 0; i < tries; ++i) {
    length *= shorter;
    FieldQuadReport unused;
    const Found found = find(length, untangled, unused);
    ++report.tries;
    remesh::Table<std::uint8_t> take(memory_);
    for (const std::int32_t c : found.component) take.push_back(missing[c] && found.sound[c]);
    substitute_.append(found.quads, take, memory_);
    bool open = false;
    for (std::int32_t c = 0; c < missing.size(); ++c) {
      of_substitute_[c] |= missing[c] && found.sound[c];
      missing[c] = missing[c] && !found.sound[c];
      open |= missing[c] != 0;
    }
    if (!open) return;
  }
  if (once_) {
    mapper_.release();
    released_ = true;
  }
  const QuadComplex split = split_triangles(surface_, features_, missing, memory_);
  substitute_.append(split, memory_);
  for (std::int32_t c = 0; c < missing.size(); ++c) {
    of_substitute_[c] |= missing[c];
    report.split += missing[c];
  }
}

remesh::QuadMesh CountedQuads::make(bool untangled, FieldQuadReport& made) {
  QuadComplex quads(memory_);
  double length = edge_length_, best = -1;
  for (std::int32_t round = 0; round < count_tries; ++round) {
    QuadComplex found = source_.make(length, untangled, made);
    const double ratio = found.quad_count() / wanted_, error = miss_of(ratio);
    const bool better = best < 0 || error < best;
    if (better) {
      best = error;
      quads = std::move(found);
      made.edge_length = length;
    }
    // A component that is shorter than the lines cannot come nearer.
    if (!by_count_ || error <= faces_error || (made.substitutes > 0 && (!better || ratio > 1))) break;
    length *= std::sqrt(ratio);
  }
  length_ = made.edge_length;
  return coarsened(quads, by_count_ || made.substitutes > 0, made);
}

remesh::QuadMesh CountedQuads::make_finer(double share, bool untangled, FieldQuadReport& made) {
  QuadComplex quads = source_.make(share * length_, untangled, made);
  made.edge_length = share * length_;
  return coarsened(quads, true, made);
}

remesh::QuadMesh CountedQuads::coarsened(QuadComplex& quads, bool limited, FieldQuadReport& made) {
  const std::int32_t most = static_cast<std::int32_t>((1 + faces_error) * wanted_);
  if (limited)
    made.chords = collapse_chords(quads, most, static_cast<std::int32_t>((1 - faces_error) * wanted_), memory_);
  remesh::QuadMesh mesh = quads.mesh(memory_);
  if (limited) {
    if (made.substitutes > 0 || mesh.face_count() > most) made.edge_length = edge_length_;
    remesh::collapse_to_count(surface_, mesh, most, edge_length_, memory_);
  }
  return mesh;
}

}  // namespace hf_inner::quads
