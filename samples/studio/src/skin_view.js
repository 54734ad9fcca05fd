// A body on the screen: its own materials, or one overlay (field strips, colours of bones, a wash) over the same arrays.
import * as THREE from 'three';
import { readBvh } from './bvh.js';
import { ghostOf } from './ghost.js';

/** Colours of a field from its lowest to its highest value (linear light), and the strips between its lines. */
export const ramp = [
  [0.13, 0.32, 0.66],
  [0.93, 0.91, 0.86],
  [0.85, 0.38, 0.08],
];
export const STRIPS = 12;
const colour = (list) => `vec3(${list.join(', ')})`;
/** The shadow under a body: its width as part of the body's, its darkness, its corners. */
const [SHADOW, DARK, ROUND] = [0.6, 0.34, 48];

/** A soft disc under the body at rest, so that it stands and does not float. */
function shadow(box) {
  const size = box.getSize(new THREE.Vector3());
  const geometry = new THREE.CircleGeometry(1, ROUND);
  const colours = new Float32Array(4 * (ROUND + 2));
  colours[3] = DARK; // the middle; all others are clear
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 4));
  const disc = new THREE.Mesh(
    geometry,
    new THREE.MeshBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }),
  );
  box.getCenter(disc.position).y = box.min.y;
  const least = 0.3 * Math.max(size.x, size.z);
  disc.scale.set(SHADOW * Math.max(size.x, least), SHADOW * Math.max(size.z, least), 1);
  disc.rotation.x = -Math.PI / 2;
  disc.renderOrder = -1;
  return disc;
}

const overlay = () =>
  new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    // lines along the surface lie before it
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: { mode: { value: 0 }, low: { value: 0 }, high: { value: 1 }, strips: { value: STRIPS } },
    vertexShader: `attribute float field; attribute float reached; attribute vec3 tint;
      varying float vField; varying float vReached; varying vec3 vTint; varying vec3 vNormal;
      void main() {
        vField = field; vReached = reached; vTint = tint; vNormal = normalMatrix * normal;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `uniform int mode; uniform float low, high, strips;
      varying float vField; varying float vReached; varying vec3 vTint; varying vec3 vNormal;
      vec3 ramp(float t) {
        vec3 cold = ${colour(ramp[0])}, middle = ${colour(ramp[1])}, warm = ${colour(ramp[2])};
        return t < 0.5 ? mix(cold, middle, 2.0 * t) : mix(middle, warm, 2.0 * t - 1.0);
      }
      void main() {
        vec3 n = normalize(vNormal);
        float light = 0.5 + 0.38 * max(dot(n, normalize(vec3(0.3, 0.6, 0.7))), 0.0) + 0.18 * abs(n.z);
        vec3 colour = vTint;
        if (mode == 1) {
          float t = (vField - low) / max(high - low, 1e-20);
          float band = t * strips;
          float width = max(fwidth(band), 1e-6);
          float edge = abs(fract(band + 0.5) - 0.5);
          // no line along the ends of the range: whole areas have those values
          float inner = step(0.5, band) * step(band, strips - 0.5);
          float line = inner - inner * smoothstep(0.5 * width, 1.6 * width, edge - 0.5 * width);
          colour = mix(ramp(clamp((floor(band) + 0.5) / strips, 0.0, 1.0)), vec3(0.1), 0.65 * line * smoothstep(0.9, 0.3, width));
          float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 11.0);
          vec3 hatch = stripe < 0.28 ? vec3(0.3) : vec3(0.9);
          colour = mix(hatch, colour, step(0.5, vReached));
        }
        gl_FragColor = vec4(light * colour, 1.0);
        #include <colorspace_fragment>
      }`,
  });

export class Skin {
  constructor(body, view) {
    this.body = body;
    this.view = view;
    this.positions = body.positions.slice();
    this.normals = new Float32Array(body.positions.length);
    this.field = new Float32Array(body.vertexCount);
    this.reached = new Float32Array(body.vertexCount).fill(1);
    this.tint = new Float32Array(3 * body.vertexCount).fill(0.75);
    this.bvh = null;
    this.stale = false;
    this.group = new THREE.Group();
    this.materials = new Map();
    this.parts = body.parts.map((part) => this.#part(part));
    this.whole = new THREE.BufferGeometry();
    this.whole.setIndex(new THREE.BufferAttribute(body.triangles, 1));
    for (const [name, array, size] of [
      ['position', this.positions, 3],
      ['normal', this.normals, 3],
      ['field', this.field, 1],
      ['reached', this.reached, 1],
      ['tint', this.tint, 3],
    ])
      this.whole.setAttribute(name, new THREE.BufferAttribute(array, size));
    this.overlay = overlay();
    this.cover = new THREE.Mesh(this.whole, this.overlay);
    this.cover.frustumCulled = false;
    this.cover.visible = false;
    this.ghost = ghostOf(body.positions, body.triangles);
    this.group.add(shadow(this.box()), this.cover, ...this.parts, this.ghost);
    view.bodies.add(this.group);
  }

  #part(part) {
    const geometry = new THREE.BufferGeometry();
    const range = (array, size) => array.subarray(size * part.first, size * (part.first + part.count));
    geometry.setAttribute('position', new THREE.BufferAttribute(range(this.positions, 3), 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(range(this.normals, 3), 3));
    const corners = this.body.triangles
      .subarray(part.firstCorner, part.firstCorner + part.cornerCount)
      .map((v) => v - part.first);
    geometry.setIndex(new THREE.BufferAttribute(corners, 1));
    for (const [from, to] of [
      ['TEXCOORD_0', 'uv'],
      ['TEXCOORD_1', 'uv1'],
      ['COLOR_0', 'color'],
    ]) {
      const accessor = part.primitive.getAttribute(from);
      if (!accessor) continue;
      const array = new Float32Array(accessor.getCount() * accessor.getElementSize());
      const element = [];
      for (let i = 0; i < accessor.getCount(); ++i)
        array.set(accessor.getElement(i, element), i * accessor.getElementSize());
      geometry.setAttribute(to, new THREE.BufferAttribute(array, accessor.getElementSize()));
    }
    const mesh = new THREE.Mesh(geometry, this.#material(part.primitive));
    mesh.frustumCulled = false;
    return mesh;
  }

  #material(primitive) {
    const given = primitive.getMaterial();
    const coloured = Boolean(primitive.getAttribute('COLOR_0'));
    const key = given ?? `plain${coloured}`;
    if (this.materials.has(key)) return this.materials.get(key);
    const material = new THREE.MeshStandardMaterial({
      color: 0xc9c4b8,
      roughness: 0.8,
      metalness: 0,
      vertexColors: coloured,
    });
    if (given) {
      const [r, g, b, a] = given.getBaseColorFactor();
      material.color.setRGB(r, g, b);
      material.roughness = given.getRoughnessFactor();
      // without surroundings to mirror, a metal would be black
      material.metalness = Math.min(0.25, given.getMetallicFactor());
      material.emissive.setRGB(...given.getEmissiveFactor());
      material.side = given.getDoubleSided() ? THREE.DoubleSide : THREE.FrontSide;
      material.opacity = given.getAlphaMode() === 'BLEND' ? a : 1;
      material.transparent = given.getAlphaMode() === 'BLEND';
      material.alphaTest = given.getAlphaMode() === 'MASK' ? given.getAlphaCutoff() : 0;
      material.given = given;
    }
    this.materials.set(key, material);
    return material;
  }

  /** Decodes the textures; a picture that cannot be decoded leaves its colour and says so. */
  async loadPictures() {
    const failed = [];
    let packed = false;
    const bitmaps = new Map();
    const textureOf = async (texture, info, colour) => {
      if (!texture?.getImage()) return null;
      if (texture.getMimeType() === 'image/ktx2') {
        packed = true;
        return null;
      }
      if (!bitmaps.has(texture))
        bitmaps.set(
          texture,
          createImageBitmap(new Blob([texture.getImage()], { type: texture.getMimeType() }), {
            colorSpaceConversion: 'none',
          }),
        );
      const result = new THREE.Texture(await bitmaps.get(texture));
      result.flipY = false;
      const wraps = {
        10497: THREE.RepeatWrapping,
        33071: THREE.ClampToEdgeWrapping,
        33648: THREE.MirroredRepeatWrapping,
      };
      [result.wrapS, result.wrapT] = [wraps[info.getWrapS()], wraps[info.getWrapT()]];
      result.channel = Math.min(1, info.getTexCoord());
      if (colour) result.colorSpace = THREE.SRGBColorSpace;
      const moved = info.getExtension('KHR_texture_transform');
      if (moved) {
        result.offset.set(...moved.getOffset());
        result.repeat.set(...moved.getScale());
        result.rotation = -moved.getRotation();
      }
      result.needsUpdate = true;
      return result;
    };
    for (const material of this.materials.values()) {
      const { given } = material;
      if (!given) continue;
      try {
        material.map = await textureOf(given.getBaseColorTexture(), given.getBaseColorTextureInfo(), true);
        material.emissiveMap = await textureOf(given.getEmissiveTexture(), given.getEmissiveTextureInfo(), true);
        material.needsUpdate = true;
      } catch {
        failed.push(given.getName() || 'a material');
      }
    }
    if (packed) this.body.notes.push('pictures in KTX2 stay in the file and are not shown');
    if (failed.length) this.body.notes.push(`pictures of ${failed.join(', ')} cannot be decoded`);
  }

  set({ positions, normals }) {
    if (positions) this.positions.set(positions);
    if (normals) this.normals.set(normals);
    this.stale = true;
    this.#changed('position', 'normal');
  }
  /** The body at rest around the posed one. normals: those at rest, once for a body. */
  showGhost(shown, normals) {
    if (shown && !this.ghost.geometry.hasAttribute('normal'))
      this.ghost.geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    if (this.ghost.visible === shown) return;
    this.ghost.visible = shown;
    this.view.draw();
  }
  /** reached: null where every vertex is. */
  setField(values, reached) {
    reached ??= new Float32Array(values.length).fill(1);
    if (this.lent) {
      Object.assign(this.lent, { field: values, reached });
      return;
    }
    this.field.set(values);
    this.reached.set(reached);
    this.#changed('field', 'reached');
  }
  /** Other values in the place of the field: weights of a bone, a difference. null: the field again. */
  lend(values) {
    if (!values && !this.lent) return;
    this.lent ??= { field: this.field.slice(), reached: this.reached.slice() };
    if (values) {
      this.field.set(values);
      this.reached.fill(1);
    } else {
      const { field, reached } = this.lent;
      this.lent = null;
      this.field.set(field);
      this.reached.set(reached);
    }
    this.#changed('field', 'reached');
  }
  setTint(tint) {
    this.tint.set(tint);
    this.#changed('tint');
  }
  #changed(...names) {
    for (const geometry of [this.whole, ...this.parts.map((part) => part.geometry)])
      for (const name of names) {
        const attribute = geometry.getAttribute(name);
        if (attribute) attribute.needsUpdate = true;
      }
    this.view.draw();
  }
  /** 'own': the file's materials; 'field': strips; 'tint': a colour for each vertex. */
  wear(cover, { low = 0, high = 1 } = {}) {
    this.cover.visible = cover !== 'own';
    for (const part of this.parts) part.visible = cover === 'own';
    const { uniforms } = this.overlay;
    uniforms.mode.value = cover === 'field' ? 1 : 0;
    uniforms.low.value = low;
    uniforms.high.value = high;
    this.view.draw();
  }

  useTree(answer) {
    this.bvh = readBvh(answer, this.positions, this.body.triangles);
    this.stale = true;
  }
  /** The first triangle under a ray: { triangle, corners, barycentrics, vertex, position, distance }, or null. */
  pick(ray) {
    if (!this.bvh) return null;
    if (this.stale) this.bvh.refit();
    this.stale = false;
    const hit = this.bvh.raycastFirst(ray, THREE.DoubleSide);
    if (!hit) return null;
    const corners = Array.from(this.body.triangles.subarray(3 * hit.faceIndex, 3 * hit.faceIndex + 3));
    const places = corners.map((v) => new THREE.Vector3().fromArray(this.positions, 3 * v));
    const weights = THREE.Triangle.getBarycoord(hit.point, ...places, new THREE.Vector3());
    if (!weights) return null;
    const shares = weights.toArray().map((x) => Math.max(0, x));
    const sum = shares.reduce((a, b) => a + b);
    const barycentrics = shares.map((x) => x / sum);
    const vertex = corners[barycentrics.indexOf(Math.max(...barycentrics))];
    return {
      triangle: hit.faceIndex,
      corners,
      barycentrics,
      vertex,
      position: hit.point.toArray(),
      distance: hit.distance,
    };
  }
  /** The place of a point in a triangle, in the present pose or at rest. */
  at({ corners, barycentrics }, positions = this.positions) {
    return [0, 1, 2].map((k) => corners.reduce((sum, v, i) => sum + barycentrics[i] * positions[3 * v + k], 0));
  }
  /** The box of what triangles show: vertices that are left over in a file may lie anywhere. */
  box(positions = this.positions) {
    const [box, corner] = [new THREE.Box3(), new THREE.Vector3()];
    for (const v of this.body.triangles) box.expandByPoint(corner.fromArray(positions, 3 * v));
    return box;
  }
  dispose() {
    this.view.bodies.remove(this.group);
    for (const material of this.materials.values()) {
      material.map?.dispose();
      material.dispose();
    }
    this.view.clear(this.group);
  }
}
