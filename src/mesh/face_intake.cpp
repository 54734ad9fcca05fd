#include "mesh/face_intake.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/face_cut.h"

namespace hf_inner::mesh {
namespace {

// Most corners of one face. Cutting takes up to the square of them; a larger face is a mistake of the host.
constexpr std::int64_t most_corners = 65535;
// A face counts as not planar if a corner is farther than this share of its diameter from the mean plane. It is a count
// for the report alone. It counts 330 of 576 quads of a bumpy sheet. Half of it counts 454, double counts 170.
constexpr double report_bend = 0.01;
// Faces between two looks at a cancel.
constexpr std::uint32_t faces_per_poll = 65536;

using FaceCorners = Span<const Index>;

}  // namespace

std::uint64_t count_cut_triangles(const FaceRows& faces) {
  std::uint64_t triangles = 0;
  faces.each([&](std::uint32_t f, std::int64_t start, std::int64_t size) {
    if (size < 3)
      fail(HF_ERROR_INVALID_ARGUMENT, f, "face %u has %lld corners; a face has three or more", f,
           static_cast<long long>(size));
    if (size > most_corners)
      fail(HF_ERROR_TOO_LARGE, f, "face %u has %lld corners; at most %lld are supported", f,
           static_cast<long long>(size), static_cast<long long>(most_corners));
    if (start + size > faces.corner_count)
      fail(HF_ERROR_OUT_OF_RANGE, f, "face %u: its last corner is entry %lld, but corners.count is %u", f,
           static_cast<long long>(start + size - 1), faces.corner_count);
    triangles += static_cast<std::uint64_t>(size) - 2;
  });
  return triangles;
}

void check_face_corners(const FaceRows& faces, std::uint32_t vertex_count) {
  faces.each([&](std::uint32_t f, std::int64_t start, std::int64_t size) {
    for (std::int64_t k = 0; k < size; ++k) {
      const std::uint32_t v = faces.corner(start + k);
      if (v >= vertex_count)
        fail(HF_ERROR_OUT_OF_RANGE, f, "face %u: corner %lld is vertex %u, but there are %u vertices", f,
             static_cast<long long>(k), v, vertex_count);
    }
  });
}

namespace {

// Reads the welded corners of a face. Repeated neighbours and spikes a b a, which have no area, are left out.
void read_corners(const MeshInput& input, const Vector<Index>& representative, std::int64_t start, std::int64_t size,
                  Vector<Index>& corner) {
  corner.clear();
  const auto spike = [&](Index v) { return corner.size() > 1 && v == corner[corner.size() - 2]; };
  for (std::int64_t k = 0; k < size; ++k) {
    const Index v = representative[input.faces.corner(start + k)];
    if (spike(v))
      corner.pop_back();
    else if (corner.empty() || v != corner.back())
      corner.push_back(v);
  }
  while (corner.size() > 1 && (corner.front() == corner.back() || spike(corner.front()))) corner.pop_back();
  while (corner.size() > 2 && corner[1] == corner.back()) {
    corner.erase(corner.begin());
    corner.pop_back();
  }
}

// Appends the triangles of a cut that have three different corners. Corners of none leave the face.
void take_cut(const FaceCutter& cutter, Vector<Index>& corner, SharedVector<Index>& triangles) {
  const std::size_t first = triangles.size();
  bool skipped = false;
  for (std::size_t t = 0; t < cutter.triangles.size(); t += 3) {
    const Index* const k = cutter.triangles.data() + t;
    const Index v[] = {corner[at(k[0])], corner[at(k[1])], corner[at(k[2])]};
    const bool usable = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
    if (usable) triangles.append(v, v + 3);
    skipped = skipped || !usable;
  }
  const Index* const begin = triangles.begin() + first;
  const auto unused = [&](Index v) { return std::find(begin, std::as_const(triangles).end(), v) == triangles.end(); };
  if (skipped) corner.erase(std::remove_if(corner.begin(), corner.end(), unused), corner.end());
}

}  // namespace

void mark_corners(const MeshInput& input, const Vector<Index>& representative, Vector<std::uint8_t>& is_corner,
                  Memory& memory) {
  Vector<Index> corner(&memory);
  input.faces.each([&](std::uint32_t f, std::int64_t start, std::int64_t size) {
    if (f % faces_per_poll == 0) poll();
    read_corners(input, representative, start, size, corner);
    for (std::size_t k = 0; corner.size() >= 3 && k < corner.size(); ++k) is_corner[at(corner[k])] = 1;
  });
}

void take_faces(const MeshInput& input, const Vector<Index>& representative, Mesh& mesh, Memory& memory) {
  Faces& out = mesh.faces;
  mesh.triangle_of_given.assign(input.faces.face_count, Mesh::none);
  mesh.corners.reserve(std::size_t{3} * mesh.report.triangle_count);
  out.given_size.reserve(input.faces.face_count);
  out.corner_start.push_back(0);
  out.triangle_start.push_back(0);
  FaceCutter cutter(memory);
  Vector<Index> corner(&memory);
  Vector<Vec3> point(&memory);
  input.faces.each([&](std::uint32_t f, std::int64_t start, std::int64_t size) {
    if (f % faces_per_poll == 0) poll();
    out.given_size.push_back(static_cast<std::uint32_t>(size));
    out.polygon_count += size > 3;
    out.largest_size = std::max(out.largest_size, out.given_size.back());
    const std::size_t first = mesh.corners.size();
    read_corners(input, representative, start, size, corner);
    if (corner.size() >= 3) {
      point.clear();
      for (const Index v : corner) {
        const std::size_t row = at(v);
        const Vec3 p = {input.positions.get(row, 0), input.positions.get(row, 1), input.positions.get(row, 2)};
        point.push_back(mesh.to_inner(p));
      }
      cutter.cut(corner, point);
      take_cut(cutter, corner, mesh.corners);
    }
    if (mesh.corners.size() == first) {
      ++mesh.report.collapsed_triangle_count;
      return;
    }
    mesh.triangle_of_given[f] = static_cast<Index>(first / 3);
    out.corner.append(corner.begin(), corner.end());
    out.corner_start.push_back(static_cast<Index>(out.corner.size()));
    out.triangle_start.push_back(mesh.triangle_count());
    out.given.push_back(static_cast<Index>(f));
    out.second_cut.push_back(cutter.second_cut);
    out.non_planar_count += cutter.bend > report_bend;
  });
}

namespace {

// Calls visit(edge, forward) for every side of every face that is an edge of the cut.
template <class Visit>
void each_side(const Faces& faces, const Topology& topology, Visit&& visit) {
  for (Index f = 0; f < faces.count(); ++f) {
    const FaceCorners corner = faces.corners_of(f);
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Index a = corner[k], b = corner[(k + 1) % corner.size()], edge = topology.edge_between(a, b);
      if (edge != Mesh::none) visit(edge, a < b);
    }
  }
}

}  // namespace

Vector<std::uint8_t> face_sides(const Faces& faces, const Topology& topology, Memory& memory) {
  Vector<std::uint8_t> is_side(at(topology.edge_count()), 0, &memory);
  each_side(faces, topology, [&](Index edge, bool) { is_side[at(edge)] = 1; });
  return is_side;
}

void count_face_sides(const Faces& faces, const Topology& topology, MeshReport& report, Memory& memory) {
  Vector<std::uint32_t> forward(at(topology.edge_count()), 0, &memory), backward(forward.size(), 0, &memory);
  each_side(faces, topology, [&](Index edge, bool along) { ++(along ? forward : backward)[at(edge)]; });
  report.boundary_edge_count = report.non_manifold_edge_count = report.flipped_edge_count = 0;
  for (std::size_t e = 0; e < forward.size(); ++e) {
    report.boundary_edge_count += forward[e] + backward[e] == 1;
    report.non_manifold_edge_count += forward[e] + backward[e] > 2;
    report.flipped_edge_count += forward[e] > 1 || backward[e] > 1;
  }
}

}  // namespace hf_inner::mesh
