//! The scaffold: nodes from which trunks, limbs and shoots are made, parents before children.

use glam::DVec3;

/// No node.
pub(crate) const NONE: u32 = u32::MAX;
/// Shoots that one node can bear while points are colonised.
pub(crate) const MAX_CHILDREN: usize = 3;

/// A node and where it stands in the scaffold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Over the tree's height.
    pub(crate) place: DVec3,
    /// Direction of the step that led here; a unit vector.
    pub(crate) heading: DVec3,
    /// [`NONE`] for the feet of trunks.
    pub(crate) parent: u32,
    /// The axis that it belongs to.
    pub(crate) axis: u32,
    /// The next node of the same axis, or [`NONE`].
    pub(crate) next: u32,
    /// The first shoots that leave here, whether or not of the same axis.
    pub(crate) children: [u32; MAX_CHILDREN],
    pub(crate) child_count: u8,
}

/// A leader, a limb or a shoot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    /// Steps that it grows each time the crown grows by one, at most 1.
    pub(crate) vigor: f64,
    /// Part of a step that it has saved.
    pub(crate) credit: f64,
    /// Direction of its first step, or of a limb's last one.
    pub(crate) start: DVec3,
    /// Whether it is a trunk's.
    pub(crate) is_trunk: bool,
    /// Whether it has come to its end: then its last node bears side shoots.
    pub(crate) has_ended: bool,
}

/// All nodes and axes.
#[derive(Debug, Default)]
pub(crate) struct Nodes {
    pub(crate) all: Vec<Node>,
    pub(crate) axes: Vec<Axis>,
    /// How many of the first nodes stand before points are colonised: those of trunks and limbs.
    given: usize,
}

impl Nodes {
    pub(crate) fn clear(&mut self) {
        self.all.clear();
        self.axes.clear();
        self.given = 0;
    }

    /// Begins an axis towards `start`.
    pub(crate) fn axis(&mut self, vigor: f64, start: DVec3) -> u32 {
        self.axes.push(Axis { vigor, credit: 0.0, start, is_trunk: false, has_ended: false });
        self.axes.len() as u32 - 1
    }

    /// Begins the axis of a trunk.
    pub(crate) fn trunk(&mut self) -> u32 {
        let axis = self.axis(1.0, DVec3::Z);
        self.axes[axis as usize].is_trunk = true;
        axis
    }

    /// Notes that the nodes so far stand before points are colonised. Returns how many there are.
    pub(crate) fn note_given(&mut self) -> usize {
        self.given = self.all.len();
        self.given
    }

    /// Whether the node of `index` keeps its place: trunks stand as their numbers say.
    pub(crate) fn keeps_place(&self, index: usize) -> bool {
        index < self.given && self.axes[self.all[index].axis as usize].is_trunk
    }

    /// Adds a node of `axis` after `parent`, or a trunk's foot.
    pub(crate) fn push(&mut self, place: DVec3, heading: DVec3, parent: u32, axis: u32) -> u32 {
        let index = self.all.len() as u32;
        if let Some(from) = self.all.get_mut(parent as usize) {
            if let Some(child) = from.children.get_mut(usize::from(from.child_count)) {
                *child = index;
            }
            from.child_count = from.child_count.saturating_add(1);
            if from.axis == axis {
                from.next = index;
            }
        }
        let children = [NONE; MAX_CHILDREN];
        self.all.push(Node { place, heading, parent, axis, next: NONE, children, child_count: 0 });
        index
    }

    /// Whether `node` is the last of an axis that still grows.
    pub(crate) fn is_tip(&self, node: &Node) -> bool {
        node.next == NONE && !self.axes[node.axis as usize].has_ended
    }

    /// Whether a node on the same axis within `steps` steps of `index` bears a side shoot.
    pub(crate) fn has_side_shoot_near(&self, index: u32, steps: u32) -> bool {
        let own = self.all[index as usize];
        let bears = |node: &Node| node.child_count > u8::from(node.next != NONE);
        if bears(&own) {
            return true;
        }
        let (mut below, mut above) = (own, own);
        for _ in 0..steps {
            if let Some(node) = self.all.get(below.parent as usize) {
                // A side shoot has none right at its foot either.
                if node.axis != own.axis || bears(node) {
                    return true;
                }
                below = *node;
            }
            if let Some(node) = self.all.get(above.next as usize) {
                if bears(node) {
                    return true;
                }
                above = *node;
            }
        }
        false
    }
}
