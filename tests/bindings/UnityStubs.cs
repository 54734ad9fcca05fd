// Stand-ins for the part of Unity's API that bindings/unity uses: enough to compile it, nothing runs.
using System;

namespace UnityEngine
{
    public class Object { public string name; public static T Instantiate<T>(T original) { return original; } }
    public class Component : Object
    {
        public Transform transform;
        public T GetComponent<T>() { return default(T); }
        public T GetComponentInParent<T>() { return default(T); }
        public T[] GetComponentsInChildren<T>() { return new T[0]; }
    }
    public class MonoBehaviour : Component { }
    public class GameObject : Object { public Transform transform;
        public GameObject(string name) { } public T AddComponent<T>() { return default(T); } }
    public class Transform : Component { public Matrix4x4 worldToLocalMatrix, localToWorldMatrix;
        public Vector3 position; public Quaternion rotation; public void SetParent(Transform parent, bool keep) { } }
    public class MeshFilter : Component { public Mesh sharedMesh; }
    public class Mesh : Object { public Vector3[] vertices, normals; public int[] triangles;
        public void MarkDynamic() { } public void RecalculateBounds() { } }
    public class TextAsset : Object { public byte[] bytes; }
    public struct Vector3 { public float x, y, z; public Vector3(float x, float y, float z) { this.x = x; this.y = y;
        this.z = z; } public static Vector3 one;
        public static Vector3 operator -(Vector3 v) { return v; } }
    public struct Vector4 { public float x, y, z, w;
        public static implicit operator Vector3(Vector4 v) { return new Vector3(v.x, v.y, v.z); } }
    public struct Quaternion
    {
        public Quaternion(float x, float y, float z, float w) { }
        public static Quaternion identity;
        public static Quaternion Inverse(Quaternion q) { return q; }
        public static Quaternion operator *(Quaternion a, Quaternion b) { return a; }
    }
    public static class Mathf
    {
        public static float Abs(float x) { return x; }
        public static float Max(float a, float b) { return a; }
    }
    public struct Matrix4x4
    {
        public Quaternion rotation;
        public Matrix4x4 inverse { get { return this; } }
        public float this[int index] { get { return 0; } }
        public Vector4 GetColumn(int index) { return new Vector4(); }
        public static Matrix4x4 identity;
        public static Matrix4x4 Translate(Vector3 t) { return new Matrix4x4(); }
        public static Matrix4x4 Rotate(Quaternion r) { return new Matrix4x4(); }
        public static Matrix4x4 TRS(Vector3 t, Quaternion r, Vector3 s) { return new Matrix4x4(); }
        public static Matrix4x4 operator *(Matrix4x4 a, Matrix4x4 b) { return a; }
    }
    public static class Debug { public static void LogWarning(object message, Object context) { } }
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
