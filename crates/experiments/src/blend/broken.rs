//! The palm with each other species: what is broken about a blend.

use super::maps::{METHODS, Maps, Method};
use super::ranges::Ranges;
use super::{Rows, SEED};
use pleach_blend::BlendMap;
use pleach_tree::{Kind, Slot, Species};

/// The palm with each other species: what is broken about a blend.
pub(super) fn palm(maps: &Maps, rows: &mut Rows) -> anyhow::Result<()> {
    let palm = maps.declared.landmarks().named("palm")?;
    let ranges = Ranges::new(maps.species())?;
    for other in (0..maps.species().len()).filter(|&i| i != palm) {
        let pair = (palm, other);
        let ends = [&maps.species()[palm], &maps.species()[other]];
        for method in METHODS {
            let (mut foreign, mut taper, mut degenerate) = (0, 0, 0);
            for at in [0.25, 0.5, 0.75] {
                let blend = maps.between(method, pair, at)?;
                foreign += foreign_switches(&blend, maps.species());
                taper += wrong_tapers(&blend, ends);
                degenerate += u32::from(!ranges.hold(&blend, SEED));
            }
            let names = (ends[0].name.as_str(), ends[1].name.as_str());
            let mut add =
                |measure: &str, value: u32| rows.add("palm", names, method.name(), measure, f64::from(value));
            add("choices and signs that no species has", foreign);
            add("tapers outside both species' range", taper);
            add("degenerate", degenerate);
            if method == Method::Raw {
                let wrong = [0.25, 0.5, 0.75].map(|at| out_of_range(&maps.raw, pair, at)).iter().sum();
                add("values out of range before repair", wrong);
            }
        }
    }
    Ok(())
}

/// Values of the dissertation's back-projection that no species file may hold.
fn out_of_range(raw: &BlendMap, (a, b): (usize, usize), at: f64) -> u32 {
    let point = raw.dots()[a].towards(raw.dots()[b], at);
    let space = raw.landmarks().space();
    let back = raw.pca().back(&[point.x, point.y]);
    let wrong = |slot: &Slot| {
        let (low, high) = space.kind_of(*slot).range();
        !(low - 1e-9..=high + 1e-9).contains(&back[slot.index()])
    };
    space.slots().filter(wrong).count() as u32
}

/// Numbers that the blend reads and whose choice or sign none of the species that read them has.
fn foreign_switches(blend: &Species, species: &[Species]) -> u32 {
    let space = blend.generator.space();
    let values = blend.params.values();
    let side = |slot: Slot, value: f64| match space.kind_of(slot) {
        Kind::Choice { .. } => value,
        kind if kind.is_flagged() && value < 0.0 => -1.0,
        _ => 1.0,
    };
    let foreign = |slot: &Slot| {
        let readers = species.iter().filter(|s| s.generator.is_active(s.params.values(), *slot));
        let mut sides = readers.map(|s| side(*slot, s.params.get(*slot))).peekable();
        blend.generator.is_active(values, *slot)
            && sides.peek().is_some()
            && !sides.any(|s| s == side(*slot, blend.params.get(*slot)))
    };
    space.slots().filter(foreign).count() as u32
}

/// Tapers that the blend reads and that lie outside the range of those of its two ends that have the
/// level.
fn wrong_tapers(blend: &Species, ends: [&Species; 2]) -> u32 {
    let space = blend.generator.space();
    let slots = space.select("taper").unwrap_or_default();
    let wrong = |slot: &&Slot| {
        let slot = **slot;
        let readers = ends.iter().filter(|s| s.generator.is_active(s.params.values(), slot));
        let (low, high) = readers
            .map(|s| s.params.get(slot))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let value = blend.params.get(slot);
        blend.generator.is_active(blend.params.values(), slot)
            && low <= high
            && !(low - 0.051..=high + 0.051).contains(&value)
    };
    slots.iter().filter(wrong).count() as u32
}
