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
        public string Name { get; }
        /// <summary>Vertex, triangle, site, handle or position in a list; null when there is none.</summary>
        public uint? Index { get; }

        public HfException(string message, int code = Constants.HF_ERROR_INVALID_ARGUMENT, uint? index = null,
            string function = "")
            : base((function.Length > 0 ? function + ": " : "") + message + " (" + NameOf(code) + ")")
        {
            Code = code;
            Name = NameOf(code);
            Index = index;
        }

        static string NameOf(int code)
        {
            Library.Load();
            return Known(code) ?? "unknown";
        }

        static string Known(int code) { return Marshal.PtrToStringAnsi(Functions.hf_result_get_name(code)); }

        internal static unsafe void Check(int result)
        {
            if (result == Constants.HF_OK) return;
            hf_error_detail detail;
            Functions.hf_error_get_detail(&detail);
            uint? index = null;
            if (detail.index != Constants.HF_NO_INDEX) index = detail.index;
            throw new HfException(Text(detail.message, 256), result, index, Text(detail.function, 48));
        }

        static unsafe string Text(byte* bytes, int size)
        {
            int length = 0;
            while (length < size && bytes[length] != 0) ++length;
            return Encoding.UTF8.GetString(bytes, length);
        }
    }

    /// <summary>Owns one handle of the library.</summary>
    public sealed class NativeHandle : SafeHandle
    {
        readonly Action<IntPtr> destroy;

        internal NativeHandle(IntPtr raw, Action<IntPtr> destroy) : base(IntPtr.Zero, true)
        {
            this.destroy = destroy;
            SetHandle(raw);
        }

        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        protected override bool ReleaseHandle()
        {
            destroy(handle);
            return true;
        }
    }

    /// <summary>Something with a handle. Dispose may be called more than once and in any order; a call on a disposed
    /// object
    /// throws an HfException of the code HF_ERROR_INVALID_OBJECT. What is not disposed is collected.</summary>
    public abstract class HfObject : IDisposable
    {
        NativeHandle owned;
        internal readonly Dictionary<string, int> Counts = new Dictionary<string, int>();  // how long its arrays are
        internal Dictionary<string, int> Rooms;  // what sufficed last time

        internal void Own(IntPtr raw, Action<IntPtr> destroy, Call c, params string[] counts)
        {
            owned = new NativeHandle(raw, destroy);
            c.Tell(Counts, counts);
        }

        internal int Known(string count)
        {
            int known;
            return Counts.TryGetValue(count, out known) ? known : 0;
        }

        internal bool IsDisposed { get { return owned == null || owned.IsClosed; } }

        internal void Exchange(HfObject other)
        {
            NativeHandle mine = owned;
            owned = other.owned;
            other.owned = mine;
        }

        /// <summary>The handle of the C ABI; stale after Dispose, which the library finds out.</summary>
        public IntPtr RawHandle { get { return owned == null ? IntPtr.Zero : owned.DangerousGetHandle(); } }

        public void Dispose()
        {
            if (owned != null) owned.Dispose();
        }

    }

    /// <summary>Something with undo. A record is a clone, so it shares memory with the object.</summary>
    public abstract class Recorded : HfObject
    {
        Stack<Recorded> past = new Stack<Recorded>(), undone = new Stack<Recorded>();

        internal abstract Recorded State();

        /// <summary>Keeps the present state for Undo.</summary>
        public void Record() { past.Push(State()); undone.Clear(); }

        /// <summary>Goes back to the last record, bit for bit.</summary>
        public void Undo() { Exchange(past, undone, "nothing is recorded; call Record before the edits"); }

        /// <summary>Goes to the state before the last Undo.</summary>
        public void Redo() { Exchange(undone, past, "nothing was undone since the last Record"); }

        void Exchange(Stack<Recorded> from, Stack<Recorded> to, string nothing)
        {
            if (IsDisposed) State();  // throws what every call on a disposed object throws
            if (from.Count == 0) throw new HfException(nothing, Constants.HF_ERROR_EMPTY);
            Recorded state = from.Pop();
            Exchange(state);
            to.Push(state);
        }
    }
}
