//! The measures drawn over the picture, for people.

use crate::reading::Reading;
use pleach_silhouette::Bitmap;
use pleach_silhouette::picture::{LETTER, Picture, Rgb};
use serde::Serialize;

const INK: Rgb = [190, 190, 190];
/// Colours that people with any eyes can tell apart (Okabe and Ito 2008).
const FEET: Rgb = [213, 94, 0];
const TRUNK: Rgb = [0, 114, 178];
const BARE: Rgb = [0, 158, 115];
const FORK: Rgb = [204, 20, 140];
const CROWN: Rgb = [230, 159, 0];
/// Length of a fork's arms as drawn, in heights.
const ARM: f64 = 0.1;

/// Where the tree of a reading stands in its picture, in pixels from the upper left: from heights of the tree to pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Anchor {
    /// The column of x = 0.
    pub origin: f64,
    /// The row of y = 0.
    pub ground: f64,
    /// Rows of one height.
    pub height: f64,
}

impl Anchor {
    /// That of `reading`, which was read in `silhouette`; `None` where there is no tree.
    #[must_use]
    pub fn new(silhouette: &Bitmap, reading: &Reading) -> Option<Self> {
        let (_, top, _, bottom) = silhouette.ink_box()?;
        let ground = f64::from(bottom + 1);
        let height = ground - f64::from(top);
        Some(Self { origin: origin(silhouette, reading, height, ground)?, ground, height })
    }

    /// The column and the row of a point in heights of the tree.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.origin + x * self.height, self.ground - y * self.height)
    }
}

/// `reading` drawn over the `silhouette` that it is of: feet in vermilion, the trunk's axis and edges in blue, the
/// bare height as a green line, the first fork with its arms in purple, the outline in orange.
#[must_use]
pub fn annotate(silhouette: &Bitmap, reading: &Reading) -> Picture {
    let mut picture = Picture::new(silhouette.width(), silhouette.height());
    picture.stamp(silhouette, 0, 0, INK);
    let Some(place) = Anchor::new(silhouette, reading) else { return picture };
    let steps = (reading.crown.left.len().max(2) - 1) as f64;
    for (side, sign) in [(&reading.crown.left, -1.0), (&reading.crown.right, 1.0)] {
        let points = side.iter().zip(0_u32..).map(|(&reach, i)| place.at(sign * reach, f64::from(i) / steps));
        polyline(&mut picture, points, CROWN);
    }
    for shift in [-0.5, 0.5] {
        polyline(&mut picture, reading.trunk.iter().map(|p| place.at(p[0] + shift * p[2], p[1])), TRUNK);
    }
    polyline(&mut picture, reading.trunk.iter().map(|p| place.at(p[0], p[1])), TRUNK);
    for foot in &reading.feet {
        let half = foot.width / 2.0;
        for up in [0.004, 0.01, 0.016] {
            let ends = [place.at(foot.x - half, up), place.at(foot.x + half, up)];
            polyline(&mut picture, ends.into_iter(), FEET);
        }
    }
    if let Some(bare) = reading.bare_height {
        let x = reading.trunk.iter().rev().find(|p| p[1] <= bare).map_or(0.0, |p| p[0]);
        polyline(&mut picture, [place.at(x - 0.12, bare), place.at(x + 0.12, bare)].into_iter(), BARE);
    }
    if let (Some(y), Some(x)) = (reading.first_fork, reading.fork_x) {
        for angle in &reading.fork_arms_deg {
            let (sin, cos) = pleach_plant::math::sin_cos(angle.to_radians());
            polyline(
                &mut picture,
                [place.at(x, y), place.at(x + ARM * sin, y + ARM * cos)].into_iter(),
                FORK,
            );
        }
    }
    let leaves = if reading.leaves { "leafy" } else { "bare" };
    picture.write(&format!("{} feet, {leaves}", reading.feet.len()), 1, 1 + LETTER / 4);
    picture
}

/// The column that the outline is measured from: the one for which rows agree with it best.
fn origin(silhouette: &Bitmap, reading: &Reading, height: f64, ground: f64) -> Option<f64> {
    let steps = (reading.crown.left.len().max(2) - 1) as f64;
    let mut found: Vec<f64> = Vec::new();
    for (i, reach) in (0_u32..).zip(&reading.crown.left) {
        let y = (ground - 0.5 - f64::from(i) / steps * (height - 1.0)).round().max(0.0) as u32;
        if y < silhouette.height()
            && let Some(first) = silhouette.ink_in_row(y).next()
        {
            found.push(f64::from(first) + reach * height);
        }
    }
    found.sort_by(f64::total_cmp);
    found.get(found.len() / 2).copied()
}

fn polyline(picture: &mut Picture, points: impl Iterator<Item = (f64, f64)>, color: Rgb) {
    let mut last: Option<(f64, f64)> = None;
    for (x, y) in points {
        let from = last.unwrap_or((x, y));
        let steps = (x - from.0).abs().max((y - from.1).abs()).ceil().clamp(1.0, 4096.0) as u32;
        for i in 0..=steps {
            let t = f64::from(i) / f64::from(steps);
            let (x, y) = (from.0 + (x - from.0) * t, from.1 + (y - from.1) * t);
            if x >= 0.0 && y >= 0.0 {
                picture.set(x as u32, (y as u32).min(picture.height().saturating_sub(1)), color);
            }
        }
        last = Some((x, y));
    }
}
