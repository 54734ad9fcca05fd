// Quads and Flow over the C ABI (include/hf/quads.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>Fields of hf_quads_desc; 0 and null are the defaults.</summary>
    public sealed class QuadOptions
    {
        public double EdgeLength, CreaseAngle;
        public uint RelaxCount, FaceCount;
        /// <summary>Two vertices each.</summary>
        public uint[] CreaseEdges;
        public uint[] GuideVertices;
        /// <summary>Three numbers for each guide.</summary>
        public double[] GuideVectors;
        public float[] GuideWeights;
        /// <summary>Irregular vertices at places that the user drags: three numbers each.</summary>
        public double[] IrregularPoints;
        /// <summary>How many quads meet at each irregular vertex: 3 or 5.</summary>
        public uint[] IrregularValences;
        /// <summary>Three numbers for each irregular vertex: one side of it runs along them. 0, 0, 0 is any direction.</summary>
        public double[] IrregularDirections;
        /// <summary>a, b, c, d of the plane a x + b y + c z = d.</summary>
        public double[] SymmetryPlane;
        public Progress Progress;
    }

    /// <summary>Face i has the corners Faces[4 * i] to Faces[4 * i + 3], counter-clockwise.</summary>
    public sealed class QuadMesh
    {
        public double[] Positions, Barycentrics;
        public uint[] Faces, Triangles, Corners;
    }

    /// <summary>A quad mesh of a surface.</summary>
    public sealed unsafe class Quads : HfObject
    {
        public Quads(Surface surface, QuadOptions options = null)
        {
            options = options ?? new QuadOptions();
            using (var pins = new Pins())
            {
                hf_quads_desc desc = DescOf(options, pins);
                Make(Functions.hf_quads_create, surface, "surface", &desc, Functions.hf_quads_destroy);
                GC.KeepAlive(options.Progress);
            }
        }

        /// <summary>Makes the mesh again: for strokes, creases and poles that the user drags. After an exception it is
        /// what it was.</summary>
        public void Update(QuadOptions options)
        {
            options = options ?? new QuadOptions();
            using (var pins = new Pins())
            {
                hf_quads_desc desc = DescOf(options, pins);
                Check(Functions.hf_quads_update(Handle, &desc));
                GC.KeepAlive(options.Progress);
            }
        }

        static hf_quads_desc DescOf(QuadOptions options, Pins pins)
        {
            var desc = new hf_quads_desc { struct_size = (uint)sizeof(hf_quads_desc) };
            desc.edge_length = options.EdgeLength;
            desc.relax_count = options.RelaxCount;
            desc.face_count = options.FaceCount;
            desc.crease_angle = options.CreaseAngle;
            int corners = options.CreaseEdges == null ? 0 : options.CreaseEdges.Length;
            int guides = options.GuideVertices == null ? 0 : options.GuideVertices.Length;
            if (corners % 2 != 0)
                throw new HfException("CreaseEdges must hold two vertices each, not " + corners + " numbers");
            desc.crease_count = (uint)(corners / 2);
            desc.crease_edges = pins.Add(options.CreaseEdges);
            desc.guide_count = (uint)guides;
            desc.guide_vertices = pins.Add(options.GuideVertices);
            desc.guide_vectors = pins.Add(options.GuideVectors, 3 * guides, "GuideVectors");
            desc.guide_weights = pins.Add(options.GuideWeights, guides, "GuideWeights");
            int poles = options.IrregularValences == null ? 0 : options.IrregularValences.Length;
            desc.irregular_count = (uint)poles;
            desc.irregular_valences = pins.Add(options.IrregularValences);
            desc.irregular_points = pins.Add(options.IrregularPoints, 3 * poles, "IrregularPoints");
            desc.irregular_directions = pins.Add(options.IrregularDirections, 3 * poles, "IrregularDirections");
            if (options.SymmetryPlane != null)
            {
                Pins.Need(options.SymmetryPlane.Length, 4, "SymmetryPlane");
                for (int i = 0; i < 4; ++i) desc.symmetry_plane[i] = options.SymmetryPlane[i];
            }
            if (options.Progress != null) desc.progress = options.Progress.Handle;
            return desc;
        }

        public hf_quads_info Info { get { return Read<hf_quads_info>(Functions.hf_quads_get_info); } }

        public QuadMesh Mesh()
        {
            hf_quads_info info = Info;
            uint v = info.vertex_count;
            var mesh = new QuadMesh
            {
                Positions = new double[3 * v], Barycentrics = new double[3 * v], Triangles = new uint[v],
                Faces = new uint[4 * info.face_count], Corners = new uint[3 * v],
            };
            using (var pins = new Pins())
            {
                var place = new hf_quads_mesh { struct_size = (uint)sizeof(hf_quads_mesh) };
                place.vertex_capacity = v;
                place.face_capacity = info.face_count;
                place.positions = pins.Add(mesh.Positions);
                place.triangles = pins.Add(mesh.Triangles);
                place.barycentrics = pins.Add(mesh.Barycentrics);
                place.faces = pins.Add(mesh.Faces);
                place.corners = pins.Add(mesh.Corners);
                Check(Functions.hf_quads_get_mesh(Handle, &place));
            }
            return mesh;
        }
    }

    /// <summary>Line i holds the points LineStarts[i] to LineStarts[i + 1] - 1; Values rise along it.</summary>
    public sealed class Streamlines
    {
        public double[] Positions, Values;
        public uint[] LineStarts, LineEnds;
    }

    /// <summary>A surface prepared for tracing streamlines, again and again.</summary>
    public sealed unsafe class Flow : HfObject
    {
        readonly int vertexCount;
        uint points = 4096, lines = 64; // room for what the last trace needed

        public Flow(Surface surface)
        {
            Make((parent, none, raw) => Functions.hf_flow_create(parent, raw), surface, "surface", null,
                Functions.hf_flow_destroy);
            vertexCount = surface.VertexCount;
        }

        /// <summary>Lines of equal flux from the minima of a field, wantedCount of them, or one through every seed
        /// vertex.</summary>
        public Streamlines Trace(double[] field, uint wantedCount = 0, uint[] seeds = null)
        {
            for (;;)
            {
                var found = new Streamlines { Positions = new double[3 * points], Values = new double[points],
                    LineStarts = new uint[lines + 1], LineEnds = new uint[2 * lines] };
                using (var pins = new Pins())
                {
                    var scalars = new hf_scalars { struct_size = (uint)sizeof(hf_scalars) };
                    scalars.values_f64 = pins.Add(field, vertexCount, "field");
                    var place = new hf_streamlines { struct_size = (uint)sizeof(hf_streamlines) };
                    place.wanted_count = wantedCount;
                    place.seed_count = seeds == null ? 0 : (uint)seeds.Length;
                    place.seeds = pins.Add(seeds);
                    place.point_capacity = points;
                    place.line_capacity = lines;
                    place.positions = pins.Add(found.Positions);
                    place.values = pins.Add(found.Values);
                    place.line_starts = pins.Add(found.LineStarts);
                    place.line_ends = pins.Add(found.LineEnds);
                    int result = Functions.hf_flow_trace(Handle, &scalars, &place);
                    if (result == Constants.HF_ERROR_TOO_SMALL)
                    {
                        points = place.point_count + place.point_count / 4;
                        lines = place.line_count;
                        continue;
                    }
                    Check(result);
                    Array.Resize(ref found.Positions, (int)(3 * place.point_count));
                    Array.Resize(ref found.Values, (int)place.point_count);
                    Array.Resize(ref found.LineStarts, (int)place.line_count + 1);
                    Array.Resize(ref found.LineEnds, (int)(2 * place.line_count));
                    return found;
                }
            }
        }
    }
}
