// Random edit scripts on a ScalarField, and a plain model of what the sites must be: the model shares no code with the
// site set or the engines.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "field/scalar_field.h"
#include "mesh/places.h"
#include "support/engines.h"
#include "support/oracle.h"

namespace hf_test {

struct ModelSite {
  bool used = false, at_vertex = false;
  std::uint32_t given = 0;  // vertex or triangle as given
  double weight[3] = {0, 0, 0};
  double stiffness = 0;
  std::vector<double> values;
};

class EditScript {
 public:
  EditScript(std::shared_ptr<const hf_inner::surface::Core> c, std::vector<hf_test::EngineKind> kinds, int channels,
             std::uint32_t seed, double offset)
      : core(std::move(c)), m(static_cast<std::size_t>(channels)), shift(offset), random_(seed) {
    for (const hf_test::EngineKind kind : kinds)
      fields.emplace_back(
          std::make_unique<hf_inner::field::ScalarField>(core, channels, 100000, hf_test::make_engine(kind, core)));
    engines_ = std::move(kinds);
    for (std::uint32_t v = 0; v < core->mesh.report.vertex_count; ++v) {
      if (core->mesh.inner_of_given[v] != hf_inner::mesh::Mesh::none) vertices_.push_back(v);
    }
    for (std::uint32_t t = 0; t < core->mesh.report.triangle_count; ++t) {
      if (core->mesh.triangle_of_given[t] != hf_inner::mesh::Mesh::none) triangles_.push_back(t);
    }
  }

  std::size_t count() const {
    return static_cast<std::size_t>(
        std::count_if(sites.begin(), sites.end(), [](const ModelSite& s) { return s.used; }));
  }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }

  // One batch of up to `most` edits around `population` sites; returns how many it held.
  int step(int population, int most) {
    const int total = 1 + below(most), there = static_cast<int>(count());
    int removes = 0, moves = 0, sets = 0, adds = 0;
    for (int i = 0; i < total; ++i) {
      const int dice = below(10);
      if (dice < 2) {
        ++moves;
      } else if (dice < 4) {
        ++sets;
      } else if (below(2 * population) < there + adds - removes) {
        ++removes;
      } else {
        ++adds;
      }
    }
    return apply(removes, moves, sets, adds);
  }

  // A batch of so many of each, as far as there are sites. Places are chosen so that hard sites stay independent.
  int apply(int removes, int moves, int sets, int adds, bool hard_vertices = false) {
    std::vector<ModelSite> next = sites;
    std::vector<std::uint32_t> used;
    for (std::uint32_t s = 0; s < next.size(); ++s) {
      if (next[s].used) used.push_back(s);
    }
    std::shuffle(used.begin(), used.end(), random_);
    Batch batch;
    const auto take = [&](int wanted, std::vector<std::uint32_t>& list) {
      for (; wanted > 0 && !used.empty(); --wanted) {
        list.push_back(used.back());
        used.pop_back();
      }
    };
    take(removes, batch.remove);
    take(moves, batch.move);
    for (const std::uint32_t s : batch.remove) next[s] = ModelSite{};
    std::vector<ModelSite> fresh;
    std::vector<std::uint32_t> kept;
    // the moved sites leave all at once, and arrive one by one; a batch moves to vertices or into triangles
    const std::vector<ModelSite> before = next;
    for (const std::uint32_t s : batch.move) next[s].used = false;
    const bool to_vertices = below(3) != 0;
    for (const std::uint32_t s : batch.move) {
      ModelSite site = before[s];
      if (!find_place(next, {}, to_vertices, site)) {
        next = before;
        batch.move.clear();
        break;
      }
      site.used = true;
      next[s] = site;
    }
    for (const std::uint32_t s : batch.move) append(next[s], batch.move_vertex, batch.move_place);
    batch.moves_to_vertices = to_vertices;
    for (std::uint32_t s = 0; s < next.size(); ++s) {
      if (next[s].used) kept.push_back(s);
    }
    std::shuffle(kept.begin(), kept.end(), random_);
    for (int i = 0; i < sets && i < static_cast<int>(kept.size()); ++i) {
      const std::uint32_t s = kept[static_cast<std::size_t>(i)];
      next[s].values = random_values();
      batch.set.push_back(s);
      batch.set_values.insert(batch.set_values.end(), next[s].values.begin(), next[s].values.end());
    }
    const bool add_at_vertices = hard_vertices || below(3) != 0;
    for (int i = 0; i < adds; ++i) {
      ModelSite site;
      site.stiffness = hard_vertices || below(3) ? 0.0 : std::pow(10.0, -2.0 + below(5));
      if (!find_place(next, fresh, add_at_vertices, site)) break;
      site.used = true;
      site.values = random_values();
      fresh.push_back(site);
      append(site, batch.add_vertex, batch.add_place);
      batch.add_stiffness.push_back(site.stiffness);
      batch.add_values.insert(batch.add_values.end(), site.values.begin(), site.values.end());
    }
    batch.adds_at_vertices = add_at_vertices;
    std::vector<std::uint32_t> first;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      std::vector<std::uint32_t> numbers(fresh.size());
      fields[f]->edit(batch.edit(), numbers.data());
      if (f == 0) first = numbers;
      EXPECT_EQ(numbers, first) << "engines number their sites differently";
    }
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      if (first[i] >= next.size()) next.resize(first[i] + 1);
      EXPECT_FALSE(next[first[i]].used) << "a number in use was given away";
      next[first[i]] = fresh[i];
    }
    sites = std::move(next);
    return static_cast<int>(batch.remove.size() + batch.move.size() + batch.set.size() + fresh.size());
  }

  // A batch that must be refused as a whole, good parts in front of the bad one.
  void refused_step() {
    std::vector<std::uint32_t> used;
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
      if (sites[s].used) used.push_back(s);
    }
    if (used.empty()) return;
    const std::uint32_t one = used[static_cast<std::size_t>(below(static_cast<int>(used.size())))];
    Batch batch;
    std::vector<hf_result> allowed;
    batch.set.push_back(one);
    batch.set_values = random_values();
    switch (below(4)) {
      case 0:
        batch.remove = {one, one};
        allowed = {HF_ERROR_NOT_FOUND};
        break;
      case 1:
        batch.set.clear();
        batch.set_values.clear();
        batch.remove = {one};
        batch.move = {one};
        batch.move_vertex = {vertices_[0]};
        batch.moves_to_vertices = true;
        allowed = {HF_ERROR_NOT_FOUND};
        break;
      case 2:
        batch.add_vertex = {core->mesh.report.vertex_count};
        batch.adds_at_vertices = true;
        batch.add_stiffness = {0.0};
        batch.add_values = random_values();
        allowed = {HF_ERROR_OUT_OF_RANGE};
        break;
      default: {
        // on a vertex that carries a site
        const auto taken =
            std::find_if(sites.begin(), sites.end(), [](const ModelSite& s) { return s.used && s.at_vertex; });
        if (taken == sites.end()) return;
        batch.add_vertex = {taken->given};
        batch.adds_at_vertices = true;
        batch.add_stiffness = {0.0};
        batch.add_values = random_values();
        allowed = {HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE};
        break;
      }
    }
    for (const auto& field : fields) {
      try {
        field->edit(batch.edit(), nullptr);
        ADD_FAILURE() << "a bad batch was accepted";
      } catch (const hf_inner::Error& error) {
        EXPECT_TRUE(std::count(allowed.begin(), allowed.end(), error.code())) << error.what();
      }
      EXPECT_EQ(field->sites().count(), count());
    }
  }

  // The model's sites for an engine or an oracle, with their values less the common offset.
  void present(std::vector<hf_inner::solve::Site>& out, Eigen::MatrixXd& values) const {
    values.resize(static_cast<Eigen::Index>(count()), static_cast<Eigen::Index>(m));
    for (const ModelSite& s : sites) {
      if (!s.used) continue;
      hf_inner::solve::Site site;
      if (s.at_vertex) {
        site = hf_inner::solve::Site::at_vertex(core->mesh, core->mesh.inner_of_given[s.given]);
      } else {
        const std::int32_t* corner = corners_of(s.given);
        for (int k = 0; k < 3; ++k) {
          site.vertex[k] = corner[k];
          site.weight[k] = s.weight[k];
        }
        site.component = core->mesh.component[static_cast<std::size_t>(site.vertex[0])];
      }
      site.compliance = s.stiffness > 0 ? 1 / s.stiffness : 0;
      for (std::size_t c = 0; c < m; ++c)
        values(static_cast<Eigen::Index>(out.size()), static_cast<Eigen::Index>(c)) = s.values[c] - shift;
      out.push_back(site);
    }
  }

  // Every engine's field against `exact` (of the values less the offset; n x m), relative to its size.
  void expect_fields(const Eigen::MatrixXd& exact, const std::vector<hf_inner::solve::Site>& used, double tolerance,
                     double updown_tolerance) const {
    std::vector<char> reached(static_cast<std::size_t>(core->mesh.component_count()), 0);
    for (const hf_inner::solve::Site& site : used) reached[static_cast<std::size_t>(site.component)] = 1;
    const double size = std::max(2.0, exact.cwiseAbs().maxCoeff());
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const auto& field = fields[f];
      std::vector<double> u(static_cast<std::size_t>(core->size()) * m, -7);
      field->solve(u.data());
      double worst = 0;
      for (std::size_t v = 0; v < static_cast<std::size_t>(core->size()); ++v) {
        const bool in = reached[static_cast<std::size_t>(core->mesh.component[v])];
        for (std::size_t c = 0; c < m; ++c) {
          const double expected = in ? exact(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(c)) + shift : 0.0;
          worst = std::max(worst, std::fabs(u[v * m + c] - expected));
        }
      }
      if (engines_[f] == hf_test::EngineKind::green) {
        // what single precision and corrections make of the same sites
        std::vector<double> preview(u.size());
        for (const int corrections : {0, 2}) {
          const hf_inner::solve::PreviewInfo info = field->solve_preview(corrections, preview.data());
          double off = 0;
          for (std::size_t i = 0; i < u.size(); ++i) off = std::max(off, std::fabs(preview[i] - u[i]));
          EXPECT_LE(off, (corrections ? 1e-10 : 1e-4) * size) << corrections << " corrections";
          if (info.exact) {
            EXPECT_EQ(off, 0);
          }
        }
      }
      const bool penalty = engines_[f] == hf_test::EngineKind::updown;
      EXPECT_LE(worst, (penalty ? updown_tolerance : tolerance) * size)
          << "engine " << static_cast<int>(engines_[f]) << ", " << used.size() << " sites";
    }
  }

  std::shared_ptr<const hf_inner::surface::Core> core;
  std::size_t m;
  double shift;
  std::vector<ModelSite> sites;  // by number
  std::vector<std::unique_ptr<hf_inner::field::ScalarField>> fields;

 private:
  // A batch as FieldEdit wants it.
  struct Batch {
    std::vector<std::uint32_t> remove, move, set, move_vertex, add_vertex;
    std::vector<hf_place> move_place, add_place;
    std::vector<double> set_values, add_values, add_stiffness;
    bool moves_to_vertices = true, adds_at_vertices = true;
    static hf_inner::mesh::Places places(const std::vector<std::uint32_t>& vertex, const std::vector<hf_place>& place,
                                         bool at_vertices) {
      hf_inner::mesh::Places p;
      p.count = static_cast<std::uint32_t>(vertex.size());
      if (at_vertices)
        p.vertices = vertex.data();
      else
        p.places = place.data();
      return p;
    }
    hf_inner::field::FieldEdit edit() const {
      hf_inner::field::FieldEdit e;
      e.remove_count = static_cast<std::uint32_t>(remove.size());
      e.remove_sites = remove.data();
      e.move_count = static_cast<std::uint32_t>(move.size());
      e.move_sites = move.data();
      e.move_to = places(move_vertex, move_place, moves_to_vertices);
      e.set_count = static_cast<std::uint32_t>(set.size());
      e.set_sites = set.data();
      e.set_values = set_values.data();
      e.add = places(add_vertex, add_place, adds_at_vertices);
      e.add_holds.values = add_values.data();
      e.add_holds.stiffness = add_stiffness.data();
      return e;
    }
  };

  // Corners of a triangle as given. A doubled one has those of the triangle that counts.
  const std::int32_t* corners_of(std::uint32_t given) const {
    return core->mesh.triangle(core->mesh.triangle_of_given[given]);
  }
  void append(const ModelSite& site, std::vector<std::uint32_t>& vertex, std::vector<hf_place>& place) const {
    vertex.push_back(site.given);
    if (site.at_vertex) return;
    hf_place one{};
    for (int k = 0; k < 3; ++k) {
      one.corners[k] = hf_inner::mesh::given_vertex(core->mesh, corners_of(site.given)[k]);
      one.barycentrics[k] = site.weight[k];
    }
    place.push_back(one);
  }

  std::vector<double> random_values() {
    std::vector<double> values(m);
    for (double& v : values) v = shift + std::uniform_real_distribution<double>(-1, 1)(random_);
    return values;
  }

  // Whether a site of the model stands in the way of a new one: two at one vertex, or hard ones that share a corner of
  // a point inside a triangle (they would be all but dependent).
  bool free(const std::vector<ModelSite>& present, const std::vector<ModelSite>& fresh, const ModelSite& site) const {
    const auto corners = [&](const ModelSite& s, std::int32_t* out) {
      if (s.at_vertex) {
        out[0] = core->mesh.inner_of_given[s.given];
        return 1;
      }
      std::copy_n(corners_of(s.given), 3, out);
      return 3;
    };
    std::int32_t own[3], other[3];
    const int count_own = corners(site, own);
    const auto clear_of = [&](const ModelSite& s) {
      if (!s.used) return true;
      const bool both_at_vertices = s.at_vertex && site.at_vertex;
      if (!both_at_vertices && (s.stiffness > 0 || site.stiffness > 0)) return true;
      const int count_other = corners(s, other);
      for (int a = 0; a < count_own; ++a) {
        if (std::count(other, other + count_other, own[a])) return false;
      }
      return true;
    };
    return std::all_of(present.begin(), present.end(), clear_of) && std::all_of(fresh.begin(), fresh.end(), clear_of);
  }
  bool find_place(const std::vector<ModelSite>& present, const std::vector<ModelSite>& fresh, bool vertex,
                  ModelSite& site) {
    for (int attempt = 0; attempt < 200; ++attempt) {
      site.at_vertex = vertex;
      if (vertex) {
        site.given = vertices_[static_cast<std::size_t>(below(static_cast<int>(vertices_.size())))];
        site.weight[0] = 1;
        site.weight[1] = site.weight[2] = 0;
      } else {
        site.given = triangles_[static_cast<std::size_t>(below(static_cast<int>(triangles_.size())))];
        site.weight[0] = 0.2 + 0.05 * below(5);
        site.weight[1] = 0.2 + 0.05 * below(5);
        site.weight[2] = 1 - site.weight[0] - site.weight[1];
      }
      if (free(present, fresh, site)) return true;
    }
    return false;
  }

  std::mt19937 random_;
  std::vector<hf_test::EngineKind> engines_;         // of the fields
  std::vector<std::uint32_t> vertices_, triangles_;  // usable ones, as given
};

}  // namespace hf_test
