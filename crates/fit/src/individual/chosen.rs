//! The draws that were chosen so far.

use pleach_tree::{Draw, Hull, Individual, StemPath};
use std::collections::BTreeMap;
use std::ops::Bound;

/// An individual, with price and gain of each of its draws.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    pub(super) individual: Individual,
    changes: BTreeMap<StemPath, Change>,
}

/// Price and gain of a stem's draws.
#[derive(Clone, Copy, Debug)]
struct Change {
    /// Their price.
    price: f64,
    /// By how much they lowered the cost.
    gain: f64,
}

impl Chosen {
    /// The same with `hull`, which has no price.
    pub(super) fn with_hull(&self, hull: Hull) -> Self {
        let mut chosen = self.clone();
        chosen.individual.set_hull(Some(hull));
        chosen
    }

    /// Number of stems with draws of their own.
    pub(super) fn len(&self) -> usize {
        self.changes.len()
    }

    /// Whether the stem has draws of its own.
    pub(super) fn has(&self, path: &StemPath) -> bool {
        self.changes.contains_key(path)
    }

    /// The price of all draws.
    pub(super) fn price(&self) -> f64 {
        self.changes.values().map(|change| change.price).sum()
    }

    /// The price of the draws that [`Self::set`] would not change.
    pub(super) fn price_beside(&self, path: &StemPath, reseeds: bool) -> f64 {
        let stays = |other: &StemPath| if reseeds { !other.is_on(path) } else { other != path };
        // In one order, whichever stems were exchanged first.
        self.changes.iter().filter(|(other, _)| stays(other)).map(|(_, change)| change.price).sum()
    }

    /// The least gain of any stem's draws.
    pub(super) fn min_gain(&self) -> f64 {
        self.changes.values().map(|change| change.gain).fold(f64::INFINITY, f64::min)
    }

    /// Gives a stem another draw, with its `price` and `gain`. One that `reseeds` the stem resets the draws of its
    /// descendants.
    pub(super) fn set(&mut self, path: StemPath, draw: Draw, reseeds: bool, price: f64, gain: f64) {
        // The gain of reset draws is part of the gain of this one.
        let before = self
            .changes
            .iter()
            .filter(|(other, _)| if reseeds { other.is_on(&path) } else { **other == path });
        let gain = gain + before.map(|(_, change)| change.gain).sum::<f64>();
        if reseeds {
            self.individual.clear_above(&path);
            self.changes.retain(|other, _| !other.is_on(&path));
        }
        self.individual.set(path.clone(), draw);
        self.changes.insert(path, Change { price, gain });
    }

    /// Resets the draws of stems until at most `most` are left: those of least gain first.
    pub(super) fn prune(&mut self, most: usize) {
        while self.len() > most {
            // A stem whose descendants have draws stays, or they would grow from another stem.
            let carries = |path: &StemPath| {
                let above = (Bound::Excluded(path), Bound::Unbounded);
                self.changes.range::<StemPath, _>(above).next().is_some_and(|(next, _)| next.is_on(path))
            };
            let ends = self.changes.iter().filter(|(path, _)| !carries(path));
            let Some((least, _)) = ends.min_by(|(_, a), (_, b)| a.gain.total_cmp(&b.gain)) else { return };
            let least = least.clone();
            self.individual.unset(&least);
            self.changes.remove(&least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(gains: &[(&str, f64)]) -> Chosen {
        let mut chosen = Chosen::default();
        for &(path, gain) in gains {
            chosen.set(path.parse().unwrap(), Draw { seed: 7, ..Draw::OWN }, false, 0.25, gain);
        }
        chosen
    }

    fn paths(chosen: &Chosen) -> Vec<String> {
        chosen.individual.stems().map(|(path, _)| path.to_string()).collect()
    }

    #[test]
    fn what_gained_least_goes_first_but_not_from_under_others() {
        let mut some = chosen(&[("0", 0.01), ("0/3", 0.02), ("0/3/1", 0.5), ("0/30", 0.03), ("0/f1", 0.04)]);
        some.prune(4);
        assert_eq!(paths(&some), ["0", "0/3", "0/3/1", "0/f1"]);
        some.prune(2);
        assert_eq!((paths(&some).len(), some.len(), some.min_gain()), (2, 2, 0.01));
        // The gain of what carried nothing any more.
        assert_eq!(paths(&some), ["0", "0/3"]);
    }

    #[test]
    fn a_stem_dealt_anew_forgets_what_it_carried_and_keeps_its_gain() {
        let mut some = chosen(&[("0/3", 0.02), ("0/3/1", 0.5), ("0/4", 0.1)]);
        let (path, draw): (StemPath, _) = ("0/3".parse().unwrap(), Draw { seed: 9, ..Draw::OWN });
        assert_eq!(
            (some.price(), some.price_beside(&path, true), some.price_beside(&path, false)),
            (0.75, 0.25, 0.5)
        );
        let mut turned = some.clone();
        turned.set(path.clone(), draw, false, 0.0, 1.0);
        assert_eq!((paths(&turned), turned.price()), (paths(&some), 0.5));
        some.set(path.clone(), draw, true, 0.0, 1.0);
        assert_eq!(paths(&some), ["0/3", "0/4"]);
        assert_eq!((some.changes[&path].gain, some.min_gain(), some.has(&path)), (1.52, 0.1, true));
    }
}
