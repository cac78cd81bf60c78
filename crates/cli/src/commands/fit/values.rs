//! Arguments of `fit` that are more than a number, as they are typed.

use crate::choice::Choice;
use crate::input;
use pleach::{AppearanceFrom, Direction, FurtherView, KnownFrame, Leaves, Tone, TreeSeed};
use pleach_fit::Azimuth;
use std::num::NonZeroU32;
use std::str::FromStr;

/// Words of `--tree`.
pub(in crate::commands) const TONES: &[Choice<Tone>] = &[
    ("auto", "Whichever does not fill the border", Tone::Auto),
    ("dark", "The darker one", Tone::Dark),
    ("light", "The lighter one", Tone::Light),
];

/// Words of `--appearance`.
pub(super) const APPEARANCES: &[Choice<AppearanceFrom>] = &[
    ("picture", "From the picture, where it has colours", AppearanceFrom::Picture),
    ("species", "From the species that the fit started from", AppearanceFrom::Species),
];

/// Words of `--leaves`.
pub(super) const LEAVES: &[Choice<Leaves>] = &[
    (
        "auto",
        "With --from auto if the goal looks more like trees with leaves than like bare ones; with --from SPECIES as its \
         file says",
        Leaves::Auto,
    ),
    ("on", "Always", Leaves::On),
    ("off", "Never: the goal is a bare tree", Leaves::Off),
];

/// What `--view` says: a direction, or a further picture.
#[derive(Clone, Debug)]
pub(super) enum ViewArg {
    /// That of the goal itself.
    Own(Direction),
    /// That of another picture.
    Further(FurtherView),
}

impl FromStr for ViewArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text.contains('=') {
            return text.parse().map(Self::Further);
        }
        if text == "auto" || text.starts_with('~') {
            return Err(
                "azimuths are counted from the goal's, which is known: expected a further picture, such as \
                        auto=side.png"
                    .to_owned(),
            );
        }
        let own: Result<Direction, _> = text.parse();
        own.map(Self::Own).map_err(|error| format!("{error}; or auto=FILE, ~AZ=FILE"))
    }
}

/// A further picture from a direction that is known.
pub(super) fn known_view(text: &str) -> Result<FurtherView, String> {
    let view: FurtherView = text.parse()?;
    if view.azimuth == Azimuth::Known {
        return Ok(view);
    }
    Err("its direction has to be known, since it is not fitted: expected one such as 90=side.png".to_owned())
}

/// A part of the goals: the `index`-th of `count`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shard {
    pub(super) index: usize,
    pub(super) count: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.split_once('/')
            .and_then(|(index, count)| Some(Self { index: index.parse().ok()?, count: count.parse().ok()? }))
            .filter(|shard| (1..=shard.count).contains(&shard.index))
            .ok_or_else(|| "expected I/N with I from 1 to N, such as 2/8".to_owned())
    }
}

impl Shard {
    /// All goals.
    pub(super) const WHOLE: Self = Self { index: 1, count: 1 };

    /// Goals I, I + N, I + 2N …: neighbours are often alike in effort, so shards share them evenly.
    pub(super) fn part<T>(self, of: Vec<T>) -> Vec<T> {
        of.into_iter().skip(self.index - 1).step_by(self.count).collect()
    }
}

/// `METRES,COLUMN,ROW`.
pub(super) fn frame(text: &str) -> Result<KnownFrame, String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|n: &f64| n.is_finite())).collect();
    match numbers.as_deref() {
        Some(&[meters_per_pixel, axis_column, ground_row]) if meters_per_pixel > 0.0 => {
            Ok(KnownFrame { meters_per_pixel, axis_column, ground_row })
        }
        _ => Err(
            "expected metres per pixel above 0, the column of the trunk's foot and the row of the ground, \
                  such as 0.05,128,250"
                .to_owned(),
        ),
    }
}

pub(super) fn height(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|v| *v > 0.0 && *v <= 1000.0)
        .ok_or_else(|| "expected a number of metres above 0 and up to 1000".to_owned())
}

/// Most trees that parameters are scored by.
const MAX_ROBUST: u32 = 64;

pub(super) fn robust(text: &str) -> Result<NonZeroU32, String> {
    text.parse::<NonZeroU32>()
        .ok()
        .filter(|count| count.get() <= MAX_ROBUST)
        .ok_or_else(|| format!("expected a number of trees from 1 to {MAX_ROBUST}"))
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|v| (0.0..=1.0).contains(v))
        .ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

pub(super) fn tree_seed(text: &str) -> Result<TreeSeed, String> {
    if text == "any" {
        return Ok(TreeSeed::Any);
    }
    input::seed(text).map(TreeSeed::Fixed).map_err(|e| format!("{e}, or `any`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_goals_without_loss_or_overlap() {
        let mut all = Vec::new();
        for index in 1..=3 {
            let shard: Shard = format!("{index}/3").parse().unwrap();
            all.extend(shard.part((0..8).collect::<Vec<_>>()));
        }
        assert_eq!(all, [0, 3, 6, 1, 4, 7, 2, 5]);
        assert_eq!(Shard { index: 5, count: 9 }.part(vec![1, 2]), [0; 0]);
        for wrong in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/2", "1/99999999999999999999999"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
