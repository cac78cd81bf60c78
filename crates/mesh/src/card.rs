//! Upright cards that show a picture of a whole tree.

use crate::block::{Block, vertex};
use crate::tube::Count;
use glam::Vec3;

/// One upright card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Card {
    /// Lower left, lower right, upper right and upper left corner, in metres, z up.
    pub corners: [Vec3; 4],
    /// Left, top, right and bottom in the picture, 0 to 1.
    pub uv: [f32; 4],
}

pub(crate) fn count(cards: &[Card]) -> Count {
    Count { vertices: 4 * cards.len() as u64, triangles: 2 * cards.len() as u64 }
}

/// Appends the cards. Their normals point up, so that crossing cards are lit alike.
pub(crate) fn push(cards: &[Card], block: &mut Block) {
    for card in cards {
        let base = block.vertices.len() as u32;
        let [left, top, right, bottom] = card.uv;
        let uv = [[left, bottom], [right, bottom], [right, top], [left, top]];
        for (corner, [u, v]) in card.corners.iter().zip(uv) {
            block.vertices.push(vertex(*corner, Vec3::Z, u, v));
        }
        block.triangles.extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
    }
}
