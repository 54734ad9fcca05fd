// Poses a crowd that shares one surface, on all threads of the machine, as a renderer with a GPU takes it: one array of
// transforms for all characters, and no vertex. Prints the time beside that of posing every vertex with hf_deform.
// usage: example_crowd [OBJ [CHARACTERS]]
#include <hf/hf.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "mesh.h"

namespace {

// Calls act(i, thread) for every character i, on all threads. An engine uses its own workers, as examples/jobs.cpp
// does.
template <class Act>
void for_each_character(size_t count, unsigned threads, const Act& act) {
  std::atomic<size_t> next{0};
  const auto work = [&](unsigned thread) {
    for (size_t i = next++; i < count; i = next++) act(i, thread);
  };
  std::vector<std::thread> others;
  for (unsigned t = 1; t < threads; ++t) others.emplace_back(work, t);
  work(0);
  for (std::thread& other : others) other.join();
}

template <class Act>
double median_milliseconds(int frames, const Act& act) {
  std::vector<double> times;
  for (int frame = 0; frame < frames; ++frame) {
    const auto begin = std::chrono::steady_clock::now();
    act(frame);
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);  // once for all characters; threads may read it together
  std::vector<hf_pose> crowd(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 100);

  // the first character: handles where hf proposes them. Few groups and bands make frames cheap and clones small
  hf_pose first;
  hf_pose_desc desc = HF_INIT(hf_pose_desc);
  desc.group_count = 60;
  desc.band_count = 5;
  ok(hf_pose_create(surface, &desc, &first));
  hf_handle_proposals_desc few = HF_INIT(hf_handle_proposals_desc);
  few.limit = 8;
  hf_handle_proposal places[8];
  uint32_t place_count = 0, tip = 0;
  ok(hf_surface_propose_handles(surface, &few, 8, places, &place_count));
  for (uint32_t i = 0; i < place_count; ++i)
    ok(hf_pose_add_handle_at(first, places[i].position, places[i].radius, &tip));
  for (hf_pose& pose : crowd) ok(hf_pose_clone(first, &pose));  // shares fields and factors

  hf_blend_info blend = HF_INIT(hf_blend_info);
  ok(hf_pose_get_blend_info(first, &blend));
  const size_t size = 12 * static_cast<size_t>(blend.cluster_count);
  std::vector<float> transforms(size * crowd.size());  // what a frame uploads
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  const auto move = [&](size_t i, int frame) {
    hf_transform moved = {{0, 0, 0, 1}, {0, 0, 0}};
    moved.translation[0] = 0.3 * places[0].length * std::sin(0.1 * frame + 0.7 * static_cast<double>(i));
    ok(hf_pose_set_transform(crowd[i], tip, &moved));
  };
  const double solving = median_milliseconds(20, [&](int frame) {
    for_each_character(crowd.size(), threads, [&](size_t i, unsigned) {
      move(i, frame);
      ok(hf_pose_solve(crowd[i], 1, 0, nullptr));  // a frame goes on from the last one: one iteration will do
      ok(hf_pose_get_blend_transforms(crowd[i], blend.cluster_count, transforms.data() + size * i, nullptr));
    });
  });
  std::vector<std::vector<float>> positions(threads, std::vector<float>(3 * static_cast<size_t>(mesh.vertex_count)));
  const double deforming = median_milliseconds(3, [&](int frame) {
    for_each_character(crowd.size(), threads, [&](size_t i, unsigned thread) {
      move(i, frame);
      ok(hf_deform(crowd[i], positions[thread].data(), nullptr));
    });
  });
  std::printf("%zu characters of %u vertices and %u handles on %u threads\n", crowd.size(), mesh.vertex_count,
              hf_pose_get_handle_count(first), threads);
  std::printf("transforms for a GPU: %.1f ms per frame, %.0f kB; all vertices: %.1f ms\n", solving,
              static_cast<double>(transforms.size() * sizeof(float)) / 1000, deforming);

  for (hf_pose pose : crowd) hf_pose_destroy(pose);
  hf_pose_destroy(first);
  hf_surface_destroy(surface);
  mesh_free(&mesh);
}
