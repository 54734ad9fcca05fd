// Inside the pictures: camera fit and the z-buffer of samples. Users include picture.h.
#ifndef HF_SAMPLES_COMMON_PICTURE_RASTER_H
#define HF_SAMPLES_COMMON_PICTURE_RASTER_H

#include <glm/glm.hpp>
#include <vector>

#include "picture.h"

namespace samples::raster {

using glm::dvec2;
using glm::dvec3;

// Camera frame: x to the right, y up, z towards the camera. Page coordinates are in samples, y downwards.
struct Camera {
  dvec3 right, up, back;
  dvec3 target;         // projected to the centre of the page
  double scale = 1;     // samples per world unit at the target
  double distance = 0;  // camera to target; 0 = orthographic
  double half_width = 0, half_height = 0;
  double diagonal = 1;  // of the fitted box, the unit of dots and biases

  // World to camera coordinates relative to the target.
  dvec3 local(const dvec3& p) const {
    const dvec3 d = p - target;
    return {dot(d, right), dot(d, up), dot(d, back)};
  }
  // 1 at the target, larger when further away; the factor by which things shrink.
  double shrink(double z) const { return distance > 0 ? (distance - z) / distance : 1.0; }
  // Page x, y and depth z (larger is nearer) of a point in camera coordinates.
  dvec3 page(const dvec3& q) const {
    const double w = shrink(q.z);
    return {half_width + scale * q.x / w, half_height - scale * q.y / w, q.z};
  }
};

// Fits the box or, when view.fixed_box is not set, all positions. Throws when there is nothing finite to look at.
Camera fit_camera(const View& view, const std::vector<Layer>& layers);

// What a sample shows of a line, an arrow or a dot.
struct Mark {
  float r = 0, g = 0, b = 0;     // colour
  float nx = 0, ny = 0, nz = 1;  // normal of a shaded mark, camera coordinates
};

// What a sample sees. A pixel has nine, and the taps of the occlusion lie apart: with marks in it, a picture takes a
// third longer.
struct Sample {
  double depth = -1e300;  // camera z
  int layer = -1;         // -1 background, -2 flat colour of a mark, -3 shaded mark
  uint32_t triangle = 0;  // of a mark: its number
  float b1 = 0, b2 = 0;   // barycentric coordinates of the second and third corner
};

struct SampleBuffer {
  int width = 0, height = 0;
  std::vector<Sample> samples;
  std::vector<Mark> marks;
  Sample& at(int x, int y) { return samples[size_t(y) * size_t(width) + size_t(x)]; }
  const Sample& at(int x, int y) const { return samples[size_t(y) * size_t(width) + size_t(x)]; }
};

// Positions in camera coordinates.
std::vector<dvec3> to_camera(const Camera& camera, const Surface& surface);

void draw_triangles(SampleBuffer& buffer, const Camera& camera, const std::vector<dvec3>& local,
                    const std::vector<uint32_t>& triangles, int layer);
void draw_marks(SampleBuffer& buffer, const Camera& camera, const Marks& marks, double samples_per_pixel);

// Coverage 0..1 of the surfaces' shadow on the ground plane, blurred; empty when the plane is seen edge on.
std::vector<float> ground_shadow(const Camera& camera, const View& view, const std::vector<Layer>& layers, int width,
                                 int height);

}  // namespace samples::raster

#endif
