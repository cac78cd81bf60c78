//! A tree whose thick stems are one surface.

use crate::block::Block;
use crate::mesher::Mesher;
use crate::part::{Count, Material, Part, Source};
use crate::weld::Skin;
use std::ops::Range;

/// A meshed tree with a welded surface instead of a tube for each stem that is part of it. The surface moves in
/// wind; it has neither growth data nor joints, and belongs to no element of pivots.
#[derive(Debug)]
pub struct Welded<'a> {
    skin: &'a Skin,
    rest: Mesher<'a>,
}

impl<'a> Welded<'a> {
    /// `skin`, of the tree of `rest`, with what `rest` draws: leaves, and the stems that are not part of the surface.
    #[must_use]
    pub const fn new(skin: &'a Skin, rest: Mesher<'a>) -> Self {
        Self { skin, rest }
    }
}

impl Source for Welded<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let Block { vertices, triangles, .. } = &self.skin.bark;
        let mut count = Count { vertices: vertices.len() as u64, triangles: triangles.len() as u64 };
        count += self.rest.bark();
        let bark = Part { wind: self.rest.has_wind(), ..Part::plain(mesh, Material::Bark, count) };
        let rest = self.rest.parts(mesh).into_iter().filter(|part| part.material != Material::Bark);
        std::iter::once(bark).filter(|bark| bark.count.triangles > 0).chain(rest).collect()
    }

    /// The surface, and then the stems, counted from 1.
    fn ranges(&self, material: Material) -> Vec<Range<usize>> {
        let rest = self.rest.ranges(material);
        if material != Material::Bark {
            return rest;
        }
        std::iter::once(0..1).chain(rest.into_iter().map(|range| range.start + 1..range.end + 1)).collect()
    }

    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block) {
        if material != Material::Bark {
            return self.rest.fill(material, range, block);
        }
        if range.start == 0 {
            block.vertices.extend_from_slice(&self.skin.bark.vertices);
            block.triangles.extend_from_slice(&self.skin.bark.triangles);
            block.wind.extend(self.skin.nearest.iter().filter_map(|stem| self.rest.wind_of(*stem)));
            return;
        }
        let first = block.triangles.len();
        self.rest.fill(material, range.start - 1..range.end - 1, block);
        let before = self.skin.bark.vertices.len() as u32;
        let new = block.triangles[first..].iter_mut().flatten();
        new.for_each(|corner| *corner += before);
    }
}
