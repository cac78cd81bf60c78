//! Settings of a first guess.

/// Settings of a first guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuessSettings {
    /// Varied copies of each candidate.
    pub variants: u32,
    /// Standard deviation of a varied number, relative to the number itself.
    pub spread: f64,
    /// Unvaried trees of each candidate, of different seeds: they decide the names.
    pub seeds: u32,
    /// Upper bound of the lists that are returned.
    pub keep: usize,
    /// Whether trees with leaves and without are compared with the goal, to find out whether it has leaves; if not,
    /// `FitProblem::foliage` decides.
    pub detect_leaves: bool,
    /// Whether trees whose measures contradict the goal's are passed over.
    pub contradictions: Contradictions,
    /// How generators compete if candidates are of several; `None`: the least cost of a candidate's tree decides.
    pub race: Option<RaceSettings>,
}

/// What becomes of trees whose feet, thickness of the trunk or bare height contradict the goal's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Contradictions {
    /// They are taken for as probable as they look.
    #[default]
    Ignored,
    /// They lose likeness for it, and no search starts from one that contradicts the goal more than another does.
    Counted,
}

/// How generators compete for a goal: each is searched for a short while.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RaceSettings {
    /// Upper bound of the generators that take part; one of every family does in any case.
    pub runners: usize,
    /// Evaluations of each; at most those of the whole search.
    pub evaluations: u64,
    /// What the winner is best in.
    pub criterion: RaceCriterion,
}

/// What the winner of a race is best in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RaceCriterion {
    /// How much its known species look like the goal, above all: that tells which generator a tree was grown by.
    #[default]
    Origin,
    /// The cost that it reaches: of a real tree, which no generator has grown.
    Cost,
}

impl Default for RaceSettings {
    fn default() -> Self {
        Self { runners: 5, evaluations: 100, criterion: RaceCriterion::Origin }
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
            contradictions: Contradictions::Ignored,
            race: Some(RaceSettings::default()),
        }
    }
}
