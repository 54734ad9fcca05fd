// Computes the vertices of a pose of hf: positions, normals, tangents, and positions of the frame before.
// This file is the source of hf_blend.hlsl, hf_blend_buffers.glsl and hf_blend_textures.glsl; make_shaders.py writes them.
//
// V vertices, E entries, C clusters, N characters that share the rows. All floats are 32 bits.
//
// binding     content                                                                              floats or words
// 0 uniform   HfFrame                                                                              8 words
// 1 storage   rows of hf_pose_get_blend_rows: first entry of a vertex, count of its entries        2 V
// 2 storage   its clusters, two 16-bit numbers in a word; the last word is full                    (E + 1) / 2
// 3 storage   its weights                                                                          E
// 4 storage   its gradients                                                                        3 E
// 5 storage   its positions, then normals, then tangents of the host, then offsets, each 3 V       12 V
// 6 storage   transforms of hf_pose_get_blend_transforms, of two frames, character by character    24 C N
// 7 storage   receives for each character: positions, normals, tangents, positions before          12 V N
//
// All positions are relative to the `centre` of hf_pose_get_blend_info: add it to the matrix of the model.
// The largest error of a position is about 1e-7 of the box of the mesh.

struct HfFrame {
  vertex_count: u32,
  cluster_count: u32,
  current: u32,         // number of the first transform of this frame: 0 or C N
  previous: u32,        // and of the frame before; with `current` here the positions before are those of this frame
  offset_share: f32,    // of hf_pose_get_blend_info in this frame
  previous_share: f32,  // and in the frame before
}
struct HfTransform {  // the rows of a 3 x 4 matrix
  x: vec4f,
  y: vec4f,
  z: vec4f,
}

@group(0) @binding(0) var<uniform> hf_frame: HfFrame;
@group(0) @binding(1) var<storage, read> hf_rows: array<vec2u>;
@group(0) @binding(2) var<storage, read> hf_clusters: array<u32>;
@group(0) @binding(3) var<storage, read> hf_weights: array<f32>;
@group(0) @binding(4) var<storage, read> hf_gradients: array<f32>;
@group(0) @binding(5) var<storage, read> hf_rest: array<f32>;
@group(0) @binding(6) var<storage, read> hf_transforms: array<vec4f>;
@group(0) @binding(7) var<storage, read_write> hf_posed: array<f32>;

// ---- arrays ----
fn hf_cluster(e: u32) -> u32 {
  return (hf_clusters[e / 2u] >> (16u * (e % 2u))) & 65535u;
}
fn hf_weight(e: u32) -> f32 {
  return hf_weights[e];
}
fn hf_entry(e: u32) -> vec4f {  // gradient and weight
  return vec4f(hf_gradients[3u * e], hf_gradients[3u * e + 1u], hf_gradients[3u * e + 2u], hf_weights[e]);
}
fn hf_transform(t: u32) -> HfTransform {
  var m: HfTransform;
  m.x = hf_transforms[3u * t];
  m.y = hf_transforms[3u * t + 1u];
  m.z = hf_transforms[3u * t + 2u];
  return m;
}

// ---- blend ----
struct HfVertex {
  position: vec3f,
  normal: vec3f,
  tangent: vec3f,
}

// Returns v with length 1. A vector of length 0 stays 0.
fn hf_unit(v: vec3f) -> vec3f {
  return v * inverseSqrt(max(dot(v, v), 1e-30));
}

fn hf_move(m: HfTransform, p: vec4f) -> vec3f {
  return vec3f(dot(m.x, p), dot(m.y, p), dot(m.z, p));
}

// Returns where a vertex goes, for shadows and the frame before. row: its first entry, count of its entries. first: number
// of the first transform of the character. p: its rest position. Add offset_share times the offset.
fn hf_blend_position(row: vec2u, first: u32, p: vec3f) -> vec3f {
  var sum: vec3f = vec3f(0.0, 0.0, 0.0);
  for (var e: u32 = row.x; e < row.x + row.y; e++) {
    sum += hf_weight(e) * hf_move(hf_transform(first + hf_cluster(e)), vec4f(p, 1.0));
  }
  return sum;
}

// Returns the posed vertex. jx, jy and jz are the rows of J, the derivative of the pose along the rest surface. A tangent u
// goes to J u. The normal goes to the cofactors of J times the normal, which is J u x J v where u x v is the normal.
fn hf_blend(row: vec2u, first: u32, rest: HfVertex) -> HfVertex {
  var posed: HfVertex;
  var sum: vec3f = vec3f(0.0, 0.0, 0.0);
  var jx: vec3f = vec3f(0.0, 0.0, 0.0);
  var jy: vec3f = vec3f(0.0, 0.0, 0.0);
  var jz: vec3f = vec3f(0.0, 0.0, 0.0);
  for (var e: u32 = row.x; e < row.x + row.y; e++) {
    let entry: vec4f = hf_entry(e);
    let m: HfTransform = hf_transform(first + hf_cluster(e));
    let moved: vec3f = hf_move(m, vec4f(rest.position, 1.0));
    sum += entry.w * moved;
    jx += entry.w * m.x.xyz + moved.x * entry.xyz;
    jy += entry.w * m.y.xyz + moved.y * entry.xyz;
    jz += entry.w * m.z.xyz + moved.z * entry.xyz;
  }
  posed.position = sum;
  let n: vec3f = rest.normal;
  posed.normal = hf_unit(vec3f(dot(cross(jy, jz), n), dot(cross(jz, jx), n), dot(cross(jx, jy), n)));
  posed.tangent = hf_unit(vec3f(dot(jx, rest.tangent), dot(jy, rest.tangent), dot(jz, rest.tangent)));
  return posed;
}

// ---- compute ----
fn hf_rest_vector(i: u32) -> vec3f {
  return vec3f(hf_rest[3u * i], hf_rest[3u * i + 1u], hf_rest[3u * i + 2u]);
}
fn hf_write(i: u32, v: vec3f) {
  hf_posed[3u * i] = v.x;
  hf_posed[3u * i + 1u] = v.y;
  hf_posed[3u * i + 2u] = v.z;
}

// Writes vertex v of a character. The number of threads is at least V x N.
fn hf_compute(v: u32, character: u32) {
  let n: u32 = hf_frame.vertex_count;
  if (v >= n) {
    return;
  }
  var rest: HfVertex;
  rest.position = hf_rest_vector(v);
  rest.normal = hf_rest_vector(n + v);
  rest.tangent = hf_rest_vector(2u * n + v);
  let offset: vec3f = hf_rest_vector(3u * n + v);
  let row: vec2u = hf_rows[v];
  let first: u32 = character * hf_frame.cluster_count;
  let posed: HfVertex = hf_blend(row, hf_frame.current + first, rest);
  let before: vec3f = hf_blend_position(row, hf_frame.previous + first, rest.position);
  let place: u32 = 4u * n * character + v;
  hf_write(place, posed.position + hf_frame.offset_share * offset);
  hf_write(place + n, posed.normal);
  hf_write(place + 2u * n, posed.tangent);
  hf_write(place + 3u * n, before + hf_frame.previous_share * offset);
}

// ---- entry: dispatch (V + 63) / 64 x N groups. Cut off what follows if a vertex shader of yours calls hf_blend ----
@compute @workgroup_size(64) fn hf_main(@builtin(global_invocation_id) id: vec3u) {
  hf_compute(id.x, id.y);
}
