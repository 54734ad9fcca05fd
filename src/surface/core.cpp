#include "surface/core.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "base/timer.h"
#include "factor/factor_bytes.h"
#include "factor/work_limit.h"
#include "mesh/biharmonic.h"
#include "mesh/delaunay_patches.h"
#include "mesh/face_operator.h"
#include "surface/edited_core.h"
#include "surface/lost_components.h"
#include "surface/piece_diagonals.h"

namespace hf_inner::surface {

Core::Core(std::shared_ptr<const Geometry> shape)
    : memory(shape->memory),
      geometry(std::move(shape)),
      jobs(geometry->jobs),
      mesh(geometry->mesh),
      areas(geometry->areas),
      laplacian(*memory),
      inverse_mass(memory.get()),
      ground(memory.get()),
      mean_diagonal(memory.get()),
      workspaces(geometry->unlinked().workspaces),
      zeroed_workspaces(geometry->unlinked().zeroed_workspaces) {}

namespace {

// Finds the mean diagonal of every component and the vertex to pin. diagonal: of K, by vertex.
void find_grounds(Core& core, const Vector<double>& diagonal) {
  const std::size_t components = static_cast<std::size_t>(core.mesh.component_count());
  core.ground.assign(components, mesh::Mesh::none);
  core.mean_diagonal.assign(components, 0.0);
  Vector<double> count(components, 0.0, core.memory.get());
  for (std::int32_t v = 0; v < core.size(); ++v) {
    const std::size_t c = static_cast<std::size_t>(core.mesh.component[static_cast<std::size_t>(v)]);
    if (core.ground[c] == mesh::Mesh::none) core.ground[c] = v;
    core.mean_diagonal[c] += std::fabs(diagonal[at(v)]);
    count[c] += 1;
  }
  for (std::size_t c = 0; c < components; ++c) {
    core.mean_diagonal[c] /= count[c];
    if (!(core.mean_diagonal[c] > 0)) core.mean_diagonal[c] = 1;
  }
  if (core.field_kind != mesh::FieldKind::harmonic) return;
  const auto pieces = make_shared_in<PieceDiagonals>(*core.memory, *core.memory);
  pieces->sum_up(core.geometry->unlinked().mesh, [&](Index v) { return diagonal[at(v)]; });
  core.pieces = pieces;
}

// Edge weights in a bi-harmonic operator are limited to one of these multiples of their median: the first with which
// the matrix can be factorised. Lower ones change more weights, higher ones leave matrices that fail. Half and double
// of all change no bit on a finely refined cylinder, an anchor and a wing nut.
constexpr double weight_caps[] = {1e3, 1e2, 1e1};
constexpr int cap_count = 3;
// If a second-order operator cannot be factorised, one of these shares of the diagonals is added to every edge weight.
// This happens when weights span more digits than a double has. A needle triangle of width 1e-9, for example, connects
// two of its vertices 1e18 times as strongly as the third. The first share with which the matrix can be factorised is
// taken. Larger ones change fields, smaller ones leave matrices that fail. Half and double change no bit on the three
// shapes above.
constexpr double tie_shares[] = {0, 1e-9, 1e-7};
// Last resort for components that still cannot be factorised. Their edge weights are limited to a range of this factor
// around their median, both ways, and so are the masses of bi-harmonic operators. Half and double change no bit on
// eight shapes with needles, loose pieces and a long ribbon.
constexpr double confined_spread = 1e4, confined_biharmonic_spread = 10;
// A pivot of a second-order operator must keep at least this share of its diagonal. The relative error of a field is
// about 2^-52 divided by that share. The pivots of a regular mesh of n vertices keep at least 1 / n. Shares of a
// fourth-order operator keep 1 / n^2, so it has the default limit. Half and double change no bit on eight shapes with
// needles, loose pieces and a long ribbon.
constexpr double harmonic_lost_share = 0x1p-31;

// A bi-harmonic operator has the square of a stiffness. It counts at most this and at least 1 over it, so that regions
// of both kinds span as many digits as harmonic ones. A region of 1e4 beside one of 1e-4 moves fields on a sheared
// sheet by 2e-9 then, with half by 2e-10, with twice by 3e-9. Without a limit that matrix cannot be factorised.
constexpr double largest_biharmonic_stiffness = 100;

// Weights of a graph at most this large are rounding beside its median, which is near 1, and do not count for a cap.
// The cotangents of right angles in tetrahedra are such weights; with many of them the median of all would be one. Half
// and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double graph_rounding = 1e-12;

// Commute time in roundings of 2^-52 above which a shape may be long. A chain of 20,000 triangles has 1e-7 and is off
// by 6e-10. At half the value, shapes that are right to 1e-9 are corrected too. At twice the value, fields on a ribbon
// of 6,000 squares are off by 1.6e-10 of their range.
constexpr double long_share = 1e-8;
// Commute time an unknown below which a shape is not long, whatever its size. Surfaces as wide as long have 10 to 30, a
// tube of 2,000 rings 270. At half the value, elongated surfaces are corrected without need. Half and double change no
// bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double long_commute = 100;

// Smallest angle below which a triangle may be widened: well above the 1e-9 at which one is. No result depends on it.
// Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double widened_angle = 1e-8;

// By vertex, whether a triangle there is too thin to keep its weights; empty: none is.
Vector<std::uint8_t> widened_vertices(const mesh::Mesh& mesh, const mesh::MeshReport& report, Memory& memory) {
  Vector<std::uint8_t> changed(&memory);
  if (report.smallest_angle > widened_angle && report.degenerate_triangle_count == 0) return changed;
  changed.assign(mesh.positions.size(), 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3 && mesh::is_widened(mesh, t); ++k) changed[at(mesh.triangle(t)[k])] = 1;
  }
  return changed;
}

// Builds the operator K for the options, on the mesh's own edges or on the intrinsic Delaunay edges. The number `cap`
// is a position in weight_caps and tie_shares. The list `confined` is empty, or marks the components whose weights are
// limited as a last resort. Returns the diagonal that a bi-harmonic K has with a stiffness of 1, if there is another:
// it is the unit of soft sites.
Vector<double> make_operator(Core& core, const CoreOptions& options, int cap, const Vector<std::uint8_t>& confined) {
  Memory& pool = *core.memory;
  Vector<double> areas(&pool);
  Vector<std::uint8_t> changed(&pool);
  const bool with_areas = options.field_kind == mesh::FieldKind::biharmonic;
  const Geometry& plain = core.geometry->unlinked();
  const mesh::Mesh& mesh = plain.mesh;
  if (options.operator_kind == mesh::OperatorKind::intrinsic_delaunay && mesh.faces.empty()) {
    mesh::DelaunayOperator made =
        mesh::delaunay_operator(mesh, plain.topology(), plain.weights(), with_areas, pool, core.jobs.get());
    core.laplacian = std::move(made.laplacian);
    areas = std::move(made.areas);
    changed = std::move(made.changed);
  } else if (mesh.faces.empty()) {
    if (options.operator_kind == mesh::OperatorKind::graph)
      changed.assign(core.geometry->limited.begin(), core.geometry->limited.end());
    else if (options.operator_kind != mesh::OperatorKind::uniform)
      changed = widened_vertices(core.mesh, plain.mesh_report(), pool);
    core.laplacian = hf_inner::mesh::laplacian(plain.topology(), plain.weights(), pool, core.jobs.get());
  } else {
    mesh::DelaunayOperator made = mesh::face_operator(mesh, plain.topology(), plain.weights(), options.operator_kind,
                                                      with_areas, pool, core.jobs.get());
    core.laplacian = std::move(made.laplacian);
    areas = std::move(made.areas);
    changed = std::move(made.changed);
  }
  if (with_areas && areas.empty()) areas.assign(core.areas.begin(), core.areas.end());
  if (const mesh::Links* links = core.geometry->links.get())
    mesh::add_links(core.laplacian, *links, mesh::link_edges(*links, options.operator_kind, pool), pool);
  const bool harmonic = options.field_kind == mesh::FieldKind::harmonic;
  const double spread = harmonic ? confined_spread : confined_biharmonic_spread;
  changed.resize(at(core.size()), 0);
  if (!harmonic) {
    mesh::cap_weights(core.laplacian, weight_caps[cap], pool, &changed, core.mesh.is_graph() ? graph_rounding : 0.0);
  } else if (tie_shares[cap] > 0) {
    mesh::tie_weakly(core.laplacian, tie_shares[cap], pool);
    std::fill(changed.begin(), changed.end(), std::uint8_t{1});
  }
  if (!confined.empty()) {
    mesh::confine_weights(core.laplacian, core.mesh.component, confined, spread, pool);
    for (std::size_t v = 0; v < changed.size(); ++v) changed[v] |= confined[at(core.mesh.component[v])];
  }
  core.changed_count = static_cast<std::uint32_t>(std::count(changed.begin(), changed.end(), 1));
  core.first_changed = core.mesh.first_of_given([&](Index v) { return changed[at(v)] != 0; });
  if (options.field_kind == mesh::FieldKind::biharmonic) areas = mesh::inverse_masses(core.mesh, std::move(areas));
  for (std::size_t v = 0; !harmonic && !confined.empty() && v < areas.size(); ++v) {
    if (confined[static_cast<std::size_t>(core.mesh.component[v])])
      areas[v] = std::min(std::max(areas[v], 1 / spread), spread);
  }
  Vector<double> unit(&pool), plain_diagonal(&pool);
  if (core.stiffness) {
    plain_diagonal = operator_diagonal(core);
    if (!harmonic) unit = mesh::biharmonic_diagonal(core.laplacian, areas, pool);
    Vector<double> counted(core.stiffness->begin(), core.stiffness->end(), &pool);
    for (double& s : counted)
      if (!harmonic) s = std::clamp(s, 1 / largest_biharmonic_stiffness, largest_biharmonic_stiffness);
    stiffen(core.laplacian, counted, pool);
  }
  if (!harmonic && mesh::exceeds_valence(core.laplacian, options.formed_valence)) {
    core.inverse_mass.swap(areas);
    if (!core.stiffness) plain_diagonal = operator_diagonal(core);
    find_grounds(core, plain_diagonal);
    return unit;
  }
  if (!harmonic) {
    factor::refuse_soup(core.laplacian, options.flop_limit, 1, pool);  // the product costs more than four times as much
    core.laplacian = mesh::biharmonic(core.laplacian, areas, pool, core.jobs.get());
    core.refinements = 1;
  }
  if (!core.stiffness) plain_diagonal = operator_diagonal(core);
  find_grounds(core, core.stiffness && !harmonic ? unit : plain_diagonal);
  return unit;
}

// Makes the core of a bi-harmonic operator that is not formed, on the finished core of its Laplacian. unit: what
// make_operator returned.
std::shared_ptr<const Core> on_root(std::shared_ptr<Core> root, const Vector<double>& unit) {
  const std::shared_ptr<Core> core = make_owner_in<Core>(root->memory, root->geometry);
  core->take_options(*root);
  core->times = root->times;
  core->factor = root->factor;
  core->refinements = 1;
  core->inverse_mass.swap(root->inverse_mass);
  core->stiffness = root->stiffness;
  root->field_kind = mesh::FieldKind::harmonic;
  root->is_long = false;  // the corrections of the whole field are enough
  core->root = std::move(root);
  if (core->stiffness)
    find_grounds(*core, unit);
  else
    find_grounds(*core, operator_diagonal(*core));
  return core;
}

// Raises the diagonal of K at the pinned vertices during the lifetime of this object. A copy of K would cost as much as
// building it.
class InPlaceGrounds {
 public:
  explicit InPlaceGrounds(Core& core) : core_(core), plain_(core.memory.get()) {
    plain_.reserve(core.ground.size());
    for (std::size_t c = 0; c < core.ground.size(); ++c) {
      double& diagonal = core.laplacian.value[core.laplacian.diagonal(core.ground[c])];
      plain_.push_back(diagonal);
      diagonal += core.mean_diagonal[c];
    }
  }
  ~InPlaceGrounds() {
    for (std::size_t c = 0; c < plain_.size(); ++c)
      core_.laplacian.value[core_.laplacian.diagonal(core_.ground[c])] = plain_[c];
  }
  InPlaceGrounds(const InPlaceGrounds&) = delete;
  InPlaceGrounds& operator=(const InPlaceGrounds&) = delete;

 private:
  Core& core_;
  Vector<double> plain_;
};

// Limited weights are above 0. They would be another operator than the caller's, if that has negative ones.
bool has_negative_weights(const Core& core) noexcept {
  return core.mesh.is_graph() && core.mesh.report.negative_edge_count > 0;
}

[[noreturn]] void refuse_indefinite(const Core& core, std::uint32_t unknown) {
  const std::uint32_t vertex = static_cast<std::uint32_t>(core.mesh.given_of_inner[unknown]);
  fail(
      HF_ERROR_NOT_POSITIVE_DEFINITE, vertex,
      "the weights make a matrix that is not positive semi-definite, as found at vertex %u; raise the negative weights",
      vertex);
}

factor::FactorOptions factor_options(const Core& core, const CoreOptions& options) noexcept {
  factor::FactorOptions out;
  out.ordering = options.ordering;
  out.flop_limit = options.flop_limit;
  if (core.refinements == 0) out.lost_share = harmonic_lost_share;
  return out;
}

// The share of progress when the operator stands; the rest is the factor's.
constexpr float progress_operator = 0.2f;

bool same_pattern(const SymmetricMatrix& a, const SymmetricMatrix& b) noexcept {
  return a.column_start == b.column_start && a.row == b.row;
}

void make_factor(Core& core, const CoreOptions& options) {
  Memory& pool = *core.memory;
  if (!options.saved_factor.empty()) {
    factor::LoadOptions load;
    load.unknowns = core.size();
    load.matrix_hash = grounded_hash(core);
    load.borrow = options.borrow_factor;
    core.factor = factor::load_factor(options.saved_factor, load, pool, *core.jobs);
  } else if (options.need_factor) {
    const Vector<float> coordinates = ordering_coordinates(core.mesh, pool);
    const InPlaceGrounds grounds(core);
    core.factor =
        options.like && same_pattern(options.like->matrix(), core.laplacian)
            ? options.like->factor->refactor(core.laplacian, {}, pool, *core.jobs)
            : factor::Factor::make(core.laplacian, coordinates, factor_options(core, options), pool, *core.jobs);
  }
  core.is_long = core.factor && is_long_shape(core);
}

}  // namespace

std::shared_ptr<const Core> Core::make(const mesh::MeshInput& input, const CoreOptions& options,
                                       std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs) {
  if (!options.saved_factor.empty()) factor::check_saved_factor(options.saved_factor);
  return make(Geometry::make(input, options.operator_kind, std::move(memory), std::move(jobs)), options);
}

std::shared_ptr<const Core> Core::make(std::shared_ptr<const Geometry> shape, const CoreOptions& options) {
  Memory& pool = *shape->memory;
  if (!options.saved_factor.empty()) factor::check_saved_factor(options.saved_factor);
  Timer operator_timer;
  std::shared_ptr<Core> core = make_owner_in<Core>(shape->memory, shape);
  core->field_kind = options.field_kind;
  core->stiffness = options.stiffness;
  core->times.weld_ms = shape->weld_ms;
  Vector<std::uint8_t> confined(&pool);
  Vector<double> unit = make_operator(*core, options, 0, confined);
  core->ordering = options.ordering;
  core->flop_limit = options.flop_limit;
  core->formed_valence = options.formed_valence;
  core->times.operator_ms = shape->weights_ms + shape->links_ms + operator_timer.milliseconds();
  report(progress_operator);
  for (int cap = 0;;) {
    try {
      const ProgressRange range(progress_operator, 1.0f);
      make_factor(*core, options);
      break;
    } catch (const Error& error) {
      if (error.code() == HF_ERROR_CANCELLED) throw;
      // Two causes are possible. A pivot failed, or the saved factor belongs to an operator with limited weights. In
      // both cases the loop builds the operator with the next limit and tries again.
      const bool loading = !options.saved_factor.empty();
      if (!confined.empty() || !(loading || error.code() == HF_ERROR_NOT_POSITIVE_DEFINITE)) throw;
      if (cap + 1 == cap_count && has_negative_weights(*core) && error.code() == HF_ERROR_NOT_POSITIVE_DEFINITE)
        refuse_indefinite(*core, error.index());
      if (cap + 1 == cap_count) {
        core->confined_hash = grounded_hash(*core) + 1;
        if (loading && factor::saved_matrix_hash(options.saved_factor) != core->confined_hash) throw;
      }
    }
    if (core->confined_hash != 0)
      confined = lost_components(*core, factor_options(*core, options));
    else
      ++cap;
    unit = make_operator(*core, options, cap, confined);
  }
  report(1.0f);
  if (options.field_kind != mesh::FieldKind::harmonic && core->refinements == 0) return on_root(std::move(core), unit);
  return core;
}

bool is_long_shape(const Core& core) {
  const double commute = core.factor->commute_time(core.mesh.component, core.mean_diagonal);
  return !(commute * 0x1p-52 <= long_share) && !(commute <= long_commute * core.size());
}

std::uint64_t grounded_hash(const Core& core) {
  if (core.root) return grounded_hash(*core.root);
  if (core.confined_hash != 0) return core.confined_hash;
  return factor::hash_matrix(core.matrix(), core.ground, core.mean_diagonal, *core.memory, *core.jobs);
}

SymmetricMatrix grounded(const Core& core) {
  if (core.root) return grounded(*core.root);
  SymmetricMatrix a(*core.memory);
  a.column_start.assign(core.matrix().column_start.begin(), core.matrix().column_start.end());
  a.row.assign(core.matrix().row.begin(), core.matrix().row.end());
  a.value.assign(core.matrix().value.begin(), core.matrix().value.end());
  for (std::size_t c = 0; c < core.ground.size(); ++c) a.value[a.diagonal(core.ground[c])] += core.mean_diagonal[c];
  return a;
}

Vector<double> operator_diagonal(const Core& core) {
  if (core.root) return mesh::biharmonic_diagonal(core.root->matrix(), core.inverse_mass, *core.memory);
  const SymmetricMatrix& k = core.matrix();
  Vector<double> diagonal(at(k.size()), core.memory.get());
  for (Index v = 0; v < k.size(); ++v) diagonal[at(v)] = k.value[k.diagonal(v)];
  return diagonal;
}

void apply_operator(const Core& core, const double* u, Index channels, double* out) {
  const Vector<double> ones(core.memory.get());
  if (!core.root) return mesh::apply_laplacian(core.matrix(), ones, u, channels, out, *core.jobs);
  const SymmetricMatrix& l = core.root->matrix();
  Workspace w(core.workspaces, at(core.size()) * at(channels));
  mesh::apply_laplacian(l, core.inverse_mass, u, channels, w.data(), *core.jobs);
  mesh::apply_laplacian(l, ones, w.data(), channels, out, *core.jobs);
}

Vector<float> ordering_coordinates(const mesh::Mesh& mesh, Memory& memory) {
  Vector<float> coordinates(&memory);
  if (mesh.is_graph()) return coordinates;
  coordinates.reserve(3 * mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    coordinates.push_back(static_cast<float>(p.x));
    coordinates.push_back(static_cast<float>(p.y));
    coordinates.push_back(static_cast<float>(p.z));
  }
  return coordinates;
}

}  // namespace hf_inner::surface
