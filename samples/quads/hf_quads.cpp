// hf_quads: a quad mesh of any mesh file. See README.md beside this file, or --help.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "common/face_triangles.h"
#include "common/picture.h"
#include "common/program.h"
#include "gltf/file_kind.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/json_file.h"
#include "hf/hf.hpp"
#include "quads/crease_report.h"
#include "quads/crossings.h"
#include "quads/quad_model.h"
#include "quads/quad_report.h"
#include "quads/strokes.h"
#include "quads/surface_distance.h"

namespace samples {

using namespace hf_gltf;
namespace {

const char* const usage =
    "usage: hf_quads MESH [--faces N] [--edge LENGTH] [--crease DEG] [--strokes FILE.json]\n"
    "                [--irregular FILE.json] [--symmetry x|y|z] [-o OUT] [--sheet FILE.png]\n"
    "       hf_quads MESH --measure QUADS [--sheet FILE.png]\n"
    "  Makes a quad mesh of a .obj, .off, .ply, .stl or glTF surface, and prints its quality.\n"
    "  Edges follow smooth crosses along the curvature.\n"
    "  --faces N      number of quads aimed at, instead of --edge\n"
    "  --edge LENGTH  edge length aimed at, in the unit of the mesh, or as a share of its box diagonal: 2% (2.2%)\n"
    "  --crease DEG   edges of the surface that bend by more degrees become edges of quads; those that the quads are\n"
    "                 too large for are released and counted\n"
    "  --strokes FILE {\"strokes\": [{\"points\": [[0, 1, 0.2], [0.1, 1, 0.3]], \"weight\": 1}]}: edges follow these "
    "lines,\n"
    "                 in the frame of the mesh; below 1 the curvature has a say\n"
    "  --irregular FILE\n"
    "                 {\"irregular\": [{\"point\": [0, 1, 0.2], \"valence\": 3, \"direction\": [1, 0, 0]}]}: 3 or 5 "
    "quads\n"
    "                 meet there; one of its sides runs along the direction, which may be missing\n"
    "  --symmetry x   the side where x (or y, or z) is positive gets quads, the other side is its mirror image; the\n"
    "                 plane goes through 0, and --symmetry x=0.25 moves it\n"
    "  --relax N      rounds of tangential relaxation (60; 0 for none)\n"
    "  --measure FILE makes no quads and measures the quads of FILE, which any program can have made of MESH\n"
    "  -o OUT         .obj, .ply or .off with quads; .glb or .gltf with a fan of triangles for each face\n"
    "                 (FB_ngon_encoding). A glTF model keeps its skeleton, clips and looks: texture coordinates with\n"
    "                 their seams, colours, weights and morph targets are carried to the quads\n"
    "  --sheet FILE   a picture from two sides: quads light, other polygons red\n"
    "  --work-limit N refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N refuse a surface that holds more than N MiB (default: by the size)\n";

struct Command {
  std::filesystem::path mesh, strokes, irregular, measured, out, sheet;
  double plane[4] = {0, 0, 0, 0};              // of symmetry; 0: none
  double edge = 0;                             // 0: the default; below 0: a share of the box diagonal
  uint32_t relax = 60, faces = 0, crease = 0;  // crease in degrees
  bool help = false;
};

constexpr double most_faces = 10000000;  // of --faces: the most that it takes
// Of more quads --edge does not raise the limits, so they are refused at once. A length that is meant for another unit
// asks for any number; half refuses what is made in seconds, twice lets minutes through.
constexpr double most_by_edge = 100000;
// A mesh with fewer than this share of the quads that an edge length asks for is warned of. Borders take up to a third.
constexpr double too_few = 0.5;
// A mesh whose count is farther from --faces than this share is warned of. A body has few meshes of few quads: a cube
// misses 40 by up to a tenth.
constexpr double missed_count = 0.2;

// A length, or with a percent sign a share of the box diagonal, which comes back below 0.
double read_edge(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool share = *end == '%' && end[1] == 0;
  if (text.empty() || (*end != 0 && !share) || !(value > 0) || !std::isfinite(value))
    throw std::runtime_error("--edge takes a length above 0, or a share of the box as in 2.2%, not \"" + text + "\"");
  return share ? -value / 100 : value;
}

// "x", "y" or "z", and where the plane crosses that axis: "x=0.25".
void read_symmetry(const std::string& text, double* plane) {
  const size_t axis = std::string("xyz").find(text[0]);
  char* end = nullptr;
  const double place = text.size() > 2 ? std::strtod(text.c_str() + 2, &end) : 0;
  if (text.empty() || axis > 2 || (text.size() > 1 && (text[1] != '=' || !end || *end != 0)) || !std::isfinite(place))
    throw std::runtime_error("--symmetry takes x, y or z, or a place on that axis as in x=0.25, not \"" + text + "\"");
  std::fill(plane, plane + 4, 0.0);  // the last --symmetry counts
  plane[axis] = 1;
  plane[3] = place;
}

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("--edge")) {
      out.edge = read_edge(words.value());
    } else if (words.is("--faces")) {
      out.faces = words.whole(1, static_cast<uint32_t>(most_faces));
    } else if (words.is("--crease")) {
      out.crease = words.whole(1, 180);
    } else if (words.is("--strokes")) {
      out.strokes = words.file();
    } else if (words.is("--irregular")) {
      out.irregular = words.file();
    } else if (words.is("--symmetry")) {
      read_symmetry(words.value(), out.plane);
    } else if (words.is("--relax")) {
      out.relax = words.whole(0, 1000);
    } else if (words.is("--measure")) {
      out.measured = words.file();
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
  if (!out.help && out.mesh.empty()) throw std::runtime_error("no mesh is named; see --help");
  return out;
}

// About how many quads are asked for: of an edge length as many as squares of it cover the surface. 0: nothing is
// asked.
double wanted_faces(const Command& options, const SurfaceMesh& mesh) {
  if (options.faces > 0 || options.edge == 0) return options.faces;
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
  double area = 0;
  for (size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const glm::dvec3 &a = mesh.positions[mesh.triangles[i]], &b = mesh.positions[mesh.triangles[i + 1]],
                     &c = mesh.positions[mesh.triangles[i + 2]];
    area += 0.5 * length(cross(b - a, c - a));
    low = min(min(low, a), min(b, c));
    high = max(max(high, a), max(b, c));
  }
  const double edge = options.edge < 0 ? -options.edge * length(high - low) : options.edge;
  return area / (edge * edge);
}

double mean_edge(const SurfaceMesh& mesh) {
  double sum = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    sum += length(mesh.positions[mesh.triangles[next]] - mesh.positions[mesh.triangles[i]]);
  }
  return sum / static_cast<double>(std::max<size_t>(1, mesh.triangles.size()));
}

TriangleSoup soup_of(const SurfaceMesh& mesh) { return {mesh.positions, mesh.triangles}; }

Picture draw(const SurfaceMesh& mesh, const Point& direction) {
  Surface surface;
  Marks marks;
  for (const glm::dvec3& p : mesh.positions) surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
  surface.triangles = mesh.triangles;
  // colours are by vertex, so polygons that are no quads are a layer of their own
  Surface odd;
  odd.positions = surface.positions;
  FaceTriangles cut;
  size_t first = 0;
  for (const uint32_t size : mesh.face_sizes) {
    const uint32_t* c = &mesh.face_vertices[first];
    Polyline outline;
    outline.width = 1.0;
    for (uint32_t k = 0; k <= size; ++k) {
      const glm::dvec3& p = mesh.positions[c[k % size]];
      outline.points.push_back({p.x, p.y, p.z});
    }
    marks.lines.push_back(outline);
    if (size != 4) cut.append(mesh.positions, c, size, odd.triangles);
    first += size;
  }
  View view;
  view.width = view.height = 720;
  view.direction = direction;
  SurfaceLook look;
  look.flat = true;
  std::vector<Layer> layers{{surface, look, marks}};
  if (!odd.triangles.empty()) {
    look.color = {0.88, 0.35, 0.30};
    layers.push_back({odd, look, {}});
  }
  return render(layers, view);
}

double percent(uint32_t part, uint32_t whole) { return whole ? 100.0 * part / whole : 0.0; }

void print_figures(const SurfaceMesh& input, double diagonal, const SurfaceMesh& mesh, const QuadReport& report,
                   int euler_characteristic) {
  const SurfaceDistance distance = surface_distance(soup_of(input), soup_of(mesh));
  std::printf("validity    Euler characteristic %d (surface %d), directed edges once: %s, repeated corners: %s\n",
              report.euler_characteristic, euler_characteristic, report.each_directed_edge_once ? "yes" : "NO",
              report.no_repeated_corner ? "none" : "SOME");
  std::printf("quads       %.2f %% of the faces\n", percent(report.quads, report.faces));
  std::printf("valence     %s\n", to_text(report.valences).c_str());
  std::printf("irregular   %.2f %%\n", percent(report.irregular, report.vertices));
  std::printf("turned over %u corners\n", report.turned_over);
  const std::optional<uint32_t> crossing = count_crossing_faces(mesh), before = count_crossing_faces(input);
  if (crossing && before) {
    std::printf("crossing    %u faces run through others (%u of the surface)\n", *crossing, *before);
  } else {
    std::printf("crossing    not counted, too many long triangles lie side by side\n");
  }
  std::printf("edge/L      5 %%: %.2f, median %.2f, 95 %%: %.2f\n", report.edge[0], report.edge[1], report.edge[2]);
  std::printf("aspect      median %.2f, 95 %%: %.2f\n", report.aspect[1], report.aspect[2]);
  std::printf("angle off   median %.1f, 95 %%: %.1f degrees\n", report.angle[1], report.angle[2]);
  if (distance.measured) {
    std::printf("Hausdorff   %.3f %% of the box (mesh to quads %.3f %%, mean %.3f %%; quads to mesh %.3f %%)\n",
                100 * distance.largest() / diagonal, 100 * distance.a_to_b / diagonal,
                100 * distance.mean_a_to_b / diagonal, 100 * distance.b_to_a / diagonal);
  } else {
    std::printf("Hausdorff   not measured, too many long triangles lie side by side\n");
  }
}

// Creases that the edge length cannot carry, such as two that run nearer than an edge, are released. They are named
// here.
void print_creases(const CreaseReport& creases) {
  std::printf("creases     %u of %u edges are edges of quads\n", creases.edges - creases.released, creases.edges);
  if (creases.released == 0) return;
  std::printf(
      "            %u are released: the quads are too large for them; the farthest is %.2f edges away at "
      "%.4g %.4g %.4g\n",
      creases.released, creases.farthest, creases.place.x, creases.place.y, creases.place.z);
}

void draw_sheet(const Command& options, const SurfaceMesh& mesh, const std::string& title) {
  if (options.sheet.empty()) return;
  write_png(options.sheet,
            contact_sheet({draw(mesh, {1, 0.4, 0.6}), draw(mesh, {-0.6, 0.4, -1})}, 2, {title, "from behind"}));
  std::printf("wrote       %s\n", options.sheet.c_str());
}

// The figures of quads that another program made. L is the square root of a face's mean area.
void measure(const Command& options, const SurfaceMesh& input, double diagonal) {
  SurfaceMesh mesh = read_mesh_file(options.measured);
  if (mesh.face_sizes.empty()) {
    mesh.face_sizes.assign(mesh.triangles.size() / 3, 3);
    mesh.face_vertices = mesh.triangles;
  }
  FaceTriangles cut;
  size_t first = 0;
  mesh.triangles.clear();
  for (const uint32_t size : mesh.face_sizes) {
    append_measured(cut, mesh.positions, &mesh.face_vertices[first], size, mesh.triangles);
    first += size;
  }
  double area = 0;
  for (size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const glm::dvec3& a = mesh.positions[mesh.triangles[i]];
    area += 0.5 * length(cross(mesh.positions[mesh.triangles[i + 1]] - a, mesh.positions[mesh.triangles[i + 2]] - a));
  }
  const double faces = std::max(1.0, static_cast<double>(mesh.face_count()));
  const QuadReport report = measure_quads(mesh, std::sqrt(area / faces));
  SurfaceMesh triangles = input;
  triangles.face_sizes.assign(input.triangles.size() / 3, 3);
  triangles.face_vertices = input.triangles;
  std::printf("quads       %u vertices, %u faces; %s\n", report.vertices, report.faces,
              options.measured.filename().string().c_str());
  print_figures(input, diagonal, mesh, report, measure_quads(triangles, 1).euler_characteristic);
  draw_sheet(options, mesh, options.mesh.filename().string() + ", " + options.measured.filename().string());
}

bool is_gltf(const std::filesystem::path& file) {
  const std::string extension = ending_of(file);
  return extension == ".glb" || extension == ".gltf";
}

// Writes the quads: as polygons, or in a glTF model in the place of its surface.
void write(const Command& options, const std::optional<Model>& model, const SurfaceMesh& input, const SurfaceMesh& mesh,
           const hf::QuadsMesh& quads) {
  if (!is_gltf(options.out)) return write_mesh_file(mesh, options.out);
  const Model source = model ? *model : make_model(options.mesh.stem().string(), input.positions, input.triangles);
  const Model out = quad_model(source, flatten(source), mesh, {quads.triangles, quads.barycentrics});
  for (size_t i = source.warnings.size(); i < out.warnings.size(); ++i)
    std::printf("warning     %s\n", out.warnings[i].c_str());
  write_gltf(out, options.out);
}

void run(const Command& options) {
  std::optional<Model> model;  // only if its motion and look are asked for
  if (is_model(kind_of_file(options.mesh)) && is_gltf(options.out)) model = read_gltf(options.mesh);
  const SurfaceMesh input = model ? to_surface_mesh(flatten(*model)) : read_mesh_file(options.mesh);
  const std::vector<double> positions = double_positions(input.positions);
  auto create = hf::make<hf_surface_desc>();
  create.positions = HF_ARRAY(positions.data(), input.positions.size());
  create.triangles = HF_ARRAY(input.triangles.data(), input.triangles.size() / 3);
  const double wanted = wanted_faces(options, input);
  const bool paid = wanted > 0 && wanted <= (options.faces > 0 ? most_faces : most_by_edge);
  limit_quads(create, paid ? static_cast<uint32_t>(wanted) : 0);
  const hf::Surface surface(create);
  const double diagonal = surface.report().bounding_box_diagonal;
  std::printf("mesh        %u vertices, %u triangles, box diagonal %.6g\n", create.positions.count,
              create.triangles.count, diagonal);
  if (!options.measured.empty()) return measure(options, input, diagonal);

  auto desc = hf::make<hf_quads_desc>();
  desc.face_count = options.faces;
  desc.crease_angle = glm::radians(static_cast<double>(options.crease));
  desc.relax_count = options.relax ? options.relax : HF_NO_INDEX;
  desc.edge_length = options.edge < 0 ? -options.edge * diagonal : options.edge;
  Guides guides;
  if (!options.strokes.empty()) guides = read_strokes(options.strokes, surface, mean_edge(input));
  desc.guide_count = static_cast<uint32_t>(guides.vertices.size());
  if (desc.guide_count) {
    desc.guide_vertices = guides.vertices.data();
    desc.guide_vectors = guides.vectors.data();
    desc.guide_weights = guides.weights.data();
  }
  IrregularVertices irregular;
  if (!options.irregular.empty()) irregular = read_irregular(options.irregular);
  desc.irregular_count = static_cast<uint32_t>(irregular.valences.size());
  if (desc.irregular_count) {
    desc.irregular_points = irregular.points.data();
    desc.irregular_valences = irregular.valences.data();
    desc.irregular_directions = irregular.directions.data();
  }
  std::copy(options.plane, options.plane + 4, desc.symmetry_plane);

  const auto begin = std::chrono::steady_clock::now();
  const hf::Quads made(surface, desc);
  const hf::QuadsMesh quads = made.mesh();
  const hf_quads_info info = made.info();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  SurfaceMesh mesh;
  mesh.positions = to_points(quads.positions);
  FaceTriangles cut;
  for (size_t i = 0; i < quads.faces.size(); i += 4)
    append_measured(cut, mesh.positions, &quads.faces[i], 4, mesh.triangles);
  mesh.face_sizes.assign(info.face_count, 4);
  mesh.face_vertices = quads.faces;

  const QuadReport report = measure_quads(mesh, info.edge_length);
  const bool valid = report.each_directed_edge_once && report.no_repeated_corner &&
                     report.euler_characteristic == info.euler_characteristic;
  std::printf("quads       %u vertices, %u faces in %.2f s; edge length %.6g (%.2f %% of the box)\n", report.vertices,
              report.faces, seconds, info.edge_length, 100 * info.edge_length / diagonal);
  print_figures(input, diagonal, mesh, report, info.euler_characteristic);
  if (options.edge != 0 && report.faces < too_few * wanted)
    std::printf(
        "warning     %u faces, but the edge length gives about %.0f: corners of the border are too sharp, or parts "
        "too thin\n",
        report.faces, wanted);
  if (options.faces > 0 && std::abs(report.faces - double(options.faces)) > missed_count * options.faces)
    std::printf(
        "warning     %u faces where %u are asked for: parts, creases or corners need more or fewer; try another "
        "count or --edge\n",
        report.faces, options.faces);
  if (options.crease > 0) print_creases(measure_creases(input, options.crease, mesh, info.edge_length));
  if (!options.out.empty()) {
    write(options, model, input, mesh, quads);
    std::printf("wrote       %s\n", options.out.c_str());
  }
  draw_sheet(options, mesh, options.mesh.filename().string());
  if (!valid)
    throw std::runtime_error(
        "the result is no valid mesh, see validity above: a fault of the library, please report it");
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_quads", samples::usage, count, arguments, samples::parse, samples::run);
}
