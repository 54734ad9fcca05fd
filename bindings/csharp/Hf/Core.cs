// hf for .NET, Mono and Unity: the base of all classes. Handles are SafeHandles, failures are HfExceptions. Arrays are
// pinned for the call and never copied.
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

        internal void Own(IntPtr raw, Action<IntPtr> destroy)
        {
            owned = new NativeHandle(raw, destroy);
        }

        internal bool IsDisposed { get { return owned == null || owned.IsClosed; } }

        internal void Exchange(HfObject other)
        {
            NativeHandle mine = owned;
            owned = other.owned;
            other.owned = mine;
        }

        /// <summary>The handle of the C ABI; stale after Dispose, which the library finds out.</summary>
        public IntPtr Handle { get { return owned == null ? IntPtr.Zero : owned.DangerousGetHandle(); } }

        public void Dispose()
        {
            if (owned != null) owned.Dispose();
        }

        internal unsafe delegate int Maker(IntPtr parent, void* desc, void* raw);
        internal unsafe delegate int Copier(IntPtr original, void* raw);
        internal unsafe delegate int Listed(IntPtr handle, uint count, void* numbers);
        internal unsafe delegate int ListedWith(IntPtr handle, uint count, void* numbers, void* values);
        internal unsafe delegate int Table(IntPtr handle, uint capacity, void* rows, void* count);
        internal unsafe delegate int Query(IntPtr handle, void* info);

        /// <summary>Makes the object on a surface with the library's function and desc.</summary>
        internal unsafe void Make(Maker create, HfObject parent, string name, void* desc, Action<IntPtr> destroy)
        {
            IntPtr raw;
            HfException.Check(create(HandleOf(parent, name), desc, &raw));
            GC.KeepAlive(parent);
            Own(raw, destroy);
        }

        /// <summary>Makes the object as a clone of another.</summary>
        internal unsafe void Copy(Copier clone, HfObject original, Action<IntPtr> destroy)
        {
            IntPtr raw;
            original.Check(clone(original.Handle, &raw));
            Own(raw, destroy);
        }

        /// <summary>A call on numbered things.</summary>
        internal unsafe void OnList(Listed call, uint[] numbers)
        {
            using (var pins = new Pins()) Check(call(Handle, (uint)Pins.Count(numbers), (void*)pins.Add(numbers)));
        }

        /// <summary>The same with `each` numbers for every one.</summary>
        internal unsafe void OnList(ListedWith call, uint[] numbers, double[] values, int each, string name)
        {
            int count = Pins.Count(numbers);
            using (var pins = new Pins())
                Check(call(Handle, (uint)count, (void*)pins.Add(numbers), (void*)pins.Add(values, each * count, name)));
        }

        /// <summary>The same with as many vertices.</summary>
        internal unsafe void OnList(ListedWith call, uint[] numbers, uint[] vertices)
        {
            if (Pins.Count(numbers) != Pins.Count(vertices))
                throw new HfException("as many vertices as numbers are needed");
            using (var pins = new Pins())
                Check(call(Handle, (uint)Pins.Count(numbers), (void*)pins.Add(numbers), (void*)pins.Add(vertices)));
        }

        /// <summary>A table that is asked for its size first.</summary>
        internal unsafe T[] Rows<T>(Table call) where T : struct
        {
            uint count;
            Check(call(Handle, 0, null, &count));
            var rows = new T[count];
            if (count > 0) using (var pins = new Pins()) Check(call(Handle, count, (void*)pins.Add(rows), &count));
            return rows;
        }

        /// <summary>A struct that the library fills.</summary>
        internal unsafe T Read<T>(Query call) where T : struct
        {
            var info = new T[1];
            using (var pins = new Pins())
            {
                void* place = (void*)pins.Add(info);
                *(uint*)place = (uint)Marshal.SizeOf(typeof(T));  // struct_size
                Check(call(Handle, place));
            }
            return info[0];
        }

        internal static IntPtr HandleOf(HfObject thing, string name)
        {
            if (thing == null) throw new HfException(name + " is null", Constants.HF_ERROR_INVALID_OBJECT);
            return thing.Handle;
        }

        /// <summary>Calls the library and keeps this object alive until the call has returned.</summary>
        internal void Check(int result)
        {
            GC.KeepAlive(this);
            HfException.Check(result);
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

    /// <summary>Arrays pinned for one call. Empty and null arrays are NULL.</summary>
    sealed class Pins : IDisposable
    {
        readonly List<GCHandle> pinned = new List<GCHandle>();

        public IntPtr Add(Array array)
        {
            if (array == null || array.Length == 0) return IntPtr.Zero;
            GCHandle pin = GCHandle.Alloc(array, GCHandleType.Pinned);
            pinned.Add(pin);
            return pin.AddrOfPinnedObject();
        }

        /// <summary>The same, with a check of the length; null stays NULL.</summary>
        public IntPtr Add(Array array, int count, string name)
        {
            if (array != null) Need(array.Length, count, name);
            return Add(array);
        }

        /// <summary>The desc of a saved factor; null gives NULL.</summary>
        public unsafe IntPtr AddFactor(byte[] saved)
        {
            if (saved == null) return IntPtr.Zero;
            return Add(new[] { new hf_factor_desc { struct_size = (uint)sizeof(hf_factor_desc), bytes = Add(saved),
                byte_count = (UIntPtr)saved.Length } });
        }

        public static void Need(int given, int wanted, string name)
        {
            if (given != wanted) throw new HfException(name + " must hold " + wanted + " numbers, not " + given);
        }

        /// <summary>Elements of a list; a missing list counts one, so that the library says what is missing.</summary>
        public static int Count(Array array) { return array == null ? 1 : array.Length; }

        public void Dispose()
        {
            foreach (GCHandle pin in pinned) pin.Free();
            pinned.Clear();
        }
    }

    /// <summary>Lists of vertices one after the other.</summary>
    struct Regions
    {
        public uint[] Counts, Vertices;

        public Regions(uint[][] lists, string name)
        {
            Counts = Vertices = null;
            if (lists == null) return;
            Counts = new uint[lists.Length];
            var all = new List<uint>();
            for (int i = 0; i < lists.Length; ++i)
            {
                if (lists[i] == null) throw new HfException(name + "[" + i + "] is null",
                    Constants.HF_ERROR_NULL_POINTER);
                Counts[i] = (uint)lists[i].Length;
                all.AddRange(lists[i]);
            }
            Vertices = all.ToArray();
        }
    }
}
