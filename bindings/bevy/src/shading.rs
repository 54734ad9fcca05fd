//! Normals and tangents of the mesh as its artist made them, carried along with the posed surface.
//!
//! Each vertex has a frame: the smooth normal of the surface, the direction of one edge in its tangent plane, and their cross
//! product. An authored vector keeps its coordinates in that frame. So hard edges stay hard, normal maps turn with the surface,
//! and at rest all is as it was. A frame shears with its edge: under strong shear, a flat triangle is shaded slightly wrong.
use bevy::math::Vec3;
use std::collections::HashMap;

pub(crate) struct Shading {
    /// the other end of the edge of each vertex; itself when it has none
    next: Vec<u32>,
    /// in the space of the deformer until [`Shading::begin`], from then on in the frames
    normals: Vec<Vec3>,
    /// empty when no mesh has tangents; 0 for the vertices of a mesh without
    tangents: Vec<Vec3>,
    begun: bool,
}

/// Columns of the frame of vertex `at`.
fn frame(at: usize, next: &[u32], positions: &[[f32; 3]], normals: &[[f32; 3]]) -> Option<[Vec3; 3]> {
    let normal = Vec3::from_array(normals[at]).try_normalize()?;
    let edge = Vec3::from_array(positions[next[at] as usize]) - Vec3::from_array(positions[at]);
    let along = edge.reject_from_normalized(normal).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    Some([normal, along, normal.cross(along)])
}

impl Shading {
    /// `normals` and `tangents`: as authored, in the space of the deformer.
    pub(crate) fn new(positions: &[[f32; 3]], triangles: &[u32], normals: Vec<Vec3>, tangents: Vec<Vec3>) -> Self {
        // copies of a vertex take the same edge, so that they cannot come apart; -0 is 0
        let key = |at: u32| positions[at as usize].map(|x| (x + 0.0).to_bits());
        let mut ends: HashMap<[u32; 3], u32> = HashMap::with_capacity(positions.len());
        for corner in triangles.chunks_exact(3) {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                ends.entry(key(corner[a])).or_insert(corner[b]);
            }
        }
        let next = (0..positions.len() as u32).map(|at| *ends.get(&key(at)).unwrap_or(&at)).collect();
        Shading { next, normals, tangents, begun: false }
    }

    /// Whether the frames at rest are known.
    pub(crate) fn begun(&self) -> bool {
        self.begun
    }

    /// Takes the frames at rest: `smooth` has the normals that the library gives there.
    pub(crate) fn begin(&mut self, rest: &[[f32; 3]], smooth: &[[f32; 3]]) {
        for at in 0..rest.len() {
            // where the surface has no normal, vectors stay as they are
            let Some(axes) = frame(at, &self.next, rest, smooth) else { continue };
            let inside = |v: Vec3| Vec3::from_array(axes.map(|axis| axis.dot(v)));
            self.normals[at] = inside(self.normals[at]);
            if let Some(tangent) = self.tangents.get_mut(at) {
                *tangent = inside(*tangent);
            }
        }
        self.begun = true;
    }

    /// Replaces smooth normals of the posed surface by authored ones. Writes tangents when there are some.
    pub(crate) fn carry(&self, posed: &[[f32; 3]], normals: &mut [[f32; 3]], tangents: &mut [[f32; 3]]) {
        for at in 0..posed.len() {
            let axes = frame(at, &self.next, posed, normals).unwrap_or([Vec3::X, Vec3::Y, Vec3::Z]);
            let outside = |v: Vec3| (axes[0] * v.x + axes[1] * v.y + axes[2] * v.z).to_array();
            normals[at] = outside(self.normals[at]);
            if let Some(tangent) = tangents.get_mut(at) {
                *tangent = outside(self.tangents[at]);
            }
        }
    }
}
