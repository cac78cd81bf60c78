//! What can be wrong with a declaration.

use super::declaration::{Effect, Param, Scale};
use super::kind::Kind;

/// A declaration that contradicts itself or another.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the parameter `{param}` {fault}", param = super::shown(.param))]
pub struct DeclarationError {
    /// The parameter's name.
    pub param: String,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a declaration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Two parameters have the same name.
    #[error("is declared twice")]
    Twice,
    /// It has no numbers at all, or is a choice between no names.
    #[error("is empty")]
    Empty,
    /// A list of the declaration has neither one entry nor one for each slot.
    #[error("has {found} entries in `{what}`, expected {expected}")]
    WrongLength {
        /// The list's name.
        what: &'static str,
        /// Number of slots.
        expected: usize,
        /// Number of entries.
        found: usize,
    },
    /// A number of the declaration is not one that the parameter may have.
    #[error("has {value} in `{what}`, which its kind does not allow")]
    NotAllowed {
        /// Where the number stands.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A range whose ends are the wrong way round, or a plausible range beyond the search range.
    #[error("has the range {low} to {high} in `{what}`")]
    BadRange {
        /// Where the range stands.
        what: &'static str,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// Breakpoints that do not rise, or of something other than a real number.
    #[error("has breakpoints that do not rise, or is not a real number")]
    Breakpoints,
    /// Compared by ratio, and its search range is not above zero.
    #[error("is compared by ratio, but searched from {low} on")]
    NotPositive {
        /// The lower end of the search range.
        low: f64,
    },
}

/// What is wrong with `param` alone.
pub(super) fn find(param: &Param) -> Result<(), Fault> {
    let slots = param.shape.slot_count();
    let no_names = matches!(&param.kind, Kind::Choice { names, .. } if names.is_empty());
    if slots == 0 || no_names {
        return Err(Fault::Empty);
    }
    let lengths = [
        ("search", param.search.len()),
        ("plausible", if param.plausible.is_empty() { 1 } else { param.plausible.len() }),
        ("scale", param.scale.len()),
        ("effect", param.effect.len()),
    ];
    let wrong = lengths.into_iter().find(|&(_, found)| found != 1 && found != slots);
    let handle = param.handle.map(|(index, _)| ("handle", index + 1)).filter(|&(_, number)| number > slots);
    let default = Some(("default", param.default.len())).filter(|&(_, found)| found != slots);
    if let Some((what, found)) = default.or(wrong).or(handle) {
        return Err(Fault::WrongLength { what, expected: slots, found });
    }
    let allowed = |what, value: f64| {
        if param.kind.repair(value) == value { Ok(()) } else { Err(Fault::NotAllowed { what, value }) }
    };
    let ordered = |what, (low, high): (f64, f64)| {
        if low <= high { Ok(()) } else { Err(Fault::BadRange { what, low, high }) }
    };
    let (min, max) = param.kind.range();
    ordered("kind", (min, max))?;
    for index in 0..slots {
        allowed("default", param.default[index])?;
        let (low, high) = param.search_range(index);
        ordered("search", (low, high))?;
        allowed("search", low)?;
        allowed("search", high)?;
        let plausible = param.plausible_range(index);
        ordered("plausible", plausible)?;
        if plausible.0 < low || plausible.1 > high {
            return Err(Fault::BadRange { what: "plausible", low: plausible.0, high: plausible.1 });
        }
        if param.scale_of(index) == Scale::Log && low <= 0.0 {
            return Err(Fault::NotPositive { low });
        }
        if param.effect_of(index) == Effect::SizeJitter {
            allowed("effect", 0.0)?;
        }
    }
    param.neutral.map_or(Ok(()), |value| allowed("neutral", value))?;
    let is_rising = param.breakpoints.windows(2).all(|pair| pair[0] < pair[1]);
    let can_have_them = param.breakpoints.is_empty() || matches!(param.kind, Kind::Real { .. });
    if !(is_rising && can_have_them) {
        return Err(Fault::Breakpoints);
    }
    param.breakpoints.iter().try_for_each(|&value| allowed("breakpoints", value))
}
