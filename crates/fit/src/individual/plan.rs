//! In which order stems are dealt other draws.

/// Trees of a batch: what is exchanged after it is decided in one order, so it does not follow the number of
/// threads.
pub(super) const BATCH: u32 = 8;
/// Batches of a stage.
const BATCHES: u32 = 4;
/// Of the first, in which whole trees are dealt: one candidate each, for the price of as many as it has stems.
const FIRST_BATCHES: u32 = 4;
/// The share of the budget that whole trees may take.
const FIRST_SHARE: f64 = 0.12;
/// Generations with more stems are left as they are.
pub(super) const MAX_UNITS: usize = 6000;

/// Some batches of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    /// The generation of the stems.
    pub(super) generation: u16,
    /// Whether they are dealt anew, or only turned.
    pub(super) reseeds: bool,
    /// The part of their spread that draws lie away from what they were.
    pub(super) reach: f64,
    pub(super) batches: u32,
    /// The used share of the budget at which it ends, whatever is left of it.
    pub(super) until: f64,
}

/// The stages, without end, of a tree of `generations`.
pub(super) fn stages(generations: u16) -> impl Iterator<Item = Stage> {
    let whole = [
        Stage { generation: 0, reseeds: true, reach: 1.0, batches: FIRST_BATCHES, until: FIRST_SHARE },
        Stage { generation: 0, reseeds: false, reach: 0.3, batches: 1, until: FIRST_SHARE },
    ];
    let stage =
        |generation, reseeds, reach| Stage { generation, reseeds, reach, batches: BATCHES, until: 1.0 };
    let round = move |round: u32| {
        let narrow = 0.5 / f64::from(1 + round);
        (1..generations.max(1)).flat_map(move |generation| {
            [stage(generation, true, 1.0), stage(generation, false, narrow.max(0.1))]
        })
    };
    let branches = (0..).flat_map(round).take(if generations > 1 { usize::MAX } else { 0 });
    whole.into_iter().chain(branches)
}
