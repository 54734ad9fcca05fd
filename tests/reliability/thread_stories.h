// Stories that eight threads tell about one object of every kind (threads.cpp): they read the objects, make new ones of
// them, clone them and edit the clones. The answer of a story depends on its number alone, never on other threads.
#pragma once
#include "surfaces.h"
#include "whole_api.h"

namespace reliability {

struct Objects {
  hf_surface surface = nullptr, bent = nullptr;    // of a harmonic and of a bi-harmonic factor
  hf_transfer transfer = nullptr;                  // with pairs, not applied yet
  hf_solver solver = nullptr, refactor = nullptr;  // of hf_create and hf_peer_refactor_create
  hf_geodesics geodesics = nullptr;
  hf_flow flow = nullptr;
  hf_quads quads = nullptr;
  hf_direction direction = nullptr;
  hf_pose pose = nullptr;
  hf_region region = nullptr, target = nullptr;
  hf_detail detail = nullptr;
};

// The answer of one story: a hash of all codes and numbers, and the number of calls that failed.
class Seen {
 public:
  template <class T>
  void take(const T* values, std::size_t count) {  // FNV-1a
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(T); ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211u;
  }
  template <class T>
  void take(const std::vector<T>& values) {
    take(values.data(), values.size());
  }
  void call(hf_result result) {
    take(&result, 1);
    failed_ += result != HF_OK;
  }
  std::uint64_t hash() const { return hash_; }
  unsigned failed() const { return failed_; }

 private:
  std::uint64_t hash_ = 14695981039346656037u;
  unsigned failed_ = 0;
};

Objects make_objects(const Scene& scene);
Objects clones_of(const Objects& objects);  // clones of the solvers, the pose, the directions and the region
void destroy(const Objects& objects);

// Edits everything that clones_of makes. Returns the hash of the answers.
std::uint64_t edit_all(const Scene& scene, const Objects& clones, unsigned number);

struct Story {
  const char* figure;  // its name in the report
  void (*tell)(const Scene&, const Objects&, unsigned number, Seen&);
};
extern const std::vector<Story> thread_stories;

}  // namespace reliability
