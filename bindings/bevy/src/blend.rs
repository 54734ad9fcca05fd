//! A pose as a shader needs it: rows that stay, and the transforms of two frames.
use bevy::math::{DVec3, Vec3};

/// What the GPU has not got yet.
#[derive(Default)]
pub(crate) struct Blend {
    /// the GPU moves the vertices, and the meshes hold the rest shape
    pub(crate) on: bool,
    pub(crate) changed: bool,
    /// rows of a new revision
    pub(crate) rows: Option<hf::BlendRows>,
    revision: u32,
    /// of this frame, then of the frame before
    pub(crate) transforms: Vec<f32>,
    /// of the offsets, in this frame and in the frame before
    pub(crate) shares: [f32; 2],
    /// positions are relative to it
    pub(crate) centre: DVec3,
    /// low and high corner of the posed surface, relative to the centre
    pub(crate) bounds: [Vec3; 2],
}

impl Blend {
    /// Takes the frame that `pose` has solved.
    pub(crate) fn take(&mut self, pose: &hf::Pose) -> hf::Result<()> {
        let info = pose.blend_info()?;
        let mut transforms = pose.blend_transforms()?;
        let fresh = !self.on || self.revision != info.revision;
        if fresh {
            self.rows = Some(pose.blend_rows()?);
        }
        let count = transforms.len();
        // no frame before has these clusters
        let before = if fresh { transforms.clone() } else { self.transforms[..count].to_vec() };
        transforms.extend(before);
        let share = info.offset_share as f32;
        self.shares = [share, if fresh { share } else { self.shares[0] }];
        (self.transforms, self.revision, self.on, self.changed) = (transforms, info.revision, true, true);
        self.centre = DVec3::from_array(info.centre);
        self.bounds = [info.low, info.high].map(|corner| DVec3::from_array(corner).as_vec3());
        Ok(())
    }

    /// The pose stands still: in the next frame, nothing has moved.
    pub(crate) fn stand(&mut self) {
        let half = self.transforms.len() / 2;
        let (now, before) = self.transforms.split_at_mut(half);
        if now != before || self.shares[0] != self.shares[1] {
            before.copy_from_slice(now);
            (self.shares[1], self.changed) = (self.shares[0], true);
        }
    }

    /// The meshes are shown as they are.
    pub(crate) fn stop(&mut self) {
        self.changed |= self.on;
        (self.on, self.rows) = (false, None);
    }
}

/// Positions as the shader computes them, in the frame of the mesh.
pub(crate) fn positions(pose: &hf::Pose, out: &mut [[f32; 3]]) -> hf::Result<()> {
    let (info, rows, transforms) = (pose.blend_info()?, pose.blend_rows()?, pose.blend_transforms()?);
    let (centre, share) = (DVec3::from_array(info.centre), info.offset_share as f32);
    let (rest, offsets, rows_of) = (rows.positions.as_chunks::<3>().0, rows.offsets.as_chunks::<3>().0, rows.rows.as_chunks::<2>().0);
    for (at, out) in out.iter_mut().enumerate() {
        let (p, [first, count]) = (Vec3::from_array(rest[at]).extend(1.0), rows_of[at].map(|x| x as usize));
        let mut sum = share * Vec3::from_array(offsets[at]);
        for entry in first..first + count {
            let rows_of_transform = transforms[12 * rows.clusters[entry] as usize..][..12].as_chunks::<4>().0;
            sum += rows.weights[entry] * Vec3::from_slice(&[0, 1, 2].map(|i| p.dot(rows_of_transform[i].into())));
        }
        *out = (centre + sum.as_dvec3()).as_vec3().to_array();
    }
    Ok(())
}
