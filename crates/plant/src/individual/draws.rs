//! The draws of all stems, as a generator asks for them.

use super::{Address, Draw, Hull, Spread};
use crate::random::Key;
use std::sync::Arc;

/// The draws of an individual, and of a trial beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Draws {
    /// By the bits of the address, ascending.
    stems: Vec<(u64, Draw)>,
    trial: Option<Trial>,
    hull: Option<Arc<Hull>>,
}

/// Other draws for all stems of one generation at once, so that one tree has a new candidate for each of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The [generation](Address::generation) of the stems.
    pub generation: u16,
    /// Which trial: each has other draws.
    pub number: u32,
    /// The part of the spread by which turns and lengths lie away from those of the individual.
    pub reach: f64,
    /// Whether stems, with all that they carry, get new draws, and are not only turned.
    pub reseeds: bool,
    /// How far draws may be from a stem's own, level by level; the last holds for all deeper ones.
    pub spreads: Vec<Spread>,
}

impl Trial {
    /// What the stem at `address`, of `level`, draws in this trial, where the individual has `kept`.
    #[must_use]
    pub fn draw(&self, address: Address, level: usize, kept: &Draw) -> Draw {
        let key = address.key().child(2, self.number);
        let mut spread = self.spreads.get(level).or(self.spreads.last()).copied().unwrap_or_default();
        if address.is_fork() {
            spread.length = 0.0;
        }
        let from = if self.reseeds { Draw { seed: seed(key), ..*kept } } else { *kept };
        spread.sample(key, &from, self.reach)
    }
}

/// A seed that is not 0.
fn seed(key: Key) -> u32 {
    ((key.bits(1, 0) >> 40) as u32) + 1
}

impl Draws {
    /// The draws of the stems at these addresses; every other stem has its own.
    #[must_use]
    pub fn new(stems: impl IntoIterator<Item = (Address, Draw)>) -> Self {
        let mut stems: Vec<(u64, Draw)> =
            stems.into_iter().map(|(address, draw)| (address.bits(), draw)).collect();
        stems.sort_unstable_by_key(|&(bits, _)| bits);
        Self { stems, trial: None, hull: None }
    }

    /// The same with another draw for each stem of a generation.
    #[must_use]
    pub fn with_trial(self, trial: Trial) -> Self {
        Self { trial: Some(trial), ..self }
    }

    /// The same with another hull, or none.
    #[must_use]
    pub fn with_hull(self, hull: Option<Arc<Hull>>) -> Self {
        Self { hull, ..self }
    }

    /// What the crown grows into.
    #[must_use]
    pub fn hull(&self) -> Option<&Hull> {
        self.hull.as_deref()
    }

    /// The draw of the stem at `address`, of `level`.
    #[must_use]
    pub fn at(&self, address: Address, level: usize) -> Draw {
        match &self.trial {
            Some(trial) if trial.generation == address.generation() => {
                trial.draw(address, level, &self.kept(address))
            }
            // What was chosen for stems on another one has no meaning on a new one.
            Some(trial) if trial.reseeds && trial.generation < address.generation() => Draw::OWN,
            _ => self.kept(address),
        }
    }

    fn kept(&self, address: Address) -> Draw {
        let found = self.stems.binary_search_by_key(&address.bits(), |&(bits, _)| bits);
        found.map_or(Draw::OWN, |place| self.stems[place].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPREAD: Spread = Spread { azimuth: 0.2, pitch: 0.1, length: 0.05 };

    fn trial(number: u32, reseeds: bool) -> Trial {
        Trial { generation: 1, number, reach: 1.0, reseeds, spreads: vec![Spread::default(), SPREAD] }
    }

    #[test]
    fn stems_have_what_was_kept_and_others_their_own() {
        let (one, other) = (Address::trunk(0).child(3), Address::trunk(0).child(4));
        let draw = Draw { seed: 7, azimuth: 0.1, pitch: -0.05, length: 1.02 };
        let draws = Draws::new([(one, draw), (one.fork(0), draw)]);
        assert_eq!((draws.at(one, 1), draws.at(other, 1)), (draw, Draw::OWN));
        // A trial changes a whole generation. What its stems carried is forgotten only if they are reseeded.
        let turned = draws.clone().with_trial(trial(1, false));
        assert_eq!((turned.at(one, 1).seed, turned.at(one.fork(0), 1)), (7, draw));
        let reseeded = draws.with_trial(trial(1, true));
        assert!(![0, 7].contains(&reseeded.at(one, 1).seed));
        assert_eq!((reseeded.at(one.fork(0), 1), reseeded.at(Address::trunk(0), 0)), (Draw::OWN, Draw::OWN));
        assert_ne!(reseeded.at(one, 1), reseeded.at(other, 1));
    }

    #[test]
    fn trials_stay_within_the_spread_and_fill_it() {
        let address = Address::trunk(0).child(3);
        let edge = Draw { seed: 7, azimuth: 0.2, pitch: -0.1, length: 1.05 };
        let (mut sum, mut widest) = (0.0, 0.0_f64);
        for number in 0..1000 {
            let draw = trial(number, true).draw(address, 1, &Draw::OWN);
            assert!(draw.is_allowed() && draw.azimuth.abs() < 0.2 + 1e-5 && draw.pitch.abs() < 0.1 + 1e-5);
            assert!((draw.length - 1.0).abs() < 0.05 + 1e-5 && draw.price(&SPREAD) < 1.01);
            sum += draw.azimuth;
            widest = widest.max(draw.azimuth);
            let near = trial(number, false).draw(address, 1, &edge);
            // Degrees are rounded to four places.
            assert!(near.azimuth < 0.2 + 1e-5 && near.pitch > -0.1 - 1e-5 && near.length < 1.05 + 1e-5);
            assert_eq!(trial(number, false).draw(address.fork(2), 1, &Draw::OWN).length, 1.0);
        }
        assert!((sum / 1000.0).abs() < 0.02 && widest > 0.19, "{sum} {widest}");
        assert_eq!(Draw::OWN.price(&SPREAD), 0.0);
    }
}
