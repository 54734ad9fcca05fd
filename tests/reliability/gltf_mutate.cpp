#include "gltf_mutate.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "unit/gltf/compressed_files.h"
#include "unit/gltf/sound_file.h"

namespace hostile {
namespace {

using samples_test::GlbBuilder;

std::uint32_t word_at(const File& file, std::size_t at) {
  std::uint32_t word = 0;
  if (at + 4 <= file.size()) std::memcpy(&word, file.data() + at, 4);
  return word;
}

// The JSON text and the bytes after it. A file that is not a GLB is all text.
struct Parts {
  bool container = false;
  std::string text;
  File rest;
};

Parts parts_of(const File& file) {
  Parts parts;
  if (file.size() >= 20 && word_at(file, 0) == 0x46546C67) {
    const std::size_t size = std::min<std::size_t>(word_at(file, 12), file.size() - 20);
    parts.container = true;
    parts.text.assign(file.begin() + 20, file.begin() + 20 + static_cast<std::ptrdiff_t>(size));
    parts.rest.assign(file.begin() + 20 + static_cast<std::ptrdiff_t>(size), file.end());
  } else {
    parts.text.assign(file.begin(), file.end());
  }
  return parts;
}

File join(Parts parts) {
  if (!parts.container) return File(parts.text.begin(), parts.text.end());
  while (parts.text.size() % 4) parts.text += ' ';
  File out(20);
  const std::uint32_t head[5] = {0x46546C67, 2, static_cast<std::uint32_t>(20 + parts.text.size() + parts.rest.size()),
                                 static_cast<std::uint32_t>(parts.text.size()), 0x4E4F534A};
  std::memcpy(out.data(), head, sizeof head);
  out.insert(out.end(), parts.text.begin(), parts.text.end());
  out.insert(out.end(), parts.rest.begin(), parts.rest.end());
  return out;
}

// Words: runs of digits, runs of letters and quotes, single marks.
struct Word {
  std::size_t first, size;
};
Word word_near(const std::string& text, std::size_t at) {
  const auto kind = [&](std::size_t i) {
    const char c = text[i];
    if ((c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+') return 1;
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '"' || c == '/') return 2;
    return 3;
  };
  std::size_t first = at, end = at + 1;
  const int k = kind(at);
  while (k != 3 && first > 0 && kind(first - 1) == k) --first;
  while (k != 3 && end < text.size() && kind(end) == k) ++end;
  return {first, end - first};
}

const char* const nonsense[] = {"0",
                                "1",
                                "2",
                                "3",
                                "-1",
                                "255",
                                "65535",
                                "65536",
                                "4294967295",
                                "4294967296",
                                "2147483648",
                                "18446744073709551615",
                                "1e308",
                                "-1e308",
                                "1e30",
                                "1e-30",
                                "0.5",
                                "5120",
                                "5121",
                                "5123",
                                "5125",
                                "5126",
                                "null",
                                "true",
                                "{}",
                                "[]",
                                "[[[[]]]]",
                                "\"\"",
                                "\"VEC3\"",
                                "\"MAT4\"",
                                "\"SCALAR\"",
                                "\"POSITION\"",
                                "\"LINEAR\"",
                                "\"CUBICSPLINE\"",
                                "\"translation\"",
                                "\"weights\"",
                                "\"../../etc/passwd\"",
                                "\"data:application/octet-stream;base64,AAAA\"",
                                "\"\\u0000\"",
                                "\"\xff\xfe\"",
                                ",",
                                "]",
                                "}",
                                "\"extras\":1,"};

void mutate_text(std::string& text, const std::string& other, Random& random) {
  if (text.empty()) return;
  const Word word = word_near(text, random() % text.size());
  switch (random() % 6) {
    case 0:
      text.erase(word.first, word.size);
      break;
    case 1:
      text.insert(word.first, text.substr(word.first, word.size));
      break;
    case 2: {
      const Word second = word_near(text, random() % text.size());
      text.replace(word.first, word.size, text.substr(second.first, second.size));
      break;
    }
    case 3:
      if (!other.empty()) {
        const std::size_t at = random() % other.size();
        text.insert(word.first, other.substr(at, 1 + random() % 60));
      }
      break;
    default:
      text.replace(word.first, word.size, nonsense[random() % (sizeof nonsense / sizeof *nonsense)]);
  }
}

void mutate_numbers(File& bytes, Random& random) {
  if (bytes.size() < 12) return;
  const std::size_t at = 8 + random() % (bytes.size() - 11) / 4 * 4;
  const float floats[] = {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          1e30f,
                          -3e38f,
                          0,
                          1e-30f,
                          1e-42f,
                          1,
                          -1,
                          1e7f};
  const std::uint32_t words[] = {0, 1, 2, 11, 12, 255, 65535, 0x7fffffff, 0x80000000, 0xffffffff};
  if (at + 4 > bytes.size()) return;
  if (random() % 2)
    std::memcpy(bytes.data() + at, &floats[random() % 10], 4);
  else
    std::memcpy(bytes.data() + at, &words[random() % 10], 4);
}

void mutate_bytes(File& file, Random& random) {
  if (file.empty()) return;
  const std::size_t at = random() % file.size();
  switch (random() % 5) {
    case 0:
      file.resize(at);
      break;
    case 1:
      file.insert(file.begin() + static_cast<std::ptrdiff_t>(at), 1 + random() % 8,
                  static_cast<std::uint8_t>(random()));
      break;
    case 2:
      file.erase(file.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 3:
      file[at] = static_cast<std::uint8_t>(random());
      break;
    default:
      file[at] = static_cast<std::uint8_t>(file[at] ^ (1u << random() % 8));
  }
}

// A bumpy sheet of two primitives with a seam, and an island. There are two nodes; one is turned and scaled.
File sheet_file() {
  GlbBuilder b;
  const auto sheet = [&](float x0, std::uint16_t width) {
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    for (std::uint16_t j = 0; j < width; ++j) {
      for (std::uint16_t i = 0; i < width; ++i) {
        positions.insert(positions.end(), {x0 + float(i), float(j), 0.25f * float((i * 7 + j * 3) % 5)});
        if (i + 1 == width || j + 1 == width) continue;
        const std::uint16_t a = static_cast<std::uint16_t>(j * width + i), up = static_cast<std::uint16_t>(a + width);
        for (const int v : {int(a), a + 1, up + 1, int(a), up + 1, int(up)})
          indices.push_back(static_cast<std::uint16_t>(v));
      }
    }
    const int accessor = b.floats(positions, "VEC3");
    return nlohmann::json{{"attributes", {{"POSITION", accessor}}},
                          {"indices", b.accessor(b.view(indices), indices.size(), "SCALAR", 5123)}};
  };
  b.document["meshes"] = {{{"primitives", {sheet(0, 5), sheet(4, 5)}}}, {{"primitives", {sheet(30, 3)}}}};
  b.document["nodes"] = {{{"mesh", 0}, {"children", {1}}},
                         {{"mesh", 1}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 1, -1}}}};
  b.document["scenes"] = {{{"nodes", {0}}}};
  b.document["scene"] = 0;
  return b.glb();
}

// Quantised positions with a stride, 8-bit indices, vertex colours.
File quantised_file() {
  GlbBuilder b;
  std::vector<std::int16_t> positions;
  for (int v = 0; v < 9; ++v) {
    for (const int x : {v % 3 * 100, v / 3 * 100, v * 7 % 20, 0}) positions.push_back(static_cast<std::int16_t>(x));
  }
  const int accessor = b.accessor(b.view(positions, 8), 9, "VEC3", 5122);
  const int colours = b.accessor(b.view(std::vector<std::uint8_t>(36, 200), 4), 9, "VEC4", 5121, true);
  b.triangle_mesh({{"POSITION", accessor}, {"COLOR_0", colours}})["indices"] = b.accessor(
      b.view(std::vector<std::uint8_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7}), 24,
      "SCALAR", 5121);
  b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  return b.glb();
}

// Two scenes, instances, a camera, extras and extensions that are carried past the reader.
File carried_file() {
  GlbBuilder b;
  const samples_test::Sheet sheet = samples_test::make_sheet(3);
  b.triangle_mesh({{"POSITION", b.floats(sheet.positions, "VEC3")}})["indices"] =
      b.accessor(b.view(sheet.indices), sheet.indices.size(), "SCALAR", 5123);
  b.document["nodes"].push_back({{"mesh", 0}, {"camera", 0}, {"extras", {{"tags", {1, "two", nullptr}}}}});
  b.document["nodes"][0]["extensions"] = {
      {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", b.floats({0, 0, 0, 5, 0, 0}, "VEC3")}}}}},
      {"KHR_lights_punctual", {{"light", 0}}}};
  b.document["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
  b.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "KHR_lights_punctual"};
  b.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  b.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 0}}, {"extras", 7}}};
  b.document["scene"] = 1;
  return b.glb();
}

// Text with an embedded buffer.
File text_file() {
  const std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],"buffers":[{"byteLength":56,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAQADAAIA"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}]})";
  std::string right = text;
  right.replace(right.find("\"byteLength\":56"), 15, "\"byteLength\":60");
  return File(right.begin(), right.end());
}

}  // namespace

std::vector<File> made_seeds() {
  std::vector<File> seeds = {samples_test::sound_file(), sheet_file(), quantised_file(), text_file(), carried_file()};
#ifdef HF_GLTF_DRACO
  for (const bool edgebreaker : {true, false}) seeds.push_back(samples_test::draco_file(edgebreaker));
#endif
#ifdef HF_GLTF_MESHOPT
  seeds.push_back(samples_test::meshopt_file());
#endif
  return seeds;
}

std::vector<File> shared_seeds(std::size_t most) {
  std::vector<std::filesystem::path> names;
  const std::filesystem::path folder = samples_test::shared_data();
  if (folder.empty()) return {};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "hostile")) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && entry.file_size() <= most && (extension == ".gltf" || extension == ".glb"))
      names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());
  std::vector<File> files;
  for (const auto& name : names) {
    std::ifstream in(name, std::ios::binary);
    files.emplace_back((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  }
  return files;
}

File mutate(const File& file, const File& other, Random& random) {
  File out = file;
  const bool only_numbers = random() % 2 == 0;  // these pass the checks of the text and reach the library
  for (unsigned n = 1 + random() % 6; n > 0; --n) {
    const unsigned way = only_numbers ? 7 : random() % 8;
    if (way == 0) {
      mutate_bytes(out, random);
      continue;
    }
    Parts parts = parts_of(out);
    if (way < 5 || !parts.container)
      mutate_text(parts.text, parts_of(other).text, random);
    else
      mutate_numbers(parts.rest, random);
    out = join(std::move(parts));
  }
  return out;
}

}  // namespace hostile
