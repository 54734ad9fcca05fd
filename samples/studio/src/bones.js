// The bones in the picture of Weights: seen through the body, found under a pointer, moved by the test.

/** A bone is as wide as this part of its length, and widest at this part of it: Blender's are 0.1 and 0.1. Wider ones hide the colours of the skin. */
const [WIDE, WIDEST] = [0.09, 0.18];
/** A bone longer than this part of the size of the body gets no wider: one from the ground to the hips is no leg. */
const LONG = 0.15;
/** Half the length of a bone without a child, as part of the size of the body: half of it is lost in a hand, twice of it leaves the hand. */
const DOT = 0.012;
/** A pointer so many pixels from the line of a bone means the bone: fewer are missed by a hand, more take clicks that mean the skin beside it. */
const REACH = 8;
/** How bright the bones are that are not chosen: at 1 the chosen one is not seen, at 0 their colours are not. */
const DIM = 0.45;
/** An octahedron along x: ends, and corners around its widest place. */
const CORNERS = [[0, 0, 0], [1, 0, 0], [WIDEST, WIDE, 0], [WIDEST, 0, WIDE], [WIDEST, -WIDE, 0], [WIDEST, 0, -WIDE]];
const FACES = [2, 3, 4, 5].flatMap((a, i, around) => [a, around[(i + 1) % 4]].flatMap((v, k, [p, q]) => (k ? [1, p, q] : [0, q, p])));

/** The vertex of a triangle that is nearest to each head: every vertex is looked at once. */
function nearestVertices(rest, triangles, heads) {
  const seen = new Uint8Array(rest.length / 3);
  const least = new Float64Array(heads.length).fill(Infinity);
  const nearest = new Uint32Array(heads.length);
  for (const v of triangles) {
    if (seen[v]) continue;
    seen[v] = 1;
    const [x, y, z] = [rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]];
    for (let i = 0; i < heads.length; ++i) {
      const away = (heads[i].x - x) ** 2 + (heads[i].y - y) ** 2 + (heads[i].z - z) ** 2;
      if (away < least[i]) [least[i], nearest[i]] = [away, v];
    }
  }
  return nearest;
}

export class Bones {
  /** tool: { app, bones, colours, shown, bend } of the Weights tool. */
  constructor(kit, tool) {
    const { BufferGeometry, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial } = kit;
    Object.assign(this, { kit, tool, view: tool.app.view });
    this.solid = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ vertexColors: true, depthTest: false, transparent: true, opacity: 0.8 }));
    this.edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: 0x1c2733, depthTest: false, transparent: true, opacity: 0.7 }));
    this.solid.renderOrder = 3;
    this.edges.renderOrder = 4;
    for (const part of [this.solid, this.edges]) {
      part.frustumCulled = false;
      part.visible = false;
      this.view.extras.add(part);
    }
    this.segments = [];
  }
  hide() {
    this.solid.visible = this.edges.visible = false;
    this.segments = [];
  }
  /** { bone, from, to }: from the head of a bone to those of its children, or a short way on where it has none. */
  #segmentsOf() {
    const { Vector3 } = this.kit;
    const { bones, bend } = this.tool;
    const matrices = bend.matrices();
    const heads = bones.names.map((_, i) => new Vector3().fromArray(bones.heads, 3 * i).applyMatrix4(matrices[i]));
    if (!bend.active) this.#follow(heads);
    const least = DOT * this.view.size;
    return heads.flatMap((from, bone) => {
      const children = heads.flatMap((to, i) => (bones.parents[i] === bone && to.distanceTo(from) > 0.1 * least ? [to] : []));
      if (children.length) return children.map((to) => ({ bone, from, to }));
      const above = heads[bones.parents[bone]];
      const way = above ? from.clone().sub(above).normalize() : new Vector3(0, 1, 0);
      return [{ bone, from, to: from.clone().addScaledVector(way.lengthSq() > 0 ? way : new Vector3(0, 1, 0), 2 * least) }];
    });
  }
  /** Of a posed body the bones go with the skin: each with the vertex nearest to its head. */
  #follow(heads) {
    const { app, bones } = this.tool;
    if (!app.tools.pose.posed()) return;
    const { positions: rest, triangles } = app.body;
    if (this.of !== bones) {
      this.of = bones;
      this.nearest = nearestVertices(rest, triangles, heads);
    }
    heads.forEach((head, i) => {
      const v = 3 * this.nearest[i];
      head.add({ x: app.shape.positions[v] - rest[v], y: app.shape.positions[v + 1] - rest[v + 1], z: app.shape.positions[v + 2] - rest[v + 2] });
    });
  }
  show() {
    const { BufferAttribute, Quaternion, Vector3 } = this.kit;
    const { colours, shown } = this.tool;
    this.segments = this.#segmentsOf();
    const count = this.segments.length;
    const [places, tint] = [new Float32Array(18 * count), new Float32Array(18 * count)];
    const [faces, edges] = [[], []];
    const [turn, along, corner] = [new Quaternion(), new Vector3(), new Vector3()];
    this.segments.forEach(({ bone, from, to }, s) => {
      along.subVectors(to, from);
      const length = along.length();
      turn.setFromUnitVectors(new Vector3(1, 0, 0), along.divideScalar(length || 1));
      const bright = shown === 'all' || Number(shown) === bone ? 1 : DIM;
      const { r, g, b } = colours[bone];
      CORNERS.forEach((place, v) => {
        const wide = Math.min(length, LONG * this.view.size);
        corner.set(place[0] * length, place[1] * wide, place[2] * wide).applyQuaternion(turn).add(from).toArray(places, 3 * (6 * s + v));
        tint.set([r * bright, g * bright, b * bright], 3 * (6 * s + v));
      });
      faces.push(...FACES.map((v) => 6 * s + v));
      for (let i = 0; i < 4; ++i) edges.push(...[0, 2 + i, 1, 2 + i, 2 + i, 2 + ((i + 1) % 4)].map((v) => 6 * s + v));
    });
    for (const [part, index] of [[this.solid, faces], [this.edges, edges]]) {
      part.geometry.dispose();
      part.geometry = new this.kit.BufferGeometry().setIndex(index).setAttribute('position', new BufferAttribute(places, 3));
      part.visible = true;
    }
    this.solid.geometry.setAttribute('color', new BufferAttribute(tint, 3));
    this.view.draw();
  }
  /** The bone whose line passes nearest to a pixel, within reach; or -1. */
  under([x, y]) {
    let [least, found] = [REACH, -1];
    for (const { bone, from, to } of this.segments) {
      const [a, b] = [from, to].map((place) => this.view.onScreen(place));
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const t = Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1)));
      const away = Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
      if (away < least) [least, found] = [away, bone];
    }
    return found;
  }
}
