#include "quads/quad_model.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "quads/surface_distance.h"

namespace samples {
namespace {

const Primitive& primitive_of(const Model& model, const FlatPart& part) {
  const int mesh = model.nodes[static_cast<size_t>(part.node)].mesh;
  return model.meshes[static_cast<size_t>(mesh)].primitives[static_cast<size_t>(part.primitive)];
}

struct Place {
  uint32_t triangle;
  glm::dvec3 weights;
};

class Charts {
 public:
  Charts(const Model& model, const FlatMesh& flat) : flat_(flat), of_(flat.triangle_count()) {
    part_.reserve(of_.size());
    for (uint32_t p = 0; p < flat.parts.size(); ++p) part_.insert(part_.end(), flat.parts[p].triangle_count, p);
    std::iota(of_.begin(), of_.end(), 0u);
    struct Side {
      uint32_t low, high;  // welded vertices
      uint32_t triangle, at_low, at_high;
    };
    std::vector<Side> sides;
    for (uint32_t t = 0; t < of_.size(); ++t) {
      for (uint32_t k = 0; k < 3; ++k) {
        uint32_t a = flat.triangles[3 * size_t{t} + k], b = flat.triangles[3 * size_t{t} + (k + 1) % 3];
        if (flat.welded[a] > flat.welded[b]) std::swap(a, b);
        sides.push_back({flat.welded[a], flat.welded[b], t, a, b});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.triangle < y.triangle;
    });
    for (size_t i = 1; i < sides.size(); ++i) {
      const Side &x = sides[i - 1], &y = sides[i];
      if (x.low != y.low || x.high != y.high || part_[x.triangle] != part_[y.triangle]) continue;
      const FlatPart& part = flat.parts[part_[x.triangle]];
      const Primitive& primitive = primitive_of(model, part);
      const uint32_t first = part.first_vertex;
      if (is_same(primitive, x.at_low - first, y.at_low - first) &&
          is_same(primitive, x.at_high - first, y.at_high - first))
        join(x.triangle, y.triangle);
    }
    for (uint32_t t = 0; t < of_.size(); ++t) of_[t] = find(t);
  }

  uint32_t of(uint32_t triangle) const { return of_[triangle]; }
  uint32_t part_of(uint32_t triangle) const { return part_[triangle]; }

  // The place on the chart nearest to p.
  Place nearest(uint32_t chart, const glm::dvec3& p) {
    Tree& tree = trees_[chart];
    if (!tree.nearest) {
      if (by_chart_.empty()) {
        by_chart_.resize(of_.size());
        for (uint32_t t = 0; t < of_.size(); ++t) by_chart_[of_[t]].push_back(t);
      }
      tree.soup.positions = &flat_.positions;
      for (const uint32_t t : by_chart_[chart])
        tree.soup.triangles.insert(tree.soup.triangles.end(), &flat_.triangles[3 * size_t{t}],
                                   &flat_.triangles[3 * size_t{t}] + 3);
      tree.nearest = std::make_unique<NearestPoint>(tree.soup);
    }
    uint32_t found = 0;
    tree.nearest->distance(p, &found);
    return place_in(by_chart_[chart][found], p);
  }
  // The chart of the triangle nearest to p.
  uint32_t at(const glm::dvec3& p) {
    if (!whole_.nearest) {
      whole_.soup = {&flat_.positions, flat_.triangles};
      whole_.nearest = std::make_unique<NearestPoint>(whole_.soup);
    }
    uint32_t found = 0;
    whole_.nearest->distance(p, &found);
    return of_[found];
  }

 private:
  struct Tree {
    SharedSoup soup;
    std::unique_ptr<NearestPoint> nearest;
  };
  static bool is_same(const Primitive& primitive, uint32_t v, uint32_t w) {
    if (v == w) return true;
    for (const auto& set : primitive.texcoords)
      if (set[v] != set[w]) return false;
    return primitive.colors.empty() || primitive.colors[v] == primitive.colors[w];
  }
  uint32_t find(uint32_t t) {
    while (of_[t] != t) t = of_[t] = of_[of_[t]];
    return t;
  }
  void join(uint32_t s, uint32_t t) {
    s = find(s);
    t = find(t);
    of_[std::max(s, t)] = std::min(s, t);
  }
  // The weights of the point of a triangle's plane nearest to p, with those below 0 cut off.
  Place place_in(uint32_t t, const glm::dvec3& p) const {
    const auto corner = [&](size_t k) { return flat_.positions[flat_.triangles[3 * size_t{t} + k]]; };
    const glm::dvec3 x = corner(1) - corner(0), y = corner(2) - corner(0), d = p - corner(0);
    const double xx = dot(x, x), xy = dot(x, y), yy = dot(y, y), area = xx * yy - xy * xy;
    glm::dvec3 w(1, 0, 0);
    if (area > 0) {
      w.y = (yy * dot(d, x) - xy * dot(d, y)) / area;
      w.z = (xx * dot(d, y) - xy * dot(d, x)) / area;
      w.x = 1 - w.y - w.z;
      w = glm::max(w, 0.0);
    }
    return {t, w / (w.x + w.y + w.z)};
  }

  const FlatMesh& flat_;
  std::vector<uint32_t> of_, part_;
  std::vector<std::vector<uint32_t>> by_chart_;
  std::map<uint32_t, Tree> trees_;
  Tree whole_;
};

// Three vertices of a primitive of the model.
struct Source {
  const Primitive* primitive;
  uint32_t vertex[3];
  glm::dvec3 weights;
};

// Whether what moves the vertices of one primitive can move those of the other.
bool moves_alike(const Primitive& x, const Primitive& y) {
  if (x.influences.empty() != y.influences.empty() || x.targets.size() != y.targets.size()) return false;
  for (size_t t = 0; t < x.targets.size(); ++t) {
    const MorphTarget &a = x.targets[t], &b = y.targets[t];
    if (a.positions.empty() != b.positions.empty() || a.normals.empty() != b.normals.empty()) return false;
  }
  return true;
}

// One vertex of the new primitive from three of the old one.
class Carrier {
 public:
  Carrier(const Primitive& from, Primitive& to) : from_(from), to_(to) {
    to_.topology = from.topology;
    to_.material = from.material;
    to_.carried = from.carried;
    to_.texcoords.resize(from.texcoords.size());
    to_.targets.resize(from.targets.size());
    to_.carried_attributes = from.carried_attributes;
    for (auto& item : to_.carried_attributes) {
      item.second.count = 0;
      item.second.bytes.clear();
    }
    size_t most = 4;
    for (const Influences& given : from.influences) most = given.weights[4] > 0 ? 8 : most;
    slots_ = most;
  }

  // look: in this part, what it is painted with. motion: what moves it, the same for all copies at a seam, so that none
  // opens; of another part if that has the same joints and targets.
  uint32_t add(const Source& look, const Source& motion) {
    to_.positions.push_back(mix(look, from_.positions));
    for (size_t s = 0; s < from_.texcoords.size(); ++s) to_.texcoords[s].push_back(mix(look, from_.texcoords[s]));
    if (!from_.colors.empty()) to_.colors.push_back(mix(look, from_.colors));
    // the side is that of the nearest corner
    const int nearest = static_cast<int>(std::max_element(&look.weights[0], &look.weights[0] + 3) - &look.weights[0]);
    if (!from_.tangents.empty()) {
      to_.tangents.push_back(mix(look, from_.tangents));
      to_.tangents.back().w = from_.tangents[look.vertex[nearest]].w;
    }
    for (size_t t = 0; t < from_.targets.size(); ++t) {
      const MorphTarget &own = from_.targets[t], &target = motion.primitive->targets[t];
      if (!own.positions.empty()) to_.targets[t].positions.push_back(mix(motion, target.positions));
      if (!own.normals.empty()) to_.targets[t].normals.push_back(mix(motion, target.normals));
    }
    if (!from_.influences.empty()) to_.influences.push_back(influences(motion));
    // numbers of unknown meaning have no mean: those of the nearest corner
    for (size_t a = 0; a < from_.carried_attributes.size(); ++a) {
      const CarriedNumbers& own = from_.carried_attributes[a].second;
      CarriedNumbers& to = to_.carried_attributes[a].second;
      const size_t row = own.bytes.size() / own.count;
      const auto at = own.bytes.begin() + static_cast<std::ptrdiff_t>(row * look.vertex[nearest]);
      to.bytes.insert(to.bytes.end(), at, at + static_cast<std::ptrdiff_t>(row));
      ++to.count;
    }
    return static_cast<uint32_t>(to_.positions.size() - 1);
  }

 private:
  template <class Value>
  static Value mix(const Source& at, const std::vector<Value>& list) {
    Value sum(0);
    for (int k = 0; k < 3; ++k) sum += static_cast<float>(at.weights[k]) * list[at.vertex[k]];
    return sum;
  }
  // The sum of the three, its largest weights, scaled to 1.
  Influences influences(const Source& at) const {
    std::map<uint16_t, double> sum;
    for (int k = 0; k < 3; ++k) {
      const Influences& given = at.primitive->influences[at.vertex[k]];
      for (size_t i = 0; i < given.joints.size(); ++i)
        if (given.weights[i] > 0) sum[given.joints[i]] += at.weights[k] * static_cast<double>(given.weights[i]);
    }
    std::vector<std::pair<uint16_t, double>> order(sum.begin(), sum.end());
    std::stable_sort(order.begin(), order.end(), [](const auto& x, const auto& y) { return x.second > y.second; });
    order.resize(std::min(order.size(), slots_));
    double total = 0;
    for (const auto& [joint, weight] : order) total += weight;
    Influences out;
    for (size_t i = 0; i < order.size(); ++i) {
      if (!(total > 0)) break;
      out.joints[i] = order[i].first;
      out.weights[i] = static_cast<float>(order[i].second / total);
    }
    return out;
  }

  const Primitive& from_;
  Primitive& to_;
  size_t slots_ = 4;  // joints of a vertex: 4, or 8 if the model has so many
};

// What one part gets.
struct NewPart {
  Primitive primitive;
  std::vector<glm::dvec3> positions;                            // where its vertices are at rest, in the scene
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> of_corner;  // vertex of the quads and chart -> vertex
  uint32_t last_first = UINT32_MAX;                             // first corner of the face before
  bool used = false;
};

// Adds a face as a fan. FB_ngon_encoding parts faces by their first corner, which must not be that of the face before.
void add_face(NewPart& part, std::vector<uint32_t> corners, bool mirrored) {
  if (mirrored) std::reverse(corners.begin() + 1, corners.end());
  // two corners on: the fan of a quad has the same diagonal
  if (corners[0] == part.last_first)
    std::rotate(corners.begin(), corners.begin() + (corners.size() == 4 ? 2 : 1), corners.end());
  part.last_first = corners[0];
  for (size_t k = 1; k + 1 < corners.size(); ++k)
    part.primitive.indices.insert(part.primitive.indices.end(), {corners[0], corners[k], corners[k + 1]});
}

std::string with_ngons(const std::string& extensions) {
  const std::string entry = "\"FB_ngon_encoding\":{}";
  const size_t end = extensions.rfind('}');
  if (extensions.find("FB_ngon_encoding") != std::string::npos) return extensions;
  if (end == std::string::npos || extensions.find('"') == std::string::npos) return "{" + entry + "}";
  return extensions.substr(0, end) + "," + entry + "}";
}

}  // namespace

Model quad_model(const Model& model, const FlatMesh& flat, const SurfaceMesh& quads, const QuadPlaces& places) {
  if (places.triangles.size() != quads.positions.size() || places.barycentrics.size() != 3 * quads.positions.size())
    throw std::runtime_error(model.name + ": the places do not fit the quads.");
  Model out = model;
  scatter(out, flat, flat.positions);  // each node gets a mesh of its own
  Charts charts(out, flat);
  std::vector<NewPart> parts(flat.parts.size());
  std::vector<Carrier> carriers;
  for (size_t p = 0; p < parts.size(); ++p)
    carriers.emplace_back(primitive_of(model, flat.parts[p]), parts[p].primitive);
  const auto source_at = [&](const Place& place) {
    const FlatPart& part = flat.parts[charts.part_of(place.triangle)];
    Source source{&primitive_of(model, part), {}, place.weights};
    for (size_t i = 0; i < 3; ++i)
      source.vertex[i] = flat.triangles[3 * size_t{place.triangle} + i] - part.first_vertex;
    return source;
  };
  const auto skin_of = [&](const FlatPart& part) { return model.nodes[static_cast<size_t>(part.node)].skin; };
  size_t first = 0;
  for (const uint32_t size : quads.face_sizes) {
    const uint32_t* corner = &quads.face_vertices[first];
    first += size;
    uint32_t chart = charts.of(places.triangles[corner[0]]);
    glm::dvec3 middle(0);
    bool one = true;
    for (uint32_t k = 0; k < size; ++k) {
      one = one && charts.of(places.triangles[corner[k]]) == chart;
      middle += quads.positions[corner[k]];
    }
    if (!one) chart = charts.at(middle / static_cast<double>(size));
    const uint32_t number = charts.part_of(chart);
    NewPart& part = parts[number];
    part.used = true;
    std::vector<uint32_t> corners;
    for (uint32_t k = 0; k < size; ++k) {
      const uint32_t v = corner[k];
      const auto found = part.of_corner.emplace(std::make_pair(v, chart), 0);
      if (found.second) {
        const Place own{places.triangles[v],
                        {places.barycentrics[3 * size_t{v}], places.barycentrics[3 * size_t{v} + 1],
                         places.barycentrics[3 * size_t{v} + 2]}};
        const bool here = charts.of(own.triangle) == chart;
        const Source look = source_at(here ? own : charts.nearest(chart, quads.positions[v])), moved = source_at(own);
        const FlatPart &x = flat.parts[charts.part_of(own.triangle)], &y = flat.parts[number];
        const bool alike = (x.node == y.node || (skin_of(x) >= 0 && skin_of(x) == skin_of(y))) &&
                           moves_alike(*moved.primitive, *look.primitive);
        found.first->second = carriers[number].add(look, alike ? moved : look);
        part.positions.push_back(quads.positions[v]);
      }
      corners.push_back(found.first->second);
    }
    add_face(part, std::move(corners), flat.parts[number].mirrored);
  }
  // The new primitives, then their positions in the frame of their node and joints.
  std::map<int, std::vector<Primitive>> of_mesh;
  std::vector<glm::dvec3> positions;
  for (size_t p = 0; p < parts.size(); ++p) {
    const int mesh = out.nodes[static_cast<size_t>(flat.parts[p].node)].mesh;
    std::vector<Primitive>& list = of_mesh[mesh];
    if (!parts[p].used) continue;
    parts[p].primitive.carried.extensions = with_ngons(parts[p].primitive.carried.extensions);
    list.push_back(std::move(parts[p].primitive));
    positions.insert(positions.end(), parts[p].positions.begin(), parts[p].positions.end());
  }
  for (auto& [mesh, list] : of_mesh) {
    for (Primitive& old : out.meshes[static_cast<size_t>(mesh)].primitives)
      if (old.topology != Topology::triangles) list.push_back(std::move(old));
    out.meshes[static_cast<size_t>(mesh)].primitives = std::move(list);
  }
  // A mesh without a quad goes from its node, and with it what moves its morph targets.
  for (size_t n = 0; n < out.nodes.size(); ++n) {
    Node& node = out.nodes[n];
    if (node.mesh < 0 || !out.meshes[static_cast<size_t>(node.mesh)].primitives.empty()) continue;
    node.mesh = node.skin = -1;
    node.weights.clear();
    for (Animation& animation : out.animations) {
      auto& list = animation.channels;
      list.erase(
          std::remove_if(list.begin(), list.end(),
                         [&](const Channel& c) { return c.node == static_cast<int>(n) && c.path == Path::weights; }),
          list.end());
    }
  }
  scatter(out, flatten(out), positions);
  return out;
}

}  // namespace samples
