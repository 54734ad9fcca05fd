// Computes the vertices of a pose of hf: positions, normals, tangents, and positions of the frame before.
// make_shaders.py wrote this file from hf_blend.wgsl. Define HF_NO_ENTRY if a shader of yours calls hf_blend.
// GLSL 3.30 and GLSL ES 3.00 (WebGL 2). Write the line #version above it, and in ES `precision highp float;`.
//
// V vertices, E entries, C clusters, N characters that share the rows. All floats are 32 bits. Textures have no mipmaps and
// the filter NEAREST. A texture holds a list row by row: texel i is at (i % width, i / width).
//
// texture        content                                                                       format    texels
// hf_clusters    clusters of hf_pose_get_blend_rows                                            R16UI     E
// hf_entries     its gradients (x, y, z) and weights (w)                                       RGBA32F   E
// hf_transforms  rows of the transforms of hf_pose_get_blend_transforms, of two frames,        RGBA32F   6 C N
//                character by character; without motion vectors one frame will do
//
// The width of hf_transforms is a multiple of 3. With a width of 3 C, every character has a row of its own.
//
// All positions are relative to the `centre` of hf_pose_get_blend_info: add it to the matrix of the model.
// The largest error of a position is about 1e-7 of the box of the mesh.

uniform highp usampler2D hf_clusters;
uniform highp sampler2D hf_entries;
uniform highp sampler2D hf_transforms;

struct HfTransform {  // the rows of a 3 x 4 matrix
  vec4 x;
  vec4 y;
  vec4 z;
};

// ---- arrays ----
ivec2 hf_texel(uint i, int width) {
  return ivec2(int(i) % width, int(i) / width);
}
uint hf_cluster(uint e) {
  return texelFetch(hf_clusters, hf_texel(e, textureSize(hf_clusters, 0).x), 0).x;
}
vec4 hf_entry(uint e) {  // gradient and weight
  return texelFetch(hf_entries, hf_texel(e, textureSize(hf_entries, 0).x), 0);
}
float hf_weight(uint e) {
  return hf_entry(e).w;
}
HfTransform hf_transform(uint t) {
  ivec2 at = hf_texel(3u * t, textureSize(hf_transforms, 0).x);
  HfTransform m;
  m.x = texelFetch(hf_transforms, at, 0);
  m.y = texelFetch(hf_transforms, at + ivec2(1, 0), 0);
  m.z = texelFetch(hf_transforms, at + ivec2(2, 0), 0);
  return m;
}

// ---- blend ----
struct HfVertex {
  vec3 position;
  vec3 normal;
  vec3 tangent;
};

// Returns v with length 1. A vector of length 0 stays 0.
vec3 hf_unit(vec3 v) {
  return v * inversesqrt(max(dot(v, v), 1e-30));
}

vec3 hf_move(HfTransform m, vec4 p) {
  return vec3(dot(m.x, p), dot(m.y, p), dot(m.z, p));
}

// Returns where a vertex goes, for shadows and the frame before. row: its first entry, count of its entries. first: number
// of the first transform of the character. p: its rest position. Add offset_share times the offset.
vec3 hf_blend_position(uvec2 row, uint first, vec3 p) {
  vec3 sum = vec3(0.0, 0.0, 0.0);
  for (uint e = row.x; e < row.x + row.y; e++) {
    sum += hf_weight(e) * hf_move(hf_transform(first + hf_cluster(e)), vec4(p, 1.0));
  }
  return sum;
}

// Returns the posed vertex. jx, jy and jz are the rows of J, the derivative of the pose along the rest surface. A tangent u
// goes to J u. The normal goes to the cofactors of J times the normal, which is J u x J v where u x v is the normal.
HfVertex hf_blend(uvec2 row, uint first, HfVertex rest) {
  HfVertex posed;
  vec3 sum = vec3(0.0, 0.0, 0.0);
  vec3 jx = vec3(0.0, 0.0, 0.0);
  vec3 jy = vec3(0.0, 0.0, 0.0);
  vec3 jz = vec3(0.0, 0.0, 0.0);
  for (uint e = row.x; e < row.x + row.y; e++) {
    vec4 entry = hf_entry(e);
    HfTransform m = hf_transform(first + hf_cluster(e));
    vec3 moved = hf_move(m, vec4(rest.position, 1.0));
    sum += entry.w * moved;
    jx += entry.w * m.x.xyz + moved.x * entry.xyz;
    jy += entry.w * m.y.xyz + moved.y * entry.xyz;
    jz += entry.w * m.z.xyz + moved.z * entry.xyz;
  }
  posed.position = sum;
  vec3 n = rest.normal;
  posed.normal = hf_unit(vec3(dot(cross(jy, jz), n), dot(cross(jz, jx), n), dot(cross(jx, jy), n)));
  posed.tangent = hf_unit(vec3(dot(jx, rest.tangent), dot(jy, rest.tangent), dot(jz, rest.tangent)));
  return posed;
}

#ifndef HF_NO_ENTRY
// ---- entry: draw N instances ----
in vec3 hf_position;  // of hf_pose_get_blend_rows, as are normal, offset and row; an attribute that is off is 0
in vec3 hf_normal;
in vec4 hf_tangent;  // of the host; w passes through
in vec3 hf_offset;
in uvec2 hf_row;  // an integer attribute

uniform uint hf_cluster_count;
uniform uint hf_current;        // number of the first transform of this frame: 0 or C N
uniform uint hf_previous;       // and of the frame before; without motion vectors the same as hf_current
uniform float hf_offset_share;  // of hf_pose_get_blend_info in this frame
uniform float hf_previous_share;
uniform mat4 hf_clip;  // from positions relative to centre to the clip space

out vec3 hf_posed_position;
out vec3 hf_posed_normal;
out vec4 hf_posed_tangent;
out vec3 hf_posed_before;  // position in the frame before

void main() {
  HfVertex rest;
  rest.position = hf_position;
  rest.normal = hf_normal;
  rest.tangent = hf_tangent.xyz;
  uint first = uint(gl_InstanceID) * hf_cluster_count;
  HfVertex posed = hf_blend(hf_row, hf_current + first, rest);
  hf_posed_position = posed.position + hf_offset_share * hf_offset;
  hf_posed_normal = posed.normal;
  hf_posed_tangent = vec4(posed.tangent, hf_tangent.w);
  hf_posed_before = hf_blend_position(hf_row, hf_previous + first, hf_position) + hf_previous_share * hf_offset;
  gl_Position = hf_clip * vec4(hf_posed_position, 1.0);
}
#endif
