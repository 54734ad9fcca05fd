// Short stories over the whole API on one small tube, for refused allocations: every call may answer
// HF_ERROR_OUT_OF_MEMORY once and is then made again; what the story works out at its end must not depend on it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hf/hf.h"

namespace refusal {

// An allocator that counts, and refuses number refuse_at (1-based; 0: none), and all later ones when refuse_on.
struct Allocator {
  std::size_t live_blocks = 0, live_bytes = 0, calls = 0, refuse_at = 0, refused = 0, mismatches = 0;
  bool refuse_on = false;
  hf_allocator hooks();
};

class Story {
 public:
  explicit Story(Allocator& memory) : memory_(memory) {}

  // One call, made again when memory ran out: the refusal must have happened inside it, the detail must say so, and the
  // second try must succeed. on_failure: what must hold in between, an output that is still NULL, say.
  template <class Call, class Check>
  void call(const char* function, Call&& make, Check&& holds) {
    const std::size_t refused = memory_.refused;
    hf_result result = make();
    if (result == HF_ERROR_OUT_OF_MEMORY && memory_.refused > refused) {
      ++reported;
      check_detail(function);
      if (!holds()) wrong(std::string(function) + ": the refused call wrote an output or changed something");
      memory_.refuse_at = 0, memory_.refuse_on = false;
      result = make();
    }
    if (result != HF_OK) wrong(std::string(function) + ": " + hf_result_get_name(result));
  }
  template <class Call>
  void call(const char* function, Call&& make) {
    call(function, make, [] { return true; });
  }
  // A call that makes a handle.
  template <class Handle, class Call>
  void make(const char* function, Handle& handle, Call&& create) {
    call(function, create, [&] { return handle == nullptr; });
  }

  // A call that must be refused for another reason, which takes no memory to find.
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

// The tube: `around` vertices on each of `rings` rings.
struct Tube {
  static constexpr std::uint32_t around = 8, rings = 10, vertices = around * rings;
  std::vector<double> positions, height;
  std::vector<std::uint32_t> triangles, ends;
  Tube();
  hf_create_desc desc(Allocator& memory) const;
};

struct Chapter {
  const char* name;
  void (*tell)(Story& story, const Tube& tube, Allocator& memory);
};
std::vector<Chapter> field_chapters();  // solvers, sites, fields, factors
std::vector<Chapter> shape_chapters();  // analysis, directions, poses, transfers, quads, regions

}  // namespace refusal
