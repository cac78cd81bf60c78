//! From a tree to blocks of triangles: sizes first, then any run of stems or leaves.

use crate::blobs::{self, Cover};
use crate::block::{Block, Emergence, Wind};
use crate::foliage::UnitMesh;
use crate::growth::Ages;
use crate::part::{Count, Material, Part, Source};
use crate::pivots::Pivots;
use crate::placed::{self, Placed, Shapes};
use crate::rig::Rig;
use crate::settings::{LeafStyle, MeshSettings};
use crate::tube::{Rings, Tubes};
use crate::twigs::Twigs;
use crate::wind::Bodies;
use glam::{Vec2, Vec3};
use pleach_plant::{Leaf, Parts, Stem, StemKind, Tree};
use rayon::prelude::*;
use std::ops::Range;

/// Stems with about this many corners make a block: a few hundred kilobytes.
const BLOCK_VERTICES: u64 = 16_384;

/// A tree about to be meshed, with the size of every part known.
#[derive(Debug)]
pub struct Mesher<'a> {
    tree: &'a Tree,
    settings: MeshSettings,
    /// Whether each stem is left out; none after the end of the list.
    left_out: &'a [bool],
    rig: Option<&'a Rig>,
    /// What turns in wind, where that was asked for.
    bodies: Option<Bodies>,
    /// When every place comes to be, where that was asked for.
    ages: Option<Ages<'a>>,
    /// For each stem the pixel of what it turns with, where pivots were given.
    pixels: Option<Vec<Vec2>>,
    tubes: Tubes,
    leaves: Placed<'a>,
    blossoms: Placed<'a>,
    /// Cards that stand for twigs, and what they are.
    cards: Placed<'a>,
    twigs: Option<&'a Twigs>,
    /// Vertices and triangles of the blobs, which follow the leaves.
    blobs: Count,
    /// What blobs show.
    cover: Cover,
    /// Corners before each stem's, and texture tiles below it.
    stems: Vec<StemStart>,
    bark: Count,
    blocks: Vec<Range<usize>>,
    instanced: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct StemStart {
    vertex: u64,
    tiles: f64,
}

/// What is measured of a stem.
#[derive(Clone, Debug, Default)]
struct Measured {
    count: Count,
    /// Of each of its forks in turn: texture tiles from its own base to where the fork goes on.
    forks: Vec<f64>,
}

impl<'a> Mesher<'a> {
    /// Measures `tree`; settings out of range are moved into it.
    #[must_use]
    pub fn new(tree: &'a Tree, settings: MeshSettings) -> Self {
        Self::without(tree, settings, &[])
    }

    /// The same without the stems for which `left_out` says so. What hangs on them is drawn.
    #[must_use]
    pub fn without(tree: &'a Tree, settings: MeshSettings, left_out: &'a [bool]) -> Self {
        let settings = settings.clamped();
        let tubes = Tubes::new(settings);
        let forks = Forks::new(tree);
        let measured: Vec<Measured> = tree
            .stems
            .par_iter()
            .enumerate()
            .map_init(Rings::default, |rings, (i, stem)| {
                if !is_drawn(settings, left_out, i, stem) {
                    return Measured::default();
                }
                rings.sample(tree, stem, tubes.tolerance());
                let forks = forks.of_stem(i).map(|fork| rings.tiles_at(tree.stems[fork].offset));
                Measured { count: tubes.count(rings), forks: forks.collect() }
            })
            .collect();
        let mut stems: Vec<StemStart> = Vec::with_capacity(measured.len());
        let (mut bark, mut blocks, mut first) = (Count::default(), Vec::new(), 0);
        for (i, Measured { count, .. }) in measured.iter().enumerate() {
            let goes_on = forks.place(i).and_then(|(parent, place)| {
                let below: &StemStart = stems.get(parent)?;
                Some(below.tiles + measured[parent].forks.get(place)?)
            });
            let tiles = goes_on.unwrap_or(0.0);
            stems.push(StemStart { vertex: bark.vertices, tiles });
            bark += *count;
            if bark.vertices - stems[first].vertex >= BLOCK_VERTICES {
                blocks.push(first..i + 1);
                first = i + 1;
            }
        }
        if first < measured.len() {
            blocks.push(first..measured.len());
        }
        let has = |part| settings.parts.contains(part);
        let leaves = if has(Parts::LEAVES) { &tree.leaves[..] } else { &[] };
        let leaf_shapes = leaf_shapes(tree, settings);
        let blossoms = if has(Parts::BLOSSOMS) { &tree.blossoms[..] } else { &[] };
        let blossom_shapes = blossom_shapes(tree, settings);
        let heart = if settings.rounded { placed::heart(leaves.iter().chain(blossoms)) } else { None };
        let shows_blobs = has(Parts::BLOBS) && settings.leaves != LeafStyle::None;
        let leaves = Placed::new(leaves, leaf_shapes, BLOCK_VERTICES).rounded(heart);
        let cover = if settings.pictured && blobs::have_tiles(tree) {
            Cover::Tiles
        } else {
            Cover::Spot(leaves.somewhere())
        };
        let blobs = if shows_blobs { blobs::count(tree, cover) } else { Count::default() };
        Self {
            tree,
            settings,
            left_out,
            rig: None,
            bodies: settings.wind.then(|| Bodies::new(tree)),
            ages: settings.growth.then(|| Ages::new(tree)),
            pixels: None,
            leaves,
            blossoms: Placed::new(blossoms, blossom_shapes, BLOCK_VERTICES).rounded(heart),
            cards: Placed::new(&[], Shapes::plain(Vec::new()), BLOCK_VERTICES),
            twigs: None,
            blobs,
            cover,
            tubes,
            stems,
            bark,
            blocks,
            instanced: false,
        }
    }

    /// Sends each leaf as a placement of one shape, and each blossom, for formats that have instances.
    /// Where leaves have several shapes, or there are blobs among them, they come as triangles.
    #[must_use]
    pub fn with_instanced_leaves(mut self) -> Self {
        self.instanced = true;
        self
    }

    /// Adds cards that stand for twigs; their stems are those of the tree.
    #[must_use]
    pub fn with_twigs(mut self, twigs: &'a Twigs) -> Self {
        let shapes = twigs.cells().into_iter().map(UnitMesh::card).collect();
        self.cards = Placed::new(&twigs.cards, Shapes::plain(shapes), BLOCK_VERTICES);
        self.twigs = Some(twigs);
        self
    }

    /// Grows at the pace of `whole`, of which the tree is what a level of detail has left.
    #[must_use]
    pub fn growing_with(mut self, whole: &Tree) -> Self {
        self.ages = self.ages.map(|ages| ages.at_pace_of(&Ages::new(whole)));
        self
    }

    /// Sends with each corner the number of the joint of `rig` that moves it.
    #[must_use]
    pub fn with_rig(mut self, rig: &'a Rig) -> Self {
        self.rig = Some(rig);
        self
    }

    /// Sends with each corner the pixel of the element of `pivots` that it belongs to. They are of the tree, or of the one
    /// that the tree is a level of detail of.
    ///
    /// # Panics
    /// If they are of another tree.
    #[must_use]
    pub fn with_pivots(mut self, pivots: &Pivots) -> Self {
        self.pixels = Some(pivots.pixels(self.tree));
        self
    }

    /// Corners and triangles of all parts together.
    #[must_use]
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        self.parts(0).iter().for_each(|p| count += p.count);
        count
    }

    /// Corners and triangles of the stems.
    #[must_use]
    pub const fn bark(&self) -> Count {
        self.bark
    }

    /// Number of the first corner of stem number `stem` in the bark.
    ///
    /// # Panics
    /// If the tree has no such stem.
    #[must_use]
    pub fn first_vertex(&self, stem: usize) -> u64 {
        self.stems[stem].vertex
    }

    fn placed(&self, material: Material) -> Option<&Placed<'a>> {
        match material {
            Material::Bark | Material::Card | Material::Collision => None,
            Material::Leaf => Some(&self.leaves),
            Material::Blossom => Some(&self.blossoms),
            Material::Twig => Some(&self.cards),
        }
    }

    /// The one shape of which `material` is made, if it is sent as instances.
    fn instanced(&self, material: Material) -> Option<&UnitMesh> {
        let has_blobs = material == Material::Leaf && self.blobs.triangles > 0;
        let is_placed = self.instanced && !has_blobs && material != Material::Twig;
        let placed = self.placed(material).filter(|_| is_placed)?;
        placed.only_shape()
    }

    /// Whether vertices have wind data.
    pub(crate) const fn has_wind(&self) -> bool {
        self.settings.wind
    }

    /// Wind data of a vertex that moves with stem number `stem`, where it is asked for.
    pub(crate) fn wind_of(&self, stem: u32) -> Option<Wind> {
        self.bodies.as_ref().map(|bodies| bodies.of_stem(stem as usize))
    }

    fn fill_stems(&self, range: Range<usize>, block: &mut Block) {
        let (mut rings, mut spots) = (Rings::default(), Vec::new());
        for i in range {
            if !is_drawn(self.settings, self.left_out, i, &self.tree.stems[i]) {
                continue;
            }
            let StemStart { vertex, tiles } = self.stems[i];
            rings.sample(self.tree, &self.tree.stems[i], self.tubes.tolerance());
            self.tubes.push(&rings, vertex as u32, tiles, block, &mut spots);
            if let Some(bodies) = &self.bodies {
                block.wind.resize(block.vertices.len(), bodies.of_stem(i));
            }
            if let Some(ages) = &self.ages {
                let new = block.vertices[block.growth.len()..].iter().zip(&spots);
                block.growth.extend(new.map(|(vertex, spot)| Emergence {
                    time: ages.at(i as u32, f64::from(spot.along)),
                    toward: spot.center - vertex.position,
                }));
            }
            if let Some(pixels) = &self.pixels {
                block.pixels.resize(block.vertices.len(), pixels[i]);
            }
            if let Some(rig) = self.rig {
                block.joints.extend(spots.iter().map(|spot| rig.joint_at(i as u32, f64::from(spot.along))));
            }
        }
    }
}

/// Whether stem number `i` is among what is drawn.
fn is_drawn(settings: MeshSettings, left_out: &[bool], i: usize, stem: &Stem) -> bool {
    settings.parts.has_stem(stem.kind) && !left_out.get(i).copied().unwrap_or(false)
}

/// The meshes of a tree's leaves.
pub(crate) fn leaf_shapes(tree: &Tree, settings: MeshSettings) -> Shapes {
    let shapes = &tree.leaf_shapes;
    if settings.pictured {
        let mesh = |i: usize, form| UnitMesh::leaf_in_form(&shapes[i], settings.leaves, form);
        return Shapes::in_forms(shapes.len(), mesh);
    }
    Shapes::plain(shapes.iter().map(|shape| UnitMesh::leaf(shape, settings.leaves)).collect())
}

/// The meshes of a tree's blossoms, whose forms differ in their pictures alone.
pub(crate) fn blossom_shapes(tree: &Tree, settings: MeshSettings) -> Shapes {
    let (shapes, style) = (&tree.blossom_shapes, settings.blossoms.unwrap_or(settings.leaves));
    let mesh = |shape| UnitMesh::blossom(shape, style);
    if settings.pictured {
        return Shapes::in_forms(shapes.len(), |i, _| mesh(shapes[i]));
    }
    Shapes::plain(shapes.iter().map(|&shape| mesh(shape)).collect())
}

/// The forks of each stem, whose bark goes on from it.
struct Forks<'a> {
    tree: &'a Tree,
    /// Parent and number of each fork, by parent.
    all: Vec<(usize, usize)>,
}

/// The parent of a stem that is a fork.
fn left(stem: &Stem) -> Option<usize> {
    stem.parent.filter(|_| stem.kind == StemKind::Fork).map(|parent| parent as usize)
}

impl<'a> Forks<'a> {
    fn new(tree: &'a Tree) -> Self {
        let numbered = tree.stems.iter().enumerate();
        let mut all: Vec<_> = numbered.filter_map(|(i, stem)| Some((left(stem)?, i))).collect();
        all.sort_unstable();
        Self { tree, all }
    }

    /// Number of the first fork of stem number `stem`.
    fn first_of(&self, stem: usize) -> usize {
        self.all.partition_point(|(parent, _)| *parent < stem)
    }

    /// The parent of stem number `stem` and which of its forks it is; `None` if it is no fork.
    fn place(&self, stem: usize) -> Option<(usize, usize)> {
        let parent = left(&self.tree.stems[stem])?;
        let place = self.all.binary_search(&(parent, stem)).ok()?;
        Some((parent, place - self.first_of(parent)))
    }

    /// The forks of stem number `stem`, in turn.
    fn of_stem(&self, stem: usize) -> impl Iterator<Item = usize> + '_ {
        self.all[self.first_of(stem)..]
            .iter()
            .take_while(move |(parent, _)| *parent == stem)
            .map(|(_, fork)| *fork)
    }
}

impl Source for Mesher<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let part = |material| {
            let placed = self.placed(material);
            let instances =
                placed.filter(|_| self.instanced(material).is_some()).map(|p| p.leaves.len() as u64);
            let mut count = match (placed, self.instanced(material)) {
                (None, _) => self.bark,
                (Some(placed), None) => placed.count,
                (Some(placed), Some(_)) if placed.leaves.is_empty() => Count::default(),
                (Some(_), Some(shape)) => shape.count(),
            };
            if material == Material::Leaf {
                count += self.blobs;
            }
            Part {
                mesh,
                material,
                count,
                instances: instances.unwrap_or(0),
                wind: self.settings.wind && instances.is_none(),
                growth: self.settings.growth && instances.is_none(),
                pixels: self.pixels.is_some() && instances.is_none(),
                rigged: self.rig.is_some() && instances.is_none(),
            }
        };
        Material::ALL.into_iter().map(part).filter(|p| p.count.triangles > 0).collect()
    }

    /// The stems or leaves of each block of a part; blobs are numbered after all leaves.
    fn ranges(&self, material: Material) -> Vec<Range<usize>> {
        let Some(placed) = self.placed(material) else { return self.blocks.clone() };
        let mut ranges: Vec<Range<usize>> = placed.ranges().collect();
        if material == Material::Leaf && self.blobs.triangles > 0 {
            let first = placed.leaves.len();
            ranges.push(first..first + self.tree.blobs.len());
        }
        ranges
    }

    /// Appends the stems, leaves or blobs of `range` to `block`.
    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block) {
        let Some(placed) = self.placed(material) else {
            return self.fill_stems(range, block);
        };
        if let Some(shape) = self.instanced(material) {
            if range.start == 0 {
                shape.push(&placed::UNIT, 0, block);
            }
            block.instances.extend(placed.leaves[range].iter().map(placed::placement));
        } else if range.start < placed.leaves.len() {
            placed.fill(range, block, |i, block| {
                if let (Material::Twig, Some(twigs)) = (material, self.twigs) {
                    let corners = block.vertices.iter_mut().rev().take(4);
                    corners.for_each(|corner| corner.normal = twigs.normal(corner.position));
                }
                self.add_of_leaf(material, &placed.leaves[i], block);
            });
        } else {
            self.fill_blobs(placed.count.vertices, block);
        }
    }
}

impl Mesher<'_> {
    /// Wind data, growth data, pixels and joints of the vertices of `leaf`, which were added last.
    fn add_of_leaf(&self, material: Material, leaf: &Leaf, block: &mut Block) {
        if let Some(bodies) = &self.bodies {
            let first = block.wind.len();
            let along = leaf.along / leaf.along.length_squared().max(f32::MIN_POSITIVE);
            block.wind.extend(block.vertices[first..].iter().enumerate().map(|(corner, vertex)| {
                // The tip moves most: the last two corners of a card.
                let is_tip = if corner < 2 { 0.0 } else { 1.0 };
                let along = (vertex.position - leaf.position).dot(along).clamp(0.0, 1.0);
                let place = if material == Material::Twig { is_tip } else { along };
                bodies.of_leaf(leaf, place)
            }));
        }
        if let Some(ages) = &self.ages {
            come_from(leaf.position, ages.near(leaf.stem, leaf.position), block);
        }
        if let Some(pixels) = &self.pixels {
            block.pixels.resize(block.vertices.len(), pixels[leaf.stem as usize]);
        }
        if let Some(rig) = self.rig {
            let joint = rig.joint_near(leaf.stem, leaf.position.as_dvec3());
            block.joints.resize(block.vertices.len(), joint);
        }
    }

    /// All blobs, whose vertices count from `base`. A blob moves with the tip of its stem.
    fn fill_blobs(&self, base: u64, block: &mut Block) {
        for blob in &self.tree.blobs {
            blobs::push(self.tree, blob, self.cover, (base + block.vertices.len() as u64) as u32, block);
            if let Some(bodies) = &self.bodies {
                block.wind.resize(block.vertices.len(), bodies.of_stem(blob.stem as usize));
            }
            if let Some(ages) = &self.ages {
                let tip = self.tree.knots_of(&self.tree.stems[blob.stem as usize]).last();
                let tip = tip.map_or(Vec3::ZERO, |knot| knot.point.as_vec3());
                come_from(tip, ages.near(blob.stem, tip), block);
            }
            if let Some(pixels) = &self.pixels {
                block.pixels.resize(block.vertices.len(), pixels[blob.stem as usize]);
            }
            if let Some(rig) = self.rig {
                block.joints.resize(block.vertices.len(), rig.joint_at(blob.stem, f64::INFINITY));
            }
        }
    }
}

/// Growth data of the vertices that were added last, which come from `point` at `time`.
fn come_from(point: Vec3, time: f32, block: &mut Block) {
    let new = &block.vertices[block.growth.len()..];
    block.growth.extend(new.iter().map(|vertex| Emergence { time, toward: point - vertex.position }));
}
