// The scenes that hf_pictures draws: generated creatures that are posed, coloured in strips, remeshed into quads, or
// play another creature's walk.
//
// A scene keeps the data it computes once (surface, factor, handles). draw() returns one picture of it. Phases run from
// 0 to 1, and every scene looks the same at both ends.
#ifndef HF_SAMPLES_PICTURES_SCENES_H
#define HF_SAMPLES_PICTURES_SCENES_H

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "assets/creature.h"
#include "common/picture.h"
#include "hf/hf.hpp"

namespace samples {

// Converts a linear colour for display, a little lighter so that shading is visible.
float displayed(float linear);

// A creature's closed surface, one vertex per place, with the colours of its coat.
struct Body {
  Body(const std::string& name, uint32_t vertices);
  // The vertex nearest to a point.
  uint32_t vertex_at(double x, double y, double z) const;
  Surface drawn() const;
  Surface drawn(const std::vector<float>& posed) const;

  Creature creature;
  ShapeMesh mesh;
  std::vector<float> positions, coat;
  hf::Surface surface;
};

// A camera on a creature's right side, from a little ahead and above.
View side_view(int width, int height);
// A field from 0 to `high` in strips of equal steps.
SurfaceLook strips_to(double high, int count);

// The head is pulled until the creature rears, and goes back. The hind hooves stay. Handles are coloured.
class PoseScene {
 public:
  explicit PoseScene(const Body& body);
  // pull: 0 at rest, 1 farthest. A pose goes on from the last one, so frames that are not drawn are pulled too.
  void pull(double pull);
  Picture draw(int width, int height, double pull);

 private:
  const Body& body_;
  hf::Pose pose_;
  std::vector<float> posed_;
  uint32_t head_ = 0;
  std::vector<uint8_t> handle_of_;  // 0 none, 1 stays, 2 is dragged
  Box box_;
};

// A field in strips: it is 0 at nose, tail and hooves, and 1 at a site that is dragged around the flank.
class FieldScene {
 public:
  explicit FieldScene(const Body& body);
  Picture draw(int width, int height, double phase);

 private:
  const Body& body_;
  hf::Solver solver_;
  std::vector<uint32_t> still_;
  uint32_t dragged_ = 0;
};

// The walk of one creature on another.
class WalkScene {
 public:
  // Frames have the phases 0, 1 / frames, and so on. pairs: a pairs file of hf_transfer.
  WalkScene(const Creature& from, const Creature& to, const std::filesystem::path& pairs, uint32_t frames);
  Picture draw(int width, int height, uint32_t frame, bool target) const;
  // The source stands behind the target.
  Picture draw_both(int width, int height, uint32_t frame) const;

 private:
  struct Side {
    std::vector<std::vector<double>> frames;
    std::vector<uint32_t> triangles;
    std::vector<float> coat;
    Box box;
  };
  static Layer layer(const Side& side, uint32_t frame, const Point& move);
  Side sides_[2];
};

// Pictures that do not move.
Picture draw_surface(const Body& body, int width, int height);
Picture draw_geodesics(const Body& body, int width, int height);
Picture draw_cut(const Body& body, int width, int height);
Picture draw_quads(const Body& body, int width, int height);
Picture draw_detail(const Body& body, int width, int height);
Picture draw_direction(const Body& body, int width, int height);

}  // namespace samples

#endif
