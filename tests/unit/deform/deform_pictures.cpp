// Pictures of the classic cases for the eye, and the table of their figures: paper's mode (10 iterations a frame, and
// converged) beside the smooth mode. Not a test: run it by hand.
//   deform_pictures OUT_FOLDER [large | time | SCAN_FILE]
#include <chrono>
#include <cstdio>

#include "cases.h"
#include "common/mesh_file.h"
#include "common/picture.h"
#include "support/arap_oracle.h"
#include "support/pose_modes.h"

using namespace deform_test;

namespace {

samples::Picture draw(const Dragged& d, const std::vector<Vec3>& posed, const Case& c, bool stripes) {
  samples::Surface surface;
  const hf_inner::mesh::Mesh& mesh = d.core->mesh;
  for (const Vec3& x : posed) surface.positions.insert(surface.positions.end(), {x.x, x.y, x.z});
  for (const std::int32_t v : mesh.corners) surface.triangles.push_back(static_cast<std::uint32_t>(v));
  samples::SurfaceLook look;
  if (stripes) {
    look.fill = samples::Fill::stripes;
    look.stripe_count = 8;
  } else {
    look.fill = samples::Fill::colors;
    surface.colors.assign(3 * static_cast<std::size_t>(mesh.vertex_count()), 0.62f);
    for (std::size_t i = 0; i < c.regions.size(); ++i) {
      for (const std::int32_t v : select(*d.core, c.regions[i])) {
        const float rgb[2][3] = {{0.35f, 0.35f, 0.37f}, {0.95f, 0.6f, 0.15f}};
        std::copy(rgb[i > 0], rgb[i > 0] + 3, surface.colors.begin() + 3 * v);
      }
    }
  }
  samples::View view;
  view.width = view.height = 300;
  view.direction = c.closed ? samples::Point{0.35, 0.25, 1.0} : samples::Point{0.5, 0.7, 1.0};
  return samples::render(surface, view, look);
}

void row(const char* mode, const Case& c, const Dragged& d, const std::vector<Vec3>& posed, double ms) {
  const Quality q = measure(*d.core, posed);
  std::printf(
      "%-13s n=%-6d %-14s C=%-3u it %-4u solve %6.2f blend %5.2f ms frame %6.2f | E %9.5f in %6.2f e %.2f..%.2f p99 "
      "%.3f vol %6.2f s2 %.3f dih %6.1f rough %.3f\n",
      c.name.c_str(), d.core->size(), mode, d.report.cluster_count, d.report.iteration_count, d.report.solve_ms,
      d.report.blend_ms, ms, q.energy, q.edge_share, q.edge_min, q.edge_max, q.p99, c.closed ? q.volume : 0.0,
      q.smallest_stretch, q.dihedral_max, q.roughness);
}

hf_test::PlainMesh read(const std::string& file) {
  const samples::SurfaceMesh mesh = samples::read_mesh_file(file);
  hf_test::PlainMesh out;
  for (const auto& p : mesh.positions) out.positions.insert(out.positions.end(), {p.x, p.y, p.z});
  out.triangles = mesh.triangles;
  return out;
}

// Handles round a torus, more and more: what a change of handles, a frame and a blend cost.
int time_all() {
  for (const std::uint32_t side : {90u, 205u, 304u}) {
    const auto core = hf_test::make_core(plain(samples::jittered_torus(side, side)));
    for (const int count : {2, 3, 4, 8, 16}) {
      const auto pose = hf_inner::deform::Pose::make(core, {});
      std::vector<std::vector<std::int32_t>> regions;
      for (int i = 0; i < count; ++i) {
        const double a = 2 * pi * i / count;
        regions.push_back(select(*core, [&](Vec3 p) {
          return hf_inner::norm(p - Vec3{1.4 * std::cos(a), 0, 1.4 * std::sin(a)}) < 0.1;
        }));
      }
      const auto seconds = [](auto&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      };
      std::vector<std::uint32_t> numbers;
      const std::vector<std::vector<std::int32_t>> last{regions.back()};
      regions.pop_back();
      const double first = seconds([&] { numbers = add(*pose, regions); });
      const double second = seconds([&] { numbers.push_back(add(*pose, last)[0]); });
      double solve = 1e9, blend = 1e9, normal = 1e9;
      std::uint32_t clusters = 0;
      for (int frame = 0; frame < 20; ++frame) {
        place(*pose, numbers[0], {about({1, 0, 0}, 0.02 * frame), {0, 0, 0.01 * frame}});
        const hf_inner::deform::DeformReport r = pose->deform({true, 5, false});
        solve = std::min(solve, r.solve_ms);
        blend = std::min(blend, r.blend_ms);
        normal = std::min(normal, r.normal_ms);
        clusters = r.cluster_count;
      }
      std::size_t sites = 0;
      for (const std::uint32_t n : numbers) sites += pose->handle(n).site_count;
      std::printf("sites %zu ", sites);
      std::printf(
          "n=%-6d handles %-3d C=%-4u weights %5.1f per vertex | add %7.1f ms, one more %7.1f ms | 5 iterations %6.3f "
          "ms, blend %5.2f ms (%.1f ns a vertex), normals %5.2f ms\n",
          core->size(), count, clusters, static_cast<double>(pose->weights()->weight.size()) / core->size(), first,
          second, solve, blend, 1e6 * blend / core->size(), normal);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";
  const std::string what = argc > 2 ? argv[2] : "";
  const bool large = what == "large";
  if (what == "time") return time_all();
  std::vector<Case> cases{plane_lift(), cylinder_bend(), bar_twist(135), bar_twist(180), cactus_bend()};
  if (large) cases = {plane_lift(201), cylinder_bend(120, 26, 270), cactus_bend(70, 43000)};
  if (!large && !what.empty()) cases = {scan_hands(read(what)), scan_reach(read(what))};
  for (const Case& c : cases) {
    std::vector<samples::Picture> tiles, lower;
    const auto run = [&](const char* mode, hf_inner::deform::PoseOptions options, std::uint32_t iterations,
                         int settle) {
      const auto start = std::chrono::steady_clock::now();
      Dragged d = drag(c, options, 30, iterations);
      const double ms =
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() / 30;
      for (int i = 0; i < settle; ++i) d.report = d.pose->deform({false, 1000, false});
      const auto show = [&](const char* name, const std::vector<Vec3>& posed) {
        row(name, c, d, posed, ms);
        tiles.push_back(draw(d, posed, c, false));
        lower.push_back(draw(d, posed, c, true));
      };
      const std::vector<Vec3> posed = positions(d.report);
      show(mode, posed);
      if (options.scheme) return;
      hf_inner::deform::DeformRequest request;
      request.iteration_count = 1;
      request.refine = true;
      show("smooth, refined", positions(d.pose->deform(request)));
      // converged as-rigid-as-possible iterations from here
      std::vector<std::uint8_t> fixed(posed.size(), 0);
      for (const auto& region : c.regions) {
        for (const std::int32_t v : select(*d.core, region)) fixed[static_cast<std::size_t>(v)] = 1;
      }
      const std::vector<Vec3> p = rest(*d.core);
      std::vector<Vec3> x;
      for (const Vec3& q : posed) x.push_back(d.core->mesh.to_inner(q));
      const auto given = [&] {
        std::vector<Vec3> out;
        for (const Vec3& q : x) out.push_back(d.core->mesh.to_given(q));
        return out;
      };
      hf_inner::surface::CoreOptions own_edges;
      own_edges.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
      const auto cotangents = hf_test::make_core(c.mesh, 1, own_edges);
      hf_test::ArapOracle oracle(*cotangents, fixed);
      oracle.converge(x, 300, [&](const std::vector<Vec3>&) { return arap_energy(*d.core, p, given()); });
      show("ARAP, converged", given());
    };
    hf_inner::deform::PoseOptions paper;
    paper.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
    run("paper 10/frame", paper, 10, 0);
    run("paper conv.", paper, 100, 1);
    run("smooth", {}, 5, 0);
    tiles.insert(tiles.end(), lower.begin(), lower.end());
    std::string file = c.name;
    std::replace(file.begin(), file.end(), ' ', '_');
    samples::write_png(
        folder + "/" + file + ".png",
        samples::contact_sheet(
            tiles, 5, {"paper, 10 a frame", "paper, converged", "smooth", "smooth, refined", "ARAP, converged"},
            c.name));
  }
  return 0;
}
