//! How much is tried for a first guess.

/// How much is tried for a first guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuessSettings {
    /// Varied copies of each candidate.
    pub variants: u32,
    /// Standard deviation of a varied number, as a part of the number itself.
    pub spread: f64,
    /// Trees of each candidate as it is, of different seeds: what names are decided by.
    pub seeds: u32,
    /// Lists that are returned, at most.
    pub keep: usize,
    /// Whether the goal is looked at with leaves and without, and taken for what it is more like; if
    /// not, `FitProblem::foliage` says it.
    pub detect_leaves: bool,
    /// How generators compete, where candidates are of several; if not at all, the least cost of a
    /// candidate's tree decides.
    pub race: Option<RaceSettings>,
}

/// How generators compete for a goal: each is searched for a short while.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RaceSettings {
    /// Generators that take part, at most, but one of every family in any case.
    pub runners: usize,
    /// Trees that each tries; never more than the whole search may.
    pub evaluations: u64,
}

impl Default for RaceSettings {
    fn default() -> Self {
        Self { runners: 5, evaluations: 100 }
    }
}

impl Default for GuessSettings {
    fn default() -> Self {
        Self {
            variants: 8,
            spread: 0.15,
            seeds: 3,
            keep: 10,
            detect_leaves: false,
            race: Some(RaceSettings::default()),
        }
    }
}
