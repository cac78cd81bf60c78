//! A tree whose stems are one surface.

use crate::block::Block;
use crate::mesher::Mesher;
use crate::part::{Count, Material, Part, Source};
use std::ops::Range;

/// A meshed tree with a welded surface instead of a tube for each stem. The surface has neither wind data
/// nor joints.
#[derive(Debug)]
pub struct Welded<'a> {
    bark: &'a Block,
    foliage: Mesher<'a>,
}

impl<'a> Welded<'a> {
    /// `bark`, from [`crate::weld::surface`] of the tree of `mesher`, with the leaves of `mesher`.
    #[must_use]
    pub const fn new(bark: &'a Block, mesher: Mesher<'a>) -> Self {
        Self { bark, foliage: mesher }
    }
}

impl Source for Welded<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let Block { vertices, triangles, .. } = self.bark;
        let count = Count { vertices: vertices.len() as u64, triangles: triangles.len() as u64 };
        let bark = Part::plain(mesh, Material::Bark, count);
        let foliage = self.foliage.parts(mesh).into_iter().filter(|part| part.material != Material::Bark);
        std::iter::once(bark).filter(|bark| bark.count.triangles > 0).chain(foliage).collect()
    }

    fn ranges(&self, material: Material) -> Vec<Range<usize>> {
        if material == Material::Bark {
            return std::iter::once(0..1).collect();
        }
        self.foliage.ranges(material)
    }

    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block) {
        if material == Material::Bark {
            block.vertices.extend_from_slice(&self.bark.vertices);
            block.triangles.extend_from_slice(&self.bark.triangles);
        } else {
            self.foliage.fill(material, range, block);
        }
    }
}
