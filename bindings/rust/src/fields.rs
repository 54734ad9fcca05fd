//! Made on a surface: geodesic distances, direction fields, quad meshes, streamlines.
use crate::core::{check, count_of, figures, list, object, of_length, options, rows_of, start, start_of, Real, TryClone};
use crate::{raw, Result, Surface};

options!(
    /// How geodesic distances are made.
    GeodesicsOptions: hf_geodesics_desc {
        /// of `HF_GEODESICS_HEAT`: times the squared edge length; 0 = the default
        smoothing: f64,
        /// `HF_GEODESICS_*`
        method: i32,
    }
);
options!(
    /// How a direction field is made.
    DirectionOptions: hf_direction_desc {
        /// 1 vectors, 2 lines, 4 crosses; 0 = 4
        degree: u32,
        /// more constraints are refused; 0 = no limit
        site_limit: u32,
    }
);
options!(
    /// How a quad mesh is made.
    QuadsOptions: hf_quads_desc {
        /// wanted number of quads, instead of `edge_length`; 0 = none
        face_count: u32,
        /// wanted, in the unit of the mesh; 0 = 0.022 box diagonals
        edge_length: f64,
        /// edges that bend by more degrees are kept; 0 = none
        crease_angle: f64,
        /// rounds of evening out; 0 = 60
        relax_count: u32,
    }
);

object!(
    /// Geodesic distances on a surface.
    Geodesics: hf_geodesics, hf_geodesics_destroy { vertex_count: usize }
);
impl Geodesics {
    /// Makes the tables of the method.
    pub fn new(surface: &Surface, options: &GeodesicsOptions) -> Result<Self> {
        let (mut desc, mut handle) = (raw::hf_geodesics_desc::default(), std::ptr::null_mut());
        options.fill(&mut desc);
        // SAFETY: the handles are valid and `desc` is whole.
        check(unsafe { raw::hf_geodesics_create(surface.handle, &desc, &mut handle) })?;
        Ok(Geodesics { handle, vertex_count: surface.vertex_count })
    }

    /// The distance of every vertex to the nearest source.
    pub fn distance(&self, sources: &[u32]) -> Result<Vec<f64>> {
        let mut out = vec![0.0; self.vertex_count];
        let count = count_of(sources.len(), "sources")?;
        // SAFETY: `out` has one number a vertex.
        check(unsafe { raw::hf_geodesics_solve_f64(self.handle, count, start(sources), out.as_mut_ptr(), 0) })?;
        Ok(out)
    }

    /// The shortest path between two places: xyz of its corners; empty where none leads. A place is a vertex
    /// (`3.into()`), or a hit of `Surface::cast_ray` (`(&hit).into()`).
    pub fn path(&self, from: &raw::hf_surface_point, to: &raw::hf_surface_point) -> Result<Vec<f64>> {
        let mut path = raw::hf_path::default();
        // SAFETY: no array is given, so the counts alone are written.
        check(unsafe { raw::hf_geodesics_find_path(self.handle, from, to, &mut path) })?;
        let mut positions = vec![0.0; 3 * path.point_count as usize];
        path.point_capacity = path.point_count;
        path.positions = positions.as_mut_ptr();
        // SAFETY: `positions` has three numbers for every point of the capacity.
        check(unsafe { raw::hf_geodesics_find_path(self.handle, from, to, &mut path) })?;
        Ok(positions)
    }

    /// The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius (0: no bound).
    pub fn map(&self, centre: &raw::hf_surface_point, radius: f64) -> Result<Vec<f64>> {
        let mut out = vec![0.0; 2 * self.vertex_count];
        // SAFETY: `out` has two numbers a vertex.
        check(unsafe { raw::hf_geodesics_get_map(self.handle, centre, radius, out.as_mut_ptr(), std::ptr::null_mut()) })?;
        Ok(out)
    }
}

impl From<u32> for raw::hf_surface_point {
    fn from(vertex: u32) -> Self {
        Self { corners: [vertex; 3], barycentrics: [1.0, 0.0, 0.0], ..Default::default() }
    }
}

impl From<&raw::hf_hit> for raw::hf_surface_point {
    fn from(hit: &raw::hf_hit) -> Self {
        Self { corners: hit.corners, barycentrics: hit.barycentrics, ..Default::default() }
    }
}

object!(
    /// A smooth field of vectors, lines or crosses under constraints that come and go.
    Direction: hf_direction, hf_direction_destroy { vertex_count: usize }
);
impl Direction {
    /// A field without constraints.
    pub fn new(surface: &Surface, options: &DirectionOptions) -> Result<Self> {
        let (mut desc, mut handle) = (raw::hf_direction_desc::default(), std::ptr::null_mut());
        options.fill(&mut desc);
        // SAFETY: the handles are valid and `desc` is whole.
        check(unsafe { raw::hf_direction_create(surface.handle, &desc, &mut handle) })?;
        Ok(Direction { handle, vertex_count: surface.vertex_count })
    }

    /// A copy with its own constraints, on the same factor.
    pub fn try_clone(&self) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_direction_clone(self.handle, &mut handle) })?;
        Ok(Direction { handle, vertex_count: self.vertex_count })
    }

    figures! {
        /// What its edits and solves cost.
        statistics => hf_direction_get_statistics -> hf_direction_statistics;
    }

    /// Adds constraints: a vector (three numbers) at each vertex. Returns their numbers.
    pub fn add_sites(&mut self, vertices: &[u32], vectors: &[f64]) -> Result<Vec<u32>> {
        of_length(vectors, "vectors", 3 * vertices.len())?;
        let (count, mut out) = (count_of(vertices.len(), "vertices")?, vec![0; vertices.len()]);
        // SAFETY: the lengths are checked; `out` has one entry a constraint.
        check(unsafe { raw::hf_direction_add_sites(self.handle, count, start(vertices), start(vectors), out.as_mut_ptr()) })?;
        Ok(out)
    }

    /// Removes constraints by their numbers.
    pub fn remove_sites(&mut self, sites: &[u32]) -> Result<()> {
        // SAFETY: `sites` has as many entries as said.
        check(unsafe { raw::hf_direction_remove_sites(self.handle, count_of(sites.len(), "sites")?, start(sites)) })
    }

    /// Moves constraints to other vertices.
    pub fn move_sites(&mut self, sites: &[u32], vertices: &[u32]) -> Result<()> {
        of_length(vertices, "vertices", sites.len())?;
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_direction_move_sites(self.handle, count_of(sites.len(), "sites")?, start(sites), start(vertices)) })
    }

    /// Gives constraints other vectors.
    pub fn set_vectors(&mut self, sites: &[u32], vectors: &[f64]) -> Result<()> {
        of_length(vectors, "vectors", 3 * sites.len())?;
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_direction_set_vectors(self.handle, count_of(sites.len(), "sites")?, start(sites), start(vectors)) })
    }

    /// Turns constraints in their tangent planes, by radians.
    pub fn rotate_sites(&mut self, sites: &[u32], angles: &[f64]) -> Result<()> {
        of_length(angles, "angles", sites.len())?;
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_direction_rotate_sites(self.handle, count_of(sites.len(), "sites")?, start(sites), start(angles)) })
    }

    /// Constraints now.
    pub fn site_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_direction_get_site_count(self.handle) }
    }

    /// The numbers, vertices and vectors of the constraints.
    pub fn sites(&self) -> Result<(Vec<u32>, Vec<u32>, Vec<f64>)> {
        let n = self.site_count();
        let (mut sites, mut vertices) = (vec![0; n as usize], vec![0; n as usize]);
        let (mut vectors, mut count) = (vec![0.0; 3 * n as usize], 0);
        // SAFETY: all arrays have room for `n` constraints.
        check(unsafe {
            raw::hf_direction_get_sites(self.handle, n, sites.as_mut_ptr(), vertices.as_mut_ptr(), vectors.as_mut_ptr(), &mut count)
        })?;
        Ok((sites, vertices, vectors))
    }

    /// The field: a vector of length 1 at each vertex, three numbers each.
    pub fn solve(&self) -> Result<Vec<f64>> {
        let mut out = vec![0.0; 3 * self.vertex_count];
        // SAFETY: `out` has three numbers a vertex.
        check(unsafe { raw::hf_direction_solve_f64(self.handle, out.as_mut_ptr(), 0, std::ptr::null_mut()) })?;
        Ok(out)
    }

    /// Where the field turns about a point.
    pub fn singularities(&self) -> Result<Vec<raw::hf_singularity>> {
        // SAFETY: `list` passes room for as many entries as it says.
        list(|room, out, count| unsafe { raw::hf_direction_get_singularities(self.handle, room, out, count) })
    }
}

object!(
    /// A mesh of quads over a surface.
    Quads: hf_quads, hf_quads_destroy {}
);
/// What quads keep to. The default is the curvature alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuadGuides<'a> {
    /// two vertices each: edges of the surface that become edges of quads
    pub crease_edges: &'a [u32],
    /// where edges of quads follow a direction
    pub guide_vertices: &'a [u32],
    /// three numbers a guide, along the surface
    pub guide_vectors: &'a [f64],
    /// above 0 to 1 for each guide; `None`: all 1
    pub guide_weights: Option<&'a [f32]>,
    /// three numbers an irregular vertex: irregular vertices at places that the user drags
    pub irregular_points: &'a [f64],
    /// how many quads meet at each irregular vertex: 3 or 5
    pub irregular_valences: &'a [u32],
    /// three numbers an irregular vertex: one side of it runs along them, 0 0 0: any; `None`: any for all
    pub irregular_directions: Option<&'a [f64]>,
    /// a, b, c, d of the plane a x + b y + c z = d; `None`: no symmetry
    pub symmetry_plane: Option<[f64; 4]>,
}
/// Quads over a surface.
#[derive(Clone, Debug, Default)]
pub struct QuadMesh {
    /// three numbers a vertex
    pub positions: Vec<f64>,
    /// the vertices of each quad, counter-clockwise
    pub faces: Vec<[u32; 4]>,
}
impl Quads {
    /// The desc points into `guides`.
    fn desc_of(options: &QuadsOptions, guides: &QuadGuides) -> Result<raw::hf_quads_desc> {
        let mut desc = raw::hf_quads_desc::default();
        options.fill(&mut desc);
        desc.crease_count = rows_of(guides.crease_edges, 2, "crease_edges")?;
        desc.crease_edges = start(guides.crease_edges);
        let count = guides.guide_vertices.len();
        of_length(guides.guide_vectors, "guide_vectors", 3 * count)?;
        guides.guide_weights.map_or(Ok(()), |weights| of_length(weights, "guide_weights", count))?;
        (desc.guide_count, desc.guide_vertices) = (count_of(count, "guide_vertices")?, start(guides.guide_vertices));
        (desc.guide_vectors, desc.guide_weights) = (start(guides.guide_vectors), start_of(guides.guide_weights));
        let poles = guides.irregular_valences.len();
        of_length(guides.irregular_points, "irregular_points", 3 * poles)?;
        guides.irregular_directions.map_or(Ok(()), |all| of_length(all, "irregular_directions", 3 * poles))?;
        (desc.irregular_count, desc.irregular_valences) = (count_of(poles, "irregular_valences")?, start(guides.irregular_valences));
        (desc.irregular_points, desc.irregular_directions) = (start(guides.irregular_points), start_of(guides.irregular_directions));
        desc.symmetry_plane = guides.symmetry_plane.unwrap_or_default();
        Ok(desc)
    }

    /// Makes the mesh.
    pub fn new(surface: &Surface, options: &QuadsOptions, guides: &QuadGuides) -> Result<Self> {
        let (desc, mut handle) = (Self::desc_of(options, guides)?, std::ptr::null_mut());
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_quads_create(surface.handle, &desc, &mut handle) })?;
        Ok(Quads { handle })
    }

    /// Makes the mesh again: for strokes, creases and poles that the user drags. After an error it is what it was.
    pub fn update(&mut self, options: &QuadsOptions, guides: &QuadGuides) -> Result<()> {
        let desc = Self::desc_of(options, guides)?;
        // SAFETY: the lengths are checked.
        check(unsafe { raw::hf_quads_update(self.handle, &desc) })
    }

    figures! {
        /// Counts of the mesh.
        info => hf_quads_get_info -> hf_quads_info;
    }

    /// The mesh.
    pub fn mesh(&self) -> Result<QuadMesh> {
        let info = self.info()?;
        let (v, f) = (info.vertex_count, info.face_count);
        let mut out = QuadMesh { positions: vec![0.0; 3 * v as usize], faces: vec![[0; 4]; f as usize] };
        let mut mesh = raw::hf_quads_mesh {
            vertex_capacity: v,
            face_capacity: f,
            positions: out.positions.as_mut_ptr(),
            faces: out.faces.as_mut_ptr().cast(),
            ..Default::default()
        };
        // SAFETY: the arrays have room as `mesh` says; the others are null.
        check(unsafe { raw::hf_quads_get_mesh(self.handle, &mut mesh) })?;
        Ok(out)
    }
}

object!(
    /// Streamlines of fields on a surface.
    Flow: hf_flow, hf_flow_destroy { vertex_count: usize }
);
/// Lines along which a field rises. Line i has the points `starts[i]` to `starts[i + 1] - 1`.
#[derive(Clone, Debug, Default)]
pub struct Streamlines {
    /// three numbers a point
    pub positions: Vec<f64>,
    /// the field at each point
    pub values: Vec<f64>,
    /// one more than lines
    pub starts: Vec<u32>,
}
/// Points and lines that the first call has room for. More are found with a second call. Chosen so that the lines of
/// the examples fit at once; a point takes 32 bytes.
const FIRST_ROOM: (u32, u32) = (4096, 64);

impl Flow {
    /// Prepares a surface.
    pub fn new(surface: &Surface) -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_flow_create(surface.handle, &mut handle) })?;
        Ok(Flow { handle, vertex_count: surface.vertex_count })
    }

    /// `count` lines of equal flux from the minima, or one through each vertex of `seeds`.
    pub fn trace<P: Real>(&mut self, field: &[P], count: u32, seeds: Option<&[u32]>) -> Result<Streamlines> {
        of_length(field, "field", self.vertex_count)?;
        let (values, values_f64) = P::both(start(field));
        let scalars = raw::hf_scalars { values, values_f64, ..Default::default() };
        let (mut points, mut lines) = FIRST_ROOM;
        loop {
            let mut out = Streamlines {
                positions: vec![0.0; 3 * points as usize],
                values: vec![0.0; points as usize],
                starts: vec![0; lines as usize + 1],
            };
            let mut ends = vec![0u32; 2 * lines as usize];
            let mut found = raw::hf_streamlines {
                wanted_count: count,
                point_capacity: points,
                line_capacity: lines,
                positions: out.positions.as_mut_ptr(),
                values: out.values.as_mut_ptr(),
                line_starts: out.starts.as_mut_ptr(),
                line_ends: ends.as_mut_ptr(),
                ..Default::default()
            };
            if let Some(seeds) = seeds {
                (found.seed_count, found.seeds) = (count_of(seeds.len(), "seeds")?, start(seeds));
            }
            // SAFETY: the arrays have room as `found` says.
            let result = unsafe { raw::hf_flow_trace(self.handle, &scalars, &mut found) };
            if result == raw::HF_ERROR_TOO_SMALL && (found.point_count > points || found.line_count > lines) {
                (points, lines) = (found.point_count, found.line_count);
                continue;
            }
            check(result)?;
            out.positions.truncate(3 * found.point_count as usize);
            out.values.truncate(found.point_count as usize);
            out.starts.truncate(found.line_count as usize + 1);
            return Ok(out);
        }
    }
}

impl TryClone for Direction {
    fn try_clone(&self) -> Result<Self> {
        Direction::try_clone(self)
    }
}
