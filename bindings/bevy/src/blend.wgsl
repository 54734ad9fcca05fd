// The vertex shader of a mesh of Bevy 0.19 whose pose the GPU blends: its main pass, its prepasses and its shadows.
#import bevy_pbr::{mesh_bindings::mesh, mesh_functions, view_transformations::position_world_to_clip}
#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::{Vertex, VertexOutput}
#else
#import bevy_pbr::forward_io::{Vertex, VertexOutput}
#endif
#import hf::blend::{HfVertex, hf_blend, hf_blend_position, hf_frame, hf_rows, hf_unit}

// A mesh of the surface; matrices of three rows.
struct Part {
  to_rest_x: vec4f,  // from the space of the mesh to rest positions, which are relative to the centre
  to_rest_y: vec4f,
  to_rest_z: vec4f,
  to_mesh_x: vec4f,  // and back
  to_mesh_y: vec4f,
  to_mesh_z: vec4f,
  first_vertex: u32,  // in the surface
}

@group(#{MATERIAL_BIND_GROUP}) @binding(105) var<storage, read> offsets: array<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(107) var<uniform> part: Part;

fn to_rest(p: vec4f) -> vec3f {
  return vec3f(dot(part.to_rest_x, p), dot(part.to_rest_y, p), dot(part.to_rest_z, p));
}
fn to_mesh(p: vec4f) -> vec3f {
  return vec3f(dot(part.to_mesh_x, p), dot(part.to_mesh_y, p), dot(part.to_mesh_z, p));
}
// Normals turn by the inverse transpose of what moves points.
fn normal_to_rest(n: vec3f) -> vec3f {
  return hf_unit(part.to_mesh_x.xyz * n.x + part.to_mesh_y.xyz * n.y + part.to_mesh_z.xyz * n.z);
}
fn normal_to_mesh(n: vec3f) -> vec3f {
  return hf_unit(part.to_rest_x.xyz * n.x + part.to_rest_y.xyz * n.y + part.to_rest_z.xyz * n.z);
}
fn offset(v: u32) -> vec3f {
  return vec3f(offsets[3u * v], offsets[3u * v + 1u], offsets[3u * v + 2u]);
}

@vertex
fn vertex(vertex: Vertex, @builtin(vertex_index) index: u32) -> VertexOutput {
  let instance = vertex.instance_index;
  let world_from_local = mesh_functions::get_world_from_local(instance);
  let v = part.first_vertex + index - mesh[instance].first_vertex_index;
  // without clusters the mesh is shown as it is
  let blended = hf_frame.cluster_count > 0u;
  var rest: HfVertex;
  var posed: HfVertex;
  var row = vec2u(0u, 0u);
  posed.position = vertex.position;
  rest.position = to_rest(vec4f(vertex.position, 1.0));
#ifdef VERTEX_NORMALS
  posed.normal = vertex.normal;
  rest.normal = normal_to_rest(vertex.normal);
#endif
#ifdef VERTEX_TANGENTS
  posed.tangent = vertex.tangent.xyz;
  rest.tangent = hf_unit(to_rest(vec4f(vertex.tangent.xyz, 0.0)));
#endif
  if (blended) {
    row = hf_rows[v];
    posed = hf_blend(row, hf_frame.current, rest);
    posed.position = to_mesh(vec4f(posed.position + hf_frame.offset_share * offset(v), 1.0));
    posed.normal = normal_to_mesh(posed.normal);
    posed.tangent = hf_unit(to_mesh(vec4f(posed.tangent, 0.0)));
  }

  var out: VertexOutput;
  out.world_position = mesh_functions::mesh_position_local_to_world(world_from_local, vec4f(posed.position, 1.0));
  out.position = position_world_to_clip(out.world_position.xyz);
#ifdef VERTEX_NORMALS
  out.world_normal = mesh_functions::mesh_normal_local_to_world(posed.normal, instance);
#endif
#ifdef VERTEX_TANGENTS
  let tangent = vec4f(posed.tangent, vertex.tangent.w);
  out.world_tangent = mesh_functions::mesh_tangent_local_to_world(world_from_local, tangent, instance);
#endif
#ifdef VERTEX_UVS_A
  out.uv = vertex.uv;
#endif
#ifdef VERTEX_UVS_B
  out.uv_b = vertex.uv_b;
#endif
#ifdef VERTEX_COLORS
  out.color = vertex.color;
#endif
#ifdef VERTEX_OUTPUT_INSTANCE_INDEX
  out.instance_index = instance;
#endif
#ifdef VISIBILITY_RANGE_DITHER
  out.visibility_range_dither = mesh_functions::get_visibility_range_dither_level(instance, world_from_local[3]);
#endif
#ifdef PREPASS_PIPELINE
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
  out.unclipped_depth = out.position.z;
  out.position.z = min(out.position.z, 1.0);  // depth that is clamped is not clipped
#endif
#ifdef MOTION_VECTOR_PREPASS
  var before = vertex.position;
  if (blended) {
    let p = hf_blend_position(row, hf_frame.previous, rest.position) + hf_frame.previous_share * offset(v);
    before = to_mesh(vec4f(p, 1.0));
  }
  let previous_world_from_local = mesh_functions::get_previous_world_from_local(instance);
  out.previous_world_position = mesh_functions::mesh_position_local_to_world(previous_world_from_local, vec4f(before, 1.0));
#endif
#endif
  return out;
}
