// Pose and Transfer over the C ABI (include/hf/deform.h, transfer.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>For linear blend skinning; the inverse bind matrix of a joint is the translation by minus its pivot.</summary>
    public sealed class Skin
    {
        public double[] Pivots, Rotations, Translations;
        public uint[] Joints;
        public float[] Weights;
        public int JointCount { get { return Pivots.Length / 3; } }

        internal unsafe delegate int Call(IntPtr handle, void* info);

        internal static unsafe Skin Get(HfObject owner, Call call, int vertexCount, uint weightCount)
        {
            hf_skin_info info;
            Functions.hf_init_desc(&info, (uint)sizeof(hf_skin_info));
            info.weight_count = weightCount;
            owner.Check(call(owner.Handle, &info));
            uint n = info.joint_count;
            var skin = new Skin { Pivots = new double[3 * n], Rotations = new double[4 * n], Translations = new double[3 * n], Joints = new uint[vertexCount * weightCount], Weights = new float[vertexCount * weightCount] };
            using (var pins = new Pins())
            {
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

    /// <summary>Handles on a solver's surface that come and go; every vertex follows.</summary>
    public sealed unsafe class Pose : HfObject
    {
        public int VertexCount { get; private set; }

        Pose() { }

        public Pose(Solver solver, int mode = Constants.HF_DEFORM_SMOOTH, uint bandCount = 0, uint iterationCount = 0, uint samplesPerRing = 0, uint groupCount = 0)
        {
            hf_pose_desc desc;
            Functions.hf_init_desc(&desc, (uint)sizeof(hf_pose_desc));
            desc.mode = mode;
            desc.band_count = bandCount;
            desc.iteration_count = iterationCount;
            desc.samples_per_ring = samplesPerRing;
            desc.group_count = groupCount;
            IntPtr raw;
            HfException.Check(Functions.hf_pose_create(HandleOf(solver, "solver"), &desc, &raw));
            GC.KeepAlive(solver);
            Own(raw, Functions.hf_pose_destroy);
            VertexCount = solver.VertexCount;
        }

        public Pose Clone()
        {
            IntPtr raw;
            Check(Functions.hf_pose_clone(Handle, &raw));
            var copy = new Pose { VertexCount = VertexCount };
            copy.Own(raw, Functions.hf_pose_destroy);
            return copy;
        }

        /// <summary>A handle per region of vertices; no factorisation. Returns their numbers.</summary>
        public uint[] AddHandles(uint[][] regions, uint layer = 0)
        {
            var lists = new Regions(regions, "regions");
            using (var pins = new Pins())
            {
                hf_handles_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_handles_desc));
                desc.handle_count = (uint)Pins.Count(lists.Counts);
                desc.region_counts = pins.Add(lists.Counts);
                desc.region_vertices = pins.Add(lists.Vertices);
                desc.layer = layer;
                var numbers = new uint[desc.handle_count];
                Check(Functions.hf_pose_add_handles(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        /// <summary>A handle per point: what hangs together with the nearest vertex within the radius.</summary>
        public uint[] AddHandles(double[] points, double[] radii, uint layer = 0)
        {
            if (points == null || points.Length % 3 != 0) throw new HfException("points must hold three numbers each");
            using (var pins = new Pins())
            {
                hf_handles_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_handles_desc));
                desc.handle_count = (uint)(points.Length / 3);
                desc.points = pins.Add(points);
                desc.radii = pins.Add(radii, points.Length / 3, "radii");
                desc.layer = layer;
                var numbers = new uint[desc.handle_count];
                Check(Functions.hf_pose_add_handles(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        public void RemoveHandles(uint[] handles)
        {
            using (var pins = new Pins()) Check(Functions.hf_pose_remove_handles(Handle, (uint)Pins.Count(handles), (void*)pins.Add(handles)));
        }

        /// <summary>Rigid motions from rest about the handles' centroids: quaternions x, y, z, w and translations, flat; null for none.</summary>
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
            using (var pins = new Pins()) Check(Functions.hf_pose_set_transforms(Handle, (uint)count, (void*)pins.Add(handles), (void*)pins.Add(packed)));
        }

        /// <summary>4 x 4 matrices rest to posed, column by column (as Unity's Matrix4x4 stores them).</summary>
        public void SetMatrices(uint[] handles, double[] matrices)
        {
            int count = Pins.Count(handles);
            using (var pins = new Pins())
                Check(Functions.hf_pose_set_matrices(Handle, (uint)count, (void*)pins.Add(handles), (void*)pins.Add(matrices, 16 * count, "matrices")));
        }

        public hf_handle_info HandleInfo(uint handle)
        {
            hf_handle_info info;
            Functions.hf_init_desc(&info, (uint)sizeof(hf_handle_info));
            Check(Functions.hf_pose_get_handle(Handle, handle, &info));
            return info;
        }

        public int HandleCount { get { int count = (int)Functions.hf_pose_get_handle_count(Handle); GC.KeepAlive(this); return count; } }

        public float[] HandleField(uint handle)
        {
            var field = new float[VertexCount];
            fixed (float* place = field) Check(Functions.hf_pose_get_field(Handle, handle, place, 0));
            return field;
        }

        /// <summary>Solves the pose into the caller's memory: xyz per vertex; normals the same, or empty.</summary>
        public void Deform(Span<float> positions, Span<float> normals = default(Span<float>), uint iterationCount = 0, bool restart = false, bool refine = false)
        {
            Pins.Need(positions.Length, 3 * VertexCount, "positions");
            if (normals.Length > 0) Pins.Need(normals.Length, 3 * VertexCount, "normals");
            fixed (float* place = &MemoryMarshal.GetReference(positions))
            fixed (float* upright = &MemoryMarshal.GetReference(normals))
            {
                hf_deform_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_deform_desc));
                desc.positions = (IntPtr)place;
                if (normals.Length > 0) desc.normals = (IntPtr)upright;
                desc.iteration_count = iterationCount;
                desc.restart = restart ? 1 : 0;
                desc.refine = refine ? 1 : 0;
                Check(Functions.hf_deform(Handle, &desc, null));
            }
        }

        public double[] DeformDouble(uint iterationCount = 0, bool restart = false, bool refine = false)
        {
            var positions = new double[3 * VertexCount];
            fixed (double* place = positions)
            {
                hf_deform_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_deform_desc));
                desc.positions_f64 = (IntPtr)place;
                desc.iteration_count = iterationCount;
                desc.restart = restart ? 1 : 0;
                desc.refine = refine ? 1 : 0;
                Check(Functions.hf_deform(Handle, &desc, null));
            }
            return positions;
        }

        public Skin Skin(uint weightCount = 4) { return Hf.Skin.Get(this, Functions.hf_pose_get_skin, VertexCount, weightCount); }
    }

    /// <summary>The motion of one surface played on another.</summary>
    public sealed unsafe class Transfer : HfObject
    {
        readonly int sourceCount, targetCount;

        public Transfer(Solver source, Solver target, int mode = Constants.HF_TRANSFER_FIELDS, float scale = 0)
        {
            hf_transfer_desc desc;
            Functions.hf_init_desc(&desc, (uint)sizeof(hf_transfer_desc));
            desc.mode = mode;
            desc.scale = scale;
            IntPtr raw;
            HfException.Check(Functions.hf_transfer_create(HandleOf(source, "source"), HandleOf(target, "target"), &desc, &raw));
            GC.KeepAlive(source);
            GC.KeepAlive(target);
            Own(raw, Functions.hf_transfer_destroy);
            sourceCount = source.VertexCount;
            targetCount = target.VertexCount;
        }

        public uint[] AddPairs(uint[][] sourceRegions, uint[][] targetRegions, uint[] flags = null)
        {
            Regions source = new Regions(sourceRegions, "sourceRegions"), target = new Regions(targetRegions, "targetRegions");
            if (source.Counts == null || target.Counts == null || source.Counts.Length != target.Counts.Length) throw new HfException("sourceRegions and targetRegions must be of one length");
            using (var pins = new Pins())
            {
                hf_pairs_desc desc;
                Functions.hf_init_desc(&desc, (uint)sizeof(hf_pairs_desc));
                desc.pair_count = (uint)source.Counts.Length;
                desc.source_counts = pins.Add(source.Counts);
                desc.source_vertices = pins.Add(source.Vertices);
                desc.target_counts = pins.Add(target.Counts);
                desc.target_vertices = pins.Add(target.Vertices);
                desc.flags = pins.Add(flags, source.Counts.Length, "flags");
                var numbers = new uint[desc.pair_count];
                Check(Functions.hf_transfer_add_pairs(Handle, &desc, (void*)pins.Add(numbers)));
                return numbers;
            }
        }

        public void RemovePairs(uint[] pairs)
        {
            using (var pins = new Pins()) Check(Functions.hf_transfer_remove_pairs(Handle, (uint)Pins.Count(pairs), (void*)pins.Add(pairs)));
        }

        public hf_transfer_info Info
        {
            get
            {
                hf_transfer_info info;
                Functions.hf_init_desc(&info, (uint)sizeof(hf_transfer_info));
                Check(Functions.hf_transfer_get_info(Handle, &info));
                return info;
            }
        }

        /// <summary>One posed frame of the source into the target's positions.</summary>
        public double[] Apply(double[] sourcePositions)
        {
            var positions = new double[3 * targetCount];
            using (var pins = new Pins())
            {
                hf_transfer_frame frame;
                Functions.hf_init_desc(&frame, (uint)sizeof(hf_transfer_frame));
                frame.source_positions_f64 = pins.Add(sourcePositions, 3 * sourceCount, "sourcePositions");
                frame.target_positions_f64 = pins.Add(positions);
                Check(Functions.hf_transfer_apply(Handle, &frame));
            }
            return positions;
        }

        public void Apply(ReadOnlySpan<float> sourcePositions, Span<float> positions)
        {
            Pins.Need(sourcePositions.Length, 3 * sourceCount, "sourcePositions");
            Pins.Need(positions.Length, 3 * targetCount, "positions");
            fixed (float* from = &MemoryMarshal.GetReference(sourcePositions))
            fixed (float* to = &MemoryMarshal.GetReference(positions))
            {
                hf_transfer_frame frame;
                Functions.hf_init_desc(&frame, (uint)sizeof(hf_transfer_frame));
                frame.source_positions = (IntPtr)from;
                frame.target_positions = (IntPtr)to;
                Check(Functions.hf_transfer_apply(Handle, &frame));
            }
        }

        public Skin Skin(uint weightCount = 4) { return Hf.Skin.Get(this, Functions.hf_transfer_get_skin, targetCount, weightCount); }
    }
}
