// Short stories over the whole API on one small tube, for refused allocations. A call may return
// HF_ERROR_OUT_OF_MEMORY once and is then repeated. The answer of a story must not depend on that.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hf/hf.h"

namespace refusal {

// An allocator that counts. It refuses allocation number refuse_at (from 1; 0: none), with refuse_on all later ones
// too.
struct Allocator {
  std::size_t live_blocks = 0, live_bytes = 0, calls = 0, refuse_at = 0, refused = 0, refused_size = 0, mismatches = 0;
  bool refuse_on = false;
  hf_allocator hooks();
};

class Story {
 public:
  explicit Story(Allocator& memory) : memory_(memory) {}

  // Makes a call, and repeats it when memory ran out. The refusal must have happened inside the call, the error detail
  // must name it, and the repeated call must succeed. holds: what must be true after a refusal.
  template <class Call, class Check>
  void call(const char* function, Call&& make, Check&& holds) {
    const std::size_t refused = memory_.refused;
    hf_result result = make();
    if (result == HF_ERROR_OUT_OF_MEMORY && memory_.refused > refused) {
      ++reported;
      check_detail(function);
      if (!holds()) wrong(std::string(function) + ": the refused call wrote an output or changed something");
      memory_.refuse_at = 0;
      memory_.refuse_on = false;
      result = make();
    }
    if (result != HF_OK) wrong(std::string(function) + ": " + hf_result_get_name(result));
  }
  template <class Call>
  void call(const char* function, Call&& make) {
    call(function, make, [] { return true; });
  }
  // A call that makes a handle. A refused one leaves it NULL.
  template <class Handle, class Call>
  void make(const char* function, Handle& handle, Call&& create) {
    call(function, create, [&] { return handle == nullptr; });
  }
  // A call that makes a handle, and perhaps a factor. A refused one holds no memory either.
  template <class Handle, class Call>
  void make_factor(const char* function, Handle& handle, Call&& create) {
    const std::size_t bytes = memory_.live_bytes;
    call(function, create, [&] { return handle == nullptr && memory_.live_bytes <= bytes; });
  }
  void holds(bool condition, const char* otherwise) {
    if (!condition) wrong(otherwise);
  }

  // A call that must be refused for another reason. Finding that reason takes no memory.
  template <class Call>
  void refused(const char* function, hf_result expected, Call&& make) {
    const hf_result result = make();
    if (result != expected) wrong(std::string(function) + ": " + hf_result_get_name(result));
  }

  void take(const double* values, std::size_t count) { answer.insert(answer.end(), values, values + count); }
  void take(const float* values, std::size_t count) { answer.insert(answer.end(), values, values + count); }
  void take(double value) { answer.push_back(value); }
  bool failed() const { return !problems.empty(); }

  std::vector<double> answer;
  std::vector<std::string> problems;
  unsigned reported = 0;

 private:
  void check_detail(const char* function);
  void wrong(const std::string& what) { problems.push_back(what); }
  Allocator& memory_;
};

// A tube of `rings` rings with `around` vertices each.
struct Tube {
  static constexpr std::uint32_t around = 8, rings = 10, vertices = around * rings;
  std::vector<double> positions, height;
  std::vector<std::uint32_t> triangles, ends;
  Tube();
  hf_surface_desc desc(Allocator& memory) const;
};

struct Chapter {
  const char* name;
  void (*tell)(Story& story, const Tube& tube, Allocator& memory);
};
std::vector<Chapter> field_chapters();  // surfaces, solvers, sites, fields, factors
std::vector<Chapter> shape_chapters();  // analysis, directions, poses, transfers, quads, regions, weights

}  // namespace refusal
