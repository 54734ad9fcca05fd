// The pictures of the documentation: the writer of animated PNG files, and hf_pictures run at a tiny size.
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/picture_text.h"
#include "gltf/file_bytes.h"
#include "pictures/animation_file.h"
#include "pictures/palette.h"
#include "support/full.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using namespace hf_gltf;
using Bytes = std::vector<uint8_t>;

uint32_t read32(const Bytes& bytes, size_t at) {
  return uint32_t{bytes.at(at)} << 24 | uint32_t{bytes.at(at + 1)} << 16 | uint32_t{bytes.at(at + 2)} << 8 |
         uint32_t{bytes.at(at + 3)};
}

struct Chunk {
  std::string type;
  Bytes data;
};

// Every chunk of a PNG file, in order; its sum is checked.
std::vector<Chunk> chunks_of(const Bytes& file) {
  std::vector<Chunk> chunks;
  const Bytes signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  EXPECT_EQ(Bytes(file.begin(), file.begin() + 8), signature);
  for (size_t at = 8; at < file.size();) {
    const size_t size = read32(file, at);
    if (at + 12 + size > file.size()) throw std::runtime_error("a chunk ends behind the file");
    EXPECT_EQ(read32(file, at + 8 + size), crc32(0, &file[at + 4], static_cast<uInt>(size + 4)));
    chunks.push_back({std::string(file.begin() + std::ptrdiff_t(at) + 4, file.begin() + std::ptrdiff_t(at) + 8),
                      Bytes(file.begin() + std::ptrdiff_t(at) + 8, file.begin() + std::ptrdiff_t(at + 8 + size))});
    at += 12 + size;
  }
  return chunks;
}

struct Decoded {
  uint32_t width = 0, height = 0, announced = 1;
  std::vector<Bytes> frames;  // rgb, as a viewer shows them
};

Decoded decode(const Bytes& file) {
  Decoded out;
  Bytes palette, canvas, shown;
  uint32_t number = 0, part[4] = {0, 0, 0, 0};
  const auto show = [&](const uint8_t* data, size_t size) {
    uLongf length = (part[0] + 1) * part[1];
    Bytes rows(length);
    if (uncompress(rows.data(), &length, data, static_cast<uLong>(size)) != Z_OK || length != rows.size())
      throw std::runtime_error("the pixels of a frame do not fit its rectangle");
    for (uint32_t y = 0; y < part[1]; ++y) {
      for (uint32_t x = 0; x < part[0]; ++x) {
        const size_t entry = rows[y * (part[0] + 1) + 1 + x], at = 3 * (size_t{part[3] + y} * out.width + part[2] + x);
        if (entry) std::copy_n(&palette.at(3 * entry), 3, &canvas.at(at));
      }
    }
    out.frames.push_back(canvas);
  };
  for (const Chunk& chunk : chunks_of(file)) {
    if (chunk.type == "IHDR") {
      out.width = part[0] = read32(chunk.data, 0);
      out.height = part[1] = read32(chunk.data, 4);
      canvas.resize(3 * size_t{out.width} * out.height);
    } else if (chunk.type == "acTL") {
      out.announced = read32(chunk.data, 0);
    } else if (chunk.type == "PLTE") {
      palette = chunk.data;
    } else if (chunk.type == "fcTL") {
      EXPECT_EQ(read32(chunk.data, 0), number++);
      for (size_t i = 0; i < 4; ++i) part[i] = read32(chunk.data, 4 + 4 * i);
      EXPECT_TRUE(part[0] > 0 && part[1] > 0 && part[2] + part[0] <= out.width && part[3] + part[1] <= out.height);
    } else if (chunk.type == "IDAT") {
      show(chunk.data.data(), chunk.data.size());
    } else if (chunk.type == "fdAT") {
      EXPECT_EQ(read32(chunk.data, 0), number++);
      show(chunk.data.data() + 4, chunk.data.size() - 4);
    }
  }
  return out;
}

Picture noise(int width, int height, uint32_t seed, uint32_t colors) {
  Picture picture{width, height, {}};
  for (int p = 0; p < width * height; ++p) {
    seed = seed * 1664525u + 1013904223u;
    const uint32_t color = (seed >> 16) % colors;
    picture.rgb.insert(picture.rgb.end(), {uint8_t(color * 7), uint8_t(255 - color * 5), uint8_t(color * 13 % 251)});
  }
  return picture;
}

TEST(AnimationFile, FewColoursComeBackAsTheyWere) {
  std::vector<Picture> frames{noise(31, 17, 1, 30), noise(31, 17, 2, 30)};
  frames.push_back(frames.back());  // nothing changes
  frames.push_back(frames.back());
  frames.back().rgb[3 * (5 * 31 + 9)] ^= 255;  // one pixel does
  const Decoded decoded = decode(encode_frames(frames, 40));
  EXPECT_EQ(decoded.announced, 4u);
  ASSERT_EQ(decoded.frames.size(), frames.size());
  for (size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(decoded.frames[i], frames[i].rgb) << i;
}

TEST(AnimationFile, ManyColoursComeBackNearly) {
  Picture picture{64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) picture.rgb.insert(picture.rgb.end(), {uint8_t(4 * x), uint8_t(4 * y), 90});
  const Decoded decoded = decode(encode_frames({picture}, 40));
  ASSERT_EQ(decoded.frames.size(), 1u);
  int worst = 0;
  for (size_t i = 0; i < picture.rgb.size(); ++i)
    worst = std::max(worst, std::abs(int{picture.rgb[i]} - int{decoded.frames[0][i]}));
  EXPECT_LE(worst, 28);
}

TEST(AnimationFile, BadFramesAreRefusedByNumber) {
  EXPECT_THROW(encode_frames({}, 40), std::runtime_error);
  try {
    encode_frames({noise(8, 8, 1, 5), noise(8, 9, 1, 5)}, 40);
    FAIL() << "another size was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("frame 1"), std::string::npos) << error.what();
  }
}

TEST(PictureText, TheBuiltInFontDrawsWhereItSays) {
  Picture picture{120, 16, Bytes(3 * 120 * 16, 255)};
  const int width = write_built_in(&picture, 0, 0, "Iso 42%", 1, {0, 0, 0});
  EXPECT_EQ(width, write_built_in(nullptr, 0, 0, "Iso 42%", 1, {}));
  int dark = 0;
  for (size_t p = 0; p < picture.rgb.size(); p += 3) {
    if (picture.rgb[p] != 0) continue;
    ++dark;
    EXPECT_LT(int(p / 3) % 120, width);
  }
  EXPECT_GT(dark, 40);
}

TEST(PicturesProgram, WritesWholeFilesOfTheRightFrames) {
  const samples_test::TemporaryFolder folder;
  const fs::path out = folder.path / "pictures";
  std::string said;
  const std::string pairs = hf_test::quoted(fs::path(HF_SOURCE_DIR) / "samples/transfer/pairs/horse_to_bull.json");
  ASSERT_EQ(hf_test::run(hf_test::quoted(HF_PICTURES_PROGRAM) + " " + hf_test::quoted(out) + " --pairs " + pairs +
                             " --vertices 2000 --frames 6 --percent 12",
                         said),
            0)
      << said;
  const Decoded moving = decode(read_bytes(out / "hf.png", 1 << 24));
  EXPECT_EQ(moving.announced, 6u);
  ASSERT_EQ(moving.frames.size(), 6u);
  for (size_t i = 1; i < moving.frames.size(); ++i) EXPECT_NE(moving.frames[i], moving.frames[i - 1]) << i;
  for (const char* name :
       {"field", "pose", "transfer", "surface", "geodesics", "cut", "quads", "detail", "direction"}) {
    const Decoded still = decode(read_bytes(out / ("ability_" + std::string(name) + ".png"), 1 << 24));
    const uint32_t times =
        name == std::string("surface") || name == std::string("geodesics") || name == std::string("cut") ? 2 : 1;
    EXPECT_EQ(still.width, times * (320u * 12 / 100)) << name;
    EXPECT_EQ(still.height, times * (240u * 12 / 100)) << name;
    ASSERT_EQ(still.frames.size(), 1u) << name;
    // something is drawn: not every pixel is that of the corner
    size_t other = 0;
    for (size_t p = 0; p < still.frames[0].size(); p += 3) other += still.frames[0][p] != still.frames[0][0];
    EXPECT_GT(other, still.frames[0].size() / 3 / 20) << name;
  }
  EXPECT_NE(hf_test::run(hf_test::quoted(HF_PICTURES_PROGRAM) + " " + hf_test::quoted(out), said), 0);
  EXPECT_NE(said.find("--pairs"), std::string::npos) << said;
}

// The part of pixels that differ by more than two palettes of one picture do.
double differing(const Bytes& a, const Bytes& b) {
  if (a.size() != b.size()) return 1;
  size_t count = 0;
  for (size_t p = 0; p < a.size(); p += 3) {
    int most = 0;
    for (size_t k = p; k < p + 3; ++k) most = std::max(most, std::abs(int{a[k]} - int{b[k]}));
    count += most > 48;
  }
  return static_cast<double>(3 * count) / static_cast<double>(a.size());
}

TEST(PicturesProgram, MakesThePicturesOfTheDocumentationAgain) {
  const fs::path kept = fs::path(HF_SOURCE_DIR) / "docs/pictures";
  EXPECT_LE(fs::file_size(kept / "hf.png"), 3'000'000u);
  const Decoded moving = decode(read_bytes(kept / "hf.png", 1 << 24));
  EXPECT_EQ(moving.width, 700u);
  EXPECT_EQ(moving.frames.size(), moving.announced);
  ASSERT_EQ(moving.frames.size(), 48u);

  // the long form draws every frame
  const size_t every = hf_test::is_full() ? 1 : 48;
  const samples_test::TemporaryFolder folder;
  std::string said;
  ASSERT_EQ(hf_test::run(hf_test::quoted(HF_PICTURES_PROGRAM) + " " + hf_test::quoted(folder.path) + " --pairs " +
                             hf_test::quoted(fs::path(HF_SOURCE_DIR) / "samples/transfer/pairs/horse_to_bull.json") +
                             " --every " + std::to_string(every),
                         said),
            0)
      << said;
  // 0.1 % of a picture: a leg that is 4 pixels off is 0.2 % of it
  const double most = 1e-3;
  const Decoded made = decode(read_bytes(folder.path / "hf.png", 1 << 24));
  ASSERT_EQ(made.frames.size(), 48 / every);
  for (size_t i = 0; i < made.frames.size(); ++i)
    EXPECT_LE(differing(made.frames[i], moving.frames[i * every]), most) << "frame " << i * every;
  for (const char* name :
       {"field", "pose", "transfer", "surface", "geodesics", "cut", "quads", "detail", "direction"}) {
    const std::string file = "ability_" + std::string(name) + ".png";
    const auto still = [&](const fs::path& in) { return decode(read_bytes(in / file, 1 << 24)).frames.at(0); };
    EXPECT_LE(differing(still(folder.path), still(kept)), most) << file << ": samples/pictures/make writes it anew";
  }
}

}  // namespace
