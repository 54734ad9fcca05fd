// Plain SVG pictures of benchmark results: curves over a number, and groups of bars. Axes with ticks and labels, grid,
// legend, linear or logarithmic scales; white background, colours that colour-blind readers can tell apart.
#ifndef HF_BENCH_SVG_PLOT_H
#define HF_BENCH_SVG_PLOT_H

#include <string>
#include <utility>
#include <vector>

namespace bench {

struct PlotText {
  std::string title, subtitle, x_label, y_label;
};

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool dashed = false;
  int colour = -1;  // index into the palette; -1: the curve's own number
};

struct CurvePlot {
  PlotText text;
  std::vector<Curve> curves;
  bool log_x = true, log_y = true;
};

struct Bars {
  std::string name;
  std::vector<double> values;  // one per group; NaN: no bar
};

struct BarPlot {
  PlotText text;
  std::vector<std::string> groups;
  std::vector<Bars> bars;
  bool log_y = false;
  const char* format = nullptr;  // of the number over a bar; null: three digits
};

// Write the picture; std::runtime_error when the file cannot be written or there is nothing to draw.
void write_svg(const std::string& file, const CurvePlot& plot);
void write_svg(const std::string& file, const BarPlot& plot);

}  // namespace bench

#endif
