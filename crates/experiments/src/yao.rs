//! Graphs of least-cost paths: how nodes are linked, and what it costs. Xu and Mould 2012, Figure 22
//! and Table 1.

use super::plot::{Plot, Scale};
use super::record::{self, Fixed};
use super::spec::{Repetitions, Source};
use super::within::{FileName, List, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use pleach_console::output;
use pleach_least_cost_path::{LeastCostPath, LeastCostPathFamily, Work};
use pleach_tree::{Foliage, Growth, SpeciesDoc, Tree, Workspace};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;
use toml::Spanned;

/// Times are the least of this many, since other work can only add to them.
const TRIES: usize = 3;

const PLOT: &str = "time.svg";

/// A tree with its nodes linked in one way.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Linked {
    model: String,
    links: String,
    seed: u64,
    /// Of all graphs.
    nodes: usize,
    edges_per_node: Fixed<3>,
    endpoints: usize,
    /// Endpoints without a path to the root.
    lost: usize,
    stems: usize,
    /// Length of the stems of level 0 and of all, in meters.
    trunk_m: Fixed<3>,
    all_m: Fixed<2>,
    wall_one_thread_ms: Fixed<2>,
    wall_threads_ms: Fixed<2>,
}

/// How nodes are linked: a name and lines of a species file.
type Links = (&'static str, &'static str);

const YAO: Links = ("yao", "");
const OTHERS: [Links; 3] = [
    ("yao, cube faces", "sectors = \"cube_faces\"\n"),
    ("threshold 1.9", "graph = \"threshold\"\nlink = 1.9\n"),
    ("threshold 1.45", "graph = \"threshold\"\nlink = 1.45\n"),
];

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Model {
    name: FileName,
    nodes: Whole<10, 1_000_000>,
    subgraph_nodes: Whole<5, 20_000>,
    branching: List<Spanned<Whole<1, 400>>, 1, 8>,
    /// Whether the nodes are linked in other ways as well.
    #[serde(default)]
    all_links: bool,
    /// Seconds that the paper gives.
    seconds: Option<Whole<0, 1_000_000>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct YaoSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    models: List<Spanned<Model>>,
    /// Seeds 1 to this of each model.
    seeds: Repetitions,
}

impl Model {
    /// A tree far above the ground, so that it cuts no graph short.
    fn species(&self, links: &str) -> String {
        let mut branching: Vec<u64> = self.branching.iter().map(|b| **b.get_ref()).collect();
        let levels = branching.len();
        branching.resize(8, 1);
        format!(
            "trunk_height = 12\ntrunk_width = 0.4\nreach = 0.3\nspacing = 0.7\nlevels = {levels}\n\
             nodes = {}\nsubgraph_nodes = {}\nbranching = {branching:?}\n{links}",
            *self.nodes, *self.subgraph_nodes
        )
    }

    fn links(&self) -> impl Iterator<Item = Links> {
        let others = if self.all_links { &OTHERS[..] } else { &[] };
        std::iter::once(YAO).chain(others.iter().copied())
    }
}

impl YaoSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        for model in &self.models {
            let model = model.get_ref();
            for (_, links) in model.links() {
                SpeciesDoc::parse("a model", &model.species(links))?.species(&LeastCostPathFamily)?;
            }
        }
        source.all_differ(&self.models, |model| model.name.to_string(), "")?;
        Ok(self)
    }
}

impl Kind for YaoSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Linked::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (vec![PLOT.to_owned()], Vec::new())
    }

    /// One row for each model, way of linking and seed.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let seeds = slice.repetitions.unwrap_or(*self.seeds).min(*self.seeds);
        let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
        let bar = progress("models", self.models.len() as u64);
        for model in &self.models {
            let model = model.get_ref();
            for (links, lines) in model.links() {
                for seed in 1..=seeds {
                    journal.job(
                        |row: &Linked| {
                            (row.model.as_str(), row.links.as_str(), row.seed) == (&*model.name, links, seed)
                        },
                        || Ok(vec![row(model, (links, lines), seed, &mut workspace, &mut tree)?]),
                    )?;
                }
            }
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Linked> = table.records()?;
        let head = [
            "model",
            "links",
            "nodes",
            "edges/node",
            "endpoints",
            "lost",
            "1 thread, ms",
            "all threads, ms",
            "2012, s",
        ];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        let mut plot = Plot::new("nodes", "milliseconds on one thread", Scale::Log, Scale::Log);
        let mut points = Vec::new();
        for model in &self.models {
            let model = model.get_ref();
            for (links, _) in model.links() {
                let of: Vec<&Linked> = rows
                    .iter()
                    .filter(|row| (row.model.as_str(), row.links.as_str()) == (&*model.name, links))
                    .collect();
                if of.is_empty() {
                    continue;
                }
                let mean = |value: &dyn Fn(&Linked) -> f64| {
                    of.iter().map(|row| value(row)).sum::<f64>() / of.len() as f64
                };
                let time = mean(&|row| row.wall_one_thread_ms.0);
                if links == YAO.0 {
                    points.push((mean(&|row| row.nodes as f64), time));
                }
                lines.push(vec![
                    model.name.to_string(),
                    links.to_owned(),
                    format!("{:.0}", mean(&|row| row.nodes as f64)),
                    format!("{:.2}", mean(&|row| row.edges_per_node.0)),
                    format!("{:.0}", mean(&|row| row.endpoints as f64)),
                    format!("{:.1}", mean(&|row| row.lost as f64)),
                    format!("{time:.0}"),
                    format!("{:.0}", mean(&|row| row.wall_threads_ms.0)),
                    model.seconds.map_or(String::new(), |seconds| format!("{:.1}", *seconds as f64 / 1e3)),
                ]);
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        plot.line("Yao graphs", &points, false);
        outputs.text(PLOT, &plot.svg())?;
        Ok(output::table(&lines, &(2..head.len()).collect::<Vec<_>>()))
    }
}

fn row(
    model: &Model,
    (links, lines): Links,
    seed: u64,
    workspace: &mut Workspace,
    tree: &mut Tree,
) -> anyhow::Result<Linked> {
    let species = SpeciesDoc::parse("a model", &model.species(lines))?.species(&LeastCostPathFamily)?;
    let mut grow = |parallel: bool| -> anyhow::Result<(Work, f64)> {
        let mut least = (Work::default(), f64::INFINITY);
        for _ in 0..TRIES {
            let started = Instant::now();
            let growth = Growth { parallel, foliage: Foliage::None, ..Growth::seed(seed) };
            let work = LeastCostPath::default().grow_counted(&species.params, &growth, workspace, tree)?;
            least = (work, least.1.min(started.elapsed().as_secs_f64() * 1e3));
        }
        Ok(least)
    };
    let (work, one) = grow(false)?;
    let (_, all) = grow(true)?;
    let length = |level: u16| {
        tree.stems.iter().filter(move |stem| stem.level <= level).map(|stem| tree.length_of(stem))
    };
    Ok(Linked {
        model: model.name.to_string(),
        links: links.to_owned(),
        seed,
        nodes: work.nodes,
        edges_per_node: Fixed(work.edges as f64 / work.nodes.max(1) as f64),
        endpoints: work.endpoints,
        lost: work.lost,
        stems: tree.stems.len(),
        trunk_m: Fixed(length(0).sum()),
        all_m: Fixed(length(u16::MAX).sum()),
        wall_one_thread_ms: Fixed(one),
        wall_threads_ms: Fixed(all),
    })
}
