//! From a stem's axis to runs of rings, each of which one tube can go through.
//!
//! Two rings whose planes cross inside the stem cannot be joined: faces between them would be inside out. Where
//! leaving such a ring out would move the axis, and where the stem turns sharply at a knot, the tube ends in half a
//! ball and another begins at the same place: together they are what a ball that is moved along the axis covers.

use super::collar;
use super::frame::{perpendicular, transport};
use super::path::{Corner, Path, Ring};
use super::unroll::{self, unroll};
use glam::DVec3;
use pleach_plant::turtle::rotate;
use pleach_plant::{Stem, StemKind, Tree};

/// Rings are at least this far apart, in metres.
const MIN_STEP: f64 = 1e-4;
/// Leaving out a ring may move the axis by this part of its radius, or by the tolerance if that is more.
const SLACK: f64 = 0.1;
/// Where the axis is that far off, no more rings than this are left out in a row: the way back over
/// all of them is looked at again for each.
const MAX_LEFT_OUT: usize = 64;
/// A turn that never comes back to where it was, in radians.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// How a tube ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// In a point; the last ring is that point.
    Point,
    /// In a low dome: the blunt tip of a stem.
    Dome,
    /// In half a ball, where the stem goes on in another direction.
    Ball,
}

/// Rings that one tube goes through.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run<'a> {
    /// From base to end, at least two; each can be joined to the next.
    pub(crate) rings: &'a [Ring],
    pub(crate) end: End,
}

/// The rings of one stem, in memory that is used again for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rings {
    path: Path,
    /// All runs, one after the other; `None` if the stem is too short to be drawn.
    rings: Vec<Ring>,
    /// The end of each run in `rings`.
    ends: Vec<usize>,
    /// Places in the path of the rings of the run that grows.
    places: Vec<usize>,
    /// Radius of the widest ring without a collar, in metres.
    widest: f64,
    tiles_around: u32,
}

impl Rings {
    /// Samples `stem` so that neither its axis nor its outer side strays by more than `tolerance` metres, or
    /// the axis by a tenth of its radius where the stem turns in less room than its own width.
    pub(crate) fn sample(&mut self, tree: &Tree, stem: &Stem, tolerance: f64) {
        self.path.trace(tree, stem, tolerance);
        unroll(&mut self.path.rings);
        self.widest = unroll::widest(&self.path.rings);
        self.tiles_around = unroll::around(self.widest);
        collar::widen(tree, stem, tolerance, &mut self.path.rings, &mut self.path.corners);
        let last = self.path.rings.len() - 1;
        if self.path.is_pointed {
            self.path.rings[last].radius = 0.0;
        }
        self.rings.clear();
        self.ends.clear();
        let mut from = 0;
        let mut leaves = self.path.rings[0].tangent;
        for i in 0..self.path.corners.len() {
            let corner: Corner = self.path.corners[i];
            self.stretch(from, corner.ring, leaves, corner.arrives, tolerance);
            (from, leaves) = (corner.ring, corner.leaves);
        }
        self.stretch(from, last, leaves, self.path.rings[last].tangent, tolerance);
        // The clones of a fork leave from one ring; turned against each other, their caps are not one
        // face twice.
        let clone = stem.kind == StemKind::Fork;
        self.turn_frames(if clone { f64::from(stem.first_knot % 1024) * GOLDEN_ANGLE } else { 0.0 });
    }

    /// The runs of the stem, from its base to its tip.
    pub(crate) fn runs(&self) -> impl Iterator<Item = Run<'_>> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(first, &end)| {
            let rings = &self.rings[first..end];
            let is_tip = end == self.rings.len();
            let end = match rings.last() {
                Some(ring) if ring.radius <= 0.0 => End::Point,
                _ if is_tip => End::Dome,
                _ => End::Ball,
            };
            Run { rings, end }
        })
    }

    /// The widest ring's radius in metres; what a collar adds is left out.
    pub(crate) const fn widest(&self) -> f64 {
        self.widest
    }

    /// How many texture tiles go around the stem.
    pub(crate) const fn tiles_around(&self) -> u32 {
        self.tiles_around
    }

    /// Texture tiles from the base to `along` metres from it.
    pub(crate) fn tiles_at(&self, along: f64) -> f64 {
        unroll::tiles_at(&self.path.rings, along)
    }

    /// Appends runs through rings `first` to `last` of the path, whose tangents there are `leaves` and `arrives`.
    fn stretch(&mut self, first: usize, last: usize, leaves: DVec3, arrives: DVec3, tolerance: f64) {
        let ring = |path: &Path, i: usize| match i {
            i if i == last => Ring { tangent: arrives, ..path.rings[i] },
            i => path.rings[i],
        };
        self.begin(Ring { tangent: leaves, ..self.path.rings[first] }, first);
        let mut at = first;
        while at < last {
            let Some(&before) = self.rings.last() else { return };
            let reach = Reach::new(&self.path, tolerance);
            // The first ring that can be joined, and else the farthest to which a straight line may go.
            let (mut next, mut straight) = (None, None);
            for to in at + 1..=last {
                if !reach.may_skip(at, to) {
                    break;
                }
                if apart(&before, &ring(&self.path, to)) {
                    next = Some(to);
                    break;
                }
                if before.center.distance(self.path.rings[to].center) > MIN_STEP {
                    straight = Some(to);
                }
            }
            match (next, straight) {
                (Some(to), _) => {
                    self.rings.push(ring(&self.path, to));
                    self.places.push(to);
                    at = to;
                }
                // What is left stands still.
                (None, None) if reach.may_skip(at, last) => break,
                (None, None) => at += 1,
                (None, Some(to)) => {
                    let end = ring(&self.path, to);
                    if to < last || !self.join_back(end, to, tolerance) {
                        self.straight(end, to, arrives, last);
                    }
                    at = to;
                }
            }
        }
        self.close();
    }

    /// Begins a run at a ring.
    fn begin(&mut self, ring: Ring, place: usize) {
        self.rings.push(ring);
        self.places.clear();
        self.places.push(place);
    }

    /// Ends the run that grows, which is nothing if it has but one ring.
    fn close(&mut self) {
        let first = self.ends.last().copied().unwrap_or(0);
        if self.rings.len() > first + 1 {
            self.ends.push(self.rings.len());
        } else {
            self.rings.truncate(first);
        }
    }

    /// Joins `end`, ring `to` of the path, to an earlier ring of the run, if one can be found.
    fn join_back(&mut self, end: Ring, to: usize, tolerance: f64) -> bool {
        let first = self.ends.last().copied().unwrap_or(0);
        let reach = Reach::new(&self.path, tolerance);
        for (i, &place) in self.places.iter().enumerate().rev() {
            if !reach.may_skip(place, to) {
                return false;
            }
            if apart(&self.rings[first + i], &end) {
                self.rings.truncate(first + i + 1);
                self.rings.push(end);
                self.places.truncate(i + 1);
                self.places.push(to);
                return true;
            }
        }
        false
    }

    /// Ends the run that grows and appends a straight one to `end`, ring `to` of the path, where another
    /// begins.
    fn straight(&mut self, end: Ring, to: usize, arrives: DVec3, last: usize) {
        let Some(&from) = self.rings.last() else { return };
        self.close();
        let line = (end.center - from.center).normalize_or(end.tangent);
        self.begin(Ring { tangent: line, ..from }, to);
        self.rings.push(Ring { tangent: line, ..end });
        self.close();
        let tangent = if to == last { arrives } else { end.tangent };
        self.begin(Ring { tangent, ..end }, to);
    }

    /// Sets the sides of all rings, the first one's turned by `angle` radians.
    fn turn_frames(&mut self, angle: f64) {
        let Some(first) = self.rings.first_mut() else { return };
        first.side = rotate(perpendicular(first.tangent), first.tangent, angle);
        let mut last = *first;
        for ring in &mut self.rings[1..] {
            ring.side = transport(last.side, last.center, last.tangent, ring.center, ring.tangent);
            // A stem that goes back the way that it came would have its faces twice.
            if last.tangent.dot(ring.tangent) < -0.9 {
                ring.side = rotate(ring.side, ring.tangent, GOLDEN_ANGLE);
            }
            last = *ring;
        }
    }
}

/// What may be left out of a path.
struct Reach<'a> {
    path: &'a [Ring],
    tolerance: f64,
}

impl<'a> Reach<'a> {
    fn new(path: &'a Path, tolerance: f64) -> Self {
        Self { path: &path.rings, tolerance: tolerance.max(MIN_STEP) }
    }

    /// Whether a straight line from ring `from` to ring `to` passes near enough to the rings between them.
    fn may_skip(&self, from: usize, to: usize) -> bool {
        let between = &self.path[from + 1..to];
        let (a, b) = (self.path[from].center, self.path[to].center);
        let slack = |ring: &Ring| self.tolerance.max(SLACK * ring.radius);
        // The way there is as far as it can be.
        if between.last().is_none_or(|end| end.along - self.path[from].along <= self.tolerance) {
            return true;
        }
        between.len() <= MAX_LEFT_OUT
            && between.iter().all(|ring| distance_to_line(ring.center, a, b) <= slack(ring))
    }
}

/// Metres from `p` to the line from `a` to `b`.
fn distance_to_line(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let line = b - a;
    let t = ((p - a).dot(line) / line.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + line * t)
}

impl Run<'_> {
    /// Change of radius per metre at ring `i`, from its neighbours.
    pub(crate) fn slope(&self, i: usize) -> f64 {
        let (a, b) = (&self.rings[i.saturating_sub(1)], &self.rings[(i + 1).min(self.rings.len() - 1)]);
        (b.radius - a.radius) / (b.along - a.along).max(MIN_STEP)
    }
}

/// Whether the tube between two rings has all its faces outside.
///
/// A face turns inside out when a vertex of one ring comes to lie behind the plane of the other. A
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
