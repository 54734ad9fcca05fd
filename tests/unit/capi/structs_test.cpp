// The contract of structs between releases: every public struct is grown by a field here, and callers and libraries
// from before and after that work together.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
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

using Structs = ::testing::Types<
    hf_factor_desc, hf_surface_desc, hf_surface_info, hf_surface_report, hf_surface_statistics, hf_pick_desc, hf_hit,
    hf_solver_desc, hf_solver_info, hf_sites_desc, hf_edit_desc, hf_sites_info, hf_solve_info, hf_preview_info,
    hf_certificate, hf_solver_statistics, hf_pose_desc, hf_pose_info, hf_handles_desc, hf_handle_info, hf_deform_info,
    hf_deform_desc, hf_skin_info, hf_direction_desc, hf_direction_statistics, hf_scalars, hf_isolines, hf_critical_info,
    hf_geodesics_desc, hf_extremities_desc, hf_propose_desc, hf_region_desc, hf_curve_desc, hf_region_edit_desc,
    hf_region_info, hf_morph_desc, hf_detail_desc, hf_quads_desc, hf_quads_info, hf_quads_mesh, hf_flow_lines,
    hf_transfer_desc, hf_pairs_desc, hf_pair_info, hf_transfer_info, hf_transfer_frame, hf_graph_desc, hf_links_desc,
    hf_gaps_desc, hf_gaps_info, hf_bones_desc, hf_pins_desc, hf_weights_out, hf_weights_info, hf_carry_desc,
    hf_carry_info, hf_mirror_desc, hf_mirror_info, hf_path, hf_transfer_dials>;

// All bytes a caller owns: the struct in front, its own memory behind.
constexpr std::size_t room = 1024;
using Memory = std::array<unsigned char, room>;
constexpr unsigned char content = 0x11, foreign = 0xAB, written = 0xCD;

template <class T>
class StructContract : public ::testing::Test {
 protected:
  static constexpr std::size_t size = sizeof(T), grown = sizeof(Grown<T>);
  static_assert(grown + 64 <= room);
  static_assert(std::is_same_v<decltype(T::struct_size), std::uint32_t>);

  // A struct of `length` bytes of content, foreign bytes behind.
  void fill(std::size_t length, std::uint32_t struct_size) {
    memory_.fill(foreign);
    std::memset(memory_.data(), content, length);
    std::memcpy(memory_.data(), &struct_size, sizeof struct_size);
  }
  template <class S>
  S* given() {
    return reinterpret_cast<S*>(memory_.data());
  }
  bool bytes_are(std::size_t first, std::size_t last, unsigned char value) const {
    for (std::size_t i = first; i < last; ++i) {
      if (memory_[i] != value) return false;
    }
    return true;
  }
  template <class S>
  static bool holds(const S& value, std::size_t first, std::size_t last, unsigned char byte) {
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = first; i < last; ++i) {
      if (bytes[i] != byte) return false;
    }
    return true;
  }
  // Writes a value of known bytes and expects that only the caller's size is written.
  template <class S>
  void expect_written_up_to(std::uint32_t struct_size) {
    memory_.fill(foreign);
    std::memcpy(memory_.data(), &struct_size, sizeof struct_size);
    S value;
    std::memset(static_cast<void*>(&value), written, sizeof value);
    write_struct(given<S>(), value);
    const std::size_t end = std::min<std::size_t>(struct_size, sizeof(S));
    EXPECT_EQ(given<S>()->struct_size, struct_size);
    EXPECT_TRUE(bytes_are(sizeof struct_size, end, written)) << "struct_size " << struct_size;
    EXPECT_TRUE(bytes_are(end, room, foreign)) << "struct_size " << struct_size;
  }

  alignas(16) Memory memory_{};
};

TYPED_TEST_SUITE(StructContract, Structs);

TYPED_TEST(StructContract, GrowsWithoutPadding) {
  using Later = Grown<TypeParam>;
  EXPECT_EQ(sizeof(Later), sizeof(TypeParam) + sizeof(Later::added));
}

TYPED_TEST(StructContract, AnOldCallerWorksWithALaterLibrary) {
  using Later = Grown<TypeParam>;
  this->fill(this->size, static_cast<std::uint32_t>(this->size));
  const Later copy = read_struct(this->template given<Later>(), "desc");
  EXPECT_EQ(copy.struct_size, this->size);
  EXPECT_TRUE(this->holds(copy, sizeof(std::uint32_t), this->size, content));
  EXPECT_EQ(copy.added, 0u);  // and not the foreign bytes behind the old struct
  EXPECT_EQ(read_optional(this->template given<Later>(), "desc").added, 0u);
  this->template expect_written_up_to<Later>(static_cast<std::uint32_t>(this->size));
}

TYPED_TEST(StructContract, ALaterCallerWorksWithALaterLibrary) {
  using Later = Grown<TypeParam>;
  this->fill(this->grown, static_cast<std::uint32_t>(this->grown));
  const Later copy = read_struct(this->template given<Later>(), "desc");
  EXPECT_TRUE(this->holds(copy, sizeof(std::uint32_t), this->grown, content));
  EXPECT_NE(copy.added, 0u);
  this->template expect_written_up_to<Later>(static_cast<std::uint32_t>(this->grown));
}

TYPED_TEST(StructContract, ALaterCallerWorksWithAnOldLibraryWhileTheNewFieldIsZero) {
  this->fill(this->size, static_cast<std::uint32_t>(this->grown));
  std::memset(this->memory_.data() + this->size, 0, this->grown - this->size);
  const TypeParam copy = read_struct(this->template given<TypeParam>(), "desc");
  EXPECT_TRUE(this->holds(copy, sizeof(std::uint32_t), this->size, content));
  this->template expect_written_up_to<TypeParam>(static_cast<std::uint32_t>(this->grown));
}

TYPED_TEST(StructContract, AnOldLibraryNamesTheByteOfANewFieldThatIsSet) {
  for (std::size_t set = this->size; set < this->grown; ++set) {
    this->fill(this->size, static_cast<std::uint32_t>(this->grown));
    std::memset(this->memory_.data() + this->size, 0, this->grown - this->size);
    this->memory_[set] = 1;
    const Memory before = this->memory_;
    try {
      read_struct(this->template given<TypeParam>(), "desc");
      ADD_FAILURE() << "byte " << set << " was passed over";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_INVALID_DESC);
      EXPECT_NE(std::string(error.what()).find("desc: byte " + std::to_string(set) + " "), std::string::npos)
          << error.what();
    }
    EXPECT_EQ(before, this->memory_);
  }
}

TYPED_TEST(StructContract, SizesBelowTheReleasedOneAreRefusedByBothLibraries) {
  for (const std::size_t below : {std::size_t{0}, std::size_t{4}, this->size / 2, this->size - 1}) {
    this->fill(this->size, static_cast<std::uint32_t>(below));
    EXPECT_THROW(read_struct(this->template given<TypeParam>(), "desc"), Error) << below;
    EXPECT_THROW(read_struct(this->template given<Grown<TypeParam>>(), "desc"), Error) << below;
  }
}

TYPED_TEST(StructContract, NothingIsWrittenBeyondTheCallersSize) {
  for (std::uint32_t struct_size = this->size; struct_size <= this->grown + 16; ++struct_size) {
    this->template expect_written_up_to<TypeParam>(struct_size);
    this->template expect_written_up_to<Grown<TypeParam>>(struct_size);
  }
}

// The list above against the headers: no struct with a struct_size is missing.
template <class... T>
std::size_t count_of_types(::testing::Types<T...>) {
  return sizeof...(T);
}

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
  EXPECT_EQ(count_of_types(Structs{}), tested.size());
}

}  // namespace
}  // namespace hf_inner::capi
