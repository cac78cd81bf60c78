//! Registration: where in its picture a tree stands and at what scale, to a small part of a pixel.
//!
//! Ground, axis and scale are read off whole rows and columns of ink, and the tip of a tree is thinner than a pixel,
//! so a frame that was read is off by a pixel or two. A thin tree that is off by a pixel loses half of its overlap. A
//! grown tree tells more: the frame is moved until the tree lies on the picture as well as it can.
//!
//! This is a search over three numbers by compass steps (Hooke and Jeeves 1961): every neighbor at one step is tried,
//! the best taken, and where none is better the step is halved. Drawings are made in parallel and compared in a fixed
//! order, so that the result does not depend on threads. Far steps resample one fine drawing, which takes a fraction
//! of a millisecond whatever the tree; near steps draw the tree again.
//!
//! How far the frame may be moved depends on the tree. Trees of another kind, or of another seed, would cover the
//! goal's branches at the expense of trunk and ground; so they move it by at most the error of a reading, and only a
//! tree that then covers the goal as no other does moves it further.
//!
//! A frame is not part of an individual: it belongs to the picture. Three further numbers per individual would cost a
//! search a share of its trials. Registering twice, before the search and for its result, costs some eighty drawings.

use crate::evaluator::FineSilhouette;
use crate::evaluator::{Evaluator, blend};
use crate::problem::Genome;
use crate::problem::Placement;
use crate::problem::{Accuracy, FitProblem, GoalView};
use pleach_silhouette::score::fast::{PreparedGoal, Scratch};
use pleach_silhouette::{Bitmap, Detail, Frame, Projection, Rasterizer, View};
use pleach_tree::{Foliage, Tree};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// Steps of a registration in pixels: the first is halved until it is less than the last.
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
    /// Near steps of any tree; one that is not the goal's own gains nothing by smaller ones.
    const NEAR_ANY: Self = Self { first: 0.25, last: 1.0 / 8.0 };
    /// Near steps of a tree with more than [`HEAVY`] leaves: a dense crown has few edges for its ink.
    const NEAR_HEAVY: Self = Self { first: 0.25, last: 1.0 / 32.0 };
    /// Near steps once more from their result: three dependent numbers are moved one by one.
    const AGAIN: Self = Self { first: 1.0 / 16.0, last: 1.0 / 128.0 };
}

/// How far the foot may be from where it was read, relative to the picture's longer side: twigs that reach the ground
/// hide the foot of the trunk.
const MAX_SHIFT: f64 = 0.06;
/// The same for the ground, which the lowest ink shows better.
const MAX_DROP: f64 = 0.02;
/// The same for the height: tips without ink are 1 % of a slender tree, and 5 % of an oak in 128 pixels.
const MAX_GROWTH: f64 = 0.06;
/// The error of a reading, in pixels: of the foot, of the ground, and of the height at least, beside 1.2 % of it.
const READ_SHIFT: f64 = 2.0;
const READ_DROP: f64 = 1.0;
const READ_GROWTH: (f64, f64) = (2.0, 0.012);
/// Intersection over union from which a tree counts as the goal's own: two trees of a species have at most 0.6, and
/// fits of crowns without gaps have 0.9 and are in the right place.
const SURE: f64 = 0.8;
/// A tree that has less at the best place by [`Steps::NEAR_ANY`] is not the goal's own.
const PERHAPS: f64 = 0.7;
/// Pixels between the columns that are tried for the foot first, and the growths of the height that are tried with
/// each, relative to the height.
const SCAN: f64 = 2.0;
const SCANNED_GROWTHS: [f64; 4] = [0.0, 0.01, 0.025, 0.045];
/// How many of the best places of that scan a search starts from.
const BEGINNINGS: usize = 3;
/// Moves at one step before it is halved in any case.
const MAX_MOVES: usize = 8;
/// Minimum gain of overlap for a move.
const MIN_GAIN: f64 = 1e-9;
/// Overlap that a move of one number to its limit has to gain, and in proportion: a tree that is unlike the goal says
/// little about the frame; one that is like it gains some hundred times as much.
const PRICE: f64 = 0.01;
/// Trees with more leaves take so long to draw that they are registered less closely.
pub const HEAVY: usize = 100_000;
/// Pixels of the fine drawing per pixel of the goal.
const FINENESS: u32 = 4;

/// A goal, and the tree that is registered to it.
struct Registered<'a> {
    goal: PreparedGoal,
    frame: Frame,
    /// The tree's height in pixels: the scale is searched as a change of it.
    height: f64,
    tree: &'a Tree,
    view: View,
    foliage: Foliage,
    /// The factor on the size of the tree.
    magnified: f64,
    reach: Reach,
}

/// How far a frame may be moved.
#[derive(Clone, Copy)]
struct Reach {
    /// The center ...
    from: Moved,
    /// ... and the reach on either side.
    by: Moved,
}

/// Pixels to the right, down, and of growth in height.
type Moved = [f64; 3];

/// The neighbors of a place: each number alone, and ground and scale against each other, since a ground that is a
/// pixel too low looks like a tree that is a pixel too high.
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

    /// The reach of the goal's own tree.
    fn wide(&self) -> Reach {
        let side = f64::from(self.frame.width.max(self.frame.height));
        Reach { from: [0.0; 3], by: [MAX_SHIFT * side, MAX_DROP * side, MAX_GROWTH * self.height] }
    }

    /// The reach of any other tree.
    fn narrow(&self) -> Reach {
        let (pixels, part) = READ_GROWTH;
        Reach { from: [0.0; 3], by: [READ_SHIFT, READ_DROP, pixels.max(part * self.height)] }
    }

    /// The moves relative to their limits.
    fn moved_parts(&self, moved: Moved) -> [f64; 3] {
        std::array::from_fn(|i| ((moved[i] - self.reach.from[i]) / self.reach.by[i]).abs())
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
    /// which guide from afar.
    fn overlap(&self, picture: &Bitmap, scratch: &mut Scratch) -> f64 {
        let overlaps = self.goal.overlaps(picture, scratch);
        f64::midpoint(overlaps.iou(), blend(&overlaps))
    }

    /// Moves from `from` by compass steps; `draw` makes the picture at a frame.
    fn search(&self, from: Moved, steps: Steps, overlaps: &Overlaps<'_>) -> (Moved, f64) {
        let (mut best, mut step) = (from, steps.first);
        let mut overlap = overlaps.at(self, best);
        while step >= steps.last {
            for _ in 0..MAX_MOVES {
                let neighbors: Vec<Moved> = NEIGHBORS
                    .iter()
                    .map(|by| std::array::from_fn(|i| best[i] + step * by[i]))
                    .filter(|&moved| self.is_allowed(moved))
                    .collect();
                let overlaps = overlaps.all(self, &neighbors);
                let mut next = None;
                for (&moved, at) in neighbors.iter().zip(overlaps) {
                    if at > overlap + MIN_GAIN {
                        (next, overlap) = (Some(moved), at);
                    }
                }
                let Some(next) = next else { break };
                best = next;
            }
            step /= 2.0;
        }
        (best, overlap)
    }

    /// The best place of the tree, and its intersection over union there.
    fn found(&self, closeness: Closeness, pictures: &Pictures<'_>) -> (Moved, f64) {
        let moved = pictures.far.as_ref().map_or([0.0; 3], |far| self.far(far));
        let near = |from, steps| self.search(from, steps, &pictures.near);
        let known = |moved| (moved, self.iou_at(moved));
        if closeness == Closeness::Search {
            return known(moved);
        }
        let close = known(near(moved, Steps::NEAR_ANY).0);
        if close.1 < PERHAPS {
            return close;
        }
        if self.tree.leaves.len() > HEAVY {
            return known(near(moved, Steps::NEAR_HEAVY).0);
        }
        // Ground and height compensate each other: try also the present top with the ground as read.
        let [right, down, higher] = moved;
        let beginnings = [moved, [right, 0.0, higher - down]];
        let [one, other] = beginnings.map(|from| near(from, Steps::NEAR));
        known(near(if other.1 > one.1 { other.0 } else { one.0 }, Steps::AGAIN).0)
    }

    /// The intersection over union at a place.
    fn iou_at(&self, moved: Moved) -> f64 {
        let Drawing { mut rasterizer, mut bitmap, mut scratch } = Drawing::new();
        rasterizer.draw(self.tree, &self.view, &self.frame_at(moved), self.foliage.into(), &mut bitmap);
        self.goal.overlaps(&bitmap, &mut scratch).iou()
    }

    /// Far steps from where the frame was read.
    fn far(&self, overlaps: &Overlaps<'_>) -> Moved {
        let from = [0.0; 3];
        // Overlap of branches has many local maxima, most of them along the ground.
        let reach = (self.reach.by[0] / SCAN).floor() as i32;
        let places: Vec<Moved> = (-reach..=reach)
            .map(|i| SCAN * f64::from(i))
            .flat_map(|right| SCANNED_GROWTHS.map(|growth| [right, 0.0, growth * self.height]))
            .filter(|&moved| self.is_allowed(moved))
            .collect();
        let mut ranked: Vec<(Moved, f64)> = places.iter().copied().zip(overlaps.all(self, &places)).collect();
        // Stable: the first of equals.
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut best = self.search(from, Steps::FAR, overlaps);
        for &(place, _) in ranked.iter().take(BEGINNINGS) {
            let found = self.search(place, Steps::FAR, overlaps);
            if found.1 > best.1 {
                best = found;
            }
        }
        best.0
    }
}

/// The pictures of one tree that a registration looks at.
struct Pictures<'a> {
    /// Through one fine drawing; none in perspective, where the tree looks otherwise from another place.
    far: Option<Overlaps<'a>>,
    /// Of the tree itself.
    near: Overlaps<'a>,
}

impl<'a> Pictures<'a> {
    fn new(of: &Registered<'a>) -> Self {
        let far = (of.view.projection == Projection::Orthographic).then(|| {
            let mut rasterizer = Rasterizer::with_detail(Detail::Draft);
            let side = (FINENESS * of.frame.width.max(of.frame.height)).min(MAX_FINE_SIDE);
            let fine = FineSilhouette::draw(of.tree, &of.view, of.foliage, side, &mut rasterizer);
            Overlaps::new(move |frame, drawing| fine.through(frame, 1.0, &mut drawing.bitmap))
        });
        Self { far, near: Self::near(of) }
    }

    fn near(of: &Registered<'a>) -> Overlaps<'a> {
        let (tree, view, foliage) = (of.tree, of.view, of.foliage);
        Overlaps::new(move |frame, Drawing { rasterizer, bitmap, .. }| {
            rasterizer.draw(tree, &view, frame, foliage.into(), bitmap);
        })
    }
}

/// Draws pictures and compares them, in pooled memory.
///
/// Steps are halves of each other, and searches begin where others ended or in a part of their reach, so many places
/// come again: what a place has is kept.
struct Overlaps<'a> {
    draw: Box<dyn Fn(&Frame, &mut Drawing) + Sync + 'a>,
    pool: Mutex<Vec<Drawing>>,
    known: Mutex<HashMap<[u64; 3], f64>>,
}

impl<'a> Overlaps<'a> {
    fn new(draw: impl Fn(&Frame, &mut Drawing) + Sync + 'a) -> Self {
        Self { draw: Box::new(draw), pool: Mutex::default(), known: Mutex::default() }
    }

    /// The overlap less the price of the move.
    fn at(&self, goal: &Registered<'_>, moved: Moved) -> f64 {
        let place = moved.map(f64::to_bits);
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let before = known().get(&place).copied();
        let overlap = before.unwrap_or_else(|| {
            let overlap = self.drawn_at(goal, moved);
            let _ = known().insert(place, overlap);
            overlap
        });
        overlap - PRICE * goal.moved_parts(moved).iter().sum::<f64>()
    }

    fn drawn_at(&self, goal: &Registered<'_>, moved: Moved) -> f64 {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut drawing = taken.unwrap_or_else(Drawing::new);
        (self.draw)(&goal.frame_at(moved), &mut drawing);
        let overlap = goal.overlap(&drawing.bitmap, &mut drawing.scratch);
        pool().push(drawing);
        overlap
    }

    fn all(&self, goal: &Registered<'_>, places: &[Moved]) -> Vec<f64> {
        places.par_iter().map(|&moved| self.at(goal, moved)).collect()
    }
}

/// Reach of the registration of a result at the goal's own size, in first steps.
const AROUND: f64 = 4.0;

/// Longest side of the fine drawing.
const MAX_FINE_SIDE: u32 = 4096;

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

/// The best place of `tree` on `goal`, which is seen in `view` and approximately in `frame`, starting from `from`.
///
/// Near steps only, within four first steps of `from`, and none below an eighth of a pixel for a tree that is not the
/// goal's own. The same bits for any number of threads.
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
    let mut registered = registered(tree, foliage, goal, view, frame, 1.0);
    let moved = registered.moved(from);
    registered.reach = Reach { from: moved, by: [AROUND * steps.first; 3] };
    let pictures = Pictures::near(&registered);
    let close = Steps { last: steps.last.max(Steps::NEAR_ANY.last), ..steps };
    let (mut found, _) = registered.search(moved, close, &pictures);
    if registered.iou_at(found) >= PERHAPS {
        (found, _) = registered.search(moved, steps, &pictures);
    }
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
    let reach = Reach { from: [0.0; 3], by: [0.0; 3] };
    Registered { goal, frame, height, tree, view, foliage, magnified, reach }
}

/// The precision of a registration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closeness {
    /// To about a tenth of a pixel: before a search, whose trees are others.
    Search,
    /// As precise as possible: for a result.
    Result,
}

/// `problem` with the frames of its goals registered by the tree of `genome`; unchanged if no goal is to be
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
            let mut one = registered(tree, foliage, &goal.goal, view, &goal.frame, magnified);
            let pictures = Pictures::new(&one);
            one.reach = one.wide();
            let (mut moved, iou) = one.found(closeness, &pictures);
            if iou < SURE {
                one.reach = one.narrow();
                (moved, _) = one.found(closeness, &pictures);
            }
            goal.registered = one.placement(moved);
        }
    });
    problem
}

impl GoalView {
    /// Whether its frame is approximate and not searched as nuisances.
    fn is_to_be_registered(&self) -> bool {
        self.accuracy == Accuracy::Pixel && !self.unknown.frame
    }
}
