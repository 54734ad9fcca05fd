// Compares hashes of fields, poses, transfers, directions, quads and retargets with golden.txt, on 1 to 8 threads and
// on each kind of processor. All systems, build types and compilers share the hashes. Usage: reliability_golden
// [--full | --quick] (1 and 3 threads alone, for emulators) | --print (the lines of golden.txt)
//
// The program holds the static library, because it hides features of an x86 processor from the library's dispatch.
// __builtin_cpu_supports reads them from __cpu_model of libgcc or compiler-rt. Other processors have one kind. The
// whole API is compared between the processors of one machine, since its scene is made with the sines of the C library.
#include <cinttypes>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "base/elementary.h"
#include "golden_retarget.h"
#include "report.h"
#include "support/arrays.h"
#include "surfaces.h"
#include "whole_api.h"

#if defined(__x86_64__) && defined(__GNUC__)
#if defined(_WIN32)
#define HIDDEN
#else
#define HIDDEN __attribute__((visibility("hidden")))
#endif
extern "C" {
extern struct { unsigned int vendor, type, subtype, features[1]; } __cpu_model HIDDEN;
}
namespace {
unsigned processor_features() {
  __builtin_cpu_init();
  return __cpu_model.features[0];
}
void set_processor_features(unsigned features) { __cpu_model.features[0] = features; }
}  // namespace
#else
namespace {
unsigned processor_features() { return 0; }
void set_processor_features(unsigned) {}
}  // namespace
#endif

using namespace reliability;

namespace {

// A kind of processor as the library sees it. It needs the features `needs`; those in `hidden` are hidden.
struct Processor {
  const char* name;
  unsigned needs, hidden;
  const char* kind;  // processors of one kind give the same bits
};
#if defined(__x86_64__) && defined(__GNUC__)
constexpr unsigned avx2 = 1u << 10, fma = 1u << 14, avx512f = 1u << 15;

constexpr Processor processors[] = {{"avx512", avx512f | avx2 | fma, 0, "fma"},
                                    {"avx2", avx2 | fma, avx512f, "fma"},
                                    {"avx2 without fma", avx2, avx512f | fma, "plain"},
                                    {"plain", 0, avx512f | avx2 | fma, "plain"}};
#elif defined(__aarch64__) || defined(_M_ARM64)
constexpr Processor processors[] = {{"neon", 0, 0, "fma"}};
#else
constexpr Processor processors[] = {{"plain", 0, 0, "plain"}};
#endif

struct Hash {
  std::uint64_t value = 14695981039346656037u;
  template <class T>
  void take(const T* values, std::size_t count) {  // FNV-1a
    // the bytes of a number from the lowest to the highest, on a big-endian machine too
    const std::uint32_t one = 1;
    const std::size_t flip = *reinterpret_cast<const unsigned char*>(&one) == 1 ? 0 : sizeof(T) - 1;
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(T); ++i) value = (value ^ bytes[i ^ flip]) * 1099511628211u;
  }
};

// The bumpy walls of a square tower. Coordinates are multiples of 1/64, so every machine makes the same mesh. bumps:
// how many of them a vertex is moved at most.
Mesh make_sheet(std::uint32_t nu, std::uint32_t nv, std::uint32_t bumps = 40) {
  Mesh sheet;
  std::uint32_t state = 12345;
  const auto random = [&] { return state = state * 1664525u + 1013904223u, state >> 24; };  // 0 to 255
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      // around the tower's four walls
      const std::uint32_t side = 4 * i / nu, along = i - side * nu / 4;
      const float s = static_cast<float>(along), w = static_cast<float>(nu / 4);
      const float x = side == 0   ? s
                      : side == 1 ? w
                      : side == 2 ? w - s
                                  : 0,
                  y = side == 0   ? 0
                      : side == 1 ? s
                      : side == 2 ? w
                                  : w - s;
      const auto jitter = [&] { return static_cast<float>(random() % bumps) / 64; };
      const float dx = jitter(), dy = jitter(), dz = jitter();
      sheet.positions.insert(sheet.positions.end(), {x + dx, y + dy, static_cast<float>(j) + dz});
    }
  }
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j + 1 < nv; ++j) {
      const std::uint32_t a = i * nv + j, b = (i + 1) % nu * nv + j, c = b + 1, d = a + 1;
      if ((i + j) % 2)
        sheet.triangles.insert(sheet.triangles.end(), {a, b, c, a, c, d});
      else
        sheet.triangles.insert(sheet.triangles.end(), {a, b, d, b, c, d});
    }
  }
  return sheet;
}

class Stages {
 public:
  Stages(const Mesh& mesh, std::uint32_t threads) : mesh_(mesh), n_(mesh.vertex_count()) {
    doubles_.resize(2 * std::size_t{n_});
    floats_.resize(doubles_.size());
    base_ = surface_desc(mesh);
    base_.thread_count = threads;
  }

  // Adds sites of every kind, edits them, rebases and changes a value.
  void field(Hash& hash) {
    hf_solver_desc d = desc<hf_solver_desc>();
    d.channel_count = 2;
    const hf_solver solver = make_solver(base_, d);
    std::uint32_t sites[40];
    add(solver, 12, 977, 5, sites);
    take(solver, hash);
    const double stiffness[3] = {0.5, 10, 0}, radii[2] = {1.5, 2.25};
    hf_sites_desc more = places(3, 1511, 99);
    more.stiffness = stiffness;
    must(hf_add_sites(solver, &more, sites + 12), "hf_add_sites, soft");
    more = places(2, 4003, 1264);
    more.radii = radii;
    must(hf_add_sites(solver, &more, sites + 15), "hf_add_sites, discs");
    take(solver, hash);
    must(hf_remove_sites(solver, 4, sites + 3), "hf_remove_sites");
    more = places(2, 613, 17);
    more.values = nullptr;
    must(hf_solver_move_sites(solver, 2, sites, &more), "hf_solver_move_sites");
    take(solver, hash);
    add(solver, 120, 83, 41, nullptr);
    must(hf_remove_sites(solver, 1, sites + 9), "hf_remove_sites, by rotations");
    take(solver, hash);
    must(hf_solver_prepare_rebase(solver), "hf_solver_prepare_rebase");
    must(hf_solver_set_values(solver, 1, sites + 8, values_.data() + 7), "hf_solver_set_values");
    take(solver, hash);
    must(hf_solve(solver, floats_.data(), 0, nullptr), "hf_solve");
    hash.take(floats_.data(), floats_.size());
    must(hf_solver_solve_preview(solver, OUT(floats_.data()), 0, nullptr), "hf_solver_solve_preview");
    hash.take(floats_.data(), floats_.size());
    hf_solver_destroy(solver);
  }

  // Solves with every operator and kind of field, with minimum degree and the baseline refactor among them.
  void operators(Hash& hash) {
    for (const int kind : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH}) {
      for (const int op :
           {HF_OPERATOR_INTRINSIC_DELAUNAY, HF_OPERATOR_CLAMPED, HF_OPERATOR_UNIFORM, HF_OPERATOR_COTANGENT}) {
        hf_surface_desc d = base_;
        d.field_kind = kind;
        d.operator_kind = op;
        if (op == HF_OPERATOR_CLAMPED) d.ordering = HF_ORDERING_MINIMUM_DEGREE;
        const hf_solver solver =
            make_solver(d, desc<hf_solver_desc>(), op == HF_OPERATOR_UNIFORM ? ENGINE_REFACTOR : ENGINE_GREEN);
        add(solver, 9, 701, 3, nullptr);
        must(hf_solver_solve(solver, OUT(doubles_.data()), nullptr), "hf_solver_solve");
        hash.take(doubles_.data(), n_);
        hf_solver_destroy(solver);
      }
    }
  }

  // Finds critical points of a field, and geodesic distances.
  void analysis(Hash& hash) {
    const hf_surface surface = make_surface(base_);
    const hf_solver solver = make_solver(surface);
    add(solver, 7, 811, 29, nullptr);
    must(hf_solver_solve(solver, OUT(doubles_.data()), nullptr), "hf_solver_solve");
    const hf_array scalars = HF_ARRAY(doubles_.data(), n_);
    std::vector<hf_critical_point> points(n_);
    hf_critical_info info = desc<hf_critical_info>();
    must(hf_surface_find_critical_points(surface, &scalars, n_, points.data(), &info),
         "hf_surface_find_critical_points");
    for (std::uint32_t i = 0; i < info.point_count; ++i) {
      hash.take(&points[i].vertex, 1);
      hash.take(&points[i].kind, 1);
    }
    for (const std::int32_t method : {HF_GEODESICS_HEAT, HF_GEODESICS_FRONT, HF_GEODESICS_EXACT}) {
      hf_geodesics_desc options = desc<hf_geodesics_desc>();
      options.method = method;
      hf_geodesics geodesics = nullptr;
      must(hf_geodesics_create(surface, &options, &geodesics), "hf_geodesics_create");
      const std::uint32_t sources[2] = {3, 2000};
      must(hf_geodesics_solve(geodesics, 2, sources, OUT(doubles_.data())), "hf_geodesics_solve");
      hash.take(doubles_.data(), n_);
      hf_geodesics_destroy(geodesics);
    }
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }

  // Poses the tower by its two ends, in both modes. rings: vertices of a column.
  void poses(Hash& hash, std::uint32_t rings) {
    const hf_surface surface = make_surface(base_);
    const std::vector<std::uint32_t> ends = both_ends(rings);
    for (int mode = 0; mode < 2; ++mode) {
      hf_pose pose = nullptr;
      must(create_pose_with(mode, surface, nullptr, &pose), "hf_pose_create");
      const auto half = static_cast<std::uint32_t>(ends.size() / 2);
      const std::uint32_t counts[2] = {half, half};
      hf_handles_desc regions = desc<hf_handles_desc>();
      regions.handle_count = 2;
      regions.region_counts = counts;
      regions.region_vertices = ends.data();
      std::uint32_t handles[2];
      must(hf_pose_add_handles(pose, &regions, handles), "hf_pose_add_handles");
      std::vector<float> normals(3 * std::size_t{n_});
      floats_.resize(normals.size());
      hf_deform_desc deform = desc<hf_deform_desc>();
      deform.positions = ROWS_OUT(floats_.data());
      deform.normals = ROWS_OUT(normals.data());
      deform.refine = mode == POSE_SMOOTH;
      for (int frame = 1; frame <= 6; ++frame) {  // the turns (1 - t^2, 2 t) / (1 + t^2) need no sine
        const double t = 0.125 * frame, unit = 1 + t * t;
        const hf_transform turned = {{0, 2 * t / unit, 0, (1 - t * t) / unit}, {2 * t, 0.5, -t}};
        must(hf_pose_set_transforms(pose, 1, &handles[1], &turned), "hf_pose_set_transforms");
        must(hf_pose_deform(pose, &deform, nullptr), "hf_pose_deform");
        hash.take(floats_.data(), floats_.size());
        hash.take(normals.data(), normals.size());
      }
      hf_pose_destroy(pose);
    }
    hf_surface_destroy(surface);
  }

  // Plays a bending tower on itself, in both modes.
  void transfers(Hash& hash, std::uint32_t rings) {
    const hf_surface surface = make_surface(base_);
    const std::vector<std::uint32_t> ends = both_ends(rings);
    std::vector<float> posed(3 * std::size_t{n_}), out(posed.size());
    for (int mode = 0; mode < 2; ++mode) {
      hf_transfer transfer = nullptr;
      must(create_transfer_with(mode, surface, surface, nullptr, &transfer), "hf_transfer_create");
      const auto half = static_cast<std::uint32_t>(ends.size() / 2);
      const std::uint32_t counts[2] = {half, half};
      hf_pairs_desc pairs = desc<hf_pairs_desc>();
      pairs.pair_count = 2;
      pairs.source_counts = pairs.target_counts = counts;
      pairs.source_vertices = pairs.target_vertices = ends.data();
      must(hf_transfer_add_pairs(transfer, &pairs, nullptr), "hf_transfer_add_pairs");
      for (int frame = 1; frame <= 6; ++frame) {
        for (std::size_t v = 0; v < n_; ++v) {
          const float* p = &mesh_.positions[3 * v];
          posed[3 * v] = p[0] + static_cast<float>(frame) * p[2] * p[2] / 1024;
          posed[3 * v + 1] = p[1] - static_cast<float>(frame) / 8;
          posed[3 * v + 2] = p[2];
        }
        hf_transfer_frame played = desc<hf_transfer_frame>();
        played.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
        played.target_positions = ROWS_OUT(out.data());
        must(hf_transfer_apply(transfer, &played), "hf_transfer_apply");
        hash.take(out.data(), out.size());
      }
      hf_transfer_destroy(transfer);
    }
    hf_surface_destroy(surface);
  }

  void directions(Hash& hash) {
    const hf_surface surface = make_surface(base_);
    for (const std::int32_t degree : {1, 4}) {
      hf_direction_desc wanted = desc<hf_direction_desc>();
      wanted.degree = degree;
      hf_direction direction = nullptr;
      must(hf_direction_create(surface, &wanted, &direction), "hf_direction_create");
      const std::uint32_t vertices[4] = {20, 900, 1500, 2500};
      const double vectors[12] = {1, 0.5, 0.25, -0.5, 1, 0, 0, 0.125, 1, 0.5, 0.5, -1}, angle = 0.75;
      std::uint32_t sites[4];
      must(hf_direction_add_sites(direction, 4, vertices, vectors, sites), "hf_direction_add_sites");
      must(hf_direction_rotate_sites(direction, 1, sites, &angle), "hf_direction_rotate_sites");
      doubles_.resize(3 * std::size_t{n_});
      must(hf_direction_solve(direction, OUT(doubles_.data()), nullptr), "hf_direction_solve");
      hash.take(doubles_.data(), doubles_.size());
      hf_direction_destroy(direction);
    }
    hf_surface_destroy(surface);
  }

  void quads(Hash& hash) {
    const hf_surface surface = make_surface(base_);
    hf_quads_desc wanted = desc<hf_quads_desc>();
    wanted.edge_length = 3;
    hf_quads quads = nullptr;
    must(hf_quads_create(surface, &wanted, &quads), "hf_quads_create");
    hf_quads_info info = desc<hf_quads_info>();
    must(hf_quads_get_info(quads, &info), "hf_quads_get_info");
    std::vector<double> positions(3 * std::size_t{info.vertex_count});
    std::vector<std::uint32_t> corners(4 * std::size_t{info.face_count});
    hf_quads_mesh made = desc<hf_quads_mesh>();
    made.vertex_capacity = info.vertex_count;
    made.face_capacity = info.face_count;
    made.positions = positions.data();
    made.faces = corners.data();
    must(hf_quads_get_mesh(quads, &made), "hf_quads_get_mesh");
    hash.take(positions.data(), positions.size());
    hash.take(corners.data(), corners.size());
    hf_quads_destroy(quads);
    hf_surface_destroy(surface);
  }

 private:
  // The two lowest rings of the tower, then the two highest.
  std::vector<std::uint32_t> both_ends(std::uint32_t rings) const {
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t ring : {0u, rings - 2}) {
      for (std::uint32_t v = ring; v < n_; v += rings) ends.insert(ends.end(), {v, v + 1});
    }
    return ends;
  }
  hf_sites_desc places(std::uint32_t count, std::uint32_t step, std::uint32_t first) {
    vertices_.clear();
    values_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      vertices_.push_back((first + i * step) % n_);
      values_.push_back(0.125 * (i * 37 % 101));
      values_.push_back(0.25 * (i * 53 % 89));
    }
    hf_sites_desc d = desc<hf_sites_desc>();
    d.site_count = count;
    d.vertices = vertices_.data();
    d.values = values_.data();
    return d;
  }
  void add(hf_solver solver, std::uint32_t count, std::uint32_t step, std::uint32_t first, std::uint32_t* sites) {
    const hf_sites_desc d = places(count, step, first);
    must(hf_add_sites(solver, &d, sites), "hf_add_sites");
  }
  void take(hf_solver solver, Hash& hash) {
    must(hf_solver_solve(solver, OUT(doubles_.data()), nullptr), "hf_solver_solve");
    hash.take(doubles_.data(), doubles_.size());
  }

  const Mesh& mesh_;
  std::uint32_t n_;
  hf_surface_desc base_;
  std::vector<double> doubles_, values_;
  std::vector<float> floats_;
  std::vector<std::uint32_t> vertices_;
};

// Hashes the functions of elementary.h at many points.
void functions(Hash& hash) {
  for (int i = -20000; i < 20000; ++i) {
    const double x = 0.0009765625 * i, y = 0.125 * (i % 101);
    const double values[6] = {hf_inner::sine(37 * x),      hf_inner::cosine(37 * x),
                              hf_inner::arc_tangent(x, y), hf_inner::arc_cosine(i / 20000.0),
                              hf_inner::exponential(x),    hf_inner::logarithm(x * x + 0.0009765625)};
    hash.take(values, 6);
  }
}

// The right hash of each stage and kind of processor, and how many hashes differ from it.
struct Hashes {
  std::map<std::string, std::uint64_t> right;
  unsigned compared = 0, different = 0;
  void compare(const std::string& name, const std::string& run, std::uint64_t hash) {
    const std::uint64_t expected = right.emplace(name, hash).first->second;
    ++compared;
    different += hash != expected;
    if (hash != expected)
      fprintf(stderr, "%s, %s: %016" PRIx64 ", not %016" PRIx64 "\n", name.c_str(), run.c_str(), hash, expected);
  }
};

Hashes read_golden() {
  Hashes golden;
  std::ifstream text(HF_SOURCE_DIR "/tests/reliability/golden.txt");
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string stage, kind;
    std::uint64_t hash = 0;
    if (line.empty() || line[0] == '#' || !(words >> stage >> kind >> std::hex >> hash)) continue;
    golden.right[stage + " " + kind] = hash;
  }
  return golden;
}

}  // namespace

int main(int argc, char** argv) {
  const bool print = argc > 1 && std::strcmp(argv[1], "--print") == 0,
             quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0, full = report_full(argc, argv);
  constexpr std::uint32_t small_rings = 50;
  const Mesh sheet = make_sheet(120, 100), small = make_sheet(60, small_rings),
             smooth = make_sheet(60, small_rings, 12);
  const Scene scene = make_scene();
  Hashes golden = print ? Hashes() : read_golden(), library;
  const std::size_t listed = golden.right.size();
  unsigned seen = 0, unexpected = 0;
  const unsigned features = processor_features();
  for (const Processor& processor : processors) {
    if ((features & processor.needs) != processor.needs) {
      fprintf(stderr, "%s: not on this machine\n", processor.name);
      continue;
    }
    set_processor_features(features & ~processor.hidden);
    ++seen;
    for (std::uint32_t threads = 1; threads <= 8; ++threads) {
      if ((seen > 1 || quick) && !full && threads != 1 && threads != 3) continue;
      const std::string kind = std::string(" ") + processor.kind,
                        run = std::string(processor.name) + ", " + std::to_string(threads) + " threads";
      Hash field, operators, analysis, poses, transfers, directions, quads, elementary, retargets;
      Stages stages(sheet, threads), small_stages(small, threads), smooth_stages(smooth, threads);
      stages.field(field);
      golden.compare("field" + kind, run, field.value);
      small_stages.operators(operators);
      golden.compare("operators" + kind, run, operators.value);
      stages.analysis(analysis);
      golden.compare("analysis" + kind, run, analysis.value);
      smooth_stages.poses(poses, small_rings);
      golden.compare("poses" + kind, run, poses.value);
      smooth_stages.transfers(transfers, small_rings);
      golden.compare("transfers" + kind, run, transfers.value);
      smooth_stages.directions(directions);
      golden.compare("directions" + kind, run, directions.value);
      smooth_stages.quads(quads);
      golden.compare("quads" + kind, run, quads.value);
      functions(elementary);
      golden.compare("functions" + kind, run, elementary.value);
      const std::vector<float> retargeted = retargeted_poses();
      retargets.take(retargeted.data(), retargeted.size());
      golden.compare("retargets" + kind, run, retargets.value);
      Options options;
      options.threads = threads;
      options.paper_engine = false;
      const Outcome outcome = run_whole_api(scene, options);
      unexpected += outcome.unexpected;
      library.compare("whole api" + kind, run, outcome.hash);
    }
  }
  set_processor_features(features);
  if (print) {
    for (const auto& stage : golden.right) printf("%s %016" PRIx64 "\n", stage.first.c_str(), stage.second);
    return golden.different > 0;
  }
  if (golden.right.size() != listed) fprintf(stderr, "stages that golden.txt does not name\n");
  report_at_least("GOLDEN_STAGES_LISTED", static_cast<double>(listed), 18);
  report_at_least("GOLDEN_HASHES_COMPARED", golden.compared, 18 * seen + (quick ? 0 : 54));
  report_at_most("GOLDEN_HASHES_THAT_DIFFER", golden.different + golden.right.size() - listed, 0);
  report_at_most("GOLDEN_PROCESSORS_OF_A_KIND_THAT_DIFFER", library.different, 0);
  report_at_most("GOLDEN_UNEXPECTED_ANSWERS", unexpected, 0);
  return report_status();
}
