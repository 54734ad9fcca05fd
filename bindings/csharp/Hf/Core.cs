// hf for .NET, Mono and Unity: the base of all classes (Api.cs). Handles are SafeHandles, failures are HfExceptions.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;
using Hf.Native;

namespace Hf
{
    /// <summary>A failed call: the library's own sentence, its code, and what it is about.</summary>
    public sealed class HfException : Exception
    {
        /// <summary>HF_ERROR_*.</summary>
        public int Code { get; }
        /// <summary>The name of the code.</summary>
        public string Name => NameOf(Code);
        /// <summary>Vertex, triangle, site, handle or position in a list; null when there is none.</summary>
        public uint? Index { get; }

        public HfException(string message, int code = Constants.HF_ERROR_INVALID_ARGUMENT, uint? index = null, string function = "")
            : base((function.Length > 0 ? function + ": " : "") + message + " (" + NameOf(code) + ")")
        {
            Code = code;
            Index = index;
        }

        static string NameOf(int code)
        {
            Library.Load();
            return Known(code) ?? "unknown";
        }

        static string Known(int code) => Marshal.PtrToStringAnsi(Functions.hf_result_get_name(code));

        internal static unsafe void Check(int result)
        {
            if (result == Constants.HF_OK) return;
            hf_error_detail detail;
            Functions.hf_error_get_detail(&detail);
            uint? index = detail.index;
            if (detail.index == Constants.HF_NO_INDEX) index = null;
            throw new HfException(Text(detail.message, 256), result, index, Text(detail.function, 48));
        }

        static unsafe string Text(byte* bytes, int size) => Encoding.UTF8.GetString(bytes, size).Split('\0')[0];
    }

    /// <summary>Owns one handle of the library. Dispose may be called more than once and in any order; a call on a disposed
    /// object throws an HfException of the code HF_ERROR_INVALID_OBJECT. What is not disposed is collected.</summary>
    public abstract class HfObject : SafeHandle
    {
        Action<IntPtr> destroy;
        // how long its arrays are, and which room sufficed last time for those that grow
        internal readonly Dictionary<string, int> Counts = new Dictionary<string, int>();

        internal HfObject() : base(IntPtr.Zero, true) { }

        internal void Own(IntPtr raw, Action<IntPtr> destroyer, Call c, params string[] counts)
        {
            destroy = destroyer;
            SetHandle(raw);
            foreach (KeyValuePair<string, int> size in c.Sizes)
                if (Array.IndexOf(counts, size.Key.Substring(size.Key.LastIndexOf('.') + 1)) >= 0) Counts[size.Key] = size.Value;
        }

        internal int Known(string count)
        {
            lock (Counts) return Counts.TryGetValue(count, out int known) ? known : 0;
        }

        internal void Exchange(HfObject other)
        {
            IntPtr mine = handle;
            handle = other.handle;
            other.handle = mine;
        }

        /// <summary>The handle of the C ABI; stale after Dispose, which the library finds out.</summary>
        public IntPtr RawHandle => handle;

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected override bool ReleaseHandle()
        {
            destroy(handle);
            return true;
        }
    }

    /// <summary>Something with undo. A record is a clone, so it shares memory with the object.</summary>
    public abstract class Recorded : HfObject
    {
        readonly Stack<Recorded> past = new Stack<Recorded>(), undone = new Stack<Recorded>();

        internal abstract Recorded State();

        /// <summary>Keeps the present state for Undo.</summary>
        public void Record()
        {
            past.Push(State());
            undone.Clear();
        }

        /// <summary>Goes back to the last record, bit for bit.</summary>
        public void Undo() => Exchange(past, undone, "nothing is recorded; call Record before the edits");

        /// <summary>Goes to the state before the last Undo.</summary>
        public void Redo() => Exchange(undone, past, "nothing was undone since the last Record");

        void Exchange(Stack<Recorded> from, Stack<Recorded> to, string nothing)
        {
            if (IsClosed) State();  // throws what every call on a disposed object throws
            if (from.Count == 0) throw new HfException(nothing, Constants.HF_ERROR_EMPTY);
            Exchange(from.Peek());
            to.Push(from.Pop());
        }
    }
}
