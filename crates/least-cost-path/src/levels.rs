//! Graphs around the endpoints of graphs, level by level.

use crate::budget::{Budget, Causes};
use crate::direction::{Orientation, turned};
use crate::graph::{Ends, Graph, Meter, OutOfSteps, Rules, Work};
use crate::life::{Lifespans, Light};
use crate::numbers::Numbers;
use crate::purpose::{LIGHT, ROOTS, SUBGRAPH};
use crate::skeleton::{Batch, End, Skeleton};
use crate::volume::{Part, Side, Solid, Volume, underground};
use glam::DVec3;
use pleach_tree::math;
use pleach_tree::{GrowError, Key};
use rayon::prelude::*;

/// A graph about to be grown.
#[derive(Clone, Copy, Debug)]
struct Job {
    /// The point that it grows from, by number and place.
    root: u32,
    at: DVec3,
    /// Where it points.
    axis: DVec3,
    key: Key,
    /// Lifespan of the branch, and what light takes from its endpoints'.
    life: u32,
    decrement: u32,
    /// Endpoints.
    count: usize,
}

/// What all graphs of a level have in common.
#[derive(Clone, Copy, Debug)]
struct Shape {
    /// 0: portion of a sphere; 1: cone; 2: ellipsoid.
    kind: u32,
    radius: f64,
    cos: f64,
    side: Side,
    nodes: usize,
}

impl Shape {
    fn volume(&self, job: &Job) -> Volume {
        let r = self.radius;
        let (solid, forward) = match self.kind {
            0 => (Solid::Portion { radius: r, cos: self.cos }, 0.0),
            1 => (Solid::Cone { radius: 0.5 * r, height: r }, 0.0),
            _ => (Solid::Ellipsoid { across: 0.7 * r, along: 0.6 * r }, 0.6 * r),
        };
        Volume::from_part(Part::new(solid, job.at + job.axis * forward, job.axis, true), self.side)
    }

    fn grow(
        &self,
        job: &Job,
        rules: &Rules,
        meter: &Meter,
        graph: &mut Graph,
        batch: &mut Batch,
    ) -> Result<Work, OutOfSteps> {
        let volume = self.volume(job);
        // Where the ground cuts some of the volume off, the rest is as dense.
        let share = volume.content / volume.parts[0].solid.content().max(f64::MIN_POSITIVE);
        let nodes = (self.nodes as f64 * share).round() as usize;
        let mut work = Work::default();
        // What is mostly below the ground would only creep along it.
        if nodes >= 2 && share >= MIN_SHARE {
            let ends = Ends::Random { count: job.count, shell: 1.0 };
            work = graph.grow(&volume, job.at, (nodes, ends), rules, job.key, meter, &mut batch.paths)?;
        }
        batch.stop();
        Ok(work)
    }
}

/// Where the first graph grows, and what is to blame where it takes too much.
#[derive(Debug)]
pub(crate) struct First<'a> {
    pub(crate) volume: &'a Volume,
    pub(crate) causes: Causes,
}

/// Memory of the levels.
#[derive(Debug, Default)]
pub(crate) struct Levels {
    graph: Graph,
    batch: Batch,
    jobs: Vec<Job>,
}

/// The share of a graph's volume that has to be on its side of the ground.
const MIN_SHARE: f64 = 1.0 / 3.0;
/// Graphs that a thread takes at a time.
const CHUNK: usize = 16;

impl Levels {
    /// Grows the graphs of all levels above ground into `skeleton`.
    pub(crate) fn above(
        &mut self,
        n: &Numbers,
        first: &First<'_>,
        key: Key,
        rules: &Rules,
        budget: &mut Budget,
        skeleton: &mut Skeleton,
    ) -> Result<(), GrowError> {
        skeleton.clear();
        let ends = Ends::Random { count: n.branching[0] as usize, shell: n.shell };
        self.first(first, n.nodes as usize, ends, key, rules, budget, skeleton)?;
        skeleton.ends.iter_mut().for_each(|end| end.life = n.lifespan as u32);
        let levels = n.levels as usize;
        let inner = Rules { weights: crate::graph::Weights { axis_cost: 1.0, ..rules.weights }, ..*rules };
        let lifespans = Lifespans { end: n.lifespan_end, any: n.lifespan_drop == 1.0 };
        let light = Light::new(n);
        let mut previous = 0;
        for level in 2..=levels {
            let from_all = level == levels && n.last_from_all == 1.0;
            let taken = if from_all { 0 } else { previous };
            previous = skeleton.ends.len();
            let at = level - 1;
            let orientation = Orientation::from_number(n.orientation[at]);
            let turn = n.turn[at].to_radians();
            self.jobs.clear();
            for end in skeleton.ends[taken..].iter().filter(|end| end.life > 0) {
                let key = end.key.child(SUBGRAPH, 0);
                let axis = turned(orientation.direction(end.outward, key), turn, key);
                let at = skeleton.points[end.node as usize];
                let count = n.branching[level - 1] as usize;
                self.jobs.push(Job { root: end.node, at, axis, key, life: end.life, decrement: 0, count });
            }
            if let Some(light) = &light {
                let directions: Vec<DVec3> = self.jobs.iter().map(|job| job.axis).collect();
                let shares =
                    light.shares(&directions, n.branching[at] as usize, key.child(LIGHT, level as u32));
                for (job, share) in self.jobs.iter_mut().zip(shares) {
                    (job.decrement, job.count) = (share.decrement, share.count);
                }
            }
            let shape = Shape {
                kind: n.subgraph_shape[at] as u32,
                radius: n.crown_radius * n.reach * math::powi(n.shrink, level as i32 - 2),
                cos: math::cos(n.angle[at].to_radians()),
                side: Side::Above,
                nodes: n.subgraph_nodes as usize,
            };
            self.level(&shape, level, &inner, lifespans, budget, skeleton)?;
        }
        Ok(())
    }

    /// Grows a taproot with laterals, and a graph around the end of each lateral.
    pub(crate) fn below(
        &mut self,
        n: &Numbers,
        key: Key,
        rules: &Rules,
        budget: &mut Budget,
        skeleton: &mut Skeleton,
    ) -> Result<(), GrowError> {
        skeleton.clear();
        let key = key.child(ROOTS, 0);
        let depth = n.root_depth;
        let ends = Ends::Taproot { laterals: n.root_laterals as usize, within: 0.6 * depth * n.root_spread };
        // As many nodes as eight of the other graphs have: enough for the paths to wander.
        let first = First { volume: &underground(n), causes: Causes::roots() };
        self.first(&first, 8 * n.subgraph_nodes as usize, ends, key, rules, budget, skeleton)?;
        self.jobs.clear();
        for end in skeleton.ends.iter().skip(1) {
            let key = end.key.child(SUBGRAPH, 0);
            let (axis, at) = (end.outward, skeleton.points[end.node as usize]);
            let count = n.root_branching as usize;
            self.jobs.push(Job { root: end.node, at, axis, key, life: 1, decrement: 0, count });
        }
        let shape = Shape {
            kind: 0,
            radius: 0.5 * depth * n.root_spread.sqrt(),
            cos: 0.5,
            side: Side::Below,
            nodes: n.subgraph_nodes as usize,
        };
        self.level(&shape, 2, rules, Lifespans { end: 0.0, any: false }, budget, skeleton)
    }

    #[expect(clippy::too_many_arguments, reason = "all of them are what a first graph is made of")]
    fn first(
        &mut self,
        &First { volume, ref causes }: &First<'_>,
        nodes: usize,
        ends: Ends,
        key: Key,
        rules: &Rules,
        budget: &mut Budget,
        skeleton: &mut Skeleton,
    ) -> Result<(), GrowError> {
        let meter = budget.nodes(1, nodes, causes)?;
        self.batch.clear();
        let paths = &mut self.batch.paths;
        let grown = self.graph.grow(volume, DVec3::ZERO, (nodes, ends), rules, key, &meter, paths);
        budget.done(grown, &meter, causes)?;
        skeleton.append(0, &paths.points, &paths.ends, |node, number, outward| End {
            node,
            level: 1,
            outward,
            key: key.child(SUBGRAPH, number),
            life: 1,
        });
        Ok(())
    }

    /// Grows all jobs, in order or on several threads, and appends what they grew in order.
    fn level(
        &mut self,
        shape: &Shape,
        level: usize,
        rules: &Rules,
        lifespans: Lifespans,
        budget: &mut Budget,
        skeleton: &mut Skeleton,
    ) -> Result<(), GrowError> {
        let causes = Causes::level(level);
        let meter = budget.nodes(self.jobs.len(), shape.nodes, &causes)?;
        let grow = |jobs: &[Job], graph: &mut Graph, batch: &mut Batch| {
            jobs.iter().try_fold(Work::default(), |mut work, job| {
                work += shape.grow(job, rules, &meter, graph, batch)?;
                Ok(work)
            })
        };
        let mut all = Work::default();
        let grown = if rules.parallel && self.jobs.len() > CHUNK {
            let grown = |graph: &mut Graph, jobs: &[Job]| {
                let mut batch = Batch::default();
                grow(jobs, graph, &mut batch).map(|work| (batch, work))
            };
            let batches: Result<Vec<(Batch, Work)>, OutOfSteps> =
                self.jobs.par_chunks(CHUNK).map_init(Graph::default, grown).collect();
            batches.map(|batches| {
                for ((batch, work), jobs) in batches.iter().zip(self.jobs.chunks(CHUNK)) {
                    all += *work;
                    append(batch, jobs, level, lifespans, skeleton);
                }
            })
        } else {
            self.jobs.chunks(CHUNK).try_for_each(|jobs| {
                self.batch.clear();
                all += grow(jobs, &mut self.graph, &mut self.batch)?;
                append(&self.batch, jobs, level, lifespans, skeleton);
                Ok(())
            })
        };
        budget.done(grown.map(|()| all), &meter, &causes)
    }
}

fn append(batch: &Batch, jobs: &[Job], level: usize, lifespans: Lifespans, skeleton: &mut Skeleton) {
    let mut from = (0, 0);
    for (job, &stop) in jobs.iter().zip(&batch.stops) {
        let (points, ends) = (&batch.paths.points[from.0..stop.0], &batch.paths.ends[from.1..stop.1]);
        skeleton.append(job.root, points, ends, |node, number, outward| {
            let key = job.key.child(SUBGRAPH, number);
            let life = lifespans.next(job.life, key).saturating_sub(job.decrement);
            End { node, level: level as u16, outward, key, life }
        });
        from = stop;
    }
}
