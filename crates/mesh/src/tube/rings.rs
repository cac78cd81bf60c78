//! Cross sections along a stem's spline.

use super::frame::{perpendicular, transport};
use glam::DVec3;
use pleach_tree::turtle::rotate;
use pleach_tree::{Stem, StemKind, Tree};

/// No ring is narrower, in metres: beads of periodic taper meet in points, and single precision
/// thirty metres from the origin ends at two micrometres.
const MIN_RADIUS: f64 = 2e-4;
/// A stem whose tip is thinner than this many metres ends in a point.
const POINTED: f64 = 5e-4;
/// Rings are at least this far apart, in metres.
const MIN_STEP: f64 = 1e-4;

/// A turn that never comes back to where it was, in radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

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
}

/// The rings of one stem, in memory that is used again for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rings {
    /// From base to tip; at least two unless the stem is too short to be drawn.
    pub(crate) rings: Vec<Ring>,
    /// Whether the last ring stands for a point.
    pub(crate) pointed: bool,
}

impl Rings {
    /// Samples `stem` so that neither its axis nor its outer side strays by more than `tolerance`, with
    /// rings that a tube can go through.
    pub(crate) fn sample(&mut self, tree: &Tree, stem: &Stem, tolerance: f64) {
        self.trace(tree, stem, tolerance);
        self.untangle();
        // The clones of a fork leave from one ring; turned against each other, their caps are not one
        // face twice.
        let clone = stem.kind == StemKind::Fork;
        self.turn_frames(if clone { f64::from(stem.first_knot % 1024) * GOLDEN_ANGLE } else { 0.0 });
    }

    /// Samples all of `stem`, sharp turns and places where it stands still among it; sides are not set.
    pub(crate) fn trace(&mut self, tree: &Tree, stem: &Stem, tolerance: f64) {
        self.rings.clear();
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
            let first = legs[0];
            for i in u32::from(k > 0)..=chords {
                let t = f64::from(i) / f64::from(chords);
                let center = piece.at(t);
                let mut tangent = match i {
                    0 => first,
                    i if i == chords => legs[2],
                    _ => piece.tangent(t, chord),
                };
                // The ring at a knot lies between what arrives and what leaves.
                if i == chords && k + 1 < pieces {
                    let (here, next) = (&knots[k + 1], &knots[k + 2]);
                    let leaves = (here.handle_out - here.point)
                        .try_normalize()
                        .or_else(|| (next.point - here.point).try_normalize());
                    tangent = (tangent + leaves.unwrap_or(tangent)).try_normalize().unwrap_or(tangent);
                }
                if let Some(last) = self.rings.last() {
                    along += center.distance(last.center);
                }
                let radius = (from + (to - from) * t).max(MIN_RADIUS);
                self.rings.push(Ring { center, tangent, side: DVec3::X, radius, along });
            }
            arrival = Some(legs[2]);
        }
        self.pointed = knots[knots.len() - 1].radius < POINTED;
    }

    /// Leaves out rings that would cut a neighbour, so that no face turns inside out.
    fn untangle(&mut self) {
        let rings = &mut self.rings;
        let last = rings.len() - 1;
        let mut kept = 1;
        for i in 1..last {
            if apart(&rings[kept - 1], &rings[i]) {
                rings[kept] = rings[i];
                kept += 1;
            }
        }
        let mut tip = rings[last];
        if self.pointed {
            tip.radius = 0.0;
        }
        while kept > 1 && !apart(&rings[kept - 1], &tip) {
            kept -= 1;
        }
        if !apart(&rings[kept - 1], &tip) {
            // A prism: both rings at right angles to the line between them.
            let line = tip.center - rings[0].center;
            if line.length() < MIN_STEP {
                rings.clear();
                return;
            }
            let line = line.normalize();
            (rings[0].tangent, tip.tangent) = (line, line);
            kept = 1;
        }
        rings[kept] = tip;
        rings.truncate(kept + 1);
    }

    /// Sets the sides of all rings, the first one's turned by `angle` radians.
    fn turn_frames(&mut self, angle: f64) {
        let Some(first) = self.rings.first_mut() else { return };
        first.side = rotate(perpendicular(first.tangent), first.tangent, angle);
        for i in 1..self.rings.len() {
            let last = self.rings[i - 1];
            let ring = &mut self.rings[i];
            ring.side = transport(last.side, last.center, last.tangent, ring.center, ring.tangent);
        }
    }

    /// Change of radius per metre at ring `i`, from its neighbours.
    pub(crate) fn slope(&self, i: usize) -> f64 {
        let (a, b) = (&self.rings[i.saturating_sub(1)], &self.rings[(i + 1).min(self.rings.len() - 1)]);
        (b.radius - a.radius) / (b.along - a.along).max(MIN_STEP)
    }
}

/// Whether the tube between two rings has all its faces outside.
///
/// A face turns inside out when a corner of one ring comes to lie behind the plane of the other. A
/// corner strays from its ring's centre along the other's tangent by at most its radius times the
/// sine of the angle between the planes.
fn apart(a: &Ring, b: &Ring) -> bool {
    /// Polygons reach a little further out than circles, triangles the furthest.
    const REACH: f64 = 1.25;
    let line = b.center - a.center;
    let cos = a.tangent.dot(b.tangent);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let clear = |tangent: DVec3, radius: f64| line.dot(tangent) > REACH * radius * sin + MIN_STEP;
    cos > 0.0 && clear(a.tangent, b.radius) && clear(b.tangent, a.radius)
}
