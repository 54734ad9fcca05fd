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

        public Geodesics(Surface surface, double smoothing = 0, int method = 0)
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

        /// <summary>The shortest path between two places: xyz of its corners; empty where none leads.</summary>
        public double[] Path(Place from, Place to)
        {
            hf_surface_point start = Place.Of(from, "from"), end = Place.Of(to, "to");
            var path = new hf_path { struct_size = (uint)sizeof(hf_path) };
            Check(Functions.hf_geodesics_find_path(Handle, &start, &end, &path));
            var positions = new double[3 * path.point_count];
            fixed (double* place = positions)
            {
                path.point_capacity = path.point_count;
                path.positions = (IntPtr)place;
                Check(Functions.hf_geodesics_find_path(Handle, &start, &end, &path));
            }
            return positions;
        }

        /// <summary>The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius
        /// (0: no bound).</summary>
        public double[] Map(Place centre, double radius = 0)
        {
            hf_surface_point point = Place.Of(centre, "centre");
            var coordinates = new double[2 * vertexCount];
            fixed (double* at = coordinates) Check(Functions.hf_geodesics_get_map(Handle, &point, radius, at, null));
            return coordinates;
        }
    }

    /// <summary>A place on a surface: a vertex, or three corners of a triangle and their barycentrics.</summary>
    public sealed class Place
    {
        public readonly uint[] Corners;
        public readonly double[] Barycentrics;

        public Place(uint[] corners, double[] barycentrics)
        {
            if (corners == null || corners.Length != 3 || barycentrics == null || barycentrics.Length != 3)
                throw new HfException("a place has three corners and three barycentrics");
            Corners = corners;
            Barycentrics = barycentrics;
        }

        public static implicit operator Place(uint vertex)
        {
            return new Place(new[] { vertex, vertex, vertex }, new[] { 1.0, 0.0, 0.0 });
        }

        public static implicit operator Place(Hit hit)
        {
            return hit == null ? null : new Place(hit.Corners, hit.Barycentrics);
        }

        internal static unsafe hf_surface_point Of(Place place, string name)
        {
            if (place == null) throw new HfException(name + " is null", Constants.HF_ERROR_NULL_POINTER);
            var point = new hf_surface_point();
            for (int k = 0; k < 3; ++k)
            {
                point.corners[k] = place.Corners[k];
                point.barycentrics[k] = place.Barycentrics[k];
            }
            return point;
        }
    }

    /// <summary>The constraints of a direction field: vectors are xyz for each.</summary>
    public sealed class DirectionSites
    {
        public uint[] Sites, Vertices;
        public double[] Vectors;
    }

    /// <summary>A field of vectors, lines or crosses (degree 1, 2, 4) with constraints and singularities.</summary>
    public sealed unsafe class Direction : Recorded
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

        internal override Recorded State() { return Clone(); }

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
