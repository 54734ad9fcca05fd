// Deforms the mesh of a MeshFilter so that the regions of its HfHandle children follow them. The surface is made once,
// at the first use; handles come and go on it.
using System.Collections.Generic;
using UnityEngine;

namespace Hf.Unity
{
    [ExecuteAlways]
    [RequireComponent(typeof(MeshFilter))]
    [AddComponentMenu("hf/Deformer")]
    public sealed class HfDeformer : MonoBehaviour
    {
        [Tooltip("Threads the library may use, this one included")]
        [Range(1, 16)] public int threads = 1;
        [Tooltip("Iterations of the pose per frame; 0: the library's default")]
        [Range(0, 100)] public int iterations;
        [Tooltip("A factor saved in the editor (HfDeformerEditor), so that nothing is factorised at run time")]
        public TextAsset savedFactor;

        Mesh rest, posed;
        Surface surface;
        Pose pose;
        float[] positions, normals;
        Vector3[] vertices, directions;
        readonly List<HfHandle> bound = new List<HfHandle>();
        bool changed = true;

        public Surface Surface { get { Bind(); return surface; } }
        public Pose Pose { get { Bind(); return pose; } }
        public string LastError { get; private set; }
        public int HandleCount { get { return bound.Count; } }

        public void HandlesChanged() { changed = true; }

        void OnDisable() { Release(); }

        /// <summary>Gives the memory back and shows the rest mesh again.</summary>
        public void Release()
        {
            if (pose != null) pose.Dispose();
            if (surface != null) surface.Dispose();
            pose = null;
            surface = null;
            foreach (HfHandle handle in bound) if (handle != null) handle.bound = false;
            bound.Clear();
            changed = true;
            if (rest != null) GetComponent<MeshFilter>().sharedMesh = rest;
            rest = null;
        }

        void Bind()
        {
            if (surface != null) return;
            var filter = GetComponent<MeshFilter>();
            rest = filter.sharedMesh;
            if (rest == null) throw new HfException("the MeshFilter has no mesh");
            vertices = rest.vertices;
            directions = new Vector3[vertices.Length];
            positions = new float[3 * vertices.Length];
            normals = new float[3 * vertices.Length];
            for (int v = 0; v < vertices.Length; ++v)
            {
                positions[3 * v] = vertices[v].x;
                positions[3 * v + 1] = vertices[v].y;
                positions[3 * v + 2] = vertices[v].z;
            }
            // Unity's triangles are clockwise, the library's counter-clockwise
            int[] corners = rest.triangles;
            var triangles = new uint[corners.Length];
            for (int i = 0; i < corners.Length; i += 3)
            {
                triangles[i] = (uint)corners[i];
                triangles[i + 1] = (uint)corners[i + 2];
                triangles[i + 2] = (uint)corners[i + 1];
            }
            surface = new Surface(positions, triangles, threadCount: (uint)threads,
                savedFactor: savedFactor != null ? savedFactor.bytes : null);
            pose = new Pose(surface);
            posed = Instantiate(rest);
            posed.MarkDynamic();
            filter.sharedMesh = posed;
        }

        void Sync()
        {
            changed = false;
            var present = new HashSet<HfHandle>(GetComponentsInChildren<HfHandle>());
            for (int i = bound.Count - 1; i >= 0; --i)
            {
                if (bound[i] != null && present.Contains(bound[i])) continue;
                pose.RemoveHandles(new uint[] { numbers[i] });
                if (bound[i] != null) bound[i].bound = false;
                bound.RemoveAt(i);
                numbers.RemoveAt(i);
            }
            foreach (HfHandle handle in present)
            {
                if (handle.bound) continue;
                handle.restLocal = Rigid(transform.worldToLocalMatrix * handle.transform.localToWorldMatrix);
                Vector4 at = handle.restLocal.GetColumn(3);
                Keep(handle, pose.AddHandles(points: new double[] { at.x, at.y, at.z },
                    radii: new double[] { handle.radius }, layer: (uint)handle.layer)[0]);
            }
        }

        /// <summary>Binds a handle to one that the pose has.</summary>
        void Keep(HfHandle handle, uint number)
        {
            handle.number = number;
            handle.bound = true;
            handle.centroid = At(pose.Handle(number).Centroid);
            handle.free = false;
            handle.told = 1;
            handle.steps = 0;
            handle.seen = Matrix4x4.identity;
            handle.turn = Quaternion.identity;
            bound.Add(handle);
            numbers.Add(number);
        }

        static Vector3 At(double[] place) { return new Vector3((float)place[0], (float)place[1], (float)place[2]); }

        readonly List<uint> numbers = new List<uint>();

        static Matrix4x4 Rigid(Matrix4x4 matrix) { return Matrix4x4.TRS(matrix.GetColumn(3), matrix.rotation,
            Vector3.one); }

        /// <summary>What a change of the transform says of the rotation, and the motion of the handle.</summary>
        Matrix4x4 Look(HfHandle handle, Matrix4x4 motion)
        {
            bool moved = Far(motion, handle.seen, 12, 15), turned = Far(motion, handle.seen, 0, 12);
            bool wanted = handle.rotation == HfRotation.Free;
            if (handle.rotation == HfRotation.Automatic && handle.layer == 0)
            {
                wanted = !turned && (handle.free || moved);
                if (turned) handle.rotation = HfRotation.Given;
            }
            if (handle.free && !wanted && handle.layer == 0)
            {
                // the given rotation begins where the pose has turned the handle to
                double[] q = pose.Handle(handle.number).Rotation;
                var found = new Quaternion((float)q[0], (float)q[1], (float)q[2], (float)q[3]);
                handle.turn = Quaternion.Inverse(handle.seen.rotation) * found;
            }
            if (handle.free != wanted) pose.SetFreeRotations(new uint[] { handle.number }, wanted);
            handle.free = wanted;
            handle.seen = motion;
            // about the centroid, whose place a free handle keeps too
            Vector3 centre = handle.centroid;
            return motion * Matrix4x4.Translate(centre) * Matrix4x4.Rotate(handle.turn) * Matrix4x4.Translate(-centre);
        }

        /// <summary>The fewest steps with which hf_pose_set_limb_refine keeps lengths.</summary>
        const int LengthSteps = 8;

        /// <summary>Tells the pose the following and limb steps of a handle, if they have changed.</summary>
        void SetLimb(HfHandle handle)
        {
            if (handle.layer != 0) return;
            int steps = handle.keepLengths ? LengthSteps : 0;
            if (handle.told != handle.following) pose.SetFollowing(new uint[] { handle.number }, handle.following);
            handle.told = handle.following;
            if (handle.steps != steps) pose.SetLimbRefine(new uint[] { handle.number }, steps);
            handle.steps = steps;
        }

        /// <summary>Whether entries of two matrices differ by more than single precision rounds.</summary>
        static bool Far(Matrix4x4 a, Matrix4x4 b, int first, int end)
        {
            for (int k = first; k < end; ++k)
                if (Mathf.Abs(a[k] - b[k]) > 1e-5f * Mathf.Max(1, Mathf.Abs(b[k]))) return true;
            return false;
        }

        void LateUpdate()
        {
            try
            {
                Bind();
                if (changed) Sync();
                if (bound.Count == 0) return;
                var matrices = new double[16 * bound.Count];
                for (int i = 0; i < bound.Count; ++i)
                {
                    Matrix4x4 motion = Rigid(transform.worldToLocalMatrix * bound[i].transform.localToWorldMatrix)
                        * bound[i].restLocal.inverse;
                    motion = Look(bound[i], motion);
                    SetLimb(bound[i]);
                    for (int k = 0; k < 16; ++k) matrices[16 * i + k] = motion[k]; // column by column in both
                }
                pose.SetMatrices(numbers.ToArray(), matrices);
                pose.Deform(positions, normals, (uint)iterations);
                for (int v = 0; v < vertices.Length; ++v)
                {
                    vertices[v] = new Vector3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
                    directions[v] = new Vector3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
                }
                posed.vertices = vertices;
                posed.normals = directions;
                posed.RecalculateBounds();
                LastError = null;
            }
            catch (HfException failure)
            {
                if (LastError != failure.Message) Debug.LogWarning("hf: " + failure.Message, this);
                LastError = failure.Message; // nothing has changed; said once
            }
        }

        // ---- edits: nothing is factorised, and handles stay where they have been dragged

        /// <summary>Surface.Edit in place: stiffness and links of the mesh, and the pose moves along. A Solver that you have
        /// made on Surface moves with its MoveTo.</summary>
        public void Edit(uint[] vertices = null, double[] stiffness = null, Link[] links = null, uint[] removedLinks = null)
        {
            Bind();
            Surface edited = surface.Edit(vertices, stiffness, links, removedLinks);
            try { pose.MoveTo(edited); }
            catch { edited.Dispose(); throw; }
            surface.Dispose();
            surface = edited;
        }

        /// <summary>One link holds a piece; three hold it at their own places. More cost more: a link costs up to six
        /// elimination paths.</summary>
        const int MostLinks = 3;

        /// <summary>Links the piece of a vertex, such as a sword, to the nearest vertices of other pieces: the shortest ways
        /// within a radius of the vertex, at rest. So the sword stands in the hand at rest. Returns the count of links.</summary>
        public int Attach(int vertex, float radius)
        {
            Bind();
            uint[] piece = surface.Pieces().Pieces;
            Vector3[] at = rest.vertices;
            var near = new List<int>();
            for (int v = 0; v < at.Length; ++v) // isolated vertices have no piece
                if (piece[v] != uint.MaxValue && Apart(at[v], at[vertex]) <= radius * radius) near.Add(v);
            var ways = new List<KeyValuePair<float, Link>>();
            foreach (int own in near)
            {
                if (piece[own] != piece[vertex]) continue;
                int to = -1;
                foreach (int other in near)
                    if (piece[other] != piece[vertex] && (to < 0 || Apart(at[own], at[other]) < Apart(at[own], at[to]))) to = other;
                if (to < 0) break;
                ways.Add(new KeyValuePair<float, Link>(Apart(at[own], at[to]), new Link { Vertex = (uint)own,
                    Corners = new[] { (uint)to, uint.MaxValue, uint.MaxValue }, Barycentrics = new double[] { 1, 0, 0 }, Weight = 1 }));
            }
            ways.Sort((a, b) => a.Key != b.Key ? a.Key.CompareTo(b.Key) : a.Value.Vertex.CompareTo(b.Value.Vertex));
            var links = new List<Link>();
            for (int i = 0; i < ways.Count && i < MostLinks; ++i) links.Add(ways[i].Value);
            if (links.Count == 0)
                throw new HfException("no other piece is within " + radius + " of vertex " + vertex, Hf.Native.Constants.HF_ERROR_EMPTY);
            Edit(links: links.ToArray());
            return links.Count;
        }

        static float Apart(Vector3 a, Vector3 b)
        {
            float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
            return x * x + y * y + z * z;
        }

        /// <summary>Takes out all links between the piece of a vertex and others. The piece stays where it stands: the handle
        /// that is returned holds it there, and moves it. Destroy the handle when you attach the piece again.</summary>
        public HfHandle Detach(int vertex)
        {
            Bind();
            if (changed) Sync();
            uint[] piece = surface.Pieces().Pieces;
            Link[] links = surface.Links();
            var removed = new List<uint>();
            for (int i = 0; i < links.Length; ++i)
                for (int k = 0; k < 3; ++k)
                    if (links[i].Barycentrics[k] > 0
                        && (piece[links[i].Vertex] == piece[vertex]) != (piece[links[i].Corners[k]] == piece[vertex]))
                    {
                        removed.Add((uint)i);
                        break;
                    }
            var region = new List<uint>();
            for (int v = 0; v < piece.Length; ++v) if (piece[v] == piece[vertex]) region.Add((uint)v);
            uint number = pose.AddHandles(new[] { region.ToArray() }, inPlace: true)[0];
            try { Edit(removedLinks: removed.ToArray()); }
            catch { pose.RemoveHandles(new[] { number }); throw; }
            var made = new GameObject("piece of vertex " + vertex);
            made.transform.SetParent(transform, false);
            var handle = made.AddComponent<HfHandle>();
            HandleInfo stands = pose.Handle(number);
            Vector3 centre = At(stands.Centroid), shift = At(stands.Translation);
            double[] q = stands.Rotation;
            made.transform.localPosition = new Vector3(centre.x + shift.x, centre.y + shift.y, centre.z + shift.z);
            made.transform.localRotation = new Quaternion((float)q[0], (float)q[1], (float)q[2], (float)q[3]);
            handle.rotation = HfRotation.Given;
            handle.restLocal = Matrix4x4.Translate(centre);
            Keep(handle, number);
            return handle;
        }

        /// <summary>The harmonic field that is 1 at some vertices and 0 at others.</summary>
        public float[] Field(uint[] ones, uint[] zeros)
        {
            Bind();
            using (var field = new Solver(surface))
            {
                if (ones.Length > 0)
                {
                    var high = new double[ones.Length];
                    for (int i = 0; i < high.Length; ++i) high[i] = 1;
                    field.AddSites(ones, high);
                }
                if (zeros.Length > 0) field.AddSites(zeros, new double[zeros.Length]);
                return field.Solve();
            }
        }
    }
}
