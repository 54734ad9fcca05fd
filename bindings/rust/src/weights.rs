//! Weights: skin weights of a surface from a skeleton.
use crate::core::{check, count_of, figures, object, of_length, plain, rows_of, start, start_of};
use crate::{raw, Result, Surface};

/// The bones of a skeleton, in the unit and frame of the mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bones<'a> {
    /// three numbers a bone
    pub heads: &'a [f64],
    /// three numbers a bone; `None`: heads are joints, and the library finds the tails
    pub tails: Option<&'a [f64]>,
    /// the number of each bone's parent, or [`crate::raw::HF_NO_INDEX`]; `None`: all are roots
    pub parents: Option<&'a [u32]>,
    /// 1: the bone gets weights; `None`: all do
    pub deforms: Option<&'a [i32]>,
    /// for [`Weights::set_bones`]: the number that each bone had before; `None`: the same
    pub sources: Option<&'a [u32]>,
}

impl Bones<'_> {
    fn desc(&self) -> Result<raw::hf_bones_desc> {
        let bone_count = rows_of(self.heads, 3, "heads")?;
        let count = bone_count as usize;
        self.tails.map_or(Ok(()), |tails| of_length(tails, "tails", 3 * count))?;
        self.parents.map_or(Ok(()), |parents| of_length(parents, "parents", count))?;
        self.deforms.map_or(Ok(()), |deforms| of_length(deforms, "deforms", count))?;
        self.sources.map_or(Ok(()), |sources| of_length(sources, "sources", count))?;
        Ok(raw::hf_bones_desc {
            bone_count,
            heads: start(self.heads),
            tails: start_of(self.tails),
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

/// Joints and weights of every vertex, `weight_count` each.
#[derive(Clone, Debug, Default)]
pub struct VertexWeights {
    /// bones of a vertex: 4 or 8
    pub weight_count: usize,
    /// numbers of bones
    pub joints: Vec<u32>,
    /// their weights, descending, of sum 1
    pub weights: Vec<f32>,
    /// `HF_WEIGHTS_*`: how the weights of a vertex were found
    pub origins: Vec<u8>,
}

impl Weights {
    /// Computes weights. `weight_count`: bones a vertex, 4 or 8, or 0 for 4.
    pub fn new(surface: &Surface, bones: &Bones, weight_count: u32) -> Result<Self> {
        let (desc, mut handle) = (bones.desc()?, std::ptr::null_mut());
        // SAFETY: `desc` checked every length.
        check(unsafe { raw::hf_weights_create(surface.handle, &desc, weight_count, &mut handle) })?;
        Ok(Weights { handle, vertex_count: surface.vertex_count })
    }

    /// A copy of its own, on the same factors.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_weights_clone(self.handle, &mut handle) })?;
        Ok(Weights { handle, vertex_count: self.vertex_count })
    }

    /// Replaces all bones.
    pub fn set_bones(&mut self, bones: &Bones) -> Result<()> {
        // SAFETY: `desc` checked every length.
        check(unsafe { raw::hf_weights_set_bones(self.handle, &bones.desc()?) })
    }

    /// Replaces all pins: vertices with given weights, `joint_count` bones each.
    pub fn set_pins(&mut self, vertices: &[u32], joint_count: u32, joints: &[u32], weights: &[f32]) -> Result<()> {
        of_length(joints, "joints", vertices.len() * joint_count as usize)?;
        of_length(weights, "weights", joints.len())?;
        let desc = raw::hf_pins_desc {
            pin_count: count_of(vertices.len(), "vertices")?,
            vertices: start(vertices),
            joint_count,
            joints: start(joints),
            weights: start(weights),
            ..Default::default()
        };
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_weights_set_pins(self.handle, &desc) })
    }

    /// Locks bones: their present weights stay. Replaces all locks.
    pub fn set_locks(&mut self, bones: &[u32]) -> Result<()> {
        // SAFETY: null values keep the present weights.
        check(unsafe { raw::hf_weights_set_locks(self.handle, count_of(bones.len(), "bones")?, start(bones), std::ptr::null()) })
    }

    figures! {
        /// Counts of what was found and guessed.
        info => hf_weights_get_info -> hf_weights_info;
    }

    plain! {
        /// Records bones, pins and locks for undo.
        record => hf_weights_record;
        /// Restores the last record.
        undo => hf_weights_undo;
        /// Reverts the last undo.
        redo => hf_weights_redo;
    }

    /// The weights of all vertices.
    pub fn get(&self) -> Result<VertexWeights> {
        let mut desc = raw::hf_weights_out::default();
        // SAFETY: null arrays ask for the counts; then the arrays are that large.
        check(unsafe { raw::hf_weights_get(self.handle, &mut desc) })?;
        let (n, k) = (self.vertex_count, desc.weight_count as usize);
        let mut out = VertexWeights { weight_count: k, joints: vec![0; n * k], weights: vec![0.0; n * k], origins: vec![0; n] };
        desc.vertex_capacity = desc.vertex_count;
        (desc.joints, desc.weights, desc.origins) = (out.joints.as_mut_ptr(), out.weights.as_mut_ptr(), out.origins.as_mut_ptr());
        check(unsafe { raw::hf_weights_get(self.handle, &mut desc) })?;
        Ok(out)
    }
}
