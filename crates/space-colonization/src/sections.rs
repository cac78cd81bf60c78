//! The sections of a crown that grows into a hull.

use glam::DVec2;
use pleach_tree::{Hull, HullView};

/// Pieces of the tables of a crown along its height.
pub(crate) const PIECES: usize = 32;
/// Narrowest half of a section over the tree's height.
const MIN_HALF: f64 = 0.005;
/// Sine of the angle between two pictures from which on the second one shows how deep a crown is.
const ASIDE: f64 = 0.7;

/// Ellipses around a crown at even heights from its base to its top, as wide as its pictures show it.
#[derive(Clone, Debug)]
pub(crate) struct Sections {
    /// Heights of its base and its top.
    pub(crate) base: f64,
    pub(crate) top: f64,
    /// Directions of the half-axes: along the first picture, and away from its viewer.
    axes: [DVec2; 2],
    /// Middle and half-axes of each section along these directions.
    middles: [DVec2; PIECES + 1],
    halves: [DVec2; PIECES + 1],
}

impl Sections {
    /// Those of `hull`, `depth` times as deep as wide where no picture shows how deep; `None` if it is empty.
    pub(crate) fn new(hull: &Hull, depth: f64) -> Option<Self> {
        let front = hull.views.first()?;
        let (base, top) = front.rise()?;
        let right = front.right();
        let away = right.perp();
        // Seen from aside, right of a picture is away from the first one's viewer, or towards them.
        let side = hull.views[1..].iter().max_by(|a, b| {
            let aside = |view: &HullView| view.right().dot(away).abs();
            aside(a).total_cmp(&aside(b))
        });
        let side = side.filter(|view| view.right().dot(away).abs() >= ASIDE);
        let mut sections = Self {
            base,
            top,
            axes: [right, away],
            middles: [DVec2::ZERO; PIECES + 1],
            halves: [DVec2::splat(MIN_HALF); PIECES + 1],
        };
        for i in 0..=PIECES {
            // The ends of the crown are in its last rows.
            let z = (base + (top - base) * i as f64 / PIECES as f64).min(top - front.cell / 2.0);
            let Some((left, right)) = front.extent(z) else {
                // A gap between two parts of a crown.
                sections.middles[i] = sections.middles[i.saturating_sub(1)];
                continue;
            };
            let half = (right - left) / 2.0;
            sections.middles[i].x = f64::midpoint(left, right);
            sections.halves[i] = DVec2::new(half, half * depth);
            if let Some((view, (from, to))) = side.and_then(|view| Some((view, view.extent(z)?))) {
                let sign = view.right().dot(away).signum();
                sections.middles[i].y = sign * f64::midpoint(from, to);
                sections.halves[i].y = (to - from) / 2.0;
            }
        }
        Some(sections)
    }

    /// Middle and half-axes at the height `rise`, from the base (0) to the top (1).
    fn at(&self, rise: f64) -> (DVec2, DVec2) {
        let at = rise.clamp(0.0, 1.0) * PIECES as f64;
        let piece = (at as usize).min(PIECES - 1);
        let part = at - piece as f64;
        let between = |values: &[DVec2; PIECES + 1]| values[piece].lerp(values[piece + 1], part);
        (between(&self.middles), between(&self.halves).max(DVec2::splat(MIN_HALF)))
    }

    /// The place in the section at `rise`, `unit` of its half-axes from its middle.
    pub(crate) fn place(&self, rise: f64, unit: DVec2) -> DVec2 {
        let (middle, half) = self.at(rise);
        let flat = middle + unit * half;
        self.axes[0] * flat.x + self.axes[1] * flat.y
    }

    /// Where `flat` lies in the section at `rise`, in half-axes from its middle.
    pub(crate) fn unit(&self, rise: f64, flat: DVec2) -> DVec2 {
        let (middle, half) = self.at(rise);
        (DVec2::new(flat.dot(self.axes[0]), flat.dot(self.axes[1])) - middle) / half
    }

    /// Half of the greatest width.
    pub(crate) fn half_width(&self) -> f64 {
        self.halves.iter().map(|half| half.x).fold(MIN_HALF, f64::max)
    }

    /// Half of the mean width at `rise`, and π times less than its area.
    pub(crate) fn width_and_area(&self, rise: f64) -> (f64, f64) {
        let (_, half) = self.at(rise);
        (f64::midpoint(half.x, half.y), half.x * half.y)
    }
}
