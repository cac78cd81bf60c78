//! One tree: its numbers, pictures and skeleton.

use crate::columns::Columns;
use crate::error::DatasetError;
use crate::options::{DatasetOptions, Layer};
use pleach_fit::{NoSample, Prior};
use pleach_silhouette::{Bitmap, Frame, Rasterizer};
use pleach_tree::{Bounds, Parts, Species, StemKind, Tree, Workspace};

/// A knot of a stem: x, y, z and radius in metres, the number of its stem, and that of the stem's parent or −1.
/// Single precision holds positions to a micrometre and every number of a stem of a tree that may grow.
pub(crate) type SkeletonKnot = [f32; 6];

/// What is seen of a tree from one side.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Seen {
    pub(crate) meters_per_pixel: f64,
    pub(crate) silhouette: Bitmap,
    /// Empty unless asked for.
    pub(crate) wood: Bitmap,
    /// Row by row; empty unless asked for.
    pub(crate) depth: Vec<f32>,
}

/// What is saved of a tree.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Example {
    /// The number of its draw among all draws of the data set.
    pub(crate) draw: u64,
    /// Index of its species.
    pub(crate) species: u32,
    /// Its number among the draws of its species.
    pub(crate) number: u32,
    pub(crate) tree_seed: u64,
    /// A row of the columns of all species.
    pub(crate) numbers: Vec<f64>,
    pub(crate) views: Vec<Seen>,
    /// Empty unless asked for.
    pub(crate) skeleton: Vec<SkeletonKnot>,
}

/// Why a draw is no example.
#[derive(Debug, thiserror::Error)]
pub(crate) enum NoExample {
    #[error(transparent)]
    Sample(NoSample),
    #[error("nothing of the tree is seen from azimuth {azimuth}")]
    Unseen { azimuth: f64 },
}

/// Makes examples of some species.
#[derive(Debug)]
pub(crate) struct Maker<'a> {
    pub(crate) options: &'a DatasetOptions,
    pub(crate) priors: &'a [Prior],
    pub(crate) columns: &'a Columns,
}

impl Maker<'_> {
    /// Species and number of draw `draw`: species take turns, so that every shard has trees of all of them.
    pub(crate) fn place(&self, draw: u64) -> (usize, u32) {
        let species = self.priors.len() as u64;
        ((draw % species) as usize, (draw / species) as u32)
    }

    /// The example of draw `draw`.
    pub(crate) fn example(&self, draw: u64, memory: &mut Memory) -> Result<Example, NoExample> {
        let (index, number) = self.place(draw);
        let Memory { workspace, tree, rasterizer } = memory;
        // One tree may be far larger than the others.
        tree.release_spare();
        let prior = &self.priors[index];
        let species = prior.sample_into(self.options.seed, number, workspace, tree);
        let species = species.map_err(NoExample::Sample)?;
        let parts = Parts::from(species.foliage);
        let bounds = Bounds::new(tree, parts);
        let mut views = Vec::with_capacity(self.options.views.len());
        for (view, &azimuth) in self.options.views().zip(&self.options.views) {
            let size = self.options.size;
            let frame = Frame::around(bounds.as_ref(), &view, size, size);
            let mut seen = Seen { meters_per_pixel: frame.meters_per_pixel, ..Seen::default() };
            if self.options.has(Layer::Wood) {
                let pictures = [&mut seen.wood, &mut seen.silhouette];
                rasterizer.draw_with_stems(tree, &view, &frame, parts, pictures);
            } else {
                rasterizer.draw(tree, &view, &frame, parts, &mut seen.silhouette);
            }
            if seen.silhouette.ink() == 0 {
                return Err(NoExample::Unseen { azimuth });
            }
            if self.options.has(Layer::Depth) {
                rasterizer.depth(tree, &view, &frame, parts, &seen.silhouette, &mut seen.depth);
            }
            views.push(seen);
        }
        Ok(Example {
            draw,
            species: index as u32,
            number,
            tree_seed: species.tree_seed.unwrap_or_default(),
            numbers: self.columns.row(index, species.params.values()),
            views,
            skeleton: if self.options.has(Layer::Skeleton) { skeleton(tree) } else { Vec::new() },
        })
    }
}

/// The knots of all stems above the ground, stem by stem from base to tip, parents before children.
fn skeleton(tree: &Tree) -> Vec<SkeletonKnot> {
    let mut knots = Vec::with_capacity(tree.knots.len());
    for (number, stem) in (0..).zip(&tree.stems).filter(|(_, stem)| stem.kind != StemKind::Root) {
        let parent = stem.parent.map_or(-1.0, |parent| parent as f32);
        knots.extend(tree.knots_of(stem).iter().map(|knot| {
            let [x, y, z] = knot.point.as_vec3().to_array();
            [x, y, z, knot.radius as f32, number as f32, parent]
        }));
    }
    knots
}

/// What is kept from one tree to the next: nothing but memory.
pub(crate) struct Memory {
    workspace: Workspace,
    tree: Tree,
    /// Its pictures are those of `pleach silhouette`.
    rasterizer: Rasterizer,
}

impl Memory {
    pub(crate) fn new() -> Self {
        let mut rasterizer = Rasterizer::new();
        // The same pictures, sooner where crowns are dense.
        rasterizer.saturates = true;
        Self { workspace: Workspace::default(), tree: Tree::default(), rasterizer }
    }
}

/// The priors of some species, whose draws are those of `pleach sample`.
pub(crate) fn priors(species: &[Species], options: &DatasetOptions) -> Result<Vec<Prior>, DatasetError> {
    let prior = |one: &Species| {
        let name = || one.name.clone();
        let prior = Prior::new(one, &options.freedom, options.spread);
        let prior = prior.map_err(|source| DatasetError::Space { species: name(), source })?;
        if prior.genes().next().is_none() {
            return Err(DatasetError::NothingVaries { species: name() });
        }
        Ok(prior)
    };
    species.iter().map(prior).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_silhouette::{View, silhouette};

    fn example(options: &DatasetOptions, name: &str, draw: u64) -> Example {
        let species = [pleach_generators::preset(name).unwrap()];
        let (priors, columns) = (priors(&species, options).unwrap(), Columns::new(&species));
        let maker = Maker { options, priors: &priors, columns: &columns };
        maker.example(draw, &mut Memory::new()).unwrap()
    }

    #[test]
    fn an_example_is_a_tree_of_the_prior_as_the_library_draws_it() {
        let options = DatasetOptions {
            layers: Layer::ALL.to_vec(),
            size: 64,
            views: vec![0.0, 90.0, 215.0],
            ..DatasetOptions::default()
        };
        let species = pleach_generators::preset("quaking_aspen").unwrap();
        let prior = Prior::new(&species, &options.freedom, options.spread).unwrap();
        let (sample, tree) = prior.sample(options.seed, 3).unwrap();
        let found = example(&options, "quaking_aspen", 3);
        assert_eq!((found.species, found.number, Some(found.tree_seed)), (0, 3, sample.tree_seed));
        assert_eq!(found.numbers, sample.params.values());
        for (seen, azimuth) in found.views.iter().zip([0.0, 90.0, 215.0]) {
            assert!(seen.silhouette == silhouette(&tree, View::degrees(azimuth, 0.0), 64), "{azimuth}");
            assert!(seen.wood.ink() > 0 && seen.wood.ink() < seen.silhouette.ink());
            let is_seen = seen.depth.iter().map(|depth| depth.is_finite());
            let pixels = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
            assert!(is_seen.eq(pixels.map(|(x, y)| seen.silhouette.get(x, y))), "{azimuth}");
        }
        let trunk: Vec<_> = found.skeleton.iter().filter(|knot| knot[4] == 0.0).collect();
        assert_eq!((trunk[0][2], trunk[0][5]), (0.0, -1.0));
        assert_eq!(found.skeleton.len(), tree.knots.len());
        assert!(found.skeleton.iter().all(|knot| knot[5] < knot[4]), "parents come first");
        let last = found.skeleton.last().unwrap();
        let knot = tree.knots.last().unwrap();
        assert_eq!(
            last[..4],
            [knot.point.x as f32, knot.point.y as f32, knot.point.z as f32, knot.radius as f32]
        );
    }

    #[test]
    fn species_take_turns() {
        let options = DatasetOptions { size: 16, views: vec![0.0], ..DatasetOptions::default() };
        let species = ["palm", "acer"].map(|name| pleach_generators::preset(name).unwrap());
        let (priors, columns) = (priors(&species, &options).unwrap(), Columns::new(&species));
        let maker = Maker { options: &options, priors: &priors, columns: &columns };
        assert_eq!([0, 1, 2, 3].map(|draw| maker.place(draw)), [(0, 0), (1, 0), (0, 1), (1, 1)]);
        // A species has the same trees whatever others there are.
        let both = maker.example(3, &mut Memory::new()).unwrap();
        let alone = example(&options, "acer", 1);
        assert_eq!((both.tree_seed, both.views), (alone.tree_seed, alone.views));
    }
}
