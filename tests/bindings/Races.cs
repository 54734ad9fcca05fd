// Threads that make, use, dispose and drop the same objects while the collector runs. Only the
// library's own exceptions may come out, and none of the code HF_ERROR_INTERNAL. 4,000 calls, 100,000 with HF_FULL_TESTS.
using System;
using System.Collections.Concurrent;
using System.Linq;
using System.Threading;
using Hf;

static class Races
{
    const int Threads = 4, Slots = 12, Length = 24;
    static double[] positions, heights;
    static uint[] triangles;
    static readonly HfObject[] slots = new HfObject[Slots];
    static readonly Surface[] surfaces = new Surface[2];
    static readonly ConcurrentDictionary<string, int> refused = new ConcurrentDictionary<string, int>();
    static readonly ConcurrentQueue<string> unexpected = new ConcurrentQueue<string>();

    // a bar of Length x 4 vertices, open at both ends
    static void MakeMesh()
    {
        int[] x = { 0, 1, 1, 0 }, z = { 0, 0, 1, 1 };
        positions = Enumerable.Range(0, Length).SelectMany(i => Enumerable.Range(0, 4).SelectMany(
            k => new double[] { x[k], i, z[k] })).ToArray();
        heights = Enumerable.Range(0, 4 * Length).Select(v => (double)(v / 4)).ToArray();
        triangles = Enumerable.Range(0, Length - 1).SelectMany(i => Enumerable.Range(0, 4).SelectMany(k =>
        {
            uint a = (uint)(4 * i + k), b = (uint)(4 * i + (k + 1) % 4);
            return new[] { a, b, b + 4, a, b + 4, a + 4 };
        })).ToArray();
    }

    static HfObject Make(Random draw)
    {
        Surface surface = surfaces[draw.Next(2)];
        uint last = 4 * Length - 1;
        switch (draw.Next(8))
        {
            case 0:
                surfaces[draw.Next(2)] = new Surface(positions, triangles);
                return new Solver(surface);
            case 1:
                var pose = new Pose(surface);
                pose.AddHandles(new[] { new uint[] { 0, 1 }, new uint[] { last - 1, last } });
                return pose;
            case 2: return new Geodesics(surface);
            case 3: return new Direction(surface);
            case 4: return new Flow(surface);
            case 5: return new Region(surface);
            default: return new Solver(surface);
        }
    }

    static void Use(HfObject thing, Random draw)
    {
        var solver = thing as Solver;
        if (solver != null)
        {
            switch (draw.Next(6))
            {
                case 0: solver.AddSites(new[] { (uint)draw.Next(4 * Length) }, new[] { 1.0 }); return;
                case 1: solver.RemoveSites(new uint[] { 0 }); return;
                case 2: solver.Clone().Solve(); return;
                case 3: solver.Record(); return;
                case 4: solver.Undo(); return;
                default: solver.Solve(); return;
            }
        }
        if (thing is Pose) ((Pose)thing).DeformDouble();
        else if (thing is Geodesics) ((Geodesics)thing).Solve(new uint[] { 0 });
        else if (thing is Direction) ((Direction)thing).Record();
        else if (thing is Flow) ((Flow)thing).Trace(heights, wantedCount: 2);
        else if (thing is Region) { var info = ((Region)thing).Info; }
    }

    static void Run(int number, int calls)
    {
        var draw = new Random(number);
        for (int i = 0; i < calls; ++i)
        {
            try
            {
                int at = draw.Next(Slots);
                double action = draw.NextDouble();
                HfObject thing = slots[at];
                if (thing == null || action < 0.1) slots[at] = Make(draw); // what stood there is left to the collector
                else if (action < 0.2) thing.Dispose();
                else if (action < 0.202) GC.Collect();
                else Use(thing, draw);
            }
            catch (HfException error)
            {
                if (error.Name == "HF_ERROR_INTERNAL") unexpected.Enqueue(error.ToString());
                refused.AddOrUpdate(error.Name, 1, (_, count) => count + 1);
            }
            catch (Exception error) { unexpected.Enqueue(error.ToString()); }
        }
    }

    static int Main()
    {
        int calls = Environment.GetEnvironmentVariable("HF_FULL_TESTS") != null ? 100000 : 4000;
        MakeMesh();
        for (int i = 0; i < 2; ++i) surfaces[i] = new Surface(positions, triangles);
        var threads = Enumerable.Range(0, Threads).Select(i => new Thread(() => Run(i, calls / Threads))).ToList();
        threads.ForEach(thread => thread.Start());
        threads.ForEach(thread => thread.Join());
        Console.WriteLine(calls + " calls of " + Threads + " threads; refused: "
            + string.Join(", ", refused.OrderBy(pair => pair.Key).Select(pair => pair.Key + " " + pair.Value)));
        foreach (string error in unexpected.Take(5)) Console.WriteLine(error);
        return unexpected.IsEmpty && refused.ContainsKey("HF_ERROR_INVALID_OBJECT") ? 0 : 1;
    }
}
