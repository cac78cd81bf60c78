//! Space colonisation: shoots grow towards the points that are nearest to them, and reach them.
//!
//! Runions, Lane and Prusinkiewicz 2007, §3. A point pulls on the nearest node within the radius of influence; a node
//! that is pulled grows a step in the mean direction of its points; a point within the radius of killing of a new node
//! is taken away.
//!
//! Ours, after the bud fates of Pałubicki and others 2009, §4: the last node of an axis continues it; any other node
//! begins a side shoot, not too near to the next one, and side shoots grow more slowly by `dominance`: what a leader
//! takes first is lost to its sides. Where `apical_control` is not 0.5, buds also wait for what `vigor.rs` gives them.
//!
//! A point remembers its nearest node, so that only new nodes are compared with the points around them: the work is the
//! number of nodes times the points within the radius of influence, and the time grows as the number of points.

use crate::budget::Budget;
use crate::grid::Grid;
use crate::nodes::{MAX_CHILDREN, NONE, Node, Nodes};
use crate::params::Id;
use crate::rules::Rules;
use crate::vigor::Vigor;
use crate::volume::Volume;
use glam::DVec3;
use pleach_tree::GrowError;

/// Slowest side shoot: part of a step each time.
const MIN_VIGOR: f64 = 0.08;
/// Part of a parent's vigour that full dominance takes from its side shoots.
const TAKEN: f64 = 0.75;
/// Credit for a step, but for rounding.
const READY: f64 = 1.0 - 1e-9;
/// Rounds after which growing ends in any case.
const MAX_ROUNDS: u32 = 1500;
/// How often, and by which factor, influence is widened where a crown is out of reach of its trunk.
const WIDENINGS: u32 = 8;
const WIDENING: f64 = 1.7;
/// The cosine of the angle to its first direction at which a shoot ends, so that none curls up.
const TURNED: f64 = 0.5;
/// The same for shoots at the ends of trunks and limbs.
const FORKED: f64 = 0.3;
/// New nodes for each point, and in any case, at most.
const NODES_A_POINT: usize = 12;
const NODES: usize = 500;
/// Cosines of the angles to its heading within which a node perceives points, and within which a tip follows them.
/// Pałubicki and others 2009, §4.1: buds perceive a cone, so that shoots do not turn back into their own crown.
const PERCEIVED: f32 = -0.2;
const PERCEIVED_SQUARED: f32 = PERCEIVED * PERCEIVED;
const FOLLOWED: f64 = 0.64;
/// A step that ends within this part of a step from a former one is not taken.
const SAME: f64 = 0.35;

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Colony {
    grid: Grid,
    /// Nearest node of each point, and the square of its distance; [`NONE`] out of influence.
    nearest: Vec<(u32, f64)>,
    /// Points that pull on a node which can grow, and whether a point is among them.
    alive: Vec<u32>,
    is_listed: Vec<bool>,
    /// Sum of the directions to a node's points.
    pulls: Vec<DVec3>,
    pulled: Vec<u32>,
    /// Tips that are pulled aside.
    aside: Vec<u32>,
    /// Nodes that have no way to go.
    spent: Vec<bool>,
    vigor: Vigor,
}

/// What marks a point that was reached.
const TAKEN_AWAY: f64 = -1.0;

impl Colony {
    /// Grows `nodes` into `points`.
    pub(crate) fn grow(
        &mut self,
        (points, volume): (&[DVec3], &Volume<'_>),
        rules: &Rules,
        nodes: &mut Nodes,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        let given = nodes.note_given();
        let mut rules = *rules;
        for _ in 0..WIDENINGS {
            self.start(points, &rules, nodes, budget)?;
            for _ in 0..MAX_ROUNDS {
                let first_new = nodes.all.len();
                let next = self.round((points, volume), &rules, nodes, budget)?;
                for node in first_new..nodes.all.len() {
                    self.notice(node as u32, &rules, nodes, budget)?;
                }
                let is_full = nodes.all.len() - given > NODES_A_POINT * points.len() + NODES;
                let has_grown = nodes.all.len() > first_new;
                if (!has_grown && next.is_infinite())
                    || is_full
                    || self.vigor.is_of_age(rules.step, rules.crown_width)
                {
                    break;
                }
                // Nothing happens until the first of those that wait has its turn.
                let times = if has_grown { 1.0 } else { next.ceil().max(1.0) };
                for axis in &mut nodes.axes {
                    axis.credit = (axis.credit + axis.vigor * times).min(1.0);
                }
            }
            let is_left = |known: &(u32, f64)| known.1 != TAKEN_AWAY;
            if nodes.all.len() > given || !self.nearest.iter().any(is_left) {
                break;
            }
            rules.influence *= WIDENING;
        }
        Ok(())
    }

    fn start(
        &mut self,
        points: &[DVec3],
        rules: &Rules,
        nodes: &mut Nodes,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        self.grid.fill(points, rules.influence);
        self.nearest.clear();
        self.nearest.resize(points.len(), (NONE, rules.influence * rules.influence));
        self.alive.clear();
        self.is_listed.clear();
        self.is_listed.resize(points.len(), false);
        self.pulls.clear();
        self.spent.clear();
        self.vigor.clear();
        for node in 0..nodes.all.len() {
            let Node { axis, next, heading, .. } = nodes.all[node];
            if next == NONE {
                nodes.axes[axis as usize].start = heading;
            }
            self.notice(node as u32, rules, nodes, budget)?;
        }
        Ok(())
    }

    /// Compares `node` with the points around it.
    fn notice(
        &mut self,
        node: u32,
        rules: &Rules,
        nodes: &Nodes,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        self.pulls.push(DVec3::ZERO);
        self.spent.push(false);
        let Self { nearest, alive, is_listed, .. } = self;
        let kill = (rules.kill * rules.kill) as f32;
        let Node { place, heading, .. } = nodes.all[node as usize];
        let heading = heading.as_vec3();
        let looked = self.grid.around(place, rules.influence, |entry, to, squared| {
            if squared >= entry.least {
                return;
            }
            let point = entry.number as usize;
            if squared < kill {
                nearest[point].1 = TAKEN_AWAY;
                // Nothing is nearer.
                entry.least = 0.0;
                return;
            }
            let ahead = to.dot(heading);
            if ahead >= 0.0 || ahead * ahead < PERCEIVED_SQUARED * squared {
                entry.least = squared;
                nearest[point] = (node, squared.into());
                if !is_listed[point] {
                    is_listed[point] = true;
                    alive.push(entry.number);
                }
            }
        });
        budget.work(looked, Id::points)
    }

    /// Every node that is pulled grows a step, if its axis may. Returns after how many
    /// rounds the next one can that waits for its turn; infinitely many if none waits.
    fn round(
        &mut self,
        (points, volume): (&[DVec3], &Volume<'_>),
        rules: &Rules,
        nodes: &mut Nodes,
        budget: &mut Budget,
    ) -> Result<f64, GrowError> {
        let mut next = f64::INFINITY;
        let Self { nearest, alive, pulls, pulled, aside, spent, is_listed, vigor, .. } = self;
        pulled.clear();
        aside.clear();
        alive.retain(|&point| {
            let (node, squared) = nearest[point as usize];
            // A point that is left is listed again when a later node is nearer to it.
            if squared == TAKEN_AWAY || spent[node as usize] {
                is_listed[point as usize] = false;
                return false;
            }
            let own = &nodes.all[node as usize];
            let is_tip = nodes.is_tip(own);
            let axis = &nodes.axes[own.axis as usize];
            if is_tip && axis.credit < READY && !rules.divides() {
                next = next.min((1.0 - axis.credit) / axis.vigor);
                return true;
            }
            let to = (points[point as usize] - own.place) / squared.sqrt();
            // What a tip does not follow is left to a side shoot, when it has gone on.
            if is_tip && to.dot(own.heading) < FOLLOWED {
                aside.push(node);
                return true;
            }
            let pull = &mut pulls[node as usize];
            if *pull == DVec3::ZERO {
                pulled.push(node);
            }
            *pull += to;
            true
        });
        budget.work(alive.len() as u64, Id::points)?;
        // A tip with nothing ahead has come to its end, and bears side shoots from the next time on.
        for &node in aside.iter() {
            if pulls[node as usize] == DVec3::ZERO {
                let axis = nodes.all[node as usize].axis;
                nodes.axes[axis as usize].has_ended = true;
                next = 0.0;
            }
        }
        pulled.sort_unstable();
        // Two points on opposite sides may add up to nothing and list a node twice.
        pulled.dedup();
        if rules.divides() && !pulled.is_empty() {
            vigor.divide(rules.control, pulled, nodes);
            budget.work(nodes.all.len() as u64, Id::points)?;
            // One of them has its turn now, and the others wait.
            next = 0.0;
        }
        for &node in pulled.iter() {
            let pull = std::mem::take(&mut pulls[node as usize]);
            if rules.divides() && !vigor.takes_step(node) {
                continue;
            }
            if grow_from(node, (pull, volume), rules, nodes, spent) {
                next = 0.0;
            }
        }
        Ok(next)
    }
}

/// One step from `node`, if it can. Returns whether it may be able to in the next round.
fn grow_from(
    node: u32,
    (pull, volume): (DVec3, &Volume<'_>),
    rules: &Rules,
    nodes: &mut Nodes,
    spent: &mut [bool],
) -> bool {
    let from = nodes.all[node as usize];
    let is_tip = nodes.is_tip(&from);
    if !is_tip && usize::from(from.child_count) >= MAX_CHILDREN {
        spent[node as usize] = true;
        return false;
    }
    if !is_tip && rules.bud_spacing > 0 && nodes.has_side_shoot_near(node, rules.bud_spacing) {
        // Side shoots stay where they are.
        spent[node as usize] = true;
        return false;
    }
    // Side shoots leave at an angle: only tips go straight on.
    let ahead = if is_tip { rules.inertia } else { 0.3 * rules.inertia };
    let mut wish = pull.normalize_or_zero() + from.heading * ahead + DVec3::Z * rules.tropism;
    if rules.outward > 0.0 {
        wish += volume.outward(from.place) * rules.outward;
    }
    let mut heading = wish.try_normalize().unwrap_or(from.heading);
    if is_tip {
        heading = rules.bent(from.heading, heading);
        let axis = &mut nodes.axes[from.axis as usize];
        if heading.dot(axis.start) < TURNED {
            axis.has_ended = true;
            return true;
        }
    }
    // A shoot at the end of another one goes on with its bend.
    let is_end = !is_tip && from.next == NONE;
    let start = if from.next == NONE { nodes.axes[from.axis as usize].start } else { heading };
    // Trunks and limbs have vigour 1, and end anywhere: their ends may fork more widely.
    let least = if is_end && nodes.axes[from.axis as usize].vigor == 1.0 { FORKED } else { TURNED };
    if heading.dot(start) < least {
        spent[node as usize] = true;
        return false;
    }
    let place = from.place + heading * rules.step;
    let same = SAME * SAME * rules.step * rules.step;
    let is_taken = |&&child: &&u32| {
        nodes.all.get(child as usize).is_some_and(|child| child.place.distance_squared(place) < same)
    };
    let is_below = place.z < 0.3 * rules.step && from.heading.z < 0.5;
    if from.children.iter().filter(is_taken).count() > 0 || is_below {
        spent[node as usize] = true;
        return false;
    }
    let axis = if is_tip {
        nodes.axes[from.axis as usize].credit = 0.0;
        from.axis
    } else {
        let vigor = nodes.axes[from.axis as usize].vigor * (1.0 - TAKEN * rules.dominance);
        nodes.axis(vigor.max(MIN_VIGOR), start)
    };
    nodes.push(place, heading, node, axis);
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{EVEN, Numbers};
    use pleach_tree::param::table::Parameters;
    use pleach_tree::{Key, Limits};

    const RULES: Rules = Rules {
        step: 0.03,
        influence: 0.3,
        kill: 0.06,
        inertia: 0.0,
        tropism: 0.0,
        outward: 0.0,
        dominance: 0.0,
        control: EVEN,
        crown_width: 0.8,
        bud_spacing: 0,
    };

    fn volume() -> Volume<'static> {
        Volume::new(&Numbers::read(&Numbers::space().defaults()), None, Key::root(1))
    }

    fn stake() -> Nodes {
        let mut nodes = Nodes::default();
        let axis = nodes.axis(1.0, DVec3::Z);
        nodes.axes[0].credit = 1.0;
        let foot = nodes.push(DVec3::ZERO, DVec3::Z, NONE, axis);
        nodes.push(DVec3::Z * 0.03, DVec3::Z, foot, axis);
        nodes
    }

    fn colonised(points: &[DVec3], rules: &Rules) -> Nodes {
        let mut nodes = stake();
        let mut budget = Budget::new(Limits::DEFAULT);
        Colony::default().grow((points, &volume()), rules, &mut nodes, &mut budget).unwrap();
        nodes
    }

    fn cloud(count: u32) -> Vec<DVec3> {
        let key = Key::root(9);
        let point = |i| DVec3::new(key.signed(0, i), key.signed(1, i), 0.3 + key.unit(2, i)) * 0.6;
        (0..count).map(point).collect()
    }

    #[test]
    fn every_point_within_reach_is_reached() {
        let points = cloud(300);
        let nodes = colonised(&points, &RULES);
        let is_reached =
            |point: &&DVec3| nodes.all.iter().any(|node| node.place.distance(**point) < RULES.kill);
        let reached = points.iter().filter(is_reached).count();
        assert!(reached > 225, "{reached} of 300");
        assert!(nodes.all.iter().skip(1).enumerate().all(|(i, node)| node.parent <= i as u32));
    }

    #[test]
    fn steps_have_their_length() {
        let nodes = colonised(&cloud(200), &RULES);
        for node in &nodes.all[2..] {
            let step = node.place.distance(nodes.all[node.parent as usize].place);
            assert!((step - RULES.step).abs() < 1e-12);
        }
    }

    #[test]
    fn one_point_is_reached_on_a_straight_line() {
        let nodes = colonised(&[DVec3::new(0.0, 0.0, 0.23)], &RULES);
        assert!(nodes.all[2..].iter().all(|node| (node.heading - DVec3::Z).length() < 1e-12));
        assert_eq!(nodes.all.len(), 2 + 5, "0.2 less the radius of killing, in steps of 0.03");
    }

    #[test]
    fn a_crown_out_of_reach_is_reached_in_the_end() {
        let nodes = colonised(&[DVec3::new(0.0, 0.3, 2.0)], &RULES);
        assert!(nodes.all.last().unwrap().place.z > 1.9);
    }

    #[test]
    fn dominance_slows_side_shoots_and_spacing_thins_them() {
        let nodes = colonised(&cloud(500), &Rules { dominance: 1.0, ..RULES });
        let sides = nodes.axes.iter().filter(|axis| axis.vigor < 1.0).count();
        assert!(sides > 20 && sides == nodes.axes.len() - 1);
        let axes = |rules: &Rules| {
            let nodes = colonised(&cloud(500), rules);
            nodes.axes.len() as f64 / nodes.all.len() as f64
        };
        assert!(axes(&Rules { bud_spacing: 3, ..RULES }) < axes(&RULES));
    }

    /// Part of all steps that are the trunk's, and its height, in the mean of several clouds.
    fn leading(control: f64) -> [f64; 2] {
        let mut means = [0.0; 2];
        for seed in 0..8 {
            let key = Key::root(seed);
            let point = |i| DVec3::new(key.signed(0, i), key.signed(1, i), 0.2 + 3.0 * key.unit(2, i)) * 0.4;
            let points: Vec<DVec3> = (0..800).map(point).collect();
            let nodes = colonised(&points, &Rules { control, bud_spacing: 2, ..RULES });
            let trunk: Vec<f64> =
                nodes.all.iter().filter(|node| node.axis == 0).map(|node| node.place.z).collect();
            means[0] += trunk.len() as f64 / nodes.all.len() as f64 / 8.0;
            means[1] += trunk.iter().copied().fold(0.0, f64::max) / 8.0;
        }
        means
    }

    #[test]
    fn apical_control_keeps_a_leader_or_leaves_it_behind() {
        let [starved, behind, even, kept, alone] = [0.1, 0.3, 0.5, 0.7, 0.9].map(leading);
        assert!(even[0] < kept[0] && kept[0] < 0.7 * alone[0], "parts {even:?} {kept:?} {alone:?}");
        assert!(
            starved[1] < behind[1] && behind[1] < 0.8 * even[1],
            "heights {starved:?} {behind:?} {even:?}"
        );
    }

    #[test]
    fn apical_control_near_its_middle_is_nearly_as_none() {
        let count = |control| colonised(&cloud(500), &Rules { control, ..RULES }).all.len() as f64;
        let ratio = count(EVEN + 1e-9) / count(EVEN);
        assert!((0.93..1.07).contains(&ratio), "{ratio}");
    }

    #[test]
    fn no_apical_control_hangs() {
        for control in [0.0, f64::MIN_POSITIVE, 1e-9, 1.0 - 1e-16, 1.0] {
            for dominance in [0.0, 1.0] {
                let nodes = colonised(&cloud(300), &Rules { control, dominance, ..RULES });
                assert!(nodes.all.len() > 10, "{control} {dominance}: {}", nodes.all.len());
                assert!(nodes.all.iter().all(|node| node.place.is_finite()));
            }
        }
    }

    #[test]
    fn tropism_lifts_and_work_is_limited() {
        let rise = |rules: &Rules| colonised(&[DVec3::new(0.1, 0.0, 0.2)], rules).all[2].heading.z;
        assert!(rise(&Rules { tropism: 0.5, ..RULES }) > rise(&RULES) + 0.05);
        let mut budget = Budget::new(Limits { work: 1000, ..Limits::DEFAULT });
        let error =
            Colony::default().grow((&cloud(300), &volume()), &RULES, &mut stake(), &mut budget).unwrap_err();
        assert!(matches!(error, GrowError::TooMuchWork { limit: 1000, .. }), "{error}");
    }
}
