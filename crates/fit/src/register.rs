//! Registration: where in its picture a tree stands and at what scale, to a small part of a pixel.
//!
//! Ground, axis and scale are read off whole rows and columns of ink, and the tip of a tree is thinner than a
//! pixel, so that a frame that was read is off by a pixel or two. Of a thin tree that is off by a pixel half of the
//! overlap is lost. A tree that is at hand tells more: the frame is moved until the tree lies on the picture as well
//! as it can.
//!
//! This is a search over three numbers by compass steps (Hooke and Jeeves 1961): every neighbor at one step is
//! tried, the best taken, and where none is better the step is halved. Drawings are made in parallel and compared in
//! one order, so that threads change nothing. Far steps look at one fine drawing through other frames, which takes a
//! fraction of a millisecond whatever the tree; near steps draw the tree anew.
//!
//! It is no part of an individual: a frame belongs to the picture. Three further numbers for every individual would
//! cost a search a share of its trials, and registering twice, before the search and on its result, costs some
//! sixty drawings.

use crate::evaluator::{Evaluator, blend};
use crate::genome::Genome;
use crate::guess::Plate;
use crate::nuisance::Placement;
use crate::problem::{Accuracy, FitProblem, GoalView};
use pleach_silhouette::score::fast::{PreparedGoal, Scratch};
use pleach_silhouette::{Bitmap, Detail, Frame, Projection, Rasterizer, View};
use pleach_tree::{Foliage, Tree};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Steps of a registration in pixels: the first, which is halved until it is less than the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// The first step.
    pub first: f64,
    /// The smallest.
    pub last: f64,
}

impl Steps {
    /// Far steps, through a fine drawing.
    const FAR: Self = Self { first: 4.0, last: 0.25 };
    /// Near steps, on drawings of the tree itself.
    const NEAR: Self = Self { first: 0.25, last: 1.0 / 128.0 };
    /// Near steps of a tree with more than [`HEAVY`] leaves: a crown that is dense has few edges for its ink.
    const NEAR_HEAVY: Self = Self { first: 0.25, last: 1.0 / 32.0 };
    /// The same once more from where they have led: three numbers that hang together are moved one by one.
    const AGAIN: Self = Self { first: 1.0 / 16.0, last: 1.0 / 128.0 };
}

/// How far the foot may be from where it was read, as a part of the picture's longer side: twigs that reach the ground
/// hide where a trunk stands.
const MAX_SHIFT: f64 = 0.06;
/// The same of the ground, of which the lowest ink says more.
const MAX_DROP: f64 = 0.02;
/// The same of the height: tips that leave no ink are one part in a hundred of a slender tree.
const MAX_GROWTH: f64 = 0.04;
/// Pixels between the columns that are tried for the foot first, and heights that are tried with each, as parts of
/// what was read.
const SCAN: f64 = 2.0;
const SCANNED_GROWTHS: [f64; 3] = [0.0, 0.008, 0.016];
/// How many of the places that are tried first are searched around.
const BEGINNINGS: usize = 3;
/// Moves at one step before it is halved in any case.
const MAX_MOVES: usize = 8;
/// What overlap has to gain for a move.
const LEAST_GAIN: f64 = 1e-9;
/// What overlap has to gain for each number that is moved as far as it may be, in proportion: a tree that is unlike the
/// goal says little about the frame, one that is like it gains some hundred times as much.
const PRICE: f64 = 0.01;
/// Leaves from which on a tree takes so long to draw that it is registered less closely.
pub const HEAVY: usize = 100_000;
/// Pixels of the fine drawing for each of the goal's.
const FINENESS: u32 = 4;

/// A goal to lie on.
struct Registered<'a> {
    goal: PreparedGoal,
    frame: Frame,
    /// Pixels of the tree's height, by which the scale is told in pixels.
    height: f64,
    tree: &'a Tree,
    view: View,
    foliage: Foliage,
    /// How much larger the tree has to be.
    magnified: f64,
}

/// Pixels to the right, down, and that the tree is higher.
type Moved = [f64; 3];

/// The neighbors that are tried: each number alone, and ground and scale against each other, since a ground that is
/// a pixel too low looks like a tree that is a pixel too high.
const NEIGHBORS: [Moved; 8] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
];

impl Registered<'_> {
    fn placement(&self, [right, down, higher]: Moved) -> Placement {
        Placement {
            scale: self.height / (self.height + higher),
            offset: [right / f64::from(self.frame.width), down / f64::from(self.frame.height)],
            ..Placement::KNOWN
        }
    }

    fn moved(&self, placement: &Placement) -> Moved {
        let [right, down] = placement.offset;
        [
            right * f64::from(self.frame.width),
            down * f64::from(self.frame.height),
            self.height * (1.0 / placement.scale - 1.0),
        ]
    }

    /// How far the numbers are moved, each as a part of how far it may be.
    fn moved_parts(&self, [right, down, higher]: Moved) -> [f64; 3] {
        let side = f64::from(self.frame.width.max(self.frame.height));
        [right / (MAX_SHIFT * side), down / (MAX_DROP * side), higher / (MAX_GROWTH * self.height)]
            .map(f64::abs)
    }

    fn is_allowed(&self, moved: Moved) -> bool {
        self.moved_parts(moved).iter().all(|&part| part <= 1.0)
    }

    /// The frame in which the tree is drawn.
    fn frame_at(&self, moved: Moved) -> Frame {
        let frame = self.placement(moved).frame(&self.frame);
        Frame { meters_per_pixel: frame.meters_per_pixel / self.magnified, ..frame }
    }

    /// Overlap with the goal: pixel by pixel, which is exact where the tree is nearly right, and in coarser cells,
    /// which show the way from afar.
    fn worth(&self, picture: &Bitmap, scratch: &mut Scratch) -> f64 {
        let overlaps = self.goal.overlaps(picture, scratch);
        f64::midpoint(overlaps.iou(), blend(&overlaps))
    }

    /// Moves from `from` by compass steps; `draw` makes the picture at a frame.
    fn search(&self, from: Moved, steps: Steps, worths: &Worths<'_>) -> (Moved, f64) {
        let (mut best, mut step) = (from, steps.first);
        let mut worth = worths.at(self, best);
        while step >= steps.last {
            for _ in 0..MAX_MOVES {
                let neighbors: Vec<Moved> = NEIGHBORS
                    .iter()
                    .map(|by| std::array::from_fn(|i| best[i] + step * by[i]))
                    .filter(|&moved| self.is_allowed(moved))
                    .collect();
                let worths = worths.of(self, &neighbors);
                let mut next = None;
                for (&moved, at) in neighbors.iter().zip(worths) {
                    if at > worth + LEAST_GAIN {
                        (next, worth) = (Some(moved), at);
                    }
                }
                let Some(next) = next else { break };
                best = next;
            }
            step /= 2.0;
        }
        (best, worth)
    }

    /// Far steps, on one fine drawing of the tree.
    fn far(&self, from: Moved) -> Moved {
        let mut rasterizer = Rasterizer::with_detail(Detail::Draft);
        let side = (FINENESS * self.frame.width.max(self.frame.height)).min(MAX_PLATE);
        let plate = Plate::draw(self.tree, &self.view, self.foliage, side, &mut rasterizer);
        let worths = Worths::new(|frame, drawing| plate.through(frame, 1.0, &mut drawing.bitmap));
        // An overlap of branches has many peaks, most of them along the ground.
        let reach = (MAX_SHIFT * f64::from(self.frame.width.max(self.frame.height)) / SCAN).floor() as i32;
        let columns = (-reach..=reach).map(|i| from[0] + SCAN * f64::from(i));
        let places: Vec<Moved> = columns
            .flat_map(|right| SCANNED_GROWTHS.map(|growth| [right, from[1], from[2] + growth * self.height]))
            .filter(|&moved| self.is_allowed(moved))
            .collect();
        let mut ranked: Vec<(Moved, f64)> = places.iter().copied().zip(worths.of(self, &places)).collect();
        // Stable: of equals the first.
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut best = self.search(from, Steps::FAR, &worths);
        for &(place, _) in ranked.iter().take(BEGINNINGS) {
            let found = self.search(place, Steps::FAR, &worths);
            if found.1 > best.1 {
                best = found;
            }
        }
        best.0
    }

    /// Near steps, on drawings of the tree.
    fn near(&self, from: Moved, steps: Steps) -> Moved {
        let worths = Worths::new(|frame, Drawing { rasterizer, bitmap, .. }| {
            rasterizer.draw(self.tree, &self.view, frame, self.foliage.into(), bitmap);
        });
        self.search(from, steps, &worths).0
    }
}

/// Draws pictures and compares them, in memory that is kept.
struct Worths<'a> {
    draw: Box<dyn Fn(&Frame, &mut Drawing) + Sync + 'a>,
    pool: Mutex<Vec<Drawing>>,
}

impl<'a> Worths<'a> {
    fn new(draw: impl Fn(&Frame, &mut Drawing) + Sync + 'a) -> Self {
        Self { draw: Box::new(draw), pool: Mutex::default() }
    }

    fn at(&self, goal: &Registered<'_>, moved: Moved) -> f64 {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut drawing = taken.unwrap_or_else(Drawing::new);
        (self.draw)(&goal.frame_at(moved), &mut drawing);
        let worth = goal.worth(&drawing.bitmap, &mut drawing.scratch);
        pool().push(drawing);
        worth - PRICE * goal.moved_parts(moved).iter().sum::<f64>()
    }

    fn of(&self, goal: &Registered<'_>, places: &[Moved]) -> Vec<f64> {
        places.par_iter().map(|&moved| self.at(goal, moved)).collect()
    }
}

/// Longest side of the fine drawing.
const MAX_PLATE: u32 = 4096;

/// Memory of one thread.
struct Drawing {
    rasterizer: Rasterizer,
    bitmap: Bitmap,
    scratch: Scratch,
}

impl Drawing {
    fn new() -> Self {
        Self { rasterizer: Rasterizer::new(), bitmap: Bitmap::default(), scratch: Scratch::default() }
    }
}

/// Where `tree` lies best on `goal`, which shows it in `view` and about in `frame`, starting from `from`.
///
/// Near steps only: `from` should be right to some four first steps. The same bits for any number of threads.
#[must_use]
pub fn register(
    tree: &Tree,
    foliage: Foliage,
    goal: &Bitmap,
    view: &View,
    frame: &Frame,
    from: &Placement,
    steps: Steps,
) -> Placement {
    let registered = registered(tree, foliage, goal, view, frame, 1.0);
    let found = registered.near(registered.moved(from), steps);
    Placement { azimuth: from.azimuth, ..registered.placement(found) }
}

fn registered<'a>(
    tree: &'a Tree,
    foliage: Foliage,
    goal: &Bitmap,
    view: &View,
    frame: &Frame,
    magnified: f64,
) -> Registered<'a> {
    let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
    let height = (frame.ground_row - f64::from(top)).max(1.0);
    let (goal, frame, view) = (PreparedGoal::new(goal), *frame, *view);
    Registered { goal, frame, height, tree, view, foliage, magnified }
}

/// How close a registration goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closeness {
    /// To about a tenth of a pixel: before a search, whose trees are others.
    Search,
    /// As close as it can: for a result.
    Result,
}

/// `problem` with the frames of its goals registered by the tree of `genome`; as it is where nothing is to be
/// registered or the tree does not grow.
pub(crate) fn with_registered_frames(
    problem: &FitProblem,
    evaluator: &Evaluator,
    genome: &Genome,
    closeness: Closeness,
) -> FitProblem {
    let mut problem = problem.clone();
    if !problem.goals.iter().any(GoalView::is_to_be_registered) {
        return problem;
    }
    let (foliage, goals) = (problem.foliage, &mut problem.goals);
    // A tree that does not grow leaves the frames as they were read.
    let _grown = evaluator.show_matched(genome, |tree, magnified, views| {
        for (goal, view) in goals.iter_mut().zip(views) {
            if !goal.is_to_be_registered() {
                continue;
            }
            let one = registered(tree, foliage, &goal.goal, view, &goal.frame, magnified);
            let mut moved = one.moved(&goal.registered);
            if goal.registered == Placement::KNOWN && view.projection == Projection::Orthographic {
                moved = one.far(moved);
            }
            if closeness == Closeness::Result {
                moved = if tree.leaves.len() > HEAVY {
                    one.near(moved, Steps::NEAR_HEAVY)
                } else {
                    one.near(one.near(moved, Steps::NEAR), Steps::AGAIN)
                };
            }
            goal.registered = one.placement(moved);
        }
    });
    problem
}

impl GoalView {
    /// Whether its frame is about right, and no number of the individual.
    fn is_to_be_registered(&self) -> bool {
        self.accuracy == Accuracy::Pixel && !self.unknown.frame
    }
}
