//! Tables of cylinders, as TreeQSM, rTwig, aRchi and SimpleForest name their columns.

use super::MAX_ROWS;
use super::draft::{Draft, are_levels};
use super::error::{SkeletonError, SkeletonProblem as Problem};
use super::links::{Links, Named, forest};
use glam::DVec3;
use pleach_table::{Row, Table, TableError};

struct Cylinder {
    line: u64,
    number: i64,
    parent: i64,
    /// Number of the next one of its stem; 0 for none, nothing where the table does not say.
    extension: Option<i64>,
    branch: Option<i64>,
    order: Option<i64>,
    radius: f64,
    start: DVec3,
    end: DVec3,
}

/// The columns, by their numbers.
struct Columns {
    radius: usize,
    start: [usize; 3],
    end: End,
    parent: usize,
    number: Option<usize>,
    extension: Option<usize>,
    branch: Option<usize>,
    order: Option<usize>,
}

/// How the upper end is known.
enum End {
    Point([usize; 3]),
    Axis { axis: [usize; 3], length: usize },
}

const START: [&str; 3] = ["start_x", "start_y", "start_z"];
const AXIS: [&str; 3] = ["axis_x", "axis_y", "axis_z"];
const END: [&str; 3] = ["end_x", "end_y", "end_z"];

impl Columns {
    fn new(origin: &str, table: &mut Table) -> Result<Self, SkeletonError> {
        // TreeQSM's own text files head three columns by one word.
        for (name, parts) in
            [("start_point", START), ("axis_direction", AXIS), ("start", START), ("axis", AXIS), ("end", END)]
        {
            table.split(name, &parts);
        }
        let three = |table: &Table, names: [&str; 3]| -> Result<Option<[usize; 3]>, TableError> {
            let mut columns = [0; 3];
            for (column, name) in columns.iter_mut().zip(names) {
                let Some(found) = table.column(&[name])? else { return Ok(None) };
                *column = found;
            }
            Ok(Some(columns))
        };
        let line = table.first_line();
        let missing = |what| SkeletonError::new(origin, line, Problem::NoColumns { what });
        let start = three(table, START)?
            .ok_or_else(|| missing("start_x, start_y and start_z, the middle of the base"))?;
        let length = table.column(&["length"])?;
        let end = match (three(table, AXIS)?.zip(length), three(table, END)?) {
            (Some((axis, length)), _) => End::Axis { axis, length },
            (None, Some(end)) => End::Point(end),
            (None, None) => {
                return Err(missing("axis_x, axis_y, axis_z and length, or end_x, end_y and end_z"));
            }
        };
        Ok(Self {
            radius: table.expect_column(&["radius", "radius_cyl"])?,
            start,
            end,
            parent: table.expect_column(&["parent", "parent_id"])?,
            number: table.column(&["id", "cyl_id", "cylinder_id"])?,
            extension: table.column(&["extension", "extension_id"])?,
            branch: table.column(&["branch", "branch_id", "axis_id"])?,
            order: table.column(&["branch_order", "branching_order"])?,
        })
    }

    fn cylinder(&self, origin: &str, row: &Row, number: i64) -> Result<Cylinder, SkeletonError> {
        let wrong = |problem| SkeletonError::new(origin, row.line(), problem);
        let point = |[x, y, z]: [usize; 3]| -> Result<DVec3, TableError> {
            Ok(DVec3::new(row.expect_number(x)?, row.expect_number(y)?, row.expect_number(z)?))
        };
        let whole = |column: Option<usize>, what| -> Result<Option<i64>, SkeletonError> {
            let Some(number) = column.map(|column| row.number(column)).transpose()?.flatten() else {
                return Ok(None);
            };
            if number.fract() != 0.0 || number.abs() > 1e15 {
                let (text, expected) = (number.to_string(), "a whole number");
                return Err(wrong(Problem::NoNumber { what, text, expected }));
            }
            Ok(Some(number as i64))
        };
        let start = point(self.start)?;
        let end = match self.end {
            End::Point(end) => point(end)?,
            End::Axis { axis, length } => {
                let (axis, length) = (point(axis)?, row.expect_number(length)?);
                if length < 0.0 {
                    return Err(wrong(Problem::Length { length }));
                }
                start + axis.try_normalize().ok_or_else(|| wrong(Problem::NoAxis))? * length
            }
        };
        let radius = row.expect_number(self.radius)?;
        if radius < 0.0 {
            return Err(wrong(Problem::Radius { radius }));
        }
        Ok(Cylinder {
            line: row.line(),
            number: whole(self.number, "number")?.unwrap_or(number),
            parent: whole(Some(self.parent), "parent")?.unwrap_or(0),
            extension: whole(self.extension, "extension")?,
            branch: whole(self.branch, "branch")?,
            order: whole(self.order, "branch order")?,
            radius,
            start,
            end,
        })
    }
}

/// The stems of a table, parents before children.
pub(super) fn read(origin: &str, bytes: &[u8]) -> Result<Vec<Draft>, SkeletonError> {
    let wrong = |line, problem| SkeletonError::new(origin, line, problem);
    let mut table = Table::new(origin, bytes)?;
    let columns = Columns::new(origin, &mut table)?;
    let mut cylinders = Vec::new();
    for row in table.rows() {
        let row = row?;
        if cylinders.len() >= MAX_ROWS {
            return Err(wrong(row.line(), Problem::TooManyRows));
        }
        cylinders.push(columns.cylinder(origin, &row, cylinders.len() as i64 + 1)?);
    }
    let rows = cylinders.iter().map(|&Cylinder { line, number, parent, .. }| Named { line, number, parent });
    // Some programs count from 0; where a row is number 0, a parent of 0 is that one.
    let (links, order) = forest(origin, rows, 1)?;
    Ok(drafts(&cylinders, &links, &order))
}

/// Where a cylinder is: in which stem, as which of its parts.
#[derive(Clone, Copy, Default)]
struct Place {
    stem: u32,
    part: u32,
}

fn drafts(cylinders: &[Cylinder], links: &Links, order: &[u32]) -> Vec<Draft> {
    let lengths: Vec<f64> = cylinders.iter().map(|c| c.start.distance(c.end)).collect();
    let reaches = links.reaches(order, &lengths);
    let levels = (0..cylinders.len()).map(|row| {
        let order = |row: usize| cylinders[row].order.unwrap_or(-1);
        (order(row), links.parents[row].map(|parent| order(parent as usize)))
    });
    let have_levels = are_levels(levels);
    let mut is_next = vec![false; cylinders.len()];
    let mut places = vec![Place::default(); cylinders.len()];
    let mut stems: Vec<Vec<u32>> = Vec::new();
    for &row in order {
        let next = next(cylinders, links, &lengths, &reaches, row);
        next.into_iter().for_each(|next| is_next[next as usize] = true);
        let parent = links.parents[row as usize].filter(|_| is_next[row as usize]);
        let stem = parent.map_or(stems.len() as u32, |parent| places[parent as usize].stem);
        if parent.is_none() {
            stems.push(Vec::new());
        }
        let parts = &mut stems[stem as usize];
        places[row as usize] = Place { stem, part: parts.len() as u32 };
        parts.push(row);
    }
    // Of each stem, the length up to the base of each of its parts.
    let up_to = |parts: &[u32]| -> Vec<f64> {
        let mut sum = 0.0;
        let mut bottom = cylinders[parts[0] as usize].start;
        let mut sums = vec![0.0];
        for &part in parts {
            sum += bottom.distance(cylinders[part as usize].end);
            bottom = cylinders[part as usize].end;
            sums.push(sum);
        }
        sums
    };
    let heights: Vec<Vec<f64>> = stems.iter().map(|parts| up_to(parts)).collect();
    let draft = |parts: &Vec<u32>| {
        let first = parts[0] as usize;
        let base = &cylinders[first];
        let parent = links.parents[first].map(|parent| {
            let Place { stem, part } = places[parent as usize];
            let (parts, heights) = (&stems[stem as usize], &heights[stem as usize]);
            let below = match part {
                0 => cylinders[parts[0] as usize].start,
                _ => cylinders[parts[part as usize - 1] as usize].end,
            };
            let along = cylinders[parent as usize].end - below;
            let share = (base.start - below).dot(along) / along.length_squared();
            // Without a length there is no share.
            let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
            let (low, high) = (heights[part as usize], heights[part as usize + 1]);
            (stem, low + (high - low) * share)
        });
        let is_fork = have_levels
            && links.parents[first].is_some_and(|parent| cylinders[parent as usize].order == base.order);
        let radii = radii(
            &parts.iter().map(|&p| (cylinders[p as usize].radius, lengths[p as usize])).collect::<Vec<_>>(),
        );
        let mut draft = Draft::new(parent, is_fork, base.line, (base.start, radii[0]));
        for (&part, &radius) in parts.iter().zip(&radii[1..]) {
            draft.push(cylinders[part as usize].end, radius);
        }
        draft
    };
    stems.iter().map(draft).collect()
}

/// The cylinder that goes on as the stem of `row`: the one that the table says, or else the one of the same branch, or
/// the thickest, and of several the one with most above it.
fn next(cylinders: &[Cylinder], links: &Links, lengths: &[f64], reaches: &[f64], row: u32) -> Option<u32> {
    let cylinder = &cylinders[row as usize];
    let children = links.children(row).iter().copied();
    if let Some(extension) = cylinder.extension {
        return children.into_iter().find(|&child| cylinders[child as usize].number == extension);
    }
    if cylinder.branch.is_some() {
        return children.into_iter().find(|&child| cylinders[child as usize].branch == cylinder.branch);
    }
    let rank =
        |child: u32| (cylinders[child as usize].radius, lengths[child as usize] + reaches[child as usize]);
    children.max_by(|&a, &b| {
        let ((thick, far), (other_thick, other_far)) = (rank(a), rank(b));
        // Of equals, the first one.
        thick.total_cmp(&other_thick).then(far.total_cmp(&other_far)).then(b.cmp(&a))
    })
}

/// Radii at the ends of cylinders that follow each other, of which radius and length are given: a radius changes evenly
/// from the middle of one to the middle of the next, and beyond the first and the last middle it goes on so, within half
/// of the radius there.
fn radii(parts: &[(f64, f64)]) -> Vec<f64> {
    let joint = |pair: &[(f64, f64)]| {
        let [(low, low_length), (high, high_length)] = [pair[0], pair[1]];
        let length = low_length + high_length;
        if length > 0.0 { (low * high_length + high * low_length) / length } else { low }
    };
    let mut radii = vec![parts[0].0];
    radii.extend(parts.windows(2).map(joint));
    let (last, _) = parts[parts.len() - 1];
    radii.push(last);
    if parts.len() > 1 {
        let beyond = |radius: f64, joint: f64, least: f64| (2.0 * radius - joint).clamp(least, 1.5 * radius);
        radii[0] = beyond(parts[0].0, radii[1], 0.5 * parts[0].0);
        let end = radii.len() - 1;
        radii[end] = beyond(last, radii[end - 1], 0.0);
    }
    radii
}
