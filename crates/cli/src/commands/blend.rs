//! `pleach blend`: a species between others.

use super::landmarks::MapArgs;
use crate::{files, input, output};
use anyhow::{Context, bail};
use pleach_blend::draw::{Drawing, silhouettes};
use pleach_blend::{Blend, BlendError, BlendMap, Point, Weights};
use pleach_silhouette::Detail;
use pleach_silhouette::picture::sheet;
use pleach_tree::Species;
use serde_json::json;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach blend quaking_aspen silver_birch --at 0.5 -o mix.toml    halfway across the map
  pleach blend quaking_aspen silver_birch --straight -o mix.toml  of these two and nothing else
  pleach blend --weights aspen=1,birch=2,oak=1 -o mix.toml
  pleach blend --point 0.2,-0.4 -o mix.toml                       a point that `pleach map` shows
  pleach blend palm acer --steps 9 -o row                         row/row.png and row/1.toml to 9.toml

Across the map a blend takes something of the species that it passes; --straight does not.";

/// Write a species between others, or at a point of the map
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, group = clap::ArgGroup::new("what").required(true).multiple(true)
    .args(["from", "weights", "point"]))]
pub(crate) struct BlendCommand {
    /// A species, by name or file
    #[arg(requires = "to", conflicts_with_all = ["weights", "point"])]
    from: Option<String>,
    /// The species to go towards, by name or file
    to: Option<String>,
    /// How far to go: 0 is the first species, 1 the second
    #[arg(long, value_name = "PART", default_value_t = 0.5, allow_negative_numbers = true, value_parser = part)]
    at: f64,
    /// Through the full feature space, not across the map: made of the named species only
    #[arg(long)]
    straight: bool,
    /// Shares of several species; a part of a name will do where it is clear
    #[arg(long, value_name = "NAME=SHARE,…", value_parser = shares, conflicts_with_all = ["point", "steps", "at"])]
    weights: Option<Shares>,
    /// A point of the map
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = point,
        conflicts_with_all = ["straight", "steps", "at"])]
    point: Option<Point>,
    /// Instead of one tree, so many from the first species to the second
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=101), requires = "out", conflicts_with = "at")]
    steps: Option<u16>,
    /// The species file to write, standard output by default; with --steps a folder
    #[arg(short, long, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Name of the new species; that of the file by default
    #[arg(long)]
    name: Option<String>,
    /// Seed of the trees on the picture of --steps
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    seed: u64,
    /// Print where it is and what it is made of as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    map: MapArgs,
}

type Shares = Vec<(String, f64)>;

fn part(text: &str) -> Result<f64, String> {
    let at = text.parse().map_err(|_| "expected a number from 0 to 1".to_owned())?;
    if (0.0..=1.0).contains(&at) { Ok(at) } else { Err(BlendError::NotBetween { at }.to_string()) }
}

fn point(text: &str) -> Result<Point, String> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let both = text.split_once(',').and_then(|(x, y)| Some(Point { x: number(x)?, y: number(y)? }));
    both.ok_or_else(|| format!("`{text}` is no point, expected X,Y, such as 0.2,-0.4"))
}

fn shares(text: &str) -> Result<Shares, String> {
    let share = |item: &str| {
        let (name, share) = item.split_once('=').ok_or_else(|| format!("`{item}` is no NAME=SHARE"))?;
        match share.trim().parse::<f64>() {
            Ok(share) if share >= 0.0 && share.is_finite() => Ok((name.trim().to_owned(), share)),
            _ => Err(format!("`{item}`: a share is a number of 0 or more")),
        }
    };
    let shares = text.split(',').map(share).collect::<Result<Shares, String>>()?;
    if shares.iter().all(|(_, share)| *share == 0.0) {
        return Err(BlendError::NoWeight.to_string());
    }
    Ok(shares)
}

impl BlendCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let ends = [&self.from, &self.to].into_iter().flatten();
        let ends = ends.map(|name| Ok(input::species(name)?)).collect::<anyhow::Result<Vec<Species>>>()?;
        if let [first, second] = ends.as_slice()
            && first.params == second.params
        {
            let (first, second) = (first.name.clone(), second.name.clone());
            return Err(BlendError::AllAlike { first, second }.into());
        }
        let map = self.map.map(&ends)?;
        let named = |species: &Species| map.landmarks().named(&species.name);
        if let (Some(point), _) = (self.point, &self.weights) {
            return self.write_one(&map, &map.at(point)?, Some(point));
        }
        if let Some(shares) = &self.weights {
            let weights = self.weights(&map, shares)?;
            let (blend, point) = self.blend(&map, weights)?;
            return self.write_one(&map, &blend, point);
        }
        let [first, second] = ends.as_slice() else { bail!("expected two species, --weights or --point") };
        let (first, second) = (named(first)?, named(second)?);
        let between = |at: f64| self.blend(&map, map.landmarks().between(first, second, at)?);
        match (self.steps, &self.out) {
            (Some(steps), Some(folder)) => {
                let last = f64::from(steps - 1);
                let parts: Vec<f64> = (0..steps).map(|i| f64::from(i) / last).collect();
                let blends =
                    parts.iter().map(|at| Ok(between(*at)?.0)).collect::<anyhow::Result<Vec<_>>>()?;
                self.write_row(&map, &parts, &blends, folder)
            }
            _ => {
                let (blend, point) = between(self.at)?;
                self.write_one(&map, &blend, point)
            }
        }
    }

    /// The blend by `weights` and its point: the weighted mean of the dots, or with `--straight` none.
    fn blend(&self, map: &BlendMap, weights: Weights) -> anyhow::Result<(Blend, Option<Point>)> {
        if self.straight {
            return Ok((Blend { params: map.landmarks().mix(&weights), weights, outside: 0.0 }, None));
        }
        let mut point = Point::default();
        for (landmark, weight) in weights.present() {
            let dot = map.dots()[landmark];
            // All weight on one dot is that dot, bit for bit.
            point = if weight == 1.0 {
                dot
            } else {
                Point { x: point.x + weight * dot.x, y: point.y + weight * dot.y }
            };
        }
        Ok((map.at(point)?, Some(point)))
    }

    fn weights(&self, map: &BlendMap, shares: &Shares) -> anyhow::Result<Weights> {
        let mut all = vec![0.0; map.dots().len()];
        for (name, share) in shares {
            all[resolve(map, name)?] += share;
        }
        Ok(map.landmarks().weights(&all)?)
    }

    fn write_one(&self, map: &BlendMap, blend: &Blend, point: Option<Point>) -> anyhow::Result<()> {
        if let Some(path) = &self.out
            && path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("toml"))
        {
            bail!("{} is no .toml: a blend is written as a species file", path.display());
        }
        let species = self.species(map, blend, self.out.as_deref());
        let text = species.to_toml(&comments(map, blend, point));
        if blend.is_extrapolated() {
            output::note(format!(
                "{:.2} outside the hull of the species: extrapolated, no species vouches for this tree",
                blend.outside
            ));
        }
        if let Some(path) = &self.out {
            files::write_text(path, &text)?;
        }
        if self.json {
            output::json(&report(map, blend, point))?;
        } else if self.out.is_none() {
            output::line(text.trim_end())?;
        } else {
            output::line(&species.description)?;
        }
        if let Some(path) = &self.out {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }

    fn species(&self, map: &BlendMap, blend: &Blend, path: Option<&Path>) -> Species {
        let stem = path.and_then(Path::file_stem).map(|s| s.to_string_lossy().into_owned());
        let name = self.name.clone().or(stem).unwrap_or_else(|| "blend".to_owned());
        map.species_at(blend, &name)
    }

    fn write_row(
        &self,
        map: &BlendMap,
        parts: &[f64],
        blends: &[Blend],
        folder: &Path,
    ) -> anyhow::Result<()> {
        let species: Vec<Species> = (1..)
            .zip(blends)
            .map(|(number, blend)| {
                map.species_at(blend, &format!("{}_{number}", self.name.as_deref().unwrap_or("step")))
            })
            .collect();
        let drawing = Drawing { pixels: 192, detail: Detail::Full };
        let drawn = silhouettes(&species, self.seed, drawing)?;
        files::make_folder(folder)?;
        for (number, (species, blend)) in (1..).zip(species.iter().zip(blends)) {
            let path = folder.join(format!("{number}.toml"));
            files::write_text(&path, &species.to_toml(&comments(map, blend, None)))?;
        }
        let name = |name: &Option<String>| name.clone().unwrap_or_default();
        let last = parts.len() - 1;
        let cells: Vec<_> = parts
            .iter()
            .enumerate()
            .zip(drawn)
            .map(|((i, at), bitmap)| {
                let label = match i {
                    0 => name(&self.from),
                    i if i == last => name(&self.to),
                    _ => format!("{:.3}", at).trim_end_matches('0').to_owned(),
                };
                (label, bitmap)
            })
            .collect();
        let columns = cells.len().min(11);
        let picture = sheet(&cells, columns);
        files::write_whole(&folder.join("row.png"), |file| Ok(picture.write_png(file)?))?;
        if self.json {
            let steps: Vec<_> = blends.iter().map(|blend| report(map, blend, None)).collect();
            output::json(&json!(steps))?;
        } else {
            species
                .iter()
                .zip(parts)
                .try_for_each(|(s, at)| output::line(format!("{at:.3}  {}", s.description)))?;
        }
        output::note(format!("wrote {}", folder.display()));
        Ok(())
    }
}

/// The landmark called `name`, or the only one whose name holds it.
fn resolve(map: &BlendMap, name: &str) -> anyhow::Result<usize> {
    let unknown = match map.landmarks().named(name) {
        Ok(landmark) => return Ok(landmark),
        Err(error) => error,
    };
    let species = map.landmarks().species();
    let holding: Vec<usize> = (0..species.len()).filter(|&i| species[i].name.contains(name)).collect();
    match holding.as_slice() {
        [only] => Ok(*only),
        [] => Err(unknown).context("--all or --species brings more species"),
        several => {
            let names: Vec<&str> = several.iter().map(|&i| species[i].name.as_str()).collect();
            bail!("`{name}` may be {}: say which", names.join(" or "))
        }
    }
}

fn comments(map: &BlendMap, blend: &Blend, point: Option<Point>) -> Vec<String> {
    let mut lines = vec![format!("A blend: {}", map.landmarks().describe(&blend.weights))];
    if let Some(point) = point {
        lines.push(format!("At {:.4},{:.4} of a map of {} species", point.x, point.y, map.dots().len()));
    }
    if blend.is_extrapolated() {
        lines.push(format!("Extrapolated: {:.4} outside the hull of the species", blend.outside));
    }
    lines
}

fn report(map: &BlendMap, blend: &Blend, point: Option<Point>) -> serde_json::Value {
    let species = map.landmarks().species();
    let weights: serde_json::Map<_, _> =
        blend.weights.present().map(|(l, w)| (species[l].name.clone(), json!(w))).collect();
    json!({
        "weights": weights,
        "point": point.map(|p| [p.x, p.y]),
        "outside": blend.outside,
        "extrapolated": blend.is_extrapolated(),
    })
}
