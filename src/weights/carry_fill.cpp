#include "weights/carry_fill.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/progress.h"
#include "base/stable_sort.h"
#include "solve/constraint_system.h"
#include "solve/site_solver.h"
#include "weights/constants.h"
#include "weights/pieces.h"

namespace hf_inner::weights {

Vector<std::uint8_t> known_pieces(const mesh::Mesh& mesh, const WeightRows& known, Memory& memory) {
  Vector<std::uint8_t> out(at(mesh.component_count()), 0, &memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) out[at(mesh.component[at(v)])] |= known.has(v);
  return out;
}

namespace {

// Shares of progress when the vertices are matched, when the operator has its factor, and when the sites are in it. The
// last is the share of the sweeps in the rest, before pruning. Chosen by time on a torus of which a third has no
// weights. Other shares move the fraction at equal times, and no result.
constexpr float fill_matched = 0.1f, fill_factorised = 0.25f, fill_edited = 0.8f, fill_swept = 0.6f;

// The fields of all bones at the vertices to fill in.
struct Solved {
  explicit Solved(Memory& memory) : row_of(&memory), bone_of(&memory) {}
  Vector<Index> row_of;   // by vertex: its row in the field, or -1
  Vector<Index> bone_of;  // by column
  Buffer<double> field;   // [row][bone]
};

// Marks the vertices to fill in. The sites are the known vertices of their pieces.
Vector<solve::Site> choose_sites(const Fill& fill, const Vector<std::uint8_t>& known, Solved& out, Memory& memory) {
  const mesh::Mesh& mesh = fill.core->mesh;
  Vector<std::uint8_t> open(known.size(), 0, &memory);
  out.row_of.assign(at(mesh.vertex_count()), -1);
  Index rows = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t c = at(mesh.component[at(v)]);
    if (known[c] && !fill.known.has(v)) {
      out.row_of[at(v)] = rows++;
      open[c] = 1;
    }
  }
  Vector<solve::Site> sites(&memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (open[at(mesh.component[at(v)])] && fill.known.has(v)) sites.push_back(solve::Site::at_vertex(mesh, v));
  }
  return sites;
}

// The number of the column of every bone that a site has, or -1.
Vector<Index> number_bones(const Fill& fill, const Vector<solve::Site>& sites, Solved& out, Memory& memory) {
  Index last = -1;
  for (const Share& share : fill.known.shares) last = std::max(last, share.bone);
  Vector<Index> column(at(last + 1), -1, &memory);
  for (const solve::Site& site : sites) {
    for (const Share& share : fill.known.of(site.vertex[0])) column[at(share.bone)] = 0;
  }
  for (std::size_t b = 0; b < column.size(); ++b) {
    if (column[b] < 0) continue;
    column[b] = static_cast<Index>(out.bone_of.size());
    out.bone_of.push_back(static_cast<Index>(b));
  }
  return column;
}

// Bi-harmonic, or harmonic where the bi-harmonic operator has no factor. Discs of creatures that lose their weights get
// back 0.83 of them with a bi-harmonic field, and 0.73 with a harmonic one.
std::shared_ptr<const surface::Core> solving_core(const Fill& fill) {
  if (!fill.surface) return fill.core;
  try {
    return fill.surface->core(mesh::FieldKind::biharmonic);
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
    return fill.core;
  }
}

Solved solve(const Fill& fill, const Vector<std::uint8_t>& known, Memory& memory) {
  Solved out(memory);
  const surface::Core& core = *fill.core;
  const Vector<solve::Site> sites = choose_sites(fill, known, out, memory);
  const std::size_t n = at(core.size());
  const auto rows =
      static_cast<std::size_t>(std::count_if(out.row_of.begin(), out.row_of.end(), [](Index row) { return row >= 0; }));
  if (rows == 0) return out;
  const Vector<Index> column = number_bones(fill, sites, out, memory);
  report(fill_matched);
  std::shared_ptr<solve::SiteSolver> engine;
  {
    const ProgressRange range(fill_matched, fill_factorised);
    engine = solve::SiteSolver::make(solving_core(fill));
  }
  Vector<Index> slots(sites.size(), &memory);
  std::iota(slots.begin(), slots.end(), 0);
  {
    const ProgressRange range(fill_factorised, fill_edited);
    engine->edit({{}, slots, sites});
  }
  const ProgressRange range(fill_edited, 1.0f);

  constexpr std::size_t block = solve::ConstraintSystem::channel_block;  // bones of one sweep
  const std::size_t width = out.bone_of.size();
  out.field.allocate(memory, rows * width);
  Vector<double> values(&memory);
  Buffer<double> field;
  field.allocate(memory, n * std::min(block, width));
  for (std::size_t first = 0; first < width; first += block) {
    const std::size_t m = std::min(block, width - first);
    values.assign(sites.size() * m, 0.0);
    for (std::size_t s = 0; s < sites.size(); ++s) {
      for (const Share& share : fill.known.of(sites[s].vertex[0])) {
        const std::size_t c = at(column[at(share.bone)]);
        if (c >= first && c < first + m) values[s * m + c - first] = share.weight;
      }
    }
    engine->solve(values.data(), static_cast<Index>(m), field.data(), nullptr);
    for (std::size_t v = 0; v < n; ++v) {
      if (out.row_of[v] >= 0)
        std::copy_n(field.data() + v * m, m, out.field.data() + at(out.row_of[v]) * width + first);
    }
    report(fill_swept * static_cast<float>(first + m) / static_cast<float>(width));
  }
  return out;
}

void count_given(const mesh::Mesh& mesh, FilledWeights& out) {
  for (std::size_t g = 0; g < mesh.inner_of_given.size(); ++g) {
    const Index v = mesh.inner_of_given[g];
    ++out.by_origin[static_cast<std::size_t>(v == mesh::Mesh::none ? Origin::isolated : out.origin[at(v)])];
  }
}

// The diagonals of the boxes of pieces, by component.
Vector<double> piece_sizes(const mesh::Mesh& mesh, Memory& memory) {
  const std::size_t pieces = at(mesh.component_count());
  Vector<mesh::ItemBox> box(pieces, &memory);
  Vector<std::uint8_t> seen(pieces, 0, &memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t c = at(mesh.component[at(v)]);
    if (!seen[c]) {
      box[c] = mesh::ItemBox::of(mesh.positions[at(v)]);
      seen[c] = 1;
    }
    box[c].take(mesh.positions[at(v)]);
  }
  Vector<double> out(&memory);
  for (const mesh::ItemBox& b : box) out.push_back(norm(b.high - b.low));
  return out;
}

// The mean of the rows of every small piece without known weights; empty rows for the others.
WeightRows piece_means(const Fill& fill, const WeightRows& guessed, const Vector<std::uint8_t>& known, Memory& memory) {
  const mesh::Mesh& mesh = fill.core->mesh;
  const Vector<double> size = piece_sizes(mesh, memory);
  struct Entry {
    Index piece;
    Share share;
  };
  Vector<Entry> entries(&memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index c = mesh.component[at(v)];
    if (known[at(c)] || !(size[at(c)] < rigid_size)) continue;
    for (const Share& share : guessed.of(v)) entries.push_back({c, share});
  }
  stable_sort(
      entries,
      [](const Entry& a, const Entry& b) {
        return a.piece != b.piece ? a.piece < b.piece : a.share.bone < b.share.bone;
      },
      memory);
  WeightRows out(memory);
  std::size_t next = 0;
  for (std::size_t c = 0; c < known.size(); ++c) {
    for (; next < entries.size() && at(entries[next].piece) == c; ++next)
      out.add(entries[next].share.bone, entries[next].share.weight);
    out.close();
  }
  return out;
}

}  // namespace

FilledWeights fill_weights(const Fill& fill, const WeightRows& guessed, std::int32_t influences) {
  const surface::Core& core = *fill.core;
  Memory& memory = *core.memory;
  FilledWeights out(memory);
  out.influences = influences;
  const Vector<std::uint8_t> known = known_pieces(core.mesh, fill.known, memory);
  const Solved solved = solve(fill, known, memory);
  const WeightRows means = piece_means(fill, guessed, known, memory);
  out.pieces_guessed = static_cast<std::uint32_t>(std::count(known.begin(), known.end(), 0));
  const std::size_t k = at(influences), width = solved.bone_of.size();
  out.joints.resize(at(core.size()) * k);
  out.weights.resize(at(core.size()) * k);
  Vector<Share> shares(&memory);
  const Vector<Share> unlocked(&memory);
  Poller poller(filled_per_poll);
  for (Index v = 0; v < core.size(); ++v) {
    poller.due();
    const Index piece = core.mesh.component[at(v)];
    shares.clear();
    Origin origin = Origin::solved;
    if (fill.known.has(v)) {
      origin = fill.origin[at(v)];
      shares.assign(fill.known.of(v).begin(), fill.known.of(v).end());
    } else if (!known[at(piece)]) {
      const bool rigid = means.has(piece);
      const Span<const Share> row = rigid ? means.of(piece) : guessed.of(v);
      origin = rigid ? Origin::rigid : Origin::carried;
      shares.assign(row.begin(), row.end());
    } else {
      const double* row = solved.field.data() + at(solved.row_of[at(v)]) * width;
      for (std::size_t c = 0; c < width; ++c) {
        if (row[c] > 0) shares.push_back({solved.bone_of[c], row[c]});
      }
    }
    out.origin.push_back(origin);
    write_influences(shares, unlocked, origin == Origin::solved, influences, out.joints.data() + at(v) * k,
                     out.weights.data() + at(v) * k);
  }
  out.nearest_of_isolated = nearest_of_isolated(core.mesh, memory);
  count_given(core.mesh, out);
  return out;
}

}  // namespace hf_inner::weights
