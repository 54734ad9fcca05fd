// Surface and Progress over the C ABI (include/hf/surface.h, analysis.h).
using System;
using Hf.Native;

namespace Hf
{
    /// <summary>What surfaces of meshes and of graphs have in common; 0 is the default of each.</summary>
    public abstract class CommonOptions
    {
        public int FieldKind, Ordering;
        public uint ThreadCount, VertexLimit, MemoryLimitMb;
        public byte[] SavedFactor;
        public Progress Progress;

        internal void Write(Pins pins, out int fieldKind, out int ordering, out uint threadCount, out uint vertexLimit,
            out uint memoryLimitMb, out IntPtr progress, out IntPtr savedFactor)
        {
            fieldKind = FieldKind;
            ordering = Ordering;
            threadCount = ThreadCount;
            vertexLimit = VertexLimit;
            memoryLimitMb = MemoryLimitMb;
            progress = Progress == null ? IntPtr.Zero : Progress.Handle;
            savedFactor = pins.AddFactor(SavedFactor);
        }
    }

    /// <summary>Fields of hf_surface_desc that are not arrays; 0 is the default of each.</summary>
    public sealed class SurfaceOptions : CommonOptions
    {
        public int Weld, OperatorKind;
        public double WeldTolerance;
        public uint TriangleLimit;
        /// <summary>Joins the pieces of a character by links, so that fields and poses span them.</summary>
        public bool LinkPieces;
        /// <summary>With LinkPieces: null, or a number per vertex. Pieces of different tags stay apart.</summary>
        public uint[] Tags;
    }

    /// <summary>Fields of hf_graph_desc that are not arrays; 0 is the default of each.</summary>
    public sealed class GraphOptions : CommonOptions
    {
        public bool AllowNegative;
        public uint EdgeLimit;
    }

    /// <summary>Watches and cancels a long call from another thread.</summary>
    public sealed unsafe class Progress : HfObject
    {
        public Progress()
        {
            IntPtr raw;
            HfException.Check(Functions.hf_progress_create(&raw));
            Own(raw, Functions.hf_progress_destroy);
        }

        public double Fraction { get { double value; Check(Functions.hf_progress_get_fraction(Handle, &value)); return value; } }
        public void Cancel() { Check(Functions.hf_progress_cancel(Handle)); }
    }

    /// <summary>Polylines of iso-lines: line i holds the points LineStarts[i] to LineStarts[i + 1] - 1.</summary>
    public sealed class Isolines
    {
        public double[] Positions, Parameters;
        public uint[] PointEdges, LineStarts, LineLevels;
        public int[] LineClosed;
    }

    /// <summary>The first triangle or face on a ray; Barycentrics are the weights of Corners, Vertex the corner nearest
    /// to the hit.</summary>
    public sealed class Hit
    {
        public uint Triangle, Vertex;
        public uint[] Corners;
        public double[] Barycentrics, Position;
        public double Distance;
    }

    /// <summary>A mesh, welded, checked, ordered and factorised once. Solvers, poses and the rest are made on
    /// it.</summary>
    public sealed unsafe class Surface : HfObject
    {
        public int VertexCount { get; private set; }

        /// <summary>positions: xyz per vertex; triangles: three vertices each. Borrowed for the call.</summary>
        public Surface(float[] positions, uint[] triangles, SurfaceOptions options = null)
        {
            Library.Load();
            Create(positions, triangles, options);
        }

        /// <summary>The same from doubles.</summary>
        public Surface(double[] positions, uint[] triangles, SurfaceOptions options = null)
        {
            Library.Load();
            Create(positions, triangles, options);
        }

        /// <summary>The same with 16-bit triangles.</summary>
        public Surface(float[] positions, ushort[] triangles, SurfaceOptions options = null)
        {
            Library.Load();
            Create(positions, triangles, options);
        }

        /// <summary>The same from doubles with 16-bit triangles.</summary>
        public Surface(double[] positions, ushort[] triangles, SurfaceOptions options = null)
        {
            Library.Load();
            Create(positions, triangles, options);
        }

        Surface() { }

        /// <summary>A surface of a graph: two vertices for each edge, and its weight. masses: null, or one per vertex for
        /// bi-harmonic fields. What needs triangles throws.</summary>
        public static Surface FromGraph(int vertexCount, uint[] edges, double[] weights, double[] masses = null,
            GraphOptions options = null)
        {
            Library.Load();
            return OfGraph(vertexCount, edges, weights, masses, options);
        }

        // Mono looks for the library when it compiles a method that calls it, so the public one has no such call.
        static Surface OfGraph(int vertexCount, uint[] edges, double[] weights, double[] masses, GraphOptions options)
        {
            if (vertexCount < 0) throw new HfException("vertexCount is " + vertexCount);
            if (edges != null && weights != null && edges.Length != 2 * weights.Length)
                throw new HfException("edges must hold two vertices for each of the weights");
            options = options ?? new GraphOptions();
            var surface = new Surface { VertexCount = vertexCount };
            using (var pins = new Pins())
            {
                var desc = new hf_graph_desc { struct_size = (uint)sizeof(hf_graph_desc) };
                desc.vertex_count = (uint)vertexCount;
                desc.edge_count = weights == null ? 1 : (uint)weights.Length;
                desc.edges = pins.Add(edges);
                desc.weights = pins.Add(weights);
                desc.masses = pins.Add(masses, vertexCount, "masses");
                desc.allow_negative = options.AllowNegative ? 1 : 0;
                desc.edge_limit = options.EdgeLimit;
                options.Write(pins, out desc.field_kind, out desc.ordering, out desc.thread_count,
                    out desc.vertex_limit, out desc.memory_limit_mb, out desc.progress, out desc.saved_factor);
                IntPtr raw;
                HfException.Check(Functions.hf_surface_create_graph(&desc, &raw));
                GC.KeepAlive(options.Progress);
                surface.Own(raw, Functions.hf_surface_destroy);
            }
            return surface;
        }

        /// <summary>A surface of faces with any number of corners: those of face f are corners[offsets[f]] to
        /// corners[offsets[f + 1] - 1].</summary>
        public static Surface OfFaces(Array positions, uint[] offsets, uint[] corners, SurfaceOptions options = null)
        {
            if (!(positions is float[] || positions is double[]))
                throw new HfException("positions must be float[] or double[]", Constants.HF_ERROR_NULL_POINTER);
            Library.Load();
            var surface = new Surface();
            surface.Create(positions, null, options, offsets, corners);
            return surface;
        }

        void Create(Array positions, Array triangles, SurfaceOptions options, uint[] offsets = null,
            uint[] corners = null)
        {
            if (positions == null) throw new HfException("positions is null", Constants.HF_ERROR_NULL_POINTER);
            if (positions.Length % 3 != 0) throw new HfException("positions must hold three numbers a vertex, not "
                + positions.Length);
            if (triangles != null && triangles.Length % 3 != 0)
                throw new HfException("triangles must hold three numbers each, not " + triangles.Length);
            options = options ?? new SurfaceOptions();
            using (var pins = new Pins())
            {
                var desc = new hf_surface_desc { struct_size = (uint)sizeof(hf_surface_desc) };
                desc.vertex_count = (uint)(positions.Length / 3);
                desc.triangle_count = triangles == null ? 0 : (uint)(triangles.Length / 3);
                if (positions is double[]) desc.positions_f64 = pins.Add(positions);
                else desc.positions = pins.Add(positions);
                if (triangles is ushort[]) desc.triangles_u16 = pins.Add(triangles);
                else desc.triangles = pins.Add(triangles);
                desc.face_count = offsets == null || offsets.Length == 0 ? 0 : (uint)(offsets.Length - 1);
                desc.corner_count = corners == null ? 0 : (uint)corners.Length;
                desc.face_starts = pins.Add(offsets);
                desc.corners = pins.Add(corners);
                desc.weld = options.Weld;
                desc.weld_tolerance = options.WeldTolerance;
                desc.operator_kind = options.OperatorKind;
                desc.triangle_limit = options.TriangleLimit;
                options.Write(pins, out desc.field_kind, out desc.ordering, out desc.thread_count,
                    out desc.vertex_limit, out desc.memory_limit_mb, out desc.progress, out desc.saved_factor);
                if (options.Tags != null && !options.LinkPieces) throw new HfException("Tags need LinkPieces");
                hf_links_desc links;
                if (options.LinkPieces)
                {
                    links = new hf_links_desc { struct_size = (uint)sizeof(hf_links_desc) };
                    links.mode = Constants.HF_LINK_PIECES;
                    links.tags = pins.Add(options.Tags, positions.Length / 3, "Tags");
                    desc.links = (IntPtr)(&links);
                }
                IntPtr raw;
                HfException.Check(Functions.hf_surface_create(&desc, &raw));
                GC.KeepAlive(options.Progress);
                Own(raw, Functions.hf_surface_destroy);
            }
            VertexCount = positions.Length / 3;
        }

        /// <summary>The options it was made with, defaults filled in.</summary>
        public hf_surface_info Info { get { return Read<hf_surface_info>(Functions.hf_surface_get_info); } }

        public hf_surface_report Report { get { return Read<hf_surface_report>(Functions.hf_surface_get_report); } }

        public hf_surface_statistics Statistics { get { return Read<hf_surface_statistics>(Functions.hf_surface_get_statistics); } }

        /// <summary>The component of every vertex; HF_NO_INDEX for isolated ones.</summary>
        public uint[] Components()
        {
            var components = new uint[VertexCount];
            fixed (uint* place = components) Check(Functions.hf_surface_get_components(Handle, (uint)VertexCount, place, null));
            return components;
        }

        /// <summary>The factor of one kind of field as bytes, for SurfaceOptions.SavedFactor.</summary>
        public byte[] Save(int fieldKind = Constants.HF_FIELD_HARMONIC)
        {
            UIntPtr size;
            Check(Functions.hf_surface_save(Handle, fieldKind, IntPtr.Zero, UIntPtr.Zero, null, &size));
            var bytes = new byte[(long)size];
            fixed (byte* place = bytes) Check(Functions.hf_surface_save(Handle, fieldKind, IntPtr.Zero, size, place, null));
            return bytes;
        }

        hf_pick_desc Picked(Pins pins, double[] positions, bool frontOnly)
        {
            var desc = new hf_pick_desc { struct_size = (uint)sizeof(hf_pick_desc) };
            desc.positions_f64 = pins.Add(positions, 3 * VertexCount, "positions");
            desc.front_only = frontOnly ? 1 : 0;
            return desc;
        }

        /// <summary>The first triangle on a ray, or null. positions: a pose of the surface, null for the rest
        /// positions.</summary>
        public Hit CastRay(double[] origin, double[] direction, double[] positions = null, bool frontOnly = false)
        {
            using (var pins = new Pins())
            {
                hf_pick_desc desc = Picked(pins, positions, frontOnly);
                var hit = new hf_hit { struct_size = (uint)sizeof(hf_hit) };
                Check(Functions.hf_surface_cast_ray(Handle, (void*)pins.Add(origin, 3, "origin"),
                    (void*)pins.Add(direction, 3, "direction"), &desc, &hit));
                if (hit.found == 0) return null;
                return new Hit { Triangle = hit.triangle, Vertex = hit.vertex, Distance = hit.distance,
                    Corners = new[] { hit.corners[0], hit.corners[1], hit.corners[2] },
                    Barycentrics = new[] { hit.barycentrics[0], hit.barycentrics[1], hit.barycentrics[2] },
                    Position = new[] { hit.position[0], hit.position[1], hit.position[2] } };
            }
        }

        /// <summary>The vertex nearest to a point.</summary>
        public uint FindVertex(double[] point, out double distance, double[] positions = null)
        {
            using (var pins = new Pins())
            {
                hf_pick_desc desc = Picked(pins, positions, false);
                uint vertex;
                double apart;
                Check(Functions.hf_surface_find_vertex(Handle, (void*)pins.Add(point, 3, "point"), &desc, &vertex,
                    &apart));
                distance = apart;
                return vertex;
            }
        }

        hf_scalars Scalars(Pins pins, double[] field)
        {
            var scalars = new hf_scalars { struct_size = (uint)sizeof(hf_scalars) };
            scalars.values_f64 = pins.Add(field, VertexCount, "field");
            return scalars;
        }

        public double[] SpaceLevels(double[] field, int levelCount, int spacing = Constants.HF_LEVELS_VALUE)
        {
            using (var pins = new Pins())
            {
                hf_scalars scalars = Scalars(pins, field);
                var levels = new double[Math.Max(0, Math.Min(levelCount, 1000000))];
                Check(Functions.hf_surface_space_levels(Handle, &scalars, spacing, (uint)Math.Max(0, levelCount),
                    (void*)pins.Add(levels)));
                return levels;
            }
        }

        public Isolines TraceIsolines(double[] field, double[] levels)
        {
            using (var pins = new Pins())
            {
                hf_scalars scalars = Scalars(pins, field);
                uint count = (uint)Pins.Count(levels);
                void* wanted = (void*)pins.Add(levels);
                var lines = new hf_isolines { struct_size = (uint)sizeof(hf_isolines) };
                Check(Functions.hf_surface_trace_isolines(Handle, &scalars, count, wanted, &lines));
                uint p = lines.point_count, k = lines.line_count;
                var result = new Isolines { Positions = new double[3 * p], Parameters = new double[p],
                    PointEdges = new uint[2 * p], LineStarts = new uint[k + 1], LineLevels = new uint[k],
                    LineClosed = new int[k] };
                if (k == 0) return result;
                lines.point_capacity = p;
                lines.line_capacity = k;
                lines.positions = pins.Add(result.Positions);
                lines.parameters = pins.Add(result.Parameters);
                lines.point_edges = pins.Add(result.PointEdges);
                lines.line_starts = pins.Add(result.LineStarts);
                lines.line_levels = pins.Add(result.LineLevels);
                lines.line_closed = pins.Add(result.LineClosed);
                Check(Functions.hf_surface_trace_isolines(Handle, &scalars, count, wanted, &lines));
                return result;
            }
        }

        public hf_critical_point[] FindCriticalPoints(double[] field)
        {
            using (var pins = new Pins())
            {
                hf_scalars scalars = Scalars(pins, field);
                var info = new hf_critical_info { struct_size = (uint)sizeof(hf_critical_info) };
                Check(Functions.hf_surface_find_critical_points(Handle, &scalars, 0, null, &info));
                var points = new hf_critical_point[info.point_count];
                if (points.Length > 0) fixed (hf_critical_point* place = points)
                    Check(Functions.hf_surface_find_critical_points(Handle, &scalars, info.point_count, place, &info));
                return points;
            }
        }

        public hf_extremity[] FindExtremities(int kind = Constants.HF_EXTREMITIES_POISSON)
        {
            var desc = new hf_extremities_desc { struct_size = (uint)sizeof(hf_extremities_desc) };
            desc.kind = kind;
            hf_extremities_desc* place = &desc;
            return Rows<hf_extremity>((handle, capacity, rows, count) => Functions.hf_surface_find_extremities(handle, place,
                capacity, rows, count));
        }

        /// <summary>Places for handles, pinned ones first; up points away from the ground.</summary>
        public hf_handle_proposal[] ProposeHandles(double upX = 0, double upY = 1, double upZ = 0)
        {
            var desc = new hf_handle_proposals_desc { struct_size = (uint)sizeof(hf_handle_proposals_desc) };
            desc.up[0] = upX;
            desc.up[1] = upY;
            desc.up[2] = upZ;
            hf_handle_proposals_desc* place = &desc;
            return Rows<hf_handle_proposal>((handle, capacity, rows, count) => Functions.hf_surface_propose_handles(handle, place,
                capacity, rows, count));
        }
    }
}
