// Text, contact sheets and PNG files. The letters are Sean Barrett's stb_easy_font (axis-aligned rectangles, ASCII),
// the encoder is his stb_image_write, compiled here as static functions because tinygltf carries its own copy.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "picture.h"

namespace samples {
namespace {

uint8_t byte_of(double value) { return static_cast<uint8_t>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5); }

void fill_rectangle(Picture& picture, int x0, int y0, int x1, int y1, Color color) {
  const uint8_t bytes[3] = {byte_of(color.r), byte_of(color.g), byte_of(color.b)};
  for (int y = std::max(y0, 0); y < std::min(y1, picture.height); ++y) {
    for (int x = std::max(x0, 0); x < std::min(x1, picture.width); ++x) {
      std::copy(bytes, bytes + 3, &picture.rgb[3 * (size_t(y) * size_t(picture.width) + size_t(x))]);
    }
  }
}

void paste(Picture& page, const Picture& tile, int x0, int y0) {
  for (int y = 0; y < tile.height; ++y) {
    const auto row = tile.rgb.begin() + std::ptrdiff_t(3) * y * tile.width;
    std::copy(row, row + std::ptrdiff_t(3) * tile.width,
              page.rgb.begin() + std::ptrdiff_t(3) * (std::ptrdiff_t(y0 + y) * page.width + x0));
  }
}

void check(const Picture& picture, const char* what) {
  if (picture.width <= 0 || picture.height <= 0 ||
      picture.rgb.size() != 3 * size_t(picture.width) * size_t(picture.height)) {
    throw std::runtime_error(std::string(what) + ": the picture is empty or its pixel array has the wrong size");
  }
}

// stb_easy_font takes writable text; anything outside printable ASCII becomes '?'.
std::string printable(const std::string& text) {
  std::string result = text;
  for (char& c : result) {
    if ((c < 32 || c > 126) && c != '\n') c = '?';
  }
  return result;
}

}  // namespace

int text_width(const std::string& text, int scale) {
  std::string copy = printable(text);
  return stb_easy_font_width(copy.data()) * scale;
}

int draw_text(Picture& picture, int x, int y, const std::string& text, int scale, Color color) {
  check(picture, "draw_text");
  std::string copy = printable(text);
  struct Corner {
    float x, y, z;
    uint8_t color[4];
  };
  // the font's manual allows about 270 bytes per character
  std::vector<Corner> corners((copy.size() + 1) * 320 / sizeof(Corner));
  const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  for (int quad = 0; quad < quads; ++quad) {
    const Corner& first = corners[4 * size_t(quad)];
    const Corner& last = corners[4 * size_t(quad) + 2];
    fill_rectangle(picture, x + int(first.x) * scale, y + int(first.y) * scale, x + int(last.x) * scale,
                   y + int(last.y) * scale, color);
  }
  return text_width(text, scale);
}

Picture contact_sheet(const std::vector<Picture>& tiles, int columns, const std::vector<std::string>& labels,
                      const std::string& title) {
  if (tiles.empty() || columns < 1) throw std::runtime_error("contact_sheet: needs at least one tile and one column");
  if (labels.size() > tiles.size()) throw std::runtime_error("contact_sheet: more labels than tiles");
  int cell_width = 0, cell_height = 0;
  for (const Picture& tile : tiles) {
    check(tile, "contact_sheet");
    cell_width = std::max(cell_width, tile.width);
    cell_height = std::max(cell_height, tile.height);
  }
  const int gap = 8, count = static_cast<int>(tiles.size());
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const int label_scale = cell_width >= 360 ? 2 : 1, title_scale = label_scale + 1;
  const int label_height = labels.empty() ? 0 : 12 * label_scale;
  const int title_height = title.empty() ? 0 : 12 * title_scale + gap;
  Picture page;
  page.width = gap + columns * (cell_width + gap);
  if (!title.empty()) page.width = std::max(page.width, text_width(title, title_scale) + 2 * gap);
  page.height = gap + title_height + rows * (cell_height + label_height + gap);
  page.rgb.assign(3 * size_t(page.width) * size_t(page.height), 255);
  if (!title.empty()) draw_text(page, gap, gap, title, title_scale);
  for (int i = 0; i < count; ++i) {
    const Picture& tile = tiles[size_t(i)];
    const int x = gap + (i % columns) * (cell_width + gap);
    const int y = gap + title_height + (i / columns) * (cell_height + label_height + gap);
    paste(page, tile, x + (cell_width - tile.width) / 2, y + (cell_height - tile.height) / 2);
    if (size_t(i) < labels.size()) {
      const int indent = std::max(0, (cell_width - text_width(labels[size_t(i)], label_scale)) / 2);
      draw_text(page, x + indent, y + cell_height + 2 * label_scale, labels[size_t(i)], label_scale);
    }
  }
  return page;
}

std::vector<uint8_t> encode_png(const Picture& picture) {
  check(picture, "encode_png");
  std::vector<uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    auto& out = *static_cast<std::vector<uint8_t>*>(context);
    out.insert(out.end(), static_cast<uint8_t*>(data), static_cast<uint8_t*>(data) + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, picture.rgb.data(),
                              3 * picture.width)) {
    throw std::runtime_error("encode_png: out of memory");
  }
  return bytes;
}

void write_png(const std::string& path, const Picture& picture) {
  const std::vector<uint8_t> bytes = encode_png(picture);
  const std::string temporary = path + ".part";
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.flush();
    if (!file) {
      file.close();
      std::remove(temporary.c_str());
      throw std::runtime_error("cannot write " + temporary + ": check that the folder exists and has room");
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::remove(temporary.c_str());
    throw std::runtime_error("cannot rename " + temporary + " to " + path + ": " + error.message());
  }
}

}  // namespace samples
