// Says the version of the library that the binding found, or the one sentence about what is missing.
using System;
using Hf;

static class CsharpLibrary
{
    static void Main()
    {
        try
        {
            using (var surface = new Surface(new float[] { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, new uint[] { 0, 1, 2 }))
                Console.WriteLine("found " + (surface.VertexCount == 3));
        }
        catch (DllNotFoundException failure) { Console.WriteLine(failure.Message); }
    }
}
