// The components for Unity in the stand-ins of UnityStubs.cs: each name of a test is the sentence that it proves.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Hf;
using Hf.Unity;
using UnityEngine;

static class UnityPlays
{
    static int failed;

    static void Expect(bool condition, string sentence)
    {
        Console.WriteLine((condition ? "ok      " : "FAILED  ") + sentence);
        if (!condition) ++failed;
    }

    /// <summary>What Unity calls by its name.</summary>
    static void Send(MonoBehaviour component, string message)
    {
        component.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic | BindingFlags.Public)
            .Invoke(component, null);
    }

    static float Far(Vector3 a, Vector3 b)
    {
        return (float)Math.Sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
    }

    // ---- how much follows

    /// <summary>A flat body of squares: a trunk from y = 0 to 12, and an arm to x = 12 at its shoulder.</summary>
    static Mesh Body()
    {
        var vertices = new List<Vector3>();
        var triangles = new List<int>();
        var number = new Dictionary<int, int>();
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < (y == 8 || y == 9 ? 12 : 4); ++x)
            {
                int[] corners = { 13 * y + x, 13 * y + x + 1, 13 * y + x + 13, 13 * y + x + 14 };
                foreach (int corner in corners.Where(corner => !number.ContainsKey(corner)))
                {
                    number[corner] = vertices.Count;
                    vertices.Add(new Vector3(corner % 13, corner / 13, 0));
                }
                foreach (int k in new[] { 0, 2, 1, 1, 2, 3 }) triangles.Add(number[corners[k]]);
            }
        return new Mesh { vertices = vertices.ToArray(), triangles = triangles.ToArray() };
    }

    static HfHandle Handle(HfDeformer deformer, Vector3 place)
    {
        var made = new GameObject("handle");
        made.transform.SetParent(deformer.transform, false);
        made.transform.localPosition = place;
        var handle = made.AddComponent<HfHandle>();
        handle.radius = 1.2f;
        return handle;
    }

    static void Following()
    {
        var body = new GameObject("body");
        var filter = body.AddComponent<MeshFilter>();
        Mesh rest = filter.sharedMesh = Body();
        var deformer = body.AddComponent<HfDeformer>();
        Handle(deformer, new Vector3(2, 0, 0));
        HfHandle hand = Handle(deformer, new Vector3(12, 9, 0));
        Func<int, int, Vector3> at = (x, y) => filter.sharedMesh.vertices[Array.FindIndex(rest.vertices, v => v.x == x && v.y == y)];
        Func<float, float> headMoves = following =>
        {
            hand.following = following;
            for (int frame = 0; frame < 60; ++frame) Send(deformer, "LateUpdate");
            return Far(at(2, 12), new Vector3(2, 12, 0)) / (float)Math.Sqrt(288);
        };
        Send(deformer, "LateUpdate");
        hand.transform.localPosition = new Vector3(9, 13, 0);
        float whole = headMoves(1), tip = headMoves(HfHandle.TipFollowing);
        Expect(deformer.LastError == null && Far(at(12, 9), new Vector3(9, 13, 0)) < hand.radius, "a dragged hand lands: " + deformer.LastError);
        Expect(tip < 0.03 && tip < 0.5 * whole,
            string.Format("a dragged hand moves the head by less than .03 of the box: {0:0.000}, and {1:0.000} where all follows", tip, whole));
        Expect(Math.Abs(headMoves(1) - whole) < 1e-3, "the dial goes back");
        headMoves(HfHandle.TipFollowing);
        Vector3 elbow = at(8, 9), head = at(2, 12);
        hand.keepLengths = true;
        headMoves(HfHandle.TipFollowing);
        Expect(Far(at(8, 9), elbow) > 0.01 && Far(at(2, 12), head) < 1e-3, "a limb that keeps its lengths goes elsewhere, and the head stays");
        hand.following = 2;
        Send(deformer, "LateUpdate");
        Expect(deformer.LastError != null && deformer.LastError.Contains("following"), "a wrong dial is said: " + deformer.LastError);
        deformer.Release();
    }

    // ---- a sword in a hand

    /// <summary>The body, and a blade of 2 by 10 squares whose lower end stands in the hand at (12, 9). The arm and the blade
    /// touch nowhere.</summary>
    static Mesh Armed()
    {
        Mesh body = Body();
        var vertices = body.vertices.ToList();
        var triangles = body.triangles.ToList();
        int first = vertices.Count;
        for (int y = 0; y <= 10; ++y)
            for (int x = 0; x <= 1; ++x) vertices.Add(new Vector3(12.1f + 0.5f * x, 8.5f + 0.5f * y, 0));
        for (int y = 0; y < 10; ++y)
            foreach (int k in new[] { 0, 2, 1, 1, 2, 3 }) triangles.Add(first + 2 * y + k);
        return new Mesh { vertices = vertices.ToArray(), triangles = triangles.ToArray() };
    }

    static void Attached()
    {
        var body = new GameObject("body");
        var filter = body.AddComponent<MeshFilter>();
        Mesh rest = filter.sharedMesh = Armed();
        int grip = Array.FindIndex(rest.vertices, v => v.x == 12.1f && v.y == 9), tip = rest.vertices.Length - 1;
        int palm = Array.FindIndex(rest.vertices, v => v.x == 12 && v.y == 9);
        var deformer = body.AddComponent<HfDeformer>();
        var sword = new GameObject("sword").AddComponent<Sword>(); // of the README
        sword.body = deformer;
        sword.grip = grip;
        sword.reach = 1.2f;
        Handle(deformer, new Vector3(2, 0, 0));
        HfHandle hand = Handle(deformer, new Vector3(12, 9, 0));
        Func<int, Vector3> at = v => filter.sharedMesh.vertices[v];
        Action<Vector3> drag = to =>
        {
            hand.transform.localPosition = to;
            for (int frame = 0; frame < 60; ++frame) Send(deformer, "LateUpdate");
        };
        drag(new Vector3(12, 9, 0));
        drag(new Vector3(10, 12, 2));
        Expect(Far(at(grip), rest.vertices[grip]) < 1e-4, "a sword that nothing links stays at rest");
        sword.TakeUp();
        Expect(deformer.Surface.Links().Length == 3 && deformer.Surface.Report.ComponentCount == 1, "three links join the sword to the hand");
        Expect(deformer.Surface.Links().Count(link => link.Length < 0.11) == 2, "by the shortest ways");
        drag(new Vector3(9, 13, 2));
        Vector3 held = at(grip), heldTip = at(tip);
        Expect(Far(held, at(palm)) < 0.2 && Math.Abs(Far(held, heldTip) - Far(rest.vertices[grip], rest.vertices[tip])) < 0.05,
            "the sword follows the hand that is dragged, and keeps its length: " + Far(held, at(palm)));
        sword.Drop();
        HfHandle dropped = deformer.GetComponentsInChildren<HfHandle>().Last();
        Expect(deformer.Surface.Report.ComponentCount == 2 && deformer.Surface.Links().Length == 0, "a sword that is dropped is a component");
        drag(new Vector3(12, 9, 0));
        Expect(deformer.LastError == null && Far(at(grip), held) < 0.02 && Far(at(tip), heldTip) < 0.02 && Far(at(palm), held) > 3,
            "it stays where it was dropped while the hand goes on: " + Far(at(grip), held));
        Vector3 place = dropped.transform.localPosition;
        dropped.transform.localPosition = new Vector3(place.x, place.y - 4, place.z);
        Send(deformer, "LateUpdate");
        Expect(Math.Abs(at(tip).y - heldTip.y + 4) < 0.02, "its handle lets it fall");
        sword.TakeUp();
        Expect(deformer.GetComponentsInChildren<HfHandle>().Length == 2, "the handle of the dropped sword goes");
        drag(new Vector3(10, 12, 2));
        Expect(Far(at(grip), at(palm)) < 0.2, "it is taken up again");
        try { deformer.Attach(tip, 0.1f); Expect(false, "nothing in reach is said"); }
        catch (HfException failure) { Expect(failure.Message.Contains("no other piece"), "nothing in reach is said: " + failure.Message); }
        deformer.Edit(new uint[] { 0, 1 }, new double[] { 100, 100 });
        Expect(deformer.Surface.Stiffness()[1] == 100, "stiffness in place");
        deformer.Release();
    }

    // ---- one skeleton on another

    static readonly string[] names = { "hips", "spine", "head", "left_thigh", "left_shin", "left_foot", "right_thigh",
        "right_shin", "right_foot" };
    static readonly int[] parents = { -1, 0, 1, 0, 3, 4, 0, 6, 7 };
    // Unity's left is -x of a body that looks along z
    static readonly float[,] places = { { 0, 1, 0 }, { 0, 0.3f, 0 }, { 0, 0.4f, 0 }, { -0.1f, -0.05f, 0 }, { 0, -0.45f, 0.02f },
        { 0, -0.42f, -0.02f }, { 0.1f, -0.05f, 0 }, { 0, -0.45f, 0.02f }, { 0, -0.42f, -0.02f } };

    static Quaternion Turn(float x, float y, float z, double angle)
    {
        var s = (float)Math.Sin(angle / 2);
        return new Quaternion(s * x, s * y, s * z, (float)Math.Cos(angle / 2));
    }

    /// <summary>A body of bones; each is turned about x by `roll` at rest, which moves no joint.</summary>
    static Transform[] Bones(float size, double roll)
    {
        var made = new Transform[names.Length];
        for (int i = 0; i < names.Length; ++i)
        {
            made[i] = new GameObject(names[i]).transform;
            var place = new Vector3(size * places[i, 0], size * places[i, 1], size * places[i, 2]);
            if (parents[i] >= 0) made[i].SetParent(made[parents[i]], false);
            // the frame of the parent is turned already
            Matrix4x4 back = Matrix4x4.Rotate(Turn(1, 0, 0, parents[i] < 0 ? 0 : -roll)) * Matrix4x4.Translate(place);
            made[i].localPosition = back.GetColumn(3);
            if (parents[i] < 0) made[i].localRotation = Turn(1, 0, 0, roll);
        }
        return made;
    }

    /// <summary>The pose of bones in the library's space, which mirrors Unity's in x.</summary>
    static float[] Plain(Transform[] bones)
    {
        return bones.SelectMany(b => new[] { -b.localPosition.x, b.localPosition.y, b.localPosition.z, b.localRotation.x,
            -b.localRotation.y, -b.localRotation.z, b.localRotation.w, b.localScale.x, b.localScale.y, b.localScale.z }).ToArray();
    }

    static float Far(float[] a, float[] b) { return a.Zip(b, (x, y) => Math.Abs(x - y)).Max(); }

    static void Retargeted()
    {
        Transform[] man = Bones(1, 0), robot = Bones(2, 1.2);
        Func<Transform[], Skeleton> skeleton = bones => new Skeleton(names,
            parents.Select(p => p < 0 ? uint.MaxValue : (uint)p).ToArray(), Plain(bones));
        var component = new GameObject("player").AddComponent<HfRetarget>();
        Send(component, "OnEnable");
        Send(component, "LateUpdate");
        Expect(component.Info == null && component.LastError == null, "without skeletons it waits");
        component.source = man[0];
        component.target = robot[0];
        Retarget plain;
        using (Skeleton first = skeleton(man), second = skeleton(robot)) plain = new Retarget(first, second);
        float[] rest = Plain(robot);
        Send(component, "OnEnable");
        Expect(component.Info != null && component.Info.MatchedJointCount == names.Length, "every joint has its partner");
        Time.deltaTime = 0.04f;
        float most = 0;
        for (int frame = 0; frame < 20; ++frame)
        {
            man[0].localPosition = new Vector3(0, 1, 0.05f * frame);
            man[0].localRotation = Turn(0, 1, 0, 0.02 * frame);
            man[3].localRotation = Turn(1, 0, 0, -0.05 * frame);
            Send(component, "LateUpdate");
            most = Math.Max(most, Far(Plain(robot), plain.Solve(Plain(man), Time.deltaTime)));
        }
        Expect(most == 0, "a frame is what the library makes of the plain arrays: " + most);
        Expect(Far(Plain(robot), rest) > 1, "the robot walks on");
        Vector3 knee = robot[4].position, hip = robot[3].position, kneeOfMan = man[4].position, hipOfMan = man[3].position;
        Expect(Math.Abs((knee.z - hip.z) - 2 * (kneeOfMan.z - hipOfMan.z)) < 0.05 && knee.z - hip.z > 0.5 && hip.x < 0,
            "the left knee of the robot comes forward, as the man's does");
        man[3].localRotation = new Quaternion(float.NaN, 0, 0, 1);
        float[] stood = Plain(robot);
        Send(component, "LateUpdate");
        Expect(component.LastError != null && Far(Plain(robot), stood) == 0, "a wrong pose is said, and the robot stands: " + component.LastError);
        man[3].localRotation = Quaternion.identity;
        component.ResetFeet();
        Send(component, "LateUpdate");
        Expect(component.LastError == null, "and it goes on");
        Send(component, "OnDisable");
    }

    static int Main()
    {
        Following();
        Attached();
        Retargeted();
        return failed == 0 ? 0 : 1;
    }
}
