// Geodesics and Direction over the C ABI (include/hf/analysis.h, direction.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>Distances along a surface.</summary>
    public sealed unsafe class Geodesics : HfObject
    {
        readonly int vertexCount;

        public Geodesics(Surface surface, float smoothing = 0, int method = 0)
        {
            var desc = new hf_geodesics_desc { struct_size = (uint)sizeof(hf_geodesics_desc) };
            desc.smoothing = smoothing;
            desc.method = method; // HF_GEODESICS_*
            Make((parent, given, raw) => Functions.hf_geodesics_create(parent, given, raw), surface, "surface", &desc,
                Functions.hf_geodesics_destroy);
            vertexCount = surface.VertexCount;
        }

        /// <summary>From every vertex to the nearest source; -1 where none can be reached.</summary>
        public double[] Distance(uint[] sources)
        {
            var distances = new double[vertexCount];
            fixed (double* place = distances)
            {
                double* at = place;
                OnList((handle, count, numbers) => Functions.hf_geodesics_solve_f64(handle, count, numbers, at, 0),
                    sources);
            }
            return distances;
        }
    }

    /// <summary>The constraints of a direction field: vectors are xyz for each.</summary>
    public sealed class DirectionSites
    {
        public uint[] Sites, Vertices;
        public double[] Vectors;
    }

    /// <summary>A field of vectors, lines or crosses (degree 1, 2, 4) with constraints and singularities.</summary>
    public sealed unsafe class Direction : HfObject
    {
        int vertexCount;

        Direction() { }

        public Direction(Surface surface, uint degree = 1, uint siteLimit = 0)
        {
            var desc = new hf_direction_desc { struct_size = (uint)sizeof(hf_direction_desc) };
            desc.degree = degree;
            desc.site_limit = siteLimit;
            Make(Functions.hf_direction_create, surface, "surface", &desc, Functions.hf_direction_destroy);
            vertexCount = surface.VertexCount;
        }

        /// <summary>A direction field with the same constraints; shares connection and factor.</summary>
        public Direction Clone()
        {
            var copy = new Direction { vertexCount = vertexCount };
            copy.Copy(Functions.hf_direction_clone, this, Functions.hf_direction_destroy);
            return copy;
        }

        /// <summary>Vectors at vertices, xyz each. Returns their numbers.</summary>
        public uint[] AddSites(uint[] vertices, double[] vectors)
        {
            var numbers = new uint[Pins.Count(vertices)];
            fixed (uint* place = numbers)
            {
                uint* at = place;
                OnList((handle, count, given, values) => Functions.hf_direction_add_sites(handle, count, given, values,
                    at), vertices, vectors, 3, "vectors");
            }
            return numbers;
        }

        public void RemoveSites(uint[] sites) { OnList(Functions.hf_direction_remove_sites, sites); }

        /// <summary>Moves constraints, carrying their vectors along the surface.</summary>
        public void MoveSites(uint[] sites, uint[] vertices) { OnList(Functions.hf_direction_move_sites, sites,
            vertices); }

        public void SetVectors(uint[] sites, double[] vectors) { OnList(Functions.hf_direction_set_vectors, sites,
            vectors, 3, "vectors"); }

        /// <summary>Turns constraints about the normals, radians.</summary>
        public void RotateSites(uint[] sites, double[] angles) { OnList(Functions.hf_direction_rotate_sites, sites,
            angles, 1, "angles"); }

        public void Record() { Check(Functions.hf_direction_record(Handle)); }
        public void Undo() { Check(Functions.hf_direction_undo(Handle)); }
        public void Redo() { Check(Functions.hf_direction_redo(Handle)); }

        public int SiteCount
        {
            get
            {
                int count = (int)Functions.hf_direction_get_site_count(Handle);
                GC.KeepAlive(this);
                return count;
            }
        }

        public DirectionSites Sites()
        {
            int n = SiteCount;
            var found = new DirectionSites { Sites = new uint[n], Vertices = new uint[n], Vectors = new double[3 * n] };
            using (var pins = new Pins())
                Check(Functions.hf_direction_get_sites(Handle, (uint)n, (void*)pins.Add(found.Sites),
                    (void*)pins.Add(found.Vertices), (void*)pins.Add(found.Vectors), null));
            return found;
        }

        public hf_direction_statistics Statistics { get { return Read<hf_direction_statistics>(Functions.hf_direction_get_statistics); } }

        /// <summary>The field as vectors, xyz per vertex.</summary>
        public double[] Solve()
        {
            var vectors = new double[3 * vertexCount];
            fixed (double* place = vectors) Check(Functions.hf_direction_solve_f64(Handle, place, 0, null));
            return vectors;
        }

        public hf_singularity[] Singularities() {
            return Rows<hf_singularity>(Functions.hf_direction_get_singularities); }
    }
}
