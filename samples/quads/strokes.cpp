#include "quads/strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "gltf/json_file.h"

namespace samples {

using namespace hf_gltf;
namespace {

// Steps along all strokes together. Each looks at all vertices: 10,000 take 12 s at 300,000 vertices. More are
// mostly a mistake in the unit.
constexpr double most_steps = 10000;

glm::dvec3 read_point(const JsonReader& json) {
  if (json.size() != 3) json.fail("a point has three numbers");
  return {json.at(0).number(), json.at(1).number(), json.at(2).number()};
}

// The most irregular vertices that the library takes.
constexpr size_t most_irregular = 1000;

}  // namespace

Guides read_strokes(const std::filesystem::path& file, const hf::Surface& surface, double edge) {
  Guides out;
  const JsonFile json(file);
  json.root().expect_only({"strokes"});
  const JsonReader list = json.root().at("strokes");
  double all_steps = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonReader stroke = list.at(i);
    stroke.expect_only({"points", "weight"});
    const double weight = stroke.has("weight") ? stroke.at("weight").number() : 1;
    if (!(weight > 0 && weight <= 1)) stroke.at("weight").fail("the weight must be above 0 and up to 1");
    const JsonReader points = stroke.at("points");
    if (points.size() < 2) points.fail("a stroke has two points or more");
    glm::dvec3 from = read_point(points.at(0));
    for (size_t k = 1; k < points.size(); ++k) {
      const glm::dvec3 to = read_point(points.at(k)), way = to - from;
      if (!(length(way) > 0)) points.at(k).fail("the point is the same as the one before");
      const double steps = std::ceil(length(way) / edge);
      if ((all_steps += steps) > most_steps) points.fail("the strokes are too long for this surface: see its unit");
      for (double step = 0; step < steps; ++step) {
        const glm::dvec3 at = from + (step + 0.5) / steps * way;
        out.vertices.push_back(std::get<0>(surface.find_vertex({at.x, at.y, at.z})));
        out.vectors.insert(out.vectors.end(), {way.x, way.y, way.z});
        out.weights.push_back(static_cast<float>(weight));
      }
      from = to;
    }
  }
  if (out.vertices.empty()) list.fail("no stroke is named");
  return out;
}

IrregularVertices read_irregular(const std::filesystem::path& file) {
  IrregularVertices out;
  const JsonFile json(file);
  json.root().expect_only({"irregular"});
  const JsonReader list = json.root().at("irregular");
  if (list.size() == 0) list.fail("no irregular vertex is named");
  if (list.size() > most_irregular) list.fail("there are more than 1,000 irregular vertices");
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonReader entry = list.at(i);
    entry.expect_only({"point", "valence", "direction"});
    const glm::dvec3 point = read_point(entry.at("point"));
    const double valence = entry.at("valence").number();
    if (valence != 3 && valence != 5) entry.at("valence").fail("3 or 5 quads meet at an irregular vertex");
    glm::dvec3 way(0);
    if (entry.has("direction")) {
      way = read_point(entry.at("direction"));
      if (!(length(way) > 0)) entry.at("direction").fail("the direction is 0; leave it out for any");
    }
    out.points.insert(out.points.end(), {point.x, point.y, point.z});
    out.valences.push_back(static_cast<uint32_t>(valence));
    out.directions.insert(out.directions.end(), {way.x, way.y, way.z});
  }
  return out;
}

}  // namespace samples
