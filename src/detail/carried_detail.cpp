#include "detail/carried_detail.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "detail/constants.h"
#include "detail/morph.h"

namespace hf_inner::detail {
namespace {

struct Frame {
  Vec3 x, y, z;
};

Vec3 across(Vec3 v, Vec3 normal) noexcept { return v - dot(v, normal) * normal; }

// Makes an orthonormal frame. Its z axis is the normal; its x axis is the direction, projected across the normal. If
// the direction is 0 or parallel to the normal, a coordinate axis replaces it.
Frame frame_of(Vec3 normal, Vec3 direction) noexcept {
  const Vec3 z = unit_normal(normal);
  Vec3 x = across(direction, z);
  if (!(norm(x) > least_direction * norm(direction)) || !(norm(x) > 0)) {
    const bool upright = std::fabs(z.x) > upright_cosine;
    x = across(upright ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, z);
  }
  x = (1 / norm(x)) * x;
  return {x, cross(z, x), z};
}

// Returns one frame of the smooth base surface for every vertex inside the region.
Vector<Frame> base_frames(const RegionSurface& surface, const RegionState& state, Span<const DiscPoint> disc,
                          Memory& memory) {
  const RegionShape& shape = *state.shape;
  const Vector<Vec3> base = morphed_positions(surface, state, 1.0, memory);
  const Vector<Vec3> normal = local_normal_sums(state, base, memory);
  Vector<Vec3> direction(base.size(), &memory);
  for (std::size_t i = 0; i < shape.corners.size(); i += 3) {
    const Index* c = &shape.corners[i];
    const Vec3 b = base[at(c[1])] - base[at(c[0])], d = base[at(c[2])] - base[at(c[0])];
    // `grows` is the derivative of the position by the disc coordinate u, times twice the triangle's area in the disc.
    const Vec3 grows = (disc[at(c[2])].v - disc[at(c[0])].v) * b - (disc[at(c[1])].v - disc[at(c[0])].v) * d;
    for (int k = 0; k < 3; ++k) direction[at(c[k])] = direction[at(c[k])] + grows;
  }
  Vec3 whole_normal, whole_direction;
  double largest = 0;
  for (std::size_t i = 0; i < shape.inside.size(); ++i) {
    whole_normal = whole_normal + normal[i];
    whole_direction = whole_direction + direction[i];
    largest = std::max(largest, norm(normal[i]));
  }
  Vector<Frame> frames(&memory);
  frames.reserve(shape.inside.size());
  for (std::size_t i = 0; i < shape.inside.size(); ++i) {
    const bool degenerate = !(norm(normal[i]) > least_normal * largest);
    frames.push_back(degenerate ? frame_of(whole_normal, whole_direction) : frame_of(normal[i], direction[i]));
  }
  return frames;
}

// Finds the position of each pinned vertex (matched with one of the other region) along the boundary loop. Checks that
// they go round it in order.
void place_pins(const Region& region, const DiscBoundary& boundary, Span<const Index> vertices, const char* name,
                DiscPins& pins) {
  const RegionState& state = *region.state();
  const mesh::Mesh& mesh = region.core().mesh;
  const auto place_of = [&](Index v) {
    const Index local = v < 0 ? -1 : state.shape->local[at(v)];
    return local < 0 ? -1 : boundary.place(local);
  };
  if (vertices.empty()) {
    Index place = place_of(state.first);
    for (std::size_t i = 0; place < 0 && i < state.shape->rim.size(); ++i) place = place_of(state.shape->rim[i]);
    pins.place.push_back(std::max(place, 0));
    return;
  }
  const Index size = static_cast<Index>(boundary.loop.size());
  Index before = -1;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index place = place_of(vertices[i]), given = mesh.given_of_inner[at(vertices[i])];
    const std::uint32_t index = static_cast<std::uint32_t>(i);
    if (place < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of %s: vertex %d is not on the region's rim", i, name, given);
    const Index further = i == 0 ? 0 : (place - pins.place[0] + size) % size;
    if (further <= before)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of %s: vertex %d does not follow the one before it counter-clockwise along the rim", i, name,
           given);
    before = further;
    pins.place.push_back(place);
  }
}

}  // namespace

CarriedDetail carry_detail(const Region& source, const Region& target, const CarryOptions& options, Memory& memory) {
  constexpr float one_disc = 0.4f, two_discs = 0.8f;  // reported progress, by the usual share of time
  report(0.0f);
  const RegionSurface &from = *source.surface(), &to = *target.surface();
  const std::shared_ptr<const RegionState> from_state = source.state();
  const DiscBoundary from_rim(from, *from_state, memory), to_rim(to, *target.state(), memory);
  DiscPins from_pins(memory), to_pins(memory);
  place_pins(source, from_rim, options.source_pins, "source_vertices", from_pins);
  place_pins(target, to_rim, options.target_pins, "target_vertices", to_pins);
  // The boundary vertices that match on both regions get the same angles on the disc. The angles follow the arc length
  // along the source's boundary.
  const std::size_t size = from_rim.loop.size();
  for (const Index place : from_pins.place) {
    const double s = from_rim.arc[at(place)] - from_rim.arc[at(from_pins.place[0])];
    from_pins.turn.push_back((s < 0 ? s + from_rim.arc[size] : s) / from_rim.arc[size]);
  }
  to_pins.turn.assign(from_pins.turn.begin(), from_pins.turn.end());
  const Vector<DiscPoint> from_disc = map_to_disc(from, *from_state, from_rim, from_pins, memory);
  report(one_disc);
  const Vector<DiscPoint> to_disc = map_to_disc(to, *target.state(), to_rim, to_pins, memory);
  report(two_discs);

  CarriedDetail carried{target.surface(), target.state(), Vector<Vec3>(&memory)};
  const double scale = options.scale > 0           ? options.scale
                       : from_state->base_area > 0 ? std::sqrt(carried.state->base_area / from_state->base_area) *
                                                         (to.core->mesh.scale / from.core->mesh.scale)
                                                   : 1.0;
  const RegionShape& from_shape = *from_state->shape;
  const Vector<Frame> from_frames = base_frames(from, *from_state, from_disc, memory);
  Vector<Vec3> local(at(from_shape.local_count()), &memory);  // Stays 0 on the region's boundary.
  for (std::size_t i = 0; i < from_shape.inside.size(); ++i) {
    const Vec3 d = from.position(from_shape.inside[i]) - from_state->base[i];
    const Frame& f = from_frames[i];
    local[i] = {dot(f.x, d), dot(f.y, d), dot(f.z, d)};
  }
  const DiscSearch search(from_shape.corners, from_disc, memory);
  const Vector<Frame> to_frames = base_frames(to, *carried.state, to_disc, memory);
  carried.offset.resize(carried.state->shape->inside.size());
  for (std::size_t i = 0; i < carried.offset.size(); ++i) {
    double weights[3];
    const Index t = search.find(to_disc[i], weights);
    Vec3 c;
    for (std::size_t k = 0; k < 3; ++k) c = c + weights[k] * local[at(from_shape.corners[3 * at(t) + k])];
    const Frame& f = to_frames[i];
    carried.offset[i] = scale * (c.x * f.x + c.y * f.y + c.z * f.z);
  }
  report(1.0f);
  return carried;
}

}  // namespace hf_inner::detail
