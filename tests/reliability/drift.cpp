// Whether the field drifts away from the exact one as sites come, go and move. The test makes 30,000 random edits of
// about 50 sites on 41,000 vertices; a tenth of the sites are soft. One channel has values in [0, 1], the other in
// [10,000, 10,001]. At every checkpoint a new solver eliminates the same sites (ENGINE_REFACTOR), and the two fields
// are compared. The quick form makes 2,000 edits.
#include <algorithm>

#include "report.h"
#include "surfaces.h"

using namespace reliability;

int main(int argc, char** argv) {
  const int edits = report_full(argc, argv) ? 30000 : 2000, checkpoints = 5;
  Mesh mesh;
  add_torus(mesh, 205, 200);
  const std::vector<double> offsets = {0, 1e4};
  EditedSolver solver(mesh, 2, 17);
  solver.add(50, offsets);
  double worst[2] = {0, 0};
  for (int done = 1; done <= edits; ++done) {
    solver.edit(50, offsets);
    if (done % (edits / checkpoints) != 0) continue;
    const std::vector<double> got = solver.field(), exact = solver.fresh_field(ENGINE_REFACTOR);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const double error = std::fabs(got[i] - exact[i]);
      worst[i % 2] = error >= 0 ? std::max(worst[i % 2], error) : HUGE_VAL;
    }
  }
  report_at_least("DRIFT_EDITS", edits, 2000);
  report_at_most("DRIFT_OFFSET_0", worst[0], 1e-10);
  report_at_most("DRIFT_OFFSET_10000", worst[1], 1e-10);
  return report_status();
}
