// How much work and memory a program's surfaces may take: by the size of the mesh, or as the command line says.
//
// hf_surface_create counts the operations and bytes of a factor before it makes it. A file from a stranger can join far
// vertices at random: 1 MB of such triangles costs half a minute and 1.7 GB. The limits refuse it in a second.
#ifndef HF_SAMPLES_COMMON_LIMITS_H
#define HF_SAMPLES_COMMON_LIMITS_H

#include <functional>
#include <string>

#include "hf/surface.h"

namespace samples {

// Takes --work-limit or --memory-limit, if that is the option; value() gives the word behind it. The limit holds for
// every surface that the program makes. Throws std::runtime_error naming the option.
bool take_limit(const std::string& option, const std::function<std::string()>& value);

// Sets the limits of a surface whose sizes are in the desc. made: vertices of what is made of it, which need work and
// memory too.
void limit_surface(hf_surface_desc& desc, uint32_t made = 0);

// The same for a surface that quads are made of. Each handle brings singularities whose whole numbers share a full
// matrix, so its size is the square of the genus.
void limit_quads(hf_surface_desc& desc, uint32_t faces);

// The library's message with the option that raises the limit it names; other messages as they are.
std::string with_limit_option(const std::string& message);

}  // namespace samples

#endif
