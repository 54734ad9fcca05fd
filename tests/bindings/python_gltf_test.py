"""python_gltf_test.py HF_MAKE_ASSETS FOLDER: hf.gltf reads two creatures, plays a clip of one on the other and keeps it."""

import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np

import hf
from hf import gltf

ASSETS, FOLDER = sys.argv[1:3]
del sys.argv[1:]


class Gltf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(FOLDER, exist_ok=True)
        subprocess.run([ASSETS, FOLDER, "--vertices", "1500", "--creature", "horse", "--creature", "bull"], check=True,
                       stdout=subprocess.DEVNULL)
        cls.horse, cls.bull = (os.path.join(FOLDER, name + ".glb") for name in ("horse", "bull"))

    def test_arrays_fit_surfaces_and_skeletons(self):
        horse = gltf.Model(self.horse)
        self.assertEqual(horse.positions.shape[1:], (3,))
        self.assertLess(horse.triangles.max(), len(horse.positions))
        np.testing.assert_allclose(horse.weights.sum(1), 1, atol=1e-5)
        self.assertEqual(len(horse.names), len(horse.parents))
        self.assertLess(horse.joints.max(), len(horse.names))
        used = np.unique(horse.joints[horse.weights > 0])
        self.assertTrue(np.abs(horse.inverse_binds[used]).sum(1).all())
        surface, skeleton = horse.surface(), horse.skeleton()
        self.assertEqual(surface.vertex_count, len(horse.positions))
        self.assertGreater(skeleton.info.up_confidence, 0.5)
        self.assertGreater(len(surface.propose_handles(skeleton=skeleton)), 4)
        # in a clip the skin of the joints is the surface
        pose = horse.pose(0, 0.3)
        self.assertGreater(np.abs(pose - horse.positions).max(), 0.01)
        self.assertEqual(gltf.Model(pathlib.Path(self.horse).read_bytes()).names, horse.names)

    def test_a_clip_plays_on_another_and_is_kept(self):
        horse, bull = gltf.Model(self.horse), gltf.Model(self.bull)
        retarget = hf.Retarget(horse.skeleton(), bull.skeleton())
        times = np.arange(0, horse.clips[0].duration, 0.1)
        poses = np.array([retarget.solve(horse.pose_joints(0, t), 0.1) for t in times]).reshape(-1, *bull.rest.shape)
        before = len(bull.clips)
        bull.add_clip("walked", times, poses)
        self.assertEqual([clip.name for clip in bull.clips][0], "walked")
        out = os.path.join(FOLDER, "walked.glb")
        bull.save(out)
        again = gltf.Model(out)
        self.assertEqual(len(again.clips), before + 1)
        for t, pose in zip(times, poses):
            np.testing.assert_allclose(again.pose_joints(0, t)[:, :3], pose[:, :3], atol=1e-5)
            turned = np.abs((again.pose_joints(0, t)[:, 3:7] * pose[:, 3:7]).sum(1))
            np.testing.assert_allclose(turned, 1, atol=1e-5)

    def test_bad_calls_are_named(self):
        with self.assertRaisesRegex(hf.InvalidArgumentError, "none.glb"):
            gltf.Model(os.path.join(FOLDER, "none.glb"))
        horse = gltf.Model(self.horse)
        with self.assertRaises(hf.OutOfRangeError):
            horse.pose(len(horse.clips), 0)
        with self.assertRaisesRegex(hf.InvalidArgumentError, "poses must have the shape"):
            horse.add_clip("short", [0, 1], horse.rest)
        horse.close()
        horse.close()
        with self.assertRaises(hf.InvalidObjectError):
            horse.pose(0, 0)


if __name__ == "__main__":
    unittest.main()
