//! How long this very tree is searched.

use pleach_fit::IndividualSettings;
use std::fmt;
use std::time::Duration;

/// How long a goal's own tree is searched.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Effort {
    /// A share of what the whole fit takes.
    #[default]
    Share,
    /// So long.
    Time(Duration),
    /// So many trees, as far as the share of the time goes where that is bounded.
    Trees(u64),
    /// Not at all.
    Off,
}

/// The share of the time, and of the trees, of a fit.
const SHARE_OF_TIME: u32 = 3;
const SHARE_OF_TREES: u64 = 8;
/// Trees where the search is bounded by something else.
const TREES: u64 = 400;

impl Effort {
    /// The settings in a fit of so much time, or of so many trees; none if it is off.
    ///
    /// # Errors
    /// A time that leaves nothing of the whole.
    pub fn settings(
        self,
        timeout: Option<Duration>,
        evaluations: Option<u64>,
    ) -> Result<Option<IndividualSettings>, TooLong> {
        Ok(Some(match (self, timeout) {
            (Self::Off, _) => return Ok(None),
            (Self::Trees(trees), whole) => IndividualSettings {
                time: whole.map(|whole| whole / SHARE_OF_TIME),
                takes_rest: true,
                ..IndividualSettings::trees(trees)
            },
            (Self::Time(time), Some(whole)) => {
                if time >= whole {
                    return Err(TooLong { time, whole });
                }
                IndividualSettings::time(time)
            }
            (Self::Time(time), None) => IndividualSettings::time(time),
            // Whatever comes first, as for the search.
            (Self::Share, whole) => IndividualSettings {
                time: whole.map(|whole| whole / SHARE_OF_TIME),
                takes_rest: true,
                ..IndividualSettings::trees(match (evaluations, whole) {
                    (Some(count), _) => count.div_ceil(SHARE_OF_TREES),
                    (None, Some(_)) => u64::MAX,
                    (None, None) => TREES,
                })
            },
        }))
    }
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Share => f.write_str("a share"),
            Self::Time(time) => write!(f, "{}s", time.as_secs_f64()),
            Self::Trees(trees) => write!(f, "{trees}trees"),
            Self::Off => f.write_str("off"),
        }
    }
}

/// A search for this very tree that would take all of a fit's time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "this very tree takes {} s, expected less than the {} s of the whole fit",
    time.as_secs_f64(),
    whole.as_secs_f64()
)]
pub struct TooLong {
    /// What was asked for.
    pub time: Duration,
    /// The time of the whole fit.
    pub whole: Duration,
}
