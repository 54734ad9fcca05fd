// Computes the vertices of a pose of hf: positions, normals, tangents, and positions of the frame before.
// make_shaders.py wrote this file from hf_blend.wgsl. Define HF_NO_ENTRY if a shader of yours calls hf_blend.
//
// V vertices, E entries, C clusters, N characters that share the rows. All floats are 32 bits.
//
// register    content                                                                              floats or words
// b0          HfFrame                                                                              8 words
// t1          rows of hf_pose_get_blend_rows: first entry of a vertex, count of its entries        2 V
// t2          its clusters, two 16-bit numbers in a word; the last word is full                    (E + 1) / 2
// t3          its weights                                                                          E
// t4          its gradients                                                                        3 E
// t5          its positions, then normals, then tangents of the host, then offsets, each 3 V       12 V
// t6          transforms of hf_pose_get_blend_transforms, of two frames, character by character    24 C N
// u7          receives for each character: positions, normals, tangents, positions before          12 V N
//
// All positions are relative to the `centre` of hf_pose_get_blend_info: add it to the matrix of the model.
// The largest error of a position is about 1e-7 of the box of the mesh.

struct HfFrame {
  uint vertex_count;
  uint cluster_count;
  uint current;         // number of the first transform of this frame: 0 or C N
  uint previous;        // and of the frame before; with `current` here the positions before are those of this frame
  float offset_share;    // of hf_pose_get_blend_info in this frame
  float previous_share;  // and in the frame before
};
struct HfTransform {  // the rows of a 3 x 4 matrix
  float4 x;
  float4 y;
  float4 z;
};

cbuffer HfFrameBuffer : register(b0) {
  HfFrame hf_frame;
};
StructuredBuffer<uint2> hf_rows : register(t1);
StructuredBuffer<uint> hf_clusters : register(t2);
StructuredBuffer<float> hf_weights : register(t3);
StructuredBuffer<float> hf_gradients : register(t4);
StructuredBuffer<float4> hf_transforms : register(t6);
#ifndef HF_NO_ENTRY
StructuredBuffer<float> hf_rest : register(t5);
RWStructuredBuffer<float> hf_posed : register(u7);
#endif

// ---- arrays ----
uint hf_cluster(uint e) {
  return (hf_clusters[e / 2u] >> (16u * (e % 2u))) & 65535u;
}
float hf_weight(uint e) {
  return hf_weights[e];
}
float4 hf_entry(uint e) {  // gradient and weight
  return float4(hf_gradients[3u * e], hf_gradients[3u * e + 1u], hf_gradients[3u * e + 2u], hf_weights[e]);
}
HfTransform hf_transform(uint t) {
  HfTransform m;
  m.x = hf_transforms[3u * t];
  m.y = hf_transforms[3u * t + 1u];
  m.z = hf_transforms[3u * t + 2u];
  return m;
}

// ---- blend ----
struct HfVertex {
  float3 position;
  float3 normal;
  float3 tangent;
};

// Returns v with length 1. A vector of length 0 stays 0.
float3 hf_unit(float3 v) {
  return v * rsqrt(max(dot(v, v), 1e-30));
}

float3 hf_move(HfTransform m, float4 p) {
  return float3(dot(m.x, p), dot(m.y, p), dot(m.z, p));
}

// Returns where a vertex goes, for shadows and the frame before. row: its first entry, count of its entries. first: number
// of the first transform of the character. p: its rest position. Add offset_share times the offset.
float3 hf_blend_position(uint2 row, uint first, float3 p) {
  float3 sum = float3(0.0, 0.0, 0.0);
  for (uint e = row.x; e < row.x + row.y; e++) {
    sum += hf_weight(e) * hf_move(hf_transform(first + hf_cluster(e)), float4(p, 1.0));
  }
  return sum;
}

// Returns the posed vertex. jx, jy and jz are the rows of J, the derivative of the pose along the rest surface. A tangent u
// goes to J u. The normal goes to the cofactors of J times the normal, which is J u x J v where u x v is the normal.
HfVertex hf_blend(uint2 row, uint first, HfVertex rest) {
  HfVertex posed;
  float3 sum = float3(0.0, 0.0, 0.0);
  float3 jx = float3(0.0, 0.0, 0.0);
  float3 jy = float3(0.0, 0.0, 0.0);
  float3 jz = float3(0.0, 0.0, 0.0);
  for (uint e = row.x; e < row.x + row.y; e++) {
    float4 entry = hf_entry(e);
    HfTransform m = hf_transform(first + hf_cluster(e));
    float3 moved = hf_move(m, float4(rest.position, 1.0));
    sum += entry.w * moved;
    jx += entry.w * m.x.xyz + moved.x * entry.xyz;
    jy += entry.w * m.y.xyz + moved.y * entry.xyz;
    jz += entry.w * m.z.xyz + moved.z * entry.xyz;
  }
  posed.position = sum;
  float3 n = rest.normal;
  posed.normal = hf_unit(float3(dot(cross(jy, jz), n), dot(cross(jz, jx), n), dot(cross(jx, jy), n)));
  posed.tangent = hf_unit(float3(dot(jx, rest.tangent), dot(jy, rest.tangent), dot(jz, rest.tangent)));
  return posed;
}

#ifndef HF_NO_ENTRY
// ---- compute ----
float3 hf_rest_vector(uint i) {
  return float3(hf_rest[3u * i], hf_rest[3u * i + 1u], hf_rest[3u * i + 2u]);
}
void hf_write(uint i, float3 v) {
  hf_posed[3u * i] = v.x;
  hf_posed[3u * i + 1u] = v.y;
  hf_posed[3u * i + 2u] = v.z;
}

// Writes vertex v of a character. The number of threads is at least V x N.
void hf_compute(uint v, uint character) {
  uint n = hf_frame.vertex_count;
  if (v >= n) {
    return;
  }
  HfVertex rest;
  rest.position = hf_rest_vector(v);
  rest.normal = hf_rest_vector(n + v);
  rest.tangent = hf_rest_vector(2u * n + v);
  float3 offset = hf_rest_vector(3u * n + v);
  uint2 row = hf_rows[v];
  uint first = character * hf_frame.cluster_count;
  HfVertex posed = hf_blend(row, hf_frame.current + first, rest);
  float3 before = hf_blend_position(row, hf_frame.previous + first, rest.position);
  uint place = 4u * n * character + v;
  hf_write(place, posed.position + hf_frame.offset_share * offset);
  hf_write(place + n, posed.normal);
  hf_write(place + 2u * n, posed.tangent);
  hf_write(place + 3u * n, before + hf_frame.previous_share * offset);
}

// ---- entry: dispatch (V + 63) / 64 x N groups ----
[numthreads(64, 1, 1)] void hf_main(uint3 id : SV_DispatchThreadID) {
  hf_compute(id.x, id.y);
}
#endif
