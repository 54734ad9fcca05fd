// Runs the shaders in a browser, over the scene that run_browser.py wrote: WebGL 2 by transform feedback, WebGPU by compute.
// Each posed draw goes back to the server as [characters][4][vertices][3] floats.

const scene = await (await fetch('data/scene.json')).json();
const bytes = await (await fetch('data/scene.bin')).arrayBuffer();
const kinds = { rows: Uint32Array, clusters: Uint16Array };
const arrayOf = ([name, offset, length]) => new (kinds[name] ?? Float32Array)(bytes, offset, length);
for (const set of scene.sets) for (const name in set.arrays) set[name] = arrayOf([name, ...set.arrays[name]]);
for (const frame of scene.frames) frame.transforms = arrayOf(['transforms', ...frame.transforms]);
const text = async (name) => (await fetch(`shaders/${name}`)).text();
const count = scene.vertex_count;

function transformsOf(draw) {
  const frames = [...draw.now, ...draw.before].map((k) => scene.frames[k].transforms);
  const all = new Float32Array(frames.length * frames[0].length);
  frames.forEach((frame, i) => all.set(frame, i * frame.length));
  return all;
}
const send = (name, number, posed) => fetch(`posed?name=${name}&draw=${number}`, { method: 'POST', body: posed });

/** A list as a texture: width is free, the last row is padded. */
function texture(gl, unit, formats, data, each, width) {
  const height = Math.ceil(data.length / each / width);
  const padded = new data.constructor(width * height * each);
  padded.set(data);
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
  gl.texImage2D(gl.TEXTURE_2D, 0, formats[0], width, height, 0, formats[1], formats[2], padded);
}

export async function webgl() {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return 'no WebGL 2';
  const program = gl.createProgram();
  const vertex = `#version 300 es\nprecision highp float;\n${await text('hf_blend_textures.glsl')}`;
  const fragment = '#version 300 es\nvoid main() {}';
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  const outs = { hf_posed_position: 3, hf_posed_normal: 3, hf_posed_tangent: 4, hf_posed_before: 3 };
  gl.transformFeedbackVaryings(program, Object.keys(outs), gl.SEPARATE_ATTRIBS);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  gl.enable(gl.RASTERIZER_DISCARD);
  const uniform = (name) => gl.getUniformLocation(program, name);
  ['hf_clusters', 'hf_entries', 'hf_transforms'].forEach((name, unit) => gl.uniform1i(uniform(name), unit));
  for (const [number, draw] of scene.draws.entries()) {
    const set = scene.sets[draw.set];
    const characters = draw.now.length;
    const entries = new Float32Array(4 * set.weights.length);
    for (let e = 0; e < set.weights.length; ++e) {
      entries.set(set.gradients.subarray(3 * e, 3 * e + 3), 4 * e);
      entries[4 * e + 3] = set.weights[e];
    }
    texture(gl, 0, [gl.R16UI, gl.RED_INTEGER, gl.UNSIGNED_SHORT], set.clusters, 1, 1024);
    texture(gl, 1, [gl.RGBA32F, gl.RGBA, gl.FLOAT], entries, 4, 1000);
    texture(gl, 2, [gl.RGBA32F, gl.RGBA, gl.FLOAT], transformsOf(draw), 4, 96);
    const attributes = {
      hf_position: set.positions,
      hf_normal: set.normals,
      hf_offset: set.offsets,
      hf_tangent: set.tangents,
    };
    for (const [name, data] of Object.entries({ ...attributes, hf_row: set.rows })) {
      const at = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(at);
      if (name === 'hf_row') gl.vertexAttribIPointer(at, 2, gl.UNSIGNED_INT, 0, 0);
      else gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0); // w of a tangent is then 1
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    gl.uniform1ui(uniform('hf_cluster_count'), set.cluster_count);
    gl.uniform1ui(uniform('hf_current'), 0);
    gl.uniform1ui(uniform('hf_previous'), characters * set.cluster_count);
    gl.uniform1f(uniform('hf_offset_share'), scene.frames[draw.now[0]].share);
    gl.uniform1f(uniform('hf_previous_share'), scene.frames[draw.before[0]].share);
    const buffers = Object.values(outs).map((size, i) => {
      const buffer = gl.createBuffer();
      gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, i, buffer);
      gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 4 * size * count * characters, gl.STREAM_READ);
      return buffer;
    });
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArraysInstanced(gl.POINTS, 0, count, characters);
    gl.endTransformFeedback();
    const posed = new Float32Array(12 * count * characters);
    Object.values(outs).forEach((size, i) => {
      const made = new Float32Array(size * count * characters);
      gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, i, null);
      gl.bindBuffer(gl.COPY_READ_BUFFER, buffers[i]);
      gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, made);
      for (let v = 0; v < count * characters; ++v)
        posed.set(made.subarray(size * v, size * v + 3), 3 * ((4 * Math.floor(v / count) + i) * count + (v % count)));
    });
    if (gl.getError()) throw new Error('WebGL has an error');
    await send('webgl', number, posed);
  }
  return 'ran';
}

export async function webgpu() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return 'no WebGPU';
  const device = await adapter.requestDevice();
  const faults = [];
  device.addEventListener('uncapturederror', (event) => faults.push(event.error.message));
  const module = device.createShaderModule({ code: await text('hf_blend.wgsl') });
  const pipeline = device.createComputePipeline({ layout: 'auto', compute: { module, entryPoint: 'hf_main' } });
  const buffer = (data, usage = GPUBufferUsage.STORAGE) => {
    const made = device.createBuffer({ size: (data.byteLength + 3) & ~3, usage, mappedAtCreation: true });
    new Uint8Array(made.getMappedRange()).set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    made.unmap();
    return made;
  };
  for (const [number, draw] of scene.draws.entries()) {
    const set = scene.sets[draw.set];
    const characters = draw.now.length;
    const frame = new Uint32Array([count, set.cluster_count, 0, characters * set.cluster_count, 0, 0, 0, 0]);
    new Float32Array(frame.buffer).set([scene.frames[draw.now[0]].share, scene.frames[draw.before[0]].share], 4);
    const rest = new Float32Array(12 * count);
    [set.positions, set.normals, set.tangents, set.offsets].forEach((a, i) => rest.set(a, 3 * count * i));
    const size = 48 * count * characters;
    const posed = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const read = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const arrays = [set.rows, set.clusters, set.weights, set.gradients, rest, transformsOf(draw)];
    const bound = [buffer(frame, GPUBufferUsage.UNIFORM), ...arrays.map((a) => buffer(a)), posed];
    const encoder = device.createCommandEncoder();
    const work = encoder.beginComputePass();
    work.setPipeline(pipeline);
    const entries = bound.map((b, binding) => ({ binding, resource: { buffer: b } }));
    work.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    work.dispatchWorkgroups(Math.ceil(count / 64), characters);
    work.end();
    encoder.copyBufferToBuffer(posed, 0, read, 0, size);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    if (faults.length) throw new Error(faults[0]);
    await send('webgpu', number, read.getMappedRange().slice(0));
  }
  return 'ran';
}
