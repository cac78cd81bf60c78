//! All stems as one watertight surface: every edge has two faces, forks and all.
//!
//! The surface is where the distance to the nearest stem is nothing, found on a grid of cells. What is
//! finer than a cell cannot be seen by the grid, so stems whose radius is less than a cell are as thick
//! as one, which is also what a printer needs; forks meet in an edge that a cell or two round off.

mod cone;
mod field;
mod tetrahedra;

use crate::block::{Block, Vertex};
use crate::tube::Rings;
use cone::Cone;
use field::Field;
use glam::{Vec3, vec2};
use pleach_tree::stats::Bounds;
use pleach_tree::{Parts, StemKind, Tree};
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
    /// The side of a cell is no positive number.
    #[error("welding needs cells of a positive size, not {cell} m")]
    NotPositive {
        /// Side of a cell in metres.
        cell: f64,
    },
}

/// The stems of `tree` as one closed surface, found on a grid of cells with sides of `cell` metres;
/// nothing for a tree without stems. Texture coordinates are 0 and the height in metres: a surface
/// without seams cannot be unrolled.
///
/// # Errors
/// See [`WeldError`].
pub fn surface(tree: &Tree, cell: f64) -> Result<Block, WeldError> {
    if !(cell.is_finite() && cell > 0.0) {
        return Err(WeldError::NotPositive { cell });
    }
    let cones = cones(tree, cell)?;
    if cones.is_empty() {
        return Ok(Block::default());
    }
    let Surface { corners, triangles } = Surface::of(&Field::new(&cones, cell)?);
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

/// The stems in short pieces.
fn cones(tree: &Tree, cell: f64) -> Result<Vec<Cone>, WeldError> {
    let mut cones = Vec::new();
    let extent = Bounds::new(tree, Parts::BARE).map_or(0.0, |b| (b.max - b.min).max_element());
    if extent > cell * f64::from(field::MAX_ALONG) {
        return Err(WeldError::TooFine { cell });
    }
    let mut rings = Rings::default();
    for stem in tree.stems.iter().filter(|stem| Parts::BARE.has_stem(stem.kind)) {
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
                cones.push(Cone { from, to, radii: [r, s], foot: foot && i == 0 && k == 0 });
            }
        }
        if cones.len() > MAX_PIECES {
            return Err(WeldError::TooFine { cell });
        }
    }
    Ok(cones)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Number of faces of every edge, by its two corners.
    fn check_closed(block: &Block) {
        let mut edges: Vec<(u32, u32)> =
            block.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
        edges.sort_unstable();
        // Each edge once in each direction: two faces, wound alike.
        for pair in edges.windows(2) {
            assert_ne!(pair[0], pair[1], "an edge has two faces on one side");
        }
        for &(a, b) in &edges {
            assert!(edges.binary_search(&(b, a)).is_ok(), "an edge has one face");
        }
    }

    fn pieces(block: &Block) -> usize {
        let mut parent: Vec<u32> = (0..block.vertices.len() as u32).collect();
        fn root(parent: &mut [u32], mut i: u32) -> u32 {
            while parent[i as usize] != i {
                parent[i as usize] = parent[parent[i as usize] as usize];
                i = parent[i as usize];
            }
            i
        }
        for &[a, b, c] in &block.triangles {
            let top = root(&mut parent, a);
            for other in [b, c] {
                let other = root(&mut parent, other);
                parent[other as usize] = top;
            }
        }
        (0..parent.len()).filter(|i| parent[*i] == *i as u32).count()
    }

    /// Volume by the divergence theorem; positive where faces look outwards.
    fn volume(block: &Block) -> f64 {
        let corner = |i: u32| block.vertices[i as usize].position.as_dvec3();
        block.triangles.iter().map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0).sum()
    }

    #[test]
    fn an_acer_is_one_closed_piece_with_normals_outwards() {
        let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
        let block = surface(&tree, 0.02).unwrap();
        check_closed(&block);
        assert!(block.triangles.len() > 10_000);
        assert!(volume(&block) > 0.0);
        // What floats is an air bubble between twigs that touch, if anything.
        assert!(pieces(&block) < 12, "{} pieces", pieces(&block));
        for v in &block.vertices {
            assert!(v.position.is_finite() && (v.normal.length() - 1.0).abs() < 1e-4);
        }
        assert_eq!(block, surface(&tree, 0.02).unwrap());
    }

    #[test]
    fn a_palm_keeps_the_volume_of_its_trunk() {
        let mut tree = pleach_generators::preset("palm").unwrap().grow_bare(1).unwrap();
        tree.stems.truncate(1);
        let wanted: f64 = {
            let mut rings = Rings::default();
            rings.sample(&tree, &tree.stems[0], 0.001);
            let slice = |i: usize| {
                let (a, b) = (&rings.rings[i], &rings.rings[i + 1]);
                let (r, s) = (a.radius, b.radius);
                a.center.distance(b.center) * std::f64::consts::PI * (r * r + r * s + s * s) / 3.0
            };
            (0..rings.rings.len() - 1).map(slice).sum()
        };
        let found = volume(&surface(&tree, 0.02).unwrap());
        assert!((found / wanted - 1.0).abs() < 0.05, "{found} {wanted}");
    }

    #[test]
    fn cells_that_make_no_sense_are_refused() {
        let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
        assert!(matches!(surface(&tree, 0.0), Err(WeldError::NotPositive { .. })));
        assert!(matches!(surface(&tree, f64::NAN), Err(WeldError::NotPositive { .. })));
        assert!(matches!(surface(&tree, 1e-9), Err(WeldError::TooFine { .. })));
        assert_eq!(surface(&Tree::default(), 0.01).unwrap(), Block::default());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn every_edge_has_two_faces(seed in 0_u64..1000, species in 0_usize..4, cell in 0.02_f64..0.2) {
            let name = ["acer", "palm", "hill_cherry", "lombardy_poplar"][species];
            let tree = pleach_generators::preset(name).unwrap().grow_bare(seed).unwrap();
            let block = surface(&tree, cell).unwrap();
            check_closed(&block);
            prop_assert!(!block.triangles.is_empty() && volume(&block) > 0.0);
        }
    }
}
