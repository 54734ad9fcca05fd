// A handle of an HfDeformer: a child transform that carries a region of the mesh. Add, enable, disable or destroy it
// at any time.
using UnityEngine;

namespace Hf.Unity
{
    [AddComponentMenu("hf/Handle")]
    public sealed class HfHandle : MonoBehaviour
    {
        [Tooltip("Vertices within this distance of the handle, along the surface, in the mesh's unit")]
        public float radius = 0.1f;
        [Tooltip("0: pulls the surface from rest. 1 and more: edits on top of the layers below")]
        [Range(0, 7)] public int layer;

        internal uint number;
        internal bool bound;
        internal Matrix4x4 restLocal; // of the handle in the mesh's frame when it was bound

        void OnEnable() { Tell(); }
        void OnDisable() { Tell(); }
        void OnDestroy() { Tell(); }

        void Tell()
        {
            var deformer = GetComponentInParent<HfDeformer>();
            if (deformer != null) deformer.HandlesChanged();
        }
    }
}
