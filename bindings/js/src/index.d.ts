// Generated from include/hf/*.h by bindings/generate; do not edit. Types of hf-fields: the same for the native and the
// WebAssembly backend.
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

/** A vertex, a hit, or three corners of a triangle and their weights. */
export type PlaceGiven = number | { corners: Numbers; barycentrics: Numbers } | { place: Place };

export interface Handle {
  readonly closed: boolean;
  /** Gives the memory back; later calls do nothing. Objects may be closed in any order, or left to the garbage collector. */
  close(): void;
}

/** Undo on clones: a record is a clone and shares memory with the object. */
export interface Recorded extends Handle {
  /** Keeps the present state for undo(). */
  record(): void;
  /** Goes back to the last record, bit for bit. Without one it throws HF_ERROR_EMPTY. */
  undo(): void;
  /** Goes to the state before the last undo(). Without one since the last record() it throws HF_ERROR_EMPTY. */
  redo(): void;
}

/** What Surface takes beyond its options in the header. */
export interface SurfaceExtras {
  /** Faces instead of triangles. Starts without sizes are offsets, one more than there are faces. */
  faces?: { starts?: Numbers | null; sizes?: Numbers | null; corners: Numbers } | null;
  /** Joins the pieces of a character by links, so that fields and poses span them. */
  linkPieces?: boolean | number | { distance?: number; stiffness?: number; overlayDistance?: number };
  /** With linkPieces: a number per vertex. Pieces of different tags stay apart. */
  tags?: Numbers | null;
}

/** A spring from a vertex to a point of a triangle. Surface.links writes it, hf_links_desc reads it. */
export interface Link {
  /** of your mesh, the first of welded copies */
  vertex: number;
  /** the triangle; a corner of barycentric 0 is ignored and can be constants.HF_NO_INDEX */
  corners: number[];
  /** >= 0, of sum 1 within 1e-3. A single 1 links two vertices */
  barycentrics: number[];
  /** at rest, in the unit of the positions. Ignored when read */
  length: number;
  /** 1: as strong as an edge between two equilateral triangles; > 0 */
  weight: number;
  /** 1: the tree over the pieces has it. Ignored when read */
  inTree: number;
}

/** The options a surface was made with, defaults filled in. */
export interface SurfaceInfo {
  /** of your mesh */
  vertexCount: number;
  /** of your mesh; of faces, the triangles of their cut */
  triangleCount: number;
  /** HF_WELD_* */
  weld: number;
  weldTolerance: number;
  /** HF_OPERATOR_* */
  operatorKind: number;
  /** HF_FIELD_* */
  fieldKind: number;
  /** HF_ORDERING_* */
  ordering: number;
  threadCount: number;
  vertexLimit: number;
  /** 0: eight per vertex of the vertex limit */
  triangleLimit: number;
  /** 0: none */
  memoryLimitMb: number;
  workLimitGflop: number;
  /** of the desc of Surface.fromGraph; 0 for a mesh */
  edgeCount: number;
  /** of a graph, 0: sixteen per vertex of the vertex limit */
  edgeLimit: number;
  /** of your mesh; 0 where triangles were given */
  faceCount: number;
  /** of your mesh */
  cornerCount: number;
}

/**
 * Counts that the surface found in the mesh. A graph has no triangles: its counts of triangles are 0. If faces
 * were given, the report counts collapsed and duplicate faces, and sides of faces as edges. It counts the
 * degenerate triangles of the cut.
 */
export interface SurfaceReport {
  /** of your mesh */
  vertexCount: number;
  /** of your mesh; of faces, the triangles of their cut */
  triangleCount: number;
  /** after welding */
  weldedVertexCount: number;
  /** connected components with at least one triangle (or edge), after welding; linked pieces are one component */
  componentCount: number;
  /** given vertices in no usable triangle (or edge); fields are 0 there */
  isolatedVertexCount: number;
  /** zero area to working precision */
  degenerateTriangleCount: number;
  /** equal corners after welding, or on a line and joining nothing; left out */
  collapsedTriangleCount: number;
  /** the same corners again after welding, in either direction; they do not count in the edges below */
  duplicateTriangleCount: number;
  /** edges of three or more triangles */
  nonManifoldEdgeCount: number;
  /** edges that two triangles run through in the same direction */
  flippedEdgeCount: number;
  boundaryEdgeCount: number;
  /**
   * closed pieces whose triangles face inwards: a mesh turned inside out, or the inner wall of a hollow body.
   * Fields do not change. Results that use normals do
   */
  insideOutCount: number;
  /** vertex of your mesh: the first of such a piece; constants.HF_NO_INDEX without one */
  firstInsideOutVertex: number;
  /** in the unit of the positions, without isolated vertices */
  boundingBoxDiagonal: number;
}

/** Figures of a mesh for developers: its faces, and the weights of its operator. */
export interface MeshStatistics {
  /** faces of more than three corners */
  polygonCount: number;
  /** polygons with a corner farther than 1 % of their diameter from their mean plane */
  nonPlanarCount: number;
  /** corners of the largest face; 0 where triangles were given */
  largestFace: number;
  /** edges of the cut of negative cotangent weight, before any clamping */
  negativeEdgeCount: number;
  /**
   * welded vertices with a changed weight, in the operator of field_kind. A weight is changed if its triangles are
   * too thin, or if a double has too few digits for it. A certificate holds for the weights used; near these
   * vertices the field may differ from the field of the mesh
   */
  changedVertexCount: number;
  /** the first of them in your mesh; constants.HF_NO_INDEX without one */
  firstChangedVertex: number;
  /** radians, over the usable triangles of the cut */
  smallestAngle: number;
}

/** How the pieces of a mesh are linked. */
export interface LinksInfo {
  /** edge-connected pieces, linked or not */
  pieceCount: number;
  /** Surface.links writes them */
  linkCount: number;
  lightPieceCount: number;
  /** pieces without a link, if there are several */
  lonePieceCount: number;
  /**
   * with joint_parents: places where two pieces touch and have no link, such as two feet. Surface.measureGaps
   * measures how far they open
   */
  contactCount: number;
  /** longest link of the tree over the pieces, in the unit of the positions */
  longestTreeLink: number;
}

/** How far linked pieces have opened, in the unit of the positions. */
export interface GapsInfo {
  linkCount: number;
  /** 95 of 100 links opened no more than this; 0 without links */
  percentile95: number;
  /** the widest gap of a link; 0 without links */
  worst: number;
  /** position in Surface.links of the link with that gap; constants.HF_NO_INDEX without links */
  worstLink: number;
  /** as in LinksInfo; the fields above leave contacts out */
  contactCount: number;
  /** the widest gap of a contact; 0 without contacts */
  worstContact: number;
  /** vertex of your mesh in that contact; constants.HF_NO_INDEX without contacts */
  contactVertex: number;
  /** vertices that touch a linked piece at rest, once for each such piece */
  touchingCount: number;
  /** the widest opening of a touching vertex; 0 without one */
  worstOpening: number;
  /** vertex of your mesh with that opening; constants.HF_NO_INDEX where nothing opened */
  openingVertex: number;
}

/**
 * A corner of a triangle that a cut gave another vertex. Give the new vertex what the old one has, and write it
 * into your index array: indices[3 * triangle + corner] = vertex. The old one is what your index array has there.
 * At a seam the copies of a vertex share one new vertex, so what differs between them, such as a UV, belongs to
 * the corner.
 */
export interface CutCorner {
  /** of your mesh */
  triangle: number;
  /** 0, 1 or 2 */
  corner: number;
  /** new since the surface was made */
  vertex: number;
  /** the vertex that it copies, the first of welded copies */
  copied: number;
}

/**
 * Surface.statistics writes sizes and times of a surface here. Times are in milliseconds. Bytes are doubles (exact
 * to 2^53).
 */
export interface SurfaceStatistics {
  /** size of the factored matrix */
  unknownCount: number;
  weldMs: number;
  operatorMs: number;
  orderingMs: number;
  symbolicMs: number;
  numericMs: number;
  /** non-zeros of the Cholesky factor */
  factorEntries: number;
  /** memory of the stored factor with its indices */
  factorBytes: number;
  factorFlops: number;
  /**
   * in use by this surface and everything made on it, and up to 16 work buffers of a field each that calls leave
   * for the next, refused calls too
   */
  memoryBytes: number;
  peakMemoryBytes: number;
  /** to load a saved factor; the times to make it are then 0 */
  loadMs: number;
  /** 1: the factor was loaded */
  factorLoaded: number;
  /** 1: its numbers are read in place; factor_bytes counts them, memory_bytes does not */
  factorBorrowed: number;
  /** to find the links; operator_ms counts them too */
  linksMs: number;
}

/**
 * A place on a surface: a vertex, or a point between three corners of a face. Hit gives a place. Sites, pins,
 * curves, handles and paths take places. A list of places has three forms: `vertices` (4 bytes each), `places`,
 * and `points` in space. Set one of the three.
 */
export interface Place {
  /** vertices of one face of your mesh; a corner of barycentric 0 is ignored and can be constants.HF_NO_INDEX */
  corners: number[];
  /** weights of the corners, >= 0, of sum 1 within 1e-6. A single 1 is a vertex */
  barycentrics: number[];
}

/**
 * A cut as triangles that go and come. The first three arrays fit hf_patch_desc. New vertices and triangles have
 * the numbers after the last ones of your mesh. The arrays are yours: each is null or as large as its capacity.
 */
export interface Cut {
  removedTriangleCount: number;
  newVertexCount: number;
  newTriangleCount: number;
  /** points of the line; the first of a closed line is not repeated */
  rimCount: number;
  /** [removedTriangleCapacity] triangles of your mesh, ascending */
  removedTriangles: Uint32Array;
  /** [newVertexCapacity x 3] in the unit of your mesh */
  newPositions: Float64Array;
  /** [newTriangleCapacity x 3] vertices of your mesh, the first of welded copies, and new ones */
  newTriangles: Uint32Array;
  /**
   * [newVertexCapacity x 3] vertices of your mesh; the new vertex lies between them. Mix their attributes, as skin
   * weights. constants.HF_NO_INDEX where a weight is 0
   */
  vertexCorners: Uint32Array;
  /** [newVertexCapacity x 3] their weights, of sum 1. A single 1 copies a vertex */
  vertexBarycentrics: Float64Array;
  /** [newTriangleCapacity] the removed triangle that each new one is a part of */
  sourceTriangles: Uint32Array;
  /**
   * [newTriangleCapacity x 3 x 3] three weights for each corner of a new triangle, of the corners of its source:
   * for what corners have, as UVs at seams
   */
  cornerBarycentrics: Float64Array;
  /**
   * [rimCapacity x 2] along the line: the vertex on its left and that on its right; one and the same where the
   * line ends inside the surface. At a border between its ends: those after it
   */
  rimVertices: Uint32Array;
}

/** Surface.castRay writes the first triangle that a ray hits here. */
export interface Hit {
  /** 1: a triangle was hit; 0: none, and all else is 0 or constants.HF_NO_INDEX */
  found: number;
  /** or face, of your mesh */
  triangle: number;
  /** its corner nearest to the hit, of your mesh, the first of welded copies */
  vertex: number;
  /**
   * the point hit: corners of the triangle (the first of welded copies) and their barycentrics. A face of more
   * corners is cut into triangles; these are the corners of the triangle hit
   */
  place: Place;
  /** in the unit of the positions */
  position: number[];
  /** from the origin, in lengths of `direction` */
  distance: number;
}

/** Solver.info writes the options of a solver here, with defaults filled in, and the number of its sites. */
export interface SolverInfo {
  /** HF_FIELD_* */
  fieldKind: number;
  channelCount: number;
  siteLimit: number;
  siteCount: number;
  /** vertices of your mesh: rows of a field */
  vertexCount: number;
}

/**
 * Places, values and fluxes of the sites. The arrays are yours; each is null or has `capacity` entries. The
 * entries are ordered by site number.
 */
export interface SitesInfo {
  /** number of sites */
  count: number;
  /** [capacity] numbers */
  sites: Uint32Array;
  /** [capacity] the vertex of the place, constants.HF_NO_INDEX for a point in a triangle */
  vertices: Uint32Array;
  /** [capacity] */
  components: Uint32Array;
  /** [capacity x channelCount] */
  values: Float64Array;
  /** [capacity] 0 = hard */
  stiffness: Float64Array;
  /**
   * [capacity x channelCount] lambda: what flows into the surface at the site, in value x weight; the sum over a
   * disc
   */
  flux: Float64Array;
  /** [capacity] 0 = a point */
  radii: Float64Array;
}

/** The components that the sites of a solve did not reach. */
export interface SolveInfo {
  /** components without a site */
  unreachedComponentCount: number;
  /** constants.HF_NO_INDEX for none */
  firstUnreachedComponent: number;
  /** given vertices in them, isolated ones included */
  unreachedVertexCount: number;
}

/** Counts and errors of a preview. */
export interface PreviewInfo {
  /** 1: solved in double, as Solver.solve does */
  exact: number;
  /** corrections made; 0 when exact */
  correctionCount: number;
  /** components without a site; their vertices hold 0 */
  unreachedComponentCount: number;
  /** largest less smallest site value, the widest over components and channels */
  valueRange: number;
  /** largest change of a value by the last correction: about the error before it */
  largestCorrection: number;
  /**
   * of the largest error, in the unit of the values. Measured when corrections were made, else 1e-5 of
   * value_range; 0 when exact. Infinite where only corrections can measure it: bi-harmonic fields, long shapes,
   * crowded sites
   */
  errorEstimate: number;
  /** memory of the single-precision copy, shared by the surface */
  previewBytes: number;
}

/**
 * The certificate says how accurate a field is. Each error is relative to the range of the site values of its
 * component and channel, and of its targets where it is screened. Where all are equal, it is relative to their
 * size. A value that is not finite counts as infinitely wrong.
 */
export interface Certificate {
  /**
   * 1: the field must keep to the range of its sites: harmonic, intrinsic Delaunay or clamped operator, all sites
   *     at vertices
   */
  overshootChecked: number;
  /** in: largest error to accept, > 0; 0 = 1e-8; out: the one used */
  tolerance: number;
  /** largest less smallest value (or target), the widest over components and channels */
  valueRange: number;
  /** largest |(K u - W lambda)_v| / K_vv, how far a value is from the mean of its neighbours */
  residual: number;
  /** largest |w_i' u + lambda_i / alpha_i - s_i|, what a site misses its value by */
  siteError: number;
  /** how far the field leaves the range of its sites; 0 when not checked */
  overshoot: number;
  /** of your mesh, where the largest of the three is */
  worstVertex: number;
  /**
   * welded vertices with a changed weight (MeshStatistics). The errors hold for the weights used. Harmonic fields
   * on a graph use your own weights, within 1e30 of their median
   */
  changedVertexCount: number;
  /**
   * how far a value may be from the exact field: a bound by K alone where no weight is negative and the field
   * harmonic, else an estimate by corrections
   */
  errorEstimate: number;
}

/** Counts, memory and cost estimates of a solver. Bytes are doubles (exact to 2^53). */
export interface SolverStatistics {
  siteCount: number;
  /** numeric factorisations this solver made; the surface's own is not counted */
  factorisationCount: number;
  /** sparse solves (elimination paths) for added sites */
  pathSolveCount: number;
  /** backward sweeps */
  sweepCount: number;
  /** HF_ROUTE_* of the last edit */
  lastRoute: number;
  /** times sites were moved into the factor */
  rebaseCount: number;
  /** edits by rows of the dense system */
  denseEditCount: number;
  /** sites in the dense system at present */
  denseRowCount: number;
  /** sites that the factor eliminates now */
  eliminatedCount: number;
  /** 1: elimination paths outweigh the factor, fields get slower: Solver.prepareRebase */
  rebaseAdvised: number;
  /** paths and dense part of the sites */
  siteMemoryBytes: number;
  /** the cost model's estimate for the last edit by rows of the dense system ... */
  predictedDenseMs: number;
  /** ... and by a rebase, on one thread of the machine it was measured on; 0: none */
  predictedRebaseMs: number;
}

/**
 * Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 -
 * parameter) a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours: each
 * is null or as large as its capacity.
 */
export interface Isolines {
  pointCount: number;
  lineCount: number;
  /** [pointCapacity x 2] vertices a and b of your mesh, the first of welded copies */
  pointEdges: Uint32Array;
  /** [pointCapacity] 0 to 1 */
  parameters: Float64Array;
  /** [pointCapacity x 3] in the unit and frame of your mesh */
  positions: Float64Array;
  /** [lineCapacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  lineStarts: Uint32Array;
  /** [lineCapacity] position of its level in the list */
  lineLevels: Uint32Array;
  /** [lineCapacity] 1: closed, the first point is not repeated; 0: ends at borders */
  lineClosed: Int32Array;
}

export interface CriticalPoint {
  /** of your mesh, the first of welded copies */
  vertex: number;
  /** HF_CRITICAL_* */
  kind: number;
  /** 1 for extrema (0 for a maximum on a border), -k for a saddle where k + 1 valleys meet */
  index: number;
  /** its piece, as Surface.pieces: links do not count here */
  component: number;
  value: number;
}

export interface CriticalInfo {
  /** minima + maxima + saddles */
  pointCount: number;
  minimumCount: number;
  maximumCount: number;
  /** a saddle of several valleys counts once */
  saddleCount: number;
  /** of all points */
  indexSum: number;
  /** vertices - edges + triangles of the usable surface that has values */
  eulerCharacteristic: number;
}

/**
 * A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end vertices
 * a and b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a triangle has
 * constants.HF_NO_INDEX for both. The arrays are yours: each is null or as large as the capacity.
 */
export interface Path {
  /** 0: no path leads from one to the other */
  pointCount: number;
  /** in the unit of the mesh; -1: no path */
  length: number;
  /** [pointCapacity x 2] vertices a and b of your mesh, the first of welded copies */
  pointEdges: Uint32Array;
  /** [pointCapacity] 0 to 1 */
  parameters: Float64Array;
  /** [pointCapacity x 3] in the unit and frame of your mesh */
  positions: Float64Array;
}

export interface Extremity {
  /** of your mesh, the first of welded copies */
  vertex: number;
  /** its piece, as Surface.pieces: links do not count here */
  component: number;
  /**
   * how far the tip protrudes, in the unit of the mesh. With p the persistence of the peak of the field: sqrt(2 p)
   * for POISSON, p for GEODESIC
   */
  length: number;
  position: number[];
}

/**
 * A singularity is a triangle, or a face, around which the field makes extra turns. They are counted in parts of 1
 * / degree of a full turn.
 */
export interface Singularity {
  /** or face, of your mesh */
  triangle: number;
  /** its corner where the field is shortest, of your mesh; the first of welded copies */
  vertex: number;
  /** in parts of 1 / degree: +1 a source or vortex of a vector field, -1 a saddle */
  index: number;
}

/** The options a direction field was made with, and counts of its constraints and of the work done so far. */
export interface DirectionStatistics {
  degree: number;
  siteLimit: number;
  /** two per vertex */
  unknownCount: number;
  siteCount: number;
  /** the first included; grows when very many constraints go into the factor */
  factorisationCount: number;
  /** two per constraint added or moved */
  pathSolveCount: number;
  sweepCount: number;
  /** vertices whose triangles are not one fan of one orientation */
  irregularVertexCount: number;
  /** constraints that the factor eliminates now */
  eliminatedCount: number;
  operatorMs: number;
  numericMs: number;
  factorEntries: number;
  factorBytes: number;
  siteMemoryBytes: number;
}

/** Pose.info writes the options of a pose here, with defaults filled in, and the number of its handles. */
export interface PoseInfo {
  bandCount: number;
  iterationCount: number;
  groupCount: number;
  handleCount: number;
  /** vertices of your mesh: rows of Pose.deform */
  vertexCount: number;
}

/**
 * A rigid motion of a handle from its rest place. It takes a point p to rotation (p - centroid) + centroid +
 * translation. The centroid is the mean of the region's rest positions, in the unit of the mesh: copies of a
 * vertex along seams count once (Pose.handle writes it).
 */
export interface Transform {
  /** unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free */
  rotation: number[];
  /** up to 1e15 box diagonals */
  translation: number[];
}

/** Pose.handle writes the region of a handle here, its layer, and its motion in the last Pose.deform. */
export interface HandleInfo {
  /** of the region, welded copies counted once */
  vertexCount: number;
  /** of its boundary */
  siteCount: number;
  component: number;
  /** of the rest region, in the unit of the mesh */
  centroid: number[];
  /** how far fields are off on the regions: 0 in poses of Pose */
  leak: number;
  /**
   * of the handle in the last Pose.deform, as in Transform. On a higher layer the motion of the lower layers is
   * included
   */
  rotation: number[];
  /** of the handle, in the same way */
  translation: number[];
  layer: number;
  /** 1: the solve finds the rotation */
  freeRotation: number;
  /** how much of the surface follows; see Pose.setFollowing */
  following: number;
  /** steps on its limb; see Pose.setLimbRefine */
  limbRefine: number;
}

/** The work of a deform. */
export interface DeformInfo {
  /** done */
  iterationCount: number;
  /** in components without a handle; they stay at rest */
  unreachedVertexCount: number;
  /** largest change of a rotation in the last iteration */
  lastChange: number;
}

/** Size of a pose and times of its last deform, in milliseconds; 0 before the first. */
export interface PoseStatistics {
  clusterCount: number;
  solveMs: number;
  blendMs: number;
  normalMs: number;
  /** steps of refine and of limb_refine */
  refineMs: number;
}

/**
 * This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints with
 * fixed vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R (p -
 * pivot) + translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.
 *
 * If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint
 * takes p to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B and
 * that scale, and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be null.
 */
export interface SkinInfo {
  /** joints, one per cluster of vertices and per rigid piece of a transfer */
  jointCount: number;
  vertexCount: number;
  /** [jointCapacity x 3] rest centroid of what each joint moves */
  pivots: Float64Array;
  /** [jointCapacity x 4] quaternion x, y, z, w of the last frame */
  rotations: Float64Array;
  /** [jointCapacity x 3] posed place of the pivot */
  translations: Float64Array;
  /** [jointCapacity x 4] quaternion of B, fixed while handles stay */
  axes: Float64Array;
  /** [jointCapacity x 3] along the axes in the last frame; null = joints are rigid */
  scales?: Float64Array;
  /** [vertexCapacity x influenceCount] */
  vertexJoints: Uint32Array;
  /** [vertexCapacity x influenceCount] of sum 1, descending */
  vertexWeights: Float32Array;
}

/** Pose.blendInfo writes here how the last frame of a pose is blended. */
export interface BlendInfo {
  /** transforms that Pose.blendTransforms writes */
  clusterCount: number;
  /** changes when rows or offsets change: call Pose.blendRows again */
  revision: number;
  /**
   * 0 to 1: share of its offset that a vertex gets. 0 unless handles were added in place or rotations freed; it
   * falls as handles move
   */
  offsetShare: number;
  /** in the unit and frame of the mesh; positions are relative to this point */
  centre: number[];
  /**
   * for culling: the smallest x, y and z of a box that holds all vertices of the last frame. In the unit and frame
   * of the mesh, relative to centre
   */
  low: number[];
  /** the largest x, y and z. The box may be larger than needed: see docs/renderer.md */
  high: number[];
}

/**
 * Receives the rows of a blend. The arrays are yours; each may be null. Positions and offsets are in the unit of
 * the mesh, gradients per unit of the mesh.
 */
export interface BlendRows {
  /** vertices of your mesh */
  vertexCount: number;
  /** entries of all rows together */
  entryCount: number;
  /** entries of the vertex that has the most */
  longestRow: number;
  /** [vertexCapacity x 2] number of the first entry of the vertex, and count of its entries */
  rows: Uint32Array;
  /** [entryCapacity] each below the count of clusters */
  clusters: Uint16Array;
  /** [entryCapacity] multiples of 2^-24; the weights of a vertex sum to 1 */
  weights: Float32Array;
  /** [entryCapacity x 3] of the weights along the rest surface, for normals */
  gradients: Float32Array;
  /** [vertexCapacity x 3] at rest, relative to centre */
  positions: Float32Array;
  /** [vertexCapacity x 3] unit, at rest */
  normals: Float32Array;
  /** [vertexCapacity x 3] 0 unless handles were added in place or rotations freed */
  offsets: Float32Array;
}

/**
 * Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF).
 * The arrays are yours; each may be null. Rows hold the heaviest entries of a vertex, by falling weight. Unused
 * entries have weight 0.
 *
 * The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its weights
 * times the largest distance between the places to which its clusters move it.
 */
export interface BlendInfluences {
  /** vertices of your mesh */
  vertexCount: number;
  /** the largest change of a vertex's weights, 0 to 1: half the sum of the differences */
  change: number;
  /** the same for byte_weights */
  byteChange: number;
  /** the largest distance of a vertex from its place in the last frame, in box diagonals */
  error: number;
  /** the same for byte_weights */
  byteError: number;
  /** [vertexCapacity x influenceCount] each below the count of clusters */
  clusters: Uint16Array;
  /** [vertexCapacity x influenceCount] 65535ths; the weights of a vertex sum to 65535 */
  weights: Uint16Array;
  /** [vertexCapacity x influenceCount] null = not wanted. Refused for more than 256 clusters */
  byteClusters?: Uint8Array;
  /** [vertexCapacity x influenceCount] null = not wanted. 255ths, of sum 255; weights that round to 0 are left out */
  byteWeights?: Uint8Array;
}

/**
 * One proposed handle. position and radius are as in hf_handles_desc: the regions of all proposals are disjoint.
 * If a skeleton with known roles is given, regions has all vertices of a head, a hand or a foot: give these to
 * hf_handles_desc for the whole part. The region of position and radius is then a part of these vertices.
 */
export interface HandleProposal {
  /** nearest to the position; of your mesh, the first of welded copies */
  vertex: number;
  /** as Surface.components */
  component: number;
  /** HF_HANDLE_REASON_* */
  reason: number;
  /** 1: add it at once, it holds the body; 0: offer it, and add it when it is dragged */
  pinned: number;
  /**
   * with a skin: the first joint of a head, hand or foot; for another region the lowest joint that moves more than
   * half of it, together with the joints below. Without a skin: the end joint nearby, or the joint proposed.
   * constants.HF_NO_INDEX = none
   */
  joint: number;
  /** HF_ROLE_* that has most of the weights in the region. A sword has the role of its hand */
  role: number;
  /** HF_SIDE_* of the same joints */
  side: number;
  /** at rest, in the unit and frame of the mesh; inside the surface for a joint and the trunk */
  position: number[];
  /** in the unit of the mesh */
  radius: number;
  /** how far the part protrudes, in the unit of the mesh */
  length: number;
  /** pass it to Pose.setFollowing while the handle is dragged: 1 for a pinned proposal, else 0.25 */
  following: number;
}

/** Counts of a quad mesh. */
export interface QuadsInfo {
  vertexCount: number;
  faceCount: number;
  /** vertices - edges + faces, equal to the Euler characteristic of the usable surface */
  eulerCharacteristic: number;
  /** wanted length, in the unit of the mesh */
  edgeLength: number;
}

/** Quads.mesh writes the quad mesh to these arrays. They are yours: each is null or as large as its capacity. */
export interface QuadsMesh {
  vertexCount: number;
  faceCount: number;
  /** [vertexCapacity x 3] in the unit and frame of your mesh */
  positions: Float64Array;
  /** [faceCapacity x 4] vertices of each quad, counter-clockwise */
  faces: Uint32Array;
  /** [vertexCapacity] triangle or face of your mesh that contains the vertex */
  triangles: Uint32Array;
  /**
   * [vertexCapacity x 3] weights of that triangle's corners, in its own order, of sum 1; in a face of more corners
   * the weights of `corners`
   */
  barycentrics: Float64Array;
  /** [vertexCapacity x 3] vertices of your mesh that barycentrics belong to, the first of welded copies */
  corners: Uint32Array;
}

export interface Streamlines {
  pointCount: number;
  lineCount: number;
  /** [pointCapacity x 3] in the unit and frame of your mesh */
  positions: Float64Array;
  /** [pointCapacity] of the field, rising along every line */
  values: Float64Array;
  /** [lineCapacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  lineStarts: Uint32Array;
  /** [lineCapacity x 2] vertices where it starts and ends, of welded copies the first */
  lineEnds: Uint32Array;
}

/** Counts and areas of a region. Welded copies count as one vertex. */
export interface RegionInfo {
  /** HF_FIELD_* */
  fieldKind: number;
  /** of the region, without its rim */
  vertexCount: number;
  /** vertices next to the region */
  rimCount: number;
  /** vertices that fix the base: the rim, for thin plates two rows or more */
  siteCount: number;
  /** of the triangles with a corner in the region, on the surface, in units^2 */
  area: number;
  /** the same on the base */
  baseArea: number;
}

/** Work of the last edit of a region, and of all its edits. */
export interface RegionStatistics {
  /** sites of the last edit, as in the next two fields */
  insertedCount: number;
  removedCount: number;
  keptCount: number;
  /** numeric factorisations of the region's edits so far */
  factorisationCount: number;
  /** sparse solves for added sites, over all edits */
  pathSolveCount: number;
  /** HF_ROUTE_* of the last edit */
  lastRoute: number;
  /** 1: the last base took a sweep through the whole factor */
  wholeSweep: number;
}

/** Figures of a retarget. Angles, stride and drop count all frames since the last reset. */
export interface RetargetInfo {
  sourceJointCount: number;
  targetJointCount: number;
  /** joints of the target that follow the source */
  matchedJointCount: number;
  /** chains of the target that follow */
  chainCount: number;
  /** 1: keys are copied */
  sameSkeleton: number;
  /** HF_SCALE_* */
  scaleFrom: number;
  frameCount: number;
  /** travel of the target over travel of the source */
  scale: number;
  /** mean angle between the bones of arms and legs and the same bones of the source, radians */
  limbAngle: number;
  /**
   * how far planted feet would travel without the goals, over `scale` times the travel of the source. A clip on
   * the spot needs the least correction if the body moves at scale x stride_share times the speed of the clip
   */
  strideShare: number;
  /** how far the hips sank so that feet reach, unit of the target */
  deepestDrop: number;
}

/**
 * How a chain of the target follows the source. Angles lie between a bone of the target and the same bone of the
 * source, in radians. They are 0 for a chain of one joint, and for a chain whose rest is not aligned.
 */
export interface ChainMatch {
  /** HF_ROLE_* */
  role: number;
  /** HF_SIDE_* */
  side: number;
  sourceJointCount: number;
  targetJointCount: number;
  meanAngle: number;
  worstAngle: number;
}

/**
 * The findings about a character. Confidences are 0 to 1. Lengths are in the unit of the joints; a length is 0
 * where the body has no such part. Lengths of legs belong to the hindmost pair that stands.
 */
export interface SkeletonInfo {
  jointCount: number;
  chainCount: number;
  /** unit axes in the space of the joints */
  up: number[];
  forward: number[];
  /** up x forward */
  left: number[];
  /** a point on the ground in the plane of symmetry */
  middle: number[];
  upConfidence: number;
  forwardConfidence: number;
  leftConfidence: number;
  roleConfidence: number;
  /** along up, over the ground */
  height: number;
  /** hip to knee to foot, and the height of the foot */
  legLength: number;
  /** of the joint of the thigh, over the ground */
  hipHeight: number;
  /** upper arm to hand */
  armLength: number;
}

/** The findings about a joint. */
export interface JointInfo {
  /** HF_JOINT_KIND_* */
  kind: number;
  /** HF_ROLE_*; of a twist joint, the role of its bone */
  role: number;
  /** HF_SIDE_* */
  side: number;
  /** number of its chain, constants.HF_NO_INDEX: none */
  chain: number;
  /** the joint that mirrors it, constants.HF_NO_INDEX: none */
  mate: number;
}

/** Joints of one role and side, from root to tip. */
export interface Chain {
  /** HF_ROLE_* */
  role: number;
  /** HF_SIDE_* */
  side: number;
  /** counts the chains of one role and side: legs from the front, others as their joints come */
  number: number;
  /** the chain it hangs on, constants.HF_NO_INDEX: none */
  parent: number;
  /** its first entry in Skeleton.chainJoints */
  first: number;
  /** entries there, from root to tip */
  jointCount: number;
  /** along the joints, up to the first joint of the chain at its tip */
  length: number;
}

export interface PairInfo {
  flags: number;
  /** of the pair's fields, see HandleInfo */
  sourceLeak: number;
  targetLeak: number;
  /** between the rest directions of the limb, radians; negative when unknown (trunk, short limb) */
  alignmentAngle: number;
  /** 0..1: share of the pair's clusters with enough source vertices */
  confidence: number;
  /** how much of that angle the rest alignment takes away, 0 to 1 */
  alignmentShare: number;
  /** 1: alignment_share is above 0 */
  aligned: number;
  /**
   * 1: the region lies on one side of the source and on the other of the target, by the axes: left and right may
   *     be exchanged
   */
  crossed: number;
}

/** Transfer.info writes counts and the scale of a transfer here. */
export interface TransferInfo {
  pairCount: number;
  clusterCount: number;
  /** pairs whose rest alignment is applied */
  alignedCount: number;
  /** pairs that change sides, see PairInfo */
  crossedCount: number;
  /** 1: from the legs or the boxes; 0: given in the desc */
  scaleFound: number;
  /** lengths of the target over lengths of the source, each in the unit of its mesh */
  scale: number;
}

/** Work of a transfer. */
export interface TransferStatistics {
  /** numeric factorisations by edits of pairs; 0 unless they are very many */
  sourceFactorisationCount: number;
  targetFactorisationCount: number;
}

/**
 * Dials that an animator turns while a transfer plays. Neutral dials give the bits of a transfer without dials,
 * and the result is continuous in each dial.
 */
export interface TransferDials {
  /**
   * the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A planted foot
   * does not slide. The body travels as much farther
   */
  stride: number;
  /**
   * raises the pairs flagged HF_PAIR_TRUNK and HF_PAIR_ANCHOR by this share of their mean height at rest, -0.5 to
   * 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised
   */
  hipHeightShare: number;
  /**
   * pairs flagged HF_PAIR_NECK, together one limb How far a limb follows the source, -1 to 1. At 0 (neutral) the
   * limb plays the source's motion from its own rest direction. At 1 it also gets the rest direction of the
   * source's limb. At -1 it does not move against its root.
   */
  neckFollow: number;
  /** pairs flagged HF_PAIR_TAIL, together one limb */
  tailFollow: number;
  /**
   * turns arms (HF_PAIR_ARM) away from the body, about the forward axis at rest, -pi/2 to pi/2 radians; 0 =
   * neutral
   */
  armSpace: number;
  /**
   * how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less, so that they
   * move as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn against the part
   * before it
   */
  longFollow: number;
}

/** Receives the weights. The arrays are yours; each may be null. */
export interface WeightsOut {
  vertexCount: number;
  /** joints per vertex, 4 or 8 */
  influenceCount: number;
  /** [vertexCapacity x influenceCount] */
  joints: Uint32Array;
  /** [vertexCapacity x influenceCount] descending, of sum exactly 1 */
  weights: Float32Array;
  /** [vertexCapacity] HF_WEIGHTS_* */
  origins: Uint8Array;
}

/** Counts of the weights. Vertices are vertices of your mesh. */
export interface WeightsInfo {
  vertexCount: number;
  jointCount: number;
  pinCount: number;
  lockCount: number;
  /** vertices by HF_WEIGHTS_* */
  informedCount: number;
  solvedCount: number;
  pinnedCount: number;
  nearestCount: number;
  rigidCount: number;
  isolatedCount: number;
}

/** Figures of weights for developers: pieces that were guessed, joints to check, work done. */
export interface WeightsStatistics {
  /** pieces without information */
  nearestPieceCount: number;
  /** small ones of them */
  rigidPieceCount: number;
  /** 1: none of the nearest joints of some piece is in its sight; it uses them nevertheless */
  blind: number;
  /** joints by HF_JOINT_* */
  noLengthCount: number;
  coincidentCount: number;
  informsNoneCount: number;
  outsideCount: number;
  helperCount: number;
  /** numeric factorisations since the object was made */
  factorisationCount: number;
  /** elimination paths of pins since then */
  pathSolveCount: number;
}

/** Counts of transferred weights. Vertices are vertices of the target mesh. */
export interface WeightsTransferInfo {
  vertexCount: number;
  /** vertices by HF_WEIGHTS_* */
  matchedCount: number;
  solvedCount: number;
  nearestCount: number;
  rigidCount: number;
  isolatedCount: number;
  /** pieces without a match */
  guessedPieceCount: number;
}

/** The plane that Weights.mirror found, and counts of joints and vertices. Vertices are vertices of your mesh. */
export interface WeightsMirrorInfo {
  vertexCount: number;
  /** HF_MIRROR_PLANE_* */
  planeFrom: number;
  /** joints by HF_MIRROR_JOINT_* */
  namedCount: number;
  placedCount: number;
  centreCount: number;
  givenCount: number;
  aloneCount: number;
  /** vertices by HF_WEIGHTS_* */
  keptCount: number;
  matchedCount: number;
  solvedCount: number;
  nearestCount: number;
  rigidCount: number;
  isolatedCount: number;
  /** of the plane */
  point: number[];
  normal: number[];
}

/** Distances of a surface and its joints from their reflections, in the unit of the mesh. */
export interface WeightsMirrorStatistics {
  /** the joint farthest off, constants.HF_NO_INDEX: none has a partner */
  worstJoint: number;
  /** the vertex farthest off, constants.HF_NO_INDEX: none was mirrored */
  worstVertex: number;
  /** mean distance of reflected joints from their partners */
  jointOff: number;
  worstJointOff: number;
  /** mean distance of reflected vertices from the surface */
  vertexOff: number;
  worstVertexOff: number;
}

/**
 * Describes a closed curve through at least 3 points, on the mesh at rest. Set one of vertices, places and points.
 * The vertices on the chosen side of the curve are the region. A single vertex joins the region too if all its
 * neighbours but one are in it. The rim is the vertices next to the region, on or beyond the curve. It follows the
 * curve within an edge; where the curve runs along edges, the rim is the curve. A whole border of the surface is a
 * curve too; it has only one side. The curve passes a vertex at most 8 times.
 */
export interface CurveDescGiven {
  /** [pointCount] vertices of your mesh, or null */
  vertices?: Rows | null;
  /** [pointCount], or null */
  places?: readonly PlaceGiven[] | null;
  /**
   * [pointCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for the
   * nearest point of the surface, up to two boxes away
   */
  points?: Rows | null;
  /** HF_SIDE_* */
  side?: number;
  /** with HF_SIDE_SEED */
  seedVertex?: number;
  /** HF_CURVE_* */
  kind?: number;
}

/**
 * Faces of any number of corners. Set corners, and the arrays that your host stores: sizes alone (Maya, USD),
 * starts and sizes (Blender's loops), or starts alone as offsets (newer Blender). Where this interface names a
 * triangle of such a mesh, it names a face.
 *
 * No field depends on how you would cut a face into triangles. HF_OPERATOR_INTRINSIC_DELAUNAY takes the mean of
 * both cuts of a bent quad. It moves this mean towards the polygon Laplacian of Bunge and others 2020 until a
 * weight would become negative; docs/surfaces.md compares errors. HF_OPERATOR_COTANGENT and HF_OPERATOR_CLAMPED
 * use that polygon Laplacian. HF_OPERATOR_UNIFORM uses the sides of the faces. Directions, distances, iso-lines,
 * streamlines and quads work on triangles: the library cuts the faces. Its cut does not depend on the order of the
 * corners. Normals of poses are sums of the area vectors of faces.
 */
export interface FacesDescGiven {
  /** [cornerCount] of uint32_t: vertices, counter-clockwise seen from outside */
  corners?: Rows | null;
  /** null, or [faces] of uint32_t: corners of each face, 3 to 65,535. null: starts give them */
  sizes?: Rows | null;
  /**
   * null, or [faces] of uint32_t: first corner of each face. null: the faces follow one another. Without sizes
   * [faces + 1]: the corners of face f end where face f + 1 starts
   */
  starts?: Rows | null;
}

/** A factor that Surface.save wrote. The surface loads it instead of computing it. */
export interface FactorDescGiven {
  /** all of them, as saved */
  bytes?: Uint8Array | null;
}

/**
 * Says which pieces to link. Joints and weights or tags help the automatic links; each array may be null. A light
 * piece is a sheet over a larger one, such as cloth: it follows the surface below and hardly pulls it.
 */
export interface LinksDescGiven {
  /** [vertexCount x influenceCount] of a skin: pieces of the same joint link sooner */
  joints?: Rows | null;
  /** [vertexCount x influenceCount] of sum 1; where all are 0, a vertex shares no joint */
  weights?: Rows | null;
  /**
   * [jointCount] parent of each joint, constants.HF_NO_INDEX for a root; needs joints and weights. Pieces of
   * parent and child link wherever they touch. Pieces of joints farther apart in the skeleton, such as two feet,
   * link only if nothing else joins them
   */
  jointParents?: Rows | null;
  /**
   * [vertexCount]: pieces with different tags do not link, as a rider and a horse. The first vertex of a piece
   * counts
   */
  tags?: Rows | null;
  /** [linkCount] */
  links?: Rows | null;
  /** [lightCount]: their pieces are light */
  lightVertices?: Rows | null;
  /** [heavyCount]: their pieces are not, as one that gets a site or handle */
  heavyVertices?: Rows | null;
  /** HF_LINK_* */
  mode?: number;
  /** longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal */
  distance?: number;
  /** of all links, times each one's weight; 0 = 1 */
  stiffness?: number;
  /**
   * automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of the diagonal,
   *     below 0: no piece is light unless light_vertices say so
   */
  overlayDistance?: number;
}

/**
 * Lists triangles that go, vertices and triangles that come in, and edges to cut along. Vertices and triangles
 * keep their numbers; new ones follow those there are. New vertices are welded to no other, so two can lie at one
 * place. A vertex without a triangle is isolated from then on, and a new triangle can take it again.
 *
 * A cut gives the vertices along it copies, and the triangles on one side take these. Surface.cuts lists the
 * corners. The end of a cut inside the surface stays one vertex, so a cut takes two edges there. A cut around a
 * part, or from border to border, parts it from the rest: it is a component then.
 */
export interface PatchDescGiven {
  /** [removedTriangleCount] triangles of your mesh */
  removedTriangles?: Rows | null;
  /** [newVertexCount x 3] in the unit of your mesh */
  newPositions?: Rows | null;
  /** [newTriangleCount x 3] vertices of your mesh and new ones */
  newTriangles?: Rows | null;
  /** [cutEdgeCount x 2] the two vertices of an edge */
  cutEdges?: Rows | null;
}

/**
 * Places and values of sites. Set one of vertices, places and points. The finer the mesh, the less influence a
 * point site has. Give the site a radius to avoid this: it then holds the field on a geodesic disc. A radius below
 * the mesh spacing still gives a point. A soft disc shares its stiffness among its vertices. For harmonic fields
 * the boundary vertices of a disc count towards site_limit; for bi-harmonic fields all its vertices do.
 */
export interface SitesDescGiven {
  /** [siteCount] vertices of your mesh, or null */
  vertices?: Rows | null;
  /** [siteCount x channelCount], up to 1e200 in size; null = 0 */
  values?: Rows | null;
  /** [siteCount], or null */
  places?: readonly PlaceGiven[] | null;
  /**
   * [siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for the
   * nearest point of the surface, up to two boxes away
   */
  points?: Rows | null;
  /**
   * [siteCount] >= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard; clamped to 1e-12 to
   * 1e12
   */
  stiffness?: Rows | null;
  /** [siteCount] >= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points */
  radii?: Rows | null;
}

/**
 * The skin of a character: its surface, and the joints of each vertex. These are the arrays of a glTF skin as the
 * file has them: with inverse_binds the library moves the surface from the pose of binding to the pose `rest`.
 */
export interface SkinDescGiven {
  /** [vertexCount x 3] */
  positions?: Rows | null;
  /** [triangleCount x 3], or null with triangle_count 0 */
  triangles?: Rows | null;
  /** [vertexCount x influenceCount] */
  joints?: Rows | null;
  /** [vertexCount x influenceCount] >= 0; a vertex whose weights are all 0 has no joint */
  weights?: Rows | null;
  /**
   * 1: positions are in the pose `rest` and in the space of the joints, also with inverse_binds. 0: in the pose of
   *     inverse_binds if there are any
   */
  atRest?: boolean | number;
}

/**
 * Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one
 * object for one call at a time. If a cancel may come after the end of the call, make a new object for the next
 * call.
 *
 * Creates a progress object.
 */
export interface Progress extends Handle {
  /** Writes how much of the running call is done. */
  readonly fraction: number;
  /** Stops the call that uses this object, or the next one that does. That call returns HF_ERROR_CANCELLED. */
  cancel(): void;
}
export interface ProgressClass {
  new (): Progress;
}

/**
 * hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.
 *
 * Make one surface per mesh, or per graph of your own (Surface.fromGraph). Solvers, poses, direction fields,
 * regions, transfers and quads are made on a surface and share its factor. A surface never changes, so any number
 * of threads may use it: an edit makes another one (Surface.edit). An object made on a surface keeps the data it
 * needs, so you can destroy objects in any order.
 *
 * Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies the
 * mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be dirty: the
 * surface counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices and components.
 * Surface.report gives these counts.
 *
 * A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are
 * doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such as a leaf,
 * hair or a cape, is one sheet with a border. Results give the index of the first of doubled triangles; calls take
 * the index of any. Vertices of the second side alone get opposite normals from poses, and a ray with front_only
 * hits both sides.
 *
 * positions: [vertexCount x 3] of float or double, any unit, any offset
 * triangles: [triangleCount x 3] of uint32_t or uint16_t, counter-clockwise seen from outside
 * weld: HF_WELD_*
 * faces: faces instead of triangles
 * weldTolerance: for HF_WELD_TOLERANCE, in the unit of the positions, > 0
 * operatorKind: HF_OPERATOR_*
 * fieldKind: HF_FIELD_*: the factor made now. Others are made when a solver or region needs one
 * ordering: HF_ORDERING_*
 * threadCount: threads the library may use, yours included, 1 to 256; 0 = 1
 * vertexLimit: refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices, triangles
 *     or edges are always refused
 * triangleLimit: refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the vertex
 *     limit
 * memoryLimitMb: refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
 * workLimitGflop: refuse a factorisation of more than this many 10^9 operations. They are counted before it
 *     begins; 0 = 100,000, about an hour of one core
 * progress: an object to poll and cancel through
 * savedFactor: the saved factor of this mesh; ordering is then 0 or the factor's
 * links: null: HF_LINK_NONE. A saved factor needs the links it was made with
 */
export interface Surface extends Handle {
  readonly vertexCount: number;
  /** Writes the options of a surface. */
  readonly info: SurfaceInfo;
  /** Writes the report of the mesh. */
  readonly report: SurfaceReport;
  /** Writes the statistics of the mesh. */
  readonly meshStatistics: MeshStatistics;
  /**
   * Writes the component of every vertex of your mesh, and constants.HF_NO_INDEX for isolated vertices. Components
   * are numbered in the order of their lowest vertex numbers.
   */
  components(): Uint32Array;
  /** Writes how the pieces of a surface are linked. */
  readonly linksInfo: LinksInfo;
  /**
   * Writes the links of a surface. You can edit them and give them back with HF_LINK_LIST. A list does not say
   * which pieces are light: name them in light_vertices, as Surface.pieces marks them. Then the list alone gives
   * the same surface, bit for bit, without a search.
   */
  links(): Link[];
  /**
   * Writes the piece of every vertex of your mesh, and constants.HF_NO_INDEX for isolated vertices. Pieces are
   * numbered in the order of their lowest vertices.
   */
  pieces(): { pieces: Uint32Array; light: Int32Array };
  /**
   * Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther its
   * ends are apart than at rest, and 0 if they are nearer. The gap of a contact (LinksInfo) is measured in the
   * same way. A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With joint_parents
   * its joint must be the joint of the nearest point there, or the parent or child of that joint. Each touches one
   * point of the piece: the nearest at rest. Its opening is the smaller of two distances, minus the distance at
   * rest: its own distance from the piece, and the distance of the point that it touched from the piece of the
   * vertex. So a piece that slides along another opens no vertex, but its links have gaps. Touching vertices are
   * found where links are: by Surface and Surface.relink. Links that an edit adds have none.
   *
   * positions: [vertexCount x 3] of float or double: the deformed mesh. It can come from a pose, a transfer or any
   *     other source.
   * info: filled in when given
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
   */
  measureGaps(positions: Rows): Float64Array;
  /**
   * Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the old
   * one where its matrix has the same pattern: other stiffness, weights or light pieces.
   *
   * joints: [vertexCount x influenceCount] of a skin: pieces of the same joint link sooner
   * weights: [vertexCount x influenceCount] of sum 1; where all are 0, a vertex shares no joint
   * jointParents: [jointCount] parent of each joint, constants.HF_NO_INDEX for a root; needs joints and weights.
   *     Pieces of parent and child link wherever they touch. Pieces of joints farther apart in the skeleton, such
   *     as two feet, link only if nothing else joins them
   * tags: [vertexCount]: pieces with different tags do not link, as a rider and a horse. The first vertex of a
   *     piece counts
   * links: [linkCount]
   * lightVertices: [lightCount]: their pieces are light
   * heavyVertices: [heavyCount]: their pieces are not, as one that gets a site or handle
   * mode: HF_LINK_*
   * distance: longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal
   * stiffness: of all links, times each one's weight; 0 = 1
   * overlayDistance: automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of
   *     the diagonal, below 0: no piece is light unless light_vertices say so
   * progress: an object to poll and cancel through.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  relink(options?: { joints?: Rows | null; weights?: Rows | null; jointParents?: Rows | null; tags?: Rows | null; links?: Rows | null; lightVertices?: Rows | null; heavyVertices?: Rows | null; mode?: number; distance?: number; stiffness?: number; overlayDistance?: number; progress?: Progress | null }): Surface;
  /**
   * Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it is.
   * The new surface shares the factor: an edit of up to a few thousand vertices costs the elimination paths of its
   * rim, as sites do, and a link costs up to six paths. The library factorises again with the same ordering where
   * that costs less, and for bi-harmonic fields. A surface that is edited back has the fields of the old one.
   *
   * Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes lengths of
   * edges by about half a percent in the mean. A part that must not bend at all is a rigid piece
   * (Pose.setRigidPieces). Bi-harmonic operators square it, so they count at most 100 and at least 0.01. Lengths
   * do not change, so regions, transfers, distances, directions and quads do not see stiffness.
   *
   * A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken up
   * and dropped. The new surface is the one that Surface.relink makes of the same list of links.
   * Surface.components gives the new components. Light pieces and contacts stay as they are.
   *
   * After a patch the surface is the one that Surface makes of the triangles without the removed ones and with the
   * new ones, HF_WELD_NONE for the new vertices. Vertices keep their stiffness. New ones, and those that were
   * isolated, have 1. Distances, directions and quads make a factor of their own when they are first asked for, as
   * on a new surface. Patches over a quarter of the surface, and with HF_OPERATOR_CLAMPED, make the whole operator
   * and its factor anew. Take links out before, and put them in again after it.
   *
   * Solver.moveTo takes sites along, and Pose.moveTo takes handles along. After a patch or a cut make a new pose:
   * Pose.moveTo refuses other triangles. Soft sites keep the unit of their stiffness while links and triangles
   * stay; others change it as they do for Surface.relink. Surface.save is refused: save the factor of the surface
   * before its edits. Memory limits hold for both surfaces together.
   *
   * vertices: [vertexCount] as given; other vertices keep their stiffness. null: all vertices in order
   * stiffness: [vertexCount] 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. null: no stiffness
   *     changes, and vertex_count is 0
   * links: [linkCount] links that come in, after those that stay
   * removedLinks: [removedLinkCount] links that go out, by their numbers in Surface.links
   * patch: triangles that go and come, or a cut; the edit changes nothing else then
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_FOUND, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE,
   * HF_ERROR_UNSUPPORTED.
   */
  edit(options?: { vertices?: Rows | null; stiffness?: Rows | null; links?: Rows | null; removedLinks?: Rows | null; patch?: PatchDescGiven | Rows | null; progress?: Progress | null }): Surface;
  /**
   * Writes the corners that all cuts gave other vertices since the surface was made, in the order of the cuts. A
   * second cut adds its corners behind the corners of the first cut: go on from the last count.
   */
  cuts(): CutCorner[];
  /** Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices. */
  stiffness(): Float64Array;
  /** Writes the statistics of a surface and of the factor it was made with. */
  readonly statistics: SurfaceStatistics;
  /**
   * Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside the mesh
   * and gives them to Surface, which then takes a fraction of the time. The bytes are the same for the same mesh,
   * options and library version, whatever the number of threads. The bytes are little-endian and hold a format
   * version, a hash of the matrix and a checksum. They hold no sites.
   *
   * fieldKind: HF_FIELD_*. If its factor does not exist yet, the call makes it first.
   * progress: an object to poll and cancel through.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_TOO_SMALL.
   */
  save(fieldKind?: number, options?: { progress?: Progress | null }): Uint8Array;
  /**
   * Turns a line on the surface into a cut through triangles. Give the arrays to Surface.edit as a patch, and
   * change your mesh in the same way. The surface itself does not change.
   *
   * A line from border to border, or a closed line around a part, parts it from the rest. A line that starts at
   * the border opens it. An end inside the surface stays closed. The line may pass vertices and run along edges.
   * It is straight where its triangles are unfolded, and bends at its points and at vertices only. The parts of a
   * triangle are a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an edge. On a mesh whose
   * triangles are turned alike, left is left for a viewer who looks at the outside along the line. New vertices
   * have the stiffness 1.
   *
   * vertices: [pointCount] vertices of your mesh, or null
   * places: [pointCount], or null
   * points: [pointCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
   *     the nearest point of the surface, up to two boxes away
   * snapShare: a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer to an
   *     edge than this share of the height moves onto the edge. So no slivers come in. From 1e-6 to 0.4; 0 = 0.05
   * crossingLimit: refuse a line of more points and crossings of edges; 0 = 1,000,000
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
   */
  traceCut(options?: { vertices?: Rows | null; places?: readonly PlaceGiven[] | null; points?: Rows | null; snapShare?: number; crossingLimit?: number; progress?: Progress | null }): Cut;
  /**
   * Finds what a mouse click hits: the first triangle on a ray.
   *
   * origin: [3] in the frame of the positions. The direction can have any length above 0.
   * direction: [3] in the frame of the positions. The direction can have any length above 0.
   * positions: [vertexCount x 3] of float or double: posed positions (Pose.deform writes them). null: the rest
   *     positions
   * frontOnly: 1: a ray passes through triangles seen from behind
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
   */
  castRay(origin: Rows, direction: Rows,
          options?: { positions?: Rows | null; frontOnly?: boolean | number }): Hit | null;
  /**
   * Finds the vertex nearest to a point.
   *
   * point: [3] in the frame of the positions.
   * positions: [vertexCount x 3] of float or double: posed positions (Pose.deform writes them). null: the rest
   *     positions
   * frontOnly: 1: a ray passes through triangles seen from behind
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
   */
  findVertex(point: Rows,
          options?: { positions?: Rows | null; frontOnly?: boolean | number }): { vertex: number; distance: number };
  /**
   * Writes levels, ascending. HF_LEVELS_AREA makes all strips equal in area. HF_LEVELS_LENGTH makes the mean
   * widths of the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the value
   * would crowd them. HF_LEVELS_LENGTH leaves out the parts where the field is flat to 1e-9 of its range.
   *
   * In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of level c.
   * Both are exact for the piecewise linear field. HF_LEVELS_AREA takes equal steps of A. HF_LEVELS_LENGTH takes
   * equal steps of the integral of A'(c) / L(c) dc. That integral is the height on a cylinder and the distance
   * from the pole on a sphere.
   *
   * field: [vertexCount] of float or double.
   * spacing: HF_LEVELS_*.
   * levelCount: 1 to 1,000,000.
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
   */
  spaceLevels(field: Rows, levelCount: number, spacing?: number): Float64Array;
  /**
   * Traces the iso-lines of levels. The levels must be finite and can have any order; the lines come in the order
   * of the levels. A vertex whose value equals a level counts as just above it, so lines have no gaps. A line
   * either closes or ends. It ends at a border or at a triangle without values. At an edge of three or more
   * triangles (non-manifold), these are taken in pairs. A line continues inside a pair, and ends at a triangle
   * without a partner. The function leaves out lines of length zero. Seen from outside a consistently oriented
   * mesh, the field is higher on the left of a line.
   *
   * field: [vertexCount] of float or double.
   * levels: [levelCount].
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
   */
  traceIsolines(field: Rows, levels: Rows): Isolines;
  /**
   * Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each vertex
   * decide (Banchoff 1970). Take its neighbours with lower values and the edges between them. The index of the
   * vertex is 1 minus their Euler characteristic. The vertex number breaks ties, so a flat area has critical
   * points too. The indices sum to the Euler characteristic on every component. On a mesh that is not Delaunay a
   * harmonic field can show an extremum away from its sites, because the default operator uses other edges than
   * the mesh. HF_OPERATOR_CLAMPED uses the edges of the mesh and avoids this.
   *
   * field: [vertexCount] of float or double.
   * info: filled in when given
   *
   * Throws HF_ERROR_NON_FINITE.
   */
  findCriticalPoints(field: Rows): CriticalPoint[];
  /**
   * Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does not
   * depend on the order of the vertices. Pose and meshing change it only within the resolution of the mesh.
   *
   * kind: HF_EXTREMITIES_*
   * leastLengthShare: tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10
   * sourceCount: sources of the mean distance per component, 1 to 1,000; 0 = 40
   * geodesics: for HF_EXTREMITIES_GEODESIC: an object of this surface. If its method is HF_GEODESICS_HEAT its
   *     factor serves; else, and for null, the call makes a factor
   * progress: an object to poll and cancel through
   * field: [vertexCount], packed: the field whose peaks are proposed, 0 at isolated vertices. Unit: length^2
   *     (Poisson), length (geodesic), each up to a constant per component
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT.
   */
  findExtremities(options?: { kind?: number; leastLengthShare?: number; sourceCount?: number; geodesics?: Geodesics | null; progress?: Progress | null; field?: Float64Array | null }): Extremity[];
  /**
   * Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned proposals
   * come first, then the others, each group by length, the longest first. The places do not depend on the order of
   * the vertices. They follow translation and scale. A skeleton gives each proposal the joint that moves it, a
   * role and a side. If its roles are known, feet and the trunk are pinned. Hands, heads, tails and pieces that
   * hang on them, such as a sword, are not. Each head, hand, foot, tail, ear and wing gets at most one proposal. A
   * part that no joint of the skin moves, such as the box that an animator drags, gets none.
   *
   * joints: [jointCount x 3] their places at rest, in the unit and frame of the mesh
   * parents: [jointCount] position of each joint's parent in the list; constants.HF_NO_INDEX for a root
   * skeleton: the skeleton of the mesh, instead of joints and parents. It rests in the unit and frame of the mesh.
   *     If it has a skin, the skin has the vertices of the mesh
   * up: direction away from the ground, of any length; zero = up of the skeleton where it is known, else the y
   *     axis
   * leastLengthShare: as in hf_extremities_desc; 0 = 0.05
   * limit: most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32
   * progress: an object to poll and cancel through
   * regions: [vertexCount]: position in the list of the proposal whose region has the vertex;
   *     constants.HF_NO_INDEX for a vertex of no region
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
   */
  proposeHandles(options?: { joints?: Rows | null; parents?: Rows | null; skeleton?: Skeleton | null; up?: Rows | null; leastLengthShare?: number; limit?: number; progress?: Progress | null; regions?: Uint32Array | null }): HandleProposal[];
  /** What the last call told that writes it. */
  readonly gapsInfo: GapsInfo;
  /** What the last call told that writes it. */
  readonly criticalInfo: CriticalInfo;
}
export interface SurfaceClass {
  new (positions?: Rows | null, triangles?: Rows | null,
          options?: SurfaceExtras & { weld?: number; faces?: FacesDescGiven | Rows | null; weldTolerance?: number; operatorKind?: number; fieldKind?: number; ordering?: number; threadCount?: number; vertexLimit?: number; triangleLimit?: number; memoryLimitMb?: number; workLimitGflop?: number; progress?: Progress | null; savedFactor?: FactorDescGiven | Rows | null; links?: LinksDescGiven | Rows | null }): Surface;
  /**
   * Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call copies the
   * graph. Solvers with sites at vertices, fields, previews, certificates, clones, saved factors, components and
   * reports work as on a mesh. A call that needs triangles returns HF_ERROR_UNSUPPORTED. These are poses, regions,
   * directions, geodesics, iso-lines, extremities, quads, flow, picking, transfers, skin weights, vector fields,
   * links and screening. Sites at places, at points or on discs need triangles too.
   *
   * A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from the
   * median of their component by a factor above 1e30 are limited; MeshStatistics counts their vertices as changed.
   * Bi-harmonic fields limit weights to 1e3 times the median.
   *
   * edges: [edgeCount x 2] of uint32_t or uint16_t: vertices, in any order. The weights of parallel edges are
   *     added up. Self loops are ignored
   * weights: [edgeCount] of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left out
   * masses: [vertexCount] of float or double: M of HF_FIELD_BIHARMONIC, any unit, above 0 and up to 1e100; null:
   *     all 1. A mass below 1e-4 of the mean of its component is raised to it
   * vertexCount: >= 1, also without masses
   * allowNegative: 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of
   *     tetrahedra do. A field can then leave the range of its sites. 0: they are refused
   * fieldKind: HF_FIELD_*: the factor made now. Others are made when a solver asks
   * ordering: HF_ORDERING_*
   * threadCount: threads the library may use, yours included, 1 to 256; 0 = 1
   * vertexLimit: refuse larger graphs before allocating; 0 = 20,000,000
   * edgeLimit: refuse more edges; 0 = sixteen per vertex of the vertex limit
   * memoryLimitMb: refuse to hold more memory than this, in MiB; 0 = no limit
   * workLimitGflop: refuse a factorisation of more than this many 10^9 operations; 0 = 100,000
   * progress: an object to poll and cancel through
   * savedFactor: the saved factor of this graph; ordering is then 0 or the factor's
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  fromGraph(edges?: Rows | null, weights?: Rows | null,
          options?: { masses?: Rows | null; vertexCount?: number; allowNegative?: boolean | number; fieldKind?: number; ordering?: number; threadCount?: number; vertexLimit?: number; edgeLimit?: number; memoryLimitMb?: number; workLimitGflop?: number; progress?: Progress | null; savedFactor?: FactorDescGiven | Rows | null }): Surface;
}

/**
 * A set of sites on a surface, and their field.
 *
 * Creates a solver without sites.
 *
 * fieldKind: HF_FIELD_*; if the surface has no factor of that kind yet, it is made now
 * channelCount: fields solved at once, 1 to 64; 0 = 1
 * siteLimit: at most this many sites; 0 = 100,000
 * progress: an object to poll and cancel through
 */
export interface Solver extends Recorded {
  readonly channelCount: number;
  readonly vertexCount: number;
  /**
   * Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share the
   * factor and the solved sites, so a copy costs its list of sites only. Use one copy per thread or per set of
   * sites. For undo, keep copies: one before each edit.
   */
  clone(): Solver;
  /**
   * Moves a solver to an edited surface. Its sites keep their numbers, values and screening.
   *
   * surface: any number of calls of Surface.edit or Surface.relink make it from the solver's surface, or the
   *     solver's surface from it.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.
   */
  moveTo(surface: Surface): void;
  /** Writes the options of a solver. */
  readonly info: SolverInfo;
  /**
   * Adds sites.
   *
   * vertices: [siteCount] vertices of your mesh, or null
   * values: [siteCount x channelCount], up to 1e200 in size; null = 0
   * places: [siteCount], or null
   * points: [siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
   *     the nearest point of the surface, up to two boxes away
   * stiffness: [siteCount] >= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard; clamped to
   *     1e-12 to 1e12
   * radii: [siteCount] >= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  addSites(vertices?: Rows | null, values?: Rows | null,
          options?: { places?: readonly PlaceGiven[] | null; points?: Rows | null; stiffness?: Rows | null; radii?: Rows | null }): Uint32Array;
  /**
   * Adds one hard site at a vertex.
   *
   * values: [channelCount], or null for 0.
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  addSite(vertex: number, values?: Rows | null): number;
  /**
   * Removes sites by number. The field is 0 on a component that has no site left. If you add a site there again,
   * the field is exact.
   *
   * sites: [siteCount].
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  removeSites(sites: Rows): void;
  /**
   * Moves sites to new places. Each site keeps its number, value, stiffness and radius.
   *
   * sites: [siteCount].
   * vertices: [siteCount] vertices of your mesh, or null
   * values: [siteCount x channelCount], up to 1e200 in size; null = 0
   * places: [siteCount], or null
   * points: [siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
   *     the nearest point of the surface, up to two boxes away
   * stiffness: [siteCount] >= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard; clamped to
   *     1e-12 to 1e12
   * radii: [siteCount] >= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  moveSites(sites: Rows, vertices?: Rows | null, values?: Rows | null,
          options?: { places?: readonly PlaceGiven[] | null; points?: Rows | null; stiffness?: Rows | null; radii?: Rows | null }): void;
  /**
   * Gives sites new values. The call costs nothing until the next solve.
   *
   * sites: [siteCount].
   * values: [siteCount x channelCount].
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_TOO_LARGE.
   */
  setValues(sites: Rows, values: Rows): void;
  /**
   * Applies a batch of edits at once.
   *
   * removeSites: [removeCount]
   * moveSites: [moveCount]
   * setSites: [setCount]
   * setValues: [setCount x channelCount]
   * moveTo: places of [moveCount] sites
   * add: the sites to add
   */
  editSites(options?: { removeSites?: Rows | null; moveSites?: Rows | null; setSites?: Rows | null; setValues?: Rows | null; moveTo?: SitesDescGiven | Rows | null; add?: SitesDescGiven | Rows | null }): Uint32Array;
  /** Returns the number of sites, or 0 for an invalid object. */
  readonly siteCount: number;
  /** Writes all sites. */
  sites(): SitesInfo;
  /**
   * Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H is
   * large, and the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12 times the
   * mean diagonal of K. Such a field needs no site on a component where some H is above 0.
   *
   * screening: [vertexCount] H >= 0, in 1 / length^2 with the unit of the mesh; null removes the screening.
   * targets: [vertexCount x channelCount] p, or null for 0. Both are copied. The values of the first of welded
   *     copies hold for all of them. Sites stay. A site with a radius holds the rim of its disc only. Undo
   *     restores the screening with the sites.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_TOO_LARGE,
   * HF_ERROR_UNSUPPORTED.
   */
  setScreening(screening?: Rows | null, targets?: Rows | null): void;
  /**
   * Solves for the field at every vertex of your mesh, in single or double precision. Hard sites hold their values
   * exactly. The field is 0 on components without a site.
   *
   * out: [vertexCount x channelCount] of float or double.
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE.
   */
  solve(out?: null, options?: { Type?: Float32ArrayConstructor }): Float32Array;
  solve(out: null | undefined, options: { Type: Float64ArrayConstructor }): Float64Array;
  solve<T extends Floats>(out: T | null | undefined, options?: {}): T;
  /**
   * Solves for the field at chosen vertices only, with the same bits as Solver.solve in double. The call reads
   * only those columns of the factor on which these vertices depend (elimination paths), on the calling thread.
   * One path is up to a sixth of the factor, but the paths of many vertices share most of their columns. The call
   * costs a whole solve for bi-harmonic fields, and whenever sites are eliminated in the factor (see
   * Solver.prepareRebase). A vertex of a component without a site gets 0.
   *
   * vertices: [vertexCount].
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  solveAt(vertices: Rows): Float64Array;
  /**
   * Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section
   * 3.3). The channels are the x, y and z of the constraint vectors, and the call solves each as a field. It then
   * projects the vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the area-weighted normal.
   *
   * out: [vertexCount x 3] of float or double, not normalised.
   * normals: [vertexCount x 3], packed: the normals used.
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE.
   */
  solveVectors(out?: null, options?: { Type?: Float32ArrayConstructor; normals?: Float64Array | null }): Float32Array;
  solveVectors(out: null | undefined,
          options: { Type: Float64ArrayConstructor; normals?: Float64Array | null }): Float64Array;
  solveVectors<T extends Floats>(out: T | null | undefined, options?: { normals?: Float64Array | null }): T;
  /**
   * Solves with a single-precision copy of the factor. This reads half the bytes of Solver.solve; use it while the
   * user drags a value or a site. The error is about 1e-6 of the value range for harmonic fields. Bi-harmonic
   * fields, long shapes and crowded sites can have an error of any size: ask for corrections there and read
   * error_estimate. Hard sites at vertices are exact. One correction (iterative refinement, Wilkinson 1963)
   * reduces the error of a harmonic field below 1e-9, a second one below 1e-12. Each correction costs as much as
   * two to three calls of Solver.solve.
   *
   * The first call makes the single-precision copy, which costs about two solves. All solvers of that field kind
   * on the surface share the copy. It is freed with the last of these solvers, or by Solver.releasePreview. A
   * solver whose factor eliminates sites gives the exact field. info.exact is then 1.
   *
   * correctionCount: 0 to 8.
   * out: [vertexCount x channelCount] of float or double, as Solver.solve. Single precision rounds most
   *     corrections away.
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.
   */
  solvePreview(out?: null, options?: { correctionCount?: number; Type?: Float32ArrayConstructor }): Float32Array;
  solvePreview(out: null | undefined,
          options: { correctionCount?: number; Type: Float64ArrayConstructor }): Float64Array;
  solvePreview<T extends Floats>(out: T | null | undefined, options?: { correctionCount?: number }): T;
  /**
   * Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The next
   * preview makes the copy again.
   */
  releasePreview(): void;
  /**
   * Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of
   * edges, from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3).
   *
   * sites: [siteCount].
   * vertices: [siteCount].
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
   * HF_ERROR_OUT_OF_RANGE.
   */
  moveVectors(sites: Rows, vertices: Rows): void;
  /**
   * Turns the vector of site i about its vertex normal, counter-clockwise by angles[i] radians. Does not
   * factorise.
   *
   * sites: [siteCount].
   * angles: [siteCount].
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  rotateVectors(sites: Rows, angles: Rows): void;
  /**
   * Solves the field and checks it against its equations. The check uses only the operator K and the site values.
   * So it finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call returns
   * HF_ERROR_INACCURATE (index = worst vertex) if the check fails, and writes certificate then too. Do not use
   * fields of that solver; make the surface again.
   *
   * tolerance: largest error to accept, > 0; 0 = 1e-8
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INACCURATE, HF_ERROR_INVALID_ARGUMENT.
   */
  certify(options?: { tolerance?: number }): Certificate;
  /**
   * Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It runs
   * on the calling thread, while other threads edit and solve with this solver. The next edit switches to the new
   * factor. Fields before and after are the same up to rounding. Call it on a thread of yours when
   * SolverStatistics.rebase_advised is 1. An edit of very many sites does this by itself when that is quicker.
   * Memory: one more factor, for as long as it eliminates sites.
   *
   * Throws HF_ERROR_BUSY, HF_ERROR_EMPTY.
   */
  prepareRebase(): void;
  /** Writes the statistics. */
  readonly statistics: SolverStatistics;
  /** What the last call told that writes it. */
  readonly solveInfo: SolveInfo;
  /** What the last call told that writes it. */
  readonly previewInfo: PreviewInfo;
}
export interface SolverClass {
  new (surface: Surface,
          options?: { fieldKind?: number; channelCount?: number; siteLimit?: number; progress?: Progress | null }): Solver;
}

/**
 * Computes geodesic distances on one surface: the lengths of shortest paths along it.
 *
 * Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes one
 * numeric factorisation and holds a factor of its own beside the surface's.
 *
 * method: HF_GEODESICS_*
 * smoothing: of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to 10,000; 0
 *     = 1
 * progress: an object to poll and cancel through: creation and every later call report to it
 */
export interface Geodesics extends Handle {
  readonly vertexCount: number;
  /**
   * Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh. The
   * distance is 0 at the sources, and -1 at vertices that no source can reach.
   *
   * sources: [sourceCount] vertices of your mesh; repeats are allowed. Paths follow the triangles and ignore
   *     links. Triangles with the same corners count once: a two-sided sheet measures as a single one. No distance
   *     of EXACT and FRONT is below the straight line to the nearest source. EXACT is right up to rounding. The
   *     error of FRONT falls with the edge length. HEAT rounds the distance off at corners and where two shortest
   *     paths meet.
   * out: [vertexCount] of float or double.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  solve(sources: Rows, out?: null, options?: { Type?: Float32ArrayConstructor }): Float32Array;
  solve(sources: Rows, out: null | undefined, options: { Type: Float64ArrayConstructor }): Float64Array;
  solve<T extends Floats>(sources: Rows, out: T | null | undefined, options?: {}): T;
  /**
   * Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If
   * several are as short, it writes one of them. The path is straight where its triangles are unfolded; it bends
   * at vertices only.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
   * HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.
   */
  findPath(from: PlaceGiven, to: PlaceGiven): Path;
  /**
   * Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A vertex
   * lies at the length of its shortest path from the point, in the direction in which the path starts.
   *
   * radius: vertices farther away get NaN too and take no time; 0 = no bound.
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
   * HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.
   */
  map(centre: PlaceGiven, radius?: number): { map: Float64Array; frame: Float64Array };
}
export interface GeodesicsClass {
  new (surface: Surface, options?: { method?: number; smoothing?: number; progress?: Progress | null }): Geodesics;
}

/**
 * A direction field on a surface, with a factor and constraints of its own.
 *
 * Makes a direction field without constraints. It computes the connection between tangent planes and the operator,
 * and factorises once, with two unknowns per vertex.
 *
 * degree: 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
 * siteLimit: most constraints; 0 = 100,000
 * progress: an object to poll and cancel through
 */
export interface Direction extends Recorded {
  readonly vertexCount: number;
  /**
   * Makes a direction field with the same constraints under the same numbers; it has the same bits. Both share
   * connection and factor, so the copy costs the constraints only. For undo, keep copies: one before each edit.
   */
  clone(): Direction;
  /**
   * Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each
   * constraint costs two sparse triangular solves (elimination paths) and two rows of a small dense system. For a
   * batch of very many constraints, the function factorises once instead, with their vertices eliminated. Later
   * edits cost paths and rows again.
   *
   * vertices: [siteCount] vertices of your mesh.
   * vectors: [siteCount x 3]; a zero vector makes the field 0 there.
   *
   * Throws HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
   * HF_ERROR_TOO_LARGE.
   */
  addSites(vertices: Rows, vectors: Rows): Uint32Array;
  /**
   * Removes constraints by number.
   *
   * sites: [siteCount].
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  removeSites(sites: Rows): void;
  /**
   * Moves constraints to other vertices of the same component. The connection transports each vector along the
   * shortest path of edges, from tangent plane to tangent plane.
   *
   * sites: [siteCount].
   * vertices: [siteCount].
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
   * HF_ERROR_OUT_OF_RANGE.
   */
  moveSites(sites: Rows, vertices: Rows): void;
  /**
   * Gives constraints new vectors and projects them on the tangent planes. Does not factorise.
   *
   * sites: [siteCount].
   * vectors: [siteCount x 3].
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  setVectors(sites: Rows, vectors: Rows): void;
  /**
   * Turns constraint i by angles[i] radians, counter-clockwise seen from outside. Does not factorise.
   *
   * sites: [siteCount].
   * angles: [siteCount].
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  rotateSites(sites: Rows, angles: Rows): void;
  /** Returns the number of constraints, or 0 for an invalid object. */
  readonly siteCount: number;
  /** Writes the constraints. Their numbers ascend. */
  sites(): { sites: Uint32Array; vertices: Uint32Array; vectors: Float64Array };
  /**
   * Writes the field as vectors in space. The vectors are tangent to the surface up to 1e-12 of their length. For
   * degree 2 or 4 the function writes one of the 2 or 4 directions. Constrained vertices hold their vectors;
   * vertices that no constraint reaches get 0.
   *
   * out: [vertexCount x 3] of float or double.
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY.
   */
  solve(out?: null, options?: { Type?: Float32ArrayConstructor }): Float32Array;
  solve(out: null | undefined, options: { Type: Float64ArrayConstructor }): Float64Array;
  solve<T extends Floats>(out: T | null | undefined, options?: {}): T;
  /**
   * Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section 5). On a
   * closed manifold component of one orientation the indices sum to degree times the Euler characteristic.
   *
   * Throws HF_ERROR_EMPTY.
   */
  singularities(): Singularity[];
  /** Writes the statistics. */
  readonly statistics: DirectionStatistics;
  /** What the last call told that writes it. */
  readonly solveInfo: SolveInfo;
}
export interface DirectionClass {
  new (surface: Surface, options?: { degree?: number; siteLimit?: number; progress?: Progress | null }): Direction;
}

/**
 * A set of handles on a surface.
 *
 * Creates a pose without handles.
 *
 * bandCount: bands per field, 2 to 64; 0 = 10
 * iterationCount: iterations of a pose solve, 1 to 1000; 0 = 10
 * groupCount: groups of vertices that share a rotation, 1 to 2000; 0 = 250
 */
export interface Pose extends Recorded {
  readonly vertexCount: number;
  /** Copies a pose with its handles and transforms, so that several threads can pose one rig. */
  clone(): Pose;
  /**
   * Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The next
   * Pose.deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke moves next
   * to nothing, also where handles of free rotation could rest in two poses. With restart the frame equals the
   * frame of a new pose on `surface`, to 1e-6 of the box.
   *
   * surface: any number of calls of Surface.edit or Surface.relink make it from the pose's surface, or the pose's
   *     surface from it.
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.
   */
  moveTo(surface: Surface): void;
  /** Writes the options of a pose. */
  readonly info: PoseInfo;
  /**
   * Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls a
   * posed surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the rigid
   * motion of its region in the last pose (Pose.handle writes it). The surface stays in place (to 1e-6 of the
   * box). It goes over to the best pose of the new handles while handles move by 0.05 of the box, or back to rest.
   * Until then the region of the new handle keeps a part of its bend. restart ends this at once. On a higher layer
   * the surface does not move (to 1e-9 of the box) until you move the handle. Handles of lower layers hold the
   * surface in place for the higher layers.
   *
   * regionVertices: lists of whole numbers: all regions one after the other; null: places are given
   * vertices: [handleCount] vertices of your mesh, or null
   * places: [handleCount], or null
   * points: [handleCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. A point can
   *     lie inside the body, as a joint does: its nearest vertex counts
   * radii: [handleCount] of the regions of places, in the unit of the mesh; null: regions are given. A radius
   *     below 1 % of the box makes regions of 2 vertices or more
   * layer: 0 to HF_LAYER_COUNT - 1, for the whole batch
   * inPlace: 1: handles of layer 0 start on the posed surface, not at rest; see below
   * freeRotation: 1: you give the places alone of all these handles; Pose.setFreeRotations frees single ones
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
   * HF_ERROR_TOO_LARGE.
   */
  addHandles(regionVertices?: ReadonlyArray<Numbers> | null,
          options?: { vertices?: Rows | null; places?: readonly PlaceGiven[] | null; points?: Rows | null; radii?: Rows | null; layer?: number; inPlace?: boolean | number; freeRotation?: boolean | number; progress?: Progress | null }): Uint32Array;
  /**
   * Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all vertices
   * within `radius` of the point that are edge-connected to this vertex.
   *
   * point: [3].
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
   * HF_ERROR_TOO_LARGE.
   */
  addHandleAt(point: Rows, radius: number): number;
  /**
   * Removes handles by number. A handle on a higher layer takes its edit with it: the surface is then, bit for
   * bit, as if the handle had never been added. On layer 0 this holds when you remove the handles that were added
   * last, and for frames with `restart`.
   *
   * handles: [handleCount].
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  removeHandles(handles: Rows): void;
  /**
   * Places handles. On layer 0 a transform is a motion from the rest place. On a higher layer it is an edit in the
   * rest frame of the handle. There the region moves by F (edit) F^-1, with F the rigid motion that the lower
   * layers give the handle. Rotations continue from call to call, so a handle that you dragged past 180 degrees
   * stays turned that far. The transforms take effect at the next Pose.deform.
   *
   * handles: [handleCount].
   * rotations: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
   * translations: up to 1e15 box diagonals
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  setTransforms(handles: Rows, options?: { rotations?: Rows | null; translations?: Rows | null }): void;
  /**
   * Places one handle.
   *
   * rotation: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
   * translation: up to 1e15 box diagonals
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  setTransform(handle: number, options?: { rotation?: Rows | null; translation?: Rows | null }): void;
  /**
   * Frees the rotations of handles, or lets you give them again. A handle of free rotation is a positional
   * constraint (Sorkine and Alexa 2007). Its centroid lands exactly where its transform puts it; the rotation of
   * the transform is ignored. Each Pose.deform finds the rotation together with the pose, and Pose.handle writes
   * it. The rotation has the least as-rigid-as-possible energy. The energy of a pulled group of vertices is
   * measured from a longer and thinner shape than the rest shape of the group. So the rotation is not exactly the
   * rotation of least energy from the rest shape.
   *
   * Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation while the
   * user turns a ring. A given rotation starts at the present rotation of the handle, so the pose does not change.
   * When you free a rotation on layer 0, the surface stays as it is. It releases the old rotation as handles move,
   * as with in_place; so move the handles after this call. On a higher layer a changed handle moves the surface at
   * the next frame. A handle alone in its component keeps its rotation. The first frame of a pose, and a frame
   * with restart, move free handles to their places in 8 steps, as a drag does. Such a frame takes the time of
   * about 8 pose solves. refine keeps the rotation of the smooth pose.
   *
   * handles: [handleCount].
   * freeRotation: 1: the solve finds the rotations; 0: you give them.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND.
   */
  setFreeRotations(handles: Rows, freeRotation?: boolean | number): void;
  /**
   * Sets how much of the surface follows handles of layer 0. Below 1, soft pins hold the surface where it would be
   * without these handles. So a body does not lean after a dragged hand. Where the field of the handle is near 1,
   * the pins are weak, so the limb stays free. Keep 1 for the handles that hold the body, and set less for a
   * handle that is dragged. Every handle still lands exactly, and a limb that is too short gets longer. The next
   * Pose.deform shows a change at once. But a handle that was just added in place leaves the surface where it
   * stands until a handle moves. Full-mesh steps (refine) ignore the pins. Repeated steps (refine_from_last) let
   * the body lean again.
   *
   * handles: [handleCount].
   * following: 0 to 1. At 1 all of the surface follows the handle; a new handle has 1. At 0 only the limb of the
   *     handle follows, such as an arm.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.
   */
  setFollowing(handles: Rows, following?: number): void;
  /**
   * Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. The limb
   * is the part of the surface where the field of the handle falls a long way over little area. It ends at the
   * trunk, or at the next handle on the limb. The steps move the limb alone. All other vertices keep their bits,
   * so the body leans no more than without the steps. A limb that is pulled beyond its length is stretched evenly.
   * The limbs take their steps after the steps of hf_deform_desc.refine. If handles have different counts of
   * steps, all their limbs take the largest count.
   *
   * handles: [handleCount].
   * refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a new handle. With
   *     1, bends stay smooth. With 8 and more, most edges keep their lengths to a few per cent, and the limb bends
   *     like two bones. Edges beside the handle can change more.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.
   */
  setLimbRefine(handles: Rows, refine?: number): void;
  /**
   * Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. Each frame
   * moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near links count
   * most in this fit. If the region of a handle touches a rigid piece, the whole piece joins the region and moves
   * with the handle. A second handle on the same piece is refused (HF_ERROR_CONFLICT). Call this function before
   * you add such handles. Pose.skin writes the motions before this fit.
   *
   * vertices: [vertexCount], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
   *     replaces the previous list.
   *
   * Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  setRigidPieces(vertices: Rows): void;
  /**
   * Places handles by 4 x 4 matrices M.
   *
   * handles: [handleCount].
   * matrices: [handleCount x 16], column by column. The last column is the translation. M moves a rest position p
   *     to the posed position M p. Its linear part must be a rotation within 1e-4; the function takes the nearest
   *     rotation. Its last row must be 0 0 0 1.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
   */
  setMatrices(handles: Rows, matrices: Rows): void;
  /**
   * Writes the info of a handle.
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  handle(handle: number): HandleInfo;
  /** Returns the number of handles, or 0 for an invalid object. */
  readonly handleCount: number;
  /**
   * Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a handle
   * reaches, the fields of all handles sum to 1.
   *
   * out: [vertexCount] of float or double.
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  field(handle: number, out?: null, options?: { Type?: Float32ArrayConstructor }): Float32Array;
  field(handle: number, out: null | undefined, options: { Type: Float64ArrayConstructor }): Float64Array;
  field<T extends Floats>(handle: number, out: T | null | undefined, options?: {}): T;
  /**
   * Does the same as Pose.deform, with the options of a desc.
   *
   * iterationCount: 1 to 1000; 0 = the pose's
   * restart: 1: forget the last pose and start from the fields. The frame then has the bits of a fresh pose with
   *     the same handles, added in the same order, and the same transforms. Without restart a frame continues from
   *     the last one, so it also depends on that
   * refine: 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes about
   *     0.2 us per vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get sharper
   * refineFromLast: 1: the steps go on from the surface of the last call, instead of starting at the smooth pose.
   *     Then one step a frame keeps lengths in a drag as well as 8 do without. If the handles do not move, more
   *     calls converge to the minimum. A restart, or a call without it, forgets that surface. Needs a refine of 1
   *     or more. Higher layers start at the smooth pose. Memory: 72 bytes per vertex
   * firstVertex: outputs hold vertex_count vertices from this one on; 0 and 0: all
   * vertexCount: positions of a range cost only the range; but with higher layers, rigid pieces, refine,
   *     limb_refine or normals they cost the whole surface
   * out: [vertexCount x 3] of float or double: posed positions
   * normals: [vertexCount x 3] of float or double: unit normals of the posed surface, shared across seams
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  deform(out?: null,
          options?: { iterationCount?: number; restart?: boolean | number; refine?: number; refineFromLast?: boolean | number; firstVertex?: number; vertexCount?: number; Type?: Float32ArrayConstructor; normals?: Float32Array | null }): Float32Array;
  deform(out: null | undefined,
          options: { iterationCount?: number; restart?: boolean | number; refine?: number; refineFromLast?: boolean | number; firstVertex?: number; vertexCount?: number; Type: Float64ArrayConstructor; normals?: Float32Array | null }): Float64Array;
  deform<T extends Floats>(out: T | null | undefined,
          options?: { iterationCount?: number; restart?: boolean | number; refine?: number; refineFromLast?: boolean | number; firstVertex?: number; vertexCount?: number; normals?: Float32Array | null }): T;
  /** Writes the statistics of a pose. */
  readonly statistics: PoseStatistics;
  /**
   * Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were
   * added. If the handles do not reach some vertices, a last joint that never moves holds those vertices. The
   * weights of a vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in single precision. Weights
   * and pivots change only when handles are added or removed.
   *
   * The joint motions bring the skin as near as possible to the last Pose.deform, as it is without refine. With
   * scales, classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales, bends and
   * twists replay within 1 per cent and stretched surfaces within about 2.5 per cent.
   *
   * influenceCount: joints per vertex, 4 or 8; 0 = 4
   * scales: [jointCapacity x 3] along the axes in the last frame; null = joints are rigid
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.
   */
  skin(options?: { influenceCount?: number; scales?: boolean }): SkinInfo;
  /**
   * Writes the info of a blend.
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  readonly blendInfo: BlendInfo;
  /**
   * Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts, then
   * with arrays. If handles do not reach some vertices, a last cluster that never moves holds those vertices.
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  blendRows(): BlendRows;
  /**
   * Writes rows of one length. They change with `revision`, as the rows of Pose.blendRows do. Call it without
   * arrays for the count and the errors.
   *
   * influenceCount: clusters of each vertex, the length of a row, 1 to 64; 0 = 8
   * byteClusters: [vertexCapacity x influenceCount] null = not wanted. Refused for more than 256 clusters
   * byteWeights: [vertexCapacity x influenceCount] null = not wanted. 255ths, of sum 255; weights that round to 0
   *     are left out
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  blendInfluences(options?: { influenceCount?: number; byteClusters?: boolean; byteWeights?: boolean }): BlendInfluences;
  /**
   * Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
   * Pose.deform. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as much as
   * Pose.deform.
   *
   * iterationCount: 1 to 1000; 0 = as in hf_pose_desc.
   * restart: 1: as in hf_deform_desc.
   * info: filled in when given
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.
   */
  solve(iterationCount?: number, restart?: boolean | number): void;
  /**
   * Writes the transforms of the clusters in the last Pose.solve or Pose.deform, without its refine. Before the
   * first solve they are identities. After handles were added or removed, solve before you read them: they may be
   * identities until then. The call allocates nothing.
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  blendTransforms(): Float32Array;
  /** What the last call told that writes it. */
  readonly deformInfo: DeformInfo;
}
export interface PoseClass {
  new (surface: Surface, options?: { bandCount?: number; iterationCount?: number; groupCount?: number }): Pose;
}

/**
 * Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature. Creases
 * and borders are straight lines of edges. Irregular vertices are the singularities of the crosses, and places
 * where the function split quads to keep to the surface.
 *
 * The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge
 * lengths, it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal
 * keeps nearer to the surface, so a renderer should split quads into triangles from the first corner. If the mesh
 * stays farther than an edge length from the surface, a limb is lost. Then the function makes up to three finer
 * meshes, and removes rows of quads until the number is right. The function checks every result. Each directed
 * edge occurs once. No face repeats a corner. The result has the Euler characteristic of the surface.
 *
 * The surface may have borders, any genus and several components; the function turns triangles that disagree in
 * orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two. A
 * triangle without a partner gets a border. Surface.report counts such edges. A Moebius band is parted across.
 *
 * With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding.
 * Half of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the side
 * of the normal counts.
 *
 * The user can place irregular vertices and drag them. The function makes each by guides on a ring around the
 * place, an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000 irregular
 * vertices at random places of 20 meshes come out within an edge of the place; such a vertex then moves to the
 * place and stays there. A vertex of 5 quads brings others of 3 with it, because the indices of the crosses sum to
 * four times the Euler characteristic. On a torus or a knot a single one of 5 is often lost.
 *
 * creaseEdges: [creaseCount x 2] the two vertices of each edge, of your mesh
 * guideVertices: [guideCount] vertices of your mesh; guides of one vertex are averaged
 * guideVectors: [guideCount x 3] along the surface, of any length above 0; quads run along the vector and across
 *     it
 * guideWeights: null = all 1, or [guideCount], above 0 to 1: 1 holds the direction. A smaller weight mixes it with
 *     the direction of the curvature, which has the rest of the weight
 * irregularPoints: [irregularCount x 3] at the surface, in the unit and frame of the mesh
 * irregularValences: [irregularCount] how many quads meet there: 3 or 5
 * irregularDirections: null = any, or [irregularCount x 3]: one side of the irregular vertex runs along it; 0 0 0
 *     = any
 * faceCount: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
 * edgeLength: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
 * creaseAngle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 =
 *     none.  If there are more than 1,024 lines of creases and borders, only the longest are kept. Creases nearer
 *     to each other than an edge may be released
 * relaxCount: rounds of tangential relaxation, up to 1,000; 0 = 60; constants.HF_NO_INDEX = none, and the mesh is
 *     not fitted to the surface either
 * symmetryPlane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads
 *     are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the
 *     other side are not used
 * progress: an object to poll and cancel through
 */
export interface Quads extends Handle {
  /**
   * Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. Quads with
   * the same options gives the same result, bit for bit. The first update takes as long. It keeps the tables that
   * do not depend on guides, creases and relax_count. Later updates with the same edge_length, face_count and
   * symmetry_plane take less time. Without relaxation (relax_count = constants.HF_NO_INDEX) they take 0.1 s for
   * 15,000 vertices. Use that while the user drags, and relax_count = 0 at the end. Other sizes and planes are
   * allowed; what belongs to them is made again. After an error `quads` is unchanged. Kept memory: 2 to 4 kB per
   * vertex, until `quads` is destroyed.
   *
   * creaseEdges: [creaseCount x 2] the two vertices of each edge, of your mesh
   * guideVertices: [guideCount] vertices of your mesh; guides of one vertex are averaged
   * guideVectors: [guideCount x 3] along the surface, of any length above 0; quads run along the vector and across
   *     it
   * guideWeights: null = all 1, or [guideCount], above 0 to 1: 1 holds the direction. A smaller weight mixes it
   *     with the direction of the curvature, which has the rest of the weight
   * irregularPoints: [irregularCount x 3] at the surface, in the unit and frame of the mesh
   * irregularValences: [irregularCount] how many quads meet there: 3 or 5
   * irregularDirections: null = any, or [irregularCount x 3]: one side of the irregular vertex runs along it; 0 0
   *     0 = any
   * faceCount: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
   * edgeLength: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
   * creaseAngle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 =
   *     none.  If there are more than 1,024 lines of creases and borders, only the longest are kept. Creases
   *     nearer to each other than an edge may be released
   * relaxCount: rounds of tangential relaxation, up to 1,000; 0 = 60; constants.HF_NO_INDEX = none, and the mesh
   *     is not fitted to the surface either
   * symmetryPlane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads
   *     are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the
   *     other side are not used
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_INTERNAL, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
   */
  update(options?: { creaseEdges?: Rows | null; guideVertices?: Rows | null; guideVectors?: Rows | null; guideWeights?: Rows | null; irregularPoints?: Rows | null; irregularValences?: Rows | null; irregularDirections?: Rows | null; faceCount?: number; edgeLength?: number; creaseAngle?: number; relaxCount?: number; symmetryPlane?: Rows | null; progress?: Progress | null }): void;
  /** Writes the counts. */
  readonly info: QuadsInfo;
  /**
   * Writes every array that is not null.
   *
   * Throws HF_ERROR_TOO_SMALL.
   */
  mesh(): QuadsMesh;
}
export interface QuadsClass {
  new (surface: Surface,
          options?: { creaseEdges?: Rows | null; guideVertices?: Rows | null; guideVectors?: Rows | null; guideWeights?: Rows | null; irregularPoints?: Rows | null; irregularValences?: Rows | null; irregularDirections?: Rows | null; faceCount?: number; edgeLength?: number; creaseAngle?: number; relaxCount?: number; symmetryPlane?: Rows | null; progress?: Progress | null }): Quads;
}

/**
 * A surface that is prepared for tracing streamlines.
 *
 * Prepares a surface for tracing: computes half-edges and weights.
 */
export interface Flow extends Handle {
  readonly vertexCount: number;
  /**
   * Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
   * HF_OPERATOR_CLAMPED the lines are denser where the field is steeper. Surface.traceIsolines gives the lines
   * that cross the streamlines.
   *
   * field: [vertexCount] of float or double.
   * seeds: [seedCount] vertices of your mesh
   * wantedCount: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
   */
  trace(field: Rows, options?: { seeds?: Rows | null; wantedCount?: number }): Streamlines;
}
export interface FlowClass {
  new (surface: Surface): Flow;
}

/**
 * A region of a surface and its smooth base.
 *
 * Creates a region without vertices.
 *
 * positions: [vertexCount x 3] of float or double: positions of the mesh or of a pose. A morph of weight 0 writes
 *     the same bits. null: the positions of the mesh, to 1e-15 of the box. The call copies the array
 * base: HF_BASE_*. If the surface has no factor for it yet, it is made now
 * progress: an object to poll and cancel through
 */
export interface Region extends Recorded {
  readonly vertexCount: number;
  /**
   * Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo, keep
   * copies: one before each edit.
   */
  clone(): Region;
  /**
   * Changes the region and computes its new base. The vertices next to the region (its rim) are sites with their
   * positions as values. Sites that stay cost nothing; the others are one batch as in Solver.editSites. One
   * backward sweep over the factor then gives the base; for a small region the sweep covers only the part of the
   * factor that its vertices need. A region may have several pieces, in several components. Progress covers curve,
   * sites and base; the call can be cancelled between them.
   *
   * removeVertices: [removeCount] vertices that leave the region; others are passed over
   * addVertices: [addCount] vertices that join it; those in it already are passed over
   * ringCount: rings of vertices by which the region grows; below 0 it shrinks
   * curve: the region becomes what this curve encloses
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  edit(options?: { removeVertices?: Rows | null; addVertices?: Rows | null; ringCount?: number; curve?: CurveDescGiven | Rows | null; progress?: Progress | null }): void;
  /** Writes the info of a region. */
  readonly info: RegionInfo;
  /** Writes the statistics of a region. */
  readonly statistics: RegionStatistics;
  /**
   * Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first copy.
   *
   * list: HF_REGION_*.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT.
   */
  vertices(list?: number): Uint32Array;
  /**
   * Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of the positions in
   * hf_region_desc. The last corner is joined to the first. Rings, added and removed vertices leave it as it is.
   */
  curve(): Float64Array;
  /**
   * Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
   * hf_region_desc. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A
   * weight below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p. The call
   * solves nothing.
   *
   * weight: any finite number
   * out: [vertexCount x 3] of float or double, in the unit of the mesh
   * normals: [vertexCount x 3] of float or double: unit normals of the morphed surface, shared across seams
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
   */
  morph(weight?: number, out?: null,
          options?: { Type?: Float32ArrayConstructor; normals?: Float32Array | null }): Float32Array;
  morph(weight: number | undefined, out: null | undefined,
          options: { Type: Float64ArrayConstructor; normals?: Float32Array | null }): Float64Array;
  morph<T extends Floats>(weight: number | undefined, out: T | null | undefined,
          options?: { normals?: Float32Array | null }): T;
}
export interface RegionClass {
  new (surface: Surface, options?: { positions?: Rows | null; base?: number; progress?: Progress | null }): Region;
}

/**
 * The detail of a source region, transferred to a target region. Both may be on one surface or on two.
 *
 * Carries the detail of the source region to the target region. A harmonic map with positive weights takes each
 * region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim) lie on the
 * circle, by arc length between the pairs of desc. Points at the same place in the disc correspond. The function
 * stores the offset from base to surface in a local frame of the source. The axes of the frame are the normal of
 * the base and the direction in which the first disc coordinate grows. It interpolates the offsets in the
 * triangles of the source, and applies them in the same frames of the target. The detail fades to nothing at the
 * rim. If source and target are the same region, the result is the surface itself. Later edits of the regions do
 * not change the object.
 *
 * Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
 *
 * sourceVertices: [pairCount] rim vertices of the source mesh
 * targetVertices: [pairCount] rim vertices of the target mesh
 * scale: of the detail, > 0; 0 = square root of target base area over source base area
 * progress: an object to poll and cancel through
 */
export interface Detail extends Handle {
  readonly vertexCount: number;
  /**
   * Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight
   * (transferred detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the detail
   * as it was on the source. A weight above 1 exaggerates the detail, and a weight below 0 turns it inside out.
   *
   * weight: any finite number
   * out: [vertexCount x 3] of float or double, in the unit of the mesh
   * normals: [vertexCount x 3] of float or double: unit normals of the morphed surface, shared across seams
   *
   * Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
   */
  morph(weight?: number, out?: null,
          options?: { Type?: Float32ArrayConstructor; normals?: Float32Array | null }): Float32Array;
  morph(weight: number | undefined, out: null | undefined,
          options: { Type: Float64ArrayConstructor; normals?: Float32Array | null }): Float64Array;
  morph<T extends Floats>(weight: number | undefined, out: T | null | undefined,
          options?: { normals?: Float32Array | null }): T;
}
export interface DetailClass {
  new (source: Region, target: Region,
          options?: { sourceVertices?: Rows | null; targetVertices?: Rows | null; scale?: number; progress?: Progress | null }): Detail;
}

/**
 * The motion of one skeleton on another.
 *
 * Pairs the joints of two skeletons.
 *
 * sourceRest: [source.jointCount x 10] a pose that counts as rest, or null: the rest of the skeleton. Give poses
 *     in which both characters stand alike
 * targetRest: [target.jointCount x 10] the same for the target, or null
 * rootMotion: HF_ROOT_MOTION_*
 * leaveOut: bits of HF_RETARGET_*
 * scale: travel of the target over travel of the source; 0: the ratio of leg lengths
 * groundVelocity: of the ground under a clip on the spot, in the space of the source, per second; 0: the ground
 *     rests. Skeleton.groundVelocity finds it
 * progress: an object to poll and cancel through
 */
export interface Retarget extends Recorded {
  readonly jointCount: number;
  /** Copies a retarget with the state of its feet: for another character with the same skeletons, and for undo. */
  clone(): Retarget;
  /**
   * Computes the pose of the target. The frame depends on the source pose and on the state of the feet: whether
   * each is planted, and how far it is moved to keep its place. The state comes from the frames since the last
   * reset and fades within a step.
   *
   * sourcePose: [source.jointCount x 10].
   * seconds: time since the last frame, 0 for the first frame and for a repeated frame.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
   */
  solve(sourcePose: Rows, seconds?: number): Float32Array;
  /** Forgets the state of the feet and the figures of the info. Call it where the clip jumps. */
  reset(): void;
  /** Writes the figures. */
  readonly info: RetargetInfo;
  /** Writes how chains follow. */
  chains(): ChainMatch[];
  /**
   * Writes which joint of the source each joint of the target follows. A joint between two gets the nearer, a
   * joint without a partner constants.HF_NO_INDEX.
   */
  partners(): Uint32Array;
}
export interface RetargetClass {
  new (source: Skeleton, target: Skeleton,
          options?: { sourceRest?: Rows | null; targetRest?: Rows | null; rootMotion?: number; leaveOut?: number; scale?: number; groundVelocity?: Rows | null; progress?: Progress | null }): Retarget;
}

/**
 * A skeleton at rest and the findings about it. Calls read the object, none changes it.
 *
 * Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it if
 * feet shall stand on the ground. The object keeps a copy of everything.
 *
 * names: one line for each joint in UTF-8, or null: names then say nothing
 * parents: [jointCount] number of the parent, constants.HF_NO_INDEX for a root
 * rest: [jointCount x 10] joint transforms
 * inverseBinds: [jointCount x 16] inverse bind matrices, columns first. All zero: no skin names the joint; it
 *     moves its children and rigid meshes only. null: the skin is given in the pose `rest`, and every joint can
 *     bend it
 * up: [3] declared axis, any length, or null: find it
 * forward: [3] declared axis, any length, or null: find it
 * roles: [jointCount] declared HF_ROLE_*, -1 for a joint without; or null
 * sides: [jointCount] HF_SIDE_* of joints with a declared role; or null: find the sides
 * travels: [travelCount x 3] where each clip leads from its first to its last frame; it tells forward; or null
 * skin: null: there is none, and joints are judged by names and places alone
 * progress: an object to poll and cancel through
 */
export interface Skeleton extends Handle {
  readonly jointCount: number;
  /**
   * Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a walk.
   * It is 0 for a clip that travels.
   *
   * poses: [frameCount x jointCount x 10].
   * seconds: between two frames, above 0.
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
   */
  groundVelocity(poses: Rows, seconds: number): Float64Array;
  /** Writes the findings. */
  readonly info: SkeletonInfo;
  /** Writes one entry for each joint. */
  joints(): JointInfo[];
  /** Writes the chains. */
  chains(): Chain[];
  /** Writes the joints of chain after chain. */
  chainJoints(): Uint32Array;
  /** Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one line. */
  reasons(): string;
}
export interface SkeletonClass {
  new (names?: string | readonly string[] | null, parents?: Rows | null, rest?: Rows | null,
          options?: { inverseBinds?: Rows | null; up?: Rows | null; forward?: Rows | null; roles?: Rows | null; sides?: Rows | null; travels?: Rows | null; skin?: SkinDescGiven | Rows | null; progress?: Progress | null }): Skeleton;
}

/**
 * hf/transfer.h - play the motion of one surface on another.
 *
 * You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get the
 * same harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place form a
 * cluster. The target takes over the rotations of the source's clusters. Its translations follow from its own
 * shape (Xu, Zhang, Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn about one
 * another. A limb whose parts reach farther than the source's turns less, so that it moves as far: a held sword, a
 * long tail, a large head. The dial long_follow gives it the whole turn.
 *
 * Creates a transfer between two surfaces; both may be the same.
 *
 * sourceRest: [source.vertexCount x 3] of float or double Poses in which the two bodies correspond, in each
 *     surface's unit. null: the positions of the surface. Give a standing pose here for a character bound in a
 *     crouch. Motion is measured from these poses. They do not change the fields.
 * targetRest: [target.vertexCount x 3] of float or double
 * mode: HF_TRANSFER_*
 * clusterCount: 1 to 512. 0 = the larger of 80 and 5 per pair
 * ground: HF_GROUND_*
 * kernelWidth: width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per pair, up to
 *     0.12
 * scale: lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes when
 *     no pair is a foot
 * alignmentAngle: A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6 times
 *     the angle it is not aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative = never.
 * sourceAxes: Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y, forward
 *     +z). Lengths, and right x up = forward, must hold within 1e-3. The library takes the nearest rotation.
 */
export interface Transfer extends Handle {
  readonly vertexCount: number;
  /**
   * Adds pairs.
   *
   * sourceVertices: lists of whole numbers: all regions one after the other; vertices of your mesh, up to 4
   *     entries per vertex
   * targetVertices: lists of whole numbers:
   * flags: [pairCount] HF_PAIR_*, or null for none
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  addPairs(sourceVertices?: ReadonlyArray<Numbers> | null, targetVertices?: ReadonlyArray<Numbers> | null,
          flags?: Rows | null, options?: { progress?: Progress | null }): Uint32Array;
  /**
   * Removes pairs by number.
   *
   * pairs: [pairCount].
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  removePairs(pairs: Rows): void;
  /**
   * Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
   * Transfer.apply has done so. This changes no result.
   *
   * Throws HF_ERROR_NOT_FOUND.
   */
  pair(pair: number): PairInfo;
  /**
   * Writes the info of the whole transfer. The first call after a change of pairs solves fields, as Transfer.pair
   * does.
   *
   * Throws HF_ERROR_EMPTY.
   */
  readonly info: TransferInfo;
  /** Writes the statistics of a transfer. */
  readonly statistics: TransferStatistics;
  /**
   * Sets the dials of a transfer for the next frames.
   *
   * stride: the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A
   *     planted foot does not slide. The body travels as much farther
   * hipHeightShare: raises the pairs flagged HF_PAIR_TRUNK and HF_PAIR_ANCHOR by this share of their mean height
   *     at rest, -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised
   * neckFollow: pairs flagged HF_PAIR_NECK, together one limb How far a limb follows the source, -1 to 1. At 0
   *     (neutral) the limb plays the source's motion from its own rest direction. At 1 it also gets the rest
   *     direction of the source's limb. At -1 it does not move against its root.
   * tailFollow: pairs flagged HF_PAIR_TAIL, together one limb
   * armSpace: turns arms (HF_PAIR_ARM) away from the body, about the forward axis at rest, -pi/2 to pi/2 radians;
   *     0 = neutral
   * longFollow: how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less, so
   *     that they move as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn
   *     against the part before it
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
   */
  setDials(options?: { stride?: number; hipHeightShare?: number; neckFollow?: number; tailFollow?: number; armSpace?: number; longFollow?: number }): void;
  /** Writes the dials; stride is never 0. */
  readonly dials: TransferDials;
  /**
   * Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh. Each
   * frame moves a rigid piece by the rigid motion that fits the piece best, as Pose.setRigidPieces does. This fit
   * is the last step of a frame. So a hold on a part of a rigid piece may miss its position, and a rigid piece may
   * sink into the ground.
   *
   * vertices: [vertexCount], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
   *     replaces the previous list and applies from the next frame on. The call does not factorise.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  setRigidPieces(vertices: Rows): void;
  /**
   * Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest directions
   * differ much on the two surfaces (PairInfo), it takes the direction of the source's limb instead, by a share.
   *
   * The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc alone.
   * Removed pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the same frames,
   * bit for bit. The result changes as little as the source does: a source that stands still except for noise
   * gives a target that stands still.
   *
   * The ground counts too if the mode is HF_TRANSFER_FIELDS and some pairs are anchors (their target region
   * follows the path of the source's region). While a foot of the source stands on the ground, the target's foot
   * follows its scaled path exactly. No vertex of the target sinks deeper into the ground than the source, scaled,
   * except the vertices of Transfer.sinking. A part that would sink bends up. The ground does not move regions
   * that you hold. A lying target rests on the parts that the source rests on. A rigid motion of the whole source
   * is copied unchanged. All rules of the ground come in continuously. The ground is under the feet of each body
   * at rest, and what hangs lower is none: a cape, a tail, scenery. Without feet, or where the trunk is below
   * them, it is the lowest vertex. HF_GROUND_OFF switches it off.
   *
   * sourcePositions: [source.vertexCount x 3] of float or double: the posed source, its own vertex order
   * holdPairs: [holdCount] each pair at most once A hold puts the target region of a pair exactly at a position of
   *     yours, such as a foot on a step or a hand on a rail. The mean of the region's vertices lands there; welded
   *     copies count once. The rest of the surface follows.
   * holdPositions: [holdCount x 3] in the target's unit and frame
   * out: [target.vertexCount x 3] of float or double
   * targetNormals: [target.vertexCount x 3] of float or double
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_TOO_LARGE,
   * HF_ERROR_UNSUPPORTED.
   */
  apply(sourcePositions?: Rows | null, out?: null,
          options?: { holdPairs?: Rows | null; holdPositions?: Rows | null; Type?: Float32ArrayConstructor; targetNormals?: Float32Array | null }): Float32Array;
  apply(sourcePositions: Rows | null | undefined, out: null | undefined,
          options: { holdPairs?: Rows | null; holdPositions?: Rows | null; Type: Float64ArrayConstructor; targetNormals?: Float32Array | null }): Float64Array;
  apply<T extends Floats>(sourcePositions: Rows | null | undefined, out: T | null | undefined,
          options?: { holdPairs?: Rows | null; holdPositions?: Rows | null; targetNormals?: Float32Array | null }): T;
  /**
   * Writes which target vertices may sink into the ground.
   *
   * Throws HF_ERROR_EMPTY.
   */
  sinking(): Uint8Array;
  /**
   * Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the skin
   * replays Transfer.apply exactly, because that function also uses the four largest weights. Each rigid piece is
   * one joint. These joints come after the joints of clusters.
   *
   * influenceCount: joints per vertex, 4 or 8; 0 = 4
   * scales: [jointCapacity x 3] along the axes in the last frame; null = joints are rigid
   *
   * Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.
   */
  skin(options?: { influenceCount?: number; scales?: boolean }): SkinInfo;
}
export interface TransferClass {
  new (source: Surface, target: Surface,
          options?: { sourceRest?: Rows | null; targetRest?: Rows | null; mode?: number; clusterCount?: number; ground?: number; kernelWidth?: number; scale?: number; alignmentAngle?: number; sourceAxes?: Rows | null; targetAxes?: Rows | null }): Transfer;
}

/**
 * The weights of one surface for one skeleton.
 *
 * Computes weights.
 *
 * heads: [jointCount x 3]
 * tails: [jointCount x 3], or null: heads are joints, and the library finds the tails
 * axes: [jointCount x 3] with tails null: where each joint points, any length, a zero vector for unknown; or null.
 *     A joint reaches to the child that lies there, or to the end of the skin. A      child that does      not
 *     deform says where a last joint ends
 * parents: [jointCount] number of the parent, constants.HF_NO_INDEX for a root; null: all are roots
 * deforms: [jointCount] 1: the joint gets weights; null: all do
 * sources: [jointCount] for Weights.setJoints: the number that the joint had before, constants.HF_NO_INDEX for a
 *     new one; null: the same number. Weights: null
 * progress: an object to poll and cancel through
 * influenceCount: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it has none,
 *     it is made now. Sets *weights to null first.
 */
export interface Weights extends Recorded {
  readonly vertexCount: number;
  /**
   * Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of the
   * two is changed. For undo, keep copies: one before each change.
   */
  clone(): Weights;
  /**
   * Replaces all
   *
   * heads: [jointCount x 3]
   * tails: [jointCount x 3], or null: heads are joints, and the library finds the tails
   * axes: [jointCount x 3] with tails null: where each joint points, any length, a zero vector for unknown; or
   *     null.      A joint reaches to the child that lies there, or to the end of the skin. A      child that does
   *     not deform says where a last joint ends
   * parents: [jointCount] number of the parent, constants.HF_NO_INDEX for a root; null: all are roots
   * deforms: [jointCount] 1: the joint gets weights; null: all do
   * sources: [jointCount] for Weights.setJoints: the number that the joint had before, constants.HF_NO_INDEX for a
   *     new one; null: the same number. Weights: null
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT,
   * HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_UNSUPPORTED.
   */
  setJoints(options?: { heads?: Rows | null; tails?: Rows | null; axes?: Rows | null; parents?: Rows | null; deforms?: Rows | null; sources?: Rows | null; progress?: Progress | null }): void;
  /**
   * Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a
   * disc. Pins at the same places with other weights cost no path.
   *
   * vertices: [pinCount] vertices of your mesh, or null
   * places: [pinCount], or null
   * points: [pinCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
   *     the nearest point of the surface, up to two boxes away
   * radii: [pinCount] of the geodesic disc around the place, in the unit of the mesh; null or 0: the place alone
   * joints: [pinCount x influenceCount] joints
   * weights: [pinCount x influenceCount] >= 0, scaled to the sum 1
   * progress: an object to poll and cancel through
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT,
   * HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
   */
  setPins(vertices?: Rows | null,
          options?: { places?: readonly PlaceGiven[] | null; points?: Rows | null; radii?: Rows | null; joints?: Rows | null; weights?: Rows | null; progress?: Progress | null }): void;
  /**
   * Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0
   * unlocks.
   *
   * joints: [lockCount].
   * values: [vertexCount x lockCount] weights to keep, 0 to 1, or null for the present ones. Welded copies take
   *     the values of the first. Pinned vertices keep the weights of their pins.
   *
   * Throws HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
   */
  setLocks(joints: Rows, values?: Rows | null): void;
  /**
   * Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first joint of
   * the vertex.
   *
   * Throws HF_ERROR_TOO_LARGE.
   */
  get(): WeightsOut;
  /**
   * Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not deform have
   * no flags.
   */
  joints(): { flags: Uint32Array; vertexCounts: Uint32Array };
  /** Writes the info. */
  readonly info: WeightsInfo;
  /** Writes the statistics. */
  readonly statistics: WeightsStatistics;
  /**
   * Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal, set
   * deforms to 0.
   *
   * names: one line for each joint in UTF-8, or null.
   *
   * Throws HF_ERROR_INVALID_ARGUMENT.
   */
  helpers(names?: string | readonly string[] | null): Uint32Array;
}
export interface WeightsClass {
  new (surface: Surface,
          options?: { heads?: Rows | null; tails?: Rows | null; axes?: Rows | null; parents?: Rows | null; deforms?: Rows | null; sources?: Rows | null; progress?: Progress | null; influenceCount?: number }): Weights;
  /**
   * Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in
   * the same frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One bi-
   * harmonic field fills in the vertices without such a point. A piece without any takes the weights of the
   * nearest points.
   *
   * joints: [source.vertexCount x sourceInfluenceCount]
   * weights: [source.vertexCount x sourceInfluenceCount] >= 0; a vertex whose weights are all 0 gives none
   * distance: a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal
   * angle: between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees)
   * influenceCount: joints of each vertex in the result: 4 or 8; 0: 4
   * progress: an object to poll and cancel through
   * info: filled in when given
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
   */
  transfer(source: Surface, target: Surface,
          options?: { joints?: Rows | null; weights?: Rows | null; distance?: number; angle?: number; influenceCount?: number; progress?: Progress | null }): WeightsOut & { info: WeightsTransferInfo };
  /**
   * Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights of the
   * nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-harmonic field
   * fills in the rest. The plane comes from joints with partners, else from the surface. The largest component of
   * a found normal is positive. So for a normal along x, HF_MIRROR_TO_NEGATIVE copies from +x to -x.
   *
   * heads: [jointCount x 3] the joints at rest, in the frame of the mesh
   * names: one line for each joint in UTF-8, or null: joints are paired by their places
   * partners: [jointCount] the joint of the other side, constants.HF_NO_INDEX: find it; or null
   * plane: [6] a point and a normal, or null: find the plane
   * joints: [vertexCount x sourceInfluenceCount]
   * weights: [vertexCount x sourceInfluenceCount] >= 0; a vertex whose weights are all 0 gives none
   * to: HF_MIRROR_*
   * distance: as in hf_weights_transfer_desc
   * angle: as in hf_weights_transfer_desc
   * influenceCount: joints of each vertex in the result: 4 or 8; 0: 4
   * progress: an object to poll and cancel through
   * info: filled in when given
   * statistics: filled in when given
   *
   * Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
   * HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
   */
  mirror(surface: Surface,
          options?: { heads?: Rows | null; names?: string | readonly string[] | null; partners?: Rows | null; plane?: Rows | null; joints?: Rows | null; weights?: Rows | null; to?: number; distance?: number; angle?: number; influenceCount?: number; progress?: Progress | null }): WeightsOut & { partners: Uint32Array; pairings: Uint32Array; info: WeightsMirrorInfo; statistics: WeightsMirrorStatistics };
}

/** HF_* of the headers. */
export interface Constants {
  readonly HF_VERSION_MAJOR: 0;
  readonly HF_VERSION_MINOR: 1;
  readonly HF_VERSION_PATCH: 0;
  readonly HF_NO_INDEX: 4294967295;
  readonly HF_MESSAGE_SIZE: 256;
  readonly HF_OK: 0;
  readonly HF_ERROR_INVALID_ARGUMENT: -1;
  readonly HF_ERROR_NULL_POINTER: -2;
  readonly HF_ERROR_INVALID_OBJECT: -3;
  readonly HF_ERROR_INVALID_DESC: -4;
  readonly HF_ERROR_OUT_OF_RANGE: -5;
  readonly HF_ERROR_NON_FINITE: -6;
  readonly HF_ERROR_EMPTY: -7;
  readonly HF_ERROR_NOT_FOUND: -8;
  readonly HF_ERROR_DUPLICATE: -9;
  readonly HF_ERROR_CONFLICT: -10;
  readonly HF_ERROR_UNSUPPORTED: -11;
  readonly HF_ERROR_BUSY: -12;
  readonly HF_ERROR_REENTRANT: -13;
  readonly HF_ERROR_TOO_SMALL: -14;
  readonly HF_ERROR_OUT_OF_MEMORY: -100;
  readonly HF_ERROR_TOO_LARGE: -101;
  readonly HF_ERROR_CANCELLED: -102;
  readonly HF_ERROR_NOT_POSITIVE_DEFINITE: -200;
  readonly HF_ERROR_INACCURATE: -201;
  readonly HF_ERROR_INTERNAL: -300;
  readonly HF_TYPE_PLAIN: 0;
  readonly HF_TYPE_DOUBLE: 1;
  readonly HF_TYPE_UINT16: 2;
  readonly HF_WELD_EXACT: 0;
  readonly HF_WELD_NONE: 1;
  readonly HF_WELD_TOLERANCE: 2;
  readonly HF_OPERATOR_INTRINSIC_DELAUNAY: 0;
  readonly HF_OPERATOR_CLAMPED: 1;
  readonly HF_OPERATOR_UNIFORM: 2;
  readonly HF_OPERATOR_COTANGENT: 3;
  readonly HF_OPERATOR_GRAPH: 4;
  readonly HF_FIELD_HARMONIC: 0;
  readonly HF_FIELD_BIHARMONIC: 1;
  readonly HF_FIELD_BIHARMONIC_GRAPH: 2;
  readonly HF_ORDERING_NESTED_DISSECTION: 0;
  readonly HF_ORDERING_MINIMUM_DEGREE: 1;
  readonly HF_ORDERING_METIS: 2;
  readonly HF_FACTOR_ALIGNMENT: 64;
  readonly HF_LINK_NONE: 0;
  readonly HF_LINK_PIECES: 1;
  readonly HF_LINK_LIST: 2;
  readonly HF_ROUTE_NONE: 0;
  readonly HF_ROUTE_DENSE: 1;
  readonly HF_ROUTE_FRESH: 2;
  readonly HF_ROUTE_REBASE: 3;
  readonly HF_LEVELS_VALUE: 0;
  readonly HF_LEVELS_AREA: 1;
  readonly HF_LEVELS_LENGTH: 2;
  readonly HF_CRITICAL_MINIMUM: 0;
  readonly HF_CRITICAL_MAXIMUM: 1;
  readonly HF_CRITICAL_SADDLE: 2;
  readonly HF_GEODESICS_AUTO: 0;
  readonly HF_GEODESICS_FRONT: 1;
  readonly HF_GEODESICS_EXACT: 2;
  readonly HF_GEODESICS_HEAT: 3;
  readonly HF_EXTREMITIES_POISSON: 0;
  readonly HF_EXTREMITIES_GEODESIC: 1;
  readonly HF_LAYER_COUNT: 8;
  readonly HF_HANDLE_LIMIT: 256;
  readonly HF_HANDLE_REASON_FOOT: 0;
  readonly HF_HANDLE_REASON_TIP: 1;
  readonly HF_HANDLE_REASON_END: 2;
  readonly HF_HANDLE_REASON_JOINT: 3;
  readonly HF_HANDLE_REASON_MIDDLE: 4;
  readonly HF_BASE_DEFAULT: 0;
  readonly HF_BASE_MEMBRANE: 1;
  readonly HF_BASE_THIN_PLATE: 2;
  readonly HF_BASE_THIN_PLATE_GRAPH: 3;
  readonly HF_SIDE_SMALLER: 0;
  readonly HF_SIDE_LARGER: 1;
  readonly HF_SIDE_SEED: 2;
  readonly HF_CURVE_STRAIGHT: 0;
  readonly HF_CURVE_EDGES: 1;
  readonly HF_REGION_INSIDE: 0;
  readonly HF_REGION_RIM: 1;
  readonly HF_REGION_SITES: 2;
  readonly HF_ROOT_MOTION_HIPS: 0;
  readonly HF_ROOT_MOTION_ROOT: 1;
  readonly HF_ROOT_MOTION_IN_PLACE: 2;
  readonly HF_RETARGET_KEEP_RESTS: 1;
  readonly HF_RETARGET_NO_GOALS: 2;
  readonly HF_RETARGET_NO_LOCK: 4;
  readonly HF_RETARGET_NO_COPY: 8;
  readonly HF_SCALE_GIVEN: 0;
  readonly HF_SCALE_LEGS: 1;
  readonly HF_SCALE_HIPS: 2;
  readonly HF_SCALE_HEIGHT: 3;
  readonly HF_ROLE_OTHER: 0;
  readonly HF_ROLE_SPINE: 1;
  readonly HF_ROLE_NECK: 2;
  readonly HF_ROLE_HEAD: 3;
  readonly HF_ROLE_JAW: 4;
  readonly HF_ROLE_SHOULDER: 5;
  readonly HF_ROLE_ARM: 6;
  readonly HF_ROLE_HAND: 7;
  readonly HF_ROLE_FINGER: 8;
  readonly HF_ROLE_LEG: 9;
  readonly HF_ROLE_FOOT: 10;
  readonly HF_ROLE_TOE: 11;
  readonly HF_ROLE_TAIL: 12;
  readonly HF_ROLE_WING: 13;
  readonly HF_ROLE_EAR: 14;
  readonly HF_ROLE_EYE: 15;
  readonly HF_ROLE_ANTENNA: 16;
  readonly HF_ROLE_FIN: 17;
  readonly HF_SIDE_MIDDLE: 0;
  readonly HF_SIDE_LEFT: 1;
  readonly HF_SIDE_RIGHT: 2;
  readonly HF_JOINT_KIND_BODY: 0;
  readonly HF_JOINT_KIND_HELPER: 1;
  readonly HF_JOINT_KIND_END: 2;
  readonly HF_JOINT_KIND_TWIST: 3;
  readonly HF_TRANSFER_FIELDS: 0;
  readonly HF_TRANSFER_STRETCH: 1;
  readonly HF_GROUND_KEEP: 0;
  readonly HF_GROUND_OFF: 1;
  readonly HF_PAIR_ANCHOR: 1;
  readonly HF_PAIR_FOOT: 2;
  readonly HF_PAIR_TRUNK: 4;
  readonly HF_PAIR_NO_ALIGNMENT: 8;
  readonly HF_PAIR_CONTACT: 16;
  readonly HF_PAIR_SINKS: 32;
  readonly HF_PAIR_NECK: 64;
  readonly HF_PAIR_TAIL: 128;
  readonly HF_PAIR_ARM: 256;
  readonly HF_PAIR_LIMIT: 256;
  readonly HF_WEIGHTS_INFORMED: 0;
  readonly HF_WEIGHTS_SOLVED: 1;
  readonly HF_WEIGHTS_PINNED: 2;
  readonly HF_WEIGHTS_NEAREST: 3;
  readonly HF_WEIGHTS_RIGID: 4;
  readonly HF_WEIGHTS_ISOLATED: 5;
  readonly HF_WEIGHTS_MATCHED: 6;
  readonly HF_WEIGHTS_KEPT: 7;
  readonly HF_JOINT_NO_LENGTH: 1;
  readonly HF_JOINT_COINCIDENT: 2;
  readonly HF_JOINT_INFORMS_NONE: 4;
  readonly HF_JOINT_OUTSIDE: 8;
  readonly HF_JOINT_HELPER: 16;
  readonly HF_HELPER_PROPOSED: 1;
  readonly HF_HELPER_NAME_ROOT: 2;
  readonly HF_HELPER_NAME_CONTROL: 4;
  readonly HF_HELPER_NAME_END: 8;
  readonly HF_HELPER_ROOT: 16;
  readonly HF_HELPER_APART: 32;
  readonly HF_HELPER_NO_LENGTH: 64;
  readonly HF_HELPER_COINCIDENT: 128;
  readonly HF_HELPER_OUTSIDE: 256;
  readonly HF_HELPER_INFORMS_NONE: 512;
  readonly HF_MIRROR_TO_NEGATIVE: 0;
  readonly HF_MIRROR_TO_POSITIVE: 1;
  readonly HF_MIRROR_BOTH: 2;
  readonly HF_MIRROR_PLANE_GIVEN: 0;
  readonly HF_MIRROR_PLANE_JOINTS: 1;
  readonly HF_MIRROR_PLANE_SURFACE: 2;
  readonly HF_MIRROR_JOINT_ALONE: 0;
  readonly HF_MIRROR_JOINT_NAMED: 1;
  readonly HF_MIRROR_JOINT_PLACED: 2;
  readonly HF_MIRROR_JOINT_CENTRE: 3;
  readonly HF_MIRROR_JOINT_GIVEN: 4;
}

export interface Api {
  Progress: ProgressClass;
  Surface: SurfaceClass;
  Solver: SolverClass;
  Geodesics: GeodesicsClass;
  Direction: DirectionClass;
  Pose: PoseClass;
  Quads: QuadsClass;
  Flow: FlowClass;
  Region: RegionClass;
  Detail: DetailClass;
  Retarget: RetargetClass;
  Skeleton: SkeletonClass;
  Transfer: TransferClass;
  Weights: WeightsClass;
  HfError: typeof HfError;
  constants: Constants;
  /** Which build the calls go to. In node that is WebAssembly where no native library of the system was found. */
  backend: 'native' | 'wasm';
  version: [number, number, number];
}
export interface LoadOptions {
  /** In node: the path of the shared library. No other is tried. */
  library?: string;
  /** The bytes of hf.wasm, or its address, where a bundler or a host has moved it. */
  wasm?: ArrayBuffer | Uint8Array | URL | string;
  /** The default export of another hf.mjs, such as one with threads; with wasm. */
  factory?: (options: object) => Promise<object>;
}
export function load(options?: LoadOptions): Promise<Api>;
