#include "edit_player.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "edit_host.h"
#include "hf/hf.h"
#include "play.h"
#include "support/owned.h"

namespace edits {
namespace {

using play::fail;
using play::hold;

using hf_test::Owned;
using OwnedSurface = Owned<hf_surface, hf_surface_destroy>;
using OwnedSolver = Owned<hf_solver, hf_solver_destroy>;

std::vector<hf_link> links_of(hf_surface surface) {
  std::uint32_t count = 0;
  if (hf_surface_get_links(surface, 0, nullptr, &count) != HF_OK && count == 0) return {};
  std::vector<hf_link> links(count);
  if (hf_surface_get_links(surface, count, links.data(), &count) != HF_OK) fail("links");
  return links;
}

hf_links_desc list_of(const std::vector<hf_link>& links) {
  hf_links_desc desc = HF_INIT(hf_links_desc);
  desc.mode = HF_LINK_LIST;
  desc.overlay_distance = -1;  // no piece is light, as on the surface before its first link
  desc.link_count = static_cast<std::uint32_t>(links.size());
  desc.links = links.data();
  return desc;
}

class Player {
 public:
  Player(play::Bytes bytes, Outcome& outcome) : bytes_(bytes), outcome_(outcome) {
    const unsigned first = bytes_.take();
    constexpr int kinds[] = {HF_OPERATOR_INTRINSIC_DELAUNAY, HF_OPERATOR_COTANGENT, HF_OPERATOR_UNIFORM,
                             HF_OPERATOR_INTRINSIC_DELAUNAY};
    kind_ = kinds[first / 4 % 4];
    state_.host = host_of(first);
    state_.surface = std::make_shared<OwnedSurface>(fresh({}));
    if (hf_create(surface(), nullptr, solver_.out()) != HF_OK) fail("hf_create");
    for (int i = 0; i < 3; ++i) add_site();
    compare("the start");
  }

  void run() {
    try {
      for (unsigned steps = 0; !bytes_.done() && steps < 24; ++steps) step();
    } catch (const Indefinite&) {
      ++outcome_.refused;
    }
  }

 private:
  struct State {
    Host host;
    std::shared_ptr<OwnedSurface> surface;
  };

  hf_surface surface() const { return *state_.surface; }
  Host& host() { return state_.host; }
  std::uint32_t any_vertex() { return bytes_.take() * 7u % host().vertex_count(); }

  OwnedSurface fresh(const std::vector<hf_link>& links) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t t : host().alive())
      corners.insert(corners.end(), host().triangles[t].begin(), host().triangles[t].end());
    hf_surface_desc desc = HF_INIT(hf_surface_desc);
    const hf_links_desc list = list_of(links);
    desc.positions = HF_ARRAY(host().positions.data(), host().vertex_count());
    desc.triangles = HF_ARRAY(corners.data(), static_cast<std::uint32_t>(corners.size() / 3));
    desc.weld = HF_WELD_NONE;
    desc.operator_kind = kind_;
    if (!links.empty()) desc.links = &list;
    OwnedSurface made, stiff;
    check_definite(hf_surface_create(&desc, made.out()), "a fresh surface");
    const auto& s = host().stiffness;
    if (std::all_of(s.begin(), s.end(), [](double x) { return x == 1; })) return made;
    hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
    edit.vertex_count = host().vertex_count();
    edit.stiffness = s.data();
    check_definite(hf_surface_edit(made, &edit, stiff.out()), "a fresh stiffness");
    return stiff;
  }

  // Negative weights can outweigh the others, in other edits for the edited surface than for the fresh one.
  struct Indefinite {};
  void check_definite(hf_result got, const char* what) const {
    if (got == HF_ERROR_NOT_POSITIVE_DEFINITE && kind_ == HF_OPERATOR_COTANGENT) throw Indefinite();
    if (got != HF_OK) fail(what);
  }

  void step() {
    const unsigned byte = bytes_.take(), kind = byte % 9;
    State before = state_;
    using Act = bool (Player::*)(unsigned);
    constexpr Act acts[] = {&Player::stroke, &Player::refine,         &Player::remove,
                            &Player::fill,   &Player::replace_vertex, &Player::cut,
                            &Player::link,   &Player::unlink,         &Player::undo_or_change_sites};
    const bool changed = (this->*acts[kind])(byte / 9);
    if (!changed) return;
    ++outcome_.done[kind];
    forget_stiffness();
    if (kind != 8) history_.push_back(std::move(before));
    if (history_.size() > 5) history_.erase(history_.begin());
    move_solver();
    compare(kind == 8 ? "another state" : names[kind]);
  }

  // A vertex that is isolated forgets its stiffness.
  void forget_stiffness() {
    std::vector<double> kept(host().vertex_count(), 1.0);
    for (const std::uint32_t t : host().alive())
      for (const std::uint32_t v : host().triangles[t]) kept[v] = host().stiffness[v];
    host().stiffness = kept;
  }

  // Takes the solver along. A site at a vertex without a triangle is refused by its number, and goes.
  void move_solver() {
    while (hf_solver_move_to(solver_, surface()) != HF_OK) {
      hf_error_detail detail;
      hf_error_get_detail(&detail);
      const auto site = sites_.find(detail.index);
      if (site == sites_.end() || !host().neighbours(site->second.vertex).empty()) fail("hf_solver_move_to");
      if (hf_remove_sites(solver_, 1, &site->first) != HF_OK) fail("hf_remove_sites");
      sites_.erase(site);
    }
  }

  // Makes an edited surface. Returns whether there is one: an edit may be refused, and then nothing changed.
  bool edit(const hf_surface_edit_desc& desc, std::initializer_list<hf_result> refusals) {
    OwnedSurface made;
    const hf_result got = hf_surface_edit(surface(), &desc, made.out());
    if (got == HF_OK) {
      state_.surface = std::make_shared<OwnedSurface>(std::move(made));
      return true;
    }
    hold(*made.out() == nullptr, "a refused edit wrote a surface");
    if (got == HF_ERROR_NOT_POSITIVE_DEFINITE) check_definite(got, "an edit");
    if (std::find(refusals.begin(), refusals.end(), got) == refusals.end())
      fail(std::string("an edit ended with ") + hf_result_get_name(got));
    ++outcome_.refused;
    return false;
  }

  bool stroke(unsigned how) {
    std::vector<std::uint32_t> list = {any_vertex()};
    for (unsigned ring = 0; ring < how % 3; ++ring) {
      for (std::size_t i = 0, end = list.size(); i < end; ++i)
        for (const std::uint32_t u : host().neighbours(list[i]))
          if (std::find(list.begin(), list.end(), u) == list.end()) list.push_back(u);
    }
    const double value = how / 3 % 4 == 0 ? 1.0 : std::pow(10.0, 0.5 * (static_cast<int>(bytes_.take() % 9) - 4));
    const std::vector<double> values(list.size(), value);
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.vertex_count = static_cast<std::uint32_t>(list.size());
    desc.vertices = list.data();
    desc.stiffness = values.data();
    if (!edit(desc, {})) return false;
    for (const std::uint32_t v : list) host().stiffness[v] = value;
    return true;
  }

  // Patches surface and host alike.
  bool patch(const std::vector<std::uint32_t>& removed, const std::vector<double>& positions,
             const std::vector<std::array<std::uint32_t, 3>>& added) {
    hf_patch_desc patch = HF_INIT(hf_patch_desc);
    patch.removed_triangle_count = static_cast<std::uint32_t>(removed.size());
    patch.removed_triangles = removed.data();
    patch.new_vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    patch.new_positions = positions.data();
    patch.new_triangle_count = static_cast<std::uint32_t>(added.size());
    patch.new_triangles = added.empty() ? nullptr : added.front().data();
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.patch = &patch;
    if (!edit(desc, {HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_UNSUPPORTED})) return false;
    for (const std::uint32_t t : removed) {
      host().gone.push_back(host().triangles[t]);
      host().triangles[t] = {none, none, none};
    }
    host().positions.insert(host().positions.end(), positions.begin(), positions.end());
    host().stiffness.resize(host().vertex_count(), 1.0);
    host().triangles.insert(host().triangles.end(), added.begin(), added.end());
    return true;
  }

  // Some triangles that are there, each once.
  std::vector<std::uint32_t> some_triangles(unsigned count) {
    const std::vector<std::uint32_t> alive = host().alive();
    std::vector<std::uint32_t> out;
    const unsigned first = bytes_.take() * 5u;
    for (unsigned i = 0; i < count; ++i) {
      const std::uint32_t t = alive[(first + i * (1 + first % 3)) % alive.size()];
      if (std::find(out.begin(), out.end(), t) == out.end()) out.push_back(t);
    }
    return out;
  }

  bool refine(unsigned how) {
    const std::vector<std::uint32_t> removed = some_triangles(1 + how % 4);
    std::vector<double> positions;
    std::vector<std::array<std::uint32_t, 3>> added;
    for (const std::uint32_t t : removed) {
      const auto v = host().triangles[t];
      const auto middle = static_cast<std::uint32_t>(host().vertex_count() + positions.size() / 3);
      for (std::size_t x = 0; x < 3; ++x) {
        double sum = 0;
        for (const std::uint32_t u : v) sum += host().positions[3 * u + x];
        positions.push_back(sum / 3 + (x == 2 ? 0.02 * (how % 5) : 0));
      }
      for (std::size_t k = 0; k < 3; ++k) added.push_back({v[k], v[(k + 1) % 3], middle});
    }
    return patch(removed, positions, added);
  }

  bool remove(unsigned how) { return patch(some_triangles(1 + how % 4), {}, {}); }

  bool fill(unsigned how) {
    if (host().gone.empty()) return false;
    std::vector<std::array<std::uint32_t, 3>> added;
    for (unsigned i = 0; i <= how % 3 && i < host().gone.size(); ++i)
      added.push_back(host().gone[host().gone.size() - 1 - i]);
    if (!patch({}, {}, added)) return false;
    host().gone.resize(host().gone.size() - added.size());
    return true;
  }

  // The fan of a vertex comes again around a new vertex beside it.
  bool replace_vertex(unsigned) {
    const std::uint32_t v = any_vertex();
    std::vector<std::uint32_t> removed;
    std::vector<std::array<std::uint32_t, 3>> added;
    for (std::uint32_t t = 0; t < host().triangles.size(); ++t) {
      auto corners = host().triangles[t];
      if (!host().there(t) || std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
      removed.push_back(t);
      std::replace(corners.begin(), corners.end(), v, host().vertex_count());
      added.push_back(corners);
    }
    if (removed.empty()) return false;
    std::vector<double> position(host().positions.begin() + 3 * v, host().positions.begin() + 3 * v + 3);
    position[2] += 0.05 * (1 + bytes_.take() % 4);
    return patch(removed, position, added);
  }

  // Cuts along a walk over edges, and takes the corners over as a host does.
  bool cut(unsigned how) {
    std::vector<std::uint32_t> edges, walk = {any_vertex()};
    const unsigned turns = bytes_.take();
    for (unsigned i = 0; i < 2 + how % 9; ++i) {
      std::vector<std::uint32_t> next = host().neighbours(walk.back());
      next.erase(std::remove_if(next.begin(), next.end(),
                                [&](std::uint32_t u) { return walk.size() > 1 && u == walk[walk.size() - 2]; }),
                 next.end());
      if (next.empty()) break;
      walk.push_back(next[(turns * (i + 1) + i) % next.size()]);
      edges.insert(edges.end(), {walk[walk.size() - 2], walk.back()});
    }
    if (edges.empty()) return false;
    hf_patch_desc patch = HF_INIT(hf_patch_desc);
    patch.cut_edge_count = static_cast<std::uint32_t>(edges.size() / 2);
    patch.cut_edges = edges.data();
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.patch = &patch;
    std::uint32_t first = 0, count = 0;
    if (hf_surface_get_cuts(surface(), 0, nullptr, &first) != HF_OK && first == 0) fail("hf_surface_get_cuts");
    if (!edit(desc, {HF_ERROR_EMPTY, HF_ERROR_UNSUPPORTED, HF_ERROR_CONFLICT})) return false;
    hf_surface_get_cuts(surface(), 0, nullptr, &count);
    std::vector<hf_cut_corner> corners(count);
    if (hf_surface_get_cuts(surface(), count, corners.data(), &count) != HF_OK) fail("hf_surface_get_cuts");
    for (std::uint32_t i = first; i < count; ++i) {
      const hf_cut_corner& c = corners[i];
      hold(host().triangles[c.triangle][c.corner] == c.copied, "a cut names another vertex");
      hold(c.vertex <= host().vertex_count(), "a cut leaves numbers out");
      host().triangles[c.triangle][c.corner] = c.vertex;
      if (c.vertex < host().vertex_count()) continue;
      for (std::uint32_t x = 0; x < 3; ++x) host().positions.push_back(host().positions[3 * c.copied + x]);
      host().stiffness.push_back(host().stiffness[c.copied]);
    }
    return true;
  }

  bool link(unsigned how) {
    std::vector<hf_link> links(1 + how % 2);
    for (hf_link& link : links) {
      link = hf_link();
      link.vertex = any_vertex();
      const auto corners = host().triangles[some_triangles(1)[0]];
      std::copy(corners.begin(), corners.end(), link.corners);
      const double a = bytes_.take() % 5 / 4.0;
      link.barycentrics[0] = a;
      link.barycentrics[1] = 1 - a;
      link.weight = 0.25 * (1 + how % 7);
    }
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.link_count = static_cast<std::uint32_t>(links.size());
    desc.links = links.data();
    return edit(desc, {HF_ERROR_INVALID_ARGUMENT, HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED, HF_ERROR_NOT_FOUND});
  }

  bool unlink(unsigned) {
    const auto count = static_cast<std::uint32_t>(links_of(surface()).size());
    if (count == 0) return false;
    const std::uint32_t number = bytes_.take() % count;
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.removed_link_count = 1;
    desc.removed_links = &number;
    return edit(desc, {});
  }

  bool undo_or_change_sites(unsigned how) { return how % 2 ? undo() : change_sites(); }

  bool undo() {
    if (history_.empty()) return false;
    state_ = history_[bytes_.take() % history_.size()];
    return true;
  }

  void add_site() {
    const std::uint32_t v = any_vertex();
    const double value = bytes_.take() / 255.0;
    std::uint32_t number = none;
    const hf_result got = hf_solver_add_site(solver_, v, &value, &number);
    if (got == HF_OK) {
      sites_[number] = {v, value};
    } else {
      hold(got == HF_ERROR_NOT_FOUND || got == HF_ERROR_DUPLICATE || got == HF_ERROR_INVALID_ARGUMENT ||
               got == HF_ERROR_CONFLICT,
           std::string("a site: ") + hf_result_get_name(got));
    }
  }

  bool change_sites() {
    if (sites_.size() > 6 || (sites_.size() > 2 && bytes_.take() % 2)) {
      auto one = sites_.begin();
      std::advance(one, static_cast<std::ptrdiff_t>(bytes_.take() % sites_.size()));
      if (hf_remove_sites(solver_, 1, &one->first) != HF_OK) fail("hf_remove_sites");
      sites_.erase(one);
    } else {
      add_site();
    }
    return true;
  }

  std::vector<double> field_of(hf_solver solver) {
    std::vector<double> field(host().vertex_count());
    const hf_array_out out = HF_ARRAY_OUT(field.data(), field.size());
    if (hf_solver_solve(solver, &out, nullptr) != HF_OK) fail("hf_solver_solve");
    return field;
  }

  void compare(const char* after) {
    const OwnedSurface made = fresh(links_of(surface()));
    hf_surface_report a = HF_INIT(hf_surface_report), b = HF_INIT(hf_surface_report);
    hf_surface_get_report(surface(), &a);
    hf_surface_get_report(made, &b);
    hold(a.vertex_count == b.vertex_count && a.component_count == b.component_count &&
             a.isolated_vertex_count == b.isolated_vertex_count && a.boundary_edge_count == b.boundary_edge_count,
         std::string("another report after ") + after);
    std::vector<std::uint32_t> parts(host().vertex_count()), others(parts);
    const auto size = static_cast<std::uint32_t>(parts.size());
    hf_surface_get_components(surface(), size, parts.data(), nullptr);
    hf_surface_get_components(made, size, others.data(), nullptr);
    hold(parts == others, std::string("other components after ") + after);
    if (sites_.empty()) return;
    OwnedSolver solver;
    if (hf_create(made, nullptr, solver.out()) != HF_OK) fail("a fresh solver");
    for (const auto& [number, site] : sites_) {
      const hf_result got = hf_solver_add_site(solver, site.vertex, &site.value, nullptr);
      if (got != HF_OK) fail(std::string("a site of the fresh surface after ") + after);
    }
    const std::vector<double> field = field_of(solver_), truth = field_of(solver);
    double worst = 0;
    for (std::size_t v = 0; v < field.size(); ++v) {
      const double off = std::fabs(field[v] - truth[v]);
      worst = off <= worst ? worst : off;  // NaN counts
    }
    outcome_.worst = std::max(outcome_.worst, worst);
    if (!(worst <= tolerance)) fail("a field is off by " + std::to_string(1e12 * worst) + "e-12 after " + after);
    if (bytes_.peek() % 4 == 0) compare_shapes(made, after);
  }

  // Poses and exact distances on the edited surface and on the fresh one.
  void compare_shapes(hf_surface made, const char* after) {
    hf_surface both[2] = {surface(), made};
    std::vector<double> distance[2];
    std::vector<float> posed[2];
    hf_result got[2][2];
    const std::uint32_t source = sites_.begin()->second.vertex, far = sites_.rbegin()->second.vertex;
    const double radius = 1.1;
    for (int i = 0; i < 2; ++i) {
      distance[i].assign(host().vertex_count(), 0.0);
      posed[i].assign(host().positions.size(), 0.0F);
      const hf_array_out out = HF_ARRAY_OUT(distance[i].data(), distance[i].size());
      hf_geodesics_desc exact = HF_INIT(hf_geodesics_desc);
      exact.method = HF_GEODESICS_EXACT;
      Owned<hf_geodesics, hf_geodesics_destroy> geodesics;
      if (hf_geodesics_create(both[i], &exact, geodesics.out()) != HF_OK) fail("hf_geodesics_create");
      got[i][0] = hf_geodesics_solve(geodesics, 1, &source, &out);
      Owned<hf_pose, hf_pose_destroy> pose;
      if (hf_pose_create(both[i], nullptr, pose.out()) != HF_OK) fail("hf_pose_create");
      hf_handles_desc handles = HF_INIT(hf_handles_desc);
      const std::uint32_t ends[2] = {source, far};
      const double radii[2] = {radius, radius};
      std::uint32_t numbers[2];
      handles.handle_count = 2;
      handles.vertices = ends;
      handles.radii = radii;
      got[i][1] = hf_pose_add_handles(pose, &handles, numbers);
      if (got[i][1] != HF_OK) continue;
      const hf_transform moved = {{0.0, 0.2, 0.0, 0.9797958971132712}, {0.3, 0.2, 0.1}};
      hf_pose_set_transform(pose, numbers[1], &moved);
      if (hf_deform(pose, posed[i].data(), nullptr) != HF_OK) fail("hf_deform");
    }
    hold(got[0][0] == got[1][0] && got[0][1] == got[1][1], std::string("other results after ") + after);
    double off[2] = {0, 0};
    for (std::size_t v = 0; v < distance[0].size(); ++v)
      off[0] = std::max(off[0], std::fabs(distance[0][v] - distance[1][v]));
    for (std::size_t k = 0; k < posed[0].size(); ++k)
      off[1] = std::max(off[1], static_cast<double>(std::fabs(posed[0][k] - posed[1][k])));
    outcome_.distance = std::max(outcome_.distance, off[0]);
    ++outcome_.poses;
    outcome_.poses_off += !(off[1] <= pose_tolerance);
    if (!(off[0] <= tolerance)) fail("a distance is off by " + std::to_string(1e9 * off[0]) + "e-9 after " + after);
  }

  struct Site {
    std::uint32_t vertex;
    double value;
  };
  static constexpr const char* names[] = {
      "a stroke",       "a refined patch", "a hole",      "triangles that come again",
      "another vertex", "a cut",           "a link more", "a link less"};
  play::Bytes bytes_;
  Outcome& outcome_;
  int kind_ = 0;
  State state_;
  std::vector<State> history_;
  OwnedSolver solver_;
  std::map<std::uint32_t, Site> sites_;
};

}  // namespace

Outcome play(const std::uint8_t* bytes, std::size_t size) {
  Outcome outcome;
  try {
    Player(play::Bytes(bytes, size), outcome).run();
  } catch (const play::Failure& failure) {
    outcome.passed = false;
    outcome.failure = failure.what();
  }
  return outcome;
}

}  // namespace edits
