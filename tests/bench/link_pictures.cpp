// hf_link_pictures MODEL.glb ... [--parts] --out FOLDER: poses of characters of parts, four pictures each: at rest,
// posed without links, posed with links, and by the artist's skin. --parts draws the scenes of parts_test too, without
// a skin: from the front, and from the side to which the turned end goes.
//
// A pose turns one limb of the skeleton by 60 degrees. The skin follows the joint. The library gets the outer half of
// the limb as a handle, of its largest piece, and pins far from it. The program prints how far both poses are from the
// skin's: the root of the mean square over all vertices, and the farthest vertex, in % of the box.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>

#include "bench/link_scene.h"
#include "common/picture.h"
#include "support/part_scenes.h"
#include "support/arrays.h"

namespace {

using namespace bench;

// A limb is a joint whose bones move this share of the area. The first is as near as possible to best_limb, the second
// as far as possible from it.
constexpr double least_limb = 0.04, most_limb = 0.35, best_limb = 0.12;
constexpr double turn_degrees = 60, pin_radius = 0.04, pin_distance = 0.15;
constexpr int poses_a_model = 2, pin_count = 10;

struct Limb {
  int joint = -1;
  std::vector<double> weight;  // by vertex, of all bones of the limb
  double share = 0;
};

bool below(const Model& model, int node, int ancestor) {
  for (; node >= 0; node = model.nodes[size_t(node)].parent) {
    if (node == ancestor) return true;
  }
  return false;
}

// A third of the area of the triangles around each vertex.
std::vector<double> areas_of(const LinkScene& scene) {
  std::vector<double> out(scene.flat.vertex_count(), 0);
  for (size_t t = 0; t < scene.flat.triangle_count(); ++t) {
    const uint32_t* c = &scene.flat.triangles[3 * t];
    const std::vector<glm::dvec3>& p = scene.flat.positions;
    for (int k = 0; k < 3; ++k) out[c[k]] += glm::length(glm::cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]])) / 6;
  }
  return out;
}

std::vector<Limb> limbs_of(const LinkScene& scene, const ModelLinks& links, const std::vector<glm::dmat4>& world) {
  const std::vector<double> areas = areas_of(scene);
  double whole = 0;
  for (const double area : areas) whole += area;
  std::vector<Limb> all, out;
  for (const Skin& skin : scene.model.skins) {
    for (const int joint : skin.joints) {
      Limb limb;
      limb.joint = joint;
      limb.weight.assign(areas.size(), 0);
      for (size_t i = 0; i < links.joints.size(); ++i) {
        const float w = links.weights[i];
        if (w > 0 && below(scene.model, links.joints[i], joint)) limb.weight[i / 8] += static_cast<double>(w);
      }
      for (size_t v = 0; v < areas.size(); ++v) limb.share += limb.weight[v] > 0.5 ? areas[v] / whole : 0.0;
      if (limb.share > least_limb && limb.share < most_limb) all.push_back(limb);
    }
  }
  const auto off = [&](const Limb& limb) {
    double value = std::abs(std::log(limb.share / best_limb));
    for (const Limb& other : out) {
      if (below(scene.model, limb.joint, other.joint) || below(scene.model, other.joint, limb.joint)) return 1e300;
      value = -glm::length(glm::dvec3(world[size_t(limb.joint)][3] - world[size_t(other.joint)][3]));
    }
    return value;
  };
  while (int(out.size()) < poses_a_model) {
    const auto best = std::min_element(all.begin(), all.end(), [&](const Limb& a, const Limb& b) {
      return off(a) != off(b) ? off(a) < off(b) : a.joint < b.joint;
    });
    if (best == all.end() || off(*best) == 1e300) break;
    const Limb found = *best;
    out.push_back(found);
  }
  return out;
}

glm::dvec3 point(const std::vector<double>& xyz, size_t v) { return {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}; }

// The outer half of the limb, on the piece that has most of it.
std::vector<uint32_t> handle_of(const LinkScene& scene, const Limb& limb, const glm::dvec3& joint) {
  std::vector<double> far;
  for (size_t v = 0; v < limb.weight.size(); ++v) {
    if (limb.weight[v] > 0.5) far.push_back(glm::length(point(scene.xyz, v) - joint));
  }
  std::nth_element(far.begin(), far.begin() + long(far.size() / 2), far.end());
  std::map<uint32_t, std::vector<uint32_t>> by_piece;
  for (uint32_t v = 0; v < limb.weight.size(); ++v) {
    if (limb.weight[v] > 0.98 && scene.piece[v] != HF_NO_INDEX &&
        glm::length(point(scene.xyz, v) - joint) >= far[far.size() / 2])
      by_piece[scene.piece[v]].push_back(v);
  }
  std::vector<uint32_t> out;
  for (const auto& [piece, vertices] : by_piece) {
    if (vertices.size() > out.size()) out = vertices;
  }
  return out;
}

// Vertices that the limb does not move, far from its joint and from each other.
std::vector<uint32_t> pins_of(const LinkScene& scene, const Limb& limb, const glm::dvec3& joint) {
  std::vector<double> distance(limb.weight.size(), -1);
  for (size_t v = 0; v < distance.size(); ++v) {
    const double d = glm::length(point(scene.xyz, v) - joint);
    if (limb.weight[v] < 0.01 && scene.piece[v] != HF_NO_INDEX && d > pin_distance * scene.diagonal) distance[v] = d;
  }
  std::vector<uint32_t> out;
  for (int i = 0; i < pin_count; ++i) {
    const size_t v = size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (distance[v] < 2 * pin_radius * scene.diagonal) break;
    out.push_back(uint32_t(v));
    for (size_t u = 0; u < distance.size(); ++u)
      distance[u] = std::min(distance[u], glm::length(point(scene.xyz, u) - point(scene.xyz, v)));
  }
  return out;
}

std::vector<double> pose_with(hf_surface surface, const LinkScene& scene, const std::vector<uint32_t>& region,
                              const std::vector<uint32_t>& pins, const glm::dmat4& turn) {
  hf_pose pose = nullptr;
  ok(hf_pose_create(surface, nullptr, &pose));
  const uint32_t count = uint32_t(region.size());
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 1;
  desc.region_counts = &count;
  desc.region_vertices = region.data();
  uint32_t handle = 0;
  ok(hf_pose_add_handles(pose, &desc, &handle));
  for (const uint32_t pin : pins) {
    const glm::dvec3 p = point(scene.xyz, pin);
    // A pin that would overlap another region is left out.
    const hf_result result = hf_pose_add_handle_at(pose, &p.x, pin_radius * scene.diagonal, nullptr);
    if (result != HF_ERROR_CONFLICT) ok(result);
  }
  ok(hf_pose_set_matrices(pose, 1, &handle, &turn[0][0]));
  std::vector<double> out(scene.xyz.size());
  hf_deform_desc frame = HF_INIT(hf_deform_desc);
  frame.positions = ROWS_OUT(out.data());
  for (int i = 0; i < 20; ++i) ok(hf_pose_deform(pose, &frame, nullptr));
  hf_pose_destroy(pose);
  return out;
}

Picture tile(const LinkScene& scene, const std::vector<double>& xyz, const Box& box,
             const std::vector<uint32_t>& region, const std::vector<uint32_t>& pins,
             const Point& direction = {0.45, 0.2, 1.0}) {
  Surface surface = make_surface(xyz, scene.flat.triangles);
  View view;
  view.width = 460;
  view.height = 460;
  view.direction = direction;
  view.fixed_box = true;
  view.box = box;
  SurfaceLook look;
  look.fill = Fill::colors;
  surface.colors.reserve(xyz.size());
  for (size_t v = 0; v < scene.piece.size(); ++v) {  // a tint for each piece
    const double tint = scene.piece[v] == HF_NO_INDEX ? 0 : std::fmod(scene.piece[v] * 0.61803398875, 1.0);
    for (const double shift : {0.0, 0.33, 0.67})
      surface.colors.push_back(static_cast<float>(0.72 + 0.16 * std::cos(6.2831853 * (tint + shift))));
  }
  Marks marks;
  for (const uint32_t v : pins)
    marks.dots.push_back({{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}, 0.009, {0.1, 0.2, 0.8}});
  for (size_t i = 0; i < region.size(); i += 1 + region.size() / 12) {
    const uint32_t v = region[i];
    marks.dots.push_back({{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}, 0.006});
  }
  return render(surface, view, look, marks);
}

std::string distance_text(const LinkScene& scene, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, worst = 0;
  for (size_t v = 0; v < scene.piece.size(); ++v) {
    const double d = glm::length(point(a, v) - point(b, v)) / scene.diagonal;
    sum += d * d / double(scene.piece.size());
    worst = std::max(worst, d);
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.2f / %.1f %%", 100 * std::sqrt(sum), 100 * worst);
  return text;
}

void draw(const std::string& file, const std::string& folder) {
  LinkScene scene = read_scene(file);
  const ModelLinks links(&scene.model, scene.flat);
  hf_surface plain = make_linked(scene, nullptr), linked = make_linked(scene, &links.desc);
  scene.piece.resize(scene.flat.vertex_count());
  uint32_t count = 0;
  ok(hf_surface_get_pieces(linked, scene.flat.vertex_count(), scene.piece.data(), nullptr, &count));
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  const std::string name = file.substr(file.find_last_of('/') + 1);
  const std::vector<glm::dmat4> world = global_matrices(scene.model, rest_pose(scene.model));
  for (const Limb& limb : limbs_of(scene, links, world)) {
    const glm::dvec3 joint = world[size_t(limb.joint)][3];
    const std::vector<uint32_t> region = handle_of(scene, limb, joint), pins = pins_of(scene, limb, joint);
    if (region.empty()) continue;
    glm::dvec3 middle(0);
    for (const uint32_t v : region) middle += point(scene.xyz, v) / double(region.size());
    // About the axis across the limb that the camera sees best.
    const glm::dvec3 along = glm::normalize(middle - joint), seen = glm::normalize(glm::dvec3(0.45, 0.2, 1.0));
    const glm::dmat4 turn = turn_about(joint, glm::normalize(seen - glm::dot(seen, along) * along), turn_degrees);
    const std::vector<double> skin = turned_by_skin(scene, limb.joint, turn);
    const std::vector<double> without = pose_with(plain, scene, region, pins, turn),
                              with = pose_with(linked, scene, region, pins, turn);
    Box box;
    bool empty = true;
    extend(box, empty, scene.xyz);
    extend(box, empty, skin);
    extend(box, empty, with);
    const std::string apart[2] = {distance_text(scene, without, skin), distance_text(scene, with, skin)};
    tiles.push_back(tile(scene, scene.xyz, box, region, pins));
    labels.push_back(scene.model.nodes[size_t(limb.joint)].name);
    tiles.push_back(tile(scene, without, box, {}, {}));
    labels.push_back("without links: " + apart[0]);
    tiles.push_back(tile(scene, with, box, {}, {}));
    labels.push_back("with links: " + apart[1]);
    tiles.push_back(tile(scene, skin, box, {}, {}));
    labels.push_back("the artist's skin");
    std::printf("| %s | %s | %s | %s |\n", name.c_str(), scene.model.nodes[size_t(limb.joint)].name.c_str(),
                apart[0].c_str(), apart[1].c_str());
    std::fflush(stdout);
  }
  hf_surface_destroy(plain);
  hf_surface_destroy(linked);
  if (!tiles.empty()) write_png(folder + "/" + name + ".png", contact_sheet(tiles, 4, labels, name));
}

// A row of a scene of parts_test: rest, without links, with links, and with tags. Where there are no tags, the fourth
// picture is the third from the other side.
void add_parts(const hf_test::PartScene& parts, const Point& view, std::vector<Picture>& tiles,
               std::vector<std::string>& labels) {
  LinkScene scene;
  scene.xyz = parts.mesh.positions;
  scene.flat.triangles = parts.mesh.triangles;
  for (size_t v = 0; v < parts.mesh.vertex_count(); ++v) scene.flat.positions.push_back(point(scene.xyz, v));
  scene.piece.resize(parts.mesh.vertex_count());
  const auto pose = [&](const hf_links_desc* links) {
    hf_surface surface = make_linked(scene, links);
    hf_pose pose = nullptr;
    uint32_t handle = 0, count = 0;
    ok(hf_surface_get_pieces(surface, parts.mesh.vertex_count(), scene.piece.data(), nullptr, &count));
    ok(hf_pose_create(surface, nullptr, &pose));
    ok(hf_pose_add_handle_at(pose, parts.turned.data(), parts.radius, &handle));
    ok(hf_pose_add_handle_at(pose, parts.held.data(), parts.radius, nullptr));
    const glm::dvec3 pivot(parts.pivot[0], parts.pivot[1], parts.pivot[2]);
    const glm::dmat4 matrix = turn_about(pivot, {0, 1, 0}, turn_degrees);
    ok(hf_pose_set_matrices(pose, 1, &handle, &matrix[0][0]));
    std::vector<double> out(scene.xyz.size());
    hf_deform_desc frame = HF_INIT(hf_deform_desc);
    frame.positions = ROWS_OUT(out.data());
    for (int i = 0; i < 20; ++i) ok(hf_pose_deform(pose, &frame, nullptr));
    hf_pose_destroy(pose);
    hf_surface_destroy(surface);
    return out;
  };
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  const std::vector<double> without = pose(nullptr), with = pose(&links);
  links.tags = parts.tags.empty() ? nullptr : parts.tags.data();
  const std::vector<double> last = links.tags ? pose(&links) : with;
  std::vector<uint32_t> turned, held;
  for (uint32_t v = 0; v < parts.mesh.vertex_count(); ++v) {
    const auto near = [&](const std::array<double, 3>& p) {
      return glm::length(point(scene.xyz, v) - glm::dvec3(p[0], p[1], p[2])) <= parts.radius;
    };
    if (near(parts.turned)) turned.push_back(v);
    if (near(parts.held) && v % 3 == 0) held.push_back(v);
  }
  Box box;
  bool empty = true;
  extend(box, empty, scene.xyz);
  extend(box, empty, without);
  extend(box, empty, with);
  extend(box, empty, last);
  const Point other{-view[0], view[1], -view[2]};
  tiles.push_back(tile(scene, scene.xyz, box, turned, held, view));
  labels.push_back("rest");
  tiles.push_back(tile(scene, without, box, {}, {}, view));
  labels.push_back("without links");
  tiles.push_back(tile(scene, with, box, {}, {}, view));
  labels.push_back("with links");
  tiles.push_back(tile(scene, last, box, {}, {}, links.tags ? view : other));
  labels.push_back(links.tags ? "with links and tags" : "with links, from the other side");
}

void draw_parts(const std::string& folder) {
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  const Point side{0.4, -0.8, 0.5}, face{0.5, -0.4, 0.8}, back{0.6, 0.5, -0.7};
  add_parts(hf_test::cloth(), side, tiles, labels);
  add_parts(hf_test::eyes_and_teeth(), face, tiles, labels);
  add_parts(hf_test::hair_cards(), back, tiles, labels);
  add_parts(hf_test::armour_and_sword(), side, tiles, labels);
  add_parts(hf_test::rider(), side, tiles, labels);
  write_png(folder + "/parts.png", contact_sheet(tiles, 4, labels, "characters of parts"));
}

}  // namespace

int main(int count, char** arguments) {
  std::string folder = ".";
  for (int i = 1; i + 1 < count; ++i) {
    if (std::strcmp(arguments[i], "--out") == 0) folder = arguments[i + 1];
  }
  std::printf("| model | joint | without links: mean / worst | with links |\n|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--out") == 0) {
      ++i;
      continue;
    }
    try {
      if (std::strcmp(arguments[i], "--parts") == 0)
        draw_parts(folder);
      else
        draw(arguments[i], folder);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "hf_link_pictures: %s: %s\n", arguments[i], error.what());
      return 1;
    }
  }
  return 0;
}
