// hf_detail: takes the detail of a region away, exaggerates it, or carries it to another surface. See README.md beside
// this file, or --help.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "common/program.h"
#include "detail/curve_file.h"
#include "detail/detail_sheet.h"

namespace samples {
namespace {

const char* const usage =
    "usage: hf_detail MESH --curve C.json --weight W [--membrane] [--grow N] [--onto MESH2 --onto-curve C2.json]\n"
    "                 [-o OUT] [--sheet FILE.png]\n"
    "  Morphs a region of a .obj, .off, .ply, .stl or glTF surface towards its smooth base surface.\n"
    "  --curve FILE       closed curve round the region: {\"points\": [{\"near\": [x, y, z]}, {\"vertex\": 12}, ...],\n"
    "                     \"side\": \"smaller\" or \"larger\", or \"seed\": vertex inside, \"grow\": rings,\n"
    "                     \"edges\": true joins the points along edges, else straight through triangles}\n"
    "  --weight W         0 the surface, 1 its base; between, beyond and below 0 as well (1)\n"
    "  --membrane         the base has nearly the least area; else it is a thin plate, which leaves its rim smoothly\n"
    "  --grow N           then grows the region by N rings of vertices, below 0 shrinks it\n"
    "  --onto MESH2       carries the detail to the region of this surface that --onto-curve encloses: its weight W\n"
    "                     is 1 as it was, 0 none, 2 twice as high; points of both curves correspond\n"
    "  -o, --output OUT   .glb, .gltf, .obj, .ply or .off\n"
    "  --sheet FILE       a picture: surface, both bases, morphs\n"
    "  --work-limit N     refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N   refuse a surface that holds more than N MiB (default: by the size)\n";

struct Command {
  std::filesystem::path mesh, curve, onto, onto_curve, out, sheet;
  double weight = 1;
  int32_t grow = 0;
  bool thin_plate = true, help = false;
};

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("--curve")) {
      out.curve = words.file();
    } else if (words.is("--weight")) {
      out.weight = words.number(-1000, 1000);
    } else if (words.is("--membrane")) {
      out.thin_plate = false;
    } else if (words.is("--grow")) {
      out.grow = words.integer(-10000, 10000);
    } else if (words.is("--onto")) {
      out.onto = words.file();
    } else if (words.is("--onto-curve")) {
      out.onto_curve = words.file();
    } else if (words.is("-o", "--output")) {
      out.out = words.file();
    } else if (words.is("--sheet")) {
      out.sheet = words.file();
    } else if (words.take_limit()) {
      continue;
    } else {
      words.take_mesh(out.mesh);
    }
  }
  if (out.help) return out;
  if (out.mesh.empty()) throw std::runtime_error("no mesh is named; see --help");
  if (out.curve.empty()) throw std::runtime_error("no curve is named; see --help");
  if (out.onto.empty() != out.onto_curve.empty()) throw std::runtime_error("--onto and --onto-curve go together");
  return out;
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

double seconds_of(const std::chrono::steady_clock::time_point& begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<glm::dvec3> moved(std::vector<glm::dvec3> points, const glm::dvec3& by) {
  for (glm::dvec3& p : points) p += by;
  return points;
}

// A mesh, its solver, and the region that a curve encloses.
struct Subject {
  Subject(const std::filesystem::path& file, const std::filesystem::path& curve_name, bool thin_plate, int32_t grow)
      : mesh(read_mesh_file(file)),
        offset(node_offset(mesh.positions)),
        positions(float_positions(moved(mesh.positions, -offset))),
        curve(read_curve_file(curve_name, mesh)),
        surface(make_surface(thin_plate)),
        region(*surface, hf::RegionOptions{positions, thin_plate ? HF_BASE_THIN_PLATE : HF_BASE_MEMBRANE}) {
    const auto begin = std::chrono::steady_clock::now();
    enclose(region, curve, 0);
    edit_seconds = seconds_of(begin);
    if (grow == 0) return;
    const auto again = std::chrono::steady_clock::now();
    hf::RegionEditOptions edit;
    edit.ring_count = grow;
    region.edit(edit);
    grow_seconds = seconds_of(again);
  }
  std::optional<hf::Surface> make_surface(bool thin_plate) {
    const auto begin = std::chrono::steady_clock::now();
    auto create = hf::make<hf_surface_desc>();
    create.vertex_count = static_cast<uint32_t>(mesh.positions.size());
    create.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
    create.positions = positions.data();
    create.triangles = mesh.triangles.data();
    create.field_kind = thin_plate ? HF_FIELD_BIHARMONIC : HF_FIELD_HARMONIC;
    limit_surface(create);
    std::optional<hf::Surface> made(create);
    create_seconds = seconds_of(begin);
    return made;
  }
  void print(const char* what) const {
    const hf_region_info info = region.info();
    const hf_region_statistics work = region.statistics();
    std::printf("%-10s  %zu vertices, %zu triangles; factored in %.3f s\n", what, mesh.positions.size(),
                mesh.triangles.size() / 3, create_seconds);
    std::printf("region      %u vertices, rim %u, sites %u; %s of area %.6g over %.6g, made in %.3f s\n",
                info.vertex_count, info.rim_count, info.site_count,
                info.field_kind != HF_FIELD_HARMONIC ? "thin plate" : "membrane", info.base_area, info.area,
                edit_seconds);
    if (grow_seconds >= 0)
      std::printf("grown       %u sites inserted, %u removed, %u kept in %.3f s; %u factorisations\n",
                  work.inserted_count, work.removed_count, work.kept_count, grow_seconds, work.factorisation_count);
  }
  double create_seconds = 0, edit_seconds = 0, grow_seconds = -1;  // first: set while the surface is made
  SurfaceMesh mesh;
  glm::dvec3 offset;             // the region works on floats: it stands at 0 where the mesh is far from there
  std::vector<float> positions;  // without the offset
  CurveFile curve;
  std::optional<hf::Surface> surface;
  hf::Region region;
};

// The detail of `from` on `onto`: the points of the two curves correspond where both have as many on their rims.
hf::Detail carry(const Subject& from, const Subject& onto) {
  auto desc = hf::make<hf_detail_desc>();
  const std::vector<uint32_t>&a = from.curve.vertices, &b = onto.curve.vertices;
  const auto on_rim = [](const Subject& s) {
    const std::vector<uint32_t> rim = s.region.vertices(HF_REGION_RIM);
    for (const uint32_t v : s.curve.vertices)
      if (!std::binary_search(rim.begin(), rim.end(), v)) return false;
    return true;
  };
  if (!a.empty() && a.size() == b.size() && on_rim(from) && on_rim(onto)) {
    desc.pair_count = static_cast<uint32_t>(a.size());
    desc.source_vertices = a.data();
    desc.target_vertices = b.data();
  }
  return hf::Detail(from.region, onto.region, desc);
}

void run(const Command& options) {
  const Subject subject(options.mesh, options.curve, options.thin_plate, options.grow);
  subject.print("mesh");
  std::optional<Subject> onto;
  std::optional<hf::Detail> detail;
  if (!options.onto.empty()) {
    onto.emplace(options.onto, options.onto_curve, options.thin_plate, 0);
    onto->print("onto");
    detail.emplace(carry(subject, *onto));
  }
  const Subject& shown = onto ? *onto : subject;
  const std::vector<float> result = detail ? detail->morph(options.weight) : subject.region.morph(options.weight);
  if (!options.out.empty()) {
    SurfaceMesh written;
    written.positions = moved(to_points(result), shown.offset);
    written.triangles = shown.mesh.triangles;
    write_mesh_file(written, options.out);
    std::printf("wrote       %s\n", options.out.c_str());
  }
  if (!options.sheet.empty()) {
    SheetScene scene;
    scene.triangles = shown.mesh.triangles;
    scene.surface = shown.positions;
    scene.inside = shown.region.vertices();
    scene.points = shown.curve.vertices;
    scene.curve = shown.region.curve();
    const std::string name = options.mesh.filename().string();
    std::vector<SheetTile> tiles;
    if (detail) {
      tiles = {{"surface and curve", shown.positions},
               {"its base", shown.region.morph(1)},
               {"detail of " + name + ", weight " + text_of(options.weight), result}};
    } else {
      const Subject other(options.mesh, options.curve, !options.thin_plate, options.grow);
      const Subject& plate = options.thin_plate ? subject : other;
      const Subject& membrane = options.thin_plate ? other : subject;
      const char* base = options.thin_plate ? "thin plate" : "membrane";
      tiles = {{"surface and curve", subject.positions},
               {"membrane (weight 1)", membrane.region.morph(1)},
               {"thin plate (weight 1)", plate.region.morph(1)},
               {std::string(base) + ", weight 0.5", subject.region.morph(0.5)},
               {std::string(base) + ", weight -0.5", subject.region.morph(-0.5)},
               {std::string(base) + ", weight " + text_of(options.weight), result}};
    }
    write_sheet(options.sheet, scene, tiles, {});
    std::printf("wrote       %s\n", options.sheet.c_str());
  }
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_detail", samples::usage, count, arguments, samples::parse, samples::run);
}
