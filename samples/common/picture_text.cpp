// Text of pictures: an outline font of the system where there is one, a built-in one otherwise.
//
// The outlines are DejaVu Sans, read by Sean Barrett's stb_truetype. Without that font his stb_easy_font stands in:
// axis aligned rectangles. Both know printable ASCII.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_easy_font.h>
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "picture.h"
#include "picture_text.h"

namespace samples {
namespace {

// Where Debian's fonts-dejavu-core and other systems' packages of the font have it.
const char* const font_files[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
// Pixels from ascender to descender at scale 1; a line of text stays within the 16 that sheets give it.
constexpr float line_pixels = 13;

uint8_t byte_of(double value) { return static_cast<uint8_t>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5); }

void blend(Picture& picture, int x, int y, Color color, double cover) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  uint8_t* pixel = &picture.rgb[3 * (size_t(y) * size_t(picture.width) + size_t(x))];
  const double parts[3] = {color.r, color.g, color.b};
  for (int c = 0; c < 3; ++c) pixel[c] = byte_of((1 - cover) * pixel[c] / 255.0 + cover * parts[c]);
}

// Anything outside printable ASCII becomes '?'.
std::string printable(const std::string& text) {
  std::string result = text;
  for (char& c : result) {
    if ((c < 32 || c > 126) && c != '\n') c = '?';
  }
  return result;
}

class OutlineFont {
 public:
  explicit OutlineFont(const char* const* files, size_t count) {
    for (size_t i = 0; i < count && !found_; ++i) {
      std::ifstream in(files[i], std::ios::binary);
      bytes_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
      const int offset = bytes_.empty() ? -1 : stbtt_GetFontOffsetForIndex(bytes_.data(), 0);
      found_ = offset >= 0 && stbtt_InitFont(&font_, bytes_.data(), offset) != 0;
    }
  }
  bool found() const { return found_; }

  // Draws when a picture is given. The width covers every pixel drawn.
  int write(Picture* picture, int x, int y, const std::string& text, int scale, Color color) const {
    const float size = stbtt_ScaleForPixelHeight(&font_, line_pixels * static_cast<float>(scale));
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(&font_, &ascent, &descent, &gap);
    float pen = 0, widest = 0, base = size * static_cast<float>(ascent);
    for (size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') {
        widest = std::max(widest, pen);
        pen = 0;
        base += line_pixels * static_cast<float>(scale);
        continue;
      }
      const int letter = text[i];
      int advance = 0, bearing = 0;
      stbtt_GetCodepointHMetrics(&font_, letter, &advance, &bearing);
      if (picture) put(*picture, x, y, letter, size, pen, base, color);
      pen += size * static_cast<float>(advance);
      if (i + 1 < text.size())
        pen += size * static_cast<float>(stbtt_GetCodepointKernAdvance(&font_, letter, text[i + 1]));
    }
    return static_cast<int>(std::ceil(std::max(widest, pen)));
  }

 private:
  void put(Picture& picture, int x, int y, int letter, float size, float pen, float base, Color color) const {
    const float whole = std::floor(pen), row = std::round(base);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBitmapBoxSubpixel(&font_, letter, size, size, pen - whole, 0, &x0, &y0, &x1, &y1);
    const int width = x1 - x0, height = y1 - y0;
    if (width <= 0 || height <= 0) return;
    std::vector<uint8_t> cover(size_t(width) * size_t(height));
    stbtt_MakeCodepointBitmapSubpixel(&font_, cover.data(), width, height, width, size, size, pen - whole, 0, letter);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        blend(picture, x + static_cast<int>(whole) + x0 + i, y + static_cast<int>(row) + y0 + j, color,
              cover[size_t(j) * size_t(width) + size_t(i)] / 255.0);
  }

  std::vector<uint8_t> bytes_;
  stbtt_fontinfo font_{};
  bool found_ = false;
};

const OutlineFont& system_font() {
  static const OutlineFont font(font_files, std::size(font_files));
  return font;
}

}  // namespace

int write_built_in(Picture* picture, int x, int y, const std::string& text, int scale, Color color) {
  std::string copy = printable(text);
  if (picture) {
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
      for (int j = int(first.y) * scale; j < int(last.y) * scale; ++j)
        for (int i = int(first.x) * scale; i < int(last.x) * scale; ++i) blend(*picture, x + i, y + j, color, 1);
    }
  }
  return stb_easy_font_width(copy.data()) * scale;
}

bool has_outline_font() { return system_font().found(); }

int text_width(const std::string& text, int scale) {
  if (!has_outline_font()) return write_built_in(nullptr, 0, 0, text, scale, {});
  return system_font().write(nullptr, 0, 0, printable(text), scale, {});
}

int draw_text(Picture& picture, int x, int y, const std::string& text, int scale, Color color) {
  check_picture(picture, "draw_text");
  if (!has_outline_font()) return write_built_in(&picture, x, y, text, scale, color);
  return system_font().write(&picture, x, y, printable(text), scale, color);
}

}  // namespace samples
