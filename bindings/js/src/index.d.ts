// Types of hf-fields: the same for the native and the WebAssembly backend. The C headers (include/hf) are the
// reference.
type Numbers = ArrayLike<number>;
type Rows = Numbers | ReadonlyArray<Numbers>;
type Floats = Float32Array | Float64Array;
type FloatsType = Float32ArrayConstructor | Float64ArrayConstructor;

/** A failed call: code, codeName ("HF_ERROR_*"), index it is about (or null), functionName of the C ABI. */
export class HfError extends Error {
  code: number;
  codeName: string;
  index: number | null;
  functionName: string;
}

export interface Handle {
  readonly closed: boolean;
  /**
   * Gives the memory back; later calls do nothing. Objects may be closed in any order, or left to the garbage
   * collector.
   */
  close(): void;
}

export interface SurfaceOptions {
  weld?: number;
  weldTolerance?: number;
  operatorKind?: number;
  /** The factor made at once; others are made when a solver or region asks. */
  fieldKind?: number;
  ordering?: number;
  threadCount?: number;
  vertexLimit?: number;
  triangleLimit?: number;
  memoryLimitMb?: number;
  /** Faces instead of triangles. Starts without sizes are offsets, one more than there are faces. */
  faces?: { starts?: Numbers | null; sizes?: Numbers | null; corners: Numbers } | null;
  /** Joins the pieces of a character by links, so that fields and poses span them; with options of hf_links_desc. */
  linkPieces?: boolean | number | { distance?: number; stiffness?: number; overlayDistance?: number };
  /** With linkPieces: a number per vertex. Pieces of different tags stay apart. */
  tags?: Numbers | null;
  savedFactor?: Uint8Array | null;
  progress?: Progress | null;
}
export interface GraphOptions {
  /** 1: weights may be below 0, if the matrix stays positive semi-definite. */
  allowNegative?: number;
  masses?: Floats | Numbers | null;
  fieldKind?: number;
  ordering?: number;
  threadCount?: number;
  vertexLimit?: number;
  edgeLimit?: number;
  memoryLimitMb?: number;
  savedFactor?: Uint8Array | null;
  progress?: Progress | null;
}
export interface SolverOptions {
  fieldKind?: number;
  engine?: number;
  channelCount?: number;
  siteLimit?: number;
  penalty?: number;
  progress?: Progress | null;
}
/** The first triangle or face on a ray: corners and weights are a site, the vertex is the corner nearest to the hit. */
export interface Hit {
  triangle: number;
  vertex: number;
  corners: [number, number, number];
  barycentrics: [number, number, number];
  position: [number, number, number];
  distance: number;
}
/** A vertex, or three corners of a triangle and their weights, such as a hit. */
export type Place = number | { corners: Numbers; barycentrics: Numbers };
export interface SiteOptions {
  stiffness?: Numbers | null;
  radii?: Numbers | null;
  triangles?: Numbers | null;
  barycentrics?: Rows | null;
  /** Three vertices of one face for each site, as a Hit has them. */
  corners?: Numbers | null;
}
export interface Edit {
  remove?: Numbers;
  move?: Numbers;
  moveTo?: Numbers | null;
  set?: Numbers;
  setValues?: Numbers | null;
  add?: Numbers | null;
  addValues?: Numbers | null;
}
export interface Isolines {
  positions: Float64Array;
  pointEdges: Uint32Array;
  parameters: Float64Array;
  lineStarts: Uint32Array;
  lineLevels: Uint32Array;
  lineClosed: Int32Array;
}
export interface Skin {
  jointCount: number;
  pivots: Float64Array;
  rotations: Float64Array;
  translations: Float64Array;
  joints: Uint32Array;
  weights: Float32Array;
}

export interface Progress extends Handle {
  readonly fraction: number;
  cancel(): void;
}

/** A mesh, welded, checked, ordered and factorised once. Solvers, poses and the rest are made on it. */
export interface Surface extends Handle {
  readonly vertexCount: number;
  readonly info: Record<string, number>;
  readonly report: Record<string, number>;
  readonly statistics: Record<string, number>;
  readonly components: Uint32Array;
  /** The piece of every vertex (HF_NO_INDEX for isolated ones), and 1 for each vertex of a light piece. */
  readonly pieces: { pieces: Uint32Array; light: Int32Array };
  /** The factor of one kind of field as bytes, for the option savedFactor. */
  save(fieldKind?: number): Uint8Array;
  /** The first triangle on a ray, or null. `positions`: a pose of the surface, null for the rest positions. */
  castRay(
    origin: Numbers,
    direction: Numbers,
    options?: { positions?: Numbers | null; frontOnly?: boolean },
  ): Hit | null;
  /** The vertex nearest to a point, and its distance. */
  findVertex(point: Numbers, options?: { positions?: Numbers | null }): { vertex: number; distance: number };
  spaceLevels(field: Numbers, levelCount: number, spacing?: number): Float64Array;
  traceIsolines(field: Numbers, levels: Numbers): Isolines;
  findCriticalPoints(
    field: Numbers,
  ): { vertex: number; kind: number; index: number; component: number; value: number }[];
  findExtremities(options?: {
    kind?: number;
    leastLengthShare?: number;
    sourceCount?: number;
    geodesics?: Geodesics | null;
    progress?: Progress | null;
  }): { vertex: number; component: number; length: number; position: number[] }[];
  /** Places for handles, pinned ones first; reason is one of HF_HANDLE_REASON_*. */
  proposeHandles(options?: { leastLengthShare?: number; limit?: number; progress?: Progress | null }): {
    vertex: number;
    component: number;
    reason: number;
    pinned: number;
    joint: number;
    position: number[];
    radius: number;
    length: number;
  }[];
}

/** Sites on a surface, and the smooth field through them. */
export interface Solver extends Handle {
  readonly vertexCount: number;
  readonly channelCount: number;
  readonly info: Record<string, number>;
  readonly statistics: Record<string, number>;
  readonly siteCount: number;
  /** What the last solve or solveVectors told: components and vertices that no site reaches. */
  readonly solveInfo: Record<string, number>;
  /** What the last solvePreview told: the error estimate, and components that no site reaches. */
  readonly previewInfo: Record<string, number>;
  clone(): Solver;
  addSites(vertices: Numbers | null, values: Rows | null, options?: SiteOptions): Uint32Array;
  /** One hard site; values: a number, or one for each channel. */
  addSite(vertex: number, values?: number | Numbers | null): number;
  removeSites(sites: Numbers): void;
  moveSites(sites: Numbers, vertices: Numbers | null, options?: SiteOptions): void;
  setValues(sites: Numbers, values: Rows): void;
  editSites(edit: Edit): Uint32Array;
  sites(): {
    sites: Uint32Array;
    vertices: Uint32Array;
    components: Uint32Array;
    values: Float64Array;
    stiffness: Float64Array;
    flux: Float64Array;
    radii: Float64Array;
  };
  record(): void;
  undo(): void;
  redo(): void;
  prepareRebase(): void;
  /** vertexCount * channelCount numbers, into `out` when given. */
  solve<T extends Floats = Float32Array>(out?: T | null, Type?: FloatsType): T;
  solvePreview<T extends Floats = Float32Array>(
    out?: T | null,
    options?: { correctionCount?: number; Type?: FloatsType },
  ): T;
  solveAt(vertices: Numbers): Float64Array;
  solveVectors<T extends Floats = Float32Array>(out?: T | null, Type?: FloatsType): T;
  certify(options?: { tolerance?: number }): Record<string, number>;
  releasePreview(): void;
  moveVectors(sites: Numbers, vertices: Numbers): void;
  rotateVectors(sites: Numbers, angles: Numbers): void;
}

export interface Geodesics extends Handle {
  distance<T extends Floats = Float32Array>(sources: Numbers, out?: T | null, Type?: FloatsType): T;
  /** The shortest path between two places: xyz of its corners; empty where none leads. */
  path(from: Place, to: Place): Float64Array;
  /** The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius (0: no bound). */
  map(centre: Place, radius?: number, out?: Float64Array): Float64Array;
}

export interface QuadMesh {
  positions: Float64Array;
  /** Four vertices for each quad, counter-clockwise. */
  faces: Uint32Array;
  triangles: Uint32Array;
  barycentrics: Float64Array;
  /** Three vertices for each vertex of the quad mesh: those that barycentrics belong to. */
  corners: Uint32Array;
}
export interface Streamlines {
  positions: Float64Array;
  values: Float64Array;
  lineStarts: Uint32Array;
  lineEnds: Uint32Array;
}

export interface QuadOptions {
  faceCount?: number;
  edgeLength?: number;
  relaxCount?: number;
  creaseAngle?: number;
  creaseEdges?: Numbers | null;
  guideVertices?: Numbers | null;
  guideVectors?: Numbers | null;
  guideWeights?: Numbers | null;
  /** Irregular vertices at places that the user drags: three numbers each. */
  irregularPoints?: Numbers | null;
  /** How many quads meet at each irregular vertex: 3 or 5. */
  irregularValences?: Numbers | null;
  /** Three numbers each: one side of the irregular vertex runs along them. 0, 0, 0 is any direction. */
  irregularDirections?: Numbers | null;
  symmetryPlane?: Numbers | null;
  progress?: Progress | null;
}

export interface Quads extends Handle {
  readonly info: Record<string, number>;
  /**
   * Makes the mesh again: for strokes, creases and poles that the user drags. Options that are left out are the
   * defaults. After an error the mesh is what it was.
   */
  update(options?: QuadOptions): void;
  /** Face i has the corners faces[4 * i] to faces[4 * i + 3], counter-clockwise. */
  mesh(): QuadMesh;
}

export interface Region extends Handle {
  readonly info: Record<string, number>;
  clone(): Region;
  /** One edit: what a closed curve encloses; rings more or less; vertices added and removed. */
  edit(edit: {
    curve?: Numbers | null;
    side?: number;
    seedVertex?: number;
    /** HF_CURVE_STRAIGHT (the default) or HF_CURVE_EDGES. */
    curveKind?: number;
    rings?: number;
    add?: Numbers | null;
    remove?: Numbers | null;
    progress?: Progress | null;
  }): void;
  record(): void;
  undo(): void;
  redo(): void;
  /** HF_REGION_INSIDE, HF_REGION_RIM or HF_REGION_SITES. */
  vertices(list?: number): Uint32Array;
  /** xyz of the corners of the last closed curve; the last is joined to the first. */
  curve(): Float64Array;
  /** 0: the surface, 1: its base without detail. */
  morph<T extends Floats = Float32Array>(
    weight: number,
    out?: T | null,
    options?: { normals?: Float32Array | null; Type?: FloatsType },
  ): T;
}

export interface Detail extends Handle {
  /** 0: the target's smooth base, 1: with the source's detail. */
  morph<T extends Floats = Float32Array>(
    weight: number,
    out?: T | null,
    options?: { normals?: Float32Array | null; Type?: FloatsType },
  ): T;
}

export interface Flow extends Handle {
  /**
   * wantedCount lines of equal flux from the minima of a field, or one through every seed vertex; values rise along
   * each.
   */
  trace(field: Numbers, options?: { wantedCount?: number; seeds?: Numbers | null }): Streamlines;
}

export interface Direction extends Handle {
  readonly siteCount: number;
  /** What the last solve told: components and vertices that no site reaches. */
  readonly solveInfo: Record<string, number>;
  clone(): Direction;
  record(): void;
  undo(): void;
  redo(): void;
  sites(): { sites: Uint32Array; vertices: Uint32Array; vectors: Float64Array };
  readonly statistics: Record<string, number>;
  addSites(vertices: Numbers, vectors: Rows): Uint32Array;
  removeSites(sites: Numbers): void;
  moveSites(sites: Numbers, vertices: Numbers): void;
  setVectors(sites: Numbers, vectors: Rows): void;
  rotateSites(sites: Numbers, angles: Numbers): void;
  solve<T extends Floats = Float32Array>(out?: T | null, Type?: FloatsType): T;
  singularities(): { triangle: number; vertex: number; index: number }[];
}

export interface Pose extends Handle {
  readonly vertexCount: number;
  readonly info: Record<string, number>;
  readonly handleCount: number;
  /** What the last deform told: vertices that no handle reaches, iterations, clusters, milliseconds. */
  readonly deformInfo: Record<string, number>;
  clone(): Pose;
  /** inPlace: the handles start where the posed surface stands, not at rest; handleInfo says where. */
  addHandles(
    regions: ReadonlyArray<Numbers> | null,
    options?: { points?: Rows | null; radii?: Numbers | null; layer?: number; inPlace?: boolean },
  ): Uint32Array;
  /** One handle on layer 0: what is edge-connected within `radius` of a point at rest. */
  addHandleAt(point: Numbers, radius: number): number;
  removeHandles(handles: Numbers): void;
  /** Quaternions x, y, z, w and translations, flat; about the handles' centroids. */
  setTransforms(handles: Numbers, motion: { rotations?: Rows | null; translations?: Rows | null }): void;
  /** One handle: a quaternion x, y, z, w and a translation. */
  setTransform(handle: number, motion: { rotation?: Numbers | null; translation?: Numbers | null }): void;
  /** 4 x 4, column by column. */
  setMatrices(handles: Numbers, matrices: Rows): void;
  handleInfo(handle: number): Record<string, any>;
  handleField(handle: number, out?: Float32Array | null): Float32Array;
  deform<T extends Floats = Float32Array>(
    out?: T | null,
    options?: {
      normals?: Float32Array | null;
      Type?: FloatsType;
      iterationCount?: number;
      restart?: number;
      refine?: number;
      refineFromLast?: number;
    },
  ): T;
  skin(influenceCount?: number): Skin;
}

export interface Transfer extends Handle {
  readonly info: Record<string, number>;
  addPairs(
    sourceRegions: ReadonlyArray<Numbers>,
    targetRegions: ReadonlyArray<Numbers>,
    flags?: Numbers | null,
  ): Uint32Array;
  removePairs(pairs: Numbers): void;
  pairInfo(pair: number): Record<string, number>;
  apply<T extends Floats = Float32Array>(
    sourcePositions: Floats,
    out?: T | null,
    options?: { normals?: Float32Array | null; Type?: FloatsType; holds?: Numbers | null; holdPositions?: Rows | null },
  ): T;
  skin(influenceCount?: number): Skin;
}

/** Skin weights of a surface for a skeleton. */
export interface Weights extends Handle {
  readonly info: Record<string, number>;
  clone(): Weights;
  record(): void;
  undo(): void;
  redo(): void;
  setJoints(joints: Joints): void;
  /** Places with given weights: `joints` and `weights` hold as many numbers for each. Replaces all pins. */
  setPins(
    vertices: Numbers | null,
    pins?: { joints?: Numbers; weights?: Numbers; radii?: Numbers | null; progress?: Progress | null },
  ): void;
  /** Replaces all locks; values: a number for each vertex and lock, or null for the present ones. */
  setLocks(joints: Numbers, values?: Float32Array | null): void;
  /** origins: HF_WEIGHTS_* of each vertex. */
  weights(): VertexWeights;
  /** flags: bits HF_JOINT_* of each joint; vertexCounts: vertices that ask for it. */
  joints(): { flags: Uint32Array; vertexCounts: Uint32Array };
  /** Bits HF_HELPER_* of each joint: why it looks like a helper. names: of the joints, or null. */
  helpers(names?: string[] | null): Uint32Array;
}
export interface VertexWeights {
  influenceCount: number;
  joints: Uint32Array;
  weights: Float32Array;
  origins: Uint8Array;
}
/** As many numbers for each vertex in both. */
export interface GivenWeights {
  joints: Numbers;
  weights: Numbers | Float32Array;
}
/** distance and angle (radians): how near a point and its normal must be; 0: the library's own. */
export interface WeightTransferOptions {
  distance?: number;
  angle?: number;
  influenceCount?: number;
  progress?: Progress | null;
}
/** partners: HF_NO_INDEX: find it. plane: a point and a normal; null: find it. to: HF_MIRROR_*. */
export interface MirrorOptions extends WeightTransferOptions {
  names?: string[] | null;
  partners?: Numbers | null;
  plane?: Numbers | null;
  to?: number;
}
export interface Joints {
  heads: Rows;
  tails?: Rows | null;
  axes?: Rows | null;
  parents?: Numbers | null;
  deforms?: Numbers | null;
  sources?: Numbers | null;
  progress?: Progress | null;
}

export interface Hf {
  /** `triangles` as Uint16Array or Uint32Array are read in place. */
  readonly Surface: {
    new (positions: Floats | Numbers, triangles: Numbers | null, options?: SurfaceOptions): Surface;
    /** A surface of a graph: two vertices for each edge, and its weight. */
    fromGraph(vertexCount: number, edges: Numbers, weights: Floats | Numbers, options?: GraphOptions): Surface;
  };
  readonly Solver: new (surface: Surface, options?: SolverOptions) => Solver;
  readonly Pose: new (
    surface: Surface,
    options?: {
      mode?: number;
      bandCount?: number;
      iterationCount?: number;
      rimSiteCount?: number;
      groupCount?: number;
    },
  ) => Pose;
  readonly Transfer: new (
    source: Surface,
    target: Surface,
    options?: {
      mode?: number;
      clusterCount?: number;
      kernelWidth?: number;
      scale?: number;
      alignmentAngle?: number;
      ground?: number;
      sourceAxes?: Numbers;
      targetAxes?: Numbers;
    },
  ) => Transfer;
  readonly Geodesics: new (surface: Surface, options?: { smoothing?: number; method?: number; progress?: Progress | null }) => Geodesics;
  readonly Direction: new (
    surface: Surface,
    options?: { degree?: number; siteLimit?: number; progress?: Progress | null },
  ) => Direction;
  readonly Quads: new (surface: Surface, options?: QuadOptions) => Quads;
  readonly Flow: new (surface: Surface) => Flow;
  /** `positions`: a pose to work on, null for the rest positions. `base`: HF_BASE_*. */
  readonly Region: new (
    surface: Surface,
    options?: { positions?: Floats | Numbers | null; base?: number; progress?: Progress | null },
  ) => Region;
  readonly Detail: new (
    source: Region,
    target: Region,
    options?: {
      sourceVertices?: Numbers | null;
      targetVertices?: Numbers | null;
      scale?: number;
      progress?: Progress | null;
    },
  ) => Detail;
  readonly Weights: new (surface: Surface, joints: Joints, options?: { influenceCount?: number }) => Weights;
  /** Carries weights to another surface: clothes, levels of detail. */
  transferWeights(
    source: Surface,
    given: GivenWeights,
    target: Surface,
    options?: WeightTransferOptions,
  ): VertexWeights & { info: Record<string, number> };
  /** Mirrors weights of one side to the other. heads: three numbers for each joint. */
  mirrorWeights(
    surface: Surface,
    given: GivenWeights,
    heads: Rows,
    options?: MirrorOptions,
  ): VertexWeights & { partners: Uint32Array; pairings: Uint32Array; info: Record<string, unknown> };
  readonly Progress: new () => Progress;
  readonly HfError: typeof HfError;
  readonly constants: Readonly<Record<string, number>>;
  readonly backend: 'native' | 'wasm';
  readonly version: [number, number, number];
}

/**
 * Loads the library. Native: `library` is a path. WebAssembly: `factory` and `wasmBinary` instead of the files in
 * dist/.
 */
export function load(options?: {
  library?: string;
  factory?: unknown;
  wasmBinary?: ArrayBuffer | Uint8Array;
}): Promise<Hf>;
