// Levels of detail of the creatures with carried weights, played over their walks, against the best weights there are.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "carry_support.h"
#include "mesh/nearest_triangle.h"
#include "support/decimate.h"
#include "support/full.h"

namespace {

using namespace hf_test;

using Matrix = std::array<double, 12>;  // rows of a 3 x 4 matrix

// The motions of all joints from rest, in some frames of all clips.
std::vector<std::vector<Matrix>> motions(const Body& body, int frames) {
  std::vector<std::vector<Matrix>> out;
  for (const samples::Clip& clip : body.creature.clips) {
    for (int f = 0; f < frames; ++f) {
      const std::vector<double> world = samples::clip_pose(body.creature, clip, clip.duration() * f / frames);
      std::vector<Matrix> joints(body.heads.size());
      for (std::size_t j = 0; j < joints.size(); ++j) {
        const double* m = world.data() + 16 * j;
        for (std::size_t r = 0; r < 3; ++r) {
          double moved = m[12 + r];
          for (std::size_t c = 0; c < 3; ++c) {
            joints[j][4 * r + c] = m[4 * c + r];
            moved -= m[4 * c + r] * body.heads[j][c];
          }
          joints[j][4 * r + 3] = moved;  // rest rotations are none
        }
      }
      out.push_back(std::move(joints));
    }
  }
  return out;
}

hf_inner::Vec3 moved(const Matrix& m, const double* p) {
  return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
          m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
}

// The posed fine surface, and where the coarse one puts the points that are nearest to it at rest.
class Fit {
 public:
  Fit(const Body& body, const PlainMesh& coarse, const hf_inner::surface::Core& core) : joints_(body.heads.size()) {
    const auto frames = motions(body, 6);
    frames_ = frames.size();
    coarse_ = coarse.vertex_count();
    const hf_inner::mesh::NearestTriangle tree(core.mesh.positions, core.mesh.corners, *core.memory);
    for (std::size_t v = 0; v < body.mesh.vertex_count(); ++v) {
      const double* p = body.mesh.positions.data() + 3 * v;
      const auto found = tree.find(core.mesh.to_inner({p[0], p[1], p[2]}));
      Place place;
      tree.weights(core.mesh.to_inner({p[0], p[1], p[2]}), found.triangle, place.share);
      for (int k = 0; k < 3; ++k)
        place.corner[k] = at(core.mesh.given_of_inner[at(core.mesh.triangle(found.triangle)[k])]);
      places_.push_back(place);
    }
    for (const auto& joints : frames) {
      for (std::size_t v = 0; v < coarse_; ++v) {
        for (std::size_t j = 0; j < joints_; ++j) reach_.push_back(moved(joints[j], coarse.positions.data() + 3 * v));
      }
      for (std::size_t v = 0; v < places_.size(); ++v) {
        hf_inner::Vec3 sum;
        for (std::size_t k = 0; k < 4; ++k) {
          const double w = static_cast<double>(body.weights[4 * v + k]);
          if (w > 0) sum = sum + w * moved(joints[body.joints[4 * v + k]], body.mesh.positions.data() + 3 * v);
        }
        wanted_.push_back(sum);
      }
    }
  }
  std::size_t size() const { return coarse_ * joints_; }
  // Half the sum of the squared distances; gradient: null, or receives it.
  double energy(const std::vector<double>& weights, std::vector<double>* gradient) const {
    if (gradient) gradient->assign(size(), 0.0);
    std::vector<hf_inner::Vec3> posed(coarse_), pull(coarse_);
    double sum = 0;
    for (std::size_t f = 0; f < frames_; ++f) {
      const hf_inner::Vec3* reach = reach_.data() + f * size();
      for (std::size_t v = 0; v < coarse_; ++v) {
        posed[v] = pull[v] = {};
        for (std::size_t j = 0; j < joints_; ++j) {
          if (weights[v * joints_ + j] != 0) posed[v] = posed[v] + weights[v * joints_ + j] * reach[v * joints_ + j];
        }
      }
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& p = places_[i];
        hf_inner::Vec3 off = -1.0 * wanted_[f * places_.size() + i];
        for (int k = 0; k < 3; ++k) off = off + p.share[k] * posed[p.corner[k]];
        sum += 0.5 * dot(off, off);
        for (int k = 0; k < 3; ++k) pull[p.corner[k]] = pull[p.corner[k]] + p.share[k] * off;
      }
      for (std::size_t i = 0; gradient && i < size(); ++i) (*gradient)[i] += dot(pull[i / joints_], reach[i]);
    }
    return sum;
  }
  // The best weights of sum 1 and at least 0, of any number of joints: projected gradients with momentum.
  std::vector<double> best(std::vector<double> weights, int steps) const {
    std::vector<double> gradient, ahead = weights, next;
    double step = 1, momentum = 1, now = energy(weights, nullptr);
    for (int s = 0; s < steps; ++s) {
      const double there = energy(ahead, &gradient);
      for (;;) {  // a step that the energy's curvature allows
        next = ahead;
        for (std::size_t i = 0; i < next.size(); ++i) next[i] -= step * gradient[i];
        for (std::size_t v = 0; v < coarse_; ++v) project(next.data() + v * joints_);
        double model = there;
        for (std::size_t i = 0; i < next.size(); ++i) {
          const double d = next[i] - ahead[i];
          model += gradient[i] * d + d * d / (2 * step);
        }
        if (energy(next, nullptr) <= model * (1 + 1e-12)) break;
        step *= 0.5;
      }
      const double reached = energy(next, nullptr);
      const double faster = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
      const bool down = reached <= now;
      for (std::size_t i = 0; i < ahead.size(); ++i)
        ahead[i] = down ? next[i] + (momentum - 1) / faster * (next[i] - weights[i]) : weights[i];
      momentum = down ? faster : 1;
      if (down) {
        weights = next;
        now = reached;
      }
    }
    return weights;
  }

 private:
  struct Place {
    std::size_t corner[3];
    double share[3];
  };
  // The nearest point of the simplex.
  void project(double* w) const {
    std::vector<double> sorted(w, w + joints_);
    std::sort(sorted.begin(), sorted.end(), std::greater<double>());
    double sum = 0, shift = 0;
    for (std::size_t j = 0; j < joints_; ++j) {
      sum += sorted[j];
      const double here = (sum - 1) / static_cast<double>(j + 1);
      if (sorted[j] > here) shift = here;
    }
    for (std::size_t j = 0; j < joints_; ++j) w[j] = std::max(w[j] - shift, 0.0);
  }
  std::size_t joints_, frames_ = 0, coarse_ = 0;
  std::vector<Place> places_;
  std::vector<hf_inner::Vec3> reach_, wanted_;
};

// The quick form takes one creature at one level, HF_FULL_TESTS all of them.
TEST(CarriedLevels, PoseWithinASmallFactorOfTheBestFit) {
  const bool full = hf_test::is_full();
  const std::vector<const char*> names =
      full ? std::vector<const char*>{"biped", "horse", "bull"} : std::vector<const char*>{"horse"};
  for (const char* name : names) {
    const Body body = make_body(name, 1000);
    const auto source = make_core(body.mesh);
    for (const double share : full ? std::vector<double>{0.5, 0.25, 0.1} : std::vector<double>{0.25}) {
      const PlainMesh coarse =
          Decimator(body.mesh).down_to(static_cast<std::uint32_t>(share * body.mesh.vertex_count()));
      ASSERT_NEAR(coarse.vertex_count(), share * body.mesh.vertex_count(), 2);
      const auto core = make_core(coarse);
      const hf_inner::weights::FilledWeights found = carry(source, body.given(), core);
      ASSERT_EQ(faults_of(found, at(core->size()), body.heads.size()), 0u);
      const Fit fit(body, coarse, *core);
      std::vector<double> weights(fit.size(), 0.0);
      for (Index v = 0; v < core->size(); ++v) {
        for (std::size_t j = 0; j < body.heads.size(); ++j)
          weights[at(core->mesh.given_of_inner[at(v)]) * body.heads.size() + j] =
              share_of(found, at(v), static_cast<std::uint32_t>(j));
      }
      const double carried = std::sqrt(fit.energy(weights, nullptr));
      const double best = std::sqrt(fit.energy(fit.best(weights, 300), nullptr));
      std::printf("%s at %.0f %%: %.4f of the best fit; %u matched, %u solved\n", name, 100 * share, carried / best,
                  found.by_origin[6], found.by_origin[1]);
      EXPECT_LE(carried, 1.2 * best) << name << " at " << share;
    }
  }
}

}  // namespace
