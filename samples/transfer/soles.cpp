// See soles.h.
#include "transfer/soles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "gltf/animate.h"
#include "transfer/posed_region.h"

namespace samples {
namespace {

// Each number was halved and doubled on eight walks and runs of people and robots of five authors; the confidence of no
// run changes by more than its line says. So they only have to be of the right size.

// Vertices of a leg below this share of the height are its sole: a shoe up to the ankle. Half takes thin soles, double
// takes shins, whose lowest points are the same (0.002).
constexpr double sole_height = 0.07;
// A sole stands below this share of the height: a rolling heel lifts that far. Half drops the frames in which a foot
// rolls, double takes toes that swing close over the ground (0.005).
constexpr double stands_below = 0.015;
// Vertices this near to the lowest carry the sole: the thickness of its edge. Half slides on a corner, double on heel
// and toes at once (0.005).
constexpr double carries = 0.01;
// A sole that its clip puts deeper into the ground than this does not stand, so that a clip in water or snow says
// nothing about feet. Half leaves out runs whose toes dip, double takes falls (0.009).
constexpr double stands_above = -0.06;
// A sole that goes faster against the ground than this, in heights a second, does not stand: it swings. Half
// leaves out feet that drag, double takes steps (0.009).
constexpr double standing_speed = 0.5;

// The joint or node that moves each vertex most.
std::vector<int> owners_of(const Model& model, const FlatMesh& mesh) {
  std::vector<int> out(mesh.positions.size(), -1);
  for (const FlatPart& part : mesh.parts) {
    const Node& node = model.nodes[static_cast<size_t>(part.node)];
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    for (uint32_t v = 0; v < part.vertex_count; ++v) {
      int& owner = out[part.first_vertex + v];
      owner = part.node;
      if (node.skin < 0 || primitive.influences.empty()) continue;
      const Influences& all = primitive.influences[v];
      const auto most = std::max_element(all.weights.begin(), all.weights.end()) - all.weights.begin();
      owner = model.skins[static_cast<size_t>(node.skin)].joints[all.joints[static_cast<size_t>(most)]];
    }
  }
  return out;
}

struct Sole {
  int side = 0;
  double along = 0;  // forward of the middle
  std::vector<uint32_t> vertices;
};

struct Standing {
  const StandingBody& body;
  std::vector<Sole> soles;
  double ground = 0, height = 1;

  explicit Standing(const StandingBody& given) : body(given) {
    const std::vector<uint8_t> out = beside_body(body), flesh = beside_flesh(body);
    const std::vector<double> rest = double_positions(body.mesh.positions);
    const glm::dvec3& up = body.known.axes.up;
    const std::vector<int> owners = owners_of(body.model, body.mesh);
    // The ground is under the feet: a pickaxe may hang lower.
    std::vector<uint8_t> no_feet = out;
    for (size_t v = 0; v < no_feet.size() && !body.known.nodes.empty(); ++v)
      no_feet[v] = no_feet[v] || body.known.nodes[static_cast<size_t>(owners[v])].part != BodyPart::leg;
    ground = lowest_of(rest, up, no_feet);
    if (!std::isfinite(ground)) ground = lowest_of(rest, up, flesh);
    height = -lowest_of(rest, -up, flesh) - ground;
    std::map<int, Sole> found;
    for (uint32_t v = 0; v < owners.size(); ++v) {
      if (out[v] || owners[v] < 0 || body.known.nodes.empty()) continue;
      const KnownNode& node = body.known.nodes[static_cast<size_t>(owners[v])];
      if (node.part != BodyPart::leg || node.limb < 0) continue;
      if (glm::dot(body.mesh.positions[v], up) > ground + sole_height * height) continue;
      Sole& sole = found[node.limb];
      sole.side = node.side;
      sole.vertices.push_back(v);
    }
    for (auto& [limb, sole] : found) {
      for (const uint32_t v : sole.vertices)
        sole.along +=
            glm::dot(body.mesh.positions[v], body.known.axes.forward) / static_cast<double>(sole.vertices.size());
      soles.push_back(std::move(sole));
    }
    std::sort(soles.begin(), soles.end(),
              [](const Sole& a, const Sole& b) { return a.side != b.side ? a.side < b.side : a.along < b.along; });
  }

  double low(const Sole& sole, const std::vector<double>& frame) const {
    double out = std::numeric_limits<double>::infinity();
    for (const uint32_t v : sole.vertices) out = std::min(out, height_of(v, frame));
    return out;
  }
  double height_of(uint32_t v, const std::vector<double>& frame) const {
    return glm::dot(body.known.axes.up, glm::dvec3(frame[3 * v], frame[3 * v + 1], frame[3 * v + 2])) - ground;
  }
  // Along the ground, of the vertices that carry the foot in the first frame.
  glm::dvec3 step(const Sole& sole, const std::vector<double>& from, const std::vector<double>& to) const {
    const double least = low(sole, from);
    glm::dvec3 sum(0);
    double count = 0;
    for (const uint32_t v : sole.vertices) {
      if (height_of(v, from) > least + carries * height) continue;
      for (int c = 0; c < 3; ++c) sum[c] += to[3 * v + static_cast<size_t>(c)] - from[3 * v + static_cast<size_t>(c)];
      count += 1;
    }
    sum /= std::max(count, 1.0);
    return sum - glm::dot(sum, body.known.axes.up) * body.known.axes.up;
  }
};

double middle_value(std::vector<double> list) {
  std::nth_element(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2), list.end());
  return list[list.size() / 2];
}

}  // namespace

std::vector<uint8_t> beside_body(const StandingBody& body) {
  std::vector<uint8_t> out = body.mesh.loose;
  // nodes of the body, and what hangs on them
  std::vector<uint8_t> of_body(body.model.nodes.size(), 0);
  for (size_t n = 0; n < body.known.nodes.size(); ++n) {
    for (int k = static_cast<int>(n); k >= 0 && !of_body[n]; k = body.model.nodes[static_cast<size_t>(k)].parent)
      of_body[n] = body.known.nodes[static_cast<size_t>(k)].part != BodyPart::other;
  }
  if (std::none_of(of_body.begin(), of_body.end(), [](uint8_t is) { return is != 0; })) return out;
  const std::vector<int> owners = owners_of(body.model, body.mesh);
  std::vector<uint8_t> skinned(body.model.nodes.size(), 0);
  for (const Skin& skin : body.model.skins)
    for (const int joint : skin.joints) skinned[static_cast<size_t>(joint)] = 1;
  for (size_t v = 0; v < out.size(); ++v) {
    const auto owner = static_cast<size_t>(owners[v]);
    out[v] = out[v] || (!of_body[owner] && !skinned[owner]);
  }
  // a body of which nothing is left is taken whole
  return std::all_of(out.begin(), out.end(), [](uint8_t is) { return is != 0; }) ? body.mesh.loose : out;
}

std::vector<uint8_t> beside_flesh(const StandingBody& body) {
  std::vector<uint8_t> out = beside_body(body);
  if (body.known.nodes.empty()) return out;
  const std::vector<int> owners = owners_of(body.model, body.mesh);
  const auto part = [&](int node) { return body.known.nodes[static_cast<size_t>(node)].part; };
  for (size_t v = 0; v < out.size(); ++v) {
    int node = owners[v];
    if (part(node) != BodyPart::other) continue;
    while (node >= 0 && part(node) == BodyPart::other) node = body.model.nodes[static_cast<size_t>(node)].parent;
    out[v] = out[v] || (node >= 0 && (part(node) == BodyPart::hand || part(node) == BodyPart::finger));
  }
  return std::all_of(out.begin(), out.end(), [](uint8_t is) { return is != 0; }) ? body.mesh.loose : out;
}

double slide_of(const StandingBody& source, const StandingBody& target, double scale, const std::vector<double>& times,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames) {
  if (source.mesh.triangles.empty() || times.size() < 3) return -1;
  const Standing a(source), b(target);
  if (a.soles.empty() || a.soles.size() != b.soles.size()) return -1;
  const Axes &x = source.known.axes, &y = target.known.axes;
  const glm::dmat3 across = glm::dmat3(y.right, y.up, y.forward) * glm::transpose(glm::dmat3(x.right, x.up, x.forward));
  struct Step {
    glm::dvec3 source, target;  // a second
  };
  std::vector<Step> steps;
  for (size_t k = 0; k < a.soles.size(); ++k) {
    if (a.soles[k].side != b.soles[k].side) return -1;
    for (size_t f = 0; f + 1 < times.size(); ++f) {
      const double seconds = times[f + 1] - times[f];
      const auto stands = [&](const std::vector<double>& frame) {
        const double low = a.low(a.soles[k], frame) / a.height;
        return low < stands_below && low > stands_above;
      };
      if (!stands(source_frames[f]) || !stands(source_frames[f + 1])) continue;
      steps.push_back({1 / seconds * a.step(a.soles[k], source_frames[f], source_frames[f + 1]),
                       1 / seconds * b.step(b.soles[k], target_frames[f], target_frames[f + 1])});
    }
  }
  if (steps.empty()) return -1;
  glm::dvec3 ground(0);  // a clip on the spot walks on ground that moves
  for (int c = 0; c < 3; ++c) {
    std::vector<double> list;
    for (const Step& step : steps) list.push_back(step.source[c]);
    ground[c] = middle_value(std::move(list));
  }
  const double speed = glm::length(ground);
  double along = 0, squares = 0;
  for (const Step& step : steps) {
    if (glm::length(step.source - ground) > standing_speed * a.height) continue;
    const glm::dvec3 by = scale * (across * step.source);
    along += glm::dot(step.target, by);
    squares += glm::dot(by, by);
  }
  const bool on_the_spot = speed > 0.1 * a.height && squares > 0;
  const glm::dvec3 still = (on_the_spot ? std::clamp(along / squares, 0.5, 1.5) : 1.0) * scale * (across * ground);
  double sum = 0, count = 0;
  for (const Step& step : steps) {
    if (glm::length(step.source - ground) > standing_speed * a.height) continue;
    const double own = scale * glm::length(step.source - ground);
    sum += std::max(0.0, glm::length(step.target - still) - own);
    count += 1;
  }
  return count > 0 ? sum / count / SurfaceBox(target.mesh).diagonal() : -1;
}

double hover_of(const StandingBody& source, const StandingBody& target, double scale,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames) {
  if (source.mesh.triangles.empty()) return -1;
  const Standing a(source), b(target);
  if (a.soles.empty() || b.soles.empty()) return -1;
  const auto lowest = [](const Standing& body, const std::vector<double>& frame) {
    double out = std::numeric_limits<double>::infinity();
    for (const Sole& sole : body.soles) out = std::min(out, body.low(sole, frame));
    return out;
  };
  double sum = 0, count = 0;
  for (size_t f = 0; f < std::min(source_frames.size(), target_frames.size()); ++f) {
    const double by = lowest(a, source_frames[f]);
    if (by > stands_below * a.height || by < stands_above * a.height) continue;
    sum += std::max(0.0, lowest(b, target_frames[f]) - scale * std::max(0.0, by));
    count += 1;
  }
  return count > 0 ? sum / count / SurfaceBox(target.mesh).diagonal() : -1;
}

std::vector<Fastening> fastenings_of(const StandingBody& body, const std::vector<int>& nodes) {
  constexpr size_t most_own = 64;  // of its vertices are compared; a pack has no more corners that touch
  // A pack stands off the back by this share of the box at most: half loses one on thick straps, double takes a tree
  // that the body passes.
  constexpr double touches = 0.02;
  const FlatMesh& mesh = body.mesh;
  const std::vector<uint8_t> beside = beside_body(body);
  const Standing standing(body);
  const auto place = [&](size_t v) { return mesh.positions[v]; };
  struct Box {
    glm::dvec3 low{1e300}, high{-1e300};
    void add(const glm::dvec3& p) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    bool has(const glm::dvec3& p, double slack) const { return p == glm::clamp(p, low - slack, high + slack); }
  };
  Box around;
  std::vector<uint32_t> flesh;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.loose[v] || beside[v]) continue;
    flesh.push_back(v);
    around.add(place(v));
  }
  std::vector<Fastening> out;
  const double diagonal = SurfaceBox(mesh).diagonal(), slack = touches * diagonal;
  for (const int node : nodes) {
    Fastening found;
    found.node = node;
    found.box = diagonal;
    Box box;
    std::vector<uint32_t> own;
    for (const FlatPart& part : mesh.parts) {
      int above = part.node;
      while (above >= 0 && above != node) above = body.model.nodes[static_cast<size_t>(above)].parent;
      for (uint32_t v = part.first_vertex; above == node && v < part.first_vertex + part.vertex_count; ++v) {
        if (mesh.loose[v]) continue;
        own.push_back(v);
        box.add(place(v));
      }
    }
    // Ground, a room or a hill is no higher than the soles, or larger than the body.
    const auto under_soles = [&](uint32_t v) {
      return glm::dot(body.known.axes.up, place(v)) < standing.ground + carries * standing.height;
    };
    if (own.empty() || flesh.empty() || std::all_of(own.begin(), own.end(), under_soles) ||
        glm::distance(box.low, box.high) > glm::distance(around.low, around.high))
      continue;
    if (glm::any(glm::greaterThan(box.low - slack, around.high)) ||
        glm::any(glm::lessThan(box.high + slack, around.low)) ||
        std::none_of(flesh.begin(), flesh.end(), [&](uint32_t v) { return box.has(place(v), slack); }))
      continue;
    found.apart = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < own.size(); k += std::max<size_t>(1, own.size() / most_own)) {
      for (const uint32_t v : flesh) {
        const double distance = glm::distance(place(own[k]), place(v));
        if (distance >= found.apart) continue;
        found.apart = distance;
        found.own = own[k];
        found.other = v;
      }
    }
    out.push_back(found);
  }
  return out;
}

double comes_off(const Fastening& fastening, const std::vector<std::vector<double>>& frames) {
  double out = 0;
  for (const std::vector<double>& frame : frames) {
    const auto at = [&](size_t v) { return glm::dvec3(frame[3 * v], frame[3 * v + 1], frame[3 * v + 2]); };
    out = std::max(out, glm::distance(at(fastening.own), at(fastening.other)) - fastening.apart);
  }
  return out / fastening.box;
}

namespace {

// Mean squares of second differences, by part and side of the body.
std::map<std::pair<BodyPart, int>, double> squares_of(const StandingBody& body,
                                                      const std::vector<std::vector<double>>& frames) {
  std::map<std::pair<BodyPart, int>, double> sums, counts;
  const std::vector<uint8_t> out = beside_body(body);
  const std::vector<int> owners = owners_of(body.model, body.mesh);
  for (size_t v = 0; v < owners.size(); ++v) {
    if (out[v] || owners[v] < 0 || body.known.nodes.empty()) continue;
    const KnownNode& node = body.known.nodes[static_cast<size_t>(owners[v])];
    const bool arm = node.part == BodyPart::hand || node.part == BodyPart::finger;
    const std::pair<BodyPart, int> part(arm ? BodyPart::arm : node.part, node.side);
    if (part.first == BodyPart::other) continue;
    for (size_t f = 1; f + 1 < frames.size(); ++f) {
      for (size_t c = 3 * v; c < 3 * v + 3; ++c) {
        const double d = frames[f + 1][c] - 2 * frames[f][c] + frames[f - 1][c];
        sums[part] += d * d;
      }
      counts[part] += 1;
    }
  }
  for (auto& [part, sum] : sums) sum /= counts[part];
  return sums;
}

}  // namespace

double acceleration_of(const StandingBody& source, const StandingBody& target, double scale,
                       const std::vector<std::vector<double>>& source_frames,
                       const std::vector<std::vector<double>>& target_frames) {
  constexpr double still = 1e-10;  // in squares of the box: as motion_faults has it
  const auto from = squares_of(source, source_frames), to = squares_of(target, target_frames);
  const double box = SurfaceBox(target.mesh).diagonal();
  if (!source.mesh.triangles.empty()) scale = std::max(scale, box / SurfaceBox(source.mesh).diagonal());
  double a = 0, b = 0;
  for (const auto& [part, square] : from) {
    const auto found = to.find(part);
    if (found == to.end()) continue;
    a += scale * scale * square / (box * box);
    b += found->second / (box * box);
  }
  return a > still ? std::sqrt(b / a) : 0;
}

Depths depth_of(const StandingBody& source, const StandingBody& target, double scale,
                const std::vector<uint8_t>& source_out, const std::vector<uint8_t>& target_out,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames) {
  const bool has_source = !source.mesh.triangles.empty();
  const glm::dvec3 &up = target.known.axes.up, &source_up = source.known.axes.up;
  const double ground = lowest_of(double_positions(target.mesh.positions), up, target_out),
               source_ground =
                   has_source ? lowest_of(double_positions(source.mesh.positions), source_up, source_out) : 0;
  const double box = SurfaceBox(target.mesh).diagonal();
  Depths out;
  for (size_t f = 0; f < target_frames.size(); ++f) {
    const double sinks =
        has_source ? std::min(0.0, lowest_of(source_frames[f], source_up, source_out) - source_ground) : 0;
    out.source = std::max(out.source, -scale * sinks / box);
    out.beyond = std::max(out.beyond, (ground + scale * sinks - lowest_of(target_frames[f], up, target_out)) / box);
  }
  return out;
}

}  // namespace samples
