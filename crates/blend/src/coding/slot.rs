//! The code of one slot.

use pleach_tree::math;
use pleach_tree::param::Scale;
use pleach_tree::{Kind, ParamSpace, Slot};
use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::Range;

/// How far below its search range a quantity is still compared by ratio: a hundredth of it.
const MAX_RATIO_BELOW: f64 = 100.0;

/// Counts that reach beyond this are many: compared by ratio.
const MAX_FEW: f64 = 9.0;

/// One feature.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its slot.
    pub slot: Slot,
    /// The slot's name, and which part of its meaning where there are several: `length[1]`,
    /// `shape = flame`, `rotate[2] < 0`, `taper[0] from 2`.
    pub name: String,
}

/// How a number is stretched before it is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stretch {
    Linear,
    /// Of values above 0; lower ones count as this floor.
    Log {
        floor: f64,
    },
    /// ln(1 + n).
    LogCount,
}

impl Stretch {
    /// How numbers of this scale are stretched, where they are searched from `low` on and reach
    /// `largest`.
    fn new(scale: Scale, low: f64, largest: f64) -> Self {
        match scale {
            Scale::Log => Self::Log { floor: low / MAX_RATIO_BELOW },
            Scale::Count if largest > MAX_FEW => Self::LogCount,
            Scale::Count | Scale::Linear | Scale::FineNearZero => Self::Linear,
        }
    }

    fn apply(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log { floor } => math::ln(value.max(floor)),
            Self::LogCount => math::log1p(value.max(0.0)),
        }
    }

    fn undo(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log { .. } => math::exp(value),
            Self::LogCount => math::expm1(value),
        }
    }
}

/// A quantity as one feature: stretched, 0 at one end of its span and 1 at the other.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Quantity {
    stretch: Stretch,
    zero: f64,
    unit: f64,
}

impl Quantity {
    fn new(stretch: Stretch, (low, high): (f64, f64)) -> Self {
        let (zero, one) = (stretch.apply(low), stretch.apply(high));
        Self { stretch, zero, unit: if one > zero { one - zero } else { 1.0 } }
    }

    fn encode(self, value: f64) -> f64 {
        (self.stretch.apply(value) - self.zero) / self.unit
    }

    fn decode(self, feature: f64) -> f64 {
        self.stretch.undo(self.zero + feature * self.unit)
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Code {
    Quantity(Quantity),
    /// One feature a name, numbered from `first`.
    OneOf {
        first: i64,
        count: usize,
    },
    /// Switch, magnitude of the positive meaning, magnitude of the negative meaning.
    Flagged {
        positive: Quantity,
        negative: Quantity,
    },
    /// The ends of the regimes, one feature between two neighbours.
    Regimes(Vec<f64>),
}

/// The code of one slot: its features and their meaning.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SlotCode {
    first: usize,
    code: Code,
}

impl SlotCode {
    /// The number itself.
    pub(super) fn raw(space: &ParamSpace, slot: Slot, features: &mut Vec<Feature>) -> Self {
        let first = features.len();
        features.push(Feature { slot, name: space.slot_name(slot) });
        Self { first, code: Code::Quantity(Quantity { stretch: Stretch::Linear, zero: 0.0, unit: 1.0 }) }
    }

    /// By the declaration of the slot; `span` holds its search range and all examples.
    pub(super) fn declared(
        space: &ParamSpace,
        slot: Slot,
        span: (f64, f64),
        features: &mut Vec<Feature>,
    ) -> Self {
        let first = features.len();
        let name = space.slot_name(slot);
        let mut feature = |name: String| features.push(Feature { slot, name });
        let breaks: &[f64] = &space.param_of(slot).breakpoints;
        let (scale, low) = (space.scale_of(slot), space.search_range(slot).0);
        let code = match space.kind_of(slot) {
            Kind::Real { min, .. } if !breaks.is_empty() => {
                let ends = regime_ends(*min, breaks, span.1);
                for (i, pair) in ends.windows(2).enumerate() {
                    feature(match (i, i + 2 == ends.len()) {
                        (0, _) => format!("{name} to {}", pair[1]),
                        (_, true) => format!("{name} from {}", pair[0]),
                        _ => format!("{name} {} to {}", pair[0], pair[1]),
                    });
                }
                Code::Regimes(ends)
            }
            Kind::Real { .. } | Kind::Integer { .. } => {
                feature(name);
                Code::Quantity(Quantity::new(Stretch::new(scale, low, span.1), span))
            }
            Kind::Choice { first, names } => {
                names.iter().for_each(|choice| feature(format!("{name} = {choice}")));
                Code::OneOf { first: *first, count: names.len() }
            }
            Kind::Flagged { .. } | Kind::FlaggedInteger { .. } => {
                feature(format!("{name} < 0"));
                feature(format!("{name} where > 0"));
                feature(format!("{name} where < 0"));
                let side = |reach: f64| {
                    let reach = reach.max(0.0);
                    // A magnitude begins at zero, where there is no ratio.
                    let stretch =
                        if scale == Scale::Log { Stretch::Linear } else { Stretch::new(scale, low, reach) };
                    Quantity::new(stretch, (0.0, reach))
                };
                Code::Flagged { positive: side(span.1), negative: side(-span.0) }
            }
        };
        Self { first, code }
    }

    /// The numbers of its features.
    pub(super) fn features(&self) -> Range<usize> {
        let count = match &self.code {
            Code::Quantity(_) => 1,
            Code::OneOf { count, .. } => *count,
            Code::Flagged { .. } => 3,
            Code::Regimes(ends) => ends.len() - 1,
        };
        self.first..self.first + count
    }

    /// Fills the slot's own features.
    pub(super) fn encode(&self, value: f64, features: &mut [Option<f64>]) {
        let mine = &mut features[self.features()];
        match &self.code {
            Code::Quantity(quantity) => mine[0] = Some(quantity.encode(value)),
            Code::OneOf { first, .. } => {
                let chosen = (value as i64 - first) as usize;
                for (i, feature) in mine.iter_mut().enumerate() {
                    *feature = Some(if i == chosen { FRAC_1_SQRT_2 } else { 0.0 });
                }
            }
            Code::Flagged { positive, negative } => {
                mine[0] = Some(if value < 0.0 { 1.0 } else { 0.0 });
                mine[1] = (value >= 0.0).then(|| positive.encode(value));
                mine[2] = (value <= 0.0).then(|| negative.encode(-value));
            }
            Code::Regimes(ends) => {
                for (feature, pair) in mine.iter_mut().zip(ends.windows(2)) {
                    *feature = Some(((value - pair[0]) / (pair[1] - pair[0])).clamp(0.0, 1.0));
                }
            }
        }
    }

    /// The number that fits best, not yet whole or in range; `None` if the features are missing.
    pub(super) fn decode(&self, features: &[Option<f64>]) -> Option<f64> {
        let mine = &features[self.features()];
        match &self.code {
            Code::Quantity(quantity) => mine[0].map(|f| quantity.decode(f)),
            Code::OneOf { first, .. } => {
                let mut best: Option<(usize, f64)> = None;
                for (i, feature) in mine.iter().enumerate() {
                    let feature = (*feature)?;
                    if best.is_none_or(|(_, most)| feature > most) {
                        best = Some((i, feature));
                    }
                }
                best.map(|(i, _)| (first + i as i64) as f64)
            }
            Code::Flagged { positive, negative } => {
                let is_negative = mine[0]? > 0.5;
                let (quantity, magnitude) =
                    if is_negative { (negative, mine[2]) } else { (positive, mine[1]) };
                // No species has this meaning, so its magnitude is never used.
                let magnitude = quantity.decode(magnitude?.max(0.0));
                Some(if is_negative { -magnitude } else { magnitude })
            }
            Code::Regimes(ends) => {
                let mut value = ends[0];
                for (feature, pair) in mine.iter().zip(ends.windows(2)) {
                    value += (*feature)?.clamp(0.0, 1.0) * (pair[1] - pair[0]);
                }
                Some(value)
            }
        }
    }
}

/// The ends of the regimes: the breaks, the smallest allowed value, and the largest in use.
fn regime_ends(low: f64, breaks: &[f64], high: f64) -> Vec<f64> {
    let mut ends = vec![low];
    ends.extend(breaks.iter().copied().filter(|&b| b > low));
    let last = ends[ends.len() - 1];
    // With nothing beyond the last break, its regime still is one unit wide.
    ends.push(if high > last { high } else { last + 1.0 });
    ends
}
