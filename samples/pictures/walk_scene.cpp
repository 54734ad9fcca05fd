// See scenes.h: a walk on another body.
#include <algorithm>

#include "assets/creature_gltf.h"
#include "gltf/animate.h"
#include "pictures/scenes.h"
#include "transfer/session.h"

namespace samples {

using namespace hf_gltf;
namespace {

std::vector<float> coat_of(const Creature& creature) {
  std::vector<float> out;
  for (size_t i = 0; i < creature.colors.size(); ++i)
    out.push_back(displayed(creature.base_color[i % 3] * creature.colors[i]));
  return out;
}

}  // namespace

WalkScene::WalkScene(const Creature& from, const Creature& to, const std::filesystem::path& pairs, uint32_t frames) {
  const Model from_model = to_model(from), to_model_of = to_model(to);
  ProgressBar quiet(true);
  Session session(from_model, to_model_of, read_pairs(pairs), 1, true, quiet);
  const Animation& walk = from_model.animations[size_t(find_animation(from_model, "walk"))];
  std::vector<double> times;
  std::vector<std::vector<double>> poses;
  for (uint32_t i = 0; i < frames; ++i) {
    times.push_back(clip_duration(walk) * i / frames);
    poses.push_back(double_positions(posed_positions(from_model, session.source_flat(), walk, times.back())));
  }
  PlayedClip played = session.play("walk", times, std::move(poses), quiet);
  sides_[0] = {std::move(played.source_frames), session.source_flat().triangles, coat_of(from), {}};
  sides_[1] = {std::move(played.target_frames), session.target_flat().triangles, coat_of(to), {}};
  for (Side& side : sides_) {
    bool empty = true;
    for (const std::vector<double>& positions : side.frames) extend(side.box, empty, positions);
  }
}

Layer WalkScene::layer(const Side& side, uint32_t frame, const Point& move) {
  Layer out;
  out.surface = make_surface(side.frames[frame % side.frames.size()], side.triangles);
  for (size_t i = 0; i < out.surface.positions.size(); ++i) out.surface.positions[i] += move[i % 3];
  out.surface.colors = side.coat;
  out.look.fill = Fill::colors;
  return out;
}

Picture WalkScene::draw(int width, int height, uint32_t frame, bool target) const {
  const Side& side = sides_[target ? 1 : 0];
  View view = side_view(width, height);
  view.box = side.box;
  view.ground_height = std::max(0.0, side.box.lower[1]);
  return render({layer(side, frame, {0, 0, 0})}, view);
}

Picture WalkScene::draw_both(int width, int height, uint32_t frame) const {
  View view = side_view(width, height);
  view.fixed_box = false;
  return render({layer(sides_[0], frame, {2.6, 0, -1.9}), layer(sides_[1], frame, {-0.6, 0, 0.8})}, view);
}

}  // namespace samples
