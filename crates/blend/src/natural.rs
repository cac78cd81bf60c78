//! Natural-neighbour weights: how much of which landmark is at a point of the plane.
//!
//! Sibson (1981), *A brief description of natural neighbour interpolation*: if the point were a site
//! of the Voronoi diagram, its cell would take area from the cells of its neighbours; the share that
//! it takes from each is that neighbour's weight. The weights
//!
//! * are 0 or more and sum to 1, so a blend stays within the range of its species;
//! * are 1 on a landmark's own dot, so the map is exact there;
//! * are smooth everywhere but on the dots, where they are continuous;
//! * average the sites to the point itself (linear precision).
//!
//! The last is why they do what is asked of a map by principal components: average, *plus* the axes
//! back-projected, *plus* the landmarks' residuals averaged by these weights, is the same as the
//! landmarks themselves averaged by these weights. Nothing is left to choose between plane and
//! residual.
//!
//! On the hull's edges the weights run linearly between the two neighbouring landmarks; outside there
//! are none, and the nearest place of the hull is used.

use crate::landmarks::Weights;
use crate::plane::{Hull, OnHull, Point};

/// The world ends this many diameters away. Most cells fit into the small world, where places have
/// more digits; those of points at an edge of the hull reach far out, and the share that is cut off
/// there is about one part in the size of the large one.
const WORLDS: [f64; 2] = [8.0, 1e6];

/// Two sites nearer than this part of the diameter are one.
const SAME: f64 = 1e-9;

/// Sites on the plane, ready to give weights.
#[derive(Clone, Debug)]
pub struct NaturalNeighbor {
    /// Distinct places, with the landmarks at each.
    sites: Vec<(Point, Vec<usize>)>,
    /// Which site a landmark is on.
    site_of: Vec<usize>,
    landmarks: usize,
    hull: Hull,
    diameter: f64,
}

impl NaturalNeighbor {
    /// Sites at `dots`, one per landmark; landmarks on one place share its weight equally.
    #[must_use]
    pub fn new(dots: &[Point]) -> Self {
        let hull = Hull::new(dots);
        let far = |p: &Point| dots.iter().map(|q| p.distance(*q)).fold(0.0, f64::max);
        let diameter = dots.iter().map(far).fold(0.0, f64::max);
        let mut sites: Vec<(Point, Vec<usize>)> = Vec::new();
        let mut site_of = Vec::new();
        for (landmark, dot) in dots.iter().enumerate() {
            match sites.iter().position(|(place, _)| place.distance(*dot) <= SAME * diameter) {
                Some(site) => {
                    sites[site].1.push(landmark);
                    site_of.push(site);
                }
                None => {
                    site_of.push(sites.len());
                    sites.push((*dot, vec![landmark]));
                }
            }
        }
        Self { sites, site_of, landmarks: dots.len(), hull, diameter }
    }

    /// The hull of the sites.
    #[must_use]
    pub const fn hull(&self) -> &Hull {
        &self.hull
    }

    /// The weights at `point`, and its nearest place on the hull (itself where it is inside), where
    /// the weights are taken.
    #[must_use]
    pub fn weights(&self, point: Point) -> (Weights, OnHull) {
        let place = self.hull.nearest(point);
        let mut shares = vec![0.0; self.landmarks];
        let mut give = |site: usize, share: f64| {
            let (_, landmarks) = &self.sites[site];
            landmarks.iter().for_each(|&l| shares[l] += share / landmarks.len() as f64);
        };
        if let Some(site) =
            self.sites.iter().position(|(s, _)| s.distance(place.point) <= SAME * self.diameter)
        {
            give(site, 1.0);
        } else if let Some((from, to, part)) = place.edge {
            give(self.site_of[from], 1.0 - part);
            give(self.site_of[to], part);
        } else {
            self.stolen_areas(place.point).into_iter().for_each(|(site, area)| give(site, area));
        }
        (Weights::from_shares(shares), place)
    }

    /// The part of the box from `low` to `high` that is nearer to landmark number `landmark` than to
    /// any other, as a polygon; empty if there is none.
    #[must_use]
    pub fn region(&self, landmark: usize, low: Point, high: Point) -> Vec<Point> {
        let own = self.site_of[landmark];
        let corner = |x: f64, y: f64| Point { x, y };
        let mut cell = Polygon(vec![low, corner(high.x, low.y), high, corner(low.x, high.y)]);
        for (site, (place, _)) in self.sites.iter().enumerate() {
            if site != own {
                cell.keep_nearer(self.sites[own].0, *place);
            }
        }
        cell.0
    }

    /// The areas that a cell around `point` would take from the cells of the sites.
    fn stolen_areas(&self, point: Point) -> Vec<(usize, f64)> {
        // All places relative to the point, so that areas of small cells keep their digits.
        let sites: Vec<Point> = self.sites.iter().map(|(s, _)| *s - point).collect();
        let mut cell = Polygon(Vec::new());
        for world in WORLDS.map(|world| world * self.diameter) {
            cell = Polygon::square(world);
            for site in &sites {
                cell.keep_nearer(Point::default(), *site);
            }
            let inner = 0.99 * world;
            if cell.0.iter().all(|v| v.x.abs() < inner && v.y.abs() < inner) {
                break;
            }
        }
        // A neighbour shares an edge of the cell; one too many only has no area.
        let reaches = |site: Point| cell.0.iter().any(|v| v.distance(site) <= v.length() * (1.0 + 1e-6));
        let neighbors: Vec<usize> = (0..sites.len()).filter(|&i| reaches(sites[i])).collect();
        neighbors
            .iter()
            .map(|&i| {
                let mut part = cell.clone();
                for &j in neighbors.iter().filter(|&&j| j != i) {
                    part.keep_nearer(sites[i], sites[j]);
                }
                (i, part.area())
            })
            .collect()
    }
}

/// A convex polygon, anticlockwise.
#[derive(Clone, Debug)]
struct Polygon(Vec<Point>);

impl Polygon {
    fn square(reach: f64) -> Self {
        let corner = |x: f64, y: f64| Point { x: x * reach, y: y * reach };
        Self(vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)])
    }

    /// Cuts off everything that is nearer to `far` than to `near`.
    fn keep_nearer(&mut self, near: Point, far: Point) {
        let normal = far - near;
        let middle = (near + far) * 0.5;
        let beyond = |p: Point| (p - middle).dot(normal);
        let mut kept = Vec::with_capacity(self.0.len() + 1);
        for (i, &to) in self.0.iter().enumerate() {
            let from = self.0[(i + self.0.len() - 1) % self.0.len()];
            let (before, after) = (beyond(from), beyond(to));
            if (before > 0.0) != (after > 0.0) {
                kept.push(from.towards(to, before / (before - after)));
            }
            if after <= 0.0 {
                kept.push(to);
            }
        }
        self.0 = kept;
    }

    fn area(&self) -> f64 {
        let n = self.0.len();
        let Some(&origin) = self.0.first() else { return 0.0 };
        let twice: f64 = (1..n).map(|i| (self.0[i] - origin).cross(self.0[(i + 1) % n] - origin)).sum();
        (twice / 2.0).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    fn square() -> NaturalNeighbor {
        NaturalNeighbor::new(&[p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)])
    }

    #[test]
    fn the_middle_of_a_square_is_a_quarter_of_each() {
        let (weights, place) = square().weights(p(0.5, 0.5));
        assert!(weights.values().iter().all(|w| (w - 0.25).abs() < 1e-12), "{weights:?}");
        assert_eq!(place.distance, 0.0);
    }

    #[test]
    fn a_point_of_the_middle_line_by_hand() {
        // At (1/2, 1/4) by symmetry the two lower sites have a each, the upper two b each; the sites
        // average to the point, so 2b = 1/4.
        let (weights, _) = square().weights(p(0.5, 0.25));
        let expected = [0.375, 0.375, 0.125, 0.125];
        assert!(weights.values().iter().zip(expected).all(|(w, e)| (w - e).abs() < 1e-9), "{weights:?}");
    }

    #[test]
    fn an_edge_runs_between_its_ends_and_outside_is_the_nearest_place() {
        let natural = square();
        assert_eq!(natural.weights(p(0.25, 0.0)).0.values(), [0.75, 0.25, 0.0, 0.0]);
        let (weights, place) = natural.weights(p(0.25, -3.0));
        assert_eq!(weights.values(), [0.75, 0.25, 0.0, 0.0]);
        assert_eq!(place.distance, 3.0);
        assert_eq!(natural.weights(p(9.0, 9.0)).0.values(), [0.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn two_sites_have_a_line_between_them_and_twins_share() {
        let line = NaturalNeighbor::new(&[p(0.0, 0.0), p(4.0, 0.0), p(4.0, 0.0)]);
        assert_eq!(line.weights(p(1.0, 0.0)).0.values(), [0.75, 0.125, 0.125]);
        assert_eq!(line.weights(p(1.0, 2.0)).1.distance, 2.0);
    }

    /// The smallest distance of a site from the line through two others.
    fn smallest_gap(sites: &[Point]) -> f64 {
        let mut gap = f64::INFINITY;
        for (i, &a) in sites.iter().enumerate() {
            for &b in &sites[..i] {
                let along = b - a;
                let others = sites.iter().filter(|&&site| site != a && site != b);
                let nearest = others.map(|&site| along.cross(site - a).abs()).fold(f64::INFINITY, f64::min);
                gap = gap.min(nearest / along.length());
            }
        }
        gap
    }

    proptest! {
        #[test]
        fn weights_average_the_sites_to_the_point(
            raw in proptest::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64), 4..25),
            at in (0.0..1.0_f64, 0.0..1.0_f64),
        ) {
            let sites: Vec<Point> = raw.iter().map(|&(x, y)| p(x, y)).collect();
            let natural = NaturalNeighbor::new(&sites);
            // A point inside: between a point of one edge and the third corner.
            let point = sites[0].towards(sites[1], at.0).towards(sites[2], at.1);
            let (weights, place) = natural.weights(point);
            prop_assert_eq!(place.distance, 0.0);
            let sum: f64 = weights.values().iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-12);
            prop_assert!(weights.values().iter().all(|w| *w >= 0.0));
            let mean = weights.present().fold(Point::default(), |mean, (i, w)| mean + sites[i] * w);
            prop_assert!(mean.distance(point) < 1e-4, "{} off", mean.distance(point));
        }

        #[test]
        fn weights_are_continuous(
            raw in proptest::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64), 4..25),
            // On the line from site to site, which is often the hull's edge, or anywhere inside.
            at in (0.0..1.0_f64, prop_oneof![Just(0.0), 0.0..1.0_f64]),
        ) {
            let sites: Vec<Point> = raw.iter().map(|&(x, y)| p(x, y)).collect();
            let natural = NaturalNeighbor::new(&sites);
            // Weights change as fast as one over the distance of a site from the line through two others:
            // between two corners of the hull and a site just inside their edge they go from 0 to 1.
            let gap = smallest_gap(&sites);
            prop_assume!(gap > 1e-6);
            let point = sites[0].towards(sites[1], at.0).towards(sites[2], at.1);
            let one = natural.weights(point).0;
            let two = natural.weights(point + p(1.0, 1.0) * (1e-5 * gap)).0;
            let jump = one.values().iter().zip(two.values()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            prop_assert!(jump < 1e-3, "{jump}");
        }
    }
}
