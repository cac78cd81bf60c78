//! What several commands read from their arguments.

use crate::{converter, output};
use pleach::{FitOptions, PictureSource};
use pleach_fit::Prior;
use pleach_generators::RegistryError;
use pleach_silhouette::View;
use pleach_silhouette::goal::Encoded;
use pleach_tree::{Foliage, Limits, Species};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;

/// A species by name or file, or from standard input by `-`.
pub(crate) fn species(name: &str) -> Result<Species, RegistryError> {
    if name == "-" {
        return pleach_generators::read(std::io::stdin().lock(), "stdin");
    }
    let species = pleach_generators::species(name)?;
    note_untranslated(name);
    Ok(species)
}

/// Notes that the file of another program has entries that its species here does not have.
pub(crate) fn note_untranslated(name: &str) {
    let path = Path::new(name);
    if path.extension().is_none_or(|ending| ending == "toml") {
        return;
    }
    let Ok(file) = std::fs::File::open(path) else { return };
    if let Ok((_, foreign)) = pleach_generators::import(file, name)
        && !foreign.without_counterpart.is_empty()
    {
        output::note(format!(
            "{name} has entries without a counterpart here: {}; `pleach import` tells more",
            foreign.without_counterpart.join(", ")
        ));
    }
}

/// Whether a path means standard input or standard output: `-`.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// A picture that is not yet decoded, from a file or, for `-`, from standard input. A picture of a telephone is converted.
pub(crate) fn picture(path: &Path) -> anyhow::Result<Encoded> {
    if is_standard(path) {
        return Ok(Encoded::read("standard input", std::io::stdin().lock())?);
    }
    Encoded::load(path).or_else(|error| converter::converted(path, error))
}

/// Those of the pictures that `options` name that have to be converted, by their names.
pub(crate) fn converted_pictures(options: &FitOptions) -> anyhow::Result<BTreeMap<String, PictureSource>> {
    let mut converted = BTreeMap::new();
    for name in options.pictures() {
        let path = Path::new(name);
        // A pipe is read once, by who wants its picture.
        if !converted.contains_key(name)
            && path.is_file()
            && let Some(error) = converter::reason(path)
        {
            let _ = converted.insert(name.to_owned(), converter::converted(path, error)?.into());
        }
    }
    Ok(converted)
}

/// The name for results made from a picture: the file's name without its extension, or `stdin`. `None` if
/// the path has no file name.
pub(crate) fn stem(path: &Path) -> Option<&OsStr> {
    if is_standard(path) { Some("stdin".as_ref()) } else { path.file_stem() }
}

/// Seeds must survive a round trip through a species file and JSON: below 2⁵³.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    let most = 1_u64 << 53;
    match text.parse::<u64>() {
        Ok(seed) if seed <= most => Ok(seed),
        _ => Err(format!("a seed is a whole number from 0 to {most}")),
    }
}

/// How far numbers of a prior lie from those of its species.
pub(crate) fn spread(text: &str) -> Result<f64, String> {
    let most = Prior::MAX_SPREAD;
    let value = text.parse().ok().filter(|value| (0.0..=most).contains(value));
    value.ok_or_else(|| format!("`{text}` is not a number from 0 to {most}"))
}

/// `A..B`: from A up to but not including B.
pub(crate) fn seeds(text: &str) -> Result<Range<u64>, String> {
    let hint = || format!("`{text}` is not a range of seeds, expected A..B with A below B, such as 0..100");
    let (from, to) = text.split_once("..").ok_or_else(hint)?;
    let range = seed(from)?..seed(to)?;
    if range.is_empty() { Err(hint()) } else { Ok(range) }
}

/// `AZ` or `AZ,EL` in degrees.
pub(crate) fn view(text: &str) -> Result<View, String> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let (azimuth, elevation) = text.split_once(',').unwrap_or((text, "0"));
    match (number(azimuth), number(elevation)) {
        (Some(azimuth), Some(elevation)) if (-90.0..=90.0).contains(&elevation) => {
            Ok(View::degrees(azimuth, elevation))
        }
        _ => {
            Err("expected azimuth, or azimuth,elevation, in degrees, the elevation from -90 to 90".to_owned())
        }
    }
}

/// Whether trees get leaves: what the species file says, unless the command line says otherwise.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct LeafArgs {
    /// Grow stems only
    #[arg(long)]
    no_leaves: bool,
    /// Grow leaves, also where the species file says that its trees are bare
    #[arg(long, conflicts_with = "no_leaves")]
    leafy: bool,
}

impl LeafArgs {
    /// Whether leaves of `species` are grown.
    pub(crate) fn foliage(self, species: &Species) -> Foliage {
        match (self.no_leaves, self.leafy) {
            (true, _) => Foliage::None,
            (_, true) => Foliage::All,
            _ => species.foliage,
        }
    }
}

/// Notes that `species` asks for leaves which cannot grow.
pub(crate) fn note_leafless(species: &Species, foliage: Foliage) {
    let leafless = species.generator.leafless(species.params.values());
    if let (Foliage::All, Some(leafless)) = (foliage, leafless) {
        output::note(format!("{} has no leaves: {leafless}", species.name));
    }
}

/// Bounds on the size of a tree.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct LimitArgs {
    /// A tree with more stems is an error
    #[arg(long, value_name = "N", default_value_t = Limits::default().stems, help_heading = "Limits")]
    max_stems: usize,
    /// A tree with more leaves and blossoms is an error
    #[arg(long, value_name = "N", default_value_t = Limits::default().leaves, help_heading = "Limits")]
    max_leaves: usize,
    /// A tree that takes more steps to grow is an error; by default 40000000, raised in
    /// proportion to the other limits
    #[arg(long, value_name = "N", help_heading = "Limits")]
    max_work: Option<u64>,
}

impl LimitArgs {
    pub(crate) fn limits(self) -> Limits {
        let usual = Limits::DEFAULT;
        let knots_per_stem = usual.knots / usual.stems;
        // A user who asks for more than the usual limits means it.
        let larger = (self.max_stems / usual.stems).max(self.max_leaves / usual.leaves).max(1);
        Limits {
            stems: self.max_stems,
            leaves: self.max_leaves,
            knots: self.max_stems.saturating_mul(knots_per_stem),
            work: self.max_work.unwrap_or_else(|| usual.work.saturating_mul(larger as u64)),
        }
    }
}
