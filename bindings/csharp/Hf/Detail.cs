// Region and Detail over the C ABI (include/hf/region.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>One edit of a region; what is null or 0 is left out.</summary>
    public sealed class RegionEdit
    {
        /// <summary>Vertices of a closed curve: the region becomes what it encloses.</summary>
        public uint[] Curve;
        public int Side;
        public uint SeedVertex;
        /// <summary>HF_CURVE_STRAIGHT through triangles, HF_CURVE_EDGES along edges.</summary>
        public int CurveKind;
        /// <summary>Rings of vertices more, or less when below 0.</summary>
        public int Rings;
        public uint[] Add, Remove;
    }

    /// <summary>A region of a surface and its smooth base: a thin plate, or a membrane.</summary>
    public sealed unsafe class Region : Recorded
    {
        public int VertexCount { get; private set; }

        Region() { }

        /// <summary>positions: a pose of the surface to work on, xyz per vertex; null: its rest positions. baseKind:
        /// HF_BASE_*.</summary>
        public Region(Surface surface, double[] positions = null, int baseKind = Constants.HF_BASE_DEFAULT)
        {
            HandleOf(surface, "surface");
            using (var pins = new Pins())
            {
                var desc = new hf_region_desc { struct_size = (uint)sizeof(hf_region_desc) };
                desc.@base = baseKind;
                desc.positions_f64 = pins.Add(positions, 3 * surface.VertexCount, "positions");
                Make(Functions.hf_region_create, surface, "surface", &desc, Functions.hf_region_destroy);
            }
            VertexCount = surface.VertexCount;
        }

        public Region Clone()
        {
            var copy = new Region { VertexCount = VertexCount };
            copy.Copy(Functions.hf_region_clone, this, Functions.hf_region_destroy);
            return copy;
        }

        /// <summary>All or nothing; edits sites, factorises nothing.</summary>
        public void Edit(RegionEdit edit)
        {
            if (edit == null) throw new HfException("edit is null", Constants.HF_ERROR_NULL_POINTER);
            using (var pins = new Pins())
            {
                var desc = new hf_region_edit_desc { struct_size = (uint)sizeof(hf_region_edit_desc) };
                var curve = new hf_curve_desc { struct_size = (uint)sizeof(hf_curve_desc) };
                desc.ring_count = edit.Rings;
                if (edit.Curve != null)
                {
                    curve.point_count = (uint)edit.Curve.Length;
                    curve.vertices = pins.Add(edit.Curve);
                    curve.side = edit.Side;
                    curve.seed_vertex = edit.SeedVertex;
                    curve.kind = edit.CurveKind;
                    desc.curve = (IntPtr)(&curve);
                }
                desc.add_count = edit.Add == null ? 0 : (uint)edit.Add.Length;
                desc.add_vertices = pins.Add(edit.Add);
                desc.remove_count = edit.Remove == null ? 0 : (uint)edit.Remove.Length;
                desc.remove_vertices = pins.Add(edit.Remove);
                Check(Functions.hf_region_edit(Handle, &desc));
            }
        }

        internal override Recorded State() { return Clone(); }

        public hf_region_info Info { get { return Read<hf_region_info>(Functions.hf_region_get_info); } }

        /// <summary>list: HF_REGION_INSIDE, HF_REGION_RIM, HF_REGION_SITES.</summary>
        public uint[] Vertices(int list = Constants.HF_REGION_INSIDE)
        {
            return Rows<uint>((handle, capacity, rows, count) => Functions.hf_region_get_vertices(handle, list, capacity,
                rows, count));
        }

        /// <summary>xyz of the corners of the last closed curve, to draw it; the last is joined to the
        /// first.</summary>
        public double[] Curve()
        {
            uint count;
            Check(Functions.hf_region_get_curve(Handle, 0, null, &count));
            var points = new double[3 * count];
            if (count > 0)
                fixed (double* place = points) Check(Functions.hf_region_get_curve(Handle, count, place, &count));
            return points;
        }

        /// <summary>Weight 0: the surface, 1: its smooth base; between and beyond in proportion.</summary>
        public double[] Morph(double weight) { return Morphed(Functions.hf_region_morph, this, VertexCount, weight); }

        internal static double[] Morphed(Query call, HfObject thing, int vertexCount, double weight)
        {
            var positions = new double[3 * vertexCount];
            fixed (double* place = positions)
            {
                var desc = new hf_morph_desc { struct_size = (uint)sizeof(hf_morph_desc) };
                desc.weight = weight;
                desc.positions_f64 = (IntPtr)place;
                thing.Check(call(thing.Handle, &desc));
            }
            return positions;
        }
    }

    /// <summary>The detail of one region on the base of another.</summary>
    public sealed unsafe class Detail : HfObject
    {
        readonly int vertexCount;

        /// <summary>sourceVertices, targetVertices: points of the rims that correspond; scale 0: by the
        /// areas.</summary>
        public Detail(Region source, Region target, uint[] sourceVertices = null, uint[] targetVertices = null,
            double scale = 0)
        {
            int count = sourceVertices == null ? 0 : sourceVertices.Length;
            using (var pins = new Pins())
            {
                var desc = new hf_detail_desc { struct_size = (uint)sizeof(hf_detail_desc) };
                desc.pair_count = (uint)count;
                desc.source_vertices = pins.Add(sourceVertices);
                desc.target_vertices = pins.Add(targetVertices, count, "targetVertices");
                desc.scale = scale;
                IntPtr other = HandleOf(target, "target");
                Make((from, given, raw) => Functions.hf_detail_create(from, other, given, raw), source, "source", &desc,
                    Functions.hf_detail_destroy);
                GC.KeepAlive(target);
            }
            vertexCount = target.VertexCount;
        }

        /// <summary>Weight 0: the target's smooth base, 1: with the source's detail; more exaggerates.</summary>
        public double[] Morph(double weight) { return Region.Morphed(Functions.hf_detail_morph, this, vertexCount,
            weight); }
    }
}
