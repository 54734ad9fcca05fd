#include "support/creature.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace hf_test {
namespace {

namespace fs = std::filesystem;
using samples::Creature;
using samples::ShapeMesh;

// Writes and reads alike: each(VISITOR, OBJECT) names the fields once for both.
struct Writer {
  std::string bytes;
  void plain(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
  std::size_t count(std::size_t n) {
    plain(&n, sizeof n);
    return n;
  }
};

struct Reader {
  const std::string& bytes;
  std::size_t at = 0;
  void plain(void* data, std::size_t size) {
    if (size > bytes.size() - at) throw std::runtime_error("the file is too short");
    if (size > 0) std::memcpy(data, bytes.data() + at, size);
    at += size;
  }
  std::size_t count(std::size_t) {
    std::size_t n = 0;
    plain(&n, sizeof n);
    if (n > bytes.size()) throw std::runtime_error("a list is longer than the file");
    return n;
  }
};

template <class Visitor, class T>
void each(Visitor& visitor, T& value);
template <class Visitor, class Item>
void each(Visitor& visitor, std::vector<Item>& list) {
  list.resize(visitor.count(list.size()));
  if constexpr (std::is_trivially_copyable_v<Item>) {
    visitor.plain(list.data(), list.size() * sizeof(Item));
  } else {
    for (Item& item : list) each(visitor, item);
  }
}
template <class Visitor>
void each(Visitor& visitor, std::string& text) {
  text.resize(visitor.count(text.size()));
  visitor.plain(text.data(), text.size());
}
template <class Visitor>
void each(Visitor& visitor, samples::Joint& joint) {
  each(visitor, joint.name);
  each(visitor, joint.parent);
  each(visitor, joint.translation);
}
template <class Visitor>
void each(Visitor& visitor, samples::JointKeys& keys) {
  each(visitor, keys.rotations);
  each(visitor, keys.translations);
}
template <class Visitor>
void each(Visitor& visitor, samples::Clip& clip) {
  each(visitor, clip.name);
  each(visitor, clip.speed);
  each(visitor, clip.times);
  each(visitor, clip.joints);
}
template <class Visitor>
void each(Visitor& visitor, ShapeMesh& mesh) {
  each(visitor, mesh.positions);
  each(visitor, mesh.triangles);
}
template <class Visitor>
void each(Visitor& visitor, Creature& it) {
  each(visitor, it.name);
  each(visitor, it.positions);
  each(visitor, it.normals);
  each(visitor, it.texcoords);
  each(visitor, it.colors);
  each(visitor, it.joints);
  each(visitor, it.weights);
  each(visitor, it.triangles);
  each(visitor, it.surface_vertex);
  each(visitor, it.surface_vertex_count);
  each(visitor, it.chart_count);
  each(visitor, it.base_color);
  each(visitor, it.skeleton);
  each(visitor, it.clips);
}
template <class Visitor, class T>
void each(Visitor& visitor, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  visitor.plain(&value, sizeof value);
}

std::uint64_t sum_of(const std::string& bytes) {
  std::uint64_t sum = 0xCBF29CE484222325ull;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001B3ull;
  return sum;
}

// A file that is not whole, or of another layout, is as none.
template <class T>
bool read_kept(const fs::path& file, T& out) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return false;
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < sizeof(std::uint64_t)) return false;
  const std::string body = bytes.substr(sizeof(std::uint64_t));
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data(), sizeof sum);
  if (sum != sum_of(body)) return false;
  try {
    Reader reader{body};
    each(reader, out);
    return reader.at == body.size();
  } catch (const std::exception&) {
    return false;
  }
}

// Programs of tests run beside each other: a file takes its name when it is whole. One that cannot be written is made
// again.
template <class T>
void keep(const fs::path& file, T& value) {
  Writer writer;
  each(writer, value);
  const std::uint64_t sum = sum_of(writer.bytes);
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  const fs::path part = file.string() + "." + std::to_string(std::random_device()());
  {
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    out.write(writer.bytes.data(), static_cast<std::streamsize>(writer.bytes.size()));
    if (!out.flush()) return;
  }
  fs::rename(part, file, ignored);
  fs::remove(part, ignored);
}

template <class T, class Make>
const T& kept(const std::string& name, std::uint32_t vertices, const Make& make) {
  static std::map<std::pair<std::string, std::uint32_t>, T> all;
  const std::pair key(name, vertices);
  const auto found = all.find(key);
  if (found != all.end()) return found->second;
  const fs::path file = fs::path(HF_KEPT_ASSETS) / (name + "_" + std::to_string(vertices));
  T value;
  if (!read_kept(file, value)) {
    value = make();
    keep(file, value);
  }
  return all.emplace(key, std::move(value)).first->second;
}

}  // namespace

const Creature& creature(const std::string& name, std::uint32_t vertices) {
  return kept<Creature>(name, vertices, [&] { return samples::make_creature(name, vertices); });
}

Creature read_back(Creature creature) {
  Writer writer;
  each(writer, creature);
  Reader reader{writer.bytes};
  Creature out;
  each(reader, out);
  return out;
}

const ShapeMesh& cactus(std::uint32_t vertices) {
  return kept<ShapeMesh>("cactus", vertices, [&] { return samples::cactus(vertices); });
}

}  // namespace hf_test
