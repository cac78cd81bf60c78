//! Whether what is read in a picture of a tree is so.

mod ciede2000;
mod judged;
mod pictures;
mod report;
mod trees;

use super::record;
use super::spec::{Seed, Source};
use super::within::Whole;
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use anyhow::Context;
use judged::Read;
use pleach_reading::{Reader, Reading, annotate};
use pleach_silhouette::picture::{Picture, sheet_of_pictures};
use pleach_tree::Parts;
use rayon::prelude::*;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::{Path, PathBuf};
use trees::{Case, draw};

const SHEET: &str = "wrong.png";
/// Pictures on the sheet, and across it.
const SHOWN: usize = 24;
const COLUMNS: usize = 6;
/// The families that the trees are of: a family more would change all of them.
const FAMILIES: [&str; 5] = ["weber-penn", "lsystem", "fractal", "least-cost-path", "stylised"];
/// Trees of which one job is made.
const JOB: usize = 20;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReadingSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Number of trees, as many of each of [`FAMILIES`].
    trees: Whole<5, 100_000>,
    /// Seed of the first tree; the next one has the next seed.
    first_seed: Seed,
}

impl ReadingSpec {
    pub(super) fn checked(self, _: &Source) -> anyhow::Result<Self> {
        Ok(self)
    }

    /// Tree number `number`, from 0, and its family.
    fn case(&self, number: usize) -> anyhow::Result<(&'static str, Case)> {
        let family = FAMILIES[number % FAMILIES.len()];
        let of_family = |name: &&str| {
            pleach_generators::preset(name).is_some_and(|species| species.generator.family() == family)
        };
        let names: Vec<&str> = trees::names().into_iter().filter(of_family).collect();
        let turn = number / FAMILIES.len();
        let name = names.get(turn % names.len().max(1)).context("every family has trees")?;
        let seed = *self.first_seed + number as u64;
        let part = |purpose| draw(seed, purpose);
        let case = Case {
            name: (*name).to_owned(),
            seed,
            lean: if part(1) < 0.5 { 40.0 * part(2) - 20.0 } else { 0.0 },
            stems: if part(3) < 0.15 { 2 + (3.0 * part(4)) as usize } else { 1 },
            parts: if part(5) < 0.3 { Parts::BARE } else { Parts::LEAFY },
            size: if part(6) < 0.2 { 600 } else { 256 },
        };
        Ok((family, case))
    }
}

impl Kind for ReadingSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Read::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (vec![SHEET.to_owned()], Vec::new())
    }

    /// A row for each tree that grows; a slice has the first ones.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let all: Vec<usize> = (0..slice.take_of(*self.trees as usize)).collect();
        let bar = progress("trees", all.len() as u64);
        for numbers in all.chunks(JOB) {
            let cases: Vec<(usize, &str, Case)> = numbers
                .iter()
                .map(|&number| self.case(number).map(|(family, case)| (number + 1, family, case)))
                .collect::<anyhow::Result<_>>()?;
            journal.job(
                |row: &Read| numbers.contains(&(row.tree - 1)),
                || {
                    let read = |reader: &mut Reader, (number, family, case): &(usize, &str, Case)| {
                        Read::new(*number, family, case, reader)
                    };
                    let read: Vec<Option<Read>> = cases.par_iter().map_init(Reader::new, read).collect();
                    Ok(read.into_iter().flatten().collect())
                },
            )?;
            bar.inc(numbers.len() as u64);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Read> = table.records()?;
        outputs.picture(SHEET, &self.sheet(&rows)?)?;
        Ok(report::table(&rows))
    }
}

impl ReadingSpec {
    /// The first trees whose feet were miscounted although they are seen: what was read in their pictures.
    fn sheet(&self, rows: &[Read]) -> anyhow::Result<Picture> {
        let wrong = rows.iter().filter(|row| row.feet_seen && !row.has_feet()).take(SHOWN);
        let mut cells = Vec::new();
        for row in wrong {
            let (_, case) = self.case(row.tree - 1)?;
            let tree = case.grow().context("it grew before")?;
            let (picture, _) = judged::silhouette(&Case { size: 256, ..case }, &tree);
            let label = format!("{}: {} for {}", row.species, row.feet, row.true_feet);
            cells.push((label, annotate(&picture, &Reading::from_silhouette(&picture))));
        }
        let cells: Vec<(&str, Picture)> =
            cells.iter().map(|(label, picture)| (label.as_str(), picture.clone())).collect();
        Ok(sheet_of_pictures(&cells, COLUMNS))
    }
}
