// Solver over the C ABI (include/hf/solver.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>Fields of hf_solver_desc; 0 is the default of each.</summary>
    public sealed class SolverOptions
    {
        public int FieldKind, Engine;
        public uint ChannelCount, SiteLimit;
        public double Penalty;
        public Progress Progress;
    }

    /// <summary>Sites on a surface that come and go, and the smooth field through them.</summary>
    public sealed unsafe class Solver : Recorded
    {
        public int VertexCount { get; private set; }
        public int ChannelCount { get; private set; }

        Solver() { }

        public Solver(Surface surface, SolverOptions options = null)
        {
            options = options ?? new SolverOptions();
            var desc = new hf_solver_desc { struct_size = (uint)sizeof(hf_solver_desc) };
            desc.field_kind = options.FieldKind;
            desc.engine = options.Engine;
            desc.channel_count = options.ChannelCount;
            desc.site_limit = options.SiteLimit;
            desc.penalty = options.Penalty;
            if (options.Progress != null) desc.progress = options.Progress.Handle;
            Make(Functions.hf_create, surface, "surface", &desc, Functions.hf_solver_destroy);
            GC.KeepAlive(options.Progress);
            VertexCount = surface.VertexCount;
            ChannelCount = (int)Info.channel_count;
        }

        /// <summary>A solver with the same sites, on the same factor.</summary>
        public Solver Clone()
        {
            var copy = new Solver { VertexCount = VertexCount, ChannelCount = ChannelCount };
            copy.Copy(Functions.hf_solver_clone, this, Functions.hf_solver_destroy);
            return copy;
        }

        /// <summary>The options it was made with, defaults filled in, and the number of its sites.</summary>
        public hf_solver_info Info { get { return Read<hf_solver_info>(Functions.hf_solver_get_info); } }

        public hf_solver_statistics Statistics { get { return Read<hf_solver_statistics>(Functions.hf_solver_get_statistics); } }

        hf_sites_desc Places(Pins pins, uint[] vertices, double[] values, double[] stiffness = null,
            double[] radii = null, uint[] triangles = null, double[] barycentrics = null, uint[] corners = null)
        {
            if (corners != null && corners.Length % 3 != 0)
                throw new HfException("corners must hold three vertices each, not " + corners.Length);
            bool between = corners != null && vertices == null && triangles == null;
            int count = between ? corners.Length / 3 : Pins.Count(vertices ?? triangles);
            var desc = new hf_sites_desc { struct_size = (uint)sizeof(hf_sites_desc) };
            desc.site_count = (uint)count;
            desc.vertices = pins.Add(vertices);
            desc.triangles = pins.Add(triangles);
            desc.corners = pins.Add(corners, 3 * count, "corners");
            desc.barycentrics = pins.Add(barycentrics, 3 * count, "barycentrics");
            desc.values = pins.Add(values, count * ChannelCount, "values");
            desc.stiffness = pins.Add(stiffness, count, "stiffness");
            desc.radii = pins.Add(radii, count, "radii");
            return desc;
        }

        /// <summary>Adds sites at vertices, inside triangles, or between three corners of a face; all or nothing.
        /// Returns their numbers.</summary>
        public uint[] AddSites(uint[] vertices, double[] values, double[] stiffness = null, double[] radii = null,
            uint[] triangles = null, double[] barycentrics = null, uint[] corners = null)
        {
            using (var pins = new Pins())
            {
                hf_sites_desc desc = Places(pins, vertices, values, stiffness, radii, triangles, barycentrics, corners);
                var numbers = new uint[desc.site_count];
                Check(Functions.hf_add_sites(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        /// <summary>Adds one hard site at a vertex: a value for each channel, none for 0. Returns its number.</summary>
        public uint AddSite(uint vertex, params double[] values)
        {
            if (values == null || values.Length == 0) values = new double[ChannelCount];
            Pins.Need(values.Length, ChannelCount, "values");
            uint number;
            fixed (double* place = values) Check(Functions.hf_solver_add_site(Handle, vertex, place, &number));
            return number;
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
                Check(Functions.hf_solver_move_sites(Handle, (uint)Pins.Count(sites), (void*)pins.Add(sites), &desc));
            }
        }

        public void SetValues(uint[] sites, double[] values)
        {
            OnList(Functions.hf_solver_set_values, sites, values, ChannelCount, "values");
        }

        /// <summary>(K + A H) u = A H p + W lambda: screening is H by vertex, targets is p, 0 if null. null removes the
        /// screening.</summary>
        public void SetScreening(double[] screening, double[] targets = null)
        {
            using (var pins = new Pins())
                Check(Functions.hf_solver_set_screening(Handle, (void*)pins.Add(screening, VertexCount, "screening"),
                    (void*)pins.Add(targets, VertexCount * ChannelCount, "targets")));
        }

        /// <summary>One batch: remove, move, set, add; all or nothing. Returns the numbers of the added
        /// sites.</summary>
        public uint[] EditSites(uint[] remove = null, uint[] move = null, uint[] moveTo = null, uint[] set = null,
            double[] setValues = null, uint[] add = null, double[] addValues = null)
        {
            using (var pins = new Pins())
            {
                var edit = new hf_edit_desc { struct_size = (uint)sizeof(hf_edit_desc) };
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
                Check(Functions.hf_solver_edit_sites(Handle, &edit, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        public int SiteCount { get { int count = (int)Functions.hf_solver_get_site_count(Handle); GC.KeepAlive(this);
            return count; } }
        internal override Recorded State() { return Clone(); }

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
                Check(Functions.hf_solver_solve_f64(Handle, place, 0, null));
        }

        public float[] Solve() { var field = new float[VertexCount * ChannelCount]; Solve(field.AsSpan());
            return field; }
        public double[] SolveDouble() { var field = new double[VertexCount * ChannelCount]; Solve(field.AsSpan());
            return field; }

        public double[] SolvePreview(uint correctionCount = 0)
        {
            var field = new double[VertexCount * ChannelCount];
            fixed (double* place = field)
                Check(Functions.hf_solver_solve_preview_f64(Handle, place, 0, correctionCount, null));
            return field;
        }

        public double[] SolveAt(uint[] vertices)
        {
            var values = new double[Pins.Count(vertices) * ChannelCount];
            using (var pins = new Pins())
                Check(Functions.hf_solver_solve_at(Handle, (uint)Pins.Count(vertices), (void*)pins.Add(vertices),
                (void*)pins.Add(values)));
            return values;
        }

        /// <summary>A tangent vector field from three channels: xyz per vertex.</summary>
        public double[] SolveVectors()
        {
            var vectors = new double[3 * VertexCount];
            fixed (double* place = vectors) Check(Functions.hf_solver_solve_vectors_f64(Handle, place, 0, null, null));
            return vectors;
        }

        /// <summary>Moves sites of a three-channel solver, carrying their vectors along the surface.</summary>
        public void MoveVectors(uint[] sites, uint[] vertices) { OnList(Functions.hf_solver_move_vectors, sites,
            vertices); }

        /// <summary>Turns the vectors of sites about the normals, radians.</summary>
        public void RotateVectors(uint[] sites, double[] angles) { OnList(Functions.hf_solver_rotate_vectors, sites,
            angles, 1, "angles"); }

        /// <summary>Measures the field on its own equations; throws when an error exceeds the tolerance (0: the
        /// default).</summary>
        public hf_certificate Certify(double tolerance = 0)
        {
            var certificate = new hf_certificate { struct_size = (uint)sizeof(hf_certificate) };
            certificate.tolerance = tolerance;
            Check(Functions.hf_solver_certify(Handle, &certificate));
            return certificate;
        }

        public void PrepareRebase() { Check(Functions.hf_solver_prepare_rebase(Handle)); }
        public void ReleasePreview() { Check(Functions.hf_solver_release_preview(Handle)); }
    }
}
