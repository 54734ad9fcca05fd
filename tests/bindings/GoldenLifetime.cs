// Lifetime, memory and wrong arguments of the C# classes, for Golden.cs.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Hf;
using Map = System.Collections.Generic.Dictionary<string, object>;
using Items = System.Collections.Generic.List<object>;

static class Lifetime
{
    static double[] positions;
    static uint[] triangles;

    public static void Use(Map mesh)
    {
        positions = ((Items)mesh["positions"]).Select(x => (double)x).ToArray();
        triangles = ((Items)mesh["triangles"]).Select(x => (uint)(double)x).ToArray();
    }

    static int Rounds(int count)
    {
        var draw = new Random(7);
        int calls = 0;
        for (int round = 0; round < count; ++round)
        {
            using (var quad = new Surface(new float[] { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, faceStarts: new uint[] { 0, 4 },
            corners: new uint[] { 0, 1, 2, 3 }))
        using (var held = new Solver(quad))
        {
            Hit hit = quad.CastRay(new[] { 0.3, 0.6, 1.0 }, new[] { 0.0, 0.0, -1.0 });
            held.AddSites(null, new[] { 2.0 }, places: new Place[] { hit });
            var field = new float[4];
            held.Solve(field);
            if (hit.Triangle != 0 || quad.MeshStatistics.PolygonCount != 1 || Math.Abs(field[3] - 2) > 1e-6)
                throw new Exception("a hit in a quad is no site");
        }
        var surface = new Surface(positions, triangles);
            var solver = new Solver(surface);
            var pose = new Pose(surface);
            pose.AddHandles(new[] { new uint[] { 0, 1, 2 }, new uint[] { 280, 281 } });
            var things = new List<HfObject> { surface, solver, solver.Clone(), pose, pose.Clone(),
                new Transfer(surface, surface), new Geodesics(surface), new Direction(surface), new Flow(surface),
                new Progress() };
            foreach (HfObject thing in things.OrderBy(x => draw.Next()).ToList())
            {
                if (draw.NextDouble() < 0.6)
                {
                    thing.Dispose();
                    thing.Dispose();
                    try
                    {
                        if (thing is Surface) { var info = ((Surface)thing).Info; }
                        else if (thing is Solver) ((Solver)thing).Solve();
                        else if (thing is Pose) ((Pose)thing).DeformDouble();
                        else if (thing is Transfer) { var info = ((Transfer)thing).Info; }
                        else if (thing is Geodesics) ((Geodesics)thing).Solve(new uint[] { 0 });
                        else if (thing is Direction) ((Direction)thing).Record();
                        else if (thing is Flow) ((Flow)thing).Trace(new double[positions.Length / 3], wantedCount: 4);
                        else { double f = ((Progress)thing).Fraction; }
                        throw new Exception("a call on a disposed " + thing.GetType().Name + " did not fail");
                    }
                    catch (HfException error) { if (error.Name != "HF_ERROR_INVALID_OBJECT") throw; ++calls; }
                }
                else if (thing is Pose) ((Pose)thing).Deform(new float[positions.Length], new float[positions.Length]);
            }
            if (round % 10 == 0) { things.Clear(); GC.Collect(); GC.WaitForPendingFinalizers(); }
        }
        GC.Collect();
        GC.WaitForPendingFinalizers();
        return calls;
    }

    static long Resident() { return long.Parse(File.ReadAllText("/proc/self/statm").Split(' ')[1]) * 4096; }

    public static void Run()
    {
        if (Rounds(60) < 100) throw new Exception("too few calls on disposed objects");
        long before = Resident();
        Rounds(200);
        Console.WriteLine("memory after 200 more rounds: " + (Resident() - before) / 1e6 + " MB");
        if (Resident() - before > 40e6) throw new Exception("memory does not come back");
    }

    public static void WrongArguments()
    {
        var wrong = new Action[] { () => new Surface((float[])null, triangles),
            () => new Surface(new float[4], triangles), () => new Surface(positions, new uint[4]),
            () => new Surface(positions, new ushort[4]), () => new Surface(positions, (uint[])null),
            () => new Solver(null), () => new Pose(null),
            () => new Transfer(null, null), () => new Geodesics(null), () => new Direction(null),
                () => new Quads(null), () => new Flow(null),
                () => new Solver(new Surface(positions, triangles)).Solve(new float[3]),
                () => new Pose(new Surface(positions, triangles)).Deform(new float[2]),
                () => new Pose(new Surface(positions, triangles)).AddHandleAt(new double[2], 1),
                () => new Surface(positions, triangles).CastRay(new double[2], new double[3]) };
        foreach (Action action in wrong)
        {
            try { action(); }
            catch (HfException) { continue; }
            throw new Exception("a wrong argument was taken");
        }
    }

    /// <summary>Objects are cloned, or refuse to be written, by name; a copy of the managed part is the same object.</summary>
    public static void Copies()
    {
        var surface = new Surface(positions, triangles);
        var solver = new Solver(surface);
        solver.AddSites(new uint[] { 0, 1 }, new double[] { 0, 1 });
        foreach (HfObject thing in new HfObject[] { surface, solver, new Pose(surface), new Geodesics(surface),
            new Direction(surface), new Flow(surface), new Region(surface), new Transfer(surface, surface),
            new Weights(surface, new double[3], new double[] { 1, 0, 0 }),
            new Progress() })
        {
            try
            {
                new System.Runtime.Serialization.Formatters.Binary.BinaryFormatter().Serialize(Stream.Null, thing);
                throw new Exception(thing.GetType().Name + " was written");
            }
            catch (System.Runtime.Serialization.SerializationException error)
            {
                if (!error.Message.Contains(thing.GetType().FullName)) throw;
            }
        }
        var clone = typeof(object).GetMethod("MemberwiseClone",
            System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic);
        var twin = (Solver)clone.Invoke(solver, null);
        twin.Dispose();
        solver.Dispose();
        try { solver.Solve(); }
        catch (HfException error) { if (error.Name == "HF_ERROR_INVALID_OBJECT") return; }
        throw new Exception("a copy and its original do not close together");
    }
}
