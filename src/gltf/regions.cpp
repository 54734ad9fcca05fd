// See regions.h.
#include "gltf/regions.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/node_match.h"

namespace hf_gltf {
namespace {

// A name, or three numbers where a body faces none of the coordinate axes.
glm::dvec3 read_direction(const JsonReader& json) {
  if (json.value().is_array()) {
    const std::vector<double> xyz = json.numbers(3);
    const glm::dvec3 out(xyz[0], xyz[1], xyz[2]);
    const double length = glm::length(out);
    if (!(length > 0) || !std::isfinite(length)) json.fail("three zeros are no direction");
    return out / length;
  }
  const std::string text = json.string();
  const std::string names = "xyz";
  const size_t axis = text.size() == 2 ? names.find(text[1]) : std::string::npos;
  if (axis == std::string::npos || (text[0] != '+' && text[0] != '-'))
    json.fail("expected +x, -x, +y, -y, +z or -z, found \"" + text + "\"");
  glm::dvec3 out(0);
  out[static_cast<int>(axis)] = text[0] == '+' ? 1 : -1;
  return out;
}

std::string listed(const std::vector<std::string>& names, size_t most) {
  std::string out;
  for (size_t i = 0; i < names.size() && i < most; ++i) out += (i ? ", " : "") + names[i];
  return names.size() > most ? out + ", ..." : out;
}

}  // namespace

Axes read_axes(const JsonReader& json) {
  json.expect_only({"up", "forward"});
  Axes axes;
  if (json.has("up")) axes.up = read_direction(json.at("up"));
  if (json.has("forward")) axes.forward = read_direction(json.at("forward"));
  // rounded numbers are a little off the right angle
  constexpr double square = 1e-3;
  const double cosine = glm::dot(axes.up, axes.forward);
  if (std::abs(cosine) > square) json.fail("up and forward must be two axes at a right angle");
  if (cosine != 0) axes.forward = glm::normalize(axes.forward - cosine * axes.up);
  axes.right = glm::cross(axes.up, axes.forward);
  return axes;
}

Selector read_selector(const JsonReader& json) {
  json.expect_only({"joint", "joints", "children", "extreme", "position", "radius", "vertices"});
  Selector out;
  out.where = json.path();
  if (json.has("joint")) out.joints.push_back(json.at("joint").string());
  if (json.has("joints")) {
    for (size_t i = 0; i < json.at("joints").size(); ++i) out.joints.push_back(json.at("joints").at(i).string());
  }
  out.with_children = json.boolean_or("children", false);
  if (json.has("extreme")) {
    out.extreme = json.at("extreme").string();
    const std::vector<std::string> words = {"up", "down", "forward", "back", "left", "right", "away"};
    if (std::find(words.begin(), words.end(), out.extreme) == words.end())
      json.at("extreme").fail("expected one of " + listed(words, 7) +
                              " (left and right of one who looks at its face), found \"" + out.extreme + "\"");
    if (out.joints.empty()) json.fail("\"extreme\" needs \"joint\" or \"joints\": the vertices among which to look");
  }
  if (json.has("position")) {
    const std::vector<double> p = json.at("position").numbers(3);
    out.position = {p[0], p[1], p[2]};
    out.has_position = true;
    if (!out.joints.empty()) json.fail("give \"position\" or a joint, not both");
  }
  if (json.has("radius")) {
    out.radius = json.at("radius").number(0, 1);
    out.has_radius = true;
  }
  if (json.has("vertices")) {
    const JsonReader list = json.at("vertices");
    for (size_t i = 0; i < list.size(); ++i)
      out.vertices.push_back(static_cast<uint32_t>(list.at(i).integer(0, 0xFFFFFFFEll)));
    if (!out.joints.empty() || out.has_position)
      json.fail("\"vertices\" must be the only key; use a list of selectors to join several");
  }
  if (out.joints.empty() && !out.has_position && out.vertices.empty())
    json.fail("expected \"joint\", \"joints\", \"position\" or \"vertices\"");
  return out;
}

RegionFinder::RegionFinder(const Model& model, const FlatMesh& mesh, const Axes& axes)
    : model_(model), mesh_(mesh), axes_(axes), owner_(mesh.positions.size(), -1) {
  for (const glm::dmat4& matrix : global_matrices(model, rest_pose(model)))
    node_place_.push_back(glm::dvec3(matrix[3]));
  for (const FlatPart& part : mesh.parts) {
    const int skin = model.nodes[static_cast<size_t>(part.node)].skin;
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    for (uint32_t v = 0; v < part.vertex_count; ++v) {
      int& owner = owner_[part.first_vertex + v];
      owner = part.node;
      if (skin < 0 || primitive.influences.empty()) continue;
      const Influences& influences = primitive.influences[v];
      const size_t best = static_cast<size_t>(std::max_element(influences.weights.begin(), influences.weights.end()) -
                                              influences.weights.begin());
      owner = model.skins[static_cast<size_t>(skin)].joints[influences.joints[best]];
    }
  }
  neighbours_.resize(mesh.welded_count);
  copies_.resize(mesh.welded_count);
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) copies_[mesh.welded[v]].push_back(v);
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh.welded[mesh.triangles[t + k]], b = mesh.welded[mesh.triangles[t + (k + 1) % 3]];
      if (a != b) {
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
      }
    }
  }
  diagonal_ = SurfaceBox(mesh).diagonal();
}

// The one node of a name. The first of several would be a guess.
int RegionFinder::node_of(const Selector& selector, const std::string& name) const {
  const std::vector<int> nodes = nodes_named(model_, name);
  if (nodes.size() == 1) return nodes.front();
  if (nodes.empty()) {
    std::vector<std::string> names;
    for (const Skin& skin : model_.skins) {
      for (const int joint : skin.joints) names.push_back(model_.nodes[static_cast<size_t>(joint)].name);
    }
    throw std::runtime_error(selector.where + ": " + model_.name + " has no joint \"" + name + "\"; it has " +
                             listed(names, 60));
  }
  throw std::runtime_error(selector.where + ": " + model_.name + " has " + several_joints(name, nodes));
}

std::vector<uint32_t> RegionFinder::owned_by(const Selector& selector) const {
  std::vector<char> wanted(model_.nodes.size(), 0);
  for (const std::string& name : selector.joints) wanted[static_cast<size_t>(node_of(selector, name))] = 1;
  if (selector.with_children) {
    std::vector<int> open;
    for (size_t n = 0; n < wanted.size(); ++n) {
      if (wanted[n]) open.push_back(static_cast<int>(n));
    }
    while (!open.empty()) {
      const Node& node = model_.nodes[static_cast<size_t>(open.back())];
      open.pop_back();
      for (const int child : node.children) {
        if (wanted[static_cast<size_t>(child)]) continue;
        wanted[static_cast<size_t>(child)] = 1;
        open.push_back(child);
      }
    }
  }
  std::vector<uint32_t> out;
  for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    if (!mesh_.loose[v] && owner_[v] >= 0 && wanted[static_cast<size_t>(owner_[v])]) out.push_back(v);
  }
  if (out.empty()) {
    throw std::runtime_error(selector.where + ": no vertex of " + model_.name + " has its largest weight on " +
                             listed(selector.joints, 8) + "; name another joint (--joints FILE lists them)");
  }
  return out;
}

glm::dvec3 RegionFinder::place_of(const Selector& selector) const {
  return selector.joints.empty() ? selector.position
                                 : node_place_[static_cast<size_t>(node_of(selector, selector.joints.front()))];
}

// The vertex a ball grows from.
uint32_t RegionFinder::seed_of(const Selector& selector, const std::vector<uint32_t>& owned) const {
  const glm::dvec3 place = place_of(selector);
  glm::dvec3 direction(0);
  if (selector.extreme == "up" || selector.extreme == "down") direction = axes_.up;
  if (selector.extreme == "forward" || selector.extreme == "back") direction = axes_.forward;
  if (selector.extreme == "right" || selector.extreme == "left") direction = axes_.right;
  if (selector.extreme == "down" || selector.extreme == "back" || selector.extreme == "left") direction = -direction;
  uint32_t best = owned.front();
  double best_value = -std::numeric_limits<double>::infinity();
  for (const uint32_t v : owned) {
    const glm::dvec3& p = mesh_.positions[v];
    double value = -glm::distance(p, place);
    if (selector.extreme == "away") value = -value;
    // ties (a flat top, a left and a right twin) go to the middle of the owned vertices
    if (direction != glm::dvec3(0)) value = glm::dot(p, direction) - 0.05 * glm::distance(p, place);
    if (value > best_value) {
      best_value = value;
      best = v;
    }
  }
  return best;
}

std::vector<uint32_t> RegionFinder::ball(uint32_t seed, double radius) const {
  const glm::dvec3 centre = mesh_.positions[seed];
  std::vector<char> taken(mesh_.welded_count, 0);
  std::vector<uint32_t> out;
  std::queue<uint32_t> open;
  open.push(mesh_.welded[seed]);
  taken[mesh_.welded[seed]] = 1;
  while (!open.empty()) {
    const uint32_t w = open.front();
    open.pop();
    out.insert(out.end(), copies_[w].begin(), copies_[w].end());
    for (const uint32_t next : neighbours_[w]) {
      if (taken[next] || glm::distance(mesh_.positions[copies_[next].front()], centre) > radius) continue;
      taken[next] = 1;
      open.push(next);
    }
  }
  return out;
}

Region RegionFinder::find(const std::vector<Selector>& selectors) const {
  Region out;
  bool has_seed = false;
  for (const Selector& selector : selectors) {
    std::vector<uint32_t> vertices;
    if (!selector.vertices.empty()) {
      for (const uint32_t v : selector.vertices) {
        if (v >= mesh_.vertex_count()) {
          throw std::runtime_error(selector.where + ".vertices: " + model_.name + " has no vertex " +
                                   std::to_string(v) + "; its vertices are 0 to " +
                                   std::to_string(mesh_.vertex_count() - 1));
        }
        vertices.insert(vertices.end(), copies_[mesh_.welded[v]].begin(), copies_[mesh_.welded[v]].end());
      }
    } else {
      if (!selector.joints.empty()) {
        vertices = owned_by(selector);
      } else {
        for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
          if (!mesh_.loose[v]) vertices.push_back(v);
        }
      }
      if (selector.has_radius || selector.has_position || !selector.extreme.empty()) {
        const uint32_t seed = seed_of(selector, vertices);
        vertices = ball(seed, selector.radius * diagonal_);
        if (!has_seed) {
          out.seed = mesh_.positions[seed];
          has_seed = true;
        }
      } else {
        // the copies of an owned vertex may lean to another joint: take them along
        std::vector<uint32_t> all;
        for (const uint32_t v : vertices)
          all.insert(all.end(), copies_[mesh_.welded[v]].begin(), copies_[mesh_.welded[v]].end());
        vertices.swap(all);
      }
    }
    out.vertices.insert(out.vertices.end(), vertices.begin(), vertices.end());
  }
  std::sort(out.vertices.begin(), out.vertices.end());
  out.vertices.erase(std::unique(out.vertices.begin(), out.vertices.end()), out.vertices.end());
  if (!has_seed) {
    for (const uint32_t v : out.vertices) out.seed += mesh_.positions[v] / static_cast<double>(out.vertices.size());
  }
  return out;
}

int RegionFinder::separate(std::vector<Region>& regions, size_t first) const {
  std::vector<int> winner(mesh_.welded_count, -1);
  for (size_t r = 0; r < regions.size(); ++r) {
    for (const uint32_t v : regions[r].vertices) {
      int& best = winner[mesh_.welded[v]];
      if (best >= 0 && static_cast<size_t>(best) < first) continue;
      if (best < 0 || glm::distance(mesh_.positions[v], regions[r].seed) <
                          glm::distance(mesh_.positions[v], regions[static_cast<size_t>(best)].seed))
        best = static_cast<int>(r);
    }
  }
  for (size_t r = first; r < regions.size(); ++r) {
    auto& list = regions[r].vertices;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](uint32_t v) { return winner[mesh_.welded[v]] != static_cast<int>(r); }),
               list.end());
    if (list.empty()) return static_cast<int>(r);
  }
  return -1;
}

const std::string& RegionFinder::owner_name(uint32_t vertex) const {
  static const std::string none;
  return owner_[vertex] < 0 ? none : model_.nodes[static_cast<size_t>(owner_[vertex])].name;
}

bool RegionFinder::is_joint(const std::string& name) const {
  size_t nodes = 0;
  bool joint = false;
  for (size_t n = 0; n < model_.nodes.size(); ++n) {
    if (model_.nodes[n].name != name) continue;
    ++nodes;
    for (const Skin& skin : model_.skins)
      joint = joint || std::find(skin.joints.begin(), skin.joints.end(), static_cast<int>(n)) != skin.joints.end();
  }
  return nodes == 1 && joint;
}

std::vector<std::string> RegionFinder::describe_joints() const {
  struct Owned {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    size_t count = 0;
    bool is_joint = false;
  };
  std::vector<Owned> owned(model_.nodes.size());
  for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    if (owner_[v] < 0 || mesh_.loose[v]) continue;
    Owned& own = owned[static_cast<size_t>(owner_[v])];
    own.low = glm::min(own.low, mesh_.positions[v]);
    own.high = glm::max(own.high, mesh_.positions[v]);
    ++own.count;
  }
  for (const Skin& skin : model_.skins) {
    for (const int joint : skin.joints) owned[static_cast<size_t>(joint)].is_joint = true;
  }
  std::map<std::string, size_t> shown;  // how many lines have a name
  for (size_t n = 0; n < owned.size(); ++n)
    if (owned[n].count > 0 || owned[n].is_joint) ++shown[model_.nodes[n].name];
  std::vector<std::string> lines;
  for (size_t n = 0; n < model_.nodes.size(); ++n) {
    const auto& [low, high, count, is_joint] = owned[n];
    if (count == 0 && !is_joint) continue;
    std::string name = model_.nodes[n].name;
    if (shown[name] > 1) name += " (#" + std::to_string(n) + ")";
    char line[256];
    if (count > 0) {
      std::snprintf(line, sizeof line, "%-24s %6zu vertices, x %.3f..%.3f y %.3f..%.3f z %.3f..%.3f", name.c_str(),
                    count, low.x, high.x, low.y, high.y, low.z, high.z);
    } else {
      std::snprintf(line, sizeof line, "%-24s      - at %.3f %.3f %.3f", name.c_str(), node_place_[n].x,
                    node_place_[n].y, node_place_[n].z);
    }
    lines.emplace_back(line);
  }
  return lines;
}

}  // namespace hf_gltf
