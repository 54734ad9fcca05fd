// Mesh files: every form of the three text and binary formats, round trips, and hostile headers.
#include "common/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/face_triangles.h"
#include "unit/gltf/gltf_support.h"

namespace {

using namespace samples;
using namespace hf_gltf;
using namespace samples_test;

SurfaceMesh read_text(const std::string& text, const std::string& extension) {
  return read_mesh_bytes({text.begin(), text.end()}, extension, "test" + extension);
}

std::string fault(const std::string& text, const std::string& extension) {
  return message_of([&] { read_text(text, extension); });
}

using Indices = std::vector<uint32_t>;

TEST(ObjFile, AllCornerFormsAndNegativeIndicesNameTheSameVertices) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -3 -2 -1",
                           "f -3/-3/-1 -2/-2/-1 -1/-1/-1", "f 1// 2// 3//", "f 1 \\\n 2 3", "f\t1  2\t3 # comment"}) {
    const SurfaceMesh mesh = read_text(vertices + face + "\n", ".obj");
    EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2})) << face;
    EXPECT_TRUE(mesh.warnings.empty()) << face;
  }
}

TEST(ObjFile, ABackslashRightBehindATokenContinuesTheLine) {
  for (const char* end : {"\n", " \n", "\r\n"}) {
    const std::string text =
        std::string("v 0 0\\") + end + "0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2\\" + end + " 3\\" + end + "\n";
    EXPECT_EQ(read_text(text, ".obj").triangles, (Indices{0, 1, 2})) << text;
  }
  // one inside of a token ends nothing
  EXPECT_NE(fault("v 0 0 0\nf 1\\1 1 1\n", ".obj").find("line 2"), std::string::npos);
}

// Names and paths can end with a backslash.
TEST(ObjFile, ABackslashBehindANameSwallowsNoLine) {
  for (const char* line : {"g body\\", "o body \\", "usemtl skin\\", "mtllib C:\\models\\", "# left \\", "g \\"}) {
    const SurfaceMesh mesh =
        read_text(std::string("v 0 0 0\nv 1 0 0\n") + line + "\nv 0 1 0\n" + line + "\nf 1 2 3\n", ".obj");
    EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2})) << line;
  }
  const std::string groups = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng head\nf 1 2 3\ng body\\ # left\nf 3 2 1\n";
  EXPECT_EQ(read_text(groups, ".obj").group_names, (std::vector<std::string>{"head", "body\\"}));
}

TEST(ObjFile, NegativeIndicesCountFromTheFaceNotFromTheEnd) {
  const SurfaceMesh mesh =
      read_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n", ".obj");
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2, 3, 4, 5}));
}

TEST(ObjFile, ColoursGroupsPolygonsAndLineEndingsAreRead) {
  const SurfaceMesh mesh = read_text(
      "v 0 0 0 1 0 0\r\nv 1 0 0 0 1 0\r\nv 1 1 0 0 0 1\r\nv 0 1 0 1 1 1\r\ng left part\r\nf 1 2 3\r\ng right\r\nf 1 2 "
      "3 4\r\n",
      ".obj");
  EXPECT_EQ(mesh.colors[1], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(mesh.face_sizes, (Indices{3, 4}));
  EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"left part", "right"}));
  EXPECT_EQ(mesh.face_groups, (Indices{0, 1}));
  EXPECT_EQ(mesh.triangles.size(), 9u);
}

TEST(ObjFile, BadIndicesAndNumbersAreRefusedWithTheLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_NE(fault(three + "f 1 2 4\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1 2 0\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1 2 -4\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1 2 99999999999999999999\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1 2 -9223372036854775808\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1 2 x\n", ".obj").find("line 4"), std::string::npos);
  EXPECT_NE(fault(three + "f 1/1/1/1 2 3\n", ".obj").find("slashes"), std::string::npos);
  EXPECT_NE(fault("v 0 0\n", ".obj").find("three coordinates"), std::string::npos);
  EXPECT_NE(fault("v 0 0 1x\n", ".obj").find("not a number"), std::string::npos);
  EXPECT_NE(fault("v 0 0 nan\n", ".obj").find("vertex 0"), std::string::npos);
  EXPECT_NE(fault("v 0 0 1e999\n", ".obj").find("vertex 0"), std::string::npos);
  EXPECT_EQ(fault("v 0 0 1e-999\n", ".obj"), "");
}

TEST(OffFile, HeadersCommentsAndColoursInAllTheirForms) {
  const std::string body = "0 0 0\n1 0 0 # here\n\n0 1 0\n3 0 1 2 255 0 0\n";
  for (const std::string& head : {std::string("OFF\n3 1 0\n"), std::string("OFF 3 1 0\n"), std::string("OFF3 1 0\n"),
                                  std::string("# first\n\nOFF\n# second\n3 1\n"), std::string("3 1 0\n")}) {
    const SurfaceMesh mesh = read_text(head + body, ".off");
    EXPECT_EQ(mesh.positions.size(), 3u) << head;
    EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2})) << head;
  }
  const SurfaceMesh whole = read_text("COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 0 0 0\n0 1 0 1 2 3\n3 0 1 2\n", ".off");
  EXPECT_FLOAT_EQ(whole.colors[0].z, 0.2f);
  EXPECT_EQ(whole.colors[2].a, 1.0f);
  const SurfaceMesh real = read_text(
      "CNOFF\n3 1 0\n0 0 0 0 0 1 1.0 0.5 0.0 1.0\n1 0 0 0 0 1 1 0 0.5 1\n0 1 0 0 0 1 0.1 0 0 1\n3 0 1 2\n", ".off");
  EXPECT_EQ(real.colors[0].y, 0.5f);
  EXPECT_EQ(real.normals[1], glm::vec3(0, 0, 1));
}

TEST(OffFile, CountsAreCheckedAgainstTheFileBeforeAllocation) {
  EXPECT_NE(fault("OFF\n4000000000 4000000000 0\n0 0 0\n", ".off").find("limit"), std::string::npos);
  EXPECT_NE(fault("OFF\n10000000 1 0\n0 0 0\n", ".off").find("left"), std::string::npos);
  EXPECT_NE(fault("OFF\n-3 -1 0\n", ".off").find("-3"), std::string::npos);
  EXPECT_NE(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ".off").find("vertex 3"), std::string::npos);
  EXPECT_NE(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n99999999 0 1 2\n", ".off").find("99999999"), std::string::npos);
  EXPECT_NE(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", ".off").find("ends"), std::string::npos);
  EXPECT_NE(fault("4OFF\n3 1 0\n", ".off").find("4OFF"), std::string::npos);
  EXPECT_NE(fault("OFF BINARY\n3 1 0\n", ".off").find("binary"), std::string::npos);
  EXPECT_NE(fault("", ".off"), "");
}

template <typename T>
void put(std::string& out, T value, bool big) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big) std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

TEST(PlyFile, TextAndBothByteOrdersGiveTheSameMesh) {
  const std::string elements =
      "comment made by hand\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty uchar "
      "red\n"
      "property uchar green\nproperty uchar blue\nproperty list uchar int extra\nelement face 2\n"
      "property float quality\nproperty list uchar uint vertex_indices\nelement edge 1\nproperty int a\nend_header\n";
  const double xy[4][2] = {{0, 0}, {1.5, 0}, {1.5, 2.25}, {0, 2.25}};
  const std::string text = "ply\nformat ascii 1.0\n" + elements +
                           "0 0 -1 255 0 0 0\n1.5 0 -1 0 255 0 2 7 8\n1.5 2.25 -1 0 0 255 0\n0 2.25 -1 51 51 51 0\n"
                           "0.5 4 0 1 2 3\n0.5 3 0 2 3\n9\n";
  const SurfaceMesh expected = read_text(text, ".ply");
  EXPECT_EQ(expected.positions[2], glm::dvec3(1.5, 2.25, -1));
  EXPECT_FLOAT_EQ(expected.colors[3].x, 0.2f);
  EXPECT_EQ(expected.face_sizes, (Indices{4, 3}));
  EXPECT_EQ(expected.triangles, (Indices{0, 1, 2, 2, 3, 0, 0, 2, 3}));
  for (const bool big : {false, true}) {
    std::string out = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + elements;
    for (int v = 0; v < 4; ++v) {
      put(out, xy[v][0], big);
      put(out, static_cast<float>(xy[v][1]), big);
      put(out, static_cast<int16_t>(-1), big);
      for (int c = 0; c < 3; ++c) put(out, static_cast<uint8_t>(v == 3 ? 51 : v == c ? 255 : 0), big);
      put(out, static_cast<uint8_t>(v == 1 ? 2 : 0), big);
      for (int i = 0; i < (v == 1 ? 2 : 0); ++i) put(out, static_cast<int32_t>(7 + i), big);
    }
    for (const std::vector<uint32_t>& face : {Indices{0, 1, 2, 3}, Indices{0, 2, 3}}) {
      put(out, 0.5f, big);
      put(out, static_cast<uint8_t>(face.size()), big);
      for (const uint32_t v : face) put(out, v, big);
    }
    put(out, 9, big);
    const SurfaceMesh mesh = read_text(out, ".ply");
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.colors, expected.colors);
    EXPECT_EQ(mesh.triangles, expected.triangles);
    for (size_t cut = 0; cut < out.size(); ++cut)
      EXPECT_THROW(read_text(out.substr(0, cut), ".ply"), std::runtime_error) << cut;
  }
}

TEST(PlyFile, TriangleStripsAreTakenApart) {
  const SurfaceMesh mesh = read_text(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 "
      "1 2 3\n",
      ".ply");
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2, 1, 3, 2, 1, 2, 3}));
}

TEST(PlyFile, CountsListsAndTypesAreCheckedBeforeAllocation) {
  const auto ply = [](const std::string& format, const std::string& rest) {
    return "ply\nformat " + format + " 1.0\n" + rest;
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_NE(
      fault(ply("binary_little_endian", "element vertex 4294967295\n" + xyz + "end_header\n"), ".ply").find("left"),
      std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex 9223372036854775807\n" + xyz + "end_header\n"), ".ply").find("left"),
            std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex 99999999999999999999\n" + xyz + "end_header\n"), ".ply").find("count"),
            std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex -1\n" + xyz + "end_header\n"), ".ply").find("count"), std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex 1\n" + xyz +
                                   "element face 1\nproperty list int int vertex_indices\n"
                                   "end_header\n0 0 0\n-5 0 0 0\n"),
                  ".ply")
                .find("-5"),
            std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex 1\nproperty quad x\nend_header\n"), ".ply").find("quad"),
            std::string::npos);
  EXPECT_NE(fault(ply("utf8", ""), ".ply").find("format"), std::string::npos);
  EXPECT_NE(fault(ply("ascii", "element vertex 1\nproperty float x\nend_header\n1\n"), ".ply").find("x, y and z"),
            std::string::npos);
  // an element without properties takes no bytes and no time, whatever its count
  EXPECT_EQ(fault(ply("ascii", "element nothing 9000000000000000000\nend_header\n"), ".ply"), "");
}

// The line's end behind end_header decides where the data begin: LF CR does in files whose first line ends so.
TEST(PlyFile, BinaryDataBeginBehindTheHeadersOwnLineEnd) {
  for (const std::string end : {"\n", "\r\n", "\n\r", "\r"}) {
    for (const char first : {'\n', '\r', 'a'}) {
      std::string text;
      for (const char* line : {"ply", "format binary_little_endian 1.0", "comment a", "element vertex 3",
                               "property float x", "property float y", "property float z", "element face 1",
                               "property list uchar uchar vertex_index", "end_header"})
        text += line + end;
      std::string x(4, '\x3f');
      x[0] = first;
      float expected = 0;
      std::memcpy(&expected, x.data(), 4);
      text += x;
      for (const float o : {0, 0, 1, 0, 0, 0, 1, 0}) put(text, o, false);
      text += std::string("\3\0\1\2", 4);
      const SurfaceMesh mesh = read_text(text, ".ply");
      EXPECT_EQ(mesh.positions[0], glm::dvec3(static_cast<double>(expected), 0, 0));
      EXPECT_EQ(mesh.positions[2], glm::dvec3(0, 1, 0));
      EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2}));
    }
  }
}

struct NamedText {
  const char* extension;
  std::string text;
};

const NamedText (&text_forms())[3] {
  static const NamedText forms[] = {
      {".obj", "v 0 0 0\nv 1 0 0\n\nv 0 1 0 # last\nv 1 1 0\ng a b\nf 1 2 \\\n3\nf 2 4 3\n"},
      {".off", "OFF # text\n4 2 0\n\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 255 0 0\n3 1 3 2\n"},
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n"
       "3 1 3 2\n"}};
  return forms;
}

void expect_two_triangles(const SurfaceMesh& mesh, const std::string& what) {
  EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})) << what;
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2, 1, 3, 2})) << what;
}

TEST(MeshText, LinesEndWithLfOrCrOrBothInAnyOrder) {
  for (const NamedText& form : text_forms()) {
    for (const char* end : {"\n", "\r\n", "\r\r\n", "\n\r", "\r"}) {
      std::string text;
      for (const char c : form.text) text += c == '\n' ? std::string(end) : std::string(1, c);
      expect_two_triangles(read_text(text, form.extension), form.extension + std::to_string(end[0]));
    }
  }
  // lines count the same, and a CR that ends no line is a blank
  EXPECT_NE(fault("v 0 0 0\rv 1 0 x\r", ".obj").find("line 2"), std::string::npos);
  EXPECT_NE(fault("v 0 0 0\r\nv 1 0 x\r\n", ".obj").find("line 2"), std::string::npos);
  EXPECT_NO_THROW(read_text("v 0 0 0\nv 1\r0 0\n", ".obj"));
}

TEST(MeshText, AByteOrderMarkIsPassedOverAndUtf16IsSaid) {
  for (const NamedText& form : text_forms()) {
    expect_two_triangles(read_text("\xef\xbb\xbf" + form.text, form.extension), form.extension);
    std::string little, big;
    for (const char c : form.text) {
      little += {c, '\0'};
      big += {'\0', c};
    }
    for (const std::string& text : {"\xff\xfe" + little, "\xfe\xff" + big, little, big})
      EXPECT_EQ(fault(text, form.extension),
                std::string("test") + form.extension + ": the text is UTF-16; save it as UTF-8.");
  }
}

TEST(Triangulate, AConcavePolygonIsCutIntoTrianglesThatCoverItOnce) {
  // an L: the fan from its first corner would leave it
  const std::vector<glm::dvec3> p = {{1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const Indices corners = {0, 1, 2, 3, 4, 5};
  for (size_t shift = 0; shift < 6; ++shift) {
    Indices turned = corners, triangles;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(shift), turned.end());
    FaceTriangles().append(p, turned.data(), 6, triangles);
    ASSERT_EQ(triangles.size(), 12u);
    double area = 0;
    for (size_t t = 0; t < triangles.size(); t += 3) {
      const double twice = glm::cross(p[triangles[t + 1]] - p[triangles[t]], p[triangles[t + 2]] - p[triangles[t]]).z;
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
    EXPECT_NEAR(area, 3, 1e-12);
  }
}

// Caps of machine parts have thousands of corners and dents. A fan from the first corner would lie outside them.
TEST(Triangulate, APolygonOfManyCornersAndDentsIsCoveredOnceAtAnySize) {
  for (const double scale : {1.0, 1e-200, 1e150}) {
    std::vector<glm::dvec3> p;
    Indices corners, triangles;
    for (uint32_t i = 0; i < 5000; ++i) {
      const double turn = 6.283185307179586 * i / 5000, radius = i % 2 ? 1 : 0.9;
      p.push_back(scale * glm::dvec3(7 + radius * std::cos(turn), radius * std::sin(turn), 3));
      corners.push_back(i);
    }
    FaceTriangles().append(p, corners.data(), corners.size(), triangles);
    ASSERT_EQ(triangles.size(), 3u * 4998);
    double area = 0;
    for (size_t t = 0; t < triangles.size(); t += 3) {
      const glm::dvec3 a = (p[triangles[t + 1]] - p[triangles[t]]) / scale;
      const glm::dvec3 b = (p[triangles[t + 2]] - p[triangles[t]]) / scale;
      const double twice = glm::cross(a, b).z;
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
    EXPECT_NEAR(area, 0.5 * 5000 * 0.9 * std::sin(6.283185307179586 / 5000), 1e-9);
  }
}

TEST(MeshFile, WhatIsWrittenReadsBackTheSame) {
  SurfaceMesh mesh;
  mesh.positions = {{0.1, -1.0 / 3, 1e-17}, {1e9, 2, 3}, {4, 5, 6}, {7, 8.125, -9}, {0, 0, 0}};
  mesh.face_sizes = {4, 3};
  mesh.face_vertices = {0, 1, 2, 3, 0, 3, 4};
  FaceTriangles cut;
  cut.append(mesh.positions, mesh.face_vertices.data(), 4, mesh.triangles);
  cut.append(mesh.positions, mesh.face_vertices.data() + 4, 3, mesh.triangles);
  for (int v = 0; v < 5; ++v) {
    mesh.normals.push_back(glm::normalize(glm::vec3(1, v, 2)));
    mesh.colors.emplace_back(0.25f * static_cast<float>(v), 1, 0, 1);
  }
  TemporaryFolder folder;
  for (const char* extension : {".obj", ".off", ".ply", ".PLY"}) {
    const auto file = folder.path / (std::string("mesh") + extension);
    write_mesh_file(mesh, file);
    const SurfaceMesh back = read_mesh_file(file);
    EXPECT_EQ(back.positions, mesh.positions) << extension;
    EXPECT_EQ(back.face_sizes, mesh.face_sizes) << extension;
    EXPECT_EQ(back.face_vertices, mesh.face_vertices) << extension;
    EXPECT_EQ(back.triangles, mesh.triangles) << extension;
    EXPECT_EQ(back.colors, mesh.colors) << extension;
    if (std::string(extension) != ".obj") {
      EXPECT_EQ(back.normals, mesh.normals) << extension;
    }
  }
  for (const char* extension : {".glb", ".gltf"}) {
    const auto file = folder.path / (std::string("mesh") + extension);
    write_mesh_file(mesh, file);
    const SurfaceMesh back = read_mesh_file(file);
    EXPECT_EQ(back.triangles, mesh.triangles);
    for (size_t v = 0; v < 5; ++v) EXPECT_EQ(back.positions[v], float_rounded(mesh.positions[v]));
  }
  EXPECT_THROW(write_mesh_file(mesh, folder.path / "mesh.xyz"), std::runtime_error);
  EXPECT_THROW(read_mesh_file(folder.path / "mesh.xyz"), std::runtime_error);
  EXPECT_THROW(read_mesh_file(folder.path / "missing.obj"), std::runtime_error);
  mesh.triangles[0] = 99;
  EXPECT_NE(message_of([&] { write_mesh_file(mesh, folder.path / "mesh.obj"); }).find("vertex 99"), std::string::npos);
}

// V, T of the optional data, from its README.
TEST(MeshFile, TheSharedMeshesHaveTheListedVerticesAndTriangles) {
  HF_NEED_SHARED_DATA();
  const auto folder = shared_data();
  std::ifstream readme(folder / "README.md");
  std::string line;
  size_t files = 0;
  while (std::getline(readme, line)) {
    if (line.compare(0, 9, "| meshes/") != 0) continue;
    char name[200];
    size_t vertices = 0, triangles = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "| meshes/%199s | %zu | %zu |", name, &vertices, &triangles), 3) << line;
    const SurfaceMesh mesh = read_mesh_file(folder / "meshes" / name);
    EXPECT_EQ(mesh.positions.size(), vertices) << name;
    EXPECT_EQ(mesh.triangles.size() / 3, triangles) << name;
    ++files;
  }
  EXPECT_GT(files, 40u);
}

}  // namespace
