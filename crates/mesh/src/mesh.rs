//! A mesh in memory.

use crate::block::Block;
use crate::mesher::Mesher;
use crate::part::{Material, MeshError, Part, Sink};
use crate::settings::MeshSettings;
use crate::stream::send;
use pleach_plant::Tree;

/// Parts with all their corners and triangles; also the sink that collects them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// What each part is, and the part itself.
    pub parts: Vec<(Part, Block)>,
}

impl Mesh {
    /// The mesh of `tree`, in metres with z up. Empty for a tree without anything to draw.
    #[must_use]
    pub fn new(tree: &Tree, settings: MeshSettings) -> Self {
        let mut mesh = Self::default();
        // The only error is that there is nothing, and this sink never fails.
        let _ = send(&[Mesher::new(tree, settings)], &mut mesh);
        mesh
    }

    /// The part of this material, if there is one.
    #[must_use]
    pub fn part(&self, material: Material) -> Option<&Block> {
        self.parts.iter().find(|(part, _)| part.material == material).map(|(_, block)| block)
    }

    /// Number of triangles of all parts.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|(_, block)| block.triangles.len()).sum()
    }
}

impl Sink for Mesh {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        let room = |part: &Part| {
            let mut block = Block::default();
            block.vertices.reserve_exact(part.count.vertices as usize);
            block.triangles.reserve_exact(part.count.triangles as usize);
            (*part, block)
        };
        self.parts = parts.iter().map(room).collect();
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let whole = &mut self.parts[part].1;
        whole.vertices.append(&mut block.vertices);
        whole.wind.append(&mut block.wind);
        whole.growth.append(&mut block.growth);
        whole.pixels.append(&mut block.pixels);
        whole.joints.append(&mut block.joints);
        whole.instances.append(&mut block.instances);
        whole.triangles.append(&mut block.triangles);
        Ok(())
    }

    fn end(&mut self) -> Result<(), MeshError> {
        Ok(())
    }
}
