// A handle of an HfDeformer: a child transform that carries a region of the mesh. Add, enable, disable or destroy it
// at any time.
using UnityEngine;

namespace Hf.Unity
{
    /// <summary>Who says how a handle is turned.</summary>
    public enum HfRotation
    {
        /// <summary>A handle at rest holds. One that is moved is free; one that is turned gives its rotation.</summary>
        Automatic,
        /// <summary>The pose finds the rotation: the handle is a place alone, as a hand that is pulled.</summary>
        Free,
        /// <summary>The transform gives the rotation.</summary>
        Given,
    }

    [AddComponentMenu("hf/Handle")]
    public sealed class HfHandle : MonoBehaviour
    {
        [Tooltip("Vertices within this distance of the handle, along the surface, in the mesh's unit")]
        public float radius = 0.1f;
        [Tooltip("0: pulls the surface from rest. 1 and more: edits on top of the layers below")]
        [Range(0, 7)] public int layer;

        [Tooltip("Automatic: a move frees the rotation and the pose finds it, a turn gives it from where the handle stands. "
            + "Above layer 0 Automatic is Given")]
        public HfRotation rotation;

        internal uint number;
        internal bool bound;
        internal Vector3 centroid; // of the region at rest
        internal bool free; // of the handle of the pose
        internal Matrix4x4 seen; // the motion of the last frame
        internal Quaternion turn = Quaternion.identity; // the rotation of the handle where the transform has none
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
