#include "remesh/intake.h"

#include "base/arguments.h"
#include "mesh/vertex_lists.h"
#include "remesh/constants.h"

namespace hf_inner::remesh {

Vector<std::int32_t> read_seeds(const mesh::Mesh& mesh, const hf_streamlines& lines, Memory& memory) {
  if (lines.seed_count > most_streamlines)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "seed_count is %u; it must be up to %u", lines.seed_count,
         most_streamlines);
  if (lines.seed_count == 0 && (lines.wanted_count < 1 || lines.wanted_count > most_streamlines))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "wanted_count is %u; it must be 1 to %u", lines.wanted_count,
         most_streamlines);
  Vector<std::int32_t> seeds(&memory);
  if (lines.seed_count) {
    require(lines.seeds, "inout_lines->seeds");
    mesh::append_usable(mesh, lines.seed_count, lines.seeds, "seeds", seeds);
  }
  return seeds;
}

}  // namespace hf_inner::remesh
