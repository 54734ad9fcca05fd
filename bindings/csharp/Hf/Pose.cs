// Pose over the C ABI (include/hf/pose.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>For linear blend skinning; the inverse bind matrix of a joint is the translation by minus its
    /// pivot.</summary>
    public sealed class Skin
    {
        public double[] Pivots, Rotations, Translations;
        public uint[] Joints;
        public float[] Weights;
        public int JointCount { get { return Pivots.Length / 3; } }

        internal unsafe delegate int Call(IntPtr handle, void* info);

        internal static unsafe Skin Get(HfObject owner, Call call, int vertexCount, uint influenceCount)
        {
            var info = new hf_skin_info { struct_size = (uint)sizeof(hf_skin_info) };
            info.influence_count = influenceCount;
            owner.Check(call(owner.Handle, &info));
            uint n = info.joint_count;
            var skin = new Skin { Pivots = new double[3 * n], Rotations = new double[4 * n],
                Translations = new double[3 * n], Joints = new uint[vertexCount * influenceCount],
                Weights = new float[vertexCount * influenceCount] };
            using (var pins = new Pins())
            {
                info.joint_capacity = n;
                info.vertex_capacity = (uint)vertexCount;
                info.pivots = pins.Add(skin.Pivots);
                info.rotations = pins.Add(skin.Rotations);
                info.translations = pins.Add(skin.Translations);
                info.vertex_joints = pins.Add(skin.Joints);
                info.vertex_weights = pins.Add(skin.Weights);
                owner.Check(call(owner.Handle, &info));
            }
            return skin;
        }
    }

    /// <summary>Handles on a surface that come and go; every vertex follows.</summary>
    public sealed unsafe class Pose : HfObject
    {
        public int VertexCount { get; private set; }

        Pose() { }

        public Pose(Surface surface, int mode = Constants.HF_DEFORM_SMOOTH, uint bandCount = 0, uint iterationCount = 0,
            uint rimSiteCount = 0, uint groupCount = 0)
        {
            var desc = new hf_pose_desc { struct_size = (uint)sizeof(hf_pose_desc) };
            desc.mode = mode;
            desc.band_count = bandCount;
            desc.iteration_count = iterationCount;
            desc.rim_site_count = rimSiteCount;
            desc.group_count = groupCount;
            Make(Functions.hf_pose_create, surface, "surface", &desc, Functions.hf_pose_destroy);
            VertexCount = surface.VertexCount;
        }

        /// <summary>The options it was made with, defaults filled in, and the number of its handles.</summary>
        public hf_pose_info Info { get { return Read<hf_pose_info>(Functions.hf_pose_get_info); } }

        public Pose Clone()
        {
            var copy = new Pose { VertexCount = VertexCount };
            copy.Copy(Functions.hf_pose_clone, this, Functions.hf_pose_destroy);
            return copy;
        }

        /// <summary>A handle for each region of vertices; no factorisation. Returns their numbers. inPlace: the handles
        /// start where the posed surface stands, not at rest; HandleInfo says where.</summary>
        public uint[] AddHandles(uint[][] regions, uint layer = 0, bool inPlace = false)
        {
            var lists = new Regions(regions, "regions");
            using (var pins = new Pins())
            {
                var desc = new hf_handles_desc { struct_size = (uint)sizeof(hf_handles_desc) };
                desc.handle_count = (uint)Pins.Count(lists.Counts);
                desc.region_counts = pins.Add(lists.Counts);
                desc.region_vertices = pins.Add(lists.Vertices);
                desc.layer = layer;
                desc.in_place = inPlace ? 1 : 0;
                var numbers = new uint[desc.handle_count];
                Check(Functions.hf_pose_add_handles(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        /// <summary>A handle for each point: what is edge-connected to the nearest vertex within the radius.
        /// inPlace: as with regions.</summary>
        public uint[] AddHandles(double[] points, double[] radii, uint layer = 0, bool inPlace = false)
        {
            if (points == null || points.Length % 3 != 0) throw new HfException("points must hold three numbers each");
            using (var pins = new Pins())
            {
                var desc = new hf_handles_desc { struct_size = (uint)sizeof(hf_handles_desc) };
                desc.handle_count = (uint)(points.Length / 3);
                desc.points = pins.Add(points);
                desc.radii = pins.Add(radii, points.Length / 3, "radii");
                desc.layer = layer;
                desc.in_place = inPlace ? 1 : 0;
                var numbers = new uint[desc.handle_count];
                Check(Functions.hf_pose_add_handles(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        /// <summary>One handle on layer 0: what is edge-connected within the radius of a point at rest. Returns its
        /// number.</summary>
        public uint AddHandleAt(double[] point, double radius)
        {
            uint number;
            using (var pins = new Pins())
                Check(Functions.hf_pose_add_handle_at(Handle, (void*)pins.Add(point, 3, "point"), radius, &number));
            return number;
        }

        public void RemoveHandles(uint[] handles)
        {
            OnList(Functions.hf_pose_remove_handles, handles);
        }

        /// <summary>Rigid motions from rest about the handles' centroids: quaternions x, y, z, w and translations,
        /// flat; null for none.</summary>
        public void SetTransforms(uint[] handles, double[] rotations, double[] translations)
        {
            int count = Pins.Count(handles);
            if (rotations != null) Pins.Need(rotations.Length, 4 * count, "rotations");
            if (translations != null) Pins.Need(translations.Length, 3 * count, "translations");
            var packed = new double[7 * count];
            for (int i = 0; i < count; ++i)
            {
                if (rotations != null) Array.Copy(rotations, 4 * i, packed, 7 * i, 4);
                if (translations != null) Array.Copy(translations, 3 * i, packed, 7 * i + 4, 3);
            }
            using (var pins = new Pins())
                Check(Functions.hf_pose_set_transforms(Handle, (uint)count, (void*)pins.Add(handles),
                (void*)pins.Add(packed)));
        }

        /// <summary>One handle: a quaternion x, y, z, w and a translation; null for none.</summary>
        public void SetTransform(uint handle, double[] rotation, double[] translation)
        {
            if (rotation != null) Pins.Need(rotation.Length, 4, "rotation");
            if (translation != null) Pins.Need(translation.Length, 3, "translation");
            hf_transform transform;
            for (int i = 0; i < 4; ++i) transform.rotation[i] = rotation == null ? 0 : rotation[i];
            for (int i = 0; i < 3; ++i) transform.translation[i] = translation == null ? 0 : translation[i];
            Check(Functions.hf_pose_set_transform(Handle, handle, &transform));
        }

        /// <summary>4 x 4 matrices rest to posed, column by column (as Unity's Matrix4x4 stores them).</summary>
        public void SetMatrices(uint[] handles, double[] matrices) { OnList(Functions.hf_pose_set_matrices, handles,
            matrices, 16, "matrices"); }

        public hf_handle_info HandleInfo(uint handle)
        {
            var info = new hf_handle_info { struct_size = (uint)sizeof(hf_handle_info) };
            Check(Functions.hf_pose_get_handle(Handle, handle, &info));
            return info;
        }

        public int HandleCount { get { int count = (int)Functions.hf_pose_get_handle_count(Handle); GC.KeepAlive(this);
            return count; } }

        public float[] HandleField(uint handle)
        {
            var field = new float[VertexCount];
            fixed (float* place = field) Check(Functions.hf_pose_get_field(Handle, handle, place, 0));
            return field;
        }

        /// <summary>Solves the pose into the caller's memory, xyz for each vertex (hf_deform).</summary>
        public void Deform(Span<float> positions)
        {
            Pins.Need(positions.Length, 3 * VertexCount, "positions");
            fixed (float* place = &MemoryMarshal.GetReference(positions)) Check(Functions.hf_deform(Handle, place, null));
        }

        /// <summary>The same with normals (or an empty span) and options.</summary>
        public void Deform(Span<float> positions, Span<float> normals, uint iterationCount = 0,
            bool restart = false, int refine = 0, bool refineFromLast = false)
        {
            Pins.Need(positions.Length, 3 * VertexCount, "positions");
            if (normals.Length > 0) Pins.Need(normals.Length, 3 * VertexCount, "normals");
            fixed (float* place = &MemoryMarshal.GetReference(positions))
            fixed (float* upright = &MemoryMarshal.GetReference(normals))
            {
                var desc = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc) };
                desc.positions = (IntPtr)place;
                if (normals.Length > 0) desc.normals = (IntPtr)upright;
                desc.iteration_count = iterationCount;
                desc.restart = restart ? 1 : 0;
                desc.refine = refine;
                desc.refine_from_last = refineFromLast ? 1 : 0;
                Check(Functions.hf_pose_deform(Handle, &desc, null));
            }
        }

        public double[] DeformDouble(uint iterationCount = 0, bool restart = false, int refine = 0, bool refineFromLast = false)
        {
            var positions = new double[3 * VertexCount];
            fixed (double* place = positions)
            {
                var desc = new hf_deform_desc { struct_size = (uint)sizeof(hf_deform_desc) };
                desc.positions_f64 = (IntPtr)place;
                desc.iteration_count = iterationCount;
                desc.restart = restart ? 1 : 0;
                desc.refine = refine;
                desc.refine_from_last = refineFromLast ? 1 : 0;
                Check(Functions.hf_pose_deform(Handle, &desc, null));
            }
            return positions;
        }

        public Skin Skin(uint influenceCount = 4) { return Hf.Skin.Get(this, Functions.hf_pose_get_skin, VertexCount,
            influenceCount); }
    }
}
