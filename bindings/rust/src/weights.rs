//! Weights: skin weights of a surface from a skeleton.
use crate::core::{check, count_of, figures, handle_of, list, object, of_length, rows_of, start, start_of, TryClone};
use crate::{raw, Progress, Result, Surface};
use std::ffi::CString;

/// The joints of a skeleton, in the unit and frame of the mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct Joints<'a> {
    /// three numbers a joint
    pub heads: &'a [f64],
    /// three numbers a joint; `None`: heads are joints, and the library finds the tails
    pub tails: Option<&'a [f64]>,
    /// three numbers a joint, without tails: where each joint points, 0 for unknown
    pub axes: Option<&'a [f64]>,
    /// the number of each joint's parent, or [`crate::raw::HF_NO_INDEX`]; `None`: all are roots
    pub parents: Option<&'a [u32]>,
    /// 1: the joint gets weights; `None`: all do
    pub deforms: Option<&'a [i32]>,
    /// for [`Weights::set_joints`]: the number that each joint had before; `None`: the same
    pub sources: Option<&'a [u32]>,
}

impl Joints<'_> {
    fn desc(&self) -> Result<raw::hf_joints_desc> {
        let joint_count = rows_of(self.heads, 3, "heads")?;
        let count = joint_count as usize;
        self.tails.map_or(Ok(()), |tails| of_length(tails, "tails", 3 * count))?;
        self.axes.map_or(Ok(()), |axes| of_length(axes, "axes", 3 * count))?;
        self.parents.map_or(Ok(()), |parents| of_length(parents, "parents", count))?;
        self.deforms.map_or(Ok(()), |deforms| of_length(deforms, "deforms", count))?;
        self.sources.map_or(Ok(()), |sources| of_length(sources, "sources", count))?;
        Ok(raw::hf_joints_desc {
            joint_count,
            heads: start(self.heads),
            tails: start_of(self.tails),
            axes: start_of(self.axes),
            parents: start_of(self.parents),
            deforms: start_of(self.deforms),
            sources: start_of(self.sources),
            ..Default::default()
        })
    }
}

object!(
    /// The weights of one surface for one skeleton.
    Weights: hf_weights, hf_weights_destroy { vertex_count: usize }
);

/// Joints and weights of every vertex, `influence_count` each.
#[derive(Clone, Debug, Default)]
pub struct VertexWeights {
    /// joints of a vertex: 4 or 8
    pub influence_count: usize,
    /// numbers of joints
    pub joints: Vec<u32>,
    /// their weights, descending, of sum 1
    pub weights: Vec<f32>,
    /// `HF_WEIGHTS_*`: how the weights of a vertex were found
    pub origins: Vec<u8>,
}

/// How weights are carried and mirrored; 0 is the library's own.
#[derive(Clone, Copy, Debug, Default)]
pub struct WeightTransferOptions<'a> {
    /// a vertex matches points within it, in the unit of the mesh
    pub distance: f64,
    /// between the normals of vertex and point, in radians
    pub angle: f64,
    /// joints a vertex of the result: 4 or 8
    pub influence_count: u32,
    /// follows the call, and cancels it
    pub progress: Option<&'a Progress>,
}

/// What [`mirror_weights`] takes beside the weights.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mirror<'a> {
    /// the joints at rest, three numbers a joint
    pub heads: &'a [f64],
    /// names pair the joints; `None`: their places do
    pub names: Option<&'a [&'a str]>,
    /// the joint of the other side, or [`crate::raw::HF_NO_INDEX`]: find it
    pub partners: Option<&'a [u32]>,
    /// a point and a normal; `None`: find the plane
    pub plane: Option<[f64; 6]>,
    /// `HF_MIRROR_*`: which side takes the weights
    pub to: i32,
    /// how near a point must be
    pub options: WeightTransferOptions<'a>,
}

/// Mirrored weights.
#[derive(Clone, Debug)]
pub struct Mirrored {
    /// of all vertices
    pub weights: VertexWeights,
    /// the joint of the other side, by joint
    pub partners: Vec<u32>,
    /// `HF_MIRROR_JOINT_*` by joint
    pub pairings: Vec<u32>,
    /// what was found
    pub info: raw::hf_weights_mirror_info,
}

/// Names as the library takes them: one line for each.
fn lines_of(names: Option<&[&str]>, count: usize) -> Result<Option<CString>> {
    let Some(names) = names else { return Ok(None) };
    of_length(names, "names", count)?;
    let text: String = names.iter().map(|name| name.replace(['\n', '\0'], " ") + "\n").collect();
    Ok(Some(CString::new(text).unwrap_or_default()))
}

/// Arrays for all vertices, filled by a call.
fn filled(n: usize, influence_count: u32, call: impl FnOnce(&mut raw::hf_weights_out) -> i32) -> Result<VertexWeights> {
    let k = influence_count as usize;
    let mut out = VertexWeights { influence_count: k, joints: vec![0; n * k], weights: vec![0.0; n * k], origins: vec![0; n] };
    let mut desc = raw::hf_weights_out { vertex_capacity: count_of(n, "vertices")?, ..Default::default() };
    (desc.joints, desc.weights, desc.origins) = (out.joints.as_mut_ptr(), out.weights.as_mut_ptr(), out.origins.as_mut_ptr());
    check(call(&mut desc))?;
    Ok(out)
}

/// The joints of each vertex in a list of all.
fn influences_of(surface: &Surface, joints: &[u32], weights: &[f32]) -> Result<u32> {
    let n = surface.vertex_count;
    let each = joints.len() / n.max(1);
    of_length(joints, "joints", each * n)?;
    of_length(weights, "weights", joints.len())?;
    count_of(each, "joints")
}

/// Carries weights to another surface: clothes, levels of detail. `joints` and `weights`: as many numbers for each vertex
/// of the source.
pub fn transfer_weights(
    source: &Surface,
    joints: &[u32],
    weights: &[f32],
    target: &Surface,
    options: &WeightTransferOptions,
) -> Result<(VertexWeights, raw::hf_weights_transfer_info)> {
    let influence_count = if options.influence_count == 0 { 4 } else { options.influence_count };
    let desc = raw::hf_weights_transfer_desc {
        source_influence_count: influences_of(source, joints, weights)?,
        joints: start(joints),
        weights: start(weights),
        distance: options.distance,
        angle: options.angle,
        influence_count,
        progress: handle_of(options.progress),
        ..Default::default()
    };
    let mut info = raw::hf_weights_transfer_info::default();
    let found = filled(target.vertex_count, influence_count, |out| {
        // SAFETY: the lengths are checked, and `out` has room for all vertices of the target.
        unsafe { raw::hf_weights_transfer(source.handle, target.handle, &desc, out, &mut info) }
    })?;
    Ok((found, info))
}

/// Mirrors weights of one side to the other.
pub fn mirror_weights(surface: &Surface, joints: &[u32], weights: &[f32], mirror: &Mirror) -> Result<Mirrored> {
    let joint_count = rows_of(mirror.heads, 3, "heads")?;
    let count = joint_count as usize;
    let lines = lines_of(mirror.names, count)?;
    mirror.partners.map_or(Ok(()), |partners| of_length(partners, "partners", count))?;
    let influence_count = if mirror.options.influence_count == 0 { 4 } else { mirror.options.influence_count };
    let desc = raw::hf_weights_mirror_desc {
        joint_count,
        heads: start(mirror.heads),
        names: lines.as_ref().map_or(std::ptr::null(), |text| text.as_ptr()),
        partners: start_of(mirror.partners),
        plane: start_of(mirror.plane.as_ref().map(|plane| &plane[..])),
        source_influence_count: influences_of(surface, joints, weights)?,
        to: mirror.to,
        joints: start(joints),
        weights: start(weights),
        distance: mirror.options.distance,
        angle: mirror.options.angle,
        influence_count,
        progress: handle_of(mirror.options.progress),
        ..Default::default()
    };
    let (mut partners, mut pairings) = (vec![0; count], vec![0; count]);
    let mut info = raw::hf_weights_mirror_info::default();
    let found = filled(surface.vertex_count, influence_count, |out| {
        // SAFETY: the lengths are checked, and the lists have room for all vertices and joints.
        unsafe { raw::hf_weights_mirror(surface.handle, &desc, out, partners.as_mut_ptr(), pairings.as_mut_ptr(), &mut info) }
    })?;
    Ok(Mirrored { weights: found, partners, pairings, info })
}

impl Weights {
    /// Computes weights. `influence_count`: joints a vertex, 4 or 8, or 0 for 4.
    pub fn new(surface: &Surface, joints: &Joints, influence_count: u32) -> Result<Self> {
        let (desc, mut handle) = (joints.desc()?, std::ptr::null_mut());
        // SAFETY: `desc` checked every length.
        check(unsafe { raw::hf_weights_create(surface.handle, &desc, influence_count, &mut handle) })?;
        Ok(Weights { handle, vertex_count: surface.vertex_count })
    }

    /// A copy of its own, on the same factors.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_weights_clone(self.handle, &mut handle) })?;
        Ok(Weights { handle, vertex_count: self.vertex_count })
    }

    /// Replaces all joints.
    pub fn set_joints(&mut self, joints: &Joints) -> Result<()> {
        // SAFETY: `desc` checked every length.
        check(unsafe { raw::hf_weights_set_joints(self.handle, &joints.desc()?) })
    }

    /// Replaces all pins: vertices with given weights, `influence_count` joints each.
    pub fn set_pins(&mut self, vertices: &[u32], influence_count: u32, joints: &[u32], weights: &[f32]) -> Result<()> {
        of_length(joints, "joints", vertices.len() * influence_count as usize)?;
        of_length(weights, "weights", joints.len())?;
        let desc = raw::hf_pins_desc {
            pin_count: count_of(vertices.len(), "vertices")?,
            vertices: start(vertices),
            influence_count,
            joints: start(joints),
            weights: start(weights),
            ..Default::default()
        };
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_weights_set_pins(self.handle, &desc) })
    }

    /// Locks joints: their present weights stay. Replaces all locks.
    pub fn set_locks(&mut self, joints: &[u32]) -> Result<()> {
        // SAFETY: null values keep the present weights.
        check(unsafe { raw::hf_weights_set_locks(self.handle, count_of(joints.len(), "joints")?, start(joints), std::ptr::null()) })
    }

    figures! {
        /// Counts of what was found and guessed.
        info => hf_weights_get_info -> hf_weights_info;
    }

    /// The weights of all vertices.
    pub fn get(&self) -> Result<VertexWeights> {
        let mut desc = raw::hf_weights_out::default();
        // SAFETY: null arrays ask for the counts; then the arrays are that large.
        check(unsafe { raw::hf_weights_get(self.handle, &mut desc) })?;
        filled(self.vertex_count, desc.influence_count, |out| unsafe { raw::hf_weights_get(self.handle, out) })
    }

    /// `HF_JOINT_*` of each joint: why it deserves a look.
    pub fn joint_flags(&self) -> Result<Vec<u32>> {
        // SAFETY: `list` gives room for as many joints as it says.
        list(|capacity, flags, count| unsafe { raw::hf_weights_get_joints(self.handle, capacity, flags, std::ptr::null_mut(), count) })
    }

    /// `HF_HELPER_*` of each joint: why it looks like a helper. `names`: one for each joint; `None`: by places alone.
    pub fn helpers(&self, names: Option<&[&str]>) -> Result<Vec<u32>> {
        let lines = names.map_or(Ok(None), |given| lines_of(Some(given), given.len()))?;
        let text = lines.as_ref().map_or(std::ptr::null(), |lines| lines.as_ptr());
        // SAFETY: `list` gives room for as many joints as it says; the text ends with a zero.
        list(|capacity, reasons, count| unsafe { raw::hf_weights_get_helpers(self.handle, text, capacity, reasons, count) })
    }
}

impl TryClone for Weights {
    fn try_clone(&self) -> Result<Self> {
        Weights::try_clone(self)
    }
}
