/* The mesh of a host, which it edits along with the surface, and fresh surfaces of it. */
#pragma once
#include "bad_scene.h"

enum { HOST_ROOM = 4000 };

/* A triangle that went has NO_INDEX. */
typedef struct HostMesh {
  uint32_t vertex_count, triangle_count;
  double positions[3 * HOST_ROOM];
  uint32_t triangles[3 * HOST_ROOM];
} HostMesh;

static inline void host_take(HostMesh* host, Surface mesh) {
  memset(host, 0, sizeof *host);
  host->vertex_count = mesh.vertex_count;
  host->triangle_count = mesh.triangle_count;
  for (uint32_t i = 0; i < 3 * mesh.vertex_count; ++i) host->positions[i] = mesh.positions[i];
  memcpy(host->triangles, mesh.triangles, 12 * (size_t)mesh.triangle_count);
  surface_free(&mesh);
}
static inline hf_surface host_fresh(const HostMesh* host, int32_t operator_kind) {
  static uint32_t triangles[3 * HOST_ROOM];
  uint32_t count = 0;
  for (uint32_t t = 0; t < host->triangle_count; ++t) {
    if (host->triangles[3 * t] == NO_INDEX) continue;
    memcpy(&triangles[3 * count++], &host->triangles[3 * t], 3 * sizeof *triangles);
  }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(host->positions, host->vertex_count);
  desc.triangles = HF_ARRAY(triangles, count);
  desc.weld = HF_WELD_NONE;
  desc.operator_kind = operator_kind;
  hf_surface out = NULL;
  assert_ok(hf_surface_create(&desc, &out));
  return out;
}
/* Returns the patched surface. host: gets the same patch, or NULL. */
static inline hf_surface host_patch(HostMesh* host, hf_surface surface, const hf_patch_desc* patch) {
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  desc.patch = patch;
  hf_surface out = NULL;
  assert_ok(hf_surface_edit(surface, &desc, &out));
  if (!host) return out;
  for (uint32_t i = 0; i < patch->removed_triangle_count; ++i)
    for (uint32_t k = 0; k < 3; ++k) host->triangles[3 * patch->removed_triangles[i] + k] = NO_INDEX;
  if (patch->new_vertex_count > 0)
    memcpy(&host->positions[3 * host->vertex_count], patch->new_positions, 24 * (size_t)patch->new_vertex_count);
  if (patch->new_triangle_count > 0)
    memcpy(&host->triangles[3 * host->triangle_count], patch->new_triangles, 12 * (size_t)patch->new_triangle_count);
  host->vertex_count += patch->new_vertex_count;
  host->triangle_count += patch->new_triangle_count;
  return out;
}
