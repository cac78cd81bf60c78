//! A species whose volume follows the outline of a tree in pictures.

use crate::generator::LeastCostPath;
use crate::generator::NAME;
use crate::numbers::{Id, Numbers};
use crate::structure::{Drawn, Structure};
use pleach_tree::Appearance;
use pleach_tree::math;
use pleach_tree::param::table::Parameters;
use pleach_tree::{Foliage, Species};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Directions in which a crown's radius is given.
const DIRECTIONS: usize = 8;
/// A row this wide, over the widest, is crown and not trunk.
const CROWN: f64 = 0.3;
/// Most of a tree that can be bare trunk.
const MAX_TRUNK: f64 = 0.7;
/// How far inside the outline the first volume ends, over the crown's largest radius: the graphs
/// around its endpoints fill the rest.
const MARGIN: f64 = 0.17;
/// Of each radius at least this is left.
const MIN_LEFT: f64 = 0.4;
/// Least radius of a crown over its largest: no height is cut off.
const MIN_RADIUS: f64 = 0.06;

/// The outline of a tree seen from one side.
#[derive(Clone, Debug, PartialEq)]
pub struct SideView {
    /// Where it is seen from, in radians around the trunk: 0 looks along +y, with +x to the right.
    pub azimuth: f64,
    /// At even heights from the ground to the tree's top: how far the tree reaches to the left and to
    /// the right of its foot, in meters; negative where all of it is on the other side. `None` where
    /// there is nothing.
    pub rows: Vec<Option<[f64; 2]>>,
}

/// The extents at the height `at`, from 0 to 1, of the nearest row that has some.
fn extents(view: &SideView, at: f64) -> Option<[f64; 2]> {
    let row = (at * (view.rows.len() - 1) as f64).round() as usize;
    let near = |far: usize| [row.checked_sub(far), Some(row + far)];
    let candidates = (0..view.rows.len()).flat_map(near).flatten();
    candidates.filter_map(|row| *view.rows.get(row)?).next()
}

/// The crown's radius in `direction`, in radians from +x towards +y, at the height `at`.
///
/// Within the visual hull: no farther than the tree reaches in any view. Between two views the radius is
/// interpolated; where no view shows it, it is the mean of the visible halves.
fn radius(views: &[SideView], at: f64, direction: f64) -> f64 {
    let (mut sum, mut weights, mut hull, mut halves) = (0.0, 0.0, f64::INFINITY, 0.0);
    for view in views {
        let [left, right] = extents(view, at).unwrap_or([0.0; 2]);
        let cos = math::cos(direction - view.azimuth);
        let reach = (if cos > 0.0 { right } else { left }).max(0.0);
        halves += (left + right).max(0.0) / 2.0;
        sum += cos * cos * reach;
        weights += cos * cos;
        if cos.abs() > 1e-6 {
            hull = hull.min(reach / cos.abs());
        }
    }
    let untold = (1.0 - weights).max(0.0);
    let mean = halves / views.len() as f64;
    ((sum + untold * mean) / (weights + untold)).min(hull.max(mean * untold))
}

/// A species of `height` meters whose first volume follows `views`; and further lists of its numbers,
/// sparser and denser, from which a search may start as well. `None` where there is nothing to follow:
/// no view with a row, or no height.
#[must_use]
pub fn species_around(views: &[SideView], height: f64) -> Option<(Species, Vec<Vec<f64>>)> {
    let seen = |view: &SideView| view.rows.len() > 1 && view.rows.iter().any(Option::is_some);
    if views.is_empty() || !views.iter().all(seen) || !(height.is_finite() && height > 0.0) {
        return None;
    }
    let rows = views.iter().map(|view| view.rows.len()).max().unwrap_or(2);
    let at = |row: usize| row as f64 / (rows - 1) as f64;
    let width = |row: usize| -> f64 {
        let of = |view| extents(view, at(row)).map_or(0.0, |[left, right]| left + right);
        views.iter().map(of).sum::<f64>() / views.len() as f64
    };
    let widths: Vec<f64> = (0..rows).map(width).collect();
    let widest = widths.iter().copied().fold(0.0, f64::max);
    let fork =
        widths.iter().position(|w| *w > CROWN * widest).unwrap_or(0).min((MAX_TRUNK * rows as f64) as usize);
    let trunk_radius = match widths[..fork].iter().copied().min_by(f64::total_cmp) {
        Some(width) => width / 2.0,
        None => 0.01 * height,
    };
    let crown: Vec<Vec<f64>> = (fork..rows)
        .map(|row| {
            (0..DIRECTIONS).map(|d| radius(views, at(row), TAU * d as f64 / DIRECTIONS as f64)).collect()
        })
        .collect();
    let largest = crown.iter().flatten().copied().fold(0.0, f64::max);
    if crown.len() < 2 || largest <= 0.0 {
        return None;
    }
    let margin = MARGIN * largest;
    let inner = |r: f64| (r - margin).max(MIN_LEFT * r);
    let rounded = |r: f64| (1e4 * (inner(r) / inner(largest)).max(MIN_RADIUS)).round() / 1e4;
    let radii: Vec<Vec<f64>> = crown.iter().map(|row| row.iter().map(|r| rounded(*r)).collect()).collect();
    let structure = Structure { outline: Drawn::of_radii(&radii), volumes: None };
    let (fork, crown_height) = (at(fork) * height, (1.0 - at(fork)) * height);
    let leaf = 0.025 * height;
    let thickness = trunk_radius / math::pow(1.2 * height, 0.6);
    let list = |branching: [f64; 3], reach: f64| {
        let mut values = Numbers::space().defaults();
        let mut set = |id: Id, numbers: &[f64]| {
            for (index, value) in numbers.iter().enumerate() {
                values[id.slot(index).index()] = *value;
            }
        };
        set(Id::trunk_height, &[fork.max(0.02 * height)]);
        set(Id::trunk_width, &[0.02 * height]);
        set(Id::crown_shape, &[3.0]);
        set(Id::crown_radius, &[inner(largest)]);
        set(Id::crown_height, &[inner(crown_height)]);
        set(Id::nodes, &[700.0]);
        set(Id::subgraph_nodes, &[32.0]);
        set(Id::branching, &branching);
        set(Id::angle, &[90.0, 70.0, 70.0]);
        set(Id::reach, &[reach]);
        set(Id::thickness, &[thickness]);
        set(Id::leaf_number, &[8.0]);
        set(Id::leaf_length, &[leaf]);
        Numbers::space().repair(&mut values);
        values
    };
    let lists: Vec<Vec<f64>> = [
        ([24.0, 5.0, 5.0], 0.22),
        ([12.0, 4.0, 5.0], 0.3),
        ([40.0, 4.0, 4.0], 0.16),
        ([30.0, 6.0, 6.0], 0.24),
        ([24.0, 3.0, 3.0], 0.16),
        ([10.0, 6.0, 6.0], 0.35),
    ]
    .into_iter()
    .map(|(branching, reach)| list(branching, reach))
    .collect();
    let params = Numbers::space().check(lists[0].clone()).ok()?;
    let species = Species {
        name: "outlined".to_owned(),
        description: format!("a tree of {NAME} in the outline of a picture"),
        generator: Arc::new(LeastCostPath { structure }),
        params,
        tree_seed: None,
        foliage: Foliage::All,
        appearance: Appearance::default(),
    };
    Some((species, lists))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::FRAC_PI_2;

    /// A ball of radius 3 on a trunk of 2 m, 8 m high, whose middle is `aside` to the right.
    fn lollipop(azimuth: f64, aside: f64) -> SideView {
        let row = |i: usize| {
            let z = 8.0 * i as f64 / 80.0;
            let half = (9.0 - (z - 5.0).powi(2)).max(0.0).sqrt();
            let is_trunk = z < 2.2;
            Some(if is_trunk { [0.1, 0.1] } else { [half - aside, half + aside] })
        };
        SideView { azimuth, rows: (0..=80).map(row).collect() }
    }

    #[test]
    fn one_view_gives_each_side_its_radius() {
        let views = [lollipop(0.0, 1.0)];
        assert!((radius(&views, 5.0 / 8.0, 0.0) - 4.0).abs() < 0.05);
        assert!((radius(&views, 5.0 / 8.0, 2.0 * FRAC_PI_2) - 2.0).abs() < 0.05);
        assert!((radius(&views, 5.0 / 8.0, FRAC_PI_2) - 3.0).abs() < 0.05);
    }

    #[test]
    fn no_direction_reaches_beyond_what_a_view_sees() {
        let views = [lollipop(0.0, 1.0), lollipop(FRAC_PI_2, -1.5)];
        for step in 0..64 {
            let direction = TAU * f64::from(step) / 64.0;
            let far = radius(&views, 5.0 / 8.0, direction);
            for view in &views {
                let [left, right] = extents(view, 5.0 / 8.0).unwrap();
                let along = far * (direction - view.azimuth).cos();
                assert!((-left - 1e-9..=right + 1e-9).contains(&along), "{direction}: {along}");
            }
        }
    }

    #[test]
    fn the_tree_fills_its_outline_and_little_more() {
        let (species, lists) = species_around(&[lollipop(0.0, 1.0)], 8.0).unwrap();
        assert!(lists.iter().all(|list| Numbers::space().check_all(list).is_ok()));
        let tree = species.grow(1).unwrap();
        let points: Vec<DVec3> = tree.knots.iter().map(|knot| knot.point).collect();
        let most = |f: fn(&DVec3) -> f64| points.iter().map(f).fold(f64::MIN, f64::max);
        let (right, left, top) = (most(|p| p.x), most(|p| -p.x), most(|p| p.z));
        assert!((3.0..4.6).contains(&right) && (1.3..2.7).contains(&left), "{left} {right}");
        assert!((6.5..8.8).contains(&top), "{top}");
        assert!(species_around(&[], 8.0).is_none());
        assert!(species_around(&[SideView { azimuth: 0.0, rows: vec![None; 9] }], 8.0).is_none());
        assert!(species_around(&[lollipop(0.0, 0.0)], f64::NAN).is_none());
    }
}
