#include "detail/curve_file.h"

#include "gltf/json_file.h"

namespace samples {

using namespace hf_gltf;
namespace {

uint32_t nearest_vertex(const SurfaceMesh& mesh, const std::vector<double>& place) {
  const glm::dvec3 p(place[0], place[1], place[2]);
  size_t best = 0;
  for (size_t v = 0; v < mesh.positions.size(); ++v)
    if (glm::distance(mesh.positions[v], p) < glm::distance(mesh.positions[best], p)) best = v;
  return static_cast<uint32_t>(best);
}

}  // namespace

CurveFile read_curve_file(const std::filesystem::path& file, const SurfaceMesh& mesh) {
  const JsonFile json(file);
  json.root().expect_only({"points", "side", "seed", "grow", "edges"});
  const JsonReader list = json.root().at("points");
  CurveFile curve;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonReader point = list.at(i);
    point.expect_only({"near", "vertex", "triangle", "barycentrics"});
    if (point.has("triangle")) {
      const int64_t count = static_cast<int64_t>(mesh.triangles.size() / 3);
      const uint32_t* corners = &mesh.triangles[3 * static_cast<size_t>(point.at("triangle").integer(0, count - 1))];
      const auto w = point.at("barycentrics").numbers(3);
      curve.places.push_back({{corners[0], corners[1], corners[2]}, 0, {w[0], w[1], w[2]}});
    } else if (point.has("near")) {
      curve.vertices.push_back(nearest_vertex(mesh, point.at("near").numbers(3)));
    } else {
      const int64_t count = static_cast<int64_t>(mesh.positions.size());
      curve.vertices.push_back(static_cast<uint32_t>(point.at("vertex").integer(0, count - 1)));
    }
  }
  if (!curve.vertices.empty() && !curve.places.empty())
    list.fail("points must be triangles with barycentrics everywhere or nowhere");
  const std::string side = json.root().string_or("side", "smaller");
  if (side != "smaller" && side != "larger") json.root().at("side").fail("expected \"smaller\" or \"larger\"");
  curve.side = side == "larger" ? HF_SIDE_LARGER : HF_SIDE_SMALLER;
  if (json.root().has("seed")) {
    curve.side = HF_SIDE_SEED;
    curve.seed =
        static_cast<uint32_t>(json.root().at("seed").integer(0, static_cast<int64_t>(mesh.positions.size()) - 1));
  }
  curve.edges = json.root().boolean_or("edges", false);
  curve.grow = static_cast<int32_t>(json.root().integer_or("grow", -10000, 10000, 0));
  return curve;
}

void enclose(hf::Region& region, const CurveFile& curve, int32_t grow) {
  auto desc = hf::make<hf_curve_desc>();
  desc.point_count = static_cast<uint32_t>(curve.vertices.size() + curve.places.size());
  if (!curve.vertices.empty()) desc.vertices = curve.vertices.data();
  if (!curve.places.empty()) desc.places = curve.places.data();
  desc.side = curve.side;
  desc.seed_vertex = curve.seed;
  desc.kind = curve.edges ? HF_CURVE_EDGES : HF_CURVE_STRAIGHT;
  auto edit = hf::make<hf_region_edit_desc>();
  edit.curve = &desc;
  edit.ring_count = curve.grow + grow;
  region.edit(edit);
}

}  // namespace samples
