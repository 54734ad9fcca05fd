#include "retarget/retargeter.h"

namespace hf_inner {

void Retargeter::clear_ground() {}

}  // namespace hf_inner
