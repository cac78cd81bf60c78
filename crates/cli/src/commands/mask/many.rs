//! Masks of many photographs: a folder of pictures and a table.

use super::{Found, MaskCommand};
use crate::{files, input, output, text};
use anyhow::{Context, bail, ensure};
use pleach_silhouette::goal::GoalWarning;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The table of all masks, in their folder.
const TABLE: &str = "masks.csv";

/// A column's name, and its value of a mask that was made.
type Column = (&'static str, fn(&Job, &Found) -> String);

/// The columns of the table. Without a mask only `file` and `error` are filled.
const COLUMNS: [Column; 9] = [
    ("file", |job, _| cell(job.photo)),
    ("mask", |job, _| cell(&job.mask)),
    ("confidence", |_, found| format!("{:.4}", found.confidence)),
    ("ink", |_, found| format!("{:.6}", found.ink)),
    ("ground_row", |_, found| found.ground_row.to_string()),
    ("trunk_column", |_, found| found.axis_column.to_string()),
    ("top_row", |_, found| found.top_row.to_string()),
    ("touches", |_, found| found.touches.join(" ")),
    ("warnings", |_, found| kinds(&found.warnings).join(" ")),
];
const ERROR: &str = "error";
/// In the place of a confidence, so that photographs without a mask come first.
const FAILED: f64 = -1.0;

/// A path as a cell of the table.
fn cell(path: &Path) -> String {
    text::cell(&path.to_string_lossy()).into_owned()
}

fn kinds(warnings: &[GoalWarning]) -> Vec<&'static str> {
    warnings.iter().map(GoalWarning::kind).collect()
}

/// A photograph and where its mask goes.
struct Job<'a> {
    photo: &'a Path,
    mask: PathBuf,
    overlay: Option<PathBuf>,
}

/// A line of JSON: what was found, with its files.
#[derive(Serialize)]
struct Line<'a> {
    file: String,
    mask: String,
    #[serde(flatten)]
    found: &'a Found,
}

/// Makes a mask of each photograph.
pub(super) fn run(command: &MaskCommand, photos: &[PathBuf]) -> anyhow::Result<()> {
    let out = &command.out;
    ensure!(
        command.seed_point.is_none() || photos.len() == 1,
        "a --seed-point belongs to one photograph, and there are {}",
        photos.len()
    );
    ensure!(
        command.hints.is_empty() || photos.len() == 1,
        "a --box, points and strokes belong to one photograph, and there are {}",
        photos.len()
    );
    for folder in std::iter::once(out).chain(&command.overlay) {
        let is_file = folder.is_file() || folder.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
        if (is_file && !folder.is_dir()) || input::is_standard(folder) {
            bail!(
                "{} is a single file, and {} photographs need a folder, such as masks/",
                folder.display(),
                photos.len()
            );
        }
    }
    ensure!(command.overlay.as_ref() != Some(out), "masks and overlays would be the same files");
    let jobs = jobs(photos, out, command.overlay.as_deref())?;
    for folder in std::iter::once(out).chain(&command.overlay) {
        files::make_folder(folder)?;
    }

    let head = COLUMNS.iter().map(|(name, _)| *name).chain([ERROR]);
    let mut rows: Vec<(f64, Vec<String>)> = Vec::new();
    let mut failed = Vec::new();
    for (i, job) in jobs.iter().enumerate() {
        let name = format!("[{}/{}] {}", i + 1, jobs.len(), text::path(job.photo));
        match one(command, job) {
            Ok(found) => {
                let mut line =
                    format!("{name}: confidence {:.2}, {:.1} % ink", found.confidence, 100.0 * found.ink);
                if !found.warnings.is_empty() {
                    line += &format!("; {}", kinds(&found.warnings).join(", "));
                }
                output::note(line);
                if command.json {
                    let (file, mask) = (job.photo.display().to_string(), job.mask.display().to_string());
                    output::json(&Line { file, mask, found: &found })?;
                }
                let cells = COLUMNS.iter().map(|(_, value)| value(job, &found)).chain([String::new()]);
                rows.push((found.confidence, cells.collect()));
            }
            Err(error) => {
                let why = output::causes(&error, ": ");
                output::note(format!("{name}: failed: {why}"));
                let mut row: Vec<String> = vec![String::new(); COLUMNS.len() + 1];
                row[0] = cell(job.photo);
                row[COLUMNS.len()] = text::cell(&why).into_owned();
                rows.push((FAILED, row));
                failed.push(text::path(job.photo).to_string());
            }
        }
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let table = out.join(TABLE);
    files::write_whole(&table, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(head)?;
        rows.iter().try_for_each(|(_, row)| csv.write_record(row))?;
        Ok(csv.flush()?)
    })?;
    if !command.json {
        output::line(format!("masks  {}", text::path(&table)))?;
    }
    ensure!(
        failed.is_empty(),
        "{} of {} photographs have no mask: {}",
        failed.len(),
        jobs.len(),
        failed.join(", ")
    );
    Ok(())
}

/// A job for each photograph; an error if two would share a mask, or if a mask would replace a photograph.
fn jobs<'a>(photos: &'a [PathBuf], out: &Path, overlays: Option<&Path>) -> anyhow::Result<Vec<Job<'a>>> {
    let mut seen = BTreeMap::new();
    let mut jobs = Vec::new();
    for photo in photos {
        let stem = input::stem(photo)
            .with_context(|| format!("{} has no file name to call its mask by", photo.display()))?;
        let mut name = stem.to_owned();
        name.push(".png");
        let job = Job { photo, mask: out.join(&name), overlay: overlays.map(|folder| folder.join(&name)) };
        if let Some(other) = seen.insert(stem, photo) {
            bail!(
                "{} and {} would both become {}: rename one, or use two folders",
                other.display(),
                photo.display(),
                job.mask.display()
            );
        }
        jobs.push(job);
    }
    let places: BTreeSet<PathBuf> = photos.iter().filter_map(|photo| photo.canonicalize().ok()).collect();
    for made in jobs.iter().flat_map(|job| std::iter::once(&job.mask).chain(&job.overlay)) {
        if made.canonicalize().is_ok_and(|made| places.contains(&made)) {
            bail!("{} is one of the photographs: choose another folder", made.display());
        }
    }
    Ok(jobs)
}

fn one(command: &MaskCommand, job: &Job) -> anyhow::Result<Found> {
    let made = command.make(job.photo)?;
    made.write(&job.mask)?;
    if let Some(path) = &job.overlay {
        made.write_overlay(path)?;
    }
    Ok(made.found())
}
