//! Rows that name their parents, as a forest.

use super::error::{SkeletonError, SkeletonProblem as Problem};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Parents and children of rows.
pub(super) struct Links {
    pub(super) parents: Vec<Option<u32>>,
    /// All children, those of a row in one run and in their order.
    children: Vec<u32>,
    first: Vec<u32>,
}

impl Links {
    pub(super) fn new(parents: Vec<Option<u32>>) -> Self {
        let mut first = vec![0_u32; parents.len() + 1];
        parents.iter().flatten().for_each(|&parent| first[parent as usize + 1] += 1);
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let mut next = first.clone();
        let mut children = vec![0; first[parents.len()] as usize];
        for (child, parent) in parents.iter().enumerate() {
            let Some(parent) = parent else { continue };
            let place = &mut next[*parent as usize];
            children[*place as usize] = child as u32;
            *place += 1;
        }
        Self { parents, children, first }
    }

    pub(super) fn children(&self, row: u32) -> &[u32] {
        &self.children[self.first[row as usize] as usize..self.first[row as usize + 1] as usize]
    }

    /// All rows, parents before children, and in their own order where that allows it; or a row of a cycle.
    pub(super) fn order(&self) -> Result<Vec<u32>, u32> {
        let count = self.parents.len() as u32;
        let roots = (0..count).filter(|&row| self.parents[row as usize].is_none());
        let mut ready: BinaryHeap<Reverse<u32>> = roots.map(Reverse).collect();
        let mut order = Vec::with_capacity(self.parents.len());
        while let Some(Reverse(row)) = ready.pop() {
            order.push(row);
            ready.extend(self.children(row).iter().map(|&child| Reverse(child)));
        }
        if order.len() == self.parents.len() {
            return Ok(order);
        }
        let mut is_reached = vec![false; self.parents.len()];
        order.iter().for_each(|&row| is_reached[row as usize] = true);
        // From any row that no root leads to, parents lead into a cycle; its first row is the one to name.
        let mut row = is_reached.iter().position(|reached| !reached).unwrap_or_default() as u32;
        let mut least = row;
        for step in 0..2 * count {
            row = self.parents[row as usize].unwrap_or(row);
            least = if step < count { row } else { least.min(row) };
        }
        Err(least)
    }

    /// For each row, the length of the longest way upwards from its end, given the `lengths` of all rows in this `order`.
    pub(super) fn reaches(&self, order: &[u32], lengths: &[f64]) -> Vec<f64> {
        let mut reaches = vec![0.0_f64; order.len()];
        for &row in order.iter().rev() {
            if let Some(parent) = self.parents[row as usize] {
                let reach = reaches[row as usize] + lengths[row as usize];
                let below = &mut reaches[parent as usize];
                *below = below.max(reach);
            }
        }
        reaches
    }
}

/// A row that names its parent.
pub(super) struct Named {
    pub(super) line: u64,
    pub(super) number: i64,
    pub(super) parent: i64,
}

/// The forest of rows, and these with parents before children. A parent below `first` that no row is stands for none.
pub(super) fn forest(
    origin: &str,
    rows: impl Iterator<Item = Named> + Clone,
    first: i64,
) -> Result<(Links, Vec<u32>), SkeletonError> {
    let wrong = |line, problem| SkeletonError::new(origin, line, problem);
    let numbers = numbered(rows.clone().map(|row| (row.number, row.line)))
        .map_err(|(number, line, first)| wrong(line, Problem::Twice { number, first }))?;
    let parent = |row: Named| {
        let known = numbers.get(&row.parent).map(|(row, _)| *row);
        if known.is_none() && row.parent >= first {
            return Err(wrong(row.line, Problem::NoParent { parent: row.parent }));
        }
        Ok(known)
    };
    let links = Links::new(rows.clone().map(parent).collect::<Result<_, _>>()?);
    let line = |row: u32| rows.clone().nth(row as usize).map_or(1, |row| row.line);
    let order = links.order().map_err(|row| wrong(line(row), Problem::Cycle))?;
    Ok((links, order))
}

/// The rows by their numbers, which are given with the line of each; the error is a number that is there twice, the line
/// of its second row and that of its first.
fn numbered(rows: impl Iterator<Item = (i64, u64)>) -> Result<BTreeMap<i64, (u32, u64)>, (i64, u64, u64)> {
    let mut known = BTreeMap::new();
    for (row, (number, line)) in rows.enumerate() {
        if let Some((_, first)) = known.insert(number, (row as u32, line)) {
            return Err((number, line, first));
        }
    }
    Ok(known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parents_come_first_and_cycles_are_found() {
        let links = Links::new(vec![Some(2), None, Some(1), Some(1)]);
        assert_eq!(links.order(), Ok(vec![1, 2, 0, 3]));
        assert_eq!(links.children(1), [2, 3]);
        assert_eq!(links.reaches(&[1, 2, 0, 3], &[1.0, 9.0, 2.0, 2.5]), [0.0, 3.0, 1.0, 0.0]);
        // 4 leads into the cycle of 1, 2 and 3.
        assert_eq!(Links::new(vec![None, Some(2), Some(3), Some(1), Some(3)]).order(), Err(1));
        assert_eq!(Links::new(vec![Some(0)]).order(), Err(0));
    }
}
