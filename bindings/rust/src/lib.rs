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
#[rustfmt::skip] // generated
mod api;
mod call;
mod core;
#[rustfmt::skip] // generated
pub mod raw;

pub use crate::api::*;
pub use crate::call::{Indices, Reals};
pub use crate::core::{Error, History, Real, Result, TryClone};

/// The version of the loaded library: major * 1,000,000 + minor * 1,000 + patch.
pub fn version() -> u32 {
    // SAFETY: the function takes nothing and cannot fail.
    unsafe { raw::hf_version_get() }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
