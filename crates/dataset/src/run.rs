//! Shard after shard.

use crate::columns::Columns;
use crate::error::DatasetError;
use crate::example::{self, Example, Maker, Memory, SkeletonKnot};
use crate::failures::{self, Failure, Failures};
use crate::folder::{Folder, MANIFEST, shard_name};
use crate::manifest::{Head, Shard};
use crate::options::{DatasetOptions, Format};
use crate::{npz, webdataset};
use pleach_tree::Species;
use rayon::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What is done with a folder that holds files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// It is refused.
    #[default]
    New,
    /// The data set in it is gone on with; a new one begins in an empty folder.
    Resume,
    /// The data set in it is removed.
    Overwrite,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Draws that are done, those of earlier runs included.
    pub done: u64,
    /// All draws.
    pub all: u64,
}

/// How a caller follows and stops a run.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Once it is true, the run ends with [`DatasetError::Interrupted`].
    pub stop: &'a AtomicBool,
    /// Is told of every draw, on any thread.
    pub progress: &'a (dyn Fn(Progress) + Sync),
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control").field("stop", self.stop).finish_non_exhaustive()
    }
}

/// What a run has written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Trees of all shards.
    pub trees: u64,
    /// Draws that gave none.
    pub failures: u64,
    /// Shards.
    pub shards: u64,
    /// Shards that an earlier run had finished.
    pub kept: u64,
}

/// Writes the data set of trees around `species` into `folder`, on the threads of the current pool.
///
/// # Errors
/// Every variant of [`DatasetError`]. Shards that were finished before stay valid.
pub fn write(
    species: &[Species],
    options: &DatasetOptions,
    folder: &Path,
    mode: Mode,
    control: &Control<'_>,
) -> Result<Written, DatasetError> {
    let species: Vec<Species> = species.iter().map(Species::kind).collect();
    let names: Vec<String> = species.iter().map(|one| one.name.clone()).collect();
    if names.is_empty() {
        return Err(DatasetError::NoSpecies);
    }
    if let Some((_, name)) = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
        return Err(DatasetError::Twice { name: name.clone() });
    }
    options.check(names.len())?;
    let priors = example::priors(&species, options)?;
    let columns = Columns::new(&species);
    let head = Head::new(&species, &priors, options, &columns);
    let maker = Maker { options, priors: &priors, columns: &columns };
    let mut run = Run::open(folder, mode, maker, &names, head, control)?;
    run.write_all()?;
    let written = run.written();
    if written.trees == 0 {
        return Err(DatasetError::NoTrees { draws: written.failures });
    }
    Ok(written)
}

/// A data set that is being written.
struct Run<'a> {
    folder: Folder,
    maker: Maker<'a>,
    names: &'a [String],
    head: Head,
    control: &'a Control<'a>,
    draws: u64,
    /// Finished shards, in order.
    shards: Vec<Shard>,
    /// Shards of an earlier run; the first of [`Self::shards`].
    kept: u64,
    failures: Failures,
}

impl<'a> Run<'a> {
    fn open(
        path: &Path,
        mode: Mode,
        maker: Maker<'a>,
        names: &'a [String],
        head: Head,
        control: &'a Control<'a>,
    ) -> Result<Self, DatasetError> {
        let folder = Folder::open(path)?;
        let draws = maker.options.draws(names.len());
        let mut run = Self {
            folder,
            maker,
            names,
            head,
            control,
            draws,
            shards: Vec::new(),
            kept: 0,
            failures: Failures::new(),
        };
        if mode != Mode::New {
            run.folder.remove_temporaries()?;
        }
        let is_empty = run.folder.is_empty()?;
        match mode {
            Mode::New if !is_empty => return Err(DatasetError::NotEmpty { folder: path.to_owned() }),
            Mode::Overwrite => run.folder.clear()?,
            Mode::Resume if !is_empty => run.keep()?,
            _ => {}
        }
        Ok(run)
    }

    fn shard_draws(&self) -> u64 {
        u64::from(self.maker.options.shard)
    }

    fn all_shards(&self) -> u64 {
        self.maker.options.shards(self.names.len())
    }

    /// Keeps what an earlier run has finished, up to the first shard that is not as it was written.
    fn keep(&mut self) -> Result<(), DatasetError> {
        let Some(shards) = self.head.read(&self.folder)? else {
            let problem = "it is missing".to_owned();
            return Err(DatasetError::Manifest { path: self.folder.at(MANIFEST), problem });
        };
        self.failures = failures::read(&self.folder, self.names, self.shard_draws())?;
        for (number, shard) in (0..self.all_shards()).zip(shards) {
            let found = self.folder.digest(&shard_name(number, self.maker.options.format))?;
            let is_whole = found == Some((shard.bytes, shard.sha256.clone()));
            let failed = self.failures.get(&number).map_or(0, Vec::len) as u64;
            if !is_whole || failed != shard.failures {
                break;
            }
            self.shards.push(shard);
        }
        self.kept = self.shards.len() as u64;
        self.failures.retain(|&number, _| number < self.kept);
        Ok(())
    }

    fn write_all(&mut self) -> Result<(), DatasetError> {
        let all = self.all_shards();
        if self.kept == 0 {
            // So that a run that is killed in its first shard can be gone on with.
            self.save(true)?;
        }
        for number in self.kept..all {
            let (trees, failed) = self.make(number)?;
            self.write_shard(number, &trees, failed)?;
        }
        // A run that was killed between a shard and the manifest may have left a table with more rows.
        self.save(true)
    }

    /// Writes the table of failures, if it is another one, and then the manifest.
    fn save(&self, failures_changed: bool) -> Result<(), DatasetError> {
        if failures_changed {
            failures::write(&self.folder, &self.maker, self.names, &self.failures)?;
        }
        let complete = self.shards.len() as u64 == self.all_shards();
        self.head.write(&self.folder, (self.draws, complete), &self.shards)
    }

    /// The trees of a shard, and the draws that gave none, in the order of draws.
    fn make(&self, number: u64) -> Result<(Vec<Example>, Vec<Failure>), DatasetError> {
        let Control { stop, progress } = self.control;
        let first = number * self.shard_draws();
        let draws = first..(first + self.shard_draws()).min(self.draws);
        let (done, skeletons) = (AtomicU64::new(first), AtomicU64::new(0));
        let limit = DatasetOptions::MAX_SHARD_BYTES;
        let made = |memory: &mut Memory, draw| {
            // The order in which threads count does not matter: the sum is the same.
            if stop.load(Ordering::Relaxed) || skeletons.load(Ordering::Relaxed) > limit {
                return None;
            }
            let example = self.maker.example(draw, memory);
            if let Ok(example) = &example {
                let bytes = example.skeleton.len() * size_of::<SkeletonKnot>();
                skeletons.fetch_add(bytes as u64, Ordering::Relaxed);
            }
            progress(Progress { done: done.fetch_add(1, Ordering::Relaxed) + 1, all: self.draws });
            Some((draw, example))
        };
        let made: Vec<_> = draws.into_par_iter().map_init(Memory::new, made).collect();
        if skeletons.into_inner() > limit {
            return Err(DatasetError::Skeletons { shard: number, limit });
        }
        let (mut trees, mut failed) = (Vec::new(), Vec::new());
        for one in made {
            match one {
                None => return Err(DatasetError::Interrupted { shards: number, all: self.all_shards() }),
                Some((_, Ok(example))) => trees.push(example),
                Some((draw, Err(error))) => failed.push(Failure { draw, reason: error.to_string() }),
            }
        }
        Ok((trees, failed))
    }

    fn write_shard(
        &mut self,
        number: u64,
        trees: &[Example],
        failed: Vec<Failure>,
    ) -> Result<(), DatasetError> {
        let options = self.maker.options;
        let name = shard_name(number, options.format);
        self.folder.write(&name, |file| match options.format {
            Format::Npz => npz::write(file, options, self.maker.columns.names.len(), trees),
            Format::WebDataset => webdataset::write(file, options, self.names, trees),
        })?;
        let Some((bytes, sha256)) = self.folder.digest(&name)? else {
            let gone = std::io::ErrorKind::NotFound.into();
            return Err(DatasetError::io(&self.folder.at(&name), "is gone")(gone));
        };
        let failures = failed.len() as u64;
        self.shards.push(Shard { file: name, trees: trees.len() as u64, failures, bytes, sha256 });
        if failures > 0 {
            let _ = self.failures.insert(number, failed);
        }
        self.save(failures > 0)
    }

    fn written(&self) -> Written {
        let sum = |count: fn(&Shard) -> u64| self.shards.iter().map(count).sum();
        Written {
            trees: sum(|shard| shard.trees),
            failures: sum(|shard| shard.failures),
            shards: self.shards.len() as u64,
            kept: self.kept,
        }
    }
}
