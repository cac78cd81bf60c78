//! Where a point is along a stem.

use glam::DVec3;
use pleach_plant::Knot;

/// A place between two knots, on the straight line from the one to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Number of the knot before it.
    pub(crate) knot: usize,
    /// Part of the way to the next one, 0 to 1.
    pub(crate) part: f64,
    /// Metres from the first knot, along the straight lines.
    pub(crate) along: f64,
}

/// The place between `knots`, of which there are two at least, that is nearest to `point`.
pub(crate) fn nearest(knots: &[Knot], point: DVec3) -> Place {
    let mut place = Place { knot: 0, part: 0.0, along: 0.0 };
    let (mut along, mut least) = (0.0, f64::INFINITY);
    for (knot, pair) in knots.windows(2).enumerate() {
        let (from, way) = (pair[0].point, pair[1].point - pair[0].point);
        let part = ((point - from).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = (from + way * part).distance_squared(point);
        let length = way.length();
        if distance < least {
            (place, least) = (Place { knot, part, along: along + part * length }, distance);
        }
        along += length;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn it_is_on_the_nearest_of_the_lines() {
        let knot = |x: f64, z: f64| {
            let point = dvec3(x, 0.0, z);
            Knot { point, handle_in: point, handle_out: point, radius: 0.1 }
        };
        let knots = [knot(0.0, 0.0), knot(0.0, 2.0), knot(4.0, 2.0)];
        let at = |x, z| nearest(&knots, dvec3(x, 0.0, z));
        assert_eq!(at(-1.0, 0.5), Place { knot: 0, part: 0.25, along: 0.5 });
        assert_eq!(at(1.0, 3.0), Place { knot: 1, part: 0.25, along: 3.0 });
        assert_eq!(at(9.0, 9.0), Place { knot: 1, part: 1.0, along: 6.0 });
        assert_eq!(at(0.0, -1.0), Place { knot: 0, part: 0.0, along: 0.0 });
    }
}
