// Damaged glTF files, from bytes to field. Usage: reliability_gltf [--full] [--count N] [--first I] [--file PATH]
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <string>

#include "gltf_mutate.h"
#include "gltf_player.h"
#include "report.h"

#if defined(__SANITIZE_ADDRESS__)
// forbids large allocations, and keeps the sanitizer's quarantine small
extern "C" const char* __asan_default_options(void);
extern "C" const char* __asan_default_options(void) { return "quarantine_size_mb=8:max_allocation_size_mb=512"; }
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

int main(int argc, char** argv) {
  std::uint64_t count = 40000, first = 0;
  if (report_full(argc, argv)) count = 300000;
  std::vector<hostile::File> seeds = hostile::made_seeds();
  std::uint64_t used = 0, solved = 0, wrong = 0, executions = 0, sound = 0;
  for (const hostile::File& seed : seeds) sound += hostile::play_gltf(seed).solved;
  const std::size_t own = seeds.size();
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--count") count = std::stoull(argv[i + 1]);
    if (option == "--first") first = std::stoull(argv[i + 1]);
    if (option == "--file") {
      std::ifstream in(argv[i + 1], std::ios::binary);
      const hostile::File file((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      const hostile::Outcome outcome = hostile::play_gltf(file);
      std::printf("%d %s\n", static_cast<int>(outcome.ending), outcome.what.c_str());
      return outcome.ending == hostile::Ending::wrong;
    }
  }
  for (hostile::File& file : hostile::shared_seeds(16384)) seeds.push_back(std::move(file));
  std::printf("%zu seeds, %zu of them made here\n", seeds.size(), own);
  double slowest = 0;
  for (std::uint64_t i = first; i < first + count; ++i) {
    hostile::Random random(i * 0x9E3779B97F4A7C15u + 7);
    // three in four mutate the valid files made here
    const hostile::File& seed = seeds[random() % 4 ? random() % own : random() % seeds.size()];
    const hostile::File file = hostile::mutate(seed, seeds[random() % seeds.size()], random);
    const double start = hostile::processor_seconds();
    const hostile::Outcome outcome = hostile::play_gltf(file);
    slowest = std::max(slowest, hostile::processor_seconds() - start);
    ++executions;
    used += outcome.ending == hostile::Ending::used;
    solved += outcome.solved;
    if (outcome.ending != hostile::Ending::wrong) continue;
    std::fprintf(stderr, "file %" PRIu64 ": %s\n", i, outcome.what.c_str());
    const std::string name = "wrong_" + std::to_string(i) + ".glb";
    std::ofstream(name, std::ios::binary)
        .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    std::fprintf(stderr, "  kept as %s\n", name.c_str());
    if (++wrong > 10) break;
  }
  std::printf("%" PRIu64 " used, %" PRIu64 " of them solved, %" PRIu64 " refused%s\n", used, solved,
              executions - used - wrong, sanitized ? ", sanitized" : "");
  report_at_least("gltf_seeds_solved", static_cast<double>(sound), static_cast<double>(own));
  report_at_least("gltf_executed", static_cast<double>(executions), static_cast<double>(count));
  report_at_least("gltf_solved", static_cast<double>(solved), 0.1 * static_cast<double>(count));
  report_at_most("gltf_wrong", static_cast<double>(wrong), 0);
  report_at_most("gltf_slowest_s", slowest, 1);
  // AddressSanitizer takes some 450 MB; its builds limit single allocations instead (above)
  if (!sanitized) report_at_most("gltf_memory_mb", hostile::peak_memory(), 512);
  return report_status();
}
