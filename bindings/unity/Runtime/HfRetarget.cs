// Plays the motion of one skeleton on another, live: in every frame the bones below `target` follow those below
// `source`, which an Animator moves. Nothing else may move the bones of the target.
using System.Collections.Generic;
using Hf.Native;
using UnityEngine;

namespace Hf.Unity
{
    [AddComponentMenu("hf/Retarget")]
    public sealed class HfRetarget : MonoBehaviour
    {
        [Tooltip("The topmost bone of the skeleton that moves. Both skeletons are at rest when this component is enabled")]
        public Transform source;
        [Tooltip("The topmost bone of the skeleton that follows")]
        public Transform target;
        [Tooltip("Which bone gets the travel over the ground")]
        public RootMotion rootMotion;

        /// <summary>The bones of a skeleton and their pose: translation, rotation x y z w and scale per bone.</summary>
        sealed class Bones
        {
            public readonly List<Transform> transforms = new List<Transform>();
            readonly List<uint> parents = new List<uint>();
            readonly List<string> names = new List<string>();
            public readonly float[] pose;

            public Bones(Transform top)
            {
                Collect(top, Constants.HF_NO_INDEX);
                pose = new float[10 * transforms.Count];
                Read();
            }

            void Collect(Transform bone, uint parent)
            {
                var number = (uint)transforms.Count;
                transforms.Add(bone);
                parents.Add(parent);
                names.Add(bone.name);
                for (int i = 0; i < bone.childCount; ++i) Collect(bone.GetChild(i), number);
            }

            public Skeleton Skeleton() { return new Skeleton(names.ToArray(), parents.ToArray(), pose); }

            // Unity's space is the mirror image of the library's: x has the other sign
            public void Read()
            {
                for (int i = 0, k = 0; i < transforms.Count; ++i, k += 10)
                {
                    Vector3 place = transforms[i].localPosition, size = transforms[i].localScale;
                    Quaternion turn = transforms[i].localRotation;
                    pose[k] = -place.x; pose[k + 1] = place.y; pose[k + 2] = place.z;
                    pose[k + 3] = turn.x; pose[k + 4] = -turn.y; pose[k + 5] = -turn.z; pose[k + 6] = turn.w;
                    pose[k + 7] = size.x; pose[k + 8] = size.y; pose[k + 9] = size.z;
                }
            }

            public void Write()
            {
                for (int i = 0, k = 0; i < transforms.Count; ++i, k += 10)
                {
                    transforms[i].localPosition = new Vector3(-pose[k], pose[k + 1], pose[k + 2]);
                    transforms[i].localRotation = new Quaternion(pose[k + 3], -pose[k + 4], -pose[k + 5], pose[k + 6]);
                    transforms[i].localScale = new Vector3(pose[k + 7], pose[k + 8], pose[k + 9]);
                }
            }
        }

        Bones from, to;
        Retarget retarget;

        /// <summary>The message of the last failure; null after a success.</summary>
        public string LastError { get; private set; }
        /// <summary>How well the skeletons fit; null before they are bound.</summary>
        public RetargetInfo Info { get { return retarget == null ? null : retarget.Info; } }

        void OnEnable() { Bind(); }
        void OnDisable()
        {
            if (retarget != null) retarget.Dispose();
            retarget = null;
        }

        /// <summary>Pairs the bones. Call it while both skeletons are at rest. LastError says why it failed.</summary>
        public void Bind()
        {
            OnDisable();
            if (source == null || target == null) return;
            from = new Bones(source);
            to = new Bones(target);
            try
            {
                using (Skeleton first = from.Skeleton(), second = to.Skeleton())
                    retarget = new Retarget(first, second, rootMotion: rootMotion);
                LastError = null;
            }
            catch (HfException failure) { Say(failure); }
        }

        /// <summary>Forgets planted feet. Call it where a clip jumps.</summary>
        public void ResetFeet() { if (retarget != null) retarget.Reset(); }

        // A frame allocates nothing.
        unsafe void LateUpdate()
        {
            if (retarget == null) return;
            from.Read();
            try
            {
                fixed (float* posed = from.pose, follows = to.pose)
                    HfException.Check(Functions.hf_retarget_solve(retarget.RawHandle, posed, Time.deltaTime, follows));
                to.Write();
                LastError = null;
            }
            catch (HfException failure) { Say(failure); }
        }

        void Say(HfException failure)
        {
            if (LastError != failure.Message) Debug.LogWarning("hf: " + failure.Message, this);
            LastError = failure.Message; // the target keeps its pose; a repeated message is logged once
        }
    }
}
