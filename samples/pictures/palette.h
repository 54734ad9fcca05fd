// One palette for many pictures: median cut (Heckbert 1982) over their colours, and ordered dithering.
#ifndef HF_SAMPLES_PICTURES_PALETTE_H
#define HF_SAMPLES_PICTURES_PALETTE_H

#include <array>
#include <cstdint>
#include <vector>

#include "common/picture.h"

namespace samples {

struct IndexedPictures {
  std::vector<std::array<uint8_t, 3>> palette;  // at most 255 colours
  std::vector<std::vector<uint8_t>> pixels;     // per picture: a palette entry per pixel
};

// The colours are exact if the pictures have at most 255 colours that differ in their upper six bits.
IndexedPictures to_palette(const std::vector<Picture>& pictures);

}  // namespace samples

#endif
