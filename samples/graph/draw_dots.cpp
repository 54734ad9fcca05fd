// Draws the dots of the sample with the samples' rasteriser.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "common/picture.h"
#include "graph.h"

int draw_dots(const char* path, const Dots* dots, double dot_radius) {
  try {
    const auto range = std::minmax_element(dots->values, dots->values + dots->count);
    const double low = *range.first, high = *range.second;
    samples::Layer layer;
    for (std::size_t i = 0; i < dots->count; ++i) {
      const double* p = dots->positions + 3 * i;
      layer.surface.positions.insert(layer.surface.positions.end(), p, p + 3);
      const double t = high > low ? (dots->values[i] - low) / (high - low) : 0.5;
      layer.marks.dots.push_back(
          {{p[0], p[1], p[2]}, dot_radius, samples::palette_color(samples::Palette::blue_yellow, t)});
    }
    samples::View view;
    view.width = 480;
    view.height = 640;
    samples::write_png(path, samples::render({layer}, view));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", path, error.what());
    return 1;
  }
}
