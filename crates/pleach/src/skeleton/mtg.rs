//! A multiscale tree graph as text.
//!
//! Godin and Caraglio 1998, *A multiscale model of plant topological structures*; the text format is that of AMAPmod and
//! OpenAlea: an entity per line, indented by a tab for each branching, `/` for what it is composed of, `<` for what
//! follows and `+` for what branches off. `^` stands for the entity before in the same column.

use super::{Skeleton, written};
use std::io::{self, Write};

/// Classes of entities, relations between them, and properties.
const CLASSES: &str = "CODE:\tFORM-A

CLASSES:
SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION
$\t0\tFREE\tFREE\tIMPLICIT
P\t1\tFREE\tFREE\tEXPLICIT
A\t2\tFREE\tFREE\tEXPLICIT
N\t3\tFREE\tFREE\tEXPLICIT

DESCRIPTION:
LEFT\tRIGHT\tRELTYPE\tMAX
A\tA\t+\t?
N\tN\t<\t1
N\tN\t+\t?

FEATURES:
NAME\tTYPE
XX\tREAL
YY\tREAL
ZZ\tREAL
Radius\tREAL
Level\tINT

MTG:
";

/// Most columns of entities: each row has them all.
const MAX_COLUMNS: usize = 1000;

/// Writes `skeleton` as a multiscale tree graph.
pub(super) fn write(skeleton: &Skeleton, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    let nodes = &skeleton.nodes;
    // Of each node, the stems that branch off there, by their first nodes: the last one, and of each stem the one before.
    let mut last_branch: Vec<Option<u32>> = vec![None; nodes.len()];
    let mut branch_before = vec![None; nodes.len()];
    let mut depths = vec![0_usize; nodes.len()];
    let mut trunks = Vec::new();
    for (i, node) in nodes.iter().enumerate() {
        match node.parent.map(|below| below as usize) {
            None => trunks.push(i),
            Some(below) if nodes[below].stem == node.stem => depths[i] = depths[below],
            Some(below) => {
                depths[i] = depths[below] + 1;
                branch_before[i] = last_branch[below].replace(i as u32);
            }
        }
    }
    let columns = depths.iter().max().map_or(1, |deepest| deepest + 1);
    if columns > MAX_COLUMNS {
        let what = format!(
            "branches of branches are nested {columns} deep, and an MTG file has at most {MAX_COLUMNS}: each is a column"
        );
        return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    }
    write!(out, "{CLASSES}ENTITY-CODE")?;
    (0..columns).try_for_each(|_| write!(out, "\t"))?;
    writeln!(out, "XX\tYY\tZZ\tRadius\tLevel")?;
    for (plant, &foot) in (1..).zip(&trunks) {
        // Nodes to be written, the next one at the end, each with its number in its stem.
        let mut waiting = vec![(foot, 1)];
        while let Some((i, number)) = waiting.pop() {
            let node = &nodes[i];
            (0..depths[i]).try_for_each(|_| write!(out, "\t"))?;
            let axis = node.stem + 1;
            match (number, node.parent) {
                (1, None) => write!(out, "/P{plant}/A{axis}/N1")?,
                (1, Some(_)) => write!(out, "+A{axis}/N1")?,
                _ => write!(out, "^<N{number}")?,
            }
            (depths[i]..columns).try_for_each(|_| write!(out, "\t"))?;
            let [x, y, z] = written(node.position);
            writeln!(out, "{x:.8}\t{y:.8}\t{z:.8}\t{:.8}\t{}", node.radius, node.level)?;
            // Branches come before what follows in the stem, the first branch first.
            if nodes.get(i + 1).is_some_and(|next| next.stem == node.stem && next.parent == Some(i as u32)) {
                waiting.push((i + 1, number + 1));
            }
            let mut branch = last_branch[i];
            while let Some(first) = branch {
                waiting.push((first as usize, 1));
                branch = branch_before[first as usize];
            }
        }
    }
    Ok(())
}
