//! The individual so far, as pictures that stems can be exchanged in.

use super::chosen::Chosen;
use super::hand::{DETAIL, Hand, Scene};
use super::units::{Unit, Units};
use crate::evaluator::Comparisons;
use pleach_silhouette::{Bitmap, Layer, Stack};
use pleach_tree::{Address, Draw, Spread, StemPath};

/// What all draws together cost at most, if every stem of a generation lay at the edge of its spread.
const PRICE: f64 = 0.02;
/// What has to be gained for draws to be exchanged.
pub(super) const LEAST_GAIN: f64 = 2e-5;

/// How far below the ground, as a part of the tree's height, a stem may hang that did not hang as low before. No
/// picture shows what a branch towards the viewer does there.
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
    /// How low what takes the place of each unit may reach, in metres.
    floors: Vec<f64>,
    panes: Vec<Pane>,
    pub(super) cost: f64,
    pub(super) iou: f64,
    pub(super) likeness: f64,
}

/// One picture.
struct Pane {
    stack: Stack,
    picture: Bitmap,
}

/// Other draws of one unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deal {
    pub(super) unit: usize,
    pub(super) draw: Draw,
    pub(super) reseeds: bool,
    pub(super) spread: Spread,
}

/// What a picture of all views is worth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worth {
    pub(super) cost: f64,
    iou: f64,
    likeness: f64,
}

impl State {
    /// The tree of `chosen`, cut at `generation`; none if it does not grow.
    pub(super) fn new(scene: &Scene<'_>, chosen: Chosen, generation: u16, hand: &mut Hand) -> Option<Self> {
        if !hand.grow(scene, &chosen.individual.draws()) {
            return None;
        }
        let units = Units::new(&hand.tree, generation);
        let mut panes: Vec<Pane> = scene
            .placed
            .iter()
            .map(|(_, frame)| Pane { stack: Stack::new(frame, DETAIL), picture: Bitmap::default() })
            .collect();
        let height = hand.tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
        let mut layers = Vec::with_capacity(units.units.len());
        let mut floors = Vec::with_capacity(units.units.len());
        for part in 0..=units.units.len() {
            hand.take(&units, part);
            let of_part = hand.layers(scene);
            for (pane, layer) in panes.iter_mut().zip(&of_part) {
                pane.stack.add(layer);
            }
            if part > 0 {
                layers.push(of_part);
                floors.push(hand.lowest().min(-BELOW * height));
            }
        }
        for pane in &mut panes {
            pane.stack.picture(&mut pane.picture);
        }
        let mut by_address: Vec<(u64, usize)> =
            units.units.iter().enumerate().map(|(i, unit)| (unit.address.bits(), i)).collect();
        by_address.sort_unstable();
        let paths = units.units.iter().map(|Unit { stem, .. }| hand.tree.path_of(*stem)).collect();
        let (cost, iou, likeness) = (f64::INFINITY, 0.0, 0.0);
        let mut state =
            Self { generation, chosen, by_address, paths, layers, floors, panes, cost, iou, likeness };
        let mut sum = Sum::default();
        for (view, pane) in state.panes.iter().enumerate() {
            sum.add(scene, view, &pane.picture, &mut hand.comparisons);
        }
        let worth = sum.mean();
        state.take(Worth { cost: worth.cost + state.chosen.price(), ..worth });
        Some(state)
    }

    fn take(&mut self, worth: Worth) {
        (self.cost, self.iou, self.likeness) = (worth.cost, worth.iou, worth.likeness);
    }

    /// Where the units are.
    pub(super) fn paths(&self) -> &[StemPath] {
        &self.paths
    }

    /// Number of units.
    pub(super) fn count(&self) -> usize {
        self.paths.len()
    }

    /// The number of the unit at `address`, and what it has drawn.
    pub(super) fn find(&self, address: Address) -> Option<(usize, Draw)> {
        let place = self.by_address.binary_search_by_key(&address.bits(), |&(bits, _)| bits).ok()?;
        let unit = self.by_address[place].1;
        Some((unit, self.chosen.individual.get(&self.paths[unit]).copied().unwrap_or(Draw::OWN)))
    }

    /// What has to be gained by other draws of a unit where at most `most` stems are to have some: more than by
    /// the least of them.
    pub(super) fn least_gain(&self, unit: usize, most: usize) -> f64 {
        if self.chosen.len() < most || self.chosen.has(&self.paths[unit]) {
            return LEAST_GAIN;
        }
        self.chosen.least_gain().max(LEAST_GAIN)
    }

    /// What the picture would be worth with `deal`, for which `hand` has taken the part of its tree; none where
    /// the one picture is the same as before, or plainly further from the goal, and where it would hang too low.
    pub(super) fn tried(&self, scene: &Scene<'_>, deal: &Deal, hand: &mut Hand) -> Option<Worth> {
        if hand.lowest() < self.floors[deal.unit] {
            return None;
        }
        let mut sum = Sum::default();
        for (view, pane) in self.panes.iter().enumerate() {
            hand.picture.clone_from(&pane.picture);
            hand.show(scene, view, &pane.stack, &self.layers[deal.unit][view]);
            if self.panes.len() == 1
                && !is_worth_a_look(&hand.picture, &pane.picture, &scene.views[view].goal)
            {
                return None;
            }
            sum.add(scene, view, &hand.picture, &mut hand.comparisons);
        }
        Some(self.with_prices(sum.mean(), deal))
    }

    /// What the picture would be worth with `deal`, whose parts cover `layers`.
    pub(super) fn tried_again(
        &self,
        scene: &Scene<'_>,
        deal: &Deal,
        layers: &[Layer],
        hand: &mut Hand,
    ) -> Worth {
        let mut sum = Sum::default();
        for (view, (pane, new)) in self.panes.iter().zip(layers).enumerate() {
            hand.picture.clone_from(&pane.picture);
            pane.stack.exchanged(&self.layers[deal.unit][view], new, &mut hand.picture);
            sum.add(scene, view, &hand.picture, &mut hand.comparisons);
        }
        self.with_prices(sum.mean(), deal)
    }

    fn with_prices(&self, worth: Worth, deal: &Deal) -> Worth {
        let others = self.chosen.price_beside(&self.paths[deal.unit], deal.reseeds);
        Worth { cost: worth.cost + others + self.price(deal), ..worth }
    }

    /// What a stem's draws cost.
    fn price(&self, deal: &Deal) -> f64 {
        PRICE * deal.draw.price(&deal.spread) / self.count() as f64
    }

    /// Exchanges the draws of a unit.
    pub(super) fn exchange(&mut self, deal: &Deal, layers: Vec<Layer>, worth: Worth) {
        let (price, gain) = (self.price(deal), self.cost - worth.cost);
        let Deal { unit, draw, reseeds, .. } = *deal;
        self.chosen.set(self.paths[unit].clone(), draw, reseeds, price, gain);
        for ((pane, old), new) in self.panes.iter_mut().zip(&self.layers[unit]).zip(&layers) {
            pane.stack.exchanged(old, new, &mut pane.picture);
            pane.stack.remove(old);
            pane.stack.add(new);
        }
        self.layers[unit] = layers;
        self.take(worth);
    }
}

/// Whether `picture` may be worth more than the picture `before`: not if it is the same, or if three of four pixels
/// that changed are wrong now.
fn is_worth_a_look(picture: &Bitmap, before: &Bitmap, goal: &Bitmap) -> bool {
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
    fn add(&mut self, scene: &Scene<'_>, view: usize, picture: &Bitmap, comparisons: &mut Comparisons) {
        let looks = scene.compare(view, picture, comparisons);
        self.views += 1.0;
        self.cost += 1.0 - looks.value;
        self.iou += looks.iou;
        self.likeness += looks.likeness;
    }

    fn mean(&self) -> Worth {
        let Self { views, cost, iou, likeness } = *self;
        Worth { cost: cost / views, iou: iou / views, likeness: likeness / views }
    }
}
