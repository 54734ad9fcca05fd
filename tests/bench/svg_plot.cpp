#include "bench/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "gltf/file_write.h"

namespace bench {
namespace {

// Okabe and Ito's palette (2008).
constexpr const char* palette[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444"};
constexpr int colour_count = 7;
constexpr double left = 78, right = 24, top = 62, bottom = 64, row_height = 18;

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* pattern, ...) {
  char text[512];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string number(double value) {
  if (value == 0) return "0";
  const double size = std::fabs(value);
  if (size >= 1e6) return format("%gM", value / 1e6);
  if (size >= 1e4) return format("%gK", value / 1e3);
  if (size < 1e-3) return format("%.0e", value);
  return format("%g", value);
}

// One axis: data to pixels, and where its ticks are.
class Axis {
 public:
  Axis(std::vector<double> values, bool logarithmic, double from, double to)
      : logarithmic_(logarithmic), from_(from), to_(to) {
    const auto unusable = [&](double v) { return !std::isfinite(v) || (logarithmic && v <= 0); };
    values.erase(std::remove_if(values.begin(), values.end(), unusable), values.end());
    if (values.empty()) throw std::runtime_error("plot: nothing to draw");
    low_ = *std::min_element(values.begin(), values.end());
    high_ = *std::max_element(values.begin(), values.end());
    logarithmic ? decades() : steps();
  }
  double at(double value) const {
    const double t = logarithmic_ ? std::log(std::max(value, low_) / low_) / std::log(high_ / low_)
                                  : (value - low_) / (high_ - low_);
    return from_ + t * (to_ - from_);
  }
  bool draws(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  const std::vector<double>& ticks() const { return ticks_; }
  double low() const { return low_; }

 private:
  void decades() {
    const double span = std::log10(high_ / low_);
    low_ = std::pow(10, std::floor(std::log10(low_ * 0.99) * (span > 3 ? 1 : 2)) / (span > 3 ? 1 : 2));
    high_ *= 1.25;
    const int first = static_cast<int>(std::floor(std::log10(low_))),
              last = static_cast<int>(std::ceil(std::log10(high_)));
    const int every = std::max(1, (last - first) / 10);
    for (int decade = first; decade <= last; ++decade) {
      for (const double m : {1.0, 2.0, 5.0}) {
        const double tick = m * std::pow(10, decade);
        const bool wanted = m == 1.0 ? (decade - first) % every == 0 : last - first <= 3;
        if (wanted && tick >= low_ * 0.999 && tick <= high_ * 1.001) ticks_.push_back(tick);
      }
    }
  }
  void steps() {
    low_ = std::min(low_, 0.0);
    high_ = high_ > low_ ? high_ * 1.1 : low_ + 1;
    double step = std::pow(10, std::floor(std::log10((high_ - low_) / 4)));
    for (const double m : {2.0, 2.5, 2.0}) {
      if ((high_ - low_) / step > 7) step *= m;
    }
    for (double tick = std::ceil(low_ / step) * step; tick <= high_; tick += step) ticks_.push_back(tick);
  }
  bool logarithmic_;
  double from_, to_, low_ = 0, high_ = 1;
  std::vector<double> ticks_;
};

// The sheet: collects the elements and writes them.
class Sheet {
 public:
  Sheet(double width, double height) : width_(width), height_(height) {}
  void add(const std::string& element) { body_ += element + "\n"; }
  void line(double x1, double y1, double x2, double y2, const char* style) {
    add(format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>", x1, y1, x2, y2, style));
  }
  void text(double x, double y, const std::string& words, const std::string& style) {
    add(format("<text x=\"%.1f\" y=\"%.1f\" ", x, y) + style + ">" + escaped(words) + "</text>");
  }
  void write(const std::string& file) const {
    const std::string head = format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
        "viewBox=\"0 0 %.0f %.0f\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n",
        width_, height_, width_, height_);
    hf_gltf::write_bytes(file, head + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body_ + "</svg>\n");
  }

 private:
  double width_, height_;
  std::string body_;
};

struct Frame {
  double width, height, x0, x1, y0, y1;  // pixels; y0 below
};

Frame frame_of(double width, size_t legend_rows) {
  const double legend = row_height * static_cast<double>(legend_rows);
  const double height = 400 + legend;
  return {width, height, left, width - right, height - bottom - legend, top};
}

void draw_frame(Sheet& sheet, const Frame& frame, const PlotText& text, const Axis& y) {
  sheet.text(left, 24, text.title, "font-size=\"15\" font-weight=\"bold\"");
  sheet.text(left, 43, text.subtitle, "fill=\"#555555\"");
  for (const double tick : y.ticks()) {
    sheet.line(frame.x0, y.at(tick), frame.x1, y.at(tick), "stroke=\"#e0e0e0\"");
    sheet.text(frame.x0 - 6, y.at(tick) + 4, number(tick), "text-anchor=\"end\"");
  }
  sheet.line(frame.x0, frame.y0, frame.x1, frame.y0, "stroke=\"black\"");
  sheet.line(frame.x0, frame.y0, frame.x0, frame.y1, "stroke=\"black\"");
  const double middle = (frame.y0 + frame.y1) / 2;
  sheet.text(18, middle, text.y_label, format("text-anchor=\"middle\" transform=\"rotate(-90 18 %.1f)\"", middle));
  sheet.text((frame.x0 + frame.x1) / 2, frame.y0 + 42, text.x_label, "text-anchor=\"middle\"");
}

struct Name {
  std::string text;
  int colour;
  bool dashed;
};

// Two names a row, below the picture.
void draw_legend(Sheet& sheet, const Frame& frame, const std::vector<Name>& names) {
  for (size_t i = 0; i < names.size(); ++i) {
    const double x = frame.x0 + (i % 2 ? (frame.x1 - frame.x0) / 2 : 0);
    const double y = frame.y0 + bottom + row_height * static_cast<double>(i / 2);
    sheet.line(x, y - 4, x + 24, y - 4,
               format("stroke=\"%s\" stroke-width=\"4\"%s", palette[names[i].colour],
                      names[i].dashed ? " stroke-dasharray=\"6 4\"" : "")
                   .c_str());
    sheet.text(x + 32, y, names[i].text, "");
  }
}

}  // namespace

void write_svg(const std::string& file, const CurvePlot& plot) {
  const Frame frame = frame_of(720, (plot.curves.size() + 1) / 2);
  std::vector<double> xs, ys;
  for (const Curve& curve : plot.curves) {
    for (const auto& [x, y] : curve.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  const Axis x(xs, plot.log_x, frame.x0, frame.x1), y(ys, plot.log_y, frame.y0, frame.y1);
  Sheet sheet(frame.width, frame.height);
  draw_frame(sheet, frame, plot.text, y);
  for (const double tick : x.ticks()) {
    sheet.line(x.at(tick), frame.y0, x.at(tick), frame.y1, "stroke=\"#e0e0e0\"");
    sheet.text(x.at(tick), frame.y0 + 18, number(tick), "text-anchor=\"middle\"");
  }
  std::vector<Name> names;
  for (size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    const int colour = (curve.colour < 0 ? static_cast<int>(i) : curve.colour) % colour_count;
    std::string path;
    for (const auto& [px, py] : curve.points) {
      if (!x.draws(px) || !y.draws(py)) continue;
      path += format("%s%.1f %.1f ", path.empty() ? "M" : "L", x.at(px), y.at(py));
      if (!curve.dashed)
        sheet.add(format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>", x.at(px), y.at(py), palette[colour]));
    }
    sheet.add(format("<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\"%s d=\"", palette[colour],
                     curve.dashed ? " stroke-dasharray=\"6 4\"" : "") +
              path + "\"/>");
    names.push_back({curve.name, colour, curve.dashed});
  }
  draw_legend(sheet, frame, names);
  sheet.write(file);
}

void write_svg(const std::string& file, const BarPlot& plot) {
  const double bar_width = plot.groups.size() * plot.bars.size() > 32 ? 19 : 30;
  const double group_width = bar_width * static_cast<double>(plot.bars.size()) + 22;
  const Frame frame = frame_of(std::max(720.0, left + right + group_width * static_cast<double>(plot.groups.size())),
                               (plot.bars.size() + 1) / 2);
  std::vector<double> values;
  for (const Bars& bars : plot.bars) values.insert(values.end(), bars.values.begin(), bars.values.end());
  const Axis y(values, plot.log_y, frame.y0, frame.y1 + 8);
  Sheet sheet(frame.width, frame.height);
  draw_frame(sheet, frame, plot.text, y);
  const double step = (frame.x1 - frame.x0) / static_cast<double>(plot.groups.size());
  std::vector<Name> names;
  for (size_t b = 0; b < plot.bars.size(); ++b) {
    const int colour = static_cast<int>(b) % colour_count;
    names.push_back({plot.bars[b].name, colour, false});
    for (size_t g = 0; g < plot.groups.size(); ++g) {
      const double value = plot.bars[b].values.at(g);
      if (!y.draws(value)) continue;
      const double centre = frame.x0 + step * (static_cast<double>(g) + 0.5);
      const double x = centre + bar_width * (static_cast<double>(b) - static_cast<double>(plot.bars.size()) / 2);
      sheet.add(format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>", x + 1, y.at(value),
                       bar_width - 2, std::max(0.0, frame.y0 - y.at(value)), palette[colour]));
      char text[64];
      std::snprintf(text, sizeof text, plot.format ? plot.format : value < 100 ? "%.3g" : "%.0f", value);
      sheet.text(x + bar_width / 2, y.at(value) - 4, text,
                 std::string("text-anchor=\"middle\" font-size=") + (bar_width < 30 ? "\"7\"" : "\"9\""));
    }
  }
  for (size_t g = 0; g < plot.groups.size(); ++g) {
    const double centre = frame.x0 + step * (static_cast<double>(g) + 0.5);
    // "mesh, threads" and "row_family" on two lines
    const std::string& label = plot.groups[g];
    const size_t cut = std::min(label.find(", "), label.find("_", label.find(' ')));
    const std::string second = cut == std::string::npos ? "" : label.substr(cut + (label[cut] == ',' ? 2 : 1));
    sheet.text(centre, frame.y0 + 18, label.substr(0, cut), "text-anchor=\"middle\" font-size=\"11\"");
    sheet.text(centre, frame.y0 + 32, second, "text-anchor=\"middle\" font-size=\"11\"");
  }
  draw_legend(sheet, frame, names);
  sheet.write(file);
}

}  // namespace bench
