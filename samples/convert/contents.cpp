#include "convert/contents.h"

#include <algorithm>

#include "gltf/gltf_write.h"
#include "gltf/plain_looks.h"

namespace samples {
namespace {

size_t is_inexact(const SurfaceMesh& mesh) {
  return std::any_of(mesh.positions.begin(), mesh.positions.end(),
                     [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)) != p; });
}

size_t polygons(const SurfaceMesh& mesh) {
  return static_cast<size_t>(
      std::count_if(mesh.face_sizes.begin(), mesh.face_sizes.end(), [](uint32_t size) { return size > 3; }));
}

size_t isolated(const SurfaceMesh& mesh) {
  std::vector<char> used(mesh.positions.size(), 0);
  for (const uint32_t v : mesh.triangles) used[v] = 1;
  return static_cast<size_t>(std::count(used.begin(), used.end(), 0));
}

size_t seen_through(const SurfaceMesh& mesh) {
  return static_cast<size_t>(
      std::count_if(mesh.colors.begin(), mesh.colors.end(), [](const glm::vec4& c) { return c.w != 1; }));
}

// STL repeats a vertex at each corner, so the numbers of the vertices are lost.
const char* const vertex = "vertex (only its corners stay)";
const char* const vertices_of = "vertices (only their corners stay)";

}  // namespace

Contents contents_of(const Model& model, const FlatMesh* surface) {
  size_t vertices = 0, triangles = 0, normals = 0, colors = 0, lines = 0, points = 0, texcoords = 0, targets = 0;
  size_t joints = 0, instances = 0, more_texcoords = 0;
  for (const MeshData& mesh : model.meshes) {
    for (const Primitive& part : mesh.primitives) {
      vertices += part.positions.size();
      if (part.topology == Topology::triangles) triangles += part.indices.size() / 3;
      lines += part.topology == Topology::lines;
      points += part.topology == Topology::points;
      normals += part.normals.size();
      colors += part.colors.size();
      texcoords += !part.texcoords.empty();
      more_texcoords += part.texcoords.size() - !part.texcoords.empty();
    }
    if (!mesh.primitives.empty()) targets += mesh.primitives[0].targets.size();
  }
  if (surface) {  // nodes that share a mesh each have its vertices
    vertices = surface->vertex_count();
    triangles = surface->triangle_count();
    const auto is_some = [](const glm::vec3& n) { return n != glm::vec3(0); };
    normals = static_cast<size_t>(std::count_if(surface->normals.begin(), surface->normals.end(), is_some));
    colors = surface->colors.size();
  }
  const size_t base_images = plain_looks(model).images.size();
  for (const Skin& skin : model.skins) joints += skin.joints.size();
  for (const Node& node : model.nodes) instances += node.instances ? 1 : 0;
  return {{vertices, vertex, vertices_of, to_all & ~to_stl},
          {triangles, "triangle", "triangles", to_all},
          {normals, "normal", "normals", to_gltf | to_obj | to_off | to_ply},
          {colors, "vertex colour", "vertex colours", to_gltf | to_obj | to_off | to_ply},
          {model.nodes.size(), "node", "nodes", to_gltf},
          {model.skins.size(), "skin", "skins", to_gltf},
          {joints, "joint", "joints", to_gltf},
          {model.animations.size(), "clip", "clips", to_gltf},
          {targets, "morph target", "morph targets", to_gltf},
          {model.materials.size(), "material", "materials", to_gltf | to_obj},
          {base_images, "image", "images", to_gltf | to_obj},
          {image_count(model) - base_images, "image of no base colour", "images of no base colour", to_gltf},
          {texcoords, "set of texture coordinates", "sets of texture coordinates", to_gltf | to_obj},
          {more_texcoords, "further set of texture coordinates", "further sets of texture coordinates", to_gltf},
          {lines, "set of lines", "sets of lines", to_gltf},
          {points, "set of points", "sets of points", to_gltf},
          {instances, "set of instances", "sets of instances", to_gltf},
          {model.cameras.size(), "camera", "cameras", to_gltf}};
}

Contents contents_of(const SurfaceMesh& mesh) {
  Contents out = {
      {mesh.positions.size(), vertex, vertices_of, to_all & ~to_stl},
      {mesh.face_count(), "face", "faces", to_all},
      {polygons(mesh), "polygon (cut into triangles)", "polygons (cut into triangles)", to_obj | to_off | to_ply},
      {mesh.group_names.size(), "group", "groups", to_obj},
      {mesh.normals.size(), "normal", "normals", to_gltf | to_obj | to_off | to_ply},
      {mesh.corners.normals.size(), "normal of corners", "normals of corners", to_gltf | to_obj},
      {mesh.corners.texcoords.size(), "texture coordinate", "texture coordinates", to_gltf | to_obj},
      {mesh.corners.material_names.size(), "material", "materials", to_gltf | to_obj},
      {mesh.colors.size(), "vertex colour", "vertex colours", to_gltf | to_obj | to_off | to_ply},
      {seen_through(mesh), "transparency", "transparencies", to_gltf | to_off | to_ply},
      {isolated(mesh), "isolated vertex", "isolated vertices", to_gltf | to_obj | to_off | to_ply},
      {is_inexact(mesh), "digits of positions beyond float", nullptr, to_obj | to_off | to_ply}};
  for (const std::string& what : mesh.ignored) out.push_back({1, what.c_str(), nullptr, 0});
  return out;
}

std::string list_of(const Contents& contents, Format format, bool kept) {
  std::string out;
  for (const Content& o : contents) {
    if (o.count == 0 || ((o.formats & format) != 0) != kept) continue;
    if (!out.empty()) out += ", ";
    if (o.many) out += std::to_string(o.count) + " ";
    const std::string name = o.count == 1 || !o.many ? o.one : o.many;
    out += kept ? name.substr(0, name.find(" (")) : name;
  }
  return out;
}

}  // namespace samples
