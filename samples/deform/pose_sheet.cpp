// See pose_sheet.h.
#include "deform/pose_sheet.h"

#include <algorithm>

namespace samples {
namespace {

// surface, then layer 0, 1, 2, and above
constexpr float colors[][3] = {
    {0.78f, 0.76f, 0.72f}, {0.90f, 0.55f, 0.15f}, {0.25f, 0.50f, 0.85f}, {0.25f, 0.65f, 0.35f}, {0.65f, 0.35f, 0.70f}};

}  // namespace

void write_pose_sheet(const std::filesystem::path& file, const PosableMesh& mesh, const std::vector<SheetFrame>& frames,
                      const ScriptFile& script, const std::string& title) {
  View view;
  view.width = 300;
  view.height = 300;
  view.direction = {script.view.x, script.view.y, script.view.z};
  view.up = {script.up.x, script.up.y, script.up.z};
  view.fixed_box = true;
  bool empty = true;
  for (const SheetFrame& frame : frames) extend(view.box, empty, frame.positions, mesh.flat.triangles);
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  const auto draw = [&](const SheetFrame& frame, Fill fill, const std::string& label) {
    SurfaceLook look;
    look.fill = fill;
    Surface surface = make_surface(frame.positions, mesh.flat.triangles);
    for (const uint8_t layer : frame.layer) {
      const float* color = colors[std::min<size_t>(layer, 4)];
      surface.colors.insert(surface.colors.end(), color, color + 3);
    }
    tiles.push_back(render(surface, view, look));
    labels.push_back(label);
  };
  for (const SheetFrame& frame : frames) draw(frame, Fill::colors, frame.label);
  draw(frames.back(), Fill::stripes, "shading stripes");
  write_png(file.string(), contact_sheet(tiles, std::min<int>(4, static_cast<int>(tiles.size())), labels, title));
}

}  // namespace samples
