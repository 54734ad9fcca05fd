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
        internal Array Values;
        public static implicit operator Reals(float[] values) { return values == null ? null : new Reals { Values = values }; }
        public static implicit operator Reals(double[] values) { return values == null ? null : new Reals { Values = values }; }
    }

    /// <summary>An array of whole numbers of 32 or 16 bits.</summary>
    public sealed class Indices
    {
        internal Array Values;
        public static implicit operator Indices(uint[] values) { return values == null ? null : new Indices { Values = values }; }
        public static implicit operator Indices(int[] values) { return values == null ? null : new Indices { Values = values }; }
        public static implicit operator Indices(ushort[] values) { return values == null ? null : new Indices { Values = values }; }
    }

    /// <summary>Places may be given as a vertex or as a hit.</summary>
    public sealed unsafe partial class Place
    {
        public Place(uint[] corners, double[] barycentrics)
        {
            Corners = corners;
            Barycentrics = barycentrics;
        }

        public static implicit operator Place(uint vertex) { return new Place(new[] { vertex, vertex, vertex }, new[] { 1.0, 0, 0 }); }
        public static implicit operator Place(Hit hit) { return hit == null ? null : hit.Place; }
    }

    sealed unsafe class Call : IDisposable
    {
        readonly Dictionary<string, int> sizes = new Dictionary<string, int>();
        readonly List<GCHandle> pinned = new List<GCHandle>();
        readonly List<IntPtr> blocks = new List<IntPtr>();
        readonly List<object> kept = new List<object>();  // alive until the call is over

        public Call(HfObject own)
        {
            Library.Load();
            if (own == null) return;
            kept.Add(own);
            foreach (KeyValuePair<string, int> count in own.Counts) sizes[count.Key] = count.Value;
        }

        public static int Late(Func<int> call) { return call(); }

        public void Dispose()
        {
            foreach (GCHandle pin in pinned) pin.Free();
            foreach (IntPtr block in blocks) Marshal.FreeHGlobal(block);
            GC.KeepAlive(kept);
        }

        // ---- counts ----

        public int this[string key] { set { sizes[key] = value; } }

        public void Parent(string name, HfObject thing)
        {
            if (thing == null) return;
            kept.Add(thing);
            foreach (KeyValuePair<string, int> count in thing.Counts)
                sizes[name + "." + count.Key] = sizes[count.Key] = count.Value;
        }

        public void Tell(Dictionary<string, int> counts, string[] keys)
        {
            foreach (KeyValuePair<string, int> size in sizes)
                if (System.Array.IndexOf(keys, size.Key.Substring(size.Key.LastIndexOf('.') + 1)) >= 0) counts[size.Key] = size.Value;
        }

        public void Known(string key, uint value) { if (value != 0) sizes[key] = (int)Math.Min(value, int.MaxValue); }

        public void Forget(string key) { sizes.Remove(key); }

        public int Count(string key, int least)
        {
            int size;
            if (!sizes.TryGetValue(key, out size)) sizes[key] = size = least;
            return size;
        }

        /// <summary>What a dimension such as "face_count + 1" is; -1: not known yet.</summary>
        public int Size(string dim)
        {
            if (char.IsDigit(dim[0])) return int.Parse(dim);
            int size, plus = dim.IndexOf(" + ", StringComparison.Ordinal);
            if (!sizes.TryGetValue(plus < 0 ? dim : dim.Substring(0, plus), out size)) return -1;
            return plus < 0 ? size : size + int.Parse(dim.Substring(plus + 3));
        }

        public int Product(params string[] dims)
        {
            long product = 1;
            foreach (string dim in dims) product *= Math.Max(Size(dim), 0);
            if (product > int.MaxValue)
                throw new HfException("an array of " + product + " numbers is more than C# holds", Constants.HF_ERROR_TOO_LARGE);
            return (int)product;
        }

        /// <summary>Checks how many numbers there are; a dimension that is not known yet becomes known.</summary>
        void Fit(int length, string name, string[] dims)
        {
            long known = 1;
            string loose = null;
            foreach (string dim in dims)
            {
                int size = Size(dim);
                if (size >= 0) known *= size;
                else if (loose == null) loose = dim;
                else throw new HfException(name + " cannot be read without what it belongs to");
            }
            if (loose == null)
            {
                if (length != known) throw new HfException(name + " must hold " + known + " numbers, not " + length);
                return;
            }
            if (known > 0 ? length % known != 0 : length > 0)
                throw new HfException(name + " must hold " + known + " numbers for each, not " + length);
            int plus = loose.IndexOf(" + ", StringComparison.Ordinal), more = plus < 0 ? 0 : int.Parse(loose.Substring(plus + 3));
            sizes[plus < 0 ? loose : loose.Substring(0, plus)] = known > 0 ? Math.Max((int)(length / known) - more, 0) : 0;
        }

        // ---- what goes in ----

        public IntPtr Handle(HfObject thing)
        {
            if (thing == null) return IntPtr.Zero;
            kept.Add(thing);
            return thing.RawHandle;
        }

        /// <summary>Where an array lies; null and empty arrays are NULL.</summary>
        public IntPtr Pin(Array values)
        {
            if (values == null || values.Length == 0) return IntPtr.Zero;
            GCHandle pin = GCHandle.Alloc(values, GCHandleType.Pinned);
            pinned.Add(pin);
            return pin.AddrOfPinnedObject();
        }

        public void* Array(Array values, string name, params string[] dims)
        {
            if (values == null) return null;
            Fit(values.Length, name, dims);
            return (void*)Pin(values);
        }

        public void Either(Reals values, string name, out IntPtr first, out IntPtr second, params string[] dims)
        {
            first = values == null ? IntPtr.Zero : (IntPtr)Array(values.Values, name, dims);
            second = IntPtr.Zero;
            if (values != null && values.Values is double[]) { second = first; first = IntPtr.Zero; }
        }

        public void Either(Indices values, string name, out IntPtr first, out IntPtr second, params string[] dims)
        {
            first = values == null ? IntPtr.Zero : (IntPtr)Array(values.Values, name, dims);
            second = IntPtr.Zero;
            if (values != null && values.Values is ushort[]) { second = first; first = IntPtr.Zero; }
        }

        /// <summary>Memory of zeros until the call is over.</summary>
        public void* New(int size)
        {
            IntPtr block = Marshal.AllocHGlobal(Math.Max(size, 1));
            blocks.Add(block);
            for (int i = 0; i < size; ++i) ((byte*)block)[i] = 0;
            return (void*)block;
        }

        public void* Rows(int size, params string[] dims) { return New(checked(size * Product(dims))); }

        public void* Given(Array rows, string name, int size, params string[] dims)
        {
            if (rows == null) return null;
            Fit(rows.Length, name, dims);
            return New(checked(size * rows.Length));
        }

        /// <summary>A field of every row, `each` numbers apart.</summary>
        public void Spread(double[] values, string name, int each, double* first, int stride, params string[] dims)
        {
            if (values == null) return;
            int rows = Product(dims);
            if (values.Length != each * rows)
                throw new HfException(name + " must hold " + each * rows + " numbers, not " + values.Length);
            for (int i = 0; i < values.Length; ++i) ((double*)((byte*)first + i / each * stride))[i % each] = values[i];
        }

        public void Fixed(double[] values, string name, int count, double* place) { Fill(values, name, count, place); }

        public static void Fill(double[] values, string name, int count, double* place)
        {
            Need(values, name, count);
            for (int i = 0; values != null && i < count; ++i) place[i] = values[i];
        }

        public static void Fill(uint[] values, string name, int count, uint* place)
        {
            Need(values, name, count);
            for (int i = 0; values != null && i < count; ++i) place[i] = values[i];
        }

        static void Need(Array values, string name, int count)
        {
            if (values != null && values.Length != count)
                throw new HfException(name + " must hold " + count + " numbers, not " + values.Length);
        }

        /// <summary>Lists of different lengths, one after the other.</summary>
        public void Lists(uint[][] lists, string name, string key, out IntPtr counts, out IntPtr all)
        {
            counts = all = IntPtr.Zero;
            if (lists == null) return;
            Fit(lists.Length, name, new[] { key });
            var lengths = new uint[lists.Length];
            var together = new List<uint>();
            for (int i = 0; i < lists.Length; ++i)
            {
                if (lists[i] == null) throw new HfException(name + "[" + i + "] is null", Constants.HF_ERROR_NULL_POINTER);
                lengths[i] = (uint)lists[i].Length;
                together.AddRange(lists[i]);
            }
            counts = Pin(lengths);
            all = Pin(together.ToArray());
        }

        /// <summary>Lines in UTF-8, one for each.</summary>
        public void* Text(string[] lines)
        {
            if (lines == null) return null;
            var text = new StringBuilder();
            foreach (string line in lines) text.Append((line ?? "").Replace('\n', ' ').Replace('\0', ' ')).Append('\n');
            return (void*)Pin(Encoding.UTF8.GetBytes(text.Append('\0').ToString()));
        }

        public void* Place(Place place, string name)
        {
            if (place == null) throw new HfException(name + " is null", Constants.HF_ERROR_NULL_POINTER);
            var raw = (hf_place*)New(sizeof(hf_place));
            place.Write(raw);
            return raw;
        }

        /// <summary>The caller's array has the right length.</summary>
        public void Need(int length, string name, params string[] dims)
        {
            if (length != Product(dims))
                throw new HfException(name + " must hold " + Product(dims) + " numbers, not " + length, Constants.HF_ERROR_TOO_SMALL);
        }
    }

    /// <summary>Arrays of lengths that the library tells: called again with more room when that was too little.</summary>
    sealed unsafe class Growth
    {
        sealed class Made
        {
            public string[] Dims;
            public Func<int, Array> Make;
            public int Size;  // of a row of structs
            public Array Values;
            public IntPtr Place;
        }

        const int First = 1024;  // rows to try when nothing is known; double makes the first call slower, half asks twice more often
        readonly Call c;
        readonly string function;
        readonly Dictionary<string, int> memory, rooms = new Dictionary<string, int>(), told = new Dictionary<string, int>();
        readonly Dictionary<string, Made> arrays = new Dictionary<string, Made>();
        bool blind;  // asks for counts alone
        public int Result;

        public Growth(Call c, HfObject owner, string function)
        {
            this.c = c;
            this.function = function;
            memory = owner == null ? new Dictionary<string, int>() : owner.Rooms = owner.Rooms ?? new Dictionary<string, int>();
        }

        public void Room(string key, string known)
        {
            int room = known == null ? -1 : c.Size(known);
            lock (memory) if (room < 0 && !memory.TryGetValue(function + key, out room)) room = First;
            rooms[key] = room;
        }

        public void Array<T>(string name, params string[] dims) { arrays[name] = new Made { Dims = dims, Make = count => new T[count] }; }
        public void Rows(string name, int size, params string[] dims) { arrays[name] = new Made { Dims = dims, Size = size }; }
        public int this[string key] { get { return blind ? 0 : rooms[key]; } }
        public void* Place(string name) { return arrays.ContainsKey(name) ? (void*)arrays[name].Place : null; }
        public int Length(string name) { return c.Size(arrays[name].Dims[0]); }
        public void Told(string key, uint count) { told[key] = (int)Math.Min(count, int.MaxValue); }

        public void Begin()
        {
            blind = false;
            foreach (KeyValuePair<string, int> room in rooms) c[room.Key] = room.Value;
            foreach (Made made in arrays.Values)
                foreach (string dim in made.Dims) blind |= c.Size(dim) < 0;
            foreach (Made made in arrays.Values)
            {
                int count = blind ? 0 : c.Product(made.Dims);
                made.Values = made.Make == null ? null : made.Make(count);
                made.Place = blind ? IntPtr.Zero : made.Make == null ? (IntPtr)c.New(checked(count * made.Size)) : c.Pin(made.Values);
            }
        }

        /// <summary>Whether to call again.</summary>
        public bool Again()
        {
            bool enough = true;
            foreach (string key in rooms.Keys) enough &= told[key] <= rooms[key];
            if (Result != Constants.HF_OK && (Result != Constants.HF_ERROR_TOO_SMALL || enough)) HfException.Check(Result);
            if (Result == Constants.HF_OK && enough && !blind)
            {
                foreach (KeyValuePair<string, int> room in rooms) lock (memory) memory[function + room.Key] = Math.Max(room.Value, 1);
                foreach (KeyValuePair<string, int> count in told) c[count.Key] = count.Value;
                return false;
            }
            foreach (string key in new List<string>(rooms.Keys))
                rooms[key] = blind ? told[key] : Math.Max(rooms[key], checked(told[key] + told[key] / 8));
            foreach (KeyValuePair<string, int> count in told) if (!rooms.ContainsKey(count.Key)) c[count.Key] = count.Value;
            return true;
        }

        /// <summary>The array in the length that it has now; null when it was not asked for.</summary>
        public T[] Take<T>(string name)
        {
            if (!arrays.ContainsKey(name)) return null;
            var values = (T[])arrays[name].Values;
            int count = c.Product(arrays[name].Dims);
            if (values.Length == count) return values;
            var cut = new T[count];
            System.Array.Copy(values, cut, count);
            return cut;
        }
    }
}
