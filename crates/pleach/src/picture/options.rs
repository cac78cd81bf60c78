//! Everything that a whole fit may be asked for.

use super::corrections::Corrections;
use super::direction::{Direction, FurtherView};
use super::effort::{Effort, MAX_SECONDS};
use super::hints::MaskHints;
use super::json;
use super::words::{AppearanceFrom, KnownFrame, Leaves, MaskFrom, StartFrom, Tone, VolumeFrom};
use crate::option_error::OptionError;
use crate::plan::USUAL_TIME;
use pleach_fit::{
    Azimuth, IndividualSettings, Objective, Optimizer, PosteriorSettings, RulesSettings, TreeSeed,
};
use pleach_generators::GeneratorChoice;
use serde::{Deserialize, Serialize};
use std::num::NonZeroU32;
use std::time::Duration;

/// Everything that a whole fit may be asked for; the defaults are those of `pleach fit GOAL`.
///
/// In JSON the keys are the names of the fields; a key that is left out has its default, and one that is not known is
/// refused. Fields that are enumerations are written as on the command line of the program.
///
/// ```
/// let options: pleach::FitOptions = serde_json::from_str(r#"{ "height": 18, "timeout": 20, "optimizer": "cma" }"#)?;
/// assert_eq!(options.optimizer.name(), "cma");
/// assert!(serde_json::from_str::<pleach::FitOptions>(r#"{ "heihgt": 18 }"#).is_err());
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FitOptions {
    /// Height of the tree in metres, above 0 and at most 1000: a silhouette does not show it. Not looked at where
    /// `frame` says the scale.
    pub height: f64,
    /// Longer side of the pictures that the search compares, in pixels, from 16 to 2048; larger goals are reduced.
    pub size: u32,
    /// What says where in the goal the tree is; by default its tones do.
    #[serde(with = "json::optional_text")]
    pub mask: Option<MaskFrom>,
    /// What is shown of the tree in a photograph; the goal is one where anything is.
    pub hints: MaskHints,
    /// A picture of the goal's size that says what of the tree is wood, trunk and branches: black on white. Its name in
    /// [`super::FitSource::pictures`], or a file.
    pub wood: Option<String>,
    /// What is otherwise in the goal than it is read: the keys of `reading.json`, or some of them. A first guess passes
    /// over trees that contradict it.
    pub reading: Corrections,
    /// Which tone of the goal is the tree.
    pub tree: Tone,
    /// Row where the tree stands, in pixels of the goal from its top edge; detected by default.
    pub ground_row: Option<f64>,
    /// Column of the trunk's foot, in pixels of the goal from its left edge; detected by default.
    pub axis_column: Option<f64>,
    /// Scale and place of the tree where they are known. Otherwise they are read off the picture, and registered to a
    /// part of a pixel by the trees that are tried.
    pub frame: Option<KnownFrame>,
    /// The direction of the goal's view; the front by default.
    #[serde(with = "json::optional_text")]
    pub view: Option<Direction>,
    /// Further pictures of the same tree, which are fitted as well.
    #[serde(with = "json::texts")]
    pub views: Vec<FurtherView>,
    /// Whether the scale (± 20 %) and the place (± 10 % of width and height) of the tree in further pictures are
    /// searched.
    pub free_frame: bool,
    /// Further pictures of the same tree from known directions, which are scored and not fitted.
    #[serde(with = "json::texts")]
    pub holdout_views: Vec<FurtherView>,
    /// Whether the tree has leaves.
    pub leaves: Leaves,
    /// Where the colours and the season of the result come from.
    pub appearance: AppearanceFrom,
    /// Where the search starts.
    #[serde(with = "json::text")]
    pub from: StartFrom,
    /// The generators whose species take part in a first guess, and that random lists are drawn for; by default the
    /// one of the species in `from`; for a picture Weber and Penn's and space colonisation, for a drawing in flat colours
    /// stylised trees; and Weber and Penn's for silhouettes of less than 100 pixels of height, and where no picture is
    /// asked.
    #[serde(with = "json::optional_text")]
    pub generator: Option<GeneratorChoice>,
    /// Start from a tree of least-cost paths in the outline of a picture.
    #[serde(with = "json::optional_text")]
    pub volume_from: Option<VolumeFrom>,
    /// Patterns of the parameters that may change: a name, a slot such as `length[1]`, a group, or `level:N`; all by
    /// default.
    pub free: Vec<String>,
    /// Patterns of the parameters that keep the start's value.
    pub fix: Vec<String>,
    /// The optimiser and its settings; in JSON its name, or an object such as `{"cma": {"population": 20}}`.
    #[serde(with = "json::optimizer")]
    pub optimizer: Optimizer,
    /// Whether the rules of a grammar are searched too, by genetic programming in the place of the optimiser.
    pub evolve_rules: bool,
    /// What the search minimises; by default what suits it.
    pub objective: Option<Objective>,
    /// Seed of the search, at most 2⁵³.
    pub seed: u64,
    /// Seed of the tree; in JSON a number of at most 2⁵³, or `"any"` to search it too.
    #[serde(with = "json::tree_seed")]
    pub tree_seed: TreeSeed,
    /// Number of trees, of the tree seed and those after it, over whose mean parameters are scored; at most 64.
    pub robust: NonZeroU32,
    /// How long the goal's own tree is searched, once its kind is found.
    #[serde(with = "json::text")]
    pub individual: Effort,
    /// How many trees are to lie on the goal in the end; they share the time of `individual`.
    pub individuals: u8,
    /// Number of trees around the species that the search started from, 100 to 20 000, from which the fit learns, in the
    /// end, how surely the goal determines each number; not part of `timeout`.
    pub posterior: Option<u32>,
    /// Time for all of the fit, in JSON in seconds; above 0 and at most 10 000 000 s. A minute if neither this nor
    /// `evaluations` nor `generations` is given.
    #[serde(with = "json::seconds")]
    pub timeout: Option<Duration>,
    /// Number of trees that the search grows and scores, at least 1.
    pub evaluations: Option<u64>,
    /// Number of generations of the search, at least 1.
    pub generations: Option<u64>,
    /// Intersection over union, from 0 to 1, that ends the search.
    pub target_iou: Option<f64>,
    /// What the species that is found is called; by default as the goal's file.
    pub name: Option<String>,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            height: 10.0,
            size: 256,
            mask: None,
            hints: MaskHints::default(),
            wood: None,
            reading: Corrections::default(),
            tree: Tone::Auto,
            ground_row: None,
            axis_column: None,
            frame: None,
            view: None,
            views: Vec::new(),
            free_frame: false,
            holdout_views: Vec::new(),
            leaves: Leaves::Auto,
            appearance: AppearanceFrom::Picture,
            from: StartFrom::Auto,
            generator: None,
            volume_from: None,
            free: Vec::new(),
            fix: Vec::new(),
            optimizer: Optimizer::default(),
            evolve_rules: false,
            objective: None,
            seed: 1,
            tree_seed: TreeSeed::Fixed(1),
            robust: NonZeroU32::MIN,
            individual: Effort::Share,
            individuals: 1,
            posterior: None,
            timeout: None,
            evaluations: None,
            generations: None,
            target_iou: None,
            name: None,
        }
    }
}

/// What earlier parts of a fit have used, where a finished one is continued: its budgets count from there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// Time.
    pub time: Duration,
    /// Trees.
    pub evaluations: u64,
    /// Generations.
    pub generations: u64,
}

/// The largest seed: larger numbers do not survive JSON and species files.
const MAX_SEED: u64 = 1 << 53;
/// The most trees that parameters are scored by: more than the spread of seeds needs.
const MAX_ROBUST: u32 = 64;

impl FitOptions {
    /// Reads options from JSON, as the type's own `Deserialize` does, and tells which of them is wrong.
    ///
    /// # Errors
    /// The first key that is not an option, or whose value cannot be read.
    pub fn from_json(text: &str) -> Result<Self, OptionError> {
        crate::option_error::from_json(text)
    }

    /// What the search minimises: what was asked for, or what suits it.
    #[must_use]
    pub fn whole_objective(&self) -> Objective {
        let usual = if self.evolve_rules { RulesSettings::OBJECTIVE } else { Objective::default() };
        self.objective.unwrap_or(usual)
    }

    /// The same options with defaults that depend on other options spelled out: `objective` and `timeout`.
    #[must_use]
    pub fn spelled_out(&self) -> Self {
        Self { objective: Some(self.whole_objective()), timeout: self.whole_time(), ..self.clone() }
    }

    /// The time for all of the fit, where it is bounded.
    #[must_use]
    pub fn whole_time(&self) -> Option<Duration> {
        let is_counted = self.evaluations.or(self.generations).is_some();
        self.timeout.or((!is_counted).then_some(USUAL_TIME))
    }

    /// The same options for a fit that continues another one, which has used `spent`.
    #[must_use]
    pub fn after(&self, spent: &Spent) -> Self {
        Self {
            timeout: self.whole_time().map(|time| time + spent.time),
            evaluations: self.evaluations.map(|count| count + spent.evaluations),
            generations: self.generations.map(|count| count + spent.generations),
            ..self.clone()
        }
    }

    /// The pictures and files that the options name and that are files: a fit reads them beside its goal.
    #[must_use]
    pub fn files(&self) -> Vec<&str> {
        let mask = self.mask.iter().filter_map(|mask| match mask {
            MaskFrom::Auto => None,
            MaskFrom::File(file) => Some(file.as_str()),
        });
        // A species may be one by name.
        let from = match &self.from {
            StartFrom::Species(name) if std::path::Path::new(name).is_file() => Some(name.as_str()),
            _ => None,
        };
        self.pictures().into_iter().chain(mask).chain(from).collect()
    }

    /// The pictures that the options name and that [`super::FitSource::pictures`] may have: all but a mask.
    #[must_use]
    pub fn pictures(&self) -> Vec<&str> {
        let views = self.views.iter().chain(&self.holdout_views).map(|view| view.picture.as_str());
        let shown = [&self.hints.strokes, &self.wood].into_iter().filter_map(Option::as_deref);
        let volume = self.volume_from.iter().filter_map(|volume| match volume {
            VolumeFrom::Goal => None,
            VolumeFrom::Picture(picture) => Some(picture.as_str()),
        });
        views.chain(shown).chain(volume).collect()
    }

    /// Tells whether each option has a value that can be, and whether they go together. What depends on a picture or on
    /// species are reported by [`FitOptions::start`] and [`FitOptions::prepare`], which check all of this too.
    ///
    /// # Errors
    /// The first option that is wrong.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_goal()?;
        self.check_search()?;
        self.check_budget()
    }

    fn check_goal(&self) -> Result<(), OptionError> {
        let error = |option, problem: String| Err(OptionError::new(option, problem));
        if !(self.height > 0.0 && self.height <= 1000.0) {
            return error("height", format!("is {} m, expected above 0 and up to 1000", self.height));
        }
        if !(16..=2048).contains(&self.size) {
            return error("size", format!("is {}, expected from 16 to 2048 pixels", self.size));
        }
        self.hints.check()?;
        self.reading.check()?;
        if let (Some(MaskFrom::File(file)), false) = (&self.mask, self.hints.is_empty()) {
            return error(
                "hints",
                format!("are for a photograph, and `mask` says what is tree: leave out {file}"),
            );
        }
        if let Some(frame) = self.frame {
            let scale = frame.meters_per_pixel;
            if !(scale > 0.0 && scale.is_finite()) {
                return error("frame", format!("has {scale} metres per pixel, expected a number above 0"));
            }
            for (option, given) in [("ground_row", self.ground_row), ("axis_column", self.axis_column)] {
                if given.is_some() {
                    return error(option, "is said by `frame` already: leave out one of them".to_owned());
                }
            }
        }
        let own = self.view.iter().map(|view| ("view", view));
        let further = self.views.iter().map(|view| ("views", &view.direction));
        let held_out = self.holdout_views.iter().map(|view| ("holdout_views", &view.direction));
        for (option, direction) in own.chain(further).chain(held_out) {
            if !direction.is_valid() {
                return error(
                    option,
                    format!(
                        "is from {direction} degrees, expected azimuth, or azimuth,elevation, the elevation from -90 to 90"
                    ),
                );
            }
        }
        if self.holdout_views.iter().any(|view| view.azimuth != Azimuth::Known) {
            return error(
                "holdout_views",
                "has a picture that is not fitted and whose direction is not known, expected one such as 90=side.png"
                    .to_owned(),
            );
        }
        if self.free_frame && self.views.is_empty() {
            return error(
                "free_frame",
                "is about further pictures, and there are none: `views` auto=FILE adds one".to_owned(),
            );
        }
        Ok(())
    }

    fn check_search(&self) -> Result<(), OptionError> {
        let error = |option, problem: String| Err(OptionError::new(option, problem));
        if self.volume_from.is_some() {
            if self.from != StartFrom::Auto {
                return error("volume_from", "says where to start, and so does `from`".to_owned());
            }
            if self.evolve_rules {
                return error(
                    "volume_from",
                    "makes a tree of paths, which has no rules: leave out `evolve_rules`".to_owned(),
                );
            }
        }
        if self.evolve_rules && self.optimizer != Optimizer::default() {
            return error(
                "optimizer",
                "is not used by a search over rules: leave it out, or `evolve_rules`".to_owned(),
            );
        }
        for (option, seed) in [("seed", Some(self.seed)), ("tree_seed", self.fixed_tree_seed())] {
            if let Some(seed) = seed.filter(|seed| *seed > MAX_SEED) {
                return error(option, format!("is {seed}, expected a whole number from 0 to {MAX_SEED}"));
            }
        }
        if self.robust.get() > MAX_ROBUST {
            return error("robust", format!("is {}, expected from 1 to {MAX_ROBUST} trees", self.robust));
        }
        Ok(())
    }

    fn check_budget(&self) -> Result<(), OptionError> {
        let error = |option, problem: String| Err(OptionError::new(option, problem));
        if let Some(time) = self.timeout.map(|time| time.as_secs_f64())
            && !(time > 0.0 && time <= MAX_SECONDS)
        {
            return error("timeout", format!("is {time} s, expected above 0 and up to 10 000 000"));
        }
        for (option, count) in [("evaluations", self.evaluations), ("generations", self.generations)] {
            if count == Some(0) {
                return error(option, "is 0, expected 1 or more".to_owned());
            }
        }
        if let Some(iou) = self.target_iou.filter(|iou| !(0.0..=1.0).contains(iou)) {
            return error("target_iou", format!("is {iou}, expected from 0 to 1"));
        }
        let most = IndividualSettings::MAX_COUNT;
        if !(1..=most).contains(&self.individuals) {
            return error("individuals", format!("is {}, expected 1 to {most}", self.individuals));
        }
        if self.individuals > 1 && self.individual == Effort::Off {
            return error("individuals", "asks for trees, and `individual` is off".to_owned());
        }
        self.posterior_settings()?;
        self.effort_settings().map(|_| ())
    }

    /// How a posterior is learnt; `None` if it is not asked for.
    pub(super) fn posterior_settings(&self) -> Result<Option<PosteriorSettings>, OptionError> {
        let Some(trees) = self.posterior else { return Ok(None) };
        let expected = PosteriorSettings::MIN_TREES..=PosteriorSettings::MAX_TREES;
        let error = |problem: String| Err(OptionError::new("posterior", problem));
        if !expected.contains(&(trees as usize)) {
            return error(format!("is {trees}, expected {} to {} trees", expected.start(), expected.end()));
        }
        if self.evolve_rules {
            return error("does not apply where rules are searched: they have no intervals".to_owned());
        }
        Ok(Some(PosteriorSettings { trees: trees as usize, seed: self.seed, ..PosteriorSettings::default() }))
    }

    /// How the goal's own tree is searched where the generator allows it; `None` if it is off.
    pub(super) fn effort_settings(&self) -> Result<Option<IndividualSettings>, OptionError> {
        let one = self.individual.settings(self.whole_time(), self.evaluations);
        let one = one
            .map_err(|late| OptionError::new("individual", format!("is too long: {late}, see `timeout`")))?;
        Ok(one.map(|one| IndividualSettings { count: self.individuals, ..one }))
    }

    fn fixed_tree_seed(&self) -> Option<u64> {
        match self.tree_seed {
            TreeSeed::Fixed(seed) => Some(seed),
            TreeSeed::Any => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every field with a value that is not its default, as JSON.
    pub(crate) const OTHERS: &str = r#"{
        "height": 12.0, "size": 64, "mask": "auto",
        "hints": { "box": [1, 2, 30, 40], "include": [[5, 6]], "exclude": [[7, 8]], "strokes": "marks.png" },
        "wood": "wood.png", "reading": { "trunks": 2 }, "tree": "dark", "ground_row": 200.0, "axis_column": 100.5,
        "frame": [0.05, 30.0, 60.0], "view": "30", "views": ["auto=other.png"], "free_frame": true,
        "holdout_views": ["45,2=corner.png"], "leaves": "on", "appearance": "species", "from": "acer", "generator": "fractal",
        "volume_from": "goal", "free": ["crown"], "fix": ["leaves"], "optimizer": { "cma": { "population": 20 } },
        "evolve_rules": true, "objective": "iou", "seed": 2, "tree_seed": "any", "robust": 3, "individual": "20s",
        "individuals": 2, "posterior": 300, "timeout": 20.5, "evaluations": 30, "generations": 7, "target_iou": 0.5, "name": "oak"
    }"#;

    #[test]
    fn options_read_back_from_json_and_every_field_has_a_default() {
        let usual = FitOptions::default();
        let written = serde_json::to_value(&usual).unwrap();
        assert_eq!(serde_json::from_value::<FitOptions>(written.clone()).unwrap(), usual);
        assert_eq!(serde_json::from_str::<FitOptions>("{}").unwrap(), usual);
        let other: FitOptions = serde_json::from_str(OTHERS).unwrap();
        let back = serde_json::to_value(&other).unwrap();
        assert_eq!(serde_json::from_value::<FitOptions>(back.clone()).unwrap(), other);
        for (name, value) in written.as_object().unwrap() {
            assert_ne!(back[name], *value, "{name} is lost, or not in the list of others");
        }
    }

    #[test]
    fn unknown_keys_and_values_are_refused_in_words() {
        assert_eq!(FitOptions::from_json(OTHERS).unwrap(), serde_json::from_str(OTHERS).unwrap());
        let error = |text| FitOptions::from_json(text).unwrap_err().to_string();
        assert!(error(r#"{"heihgt": 3}"#).starts_with("`heihgt` is 3: unknown field"));
        assert!(
            error(r#"{"seed": -1}"#).contains("`seed` is -1")
                && error(r#"{"seed": -1}"#).contains("whole number")
        );
        assert!(error(r#"{"robust": 0}"#).contains("a whole number of 1 or more"));
        assert!(error("[]").contains("object"));
        assert!(error(r#"{"optimizer": "cmaes"}"#).contains("known are evolution"));
        assert!(error(r#"{"optimizer": {"cma": {"population": -1}}}"#).contains("expected a whole number"));
        assert!(error(r#"{"tree_seed": "all"}"#).contains("\"any\""));
        assert!(error(r#"{"timeout": -3}"#).contains("-3 s"));
    }

    #[test]
    fn each_wrong_option_is_named() {
        let with = |change: fn(&mut FitOptions)| {
            let mut options = FitOptions::default();
            change(&mut options);
            options.check().unwrap_err().option.into_owned()
        };
        assert_eq!(FitOptions::default().check(), Ok(()));
        assert_eq!(with(|o| o.height = f64::NAN), "height");
        assert_eq!(with(|o| o.height = 1000.1), "height");
        assert_eq!(with(|o| o.size = 15), "size");
        assert_eq!(with(|o| o.frame = Some((0.0, 1.0, 1.0).into())), "frame");
        assert_eq!(
            with(|o| (o.frame, o.ground_row) = (Some((0.1, 1.0, 1.0).into()), Some(2.0))),
            "ground_row"
        );
        assert_eq!(with(|o| o.view = Some(Direction { azimuth: 0.0, elevation: 91.0 })), "view");
        assert_eq!(with(|o| o.holdout_views = vec!["auto=a.png".parse().unwrap()]), "holdout_views");
        assert_eq!(with(|o| o.free_frame = true), "free_frame");
        assert_eq!(with(|o| (o.volume_from, o.evolve_rules) = (Some(VolumeFrom::Goal), true)), "volume_from");
        assert_eq!(
            with(|o| (o.volume_from, o.from) = (Some(VolumeFrom::Goal), StartFrom::Random)),
            "volume_from"
        );
        assert_eq!(with(|o| (o.evolve_rules, o.optimizer) = (true, "cma".parse().unwrap())), "optimizer");
        assert_eq!(with(|o| o.seed = MAX_SEED + 1), "seed");
        assert_eq!(with(|o| o.tree_seed = TreeSeed::Fixed(u64::MAX)), "tree_seed");
        assert_eq!(with(|o| o.robust = NonZeroU32::new(65).unwrap()), "robust");
        assert_eq!(with(|o| o.timeout = Some(Duration::ZERO)), "timeout");
        assert_eq!(with(|o| o.evaluations = Some(0)), "evaluations");
        assert_eq!(with(|o| o.generations = Some(0)), "generations");
        assert_eq!(with(|o| o.target_iou = Some(1.5)), "target_iou");
        assert_eq!(with(|o| o.posterior = Some(99)), "posterior");
        assert_eq!(with(|o| o.posterior = Some(20_001)), "posterior");
        assert_eq!(with(|o| (o.posterior, o.evolve_rules) = (Some(200), true)), "posterior");
        assert_eq!(with(|o| o.individuals = 0), "individuals");
        assert_eq!(with(|o| (o.individuals, o.individual) = (2, Effort::Off)), "individuals");
        assert_eq!(with(|o| o.individual = Effort::Time(Duration::from_secs(60))), "individual");
    }
}
