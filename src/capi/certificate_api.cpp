// hf/field.h: the certificate of a field.
#include <algorithm>
#include <cmath>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "field/certificate.h"
#include "hf/field.h"

namespace hf_inner::capi {
namespace {

// What the engines reach with room to spare; the sites of updown are penalties, which hold to about 1 / penalty.
constexpr double exact_tolerance = 1e-8, penalty_tolerance = 1e-5;

double tolerance_of(const hf_certificate& asked, EngineKind engine) {
  if (asked.tolerance == 0) return engine == EngineKind::updown ? penalty_tolerance : exact_tolerance;
  if (!(asked.tolerance > 0) || !std::isfinite(asked.tolerance))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "tolerance is %g; it must be above 0 and finite, or 0 for the engine's own", asked.tolerance);
  return asked.tolerance;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_certify(hf_solver handle, hf_certificate* inout_certificate) {
  return guarded("hf_certify", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    hf_certificate report = read_struct(inout_certificate, "inout_certificate");
    if (report.reserved != 0) fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "inout_certificate: reserved must be 0");
    const Reading reading(*solver);
    const double tolerance = tolerance_of(report, solver->field.engine().kind());
    const Certificate found = certify(solver->field);
    const bool known = found.vertex != Mesh::none;
    const Mesh& mesh = solver->field.core().mesh;
    report.overshoot_checked = found.overshoot_checked;
    report.tolerance = tolerance;
    report.value_range = found.value_range;
    report.residual = found.residual;
    report.site_error = found.site_error;
    report.overshoot = found.overshoot;
    report.worst_vertex =
        known ? static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(found.vertex)]) : HF_NO_INDEX;
    write_struct(inout_certificate, report);
    const double worst = std::max({found.residual, found.site_error, found.overshoot});
    if (!(worst <= tolerance))
      fail(HF_ERROR_INACCURATE, report.worst_vertex,
           "the field is wrong by %.3g of the range of its values at vertex %u, more than the tolerance %.3g; make a "
           "new solver of the mesh",
           worst, report.worst_vertex, tolerance);
  });
}

}  // extern "C"
