//! Spoilt input of every sort: does it end in a clear refusal or in a sound result?
//!
//! Cases are addressed: case `n` of an area is the same in every run. They are counted in blocks, so
//! that a slice can be compared with the whole.

mod areas;
mod mutate;
mod worker;

use super::spec::Source;
use super::within::{Real, Seconds, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use areas::Area;
use pleach_console::{files, output};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use worker::{Judged, Verdict};

const COLUMNS: [&str; 12] = [
    "area",
    "block",
    "cases",
    "accepted",
    "refused",
    "unclear",
    "wrong",
    "panics",
    "over_time",
    "wall_cpu_s",
    "wall_slowest_s",
    "wall_peak_mb",
];

/// Columns that should be 0 throughout, behind those of cases, accepted and refused.
const COUNTS: usize = 7;
/// Where inputs that were found are kept, for who mends it.
const FINDINGS: &str = "findings";
/// Most inputs of an area that are kept in a run.
const SHOWN: usize = 5;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobustnessSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Cases of a row.
    block: Whole<10, 100_000>,
    /// Processor's time that a case may take.
    seconds: Real<Seconds>,
    /// Blocks of each area.
    blocks: Blocks,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Blocks {
    species: Whole<0, 100_000>,
    parameters: Whole<0, 100_000>,
    pictures: Whole<0, 100_000>,
    checkpoints: Whole<0, 100_000>,
    experiments: Whole<0, 100_000>,
}

impl RobustnessSpec {
    pub(super) fn checked(self, _: &Source) -> anyhow::Result<Self> {
        Ok(self)
    }

    fn areas(&self) -> anyhow::Result<Vec<(Arc<dyn Area>, u64)>> {
        let Blocks { species, parameters, pictures, checkpoints, experiments } = &self.blocks;
        Ok(vec![
            (Arc::new(areas::SpeciesFiles::new()), **species),
            (Arc::new(areas::Parameters::new()), **parameters),
            (Arc::new(areas::Pictures::new()?), **pictures),
            (Arc::new(areas::Checkpoints::new()?), **checkpoints),
            (Arc::new(areas::Experiments), **experiments),
        ])
    }
}

impl Kind for RobustnessSpec {
    fn columns(&self) -> Vec<&'static str> {
        COLUMNS.to_vec()
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (Vec::new(), Vec::new())
    }

    /// A slice is the first blocks of each area.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let threads = rayon::current_num_threads();
        let limit = Duration::from_secs_f64(*self.seconds);
        let areas = self.areas()?;
        let most = slice.repetitions.unwrap_or(u64::MAX);
        let bar = progress("blocks", areas.iter().map(|(_, blocks)| *blocks.min(&most)).sum());
        let keeps = journal.is_kept();
        for (area, blocks) in &areas {
            let mut shown = 0;
            for block in 0..*blocks.min(&most) {
                let key = [area.name().to_owned(), block.to_string()];
                let is_of = |row: &[String]| row[..2] == key;
                let first = block * *self.block;
                journal.job(is_of, || {
                    let judged =
                        worker::quietly(|| worker::run(area, first..first + *self.block, threads, limit))?;
                    for (case, Judged { verdict, .. }) in &judged {
                        if let Some(finding) = finding(verdict).filter(|_| shown < SHOWN) {
                            shown += 1;
                            output::note(format!("{} {case}: {finding}", area.name()));
                            if keeps {
                                let file =
                                    files::inside(&folder.join(FINDINGS), format!("{}-{case}", area.name()))?;
                                files::write_whole(&file, |out| Ok(out.write_all(&area.input(*case))?))?;
                            }
                        }
                    }
                    Ok(vec![row(&key, judged.values())])
                })?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, _: &Outputs) -> anyhow::Result<String> {
        let heading = ["area"].iter().chain(&COLUMNS[2..]);
        let mut lines = vec![heading.map(|name| name.trim_start_matches("wall_").to_owned()).collect()];
        for (area, _) in self.areas()? {
            let of: Vec<&Vec<String>> = table.rows.iter().filter(|row| row[0] == area.name()).collect();
            let values = |column: usize| of.iter().filter_map(move |row| row[column].parse::<f64>().ok());
            let sums = (2..2 + COUNTS).map(|column| (values(column).sum::<f64>() + 0.0).to_string());
            let time = format!("{:.1}", values(2 + COUNTS).sum::<f64>() + 0.0);
            let most = |column: usize| values(column).fold(0.0, f64::max).to_string();
            let line = std::iter::once(area.name().to_owned()).chain(sums).chain([
                time,
                most(3 + COUNTS),
                most(4 + COUNTS),
            ]);
            lines.push(line.collect::<Vec<_>>());
        }
        Ok(output::table(&lines, &(1..COLUMNS.len()).collect::<Vec<_>>()))
    }
}

/// What there is to say about a verdict that should not be.
fn finding(verdict: &Verdict) -> Option<String> {
    let (what, message) = match verdict {
        Verdict::Accepted | Verdict::Refused => return None,
        Verdict::OverTime => return Some("over the time".to_owned()),
        Verdict::Unclear(message) => ("unclear", message),
        Verdict::Wrong(message) => ("wrong", message),
        Verdict::Panicked(message) => ("panicked", message),
    };
    // The message may be the finding: no control characters, and not all of it.
    Some(format!("{what}: {:.300?}", message.chars().take(300).collect::<String>()))
}

/// The row of a block.
fn row<'a>(key: &[String; 2], judged: impl Iterator<Item = &'a Judged> + Clone) -> Vec<String> {
    let count = |is: fn(&Verdict) -> bool| judged.clone().filter(|j| is(&j.verdict)).count().to_string();
    let cpu = judged.clone().map(|j| j.cpu).sum::<Duration>();
    let slowest = judged.clone().map(|j| j.cpu).max().unwrap_or_default();
    let counts = [
        count(|_| true),
        count(|v| matches!(v, Verdict::Accepted)),
        count(|v| matches!(v, Verdict::Refused)),
        count(|v| matches!(v, Verdict::Unclear(_))),
        count(|v| matches!(v, Verdict::Wrong(_))),
        count(|v| matches!(v, Verdict::Panicked(_))),
        count(|v| matches!(v, Verdict::OverTime)),
    ];
    let times = [cpu, slowest].map(|time| format!("{:.2}", time.as_secs_f64()));
    let peak = worker::peak_megabytes().map_or_else(String::new, |mb| mb.to_string());
    key.iter().cloned().chain(counts).chain(times).chain([peak]).collect()
}
