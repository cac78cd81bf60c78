//! A stem's axis as points that stand close enough, and where it turns sharply.

use glam::DVec3;
use pleach_plant::{Stem, Tree};

/// No ring is narrower, in metres: beads of periodic taper meet in points, and single precision
/// thirty metres from the origin ends at two micrometres.
const MIN_RADIUS: f64 = 2e-4;
/// A stem whose tip is thinner than this many metres ends in a point.
const POINTED: f64 = 5e-4;
/// Where a stem turns by 45 degrees or more at a knot, one ring cannot lie across both ways: it would be
/// thinner than the stem by more than 1 − cos 22.5° = 7.6 %. Cosine of that turn.
const SHARP: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// One cross section of a stem.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    /// On the spline, in metres.
    pub(crate) center: DVec3,
    /// Unit vector along the stem, at right angles to the ring.
    pub(crate) tangent: DVec3,
    /// Unit vector in the ring, towards its first corner.
    pub(crate) side: DVec3,
    /// In metres, after the model.
    pub(crate) radius: f64,
    /// Metres along the stem from its first knot.
    pub(crate) along: f64,
    /// Texture tiles along the stem from its first knot.
    pub(crate) tiles: f64,
}

/// A knot at which a stem turns sharply.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Number of its ring.
    pub(super) ring: usize,
    /// Unit vectors along the stem before and after it.
    pub(super) arrives: DVec3,
    pub(super) leaves: DVec3,
}

/// Cross sections of one stem, in memory that is used again for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Path {
    /// From base to tip, at least two; their sides are not set.
    pub(crate) rings: Vec<Ring>,
    /// In the order of their rings.
    pub(super) corners: Vec<Corner>,
    /// Whether the tip is so thin that it is a point.
    pub(super) is_pointed: bool,
}

impl Path {
    /// Samples all of `stem`, places where it stands still among it, so that neither its axis nor its outer
    /// side strays by more than `tolerance` metres. The ring at a knot lies between what arrives and what leaves.
    pub(crate) fn trace(&mut self, tree: &Tree, stem: &Stem, tolerance: f64) {
        self.rings.clear();
        self.corners.clear();
        let mut along = 0.0;
        let mut arrival: Option<DVec3> = None;
        let knots = tree.knots_of(stem);
        let pieces = knots.len() - 1;
        for (k, (piece, from, to)) in tree.pieces_of(stem).enumerate() {
            let [a, b, c, d] = piece.points;
            let chord = (d - a).try_normalize().or(arrival).unwrap_or(DVec3::Z);
            // How far the control polygon turns, in radians, from above for the angles of trees.
            let legs = [b - a, c - b, d - c].map(|leg| leg.try_normalize().unwrap_or(chord));
            let turn = legs[0].distance(legs[1]) + legs[1].distance(legs[2]);
            let outer = (turn * (from.max(to) / (8.0 * tolerance)).sqrt()).ceil();
            let chords = piece.chords(tolerance).max(outer.min(64.0) as u32);
            for i in u32::from(k > 0)..=chords {
                let t = f64::from(i) / f64::from(chords);
                let center = piece.at(t);
                let mut tangent = match i {
                    0 => legs[0],
                    i if i == chords => legs[2],
                    _ => piece.tangent(t, chord),
                };
                if i == chords && k + 1 < pieces {
                    let (here, next) = (&knots[k + 1], &knots[k + 2]);
                    let leaves = (here.handle_out - here.point)
                        .try_normalize()
                        .or_else(|| (next.point - here.point).try_normalize())
                        .unwrap_or(tangent);
                    if tangent.dot(leaves) < SHARP {
                        self.corners.push(Corner { ring: self.rings.len(), arrives: tangent, leaves });
                    }
                    tangent = (tangent + leaves).try_normalize().unwrap_or(tangent);
                }
                if let Some(last) = self.rings.last() {
                    along += center.distance(last.center);
                }
                let radius = (from + (to - from) * t).max(MIN_RADIUS);
                self.rings.push(Ring { center, tangent, side: DVec3::X, radius, along, tiles: 0.0 });
            }
            arrival = Some(legs[2]);
        }
        self.is_pointed = knots[knots.len() - 1].radius < POINTED;
    }
}
