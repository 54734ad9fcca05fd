// Random numbers, hashes, the allocator and the small meshes of unchanged.h.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "headed_blocks.h"
#include "unchanged.h"

namespace unchanged {
namespace {

void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  ++a.calls;
  if (a.cancel_at && a.calls == a.cancel_at) hf_progress_cancel(a.progress);
  // the library asks again for what it did not get, when it has given back the blocks it kept: that is the same refusal
  const bool again = a.refused > 0 && a.calls == a.refuse_at + 1 && size == a.refused_size;
  if (a.refuse_at && (a.calls == a.refuse_at || again || (a.refuse_on && a.calls > a.refuse_at))) {
    a.refused_size = size;
    return ++a.refused, nullptr;
  }
  ++a.live_blocks;
  a.live_bytes += size;
  a.numeric_bytes += alignment == 64 ? size : 0;
  return reliability::take_block(size, alignment);
}

void release(void* user, void* block, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  const reliability::BlockHead head = reliability::give_block(block);
  a.mismatches += head.size != size || head.alignment != alignment;
  --a.live_blocks;
  a.live_bytes -= head.size;
  a.numeric_bytes -= head.alignment == 64 ? head.size : 0;
}

void add_sheet(Shape& shape, std::uint32_t columns, std::uint32_t rows, float x0) {
  const std::uint32_t base = shape.vertices(), width = columns + 1;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const float x = x0 + static_cast<float>(i), y = static_cast<float>(j);
      shape.positions.insert(shape.positions.end(), {x, y, 0.25f * std::sin(1.3f * x) * std::cos(0.9f * y)});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = base + j * width + i, b = a + 1, c = a + width, d = c + 1;
      shape.triangles.insert(shape.triangles.end(), {a, b, d, a, d, c});
    }
  }
}

// around x along vertices on a ring (radius 0: a straight tube).
Shape round_shape(std::uint32_t around, std::uint32_t along, double radius) {
  Shape shape;
  const double turn = 6.283185307179586;
  for (std::uint32_t r = 0; r < along; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double u = turn * i / around, v = turn * r / along, d = radius + (1 + 0.1 * std::sin(3 * v)) * std::cos(u);
      const double x = radius > 0 ? d * std::cos(v) : std::cos(u), y = radius > 0 ? d * std::sin(v) : 0.8 * r;
      for (const double p : {x, y, std::sin(u)}) shape.positions.push_back(static_cast<float>(p));
    }
  }
  for (std::uint32_t r = 0; r + (radius > 0 ? 0 : 1) < along; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t next = (r + 1) % along, j = (i + 1) % around, a = r * around + i, b = r * around + j,
                          c = next * around + i, d = next * around + j;
      shape.triangles.insert(shape.triangles.end(), {a, c, b, b, c, d});
    }
  }
  return shape;
}

}  // namespace

double Random::number() {
  if (one_in(40)) {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL, 1e300, -1e-300};
    return bad[below(5)];
  }
  return one_in(6) ? 0.0 : real(-3, 3);
}

void State::add(const void* bytes, std::size_t size) {
  std::uint64_t& hash = parts_.back().second;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211u;
}

std::string State::difference(const State& other) const {
  for (std::size_t i = 0; i < parts_.size() && i < other.parts_.size(); ++i) {
    if (parts_[i] != other.parts_[i]) return parts_[i].first;
  }
  return parts_.size() == other.parts_.size() ? std::string() : std::string("the number of parts");
}

hf_allocator Allocator::hooks() {
  hf_allocator given;
  given.allocate = allocate;
  given.release = release;
  given.user = this;
  return given;
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> made = [] {
    std::vector<Shape> list(2);
    add_sheet(list[0], 7, 6, 0);
    add_sheet(list[1], 4, 4, 0);
    add_sheet(list[1], 4, 4, 4);
    add_sheet(list[1], 2, 2, 20);
    list[1].positions.insert(list[1].positions.end(), {30, 1, 2});  // isolated
    list.push_back(round_shape(7, 11, 3));
    list.push_back(round_shape(8, 9, 0));
    // without symmetries, where rounding decides which of two equal clusters counts
    Random random(7);
    for (float& p : list[0].positions) p += static_cast<float>(random.real(-0.1, 0.1));
    for (std::size_t i = 2; i < list.size(); ++i) {
      for (float& p : list[i].positions) p += static_cast<float>(random.real(-0.1, 0.1));
    }
    return list;
  }();
  return made;
}

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.2g", value);
  return digits;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double most = 0, scale = 1e-300;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) return HUGE_VAL;
    most = std::fmax(most, std::fabs(a[i] - b[i]));
    scale = std::fmax(scale, std::fabs(a[i]));
  }
  return most / scale;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"solvers", make_solvers, 0.22},       {"poses", make_poses, 0.12},
                                        {"transfers", make_transfers, 0.14},   {"regions", make_regions, 0.14},
                                        {"directions", make_directions, 0.14}, {"analysis", make_analysis, 0.1},
                                        {"quads", make_quads, 0.04},           {"weights", make_weights, 0.1}};
  return all;
}

}  // namespace unchanged
