// The contract of structs between releases: every public struct is grown by a field here, and callers and libraries
// from before and after that work together.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "base/error.h"
#include "capi/boundary.h"
#include "hf/hf.h"

namespace hf_inner::capi {

// The struct of a later release: one field more. `added` is as wide as the struct is aligned, so nothing is padded.
template <class T>
struct Grown : T {
  std::conditional_t<alignof(T) == 4, std::uint32_t, std::uint64_t> added;
};

template <class T>
inline constexpr std::size_t released_size<Grown<T>> = sizeof(T);

namespace {

template <class... T>
struct List {};

using Structs =
    List<hf_factor_desc, hf_faces_desc, hf_surface_desc, hf_surface_info, hf_surface_report, hf_mesh_statistics,
         hf_links_info, hf_surface_statistics, hf_pick_desc, hf_hit, hf_solver_desc, hf_solver_info, hf_sites_desc,
         hf_edit_desc, hf_sites_info, hf_solve_info, hf_preview_info, hf_certificate, hf_solver_statistics,
         hf_pose_desc, hf_pose_info, hf_handles_desc, hf_handle_info, hf_deform_info, hf_deform_desc, hf_skin_info,
         hf_blend_info, hf_blend_rows, hf_blend_influences, hf_direction_desc, hf_direction_statistics, hf_isolines,
         hf_critical_info, hf_geodesics_desc, hf_extremities_desc, hf_handle_proposals_desc, hf_region_desc,
         hf_curve_desc, hf_region_edit_desc, hf_region_info, hf_region_statistics, hf_pose_statistics,
         hf_transfer_statistics, hf_morph_desc, hf_detail_desc, hf_quads_desc, hf_quads_info, hf_quads_mesh,
         hf_streamlines, hf_transfer_desc, hf_pairs_desc, hf_pair_info, hf_transfer_info, hf_transfer_frame,
         hf_graph_desc, hf_links_desc, hf_surface_edit_desc, hf_patch_desc, hf_cut_desc, hf_cut, hf_gaps_info, hf_joints_desc, hf_pins_desc, hf_weights_out,
         hf_weights_info, hf_weights_statistics, hf_weights_mirror_statistics, hf_weights_transfer_desc,
         hf_weights_transfer_info, hf_weights_mirror_desc, hf_weights_mirror_info, hf_path, hf_transfer_dials,
         hf_skin_desc, hf_skeleton_desc, hf_skeleton_info, hf_retarget_desc, hf_retarget_info>;

// All bytes a caller owns: the struct in front, its own memory behind.
constexpr std::size_t room = 1024;
using Memory = std::array<unsigned char, room>;
using Bytes = std::vector<unsigned char>;
constexpr unsigned char content = 0x11, foreign = 0xAB, written = 0xCD;

// A struct as one release of the library has it. Bytes stand for its values, so that one test serves all structs.
struct Release {
  std::size_t size;
  Bytes (*read)(const Memory& given);
  Bytes (*read_optional)(const Memory& given);
  void (*write)(Memory& out, unsigned char byte);  // a value of such bytes
};

template <class S>
Bytes bytes_of(const S& value) {
  const unsigned char* first = reinterpret_cast<const unsigned char*>(&value);
  return {first, first + sizeof value};
}

template <class S>
constexpr Release release = {
    sizeof(S),
    [](const Memory& given) { return bytes_of(read_struct(reinterpret_cast<const S*>(given.data()), "desc")); },
    [](const Memory& given) { return bytes_of(read_optional(reinterpret_cast<const S*>(given.data()), "desc")); },
    [](Memory& out, unsigned char byte) {
      S value;
      std::memset(static_cast<void*>(&value), byte, sizeof value);
      write_struct(reinterpret_cast<S*>(out.data()), value);
    }};

struct Kind {
  const char* name;
  Release now, later;
  std::size_t added;  // the size of the new field
};

template <class T>
Kind kind_of() {
  static_assert(sizeof(Grown<T>) + 64 <= room);
  static_assert(std::is_same_v<decltype(T::struct_size), std::uint32_t>);
  return {typeid(T).name(), release<T>, release<Grown<T>>, sizeof(Grown<T>::added)};
}
template <class... T>
std::vector<Kind> kinds_of(List<T...>) {
  return {kind_of<T>()...};
}

class StructContract : public ::testing::Test {
 protected:
  void each(const std::function<void(const Kind& kind)>& check) {
    for (const Kind& kind : kinds_of(Structs{})) {
      SCOPED_TRACE(kind.name);
      check(kind);
    }
  }
  // A struct of `length` bytes of content, foreign bytes behind.
  void fill(std::size_t length, std::size_t struct_size) {
    memory_.fill(foreign);
    std::memset(memory_.data(), content, length);
    put_size(struct_size);
  }
  void put_size(std::size_t size) {
    const auto struct_size = static_cast<std::uint32_t>(size);
    std::memcpy(memory_.data(), &struct_size, sizeof struct_size);
  }
  // Writes a value of known bytes and expects that only the caller's size is written.
  void expect_written_up_to(const Release& by, std::size_t struct_size) {
    memory_.fill(foreign);
    put_size(struct_size);
    Memory expected = memory_;
    by.write(memory_, written);
    const std::size_t end = std::min(struct_size, by.size);
    std::memset(expected.data() + sizeof(std::uint32_t), written, end - sizeof(std::uint32_t));
    EXPECT_TRUE(memory_ == expected) << "struct_size " << struct_size;
  }

  alignas(16) Memory memory_{};
};

// Whether bytes from the field behind struct_size on are those.
bool holds(const Bytes& value, std::size_t last, unsigned char byte) {
  return std::all_of(value.begin() + sizeof(std::uint32_t), value.begin() + static_cast<std::ptrdiff_t>(last),
                     [=](unsigned char b) { return b == byte; });
}

// Whether the new field of a later release is zero.
bool added_is_zero(const Kind& kind, const Bytes& value) {
  return std::all_of(value.begin() + static_cast<std::ptrdiff_t>(kind.now.size), value.end(),
                     [](unsigned char b) { return b == 0; });
}

TEST_F(StructContract, GrowsWithoutPadding) {
  each([](const Kind& kind) { EXPECT_EQ(kind.later.size, kind.now.size + kind.added); });
}

TEST_F(StructContract, AnOldCallerWorksWithALaterLibrary) {
  each([&](const Kind& kind) {
    fill(kind.now.size, kind.now.size);
    const Bytes copy = kind.later.read(memory_);
    std::uint32_t struct_size = 0;
    std::memcpy(&struct_size, copy.data(), sizeof struct_size);
    EXPECT_EQ(struct_size, kind.now.size);
    EXPECT_TRUE(holds(copy, kind.now.size, content));
    EXPECT_TRUE(added_is_zero(kind, copy));  // and not the foreign bytes behind the old struct
    EXPECT_TRUE(added_is_zero(kind, kind.later.read_optional(memory_)));
    expect_written_up_to(kind.later, kind.now.size);
  });
}

TEST_F(StructContract, ALaterCallerWorksWithALaterLibrary) {
  each([&](const Kind& kind) {
    fill(kind.later.size, kind.later.size);
    const Bytes copy = kind.later.read(memory_);
    EXPECT_TRUE(holds(copy, kind.later.size, content));
    EXPECT_FALSE(added_is_zero(kind, copy));
    expect_written_up_to(kind.later, kind.later.size);
  });
}

TEST_F(StructContract, ALaterCallerWorksWithAnOldLibraryWhileTheNewFieldIsZero) {
  each([&](const Kind& kind) {
    fill(kind.now.size, kind.later.size);
    std::memset(memory_.data() + kind.now.size, 0, kind.added);
    EXPECT_TRUE(holds(kind.now.read(memory_), kind.now.size, content));
    expect_written_up_to(kind.now, kind.later.size);
  });
}

TEST_F(StructContract, AnOldLibraryNamesTheByteOfANewFieldThatIsSet) {
  each([&](const Kind& kind) {
    for (std::size_t set = kind.now.size; set < kind.later.size; ++set) {
      fill(kind.now.size, kind.later.size);
      std::memset(memory_.data() + kind.now.size, 0, kind.added);
      memory_[set] = 1;
      const Memory before = memory_;
      try {
        kind.now.read(memory_);
        ADD_FAILURE() << "byte " << set << " was passed over";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), HF_ERROR_INVALID_DESC);
        EXPECT_NE(std::string(error.what()).find("desc: byte " + std::to_string(set) + " "), std::string::npos)
            << error.what();
      }
      EXPECT_EQ(before, memory_);
    }
  });
}

TEST_F(StructContract, SizesBelowTheReleasedOneAreRefusedByBothLibraries) {
  each([&](const Kind& kind) {
    for (const std::size_t below : {std::size_t{0}, std::size_t{4}, kind.now.size / 2, kind.now.size - 1}) {
      fill(kind.now.size, below);
      EXPECT_THROW(kind.now.read(memory_), Error) << below;
      EXPECT_THROW(kind.later.read(memory_), Error) << below;
    }
  });
}

TEST_F(StructContract, NothingIsWrittenBeyondTheCallersSize) {
  each([&](const Kind& kind) {
    for (std::size_t struct_size = kind.now.size; struct_size <= kind.later.size + 16; ++struct_size) {
      expect_written_up_to(kind.now, struct_size);
      expect_written_up_to(kind.later, struct_size);
    }
  });
}

// The list above against the headers: no struct with a struct_size is missing.
TEST(StructList, NamesEveryStructOfTheHeaders) {
  std::set<std::string> declared;
  const std::regex declaration(R"(typedef struct (hf_\w+) \{\s*uint32_t struct_size;)");
  for (const auto& entry : std::filesystem::directory_iterator(HF_SOURCE_DIR "/include/hf")) {
    if (entry.path().extension() != ".h") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string all = text.str();
    for (std::sregex_iterator it(all.begin(), all.end(), declaration), end; it != end; ++it) declared.insert((*it)[1]);
  }
  std::stringstream own;
  own << std::ifstream(HF_SOURCE_DIR "/tests/unit/capi/structs_test.cpp").rdbuf();
  const std::string text = own.str();
  const std::size_t first = text.find("using Structs"), last = text.find(">;", first);
  const std::string list = text.substr(first, last - first);
  std::set<std::string> tested;
  const std::regex name(R"(hf_\w+)");
  for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it) tested.insert((*it)[0]);
  EXPECT_GT(declared.size(), 40u);
  EXPECT_EQ(declared, tested);
  EXPECT_EQ(kinds_of(Structs{}).size(), tested.size());
}

}  // namespace
}  // namespace hf_inner::capi
