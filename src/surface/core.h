// Geometry, operator and factor, which all fields of one kind on one surface share. A core is immutable, so any number
// of threads may read it. Only its workspace pools have a lock.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/jobs.h"
#include "base/memory.h"
#include "factor/factor.h"
#include "surface/geometry.h"
#include "surface/preview_cache.h"

namespace hf_inner::surface {

// K of a mesh with a vertex of more neighbours is not formed (mixed_solver.h). Formed, such a vertex costs about 33
// bytes times the square of its neighbours. A fan of 500 triangles is off by 4e-13, one of 1,000 by 1e-11, one of 2,000
// by 4e-9. Below the limit, fields of many sites take fewer sweeps with a formed K.
constexpr std::int32_t most_formed_valence = 1000;

struct Core;
struct LinkChange;
struct PatchRows;
struct PieceDiagonals;

// The operator of an edited surface (edited_core.h). Fields hardly ever need it, so it is
// made when it is first asked for. Thread safety: any thread.
class EditedMatrix {
 public:
  // patch, links, stiffness: null for none.
  EditedMatrix(std::shared_ptr<const Core> plain, std::shared_ptr<const PatchRows> patch,
               std::shared_ptr<const LinkChange> links, std::shared_ptr<const Vector<double>> stiffness);
  const SymmetricMatrix& get() const;

 private:
  std::shared_ptr<const Core> plain_;
  std::shared_ptr<const PatchRows> patch_;
  std::shared_ptr<const LinkChange> links_;
  std::shared_ptr<const Vector<double>> stiffness_;
  mutable std::mutex mutex_;
  mutable SymmetricMatrix made_;
};

struct CoreOptions {
  mesh::OperatorKind operator_kind = mesh::OperatorKind::intrinsic_delaunay;
  mesh::FieldKind field_kind = mesh::FieldKind::harmonic;
  factor::Ordering ordering = factor::Ordering::nested_dissection;
  // False for a caller that keeps a factor of its own.
  bool need_factor = true;
  // If this is not empty, the factor is loaded from these bytes.
  Span<const std::uint8_t> saved_factor;
  // Reads the numbers of saved_factor in place. The bytes must then outlive the core.
  bool borrow_factor = false;
  // Refuses every factorisation on the core that takes more operations. 0 means no limit.
  double flop_limit = 0;
  // See most_formed_valence. Tests lower it.
  std::int32_t formed_valence = most_formed_valence;
  // A core whose ordering is used again if the matrix has the same pattern, or null.
  const Core* like = nullptr;
  // By vertex, as Core::stiffness.
  std::shared_ptr<const Vector<double>> stiffness;
};

struct CoreTimes {
  double weld_ms = 0, operator_ms = 0;
};

struct Core {
  explicit Core(std::shared_ptr<const Geometry> shape);
  // Makes the operator K on a geometry, and the factor of the pinned matrix A = K + sum_c beta_c e_gc e_gc'. The pinned
  // vertex of component c is its first vertex g_c. There the diagonal is raised by beta_c, the mean diagonal of K in
  // the component. The geometry must have the same options.operator_kind. Progress runs from 0.15 to 1.
  static std::shared_ptr<const Core> make(std::shared_ptr<const Geometry> shape, const CoreOptions& options);
  // Makes the geometry and its core in one call.
  static std::shared_ptr<const Core> make(const mesh::MeshInput& input, const CoreOptions& options,
                                          std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs);

  // Takes what `from` was made with, and which weights a rule set.
  void take_options(const Core& from) noexcept {
    field_kind = from.field_kind;
    ordering = from.ordering;
    flop_limit = from.flop_limit;
    formed_valence = from.formed_valence;
    changed_count = from.changed_count;
    first_changed = from.first_changed;
  }
  std::int32_t size() const noexcept { return mesh.vertex_count(); }
  // The unknowns of the factor: the vertices, and those that went since it was made (extended_factor.h).
  std::int32_t unknown_count() const noexcept { return factor ? factor->size() : size(); }
  // A flux of 1 in a component is this much in the caller's unit of weights. Bi-harmonic operators square the weights.
  double flux_unit(std::int32_t component) const noexcept {
    const double unit = geometry->weight_unit(component);
    return field_kind == mesh::FieldKind::harmonic ? unit : unit * unit;
  }

  std::shared_ptr<Memory> memory;  // first member: outlives everything that is allocated from it
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<JobRunner> jobs;
  const mesh::Mesh& mesh;  // this and the next are parts of the geometry
  const SharedVector<double>& areas;
  const mesh::Topology& topology() const { return geometry->topology(); }
  const Vector<double>& weights() const { return geometry->weights(); }
  mesh::FieldKind field_kind = mesh::FieldKind::harmonic;
  // The operator K: the Laplacian, or a bi-harmonic operator; empty where a root stands for it.
  const SymmetricMatrix& matrix() const { return edited ? edited->get() : laplacian; }
  SymmetricMatrix laplacian;
  // Not null: K = L diag(inverse_mass) L is not formed, because a vertex has too many neighbours. The root has L as its
  // operator, and the factor. The pinned vertices are its own.
  std::shared_ptr<const Core> root;
  Vector<double> inverse_mass;   // by vertex; empty: ones
  Vector<std::int32_t> ground;   // pinned vertex (raised diagonal) per component
  Vector<double> mean_diagonal;  // per component
  // Correction steps with the true operator after the sweep of a field: 0 for second-order operators, 1 for bi-harmonic
  // operators, whose condition number is squared. The residual uses differences of values.
  std::int32_t refinements = 0;
  // Rounding in the factor shows in the fields of a long shape (Factor::commute_time). They take corrections until the
  // last one is small (green_refine.cpp).
  bool is_long = false;
  // 0 if no weights were limited. If the weights of some components were limited because those components did not
  // factor (lost_components.h), it is 1 plus the hash of the matrix A before that. A saved factor stores this number,
  // so loading knows early that weights must be limited.
  std::uint64_t confined_hash = 0;
  // Vertices with a weight that a rule set, and the first of them. A rule sets the weights of triangles that are too
  // thin for their own, and weights that spread over more digits than there are.
  std::uint32_t changed_count = 0;
  std::int32_t first_changed = -1;
  factor::Ordering ordering = factor::Ordering::nested_dissection;
  double flop_limit = 0;  // as in CoreOptions
  std::int32_t formed_valence = most_formed_valence;
  // The factor of K, or of the root's operator, with raised diagonals at the pinned vertices; null if need_factor is
  // false.
  std::shared_ptr<const factor::Factor> factor;
  // How stiff the surface is at every vertex: an edge of the operator counts the harmonic mean of its two ends times.
  // Null: 1 everywhere.
  std::shared_ptr<const Vector<double>> stiffness;
  // The rows that exchanged triangles changed since `unedited`; null: none.
  std::shared_ptr<const PatchRows> patch;
  // The difference from the links of `unedited`; null: none.
  std::shared_ptr<const LinkChange> link_change;
  std::shared_ptr<const Core> unedited;        // the core of the surface before all edits; null: this one
  std::shared_ptr<const EditedMatrix> edited;  // K; null: laplacian is K
  std::shared_ptr<const Core> factored;        // the core whose factor this factor extends; null: it has its own
  CoreTimes times;
  std::shared_ptr<const PieceDiagonals> pieces;  // of a harmonic core with a laplacian; for edits
  mutable PreviewCache preview;                  // the factor in single precision; not for a core with `factored`
  WorkspacePool& workspaces;                     // the pools of the geometry without links
  WorkspacePool& zeroed_workspaces;
};

// Returns the matrix A that is factorised: K with raised diagonals at the pinned vertices.
SymmetricMatrix grounded(const Core& core);
// Returns the hash of the factorised matrix A, by which a saved factor recognises its mesh. It covers the pattern and
// the numbers of K, and the pinned vertices with their weights.
std::uint64_t grounded_hash(const Core& core);
// Whether rounding in the core's own factor shows in its fields (Core::is_long).
bool is_long_shape(const Core& core);
// Returns the diagonal of K by vertex.
Vector<double> operator_diagonal(const Core& core);
// Writes out = K u with `channels` numbers per vertex, by differences of u. out must not be u.
void apply_operator(const Core& core, const double* u, std::int32_t channels, double* out);
// The stiffness of an edge, from the stiffness of its ends. Two springs in a row, one of each end, are as stiff.
inline double edge_stiffness(double a, double b) noexcept { return 2 * a * b / (a + b); }
// Returns the coordinates of the welded vertices in the format that the ordering needs; none for a graph.
Vector<float> ordering_coordinates(const mesh::Mesh& mesh, Memory& memory);

}  // namespace hf_inner::surface
