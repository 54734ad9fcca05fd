// Files with many elements of one kind, and reading them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/regions.h"
#include "growth.h"

namespace growth {
namespace {

std::string repeated(std::size_t count, const std::function<std::string(std::size_t)>& element) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += (i ? "," : "") + element(i);
  return out;
}
std::string repeated(std::size_t count, const std::string& element) {
  return repeated(count, [&](std::size_t) { return element; });
}
std::string number(std::size_t i) { return std::to_string(i); }
std::string numbers(std::size_t count) { return repeated(count, number); }

// The parts of a file with one small mesh on node 0; a kind replaces some.
struct Parts {
  // three positions, three indices, a matrix, two times, two translations: 144 bytes
  std::string buffers =
      R"({"byteLength":144,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAA"})";
  std::string views =
      R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":64},{"buffer":0,"byteOffset":108,"byteLength":8},{"buffer":0,"byteOffset":116,"byteLength":24})";
  std::string accessors =
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":1,"type":"MAT4"},{"bufferView":3,"componentType":5126,"count":2,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"})";
  std::string meshes = R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]})";
  std::string nodes = R"({"mesh":0})", roots = "0", more;

  std::string text() const {
    return R"({"asset":{"version":"2.0"},"scene":0,"buffers":[)" + buffers + R"(],"bufferViews":[)" + views +
           R"(],"accessors":[)" + accessors + R"(],"meshes":[)" + meshes + R"(],"nodes":[)" + nodes +
           R"(],"scenes":[{"nodes":[)" + roots + "]}]" + more + "}";
  }
};

constexpr const char* primitive = R"({"attributes":{"POSITION":0},"indices":1})";
constexpr const char* clip =
    R"({"samplers":[{"input":3,"output":4}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]})";

// n more nodes without anything.
void add_nodes(Parts& parts, std::size_t n) {
  parts.nodes += "," + repeated(n, "{}");
  parts.roots = numbers(n + 1);
}

using Fill = void (*)(Parts&, std::size_t);

const std::vector<std::pair<const char*, Fill>>& kinds() {
  static const std::vector<std::pair<const char*, Fill>> list = {
      {"nodes", add_nodes},
      {"node_children",
       [](Parts& p, std::size_t n) {
         p.nodes = R"({"mesh":0,"children":[)" + repeated(n, [](std::size_t i) { return number(i + 1); }) + "]}," +
                   repeated(n, "{}");
       }},
      {"node_names",
       [](Parts& p, std::size_t n) {
         p.nodes += "," + repeated(n, [](std::size_t i) { return R"({"name":"n)" + number(i) + "\"}"; });
         p.roots = numbers(n + 1);
       }},
      {"mesh_nodes",
       [](Parts& p, std::size_t n) {
         p.nodes = repeated(n, R"({"mesh":0})");
         p.roots = numbers(n);
       }},
      {"buffers",
       [](Parts& p, std::size_t n) {
         p.buffers += "," + repeated(n, R"({"byteLength":1,"uri":"data:;base64,AA=="})");
       }},
      {"buffers_without_bytes",
       [](Parts& p, std::size_t n) {
         p.buffers += "," + repeated(n, R"({"byteLength":1})");
         p.views += "," + repeated(n * 7 / 10, R"({"buffer":0,"byteLength":1})");
       }},
      {"views", [](Parts& p, std::size_t n) { p.views += "," + repeated(n, R"({"buffer":0,"byteLength":1})"); }},
      {"accessors",
       [](Parts& p, std::size_t n) {
         p.accessors += "," + repeated(n, R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})");
       }},
      {"zeros",
       [](Parts& p, std::size_t n) {
         p.accessors += R"(,{"componentType":5126,"type":"VEC3","count":)" + number(12 * n) + "}";
         p.meshes = std::string(R"({"primitives":[)") + primitive + R"(,{"attributes":{"POSITION":5}}]})";
         p.more = R"(,"extras":")" + std::string(n, 'x') + "\"";
       }},
      {"meshes",
       [](Parts& p, std::size_t n) {
         p.meshes = repeated(n, std::string(R"({"primitives":[)") + primitive + "]}");
         p.nodes = repeated(n, [](std::size_t i) { return R"({"mesh":)" + number(i) + "}"; });
         p.roots = numbers(n);
       }},
      {"primitives", [](Parts& p, std::size_t n) { p.meshes = R"({"primitives":[)" + repeated(n, primitive) + "]}"; }},
      {"morph_targets",
       [](Parts& p, std::size_t n) {
         p.meshes = R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[)" +
                    repeated(n, R"({"POSITION":0})") + "]}]}";
       }},
      {"morph_nodes",
       [](Parts& p, std::size_t n) {
         kinds()[11].second(p, n / 2);
         p.nodes = repeated(n / 2, R"({"mesh":0})");
         p.roots = numbers(n / 2);
       }},
      {"attributes",
       [](Parts& p, std::size_t n) {
         p.meshes = R"({"primitives":[{"indices":1,"attributes":{"POSITION":0,)" +
                    repeated(n, [](std::size_t i) { return "\"_A" + number(i) + "\":0"; }) + "}}]}";
       }},
      {"skins",
       [](Parts& p, std::size_t n) {
         p.more = R"(,"skins":[)" + repeated(n, R"({"joints":[0],"inverseBindMatrices":2})") + "]";
       }},
      {"joints",
       [](Parts& p, std::size_t n) {
         add_nodes(p, n);
         p.more = R"(,"skins":[{"joints":[)" + numbers(n) + "]}]";
       }},
      {"deep_skins",
       [](Parts& p, std::size_t n) {
         p.nodes =
             repeated(1000, [](std::size_t i) { return R"({"children":[)" + number(i + 1) + "]}"; }) + R"(,{"mesh":0})";
         p.more = R"(,"skins":[)" + repeated(n / 1000 + 1, R"({"skeleton":0,"joints":[)" + numbers(1000) + "]}") + "]";
       }},
      {"skinned_nodes",
       [](Parts& p, std::size_t n) {
         p.nodes = repeated(n, R"({"mesh":0,"skin":0})");
         p.roots = numbers(n);
         p.more = R"(,"skins":[{"joints":[)" + numbers(n) + "]}]";
       }},
      {"clips", [](Parts& p, std::size_t n) { p.more = R"(,"animations":[)" + repeated(n, clip) + "]"; }},
      {"clips_and_nodes",
       [](Parts& p, std::size_t n) {
         add_nodes(p, n);
         p.more = R"(,"animations":[)" + repeated(n / 10 + 1, clip) + "]";
       }},
      {"channels",
       [](Parts& p, std::size_t n) {
         add_nodes(p, n);
         p.more = R"(,"animations":[{"samplers":[{"input":3,"output":4}],"channels":[)" +
                  repeated(n,
                           [](std::size_t i) {
                             return R"({"sampler":0,"target":{"path":"translation","node":)" + number(i) + "}}";
                           }) +
                  "]}]";
       }},
      {"images",
       [](Parts& p, std::size_t n) {
         p.more = R"(,"images":[)" + repeated(n, R"({"bufferView":2,"mimeType":"image/png"})") + "]";
       }},
      {"images_of_files",
       [](Parts& p, std::size_t n) { p.more = R"(,"images":[)" + repeated(n, R"({"uri":"none.png"})") + "]"; }},
      {"textures", [](Parts& p, std::size_t n) { p.more = R"(,"textures":[)" + repeated(n, "{}") + "]"; }},
      {"materials", [](Parts& p, std::size_t n) { p.more = R"(,"materials":[)" + repeated(n, "{}") + "]"; }},
  };
  return list;
}

// Faces of a thousand corners that meet themselves, the dearest to cut into triangles.
std::string polygons(std::size_t count) {
  constexpr std::size_t corners = 1000;
  std::mt19937 random(1);
  std::string text = "OFF\n" + number(corners) + " " + number(count) + " 0\n", face = number(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    text += number(random() % 10000) + " " + number(random() % 10000) + " 0\n";
    face += " " + number(i);
  }
  for (std::size_t i = 0; i < count; ++i) text += face + "\n";
  return text;
}

// One face of so many corners: at random, round a circle, or a comb.
std::string polygon(std::size_t corners, int shape) {
  std::mt19937 random(1);
  std::string text = "OFF\n" + number(corners) + " 1 0\n", face = number(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    const double turn = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
    const std::size_t k = i < corners / 2 ? i : corners - 1 - i;
    if (shape == 0)
      text += number(random() % 10000) + " " + number(random() % 10000);
    else if (shape == 1)
      text += std::to_string(std::cos(turn)) + " " + std::to_string(std::sin(turn));
    else
      text += number(k) + " " + number(i < corners / 2 ? 3 * (k % 2) : 9 + k % 2);
    text += " 0\n";
    face += " " + number(i);
  }
  return text + face + "\n";
}

// Triangles between any vertices, half as many of these.
std::string soup_text(std::size_t triangles) {
  std::mt19937 random(1);
  const std::size_t vertices = triangles / 2 + 3;
  std::string text = "OFF\n" + number(vertices) + " " + number(triangles) + " 0\n";
  for (std::size_t i = 0; i < vertices; ++i)
    text += number(random() % 1000) + " " + number(random() % 1000) + " " + number(random() % 1000) + "\n";
  for (std::size_t t = 0; t < triangles; ++t)
    text += "3 " + number(random() % vertices) + " " + number(random() % vertices) + " " + number(random() % vertices) +
            "\n";
  return text;
}

void append(std::string& out, std::uint32_t word, std::size_t bytes) {
  for (std::size_t b = 0; b < bytes; ++b) out += static_cast<char>(word >> 8 * b & 255);
}

// The same as GLB, with a skin of two joints. Bytes for bytes it holds three times as many triangles.
std::string soup_glb(std::size_t triangles, std::size_t vertices) {
  vertices = std::min<std::size_t>(vertices, 65535);
  std::mt19937 random(1);
  std::string bytes;
  for (std::size_t i = 0; i < 3 * vertices; ++i) {
    const float x = static_cast<float>(random() % 1000) / 1000;
    std::uint32_t word = 0;
    std::memcpy(&word, &x, sizeof word);
    append(bytes, word, 4);
  }
  for (std::size_t v = 0; v < vertices; ++v) append(bytes, v % 2, 4);  // joint 0 or 1
  for (std::size_t v = 0; v < vertices; ++v) append(bytes, 255, 4);    // alone
  for (std::size_t i = 0; i < 3 * triangles; ++i) append(bytes, static_cast<std::uint32_t>(random() % vertices), 2);
  while (bytes.size() % 4) bytes += '\0';
  const std::string v = number(vertices), c = number(3 * triangles);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0,"skin":0},{"name":"a"},)"
      R"({"name":"b","translation":[0.5,0.5,0.5]}],"skins":[{"joints":[1,2]}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]}],"buffers":[{"byteLength":)" +
      number(bytes.size()) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + number(12 * vertices) +
      R"(},{"buffer":0,"byteOffset":)" + number(12 * vertices) + R"(,"byteLength":)" + number(4 * vertices) +
      R"(},{"buffer":0,"byteOffset":)" + number(16 * vertices) + R"(,"byteLength":)" + number(4 * vertices) +
      R"(},{"buffer":0,"byteOffset":)" + number(20 * vertices) + R"(,"byteLength":)" + number(6 * triangles) +
      R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","min":[0,0,0],"max":[1,1,1],"count":)" + v +
      R"(},{"bufferView":1,"componentType":5121,"type":"VEC4","count":)" + v +
      R"(},{"bufferView":2,"componentType":5121,"normalized":true,"type":"VEC4","count":)" + v +
      R"(},{"bufferView":3,"componentType":5123,"type":"SCALAR","count":)" + c + "}]}";
  while (json.size() % 4) json += ' ';
  std::string out = "glTF";
  append(out, 2, 4);
  append(out, static_cast<std::uint32_t>(28 + json.size() + bytes.size()), 4);
  append(out, static_cast<std::uint32_t>(json.size()), 4);
  out += "JSON" + json;
  append(out, static_cast<std::uint32_t>(bytes.size()), 4);
  out += std::string("BIN\0", 4) + bytes;
  return out;
}

// Files of their own shape: triangles per file.
const std::vector<std::pair<const char*, std::function<std::string(std::size_t)>>>& meshes() {
  static const std::vector<std::pair<const char*, std::function<std::string(std::size_t)>>> list = {
      {"polygons", polygons},
      {"polygon_random", [](std::size_t n) { return polygon(n, 0); }},
      {"polygon_round", [](std::size_t n) { return polygon(n, 1); }},
      {"polygon_comb", [](std::size_t n) { return polygon(n, 2); }},
      {"soup", soup_text},
      {"soup_dense", [](std::size_t n) { return soup_glb(n, n / 16 + 3); }},
      {"soup_glb", [](std::size_t n) { return soup_glb(n, n / 5 + 3); }},
      {"soup_within", [](std::size_t n) { return soup_glb(n, n / 90 + 3); }},  // the limits let it through
      {"soup_sparse", [](std::size_t n) { return soup_glb(n, n + 3); }},
  };
  return list;
}

}  // namespace

std::vector<std::string> file_kinds() {
  std::vector<std::string> names;
  for (const auto& mesh : meshes()) names.push_back(mesh.first);
  for (const auto& kind : kinds()) names.push_back(kind.first);
  return names;
}

std::string file_of(const std::string& kind, std::size_t count) {
  for (const auto& mesh : meshes())
    if (kind == mesh.first) return mesh.second(count);
  for (const auto& known : kinds()) {
    if (kind != known.first) continue;
    Parts parts;
    known.second(parts, count);
    return parts.text();
  }
  throw std::runtime_error("no such kind of file: " + kind);
}

const char* file_ending(const std::string& text) {
  return text.front() == '{' ? ".gltf" : text.front() == 'g' ? ".glb" : ".off";
}

std::string file_of_bytes(const std::string& kind, std::size_t bytes) {
  std::size_t low = 2, high = 2;
  while (file_of(kind, high).size() <= bytes) {
    low = high;
    high *= 2;
  }
  // within half a percent
  while (high - low > high / 200 + 1) {
    const std::size_t middle = low + (high - low) / 2;
    (file_of(kind, middle).size() <= bytes ? low : high) = middle;
  }
  return file_of(kind, low);
}

// Reads, flattens, lists joints and writes again, or is refused: both count.
std::vector<Structure> file_structures(bool full) {
  std::vector<Structure> out;
  for (const std::string& kind : file_kinds()) {
    // A circle of few corners is convex in six digits, one of many has dents: from here on it has.
    const std::size_t n = kind.rfind("polygon_", 0) == 0 ? 8000 : full ? 2000 : 1000;
    const auto run = [kind](std::size_t size) {
      const auto text = std::make_shared<std::string>(file_of(kind, size));
      return [text] {
        try {
          const std::vector<uint8_t> bytes(text->begin(), text->end());
          if (text->front() == 'O') {
            samples::read_mesh_bytes(bytes, ".off", "a file");
            return;
          }
          const hf_gltf::Model model = hf_gltf::read_gltf_bytes(bytes, "a file");
          const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
          hf_gltf::RegionFinder(model, mesh, hf_gltf::Axes()).describe_joints();
          hf_gltf::gltf_bytes(model, true);
        } catch (const std::runtime_error&) {
        }
      };
    };
    // materials of 3 KB leave the processor's cache between the sizes
    const double steepest = kind == "materials" ? 1.4 : 1.25;
    const std::size_t least = kind == "polygons" ? n / 50 : n;
    out.push_back({"file_" + kind, {least, 2 * least, 4 * least, 8 * least}, steepest, run});
  }
  return out;
}

}  // namespace growth
