//! Dynamic harmonic fields for games and content tools: owned handles, errors as [`Result`], slices without copies.
//!
//! A [`Surface`] holds a mesh and its factor. On it you make a [`Solver`] (sites and their field), a [`Pose`] (handles),
//! [`Weights`], a [`Direction`] field, a [`Region`], [`Geodesics`], [`Quads`] and [`Flow`] lines, and between two surfaces
//! a [`Transfer`]. Objects keep what they need of the surface, so you may drop them in any order. A call that fails
//! changes nothing. [`raw`] is the C ABI itself.
//!
//! ```
//! # fn main() -> hf::Result<()> {
//! let positions = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.0, 0.0];
//! let triangles: [u32; 12] = [0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5];
//! let surface = hf::Surface::new(&positions, &triangles, &hf::SurfaceOptions::default())?;
//! let mut solver = hf::Solver::new(&surface, &hf::SolverOptions::default())?;
//! solver.add_sites(&hf::Sites { vertices: Some(&[0, 1, 4, 5]), values: Some(&[0.0, 0.0, 1.0, 1.0]), ..Default::default() })?;
//! assert!((solver.solve()?[2] - 0.5).abs() < 1e-12);
//! # Ok(())
//! # }
//! ```
#![warn(missing_docs)]
mod core;
mod fields;
mod pose;
#[rustfmt::skip] // generated
pub mod raw;
mod region;
mod solver;
mod surface;
mod weights;

pub use crate::core::{Corner, Error, History, Progress, Real, Result, TryClone};
pub use crate::fields::{
    Direction, DirectionOptions, Flow, Streamlines, Geodesics, GeodesicsOptions, QuadGuides, QuadMesh, Quads, QuadsOptions,
};
pub use crate::pose::{DeformOptions, Pose, PoseOptions, Skin, Transfer, TransferDials, TransferOptions, Transform};
pub use crate::region::{Detail, Region, RegionEdit, RegionOptions};
pub use crate::solver::{Edit, Sites, Solver, SolverOptions};
pub use crate::surface::{Extras, GraphOptions, Isolines, LinkOptions, Surface, SurfaceOptions};
pub use crate::weights::{transfer_weights, mirror_weights, Joints, WeightTransferOptions, Mirror, Mirrored, VertexWeights, Weights};

/// The version of the loaded library: major * 1,000,000 + minor * 1,000 + patch.
pub fn version() -> u32 {
    // SAFETY: the function takes nothing and cannot fail.
    unsafe { raw::hf_version_get() }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
