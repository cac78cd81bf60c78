//! Numbers of trees that stand as a picture shows.

use crate::params::{Id, Numbers, STATIONS};
use pleach_tree::Stature;
use pleach_tree::param::table::Parameters;

/// Steps of the profile over the height that a station takes the mean of.
const AROUND: usize = 1;
/// A crown that leans less than this, in half-widths, is not one-sided.
const MIN_SIDE: f64 = 0.05;

/// Sets what follows from `wanted` alone, and corrects by `grown` what twigs and leaves add to.
pub(crate) fn adapt(values: &mut [f64], wanted: &Stature, grown: &Stature) {
    let trunks = Numbers::read(values).trunks;
    let mut set = |id: Id, index: usize, change: &dyn Fn(f64) -> f64| {
        let at = &mut values[id.slot(index).index()];
        *at = change(*at);
    };
    if let Some(trunks) = wanted.trunks {
        set(Id::trunks, 0, &|_| f64::from(trunks.clamp(1, 6)));
    }
    if let Some((wanted, grown)) = wanted.thickness.zip(grown.thickness) {
        set(Id::thickness, 0, &|value| value * wanted / grown);
    }
    if let Some((wanted, grown)) = wanted.bare_height.zip(grown.bare_height) {
        set(Id::bare_height, 0, &|value| value + wanted - grown);
    }
    if let Some(fork) = wanted.first_fork {
        set(Id::first_fork, 0, &|_| fork);
        set(Id::limbs, 0, &|limbs| limbs.max(2.0));
    }
    // Several trunks lean away from each other.
    if let (Some(lean), 1) = (wanted.lean, wanted.trunks.unwrap_or(trunks)) {
        set(Id::lean, 0, &|_| lean.abs());
        set(Id::lean_azimuth, 0, &|_| if lean < 0.0 { 180.0 } else { 0.0 });
    }
    if let Some(crown) = &wanted.crown {
        let foot = wanted.bare_height.unwrap_or(0.0);
        let Some(outline) = Outline::new(crown, foot) else { return };
        let own = grown.crown.as_ref().and_then(|crown| Outline::new(crown, foot));
        // Twigs reach out of the volume that the scaffold fills.
        set(Id::crown_width, 0, &|value| match &own {
            Some(own) => value * outline.width / own.width,
            None => outline.width,
        });
        for (station, part) in outline.profile.into_iter().enumerate() {
            set(Id::profile, station, &|_| part);
        }
        // Where the trunk leans, the crown is displaced with it.
        let leaning = wanted.lean.map_or(0.0, |lean| pleach_tree::trig::sin_cos(lean.to_radians()).0);
        let side = (outline.middle - leaning * (1.0 + foot) / 2.0) / (outline.width / 2.0);
        set(Id::side, 0, &|_| if side.abs() < MIN_SIDE { 0.0 } else { side.abs() });
        set(Id::side_azimuth, 0, &|_| if side < 0.0 { 180.0 } else { 0.0 });
    }
}

/// The outline of a crown.
struct Outline {
    /// The greatest width.
    width: f64,
    /// Widths over the greatest one at the stations.
    profile: [f64; STATIONS],
    /// Mean place of its middle, towards +x.
    middle: f64,
}

impl Outline {
    /// Of a crown that begins at `foot`; `None` where there is nothing.
    fn new([left, right]: &[Vec<f64>; 2], foot: f64) -> Option<Self> {
        let rows: Vec<(f64, f64)> =
            left.iter().zip(right).map(|(l, r)| ((l + r).max(0.0), (r - l) / 2.0)).collect();
        let last = rows.len().checked_sub(1)?;
        let first = (foot.clamp(0.0, 0.9) * last as f64).ceil() as usize;
        let crown = rows.get(first..)?;
        let width = crown.iter().map(|row| row.0).fold(0.0, f64::max);
        let ink: f64 = crown.iter().map(|row| row.0).sum();
        if width <= 0.0 {
            return None;
        }
        let profile = std::array::from_fn(|station| {
            let at = (station as f64 / (STATIONS - 1) as f64 * (crown.len() - 1) as f64).round() as usize;
            let around = &crown[at.saturating_sub(AROUND)..(at + AROUND + 1).min(crown.len())];
            around.iter().map(|row| row.0).sum::<f64>() / around.len() as f64 / width
        });
        let middle = crown.iter().map(|row| row.0 * row.1).sum::<f64>() / ink;
        Some(Self { width, profile, middle })
    }
}
