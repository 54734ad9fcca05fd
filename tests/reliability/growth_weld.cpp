// Welding: every mode, and inputs made to be slow.
#include <cmath>
#include <memory>
#include <random>

#include "growth.h"
#include "mesh/weld.h"

namespace growth {
namespace {

using hf_inner::Vec3;
using hf_inner::mesh::Weld;
using Place = std::function<Vec3(std::size_t i, std::size_t count)>;

std::mt19937 engine(1);
double random(double low, double high) { return low + (high - low) * (engine() / 4294967296.0); }
Vec3 in_box(double side) { return {random(0, side), random(0, side), random(0, side)}; }
Vec3 on_sphere() {
  for (;;) {
    const Vec3 p = in_box(2) - Vec3{1, 1, 1};
    if (const double length = norm(p); length > 0.1 && length < 1) return (1 / length) * p;
  }
}

// The library's default memory, counted by operator new.
void* counting_allocate(void*, std::size_t bytes, std::size_t alignment) {
  return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
}
void counting_release(void*, void* block, std::size_t, std::size_t alignment) {
  ::operator delete(block, std::align_val_t(alignment));
}

Run weld_of(Weld mode, const Place& place) {
  return [=](std::size_t size) {
    const auto points = std::make_shared<std::vector<Vec3>>(size);
    engine.seed(1);
    for (std::size_t i = 0; i < size; ++i) (*points)[i] = place(i, size);
    return [=] {
      hf_inner::mesh::MeshInput input;
      input.vertex_count = static_cast<std::uint32_t>(points->size());
      input.positions = hf_inner::ConstRows(&points->data()->x, sizeof(Vec3));
      input.weld = mode;
      input.weld_tolerance = 1;
      hf_allocator hooks{};
      hooks.allocate = counting_allocate;
      hooks.release = counting_release;
      hf_inner::Memory memory(hooks);
      hf_inner::mesh::weld(input, memory);
    };
  };
}

}  // namespace

std::vector<Structure> weld_structures(bool full) {
  const std::size_t n = full ? 40000 : 10000;
  const std::vector<std::size_t> sizes = {n, 2 * n, 4 * n, 8 * n};
  const Vec3 axis{2.0 / 3, 2.0 / 3, 1.0 / 3}, u{-2.0 / 3, 1.0 / 3, 2.0 / 3}, w{1.0 / 3, -2.0 / 3, 2.0 / 3};
  const Place scattered = [](std::size_t, std::size_t count) { return in_box(std::cbrt(static_cast<double>(count))); };
  // the exact weld is one access to its table for each vertex: leaving the processor's cache is a step of its own
  const auto named = [&](const char* name, Weld mode, const Place& place) {
    return Structure{std::string("weld_") + name, sizes, mode == Weld::exact ? 1.6 : 1.25, weld_of(mode, place)};
  };
  // without a weld only numbers are written: sizes that a clock can measure and no cache holds
  Structure none = named("none", Weld::none, scattered);
  for (std::size_t& size : none.sizes) size *= 25;
  return {
      none,
      named("exact", Weld::exact, scattered),
      named("exact_copies", Weld::exact,
            [](std::size_t i, std::size_t count) {
              return Vec3{static_cast<double>(i % (count / 6)), 0, 0};
            }),
      named("tolerance", Weld::tolerance, scattered),
      named("tolerance_one_cell", Weld::tolerance, [](std::size_t, std::size_t) { return in_box(0.3); }),
      named("tolerance_few_cells", Weld::tolerance, [](std::size_t, std::size_t) { return in_box(4); }),
      named("tolerance_copies", Weld::tolerance,
            [](std::size_t i, std::size_t) {
              return Vec3{static_cast<double>(i % 7), 0, 0};
            }),
      named("tolerance_grid", Weld::tolerance,
            [](std::size_t i, std::size_t count) {
              const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(count)));
              return Vec3{static_cast<double>(i % side), static_cast<double>(i / side % side),
                          static_cast<double>(i / side / side)};
            }),
      named("tolerance_clusters", Weld::tolerance,
            [](std::size_t i, std::size_t) {
              return Vec3{1.01 * static_cast<double>(i % 4), 1.01 * static_cast<double>(i / 4 % 4), 0} + in_box(1e-3);
            }),
      named("tolerance_sheets", Weld::tolerance,
            [=](std::size_t i, std::size_t) {
              return random(0, .5) * u + random(0, .5) * w + (i % 2 ? 1 + 1e-9 : 0) * axis;
            }),
      named("tolerance_shells", Weld::tolerance,
            [](std::size_t i, std::size_t) { return (i % 2 ? 1.5000001 : 0.5) * on_sphere(); }),
      named("tolerance_speck", Weld::tolerance,
            [](std::size_t i, std::size_t) { return (i % 2 ? 1 + 1e-6 : 1e-9) * on_sphere(); }),
      named("tolerance_wheel", Weld::tolerance,
            [=](std::size_t i, std::size_t) {
              const double angle = random(0, 6.28), radius = 1 + 1e-10;
              return i % 2 ? radius * (std::cos(angle) * u + std::sin(angle) * w) : random(-1e-3, 1e-3) * axis;
            }),
  };
}

}  // namespace growth
