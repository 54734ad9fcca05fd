// Stand-ins for the part of Unity's API that bindings/unity uses: it compiles, and UnityPlays.cs runs it. Objects,
// transforms and matrices are real; the editor does nothing.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;

namespace UnityEngine
{
    public class Object
    {
        public virtual string name { get; set; }
        /// <summary>At once; Unity waits for the end of the frame.</summary>
        public static void Destroy(GameObject gone)
        {
            foreach (Component one in gone.components.OfType<MonoBehaviour>())
            {
                var told = one.GetType().GetMethod("OnDestroy", BindingFlags.Instance | BindingFlags.NonPublic);
                if (told != null) told.Invoke(one, null);
            }
            gone.transform.parent.children.Remove(gone.transform);
        }
        public static T Instantiate<T>(T original) where T : Object { return (T)original.MemberwiseClone(); }
    }
    public class Component : Object
    {
        public GameObject gameObject;
        public Transform transform { get { return gameObject.transform; } }
        public override string name { get { return gameObject.name; } set { gameObject.name = value; } }
        public T GetComponent<T>() { return gameObject.components.OfType<T>().FirstOrDefault(); }
        public T GetComponentInParent<T>()
        {
            for (Transform at = transform; at != null; at = at.parent)
                foreach (T found in at.gameObject.components.OfType<T>()) return found;
            return default(T);
        }
        public T[] GetComponentsInChildren<T>()
        {
            return gameObject.components.OfType<T>().Concat(transform.children.SelectMany(child =>
                child.GetComponentsInChildren<T>())).ToArray();
        }
    }
    public class MonoBehaviour : Component { }
    public class GameObject : Object
    {
        public readonly List<Component> components = new List<Component>();
        public readonly Transform transform;
        public GameObject(string name) { this.name = name; transform = AddComponent<Transform>(); }
        public T AddComponent<T>() where T : Component, new()
        {
            var made = new T { gameObject = this };
            components.Add(made);
            return made;
        }
    }
    public class Transform : Component
    {
        public readonly List<Transform> children = new List<Transform>();
        public Transform parent;
        public Vector3 localPosition, localScale = Vector3.one;
        public Quaternion localRotation = Quaternion.identity;
        public int childCount { get { return children.Count; } }
        public Transform GetChild(int i) { return children[i]; }
        public Matrix4x4 localToWorldMatrix { get {
            Matrix4x4 own = Matrix4x4.TRS(localPosition, localRotation, localScale);
            return parent == null ? own : parent.localToWorldMatrix * own; } }
        public Matrix4x4 worldToLocalMatrix { get { return localToWorldMatrix.inverse; } }
        public Vector3 position { get { return localToWorldMatrix.GetColumn(3); } set { localPosition = value; } }
        public Quaternion rotation { get { return localToWorldMatrix.rotation; } set { localRotation = value; } }
        public void SetParent(Transform parent, bool keep) { this.parent = parent; parent.children.Add(this); }
    }
    public class MeshFilter : Component { public Mesh sharedMesh; }
    public class Mesh : Object
    {
        Vector3[] at;
        public Vector3[] vertices { get { return (Vector3[])at.Clone(); } set { at = (Vector3[])value.Clone(); } }
        public Vector3[] normals;
        public int[] triangles;
        public void MarkDynamic() { }
        public void RecalculateBounds() { }
    }
    public class TextAsset : Object { public byte[] bytes; }
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static readonly Vector3 one = new Vector3(1, 1, 1);
        public static Vector3 operator -(Vector3 v) { return new Vector3(-v.x, -v.y, -v.z); }
    }
    public struct Vector4 { public float x, y, z, w;
        public static implicit operator Vector3(Vector4 v) { return new Vector3(v.x, v.y, v.z); } }
    public struct Quaternion
    {
        public float x, y, z, w;
        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
        public static readonly Quaternion identity = new Quaternion(0, 0, 0, 1);
        public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }
        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
                a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }
    }
    public static class Mathf
    {
        public static float Abs(float x) { return Math.Abs(x); }
        public static float Max(float a, float b) { return Math.Max(a, b); }
    }
    public struct Matrix4x4
    {
        float[] m; // column by column; null: all 0
        Matrix4x4(Func<int, int, float> entry)
        {
            m = new float[16];
            for (int k = 0; k < 16; ++k) m[k] = entry(k % 4, k / 4);
        }
        public float this[int index] { get { return m == null ? 0 : m[index]; } }
        float At(int row, int column) { return this[4 * column + row]; }
        public Vector4 GetColumn(int c) { return new Vector4 { x = At(0, c), y = At(1, c), z = At(2, c), w = At(3, c) }; }
        public static Matrix4x4 identity { get { return new Matrix4x4((r, c) => r == c ? 1 : 0); } }
        public static Matrix4x4 Translate(Vector3 t) { return TRS(t, Quaternion.identity, Vector3.one); }
        public static Matrix4x4 Rotate(Quaternion q) { return TRS(new Vector3(), q, Vector3.one); }
        public static Matrix4x4 TRS(Vector3 t, Quaternion q, Vector3 s)
        {
            float x = q.x, y = q.y, z = q.z, w = q.w;
            float[,] a = { { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), t.x },
                { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), t.y },
                { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), t.z }, { 0, 0, 0, 1 } };
            float[] size = { s.x, s.y, s.z, 1 };
            return new Matrix4x4((r, c) => a[r, c] * size[c]);
        }
        public static Matrix4x4 operator *(Matrix4x4 a, Matrix4x4 b)
        {
            return new Matrix4x4((r, c) => Enumerable.Range(0, 4).Sum(k => a.At(r, k) * b.At(k, c)));
        }
        public Matrix4x4 inverse { get {
            Matrix4x4 a = this;
            Func<int, int, float> minor = (r, c) => a.At((r + 1) % 3, (c + 1) % 3) * a.At((r + 2) % 3, (c + 2) % 3)
                - a.At((r + 1) % 3, (c + 2) % 3) * a.At((r + 2) % 3, (c + 1) % 3);
            float whole = Enumerable.Range(0, 3).Sum(c => a.At(0, c) * minor(0, c));
            Func<int, int, float> linear = (r, c) => minor(c, r) / whole;
            return new Matrix4x4((r, c) => r == 3 ? (c == 3 ? 1 : 0) : c < 3 ? linear(r, c)
                : -Enumerable.Range(0, 3).Sum(k => linear(r, k) * a.At(k, 3))); } }
        public Quaternion rotation { get {
            var size = new float[3];
            for (int c = 0; c < 3; ++c)
                size[c] = (float)Math.Sqrt(At(0, c) * At(0, c) + At(1, c) * At(1, c) + At(2, c) * At(2, c));
            Matrix4x4 a = this;
            Func<int, int, float> turn = (r, c) => a.At(r, c) / size[c];
            // the largest of the four squares is safe to divide by
            float[] squares = { 1 + turn(0, 0) - turn(1, 1) - turn(2, 2), 1 - turn(0, 0) + turn(1, 1) - turn(2, 2),
                1 - turn(0, 0) - turn(1, 1) + turn(2, 2), 1 + turn(0, 0) + turn(1, 1) + turn(2, 2) };
            int most = Array.IndexOf(squares, squares.Max());
            float half = (float)Math.Sqrt(squares[most]) / 2, part = 0.25f / half;
            float yz = turn(2, 1) - turn(1, 2), zx = turn(0, 2) - turn(2, 0), xy = turn(1, 0) - turn(0, 1);
            float x = turn(1, 0) + turn(0, 1), y = turn(0, 2) + turn(2, 0), z = turn(2, 1) + turn(1, 2);
            float[][] rows = { new[] { half, part * x, part * y, part * yz }, new[] { part * x, half, part * z, part * zx },
                new[] { part * y, part * z, half, part * xy }, new[] { part * yz, part * zx, part * xy, half } };
            return new Quaternion(rows[most][0], rows[most][1], rows[most][2], rows[most][3]); } }
    }
    public static class Time { public static float deltaTime; }
    public static class Debug { public static void LogWarning(object message, Object context) {
        Console.WriteLine(message); } }
    public static class GUILayout { public static bool Button(string text) { return false; } }
    public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string text) { } }
    public sealed class RangeAttribute : Attribute { public RangeAttribute(float low, float high) { } }
    public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string path) { } }
    public sealed class RequireComponent : Attribute { public RequireComponent(Type type) { } }
    public sealed class ExecuteAlways : Attribute { }
}

namespace UnityEditor
{
    using UnityEngine;
    public class Editor : Object { public Object target;
        public virtual void OnInspectorGUI() { } public void DrawDefaultInspector() { } }
    public sealed class CustomEditor : Attribute { public CustomEditor(Type type) { } }
    public enum MessageType { Warning }
    public static class EditorGUILayout { public static void HelpBox(string text, MessageType type) {
        } public static void LabelField(string label, string text) { } }
    public static class EditorGUI { public static void BeginChangeCheck() { } public static bool EndChangeCheck() {
        return false; } }
    public static class Handles { public static Vector3 PositionHandle(Vector3 at, Quaternion turn) { return at; }
        public static Quaternion RotationHandle(Quaternion turn, Vector3 at) { return turn; } }
    public static class Undo { public static void RegisterCreatedObjectUndo(Object o, string name) {
        } public static void RecordObject(Object o, string name) { }
        public static void RecordObjects(Object[] o, string name) { } }
    public static class Selection { public static GameObject activeGameObject; }
    public static class AssetDatabase { public static void ImportAsset(string path) {
        } public static T LoadAssetAtPath<T>(string path) { return default(T); } }
    public static class EditorUtility { public static string SaveFilePanelInProject(string title, string name,
        string extension, string message) { return null; } }
}
