#include "weights/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture.h"

namespace samples {
namespace {

double at_share(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// Edges of all poses that are measured, 8 bytes each, twice; of larger models those of every second or third triangle.
// A soup of 160,000 triangles in 40 poses has 0.337 instead of 0.341 with one triangle of seven.
constexpr size_t most_edges = 3000000;

// Appends how much the edges of a pose are longer or shorter than at rest, as a factor of at least 1.
void append_stretch(const Rig& rig, const std::vector<glm::dvec3>& posed, size_t stride, std::vector<double>& out) {
  for (size_t t = 0; t < rig.triangles.size(); t += 3 * stride) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = rig.triangles[t + k], b = rig.triangles[t + (k + 1) % 3];
      const double rest = glm::length(rig.positions[a] - rig.positions[b]), now = glm::length(posed[a] - posed[b]);
      if (rest > 0 && now > 0) out.push_back(std::max(rest / now, now / rest));
    }
  }
}

// The diagonal of the box of a pose: the unit of distances. Joints may carry another scale than the bind space.
double diagonal_of(const Rig& rig, const std::vector<glm::dvec3>& points) {
  return SurfaceBox(points, rig.loose).diagonal();
}

// A colour per joint, spread over the hues; neighbours in number differ most.
glm::dvec3 joint_color(uint32_t joint) {
  const double hue = 6 * std::fmod(0.618034 * joint + 0.1, 1.0), value = 0.62 + 0.3 * std::fmod(0.381966 * joint, 1.0);
  const auto channel = [&](double at) {
    const double away = std::fabs(std::fmod(hue - at + 9.0, 6.0) - 3.0);
    return value * (0.25 + 0.75 * std::clamp(2.0 - away, 0.0, 1.0));
  };
  return {channel(0), channel(2), channel(4)};
}

std::vector<float> colors_of(const RigWeights& weights, size_t vertices) {
  std::vector<float> out;
  for (size_t v = 0; v < vertices; ++v) {
    glm::dvec3 sum(0);
    for (size_t k = 0; k < weights.per_vertex; ++k) {
      const size_t i = v * weights.per_vertex + k;
      sum += static_cast<double>(weights.weights[i]) * joint_color(weights.joints[i]);
    }
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(std::min(sum[c], 1.0)));
  }
  return out;
}

// Half the sum of the differences of the weights of a vertex: the share of it that other joints move.
std::vector<double> differences(const RigWeights& a, const RigWeights& b, size_t vertices) {
  std::vector<double> out(vertices);
  std::vector<double> row;
  for (size_t v = 0; v < vertices; ++v) {
    row.clear();
    const auto add = [&](const RigWeights& w, double sign) {
      for (size_t k = 0; k < w.per_vertex; ++k) {
        const size_t i = v * w.per_vertex + k;
        if (w.joints[i] >= row.size()) row.resize(w.joints[i] + 1, 0.0);
        row[w.joints[i]] += sign * static_cast<double>(w.weights[i]);
      }
    };
    add(a, 1);
    add(b, -1);
    for (const double d : row) out[v] += std::fabs(d) / 2;
  }
  return out;
}

}  // namespace

Comparison compare(const Model& model, const Rig& rig, const std::vector<Pose>& poses, const RigWeights& weights) {
  Comparison out;
  std::vector<double> all, stretch, given_stretch;
  double sum = 0, worst_mean = -1;
  out.of_vertex.assign(rig.positions.size(), 0.0);
  const size_t stride = 1 + rig.triangles.size() * poses.size() / most_edges;
  const auto count = static_cast<double>(std::count(rig.loose.begin(), rig.loose.end(), 0));
  for (size_t f = 0; f < poses.size(); ++f) {
    const std::vector<glm::dmat4> globals = global_matrices(model, poses[f]);
    const std::vector<glm::dvec3> given = pose_rig(rig, globals, rig.given), own = pose_rig(rig, globals, weights);
    const double unit = 100 / diagonal_of(rig, pose_rig(rig, global_matrices(model, rest_pose(model)), rig.given));
    double mean = 0;
    std::vector<double> here(own.size());
    for (size_t v = 0; v < own.size(); ++v) {
      if (rig.loose[v]) continue;
      here[v] = unit * glm::length(own[v] - given[v]);
      out.of_vertex[v] += here[v] / static_cast<double>(poses.size());
      mean += here[v] / count;
      out.worst = std::max(out.worst, here[v]);
      all.push_back(here[v]);
    }
    sum += mean;
    if (mean > worst_mean) {
      worst_mean = mean;
      out.worst_pose = f;
      out.of_worst_pose = here;
    }
    append_stretch(rig, own, stride, stretch);
    append_stretch(rig, given, stride, given_stretch);
  }
  constexpr double most = 0.95;
  out.mean = poses.empty() ? 0 : sum / static_cast<double>(poses.size());
  out.high = at_share(all, most);
  const double base = at_share(given_stretch, most);
  out.stretch = base > 0 ? at_share(stretch, most) / base : 1;
  for (size_t v = 0; v < rig.positions.size(); ++v) {
    float total = 0;
    for (size_t k = 0; k < weights.per_vertex; ++k) total += weights.weights[v * weights.per_vertex + k];
    out.bare += !(total > 0.999f);
  }
  return out;
}

void write_weight_sheet(const std::string& file, const Model& model, const Rig& rig, const std::vector<Pose>& poses,
                        const RigWeights& weights, const Comparison& found, bool has_given, const std::string& title) {
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  const auto draw = [&](const std::vector<glm::dvec3>& points, const RigWeights* shown,
                        const std::vector<double>* scalar, double high, const std::string& label) {
    Surface surface;
    for (const glm::dvec3& p : points) surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
    surface.triangles = rig.triangles;
    SurfaceLook look;
    if (shown) {
      surface.colors = colors_of(*shown, points.size());
      look.fill = Fill::colors;
    } else {
      surface.scalars = *scalar;
      look.fill = Fill::palette;
      look.palette = Palette::blue_yellow;
      look.scalar_low = 0;
      look.scalar_high = high;
    }
    View view;
    view.width = 460;
    view.height = 420;
    tiles.push_back(render(surface, view, look));
    labels.push_back(label);
  };
  const std::vector<glm::dmat4> rest = global_matrices(model, rest_pose(model));
  const std::vector<glm::dvec3> still = pose_rig(rig, rest, rig.given);
  if (!has_given) {
    draw(still, &weights, nullptr, 1, "computed");
    if (!poses.empty())
      draw(pose_rig(rig, global_matrices(model, poses[found.worst_pose]), weights), &weights, nullptr, 1, "in a pose");
    write_png(file, contact_sheet(tiles, 2, labels, title));
    return;
  }
  const std::vector<double> change = differences(rig.given, weights, still.size());
  draw(still, &rig.given, nullptr, 1, "weights of the file");
  draw(still, &weights, nullptr, 1, "computed");
  draw(still, nullptr, &change, 1, "share that moves with other joints, to 1");
  if (!poses.empty()) {
    const std::vector<glm::dmat4> posed = global_matrices(model, poses[found.worst_pose]);
    const std::vector<glm::dvec3> given = pose_rig(rig, posed, rig.given), own = pose_rig(rig, posed, weights);
    char label[80];
    std::snprintf(label, sizeof label, "distance, to %.2g %% of the box", std::max(found.high, 0.01));
    draw(given, &rig.given, nullptr, 1, "the pose that differs most, of the file");
    draw(own, &weights, nullptr, 1, "computed");
    draw(own, nullptr, &found.of_worst_pose, std::max(found.high, 0.01), label);
  }
  write_png(file, contact_sheet(tiles, 3, labels, title));
}

}  // namespace samples
