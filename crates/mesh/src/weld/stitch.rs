//! Bricks' pieces of the surface become one.

use super::grid::{Brick, Grid, SIDE, step};
use super::nearby::Stems;
use super::tetrahedra::{EDGES, Edge, Piece};
use glam::Vec3;
use rayon::prelude::*;

/// Corners and triangles, counter-clockwise from outside.
#[derive(Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) corners: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Surface {
    pub(super) fn new(grid: &Grid, stems: &Stems) -> Self {
        let bricks = grid.bricks(stems);
        let pieces: Vec<Piece> =
            bricks.par_iter().filter_map(|brick| Piece::new(grid, stems, brick)).collect();
        drop(bricks);
        let mut starts = Vec::with_capacity(pieces.len());
        let mut corners = Vec::with_capacity(pieces.iter().map(|piece| piece.corners.len()).sum());
        for piece in &pieces {
            starts.push(corners.len() as u32);
            corners.extend_from_slice(&piece.corners);
        }
        let triangles = pieces.par_iter().flat_map_iter(|piece| numbered(&pieces, &starts, piece)).collect();
        Self { corners, triangles }
    }
}

/// The triangles of `piece` by the numbers of their corners.
fn numbered<'a>(
    pieces: &'a [Piece],
    starts: &'a [u32],
    piece: &'a Piece,
) -> impl Iterator<Item = [u32; 3]> + 'a {
    // This brick and the seven after it that hold edges of its last cells.
    let around: [Option<usize>; 8] = std::array::from_fn(|corner| {
        let wanted = Brick::place(piece.first + step(corner) * SIDE);
        pieces.binary_search_by_key(&wanted, |piece| Brick::place(piece.first)).ok()
    });
    let mut own = [0; EDGES];
    for (i, &edge) in piece.edges.iter().enumerate() {
        own[usize::from(edge)] = i as u32;
    }
    let start = around[0].map_or(0, |i| starts[i]);
    let number = move |edge: Edge| match (edge.brick(), around[edge.brick()]) {
        (0, _) | (_, None) => start + own[usize::from(edge.number())],
        // The surface crosses an edge of both bricks, so that the other has it too.
        (_, Some(brick)) => {
            starts[brick] + pieces[brick].edges.binary_search(&edge.number()).unwrap_or(0) as u32
        }
    };
    piece.triangles.iter().map(move |triangle| triangle.map(&number))
}
