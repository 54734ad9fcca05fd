// Contact sheets and PNG files. The encoder is Sean Barrett's stb_image_write, compiled here as static functions
// because tinygltf carries its own copy.
#include <algorithm>
#include <stdexcept>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "gltf/file_name.h"
#include "gltf/file_write.h"
#include "picture.h"
#include "picture_text.h"

namespace samples {

using namespace hf_gltf;

// Pixels that a sheet gives a line of text at scale 1.
constexpr int line_height = 16;

void paste(Picture& page, const Picture& tile, int x, int y) {
  for (int row = 0; row < tile.height; ++row) {
    const auto from = tile.rgb.begin() + std::ptrdiff_t(3) * row * tile.width;
    std::copy(from, from + std::ptrdiff_t(3) * tile.width,
              page.rgb.begin() + std::ptrdiff_t(3) * (std::ptrdiff_t(y + row) * page.width + x));
  }
}

namespace {

// Twice as large where the tiles are wide enough for every label.
int label_scale_of(const std::vector<std::string>& labels, int cell_width) {
  int widest = 0;
  for (const std::string& label : labels) widest = std::max(widest, text_width(label, 2));
  return cell_width >= 240 && widest <= cell_width ? 2 : 1;
}

}  // namespace

void check_picture(const Picture& picture, const char* what) {
  if (picture.width <= 0 || picture.height <= 0 ||
      picture.rgb.size() != 3 * size_t(picture.width) * size_t(picture.height)) {
    throw std::runtime_error(std::string(what) + ": the picture is empty or its pixel array has the wrong size");
  }
}

Picture contact_sheet(const std::vector<Picture>& tiles, int columns, const std::vector<std::string>& labels,
                      const std::string& title) {
  if (tiles.empty() || columns < 1) throw std::runtime_error("contact_sheet: needs at least one tile and one column");
  if (labels.size() > tiles.size()) throw std::runtime_error("contact_sheet: more labels than tiles");
  int cell_width = 0, cell_height = 0;
  for (const Picture& tile : tiles) {
    check_picture(tile, "contact_sheet");
    cell_width = std::max(cell_width, tile.width);
    cell_height = std::max(cell_height, tile.height);
  }
  const int gap = 8, count = static_cast<int>(tiles.size());
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const int label_scale = label_scale_of(labels, cell_width), title_scale = label_scale + 1;
  const int label_height = labels.empty() ? 0 : line_height * label_scale;
  const int title_height = title.empty() ? 0 : line_height * title_scale + gap;
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
  check_picture(picture, "encode_png");
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
  write_bytes(file_named(path), bytes.data(), bytes.size());
}

}  // namespace samples
