// See scenes.h: bodies, poses and fields.
#include "pictures/scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace samples {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr float orange[3] = {0.93f, 0.52f, 0.12f}, blue[3] = {0.30f, 0.50f, 0.78f};

}  // namespace

float displayed(float linear) { return std::pow(std::clamp(1.15f * linear + 0.02f, 0.0f, 1.0f), 1 / 2.2f); }

Body::Body(const std::string& name, uint32_t vertices)
    : creature(make_creature(name, vertices)),
      mesh(welded_surface(creature)),
      positions(mesh.positions.begin(), mesh.positions.end()),
      coat(positions.size()),
      surface(positions, mesh.triangles) {
  for (size_t v = 0; v < creature.surface_vertex.size(); ++v)
    for (size_t c = 0; c < 3; ++c)
      coat[3 * size_t{creature.surface_vertex[v]} + c] = displayed(creature.base_color[c] * creature.colors[3 * v + c]);
}

uint32_t Body::vertex_at(double x, double y, double z) const { return std::get<0>(surface.find_vertex({x, y, z})); }

Surface Body::drawn() const { return drawn(positions); }

Surface Body::drawn(const std::vector<float>& posed) const {
  Surface out = make_surface(posed, mesh.triangles);
  out.colors = coat;
  return out;
}

SurfaceLook strips_to(double high, int count) {
  SurfaceLook look;
  look.fill = Fill::iso_strips;
  look.scalar_high = high;
  look.strips = count;
  return look;
}

View side_view(int width, int height) {
  View view;
  view.width = width;
  view.height = height;
  view.direction = {-1, 0.22, 0.45};
  view.background_top = view.background_bottom = {0.965, 0.97, 0.98};
  view.margin = 0.04;
  view.fixed_box = true;
  view.ground = true;
  return view;
}

PoseScene::PoseScene(const Body& body) : body_(body), pose_(body.surface), handle_of_(body.positions.size() / 3, 0) {
  // hind hooves and head, by the joints that their vertices follow most
  const auto region = [&](const std::vector<std::string>& joints) {
    std::vector<uint8_t> in(handle_of_.size(), 0);
    for (const std::string& name : joints) {
      const uint32_t joint = find_joint(body.creature, name);
      for (size_t v = 0; v < body.creature.surface_vertex.size(); ++v) {
        const auto& weights = body.creature.weights[v];
        const size_t most = size_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
        if (body.creature.joints[v][most] == joint) in[body.creature.surface_vertex[v]] = 1;
      }
    }
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < in.size(); ++v)
      if (in[v]) vertices.push_back(v);
    return vertices;
  };
  const std::vector<std::vector<uint32_t>> regions = {region({"head", "jaw"}), region({"hind_hoof_L"}),
                                                      region({"hind_hoof_R"})};
  head_ = pose_.add_handles(regions)[0];
  for (size_t i = 0; i < regions.size(); ++i)
    for (const uint32_t v : regions[i]) handle_of_[v] = i == 0 ? 2 : 1;
  box_ = {{-0.15, 0, -1.25}, {0.15, 2.35, 1.5}};
}

void PoseScene::pull(double pull) {
  const glm::dquat turn = glm::angleAxis(-0.7 * pull, glm::dvec3(1, 0, 0));
  pose_.set_transform(head_, {{turn.x, turn.y, turn.z, turn.w}}, {{0, 0.5 * pull, -0.42 * pull}});
  posed_ = pose_.deform();
}

Picture PoseScene::draw(int width, int height, double pull) {
  this->pull(pull);
  Surface drawn = body_.drawn(posed_);
  for (size_t v = 0; v < handle_of_.size(); ++v)
    for (size_t c = 0; c < 3; ++c)
      if (handle_of_[v]) drawn.colors[3 * v + c] = handle_of_[v] == 2 ? orange[c] : blue[c];
  View view = side_view(width, height);
  view.box = box_;
  SurfaceLook look;
  look.fill = Fill::colors;
  return render(drawn, view, look);
}

FieldScene::FieldScene(const Body& body) : body_(body), solver_(body.surface) {
  const double tips[][3] = {{0, 1.45, 1.6},  {0, 0.6, -1.15},  {-0.15, 0, 0.55},
                            {0.15, 0, 0.55}, {-0.15, 0, -0.6}, {0.15, 0, -0.6}};
  for (const auto& tip : tips) still_.push_back(body.vertex_at(tip[0], tip[1], tip[2]));
  solver_.add_sites(still_, std::vector<double>(still_.size(), 0));
  hf::Sites site;
  site.vertices = {body.vertex_at(-0.4, 1.2, 0.3)};
  site.values = {1};
  site.radii = {0.09};
  dragged_ = solver_.add_sites(site)[0];
}

Picture FieldScene::draw(int width, int height, double phase) {
  const uint32_t vertex =
      body_.vertex_at(-0.4, 1.2 + 0.12 * std::sin(2 * pi * phase), -0.12 + 0.5 * std::cos(2 * pi * phase));
  solver_.move_sites({dragged_}, {vertex});
  Surface drawn = body_.drawn();
  drawn.scalars = solver_.solve_f64();
  const auto place = [&](uint32_t v) {
    const double* p = &body_.mesh.positions[3 * size_t{v}];
    return Point{p[0], p[1], p[2]};
  };
  Marks marks;
  for (const uint32_t v : still_) marks.dots.push_back({place(v), 0.012, {0.15, 0.20, 0.55}});
  marks.dots.push_back({place(vertex), 0.018});
  View view = side_view(width, height);
  view.fixed_box = false;
  return render(drawn, view, strips_to(1, 20), marks);
}

}  // namespace samples
