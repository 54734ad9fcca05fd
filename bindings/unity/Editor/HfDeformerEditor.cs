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
            if (GUILayout.Button("Add handle"))
            {
                var made = new GameObject("handle");
                Undo.RegisterCreatedObjectUndo(made, "Add hf handle");
                made.transform.SetParent(deformer.transform, false);
                made.AddComponent<HfHandle>();
                Selection.activeGameObject = made;
            }
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

        void OnSceneGUI()
        {
            var deformer = (HfDeformer)target;
            foreach (HfHandle handle in deformer.GetComponentsInChildren<HfHandle>())
            {
                EditorGUI.BeginChangeCheck();
                Vector3 place = Handles.PositionHandle(handle.transform.position, handle.transform.rotation);
                if (!EditorGUI.EndChangeCheck()) continue;
                Undo.RecordObject(handle.transform, "Move hf handle");
                handle.transform.position = place;
            }
        }
    }
}
