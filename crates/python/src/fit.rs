//! Whole fits, as `pleach fit` makes them.

use crate::arrays::{numbers, of_ink, whole};
use crate::error::{FitError, of_fit};
use crate::frame::KnownFrame;
use crate::goal::Source;
use crate::pool;
use crate::score::of_card;
use crate::seed::Seed;
use crate::species::Species;
use crate::told::{Teller, Told};
use crate::view::{Direction, view};
use numpy::PyArray2;
use pleach::plan::{
    DRAWING, Effort, Origin, Shares, USUAL_TIME, has_individuals, library, plan, usual_start,
};
use pleach::{
    Accuracy, Bitmap, Budget, COLUMNS, Control, Crop, FitProblem, FitSettings, Fitted, Foliage, Frame,
    Freedom, GeneratorChoice, Goal, GoalOptions, GoalSettings, GoalView, Growth, Identifiability,
    IndividualSettings, Placement, Profile, Rasterizer, ScoreCard, TreeSeed, View, fit_goal_with,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// How often Python is asked whether it was interrupted.
const LOOK: Duration = Duration::from_millis(50);

/// What `pleach.fit` was asked for, checked there only for names.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Options {
    from_: From,
    generator: Option<String>,
    height: f64,
    size: u32,
    frame: Option<KnownFrame>,
    view: Option<Direction>,
    /// Further pictures and from where they were taken.
    views: Vec<(Py<PyAny>, Direction)>,
    leaves: Option<bool>,
    optimizer: String,
    objective: String,
    free: Vec<String>,
    fix: Vec<String>,
    /// Seeds are read later, so that what is wrong with one is told as what is wrong with others.
    seed: Py<PyAny>,
    tree_seed: Option<Py<PyAny>>,
    timeout: Option<f64>,
    evaluations: Option<u64>,
    generations: Option<u64>,
    individual: How,
    individuals: u8,
    name: Option<String>,
    threads: Option<usize>,
}

/// Where the fit begins.
#[derive(FromPyObject)]
enum From {
    #[pyo3(transparent)]
    Species(Species),
    #[pyo3(transparent)]
    Name(String),
}

/// How long this very tree is searched.
#[derive(FromPyObject)]
enum How {
    /// Whether it is.
    #[pyo3(transparent)]
    Switch(bool),
    /// Seconds, or a number of trees such as `400trees`.
    #[pyo3(transparent)]
    Seconds(f64),
    #[pyo3(transparent)]
    Trees(String),
}

impl How {
    fn effort(&self) -> PyResult<Effort> {
        Ok(match self {
            Self::Switch(true) => Effort::Share,
            Self::Switch(false) => Effort::Off,
            Self::Seconds(seconds) => Effort::Time(duration("individual", *seconds)?),
            Self::Trees(text) if text == "off" => Effort::Off,
            Self::Trees(text) => {
                let count = text.strip_suffix("trees").and_then(|count| count.parse().ok());
                Effort::Trees(count.filter(|count| *count > 0).ok_or_else(|| {
                    FitError::new_err(format!(
                        "individual is {text:?}, expected True, False or \"off\", seconds, or a number of trees such as \"400trees\""
                    ))
                })?)
            }
        })
    }
}

fn duration(name: &str, seconds: f64) -> PyResult<Duration> {
    if seconds > 0.0 && seconds <= 1e7 {
        return Ok(Duration::from_secs_f64(seconds));
    }
    Err(FitError::new_err(format!("{name} is {seconds} s, expected above 0 and up to 10 000 000")))
}

/// A picture of the goal's tree, and from where it was taken.
struct Picture {
    /// At its own size, as scores are of it.
    full: Goal,
    /// As the search compares with it.
    working: Goal,
    /// As it was given.
    given: Goal,
    view: View,
}

/// Everything that a fit begins with.
struct Asked {
    name: String,
    height: f64,
    /// The goal, and then further views.
    pictures: Vec<Picture>,
    problem: FitProblem,
    settings: GoalSettings,
    threads: Option<usize>,
}

impl Asked {
    fn new(goal: &Bound<'_, PyAny>, options: &Options) -> PyResult<Self> {
        let source = Source::read(goal)?;
        if !(options.height > 0.0 && options.height <= 1000.0) {
            return Err(FitError::new_err(format!(
                "height is {} m, expected above 0 and up to 1000",
                options.height
            )));
        }
        if !(16..=2048).contains(&options.size) {
            return Err(FitError::new_err(format!(
                "size is {}, expected from 16 to 2048 pixels",
                options.size
            )));
        }
        let mut goals = Vec::new();
        let mut pictures: Vec<Picture> = Vec::new();
        let mut height = options.height;
        let mut add = |source: &Source, view, known: Option<KnownFrame>| -> PyResult<()> {
            let cropped = GoalOptions { crop: Crop::ToTree, ..known.map_or_else(whole, KnownFrame::options) };
            let working = source.goal(&GoalOptions { max_side: Some(options.size), ..cropped.clone() })?;
            let full = source.goal(&cropped)?;
            if let Some(known) = known {
                height = known.meters_per_pixel() * full.height_in_pixels();
            }
            let accuracy = if known.is_some() { Accuracy::Exact } else { Accuracy::Pixel };
            let goal_view = GoalView::new(working.bitmap.clone(), view, working.frame(height));
            goals.push(GoalView { accuracy, ..goal_view });
            pictures.push(Picture { full, working, given: source.goal(&whole())?, view });
            Ok(())
        };
        let known = options.frame.map(KnownFrame::checked).transpose()?;
        add(&source, view(options.view)?, known)?;
        for (further, direction) in &options.views {
            add(&Source::read(further.bind(goal.py()))?, direction.view()?, None)?;
        }
        let given = match &options.from_ {
            From::Species(species) => Some(species.inner.kind()),
            From::Name(name) if ["auto", "random"].contains(&name.as_str()) => None,
            From::Name(name) => Some(pleach::species(name).map_err(of_fit)?.kind()),
        };
        let generator = match (&options.generator, &given) {
            (Some(name), _) => name.parse().map_err(FitError::new_err)?,
            (None, Some(species)) => GeneratorChoice::Family(species.generator.family()),
            (None, None) => GeneratorChoice::default(),
        };
        let start = match &given {
            Some(species) if generator.takes(species) => species.clone(),
            Some(species) => {
                return Err(FitError::new_err(format!(
                    "the start is of the generator {}, and generator says {generator}",
                    species.generator.family()
                )));
            }
            None => usual_start(generator).ok_or_else(|| FitError::new_err("a generator has species"))?,
        };
        let origin = match (&options.from_, &given) {
            (_, Some(_)) => Origin::Start,
            (From::Name(name), None) if name == "random" => Origin::Random,
            _ => Origin::Guess { detect_leaves: options.leaves.is_none() },
        };
        let foliage = if options.leaves == Some(false) { Foliage::None } else { Foliage::All };
        let problem = FitProblem { start, goals, foliage };
        let settings = settings(options, origin, generator, &problem)?;
        let name = options.name.clone().unwrap_or_else(|| source.name());
        let threads = options.threads;
        Ok(Self { name, height, pictures, problem, settings, threads })
    }

    /// A species of the fit as it is given back.
    fn named(&self, species: pleach::Species) -> Species {
        let name = pleach::species::safe_name(&self.name);
        pleach::Species { name, description: String::new(), ..species }.into()
    }

    /// The silhouettes of a species over the pictures at their own size, and how well they match.
    fn matched(
        &self,
        species: &Species,
        fitted: &Fitted,
        places: &[Placement],
    ) -> PyResult<Vec<(ScoreCard, Bitmap)>> {
        let foliage = fitted.problem.foliage;
        let seed = species.inner.tree_seed.unwrap_or(1);
        let growth = Growth { foliage, limits: fitted.settings.limits, ..Growth::seed(seed) };
        let tree = species.inner.grow_with(&growth).map_err(of_fit)?;
        let mut rasterizer = Rasterizer::new();
        let mut draw = |view: &View, frame: &Frame| {
            let mut ink = Bitmap::default();
            rasterizer.draw(&tree, view, frame, foliage.into(), &mut ink);
            ink
        };
        let one = |(Picture { full, view, .. }, place): (&Picture, &Placement)| {
            let frame = place.frame(&full.frame(self.height));
            let ink = draw(view, &frame);
            let card = ScoreCard::new(&ink, &full.bitmap).map_err(of_fit)?;
            Ok((card, if full.is_whole() { ink } else { draw(view, &full.original_frame(&frame)) }))
        };
        self.pictures.iter().zip(places).map(one).collect()
    }

    /// Where the tree of `species` stands in each picture at its own size.
    fn places(&self, py: Python<'_>, species: &Species, fitted: &Fitted) -> PyResult<Vec<Placement>> {
        let foliage = fitted.problem.foliage;
        let seed = species.inner.tree_seed.unwrap_or(1);
        let growth = Growth { foliage, limits: fitted.settings.limits, ..Growth::seed(seed) };
        let tree = species.inner.grow_with(&growth).map_err(of_fit)?;
        let one = |(Picture { full, working, .. }, view): (&Picture, &GoalView)| {
            pleach::place_at_full_size(&tree, foliage, (full, working), view, self.height)
        };
        // On threads that end here: a child that forks later has none that it would wait for.
        pool::on(py, self.threads, || self.pictures.iter().zip(&fitted.problem.goals).map(one).collect())
    }

    /// The goal as it was given.
    fn goal(&self) -> &Goal {
        &self.pictures[0].given
    }
}

/// A species with how well it matches the goal, its silhouette over it, and how well it matches further views.
type Matched<'py> = (Species, Bound<'py, PyAny>, Bound<'py, PyArray2<bool>>, Vec<Bound<'py, PyAny>>);

fn matched<'py>(
    py: Python<'py>,
    species: Species,
    mut matches: Vec<(ScoreCard, Bitmap)>,
) -> PyResult<Matched<'py>> {
    let further = matches.split_off(1);
    let (card, ink) = &matches[0];
    let further = further.iter().map(|(card, _)| of_card(py, card)).collect::<PyResult<_>>()?;
    Ok((species, of_card(py, card)?, of_ink(py, ink)?, further))
}

fn settings(
    options: &Options,
    origin: Origin,
    generator: GeneratorChoice,
    problem: &FitProblem,
) -> PyResult<GoalSettings> {
    let Seed(seed) = Seed::read(&options.seed)?;
    let tree_seed = options.tree_seed.as_ref().map(Seed::read).transpose()?;
    let timeout = options.timeout.map(|seconds| duration("timeout", seconds)).transpose()?;
    let is_bounded = timeout.is_some() || options.evaluations.is_some() || options.generations.is_some();
    let timeout = timeout.or((!is_bounded).then_some(USUAL_TIME));
    let individual = match has_individuals(generator) {
        true => options.individual.effort()?.settings(timeout, options.evaluations).map_err(of_fit)?,
        false => None,
    };
    if !(1..=IndividualSettings::MAX_COUNT).contains(&options.individuals) {
        let most = IndividualSettings::MAX_COUNT;
        return Err(FitError::new_err(format!(
            "individuals is {}, expected 1 to {most}",
            options.individuals
        )));
    }
    let individual = individual.map(|one| IndividualSettings { count: options.individuals, ..one });
    let shares = timeout.map(|whole| Shares::new(whole, individual.as_ref()));
    let search = FitSettings {
        optimizer: options.optimizer.parse().map_err(of_fit)?,
        objective: options.objective.parse().map_err(of_fit)?,
        budget: Budget {
            timeout: shares.map(|shares| shares.search),
            evaluations: options.evaluations,
            generations: options.generations,
            target_iou: None,
            kept: None,
        },
        seed,
        tree_seed: tree_seed.map_or(TreeSeed::Any, |Seed(seed)| TreeSeed::Fixed(seed)),
        freedom: Freedom { free: options.free.clone(), fix: options.fix.clone() },
        ..FitSettings::default()
    };
    let planned = plan(origin, generator, &problem.start, search).map_err(of_fit)?;
    let settings = GoalSettings { individual, ..planned };
    Ok(match shares {
        Some(shares) => shares.bound(settings, DRAWING, DRAWING),
        None => settings,
    })
}

/// Fits a goal. Returns what was found as a dict, and whether Python was interrupted; `progress` is called with a
/// dict for each step.
#[pyfunction]
pub(crate) fn fit<'py>(
    py: Python<'py>,
    goal: &Bound<'py, PyAny>,
    options: &Bound<'py, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = Asked::new(goal, &options.extract()?)?;
    let (fitted, asked_to_end) = watched(py, &asked, progress.as_ref())?;
    if let Some(error) = &asked_to_end
        && !error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py)
    {
        return Err(error.clone_ref(py));
    }
    match (fitted, asked_to_end) {
        (Ok(fitted), asked_to_end) => found(py, &asked, &fitted, asked_to_end.is_some()),
        (Err(_), Some(error)) => Err(error),
        (Err(error), None) => Err(of_fit(error)),
    }
}

/// Runs a fit on threads of its own while this one listens to it and to Python; with what Python raised meanwhile.
#[allow(clippy::type_complexity, reason = "two results of one call")]
fn watched(
    py: Python<'_>,
    asked: &Asked,
    progress: Option<&Py<PyAny>>,
) -> PyResult<(Result<Fitted, pleach::FitError>, Option<PyErr>)> {
    let (sender, told) = channel::<Told>();
    let stop = &AtomicBool::new(false);
    let pool = pool::of(asked.threads)?;
    let run = |sender| {
        // Its own, so that the channel closes when the fit has ended.
        let mut teller = Teller(sender);
        let started = Instant::now();
        let clock = || started.elapsed();
        let control = Control { observers: vec![&mut teller], ..Control::new(&clock, stop) };
        fit_goal_with(&asked.problem, &asked.settings, &mut library().for_one_goal(), control)
    };
    py.detach(move || {
        std::thread::scope(|scope| {
            let running = scope.spawn(|| pool.install(move || run(sender)));
            let mut raised = None;
            loop {
                let step = told.recv_timeout(LOOK);
                if step == Err(RecvTimeoutError::Disconnected) {
                    break;
                }
                if raised.is_none() {
                    raised = Python::attach(|py| listen(py, step.as_ref().ok(), progress)).err();
                    stop.store(raised.is_some(), Ordering::Relaxed);
                }
            }
            let fitted = running.join().unwrap_or_else(|panic| resume_unwind(panic));
            Ok((fitted, raised))
        })
    })
}

/// Hands a step of a fit to Python, and lets it handle its signals.
fn listen(py: Python<'_>, step: Option<&Told>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
    if let (Some(step), Some(progress)) = (step, progress) {
        progress.call1(py, (step.to_dict(py)?,))?;
    }
    py.check_signals()
}

/// What a fit has found.
fn found<'py>(
    py: Python<'py>,
    asked: &Asked,
    fitted: &Fitted,
    interrupted: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let kind = asked.named(fitted.species().map_err(of_fit)?);
    let places = asked.places(py, &kind, fitted)?;
    let matches = asked.matched(&kind, fitted, &places)?;
    dict.set_item("verdict", fitted.verdict(&matches[0].0).map(|verdict| verdict.to_string()))?;
    dict.set_item("goal", of_ink(py, &asked.goal().bitmap)?)?;
    dict.set_item("kind", matched(py, kind, matches)?)?;
    let individuals = PyList::empty(py);
    for one in &fitted.individuals {
        let species = asked.named(one.species.clone());
        let matches = asked.matched(&species, fitted, &places)?;
        individuals.append(matched(py, species, matches)?)?;
    }
    dict.set_item("individuals", individuals)?;
    let history = PyDict::new(py);
    for column in COLUMNS {
        let values = fitted.outcome.history.iter().map(column.value).collect();
        history.set_item(column.name, numbers(py, values))?;
    }
    dict.set_item("history", history)?;
    let names = fitted.guess.iter().flat_map(|guess| &guess.names);
    dict.set_item("looks_like", names.map(|(name, share)| (name.to_string(), *share)).collect::<Vec<_>>())?;
    dict.set_item("identifiability", identifiability(py, fitted)?)?;
    let fresh = fitted.judged.as_ref().and_then(|judged| judged.held_out.as_ref());
    dict.set_item("fresh_likeness", fresh.map(|fresh| (fresh.likeness.mean, fresh.likeness.sd)))?;
    dict.set_item("leaves", fitted.problem.foliage != Foliage::None)?;
    dict.set_item("evaluations", fitted.outcome.evaluations)?;
    dict.set_item("generations", fitted.outcome.generations)?;
    dict.set_item("seconds", fitted.outcome.elapsed.as_secs_f64())?;
    dict.set_item("cost", fitted.best.score.cost)?;
    let warnings = asked.pictures.iter().flat_map(|picture| &picture.full.warnings);
    dict.set_item("warnings", warnings.map(ToString::to_string).collect::<Vec<_>>())?;
    dict.set_item("interrupted", interrupted)?;
    Ok(dict)
}

/// How well the goal determines each free number: by the name of its slot, its value, and a word.
fn identifiability<'py>(py: Python<'py>, fitted: &Fitted) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let space = fitted.problem.start.generator.space();
    for Profile { slot, seen, .. } in fitted.judged.iter().flat_map(|judged| &judged.profiles) {
        let word = match seen {
            Identifiability::Determined => "determined",
            Identifiability::Loosely => "loosely",
            Identifiability::NotSeen => "not-seen",
            Identifiability::NotTried => "not-tried",
        };
        dict.set_item(space.slot_name(*slot), (fitted.best.genome.values[slot.index()], word))?;
    }
    Ok(dict)
}
