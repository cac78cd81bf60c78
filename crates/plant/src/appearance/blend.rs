//! What a blend of species looks like.

use super::{Appearance, Color};

impl Appearance {
    /// The appearance of a blend, from the appearances of its species and their weights (0 or more).
    ///
    /// Bark and leaves are mixed in Oklab, a species that says nothing taking part with the plain look
    /// that it is drawn in. The colours of autumn and of blossoms are those of the species that have any.
    /// Pattern, `evergreen` and season go by the larger weight, of equals the first. What no species
    /// says, the blend does not say either; all weight on one species gives its appearance unchanged.
    #[must_use]
    pub fn blend(parts: &[(&Self, f64)]) -> Self {
        let parts: Vec<(&Self, f64)> = parts.iter().copied().filter(|(_, weight)| *weight > 0.0).collect();
        let Some((first, _)) = parts.first() else { return Self::default() };
        if parts.iter().all(|(one, _)| one == first) {
            return **first;
        }
        let drawn = |said: fn(&Self) -> Option<Color>, drawn: fn(&Self) -> Color| {
            let anybody = parts.iter().any(|(one, _)| said(one).is_some());
            anybody.then(|| Color::mean(parts.iter().map(|(one, w)| (drawn(one), *w)))).flatten()
        };
        let of_those = |said: fn(&Self) -> Option<Color>| {
            Color::mean(parts.iter().filter_map(|(one, weight)| Some((said(one)?, *weight))))
        };
        let patterns = parts.iter().any(|(one, _)| one.bark_pattern.is_some());
        let evergreens = parts.iter().any(|(one, _)| one.evergreen.is_some());
        Self {
            bark: drawn(|one| one.bark, |one| one.look().bark),
            bark_pattern: patterns.then(|| top_loadings(&parts, |one| one.look().bark_pattern)).flatten(),
            leaf: drawn(|one| one.leaf, |one| one.look().leaf),
            autumn: of_those(|one| one.autumn.filter(|_| !one.look().evergreen)),
            blossom: of_those(|one| one.blossom),
            evergreen: evergreens.then(|| top_loadings(&parts, |one| one.look().evergreen)).flatten(),
            season: top_loadings(&parts, |one| one.season).flatten(),
        }
    }
}

/// What most of the weight is for; of equals, what the first of them says.
fn top_loadings<T: PartialEq>(parts: &[(&Appearance, f64)], of: impl Fn(&Appearance) -> T) -> Option<T> {
    let mut sums: Vec<(T, f64)> = Vec::new();
    for (one, weight) in parts {
        let value = of(one);
        match sums.iter_mut().find(|(known, _)| *known == value) {
            Some((_, sum)) => *sum += weight,
            None => sums.push((value, *weight)),
        }
    }
    let mut best: Option<(T, f64)> = None;
    for (value, sum) in sums {
        if best.as_ref().is_none_or(|(_, most)| sum > *most) {
            best = Some((value, sum));
        }
    }
    best.map(|(value, _)| value)
}

#[cfg(test)]
mod tests {
    use super::super::{BarkPattern, Season};
    use super::*;

    fn with_bark(bark: u32) -> Appearance {
        Appearance { bark: Some(Color::from_hex(bark)), ..Appearance::default() }
    }

    #[test]
    fn colours_mix_and_patterns_go_by_weight() {
        let birch = Appearance { bark_pattern: Some(BarkPattern::Banded), ..with_bark(0xd9_d6_cc) };
        let oak = Appearance {
            bark_pattern: Some(BarkPattern::Furrowed),
            autumn: Some(Color::from_hex(0xa8_5a_2a)),
            season: Some(Season::Autumn),
            ..with_bark(0x55_4c_43)
        };
        let half = Appearance::blend(&[(&birch, 0.5), (&oak, 0.5)]);
        assert_eq!(half.bark_pattern, Some(BarkPattern::Banded), "of equals the first");
        let Some(Color([r, ..])) = half.bark else { panic!("{half:?}") };
        assert!((0x85..0xa8).contains(&r), "between #55 and #d9: {r:x}");
        assert_eq!(half.autumn, oak.autumn, "the birch says nothing of it");
        assert_eq!((half.leaf, half.blossom, half.evergreen), (None, None, None), "nobody says");
        // Two that are banded outweigh one that is not, though each of them is lighter.
        let three = Appearance::blend(&[(&oak, 0.4), (&birch, 0.3), (&birch, 0.3)]);
        assert_eq!(three.bark_pattern, Some(BarkPattern::Banded));
        assert_eq!(Appearance::blend(&[(&birch, 0.0), (&oak, 1.0)]), oak);
        assert_eq!(Appearance::blend(&[]), Appearance::default());
    }

    #[test]
    fn a_species_that_says_nothing_counts_as_it_is_drawn() {
        let silent = Appearance::default();
        let white = with_bark(0xff_ff_ff);
        let Some(Color([r, ..])) = Appearance::blend(&[(&silent, 0.99), (&white, 0.01)]).bark else {
            panic!("a colour");
        };
        let Color([plain, ..]) = silent.look().bark;
        assert!(r.abs_diff(plain) < 4, "nearly the plain look: {r:x} and {plain:x}");
    }

    #[test]
    fn what_never_turns_has_no_say_in_autumn() {
        let palm = Appearance { evergreen: Some(true), ..with_bark(0x8d_7b_62) };
        let acer = Appearance { autumn: Some(Color::from_hex(0xc8_54_1f)), ..with_bark(0x71_65_57) };
        let mostly_acer = Appearance::blend(&[(&palm, 0.4), (&acer, 0.6)]);
        assert_eq!((mostly_acer.evergreen, mostly_acer.autumn), (Some(false), acer.autumn));
        assert_eq!(Appearance::blend(&[(&palm, 0.6), (&acer, 0.4)]).evergreen, Some(true));
    }
}
