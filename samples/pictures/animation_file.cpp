// See animation_file.h. Chunks as in "Portable Network Graphics (PNG) Specification (Third Edition)", which holds APNG.
#include "pictures/animation_file.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

#include "gltf/file_name.h"
#include "gltf/file_write.h"
#include "pictures/palette.h"

namespace samples {

using namespace hf_gltf;
namespace {

using Bytes = std::vector<uint8_t>;

void put16(Bytes& out, uint32_t value) {
  out.push_back(static_cast<uint8_t>(value >> 8 & 255));
  out.push_back(static_cast<uint8_t>(value & 255));
}

void put32(Bytes& out, uint32_t value) {
  put16(out, value >> 16);
  put16(out, value & 0xffff);
}

void put_chunk(Bytes& out, const char (&type)[5], const Bytes& data) {
  put32(out, static_cast<uint32_t>(data.size()));
  const size_t first = out.size();
  out.insert(out.end(), type, type + 4);
  out.insert(out.end(), data.begin(), data.end());
  put32(out, static_cast<uint32_t>(crc32(0, &out[first], static_cast<uInt>(data.size() + 4))));
}

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// The rectangle that differs between two frames. One pixel when none does: a frame may not be empty.
Rectangle changed(const Bytes& before, const Bytes& now, int width) {
  int left = width, right = -1, top = -1, bottom = -1;
  for (size_t p = 0; p < now.size(); ++p) {
    if (before[p] == now[p]) continue;
    const int x = static_cast<int>(p % size_t(width)), y = static_cast<int>(p / size_t(width));
    left = std::min(left, x);
    right = std::max(right, x);
    if (top < 0) top = y;
    bottom = y;
  }
  if (top < 0) return {0, 0, 1, 1};
  return {left, top, right - left + 1, bottom - top + 1};
}

// The rectangle's rows, each after its filter byte; entries are shifted by one, 0 is transparent.
Bytes compressed(const Bytes& now, const Bytes* before, int width, const Rectangle& part) {
  Bytes rows;
  for (int y = part.y; y < part.y + part.height; ++y) {
    rows.push_back(0);
    for (int x = part.x; x < part.x + part.width; ++x) {
      const size_t p = size_t(y) * size_t(width) + size_t(x);
      rows.push_back(before && (*before)[p] == now[p] ? uint8_t{0} : static_cast<uint8_t>(now[p] + 1));
    }
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  Bytes out(size);
  if (compress2(out.data(), &size, rows.data(), static_cast<uLong>(rows.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("encode_frames: zlib refused to compress a frame");
  out.resize(size);
  return out;
}

Bytes frame_control(uint32_t number, const Rectangle& part, uint32_t delay_ms, bool over) {
  Bytes out;
  put32(out, number);
  put32(out, static_cast<uint32_t>(part.width));
  put32(out, static_cast<uint32_t>(part.height));
  put32(out, static_cast<uint32_t>(part.x));
  put32(out, static_cast<uint32_t>(part.y));
  put16(out, delay_ms);
  put16(out, 1000);
  out.push_back(0);  // the frame stays for the next one
  out.push_back(over ? 1 : 0);
  return out;
}

void check(const std::vector<Picture>& frames) {
  if (frames.empty()) throw std::runtime_error("encode_frames: needs at least one frame");
  for (size_t i = 0; i < frames.size(); ++i) {
    const Picture& frame = frames[i];
    if (frame.width <= 0 || frame.height <= 0 || frame.width != frames[0].width || frame.height != frames[0].height ||
        frame.rgb.size() != 3 * size_t(frame.width) * size_t(frame.height))
      throw std::runtime_error("encode_frames: frame " + std::to_string(i) +
                               " is empty or has another size than the first");
  }
}

Bytes palette_bytes(const IndexedPictures& indexed) {
  Bytes out{255, 255, 255};  // the transparent entry
  for (const auto& color : indexed.palette) out.insert(out.end(), color.begin(), color.end());
  return out;
}

}  // namespace

std::vector<uint8_t> encode_frames(const std::vector<Picture>& frames, uint32_t delay_ms) {
  check(frames);
  if (delay_ms > 65535) throw std::runtime_error("encode_frames: a frame lasts at most 65535 ms");
  const int width = frames[0].width, height = frames[0].height;
  const bool moves = frames.size() > 1;
  const IndexedPictures indexed = to_palette(frames);
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, header;
  put32(header, static_cast<uint32_t>(width));
  put32(header, static_cast<uint32_t>(height));
  header.insert(header.end(), {8, 3, 0, 0, 0});  // eight bits, palette, no interlace
  put_chunk(out, "IHDR", header);
  if (moves) {
    Bytes control;
    put32(control, static_cast<uint32_t>(frames.size()));
    put32(control, 0);  // for ever
    put_chunk(out, "acTL", control);
  }
  put_chunk(out, "PLTE", palette_bytes(indexed));
  put_chunk(out, "tRNS", {0});
  uint32_t number = 0;
  for (size_t i = 0; i < frames.size(); ++i) {
    const Bytes* before = i ? &indexed.pixels[i - 1] : nullptr;
    const Rectangle part = i ? changed(*before, indexed.pixels[i], width) : Rectangle{0, 0, width, height};
    const Bytes data = compressed(indexed.pixels[i], before, width, part);
    if (moves) put_chunk(out, "fcTL", frame_control(number++, part, delay_ms, i > 0));
    if (i == 0) {
      put_chunk(out, "IDAT", data);
      continue;
    }
    Bytes numbered;
    put32(numbered, number++);
    numbered.insert(numbered.end(), data.begin(), data.end());
    put_chunk(out, "fdAT", numbered);
  }
  put_chunk(out, "IEND", {});
  return out;
}

void write_frames(const std::string& path, const std::vector<Picture>& frames, uint32_t delay_ms) {
  const std::vector<uint8_t> bytes = encode_frames(frames, delay_ms);
  write_bytes(file_named(path), bytes.data(), bytes.size());
}

}  // namespace samples
