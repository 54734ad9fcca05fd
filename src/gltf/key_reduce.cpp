// See key_reduce.h.
#include "gltf/key_reduce.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gltf/animate.h"

namespace hf_gltf {
namespace {

// A channel's part of the tolerance: errors of a chain of joints add up, and some cancel. The part is halved until the
// clip is within the tolerance. After this many halvings the clip keeps its keys.
constexpr double first_part = 2;
constexpr int most_halvings = 9;
// Then larger parts are tried, between the last that was too large and the first that was not.
constexpr int more_parts = 3;
// Straight lines between few keys bend at the keys: a calm motion then accelerates more than it did. The root mean
// square acceleration may be this many times as large. If it is larger, a key is left out only where it misses by less:
// by half of the tolerance for each key in the gap. This half is halved again most_calming times. If that is not
// enough, rotations are not rounded to 16 bits.
constexpr double most_acceleration = 1.03;
constexpr int most_calming = 10;
// A vertex belongs to a joint with a larger weight.
constexpr float least_weight = 0.01f;

// How far the furthest vertex of each node and of the nodes below it is from the node's origin at rest.
std::vector<double> reach_of(const Model& model, const FlatMesh& mesh) {
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  std::vector<double> out(model.nodes.size(), 0.0);
  const auto add = [&](int node, const glm::dvec3& place) {
    for (int n = node; n >= 0; n = model.nodes[static_cast<size_t>(n)].parent) {
      const auto k = static_cast<size_t>(n);
      out[k] = std::max(out[k], glm::distance(place, glm::dvec3(globals[k][3])));
    }
  };
  for (const FlatPart& part : mesh.parts) {
    const int skin = model.nodes[static_cast<size_t>(part.node)].skin;
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    for (uint32_t i = 0; i < part.vertex_count; ++i) {
      if (mesh.loose[part.first_vertex + i]) continue;
      const glm::dvec3& place = mesh.positions[part.first_vertex + i];
      if (skin < 0 || primitive.influences.empty()) {
        add(part.node, place);
        continue;
      }
      const Influences& influences = primitive.influences[i];
      for (size_t k = 0; k < influences.weights.size(); ++k)
        if (influences.weights[k] > least_weight)
          add(model.skins[static_cast<size_t>(skin)].joints[influences.joints[k]], place);
    }
  }
  return out;
}

// How far a vertex may move when the key `between` is left out between the keys a and b.
double miss(const Channel& channel, size_t a, size_t between, size_t b, double reach, double unit) {
  const double s = static_cast<double>(channel.times[between] - channel.times[a]) /
                   static_cast<double>(channel.times[b] - channel.times[a]);
  const auto value = [&](size_t key, size_t c) { return static_cast<double>(channel.values[key * channel.width + c]); };
  if (channel.path == Path::rotation) {
    const auto q = [&](size_t key) { return glm::dquat(value(key, 3), value(key, 0), value(key, 1), value(key, 2)); };
    const glm::dquat line = glm::slerp(q(a), q(b), s);
    // twice the chord; 1 minus the product of two rotations in floats loses angles below 7e-4
    const double sign = glm::dot(line, q(between)) < 0 ? -1 : 1;
    return 2 * glm::length(line - sign * q(between)) * reach;
  }
  double sum = 0;
  for (size_t c = 0; c < channel.width; ++c) {
    const double d = value(between, c) - (1 - s) * value(a, c) - s * value(b, c);
    sum += d * d;
  }
  return std::sqrt(sum) * (channel.path == Path::scale ? reach : unit);
}

// bend: the bound for each key of a gap, a length.
Channel reduced(const Channel& from, double reach, double unit, double tolerance, double bend) {
  Channel out = from;
  out.times.clear();
  out.values.clear();
  const auto keep = [&](size_t key) {
    out.times.push_back(from.times[key]);
    out.values.insert(out.values.end(), from.values.begin() + static_cast<std::ptrdiff_t>(key * from.width),
                      from.values.begin() + static_cast<std::ptrdiff_t>((key + 1) * from.width));
  };
  keep(0);
  const size_t last = from.times.size() - 1;
  const auto holds = [&](size_t key) {  // until the next key
    const auto value = from.values.begin() + static_cast<std::ptrdiff_t>(key * from.width);
    return std::equal(value, value + static_cast<std::ptrdiff_t>(from.width),
                      value + static_cast<std::ptrdiff_t>(from.width));
  };
  for (size_t a = 0; a < last;) {
    size_t b = a + 1;
    while (b < last && holds(b - 1) == holds(b)) {  // a node at rest stays at rest
      bool good = true;
      const double most = std::min(tolerance, bend * static_cast<double>(b - a));
      for (size_t k = a + 1; k <= b && good; ++k) good = miss(from, a, k, b + 1, reach, unit) <= most;
      if (!good) break;
      ++b;
    }
    keep(b);
    a = b;
  }
  // a channel that stays where it starts needs one key
  if (out.times.size() == 2 && from.times.size() > 2) {
    bool still = true;
    for (size_t c = 0; c < out.width; ++c) still = still && out.values[c] == out.values[out.width + c];
    if (still) {
      out.times.resize(1);
      out.values.resize(out.width);
    }
  }
  return out;
}

// Half the bytes: an angle is off by at most 6e-5 radians.
void to_shorts(Channel& channel) {
  for (float& value : channel.values) value = static_cast<float>(std::lround(value * 32767)) / 32767;
  channel.shorts = true;
}

}  // namespace

size_t key_count(const Animation& animation) {
  size_t out = 0;
  for (const Channel& channel : animation.channels) out += channel.times.size();
  return out;
}

double reduce_keys(const Model& model, const FlatMesh& mesh, Animation& animation, double tolerance) {
  if (!(tolerance > 0)) return 0;
  const std::vector<double> reach = reach_of(model, mesh), times = key_times(animation);
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  SurfacePoser surface(model, mesh);
  std::vector<std::vector<glm::dvec3>> wanted;
  for (const double time : times) wanted.push_back(surface.at(animation, time));
  double squares = 0;  // of accelerations
  const auto squares_at = [&](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b,
                              const std::vector<glm::dvec3>& c) {
    double sum = 0;
    for (size_t v = 0; v < a.size(); ++v) {
      if (mesh.loose[v]) continue;
      const glm::dvec3 bend = a[v] - 2.0 * b[v] + c[v];
      sum += glm::dot(bend, bend);
    }
    return sum;
  };
  for (size_t f = 1; f + 1 < times.size(); ++f) squares += squares_at(wanted[f - 1], wanted[f], wanted[f + 1]);
  double bend = std::numeric_limits<double>::infinity(), got_squares = 0;
  bool shorts = true;
  // Makes the clip with a part of the tolerance for each channel. Returns how far a vertex moves at most.
  const auto reduce = [&](double part, Animation& fresh) {
    fresh = animation;
    got_squares = 0;
    for (Channel& channel : fresh.channels) {
      if (channel.interpolation != Interpolation::linear || channel.path == Path::weights || channel.times.size() < 3)
        continue;
      const auto node = static_cast<size_t>(channel.node);
      const int up = model.nodes[node].parent;
      const double unit = up < 0 ? 1 : glm::length(glm::dvec3(globals[static_cast<size_t>(up)][0]));
      channel = reduced(channel, reach[node], unit, part * tolerance, bend);
      if (channel.path == Path::rotation && shorts) to_shorts(channel);
    }
    double worst = 0;
    std::vector<glm::dvec3> before, last;
    for (size_t f = 0; f < times.size() && worst <= tolerance; ++f) {
      std::vector<glm::dvec3> got = surface.at(fresh, times[f]);
      for (size_t v = 0; v < got.size(); ++v)
        if (!mesh.loose[v]) worst = std::max(worst, glm::distance(got[v], wanted[f][v]));
      if (f > 1) got_squares += squares_at(before, last, got);
      before = std::move(last);
      last = std::move(got);
    }
    if (worst > tolerance) got_squares = std::numeric_limits<double>::infinity();  // not all frames were added
    return worst;
  };
  Animation fresh, best;
  double part = first_part, worst = reduce(part, fresh);
  for (int halving = 0; worst > tolerance; ++halving) {
    if (halving == most_halvings) return 0;
    part /= 2;
    worst = reduce(part, fresh);
  }
  best = fresh;
  double step = part == first_part ? 0 : part / 2;
  for (int k = 0; k < more_parts && step > 0; ++k, step /= 2) {
    const double moved = reduce(part + step, fresh);
    if (moved > tolerance) continue;
    part += step;
    worst = moved;
    best = fresh;
  }
  const double most = most_acceleration * most_acceleration * squares;
  reduce(part, fresh);
  for (const bool rounded : {true, false}) {
    if (got_squares <= most) break;
    shorts = rounded;
    bend = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_calming && got_squares > most; ++k) {
      bend = k == 0 ? tolerance / 2 : bend / 2;
      const double moved = reduce(part, fresh);
      if (moved <= tolerance) {
        worst = moved;
        best = fresh;
      }
    }
  }
  animation = std::move(best);
  return worst;
}

}  // namespace hf_gltf
