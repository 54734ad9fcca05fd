/* Prints sizes and offsets of the structs of hf_gltf/gltf.h, and its constants (tests/api/check_layout.sh). */
#include <stddef.h>
#include <stdio.h>

#include "hf_gltf/gltf.h"

#define STRUCT(type) printf("%s size %u\n", #type, (unsigned)sizeof(type))
#define FIELD(type, field) \
  printf("  %s at %u, %u bytes\n", #field, (unsigned)offsetof(type, field), (unsigned)sizeof(((type*)0)->field))
#define CONSTANT(name) printf("%s = %lld\n", #name, (long long)name)
#define F(field) FIELD(T, field)

int main(void) {
#define T hf_gltf_read_desc
  STRUCT(hf_gltf_read_desc);
  F(struct_size), F(reserved), F(bytes), F(byte_count), F(file);
#undef T
#define T hf_gltf_mesh_desc
  STRUCT(hf_gltf_mesh_desc);
  F(struct_size), F(vertex_count), F(triangle_count), F(reserved), F(name), F(positions), F(triangles);
#undef T
#define T hf_gltf_model_info
  STRUCT(hf_gltf_model_info);
  F(struct_size), F(vertex_count), F(triangle_count), F(clip_count), F(joint_count), F(note_count), F(has_skin),
      F(reserved);
#undef T
#define T hf_gltf_surface
  STRUCT(hf_gltf_surface);
  F(struct_size), F(reserved), F(positions), F(triangles), F(joints), F(weights);
#undef T
#define T hf_gltf_clip_info
  STRUCT(hf_gltf_clip_info);
  F(struct_size), F(key_count), F(duration), F(name);
#undef T
#define T hf_gltf_frames_desc
  STRUCT(hf_gltf_frames_desc);
  F(struct_size), F(frame_count), F(name), F(times), F(positions), F(firm);
#undef T
#define T hf_gltf_fit_info
  STRUCT(hf_gltf_fit_info);
  F(struct_size), F(joint_count), F(rms), F(max);
#undef T
#define T hf_gltf_skin_desc
  STRUCT(hf_gltf_skin_desc);
  F(struct_size), F(joint_count), F(frame_count), F(weight_count), F(name), F(pivots), F(joints), F(weights), F(times),
      F(rotations), F(translations);
#undef T
#define T hf_gltf_propose_desc
  STRUCT(hf_gltf_propose_desc);
  F(struct_size), F(source_tip_count), F(target_tip_count), F(reserved), F(source_tips), F(target_tips);
#undef T
#define T hf_gltf_pairs_info
  STRUCT(hf_gltf_pairs_info);
  F(struct_size), F(pair_count), F(source_axes), F(target_axes);
#undef T
#define T hf_gltf_pair
  STRUCT(hf_gltf_pair);
  F(struct_size), F(flags), F(source_count), F(target_count), F(source_place), F(target_place), F(source_radius),
      F(target_radius), F(confidence), F(name);
#undef T
  CONSTANT(HF_GLTF_GLB), CONSTANT(HF_GLTF_TEXT);
  return 0;
}
