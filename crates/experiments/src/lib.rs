//! Experiments: folders with a description of what to run, and its results.
//!
//! `experiment.toml` says what to run, `results.csv` has a row for every repetition. Columns whose
//! names begin with `wall_` depend on the clock and are never compared.

mod bench;
mod blend;
mod families;
mod fits;
mod fresh;
mod growth;
mod individual;
mod journal;
mod kind;
mod kinds;
mod likeness;
mod list;
mod measures;
mod needle;
mod outputs;
mod part;
mod perturbed;
mod photographs;
mod pictured;
mod plot;
mod posterior;
mod reading;
mod record;
mod robustness;
mod rules;
mod spearman;
mod spec;
mod stop;
mod stylised;
mod table;
mod treefit;
mod truth;
mod within;
mod yao;

use anyhow::bail;
use journal::Journal;
use kind::Kind;
use kinds::Spec;
use outputs::Outputs;
use pleach_console::progress::bar as progress;
use spec::Source;
use std::path::Path;
use table::Table;

pub use bench::{BenchOptions, check_submissions, hand_out};
pub use kind::Slice;
pub use list::{FOLDER, list};
pub use part::Part;
pub use stop::raise as stop;

impl Spec {
    fn kind(&self) -> &dyn Kind {
        match self {
            Self::Fits(spec) => spec,
            Self::Growth(spec) => spec,
            Self::Blend(spec) => spec,
            Self::Likeness(spec) => spec,
            Self::Treefit(spec) => spec,
            Self::Needle(spec) => spec,
            Self::Yao(spec) => spec,
            Self::Robustness(spec) => spec,
            Self::Individual(spec) => spec,
            Self::Rules(spec) => spec,
            Self::Families(spec) => spec,
            Self::Stylised(spec) => spec,
            Self::Reading(spec) => spec,
            Self::Photographs(spec) => spec,
            Self::Posterior(spec) => spec,
            Self::Perturbed(spec) => spec,
            Self::Bench(spec) => spec,
        }
    }
}

/// Runs the experiment in `folder`, writes results, plots and pictures into it, and gives the report.
///
/// # Errors
/// If the folder has no `experiment.toml` that can be run, if an unfinished run is there and `part` says
/// neither to resume nor to overwrite it, if a file cannot be written, or what the experiment runs into.
/// After [`stop`](fn@stop) it is [`Interrupted`](pleach_console::interrupted::Interrupted).
pub fn run(folder: &Path, part: &Part) -> anyhow::Result<String> {
    let source = Source::read(folder)?;
    let spec = Spec::read(&source)?;
    let kind = spec.kind();
    let columns = kind.columns()?;
    let (written, read) = kind.files(folder);
    // Checked now and not hours later. An input that is not in the folder may be the name of a species.
    if let Some(missing) = read.iter().find(|path| path.starts_with(folder) && !path.exists()) {
        bail!("cannot use {}: there is no such file", missing.display());
    }
    let outputs = Outputs::declare(folder, written, read)?;
    let kept = match (&spec, part.methods.is_empty()) {
        (_, true) => Vec::new(),
        (Spec::Treefit(spec), false) => spec.rows_of_others(folder, &part.methods)?,
        (_, false) => bail!("--method is for experiments of kind treefit"),
    };
    let mut journal = Journal::open(folder, &source.text, &columns, part)?;
    journal.know(kept, treefit::Fit::is_same)?;
    kind.rows(folder, Slice::default(), &mut journal).map_err(|error| journal.told(error))?;
    let table = journal.table();
    // Pictures may take a while as well: rows stay in the journal until all is written.
    let report = kind.report(folder, &table, &outputs).map_err(|error| journal.told(error))?;
    outputs.results(&table)?;
    Ok(report)
}

/// Runs a slice of the experiment in `folder` again and compares it with the `results.csv` there, time
/// columns apart. Gives the number of rows, which all agree.
///
/// # Errors
/// If a row is not in the results, or as [`run`].
pub fn check(folder: &Path, slice: Slice) -> anyhow::Result<usize> {
    let spec = Spec::read(&Source::read(folder)?)?;
    let kind = spec.kind();
    let mut journal = Journal::unkept(&kind.columns()?);
    kind.rows(folder, slice, &mut journal)?;
    let table = journal.table();
    table.check(&folder.join("results.csv"))?;
    Ok(table.rows.len())
}
