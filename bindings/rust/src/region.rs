//! Region and Detail: a part of a surface, its smooth base, and the detail on it.
use crate::core::{check, count_of, figures, list, object, of_length, options, start, Real, TryClone};
use crate::{raw, Result, Surface};

options!(
    /// How a region is made.
    RegionOptions: hf_region_desc {
        /// `HF_BASE_*`: a thin plate, or a membrane
        base: i32,
    }
);

object!(
    /// A part of a surface and its smooth base.
    Region: hf_region, hf_region_destroy { vertex_count: usize }
);

/// One change of a region.
#[derive(Clone, Copy, Debug, Default)]
pub struct RegionEdit<'a> {
    /// vertices of a closed curve: the region becomes what it encloses
    pub curve: Option<&'a [u32]>,
    /// with a curve: `HF_SIDE_*`
    pub side: i32,
    /// with a side by a vertex: that vertex
    pub seed_vertex: u32,
    /// with a curve: `HF_CURVE_*`, straight through triangles or along edges
    pub curve_kind: i32,
    /// rings of vertices more, or fewer if negative
    pub rings: i32,
    /// vertices that come in
    pub add: &'a [u32],
    /// vertices that go out
    pub remove: &'a [u32],
}

fn morph(vertex_count: usize, weight: f64, call: impl FnOnce(&raw::hf_morph_desc) -> i32) -> Result<Vec<f64>> {
    let mut out = vec![0.0; 3 * vertex_count];
    let desc = raw::hf_morph_desc { weight, positions_f64: out.as_mut_ptr(), ..Default::default() };
    check(call(&desc))?;
    Ok(out)
}

impl Region {
    /// An empty region. `positions`: a pose to work on, or `None` for rest.
    pub fn new<P: Real>(surface: &Surface, positions: Option<&[P]>, options: &RegionOptions) -> Result<Self> {
        let (mut desc, mut handle) = (raw::hf_region_desc::default(), std::ptr::null_mut());
        options.fill(&mut desc);
        if let Some(positions) = positions {
            of_length(positions, "positions", 3 * surface.vertex_count)?;
            (desc.positions, desc.positions_f64) = P::both(start(positions));
        }
        // SAFETY: the positions are null or three numbers a vertex.
        check(unsafe { raw::hf_region_create(surface.handle, &desc, &mut handle) })?;
        Ok(Region { handle, vertex_count: surface.vertex_count })
    }

    /// A copy of its own.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_region_clone(self.handle, &mut handle) })?;
        Ok(Region { handle, vertex_count: self.vertex_count })
    }

    /// Carries out one edit.
    pub fn edit(&mut self, edit: &RegionEdit) -> Result<()> {
        let mut curve = raw::hf_curve_desc { side: edit.side, seed_vertex: edit.seed_vertex, kind: edit.curve_kind, ..Default::default() };
        let mut desc = raw::hf_region_edit_desc {
            ring_count: edit.rings,
            add_count: count_of(edit.add.len(), "add")?,
            add_vertices: start(edit.add),
            remove_count: count_of(edit.remove.len(), "remove")?,
            remove_vertices: start(edit.remove),
            ..Default::default()
        };
        if let Some(points) = edit.curve {
            (curve.point_count, curve.vertices) = (count_of(points.len(), "curve")?, start(points));
            desc.curve = &curve;
        }
        // SAFETY: all arrays are as long as said and alive in this call.
        check(unsafe { raw::hf_region_edit(self.handle, &desc) })
    }

    figures! {
        /// Counts and areas.
        info => hf_region_get_info -> hf_region_info;
    }

    /// Vertices inside (0), on the rim (1), or the sites that hold the base (2).
    pub fn vertices(&self, which: i32) -> Result<Vec<u32>> {
        // SAFETY: `list` passes room for as many entries as it says.
        list(|room, out, count| unsafe { raw::hf_region_get_vertices(self.handle, which, room, out, count) })
    }

    /// The corners of the last closed curve, to draw it: x, y, z of each. The last is joined to the first.
    pub fn curve(&self) -> Result<Vec<f64>> {
        // SAFETY: `list` passes room for as many triples as it says.
        let corners: Vec<[f64; 3]> =
            list(|room, out: *mut [f64; 3], count| unsafe { raw::hf_region_get_curve(self.handle, room, out.cast(), count) })?;
        Ok(corners.concat())
    }

    /// 0 is the surface, 1 its base without detail; between and beyond in proportion.
    pub fn morph(&mut self, weight: f64) -> Result<Vec<f64>> {
        // SAFETY: `morph` passes room for three numbers a vertex.
        morph(self.vertex_count, weight, |desc| unsafe { raw::hf_region_morph(self.handle, desc) })
    }
}

object!(
    /// The detail of one region carried to another.
    Detail: hf_detail, hf_detail_destroy { vertex_count: usize }
);
impl Detail {
    /// `source_vertices` and `target_vertices` are points of the rims that correspond. `scale`: of the detail; 0: found.
    pub fn new(source: &Region, target: &Region, scale: f64, source_vertices: &[u32], target_vertices: &[u32]) -> Result<Self> {
        of_length(target_vertices, "target_vertices", source_vertices.len())?;
        let mut handle = std::ptr::null_mut();
        let desc = raw::hf_detail_desc {
            pair_count: count_of(source_vertices.len(), "source_vertices")?,
            source_vertices: start(source_vertices),
            target_vertices: start(target_vertices),
            scale,
            ..Default::default()
        };
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_detail_create(source.handle, target.handle, &desc, &mut handle) })?;
        Ok(Detail { handle, vertex_count: target.vertex_count })
    }

    /// The target with the detail of the source by `weight`.
    pub fn morph(&mut self, weight: f64) -> Result<Vec<f64>> {
        // SAFETY: as in `Region::morph`.
        morph(self.vertex_count, weight, |desc| unsafe { raw::hf_detail_morph(self.handle, desc) })
    }
}

impl TryClone for Region {
    fn try_clone(&self) -> Result<Self> {
        Region::try_clone(self)
    }
}
