// Inside the pictures: which font text is drawn in. Users include picture.h.
#ifndef HF_SAMPLES_COMMON_PICTURE_TEXT_H
#define HF_SAMPLES_COMMON_PICTURE_TEXT_H

#include <string>

#include "picture.h"

namespace samples {

// Whether the system has the font of outlines.
bool has_outline_font();

// Text in the font that is always there, or its width alone without a picture.
int write_built_in(Picture* picture, int x, int y, const std::string& text, int scale, Color color);

// Throws std::runtime_error "what: ..." when the picture is empty or its pixels do not fit its size.
void check_picture(const Picture& picture, const char* what);

}  // namespace samples

#endif
