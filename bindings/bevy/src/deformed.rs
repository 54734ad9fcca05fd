//! The state of a bound deformer: its surface, its pose, and the meshes that it writes.
use crate::bind::{Joints, refuse};
#[cfg(feature = "gpu")]
use crate::blend::Blend;
use crate::shading::Shading;
use crate::{DeformHandle, HandleLimb, HandleRegion, HandleRotation, Wanted};
use bevy::ecs::entity::EntityHashMap;
use bevy::math::{Affine3A, DQuat, DVec3, Mat3A, Vec3A};
use bevy::mesh::VertexAttributeValues;
use bevy::mesh::skinning::SkinnedMesh;
use bevy::prelude::*;
use hf::raw::{HF_ERROR_NON_FINITE, HF_ERROR_UNSUPPORTED, hf_handle_proposal, hf_hit};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Radians. A pose whose rotations changed less in a frame is not solved again until a handle moves. A tenth costs more
/// frames after a drag and shows no difference; ten times as much lets a pose stop visibly early.
const SETTLED: f64 = 1e-5;
/// 1 minus the cosine of half an angle. An entity that turns by more was turned: single precision rounds by less.
const TURNED: f64 = 1e-11;
/// The fewest steps with which hf_pose_set_limb_refine keeps lengths.
const LENGTH_STEPS: i32 = 8;

/// A mesh of the surface.
pub(crate) struct Part {
    pub(crate) entity: Entity,
    /// its vertices in the surface
    pub(crate) vertices: Range<usize>,
    /// its mesh and skin before it was bound
    pub(crate) original: Handle<Mesh>,
    pub(crate) skin: Option<SkinnedMesh>,
    /// the mesh that is written
    pub(crate) shown: Handle<Mesh>,
    /// from the deformer's space into the mesh's; `None`: they are the same
    pub(crate) into_mesh: Option<Affine3A>,
    /// in the mesh's space, exactly as they were
    pub(crate) rest_positions: Vec<[f32; 3]>,
    pub(crate) rest_normals: Vec<[f32; 3]>,
    pub(crate) rest_tangents: Option<Vec<[f32; 4]>>,
}

/// A rotation (a unit quaternion x, y, z, w) and a translation.
type Motion = ([f64; 4], [f64; 3]);
const AT_REST: Motion = ([0.0, 0.0, 0.0, 1.0], [0.0; 3]);

/// A handle that the pose has, or that it refused.
struct Grip {
    handle: DeformHandle,
    region: Option<HandleRegion>,
    /// its number in the pose; `None`: refused
    number: Option<u32>,
    centroid: DVec3,
    /// of the entity in the last frame
    transform: Motion,
    /// the pose finds the rotation
    free: bool,
    /// the entity was turned, with an automatic rotation
    turned: bool,
    /// the rotation of the region where the entity has none
    offset: DQuat,
    /// the limb options that the pose has
    limb: HandleLimb,
    /// the place of its entity was refused
    failed: bool,
}

impl Grip {
    /// Whether the pose finds the rotation, now that the entity has this motion.
    fn wants_free(&mut self, rotation: HandleRotation, motion: &Motion) -> bool {
        match rotation {
            HandleRotation::Free => true,
            HandleRotation::Automatic if self.handle.layer == 0 => {
                let cosine = DQuat::from_array(self.transform.0).dot(DQuat::from_array(motion.0));
                self.turned |= 1.0 - cosine.abs() > TURNED;
                !self.turned && (self.free || self.transform.1 != motion.1)
            }
            _ => false,
        }
    }
}

#[derive(PartialEq)]
enum Shows {
    Rest,
    Pose,
    /// the meshes are at rest, and the GPU moves them
    #[cfg(feature = "gpu")]
    Blend,
}

/// The surface of a [`Deformer`](crate::Deformer), its pose and its posed vertices. The plugin makes it.
///
/// Positions are in the space of the deformer's entity. `Changed<DeformedMesh>` holds in frames that moved a vertex.
#[derive(Component)]
pub struct DeformedMesh {
    pub(crate) parts: Vec<Part>,
    surface: hf::Surface,
    pose: hf::Pose,
    rest: Vec<f32>,
    posed: Vec<f32>,
    normals: Vec<f32>,
    /// empty when no mesh has tangents
    tangents: Vec<[f32; 3]>,
    shading: Shading,
    grips: EntityHashMap<Grip>,
    shows: Shows,
    /// the meshes are not what is posed
    behind: bool,
    settled: bool,
    said: Vec<(Entity, Option<hf::Error>)>,
    solved: Duration,
    posing: Duration,
    took: Duration,
    joints: Option<Joints>,
    /// the GPU blends the vertices where it can
    #[cfg(feature = "gpu")]
    pub(crate) blend: Option<Blend>,
}

impl DeformedMesh {
    pub(crate) fn new(
        parts: Vec<Part>,
        surface: hf::Surface,
        pose: hf::Pose,
        rest: Vec<f32>,
        shading: Shading,
        joints: Option<Joints>,
    ) -> Self {
        let tangents = if parts.iter().any(|part| part.rest_tangents.is_some()) { rest.len() / 3 } else { 0 };
        DeformedMesh {
            tangents: vec![[0.0; 3]; tangents],
            shading,
            parts,
            surface,
            pose,
            posed: rest.clone(),
            normals: vec![0.0; rest.len()],
            rest,
            grips: default(),
            shows: Shows::Rest,
            behind: false,
            settled: true,
            said: vec![],
            solved: Duration::ZERO,
            posing: Duration::ZERO,
            took: Duration::ZERO,
            joints,
            #[cfg(feature = "gpu")]
            blend: None,
        }
    }

    /// The surface, for fields, weights, picking and whatever else can be made on it.
    pub fn surface(&self) -> &hf::Surface {
        &self.surface
    }

    /// Positions at rest.
    pub fn rest(&self) -> &[[f32; 3]] {
        self.rest.as_chunks().0
    }

    /// Positions of the last frame. With a `GpuBlend` the processor does not write them: see `blend_posed`.
    pub fn posed(&self) -> &[[f32; 3]] {
        self.posed.as_chunks().0
    }

    /// Entities of the meshes, and which vertices of the surface each has.
    pub fn meshes(&self) -> impl Iterator<Item = (Entity, Range<usize>)> + '_ {
        self.parts.iter().map(|part| (part.entity, part.vertices.clone()))
    }

    /// Handles that the pose has.
    pub fn handle_count(&self) -> u32 {
        self.pose.handle_count()
    }

    /// Where the region of a handle has its mean at rest; `None` for a handle that the pose does not have.
    pub fn centroid(&self, handle: Entity) -> Option<Vec3> {
        self.grips.get(&handle).filter(|grip| grip.number.is_some()).map(|grip| grip.centroid.as_vec3())
    }

    /// The skeleton of the skins that the meshes had when they were bound; `None`: they had none.
    pub fn skeleton(&self) -> Option<&hf::Skeleton> {
        self.joints.as_ref().map(|joints| &joints.skeleton)
    }

    /// The entity of the joint that moves the region of a proposal.
    pub fn joint(&self, proposal: &hf_handle_proposal) -> Option<Entity> {
        self.joints.as_ref()?.entities.get(proposal.joint as usize).copied()
    }

    /// Places for handles, those that hold the body first (`pinned` is 1). The skeleton of the meshes gives each a joint, a role
    /// and a side. Without it y points up.
    pub fn propose_handles(&self) -> hf::Result<Vec<hf_handle_proposal>> {
        self.surface.propose_handles(None, &self.proposal_options())
    }

    /// The same, and the region of each: a head, a hand or a foot is whole.
    pub fn propose_regions(&self) -> hf::Result<Vec<(hf_handle_proposal, HandleRegion)>> {
        let mut owner = vec![0; self.rest.len() / 3];
        let proposals = self.surface.propose_handles(Some(&mut owner), &self.proposal_options())?;
        let region = |number: usize| HandleRegion((0..owner.len() as u32).filter(|&v| owner[v as usize] as usize == number).collect());
        Ok(proposals.into_iter().enumerate().map(|(number, proposal)| (proposal, region(number))).collect())
    }

    /// Stiffness and links of the surface, in place: nothing is factorised, and handles stay where they stand. A patch is refused.
    /// A solver of yours follows with `move_to(deformed.surface())`.
    pub fn edit(&mut self, edit: &hf::SurfaceEdit) -> hf::Result<()> {
        if edit.patch.is_some() {
            return Err(refuse(HF_ERROR_UNSUPPORTED, "a patch changes vertices: edit the meshes and insert the Deformer again"));
        }
        let edited = self.surface.edit(edit)?;
        self.pose.move_to(&edited)?;
        (self.surface, self.settled) = (edited, false);
        Ok(())
    }

    fn proposal_options(&self) -> hf::HandleProposalsOptions<'_> {
        hf::HandleProposalsOptions { skeleton: self.skeleton(), ..default() }
    }

    /// The first triangle of the posed surface on a ray; `None` when the ray misses. The ray is one of the deformer's space.
    pub fn pick(&self, origin: Vec3, direction: Vec3) -> hf::Result<Option<hf_hit>> {
        let options = hf::PickOptions { positions: Some((&self.posed).into()), ..default() };
        self.surface.cast_ray(&origin.as_dvec3().to_array(), &direction.as_dvec3().to_array(), &options)
    }

    /// How long the last frame that moved a vertex took: all, with meshes written, and the part of it that solved the pose.
    pub fn took(&self) -> (Duration, Duration) {
        (self.took, self.solved)
    }

    /// Takes handles as they are wanted, sorted by entity, and solves the pose. Returns whether a vertex may have moved.
    pub(crate) fn pose(&mut self, wanted: &[Wanted], options: &hf::DeformOptions) -> bool {
        let begin = Instant::now();
        let mut moved = self.remove(wanted);
        moved |= self.add(wanted);
        if self.pose.handle_count() > 0 && !self.shading.begun() {
            // no handle has moved yet: these are the normals at rest
            if self.pose.deform_into(&mut self.posed, Some(&mut self.normals), options).is_ok() {
                self.shading.begin(self.rest.as_chunks().0, self.normals.as_chunks().0);
            }
        }
        moved |= self.place(wanted);
        #[cfg(feature = "gpu")]
        if let Some(changed) = self.solve_blend(&mut moved, options, begin) {
            return changed;
        }
        if self.pose.handle_count() == 0 {
            if self.shows == Shows::Rest {
                return false;
            }
            self.posed.copy_from_slice(&self.rest);
            (self.shows, self.behind, self.settled) = (Shows::Rest, true, true);
        } else if moved || !self.settled {
            match self.pose.deform_into(&mut self.posed, Some(&mut self.normals), options) {
                Ok(info) => {
                    (self.shows, self.behind, self.settled) = (Shows::Pose, true, info.last_change < SETTLED);
                }
                // options that the library refuses
                Err(error) => {
                    self.settled = true;
                    self.said.extend(wanted.iter().map(|wanted| (wanted.entity, Some(error.clone()))));
                    return false;
                }
            }
        } else {
            return false;
        }
        self.solved = begin.elapsed();
        if self.shows == Shows::Pose {
            self.shading.carry(self.posed.as_chunks().0, self.normals.as_chunks_mut().0, &mut self.tangents);
        }
        self.posing = begin.elapsed();
        true
    }

    /// Computes the positions of this frame as the GPU does, for [`posed`](Self::posed) and [`pick`](Self::pick).
    #[cfg(feature = "gpu")]
    pub fn blend_posed(&mut self) -> hf::Result<()> {
        if self.shows == Shows::Blend { crate::blend::positions(&self.pose, self.posed.as_chunks_mut().0) } else { Ok(()) }
    }

    /// From the next frame on the GPU blends the vertices, or no longer.
    #[cfg(feature = "gpu")]
    pub(crate) fn set_blend(&mut self, blend: Option<Blend>) {
        (self.blend, self.settled) = (blend, false);
    }

    /// As [`DeformedMesh::pose`], where the GPU blends. `None`: the processor has to pose.
    #[cfg(feature = "gpu")]
    fn solve_blend(&mut self, moved: &mut bool, options: &hf::DeformOptions, begin: Instant) -> Option<bool> {
        let was_blend = self.shows == Shows::Blend;
        let asked = self.blend.is_some() && self.pose.handle_count() > 0 && options.refine == 0;
        // a pose that was a blend says below that it is none now
        let wanted = asked && (was_blend || self.pose.blend_info().is_ok());
        if wanted && was_blend && !*moved && self.settled {
            self.blend.as_mut()?.stand();
            return Some(false);
        }
        if wanted
            && let Ok(info) = self.pose.solve(options.iteration_count, options.restart)
            && self.blend.as_mut()?.take(&self.pose).is_ok()
        {
            // the meshes hold the rest shape from now on
            self.behind = self.shows == Shows::Pose;
            (self.shows, self.settled) = (Shows::Blend, info.last_change < SETTLED);
            (self.solved, self.posing, self.took) = (begin.elapsed(), begin.elapsed(), begin.elapsed());
            return Some(true);
        }
        self.blend.iter_mut().for_each(Blend::stop);
        *moved |= was_blend;
        None
    }

    /// Removes handles that are gone or that are others now.
    fn remove(&mut self, wanted: &[Wanted]) -> bool {
        let is_wanted = |entity: &Entity, grip: &Grip| {
            wanted
                .binary_search_by_key(entity, |wanted| wanted.entity)
                .is_ok_and(|at| wanted[at].handle == grip.handle && wanted[at].region == grip.region)
        };
        let gone: Vec<Entity> = self.grips.iter().filter(|(entity, grip)| !is_wanted(entity, grip)).map(|(entity, _)| *entity).collect();
        if gone.is_empty() {
            return false;
        }
        let mut numbers: Vec<u32> = gone.iter().filter_map(|entity| self.grips.remove(entity)?.number).collect();
        numbers.sort_unstable();
        self.pose.remove_handles(&numbers).expect("the pose has the handles that it gave");
        // there may be room now for handles that were refused
        self.grips.retain(|_, grip| grip.number.is_some());
        true
    }

    /// Adds handles that are new: those of a layer at once, or one by one when one of them is refused.
    fn add(&mut self, wanted: &[Wanted]) -> bool {
        let mut new: Vec<&Wanted> = wanted.iter().filter(|wanted| !self.grips.contains_key(&wanted.entity)).collect();
        let kind = |wanted: &&Wanted| (wanted.handle.layer, wanted.region.is_some());
        new.sort_by_key(kind);
        for layer in new.chunk_by(|a, b| kind(a) == kind(b)) {
            if self.add_batch(layer).is_err() {
                for one in layer {
                    if let Err(error) = self.add_batch(&[one]) {
                        self.keep(one, None, DVec3::ZERO);
                        self.said.push((one.entity, Some(error)));
                    }
                }
            }
        }
        !new.is_empty()
    }

    fn add_batch(&mut self, batch: &[&Wanted]) -> hf::Result<()> {
        let points: Vec<f64> = batch.iter().flat_map(|wanted| wanted.handle.point.as_dvec3().to_array()).collect();
        let radii: Vec<f64> = batch.iter().map(|wanted| wanted.handle.radius as f64).collect();
        let mut options = hf::HandlesOptions { layer: batch[0].handle.layer, ..default() };
        let regions: Vec<&[u32]> = batch.iter().filter_map(|wanted| wanted.region.as_ref()).map(|region| &region.0[..]).collect();
        if regions.is_empty() {
            (options.points, options.radii) = (Some(&points[..]), Some(&radii[..]));
        }
        let numbers = self.pose.add_handles((!regions.is_empty()).then_some(&regions[..]), &options)?;
        for (wanted, number) in batch.iter().zip(numbers) {
            let centroid = DVec3::from_array(self.pose.handle(number)?.centroid);
            self.keep(wanted, Some(number), centroid);
            self.said.push((wanted.entity, None));
        }
        Ok(())
    }

    fn keep(&mut self, wanted: &Wanted, number: Option<u32>, centroid: DVec3) {
        let (free, turned, offset, limb) = (false, false, DQuat::IDENTITY, default());
        let region = wanted.region.clone();
        let grip = Grip { handle: wanted.handle, region, number, centroid, transform: AT_REST, free, turned, offset, limb, failed: false };
        self.grips.insert(wanted.entity, grip);
    }

    /// Moves handles to where their entities stand. A handle whose place is refused stays.
    fn place(&mut self, wanted: &[Wanted]) -> bool {
        let mut moved = false;
        for wanted in wanted {
            let Some(grip) = self.grips.get_mut(&wanted.entity) else { continue };
            let Some(number) = grip.number else { continue };
            let placed = motion(wanted, grip.centroid).and_then(|transform| {
                if grip.handle.layer == 0 && grip.limb != wanted.limb {
                    self.pose.set_following(&[number], wanted.limb.following)?;
                    self.pose.set_limb_refine(&[number], if wanted.limb.keep_lengths { LENGTH_STEPS } else { 0 })?;
                    (grip.limb, moved) = (wanted.limb, true);
                }
                let free = grip.wants_free(wanted.rotation, &transform);
                if grip.free != free {
                    if grip.free && grip.handle.layer == 0 {
                        // the given rotation begins where the pose has turned the region to
                        let found = DQuat::from_array(self.pose.handle(number)?.rotation);
                        grip.offset = DQuat::from_array(grip.transform.0).inverse() * found;
                    }
                    self.pose.set_free_rotations(&[number], free)?;
                } else if grip.transform == transform {
                    return Ok(());
                }
                let turn = (DQuat::from_array(transform.0) * grip.offset).to_array();
                self.pose.set_transform(number, Some(turn), Some(transform.1))?;
                (grip.free, grip.transform, moved) = (free, transform, true);
                Ok(())
            });
            if placed.is_err() != grip.failed {
                grip.failed = placed.is_err();
                self.said.push((wanted.entity, placed.err()));
            }
        }
        moved
    }

    /// Writes positions, normals and tangents into the meshes, in place.
    pub(crate) fn write(&mut self, meshes: &mut Assets<Mesh>) {
        if !std::mem::take(&mut self.behind) {
            return;
        }
        let begin = Instant::now();
        let (posed, normals) = (self.posed.as_chunks::<3>().0, self.normals.as_chunks::<3>().0);
        for part in &self.parts {
            let Some(mut mesh) = meshes.get_mut(&part.shown) else { continue };
            let (posed, normals) = (&posed[part.vertices.clone()], &normals[part.vertices.clone()]);
            let Ok(VertexAttributeValues::Float32x3(out)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_POSITION) else { continue };
            match (&self.shows, &part.into_mesh) {
                (shows, _) if *shows != Shows::Pose => out.copy_from_slice(&part.rest_positions),
                (_, None) => out.copy_from_slice(posed),
                (_, Some(into)) => {
                    for (out, p) in out.iter_mut().zip(posed) {
                        *out = into.transform_point3(Vec3::from_array(*p)).to_array();
                    }
                }
            }
            let Ok(VertexAttributeValues::Float32x3(out)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_NORMAL) else { continue };
            match (&self.shows, &part.into_mesh) {
                (shows, _) if *shows != Shows::Pose => out.copy_from_slice(&part.rest_normals),
                (_, None) => out.copy_from_slice(normals),
                (_, Some(into)) => {
                    // normals turn by the inverse transpose of what moves points
                    let turn = into.matrix3.inverse().transpose();
                    for (out, n) in out.iter_mut().zip(normals) {
                        *out = (turn * Vec3A::from_array(*n)).normalize_or_zero().to_array();
                    }
                }
            }
            let Some(rest) = &part.rest_tangents else { continue };
            let Ok(VertexAttributeValues::Float32x4(out)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_TANGENT) else { continue };
            if self.shows != Shows::Pose {
                out.copy_from_slice(rest);
                continue;
            }
            let turn = part.into_mesh.map_or(Mat3A::IDENTITY, |into| into.matrix3);
            for (out, t) in out.iter_mut().zip(&self.tangents[part.vertices.clone()]) {
                let [x, y, z] = (turn * Vec3A::from_array(*t)).normalize_or_zero().to_array();
                *out = [x, y, z, out[3]]; // the sign of the bitangent stays
            }
        }
        self.took = self.posing + begin.elapsed();
    }

    /// What is new about handles: an error, or `None` when they have none any more.
    pub(crate) fn said(&mut self) -> Vec<(Entity, Option<hf::Error>)> {
        std::mem::take(&mut self.said)
    }
}

/// The motion of a handle's region about its centroid.
fn motion(wanted: &Wanted, centroid: DVec3) -> hf::Result<Motion> {
    let (_, turn, place) = wanted.place.to_scale_rotation_translation();
    if !(turn.is_finite() && place.is_finite()) {
        return Err(refuse(HF_ERROR_NON_FINITE, "the transform of a handle's entity must be finite and have a scale other than 0"));
    }
    let turn = DQuat::from_xyzw(turn.x.into(), turn.y.into(), turn.z.into(), turn.w.into()).normalize();
    let translation = place.as_dvec3() + turn * (centroid - wanted.handle.point.as_dvec3()) - centroid;
    Ok((turn.to_array(), translation.to_array()))
}
