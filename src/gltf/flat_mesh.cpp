// See flat_mesh.h. Welding and normals are in weld.cpp.
#include "gltf/flat_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/gltf_carried.h"

namespace hf_gltf {
namespace {

// A surface that stands so many of its diagonals from 0 gets an offset. Floats round there by 5e-7 of its diagonal:
// half gives files of more rooms a node of their own, double lets seams of flat parts open.
constexpr double far_boxes = 8;

[[noreturn]] void fail(const Model& model, const std::string& message) {
  throw std::runtime_error((model.name.empty() ? "the model" : model.name) + ": " + message + ".");
}

// Nodes of the scene in the order of the file.
std::vector<int> scene_nodes(const Model& model) {
  std::vector<char> reached(model.nodes.size(), model.scene_roots.empty() ? 1 : 0);
  std::vector<int> open = model.scene_roots;
  while (!open.empty()) {
    const int n = open.back();
    open.pop_back();
    if (n < 0 || static_cast<size_t>(n) >= reached.size()) fail(model, "the scene names node " + std::to_string(n));
    if (reached[static_cast<size_t>(n)]) continue;
    reached[static_cast<size_t>(n)] = 1;
    const std::vector<int>& children = model.nodes[static_cast<size_t>(n)].children;
    open.insert(open.end(), children.begin(), children.end());
  }
  std::vector<int> nodes;
  for (size_t n = 0; n < reached.size(); ++n) {
    if (reached[n]) nodes.push_back(static_cast<int>(n));
  }
  return nodes;
}

const Primitive& primitive_of(const Model& model, const FlatPart& part) {
  return model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
}

// Bounds what nodes make of the meshes they share.
class CopyLimit {
 public:
  CopyLimit(const Model& model, const FlattenOptions& options)
      : model_(model), options_(options), seen_(model.meshes.size(), 0) {}

  void add(int node) {
    const auto m = static_cast<size_t>(model_.nodes[static_cast<size_t>(node)].mesh);
    uint64_t own = 0;
    for (const Primitive& primitive : model_.meshes[m].primitives)
      own += static_cast<uint64_t>(primitive.positions.size()) * (1 + primitive.targets.size());
    stored_ += seen_[m] ? 0 : own;
    seen_[m] = 1;
    made_ += own;
    const uint64_t limit = options_.max_copies * stored_ + options_.free_vertices;
    if (made_ <= limit) return;
    fail(model_, "node " + std::to_string(node) + " takes the vertices of nodes that share meshes to " +
                     std::to_string(made_) + ", morph targets included, above the limit of " + std::to_string(limit) +
                     " for " + std::to_string(stored_) + " stored ones; raise free_vertices if that is meant");
  }

 private:
  const Model& model_;
  const FlattenOptions& options_;
  std::vector<char> seen_;  // per mesh
  uint64_t stored_ = 0, made_ = 0;
};

std::vector<FlatPart> list_parts(const Model& model, const FlattenOptions& options, uint64_t& vertices,
                                 uint64_t& triangles) {
  std::vector<FlatPart> parts;
  CopyLimit copies(model, options);
  for (const int n : scene_nodes(model)) {
    const Node& node = model.nodes[static_cast<size_t>(n)];
    if (node.mesh < 0) continue;
    const bool chosen =
        options.nodes.empty() || std::find(options.nodes.begin(), options.nodes.end(), n) != options.nodes.end();
    if (!chosen || (options.skin >= 0 && node.skin != options.skin)) continue;
    const MeshData& mesh = model.meshes[static_cast<size_t>(node.mesh)];
    copies.add(n);
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const Primitive& primitive = mesh.primitives[p];
      if (primitive.topology != Topology::triangles) continue;
      FlatPart part;
      part.node = n;
      part.mesh = node.mesh;
      part.primitive = static_cast<int>(p);
      part.first_vertex = static_cast<uint32_t>(vertices);
      part.vertex_count = static_cast<uint32_t>(primitive.positions.size());
      part.first_triangle = static_cast<uint32_t>(triangles);
      part.triangle_count = static_cast<uint32_t>(primitive.indices.size() / 3);
      vertices += part.vertex_count;
      triangles += part.triangle_count;
      if (vertices > options.max_vertices || triangles > options.max_triangles) {
        fail(model, "the scene has more than " + std::to_string(options.max_vertices) + " vertices or " +
                        std::to_string(options.max_triangles) + " triangles; raise the limit if that is meant");
      }
      parts.push_back(part);
    }
  }
  return parts;
}

// Finite, and still so as floats.
bool is_float(const glm::dvec3& p) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
}

void append_part(const Model& model, const Pose& pose, const std::vector<glm::dmat4>& globals, FlatPart& part,
                 FlatMesh& mesh) {
  const Primitive& primitive = primitive_of(model, part);
  const bool skinned = model.nodes[static_cast<size_t>(part.node)].skin >= 0 && !primitive.influences.empty();
  part.mirrored = !skinned && glm::determinant(glm::dmat3(globals[static_cast<size_t>(part.node)])) < 0;
  std::vector<glm::vec3> normals;
  const std::vector<glm::dvec3> posed = posed_primitive(model, pose, globals, part.node, primitive, &normals);
  for (size_t v = 0; v < posed.size(); ++v) {
    if (!is_float(posed[v])) {
      fail(model, "vertex " + std::to_string(v) + " of mesh " + std::to_string(part.mesh) + ", primitive " +
                      std::to_string(part.primitive) + " has no finite rest position; check its node and joints");
    }
  }
  mesh.positions.insert(mesh.positions.end(), posed.begin(), posed.end());
  mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
  for (size_t t = 0; t < part.triangle_count; ++t) {
    const uint32_t* i = primitive.indices.data() + 3 * t;
    const uint32_t base = part.first_vertex;
    mesh.triangles.insert(mesh.triangles.end(),
                          {base + i[0], base + i[part.mirrored ? 2 : 1], base + i[part.mirrored ? 1 : 2]});
  }
}

// See the head of flat_mesh.h. Only meshes with one skin share the space of their stored positions. A mesh that only
// its node moves comes out bit-equal anyway. Returns whether a vertex moved.
bool join_copies(const Model& model, FlatMesh& mesh) {
  bool moved = false;
  const double same_place = 1e-6 * SurfaceBox(mesh).diagonal();  // windows.h takes the name near
  std::map<int, std::vector<const FlatPart*>> spaces;            // by skin
  for (const FlatPart& part : mesh.parts) {
    const int skin = model.nodes[static_cast<size_t>(part.node)].skin;
    const bool skinned = skin >= 0 && !primitive_of(model, part).influences.empty();
    if (skinned) spaces[skin].push_back(&part);
  }
  for (const auto& space : spaces) {
    std::vector<glm::dvec3> stored;
    std::vector<uint32_t> vertices, copies;
    for (const FlatPart* part : space.second) {
      for (const glm::vec3& p : primitive_of(model, *part).positions) {
        vertices.push_back(part->first_vertex +
                           static_cast<uint32_t>(&p - primitive_of(model, *part).positions.data()));
        stored.emplace_back(p);
      }
    }
    std::vector<uint32_t> first(weld_positions(stored, copies), UINT32_MAX);
    for (size_t i = 0; i < vertices.size(); ++i) {
      uint32_t& f = first[copies[i]];
      if (f == UINT32_MAX) f = vertices[i];
      glm::dvec3& p = mesh.positions[vertices[i]];
      if (!(glm::distance(p, mesh.positions[f]) <= same_place)) continue;
      moved = moved || p != mesh.positions[f];
      p = mesh.positions[f];
    }
  }
  return moved;
}

// A mesh that other nodes use too is copied, so that each flattened node has its own.
void separate_meshes(Model& model, const FlatMesh& mesh) {
  std::vector<int> users(model.meshes.size(), 0);
  for (const Node& node : model.nodes) {
    if (node.mesh >= 0) ++users[static_cast<size_t>(node.mesh)];
  }
  std::map<int, int> own;  // node -> its mesh
  for (const FlatPart& part : mesh.parts) {
    if (own.count(part.node) != 0) continue;
    Node& node = model.nodes[static_cast<size_t>(part.node)];
    const auto m = static_cast<size_t>(node.mesh);
    if (users[m] > 1) {
      --users[m];
      MeshData copy = model.meshes[m];
      node.mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(std::move(copy));
      users.push_back(1);
    }
    own[part.node] = node.mesh;
  }
}

void check_fit(const Model& model, const FlatMesh& mesh, size_t values) {
  if (values != mesh.positions.size()) {
    fail(model,
         std::to_string(values) + " values were given for " + std::to_string(mesh.positions.size()) + " vertices");
  }
  for (const FlatPart& part : mesh.parts) {
    const bool good =
        part.node >= 0 && static_cast<size_t>(part.node) < model.nodes.size() && part.mesh >= 0 &&
        static_cast<size_t>(part.mesh) < model.meshes.size() && part.primitive >= 0 &&
        static_cast<size_t>(part.primitive) < model.meshes[static_cast<size_t>(part.mesh)].primitives.size() &&
        primitive_of(model, part).positions.size() == part.vertex_count;
    if (!good) fail(model, "the flat mesh was not made from this model");
  }
}

void check_finite(const Model& model, const std::vector<glm::dvec3>& positions) {
  for (size_t v = 0; v < positions.size(); ++v) {
    if (!is_float(positions[v])) {
      fail(model, "the new position of vertex " + std::to_string(v) + " is not a finite float");
    }
  }
}

// Tangents stay where they were as far as the new normals allow.
void straighten_tangents(Primitive& primitive) {
  for (size_t v = 0; v < primitive.tangents.size(); ++v) {
    const glm::vec3 n = primitive.normals[v];
    glm::vec3 t(primitive.tangents[v]);
    t -= n * glm::dot(n, t);
    const float length = glm::length(t);
    // relative: a node may scale a tangent
    if (!(length > 1e-6f * glm::length(glm::vec3(primitive.tangents[v])))) {
      primitive.tangents.clear();
      return;
    }
    primitive.tangents[v] = glm::vec4(t / length, primitive.tangents[v].w < 0 ? -1.0f : 1.0f);
  }
}

// Tangents of the stored primitive in the frame of the scene.
void bake_tangents(const Primitive& from, const std::vector<glm::dmat4>& matrices, Primitive& to) {
  for (size_t v = 0; v < from.tangents.size(); ++v) {
    const glm::dmat3 linear(matrices[v]);
    const float side = glm::determinant(linear) < 0 ? -1.0f : 1.0f;
    to.tangents.emplace_back(glm::vec3(linear * glm::dvec3(glm::vec3(from.tangents[v]))), side * from.tangents[v].w);
  }
  straighten_tangents(to);
}

// Returns the vertices that stay as stored, because their rest transform is singular.
size_t scatter_part(const Model& model, const Pose& pose, const std::vector<glm::dmat4>& globals, const FlatPart& part,
                    const std::vector<glm::dvec3>& positions, const std::vector<glm::vec3>& normals,
                    Primitive& primitive) {
  size_t stayed = 0;
  const std::vector<glm::dmat4> matrices = vertex_matrices(model, globals, part.node, primitive);
  const std::vector<double>& weights = pose[static_cast<size_t>(part.node)].weights;
  primitive.normals.resize(part.vertex_count);
  for (size_t v = 0; v < part.vertex_count; ++v) {
    const glm::dmat3 linear(matrices[v]);
    const double size = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    if (!(std::abs(glm::determinant(linear)) > 1e-9 * size)) {
      ++stayed;
      continue;
    }
    const glm::dvec3 world = positions[part.first_vertex + v];
    glm::dvec3 local = glm::inverse(linear) * (world - glm::dvec3(matrices[v][3]));
    for (size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
      if (!primitive.targets[t].positions.empty()) local -= weights[t] * glm::dvec3(primitive.targets[t].positions[v]);
    }
    primitive.positions[v] = glm::vec3(local);
    const glm::dvec3 n = glm::transpose(linear) * glm::dvec3(normals[part.first_vertex + v]);
    const double length = glm::length(n);
    primitive.normals[v] = length > 0 ? glm::vec3(n / length) : glm::vec3(0);
  }
  straighten_tangents(primitive);
  return stayed;
}

}  // namespace

const FlatPart& FlatMesh::part_of_vertex(uint32_t vertex) const {
  if (vertex >= positions.size()) throw std::runtime_error("vertex " + std::to_string(vertex) + " does not exist.");
  // the last part that starts at or before the vertex; empty parts share their start with the next
  const auto after = std::upper_bound(parts.begin(), parts.end(), vertex,
                                      [](uint32_t v, const FlatPart& part) { return v < part.first_vertex; });
  return *(after - 1);
}

FlatMesh flatten(const Model& model, const FlattenOptions& options) {
  uint64_t vertices = 0, triangles = 0;
  FlatMesh mesh;
  mesh.parts = list_parts(model, options, vertices, triangles);
  mesh.positions.reserve(static_cast<size_t>(vertices));
  mesh.normals.reserve(static_cast<size_t>(vertices));
  mesh.triangles.reserve(static_cast<size_t>(triangles) * 3);
  const Pose pose = rest_pose(model);
  const std::vector<glm::dmat4> globals = global_matrices(model, pose);
  bool colored = false;
  for (FlatPart& part : mesh.parts) {
    append_part(model, pose, globals, part, mesh);
    colored = colored || !primitive_of(model, part).colors.empty();
  }
  if (colored) {
    mesh.colors.assign(mesh.positions.size(), glm::vec4(1));
    for (const FlatPart& part : mesh.parts) {
      const std::vector<glm::vec4>& colors = primitive_of(model, part).colors;
      std::copy(colors.begin(), colors.end(), mesh.colors.begin() + part.first_vertex);
    }
  }
  mesh.weld();
  if (join_copies(model, mesh)) mesh.weld();
  return mesh;
}

double float_rounded(double value) {
  const volatile float stored = static_cast<float>(value);
  return static_cast<double>(stored);
}

glm::dvec3 float_rounded(const glm::dvec3& p) { return {float_rounded(p.x), float_rounded(p.y), float_rounded(p.z)}; }

glm::dvec3 node_offset(const std::vector<glm::dvec3>& positions) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  bool exact = true;
  for (const glm::dvec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
    exact = exact && float_rounded(p) == p;
  }
  if (exact) return glm::dvec3(0);
  const glm::dvec3 middle = low + 0.5 * (high - low);
  const bool far = glm::length(middle) > far_boxes * glm::distance(low, high);
  return far ? float_rounded(middle) : glm::dvec3(0);
}

std::vector<float> float_positions(const std::vector<glm::dvec3>& positions) {
  std::vector<float> out;
  out.reserve(positions.size() * 3);
  for (const glm::dvec3& p : positions) {
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(p[c]));
  }
  return out;
}

std::vector<double> double_positions(const std::vector<glm::dvec3>& positions) {
  std::vector<double> out;
  out.reserve(positions.size() * 3);
  for (const glm::dvec3& p : positions) out.insert(out.end(), {p.x, p.y, p.z});
  return out;
}

template <typename Real>
static std::vector<glm::dvec3> points(const std::vector<Real>& xyz) {
  std::vector<glm::dvec3> out(xyz.size() / 3);
  for (size_t v = 0; v < out.size(); ++v) out[v] = {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
  return out;
}
std::vector<glm::dvec3> to_points(const std::vector<float>& xyz) { return points(xyz); }
std::vector<glm::dvec3> to_points(const std::vector<double>& xyz) { return points(xyz); }

void scatter(Model& model, const FlatMesh& mesh, const std::vector<glm::dvec3>& positions,
             const ScatterOptions& options) {
  check_fit(model, mesh, positions.size());
  check_finite(model, positions);
  Model changed = model;
  separate_meshes(changed, mesh);
  const Pose pose = rest_pose(changed);
  const std::vector<glm::dmat4> globals = global_matrices(changed, pose);
  const std::vector<glm::vec3> normals = welded_normals(mesh, positions, options.creases);
  size_t stayed = 0;
  for (const FlatPart& part : mesh.parts) {
    const auto m = static_cast<size_t>(changed.nodes[static_cast<size_t>(part.node)].mesh);
    stayed += scatter_part(changed, pose, globals, part, positions, normals,
                           changed.meshes[m].primitives[static_cast<size_t>(part.primitive)]);
  }
  if (stayed > 0) {
    changed.warnings.push_back(
        std::to_string(stayed) +
        " vertices keep their stored positions: a scale of 0 in their node or joints fixes them");
  }
  model = std::move(changed);
}

Model bake(const Model& model, const FlatMesh& mesh, const std::vector<glm::dvec3>& positions,
           const ScatterOptions& options) {
  check_fit(model, mesh, positions.size());
  check_finite(model, positions);
  const std::vector<glm::vec3> normals = welded_normals(mesh, positions, options.creases);
  const glm::dvec3 offset = node_offset(positions);
  Model out;
  out.name = model.name;
  out.materials = model.materials;
  out.appearance = model.appearance;
  out.asset = model.asset;
  out.carried = carried_without_nodes(model.carried);
  out.required_extensions = model.required_extensions;
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  std::map<int, size_t> node_of;
  for (const FlatPart& part : mesh.parts) {
    const Primitive& from = primitive_of(model, part);
    const auto found = node_of.emplace(part.node, out.nodes.size());
    if (found.second) {
      Node node;
      node.name = model.nodes[static_cast<size_t>(part.node)].name;
      node.translation = offset;
      node.mesh = static_cast<int>(out.meshes.size());
      out.scene_roots.push_back(static_cast<int>(out.nodes.size()));
      out.nodes.push_back(node);
      out.meshes.emplace_back();
      out.meshes.back().name = model.meshes[static_cast<size_t>(part.mesh)].name;
    }
    Primitive to;
    to.texcoords = from.texcoords;
    to.colors = from.colors;
    to.material = from.material;
    to.carried_attributes = from.carried_attributes;
    to.carried = from.carried;
    for (size_t v = 0; v < part.vertex_count; ++v) {
      to.positions.push_back(glm::vec3(positions[part.first_vertex + v] - offset));
      to.normals.push_back(normals[part.first_vertex + v]);
    }
    for (size_t i = 0; i < 3 * static_cast<size_t>(part.triangle_count); ++i) {
      to.indices.push_back(mesh.triangles[3 * static_cast<size_t>(part.first_triangle) + i] - part.first_vertex);
    }
    bake_tangents(from, vertex_matrices(model, globals, part.node, from), to);
    out.meshes[found.first->second].primitives.push_back(std::move(to));
  }
  return out;
}

void set_colors(Model& model, const FlatMesh& mesh, const std::vector<glm::vec4>& colors) {
  check_fit(model, mesh, colors.size());
  separate_meshes(model, mesh);
  for (const FlatPart& part : mesh.parts) {
    const auto m = static_cast<size_t>(model.nodes[static_cast<size_t>(part.node)].mesh);
    const auto first = colors.begin() + part.first_vertex;
    model.meshes[m].primitives[static_cast<size_t>(part.primitive)].colors.assign(first, first + part.vertex_count);
  }
}

void add_lines(Model& model, const std::string& name, const std::vector<glm::dvec3>& segment_ends,
               const glm::vec4& color) {
  if (segment_ends.size() % 2 != 0) fail(model, "lines need two points per segment");
  if (segment_ends.empty()) return;
  Material material;
  material.name = name;
  material.base_color = color;
  material.unlit = true;
  const glm::dvec3 offset = node_offset(segment_ends);
  Primitive primitive;
  primitive.topology = Topology::lines;
  primitive.material = static_cast<int>(model.materials.size());
  for (const glm::dvec3& p : segment_ends) {
    primitive.indices.push_back(static_cast<uint32_t>(primitive.positions.size()));
    primitive.positions.push_back(glm::vec3(p - offset));
  }
  MeshData mesh;
  mesh.name = name;
  mesh.primitives.push_back(std::move(primitive));
  Node node;
  node.name = name;
  node.translation = offset;
  node.mesh = static_cast<int>(model.meshes.size());
  model.materials.push_back(material);
  model.meshes.push_back(std::move(mesh));
  // an empty list of roots means every root node, the new one too
  if (!model.scene_roots.empty() || model.nodes.empty())
    model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(node);
}

Model make_model(const std::string& name, const std::vector<glm::dvec3>& positions,
                 const std::vector<uint32_t>& triangles) {
  FlatMesh flat;
  flat.positions = positions;
  flat.triangles = triangles;
  Primitive primitive;
  for (const uint32_t v : triangles) {
    if (v >= positions.size()) throw std::runtime_error(name + ": a triangle names vertex " + std::to_string(v) + ".");
  }
  flat.weld();
  primitive.normals = welded_normals(flat, positions);
  const glm::dvec3 offset = node_offset(positions);
  for (const glm::dvec3& p : positions) primitive.positions.push_back(glm::vec3(p - offset));
  primitive.indices = triangles;
  Model model;
  model.name = name;
  MeshData mesh;
  mesh.name = name;
  mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(mesh));
  Node node;
  node.name = name;
  node.translation = offset;
  node.mesh = 0;
  model.nodes.push_back(node);
  model.scene_roots.push_back(0);
  return model;
}

}  // namespace hf_gltf
