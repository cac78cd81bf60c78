//! The current individual, as pictures in which stems can be exchanged.

use super::chosen::Chosen;
use super::units::{Unit, Units};
use super::worker::{DETAIL, Scene, Worker};
use crate::evaluator::Buffers;
use pleach_silhouette::{Bitmap, Layer, Stack};
use pleach_tree::{Address, Draw, Spread, StemPath};

/// Upper bound of the price of all draws: every stem of a generation at the edge of its spread.
const PRICE: f64 = 0.02;
/// Minimum gain of an exchange of draws.
pub(super) const MIN_GAIN: f64 = 2e-5;

/// How far below the ground a stem may reach that did not before, relative to the tree's height. A picture does not
/// show whether a branch towards the viewer does so.
const BELOW: f64 = 0.02;

/// A tree cut at one generation.
pub(super) struct State {
    pub(super) generation: u16,
    pub(super) chosen: Chosen,
    /// Units by the hash of their address.
    by_address: Vec<(u64, usize)>,
    paths: Vec<StemPath>,
    /// Layers of each unit, view by view.
    layers: Vec<Vec<Layer>>,
    /// Lowest height that a replacement of each unit may reach, in metres.
    floors: Vec<f64>,
    views: Vec<ViewState>,
    pub(super) cost: f64,
    pub(super) iou: f64,
    pub(super) likeness: f64,
}

/// One picture.
struct ViewState {
    stack: Stack,
    picture: Bitmap,
}

/// Other draws of one unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub(super) unit: usize,
    pub(super) draw: Draw,
    pub(super) reseeds: bool,
    pub(super) spread: Spread,
}

/// Loss of a tree: its cost, and its overlap and likeness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loss {
    pub(super) cost: f64,
    iou: f64,
    likeness: f64,
}

impl State {
    /// The tree of `chosen`, cut at `generation`; `None` if it does not grow.
    pub(super) fn new(
        scene: &Scene<'_>,
        chosen: Chosen,
        generation: u16,
        worker: &mut Worker,
    ) -> Option<Self> {
        if !worker.grow(scene, &chosen.individual.draws()) {
            return None;
        }
        let units = Units::new(&worker.tree, generation);
        let mut views: Vec<ViewState> = scene
            .placed
            .iter()
            .map(|(_, frame)| ViewState { stack: Stack::new(frame, DETAIL), picture: Bitmap::default() })
            .collect();
        let height = worker.tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
        let mut layers = Vec::with_capacity(units.units.len());
        let mut floors = Vec::with_capacity(units.units.len());
        for part in 0..=units.units.len() {
            worker.take(&units, part);
            let of_part = worker.layers(scene);
            for (view_state, layer) in views.iter_mut().zip(&of_part) {
                view_state.stack.add(layer);
            }
            if part > 0 {
                layers.push(of_part);
                floors.push(worker.lowest().min(-BELOW * height));
            }
        }
        for view_state in &mut views {
            view_state.stack.picture(&mut view_state.picture);
        }
        let mut by_address: Vec<(u64, usize)> =
            units.units.iter().enumerate().map(|(i, unit)| (unit.address.bits(), i)).collect();
        by_address.sort_unstable();
        let paths = units.units.iter().map(|Unit { stem, .. }| worker.tree.path_of(*stem)).collect();
        let (cost, iou, likeness) = (f64::INFINITY, 0.0, 0.0);
        let mut state =
            Self { generation, chosen, by_address, paths, layers, floors, views, cost, iou, likeness };
        let mut sum = Sum::default();
        for (view, view_state) in state.views.iter().enumerate() {
            sum.add(scene, view, &view_state.picture, &mut worker.buffers);
        }
        let loss = sum.mean();
        state.take(Loss { cost: loss.cost + state.chosen.price(), ..loss });
        Some(state)
    }

    fn take(&mut self, loss: Loss) {
        (self.cost, self.iou, self.likeness) = (loss.cost, loss.iou, loss.likeness);
    }

    /// The tree's pictures, view by view.
    pub(super) fn pictures(&self) -> impl Iterator<Item = &Bitmap> {
        self.views.iter().map(|view| &view.picture)
    }

    /// Paths of the units.
    pub(super) fn paths(&self) -> &[StemPath] {
        &self.paths
    }

    /// Number of units.
    pub(super) fn count(&self) -> usize {
        self.paths.len()
    }

    /// The number of the unit at `address`, and its draw.
    pub(super) fn find(&self, address: Address) -> Option<(usize, Draw)> {
        let place = self.by_address.binary_search_by_key(&address.bits(), |&(bits, _)| bits).ok()?;
        let unit = self.by_address[place].1;
        Some((unit, self.chosen.individual.get(&self.paths[unit]).copied().unwrap_or(Draw::OWN)))
    }

    /// Minimum gain of other draws of a unit if at most `most` stems may have some: more than the least of their
    /// gains.
    pub(super) fn min_gain(&self, unit: usize, most: usize) -> f64 {
        if self.chosen.len() < most || self.chosen.has(&self.paths[unit]) {
            return MIN_GAIN;
        }
        self.chosen.min_gain().max(MIN_GAIN)
    }

    /// Loss with `proposal`, whose part of a tree `worker` has taken; `None` if the only picture is unchanged or
    /// clearly further from the goal, or the part reaches too low.
    pub(super) fn tried(&self, scene: &Scene<'_>, proposal: &Proposal, worker: &mut Worker) -> Option<Loss> {
        if worker.lowest() < self.floors[proposal.unit] {
            return None;
        }
        let mut sum = Sum::default();
        for (view, view_state) in self.views.iter().enumerate() {
            worker.picture.clone_from(&view_state.picture);
            worker.show(scene, view, &view_state.stack, &self.layers[proposal.unit][view]);
            if self.views.len() == 1
                && !may_be_better(&worker.picture, &view_state.picture, &scene.views[view].picture)
            {
                return None;
            }
            sum.add(scene, view, &worker.picture, &mut worker.buffers);
        }
        Some(self.with_prices(sum.mean(), proposal))
    }

    /// Loss with `proposal`, whose parts cover `layers`.
    pub(super) fn tried_again(
        &self,
        scene: &Scene<'_>,
        proposal: &Proposal,
        layers: &[Layer],
        worker: &mut Worker,
    ) -> Loss {
        let mut sum = Sum::default();
        for (view, (view_state, new)) in self.views.iter().zip(layers).enumerate() {
            worker.picture.clone_from(&view_state.picture);
            view_state.stack.exchanged(&self.layers[proposal.unit][view], new, &mut worker.picture);
            sum.add(scene, view, &worker.picture, &mut worker.buffers);
        }
        self.with_prices(sum.mean(), proposal)
    }

    fn with_prices(&self, loss: Loss, proposal: &Proposal) -> Loss {
        let others = self.chosen.price_beside(&self.paths[proposal.unit], proposal.reseeds);
        Loss { cost: loss.cost + others + self.price(proposal), ..loss }
    }

    /// The price of a stem's draws.
    fn price(&self, proposal: &Proposal) -> f64 {
        PRICE * proposal.draw.price(&proposal.spread) / self.count() as f64
    }

    /// Exchanges the draws of a unit.
    pub(super) fn exchange(&mut self, proposal: &Proposal, layers: Vec<Layer>, loss: Loss) {
        let (price, gain) = (self.price(proposal), self.cost - loss.cost);
        let Proposal { unit, draw, reseeds, .. } = *proposal;
        self.chosen.set(self.paths[unit].clone(), draw, reseeds, price, gain);
        for ((view_state, old), new) in self.views.iter_mut().zip(&self.layers[unit]).zip(&layers) {
            view_state.stack.exchanged(old, new, &mut view_state.picture);
            view_state.stack.remove(old);
            view_state.stack.add(new);
        }
        self.layers[unit] = layers;
        self.take(loss);
    }
}

/// Whether `picture` may be better than the picture `before`: not if it is the same, or if three of four changed
/// pixels are wrong now.
fn may_be_better(picture: &Bitmap, before: &Bitmap, goal: &Bitmap) -> bool {
    let changed = picture.differing(before);
    let worse = picture.differing(goal) as f64 - before.differing(goal) as f64;
    changed > 0 && worse <= 0.5 * changed as f64
}

/// Sums over views.
#[derive(Default)]
struct Sum {
    views: f64,
    cost: f64,
    iou: f64,
    likeness: f64,
}

impl Sum {
    fn add(&mut self, scene: &Scene<'_>, view: usize, picture: &Bitmap, buffers: &mut Buffers) {
        let comparison = scene.compare(view, picture, buffers);
        self.views += 1.0;
        self.cost += 1.0 - comparison.value;
        self.iou += comparison.iou;
        self.likeness += comparison.likeness;
    }

    fn mean(&self) -> Loss {
        let Self { views, cost, iou, likeness } = *self;
        Loss { cost: cost / views, iou: iou / views, likeness: likeness / views }
    }
}
