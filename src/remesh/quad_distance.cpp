#include "remesh/quad_distance.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "remesh/constants.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

// Counts the corners of a quad that are reflex in the plane of its mean normal. last: the last of them.
std::int32_t reflex_corners(const QuadMesh& mesh, const std::int32_t* c, std::int32_t& last) {
  const Vec3 normal = cross(mesh.position[c[2]] - mesh.position[c[0]], mesh.position[c[3]] - mesh.position[c[1]]);
  std::int32_t count = 0;
  for (std::int32_t k = 0; k < 4; ++k) {
    const Vec3 p = mesh.position[c[k]];
    const Vec3 turn = cross(mesh.position[c[(k + 1) % 4]] - p, mesh.position[c[(k + 3) % 4]] - p);
    if (dot(turn, normal) <= 0) {
      last = k;
      ++count;
    }
  }
  return count;
}

// The triangles of all quads, to which distances are measured: a fan from the first corner of each. A quad so twisted
// that no diagonal lies inside it adds the triangles of both diagonals.
struct Soup {
  explicit Soup(Memory& memory) : corners(memory), face(memory) {}
  Table<std::int32_t> corners, face;
  void make(const QuadMesh& mesh) {
    auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t f) {
      corners.push_back(a);
      corners.push_back(b);
      corners.push_back(c);
      face.push_back(f);
    };
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t* c = mesh.quad(f);
      for (std::int32_t k = 2; k < 4; ++k) add(c[0], c[k - 1], c[k], f);
      std::int32_t last = 0;
      if (reflex_corners(mesh, c, last) > 1) {
        add(c[1], c[2], c[3], f);
        add(c[3], c[0], c[1], f);
      }
    }
  }
};

// Visits points of a triangle except its corners. They are about `spacing` apart, with at most most_steps steps along
// an edge.
template <class Visit>
void spread(Vec3 a, Vec3 b, Vec3 c, double spacing, std::int32_t least, Visit&& visit) {
  const double longest = std::max(norm(b - a), std::max(norm(c - b), norm(a - c)));
  const std::int32_t n = std::max(least, static_cast<std::int32_t>(std::min(std::ceil(longest / spacing), most_steps)));
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t k = j == 0 ? 1 : 0; j + k <= n && k < n; ++k)
      visit((1.0 / n) * (static_cast<double>(j) * b + static_cast<double>(k) * c + static_cast<double>(n - j - k) * a));
}

}  // namespace

QuadDistance::QuadDistance(const FluxSurface& surface, double spacing, Memory& memory, JobRunner* jobs)
    : surface_(&surface),
      spacing_(spacing),
      memory_(&memory),
      jobs_(jobs),
      corners_([&] {
        Table<std::int32_t> corners(memory);
        for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) corners.push_back(surface.tail[h]);
        return corners;
      }()),
      tree_(span_of(surface.position), span_of(corners_), memory),
      samples_(memory) {
  sample_surface();
}

void QuadDistance::sample_surface() {
  const FluxSurface& s = *surface_;
  const std::int32_t step = 1 + s.first_apex / most_samples;
  Table<std::uint8_t> seen(s.first_apex, 0, *memory_);
  for (const std::int32_t t : tree_.order()) {
    const std::int32_t* c = corners_.data() + 3 * t;
    for (std::int32_t k = 0; k < 3; ++k) {
      if (seen[c[k]] || c[k] % step != 0) continue;
      seen[c[k]] = 1;
      samples_.push_back({s.position[c[k]], c[k], none, none});
    }
    if (s.real_triangles > most_spread) continue;
    spread(s.position[c[0]], s.position[c[1]], s.position[c[2]], spacing_, surface_steps, [&](const Vec3& p) {
      samples_.push_back({p, QuadMiss::of_surface, none, none});
    });
  }
}

Table<QuadDistance::Sample> QuadDistance::sample_quads(const QuadMesh& mesh, const Table<std::int32_t>& corners,
                                                       const Table<std::int32_t>& faces, const NearFaces* known) const {
  Table<Sample> samples(*memory_);
  for (std::int32_t i = 0; i < faces.size(); ++i) {
    if (known && known->has(mesh, faces[i])) continue;
    const std::int32_t* c = corners.data() + 3 * i;
    spread(mesh.position[c[0]], mesh.position[c[1]], mesh.position[c[2]], spacing_, quad_steps, [&](const Vec3& p) {
      samples.push_back({p, QuadMiss::of_quads, faces[i], mesh.location[c[0]].triangle});
    });
  }
  return samples;
}

SurfacePoint QuadDistance::nearest(Vec3 p) const noexcept {
  SurfacePoint at;
  at.triangle = tree_.find(p).triangle;
  tree_.weights(p, at.triangle, at.weight);
  return at;
}

std::uint64_t NearFaces::key(const QuadMesh& mesh, std::int32_t f) noexcept {
  std::uint64_t key = hash_start;
  for (std::int32_t k = 0; k < 4; ++k) {
    const Vec3 p = mesh.position[mesh.quad(f)[k]];
    for (const double x : {p.x, p.y, p.z}) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      key = (key ^ bits) * hash_factor;
      key ^= key >> 32;
    }
  }
  return key;
}

void QuadDistance::turn_quads(QuadMesh& mesh, const NearFaces* known) const {
  const std::int32_t pieces = (mesh.face_count() + faces_a_piece - 1) / faces_a_piece;
  for_each(jobs_, static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
    const std::int32_t first = static_cast<std::int32_t>(piece) * faces_a_piece;
    for (std::int32_t f = first; f < std::min(first + faces_a_piece, mesh.face_count()); ++f) {
      if (known && known->has(mesh, f)) continue;
      std::int32_t* c = mesh.quad(f);
      std::int32_t reflex = 0;
      if (reflex_corners(mesh, c, reflex) == 1) {
        std::rotate(c, c + reflex, c + 4);
        continue;
      }
      auto miss = [&](std::int32_t k, double enough) {
        const Vec3 a = mesh.position[c[k]], b = mesh.position[c[k + 2]];
        double worst = flat_diagonal * spacing_ * spacing_;
        for (const double share : diagonal_shares) {
          const std::int32_t hint = mesh.location[c[share < 0.5 ? k + 2 : k]].triangle;
          worst = std::max(worst, tree_.find(share * a + (1 - share) * b, hint, worst).squared);
          if (worst > enough) break;
        }
        return worst;
      };
      const double own = miss(0, HUGE_VAL);
      if (miss(1, own) < own) std::rotate(c, c + 1, c + 4);
    }
  });
}

double QuadDistance::measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses,
                             NearFaces* known) const {
  Soup soup(*memory_);
  soup.make(mesh);
  const mesh::NearestTriangle quads(span_of(mesh.position), span_of(soup.corners), *memory_);
  double worst = out_misses ? tolerance : 0;
  Table<double> distance(*memory_);
  Table<std::int32_t> nearest(*memory_);
  // Stores distances of samples above `tolerance`. Without out_misses it stores only distances above all earlier ones
  // of the same thread's job. All others are 0.
  auto measure_samples = [&](const mesh::NearestTriangle& tree, const Table<Sample>& samples,
                             const Table<std::int32_t>* faces) {
    distance.assign(samples.size(), 0);
    nearest.assign(samples.size(), none);
    const std::int32_t pieces = (samples.size() + samples_a_piece - 1) / samples_a_piece;
    for_each(jobs_, static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
      const std::int32_t first = static_cast<std::int32_t>(piece) * samples_a_piece;
      std::int32_t hint = none;
      double least = out_misses ? tolerance * tolerance : 0;
      for (std::int32_t i = first; i < std::min(first + samples_a_piece, samples.size()); ++i) {
        if (samples[i].hint >= 0 && (i == first || samples[i].face != samples[i - 1].face)) hint = samples[i].hint;
        const mesh::NearestTriangle::Found found = tree.find(samples[i].point, hint, least);
        hint = found.triangle;
        if (found.squared <= least) continue;
        distance[i] = std::sqrt(found.squared);
        nearest[i] = found.triangle;
        if (!out_misses) least = found.squared;
      }
    });
    poll();
    for (std::int32_t i = 0; i < samples.size(); ++i) {
      worst = std::max(worst, distance[i]);
      if (!out_misses || !(distance[i] > tolerance)) continue;
      out_misses->push_back(
          {distance[i], samples[i].point, samples[i].vertex, faces ? (*faces)[nearest[i]] : samples[i].face});
    }
  };
  measure_samples(quads, samples_, &soup.face);
  measure_samples(tree_, sample_quads(mesh, soup.corners, soup.face, known), nullptr);
  if (known) {
    Table<std::uint8_t> off(mesh.face_count(), out_misses ? 0 : 1, *memory_);
    for (std::size_t i = 0; out_misses && i < out_misses->size(); ++i)
      if ((*out_misses)[i].vertex == QuadMiss::of_quads) off[(*out_misses)[i].face] = 1;
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
      if (!off[f]) known->keys.insert(NearFaces::key(mesh, f));
  }
  if (out_misses) {
    std::sort(out_misses->begin(), out_misses->end(), [](const QuadMiss& a, const QuadMiss& b) {
      return a.distance != b.distance ? a.distance > b.distance
             : a.face != b.face       ? a.face < b.face
                                      : a.vertex < b.vertex;
    });
  }
  return worst;
}

}  // namespace hf_inner::remesh
