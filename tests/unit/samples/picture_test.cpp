// The software rasteriser: what is in front hides what is behind, fits keep their box, strips lie where the field says.
#include "common/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace {

using namespace samples;

// Two triangles that fill [-1, 1]^2 at depth z, facing +z.
Surface square(double z, double half = 1) {
  return make_surface(std::vector<double>{-half, -half, z, half, -half, z, half, half, z, -half, half, z},
                      {0, 1, 2, 0, 2, 3});
}

View front(int size = 64) {
  View view;
  view.width = view.height = size;
  view.samples = 2;
  view.direction = {0, 0, 1};
  view.margin = 0;
  view.occlusion = 0;
  return view;
}

Color pixel(const Picture& picture, int x, int y) {
  const uint8_t* p = &picture.rgb[3 * (size_t(y) * size_t(picture.width) + size_t(x))];
  return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0};
}

TEST(Picture, TheNearerSurfaceHidesTheFartherInAnyOrder) {
  Layer red{square(1), {}, {}}, blue{square(-1), {}, {}};
  red.look.color = {0.9, 0.1, 0.1};
  blue.look.color = {0.1, 0.1, 0.9};
  for (const std::vector<Layer>& layers : {std::vector<Layer>{red, blue}, std::vector<Layer>{blue, red}}) {
    for (double perspective : {0.0, 35.0}) {
      View view = front();
      view.perspective = perspective;
      const Color seen = pixel(render(layers, view), 32, 32);
      EXPECT_GT(seen.r, 2 * seen.b);
      view.direction = {0, 0, -1};
      const Color behind = pixel(render(layers, view), 32, 32);
      EXPECT_GT(behind.b, behind.r);
    }
  }
}

TEST(Picture, TheSameInputGivesTheSameBytes) {
  Surface surface = square(0);
  surface.scalars = {0, 1, 2, 3};
  SurfaceLook look;
  look.fill = Fill::iso_strips;
  View view;
  view.ground = true;
  view.ground_height = -1;
  EXPECT_EQ(encode_png(render(surface, view, look)), encode_png(render(surface, view, look)));
}

TEST(Picture, AFixedBoxKeepsTheScaleOfEveryFrame) {
  View view = front(100);
  view.fixed_box = true;
  view.box = {{-2, -2, -2}, {2, 2, 2}};
  const Picture picture = render(square(0), view);
  const Color inside = pixel(picture, 50, 50), background = pixel(picture, 2, 50);
  // the square covers the middle half: rows 25..74
  for (int i = 0; i < 100; ++i) {
    const Color seen = pixel(picture, i, 50);
    const bool covered = std::abs(seen.r - inside.r) < std::abs(seen.r - background.r);
    EXPECT_EQ(covered, i >= 25 && i < 75) << i;
  }
}

TEST(Picture, AutomaticFitTouchesTheMarginWithAndWithoutPerspective) {
  for (double perspective : {0.0, 40.0}) {
    View view = front(100);
    view.margin = 0.1;
    view.perspective = perspective;
    const Picture picture = render(square(0), view);
    const Color background = pixel(picture, 1, 50);
    EXPECT_NEAR(pixel(picture, 8, 50).r, background.r, 0.02);
    EXPECT_GT(std::abs(pixel(picture, 11, 50).r - background.r), 0.03);
    EXPECT_GT(std::abs(pixel(picture, 88, 50).r - background.r), 0.03);
    EXPECT_NEAR(pixel(picture, 91, 50).r, background.r, 0.02);
  }
}

TEST(Picture, AVertexInNoTriangleDoesNotMoveTheCamera) {
  Surface stray = square(0);
  stray.positions.insert(stray.positions.end(), {1e5, 2e5, 3});
  EXPECT_EQ(render(stray, front()).rgb, render(square(0), front()).rgb);
  Box box, plain;
  bool empty = true, nothing = true;
  extend(box, empty, stray.positions, stray.triangles);
  extend(plain, nothing, square(0).positions);
  EXPECT_EQ(box.upper, plain.upper);
}

TEST(Picture, IsoStripsChangeColourExactlyAtTheirValues) {
  Surface surface = square(0);
  surface.scalars = {0, 1, 1, 0};  // grows with x
  View view = front(160);
  SurfaceLook look;
  look.fill = Fill::iso_strips;
  look.strips = 4;
  look.iso_lines = false;
  look.shininess = 0;
  const Picture picture = render(surface, view, look);
  std::vector<int> changes;
  for (int x = 1; x < 160; ++x) {
    const Color a = pixel(picture, x - 1, 80), b = pixel(picture, x, 80);
    if (std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 0.02) changes.push_back(x);
  }
  EXPECT_EQ(changes, (std::vector<int>{40, 80, 120}));
  // from blue on the left to yellow on the right
  EXPECT_GT(pixel(picture, 10, 80).b, pixel(picture, 10, 80).r);
  EXPECT_GT(pixel(picture, 150, 80).r, 2 * pixel(picture, 150, 80).b);
}

TEST(Picture, IsoLinesAreDarkAndThin) {
  Surface surface = square(0);
  surface.scalars = {0, 1, 1, 0};
  View view = front(160);
  SurfaceLook look;
  look.fill = Fill::iso_strips;
  look.strips = 4;
  const Picture picture = render(surface, view, look);
  int dark = 0;
  for (int x = 70; x < 90; ++x) dark += pixel(picture, x, 80).g < 0.85 * pixel(picture, 65, 80).g;
  EXPECT_GE(dark, 1);
  EXPECT_LE(dark, 2);
}

TEST(Picture, DotsAndLinesOnTheFrontShowAndThoseBehindDoNot) {
  Marks marks;
  marks.dots.push_back({{0, 0, 0}, 0.05, {0.9, 0.05, 0.05}});
  marks.lines.push_back({{{-0.8, 0.5, 0}, {0.8, 0.5, 0}}, {0.05, 0.6, 0.05}, 3});
  const Picture seen = render(square(0), front(), {}, marks);
  EXPECT_GT(pixel(seen, 32, 32).r, 2 * pixel(seen, 32, 32).g);
  EXPECT_GT(pixel(seen, 32, 16).g, 2 * pixel(seen, 32, 16).r);
  for (Dot& dot : marks.dots) dot.position[2] = -0.5;
  for (Polyline& line : marks.lines) line.points[0][2] = line.points[1][2] = -0.5;
  const Picture hidden = render(square(0), front(), {}, marks);
  EXPECT_LT(pixel(hidden, 32, 32).r, 1.3 * pixel(hidden, 32, 32).g);
  EXPECT_LT(pixel(hidden, 32, 16).g, 1.3 * pixel(hidden, 32, 16).r);
}

TEST(Picture, ReflectionStripesShowAKinkAsABreak) {
  // on a plane all normals agree, so orthographic reflection gives one shade
  SurfaceLook look;
  look.fill = Fill::stripes;
  look.shininess = 0;
  const Picture flat = render(square(0), front(), look);
  EXPECT_NEAR(pixel(flat, 10, 10).r, pixel(flat, 50, 50).r, 0.01);
}

TEST(Picture, SeamsDoNotShowInComputedNormals) {
  // a roof whose ridge vertices are stored twice: the shared normal at the ridge points at the viewer on both sides
  const std::vector<double> positions{-1, -1, 0, 0, -1, 1, 0, 1, 1, -1, 1, 0, 0, -1, 1, 1, -1, 0, 1, 1, 0, 0, 1, 1};
  const Picture picture = render(make_surface(positions, {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}), front(200));
  EXPECT_NEAR(pixel(picture, 98, 100).r, pixel(picture, 101, 100).r, 0.02);
}

TEST(Picture, ScalarsThatAreNotFiniteAreGrey) {
  Surface surface = square(0);
  surface.scalars.assign(4, std::numeric_limits<double>::quiet_NaN());
  SurfaceLook look;
  look.fill = Fill::iso_strips;
  look.shininess = 0;
  const Color seen = pixel(render(surface, front(), look), 32, 32);
  EXPECT_NEAR(seen.r, seen.b, 0.08);
}

TEST(Picture, BadInputIsRefusedWithTheIndex) {
  Surface surface = square(0);
  surface.triangles[4] = 9;
  try {
    render(surface, front());
    FAIL() << "a bad index was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("triangle 1 names vertex 9"), std::string::npos) << error.what();
  }
  SurfaceLook strips;
  strips.fill = Fill::iso_strips;
  EXPECT_THROW(render(square(0), front(), strips), std::runtime_error);
  SurfaceLook colors;
  colors.fill = Fill::colors;
  EXPECT_THROW(render(square(0), front(), colors), std::runtime_error);
  EXPECT_THROW(render(Surface{}, front()), std::runtime_error);
  View view = front();
  view.direction = {0, 1, 0};
  EXPECT_THROW(render(square(0), view), std::runtime_error);
  view = front();
  view.width = 0;
  EXPECT_THROW(render(square(0), view), std::runtime_error);
  EXPECT_THROW(contact_sheet({}, 2), std::runtime_error);
  EXPECT_THROW(encode_png(Picture{}), std::runtime_error);
}

TEST(Picture, VerticesThatAreNotFiniteAreLeftOut) {
  Surface surface = square(0);
  surface.positions.insert(surface.positions.end(), {std::nan(""), 0, 0});
  surface.triangles.insert(surface.triangles.end(), {0, 1, 4});
  const Picture picture = render(surface, front());
  EXPECT_EQ(picture.rgb.size(), 3u * 64 * 64);
}

TEST(Picture, ContactSheetsPlaceEveryTileAndItsLabel) {
  std::vector<Picture> tiles;
  for (int i = 0; i < 5; ++i) {
    Picture tile{40, 30, std::vector<uint8_t>(3 * 40 * 30, uint8_t(40 * i))};
    tiles.push_back(tile);
  }
  const Picture sheet = contact_sheet(tiles, 3, {"a", "b", "c", "d", "e"}, "five tiles");
  EXPECT_GE(sheet.width, 3 * 40);
  EXPECT_GE(sheet.height, 2 * 30);
  for (int i = 0; i < 5; ++i) {
    int count = 0;
    for (size_t p = 0; p < sheet.rgb.size(); p += 3) {
      count += sheet.rgb[p] == 40 * i && sheet.rgb[p + 1] == 40 * i && sheet.rgb[p + 2] == 40 * i;
    }
    EXPECT_GE(count, 40 * 30) << i;
  }
}

TEST(Picture, LabelsAreLargeWhereTheyFit) {
  const Picture tile{300, 20, std::vector<uint8_t>(3 * 300 * 20, 128)};
  const Picture bare = contact_sheet({tile}, 1), fits = contact_sheet({tile}, 1, {"rest"});
  const Picture narrow = contact_sheet({tile}, 1, {"a label that is too long to be drawn at twice the size"});
  EXPECT_GT(fits.height - bare.height, narrow.height - bare.height);
  EXPECT_EQ(narrow.width, bare.width);
}

TEST(Picture, TextHasTheWidthItSays) {
  Picture picture{200, 20, std::vector<uint8_t>(3 * 200 * 20, 255)};
  const int width = draw_text(picture, 0, 0, "Iso 42%", 2, {0, 0, 0});
  EXPECT_EQ(width, text_width("Iso 42%", 2));
  int right = 0, dark = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (picture.rgb[3 * (size_t(y) * 200 + size_t(x))] == 0) {
        right = std::max(right, x);
        ++dark;
      }
    }
  }
  EXPECT_GT(dark, 100);
  EXPECT_LE(right, width);
  EXPECT_GE(right, width - 8);
  EXPECT_EQ(text_width(""), 0);
}

TEST(Picture, PngFilesHaveTheSignatureAndSize) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "hf_picture_test.png";
  write_png(file.string(), render(square(0), front(32)));
  std::ifstream in(file, std::ios::binary);
  std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 24u);
  EXPECT_EQ(bytes[1], 'P');
  EXPECT_EQ(bytes[19], 32);
  EXPECT_EQ(bytes[23], 32);
  in.close();
  std::filesystem::remove(file);
  EXPECT_THROW(write_png("no/such/folder/picture.png", render(square(0), front(8))), std::runtime_error);
}

}  // namespace
