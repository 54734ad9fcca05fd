// Weights over the C ABI (include/hf/weights.h): skin weights from joints, carried, mirrored.
using System;
using System.Runtime.InteropServices;
using System.Text;
using Hf.Native;

namespace Hf
{
    /// <summary>The joints of a skeleton, in the unit and frame of the mesh. Heads, Tails, Axes: three numbers for each
    /// joint; what is null is found or has its default.</summary>
    public sealed class Joints
    {
        public double[] Heads, Tails, Axes;
        /// <summary>The number of each joint's parent, HF_NO_INDEX for a root.</summary>
        public uint[] Parents;
        /// <summary>1: the joint gets weights.</summary>
        public int[] Deforms;
        /// <summary>For SetJoints: the number each joint had before, HF_NO_INDEX for a new one.</summary>
        public uint[] Sources;
        public Progress Progress;
    }

    /// <summary>Joints and weights, InfluenceCount for each vertex. Origins: HF_WEIGHTS_*.</summary>
    public sealed class VertexWeights
    {
        public int InfluenceCount;
        public uint[] Joints;
        public float[] Weights;
        public byte[] Origins;
    }

    /// <summary>How weights are carried and mirrored; 0 is the library's own.</summary>
    public class WeightTransferOptions
    {
        public double Distance, Angle;
        public uint InfluenceCount = 4;
        public Progress Progress;
    }

    /// <summary>Names pair the joints; Partners: HF_NO_INDEX: find it; Plane: a point and a normal, null: find it.
    /// To: HF_MIRROR_*.</summary>
    public sealed class MirrorOptions : WeightTransferOptions
    {
        public string[] Names;
        public uint[] Partners;
        public double[] Plane;
        public int To;
    }

    /// <summary>Mirrored weights, the partner of each joint, and how it was found (HF_MIRROR_JOINT_*).</summary>
    public sealed class MirroredWeights
    {
        public VertexWeights Weights;
        public uint[] Partners, Pairings;
        public hf_weights_mirror_info Info;
    }

    /// <summary>Skin weights of a surface for a skeleton.</summary>
    public sealed unsafe class Weights : Recorded
    {
        public int VertexCount { get; private set; }

        Weights() { }

        /// <summary>influenceCount: joints per vertex, 4 or 8.</summary>
        public Weights(Surface surface, Joints joints, uint influenceCount = 4)
        {
            HandleOf(surface, "surface");
            using (var pins = new Pins())
            {
                hf_joints_desc desc = Describe(joints, pins);
                Make((parent, given, raw) => Functions.hf_weights_create(parent, given, influenceCount, raw), surface,
                    "surface", &desc, Functions.hf_weights_destroy);
                GC.KeepAlive(joints);
            }
            VertexCount = surface.VertexCount;
        }

        public Weights Clone()
        {
            var copy = new Weights { VertexCount = VertexCount };
            copy.Copy(Functions.hf_weights_clone, this, Functions.hf_weights_destroy);
            return copy;
        }

        /// <summary>Moves, adds and removes joints. Pins and locks keep theirs.</summary>
        public void SetJoints(Joints joints)
        {
            using (var pins = new Pins())
            {
                hf_joints_desc desc = Describe(joints, pins);
                Check(Functions.hf_weights_set_joints(Handle, &desc));
                GC.KeepAlive(joints);
            }
        }

        /// <summary>Replaces all pins: vertices with given weights, as many joints and weights for each.</summary>
        public void SetPins(uint[] vertices, uint[] joints = null, float[] weights = null, double[] radii = null)
        {
            int count = vertices == null ? 0 : vertices.Length;
            int each = count == 0 || joints == null ? 0 : joints.Length / count;
            if (count > 0 && joints != null) Hf.Pins.Need(joints.Length, each * count, "joints");
            using (var pins = new Pins())
            {
                var desc = new hf_pins_desc { struct_size = (uint)sizeof(hf_pins_desc) };
                desc.pin_count = (uint)count;
                desc.influence_count = (uint)each;
                desc.vertices = pins.Add(vertices);
                desc.joints = pins.Add(joints);
                desc.weights = pins.Add(weights, each * count, "weights");
                desc.radii = pins.Add(radii, count, "radii");
                Check(Functions.hf_weights_set_pins(Handle, &desc));
            }
        }

        /// <summary>Locks joints: their weights stay. values: a number for each vertex and lock; null: the present ones.
        /// Replaces all locks.</summary>
        public void SetLocks(uint[] joints, float[] values = null)
        {
            int count = joints == null ? 0 : joints.Length;
            using (var pins = new Pins())
                Check(Functions.hf_weights_set_locks(Handle, (uint)count, (void*)pins.Add(joints),
                    (void*)pins.Add(values, count * VertexCount, "values")));
        }

        public VertexWeights Get()
        {
            var ask = new hf_weights_out { struct_size = (uint)sizeof(hf_weights_out) };
            Check(Functions.hf_weights_get(Handle, &ask));
            return Filled(VertexCount, ask.influence_count, place => Functions.hf_weights_get(Handle, place));
        }

        /// <summary>Bits HF_JOINT_* of each joint.</summary>
        public uint[] JointFlags()
        {
            return Rows<uint>((handle, capacity, rows, count) => Functions.hf_weights_get_joints(handle, capacity, rows,
                null, count));
        }

        /// <summary>Bits HF_HELPER_* of each joint: why it looks like a helper. names: of the joints, or null.</summary>
        public uint[] Helpers(string[] names = null)
        {
            using (var pins = new Pins())
            {
                var lines = (void*)pins.Add(Lines(names));
                return Rows<uint>((handle, capacity, rows, count) => Functions.hf_weights_get_helpers(handle,
                    rows == null ? null : lines, capacity, rows, count));
            }
        }

        public hf_weights_info Info { get { return Read<hf_weights_info>(Functions.hf_weights_get_info); } }

        internal override Recorded State() { return Clone(); }

        /// <summary>Carries weights to another surface: clothes, levels of detail. joints, weights: as many for each
        /// vertex of the source.</summary>
        public static VertexWeights Transfer(Surface source, uint[] joints, float[] weights, Surface target,
            out hf_weights_transfer_info info, WeightTransferOptions options = null)
        {
            options = options ?? new WeightTransferOptions();
            IntPtr from = HandleOf(source, "source"), to = HandleOf(target, "target");
            var found = new hf_weights_transfer_info { struct_size = (uint)sizeof(hf_weights_transfer_info) };
            hf_weights_transfer_info* counts = &found;
            using (var pins = new Pins())
            {
                var desc = new hf_weights_transfer_desc { struct_size = (uint)sizeof(hf_weights_transfer_desc) };
                desc.source_influence_count = Influences(joints, source.VertexCount);
                desc.joints = pins.Add(joints);
                desc.weights = pins.Add(weights, joints.Length, "weights");
                desc.distance = options.Distance;
                desc.angle = options.Angle;
                desc.influence_count = options.InfluenceCount;
                if (options.Progress != null) desc.progress = options.Progress.Handle;
                hf_weights_transfer_desc* given = &desc;
                VertexWeights carried = Filled(target.VertexCount, options.InfluenceCount,
                    place => Functions.hf_weights_transfer(from, to, given, place, counts));
                GC.KeepAlive(source);
                GC.KeepAlive(target);
                GC.KeepAlive(options);
                info = found;
                return carried;
            }
        }

        /// <summary>Mirrors the weights of one side to the other. heads: three numbers for each joint.</summary>
        public static MirroredWeights Mirror(Surface surface, uint[] joints, float[] weights, double[] heads,
            MirrorOptions options = null)
        {
            options = options ?? new MirrorOptions();
            IntPtr on = HandleOf(surface, "surface");
            int count = heads == null ? 0 : heads.Length / 3;
            if (heads != null) Hf.Pins.Need(heads.Length, 3 * count, "heads");
            if (options.Names != null) Hf.Pins.Need(options.Names.Length, count, "Names");
            var made = new MirroredWeights { Partners = new uint[count], Pairings = new uint[count] };
            var info = new hf_weights_mirror_info { struct_size = (uint)sizeof(hf_weights_mirror_info) };
            hf_weights_mirror_info* figures = &info;
            using (var pins = new Pins())
            {
                var desc = new hf_weights_mirror_desc { struct_size = (uint)sizeof(hf_weights_mirror_desc) };
                desc.joint_count = (uint)count;
                desc.heads = pins.Add(heads);
                desc.names = pins.Add(Lines(options.Names));
                desc.partners = pins.Add(options.Partners, count, "Partners");
                desc.plane = pins.Add(options.Plane, 6, "Plane");
                desc.source_influence_count = Influences(joints, surface.VertexCount);
                desc.to = options.To;
                desc.joints = pins.Add(joints);
                desc.weights = pins.Add(weights, joints.Length, "weights");
                desc.distance = options.Distance;
                desc.angle = options.Angle;
                desc.influence_count = options.InfluenceCount;
                if (options.Progress != null) desc.progress = options.Progress.Handle;
                hf_weights_mirror_desc* given = &desc;
                void* partners = (void*)pins.Add(made.Partners);
                void* pairings = (void*)pins.Add(made.Pairings);
                made.Weights = Filled(surface.VertexCount, options.InfluenceCount,
                    place => Functions.hf_weights_mirror(on, given, place, partners, pairings, figures));
                GC.KeepAlive(surface);
                GC.KeepAlive(options);
            }
            made.Info = info;
            return made;
        }

        delegate int Fill(void* place);

        /// <summary>Arrays for all vertices, filled by a call.</summary>
        static VertexWeights Filled(int vertexCount, uint influenceCount, Fill call)
        {
            int each = influenceCount == 0 ? 4 : (int)influenceCount;
            var found = new VertexWeights { InfluenceCount = each, Joints = new uint[vertexCount * each],
                Weights = new float[vertexCount * each], Origins = new byte[vertexCount] };
            using (var pins = new Pins())
            {
                var place = new hf_weights_out { struct_size = (uint)sizeof(hf_weights_out) };
                place.vertex_capacity = (uint)vertexCount;
                place.joints = pins.Add(found.Joints);
                place.weights = pins.Add(found.Weights);
                place.origins = pins.Add(found.Origins);
                HfException.Check(call(&place));
            }
            return found;
        }

        static hf_joints_desc Describe(Joints joints, Pins pins)
        {
            if (joints == null) throw new HfException("joints is null", Constants.HF_ERROR_NULL_POINTER);
            int count = joints.Heads == null ? 1 : joints.Heads.Length / 3;
            if (joints.Heads != null) Hf.Pins.Need(joints.Heads.Length, 3 * count, "Heads");
            var desc = new hf_joints_desc { struct_size = (uint)sizeof(hf_joints_desc) };
            desc.joint_count = (uint)count;
            desc.heads = pins.Add(joints.Heads);
            desc.tails = pins.Add(joints.Tails, 3 * count, "Tails");
            desc.axes = pins.Add(joints.Axes, 3 * count, "Axes");
            desc.parents = pins.Add(joints.Parents, count, "Parents");
            desc.deforms = pins.Add(joints.Deforms, count, "Deforms");
            desc.sources = pins.Add(joints.Sources, count, "Sources");
            if (joints.Progress != null) desc.progress = joints.Progress.Handle;
            return desc;
        }

        /// <summary>Joints of each vertex in a list of all.</summary>
        static uint Influences(uint[] joints, int vertexCount)
        {
            if (joints == null) throw new HfException("joints is null", Constants.HF_ERROR_NULL_POINTER);
            int each = vertexCount == 0 ? 0 : joints.Length / vertexCount;
            Hf.Pins.Need(joints.Length, each * vertexCount, "joints");
            return (uint)each;
        }

        /// <summary>Names as the library takes them: one line for each, and a 0 at the end.</summary>
        static byte[] Lines(string[] names)
        {
            if (names == null) return null;
            var text = new StringBuilder();
            foreach (string name in names) text.Append((name ?? "").Replace('\n', ' ').Replace('\0', ' ')).Append('\n');
            return Encoding.UTF8.GetBytes(text.Append('\0').ToString());
        }
    }
}
