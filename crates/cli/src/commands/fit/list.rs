//! Goals with options of their own, from a CSV file.

use super::super::corrections;
use super::args::GoalArgs;
use super::values::{self, ViewArg};
use crate::choice::word;
use crate::{output, text};
use anyhow::{Context, anyhow, bail, ensure};
use pleach::MaskFrom;
use pleach_table::{Problem, Table, TableError, plain};
use pleach_tree::param::nearest;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A column of a list of goals: its name, and how a cell that is not empty changes the options.
struct Column {
    name: &'static str,
    /// Whether cells are numbers, which may have a decimal comma.
    is_number: bool,
    set: fn(&mut GoalArgs, &str, &Path) -> Result<(), String>,
}

/// The column that names the goal.
const FILE: &str = "file";

const COLUMNS: [Column; 11] = [
    Column {
        name: "height",
        is_number: true,
        set: |args, cell, _| values::height(cell).map(|height| args.height = height),
    },
    Column {
        name: "view",
        is_number: false,
        set: |args, cell, _| {
            let view: ViewArg = cell.parse()?;
            if matches!(view, ViewArg::Further(_)) {
                return Err("further pictures of one tree are not for lists".to_owned());
            }
            args.view = vec![view];
            Ok(())
        },
    },
    Column {
        name: "mask",
        is_number: false,
        set: |args, cell, folder| {
            let cell = if cell == "auto" { cell.to_owned() } else { folder.join(cell).display().to_string() };
            args.mask = cell.parse::<MaskFrom>().ok();
            args.mask_command = None;
            Ok(())
        },
    },
    Column {
        name: "tree",
        is_number: false,
        set: |args, cell, _| {
            args.tree = word(values::TONES, cell)?;
            Ok(())
        },
    },
    Column {
        name: "ground_row",
        is_number: true,
        set: |args, cell, _| number(cell).map(|row| args.ground_row = Some(row)),
    },
    Column {
        name: "axis_column",
        is_number: true,
        set: |args, cell, _| number(cell).map(|column| args.axis_column = Some(column)),
    },
    Column {
        name: "leaves",
        is_number: false,
        set: |args, cell, _| {
            args.leaves = word(values::LEAVES, cell)?;
            args.no_leaves = false;
            Ok(())
        },
    },
    Column {
        name: "trunks",
        is_number: true,
        set: |args, cell, _| corrections::trunks(cell).map(|count| args.corrections.trunks = Some(count)),
    },
    Column {
        name: "trunk_width",
        is_number: true,
        set: |args, cell, _| corrections::width(cell).map(|width| args.corrections.trunk_width = Some(width)),
    },
    Column {
        name: "lean",
        is_number: true,
        set: |args, cell, _| corrections::lean(cell).map(|lean| args.corrections.lean = Some(lean)),
    },
    Column {
        name: "bare_height",
        is_number: true,
        set: |args, cell, _| corrections::share(cell).map(|bare| args.corrections.bare_height = Some(bare)),
    },
];

fn number(cell: &str) -> Result<f64, String> {
    cell.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| "expected a number".to_owned())
}

/// A goal of a list, as it stands there.
struct Row {
    line: u64,
    goal: PathBuf,
    /// Cells that are not empty, with their columns.
    cells: Vec<(&'static Column, String)>,
}

/// The goals of the list at `path` with their options: those of `defaults` where a cell is empty.
pub(super) fn read(path: &Path, defaults: &GoalArgs) -> anyhow::Result<Vec<(PathBuf, GoalArgs)>> {
    let folder = folder(path);
    let mut goals = Vec::new();
    let (rows, others) = rows(path)?;
    if !others.is_empty() {
        let others: Vec<_> = others.iter().map(|heading| format!("`{}`", text::shown(heading))).collect();
        output::note(format!("{}: columns that are not read: {}", text::path(path), others.join(", ")));
    }
    for Row { line, goal, cells } in rows {
        let mut args = defaults.clone();
        for (column, cell) in cells {
            if let Err(message) = (column.set)(&mut args, &cell, folder) {
                bail!("{}:{line}: {}: `{cell}`: {message}", path.display(), column.name);
            }
        }
        goals.push((goal, args));
    }
    Ok(goals)
}

/// The goals of the list at `path`.
pub(in crate::commands) fn goals(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    Ok(rows(path)?.0.into_iter().map(|row| row.goal).collect())
}

/// Paths in a list are relative to its folder.
fn folder(list: &Path) -> &Path {
    list.parent().unwrap_or(Path::new(""))
}

/// The rows of the list at `path`, and the headings of columns that are not read.
fn rows(path: &Path) -> anyhow::Result<(Vec<Row>, Vec<String>)> {
    let name = text::path(path).to_string();
    let bytes = pleach_table::load(path).with_context(|| format!("cannot read {name}"))?;
    let known = || COLUMNS.iter().map(|column| column.name).collect::<Vec<_>>().join(", ");
    let headless =
        |line| anyhow!("{name}:{line}: expected a header with the column `{FILE}` and any of {}", known());
    let table = Table::new(&name, &bytes).map_err(|error| match error.problem {
        Problem::Empty => headless(error.line),
        _ => error.into(),
    })?;
    let names: Vec<&str> = [FILE].into_iter().chain(COLUMNS.iter().map(|column| column.name)).collect();
    let line = table.first_line();
    let others: Vec<String> = table.others(&names).map(str::to_owned).collect();
    let Some(file) = table.column(&[FILE])? else {
        let Some(first) = others.first() else { return Err(headless(line)) };
        bail!(
            "{name}:{line}: `{}` is not a column of a list of goals; expected {FILE} and any of {}",
            text::shown(first),
            known()
        );
    };
    for other in &others {
        // A word that is misspelt, or another unit, would change a goal without a word.
        if let Some(near) = nearest(&plain(other), names.iter().copied()) {
            bail!(
                "{name}:{line}: `{}` is not a column of a list of goals, did you mean `{near}`? Columns are {FILE} and any of {}; \
                 lengths are metres and angles degrees",
                text::shown(other),
                known()
            );
        }
    }
    let columns = COLUMNS.iter().map(|column| Ok(table.column(&[column.name])?.map(|at| (column, at))));
    let columns: Vec<(&'static Column, usize)> =
        columns.filter_map(Result::transpose).collect::<Result<_, TableError>>()?;
    let mut lines = BTreeMap::new();
    let mut rows = Vec::new();
    for row in table.rows() {
        let row = row?;
        let line = row.line();
        let goal = Some(row.text(file)).filter(|cell| !cell.is_empty()).map(text::from_cell);
        let goal = goal.with_context(|| format!("{name}:{line}: `{FILE}` is empty"))?;
        if let Some(first) = lines.insert(goal.clone().into_owned(), line) {
            bail!("{name}:{line}: {} is listed twice, first in line {first}", text::shown(&goal));
        }
        let mut cells = Vec::new();
        for &(column, at) in columns.iter().filter(|(_, at)| !row.text(*at).is_empty()) {
            let cell = match column.is_number {
                true => row.number(at)?.map(|number| number.to_string()),
                false => Some(row.text(at).to_owned()),
            };
            cells.extend(cell.map(|cell| (column, cell)));
        }
        rows.push(Row { line, goal: folder(path).join(&*goal), cells });
    }
    ensure!(!rows.is_empty(), "{name} lists no goal");
    Ok((rows, others))
}
