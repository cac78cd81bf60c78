//! A table of cylinders, as programs that measure trees from laser scans make and read it.

use super::{Skeleton, mean_square, written};
use glam::DVec3;
use std::io::{self, Write};

/// A row of the table: a part of a stem as a cylinder.
///
/// The columns are those of the quantitative structure models of TreeQSM (Raumonen et al. 2013, *Fast automatic precision
/// tree models from terrestrial laser scanner data*), in its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius in metres: that of the cylinder with the volume of the frustum.
    pub radius: f64,
    /// Length in metres.
    pub length: f64,
    /// The middle of its base, in metres, z up.
    pub start: DVec3,
    /// From its base to its top, of length 1.
    pub axis: DVec3,
    /// Number of the cylinder below it, from 1; 0 for none.
    pub parent: u32,
    /// Number of the next cylinder of the same stem; 0 at the tip.
    pub extension: u32,
    /// Number of its stem among those with cylinders, from 1.
    pub branch: u32,
    /// Level of its stem, 0 for trunks.
    pub branch_order: u16,
    /// Number of the cylinder in its stem, from 1.
    pub position_in_branch: u32,
}

/// The header of the table.
const HEADER: &str = "radius,length,start.x,start.y,start.z,axis.x,axis.y,axis.z,parent,extension,added,UnmodRadius,branch,\
                      BranchOrder,PositionInBranch";

impl Skeleton {
    /// The segments as cylinders, in the order of the nodes.
    #[must_use]
    pub fn cylinders(&self) -> Vec<Cylinder> {
        let mut cylinders: Vec<Cylinder> = Vec::with_capacity(self.nodes.len());
        // Of each node, the cylinder that ends there, and the first one of its stem if that begins there; 0 for none.
        let (mut ends, mut begins) = (vec![0; self.nodes.len()], vec![0; self.nodes.len()]);
        let (mut branch, mut position_in_branch) = (0, 0);
        for (i, node) in self.nodes.iter().enumerate() {
            let Some(below) = node.parent.map(|below| below as usize) else { continue };
            let lower = &self.nodes[below];
            if lower.stem != node.stem {
                // A stem's first node. Where its parent begins, it stands on the parent's first cylinder, and not on what
                // ends there, which belongs to another stem.
                ends[i] = if begins[below] == 0 { ends[below] } else { begins[below] };
                continue;
            }
            let number = cylinders.len() as u32 + 1;
            // Nodes of a stem are in one run: the cylinder before this one is below it.
            match cylinders.last_mut().filter(|_| self.is_inner(below)) {
                Some(previous) => {
                    previous.extension = number;
                    position_in_branch += 1;
                }
                None => {
                    (branch, position_in_branch) = (branch + 1, 1);
                    begins[below] = number;
                }
            }
            let length = lower.position.distance(node.position);
            cylinders.push(Cylinder {
                radius: mean_square(lower.radius, node.radius).sqrt(),
                length,
                start: lower.position,
                axis: (node.position - lower.position) / length,
                parent: ends[below],
                extension: 0,
                branch,
                branch_order: node.level,
                position_in_branch,
            });
            ends[i] = number;
        }
        cylinders
    }

    /// Whether a segment of the same stem ends at node `index`.
    fn is_inner(&self, index: usize) -> bool {
        let node = &self.nodes[index];
        node.parent.is_some_and(|below| self.nodes[below as usize].stem == node.stem)
    }
}

/// Writes the cylinders of `skeleton` as comma-separated values.
pub(super) fn write(skeleton: &Skeleton, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    writeln!(out, "{HEADER}")?;
    for cylinder in skeleton.cylinders() {
        let Cylinder { radius, length, parent, extension, branch, .. } = cylinder;
        write!(out, "{radius:.8},{length:.8}")?;
        for vector in [cylinder.start, cylinder.axis] {
            let [x, y, z] = written(vector);
            write!(out, ",{x:.8},{y:.8},{z:.8}")?;
        }
        let (order, position) = (cylinder.branch_order, cylinder.position_in_branch);
        writeln!(out, ",{parent},{extension},0,{radius:.8},{branch},{order},{position}")?;
    }
    Ok(())
}
