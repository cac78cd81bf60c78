//! From a tree to blocks of triangles: sizes first, then any run of stems or leaves.

use crate::block::Block;
use crate::foliage::UnitMesh;
use crate::part::{Count, Material, Part, Source};
use crate::rig::Rig;
use crate::settings::MeshSettings;
use crate::tube::{Rings, Tubes};
use crate::wind;
use pleach_tree::{Leaf, StemKind, Tree};
use rayon::prelude::*;
use std::ops::Range;

/// Stems with about this many corners make a block: a few hundred kilobytes.
const BLOCK_VERTICES: u64 = 16_384;

/// A tree about to be meshed, with the size of every part known.
#[derive(Debug)]
pub struct Mesher<'a> {
    tree: &'a Tree,
    settings: MeshSettings,
    rig: Option<&'a Rig>,
    tubes: Tubes,
    leaf: UnitMesh,
    blossom: UnitMesh,
    /// Corners before each stem's, and v where the stem starts, in metres.
    stems: Vec<StemStart>,
    bark: Count,
    blocks: Vec<Range<usize>>,
    instanced: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct StemStart {
    vertex: u64,
    along: f64,
}

impl<'a> Mesher<'a> {
    /// Measures `tree`; settings out of range are moved into it.
    #[must_use]
    pub fn new(tree: &'a Tree, settings: MeshSettings) -> Self {
        let settings = settings.clamped();
        let tubes = Tubes::new(settings);
        let counts: Vec<Count> = tree
            .stems
            .par_iter()
            .map_init(Rings::default, |rings, stem| {
                rings.sample(tree, stem, tubes.tolerance());
                tubes.count(rings)
            })
            .collect();
        let mut stems: Vec<StemStart> = Vec::with_capacity(counts.len());
        let (mut bark, mut blocks, mut first) = (Count::default(), Vec::new(), 0);
        for (i, (stem, &count)) in tree.stems.iter().zip(&counts).enumerate() {
            let along = match (stem.kind, stem.parent) {
                (StemKind::Fork, Some(parent)) => stems[parent as usize].along + stem.offset,
                _ => 0.0,
            };
            stems.push(StemStart { vertex: bark.vertices, along });
            bark += count;
            if bark.vertices - stems[first].vertex >= BLOCK_VERTICES {
                blocks.push(first..i + 1);
                first = i + 1;
            }
        }
        if first < counts.len() {
            blocks.push(first..counts.len());
        }
        Self {
            tree,
            settings,
            rig: None,
            leaf: tree.leaf_shapes.first().map(|s| UnitMesh::leaf(s, settings.leaves)).unwrap_or_default(),
            blossom: tree
                .blossom_shapes
                .first()
                .map(|&s| UnitMesh::blossom(s, settings.leaves))
                .unwrap_or_default(),
            tubes,
            stems,
            bark,
            blocks,
            instanced: false,
        }
    }

    /// Sends each leaf and blossom as a placement of one shape, for formats that have instances.
    #[must_use]
    pub fn with_instanced_leaves(mut self) -> Self {
        self.instanced = true;
        self
    }

    /// Sends with each corner the number of the joint of `rig` that moves it.
    #[must_use]
    pub fn with_rig(mut self, rig: &'a Rig) -> Self {
        self.rig = Some(rig);
        self
    }

    /// Corners and triangles of all parts together.
    #[must_use]
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        self.parts(0).iter().for_each(|p| count += p.count);
        count
    }

    /// Number of the first corner of stem number `stem` in the bark.
    ///
    /// # Panics
    /// If the tree has no such stem.
    #[must_use]
    pub fn first_vertex(&self, stem: usize) -> u64 {
        self.stems[stem].vertex
    }

    fn placed(&self, material: Material) -> Option<(&'a [Leaf], &UnitMesh)> {
        match material {
            Material::Bark | Material::Card => None,
            Material::Leaf => Some((&self.tree.leaves, &self.leaf)),
            Material::Blossom => Some((&self.tree.blossoms, &self.blossom)),
        }
    }

    fn fill_stems(&self, range: Range<usize>, block: &mut Block) {
        let mut rings = Rings::default();
        for i in range {
            let StemStart { vertex, along } = self.stems[i];
            rings.sample(self.tree, &self.tree.stems[i], self.tubes.tolerance());
            let first = block.vertices.len();
            self.tubes.push(&rings, vertex as u32, along, block);
            let length = rings.rings.last().map_or(1.0, |r| r.along).max(1e-6);
            if self.settings.wind {
                let wind = wind::of_stem(self.tree, i);
                block.wind.extend(block.vertices[first..].iter().map(|v| {
                    let mut wind = wind;
                    wind.place = ((f64::from(v.uv.y) - along) / length).clamp(0.0, 1.0) as f32;
                    wind
                }));
            }
            if let Some(rig) = self.rig {
                let joint = |v: &crate::Vertex| rig.joint_at(i as u32, f64::from(v.uv.y) - along);
                block.joints.extend(block.vertices[first..].iter().map(joint));
            }
        }
    }
}

impl Source for Mesher<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let part = |material| {
            let (count, placed) = match self.placed(material) {
                None => (self.bark, 1),
                Some((leaves, shape)) => (shape.count(), leaves.len() as u64),
            };
            let instanced = self.instanced && material != Material::Bark;
            let times = if instanced { placed.min(1) } else { placed };
            Part {
                mesh,
                material,
                count: Count { vertices: count.vertices * times, triangles: count.triangles * times },
                instances: if instanced { placed } else { 0 },
                wind: self.settings.wind && !instanced,
                rigged: self.rig.is_some() && !instanced,
            }
        };
        Material::ALL.into_iter().map(part).filter(|p| p.count.triangles > 0).collect()
    }

    /// The stems or leaves of each block of a part.
    fn ranges(&self, material: Material) -> Vec<Range<usize>> {
        let Some((leaves, shape)) = self.placed(material) else { return self.blocks.clone() };
        let size = (BLOCK_VERTICES / shape.count().vertices.max(1)).max(1) as usize;
        (0..leaves.len()).step_by(size).map(|i| i..(i + size).min(leaves.len())).collect()
    }

    /// Appends the stems or leaves of `range` to `block`.
    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block) {
        let Some((leaves, shape)) = self.placed(material) else {
            return self.fill_stems(range, block);
        };
        if self.instanced {
            if range.start == 0 {
                shape.push(&UNIT, 0, block);
            }
            block.instances.extend(leaves[range].iter().map(placement));
            return;
        }
        let size = shape.count().vertices;
        for i in range {
            let leaf = &leaves[i];
            shape.push(leaf, (i as u64 * size) as u32, block);
            if self.settings.wind {
                let wind = wind::of_leaf(leaf, i, &self.tree.stems[leaf.stem as usize]);
                let first = block.wind.len();
                block.wind.extend(block.vertices[first..].iter().map(|v| {
                    let mut wind = wind;
                    // The tip, at v = 0, moves most.
                    wind.place = 1.0 - v.uv.y;
                    wind
                }));
            }
            if let Some(rig) = self.rig {
                let joint = rig.joint_near(leaf.stem, leaf.position.as_dvec3());
                block.joints.resize(block.vertices.len(), joint);
            }
        }
    }
}

/// Where the unit shape stands as it is.
const UNIT: Leaf =
    Leaf { position: glam::Vec3::ZERO, along: glam::Vec3::Y, across: glam::Vec3::X, stem: 0, shape: 0 };

/// Translation, rotation and scale that carry the unit shape to `leaf`.
fn placement(leaf: &Leaf) -> crate::block::Placement {
    let (width, length) = (leaf.across.length(), leaf.along.length());
    let x = leaf.across.try_normalize().unwrap_or(glam::Vec3::X);
    let y = (leaf.along - x * leaf.along.dot(x)).try_normalize().unwrap_or(glam::Vec3::Y);
    let rotation = glam::Quat::from_mat3(&glam::Mat3::from_cols(x, y, x.cross(y)));
    crate::block::Placement { translation: leaf.position, rotation, scale: glam::vec3(width, length, length) }
}
