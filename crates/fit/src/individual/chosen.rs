//! The draws that were chosen so far.

use pleach_tree::{Draw, Individual, StemPath};
use std::collections::BTreeMap;
use std::ops::Bound;

/// An individual, with what is known of each of its draws.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    pub(super) individual: Individual,
    kept: BTreeMap<StemPath, Kept>,
}

/// Draws of a stem that were worth it.
#[derive(Clone, Copy, Debug)]
struct Kept {
    /// What they cost.
    price: f64,
    /// By how much they made the cost smaller.
    gain: f64,
}

impl Chosen {
    /// Number of stems with draws of their own.
    pub(super) fn len(&self) -> usize {
        self.kept.len()
    }

    /// Whether the stem has draws of its own.
    pub(super) fn has(&self, path: &StemPath) -> bool {
        self.kept.contains_key(path)
    }

    /// What all draws cost.
    pub(super) fn price(&self) -> f64 {
        self.kept.values().map(|kept| kept.price).sum()
    }

    /// What those cost that [`Self::set`] would leave as they are.
    pub(super) fn price_beside(&self, path: &StemPath, reseeds: bool) -> f64 {
        let stays = |other: &StemPath| if reseeds { !other.is_on(path) } else { other != path };
        // In one order, whichever stems were exchanged first.
        self.kept.iter().filter(|(other, _)| stays(other)).map(|(_, kept)| kept.price).sum()
    }

    /// The least by which the draws of any stem made the cost smaller.
    pub(super) fn least_gain(&self) -> f64 {
        self.kept.values().map(|kept| kept.gain).fold(f64::INFINITY, f64::min)
    }

    /// Gives a stem another draw, which costs `price` and makes the cost smaller by `gain`. One that `reseeds` the
    /// stem gives all that it carries their own draws back.
    pub(super) fn set(&mut self, path: StemPath, draw: Draw, reseeds: bool, price: f64, gain: f64) {
        // What is forgotten has its share in what is gained.
        let before =
            self.kept.iter().filter(|(other, _)| if reseeds { other.is_on(&path) } else { **other == path });
        let gain = gain + before.map(|(_, kept)| kept.gain).sum::<f64>();
        if reseeds {
            self.individual.clear_above(&path);
            self.kept.retain(|other, _| !other.is_on(&path));
        }
        self.individual.set(path.clone(), draw);
        self.kept.insert(path, Kept { price, gain });
    }

    /// Gives stems their own draws back until at most `most` have others: first those that gained least.
    pub(super) fn prune(&mut self, most: usize) {
        while self.len() > most {
            // One that others were chosen on stays, or they would grow from another stem.
            let carries = |path: &StemPath| {
                let above = (Bound::Excluded(path), Bound::Unbounded);
                self.kept.range::<StemPath, _>(above).next().is_some_and(|(next, _)| next.is_on(path))
            };
            let ends = self.kept.iter().filter(|(path, _)| !carries(path));
            let Some((least, _)) = ends.min_by(|(_, a), (_, b)| a.gain.total_cmp(&b.gain)) else { return };
            let least = least.clone();
            self.individual.unset(&least);
            self.kept.remove(&least);
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
        assert_eq!((paths(&some).len(), some.len(), some.least_gain()), (2, 2, 0.01));
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
        assert_eq!((some.kept[&path].gain, some.least_gain(), some.has(&path)), (1.52, 0.1, true));
    }
}
