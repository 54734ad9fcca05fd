// Quads, regions and detail of a sequence of bytes (shape_play.h).
#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "../support/place_in.h"
#include "shape_play.h"
#include "support/arrays.h"

namespace shapes {

std::vector<std::uint32_t> Player::take_vertices(unsigned most) {
  std::vector<std::uint32_t> out(1 + bytes_.take() % most);
  for (std::uint32_t& v : out) v = take_vertex();
  return out;
}

// The mesh bent by an angle that grows along x.
std::vector<double> Player::posed() const {
  std::vector<double> out(mesh_.positions.size());
  for (std::size_t v = 0; v < out.size(); v += 3) {
    const double x = static_cast<double>(mesh_.positions[v]), y = static_cast<double>(mesh_.positions[v + 1]),
                 a = 0.4 * x / diagonal_;
    out[v] = x;
    out[v + 1] = y * std::cos(a) - 0.3 * x;
    out[v + 2] = static_cast<double>(mesh_.positions[v + 2]) + y * std::sin(a);
  }
  return out;
}

// What hf/quads.h promises: each directed edge once, no corner twice, the Euler characteristic, places on the surface.
void Player::check_quads(hf_quads quads) const {
  hf_quads_info info = HF_INIT(hf_quads_info);
  expect(HF_OK, hf_quads_get_info(quads, &info), "hf_quads_get_info");
  std::vector<double> positions(3 * std::size_t{info.vertex_count}), weights(positions.size());
  std::vector<std::uint32_t> faces(4 * std::size_t{info.face_count}), corners(positions.size()),
      triangles(info.vertex_count);
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  mesh.vertex_capacity = info.vertex_count;
  mesh.face_capacity = info.face_count;
  mesh.positions = positions.data();
  mesh.faces = faces.data();
  mesh.triangles = triangles.data();
  mesh.barycentrics = weights.data();
  mesh.corners = corners.data();
  expect(HF_OK, hf_quads_get_mesh(quads, &mesh), "hf_quads_get_mesh");
  hold(mesh.vertex_count == info.vertex_count && mesh.face_count == info.face_count, "quads: counts differ");
  hold(finite(positions) && finite(weights), "quads: not finite");
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed, edges;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint32_t a = faces[i], b = faces[i / 4 * 4 + (i + 1) % 4];
    hold(a < info.vertex_count && a != b && a != faces[i / 4 * 4 + (i + 2) % 4], "quads: a face repeats a corner");
    hold(directed.insert({a, b}).second, "quads: a directed edge occurs twice");
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  hold(static_cast<std::int64_t>(info.vertex_count) - static_cast<std::int64_t>(edges.size()) + info.face_count ==
           info.euler_characteristic,
       "quads: another Euler characteristic");
  for (std::size_t v = 0; v < info.vertex_count; ++v) {
    hold(triangles[v] < mesh_.triangles.size() / 3, "quads: a triangle that is not there");
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      hold(corners[3 * v + k] < mesh_.vertex_count(), "quads: a corner that is not there");
      hold(weights[3 * v + k] >= -1e-9, "quads: a place outside its triangle");
      sum += weights[3 * v + k];
    }
    hold(std::fabs(sum - 1) <= 1e-9, "quads: barycentrics of another sum than 1");
  }
}

namespace {

std::vector<double> positions_of(hf_quads quads) {
  hf_quads_info info = HF_INIT(hf_quads_info);
  expect(HF_OK, hf_quads_get_info(quads, &info), "hf_quads_get_info");
  std::vector<double> out(3 * std::size_t{info.vertex_count});
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  mesh.vertex_capacity = info.vertex_count;
  mesh.positions = out.data();
  expect(HF_OK, hf_quads_get_mesh(quads, &mesh), "hf_quads_get_mesh");
  return out;
}

}  // namespace

// Quads, and quads made again with other guides and creases: those of a first call with the same options, bit for bit.
bool Player::quads() {
  const std::uint32_t wanted[] = {0, 30, 200, 1000, 1100, 60, 0, 400};
  const double lengths[] = {0.05, 0.1, 0.3, 0.03};
  const unsigned size = bytes_.take(), parts = bytes_.take();
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = wanted[size % 8];
  if (desc.face_count == 0) desc.edge_length = diagonal_ * lengths[size / 8 % 4];
  desc.relax_count = parts & 1 ? 3 : HF_NO_INDEX;
  if (parts & 2) desc.symmetry_plane[size / 32 % 3] = 1;
  std::vector<std::uint32_t> guided, meeting, creases;
  std::vector<double> vectors, places;
  const auto take_options = [&] {
    guided.clear();
    creases.clear();
    meeting.clear();
    vectors.clear();
    places.clear();
    desc.crease_angle = parts & 4 ? 0.5 : 0.0;
    if (parts & 8) guided = take_vertices(4);
    if (parts & 16) {
      const std::size_t i = bytes_.take() % (mesh_.triangles.size() / 3);
      creases = {mesh_.triangles[3 * i], mesh_.triangles[3 * i + 1]};
    }
    for (std::size_t i = 0; i < guided.size(); ++i) {
      for (int k = 0; k < 3; ++k) vectors.push_back(bytes_.take() % 7 - 3.0);
    }
    if (parts & 32) {
      for (const std::uint32_t v : take_vertices(2)) {
        meeting.push_back(bytes_.take() % 2 ? 3 : 5);
        for (std::size_t k = 0; k < 3; ++k) places.push_back(static_cast<double>(mesh_.positions[3 * v + k]));
      }
    }
    desc.guide_count = static_cast<std::uint32_t>(guided.size());
    desc.guide_vertices = guided.data();
    desc.guide_vectors = vectors.data();
    desc.crease_count = static_cast<std::uint32_t>(creases.size() / 2);
    desc.crease_edges = creases.data();
    desc.irregular_count = static_cast<std::uint32_t>(meeting.size());
    desc.irregular_valences = meeting.data();
    desc.irregular_points = places.data();
    if (guided.empty()) {
      desc.guide_vertices = nullptr;
      desc.guide_vectors = nullptr;
    }
    if (creases.empty()) desc.crease_edges = nullptr;
    if (meeting.empty()) {
      desc.irregular_valences = nullptr;
      desc.irregular_points = nullptr;
    }
  };
  using Quads = Owned<hf_quads, hf_quads_destroy>;
  take_options();
  Quads first;
  if (!done("hf_quads_create", hf_quads_create(surface_, &desc, first.out()), HF_ERROR_INVALID_ARGUMENT,
            HF_ERROR_UNSUPPORTED, HF_ERROR_TOO_LARGE))
    return hold(first == nullptr, "refused quads are no NULL"), false;
  check_quads(first);
  if (!(parts & 64)) return true;
  const std::vector<double> before = positions_of(first);
  take_options();
  Quads fresh;
  const hf_result created = hf_quads_create(surface_, &desc, fresh.out());
  expect(created, hf_quads_update(first, &desc), "hf_quads_update");
  hold(positions_of(first) == (created == HF_OK ? positions_of(fresh) : before),
       "hf_quads_update: other quads");
  return true;
}

// A curve makes the region, rings change it, a clone goes back; then its base, and its detail carried to itself.
bool Player::region() {
  const unsigned how = bytes_.take();
  hf_region_desc options = HF_INIT(hf_region_desc);
  options.base = static_cast<int>(how % 4);
  Owned<hf_region, hf_region_destroy> region;
  if (!done("hf_region_create", hf_region_create(surface_, &options, region.out()), HF_ERROR_NOT_POSITIVE_DEFINITE))
    return false;
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  std::vector<std::uint32_t> places(3 + bytes_.take() % 4);
  std::vector<hf_place> in_triangles;
  curve.point_count = static_cast<std::uint32_t>(places.size());
  curve.kind = how & 4 ? HF_CURVE_EDGES : HF_CURVE_STRAIGHT;
  curve.side = static_cast<int>(how / 8 % 3);
  curve.seed_vertex = take_vertex();
  if (how & 128) {
    for (std::uint32_t& v : places) v = take_vertex();
    curve.vertices = places.data();
  } else {
    for (std::uint32_t& t : places) {
      t = bytes_.take() % static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
      const unsigned w = bytes_.take(), i = w % 9, j = w / 9 % (9 - i);
      const double weights[3] = {i / 8.0, j / 8.0, (8 - i - j) / 8.0};
      in_triangles.push_back(
          place_in(mesh_.triangles.data(), static_cast<std::uint32_t>(mesh_.triangles.size() / 3), t, weights));
    }
    curve.places = in_triangles.data();
  }
  edit.curve = &curve;
  const auto inside = [&](int list) {
    std::uint32_t count = 0;
    expect(HF_OK, hf_region_get_vertices(region, list, 0, nullptr, &count), "hf_region_get_vertices");
    std::vector<std::uint32_t> out(count);
    expect(HF_OK, hf_region_get_vertices(region, list, count, out.data(), &count), "hf_region_get_vertices");
    hold(std::is_sorted(out.begin(), out.end()) && (out.empty() || out.back() < mesh_.vertex_count()),
         "a list of a region is not ascending");
    return out;
  };
  const auto morphed = [&](double weight) {
    std::vector<double> out(mesh_.positions.size());
    hf_morph_desc morph = HF_INIT(hf_morph_desc);
    morph.weight = weight;
    morph.positions = ROWS_OUT(out.data());
    expect(HF_OK, hf_region_morph(region, &morph), "hf_region_morph");
    hold(finite(out), "hf_region_morph: not finite");
    return out;
  };
  if (!done("hf_region_edit", hf_region_edit(region, &edit), HF_ERROR_INVALID_ARGUMENT, HF_ERROR_EMPTY))
    return hold(inside(HF_REGION_INSIDE).empty(), "a refused curve made a region"), false;
  const std::vector<std::uint32_t> first = inside(HF_REGION_INSIDE), rim = inside(HF_REGION_RIM);
  hold(!first.empty() && !rim.empty(), "a curve made an empty region");
  for (const std::uint32_t v : rim)
    hold(!std::binary_search(first.begin(), first.end(), v), "a vertex of the rim is inside");
  std::uint32_t corners = 0;
  expect(HF_OK, hf_region_get_curve(region, 0, nullptr, &corners), "hf_region_get_curve");
  std::vector<double> drawn(3 * std::size_t{corners});
  expect(HF_OK, hf_region_get_curve(region, corners, drawn.data(), &corners), "hf_region_get_curve");
  hold(corners >= 3 && finite(drawn), "a curve of fewer than three corners");
  const std::vector<double> rest = morphed(0), base = morphed(1);
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    const bool moves = std::binary_search(first.begin(), first.end(), v);
    for (std::size_t k = 0; k < 3 && !moves; ++k) {
      // copies of a vertex inside move with the first of them
      const bool copy = base[3 * v + k] != rest[3 * v + k];
      hold(!copy || std::any_of(first.begin(), first.end(),
                                [&](std::uint32_t w) {
                                  return std::memcmp(&mesh_.positions[3 * v], &mesh_.positions[3 * w],
                                                     3 * sizeof(float)) == 0;
                                }),
           "hf_region_morph moves a vertex outside");
    }
  }
  if (how & 32) {
    hf_region before = nullptr;
    expect(HF_OK, hf_region_clone(region, &before), "hf_region_clone");
    hf_region_edit_desc rings = HF_INIT(hf_region_edit_desc);
    rings.ring_count = static_cast<int>(bytes_.take() % 5) - 2;
    const hf_result got = hf_region_edit(region, &rings);
    if (!done("hf_region_edit", got, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_EMPTY))
      hold(inside(HF_REGION_INSIDE) == first && morphed(1) == base, "a refused edit changed a region");
    hf_region_destroy(region);
    *region.out() = before;
    hold(inside(HF_REGION_INSIDE) == first && morphed(1) == base, "hf_region_clone: another region");
  }
  if (how & 64) {
    Owned<hf_detail, hf_detail_destroy> detail;
    if (!done("hf_detail_create", hf_detail_create(region, region, nullptr, detail.out()),
              HF_ERROR_UNSUPPORTED))
      return true;
    std::vector<double> carried(rest.size());
    hf_morph_desc morph = HF_INIT(hf_morph_desc);
    morph.weight = 1;
    morph.positions = ROWS_OUT(carried.data());
    expect(HF_OK, hf_detail_morph(detail, &morph), "hf_detail_morph");
    for (std::size_t i = 0; i < rest.size(); ++i)
      hold(std::fabs(carried[i] - rest[i]) <= 1e-6 * diagonal_, "detail carried to its own region is another");
  }
  return true;
}

void Player::run() {
  mesh_ = take_mesh();
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], static_cast<double>(mesh_.positions[i]));
    high[i % 3] = std::max(high[i % 3], static_cast<double>(mesh_.positions[i]));
  }
  diagonal_ = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  hf_surface_desc desc = reliability::surface_desc(mesh_);
  hf_links_desc linked = HF_INIT(hf_links_desc);
  const unsigned b = bytes_.take();
  linked.mode = HF_LINK_PIECES;
  if (b & 1) desc.links = &linked;
  if (b & 2) desc.thread_count = 2;
  Surface surface;
  if (!done("hf_surface_create", hf_surface_create(&desc, surface.out()), HF_ERROR_EMPTY)) return;
  surface_ = surface;
  for (int calls = 0; !bytes_.done() && calls < 4; ++calls) {
    const unsigned kind = bytes_.take() % kind_count;
    ++outcome_.calls[kind];
    bool result = false;
    if (kind == quads_call) result = quads();
    if (kind == region_call) result = region();
    if (kind == transfer_call) result = transfer();
    if (kind == weights_call) result = weights();
    if (kind == links_call) result = links();
    outcome_.results[kind] += result;
  }
}

Outcome play(const std::uint8_t* bytes, std::size_t size) {
  Outcome outcome;
  try {
    Player(Bytes(bytes, size), outcome).run();
  } catch (const play::Failure& failure) {
    outcome.passed = false;
    outcome.failure = failure.what();
  }
  return outcome;
}

}  // namespace shapes
