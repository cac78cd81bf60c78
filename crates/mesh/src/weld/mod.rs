//! All stems as one watertight surface: every edge has two faces, forks and all.
//!
//! The surface is where the distance to the nearest stem is nothing, found on a grid of cells. What is
//! finer than a cell cannot be seen by the grid, so stems whose radius is less than a cell are as thick
//! as one, which is also what a printer needs; forks meet in an edge that a cell or two round off.

mod cone;
mod grid;
mod joint;
mod local;
mod nearby;
mod shells;
mod stitch;
mod tetrahedra;

use crate::block::{Block, Vertex};
use crate::tube::Path;
use cone::Cone;
use glam::{Vec3, vec2};
use grid::Grid;
use joint::Joint;
use nearby::Stems;
use pleach_plant::Bounds;
use pleach_plant::{Parts, StemKind, Tree};
use std::ops::Range;
use stitch::Surface;

/// Why a tree could not be welded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WeldError {
    /// The grid would be larger than memory should be.
    #[error("cells of {:.3} mm are too fine to weld this tree; larger cells", 1e3 * cell)]
    TooFine {
        /// Side of a cell in metres.
        cell: f64,
    },
    /// The side of a cell is not a positive number.
    #[error("welding needs cells of a positive size, not {cell} m")]
    NotPositive {
        /// Side of a cell in metres.
        cell: f64,
    },
}

/// How stems are welded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeldSettings {
    /// Side of a cell in metres, positive: the level of detail.
    pub cell: f64,
    /// Width of the fillet where two stems meet, over the radius of the thinner one, 0 to
    /// [`WeldSettings::MAX_FILLET`]; 0 leaves the corner as it is.
    pub fillet: f64,
    /// Which stems are welded.
    pub parts: Parts,
}

impl WeldSettings {
    /// Wider fillets are not made.
    pub const MAX_FILLET: f64 = 4.0;

    /// Cells of `cell` metres, no fillets, no roots.
    #[must_use]
    pub const fn new(cell: f64) -> Self {
        Self { cell, fillet: 0.0, parts: Parts::BARE }
    }
}

/// The stems of `tree` as one closed surface, found on a grid; nothing for a tree without stems. Texture
/// coordinates are 0 and the height in metres: a surface without seams cannot be unrolled, so that it shows no pictures
/// of bark.
///
/// # Errors
/// See [`WeldError`].
pub fn surface(tree: &Tree, settings: &WeldSettings) -> Result<Block, WeldError> {
    let cell = settings.cell;
    if !(cell.is_finite() && cell > 0.0) {
        return Err(WeldError::NotPositive { cell });
    }
    let (cones, pieces) = cones(tree, settings)?;
    if cones.is_empty() {
        return Ok(Block::default());
    }
    let fillet = settings.fillet.clamp(0.0, WeldSettings::MAX_FILLET);
    let joints = Joint::find(tree, &pieces, &cones, fillet);
    let stems = Stems { cones, joints };
    let Surface { corners, triangles } = Surface::new(&Grid::new(&stems, cell)?, &stems).without_hollows();
    let mut normals = vec![Vec3::ZERO; corners.len()];
    for t in &triangles {
        let [a, b, c] = t.map(|i| corners[i as usize]);
        let normal = (b - a).cross(c - a);
        t.iter().for_each(|&i| normals[i as usize] += normal);
    }
    let corner = |(position, normal): (Vec3, Vec3)| {
        let uv = vec2(0.0, position.z);
        Vertex { position, normal: normal.try_normalize().unwrap_or(Vec3::Z), uv }
    };
    let vertices = corners.into_iter().zip(normals).map(corner).collect();
    Ok(Block { vertices, triangles, ..Block::default() })
}

/// More pieces of stems are not welded.
const MAX_PIECES: usize = 2_000_000;

/// The stems in short pieces, and which pieces are each stem's.
fn cones(tree: &Tree, settings: &WeldSettings) -> Result<(Vec<Cone>, Vec<Range<usize>>), WeldError> {
    let &WeldSettings { cell, parts, .. } = settings;
    let (mut cones, mut pieces_of) = (Vec::new(), Vec::new());
    let extent = Bounds::new(tree, parts).map_or(0.0, |b| (b.max - b.min).max_element());
    if extent > cell * f64::from(grid::MAX_ALONG) {
        return Err(WeldError::TooFine { cell });
    }
    let mut path = Path::default();
    for stem in &tree.stems {
        let first = cones.len();
        if !parts.has_stem(stem.kind) {
            pieces_of.push(first..first);
            continue;
        }
        // Not only what a tube can show: a trunk without a height still is a ball that its roots begin in.
        path.trace(tree, stem, 0.25 * cell);
        for pair in path.rings.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            cones.push(Cone::new(a.center, b.center, [a.radius, b.radius].map(|r| r.max(cell))));
        }
        if stem.parent.is_none() && stem.kind != StemKind::Fork {
            Cone::cut_foot(&mut cones[first..], cell);
        }
        if cones.len() > MAX_PIECES {
            return Err(WeldError::TooFine { cell });
        }
        pieces_of.push(first..cones.len());
    }
    Ok((cones, pieces_of))
}

#[cfg(test)]
mod tests;
