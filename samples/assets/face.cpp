// See face.h.
#include "assets/face.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samples {
namespace {

constexpr double face_pi = 3.14159265358979323846;
constexpr double face_low = -0.42 * face_pi, face_high = 0.42 * face_pi;  // elevations of neck and crown
constexpr double eye_side = 0.35, eye_height = 0.25, eye_half = 0.18;     // middle and half width of an eye
constexpr double eye_open = 0.06, lid_height = 0.2;  // half opening; how far above and below it the skin is moved
constexpr int face_shapes = 52;

struct FacePoint {
  double x, y, z;
};

double bell(double x, double y, double width) { return std::exp(-(x * x + y * y) / (2 * width * width)); }
double smooth_down(double t) { return t >= 1 ? 0 : t <= 0 ? 1 : (1 - t) * (1 - t) * (1 + 2 * t); }

// Half the opening of the eyes at an azimuth.
double opening(double u) {
  const double s = (std::abs(u) - eye_side) / eye_half;
  return std::abs(s) < 1 ? eye_open * (1 - s * s) * (1 - s * s) : 0;
}

// A place on the head. side: 1 above, -1 below the slit of the eyes.
struct FaceSpot {
  double u, v;
  int side;
};

FacePoint on_head(double u, double v) {
  const double nose = 0.25 * bell(u, v + 0.05, 0.16), jaw = 1 - 0.2 * bell(0, v + 1.1, 0.5);
  return {0.75 * jaw * std::cos(v) * std::sin(u), 1.1 * std::sin(v), 0.9 * std::cos(v) * std::cos(u) + nose};
}

// closed_left, closed_right: how far the upper lid has come down to the lower one.
FacePoint head_point(const FaceSpot& p, double closed_left, double closed_right) {
  const double closed = p.u > 0 ? closed_left : closed_right, t = std::abs(p.v - eye_height) / lid_height;
  const double open = opening(p.u) * smooth_down(t);
  return on_head(p.u, p.v + (p.side > 0 ? open * (1 - 2 * closed) : -open));
}

FacePoint shape_point(const FaceSpot& p, int shape) {
  if (shape < 2) return head_point(p, shape == 0, shape == 1);
  const int place = (shape - 2) / 2;
  const double u = p.u - (-0.8 + 0.4 * (place % 5)), v = p.v - (-0.7 + 0.3 * (place / 5)), b = bell(u, v, 0.18);
  if (shape % 2) {
    const FacePoint q = head_point(p, 0, 0);
    return {(1 + 0.08 * b) * q.x, (1 + 0.08 * b) * q.y, (1 + 0.08 * b) * q.z};
  }
  FaceSpot moved = p;
  moved.u += 0.08 * b;
  moved.v += 0.05 * b;
  return head_point(moved, 0, 0);
}

// Another head: wider, flatter, bent.
FacePoint second(const FacePoint& p) {
  return {1.2 * p.x + 0.06 * p.x * p.y, 0.9 * p.y + 0.05 * p.z * p.z, 1.1 * p.z + 0.08 * p.y * p.y};
}

}  // namespace

Face make_face(uint32_t columns, uint32_t rows, bool second_head) {
  if (columns < 40 || rows < 30) throw std::runtime_error("make_face: at least 40 columns and 30 rows");
  Face face;
  std::vector<FaceSpot> spots;
  const auto last = static_cast<double>(rows - 1);
  const auto slit = static_cast<uint32_t>(std::lround((eye_height - face_low) / (face_high - face_low) * last));
  for (uint32_t r = 0; r < rows; ++r) {
    // the slit lies on a row
    const double v = r <= slit ? face_low + (eye_height - face_low) * r / slit
                               : eye_height + (face_high - eye_height) * (r - slit) / (rows - 1 - slit);
    for (uint32_t c = 0; c < columns; ++c)
      spots.push_back({-face_pi + 2 * face_pi * c / columns, v, r > slit ? 1 : -1});
  }
  std::vector<uint32_t> above(columns);
  for (uint32_t c = 0; c < columns; ++c) {
    const uint32_t lower = slit * columns + c;
    above[c] = lower;
    FaceSpot spot = spots[lower];
    if (!(opening(spot.u) > 0)) continue;
    spot.side = 1;
    above[c] = static_cast<uint32_t>(spots.size());
    face.lids.emplace_back(above[c], lower);
    face.lid_azimuth.push_back(spot.u);
    spots.push_back(spot);
  }
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      const uint32_t d = (c + 1) % columns, up = (r + 1) * columns;
      const uint32_t a = r == slit ? above[c] : r * columns + c, b = r == slit ? above[d] : r * columns + d;
      for (const uint32_t i : {a, b, up + d, a, up + d, up + c}) face.mesh.triangles.push_back(i);
    }
  }
  const auto posed = [&](int shape) {
    std::vector<double> out;
    for (const FaceSpot& spot : spots) {
      FacePoint p = shape < 0 ? head_point(spot, 0, 0) : shape_point(spot, shape);
      if (second_head) p = second(p);
      for (const double x : {p.x, p.y, p.z}) out.push_back(x);
    }
    return out;
  };
  face.mesh.positions = posed(-1);
  for (int shape = 0; shape < face_shapes; ++shape) {
    const std::string place = std::to_string((shape - 2) / 2);
    face.shape_names.push_back(shape == 0   ? "blink_left"
                               : shape == 1 ? "blink_right"
                                            : (shape % 2 ? "swell_" : "slide_") + place);
    face.shapes.push_back(posed(shape));
  }
  const auto mark = [&](const std::string& name, double u, double v, int side, double radius) {
    FaceMark out{name, {}};
    for (uint32_t i = 0; i < spots.size(); ++i)
      if (std::hypot(spots[i].u - u, spots[i].v - v) <= radius && (side == 0 || spots[i].side == side))
        out.vertices.push_back(i);
    if (out.vertices.empty()) {  // a coarse grid: the nearest vertex of the side
      double best = 1e300;
      for (uint32_t i = 0; i < spots.size(); ++i) {
        const double d = std::hypot(spots[i].u - u, spots[i].v - v);
        if ((side == 0 || spots[i].side == side) && d < best) {
          best = d;
          out.vertices = {i};
        }
      }
    }
    face.marks.push_back(std::move(out));
  };
  const double wide = 0.06;
  mark("nose", 0, 0, 0, wide);
  mark("chin", 0, -0.9, 0, wide);
  mark("forehead", 0, 0.8, 0, wide);
  mark("ear left", 1.4, 0, 0, wide);
  mark("ear right", -1.4, 0, 0, wide);
  mark("back of the head", 3, 0.3, 0, wide);
  mark("nape", 3, -0.8, 0, wide);
  mark("mouth left", 0.35, -0.5, 0, wide);
  mark("mouth right", -0.35, -0.5, 0, wide);
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? " left" : " right";
    mark("inner corner" + name, side * (eye_side - eye_half - 0.05), eye_height, 0, 0.04);
    mark("outer corner" + name, side * (eye_side + eye_half + 0.05), eye_height, 0, 0.04);
    mark("upper lid" + name, side * eye_side, eye_height, 1, 0.03);
    mark("lower lid" + name, side * eye_side, eye_height, -1, 0.03);
  }
  return face;
}

}  // namespace samples
