// Transfer over the C ABI (include/hf/transfer.h).
using System;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
    /// <summary>The motion of one surface played on another.</summary>
    public sealed unsafe class Transfer : HfObject
    {
        readonly int sourceCount, targetCount;

        public Transfer(Surface source, Surface target, int mode = Constants.HF_TRANSFER_FIELDS, double scale = 0)
        {
            var desc = new hf_transfer_desc { struct_size = (uint)sizeof(hf_transfer_desc) };
            desc.mode = mode;
            desc.scale = scale;
            IntPtr raw;
            HfException.Check(Functions.hf_transfer_create(HandleOf(source, "source"), HandleOf(target, "target"),
                &desc, &raw));
            GC.KeepAlive(source);
            GC.KeepAlive(target);
            Own(raw, Functions.hf_transfer_destroy);
            sourceCount = source.VertexCount;
            targetCount = target.VertexCount;
        }

        public uint[] AddPairs(uint[][] sourceRegions, uint[][] targetRegions, uint[] flags = null)
        {
            Regions source = new Regions(sourceRegions, "sourceRegions"), target = new Regions(targetRegions,
                "targetRegions");
            if (source.Counts == null || target.Counts == null || source.Counts.Length != target.Counts.Length)
                throw new HfException("sourceRegions and targetRegions must be of one length");
            using (var pins = new Pins())
            {
                var desc = new hf_pairs_desc { struct_size = (uint)sizeof(hf_pairs_desc) };
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
            OnList(Functions.hf_transfer_remove_pairs, pairs);
        }

        public hf_pair_info PairInfo(uint pair)
        {
            var info = new hf_pair_info { struct_size = (uint)sizeof(hf_pair_info) };
            Check(Functions.hf_transfer_get_pair(Handle, pair, &info));
            return info;
        }

        public hf_transfer_info Info { get { return Read<hf_transfer_info>(Functions.hf_transfer_get_info); } }

        /// <summary>What an animator turns while frames play; a new hf_transfer_dials is neutral.</summary>
        public hf_transfer_dials Dials
        {
            get { return Read<hf_transfer_dials>(Functions.hf_transfer_get_dials); }
            set
            {
                value.struct_size = (uint)sizeof(hf_transfer_dials);
                Check(Functions.hf_transfer_set_dials(Handle, &value));
            }
        }

        /// <summary>1 for every target vertex that may sink into the ground.</summary>
        public byte[] Sinking()
        {
            var sinking = new byte[targetCount];
            fixed (byte* to = sinking) Check(Functions.hf_transfer_get_sinking(Handle, to));
            return sinking;
        }

        /// <summary>One posed frame of the source into the target's positions.</summary>
        public double[] Apply(double[] sourcePositions)
        {
            var positions = new double[3 * targetCount];
            using (var pins = new Pins())
            {
                var frame = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
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
                var frame = new hf_transfer_frame { struct_size = (uint)sizeof(hf_transfer_frame) };
                frame.source_positions = (IntPtr)from;
                frame.target_positions = (IntPtr)to;
                Check(Functions.hf_transfer_apply(Handle, &frame));
            }
        }

        public Skin Skin(uint influenceCount = 4) { return Hf.Skin.Get(this, Functions.hf_transfer_get_skin, targetCount,
            influenceCount); }
    }
}
