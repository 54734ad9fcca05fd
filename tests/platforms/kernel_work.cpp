// Runs one kernel many times, so that its instructions can be counted: kernel_work KERNEL plain|neon REPETITIONS
// Without arguments it prints the kernels, each with the multiply-adds of one repetition. See instructions.sh.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>

#include "base/memory.h"
#include "deform/bands.h"
#include "deform/blend.h"
#include "deform/blend_rows.h"
#include "deform/rotation_step.h"
#include "factor/kernels.h"
#include "mesh/mesh.h"

namespace {

using hf_inner::factor::Kernels;

double small_number(std::size_t i) { return 1e-3 * static_cast<double>(i * 37 % 101) + 0.01; }

// Arrays that are large enough for every kernel below, filled with small numbers.
struct Data {
  static constexpr int columns = 96, rows = 240, lanes = 32, vertices = 256;
  std::vector<double> below, triangle, z, x, base;
  std::vector<std::int32_t> row;
  std::vector<std::int64_t> target;
  Data()
      : below(columns * rows + 64),
        triangle(columns * (columns + 1) / 2 + 64),
        z((columns + rows) * 8 + 64),
        x(columns * lanes + 64),
        base(rows * lanes + 64) {
    for (std::vector<double>* one : {&below, &triangle, &z, &x, &base}) {
      for (std::size_t i = 0; i < one->size(); ++i) (*one)[i] = small_number(i);
    }
    for (int r = 0; r < rows; ++r) {
      row.push_back(columns + r);
      target.push_back(std::int64_t{r} * lanes);
    }
  }
};

struct Work {
  const char* name;
  double products;  // multiply-adds of one repetition
  void (*run)(const Kernels& k, bool neon, Data& d);
};

template <int Columns, int Channels>
void sweep(const Kernels& k, bool, Data& d) {
  k.backward_rows(d.below.data(), d.row.data(), Data::rows, Columns, 0, Columns, d.z.data(), 0, Channels);
}
template <int Columns, int Channels>
void triangle(const Kernels& k, bool, Data& d) {
  k.backward_triangle(d.triangle.data(), Columns, d.z.data(), Channels);
}
template <int Columns, int Channels>
void narrow(const Kernels& k, bool, Data& d) {
  std::vector<double>& all = d.below;
  k.backward_narrow(all.data(), d.row.data(), Data::rows, Columns, d.z.data(), 0, Channels);
}
template <int Lanes>
void path_rows(const Kernels& k, bool, Data& d) {
  k.path_rows(d.below.data(), Data::rows, Data::columns, d.x.data(), Lanes, d.base.data(), d.target.data());
}
template <int Lanes>
void path_triangle(const Kernels& k, bool, Data& d) {
  k.path_triangle(d.triangle.data(), Data::columns, d.x.data(), Lanes);
}
void forward_triangle(const Kernels& k, bool, Data& d) {
  k.forward_triangle(d.triangle.data(), Data::columns, d.z.data(), 1);
}
void update(const Kernels& k, bool, Data& d) {
  static std::vector<double> matrix(64 * 40 * 40);
  static std::vector<double> panel(8 * 96 * (12 + 30) + 64, 0.01);
  static_cast<void>(d);
  const hf_inner::factor::FrontView front{panel.data(), matrix.data(), Data::columns, Data::rows, 12, 30};
  k.form_update(front, 0, 30);
}

// A blend of blocks of eight vertices that share six clusters: the plain loop of blend.cpp, or the one for NEON.
void blend(const Kernels&, bool neon, Data&) {
  using hf_inner::deform::Affine;
  constexpr int shared = 6, groups = 4, blocks = Data::vertices / 8;
  static hf_inner::Memory memory;
  static hf_inner::mesh::Mesh mesh(memory);
  static hf_inner::deform::ClusterWeights weights(memory);
  static std::vector<hf_inner::Vec3> out(Data::vertices);
  static Affine transforms[shared * groups];
  alignas(64) static double columns[16 * shared * groups];
  if (weights.start.empty()) {
    mesh.positions.assign(Data::vertices, hf_inner::Vec3{0.5, 0.25, 0.125});
    for (int v = 0; v <= Data::vertices; ++v) weights.start.push_back(shared * v);
    for (int b = 0; b <= blocks; ++b) weights.block_start.push_back(shared * b);
    const auto cluster = [](int block, int at) { return static_cast<std::uint16_t>(block % groups * shared + at); };
    for (int v = 0; v < Data::vertices; ++v) {
      for (int at = 0; at < shared; ++at) {
        weights.cluster.push_back(cluster(v / 8, at));
        weights.weight.push_back(0.125f);
        if (v % 8 == 0) {
          weights.block_cluster.push_back(cluster(v / 8, at));
          weights.block_weight.insert(weights.block_weight.end(), 8, 0.125f);
        }
      }
    }
    for (Affine& a : transforms) std::fill(&a.a[0][0], &a.a[0][0] + 12, 0.25);
    std::fill(std::begin(columns), std::end(columns), 0.25);
  }
#if defined(__aarch64__)
  const hf_inner::deform::BlendRows rows{weights.start.data(),
                                         weights.cluster.data(),
                                         weights.weight.data(),
                                         columns,
                                         &mesh.positions.data()->x,
                                         {0.1, 0.2, 0.3},
                                         2.0,
                                         &out[0].x,
                                         weights.block_start.data(),
                                         weights.block_cluster.data(),
                                         weights.block_weight.data()};
  if (neon) return hf_inner::deform::blend_rows_neon(rows, 0, Data::vertices);
#endif
  static_cast<void>(neon);
  for (int v = 0; v < Data::vertices; ++v)
    out[static_cast<std::size_t>(v)] =
        hf_inner::Vec3{0.1, 0.2, 0.3} + 2.0 * hf_inner::deform::blend_vertex(mesh, weights, transforms, v);
}

void rotations(const Kernels&, bool neon, Data&) {
  alignas(64) static double s[72], q[32];
  static bool filled = false;
  for (int i = 0; !filled && i < 72; ++i) s[i] = i / 8 % 4 == 0 ? 1.0 + 0.01 * i : 0.01 * i;
  for (int i = 0; !filled && i < 32; ++i) q[i] = i >= 24 ? 1 : 0;
  filled = true;
  static hf_inner::deform::RotationStep step;
#if defined(__aarch64__)
  if (neon) return hf_inner::deform::step_rotations_neon(s, q, step, false);
#endif
  static_cast<void>(neon);
  hf_inner::deform::step_rotations(s, q, step, false);
}

constexpr double c = Data::columns, r = Data::rows;
const Work works[] = {
    {"sweep_16_columns", 16 * r, narrow<16, 1>},
    {"sweep_32_columns", 32 * r, sweep<32, 1>},
    {"sweep_96_columns", c* r, sweep<96, 1>},
    {"sweep_96_columns_3_fields", 3 * c* r, sweep<96, 3>},
    {"sweep_96_columns_8_fields", 8 * c* r, sweep<96, 8>},
    {"triangle_96_columns", c*(c + 1) / 2, triangle<96, 1>},
    {"triangle_96_columns_8_fields", 8 * c*(c + 1) / 2, triangle<96, 8>},
    {"forward_triangle_96_columns", c*(c + 1) / 2, forward_triangle},
    {"path_rows_8_sites", 8 * c* r, path_rows<8>},
    {"path_rows_32_sites", 32 * c* r, path_rows<32>},
    {"path_triangle_32_sites", 32 * c*(c + 1) / 2, path_triangle<32>},
    {"update_96_columns", c* r* r / 2, update},
    {"blend_6_clusters", 12.0 * 6 * Data::vertices, blend},
    {"rotations", 8 * 60, rotations},
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    for (const Work& work : works) std::printf("%s %.0f\n", work.name, work.products);
    return 0;
  }
  const bool neon = std::strcmp(argv[2], "neon") == 0;
  const Kernels* kernels = neon ? hf_inner::factor::neon_kernels() : hf_inner::factor::plain_kernels();
  if (!kernels) return 77;
  for (const Work& work : works) {
    if (std::strcmp(work.name, argv[1]) != 0) continue;
    Data data;
    for (int i = std::atoi(argv[3]); i > 0; --i) work.run(*kernels, neon, data);
    return 0;
  }
  return 2;
}
