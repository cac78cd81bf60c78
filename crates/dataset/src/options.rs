//! What is asked for, and whether it can be.

use crate::error::DatasetError;
use pleach_fit::{Freedom, Prior};
use pleach_silhouette::View;
use std::str::FromStr;

/// The format of the shards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// NumPy arrays, stacked over the trees of a shard.
    #[default]
    Npz,
    /// A tar file with some files for each tree, as WebDataset reads it.
    WebDataset,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 2] = [Self::Npz, Self::WebDataset];

    /// Its name in options and manifests.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Npz => "npz",
            Self::WebDataset => "webdataset",
        }
    }

    /// How the names of its files end.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Npz => "npz",
            Self::WebDataset => "tar",
        }
    }
}

/// What is saved of a tree beside its numbers and silhouettes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Silhouettes of the stems alone, in the frames of the whole tree.
    Wood,
    /// How far the tree is from the viewer, pixel by pixel.
    Depth,
    /// The knots of all stems.
    Skeleton,
}

impl Layer {
    /// Every layer.
    pub const ALL: [Self; 3] = [Self::Wood, Self::Depth, Self::Skeleton];

    /// Its name in options and manifests.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wood => "wood",
            Self::Depth => "depth",
            Self::Skeleton => "skeleton",
        }
    }
}

/// The value of this name, or what would have been one.
fn named<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str, text: &str) -> Result<T, String> {
    let found = all.iter().copied().find(|&one| name(one) == text);
    let known = || all.iter().map(|&one| name(one)).collect::<Vec<_>>().join(", ");
    found.ok_or_else(|| format!("`{text}` is not one of {}", known()))
}

impl FromStr for Format {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        named(&Self::ALL, Self::name, text)
    }
}

impl FromStr for Layer {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        named(&Self::ALL, Self::name, text)
    }
}

/// What a data set holds.
#[derive(Clone, Debug, PartialEq)]
pub struct DatasetOptions {
    /// Trees of each species, 1 to [`DatasetOptions::MAX_COUNT`].
    pub count: u32,
    /// Azimuths of the views in degrees, level and without perspective; at most [`DatasetOptions::MAX_VIEWS`].
    pub views: Vec<f64>,
    /// Height and width of every picture in pixels, [`DatasetOptions::MIN_SIZE`] to [`DatasetOptions::MAX_SIZE`].
    pub size: u32,
    /// What is saved beside numbers and silhouettes. Order and repetitions do not matter.
    pub layers: Vec<Layer>,
    /// The format of the shards.
    pub format: Format,
    /// Draws of each shard, 1 or more. A shard holds as many trees, less those that do not grow.
    pub shard: u32,
    /// Standard deviation of each number, as a part of its plausible range: see [`Prior::new`].
    pub spread: f64,
    /// Which numbers vary.
    pub freedom: Freedom,
    /// The seed of the draws, at most 2⁵³.
    pub seed: u64,
}

impl Default for DatasetOptions {
    fn default() -> Self {
        Self {
            count: 1000,
            views: vec![0.0, 90.0],
            size: 96,
            layers: Vec::new(),
            format: Format::default(),
            shard: 1000,
            spread: Prior::SPREAD,
            freedom: Freedom::default(),
            seed: 1,
        }
    }
}

impl DatasetOptions {
    /// Largest number of trees of each species.
    pub const MAX_COUNT: u32 = 10_000_000;
    /// Largest number of views.
    pub const MAX_VIEWS: usize = 64;
    /// Smallest side of a picture in pixels.
    pub const MIN_SIZE: u32 = 8;
    /// Largest side of a picture in pixels.
    pub const MAX_SIZE: u32 = 4096;
    /// Largest number of draws of a shard.
    pub const MAX_SHARD: u32 = 1_000_000;
    /// Largest size in bytes of the arrays of a shard: programs that make or load one have it in memory.
    pub const MAX_SHARD_BYTES: u64 = 2 << 30;
    /// Largest number of shards: the manifest, which lists them, is written after each.
    pub const MAX_SHARDS: u64 = 10_000;
    /// Largest seed: one that JSON and species files keep.
    pub const MAX_SEED: u64 = 1 << 53;

    /// Whether `layer` is asked for.
    #[must_use]
    pub fn has(&self, layer: Layer) -> bool {
        self.layers.contains(&layer)
    }

    /// Bytes of the pictures of one tree, as arrays.
    #[must_use]
    pub fn picture_bytes(&self) -> u64 {
        let pixels = u64::from(self.size) * u64::from(self.size) * self.views.len() as u64;
        let bytes = 1 + u64::from(self.has(Layer::Wood)) + 4 * u64::from(self.has(Layer::Depth));
        pixels * bytes
    }

    /// Draws of a data set of so many species.
    pub(crate) fn draws(&self, species: usize) -> u64 {
        u64::from(self.count) * species as u64
    }

    /// Shards of a data set of so many species.
    pub(crate) fn shards(&self, species: usize) -> u64 {
        self.draws(species).div_ceil(u64::from(self.shard))
    }

    pub(crate) fn views(&self) -> impl Iterator<Item = View> + '_ {
        self.views.iter().map(|&azimuth| View::degrees(azimuth, 0.0))
    }

    /// Checks every option for a data set of so many species.
    ///
    /// # Errors
    /// The first that cannot be, and what would be right.
    pub fn check(&self, species: usize) -> Result<(), DatasetError> {
        within("count", self.count, 1, Self::MAX_COUNT)?;
        within("size", self.size, Self::MIN_SIZE, Self::MAX_SIZE)?;
        within("shard", self.shard, 1, Self::MAX_SHARD)?;
        let views = self.views.len();
        if !(1..=Self::MAX_VIEWS).contains(&views) {
            let problem = format!("has {views} azimuths; expected 1 to {}, such as 0,90", Self::MAX_VIEWS);
            return Err(DatasetError::option("view", problem));
        }
        if let Some(azimuth) = self.views.iter().find(|azimuth| !azimuth.is_finite()) {
            return Err(DatasetError::option("view", format!("has {azimuth}; expected azimuths in degrees")));
        }
        if !(0.0..=Prior::MAX_SPREAD).contains(&self.spread) {
            let problem = format!("is {}; expected a number from 0 to {}", self.spread, Prior::MAX_SPREAD);
            return Err(DatasetError::option("spread", problem));
        }
        if self.seed > Self::MAX_SEED {
            let problem = format!("is {}; expected a whole number from 0 to {}", self.seed, Self::MAX_SEED);
            return Err(DatasetError::option("seed", problem));
        }
        let one = self.picture_bytes();
        let trees = u64::from(self.shard).min(self.draws(species));
        if one * trees > Self::MAX_SHARD_BYTES {
            let (megabytes, most) = ((one * trees) >> 20, Self::MAX_SHARD_BYTES / one);
            let problem = format!(
                "is {}: the pictures of a shard would have {megabytes} MB in memory, at most {} MB are \
                 allowed; {}",
                self.shard,
                Self::MAX_SHARD_BYTES >> 20,
                if most == 0 {
                    "smaller pictures or fewer views".to_owned()
                } else {
                    format!("choose {most} or less")
                }
            );
            return Err(DatasetError::option("shard", problem));
        }
        if self.shards(species) > Self::MAX_SHARDS {
            let problem = format!(
                "is {}: there would be {} shards, at most {} are allowed; choose {} or more",
                self.shard,
                self.shards(species),
                Self::MAX_SHARDS,
                self.draws(species).div_ceil(Self::MAX_SHARDS)
            );
            return Err(DatasetError::option("shard", problem));
        }
        Ok(())
    }
}

fn within(option: &'static str, value: u32, min: u32, max: u32) -> Result<(), DatasetError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(DatasetError::option(option, format!("is {value}; expected {min} to {max}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_is_said_with_what_would_be_right() {
        let usual = DatasetOptions::default;
        for (options, words) in [
            (DatasetOptions { count: 0, ..usual() }, "`count` is 0; expected 1 to 10000000"),
            (DatasetOptions { size: 0, ..usual() }, "`size` is 0; expected 8 to 4096"),
            (DatasetOptions { size: 100_000, ..usual() }, "`size` is 100000; expected 8 to 4096"),
            (DatasetOptions { shard: 0, ..usual() }, "`shard` is 0"),
            (DatasetOptions { views: Vec::new(), ..usual() }, "`view` has 0 azimuths"),
            (DatasetOptions { views: vec![0.0; 65], ..usual() }, "`view` has 65 azimuths; expected 1 to 64"),
            (DatasetOptions { views: vec![f64::NAN], ..usual() }, "`view` has NaN"),
            (DatasetOptions { spread: f64::NAN, ..usual() }, "`spread` is NaN"),
            (DatasetOptions { spread: -1.0, ..usual() }, "`spread` is -1; expected a number from 0 to 10"),
            (DatasetOptions { seed: u64::MAX, ..usual() }, "`seed` is 18446744073709551615"),
            (
                DatasetOptions { size: 4096, layers: vec![Layer::Depth], ..usual() },
                "`shard` is 1000: the pictures of a shard would have 160000 MB in memory, at most 2048 MB are \
                 allowed; choose 12 or less",
            ),
            (
                DatasetOptions { size: 4096, views: vec![0.0; 64], layers: Layer::ALL.to_vec(), ..usual() },
                "smaller pictures or fewer views",
            ),
            (DatasetOptions { count: 10_000_000, shard: 10, ..usual() }, "choose 2000 or more"),
        ] {
            let told = options.check(2).unwrap_err().to_string();
            assert!(told.contains(words), "{told}");
        }
        usual().check(2).unwrap();
        // A shard that is never full needs no memory.
        DatasetOptions { size: 1024, count: 3, shard: 1_000_000, ..usual() }.check(2).unwrap();
    }

    #[test]
    fn names_are_read_back() {
        assert!(Format::ALL.into_iter().all(|one| one.name().parse() == Ok(one)));
        assert!(Layer::ALL.into_iter().all(|one| one.name().parse() == Ok(one)));
        assert_eq!("leaves".parse::<Layer>(), Err("`leaves` is not one of wood, depth, skeleton".to_owned()));
    }
}
