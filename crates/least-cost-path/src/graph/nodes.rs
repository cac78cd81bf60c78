//! Nodes: darts thrown into a volume, none too near to another.

use super::cells::Cells;
use super::meter::{Meter, OutOfSteps};
use crate::purpose::{AXIS, DART};
use crate::volume::Volume;
use glam::DVec3;
use pleach_tree::Key;
use pleach_tree::math;
use pleach_tree::trig::sin_cos;
use std::f64::consts::TAU;

/// Darts thrown for each node wanted, at most.
const MAX_THROWS: usize = 50;
/// Fewer nodes than this are compared one by one.
const FEW: usize = 200;
/// Nodes and parts of the volume that a dart may be compared with before that counts as work. Where the
/// volume is about as large as the box around it, 27 cells hold no more.
const FREE_LOOKS: usize = 64;
/// Comparisons beyond those that count as one step.
const LOOKS_PER_STEP: usize = 8;
/// A dart that misses takes one step, and one more for each of these nodes: large grids do not fit in the
/// processor's cache.
const NODES_PER_STEP: usize = 400_000;
/// Steps that are counted before they are taken from the meter.
const AT_A_TIME: usize = 4096;
/// The part of nodes that lie along an axis.
pub(crate) const ON_AXIS: u16 = u16::MAX;

/// The nodes of a graph. Number 0 is its root.
#[derive(Debug, Default)]
pub(crate) struct Nodes {
    pub(crate) points: Vec<DVec3>,
    /// The part of the volume that each was thrown into.
    pub(crate) parts: Vec<u16>,
    /// The cluster that each belongs to, from 1; 0 is linked to all.
    pub(crate) clusters: Vec<u16>,
    /// Pairs of neighbors along an axis.
    pub(crate) chain: Vec<(u32, u32)>,
    pub(super) heads: Vec<u32>,
    pub(super) next: Vec<u32>,
}

/// What became of the darts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Thrown {
    /// Darts that were thrown.
    pub(crate) throws: usize,
    /// Mean spacing of the nodes wanted, in meters: the cube root of the content for each.
    pub(crate) mean_spacing: f64,
}

impl Nodes {
    /// Throws until there are `count` nodes, the root among them, `spacing` times their mean spacing
    /// apart; fewer where they do not fit. A dart that misses takes a step of `meter`, and so do many
    /// comparisons.
    pub(crate) fn throw(
        &mut self,
        volume: &Volume,
        root: DVec3,
        (count, spacing): (usize, f64),
        key: Key,
        meter: &Meter,
    ) -> Result<Thrown, OutOfSteps> {
        self.points.clear();
        self.parts.clear();
        self.chain.clear();
        let mean_spacing = math::cbrt(volume.content / count as f64);
        if !(mean_spacing > 0.0 && mean_spacing.is_finite()) {
            self.put(root, ON_AXIS);
            self.sort_into_clusters(volume, mean_spacing);
            return Ok(Thrown { throws: 0, mean_spacing: 0.0 });
        }
        self.put(root, ON_AXIS);
        self.line_axes(volume, count, mean_spacing, key);
        let least = spacing * mean_spacing;
        let few = count < FEW;
        let (low, high) = volume.bounds();
        let cells = if few {
            Cells::default()
        } else {
            Cells::new(low, high, least.max(0.3 * mean_spacing), 8 * count)
        };
        if !few {
            self.heads.clear();
            self.heads.resize(cells.len(), u32::MAX);
            self.next.clear();
            for i in 0..self.points.len() {
                self.file(&cells, i);
            }
        }
        let darts = key.child(DART, 0);
        let (mut throws, mut spent) = (0, Spent::default());
        let miss = 1 + count / NODES_PER_STEP;
        while self.points.len() < count && throws < MAX_THROWS * count {
            if spent.due() >= AT_A_TIME {
                spent.pay(meter)?;
            }
            let dart = darts.child(0, throws as u32);
            throws += 1;
            let mut looks = volume.parts.len();
            let u = [dart.unit(0, 0), dart.unit(0, 1), dart.unit(0, 2)];
            let pick = if volume.parts.len() > 1 { dart.unit(0, 3) } else { 0.0 };
            let Some((p, part)) = volume.dart(pick, u) else {
                spent.misses += miss;
                spent.crowding += steps_of(looks);
                continue;
            };
            let near = |i: usize| self.points[i].distance_squared(p) < least * least;
            let is_crowded = if few {
                (0..self.points.len()).any(near)
            } else {
                cells.rows(cells.at(p), 1).any(|(first, last)| {
                    (first..=last).any(|cell| {
                        let mut i = self.heads[cell];
                        while i != u32::MAX && !near(i as usize) {
                            i = self.next[i as usize];
                            looks += 1;
                        }
                        i != u32::MAX
                    })
                })
            };
            spent.crowding += steps_of(looks);
            if is_crowded {
                spent.misses += miss;
            } else {
                self.put(p, part as u16);
                if !few {
                    self.file(&cells, self.points.len() - 1);
                }
            }
        }
        spent.pay(meter)?;
        self.sort_into_clusters(volume, mean_spacing);
        Ok(Thrown { throws, mean_spacing })
    }

    fn put(&mut self, p: DVec3, part: u16) {
        self.points.push(p);
        self.parts.push(part);
    }

    /// Files node `i` under its cell. Cells are at least as wide as nodes are apart.
    fn file(&mut self, cells: &Cells, i: usize) {
        let cell = cells.number(cells.at(self.points[i]));
        self.next.push(self.heads[cell]);
        self.heads[cell] = i as u32;
    }

    /// Nodes along the axes, near enough to each other that no axis is cut.
    fn line_axes(&mut self, volume: &Volume, count: usize, mean_spacing: f64, key: Key) {
        let whole: f64 = volume.axes.iter().map(|axis| axis.from.distance(axis.to)).sum();
        let step = (0.8 * mean_spacing).max(whole / (count as f64 / 2.0));
        for (number, axis) in volume.axes.iter().enumerate() {
            let key = key.child(AXIS, number as u32);
            let along = axis.to - axis.from;
            let steps = (along.length() / step).ceil() as u32;
            let nearest = (0..self.points.len()).min_by(|&a, &b| {
                let far = |i: usize| self.points[i].distance_squared(axis.from);
                far(a).total_cmp(&far(b))
            });
            let mut last = nearest.unwrap_or(0) as u32;
            let (x, y) = along.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
            let wander = axis.wander.min(0.5 * mean_spacing);
            for i in 1..=steps {
                let (sin, cos) = sin_cos(TAU * key.unit(0, i));
                let off = (x * cos + y * sin) * (wander * key.unit(1, i).sqrt());
                let p = axis.from + along * (f64::from(i) / f64::from(steps)) + off;
                self.put(p, ON_AXIS);
                let this = (self.points.len() - 1) as u32;
                self.chain.push((last, this));
                last = this;
            }
        }
        self.chain.sort_unstable();
    }

    /// Each node belongs to the cluster whose stretch is nearest; what is near the foot of all of them
    /// to none.
    fn sort_into_clusters(&mut self, volume: &Volume, mean_spacing: f64) {
        self.clusters.clear();
        let clusters = &volume.clusters;
        let cluster = |&p: &DVec3| {
            let away = |&(from, to): &(DVec3, DVec3)| {
                let along = to - from;
                let t = ((p - from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                (p - from - along * t).length_squared()
            };
            let nearest = clusters.iter().enumerate().min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
            nearest.map_or(0, |(number, (from, _))| {
                let is_trunk = p.z <= from.z || p.distance(*from) < 2.0 * mean_spacing;
                if is_trunk { 0 } else { number as u16 + 1 }
            })
        };
        self.clusters.extend(self.points.iter().map(cluster));
    }
}

/// Steps that darts took.
#[derive(Debug, Default)]
struct Spent {
    misses: usize,
    crowding: usize,
    paid: usize,
}

impl Spent {
    const fn due(&self) -> usize {
        self.misses + self.crowding - self.paid
    }

    /// Takes from `meter` what was not yet taken.
    fn pay(&mut self, meter: &Meter) -> Result<(), OutOfSteps> {
        let due = self.due();
        self.paid += due;
        match meter.take(due as u64) {
            true => Ok(()),
            false if self.crowding > self.misses => Err(OutOfSteps::Crowding),
            false => Err(OutOfSteps::Misses),
        }
    }
}

/// Steps that `looks` are, those left out that every dart has.
const fn steps_of(looks: usize) -> usize {
    looks.saturating_sub(FREE_LOOKS) / LOOKS_PER_STEP
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::volume::{Part, Side, Solid};
    use glam::dvec3;

    /// Enough for all that is thrown here.
    const MANY: u64 = 1_000_000;

    fn ball(radius: f64, cos: f64) -> Volume {
        Volume::from_part(Part::new(Solid::Portion { radius, cos }, DVec3::ZERO, DVec3::Z, true), Side::Above)
    }

    fn throw(nodes: &mut Nodes, volume: &Volume, count: usize, spacing: f64, seed: u64) -> Thrown {
        let meter = Meter::new(MANY);
        nodes.throw(volume, DVec3::ZERO, (count, spacing), Key::root(seed), &meter).unwrap()
    }

    #[test]
    fn darts_stop_when_their_steps_are_used_up() {
        let mut nodes = Nodes::default();
        for (limit, is_enough) in [(0, false), (10_000, false), (MANY, true)] {
            let meter = Meter::new(limit);
            let thrown = nodes.throw(&ball(1.0, 0.0), DVec3::ZERO, (10_000, 0.85), Key::root(1), &meter);
            assert_eq!(thrown.is_ok(), is_enough, "{limit}");
            assert!(is_enough || meter.taken() < limit + 2 * AT_A_TIME as u64, "{}", meter.taken());
        }
    }

    #[test]
    fn darts_that_are_compared_with_all_nodes_stop() {
        // Two small balls far apart: no cells are so small that few nodes share one.
        let ball = |at| Part::new(Solid::Portion { radius: 0.1, cos: -1.0 }, at, DVec3::Z, true);
        let volume = Volume::new(vec![ball(DVec3::Z), ball(dvec3(900.0, 900.0, 900.0))], Side::Above);
        let meter = Meter::new(100_000);
        let thrown = Nodes::default().throw(&volume, DVec3::ZERO, (100_000, 0.7), Key::root(1), &meter);
        assert_eq!(thrown.map(|thrown| thrown.throws), Err(OutOfSteps::Crowding));
    }

    #[test]
    fn nodes_keep_their_distance_and_are_as_many_as_asked() {
        for (count, spacing) in [(50, 0.7), (1000, 0.7), (1000, 0.5), (3000, 0.8)] {
            let mut nodes = Nodes::default();
            let thrown = throw(&mut nodes, &ball(2.0, 0.0), count, spacing, 1);
            assert_eq!(nodes.points.len(), count);
            let least = spacing * thrown.mean_spacing;
            for (i, p) in nodes.points.iter().enumerate() {
                assert!(nodes.points[..i].iter().all(|q| q.distance(*p) >= least), "{count} {spacing}");
                assert!(p.length() <= 2.0 && p.z >= 0.0);
            }
        }
    }

    #[test]
    fn darts_per_node_are_as_many_as_measured_before() {
        // Published for 1000 nodes: 1.4, 1.7, 2.7, 8.
        for (spacing, expected) in [(0.5, 1.4), (0.6, 1.7), (0.7, 2.7), (0.8, 8.0)] {
            let mut nodes = Nodes::default();
            let thrown = throw(&mut nodes, &ball(1.0, 0.0), 1000, spacing, 2);
            let per_node = thrown.throws as f64 / 1000.0;
            assert!((per_node / expected - 1.0).abs() < 0.3, "{spacing}: {per_node}");
        }
    }

    #[test]
    fn darts_that_find_no_place_come_to_an_end() {
        let mut nodes = Nodes::default();
        let thrown = throw(&mut nodes, &ball(1.0, 0.0), 500, 1.2, 3);
        assert_eq!(thrown.throws, MAX_THROWS * 500);
        assert!((50..499).contains(&nodes.points.len()));
        let flat = Volume::from_part(
            Part::new(Solid::Cylinder { radius: 0.0, height: 1.0 }, DVec3::ZERO, DVec3::Z, true),
            Side::Above,
        );
        let _ = throw(&mut nodes, &flat, 500, 0.7, 3);
        assert_eq!(nodes.points, [DVec3::ZERO], "nothing fits into nothing");
    }
}
