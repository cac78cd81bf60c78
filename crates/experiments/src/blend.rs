//! Blends of species: seed's §4.4.1 remade, and what it could not do counted.

use super::record::{self, Exact};
use super::spec::{BlendSpec, species_files};
use super::{Journal, Kind as Experiment, Outputs, Slice, Table, progress, stop};
use anyhow::Context;
use pleach_blend::draw::{Drawing, each_tree, picture, silhouettes};
use pleach_blend::{Blend, BlendMap, Features, Point, Settings, map};
use pleach_console::output;
use pleach_silhouette::score::blurred_iou;
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View, picture as sheets};
use pleach_tree::{Growth, Key, Kind, Limits, Parts, Slot, Species, Tree};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// One number of one question about one blend, or one group of them.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Answer {
    question: String,
    first: String,
    second: String,
    method: String,
    measure: String,
    value: Exact,
}

/// How a blend of two species is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// Across the map by declared features.
    Map,
    /// By declared features of the two alone.
    Straight,
    /// Across the map by the plain list of numbers: the dissertation's way.
    Raw,
}

const METHODS: [Method; 3] = [Method::Map, Method::Straight, Method::Raw];

impl Method {
    const fn name(self) -> &'static str {
        match self {
            Self::Map => "map",
            Self::Straight => "straight",
            Self::Raw => "raw",
        }
    }
}

/// Both maps of the same species.
struct Maps {
    declared: BlendMap,
    raw: BlendMap,
}

impl Maps {
    fn of(species: &[Species]) -> anyhow::Result<Self> {
        let map = |features| BlendMap::new(species.to_vec(), Settings { features, dots: None });
        Ok(Self { declared: map(Features::Declared)?, raw: map(Features::Raw)? })
    }

    fn species(&self) -> &[Species] {
        self.declared.landmarks().species()
    }

    fn between(&self, method: Method, (a, b): (usize, usize), at: f64) -> anyhow::Result<Species> {
        let across = |map: &BlendMap| -> anyhow::Result<Species> {
            Ok(map.species_at(&map.at(map.between(a, b, at)?)?, "blend"))
        };
        match method {
            Method::Map => across(&self.declared),
            Method::Raw => across(&self.raw),
            Method::Straight => {
                let weights = self.declared.landmarks().between(a, b, at)?;
                let params = self.declared.landmarks().mix(&weights);
                Ok(self.declared.species_at(&Blend { params, weights, outside: 0.0 }, "blend"))
            }
        }
    }
}

/// Collects rows.
struct Rows(Vec<Answer>);

impl Rows {
    fn add(
        &mut self,
        question: &str,
        (first, second): (&str, &str),
        method: &str,
        measure: &str,
        value: f64,
    ) {
        let [question, first, second, method, measure] =
            [question, first, second, method, measure].map(str::to_owned);
        self.0.push(Answer { question, first, second, method, measure, value: Exact::millionths(value) });
    }
}

const DRAWING: Drawing = Drawing { pixels: 128, detail: Detail::Full };
/// Blur of pictures that are compared: a sixteenth of their height.
const BLUR: f64 = 128.0 / 16.0;
const SEED: u64 = 1;

const FIGURE: &str = "figure-4.8.png";
const PALM: &str = "palm.png";

impl Experiment for BlendSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Answer::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let species = species_files(self.species.get_ref());
        ([FIGURE, PALM].map(str::to_owned).to_vec(), species.collect())
    }

    /// A job for each question.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let maps = Maps::of(&self.species()?)?;
        let most = slice.of(usize::MAX);
        let mut job = |question: &str, make: &dyn Fn(&mut Rows) -> anyhow::Result<()>| {
            let rows = || {
                let mut rows = Rows(Vec::new());
                make(&mut rows)?;
                Ok(rows.0)
            };
            journal.job(|row: &Answer| row.question == question, rows)
        };
        job("explained variance", &|rows| {
            explained(&maps, rows);
            Ok(())
        })?;
        job("landmark", &|rows| landmarks(&maps, rows))?;
        job("palm", &|rows| palm(&maps, rows))?;
        job("leave one out", &|rows| leave_one_out(&maps, most, rows))?;
        job("smoothness", &|rows| smoothness(&maps, *self.steps as u32, most, rows))?;
        if slice.repetitions.is_none() {
            job("random points", &|rows| validity(&maps, *self.points as usize, rows))?;
        }
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let maps = Maps::of(&self.species()?)?;
        figure(&maps, outputs)?;
        with_palm(&maps, outputs)?;
        Ok(summary(&table.records()?))
    }
}

impl BlendSpec {
    fn species(&self) -> anyhow::Result<Vec<Species>> {
        self.species.get_ref().iter().map(|name| Ok(pleach_generators::species(name.get_ref())?)).collect()
    }
}

fn explained(maps: &Maps, rows: &mut Rows) {
    for (map, method) in [(&maps.declared, "map"), (&maps.raw, "raw")] {
        let mut together = 0.0;
        for (axis, share) in map.pca().explained().iter().enumerate() {
            together += share;
            rows.add("explained variance", ("", ""), method, &format!("{} axes", axis + 1), together);
        }
    }
}

fn landmarks(maps: &Maps, rows: &mut Rows) -> anyhow::Result<()> {
    for (map, method) in [(&maps.declared, "map"), (&maps.raw, "raw")] {
        for (species, dot) in maps.species().iter().zip(map.dots()) {
            let exact = map.at(*dot)?.params == species.params;
            rows.add("landmark", (&species.name, ""), method, "exact", f64::from(u8::from(exact)));
        }
    }
    Ok(())
}

/// The palm with each other species: what is broken about a blend.
fn palm(maps: &Maps, rows: &mut Rows) -> anyhow::Result<()> {
    let palm = maps.declared.landmarks().named("palm")?;
    let ranges = Ranges::of(maps.species())?;
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

/// Smallest and largest height, ink and number of stems among species; twice as far is still a tree.
struct Ranges([(f64, f64); 3]);

const GENEROUS: f64 = 2.0;

impl Ranges {
    fn of(species: &[Species]) -> anyhow::Result<Self> {
        let known = each_tree(species, SEED, |tree, _| figures(tree))?;
        let range = |i: usize| {
            known
                .iter()
                .map(|f| f[i])
                .fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)))
        };
        Ok(Self([range(0), range(1), range(2)]))
    }

    fn contain(&self, figures: [f64; 3]) -> bool {
        self.0.iter().zip(figures).all(|((low, high), v)| (low / GENEROUS..=high * GENEROUS).contains(&v))
    }

    fn hold(&self, species: &Species, seed: u64) -> bool {
        grow(species, seed).is_some_and(|tree| self.contain(figures(&tree)))
    }
}

fn figures(tree: &Tree) -> [f64; 3] {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, DRAWING.pixels, DRAWING.pixels);
    let bitmap = picture(tree, &mut Rasterizer::new(), DRAWING);
    let (left, top, right, bottom) = bitmap.ink_box().unwrap_or_default();
    let height = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
    let area = f64::from(right - left + 1) * f64::from(bottom - top + 1);
    [height, bitmap.ink() as f64 / area, tree.stems.len() as f64]
}

/// Grows a tree of at most twice the stems and leaves of the largest species; a larger one counts as
/// not grown.
fn grow(species: &Species, seed: u64) -> Option<Tree> {
    let usual = Limits::default();
    let limits = Limits { stems: usual.stems / 5, leaves: usual.leaves / 5, knots: usual.knots / 5, ..usual };
    species.grow_with(&Growth { limits, ..Growth::seed(seed) }).ok()
}

/// Each species from the others at its own coordinates.
fn leave_one_out(maps: &Maps, most: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let codes = maps.declared.landmarks().codes();
    let all = maps.species();
    for (i, species) in all.iter().enumerate().take(most) {
        stop::check()?;
        let others: Vec<Species> = all.iter().filter(|s| s.name != species.name).cloned().collect();
        let without = Maps::of(&others)?;
        let code =
            |s: &Species| maps.declared.landmarks().coding().encode(s.generator.as_ref(), s.params.values());
        let nearest = others
            .iter()
            .min_by(|a, b| {
                let far = |s: &Species| map::distance(&code(s).values, &codes[i].values);
                far(a).total_cmp(&far(b))
            })
            .context("there are other species")?;
        let guesses = [
            (
                "map",
                without.declared.species_at(&without.declared.at(without.declared.locate(species))?, "guess"),
            ),
            ("raw", without.raw.species_at(&without.raw.at(without.raw.locate(species))?, "guess")),
            ("nearest", nearest.clone()),
        ];
        for (method, guess) in guesses {
            let far = map::distance(&code(&guess).values, &codes[i].values);
            rows.add("leave one out", (&species.name, ""), method, "parameter distance", far);
            let unlike = unlike(species, &guess);
            rows.add("leave one out", (&species.name, ""), method, "silhouette distance", unlike);
        }
    }
    Ok(())
}

/// One less the blurred overlap in the mean over four seeds.
fn unlike(one: &Species, two: &Species) -> f64 {
    const SEEDS: u64 = 4;
    let pair = [one.clone(), two.clone()];
    let overlaps = (1..=SEEDS).map(|seed| {
        // What does not grow overlaps nothing.
        silhouettes(&pair, seed, DRAWING).map_or(0.0, |drawn| blurred_iou(&drawn[0], &drawn[1], BLUR))
    });
    1.0 - overlaps.sum::<f64>() / SEEDS as f64
}

/// Every pair of species in steps: how alike neighbours are.
fn smoothness(maps: &Maps, steps: u32, most: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let count = maps.species().len();
    let pairs: Vec<(usize, usize)> =
        (0..count).flat_map(|b| (0..b).map(move |a| (a, b))).take(most).collect();
    for method in METHODS {
        let bar = progress(method.name(), pairs.len() as u64);
        let lines = pairs
            .par_iter()
            .map(|&pair| {
                stop::check()?;
                let line = Line::of(maps, method, pair, steps);
                bar.inc(1);
                line
            })
            .collect::<anyhow::Result<Vec<Line>>>()?;
        bar.finish_and_clear();
        for (pair, line) in pairs.iter().zip(&lines) {
            let names = (maps.species()[pair.0].name.as_str(), maps.species()[pair.1].name.as_str());
            let mut add =
                |measure: &str, value: f64| rows.add("smoothness", names, method.name(), measure, value);
            add("steps", line.overlaps.len() as f64);
            add("steps alike", line.alike(|_| true) as f64);
            add("steps without a switch", line.overlaps.iter().filter(|s| !s.1).count() as f64);
            add("steps without a switch alike", line.alike(|switch| !switch) as f64);
            add("trees that did not grow", line.stunted as f64);
            add("least overlap", line.least(|_| true));
            add("least overlap without a switch", line.least(|switch| !switch));
        }
    }
    Ok(())
}

/// Neighbouring trees whose blurred overlap is at least this are alike.
const ALIKE: f64 = 0.85;

/// Overlap of each two neighbours on the way, and whether something switches between them.
struct Line {
    /// 0 where one of the two did not grow.
    overlaps: Vec<(f64, bool)>,
    /// Trees that did not grow.
    stunted: usize,
}

impl Line {
    fn of(maps: &Maps, method: Method, pair: (usize, usize), steps: u32) -> anyhow::Result<Self> {
        let at = |i: u32| maps.between(method, pair, f64::from(i) / f64::from(steps));
        let species = (0..=steps).map(at).collect::<anyhow::Result<Vec<_>>>()?;
        let mut rasterizer = Rasterizer::new();
        let drawn: Vec<Option<Bitmap>> =
            species.iter().map(|s| Some(picture(&grow(s, SEED)?, &mut rasterizer, DRAWING))).collect();
        let overlap = |pair: &[Option<Bitmap>]| match pair {
            [Some(a), Some(b)] => blurred_iou(a, b, BLUR),
            _ => 0.0,
        };
        let stunted = drawn.iter().filter(|d| d.is_none()).count();
        let pairs = species.windows(2).zip(drawn.windows(2));
        Ok(Self { overlaps: pairs.map(|(s, d)| (overlap(d), switches(&s[0], &s[1]))).collect(), stunted })
    }

    fn alike(&self, counts: impl Fn(bool) -> bool) -> usize {
        self.overlaps.iter().filter(|(overlap, switch)| counts(*switch) && *overlap >= ALIKE).count()
    }

    fn least(&self, counts: impl Fn(bool) -> bool) -> f64 {
        self.overlaps.iter().filter(|(_, s)| counts(*s)).map(|(o, _)| *o).fold(1.0, f64::min)
    }
}

/// Whether a number that cannot change gradually changes: a choice, a sign, a whole number.
fn switches(one: &Species, two: &Species) -> bool {
    let space = one.generator.space();
    let (a, b) = (one.params.values(), two.params.values());
    space.slots().any(|slot| {
        let kind = space.kind_of(slot);
        let read = one.generator.is_active(a, slot) || two.generator.is_active(b, slot);
        let sign = kind.is_flagged() && (one.params.get(slot) < 0.0) != (two.params.get(slot) < 0.0);
        read && (sign || (kind.is_whole() && one.params.get(slot) != two.params.get(slot)))
    })
}

/// Random points of the hull: do all grow, and into something like a tree?
fn validity(maps: &Maps, points: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let map = &maps.declared;
    let ranges = Ranges::of(maps.species())?;
    let points = inside(map, points);
    let bar = progress("points", points.len() as u64);
    let verdicts: Vec<(bool, bool)> = points
        .par_iter()
        .enumerate()
        .map(|(i, point)| {
            stop::check()?;
            bar.inc(1);
            let blend = map.at(*point)?;
            let valid = map.landmarks().space().check(blend.params.values().to_vec()).is_ok();
            match grow(&map.species_at(&blend, "blend"), i as u64) {
                Some(tree) => Ok((valid, ranges.contain(figures(&tree)))),
                None => Ok((false, false)),
            }
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();
    let count = |what: fn(&(bool, bool)) -> bool| verdicts.iter().filter(|v| what(v)).count() as f64;
    rows.add("random points", ("", ""), "map", "points", verdicts.len() as f64);
    rows.add("random points", ("", ""), "map", "grown", count(|v| v.0));
    rows.add("random points", ("", ""), "map", "not degenerate", count(|v| v.1));
    Ok(())
}

fn inside(map: &BlendMap, count: usize) -> Vec<Point> {
    let reach = map.dots().iter().fold(0.0_f64, |r, d| r.max(d.x.abs()).max(d.y.abs()));
    let key = Key::root(SEED);
    let draw = |i: u32| (2.0 * key.unit(0, i) - 1.0) * reach;
    let points = (0..).map(|i| Point { x: draw(2 * i), y: draw(2 * i + 1) });
    points.filter(|p| map.hull().contains(*p)).take(count).collect()
}

/// Figure 4.8: quaking aspen and silver birch, and what lies between them.
fn figure(maps: &Maps, outputs: &Outputs) -> anyhow::Result<()> {
    let named = |name: &str| maps.declared.landmarks().named(name);
    let pair = (named("quaking_aspen")?, named("silver_birch")?);
    let mut row = vec![("quaking aspen".to_owned(), maps.species()[pair.0].clone())];
    for (method, label) in [
        (Method::Raw, "half way, raw"),
        (Method::Straight, "half way, straight"),
        (Method::Map, "half way, map"),
    ] {
        row.push((label.to_owned(), maps.between(method, pair, 0.5)?));
    }
    row.push(("silver birch".to_owned(), maps.species()[pair.1].clone()));
    outputs.picture(FIGURE, &sheet(row, 5, 300))
}

/// The palm half way to each other species, raw above ours.
fn with_palm(maps: &Maps, outputs: &Outputs) -> anyhow::Result<()> {
    let palm = maps.declared.landmarks().named("palm")?;
    let others: Vec<usize> = (0..maps.species().len()).filter(|&i| i != palm).collect();
    let mut cells = Vec::new();
    for chunk in others.chunks(7) {
        for method in [Method::Raw, Method::Straight, Method::Map] {
            for &other in chunk {
                let label = format!("{} {}", method.name(), maps.species()[other].name);
                cells.push((label, maps.between(method, (palm, other), 0.5)?));
            }
        }
    }
    outputs.picture(PALM, &sheet(cells, 7, 176))
}

fn sheet(cells: Vec<(String, Species)>, columns: usize, pixels: u32) -> sheets::Picture {
    let drawing = Drawing { pixels, detail: Detail::Full };
    let cells: Vec<(String, Bitmap)> = cells
        .into_par_iter()
        .map(|(label, species)| match silhouettes(&[species], SEED, drawing) {
            Ok(mut drawn) => (label, drawn.remove(0)),
            Err(_) => (format!("{label}: grows no tree"), Bitmap::new(pixels, pixels)),
        })
        .collect();
    sheets::sheet(&cells, columns)
}

/// Sums and extremes of the table by question, method and measure.
fn summary(answers: &[Answer]) -> String {
    let mut rows =
        vec![["question", "method", "measure", "rows", "sum", "mean", "least"].map(str::to_owned).to_vec()];
    let mut seen: Vec<[String; 3]> = Vec::new();
    let key_of = |row: &'_ Answer| [row.question.clone(), row.method.clone(), row.measure.clone()];
    for row in answers.iter().filter(|row| row.question != "explained variance") {
        let key = key_of(row);
        if !seen.contains(&key) {
            seen.push(key);
        }
    }
    for key in seen {
        let of = answers.iter().filter(|row| key_of(row) == key);
        let values: Vec<f64> = of.map(|row| row.value.0).collect();
        let sum: f64 = values.iter().sum();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let numbers = [sum, sum / values.len().max(1) as f64, least].map(|v| format!("{v:.3}"));
        let head = key.into_iter().chain([values.len().to_string()]);
        rows.push(head.chain(numbers).collect());
    }
    output::table(&rows, &[3, 4, 5, 6])
}
