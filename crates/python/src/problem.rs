//! A goal as a function of numbers, for other people's optimisers.

use crate::arrays::{numbers, of_ink};
use crate::error::{FitError, of_fit};
use crate::frame::KnownFrame;
use crate::goal::Source;
use crate::pool;
use crate::seed::Seed;
use crate::species::Species;
use crate::view::{Direction, view};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods as _};
use pleach::{
    EvalWorkspace, Evaluator, FitProblem, Foliage, Freedom, Gene, Genome, GoalOptions, GoalView, Limits,
    Score, SearchSpace, TreeSeed,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// A goal and the free numbers of a species.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct NativeProblem {
    problem: FitProblem,
    /// What the goal was read from, for pickles.
    source: Source,
    goal: pleach::Bitmap,
    evaluator: Evaluator,
    space: SearchSpace,
    seed: u64,
}

/// Individuals between two looks at Python's signals.
const BATCH: usize = 64;

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
        let problem = FitProblem { start, goals: vec![goal_view], foliage };
        let objective = objective.parse().map_err(of_fit)?;
        let mut evaluator = Evaluator::new(&problem, objective, Limits::DEFAULT).map_err(of_fit)?;
        if match_height {
            evaluator = evaluator.with_height_matching();
        }
        let freedom = Freedom { free, fix };
        let mut space =
            SearchSpace::from_problem(&problem, &freedom, TreeSeed::Fixed(seed)).map_err(of_fit)?;
        if !wide {
            space = space.plausible(problem.start.params.values());
        }
        Ok(Self { problem, source, goal: goal.bitmap, evaluator, space, seed })
    }

    /// What the goal was read from: the bytes of a picture, or an array of bool. A file may change or stay behind.
    #[getter]
    fn source<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.source.given(py)
    }

    #[getter]
    fn names(&self) -> Vec<String> {
        let space = self.problem.start.generator.space();
        self.space.genes().iter().filter_map(Gene::slot).map(|slot| space.slot_name(slot)).collect()
    }

    #[getter]
    fn kinds(&self) -> Vec<&'static str> {
        self.space.genes().iter().map(|gene| gene.kind.word()).collect()
    }

    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        numbers(py, self.space.genes().iter().map(|gene| gene.low).collect())
    }

    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        numbers(py, self.space.genes().iter().map(|gene| gene.high).collect())
    }

    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let genome = Genome::new(self.problem.start.params.values().to_vec(), self.seed);
        numbers(py, self.space.genes().iter().map(|gene| gene.get(&genome)).collect())
    }

    #[getter]
    fn is_log(&self) -> Vec<bool> {
        self.space.genes().iter().map(Gene::is_log).collect()
    }

    #[getter]
    fn goal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        of_ink(py, &self.goal)
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
        let pool = pool::with_threads(threads)?;
        let mut scores: Vec<Score> = Vec::with_capacity(genomes.len());
        for some in genomes.chunks(BATCH * pool.current_num_threads()) {
            scores.extend(py.detach(|| {
                pool.install(|| {
                    let memory = || self.evaluator.workspace();
                    let score =
                        |memory: &mut EvalWorkspace, genome: &Genome| self.evaluator.evaluate(genome, memory);
                    some.par_iter().with_max_len(8).map_init(memory, score).collect::<Vec<_>>()
                })
            }));
            py.check_signals()?;
        }
        let dict = PyDict::new(py);
        let column = |of: fn(&Score) -> f64| numbers(py, scores.iter().map(of).collect());
        dict.set_item("cost", column(|score| score.cost))?;
        dict.set_item("iou", column(|score| score.iou))?;
        dict.set_item("accuracy", column(|score| score.accuracy))?;
        dict.set_item("likeness", column(|score| score.likeness.unwrap_or(f64::NAN)))?;
        Ok(dict)
    }

    /// The species with these numbers, of the size that it was compared at.
    fn species(&self, values: PyReadonlyArray1<'_, f64>, seed: Seed) -> PyResult<Species> {
        let row = values.as_array().to_vec();
        let mut genome = self.genome(&row, seed.0, 0)?;
        let score = self.evaluator.evaluate(&genome, &mut self.evaluator.workspace());
        if score.resized != 1.0 {
            self.problem.start.generator.resize(&mut genome.values, score.resized);
        }
        Ok(self.problem.species(&genome).map_err(of_fit)?.into())
    }
}

impl NativeProblem {
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
