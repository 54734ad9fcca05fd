// A sheet, and the Draco stream of it. The stream is made in a library of its own (cmake/HfCompressed.cmake).
#ifndef HF_TESTS_SUPPORT_DRACO_ENCODE_H
#define HF_TESTS_SUPPORT_DRACO_ENCODE_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace samples_test {

// A bumpy sheet: positions and triangles.
struct Sheet {
  std::vector<float> positions;
  std::vector<uint16_t> indices;
  std::size_t vertex_count() const { return positions.size() / 3; }
};
inline Sheet make_sheet(uint16_t width) {
  Sheet out;
  for (uint16_t j = 0; j < width; ++j) {
    for (uint16_t i = 0; i < width; ++i) {
      out.positions.insert(out.positions.end(), {float(i), float(j), 0.25f * float((i * 7 + j * 3) % 5)});
      if (i + 1 == width || j + 1 == width) continue;
      const int a = j * width + i, up = a + width;
      for (const int v : {a, a + 1, up + 1, a, up + 1, up}) out.indices.push_back(static_cast<uint16_t>(v));
    }
  }
  return out;
}

struct DracoStream {
  std::vector<uint8_t> bytes;
  int position = 0, joints = 0, weights = 0;  // ids
};

DracoStream encode_draco(const Sheet& sheet, bool edgebreaker);

}  // namespace samples_test

#endif
