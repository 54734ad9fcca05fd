//! Pose and Transfer: handles that come and go, and the motion of one surface on another.
use crate::core::{check, count_of, figures, flatten, handle_of, object, of_length, options, rows_of, start, start_of, Progress, Real};
use crate::{raw, Error, Result, Surface};

options!(
    /// How a pose is made. Zero is the default of every option.
    PoseOptions: hf_pose_desc {
        /// `HF_DEFORM_*`
        mode: i32,
        /// bands of each handle's field
        band_count: u32,
        /// iterations of the paper's scheme
        iteration_count: u32,
        /// samples on each ring of a cluster
        rim_site_count: u32,
        /// groups of the smooth mode
        group_count: u32,
    }
);
options!(
    /// How a frame is deformed.
    DeformOptions: hf_deform_desc {
        /// iterations of the paper's scheme; 0 = those of the pose
        iteration_count: u32,
        /// 1: start from rest, not from the last frame
        restart: i32,
        /// full-mesh steps, 0 to 64
        refine: i32,
        /// 1: the steps go on from the last frame's surface
        refine_from_last: i32,
    }
);
options!(
    /// How a transfer is made. Zero is the default of every option.
    TransferOptions: hf_transfer_desc {
        /// `HF_TRANSFER_*`
        mode: i32,
        /// clusters of the target
        cluster_count: u32,
        /// width of the kernel between fields
        kernel_width: f64,
        /// size of the target over that of the source; 0: found
        scale: f64,
        /// degrees from which rest poses are aligned
        alignment_angle: f64,
    }
);
options!(
    /// What an animator turns while a transfer plays. Zero is neutral for every dial.
    TransferDials: hf_transfer_dials {
        /// how many times the paths of feet and trunk along the ground count; 0 = 1
        stride: f64,
        /// raises the trunk by this share of its height at rest
        hip_height_share: f64,
        /// how far the neck follows the source, -1 to 1
        neck_follow: f64,
        /// how far the tail follows the source, -1 to 1
        tail_follow: f64,
        /// radians by which arms turn away from the body
        arm_space: f64,
        /// how far parts that reach farther than the source's make its whole turn, 0 to 1
        long_follow: f64,
    }
);

object!(
    /// Handles on a surface, and the surface posed by them.
    Pose: hf_pose, hf_pose_destroy { vertex_count: usize }
);

/// Rotation as a quaternion (x, y, z, w) about the handle's centroid, then a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// x, y, z, w
    pub rotation: [f64; 4],
    /// in the unit of the mesh
    pub translation: [f64; 3],
}
impl Default for Transform {
    fn default() -> Self {
        Transform { rotation: [0.0, 0.0, 0.0, 1.0], translation: [0.0; 3] }
    }
}
impl Transform {
    fn raw(self) -> raw::hf_transform {
        raw::hf_transform { rotation: self.rotation, translation: self.translation }
    }
}

/// Joints and weights for an engine's own skinning.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// three numbers a joint
    pub pivots: Vec<f64>,
    /// four numbers a joint: x, y, z, w
    pub rotations: Vec<f64>,
    /// three numbers a joint
    pub translations: Vec<f64>,
    /// joints of each vertex
    pub joints: Vec<u32>,
    /// their weights, of sum 1
    pub weights: Vec<f32>,
}

/// What the C ABI takes for 0 weights a vertex.
const DEFAULT_WEIGHTS: u32 = 4;

fn skin(vertex_count: usize, influence_count: u32, mut call: impl FnMut(&mut raw::hf_skin_info) -> i32) -> Result<Skin> {
    let mut info = raw::hf_skin_info { influence_count, ..Default::default() };
    check(call(&mut info))?;
    let width = if influence_count == 0 { DEFAULT_WEIGHTS } else { influence_count };
    let (joints, places) = (info.joint_count as usize, vertex_count * width as usize);
    let mut out = Skin {
        pivots: vec![0.0; 3 * joints],
        rotations: vec![0.0; 4 * joints],
        translations: vec![0.0; 3 * joints],
        joints: vec![0; places],
        weights: vec![0.0; places],
    };
    (info.joint_capacity, info.vertex_capacity) = (info.joint_count, count_of(vertex_count, "vertices")?);
    (info.pivots, info.rotations) = (out.pivots.as_mut_ptr(), out.rotations.as_mut_ptr());
    (info.translations, info.vertex_joints) = (out.translations.as_mut_ptr(), out.joints.as_mut_ptr());
    info.vertex_weights = out.weights.as_mut_ptr();
    check(call(&mut info))?;
    Ok(out)
}

impl Pose {
    /// A pose without handles.
    pub fn new(surface: &Surface, options: &PoseOptions) -> Result<Self> {
        let (mut desc, mut handle) = (raw::hf_pose_desc::default(), std::ptr::null_mut());
        options.fill(&mut desc);
        // SAFETY: the handles are valid and `desc` is whole.
        check(unsafe { raw::hf_pose_create(surface.handle, &desc, &mut handle) })?;
        Ok(Pose { handle, vertex_count: surface.vertex_count })
    }

    /// A copy with its own handles.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_pose_clone(self.handle, &mut handle) })?;
        Ok(Pose { handle, vertex_count: self.vertex_count })
    }

    figures! {
        /// What the pose was made with.
        info => hf_pose_get_info -> hf_pose_info;
    }

    /// Adds handles, each a list of vertices, and returns their numbers. `layer`: 0, or a finer one above it.
    pub fn add_handles(&mut self, regions: &[&[u32]], layer: u32, progress: Option<&Progress>) -> Result<Vec<u32>> {
        self.add_regions(regions, raw::hf_handles_desc { layer, progress: handle_of(progress), ..Default::default() })
    }

    /// Adds handles of layer 0 where the posed surface stands, not at rest. The surface stays, and
    /// [`Pose::handle_info`] says where the handles stand.
    pub fn add_handles_in_place(&mut self, regions: &[&[u32]], progress: Option<&Progress>) -> Result<Vec<u32>> {
        self.add_regions(regions, raw::hf_handles_desc { in_place: 1, progress: handle_of(progress), ..Default::default() })
    }

    /// Adds handles by points at rest (three numbers each) and radii.
    pub fn add_handles_at(&mut self, points: &[f64], radii: &[f64], layer: u32) -> Result<Vec<u32>> {
        self.add_points(points, radii, raw::hf_handles_desc { layer, ..Default::default() })
    }

    /// As [`Pose::add_handles_in_place`], by points at rest (three numbers each) and radii.
    pub fn add_handles_in_place_at(&mut self, points: &[f64], radii: &[f64]) -> Result<Vec<u32>> {
        self.add_points(points, radii, raw::hf_handles_desc { in_place: 1, ..Default::default() })
    }

    fn add_regions(&mut self, regions: &[&[u32]], options: raw::hf_handles_desc) -> Result<Vec<u32>> {
        let (counts, vertices) = flatten(regions, "regions")?;
        let desc = raw::hf_handles_desc {
            handle_count: count_of(regions.len(), "regions")?,
            region_counts: start(&counts),
            region_vertices: start(&vertices),
            ..options
        };
        self.add(&desc)
    }

    fn add_points(&mut self, points: &[f64], radii: &[f64], options: raw::hf_handles_desc) -> Result<Vec<u32>> {
        let handle_count = rows_of(points, 3, "points")?;
        of_length(radii, "radii", handle_count as usize)?;
        let (points, radii) = (start(points), start(radii));
        self.add(&raw::hf_handles_desc { handle_count, points, radii, ..options })
    }

    fn add(&mut self, desc: &raw::hf_handles_desc) -> Result<Vec<u32>> {
        let mut out = vec![0; desc.handle_count as usize];
        // SAFETY: the callers checked the lengths; `out` has one entry a handle.
        check(unsafe { raw::hf_pose_add_handles(self.handle, desc, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Adds one handle: what is connected within `radius` of a point at rest.
    pub fn add_handle_at(&mut self, point: [f64; 3], radius: f64) -> Result<u32> {
        let mut number = 0;
        // SAFETY: `point` has three numbers.
        check(unsafe { raw::hf_pose_add_handle_at(self.handle, point.as_ptr(), radius, &mut number) })?;
        Ok(number)
    }

    /// Removes handles by their numbers.
    pub fn remove_handles(&mut self, handles: &[u32]) -> Result<()> {
        // SAFETY: `handles` has as many entries as said.
        check(unsafe { raw::hf_pose_remove_handles(self.handle, count_of(handles.len(), "handles")?, start(handles)) })
    }

    /// Moves handles.
    pub fn set_transforms(&mut self, handles: &[u32], transforms: &[Transform]) -> Result<()> {
        of_length(transforms, "transforms", handles.len())?;
        let rows: Vec<_> = transforms.iter().map(|t| t.raw()).collect();
        // SAFETY: both have one entry a handle.
        check(unsafe { raw::hf_pose_set_transforms(self.handle, count_of(handles.len(), "handles")?, start(handles), start(&rows)) })
    }

    /// Moves one handle.
    pub fn set_transform(&mut self, handle: u32, transform: Transform) -> Result<()> {
        // SAFETY: the struct is whole.
        check(unsafe { raw::hf_pose_set_transform(self.handle, handle, &transform.raw()) })
    }

    /// Handles now.
    pub fn handle_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_pose_get_handle_count(self.handle) }
    }

    /// What is known of one handle.
    pub fn handle_info(&self, handle: u32) -> Result<raw::hf_handle_info> {
        let mut info = raw::hf_handle_info::default();
        // SAFETY: the struct is whole.
        check(unsafe { raw::hf_pose_get_handle(self.handle, handle, &mut info) })?;
        Ok(info)
    }

    /// The harmonic field of one handle: 1 on it, 0 on the others.
    pub fn handle_field(&self, handle: u32) -> Result<Vec<f32>> {
        let mut out = vec![0.0; self.vertex_count];
        // SAFETY: `out` has one number a vertex.
        check(unsafe { raw::hf_pose_get_field(self.handle, handle, out.as_mut_ptr(), 0) })?;
        Ok(out)
    }

    /// The posed positions, three numbers a vertex.
    pub fn deform(&mut self, options: &DeformOptions) -> Result<Vec<f64>> {
        let mut out = vec![0.0; 3 * self.vertex_count];
        self.deform_into(&mut out, options)?;
        Ok(out)
    }

    /// Writes the posed positions into a slice of yours and allocates nothing. Returns what the frame took.
    pub fn deform_into<P: Real>(&mut self, out: &mut [P], options: &DeformOptions) -> Result<raw::hf_deform_info> {
        of_length(out, "out", 3 * self.vertex_count)?;
        let (mut desc, mut info) = (raw::hf_deform_desc::default(), raw::hf_deform_info::default());
        options.fill(&mut desc);
        (desc.positions, desc.positions_f64) = P::both_mut(out.as_mut_ptr());
        // SAFETY: `out` has three numbers a vertex.
        check(unsafe { raw::hf_pose_deform(self.handle, &desc, &mut info) })?;
        Ok(info)
    }

    /// As [`Pose::deform_into`], and writes unit normals of the posed surface too. Vertices that are welded share a normal.
    pub fn deform_with_normals_into<P: Real>(
        &mut self,
        out: &mut [P],
        out_normals: &mut [f32],
        options: &DeformOptions,
    ) -> Result<raw::hf_deform_info> {
        of_length(out, "out", 3 * self.vertex_count)?;
        of_length(out_normals, "out_normals", 3 * self.vertex_count)?;
        let (mut desc, mut info) = (raw::hf_deform_desc::default(), raw::hf_deform_info::default());
        options.fill(&mut desc);
        (desc.positions, desc.positions_f64) = P::both_mut(out.as_mut_ptr());
        desc.normals = out_normals.as_mut_ptr();
        // SAFETY: `out` and `out_normals` have three numbers a vertex.
        check(unsafe { raw::hf_pose_deform(self.handle, &desc, &mut info) })?;
        Ok(info)
    }

    /// The pose as joints and weights, `influence_count` a vertex.
    pub fn skin(&self, influence_count: u32) -> Result<Skin> {
        // SAFETY: `skin` passes a whole struct with room as it says.
        skin(self.vertex_count, influence_count, |info| unsafe { raw::hf_pose_get_skin(self.handle, info) })
    }
}

object!(
    /// Plays the motion of one surface on another.
    Transfer: hf_transfer, hf_transfer_destroy { source_count: usize, vertex_count: usize }
);

impl Transfer {
    /// A transfer without pairs.
    pub fn new(source: &Surface, target: &Surface, options: &TransferOptions) -> Result<Self> {
        let (mut desc, mut handle) = (raw::hf_transfer_desc::default(), std::ptr::null_mut());
        options.fill(&mut desc);
        // SAFETY: the handles are valid and `desc` is whole.
        check(unsafe { raw::hf_transfer_create(source.handle, target.handle, &desc, &mut handle) })?;
        Ok(Transfer { handle, source_count: source.vertex_count, vertex_count: target.vertex_count })
    }

    figures! {
        /// What was found: scale, clusters, pairs.
        info => hf_transfer_get_info -> hf_transfer_info;
    }

    figures! {
        /// The dials of the next frames.
        dials => hf_transfer_get_dials -> hf_transfer_dials;
    }

    /// 1 for every target vertex that may sink into the ground.
    pub fn sinking(&self) -> Result<Vec<u8>> {
        let mut out = vec![0; self.vertex_count as usize];
        // SAFETY: there is room for every vertex.
        check(unsafe { raw::hf_transfer_get_sinking(self.handle, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Sets the dials of the next frames.
    pub fn set_dials(&mut self, dials: &TransferDials) -> Result<()> {
        let mut desc = raw::hf_transfer_dials::default();
        dials.fill(&mut desc);
        // SAFETY: the struct is whole.
        check(unsafe { raw::hf_transfer_set_dials(self.handle, &desc) })
    }

    /// Adds pairs of regions that correspond. `flags`: `HF_PAIR_*` for each, or `None`.
    pub fn add_pairs(&mut self, source: &[&[u32]], target: &[&[u32]], flags: Option<&[u32]>) -> Result<Vec<u32>> {
        if source.len() != target.len() || flags.is_some_and(|flags| flags.len() != source.len()) {
            return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, "source, target and flags must be of one length"));
        }
        let ((source_counts, source_vertices), (target_counts, target_vertices)) = (flatten(source, "source")?, flatten(target, "target")?);
        let desc = raw::hf_pairs_desc {
            pair_count: count_of(source.len(), "source")?,
            source_counts: start(&source_counts),
            source_vertices: start(&source_vertices),
            target_counts: start(&target_counts),
            target_vertices: start(&target_vertices),
            flags: start_of(flags),
            ..Default::default()
        };
        let mut out = vec![0; source.len()];
        // SAFETY: all lengths are as `desc` says; `out` has one entry a pair.
        check(unsafe { raw::hf_transfer_add_pairs(self.handle, &desc, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Removes pairs by their numbers.
    pub fn remove_pairs(&mut self, pairs: &[u32]) -> Result<()> {
        // SAFETY: `pairs` has as many entries as said.
        check(unsafe { raw::hf_transfer_remove_pairs(self.handle, count_of(pairs.len(), "pairs")?, start(pairs)) })
    }

    /// What is known of one pair.
    pub fn pair_info(&self, pair: u32) -> Result<raw::hf_pair_info> {
        let mut info = raw::hf_pair_info::default();
        // SAFETY: the struct is whole.
        check(unsafe { raw::hf_transfer_get_pair(self.handle, pair, &mut info) })?;
        Ok(info)
    }

    /// The target in the pose of the source: `posed` has three numbers a vertex of the source.
    pub fn apply<P: Real>(&mut self, posed: &[P]) -> Result<Vec<f64>> {
        of_length(posed, "posed", 3 * self.source_count)?;
        let mut out = vec![0.0; 3 * self.vertex_count];
        let (source_positions, source_positions_f64) = P::both(start(posed));
        let target_positions_f64 = out.as_mut_ptr();
        let frame = raw::hf_transfer_frame { source_positions, source_positions_f64, target_positions_f64, ..Default::default() };
        // SAFETY: both arrays have three numbers a vertex.
        check(unsafe { raw::hf_transfer_apply(self.handle, &frame) })?;
        Ok(out)
    }

    /// The last frame as joints and weights of the target.
    pub fn skin(&self, influence_count: u32) -> Result<Skin> {
        // SAFETY: as in `Pose::skin`.
        skin(self.vertex_count, influence_count, |info| unsafe { raw::hf_transfer_get_skin(self.handle, info) })
    }
}
