// The biped in rigs as other tools make them: other names, another rest, other proportions, no clips. They show what a
// transfer between unlike skeletons does.
#ifndef HF_SAMPLES_ASSETS_CREATURE_RIG_H
#define HF_SAMPLES_ASSETS_CREATURE_RIG_H

#include <string>
#include <vector>

#include "creature.h"

namespace samples {

// "biped_tall" (names as Mixamo's, arms level at rest, long legs) and "biped_small" (names with .L and .R, arms that
// hang, short legs, a large head).
std::vector<std::string> rigged_names();

// The biped with so many vertices in that rig. Throws std::runtime_error for an unknown name.
Creature make_rigged(const std::string& name, uint32_t vertices);

}  // namespace samples

#endif
