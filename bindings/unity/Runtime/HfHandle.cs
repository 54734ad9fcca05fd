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

        /// <summary>The following of a tip that is dragged: its limb follows and the body hardly leans.
        /// hf_surface_propose_handles proposes the same number.</summary>
        public const float TipFollowing = 0.25f;

        [Tooltip("How much follows. 1: the whole mesh, as for a handle that holds. 0: the limb of this handle alone. "
            + "A tip that is dragged starts with 0.25. Layer 0 only")]
        [Range(0, 1)] public float following = 1;
        [Tooltip("The limb of this handle keeps its lengths and bends like two bones. Layer 0 only")]
        public bool keepLengths;

        internal uint number;
        internal bool bound;
        internal Vector3 centroid; // of the region at rest
        internal bool free; // of the handle of the pose
        internal float told; // the following that the pose has
        internal int steps; // the limb steps that the pose has
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
