// Poses a hundred characters that share one surface, on all threads of the machine. Each character has its own pose.
#include <hf/hf.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include "mesh.h"

namespace {

struct Character {
  hf_pose pose;
  std::vector<float> positions;
};

}  // namespace

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);  // once for all characters; threads may read it together

  hf_pose first;
  uint32_t foot, hip;
  const double size = mesh_pose(&mesh, surface, &first, &foot, &hip);

  std::vector<Character> crowd(100);
  for (Character& character : crowd) {
    ok(hf_pose_clone(first, &character.pose));  // shares the fields and factors of the first pose
    character.positions.resize(3 * static_cast<size_t>(mesh.vertex_count));
  }

  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  const int frames = 20;
  const auto begin = std::chrono::steady_clock::now();
  for (int frame = 0; frame < frames; ++frame) {
    std::atomic<size_t> next{0};
    const auto work = [&] {
      for (size_t i = next++; i < crowd.size(); i = next++) {
        hf_transform moved = {{0, 0, 0, 1}, {0, 0, 0}};
        moved.translation[0] = 0.2 * size * std::sin(0.1 * frame + 0.7 * static_cast<double>(i));
        ok(hf_pose_set_transform(crowd[i].pose, hip, &moved));
        ok(hf_deform(crowd[i].pose, crowd[i].positions.data(), nullptr));
      }
    };
    std::vector<std::thread> others;  // an engine uses its own workers here, as examples/jobs.cpp does
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("100 characters of %u vertices on %u threads: %.1f ms per frame\n", mesh.vertex_count, threads,
              1000 * seconds / frames);

  for (Character& character : crowd) hf_pose_destroy(character.pose);
  hf_pose_destroy(first);
  hf_surface_destroy(surface);
  mesh_free(&mesh);
}
