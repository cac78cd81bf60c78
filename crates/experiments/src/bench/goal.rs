//! The goals of the exam.

use super::foreign;
use crate::pictured::{SIZE, load_view, pictured};
use crate::truth::Truth;
use anyhow::{Context, bail, ensure};
use pleach_fit::{FitProblem, GoalView};
use pleach_silhouette::goal::{Encoded, Goal as Picture, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::param::{nearest, shown};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::{Path, PathBuf};

/// Goals of one origin.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Set {
    /// Trees around the dissertation's species, whose numbers no library has.
    #[default]
    Perturbed,
    /// Trees of other programs.
    Foreign,
    /// Pictures of a folder of the user's.
    Photographs,
}

impl Set {
    pub(super) const ALL: [Self; 3] = [Self::Perturbed, Self::Foreign, Self::Photographs];

    /// Its name in rows and options.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Perturbed => "perturbed",
            Self::Foreign => "foreign",
            Self::Photographs => "photographs",
        }
    }
}

impl fmt::Display for Set {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The dissertation's species.
const SPECIES: [&str; 15] = [
    "acer",
    "apple",
    "balsam_fir",
    "bamboo",
    "black_oak",
    "black_tupelo",
    "douglas_fir",
    "european_larch",
    "hill_cherry",
    "lombardy_poplar",
    "palm",
    "quaking_aspen",
    "silver_birch",
    "small_pine",
    "weeping_willow",
];

/// Goals around each.
pub(super) const AROUND: u64 = 4;

/// Height of trees whose height is not known, in metres.
const HEIGHT: f64 = 10.0;

/// Degrees from which a held-out view looks.
const SIDE: f64 = 90.0;

/// Endings of the pictures that are looked for in a folder.
const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "webp", "tif", "tiff"];

/// A goal: a silhouette of at most [`SIZE`] pixels a side, in a frame that contestants know.
#[derive(Clone, Debug)]
pub(super) struct Goal {
    pub(super) name: String,
    pub(super) set: Set,
    /// Goals of one group are alike: those around one species.
    pub(super) group: String,
    pub(super) problem: FitProblem,
    /// Where the tree is ours.
    pub(super) own: Option<Own>,
}

/// What is known of a tree of ours.
#[derive(Clone, Debug)]
pub(super) struct Own {
    pub(super) truth: Truth,
    /// The same tree from the side, which no contestant sees.
    pub(super) side: FitProblem,
}

/// Where a goal comes from, before it is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    Around { species: &'static str, number: u32 },
    Foreign(&'static str),
    File(PathBuf),
}

impl Origin {
    /// All of the exam, with so many goals around each species and the pictures of a folder.
    pub(super) fn all(around: u64, photographs: Option<&Path>) -> anyhow::Result<Vec<Self>> {
        let numbers = 1..=around.min(AROUND) as u32;
        let mut all: Vec<Self> = numbers
            .flat_map(|number| SPECIES.map(|species| Self::Around { species, number }))
            .chain(foreign::names().map(Self::Foreign))
            .collect();
        if let Some(folder) = photographs {
            all.extend(pictures(folder)?.into_iter().map(Self::File));
        }
        let mut names: Vec<String> = all.iter().map(|origin| origin.name().to_lowercase()).collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let folder = photographs.unwrap_or(Path::new("")).display();
            bail!("{folder} has a picture called `{}`, as another goal is: rename it", shown(&twice[0]));
        }
        Ok(all)
    }

    /// Its goal's name.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Around { species, number } => format!("{species}-{number}"),
            Self::Foreign(name) => (*name).to_owned(),
            Self::File(path) => crate::spec::stem(path),
        }
    }

    pub(super) const fn set(&self) -> Set {
        match self {
            Self::Around { .. } => Set::Perturbed,
            Self::Foreign(_) => Set::Foreign,
            Self::File(_) => Set::Photographs,
        }
    }

    /// What goals that are alike have in common.
    pub(super) fn group(&self) -> String {
        match self {
            Self::Around { species, .. } => (*species).to_owned(),
            Self::Foreign(_) | Self::File(_) => self.name(),
        }
    }

    /// The goal itself.
    pub(super) fn goal(&self) -> anyhow::Result<Goal> {
        let (view, own) = match self {
            Self::Around { species, number } => {
                let (truth, tree) = Truth::new(&pleach_generators::species(species)?, *number)?;
                let side = problem(pictured(&tree, View::degrees(SIDE, 0.0), true))?;
                (pictured(&tree, View::FRONT, true), Some(Own { truth, side }))
            }
            Self::Foreign(name) => (foreign_view(name)?, None),
            Self::File(path) => (load_view(Path::new(""), path, HEIGHT)?, None),
        };
        Ok(Goal { name: self.name(), set: self.set(), group: self.group(), problem: problem(view)?, own })
    }
}

impl Goal {
    pub(super) fn picture(&self) -> &Bitmap {
        &self.problem.goals[0].goal
    }

    pub(super) fn frame(&self) -> &Frame {
        &self.problem.goals[0].frame
    }

    /// From the ground to the highest ink, in metres.
    pub(super) fn height(&self) -> f64 {
        let top = self.picture().ink_box().map_or(0, |(_, top, _, _)| top);
        (self.frame().ground_row - f64::from(top)) * self.frame().meters_per_pixel
    }
}

/// A problem of any generator.
fn problem(view: GoalView) -> anyhow::Result<FitProblem> {
    let start = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    Ok(FitProblem::new(start, view))
}

fn foreign_view(name: &str) -> anyhow::Result<GoalView> {
    let options = GoalOptions { max_side: Some(SIZE), ..GoalOptions::default() };
    let picture = foreign::picture(name).with_context(|| format!("{name} is not built in"))?;
    let picture = Picture::from_encoded(&Encoded::new(name, picture.to_vec()), &options)?;
    let frame = picture.frame(HEIGHT);
    Ok(GoalView::new(picture.bitmap, View::FRONT, frame))
}

/// The pictures of a folder by their names.
fn pictures(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let unreadable = || format!("cannot read the folder of photographs {}", folder.display());
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase);
        if path.is_file() && ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str())) {
            found.push(path);
        }
    }
    ensure!(
        !found.is_empty(),
        "{} holds no picture, expected files that end in {}",
        folder.display(),
        ENDINGS.join(", ")
    );
    found.sort();
    Ok(found)
}

/// Those of `all` that one of `words` names: a set, or a goal.
pub(super) fn only(all: Vec<Origin>, words: &[&str]) -> Result<Vec<Origin>, String> {
    let sets = || Set::ALL.iter().map(|set| set.name());
    for word in words {
        let names: Vec<String> = all.iter().map(Origin::name).collect();
        if sets().all(|set| set != *word) && names.iter().all(|name| name != word) {
            let near = nearest(word, sets().chain(names.iter().map(String::as_str)));
            let near = near.map_or_else(String::new, |near| format!(", did you mean `{near}`?"));
            let sets: Vec<&str> = sets().collect();
            return Err(format!(
                "no goal and no set of goals is called `{}`{near}; sets are {}",
                shown(word),
                sets.join(", ")
            ));
        }
    }
    let is_named = |origin: &Origin| words.iter().any(|w| *w == origin.set().name() || *w == origin.name());
    let kept: Vec<Origin> = all.into_iter().filter(is_named).collect();
    if kept.is_empty() {
        return Err("no goal is left: `photographs` names their folder".to_owned());
    }
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exam_has_seventy_goals_of_its_own() {
        let all = Origin::all(AROUND, None).unwrap();
        let count = |set| all.iter().filter(|origin| origin.set() == set).count();
        assert_eq!(Set::ALL.map(count), [60, 10, 0]);
        assert_eq!(
            (all[0].name(), all[16].name(), all[69].name()),
            ("acer-1".into(), "apple-2".into(), "treegen_small_pine".into())
        );
        let known: Vec<&str> = SPECIES.to_vec();
        assert!(known.iter().all(|name| pleach_generators::preset(name).is_some()));
    }

    #[test]
    fn a_goal_of_ours_has_a_truth_and_a_side() {
        let origin = Origin::Around { species: "lombardy_poplar", number: 2 };
        let goal = origin.goal().unwrap();
        let own = goal.own.as_ref().unwrap();
        let drawn = crate::pictured::draw(
            &own.truth.species,
            own.truth.seed,
            own.truth.species.foliage,
            &goal.problem.goals[0],
        );
        assert_eq!(drawn.unwrap(), *goal.picture());
        assert_ne!(own.side.goals[0].goal, *goal.picture());
        let other = Origin::Around { species: "lombardy_poplar", number: 1 }.goal().unwrap();
        assert_ne!(other.picture(), goal.picture());
        assert_eq!((goal.group, other.group), ("lombardy_poplar".to_owned(), "lombardy_poplar".to_owned()));
        let foreign = Origin::Foreign("treegen_acer_bare").goal().unwrap();
        assert!((foreign.height() - HEIGHT).abs() < 0.5 && foreign.own.is_none());
    }

    #[test]
    fn goals_are_chosen_by_set_or_by_name() {
        let all = || Origin::all(1, None).unwrap();
        let names = |words: &[&str]| -> Vec<String> {
            only(all(), words).unwrap().iter().map(Origin::name).collect()
        };
        assert_eq!(names(&["palm-1"]), ["palm-1"]);
        assert_eq!(names(&["foreign", "acer-1"]).len(), 11);
        let error = only(all(), &["palm-9"]).unwrap_err();
        assert!(error.contains("`palm-9`, did you mean `palm-1`?"), "{error}");
        let error = only(all(), &["foreigns"]).unwrap_err();
        assert!(
            error.contains("did you mean `foreign`?; sets are perturbed, foreign, photographs"),
            "{error}"
        );
        assert!(only(all(), &["photographs"]).unwrap_err().contains("no goal is left"));
    }

    #[test]
    fn photographs_come_from_a_folder() {
        let folder = tempfile::tempdir().unwrap();
        let all = |folder: &Path| Origin::all(1, Some(folder)).map_err(|error| format!("{error:#}"));
        assert!(all(folder.path()).unwrap_err().contains("holds no picture, expected files that end in png"));
        assert!(
            all(&folder.path().join("none")).unwrap_err().contains("cannot read the folder of photographs")
        );
        let picture = Bitmap::from_fn(400, 300, |x, y| (150..250).contains(&x) && (20..280).contains(&y));
        std::fs::write(folder.path().join("oak.png"), picture.to_png()).unwrap();
        std::fs::write(folder.path().join("notes.txt"), "no picture").unwrap();
        let found = all(folder.path()).unwrap();
        assert_eq!(
            (found.len(), found[25].name(), found[25].set()),
            (26, "oak".to_owned(), Set::Photographs)
        );
        assert_eq!(
            found[25].goal().unwrap().picture().width().max(found[25].goal().unwrap().picture().height()),
            SIZE
        );
        std::fs::write(folder.path().join("Palm-1.png"), picture.to_png()).unwrap();
        assert!(all(folder.path()).unwrap_err().contains("a picture called `palm-1`, as another goal is"));
    }
}
