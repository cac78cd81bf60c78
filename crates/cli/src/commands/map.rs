//! `pleach map`: species on a plane.

use super::landmarks::MapArgs;
use crate::{files, input, output, text};
use pleach_blend::draw::{Drawing, each_tree, silhouettes};
use pleach_blend::measures::correlation;
use pleach_blend::picture::{self, Extras, TraitField};
use pleach_blend::{BlendMap, Measure, Point};
use pleach_silhouette::Detail;
use pleach_silhouette::picture::{Picture, sheet_of_pictures};
use pleach_tree::Species;
use serde_json::json;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach map -o map                       the fifteen species
  pleach map --grid 9x9 -o map            and grid.png: trees across the plane
  pleach map --traits droop,ink -o map    with lines of equal traits
  pleach map --species my-trees --layout looks -o map
  pleach map --generator lsystem -o map   species of another generator

Every point inside the dashed line is a tree; `pleach blend --point X,Y` writes its species file.";

/// Lay species out on a plane, every point of which is a tree
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Map {
    /// Folder to write to: map.png, map.svg, map.csv (the dots) and loadings.csv (every axis).
    /// Several files, so `-` for standard output is refused
    #[arg(short, long, value_name = "DIR", value_parser = folder)]
    out: PathBuf,
    /// Also write grid.png: this many trees across and down the plane
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = grid)]
    grid: Option<(usize, usize)>,
    /// Draw iso-lines of traits: height_to_width, ink, bare_trunk, branch_angle, droop
    #[arg(long, value_name = "TRAIT,…", value_delimiter = ',', value_parser = trait_named)]
    traits: Vec<Measure>,
    /// Leave out the silhouettes
    #[arg(long)]
    no_thumbnails: bool,
    /// Seed of the trees that are drawn
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    map: MapArgs,
}

/// Any folder, but not standard output: a map is several files.
fn folder(text: &str) -> Result<PathBuf, String> {
    if text == "-" {
        return Err("a map is several files and cannot go to standard output; name a folder, such as \
                    `-o map`, or `-o ./-` for one of that name"
            .to_owned());
    }
    Ok(PathBuf::from(text))
}

/// `9x9`.
fn grid(text: &str) -> Result<(usize, usize), String> {
    let hint = || format!("`{text}` is not a grid, expected COLUMNSxROWS from 1x1 to 40x40, such as 9x9");
    let (columns, rows) = text.split_once(['x', '×']).ok_or_else(hint)?;
    let number = |part: &str| part.trim().parse().ok().filter(|n| (1..=40).contains(n)).ok_or_else(hint);
    Ok((number(columns)?, number(rows)?))
}

fn trait_named(name: &str) -> Result<Measure, String> {
    Measure::named(name).ok_or_else(|| {
        let names = Measure::ALL.map(Measure::name);
        let hint = pleach_tree::param::nearest(name, names)
            .map_or_else(|| ".".to_owned(), |n| format!(", did you mean `{n}`?"));
        format!("no trait is called `{name}`{hint} Known are {}", names.join(", "))
    })
}

/// With fewer species any trait correlates with an axis: two dots always lie on a line.
const FEWEST_TO_CORRELATE: usize = 5;

/// Height and width of a tree on a sheet, in pixels.
const CELL: u32 = 128;

impl Map {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let map = self.map.map(&[])?;
        let mut extras = Extras::default();
        if !self.no_thumbnails {
            extras.thumbnails = picture::thumbnails(&map, self.seed)?;
        }
        if !self.traits.is_empty() {
            extras.traits = sample(&map, &self.traits, self.seed)?;
        }
        let scene = picture::scene(&map, &extras)?;
        files::make_folder(&self.out)?;
        let png = scene.to_png().ok_or_else(|| anyhow::anyhow!("the picture of the map is too large"))?;
        files::write_whole(&self.out.join("map.png"), |file| Ok(std::io::Write::write_all(file, &png)?))?;
        files::write_text(&self.out.join("map.svg"), &scene.to_svg())?;
        write_dots(&map, &self.out.join("map.csv"))?;
        write_loadings(&map, &self.out.join("loadings.csv"))?;
        if let Some((columns, rows)) = self.grid {
            let sheet = grid_sheet(&map, columns, rows, self.seed)?;
            files::write_whole(&self.out.join("grid.png"), |file| Ok(sheet.write_png(file)?))?;
        }
        let enough = map.dots().len() >= FEWEST_TO_CORRELATE;
        let directions =
            if self.no_thumbnails || !enough { Vec::new() } else { directions(&map, self.seed)? };
        if self.json {
            output::json(&report_json(&map, &directions))?;
        } else {
            output::line(report(&map, &directions))?;
        }
        output::note(format!("wrote {}", self.out.display()));
        Ok(())
    }
}

/// Grows a tree at each point of the traits' grid and measures it.
fn sample(map: &BlendMap, traits: &[Measure], seed: u64) -> anyhow::Result<Vec<TraitField>> {
    let points = picture::trait_points(map);
    let species = species_at(map, &points.iter().flatten().copied().collect::<Vec<_>>())?;
    let measured =
        each_tree(&species, seed, |tree, _| traits.iter().map(|t| t.value(tree)).collect::<Vec<f64>>())?;
    let fields = traits.iter().enumerate().map(|(number, &of)| {
        let mut values = measured.iter().map(|values| values[number]);
        TraitField { of, values: points.iter().map(|point| point.and_then(|_| values.next())).collect() }
    });
    Ok(fields.collect())
}

fn species_at(map: &BlendMap, points: &[Point]) -> anyhow::Result<Vec<Species>> {
    let at = |p: &Point| Ok(map.species_at(&map.at(*p)?, &format!("tree at {:.2},{:.2}", p.x, p.y)));
    points.iter().map(at).collect()
}

/// Trees across the plane; those outside the hull in grey.
fn grid_sheet(map: &BlendMap, columns: usize, rows: usize, seed: u64) -> anyhow::Result<Picture> {
    let points = picture::grid_points(map, columns, rows);
    let drawing = Drawing { pixels: CELL, detail: Detail::Full };
    let drawn = silhouettes(&species_at(map, &points)?, seed, drawing)?;
    let cells: Vec<(String, Picture)> = points
        .iter()
        .zip(drawn)
        .map(|(point, bitmap)| {
            let inside = map.hull().contains(*point);
            let mut picture = Picture::new(bitmap.width(), bitmap.height());
            picture.stamp(&bitmap, 0, 0, if inside { [20; 3] } else { [190; 3] });
            (format!("{:.2},{:.2}", point.x, point.y), picture)
        })
        .collect();
    let cells: Vec<(&str, Picture)> = cells.iter().map(|(label, p)| (label.as_str(), p.clone())).collect();
    Ok(sheet_of_pictures(&cells, columns))
}

fn write_dots(map: &BlendMap, path: &Path) -> anyhow::Result<()> {
    files::write_whole(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(["species", "x", "y", "residual"])?;
        for (i, (species, dot)) in map.landmarks().species().iter().zip(map.dots()).enumerate() {
            let numbers = [dot.x, dot.y, map.residual(i)].map(|v| format!("{v:.6}"));
            csv.write_record(std::iter::once(text::cell(&species.name).into_owned()).chain(numbers))?;
        }
        Ok(csv.flush()?)
    })
}

/// Every feature's part of every axis.
fn write_loadings(map: &BlendMap, path: &Path) -> anyhow::Result<()> {
    files::write_whole(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        let axes = map.pca().axes().len();
        let space = map.landmarks().space();
        let heading = ["parameter", "feature"].map(str::to_owned).into_iter();
        csv.write_record(heading.chain((1..=axes).map(|a| format!("axis_{a}"))))?;
        for (f, feature) in map.landmarks().coding().features().iter().enumerate() {
            let cells = (0..axes).map(|a| format!("{:.6}", map.pca().loading(a, f)));
            csv.write_record([space.slot_name(feature.slot), feature.name.clone()].into_iter().chain(cells))?;
        }
        Ok(csv.flush()?)
    })
}

/// A trait and how it correlates with x and y over the species.
type Direction = (Measure, [f64; 2]);

fn directions(map: &BlendMap, seed: u64) -> anyhow::Result<Vec<Direction>> {
    let measure = |tree: &pleach_tree::Tree| Measure::ALL.map(|t| t.value(tree));
    let measured = each_tree(map.landmarks().species(), seed, |tree, _| measure(tree))?;
    let axes: [Vec<f64>; 2] =
        [map.dots().iter().map(|d| d.x).collect(), map.dots().iter().map(|d| d.y).collect()];
    let along = |number: usize| {
        let values: Vec<f64> = measured.iter().map(|values| values[number]).collect();
        [0, 1].map(|axis: usize| correlation(&axes[axis], &values))
    };
    Ok(Measure::ALL.into_iter().enumerate().map(|(number, of)| (of, along(number))).collect())
}

fn report(map: &BlendMap, directions: &[Direction]) -> String {
    let explained = map.pca().explained();
    let heading = ["axis", "explained", "together", "the parameters that weigh most"];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let mut together = 0.0;
    for (axis, share) in explained.iter().enumerate().take(2) {
        together += share;
        let heavy = top_loadings(map, axis).join("  ");
        rows.push(vec![(axis + 1).to_string(), percent(*share), percent(together), heavy]);
    }
    // The picture has two axes; the rest is in loadings.csv and --json.
    if let Some(rest) = explained.get(2..).filter(|rest| !rest.is_empty()) {
        let share: f64 = rest.iter().sum();
        let axes = if rest.len() == 1 { "3".to_owned() } else { format!("3–{}", explained.len()) };
        rows.push(vec![axes, percent(share), percent(together + share), "not on the map".to_owned()]);
    }
    let explained = output::table(&rows, &[0, 1, 2]);
    if directions.is_empty() {
        return explained;
    }
    let mut rows = vec![["trait", "with x", "with y"].map(str::to_owned).to_vec()];
    rows.extend(
        directions
            .iter()
            .map(|(of, [x, y])| vec![of.name().replace('_', " "), format!("{x:+.2}"), format!("{y:+.2}")]),
    );
    format!(
        "{explained}\n\nhow the species' traits go with the axes, -1 to 1\n{}",
        output::table(&rows, &[1, 2])
    )
}

/// The six features that weigh most on an axis, with the direction in which they grow.
fn top_loadings(map: &BlendMap, axis: usize) -> Vec<String> {
    let features = map.landmarks().coding().features();
    let heavy = map.top_loadings(axis).into_iter().take(6);
    heavy
        .map(|l| format!("{}{}", if l.loading > 0.0 { "+" } else { "−" }, features[l.feature].name))
        .collect()
}

fn report_json(map: &BlendMap, directions: &[Direction]) -> serde_json::Value {
    let traits: serde_json::Map<_, _> =
        directions.iter().map(|(of, along)| (of.name().to_owned(), json!(along))).collect();
    let species: Vec<_> = map
        .landmarks()
        .species()
        .iter()
        .zip(map.dots())
        .enumerate()
        .map(|(i, (s, dot))| json!({"species": s.name, "x": dot.x, "y": dot.y, "residual": map.residual(i)}))
        .collect();
    json!({
        "species": species,
        "explained_variance": map.pca().explained(),
        "heaviest": [top_loadings(map, 0), top_loadings(map, 1)],
        "traits": traits,
    })
}
