// Generated from include/hf/*.h by bindings/generate; do not edit.
//! The objects, their options and results.
#![allow(unused_mut, unused_variables, clippy::all)]
use crate::call::{object, start, whole, Call, Indices, Reals};
use crate::core::{check, Real, TryClone};
use crate::{raw, Error, Result};

/// A factor that `Surface::save` wrote. The surface loads it instead of computing it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Factor<'a> {
    /// all of them, as saved
    pub bytes: Option<&'a [u8]>,
}
impl<'a> Factor<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_factor_desc> {
        let mut desc = raw::hf_factor_desc { ..Default::default() };
        desc.bytes = self.bytes.map_or(std::ptr::null(), start).cast();
        desc.byte_count = self.bytes.map_or(0, <[u8]>::len);
        Ok(desc)
    }
}

/// Says which pieces to link. Joints and weights or tags help the automatic links; each array may be `None`. A light
/// piece is a sheet over a larger one, such as cloth: it follows the surface below and hardly pulls it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Links<'a> {
    /// `[vertex_count x influence_count]` of a skin: pieces of the same joint link sooner
    pub joints: Option<&'a [u16]>,
    /// `[vertex_count x influence_count]` of sum 1; where all are 0, a vertex shares no joint
    pub weights: Option<&'a [f32]>,
    /// `[joint_count]` parent of each joint, [`raw::HF_NO_INDEX`] for a root; needs joints and weights. Pieces of parent
    /// and child link wherever they touch. Pieces of joints farther apart in the skeleton, such as two feet, link only if
    /// nothing else joins them
    pub joint_parents: Option<&'a [u32]>,
    /// `[vertex_count]`: pieces with different tags do not link, as a rider and a horse. The first vertex of a piece
    /// counts
    pub tags: Option<&'a [u32]>,
    /// `[link_count]`
    pub links: Option<&'a [raw::hf_link]>,
    /// `[light_count]`: their pieces are light
    pub light_vertices: Option<&'a [u32]>,
    /// `[heavy_count]`: their pieces are not, as one that gets a site or handle
    pub heavy_vertices: Option<&'a [u32]>,
    /// `HF_LINK_*`
    pub mode: i32,
    /// longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal
    pub distance: f64,
    /// of all links, times each one's weight; 0 = 1
    pub stiffness: f64,
    /// automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of the diagonal, below 0:
    /// no piece is light unless light_vertices say so
    pub overlay_distance: f64,
}
impl<'a> Links<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "mode" => self.mode = whole(name, value, f64::MAX)?,
            "distance" => self.distance = value,
            "stiffness" => self.stiffness = value,
            "overlay_distance" => self.overlay_distance = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_links_desc> {
        let mut desc = raw::hf_links_desc { mode: self.mode, distance: self.distance, stiffness: self.stiffness,
            overlay_distance: self.overlay_distance, ..Default::default() };
        desc.joints = c.array(self.joints, "joints", &["vertex_count", &format!("{prefix}influence_count")])?;
        desc.weights = c.array(self.weights, "weights", &["vertex_count", &format!("{prefix}influence_count")])?;
        desc.joint_parents = c.array(self.joint_parents, "joint_parents", &[&format!("{prefix}joint_count")])?;
        desc.tags = c.array(self.tags, "tags", &["vertex_count"])?;
        desc.links = c.array(self.links, "links", &[&format!("{prefix}link_count")])?;
        desc.light_vertices = c.array(self.light_vertices, "light_vertices", &[&format!("{prefix}light_count")])?;
        desc.heavy_vertices = c.array(self.heavy_vertices, "heavy_vertices", &[&format!("{prefix}heavy_count")])?;
        desc.influence_count = c.count(&format!("{prefix}influence_count"), 0)?;
        desc.link_count = c.count(&format!("{prefix}link_count"), 0)?;
        desc.light_count = c.count(&format!("{prefix}light_count"), 0)?;
        desc.heavy_count = c.count(&format!("{prefix}heavy_count"), 0)?;
        desc.joint_count = c.count(&format!("{prefix}joint_count"), 0)?;
        Ok(desc)
    }
}

/// Faces of any number of corners. Set corners, and the arrays that your host stores: sizes alone (Maya, USD), starts and
/// sizes (Blender's loops), or starts alone as offsets (newer Blender). Where this interface names a triangle of such a
/// mesh, it names a face.
///
/// No field depends on how you would cut a face into triangles. [`raw::HF_OPERATOR_INTRINSIC_DELAUNAY`] takes the mean of
/// both cuts of a bent quad. It moves this mean towards the polygon Laplacian of Bunge and others 2020 until a weight
/// would become negative; docs/surfaces.md compares errors. [`raw::HF_OPERATOR_COTANGENT`] and
/// [`raw::HF_OPERATOR_CLAMPED`] use that polygon Laplacian. [`raw::HF_OPERATOR_UNIFORM`] uses the sides of the faces.
/// Directions, distances, iso-lines, streamlines and quads work on triangles: the library cuts the faces. Its cut does
/// not depend on the order of the corners. Normals of poses are sums of the area vectors of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Faces<'a> {
    /// `[corner_count]` of uint32_t: vertices, counter-clockwise seen from outside
    pub corners: Option<&'a [u32]>,
    /// `None`, or `[faces]` of uint32_t: corners of each face, 3 to 65,535. `None`: starts give them
    pub sizes: Option<&'a [u32]>,
    /// `None`, or `[faces]` of uint32_t: first corner of each face. `None`: the faces follow one another. Without sizes
    /// `[faces + 1]`: the corners of face f end where face f + 1 starts
    pub starts: Option<&'a [u32]>,
}
impl<'a> Faces<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_faces_desc> {
        let mut desc = raw::hf_faces_desc { ..Default::default() };
        desc.corners = c.view(self.corners.map(|v| Indices::U32(v).numbers()), "corners", &["corner_count"])?;
        desc.sizes = c.view(self.sizes.map(|v| Indices::U32(v).numbers()), "sizes", &["faces"])?;
        desc.starts = if self.sizes.is_none() { c.view(self.starts.map(|v| Indices::U32(v).numbers()), "starts",
            &["faces + 1"])? } else { c.view(self.starts.map(|v| Indices::U32(v).numbers()), "starts", &["faces"])? };
        Ok(desc)
    }
}

/// The mesh and the options of a surface. Set either triangles or faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceOptions<'a> {
    /// `HF_WELD_*`
    pub weld: i32,
    /// `None`, or faces instead of triangles
    pub faces: Option<Faces<'a>>,
    /// for [`raw::HF_WELD_TOLERANCE`], in the unit of the positions, > 0
    pub weld_tolerance: f64,
    /// `HF_OPERATOR_*`
    pub operator_kind: i32,
    /// `HF_FIELD_*`: the factor made now. Others are made when a solver or region needs one
    pub field_kind: i32,
    /// `HF_ORDERING_*`
    pub ordering: i32,
    /// threads the library may use, yours included, 1 to 256; 0 = 1
    pub thread_count: u32,
    /// refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices, triangles or edges are
    /// always refused
    pub vertex_limit: u32,
    /// refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the vertex limit
    pub triangle_limit: u32,
    /// refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
    pub memory_limit_mb: u32,
    /// refuse a factorisation of more than this many 10^9 operations. They are counted before it begins; 0 = 100,000,
    /// about an hour of one core
    pub work_limit_gflop: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
    /// `None`, or the saved factor of this mesh; ordering is then 0 or the factor's
    pub saved_factor: Option<Factor<'a>>,
    /// `None`: [`raw::HF_LINK_NONE`]. A saved factor needs the links it was made with
    pub links: Option<Links<'a>>,
}
impl<'a> SurfaceOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "weld" => self.weld = whole(name, value, f64::MAX)?,
            "weld_tolerance" => self.weld_tolerance = value,
            "operator_kind" => self.operator_kind = whole(name, value, f64::MAX)?,
            "field_kind" => self.field_kind = whole(name, value, f64::MAX)?,
            "ordering" => self.ordering = whole(name, value, f64::MAX)?,
            "thread_count" => self.thread_count = whole(name, value, f64::MAX)?,
            "vertex_limit" => self.vertex_limit = whole(name, value, f64::MAX)?,
            "triangle_limit" => self.triangle_limit = whole(name, value, f64::MAX)?,
            "memory_limit_mb" => self.memory_limit_mb = whole(name, value, f64::MAX)?,
            "work_limit_gflop" => self.work_limit_gflop = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, positions: Option<Reals<'_>>,
            triangles: Option<Indices<'_>>) -> Result<raw::hf_surface_desc> {
        let mut desc = raw::hf_surface_desc { weld: self.weld, weld_tolerance: self.weld_tolerance,
            operator_kind: self.operator_kind, field_kind: self.field_kind, ordering: self.ordering,
            thread_count: self.thread_count, vertex_limit: self.vertex_limit, triangle_limit: self.triangle_limit,
            memory_limit_mb: self.memory_limit_mb, work_limit_gflop: self.work_limit_gflop, ..Default::default() };
        desc.positions = c.view(positions.map(Reals::numbers), "positions", &["vertex_count", "3"])?;
        desc.triangles = c.view(triangles.map(Indices::numbers), "triangles", &["triangle_count", "3"])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        if let Some(inner) = &self.faces {
            let inner = inner.fill(c, "faces.")?;
            desc.faces = c.keep(inner);
        }
        if let Some(inner) = &self.saved_factor {
            let inner = inner.fill(c, "saved_factor.")?;
            desc.saved_factor = c.keep(inner);
        }
        if let Some(inner) = &self.links {
            let inner = inner.fill(c, "links.")?;
            desc.links = c.keep(inner);
        }
        Ok(desc)
    }
}

/// A graph of your own and the options of its surface: tetrahedra, points, a network. The weights w_ij of its edges make
/// the Laplacian (L u)_i = sum_j w_ij (u_i - u_j). Limits and hooks are as in [`SurfaceOptions`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GraphOptions<'a> {
    /// `None`, or `[vertex_count]` of float or double: M of [`raw::HF_FIELD_BIHARMONIC`], any unit, above 0 and up to
    /// 1e100; `None`: all 1. A mass below 1e-4 of the mean of its component is raised to it
    pub masses: Option<Reals<'a>>,
    /// >= 1, also without masses
    pub vertex_count: u32,
    /// 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of tetrahedra do. A field can
    /// then leave the range of its sites. 0: they are refused
    pub allow_negative: bool,
    /// `HF_FIELD_*`: the factor made now. Others are made when a solver asks
    pub field_kind: i32,
    /// `HF_ORDERING_*`
    pub ordering: i32,
    /// threads the library may use, yours included, 1 to 256; 0 = 1
    pub thread_count: u32,
    /// refuse larger graphs before allocating; 0 = 20,000,000
    pub vertex_limit: u32,
    /// refuse more edges; 0 = sixteen per vertex of the vertex limit
    pub edge_limit: u32,
    /// refuse to hold more memory than this, in MiB; 0 = no limit
    pub memory_limit_mb: u32,
    /// refuse a factorisation of more than this many 10^9 operations; 0 = 100,000
    pub work_limit_gflop: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
    /// `None`, or the saved factor of this graph; ordering is then 0 or the factor's
    pub saved_factor: Option<Factor<'a>>,
}
impl<'a> GraphOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "vertex_count" => self.vertex_count = whole(name, value, f64::MAX)?,
            "allow_negative" => self.allow_negative = whole::<u8>(name, value, 1.0)? == 1,
            "field_kind" => self.field_kind = whole(name, value, f64::MAX)?,
            "ordering" => self.ordering = whole(name, value, f64::MAX)?,
            "thread_count" => self.thread_count = whole(name, value, f64::MAX)?,
            "vertex_limit" => self.vertex_limit = whole(name, value, f64::MAX)?,
            "edge_limit" => self.edge_limit = whole(name, value, f64::MAX)?,
            "memory_limit_mb" => self.memory_limit_mb = whole(name, value, f64::MAX)?,
            "work_limit_gflop" => self.work_limit_gflop = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, edges: Option<Indices<'_>>,
            weights: Option<Reals<'_>>) -> Result<raw::hf_graph_desc> {
        let mut desc = raw::hf_graph_desc { vertex_count: self.vertex_count,
            allow_negative: i32::from(self.allow_negative), field_kind: self.field_kind, ordering: self.ordering,
            thread_count: self.thread_count, vertex_limit: self.vertex_limit, edge_limit: self.edge_limit,
            memory_limit_mb: self.memory_limit_mb, work_limit_gflop: self.work_limit_gflop, ..Default::default() };
        if self.vertex_count > 0 { c.learn("vertex_count", self.vertex_count as usize); }
        desc.edges = c.view(edges.map(Indices::numbers), "edges", &["edge_count", "2"])?;
        desc.weights = c.view(weights.map(Reals::numbers), "weights", &["edge_count"])?;
        desc.masses = c.view(self.masses.map(Reals::numbers), "masses", &["vertex_count"])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        if let Some(inner) = &self.saved_factor {
            let inner = inner.fill(c, "saved_factor.")?;
            desc.saved_factor = c.keep(inner);
        }
        Ok(desc)
    }
}

/// Lists triangles that go, vertices and triangles that come in, and edges to cut along. Vertices and triangles keep
/// their numbers; new ones follow those there are. New vertices are welded to no other, so two can lie at one place. A
/// vertex without a triangle is isolated from then on, and a new triangle can take it again.
///
/// A cut gives the vertices along it copies, and the triangles on one side take these. `Surface::cuts` lists the corners.
/// The end of a cut inside the surface stays one vertex, so a cut takes two edges there. A cut around a part, or from
/// border to border, parts it from the rest: it is a component then.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Patch<'a> {
    /// `[removed_triangle_count]` triangles of your mesh
    pub removed_triangles: Option<&'a [u32]>,
    /// `[new_vertex_count x 3]` in the unit of your mesh
    pub new_positions: Option<&'a [f64]>,
    /// `[new_triangle_count x 3]` vertices of your mesh and new ones
    pub new_triangles: Option<&'a [u32]>,
    /// `[cut_edge_count x 2]` the two vertices of an edge
    pub cut_edges: Option<&'a [u32]>,
}
impl<'a> Patch<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_patch_desc> {
        let mut desc = raw::hf_patch_desc { ..Default::default() };
        desc.removed_triangles = c.array(self.removed_triangles, "removed_triangles",
            &[&format!("{prefix}removed_triangle_count")])?;
        desc.new_positions = c.array(self.new_positions, "new_positions", &[&format!("{prefix}new_vertex_count"),
            "3"])?;
        desc.new_triangles = c.array(self.new_triangles, "new_triangles", &[&format!("{prefix}new_triangle_count"),
            "3"])?;
        desc.cut_edges = c.array(self.cut_edges, "cut_edges", &[&format!("{prefix}cut_edge_count"), "2"])?;
        desc.removed_triangle_count = c.count(&format!("{prefix}removed_triangle_count"), 0)?;
        desc.new_vertex_count = c.count(&format!("{prefix}new_vertex_count"), 0)?;
        desc.new_triangle_count = c.count(&format!("{prefix}new_triangle_count"), 0)?;
        desc.cut_edge_count = c.count(&format!("{prefix}cut_edge_count"), 0)?;
        Ok(desc)
    }
}

/// Lists the changes of `Surface::edit`: stiffness and links, or a patch. The stiffness of a vertex is a number by which
/// the weights of its edges are multiplied: an edge from i to j counts 2 s_i s_j / (s_i + s_j) times, as two springs in a
/// row. A region of large stiffness bends and stretches little and hardly changes its surroundings: a belt, a shield, a
/// shell. A region of small stiffness takes up the bending around it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceEdit<'a> {
    /// `[vertex_count]` as given; other vertices keep their stiffness. `None`: all vertices in order
    pub vertices: Option<&'a [u32]>,
    /// `[vertex_count]` 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. `None`: no stiffness changes,
    /// and vertex_count is 0
    pub stiffness: Option<&'a [f64]>,
    /// `[link_count]` links that come in, after those that stay
    pub links: Option<&'a [raw::hf_link]>,
    /// `[removed_link_count]` links that go out, by their numbers in `Surface::links`
    pub removed_links: Option<&'a [u32]>,
    /// `None`, or triangles that go and come, or a cut; the edit changes nothing else then
    pub patch: Option<Patch<'a>>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> SurfaceEdit<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_surface_edit_desc> {
        let mut desc = raw::hf_surface_edit_desc { ..Default::default() };
        desc.vertices = c.array(self.vertices, "vertices", &[&format!("{prefix}vertex_count")])?;
        desc.stiffness = c.array(self.stiffness, "stiffness", &[&format!("{prefix}vertex_count")])?;
        desc.links = c.array(self.links, "links", &[&format!("{prefix}link_count")])?;
        desc.removed_links = c.array(self.removed_links, "removed_links", &[&format!("{prefix}removed_link_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        if let Some(inner) = &self.patch {
            let inner = inner.fill(c, "patch.")?;
            desc.patch = c.keep(inner);
        }
        desc.vertex_count = c.count(&format!("{prefix}vertex_count"), 0)?;
        desc.link_count = c.count(&format!("{prefix}link_count"), 0)?;
        desc.removed_link_count = c.count(&format!("{prefix}removed_link_count"), 0)?;
        Ok(desc)
    }
}

/// Describes the line of a knife: points on the surface, each joined to the next by the shortest path along triangles.
/// Set one of vertices, places and points. A line whose last point is its first is closed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutOptions<'a> {
    /// `[point_count]` vertices of your mesh, or `None`
    pub vertices: Option<&'a [u32]>,
    /// `[point_count]`, or `None`
    pub places: Option<&'a [raw::hf_place]>,
    /// `[point_count x 3]` points in space, at rest, in the unit and frame of the mesh, or `None`. Each stands for the
    /// nearest point of the surface, up to two boxes away
    pub points: Option<&'a [f64]>,
    /// a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer to an edge than this
    /// share of the height moves onto the edge. So no slivers come in. From 1e-6 to 0.4; 0 = 0.05
    pub snap_share: f64,
    /// refuse a line of more points and crossings of edges; 0 = 1,000,000
    pub crossing_limit: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> CutOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "snap_share" => self.snap_share = value,
            "crossing_limit" => self.crossing_limit = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_cut_desc> {
        let mut desc = raw::hf_cut_desc { snap_share: self.snap_share, crossing_limit: self.crossing_limit,
            ..Default::default() };
        desc.vertices = c.array(self.vertices, "vertices", &[&format!("{prefix}point_count")])?;
        desc.places = c.array(self.places, "places", &[&format!("{prefix}point_count")])?;
        desc.points = c.array(self.points, "points", &[&format!("{prefix}point_count"), "3"])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.point_count = c.count(&format!("{prefix}point_count"), 0)?;
        Ok(desc)
    }
}

/// Options of picking: posed positions, if the surface is not at rest, and which triangles count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PickOptions<'a> {
    /// `None`, or `[vertex_count x 3]` of float or double: posed positions (Pose.deform writes them). `None`: the rest
    /// positions
    pub positions: Option<Reals<'a>>,
    /// 1: a ray passes through triangles seen from behind
    pub front_only: bool,
}
impl<'a> PickOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "front_only" => self.front_only = whole::<u8>(name, value, 1.0)? == 1,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_pick_desc> {
        let mut desc = raw::hf_pick_desc { front_only: i32::from(self.front_only), ..Default::default() };
        desc.positions = c.view(self.positions.map(Reals::numbers), "positions", &["vertex_count", "3"])?;
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolverOptions<'a> {
    /// `HF_FIELD_*`; if the surface has no factor of that kind yet, it is made now
    pub field_kind: i32,
    /// fields solved at once, 1 to 64; 0 = 1
    pub channel_count: u32,
    /// at most this many sites; 0 = 100,000
    pub site_limit: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> SolverOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "field_kind" => self.field_kind = whole(name, value, f64::MAX)?,
            "channel_count" => self.channel_count = whole(name, value, f64::MAX)?,
            "site_limit" => self.site_limit = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_solver_desc> {
        let mut desc = raw::hf_solver_desc { field_kind: self.field_kind, channel_count: self.channel_count,
            site_limit: self.site_limit, ..Default::default() };
        c.learn("channel_count", if self.channel_count == 0 { 1 } else { self.channel_count as usize });
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// Places and values of sites. Set one of vertices, places and points. The finer the mesh, the less influence a point
/// site has. Give the site a radius to avoid this: it then holds the field on a geodesic disc. A radius below the mesh
/// spacing still gives a point. A soft disc shares its stiffness among its vertices. For harmonic fields the boundary
/// vertices of a disc count towards site_limit; for bi-harmonic fields all its vertices do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sites<'a> {
    /// `[site_count]` vertices of your mesh, or `None`
    pub vertices: Option<&'a [u32]>,
    /// `[site_count x channel_count]`, up to 1e200 in size; `None` = 0
    pub values: Option<&'a [f64]>,
    /// `[site_count]`, or `None`
    pub places: Option<&'a [raw::hf_place]>,
    /// `[site_count x 3]` points in space, at rest, in the unit and frame of the mesh, or `None`. Each stands for the
    /// nearest point of the surface, up to two boxes away
    pub points: Option<&'a [f64]>,
    /// `[site_count]` >= 0, relative to the mean diagonal of K; 0 = hard (exact); `None` = all hard; clamped to 1e-12 to
    /// 1e12
    pub stiffness: Option<&'a [f64]>,
    /// `[site_count]` >= 0, geodesic, in the unit of the mesh; 0 = a point; `None` = all points
    pub radii: Option<&'a [f64]>,
}
impl<'a> Sites<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_sites_desc> {
        let mut desc = raw::hf_sites_desc { ..Default::default() };
        desc.vertices = c.array(self.vertices, "vertices", &[&format!("{prefix}site_count")])?;
        desc.places = c.array(self.places, "places", &[&format!("{prefix}site_count")])?;
        desc.points = c.array(self.points, "points", &[&format!("{prefix}site_count"), "3"])?;
        desc.values = c.array(self.values, "values", &[&format!("{prefix}site_count"), "channel_count"])?;
        desc.stiffness = c.array(self.stiffness, "stiffness", &[&format!("{prefix}site_count")])?;
        desc.radii = c.array(self.radii, "radii", &[&format!("{prefix}site_count")])?;
        desc.site_count = c.count(&format!("{prefix}site_count"), 1)?;
        Ok(desc)
    }
}

/// One batch of edits, applied in the order remove, move, set, add. A count of 0 skips its part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Edit<'a> {
    /// `[remove_count]`
    pub remove_sites: Option<&'a [u32]>,
    /// `[move_count]`
    pub move_sites: Option<&'a [u32]>,
    /// `[set_count]`
    pub set_sites: Option<&'a [u32]>,
    /// `[set_count x channel_count]`
    pub set_values: Option<&'a [f64]>,
    /// `None`, or places of `[move_count]` sites
    pub move_to: Option<Sites<'a>>,
    /// `None`, or the sites to add
    pub add: Option<Sites<'a>>,
}
impl<'a> Edit<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_edit_desc> {
        let mut desc = raw::hf_edit_desc { ..Default::default() };
        desc.remove_sites = c.array(self.remove_sites, "remove_sites", &[&format!("{prefix}remove_count")])?;
        desc.move_sites = c.array(self.move_sites, "move_sites", &[&format!("{prefix}move_count")])?;
        desc.set_sites = c.array(self.set_sites, "set_sites", &[&format!("{prefix}set_count")])?;
        desc.set_values = c.array(self.set_values, "set_values", &[&format!("{prefix}set_count"), "channel_count"])?;
        if let Some(inner) = &self.move_to {
            let inner = inner.fill(c, "move_to.")?;
            desc.move_to = c.keep(inner);
        }
        if let Some(inner) = &self.add {
            let inner = inner.fill(c, "add.")?;
            desc.add = c.keep(inner);
        }
        desc.remove_count = c.count(&format!("{prefix}remove_count"), 0)?;
        desc.move_count = c.count(&format!("{prefix}move_count"), 0)?;
        desc.set_count = c.count(&format!("{prefix}set_count"), 0)?;
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GeodesicsOptions<'a> {
    /// `HF_GEODESICS_*`
    pub method: i32,
    /// of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to 10,000; 0 = 1
    pub smoothing: f64,
    /// `None`, or an object to poll and cancel through: creation and every later call report to it
    pub progress: Option<&'a Progress>,
}
impl<'a> GeodesicsOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "method" => self.method = whole(name, value, f64::MAX)?,
            "smoothing" => self.smoothing = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_geodesics_desc> {
        let mut desc = raw::hf_geodesics_desc { method: self.method, smoothing: self.smoothing, ..Default::default() };
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExtremitiesOptions<'a> {
    /// `HF_EXTREMITIES_*`
    pub kind: i32,
    /// tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10
    pub least_length_share: f64,
    /// sources of the mean distance per component, 1 to 1,000; 0 = 40
    pub source_count: u32,
    /// for [`raw::HF_EXTREMITIES_GEODESIC`]: an object of this surface. If its method is [`raw::HF_GEODESICS_HEAT`] its
    /// factor serves; else, and for `None`, the call makes a factor
    pub geodesics: Option<&'a Geodesics>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> ExtremitiesOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "kind" => self.kind = whole(name, value, f64::MAX)?,
            "least_length_share" => self.least_length_share = value,
            "source_count" => self.source_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_extremities_desc> {
        let mut desc = raw::hf_extremities_desc { kind: self.kind, least_length_share: self.least_length_share,
            source_count: self.source_count, ..Default::default() };
        c.learn("source_count", if self.source_count == 0 { 40 } else { self.source_count as usize });
        desc.geodesics = self.geodesics.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectionOptions<'a> {
    /// 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
    pub degree: u32,
    /// most constraints; 0 = 100,000
    pub site_limit: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> DirectionOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "degree" => self.degree = whole(name, value, f64::MAX)?,
            "site_limit" => self.site_limit = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_direction_desc> {
        let mut desc = raw::hf_direction_desc { degree: self.degree, site_limit: self.site_limit,
            ..Default::default() };
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseOptions {
    /// bands per field, 2 to 64; 0 = 10
    pub band_count: u32,
    /// iterations of a pose solve, 1 to 1000; 0 = 10
    pub iteration_count: u32,
    /// groups of vertices that share a rotation, 1 to 2000; 0 = 250
    pub group_count: u32,
}
impl PoseOptions {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "band_count" => self.band_count = whole(name, value, f64::MAX)?,
            "iteration_count" => self.iteration_count = whole(name, value, f64::MAX)?,
            "group_count" => self.group_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_pose_desc> {
        let mut desc = raw::hf_pose_desc { band_count: self.band_count, iteration_count: self.iteration_count,
            group_count: self.group_count, ..Default::default() };
        Ok(desc)
    }
}

/// The handles to add. Set region_counts and region_vertices, or radii and one of vertices, places and points. The region
/// of a place is its nearest vertex, and all vertices that are edge-connected to it within the radius.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandlesOptions<'a> {
    /// `[handle_count]` vertices of your mesh, or `None`
    pub vertices: Option<&'a [u32]>,
    /// `[handle_count]`, or `None`
    pub places: Option<&'a [raw::hf_place]>,
    /// `[handle_count x 3]` points in space, at rest, in the unit and frame of the mesh, or `None`. A point can lie
    /// inside the body, as a joint does: its nearest vertex counts
    pub points: Option<&'a [f64]>,
    /// `[handle_count]` of the regions of places, in the unit of the mesh; `None`: regions are given. A radius below 1 %
    /// of the box makes regions of 2 vertices or more
    pub radii: Option<&'a [f64]>,
    /// 0 to HF_LAYER_COUNT - 1, for the whole batch
    pub layer: u32,
    /// 1: handles of layer 0 start on the posed surface, not at rest; see below
    pub in_place: bool,
    /// 1: you give the places alone of all these handles; `Pose::set_free_rotations` frees single ones
    pub free_rotation: bool,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> HandlesOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "layer" => self.layer = whole(name, value, f64::MAX)?,
            "in_place" => self.in_place = whole::<u8>(name, value, 1.0)? == 1,
            "free_rotation" => self.free_rotation = whole::<u8>(name, value, 1.0)? == 1,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str,
            region_vertices: Option<&[&[u32]]>) -> Result<raw::hf_handles_desc> {
        let mut desc = raw::hf_handles_desc { layer: self.layer, in_place: i32::from(self.in_place),
            free_rotation: i32::from(self.free_rotation), ..Default::default() };
        (desc.region_counts, desc.region_vertices) = c.lists(region_vertices, "region_vertices",
            &[&format!("{prefix}handle_count")])?;
        desc.vertices = c.array(self.vertices, "vertices", &[&format!("{prefix}handle_count")])?;
        desc.places = c.array(self.places, "places", &[&format!("{prefix}handle_count")])?;
        desc.points = c.array(self.points, "points", &[&format!("{prefix}handle_count"), "3"])?;
        desc.radii = c.array(self.radii, "radii", &[&format!("{prefix}handle_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.handle_count = c.count(&format!("{prefix}handle_count"), 1)?;
        Ok(desc)
    }
}

/// The options of `Pose::deform` are outputs and a range of vertices. Set at least one output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeformOptions {
    /// 1 to 1000; 0 = the pose's
    pub iteration_count: u32,
    /// 1: forget the last pose and start from the fields. The frame then has the bits of a fresh pose with the same
    /// handles, added in the same order, and the same transforms. Without restart a frame continues from the last
    /// one, so it also depends on that
    pub restart: bool,
    /// 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes about 0.2 us per
    /// vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get sharper
    pub refine: i32,
    /// 1: the steps go on from the surface of the last call, instead of starting at the smooth pose. Then one step a
    /// frame keeps lengths in a drag as well as 8 do without. If the handles do not move, more calls converge to the
    /// minimum. A restart, or a call without it, forgets that surface. Needs a refine of 1 or more. Higher layers
    /// start at the smooth pose. Memory: 72 bytes per vertex
    pub refine_from_last: bool,
    /// outputs hold vertex_count vertices from this one on; 0 and 0: all
    pub first_vertex: u32,
    /// positions of a range cost only the range; but with higher layers, rigid pieces, refine, limb_refine or normals
    /// they cost the whole surface
    pub vertex_count: u32,
}
impl DeformOptions {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "iteration_count" => self.iteration_count = whole(name, value, f64::MAX)?,
            "restart" => self.restart = whole::<u8>(name, value, 1.0)? == 1,
            "refine" => self.refine = whole(name, value, f64::MAX)?,
            "refine_from_last" => self.refine_from_last = whole::<u8>(name, value, 1.0)? == 1,
            "first_vertex" => self.first_vertex = whole(name, value, f64::MAX)?,
            "vertex_count" => self.vertex_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_deform_desc> {
        let mut desc = raw::hf_deform_desc { iteration_count: self.iteration_count, restart: i32::from(self.restart),
            refine: self.refine, refine_from_last: i32::from(self.refine_from_last), first_vertex: self.first_vertex,
            vertex_count: self.vertex_count, ..Default::default() };
        if self.vertex_count > 0 { c.learn("vertex_count", self.vertex_count as usize); }
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandleProposalsOptions<'a> {
    /// `[joint_count x 3]` their places at rest, in the unit and frame of the mesh
    pub joints: Option<&'a [f64]>,
    /// `[joint_count]` position of each joint's parent in the list; [`raw::HF_NO_INDEX`] for a root
    pub parents: Option<&'a [u32]>,
    /// `None`, or the skeleton of the mesh, instead of joints and parents. It rests in the unit and frame of the mesh. If
    /// it has a skin, the skin has the vertices of the mesh
    pub skeleton: Option<&'a Skeleton>,
    /// direction away from the ground, of any length; zero = up of the skeleton where it is known, else the y axis
    pub up: Option<[f64; 3]>,
    /// as in [`ExtremitiesOptions`]; 0 = 0.05
    pub least_length_share: f64,
    /// most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32
    pub limit: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> HandleProposalsOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "least_length_share" => self.least_length_share = value,
            "limit" => self.limit = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_handle_proposals_desc> {
        let mut desc = raw::hf_handle_proposals_desc { least_length_share: self.least_length_share, limit: self.limit,
            ..Default::default() };
        desc.joints = c.array(self.joints, "joints", &[&format!("{prefix}joint_count"), "3"])?;
        desc.parents = c.array(self.parents, "parents", &[&format!("{prefix}joint_count")])?;
        if let Some(given) = self.up { desc.up = given; }
        desc.skeleton = self.skeleton.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.joint_count = c.count(&format!("{prefix}joint_count"), 0)?;
        Ok(desc)
    }
}

/// Options of a quad mesh. HF_INIT gives quads along the curvature, with edges of 0.022 box diagonals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QuadsOptions<'a> {
    /// `[crease_count x 2]` the two vertices of each edge, of your mesh
    pub crease_edges: Option<&'a [u32]>,
    /// `[guide_count]` vertices of your mesh; guides of one vertex are averaged
    pub guide_vertices: Option<&'a [u32]>,
    /// `[guide_count x 3]` along the surface, of any length above 0; quads run along the vector and across it
    pub guide_vectors: Option<&'a [f64]>,
    /// `None` = all 1, or `[guide_count]`, above 0 to 1: 1 holds the direction. A smaller weight mixes it with the
    /// direction of the curvature, which has the rest of the weight
    pub guide_weights: Option<&'a [f32]>,
    /// `[irregular_count x 3]` at the surface, in the unit and frame of the mesh
    pub irregular_points: Option<&'a [f64]>,
    /// `[irregular_count]` how many quads meet there: 3 or 5
    pub irregular_valences: Option<&'a [u32]>,
    /// `None` = any, or `[irregular_count x 3]`: one side of the irregular vertex runs along it; 0 0 0 = any
    pub irregular_directions: Option<&'a [f64]>,
    /// wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
    pub face_count: u32,
    /// wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
    pub edge_length: f64,
    /// edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 = none.  If there
    /// are more than 1,024 lines of creases and borders, only the longest are kept. Creases nearer to each other than an
    /// edge may be released
    pub crease_angle: f64,
    /// rounds of tangential relaxation, up to 1,000; 0 = 60; [`raw::HF_NO_INDEX`] = none, and the mesh is not fitted to
    /// the surface either
    pub relax_count: u32,
    /// a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads are made of the
    /// side that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the other side are not used
    pub symmetry_plane: Option<[f64; 4]>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> QuadsOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "face_count" => self.face_count = whole(name, value, f64::MAX)?,
            "edge_length" => self.edge_length = value,
            "crease_angle" => self.crease_angle = value,
            "relax_count" => self.relax_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_quads_desc> {
        let mut desc = raw::hf_quads_desc { face_count: self.face_count, edge_length: self.edge_length,
            crease_angle: self.crease_angle, relax_count: self.relax_count, ..Default::default() };
        desc.crease_edges = c.array(self.crease_edges, "crease_edges", &[&format!("{prefix}crease_count"), "2"])?;
        desc.guide_vertices = c.array(self.guide_vertices, "guide_vertices", &[&format!("{prefix}guide_count")])?;
        desc.guide_vectors = c.array(self.guide_vectors, "guide_vectors", &[&format!("{prefix}guide_count"), "3"])?;
        desc.guide_weights = c.array(self.guide_weights, "guide_weights", &[&format!("{prefix}guide_count")])?;
        desc.irregular_points = c.array(self.irregular_points, "irregular_points",
            &[&format!("{prefix}irregular_count"), "3"])?;
        desc.irregular_valences = c.array(self.irregular_valences, "irregular_valences",
            &[&format!("{prefix}irregular_count")])?;
        desc.irregular_directions = c.array(self.irregular_directions, "irregular_directions",
            &[&format!("{prefix}irregular_count"), "3"])?;
        if let Some(given) = self.symmetry_plane { desc.symmetry_plane = given; }
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.crease_count = c.count(&format!("{prefix}crease_count"), 0)?;
        desc.guide_count = c.count(&format!("{prefix}guide_count"), 0)?;
        desc.irregular_count = c.count(&format!("{prefix}irregular_count"), 0)?;
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionOptions<'a> {
    /// `None`, or `[vertex_count x 3]` of float or double: positions of the mesh or of a pose. A morph of weight 0 writes
    /// the same bits. `None`: the positions of the mesh, to 1e-15 of the box. The call copies the array
    pub positions: Option<Reals<'a>>,
    /// `HF_BASE_*`. If the surface has no factor for it yet, it is made now
    pub base: i32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> RegionOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "base" => self.base = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_region_desc> {
        let mut desc = raw::hf_region_desc { base: self.base, ..Default::default() };
        desc.positions = c.view(self.positions.map(Reals::numbers), "positions", &["vertex_count", "3"])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// Describes a closed curve through at least 3 points, on the mesh at rest. Set one of vertices, places and points. The
/// vertices on the chosen side of the curve are the region. A single vertex joins the region too if all its neighbours
/// but one are in it. The rim is the vertices next to the region, on or beyond the curve. It follows the curve within an
/// edge; where the curve runs along edges, the rim is the curve. A whole border of the surface is a curve too; it has
/// only one side. The curve passes a vertex at most 8 times.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curve<'a> {
    /// `[point_count]` vertices of your mesh, or `None`
    pub vertices: Option<&'a [u32]>,
    /// `[point_count]`, or `None`
    pub places: Option<&'a [raw::hf_place]>,
    /// `[point_count x 3]` points in space, at rest, in the unit and frame of the mesh, or `None`. Each stands for the
    /// nearest point of the surface, up to two boxes away
    pub points: Option<&'a [f64]>,
    /// `HF_SIDE_*`
    pub side: i32,
    /// with [`raw::HF_SIDE_SEED`]
    pub seed_vertex: u32,
    /// `HF_CURVE_*`
    pub kind: i32,
}
impl<'a> Curve<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "side" => self.side = whole(name, value, f64::MAX)?,
            "seed_vertex" => self.seed_vertex = whole(name, value, f64::MAX)?,
            "kind" => self.kind = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_curve_desc> {
        let mut desc = raw::hf_curve_desc { side: self.side, seed_vertex: self.seed_vertex, kind: self.kind,
            ..Default::default() };
        desc.vertices = c.array(self.vertices, "vertices", &[&format!("{prefix}point_count")])?;
        desc.places = c.array(self.places, "places", &[&format!("{prefix}point_count")])?;
        desc.points = c.array(self.points, "points", &[&format!("{prefix}point_count"), "3"])?;
        desc.point_count = c.count(&format!("{prefix}point_count"), 0)?;
        Ok(desc)
    }
}

/// A change of a region. The parts are applied in the order curve, rings, remove, add. A part that is 0 or `None` is
/// skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionEditOptions<'a> {
    /// `[remove_count]` vertices that leave the region; others are passed over
    pub remove_vertices: Option<&'a [u32]>,
    /// `[add_count]` vertices that join it; those in it already are passed over
    pub add_vertices: Option<&'a [u32]>,
    /// rings of vertices by which the region grows; below 0 it shrinks
    pub ring_count: i32,
    /// the region becomes what this curve encloses
    pub curve: Option<Curve<'a>>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> RegionEditOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "ring_count" => self.ring_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_region_edit_desc> {
        let mut desc = raw::hf_region_edit_desc { ring_count: self.ring_count, ..Default::default() };
        desc.remove_vertices = c.array(self.remove_vertices, "remove_vertices", &[&format!("{prefix}remove_count")])?;
        desc.add_vertices = c.array(self.add_vertices, "add_vertices", &[&format!("{prefix}add_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        if let Some(inner) = &self.curve {
            let inner = inner.fill(c, "curve.")?;
            desc.curve = c.keep(inner);
        }
        desc.remove_count = c.count(&format!("{prefix}remove_count"), 0)?;
        desc.add_count = c.count(&format!("{prefix}add_count"), 0)?;
        Ok(desc)
    }
}

/// Gives `Region::morph` and `Detail::morph` their weight and outputs. Set at least one output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct MorphOptions {
}
impl MorphOptions {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, weight: f64) -> Result<raw::hf_morph_desc> {
        let mut desc = raw::hf_morph_desc { weight: weight, ..Default::default() };
        Ok(desc)
    }
}

/// As the header says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DetailOptions<'a> {
    /// `[pair_count]` rim vertices of the source mesh
    pub source_vertices: Option<&'a [u32]>,
    /// `[pair_count]` rim vertices of the target mesh
    pub target_vertices: Option<&'a [u32]>,
    /// of the detail, > 0; 0 = square root of target base area over source base area
    pub scale: f64,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> DetailOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "scale" => self.scale = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_detail_desc> {
        let mut desc = raw::hf_detail_desc { scale: self.scale, ..Default::default() };
        desc.source_vertices = c.array(self.source_vertices, "source_vertices", &[&format!("{prefix}pair_count")])?;
        desc.target_vertices = c.array(self.target_vertices, "target_vertices", &[&format!("{prefix}pair_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.pair_count = c.count(&format!("{prefix}pair_count"), 0)?;
        Ok(desc)
    }
}

/// Options of a retarget. `None` in `Retarget::new` gives the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RetargetOptions<'a> {
    /// `[source.joint_count x 10]` a pose that counts as rest, or `None`: the rest of the skeleton. Give poses in which
    /// both characters stand alike
    pub source_rest: Option<&'a [f32]>,
    /// `[target.joint_count x 10]` the same for the target, or `None`
    pub target_rest: Option<&'a [f32]>,
    /// `HF_ROOT_MOTION_*`
    pub root_motion: i32,
    /// bits of `HF_RETARGET_*`
    pub leave_out: u32,
    /// travel of the target over travel of the source; 0: the ratio of leg lengths
    pub scale: f64,
    /// of the ground under a clip on the spot, in the space of the source, per second; 0: the ground rests.
    /// `Skeleton::ground_velocity` finds it
    pub ground_velocity: Option<[f64; 3]>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> RetargetOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "root_motion" => self.root_motion = whole(name, value, f64::MAX)?,
            "leave_out" => self.leave_out = whole(name, value, f64::MAX)?,
            "scale" => self.scale = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_retarget_desc> {
        let mut desc = raw::hf_retarget_desc { root_motion: self.root_motion, leave_out: self.leave_out,
            scale: self.scale, ..Default::default() };
        desc.source_rest = c.array(self.source_rest, "source_rest", &["source.joint_count", "10"])?;
        desc.target_rest = c.array(self.target_rest, "target_rest", &["target.joint_count", "10"])?;
        if let Some(given) = self.ground_velocity { desc.ground_velocity = given; }
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        Ok(desc)
    }
}

/// The skin of a character: its surface, and the joints of each vertex. These are the arrays of a glTF skin as the file
/// has them: with inverse_binds the library moves the surface from the pose of binding to the pose `rest`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Skin<'a> {
    /// `[vertex_count x 3]`
    pub positions: Option<&'a [f32]>,
    /// `[triangle_count x 3]`, or `None` with triangle_count 0
    pub triangles: Option<&'a [u32]>,
    /// `[vertex_count x influence_count]`
    pub joints: Option<&'a [u32]>,
    /// `[vertex_count x influence_count]` >= 0; a vertex whose weights are all 0 has no joint
    pub weights: Option<&'a [f32]>,
    /// 1: positions are in the pose `rest` and in the space of the joints, also with inverse_binds. 0: in the pose of
    /// inverse_binds if there are any
    pub at_rest: bool,
}
impl<'a> Skin<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "at_rest" => self.at_rest = whole::<u8>(name, value, 1.0)? == 1,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_skin_desc> {
        let mut desc = raw::hf_skin_desc { at_rest: i32::from(self.at_rest), ..Default::default() };
        desc.positions = c.array(self.positions, "positions", &[&format!("{prefix}vertex_count"), "3"])?;
        desc.triangles = c.array(self.triangles, "triangles", &[&format!("{prefix}triangle_count"), "3"])?;
        desc.joints = c.array(self.joints, "joints", &[&format!("{prefix}vertex_count"),
            &format!("{prefix}influence_count")])?;
        desc.weights = c.array(self.weights, "weights", &[&format!("{prefix}vertex_count"),
            &format!("{prefix}influence_count")])?;
        desc.vertex_count = c.count(&format!("{prefix}vertex_count"), 0)?;
        desc.triangle_count = c.count(&format!("{prefix}triangle_count"), 0)?;
        desc.influence_count = c.count(&format!("{prefix}influence_count"), 0)?;
        Ok(desc)
    }
}

/// The joints of a character at rest. A joint transform is 10 numbers relative to the parent: translation x y z, rotation
/// x y z w, scale x y z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkeletonOptions<'a> {
    /// `[joint_count x 16]` inverse bind matrices, columns first. All zero: no skin names the joint; it moves its
    /// children and rigid meshes only. `None`: the skin is given in the pose `rest`, and every joint can bend it
    pub inverse_binds: Option<&'a [f32]>,
    /// `[3]` declared axis, any length, or `None`: find it
    pub up: Option<&'a [f32]>,
    /// `[3]` declared axis, any length, or `None`: find it
    pub forward: Option<&'a [f32]>,
    /// `[joint_count]` declared `HF_ROLE_*`, -1 for a joint without; or `None`
    pub roles: Option<&'a [i32]>,
    /// `[joint_count]` `HF_SIDE_*` of joints with a declared role; or `None`: find the sides
    pub sides: Option<&'a [i32]>,
    /// `[travel_count x 3]` where each clip leads from its first to its last frame; it tells forward; or `None`
    pub travels: Option<&'a [f32]>,
    /// `None`: there is none, and joints are judged by names and places alone
    pub skin: Option<Skin<'a>>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> SkeletonOptions<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, names: Option<&[&str]>, parents: Option<&[u32]>,
            rest: Option<&[f32]>) -> Result<raw::hf_skeleton_desc> {
        let mut desc = raw::hf_skeleton_desc { ..Default::default() };
        desc.parents = c.array(parents, "parents", &[&format!("{prefix}joint_count")])?;
        desc.rest = c.array(rest, "rest", &[&format!("{prefix}joint_count"), "10"])?;
        desc.inverse_binds = c.array(self.inverse_binds, "inverse_binds", &[&format!("{prefix}joint_count"), "16"])?;
        desc.up = c.array(self.up, "up", &["3"])?;
        desc.forward = c.array(self.forward, "forward", &["3"])?;
        desc.roles = c.array(self.roles, "roles", &[&format!("{prefix}joint_count")])?;
        desc.sides = c.array(self.sides, "sides", &[&format!("{prefix}joint_count")])?;
        desc.travels = c.array(self.travels, "travels", &[&format!("{prefix}travel_count"), "3"])?;
        desc.names = c.text(names)?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        if let Some(inner) = &self.skin {
            let inner = inner.fill(c, "skin.")?;
            desc.skin = c.keep(inner);
        }
        desc.joint_count = c.count(&format!("{prefix}joint_count"), 0)?;
        desc.travel_count = c.count(&format!("{prefix}travel_count"), 0)?;
        Ok(desc)
    }
}

/// most pairs of a transfer
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransferOptions<'a> {
    /// `None`, or `[source.vertex_count x 3]` of float or double Poses in which the two bodies correspond, in each
    /// surface's unit. `None`: the positions of the surface. Give a standing pose here for a character bound in a crouch.
    /// Motion is measured from these poses. They do not change the fields.
    pub source_rest: Option<Reals<'a>>,
    /// `None`, or `[target.vertex_count x 3]` of float or double
    pub target_rest: Option<Reals<'a>>,
    /// `HF_TRANSFER_*`
    pub mode: i32,
    /// 1 to 512. 0 = the larger of 80 and 5 per pair
    pub cluster_count: u32,
    /// `HF_GROUND_*`
    pub ground: i32,
    /// width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per pair, up to 0.12
    pub kernel_width: f64,
    /// lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes when no pair
    /// is a foot
    pub scale: f64,
    /// A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6 times the angle it is not
    /// aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative = never.
    pub alignment_angle: f64,
    /// Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y, forward +z). Lengths,
    /// and right x up = forward, must hold within 1e-3. The library takes the nearest rotation.
    pub source_axes: Option<[f64; 9]>,
    /// As the header says.
    pub target_axes: Option<[f64; 9]>,
}
impl<'a> TransferOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "mode" => self.mode = whole(name, value, f64::MAX)?,
            "cluster_count" => self.cluster_count = whole(name, value, f64::MAX)?,
            "ground" => self.ground = whole(name, value, f64::MAX)?,
            "kernel_width" => self.kernel_width = value,
            "scale" => self.scale = value,
            "alignment_angle" => self.alignment_angle = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_transfer_desc> {
        let mut desc = raw::hf_transfer_desc { mode: self.mode, cluster_count: self.cluster_count, ground: self.ground,
            kernel_width: self.kernel_width, scale: self.scale, alignment_angle: self.alignment_angle,
            ..Default::default() };
        desc.source_rest = c.view(self.source_rest.map(Reals::numbers), "source_rest", &["source.vertex_count", "3"])?;
        desc.target_rest = c.view(self.target_rest.map(Reals::numbers), "target_rest", &["target.vertex_count", "3"])?;
        if let Some(given) = self.source_axes { desc.source_axes = given; }
        if let Some(given) = self.target_axes { desc.target_axes = given; }
        Ok(desc)
    }
}

/// The pairs to add. The regions of each surface are vertex lists, one after the other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pairs<'a> {
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> Pairs<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, source_vertices: Option<&[&[u32]]>,
            target_vertices: Option<&[&[u32]]>, flags: Option<&[u32]>) -> Result<raw::hf_pairs_desc> {
        let mut desc = raw::hf_pairs_desc { ..Default::default() };
        (desc.source_counts, desc.source_vertices) = c.lists(source_vertices, "source_vertices",
            &[&format!("{prefix}pair_count")])?;
        (desc.target_counts, desc.target_vertices) = c.lists(target_vertices, "target_vertices",
            &[&format!("{prefix}pair_count")])?;
        desc.flags = c.array(flags, "flags", &[&format!("{prefix}pair_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.pair_count = c.count(&format!("{prefix}pair_count"), 1)?;
        Ok(desc)
    }
}

/// Dials that an animator turns while a transfer plays. Neutral dials give the bits of a transfer without dials, and the
/// result is continuous in each dial.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransferDials {
    /// the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A planted foot does
    /// not slide. The body travels as much farther
    pub stride: f64,
    /// raises the pairs flagged [`raw::HF_PAIR_TRUNK`] and [`raw::HF_PAIR_ANCHOR`] by this share of their mean height at
    /// rest, -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised
    pub hip_height_share: f64,
    /// pairs flagged [`raw::HF_PAIR_NECK`], together one limb How far a limb follows the source, -1 to 1. At 0 (neutral)
    /// the limb plays the source's motion from its own rest direction. At 1 it also gets the rest direction of the
    /// source's limb. At -1 it does not move against its root.
    pub neck_follow: f64,
    /// pairs flagged [`raw::HF_PAIR_TAIL`], together one limb
    pub tail_follow: f64,
    /// turns arms ([`raw::HF_PAIR_ARM`]) away from the body, about the forward axis at rest, -pi/2 to pi/2 radians; 0 =
    /// neutral
    pub arm_space: f64,
    /// how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less, so that they move
    /// as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn against the part before it
    pub long_follow: f64,
}
impl TransferDials {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "stride" => self.stride = value,
            "hip_height_share" => self.hip_height_share = value,
            "neck_follow" => self.neck_follow = value,
            "tail_follow" => self.tail_follow = value,
            "arm_space" => self.arm_space = value,
            "long_follow" => self.long_follow = value,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_transfer_dials> {
        let mut desc = raw::hf_transfer_dials { stride: self.stride, hip_height_share: self.hip_height_share,
            neck_follow: self.neck_follow, tail_follow: self.tail_follow, arm_space: self.arm_space,
            long_follow: self.long_follow, ..Default::default() };
        Ok(desc)
    }
}

/// Describes one frame: the input is the posed source, the output the posed target. Set at least one output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransferFrame<'a> {
    /// `[hold_count]` each pair at most once A hold puts the target region of a pair exactly at a position of yours, such
    /// as a foot on a step or a hand on a rail. The mean of the region's vertices lands there; welded copies count once.
    /// The rest of the surface follows.
    pub hold_pairs: Option<&'a [u32]>,
    /// `[hold_count x 3]` in the target's unit and frame
    pub hold_positions: Option<&'a [f64]>,
}
impl<'a> TransferFrame<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str,
            source_positions: Option<Reals<'_>>) -> Result<raw::hf_transfer_frame> {
        let mut desc = raw::hf_transfer_frame { ..Default::default() };
        desc.source_positions = c.view(source_positions.map(Reals::numbers), "source_positions",
            &["source.vertex_count", "3"])?;
        desc.hold_pairs = c.array(self.hold_pairs, "hold_pairs", &[&format!("{prefix}hold_count")])?;
        desc.hold_positions = c.array(self.hold_positions, "hold_positions", &[&format!("{prefix}hold_count"), "3"])?;
        desc.hold_count = c.count(&format!("{prefix}hold_count"), 0)?;
        Ok(desc)
    }
}

/// The joints of a skeleton, in the unit and frame of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Joints<'a> {
    /// `[joint_count x 3]`
    pub heads: Option<&'a [f64]>,
    /// `[joint_count x 3]`, or `None`: heads are joints, and the library finds the tails
    pub tails: Option<&'a [f64]>,
    /// `[joint_count x 3]` with tails `None`: where each joint points, any length, a zero vector for unknown; or `None`.
    /// A joint reaches to the child that lies there, or to the end of the skin. A      child that does      not deform
    /// says where a last joint ends
    pub axes: Option<&'a [f64]>,
    /// `[joint_count]` number of the parent, [`raw::HF_NO_INDEX`] for a root; `None`: all are roots
    pub parents: Option<&'a [u32]>,
    /// `[joint_count]` 1: the joint gets weights; `None`: all do
    pub deforms: Option<&'a [i32]>,
    /// `[joint_count]` for `Weights::set_joints`: the number that the joint had before, [`raw::HF_NO_INDEX`] for a new
    /// one; `None`: the same number. `Weights::new`: `None`
    pub sources: Option<&'a [u32]>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> Joints<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_joints_desc> {
        let mut desc = raw::hf_joints_desc { ..Default::default() };
        desc.heads = c.array(self.heads, "heads", &[&format!("{prefix}joint_count"), "3"])?;
        desc.tails = c.array(self.tails, "tails", &[&format!("{prefix}joint_count"), "3"])?;
        desc.axes = c.array(self.axes, "axes", &[&format!("{prefix}joint_count"), "3"])?;
        desc.parents = c.array(self.parents, "parents", &[&format!("{prefix}joint_count")])?;
        desc.deforms = c.array(self.deforms, "deforms", &[&format!("{prefix}joint_count")])?;
        desc.sources = c.array(self.sources, "sources", &[&format!("{prefix}joint_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.joint_count = c.count(&format!("{prefix}joint_count"), 0)?;
        Ok(desc)
    }
}

/// Places with given weights. Set one of vertices, places and points. To keep a painted region, pin all its vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pins<'a> {
    /// `[pin_count]`, or `None`
    pub places: Option<&'a [raw::hf_place]>,
    /// `[pin_count x 3]` points in space, at rest, in the unit and frame of the mesh, or `None`. Each stands for the
    /// nearest point of the surface, up to two boxes away
    pub points: Option<&'a [f64]>,
    /// `[pin_count]` of the geodesic disc around the place, in the unit of the mesh; `None` or 0: the place alone
    pub radii: Option<&'a [f64]>,
    /// `[pin_count x influence_count]` joints
    pub joints: Option<&'a [u32]>,
    /// `[pin_count x influence_count]` >= 0, scaled to the sum 1
    pub weights: Option<&'a [f32]>,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> Pins<'a> {
    pub(crate) fn fill(&self, c: &mut Call, prefix: &str, vertices: Option<&[u32]>) -> Result<raw::hf_pins_desc> {
        let mut desc = raw::hf_pins_desc { ..Default::default() };
        desc.vertices = c.array(vertices, "vertices", &[&format!("{prefix}pin_count")])?;
        desc.places = c.array(self.places, "places", &[&format!("{prefix}pin_count")])?;
        desc.points = c.array(self.points, "points", &[&format!("{prefix}pin_count"), "3"])?;
        desc.radii = c.array(self.radii, "radii", &[&format!("{prefix}pin_count")])?;
        desc.joints = c.array(self.joints, "joints", &[&format!("{prefix}pin_count"),
            &format!("{prefix}influence_count")])?;
        desc.weights = c.array(self.weights, "weights", &[&format!("{prefix}pin_count"),
            &format!("{prefix}influence_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.pin_count = c.count(&format!("{prefix}pin_count"), 0)?;
        desc.influence_count = c.count(&format!("{prefix}influence_count"), 0)?;
        Ok(desc)
    }
}

/// Weights to transfer from one surface to another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WeightsTransferOptions<'a> {
    /// `[source.vertex_count x source_influence_count]`
    pub joints: Option<&'a [u32]>,
    /// `[source.vertex_count x source_influence_count]` >= 0; a vertex whose weights are all 0 gives none
    pub weights: Option<&'a [f32]>,
    /// a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal
    pub distance: f64,
    /// between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees)
    pub angle: f64,
    /// joints of each vertex in the result: 4 or 8; 0: 4
    pub influence_count: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> WeightsTransferOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "distance" => self.distance = value,
            "angle" => self.angle = value,
            "influence_count" => self.influence_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_weights_transfer_desc> {
        let mut desc = raw::hf_weights_transfer_desc { distance: self.distance, angle: self.angle,
            influence_count: self.influence_count, ..Default::default() };
        c.learn("influence_count", if self.influence_count == 0 { 4 } else { self.influence_count as usize });
        desc.joints = c.array(self.joints, "joints", &["source.vertex_count",
            &format!("{prefix}source_influence_count")])?;
        desc.weights = c.array(self.weights, "weights", &["source.vertex_count",
            &format!("{prefix}source_influence_count")])?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.source_influence_count = c.count(&format!("{prefix}source_influence_count"), 0)?;
        Ok(desc)
    }
}

/// Weights to mirror.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WeightsMirrorOptions<'a> {
    /// `[joint_count x 3]` the joints at rest, in the frame of the mesh
    pub heads: Option<&'a [f64]>,
    /// one line for each joint in UTF-8, or `None`: joints are paired by their places
    pub names: Option<&'a [&'a str]>,
    /// `[joint_count]` the joint of the other side, [`raw::HF_NO_INDEX`]: find it; or `None`
    pub partners: Option<&'a [u32]>,
    /// `[6]` a point and a normal, or `None`: find the plane
    pub plane: Option<&'a [f64]>,
    /// `[vertex_count x source_influence_count]`
    pub joints: Option<&'a [u32]>,
    /// `[vertex_count x source_influence_count]` >= 0; a vertex whose weights are all 0 gives none
    pub weights: Option<&'a [f32]>,
    /// `HF_MIRROR_*`
    pub to: i32,
    /// as in [`WeightsTransferOptions`]
    pub distance: f64,
    /// as in [`WeightsTransferOptions`]
    pub angle: f64,
    /// joints of each vertex in the result: 4 or 8; 0: 4
    pub influence_count: u32,
    /// `None`, or an object to poll and cancel through
    pub progress: Option<&'a Progress>,
}
impl<'a> WeightsMirrorOptions<'a> {
    /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        match name {
            "to" => self.to = whole(name, value, f64::MAX)?,
            "distance" => self.distance = value,
            "angle" => self.angle = value,
            "influence_count" => self.influence_count = whole(name, value, f64::MAX)?,
            _ => return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
        }
        Ok(())
    }

    pub(crate) fn fill(&self, c: &mut Call, prefix: &str) -> Result<raw::hf_weights_mirror_desc> {
        let mut desc = raw::hf_weights_mirror_desc { to: self.to, distance: self.distance, angle: self.angle,
            influence_count: self.influence_count, ..Default::default() };
        c.learn("influence_count", if self.influence_count == 0 { 4 } else { self.influence_count as usize });
        desc.heads = c.array(self.heads, "heads", &[&format!("{prefix}joint_count"), "3"])?;
        desc.partners = c.array(self.partners, "partners", &[&format!("{prefix}joint_count")])?;
        desc.plane = c.array(self.plane, "plane", &["6"])?;
        desc.joints = c.array(self.joints, "joints", &["vertex_count", &format!("{prefix}source_influence_count")])?;
        desc.weights = c.array(self.weights, "weights", &["vertex_count", &format!("{prefix}source_influence_count")])?;
        desc.names = c.text(self.names)?;
        desc.progress = self.progress.map_or(std::ptr::null_mut(), |o| o.handle);
        desc.joint_count = c.count(&format!("{prefix}joint_count"), 0)?;
        desc.source_influence_count = c.count(&format!("{prefix}source_influence_count"), 0)?;
        Ok(desc)
    }
}

/// A cut as triangles that go and come. The first three arrays fit [`Patch`]. New vertices and triangles have the numbers
/// after the last ones of your mesh. The arrays are yours: each is `None` or as large as its capacity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cut {
    /// `[removed_triangle_capacity]` triangles of your mesh, ascending
    pub removed_triangles: Vec<u32>,
    /// `[new_vertex_capacity x 3]` in the unit of your mesh
    pub new_positions: Vec<f64>,
    /// `[new_triangle_capacity x 3]` vertices of your mesh, the first of welded copies, and new ones
    pub new_triangles: Vec<u32>,
    /// `[new_vertex_capacity x 3]` vertices of your mesh; the new vertex lies between them. Mix their attributes, as skin
    /// weights. [`raw::HF_NO_INDEX`] where a weight is 0
    pub vertex_corners: Vec<u32>,
    /// `[new_vertex_capacity x 3]` their weights, of sum 1. A single 1 copies a vertex
    pub vertex_barycentrics: Vec<f64>,
    /// `[new_triangle_capacity]` the removed triangle that each new one is a part of
    pub source_triangles: Vec<u32>,
    /// `[new_triangle_capacity x 3 x 3]` three weights for each corner of a new triangle, of the corners of its source:
    /// for what corners have, as UVs at seams
    pub corner_barycentrics: Vec<f64>,
    /// `[rim_capacity x 2]` along the line: the vertex on its left and that on its right; one and the same where the line
    /// ends inside the surface. At a border between its ends: those after it
    pub rim_vertices: Vec<u32>,
}

/// Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 - parameter)
/// a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours: each is `None` or as
/// large as its capacity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Isolines {
    /// `[point_capacity x 2]` vertices a and b of your mesh, the first of welded copies
    pub point_edges: Vec<u32>,
    /// `[point_capacity]` 0 to 1
    pub parameters: Vec<f64>,
    /// `[point_capacity x 3]` in the unit and frame of your mesh
    pub positions: Vec<f64>,
    /// `[line_capacity + 1]` line i holds the points line_starts`[i]` to line_starts`[i + 1]` - 1
    pub line_starts: Vec<u32>,
    /// `[line_capacity]` position of its level in the list
    pub line_levels: Vec<u32>,
    /// `[line_capacity]` 1: closed, the first point is not repeated; 0: ends at borders
    pub line_closed: Vec<i32>,
}

/// Places, values and fluxes of the sites. The arrays are yours; each is `None` or has `capacity` entries. The entries
/// are ordered by site number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SitesInfo {
    /// `[capacity]` numbers
    pub sites: Vec<u32>,
    /// `[capacity]` the vertex of the place, [`raw::HF_NO_INDEX`] for a point in a triangle
    pub vertices: Vec<u32>,
    /// `[capacity]`
    pub components: Vec<u32>,
    /// `[capacity x channel_count]`
    pub values: Vec<f64>,
    /// `[capacity]` 0 = hard
    pub stiffness: Vec<f64>,
    /// `[capacity x channel_count]` lambda: what flows into the surface at the site, in value x weight; the sum over a
    /// disc
    pub flux: Vec<f64>,
    /// `[capacity]` 0 = a point
    pub radii: Vec<f64>,
}

/// A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end vertices a and
/// b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a triangle has
/// [`raw::HF_NO_INDEX`] for both. The arrays are yours: each is `None` or as large as the capacity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// `[point_capacity x 2]` vertices a and b of your mesh, the first of welded copies
    pub point_edges: Vec<u32>,
    /// `[point_capacity]` 0 to 1
    pub parameters: Vec<f64>,
    /// `[point_capacity x 3]` in the unit and frame of your mesh
    pub positions: Vec<f64>,
    /// in the unit of the mesh; -1: no path
    pub length: f64,
}

/// This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints with fixed
/// vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R (p - pivot) +
/// translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.
///
/// If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint takes p
/// to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B and that scale,
/// and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkinInfo {
    /// `[joint_capacity x 3]` rest centroid of what each joint moves
    pub pivots: Vec<f64>,
    /// `[joint_capacity x 4]` quaternion x, y, z, w of the last frame
    pub rotations: Vec<f64>,
    /// `[joint_capacity x 3]` posed place of the pivot
    pub translations: Vec<f64>,
    /// `[joint_capacity x 4]` quaternion of B, fixed while handles stay
    pub axes: Vec<f64>,
    /// `[joint_capacity x 3]` along the axes in the last frame; `None` = joints are rigid
    pub scales: Vec<f64>,
    /// `[vertex_capacity x influence_count]`
    pub vertex_joints: Vec<u32>,
    /// `[vertex_capacity x influence_count]` of sum 1, descending
    pub vertex_weights: Vec<f32>,
    /// joints per vertex, 4 or 8; 0 = 4
    pub influence_count: u32,
}

/// Receives the rows of a blend. The arrays are yours; each may be `None`. Positions and offsets are in the unit of the
/// mesh, gradients per unit of the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlendRows {
    /// `[vertex_capacity x 2]` number of the first entry of the vertex, and count of its entries
    pub rows: Vec<u32>,
    /// `[entry_capacity]` each below the count of clusters
    pub clusters: Vec<u16>,
    /// `[entry_capacity]` multiples of 2^-24; the weights of a vertex sum to 1
    pub weights: Vec<f32>,
    /// `[entry_capacity x 3]` of the weights along the rest surface, for normals
    pub gradients: Vec<f32>,
    /// `[vertex_capacity x 3]` at rest, relative to centre
    pub positions: Vec<f32>,
    /// `[vertex_capacity x 3]` unit, at rest
    pub normals: Vec<f32>,
    /// `[vertex_capacity x 3]` 0 unless handles were added in place or rotations freed
    pub offsets: Vec<f32>,
    /// entries of the vertex that has the most
    pub longest_row: u32,
}

/// Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF). The
/// arrays are yours; each may be `None`. Rows hold the heaviest entries of a vertex, by falling weight. Unused entries
/// have weight 0.
///
/// The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its weights times
/// the largest distance between the places to which its clusters move it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlendInfluences {
    /// `[vertex_capacity x influence_count]` each below the count of clusters
    pub clusters: Vec<u16>,
    /// `[vertex_capacity x influence_count]` 65535ths; the weights of a vertex sum to 65535
    pub weights: Vec<u16>,
    /// `[vertex_capacity x influence_count]` `None` = not wanted. Refused for more than 256 clusters
    pub byte_clusters: Vec<u8>,
    /// `[vertex_capacity x influence_count]` `None` = not wanted. 255ths, of sum 255; weights that round to 0 are left
    /// out
    pub byte_weights: Vec<u8>,
    /// the largest change of a vertex's weights, 0 to 1: half the sum of the differences
    pub change: f64,
    /// the same for byte_weights
    pub byte_change: f64,
    /// the largest distance of a vertex from its place in the last frame, in box diagonals
    pub error: f64,
    /// the same for byte_weights
    pub byte_error: f64,
    /// clusters of each vertex, the length of a row, 1 to 64; 0 = 8
    pub influence_count: u32,
}

/// `Quads::mesh` writes the quad mesh to these arrays. They are yours: each is `None` or as large as its capacity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuadsMesh {
    /// `[vertex_capacity x 3]` in the unit and frame of your mesh
    pub positions: Vec<f64>,
    /// `[face_capacity x 4]` vertices of each quad, counter-clockwise
    pub faces: Vec<u32>,
    /// `[vertex_capacity]` triangle or face of your mesh that contains the vertex
    pub triangles: Vec<u32>,
    /// `[vertex_capacity x 3]` weights of that triangle's corners, in its own order, of sum 1; in a face of more corners
    /// the weights of `corners`
    pub barycentrics: Vec<f64>,
    /// `[vertex_capacity x 3]` vertices of your mesh that barycentrics belong to, the first of welded copies
    pub corners: Vec<u32>,
}

/// As the header says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Streamlines {
    /// `[point_capacity x 3]` in the unit and frame of your mesh
    pub positions: Vec<f64>,
    /// `[point_capacity]` of the field, rising along every line
    pub values: Vec<f64>,
    /// `[line_capacity + 1]` line i holds the points line_starts`[i]` to line_starts`[i + 1]` - 1
    pub line_starts: Vec<u32>,
    /// `[line_capacity x 2]` vertices where it starts and ends, of welded copies the first
    pub line_ends: Vec<u32>,
}

/// Receives the weights. The arrays are yours; each may be `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WeightsOut {
    /// `[vertex_capacity x influence_count]`
    pub joints: Vec<u32>,
    /// `[vertex_capacity x influence_count]` descending, of sum exactly 1
    pub weights: Vec<f32>,
    /// `[vertex_capacity]` `HF_WEIGHTS_*`
    pub origins: Vec<u8>,
    /// joints per vertex, 4 or 8
    pub influence_count: u32,
}

object!(
    /// Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one object
    /// for one call at a time. If a cancel may come after the end of the call, make a new object for the next call.
    Progress: hf_progress, hf_progress_destroy
);
impl Progress {
    /// Creates a progress object.
    pub fn new() -> Result<Self> {
        let mut c = Call::default();
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_progress_create(&mut handle_) })?;
        Ok(Progress { handle: handle_, counts: c.counts(&[]) })
    }

    /// Writes how much of the running call is done.
    pub fn fraction(&self) -> Result<f64> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut fraction = f64::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_progress_get_fraction(self.handle, &mut fraction) })?;
        Ok(fraction)
    }

    /// Stops the call that uses this object, or the next one that does. That call returns [`raw::HF_ERROR_CANCELLED`].
    pub fn cancel(&self) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_progress_cancel(self.handle) })?;
        Ok(())
    }
}

object!(
    /// hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.
    ///
    /// Make one surface per mesh, or per graph of your own (`Surface::from_graph`). Solvers, poses, direction fields,
    /// regions, transfers and quads are made on a surface and share its factor. A surface never changes, so any number of
    /// threads may use it: an edit makes another one (`Surface::edit`). An object made on a surface keeps the data it
    /// needs, so you can destroy objects in any order.
    Surface: hf_surface, hf_surface_destroy
);
impl Surface {
    /// Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies the
    /// mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be dirty: the
    /// surface counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices and components.
    /// `Surface::report` gives these counts.
    ///
    /// A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are
    /// doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such as a leaf,
    /// hair or a cape, is one sheet with a border. Results give the index of the first of doubled triangles; calls take
    /// the index of any. Vertices of the second side alone get opposite normals from poses, and a ray with front_only
    /// hits both sides.
    ///
    /// positions: `[vertex_count x 3]` of float or double, any unit, any offset
    /// triangles: `[triangle_count x 3]` of uint32_t or uint16_t, counter-clockwise seen from outside
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn new<'i>(positions: impl Into<Reals<'i>>, triangles: impl Into<Indices<'i>>,
            options: &SurfaceOptions) -> Result<Self> {
        let mut c = Call::default();
        let desc = options.fill(&mut c, "", Some(positions.into()), Some(triangles.into()))?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_create(&desc, &mut handle_) })?;
        Ok(Surface { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call copies the
    /// graph. Solvers with sites at vertices, fields, previews, certificates, clones, saved factors, components and
    /// reports work as on a mesh. A call that needs triangles returns [`raw::HF_ERROR_UNSUPPORTED`]. These are poses,
    /// regions, directions, geodesics, iso-lines, extremities, quads, flow, picking, transfers, skin weights, vector
    /// fields, links and screening. Sites at places, at points or on discs need triangles too.
    ///
    /// A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from the
    /// median of their component by a factor above 1e30 are limited; [`raw::hf_mesh_statistics`] counts their vertices as
    /// changed. Bi-harmonic fields limit weights to 1e3 times the median.
    ///
    /// edges: `[edge_count x 2]` of uint32_t or uint16_t: vertices, in any order. The weights of parallel edges are added
    /// up. Self loops are ignored
    /// weights: `[edge_count]` of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left out
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn from_graph<'i>(edges: impl Into<Indices<'i>>, weights: impl Into<Reals<'i>>,
            options: &GraphOptions) -> Result<Self> {
        let mut c = Call::default();
        let desc = options.fill(&mut c, "", Some(edges.into()), Some(weights.into()))?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_create_graph(&desc, &mut handle_) })?;
        Ok(Surface { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Writes the options of a surface.
    pub fn info(&self) -> Result<raw::hf_surface_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_surface_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the report of the mesh.
    pub fn report(&self) -> Result<raw::hf_surface_report> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut report = raw::hf_surface_report::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_get_report(self.handle, &mut report) })?;
        Ok(report)
    }

    /// Writes the statistics of the mesh.
    pub fn mesh_statistics(&self) -> Result<raw::hf_mesh_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_mesh_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_get_mesh_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Writes the component of every vertex of your mesh, and [`raw::HF_NO_INDEX`] for isolated vertices. Components are
    /// numbered in the order of their lowest vertex numbers.
    pub fn components(&self) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut components: Vec<u32> = Vec::new();
        loop {
            let components_at = c.room(&mut components, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_get_components(self.handle, c.count("capacity", 0)?, components_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        components.truncate(c.product(&["capacity"]));
        Ok(components)
    }

    /// Writes how the pieces of a surface are linked.
    pub fn links_info(&self) -> Result<raw::hf_links_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_links_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_get_links_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the links of a surface. You can edit them and give them back with [`raw::HF_LINK_LIST`]. A list does not
    /// say which pieces are light: name them in light_vertices, as `Surface::pieces` marks them. Then the list alone
    /// gives the same surface, bit for bit, without a search.
    pub fn links(&self) -> Result<Vec<raw::hf_link>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut links: Vec<raw::hf_link> = Vec::new();
        loop {
            let links_at = c.room(&mut links, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_get_links(self.handle, c.count("capacity", 0)?, links_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        links.truncate(c.product(&["capacity"]));
        Ok(links)
    }

    /// Writes the piece of every vertex of your mesh, and [`raw::HF_NO_INDEX`] for isolated vertices. Pieces are numbered
    /// in the order of their lowest vertices.
    pub fn pieces(&self) -> Result<(Vec<u32>, Vec<i32>)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut pieces: Vec<u32> = Vec::new();
        let mut light: Vec<i32> = Vec::new();
        loop {
            let pieces_at = c.room(&mut pieces, &["capacity"]);
            let light_at = c.room(&mut light, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_get_pieces(self.handle, c.count("capacity", 0)?, pieces_at, light_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        pieces.truncate(c.product(&["capacity"]));
        light.truncate(c.product(&["capacity"]));
        Ok((pieces, light))
    }

    /// Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther its ends
    /// are apart than at rest, and 0 if they are nearer. The gap of a contact ([`raw::hf_links_info`]) is measured in the
    /// same way. A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With joint_parents its
    /// joint must be the joint of the nearest point there, or the parent or child of that joint. Each touches one point
    /// of the piece: the nearest at rest. Its opening is the smaller of two distances, minus the distance at rest: its
    /// own distance from the piece, and the distance of the point that it touched from the piece of the vertex. So a
    /// piece that slides along another opens no vertex, but its links have gaps. Touching vertices are found where links
    /// are: by `Surface::new` and `Surface::relink`. Links that an edit adds have none.
    ///
    /// positions: `[vertex_count x 3]` of float or double: the deformed mesh. It can come from a pose, a transfer or any
    /// other source.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn measure_gaps<'i>(&self, positions: impl Into<Reals<'i>>) -> Result<(Vec<f64>, raw::hf_gaps_info)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_gaps_info::default();
        let positions_ = c.view(Some(positions.into().numbers()), "positions", &["vertex_count", "3"])?;
        c.learn("capacity", Call::FIRST);
        let mut gaps: Vec<f64> = Vec::new();
        loop {
            let gaps_at = c.room(&mut gaps, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_measure_gaps(self.handle, &positions_, c.count("capacity", 0)?, gaps_at,
                &mut info) };
            if c.enough(code, &[("capacity", info.link_count)])? {
                break;
            }
        }
        gaps.truncate(c.product(&["capacity"]));
        Ok((gaps, info))
    }

    /// Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the old one
    /// where its matrix has the same pattern: other stiffness, weights or light pieces.
    ///
    /// progress: an object to poll and cancel through.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn relink(&self, links: &Links, progress: Option<&Progress>) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = links.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_relink(self.handle, &desc, progress.map_or(std::ptr::null_mut(), |o| o.handle),
            &mut handle_) })?;
        Ok(Surface { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it is. The
    /// new surface shares the factor: an edit of up to a few thousand vertices costs the elimination paths of its rim, as
    /// sites do, and a link costs up to six paths. The library factorises again with the same ordering where that costs
    /// less, and for bi-harmonic fields. A surface that is edited back has the fields of the old one.
    ///
    /// Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes lengths of
    /// edges by about half a percent in the mean. A part that must not bend at all is a rigid piece
    /// (`Pose::set_rigid_pieces`). Bi-harmonic operators square it, so they count at most 100 and at least 0.01. Lengths
    /// do not change, so regions, transfers, distances, directions and quads do not see stiffness.
    ///
    /// A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken up and
    /// dropped. The new surface is the one that `Surface::relink` makes of the same list of links. `Surface::components`
    /// gives the new components. Light pieces and contacts stay as they are.
    ///
    /// After a patch the surface is the one that `Surface::new` makes of the triangles without the removed ones and with
    /// the new ones, [`raw::HF_WELD_NONE`] for the new vertices. Vertices keep their stiffness. New ones, and those that
    /// were isolated, have 1. Distances, directions and quads make a factor of their own when they are first asked for,
    /// as on a new surface. Patches over a quarter of the surface, and with [`raw::HF_OPERATOR_CLAMPED`], make the whole
    /// operator and its factor anew. Take links out before, and put them in again after it.
    ///
    /// `Solver::move_to` takes sites along, and `Pose::move_to` takes handles along. After a patch or a cut make a new
    /// pose: `Pose::move_to` refuses other triangles. Soft sites keep the unit of their stiffness while links and
    /// triangles stay; others change it as they do for `Surface::relink`. `Surface::save` is refused: save the factor of
    /// the surface before its edits. Memory limits hold for both surfaces together.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_EMPTY`],
    /// [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn edit(&self, options: &SurfaceEdit) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = options.fill(&mut c, "list_")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_edit(self.handle, &desc, &mut handle_) })?;
        let mut made = Surface { handle: handle_, counts: c.counts(&["vertex_count"]) };
        let info = made.info()?;
        made.counts.insert("vertex_count".into(), info.vertex_count as usize);
        Ok(made)
    }

    /// Writes the corners that all cuts gave other vertices since the surface was made, in the order of the cuts. A
    /// second cut adds its corners behind the corners of the first cut: go on from the last count.
    pub fn cuts(&self) -> Result<Vec<raw::hf_cut_corner>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut cuts: Vec<raw::hf_cut_corner> = Vec::new();
        loop {
            let cuts_at = c.room(&mut cuts, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_get_cuts(self.handle, c.count("capacity", 0)?, cuts_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        cuts.truncate(c.product(&["capacity"]));
        Ok(cuts)
    }

    /// Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices.
    pub fn stiffness(&self) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut stiffness: Vec<f64> = Vec::new();
        loop {
            let stiffness_at = c.room(&mut stiffness, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_get_stiffness(self.handle, c.count("capacity", 0)?, stiffness_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        stiffness.truncate(c.product(&["capacity"]));
        Ok(stiffness)
    }

    /// Writes the statistics of a surface and of the factor it was made with.
    pub fn statistics(&self) -> Result<raw::hf_surface_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_surface_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside the mesh and
    /// gives them to `Surface::new`, which then takes a fraction of the time. The bytes are the same for the same mesh,
    /// options and library version, whatever the number of threads. The bytes are little-endian and hold a format
    /// version, a hash of the matrix and a checksum. They hold no sites.
    ///
    /// field_kind: `HF_FIELD_*`. If its factor does not exist yet, the call makes it first.
    /// progress: an object to poll and cancel through.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_TOO_SMALL`].
    pub fn save(&self, field_kind: i32, progress: Option<&Progress>) -> Result<Vec<u8>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut size = 0;
        // SAFETY: the first call asks for the size.
        check(unsafe { raw::hf_surface_save(self.handle, field_kind, progress.map_or(std::ptr::null_mut(),
            |o| o.handle), 0, std::ptr::null_mut(), &mut size) })?;
        let mut block = vec![0u8; size];
        check(unsafe { raw::hf_surface_save(self.handle, field_kind, progress.map_or(std::ptr::null_mut(),
            |o| o.handle), block.len(), block.as_mut_ptr().cast(), &mut size) })?;
        Ok(block)
    }

    /// Turns a line on the surface into a cut through triangles. Give the arrays to `Surface::edit` as a patch, and
    /// change your mesh in the same way. The surface itself does not change.
    ///
    /// A line from border to border, or a closed line around a part, parts it from the rest. A line that starts at the
    /// border opens it. An end inside the surface stays closed. The line may pass vertices and run along edges. It is
    /// straight where its triangles are unfolded, and bends at its points and at vertices only. The parts of a triangle
    /// are a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an edge. On a mesh whose triangles are
    /// turned alike, left is left for a viewer who looks at the outside along the line. New vertices have the stiffness
    /// 1.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_EMPTY`],
    /// [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_TOO_SMALL`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn trace_cut(&self, options: &CutOptions) -> Result<Cut> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = options.fill(&mut c, "")?;
        let mut cut = raw::hf_cut { ..Default::default() };
        c.learn("removed_triangle_capacity", Call::FIRST);
        c.learn("new_vertex_capacity", Call::FIRST);
        c.learn("new_triangle_capacity", Call::FIRST);
        c.learn("rim_capacity", Call::FIRST);
        let mut all_removed_triangles: Vec<u32> = Vec::new();
        let mut all_new_positions: Vec<f64> = Vec::new();
        let mut all_new_triangles: Vec<u32> = Vec::new();
        let mut all_vertex_corners: Vec<u32> = Vec::new();
        let mut all_vertex_barycentrics: Vec<f64> = Vec::new();
        let mut all_source_triangles: Vec<u32> = Vec::new();
        let mut all_corner_barycentrics: Vec<f64> = Vec::new();
        let mut all_rim_vertices: Vec<u32> = Vec::new();
        loop {
            cut.removed_triangle_capacity = c.count("removed_triangle_capacity", 0)?;
            cut.new_vertex_capacity = c.count("new_vertex_capacity", 0)?;
            cut.new_triangle_capacity = c.count("new_triangle_capacity", 0)?;
            cut.rim_capacity = c.count("rim_capacity", 0)?;
            cut.removed_triangles = c.room(&mut all_removed_triangles, &["removed_triangle_capacity"]);
            cut.new_positions = c.room(&mut all_new_positions, &["new_vertex_capacity", "3"]);
            cut.new_triangles = c.room(&mut all_new_triangles, &["new_triangle_capacity", "3"]);
            cut.vertex_corners = c.room(&mut all_vertex_corners, &["new_vertex_capacity", "3"]);
            cut.vertex_barycentrics = c.room(&mut all_vertex_barycentrics, &["new_vertex_capacity", "3"]);
            cut.source_triangles = c.room(&mut all_source_triangles, &["new_triangle_capacity"]);
            cut.corner_barycentrics = c.room(&mut all_corner_barycentrics, &["new_triangle_capacity", "3", "3"]);
            cut.rim_vertices = c.room(&mut all_rim_vertices, &["rim_capacity", "2"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_trace_cut(self.handle, &desc, &mut cut) };
            if c.enough(code, &[("removed_triangle_capacity", cut.removed_triangle_count), ("new_vertex_capacity",
                cut.new_vertex_count), ("new_triangle_capacity", cut.new_triangle_count), ("rim_capacity",
                cut.rim_count)])? {
                break;
            }
        }
        all_removed_triangles.truncate(c.product(&["removed_triangle_capacity"]));
        all_new_positions.truncate(c.product(&["new_vertex_capacity", "3"]));
        all_new_triangles.truncate(c.product(&["new_triangle_capacity", "3"]));
        all_vertex_corners.truncate(c.product(&["new_vertex_capacity", "3"]));
        all_vertex_barycentrics.truncate(c.product(&["new_vertex_capacity", "3"]));
        all_source_triangles.truncate(c.product(&["new_triangle_capacity"]));
        all_corner_barycentrics.truncate(c.product(&["new_triangle_capacity", "3", "3"]));
        all_rim_vertices.truncate(c.product(&["rim_capacity", "2"]));
        Ok(Cut { removed_triangles: all_removed_triangles, new_positions: all_new_positions,
            new_triangles: all_new_triangles, vertex_corners: all_vertex_corners,
            vertex_barycentrics: all_vertex_barycentrics, source_triangles: all_source_triangles,
            corner_barycentrics: all_corner_barycentrics, rim_vertices: all_rim_vertices })
    }

    /// Finds what a mouse click hits: the first triangle on a ray.
    ///
    /// origin: `[3]` in the frame of the positions. The direction can have any length above 0.
    /// direction: `[3]` in the frame of the positions. The direction can have any length above 0.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn cast_ray(&self, origin: &[f64], direction: &[f64], options: &PickOptions) -> Result<Option<raw::hf_hit>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let origin_ = c.array(Some(origin), "origin", &["3"])?;
        let direction_ = c.array(Some(direction), "direction", &["3"])?;
        let desc = options.fill(&mut c, "")?;
        let mut hit = raw::hf_hit::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_cast_ray(self.handle, origin_, direction_, &desc, &mut hit) })?;
        Ok((hit.found != 0).then_some(hit))
    }

    /// Finds the vertex nearest to a point.
    ///
    /// point: `[3]` in the frame of the positions.
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn find_vertex(&self, point: &[f64], options: &PickOptions) -> Result<(u32, f64)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let point_ = c.array(Some(point), "point", &["3"])?;
        let desc = options.fill(&mut c, "")?;
        let mut vertex = u32::default();
        let mut distance = f64::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_find_vertex(self.handle, point_, &desc, &mut vertex, &mut distance) })?;
        Ok((vertex, distance))
    }

    /// Writes levels, ascending. [`raw::HF_LEVELS_AREA`] makes all strips equal in area. [`raw::HF_LEVELS_LENGTH`] makes
    /// the mean widths of the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the
    /// value would crowd them. [`raw::HF_LEVELS_LENGTH`] leaves out the parts where the field is flat to 1e-9 of its
    /// range.
    ///
    /// In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of level c. Both
    /// are exact for the piecewise linear field. [`raw::HF_LEVELS_AREA`] takes equal steps of A.
    /// [`raw::HF_LEVELS_LENGTH`] takes equal steps of the integral of A'(c) / L(c) dc. That integral is the height on a
    /// cylinder and the distance from the pole on a sphere.
    ///
    /// field: `[vertex_count]` of float or double.
    /// spacing: `HF_LEVELS_*`.
    /// level_count: 1 to 1,000,000.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn space_levels<'i>(&self, field: impl Into<Reals<'i>>, level_count: u32, spacing: i32) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let field_ = c.view(Some(field.into().numbers()), "field", &["vertex_count"])?;
        if level_count > 0 { c.learn("level_count", level_count as usize); }
        let mut levels = vec![f64::default(); c.product(&["level_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_surface_space_levels(self.handle, &field_, spacing, level_count,
            levels.as_mut_ptr()) })?;
        Ok(levels)
    }

    /// Traces the iso-lines of levels. The levels must be finite and can have any order; the lines come in the order of
    /// the levels. A vertex whose value equals a level counts as just above it, so lines have no gaps. A line either
    /// closes or ends. It ends at a border or at a triangle without values. At an edge of three or more triangles (non-
    /// manifold), these are taken in pairs. A line continues inside a pair, and ends at a triangle without a partner. The
    /// function leaves out lines of length zero. Seen from outside a consistently oriented mesh, the field is higher on
    /// the left of a line.
    ///
    /// field: `[vertex_count]` of float or double.
    /// levels: `[level_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn trace_isolines<'i>(&self, field: impl Into<Reals<'i>>, levels: &[f64]) -> Result<Isolines> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let field_ = c.view(Some(field.into().numbers()), "field", &["vertex_count"])?;
        let levels_ = c.array(Some(levels), "levels", &["level_count"])?;
        let mut lines = raw::hf_isolines { ..Default::default() };
        c.learn("point_capacity", Call::FIRST);
        c.learn("line_capacity", Call::FIRST);
        let mut all_point_edges: Vec<u32> = Vec::new();
        let mut all_parameters: Vec<f64> = Vec::new();
        let mut all_positions: Vec<f64> = Vec::new();
        let mut all_line_starts: Vec<u32> = Vec::new();
        let mut all_line_levels: Vec<u32> = Vec::new();
        let mut all_line_closed: Vec<i32> = Vec::new();
        loop {
            lines.point_capacity = c.count("point_capacity", 0)?;
            lines.line_capacity = c.count("line_capacity", 0)?;
            lines.point_edges = c.room(&mut all_point_edges, &["point_capacity", "2"]);
            lines.parameters = c.room(&mut all_parameters, &["point_capacity"]);
            lines.positions = c.room(&mut all_positions, &["point_capacity", "3"]);
            lines.line_starts = c.room(&mut all_line_starts, &["line_capacity + 1"]);
            lines.line_levels = c.room(&mut all_line_levels, &["line_capacity"]);
            lines.line_closed = c.room(&mut all_line_closed, &["line_capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_trace_isolines(self.handle, &field_, c.count("level_count", 1)?,
                levels_, &mut lines) };
            if c.enough(code, &[("point_capacity", lines.point_count), ("line_capacity", lines.line_count)])? {
                break;
            }
        }
        all_point_edges.truncate(c.product(&["point_capacity", "2"]));
        all_parameters.truncate(c.product(&["point_capacity"]));
        all_positions.truncate(c.product(&["point_capacity", "3"]));
        all_line_starts.truncate(c.product(&["line_capacity + 1"]));
        all_line_levels.truncate(c.product(&["line_capacity"]));
        all_line_closed.truncate(c.product(&["line_capacity"]));
        Ok(Isolines { point_edges: all_point_edges, parameters: all_parameters, positions: all_positions,
            line_starts: all_line_starts, line_levels: all_line_levels, line_closed: all_line_closed })
    }

    /// Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each vertex
    /// decide (Banchoff 1970). Take its neighbours with lower values and the edges between them. The index of the vertex
    /// is 1 minus their Euler characteristic. The vertex number breaks ties, so a flat area has critical points too. The
    /// indices sum to the Euler characteristic on every component. On a mesh that is not Delaunay a harmonic field can
    /// show an extremum away from its sites, because the default operator uses other edges than the mesh.
    /// [`raw::HF_OPERATOR_CLAMPED`] uses the edges of the mesh and avoids this.
    ///
    /// field: `[vertex_count]` of float or double.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`].
    pub fn find_critical_points<'i>(&self, field: impl Into<Reals<'i>>) -> Result<(Vec<raw::hf_critical_point>,
            raw::hf_critical_info)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_critical_info::default();
        let field_ = c.view(Some(field.into().numbers()), "field", &["vertex_count"])?;
        c.learn("capacity", Call::FIRST);
        let mut points: Vec<raw::hf_critical_point> = Vec::new();
        loop {
            let points_at = c.room(&mut points, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_find_critical_points(self.handle, &field_, c.count("capacity", 0)?,
                points_at, &mut info) };
            if c.enough(code, &[("capacity", info.point_count)])? {
                break;
            }
        }
        points.truncate(c.product(&["capacity"]));
        Ok((points, info))
    }

    /// Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does not depend
    /// on the order of the vertices. Pose and meshing change it only within the resolution of the mesh.
    ///
    /// field: `[vertex_count]`, packed: the field whose peaks are proposed, 0 at isolated vertices. Unit: length^2
    /// (Poisson), length (geodesic), each up to a constant per component
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn find_extremities(&self, field: Option<&mut [f64]>,
            options: &ExtremitiesOptions) -> Result<Vec<raw::hf_extremity>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = options.fill(&mut c, "")?;
        let field_at = c.fill(field, "field", &["vertex_count"])?;
        desc.out_field = field_at;
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut extremities: Vec<raw::hf_extremity> = Vec::new();
        loop {
            let extremities_at = c.room(&mut extremities, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_find_extremities(self.handle, &desc, c.count("capacity", 0)?,
                extremities_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        extremities.truncate(c.product(&["capacity"]));
        Ok(extremities)
    }

    /// Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned proposals come
    /// first, then the others, each group by length, the longest first. The places do not depend on the order of the
    /// vertices. They follow translation and scale. A skeleton gives each proposal the joint that moves it, a role and a
    /// side. If its roles are known, feet and the trunk are pinned. Hands, heads, tails and pieces that hang on them,
    /// such as a sword, are not. Each head, hand, foot, tail, ear and wing gets at most one proposal. A part that no
    /// joint of the skin moves, such as the box that an animator drags, gets none.
    ///
    /// regions: `[vertex_count]`: position in the list of the proposal whose region has the vertex; [`raw::HF_NO_INDEX`]
    /// for a vertex of no region
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`].
    pub fn propose_handles(&self, regions: Option<&mut [u32]>,
            options: &HandleProposalsOptions) -> Result<Vec<raw::hf_handle_proposal>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = options.fill(&mut c, "")?;
        let regions_at = c.fill(regions, "regions", &["vertex_count"])?;
        desc.out_regions = regions_at;
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut proposals: Vec<raw::hf_handle_proposal> = Vec::new();
        loop {
            let proposals_at = c.room(&mut proposals, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_surface_propose_handles(self.handle, &desc, c.count("capacity", 0)?,
                proposals_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        proposals.truncate(c.product(&["capacity"]));
        Ok(proposals)
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}

object!(
    /// A set of sites on a surface, and their field.
    Solver: hf_solver, hf_solver_destroy
);
impl Solver {
    /// Creates a solver without sites.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`].
    pub fn new(surface: &Surface, options: &SolverOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Solver { handle: handle_, counts: c.counts(&["channel_count", "vertex_count"]) })
    }

    /// Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share the factor
    /// and the solved sites, so a copy costs its list of sites only. Use one copy per thread or per set of sites. For
    /// undo, keep copies: one before each edit.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_clone(self.handle, &mut handle_) })?;
        Ok(Solver { handle: handle_, counts: c.counts(&["channel_count", "vertex_count"]) })
    }

    /// Moves a solver to an edited surface. Its sites keep their numbers, values and screening.
    ///
    /// surface: any number of calls of `Surface::edit` or `Surface::relink` make it from the solver's surface, or the
    /// solver's surface from it.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn move_to(&mut self, surface: &Surface) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.parent("surface", &surface.counts);
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_move_to(self.handle, surface.handle) })?;
        self.counts.extend(surface.counts.clone());
        Ok(())
    }

    /// Writes the options of a solver.
    pub fn info(&self) -> Result<raw::hf_solver_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solver_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Adds sites.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn add_sites(&mut self, sites: &Sites) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = sites.fill(&mut c, "")?;
        let mut sites = vec![u32::default(); c.product(&["site_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_add_sites(self.handle, &desc, sites.as_mut_ptr()) })?;
        Ok(sites)
    }

    /// Adds one hard site at a vertex.
    ///
    /// values: `[channel_count]`, or `None` for 0.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn add_site(&mut self, vertex: u32, values: Option<&[f64]>) -> Result<u32> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let values_ = c.array(values, "values", &["channel_count"])?;
        let mut site = u32::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_add_site(self.handle, vertex, values_, &mut site) })?;
        Ok(site)
    }

    /// Removes sites by number. The field is 0 on a component that has no site left. If you add a site there again, the
    /// field is exact.
    ///
    /// sites: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn remove_sites(&mut self, sites: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_remove_sites(self.handle, c.count("site_count", 1)?, sites_) })?;
        Ok(())
    }

    /// Moves sites to new places. Each site keeps its number, value, stiffness and radius.
    ///
    /// sites: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn move_sites(&mut self, sites: &[u32], to: &Sites) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let desc = to.fill(&mut c, "")?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_move_sites(self.handle, c.count("site_count", 1)?, sites_, &desc) })?;
        Ok(())
    }

    /// Gives sites new values. The call costs nothing until the next solve.
    ///
    /// sites: `[site_count]`.
    /// values: `[site_count x channel_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn set_values(&mut self, sites: &[u32], values: &[f64]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let values_ = c.array(Some(values), "values", &["site_count", "channel_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_set_values(self.handle, c.count("site_count", 1)?, sites_, values_) })?;
        Ok(())
    }

    /// Applies a batch of edits at once.
    pub fn edit_sites(&mut self, edit: &Edit) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = edit.fill(&mut c, "")?;
        let mut sites = vec![u32::default(); c.product(&["add.site_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_edit_sites(self.handle, &desc, sites.as_mut_ptr()) })?;
        Ok(sites)
    }

    /// Returns the number of sites, or 0 for an invalid object.
    pub fn site_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_solver_get_site_count(self.handle) }
    }

    /// Writes all sites.
    pub fn sites(&self) -> Result<SitesInfo> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_sites_info { ..Default::default() };
        c.learn("capacity", Call::FIRST);
        let mut all_sites: Vec<u32> = Vec::new();
        let mut all_vertices: Vec<u32> = Vec::new();
        let mut all_components: Vec<u32> = Vec::new();
        let mut all_values: Vec<f64> = Vec::new();
        let mut all_stiffness: Vec<f64> = Vec::new();
        let mut all_flux: Vec<f64> = Vec::new();
        let mut all_radii: Vec<f64> = Vec::new();
        loop {
            info.capacity = c.count("capacity", 0)?;
            info.sites = c.room(&mut all_sites, &["capacity"]);
            info.vertices = c.room(&mut all_vertices, &["capacity"]);
            info.components = c.room(&mut all_components, &["capacity"]);
            info.values = c.room(&mut all_values, &["capacity", "channel_count"]);
            info.stiffness = c.room(&mut all_stiffness, &["capacity"]);
            info.flux = c.room(&mut all_flux, &["capacity", "channel_count"]);
            info.radii = c.room(&mut all_radii, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_solver_get_sites(self.handle, &mut info) };
            if c.enough(code, &[("capacity", info.count)])? {
                break;
            }
        }
        all_sites.truncate(c.product(&["capacity"]));
        all_vertices.truncate(c.product(&["capacity"]));
        all_components.truncate(c.product(&["capacity"]));
        all_values.truncate(c.product(&["capacity", "channel_count"]));
        all_stiffness.truncate(c.product(&["capacity"]));
        all_flux.truncate(c.product(&["capacity", "channel_count"]));
        all_radii.truncate(c.product(&["capacity"]));
        Ok(SitesInfo { sites: all_sites, vertices: all_vertices, components: all_components, values: all_values,
            stiffness: all_stiffness, flux: all_flux, radii: all_radii })
    }

    /// Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H is large,
    /// and the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12 times the mean
    /// diagonal of K. Such a field needs no site on a component where some H is above 0.
    ///
    /// screening: `[vertex_count]` H >= 0, in 1 / length^2 with the unit of the mesh; `None` removes the screening.
    /// targets: `[vertex_count x channel_count]` p, or `None` for 0. Both are copied. The values of the first of welded
    /// copies hold for all of them. Sites stay. A site with a radius holds the rim of its disc only. Undo restores
    /// the screening with the sites.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn set_screening(&mut self, screening: Option<&[f64]>, targets: Option<&[f64]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let screening_ = c.array(screening, "screening", &["vertex_count"])?;
        let targets_ = c.array(targets, "targets", &["vertex_count", "channel_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_set_screening(self.handle, screening_, targets_) })?;
        Ok(())
    }

    /// Solves for the field at every vertex of your mesh, in single or double precision. Hard sites hold their values
    /// exactly. The field is 0 on components without a site.
    ///
    /// out: `[vertex_count x channel_count]` of float or double.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn solve(&self) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        let mut out = vec![f64::default(); c.product(&["vertex_count", "channel_count"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve(self.handle, &out_view, &mut info) })?;
        Ok(out)
    }

    /// As `solve`, into a slice of yours. Returns the figures of the call.
    pub fn solve_into<P: Real>(&self, out: &mut [P]) -> Result<raw::hf_solve_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        c.fit(out.len(), "out", &["vertex_count", "channel_count"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve(self.handle, &out_view, &mut info) })?;
        Ok(info)
    }

    /// Solves for the field at chosen vertices only, with the same bits as `Solver::solve` in double. The call reads only
    /// those columns of the factor on which these vertices depend (elimination paths), on the calling thread. One path is
    /// up to a sixth of the factor, but the paths of many vertices share most of their columns. The call costs a whole
    /// solve for bi-harmonic fields, and whenever sites are eliminated in the factor (see `Solver::prepare_rebase`). A
    /// vertex of a component without a site gets 0.
    ///
    /// vertices: `[vertex_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn solve_at(&self, vertices: &[u32]) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.sizes.remove("vertex_count"); // of the list given here
        let vertices_ = c.array(Some(vertices), "vertices", &["vertex_count"])?;
        let mut values = vec![f64::default(); c.product(&["vertex_count", "channel_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve_at(self.handle, c.count("vertex_count", 1)?, vertices_,
            values.as_mut_ptr()) })?;
        Ok(values)
    }

    /// Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3).
    /// The channels are the x, y and z of the constraint vectors, and the call solves each as a field. It then projects
    /// the vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the area-weighted normal.
    ///
    /// out: `[vertex_count x 3]` of float or double, not normalised.
    /// normals: `[vertex_count x 3]`, packed: the normals used.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn solve_vectors(&self) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        let mut out = vec![f64::default(); c.product(&["vertex_count", "3"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at: *mut f64 = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve_vectors(self.handle, &out_view, normals_at, &mut info) })?;
        Ok(out)
    }

    /// As `solve_vectors`, into a slice of yours. Returns the figures of the call.
    pub fn solve_vectors_into<P: Real>(&self, out: &mut [P],
            normals: Option<&mut [f64]>) -> Result<raw::hf_solve_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        c.fit(out.len(), "out", &["vertex_count", "3"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at = c.fill(normals, "normals", &["vertex_count", "3"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve_vectors(self.handle, &out_view, normals_at, &mut info) })?;
        Ok(info)
    }

    /// Solves with a single-precision copy of the factor. This reads half the bytes of Solver.solve; use it while the
    /// user drags a value or a site. The error is about 1e-6 of the value range for harmonic fields. Bi-harmonic fields,
    /// long shapes and crowded sites can have an error of any size: ask for corrections there and read error_estimate.
    /// Hard sites at vertices are exact. One correction (iterative refinement, Wilkinson 1963) reduces the error of a
    /// harmonic field below 1e-9, a second one below 1e-12. Each correction costs as much as two to three calls of
    /// Solver.solve.
    ///
    /// The first call makes the single-precision copy, which costs about two solves. All solvers of that field kind on
    /// the surface share the copy. It is freed with the last of these solvers, or by `Solver::release_preview`. A solver
    /// whose factor eliminates sites gives the exact field. info.exact is then 1.
    ///
    /// correction_count: 0 to 8.
    /// out: `[vertex_count x channel_count]` of float or double, as `Solver::solve`. Single precision rounds most
    /// corrections away.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn solve_preview(&self, correction_count: u32) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_preview_info::default();
        let mut out = vec![f64::default(); c.product(&["vertex_count", "channel_count"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve_preview(self.handle, &out_view, correction_count, &mut info) })?;
        Ok(out)
    }

    /// As `solve_preview`, into a slice of yours. Returns the figures of the call.
    pub fn solve_preview_into<P: Real>(&self, out: &mut [P], correction_count: u32) -> Result<raw::hf_preview_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_preview_info::default();
        c.fit(out.len(), "out", &["vertex_count", "channel_count"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_solve_preview(self.handle, &out_view, correction_count, &mut info) })?;
        Ok(info)
    }

    /// Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The next
    /// preview makes the copy again.
    pub fn release_preview(&self) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_release_preview(self.handle) })?;
        Ok(())
    }

    /// Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of edges,
    /// from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3).
    ///
    /// sites: `[site_count]`.
    /// vertices: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_OUT_OF_RANGE`].
    pub fn move_vectors(&mut self, sites: &[u32], vertices: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let vertices_ = c.array(Some(vertices), "vertices", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_move_vectors(self.handle, c.count("site_count", 1)?, sites_, vertices_) })?;
        Ok(())
    }

    /// Turns the vector of site i about its vertex normal, counter-clockwise by angles`[i]` radians. Does not factorise.
    ///
    /// sites: `[site_count]`.
    /// angles: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn rotate_vectors(&mut self, sites: &[u32], angles: &[f64]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let angles_ = c.array(Some(angles), "angles", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_rotate_vectors(self.handle, c.count("site_count", 1)?, sites_, angles_) })?;
        Ok(())
    }

    /// Solves the field and checks it against its equations. The check uses only the operator K and the site values. So
    /// it finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call returns
    /// [`raw::HF_ERROR_INACCURATE`] (index = worst vertex) if the check fails, and writes certificate then too. Do not
    /// use fields of that solver; make the surface again.
    ///
    /// tolerance: largest error to accept, > 0; 0 = 1e-8
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INACCURATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn certify(&self, tolerance: f64) -> Result<raw::hf_certificate> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut certificate = raw::hf_certificate { tolerance: tolerance, ..Default::default() };
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_certify(self.handle, &mut certificate) })?;
        Ok(certificate)
    }

    /// Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It runs on
    /// the calling thread, while other threads edit and solve with this solver. The next edit switches to the new factor.
    /// Fields before and after are the same up to rounding. Call it on a thread of yours when
    /// [`raw::hf_solver_statistics`].rebase_advised is 1. An edit of very many sites does this by itself when that is
    /// quicker. Memory: one more factor, for as long as it eliminates sites.
    ///
    /// Fails with [`raw::HF_ERROR_BUSY`], [`raw::HF_ERROR_EMPTY`].
    pub fn prepare_rebase(&self) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_prepare_rebase(self.handle) })?;
        Ok(())
    }

    /// Writes the statistics.
    pub fn statistics(&self) -> Result<raw::hf_solver_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_solver_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_solver_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// As it was made with.
    pub fn channel_count(&self) -> usize {
        self.counts.get("channel_count").copied().unwrap_or(0)
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}
impl TryClone for Solver {
    fn try_clone(&self) -> Result<Self> {
        Solver::try_clone(self)
    }
}

object!(
    /// Computes geodesic distances on one surface: the lengths of shortest paths along it.
    Geodesics: hf_geodesics, hf_geodesics_destroy
);
impl Geodesics {
    /// Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes one
    /// numeric factorisation and holds a factor of its own beside the surface's.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`].
    pub fn new(surface: &Surface, options: &GeodesicsOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_geodesics_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Geodesics { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh. The
    /// distance is 0 at the sources, and -1 at vertices that no source can reach.
    ///
    /// sources: `[source_count]` vertices of your mesh; repeats are allowed. Paths follow the triangles and ignore links.
    /// Triangles with the same corners count once: a two-sided sheet measures as a single one. No distance of EXACT
    /// and FRONT is below the straight line to the nearest source. EXACT is right up to rounding. The error of FRONT
    /// falls with the edge length. HEAT rounds the distance off at corners and where two shortest paths meet.
    /// out: `[vertex_count]` of float or double.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`].
    pub fn solve(&self, sources: &[u32]) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sources_ = c.array(Some(sources), "sources", &["source_count"])?;
        let mut out = vec![f64::default(); c.product(&["vertex_count"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_geodesics_solve(self.handle, c.count("source_count", 1)?, sources_, &out_view) })?;
        Ok(out)
    }

    /// As `solve`, into a slice of yours.
    pub fn solve_into<P: Real>(&self, sources: &[u32], out: &mut [P]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sources_ = c.array(Some(sources), "sources", &["source_count"])?;
        c.fit(out.len(), "out", &["vertex_count"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_geodesics_solve(self.handle, c.count("source_count", 1)?, sources_, &out_view) })?;
        Ok(())
    }

    /// Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If several
    /// are as short, it writes one of them. The path is straight where its triangles are unfolded; it bends at vertices
    /// only.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_TOO_SMALL`].
    pub fn find_path(&self, from: &raw::hf_place, to: &raw::hf_place) -> Result<Path> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut path = raw::hf_path { ..Default::default() };
        c.learn("point_capacity", Call::FIRST);
        let mut all_point_edges: Vec<u32> = Vec::new();
        let mut all_parameters: Vec<f64> = Vec::new();
        let mut all_positions: Vec<f64> = Vec::new();
        loop {
            path.point_capacity = c.count("point_capacity", 0)?;
            path.point_edges = c.room(&mut all_point_edges, &["point_capacity", "2"]);
            path.parameters = c.room(&mut all_parameters, &["point_capacity"]);
            path.positions = c.room(&mut all_positions, &["point_capacity", "3"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_geodesics_find_path(self.handle, from, to, &mut path) };
            if c.enough(code, &[("point_capacity", path.point_count)])? {
                break;
            }
        }
        all_point_edges.truncate(c.product(&["point_capacity", "2"]));
        all_parameters.truncate(c.product(&["point_capacity"]));
        all_positions.truncate(c.product(&["point_capacity", "3"]));
        Ok(Path { length: path.length, point_edges: all_point_edges, parameters: all_parameters,
            positions: all_positions })
    }

    /// Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A vertex lies
    /// at the length of its shortest path from the point, in the direction in which the path starts.
    ///
    /// radius: vertices farther away get NaN too and take no time; 0 = no bound.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_TOO_SMALL`].
    pub fn map(&self, centre: &raw::hf_place, radius: f64) -> Result<(Vec<f64>, Vec<f64>)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut map = vec![f64::default(); c.product(&["vertex_count", "2"])];
        let mut frame = vec![f64::default(); c.product(&["6"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_geodesics_get_map(self.handle, centre, radius, map.as_mut_ptr(), frame.as_mut_ptr()) })?;
        Ok((map, frame))
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}

object!(
    /// A direction field on a surface, with a factor and constraints of its own.
    Direction: hf_direction, hf_direction_destroy
);
impl Direction {
    /// Makes a direction field without constraints. It computes the connection between tangent planes and the operator,
    /// and factorises once, with two unknowns per vertex.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`].
    pub fn new(surface: &Surface, options: &DirectionOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Direction { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Makes a direction field with the same constraints under the same numbers; it has the same bits. Both share
    /// connection and factor, so the copy costs the constraints only. For undo, keep copies: one before each edit.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_clone(self.handle, &mut handle_) })?;
        Ok(Direction { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each constraint
    /// costs two sparse triangular solves (elimination paths) and two rows of a small dense system. For a batch of very
    /// many constraints, the function factorises once instead, with their vertices eliminated. Later edits cost paths and
    /// rows again.
    ///
    /// vertices: `[site_count]` vertices of your mesh.
    /// vectors: `[site_count x 3]`; a zero vector makes the field 0 there.
    ///
    /// Fails with [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn add_sites(&mut self, vertices: &[u32], vectors: &[f64]) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let vertices_ = c.array(Some(vertices), "vertices", &["site_count"])?;
        let vectors_ = c.array(Some(vectors), "vectors", &["site_count", "3"])?;
        let mut sites = vec![u32::default(); c.product(&["site_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_add_sites(self.handle, c.count("site_count", 1)?, vertices_, vectors_,
            sites.as_mut_ptr()) })?;
        Ok(sites)
    }

    /// Removes constraints by number.
    ///
    /// sites: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn remove_sites(&mut self, sites: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_remove_sites(self.handle, c.count("site_count", 1)?, sites_) })?;
        Ok(())
    }

    /// Moves constraints to other vertices of the same component. The connection transports each vector along the
    /// shortest path of edges, from tangent plane to tangent plane.
    ///
    /// sites: `[site_count]`.
    /// vertices: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_OUT_OF_RANGE`].
    pub fn move_sites(&mut self, sites: &[u32], vertices: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let vertices_ = c.array(Some(vertices), "vertices", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_move_sites(self.handle, c.count("site_count", 1)?, sites_, vertices_) })?;
        Ok(())
    }

    /// Gives constraints new vectors and projects them on the tangent planes. Does not factorise.
    ///
    /// sites: `[site_count]`.
    /// vectors: `[site_count x 3]`.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn set_vectors(&mut self, sites: &[u32], vectors: &[f64]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let vectors_ = c.array(Some(vectors), "vectors", &["site_count", "3"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_set_vectors(self.handle, c.count("site_count", 1)?, sites_, vectors_) })?;
        Ok(())
    }

    /// Turns constraint i by angles`[i]` radians, counter-clockwise seen from outside. Does not factorise.
    ///
    /// sites: `[site_count]`.
    /// angles: `[site_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn rotate_sites(&mut self, sites: &[u32], angles: &[f64]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let sites_ = c.array(Some(sites), "sites", &["site_count"])?;
        let angles_ = c.array(Some(angles), "angles", &["site_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_rotate_sites(self.handle, c.count("site_count", 1)?, sites_, angles_) })?;
        Ok(())
    }

    /// Returns the number of constraints, or 0 for an invalid object.
    pub fn site_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_direction_get_site_count(self.handle) }
    }

    /// Writes the constraints. Their numbers ascend.
    pub fn sites(&self) -> Result<(Vec<u32>, Vec<u32>, Vec<f64>)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut sites: Vec<u32> = Vec::new();
        let mut vertices: Vec<u32> = Vec::new();
        let mut vectors: Vec<f64> = Vec::new();
        loop {
            let sites_at = c.room(&mut sites, &["capacity"]);
            let vertices_at = c.room(&mut vertices, &["capacity"]);
            let vectors_at = c.room(&mut vectors, &["capacity", "3"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_direction_get_sites(self.handle, c.count("capacity", 0)?, sites_at, vertices_at,
                vectors_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        sites.truncate(c.product(&["capacity"]));
        vertices.truncate(c.product(&["capacity"]));
        vectors.truncate(c.product(&["capacity", "3"]));
        Ok((sites, vertices, vectors))
    }

    /// Writes the field as vectors in space. The vectors are tangent to the surface up to 1e-12 of their length. For
    /// degree 2 or 4 the function writes one of the 2 or 4 directions. Constrained vertices hold their vectors; vertices
    /// that no constraint reaches get 0.
    ///
    /// out: `[vertex_count x 3]` of float or double.
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`].
    pub fn solve(&self) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        let mut out = vec![f64::default(); c.product(&["vertex_count", "3"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_solve(self.handle, &out_view, &mut info) })?;
        Ok(out)
    }

    /// As `solve`, into a slice of yours. Returns the figures of the call.
    pub fn solve_into<P: Real>(&self, out: &mut [P]) -> Result<raw::hf_solve_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_solve_info::default();
        c.fit(out.len(), "out", &["vertex_count", "3"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_solve(self.handle, &out_view, &mut info) })?;
        Ok(info)
    }

    /// Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section 5). On a
    /// closed manifold component of one orientation the indices sum to degree times the Euler characteristic.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`].
    pub fn singularities(&self) -> Result<Vec<raw::hf_singularity>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut singularities: Vec<raw::hf_singularity> = Vec::new();
        loop {
            let singularities_at = c.room(&mut singularities, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_direction_get_singularities(self.handle, c.count("capacity", 0)?,
                singularities_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        singularities.truncate(c.product(&["capacity"]));
        Ok(singularities)
    }

    /// Writes the statistics.
    pub fn statistics(&self) -> Result<raw::hf_direction_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_direction_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_direction_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}
impl TryClone for Direction {
    fn try_clone(&self) -> Result<Self> {
        Direction::try_clone(self)
    }
}

object!(
    /// A set of handles on a surface.
    Pose: hf_pose, hf_pose_destroy
);
impl Pose {
    /// Creates a pose without handles.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn new(surface: &Surface, options: &PoseOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Pose { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Copies a pose with its handles and transforms, so that several threads can pose one rig.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_clone(self.handle, &mut handle_) })?;
        Ok(Pose { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The next
    /// Pose.deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke moves next to
    /// nothing, also where handles of free rotation could rest in two poses. With restart the frame equals the frame of a
    /// new pose on `surface`, to 1e-6 of the box.
    ///
    /// surface: any number of calls of `Surface::edit` or `Surface::relink` make it from the pose's surface, or the
    /// pose's surface from it.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn move_to(&mut self, surface: &Surface) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.parent("surface", &surface.counts);
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_move_to(self.handle, surface.handle) })?;
        self.counts.extend(surface.counts.clone());
        Ok(())
    }

    /// Writes the options of a pose.
    pub fn info(&self) -> Result<raw::hf_pose_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_pose_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls a posed
    /// surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the rigid motion of
    /// its region in the last pose (`Pose::handle` writes it). The surface stays in place (to 1e-6 of the box). It goes
    /// over to the best pose of the new handles while handles move by 0.05 of the box, or back to rest. Until then the
    /// region of the new handle keeps a part of its bend. restart ends this at once. On a higher layer the surface does
    /// not move (to 1e-9 of the box) until you move the handle. Handles of lower layers hold the surface in place for the
    /// higher layers.
    ///
    /// region_vertices: lists of whole numbers: all regions one after the other; `None`: places are given
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn add_handles(&mut self, region_vertices: Option<&[&[u32]]>, handles: &HandlesOptions) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = handles.fill(&mut c, "", region_vertices)?;
        let mut handles = vec![u32::default(); c.product(&["handle_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_add_handles(self.handle, &desc, handles.as_mut_ptr()) })?;
        Ok(handles)
    }

    /// Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all vertices within
    /// `radius` of the point that are edge-connected to this vertex.
    ///
    /// point: `[3]`.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn add_handle_at(&mut self, point: &[f64], radius: f64) -> Result<u32> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let point_ = c.array(Some(point), "point", &["3"])?;
        let mut handle = u32::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_add_handle_at(self.handle, point_, radius, &mut handle) })?;
        Ok(handle)
    }

    /// Removes handles by number. A handle on a higher layer takes its edit with it: the surface is then, bit for bit, as
    /// if the handle had never been added. On layer 0 this holds when you remove the handles that were added last, and
    /// for frames with `restart`.
    ///
    /// handles: `[handle_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn remove_handles(&mut self, handles: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_remove_handles(self.handle, c.count("handle_count", 1)?, handles_) })?;
        Ok(())
    }

    /// Places handles. On layer 0 a transform is a motion from the rest place. On a higher layer it is an edit in the
    /// rest frame of the handle. There the region moves by F (edit) F^-1, with F the rigid motion that the lower layers
    /// give the handle. Rotations continue from call to call, so a handle that you dragged past 180 degrees stays turned
    /// that far. The transforms take effect at the next Pose.deform.
    ///
    /// handles: `[handle_count]`.
    /// rotations: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
    /// translations: up to 1e15 box diagonals
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn set_transforms(&mut self, handles: &[u32], rotations: Option<&[f64]>,
            translations: Option<&[f64]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        let mut transforms = vec![raw::hf_transform::default(); c.product(&["handle_count"])];
        if let Some(given) = rotations {
            c.fit(given.len(), "rotations", &["4", "handle_count"])?;
            for (row, numbers) in transforms.iter_mut().zip(given.chunks_exact(4)) {
                row.rotation.copy_from_slice(numbers);
            }
        }
        if let Some(given) = translations {
            c.fit(given.len(), "translations", &["3", "handle_count"])?;
            for (row, numbers) in transforms.iter_mut().zip(given.chunks_exact(3)) {
                row.translation.copy_from_slice(numbers);
            }
        }
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_transforms(self.handle, c.count("handle_count", 1)?, handles_,
            transforms.as_ptr()) })?;
        Ok(())
    }

    /// Places one handle.
    ///
    /// rotation: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
    /// translation: up to 1e15 box diagonals
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn set_transform(&mut self, handle: u32, rotation: Option<[f64; 4]>,
            translation: Option<[f64; 3]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut transform = raw::hf_transform::default();
        if let Some(given) = rotation { transform.rotation = given; }
        if let Some(given) = translation { transform.translation = given; }
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_transform(self.handle, handle, &transform) })?;
        Ok(())
    }

    /// Frees the rotations of handles, or lets you give them again. A handle of free rotation is a positional constraint
    /// (Sorkine and Alexa 2007). Its centroid lands exactly where its transform puts it; the rotation of the transform is
    /// ignored. Each Pose.deform finds the rotation together with the pose, and `Pose::handle` writes it. The rotation
    /// has the least as-rigid-as-possible energy. The energy of a pulled group of vertices is measured from a longer and
    /// thinner shape than the rest shape of the group. So the rotation is not exactly the rotation of least energy from
    /// the rest shape.
    ///
    /// Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation while the user
    /// turns a ring. A given rotation starts at the present rotation of the handle, so the pose does not change. When you
    /// free a rotation on layer 0, the surface stays as it is. It releases the old rotation as handles move, as with
    /// in_place; so move the handles after this call. On a higher layer a changed handle moves the surface at the next
    /// frame. A handle alone in its component keeps its rotation. The first frame of a pose, and a frame with restart,
    /// move free handles to their places in 8 steps, as a drag does. Such a frame takes the time of about 8 pose solves.
    /// refine keeps the rotation of the smooth pose.
    ///
    /// handles: `[handle_count]`.
    /// free_rotation: 1: the solve finds the rotations; 0: you give them.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn set_free_rotations(&mut self, handles: &[u32], free_rotation: bool) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_free_rotations(self.handle, c.count("handle_count", 1)?, handles_,
            i32::from(free_rotation)) })?;
        Ok(())
    }

    /// Sets how much of the surface follows handles of layer 0. Below 1, soft pins hold the surface where it would be
    /// without these handles. So a body does not lean after a dragged hand. Where the field of the handle is near 1, the
    /// pins are weak, so the limb stays free. Keep 1 for the handles that hold the body, and set less for a handle that
    /// is dragged. Every handle still lands exactly, and a limb that is too short gets longer. The next Pose.deform shows
    /// a change at once. But a handle that was just added in place leaves the surface where it stands until a handle
    /// moves. Full-mesh steps (refine) ignore the pins. Repeated steps (refine_from_last) let the body lean again.
    ///
    /// handles: `[handle_count]`.
    /// following: 0 to 1. At 1 all of the surface follows the handle; a new handle has 1. At 0 only the limb of the
    /// handle follows, such as an arm.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn set_following(&mut self, handles: &[u32], following: f64) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_following(self.handle, c.count("handle_count", 1)?, handles_, following) })?;
        Ok(())
    }

    /// Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. The limb is
    /// the part of the surface where the field of the handle falls a long way over little area. It ends at the trunk, or
    /// at the next handle on the limb. The steps move the limb alone. All other vertices keep their bits, so the body
    /// leans no more than without the steps. A limb that is pulled beyond its length is stretched evenly. The limbs take
    /// their steps after the steps of [`DeformOptions`].refine. If handles have different counts of steps, all their
    /// limbs take the largest count.
    ///
    /// handles: `[handle_count]`.
    /// refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a new handle. With 1,
    /// bends stay smooth. With 8 and more, most edges keep their lengths to a few per cent, and the limb bends like
    /// two bones. Edges beside the handle can change more.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn set_limb_refine(&mut self, handles: &[u32], refine: i32) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_limb_refine(self.handle, c.count("handle_count", 1)?, handles_, refine) })?;
        Ok(())
    }

    /// Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. Each frame
    /// moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near links count
    /// most in this fit. If the region of a handle touches a rigid piece, the whole piece joins the region and moves with
    /// the handle. A second handle on the same piece is refused ([`raw::HF_ERROR_CONFLICT`]). Call this function before
    /// you add such handles. `Pose::skin` writes the motions before this fit.
    ///
    /// vertices: `[vertex_count]`, one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
    /// replaces the previous list.
    ///
    /// Fails with [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`].
    pub fn set_rigid_pieces(&mut self, vertices: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.sizes.remove("vertex_count"); // of the list given here
        let vertices_ = c.array(Some(vertices), "vertices", &["vertex_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_rigid_pieces(self.handle, c.count("vertex_count", 1)?, vertices_) })?;
        Ok(())
    }

    /// Places handles by 4 x 4 matrices M.
    ///
    /// handles: `[handle_count]`.
    /// matrices: `[handle_count x 16]`, column by column. The last column is the translation. M moves a rest position p
    /// to the posed position M p. Its linear part must be a rotation within 1e-4; the function takes the nearest
    /// rotation. Its last row must be 0 0 0 1.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_FOUND`].
    pub fn set_matrices(&mut self, handles: &[u32], matrices: &[f64]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let handles_ = c.array(Some(handles), "handles", &["handle_count"])?;
        let matrices_ = c.array(Some(matrices), "matrices", &["handle_count", "16"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_set_matrices(self.handle, c.count("handle_count", 1)?, handles_, matrices_) })?;
        Ok(())
    }

    /// Writes the info of a handle.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn handle(&self, handle: u32) -> Result<raw::hf_handle_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_handle_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_handle(self.handle, handle, &mut info) })?;
        Ok(info)
    }

    /// Returns the number of handles, or 0 for an invalid object.
    pub fn handle_count(&self) -> u32 {
        // SAFETY: the handle is valid.
        unsafe { raw::hf_pose_get_handle_count(self.handle) }
    }

    /// Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a handle
    /// reaches, the fields of all handles sum to 1.
    ///
    /// out: `[vertex_count]` of float or double.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn field(&self, handle: u32) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut out = vec![f64::default(); c.product(&["vertex_count"])];
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_field(self.handle, handle, &out_view) })?;
        Ok(out)
    }

    /// As `field`, into a slice of yours.
    pub fn field_into<P: Real>(&self, handle: u32, out: &mut [P]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.fit(out.len(), "out", &["vertex_count"])?;
        let out_view = c.out(out.as_mut_ptr(), "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_field(self.handle, handle, &out_view) })?;
        Ok(())
    }

    /// Does the same as Pose.deform, with the options of a desc.
    ///
    /// out: `[vertex_count x 3]` of float or double: posed positions
    /// normals: `[vertex_count x 3]` of float or double: unit normals of the posed surface, shared across seams
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`].
    pub fn deform(&mut self, options: &DeformOptions) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_deform_info::default();
        let mut desc = options.fill(&mut c, "")?;
        let mut out = vec![f64::default(); c.product(&["vertex_count", "3"])];
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at: *mut f32 = std::ptr::null_mut();
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_deform(self.handle, &desc, &mut info) })?;
        Ok(out)
    }

    /// As `deform`, into a slice of yours. Returns the figures of the call.
    pub fn deform_into<P: Real>(&mut self, out: &mut [P], normals: Option<&mut [f32]>,
            options: &DeformOptions) -> Result<raw::hf_deform_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_deform_info::default();
        let mut desc = options.fill(&mut c, "")?;
        c.fit(out.len(), "out", &["vertex_count", "3"])?;
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at = c.fill(normals, "normals", &["vertex_count", "3"])?;
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_deform(self.handle, &desc, &mut info) })?;
        Ok(info)
    }

    /// Writes the statistics of a pose.
    pub fn statistics(&self) -> Result<raw::hf_pose_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_pose_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were
    /// added. If the handles do not reach some vertices, a last joint that never moves holds those vertices. The weights
    /// of a vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in single precision. Weights and pivots
    /// change only when handles are added or removed.
    ///
    /// The joint motions bring the skin as near as possible to the last Pose.deform, as it is without refine. With
    /// scales, classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales, bends and twists
    /// replay within 1 per cent and stretched surfaces within about 2.5 per cent.
    ///
    /// influence_count: joints per vertex, 4 or 8; 0 = 4
    /// scales: `[joint_capacity x 3]` along the axes in the last frame; `None` = joints are rigid
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn skin(&self, influence_count: u32, want_scales: bool) -> Result<SkinInfo> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut skin = raw::hf_skin_info { influence_count: influence_count, ..Default::default() };
        c.learn("influence_count", if influence_count == 0 { 4 } else { influence_count as usize });
        c.learn("joint_capacity", c.size("joint_count").unwrap_or(Call::FIRST));
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_pivots: Vec<f64> = Vec::new();
        let mut all_rotations: Vec<f64> = Vec::new();
        let mut all_translations: Vec<f64> = Vec::new();
        let mut all_axes: Vec<f64> = Vec::new();
        let mut all_scales: Vec<f64> = Vec::new();
        let mut all_vertex_joints: Vec<u32> = Vec::new();
        let mut all_vertex_weights: Vec<f32> = Vec::new();
        loop {
            skin.joint_capacity = c.count("joint_capacity", 0)?;
            skin.vertex_capacity = c.count("vertex_capacity", 0)?;
            skin.pivots = c.room(&mut all_pivots, &["joint_capacity", "3"]);
            skin.rotations = c.room(&mut all_rotations, &["joint_capacity", "4"]);
            skin.translations = c.room(&mut all_translations, &["joint_capacity", "3"]);
            skin.axes = c.room(&mut all_axes, &["joint_capacity", "4"]);
            skin.scales = if want_scales { c.room(&mut all_scales, &["joint_capacity",
                "3"]) } else { std::ptr::null_mut() };
            skin.vertex_joints = c.room(&mut all_vertex_joints, &["vertex_capacity", "influence_count"]);
            skin.vertex_weights = c.room(&mut all_vertex_weights, &["vertex_capacity", "influence_count"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_pose_get_skin(self.handle, &mut skin) };
            if c.enough(code, &[("joint_capacity", skin.joint_count), ("vertex_capacity", skin.vertex_count)])? {
                break;
            }
        }
        all_pivots.truncate(c.product(&["joint_capacity", "3"]));
        all_rotations.truncate(c.product(&["joint_capacity", "4"]));
        all_translations.truncate(c.product(&["joint_capacity", "3"]));
        all_axes.truncate(c.product(&["joint_capacity", "4"]));
        all_scales.truncate(c.product(&["joint_capacity", "3"]));
        all_vertex_joints.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_vertex_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        Ok(SkinInfo { influence_count: skin.influence_count, pivots: all_pivots, rotations: all_rotations,
            translations: all_translations, axes: all_axes, scales: all_scales, vertex_joints: all_vertex_joints,
            vertex_weights: all_vertex_weights })
    }

    /// Writes the info of a blend.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn blend_info(&self) -> Result<raw::hf_blend_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_blend_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_get_blend_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts, then with
    /// arrays. If handles do not reach some vertices, a last cluster that never moves holds those vertices.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn blend_rows(&self) -> Result<BlendRows> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut rows = raw::hf_blend_rows { ..Default::default() };
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        c.learn("entry_capacity", Call::FIRST);
        let mut all_rows: Vec<u32> = Vec::new();
        let mut all_clusters: Vec<u16> = Vec::new();
        let mut all_weights: Vec<f32> = Vec::new();
        let mut all_gradients: Vec<f32> = Vec::new();
        let mut all_positions: Vec<f32> = Vec::new();
        let mut all_normals: Vec<f32> = Vec::new();
        let mut all_offsets: Vec<f32> = Vec::new();
        loop {
            rows.vertex_capacity = c.count("vertex_capacity", 0)?;
            rows.entry_capacity = c.count("entry_capacity", 0)?;
            rows.rows = c.room(&mut all_rows, &["vertex_capacity", "2"]);
            rows.clusters = c.room(&mut all_clusters, &["entry_capacity"]);
            rows.weights = c.room(&mut all_weights, &["entry_capacity"]);
            rows.gradients = c.room(&mut all_gradients, &["entry_capacity", "3"]);
            rows.positions = c.room(&mut all_positions, &["vertex_capacity", "3"]);
            rows.normals = c.room(&mut all_normals, &["vertex_capacity", "3"]);
            rows.offsets = c.room(&mut all_offsets, &["vertex_capacity", "3"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_pose_get_blend_rows(self.handle, &mut rows) };
            if c.enough(code, &[("vertex_capacity", rows.vertex_count), ("entry_capacity", rows.entry_count)])? {
                break;
            }
        }
        all_rows.truncate(c.product(&["vertex_capacity", "2"]));
        all_clusters.truncate(c.product(&["entry_capacity"]));
        all_weights.truncate(c.product(&["entry_capacity"]));
        all_gradients.truncate(c.product(&["entry_capacity", "3"]));
        all_positions.truncate(c.product(&["vertex_capacity", "3"]));
        all_normals.truncate(c.product(&["vertex_capacity", "3"]));
        all_offsets.truncate(c.product(&["vertex_capacity", "3"]));
        Ok(BlendRows { longest_row: rows.longest_row, rows: all_rows, clusters: all_clusters, weights: all_weights,
            gradients: all_gradients, positions: all_positions, normals: all_normals, offsets: all_offsets })
    }

    /// Writes rows of one length. They change with `revision`, as the rows of `Pose::blend_rows` do. Call it without
    /// arrays for the count and the errors.
    ///
    /// influence_count: clusters of each vertex, the length of a row, 1 to 64; 0 = 8
    /// byte_clusters: `[vertex_capacity x influence_count]` `None` = not wanted. Refused for more than 256 clusters
    /// byte_weights: `[vertex_capacity x influence_count]` `None` = not wanted. 255ths, of sum 255; weights that round to
    /// 0 are left out
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn blend_influences(&self, influence_count: u32, want_byte_clusters: bool,
            want_byte_weights: bool) -> Result<BlendInfluences> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut influences = raw::hf_blend_influences { influence_count: influence_count, ..Default::default() };
        c.learn("influence_count", if influence_count == 0 { 8 } else { influence_count as usize });
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_clusters: Vec<u16> = Vec::new();
        let mut all_weights: Vec<u16> = Vec::new();
        let mut all_byte_clusters: Vec<u8> = Vec::new();
        let mut all_byte_weights: Vec<u8> = Vec::new();
        loop {
            influences.vertex_capacity = c.count("vertex_capacity", 0)?;
            influences.clusters = c.room(&mut all_clusters, &["vertex_capacity", "influence_count"]);
            influences.weights = c.room(&mut all_weights, &["vertex_capacity", "influence_count"]);
            influences.byte_clusters = if want_byte_clusters { c.room(&mut all_byte_clusters, &["vertex_capacity",
                "influence_count"]) } else { std::ptr::null_mut() };
            influences.byte_weights = if want_byte_weights { c.room(&mut all_byte_weights, &["vertex_capacity",
                "influence_count"]) } else { std::ptr::null_mut() };
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_pose_get_blend_influences(self.handle, &mut influences) };
            if c.enough(code, &[("vertex_capacity", influences.vertex_count)])? {
                break;
            }
        }
        all_clusters.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_byte_clusters.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_byte_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        Ok(BlendInfluences { change: influences.change, byte_change: influences.byte_change, error: influences.error,
            byte_error: influences.byte_error, influence_count: influences.influence_count, clusters: all_clusters,
            weights: all_weights, byte_clusters: all_byte_clusters, byte_weights: all_byte_weights })
    }

    /// Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
    /// `Pose::deform`. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as much as
    /// Pose.deform.
    ///
    /// iteration_count: 1 to 1000; 0 = as in [`PoseOptions`].
    /// restart: 1: as in [`DeformOptions`].
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn solve(&mut self, iteration_count: u32, restart: bool) -> Result<raw::hf_deform_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_deform_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_pose_solve(self.handle, iteration_count, i32::from(restart), &mut info) })?;
        Ok(info)
    }

    /// Writes the transforms of the clusters in the last `Pose::solve` or Pose.deform, without its refine. Before the
    /// first solve they are identities. After handles were added or removed, solve before you read them: they may be
    /// identities until then. The call allocates nothing.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn blend_transforms(&self) -> Result<Vec<f32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut transforms: Vec<f32> = Vec::new();
        loop {
            let transforms_at = c.room(&mut transforms, &["capacity", "12"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_pose_get_blend_transforms(self.handle, c.count("capacity", 0)?, transforms_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        transforms.truncate(c.product(&["capacity", "12"]));
        Ok(transforms)
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}
impl TryClone for Pose {
    fn try_clone(&self) -> Result<Self> {
        Pose::try_clone(self)
    }
}

object!(
    /// Quads.
    Quads: hf_quads, hf_quads_destroy
);
impl Quads {
    /// Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature. Creases and
    /// borders are straight lines of edges. Irregular vertices are the singularities of the crosses, and places where the
    /// function split quads to keep to the surface.
    ///
    /// The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge lengths,
    /// it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal keeps nearer
    /// to the surface, so a renderer should split quads into triangles from the first corner. If the mesh stays farther
    /// than an edge length from the surface, a limb is lost. Then the function makes up to three finer meshes, and
    /// removes rows of quads until the number is right. The function checks every result. Each directed edge occurs once.
    /// No face repeats a corner. The result has the Euler characteristic of the surface.
    ///
    /// The surface may have borders, any genus and several components; the function turns triangles that disagree in
    /// orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two. A
    /// triangle without a partner gets a border. `Surface::report` counts such edges. A Moebius band is parted across.
    ///
    /// With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding. Half
    /// of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the side of the
    /// normal counts.
    ///
    /// The user can place irregular vertices and drag them. The function makes each by guides on a ring around the place,
    /// an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000 irregular vertices
    /// at random places of 20 meshes come out within an edge of the place; such a vertex then moves to the place and
    /// stays there. A vertex of 5 quads brings others of 3 with it, because the indices of the crosses sum to four times
    /// the Euler characteristic. On a torus or a knot a single one of 5 is often lost.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INTERNAL`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn new(surface: &Surface, options: &QuadsOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_quads_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Quads { handle: handle_, counts: c.counts(&[]) })
    }

    /// Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. `Quads::new`
    /// with the same options gives the same result, bit for bit. The first update takes as long. It keeps the tables that
    /// do not depend on guides, creases and relax_count. Later updates with the same edge_length, face_count and
    /// symmetry_plane take less time. Without relaxation (relax_count = [`raw::HF_NO_INDEX`]) they take 0.1 s for 15,000
    /// vertices. Use that while the user drags, and relax_count = 0 at the end. Other sizes and planes are allowed; what
    /// belongs to them is made again. After an error `quads` is unchanged. Kept memory: 2 to 4 kB per vertex, until
    /// `quads` is destroyed.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INTERNAL`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn update(&mut self, options: &QuadsOptions) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = options.fill(&mut c, "")?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_quads_update(self.handle, &desc) })?;
        Ok(())
    }

    /// Writes the counts.
    pub fn info(&self) -> Result<raw::hf_quads_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_quads_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_quads_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes every array that is not `None`.
    ///
    /// Fails with [`raw::HF_ERROR_TOO_SMALL`].
    pub fn mesh(&self) -> Result<QuadsMesh> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut mesh = raw::hf_quads_mesh { ..Default::default() };
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        c.learn("face_capacity", Call::FIRST);
        let mut all_positions: Vec<f64> = Vec::new();
        let mut all_faces: Vec<u32> = Vec::new();
        let mut all_triangles: Vec<u32> = Vec::new();
        let mut all_barycentrics: Vec<f64> = Vec::new();
        let mut all_corners: Vec<u32> = Vec::new();
        loop {
            mesh.vertex_capacity = c.count("vertex_capacity", 0)?;
            mesh.face_capacity = c.count("face_capacity", 0)?;
            mesh.positions = c.room(&mut all_positions, &["vertex_capacity", "3"]);
            mesh.faces = c.room(&mut all_faces, &["face_capacity", "4"]);
            mesh.triangles = c.room(&mut all_triangles, &["vertex_capacity"]);
            mesh.barycentrics = c.room(&mut all_barycentrics, &["vertex_capacity", "3"]);
            mesh.corners = c.room(&mut all_corners, &["vertex_capacity", "3"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_quads_get_mesh(self.handle, &mut mesh) };
            if c.enough(code, &[("vertex_capacity", mesh.vertex_count), ("face_capacity", mesh.face_count)])? {
                break;
            }
        }
        all_positions.truncate(c.product(&["vertex_capacity", "3"]));
        all_faces.truncate(c.product(&["face_capacity", "4"]));
        all_triangles.truncate(c.product(&["vertex_capacity"]));
        all_barycentrics.truncate(c.product(&["vertex_capacity", "3"]));
        all_corners.truncate(c.product(&["vertex_capacity", "3"]));
        Ok(QuadsMesh { positions: all_positions, faces: all_faces, triangles: all_triangles,
            barycentrics: all_barycentrics, corners: all_corners })
    }
}

object!(
    /// A surface that is prepared for tracing streamlines.
    Flow: hf_flow, hf_flow_destroy
);
impl Flow {
    /// Prepares a surface for tracing: computes half-edges and weights.
    ///
    /// Fails with [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn new(surface: &Surface) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_flow_create(surface.handle, &mut handle_) })?;
        Ok(Flow { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
    /// [`raw::HF_OPERATOR_CLAMPED`] the lines are denser where the field is steeper. `Surface::trace_isolines` gives the
    /// lines that cross the streamlines.
    ///
    /// field: `[vertex_count]` of float or double.
    /// seeds: `[seed_count]` vertices of your mesh
    /// wanted_count: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`].
    pub fn trace<'i>(&self, field: impl Into<Reals<'i>>, seeds: Option<&[u32]>,
            wanted_count: u32) -> Result<Streamlines> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let field_ = c.view(Some(field.into().numbers()), "field", &["vertex_count"])?;
        let mut lines = raw::hf_streamlines { wanted_count: wanted_count, ..Default::default() };
        lines.seeds = c.array(seeds, "seeds", &["seed_count"])?;
        lines.seed_count = c.count("seed_count", 0)?;
        c.learn("point_capacity", Call::FIRST);
        c.learn("line_capacity", Call::FIRST);
        let mut all_positions: Vec<f64> = Vec::new();
        let mut all_values: Vec<f64> = Vec::new();
        let mut all_line_starts: Vec<u32> = Vec::new();
        let mut all_line_ends: Vec<u32> = Vec::new();
        loop {
            lines.point_capacity = c.count("point_capacity", 0)?;
            lines.line_capacity = c.count("line_capacity", 0)?;
            lines.positions = c.room(&mut all_positions, &["point_capacity", "3"]);
            lines.values = c.room(&mut all_values, &["point_capacity"]);
            lines.line_starts = c.room(&mut all_line_starts, &["line_capacity + 1"]);
            lines.line_ends = c.room(&mut all_line_ends, &["line_capacity", "2"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_flow_trace(self.handle, &field_, &mut lines) };
            if c.enough(code, &[("point_capacity", lines.point_count), ("line_capacity", lines.line_count)])? {
                break;
            }
        }
        all_positions.truncate(c.product(&["point_capacity", "3"]));
        all_values.truncate(c.product(&["point_capacity"]));
        all_line_starts.truncate(c.product(&["line_capacity + 1"]));
        all_line_ends.truncate(c.product(&["line_capacity", "2"]));
        Ok(Streamlines { positions: all_positions, values: all_values, line_starts: all_line_starts,
            line_ends: all_line_ends })
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}

object!(
    /// A region of a surface and its smooth base.
    Region: hf_region, hf_region_destroy
);
impl Region {
    /// Creates a region without vertices.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_NOT_POSITIVE_DEFINITE`].
    pub fn new(surface: &Surface, options: &RegionOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_create(surface.handle, &desc, &mut handle_) })?;
        Ok(Region { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo, keep copies:
    /// one before each edit.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_clone(self.handle, &mut handle_) })?;
        Ok(Region { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Changes the region and computes its new base. The vertices next to the region (its rim) are sites with their
    /// positions as values. Sites that stay cost nothing; the others are one batch as in `Solver::edit_sites`. One
    /// backward sweep over the factor then gives the base; for a small region the sweep covers only the part of the
    /// factor that its vertices need. A region may have several pieces, in several components. Progress covers curve,
    /// sites and base; the call can be cancelled between them.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn edit(&mut self, edit: &RegionEditOptions) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = edit.fill(&mut c, "")?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_edit(self.handle, &desc) })?;
        Ok(())
    }

    /// Writes the info of a region.
    pub fn info(&self) -> Result<raw::hf_region_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_region_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the statistics of a region.
    pub fn statistics(&self) -> Result<raw::hf_region_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_region_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first copy.
    ///
    /// list: `HF_REGION_*`.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn vertices(&self, list: i32) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut vertices: Vec<u32> = Vec::new();
        loop {
            let vertices_at = c.room(&mut vertices, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_region_get_vertices(self.handle, list, c.count("capacity", 0)?, vertices_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        vertices.truncate(c.product(&["capacity"]));
        Ok(vertices)
    }

    /// Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of the positions in
    /// [`RegionOptions`]. The last corner is joined to the first. Rings, added and removed vertices leave it as it is.
    pub fn curve(&self) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut points: Vec<f64> = Vec::new();
        loop {
            let points_at = c.room(&mut points, &["capacity", "3"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_region_get_curve(self.handle, c.count("capacity", 0)?, points_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        points.truncate(c.product(&["capacity", "3"]));
        Ok(points)
    }

    /// Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
    /// [`RegionOptions`]. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A
    /// weight below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p. The call
    /// solves nothing.
    ///
    /// weight: any finite number
    /// out: `[vertex_count x 3]` of float or double, in the unit of the mesh
    /// normals: `[vertex_count x 3]` of float or double: unit normals of the morphed surface, shared across seams
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn morph(&self, weight: f64) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = MorphOptions {}.fill(&mut c, "", weight)?;
        let mut out = vec![f64::default(); c.product(&["vertex_count", "3"])];
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at: *mut f32 = std::ptr::null_mut();
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_morph(self.handle, &desc) })?;
        Ok(out)
    }

    /// As `morph`, into a slice of yours.
    pub fn morph_into<P: Real>(&self, weight: f64, out: &mut [P], normals: Option<&mut [f32]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = MorphOptions {}.fill(&mut c, "", weight)?;
        c.fit(out.len(), "out", &["vertex_count", "3"])?;
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at = c.fill(normals, "normals", &["vertex_count", "3"])?;
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_region_morph(self.handle, &desc) })?;
        Ok(())
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}
impl TryClone for Region {
    fn try_clone(&self) -> Result<Self> {
        Region::try_clone(self)
    }
}

object!(
    /// The detail of a source region, transferred to a target region. Both may be on one surface or on two.
    Detail: hf_detail, hf_detail_destroy
);
impl Detail {
    /// Carries the detail of the source region to the target region. A harmonic map with positive weights takes each
    /// region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim) lie on the
    /// circle, by arc length between the pairs of desc. Points at the same place in the disc correspond. The function
    /// stores the offset from base to surface in a local frame of the source. The axes of the frame are the normal of the
    /// base and the direction in which the first disc coordinate grows. It interpolates the offsets in the triangles of
    /// the source, and applies them in the same frames of the target. The detail fades to nothing at the rim. If source
    /// and target are the same region, the result is the surface itself. Later edits of the regions do not change the
    /// object.
    ///
    /// Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn new(source: &Region, target: &Region, options: &DetailOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("source", &source.counts);
        c.parent("target", &target.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_detail_create(source.handle, target.handle, &desc, &mut handle_) })?;
        Ok(Detail { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight
    /// (transferred detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the detail as
    /// it was on the source. A weight above 1 exaggerates the detail, and a weight below 0 turns it inside out.
    ///
    /// weight: any finite number
    /// out: `[vertex_count x 3]` of float or double, in the unit of the mesh
    /// normals: `[vertex_count x 3]` of float or double: unit normals of the morphed surface, shared across seams
    ///
    /// Fails with [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn morph(&self, weight: f64) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = MorphOptions {}.fill(&mut c, "", weight)?;
        let mut out = vec![f64::default(); c.product(&["vertex_count", "3"])];
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at: *mut f32 = std::ptr::null_mut();
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_detail_morph(self.handle, &desc) })?;
        Ok(out)
    }

    /// As `morph`, into a slice of yours.
    pub fn morph_into<P: Real>(&self, weight: f64, out: &mut [P], normals: Option<&mut [f32]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = MorphOptions {}.fill(&mut c, "", weight)?;
        c.fit(out.len(), "out", &["vertex_count", "3"])?;
        desc.positions = c.out(out.as_mut_ptr(), "vertex_count");
        let normals_at = c.fill(normals, "normals", &["vertex_count", "3"])?;
        desc.normals = c.out(normals_at, "vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_detail_morph(self.handle, &desc) })?;
        Ok(())
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}

object!(
    /// The motion of one skeleton on another.
    Retarget: hf_retarget, hf_retarget_destroy
);
impl Retarget {
    /// Pairs the joints of two skeletons.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn new(source: &Skeleton, target: &Skeleton, options: &RetargetOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("source", &source.counts);
        c.parent("target", &target.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_retarget_create(source.handle, target.handle, &desc, &mut handle_) })?;
        Ok(Retarget { handle: handle_, counts: c.counts(&["joint_count"]) })
    }

    /// Copies a retarget with the state of its feet: for another character with the same skeletons, and for undo.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_retarget_clone(self.handle, &mut handle_) })?;
        Ok(Retarget { handle: handle_, counts: c.counts(&["joint_count"]) })
    }

    /// Computes the pose of the target. The frame depends on the source pose and on the state of the feet: whether each
    /// is planted, and how far it is moved to keep its place. The state comes from the frames since the last reset and
    /// fades within a step.
    ///
    /// source_pose: `[source.joint_count x 10]`.
    /// seconds: time since the last frame, 0 for the first frame and for a repeated frame.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn solve(&mut self, source_pose: &[f32], seconds: f64) -> Result<Vec<f32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let source_pose_ = c.array(Some(source_pose), "source_pose", &["source.joint_count", "10"])?;
        let mut target_pose = vec![f32::default(); c.product(&["target.joint_count", "10"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_retarget_solve(self.handle, source_pose_, seconds, target_pose.as_mut_ptr()) })?;
        Ok(target_pose)
    }

    /// Forgets the state of the feet and the figures of the info. Call it where the clip jumps.
    pub fn reset(&mut self) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_retarget_reset(self.handle) })?;
        Ok(())
    }

    /// Writes the figures.
    pub fn info(&self) -> Result<raw::hf_retarget_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_retarget_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_retarget_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes how chains follow.
    pub fn chains(&self) -> Result<Vec<raw::hf_chain_match>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut chains: Vec<raw::hf_chain_match> = Vec::new();
        loop {
            let chains_at = c.room(&mut chains, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_retarget_get_chains(self.handle, c.count("capacity", 0)?, chains_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        chains.truncate(c.product(&["capacity"]));
        Ok(chains)
    }

    /// Writes which joint of the source each joint of the target follows. A joint between two gets the nearer, a joint
    /// without a partner [`raw::HF_NO_INDEX`].
    pub fn partners(&self) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut partners: Vec<u32> = Vec::new();
        loop {
            let partners_at = c.room(&mut partners, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_retarget_get_partners(self.handle, c.count("capacity", 0)?, partners_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        partners.truncate(c.product(&["capacity"]));
        Ok(partners)
    }

    /// As it was made with.
    pub fn joint_count(&self) -> usize {
        self.counts.get("joint_count").copied().unwrap_or(0)
    }
}
impl TryClone for Retarget {
    fn try_clone(&self) -> Result<Self> {
        Retarget::try_clone(self)
    }
}

object!(
    /// A skeleton at rest and the findings about it. Calls read the object, none changes it.
    Skeleton: hf_skeleton, hf_skeleton_destroy
);
impl Skeleton {
    /// Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a walk. It
    /// is 0 for a clip that travels.
    ///
    /// poses: `[frame_count x joint_count x 10]`.
    /// seconds: between two frames, above 0.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn ground_velocity(&self, poses: &[f32], seconds: f64) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let poses_ = c.array(Some(poses), "poses", &["frame_count", "joint_count", "10"])?;
        let mut velocity = vec![f64::default(); c.product(&["3"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_skeleton_get_ground_velocity(self.handle, c.count("frame_count", 1)?, poses_, seconds,
            velocity.as_mut_ptr()) })?;
        Ok(velocity)
    }

    /// Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it if
    /// feet shall stand on the ground. The object keeps a copy of everything.
    ///
    /// names: one line for each joint in UTF-8, or `None`: names then say nothing
    /// parents: `[joint_count]` number of the parent, [`raw::HF_NO_INDEX`] for a root
    /// rest: `[joint_count x 10]` joint transforms
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn new(names: Option<&[&str]>, parents: &[u32], rest: &[f32], options: &SkeletonOptions) -> Result<Self> {
        let mut c = Call::default();
        let desc = options.fill(&mut c, "", names, Some(parents), Some(rest))?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_skeleton_create(&desc, &mut handle_) })?;
        Ok(Skeleton { handle: handle_, counts: c.counts(&["joint_count"]) })
    }

    /// Writes the findings.
    pub fn info(&self) -> Result<raw::hf_skeleton_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_skeleton_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_skeleton_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes one entry for each joint.
    pub fn joints(&self) -> Result<Vec<raw::hf_joint_info>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut joints: Vec<raw::hf_joint_info> = Vec::new();
        loop {
            let joints_at = c.room(&mut joints, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_skeleton_get_joints(self.handle, c.count("capacity", 0)?, joints_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        joints.truncate(c.product(&["capacity"]));
        Ok(joints)
    }

    /// Writes the chains.
    pub fn chains(&self) -> Result<Vec<raw::hf_chain>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut chains: Vec<raw::hf_chain> = Vec::new();
        loop {
            let chains_at = c.room(&mut chains, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_skeleton_get_chains(self.handle, c.count("capacity", 0)?, chains_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        chains.truncate(c.product(&["capacity"]));
        Ok(chains)
    }

    /// Writes the joints of chain after chain.
    pub fn chain_joints(&self) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut joints: Vec<u32> = Vec::new();
        loop {
            let joints_at = c.room(&mut joints, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_skeleton_get_chain_joints(self.handle, c.count("capacity", 0)?, joints_at,
                &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        joints.truncate(c.product(&["capacity"]));
        Ok(joints)
    }

    /// Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one line.
    pub fn reasons(&self) -> Result<String> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut size = 0;
        // SAFETY: the first call asks for the size.
        check(unsafe { raw::hf_skeleton_get_reasons(self.handle, 0, std::ptr::null_mut(), &mut size) })?;
        let mut block = vec![0u8; size];
        check(unsafe { raw::hf_skeleton_get_reasons(self.handle, block.len(), block.as_mut_ptr().cast(), &mut size) })?;
        Ok(String::from_utf8_lossy(block.strip_suffix(&[0]).unwrap_or(&block)).into_owned())
    }

    /// As it was made with.
    pub fn joint_count(&self) -> usize {
        self.counts.get("joint_count").copied().unwrap_or(0)
    }
}

object!(
    /// hf/transfer.h - play the motion of one surface on another.
    ///
    /// You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get the
    /// same harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place form a
    /// cluster. The target takes over the rotations of the source's clusters. Its translations follow from its own shape
    /// (Xu, Zhang, Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn about one another. A
    /// limb whose parts reach farther than the source's turns less, so that it moves as far: a held sword, a long tail, a
    /// large head. The dial long_follow gives it the whole turn.
    Transfer: hf_transfer, hf_transfer_destroy
);
impl Transfer {
    /// Creates a transfer between two surfaces; both may be the same.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_INVALID_OBJECT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_TOO_LARGE`].
    pub fn new(source: &Surface, target: &Surface, options: &TransferOptions) -> Result<Self> {
        let mut c = Call::default();
        c.parent("source", &source.counts);
        c.parent("target", &target.counts);
        let desc = options.fill(&mut c, "")?;
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_create(source.handle, target.handle, &desc, &mut handle_) })?;
        Ok(Transfer { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Adds pairs.
    ///
    /// source_vertices: lists of whole numbers: all regions one after the other; vertices of your mesh, up to 4 entries
    /// per vertex
    /// target_vertices: lists of whole numbers:
    /// flags: `[pair_count]` `HF_PAIR_*`, or `None` for none
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn add_pairs(&mut self, source_vertices: &[&[u32]], target_vertices: &[&[u32]], flags: Option<&[u32]>,
            pairs: &Pairs) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = pairs.fill(&mut c, "", Some(source_vertices), Some(target_vertices), flags)?;
        let mut pairs = vec![u32::default(); c.product(&["pair_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_add_pairs(self.handle, &desc, pairs.as_mut_ptr()) })?;
        Ok(pairs)
    }

    /// Removes pairs by number.
    ///
    /// pairs: `[pair_count]`.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn remove_pairs(&mut self, pairs: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let pairs_ = c.array(Some(pairs), "pairs", &["pair_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_remove_pairs(self.handle, c.count("pair_count", 1)?, pairs_) })?;
        Ok(())
    }

    /// Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
    /// `Transfer::apply` has done so. This changes no result.
    ///
    /// Fails with [`raw::HF_ERROR_NOT_FOUND`].
    pub fn pair(&self, pair: u32) -> Result<raw::hf_pair_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_pair_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_get_pair(self.handle, pair, &mut info) })?;
        Ok(info)
    }

    /// Writes the info of the whole transfer. The first call after a change of pairs solves fields, as `Transfer::pair`
    /// does.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`].
    pub fn info(&self) -> Result<raw::hf_transfer_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_transfer_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the statistics of a transfer.
    pub fn statistics(&self) -> Result<raw::hf_transfer_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_transfer_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Sets the dials of a transfer for the next frames.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`].
    pub fn set_dials(&mut self, dials: &TransferDials) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = dials.fill(&mut c, "")?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_set_dials(self.handle, &desc) })?;
        Ok(())
    }

    /// Writes the dials; stride is never 0.
    pub fn dials(&self) -> Result<raw::hf_transfer_dials> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut dials = raw::hf_transfer_dials::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_get_dials(self.handle, &mut dials) })?;
        Ok(dials)
    }

    /// Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh. Each frame
    /// moves a rigid piece by the rigid motion that fits the piece best, as `Pose::set_rigid_pieces` does. This fit is
    /// the last step of a frame. So a hold on a part of a rigid piece may miss its position, and a rigid piece may sink
    /// into the ground.
    ///
    /// vertices: `[vertex_count]`, one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
    /// replaces the previous list and applies from the next frame on. The call does not factorise.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`].
    pub fn set_rigid_pieces(&mut self, vertices: &[u32]) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        c.sizes.remove("vertex_count"); // of the list given here
        let vertices_ = c.array(Some(vertices), "vertices", &["vertex_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_set_rigid_pieces(self.handle, c.count("vertex_count", 1)?, vertices_) })?;
        Ok(())
    }

    /// Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest directions differ
    /// much on the two surfaces ([`raw::hf_pair_info`]), it takes the direction of the source's limb instead, by a share.
    ///
    /// The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc alone.
    /// Removed pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the same frames, bit
    /// for bit. The result changes as little as the source does: a source that stands still except for noise gives a
    /// target that stands still.
    ///
    /// The ground counts too if the mode is [`raw::HF_TRANSFER_FIELDS`] and some pairs are anchors (their target region
    /// follows the path of the source's region). While a foot of the source stands on the ground, the target's foot
    /// follows its scaled path exactly. No vertex of the target sinks deeper into the ground than the source, scaled,
    /// except the vertices of `Transfer::sinking`. A part that would sink bends up. The ground does not move regions that
    /// you hold. A lying target rests on the parts that the source rests on. A rigid motion of the whole source is copied
    /// unchanged. All rules of the ground come in continuously. The ground is under the feet of each body at rest, and
    /// what hangs lower is none: a cape, a tail, scenery. Without feet, or where the trunk is below them, it is the
    /// lowest vertex. [`raw::HF_GROUND_OFF`] switches it off.
    ///
    /// source_positions: `[source.vertex_count x 3]` of float or double: the posed source, its own vertex order
    /// out: `[target.vertex_count x 3]` of float or double
    /// target_normals: `[target.vertex_count x 3]` of float or double
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_NOT_FOUND`], [`raw::HF_ERROR_TOO_LARGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn apply<'i>(&mut self, source_positions: impl Into<Reals<'i>>, frame: &TransferFrame) -> Result<Vec<f64>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = frame.fill(&mut c, "", Some(source_positions.into()))?;
        let mut out = vec![f64::default(); c.product(&["target.vertex_count", "3"])];
        desc.target_positions = c.out(out.as_mut_ptr(), "target.vertex_count");
        let target_normals_at: *mut f32 = std::ptr::null_mut();
        desc.target_normals = c.out(target_normals_at, "target.vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_apply(self.handle, &desc) })?;
        Ok(out)
    }

    /// As `apply`, into a slice of yours.
    pub fn apply_into<'i, P: Real>(&mut self, source_positions: impl Into<Reals<'i>>, out: &mut [P],
            target_normals: Option<&mut [f32]>, frame: &TransferFrame) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut desc = frame.fill(&mut c, "", Some(source_positions.into()))?;
        c.fit(out.len(), "out", &["target.vertex_count", "3"])?;
        desc.target_positions = c.out(out.as_mut_ptr(), "target.vertex_count");
        let target_normals_at = c.fill(target_normals, "target_normals", &["target.vertex_count", "3"])?;
        desc.target_normals = c.out(target_normals_at, "target.vertex_count");
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_apply(self.handle, &desc) })?;
        Ok(())
    }

    /// Writes which target vertices may sink into the ground.
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`].
    pub fn sinking(&self) -> Result<Vec<u8>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut sinking = vec![u8::default(); c.product(&["target.vertex_count"])];
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_transfer_get_sinking(self.handle, sinking.as_mut_ptr()) })?;
        Ok(sinking)
    }

    /// Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the skin
    /// replays `Transfer::apply` exactly, because that function also uses the four largest weights. Each rigid piece is
    /// one joint. These joints come after the joints of clusters.
    ///
    /// influence_count: joints per vertex, 4 or 8; 0 = 4
    /// scales: `[joint_capacity x 3]` along the axes in the last frame; `None` = joints are rigid
    ///
    /// Fails with [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn skin(&self, influence_count: u32, want_scales: bool) -> Result<SkinInfo> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut skin = raw::hf_skin_info { influence_count: influence_count, ..Default::default() };
        c.learn("influence_count", if influence_count == 0 { 4 } else { influence_count as usize });
        c.learn("joint_capacity", c.size("joint_count").unwrap_or(Call::FIRST));
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_pivots: Vec<f64> = Vec::new();
        let mut all_rotations: Vec<f64> = Vec::new();
        let mut all_translations: Vec<f64> = Vec::new();
        let mut all_axes: Vec<f64> = Vec::new();
        let mut all_scales: Vec<f64> = Vec::new();
        let mut all_vertex_joints: Vec<u32> = Vec::new();
        let mut all_vertex_weights: Vec<f32> = Vec::new();
        loop {
            skin.joint_capacity = c.count("joint_capacity", 0)?;
            skin.vertex_capacity = c.count("vertex_capacity", 0)?;
            skin.pivots = c.room(&mut all_pivots, &["joint_capacity", "3"]);
            skin.rotations = c.room(&mut all_rotations, &["joint_capacity", "4"]);
            skin.translations = c.room(&mut all_translations, &["joint_capacity", "3"]);
            skin.axes = c.room(&mut all_axes, &["joint_capacity", "4"]);
            skin.scales = if want_scales { c.room(&mut all_scales, &["joint_capacity",
                "3"]) } else { std::ptr::null_mut() };
            skin.vertex_joints = c.room(&mut all_vertex_joints, &["vertex_capacity", "influence_count"]);
            skin.vertex_weights = c.room(&mut all_vertex_weights, &["vertex_capacity", "influence_count"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_transfer_get_skin(self.handle, &mut skin) };
            if c.enough(code, &[("joint_capacity", skin.joint_count), ("vertex_capacity", skin.vertex_count)])? {
                break;
            }
        }
        all_pivots.truncate(c.product(&["joint_capacity", "3"]));
        all_rotations.truncate(c.product(&["joint_capacity", "4"]));
        all_translations.truncate(c.product(&["joint_capacity", "3"]));
        all_axes.truncate(c.product(&["joint_capacity", "4"]));
        all_scales.truncate(c.product(&["joint_capacity", "3"]));
        all_vertex_joints.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_vertex_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        Ok(SkinInfo { influence_count: skin.influence_count, pivots: all_pivots, rotations: all_rotations,
            translations: all_translations, axes: all_axes, scales: all_scales, vertex_joints: all_vertex_joints,
            vertex_weights: all_vertex_weights })
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}

object!(
    /// The weights of one surface for one skeleton.
    Weights: hf_weights, hf_weights_destroy
);
impl Weights {
    /// Computes weights.
    ///
    /// influence_count: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it has none,
    /// it is made now. Sets *weights to `None` first.
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn new(surface: &Surface, joints: &Joints, influence_count: u32) -> Result<Self> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let desc = joints.fill(&mut c, "")?;
        c.learn("influence_count", if influence_count == 0 { 4 } else { influence_count as usize });
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_create(surface.handle, &desc, influence_count, &mut handle_) })?;
        Ok(Weights { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of the two
    /// is changed. For undo, keep copies: one before each change.
    pub fn try_clone(&self) -> Result<Self> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut handle_ = std::ptr::null_mut();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_clone(self.handle, &mut handle_) })?;
        Ok(Weights { handle: handle_, counts: c.counts(&["vertex_count"]) })
    }

    /// Replaces all
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`],
    /// [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn set_joints(&mut self, joints: &Joints) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = joints.fill(&mut c, "")?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_set_joints(self.handle, &desc) })?;
        Ok(())
    }

    /// Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a
    /// disc. Pins at the same places with other weights cost no path.
    ///
    /// vertices: `[pin_count]` vertices of your mesh, or `None`
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_CONFLICT`], [`raw::HF_ERROR_DUPLICATE`],
    /// [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`],
    /// [`raw::HF_ERROR_TOO_LARGE`].
    pub fn set_pins(&mut self, vertices: Option<&[u32]>, pins: &Pins) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let desc = pins.fill(&mut c, "", vertices)?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_set_pins(self.handle, &desc) })?;
        Ok(())
    }

    /// Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0 unlocks.
    ///
    /// joints: `[lock_count]`.
    /// values: `[vertex_count x lock_count]` weights to keep, 0 to 1, or `None` for the present ones. Welded copies take
    /// the values of the first. Pinned vertices keep the weights of their pins.
    ///
    /// Fails with [`raw::HF_ERROR_DUPLICATE`], [`raw::HF_ERROR_INVALID_ARGUMENT`], [`raw::HF_ERROR_NON_FINITE`],
    /// [`raw::HF_ERROR_OUT_OF_RANGE`].
    pub fn set_locks(&mut self, joints: &[u32], values: Option<&[f32]>) -> Result<()> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let joints_ = c.array(Some(joints), "joints", &["lock_count"])?;
        let values_ = c.array(values, "values", &["vertex_count", "lock_count"])?;
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_set_locks(self.handle, c.count("lock_count", 1)?, joints_, values_) })?;
        Ok(())
    }

    /// Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first joint of the
    /// vertex.
    ///
    /// Fails with [`raw::HF_ERROR_TOO_LARGE`].
    pub fn get(&self) -> Result<WeightsOut> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut weights = raw::hf_weights_out { ..Default::default() };
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_joints: Vec<u32> = Vec::new();
        let mut all_weights: Vec<f32> = Vec::new();
        let mut all_origins: Vec<u8> = Vec::new();
        loop {
            weights.vertex_capacity = c.count("vertex_capacity", 0)?;
            weights.joints = c.room(&mut all_joints, &["vertex_capacity", "influence_count"]);
            weights.weights = c.room(&mut all_weights, &["vertex_capacity", "influence_count"]);
            weights.origins = c.room(&mut all_origins, &["vertex_capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_weights_get(self.handle, &mut weights) };
            if c.enough(code, &[("vertex_capacity", weights.vertex_count), ("influence_count",
                weights.influence_count)])? {
                break;
            }
        }
        all_joints.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_origins.truncate(c.product(&["vertex_capacity"]));
        Ok(WeightsOut { influence_count: weights.influence_count, joints: all_joints, weights: all_weights,
            origins: all_origins })
    }

    /// Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not deform have no
    /// flags.
    pub fn joints(&self) -> Result<(Vec<u32>, Vec<u32>)> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut flags: Vec<u32> = Vec::new();
        let mut vertex_counts: Vec<u32> = Vec::new();
        loop {
            let flags_at = c.room(&mut flags, &["capacity"]);
            let vertex_counts_at = c.room(&mut vertex_counts, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_weights_get_joints(self.handle, c.count("capacity", 0)?, flags_at,
                vertex_counts_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        flags.truncate(c.product(&["capacity"]));
        vertex_counts.truncate(c.product(&["capacity"]));
        Ok((flags, vertex_counts))
    }

    /// Writes the info.
    pub fn info(&self) -> Result<raw::hf_weights_info> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut info = raw::hf_weights_info::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_get_info(self.handle, &mut info) })?;
        Ok(info)
    }

    /// Writes the statistics.
    pub fn statistics(&self) -> Result<raw::hf_weights_statistics> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut statistics = raw::hf_weights_statistics::default();
        // SAFETY: every slice is as long as its check says.
        check(unsafe { raw::hf_weights_get_statistics(self.handle, &mut statistics) })?;
        Ok(statistics)
    }

    /// Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal, set deforms
    /// to 0.
    ///
    /// names: one line for each joint in UTF-8, or `None`.
    ///
    /// Fails with [`raw::HF_ERROR_INVALID_ARGUMENT`].
    pub fn helpers(&self, names: Option<&[&str]>) -> Result<Vec<u32>> {
        let mut c = Call { sizes: self.counts.clone(), ..Default::default() };
        let mut count = 0;
        c.learn("capacity", Call::FIRST);
        let mut reasons: Vec<u32> = Vec::new();
        loop {
            let reasons_at = c.room(&mut reasons, &["capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_weights_get_helpers(self.handle, c.text(names)?, c.count("capacity", 0)?,
                reasons_at, &mut count) };
            if c.enough(code, &[("capacity", count)])? {
                break;
            }
        }
        reasons.truncate(c.product(&["capacity"]));
        Ok(reasons)
    }

    /// Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in the
    /// same frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One bi-harmonic
    /// field fills in the vertices without such a point. A piece without any takes the weights of the nearest points.
    ///
    /// info: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_TOO_SMALL`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn transfer(source: &Surface, target: &Surface, options: &WeightsTransferOptions) -> Result<(WeightsOut,
            raw::hf_weights_transfer_info)> {
        let mut c = Call::default();
        c.parent("source", &source.counts);
        c.parent("target", &target.counts);
        let mut info = raw::hf_weights_transfer_info::default();
        let desc = options.fill(&mut c, "")?;
        let mut weights_ = raw::hf_weights_out { ..Default::default() };
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_joints: Vec<u32> = Vec::new();
        let mut all_weights: Vec<f32> = Vec::new();
        let mut all_origins: Vec<u8> = Vec::new();
        loop {
            weights_.vertex_capacity = c.count("vertex_capacity", 0)?;
            weights_.joints = c.room(&mut all_joints, &["vertex_capacity", "influence_count"]);
            weights_.weights = c.room(&mut all_weights, &["vertex_capacity", "influence_count"]);
            weights_.origins = c.room(&mut all_origins, &["vertex_capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_weights_transfer(source.handle, target.handle, &desc, &mut weights_,
                &mut info) };
            if c.enough(code, &[("vertex_capacity", weights_.vertex_count), ("influence_count",
                weights_.influence_count)])? {
                break;
            }
        }
        all_joints.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_origins.truncate(c.product(&["vertex_capacity"]));
        Ok((WeightsOut { influence_count: weights_.influence_count, joints: all_joints, weights: all_weights,
            origins: all_origins }, info))
    }

    /// Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights of the
    /// nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-harmonic field
    /// fills in the rest. The plane comes from joints with partners, else from the surface. The largest component of a
    /// found normal is positive. So for a normal along x, [`raw::HF_MIRROR_TO_NEGATIVE`] copies from +x to -x.
    ///
    /// info: filled in when given
    /// statistics: filled in when given
    ///
    /// Fails with [`raw::HF_ERROR_CANCELLED`], [`raw::HF_ERROR_EMPTY`], [`raw::HF_ERROR_INVALID_ARGUMENT`],
    /// [`raw::HF_ERROR_NON_FINITE`], [`raw::HF_ERROR_OUT_OF_RANGE`], [`raw::HF_ERROR_TOO_LARGE`],
    /// [`raw::HF_ERROR_TOO_SMALL`], [`raw::HF_ERROR_UNSUPPORTED`].
    pub fn mirror(surface: &Surface, options: &WeightsMirrorOptions) -> Result<(WeightsOut, Vec<u32>, Vec<u32>,
            raw::hf_weights_mirror_info, raw::hf_weights_mirror_statistics)> {
        let mut c = Call::default();
        c.parent("surface", &surface.counts);
        let mut info = raw::hf_weights_mirror_info::default();
        let mut statistics = raw::hf_weights_mirror_statistics::default();
        let desc = options.fill(&mut c, "")?;
        let mut weights_ = raw::hf_weights_out { ..Default::default() };
        let mut partners_ = vec![u32::default(); c.product(&["joint_count"])];
        let mut pairings = vec![u32::default(); c.product(&["joint_count"])];
        c.learn("vertex_capacity", c.size("vertex_count").unwrap_or(Call::FIRST));
        let mut all_joints: Vec<u32> = Vec::new();
        let mut all_weights: Vec<f32> = Vec::new();
        let mut all_origins: Vec<u8> = Vec::new();
        loop {
            weights_.vertex_capacity = c.count("vertex_capacity", 0)?;
            weights_.joints = c.room(&mut all_joints, &["vertex_capacity", "influence_count"]);
            weights_.weights = c.room(&mut all_weights, &["vertex_capacity", "influence_count"]);
            weights_.origins = c.room(&mut all_origins, &["vertex_capacity"]);
            // SAFETY: the arrays have the room that the call is told.
            let code = unsafe { raw::hf_weights_mirror(surface.handle, &desc, &mut weights_, partners_.as_mut_ptr(),
                pairings.as_mut_ptr(), &mut info, &mut statistics) };
            if c.enough(code, &[("vertex_capacity", weights_.vertex_count), ("influence_count",
                weights_.influence_count)])? {
                break;
            }
        }
        all_joints.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_weights.truncate(c.product(&["vertex_capacity", "influence_count"]));
        all_origins.truncate(c.product(&["vertex_capacity"]));
        Ok((WeightsOut { influence_count: weights_.influence_count, joints: all_joints, weights: all_weights,
            origins: all_origins }, partners_, pairings, info, statistics))
    }

    /// Vertices of the surface, as given.
    pub fn vertex_count(&self) -> usize {
        self.counts.get("vertex_count").copied().unwrap_or(0)
    }
}
impl TryClone for Weights {
    fn try_clone(&self) -> Result<Self> {
        Weights::try_clone(self)
    }
}
