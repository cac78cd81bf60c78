//! Where the trees of a forest stand: discs that do not touch.
//!
//! Robert Bridson 2007, *Fast Poisson disk sampling in arbitrary dimensions*: new points are thrown
//! into the ring around old ones and kept where nothing is nearer than the spacing; a grid of cells
//! that hold one point each makes the test quick. This is the one place of the crate that draws
//! random numbers, by address: it plants and does not mesh.

use glam::{DVec2, dvec2};
use pleach_plant::Key;
use pleach_plant::trig::sin_cos;
use std::f64::consts::TAU;

/// Throws around a point before it is given up (Bridson's k).
const THROWS: u32 = 30;
/// No forest has more trees.
const MAX_TREES: usize = 1_000_000;

/// What a draw is for.
mod purpose {
    pub(super) const FIRST: u32 = 1;
    pub(super) const PICK: u32 = 2;
    pub(super) const RADIUS: u32 = 3;
    pub(super) const ANGLE: u32 = 4;
    pub(super) const VARIANT: u32 = 5;
    pub(super) const TURN: u32 = 6;
    pub(super) const SCALE: u32 = 7;
}

/// One tree of a forest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// In metres, the middle of the forest at the origin.
    pub position: DVec2,
    /// Which of the variants stands here.
    pub variant: u32,
    /// Turn about the vertical, in radians.
    pub turn: f64,
    /// Size against the variant, 0.85 to 1.15.
    pub scale: f64,
}

/// Why a forest cannot be planted.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForestError {
    /// A side or the spacing is not a positive number.
    #[error("a forest needs positive sides and spacing, not {width} × {depth} m every {spacing} m")]
    NotPositive {
        /// Metres along x.
        width: f64,
        /// Metres along y.
        depth: f64,
        /// Metres between trees.
        spacing: f64,
    },
    /// More trees than any file should hold.
    #[error(
        "{width} × {depth} m with a tree every {spacing} m are more than {MAX_TREES} trees; a wider spacing"
    )]
    TooMany {
        /// Metres along x.
        width: f64,
        /// Metres along y.
        depth: f64,
        /// Metres between trees.
        spacing: f64,
    },
}

/// Plants a field of `width` × `depth` metres so that no two trees stand nearer than `spacing` metres
/// and no gap would take another, with `variants` kinds of trees. The same seed plants the same
/// forest.
///
/// # Errors
/// See [`ForestError`].
pub fn plant(
    width: f64,
    depth: f64,
    spacing: f64,
    variants: u32,
    seed: u64,
) -> Result<Vec<Site>, ForestError> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    if !(positive(width) && positive(depth) && positive(spacing)) {
        return Err(ForestError::NotPositive { width, depth, spacing });
    }
    // Each disc of half the spacing takes at least its own area.
    if (width / spacing + 1.0) * (depth / spacing + 1.0) * 1.3 > MAX_TREES as f64 {
        return Err(ForestError::TooMany { width, depth, spacing });
    }
    let key = Key::root(seed);
    let field = dvec2(width, depth);
    let mut grid = Grid::new(field, spacing);
    let mut points = vec![field * dvec2(key.unit(purpose::FIRST, 0), key.unit(purpose::FIRST, 1))];
    grid.add(points[0], 0);
    let mut active = vec![0_usize];
    let mut step = 0;
    while !active.is_empty() {
        let pick = (key.unit(purpose::PICK, step) * active.len() as f64) as usize;
        step += 1;
        let index = active[pick];
        let around = key.child(purpose::PICK, index as u32);
        let thrown = (0..THROWS).map(|k| {
            // Even over the ring between one and two spacings.
            let radius = spacing * (1.0 + 3.0 * around.unit(purpose::RADIUS, k)).sqrt();
            let (sin, cos) = sin_cos(TAU * around.unit(purpose::ANGLE, k));
            points[index] + dvec2(cos, sin) * radius
        });
        let inside = |p: &DVec2| p.cmpge(DVec2::ZERO).all() && p.cmple(field).all();
        let found = thrown.filter(inside).find(|p| grid.is_free(*p, &points));
        match found {
            Some(point) => {
                grid.add(point, points.len());
                active.push(points.len());
                points.push(point);
            }
            None => {
                active.swap_remove(pick);
            }
        }
    }
    let site = |(i, point): (usize, &DVec2)| {
        let i = i as u32;
        Site {
            position: *point - field / 2.0,
            variant: (key.unit(purpose::VARIANT, i) * f64::from(variants.max(1))) as u32,
            turn: TAU * key.unit(purpose::TURN, i),
            scale: 1.0 + 0.15 * key.signed(purpose::SCALE, i),
        }
    };
    Ok(points.iter().enumerate().map(site).collect())
}

/// Cells so small that none holds two points.
struct Grid {
    cell: f64,
    spacing: f64,
    columns: usize,
    rows: usize,
    points: Vec<Option<u32>>,
}

impl Grid {
    fn new(field: DVec2, spacing: f64) -> Self {
        let cell = spacing / std::f64::consts::SQRT_2;
        let [columns, rows] = [field.x, field.y].map(|side| (side / cell) as usize + 1);
        Self { cell, spacing, columns, rows, points: vec![None; columns * rows] }
    }

    fn place(&self, p: DVec2) -> (usize, usize) {
        (((p.x / self.cell) as usize).min(self.columns - 1), ((p.y / self.cell) as usize).min(self.rows - 1))
    }

    fn add(&mut self, p: DVec2, index: usize) {
        let (x, y) = self.place(p);
        self.points[y * self.columns + x] = Some(index as u32);
    }

    fn is_free(&self, p: DVec2, points: &[DVec2]) -> bool {
        let (x, y) = self.place(p);
        (y.saturating_sub(2)..(y + 3).min(self.rows)).all(|y| {
            (x.saturating_sub(2)..(x + 3).min(self.columns)).all(|x| {
                self.points[y * self.columns + x]
                    .is_none_or(|i| points[i as usize].distance_squared(p) >= self.spacing * self.spacing)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_keep_their_distance_and_leave_no_gap() {
        let sites = plant(40.0, 30.0, 4.0, 3, 7).unwrap();
        for (i, a) in sites.iter().enumerate() {
            assert!(a.position.x.abs() <= 20.0 && a.position.y.abs() <= 15.0 && a.variant < 3);
            assert!((0.85..=1.15).contains(&a.scale));
            for b in &sites[..i] {
                assert!(a.position.distance(b.position) >= 4.0 - 1e-9);
            }
        }
        // Nearly every place of the field is within two spacings of a tree, most within one.
        for k in 0..200 {
            let f = |step: f64| (f64::from(k) * step).fract() - 0.5;
            let p = dvec2(40.0 * f(0.618_034), 30.0 * f(0.754_878));
            assert!(sites.iter().any(|s| s.position.distance(p) < 8.0), "a gap at {p}");
        }
        assert!((45..110).contains(&sites.len()), "{}", sites.len());
        assert_eq!(plant(40.0, 30.0, 4.0, 3, 7).unwrap(), sites);
        assert_ne!(plant(40.0, 30.0, 4.0, 3, 8).unwrap(), sites);
    }

    #[test]
    fn impossible_forests_are_refused() {
        for (w, d, s) in [(0.0, 5.0, 1.0), (5.0, -1.0, 1.0), (5.0, 5.0, 0.0), (f64::NAN, 5.0, 1.0)] {
            assert!(matches!(plant(w, d, s, 1, 1), Err(ForestError::NotPositive { .. })), "{w} {d} {s}");
        }
        assert!(matches!(plant(1e6, 1e6, 1.0, 1, 1), Err(ForestError::TooMany { .. })));
        assert_eq!(plant(1.0, 1.0, 10.0, 1, 1).unwrap().len(), 1);
    }
}
