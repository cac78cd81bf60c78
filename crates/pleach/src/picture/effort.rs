//! How long a goal's own tree is searched.

use pleach_fit::IndividualSettings;
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// How long a goal's own tree is searched: `share`, a time such as `20s`, a number of trees such as `400trees`, or
/// `off`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Effort {
    /// A share of what the whole fit takes.
    #[default]
    Share,
    /// So long.
    Time(Duration),
    /// This number of trees; fewer if the share of a bounded time ends first.
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
    /// The settings in a fit of this time, or of this number of trees; `None` if it is off.
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

/// The largest number of trees that may be asked for.
const MAX_TREES: u64 = 1_000_000_000;

impl FromStr for Effort {
    type Err = String;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        match given {
            "off" => return Ok(Self::Off),
            "share" => return Ok(Self::Share),
            _ => {}
        }
        if let Some(count) = given.strip_suffix("trees") {
            let count = count.parse().ok().filter(|count| (1..=MAX_TREES).contains(count));
            return count
                .map(Self::Trees)
                .ok_or_else(|| "expected a number of trees such as 400trees".to_owned());
        }
        parse_duration(given)
            .map(Self::Time)
            .map_err(|error| format!("{error}, `400trees`, `share` or `off`"))
    }
}

/// The longest time that a fit may be given, in seconds.
pub(super) const MAX_SECONDS: f64 = 1e7;

/// Reads a time: `90s`, `10m`, `2h`, `500ms`, or plain seconds; above 0 and at most 10 000 000 s.
///
/// # Errors
/// What was expected.
pub fn parse_duration(text: &str) -> Result<Duration, &'static str> {
    let units = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    let (number, unit) =
        units.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, *unit))).unwrap_or((text, 1.0));
    number
        .parse::<f64>()
        .ok()
        .map(|number| number * unit)
        .filter(|seconds| *seconds > 0.0 && *seconds <= MAX_SECONDS)
        .map(Duration::from_secs_f64)
        .ok_or("expected a time such as 90s, 10m or 2h")
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Share => f.write_str("share"),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn efforts_are_read_and_written() {
        for text in ["share", "off", "20s", "400trees", "0.5s"] {
            assert_eq!(text.parse::<Effort>().unwrap().to_string(), text);
        }
        assert_eq!("2m".parse::<Effort>().unwrap(), Effort::Time(Duration::from_secs(120)));
        for text in ["", "0trees", "-1s", "soon", "1e9h", "2000000000trees"] {
            assert!(text.parse::<Effort>().is_err(), "{text}");
        }
    }
}
