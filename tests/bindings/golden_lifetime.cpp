// Objects of hf.hpp destroyed in any order: calls on what is left go on, and every byte comes back to the allocator.
#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <new>
#include <random>

#include "golden_scene.h"

namespace golden {
namespace {

std::atomic<long long> held{0}, blocks{0};  // bytes and blocks that the library has

void* allocate(void*, size_t size, size_t alignment) {
  held += static_cast<long long>(size);
  ++blocks;
  return ::operator new(size, std::align_val_t(alignment), std::nothrow);
}
void release(void*, void* block, size_t size, size_t alignment) {
  held -= static_cast<long long>(size);
  --blocks;
  ::operator delete(block, std::align_val_t(alignment));
}

}  // namespace

void check_lifetime(const Json& mesh, int rounds) {
  const std::vector<float> positions = mesh["positions"].get<std::vector<float>>();
  const Numbers triangles = mesh["triangles"].get<Numbers>();
  const uint32_t last = static_cast<uint32_t>(positions.size() / 3) - 1;
  std::mt19937 draw(7);
  long long most = 0;
  for (int round = 0; round < rounds; ++round) {
    auto desc = hf::make<hf_surface_desc>();
    desc.positions = HF_ARRAY(positions.data(), last + 1);
    desc.triangles = HF_ARRAY(triangles.data(), triangles.size() / 3);
    desc.allocator.allocate = allocate;
    desc.allocator.release = release;
    auto surface = std::make_shared<hf::Surface>(desc);
    auto solver = std::make_shared<hf::Solver>(*surface);
    solver->add_sites({0, last}, {0.0, 1.0});
    auto clone = std::make_shared<hf::Solver>(solver->clone());
    auto pose = std::make_shared<hf::Pose>(*surface);
    pose->add_handles({{0, 1, 2}, {last - 1, last}});
    auto transfer = std::make_shared<hf::Transfer>(*surface, *surface);
    auto geodesics = std::make_shared<hf::Geodesics>(*surface);
    auto direction = std::make_shared<hf::Direction>(*surface);
    direction->add_sites({0}, {1.0, 0.0, 0.0});
    auto flow = std::make_shared<hf::Flow>(*surface);
    std::vector<std::function<void()>> ends = {
        [&] { solver.reset(); },    [&] { clone.reset(); },     [&] { pose.reset(); }, [&] { transfer.reset(); },
        [&] { geodesics.reset(); }, [&] { direction.reset(); }, [&] { flow.reset(); }, [&] { surface.reset(); }};
    std::shuffle(ends.begin(), ends.end(), draw);
    most = std::max(most, held.load());
    for (const auto& end : ends) {
      end();
      if (clone) expect(clone->solve().size() == last + 1, "a clone goes on");
      if (pose) expect(pose->deform().size() == positions.size(), "a pose goes on");
      if (direction) expect(direction->solve().size() == positions.size(), "a direction field goes on");
      if (geodesics) expect(geodesics->solve_f64({0}).size() == last + 1, "distances go on");
    }
    expect(held == 0 && blocks == 0, std::to_string(held) + " bytes have not come back");
  }
  expect(most > 100000, "the allocator is not the surface's");
}

}  // namespace golden
