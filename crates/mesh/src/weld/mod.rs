//! All stems as one watertight surface: every edge has two faces, forks and all.
//!
//! The surface is where the distance to the nearest stem is nothing, found on a grid of cells. What is
//! finer than a cell cannot be seen by the grid, so stems whose radius is less than a cell are as thick
//! as one, which is also what a printer needs; forks meet in an edge that a cell or two round off.

mod boxes;
mod cone;
mod grid;
mod joint;
mod local;
mod nearby;
mod shells;
mod skin;
mod stitch;
mod tetrahedra;
mod unroll;

use crate::block::{Block, Vertex};
use crate::tube::Path;
use cone::Cone;
use glam::{Vec3, vec2};
use grid::Grid;
use joint::Joint;
use nearby::Stems;
use pleach_plant::Bounds;
use pleach_plant::{Parts, StemKind, Tree};
pub use skin::Skin;
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

    fn check(&self) -> Result<(), WeldError> {
        let Self { cell, .. } = *self;
        let is_right = cell.is_finite() && cell > 0.0;
        if is_right { Ok(()) } else { Err(WeldError::NotPositive { cell }) }
    }
}

/// The stems of `tree` as one closed surface, found on a grid; nothing for a tree without stems. Texture
/// coordinates are 0 and the height in metres: [`Skin::whole`] lays pictures of bark on it.
///
/// # Errors
/// See [`WeldError`].
pub fn surface(tree: &Tree, settings: &WeldSettings) -> Result<Block, WeldError> {
    Ok(Skin::whole(tree, settings, false)?.bark)
}

/// What is welded: pieces of stems, and the corners between them that are filled.
#[derive(Clone, Debug)]
struct Shape {
    cell: f64,
    stems: Stems,
    pieces: Pieces,
}

/// Where the cones come from.
#[derive(Clone, Debug, Default)]
struct Pieces {
    /// The cones of each stem of the tree, by their numbers.
    of_stems: Vec<Range<usize>>,
    /// Radii of the stem at the ends of each cone, in metres, which may be less than a cell.
    radii: Vec<[f64; 2]>,
}

impl Shape {
    /// Those of `tree` for which `is_welded` says so.
    fn new(tree: &Tree, settings: &WeldSettings, is_welded: &[bool]) -> Result<Self, WeldError> {
        settings.check()?;
        let cell = settings.cell;
        let (cones, pieces) = cones(tree, settings, is_welded)?;
        let fillet = settings.fillet.clamp(0.0, WeldSettings::MAX_FILLET);
        let joints = Joint::find(tree, &pieces.of_stems, &cones, fillet);
        Ok(Self { cell, stems: Stems { cones, joints }, pieces })
    }

    fn surface(&self) -> Result<(Vec<Vec3>, Vec<[u32; 3]>), WeldError> {
        if self.stems.cones.is_empty() {
            return Ok(Default::default());
        }
        let grid = Grid::new(&self.stems, self.cell)?;
        let Surface { corners, triangles } = Surface::new(&grid, &self.stems).without_hollows();
        Ok((corners, triangles))
    }
}

/// The surface of these triangles with smooth normals.
fn closed(corners: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Block {
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
    Block { vertices, triangles, ..Block::default() }
}

/// Stems are traced with this part of a cell as tolerance.
const TRACED: f64 = 0.25;
/// More pieces of stems are not welded.
const MAX_PIECES: usize = 2_000_000;

/// The stems in short pieces.
fn cones(tree: &Tree, settings: &WeldSettings, is_welded: &[bool]) -> Result<(Vec<Cone>, Pieces), WeldError> {
    let &WeldSettings { cell, parts, .. } = settings;
    let (mut cones, mut pieces) = (Vec::new(), Pieces::default());
    let extent = Bounds::new(tree, parts).map_or(0.0, |b| (b.max - b.min).max_element());
    if extent > cell * f64::from(grid::MAX_ALONG) {
        return Err(WeldError::TooFine { cell });
    }
    let mut path = Path::default();
    for (stem, is_welded) in tree.stems.iter().zip(is_welded) {
        let first = cones.len();
        if !is_welded || !parts.has_stem(stem.kind) {
            pieces.of_stems.push(first..first);
            continue;
        }
        // Not only what a tube can show: a trunk without a height still is a ball that its roots begin in.
        path.trace(tree, stem, TRACED * cell);
        for pair in path.rings.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            pieces.radii.push([a.radius, b.radius]);
            cones.push(Cone::new(a.center, b.center, [a.radius, b.radius].map(|r| r.max(cell))));
        }
        if stem.parent.is_none() && stem.kind != StemKind::Fork {
            Cone::cut_foot(&mut cones[first..], cell);
        }
        if cones.len() > MAX_PIECES {
            return Err(WeldError::TooFine { cell });
        }
        pieces.of_stems.push(first..cones.len());
    }
    Ok((cones, pieces))
}

#[cfg(test)]
mod tests;
