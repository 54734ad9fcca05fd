// hf_field: the harmonic field of a mesh file under an edit script. See README.md beside this file, or --help.
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>

#include "field/field_options.h"
#include "field/field_output.h"
#include "hf/hf.h"

namespace samples {
namespace {

void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_get_error_detail(&detail);
  throw std::runtime_error(std::string(detail.function) + ": " + detail.message + " (" + hf_result_name(result) + ")");
}

class Clock {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Places of a list, as the library takes them.
struct Batch {
  explicit Batch(const std::vector<SiteArgument>& sites, bool with_values) {
    HF_INIT(desc);
    desc.site_count = static_cast<uint32_t>(sites.size());
    const bool points = !sites.empty() && !sites[0].place.is_vertex();
    bool soft = false;
    for (const SiteArgument& site : sites) {
      if (site.place.is_vertex() == points)
        throw std::runtime_error("vertices and points in triangles are mixed in one edit; write two");
      vertices.push_back(points ? site.place.triangle : site.place.vertex);
      barycentrics.insert(barycentrics.end(), site.place.weights.begin(), site.place.weights.end());
      values.push_back(site.value), stiffness.push_back(site.stiffness);
      soft = soft || site.stiffness > 0;
    }
    (points ? desc.triangles : desc.vertices) = vertices.data();
    if (points) desc.barycentrics = barycentrics.data();
    if (with_values) desc.values = values.data();
    if (with_values && soft) desc.stiffness = stiffness.data();
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  hf_sites_desc desc;
  std::vector<uint32_t> vertices;
  std::vector<double> barycentrics, values, stiffness;
};

// The solver and the numbers of its sites by place.
class Session {
 public:
  Session(const SurfaceMesh& mesh, const FieldOptions& options)
      : vertex_count_(static_cast<uint32_t>(mesh.positions.size())) {
    hf_create_desc desc;
    HF_INIT(desc);
    desc.vertex_count = vertex_count_;
    desc.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
    desc.positions_f64 = mesh.positions.empty() ? nullptr : &mesh.positions[0].x;
    desc.triangles = mesh.triangles.data();
    desc.engine = options.engine, desc.operator_kind = options.operator_kind, desc.weld = options.weld;
    desc.thread_count = options.threads;
    check(hf_create(&desc, &solver_));
  }
  ~Session() { hf_destroy(solver_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  hf_solver solver() const { return solver_; }

  void apply(const Edit& edit) {
    if (edit.kind == Edit::Kind::undo || edit.kind == Edit::Kind::redo) {
      const bool undo = edit.kind == Edit::Kind::undo;
      check(undo ? hf_undo(solver_) : hf_redo(solver_));
      auto &from = undo ? undone_from_ : redone_from_, &to = undo ? redone_from_ : undone_from_;
      to.push_back(sites_);
      sites_ = from.back();
      from.pop_back();
      return;
    }
    check(hf_record(solver_));
    const auto before = sites_;
    try {
      change(edit);
    } catch (...) {
      hf_undo(solver_);  // forgets the record; the failed edit has changed nothing
      throw;
    }
    undone_from_.push_back(before);
    redone_from_.clear();
  }

  std::vector<double> solve(hf_solve_info& info) const {
    std::vector<double> field(vertex_count_);
    HF_INIT(info);
    check(hf_solve_f64(solver_, field.data(), 0, &info));
    return field;
  }
  // Places of all sites, for pictures.
  std::vector<glm::dvec3> positions(const SurfaceMesh& mesh) const {
    std::vector<glm::dvec3> points;
    for (const auto& [place, number] : sites_) {
      (void)number;
      if (place.triangle == no_triangle) {
        points.push_back(mesh.positions[place.vertex]);
      } else {
        glm::dvec3 p(0);
        for (size_t k = 0; k < 3; ++k)
          p += place.weights[k] * mesh.positions[mesh.triangles[3 * size_t(place.triangle) + k]];
        points.push_back(p);
      }
    }
    return points;
  }

 private:
  static constexpr uint32_t no_triangle = 0xFFFFFFFFu;
  struct Order {
    bool operator()(const Place& a, const Place& b) const {
      return std::tie(a.triangle, a.vertex, a.weights) < std::tie(b.triangle, b.vertex, b.weights);
    }
  };
  using Numbers = std::map<Place, uint32_t, Order>;

  uint32_t number(const Place& place) const {
    const auto found = sites_.find(place);
    if (found == sites_.end())
      throw std::runtime_error("there is no site at " +
                               std::string(place.is_vertex()
                                               ? "vertex " + std::to_string(place.vertex)
                                               : "that point of triangle " + std::to_string(place.triangle)));
    return found->second;
  }

  void change(const Edit& edit) {
    std::vector<uint32_t> numbers;
    switch (edit.kind) {
      case Edit::Kind::add: {
        const Batch batch(edit.sites, true);
        numbers.resize(edit.sites.size());
        check(hf_add_sites(solver_, &batch.desc, numbers.data()));
        for (size_t i = 0; i < numbers.size(); ++i) sites_[edit.sites[i].place] = numbers[i];
        break;
      }
      case Edit::Kind::remove:
        for (const SiteArgument& site : edit.sites) numbers.push_back(number(site.place));
        check(hf_remove_sites(solver_, static_cast<uint32_t>(numbers.size()), numbers.data()));
        for (const SiteArgument& site : edit.sites) sites_.erase(site.place);
        break;
      case Edit::Kind::move: {
        std::vector<SiteArgument> to;
        for (size_t i = 0; i < edit.sites.size(); i += 2)
          numbers.push_back(number(edit.sites[i].place)), to.push_back(edit.sites[i + 1]);
        const Batch batch(to, false);
        check(hf_move_sites(solver_, static_cast<uint32_t>(numbers.size()), numbers.data(), &batch.desc));
        for (size_t i = 0; i < edit.sites.size(); i += 2) sites_.erase(edit.sites[i].place);
        for (size_t i = 0; i < to.size(); ++i) sites_[to[i].place] = numbers[i];
        break;
      }
      case Edit::Kind::set: {
        std::vector<double> values;
        for (const SiteArgument& site : edit.sites) numbers.push_back(number(site.place)), values.push_back(site.value);
        check(hf_set_site_values(solver_, static_cast<uint32_t>(numbers.size()), numbers.data(), values.data()));
        break;
      }
      case Edit::Kind::undo:
      case Edit::Kind::redo:
        break;
    }
  }

  hf_solver solver_ = nullptr;
  uint32_t vertex_count_;
  Numbers sites_;
  std::vector<Numbers> undone_from_, redone_from_;
};

void describe(hf_solver solver, double create_ms) {
  hf_mesh_report report;
  HF_INIT(report);
  check(hf_get_mesh_report(solver, &report));
  hf_statistics statistics;
  HF_INIT(statistics);
  check(hf_get_statistics(solver, &statistics));
  std::printf("mesh        %u vertices (%u welded), %u triangles, %u components\n", report.vertex_count,
              report.welded_vertex_count, report.triangle_count, report.component_count);
  const struct {
    uint32_t count;
    const char* name;
  } dirt[] = {{report.isolated_vertex_count, "isolated vertices"},
              {report.degenerate_triangle_count, "zero-area triangles"},
              {report.collapsed_triangle_count, "collapsed triangles"},
              {report.duplicate_triangle_count, "duplicate triangles"},
              {report.non_manifold_edge_count, "non-manifold edges"},
              {report.flipped_edge_count, "flipped edges"},
              {report.boundary_edge_count, "boundary edges"},
              {report.negative_edge_count, "edges of negative weight"}};
  for (const auto& entry : dirt) {
    if (entry.count) std::printf("            %u %s\n", entry.count, entry.name);
  }
  std::printf("create      %.1f ms (ordering %.1f, symbolic %.1f, factorisation %.1f; factor %.1f MB)\n", create_ms,
              statistics.ordering_ms, statistics.symbolic_ms, statistics.numeric_ms, statistics.factor_bytes / 1e6);
}

int run(int argc, char** argv) {
  const FieldOptions options = read_field_options(argc, argv);
  if (options.help) {
    std::fputs(field_usage, stdout);
    return 0;
  }
  std::vector<Edit> edits;
  // vertices and points of the command line go in as two batches
  for (const bool vertices : {true, false}) {
    Edit first;
    for (const SiteArgument& site : options.sites) {
      if (site.place.is_vertex() == vertices) first.sites.push_back(site);
    }
    first.text =
        "add " + std::to_string(first.sites.size()) + (vertices ? " vertex sites" : " points") + " of the command line";
    if (!first.sites.empty()) edits.push_back(first);
  }
  if (!options.script.empty()) {
    for (Edit& edit : read_edit_script(options.script)) edits.push_back(std::move(edit));
  }
  if (edits.empty()) throw std::runtime_error("no sites given; use --site or --script");

  const SurfaceMesh mesh = read_mesh_file(options.mesh);
  for (const std::string& warning : mesh.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const Clock create_clock;
  Session session(mesh, options);
  describe(session.solver(), create_clock.milliseconds());

  std::vector<double> field;
  hf_solve_info info;
  for (const Edit& edit : edits) {
    const Clock edit_clock;
    session.apply(edit);
    const double edit_ms = edit_clock.milliseconds();
    if (hf_get_site_count(session.solver()) == 0) {
      field.clear();
      std::printf("%-40.60s edit %8.3f ms, no sites left\n", edit.text.c_str(), edit_ms);
      continue;
    }
    const Clock solve_clock;
    field = session.solve(info);
    std::printf("%-40.60s edit %8.3f ms, field %8.3f ms, %u sites\n", edit.text.c_str(), edit_ms,
                solve_clock.milliseconds(), hf_get_site_count(session.solver()));
  }
  if (field.empty()) throw std::runtime_error("the script ends without a site; there is no field to write");
  if (info.unreached_vertex_count) {
    std::fprintf(
        stderr,
        "warning: %u vertices are reached by no site (%u components without one, or isolated); they are written as 0\n",
        info.unreached_vertex_count, info.unreached_component_count);
  }
  if (!options.out.empty()) write_field_text(options.out, field);
  if (!options.glb.empty()) write_field_glb(options.glb, mesh, field, options.strips);
  if (!options.png.empty())
    write_field_picture(options.png, mesh, field, options.strips, session.positions(mesh), options.direction);
  return 0;
}

}  // namespace
}  // namespace samples

int main(int argc, char** argv) {
  try {
    return samples::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_field: %s\n", error.what());
    return 1;
  }
}
