// See scenes.h: surfaces, cuts, quads, detail, directions and geodesics.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "common/face_triangles.h"
#include "common/mesh_file.h"
#include "pictures/scenes.h"

namespace samples {
namespace {

Point point_of(const std::vector<double>& xyz, size_t v) { return {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}; }

Polyline outline_of(const std::vector<double>& xyz, const uint32_t* corners, uint32_t count) {
  Polyline outline;
  outline.width = 0.7;
  outline.color = {0.16, 0.22, 0.36};
  for (uint32_t k = 0; k <= count; ++k) outline.points.push_back(point_of(xyz, corners[k % count]));
  return outline;
}

}  // namespace

Picture draw_surface(const Body& body, int width, int height) {
  Marks marks;
  for (size_t i = 0; i < body.mesh.triangles.size(); i += 3)
    marks.lines.push_back(outline_of(body.mesh.positions, &body.mesh.triangles[i], 3));
  View view = side_view(width, height);
  view.fixed_box = false;
  SurfaceLook look;
  look.fill = Fill::colors;
  return render(body.drawn(), view, look, marks);
}

Picture draw_geodesics(const Body& body, int width, int height) {
  const uint32_t muzzle = body.vertex_at(0, 1.45, 1.6), hoof = body.vertex_at(-0.15, 0, -0.6);
  const hf::Geodesics geodesics(body.surface);
  Surface drawn = body.drawn();
  drawn.scalars = geodesics.solve_f64({muzzle});
  Polyline line;
  line.width = 2;
  line.color = {0.75, 0.08, 0.08};
  const std::vector<double> points = geodesics
                                         .find_path(hf_place{{muzzle, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}},
                                                    hf_place{{hoof, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}})
                                         .positions;
  for (size_t i = 0; i < points.size() / 3; ++i) line.points.push_back(point_of(points, i));
  Marks marks;
  marks.lines.push_back(line);
  for (const uint32_t end : {muzzle, hoof}) marks.dots.push_back({point_of(body.mesh.positions, end), 0.014});
  View view = side_view(width, height);
  view.fixed_box = false;
  const double farthest = *std::max_element(drawn.scalars.begin(), drawn.scalars.end());
  return render(drawn, view, strips_to(farthest, 32), marks);
}

Picture draw_cut(const Body& body, int width, int height) {
  // a wave along the flank, from the shoulder to the hip
  hf::CutOptions knife;
  for (int i = 0; i <= 16; ++i) {
    const double share = i / 16.0;
    knife.points.insert(knife.points.end(), {-0.6, 1.25 + 0.12 * std::sin(9 * share), 0.55 - 1.15 * share});
  }
  const hf::Cut cut = body.surface.trace_cut(knife);
  hf::SurfaceEdit edit;
  edit.patch = hf::Patch{cut.removed_triangles, cut.new_positions, cut.new_triangles, {}};
  const hf::Surface edited = body.surface.edit(edit);
  // 0 and 1 at the two sides of the middle
  hf::Solver solver(edited);
  const size_t middle = cut.rim_vertices.size() / 4 * 2;
  solver.add_sites({cut.rim_vertices[middle], cut.rim_vertices[middle + 1]}, {0, 1});
  Surface drawn;
  drawn.positions = body.mesh.positions;
  drawn.positions.insert(drawn.positions.end(), cut.new_positions.begin(), cut.new_positions.end());
  for (size_t t = 0; t < body.mesh.triangles.size() / 3; ++t) {
    if (std::binary_search(cut.removed_triangles.begin(), cut.removed_triangles.end(), static_cast<uint32_t>(t)))
      continue;
    drawn.triangles.insert(drawn.triangles.end(), &body.mesh.triangles[3 * t], &body.mesh.triangles[3 * t] + 3);
  }
  drawn.triangles.insert(drawn.triangles.end(), cut.new_triangles.begin(), cut.new_triangles.end());
  drawn.scalars = solver.solve_f64();
  Marks marks;
  for (size_t i = 0; i < drawn.triangles.size(); i += 3) {
    marks.lines.push_back(outline_of(drawn.positions, &drawn.triangles[i], 3));
    marks.lines.back().width = 0.4;
  }
  Polyline line;
  line.width = 3;
  line.color = {0.75, 0.08, 0.08};
  for (size_t i = 0; i < cut.rim_vertices.size(); i += 2)
    line.points.push_back(point_of(drawn.positions, cut.rim_vertices[i]));
  marks.lines.push_back(line);
  View view = side_view(width, height);
  view.fixed_box = false;
  return render(drawn, view, strips_to(1, 24), marks);
}

Picture draw_quads(const Body& body, int width, int height) {
  const hf::QuadsMesh quads = hf::Quads(body.surface).mesh();
  Surface drawn;
  drawn.positions = quads.positions;
  Marks marks;
  const std::vector<glm::dvec3> places = to_points(quads.positions);
  FaceTriangles cut;
  for (size_t i = 0; i < quads.faces.size(); i += 4) {
    cut.append(places, &quads.faces[i], 4, drawn.triangles);
    marks.lines.push_back(outline_of(quads.positions, &quads.faces[i], 4));
  }
  View view = side_view(width, height);
  view.fixed_box = false;
  SurfaceLook look;
  look.color = {0.72, 0.80, 0.92};
  return render(drawn, view, look, marks);
}

Picture draw_detail(const Body& body, int width, int height) {
  // the head, in front of a slanted plane through the neck
  std::vector<uint32_t> head;
  Box box;
  bool empty = true;
  std::vector<double> seen;
  const double neck[3] = {0, 1.62, 0.92}, normal[3] = {0, 0.35, 1};
  for (uint32_t v = 0; v < body.surface.vertex_count(); ++v) {
    const double* p = &body.mesh.positions[3 * size_t{v}];
    if ((p[1] - neck[1]) * normal[1] + (p[2] - neck[2]) * normal[2] <= 0) continue;
    head.push_back(v);
    seen.insert(seen.end(), p, p + 3);
  }
  extend(box, empty, seen);
  hf::RegionOptions thin_plate;
  thin_plate.base = HF_BASE_THIN_PLATE;
  hf::Region region(body.surface, thin_plate);
  hf::RegionEditOptions add;
  add.add_vertices = head;
  region.edit(add);
  std::vector<uint8_t> in(body.surface.vertex_count(), 0);
  for (const uint32_t v : head) in[v] = 1;
  Picture page{width, height, std::vector<uint8_t>(3 * size_t(width) * size_t(height), 246)};
  const double weights[2] = {0, 0.5};
  for (int column = 0; column < 2; ++column) {
    Surface drawn = body.drawn(region.morph(weights[column]));
    for (size_t v = 0; v < in.size(); ++v) {
      const float plain[3] = {0.80f, 0.78f, 0.74f}, blue[3] = {0.52f, 0.66f, 0.80f};
      for (size_t c = 0; c < 3; ++c) drawn.colors[3 * v + c] = in[v] ? blue[c] : plain[c];
    }
    View view = side_view(width / 2, height);
    view.box = box;
    view.margin = 0.08;
    view.ground = false;
    SurfaceLook look;
    look.fill = Fill::colors;
    paste(page, render(drawn, view, look), column * (width / 2), 0);
  }
  return page;
}

Picture draw_direction(const Body& body, int width, int height) {
  hf::Direction direction(body.surface);
  const std::vector<uint32_t> sites = {body.vertex_at(-0.4, 1.25, -0.5), body.vertex_at(-0.4, 1.15, 0.5)};
  const std::vector<double> vectors = {0, 0, 1, 0, 0.8, 0.6};
  direction.add_sites(sites, vectors);
  const std::vector<float> field = direction.solve();
  // strokes at vertices about equally far apart
  const double spacing = 0.11;
  std::vector<glm::dvec3> taken;
  Marks marks;
  for (size_t v = 0; v < field.size() / 3; ++v) {
    const Point at = point_of(body.mesh.positions, v);
    const glm::dvec3 p{at[0], at[1], at[2]};
    glm::dvec3 along{double(field[3 * v]), double(field[3 * v + 1]), double(field[3 * v + 2])};
    bool near = false;
    for (const glm::dvec3& other : taken) near = near || glm::distance(p, other) < spacing;
    if (near || !(glm::length(along) > 0)) continue;
    taken.push_back(p);
    along = 0.45 * spacing * glm::normalize(along);
    Arrow arrow;
    arrow.from = {p.x - along.x, p.y - along.y, p.z - along.z};
    arrow.to = {p.x + along.x, p.y + along.y, p.z + along.z};
    arrow.width = 1.5;
    arrow.color = {0.10, 0.22, 0.45};
    marks.arrows.push_back(arrow);
  }
  for (const uint32_t site : sites) marks.dots.push_back({point_of(body.mesh.positions, site), 0.013});
  View view = side_view(width, height);
  view.fixed_box = false;
  SurfaceLook look;
  look.color = {0.86, 0.85, 0.82};
  return render(body.drawn(), view, look, marks);
}

}  // namespace samples
