//! Points of the plane, and the convex hull of some.

use pleach_tree::math;

/// A point of the map, in units of the features: two species that differ by the whole search range of
/// one parameter are about 1 apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Along the first axis.
    pub x: f64,
    /// Along the second axis.
    pub y: f64,
}

impl Point {
    /// Whether both coordinates are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }

    /// Distance to `other`.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// The point `part` of the way to `other`: itself at 0, `other` at 1.
    #[must_use]
    pub fn towards(self, other: Self, part: f64) -> Self {
        // Written so that both ends are exact.
        Self { x: (1.0 - part) * self.x + part * other.x, y: (1.0 - part) * self.y + part * other.y }
    }

    pub(crate) fn length(self) -> f64 {
        math::hypot(self.x, self.y)
    }

    pub(crate) fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Twice the signed area of the triangle of the origin and the two points.
    pub(crate) fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }
}

impl std::ops::Add for Point {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl std::ops::Sub for Point {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl std::ops::Mul<f64> for Point {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

/// The nearest place of a hull to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnHull {
    /// The place itself.
    pub point: Point,
    /// How far away it is: 0 for points inside.
    pub distance: f64,
    /// The two given points between which it lies, and how far from the first to the second. Points
    /// inside lie on no edge.
    pub edge: Option<(usize, usize, f64)>,
}

/// The convex hull of some points: a polygon, or a line where they all lie on one.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// The corners in anticlockwise order, and points on the edges between them; numbers of the given
    /// points. Coincident points are represented by the first.
    ring: Vec<usize>,
    points: Vec<Point>,
    flat: bool,
}

/// Relative size below which areas and distances are rounding errors.
const TINY: f64 = 1e-9;

impl Hull {
    /// The hull of `points`, at least one.
    ///
    /// Andrew's monotone chain (1979), keeping points that lie on an edge.
    #[must_use]
    pub fn new(points: &[Point]) -> Self {
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|&a, &b| {
            let (p, q) = (points[a], points[b]);
            p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(a.cmp(&b))
        });
        order.dedup_by(|later, first| points[*later] == points[*first]);
        let size = order.iter().map(|&i| points[i].distance(points[order[0]])).fold(0.0, f64::max);
        let tiny = TINY * size * size;
        let right_turn =
            |a: usize, b: usize, c: usize| (points[b] - points[a]).cross(points[c] - points[a]) < -tiny;
        let chain = |order: &mut dyn Iterator<Item = usize>| {
            let mut chain: Vec<usize> = Vec::new();
            for next in order {
                while chain.len() > 1 && right_turn(chain[chain.len() - 2], chain[chain.len() - 1], next) {
                    chain.pop();
                }
                chain.push(next);
            }
            chain
        };
        let lower = chain(&mut order.iter().copied());
        let upper = chain(&mut order.iter().rev().copied());
        // On a line both chains hold every point.
        let flat = lower.len() == order.len() && upper.len() == order.len() && {
            let (a, b) = (order[0], order[order.len() - 1]);
            order.iter().all(|&i| (points[b] - points[a]).cross(points[i] - points[a]).abs() <= tiny)
        };
        let mut ring = lower;
        if !flat {
            ring.extend(&upper[1..upper.len() - 1]);
        }
        Self { ring, points: points.to_vec(), flat }
    }

    /// The numbers of the points on the hull, anticlockwise; from end to end where all lie on a line.
    #[must_use]
    pub fn ring(&self) -> &[usize] {
        &self.ring
    }

    /// Whether all points lie on a line, so that there is no inside.
    #[must_use]
    pub const fn is_flat(&self) -> bool {
        self.flat
    }

    /// The corners of the ring as points.
    #[must_use]
    pub fn corners(&self) -> Vec<Point> {
        self.ring.iter().map(|&i| self.points[i]).collect()
    }

    fn edges(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let closing = if self.flat { 1 } else { 0 };
        let n = self.ring.len();
        (0..n - closing.min(n)).map(move |i| (self.ring[i], self.ring[(i + 1) % n]))
    }

    /// Whether `point` is inside or on the edge.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        self.nearest(point).distance == 0.0
    }

    /// The nearest place of the hull.
    #[must_use]
    pub fn nearest(&self, point: Point) -> OnHull {
        let inside = !self.flat
            && self
                .edges()
                .all(|(a, b)| (self.points[b] - self.points[a]).cross(point - self.points[a]) > 0.0);
        if inside {
            return OnHull { point, distance: 0.0, edge: None };
        }
        let mut best: Option<OnHull> = None;
        for (a, b) in self.edges() {
            let (from, along) = (self.points[a], self.points[b] - self.points[a]);
            let part = ((point - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
            let place = from.towards(self.points[b], part);
            let distance = place.distance(point);
            if best.is_none_or(|best| distance < best.distance) {
                best = Some(OnHull { point: place, distance, edge: Some((a, b, part)) });
            }
        }
        let only = self.ring[0];
        let mut best = best.unwrap_or_else(|| {
            let place = self.points[only];
            OnHull { point: place, distance: place.distance(point), edge: Some((only, only, 0.0)) }
        });
        // A point that was put on an edge is on it, whatever the last bits say.
        let size = self.points.iter().map(|p| p.distance(self.points[only])).fold(0.0, f64::max);
        if best.distance <= TINY * size {
            best.distance = 0.0;
        }
        best
    }
}

/// A number as people write it: no row of zeros however large or small it is.
#[must_use]
pub fn readable(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-6..1e9).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    #[test]
    fn huge_numbers_are_short() {
        assert_eq!([2.0, -0.25, 1e300, -2.5e-40].map(readable), ["2", "-0.25", "1e300", "-2.5e-40"]);
        assert_eq!(readable(f64::NAN), "NaN");
    }

    #[test]
    fn a_square_with_a_point_inside_and_one_on_an_edge() {
        let hull = Hull::new(&[p(0.0, 0.0), p(1.0, 1.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0), p(1.0, 0.0)]);
        assert_eq!(hull.ring(), [0, 5, 2, 3, 4]);
        assert!(hull.contains(p(1.5, 0.5)) && hull.contains(p(2.0, 1.0)) && !hull.contains(p(2.1, 1.0)));
        let near = hull.nearest(p(5.0, 0.5));
        assert_eq!((near.point, near.distance, near.edge), (p(2.0, 0.5), 3.0, Some((2, 3, 0.25))));
    }

    #[test]
    fn points_on_a_line_have_no_inside() {
        let hull = Hull::new(&[p(0.0, 0.0), p(2.0, 2.0), p(1.0, 1.0)]);
        assert!(hull.is_flat());
        assert_eq!(hull.ring(), [0, 2, 1]);
        assert_eq!(hull.nearest(p(0.5, 0.5)).distance, 0.0);
        assert_eq!(hull.nearest(p(2.0, 1.0)).edge.map(|e| (e.0, e.1)), Some((2, 1)));
        assert!(Hull::new(&[p(1.0, 1.0), p(1.0, 1.0)]).is_flat());
    }

    proptest! {
        #[test]
        fn every_point_is_in_its_own_hull(raw in proptest::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64), 3..20)) {
            let points: Vec<Point> = raw.into_iter().map(|(x, y)| p(x, y)).collect();
            let hull = Hull::new(&points);
            for &point in &points {
                prop_assert!(hull.contains(point));
                prop_assert!(hull.contains(point.towards(points[0], 0.5)));
            }
        }
    }
}
