//! Goals with options of their own, from a CSV file.

use super::super::corrections;
use super::args::GoalArgs;
use super::values::{self, ViewArg};
use crate::choice::word;
use crate::text;
use anyhow::{Context, bail, ensure};
use pleach::MaskFrom;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A column of a list of goals: its name, and how a cell that is not empty changes the options.
struct Column {
    name: &'static str,
    set: fn(&mut GoalArgs, &str, &Path) -> Result<(), String>,
}

/// The column that names the goal.
const FILE: &str = "file";

const COLUMNS: [Column; 10] = [
    Column { name: "height", set: |args, cell, _| values::height(cell).map(|height| args.height = height) },
    Column {
        name: "view",
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
        set: |args, cell, folder| {
            let cell = if cell == "auto" { cell.to_owned() } else { folder.join(cell).display().to_string() };
            args.mask = cell.parse::<MaskFrom>().ok();
            args.mask_command = None;
            Ok(())
        },
    },
    Column {
        name: "tree",
        set: |args, cell, _| {
            args.tree = word(values::TONES, cell)?;
            Ok(())
        },
    },
    Column { name: "ground_row", set: |args, cell, _| number(cell).map(|row| args.ground_row = Some(row)) },
    Column {
        name: "axis_column",
        set: |args, cell, _| number(cell).map(|column| args.axis_column = Some(column)),
    },
    Column {
        name: "leaves",
        set: |args, cell, _| {
            args.leaves = word(values::LEAVES, cell)?;
            args.no_leaves = false;
            Ok(())
        },
    },
    Column {
        name: "trunks",
        set: |args, cell, _| corrections::trunks(cell).map(|count| args.corrections.trunks = Some(count)),
    },
    Column {
        name: "lean",
        set: |args, cell, _| corrections::lean(cell).map(|lean| args.corrections.lean = Some(lean)),
    },
    Column {
        name: "bare_height",
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
    for Row { line, goal, cells } in rows(path)? {
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
    Ok(rows(path)?.into_iter().map(|row| row.goal).collect())
}

/// Paths in a list are relative to its folder.
fn folder(list: &Path) -> &Path {
    list.parent().unwrap_or(Path::new(""))
}

fn rows(path: &Path) -> anyhow::Result<Vec<Row>> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let header = reader.headers().with_context(|| format!("cannot read {}", path.display()))?.clone();
    let known = || COLUMNS.iter().map(|column| column.name).collect::<Vec<_>>().join(", ");
    for name in header.iter().filter(|name| *name != FILE) {
        ensure!(
            COLUMNS.iter().any(|column| column.name == name),
            "{}:1: `{name}` is not a column of a list of goals; expected {FILE} and any of {}",
            path.display(),
            known()
        );
    }
    let Some(file) = header.iter().position(|name| name == FILE) else {
        bail!("{}:1: expected a header with the column `{FILE}` and any of {}", path.display(), known());
    };
    let mut lines = BTreeMap::new();
    let mut rows = Vec::new();
    for record in reader.records() {
        // The error of the reader names the line.
        let record = record.with_context(|| format!("cannot read {}", path.display()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let goal = record.get(file).filter(|cell| !cell.is_empty()).map(text::from_cell);
        let goal = goal.with_context(|| format!("{}:{line}: `{FILE}` is empty", path.display()))?;
        if let Some(first) = lines.insert(goal.clone().into_owned(), line) {
            bail!("{}:{line}: {} is listed twice, first in line {first}", path.display(), text::shown(&goal));
        }
        let column = |name: &str| COLUMNS.iter().find(|column| column.name == name);
        let cells = header.iter().zip(&record).filter(|(_, cell)| !cell.is_empty());
        let cells = cells.filter_map(|(name, cell)| Some((column(name)?, cell.to_owned()))).collect();
        rows.push(Row { line, goal: folder(path).join(&*goal), cells });
    }
    ensure!(!rows.is_empty(), "{} lists no goal", path.display());
    Ok(rows)
}
