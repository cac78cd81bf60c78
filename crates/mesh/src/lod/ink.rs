//! How much of a picture a tree covers, and cards of the size that covers as much.
//!
//! A card is flat where a twig is round, and seen from its edge it is nothing: cards of the size of their twigs cover
//! less. What a tree and a level cover is counted on a grid from two sides, and all cards of the level grow about
//! their middles by one factor, but none to more than twice the size of the twig that it shows: a few groups lie far
//! apart on their stem, and their card would show a leaf of a metre.

use crate::block::Block;
use crate::foliage::UnitMesh;
use crate::mesher::Mesher;
use crate::part::Source as _;
use crate::settings::{LeafStyle, MeshSettings};
use crate::twigs::{MAX_GROWTH, TwigModel, Twigs};
use glam::{Vec2, Vec3, vec2};
use pleach_plant::{Leaf, Tree};
use rayon::prelude::*;

/// Cells along the longer side of the grid.
const CELLS: usize = 512;
/// Cells along a side of the grid that shows what a card's picture covers.
const CARD_CELLS: usize = 64;
/// Size that is tried after 1.
const FIRST: f32 = 1.2;
/// Sizes that are tried at most.
const STEPS: u32 = 4;

/// A grid of cells that are covered or not.
#[derive(Clone, Debug)]
struct Grid {
    width: usize,
    height: usize,
    cells: Vec<bool>,
}

impl Grid {
    fn new(width: usize, height: usize) -> Self {
        Self { width, height, cells: vec![false; width * height] }
    }

    /// Covers the cells whose middle lies in a triangle and of which `covers` says so, by their weights of the corners.
    fn fill(&mut self, [a, b, c]: [Vec2; 3], covers: impl Fn([f32; 3]) -> bool) {
        let whole = (b - a).perp_dot(c - a);
        if whole.abs() < 1e-12 {
            return;
        }
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        // The cells whose middles are between two numbers.
        let between = |low: f32, high: f32, count: usize| {
            ((low - 0.5).max(0.0).ceil() as usize)..((high + 0.5).max(0.0) as usize).min(count)
        };
        for y in between(low.y, high.y, self.height) {
            for x in between(low.x, high.x, self.width) {
                let at = vec2(x as f32 + 0.5, y as f32 + 0.5);
                let (wb, wc) = ((at - a).perp_dot(c - a) / whole, (b - a).perp_dot(at - a) / whole);
                let weights = [1.0 - wb - wc, wb, wc];
                if weights.iter().all(|weight| *weight >= 0.0) && covers(weights) {
                    self.cells[y * self.width + x] = true;
                }
            }
        }
    }

    fn covered(&self) -> usize {
        self.cells.iter().filter(|covered| **covered).count()
    }
}

/// A side from which a tree is seen.
#[derive(Clone, Copy, Debug)]
struct Side {
    right: Vec3,
    low: Vec2,
    scale: f32,
    cells: [usize; 2],
}

impl Side {
    fn place(&self, point: Vec3) -> Vec2 {
        (self.flat(point) - self.low) * self.scale
    }

    fn flat(&self, point: Vec3) -> Vec2 {
        vec2(point.dot(self.right), point.z)
    }
}

/// What a tree covers from two sides.
#[derive(Debug)]
pub(super) struct Ink {
    sides: Vec<Side>,
    covered: usize,
}

impl Ink {
    pub(super) fn new(tree: &Tree, settings: MeshSettings) -> Self {
        let leaves = if settings.leaves == LeafStyle::None { LeafStyle::None } else { LeafStyle::Simple };
        let settings = MeshSettings { tolerance: 4.0 * settings.tolerance, min_sides: 3, leaves, ..settings };
        let mesher = Mesher::new(tree, settings);
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        each_triangle(&mesher, |corners| {
            for corner in corners {
                (low, high) = (low.min(corner), high.max(corner));
            }
        });
        let sides = [Vec3::X, Vec3::Y].map(|right| {
            let flat = |point: Vec3| vec2(point.dot(right), point.z);
            // What grown cards reach beyond the tree is counted too.
            let (low, high) = (flat(low), flat(high));
            let margin = (high - low) * 0.05;
            let size = (high - low + margin * 2.0).max(Vec2::splat(1e-3));
            let scale = CELLS as f32 / size.max_element();
            let cells = (size * scale).to_array().map(|side| side.ceil() as usize);
            Side { right, low: low - margin, scale, cells }
        });
        let mut grids = grids(&sides);
        each_triangle(&mesher, |corners| draw(&sides, &mut grids, corners));
        Self { sides: sides.to_vec(), covered: grids.iter().map(Grid::covered).sum() }
    }

    /// Gives the cards of `twigs` the size with which they and `bark` cover as much as the tree does.
    pub(super) fn fit(&self, twigs: &mut Twigs, tree: &Tree, bark: &Mesher<'_>) {
        let mut wood = grids(&self.sides);
        each_triangle(bark, |corners| draw(&self.sides, &mut wood, corners));
        let pictures: Vec<Grid> = twigs.models.iter().map(|model| picture(tree, model)).collect();
        let covered = |growth: f32| {
            let of_side = |(side, wood): (&Side, &Grid)| {
                let mut grid = wood.clone();
                for card in &twigs.cards {
                    let shape = usize::from(card.shape);
                    let grown = twigs.models[shape].limited(grown(card, growth));
                    show(&grown, side, &mut grid, &pictures[shape]);
                }
                grid.covered()
            };
            self.sides.par_iter().zip(&wood).map(of_side).sum::<usize>() as f32
        };
        let wanted = self.covered as f32;
        // What is covered grows nearly evenly with the size, so that a line through the last two finds the next.
        let mut last = (1.0, covered(1.0));
        let mut size = FIRST;
        for _ in 0..STEPS {
            let now = (size, covered(size));
            let slope = (now.1 - last.1) / (now.0 - last.0);
            let next = if slope > 0.0 { now.0 + (wanted - now.1) / slope } else { now.0 };
            (last, size) = (now, next.clamp(1.0 / MAX_GROWTH, MAX_GROWTH));
            if (size - last.0).abs() < 1e-3 {
                break;
            }
        }
        for card in &mut twigs.cards {
            *card = twigs.models[usize::from(card.shape)].limited(grown(card, size));
        }
    }
}

fn grids(sides: &[Side]) -> Vec<Grid> {
    sides.iter().map(|side| Grid::new(side.cells[0], side.cells[1])).collect()
}

fn draw(sides: &[Side], grids: &mut [Grid], corners: [Vec3; 3]) {
    for (side, grid) in sides.iter().zip(grids) {
        grid.fill(corners.map(|corner| side.place(corner)), |_| true);
    }
}

/// A card that has grown about its middle.
fn grown(card: &Leaf, growth: f32) -> Leaf {
    Leaf {
        position: card.position - card.along * (0.5 * (growth - 1.0)),
        along: card.along * growth,
        across: card.across * growth,
        ..*card
    }
}

/// Draws a card, which shows `picture`.
fn show(card: &Leaf, side: &Side, grid: &mut Grid, picture: &Grid) {
    let corner = |(x, y): (f32, f32)| side.place(card.position + card.across * x + card.along * y);
    let ends = [(-0.5, 0.0), (0.5, 0.0), (0.5, 1.0), (-0.5, 1.0)];
    for triangle in [[0, 1, 2], [0, 2, 3]] {
        grid.fill(triangle.map(|k: usize| corner(ends[k])), |weights| {
            let at = (0..3).map(|k| Vec2::from(ends[triangle[k]]) * weights[k]).sum::<Vec2>();
            let cell = |part: f32| ((part * CARD_CELLS as f32).max(0.0) as usize).min(CARD_CELLS - 1);
            picture.cells[cell(at.y) * CARD_CELLS + cell(at.x + 0.5)]
        });
    }
}

/// What the picture of a twig covers of its card, from its foot upwards.
fn picture(tree: &Tree, model: &TwigModel) -> Grid {
    let card = &model.card;
    let size = vec2(card.across.length_squared(), card.along.length_squared()).max(Vec2::splat(1e-12));
    let place = |point: Vec3| {
        let from = point - card.position;
        (vec2(from.dot(card.across), from.dot(card.along)) / size + vec2(0.5, 0.0)) * CARD_CELLS as f32
    };
    let mut grid = Grid::new(CARD_CELLS, CARD_CELLS);
    let mut block = Block::default();
    let mut push = |leaf: &Leaf, mesh: &UnitMesh, block: &mut Block| {
        block.clear();
        mesh.push(leaf, 0, block);
        for triangle in &block.triangles {
            grid.fill(triangle.map(|i| place(block.vertices[i as usize].position)), |_| true);
        }
    };
    let shapes: Vec<UnitMesh> =
        tree.leaf_shapes.iter().map(|shape| UnitMesh::leaf(shape, LeafStyle::Simple)).collect();
    for &leaf in &model.leaves {
        let leaf = &tree.leaves[leaf as usize];
        push(leaf, &shapes[usize::from(leaf.shape)], &mut block);
    }
    let shapes: Vec<UnitMesh> =
        tree.blossom_shapes.iter().map(|&shape| UnitMesh::blossom(shape, LeafStyle::Simple)).collect();
    for &blossom in &model.blossoms {
        let blossom = &tree.blossoms[blossom as usize];
        push(blossom, &shapes[usize::from(blossom.shape)], &mut block);
    }
    for &stem in &model.stems {
        for pair in tree.knots_of(&tree.stems[stem as usize]).windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|knot| place(knot.point.as_vec3()));
            // As wide as the picture has it: as if it stood upright.
            let side =
                (b - a).perp().normalize_or_zero() * CARD_CELLS as f32 / card.across.length().max(1e-6);
            let [wide, narrow] = [pair[0].radius, pair[1].radius].map(|radius| side * radius as f32);
            let corners = [a - wide, a + wide, b + narrow, b - narrow];
            grid.fill([corners[0], corners[1], corners[2]], |_| true);
            grid.fill([corners[0], corners[2], corners[3]], |_| true);
        }
    }
    grid
}

fn each_triangle(mesher: &Mesher<'_>, mut see: impl FnMut([Vec3; 3])) {
    let mut block = Block::default();
    for part in mesher.parts(0) {
        let mut first = 0;
        for range in mesher.ranges(part.material) {
            block.clear();
            mesher.fill(part.material, range, &mut block);
            for triangle in &block.triangles {
                see(triangle.map(|corner| block.vertices[corner as usize - first].position));
            }
            first += block.vertices.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::budgets;
    use super::*;

    #[test]
    fn a_grid_counts_areas() {
        let mut grid = Grid::new(100, 100);
        grid.fill([vec2(10.0, 10.0), vec2(90.0, 10.0), vec2(10.0, 90.0)], |_| true);
        assert!(grid.covered().abs_diff(3200) < 60, "{}", grid.covered());
        grid.fill([vec2(-50.0, -50.0), vec2(500.0, -50.0), vec2(-50.0, 500.0)], |_| true);
        assert_eq!(grid.covered(), 100 * 100);
    }

    #[test]
    fn cards_cover_what_the_tree_covers() {
        for name in ["quaking_aspen", "hill_cherry", "small_pine"] {
            let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
            let settings = MeshSettings::default();
            let ink = Ink::new(&tree, settings);
            for level in budgets(&[&tree], settings, &[12_000, 3_000]).unwrap().remove(0) {
                let twigs = level.twigs.as_ref().unwrap();
                let pictures: Vec<Grid> = twigs.models.iter().map(|model| picture(&tree, model)).collect();
                let mut grids = grids(&ink.sides);
                each_triangle(&Mesher::new(&level.tree, level.settings), |corners| {
                    draw(&ink.sides, &mut grids, corners)
                });
                for card in &twigs.cards {
                    let model = &twigs.models[usize::from(card.shape)].card;
                    for (own, shown) in [(model.along, card.along), (model.across, card.across)] {
                        assert!(shown.length() <= 2.001 * own.length(), "{name}: {shown} shows {own}");
                    }
                    for (side, grid) in ink.sides.iter().zip(&mut grids) {
                        show(card, side, grid, &pictures[usize::from(card.shape)]);
                    }
                }
                let covered: usize = grids.iter().map(Grid::covered).sum();
                let ratio = covered as f64 / ink.covered as f64;
                assert!((0.96..1.04).contains(&ratio), "{name}: {ratio}");
            }
        }
    }
}
