//! Goals as a function of numbers, for other people's optimisers.

use crate::arrays::{numbers, of_ink};
use crate::error::{FitError, of_fit};
use crate::frame::KnownFrame;
use crate::goal::Source;
use crate::numbers::described;
use crate::pool;
use crate::seed::Seed;
use crate::species::Species;
use crate::view::{Direction, view};
use numpy::{IntoPyArray as _, PyArray2, PyArray3, PyArrayMethods as _};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods as _};
use pleach::{
    Bitmap, Evaluator, FitProblem, Foliage, Freedom, Genome, GoalOptions, GoalView, Limits, PlacedTree,
    Rasterizer, Score, SearchSpace, TreeSeed,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// Goals and the free numbers of a species.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct NativeProblem {
    problem: FitProblem,
    /// What the goals were read from, for pickles.
    sources: Vec<Source>,
    evaluator: Evaluator,
    space: SearchSpace,
    seed: u64,
}

/// Individuals of a thread between two looks at Python's signals.
const BATCH: usize = 64;
/// Individuals that are not worth a thread of their own.
const FEW: usize = 2;

/// Largest array of pictures: 2 GiB.
const MAX_PIXELS: usize = 1 << 31;

/// The usual limits, or these.
fn limits(max_leaves: Option<usize>, max_stems: Option<usize>) -> PyResult<Limits> {
    let usual = Limits::DEFAULT;
    let (leaves, stems) = (max_leaves.unwrap_or(usual.leaves), max_stems.unwrap_or(usual.stems));
    if stems == 0 {
        return Err(FitError::new_err("max_stems is 0, expected at least 1: a trunk is a stem"));
    }
    Ok(Limits { leaves: leaves.min(usual.leaves), stems: stems.min(usual.stems), ..usual })
}

#[pymethods]
impl NativeProblem {
    #[new]
    #[allow(clippy::too_many_arguments, reason = "called once, by `Problem`, with all of them by name")]
    fn new(
        goal: &Bound<'_, PyAny>,
        species: &Species,
        height: f64,
        size: u32,
        from_: Option<Direction>,
        frame: Option<KnownFrame>,
        leaves: bool,
        objective: &str,
        free: Vec<String>,
        fix: Vec<String>,
        seed: Seed,
        match_height: bool,
        wide: bool,
        views: Vec<(Bound<'_, PyAny>, Direction)>,
        max_leaves: Option<usize>,
        max_stems: Option<usize>,
    ) -> PyResult<Self> {
        let known = frame.map(KnownFrame::checked).transpose()?;
        let options = known.map_or_else(GoalOptions::default, KnownFrame::options);
        let options = GoalOptions { max_side: Some(size), ..options };
        let source = Source::read(goal)?;
        let goal = source.goal(&options)?;
        let height = known.map_or(height, |known| {
            known.meters_per_pixel() * goal.height_in_pixels() / goal.detection.reduction
        });
        let Seed(seed) = seed;
        let foliage = if leaves { Foliage::All } else { Foliage::None };
        let start = species.inner.kind();
        let goal_view = GoalView::new(goal.bitmap.clone(), view(from_)?, goal.frame(height));
        let mut goals = vec![goal_view];
        let mut sources = vec![source];
        for (picture, from) in views {
            let source = Source::read(&picture)?;
            let goal = source.goal(&GoalOptions { max_side: Some(size), ..GoalOptions::default() })?;
            let frame = goal.frame(height);
            goals.push(GoalView::new(goal.bitmap, from.view()?, frame));
            sources.push(source);
        }
        let problem = FitProblem { start, goals, foliage };
        let objective = objective.parse().map_err(of_fit)?;
        let limits = limits(max_leaves, max_stems)?;
        let mut evaluator = Evaluator::new(&problem, objective, limits).map_err(of_fit)?;
        if match_height {
            evaluator = evaluator.with_height_matching();
        }
        let freedom = Freedom { free, fix };
        let mut space =
            SearchSpace::from_problem(&problem, &freedom, TreeSeed::Fixed(seed)).map_err(of_fit)?;
        if !wide {
            space = space.plausible(problem.start.params.values());
        }
        Ok(Self { problem, sources, evaluator, space, seed })
    }

    /// What the goals were read from: the bytes of a picture, or an array of bool. A file may change or stay behind.
    #[getter]
    fn sources<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.sources.iter().map(|source| source.given(py)).collect()
    }

    /// The free numbers: names, kinds, bounds, values and scales.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        described(py, &self.space, self.problem.start.params.values())
    }

    /// The goals as they are compared with.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<bool>>>> {
        self.problem.goals.iter().map(|goal| of_ink(py, &goal.goal)).collect()
    }

    /// Cost, IoU and likeness of each row, in its order.
    #[pyo3(signature = (values, seeds, threads))]
    fn scores<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray2<'py, f64>,
        seeds: Option<Vec<Seed>>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let genomes = self.genomes(&values, seeds.as_deref())?;
        let scores = self.of_all(py, &genomes, threads, |genome| self.evaluator.score(genome))?;
        let dict = PyDict::new(py);
        let column = |of: fn(&Score) -> f64| numbers(py, scores.iter().map(of).collect());
        dict.set_item("cost", column(|score| score.cost))?;
        dict.set_item("iou", column(|score| score.iou))?;
        dict.set_item("accuracy", column(|score| score.accuracy))?;
        dict.set_item("likeness", column(|score| score.likeness.unwrap_or(f64::NAN)))?;
        Ok(dict)
    }

    /// The picture of each row in view number `view`, in the frame of that goal; empty where no tree grows.
    #[pyo3(signature = (values, seeds, view, threads))]
    fn silhouettes<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray2<'py, f64>,
        seeds: Option<Vec<Seed>>,
        view: usize,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray3<bool>>> {
        let Some(goal) = self.problem.goals.get(view) else {
            let count = self.problem.goals.len();
            return Err(FitError::new_err(format!("there is no view {view}, expected one below {count}")));
        };
        let (width, height) = (goal.goal.width() as usize, goal.goal.height() as usize);
        let count = values.shape()[0];
        if count.saturating_mul(width * height) > MAX_PIXELS {
            return Err(FitError::new_err(format!(
                "{count} pictures of {height} × {width} pixels are too many for one array, expected at most {}",
                MAX_PIXELS / (width * height)
            )));
        }
        let genomes = self.genomes(&values, seeds.as_deref())?;
        let draw = |genome: &Genome| {
            let mut picture = Bitmap::new(goal.goal.width(), goal.goal.height());
            let mut number = 0;
            // A tree that does not grow has an empty picture, as its cost is infinite.
            let _ = self.evaluator.pictures(genome, |placed| {
                if number == view {
                    let PlacedTree { tree, view, frame, parts, .. } = placed;
                    Rasterizer::default().draw(tree, view, frame, *parts, &mut picture);
                }
                number += 1;
            });
            let pixels = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
            pixels.map(|(x, y)| picture.get(x, y)).collect::<Vec<bool>>()
        };
        let pictures = self.of_all(py, &genomes, threads, draw)?;
        pictures.concat().into_pyarray(py).reshape([genomes.len(), height, width])
    }

    /// The species with these numbers, of the size that it was compared at.
    fn species(&self, py: Python<'_>, values: PyReadonlyArray1<'_, f64>, seed: Seed) -> PyResult<Species> {
        let row = values.as_array().to_vec();
        let mut genome = self.genome(&row, seed.0, 0)?;
        let score = py.detach(|| self.evaluator.score(&genome));
        if score.resized != 1.0 {
            self.problem.start.generator.resize(&mut genome.values, score.resized);
        }
        Ok(self.problem.species(&genome).map_err(of_fit)?.into())
    }
}

impl NativeProblem {
    /// `work` of each of `genomes`, in their order, without the interpreter's lock. A few of them are done on this
    /// thread: to start others takes longer.
    fn of_all<T: Send>(
        &self,
        py: Python<'_>,
        genomes: &[Genome],
        threads: Option<usize>,
        work: impl Fn(&Genome) -> T + Send + Sync,
    ) -> PyResult<Vec<T>> {
        pool::check(threads)?;
        if genomes.len() <= FEW {
            return Ok(py.detach(|| genomes.iter().map(work).collect()));
        }
        let pool = pool::with_threads(threads)?;
        let mut done = Vec::with_capacity(genomes.len());
        for some in genomes.chunks(BATCH * pool.current_num_threads()) {
            done.extend(py.detach(|| {
                pool.install(|| some.par_iter().with_max_len(FEW).map(&work).collect::<Vec<T>>())
            }));
            py.check_signals()?;
        }
        Ok(done)
    }

    fn genomes(&self, values: &PyReadonlyArray2<'_, f64>, seeds: Option<&[Seed]>) -> PyResult<Vec<Genome>> {
        let rows = values.as_array();
        if let Some(seeds) = seeds.filter(|seeds| seeds.len() != rows.nrows()) {
            return Err(FitError::new_err(format!(
                "{} seeds for {} rows of values",
                seeds.len(),
                rows.nrows()
            )));
        }
        let of_row = |number: usize| {
            let seed = seeds.map_or(self.seed, |seeds| seeds[number].0);
            self.genome(&rows.row(number).to_vec(), seed, number)
        };
        (0..values.shape()[0]).map(of_row).collect()
    }

    /// The individual of a row of values, each the nearest that is allowed.
    fn genome(&self, row: &[f64], seed: u64, number: usize) -> PyResult<Genome> {
        let genes = self.space.genes();
        if row.len() != genes.len() {
            return Err(FitError::new_err(format!(
                "a row has {} values, expected {}",
                row.len(),
                genes.len()
            )));
        }
        let mut genome = Genome::new(self.problem.start.params.values().to_vec(), seed);
        for (gene, &value) in genes.iter().zip(row) {
            if !value.is_finite() {
                let space = self.problem.start.generator.space();
                let name = gene.slot().map_or_else(String::new, |slot| space.slot_name(slot));
                return Err(FitError::new_err(format!(
                    "`{name}` in row {number} is {value}, expected a finite number"
                )));
            }
            gene.set(&mut genome, gene.clamp(value));
        }
        Ok(genome)
    }
}
