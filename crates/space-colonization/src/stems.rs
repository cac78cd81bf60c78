//! From nodes to stems: each goes on along the thickest that it bears, so that a tree has few and smooth stems.

use crate::budget::Budget;
use crate::courses::Courses;
use crate::nodes::{NONE, Nodes};
use crate::params::{Id, Numbers};
use crate::pipes::Pipes;
use crate::pose::Pose;
use crate::purpose::{STEM, TWIGS};
use glam::DVec3;
use pleach_tree::{Address, GrowError, Growth, Key, Knot, Stem, StemKind, Tree, piece};

/// How much of a side stem's first direction is its parent's.
const CROTCH: f64 = 0.5;
/// How much of a trunk's first direction is upright.
const UPRIGHT: f64 = 4.0;
/// Fewest pieces of a stem without side stems in which no node is left out.
const SHORT: usize = 3;

/// A stem that waits for its turn.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    first: u32,
    /// The node that it leaves, or [`NONE`].
    from: u32,
    parent: Option<u32>,
    level: u16,
    number: u32,
    address: Address,
    key: Key,
    pose: Pose,
    /// Metres along the parent.
    offset: f64,
}

/// A stem of the scaffold as twigs see it.
#[derive(Debug, Default)]
pub(crate) struct Limb {
    /// Index in the tree.
    pub(crate) stem: u32,
    pub(crate) level: u16,
    /// For each of its nodes from the foot up: which of its knots, and how far on to the next one.
    pub(crate) sites: Vec<(u32, f64)>,
    /// Distance of each node from the tip, over the tree's height.
    pub(crate) from_tip: Vec<f64>,
    /// Number of the first twig: stems of the scaffold come before.
    pub(crate) first_number: u32,
}

/// What twigs have to know beside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    pub(crate) address: Address,
    pub(crate) key: Key,
}

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Stems {
    courses: Courses,
    waiting: Vec<Waiting>,
    chain: Vec<u32>,
    sides: Vec<(u32, u32)>,
    side_nodes: Vec<(u32, u32)>,
    first_side: Vec<u32>,
    limb: Limb,
}

impl Stems {
    /// Makes the stems of `nodes`, and calls `bear` for each to grow its twigs.
    pub(crate) fn build(
        &mut self,
        (n, growth): (&Numbers, &Growth<'_>),
        (nodes, pipes): (&Nodes, &Pipes),
        tree: &mut Tree,
        budget: &mut Budget,
        bear: &mut dyn FnMut(&Limb, Source, &mut Tree, &mut Budget) -> Result<(), GrowError>,
    ) -> Result<(), GrowError> {
        self.courses.lay(n.straightness, nodes, pipes);
        self.sort_sides(nodes, pipes);
        self.waiting.clear();
        let root = Key::root(growth.seed);
        let feet = nodes.all.iter().enumerate().filter(|(_, node)| node.parent == NONE);
        for (number, (first, node)) in feet.enumerate() {
            let address = Address::trunk(number as u32);
            let draw = growth.draw(address, 0);
            self.waiting.push(Waiting {
                first: first as u32,
                from: NONE,
                parent: None,
                level: 0,
                number: number as u32,
                address,
                key: draw.key(root.child(TWIGS, number as u32)),
                pose: Pose::STILL.then(&draw, node.place, DVec3::Z, DVec3::X),
                offset: 0.0,
            });
        }
        let mut next = 0;
        while let Some(&waiting) = self.waiting.get(next) {
            next += 1;
            self.stem(&waiting, (n, growth), (nodes, pipes), tree, budget)?;
            bear(&self.limb, Source { address: waiting.address, key: waiting.key }, tree, budget)?;
        }
        Ok(())
    }

    /// Collects the side stems of each node, in order.
    fn sort_sides(&mut self, nodes: &Nodes, pipes: &Pipes) {
        self.side_nodes.clear();
        for (index, node) in nodes.all.iter().enumerate() {
            if node.parent != NONE && pipes.main[node.parent as usize] != index as u32 {
                self.side_nodes.push((node.parent, index as u32));
            }
        }
        self.side_nodes.sort_unstable();
        self.first_side.clear();
        self.first_side.resize(nodes.all.len() + 1, 0);
        for &(parent, _) in &self.side_nodes {
            self.first_side[parent as usize + 1] += 1;
        }
        for index in 0..nodes.all.len() {
            self.first_side[index + 1] += self.first_side[index];
        }
    }

    fn has_sides(&self, node: u32) -> bool {
        self.first_side[node as usize] < self.first_side[node as usize + 1]
    }

    fn stem(
        &mut self,
        waiting: &Waiting,
        (n, growth): (&Numbers, &Growth<'_>),
        (nodes, pipes): (&Nodes, &Pipes),
        tree: &mut Tree,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        self.chain.clear();
        let mut node = waiting.first;
        if waiting.from != NONE {
            self.chain.push(waiting.from);
        }
        while node != NONE {
            self.chain.push(node);
            node = pipes.main[node as usize];
        }
        if self.chain.len() < 2 {
            self.chain.push(waiting.first);
        }
        let count = self.chain.len();
        budget.work(count as u64, Id::points)?;
        budget.stem(tree, count, Id::points)?;
        let (stem, first_knot) = (tree.stems.len() as u32, tree.knots.len());
        let is_trunk = waiting.level == 0;
        let pose = &waiting.pose;
        self.limb.sites.clear();
        for (at, &node) in self.chain.iter().enumerate() {
            let place = self.courses.places[node as usize];
            let knots = tree.knots.len() - first_knot;
            // Every second node of a run without side stems is left out.
            let was_left_out = self.limb.sites.last().is_some_and(|site| site.1 > 0.0);
            let is_needed = at == 0 || at + 1 == count || self.has_sides(node) || was_left_out;
            let is_needed = is_needed || self.has_sides(self.chain[at - 1]) || count <= SHORT;
            if !is_needed {
                self.limb.sites.push((knots as u32 - 1, 0.5));
                continue;
            }
            self.limb.sites.push((knots as u32, 0.0));
            // A side stem begins as thick as it is, not as its parent.
            let bears = if at == 0 { self.chain[usize::from(waiting.from != NONE)] } else { node };
            let radius = pipes.radius(bears as usize, place.z, is_trunk) * n.height;
            let point = pose.place(place) * n.height;
            tree.knots.push(Knot { point, handle_in: point, handle_out: point, radius });
        }
        if tree.knots.len() - first_knot < 2 || self.chain[0] == self.chain[count - 1] {
            // A tree of one node: a stake as high as a step.
            let tip = tree.knots.len() - 1;
            let up = nodes.all[waiting.first as usize].heading * (0.01 * n.height);
            tree.knots[tip].point += up;
        }
        // A trunk comes out of level ground.
        let (toward, weight) = match nodes.all.get(waiting.from as usize) {
            Some(from) => (from.heading, CROTCH),
            None => (DVec3::Z, UPRIGHT),
        };
        let toward = pose.place(toward) - pose.place(DVec3::ZERO);
        smooth_handles(&mut tree.knots[first_knot..], toward.normalize_or_zero() * weight);
        let kind = if is_trunk { StemKind::Trunk } else { StemKind::Branch };
        tree.stems.push(Stem {
            parent: waiting.parent,
            level: waiting.level,
            kind,
            number: waiting.number,
            offset: waiting.offset,
            first_knot: first_knot as u32,
            knot_count: (tree.knots.len() - first_knot) as u32,
        });
        self.measure_from_tip();
        self.limb.stem = stem;
        self.limb.level = waiting.level;
        self.limb.first_number = self.push_sides(waiting, growth, tree, stem);
        Ok(())
    }

    fn measure_from_tip(&mut self) {
        let from_tip = &mut self.limb.from_tip;
        from_tip.clear();
        from_tip.resize(self.chain.len(), 0.0);
        for at in (0..self.chain.len() - 1).rev() {
            let (one, next) = (self.chain[at] as usize, self.chain[at + 1] as usize);
            from_tip[at] = from_tip[at + 1] + self.courses.places[one].distance(self.courses.places[next]);
        }
    }

    /// Puts the stems that leave the one of index `stem` into the queue. Returns how many there are.
    fn push_sides(&mut self, waiting: &Waiting, growth: &Growth<'_>, tree: &Tree, stem: u32) -> u32 {
        let knots = tree.knots_of(&tree.stems[stem as usize]);
        self.sides.clear();
        let first = usize::from(waiting.from != NONE);
        for (at, &node) in self.chain.iter().enumerate().skip(first) {
            let range = self.first_side[node as usize] as usize..self.first_side[node as usize + 1] as usize;
            self.sides.extend(self.side_nodes[range].iter().map(|&(_, side)| (at as u32, side)));
        }
        let (mut knot, mut offset) = (0, 0.0);
        for (number, &(at, side)) in self.sides.iter().enumerate() {
            let at = at as usize;
            let until = self.limb.sites[at].0 as usize;
            while knot < until {
                offset += piece(&knots[knot], &knots[knot + 1]).length(3);
                knot += 1;
            }
            let number = number as u32;
            let address = waiting.address.child(number);
            let draw = growth.draw(address, usize::from(waiting.level) + 1);
            let from = self.chain[at];
            let foot = self.courses.places[from as usize];
            let before =
                if at > 0 { self.courses.places[self.chain[at - 1] as usize] } else { foot - DVec3::Z };
            let parent = (foot - before).normalize_or(DVec3::Z);
            let along = (self.courses.places[side as usize] - foot).normalize_or(DVec3::X);
            self.waiting.push(Waiting {
                first: side,
                from,
                parent: Some(stem),
                level: waiting.level + 1,
                number,
                address,
                key: draw.key(waiting.key.child(STEM, number)),
                pose: waiting.pose.then(&draw, foot, parent, along),
                offset,
            });
        }
        self.sides.len() as u32
    }
}

/// Handles by which the pieces between `knots` join smoothly; `toward` is added to the direction at the foot.
fn smooth_handles(knots: &mut [Knot], toward: DVec3) {
    let last = knots.len() - 1;
    let chord = |knots: &[Knot], i: usize| knots[i + 1].point - knots[i].point;
    for i in 0..=last {
        let (into, out) = (
            if i > 0 { chord(knots, i - 1) } else { DVec3::ZERO },
            if i < last { chord(knots, i) } else { DVec3::ZERO },
        );
        let sum = into.normalize_or_zero() + out.normalize_or_zero();
        let own = sum.try_normalize().unwrap_or_else(|| out.normalize_or(DVec3::Z));
        let tangent = if i == 0 { (own + toward).try_normalize().unwrap_or(own) } else { own };
        knots[i].handle_in = knots[i].point - tangent * (into.length() / 3.0);
        knots[i].handle_out = knots[i].point + tangent * (out.length() / 3.0);
    }
}
