//! All stems as one watertight surface: every edge has two faces, forks and all.
//!
//! The surface is where the distance to the nearest stem is nothing, found on a grid of cells. What is
//! finer than a cell cannot be seen by the grid, so stems whose radius is less than a cell are as thick
//! as one, which is also what a printer needs; forks meet in an edge that a cell or two round off.

mod cone;
mod field;
mod joint;
mod tetrahedra;

use crate::block::{Block, Vertex};
use crate::tube::Rings;
use cone::Cone;
use field::Field;
use glam::{Vec3, vec2};
use joint::Joint;
use pleach_tree::stats::Bounds;
use pleach_tree::{Parts, StemKind, Tree};
use std::ops::Range;
use tetrahedra::Surface;

/// Why a tree could not be welded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
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
/// coordinates are 0 and the height in metres: a surface without seams cannot be unrolled.
///
/// # Errors
/// See [`WeldError`].
pub fn surface(tree: &Tree, settings: &WeldSettings) -> Result<Block, WeldError> {
    let cell = settings.cell;
    if !(cell.is_finite() && cell > 0.0) {
        return Err(WeldError::NotPositive { cell });
    }
    let (mut cones, pieces) = cones(tree, settings)?;
    if cones.is_empty() {
        return Ok(Block::default());
    }
    let fillet = settings.fillet.clamp(0.0, WeldSettings::MAX_FILLET);
    let joints = Joint::find(tree, &pieces, &mut cones, fillet);
    let Surface { corners, triangles } = Surface::new(&Field::new(&cones, &joints, cell)?);
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
    if extent > cell * f64::from(field::MAX_ALONG) {
        return Err(WeldError::TooFine { cell });
    }
    let mut rings = Rings::default();
    for stem in &tree.stems {
        let first = cones.len();
        if !parts.has_stem(stem.kind) {
            pieces_of.push(first..first);
            continue;
        }
        rings.sample(tree, stem, 0.25 * cell);
        let foot = stem.parent.is_none() && stem.kind != StemKind::Fork;
        for (i, pair) in rings.rings.windows(2).enumerate() {
            let (a, b) = (&pair[0], &pair[1]);
            let radii = [a.radius, b.radius].map(|r| r.max(cell));
            // A long slanted piece would have a box of mostly air.
            let most = (4.0 * cell).max(2.0 * radii[0].max(radii[1]));
            let pieces = (a.center.distance(b.center) / most).ceil().clamp(1.0, 1e4) as u32;
            let at = |k: u32| {
                let t = f64::from(k) / f64::from(pieces);
                (a.center.lerp(b.center, t), radii[0] + (radii[1] - radii[0]) * t)
            };
            for k in 0..pieces {
                let ((from, r), (to, s)) = (at(k), at(k + 1));
                // A trunk without a length has no side to be cut off.
                let foot = foot && i == 0 && k == 0 && from.distance(to) > 1e-9;
                cones.push(Cone { from, to, radii: [r, s], foot, swell: 0.0 });
            }
        }
        if cones.len() > MAX_PIECES {
            return Err(WeldError::TooFine { cell });
        }
        pieces_of.push(first..cones.len());
    }
    // A tree that is no longer than a point is a ball.
    if let (true, Some(knot)) = (cones.is_empty() && !pieces_of.is_empty(), tree.knots.first()) {
        let radius = knot.radius.max(cell);
        let at = knot.point;
        cones.push(Cone { from: at, to: at, radii: [radius; 2], foot: false, swell: 0.0 });
    }
    Ok((cones, pieces_of))
}

#[cfg(test)]
mod tests;
