// Reads the options of a surface: checks them, fills in defaults, compares counts with limits.
#pragma once
#include "hf/surface.h"
#include "surface/edited_core.h"
#include "surface/surface.h"

namespace hf_inner::surface {

// Returns the options of a graph as options of a surface.
hf_surface_desc options_of(const hf_graph_desc& desc);

// Returns the kind of field of any desc. Throws HF_ERROR_INVALID_ARGUMENT.
mesh::FieldKind read_field_kind(std::int32_t given);

// Returns the options with the defaults filled in. Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_INVALID_DESC,
// HF_ERROR_NULL_POINTER (half an allocator), HF_ERROR_UNSUPPORTED (an ordering that is not in this build).
hf_surface_info read_info(const hf_surface_desc& desc);

// Throw HF_ERROR_TOO_LARGE if there are more vertices, triangles or edges than the limits of the info allow.
void check_mesh_limits(const hf_surface_info& info);
void check_graph_limits(const hf_surface_info& info);

// Returns the options of the core that the info describes.
CoreOptions core_options(const hf_surface_info& info);

// Returns the options of a surface that has the operator, limits and ordering of another. The other one must outlive
// the making of the core.
CoreOptions options_like(const Surface& other);

// Makes the core load a saved factor. ordering: from the caller, 0 for the ordering of the factor. Throws
// HF_ERROR_INVALID_ARGUMENT (another ordering, damaged bytes), HF_ERROR_EMPTY, HF_ERROR_NULL_POINTER.
void read_saved_factor(const hf_factor_desc& saved, std::int32_t ordering, CoreOptions& options);

// Reads what a surface has after an edit. patch: of the desc, or null. info: the limits of the surface. Throws as
// hf_surface_edit documents.
SurfaceEdit read_surface_edit(const hf_surface_edit_desc& desc, const hf_patch_desc* patch, const Surface& before,
                              const hf_surface_info& info);

}  // namespace hf_inner::surface
