"""Every shader is up to date and compiles with its field's own tools: naga, glslang, DXC. Names the tools that are absent.

compile_shaders.py SHADERS"""

import subprocess
import sys
from pathlib import Path

import compilers

SHADERS = Path(sys.argv[1])
read = lambda name: (SHADERS / name).read_text()
USE = "\nout vec3 p; uniform uint c; void main() { p = hf_blend_position(uvec2(0u, 1u), c, vec3(1.0)); gl_Position = vec4(p, 1.0); }\n"
ES = "#version 300 es\nprecision highp float;\n"
HLSL_USE = "#define HF_NO_ENTRY\n{}\nfloat4 hf_use(uint c : C) : SV_Position {{ return float4(hf_blend_position(uint2(0u, 1u), c, float3(1.0, 1.0, 1.0)), 1.0); }}\n"

subprocess.run([sys.executable, SHADERS / "make_shaders.py", "--check"], check=True)

CASES = {
    "hf_blend.wgsl by naga": lambda: compilers.naga(SHADERS / "hf_blend.wgsl"),
    "hf_blend_buffers.glsl, OpenGL, by glslang": lambda: compilers.glslang("#version 450\n" + read("hf_blend_buffers.glsl"), "comp"),
    "hf_blend_buffers.glsl, Vulkan, by glslang": lambda: compilers.glslang("#version 450\n" + read("hf_blend_buffers.glsl"), "comp", "-V"),
    "hf_blend_buffers.glsl without entry by glslang":
        lambda: compilers.glslang("#version 450\n#define HF_NO_ENTRY\n" + read("hf_blend_buffers.glsl") + USE, "vert"),
    "hf_blend_textures.glsl, 3.30, by glslang": lambda: compilers.glslang("#version 330\n" + read("hf_blend_textures.glsl"), "vert"),
    "hf_blend_textures.glsl, ES 3.00, by glslang": lambda: compilers.glslang(ES + read("hf_blend_textures.glsl"), "vert"),
    "hf_blend_textures.glsl without entry by glslang":
        lambda: compilers.glslang(ES + "#define HF_NO_ENTRY\n" + read("hf_blend_textures.glsl") + USE, "vert"),
    "hf_blend.hlsl by glslang": lambda: compilers.glslang(read("hf_blend.hlsl"), "comp", "-D", "-V", "-e", "hf_main"),
    "hf_blend.hlsl, SPIR-V, by DXC": lambda: compilers.dxc(read("hf_blend.hlsl")),
    "hf_blend.hlsl, DXIL, by DXC": lambda: compilers.dxc(read("hf_blend.hlsl"), code=compilers.DXIL),
    "hf_blend.hlsl without entry by DXC": lambda: compilers.dxc(HLSL_USE.format(read("hf_blend.hlsl")), "vs_6_0", "hf_use"),
}
for name, compile_it in CASES.items():
    print(f"{'absent' if compile_it() is None else 'ok'}: {name}")
