// The inspector: adds handles with a click and saves the factor as an asset. Handles move in the scene view.
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Hf.Unity.Editor
{
    [CustomEditor(typeof(HfDeformer))]
    public sealed class HfDeformerEditor : UnityEditor.Editor
    {
        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            var deformer = (HfDeformer)target;
            if (!string.IsNullOrEmpty(deformer.LastError))
                EditorGUILayout.HelpBox(deformer.LastError, MessageType.Warning);
            EditorGUILayout.LabelField("Handles", deformer.HandleCount.ToString());
            if (GUILayout.Button("Add handle that holds")) Add(deformer, 1);
            if (GUILayout.Button("Add tip to drag")) Add(deformer, HfHandle.TipFollowing);
            if (GUILayout.Button("Bind again")) deformer.Release();
            if (GUILayout.Button("Save factor"))
            {
                string path = EditorUtility.SaveFilePanelInProject("Save factor", deformer.name + " factor", "bytes",
                    "The factor for the saved-factor slot");
                if (!string.IsNullOrEmpty(path))
                {
                    File.WriteAllBytes(path, deformer.Surface.Save());
                    AssetDatabase.ImportAsset(path);
                    Undo.RecordObject(deformer, "Save factor");
                    deformer.savedFactor = AssetDatabase.LoadAssetAtPath<TextAsset>(path);
                }
            }
        }

        static void Add(HfDeformer deformer, float following)
        {
            var made = new GameObject("handle");
            Undo.RegisterCreatedObjectUndo(made, "Add hf handle");
            made.transform.SetParent(deformer.transform, false);
            made.AddComponent<HfHandle>().following = following;
            Selection.activeGameObject = made;
        }

        void OnSceneGUI()
        {
            var deformer = (HfDeformer)target;
            foreach (HfHandle handle in deformer.GetComponentsInChildren<HfHandle>())
            {
                EditorGUI.BeginChangeCheck();
                Vector3 place = Handles.PositionHandle(handle.transform.position, handle.transform.rotation);
                if (EditorGUI.EndChangeCheck())
                {
                    // a drag frees the rotation
                    Undo.RecordObjects(new Object[] { handle, handle.transform }, "Move hf handle");
                    if (handle.rotation == HfRotation.Given && handle.layer == 0) handle.rotation = HfRotation.Free;
                    handle.transform.position = place;
                }
                EditorGUI.BeginChangeCheck();
                Quaternion turn = Handles.RotationHandle(handle.transform.rotation, handle.transform.position);
                if (!EditorGUI.EndChangeCheck()) continue;
                Undo.RecordObjects(new Object[] { handle, handle.transform }, "Turn hf handle");
                handle.rotation = HfRotation.Given; // rings give it
                handle.transform.rotation = turn;
            }
        }
    }
}
