//! Trees by a graph cut, from a box that a person drags, or from the middle of the picture.
//!
//! Rother, Kolmogorov and Blake, "GrabCut" (2004): what is outside of the box is background; two mixtures of
//! colours are fitted, one to what is taken for tree and one to the rest; the cheapest cut between pixels that differ
//! gives each a side; and both steps are repeated. Beyond that paper, colours go with their height in the box (lawn is
//! below, the far tree line at the middle), the middle of the box speaks for tree, and the colours of a sky speak against
//! it. All of that is done in a small picture, in which twigs are lost: [`super::refine`] finds them again.

use super::clear_sky::{ClearSky, apart};
use super::max_flow::{FORWARD, GridGraph, MAX_EDGE, UNCUTTABLE};
use super::mixture::{Feature, Mixture};
use super::oklab::Converter;
use super::photo::Photo;
use super::pixel_box::PixelBox;
use super::reduced::Reduced;
use super::region::Shown;
use crate::bitmap::Bitmap;
use crate::pieces;
use pleach_plant::math;

/// Longer side of the small picture.
const SIDE: u32 = 440;
/// What is looked at around the box, as a part of its longer side.
const AROUND: f64 = 0.25;
/// Half axes of the ellipse that is tree at first, as parts of half the box.
const FIRST: f32 = 0.8;
/// Corners of the box, farther out than this, squared, show at first what is behind the tree, too.
const CORNERS: f32 = 1.15;
/// If less than this part of the cells is outside of the box, they do not tell what is behind the tree.
const MIN_OUTSIDE: f64 = 0.1;
/// Of what is outside, this part has colours that are unusual there.
const UNUSUAL: f64 = 0.15;
/// If less than this part of the ellipse looks other than the outside, all of it is tree at first.
const MIN_DIFFERENT: f64 = 0.2;
/// What speaks for tree in the middle of the box, as a logarithm of likelihoods; it falls by [`FALL`] times as much up
/// to the ellipse that touches the box.
const MIDDLE: f32 = 1.9;
const FALL: f32 = 1.3;
/// What speaks against tree where the colour is the sky's.
const SKY: f32 = 6.0;
/// A colour speaks for either side by this at most.
const MAX_COLOR: f32 = 6.0;
/// Cost of a cut between two neighbours of one colour.
const EDGE: f32 = 3.0;
/// Rounds in the picture of half the size, and in the small one.
const ROUNDS: [usize; 2] = [5, 1];
/// Components of the tree's colours, and of all others.
const COMPONENTS: [usize; 2] = [5, 7];
/// How much half of the box's height counts, in Oklab.
const HEIGHT: f32 = 0.15;
/// Whole numbers to a logarithm of 1.
const UNIT: f32 = 1000.0;
/// Fewer cells of the small picture are not a tree.
const MIN_TREE: u64 = 50;

/// What a cell must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seed {
    /// A person marked it.
    Tree,
    /// A trunk was traced there.
    Trunk,
    Rest,
    Unknown,
}

/// Where a tree is looked for.
pub(super) struct Seeds<'a> {
    pub(super) region: PixelBox,
    pub(super) include: Option<&'a Bitmap>,
    pub(super) exclude: Option<&'a Bitmap>,
    /// Whether a person showed it. What a guess takes for a shadow may as well be a hedge or a hill.
    pub(super) is_shown: bool,
    pub(super) reach: Reach,
}

/// Half axes of the prior in halves of the box: longer where the box ends with the picture, since a tree that the
/// picture cuts off does not grow narrow there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    left: f32,
    right: f32,
    top: f32,
    foot: f32,
}

impl Reach {
    fn new(region: &PixelBox, photo: &Photo) -> Self {
        let near =
            |gap: u32, side: u32| if f64::from(gap) <= EDGE_GAP * f64::from(side) { CUT_OFF } else { 1.0 };
        Self {
            left: near(region.x, photo.width()),
            right: near(photo.width() - region.x - region.width, photo.width()),
            top: near(region.y, photo.height()),
            foot: 1.0,
        }
    }

    /// How far out of the middle a place is, squared; more than 1 in the corners.
    fn out(&self, along: f32, down: f32) -> f32 {
        let along = along / if along < 0.0 { self.left } else { self.right };
        let down = down / if down < 0.0 { self.top } else { self.foot };
        along * along + 0.7 * down * down * down * down
    }
}

/// Boxes nearer to the picture's edge than this part of its side end with it.
const EDGE_GAP: f64 = 0.015;
const CUT_OFF: f32 = 1.4;

impl<'a> Seeds<'a> {
    /// Where nobody shows anything: a guess at the box.
    pub(super) fn guessed(region: PixelBox, photo: &Photo) -> Self {
        Self { reach: Reach::new(&region, photo), region, include: None, exclude: None, is_shown: false }
    }

    pub(super) fn shown(shown: &'a Shown, photo: &Photo) -> Self {
        Self {
            reach: Reach::new(&shown.region, photo),
            region: shown.region,
            include: shown.include.as_ref(),
            exclude: shown.exclude.as_ref(),
            is_shown: true,
        }
    }
}

/// The tree in a small picture.
pub(super) struct Cut {
    pub(super) small: Reduced,
    pub(super) sky: ClearSky,
    pub(super) seeds: Vec<Seed>,
    pub(super) is_tree: Vec<bool>,
    colors: Colors,
    pub(super) region: PixelBox,
}

/// What tree and rest look like.
struct Colors {
    tree: Mixture<3>,
    rest: Mixture<4>,
}

impl Cut {
    /// The cut; `None` if nothing is taken for tree.
    pub(super) fn new(photo: &Photo, converter: &Converter, seeds: &Seeds<'_>) -> Option<Self> {
        let region = seeds.region;
        let around = (AROUND * f64::from(region.width.max(region.height))).ceil() as u32;
        let small = Reduced::new(photo, converter, region.widened(around, photo), SIDE);
        let smaller = small.halved();
        let sky = ClearSky::new(&small);
        let coarse = Level::new(&smaller, &sky, seeds);
        let mut is_tree = coarse.first();
        let mut colors = None;
        for _ in 0..ROUNDS[0] {
            let fitted = coarse.colors(&is_tree)?;
            is_tree = coarse.cut(&fitted)?;
            colors = Some(fitted);
        }
        let mut fine = Level::new(&small, &sky, seeds);
        let mut finer: Vec<bool> = Vec::with_capacity(small.colors.len());
        for y in 0..small.height {
            finer.extend((0..small.width).map(|x| is_tree[smaller.index(x / 2, y / 2)]));
        }
        for (x, y) in super::trunk::lost(&small, &finer, cells_of(&small, &region)) {
            let i = small.index(x, y);
            if fine.seeds[i] == Seed::Unknown {
                fine.seeds[i] = Seed::Trunk;
                finer[i] = true;
            }
        }
        for _ in 0..ROUNDS[1] {
            let fitted = fine.colors(&finer)?;
            finer = fine.cut(&fitted)?;
            colors = Some(fitted);
        }
        let seeds = fine.seeds;
        Some(Self { colors: colors?, sky, seeds, is_tree: finer, region, small })
    }

    /// How much the colour of a pixel speaks for tree, as a logarithm of likelihoods.
    pub(super) fn by_color(&self, y: u32, color: super::oklab::Oklab) -> f32 {
        self.colors.for_tree(feature(color, height_in(&self.region, y)))
    }
}

impl Colors {
    fn for_tree(&self, feature: Feature<4>) -> f32 {
        let [l, a, b, _] = feature;
        // Tree colours are taken to be the same at all heights of the box.
        let tree = self.tree.log_likelihood([l, a, b]) - math::ln(f64::from(2.0 * HEIGHT));
        let difference = tree - self.rest.log_likelihood(feature);
        (difference as f32).clamp(-MAX_COLOR, MAX_COLOR)
    }
}

fn feature([l, a, b]: super::oklab::Oklab, height: f32) -> Feature<4> {
    [l, a, b, HEIGHT * height]
}

/// The box in cells.
fn cells_of(small: &Reduced, region: &PixelBox) -> (u32, u32, u32, u32) {
    let cell = |at: u32, of: u32, side: u32| (u64::from(at) * u64::from(of) / u64::from(side)) as u32;
    let (left, top) = (
        cell(region.x - small.part.x, small.width, small.part.width),
        cell(region.y - small.part.y, small.height, small.part.height),
    );
    let right = cell(region.x - small.part.x + region.width, small.width, small.part.width);
    let foot = cell(region.y - small.part.y + region.height, small.height, small.part.height);
    (left, top, right.saturating_sub(left).max(1), foot.saturating_sub(top).max(1))
}

/// A row's place in the box, from −1 to 1, and beyond outside.
fn height_in(region: &PixelBox, y: u32) -> f32 {
    (2.0 * (f64::from(y) + 0.5 - f64::from(region.y)) / f64::from(region.height) - 1.0) as f32
}

/// The picture at one size, and what is known of its cells.
struct Level<'a> {
    small: &'a Reduced,
    seeds: Vec<Seed>,
    features: Vec<Feature<4>>,
    /// What place and sky say before any colour of the tree is known.
    prior: Vec<f32>,
    /// How far out of the middle of the box, squared: 1 at the ellipse that touches it.
    out: Vec<f32>,
    is_sky: Vec<bool>,
    /// Cost of a cut between each cell and its neighbours at the steps of [`FORWARD`]; the same in each round.
    edges: Vec<[i32; FORWARD.len()]>,
}

impl<'a> Level<'a> {
    fn new(small: &'a Reduced, sky: &ClearSky, given: &Seeds<'_>) -> Self {
        let region = &given.region;
        let count = small.colors.len();
        let (mut seeds, mut features) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let (mut prior, mut outs) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut skies = Vec::with_capacity(count);
        for y in 0..small.height {
            for x in 0..small.width {
                let (px, py) = small.middle(x, y);
                let color = small.colors[small.index(x, y)];
                let down = height_in(region, py);
                let along = (2.0 * (f64::from(px) + 0.5 - f64::from(region.x)) / f64::from(region.width)
                    - 1.0) as f32;
                let out = given.reach.out(along, down);
                let is_sky = ClearSky::is_sky(sky.distance(small, (px, py), color));
                seeds.push(if !region.contains(px, py) { Seed::Rest } else { Seed::Unknown });
                features.push(feature(color, down));
                prior.push(MIDDLE * (1.0 - FALL * out).max(-2.0) - if is_sky { SKY } else { 0.0 });
                outs.push(out);
                skies.push(is_sky);
            }
        }
        for (ink, seed) in [(given.exclude, Seed::Rest), (given.include, Seed::Tree)] {
            if let Some(ink) = ink {
                let cells = small.cells_with(ink);
                seeds.iter_mut().zip(cells).filter(|(_, is)| *is).for_each(|(s, _)| *s = seed);
            }
        }
        Self { small, seeds, features, prior, out: outs, is_sky: skies, edges: edges(small) }
    }

    /// A first guess: an ellipse without the sky, and without what looks as the outside of the box, and its corners,
    /// do at its height; unless all of the ellipse does, as a tree before others of its kind.
    fn first(&self) -> Vec<bool> {
        let is_inner = |i: usize| match self.seeds[i] {
            Seed::Tree | Seed::Trunk => true,
            Seed::Rest => false,
            Seed::Unknown => self.out[i] < FIRST * FIRST && !self.is_sky[i],
        };
        let inner: Vec<bool> = (0..self.seeds.len()).map(is_inner).collect();
        let is_outer = |&i: &usize| match self.seeds[i] {
            Seed::Rest => true,
            Seed::Unknown => self.out[i] > CORNERS,
            Seed::Tree | Seed::Trunk => false,
        };
        let outside: Vec<Feature<4>> = (0..inner.len()).filter(is_outer).map(|i| self.features[i]).collect();
        if (outside.len() as f64) < MIN_OUTSIDE * inner.len() as f64 {
            return inner;
        }
        let Some(rest) = Mixture::fit(&outside, COMPONENTS[1]) else { return inner };
        let mut usual: Vec<f64> =
            outside.iter().step_by((outside.len() / 2000).max(1)).map(|f| rest.log_likelihood(*f)).collect();
        usual.sort_by(f64::total_cmp);
        let least = usual[(UNUSUAL * usual.len() as f64) as usize];
        let differs = |i: usize| {
            inner[i] && (self.seeds[i] != Seed::Unknown || rest.log_likelihood(self.features[i]) < least)
        };
        let different: Vec<bool> = (0..inner.len()).map(differs).collect();
        let count = |of: &[bool]| of.iter().filter(|is| **is).count() as f64;
        if count(&different) < MIN_DIFFERENT * count(&inner) { inner } else { different }
    }

    fn colors(&self, is_tree: &[bool]) -> Option<Colors> {
        let (mut tree, mut rest) = (Vec::new(), Vec::new());
        for (i, &feature) in self.features.iter().enumerate() {
            if is_tree[i] && !self.is_sky[i] {
                tree.push([feature[0], feature[1], feature[2]]);
            } else {
                rest.push(feature);
            }
        }
        Some(Colors { tree: Mixture::fit(&tree, COMPONENTS[0])?, rest: Mixture::fit(&rest, COMPONENTS[1])? })
    }

    /// The cheapest cut, and of its tree the largest piece, or all that holds a seed.
    fn cut(&self, colors: &Colors) -> Option<Vec<bool>> {
        let (width, height) = (self.small.width, self.small.height);
        let mut graph = GridGraph::new(width, height);
        for y in 0..height {
            for x in 0..width {
                let i = self.small.index(x, y);
                let terminal = match self.seeds[i] {
                    Seed::Tree | Seed::Trunk => UNCUTTABLE,
                    Seed::Rest => -UNCUTTABLE,
                    Seed::Unknown => ((colors.for_tree(self.features[i]) + self.prior[i]) * UNIT) as i32,
                };
                graph.set_terminal(x, y, terminal);
                for ((step, _), cost) in FORWARD.into_iter().zip(self.edges[i]) {
                    graph.set_edge(x, y, step, cost);
                }
            }
        }
        graph.cut();
        let ink = Bitmap::from_fn(width, height, |x, y| graph.is_source(x, y));
        let grounds = pieces::widened(&ink, 1);
        let is = |i: usize, seed: Seed| self.seeds[i] == seed;
        let of = |seed| Bitmap::from_fn(width, height, |x, y| is(self.small.index(x, y), seed));
        let (marked, trunk) = (of(Seed::Tree), of(Seed::Trunk));
        let mut tree = match marked.ink() {
            0 => pieces::piece(&ink, &grounds, None)?,
            _ => pieces::pieces_at(&ink, &grounds, &marked),
        };
        tree.unite(&pieces::pieces_at(&ink, &grounds, &trunk));
        (tree.ink() >= MIN_TREE || marked.ink() > 0)
            .then(|| (0..self.seeds.len()).map(|i| tree.get(i as u32 % width, i as u32 / width)).collect())
    }
}

/// Cost of a cut between each cell and its neighbours at the steps of [`FORWARD`]: less where colours differ more.
fn edges(small: &Reduced) -> Vec<[i32; FORWARD.len()]> {
    let sharpness = sharpness(small);
    let cost = |x: u32, y: u32, (dx, dy): (i32, i32)| {
        let (a, b) = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
        if a >= small.width || b >= small.height {
            return None;
        }
        let difference = apart(small.colors[small.index(x, y)], small.colors[small.index(a, b)]);
        let far = if dx != 0 && dy != 0 { std::f32::consts::FRAC_1_SQRT_2 } else { 1.0 };
        let cost = EDGE * far * math::expf(-sharpness * difference * difference);
        Some(((cost * UNIT) as i32).min(MAX_EDGE))
    };
    let places = (0..small.height).flat_map(|y| (0..small.width).map(move |x| (x, y)));
    places.map(|(x, y)| FORWARD.map(|(_, step)| cost(x, y, step).unwrap_or(0))).collect()
}

/// What squares of differences of colours are multiplied by: half of one over their mean.
fn sharpness(small: &Reduced) -> f32 {
    let (mut sum, mut count) = (0.0_f64, 0_u32);
    for y in 0..small.height {
        for x in 1..small.width {
            let i = small.index(x, y);
            let difference = f64::from(apart(small.colors[i], small.colors[i - 1]));
            sum += difference * difference;
            count += 1;
        }
    }
    (0.5 / (sum / f64::from(count.max(1))).max(1e-6)) as f32
}
