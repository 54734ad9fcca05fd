#include "deform/limbs.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::deform {
namespace {

// The limb ends where this is largest. On a tube the area grows like the fall, on a trunk much faster. With the power 1
// a tube has no end, and an arm ends at a thin wrist. With 2 a short, thick arm has no end before the whole body has.
double limb_measure(double fall, double area) { return fall * std::sqrt(fall) / area; }

// The limb continues while the measure is at least this share of the best, a little into the trunk, so that the steps
// can turn a shoulder. With 0.8 the head of a biped belongs to its arm.
constexpr double limb_margin = 0.85;

// Returns the field's value where the limb ends. vertices: of the component, outside handles, in order of falling
// field.
// area: of the handle.
double limb_end(const surface::Core& core, FieldColumn<const double> field, double area,
                Span<const std::int32_t> vertices) {
  double best = 0, end = 1;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double level = field[vertices[i]];
    area += core.areas[static_cast<std::size_t>(vertices[i])];
    if (i + 1 < vertices.size() && field[vertices[i + 1]] == level) continue;  // behind other handles all are 0
    const double measure = limb_measure(1 - level, area);
    best = std::max(best, measure);
    if (measure >= limb_margin * best) end = level;
  }
  return end;
}

// K_LL. place: by vertex, its row in it, or -1.
SymmetricMatrix part_of(const SymmetricMatrix& k, Span<const std::int32_t> vertices, Span<const std::int32_t> place,
                        Memory& memory) {
  SymmetricMatrix part(memory);
  part.column_start.push_back(0);
  for (const std::int32_t v : vertices) {
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      if (place[k.row[e]] < 0) continue;
      part.row.push_back(place[k.row[e]]);
      part.value.push_back(k.value[e]);
    }
    part.column_start.push_back(static_cast<std::int32_t>(part.row.size()));
  }
  return part;
}

}  // namespace

Vector<std::int32_t> limb_of(const surface::Core& core, const Reach& reach, const HandleFields& fields,
                             std::int32_t handle, Memory& memory) {
  const FieldColumn<const double> field = fields.of(handle);
  const SharedVector<Index>& component = core.mesh.component;
  const std::size_t components = static_cast<std::size_t>(core.mesh.component_count());
  Vector<std::uint8_t> meant(components, 0, &memory);  // another handle moves the component too
  for (std::size_t c = 0; c < components; ++c) {
    const Span<const std::int32_t> handles = reach.handles_of(static_cast<std::int32_t>(c));
    meant[c] = handles.size() > 1 && std::binary_search(handles.begin(), handles.end(), handle);
  }
  Vector<double> area(components, 0.0, &memory);  // of the handle
  Vector<std::int32_t> limb(&memory), vertices(&memory);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (!meant[component[v]]) continue;
    if (reach.owner[v] < 0) vertices.push_back(v);
    if (reach.owner[v] == handle) area[component[v]] += core.areas[static_cast<std::size_t>(v)];
  }
  std::sort(vertices.begin(), vertices.end(), [&](std::int32_t a, std::int32_t b) {
    if (component[a] != component[b]) return component[a] < component[b];
    return field[a] != field[b] ? field[a] > field[b] : a < b;
  });
  for (std::size_t first = 0, last = 0; first < vertices.size(); first = last) {
    const std::int32_t c = component[vertices[first]];
    while (last < vertices.size() && component[vertices[last]] == c) ++last;
    const double end = limb_end(core, field, area[c], {vertices.data() + first, last - first});
    for (std::size_t i = first; i < last && field[vertices[i]] >= end; ++i) limb.push_back(vertices[i]);
  }
  std::sort(limb.begin(), limb.end());
  return limb;
}

Limbs make_limbs(const surface::Core& core, const Reach& reach, const HandleFields& fields,
                 Span<const std::uint32_t> steps, Memory& memory) {
  Limbs limbs(memory);
  if (std::all_of(steps.begin(), steps.end(), [](std::uint32_t k) { return k == 0; })) return limbs;
  const std::size_t n = static_cast<std::size_t>(core.size());
  Vector<std::int32_t> place(n, -1, &memory);
  Vector<std::uint8_t> near(n, 0, &memory);
  for (std::size_t h = 0; h < steps.size(); ++h) {
    if (steps[h] == 0) continue;
    limbs.steps = std::max(limbs.steps, steps[h]);
    for (const std::int32_t v : limb_of(core, reach, fields, static_cast<std::int32_t>(h), memory)) place[v] = 0;
  }
  const SymmetricMatrix& k = core.matrix();
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (place[v] < 0) continue;
    place[v] = limbs.size();
    limbs.vertex.push_back(v);
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) near[k.row[e]] = 1;
  }
  if (limbs.vertex.empty()) return limbs;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (near[v]) limbs.around.push_back(v);
  }
  Vector<float> coordinates(&memory);
  for (const std::int32_t v : limbs.vertex) {
    const Vec3 p = core.mesh.positions[v];
    for (const double x : {p.x, p.y, p.z}) coordinates.push_back(static_cast<float>(x));
  }
  limbs.factor = factor::Factor::make(part_of(k, limbs.vertex, place, memory), coordinates, {}, memory, *core.jobs);
  return limbs;
}

}  // namespace hf_inner::deform
