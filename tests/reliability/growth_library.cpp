// Surfaces, solvers and handles of the library at growing sizes, through its public functions.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <random>

#include "exact_shapes.h"
#include "growth.h"
#include "hf/hf.h"
#include "support/arrays.h"

namespace growth {
namespace {

void check(hf_result result, const char* what) {
  if (result == HF_OK) return;
  std::fprintf(stderr, "%s: error %d\n", what, static_cast<int>(result));
  std::abort();
}

struct MeshArrays {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
};

MeshArrays sheet(std::size_t vertices) {
  MeshArrays mesh;
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(vertices)));
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double x = i % side, y = i / side;
    mesh.positions.insert(mesh.positions.end(), {x, y, std::sin(0.1 * x) * std::cos(0.13 * y)});
  }
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x;
      mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, a + side, a + 1, a + side + 1, a + side});
    }
  }
  return mesh;
}

// One vertex in all triangles.
MeshArrays fan(std::size_t triangles) {
  MeshArrays mesh;
  mesh.positions = {0, 0, 0};
  const auto count = static_cast<std::uint32_t>(triangles);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count;
    mesh.positions.insert(mesh.positions.end(), {std::cos(angle), std::sin(angle), 0});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % count});
  }
  return mesh;
}

MeshArrays lone_triangles(std::size_t triangles) {
  MeshArrays mesh;
  for (std::size_t i = 0; i < triangles; ++i) {
    const double x = 3.0 * static_cast<double>(i % 1000), y = 3.0 * static_cast<double>(i / 1000);
    mesh.positions.insert(mesh.positions.end(), {x, y, 0, x + 1, y, 0, x, y + 1, 0});
    for (std::size_t k = 0; k < 3; ++k) mesh.triangles.push_back(static_cast<std::uint32_t>(3 * i + k));
  }
  return mesh;
}

// Triangles between random vertices, 90 for each, all through each other.
MeshArrays soup(std::size_t triangles) {
  MeshArrays mesh;
  std::mt19937 random(1);
  const auto vertices = static_cast<std::uint32_t>(triangles / 90);
  for (std::uint32_t i = 0; i < 3 * vertices; ++i)
    mesh.positions.push_back(1e-3 * static_cast<double>(random() % 1000));
  while (mesh.triangles.size() < 3 * triangles) {
    const auto a = static_cast<std::uint32_t>(random() % vertices), b = static_cast<std::uint32_t>(random() % vertices),
               c = static_cast<std::uint32_t>(random() % vertices);
    if (a != b && b != c && c != a) mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
  }
  return mesh;
}

hf_surface surface_of(const MeshArrays& mesh, std::int32_t field_kind = HF_FIELD_HARMONIC) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.field_kind = field_kind;
  desc.positions = HF_ARRAY(mesh.positions.data(), mesh.positions.size() / 3);
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  desc.allocator.allocate = [](void*, std::size_t bytes, std::size_t alignment) {
    return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
  };
  desc.allocator.release = [](void*, void* block, std::size_t, std::size_t alignment) {
    ::operator delete(block, std::align_val_t(alignment));
  };
  hf_surface surface = nullptr;
  check(hf_surface_create(&desc, &surface), "hf_surface_create");
  return surface;
}

hf_solver solver_of(hf_surface surface, std::int32_t field_kind = HF_FIELD_HARMONIC) {
  hf_solver solver = nullptr;
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.field_kind = field_kind;
  check(hf_create(surface, &desc, &solver), "hf_create");
  return solver;
}

// A run holds it while it is measured.
struct Scene {
  ~Scene() {
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  hf_surface surface = nullptr;
  hf_solver solver = nullptr;
  std::vector<std::uint32_t> sites;
};

std::shared_ptr<Scene> scene_of(const MeshArrays& mesh) {
  const auto scene = std::make_shared<Scene>();
  scene->surface = surface_of(mesh);
  scene->solver = solver_of(scene->surface);
  return scene;
}

std::uint32_t add_site(hf_solver solver, std::size_t vertex, double value) {
  const auto v = static_cast<std::uint32_t>(vertex);
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = 1;
  desc.vertices = &v;
  desc.values = &value;
  std::uint32_t site = 0;
  check(hf_add_sites(solver, &desc, &site), "hf_add_sites");
  return site;
}

Run create(MeshArrays (*make)(std::size_t)) {
  return [=](std::size_t size) {
    const auto mesh = std::make_shared<MeshArrays>(make(size));
    return [=] { hf_surface_destroy(surface_of(*mesh)); };
  };
}

// A transfer of a soup to itself up to its clusters.
std::function<void()> transfer_soup(std::size_t size) {
  const std::shared_ptr<hf_surface_object> surface(surface_of(soup(size)), hf_surface_destroy);
  return [=] {
    hf_transfer transfer = nullptr;
    check(hf_transfer_create(surface.get(), surface.get(), nullptr, &transfer), "hf_transfer_create");
    const std::uint32_t counts[3] = {1, 1, 1}, vertices[3] = {0, 1, 2};
    hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
    pairs.pair_count = 3;
    pairs.source_counts = pairs.target_counts = counts;
    pairs.source_vertices = pairs.target_vertices = vertices;
    check(hf_transfer_add_pairs(transfer, &pairs, nullptr), "hf_transfer_add_pairs");
    hf_transfer_info info = HF_INIT(hf_transfer_info);
    check(hf_transfer_get_info(transfer, &info), "hf_transfer_get_info");
    hf_transfer_destroy(transfer);
  };
}

// A clone, sites that come and go, back to the clone: the life of an edit on a surface that is there.
Run edits(MeshArrays (*make)(std::size_t)) {
  return [=](std::size_t size) {
    const auto scene = scene_of(make(size));
    return [=] {
      for (int round = 0; round < 4; ++round) {
        hf_solver before = nullptr;
        check(hf_solver_clone(scene->solver, &before), "hf_solver_clone");
        const std::uint32_t first = add_site(scene->solver, 0, 1);
        add_site(scene->solver, size / 2, 0);
        check(hf_remove_sites(scene->solver, 1, &first), "hf_remove_sites");
        hf_solver_destroy(scene->solver);
        scene->solver = before;
      }
    };
  };
}

// A bi-harmonic field around a vertex in all triangles, from the arrays on. Returns it.
std::vector<double> biharmonic_field(const MeshArrays& mesh, const std::vector<std::uint32_t>& vertices,
                                     const std::vector<double>& values) {
  Scene scene;
  scene.surface = surface_of(mesh, HF_FIELD_BIHARMONIC);
  scene.solver = solver_of(scene.surface, HF_FIELD_BIHARMONIC);
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = static_cast<std::uint32_t>(vertices.size());
  desc.vertices = vertices.data();
  desc.values = values.data();
  check(hf_add_sites(scene.solver, &desc, nullptr), "hf_add_sites");
  std::vector<double> field(mesh.positions.size() / 3);
  check(hf_solver_solve(scene.solver, OUT(field.data()), nullptr), "hf_solver_solve");
  hf_certificate certificate = HF_INIT(hf_certificate);
  check(hf_solver_certify(scene.solver, &certificate), "hf_solver_certify");
  return field;
}

std::function<void()> biharmonic_degree(std::size_t size) {
  const auto mesh = std::make_shared<MeshArrays>(fan(size));
  const auto n = static_cast<std::uint32_t>(size);
  return [=] { biharmonic_field(*mesh, {0, 1, 1 + n / 3, 1 + n / 2}, {0, 1, 0.5, -1}); };
}

// Sites one at a time on one mesh, and out again in another order.
std::function<void()> sites(std::size_t size) {
  const auto scene = scene_of(sheet(40000));
  return [=] {
    for (std::size_t i = 0; i < size; ++i) scene->sites.push_back(add_site(scene->solver, i * 37 % 39000, 1));
    for (std::size_t i = 0; i < size; ++i)
      check(hf_remove_sites(scene->solver, 1, &scene->sites[i]), "hf_remove_sites");
  };
}

// A site on each of many components.
std::function<void()> component_sites(std::size_t size) {
  const auto scene = scene_of(lone_triangles(size));
  return [=] {
    for (std::size_t i = 0; i < size; ++i) scene->sites.push_back(add_site(scene->solver, 3 * i, 1));
  };
}

// A clone is kept before every edit.
std::function<void()> kept_clones(std::size_t size) {
  const auto scene = scene_of(sheet(400));
  scene->sites.push_back(add_site(scene->solver, 3, 0));
  return [=] {
    std::vector<hf_solver> kept(size);
    for (std::size_t i = 0; i < size; ++i) {
      const double value = static_cast<double>(i);
      check(hf_solver_clone(scene->solver, &kept[i]), "hf_solver_clone");
      check(hf_solver_set_values(scene->solver, 1, &scene->sites[0], &value), "hf_solver_set_values");
    }
    for (const hf_solver clone : kept) hf_solver_destroy(clone);
  };
}

struct Handles {
  ~Handles() {
    for (const hf_progress handle : live) hf_progress_destroy(handle);
  }
  void make(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      hf_progress handle = nullptr;
      check(hf_progress_create(&handle), "hf_progress_create");
      live.push_back(handle);
    }
  }
  std::vector<hf_progress> live;
};

std::function<void()> create_handles(std::size_t size) {
  return [=] { Handles().make(size); };
}

std::function<void()> find_handles(std::size_t size) {
  const auto handles = std::make_shared<Handles>();
  handles->make(size);
  return [=] {
    double fraction = 0;
    // in the order of multiples of a prime, as a program's calls are not in the order of creation
    for (std::size_t i = 0; i < size; ++i)
      check(hf_progress_get_fraction(handles->live[i * 7919 % size], &fraction), "hf_progress_get_fraction");
  };
}

// One comes and goes while others stay.
std::function<void()> replace_handles(std::size_t size) {
  const auto handles = std::make_shared<Handles>();
  handles->make(size);
  return [=] {
    for (std::size_t i = 0; i < size; ++i) {
      hf_progress& handle = handles->live[i * 7919 % size];
      hf_progress_destroy(handle);
      check(hf_progress_create(&handle), "hf_progress_create");
    }
  };
}

std::vector<std::size_t> doubled(std::size_t least) { return {least, 2 * least, 4 * least, 8 * least}; }

}  // namespace

std::vector<Structure> library_structures(bool full) {
  const std::size_t large = full ? 4 : 1;
  const double most_microseconds = full ? 1 : 2;  // other programs share the processor in the quick form
  const std::vector<std::size_t> many = full ? std::vector<std::size_t>{1000, 10000, 100000, 1000000} : doubled(25000);
  return {
      {"create", doubled(20000 * large), 1.5, create(sheet)},  // the numeric phase of a surface: n^1.5
      {"create_degree", doubled(20000 * large), 1.25, create(fan)},
      {"create_components", doubled(8000 * large), 1.25, create(lone_triangles)},
      {"edit_degree", doubled(20000 * large), 1.25, edits(fan)},
      {"biharmonic_degree", doubled(full ? 12500 : 2500), 1.25, biharmonic_degree},
      {"edit_components", doubled(8000 * large), 1.25, edits(lone_triangles)},
      // every edit adds a row to the dense block of k sites, k^2 numbers; one edit alone never pays for a rebase
      {"sites", doubled(full ? 250 : 75), 3, sites},
      // every edit works on a copy of the lists of sites, so that a refused one changes nothing: 60 ns for each site
      {"component_sites", doubled(full ? 1000 : 500), 2, component_sites},
      {"transfer_soup", doubled(40000), 1.25, transfer_soup},
      {"kept_clones", doubled(5000 * large), 1.25, kept_clones},
      {"handle_create", many, 1.25, create_handles, most_microseconds},
      {"handle_find", many, 1.25, find_handles, most_microseconds},
      {"handle_replace", many, 1.25, replace_handles},
  };
}

HighValence high_valence_fan() {
  const reliability::ExactShape shape = reliability::exact_fan(100000, HF_FIELD_BIHARMONIC);
  const MeshArrays mesh = {shape.positions, shape.triangles};
  HighValence found;
  const std::size_t before = held_bytes();
  reset_most_bytes();
  const double begin = thread_seconds();
  const std::vector<double> field = biharmonic_field(mesh, shape.sites, shape.values);
  found.seconds = thread_seconds() - begin;
  found.megabytes = static_cast<double>(most_bytes() - before) / 1e6;
  for (std::size_t v = 0; v < field.size(); ++v)
    found.error = std::max(found.error, std::fabs(field[v] - shape.exact[v]) / 2);  // values are 1 to -1
  return found;
}

}  // namespace growth
