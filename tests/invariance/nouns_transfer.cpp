// Transfers between a body and a stretched one, with the change on either side.
#include <algorithm>
#include <cmath>

#include "gltf/flat_mesh.h"
#include "setting.h"
#include "support/arrays.h"

namespace invariance {
namespace {

// Another body of the same connectivity: taller, and wider above.
Body stretched(const Body& body) {
  Body out = body;
  for (Vec& p : out.points) {
    const double height = (p[1] - body.low[1]) / body.diagonal;
    p = {hf_gltf::float_rounded(p[0] * (1 + 0.3 * height)),
         hf_gltf::float_rounded(body.low[1] + 1.25 * (p[1] - body.low[1])), hf_gltf::float_rounded(1.1 * p[2])};
  }
  return out;
}

// A motion of the source: it bends over to one side, the more the higher, and the whole walks on.
Vec bent(const Body& body, const Vec& p) {
  const double height = (p[1] - body.low[1]) / body.diagonal;
  const double angle = 0.8 * height, c = std::cos(angle), s = std::sin(angle);
  const Vec q = p - body.low;
  return body.low + Vec{c * q[0] + s * q[1], c * q[1] - s * q[0], q[2] + 0.1 * body.diagonal * height * height};
}

std::vector<double> frame_of(const Setting& s) {
  std::vector<double> out;
  for (std::size_t v = 0; v < s.copy.points.size(); ++v) {
    // a button moves with the body
    const Vec p = s.place(bent(s.body, s.back(s.copy.points[v])));
    out.insert(out.end(), p.begin(), p.end());
  }
  return out;
}

// Rows right, up, forward; a mirrored body has its right on the other side.
void set_axes(const Setting& s, double* out) {
  const Vec up = s.turn({0, 1, 0}), forward = s.turn({0, 0, 1}), right = cross(up, forward);
  for (int k = 0; k < 3; ++k) {
    out[k] = right[k];
    out[3 + k] = up[k];
    out[6 + k] = forward[k];
  }
}

struct Regions {
  std::vector<std::uint32_t> counts, vertices;
  Regions(const Setting& s, const std::vector<std::uint32_t>& picks) {
    for (const std::uint32_t pick : picks) {
      const std::vector<std::uint32_t> region = s.vertices(ball(s.body, pick, 0.3 * s.body.spacing));
      counts.push_back(static_cast<std::uint32_t>(region.size()));
      vertices.insert(vertices.end(), region.begin(), region.end());
    }
  }
};

// Five pairs; the lowest is a foot, the highest an anchor.
std::vector<std::uint32_t> paired(const Body& body) {
  std::vector<std::uint32_t> out(body.picks.begin(), body.picks.begin() + 5);
  std::sort(out.begin(), out.end(),
            [&](std::uint32_t a, std::uint32_t b) { return body.points[a][1] < body.points[b][1]; });
  return out;
}

Measured transferred(const Setting& source, const Setting& target, std::int32_t mode) {
  hf_transfer_desc d = HF_INIT(hf_transfer_desc);
  d.mode = mode;
  set_axes(source, d.source_axes);
  set_axes(target, d.target_axes);
  Owned<hf_transfer, hf_transfer_destroy> transfer;
  ok(hf_transfer_create(source.surface(), target.surface(), &d, transfer.out()));
  const std::vector<std::uint32_t> picks = paired(source.body);
  // the picks of both are those of the source: they have the same vertices
  const Regions from(source, picks), to(target, picks);
  const std::uint32_t flags[] = {HF_PAIR_FOOT, 0, 0, 0, HF_PAIR_ANCHOR | HF_PAIR_TRUNK};
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 5;
  pairs.source_counts = from.counts.data();
  pairs.source_vertices = from.vertices.data();
  pairs.target_counts = to.counts.data();
  pairs.target_vertices = to.vertices.data();
  pairs.flags = flags;
  ok(hf_transfer_add_pairs(transfer, &pairs, nullptr));
  const std::vector<double> posed = frame_of(source);
  std::vector<double> out_positions(3 * target.copy.points.size());
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
  frame.target_positions = ROWS_OUT(out_positions.data());
  ok(hf_transfer_apply(transfer, &frame));
  Measured out;
  out.add("positions", target.gather_places(out_positions), target.body.diagonal);
  return out;
}

// The other side of a transfer has no change. It is mirrored with a mirrored body: a motion to the left stays one.
Copy other_copy(const Setting& s, const Body& other) { return s.copy.mirrored ? mirrored(other) : plain_copy(other); }

}  // namespace

Measured measure_transfer_from(const Setting& s) {
  const Body other = stretched(s.body);
  Copy plain = other_copy(s, other);
  index_copy(other, plain);
  return transferred(s, Setting(other, plain), HF_TRANSFER_FIELDS);
}

// The body with the change takes the motion of the stretched one.
Measured measure_transfer_to(const Setting& s) {
  const Body other = stretched(s.body);
  Copy plain = other_copy(s, other);
  index_copy(other, plain);
  return transferred(Setting(other, plain), s, HF_TRANSFER_FIELDS);
}

Measured measure_stretch(const Setting& s) {
  const Body other = stretched(s.body);
  Copy plain = other_copy(s, other);
  index_copy(other, plain);
  return transferred(Setting(other, plain), s, HF_TRANSFER_STRETCH);
}

}  // namespace invariance
