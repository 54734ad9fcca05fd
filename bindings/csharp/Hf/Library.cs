// Finds the shared library as the other bindings do: $HF_LIBRARY, then beside this assembly, then where the system looks.
// Unity finds it itself, among its plug-ins.
using System;
using System.IO;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using Hf.Native;

namespace Hf
{
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
                try { Ask(); }
                catch (DllNotFoundException failure)
                {
                    throw new DllNotFoundException("the hf library was not found" + (file != null ? " as " + file : "") +
                        "; set HF_LIBRARY to libhf.so or hf.dll, or put it beside Hf.dll", failure);
                }
                found = true;
            }
        }

        // On its own: Mono looks for a library when it compiles the method that calls it.
        [MethodImpl(MethodImplOptions.NoInlining)]
        static void Ask() => Probe.hf_version_get();

        static class Probe
        {
            [DllImport(Functions.LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern uint hf_version_get();
        }

#if !UNITY_5_3_OR_NEWER
        static bool IsWindows => Path.DirectorySeparatorChar == '\\';

        // The file of $HF_LIBRARY, else the first name that lies beside the assembly, else null: the system's own search.
        static string Chosen()
        {
            string given = Environment.GetEnvironmentVariable("HF_LIBRARY"), place = typeof(Library).Assembly.Location;
            if (!string.IsNullOrEmpty(given)) return Path.GetFullPath(given);
            string[] names = IsWindows ? new[] { "hf.dll" } : new[] { "libhf.so.0", "libhf.so", "libhf.dylib" };
            if (string.IsNullOrEmpty(place)) return null;
            return Array.Find(Array.ConvertAll(names, name => Path.Combine(Path.GetDirectoryName(place), name)), File.Exists);
        }

        // Each runtime has its own way to say which file a name means. .NET has a resolver; it is named by reflection,
        // since Mono and older frameworks lack it. Mono has a map. Windows takes a library that is already loaded.
        static void Bind()
        {
            if (Loader != null)
            {
                MethodInfo set = Loader.GetMethod("SetDllImportResolver");
                Func<string, Assembly, DllImportSearchPath?, IntPtr> own = Resolve;
                Delegate resolve = Delegate.CreateDelegate(set.GetParameters()[1].ParameterType, own.Method);
                set.Invoke(null, new object[] { typeof(Library).Assembly, resolve });
                return;
            }
            try { mono_dllmap_insert(IntPtr.Zero, Functions.LibraryName, null, file, null); }
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

        [DllImport("__Internal", CharSet = CharSet.Ansi)] static extern void mono_dllmap_insert(IntPtr assembly, string name, string function, string to, string toFunction);
        [DllImport("kernel32", CharSet = CharSet.Unicode)] static extern IntPtr LoadLibraryW(string file);
#endif
    }
}
