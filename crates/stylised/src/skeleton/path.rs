//! A chain's curve by its length.

use glam::DVec3;
use pleach_tree::Knot;
use pleach_tree::piece;

/// Chords of a piece between two knots.
const CHORDS: u32 = 8;

/// The spline through knots, walked along in chords.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path<'a> {
    knots: &'a [Knot],
}

/// A place on a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) point: DVec3,
    pub(crate) radius: f64,
}

impl<'a> Path<'a> {
    /// The path through `knots`, at least one.
    pub(crate) const fn new(knots: &'a [Knot]) -> Self {
        Self { knots }
    }

    /// Its whole length.
    pub(crate) fn length(&self) -> f64 {
        self.length_to(self.knots.len() - 1)
    }

    /// The length up to knot number `knot`.
    pub(crate) fn length_to(&self, knot: usize) -> f64 {
        self.knots[..=knot].windows(2).map(|w| piece(&w[0], &w[1]).length(CHORDS)).sum()
    }

    /// The place so far along; the ends' where that is off the path.
    pub(crate) fn at(&self, along: f64) -> Place {
        let mut rest = along.max(0.0);
        let mut last = Place { point: self.knots[0].point, radius: self.knots[0].radius };
        for pair in self.knots.windows(2) {
            let curve = piece(&pair[0], &pair[1]);
            for i in 1..=CHORDS {
                let t = f64::from(i) / f64::from(CHORDS);
                let next = Place {
                    point: curve.at(t),
                    radius: pair[0].radius + (pair[1].radius - pair[0].radius) * t,
                };
                let chord = last.point.distance(next.point);
                if chord > rest {
                    let part = rest / chord;
                    return Place {
                        point: last.point.lerp(next.point, part),
                        radius: last.radius + (next.radius - last.radius) * part,
                    };
                }
                rest -= chord;
                last = next;
            }
        }
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn places_are_found_by_length() {
        let knot = |z: f64, radius: f64| {
            let point = dvec3(0.0, 0.0, z);
            Knot { point, handle_in: point - DVec3::Z / 3.0, handle_out: point + DVec3::Z / 3.0, radius }
        };
        let knots = [knot(0.0, 2.0), knot(1.0, 1.0), knot(2.0, 0.0)];
        let path = Path::new(&knots);
        assert!((path.length() - 2.0).abs() < 1e-12 && (path.length_to(1) - 1.0).abs() < 1e-12);
        for along in [0.0, 0.3, 1.0, 1.9] {
            let place = path.at(along);
            assert!((place.point.z - along).abs() < 1e-12 && (place.radius - (2.0 - along)).abs() < 1e-12);
        }
        assert_eq!((path.at(-1.0).point.z, path.at(9.0).point.z), (0.0, 2.0));
    }
}
