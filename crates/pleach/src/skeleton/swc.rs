//! SWC: a node per line.

use super::{Skeleton, written};
use std::io::{self, Write};

/// Types of nodes that the format leaves to its users begin here.
const FIRST_FREE_TYPE: u32 = 5;

/// Writes `skeleton` as SWC. Numbers of nodes count from 1; −1 stands for no parent.
pub(super) fn write(skeleton: &Skeleton, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    writeln!(out, "# metres, z up; type = 5 + level of the stem, 5 for trunks")?;
    writeln!(out, "# number type x y z radius parent")?;
    for (i, node) in skeleton.nodes.iter().enumerate() {
        let kind = FIRST_FREE_TYPE + u32::from(node.level);
        let [x, y, z] = written(node.position);
        let parent = node.parent.map_or(-1, |parent| i64::from(parent) + 1);
        writeln!(out, "{} {kind} {x:.8} {y:.8} {z:.8} {:.8} {parent}", i + 1, node.radius)?;
    }
    Ok(())
}
