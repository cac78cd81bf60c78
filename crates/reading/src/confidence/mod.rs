//! How far each measure can be trusted, from what was seen on the way.

mod logistic;
mod models;

use crate::reader::Strokes;
use crate::reading::Reading;

/// Rows of ink below which a picture shows no tree.
const SMALLEST: f64 = 16.0;
/// Rows from which on an outline is read as finely as it is stored.
const LARGE: f64 = 64.0;
/// Rows from which on a grain is read as finely as it is meant.
const FINE: f64 = 128.0;
/// Every side of the picture that the ink touches takes this part of the confidence in the outline.
const CUT: f64 = 0.15;
/// A trunk that is bare over less than this part of the height, or seen over fewer of its widths, shows its lean
/// badly: the confidence falls to this part of the model's.
const SHORT: f64 = 0.1;
const SLENDER: f64 = 2.5;
const SHORT_LEAN: f64 = 0.4;
/// Pixels of fine ink from which on its mean width and direction settle.
const FINE_INK: f64 = 500.0;

/// What confidences are made from: numbers that were met while a picture was read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evidence {
    pub(crate) feet: f64,
    pub(crate) level: f64,
    pub(crate) agreement: f64,
    pub(crate) unsteady: f64,
    pub(crate) most_unsteady: f64,
    pub(crate) width_px: f64,
    pub(crate) lean_rows: f64,
    pub(crate) trunk_rows: f64,
    pub(crate) trunk_seen: f64,
    pub(crate) bare: f64,
    pub(crate) fork: f64,
    pub(crate) fork_seen: f64,
    pub(crate) cut_sides: f64,
    pub(crate) height: f64,
    pub(crate) gap_share: f64,
    pub(crate) strokes: Strokes,
}

impl Evidence {
    /// The numbers with their names, for those who calibrate.
    #[must_use]
    pub fn values(&self) -> Vec<(&'static str, f64)> {
        let strokes = &self.strokes;
        vec![
            ("feet", self.feet),
            ("level", self.level),
            ("agreement", self.agreement),
            ("unsteady", self.unsteady),
            ("most_unsteady", self.most_unsteady),
            ("width_px", self.width_px),
            ("lean_rows", self.lean_rows),
            ("trunk_rows", self.trunk_rows),
            ("trunk_seen", self.trunk_seen),
            ("bare", self.bare),
            ("fork", self.fork),
            ("fork_seen", self.fork_seen),
            ("cut_sides", self.cut_sides),
            ("height", self.height),
            ("gap_share", self.gap_share),
            ("fine", strokes.fine),
            ("width", strokes.width),
            ("rough", strokes.rough),
            ("lines", strokes.lines),
            ("strongest", strokes.strongest),
            ("ends", strokes.ends),
            ("hanging", strokes.hanging),
            ("elevation", strokes.elevation),
            ("upright", strokes.upright),
            ("half_mass", strokes.mass[0]),
            ("mass", strokes.mass[1]),
        ]
    }

    /// What tells leaves from twigs, for the model of leaves: each number, then the products of any two.
    #[must_use]
    pub fn texture(&self) -> [f64; 104] {
        let strokes = &self.strokes;
        let numbers = [
            self.gap_share,
            strokes.fine,
            strokes.width,
            100.0 * strokes.width / self.height.max(1.0),
            strokes.lines.min(3.0),
            strokes.strongest,
            strokes.ends,
            strokes.rough,
            strokes.hanging,
            strokes.upright,
            strokes.mass[0],
            strokes.mass[1],
            // Leaves of a few pixels look as twigs do.
            (self.height / 256.0).min(3.0),
        ];
        let products =
            (0..numbers.len()).flat_map(|i| numbers[i..].iter().map(move |other| numbers[i] * other));
        let mut all = [0.0; 104];
        for (to, number) in all.iter_mut().zip(numbers.into_iter().chain(products)) {
            *to = number;
        }
        all
    }

    /// Rows of the trunk that the lean is read from, in widths of the trunk.
    fn slender(&self) -> f64 {
        self.lean_rows * self.height / self.width_px.max(1.0)
    }

    /// What tells how well feet and trunk were seen, for the other models.
    #[must_use]
    pub fn stem(&self) -> [f64; 17] {
        [
            self.feet.min(6.0),
            self.level,
            self.agreement,
            self.unsteady,
            self.most_unsteady,
            self.width_px.min(30.0),
            self.lean_rows.min(0.2),
            self.trunk_rows,
            self.trunk_seen,
            self.bare.min(0.3),
            self.fork,
            f64::from(u8::from(self.fork >= 0.0)),
            self.gap_share,
            self.strokes.fine,
            (1.0 / self.width_px.max(0.5)).min(1.0),
            (self.bare / SHORT).min(1.0),
            self.slender().min(4.0),
        ]
    }

    /// Sets whether there are leaves, and all confidences.
    pub(crate) fn judge(&self, reading: &mut Reading) {
        // Pictures of a few pixels show no tree.
        let is_tree = self.height >= SMALLEST && !reading.feet.is_empty();
        let trust = |confidence: f64| if is_tree { confidence } else { 0.0 };
        let leafy = models::LEAVES.probability(&self.texture());
        reading.leaves = is_tree && leafy >= 0.5;
        reading.leaves_confidence = trust(leafy.max(1.0 - leafy));
        let stem = self.stem();
        reading.feet_confidence = trust(models::FEET.probability(&stem));
        reading.width_confidence = trust(models::WIDTH.probability(&stem));
        // An axis is as good as what is seen of it.
        reading.trunk_confidence = trust(self.trunk_seen * (self.trunk_rows / 0.1).min(1.0));
        let lean = if reading.lean_deg.is_some() { models::LEAN.probability(&stem) } else { 0.0 };
        // Few grown trees have a short and thick stem, so the model alone does not learn to doubt it.
        let long = (self.bare / SHORT).min(self.slender() / SLENDER).min(1.0);
        reading.lean_deg_confidence = trust(lean * (SHORT_LEAN + (1.0 - SHORT_LEAN) * long));
        reading.bare_height_confidence = trust(models::BARE.probability(&stem));
        reading.first_fork_confidence = trust(models::FORK.probability(&stem));
        // What is read off the outline is as good as the picture is whole and large.
        let whole = trust((1.0 - CUT * self.cut_sides) * (self.height / LARGE).min(1.0));
        let has_crown = if self.strokes.ink > 0.0 { whole } else { 0.0 };
        reading.crown_confidence = whole;
        reading.crown_widest_confidence = 0.9 * has_crown;
        reading.asymmetry_confidence = has_crown * reading.feet_confidence;
        reading.gap_share_confidence = 0.95 * has_crown;
        reading.clumps_confidence = 0.6 * has_crown;
        let fine = (self.height / FINE).min(1.0);
        reading.grain_confidence =
            if reading.grain_upright.is_some() { 0.95 * has_crown * fine } else { 0.0 };
        let lines = (self.strokes.ink * self.strokes.fine / FINE_INK).min(1.0);
        reading.twig_fineness_confidence = 0.8 * has_crown * lines;
        if !reading.leaves {
            reading.leaf_size_px = None;
        }
        let leaves = 0.5 * has_crown * lines * reading.leaves_confidence;
        reading.leaf_size_px_confidence = if reading.leaf_size_px.is_some() { leaves } else { 0.0 };
        let strokes = 0.8 * has_crown * lines * self.strokes.lines.min(1.0);
        reading.stroke_deg_confidence = if reading.stroke_deg.is_some() { strokes } else { 0.0 };
    }
}
