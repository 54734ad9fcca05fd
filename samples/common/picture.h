// Pictures without a graphics card: a small software rasteriser for the samples, the tests and the documentation.
//
// A layer is a triangle surface with a look (plain, per-vertex colours, iso-strips of a scalar field, reflection
// stripes) and marks on it (dots at sites, thin poly-lines, arrows). render() draws layers with one z-buffer; pictures
// are put side by side with contact_sheet() and written with write_png().
//
//   Surface surface = make_surface(positions, triangles);
//   surface.scalars = field;
//   SurfaceLook look; look.fill = Fill::iso_strips;
//   View view; view.direction = {1, 0.3, 1};
//   write_png("field.png", render(surface, view, look));
//
// Everything is computed in double precision on one thread without random numbers: the same input gives the same bytes.
// Cost: O(triangles + samples covered); 300,000 triangles at 800 x 600 with 3 x 3 samples take one to two seconds.
// Failure: std::runtime_error with one sentence that names the wrong array or index; nothing is written.
#ifndef HF_SAMPLES_COMMON_PICTURE_H
#define HF_SAMPLES_COMMON_PICTURE_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace samples {

using Point = std::array<double, 3>;

// Display colour (sRGB), components 0..1.
struct Color {
  double r = 0, g = 0, b = 0;
};

// Rows from top to bottom, three bytes per pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
};

// A triangle surface. Per-vertex arrays other than positions may be empty.
struct Surface {
  std::vector<double> positions;    // xyz
  std::vector<uint32_t> triangles;  // three vertex indices each, counter-clockwise seen from outside
  std::vector<double> normals;      // xyz; empty: computed, shared between vertices at bit-equal positions
  std::vector<float> colors;        // rgb 0..1, for Fill::colors
  std::vector<double> scalars;      // one per vertex, for Fill::palette and Fill::iso_strips; NaN is drawn grey
};

template <typename Real>
Surface make_surface(const std::vector<Real>& positions, const std::vector<uint32_t>& triangles) {
  Surface surface;
  surface.positions.assign(positions.begin(), positions.end());
  surface.triangles = triangles;
  return surface;
}

enum class Fill {
  plain,       // SurfaceLook::color everywhere
  colors,      // Surface::colors, interpolated
  palette,     // Surface::scalars through the palette, continuous
  iso_strips,  // Surface::scalars cut into strips with dark thin iso-lines between them, exact per pixel
  stripes,     // reflection lines of a striped room: kinks in a stripe are kinks in the normal
};

enum class Palette {
  blue_yellow,    // dark blue, teal, yellow
  blue_white_red  // diverging
};

struct SurfaceLook {
  Fill fill = Fill::plain;
  Color color{0.80, 0.78, 0.74};
  bool flat = false;  // one normal per triangle instead of interpolated normals
  Palette palette = Palette::blue_yellow;
  double scalar_low = 0, scalar_high = 0;  // range of the palette; equal: range of the finite scalars
  int strips = 24;                         // iso-strips over that range
  bool iso_lines = true;
  int stripe_count = 14;  // Fill::stripes: dark stripes from bottom to top of the room
  bool wireframe = false;
  Color wire_color{0.10, 0.12, 0.16};
  double wire_width = 0.9;  // pixels
  double shininess = 0.18;  // strength of the highlight, 0 = matte
};

// A shaded sphere. Radius is a fraction of the diagonal of the view's box.
struct Dot {
  Point position{};
  double radius = 0.011;
  Color color{0.86, 0.10, 0.10};
};

// A line strip; drawn a little in front of the surface it lies on. Width in pixels.
struct Polyline {
  std::vector<Point> points;
  Color color{0.10, 0.10, 0.12};
  double width = 1.5;
};

struct Arrow {
  Point from{}, to{};
  Color color{0.10, 0.10, 0.12};
  double width = 1.6;
};

struct Marks {
  std::vector<Dot> dots;
  std::vector<Polyline> lines;
  std::vector<Arrow> arrows;
};

struct Box {
  Point lower{}, upper{};
};

// The box of one or more position arrays, for frames of a clip that share one scale. With triangles, the box of their
// corners: what no triangle shows does not count.
void extend(Box& box, bool& empty, const std::vector<double>& positions);
void extend(Box& box, bool& empty, const std::vector<double>& positions, const std::vector<uint32_t>& triangles);

// The camera and the page.
struct View {
  int width = 640, height = 480;
  int samples = 3;                  // samples x samples per pixel, 1..8
  Point direction{0.8, 0.35, 1.0};  // from the subject towards the camera
  Point up{0, 1, 0};
  double perspective = 0;  // vertical field of view in degrees; 0 = orthographic
  bool fixed_box = false;  // fit `box` instead of the surfaces
  Box box;
  double margin = 0.06;      // free border, fraction of the page
  bool ground = false;       // soft shadow on the plane at ground_height, and its line when seen edge on
  double ground_height = 0;  // along `up`
  Color background_top{0.97, 0.975, 0.985}, background_bottom{0.86, 0.875, 0.895};
  double occlusion = 0.75;  // strength of the darkening of creases, 0 = none
};

struct Layer {
  Surface surface;
  SurfaceLook look;
  Marks marks;
};

Picture render(const std::vector<Layer>& layers, const View& view);
Picture render(const Surface& surface, const View& view, const SurfaceLook& look = {}, const Marks& marks = {});

// Palette colour for t in 0..1.
Color palette_color(Palette palette, double t);

// Puts a tile on a page that is large enough, its top left corner at (x, y).
void paste(Picture& page, const Picture& tile, int x, int y);

// ASCII text, its top left corner at (x, y); a line is 13 pixels tall at scale 1. Returns the width in pixels.
int draw_text(Picture& picture, int x, int y, const std::string& text, int scale = 1, Color color = {0.12, 0.13, 0.16});
int text_width(const std::string& text, int scale = 1);

// Tiles row by row, a label under each (labels may be shorter than tiles), a title above all when not empty. Tiles of
// different sizes are centred in cells of the largest size.
Picture contact_sheet(const std::vector<Picture>& tiles, int columns, const std::vector<std::string>& labels = {},
                      const std::string& title = {});

// Writes to a temporary name in the same folder and renames, so a reader never sees half a file.
void write_png(const std::string& path, const Picture& picture);

// The bytes of the PNG file.
std::vector<uint8_t> encode_png(const Picture& picture);

}  // namespace samples

#endif
