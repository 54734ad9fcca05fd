// Pictures as small files: one as an indexed PNG, several as an animated PNG (APNG).
//
// All frames share one palette of 255 colours. A frame after the first stores the rectangle that changed, and its
// unchanged pixels are transparent. The same frames give the same bytes with one version of zlib.
#ifndef HF_SAMPLES_PICTURES_ANIMATION_FILE_H
#define HF_SAMPLES_PICTURES_ANIMATION_FILE_H

#include <cstdint>
#include <string>
#include <vector>

#include "common/picture.h"

namespace samples {

// Returns the bytes of the file. delay_ms: how long a frame is shown; the animation loops. One frame gives a plain PNG.
// Throws std::runtime_error naming a frame that is empty or has another size than the first.
std::vector<uint8_t> encode_frames(const std::vector<Picture>& frames, uint32_t delay_ms);

void write_frames(const std::string& path, const std::vector<Picture>& frames, uint32_t delay_ms);

}  // namespace samples

#endif
