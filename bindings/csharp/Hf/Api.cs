// Generated from include/hf/*.h by bindings/generate; do not edit. Classes, enums and results of the C# binding.
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>Selects how the surface joins vertices at one place. Modelling tools split vertices at texture seams: a
    /// horse model can have 1,109 separate pieces as stored and be one piece when welded. Functions write results
    /// to every copy of a vertex.</summary>
    public enum Weld
    {
        /// <summary>bit-equal positions (+0 and -0 are equal)</summary>
        Exact = Constants.HF_WELD_EXACT,
        /// <summary>vertices as stored</summary>
        None = Constants.HF_WELD_NONE,
        /// <summary>positions closer than weld_tolerance, transitively</summary>
        Tolerance = Constants.HF_WELD_TOLERANCE,
    }

    /// <summary>Selects the edge weights w_ij of the discrete Laplacian L of a field u: (L u)_i = sum_j w_ij (u_i - u_j).</summary>
    public enum Operator
    {
        /// <summary>cotangent weights of the intrinsic Delaunay triangulation, on the tufted cover where edges are open or
        /// non-manifold (Bobenko and Springborn 2007; Sharp and Crane 2020). Weights are never negative: a field
        /// keeps to the range of its sites on any mesh</summary>
        IntrinsicDelaunay = Constants.HF_OPERATOR_INTRINSIC_DELAUNAY,
        /// <summary>cotangents, at least 1e-3 of the median weight: keeps to the range too</summary>
        Clamped = Constants.HF_OPERATOR_CLAMPED,
        /// <summary>w_ij = 1</summary>
        Uniform = Constants.HF_OPERATOR_UNIFORM,
        /// <summary>w_ij = (cot a_ij + cot b_ij) / 2, the paper's; can be negative at obtuse triangles</summary>
        Cotangent = Constants.HF_OPERATOR_COTANGENT,
        /// <summary>your own weights; only Surface.FromGraph makes it</summary>
        Graph = Constants.HF_OPERATOR_GRAPH,
    }

    /// <summary>Selects the matrix K that a field solves with. A bi-harmonic field is smooth at its sites and overshoots
    /// their values. Its factor is 3 to 4 times larger than a harmonic one, and its solve adds one correction step.</summary>
    public enum FieldKind
    {
        /// <summary>K = L</summary>
        Harmonic = Constants.HF_FIELD_HARMONIC,
        /// <summary>K = L M^-1 L, M the vertex areas scaled to mean 1 by component: does not depend on the scale of the mesh</summary>
        Biharmonic = Constants.HF_FIELD_BIHARMONIC,
        /// <summary>K = L^2, as in the paper: fields change with the density of the vertices</summary>
        BiharmonicGraph = Constants.HF_FIELD_BIHARMONIC_GRAPH,
    }

    /// <summary>Selects how the unknowns are ordered. A good order keeps the factor small.</summary>
    public enum Ordering
    {
        /// <summary>our own; gives the smallest factor</summary>
        NestedDissection = Constants.HF_ORDERING_NESTED_DISSECTION,
        /// <summary>quicker to compute, larger factor on large meshes</summary>
        MinimumDegree = Constants.HF_ORDERING_MINIMUM_DEGREE,
        /// <summary>builds with HF_WITH_GPL only</summary>
        Metis = Constants.HF_ORDERING_METIS,
    }

    /// <summary>Selects how the pieces of a mesh are linked. A piece is an edge-connected part, such as an eye or a plate of
    /// a robot. Without links every piece is a domain of its own: a field or a pose ends where the piece ends.</summary>
    public enum LinkMode
    {
        /// <summary>pieces stay apart. The default, because a scan or a scene may hold bodies that do not belong together;
        /// the programs and bindings for characters link by default</summary>
        None = Constants.HF_LINK_NONE,
        /// <summary>automatic: a tree over the pieces by smallest distance, and all pieces that touch</summary>
        Pieces = Constants.HF_LINK_PIECES,
        /// <summary>the links you give, and no others; only light_vertices name light pieces then</summary>
        List = Constants.HF_LINK_LIST,
    }

    /// <summary>These values say how the solver carried out the last edit of site places (SolverStatistics.last_route).</summary>
    public enum Route
    {
        /// <summary>no place was edited yet</summary>
        None = Constants.HF_ROUTE_NONE,
        /// <summary>rows of the dense system were added and removed</summary>
        Dense = Constants.HF_ROUTE_DENSE,
        /// <summary>the dense system was recomputed, which was quicker</summary>
        Fresh = Constants.HF_ROUTE_FRESH,
        /// <summary>factorised again with hard vertex sites eliminated</summary>
        Rebase = Constants.HF_ROUTE_REBASE,
    }

    /// <summary>Selects how levels divide a field into strips. N levels give N + 1 strips.</summary>
    public enum Levels
    {
        /// <summary>equal steps of the value</summary>
        Value = Constants.HF_LEVELS_VALUE,
        /// <summary>equal areas: the strips cover the same area each</summary>
        Area = Constants.HF_LEVELS_AREA,
        /// <summary>equal mean widths: the width of a strip is its area over the mean length of its lines</summary>
        Length = Constants.HF_LEVELS_LENGTH,
    }

    public enum Critical
    {
        Minimum = Constants.HF_CRITICAL_MINIMUM,
        Maximum = Constants.HF_CRITICAL_MAXIMUM,
        Saddle = Constants.HF_CRITICAL_SADDLE,
    }

    /// <summary>Selects how distances are computed. docs/geodesics.md has the errors of each.</summary>
    public enum DistanceMethod
    {
        /// <summary>EXACT up to 10,000 vertices, FRONT beyond</summary>
        Auto = Constants.HF_GEODESICS_AUTO,
        /// <summary>fast: circular fronts on the intrinsic Delaunay triangulation (Novotni and Klein 2002)</summary>
        Front = Constants.HF_GEODESICS_FRONT,
        /// <summary>exact up to rounding: windows (Mitchell, Mount and Papadimitriou 1987)</summary>
        Exact = Constants.HF_GEODESICS_EXACT,
        /// <summary>smooth, and least exact: the heat method (Crane, Weischedel and Wardetzky 2013)</summary>
        Heat = Constants.HF_GEODESICS_HEAT,
    }

    /// <summary>Selects how Surface.FindExtremities finds tips. Both kinds take the maxima of a field that rises towards
    /// protruding parts.</summary>
    public enum ExtremityKind
    {
        /// <summary>a field with a source at every vertex: one solve</summary>
        Poisson = Constants.HF_EXTREMITIES_POISSON,
        /// <summary>mean geodesic distance to the rest of the component (Hilaga et al. 2001)</summary>
        Geodesic = Constants.HF_EXTREMITIES_GEODESIC,
    }

    /// <summary>Says why a place is proposed as a handle.</summary>
    public enum HandleReason
    {
        /// <summary>stands on the ground: the surface rises from it along a leg</summary>
        Foot = Constants.HF_HANDLE_REASON_FOOT,
        /// <summary>a protruding part ends there: head, tail, hand, horn (Surface.FindExtremities)</summary>
        Tip = Constants.HF_HANDLE_REASON_TIP,
        /// <summary>one of the two ends of a component without feet or tips</summary>
        End = Constants.HF_HANDLE_REASON_END,
        /// <summary>a joint of the given skeleton: an end, or where it branches. Or a head, hand or foot that is no tip of
        /// the surface</summary>
        Joint = Constants.HF_HANDLE_REASON_JOINT,
        /// <summary>The trunk of the largest component: the chest of a biped; pinned, inside the surface. With a skeleton of
        /// an upright body, the vertices of chest and shoulders are held, up to the neck</summary>
        Middle = Constants.HF_HANDLE_REASON_MIDDLE,
    }

    /// <summary>The smooth base of a region.</summary>
    public enum Base
    {
        /// <summary>THIN_PLATE</summary>
        Default = Constants.HF_BASE_DEFAULT,
        /// <summary>harmonic: the least area for its rim, nearly; it meets the rim with a crease</summary>
        Membrane = Constants.HF_BASE_MEMBRANE,
        /// <summary>bi-harmonic (FieldKind.Biharmonic): leaves the surface around it without a crease</summary>
        ThinPlate = Constants.HF_BASE_THIN_PLATE,
        /// <summary>the paper's bi-harmonic field (FieldKind.BiharmonicGraph)</summary>
        ThinPlateGraph = Constants.HF_BASE_THIN_PLATE_GRAPH,
    }

    /// <summary>A closed curve cuts the surface in two. The side says which part becomes the region. Where a curve along
    /// edges touches itself there are more parts: SMALLER takes all but the largest, SEED the part of its vertex.</summary>
    public enum Side
    {
        /// <summary>the side of smaller area</summary>
        Smaller = Constants.HF_SIDE_SMALLER,
        /// <summary>the side of larger area</summary>
        Larger = Constants.HF_SIDE_LARGER,
        /// <summary>the side that seed_vertex lies in</summary>
        Seed = Constants.HF_SIDE_SEED,
    }

    /// <summary>How the points of a curve are joined: each to the next, and the last to the first.</summary>
    public enum CurveKind
    {
        /// <summary>by shortest paths along the surface, through triangles, exact up to rounding</summary>
        Straight = Constants.HF_CURVE_STRAIGHT,
        /// <summary>by shortest paths along edges; points in triangles stand for their nearest corner</summary>
        Edges = Constants.HF_CURVE_EDGES,
    }

    /// <summary>Lists of vertices of a region.</summary>
    public enum RegionList
    {
        /// <summary>the region</summary>
        Inside = Constants.HF_REGION_INSIDE,
        /// <summary>the vertices next to it</summary>
        Rim = Constants.HF_REGION_RIM,
        /// <summary>vertices whose positions fix the base</summary>
        Sites = Constants.HF_REGION_SITES,
    }

    /// <summary>Which joint gets the travel over the ground.</summary>
    public enum RootMotion
    {
        /// <summary>the hips</summary>
        Hips = Constants.HF_ROOT_MOTION_HIPS,
        /// <summary>the topmost joint above the hips, as engines want for root motion</summary>
        Root = Constants.HF_ROOT_MOTION_ROOT,
        /// <summary>none: the body stays in its place</summary>
        InPlace = Constants.HF_ROOT_MOTION_IN_PLACE,
    }

    /// <summary>Bits that name steps to leave out.</summary>
    [Flags]
    public enum RetargetStep
    {
        None = 0,
        /// <summary>limbs are not aligned: both rests are alike, or you want their difference</summary>
        KeepRests = Constants.HF_RETARGET_KEEP_RESTS,
        /// <summary>joints turn and the hips travel; feet and ground are ignored</summary>
        NoGoals = Constants.HF_RETARGET_NO_GOALS,
        /// <summary>planted feet may slide. A frame then has no state: a scrubbed timeline gives the bits of a played one</summary>
        NoLock = Constants.HF_RETARGET_NO_LOCK,
        /// <summary>equal skeletons are retargeted like others</summary>
        NoCopy = Constants.HF_RETARGET_NO_COPY,
    }

    /// <summary>Says where the scale comes from.</summary>
    public enum ScaleFrom
    {
        Given = Constants.HF_SCALE_GIVEN,
        /// <summary>lengths of legs, from hip to sole</summary>
        Legs = Constants.HF_SCALE_LEGS,
        /// <summary>heights of hips: both stand on four legs or more</summary>
        Hips = Constants.HF_SCALE_HIPS,
        /// <summary>heights of bodies: one has no legs</summary>
        Height = Constants.HF_SCALE_HEIGHT,
    }

    /// <summary>The part of the body that a joint or a chain is.</summary>
    public enum Role
    {
        Other = Constants.HF_ROLE_OTHER,
        Spine = Constants.HF_ROLE_SPINE,
        Neck = Constants.HF_ROLE_NECK,
        Head = Constants.HF_ROLE_HEAD,
        Jaw = Constants.HF_ROLE_JAW,
        Shoulder = Constants.HF_ROLE_SHOULDER,
        Arm = Constants.HF_ROLE_ARM,
        Hand = Constants.HF_ROLE_HAND,
        Finger = Constants.HF_ROLE_FINGER,
        Leg = Constants.HF_ROLE_LEG,
        Foot = Constants.HF_ROLE_FOOT,
        Toe = Constants.HF_ROLE_TOE,
        Tail = Constants.HF_ROLE_TAIL,
        Wing = Constants.HF_ROLE_WING,
        Ear = Constants.HF_ROLE_EAR,
        Eye = Constants.HF_ROLE_EYE,
        Antenna = Constants.HF_ROLE_ANTENNA,
        Fin = Constants.HF_ROLE_FIN,
    }

    /// <summary>The side of the character, not of the person who looks at it.</summary>
    public enum BodySide
    {
        Middle = Constants.HF_SIDE_MIDDLE,
        Left = Constants.HF_SIDE_LEFT,
        Right = Constants.HF_SIDE_RIGHT,
    }

    /// <summary>How a joint serves the body.</summary>
    public enum JointKind
    {
        /// <summary>it moves a part of the body</summary>
        Body = Constants.HF_JOINT_KIND_BODY,
        /// <summary>a control, a pole, a target or a root: it moves no part</summary>
        Helper = Constants.HF_JOINT_KIND_HELPER,
        /// <summary>it marks the tip of a chain</summary>
        End = Constants.HF_JOINT_KIND_END,
        /// <summary>it lies along a bone and takes a share of its turn</summary>
        Twist = Constants.HF_JOINT_KIND_TWIST,
    }

    public enum TransferMode
    {
        /// <summary>a cluster: vertices with similar values of all fields; the default</summary>
        Fields = Constants.HF_TRANSFER_FIELDS,
        /// <summary>Transfers stretch too: faces, breathing, squash. Play each morph target of the source as a frame. Each
        /// target vertex i matches a source point with the deformation gradient F_i (Sumner and Popovic 2004). The
        /// result x' minimises sum over edges of w_ij |(x'_i - x'_j) - (F_i + F_j) / 2 (x_i - x_j)|^2 with
        /// cotangent weights w. It is a Poisson equation with the factor of the surface. Borders match borders, and
        /// narrow openings between them, such as lids, close as on the source. There is no ground, no rest
        /// alignment, no dial, no hold and no skin; flags of pairs only set the scale. A surface on itself gets its
        /// own pose</summary>
        Stretch = Constants.HF_TRANSFER_STRETCH,
    }

    public enum Ground
    {
        /// <summary>feet are held at the ground. A part goes no deeper under the ground than on the source; thin parts may.
        /// The default</summary>
        Keep = Constants.HF_GROUND_KEEP,
        /// <summary>there is no ground: for flying and swimming, or where the host has its own</summary>
        Off = Constants.HF_GROUND_OFF,
    }

    /// <summary>Bits that describe a pair of regions.</summary>
    [Flags]
    public enum PairFlag
    {
        None = 0,
        /// <summary>the target's region follows the scaled path of the source's (feet, trunk)</summary>
        Anchor = Constants.HF_PAIR_ANCHOR,
        /// <summary>an anchor that also stands on the ground, and whose leg gives the scale</summary>
        Foot = Constants.HF_PAIR_FOOT,
        /// <summary>part of the trunk: no rest alignment</summary>
        Trunk = Constants.HF_PAIR_TRUNK,
        /// <summary>keep the source's rotations as they are even if the rest limbs point elsewhere</summary>
        NoAlignment = Constants.HF_PAIR_NO_ALIGNMENT,
        /// <summary>comes as near to the ground as the source's region, scaled, while that is near it (a nose that grazes, a
        /// hand that leans); elsewhere it is free</summary>
        Contact = Constants.HF_PAIR_CONTACT,
        /// <summary>this limb may sink into the ground, thick or thin (Transfer.Sinking)</summary>
        Sinks = Constants.HF_PAIR_SINKS,
        /// <summary>head, nose or ears: neck_follow of TransferDials turns the neck that they share</summary>
        Neck = Constants.HF_PAIR_NECK,
        /// <summary>part of the tail: tail_follow turns it</summary>
        Tail = Constants.HF_PAIR_TAIL,
        /// <summary>a hand: arm_space turns the arms of each side</summary>
        Arm = Constants.HF_PAIR_ARM,
    }

    /// <summary>How the weights of a vertex were found.</summary>
    public enum WeightsOrigin
    {
        /// <summary>its nearest joint is in sight</summary>
        Informed = Constants.HF_WEIGHTS_INFORMED,
        /// <summary>from the vertices around it</summary>
        Solved = Constants.HF_WEIGHTS_SOLVED,
        /// <summary>given by a pin</summary>
        Pinned = Constants.HF_WEIGHTS_PINNED,
        /// <summary>guessed: its piece has no information; from the nearest vertices of others</summary>
        Nearest = Constants.HF_WEIGHTS_NEAREST,
        /// <summary>guessed, as NEAREST: one mean for all vertices of a small piece</summary>
        Rigid = Constants.HF_WEIGHTS_RIGID,
        /// <summary>guessed: it belongs to no triangle; from the nearest vertex</summary>
        Isolated = Constants.HF_WEIGHTS_ISOLATED,
        /// <summary>transferred or mirrored: from a near point whose normal agrees</summary>
        Matched = Constants.HF_WEIGHTS_MATCHED,
        /// <summary>mirrored: it is on the side to copy from</summary>
        Kept = Constants.HF_WEIGHTS_KEPT,
    }

    /// <summary>Bits that say why a joint deserves a look.</summary>
    [Flags]
    public enum JointFlag
    {
        None = 0,
        /// <summary>it is a point</summary>
        NoLength = Constants.HF_JOINT_NO_LENGTH,
        /// <summary>it lies exactly on a joint of a lower number</summary>
        Coincident = Constants.HF_JOINT_COINCIDENT,
        /// <summary>no vertex has it as its nearest joint in sight</summary>
        InformsNone = Constants.HF_JOINT_INFORMS_NONE,
        /// <summary>no part of it is inside the skin</summary>
        Outside = Constants.HF_JOINT_OUTSIDE,
        /// <summary>a proposal that follows from the other flags: it looks like a helper that should not deform</summary>
        Helper = Constants.HF_JOINT_HELPER,
    }

    /// <summary>Bits that say why a joint looks like a helper: a root, a target or a control that moves no skin.</summary>
    [Flags]
    public enum HelperReason
    {
        None = 0,
        /// <summary>the reasons together are enough to propose it</summary>
        Proposed = Constants.HF_HELPER_PROPOSED,
        /// <summary>its name says root, armature, master, ...</summary>
        NameRoot = Constants.HF_HELPER_NAME_ROOT,
        /// <summary>its name says pole, target, IK, control, ...</summary>
        NameControl = Constants.HF_HELPER_NAME_CONTROL,
        /// <summary>its name says end, tip, slot, ...</summary>
        NameEnd = Constants.HF_HELPER_NAME_END,
        /// <summary>it has no parent, but children</summary>
        Root = Constants.HF_HELPER_ROOT,
        /// <summary>it has no child, and its parent is a root with other joints</summary>
        Apart = Constants.HF_HELPER_APART,
        /// <summary>as JointFlag.NoLength, and so on</summary>
        NoLength = Constants.HF_HELPER_NO_LENGTH,
        Coincident = Constants.HF_HELPER_COINCIDENT,
        Outside = Constants.HF_HELPER_OUTSIDE,
        InformsNone = Constants.HF_HELPER_INFORMS_NONE,
    }

    /// <summary>Which side of the plane gives its weights.</summary>
    public enum MirrorTo
    {
        /// <summary>the side that the normal points to</summary>
        ToNegative = Constants.HF_MIRROR_TO_NEGATIVE,
        /// <summary>the other side</summary>
        ToPositive = Constants.HF_MIRROR_TO_POSITIVE,
        /// <summary>each side takes the mean of both</summary>
        Both = Constants.HF_MIRROR_BOTH,
    }

    /// <summary>Where a plane of symmetry comes from.</summary>
    public enum MirrorPlane
    {
        Given = Constants.HF_MIRROR_PLANE_GIVEN,
        /// <summary>from joints with partners</summary>
        Joints = Constants.HF_MIRROR_PLANE_JOINTS,
        /// <summary>from the surface</summary>
        Surface = Constants.HF_MIRROR_PLANE_SURFACE,
    }

    /// <summary>How a joint found its partner.</summary>
    public enum MirrorPairing
    {
        /// <summary>it has none, and moves the other side too</summary>
        Alone = Constants.HF_MIRROR_JOINT_ALONE,
        /// <summary>the names differ in the side: arm.L and arm.R, LeftArm and RightArm</summary>
        Named = Constants.HF_MIRROR_JOINT_NAMED,
        /// <summary>it lies where the partner's reflection lies</summary>
        Placed = Constants.HF_MIRROR_JOINT_PLACED,
        /// <summary>it lies on the plane, and is its own partner</summary>
        Centre = Constants.HF_MIRROR_JOINT_CENTRE,
        Given = Constants.HF_MIRROR_JOINT_GIVEN,
    }

    /// <summary>A spring from a vertex to a point of a triangle. Surface.Links writes it, LinksDesc reads it.</summary>
    public sealed unsafe partial class Link
    {
        /// <summary>of your mesh, the first of welded copies</summary>
        public uint Vertex;
        /// <summary>the triangle; a corner of barycentric 0 is ignored and can be uint.MaxValue</summary>
        public uint[] Corners = new uint[3];
        /// <summary>&gt;= 0, of sum 1 within 1e-3. A single 1 links two vertices</summary>
        public double[] Barycentrics = new double[3];
        /// <summary>at rest, in the unit of the positions. Ignored when read</summary>
        public double Length;
        /// <summary>1: as strong as an edge between two equilateral triangles; &gt; 0</summary>
        public double Weight;
        /// <summary>1: the tree over the pieces has it. Ignored when read</summary>
        public bool InTree;

        internal Link(hf_link* raw)
        {
            Vertex = raw->vertex;
            for (int i = 0; i < 3; ++i) Corners[i] = raw->corners[i];
            for (int i = 0; i < 3; ++i) Barycentrics[i] = raw->barycentrics[i];
            Length = raw->length;
            Weight = raw->weight;
            InTree = raw->in_tree != 0;
        }

        public Link() { }

        internal void Write(Call c, hf_link* raw)
        {
            raw->vertex = Vertex;
            c.Fit(Corners, "Corners", "3");
            for (int i = 0; Corners != null && i < Corners.Length; ++i) raw->corners[i] = Corners[i];
            c.Fit(Barycentrics, "Barycentrics", "3");
            for (int i = 0; Barycentrics != null && i < Barycentrics.Length; ++i) raw->barycentrics[i] = Barycentrics[i];
            raw->length = Length;
            raw->weight = Weight;
            raw->in_tree = InTree ? 1 : 0;
        }
    }

    /// <summary>The options a surface was made with, defaults filled in.</summary>
    public sealed unsafe partial class SurfaceInfo
    {
        /// <summary>of your mesh</summary>
        public uint VertexCount;
        /// <summary>of your mesh; of faces, the triangles of their cut</summary>
        public uint TriangleCount;
        public Weld Weld;
        public double WeldTolerance;
        public Operator OperatorKind;
        public FieldKind FieldKind;
        public Ordering Ordering;
        public uint ThreadCount;
        public uint VertexLimit;
        /// <summary>0: eight per vertex of the vertex limit</summary>
        public uint TriangleLimit;
        /// <summary>0: none</summary>
        public uint MemoryLimitMb;
        public uint WorkLimitGflop;
        /// <summary>of the desc of Surface.FromGraph; 0 for a mesh</summary>
        public uint EdgeCount;
        /// <summary>of a graph, 0: sixteen per vertex of the vertex limit</summary>
        public uint EdgeLimit;
        /// <summary>of your mesh; 0 where triangles were given</summary>
        public uint FaceCount;
        /// <summary>of your mesh</summary>
        public uint CornerCount;

        internal SurfaceInfo(hf_surface_info* raw)
        {
            VertexCount = raw->vertex_count;
            TriangleCount = raw->triangle_count;
            Weld = (Weld)raw->weld;
            WeldTolerance = raw->weld_tolerance;
            OperatorKind = (Operator)raw->operator_kind;
            FieldKind = (FieldKind)raw->field_kind;
            Ordering = (Ordering)raw->ordering;
            ThreadCount = raw->thread_count;
            VertexLimit = raw->vertex_limit;
            TriangleLimit = raw->triangle_limit;
            MemoryLimitMb = raw->memory_limit_mb;
            WorkLimitGflop = raw->work_limit_gflop;
            EdgeCount = raw->edge_count;
            EdgeLimit = raw->edge_limit;
            FaceCount = raw->face_count;
            CornerCount = raw->corner_count;
        }
    }

    /// <summary>Counts that the surface found in the mesh. A graph has no triangles: its counts of triangles are 0. If faces
    /// were given, the report counts collapsed and duplicate faces, and sides of faces as edges. It counts the
    /// degenerate triangles of the cut.</summary>
    public sealed unsafe partial class SurfaceReport
    {
        /// <summary>of your mesh</summary>
        public uint VertexCount;
        /// <summary>of your mesh; of faces, the triangles of their cut</summary>
        public uint TriangleCount;
        /// <summary>after welding</summary>
        public uint WeldedVertexCount;
        /// <summary>connected components with at least one triangle (or edge), after welding; linked pieces are one
        /// component</summary>
        public uint ComponentCount;
        /// <summary>given vertices in no usable triangle (or edge); fields are 0 there</summary>
        public uint IsolatedVertexCount;
        /// <summary>zero area to working precision</summary>
        public uint DegenerateTriangleCount;
        /// <summary>equal corners after welding, or on a line and joining nothing; left out</summary>
        public uint CollapsedTriangleCount;
        /// <summary>the same corners again after welding, in either direction; they do not count in the edges below</summary>
        public uint DuplicateTriangleCount;
        /// <summary>edges of three or more triangles</summary>
        public uint NonManifoldEdgeCount;
        /// <summary>edges that two triangles run through in the same direction</summary>
        public uint FlippedEdgeCount;
        public uint BoundaryEdgeCount;
        /// <summary>closed pieces whose triangles face inwards: a mesh turned inside out, or the inner wall of a hollow
        /// body. Fields do not change. Results that use normals do</summary>
        public uint InsideOutCount;
        /// <summary>vertex of your mesh: the first of such a piece; uint.MaxValue without one</summary>
        public uint FirstInsideOutVertex;
        /// <summary>in the unit of the positions, without isolated vertices</summary>
        public double BoundingBoxDiagonal;

        internal SurfaceReport(hf_surface_report* raw)
        {
            VertexCount = raw->vertex_count;
            TriangleCount = raw->triangle_count;
            WeldedVertexCount = raw->welded_vertex_count;
            ComponentCount = raw->component_count;
            IsolatedVertexCount = raw->isolated_vertex_count;
            DegenerateTriangleCount = raw->degenerate_triangle_count;
            CollapsedTriangleCount = raw->collapsed_triangle_count;
            DuplicateTriangleCount = raw->duplicate_triangle_count;
            NonManifoldEdgeCount = raw->non_manifold_edge_count;
            FlippedEdgeCount = raw->flipped_edge_count;
            BoundaryEdgeCount = raw->boundary_edge_count;
            InsideOutCount = raw->inside_out_count;
            FirstInsideOutVertex = raw->first_inside_out_vertex;
            BoundingBoxDiagonal = raw->bounding_box_diagonal;
        }
    }

    /// <summary>Figures of a mesh for developers: its faces, and the weights of its operator.</summary>
    public sealed unsafe partial class MeshStatistics
    {
        /// <summary>faces of more than three corners</summary>
        public uint PolygonCount;
        /// <summary>polygons with a corner farther than 1 % of their diameter from their mean plane</summary>
        public uint NonPlanarCount;
        /// <summary>corners of the largest face; 0 where triangles were given</summary>
        public uint LargestFace;
        /// <summary>edges of the cut of negative cotangent weight, before any clamping</summary>
        public uint NegativeEdgeCount;
        /// <summary>welded vertices with a changed weight, in the operator of field_kind. A weight is changed if its
        /// triangles are too thin, or if a double has too few digits for it. A certificate holds for the weights
        /// used; near these vertices the field may differ from the field of the mesh</summary>
        public uint ChangedVertexCount;
        /// <summary>the first of them in your mesh; uint.MaxValue without one</summary>
        public uint FirstChangedVertex;
        /// <summary>radians, over the usable triangles of the cut</summary>
        public double SmallestAngle;

        internal MeshStatistics(hf_mesh_statistics* raw)
        {
            PolygonCount = raw->polygon_count;
            NonPlanarCount = raw->non_planar_count;
            LargestFace = raw->largest_face;
            NegativeEdgeCount = raw->negative_edge_count;
            ChangedVertexCount = raw->changed_vertex_count;
            FirstChangedVertex = raw->first_changed_vertex;
            SmallestAngle = raw->smallest_angle;
        }
    }

    /// <summary>How the pieces of a mesh are linked.</summary>
    public sealed unsafe partial class LinksInfo
    {
        /// <summary>edge-connected pieces, linked or not</summary>
        public uint PieceCount;
        /// <summary>Surface.Links writes them</summary>
        public uint LinkCount;
        public uint LightPieceCount;
        /// <summary>pieces without a link, if there are several</summary>
        public uint LonePieceCount;
        /// <summary>with joint_parents: places where two pieces touch and have no link, such as two feet.
        /// Surface.MeasureGaps measures how far they open</summary>
        public uint ContactCount;
        /// <summary>longest link of the tree over the pieces, in the unit of the positions</summary>
        public double LongestTreeLink;

        internal LinksInfo(hf_links_info* raw)
        {
            PieceCount = raw->piece_count;
            LinkCount = raw->link_count;
            LightPieceCount = raw->light_piece_count;
            LonePieceCount = raw->lone_piece_count;
            ContactCount = raw->contact_count;
            LongestTreeLink = raw->longest_tree_link;
        }
    }

    /// <summary>How far linked pieces have opened, in the unit of the positions.</summary>
    public sealed unsafe partial class GapsInfo
    {
        public uint LinkCount;
        /// <summary>95 of 100 links opened no more than this; 0 without links</summary>
        public double Percentile95;
        /// <summary>the widest gap of a link; 0 without links</summary>
        public double Worst;
        /// <summary>position in Surface.Links of the link with that gap; uint.MaxValue without links</summary>
        public uint WorstLink;
        /// <summary>as in LinksInfo; the fields above leave contacts out</summary>
        public uint ContactCount;
        /// <summary>the widest gap of a contact; 0 without contacts</summary>
        public double WorstContact;
        /// <summary>vertex of your mesh in that contact; uint.MaxValue without contacts</summary>
        public uint ContactVertex;
        /// <summary>vertices that touch a linked piece at rest, once for each such piece</summary>
        public uint TouchingCount;
        /// <summary>the widest opening of a touching vertex; 0 without one</summary>
        public double WorstOpening;
        /// <summary>vertex of your mesh with that opening; uint.MaxValue where nothing opened</summary>
        public uint OpeningVertex;

        internal GapsInfo(hf_gaps_info* raw)
        {
            LinkCount = raw->link_count;
            Percentile95 = raw->percentile_95;
            Worst = raw->worst;
            WorstLink = raw->worst_link;
            ContactCount = raw->contact_count;
            WorstContact = raw->worst_contact;
            ContactVertex = raw->contact_vertex;
            TouchingCount = raw->touching_count;
            WorstOpening = raw->worst_opening;
            OpeningVertex = raw->opening_vertex;
        }
    }

    /// <summary>A corner of a triangle that a cut gave another vertex. Give the new vertex what the old one has, and write
    /// it into your index array: indices[3 * triangle + corner] = vertex. The old one is what your index array has
    /// there. At a seam the copies of a vertex share one new vertex, so what differs between them, such as a UV,
    /// belongs to the corner.</summary>
    public sealed unsafe partial class CutCorner
    {
        /// <summary>of your mesh</summary>
        public uint Triangle;
        /// <summary>0, 1 or 2</summary>
        public uint Corner;
        /// <summary>new since the surface was made</summary>
        public uint Vertex;
        /// <summary>the vertex that it copies, the first of welded copies</summary>
        public uint Copied;

        internal CutCorner(hf_cut_corner* raw)
        {
            Triangle = raw->triangle;
            Corner = raw->corner;
            Vertex = raw->vertex;
            Copied = raw->copied;
        }

        public CutCorner() { }

        internal void Write(Call c, hf_cut_corner* raw)
        {
            raw->triangle = Triangle;
            raw->corner = Corner;
            raw->vertex = Vertex;
            raw->copied = Copied;
        }
    }

    /// <summary>Surface.Statistics writes sizes and times of a surface here. Times are in milliseconds. Bytes are doubles
    /// (exact to 2^53).</summary>
    public sealed unsafe partial class SurfaceStatistics
    {
        /// <summary>size of the factored matrix</summary>
        public uint UnknownCount;
        public double WeldMs;
        public double OperatorMs;
        public double OrderingMs;
        public double SymbolicMs;
        public double NumericMs;
        /// <summary>non-zeros of the Cholesky factor</summary>
        public double FactorEntries;
        /// <summary>memory of the stored factor with its indices</summary>
        public double FactorBytes;
        public double FactorFlops;
        /// <summary>in use by this surface and everything made on it, and up to 16 work buffers of a field each that calls
        /// leave for the next, refused calls too</summary>
        public double MemoryBytes;
        public double PeakMemoryBytes;
        /// <summary>to load a saved factor; the times to make it are then 0</summary>
        public double LoadMs;
        /// <summary>1: the factor was loaded</summary>
        public bool FactorLoaded;
        /// <summary>1: its numbers are read in place; factor_bytes counts them, memory_bytes does not</summary>
        public bool FactorBorrowed;
        /// <summary>to find the links; operator_ms counts them too</summary>
        public double LinksMs;

        internal SurfaceStatistics(hf_surface_statistics* raw)
        {
            UnknownCount = raw->unknown_count;
            WeldMs = raw->weld_ms;
            OperatorMs = raw->operator_ms;
            OrderingMs = raw->ordering_ms;
            SymbolicMs = raw->symbolic_ms;
            NumericMs = raw->numeric_ms;
            FactorEntries = raw->factor_entries;
            FactorBytes = raw->factor_bytes;
            FactorFlops = raw->factor_flops;
            MemoryBytes = raw->memory_bytes;
            PeakMemoryBytes = raw->peak_memory_bytes;
            LoadMs = raw->load_ms;
            FactorLoaded = raw->factor_loaded != 0;
            FactorBorrowed = raw->factor_borrowed != 0;
            LinksMs = raw->links_ms;
        }
    }

    /// <summary>A place on a surface: a vertex, or a point between three corners of a face. Hit gives a place. Sites, pins,
    /// curves, handles and paths take places. A list of places has three forms: `vertices` (4 bytes each),
    /// `places`, and `points` in space. Set one of the three.</summary>
    public sealed unsafe partial class Place
    {
        /// <summary>vertices of one face of your mesh; a corner of barycentric 0 is ignored and can be uint.MaxValue</summary>
        public uint[] Corners = new uint[3];
        /// <summary>weights of the corners, &gt;= 0, of sum 1 within 1e-6. A single 1 is a vertex</summary>
        public double[] Barycentrics = new double[3];

        internal Place(hf_place* raw)
        {
            for (int i = 0; i < 3; ++i) Corners[i] = raw->corners[i];
            for (int i = 0; i < 3; ++i) Barycentrics[i] = raw->barycentrics[i];
        }

        public Place() { }

        internal void Write(Call c, hf_place* raw)
        {
            c.Fit(Corners, "Corners", "3");
            for (int i = 0; Corners != null && i < Corners.Length; ++i) raw->corners[i] = Corners[i];
            c.Fit(Barycentrics, "Barycentrics", "3");
            for (int i = 0; Barycentrics != null && i < Barycentrics.Length; ++i) raw->barycentrics[i] = Barycentrics[i];
        }
    }

    /// <summary>Surface.CastRay writes the first triangle that a ray hits here.</summary>
    public sealed unsafe partial class Hit
    {
        /// <summary>or face, of your mesh</summary>
        public uint Triangle;
        /// <summary>its corner nearest to the hit, of your mesh, the first of welded copies</summary>
        public uint Vertex;
        /// <summary>the point hit: corners of the triangle (the first of welded copies) and their barycentrics. A face of
        /// more corners is cut into triangles; these are the corners of the triangle hit</summary>
        public Place Place;
        /// <summary>in the unit of the positions</summary>
        public double[] Position = new double[3];
        /// <summary>from the origin, in lengths of `direction`</summary>
        public double Distance;

        internal Hit(hf_hit* raw)
        {
            Triangle = raw->triangle;
            Vertex = raw->vertex;
            Place = new Place(&raw->place);
            for (int i = 0; i < 3; ++i) Position[i] = raw->position[i];
            Distance = raw->distance;
        }
    }

    /// <summary>Solver.Info writes the options of a solver here, with defaults filled in, and the number of its sites.</summary>
    public sealed unsafe partial class SolverInfo
    {
        public FieldKind FieldKind;
        public uint ChannelCount;
        public uint SiteLimit;
        public uint SiteCount;
        /// <summary>vertices of your mesh: rows of a field</summary>
        public uint VertexCount;

        internal SolverInfo(hf_solver_info* raw)
        {
            FieldKind = (FieldKind)raw->field_kind;
            ChannelCount = raw->channel_count;
            SiteLimit = raw->site_limit;
            SiteCount = raw->site_count;
            VertexCount = raw->vertex_count;
        }
    }

    /// <summary>The components that the sites of a solve did not reach.</summary>
    public sealed unsafe partial class SolveInfo
    {
        /// <summary>components without a site</summary>
        public uint UnreachedComponentCount;
        /// <summary>uint.MaxValue for none</summary>
        public uint FirstUnreachedComponent;
        /// <summary>given vertices in them, isolated ones included</summary>
        public uint UnreachedVertexCount;

        internal SolveInfo(hf_solve_info* raw)
        {
            UnreachedComponentCount = raw->unreached_component_count;
            FirstUnreachedComponent = raw->first_unreached_component;
            UnreachedVertexCount = raw->unreached_vertex_count;
        }
    }

    /// <summary>Counts and errors of a preview.</summary>
    public sealed unsafe partial class PreviewInfo
    {
        /// <summary>1: solved in double, as Solver.Solve does</summary>
        public bool Exact;
        /// <summary>corrections made; 0 when exact</summary>
        public uint CorrectionCount;
        /// <summary>components without a site; their vertices hold 0</summary>
        public uint UnreachedComponentCount;
        /// <summary>largest less smallest site value, the widest over components and channels</summary>
        public double ValueRange;
        /// <summary>largest change of a value by the last correction: about the error before it</summary>
        public double LargestCorrection;
        /// <summary>of the largest error, in the unit of the values. Measured when corrections were made, else 1e-5 of
        /// value_range; 0 when exact. Infinite where only corrections can measure it: bi-harmonic fields, long
        /// shapes, crowded sites</summary>
        public double ErrorEstimate;
        /// <summary>memory of the single-precision copy, shared by the surface</summary>
        public double PreviewBytes;

        internal PreviewInfo(hf_preview_info* raw)
        {
            Exact = raw->exact != 0;
            CorrectionCount = raw->correction_count;
            UnreachedComponentCount = raw->unreached_component_count;
            ValueRange = raw->value_range;
            LargestCorrection = raw->largest_correction;
            ErrorEstimate = raw->error_estimate;
            PreviewBytes = raw->preview_bytes;
        }
    }

    /// <summary>The certificate says how accurate a field is. Each error is relative to the range of the site values of its
    /// component and channel, and of its targets where it is screened. Where all are equal, it is relative to their
    /// size. A value that is not finite counts as infinitely wrong.</summary>
    public sealed unsafe partial class Certificate
    {
        /// <summary>1: the field must keep to the range of its sites: harmonic, intrinsic Delaunay or clamped operator, all
        ///     sites at vertices</summary>
        public bool OvershootChecked;
        /// <summary>in: largest error to accept, &gt; 0; 0 = 1e-8; out: the one used</summary>
        public double Tolerance;
        /// <summary>largest less smallest value (or target), the widest over components and channels</summary>
        public double ValueRange;
        /// <summary>largest |(K u - W lambda)_v| / K_vv, how far a value is from the mean of its neighbours</summary>
        public double Residual;
        /// <summary>largest |w_i' u + lambda_i / alpha_i - s_i|, what a site misses its value by</summary>
        public double SiteError;
        /// <summary>how far the field leaves the range of its sites; 0 when not checked</summary>
        public double Overshoot;
        /// <summary>of your mesh, where the largest of the three is</summary>
        public uint WorstVertex;
        /// <summary>welded vertices with a changed weight (MeshStatistics). The errors hold for the weights used. Harmonic
        /// fields on a graph use your own weights, within 1e30 of their median</summary>
        public uint ChangedVertexCount;
        /// <summary>how far a value may be from the exact field: a bound by K alone where no weight is negative and the
        /// field harmonic, else an estimate by corrections</summary>
        public double ErrorEstimate;

        internal Certificate(hf_certificate* raw)
        {
            OvershootChecked = raw->overshoot_checked != 0;
            Tolerance = raw->tolerance;
            ValueRange = raw->value_range;
            Residual = raw->residual;
            SiteError = raw->site_error;
            Overshoot = raw->overshoot;
            WorstVertex = raw->worst_vertex;
            ChangedVertexCount = raw->changed_vertex_count;
            ErrorEstimate = raw->error_estimate;
        }
    }

    /// <summary>Counts, memory and cost estimates of a solver. Bytes are doubles (exact to 2^53).</summary>
    public sealed unsafe partial class SolverStatistics
    {
        public uint SiteCount;
        /// <summary>numeric factorisations this solver made; the surface's own is not counted</summary>
        public uint FactorisationCount;
        /// <summary>sparse solves (elimination paths) for added sites</summary>
        public uint PathSolveCount;
        /// <summary>backward sweeps</summary>
        public uint SweepCount;
        /// <summary>Route of the last edit</summary>
        public uint LastRoute;
        /// <summary>times sites were moved into the factor</summary>
        public uint RebaseCount;
        /// <summary>edits by rows of the dense system</summary>
        public uint DenseEditCount;
        /// <summary>sites in the dense system at present</summary>
        public uint DenseRowCount;
        /// <summary>sites that the factor eliminates now</summary>
        public uint EliminatedCount;
        /// <summary>1: elimination paths outweigh the factor, fields get slower: Solver.PrepareRebase</summary>
        public bool RebaseAdvised;
        /// <summary>paths and dense part of the sites</summary>
        public double SiteMemoryBytes;
        /// <summary>the cost model's estimate for the last edit by rows of the dense system ...</summary>
        public double PredictedDenseMs;
        /// <summary>... and by a rebase, on one thread of the machine it was measured on; 0: none</summary>
        public double PredictedRebaseMs;

        internal SolverStatistics(hf_solver_statistics* raw)
        {
            SiteCount = raw->site_count;
            FactorisationCount = raw->factorisation_count;
            PathSolveCount = raw->path_solve_count;
            SweepCount = raw->sweep_count;
            LastRoute = raw->last_route;
            RebaseCount = raw->rebase_count;
            DenseEditCount = raw->dense_edit_count;
            DenseRowCount = raw->dense_row_count;
            EliminatedCount = raw->eliminated_count;
            RebaseAdvised = raw->rebase_advised != 0;
            SiteMemoryBytes = raw->site_memory_bytes;
            PredictedDenseMs = raw->predicted_dense_ms;
            PredictedRebaseMs = raw->predicted_rebase_ms;
        }
    }

    public sealed unsafe partial class CriticalPoint
    {
        /// <summary>of your mesh, the first of welded copies</summary>
        public uint Vertex;
        public Critical Kind;
        /// <summary>1 for extrema (0 for a maximum on a border), -k for a saddle where k + 1 valleys meet</summary>
        public int Index;
        /// <summary>its piece, as Surface.Pieces: links do not count here</summary>
        public uint Component;
        public double Value;

        internal CriticalPoint(hf_critical_point* raw)
        {
            Vertex = raw->vertex;
            Kind = (Critical)raw->kind;
            Index = raw->index;
            Component = raw->component;
            Value = raw->value;
        }

        public CriticalPoint() { }

        internal void Write(Call c, hf_critical_point* raw)
        {
            raw->vertex = Vertex;
            raw->kind = (int)Kind;
            raw->index = Index;
            raw->component = Component;
            raw->value = Value;
        }
    }

    public sealed unsafe partial class CriticalInfo
    {
        /// <summary>minima + maxima + saddles</summary>
        public uint PointCount;
        public uint MinimumCount;
        public uint MaximumCount;
        /// <summary>a saddle of several valleys counts once</summary>
        public uint SaddleCount;
        /// <summary>of all points</summary>
        public int IndexSum;
        /// <summary>vertices - edges + triangles of the usable surface that has values</summary>
        public int EulerCharacteristic;

        internal CriticalInfo(hf_critical_info* raw)
        {
            PointCount = raw->point_count;
            MinimumCount = raw->minimum_count;
            MaximumCount = raw->maximum_count;
            SaddleCount = raw->saddle_count;
            IndexSum = raw->index_sum;
            EulerCharacteristic = raw->euler_characteristic;
        }
    }

    public sealed unsafe partial class Extremity
    {
        /// <summary>of your mesh, the first of welded copies</summary>
        public uint Vertex;
        /// <summary>its piece, as Surface.Pieces: links do not count here</summary>
        public uint Component;
        /// <summary>how far the tip protrudes, in the unit of the mesh. With p the persistence of the peak of the field:
        /// sqrt(2 p) for POISSON, p for GEODESIC</summary>
        public double Length;
        public double[] Position = new double[3];

        internal Extremity(hf_extremity* raw)
        {
            Vertex = raw->vertex;
            Component = raw->component;
            Length = raw->length;
            for (int i = 0; i < 3; ++i) Position[i] = raw->position[i];
        }

        public Extremity() { }

        internal void Write(Call c, hf_extremity* raw)
        {
            raw->vertex = Vertex;
            raw->component = Component;
            raw->length = Length;
            c.Fit(Position, "Position", "3");
            for (int i = 0; Position != null && i < Position.Length; ++i) raw->position[i] = Position[i];
        }
    }

    /// <summary>A singularity is a triangle, or a face, around which the field makes extra turns. They are counted in parts
    /// of 1 / degree of a full turn.</summary>
    public sealed unsafe partial class Singularity
    {
        /// <summary>or face, of your mesh</summary>
        public uint Triangle;
        /// <summary>its corner where the field is shortest, of your mesh; the first of welded copies</summary>
        public uint Vertex;
        /// <summary>in parts of 1 / degree: +1 a source or vortex of a vector field, -1 a saddle</summary>
        public int Index;

        internal Singularity(hf_singularity* raw)
        {
            Triangle = raw->triangle;
            Vertex = raw->vertex;
            Index = raw->index;
        }

        public Singularity() { }

        internal void Write(Call c, hf_singularity* raw)
        {
            raw->triangle = Triangle;
            raw->vertex = Vertex;
            raw->index = Index;
        }
    }

    /// <summary>The options a direction field was made with, and counts of its constraints and of the work done so far.</summary>
    public sealed unsafe partial class DirectionStatistics
    {
        public uint Degree;
        public uint SiteLimit;
        /// <summary>two per vertex</summary>
        public uint UnknownCount;
        public uint SiteCount;
        /// <summary>the first included; grows when very many constraints go into the factor</summary>
        public uint FactorisationCount;
        /// <summary>two per constraint added or moved</summary>
        public uint PathSolveCount;
        public uint SweepCount;
        /// <summary>vertices whose triangles are not one fan of one orientation</summary>
        public uint IrregularVertexCount;
        /// <summary>constraints that the factor eliminates now</summary>
        public uint EliminatedCount;
        public double OperatorMs;
        public double NumericMs;
        public double FactorEntries;
        public double FactorBytes;
        public double SiteMemoryBytes;

        internal DirectionStatistics(hf_direction_statistics* raw)
        {
            Degree = raw->degree;
            SiteLimit = raw->site_limit;
            UnknownCount = raw->unknown_count;
            SiteCount = raw->site_count;
            FactorisationCount = raw->factorisation_count;
            PathSolveCount = raw->path_solve_count;
            SweepCount = raw->sweep_count;
            IrregularVertexCount = raw->irregular_vertex_count;
            EliminatedCount = raw->eliminated_count;
            OperatorMs = raw->operator_ms;
            NumericMs = raw->numeric_ms;
            FactorEntries = raw->factor_entries;
            FactorBytes = raw->factor_bytes;
            SiteMemoryBytes = raw->site_memory_bytes;
        }
    }

    /// <summary>Pose.Info writes the options of a pose here, with defaults filled in, and the number of its handles.</summary>
    public sealed unsafe partial class PoseInfo
    {
        public uint BandCount;
        public uint IterationCount;
        public uint GroupCount;
        public uint HandleCount;
        /// <summary>vertices of your mesh: rows of Pose.Deform</summary>
        public uint VertexCount;

        internal PoseInfo(hf_pose_info* raw)
        {
            BandCount = raw->band_count;
            IterationCount = raw->iteration_count;
            GroupCount = raw->group_count;
            HandleCount = raw->handle_count;
            VertexCount = raw->vertex_count;
        }
    }

    /// <summary>Pose.Handle writes the region of a handle here, its layer, and its motion in the last Pose.Deform.</summary>
    public sealed unsafe partial class HandleInfo
    {
        /// <summary>of the region, welded copies counted once</summary>
        public uint VertexCount;
        /// <summary>of its boundary</summary>
        public uint SiteCount;
        public uint Component;
        /// <summary>of the rest region, in the unit of the mesh</summary>
        public double[] Centroid = new double[3];
        /// <summary>how far fields are off on the regions: 0 in poses of Pose</summary>
        public double Leak;
        /// <summary>of the handle in the last Pose.Deform, as in Transform. On a higher layer the motion of the lower layers
        /// is included</summary>
        public double[] Rotation = new double[4];
        /// <summary>of the handle, in the same way</summary>
        public double[] Translation = new double[3];
        public uint Layer;
        /// <summary>1: the solve finds the rotation</summary>
        public bool FreeRotation;
        /// <summary>how much of the surface follows; see Pose.SetFollowing</summary>
        public double Following;
        /// <summary>steps on its limb; see Pose.SetLimbRefine</summary>
        public int LimbRefine;

        internal HandleInfo(hf_handle_info* raw)
        {
            VertexCount = raw->vertex_count;
            SiteCount = raw->site_count;
            Component = raw->component;
            for (int i = 0; i < 3; ++i) Centroid[i] = raw->centroid[i];
            Leak = raw->leak;
            for (int i = 0; i < 4; ++i) Rotation[i] = raw->rotation[i];
            for (int i = 0; i < 3; ++i) Translation[i] = raw->translation[i];
            Layer = raw->layer;
            FreeRotation = raw->free_rotation != 0;
            Following = raw->following;
            LimbRefine = raw->limb_refine;
        }
    }

    /// <summary>The work of a deform.</summary>
    public sealed unsafe partial class DeformInfo
    {
        /// <summary>done</summary>
        public uint IterationCount;
        /// <summary>in components without a handle; they stay at rest</summary>
        public uint UnreachedVertexCount;
        /// <summary>largest change of a rotation in the last iteration</summary>
        public double LastChange;

        internal DeformInfo(hf_deform_info* raw)
        {
            IterationCount = raw->iteration_count;
            UnreachedVertexCount = raw->unreached_vertex_count;
            LastChange = raw->last_change;
        }
    }

    /// <summary>Size of a pose and times of its last deform, in milliseconds; 0 before the first.</summary>
    public sealed unsafe partial class PoseStatistics
    {
        public uint ClusterCount;
        public double SolveMs;
        public double BlendMs;
        public double NormalMs;
        /// <summary>steps of refine and of limb_refine</summary>
        public double RefineMs;

        internal PoseStatistics(hf_pose_statistics* raw)
        {
            ClusterCount = raw->cluster_count;
            SolveMs = raw->solve_ms;
            BlendMs = raw->blend_ms;
            NormalMs = raw->normal_ms;
            RefineMs = raw->refine_ms;
        }
    }

    /// <summary>Pose.BlendInfo writes here how the last frame of a pose is blended.</summary>
    public sealed unsafe partial class BlendInfo
    {
        /// <summary>transforms that Pose.BlendTransforms writes</summary>
        public uint ClusterCount;
        /// <summary>changes when rows or offsets change: call Pose.BlendRows again</summary>
        public uint Revision;
        /// <summary>0 to 1: share of its offset that a vertex gets. 0 unless handles were added in place or rotations freed;
        /// it falls as handles move</summary>
        public double OffsetShare;
        /// <summary>in the unit and frame of the mesh; positions are relative to this point</summary>
        public double[] Centre = new double[3];
        /// <summary>for culling: the smallest x, y and z of a box that holds all vertices of the last frame. In the unit and
        /// frame of the mesh, relative to centre</summary>
        public double[] Low = new double[3];
        /// <summary>the largest x, y and z. The box may be larger than needed: see docs/renderer.md</summary>
        public double[] High = new double[3];

        internal BlendInfo(hf_blend_info* raw)
        {
            ClusterCount = raw->cluster_count;
            Revision = raw->revision;
            OffsetShare = raw->offset_share;
            for (int i = 0; i < 3; ++i) Centre[i] = raw->centre[i];
            for (int i = 0; i < 3; ++i) Low[i] = raw->low[i];
            for (int i = 0; i < 3; ++i) High[i] = raw->high[i];
        }
    }

    /// <summary>One proposed handle. position and radius are as in HandlesDesc: the regions of all proposals are disjoint.
    /// If a skeleton with known roles is given, regions has all vertices of a head, a hand or a foot: give these to
    /// HandlesDesc for the whole part. The region of position and radius is then a part of these vertices.</summary>
    public sealed unsafe partial class HandleProposal
    {
        /// <summary>nearest to the position; of your mesh, the first of welded copies</summary>
        public uint Vertex;
        /// <summary>as Surface.Components</summary>
        public uint Component;
        public HandleReason Reason;
        /// <summary>1: add it at once, it holds the body; 0: offer it, and add it when it is dragged</summary>
        public bool Pinned;
        /// <summary>with a skin: the first joint of a head, hand or foot; for another region the lowest joint that moves
        /// more than half of it, together with the joints below. Without a skin: the end joint nearby, or the joint
        /// proposed. uint.MaxValue = none</summary>
        public uint Joint;
        /// <summary>Role that has most of the weights in the region. A sword has the role of its hand</summary>
        public Role Role;
        /// <summary>BodySide of the same joints</summary>
        public Side Side;
        /// <summary>at rest, in the unit and frame of the mesh; inside the surface for a joint and the trunk</summary>
        public double[] Position = new double[3];
        /// <summary>in the unit of the mesh</summary>
        public double Radius;
        /// <summary>how far the part protrudes, in the unit of the mesh</summary>
        public double Length;
        /// <summary>pass it to Pose.SetFollowing while the handle is dragged: 1 for a pinned proposal, else 0.25</summary>
        public double Following;

        internal HandleProposal(hf_handle_proposal* raw)
        {
            Vertex = raw->vertex;
            Component = raw->component;
            Reason = (HandleReason)raw->reason;
            Pinned = raw->pinned != 0;
            Joint = raw->joint;
            Role = (Role)raw->role;
            Side = (Side)raw->side;
            for (int i = 0; i < 3; ++i) Position[i] = raw->position[i];
            Radius = raw->radius;
            Length = raw->length;
            Following = raw->following;
        }

        public HandleProposal() { }

        internal void Write(Call c, hf_handle_proposal* raw)
        {
            raw->vertex = Vertex;
            raw->component = Component;
            raw->reason = (int)Reason;
            raw->pinned = Pinned ? 1 : 0;
            raw->joint = Joint;
            raw->role = (int)Role;
            raw->side = (int)Side;
            c.Fit(Position, "Position", "3");
            for (int i = 0; Position != null && i < Position.Length; ++i) raw->position[i] = Position[i];
            raw->radius = Radius;
            raw->length = Length;
            raw->following = Following;
        }
    }

    /// <summary>Counts of a quad mesh.</summary>
    public sealed unsafe partial class QuadsInfo
    {
        public uint VertexCount;
        public uint FaceCount;
        /// <summary>vertices - edges + faces, equal to the Euler characteristic of the usable surface</summary>
        public int EulerCharacteristic;
        /// <summary>wanted length, in the unit of the mesh</summary>
        public double EdgeLength;

        internal QuadsInfo(hf_quads_info* raw)
        {
            VertexCount = raw->vertex_count;
            FaceCount = raw->face_count;
            EulerCharacteristic = raw->euler_characteristic;
            EdgeLength = raw->edge_length;
        }
    }

    /// <summary>Counts and areas of a region. Welded copies count as one vertex.</summary>
    public sealed unsafe partial class RegionInfo
    {
        public FieldKind FieldKind;
        /// <summary>of the region, without its rim</summary>
        public uint VertexCount;
        /// <summary>vertices next to the region</summary>
        public uint RimCount;
        /// <summary>vertices that fix the base: the rim, for thin plates two rows or more</summary>
        public uint SiteCount;
        /// <summary>of the triangles with a corner in the region, on the surface, in units^2</summary>
        public double Area;
        /// <summary>the same on the base</summary>
        public double BaseArea;

        internal RegionInfo(hf_region_info* raw)
        {
            FieldKind = (FieldKind)raw->field_kind;
            VertexCount = raw->vertex_count;
            RimCount = raw->rim_count;
            SiteCount = raw->site_count;
            Area = raw->area;
            BaseArea = raw->base_area;
        }
    }

    /// <summary>Work of the last edit of a region, and of all its edits.</summary>
    public sealed unsafe partial class RegionStatistics
    {
        /// <summary>sites of the last edit, as in the next two fields</summary>
        public uint InsertedCount;
        public uint RemovedCount;
        public uint KeptCount;
        /// <summary>numeric factorisations of the region's edits so far</summary>
        public uint FactorisationCount;
        /// <summary>sparse solves for added sites, over all edits</summary>
        public uint PathSolveCount;
        /// <summary>Route of the last edit</summary>
        public uint LastRoute;
        /// <summary>1: the last base took a sweep through the whole factor</summary>
        public bool WholeSweep;

        internal RegionStatistics(hf_region_statistics* raw)
        {
            InsertedCount = raw->inserted_count;
            RemovedCount = raw->removed_count;
            KeptCount = raw->kept_count;
            FactorisationCount = raw->factorisation_count;
            PathSolveCount = raw->path_solve_count;
            LastRoute = raw->last_route;
            WholeSweep = raw->whole_sweep != 0;
        }
    }

    /// <summary>Figures of a retarget. Angles, stride and drop count all frames since the last reset.</summary>
    public sealed unsafe partial class RetargetInfo
    {
        public uint SourceJointCount;
        public uint TargetJointCount;
        /// <summary>joints of the target that follow the source</summary>
        public uint MatchedJointCount;
        /// <summary>chains of the target that follow</summary>
        public uint ChainCount;
        /// <summary>1: keys are copied</summary>
        public bool SameSkeleton;
        public ScaleFrom ScaleFrom;
        public uint FrameCount;
        /// <summary>travel of the target over travel of the source</summary>
        public double Scale;
        /// <summary>mean angle between the bones of arms and legs and the same bones of the source, radians</summary>
        public double LimbAngle;
        /// <summary>how far planted feet would travel without the goals, over `scale` times the travel of the source. A clip
        /// on the spot needs the least correction if the body moves at scale x stride_share times the speed of the
        /// clip</summary>
        public double StrideShare;
        /// <summary>how far the hips sank so that feet reach, unit of the target</summary>
        public double DeepestDrop;

        internal RetargetInfo(hf_retarget_info* raw)
        {
            SourceJointCount = raw->source_joint_count;
            TargetJointCount = raw->target_joint_count;
            MatchedJointCount = raw->matched_joint_count;
            ChainCount = raw->chain_count;
            SameSkeleton = raw->same_skeleton != 0;
            ScaleFrom = (ScaleFrom)raw->scale_from;
            FrameCount = raw->frame_count;
            Scale = raw->scale;
            LimbAngle = raw->limb_angle;
            StrideShare = raw->stride_share;
            DeepestDrop = raw->deepest_drop;
        }
    }

    /// <summary>How a chain of the target follows the source. Angles lie between a bone of the target and the same bone of
    /// the source, in radians. They are 0 for a chain of one joint, and for a chain whose rest is not aligned.</summary>
    public sealed unsafe partial class ChainMatch
    {
        public Role Role;
        public Side Side;
        public uint SourceJointCount;
        public uint TargetJointCount;
        public double MeanAngle;
        public double WorstAngle;

        internal ChainMatch(hf_chain_match* raw)
        {
            Role = (Role)raw->role;
            Side = (Side)raw->side;
            SourceJointCount = raw->source_joint_count;
            TargetJointCount = raw->target_joint_count;
            MeanAngle = raw->mean_angle;
            WorstAngle = raw->worst_angle;
        }

        public ChainMatch() { }

        internal void Write(Call c, hf_chain_match* raw)
        {
            raw->role = (int)Role;
            raw->side = (int)Side;
            raw->source_joint_count = SourceJointCount;
            raw->target_joint_count = TargetJointCount;
            raw->mean_angle = MeanAngle;
            raw->worst_angle = WorstAngle;
        }
    }

    /// <summary>The findings about a character. Confidences are 0 to 1. Lengths are in the unit of the joints; a length is 0
    /// where the body has no such part. Lengths of legs belong to the hindmost pair that stands.</summary>
    public sealed unsafe partial class SkeletonInfo
    {
        public uint JointCount;
        public uint ChainCount;
        /// <summary>unit axes in the space of the joints</summary>
        public double[] Up = new double[3];
        public double[] Forward = new double[3];
        /// <summary>up x forward</summary>
        public double[] Left = new double[3];
        /// <summary>a point on the ground in the plane of symmetry</summary>
        public double[] Middle = new double[3];
        public double UpConfidence;
        public double ForwardConfidence;
        public double LeftConfidence;
        public double RoleConfidence;
        /// <summary>along up, over the ground</summary>
        public double Height;
        /// <summary>hip to knee to foot, and the height of the foot</summary>
        public double LegLength;
        /// <summary>of the joint of the thigh, over the ground</summary>
        public double HipHeight;
        /// <summary>upper arm to hand</summary>
        public double ArmLength;

        internal SkeletonInfo(hf_skeleton_info* raw)
        {
            JointCount = raw->joint_count;
            ChainCount = raw->chain_count;
            for (int i = 0; i < 3; ++i) Up[i] = raw->up[i];
            for (int i = 0; i < 3; ++i) Forward[i] = raw->forward[i];
            for (int i = 0; i < 3; ++i) Left[i] = raw->left[i];
            for (int i = 0; i < 3; ++i) Middle[i] = raw->middle[i];
            UpConfidence = raw->up_confidence;
            ForwardConfidence = raw->forward_confidence;
            LeftConfidence = raw->left_confidence;
            RoleConfidence = raw->role_confidence;
            Height = raw->height;
            LegLength = raw->leg_length;
            HipHeight = raw->hip_height;
            ArmLength = raw->arm_length;
        }
    }

    /// <summary>The findings about a joint.</summary>
    public sealed unsafe partial class JointInfo
    {
        public JointKind Kind;
        /// <summary>Role; of a twist joint, the role of its bone</summary>
        public Role Role;
        public Side Side;
        /// <summary>number of its chain, uint.MaxValue: none</summary>
        public uint Chain;
        /// <summary>the joint that mirrors it, uint.MaxValue: none</summary>
        public uint Mate;

        internal JointInfo(hf_joint_info* raw)
        {
            Kind = (JointKind)raw->kind;
            Role = (Role)raw->role;
            Side = (Side)raw->side;
            Chain = raw->chain;
            Mate = raw->mate;
        }

        public JointInfo() { }

        internal void Write(Call c, hf_joint_info* raw)
        {
            raw->kind = (int)Kind;
            raw->role = (int)Role;
            raw->side = (int)Side;
            raw->chain = Chain;
            raw->mate = Mate;
        }
    }

    /// <summary>Joints of one role and side, from root to tip.</summary>
    public sealed unsafe partial class Chain
    {
        public Role Role;
        public Side Side;
        /// <summary>counts the chains of one role and side: legs from the front, others as their joints come</summary>
        public uint Number;
        /// <summary>the chain it hangs on, uint.MaxValue: none</summary>
        public uint Parent;
        /// <summary>its first entry in Skeleton.ChainJoints</summary>
        public uint First;
        /// <summary>entries there, from root to tip</summary>
        public uint JointCount;
        /// <summary>along the joints, up to the first joint of the chain at its tip</summary>
        public double Length;

        internal Chain(hf_chain* raw)
        {
            Role = (Role)raw->role;
            Side = (Side)raw->side;
            Number = raw->number;
            Parent = raw->parent;
            First = raw->first;
            JointCount = raw->joint_count;
            Length = raw->length;
        }

        public Chain() { }

        internal void Write(Call c, hf_chain* raw)
        {
            raw->role = (int)Role;
            raw->side = (int)Side;
            raw->number = Number;
            raw->parent = Parent;
            raw->first = First;
            raw->joint_count = JointCount;
            raw->length = Length;
        }
    }

    public sealed unsafe partial class PairInfo
    {
        public uint Flags;
        /// <summary>of the pair's fields, see HandleInfo</summary>
        public double SourceLeak;
        public double TargetLeak;
        /// <summary>between the rest directions of the limb, radians; negative when unknown (trunk, short limb)</summary>
        public double AlignmentAngle;
        /// <summary>0..1: share of the pair's clusters with enough source vertices</summary>
        public double Confidence;
        /// <summary>how much of that angle the rest alignment takes away, 0 to 1</summary>
        public double AlignmentShare;
        /// <summary>1: alignment_share is above 0</summary>
        public bool Aligned;
        /// <summary>1: the region lies on one side of the source and on the other of the target, by the axes: left and right
        ///     may be exchanged</summary>
        public bool Crossed;

        internal PairInfo(hf_pair_info* raw)
        {
            Flags = raw->flags;
            SourceLeak = raw->source_leak;
            TargetLeak = raw->target_leak;
            AlignmentAngle = raw->alignment_angle;
            Confidence = raw->confidence;
            AlignmentShare = raw->alignment_share;
            Aligned = raw->aligned != 0;
            Crossed = raw->crossed != 0;
        }
    }

    /// <summary>Transfer.Info writes counts and the scale of a transfer here.</summary>
    public sealed unsafe partial class TransferInfo
    {
        public uint PairCount;
        public uint ClusterCount;
        /// <summary>pairs whose rest alignment is applied</summary>
        public uint AlignedCount;
        /// <summary>pairs that change sides, see PairInfo</summary>
        public uint CrossedCount;
        /// <summary>1: from the legs or the boxes; 0: given in the desc</summary>
        public bool ScaleFound;
        /// <summary>lengths of the target over lengths of the source, each in the unit of its mesh</summary>
        public double Scale;

        internal TransferInfo(hf_transfer_info* raw)
        {
            PairCount = raw->pair_count;
            ClusterCount = raw->cluster_count;
            AlignedCount = raw->aligned_count;
            CrossedCount = raw->crossed_count;
            ScaleFound = raw->scale_found != 0;
            Scale = raw->scale;
        }
    }

    /// <summary>Work of a transfer.</summary>
    public sealed unsafe partial class TransferStatistics
    {
        /// <summary>numeric factorisations by edits of pairs; 0 unless they are very many</summary>
        public uint SourceFactorisationCount;
        public uint TargetFactorisationCount;

        internal TransferStatistics(hf_transfer_statistics* raw)
        {
            SourceFactorisationCount = raw->source_factorisation_count;
            TargetFactorisationCount = raw->target_factorisation_count;
        }
    }

    /// <summary>Dials that an animator turns while a transfer plays. Neutral dials give the bits of a transfer without
    /// dials, and the result is continuous in each dial.</summary>
    public sealed unsafe partial class TransferDials
    {
        /// <summary>the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A planted
        /// foot does not slide. The body travels as much farther</summary>
        public double Stride;
        /// <summary>raises the pairs flagged PairFlag.Trunk and PairFlag.Anchor by this share of their mean height at rest,
        /// -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised</summary>
        public double HipHeightShare;
        /// <summary>pairs flagged PairFlag.Neck, together one limb How far a limb follows the source, -1 to 1. At 0
        /// (neutral) the limb plays the source's motion from its own rest direction. At 1 it also gets the rest
        /// direction of the source's limb. At -1 it does not move against its root.</summary>
        public double NeckFollow;
        /// <summary>pairs flagged PairFlag.Tail, together one limb</summary>
        public double TailFollow;
        /// <summary>turns arms (PairFlag.Arm) away from the body, about the forward axis at rest, -pi/2 to pi/2 radians; 0 =
        /// neutral</summary>
        public double ArmSpace;
        /// <summary>how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less, so that
        /// they move as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn
        /// against the part before it</summary>
        public double LongFollow;

        internal TransferDials(hf_transfer_dials* raw)
        {
            Stride = raw->stride;
            HipHeightShare = raw->hip_height_share;
            NeckFollow = raw->neck_follow;
            TailFollow = raw->tail_follow;
            ArmSpace = raw->arm_space;
            LongFollow = raw->long_follow;
        }
    }

    /// <summary>Counts of the weights. Vertices are vertices of your mesh.</summary>
    public sealed unsafe partial class WeightsInfo
    {
        public uint VertexCount;
        public uint JointCount;
        public uint PinCount;
        public uint LockCount;
        /// <summary>vertices by WeightsOrigin</summary>
        public uint InformedCount;
        public uint SolvedCount;
        public uint PinnedCount;
        public uint NearestCount;
        public uint RigidCount;
        public uint IsolatedCount;

        internal WeightsInfo(hf_weights_info* raw)
        {
            VertexCount = raw->vertex_count;
            JointCount = raw->joint_count;
            PinCount = raw->pin_count;
            LockCount = raw->lock_count;
            InformedCount = raw->informed_count;
            SolvedCount = raw->solved_count;
            PinnedCount = raw->pinned_count;
            NearestCount = raw->nearest_count;
            RigidCount = raw->rigid_count;
            IsolatedCount = raw->isolated_count;
        }
    }

    /// <summary>Figures of weights for developers: pieces that were guessed, joints to check, work done.</summary>
    public sealed unsafe partial class WeightsStatistics
    {
        /// <summary>pieces without information</summary>
        public uint NearestPieceCount;
        /// <summary>small ones of them</summary>
        public uint RigidPieceCount;
        /// <summary>1: none of the nearest joints of some piece is in its sight; it uses them nevertheless</summary>
        public bool Blind;
        /// <summary>joints by JointFlag</summary>
        public uint NoLengthCount;
        public uint CoincidentCount;
        public uint InformsNoneCount;
        public uint OutsideCount;
        public uint HelperCount;
        /// <summary>numeric factorisations since the object was made</summary>
        public uint FactorisationCount;
        /// <summary>elimination paths of pins since then</summary>
        public uint PathSolveCount;

        internal WeightsStatistics(hf_weights_statistics* raw)
        {
            NearestPieceCount = raw->nearest_piece_count;
            RigidPieceCount = raw->rigid_piece_count;
            Blind = raw->blind != 0;
            NoLengthCount = raw->no_length_count;
            CoincidentCount = raw->coincident_count;
            InformsNoneCount = raw->informs_none_count;
            OutsideCount = raw->outside_count;
            HelperCount = raw->helper_count;
            FactorisationCount = raw->factorisation_count;
            PathSolveCount = raw->path_solve_count;
        }
    }

    /// <summary>Counts of transferred weights. Vertices are vertices of the target mesh.</summary>
    public sealed unsafe partial class WeightsTransferInfo
    {
        public uint VertexCount;
        /// <summary>vertices by WeightsOrigin</summary>
        public uint MatchedCount;
        public uint SolvedCount;
        public uint NearestCount;
        public uint RigidCount;
        public uint IsolatedCount;
        /// <summary>pieces without a match</summary>
        public uint GuessedPieceCount;

        internal WeightsTransferInfo(hf_weights_transfer_info* raw)
        {
            VertexCount = raw->vertex_count;
            MatchedCount = raw->matched_count;
            SolvedCount = raw->solved_count;
            NearestCount = raw->nearest_count;
            RigidCount = raw->rigid_count;
            IsolatedCount = raw->isolated_count;
            GuessedPieceCount = raw->guessed_piece_count;
        }
    }

    /// <summary>The plane that Weights.Mirror found, and counts of joints and vertices. Vertices are vertices of your mesh.</summary>
    public sealed unsafe partial class WeightsMirrorInfo
    {
        public uint VertexCount;
        public MirrorPlane PlaneFrom;
        /// <summary>joints by MirrorPairing</summary>
        public uint NamedCount;
        public uint PlacedCount;
        public uint CentreCount;
        public uint GivenCount;
        public uint AloneCount;
        /// <summary>vertices by WeightsOrigin</summary>
        public uint KeptCount;
        public uint MatchedCount;
        public uint SolvedCount;
        public uint NearestCount;
        public uint RigidCount;
        public uint IsolatedCount;
        /// <summary>of the plane</summary>
        public double[] Point = new double[3];
        public double[] Normal = new double[3];

        internal WeightsMirrorInfo(hf_weights_mirror_info* raw)
        {
            VertexCount = raw->vertex_count;
            PlaneFrom = (MirrorPlane)raw->plane_from;
            NamedCount = raw->named_count;
            PlacedCount = raw->placed_count;
            CentreCount = raw->centre_count;
            GivenCount = raw->given_count;
            AloneCount = raw->alone_count;
            KeptCount = raw->kept_count;
            MatchedCount = raw->matched_count;
            SolvedCount = raw->solved_count;
            NearestCount = raw->nearest_count;
            RigidCount = raw->rigid_count;
            IsolatedCount = raw->isolated_count;
            for (int i = 0; i < 3; ++i) Point[i] = raw->point[i];
            for (int i = 0; i < 3; ++i) Normal[i] = raw->normal[i];
        }
    }

    /// <summary>Distances of a surface and its joints from their reflections, in the unit of the mesh.</summary>
    public sealed unsafe partial class WeightsMirrorStatistics
    {
        /// <summary>the joint farthest off, uint.MaxValue: none has a partner</summary>
        public uint WorstJoint;
        /// <summary>the vertex farthest off, uint.MaxValue: none was mirrored</summary>
        public uint WorstVertex;
        /// <summary>mean distance of reflected joints from their partners</summary>
        public double JointOff;
        public double WorstJointOff;
        /// <summary>mean distance of reflected vertices from the surface</summary>
        public double VertexOff;
        public double WorstVertexOff;

        internal WeightsMirrorStatistics(hf_weights_mirror_statistics* raw)
        {
            WorstJoint = raw->worst_joint;
            WorstVertex = raw->worst_vertex;
            JointOff = raw->joint_off;
            WorstJointOff = raw->worst_joint_off;
            VertexOff = raw->vertex_off;
            WorstVertexOff = raw->worst_vertex_off;
        }
    }

    /// <summary>A cut as triangles that go and come. The first three arrays fit PatchDesc. New vertices and triangles have
    /// the numbers after the last ones of your mesh. The arrays are yours: each is null or as large as its
    /// capacity.</summary>
    public sealed class Cut
    {
        /// <summary>[removedTriangleCapacity] triangles of your mesh, ascending</summary>
        public uint[] RemovedTriangles;
        /// <summary>[newVertexCapacity x 3] in the unit of your mesh</summary>
        public double[] NewPositions;
        /// <summary>[newTriangleCapacity x 3] vertices of your mesh, the first of welded copies, and new ones</summary>
        public uint[] NewTriangles;
        /// <summary>[newVertexCapacity x 3] vertices of your mesh; the new vertex lies between them. Mix their attributes,
        /// as skin weights. uint.MaxValue where a weight is 0</summary>
        public uint[] VertexCorners;
        /// <summary>[newVertexCapacity x 3] their weights, of sum 1. A single 1 copies a vertex</summary>
        public double[] VertexBarycentrics;
        /// <summary>[newTriangleCapacity] the removed triangle that each new one is a part of</summary>
        public uint[] SourceTriangles;
        /// <summary>[newTriangleCapacity x 3 x 3] three weights for each corner of a new triangle, of the corners of its
        /// source: for what corners have, as UVs at seams</summary>
        public double[] CornerBarycentrics;
        /// <summary>[rimCapacity x 2] along the line: the vertex on its left and that on its right; one and the same where
        /// the line ends inside the surface. At a border between its ends: those after it</summary>
        public uint[] RimVertices;
    }

    /// <summary>Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 -
    /// parameter) a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours:
    /// each is null or as large as its capacity.</summary>
    public sealed class Isolines
    {
        /// <summary>[pointCapacity x 2] vertices a and b of your mesh, the first of welded copies</summary>
        public uint[] PointEdges;
        /// <summary>[pointCapacity] 0 to 1</summary>
        public double[] Parameters;
        /// <summary>[pointCapacity x 3] in the unit and frame of your mesh</summary>
        public double[] Positions;
        /// <summary>[lineCapacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1</summary>
        public uint[] LineStarts;
        /// <summary>[lineCapacity] position of its level in the list</summary>
        public uint[] LineLevels;
        /// <summary>[lineCapacity] 1: closed, the first point is not repeated; 0: ends at borders</summary>
        public int[] LineClosed;
    }

    /// <summary>Places, values and fluxes of the sites. The arrays are yours; each is null or has `capacity` entries. The
    /// entries are ordered by site number.</summary>
    public sealed class SitesInfo
    {
        /// <summary>[capacity] numbers</summary>
        public uint[] Sites;
        /// <summary>[capacity] the vertex of the place, uint.MaxValue for a point in a triangle</summary>
        public uint[] Vertices;
        /// <summary>[capacity]</summary>
        public uint[] Components;
        /// <summary>[capacity x channelCount]</summary>
        public double[] Values;
        /// <summary>[capacity] 0 = hard</summary>
        public double[] Stiffness;
        /// <summary>[capacity x channelCount] lambda: what flows into the surface at the site, in value x weight; the sum
        /// over a disc</summary>
        public double[] Flux;
        /// <summary>[capacity] 0 = a point</summary>
        public double[] Radii;
    }

    /// <summary>A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end
    /// vertices a and b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a
    /// triangle has uint.MaxValue for both. The arrays are yours: each is null or as large as the capacity.</summary>
    public sealed class SurfacePath
    {
        /// <summary>[pointCapacity x 2] vertices a and b of your mesh, the first of welded copies</summary>
        public uint[] PointEdges;
        /// <summary>[pointCapacity] 0 to 1</summary>
        public double[] Parameters;
        /// <summary>[pointCapacity x 3] in the unit and frame of your mesh</summary>
        public double[] Positions;
        /// <summary>in the unit of the mesh; -1: no path</summary>
        public double Length;
    }

    /// <summary>This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints
    /// with fixed vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R
    /// (p - pivot) + translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.
    ///
    /// If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint
    /// takes p to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B
    /// and that scale, and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be
    /// null.</summary>
    public sealed class SkinInfo
    {
        /// <summary>[jointCapacity x 3] rest centroid of what each joint moves</summary>
        public double[] Pivots;
        /// <summary>[jointCapacity x 4] quaternion x, y, z, w of the last frame</summary>
        public double[] Rotations;
        /// <summary>[jointCapacity x 3] posed place of the pivot</summary>
        public double[] Translations;
        /// <summary>[jointCapacity x 4] quaternion of B, fixed while handles stay</summary>
        public double[] Axes;
        /// <summary>[jointCapacity x 3] along the axes in the last frame; null = joints are rigid</summary>
        public double[] Scales;
        /// <summary>[vertexCapacity x influenceCount]</summary>
        public uint[] VertexJoints;
        /// <summary>[vertexCapacity x influenceCount] of sum 1, descending</summary>
        public float[] VertexWeights;
        /// <summary>joints per vertex, 4 or 8; 0 = 4</summary>
        public uint InfluenceCount;
    }

    /// <summary>Receives the rows of a blend. The arrays are yours; each may be null. Positions and offsets are in the unit
    /// of the mesh, gradients per unit of the mesh.</summary>
    public sealed class BlendRows
    {
        /// <summary>[vertexCapacity x 2] number of the first entry of the vertex, and count of its entries</summary>
        public uint[] Rows;
        /// <summary>[entryCapacity] each below the count of clusters</summary>
        public ushort[] Clusters;
        /// <summary>[entryCapacity] multiples of 2^-24; the weights of a vertex sum to 1</summary>
        public float[] Weights;
        /// <summary>[entryCapacity x 3] of the weights along the rest surface, for normals</summary>
        public float[] Gradients;
        /// <summary>[vertexCapacity x 3] at rest, relative to centre</summary>
        public float[] Positions;
        /// <summary>[vertexCapacity x 3] unit, at rest</summary>
        public float[] Normals;
        /// <summary>[vertexCapacity x 3] 0 unless handles were added in place or rotations freed</summary>
        public float[] Offsets;
        /// <summary>entries of the vertex that has the most</summary>
        public uint LongestRow;
    }

    /// <summary>Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of
    /// glTF). The arrays are yours; each may be null. Rows hold the heaviest entries of a vertex, by falling
    /// weight. Unused entries have weight 0.
    ///
    /// The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its
    /// weights times the largest distance between the places to which its clusters move it.</summary>
    public sealed class BlendInfluences
    {
        /// <summary>[vertexCapacity x influenceCount] each below the count of clusters</summary>
        public ushort[] Clusters;
        /// <summary>[vertexCapacity x influenceCount] 65535ths; the weights of a vertex sum to 65535</summary>
        public ushort[] Weights;
        /// <summary>[vertexCapacity x influenceCount] null = not wanted. Refused for more than 256 clusters</summary>
        public byte[] ByteClusters;
        /// <summary>[vertexCapacity x influenceCount] null = not wanted. 255ths, of sum 255; weights that round to 0 are
        /// left out</summary>
        public byte[] ByteWeights;
        /// <summary>the largest change of a vertex's weights, 0 to 1: half the sum of the differences</summary>
        public double Change;
        /// <summary>the same for byte_weights</summary>
        public double ByteChange;
        /// <summary>the largest distance of a vertex from its place in the last frame, in box diagonals</summary>
        public double Error;
        /// <summary>the same for byte_weights</summary>
        public double ByteError;
        /// <summary>clusters of each vertex, the length of a row, 1 to 64; 0 = 8</summary>
        public uint InfluenceCount;
    }

    /// <summary>Quads.Mesh writes the quad mesh to these arrays. They are yours: each is null or as large as its capacity.</summary>
    public sealed class QuadsMesh
    {
        /// <summary>[vertexCapacity x 3] in the unit and frame of your mesh</summary>
        public double[] Positions;
        /// <summary>[faceCapacity x 4] vertices of each quad, counter-clockwise</summary>
        public uint[] Faces;
        /// <summary>[vertexCapacity] triangle or face of your mesh that contains the vertex</summary>
        public uint[] Triangles;
        /// <summary>[vertexCapacity x 3] weights of that triangle's corners, in its own order, of sum 1; in a face of more
        /// corners the weights of `corners`</summary>
        public double[] Barycentrics;
        /// <summary>[vertexCapacity x 3] vertices of your mesh that barycentrics belong to, the first of welded copies</summary>
        public uint[] Corners;
    }

    /// <summary>Results.</summary>
    public sealed class Streamlines
    {
        /// <summary>[pointCapacity x 3] in the unit and frame of your mesh</summary>
        public double[] Positions;
        /// <summary>[pointCapacity] of the field, rising along every line</summary>
        public double[] Values;
        /// <summary>[lineCapacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1</summary>
        public uint[] LineStarts;
        /// <summary>[lineCapacity x 2] vertices where it starts and ends, of welded copies the first</summary>
        public uint[] LineEnds;
    }

    /// <summary>Receives the weights. The arrays are yours; each may be null.</summary>
    public sealed class WeightsOut
    {
        /// <summary>[vertexCapacity x influenceCount]</summary>
        public uint[] Joints;
        /// <summary>[vertexCapacity x influenceCount] descending, of sum exactly 1</summary>
        public float[] Weights;
        /// <summary>[vertexCapacity] WeightsOrigin</summary>
        public byte[] Origins;
        /// <summary>joints per vertex, 4 or 8</summary>
        public uint InfluenceCount;
    }

    /// <summary>A factor that Surface.Save wrote. The surface loads it instead of computing it.</summary>
    public sealed unsafe class FactorDesc
    {
        /// <summary>all of them, as saved</summary>
        public byte[] Bytes;

        public static implicit operator FactorDesc(byte[] bytes)
        {
            return bytes == null ? null : new FactorDesc { Bytes = bytes };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_factor_desc*)c.New(sizeof(hf_factor_desc));
            desc->struct_size = (uint)sizeof(hf_factor_desc);
            desc->bytes = c.Pin(Bytes);
            desc->byte_count = (UIntPtr)(Bytes == null ? 0 : Bytes.Length);
            return (IntPtr)desc;
        }
    }

    /// <summary>Says which pieces to link. Joints and weights or tags help the automatic links; each array may be null. A
    /// light piece is a sheet over a larger one, such as cloth: it follows the surface below and hardly pulls it.</summary>
    public sealed unsafe class LinksDesc
    {
        /// <summary>[vertexCount x influenceCount] of a skin: pieces of the same joint link sooner</summary>
        public ushort[] Joints;
        /// <summary>[vertexCount x influenceCount] of sum 1; where all are 0, a vertex shares no joint</summary>
        public float[] Weights;
        /// <summary>[jointCount] parent of each joint, uint.MaxValue for a root; needs joints and weights. Pieces of parent
        /// and child link wherever they touch. Pieces of joints farther apart in the skeleton, such as two feet,
        /// link only if nothing else joins them</summary>
        public uint[] JointParents;
        /// <summary>[vertexCount]: pieces with different tags do not link, as a rider and a horse. The first vertex of a
        /// piece counts</summary>
        public uint[] Tags;
        /// <summary>[linkCount]</summary>
        public Link[] Links;
        /// <summary>[lightCount]: their pieces are light</summary>
        public uint[] LightVertices;
        /// <summary>[heavyCount]: their pieces are not, as one that gets a site or handle</summary>
        public uint[] HeavyVertices;
        public LinkMode Mode;
        /// <summary>longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal</summary>
        public double Distance;
        /// <summary>of all links, times each one's weight; 0 = 1</summary>
        public double Stiffness;
        /// <summary>automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of the
        ///     diagonal, below 0: no piece is light unless light_vertices say so</summary>
        public double OverlayDistance;

        public static implicit operator LinksDesc(ushort[] joints)
        {
            return joints == null ? null : new LinksDesc { Joints = joints };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_links_desc*)c.New(sizeof(hf_links_desc));
            desc->struct_size = (uint)sizeof(hf_links_desc);
            desc->mode = (int)Mode;
            desc->distance = Distance;
            desc->stiffness = Stiffness;
            desc->overlay_distance = OverlayDistance;
            desc->joints = (IntPtr)c.Array(Joints, "joints", "vertex_count", prefix + "influence_count");
            desc->weights = (IntPtr)c.Array(Weights, "weights", "vertex_count", prefix + "influence_count");
            desc->joint_parents = (IntPtr)c.Array(JointParents, "jointParents", prefix + "joint_count");
            desc->tags = (IntPtr)c.Array(Tags, "tags", "vertex_count");
            var linksRows = (hf_link*)c.Given(Links, "links", sizeof(hf_link), prefix + "link_count");
            for (int i = 0; Links != null && i < Links.Length; ++i) Links[i].Write(c, linksRows + i);
            desc->links = (IntPtr)linksRows;
            desc->light_vertices = (IntPtr)c.Array(LightVertices, "lightVertices", prefix + "light_count");
            desc->heavy_vertices = (IntPtr)c.Array(HeavyVertices, "heavyVertices", prefix + "heavy_count");
            desc->influence_count = (uint)c.Count(prefix + "influence_count", 0);
            desc->link_count = (uint)c.Count(prefix + "link_count", 0);
            desc->light_count = (uint)c.Count(prefix + "light_count", 0);
            desc->heavy_count = (uint)c.Count(prefix + "heavy_count", 0);
            desc->joint_count = (uint)c.Count(prefix + "joint_count", 0);
            return (IntPtr)desc;
        }
    }

    /// <summary>Faces of any number of corners. Set corners, and the arrays that your host stores: sizes alone (Maya, USD),
    /// starts and sizes (Blender's loops), or starts alone as offsets (newer Blender). Where this interface names a
    /// triangle of such a mesh, it names a face.
    ///
    /// No field depends on how you would cut a face into triangles. Operator.IntrinsicDelaunay takes the mean of
    /// both cuts of a bent quad. It moves this mean towards the polygon Laplacian of Bunge and others 2020 until a
    /// weight would become negative; docs/surfaces.md compares errors. Operator.Cotangent and Operator.Clamped use
    /// that polygon Laplacian. Operator.Uniform uses the sides of the faces. Directions, distances, iso-lines,
    /// streamlines and quads work on triangles: the library cuts the faces. Its cut does not depend on the order of
    /// the corners. Normals of poses are sums of the area vectors of faces.</summary>
    public sealed unsafe class FacesDesc
    {
        /// <summary>[cornerCount] of uint32_t: vertices, counter-clockwise seen from outside</summary>
        public uint[] Corners;
        /// <summary>null, or [faces] of uint32_t: corners of each face, 3 to 65,535. null: starts give them</summary>
        public uint[] Sizes;
        /// <summary>null, or [faces] of uint32_t: first corner of each face. null: the faces follow one another. Without
        /// sizes [faces + 1]: the corners of face f end where face f + 1 starts</summary>
        public uint[] Starts;

        public static implicit operator FacesDesc(uint[] corners)
        {
            return corners == null ? null : new FacesDesc { Corners = corners };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_faces_desc*)c.New(sizeof(hf_faces_desc));
            desc->struct_size = (uint)sizeof(hf_faces_desc);
            desc->corners = c.View(Corners, "corners", "corner_count");
            desc->sizes = c.View(Sizes, "sizes", "faces");
            desc->starts = c.View(Starts, "starts", Sizes == null ? new[] { "faces + 1" } : new[] { "faces" });
            return (IntPtr)desc;
        }
    }

    /// <summary>Lists triangles that go, vertices and triangles that come in, and edges to cut along. Vertices and triangles
    /// keep their numbers; new ones follow those there are. New vertices are welded to no other, so two can lie at
    /// one place. A vertex without a triangle is isolated from then on, and a new triangle can take it again.
    ///
    /// A cut gives the vertices along it copies, and the triangles on one side take these. Surface.Cuts lists the
    /// corners. The end of a cut inside the surface stays one vertex, so a cut takes two edges there. A cut around
    /// a part, or from border to border, parts it from the rest: it is a component then.</summary>
    public sealed unsafe class PatchDesc
    {
        /// <summary>[removedTriangleCount] triangles of your mesh</summary>
        public uint[] RemovedTriangles;
        /// <summary>[newVertexCount x 3] in the unit of your mesh</summary>
        public double[] NewPositions;
        /// <summary>[newTriangleCount x 3] vertices of your mesh and new ones</summary>
        public uint[] NewTriangles;
        /// <summary>[cutEdgeCount x 2] the two vertices of an edge</summary>
        public uint[] CutEdges;

        public static implicit operator PatchDesc(uint[] removedTriangles)
        {
            return removedTriangles == null ? null : new PatchDesc { RemovedTriangles = removedTriangles };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_patch_desc*)c.New(sizeof(hf_patch_desc));
            desc->struct_size = (uint)sizeof(hf_patch_desc);
            desc->removed_triangles = (IntPtr)c.Array(RemovedTriangles, "removedTriangles",
                prefix + "removed_triangle_count");
            desc->new_positions = (IntPtr)c.Array(NewPositions, "newPositions", prefix + "new_vertex_count", "3");
            desc->new_triangles = (IntPtr)c.Array(NewTriangles, "newTriangles", prefix + "new_triangle_count", "3");
            desc->cut_edges = (IntPtr)c.Array(CutEdges, "cutEdges", prefix + "cut_edge_count", "2");
            desc->removed_triangle_count = (uint)c.Count(prefix + "removed_triangle_count", 0);
            desc->new_vertex_count = (uint)c.Count(prefix + "new_vertex_count", 0);
            desc->new_triangle_count = (uint)c.Count(prefix + "new_triangle_count", 0);
            desc->cut_edge_count = (uint)c.Count(prefix + "cut_edge_count", 0);
            return (IntPtr)desc;
        }
    }

    /// <summary>Places and values of sites. Set one of vertices, places and points. The finer the mesh, the less influence a
    /// point site has. Give the site a radius to avoid this: it then holds the field on a geodesic disc. A radius
    /// below the mesh spacing still gives a point. A soft disc shares its stiffness among its vertices. For
    /// harmonic fields the boundary vertices of a disc count towards site_limit; for bi-harmonic fields all its
    /// vertices do.</summary>
    public sealed unsafe class SitesDesc
    {
        /// <summary>[siteCount] vertices of your mesh, or null</summary>
        public uint[] Vertices;
        /// <summary>[siteCount x channelCount], up to 1e200 in size; null = 0</summary>
        public double[] Values;
        /// <summary>[siteCount], or null</summary>
        public Place[] Places;
        /// <summary>[siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
        /// the nearest point of the surface, up to two boxes away</summary>
        public double[] Points;
        /// <summary>[siteCount] &gt;= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard; clamped to
        /// 1e-12 to 1e12</summary>
        public double[] Stiffness;
        /// <summary>[siteCount] &gt;= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points</summary>
        public double[] Radii;

        public static implicit operator SitesDesc(uint[] vertices)
        {
            return vertices == null ? null : new SitesDesc { Vertices = vertices };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_sites_desc*)c.New(sizeof(hf_sites_desc));
            desc->struct_size = (uint)sizeof(hf_sites_desc);
            desc->vertices = (IntPtr)c.Array(Vertices, "vertices", prefix + "site_count");
            var placesRows = (hf_place*)c.Given(Places, "places", sizeof(hf_place), prefix + "site_count");
            for (int i = 0; Places != null && i < Places.Length; ++i) Places[i].Write(c, placesRows + i);
            desc->places = (IntPtr)placesRows;
            desc->points = (IntPtr)c.Array(Points, "points", prefix + "site_count", "3");
            desc->values = (IntPtr)c.Array(Values, "values", prefix + "site_count", "channel_count");
            desc->stiffness = (IntPtr)c.Array(Stiffness, "stiffness", prefix + "site_count");
            desc->radii = (IntPtr)c.Array(Radii, "radii", prefix + "site_count");
            desc->site_count = (uint)c.Count(prefix + "site_count", 1);
            return (IntPtr)desc;
        }
    }

    /// <summary>Describes a closed curve through at least 3 points, on the mesh at rest. Set one of vertices, places and
    /// points. The vertices on the chosen side of the curve are the region. A single vertex joins the region too if
    /// all its neighbours but one are in it. The rim is the vertices next to the region, on or beyond the curve. It
    /// follows the curve within an edge; where the curve runs along edges, the rim is the curve. A whole border of
    /// the surface is a curve too; it has only one side. The curve passes a vertex at most 8 times.</summary>
    public sealed unsafe class CurveDesc
    {
        /// <summary>[pointCount] vertices of your mesh, or null</summary>
        public uint[] Vertices;
        /// <summary>[pointCount], or null</summary>
        public Place[] Places;
        /// <summary>[pointCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands for
        /// the nearest point of the surface, up to two boxes away</summary>
        public double[] Points;
        public Side Side;
        /// <summary>with Side.Seed</summary>
        public uint SeedVertex;
        public CurveKind Kind;

        public static implicit operator CurveDesc(uint[] vertices)
        {
            return vertices == null ? null : new CurveDesc { Vertices = vertices };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_curve_desc*)c.New(sizeof(hf_curve_desc));
            desc->struct_size = (uint)sizeof(hf_curve_desc);
            desc->side = (int)Side;
            desc->seed_vertex = SeedVertex;
            desc->kind = (int)Kind;
            desc->vertices = (IntPtr)c.Array(Vertices, "vertices", prefix + "point_count");
            var placesRows = (hf_place*)c.Given(Places, "places", sizeof(hf_place), prefix + "point_count");
            for (int i = 0; Places != null && i < Places.Length; ++i) Places[i].Write(c, placesRows + i);
            desc->places = (IntPtr)placesRows;
            desc->points = (IntPtr)c.Array(Points, "points", prefix + "point_count", "3");
            desc->point_count = (uint)c.Count(prefix + "point_count", 0);
            return (IntPtr)desc;
        }
    }

    /// <summary>The skin of a character: its surface, and the joints of each vertex. These are the arrays of a glTF skin as
    /// the file has them: with inverse_binds the library moves the surface from the pose of binding to the pose
    /// `rest`.</summary>
    public sealed unsafe class SkinDesc
    {
        /// <summary>[vertexCount x 3]</summary>
        public float[] Positions;
        /// <summary>[triangleCount x 3], or null with triangle_count 0</summary>
        public uint[] Triangles;
        /// <summary>[vertexCount x influenceCount]</summary>
        public uint[] Joints;
        /// <summary>[vertexCount x influenceCount] &gt;= 0; a vertex whose weights are all 0 has no joint</summary>
        public float[] Weights;
        /// <summary>1: positions are in the pose `rest` and in the space of the joints, also with inverse_binds. 0: in the
        ///     pose of inverse_binds if there are any</summary>
        public bool AtRest;

        public static implicit operator SkinDesc(float[] positions)
        {
            return positions == null ? null : new SkinDesc { Positions = positions };
        }

        internal IntPtr Fill(Call c, string prefix)
        {
            var desc = (hf_skin_desc*)c.New(sizeof(hf_skin_desc));
            desc->struct_size = (uint)sizeof(hf_skin_desc);
            desc->at_rest = AtRest ? 1 : 0;
            desc->positions = (IntPtr)c.Array(Positions, "positions", prefix + "vertex_count", "3");
            desc->triangles = (IntPtr)c.Array(Triangles, "triangles", prefix + "triangle_count", "3");
            desc->joints = (IntPtr)c.Array(Joints, "joints", prefix + "vertex_count", prefix + "influence_count");
            desc->weights = (IntPtr)c.Array(Weights, "weights", prefix + "vertex_count", prefix + "influence_count");
            desc->vertex_count = (uint)c.Count(prefix + "vertex_count", 0);
            desc->triangle_count = (uint)c.Count(prefix + "triangle_count", 0);
            desc->influence_count = (uint)c.Count(prefix + "influence_count", 0);
            return (IntPtr)desc;
        }
    }

    /// <summary>Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one
    /// object for one call at a time. If a cancel may come after the end of the call, make a new object for the
    /// next call.
    ///
    /// Creates a progress object.</summary>
    public sealed unsafe class Progress : HfObject
    {
        /// <summary>Creates a progress object.</summary>
        public Progress()
        {
            using (var c = new Call(null))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_progress_create(raw)));
                Own(*raw, Functions.hf_progress_destroy, c);
            }
        }

        /// <summary>Writes how much of the running call is done.</summary>
        public double Fraction
        {
            get
            {
                using (var c = new Call(this))
                {
                    double fraction = 0;
                    HfException.Check(Functions.hf_progress_get_fraction(RawHandle, &fraction));
                    return fraction;
                }
            }
        }

        /// <summary>Stops the call that uses this object, or the next one that does. That call returns HF_ERROR_CANCELLED.</summary>
        public void Cancel()
        {
            using (var c = new Call(this))
            {
                HfException.Check(Functions.hf_progress_cancel(RawHandle));
            }
        }
    }

    /// <summary>hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.
    ///
    /// Make one surface per mesh, or per graph of your own (Surface.FromGraph). Solvers, poses, direction fields,
    /// regions, transfers and quads are made on a surface and share its factor. A surface never changes, so any
    /// number of threads may use it: an edit makes another one (Surface.Edit). An object made on a surface keeps
    /// the data it needs, so you can destroy objects in any order.
    ///
    /// Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies
    /// the mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be
    /// dirty: the surface counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices
    /// and components. Surface.Report gives these counts.
    ///
    /// A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are
    /// doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such as a
    /// leaf, hair or a cape, is one sheet with a border. Results give the index of the first of doubled triangles;
    /// calls take the index of any. Vertices of the second side alone get opposite normals from poses, and a ray
    /// with front_only hits both sides.
    ///
    /// positions: [vertexCount x 3] of float or double, any unit, any offset
    /// triangles: [triangleCount x 3] of uint32_t or uint16_t, counter-clockwise seen from outside
    /// weld: Weld
    /// faces: faces instead of triangles
    /// weldTolerance: for Weld.Tolerance, in the unit of the positions, &gt; 0
    /// operatorKind: Operator
    /// fieldKind: FieldKind: the factor made now. Others are made when a solver or region needs one
    /// ordering: Ordering
    /// threadCount: threads the library may use, yours included, 1 to 256; 0 = 1
    /// vertexLimit: refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices,
    ///     triangles or edges are always refused
    /// triangleLimit: refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the
    ///     vertex limit
    /// memoryLimitMb: refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
    /// workLimitGflop: refuse a factorisation of more than this many 10^9 operations. They are counted before it
    ///     begins; 0 = 100,000, about an hour of one core
    /// progress: an object to poll and cancel through
    /// savedFactor: the saved factor of this mesh; ordering is then 0 or the factor's
    /// links: null: LinkMode.None. A saved factor needs the links it was made with</summary>
    public sealed unsafe class Surface : HfObject
    {
        Surface() { }

        /// <summary>Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call
        /// copies the mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh
        /// may be dirty: the surface counts non-manifold edges, flipped, duplicate and zero-area triangles,
        /// isolated vertices and components. Surface.Report gives these counts.
        ///
        /// A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces
        /// are doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such
        /// as a leaf, hair or a cape, is one sheet with a border. Results give the index of the first of doubled
        /// triangles; calls take the index of any. Vertices of the second side alone get opposite normals from
        /// poses, and a ray with front_only hits both sides.
        ///
        /// positions: [vertexCount x 3] of float or double, any unit, any offset
        /// triangles: [triangleCount x 3] of uint32_t or uint16_t, counter-clockwise seen from outside
        /// weld: Weld
        /// faces: faces instead of triangles
        /// weldTolerance: for Weld.Tolerance, in the unit of the positions, &gt; 0
        /// operatorKind: Operator
        /// fieldKind: FieldKind: the factor made now. Others are made when a solver or region needs one
        /// ordering: Ordering
        /// threadCount: threads the library may use, yours included, 1 to 256; 0 = 1
        /// vertexLimit: refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices,
        ///     triangles or edges are always refused
        /// triangleLimit: refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the
        ///     vertex limit
        /// memoryLimitMb: refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
        /// workLimitGflop: refuse a factorisation of more than this many 10^9 operations. They are counted before
        ///     it begins; 0 = 100,000, about an hour of one core
        /// progress: an object to poll and cancel through
        /// savedFactor: the saved factor of this mesh; ordering is then 0 or the factor's
        /// links: null: LinkMode.None. A saved factor needs the links it was made with
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public Surface(Reals positions = null, Indices triangles = null, Weld weld = default(Weld),
                FacesDesc faces = null, double weldTolerance = 0, Operator operatorKind = default(Operator),
                FieldKind fieldKind = default(FieldKind), Ordering ordering = default(Ordering), uint threadCount = 0,
                uint vertexLimit = 0, uint triangleLimit = 0, uint memoryLimitMb = 0, uint workLimitGflop = 0,
                Progress progress = null, FactorDesc savedFactor = null, LinksDesc links = null)
        {
            using (var c = new Call(null))
            {
                var descStruct = new hf_surface_desc { struct_size = (uint)sizeof(hf_surface_desc), weld = (int)weld,
                    weld_tolerance = weldTolerance, operator_kind = (int)operatorKind, field_kind = (int)fieldKind,
                    ordering = (int)ordering, thread_count = threadCount, vertex_limit = vertexLimit,
                    triangle_limit = triangleLimit, memory_limit_mb = memoryLimitMb,
                    work_limit_gflop = workLimitGflop };
                hf_surface_desc* desc = &descStruct;
                desc->positions = c.View(positions?.Values, "positions", "vertex_count", "3");
                desc->triangles = c.View(triangles?.Values, "triangles", "triangle_count", "3");
                desc->progress = c.Handle(progress);
                if (faces != null) desc->faces = faces.Fill(c, "faces.");
                if (savedFactor != null) desc->saved_factor = savedFactor.Fill(c, "saved_factor.");
                if (links != null) desc->links = links.Fill(c, "links.");
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_surface_create(desc, raw)));
                Own(*raw, Functions.hf_surface_destroy, c, "vertex_count");
            }
        }

        /// <summary>Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call
        /// copies the graph. Solvers with sites at vertices, fields, previews, certificates, clones, saved factors,
        /// components and reports work as on a mesh. A call that needs triangles returns HF_ERROR_UNSUPPORTED.
        /// These are poses, regions, directions, geodesics, iso-lines, extremities, quads, flow, picking,
        /// transfers, skin weights, vector fields, links and screening. Sites at places, at points or on discs need
        /// triangles too.
        ///
        /// A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from
        /// the median of their component by a factor above 1e30 are limited; MeshStatistics counts their vertices
        /// as changed. Bi-harmonic fields limit weights to 1e3 times the median.
        ///
        /// edges: [edgeCount x 2] of uint32_t or uint16_t: vertices, in any order. The weights of parallel edges
        ///     are added up. Self loops are ignored
        /// weights: [edgeCount] of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left out
        /// masses: [vertexCount] of float or double: M of FieldKind.Biharmonic, any unit, above 0 and up to 1e100;
        ///     null: all 1. A mass below 1e-4 of the mean of its component is raised to it
        /// vertexCount: &gt;= 1, also without masses
        /// allowNegative: 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of
        ///     tetrahedra do. A field can then leave the range of its sites. 0: they are refused
        /// fieldKind: FieldKind: the factor made now. Others are made when a solver asks
        /// ordering: Ordering
        /// threadCount: threads the library may use, yours included, 1 to 256; 0 = 1
        /// vertexLimit: refuse larger graphs before allocating; 0 = 20,000,000
        /// edgeLimit: refuse more edges; 0 = sixteen per vertex of the vertex limit
        /// memoryLimitMb: refuse to hold more memory than this, in MiB; 0 = no limit
        /// workLimitGflop: refuse a factorisation of more than this many 10^9 operations; 0 = 100,000
        /// progress: an object to poll and cancel through
        /// savedFactor: the saved factor of this graph; ordering is then 0 or the factor's
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public static Surface FromGraph(Indices edges = null, Reals weights = null, Reals masses = null,
                uint vertexCount = 0, bool allowNegative = false, FieldKind fieldKind = default(FieldKind),
                Ordering ordering = default(Ordering), uint threadCount = 0, uint vertexLimit = 0, uint edgeLimit = 0,
                uint memoryLimitMb = 0, uint workLimitGflop = 0, Progress progress = null,
                FactorDesc savedFactor = null)
        {
            using (var c = new Call(null))
            {
                var descStruct = new hf_graph_desc { struct_size = (uint)sizeof(hf_graph_desc),
                    vertex_count = vertexCount, allow_negative = allowNegative ? 1 : 0, field_kind = (int)fieldKind,
                    ordering = (int)ordering, thread_count = threadCount, vertex_limit = vertexLimit,
                    edge_limit = edgeLimit, memory_limit_mb = memoryLimitMb, work_limit_gflop = workLimitGflop };
                hf_graph_desc* desc = &descStruct;
                if (vertexCount != 0) c.Sizes["vertex_count"] = (int)Math.Min(vertexCount, int.MaxValue);
                desc->edges = c.View(edges?.Values, "edges", "edge_count", "2");
                desc->weights = c.View(weights?.Values, "weights", "edge_count");
                desc->masses = c.View(masses?.Values, "masses", "vertex_count");
                desc->progress = c.Handle(progress);
                if (savedFactor != null) desc->saved_factor = savedFactor.Fill(c, "saved_factor.");
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_surface_create_graph(desc, raw)));
                var made = new Surface();
                made.Own(*raw, Functions.hf_surface_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Writes the options of a surface.</summary>
        public SurfaceInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_surface_info { struct_size = (uint)sizeof(hf_surface_info) };
                    hf_surface_info* info = &infoStruct;
                    HfException.Check(Functions.hf_surface_get_info(RawHandle, info));
                    return new SurfaceInfo(info);
                }
            }
        }

        /// <summary>Writes the report of the mesh.</summary>
        public SurfaceReport Report
        {
            get
            {
                using (var c = new Call(this))
                {
                    var reportStruct = new hf_surface_report { struct_size = (uint)sizeof(hf_surface_report) };
                    hf_surface_report* report = &reportStruct;
                    HfException.Check(Functions.hf_surface_get_report(RawHandle, report));
                    return new SurfaceReport(report);
                }
            }
        }

        /// <summary>Writes the statistics of the mesh.</summary>
        public MeshStatistics MeshStatistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_mesh_statistics { struct_size = (uint)sizeof(hf_mesh_statistics) };
                    hf_mesh_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_surface_get_mesh_statistics(RawHandle, statistics));
                    return new MeshStatistics(statistics);
                }
            }
        }

        /// <summary>Writes the component of every vertex of your mesh, and uint.MaxValue for isolated vertices. Components
        /// are numbered in the order of their lowest vertex numbers.</summary>
        public uint[] Components()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allComponents = null;
                c.Room("capacity", "hf_surface_get_components.capacity");
                int result;
                do
                {
                        void* componentsPlace = (void*)c.Make(out allComponents, "capacity");
                        result = Functions.hf_surface_get_components(RawHandle, (uint)c.Size("capacity"),
                            componentsPlace, &count);
                }
                while (c.Again("hf_surface_get_components", result, ("capacity", count)));
                return c.Cut(allComponents, "capacity");
            }
        }

        /// <summary>Writes how the pieces of a surface are linked.</summary>
        public LinksInfo LinksInfo
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_links_info { struct_size = (uint)sizeof(hf_links_info) };
                    hf_links_info* info = &infoStruct;
                    HfException.Check(Functions.hf_surface_get_links_info(RawHandle, info));
                    return new LinksInfo(info);
                }
            }
        }

        /// <summary>Writes the links of a surface. You can edit them and give them back with LinkMode.List. A list does not
        /// say which pieces are light: name them in light_vertices, as Surface.Pieces marks them. Then the list
        /// alone gives the same surface, bit for bit, without a search.</summary>
        public Link[] Links()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* linksPlace = null;
                c.Room("capacity", "hf_surface_get_links.capacity");
                int result;
                do
                {
                        linksPlace = c.Rows(sizeof(hf_link), "capacity");
                        result = Functions.hf_surface_get_links(RawHandle, (uint)c.Size("capacity"), linksPlace,
                            &count);
                }
                while (c.Again("hf_surface_get_links", result, ("capacity", count)));
                var links = new Link[c.Product("capacity")];
                for (int i = 0; i < links.Length; ++i)
                    links[i] = new Link((hf_link*)linksPlace + i);
                return links;
            }
        }

        /// <summary>Writes the piece of every vertex of your mesh, and uint.MaxValue for isolated vertices. Pieces are
        /// numbered in the order of their lowest vertices.</summary>
        public (uint[] Pieces, int[] Light) Pieces()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allPieces = null;
                int[] allLight = null;
                c.Room("capacity", "hf_surface_get_pieces.capacity");
                int result;
                do
                {
                        void* piecesPlace = (void*)c.Make(out allPieces, "capacity");
                        void* lightPlace = (void*)c.Make(out allLight, "capacity");
                        result = Functions.hf_surface_get_pieces(RawHandle, (uint)c.Size("capacity"), piecesPlace,
                            lightPlace, &count);
                }
                while (c.Again("hf_surface_get_pieces", result, ("capacity", count)));
                return (c.Cut(allPieces, "capacity"), c.Cut(allLight, "capacity"));
            }
        }

        /// <summary>Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther
        /// its ends are apart than at rest, and 0 if they are nearer. The gap of a contact (LinksInfo) is measured
        /// in the same way. A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With
        /// joint_parents its joint must be the joint of the nearest point there, or the parent or child of that
        /// joint. Each touches one point of the piece: the nearest at rest. Its opening is the smaller of two
        /// distances, minus the distance at rest: its own distance from the piece, and the distance of the point
        /// that it touched from the piece of the vertex. So a piece that slides along another opens no vertex, but
        /// its links have gaps. Touching vertices are found where links are: by Surface and Surface.Relink. Links
        /// that an edit adds have none.
        ///
        /// positions: [vertexCount x 3] of float or double: the deformed mesh. It can come from a pose, a transfer
        ///     or any other source.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public double[] MeasureGaps(Reals positions)
        {
            using (var c = new Call(this))
            {
                var info = new hf_gaps_info { struct_size = (uint)sizeof(hf_gaps_info) };
                hf_array positions_Array = c.View(positions?.Values, "positions", "vertex_count", "3");
                hf_array* positions_ = &positions_Array;
                double[] allGaps = null;
                c.Room("capacity", "hf_surface_measure_gaps.capacity");
                int result;
                do
                {
                        void* gapsPlace = (void*)c.Make(out allGaps, "capacity");
                        result = Functions.hf_surface_measure_gaps(RawHandle, positions == null ? null : positions_,
                            (uint)c.Size("capacity"), gapsPlace, &info);
                }
                while (c.Again("hf_surface_measure_gaps", result, ("capacity", info.link_count)));
                lastGapsInfo = info;
                return c.Cut(allGaps, "capacity");
            }
        }

        /// <summary>Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the
        /// old one where its matrix has the same pattern: other stiffness, weights or light pieces.
        ///
        /// joints: [vertexCount x influenceCount] of a skin: pieces of the same joint link sooner
        /// weights: [vertexCount x influenceCount] of sum 1; where all are 0, a vertex shares no joint
        /// jointParents: [jointCount] parent of each joint, uint.MaxValue for a root; needs joints and weights.
        ///     Pieces of parent and child link wherever they touch. Pieces of joints farther apart in the skeleton,
        ///     such as two feet, link only if nothing else joins them
        /// tags: [vertexCount]: pieces with different tags do not link, as a rider and a horse. The first vertex of
        ///     a piece counts
        /// links: [linkCount]
        /// lightVertices: [lightCount]: their pieces are light
        /// heavyVertices: [heavyCount]: their pieces are not, as one that gets a site or handle
        /// mode: LinkMode
        /// distance: longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal
        /// stiffness: of all links, times each one's weight; 0 = 1
        /// overlayDistance: automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5
        ///     % of the diagonal, below 0: no piece is light unless light_vertices say so
        /// progress: an object to poll and cancel through.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public Surface Relink(ushort[] joints = null, float[] weights = null, uint[] jointParents = null,
                uint[] tags = null, Link[] links = null, uint[] lightVertices = null, uint[] heavyVertices = null,
                LinkMode mode = default(LinkMode), double distance = 0, double stiffness = 0,
                double overlayDistance = 0, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_links_desc { struct_size = (uint)sizeof(hf_links_desc), mode = (int)mode,
                    distance = distance, stiffness = stiffness, overlay_distance = overlayDistance };
                hf_links_desc* desc = &descStruct;
                desc->joints = (IntPtr)c.Array(joints, "joints", "vertex_count", "influence_count");
                desc->weights = (IntPtr)c.Array(weights, "weights", "vertex_count", "influence_count");
                desc->joint_parents = (IntPtr)c.Array(jointParents, "jointParents", "joint_count");
                desc->tags = (IntPtr)c.Array(tags, "tags", "vertex_count");
                var linksRows = (hf_link*)c.Given(links, "links", sizeof(hf_link), "link_count");
                for (int i = 0; links != null && i < links.Length; ++i) links[i].Write(c, linksRows + i);
                desc->links = (IntPtr)linksRows;
                desc->light_vertices = (IntPtr)c.Array(lightVertices, "lightVertices", "light_count");
                desc->heavy_vertices = (IntPtr)c.Array(heavyVertices, "heavyVertices", "heavy_count");
                desc->influence_count = (uint)c.Count("influence_count", 0);
                desc->link_count = (uint)c.Count("link_count", 0);
                desc->light_count = (uint)c.Count("light_count", 0);
                desc->heavy_count = (uint)c.Count("heavy_count", 0);
                desc->joint_count = (uint)c.Count("joint_count", 0);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_surface_relink(RawHandle, desc, c.Handle(progress), raw));
                var made = new Surface();
                made.Own(*raw, Functions.hf_surface_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it
        /// is. The new surface shares the factor: an edit of up to a few thousand vertices costs the elimination
        /// paths of its rim, as sites do, and a link costs up to six paths. The library factorises again with the
        /// same ordering where that costs less, and for bi-harmonic fields. A surface that is edited back has the
        /// fields of the old one.
        ///
        /// Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes
        /// lengths of edges by about half a percent in the mean. A part that must not bend at all is a rigid piece
        /// (Pose.SetRigidPieces). Bi-harmonic operators square it, so they count at most 100 and at least 0.01.
        /// Lengths do not change, so regions, transfers, distances, directions and quads do not see stiffness.
        ///
        /// A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken
        /// up and dropped. The new surface is the one that Surface.Relink makes of the same list of links.
        /// Surface.Components gives the new components. Light pieces and contacts stay as they are.
        ///
        /// After a patch the surface is the one that Surface makes of the triangles without the removed ones and
        /// with the new ones, Weld.None for the new vertices. Vertices keep their stiffness. New ones, and those
        /// that were isolated, have 1. Distances, directions and quads make a factor of their own when they are
        /// first asked for, as on a new surface. Patches over a quarter of the surface, and with Operator.Clamped,
        /// make the whole operator and its factor anew. Take links out before, and put them in again after it.
        ///
        /// Solver.MoveTo takes sites along, and Pose.MoveTo takes handles along. After a patch or a cut make a new
        /// pose: Pose.MoveTo refuses other triangles. Soft sites keep the unit of their stiffness while links and
        /// triangles stay; others change it as they do for Surface.Relink. Surface.Save is refused: save the factor
        /// of the surface before its edits. Memory limits hold for both surfaces together.
        ///
        /// vertices: [vertexCount] as given; other vertices keep their stiffness. null: all vertices in order
        /// stiffness: [vertexCount] 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. null: no
        ///     stiffness changes, and vertex_count is 0
        /// links: [linkCount] links that come in, after those that stay
        /// removedLinks: [removedLinkCount] links that go out, by their numbers in Surface.Links
        /// patch: triangles that go and come, or a cut; the edit changes nothing else then
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT,
        /// HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public Surface Edit(uint[] vertices = null, double[] stiffness = null, Link[] links = null,
                uint[] removedLinks = null, PatchDesc patch = null, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_surface_edit_desc { struct_size = (uint)sizeof(hf_surface_edit_desc) };
                hf_surface_edit_desc* desc = &descStruct;
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "list_vertex_count");
                desc->stiffness = (IntPtr)c.Array(stiffness, "stiffness", "list_vertex_count");
                var linksRows = (hf_link*)c.Given(links, "links", sizeof(hf_link), "list_link_count");
                for (int i = 0; links != null && i < links.Length; ++i) links[i].Write(c, linksRows + i);
                desc->links = (IntPtr)linksRows;
                desc->removed_links = (IntPtr)c.Array(removedLinks, "removedLinks", "list_removed_link_count");
                desc->progress = c.Handle(progress);
                if (patch != null) desc->patch = patch.Fill(c, "patch.");
                desc->vertex_count = (uint)c.Count("list_vertex_count", 0);
                desc->link_count = (uint)c.Count("list_link_count", 0);
                desc->removed_link_count = (uint)c.Count("list_removed_link_count", 0);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_surface_edit(RawHandle, desc, raw));
                var made = new Surface();
                made.Own(*raw, Functions.hf_surface_destroy, c, "vertex_count");
                made.Counts["vertex_count"] = (int)made.Info.VertexCount;
                return made;
            }
        }

        /// <summary>Writes the corners that all cuts gave other vertices since the surface was made, in the order of the
        /// cuts. A second cut adds its corners behind the corners of the first cut: go on from the last count.</summary>
        public CutCorner[] Cuts()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* cutsPlace = null;
                c.Room("capacity", "hf_surface_get_cuts.capacity");
                int result;
                do
                {
                        cutsPlace = c.Rows(sizeof(hf_cut_corner), "capacity");
                        result = Functions.hf_surface_get_cuts(RawHandle, (uint)c.Size("capacity"), cutsPlace, &count);
                }
                while (c.Again("hf_surface_get_cuts", result, ("capacity", count)));
                var cuts = new CutCorner[c.Product("capacity")];
                for (int i = 0; i < cuts.Length; ++i)
                    cuts[i] = new CutCorner((hf_cut_corner*)cutsPlace + i);
                return cuts;
            }
        }

        /// <summary>Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices.</summary>
        public double[] Stiffness()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                double[] allStiffness = null;
                c.Room("capacity", "hf_surface_get_stiffness.capacity");
                int result;
                do
                {
                        void* stiffnessPlace = (void*)c.Make(out allStiffness, "capacity");
                        result = Functions.hf_surface_get_stiffness(RawHandle, (uint)c.Size("capacity"), stiffnessPlace,
                            &count);
                }
                while (c.Again("hf_surface_get_stiffness", result, ("capacity", count)));
                return c.Cut(allStiffness, "capacity");
            }
        }

        /// <summary>Writes the statistics of a surface and of the factor it was made with.</summary>
        public SurfaceStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_surface_statistics { struct_size = (uint)sizeof(hf_surface_statistics) };
                    hf_surface_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_surface_get_statistics(RawHandle, statistics));
                    return new SurfaceStatistics(statistics);
                }
            }
        }

        /// <summary>Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside
        /// the mesh and gives them to Surface, which then takes a fraction of the time. The bytes are the same for
        /// the same mesh, options and library version, whatever the number of threads. The bytes are little-endian
        /// and hold a format version, a hash of the matrix and a checksum. They hold no sites.
        ///
        /// fieldKind: FieldKind. If its factor does not exist yet, the call makes it first.
        /// progress: an object to poll and cancel through.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_TOO_SMALL.</summary>
        public byte[] Save(FieldKind fieldKind = default(FieldKind), Progress progress = null)
        {
            using (var c = new Call(this))
            {
                UIntPtr size = UIntPtr.Zero;
                HfException.Check(Functions.hf_surface_save(RawHandle, (int)fieldKind, c.Handle(progress), (UIntPtr)0,
                    null, &size));
                var block = new byte[(int)size];
                HfException.Check(Functions.hf_surface_save(RawHandle, (int)fieldKind, c.Handle(progress),
                    (UIntPtr)block.Length, (void*)c.Pin(block), &size));
                return block;
            }
        }

        /// <summary>Turns a line on the surface into a cut through triangles. Give the arrays to Surface.Edit as a patch,
        /// and change your mesh in the same way. The surface itself does not change.
        ///
        /// A line from border to border, or a closed line around a part, parts it from the rest. A line that starts
        /// at the border opens it. An end inside the surface stays closed. The line may pass vertices and run along
        /// edges. It is straight where its triangles are unfolded, and bends at its points and at vertices only.
        /// The parts of a triangle are a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an
        /// edge. On a mesh whose triangles are turned alike, left is left for a viewer who looks at the outside
        /// along the line. New vertices have the stiffness 1.
        ///
        /// vertices: [pointCount] vertices of your mesh, or null
        /// places: [pointCount], or null
        /// points: [pointCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each
        ///     stands for the nearest point of the surface, up to two boxes away
        /// snapShare: a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer to
        ///     an edge than this share of the height moves onto the edge. So no slivers come in. From 1e-6 to 0.4;
        ///     0 = 0.05
        /// crossingLimit: refuse a line of more points and crossings of edges; 0 = 1,000,000
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT,
        /// HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL,
        /// HF_ERROR_UNSUPPORTED.</summary>
        public Cut TraceCut(uint[] vertices = null, Place[] places = null, double[] points = null, double snapShare = 0,
                uint crossingLimit = 0, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_cut_desc { struct_size = (uint)sizeof(hf_cut_desc), snap_share = snapShare,
                    crossing_limit = crossingLimit };
                hf_cut_desc* desc = &descStruct;
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "point_count");
                var placesRows = (hf_place*)c.Given(places, "places", sizeof(hf_place), "point_count");
                for (int i = 0; places != null && i < places.Length; ++i) places[i].Write(c, placesRows + i);
                desc->places = (IntPtr)placesRows;
                desc->points = (IntPtr)c.Array(points, "points", "point_count", "3");
                desc->progress = c.Handle(progress);
                desc->point_count = (uint)c.Count("point_count", 0);
                var cutStruct = new hf_cut { struct_size = (uint)sizeof(hf_cut) };
                hf_cut* cut = &cutStruct;
                uint[] allRemovedTriangles = null;
                double[] allNewPositions = null;
                uint[] allNewTriangles = null;
                uint[] allVertexCorners = null;
                double[] allVertexBarycentrics = null;
                uint[] allSourceTriangles = null;
                double[] allCornerBarycentrics = null;
                uint[] allRimVertices = null;
                c.Room("removed_triangle_capacity", "hf_surface_trace_cut.removed_triangle_capacity");
                c.Room("new_vertex_capacity", "hf_surface_trace_cut.new_vertex_capacity");
                c.Room("new_triangle_capacity", "hf_surface_trace_cut.new_triangle_capacity");
                c.Room("rim_capacity", "hf_surface_trace_cut.rim_capacity");
                int result;
                do
                {
                        cut->removed_triangle_capacity = (uint)c.Size("removed_triangle_capacity");
                        cut->new_vertex_capacity = (uint)c.Size("new_vertex_capacity");
                        cut->new_triangle_capacity = (uint)c.Size("new_triangle_capacity");
                        cut->rim_capacity = (uint)c.Size("rim_capacity");
                        cut->removed_triangles = c.Make(out allRemovedTriangles, "removed_triangle_capacity");
                        cut->new_positions = c.Make(out allNewPositions, "new_vertex_capacity", "3");
                        cut->new_triangles = c.Make(out allNewTriangles, "new_triangle_capacity", "3");
                        cut->vertex_corners = c.Make(out allVertexCorners, "new_vertex_capacity", "3");
                        cut->vertex_barycentrics = c.Make(out allVertexBarycentrics, "new_vertex_capacity", "3");
                        cut->source_triangles = c.Make(out allSourceTriangles, "new_triangle_capacity");
                        cut->corner_barycentrics = c.Make(out allCornerBarycentrics, "new_triangle_capacity", "3", "3");
                        cut->rim_vertices = c.Make(out allRimVertices, "rim_capacity", "2");
                        result = Functions.hf_surface_trace_cut(RawHandle, desc, cut);
                }
                while (c.Again("hf_surface_trace_cut", result, ("removed_triangle_capacity",
                    cut->removed_triangle_count), ("new_vertex_capacity", cut->new_vertex_count),
                    ("new_triangle_capacity", cut->new_triangle_count), ("rim_capacity", cut->rim_count)));
                return new Cut { RemovedTriangles = c.Cut(allRemovedTriangles, "removed_triangle_capacity"),
                    NewPositions = c.Cut(allNewPositions, "new_vertex_capacity", "3"),
                    NewTriangles = c.Cut(allNewTriangles, "new_triangle_capacity", "3"),
                    VertexCorners = c.Cut(allVertexCorners, "new_vertex_capacity", "3"),
                    VertexBarycentrics = c.Cut(allVertexBarycentrics, "new_vertex_capacity", "3"),
                    SourceTriangles = c.Cut(allSourceTriangles, "new_triangle_capacity"),
                    CornerBarycentrics = c.Cut(allCornerBarycentrics, "new_triangle_capacity", "3", "3"),
                    RimVertices = c.Cut(allRimVertices, "rim_capacity", "2") };
            }
        }

        /// <summary>Finds what a mouse click hits: the first triangle on a ray.
        ///
        /// origin: [3] in the frame of the positions. The direction can have any length above 0.
        /// direction: [3] in the frame of the positions. The direction can have any length above 0.
        /// positions: [vertexCount x 3] of float or double: posed positions (Pose.Deform writes them). null: the
        ///     rest positions
        /// frontOnly: 1: a ray passes through triangles seen from behind
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public Hit CastRay(double[] origin, double[] direction, Reals positions = null, bool frontOnly = false)
        {
            using (var c = new Call(this))
            {
                void* origin_ = c.Array(origin, "origin", "3");
                void* direction_ = c.Array(direction, "direction", "3");
                var descStruct = new hf_pick_desc { struct_size = (uint)sizeof(hf_pick_desc),
                    front_only = frontOnly ? 1 : 0 };
                hf_pick_desc* desc = &descStruct;
                desc->positions = c.View(positions?.Values, "positions", "vertex_count", "3");
                var hitStruct = new hf_hit { struct_size = (uint)sizeof(hf_hit) };
                hf_hit* hit = &hitStruct;
                HfException.Check(Functions.hf_surface_cast_ray(RawHandle, origin_, direction_, desc, hit));
                return hit->found == 0 ? null : new Hit(hit);
            }
        }

        /// <summary>Finds the vertex nearest to a point.
        ///
        /// point: [3] in the frame of the positions.
        /// positions: [vertexCount x 3] of float or double: posed positions (Pose.Deform writes them). null: the
        ///     rest positions
        /// frontOnly: 1: a ray passes through triangles seen from behind
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public (uint Vertex, double Distance) FindVertex(double[] point, Reals positions = null, bool frontOnly = false)
        {
            using (var c = new Call(this))
            {
                void* point_ = c.Array(point, "point", "3");
                var descStruct = new hf_pick_desc { struct_size = (uint)sizeof(hf_pick_desc),
                    front_only = frontOnly ? 1 : 0 };
                hf_pick_desc* desc = &descStruct;
                desc->positions = c.View(positions?.Values, "positions", "vertex_count", "3");
                uint vertex = 0;
                double distance = 0;
                HfException.Check(Functions.hf_surface_find_vertex(RawHandle, point_, desc, &vertex, &distance));
                return (vertex, distance);
            }
        }

        /// <summary>Writes levels, ascending. Levels.Area makes all strips equal in area. Levels.Length makes the mean
        /// widths of the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the
        /// value would crowd them. Levels.Length leaves out the parts where the field is flat to 1e-9 of its range.
        ///
        /// In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of
        /// level c. Both are exact for the piecewise linear field. Levels.Area takes equal steps of A.
        /// Levels.Length takes equal steps of the integral of A'(c) / L(c) dc. That integral is the height on a
        /// cylinder and the distance from the pole on a sphere.
        ///
        /// field: [vertexCount] of float or double.
        /// spacing: Levels.
        /// levelCount: 1 to 1,000,000.
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public double[] SpaceLevels(Reals field, uint levelCount, Levels spacing = default(Levels))
        {
            using (var c = new Call(this))
            {
                hf_array field_Array = c.View(field?.Values, "field", "vertex_count");
                hf_array* field_ = &field_Array;
                if (levelCount != 0) c.Sizes["level_count"] = (int)Math.Min(levelCount, int.MaxValue);
                var levels = new double[c.Product("level_count")];
                var levelsPlace = (double*)c.Pin(levels);
                HfException.Check(Functions.hf_surface_space_levels(RawHandle, field == null ? null : field_,
                    (int)spacing, levelCount, levelsPlace));
                return levels;
            }
        }

        /// <summary>Traces the iso-lines of levels. The levels must be finite and can have any order; the lines come in the
        /// order of the levels. A vertex whose value equals a level counts as just above it, so lines have no gaps.
        /// A line either closes or ends. It ends at a border or at a triangle without values. At an edge of three
        /// or more triangles (non-manifold), these are taken in pairs. A line continues inside a pair, and ends at
        /// a triangle without a partner. The function leaves out lines of length zero. Seen from outside a
        /// consistently oriented mesh, the field is higher on the left of a line.
        ///
        /// field: [vertexCount] of float or double.
        /// levels: [levelCount].
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public Isolines TraceIsolines(Reals field, double[] levels)
        {
            using (var c = new Call(this))
            {
                hf_array field_Array = c.View(field?.Values, "field", "vertex_count");
                hf_array* field_ = &field_Array;
                void* levels_ = c.Array(levels, "levels", "level_count");
                var linesStruct = new hf_isolines { struct_size = (uint)sizeof(hf_isolines) };
                hf_isolines* lines = &linesStruct;
                uint[] allPointEdges = null;
                double[] allParameters = null;
                double[] allPositions = null;
                uint[] allLineStarts = null;
                uint[] allLineLevels = null;
                int[] allLineClosed = null;
                c.Room("point_capacity", "hf_surface_trace_isolines.point_capacity");
                c.Room("line_capacity", "hf_surface_trace_isolines.line_capacity");
                int result;
                do
                {
                        lines->point_capacity = (uint)c.Size("point_capacity");
                        lines->line_capacity = (uint)c.Size("line_capacity");
                        lines->point_edges = c.Make(out allPointEdges, "point_capacity", "2");
                        lines->parameters = c.Make(out allParameters, "point_capacity");
                        lines->positions = c.Make(out allPositions, "point_capacity", "3");
                        lines->line_starts = c.Make(out allLineStarts, "line_capacity + 1");
                        lines->line_levels = c.Make(out allLineLevels, "line_capacity");
                        lines->line_closed = c.Make(out allLineClosed, "line_capacity");
                        result = Functions.hf_surface_trace_isolines(RawHandle, field == null ? null : field_,
                            (uint)c.Count("level_count", 1), levels_, lines);
                }
                while (c.Again("hf_surface_trace_isolines", result, ("point_capacity", lines->point_count),
                    ("line_capacity", lines->line_count)));
                return new Isolines { PointEdges = c.Cut(allPointEdges, "point_capacity", "2"),
                    Parameters = c.Cut(allParameters, "point_capacity"), Positions = c.Cut(allPositions,
                    "point_capacity", "3"), LineStarts = c.Cut(allLineStarts, "line_capacity + 1"),
                    LineLevels = c.Cut(allLineLevels, "line_capacity"), LineClosed = c.Cut(allLineClosed,
                    "line_capacity") };
            }
        }

        /// <summary>Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each
        /// vertex decide (Banchoff 1970). Take its neighbours with lower values and the edges between them. The
        /// index of the vertex is 1 minus their Euler characteristic. The vertex number breaks ties, so a flat area
        /// has critical points too. The indices sum to the Euler characteristic on every component. On a mesh that
        /// is not Delaunay a harmonic field can show an extremum away from its sites, because the default operator
        /// uses other edges than the mesh. Operator.Clamped uses the edges of the mesh and avoids this.
        ///
        /// field: [vertexCount] of float or double.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_NON_FINITE.</summary>
        public CriticalPoint[] FindCriticalPoints(Reals field)
        {
            using (var c = new Call(this))
            {
                var info = new hf_critical_info { struct_size = (uint)sizeof(hf_critical_info) };
                hf_array field_Array = c.View(field?.Values, "field", "vertex_count");
                hf_array* field_ = &field_Array;
                void* pointsPlace = null;
                c.Room("capacity", "hf_surface_find_critical_points.capacity");
                int result;
                do
                {
                        pointsPlace = c.Rows(sizeof(hf_critical_point), "capacity");
                        result = Functions.hf_surface_find_critical_points(RawHandle, field == null ? null : field_,
                            (uint)c.Size("capacity"), pointsPlace, &info);
                }
                while (c.Again("hf_surface_find_critical_points", result, ("capacity", info.point_count)));
                lastCriticalInfo = info;
                var points = new CriticalPoint[c.Product("capacity")];
                for (int i = 0; i < points.Length; ++i)
                    points[i] = new CriticalPoint((hf_critical_point*)pointsPlace + i);
                return points;
            }
        }

        /// <summary>Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does
        /// not depend on the order of the vertices. Pose and meshing change it only within the resolution of the
        /// mesh.
        ///
        /// kind: ExtremityKind
        /// leastLengthShare: tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10
        /// sourceCount: sources of the mean distance per component, 1 to 1,000; 0 = 40
        /// geodesics: for ExtremityKind.Geodesic: an object of this surface. If its method is DistanceMethod.Heat
        ///     its factor serves; else, and for null, the call makes a factor
        /// progress: an object to poll and cancel through
        /// field: [vertexCount], packed: the field whose peaks are proposed, 0 at isolated vertices. Unit: length^2
        ///     (Poisson), length (geodesic), each up to a constant per component
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT.</summary>
        public Extremity[] FindExtremities(ExtremityKind kind = default(ExtremityKind), double leastLengthShare = 0,
                uint sourceCount = 0, Geodesics geodesics = null, Progress progress = null,
                Span<double> field = default(Span<double>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_extremities_desc { struct_size = (uint)sizeof(hf_extremities_desc),
                    kind = (int)kind, least_length_share = leastLengthShare, source_count = sourceCount };
                hf_extremities_desc* desc = &descStruct;
                c.Sizes["source_count"] = (int)Math.Min(sourceCount == 0 ? 40 : sourceCount, int.MaxValue);
                desc->geodesics = c.Handle(geodesics);
                desc->progress = c.Handle(progress);
                if (!field.IsEmpty)
                    c.Need(field.Length, "field", "vertex_count");
                fixed (double* fieldPlace = &MemoryMarshal.GetReference(field))
                {
                    desc->out_field = (IntPtr)fieldPlace;
                    uint count = 0;
                    void* extremitiesPlace = null;
                    c.Room("capacity", "hf_surface_find_extremities.capacity");
                    int result;
                    do
                    {
                            extremitiesPlace = c.Rows(sizeof(hf_extremity), "capacity");
                            result = Functions.hf_surface_find_extremities(RawHandle, desc, (uint)c.Size("capacity"),
                                extremitiesPlace, &count);
                    }
                    while (c.Again("hf_surface_find_extremities", result, ("capacity", count)));
                    var extremities = new Extremity[c.Product("capacity")];
                    for (int i = 0; i < extremities.Length; ++i)
                        extremities[i] = new Extremity((hf_extremity*)extremitiesPlace + i);
                    return extremities;
                }
            }
        }

        /// <summary>Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned
        /// proposals come first, then the others, each group by length, the longest first. The places do not depend
        /// on the order of the vertices. They follow translation and scale. A skeleton gives each proposal the
        /// joint that moves it, a role and a side. If its roles are known, feet and the trunk are pinned. Hands,
        /// heads, tails and pieces that hang on them, such as a sword, are not. Each head, hand, foot, tail, ear
        /// and wing gets at most one proposal. A part that no joint of the skin moves, such as the box that an
        /// animator drags, gets none.
        ///
        /// joints: [jointCount x 3] their places at rest, in the unit and frame of the mesh
        /// parents: [jointCount] position of each joint's parent in the list; uint.MaxValue for a root
        /// skeleton: the skeleton of the mesh, instead of joints and parents. It rests in the unit and frame of the
        ///     mesh. If it has a skin, the skin has the vertices of the mesh
        /// up: direction away from the ground, of any length; zero = up of the skeleton where it is known, else the
        ///     y axis
        /// leastLengthShare: as in ExtremitiesDesc; 0 = 0.05
        /// limit: most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32
        /// progress: an object to poll and cancel through
        /// regions: [vertexCount]: position in the list of the proposal whose region has the vertex; uint.MaxValue
        ///     for a vertex of no region
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.</summary>
        public HandleProposal[] ProposeHandles(double[] joints = null, uint[] parents = null, Skeleton skeleton = null,
                double[] up = null, double leastLengthShare = 0, uint limit = 0, Progress progress = null,
                Span<uint> regions = default(Span<uint>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_handle_proposals_desc { struct_size = (uint)sizeof(hf_handle_proposals_desc),
                    least_length_share = leastLengthShare, limit = limit };
                hf_handle_proposals_desc* desc = &descStruct;
                desc->joints = (IntPtr)c.Array(joints, "joints", "joint_count", "3");
                desc->parents = (IntPtr)c.Array(parents, "parents", "joint_count");
                c.Fit(up, "up", "3");
                for (int i = 0; up != null && i < up.Length; ++i) desc->up[i] = up[i];
                desc->skeleton = c.Handle(skeleton);
                desc->progress = c.Handle(progress);
                desc->joint_count = (uint)c.Count("joint_count", 0);
                if (!regions.IsEmpty)
                    c.Need(regions.Length, "regions", "vertex_count");
                fixed (uint* regionsPlace = &MemoryMarshal.GetReference(regions))
                {
                    desc->out_regions = (IntPtr)regionsPlace;
                    uint count = 0;
                    void* proposalsPlace = null;
                    c.Room("capacity", "hf_surface_propose_handles.capacity");
                    int result;
                    do
                    {
                            proposalsPlace = c.Rows(sizeof(hf_handle_proposal), "capacity");
                            result = Functions.hf_surface_propose_handles(RawHandle, desc, (uint)c.Size("capacity"),
                                proposalsPlace, &count);
                    }
                    while (c.Again("hf_surface_propose_handles", result, ("capacity", count)));
                    var proposals = new HandleProposal[c.Product("capacity")];
                    for (int i = 0; i < proposals.Length; ++i)
                        proposals[i] = new HandleProposal((hf_handle_proposal*)proposalsPlace + i);
                    return proposals;
                }
            }
        }

        hf_gaps_info lastGapsInfo;
        /// <summary>What the last call told that writes it.</summary>
        public GapsInfo GapsInfo { get { hf_gaps_info copy = lastGapsInfo; return new GapsInfo(&copy); } }

        hf_critical_info lastCriticalInfo;
        /// <summary>What the last call told that writes it.</summary>
        public CriticalInfo CriticalInfo { get { hf_critical_info copy = lastCriticalInfo; return new CriticalInfo(&copy); } }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>A set of sites on a surface, and their field.
    ///
    /// Creates a solver without sites.
    ///
    /// fieldKind: FieldKind; if the surface has no factor of that kind yet, it is made now
    /// channelCount: fields solved at once, 1 to 64; 0 = 1
    /// siteLimit: at most this many sites; 0 = 100,000
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Solver : Recorded
    {
        Solver() { }

        /// <summary>Creates a solver without sites.
        ///
        /// fieldKind: FieldKind; if the surface has no factor of that kind yet, it is made now
        /// channelCount: fields solved at once, 1 to 64; 0 = 1
        /// siteLimit: at most this many sites; 0 = 100,000
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.</summary>
        public Solver(Surface surface, FieldKind fieldKind = default(FieldKind), uint channelCount = 0,
                uint siteLimit = 0, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_solver_desc { struct_size = (uint)sizeof(hf_solver_desc),
                    field_kind = (int)fieldKind, channel_count = channelCount, site_limit = siteLimit };
                hf_solver_desc* desc = &descStruct;
                c.Sizes["channel_count"] = (int)Math.Min(channelCount == 0 ? 1 : channelCount, int.MaxValue);
                desc->progress = c.Handle(progress);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_solver_destroy, c, "channel_count", "vertex_count");
            }
        }

        /// <summary>Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share
        /// the factor and the solved sites, so a copy costs its list of sites only. Use one copy per thread or per
        /// set of sites. For undo, keep copies: one before each edit.</summary>
        public Solver Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_solver_clone(RawHandle, raw));
                var made = new Solver();
                made.Own(*raw, Functions.hf_solver_destroy, c, "channel_count", "vertex_count");
                return made;
            }
        }

        /// <summary>Moves a solver to an edited surface. Its sites keep their numbers, values and screening.
        ///
        /// surface: any number of calls of Surface.Edit or Surface.Relink make it from the solver's surface, or the
        ///     solver's surface from it.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.</summary>
        public void MoveTo(Surface surface)
        {
            using (var c = new Call(this))
            {
                c.Parent("surface.", surface);
                HfException.Check(Functions.hf_solver_move_to(RawHandle, c.Handle(surface)));
                lock (Counts) Counts["vertex_count"] = surface.Known("vertex_count");
            }
        }

        /// <summary>Writes the options of a solver.</summary>
        public SolverInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_solver_info { struct_size = (uint)sizeof(hf_solver_info) };
                    hf_solver_info* info = &infoStruct;
                    HfException.Check(Functions.hf_solver_get_info(RawHandle, info));
                    return new SolverInfo(info);
                }
            }
        }

        /// <summary>Adds sites.
        ///
        /// vertices: [siteCount] vertices of your mesh, or null
        /// values: [siteCount x channelCount], up to 1e200 in size; null = 0
        /// places: [siteCount], or null
        /// points: [siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each
        ///     stands for the nearest point of the surface, up to two boxes away
        /// stiffness: [siteCount] &gt;= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard;
        ///     clamped to 1e-12 to 1e12
        /// radii: [siteCount] &gt;= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public uint[] AddSites(uint[] vertices = null, double[] values = null, Place[] places = null,
                double[] points = null, double[] stiffness = null, double[] radii = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_sites_desc { struct_size = (uint)sizeof(hf_sites_desc) };
                hf_sites_desc* desc = &descStruct;
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "site_count");
                var placesRows = (hf_place*)c.Given(places, "places", sizeof(hf_place), "site_count");
                for (int i = 0; places != null && i < places.Length; ++i) places[i].Write(c, placesRows + i);
                desc->places = (IntPtr)placesRows;
                desc->points = (IntPtr)c.Array(points, "points", "site_count", "3");
                desc->values = (IntPtr)c.Array(values, "values", "site_count", "channel_count");
                desc->stiffness = (IntPtr)c.Array(stiffness, "stiffness", "site_count");
                desc->radii = (IntPtr)c.Array(radii, "radii", "site_count");
                desc->site_count = (uint)c.Count("site_count", 1);
                var sites = new uint[c.Product("site_count")];
                var sitesPlace = (uint*)c.Pin(sites);
                HfException.Check(Functions.hf_add_sites(RawHandle, desc, sitesPlace));
                return sites;
            }
        }

        /// <summary>Adds one hard site at a vertex.
        ///
        /// values: [channelCount], or null for 0.
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public uint AddSite(uint vertex, double[] values = null)
        {
            using (var c = new Call(this))
            {
                void* values_ = c.Array(values, "values", "channel_count");
                uint site = 0;
                HfException.Check(Functions.hf_solver_add_site(RawHandle, vertex, values_, &site));
                return site;
            }
        }

        /// <summary>Removes sites by number. The field is 0 on a component that has no site left. If you add a site there
        /// again, the field is exact.
        ///
        /// sites: [siteCount].
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public void RemoveSites(uint[] sites)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                HfException.Check(Functions.hf_remove_sites(RawHandle, (uint)c.Count("site_count", 1), sites_));
            }
        }

        /// <summary>Moves sites to new places. Each site keeps its number, value, stiffness and radius.
        ///
        /// sites: [siteCount].
        /// vertices: [siteCount] vertices of your mesh, or null
        /// values: [siteCount x channelCount], up to 1e200 in size; null = 0
        /// places: [siteCount], or null
        /// points: [siteCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each
        ///     stands for the nearest point of the surface, up to two boxes away
        /// stiffness: [siteCount] &gt;= 0, relative to the mean diagonal of K; 0 = hard (exact); null = all hard;
        ///     clamped to 1e-12 to 1e12
        /// radii: [siteCount] &gt;= 0, geodesic, in the unit of the mesh; 0 = a point; null = all points
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public void MoveSites(uint[] sites, uint[] vertices = null, double[] values = null, Place[] places = null,
                double[] points = null, double[] stiffness = null, double[] radii = null)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                var descStruct = new hf_sites_desc { struct_size = (uint)sizeof(hf_sites_desc) };
                hf_sites_desc* desc = &descStruct;
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "site_count");
                var placesRows = (hf_place*)c.Given(places, "places", sizeof(hf_place), "site_count");
                for (int i = 0; places != null && i < places.Length; ++i) places[i].Write(c, placesRows + i);
                desc->places = (IntPtr)placesRows;
                desc->points = (IntPtr)c.Array(points, "points", "site_count", "3");
                desc->values = (IntPtr)c.Array(values, "values", "site_count", "channel_count");
                desc->stiffness = (IntPtr)c.Array(stiffness, "stiffness", "site_count");
                desc->radii = (IntPtr)c.Array(radii, "radii", "site_count");
                desc->site_count = (uint)c.Count("site_count", 1);
                HfException.Check(Functions.hf_solver_move_sites(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    desc));
            }
        }

        /// <summary>Gives sites new values. The call costs nothing until the next solve.
        ///
        /// sites: [siteCount].
        /// values: [siteCount x channelCount].
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_TOO_LARGE.</summary>
        public void SetValues(uint[] sites, double[] values)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* values_ = c.Array(values, "values", "site_count", "channel_count");
                HfException.Check(Functions.hf_solver_set_values(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    values_));
            }
        }

        /// <summary>Applies a batch of edits at once.
        ///
        /// removeSites: [removeCount]
        /// moveSites: [moveCount]
        /// setSites: [setCount]
        /// setValues: [setCount x channelCount]
        /// moveTo: places of [moveCount] sites
        /// add: the sites to add</summary>
        public uint[] EditSites(uint[] removeSites = null, uint[] moveSites = null, uint[] setSites = null,
                double[] setValues = null, SitesDesc moveTo = null, SitesDesc add = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_edit_desc { struct_size = (uint)sizeof(hf_edit_desc) };
                hf_edit_desc* desc = &descStruct;
                desc->remove_sites = (IntPtr)c.Array(removeSites, "removeSites", "remove_count");
                desc->move_sites = (IntPtr)c.Array(moveSites, "moveSites", "move_count");
                desc->set_sites = (IntPtr)c.Array(setSites, "setSites", "set_count");
                desc->set_values = (IntPtr)c.Array(setValues, "setValues", "set_count", "channel_count");
                if (moveTo != null) desc->move_to = moveTo.Fill(c, "move_to.");
                if (add != null) desc->add = add.Fill(c, "add.");
                desc->remove_count = (uint)c.Count("remove_count", 0);
                desc->move_count = (uint)c.Count("move_count", 0);
                desc->set_count = (uint)c.Count("set_count", 0);
                var sites = new uint[c.Product("add.site_count")];
                var sitesPlace = (uint*)c.Pin(sites);
                HfException.Check(Functions.hf_solver_edit_sites(RawHandle, desc, sitesPlace));
                return sites;
            }
        }

        /// <summary>Returns the number of sites, or 0 for an invalid object.</summary>
        public int SiteCount
        {
            get
            {
                uint result = Functions.hf_solver_get_site_count(RawHandle);
                GC.KeepAlive(this);
                return (int)result;
            }
        }

        /// <summary>Writes all sites.</summary>
        public SitesInfo Sites()
        {
            using (var c = new Call(this))
            {
                var infoStruct = new hf_sites_info { struct_size = (uint)sizeof(hf_sites_info) };
                hf_sites_info* info = &infoStruct;
                uint[] allSites = null;
                uint[] allVertices = null;
                uint[] allComponents = null;
                double[] allValues = null;
                double[] allStiffness = null;
                double[] allFlux = null;
                double[] allRadii = null;
                c.Room("capacity", "hf_solver_get_sites.capacity");
                int result;
                do
                {
                        info->capacity = (uint)c.Size("capacity");
                        info->sites = c.Make(out allSites, "capacity");
                        info->vertices = c.Make(out allVertices, "capacity");
                        info->components = c.Make(out allComponents, "capacity");
                        info->values = c.Make(out allValues, "capacity", "channel_count");
                        info->stiffness = c.Make(out allStiffness, "capacity");
                        info->flux = c.Make(out allFlux, "capacity", "channel_count");
                        info->radii = c.Make(out allRadii, "capacity");
                        result = Functions.hf_solver_get_sites(RawHandle, info);
                }
                while (c.Again("hf_solver_get_sites", result, ("capacity", info->count)));
                return new SitesInfo { Sites = c.Cut(allSites, "capacity"), Vertices = c.Cut(allVertices, "capacity"),
                    Components = c.Cut(allComponents, "capacity"), Values = c.Cut(allValues, "capacity",
                    "channel_count"), Stiffness = c.Cut(allStiffness, "capacity"), Flux = c.Cut(allFlux, "capacity",
                    "channel_count"), Radii = c.Cut(allRadii, "capacity") };
            }
        }

        /// <summary>Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H
        /// is large, and the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12
        /// times the mean diagonal of K. Such a field needs no site on a component where some H is above 0.
        ///
        /// screening: [vertexCount] H &gt;= 0, in 1 / length^2 with the unit of the mesh; null removes the
        ///     screening.
        /// targets: [vertexCount x channelCount] p, or null for 0. Both are copied. The values of the first of
        ///     welded copies hold for all of them. Sites stay. A site with a radius holds the rim of its disc only.
        ///     Undo restores the screening with the sites.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_POSITIVE_DEFINITE,
        /// HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public void SetScreening(double[] screening = null, double[] targets = null)
        {
            using (var c = new Call(this))
            {
                void* screening_ = c.Array(screening, "screening", "vertex_count");
                void* targets_ = c.Array(targets, "targets", "vertex_count", "channel_count");
                HfException.Check(Functions.hf_solver_set_screening(RawHandle, screening_, targets_));
            }
        }

        /// <summary>Solves for the field at every vertex of your mesh, in single or double precision. Hard sites hold their
        /// values exactly. The field is 0 on components without a site.
        ///
        /// @out: [vertexCount x channelCount] of float or double.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE.</summary>
        public float[] Solve()
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new float[c.Product("vertex_count", "channel_count")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_solver_solve(RawHandle, outView, &info));
                lastSolveInfo = info;
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(Span<float> into)
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "channel_count");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_solver_solve(RawHandle, outView, &info));
                    lastSolveInfo = info;
                }
            }
        }

        /// <summary>As Solve, in double precision.</summary>
        public double[] SolveDouble()
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new double[c.Product("vertex_count", "channel_count")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_solver_solve(RawHandle, outView, &info));
                lastSolveInfo = info;
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(Span<double> into)
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "channel_count");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_solver_solve(RawHandle, outView, &info));
                    lastSolveInfo = info;
                }
            }
        }

        /// <summary>Solves for the field at chosen vertices only, with the same bits as Solver.Solve in double. The call
        /// reads only those columns of the factor on which these vertices depend (elimination paths), on the
        /// calling thread. One path is up to a sixth of the factor, but the paths of many vertices share most of
        /// their columns. The call costs a whole solve for bi-harmonic fields, and whenever sites are eliminated in
        /// the factor (see Solver.PrepareRebase). A vertex of a component without a site gets 0.
        ///
        /// vertices: [vertexCount].
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public double[] SolveAt(uint[] vertices)
        {
            using (var c = new Call(this))
            {
                c.Sizes.Remove("vertex_count");  // of the list given here
                void* vertices_ = c.Array(vertices, "vertices", "vertex_count");
                var values = new double[c.Product("vertex_count", "channel_count")];
                var valuesPlace = (double*)c.Pin(values);
                HfException.Check(Functions.hf_solver_solve_at(RawHandle, (uint)c.Count("vertex_count", 1), vertices_,
                    valuesPlace));
                return values;
            }
        }

        /// <summary>Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009,
        /// Section 3.3). The channels are the x, y and z of the constraint vectors, and the call solves each as a
        /// field. It then projects the vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the
        /// area-weighted normal.
        ///
        /// @out: [vertexCount x 3] of float or double, not normalised.
        /// normals: [vertexCount x 3], packed: the normals used.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE.</summary>
        public float[] SolveVectors(Span<double> normals = default(Span<double>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new float[c.Product("vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (double* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    HfException.Check(Functions.hf_solver_solve_vectors(RawHandle, outView, normalsPlace, &info));
                    lastSolveInfo = info;
                    return @out;
                }
            }
        }

        /// <summary>As SolveVectors, into an array of yours.</summary>
        public void SolveVectors(Span<float> into, Span<double> normals = default(Span<double>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (double* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        HfException.Check(Functions.hf_solver_solve_vectors(RawHandle, outView, normalsPlace, &info));
                        lastSolveInfo = info;
                    }
                }
            }
        }

        /// <summary>As SolveVectors, in double precision.</summary>
        public double[] SolveVectorsDouble(Span<double> normals = default(Span<double>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new double[c.Product("vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (double* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    HfException.Check(Functions.hf_solver_solve_vectors(RawHandle, outView, normalsPlace, &info));
                    lastSolveInfo = info;
                    return @out;
                }
            }
        }

        /// <summary>As SolveVectors, into an array of yours.</summary>
        public void SolveVectors(Span<double> into, Span<double> normals = default(Span<double>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (double* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        HfException.Check(Functions.hf_solver_solve_vectors(RawHandle, outView, normalsPlace, &info));
                        lastSolveInfo = info;
                    }
                }
            }
        }

        /// <summary>Solves with a single-precision copy of the factor. This reads half the bytes of Solver.Solve; use it
        /// while the user drags a value or a site. The error is about 1e-6 of the value range for harmonic fields.
        /// Bi-harmonic fields, long shapes and crowded sites can have an error of any size: ask for corrections
        /// there and read error_estimate. Hard sites at vertices are exact. One correction (iterative refinement,
        /// Wilkinson 1963) reduces the error of a harmonic field below 1e-9, a second one below 1e-12. Each
        /// correction costs as much as two to three calls of Solver.Solve.
        ///
        /// The first call makes the single-precision copy, which costs about two solves. All solvers of that field
        /// kind on the surface share the copy. It is freed with the last of these solvers, or by
        /// Solver.ReleasePreview. A solver whose factor eliminates sites gives the exact field. info.exact is then
        /// 1.
        ///
        /// correctionCount: 0 to 8.
        /// @out: [vertexCount x channelCount] of float or double, as Solver.Solve. Single precision rounds most
        /// corrections away.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.</summary>
        public float[] SolvePreview(uint correctionCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_preview_info { struct_size = (uint)sizeof(hf_preview_info) };
                var @out = new float[c.Product("vertex_count", "channel_count")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_solver_solve_preview(RawHandle, outView, correctionCount, &info));
                lastPreviewInfo = info;
                return @out;
            }
        }

        /// <summary>As SolvePreview, into an array of yours.</summary>
        public void SolvePreview(Span<float> into, uint correctionCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_preview_info { struct_size = (uint)sizeof(hf_preview_info) };
                c.Need(into.Length, "into", "vertex_count", "channel_count");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_solver_solve_preview(RawHandle, outView, correctionCount, &info));
                    lastPreviewInfo = info;
                }
            }
        }

        /// <summary>As SolvePreview, in double precision.</summary>
        public double[] SolvePreviewDouble(uint correctionCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_preview_info { struct_size = (uint)sizeof(hf_preview_info) };
                var @out = new double[c.Product("vertex_count", "channel_count")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_solver_solve_preview(RawHandle, outView, correctionCount, &info));
                lastPreviewInfo = info;
                return @out;
            }
        }

        /// <summary>As SolvePreview, into an array of yours.</summary>
        public void SolvePreview(Span<double> into, uint correctionCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_preview_info { struct_size = (uint)sizeof(hf_preview_info) };
                c.Need(into.Length, "into", "vertex_count", "channel_count");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_solver_solve_preview(RawHandle, outView, correctionCount, &info));
                    lastPreviewInfo = info;
                }
            }
        }

        /// <summary>Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The
        /// next preview makes the copy again.</summary>
        public void ReleasePreview()
        {
            using (var c = new Call(this))
            {
                HfException.Check(Functions.hf_solver_release_preview(RawHandle));
            }
        }

        /// <summary>Moves vector sites to other vertices of their components. Each vector is carried along the shortest path
        /// of edges, from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3).
        ///
        /// sites: [siteCount].
        /// vertices: [siteCount].
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
        /// HF_ERROR_OUT_OF_RANGE.</summary>
        public void MoveVectors(uint[] sites, uint[] vertices)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* vertices_ = c.Array(vertices, "vertices", "site_count");
                HfException.Check(Functions.hf_solver_move_vectors(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    vertices_));
            }
        }

        /// <summary>Turns the vector of site i about its vertex normal, counter-clockwise by angles[i] radians. Does not
        /// factorise.
        ///
        /// sites: [siteCount].
        /// angles: [siteCount].
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void RotateVectors(uint[] sites, double[] angles)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* angles_ = c.Array(angles, "angles", "site_count");
                HfException.Check(Functions.hf_solver_rotate_vectors(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    angles_));
            }
        }

        /// <summary>Solves the field and checks it against its equations. The check uses only the operator K and the site
        /// values. So it finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call
        /// returns HF_ERROR_INACCURATE (index = worst vertex) if the check fails, and writes certificate then too.
        /// Do not use fields of that solver; make the surface again.
        ///
        /// tolerance: largest error to accept, &gt; 0; 0 = 1e-8
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INACCURATE, HF_ERROR_INVALID_ARGUMENT.</summary>
        public Certificate Certify(double tolerance = 0)
        {
            using (var c = new Call(this))
            {
                var certificateStruct = new hf_certificate { struct_size = (uint)sizeof(hf_certificate),
                    tolerance = tolerance };
                hf_certificate* certificate = &certificateStruct;
                HfException.Check(Functions.hf_solver_certify(RawHandle, certificate));
                return new Certificate(certificate);
            }
        }

        /// <summary>Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It
        /// runs on the calling thread, while other threads edit and solve with this solver. The next edit switches
        /// to the new factor. Fields before and after are the same up to rounding. Call it on a thread of yours
        /// when SolverStatistics.rebase_advised is 1. An edit of very many sites does this by itself when that is
        /// quicker. Memory: one more factor, for as long as it eliminates sites.
        ///
        /// Throws HF_ERROR_BUSY, HF_ERROR_EMPTY.</summary>
        public void PrepareRebase()
        {
            using (var c = new Call(this))
            {
                HfException.Check(Functions.hf_solver_prepare_rebase(RawHandle));
            }
        }

        /// <summary>Writes the statistics.</summary>
        public SolverStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_solver_statistics { struct_size = (uint)sizeof(hf_solver_statistics) };
                    hf_solver_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_solver_get_statistics(RawHandle, statistics));
                    return new SolverStatistics(statistics);
                }
            }
        }

        hf_solve_info lastSolveInfo;
        /// <summary>What the last call told that writes it.</summary>
        public SolveInfo SolveInfo { get { hf_solve_info copy = lastSolveInfo; return new SolveInfo(&copy); } }

        hf_preview_info lastPreviewInfo;
        /// <summary>What the last call told that writes it.</summary>
        public PreviewInfo PreviewInfo { get { hf_preview_info copy = lastPreviewInfo; return new PreviewInfo(&copy); } }

        internal override Recorded State() { return Clone(); }

        /// <summary>As it was made with.</summary>
        public int ChannelCount { get { return Known("channel_count"); } }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>Computes geodesic distances on one surface: the lengths of shortest paths along it.
    ///
    /// Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes
    /// one numeric factorisation and holds a factor of its own beside the surface's.
    ///
    /// method: DistanceMethod
    /// smoothing: of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to
    ///     10,000; 0 = 1
    /// progress: an object to poll and cancel through: creation and every later call report to it</summary>
    public sealed unsafe class Geodesics : HfObject
    {
        /// <summary>Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT
        /// takes one numeric factorisation and holds a factor of its own beside the surface's.
        ///
        /// method: DistanceMethod
        /// smoothing: of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to
        ///     10,000; 0 = 1
        /// progress: an object to poll and cancel through: creation and every later call report to it
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.</summary>
        public Geodesics(Surface surface, DistanceMethod method = default(DistanceMethod), double smoothing = 0,
                Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_geodesics_desc { struct_size = (uint)sizeof(hf_geodesics_desc),
                    method = (int)method, smoothing = smoothing };
                hf_geodesics_desc* desc = &descStruct;
                desc->progress = c.Handle(progress);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_geodesics_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_geodesics_destroy, c, "vertex_count");
            }
        }

        /// <summary>Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh.
        /// The distance is 0 at the sources, and -1 at vertices that no source can reach.
        ///
        /// sources: [sourceCount] vertices of your mesh; repeats are allowed. Paths follow the triangles and ignore
        ///     links. Triangles with the same corners count once: a two-sided sheet measures as a single one. No
        ///     distance of EXACT and FRONT is below the straight line to the nearest source. EXACT is right up to
        ///     rounding. The error of FRONT falls with the edge length. HEAT rounds the distance off at corners and
        ///     where two shortest paths meet.
        /// @out: [vertexCount] of float or double.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public float[] Solve(uint[] sources)
        {
            using (var c = new Call(this))
            {
                void* sources_ = c.Array(sources, "sources", "source_count");
                var @out = new float[c.Product("vertex_count")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_geodesics_solve(RawHandle, (uint)c.Count("source_count", 1), sources_,
                    outView));
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(uint[] sources, Span<float> into)
        {
            using (var c = new Call(this))
            {
                void* sources_ = c.Array(sources, "sources", "source_count");
                c.Need(into.Length, "into", "vertex_count");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_geodesics_solve(RawHandle, (uint)c.Count("source_count", 1),
                        sources_, outView));
                }
            }
        }

        /// <summary>As Solve, in double precision.</summary>
        public double[] SolveDouble(uint[] sources)
        {
            using (var c = new Call(this))
            {
                void* sources_ = c.Array(sources, "sources", "source_count");
                var @out = new double[c.Product("vertex_count")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_geodesics_solve(RawHandle, (uint)c.Count("source_count", 1), sources_,
                    outView));
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(uint[] sources, Span<double> into)
        {
            using (var c = new Call(this))
            {
                void* sources_ = c.Array(sources, "sources", "source_count");
                c.Need(into.Length, "into", "vertex_count");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_geodesics_solve(RawHandle, (uint)c.Count("source_count", 1),
                        sources_, outView));
                }
            }
        }

        /// <summary>Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If
        /// several are as short, it writes one of them. The path is straight where its triangles are unfolded; it
        /// bends at vertices only.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.</summary>
        public SurfacePath FindPath(Place from, Place to)
        {
            using (var c = new Call(this))
            {
                var pathStruct = new hf_path { struct_size = (uint)sizeof(hf_path) };
                hf_path* path = &pathStruct;
                uint[] allPointEdges = null;
                double[] allParameters = null;
                double[] allPositions = null;
                c.Room("point_capacity", "hf_geodesics_find_path.point_capacity");
                int result;
                do
                {
                        path->point_capacity = (uint)c.Size("point_capacity");
                        path->point_edges = c.Make(out allPointEdges, "point_capacity", "2");
                        path->parameters = c.Make(out allParameters, "point_capacity");
                        path->positions = c.Make(out allPositions, "point_capacity", "3");
                        result = Functions.hf_geodesics_find_path(RawHandle, c.Place(from, "from"), c.Place(to, "to"),
                            path);
                }
                while (c.Again("hf_geodesics_find_path", result, ("point_capacity", path->point_count)));
                return new SurfacePath { Length = path->length, PointEdges = c.Cut(allPointEdges, "point_capacity",
                    "2"), Parameters = c.Cut(allParameters, "point_capacity"), Positions = c.Cut(allPositions,
                    "point_capacity", "3") };
            }
        }

        /// <summary>Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A
        /// vertex lies at the length of its shortest path from the point, in the direction in which the path
        /// starts.
        ///
        /// radius: vertices farther away get NaN too and take no time; 0 = no bound.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.</summary>
        public (double[] Map, double[] Frame) Map(Place centre, double radius = 0)
        {
            using (var c = new Call(this))
            {
                var map = new double[c.Product("vertex_count", "2")];
                var mapPlace = (double*)c.Pin(map);
                var frame = new double[c.Product("6")];
                var framePlace = (double*)c.Pin(frame);
                HfException.Check(Functions.hf_geodesics_get_map(RawHandle, c.Place(centre, "centre"), radius, mapPlace,
                    framePlace));
                return (map, frame);
            }
        }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>A direction field on a surface, with a factor and constraints of its own.
    ///
    /// Makes a direction field without constraints. It computes the connection between tangent planes and the
    /// operator, and factorises once, with two unknowns per vertex.
    ///
    /// degree: 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
    /// siteLimit: most constraints; 0 = 100,000
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Direction : Recorded
    {
        Direction() { }

        /// <summary>Makes a direction field without constraints. It computes the connection between tangent planes and the
        /// operator, and factorises once, with two unknowns per vertex.
        ///
        /// degree: 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
        /// siteLimit: most constraints; 0 = 100,000
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.</summary>
        public Direction(Surface surface, uint degree = 0, uint siteLimit = 0, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_direction_desc { struct_size = (uint)sizeof(hf_direction_desc), degree = degree,
                    site_limit = siteLimit };
                hf_direction_desc* desc = &descStruct;
                desc->progress = c.Handle(progress);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_direction_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_direction_destroy, c, "vertex_count");
            }
        }

        /// <summary>Makes a direction field with the same constraints under the same numbers; it has the same bits. Both
        /// share connection and factor, so the copy costs the constraints only. For undo, keep copies: one before
        /// each edit.</summary>
        public Direction Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_direction_clone(RawHandle, raw));
                var made = new Direction();
                made.Own(*raw, Functions.hf_direction_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each
        /// constraint costs two sparse triangular solves (elimination paths) and two rows of a small dense system.
        /// For a batch of very many constraints, the function factorises once instead, with their vertices
        /// eliminated. Later edits cost paths and rows again.
        ///
        /// vertices: [siteCount] vertices of your mesh.
        /// vectors: [siteCount x 3]; a zero vector makes the field 0 there.
        ///
        /// Throws HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE.</summary>
        public uint[] AddSites(uint[] vertices, double[] vectors)
        {
            using (var c = new Call(this))
            {
                void* vertices_ = c.Array(vertices, "vertices", "site_count");
                void* vectors_ = c.Array(vectors, "vectors", "site_count", "3");
                var sites = new uint[c.Product("site_count")];
                var sitesPlace = (uint*)c.Pin(sites);
                HfException.Check(Functions.hf_direction_add_sites(RawHandle, (uint)c.Count("site_count", 1), vertices_,
                    vectors_, sitesPlace));
                return sites;
            }
        }

        /// <summary>Removes constraints by number.
        ///
        /// sites: [siteCount].
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public void RemoveSites(uint[] sites)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                HfException.Check(Functions.hf_direction_remove_sites(RawHandle, (uint)c.Count("site_count", 1),
                    sites_));
            }
        }

        /// <summary>Moves constraints to other vertices of the same component. The connection transports each vector along
        /// the shortest path of edges, from tangent plane to tangent plane.
        ///
        /// sites: [siteCount].
        /// vertices: [siteCount].
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
        /// HF_ERROR_OUT_OF_RANGE.</summary>
        public void MoveSites(uint[] sites, uint[] vertices)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* vertices_ = c.Array(vertices, "vertices", "site_count");
                HfException.Check(Functions.hf_direction_move_sites(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    vertices_));
            }
        }

        /// <summary>Gives constraints new vectors and projects them on the tangent planes. Does not factorise.
        ///
        /// sites: [siteCount].
        /// vectors: [siteCount x 3].
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void SetVectors(uint[] sites, double[] vectors)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* vectors_ = c.Array(vectors, "vectors", "site_count", "3");
                HfException.Check(Functions.hf_direction_set_vectors(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    vectors_));
            }
        }

        /// <summary>Turns constraint i by angles[i] radians, counter-clockwise seen from outside. Does not factorise.
        ///
        /// sites: [siteCount].
        /// angles: [siteCount].
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void RotateSites(uint[] sites, double[] angles)
        {
            using (var c = new Call(this))
            {
                void* sites_ = c.Array(sites, "sites", "site_count");
                void* angles_ = c.Array(angles, "angles", "site_count");
                HfException.Check(Functions.hf_direction_rotate_sites(RawHandle, (uint)c.Count("site_count", 1), sites_,
                    angles_));
            }
        }

        /// <summary>Returns the number of constraints, or 0 for an invalid object.</summary>
        public int SiteCount
        {
            get
            {
                uint result = Functions.hf_direction_get_site_count(RawHandle);
                GC.KeepAlive(this);
                return (int)result;
            }
        }

        /// <summary>Writes the constraints. Their numbers ascend.</summary>
        public (uint[] Sites, uint[] Vertices, double[] Vectors) Sites()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allSites = null;
                uint[] allVertices = null;
                double[] allVectors = null;
                c.Room("capacity", "hf_direction_get_sites.capacity");
                int result;
                do
                {
                        void* sitesPlace = (void*)c.Make(out allSites, "capacity");
                        void* verticesPlace = (void*)c.Make(out allVertices, "capacity");
                        void* vectorsPlace = (void*)c.Make(out allVectors, "capacity", "3");
                        result = Functions.hf_direction_get_sites(RawHandle, (uint)c.Size("capacity"), sitesPlace,
                            verticesPlace, vectorsPlace, &count);
                }
                while (c.Again("hf_direction_get_sites", result, ("capacity", count)));
                return (c.Cut(allSites, "capacity"), c.Cut(allVertices, "capacity"), c.Cut(allVectors, "capacity",
                    "3"));
            }
        }

        /// <summary>Writes the field as vectors in space. The vectors are tangent to the surface up to 1e-12 of their
        /// length. For degree 2 or 4 the function writes one of the 2 or 4 directions. Constrained vertices hold
        /// their vectors; vertices that no constraint reaches get 0.
        ///
        /// @out: [vertexCount x 3] of float or double.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY.</summary>
        public float[] Solve()
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new float[c.Product("vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_direction_solve(RawHandle, outView, &info));
                lastSolveInfo = info;
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(Span<float> into)
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_direction_solve(RawHandle, outView, &info));
                    lastSolveInfo = info;
                }
            }
        }

        /// <summary>As Solve, in double precision.</summary>
        public double[] SolveDouble()
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                var @out = new double[c.Product("vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_direction_solve(RawHandle, outView, &info));
                lastSolveInfo = info;
                return @out;
            }
        }

        /// <summary>As Solve, into an array of yours.</summary>
        public void Solve(Span<double> into)
        {
            using (var c = new Call(this))
            {
                var info = new hf_solve_info { struct_size = (uint)sizeof(hf_solve_info) };
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_direction_solve(RawHandle, outView, &info));
                    lastSolveInfo = info;
                }
            }
        }

        /// <summary>Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section
        /// 5). On a closed manifold component of one orientation the indices sum to degree times the Euler
        /// characteristic.
        ///
        /// Throws HF_ERROR_EMPTY.</summary>
        public Singularity[] Singularities()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* singularitiesPlace = null;
                c.Room("capacity", "hf_direction_get_singularities.capacity");
                int result;
                do
                {
                        singularitiesPlace = c.Rows(sizeof(hf_singularity), "capacity");
                        result = Functions.hf_direction_get_singularities(RawHandle, (uint)c.Size("capacity"),
                            singularitiesPlace, &count);
                }
                while (c.Again("hf_direction_get_singularities", result, ("capacity", count)));
                var singularities = new Singularity[c.Product("capacity")];
                for (int i = 0; i < singularities.Length; ++i)
                    singularities[i] = new Singularity((hf_singularity*)singularitiesPlace + i);
                return singularities;
            }
        }

        /// <summary>Writes the statistics.</summary>
        public DirectionStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_direction_statistics { struct_size = (uint)sizeof(hf_direction_statistics) };
                    hf_direction_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_direction_get_statistics(RawHandle, statistics));
                    return new DirectionStatistics(statistics);
                }
            }
        }

        hf_solve_info lastSolveInfo;
        /// <summary>What the last call told that writes it.</summary>
        public SolveInfo SolveInfo { get { hf_solve_info copy = lastSolveInfo; return new SolveInfo(&copy); } }

        internal override Recorded State() { return Clone(); }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>A set of handles on a surface.
    ///
    /// Creates a pose without handles.
    ///
    /// bandCount: bands per field, 2 to 64; 0 = 10
    /// iterationCount: iterations of a pose solve, 1 to 1000; 0 = 10
    /// groupCount: groups of vertices that share a rotation, 1 to 2000; 0 = 250</summary>
    public sealed unsafe class Pose : Recorded
    {
        Pose() { }

        /// <summary>Creates a pose without handles.
        ///
        /// bandCount: bands per field, 2 to 64; 0 = 10
        /// iterationCount: iterations of a pose solve, 1 to 1000; 0 = 10
        /// groupCount: groups of vertices that share a rotation, 1 to 2000; 0 = 250
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT.</summary>
        public Pose(Surface surface, uint bandCount = 0, uint iterationCount = 0, uint groupCount = 0)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_pose_desc { struct_size = (uint)sizeof(hf_pose_desc), band_count = bandCount,
                    iteration_count = iterationCount, group_count = groupCount };
                hf_pose_desc* desc = &descStruct;
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_pose_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_pose_destroy, c, "vertex_count");
            }
        }

        /// <summary>Copies a pose with its handles and transforms, so that several threads can pose one rig.</summary>
        public Pose Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_pose_clone(RawHandle, raw));
                var made = new Pose();
                made.Own(*raw, Functions.hf_pose_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The
        /// next Pose.Deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke
        /// moves next to nothing, also where handles of free rotation could rest in two poses. With restart the
        /// frame equals the frame of a new pose on `surface`, to 1e-6 of the box.
        ///
        /// surface: any number of calls of Surface.Edit or Surface.Relink make it from the pose's surface, or the
        ///     pose's surface from it.
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.</summary>
        public void MoveTo(Surface surface)
        {
            using (var c = new Call(this))
            {
                c.Parent("surface.", surface);
                HfException.Check(Functions.hf_pose_move_to(RawHandle, c.Handle(surface)));
                lock (Counts) Counts["vertex_count"] = surface.Known("vertex_count");
            }
        }

        /// <summary>Writes the options of a pose.</summary>
        public PoseInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_pose_info { struct_size = (uint)sizeof(hf_pose_info) };
                    hf_pose_info* info = &infoStruct;
                    HfException.Check(Functions.hf_pose_get_info(RawHandle, info));
                    return new PoseInfo(info);
                }
            }
        }

        /// <summary>Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls
        /// a posed surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the
        /// rigid motion of its region in the last pose (Pose.Handle writes it). The surface stays in place (to 1e-6
        /// of the box). It goes over to the best pose of the new handles while handles move by 0.05 of the box, or
        /// back to rest. Until then the region of the new handle keeps a part of its bend. restart ends this at
        /// once. On a higher layer the surface does not move (to 1e-9 of the box) until you move the handle.
        /// Handles of lower layers hold the surface in place for the higher layers.
        ///
        /// regionVertices: lists of whole numbers: all regions one after the other; null: places are given
        /// vertices: [handleCount] vertices of your mesh, or null
        /// places: [handleCount], or null
        /// points: [handleCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. A point
        ///     can lie inside the body, as a joint does: its nearest vertex counts
        /// radii: [handleCount] of the regions of places, in the unit of the mesh; null: regions are given. A
        ///     radius below 1 % of the box makes regions of 2 vertices or more
        /// layer: 0 to HF_LAYER_COUNT - 1, for the whole batch
        /// inPlace: 1: handles of layer 0 start on the posed surface, not at rest; see below
        /// freeRotation: 1: you give the places alone of all these handles; Pose.SetFreeRotations frees single ones
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE.</summary>
        public uint[] AddHandles(uint[][] regionVertices = null, uint[] vertices = null, Place[] places = null,
                double[] points = null, double[] radii = null, uint layer = 0, bool inPlace = false,
                bool freeRotation = false, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_handles_desc { struct_size = (uint)sizeof(hf_handles_desc), layer = layer,
                    in_place = inPlace ? 1 : 0, free_rotation = freeRotation ? 1 : 0 };
                hf_handles_desc* desc = &descStruct;
                c.Lists(regionVertices, "regionVertices", "handle_count", out desc->region_counts,
                    out desc->region_vertices);
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "handle_count");
                var placesRows = (hf_place*)c.Given(places, "places", sizeof(hf_place), "handle_count");
                for (int i = 0; places != null && i < places.Length; ++i) places[i].Write(c, placesRows + i);
                desc->places = (IntPtr)placesRows;
                desc->points = (IntPtr)c.Array(points, "points", "handle_count", "3");
                desc->radii = (IntPtr)c.Array(radii, "radii", "handle_count");
                desc->progress = c.Handle(progress);
                desc->handle_count = (uint)c.Count("handle_count", 1);
                var handles = new uint[c.Product("handle_count")];
                var handlesPlace = (uint*)c.Pin(handles);
                HfException.Check(Functions.hf_pose_add_handles(RawHandle, desc, handlesPlace));
                return handles;
            }
        }

        /// <summary>Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all
        /// vertices within `radius` of the point that are edge-connected to this vertex.
        ///
        /// point: [3].
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
        /// HF_ERROR_TOO_LARGE.</summary>
        public uint AddHandleAt(double[] point, double radius)
        {
            using (var c = new Call(this))
            {
                void* point_ = c.Array(point, "point", "3");
                uint handle = 0;
                HfException.Check(Functions.hf_pose_add_handle_at(RawHandle, point_, radius, &handle));
                return handle;
            }
        }

        /// <summary>Removes handles by number. A handle on a higher layer takes its edit with it: the surface is then, bit
        /// for bit, as if the handle had never been added. On layer 0 this holds when you remove the handles that
        /// were added last, and for frames with `restart`.
        ///
        /// handles: [handleCount].
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public void RemoveHandles(uint[] handles)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                HfException.Check(Functions.hf_pose_remove_handles(RawHandle, (uint)c.Count("handle_count", 1),
                    handles_));
            }
        }

        /// <summary>Places handles. On layer 0 a transform is a motion from the rest place. On a higher layer it is an edit
        /// in the rest frame of the handle. There the region moves by F (edit) F^-1, with F the rigid motion that
        /// the lower layers give the handle. Rotations continue from call to call, so a handle that you dragged
        /// past 180 degrees stays turned that far. The transforms take effect at the next Pose.Deform.
        ///
        /// handles: [handleCount].
        /// rotations: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
        /// translations: up to 1e15 box diagonals
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void SetTransforms(uint[] handles, double[] rotations = null, double[] translations = null)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                var transforms = (hf_transform*)c.Rows(sizeof(hf_transform), "handle_count");
                c.Fit(rotations, "rotations", "4", "handle_count");
                for (int i = 0; rotations != null && i < rotations.Length; ++i) transforms[i / 4].rotation[i % 4] = rotations[i];
                c.Fit(translations, "translations", "3", "handle_count");
                for (int i = 0; translations != null && i < translations.Length; ++i) transforms[i / 3].translation[i % 3] = translations[i];
                HfException.Check(Functions.hf_pose_set_transforms(RawHandle, (uint)c.Count("handle_count", 1),
                    handles_, transforms));
            }
        }

        /// <summary>Places one handle.
        ///
        /// rotation: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
        /// translation: up to 1e15 box diagonals
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void SetTransform(uint handle, double[] rotation = null, double[] translation = null)
        {
            using (var c = new Call(this))
            {
                var transformStruct = new hf_transform();
                hf_transform* transform = &transformStruct;
                c.Fit(rotation, "rotation", "4");
                for (int i = 0; rotation != null && i < rotation.Length; ++i) transform->rotation[i] = rotation[i];
                c.Fit(translation, "translation", "3");
                for (int i = 0; translation != null && i < translation.Length; ++i) transform->translation[i] = translation[i];
                HfException.Check(Functions.hf_pose_set_transform(RawHandle, handle, transform));
            }
        }

        /// <summary>Frees the rotations of handles, or lets you give them again. A handle of free rotation is a positional
        /// constraint (Sorkine and Alexa 2007). Its centroid lands exactly where its transform puts it; the
        /// rotation of the transform is ignored. Each Pose.Deform finds the rotation together with the pose, and
        /// Pose.Handle writes it. The rotation has the least as-rigid-as-possible energy. The energy of a pulled
        /// group of vertices is measured from a longer and thinner shape than the rest shape of the group. So the
        /// rotation is not exactly the rotation of least energy from the rest shape.
        ///
        /// Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation
        /// while the user turns a ring. A given rotation starts at the present rotation of the handle, so the pose
        /// does not change. When you free a rotation on layer 0, the surface stays as it is. It releases the old
        /// rotation as handles move, as with in_place; so move the handles after this call. On a higher layer a
        /// changed handle moves the surface at the next frame. A handle alone in its component keeps its rotation.
        /// The first frame of a pose, and a frame with restart, move free handles to their places in 8 steps, as a
        /// drag does. Such a frame takes the time of about 8 pose solves. refine keeps the rotation of the smooth
        /// pose.
        ///
        /// handles: [handleCount].
        /// freeRotation: 1: the solve finds the rotations; 0: you give them.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND.</summary>
        public void SetFreeRotations(uint[] handles, bool freeRotation = false)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                HfException.Check(Functions.hf_pose_set_free_rotations(RawHandle, (uint)c.Count("handle_count", 1),
                    handles_, freeRotation ? 1 : 0));
            }
        }

        /// <summary>Sets how much of the surface follows handles of layer 0. Below 1, soft pins hold the surface where it
        /// would be without these handles. So a body does not lean after a dragged hand. Where the field of the
        /// handle is near 1, the pins are weak, so the limb stays free. Keep 1 for the handles that hold the body,
        /// and set less for a handle that is dragged. Every handle still lands exactly, and a limb that is too
        /// short gets longer. The next Pose.Deform shows a change at once. But a handle that was just added in
        /// place leaves the surface where it stands until a handle moves. Full-mesh steps (refine) ignore the pins.
        /// Repeated steps (refine_from_last) let the body lean again.
        ///
        /// handles: [handleCount].
        /// following: 0 to 1. At 1 all of the surface follows the handle; a new handle has 1. At 0 only the limb of
        ///     the handle follows, such as an arm.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.</summary>
        public void SetFollowing(uint[] handles, double following = 0)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                HfException.Check(Functions.hf_pose_set_following(RawHandle, (uint)c.Count("handle_count", 1), handles_,
                    following));
            }
        }

        /// <summary>Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. The
        /// limb is the part of the surface where the field of the handle falls a long way over little area. It ends
        /// at the trunk, or at the next handle on the limb. The steps move the limb alone. All other vertices keep
        /// their bits, so the body leans no more than without the steps. A limb that is pulled beyond its length is
        /// stretched evenly. The limbs take their steps after the steps of DeformDesc.refine. If handles have
        /// different counts of steps, all their limbs take the largest count.
        ///
        /// handles: [handleCount].
        /// refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a new handle.
        ///     With 1, bends stay smooth. With 8 and more, most edges keep their lengths to a few per cent, and the
        ///     limb bends like two bones. Edges beside the handle can change more.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.</summary>
        public void SetLimbRefine(uint[] handles, int refine = 0)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                HfException.Check(Functions.hf_pose_set_limb_refine(RawHandle, (uint)c.Count("handle_count", 1),
                    handles_, refine));
            }
        }

        /// <summary>Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. Each
        /// frame moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near
        /// links count most in this fit. If the region of a handle touches a rigid piece, the whole piece joins the
        /// region and moves with the handle. A second handle on the same piece is refused (HF_ERROR_CONFLICT). Call
        /// this function before you add such handles. Pose.Skin writes the motions before this fit.
        ///
        /// vertices: [vertexCount], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid.
        ///     The list replaces the previous list.
        ///
        /// Throws HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public void SetRigidPieces(uint[] vertices)
        {
            using (var c = new Call(this))
            {
                c.Sizes.Remove("vertex_count");  // of the list given here
                void* vertices_ = c.Array(vertices, "vertices", "vertex_count");
                HfException.Check(Functions.hf_pose_set_rigid_pieces(RawHandle, (uint)c.Count("vertex_count", 1),
                    vertices_));
            }
        }

        /// <summary>Places handles by 4 x 4 matrices M.
        ///
        /// handles: [handleCount].
        /// matrices: [handleCount x 16], column by column. The last column is the translation. M moves a rest
        ///     position p to the posed position M p. Its linear part must be a rotation within 1e-4; the function
        ///     takes the nearest rotation. Its last row must be 0 0 0 1.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.</summary>
        public void SetMatrices(uint[] handles, double[] matrices)
        {
            using (var c = new Call(this))
            {
                void* handles_ = c.Array(handles, "handles", "handle_count");
                void* matrices_ = c.Array(matrices, "matrices", "handle_count", "16");
                HfException.Check(Functions.hf_pose_set_matrices(RawHandle, (uint)c.Count("handle_count", 1), handles_,
                    matrices_));
            }
        }

        /// <summary>Writes the info of a handle.
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public HandleInfo Handle(uint handle)
        {
            using (var c = new Call(this))
            {
                var infoStruct = new hf_handle_info { struct_size = (uint)sizeof(hf_handle_info) };
                hf_handle_info* info = &infoStruct;
                HfException.Check(Functions.hf_pose_get_handle(RawHandle, handle, info));
                return new HandleInfo(info);
            }
        }

        /// <summary>Returns the number of handles, or 0 for an invalid object.</summary>
        public int HandleCount
        {
            get
            {
                uint result = Functions.hf_pose_get_handle_count(RawHandle);
                GC.KeepAlive(this);
                return (int)result;
            }
        }

        /// <summary>Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a
        /// handle reaches, the fields of all handles sum to 1.
        ///
        /// @out: [vertexCount] of float or double.
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public float[] Field(uint handle)
        {
            using (var c = new Call(this))
            {
                var @out = new float[c.Product("vertex_count")];
                var @outPlace = (float*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_pose_get_field(RawHandle, handle, outView));
                return @out;
            }
        }

        /// <summary>As Field, into an array of yours.</summary>
        public void Field(uint handle, Span<float> into)
        {
            using (var c = new Call(this))
            {
                c.Need(into.Length, "into", "vertex_count");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_pose_get_field(RawHandle, handle, outView));
                }
            }
        }

        /// <summary>As Field, in double precision.</summary>
        public double[] FieldDouble(uint handle)
        {
            using (var c = new Call(this))
            {
                var @out = new double[c.Product("vertex_count")];
                var @outPlace = (double*)c.Pin(@out);
                hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                hf_array_out* outView = &outViewArray;
                HfException.Check(Functions.hf_pose_get_field(RawHandle, handle, outView));
                return @out;
            }
        }

        /// <summary>As Field, into an array of yours.</summary>
        public void Field(uint handle, Span<double> into)
        {
            using (var c = new Call(this))
            {
                c.Need(into.Length, "into", "vertex_count");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    hf_array_out outViewArray = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    hf_array_out* outView = &outViewArray;
                    HfException.Check(Functions.hf_pose_get_field(RawHandle, handle, outView));
                }
            }
        }

        /// <summary>Does the same as Pose.Deform, with the options of a desc.
        ///
        /// iterationCount: 1 to 1000; 0 = the pose's
        /// restart: 1: forget the last pose and start from the fields. The frame then has the bits of a fresh pose
        ///     with the same handles, added in the same order, and the same transforms. Without restart a frame
        ///     continues from the last one, so it also depends on that
        /// refine: 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes
        ///     about 0.2 us per vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get
        ///     sharper
        /// refineFromLast: 1: the steps go on from the surface of the last call, instead of starting at the smooth
        ///     pose. Then one step a frame keeps lengths in a drag as well as 8 do without. If the handles do not
        ///     move, more calls converge to the minimum. A restart, or a call without it, forgets that surface.
        ///     Needs a refine of 1 or more. Higher layers start at the smooth pose. Memory: 72 bytes per vertex
        /// firstVertex: outputs hold vertex_count vertices from this one on; 0 and 0: all
        /// vertexCount: positions of a range cost only the range; but with higher layers, rigid pieces, refine,
        ///     limb_refine or normals they cost the whole surface
        /// @out: [vertexCount x 3] of float or double: posed positions
        /// normals: [vertexCount x 3] of float or double: unit normals of the posed surface, shared across seams
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public float[] Deform(uint iterationCount = 0, bool restart = false, int refine = 0,
                bool refineFromLast = false, uint firstVertex = 0, uint vertexCount = 0,
                Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_deform_info { struct_size = (uint)sizeof(hf_deform_info) };
                var descStruct = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc),
                    iteration_count = iterationCount, restart = restart ? 1 : 0, refine = refine,
                    refine_from_last = refineFromLast ? 1 : 0, first_vertex = firstVertex, vertex_count = vertexCount };
                hf_deform_desc* desc = &descStruct;
                if (vertexCount != 0) c.Sizes["vertex_count"] = (int)Math.Min(vertexCount, int.MaxValue);
                var @out = new float[c.Product("vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_pose_deform(RawHandle, desc, &info));
                    lastDeformInfo = info;
                    return @out;
                }
            }
        }

        /// <summary>As Deform, into an array of yours.</summary>
        public void Deform(Span<float> into, Span<float> normals = default(Span<float>), uint iterationCount = 0,
                bool restart = false, int refine = 0, bool refineFromLast = false, uint firstVertex = 0,
                uint vertexCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_deform_info { struct_size = (uint)sizeof(hf_deform_info) };
                var descStruct = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc),
                    iteration_count = iterationCount, restart = restart ? 1 : 0, refine = refine,
                    refine_from_last = refineFromLast ? 1 : 0, first_vertex = firstVertex, vertex_count = vertexCount };
                hf_deform_desc* desc = &descStruct;
                if (vertexCount != 0) c.Sizes["vertex_count"] = (int)Math.Min(vertexCount, int.MaxValue);
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_pose_deform(RawHandle, desc, &info));
                        lastDeformInfo = info;
                    }
                }
            }
        }

        /// <summary>As Deform, in double precision.</summary>
        public double[] DeformDouble(uint iterationCount = 0, bool restart = false, int refine = 0,
                bool refineFromLast = false, uint firstVertex = 0, uint vertexCount = 0,
                Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var info = new hf_deform_info { struct_size = (uint)sizeof(hf_deform_info) };
                var descStruct = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc),
                    iteration_count = iterationCount, restart = restart ? 1 : 0, refine = refine,
                    refine_from_last = refineFromLast ? 1 : 0, first_vertex = firstVertex, vertex_count = vertexCount };
                hf_deform_desc* desc = &descStruct;
                if (vertexCount != 0) c.Sizes["vertex_count"] = (int)Math.Min(vertexCount, int.MaxValue);
                var @out = new double[c.Product("vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_pose_deform(RawHandle, desc, &info));
                    lastDeformInfo = info;
                    return @out;
                }
            }
        }

        /// <summary>As Deform, into an array of yours.</summary>
        public void Deform(Span<double> into, Span<float> normals = default(Span<float>), uint iterationCount = 0,
                bool restart = false, int refine = 0, bool refineFromLast = false, uint firstVertex = 0,
                uint vertexCount = 0)
        {
            using (var c = new Call(this))
            {
                var info = new hf_deform_info { struct_size = (uint)sizeof(hf_deform_info) };
                var descStruct = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc),
                    iteration_count = iterationCount, restart = restart ? 1 : 0, refine = refine,
                    refine_from_last = refineFromLast ? 1 : 0, first_vertex = firstVertex, vertex_count = vertexCount };
                hf_deform_desc* desc = &descStruct;
                if (vertexCount != 0) c.Sizes["vertex_count"] = (int)Math.Min(vertexCount, int.MaxValue);
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_pose_deform(RawHandle, desc, &info));
                        lastDeformInfo = info;
                    }
                }
            }
        }

        /// <summary>Writes the statistics of a pose.</summary>
        public PoseStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_pose_statistics { struct_size = (uint)sizeof(hf_pose_statistics) };
                    hf_pose_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_pose_get_statistics(RawHandle, statistics));
                    return new PoseStatistics(statistics);
                }
            }
        }

        /// <summary>Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they
        /// were added. If the handles do not reach some vertices, a last joint that never moves holds those
        /// vertices. The weights of a vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in
        /// single precision. Weights and pivots change only when handles are added or removed.
        ///
        /// The joint motions bring the skin as near as possible to the last Pose.Deform, as it is without refine.
        /// With scales, classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales,
        /// bends and twists replay within 1 per cent and stretched surfaces within about 2.5 per cent.
        ///
        /// influenceCount: joints per vertex, 4 or 8; 0 = 4
        /// scales: [jointCapacity x 3] along the axes in the last frame; null = joints are rigid
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.</summary>
        public SkinInfo Skin(uint influenceCount = 0, bool scales = false)
        {
            using (var c = new Call(this))
            {
                var skinStruct = new hf_skin_info { struct_size = (uint)sizeof(hf_skin_info),
                    influence_count = influenceCount };
                hf_skin_info* skin = &skinStruct;
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 4 : influenceCount, int.MaxValue);
                double[] allPivots = null;
                double[] allRotations = null;
                double[] allTranslations = null;
                double[] allAxes = null;
                double[] allScales = null;
                uint[] allVertexJoints = null;
                float[] allVertexWeights = null;
                c.Room("joint_capacity", "joint_count");
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        skin->joint_capacity = (uint)c.Size("joint_capacity");
                        skin->vertex_capacity = (uint)c.Size("vertex_capacity");
                        skin->pivots = c.Make(out allPivots, "joint_capacity", "3");
                        skin->rotations = c.Make(out allRotations, "joint_capacity", "4");
                        skin->translations = c.Make(out allTranslations, "joint_capacity", "3");
                        skin->axes = c.Make(out allAxes, "joint_capacity", "4");
                        skin->scales = scales ? c.Make(out allScales, "joint_capacity", "3") : IntPtr.Zero;
                        skin->vertex_joints = c.Make(out allVertexJoints, "vertex_capacity", "influence_count");
                        skin->vertex_weights = c.Make(out allVertexWeights, "vertex_capacity", "influence_count");
                        result = Functions.hf_pose_get_skin(RawHandle, skin);
                }
                while (c.Again("hf_pose_get_skin", result, ("joint_capacity", skin->joint_count), ("vertex_capacity",
                    skin->vertex_count)));
                return new SkinInfo { InfluenceCount = skin->influence_count, Pivots = c.Cut(allPivots,
                    "joint_capacity", "3"), Rotations = c.Cut(allRotations, "joint_capacity", "4"),
                    Translations = c.Cut(allTranslations, "joint_capacity", "3"), Axes = c.Cut(allAxes,
                    "joint_capacity", "4"), Scales = c.Cut(allScales, "joint_capacity", "3"),
                    VertexJoints = c.Cut(allVertexJoints, "vertex_capacity", "influence_count"),
                    VertexWeights = c.Cut(allVertexWeights, "vertex_capacity", "influence_count") };
            }
        }

        /// <summary>Writes the info of a blend.
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public BlendInfo BlendInfo
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_blend_info { struct_size = (uint)sizeof(hf_blend_info) };
                    hf_blend_info* info = &infoStruct;
                    HfException.Check(Functions.hf_pose_get_blend_info(RawHandle, info));
                    return new BlendInfo(info);
                }
            }
        }

        /// <summary>Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts,
        /// then with arrays. If handles do not reach some vertices, a last cluster that never moves holds those
        /// vertices.
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public BlendRows BlendRows()
        {
            using (var c = new Call(this))
            {
                var rowsStruct = new hf_blend_rows { struct_size = (uint)sizeof(hf_blend_rows) };
                hf_blend_rows* rows = &rowsStruct;
                uint[] allRows = null;
                ushort[] allClusters = null;
                float[] allWeights = null;
                float[] allGradients = null;
                float[] allPositions = null;
                float[] allNormals = null;
                float[] allOffsets = null;
                c.Room("vertex_capacity", "vertex_count");
                c.Room("entry_capacity", "hf_pose_get_blend_rows.entry_capacity");
                int result;
                do
                {
                        rows->vertex_capacity = (uint)c.Size("vertex_capacity");
                        rows->entry_capacity = (uint)c.Size("entry_capacity");
                        rows->rows = c.Make(out allRows, "vertex_capacity", "2");
                        rows->clusters = c.Make(out allClusters, "entry_capacity");
                        rows->weights = c.Make(out allWeights, "entry_capacity");
                        rows->gradients = c.Make(out allGradients, "entry_capacity", "3");
                        rows->positions = c.Make(out allPositions, "vertex_capacity", "3");
                        rows->normals = c.Make(out allNormals, "vertex_capacity", "3");
                        rows->offsets = c.Make(out allOffsets, "vertex_capacity", "3");
                        result = Functions.hf_pose_get_blend_rows(RawHandle, rows);
                }
                while (c.Again("hf_pose_get_blend_rows", result, ("vertex_capacity", rows->vertex_count),
                    ("entry_capacity", rows->entry_count)));
                return new BlendRows { LongestRow = rows->longest_row, Rows = c.Cut(allRows, "vertex_capacity", "2"),
                    Clusters = c.Cut(allClusters, "entry_capacity"), Weights = c.Cut(allWeights, "entry_capacity"),
                    Gradients = c.Cut(allGradients, "entry_capacity", "3"), Positions = c.Cut(allPositions,
                    "vertex_capacity", "3"), Normals = c.Cut(allNormals, "vertex_capacity", "3"),
                    Offsets = c.Cut(allOffsets, "vertex_capacity", "3") };
            }
        }

        /// <summary>Writes rows of one length. They change with `revision`, as the rows of Pose.BlendRows do. Call it
        /// without arrays for the count and the errors.
        ///
        /// influenceCount: clusters of each vertex, the length of a row, 1 to 64; 0 = 8
        /// byteClusters: [vertexCapacity x influenceCount] null = not wanted. Refused for more than 256 clusters
        /// byteWeights: [vertexCapacity x influenceCount] null = not wanted. 255ths, of sum 255; weights that round
        ///     to 0 are left out
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public BlendInfluences BlendInfluences(uint influenceCount = 0, bool byteClusters = false,
                bool byteWeights = false)
        {
            using (var c = new Call(this))
            {
                var influencesStruct = new hf_blend_influences { struct_size = (uint)sizeof(hf_blend_influences),
                    influence_count = influenceCount };
                hf_blend_influences* influences = &influencesStruct;
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 8 : influenceCount, int.MaxValue);
                ushort[] allClusters = null;
                ushort[] allWeights = null;
                byte[] allByteClusters = null;
                byte[] allByteWeights = null;
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        influences->vertex_capacity = (uint)c.Size("vertex_capacity");
                        influences->clusters = c.Make(out allClusters, "vertex_capacity", "influence_count");
                        influences->weights = c.Make(out allWeights, "vertex_capacity", "influence_count");
                        influences->byte_clusters = byteClusters ? c.Make(out allByteClusters, "vertex_capacity",
                            "influence_count") : IntPtr.Zero;
                        influences->byte_weights = byteWeights ? c.Make(out allByteWeights, "vertex_capacity",
                            "influence_count") : IntPtr.Zero;
                        result = Functions.hf_pose_get_blend_influences(RawHandle, influences);
                }
                while (c.Again("hf_pose_get_blend_influences", result, ("vertex_capacity", influences->vertex_count)));
                return new BlendInfluences { Change = influences->change, ByteChange = influences->byte_change,
                    Error = influences->error, ByteError = influences->byte_error,
                    InfluenceCount = influences->influence_count, Clusters = c.Cut(allClusters, "vertex_capacity",
                    "influence_count"), Weights = c.Cut(allWeights, "vertex_capacity", "influence_count"),
                    ByteClusters = c.Cut(allByteClusters, "vertex_capacity", "influence_count"),
                    ByteWeights = c.Cut(allByteWeights, "vertex_capacity", "influence_count") };
            }
        }

        /// <summary>Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
        /// Pose.Deform. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as
        /// much as Pose.Deform.
        ///
        /// iterationCount: 1 to 1000; 0 = as in PoseDesc.
        /// restart: 1: as in DeformDesc.
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.</summary>
        public void Solve(uint iterationCount = 0, bool restart = false)
        {
            using (var c = new Call(this))
            {
                var info = new hf_deform_info { struct_size = (uint)sizeof(hf_deform_info) };
                HfException.Check(Functions.hf_pose_solve(RawHandle, iterationCount, restart ? 1 : 0, &info));
                lastDeformInfo = info;
            }
        }

        /// <summary>Writes the transforms of the clusters in the last Pose.Solve or Pose.Deform, without its refine. Before
        /// the first solve they are identities. After handles were added or removed, solve before you read them:
        /// they may be identities until then. The call allocates nothing.
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public float[] BlendTransforms()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                float[] allTransforms = null;
                c.Room("capacity", "hf_pose_get_blend_transforms.capacity");
                int result;
                do
                {
                        void* transformsPlace = (void*)c.Make(out allTransforms, "capacity", "12");
                        result = Functions.hf_pose_get_blend_transforms(RawHandle, (uint)c.Size("capacity"),
                            transformsPlace, &count);
                }
                while (c.Again("hf_pose_get_blend_transforms", result, ("capacity", count)));
                return c.Cut(allTransforms, "capacity", "12");
            }
        }

        hf_deform_info lastDeformInfo;
        /// <summary>What the last call told that writes it.</summary>
        public DeformInfo DeformInfo { get { hf_deform_info copy = lastDeformInfo; return new DeformInfo(&copy); } }

        internal override Recorded State() { return Clone(); }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature.
    /// Creases and borders are straight lines of edges. Irregular vertices are the singularities of the crosses,
    /// and places where the function split quads to keep to the surface.
    ///
    /// The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge
    /// lengths, it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal
    /// keeps nearer to the surface, so a renderer should split quads into triangles from the first corner. If the
    /// mesh stays farther than an edge length from the surface, a limb is lost. Then the function makes up to three
    /// finer meshes, and removes rows of quads until the number is right. The function checks every result. Each
    /// directed edge occurs once. No face repeats a corner. The result has the Euler characteristic of the surface.
    ///
    /// The surface may have borders, any genus and several components; the function turns triangles that disagree
    /// in orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two.
    /// A triangle without a partner gets a border. Surface.Report counts such edges. A Moebius band is parted
    /// across.
    ///
    /// With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding.
    /// Half of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the
    /// side of the normal counts.
    ///
    /// The user can place irregular vertices and drag them. The function makes each by guides on a ring around the
    /// place, an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000
    /// irregular vertices at random places of 20 meshes come out within an edge of the place; such a vertex then
    /// moves to the place and stays there. A vertex of 5 quads brings others of 3 with it, because the indices of
    /// the crosses sum to four times the Euler characteristic. On a torus or a knot a single one of 5 is often
    /// lost.
    ///
    /// creaseEdges: [creaseCount x 2] the two vertices of each edge, of your mesh
    /// guideVertices: [guideCount] vertices of your mesh; guides of one vertex are averaged
    /// guideVectors: [guideCount x 3] along the surface, of any length above 0; quads run along the vector and
    ///     across it
    /// guideWeights: null = all 1, or [guideCount], above 0 to 1: 1 holds the direction. A smaller weight mixes it
    ///     with the direction of the curvature, which has the rest of the weight
    /// irregularPoints: [irregularCount x 3] at the surface, in the unit and frame of the mesh
    /// irregularValences: [irregularCount] how many quads meet there: 3 or 5
    /// irregularDirections: null = any, or [irregularCount x 3]: one side of the irregular vertex runs along it; 0
    ///     0 0 = any
    /// faceCount: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
    /// edgeLength: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
    /// creaseAngle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 =
    ///     none.  If there are more than 1,024 lines of creases and borders, only the longest are kept. Creases
    ///     nearer to each other than an edge may be released
    /// relaxCount: rounds of tangential relaxation, up to 1,000; 0 = 60; uint.MaxValue = none, and the mesh is not
    ///     fitted to the surface either
    /// symmetryPlane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none.
    ///     Quads are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular
    ///     vertices on the other side are not used
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Quads : HfObject
    {
        /// <summary>Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature.
        /// Creases and borders are straight lines of edges. Irregular vertices are the singularities of the
        /// crosses, and places where the function split quads to keep to the surface.
        ///
        /// The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge
        /// lengths, it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose
        /// diagonal keeps nearer to the surface, so a renderer should split quads into triangles from the first
        /// corner. If the mesh stays farther than an edge length from the surface, a limb is lost. Then the
        /// function makes up to three finer meshes, and removes rows of quads until the number is right. The
        /// function checks every result. Each directed edge occurs once. No face repeats a corner. The result has
        /// the Euler characteristic of the surface.
        ///
        /// The surface may have borders, any genus and several components; the function turns triangles that
        /// disagree in orientation. Where three or more triangles share an edge, the two flattest are joined, then
        /// the next two. A triangle without a partner gets a border. Surface.Report counts such edges. A Moebius
        /// band is parted across.
        ///
        /// With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to
        /// rounding. Half of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box
        /// diagonals, the side of the normal counts.
        ///
        /// The user can place irregular vertices and drag them. The function makes each by guides on a ring around
        /// the place, an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of
        /// 1,000 irregular vertices at random places of 20 meshes come out within an edge of the place; such a
        /// vertex then moves to the place and stays there. A vertex of 5 quads brings others of 3 with it, because
        /// the indices of the crosses sum to four times the Euler characteristic. On a torus or a knot a single one
        /// of 5 is often lost.
        ///
        /// creaseEdges: [creaseCount x 2] the two vertices of each edge, of your mesh
        /// guideVertices: [guideCount] vertices of your mesh; guides of one vertex are averaged
        /// guideVectors: [guideCount x 3] along the surface, of any length above 0; quads run along the vector and
        ///     across it
        /// guideWeights: null = all 1, or [guideCount], above 0 to 1: 1 holds the direction. A smaller weight mixes
        ///     it with the direction of the curvature, which has the rest of the weight
        /// irregularPoints: [irregularCount x 3] at the surface, in the unit and frame of the mesh
        /// irregularValences: [irregularCount] how many quads meet there: 3 or 5
        /// irregularDirections: null = any, or [irregularCount x 3]: one side of the irregular vertex runs along
        ///     it; 0 0 0 = any
        /// faceCount: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
        /// edgeLength: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
        /// creaseAngle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads;
        ///     0 = none.  If there are more than 1,024 lines of creases and borders, only the longest are kept.
        ///     Creases nearer to each other than an edge may be released
        /// relaxCount: rounds of tangential relaxation, up to 1,000; 0 = 60; uint.MaxValue = none, and the mesh is
        ///     not fitted to the surface either
        /// symmetryPlane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none.
        ///     Quads are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular
        ///     vertices on the other side are not used
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INTERNAL, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public Quads(Surface surface, uint[] creaseEdges = null, uint[] guideVertices = null,
                double[] guideVectors = null, float[] guideWeights = null, double[] irregularPoints = null,
                uint[] irregularValences = null, double[] irregularDirections = null, uint faceCount = 0,
                double edgeLength = 0, double creaseAngle = 0, uint relaxCount = 0, double[] symmetryPlane = null,
                Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_quads_desc { struct_size = (uint)sizeof(hf_quads_desc), face_count = faceCount,
                    edge_length = edgeLength, crease_angle = creaseAngle, relax_count = relaxCount };
                hf_quads_desc* desc = &descStruct;
                desc->crease_edges = (IntPtr)c.Array(creaseEdges, "creaseEdges", "crease_count", "2");
                desc->guide_vertices = (IntPtr)c.Array(guideVertices, "guideVertices", "guide_count");
                desc->guide_vectors = (IntPtr)c.Array(guideVectors, "guideVectors", "guide_count", "3");
                desc->guide_weights = (IntPtr)c.Array(guideWeights, "guideWeights", "guide_count");
                desc->irregular_points = (IntPtr)c.Array(irregularPoints, "irregularPoints", "irregular_count", "3");
                desc->irregular_valences = (IntPtr)c.Array(irregularValences, "irregularValences", "irregular_count");
                desc->irregular_directions = (IntPtr)c.Array(irregularDirections, "irregularDirections",
                    "irregular_count", "3");
                c.Fit(symmetryPlane, "symmetryPlane", "4");
                for (int i = 0; symmetryPlane != null && i < symmetryPlane.Length; ++i) desc->symmetry_plane[i] = symmetryPlane[i];
                desc->progress = c.Handle(progress);
                desc->crease_count = (uint)c.Count("crease_count", 0);
                desc->guide_count = (uint)c.Count("guide_count", 0);
                desc->irregular_count = (uint)c.Count("irregular_count", 0);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_quads_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_quads_destroy, c);
            }
        }

        /// <summary>Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. Quads
        /// with the same options gives the same result, bit for bit. The first update takes as long. It keeps the
        /// tables that do not depend on guides, creases and relax_count. Later updates with the same edge_length,
        /// face_count and symmetry_plane take less time. Without relaxation (relax_count = uint.MaxValue) they take
        /// 0.1 s for 15,000 vertices. Use that while the user drags, and relax_count = 0 at the end. Other sizes
        /// and planes are allowed; what belongs to them is made again. After an error `quads` is unchanged. Kept
        /// memory: 2 to 4 kB per vertex, until `quads` is destroyed.
        ///
        /// creaseEdges: [creaseCount x 2] the two vertices of each edge, of your mesh
        /// guideVertices: [guideCount] vertices of your mesh; guides of one vertex are averaged
        /// guideVectors: [guideCount x 3] along the surface, of any length above 0; quads run along the vector and
        ///     across it
        /// guideWeights: null = all 1, or [guideCount], above 0 to 1: 1 holds the direction. A smaller weight mixes
        ///     it with the direction of the curvature, which has the rest of the weight
        /// irregularPoints: [irregularCount x 3] at the surface, in the unit and frame of the mesh
        /// irregularValences: [irregularCount] how many quads meet there: 3 or 5
        /// irregularDirections: null = any, or [irregularCount x 3]: one side of the irregular vertex runs along
        ///     it; 0 0 0 = any
        /// faceCount: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
        /// edgeLength: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
        /// creaseAngle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads;
        ///     0 = none.  If there are more than 1,024 lines of creases and borders, only the longest are kept.
        ///     Creases nearer to each other than an edge may be released
        /// relaxCount: rounds of tangential relaxation, up to 1,000; 0 = 60; uint.MaxValue = none, and the mesh is
        ///     not fitted to the surface either
        /// symmetryPlane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none.
        ///     Quads are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular
        ///     vertices on the other side are not used
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INTERNAL, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public void Update(uint[] creaseEdges = null, uint[] guideVertices = null, double[] guideVectors = null,
                float[] guideWeights = null, double[] irregularPoints = null, uint[] irregularValences = null,
                double[] irregularDirections = null, uint faceCount = 0, double edgeLength = 0, double creaseAngle = 0,
                uint relaxCount = 0, double[] symmetryPlane = null, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_quads_desc { struct_size = (uint)sizeof(hf_quads_desc), face_count = faceCount,
                    edge_length = edgeLength, crease_angle = creaseAngle, relax_count = relaxCount };
                hf_quads_desc* desc = &descStruct;
                desc->crease_edges = (IntPtr)c.Array(creaseEdges, "creaseEdges", "crease_count", "2");
                desc->guide_vertices = (IntPtr)c.Array(guideVertices, "guideVertices", "guide_count");
                desc->guide_vectors = (IntPtr)c.Array(guideVectors, "guideVectors", "guide_count", "3");
                desc->guide_weights = (IntPtr)c.Array(guideWeights, "guideWeights", "guide_count");
                desc->irregular_points = (IntPtr)c.Array(irregularPoints, "irregularPoints", "irregular_count", "3");
                desc->irregular_valences = (IntPtr)c.Array(irregularValences, "irregularValences", "irregular_count");
                desc->irregular_directions = (IntPtr)c.Array(irregularDirections, "irregularDirections",
                    "irregular_count", "3");
                c.Fit(symmetryPlane, "symmetryPlane", "4");
                for (int i = 0; symmetryPlane != null && i < symmetryPlane.Length; ++i) desc->symmetry_plane[i] = symmetryPlane[i];
                desc->progress = c.Handle(progress);
                desc->crease_count = (uint)c.Count("crease_count", 0);
                desc->guide_count = (uint)c.Count("guide_count", 0);
                desc->irregular_count = (uint)c.Count("irregular_count", 0);
                HfException.Check(Functions.hf_quads_update(RawHandle, desc));
            }
        }

        /// <summary>Writes the counts.</summary>
        public QuadsInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_quads_info { struct_size = (uint)sizeof(hf_quads_info) };
                    hf_quads_info* info = &infoStruct;
                    HfException.Check(Functions.hf_quads_get_info(RawHandle, info));
                    return new QuadsInfo(info);
                }
            }
        }

        /// <summary>Writes every array that is not null.
        ///
        /// Throws HF_ERROR_TOO_SMALL.</summary>
        public QuadsMesh Mesh()
        {
            using (var c = new Call(this))
            {
                var meshStruct = new hf_quads_mesh { struct_size = (uint)sizeof(hf_quads_mesh) };
                hf_quads_mesh* mesh = &meshStruct;
                double[] allPositions = null;
                uint[] allFaces = null;
                uint[] allTriangles = null;
                double[] allBarycentrics = null;
                uint[] allCorners = null;
                c.Room("vertex_capacity", "vertex_count");
                c.Room("face_capacity", "hf_quads_get_mesh.face_capacity");
                int result;
                do
                {
                        mesh->vertex_capacity = (uint)c.Size("vertex_capacity");
                        mesh->face_capacity = (uint)c.Size("face_capacity");
                        mesh->positions = c.Make(out allPositions, "vertex_capacity", "3");
                        mesh->faces = c.Make(out allFaces, "face_capacity", "4");
                        mesh->triangles = c.Make(out allTriangles, "vertex_capacity");
                        mesh->barycentrics = c.Make(out allBarycentrics, "vertex_capacity", "3");
                        mesh->corners = c.Make(out allCorners, "vertex_capacity", "3");
                        result = Functions.hf_quads_get_mesh(RawHandle, mesh);
                }
                while (c.Again("hf_quads_get_mesh", result, ("vertex_capacity", mesh->vertex_count), ("face_capacity",
                    mesh->face_count)));
                return new QuadsMesh { Positions = c.Cut(allPositions, "vertex_capacity", "3"), Faces = c.Cut(allFaces,
                    "face_capacity", "4"), Triangles = c.Cut(allTriangles, "vertex_capacity"),
                    Barycentrics = c.Cut(allBarycentrics, "vertex_capacity", "3"), Corners = c.Cut(allCorners,
                    "vertex_capacity", "3") };
            }
        }
    }

    /// <summary>A surface that is prepared for tracing streamlines.
    ///
    /// Prepares a surface for tracing: computes half-edges and weights.</summary>
    public sealed unsafe class Flow : HfObject
    {
        /// <summary>Prepares a surface for tracing: computes half-edges and weights.
        ///
        /// Throws HF_ERROR_UNSUPPORTED.</summary>
        public Flow(Surface surface)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_flow_create(c.Handle(surface), raw)));
                Own(*raw, Functions.hf_flow_destroy, c, "vertex_count");
            }
        }

        /// <summary>Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
        /// Operator.Clamped the lines are denser where the field is steeper. Surface.TraceIsolines gives the lines
        /// that cross the streamlines.
        ///
        /// field: [vertexCount] of float or double.
        /// seeds: [seedCount] vertices of your mesh
        /// wantedCount: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.</summary>
        public Streamlines Trace(Reals field, uint[] seeds = null, uint wantedCount = 0)
        {
            using (var c = new Call(this))
            {
                hf_array field_Array = c.View(field?.Values, "field", "vertex_count");
                hf_array* field_ = &field_Array;
                var linesStruct = new hf_streamlines { struct_size = (uint)sizeof(hf_streamlines),
                    wanted_count = wantedCount };
                hf_streamlines* lines = &linesStruct;
                lines->seeds = (IntPtr)c.Array(seeds, "seeds", "seed_count");
                lines->seed_count = (uint)c.Count("seed_count", 0);
                double[] allPositions = null;
                double[] allValues = null;
                uint[] allLineStarts = null;
                uint[] allLineEnds = null;
                c.Room("point_capacity", "hf_flow_trace.point_capacity");
                c.Room("line_capacity", "hf_flow_trace.line_capacity");
                int result;
                do
                {
                        lines->point_capacity = (uint)c.Size("point_capacity");
                        lines->line_capacity = (uint)c.Size("line_capacity");
                        lines->positions = c.Make(out allPositions, "point_capacity", "3");
                        lines->values = c.Make(out allValues, "point_capacity");
                        lines->line_starts = c.Make(out allLineStarts, "line_capacity + 1");
                        lines->line_ends = c.Make(out allLineEnds, "line_capacity", "2");
                        result = Functions.hf_flow_trace(RawHandle, field == null ? null : field_, lines);
                }
                while (c.Again("hf_flow_trace", result, ("point_capacity", lines->point_count), ("line_capacity",
                    lines->line_count)));
                return new Streamlines { Positions = c.Cut(allPositions, "point_capacity", "3"),
                    Values = c.Cut(allValues, "point_capacity"), LineStarts = c.Cut(allLineStarts, "line_capacity + 1"),
                    LineEnds = c.Cut(allLineEnds, "line_capacity", "2") };
            }
        }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>A region of a surface and its smooth base.
    ///
    /// Creates a region without vertices.
    ///
    /// positions: [vertexCount x 3] of float or double: positions of the mesh or of a pose. A morph of weight 0
    ///     writes the same bits. null: the positions of the mesh, to 1e-15 of the box. The call copies the array
    /// @base: Base. If the surface has no factor for it yet, it is made now
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Region : Recorded
    {
        Region() { }

        /// <summary>Creates a region without vertices.
        ///
        /// positions: [vertexCount x 3] of float or double: positions of the mesh or of a pose. A morph of weight 0
        ///     writes the same bits. null: the positions of the mesh, to 1e-15 of the box. The call copies the
        ///     array
        /// @base: Base. If the surface has no factor for it yet, it is made now
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_NOT_POSITIVE_DEFINITE.</summary>
        public Region(Surface surface, Reals positions = null, Base @base = default(Base), Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_region_desc { struct_size = (uint)sizeof(hf_region_desc), @base = (int)@base };
                hf_region_desc* desc = &descStruct;
                desc->positions = c.View(positions?.Values, "positions", "vertex_count", "3");
                desc->progress = c.Handle(progress);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_region_create(c.Handle(surface), desc, raw)));
                Own(*raw, Functions.hf_region_destroy, c, "vertex_count");
            }
        }

        /// <summary>Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo,
        /// keep copies: one before each edit.</summary>
        public Region Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_region_clone(RawHandle, raw));
                var made = new Region();
                made.Own(*raw, Functions.hf_region_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Changes the region and computes its new base. The vertices next to the region (its rim) are sites with
        /// their positions as values. Sites that stay cost nothing; the others are one batch as in
        /// Solver.EditSites. One backward sweep over the factor then gives the base; for a small region the sweep
        /// covers only the part of the factor that its vertices need. A region may have several pieces, in several
        /// components. Progress covers curve, sites and base; the call can be cancelled between them.
        ///
        /// removeVertices: [removeCount] vertices that leave the region; others are passed over
        /// addVertices: [addCount] vertices that join it; those in it already are passed over
        /// ringCount: rings of vertices by which the region grows; below 0 it shrinks
        /// curve: the region becomes what this curve encloses
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public void Edit(uint[] removeVertices = null, uint[] addVertices = null, int ringCount = 0,
                CurveDesc curve = null, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_region_edit_desc { struct_size = (uint)sizeof(hf_region_edit_desc),
                    ring_count = ringCount };
                hf_region_edit_desc* desc = &descStruct;
                desc->remove_vertices = (IntPtr)c.Array(removeVertices, "removeVertices", "remove_count");
                desc->add_vertices = (IntPtr)c.Array(addVertices, "addVertices", "add_count");
                desc->progress = c.Handle(progress);
                if (curve != null) desc->curve = curve.Fill(c, "curve.");
                desc->remove_count = (uint)c.Count("remove_count", 0);
                desc->add_count = (uint)c.Count("add_count", 0);
                HfException.Check(Functions.hf_region_edit(RawHandle, desc));
            }
        }

        /// <summary>Writes the info of a region.</summary>
        public RegionInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_region_info { struct_size = (uint)sizeof(hf_region_info) };
                    hf_region_info* info = &infoStruct;
                    HfException.Check(Functions.hf_region_get_info(RawHandle, info));
                    return new RegionInfo(info);
                }
            }
        }

        /// <summary>Writes the statistics of a region.</summary>
        public RegionStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_region_statistics { struct_size = (uint)sizeof(hf_region_statistics) };
                    hf_region_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_region_get_statistics(RawHandle, statistics));
                    return new RegionStatistics(statistics);
                }
            }
        }

        /// <summary>Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first
        /// copy.
        ///
        /// list: RegionList.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT.</summary>
        public uint[] Vertices(RegionList list = default(RegionList))
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allVertices = null;
                c.Room("capacity", "hf_region_get_vertices.capacity");
                int result;
                do
                {
                        void* verticesPlace = (void*)c.Make(out allVertices, "capacity");
                        result = Functions.hf_region_get_vertices(RawHandle, (int)list, (uint)c.Size("capacity"),
                            verticesPlace, &count);
                }
                while (c.Again("hf_region_get_vertices", result, ("capacity", count)));
                return c.Cut(allVertices, "capacity");
            }
        }

        /// <summary>Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of the
        /// positions in RegionDesc. The last corner is joined to the first. Rings, added and removed vertices leave
        /// it as it is.</summary>
        public double[] Curve()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                double[] allPoints = null;
                c.Room("capacity", "hf_region_get_curve.capacity");
                int result;
                do
                {
                        void* pointsPlace = (void*)c.Make(out allPoints, "capacity", "3");
                        result = Functions.hf_region_get_curve(RawHandle, (uint)c.Size("capacity"), pointsPlace,
                            &count);
                }
                while (c.Again("hf_region_get_curve", result, ("capacity", count)));
                return c.Cut(allPoints, "capacity", "3");
            }
        }

        /// <summary>Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
        /// RegionDesc. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A
        /// weight below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p.
        /// The call solves nothing.
        ///
        /// weight: any finite number
        /// @out: [vertexCount x 3] of float or double, in the unit of the mesh
        /// normals: [vertexCount x 3] of float or double: unit normals of the morphed surface, shared across seams
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public float[] Morph(double weight = 0, Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                var @out = new float[c.Product("vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_region_morph(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Morph, into an array of yours.</summary>
        public void Morph(Span<float> into, Span<float> normals = default(Span<float>), double weight = 0)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_region_morph(RawHandle, desc));
                    }
                }
            }
        }

        /// <summary>As Morph, in double precision.</summary>
        public double[] MorphDouble(double weight = 0, Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                var @out = new double[c.Product("vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_region_morph(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Morph, into an array of yours.</summary>
        public void Morph(Span<double> into, Span<float> normals = default(Span<float>), double weight = 0)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_region_morph(RawHandle, desc));
                    }
                }
            }
        }

        internal override Recorded State() { return Clone(); }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>The detail of a source region, transferred to a target region. Both may be on one surface or on two.
    ///
    /// Carries the detail of the source region to the target region. A harmonic map with positive weights takes
    /// each region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim)
    /// lie on the circle, by arc length between the pairs of desc. Points at the same place in the disc correspond.
    /// The function stores the offset from base to surface in a local frame of the source. The axes of the frame
    /// are the normal of the base and the direction in which the first disc coordinate grows. It interpolates the
    /// offsets in the triangles of the source, and applies them in the same frames of the target. The detail fades
    /// to nothing at the rim. If source and target are the same region, the result is the surface itself. Later
    /// edits of the regions do not change the object.
    ///
    /// Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
    ///
    /// sourceVertices: [pairCount] rim vertices of the source mesh
    /// targetVertices: [pairCount] rim vertices of the target mesh
    /// scale: of the detail, &gt; 0; 0 = square root of target base area over source base area
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Detail : HfObject
    {
        /// <summary>Carries the detail of the source region to the target region. A harmonic map with positive weights takes
        /// each region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its
        /// rim) lie on the circle, by arc length between the pairs of desc. Points at the same place in the disc
        /// correspond. The function stores the offset from base to surface in a local frame of the source. The axes
        /// of the frame are the normal of the base and the direction in which the first disc coordinate grows. It
        /// interpolates the offsets in the triangles of the source, and applies them in the same frames of the
        /// target. The detail fades to nothing at the rim. If source and target are the same region, the result is
        /// the surface itself. Later edits of the regions do not change the object.
        ///
        /// Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
        ///
        /// sourceVertices: [pairCount] rim vertices of the source mesh
        /// targetVertices: [pairCount] rim vertices of the target mesh
        /// scale: of the detail, &gt; 0; 0 = square root of target base area over source base area
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public Detail(Region source, Region target, uint[] sourceVertices = null, uint[] targetVertices = null,
                double scale = 0, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("source.", source);
                c.Parent("target.", target);
                var descStruct = new hf_detail_desc { struct_size = (uint)sizeof(hf_detail_desc), scale = scale };
                hf_detail_desc* desc = &descStruct;
                desc->source_vertices = (IntPtr)c.Array(sourceVertices, "sourceVertices", "pair_count");
                desc->target_vertices = (IntPtr)c.Array(targetVertices, "targetVertices", "pair_count");
                desc->progress = c.Handle(progress);
                desc->pair_count = (uint)c.Count("pair_count", 0);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_detail_create(c.Handle(source), c.Handle(target),
                    desc, raw)));
                Own(*raw, Functions.hf_detail_destroy, c, "vertex_count");
            }
        }

        /// <summary>Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight
        /// (transferred detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the
        /// detail as it was on the source. A weight above 1 exaggerates the detail, and a weight below 0 turns it
        /// inside out.
        ///
        /// weight: any finite number
        /// @out: [vertexCount x 3] of float or double, in the unit of the mesh
        /// normals: [vertexCount x 3] of float or double: unit normals of the morphed surface, shared across seams
        ///
        /// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public float[] Morph(double weight = 0, Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                var @out = new float[c.Product("vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_detail_morph(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Morph, into an array of yours.</summary>
        public void Morph(Span<float> into, Span<float> normals = default(Span<float>), double weight = 0)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, false, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_detail_morph(RawHandle, desc));
                    }
                }
            }
        }

        /// <summary>As Morph, in double precision.</summary>
        public double[] MorphDouble(double weight = 0, Span<float> normals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                var @out = new double[c.Product("vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                if (!normals.IsEmpty)
                    c.Need(normals.Length, "normals", "vertex_count", "3");
                fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                {
                    desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                    HfException.Check(Functions.hf_detail_morph(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Morph, into an array of yours.</summary>
        public void Morph(Span<double> into, Span<float> normals = default(Span<float>), double weight = 0)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc), weight = weight };
                hf_morph_desc* desc = &descStruct;
                c.Need(into.Length, "into", "vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->positions = Call.Out(@outPlace, true, c.Size("vertex_count"));
                    if (!normals.IsEmpty)
                        c.Need(normals.Length, "normals", "vertex_count", "3");
                    fixed (float* normalsPlace = &MemoryMarshal.GetReference(normals))
                    {
                        desc->normals = Call.Out(normalsPlace, false, c.Size("vertex_count"));
                        HfException.Check(Functions.hf_detail_morph(RawHandle, desc));
                    }
                }
            }
        }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>The motion of one skeleton on another.
    ///
    /// Pairs the joints of two skeletons.
    ///
    /// sourceRest: [source.jointCount x 10] a pose that counts as rest, or null: the rest of the skeleton. Give
    ///     poses in which both characters stand alike
    /// targetRest: [target.jointCount x 10] the same for the target, or null
    /// rootMotion: RootMotion
    /// leaveOut: bits of RetargetStep
    /// scale: travel of the target over travel of the source; 0: the ratio of leg lengths
    /// groundVelocity: of the ground under a clip on the spot, in the space of the source, per second; 0: the
    ///     ground rests. Skeleton.GroundVelocity finds it
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Retarget : Recorded
    {
        Retarget() { }

        /// <summary>Pairs the joints of two skeletons.
        ///
        /// sourceRest: [source.jointCount x 10] a pose that counts as rest, or null: the rest of the skeleton. Give
        ///     poses in which both characters stand alike
        /// targetRest: [target.jointCount x 10] the same for the target, or null
        /// rootMotion: RootMotion
        /// leaveOut: bits of RetargetStep
        /// scale: travel of the target over travel of the source; 0: the ratio of leg lengths
        /// groundVelocity: of the ground under a clip on the spot, in the space of the source, per second; 0: the
        ///     ground rests. Skeleton.GroundVelocity finds it
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public Retarget(Skeleton source, Skeleton target, float[] sourceRest = null, float[] targetRest = null,
                RootMotion rootMotion = default(RootMotion), uint leaveOut = 0, double scale = 0,
                double[] groundVelocity = null, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("source.", source);
                c.Parent("target.", target);
                var descStruct = new hf_retarget_desc { struct_size = (uint)sizeof(hf_retarget_desc),
                    root_motion = (int)rootMotion, leave_out = leaveOut, scale = scale };
                hf_retarget_desc* desc = &descStruct;
                desc->source_rest = (IntPtr)c.Array(sourceRest, "sourceRest", "source.joint_count", "10");
                desc->target_rest = (IntPtr)c.Array(targetRest, "targetRest", "target.joint_count", "10");
                c.Fit(groundVelocity, "groundVelocity", "3");
                for (int i = 0; groundVelocity != null && i < groundVelocity.Length; ++i) desc->ground_velocity[i] = groundVelocity[i];
                desc->progress = c.Handle(progress);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_retarget_create(c.Handle(source), c.Handle(target),
                    desc, raw)));
                Own(*raw, Functions.hf_retarget_destroy, c, "joint_count");
            }
        }

        /// <summary>Copies a retarget with the state of its feet: for another character with the same skeletons, and for
        /// undo.</summary>
        public Retarget Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_retarget_clone(RawHandle, raw));
                var made = new Retarget();
                made.Own(*raw, Functions.hf_retarget_destroy, c, "joint_count");
                return made;
            }
        }

        /// <summary>Computes the pose of the target. The frame depends on the source pose and on the state of the feet:
        /// whether each is planted, and how far it is moved to keep its place. The state comes from the frames
        /// since the last reset and fades within a step.
        ///
        /// sourcePose: [source.jointCount x 10].
        /// seconds: time since the last frame, 0 for the first frame and for a repeated frame.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public float[] Solve(float[] sourcePose, double seconds = 0)
        {
            using (var c = new Call(this))
            {
                void* sourcePose_ = c.Array(sourcePose, "sourcePose", "source.joint_count", "10");
                var targetPose = new float[c.Product("target.joint_count", "10")];
                var targetPosePlace = (float*)c.Pin(targetPose);
                HfException.Check(Functions.hf_retarget_solve(RawHandle, sourcePose_, seconds, targetPosePlace));
                return targetPose;
            }
        }

        /// <summary>Forgets the state of the feet and the figures of the info. Call it where the clip jumps.</summary>
        public void Reset()
        {
            using (var c = new Call(this))
            {
                HfException.Check(Functions.hf_retarget_reset(RawHandle));
            }
        }

        /// <summary>Writes the figures.</summary>
        public RetargetInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_retarget_info { struct_size = (uint)sizeof(hf_retarget_info) };
                    hf_retarget_info* info = &infoStruct;
                    HfException.Check(Functions.hf_retarget_get_info(RawHandle, info));
                    return new RetargetInfo(info);
                }
            }
        }

        /// <summary>Writes how chains follow.</summary>
        public ChainMatch[] Chains()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* chainsPlace = null;
                c.Room("capacity", "hf_retarget_get_chains.capacity");
                int result;
                do
                {
                        chainsPlace = c.Rows(sizeof(hf_chain_match), "capacity");
                        result = Functions.hf_retarget_get_chains(RawHandle, (uint)c.Size("capacity"), chainsPlace,
                            &count);
                }
                while (c.Again("hf_retarget_get_chains", result, ("capacity", count)));
                var chains = new ChainMatch[c.Product("capacity")];
                for (int i = 0; i < chains.Length; ++i)
                    chains[i] = new ChainMatch((hf_chain_match*)chainsPlace + i);
                return chains;
            }
        }

        /// <summary>Writes which joint of the source each joint of the target follows. A joint between two gets the nearer,
        /// a joint without a partner uint.MaxValue.</summary>
        public uint[] Partners()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allPartners = null;
                c.Room("capacity", "hf_retarget_get_partners.capacity");
                int result;
                do
                {
                        void* partnersPlace = (void*)c.Make(out allPartners, "capacity");
                        result = Functions.hf_retarget_get_partners(RawHandle, (uint)c.Size("capacity"), partnersPlace,
                            &count);
                }
                while (c.Again("hf_retarget_get_partners", result, ("capacity", count)));
                return c.Cut(allPartners, "capacity");
            }
        }

        internal override Recorded State() { return Clone(); }

        /// <summary>As it was made with.</summary>
        public int JointCount { get { return Known("joint_count"); } }
    }

    /// <summary>A skeleton at rest and the findings about it. Calls read the object, none changes it.
    ///
    /// Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it
    /// if feet shall stand on the ground. The object keeps a copy of everything.
    ///
    /// names: one line for each joint in UTF-8, or null: names then say nothing
    /// parents: [jointCount] number of the parent, uint.MaxValue for a root
    /// rest: [jointCount x 10] joint transforms
    /// inverseBinds: [jointCount x 16] inverse bind matrices, columns first. All zero: no skin names the joint; it
    ///     moves its children and rigid meshes only. null: the skin is given in the pose `rest`, and every joint
    ///     can bend it
    /// up: [3] declared axis, any length, or null: find it
    /// forward: [3] declared axis, any length, or null: find it
    /// roles: [jointCount] declared Role, -1 for a joint without; or null
    /// sides: [jointCount] BodySide of joints with a declared role; or null: find the sides
    /// travels: [travelCount x 3] where each clip leads from its first to its last frame; it tells forward; or null
    /// skin: null: there is none, and joints are judged by names and places alone
    /// progress: an object to poll and cancel through</summary>
    public sealed unsafe class Skeleton : HfObject
    {
        /// <summary>Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a
        /// walk. It is 0 for a clip that travels.
        ///
        /// poses: [frameCount x jointCount x 10].
        /// seconds: between two frames, above 0.
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public double[] GroundVelocity(float[] poses, double seconds)
        {
            using (var c = new Call(this))
            {
                void* poses_ = c.Array(poses, "poses", "frame_count", "joint_count", "10");
                var velocity = new double[c.Product("3")];
                var velocityPlace = (double*)c.Pin(velocity);
                HfException.Check(Functions.hf_skeleton_get_ground_velocity(RawHandle, (uint)c.Count("frame_count", 1),
                    poses_, seconds, velocityPlace));
                return velocity;
            }
        }

        /// <summary>Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give
        /// it if feet shall stand on the ground. The object keeps a copy of everything.
        ///
        /// names: one line for each joint in UTF-8, or null: names then say nothing
        /// parents: [jointCount] number of the parent, uint.MaxValue for a root
        /// rest: [jointCount x 10] joint transforms
        /// inverseBinds: [jointCount x 16] inverse bind matrices, columns first. All zero: no skin names the joint;
        ///     it moves its children and rigid meshes only. null: the skin is given in the pose `rest`, and every
        ///     joint can bend it
        /// up: [3] declared axis, any length, or null: find it
        /// forward: [3] declared axis, any length, or null: find it
        /// roles: [jointCount] declared Role, -1 for a joint without; or null
        /// sides: [jointCount] BodySide of joints with a declared role; or null: find the sides
        /// travels: [travelCount x 3] where each clip leads from its first to its last frame; it tells forward; or
        ///     null
        /// skin: null: there is none, and joints are judged by names and places alone
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public Skeleton(string[] names = null, uint[] parents = null, float[] rest = null, float[] inverseBinds = null,
                float[] up = null, float[] forward = null, int[] roles = null, int[] sides = null,
                float[] travels = null, SkinDesc skin = null, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                var descStruct = new hf_skeleton_desc { struct_size = (uint)sizeof(hf_skeleton_desc) };
                hf_skeleton_desc* desc = &descStruct;
                desc->parents = (IntPtr)c.Array(parents, "parents", "joint_count");
                desc->rest = (IntPtr)c.Array(rest, "rest", "joint_count", "10");
                desc->inverse_binds = (IntPtr)c.Array(inverseBinds, "inverseBinds", "joint_count", "16");
                desc->up = (IntPtr)c.Array(up, "up", "3");
                desc->forward = (IntPtr)c.Array(forward, "forward", "3");
                desc->roles = (IntPtr)c.Array(roles, "roles", "joint_count");
                desc->sides = (IntPtr)c.Array(sides, "sides", "joint_count");
                desc->travels = (IntPtr)c.Array(travels, "travels", "travel_count", "3");
                desc->names = (IntPtr)c.Text(names);
                desc->progress = c.Handle(progress);
                if (skin != null) desc->skin = skin.Fill(c, "skin.");
                desc->joint_count = (uint)c.Count("joint_count", 0);
                desc->travel_count = (uint)c.Count("travel_count", 0);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_skeleton_create(desc, raw)));
                Own(*raw, Functions.hf_skeleton_destroy, c, "joint_count");
            }
        }

        /// <summary>Writes the findings.</summary>
        public SkeletonInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_skeleton_info { struct_size = (uint)sizeof(hf_skeleton_info) };
                    hf_skeleton_info* info = &infoStruct;
                    HfException.Check(Functions.hf_skeleton_get_info(RawHandle, info));
                    return new SkeletonInfo(info);
                }
            }
        }

        /// <summary>Writes one entry for each joint.</summary>
        public JointInfo[] Joints()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* jointsPlace = null;
                c.Room("capacity", "hf_skeleton_get_joints.capacity");
                int result;
                do
                {
                        jointsPlace = c.Rows(sizeof(hf_joint_info), "capacity");
                        result = Functions.hf_skeleton_get_joints(RawHandle, (uint)c.Size("capacity"), jointsPlace,
                            &count);
                }
                while (c.Again("hf_skeleton_get_joints", result, ("capacity", count)));
                var joints = new JointInfo[c.Product("capacity")];
                for (int i = 0; i < joints.Length; ++i)
                    joints[i] = new JointInfo((hf_joint_info*)jointsPlace + i);
                return joints;
            }
        }

        /// <summary>Writes the chains.</summary>
        public Chain[] Chains()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                void* chainsPlace = null;
                c.Room("capacity", "hf_skeleton_get_chains.capacity");
                int result;
                do
                {
                        chainsPlace = c.Rows(sizeof(hf_chain), "capacity");
                        result = Functions.hf_skeleton_get_chains(RawHandle, (uint)c.Size("capacity"), chainsPlace,
                            &count);
                }
                while (c.Again("hf_skeleton_get_chains", result, ("capacity", count)));
                var chains = new Chain[c.Product("capacity")];
                for (int i = 0; i < chains.Length; ++i)
                    chains[i] = new Chain((hf_chain*)chainsPlace + i);
                return chains;
            }
        }

        /// <summary>Writes the joints of chain after chain.</summary>
        public uint[] ChainJoints()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allJoints = null;
                c.Room("capacity", "hf_skeleton_get_chain_joints.capacity");
                int result;
                do
                {
                        void* jointsPlace = (void*)c.Make(out allJoints, "capacity");
                        result = Functions.hf_skeleton_get_chain_joints(RawHandle, (uint)c.Size("capacity"),
                            jointsPlace, &count);
                }
                while (c.Again("hf_skeleton_get_chain_joints", result, ("capacity", count)));
                return c.Cut(allJoints, "capacity");
            }
        }

        /// <summary>Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one
        /// line.</summary>
        public string Reasons()
        {
            using (var c = new Call(this))
            {
                UIntPtr size = UIntPtr.Zero;
                HfException.Check(Functions.hf_skeleton_get_reasons(RawHandle, (UIntPtr)0, null, &size));
                var block = new byte[(int)size];
                HfException.Check(Functions.hf_skeleton_get_reasons(RawHandle, (UIntPtr)block.Length,
                    (void*)c.Pin(block), &size));
                return System.Text.Encoding.UTF8.GetString(block, 0, Math.Max(block.Length - 1, 0));
            }
        }

        /// <summary>As it was made with.</summary>
        public int JointCount { get { return Known("joint_count"); } }
    }

    /// <summary>hf/transfer.h - play the motion of one surface on another.
    ///
    /// You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get
    /// the same harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place
    /// form a cluster. The target takes over the rotations of the source's clusters. Its translations follow from
    /// its own shape (Xu, Zhang, Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn
    /// about one another. A limb whose parts reach farther than the source's turns less, so that it moves as far: a
    /// held sword, a long tail, a large head. The dial long_follow gives it the whole turn.
    ///
    /// Creates a transfer between two surfaces; both may be the same.
    ///
    /// sourceRest: [source.vertexCount x 3] of float or double Poses in which the two bodies correspond, in each
    ///     surface's unit. null: the positions of the surface. Give a standing pose here for a character bound in a
    ///     crouch. Motion is measured from these poses. They do not change the fields.
    /// targetRest: [target.vertexCount x 3] of float or double
    /// mode: TransferMode
    /// clusterCount: 1 to 512. 0 = the larger of 80 and 5 per pair
    /// ground: Ground
    /// kernelWidth: width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per pair,
    ///     up to 0.12
    /// scale: lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes
    ///     when no pair is a foot
    /// alignmentAngle: A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6
    ///     times the angle it is not aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative =
    ///     never.
    /// sourceAxes: Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y,
    ///     forward +z). Lengths, and right x up = forward, must hold within 1e-3. The library takes the nearest
    ///     rotation.</summary>
    public sealed unsafe class Transfer : HfObject
    {
        /// <summary>Creates a transfer between two surfaces; both may be the same.
        ///
        /// sourceRest: [source.vertexCount x 3] of float or double Poses in which the two bodies correspond, in
        ///     each surface's unit. null: the positions of the surface. Give a standing pose here for a character
        ///     bound in a crouch. Motion is measured from these poses. They do not change the fields.
        /// targetRest: [target.vertexCount x 3] of float or double
        /// mode: TransferMode
        /// clusterCount: 1 to 512. 0 = the larger of 80 and 5 per pair
        /// ground: Ground
        /// kernelWidth: width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per
        ///     pair, up to 0.12
        /// scale: lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the
        ///     boxes when no pair is a foot
        /// alignmentAngle: A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6
        ///     times the angle it is not aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative =
        ///     never.
        /// sourceAxes: Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y,
        ///     forward +z). Lengths, and right x up = forward, must hold within 1e-3. The library takes the nearest
        ///     rotation.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_INVALID_OBJECT, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.</summary>
        public Transfer(Surface source, Surface target, Reals sourceRest = null, Reals targetRest = null,
                TransferMode mode = default(TransferMode), uint clusterCount = 0, Ground ground = default(Ground),
                double kernelWidth = 0, double scale = 0, double alignmentAngle = 0, double[] sourceAxes = null,
                double[] targetAxes = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("source.", source);
                c.Parent("target.", target);
                var descStruct = new hf_transfer_desc { struct_size = (uint)sizeof(hf_transfer_desc), mode = (int)mode,
                    cluster_count = clusterCount, ground = (int)ground, kernel_width = kernelWidth, scale = scale,
                    alignment_angle = alignmentAngle };
                hf_transfer_desc* desc = &descStruct;
                desc->source_rest = c.View(sourceRest?.Values, "sourceRest", "source.vertex_count", "3");
                desc->target_rest = c.View(targetRest?.Values, "targetRest", "target.vertex_count", "3");
                c.Fit(sourceAxes, "sourceAxes", "9");
                for (int i = 0; sourceAxes != null && i < sourceAxes.Length; ++i) desc->source_axes[i] = sourceAxes[i];
                c.Fit(targetAxes, "targetAxes", "9");
                for (int i = 0; targetAxes != null && i < targetAxes.Length; ++i) desc->target_axes[i] = targetAxes[i];
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_transfer_create(c.Handle(source), c.Handle(target),
                    desc, raw)));
                Own(*raw, Functions.hf_transfer_destroy, c, "vertex_count");
            }
        }

        /// <summary>Adds pairs.
        ///
        /// sourceVertices: lists of whole numbers: all regions one after the other; vertices of your mesh, up to 4
        ///     entries per vertex
        /// targetVertices: lists of whole numbers:
        /// flags: [pairCount] PairFlag, or null for none
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public uint[] AddPairs(uint[][] sourceVertices = null, uint[][] targetVertices = null, uint[] flags = null,
                Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_pairs_desc { struct_size = (uint)sizeof(hf_pairs_desc) };
                hf_pairs_desc* desc = &descStruct;
                c.Lists(sourceVertices, "sourceVertices", "pair_count", out desc->source_counts,
                    out desc->source_vertices);
                c.Lists(targetVertices, "targetVertices", "pair_count", out desc->target_counts,
                    out desc->target_vertices);
                desc->flags = (IntPtr)c.Array(flags, "flags", "pair_count");
                desc->progress = c.Handle(progress);
                desc->pair_count = (uint)c.Count("pair_count", 1);
                var pairs = new uint[c.Product("pair_count")];
                var pairsPlace = (uint*)c.Pin(pairs);
                HfException.Check(Functions.hf_transfer_add_pairs(RawHandle, desc, pairsPlace));
                return pairs;
            }
        }

        /// <summary>Removes pairs by number.
        ///
        /// pairs: [pairCount].
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public void RemovePairs(uint[] pairs)
        {
            using (var c = new Call(this))
            {
                void* pairs_ = c.Array(pairs, "pairs", "pair_count");
                HfException.Check(Functions.hf_transfer_remove_pairs(RawHandle, (uint)c.Count("pair_count", 1),
                    pairs_));
            }
        }

        /// <summary>Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
        /// Transfer.Apply has done so. This changes no result.
        ///
        /// Throws HF_ERROR_NOT_FOUND.</summary>
        public PairInfo Pair(uint pair)
        {
            using (var c = new Call(this))
            {
                var infoStruct = new hf_pair_info { struct_size = (uint)sizeof(hf_pair_info) };
                hf_pair_info* info = &infoStruct;
                HfException.Check(Functions.hf_transfer_get_pair(RawHandle, pair, info));
                return new PairInfo(info);
            }
        }

        /// <summary>Writes the info of the whole transfer. The first call after a change of pairs solves fields, as
        /// Transfer.Pair does.
        ///
        /// Throws HF_ERROR_EMPTY.</summary>
        public TransferInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_transfer_info { struct_size = (uint)sizeof(hf_transfer_info) };
                    hf_transfer_info* info = &infoStruct;
                    HfException.Check(Functions.hf_transfer_get_info(RawHandle, info));
                    return new TransferInfo(info);
                }
            }
        }

        /// <summary>Writes the statistics of a transfer.</summary>
        public TransferStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_transfer_statistics { struct_size = (uint)sizeof(hf_transfer_statistics) };
                    hf_transfer_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_transfer_get_statistics(RawHandle, statistics));
                    return new TransferStatistics(statistics);
                }
            }
        }

        /// <summary>Sets the dials of a transfer for the next frames.
        ///
        /// stride: the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A
        ///     planted foot does not slide. The body travels as much farther
        /// hipHeightShare: raises the pairs flagged PairFlag.Trunk and PairFlag.Anchor by this share of their mean
        ///     height at rest, -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not
        ///     raised
        /// neckFollow: pairs flagged PairFlag.Neck, together one limb How far a limb follows the source, -1 to 1.
        ///     At 0 (neutral) the limb plays the source's motion from its own rest direction. At 1 it also gets the
        ///     rest direction of the source's limb. At -1 it does not move against its root.
        /// tailFollow: pairs flagged PairFlag.Tail, together one limb
        /// armSpace: turns arms (PairFlag.Arm) away from the body, about the forward axis at rest, -pi/2 to pi/2
        ///     radians; 0 = neutral
        /// longFollow: how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn
        ///     less, so that they move as far. 1: they make the whole turn. Between, a part may jump that turns by
        ///     half a turn against the part before it
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.</summary>
        public void SetDials(double stride = 0, double hipHeightShare = 0, double neckFollow = 0, double tailFollow = 0,
                double armSpace = 0, double longFollow = 0)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_transfer_dials { struct_size = (uint)sizeof(hf_transfer_dials), stride = stride,
                    hip_height_share = hipHeightShare, neck_follow = neckFollow, tail_follow = tailFollow,
                    arm_space = armSpace, long_follow = longFollow };
                hf_transfer_dials* desc = &descStruct;
                HfException.Check(Functions.hf_transfer_set_dials(RawHandle, desc));
            }
        }

        /// <summary>Writes the dials; stride is never 0.</summary>
        public TransferDials Dials
        {
            get
            {
                using (var c = new Call(this))
                {
                    var dialsStruct = new hf_transfer_dials { struct_size = (uint)sizeof(hf_transfer_dials) };
                    hf_transfer_dials* dials = &dialsStruct;
                    HfException.Check(Functions.hf_transfer_get_dials(RawHandle, dials));
                    return new TransferDials(dials);
                }
            }
        }

        /// <summary>Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh.
        /// Each frame moves a rigid piece by the rigid motion that fits the piece best, as Pose.SetRigidPieces
        /// does. This fit is the last step of a frame. So a hold on a part of a rigid piece may miss its position,
        /// and a rigid piece may sink into the ground.
        ///
        /// vertices: [vertexCount], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid.
        ///     The list replaces the previous list and applies from the next frame on. The call does not factorise.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public void SetRigidPieces(uint[] vertices)
        {
            using (var c = new Call(this))
            {
                c.Sizes.Remove("vertex_count");  // of the list given here
                void* vertices_ = c.Array(vertices, "vertices", "vertex_count");
                HfException.Check(Functions.hf_transfer_set_rigid_pieces(RawHandle, (uint)c.Count("vertex_count", 1),
                    vertices_));
            }
        }

        /// <summary>Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest
        /// directions differ much on the two surfaces (PairInfo), it takes the direction of the source's limb
        /// instead, by a share.
        ///
        /// The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc
        /// alone. Removed pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the
        /// same frames, bit for bit. The result changes as little as the source does: a source that stands still
        /// except for noise gives a target that stands still.
        ///
        /// The ground counts too if the mode is TransferMode.Fields and some pairs are anchors (their target region
        /// follows the path of the source's region). While a foot of the source stands on the ground, the target's
        /// foot follows its scaled path exactly. No vertex of the target sinks deeper into the ground than the
        /// source, scaled, except the vertices of Transfer.Sinking. A part that would sink bends up. The ground
        /// does not move regions that you hold. A lying target rests on the parts that the source rests on. A rigid
        /// motion of the whole source is copied unchanged. All rules of the ground come in continuously. The ground
        /// is under the feet of each body at rest, and what hangs lower is none: a cape, a tail, scenery. Without
        /// feet, or where the trunk is below them, it is the lowest vertex. Ground.Off switches it off.
        ///
        /// sourcePositions: [source.vertexCount x 3] of float or double: the posed source, its own vertex order
        /// holdPairs: [holdCount] each pair at most once A hold puts the target region of a pair exactly at a
        ///     position of yours, such as a foot on a step or a hand on a rail. The mean of the region's vertices
        ///     lands there; welded copies count once. The rest of the surface follows.
        /// holdPositions: [holdCount x 3] in the target's unit and frame
        /// @out: [target.vertexCount x 3] of float or double
        /// targetNormals: [target.vertexCount x 3] of float or double
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND,
        /// HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.</summary>
        public float[] Apply(Reals sourcePositions = null, uint[] holdPairs = null, double[] holdPositions = null,
                Span<float> targetNormals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
                hf_transfer_frame* desc = &descStruct;
                desc->source_positions = c.View(sourcePositions?.Values, "sourcePositions", "source.vertex_count", "3");
                desc->hold_pairs = (IntPtr)c.Array(holdPairs, "holdPairs", "hold_count");
                desc->hold_positions = (IntPtr)c.Array(holdPositions, "holdPositions", "hold_count", "3");
                desc->hold_count = (uint)c.Count("hold_count", 0);
                var @out = new float[c.Product("target.vertex_count", "3")];
                var @outPlace = (float*)c.Pin(@out);
                desc->target_positions = Call.Out(@outPlace, false, c.Size("target.vertex_count"));
                if (!targetNormals.IsEmpty)
                    c.Need(targetNormals.Length, "targetNormals", "target.vertex_count", "3");
                fixed (float* targetNormalsPlace = &MemoryMarshal.GetReference(targetNormals))
                {
                    desc->target_normals = Call.Out(targetNormalsPlace, false, c.Size("target.vertex_count"));
                    HfException.Check(Functions.hf_transfer_apply(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Apply, into an array of yours.</summary>
        public void Apply(Span<float> into, Span<float> targetNormals = default(Span<float>),
                Reals sourcePositions = null, uint[] holdPairs = null, double[] holdPositions = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
                hf_transfer_frame* desc = &descStruct;
                desc->source_positions = c.View(sourcePositions?.Values, "sourcePositions", "source.vertex_count", "3");
                desc->hold_pairs = (IntPtr)c.Array(holdPairs, "holdPairs", "hold_count");
                desc->hold_positions = (IntPtr)c.Array(holdPositions, "holdPositions", "hold_count", "3");
                desc->hold_count = (uint)c.Count("hold_count", 0);
                c.Need(into.Length, "into", "target.vertex_count", "3");
                fixed (float* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->target_positions = Call.Out(@outPlace, false, c.Size("target.vertex_count"));
                    if (!targetNormals.IsEmpty)
                        c.Need(targetNormals.Length, "targetNormals", "target.vertex_count", "3");
                    fixed (float* targetNormalsPlace = &MemoryMarshal.GetReference(targetNormals))
                    {
                        desc->target_normals = Call.Out(targetNormalsPlace, false, c.Size("target.vertex_count"));
                        HfException.Check(Functions.hf_transfer_apply(RawHandle, desc));
                    }
                }
            }
        }

        /// <summary>As Apply, in double precision.</summary>
        public double[] ApplyDouble(Reals sourcePositions = null, uint[] holdPairs = null,
                double[] holdPositions = null, Span<float> targetNormals = default(Span<float>))
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
                hf_transfer_frame* desc = &descStruct;
                desc->source_positions = c.View(sourcePositions?.Values, "sourcePositions", "source.vertex_count", "3");
                desc->hold_pairs = (IntPtr)c.Array(holdPairs, "holdPairs", "hold_count");
                desc->hold_positions = (IntPtr)c.Array(holdPositions, "holdPositions", "hold_count", "3");
                desc->hold_count = (uint)c.Count("hold_count", 0);
                var @out = new double[c.Product("target.vertex_count", "3")];
                var @outPlace = (double*)c.Pin(@out);
                desc->target_positions = Call.Out(@outPlace, true, c.Size("target.vertex_count"));
                if (!targetNormals.IsEmpty)
                    c.Need(targetNormals.Length, "targetNormals", "target.vertex_count", "3");
                fixed (float* targetNormalsPlace = &MemoryMarshal.GetReference(targetNormals))
                {
                    desc->target_normals = Call.Out(targetNormalsPlace, false, c.Size("target.vertex_count"));
                    HfException.Check(Functions.hf_transfer_apply(RawHandle, desc));
                    return @out;
                }
            }
        }

        /// <summary>As Apply, into an array of yours.</summary>
        public void Apply(Span<double> into, Span<float> targetNormals = default(Span<float>),
                Reals sourcePositions = null, uint[] holdPairs = null, double[] holdPositions = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
                hf_transfer_frame* desc = &descStruct;
                desc->source_positions = c.View(sourcePositions?.Values, "sourcePositions", "source.vertex_count", "3");
                desc->hold_pairs = (IntPtr)c.Array(holdPairs, "holdPairs", "hold_count");
                desc->hold_positions = (IntPtr)c.Array(holdPositions, "holdPositions", "hold_count", "3");
                desc->hold_count = (uint)c.Count("hold_count", 0);
                c.Need(into.Length, "into", "target.vertex_count", "3");
                fixed (double* @outPlace = &MemoryMarshal.GetReference(into))
                {
                    desc->target_positions = Call.Out(@outPlace, true, c.Size("target.vertex_count"));
                    if (!targetNormals.IsEmpty)
                        c.Need(targetNormals.Length, "targetNormals", "target.vertex_count", "3");
                    fixed (float* targetNormalsPlace = &MemoryMarshal.GetReference(targetNormals))
                    {
                        desc->target_normals = Call.Out(targetNormalsPlace, false, c.Size("target.vertex_count"));
                        HfException.Check(Functions.hf_transfer_apply(RawHandle, desc));
                    }
                }
            }
        }

        /// <summary>Writes which target vertices may sink into the ground.
        ///
        /// Throws HF_ERROR_EMPTY.</summary>
        public byte[] Sinking()
        {
            using (var c = new Call(this))
            {
                var sinking = new byte[c.Product("target.vertex_count")];
                var sinkingPlace = (byte*)c.Pin(sinking);
                HfException.Check(Functions.hf_transfer_get_sinking(RawHandle, sinkingPlace));
                return sinking;
            }
        }

        /// <summary>Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the
        /// skin replays Transfer.Apply exactly, because that function also uses the four largest weights. Each
        /// rigid piece is one joint. These joints come after the joints of clusters.
        ///
        /// influenceCount: joints per vertex, 4 or 8; 0 = 4
        /// scales: [jointCapacity x 3] along the axes in the last frame; null = joints are rigid
        ///
        /// Throws HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.</summary>
        public SkinInfo Skin(uint influenceCount = 0, bool scales = false)
        {
            using (var c = new Call(this))
            {
                var skinStruct = new hf_skin_info { struct_size = (uint)sizeof(hf_skin_info),
                    influence_count = influenceCount };
                hf_skin_info* skin = &skinStruct;
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 4 : influenceCount, int.MaxValue);
                double[] allPivots = null;
                double[] allRotations = null;
                double[] allTranslations = null;
                double[] allAxes = null;
                double[] allScales = null;
                uint[] allVertexJoints = null;
                float[] allVertexWeights = null;
                c.Room("joint_capacity", "joint_count");
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        skin->joint_capacity = (uint)c.Size("joint_capacity");
                        skin->vertex_capacity = (uint)c.Size("vertex_capacity");
                        skin->pivots = c.Make(out allPivots, "joint_capacity", "3");
                        skin->rotations = c.Make(out allRotations, "joint_capacity", "4");
                        skin->translations = c.Make(out allTranslations, "joint_capacity", "3");
                        skin->axes = c.Make(out allAxes, "joint_capacity", "4");
                        skin->scales = scales ? c.Make(out allScales, "joint_capacity", "3") : IntPtr.Zero;
                        skin->vertex_joints = c.Make(out allVertexJoints, "vertex_capacity", "influence_count");
                        skin->vertex_weights = c.Make(out allVertexWeights, "vertex_capacity", "influence_count");
                        result = Functions.hf_transfer_get_skin(RawHandle, skin);
                }
                while (c.Again("hf_transfer_get_skin", result, ("joint_capacity", skin->joint_count),
                    ("vertex_capacity", skin->vertex_count)));
                return new SkinInfo { InfluenceCount = skin->influence_count, Pivots = c.Cut(allPivots,
                    "joint_capacity", "3"), Rotations = c.Cut(allRotations, "joint_capacity", "4"),
                    Translations = c.Cut(allTranslations, "joint_capacity", "3"), Axes = c.Cut(allAxes,
                    "joint_capacity", "4"), Scales = c.Cut(allScales, "joint_capacity", "3"),
                    VertexJoints = c.Cut(allVertexJoints, "vertex_capacity", "influence_count"),
                    VertexWeights = c.Cut(allVertexWeights, "vertex_capacity", "influence_count") };
            }
        }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }

    /// <summary>The weights of one surface for one skeleton.
    ///
    /// Computes weights.
    ///
    /// heads: [jointCount x 3]
    /// tails: [jointCount x 3], or null: heads are joints, and the library finds the tails
    /// axes: [jointCount x 3] with tails null: where each joint points, any length, a zero vector for unknown; or
    ///     null.      A joint reaches to the child that lies there, or to the end of the skin. A      child that
    ///     does      not deform says where a last joint ends
    /// parents: [jointCount] number of the parent, uint.MaxValue for a root; null: all are roots
    /// deforms: [jointCount] 1: the joint gets weights; null: all do
    /// sources: [jointCount] for Weights.SetJoints: the number that the joint had before, uint.MaxValue for a new
    ///     one; null: the same number. Weights: null
    /// progress: an object to poll and cancel through
    /// influenceCount: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it has
    ///     none, it is made now. Sets *weights to null first.</summary>
    public sealed unsafe class Weights : Recorded
    {
        Weights() { }

        /// <summary>Computes weights.
        ///
        /// heads: [jointCount x 3]
        /// tails: [jointCount x 3], or null: heads are joints, and the library finds the tails
        /// axes: [jointCount x 3] with tails null: where each joint points, any length, a zero vector for unknown;
        ///     or null.      A joint reaches to the child that lies there, or to the end of the skin. A      child
        ///     that does      not deform says where a last joint ends
        /// parents: [jointCount] number of the parent, uint.MaxValue for a root; null: all are roots
        /// deforms: [jointCount] 1: the joint gets weights; null: all do
        /// sources: [jointCount] for Weights.SetJoints: the number that the joint had before, uint.MaxValue for a
        ///     new one; null: the same number. Weights: null
        /// progress: an object to poll and cancel through
        /// influenceCount: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it
        ///     has none, it is made now. Sets *weights to null first.
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_UNSUPPORTED.</summary>
        public Weights(Surface surface, double[] heads = null, double[] tails = null, double[] axes = null,
                uint[] parents = null, int[] deforms = null, uint[] sources = null, uint influenceCount = 0,
                Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var descStruct = new hf_joints_desc { struct_size = (uint)sizeof(hf_joints_desc) };
                hf_joints_desc* desc = &descStruct;
                desc->heads = (IntPtr)c.Array(heads, "heads", "joint_count", "3");
                desc->tails = (IntPtr)c.Array(tails, "tails", "joint_count", "3");
                desc->axes = (IntPtr)c.Array(axes, "axes", "joint_count", "3");
                desc->parents = (IntPtr)c.Array(parents, "parents", "joint_count");
                desc->deforms = (IntPtr)c.Array(deforms, "deforms", "joint_count");
                desc->sources = (IntPtr)c.Array(sources, "sources", "joint_count");
                desc->progress = c.Handle(progress);
                desc->joint_count = (uint)c.Count("joint_count", 0);
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 4 : influenceCount, int.MaxValue);
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Library.Late(() => Functions.hf_weights_create(c.Handle(surface), desc,
                    influenceCount, raw)));
                Own(*raw, Functions.hf_weights_destroy, c, "vertex_count");
            }
        }

        /// <summary>Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of
        /// the two is changed. For undo, keep copies: one before each change.</summary>
        public Weights Clone()
        {
            using (var c = new Call(this))
            {
                var raw = (IntPtr*)c.New(sizeof(IntPtr));
                HfException.Check(Functions.hf_weights_clone(RawHandle, raw));
                var made = new Weights();
                made.Own(*raw, Functions.hf_weights_destroy, c, "vertex_count");
                return made;
            }
        }

        /// <summary>Replaces all
        ///
        /// heads: [jointCount x 3]
        /// tails: [jointCount x 3], or null: heads are joints, and the library finds the tails
        /// axes: [jointCount x 3] with tails null: where each joint points, any length, a zero vector for unknown;
        ///     or null.      A joint reaches to the child that lies there, or to the end of the skin. A      child
        ///     that does      not deform says where a last joint ends
        /// parents: [jointCount] number of the parent, uint.MaxValue for a root; null: all are roots
        /// deforms: [jointCount] 1: the joint gets weights; null: all do
        /// sources: [jointCount] for Weights.SetJoints: the number that the joint had before, uint.MaxValue for a
        ///     new one; null: the same number. Weights: null
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_EMPTY,
        /// HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_UNSUPPORTED.</summary>
        public void SetJoints(double[] heads = null, double[] tails = null, double[] axes = null, uint[] parents = null,
                int[] deforms = null, uint[] sources = null, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_joints_desc { struct_size = (uint)sizeof(hf_joints_desc) };
                hf_joints_desc* desc = &descStruct;
                desc->heads = (IntPtr)c.Array(heads, "heads", "joint_count", "3");
                desc->tails = (IntPtr)c.Array(tails, "tails", "joint_count", "3");
                desc->axes = (IntPtr)c.Array(axes, "axes", "joint_count", "3");
                desc->parents = (IntPtr)c.Array(parents, "parents", "joint_count");
                desc->deforms = (IntPtr)c.Array(deforms, "deforms", "joint_count");
                desc->sources = (IntPtr)c.Array(sources, "sources", "joint_count");
                desc->progress = c.Handle(progress);
                desc->joint_count = (uint)c.Count("joint_count", 0);
                HfException.Check(Functions.hf_weights_set_joints(RawHandle, desc));
            }
        }

        /// <summary>Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices
        /// of a disc. Pins at the same places with other weights cost no path.
        ///
        /// vertices: [pinCount] vertices of your mesh, or null
        /// places: [pinCount], or null
        /// points: [pinCount x 3] points in space, at rest, in the unit and frame of the mesh, or null. Each stands
        ///     for the nearest point of the surface, up to two boxes away
        /// radii: [pinCount] of the geodesic disc around the place, in the unit of the mesh; null or 0: the place
        ///     alone
        /// joints: [pinCount x influenceCount] joints
        /// weights: [pinCount x influenceCount] &gt;= 0, scaled to the sum 1
        /// progress: an object to poll and cancel through
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT,
        /// HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.</summary>
        public void SetPins(uint[] vertices = null, Place[] places = null, double[] points = null,
                double[] radii = null, uint[] joints = null, float[] weights = null, Progress progress = null)
        {
            using (var c = new Call(this))
            {
                var descStruct = new hf_pins_desc { struct_size = (uint)sizeof(hf_pins_desc) };
                hf_pins_desc* desc = &descStruct;
                desc->vertices = (IntPtr)c.Array(vertices, "vertices", "pin_count");
                var placesRows = (hf_place*)c.Given(places, "places", sizeof(hf_place), "pin_count");
                for (int i = 0; places != null && i < places.Length; ++i) places[i].Write(c, placesRows + i);
                desc->places = (IntPtr)placesRows;
                desc->points = (IntPtr)c.Array(points, "points", "pin_count", "3");
                desc->radii = (IntPtr)c.Array(radii, "radii", "pin_count");
                desc->joints = (IntPtr)c.Array(joints, "joints", "pin_count", "influence_count");
                desc->weights = (IntPtr)c.Array(weights, "weights", "pin_count", "influence_count");
                desc->progress = c.Handle(progress);
                desc->pin_count = (uint)c.Count("pin_count", 0);
                desc->influence_count = (uint)c.Count("influence_count", 0);
                HfException.Check(Functions.hf_weights_set_pins(RawHandle, desc));
            }
        }

        /// <summary>Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0
        /// unlocks.
        ///
        /// joints: [lockCount].
        /// values: [vertexCount x lockCount] weights to keep, 0 to 1, or null for the present ones. Welded copies
        ///     take the values of the first. Pinned vertices keep the weights of their pins.
        ///
        /// Throws HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.</summary>
        public void SetLocks(uint[] joints, float[] values = null)
        {
            using (var c = new Call(this))
            {
                void* joints_ = c.Array(joints, "joints", "lock_count");
                void* values_ = c.Array(values, "values", "vertex_count", "lock_count");
                HfException.Check(Functions.hf_weights_set_locks(RawHandle, (uint)c.Count("lock_count", 1), joints_,
                    values_));
            }
        }

        /// <summary>Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first
        /// joint of the vertex.
        ///
        /// Throws HF_ERROR_TOO_LARGE.</summary>
        public WeightsOut Get()
        {
            using (var c = new Call(this))
            {
                var weightsStruct = new hf_weights_out { struct_size = (uint)sizeof(hf_weights_out) };
                hf_weights_out* weights = &weightsStruct;
                uint[] allJoints = null;
                float[] allWeights = null;
                byte[] allOrigins = null;
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        weights->vertex_capacity = (uint)c.Size("vertex_capacity");
                        weights->joints = c.Make(out allJoints, "vertex_capacity", "influence_count");
                        weights->weights = c.Make(out allWeights, "vertex_capacity", "influence_count");
                        weights->origins = c.Make(out allOrigins, "vertex_capacity");
                        result = Functions.hf_weights_get(RawHandle, weights);
                }
                while (c.Again("hf_weights_get", result, ("vertex_capacity", weights->vertex_count), ("influence_count",
                    weights->influence_count)));
                return new WeightsOut { InfluenceCount = weights->influence_count, Joints = c.Cut(allJoints,
                    "vertex_capacity", "influence_count"), Weights = c.Cut(allWeights, "vertex_capacity",
                    "influence_count"), Origins = c.Cut(allOrigins, "vertex_capacity") };
            }
        }

        /// <summary>Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not
        /// deform have no flags.</summary>
        public (uint[] Flags, uint[] VertexCounts) Joints()
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allFlags = null;
                uint[] allVertexCounts = null;
                c.Room("capacity", "hf_weights_get_joints.capacity");
                int result;
                do
                {
                        void* flagsPlace = (void*)c.Make(out allFlags, "capacity");
                        void* vertexCountsPlace = (void*)c.Make(out allVertexCounts, "capacity");
                        result = Functions.hf_weights_get_joints(RawHandle, (uint)c.Size("capacity"), flagsPlace,
                            vertexCountsPlace, &count);
                }
                while (c.Again("hf_weights_get_joints", result, ("capacity", count)));
                return (c.Cut(allFlags, "capacity"), c.Cut(allVertexCounts, "capacity"));
            }
        }

        /// <summary>Writes the info.</summary>
        public WeightsInfo Info
        {
            get
            {
                using (var c = new Call(this))
                {
                    var infoStruct = new hf_weights_info { struct_size = (uint)sizeof(hf_weights_info) };
                    hf_weights_info* info = &infoStruct;
                    HfException.Check(Functions.hf_weights_get_info(RawHandle, info));
                    return new WeightsInfo(info);
                }
            }
        }

        /// <summary>Writes the statistics.</summary>
        public WeightsStatistics Statistics
        {
            get
            {
                using (var c = new Call(this))
                {
                    var statisticsStruct = new hf_weights_statistics { struct_size = (uint)sizeof(hf_weights_statistics) };
                    hf_weights_statistics* statistics = &statisticsStruct;
                    HfException.Check(Functions.hf_weights_get_statistics(RawHandle, statistics));
                    return new WeightsStatistics(statistics);
                }
            }
        }

        /// <summary>Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal,
        /// set deforms to 0.
        ///
        /// names: one line for each joint in UTF-8, or null.
        ///
        /// Throws HF_ERROR_INVALID_ARGUMENT.</summary>
        public uint[] Helpers(string[] names = null)
        {
            using (var c = new Call(this))
            {
                uint count = 0;
                uint[] allReasons = null;
                c.Room("capacity", "hf_weights_get_helpers.capacity");
                int result;
                do
                {
                        void* reasonsPlace = (void*)c.Make(out allReasons, "capacity");
                        result = Functions.hf_weights_get_helpers(RawHandle, c.Text(names), (uint)c.Size("capacity"),
                            reasonsPlace, &count);
                }
                while (c.Again("hf_weights_get_helpers", result, ("capacity", count)));
                return c.Cut(allReasons, "capacity");
            }
        }

        /// <summary>Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand
        /// in the same frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One
        /// bi-harmonic field fills in the vertices without such a point. A piece without any takes the weights of
        /// the nearest points.
        ///
        /// joints: [source.vertexCount x sourceInfluenceCount]
        /// weights: [source.vertexCount x sourceInfluenceCount] &gt;= 0; a vertex whose weights are all 0 gives
        ///     none
        /// distance: a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal
        /// angle: between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees)
        /// influenceCount: joints of each vertex in the result: 4 or 8; 0: 4
        /// progress: an object to poll and cancel through
        /// info: filled in when given
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.</summary>
        public static (WeightsOut Weights, WeightsTransferInfo Info) Transfer(Surface source, Surface target,
                uint[] joints = null, float[] weights = null, double distance = 0, double angle = 0,
                uint influenceCount = 0, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("source.", source);
                c.Parent("target.", target);
                var info = new hf_weights_transfer_info { struct_size = (uint)sizeof(hf_weights_transfer_info) };
                var descStruct = new hf_weights_transfer_desc { struct_size = (uint)sizeof(hf_weights_transfer_desc),
                    distance = distance, angle = angle, influence_count = influenceCount };
                hf_weights_transfer_desc* desc = &descStruct;
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 4 : influenceCount, int.MaxValue);
                desc->joints = (IntPtr)c.Array(joints, "joints", "source.vertex_count", "source_influence_count");
                desc->weights = (IntPtr)c.Array(weights, "weights", "source.vertex_count", "source_influence_count");
                desc->progress = c.Handle(progress);
                desc->source_influence_count = (uint)c.Count("source_influence_count", 0);
                var weights_Struct = new hf_weights_out { struct_size = (uint)sizeof(hf_weights_out) };
                hf_weights_out* weights_ = &weights_Struct;
                uint[] allJoints = null;
                float[] allWeights = null;
                byte[] allOrigins = null;
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        weights_->vertex_capacity = (uint)c.Size("vertex_capacity");
                        weights_->joints = c.Make(out allJoints, "vertex_capacity", "influence_count");
                        weights_->weights = c.Make(out allWeights, "vertex_capacity", "influence_count");
                        weights_->origins = c.Make(out allOrigins, "vertex_capacity");
                        result = Functions.hf_weights_transfer(c.Handle(source), c.Handle(target), desc, weights_,
                            &info);
                }
                while (c.Again("hf_weights_transfer", result, ("vertex_capacity", weights_->vertex_count),
                    ("influence_count", weights_->influence_count)));
                return (new WeightsOut { InfluenceCount = weights_->influence_count, Joints = c.Cut(allJoints,
                    "vertex_capacity", "influence_count"), Weights = c.Cut(allWeights, "vertex_capacity",
                    "influence_count"), Origins = c.Cut(allOrigins, "vertex_capacity") },
                    new WeightsTransferInfo(&info));
            }
        }

        /// <summary>Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights
        /// of the nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-
        /// harmonic field fills in the rest. The plane comes from joints with partners, else from the surface. The
        /// largest component of a found normal is positive. So for a normal along x, MirrorTo.ToNegative copies
        /// from +x to -x.
        ///
        /// heads: [jointCount x 3] the joints at rest, in the frame of the mesh
        /// names: one line for each joint in UTF-8, or null: joints are paired by their places
        /// partners: [jointCount] the joint of the other side, uint.MaxValue: find it; or null
        /// plane: [6] a point and a normal, or null: find the plane
        /// joints: [vertexCount x sourceInfluenceCount]
        /// weights: [vertexCount x sourceInfluenceCount] &gt;= 0; a vertex whose weights are all 0 gives none
        /// to: MirrorTo
        /// distance: as in WeightsTransferDesc
        /// angle: as in WeightsTransferDesc
        /// influenceCount: joints of each vertex in the result: 4 or 8; 0: 4
        /// progress: an object to poll and cancel through
        /// info: filled in when given
        /// statistics: filled in when given
        ///
        /// Throws HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
        /// HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.</summary>
        public static (WeightsOut Weights, uint[] Partners, uint[] Pairings, WeightsMirrorInfo Info,
                WeightsMirrorStatistics Statistics) Mirror(Surface surface, double[] heads = null,
                string[] names = null, uint[] partners = null, double[] plane = null, uint[] joints = null,
                float[] weights = null, MirrorTo to = default(MirrorTo), double distance = 0, double angle = 0,
                uint influenceCount = 0, Progress progress = null)
        {
            using (var c = new Call(null))
            {
                c.Parent("surface.", surface);
                var info = new hf_weights_mirror_info { struct_size = (uint)sizeof(hf_weights_mirror_info) };
                var statistics = new hf_weights_mirror_statistics { struct_size = (uint)sizeof(hf_weights_mirror_statistics) };
                var descStruct = new hf_weights_mirror_desc { struct_size = (uint)sizeof(hf_weights_mirror_desc),
                    to = (int)to, distance = distance, angle = angle, influence_count = influenceCount };
                hf_weights_mirror_desc* desc = &descStruct;
                c.Sizes["influence_count"] = (int)Math.Min(influenceCount == 0 ? 4 : influenceCount, int.MaxValue);
                desc->heads = (IntPtr)c.Array(heads, "heads", "joint_count", "3");
                desc->partners = (IntPtr)c.Array(partners, "partners", "joint_count");
                desc->plane = (IntPtr)c.Array(plane, "plane", "6");
                desc->joints = (IntPtr)c.Array(joints, "joints", "vertex_count", "source_influence_count");
                desc->weights = (IntPtr)c.Array(weights, "weights", "vertex_count", "source_influence_count");
                desc->names = (IntPtr)c.Text(names);
                desc->progress = c.Handle(progress);
                desc->joint_count = (uint)c.Count("joint_count", 0);
                desc->source_influence_count = (uint)c.Count("source_influence_count", 0);
                var weights_Struct = new hf_weights_out { struct_size = (uint)sizeof(hf_weights_out) };
                hf_weights_out* weights_ = &weights_Struct;
                var partners_ = new uint[c.Product("joint_count")];
                var partners_Place = (uint*)c.Pin(partners_);
                var pairings = new uint[c.Product("joint_count")];
                var pairingsPlace = (uint*)c.Pin(pairings);
                uint[] allJoints = null;
                float[] allWeights = null;
                byte[] allOrigins = null;
                c.Room("vertex_capacity", "vertex_count");
                int result;
                do
                {
                        weights_->vertex_capacity = (uint)c.Size("vertex_capacity");
                        weights_->joints = c.Make(out allJoints, "vertex_capacity", "influence_count");
                        weights_->weights = c.Make(out allWeights, "vertex_capacity", "influence_count");
                        weights_->origins = c.Make(out allOrigins, "vertex_capacity");
                        result = Functions.hf_weights_mirror(c.Handle(surface), desc, weights_, partners_Place,
                            pairingsPlace, &info, &statistics);
                }
                while (c.Again("hf_weights_mirror", result, ("vertex_capacity", weights_->vertex_count),
                    ("influence_count", weights_->influence_count)));
                return (new WeightsOut { InfluenceCount = weights_->influence_count, Joints = c.Cut(allJoints,
                    "vertex_capacity", "influence_count"), Weights = c.Cut(allWeights, "vertex_capacity",
                    "influence_count"), Origins = c.Cut(allOrigins, "vertex_capacity") }, partners_, pairings,
                    new WeightsMirrorInfo(&info), new WeightsMirrorStatistics(&statistics));
            }
        }

        internal override Recorded State() { return Clone(); }

        /// <summary>Vertices of the surface, as given.</summary>
        public int VertexCount { get { return Known("vertex_count"); } }
    }
}
