// Damaged shared models: no variant fails, and no vertex is without weights. The quick form takes one variant of each
// model, HF_FULL_TESTS 1,000 in all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>

#include "gltf/gltf_read.h"
#include "support/full.h"
#include "unit/gltf/gltf_support.h"
#include "weights/rig.h"

namespace {

using namespace samples;
using namespace hf_gltf;
using samples_test::shared_data;

struct Variant {
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  hf::Joints bones;
  std::string damage;  // what was done
};

class Damage {
 public:
  Damage(const Rig& rig, uint32_t seed) : random_(seed), size_(rig.diagonal) {
    for (const glm::dvec3& p : rig.positions) made_.positions.insert(made_.positions.end(), {p.x, p.y, p.z});
    made_.triangles = rig.triangles;
    made_.bones = rig.bones;
    if (chance(3)) specks();
    if (chance(3)) doubled();
    if (chance(3)) shell();
    if (chance(2)) cut();
    if (chance(2)) flip(chance(4));
    if (chance(3)) move();
    if (chance(3)) needles();
    if (chance(4)) hole_in_bones();
    if (chance(3)) scale();
  }
  Variant take() { return std::move(made_); }

 private:
  bool chance(uint32_t of) { return random_() % of == 0; }
  double any() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  void did(const char* what) { made_.damage += std::string(made_.damage.empty() ? "" : ", ") + what; }
  uint32_t vertex_count() const { return static_cast<uint32_t>(made_.positions.size() / 3); }
  uint32_t add(const glm::dvec3& p) {
    made_.positions.insert(made_.positions.end(), {p.x, p.y, p.z});
    return vertex_count() - 1;
  }
  glm::dvec3 at(uint32_t v) const {
    return {made_.positions[3 * v], made_.positions[3 * v + 1], made_.positions[3 * v + 2]};
  }
  uint32_t any_vertex() { return static_cast<uint32_t>(random_() % vertex_count()); }

  // Small tetrahedra beside the skin.
  void specks() {
    did("specks");
    for (int i = 0; i < 6; ++i) {
      const glm::dvec3 place = at(any_vertex()) + 0.3 * size_ * glm::dvec3(any(), any(), any());
      uint32_t v[4];
      for (uint32_t& corner : v) corner = add(place + 0.002 * size_ * glm::dvec3(any(), any(), any()));
      made_.triangles.insert(made_.triangles.end(),
                             {v[0], v[1], v[2], v[0], v[2], v[3], v[0], v[3], v[1], v[1], v[3], v[2]});
    }
  }
  void doubled() {
    did("doubled faces");
    const std::vector<uint32_t> once = made_.triangles;
    made_.triangles.insert(made_.triangles.end(), once.begin(), once.end());
  }
  // The whole skin again, a little smaller.
  void shell() {
    did("a shell");
    const uint32_t first = vertex_count();
    const size_t once = made_.triangles.size();
    const glm::dvec3 middle = at(any_vertex());
    for (uint32_t v = 0; v < first; ++v) add(middle + 0.97 * (at(v) - middle));
    for (size_t i = 0; i < once; ++i) made_.triangles.push_back(first + made_.triangles[i]);
  }
  void cut() {
    did("holes");
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < made_.triangles.size(); t += 3) {
      if (!chance(9)) kept.insert(kept.end(), {made_.triangles[t], made_.triangles[t + 1], made_.triangles[t + 2]});
    }
    made_.triangles = kept;
  }
  void flip(bool all) {
    did(all ? "inside out" : "flipped triangles");
    for (size_t t = 0; t < made_.triangles.size(); t += 3) {
      if (all || chance(5)) std::swap(made_.triangles[t + 1], made_.triangles[t + 2]);
    }
  }
  void move() {
    did("moved vertices");
    for (double& x : made_.positions) {
      if (chance(40)) x += 0.1 * size_ * any();
    }
  }
  void needles() {
    did("needles");
    for (int i = 0; i < 8; ++i) {
      const uint32_t a = any_vertex(), b = any_vertex();
      const uint32_t tip = add(0.5 * (at(a) + at(b)) + 1e-9 * size_ * glm::dvec3(any(), any(), any()));
      made_.triangles.insert(made_.triangles.end(), {a, b, tip, a, a, tip});
    }
  }
  // Bones outside, without length, on each other; heads and axes only, so the library has to find the tails.
  void hole_in_bones() {
    did("bones");
    const size_t count = made_.bones.heads.size() / 3;
    for (size_t b = 0; b < count; ++b) {
      const size_t other = random_() % count;
      const double far = chance(20) ? 1e6 : 1;
      const bool onto = chance(6), away = chance(6);
      for (size_t c = 0; c < 3; ++c) {
        double& x = made_.bones.heads[3 * b + c];
        if (onto) x = made_.bones.heads[3 * other + c];
        if (away) x += far * size_ * any();
        if (!made_.bones.axes.empty() && chance(12)) made_.bones.axes[3 * b + c] = 0;
      }
    }
  }
  void scale() {
    const double factor = std::pow(10.0, 6 * any());
    did("another scale");
    for (double& x : made_.positions) x *= factor;
    for (double& x : made_.bones.heads) x *= factor;
  }

  std::mt19937 random_;
  double size_;
  Variant made_;
};

size_t faults_of(const hf::WeightsOut& found, const hf::Joints& bones) {
  size_t faults = 0;
  for (size_t v = 0; v < found.origins.size(); ++v) {
    float sum = 0;
    bool good = true;
    for (size_t i = v * found.influence_count; i < (v + 1) * found.influence_count; ++i) {
      good &= found.joints[i] < bones.heads.size() / 3 && found.weights[i] >= 0;
      good &= !(found.weights[i] > 0) || bones.deforms[found.joints[i]] == 1;
      sum += found.weights[i];
    }
    faults += !(good && sum == 1.0f);
  }
  return faults;
}

TEST(DamagedModels, NoVariantFailsAndNoVertexIsBare) {
  HF_NEED_SHARED_DATA();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "gltf")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Rig> rigs;
  std::vector<std::string> names;
  for (const auto& file : files) {
    if (file.extension() != ".glb") continue;
    try {
      const Model model = read_gltf(file);
      if (!model.skins.empty()) {
        rigs.push_back(read_rig(model));
        names.push_back(file.stem().string());
      }
    } catch (const std::runtime_error&) {  // compressed files, and a skeleton without a mesh
    }
  }
  ASSERT_GE(rigs.size(), 28u);
  constexpr size_t all_variants = 1000;
  const size_t count = hf_test::is_full() ? all_variants : rigs.size();
  size_t failed = 0, vertices = 0;
  std::map<std::string, size_t> damages;
  for (size_t i = 0; i < count; ++i) {
    const size_t m = i % rigs.size();
    const Variant variant = Damage(rigs[m], static_cast<uint32_t>(i)).take();
    const std::string where = names[m] + ", variant " + std::to_string(i) + ": " + variant.damage;
    try {
      auto desc = hf::make<hf_surface_desc>();
      desc.positions = HF_ARRAY(variant.positions.data(), variant.positions.size() / 3);
      desc.triangles = HF_ARRAY(variant.triangles.data(), variant.triangles.size() / 3);
      const hf::Surface surface(desc);
      const hf::Weights weights(surface, variant.bones, i % 2 ? 4 : 8);
      const hf::WeightsOut found = weights.weights();
      const size_t faults = faults_of(found, variant.bones);
      EXPECT_EQ(faults, 0u) << where;
      failed += faults > 0;
      vertices += found.origins.size();
    } catch (const hf::Error& error) {
      ADD_FAILURE() << where << ": " << error.what();
      ++failed;
    }
    for (size_t begin = 0; begin < variant.damage.size();) {
      const size_t end = std::min(variant.damage.find(", ", begin), variant.damage.size());
      ++damages[variant.damage.substr(begin, end - begin)];
      begin = end + 2;
    }
  }
  std::printf("%zu variants of %zu models, %zu vertices: %zu failed;", count, rigs.size(), vertices, failed);
  for (const auto& [name, times] : damages) std::printf(" %s %zu", name.c_str(), times);
  std::printf("\n");
}

}  // namespace
