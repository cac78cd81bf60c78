//! Spoilt input of every sort: does it end in a clear refusal or in a sound result?
//!
//! Cases are addressed: case `n` of an area is the same in every run. They are counted in blocks, so
//! that a slice can be compared with the whole.

mod areas;
mod mutate;
mod verdict;
mod worker;

use super::record::{self, Fixed};
use super::spec::Source;
use super::within::{Real, Seconds, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use areas::Area;
use pleach_console::{files, output};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use verdict::Verdict;
use worker::Judged;

/// The outcomes of a block of cases. Those from `unclear` to `over_time` should be 0 throughout.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Block {
    area: String,
    block: u64,
    cases: usize,
    accepted: usize,
    refused: usize,
    unclear: usize,
    wrong: usize,
    panics: usize,
    over_time: usize,
    wall_cpu_s: Fixed<2>,
    wall_slowest_s: Fixed<2>,
    wall_peak_mb: Option<u64>,
}

impl Block {
    /// Counts of cases, in the order of the columns.
    const fn counts(&self) -> [usize; 7] {
        let Self { cases, accepted, refused, unclear, wrong, panics, over_time, .. } = *self;
        [cases, accepted, refused, unclear, wrong, panics, over_time]
    }
}

/// Where failing inputs are kept, to be debugged.
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
    #[serde(default)]
    grammars: Option<Whole<0, 100_000>>,
}

impl RobustnessSpec {
    pub(super) fn checked(self, _: &Source) -> anyhow::Result<Self> {
        Ok(self)
    }

    fn areas(&self) -> anyhow::Result<Vec<(Arc<dyn Area>, u64)>> {
        let Blocks { species, parameters, pictures, checkpoints, experiments, grammars } = &self.blocks;
        Ok(vec![
            (Arc::new(areas::SpeciesFiles::new()), **species),
            (Arc::new(areas::Parameters::new()), **parameters),
            (Arc::new(areas::Pictures::new()?), **pictures),
            (Arc::new(areas::Checkpoints::new()?), **checkpoints),
            (Arc::new(areas::Experiments), **experiments),
            (Arc::new(areas::Grammars::new()?), grammars.as_ref().map_or(0, |blocks| **blocks)),
        ])
    }
}

impl Kind for RobustnessSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Block::default())
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
                let is_of = |row: &Block| (row.area.as_str(), row.block) == (area.name(), block);
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
                    Ok(vec![counted(area.name(), block, judged.values())])
                })?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, _: &Outputs) -> anyhow::Result<String> {
        let columns = self.columns()?;
        let heading = columns.iter().filter(|name| *name != "block");
        let mut lines = vec![heading.map(|name| name.trim_start_matches("wall_").to_owned()).collect()];
        let rows: Vec<Block> = table.records()?;
        for (area, _) in self.areas()? {
            let of: Vec<&Block> = rows.iter().filter(|row| row.area == area.name()).collect();
            let mut sums = [0; 7];
            for row in &of {
                sums.iter_mut().zip(row.counts()).for_each(|(sum, count)| *sum += count);
            }
            let time = of.iter().map(|row| row.wall_cpu_s.0).sum::<f64>() + 0.0;
            let slowest = of.iter().map(|row| row.wall_slowest_s.0).fold(0.0, f64::max);
            let peak = of.iter().filter_map(|row| row.wall_peak_mb).max().unwrap_or(0);
            let line = std::iter::once(area.name().to_owned()).chain(sums.map(|sum| sum.to_string()));
            let times = [format!("{time:.1}"), slowest.to_string(), peak.to_string()];
            lines.push(line.chain(times).collect::<Vec<_>>());
        }
        Ok(output::table(&lines, &(1..columns.len()).collect::<Vec<_>>()))
    }
}

/// The description of a bad verdict.
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
fn counted<'a>(area: &str, block: u64, judged: impl Iterator<Item = &'a Judged> + Clone) -> Block {
    let count = |is: fn(&Verdict) -> bool| judged.clone().filter(|j| is(&j.verdict)).count();
    let seconds = |time: Duration| Fixed(time.as_secs_f64());
    Block {
        area: area.to_owned(),
        block,
        cases: count(|_| true),
        accepted: count(|v| matches!(v, Verdict::Accepted)),
        refused: count(|v| matches!(v, Verdict::Refused)),
        unclear: count(|v| matches!(v, Verdict::Unclear(_))),
        wrong: count(|v| matches!(v, Verdict::Wrong(_))),
        panics: count(|v| matches!(v, Verdict::Panicked(_))),
        over_time: count(|v| matches!(v, Verdict::OverTime)),
        wall_cpu_s: seconds(judged.clone().map(|j| j.cpu).sum()),
        wall_slowest_s: seconds(judged.clone().map(|j| j.cpu).max().unwrap_or_default()),
        wall_peak_mb: worker::peak_megabytes(),
    }
}
