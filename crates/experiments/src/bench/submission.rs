//! Answers of others: a table that names a tree or a picture for each goal.

use super::answer::Answer;
use super::budget::Budget;
use super::goal::{Goal, Origin};
use super::leaderboard;
use super::row::Row;
use super::{BenchOptions, PAGE, TABLE};
use crate::record::{self, Fixed};
use crate::table::Table;
use crate::{progress, stop};
use anyhow::{Context, anyhow, bail, ensure};
use pleach_console::files;
use pleach_silhouette::goal::{Goal as Picture, GoalOptions, Polarity};
use pleach_tree::param::{nearest, shown};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The columns that a table of answers may have.
const COLUMNS: [&str; 6] = ["goal", "species", "seed", "picture", "budget", "seconds"];
/// The rows of answers that were checked.
const CHECKED: &str = "checked.csv";
/// The rows of an exam.
const RESULTS: &str = "results.csv";
/// Seeds must survive JSON.
const MAX_SEED: u64 = crate::spec::MAX_SEED;

/// An answer to a goal.
struct Line {
    /// File and line, for messages.
    place: String,
    /// In the list of goals.
    goal: usize,
    answer: Answer,
    budget: Budget,
    seconds: Option<f64>,
}

/// Measures the answers in `submissions` and gives the leaderboard of them. With a folder `out`, writes `checked.csv`,
/// `leaderboard.csv` and `leaderboard.md` there, and the rows of an exam that is there take part.
///
/// # Errors
/// If a file is not a table of answers to these goals, or cannot be written.
pub fn check_submissions(
    options: &BenchOptions,
    submissions: &[PathBuf],
    out: Option<&Path>,
) -> anyhow::Result<String> {
    let columns = record::columns(&Row::default())?;
    let results = out.map(|out| out.join(RESULTS)).filter(|path| path.exists());
    let mut rows: Vec<Row> = match results {
        Some(path) => Table::read(&path, &columns)?.records()?,
        None => Vec::new(),
    };
    let origins = options.origins()?;
    let names = names(submissions, &rows)?;
    let read: Vec<Vec<Line>> =
        submissions.iter().map(|path| lines(path, &origins)).collect::<anyhow::Result<_>>()?;
    let is_asked = |at: usize| read.iter().flatten().any(|line| line.goal == at);
    let mut goals: Vec<Option<Goal>> = Vec::new();
    for (at, origin) in origins.iter().enumerate() {
        stop::check()?;
        goals.push(is_asked(at).then(|| origin.goal()).transpose()?);
    }
    let goal = |line: &Line| goals[line.goal].as_ref().context("goals that are answered are drawn");
    for line in read.iter().flatten() {
        line.check_size(goal(line)?)?;
    }
    let bar = progress("answers", read.iter().map(Vec::len).sum::<usize>() as u64);
    let mut checked = Vec::new();
    for (name, lines) in names.iter().zip(&read) {
        for line in lines {
            stop::check()?;
            let row = line.answer.row(goal(line)?).with_context(|| line.place.clone())?;
            let wall_s = line.seconds.map(Fixed);
            checked.push(Row { row: name.clone(), budget: line.budget, wall_s, ..row });
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    rows.extend(checked.iter().cloned());
    let page = leaderboard::markdown(&rows);
    if let Some(out) = out {
        files::make_folder(out)?;
        let checked = checked.iter().map(record::to_row).collect::<anyhow::Result<_>>()?;
        Table { columns, rows: checked }.write(&out.join(CHECKED))?;
        leaderboard::table(&rows)?.write(&out.join(TABLE))?;
        files::write_text(&out.join(PAGE), &page)?;
    }
    Ok(page.trim_end().to_owned())
}

/// What each submission is called: its file, without the ending.
fn names(submissions: &[PathBuf], rows: &[Row]) -> anyhow::Result<Vec<String>> {
    let mut names: Vec<String> = Vec::new();
    for path in submissions {
        let name = crate::spec::stem(path);
        let is_taken = names.contains(&name) || rows.iter().any(|row| row.row == name);
        ensure!(!is_taken, "{}: a row is called `{}` already, rename the file", path.display(), shown(&name));
        names.push(name);
    }
    Ok(names)
}

/// The answers of a table; paths in it are from its folder.
fn lines(path: &Path, goals: &[Origin]) -> anyhow::Result<Vec<Line>> {
    // A pipe is not waited for.
    ensure!(path.metadata().is_ok_and(|found| found.is_file()), "{} is not a file", path.display());
    let bytes = pleach_table::load(path).with_context(|| format!("cannot read {}", path.display()))?;
    let file = path.display().to_string();
    let table = pleach_table::Table::new(&file, &bytes).map_err(|error| match error.problem {
        pleach_table::Problem::Empty => anyhow!(
            "{file} is empty, expected a table with the columns goal, species and seed, or goal and picture"
        ),
        _ => error.into(),
    })?;
    let head = format!("{file}:{}", table.first_line());
    for name in table.others(&COLUMNS) {
        if let Some(near) = nearest(&pleach_table::plain(name), COLUMNS) {
            bail!(
                "{head}: no column is called `{}`, did you mean `{near}`? Columns are {}",
                shown(name),
                COLUMNS.join(", ")
            );
        }
    }
    let mut columns = BTreeMap::new();
    for name in COLUMNS {
        columns.extend(table.column(&[name])?.map(|at| (name, at)));
    }
    let has = |name: &str| columns.contains_key(name);
    ensure!(has("goal"), "{head}: the column `goal` is missing");
    ensure!(has("species") || has("picture"), "{head}: a column `species` or `picture` is missing");
    let folder = path.parent().unwrap_or(Path::new(""));
    let (mut found, mut seen): (Vec<Line>, BTreeMap<(usize, String), u64>) = Default::default();
    for row in table.rows() {
        let row = row?;
        let number = row.line();
        // Numbers with decimal commas are as good as those with points.
        let seconds = columns.get("seconds").map(|&at| row.number(at)).transpose()?.flatten();
        let seconds = seconds.map(|seconds| seconds.to_string());
        let mut cells: BTreeMap<&str, &str> = columns
            .iter()
            .map(|(name, at)| (*name, row.text(*at)))
            .filter(|(name, cell)| *name != "seconds" && !cell.is_empty())
            .collect();
        cells.extend(seconds.as_deref().map(|seconds| ("seconds", seconds)));
        let place = format!("{file}:{number}");
        let line = line(&cells, goals, folder).map_err(|error| anyhow!("{place}: {error:#}"))?;
        let line = Line { place, ..line };
        let goal = &goals[line.goal];
        if let Some(first) = seen.insert((line.goal, line.budget.to_string()), number) {
            bail!("{file}:{number}: the goal `{}` is there twice, first in line {first}", goal.name());
        }
        found.push(line);
    }
    ensure!(!found.is_empty(), "{file} has no answer, expected a line for each goal after the first line");
    Ok(found)
}

/// The answer of a line with these cells.
fn line(cells: &BTreeMap<&str, &str>, goals: &[Origin], folder: &Path) -> anyhow::Result<Line> {
    let cell = |name: &str| cells.get(name).copied();
    let name = cell("goal").context("the cell `goal` is empty, expected the name of a goal")?;
    let Some(goal) = goals.iter().position(|goal| goal.name() == name) else {
        let names: Vec<String> = goals.iter().map(Origin::name).collect();
        let near = nearest(name, names.iter().map(String::as_str));
        let near = near.map_or_else(String::new, |near| format!(", did you mean `{near}`?"));
        bail!("no goal is called `{}`{near}; `pleach bench --goals DIR` writes a list of all", shown(name));
    };
    let seed = cell("seed").map(|text| {
        let seed = text.parse::<u64>().ok().filter(|seed| *seed <= MAX_SEED);
        seed.with_context(|| {
            format!("`seed` is `{}`, expected a whole number from 0 to {MAX_SEED}", shown(text))
        })
    });
    let answer = match (cell("species"), cell("picture")) {
        (Some(species), None) => tree(species, seed.transpose()?, folder)?,
        (None, Some(file)) => {
            ensure!(seed.is_none(), "a `seed` is beside a `picture`, expected it beside a `species`");
            picture(&folder.join(file))?
        }
        (Some(_), Some(_)) => bail!("there are both a `species` and a `picture`, expected one of them"),
        (None, None) => bail!("there is neither a `species` nor a `picture`, expected one of them"),
    };
    let budget = cell("budget").unwrap_or_default().parse().map_err(anyhow::Error::msg)?;
    let seconds = cell("seconds").map(|text| {
        let seconds = text.parse::<f64>().ok().filter(|seconds| seconds.is_finite() && *seconds >= 0.0);
        seconds.with_context(|| format!("`seconds` is `{}`, expected a number from 0", shown(text)))
    });
    Ok(Line { place: String::new(), goal, answer, budget, seconds: seconds.transpose()? })
}

/// The tree of a species file in `folder`, or of a known species; without a seed, of the one in the file, or of 1.
fn tree(species: &str, seed: Option<u64>, folder: &Path) -> anyhow::Result<Answer> {
    let file = folder.join(species);
    let looks_like_a_file = file.extension().is_some() || file.exists();
    let species = match looks_like_a_file {
        true => pleach_generators::read_file(&file)?,
        false => pleach_generators::species(species)?,
    };
    let seed = seed.or(species.tree_seed).unwrap_or(1);
    Ok(Answer::tree(species, seed))
}

/// A silhouette: dark on light, or opaque on transparent.
fn picture(path: &Path) -> anyhow::Result<Answer> {
    let options = GoalOptions { polarity: Polarity::DarkTree, ..GoalOptions::default() };
    Ok(Answer::Picture(Picture::load(path, &options)?.bitmap))
}

impl Line {
    /// A picture has the size of its goal.
    fn check_size(&self, goal: &Goal) -> anyhow::Result<()> {
        let Answer::Picture(picture) = &self.answer else { return Ok(()) };
        let [own, expected] =
            [picture, goal.picture()].map(|one| format!("{} × {}", one.width(), one.height()));
        let (place, name) = (&self.place, &goal.name);
        ensure!(
            own == expected,
            "{place}: the picture is {own} pixels, expected {expected} as the goal `{name}` is"
        );
        Ok(())
    }
}
