"""Runs the compute shaders under Vulkan (or what wgpu finds) and compares with hf_deform. Prints the errors.

run_native.py SHADERS [OBJ|COUNT]: a body of 50,000 vertices without a file. 77 (skipped) without wgpu or an adapter."""

import os
import sys
import traceback
from pathlib import Path

try:
    import wgpu
except ImportError:
    print("skipped: no Python package wgpu here")
    sys.exit(77)
import compilers
import numpy as np
from scene import Errors, draws, scenes


def device():
    """Returns a device with room for the buffers, or ends the test."""
    try:
        adapter = wgpu.gpu.request_adapter_sync()
    except RuntimeError as error:
        print(f"skipped: wgpu finds no adapter here (Debian: mesa-vulkan-drivers): {error}")
        sys.exit(77)
    print(f"on {adapter.info['device']}, {adapter.info['backend_type']}")
    return adapter.request_device_sync(required_limits={})


def programs(shaders):
    """Yields the name of each way from a file to the GPU, and what wgpu takes: WGSL, or SPIR-V by a language's own compiler."""
    glsl, hlsl = "#version 450\n" + (shaders / "hf_blend_buffers.glsl").read_text(), (shaders / "hf_blend.hlsl").read_text()
    yield "WGSL by naga", (shaders / "hf_blend.wgsl").read_text()
    yield "GLSL by glslang", compilers.glslang(glsl, "comp", "-V")
    yield "HLSL by glslang", compilers.glslang(hlsl, "comp", "-D", "-V", "-e", "hf_main")
    yield "HLSL by DXC", compilers.dxc(hlsl)


class Gpu:
    """The buffers of a scene and a pipeline for each program."""

    def __init__(self, scene, gpu):
        self.scene, self.device, self.buffers = scene, gpu, {}
        for i, arrays in enumerate(scene.sets):
            clusters = np.resize(arrays["clusters"], len(arrays["clusters"]) + 1 & ~1).astype(np.uint16)
            rest = [arrays[name] for name in ("positions", "normals", "tangents", "offsets")]
            data = [arrays["rows"], clusters, arrays["weights"], arrays["gradients"], np.stack(rest)]
            self.buffers[i] = [self.buffer(a) for a in data]

    def buffer(self, data, usage=None):
        return self.device.create_buffer_with_data(data=np.ascontiguousarray(data), usage=usage or wgpu.BufferUsage.STORAGE)

    def draw(self, pipeline, which, now, before):
        frames, characters, count = self.scene.frames, len(now), len(self.scene.points)
        clusters = self.scene.sets[which]["cluster_count"]
        numbers = np.array([count, clusters, 0, characters * clusters, 0, 0, 0, 0], np.uint32)
        numbers[4:6] = np.array([frames[now[0]]["share"], frames[before[0]]["share"]], np.float32).view(np.uint32)
        transforms = np.stack([frames[k]["transforms"] for k in (*now, *before)])
        posed = self.device.create_buffer(size=characters * 48 * count, usage=wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC)
        bound = [self.buffer(numbers, wgpu.BufferUsage.UNIFORM), *self.buffers[which], self.buffer(transforms), posed]
        entries = [{"binding": i, "resource": {"buffer": b, "offset": 0, "size": b.size}} for i, b in enumerate(bound)]
        encoder = self.device.create_command_encoder()
        work = encoder.begin_compute_pass()
        work.set_pipeline(pipeline)
        work.set_bind_group(0, self.device.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries))
        work.dispatch_workgroups((count + 63) // 64, characters)
        work.end()
        self.device.queue.submit([encoder.finish()])
        return np.frombuffer(self.device.queue.read_buffer(posed), np.float32).reshape(characters, 4, count, 3)

    def pipeline(self, code):
        module = self.device.create_shader_module(code=code)
        entry = "main" if isinstance(code, bytes) and b"hf_main" not in code else "hf_main"
        return self.device.create_compute_pipeline(layout="auto", compute={"module": module, "entry_point": entry})


def main():
    on = device()
    for scene in scenes(sys.argv[2:]):
        gpu = Gpu(scene, on)
        for name, code in programs(Path(sys.argv[1])):
            if code is None:
                print(f"{name}: absent")
                continue
            pipeline, errors = gpu.pipeline(code), Errors(scene)
            for which, now, before in draws(scene):
                errors.add(now, before, gpu.draw(pipeline, which, now, before))
            errors.check(name)


code = 1
try:
    main()
    code = 0
except SystemExit as end:
    code = end.code
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
os._exit(code)  # a software driver may wait for its threads for ever when Python unwinds
