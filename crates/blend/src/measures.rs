//! Visible properties of a tree as numbers, to show how they change across the map.

use pleach_silhouette::{Bitmap, Detail, Rasterizer};
use pleach_tree::math;
use pleach_tree::{StemKind, Tree, TreeStats};

use crate::draw::{Drawing, picture};

/// A readable property of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Height over the wider of its two widths.
    HeightToWidth,
    /// Share of ink in the box around its silhouette, 0 to 1.
    Ink,
    /// Height of the lowest branch over the tree's height, 0 to 1.
    BareTrunk,
    /// Mean angle between the vertical and the first-level branches where they leave, in degrees: 0 up,
    /// 90 level, above that down.
    BranchAngle,
    /// Mean angle by which first-level branches point lower at their tips than where they leave, in
    /// degrees; negative where they rise.
    Droop,
}

impl Measure {
    /// Every trait.
    pub const ALL: [Self; 5] =
        [Self::HeightToWidth, Self::Ink, Self::BareTrunk, Self::BranchAngle, Self::Droop];

    /// Its name in commands and columns.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::HeightToWidth => "height_to_width",
            Self::Ink => "ink",
            Self::BareTrunk => "bare_trunk",
            Self::BranchAngle => "branch_angle",
            Self::Droop => "droop",
        }
    }

    /// The trait called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|t| t.name() == name)
    }

    /// Measures `tree`; 0 for angles of a tree without branches.
    #[must_use]
    pub fn value(self, tree: &Tree) -> f64 {
        match self {
            Self::HeightToWidth => {
                let stats = TreeStats::new(tree);
                stats.height_m / stats.crown_width_x_m.max(stats.crown_width_y_m).max(1e-9)
            }
            Self::Ink => {
                let drawing = Drawing { pixels: 128, detail: Detail::Half };
                share_of_ink(&picture(tree, &mut Rasterizer::new(), drawing))
            }
            Self::BareTrunk => {
                let stats = TreeStats::new(tree);
                stats.lowest_branch_m / stats.height_m.max(1e-9)
            }
            Self::BranchAngle => mean(branches(tree).map(|(leaving, _)| leaving)),
            Self::Droop => mean(branches(tree).map(|(leaving, arriving)| arriving - leaving)),
        }
    }
}

/// How far `values`, one a place, rise along the direction in which `along` does: Pearson's correlation,
/// −1 to 1; 0 where either never changes.
///
/// # Panics
/// If the two differ in length.
#[must_use]
pub fn correlation(along: &[f64], values: &[f64]) -> f64 {
    assert_eq!(along.len(), values.len(), "one value a place");
    let centered = |list: &[f64]| {
        let middle = mean(list.iter().copied());
        list.iter().map(|v| v - middle).collect::<Vec<f64>>()
    };
    let (a, b) = (centered(along), centered(values));
    let product = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(x, y)| x * y).sum::<f64>();
    let size = (product(&a, &a) * product(&b, &b)).sqrt();
    if size > 0.0 { product(&a, &b) / size } else { 0.0 }
}

/// Ink over the area of the box around it; 0 for an empty picture.
fn share_of_ink(bitmap: &Bitmap) -> f64 {
    bitmap.ink_box().map_or(0.0, |(x0, y0, x1, y1)| {
        let area = f64::from(x1 - x0 + 1) * f64::from(y1 - y0 + 1);
        bitmap.ink() as f64 / area
    })
}

/// Angles from the vertical, in degrees, of the first-level branches: where they leave and at their
/// tips.
fn branches(tree: &Tree) -> impl Iterator<Item = (f64, f64)> + '_ {
    tree.stems.iter().filter(|s| s.level == 1 && s.kind == StemKind::Branch).filter_map(|stem| {
        let knots = tree.knots_of(stem);
        let (first, last) = (knots.first()?, knots.last()?);
        let leaving = (first.handle_out - first.point).try_normalize()?;
        let arriving = (last.point - last.handle_in).try_normalize()?;
        let angle = |z: f64| math::acos(z.clamp(-1.0, 1.0)).to_degrees();
        Some((angle(leaving.z), angle(arriving.z)))
    })
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0_f64), |(s, n), v| (s + v, n + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::species;

    #[test]
    fn traits_say_what_everybody_sees() {
        let of = |t: Measure, name: &str| t.value(&species(name).grow(1).unwrap());
        let poplar = of(Measure::HeightToWidth, "lombardy_poplar");
        assert!(poplar > 1.5 * of(Measure::HeightToWidth, "black_oak"), "{poplar}");
        assert!(of(Measure::BareTrunk, "palm") > 0.7);
        assert!(of(Measure::BareTrunk, "balsam_fir") < 0.2);
        assert!(of(Measure::Droop, "palm") > of(Measure::Droop, "lombardy_poplar") + 20.0);
        let fir = of(Measure::BranchAngle, "douglas_fir");
        assert!(fir > 60.0 && of(Measure::BranchAngle, "lombardy_poplar") < 50.0, "{fir}");
        let ink = of(Measure::Ink, "apple");
        assert!((0.3..=1.0).contains(&ink) && of(Measure::Ink, "palm") < ink, "{ink}");
    }

    #[test]
    fn correlation_by_hand() {
        // Deviations −1, 0, 1 and −2, 1, 1: 3 / √(2 · 6).
        assert!((correlation(&[1.0, 2.0, 3.0], &[0.0, 3.0, 3.0]) - 3.0 / 12.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(correlation(&[1.0, 2.0], &[5.0, 5.0]), 0.0);
    }

    #[test]
    fn names_lead_back_to_traits() {
        assert!(Measure::ALL.into_iter().all(|t| Measure::named(t.name()) == Some(t)));
        assert_eq!(Measure::named("beauty"), None);
    }
}
