//! Upright cards that show a picture of a whole tree.

use crate::block::{Block, Vertex};
use crate::part::{Count, Material, Part, Source};
use glam::{Vec3, vec2};
use std::ops::Range;

/// One upright card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Card {
    /// Lower left, lower right, upper right and upper left corner, in metres, z up.
    pub corners: [Vec3; 4],
    /// Left, top, right and bottom in the picture, 0 to 1.
    pub uv: [f32; 4],
}

/// The cards of a tree as a source of triangles.
#[derive(Clone, Copy, Debug)]
pub struct Cards<'a>(pub &'a [Card]);

impl Source for Cards<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let cards = self.0.len() as u64;
        let count = Count { vertices: 4 * cards, triangles: 2 * cards };
        let part = Part::plain(mesh, Material::Card, count);
        if cards == 0 { Vec::new() } else { vec![part] }
    }

    fn ranges(&self, _: Material) -> Vec<Range<usize>> {
        std::iter::once(0..self.0.len()).collect()
    }

    /// Normals are at right angles to a card; pictures of normals say how the crown looks, so that crossing cards are lit
    /// alike.
    fn fill(&self, _: Material, range: Range<usize>, block: &mut Block) {
        for card in &self.0[range] {
            let base = block.vertices.len() as u32;
            let [left, top, right, bottom] = card.uv;
            let uv = [vec2(left, bottom), vec2(right, bottom), vec2(right, top), vec2(left, top)];
            let corners = card.corners.into_iter().zip(uv);
            let [foot, right, _, top] = card.corners;
            let normal = (right - foot).cross(top - foot).try_normalize().unwrap_or(Vec3::Z);
            block.vertices.extend(corners.map(|(position, uv)| Vertex { position, normal, uv }));
            block.triangles.extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
        }
    }
}
