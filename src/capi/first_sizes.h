// How long structs were when they first appeared. A caller built against an older header passes a smaller struct_size:
// what it lacks is read as zero and never written. Structs that have not grown are not named here.
#pragma once
#include <cstddef>

#include "hf/hf.h"

namespace hf_inner::capi {

template <class T>
inline constexpr std::size_t first_size = sizeof(T);

template <>
inline constexpr std::size_t first_size<hf_create_desc> = offsetof(hf_create_desc, saved_factor);
template <>
inline constexpr std::size_t first_size<hf_sites_desc> = offsetof(hf_sites_desc, radii);
template <>
inline constexpr std::size_t first_size<hf_site_info> = offsetof(hf_site_info, radii);
template <>
inline constexpr std::size_t first_size<hf_statistics> = offsetof(hf_statistics, load_ms);
template <>
inline constexpr std::size_t first_size<hf_handles_desc> = offsetof(hf_handles_desc, points);
template <>
inline constexpr std::size_t first_size<hf_handle_info> = offsetof(hf_handle_info, rotation);
template <>
inline constexpr std::size_t first_size<hf_deform_desc> = offsetof(hf_deform_desc, first_vertex);
template <>
inline constexpr std::size_t first_size<hf_deform_info> = offsetof(hf_deform_info, refine_ms);
template <>
inline constexpr std::size_t first_size<hf_transfer_frame> = offsetof(hf_transfer_frame, hold_count);
template <>
inline constexpr std::size_t first_size<hf_skin_info> = offsetof(hf_skin_info, axes);

}  // namespace hf_inner::capi
