// Solver and Progress over the C ABI (include/hf/mesh.h, field.h, factor.h, analysis.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>Fields of hf_create_desc that are not arrays; 0 is the default of each.</summary>
    public sealed class SolverOptions
    {
        public int Weld, OperatorKind, Engine, Ordering, FieldKind;
        public float WeldTolerance;
        public uint ChannelCount, ThreadCount, SiteLimit, VertexLimit, TriangleLimit, MemoryLimitMb;
        public double Penalty;
        public byte[] SavedFactor;
        public Progress Progress;
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

        public float Fraction { get { float value; Check(Functions.hf_progress_get(Handle, &value)); return value; } }
        public void Cancel() { Check(Functions.hf_progress_cancel(Handle)); }
    }

    /// <summary>Polylines of iso-lines: line i holds the points LineStarts[i] to LineStarts[i + 1] - 1.</summary>
    public sealed class Isolines
    {
        public double[] Positions, Parameters;
        public uint[] PointEdges, LineStarts, LineLevels;
        public int[] LineClosed;
    }

    /// <summary>One surface, its Laplacian and factor, and a set of sites.</summary>
    public sealed unsafe class Solver : HfObject
    {
        public int VertexCount { get; private set; }
        public int ChannelCount { get; private set; }

        Solver() { }

        /// <summary>positions: xyz per vertex; triangles: three vertices each. Borrowed for the call.</summary>
        public Solver(float[] positions, uint[] triangles, SolverOptions options = null) { Create(positions, false,
            triangles, options); }

        /// <summary>The same from doubles.</summary>
        public Solver(double[] positions, uint[] triangles, SolverOptions options = null) { Create(positions, true,
            triangles, options); }

        void Create(Array positions, bool wide, uint[] triangles, SolverOptions options)
        {
            if (positions == null) throw new HfException("positions is null", Constants.HF_ERROR_NULL_POINTER);
            if (positions.Length % 3 != 0) throw new HfException("positions must hold three numbers a vertex, not "
                + positions.Length);
            if (triangles != null && triangles.Length % 3 != 0)
                throw new HfException("triangles must hold three numbers each, not " + triangles.Length);
            options = options ?? new SolverOptions();
            using (var pins = new Pins())
            {
                hf_create_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_create_desc));
                desc.vertex_count = (uint)(positions.Length / 3);
                desc.triangle_count = triangles == null ? 0 : (uint)(triangles.Length / 3);
                if (wide) desc.positions_f64 = pins.Add(positions);
                else desc.positions = pins.Add(positions);
                desc.triangles = pins.Add(triangles);
                desc.weld = options.Weld;
                desc.weld_tolerance = options.WeldTolerance;
                desc.operator_kind = options.OperatorKind;
                desc.engine = options.Engine;
                desc.ordering = options.Ordering;
                desc.field_kind = options.FieldKind;
                desc.channel_count = options.ChannelCount;
                desc.thread_count = options.ThreadCount;
                desc.site_limit = options.SiteLimit;
                desc.vertex_limit = options.VertexLimit;
                desc.triangle_limit = options.TriangleLimit;
                desc.memory_limit_mb = options.MemoryLimitMb;
                desc.penalty = options.Penalty;
                if (options.Progress != null) desc.progress = options.Progress.Handle;
                hf_factor_desc factor;
                if (options.SavedFactor != null)
                {
                    Functions.hf_init_desc(&factor, (uint)sizeof(hf_factor_desc));
                    factor.bytes = pins.Add(options.SavedFactor);
                    factor.byte_count = (UIntPtr)options.SavedFactor.Length;
                    desc.saved_factor = (IntPtr)(&factor);
                }
                IntPtr raw;
                HfException.Check(Functions.hf_create(&desc, &raw));
                GC.KeepAlive(options.Progress);
                Own(raw, Functions.hf_destroy);
            }
            VertexCount = positions.Length / 3;
            ChannelCount = Math.Max(1, (int)options.ChannelCount);
        }

        /// <summary>A solver that shares mesh and factor and has a copy of the sites.</summary>
        public Solver Clone()
        {
            var copy = new Solver { VertexCount = VertexCount, ChannelCount = ChannelCount };
            copy.Copy(Functions.hf_clone, this, Functions.hf_destroy);
            return copy;
        }

        public hf_mesh_report Report
        {
            get
            {
                hf_mesh_report report;
                Functions.hf_init_desc(&report, (uint)sizeof(hf_mesh_report));
                Check(Functions.hf_get_mesh_report(Handle, &report));
                return report;
            }
        }

        public hf_statistics Statistics
        {
            get
            {
                hf_statistics statistics;
                Functions.hf_init_desc(&statistics, (uint)sizeof(hf_statistics));
                Check(Functions.hf_get_statistics(Handle, &statistics));
                return statistics;
            }
        }

        hf_sites_desc Places(Pins pins, uint[] vertices, double[] values, double[] stiffness = null,
            double[] radii = null, uint[] triangles = null, double[] barycentrics = null)
        {
            int count = Pins.Count(vertices ?? triangles);
            hf_sites_desc desc;
            Functions.hf_init_desc(&desc, (uint)sizeof(hf_sites_desc));
            desc.site_count = (uint)count;
            desc.vertices = pins.Add(vertices);
            desc.triangles = pins.Add(triangles);
            desc.barycentrics = pins.Add(barycentrics, 3 * count, "barycentrics");
            desc.values = pins.Add(values, count * ChannelCount, "values");
            desc.stiffness = pins.Add(stiffness, count, "stiffness");
            desc.radii = pins.Add(radii, count, "radii");
            return desc;
        }

        /// <summary>Adds sites at vertices or inside triangles; all or nothing. Returns their numbers.</summary>
        public uint[] AddSites(uint[] vertices, double[] values, double[] stiffness = null, double[] radii = null,
            uint[] triangles = null, double[] barycentrics = null)
        {
            using (var pins = new Pins())
            {
                hf_sites_desc desc = Places(pins, vertices, values, stiffness, radii, triangles, barycentrics);
                var numbers = new uint[desc.site_count];
                Check(Functions.hf_add_sites(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        public void RemoveSites(uint[] sites)
        {
            OnList(Functions.hf_remove_sites, sites);
        }

        public void MoveSites(uint[] sites, uint[] vertices)
        {
            using (var pins = new Pins())
            {
                hf_sites_desc desc = Places(pins, vertices, null);
                Check(Functions.hf_move_sites(Handle, (uint)Pins.Count(sites), (void*)pins.Add(sites), &desc));
            }
        }

        public void SetSiteValues(uint[] sites, double[] values)
        {
            OnList(Functions.hf_set_site_values, sites, values, ChannelCount, "values");
        }

        /// <summary>One batch: remove, move, set, add; all or nothing. Returns the numbers of the added
        /// sites.</summary>
        public uint[] EditSites(uint[] remove = null, uint[] move = null, uint[] moveTo = null, uint[] set = null,
            double[] setValues = null, uint[] add = null, double[] addValues = null)
        {
            using (var pins = new Pins())
            {
                hf_edit_desc edit;
                Functions.hf_init_desc(&edit, (uint)sizeof(hf_edit_desc));
                edit.remove_count = remove == null ? 0 : (uint)remove.Length;
                edit.remove_sites = pins.Add(remove);
                edit.move_count = move == null ? 0 : (uint)move.Length;
                edit.move_sites = pins.Add(move);
                edit.set_count = set == null ? 0 : (uint)set.Length;
                edit.set_sites = pins.Add(set);
                edit.set_values = pins.Add(setValues, (int)edit.set_count * ChannelCount, "setValues");
                hf_sites_desc to, added;
                if (moveTo != null) { to = Places(pins, moveTo, null); edit.move_to = (IntPtr)(&to); }
                if (add != null) { added = Places(pins, add, addValues); edit.add = (IntPtr)(&added); }
                var numbers = new uint[add == null ? 0 : add.Length];
                Check(Functions.hf_edit_sites(Handle, &edit, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        public int SiteCount { get { int count = (int)Functions.hf_get_site_count(Handle); GC.KeepAlive(this);
            return count; } }
        public void Record() { Check(Functions.hf_record(Handle)); }
        public void Undo() { Check(Functions.hf_undo(Handle)); }
        public void Redo() { Check(Functions.hf_redo(Handle)); }

        /// <summary>The field at every vertex into the caller's memory: VertexCount times ChannelCount
        /// numbers.</summary>
        public void Solve(Span<float> field)
        {
            Pins.Need(field.Length, VertexCount * ChannelCount, "field");
            fixed (float* place = &MemoryMarshal.GetReference(field)) Check(Functions.hf_solve(Handle, place, 0, null));
        }

        public void Solve(Span<double> field)
        {
            Pins.Need(field.Length, VertexCount * ChannelCount, "field");
            fixed (double* place = &MemoryMarshal.GetReference(field))
                Check(Functions.hf_solve_f64(Handle, place, 0, null));
        }

        public float[] Solve() { var field = new float[VertexCount * ChannelCount]; Solve(field.AsSpan());
            return field; }
        public double[] SolveDouble() { var field = new double[VertexCount * ChannelCount]; Solve(field.AsSpan());
            return field; }

        public double[] SolvePreview(uint correctionCount = 0)
        {
            var field = new double[VertexCount * ChannelCount];
            fixed (double* place = field)
                Check(Functions.hf_solve_preview_f64(Handle, place, 0, correctionCount, null));
            return field;
        }

        public double[] SolveAt(uint[] vertices)
        {
            var values = new double[Pins.Count(vertices) * ChannelCount];
            using (var pins = new Pins())
                Check(Functions.hf_solve_at(Handle, (uint)Pins.Count(vertices), (void*)pins.Add(vertices),
                (void*)pins.Add(values)));
            return values;
        }

        /// <summary>A tangent vector field from three channels: xyz per vertex.</summary>
        public double[] SolveVectors()
        {
            var vectors = new double[3 * VertexCount];
            fixed (double* place = vectors) Check(Functions.hf_solve_vectors_f64(Handle, place, 0, null, null));
            return vectors;
        }

        /// <summary>Moves sites of a three-channel solver, carrying their vectors along the surface.</summary>
        public void MoveVectorSites(uint[] sites, uint[] vertices) { OnList(Functions.hf_move_vector_sites, sites,
            vertices); }

        /// <summary>Turns the vectors of sites about the normals, radians.</summary>
        public void RotateVectorSites(uint[] sites, double[] angles) { OnList(Functions.hf_rotate_vector_sites, sites,
            angles, 1, "angles"); }

        /// <summary>Measures the field on its own equations; throws when an error exceeds the tolerance (0: the
        /// default).</summary>
        public hf_certificate Certify(double tolerance = 0)
        {
            hf_certificate certificate;
            Functions.hf_init_desc(&certificate, (uint)sizeof(hf_certificate));
            certificate.tolerance = tolerance;
            Check(Functions.hf_certify(Handle, &certificate));
            return certificate;
        }

        public void PrepareRebase() { Check(Functions.hf_prepare_rebase(Handle)); }
        public void ReleasePreview() { Check(Functions.hf_release_preview(Handle)); }

        /// <summary>The component of every vertex; HF_NO_INDEX for isolated ones.</summary>
        public uint[] Components()
        {
            var components = new uint[VertexCount];
            fixed (uint* place = components) Check(Functions.hf_get_components(Handle, (uint)VertexCount, place));
            return components;
        }

        /// <summary>The factor as bytes, for SolverOptions.SavedFactor.</summary>
        public byte[] SaveFactor()
        {
            UIntPtr size;
            Check(Functions.hf_get_factor_size(Handle, &size));
            var bytes = new byte[(long)size];
            fixed (byte* place = bytes) Check(Functions.hf_save_factor(Handle, place, size));
            return bytes;
        }

        hf_scalars Scalars(Pins pins, double[] field)
        {
            hf_scalars scalars;
            Functions.hf_init_desc(&scalars, (uint)sizeof(hf_scalars));
            scalars.values_f64 = pins.Add(field, VertexCount, "field");
            return scalars;
        }

        public double[] SpaceLevels(double[] field, int levelCount, int spacing = Constants.HF_LEVELS_VALUE)
        {
            using (var pins = new Pins())
            {
                hf_scalars scalars = Scalars(pins, field);
                var levels = new double[Math.Max(0, Math.Min(levelCount, 1000000))];
                Check(Functions.hf_space_levels(Handle, &scalars, spacing, (uint)Math.Max(0, levelCount),
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
                hf_isolines lines;
                Functions.hf_init_desc(&lines, (uint)sizeof(hf_isolines));
                Check(Functions.hf_trace_isolines(Handle, &scalars, count, wanted, &lines));
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
                Check(Functions.hf_trace_isolines(Handle, &scalars, count, wanted, &lines));
                return result;
            }
        }

        public hf_critical_point[] FindCriticalPoints(double[] field)
        {
            using (var pins = new Pins())
            {
                hf_scalars scalars = Scalars(pins, field);
                hf_critical_info info;
                Functions.hf_init_desc(&info, (uint)sizeof(hf_critical_info));
                Check(Functions.hf_find_critical_points(Handle, &scalars, 0, null, &info));
                var points = new hf_critical_point[info.point_count];
                if (points.Length > 0) fixed (hf_critical_point* place = points)
                    Check(Functions.hf_find_critical_points(Handle, &scalars, info.point_count, place, &info));
                return points;
            }
        }

        public hf_extremity[] FindExtremities(int kind = Constants.HF_EXTREMITIES_POISSON)
        {
            hf_extremities_desc desc;
            Functions.hf_init_desc(&desc, (uint)sizeof(hf_extremities_desc));
            desc.kind = kind;
            hf_extremities_desc* place = &desc;
            return Rows<hf_extremity>((handle, capacity, rows, count) => Functions.hf_find_extremities(handle, place,
                capacity, rows, count));
        }
    }
}
