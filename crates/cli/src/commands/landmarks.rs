//! Which species a map or a blend is made of, and how they are laid out: shared by `map` and `blend`.

use crate::choice::{Choice, one_of};
use crate::{input, output};
use anyhow::{Context, bail};
use pleach_blend::{BlendError, BlendMap, Encoding, Point, Settings, looks};
use pleach_tree::{Family, Species};
use std::path::{Path, PathBuf};

/// Where dots stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Layout {
    /// By parameters: the two principal components
    #[default]
    Numbers,
    /// By how alike the silhouettes are
    Looks,
}

const FEATURES: &[Choice<Encoding>] = &[
    ("declared", "By what their declarations say they mean", Encoding::Declared),
    ("raw", "As the plain list of numbers, the dissertation's way", Encoding::Raw),
];

/// Species and layout of a map.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "The map")]
pub(super) struct MapArgs {
    /// Your own species beside the built-in ones: a file, or a folder of .toml files; may be repeated
    #[arg(long, value_name = "PATH")]
    species: Vec<PathBuf>,
    /// All built-in species instead of the fifteen of the dissertation
    #[arg(long)]
    all: bool,
    /// The built-in species of this generator that have the same parameters
    #[arg(long, value_name = "NAME", value_parser = pleach_generators::family, conflicts_with_all = ["all", "only"])]
    generator: Option<&'static dyn Family>,
    /// Only these built-in species
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', conflicts_with = "all")]
    only: Option<Vec<String>>,
    /// Leave out broken species files, with a note for each
    #[arg(long)]
    keep_going: bool,
    /// Where the dots stand
    #[arg(long, value_enum, default_value_t)]
    layout: Layout,
    /// How numbers are compared and averaged
    #[arg(long, value_parser = one_of(FEATURES), default_value = "declared")]
    features: Encoding,
}

impl MapArgs {
    /// The map of the chosen species, and of `more` where they are not among them.
    pub(super) fn map(&self, more: &[Species]) -> anyhow::Result<BlendMap> {
        let mut species = self.built_in()?;
        species.extend(self.own_species()?);
        for one in more {
            if !species.iter().any(|s| s.name == one.name && s.params == one.params) {
                species.push(one.clone());
            }
        }
        let features = self.features();
        let dots = match self.layout {
            Layout::Numbers => None,
            Layout::Looks => Some(by_looks(&species)?),
        };
        let map = BlendMap::new(species, Settings { features, dots })?;
        let all = map.landmarks().species();
        for (i, one) in all.iter().enumerate() {
            if let Some(twin) = all[..i].iter().find(|s| s.params == one.params) {
                output::note(format!(
                    "`{}` and `{}` have the same parameters and share a dot",
                    twin.name, one.name
                ));
            }
        }
        Ok(map)
    }

    /// The species of `--species`.
    pub(super) fn own_species(&self) -> anyhow::Result<Vec<Species>> {
        let mut species = Vec::new();
        for path in &self.species {
            for file in files_of(path)? {
                match pleach_generators::read_file(&file) {
                    Ok(read) => species.push(read),
                    Err(error) if self.keep_going => output::note(format!("left out: {error}")),
                    Err(error) => {
                        return Err(error).with_context(|| {
                            format!("{} is not a species; --keep-going leaves it out", file.display())
                        });
                    }
                }
            }
        }
        Ok(species)
    }

    /// How numbers are compared and averaged.
    pub(super) const fn features(&self) -> Encoding {
        self.features
    }

    /// Refuses options that choose or place the species of a map, where no map is asked for. `--species`
    /// and `--all` are allowed: shares may name such species.
    pub(super) fn refuse_without_map(&self, has_shares: bool) -> anyhow::Result<()> {
        let given = [
            ("--layout", self.layout != Layout::default()),
            ("--only", self.only.is_some()),
            ("--generator", self.generator.is_some()),
            ("--all", self.all && !has_shares),
            ("--species", !self.species.is_empty() && !has_shares),
            ("--keep-going", self.keep_going && self.species.is_empty()),
        ];
        if let Some((option, _)) = given.iter().find(|(_, given)| *given) {
            bail!(
                "{option} is about the map, and this blend is made without one: add --across-the-map, or leave \
                 {option} out"
            );
        }
        Ok(())
    }

    fn built_in(&self) -> anyhow::Result<Vec<Species>> {
        if let Some(names) = &self.only {
            return names.iter().map(|name| Ok(input::species(name)?)).collect();
        }
        if let Some(family) = self.generator {
            return of_one_model(family);
        }
        if self.all {
            return Ok(pleach_generators::presets(pleach_generators::default_family()));
        }
        Ok(pleach_generators::HEWITT_2017.iter().filter_map(|name| pleach_generators::preset(name)).collect())
    }
}

/// The species of `family` that have the same parameters. Where not all have, as those of different
/// grammars, the largest group, and a note about the others.
fn of_one_model(family: &dyn Family) -> anyhow::Result<Vec<Species>> {
    let mut groups: Vec<Vec<Species>> = Vec::new();
    for species in pleach_generators::presets(family) {
        let model = species.generator.model();
        match groups.iter_mut().find(|group| group[0].generator.model() == model) {
            Some(group) => group.push(species),
            None => groups.push(vec![species]),
        }
    }
    groups.retain(|group| group.len() >= 2);
    // The first of the largest.
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    let mut groups = groups.into_iter();
    let largest = groups.next().with_context(|| {
        format!("no two species of {} have the same parameters: there is nothing between them", family.name())
    })?;
    for other in groups {
        let names: Vec<&str> = other.iter().map(|species| species.name.as_str()).collect();
        output::note(format!("other parameters, so not on this map: --only {}", names.join(",")));
    }
    Ok(largest)
}

fn by_looks(species: &[Species]) -> anyhow::Result<Vec<Point>> {
    if species.len() < 2 {
        return Err(BlendError::TooFew { found: species.len() }.into());
    }
    let unlike = looks::unlikeness(species)?;
    let dots = looks::scale(&unlike);
    output::note(format!(
        "the plane shows {:.0} % of the differences between the silhouettes (stress {:.2})",
        100.0 * (1.0 - looks::stress(&unlike, &dots)),
        looks::stress(&unlike, &dots)
    ));
    Ok(dots)
}

/// Whether a path names a folder: it ends in a slash, or there is one.
pub(super) fn names_folder(path: &Path) -> bool {
    path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) || path.is_dir()
}

/// A file itself, or the species files of a folder by name.
fn files_of(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let unreadable = || format!("cannot read the folder {}", path.display());
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).with_context(unreadable)? {
        let file = entry.with_context(unreadable)?.path();
        if file.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            files.push(file);
        }
    }
    if files.is_empty() {
        bail!("{} holds no .toml file", path.display());
    }
    files.sort();
    Ok(files)
}
