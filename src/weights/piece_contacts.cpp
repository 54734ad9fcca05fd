#include "weights/piece_contacts.h"

#include <algorithm>
#include <cmath>

#include "mesh/nearest_triangle.h"
#include "weights/constants.h"
#include "weights/piece_bones.h"

namespace hf_inner::weights {
namespace {

// The nearest place of a piece.
struct Near {
  double squared = HUGE_VAL;
  Index piece = -1, vertex = -1;
  bool operator<(const Near& b) const noexcept { return squared != b.squared ? squared < b.squared : piece < b.piece; }
};

// Triangles by piece, and the boxes of the pieces.
class Finder {
 public:
  Finder(const mesh::Mesh& mesh, Memory& memory)
      : mesh_(mesh),
        triangles_(mesh::triangle_boxes(mesh.positions, mesh.corners, memory), groups(mesh, memory),
                   mesh.component_count(), memory),
        pieces_(piece_boxes(mesh, memory), memory) {}

  // The nearest pieces but `own`, ascending; places left over have no piece.
  void find(const Vec3& p, Index own, Near (&out)[contacts_a_sample]) const {
    std::fill_n(out, contacts_a_sample, Near{});
    const auto reach = [&] {
      return std::min(contact_distance * contact_distance, out[contacts_a_sample - 1].squared);
    };
    pieces_.near(p, reach, [&](Index piece) {
      if (piece == own) return;
      Near found;
      found.squared = reach();
      found.piece = piece;
      triangles_.near(
          piece, p, [&] { return found.squared; },
          [&](Index t) {
            const Index* v = mesh_.triangle(t);
            double weight[3];
            const double squared = mesh::squared_to_triangle(p, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])],
                                                             mesh_.positions[at(v[2])], weight);
            if (!(squared < found.squared)) return;
            found.squared = squared;
            found.vertex = v[std::max_element(weight, weight + 3) - weight];
          });
      if (found.vertex < 0) return;
      for (Near& place : out) {
        if (found < place) std::swap(found, place);
      }
    });
  }

 private:
  static Vector<Index> groups(const mesh::Mesh& mesh, Memory& memory) {
    Vector<Index> out(&memory);
    for (Index t = 0; t < mesh.triangle_count(); ++t) out.push_back(mesh.component[at(mesh.triangle(t)[0])]);
    return out;
  }
  const mesh::Mesh& mesh_;
  mesh::BoxTree triangles_, pieces_;
};

// Every vertex of the marked pieces. On large pieces every second, third, ... vertex by its distance from the middle.
// The choice depends neither on the order of the vertices nor on the axes.
Vector<Index> sample(const mesh::Mesh& mesh, const Vector<std::uint8_t>& marked, Memory& memory) {
  struct Member {
    Index piece, vertex;
    double squared;
    bool operator<(const Member& b) const noexcept {
      if (piece != b.piece) return piece < b.piece;
      return squared != b.squared ? squared < b.squared : vertex < b.vertex;
    }
  };
  Vector<std::size_t> size(marked.size(), 0, &memory), passed(marked.size(), 0, &memory);
  Vector<Vec3> sum(marked.size(), &memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t c = at(mesh.component[at(v)]);
    ++size[c];
    sum[c] = sum[c] + mesh.positions[at(v)];
  }
  Vector<Member> members(&memory);
  Vector<Index> out(&memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t c = at(mesh.component[at(v)]);
    if (!marked[c]) continue;
    if (size[c] <= piece_samples) {
      out.push_back(v);
      continue;
    }
    const Vec3 away = mesh.positions[at(v)] - (1 / static_cast<double>(size[c])) * sum[c];
    members.push_back({static_cast<Index>(c), v, dot(away, away)});
  }
  std::sort(members.begin(), members.end());
  for (const Member& member : members) {
    const std::size_t c = at(member.piece), stride = (size[c] + piece_samples - 1) / piece_samples;
    if (passed[c]++ % stride == 0) out.push_back(member.vertex);
  }
  return out;
}

}  // namespace

PieceContacts::PieceContacts(const surface::Core& core, const Vector<std::uint8_t>& marked, Memory& memory)
    : all(&memory),
      from_start_(marked.size() + 1, 0, &memory),
      from_(&memory),
      to_start_(marked.size() + 1, 0, &memory),
      to_(&memory) {
  const mesh::Mesh& mesh = core.mesh;
  const Finder finder(mesh, memory);
  const Vector<Index> samples = sample(mesh, marked, memory);
  struct Row {
    Near near[contacts_a_sample];
  };
  Vector<Row> rows(samples.size(), &memory);
  for_ranges(*core.jobs, samples.size(), vertex_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t v = at(samples[i]);
      finder.find(mesh.positions[v], mesh.component[v], rows[i].near);
    }
  });
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (const Near& near : rows[i].near) {
      if (near.piece < 0) continue;
      const double soft = std::sqrt(near.squared) + contact_softness;
      all.push_back({mesh.component[at(samples[i])], near.vertex, core.areas[at(samples[i])] / (soft * soft)});
    }
  }
  const auto sort = [&](auto&& piece_of, Vector<Index>& start, Vector<Index>& list) {
    for (const PieceContact& contact : all) ++start[at(piece_of(contact)) + 1];
    for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
    Vector<Index> next(start.begin(), start.end() - 1, &memory);
    list.assign(all.size(), 0);
    for (std::size_t i = 0; i < all.size(); ++i) list[at(next[at(piece_of(all[i]))]++)] = static_cast<Index>(i);
  };
  sort([](const PieceContact& contact) { return contact.piece; }, from_start_, from_);
  sort([&](const PieceContact& contact) { return mesh.component[at(contact.vertex)]; }, to_start_, to_);
}

}  // namespace hf_inner::weights
