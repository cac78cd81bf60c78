//! One free number.

use crate::problem::Genome;
use crate::problem::Nuisance;
use crate::space::Stream;
use pleach_tree::math;
use pleach_tree::param::Scale;
use pleach_tree::{Kind, Slot};

/// Where the number of a gene is in a [`Genome`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In [`Genome::values`]: a slot of the generator's parameter space.
    Slot(Slot),
    /// In [`Genome::nuisances`].
    Nuisance {
        /// Which of them.
        number: usize,
        /// Its meaning.
        nuisance: Nuisance,
    },
}

/// One free number: its meaning and its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Gene {
    /// Where the number is.
    pub place: Place,
    /// What the number means.
    pub kind: Kind,
    /// How numbers are compared.
    pub scale: Scale,
    /// The value that stands for absence of the feature, if there is one.
    pub neutral: Option<f64>,
    /// Smallest value that searches try.
    pub low: f64,
    /// Largest value that searches try.
    pub high: f64,
}

impl Gene {
    /// A range of numbers that are compared by ratio is searched by ratio from this factor between its ends on.
    /// Below, equal steps find the same.
    const LOG_FROM: f64 = 20.0;

    /// The slot in the generator's parameter space; `None` for a nuisance.
    #[must_use]
    pub const fn slot(&self) -> Option<Slot> {
        match self.place {
            Place::Slot(slot) => Some(slot),
            Place::Nuisance { .. } => None,
        }
    }

    /// The number in `genome`.
    #[must_use]
    pub fn get(&self, genome: &Genome) -> f64 {
        match self.place {
            Place::Slot(slot) => genome.values[slot.index()],
            Place::Nuisance { number, .. } => genome.nuisances[number],
        }
    }

    /// Sets the number in `genome` to `value`, unchecked.
    pub fn set(&self, genome: &mut Genome, value: f64) {
        match self.place {
            Place::Slot(slot) => genome.values[slot.index()] = value,
            Place::Nuisance { number, .. } => genome.nuisances[number] = value,
        }
    }

    /// Whether the number is an azimuth.
    pub(crate) const fn is_azimuth(&self) -> bool {
        matches!(self.place, Place::Nuisance { nuisance: Nuisance::Azimuth, .. })
    }

    /// Whether the range is a circle, its ends the same direction.
    #[must_use]
    pub fn is_periodic(&self) -> bool {
        self.is_azimuth() && self.high - self.low >= 360.0
    }

    /// Whether steps are ratios and not differences: for positive quantities that are declared so, and
    /// differ much within the range.
    #[must_use]
    pub fn is_log(&self) -> bool {
        self.scale != Scale::Linear && self.low > 0.0 && self.high / self.low >= Self::LOG_FROM
    }

    /// Whether the number is a choice, so that neighbors are no more alike than others.
    #[must_use]
    pub const fn is_choice(&self) -> bool {
        self.kind.is_choice()
    }

    /// Whether both signs of a switch are within the search range.
    #[must_use]
    pub fn can_flip(&self) -> bool {
        self.kind.is_flagged() && self.low < 0.0 && 0.0 < self.high
    }

    /// The value that stands for absence, if there is one and it is in range.
    #[must_use]
    pub fn neutral(&self) -> Option<f64> {
        self.neutral.filter(|neutral| (self.low..=self.high).contains(neutral))
    }

    /// Whether there is only one value.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.high <= self.low
    }

    /// How many values there are, infinity for a real number.
    #[must_use]
    pub fn count(&self) -> f64 {
        if self.kind.is_whole() { self.high - self.low + 1.0 } else { f64::INFINITY }
    }

    /// The nearest value within range, whole where it must be; the middle of the range for NaN. On a
    /// circle the same direction.
    #[must_use]
    pub fn clamp(&self, value: f64) -> f64 {
        let value = if value.is_nan() { f64::midpoint(self.low, self.high) } else { value };
        if self.is_periodic() {
            return self.low + (value - self.low).rem_euclid(self.high - self.low);
        }
        self.kind.repair(value.clamp(self.low, self.high)).clamp(self.low, self.high)
    }

    /// The same in a range that holds the numbers of all these trees as well: at the height of their picture sizes may be
    /// others than were drawn.
    pub(crate) fn holding<'a>(&self, known: impl IntoIterator<Item = &'a Genome>) -> Self {
        let widen = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let values = known.into_iter().map(|genome| self.get(genome));
        let (low, high) = values.fold((self.low, self.high), widen);
        Self { low, high, ..self.clone() }
    }

    /// Where `value` lies between `low` (0) and `high` (1), by difference or by ratio.
    #[must_use]
    pub fn to_unit(&self, value: f64) -> f64 {
        if self.is_constant() {
            0.5
        } else if self.is_log() {
            math::ln(value.max(self.low) / self.low) / math::ln(self.high / self.low)
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// The value at `unit` between `low` and `high`, clamped and whole where it must be.
    #[must_use]
    pub fn from_unit(&self, unit: f64) -> f64 {
        self.clamp(if self.is_log() {
            self.low * math::pow(self.high / self.low, unit)
        } else {
            self.low + unit * (self.high - self.low)
        })
    }

    /// A value drawn from the whole range: whole numbers and choices each with the same chance (by
    /// ratio if [`Gene::is_log`]), of a switch first the sign and then the magnitude.
    #[must_use]
    pub fn random(&self, stream: &mut Stream) -> f64 {
        let unit = stream.unit();
        if self.is_constant() {
            self.low
        } else if self.can_flip() {
            let side = if stream.chance(0.5) { self.low } else { self.high };
            self.clamp(side * unit)
        } else if self.kind.is_whole() && !self.is_log() {
            self.low + (unit * self.count()).floor()
        } else {
            self.from_unit(unit)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gene(kind: Kind, low: f64, high: f64) -> Gene {
        let (place, scale) = (Place::Slot(Slot::new(0)), Scale::Linear);
        Gene { place, kind, scale, neutral: None, low, high }
    }

    #[test]
    fn units_go_there_and_back() {
        let real = gene(Kind::Real { min: 0.0, max: 10.0 }, 1.0, 3.0);
        assert_eq!((real.to_unit(1.5), real.from_unit(0.25), real.from_unit(7.0)), (0.25, 1.5, 3.0));
        let linear = gene(Kind::integer(0, 1000), 1.0, 100.0);
        let count = Gene { scale: Scale::Count, ..linear.clone() };
        assert!(count.is_log() && !linear.is_log() && !Gene { high: 19.0, ..count.clone() }.is_log());
        assert!(Gene { scale: Scale::FineNearZero, ..count.clone() }.is_log());
        assert_eq!(count.from_unit(0.5), 10.0);
        assert_eq!(count.to_unit(10.0), 0.5);
        assert_eq!(count.clamp(f64::NAN), 51.0);
    }

    #[test]
    fn absence_is_declared_and_in_range() {
        let bend = Gene { neutral: Some(0.0), ..gene(Kind::real(-9.0, 9.0), -1.0, 1.0) };
        assert_eq!(bend.neutral(), Some(0.0));
        assert_eq!(Gene { low: 0.5, ..bend.clone() }.neutral(), None);
        assert_eq!(Gene { neutral: None, ..bend }.neutral(), None);
    }

    #[test]
    fn random_values_cover_their_range() {
        let mut stream = Stream::at(1, 0, 0, 0);
        let choice = gene(Kind::choice(2, ["a", "b", "c"]), 2.0, 4.0);
        let mut counts = [0; 3];
        for _ in 0..3000 {
            counts[choice.random(&mut stream) as usize - 2] += 1;
        }
        assert!(counts.iter().all(|c| (900..1100).contains(c)), "{counts:?}");

        let flag = gene(Kind::flagged(360.0, "fans"), -90.0, 360.0);
        let values: Vec<f64> = (0..3000).map(|_| flag.random(&mut stream)).collect();
        let negative = values.iter().filter(|v| **v < 0.0).count();
        assert!((1400..1600).contains(&negative), "signs are drawn first: {negative}");
        assert!(values.iter().all(|v| (-90.0..=360.0).contains(v)));
        assert!(values.iter().any(|v| *v > 300.0) && values.iter().any(|v| *v < -80.0));

        let many = Gene { scale: Scale::Count, ..gene(Kind::integer(0, 1000), 1.0, 1000.0) };
        let small = (0..3000).filter(|_| many.random(&mut stream) <= 31.0).count();
        assert!((1350..1650).contains(&small), "half of all draws below the root: {small}");
    }
}
