// See palette.h.
#include "pictures/palette.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

constexpr size_t palette_size = 255;  // one of 256 entries stays free for "transparent"
constexpr size_t cell_count = size_t{1} << 18;

// Colours that agree in the upper six bits of every channel.
struct Cell {
  double weight = 0;
  std::array<double, 3> mean{};
  size_t key = 0;
};

size_t key_of(const uint8_t* rgb) {
  return (size_t{rgb[0]} >> 2) << 12 | (size_t{rgb[1]} >> 2) << 6 | size_t{rgb[2]} >> 2;
}

// The cells in use. The exponent is below 1, so that small marks keep their colour.
std::vector<Cell> cells_of(const std::vector<Picture>& pictures) {
  std::vector<Cell> all(cell_count), used;
  for (const Picture& picture : pictures) {
    for (size_t p = 0; p < picture.rgb.size(); p += 3) {
      Cell& cell = all[key_of(&picture.rgb[p])];
      cell.weight += 1;
      for (size_t c = 0; c < 3; ++c) cell.mean[c] += picture.rgb[p + c];
    }
  }
  for (size_t key = 0; key < cell_count; ++key) {
    Cell cell = all[key];
    if (!(cell.weight > 0)) continue;
    for (double& mean : cell.mean) mean /= cell.weight;
    cell.weight = std::pow(cell.weight, 0.8);
    cell.key = key;
    used.push_back(cell);
  }
  return used;
}

// A run of cells with the channel it spreads most along.
struct Run {
  size_t first = 0, last = 0, channel = 0;
  double spread = 0;
  std::array<double, 3> mean{};
};

Run measured(const std::vector<Cell>& cells, size_t first, size_t last) {
  Run run{first, last};
  double weight = 0;
  for (size_t i = first; i < last; ++i) {
    weight += cells[i].weight;
    for (size_t c = 0; c < 3; ++c) run.mean[c] += cells[i].weight * cells[i].mean[c];
  }
  for (double& mean : run.mean) mean /= weight;
  for (size_t c = 0; c < 3; ++c) {
    double spread = 0;
    for (size_t i = first; i < last; ++i) {
      const double off = cells[i].mean[c] - run.mean[c];
      spread += cells[i].weight * off * off;
    }
    if (spread > run.spread) {
      run.spread = spread;
      run.channel = c;
    }
  }
  return run;
}

std::vector<Run> median_cut(std::vector<Cell>& cells) {
  std::vector<Run> runs{measured(cells, 0, cells.size())};
  while (runs.size() < palette_size) {
    const auto widest =
        std::max_element(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.spread < b.spread; });
    if (!(widest->spread > 0)) break;
    const Run run = *widest;
    const auto begin = cells.begin() + std::ptrdiff_t(run.first), end = cells.begin() + std::ptrdiff_t(run.last);
    const auto middle = std::stable_partition(
        begin, end, [&](const Cell& cell) { return cell.mean[run.channel] < run.mean[run.channel]; });
    const size_t cut = run.first + size_t(middle - begin);
    if (cut == run.first || cut == run.last) break;
    *widest = measured(cells, run.first, cut);
    runs.push_back(measured(cells, cut, run.last));
  }
  return runs;
}

size_t nearest(const std::vector<std::array<uint8_t, 3>>& palette, const std::array<double, 3>& color) {
  size_t best = 0;
  double least = 1e300;
  for (size_t i = 0; i < palette.size(); ++i) {
    double distance = 0;
    for (size_t c = 0; c < 3; ++c) distance += (palette[i][c] - color[c]) * (palette[i][c] - color[c]);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

// Two entries whose mixture is nearer to a colour than either, and the share of the second in 1 / 16.
struct Mixture {
  uint8_t first = 0, second = 0, share = 0;
};

Mixture mixture_of(const std::vector<std::array<uint8_t, 3>>& palette, const std::array<double, 3>& color) {
  const size_t first = nearest(palette, color);
  std::array<double, 3> beyond{};
  for (size_t c = 0; c < 3; ++c) beyond[c] = 2 * color[c] - palette[first][c];
  const size_t second = nearest(palette, beyond);
  double along = 0, length = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double step = double(palette[second][c]) - palette[first][c];
    along += step * (color[c] - palette[first][c]);
    length += step * step;
  }
  // far apart they would be seen as dots
  const bool mixed = length > 0 && length < 24 * 24 && along > 0;
  return {static_cast<uint8_t>(first), static_cast<uint8_t>(second),
          static_cast<uint8_t>(mixed ? std::lround(16 * along / length) : 0)};
}

// Thresholds of ordered dithering (Bayer 1973): the same places in every frame, so that still pixels stay still.
constexpr uint8_t thresholds[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

}  // namespace

IndexedPictures to_palette(const std::vector<Picture>& pictures) {
  IndexedPictures out;
  std::vector<Cell> cells = cells_of(pictures);
  if (cells.empty()) return out;
  for (const Run& run : median_cut(cells)) {
    std::array<uint8_t, 3> color{};
    for (size_t c = 0; c < 3; ++c) color[c] = static_cast<uint8_t>(std::lround(run.mean[c]));
    out.palette.push_back(color);
  }
  std::vector<Mixture> mixtures(cell_count);
  for (const Cell& cell : cells) mixtures[cell.key] = mixture_of(out.palette, cell.mean);
  for (const Picture& picture : pictures) {
    std::vector<uint8_t> pixels(picture.rgb.size() / 3);
    for (size_t p = 0; p < pixels.size(); ++p) {
      const Mixture& mixture = mixtures[key_of(&picture.rgb[3 * p])];
      const size_t x = p % size_t(picture.width), y = p / size_t(picture.width);
      pixels[p] = mixture.share > thresholds[y % 4][x % 4] ? mixture.second : mixture.first;
    }
    out.pixels.push_back(std::move(pixels));
  }
  return out;
}

}  // namespace samples
