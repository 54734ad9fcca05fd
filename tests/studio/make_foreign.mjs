// Files of other programs made by code: a bar of two joints whose upper half turns by a right angle in one second, as FBX
// (text), DAE, and a VRM around a glb; a cube as STL, in text and in binary.

/** A bar of 2 units along y: rings of four corners, each with the share of its upper joint. */
const RINGS = 5;
const points = Array.from({ length: 4 * RINGS }, (_, i) => [[-0.25, 0.25, 0.25, -0.25][i % 4], (2 * (i >> 2)) / (RINGS - 1), [-0.25, -0.25, 0.25, 0.25][i % 4]]);
const shares = points.map(([, y]) => Math.max(0, Math.min(1, y - 0.5)));
const quads = [];
for (let r = 0; r + 1 < RINGS; ++r) for (let k = 0; k < 4; ++k) quads.push([4 * r + k, 4 * (r + 1) + k, 4 * (r + 1) + ((k + 1) % 4), 4 * r + ((k + 1) % 4)]);
quads.push([0, 1, 2, 3], [3, 2, 1, 0].map((k) => 4 * (RINGS - 1) + k));
export const bar = { points, quads, vertexCount: points.length };

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const up = identity.with(13, 1);
/** Seconds of FBX. */
const TICKS = 46186158000;

/** Readers of the text form go by the tabs of its lines. */
function tabbed(text) {
  let depth = 0;
  return text
    .split('\n')
    .map((line) => {
      const bare = line.trim();
      if (bare === '}') --depth;
      const out = '\t'.repeat(depth) + bare;
      if (bare.endsWith('{')) ++depth;
      return out;
    })
    .join('\n');
}

export function fbx() {
  const list = (name, numbers) => `${name}: *${numbers.length} {\n a: ${numbers.join(',')}\n }`;
  const share = (id, name, weights, matrix) => {
    const used = weights.flatMap((w, v) => (w > 0 ? [v] : []));
    return `Deformer: ${id}, "SubDeformer::${name}", "Cluster" {
 Version: 100
 ${list('Indexes', used)}
 ${list('Weights', used.map((v) => weights[v]))}
 ${list('Transform', matrix)}
 ${list('TransformLink', matrix)}
}`;
  };
  const model = (id, name, kind, place) => `Model: ${id}, "Model::${name}", "${kind}" {
 Version: 232
 Properties70:  {
  P: "Lcl Translation", "Lcl Translation", "", "A",${place.join(',')}
 }
}`;
  const curve = (id, values) => `AnimationCurve: ${id}, "AnimCurve::", "" {
 Default: 0
 KeyVer: 4008
 ${list('KeyTime', [0, TICKS])}
 ${list('KeyValueFloat', values)}
}`;
  return tabbed(`; FBX 7.4.0 project file
FBXHeaderExtension:  {
 FBXHeaderVersion: 1003
 FBXVersion: 7400
}
GlobalSettings:  {
 Version: 1000
 Properties70:  {
  P: "UpAxis", "int", "Integer", "",1
  P: "UnitScaleFactor", "double", "Number", "",100
 }
}
Objects:  {
Geometry: 1, "Geometry::bar", "Mesh" {
 ${list('Vertices', points.flat())}
 ${list('PolygonVertexIndex', quads.flatMap(([a, b, c, d]) => [a, b, c, -d - 1]))}
}
${model(2, 'bar', 'Mesh', [0, 0, 0])}
${model(3, 'lower', 'LimbNode', [0, 0, 0])}
${model(4, 'upper', 'LimbNode', [0, 1, 0])}
NodeAttribute: 13, "NodeAttribute::lower", "LimbNode" {
 TypeFlags: "Skeleton"
}
NodeAttribute: 14, "NodeAttribute::upper", "LimbNode" {
 TypeFlags: "Skeleton"
}
Deformer: 5, "Deformer::skin", "Skin" {
 Version: 101
}
${share(6, 'lower', shares.map((w) => 1 - w), identity)}
${share(7, 'upper', shares, up)}
AnimationStack: 8, "AnimStack::bend", "" {
}
AnimationLayer: 9, "AnimLayer::bend", "" {
}
AnimationCurveNode: 10, "AnimCurveNode::R", "" {
}
${curve(11, [0, 90])}
${curve(12, [0, 0])}
${curve(15, [0, 0])}
}
Connections:  {
 C: "OO",2,0
 C: "OO",3,0
 C: "OO",4,3
 C: "OO",13,3
 C: "OO",14,4
 C: "OO",1,2
 C: "OO",5,1
 C: "OO",6,5
 C: "OO",7,5
 C: "OO",3,6
 C: "OO",4,7
 C: "OO",9,8
 C: "OO",10,9
 C: "OP",10,4, "Lcl Rotation"
 C: "OP",12,10, "d|X"
 C: "OP",15,10, "d|Y"
 C: "OP",11,10, "d|Z"
}
`);
}

export function dae() {
  const floats = (id, numbers, size, names) => `<source id="${id}"><float_array id="${id}-array" count="${numbers.length}">${numbers.join(' ')}</float_array>
<technique_common><accessor source="#${id}-array" count="${numbers.length / size}" stride="${size}">${names.map((name) => `<param name="${name}" type="float${size === 16 ? '4x4' : ''}"/>`).join('')}</accessor></technique_common></source>`;
  const words = (id, list, name) => `<source id="${id}"><Name_array id="${id}-array" count="${list.length}">${list.join(' ')}</Name_array>
<technique_common><accessor source="#${id}-array" count="${list.length}" stride="1"><param name="${name}" type="name"/></accessor></technique_common></source>`;
  // rows of COLLADA
  const place = (y) => `1 0 0 0 0 1 0 ${y} 0 0 1 0 0 0 0 1`;
  const turned = '0 -1 0 0 1 0 0 1 0 0 1 0 0 0 0 1';
  const triangles = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  const weights = shares.flatMap((w) => [1 - w, w]);
  return `<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="blue-effect"><profile_COMMON><technique sid="common"><lambert><diffuse><color>0.1 0.2 0.8 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="blue" name="blue"><instance_effect url="#blue-effect"/></material></library_materials>
<library_geometries><geometry id="bar" name="bar"><mesh>
${floats('bar-places', points.flat(), 3, ['X', 'Y', 'Z'])}
<vertices id="bar-vertices"><input semantic="POSITION" source="#bar-places"/></vertices>
<triangles count="${triangles.length / 3}" material="blue"><input semantic="VERTEX" source="#bar-vertices" offset="0"/><p>${triangles.join(' ')}</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="bar-skin"><skin source="#bar"><bind_shape_matrix>${place(0)}</bind_shape_matrix>
${words('bar-joints', ['lower', 'upper'], 'JOINT')}
${floats('bar-binds', `${place(0)} ${place(-1)}`.split(' '), 16, ['TRANSFORM'])}
${floats('bar-weights', weights, 1, ['WEIGHT'])}
<joints><input semantic="JOINT" source="#bar-joints"/><input semantic="INV_BIND_MATRIX" source="#bar-binds"/></joints>
<vertex_weights count="${points.length}"><input semantic="JOINT" source="#bar-joints" offset="0"/><input semantic="WEIGHT" source="#bar-weights" offset="1"/>
<vcount>${points.map(() => 2).join(' ')}</vcount><v>${points.map((_, v) => `0 ${2 * v} 1 ${2 * v + 1}`).join(' ')}</v></vertex_weights>
</skin></controller></library_controllers>
<library_animations><animation id="bend">
${floats('bend-times', [0, 1], 1, ['TIME'])}
${floats('bend-values', `${place(1)} ${turned}`.split(' '), 16, ['TRANSFORM'])}
${words('bend-ways', ['LINEAR', 'LINEAR'], 'INTERPOLATION')}
<sampler id="bend-sampler"><input semantic="INPUT" source="#bend-times"/><input semantic="OUTPUT" source="#bend-values"/><input semantic="INTERPOLATION" source="#bend-ways"/></sampler>
<channel source="#bend-sampler" target="upper/transform"/></animation></library_animations>
<library_visual_scenes><visual_scene id="scene">
<node id="lower" sid="lower" name="lower" type="JOINT"><matrix sid="transform">${place(0)}</matrix><node id="upper" sid="upper" name="upper" type="JOINT"><matrix sid="transform">${place(1)}</matrix></node></node>
<node id="body" name="body"><instance_controller url="#bar-skin"><skeleton>#lower</skeleton><bind_material><technique_common><instance_material symbol="blue" target="#blue"/></technique_common></bind_material></instance_controller></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
`;
}

/** The faces of a cube of 2 units as triangles: 12 of them. */
const cube = () => {
  const out = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const side of [-1, 1]) {
      const at = (a, b) => [0, 1, 2].map((k) => (k === axis ? side : k === (axis + 1) % 3 ? a * side : b));
      out.push([at(-1, -1), at(1, -1), at(1, 1)], [at(-1, -1), at(1, 1), at(-1, 1)]);
    }
  return out;
};

export const stlText = () =>
  `solid cube\n${cube()
    .map((corners) => `facet normal 0 0 0\nouter loop\n${corners.map((p) => `vertex ${p.join(' ')}`).join('\n')}\nendloop\nendfacet`)
    .join('\n')}\nendsolid cube\n`;

export function stlBinary() {
  const triangles = cube();
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, t) => corners.flat().forEach((x, i) => bytes.writeFloatLE(x, 84 + 50 * t + 12 + 4 * i)));
  return bytes;
}

/** The chunks of a glb. */
export function chunks(bytes) {
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + length).toString()), binary: bytes.subarray(28 + length) };
}

/** A glb with what a VRM 1 and a VRM 0 hold, and a picture and a node that nothing else names. */
export function vrm(glb) {
  const { json, binary } = chunks(glb);
  json.nodes.push({ name: 'spring end' });
  json.extensionsUsed = [...(json.extensionsUsed ?? []), 'VRMC_vrm', 'VRM'];
  const humanBones = { hips: { node: 1 }, head: { node: json.nodes.length - 1 } };
  json.extensions = {
    VRMC_vrm: { specVersion: '1.0', meta: { name: 'a test' }, humanoid: { humanBones } },
    VRM: { secondaryAnimation: { boneGroups: [{ bones: [json.nodes.length - 1], stiffiness: 0.7 }] } },
  };
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 32)]);
  const head = Buffer.alloc(20);
  head.write('glTF', 0);
  [2, 28 + padded.length + binary.length, padded.length].forEach((word, i) => head.writeUInt32LE(word, 4 + 4 * i));
  head.write('JSON', 16);
  const middle = Buffer.alloc(8);
  middle.writeUInt32LE(binary.length, 0);
  middle.write('BIN\0', 4);
  return Buffer.concat([head, padded, middle, binary]);
}
