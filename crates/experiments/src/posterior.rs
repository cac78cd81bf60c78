//! Whether intervals of a posterior hold what they say, on trees that it was not learnt from.

use super::record::{self, Fixed};
use super::spearman::spearman;
use super::spec::{Source, species_files};
use super::within::{List, SpeciesName, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use anyhow::Context;
use pleach::plan::library;
use pleach_console::output;
use pleach_fit::{
    Answer, FitProblem, Freedom, Gene, Genome, GoalView, HeldOut, Interval, Posterior, PosteriorModel,
    PosteriorNumber, PosteriorSettings, Prior, Until,
};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Parts, Species, Tree, Workspace};
use rayon::prelude::*;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use toml::Spanned;

/// Side of every picture in pixels.
const SIZE: u32 = 128;
/// The same of those that are shown to the model that is built in: that of goals.
const GOAL_SIZE: u32 = 256;
/// The seed of the trees that are learnt from, and of those that are not.
const LEARNT: u64 = 1;
const HELD_OUT: u64 = 2;
/// From this much shrinking on, a number counts as determined.
const DETERMINED: f64 = 0.5;
/// A number whose ranks are less likely than this to be uniform is not calibrated.
const MIN_P: f64 = 0.01;

/// What answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Model {
    /// One that learns from trees of the prior, as `pleach fit --posterior` does.
    #[default]
    Learnt,
    /// The one that is built in, which every fit asks.
    BuiltIn,
}

impl Model {
    const ALL: [Self; 2] = [Self::Learnt, Self::BuiltIn];

    const fn name(self) -> &'static str {
        match self {
            Self::Learnt => "learnt",
            Self::BuiltIn => "built-in",
        }
    }
}

/// A number of a species, over the trees that were held out.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Judged {
    model: Model,
    species: String,
    slot: String,
    /// Whether it is a whole number, whose ranks are not uniform.
    is_whole: bool,
    /// Trees; of what is built in the number is not kept.
    learnt: Option<usize>,
    held_out: usize,
    /// What the model says of itself.
    shrunk: Fixed<4>,
    /// By how much the squared error of the median is smaller than that of the prior's.
    explained: Fixed<4>,
    /// Root mean square of the errors of the posterior's and of the prior's median, over the prior's deviation.
    error: Fixed<4>,
    prior_error: Fixed<4>,
    /// The share of truths within the interval.
    covered: Fixed<4>,
    /// Kolmogorov and Smirnov's probability that ranks are uniform; what is built in keeps no ranks.
    rank_p: Option<Fixed<4>>,
    /// The share of the trees whose pictures are familiar to what is built in.
    familiar: Option<Fixed<4>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PosteriorSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name.
    species: List<Spanned<SpeciesName>>,
    /// Trees of each that are learnt from.
    learnt: Whole<100, 20_000>,
    /// Trees of each that are held out.
    held_out: Whole<10, 100_000>,
}

impl PosteriorSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(&self.species, |name| name.to_string(), "")?;
        Ok(self)
    }

    fn judge(&self, name: &str, model: Model) -> anyhow::Result<Vec<Judged>> {
        let species = pleach_generators::species(name)?;
        let prior = Prior::new(&species, &Freedom::default(), Prior::SPREAD)?;
        match model {
            Model::Learnt => self.judge_learnt(&species, &prior),
            Model::BuiltIn => self.judge_built_in(&species, &prior),
        }
    }

    /// The trees that are held out.
    fn numbers(&self) -> impl IndexedParallelIterator<Item = u32> + use<> {
        (0..u32::try_from(*self.held_out).unwrap_or(u32::MAX)).into_par_iter()
    }

    fn judge_learnt(&self, species: &Species, prior: &Prior) -> anyhow::Result<Vec<Judged>> {
        let problem = problem(species)?;
        let (trees, samples) = (*self.learnt as usize, 0);
        let settings = PosteriorSettings { trees, seed: LEARNT, samples, ..PosteriorSettings::default() };
        let stop = AtomicBool::new(false);
        let model = PosteriorModel::learn(&problem, prior, settings, Until::from(&stop), |_| ())?;
        let held_out: Vec<HeldOut> =
            self.numbers().filter_map(|number| model.held_out(genome(prior, number)?.0)).collect();
        let trees = held_out.first().context("no tree that was held out grows")?.posterior.trees;
        let answers: Vec<Told> = held_out
            .iter()
            .map(|one| Told { genome: &one.genome, numbers: &one.posterior.numbers })
            .collect();
        let mut judged = judged(species, model.genes(), &answers);
        for (place, row) in judged.iter_mut().enumerate() {
            row.learnt = Some(trees);
            row.rank_p = Some(Fixed(uniform_p(held_out.iter().map(|one| one.ranks[place]).collect())));
        }
        Ok(judged)
    }

    /// The same trees, each in a picture of its own.
    fn judge_built_in(&self, species: &Species, prior: &Prior) -> anyhow::Result<Vec<Judged>> {
        let library = library();
        let predictors = library.predictors().context("predictors are built in")?;
        let answer = |number| {
            let (genome, tree) = genome(prior, number)?;
            let (goal, frame) = picture(&tree, GOAL_SIZE);
            let answer = predictors.answer(&goal, frame.meters_per_pixel, Foliage::All, species)?;
            Some((genome, answer))
        };
        let held_out: Vec<(Genome, Answer)> = self.numbers().filter_map(answer).collect();
        let first = &held_out.first().context("no tree that was held out grows")?.1;
        let genes: Vec<Gene> = (first.numbers.iter())
            .filter_map(|number| prior.genes().find(|gene| gene.slot() == Some(number.slot)).cloned())
            .collect();
        let answers: Vec<Told> =
            held_out.iter().map(|(genome, answer)| Told { genome, numbers: &answer.numbers }).collect();
        let is_familiar = |answer: &Answer| answer.familiarity >= Posterior::STRANGE;
        let familiar = held_out.iter().filter(|(_, answer)| is_familiar(answer)).count();
        let familiar = Some(Fixed(familiar as f64 / held_out.len() as f64));
        Ok(judged(species, &genes, &answers)
            .into_iter()
            .map(|row| Judged { model: Model::BuiltIn, familiar, ..row })
            .collect())
    }
}

/// Tree `number` of those that are held out; `None` if none of its draws grows.
fn genome(prior: &Prior, number: u32) -> Option<(Genome, Tree)> {
    let mut tree = Tree::default();
    let genome = prior.genome_into(HELD_OUT, number, &mut Workspace::default(), &mut tree).ok()?;
    Some((genome, tree))
}

/// What the picture of a tree says of its numbers.
struct Told<'a> {
    genome: &'a Genome,
    /// One for each gene.
    numbers: &'a [PosteriorNumber],
}

fn judged(species: &Species, genes: &[Gene], answers: &[Told<'_>]) -> Vec<Judged> {
    let space = species.params.space();
    let count = answers.len() as f64;
    let judge = |(place, gene): (usize, &Gene)| {
        let all = || answers.iter().map(|one| Truth::new(gene, one.genome, &one.numbers[place]));
        let mean = all().map(|one| one.truth).sum::<f64>() / count;
        let rms = |of: fn(&Truth) -> f64| (all().map(|one| of(&one).powi(2)).sum::<f64>() / count).sqrt();
        let deviation = (all().map(|one| (one.truth - mean).powi(2)).sum::<f64>() / count).sqrt();
        let deviation = deviation.max(f64::MIN_POSITIVE);
        let (error, prior_error) = (rms(|one| one.error) / deviation, rms(|one| one.prior_error) / deviation);
        Judged {
            model: Model::Learnt,
            species: species.name.clone(),
            slot: gene.slot().map_or_else(String::new, |slot| space.slot_name(slot)),
            is_whole: gene.kind.is_whole(),
            learnt: None,
            held_out: answers.len(),
            shrunk: Fixed(answers[0].numbers[place].shrunk),
            explained: Fixed(1.0 - (error / prior_error.max(f64::MIN_POSITIVE)).powi(2)),
            error: Fixed(error),
            prior_error: Fixed(prior_error),
            covered: Fixed(all().filter(|one| one.is_covered).count() as f64 / count),
            rank_p: None,
            familiar: None,
        }
    };
    genes.iter().enumerate().map(judge).collect()
}

/// A picture's frame, in which all trees are drawn at the height of one.
fn problem(species: &Species) -> anyhow::Result<FitProblem> {
    let (goal, frame) = picture(&species.grow(1)?, SIZE);
    Ok(FitProblem::new(species.clone(), GoalView::new(goal, View::FRONT, frame)))
}

fn picture(tree: &Tree, size: u32) -> (Bitmap, Frame) {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, size, size);
    let mut picture = Bitmap::default();
    Rasterizer::for_searches(Detail::Half).draw(tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
    (picture, frame)
}

/// A number of one tree beside what its picture says of it, in parts of the number's range.
struct Truth {
    truth: f64,
    error: f64,
    prior_error: f64,
    is_covered: bool,
}

impl Truth {
    fn new(gene: &Gene, genome: &Genome, told: &PosteriorNumber) -> Self {
        let value = gene.get(genome);
        let PosteriorNumber { prior, posterior, .. } = told;
        let error = |of: &Interval| gene.to_unit(value) - gene.to_unit(of.median);
        // To units and back, a value is the same but for its last bits.
        let value_there = gene.from_unit(gene.to_unit(value));
        Self {
            truth: gene.to_unit(value),
            error: error(posterior),
            prior_error: error(prior),
            is_covered: (posterior.low..=posterior.high).contains(&value_there),
        }
    }
}

/// The probability of a distance of `values` from uniform numbers in 0..=1 as large as theirs, or larger (Kolmogorov
/// and Smirnov; the asymptotic series with Stephens's correction).
fn uniform_p(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let distance = |(i, &value): (usize, &f64)| {
        let (below, above) = (i as f64 / count, (i + 1) as f64 / count);
        (value - below).abs().max((above - value).abs())
    };
    let distance = values.iter().enumerate().map(distance).fold(0.0, f64::max);
    let root = count.sqrt();
    let lambda = (root + 0.12 + 0.11 / root) * distance;
    let term = |j: i32| {
        let sign = if j % 2 == 1 { 1.0 } else { -1.0 };
        sign * (-2.0 * f64::from(j * j) * lambda * lambda).exp()
    };
    if lambda < 0.2 { 1.0 } else { (2.0 * (1..=100).map(term).sum::<f64>()).clamp(0.0, 1.0) }
}

impl Kind for PosteriorSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Judged::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (Vec::new(), species_files(&self.species).collect())
    }

    /// A row for each number of each species; a slice has the first few species.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let species = &self.species[..slice.take_of(self.species.len())];
        let bar = progress("models", (species.len() * Model::ALL.len()) as u64);
        for name in species {
            let name = name.get_ref().as_str();
            for model in Model::ALL {
                let is_its = |row: &Judged| row.species == name && row.model == model;
                journal.job(is_its, || self.judge(name, model))?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, _: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Judged> = table.records()?;
        let head = [
            "model",
            "species",
            "numbers",
            "determined",
            "error, before",
            "error",
            "covered",
            "ranks not uniform",
            "rank correlation",
            "familiar",
        ];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        for model in Model::ALL {
            let of_model = || rows.iter().filter(move |row| row.model == model);
            for name in &self.species {
                let name = name.get_ref().as_str();
                let of: Vec<&Judged> = of_model().filter(|row| row.species == name).collect();
                lines.push(line(model, name, &of));
            }
            lines.push(line(model, "all", &of_model().collect::<Vec<_>>()));
        }
        Ok(output::table(&lines, &(2..head.len()).collect::<Vec<_>>()))
    }
}

/// A line of the report.
fn line(model: Model, name: &str, rows: &[&Judged]) -> Vec<String> {
    let mean = |of: &[&Judged], value: fn(&Judged) -> f64| {
        of.iter().map(|row| value(row)).sum::<f64>() / of.len().max(1) as f64
    };
    let rms = |of: &[&Judged], value: fn(&Judged) -> f64| {
        (of.iter().map(|row| value(row).powi(2)).sum::<f64>() / of.len().max(1) as f64).sqrt()
    };
    let determined: Vec<&Judged> = rows.iter().copied().filter(|row| row.shrunk.0 >= DETERMINED).collect();
    let real: Vec<&Fixed<4>> =
        rows.iter().filter(|row| !row.is_whole).filter_map(|row| row.rank_p.as_ref()).collect();
    let uneven = real.iter().filter(|p| p.0 < MIN_P).count();
    let ranks = if real.is_empty() { String::new() } else { format!("{uneven} of {}", real.len()) };
    let error = |value: fn(&Judged) -> f64| {
        if determined.is_empty() { String::new() } else { format!("{:.2}", rms(&determined, value)) }
    };
    let told: Vec<(f64, f64)> = rows.iter().map(|row| (row.shrunk.0, row.explained.0)).collect();
    vec![
        model.name().to_owned(),
        name.to_owned(),
        rows.len().to_string(),
        determined.len().to_string(),
        error(|row| row.prior_error.0),
        error(|row| row.error.0),
        format!("{:.1} %", 100.0 * mean(rows, |row| row.covered.0)),
        ranks,
        spearman(&told).map_or_else(String::new, |rho| format!("{rho:.2}")),
        rows.first()
            .and_then(|row| row.familiar.as_ref())
            .map_or_else(String::new, |share| format!("{:.1} %", 100.0 * share.0)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_numbers_are_uniform_and_others_are_not() {
        let even: Vec<f64> = (0..100).map(|i| (f64::from(i) + 0.5) / 100.0).collect();
        assert!(uniform_p(even.clone()) > 0.99);
        assert!(uniform_p(even.iter().map(|value| value * value).collect()) < 1e-4);
        // The critical distance for 100 numbers at 0.05 is 0.134.
        let shifted = |by: f64| uniform_p(even.iter().map(|value| (value + by).min(1.0)).collect());
        assert!(shifted(0.11) > 0.05 && shifted(0.14) < 0.05);
    }
}
