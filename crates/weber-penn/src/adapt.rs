//! Numbers of trees that stand as a picture shows.
//!
//! Everything is set by the difference between what is wanted and what has grown: branches of higher levels, leaves and
//! the draws of a seed reach beyond what the numbers of the trunk and of its branches say.

use crate::crown;
use crate::params::HEIGHTS;
use crate::params::table::{Id, Model};
use pleach_tree::param::table::Parameters;
use pleach_tree::{Stature, math};

/// Leans that differ by fewer degrees stay: readings are right to three.
const MIN_LEAN: f64 = 3.0;
/// Crowns whose middles differ by less, in half-widths, stay: as near are three quarters of the pairs of seeds of
/// ten known species (`pleach silhouette NAME --seed N`, `pleach read`, four seeds each).
const MIN_SIDE: f64 = 0.3;
/// Outlines that differ by less, as a part of their area, stay: as three quarters of those pairs.
const MIN_OUTLINE: f64 = 0.25;
/// The most by which one step changes a width.
const MAX_FACTOR: f64 = 2.0;
/// The most that a trunk comes back, in degrees.
const MAX_BOW: f64 = 40.0;

/// Changes `values`, whose tree stands as `grown`, towards `wanted`.
pub(crate) fn adapt(values: &mut [f64], wanted: &Stature, grown: &Stature) {
    let model = Model::read(values);
    let mut change = |id: Id, index: usize, change: &dyn Fn(f64) -> f64| {
        let value = &mut values[id.slot(index).index()];
        *value = change(*value);
    };
    if let Some((wanted, grown)) = wanted.thickness.zip(grown.thickness) {
        change(Id::ratio, 0, &|ratio| ratio * (wanted / grown));
    }
    if let Some((wanted, grown)) = wanted.bare_height.zip(grown.bare_height) {
        change(Id::base_size, 0, &|base| base + (wanted - grown));
    }
    let crowns = Crown::new(wanted).zip(Crown::new(grown)).filter(|_| model.level_count > 1);
    let course = Course::new(&model);
    let new = course.adapted(wanted.lean.zip(grown.lean.or(Some(course.lean()))), crowns.as_ref());
    if new != course {
        change(Id::lean, 0, &|_| new.lean());
        change(Id::bow, 0, &|_| new.bow());
    }
    let Some((wanted, grown)) = crowns else { return };
    let moved = new.offset(&wanted) - course.offset(&wanted);
    let side = (wanted.middle - grown.middle - moved) / wanted.half_width;
    if side.abs() >= MIN_SIDE {
        change(Id::side, 0, &|known| (known + side).clamp(-1.0, 1.0));
    }
    if wanted.differs_from(&grown) >= MIN_OUTLINE {
        let wider = wanted.area() / grown.area();
        change(Id::length, 1, &|length| length * wider);
        for place in 0..HEIGHTS {
            let reach = reach(&model, place);
            let factor = wanted.width(reach) / grown.width(reach).max(f64::MIN_POSITIVE);
            let factor = factor.clamp(1.0 / MAX_FACTOR, MAX_FACTOR);
            change(Id::outline, place, &|known| known * factor / wider);
        }
    }
}

/// Where the branches of place number `place` of `outline` end, over the height of the tree.
fn reach(model: &Model, place: usize) -> f64 {
    let [trunk, branch, ..] = &model.levels;
    let rise = place as f64 / (HEIGHTS - 1) as f64;
    let length = branch.length * model.shape_ratio(1.0 - rise) * crown::outline(model, 1.0 - rise);
    let foot = trunk.base_size + (1.0 - trunk.base_size) * rise;
    (foot + length * math::cos(branch.down_angle + branch.curve / 2.0)).clamp(foot.min(1.0), 1.0)
}

/// The course of a trunk: slope at the foot, and half of what the slope gains up to the top.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    foot: f64,
    gain: f64,
}

impl Course {
    fn new(model: &Model) -> Self {
        let gain = math::tan(model.bow / 2.0);
        Self { foot: math::tan(model.lean) - gain, gain }
    }

    /// `lean` in degrees.
    fn lean(&self) -> f64 {
        math::atan(self.foot + self.gain).to_degrees()
    }

    /// `bow` in degrees.
    fn bow(&self) -> f64 {
        2.0 * math::atan(self.gain).to_degrees()
    }

    /// Mean displacement of `crown`, over the height of the tree.
    fn offset(&self, crown: &Crown) -> f64 {
        self.foot * crown.height + self.gain * crown.square
    }

    /// With the foot's lean changed from the second of `leans` to the first, in degrees; a trunk whose crown stands less
    /// far out than it leans comes back.
    fn adapted(&self, leans: Option<(f64, f64)>, crowns: Option<&(Crown, Crown)>) -> Self {
        let Some((wanted, grown)) = leans.filter(|(wanted, grown)| (wanted - grown).abs() >= MIN_LEAN) else {
            return *self;
        };
        let [wanted, grown] = [wanted, grown].map(|lean| math::tan(lean.to_radians()));
        let foot = self.foot + wanted - grown;
        let gain = crowns.map_or(self.gain, |(wanted_crown, grown_crown)| {
            let gain = |crown: &Crown, slope: f64| (crown.middle - slope * crown.height) / crown.square;
            self.gain + gain(wanted_crown, wanted) - gain(grown_crown, grown)
        });
        let most = math::tan(MAX_BOW.to_radians() / 2.0);
        let gain = if gain * foot < 0.0 { gain.clamp(-most, most) } else { self.gain };
        Self { foot, gain }
    }
}

/// The outline of a crown. Lengths are over the height of the tree.
struct Crown {
    /// Widths at even heights from the ground to the top, 0 below the crown.
    widths: Vec<f64>,
    /// Mean height.
    height: f64,
    /// Mean square of the height.
    square: f64,
    /// Mean place of its middle, towards +x from the foot.
    middle: f64,
    /// Mean half-width. All four means are weighted by the widths.
    half_width: f64,
}

impl Crown {
    /// `None` where there is no outline, or nothing in it.
    fn new(stature: &Stature) -> Option<Self> {
        let [left, right] = stature.crown.as_ref()?;
        let last = left.len().min(right.len()).checked_sub(1).filter(|&last| last > 0)? as f64;
        let bare = stature.bare_height.unwrap_or(0.0);
        let rows = left.iter().zip(right).enumerate().map(|(row, (l, r))| (row as f64 / last, l, r));
        let width = |(z, l, r): (f64, &f64, &f64)| if z < bare { 0.0 } else { (l + r).max(0.0) };
        let widths: Vec<f64> = rows.clone().map(width).collect();
        let area: f64 = widths.iter().sum();
        if area <= 0.0 {
            return None;
        }
        let mean = |of: &dyn Fn(f64, f64, f64) -> f64| {
            rows.clone().zip(&widths).map(|((z, l, r), width)| width * of(z, *l, *r)).sum::<f64>() / area
        };
        let (height, square) = (mean(&|z, _, _| z), mean(&|z, _, _| z * z));
        let (middle, half_width) = (mean(&|_, l, r| (r - l) / 2.0), mean(&|_, l, r| (l + r) / 2.0));
        (height > 0.0).then_some(Self { widths, height, square, middle, half_width })
    }

    fn area(&self) -> f64 {
        self.widths.iter().sum()
    }

    /// The area that is in one of two outlines alone, if both stand on one axis, over the area of this one.
    fn differs_from(&self, other: &Self) -> f64 {
        let apart = self.widths.iter().zip(&other.widths).map(|(a, b)| (a - b).abs()).sum::<f64>();
        apart / self.area()
    }

    /// The width at height `z`, as the mean of the rows around it.
    fn width(&self, z: f64) -> f64 {
        let row = (z.clamp(0.0, 1.0) * (self.widths.len() - 1) as f64).round() as usize;
        let around = &self.widths[row.saturating_sub(1)..(row + 2).min(self.widths.len())];
        around.iter().sum::<f64>() / around.len() as f64
    }
}
