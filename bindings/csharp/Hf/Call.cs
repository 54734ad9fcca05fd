// One call of the library: arrays to pointers, the counts that follow from them and from the objects, room for arrays that
// grow. Arrays are pinned for the call and never copied.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;
using Hf.Native;

namespace Hf
{
    /// <summary>An array of float or of double.</summary>
    public sealed class Reals
    {
        internal readonly Array Values;
        Reals(Array values) => Values = values;
        public static implicit operator Reals(float[] values) => values == null ? null : new Reals(values);
        public static implicit operator Reals(double[] values) => values == null ? null : new Reals(values);
    }

    /// <summary>An array of whole numbers of 32 or 16 bits.</summary>
    public sealed class Indices
    {
        internal readonly Array Values;
        Indices(Array values) => Values = values;
        public static implicit operator Indices(uint[] values) => values == null ? null : new Indices(values);
        public static implicit operator Indices(int[] values) => values == null ? null : new Indices(values);
        public static implicit operator Indices(ushort[] values) => values == null ? null : new Indices(values);
    }

    /// <summary>Places may be given as a vertex or as a hit.</summary>
    public sealed unsafe partial class Place
    {
        public Place(uint[] corners, double[] barycentrics) => (Corners, Barycentrics) = (corners, barycentrics);
        public static implicit operator Place(uint at) => new Place(new[] { at, at, at }, new[] { 1.0, 0, 0 });
        public static implicit operator Place(Hit hit) => hit == null ? null : hit.Place;
    }

    sealed unsafe class Call : IDisposable
    {
        // Rows to try when nothing is known. Double makes the first call slower, half asks twice more often.
        const int First = 1024;
        const int Double = Constants.HF_TYPE_DOUBLE;
        public readonly Dictionary<string, int> Sizes = new Dictionary<string, int>();
        readonly Dictionary<string, int> memory;  // of the object: which room sufficed
        readonly List<GCHandle> pinned = new List<GCHandle>();
        readonly List<object> kept = new List<object>();  // alive until the call is over

        public Call(HfObject own)
        {
            Library.Load();
            memory = own == null ? Sizes : own.Counts;
            Parent("", own);
        }

        public void Dispose()
        {
            foreach (GCHandle pin in pinned) pin.Free();
            GC.KeepAlive(kept);
        }

        // ---- counts ----

        public void Parent(string prefix, HfObject thing)
        {
            Handle(thing);
            if (thing == null) return;
            lock (thing.Counts)
                foreach (var count in thing.Counts) Sizes[prefix + count.Key] = Sizes[count.Key] = count.Value;
        }

        public int Count(string key, int least) => Sizes[key] = Size(key) < 0 ? least : Size(key);

        /// <summary>What a dimension such as "face_count + 1" is; -1: not known yet.</summary>
        public int Size(string dim)
        {
            if (Sizes.TryGetValue(dim, out int size) || int.TryParse(dim, out size)) return size;
            string[] parts = dim.Split('+');
            return parts.Length > 1 && Sizes.TryGetValue(parts[0].Trim(), out size) ? size + int.Parse(parts[1]) : -1;
        }

        public int Product(params string[] dims)
        {
            long product = 1;
            foreach (string dim in dims) product *= Math.Max(Size(dim), 0);
            if (product <= int.MaxValue) return (int)product;
            throw new HfException("an array of " + product + " numbers is more than C# holds", Constants.HF_ERROR_TOO_LARGE);
        }

        /// <summary>Checks how many numbers there are; a dimension that is not known yet becomes known.</summary>
        public Array Fit(Array values, string name, params string[] dims)
        {
            if (values == null) return null;
            long known = 1, length = values.Length;
            string[] loose = System.Array.FindAll(dims, dim => Size(dim) < 0);
            foreach (string dim in dims) known *= Size(dim) < 0 ? 1 : Size(dim);
            if (loose.Length > 1) throw new HfException(name + " cannot be read without what it belongs to");
            string each = loose.Length == 0 ? "" : " for each";
            if (loose.Length == 0 ? length != known : length > 0 && (known == 0 || length % known != 0))
                throw new HfException(name + " must hold " + known + " numbers" + each + ", not " + length);
            foreach (string dim in loose) Sizes[dim] = (int)(length / Math.Max(known, 1));
            return values;
        }

        // ---- what goes in ----

        public IntPtr Handle(HfObject thing)
        {
            kept.Add(thing);
            return thing == null ? IntPtr.Zero : thing.RawHandle;
        }

        /// <summary>Where an array lies; null and empty arrays are NULL.</summary>
        public IntPtr Pin(Array values)
        {
            if (values == null || values.Length == 0) return IntPtr.Zero;
            pinned.Add(GCHandle.Alloc(values, GCHandleType.Pinned));
            return pinned[pinned.Count - 1].AddrOfPinnedObject();
        }

        public void* Array(Array values, string name, params string[] dims) => (void*)Pin(Fit(values, name, dims));

        /// <summary>An hf_array: rows of the numbers that the caller has.</summary>
        public hf_array View(Array values, string name, params string[] dims) => new hf_array
        {
            data = Pin(Fit(values, name, dims)),
            count = values == null ? 0 : (uint)Size(dims[0]),
            type = values is double[] ? Double : values is ushort[] ? Constants.HF_TYPE_UINT16 : 0
        };

        /// <summary>Memory of zeros until the call is over.</summary>
        public void* New(int size) => (void*)Pin(new long[size / sizeof(long) + 1]);

        public void* Rows(int size, params string[] dims) => New(checked(size * Product(dims)));

        public void* Given(Array rows, string name, int size, params string[] dims) =>
            Fit(rows, name, dims) == null ? null : New(checked(size * rows.Length));

        /// <summary>Lists of different lengths, one after the other.</summary>
        public void Lists(uint[][] lists, string name, string key, out IntPtr counts, out IntPtr all)
        {
            counts = all = IntPtr.Zero;
            if (Fit(lists, name, key) == null) return;
            var together = new List<uint>();
            int none = System.Array.IndexOf(lists, null);
            if (none >= 0) throw new HfException(name + "[" + none + "] is null", Constants.HF_ERROR_NULL_POINTER);
            foreach (uint[] list in lists) together.AddRange(list);
            counts = Pin(System.Array.ConvertAll(lists, list => (uint)list.Length));
            all = Pin(together.ToArray());
        }

        /// <summary>Lines in UTF-8, one for each.</summary>
        public void* Text(string[] lines) => lines == null ? null : (void*)Pin(Encoding.UTF8.GetBytes(string.Concat(
            System.Array.ConvertAll(lines, line => (line ?? "").Replace('\n', ' ').Replace('\0', ' ') + "\n")) + "\0"));

        public void* Place(Place place, string name)
        {
            var raw = (hf_place*)New(sizeof(hf_place));
            (place ?? throw new HfException(name + " is null", Constants.HF_ERROR_NULL_POINTER)).Write(this, raw);
            return raw;
        }

        // ---- what comes out ----

        /// <summary>An array for the library to fill; none where it has no place.</summary>
        public static hf_array_out Out(void* place, bool isDouble, int rows) => place == null ? default(hf_array_out)
            : new hf_array_out { data = (IntPtr)place, count = (uint)rows, type = isDouble ? Double : 0 };

        /// <summary>The caller's array has the right length.</summary>
        public void Need(int length, string name, params string[] dims)
        {
            if (length == Product(dims)) return;
            throw new HfException(name + " must hold " + Product(dims) + " numbers, not " + length, Constants.HF_ERROR_TOO_SMALL);
        }

        /// <summary>How many rows of an array that grows are tried: a count that is known, or what sufficed last time.</summary>
        public void Room(string key, string like) => Sizes[key] = Size(like) < 0 ? First : Size(like);

        public IntPtr Make<T>(out T[] array, params string[] dims) => Pin(array = new T[Product(dims)]);

        /// <summary>Whether the room was too little, or a count was not known: the call is made again with what was told.</summary>
        public bool Again(string function, int result, params (string Key, uint Count)[] told)
        {
            bool fits = true, known = true;
            foreach ((string Key, uint Count) one in told)
            {
                bool room = one.Key.EndsWith("capacity", StringComparison.Ordinal);
                fits &= !room || one.Count <= Size(one.Key);
                known &= room || one.Count == Size(one.Key);
                Sizes[one.Key] = (int)Math.Min(one.Count, int.MaxValue);
                long next = Math.Max(First, one.Count + one.Count / 8L);
                lock (memory) memory[function + "." + one.Key] = (int)Math.Min(next, int.MaxValue);
            }
            if (result != Constants.HF_ERROR_TOO_SMALL || fits) HfException.Check(result);
            return !fits || !known;
        }

        /// <summary>The array in the length that it has now; null when it was not asked for.</summary>
        public T[] Cut<T>(T[] array, params string[] dims)
        {
            if (array != null) System.Array.Resize(ref array, Product(dims));
            return array;
        }
    }
}
