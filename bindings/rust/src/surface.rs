//! Surface: a mesh or a graph with its operator and its factor.
use crate::core::{
    check, count_of, figures, handle_of, list, object, of_length, options, rows_of, start, start_of, Corner, Progress, Real,
};
use crate::{raw, Error, Result};

options!(
    /// How a surface of a mesh is made. Zero is the default of every option.
    SurfaceOptions: hf_surface_desc {
        /// `HF_WELD_*`
        weld: i32,
        /// for `HF_WELD_TOLERANCE`, in the unit of the positions
        weld_tolerance: f64,
        /// `HF_OPERATOR_*`
        operator_kind: i32,
        /// `HF_FIELD_*`: the factor made now
        field_kind: i32,
        /// `HF_ORDERING_*`
        ordering: i32,
        /// threads the library may use, yours included; 0 = 1
        thread_count: u32,
        /// larger meshes are refused; 0 = 20,000,000
        vertex_limit: u32,
        /// more triangles are refused; 0 = eight per vertex of the limit
        triangle_limit: u32,
        /// MiB of the surface and all on it; 0 = no limit
        memory_limit_mb: u32,
        /// 10^9 operations of a factorisation; 0 = 100,000
        work_limit_gflop: u32,
        /// bytes between vertices; 0 = packed
        position_stride: u32,
        /// bytes between triangles; 0 = packed
        triangle_stride: u32,
    }
);

options!(
    /// How a surface of a graph is made. Zero is the default of every option.
    GraphOptions: hf_graph_desc {
        /// 1: edges may have negative weights
        allow_negative: i32,
        /// `HF_FIELD_*`
        field_kind: i32,
        /// `HF_ORDERING_*`
        ordering: i32,
        /// threads the library may use, yours included; 0 = 1
        thread_count: u32,
        /// larger graphs are refused
        vertex_limit: u32,
        /// more edges are refused
        edge_limit: u32,
        /// MiB of the surface and all on it; 0 = no limit
        memory_limit_mb: u32,
        /// 10^9 operations of a factorisation; 0 = 100,000
        work_limit_gflop: u32,
    }
);

options!(
    /// How loose pieces are linked by springs.
    LinkOptions: hf_links_desc {
        /// `HF_LINK_*`; the default of a desc is none
        mode: i32,
        /// longest link; 0 = 5 % of the bounding box diagonal
        distance: f64,
        /// stiffness of the springs; 0 = the default
        stiffness: f64,
        /// pieces nearer than this to another are light; 0 = the default
        overlay_distance: f64,
    }
);

/// What may come with a mesh beside its options.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extras<'a> {
    /// Bytes that [`Surface::save`] wrote for the same mesh.
    pub saved_factor: Option<&'a [u8]>,
    /// Links between loose pieces. Without it, there are none.
    pub links: Option<LinkOptions>,
    /// With links: a number per vertex. Pieces of different tags stay apart.
    pub tags: Option<&'a [u32]>,
    /// An object to poll and cancel through.
    pub progress: Option<&'a Progress>,
}

object!(
    /// A mesh, its welds, its operator and its factor. It never changes. Objects made on it keep what they need of it.
    Surface: hf_surface, hf_surface_destroy { vertex_count: usize }
);

fn factor_desc(bytes: &[u8]) -> raw::hf_factor_desc {
    raw::hf_factor_desc { bytes: bytes.as_ptr().cast(), byte_count: bytes.len(), ..Default::default() }
}

/// Entries of a row that is `stride` bytes long; a packed row has three.
fn row_of<T>(stride: u32) -> Result<usize> {
    let size = std::mem::size_of::<T>();
    match stride as usize {
        0 => Ok(3),
        s if s % size == 0 && s >= 3 * size => Ok(s / size),
        s => Err(Error::new(raw::HF_ERROR_TOO_SMALL, format!("a stride of {s} bytes is no whole row of three"))),
    }
}

impl Surface {
    /// Welds, checks and factorises a mesh. `positions` has three numbers a vertex, `triangles` three vertices each.
    pub fn new<P: Real, T: Corner>(positions: &[P], triangles: &[T], options: &SurfaceOptions) -> Result<Self> {
        Self::with(positions, triangles, options, &Extras::default())
    }

    /// As [`Surface::new`], with a saved factor, links or a progress object.
    pub fn with<P: Real, T: Corner>(positions: &[P], triangles: &[T], options: &SurfaceOptions, extras: &Extras) -> Result<Self> {
        let row = row_of::<T>(options.triangle_stride)?;
        let mut desc = raw::hf_surface_desc { triangle_count: rows_of(triangles, row, "triangles")?, ..Default::default() };
        (desc.triangles_u16, desc.triangles) = T::both(start(triangles));
        Self::make(desc, positions, options, extras)
    }

    /// A surface of faces with any number of corners: face i has `sizes[i]` of the `corners`, one behind the other.
    pub fn from_faces<P: Real>(positions: &[P], sizes: &[u32], corners: &[u32], options: &SurfaceOptions, extras: &Extras) -> Result<Self> {
        let mut desc = raw::hf_surface_desc { face_count: count_of(sizes.len(), "sizes")?, ..Default::default() };
        desc.corner_count = count_of(corners.len(), "corners")?;
        (desc.face_sizes, desc.corners) = (start(sizes), start(corners));
        Self::make(desc, positions, options, extras)
    }

    fn make<P: Real>(mut desc: raw::hf_surface_desc, positions: &[P], options: &SurfaceOptions, extras: &Extras) -> Result<Self> {
        options.fill(&mut desc);
        desc.vertex_count = rows_of(positions, row_of::<P>(options.position_stride)?, "positions")?;
        (desc.positions, desc.positions_f64) = P::both(start(positions));
        let factor = extras.saved_factor.map(factor_desc);
        desc.saved_factor = factor.as_ref().map_or(std::ptr::null(), |f| f);
        let mut links = raw::hf_links_desc::default();
        if let Some(given) = extras.links {
            given.fill(&mut links);
            if let Some(tags) = extras.tags {
                of_length(tags, "tags", desc.vertex_count as usize)?;
            }
            links.tags = start_of(extras.tags);
            desc.links = &links;
        }
        desc.progress = handle_of(extras.progress);
        let mut handle = std::ptr::null_mut();
        // SAFETY: every pointer of `desc` is null or points to a slice of the length that `desc` says, alive in this call.
        check(unsafe { raw::hf_surface_create(&desc, &mut handle) })?;
        Ok(Surface { handle, vertex_count: desc.vertex_count as usize })
    }

    /// A surface of a graph: two vertices and a weight for each edge. `masses` (one per vertex) serve bi-harmonic fields.
    pub fn from_graph(vertex_count: u32, edges: &[u32], weights: &[f64], masses: Option<&[f64]>, options: &GraphOptions) -> Result<Self> {
        of_length(edges, "edges", 2 * weights.len())?;
        if let Some(masses) = masses {
            of_length(masses, "masses", vertex_count as usize)?;
        }
        let mut desc = raw::hf_graph_desc { vertex_count, edge_count: count_of(weights.len(), "weights")?, ..Default::default() };
        options.fill(&mut desc);
        (desc.edges, desc.weights, desc.masses) = (start(edges), start(weights), start_of(masses));
        let mut handle = std::ptr::null_mut();
        // SAFETY: as above.
        check(unsafe { raw::hf_surface_create_graph(&desc, &mut handle) })?;
        Ok(Surface { handle, vertex_count: vertex_count as usize })
    }

    /// Vertices as given.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    figures! {
        /// What the surface was made with.
        info => hf_surface_get_info -> hf_surface_info;
        /// What was found in the mesh.
        report => hf_surface_get_report -> hf_surface_report;
        /// Times and sizes of the factor.
        statistics => hf_surface_get_statistics -> hf_surface_statistics;
    }

    /// The number of the component of every vertex.
    pub fn components(&self) -> Result<Vec<u32>> {
        // SAFETY: `list` passes room for as many entries as it says. So do the calls below.
        list(|room, out, count| unsafe { raw::hf_surface_get_components(self.handle, room, out, count) })
    }

    /// The links between pieces.
    pub fn links(&self) -> Result<Vec<raw::hf_link>> {
        // SAFETY: see `components`.
        list(|room, out, count| unsafe { raw::hf_surface_get_links(self.handle, room, out, count) })
    }

    /// The factor of a kind of field (`HF_FIELD_*`) as bytes for [`Extras::saved_factor`].
    pub fn save(&self, field_kind: i32) -> Result<Vec<u8>> {
        let (null, mut size) = (std::ptr::null_mut(), 0);
        // SAFETY: null asks for the size alone; then `bytes` is that large.
        check(unsafe { raw::hf_surface_save(self.handle, field_kind, null, 0, std::ptr::null_mut(), &mut size) })?;
        let mut bytes = vec![0u8; size];
        check(unsafe { raw::hf_surface_save(self.handle, field_kind, null, size, bytes.as_mut_ptr().cast(), &mut size) })?;
        Ok(bytes)
    }

    fn pick<P: Real>(&self, posed: Option<&[P]>) -> Result<raw::hf_pick_desc> {
        let mut desc = raw::hf_pick_desc::default();
        if let Some(posed) = posed {
            of_length(posed, "posed", 3 * self.vertex_count)?;
            (desc.positions, desc.positions_f64) = P::both(start(posed));
        }
        Ok(desc)
    }

    /// The first triangle on a ray, or `None`. `posed`: positions of a pose, or `None` for rest.
    /// `front_only` 1 passes triangles seen from behind.
    pub fn cast_ray<P: Real>(
        &self,
        origin: [f64; 3],
        direction: [f64; 3],
        posed: Option<&[P]>,
        front_only: i32,
    ) -> Result<Option<raw::hf_hit>> {
        let (mut desc, mut hit) = (self.pick(posed)?, raw::hf_hit::default());
        desc.front_only = front_only;
        // SAFETY: all pointers are to arrays of the documented lengths.
        check(unsafe { raw::hf_surface_cast_ray(self.handle, origin.as_ptr(), direction.as_ptr(), &desc, &mut hit) })?;
        Ok((hit.found == 1).then_some(hit))
    }

    /// The vertex nearest to a point, and its distance.
    pub fn find_vertex<P: Real>(&self, point: [f64; 3], posed: Option<&[P]>) -> Result<(u32, f64)> {
        let (desc, mut vertex, mut distance) = (self.pick(posed)?, 0, 0.0);
        // SAFETY: as above.
        check(unsafe { raw::hf_surface_find_vertex(self.handle, point.as_ptr(), &desc, &mut vertex, &mut distance) })?;
        Ok((vertex, distance))
    }

    /// A field as the library reads it.
    pub(crate) fn scalars<P: Real>(&self, field: &[P]) -> Result<raw::hf_scalars> {
        of_length(field, "field", self.vertex_count)?;
        let (values, values_f64) = P::both(start(field));
        Ok(raw::hf_scalars { values, values_f64, ..Default::default() })
    }

    /// Levels between the least and the greatest value of a field. `spacing`: `HF_LEVELS_*`.
    pub fn space_levels<P: Real>(&self, field: &[P], count: u32, spacing: i32) -> Result<Vec<f64>> {
        let desc = self.scalars(field)?;
        let mut out = vec![0.0; (count as usize).min(1_000_000)];
        // SAFETY: the library refuses more than 1,000,000 levels before it writes.
        check(unsafe { raw::hf_surface_space_levels(self.handle, &desc, spacing, count, out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// The lines on which a field has the given values.
    pub fn trace_isolines<P: Real>(&self, field: &[P], levels: &[f64]) -> Result<Isolines> {
        let (desc, count) = (self.scalars(field)?, count_of(levels.len(), "levels")?);
        let mut lines = raw::hf_isolines::default();
        // SAFETY: null arrays ask for the counts; then the arrays are that large.
        check(unsafe { raw::hf_surface_trace_isolines(self.handle, &desc, count, start(levels), &mut lines) })?;
        let (p, k) = (lines.point_count as usize, lines.line_count as usize);
        let mut out = Isolines { positions: vec![0.0; 3 * p], starts: vec![0; k + 1], levels: vec![0; k], closed: vec![0; k] };
        if k > 0 {
            (lines.point_capacity, lines.line_capacity) = (lines.point_count, lines.line_count);
            (lines.positions, lines.line_starts) = (out.positions.as_mut_ptr(), out.starts.as_mut_ptr());
            (lines.line_levels, lines.line_closed) = (out.levels.as_mut_ptr(), out.closed.as_mut_ptr());
            check(unsafe { raw::hf_surface_trace_isolines(self.handle, &desc, count, start(levels), &mut lines) })?;
        }
        Ok(out)
    }

    /// Minima, maxima and saddles of a field.
    pub fn find_critical_points<P: Real>(&self, field: &[P]) -> Result<Vec<raw::hf_critical_point>> {
        let (desc, mut info) = (self.scalars(field)?, raw::hf_critical_info::default());
        // SAFETY: see `trace_isolines`.
        check(unsafe { raw::hf_surface_find_critical_points(self.handle, &desc, 0, std::ptr::null_mut(), &mut info) })?;
        let mut out = vec![raw::hf_critical_point::default(); info.point_count as usize];
        if !out.is_empty() {
            check(unsafe { raw::hf_surface_find_critical_points(self.handle, &desc, info.point_count, out.as_mut_ptr(), &mut info) })?;
        }
        Ok(out)
    }

    /// The tips of the shape.
    pub fn find_extremities(&self) -> Result<Vec<raw::hf_extremity>> {
        // SAFETY: see `components`; null is the default desc.
        list(|room, out, count| unsafe { raw::hf_surface_find_extremities(self.handle, std::ptr::null(), room, out, count) })
    }

    /// Places for handles, those to be pinned first.
    pub fn propose_handles(&self) -> Result<Vec<raw::hf_handle_proposal>> {
        // SAFETY: see `find_extremities`.
        list(|room, out, count| unsafe { raw::hf_surface_propose_handles(self.handle, std::ptr::null(), room, out, count) })
    }
}

/// Lines on a surface. Line i has the points `starts[i]` to `starts[i + 1] - 1`.
#[derive(Clone, Debug, Default)]
pub struct Isolines {
    /// three numbers a point
    pub positions: Vec<f64>,
    /// one more than lines
    pub starts: Vec<u32>,
    /// the level of each line
    pub levels: Vec<u32>,
    /// 1: the line is closed
    pub closed: Vec<i32>,
}
