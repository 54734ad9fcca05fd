// Reads and solves a corpus of hostile files, and watches every name that the process opens. The files are truncated,
// have flipped bytes or nonsense in their JSON, or hold URIs that point out of their folder. Damaged meshes in other
// formats and the optional shared corpus follow. Usage: reliability_hostile [--full]
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "common/mesh_file.h"
#include "gltf_mutate.h"
#include "gltf_player.h"
#include "open_watch.h"
#include "report.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;

struct Tally {
  std::size_t files = 0, used = 0, refused = 0, wrong = 0, outside = 0;
  double slowest = 0;
  std::size_t seen = 0;  // opened names

  // folder: all opened files must be in it.
  void count(const fs::path& file, const fs::path& folder) {
    hostile::opened();
    const double start = hostile::processor_seconds();
    const hostile::Outcome outcome = hostile::play_file(file);
    slowest = std::max(slowest, hostile::processor_seconds() - start);
    ++files;
    used += outcome.ending == hostile::Ending::used;
    refused += outcome.ending == hostile::Ending::refused;
    if (outcome.ending == hostile::Ending::wrong) {
      ++wrong;
      std::fprintf(stderr, "%s: %s\n", file.c_str(), outcome.what.c_str());
    }
    const std::string below = fs::canonical(folder).string() + "/";
    for (const std::string& name : hostile::opened()) {
      ++seen;
      if (name.compare(0, below.size(), below) == 0) continue;
      ++outside;
      std::fprintf(stderr, "%s: opened %s\n", file.c_str(), name.c_str());
    }
  }
};

void write(const fs::path& file, const hostile::File& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

const char* extension_of(const hostile::File& file) { return !file.empty() && file[0] == 'g' ? ".glb" : ".gltf"; }

// Truncates each seed at up to `most` places, and flips a bit at each of them.
void damage(const fs::path& folder, std::size_t most, Tally& tally) {
  for (const hostile::File& seed : hostile::made_seeds()) {
    const fs::path file = folder / (std::string("damaged") + extension_of(seed));
    const std::size_t step = std::max<std::size_t>(1, seed.size() / most);
    for (std::size_t at = 0; at < seed.size(); at += step) {
      hostile::File bad(seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(at));
      write(file, bad);
      tally.count(file, folder);
      bad = seed;
      bad[at] = static_cast<std::uint8_t>(bad[at] ^ (1u << at % 8));
      write(file, bad);
      tally.count(file, folder);
    }
  }
}

void nonsense(const fs::path& folder, std::size_t count, Tally& tally) {
  const std::vector<hostile::File> seeds = hostile::made_seeds();
  for (std::size_t i = 0; i < count; ++i) {
    hostile::Random random(i + 5);
    const hostile::File bad = hostile::mutate(seeds[i % seeds.size()], seeds[random() % seeds.size()], random);
    const fs::path file = folder / (std::string("nonsense") + extension_of(seeds[i % seeds.size()]));
    write(file, bad);
    tally.count(file, folder);
  }
}

// Damaged meshes in the other formats.
void surfaces(const fs::path& folder, std::size_t count, Tally& tally) {
  samples::SurfaceMesh mesh;
  for (int v = 0; v < 16; ++v) mesh.positions.emplace_back(v % 4, v / 4, 0.25 * (v * 5 % 3));
  for (std::uint32_t v = 0; v < 11; ++v) {
    if (v % 4 != 3) mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 5, v, v + 5, v + 4});
  }
  hostile::Random random(23);
  for (const char* extension : {".obj", ".off", ".ply"}) {
    const fs::path good = folder / (std::string("good") + extension), file = folder / (std::string("bad") + extension);
    samples::write_mesh_file(mesh, good);
    tally.count(good, folder);
    std::ifstream in(good, std::ios::binary);
    const hostile::File bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (std::size_t i = 0; i < count; ++i) {
      hostile::File bad = bytes;
      for (std::size_t n = 0; n < 1 + i % 4; ++n)
        bad[random() % bad.size()] = static_cast<std::uint8_t>(
            i % 2 ? random() : static_cast<unsigned char>("0123456789-+.e/ \n"[random() % 17]));
      if (i % 8 == 0) bad.resize(random() % bad.size());
      write(file, bad);
      tally.count(file, folder);
    }
  }
}

// Text files whose buffer is a URI. No URI is a file below the folder, but the last.
void uris(const fs::path& root, const fs::path& folder, Tally& tally) {
  const hostile::File secret(60, 1);
  write(root / "secret.bin", secret);
  fs::create_directories(folder / "sub");
  write(folder / "sub" / "fine.bin", secret);
  fs::create_symlink(root / "secret.bin", folder / "link.bin");
  fs::create_directory_symlink(root, folder / "linked");
  const hostile::File seed = hostile::made_seeds()[3];
  const std::string text(seed.begin(), seed.end());
  const std::size_t first = text.find("data:application"), end = text.find('"', first);
  const std::string absolute = (root / "secret.bin").string();
  const std::string names[] = {"../secret.bin",
                               "..%2Fsecret.bin",
                               "%2e%2e/secret.bin",
                               "sub/../../secret.bin",
                               "./../secret.bin",
                               "link.bin",
                               "linked/secret.bin",
                               "sub/%2e%2e/%2E%2E/secret.bin",
                               absolute,
                               "/" + absolute,
                               "file://" + absolute,
                               "file:" + absolute,
                               "/etc/passwd",
                               "//etc/passwd",
                               "..\\\\secret.bin",
                               "\\u002e\\u002e/secret.bin",
                               "secret.bin%00.png",
                               "..",
                               ".",
                               "/",
                               "",
                               "sub",
                               "/dev/zero",
                               "/dev/stdin",
                               "/proc/self/mem",
                               "http://localhost/secret.bin",
                               "~/secret.bin",
                               "$HOME/secret.bin",
                               "sub/fine.bin/../../../secret.bin",
                               "%2Fetc%2Fpasswd",
                               "%252e%252e/secret.bin",
                               "..;/secret.bin",
                               "sub//..//..//secret.bin",
                               "C:/secret.bin"};
  for (const std::string& name : names) {
    for (const bool image : {false, true}) {
      std::string bad = text;
      if (image)
        bad.insert(1, "\"images\":[{\"uri\":\"" + name + "\"}],\"textures\":[{\"source\":0}],");
      else
        bad.replace(first, end - first, name);
      const fs::path file = folder / "uri.gltf";
      write(file, hostile::File(bad.begin(), bad.end()));
      const std::size_t before = tally.used;
      tally.count(file, folder);
      if (!image && tally.used > before) {
        ++tally.wrong;
        std::fprintf(stderr, "a buffer named %s was read\n", name.c_str());
      }
    }
  }
  // this one is below the folder and must be read
  std::string good = text;
  good.replace(first, end - first, "sub/fine.bin");
  write(folder / "uri.gltf", hostile::File(good.begin(), good.end()));
  hostile::opened();
  hostile::play_file(folder / "uri.gltf");
  const std::vector<std::string> names_read = hostile::opened();
  const std::string wanted = fs::canonical(folder / "sub" / "fine.bin").string();
  if (std::find(names_read.begin(), names_read.end(), wanted) == names_read.end()) {
    ++tally.wrong;
    std::fprintf(stderr, "sub/fine.bin was not read, or the watch is blind\n");
  }
}

std::size_t shared(Tally& tally) {
  const fs::path data = samples_test::shared_data();
  if (data.empty()) return 0;
  const std::size_t before = tally.files;
  for (const auto& entry : fs::recursive_directory_iterator(data / "hostile")) {
    if (!entry.is_regular_file()) continue;
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb" || extension == ".obj" || extension == ".off" ||
        extension == ".ply")
      tally.count(entry.path(), entry.path().parent_path());
  }
  return tally.files - before;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t scale = report_full(argc, argv) ? 5 : 1;
  samples_test::TemporaryFolder root;
  const fs::path folder = root.path / "in";
  fs::create_directories(folder);
  Tally tally;
  uris(root.path, folder, tally);
  damage(folder, 1000 * scale, tally);
  nonsense(folder, 5000 * scale, tally);
  surfaces(folder, 1000 * scale, tally);
  const std::size_t there = shared(tally);
  if (there == 0) std::printf("the optional shared corpus is not there (HF_SHARED_DATA); only files made here\n");
  std::printf("%zu files used, %zu refused, %zu of the shared corpus, %zu names opened\n", tally.used, tally.refused,
              there, tally.seen);
  report_at_least("hostile_files", static_cast<double>(tally.files), 12000);
  report_at_least("hostile_names_watched", static_cast<double>(tally.seen), static_cast<double>(tally.files) * 0.9);
  report_at_most("hostile_wrong", static_cast<double>(tally.wrong), 0);
  report_at_most("hostile_reads_outside", static_cast<double>(tally.outside), 0);
  report_at_most("hostile_slowest_s", tally.slowest, 1);
#if !defined(__SANITIZE_ADDRESS__)  // its shadow memory and quarantine count too
  report_at_most("hostile_memory_mb", hostile::peak_memory(), 512);
#endif
  return report_status();
}
