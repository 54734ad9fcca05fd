#!/usr/bin/env python3
"""Writes the shaders in HLSL and GLSL from hf_blend.wgsl. With --check it writes nothing and fails if a file is out of date.

The source keeps to a subset of WGSL: every name has its type, and no matrix, pointer or switch occurs. One expression
per rule makes the other languages of it. Bindings and entries stand here, because each language has its own."""

import re
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

TYPES = {
    "hlsl": {"vec2u": "uint2", "vec3u": "uint3", "vec3f": "float3", "vec4f": "float4"},
    "glsl": {"vec2u": "uvec2", "vec3u": "uvec3", "vec3f": "vec3", "vec4f": "vec4"},
}
for names in TYPES.values():
    names.update({"u32": "uint", "f32": "float"})
INVERSE_ROOT = {"hlsl": "rsqrt", "glsl": "inversesqrt"}

WHAT = """// Computes the vertices of a pose of hf: positions, normals, tangents, and positions of the frame before.
// make_shaders.py wrote this file from hf_blend.wgsl. Define HF_NO_ENTRY if a shader of yours calls hf_blend.
"""

HLSL_BINDINGS = """cbuffer HfFrameBuffer : register(b0) {
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

"""

HLSL_ENTRY = """[numthreads(64, 1, 1)] void hf_main(uint3 id : SV_DispatchThreadID) {
  hf_compute(id.x, id.y);
}
"""

GLSL_BINDINGS = """layout(std140, binding = 0) uniform HfFrameBlock {
  HfFrame hf_frame;
};
layout(std430, binding = 1) readonly buffer HfRows { uvec2 hf_rows[]; };
layout(std430, binding = 2) readonly buffer HfClusters { uint hf_clusters[]; };
layout(std430, binding = 3) readonly buffer HfWeights { float hf_weights[]; };
layout(std430, binding = 4) readonly buffer HfGradients { float hf_gradients[]; };
layout(std430, binding = 6) readonly buffer HfTransforms { vec4 hf_transforms[]; };
#ifndef HF_NO_ENTRY
layout(std430, binding = 5) readonly buffer HfRest { float hf_rest[]; };
layout(std430, binding = 7) buffer HfPosed { float hf_posed[]; };
#endif

"""

GLSL_ENTRY = """layout(local_size_x = 64) in;
void main() {
  hf_compute(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y);
}
"""

TEXTURES = """// GLSL 3.30 and GLSL ES 3.00 (WebGL 2). Write the line #version above it, and in ES `precision highp float;`.
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

"""

TEXTURES_ARRAYS = """// ---- arrays ----
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

"""

TEXTURES_ENTRY = """in vec3 hf_position;  // of hf_pose_get_blend_rows, as are normal, offset and row; an attribute that is off is 0
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
"""


GODOT = """// For a shader of Godot 4, type spatial. Include it below shader_type.
//
// E entries, C clusters. hf_clusters: blend_clusters() of HfSurface, FORMAT_RF. hf_entries: blend_entries(), FORMAT_RGBAF.
// hf_transforms: blend_transforms() after pose_solve() in every frame, FORMAT_RGBAF, of any width that is a multiple of 3.
// A texture holds a list row by row: texel i is at (i % width, i / width). The mesh has blend_positions(), blend_normals(),
// blend_rows() as ARRAY_CUSTOM0 of two floats and blend_offsets() as ARRAY_CUSTOM1. hf_blended.gd of the add-on does all of it.
uniform sampler2D hf_clusters : filter_nearest, repeat_disable;
uniform sampler2D hf_entries : filter_nearest, repeat_disable;
uniform sampler2D hf_transforms : filter_nearest, repeat_disable;
uniform vec3 hf_centre;  // blend_centre()
uniform float hf_offset_share;  // of pose_blend_info()

"""

GODOT_ENTRY = """void vertex() {
  HfVertex rest;
  rest.position = VERTEX;
  rest.normal = NORMAL;
  rest.tangent = TANGENT;
  HfVertex posed = hf_blend(uvec2(CUSTOM0.xy), 0u, rest);
  VERTEX = posed.position + hf_offset_share * CUSTOM1.xyz + hf_centre;
  NORMAL = posed.normal;
  TANGENT = posed.tangent;
  BINORMAL = cross(posed.normal, posed.tangent);
}
"""


def translated(text, language):
    """Returns a part of the source in a language."""

    def struct(m):
        return "struct " + m[1] + " {" + re.sub(r"(\w+): (\w+),", r"\2 \1;", m[2]) + "};"

    def function(m):
        return (m[3] or "void") + " " + m[1] + "(" + re.sub(r"(\w+): (\w+)", r"\2 \1", m[2]) + ") {"

    text = re.sub(r"^struct (\w+) \{(.*?)^\}", struct, text, flags=re.M | re.S)
    text = re.sub(r"^fn (\w+)\((.*?)\)(?: -> (\w+))? \{", function, text, flags=re.M)
    text = re.sub(r"\b(?:let|var) (\w+): (\w+)", r"\2 \1", text)
    text = text.replace("inverseSqrt", INVERSE_ROOT[language])
    return re.sub(r"\b\w+\b", lambda m: TYPES[language].get(m[0], m[0]), text)


def made(source):
    """Returns the text of every file that follows from the source."""
    parts = {m[1]: m[0] for m in re.finditer(r"^// ---- (\w+).*?(?=^// ----|\Z)", source, flags=re.M | re.S)}
    table = re.search(r"^//\n.*?(?=\nstruct)", source, flags=re.M | re.S)[0]
    structs = re.search(r"^struct HfFrame .*?(?=@group)", source, flags=re.M | re.S)[0]
    transform = structs[structs.index("struct HfTransform") :]

    def with_buffers(language, head, table, bindings, entry):
        begin, call = (translated(text, language) for text in (structs, parts["arrays"] + parts["blend"]))
        compute = translated(parts["compute"], language)
        head_of_entry = parts["entry"].partition(". Cut")[0] + " ----\n"
        return WHAT + head + table + "\n" + begin + bindings + call + f"#ifndef HF_NO_ENTRY\n{compute}{head_of_entry}{entry}#endif\n"

    def register(m):
        letter = "b" if m[1] == "0" else "u" if m[1] == "7" else "t"
        return f"// {letter}{m[1]}".ljust(len(m[0]))

    return {
        "hf_blend.hlsl": with_buffers(
            "hlsl", "", re.sub(r"^// (\d) (?:uniform|storage)", register, table.replace("// binding ", "// register"), flags=re.M),
            HLSL_BINDINGS, HLSL_ENTRY),
        "hf_blend_buffers.glsl": with_buffers(
            "glsl", "// GLSL 4.50, for OpenGL and Vulkan. Write the line #version above it.\n", table, GLSL_BINDINGS, GLSL_ENTRY),
        "hf_blend_textures.glsl": WHAT + TEXTURES + translated(transform, "glsl") + TEXTURES_ARRAYS + translated(parts["blend"], "glsl") +
                                  f"#ifndef HF_NO_ENTRY\n// ---- entry: draw N instances ----\n{TEXTURES_ENTRY}#endif\n",
        "hf_blend.gdshaderinc": WHAT + GODOT + translated(transform, "glsl") +
                                TEXTURES_ARRAYS.replace("return texelFetch(hf_clusters, hf_texel(e, textureSize(hf_clusters, 0).x), 0).x;",
                                                        "return uint(texelFetch(hf_clusters, hf_texel(e, textureSize(hf_clusters, 0).x), 0).x + 0.5);") +
                                translated(parts["blend"], "glsl") + f"#ifndef HF_NO_ENTRY\n{GODOT_ENTRY}#endif\n",
    }


def main():
    check = "--check" in sys.argv
    stale = []
    for name, text in made((FOLDER / "hf_blend.wgsl").read_text()).items():
        path = FOLDER / name
        if path.exists() and path.read_text() == text:
            continue
        stale.append(name)
        if not check:
            path.write_text(text)
    if check and stale:
        sys.exit(f"{', '.join(stale)}: out of date; run bindings/shaders/make_shaders.py and commit what it writes")


if __name__ == "__main__":
    main()
