// hf for .NET, Mono and Unity: the base of all classes (Api.cs). Handles are SafeHandles, failures are HfExceptions.
using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
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

        public HfException(string message, int code = Constants.HF_ERROR_INVALID_ARGUMENT, uint? index = null,
            string function = "") : base((function.Length > 0 ? function + ": " : "") + message + " (" + NameOf(code) + ")")
        {
            Code = code;
            Index = index;
        }

        static string NameOf(int code) => Library.Late(() => Marshal.PtrToStringAnsi(Functions.hf_result_get_name(code)));

        internal static unsafe void Check(int result)
        {
            if (result == Constants.HF_OK) return;
            hf_error_detail detail;
            Functions.hf_error_get_detail(&detail);
            uint? index = detail.index == Constants.HF_NO_INDEX ? (uint?)null : detail.index;
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
            foreach (var size in c.Sizes)
                if (Array.IndexOf(counts, size.Key.Substring(size.Key.LastIndexOf('.') + 1)) >= 0) Counts[size.Key] = size.Value;
        }

        internal int Known(string count) { lock (Counts) return Counts.TryGetValue(count, out int known) ? known : 0; }

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
        public void Record() { lock (past) { past.Push(State()); undone.Clear(); } }

        /// <summary>Goes back to the last record, bit for bit.</summary>
        public void Undo() { lock (past) Exchange(past, undone, "nothing is recorded; call Record before the edits"); }

        /// <summary>Goes to the state before the last Undo.</summary>
        public void Redo() { lock (past) Exchange(undone, past, "nothing was undone since the last Record"); }

        void Exchange(Stack<Recorded> from, Stack<Recorded> to, string nothing)
        {
            if (IsClosed) State();  // throws what every call on a disposed object throws
            if (from.Count == 0) throw new HfException(nothing, Constants.HF_ERROR_EMPTY);
            Recorded state = from.Pop();
            IntPtr mine = handle;
            SetHandle(state.handle);
            state.SetHandle(mine);
            to.Push(state);
        }
    }

    // Found as by the other bindings: $HF_LIBRARY, then beside this assembly, then where the system looks. Unity finds it
    // itself, among its plug-ins.
    /// <summary>The shared library of the binding.</summary>
    public static class Library
    {
        static readonly object Lock = new object();
        static bool found;
        static string file;

        /// <summary>Loads the library, once. Every class does this by itself.</summary>
        /// <exception cref="DllNotFoundException">It is nowhere; the message says where to put it.</exception>
        public static void Load()
        {
            lock (Lock)
            {
                if (found) return;
#if !UNITY_5_3_OR_NEWER
                file = Chosen();
                if (file != null) Bind();
#endif
                Func<uint> ask = () => Probe.hf_version_get();
                try { ask(); }
                catch (DllNotFoundException failure)
                {
                    throw new DllNotFoundException("the hf library was not found" + (file != null ? " as " + file : "") +
                        "; set HF_LIBRARY to libhf.so or hf.dll, or put it beside Hf.dll", failure);
                }
                found = true;
            }
        }

        // Calls once the library is loaded. Mono looks for a library when it compiles the method, or lambda, that calls it.
        internal static T Late<T>(Func<T> call)
        {
            Load();
            return call();
        }

        static class Probe
        {
            [DllImport(Functions.LibraryName, CallingConvention = CallingConvention.Cdecl)]
            public static extern uint hf_version_get();
        }

#if !UNITY_5_3_OR_NEWER
        static bool IsWindows => Path.DirectorySeparatorChar == '\\';

        // The file of $HF_LIBRARY, else the first name that lies beside the assembly, else null: the system's own search.
        static string Chosen()
        {
            string given = Environment.GetEnvironmentVariable("HF_LIBRARY"), place = typeof(Library).Assembly.Location;
            if (!string.IsNullOrEmpty(given)) return Path.GetFullPath(given);
            if (string.IsNullOrEmpty(place)) return null;
            string[] names = IsWindows ? new[] { "hf.dll" } : new[] { "libhf.so.0", "libhf.so", "libhf.dylib" };
            Converter<string, string> beside = name => Path.Combine(Path.GetDirectoryName(place), name);
            return Array.Find(Array.ConvertAll(names, beside), File.Exists);
        }

        // Each runtime has its own way to say which file a name means. .NET has a resolver; it is named by reflection,
        // since Mono and older frameworks lack it. Mono has a map. Windows takes a library that is already loaded.
        static void Bind()
        {
            MethodInfo set = Loader?.GetMethod("SetDllImportResolver");
            Func<string, Assembly, DllImportSearchPath?, IntPtr> own = Resolve;
            Func<Delegate> resolver = () => Delegate.CreateDelegate(set.GetParameters()[1].ParameterType, own.Method);
            if (set != null) set.Invoke(null, new object[] { typeof(Library).Assembly, resolver() });
            try { if (set == null) mono_dllmap_insert(IntPtr.Zero, Functions.LibraryName, null, file, null); }
            catch (Exception) { if (IsWindows) LoadLibraryW(file); }  // no Mono
        }

        static Type Loader =>
            Type.GetType("System.Runtime.InteropServices.NativeLibrary, System.Runtime.InteropServices")
            ?? typeof(Marshal).Assembly.GetType("System.Runtime.InteropServices.NativeLibrary");

        static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? path)
        {
            var arguments = new object[] { file, IntPtr.Zero };
            MethodInfo load = Loader.GetMethod("TryLoad", new[] { typeof(string), typeof(IntPtr).MakeByRefType() });
            if (name == Functions.LibraryName) load.Invoke(null, arguments);
            return (IntPtr)arguments[1];
        }

        [DllImport("__Internal", CharSet = CharSet.Ansi)]
        static extern void mono_dllmap_insert(IntPtr assembly, string name, string function, string to, string call);
        [DllImport("kernel32", CharSet = CharSet.Unicode)] static extern IntPtr LoadLibraryW(string file);
#endif
    }
}
