#include "quads/strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "common/json_file.h"

namespace samples {
namespace {

// Steps along all strokes together. Each looks at all vertices: 10,000 take 12 s at 300,000 vertices. More are
// mostly a mistake in the unit.
constexpr double most_steps = 10000;

glm::dvec3 read_point(const JsonReader& json) {
  if (json.size() != 3) json.fail("a point has three numbers");
  return {json.at(0).number(), json.at(1).number(), json.at(2).number()};
}

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
        out.vertices.push_back(surface.find_vertex({at.x, at.y, at.z}));
        out.vectors.insert(out.vectors.end(), {way.x, way.y, way.z});
        out.weights.push_back(static_cast<float>(weight));
      }
      from = to;
    }
  }
  if (out.vertices.empty()) list.fail("no stroke is named");
  return out;
}

}  // namespace samples
