//! `pleach blend`: a species between others.

use super::landmarks::{MapArgs, names_folder};
use crate::{files, input, output};
use anyhow::{Context, bail};
use pleach_blend::draw::{Drawing, silhouettes};
use pleach_blend::plane::readable;
use pleach_blend::{Blend, BlendError, BlendMap, Landmarks, Point, Weights, notes};
use pleach_silhouette::Detail;
use pleach_silhouette::picture::sheet;
use pleach_tree::Species;
use serde_json::json;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach blend quaking_aspen silver_birch --at 0.5 -o mix.toml   half and half
  pleach blend aspen birch --at 0.2                              mostly aspen
  pleach blend --weights aspen=1,birch=2,palm=1 -o mix.toml
  pleach blend palm acer --steps 9 -o row      row/row.png, row/1.toml to 9.toml
  pleach blend palm acer --across-the-map -o mix.toml
  pleach blend --point 0.2,-0.4 -o mix.toml    a point that `pleach map` shows

A blend is made of the species that are named and of nothing else. Across the map, and at a point of it, it takes something of every species near by.";

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
    /// On a straight line over the map that `pleach map` draws, taking something of each species that it passes
    #[arg(long, conflicts_with_all = ["weights", "point"])]
    across_the_map: bool,
    /// A mixture of the named species only (the default)
    #[arg(long, hide = true, conflicts_with = "across_the_map")]
    straight: bool,
    /// Shares of several species, by name or file
    #[arg(long, value_name = "NAME=SHARE,…", value_parser = shares, conflicts_with_all = ["point", "steps", "at"])]
    weights: Option<Shares>,
    /// A point of the map
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = point,
        conflicts_with_all = ["straight", "steps", "at"])]
    point: Option<Point>,
    /// Instead of one tree, a row of this many from the first species to the second
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=101), requires = "out", conflicts_with = "at")]
    steps: Option<u16>,
    /// The species file to write, or a folder for it that ends in a slash; `-`, the default, is standard output. With --steps a folder
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
    both.ok_or_else(|| format!("`{text}` is not a point, expected X,Y, such as 0.2,-0.4"))
}

fn shares(text: &str) -> Result<Shares, String> {
    let share = |item: &str| {
        let (name, share) = item
            .split_once('=')
            .ok_or_else(|| format!("`{item}` is not NAME=SHARE, such as quaking_aspen=1"))?;
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

/// A blend and its recipe.
struct Made {
    species: Species,
    /// What it is made of, by name.
    recipe: Vec<(String, f64)>,
    /// How far outside the hull of the map's species it is; 0 without a map.
    outside: f64,
    /// Its place on a map, and the number of species there.
    place: Option<(Point, usize)>,
}

impl Made {
    fn new(landmarks: &Landmarks, blend: Blend, place: Option<(Point, usize)>) -> Self {
        let name = |landmark: usize| landmarks.species()[landmark].name.clone();
        Self {
            recipe: blend.weights.present().map(|(l, w)| (name(l), w)).collect(),
            outside: blend.outside,
            place,
            species: landmarks.species_of(&blend.weights, blend.params, ""),
        }
    }

    fn straight(landmarks: &Landmarks, weights: Weights) -> Self {
        Self::new(landmarks, Blend { params: landmarks.mix(&weights), weights, outside: 0.0 }, None)
    }

    /// All of one species.
    fn only(species: Species) -> Self {
        let recipe = vec![(species.name.clone(), 1.0)];
        let description = format!("1 {}", species.name);
        Self {
            species: Species { description, tree_seed: None, ..species },
            recipe,
            outside: 0.0,
            place: None,
        }
    }

    fn comments(&self) -> Vec<String> {
        notes(&self.species.description, self.place, self.outside)
    }

    fn report(&self) -> serde_json::Value {
        let weights: serde_json::Map<_, _> = self.recipe.iter().map(|(n, w)| (n.clone(), json!(w))).collect();
        json!({
            "weights": weights,
            "point": self.place.map(|(p, _)| [p.x, p.y]),
            "outside": self.outside,
            "extrapolated": self.outside > 0.0,
        })
    }
}

impl BlendCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        if let Some(shares) = &self.weights {
            self.map.refuse_without_map(true)?;
            return self.write_one(self.of_shares(shares)?);
        }
        if let Some(point) = self.point {
            let map = self.map.map(&[])?;
            let place = Some((point, map.dots().len()));
            return self.write_one(Made::new(map.landmarks(), map.at(point)?, place));
        }
        let ends = [&self.from, &self.to].into_iter().flatten();
        let ends = ends.map(|name| Ok(input::species(name)?)).collect::<anyhow::Result<Vec<Species>>>()?;
        let [first, second] = ends.as_slice() else { bail!("expected two species, --weights or --point") };
        if first.params == second.params {
            let (first, second) = (first.name.clone(), second.name.clone());
            return Err(BlendError::AllAlike { first, second }.into());
        }
        let names = [first.name.clone(), second.name.clone()];
        if self.across_the_map {
            let map = self.map.map(&ends)?;
            return self.write(&names, |at| across(&map, &names, at));
        }
        self.map.refuse_without_map(false)?;
        let landmarks = Landmarks::new(in_order(ends), self.map.features())?;
        let [from, to] = [landmarks.named(&names[0])?, landmarks.named(&names[1])?];
        self.write(&names, |at| Ok(Made::straight(&landmarks, landmarks.between(from, to, at)?)))
    }

    /// Writes the blend or the row of blends.
    fn write(
        &self,
        names: &[String; 2],
        between: impl Fn(f64) -> anyhow::Result<Made>,
    ) -> anyhow::Result<()> {
        let (Some(steps), Some(folder)) = (self.steps, &self.out) else {
            return self.write_one(between(self.at)?);
        };
        if folder.as_os_str() == "-" {
            bail!("a row is several files and cannot go to standard output: name a folder, such as -o row");
        }
        let last = f64::from(steps - 1);
        let parts: Vec<f64> = (0..steps).map(|i| f64::from(i) / last).collect();
        let row = parts.iter().map(|at| between(*at)).collect::<anyhow::Result<Vec<_>>>()?;
        self.write_row(names, &parts, row, folder)
    }

    /// Exactly the given shares of the named species.
    fn of_shares(&self, shares: &Shares) -> anyhow::Result<Made> {
        let own = self.map.own_species()?;
        let mut chosen: Vec<Species> = Vec::new();
        for (name, _) in shares {
            let species = match own.iter().find(|species| species.name == *name) {
                Some(species) => species.clone(),
                None => input::species(name)?,
            };
            if !chosen.iter().any(|s| s.name == species.name && s.params == species.params) {
                chosen.push(species);
            }
        }
        if let [only] = chosen.as_slice() {
            return Ok(Made::only(only.clone()));
        }
        let landmarks = Landmarks::new(in_order(chosen), self.map.features())?;
        let mut all = vec![0.0; landmarks.species().len()];
        for (name, share) in shares {
            let landmark = match landmarks.named(name) {
                Ok(landmark) => landmark,
                // An alias or a file, whose species has another name.
                Err(_) => landmarks.named(&input::species(name)?.name)?,
            };
            all[landmark] += share;
        }
        let weights = landmarks.weights(&all)?;
        Ok(Made::straight(&landmarks, weights))
    }

    fn write_one(&self, made: Made) -> anyhow::Result<()> {
        let file = self.file()?;
        let stem = file.as_deref().and_then(Path::file_stem).map(|s| s.to_string_lossy().into_owned());
        let name = self.name.clone().or(stem).unwrap_or_else(|| "blend".to_owned());
        let made = Made { species: Species { name, ..made.species.clone() }, ..made };
        let text = made.species.to_toml(&made.comments());
        if made.outside > 0.0 {
            let outside = readable((made.outside * 100.0).round() / 100.0);
            output::note(format!("{outside} outside the hull of the species: this tree is extrapolated"));
        }
        if let Some(path) = &file {
            if let Some(folder) = path.parent().filter(|_| self.out_is_folder()) {
                files::make_folder(folder)?;
            }
            files::write_text(path, &text)?;
        }
        if self.json {
            output::json(&made.report())?;
        } else if file.is_none() {
            output::data(text.trim_end())?;
        } else {
            output::line(&made.species.description)?;
        }
        if let Some(path) = &file {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }

    fn out_is_folder(&self) -> bool {
        self.out.as_deref().is_some_and(names_folder)
    }

    /// The file of a single blend; `None` for standard output.
    fn file(&self) -> anyhow::Result<Option<PathBuf>> {
        let Some(path) = self.out.as_deref().filter(|path| path.as_os_str() != "-") else {
            return Ok(None);
        };
        if self.out_is_folder() {
            return Ok(Some(path.join(format!("{}.toml", self.name.as_deref().unwrap_or("blend")))));
        }
        if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("toml")) {
            bail!(
                "{} is not a .toml file: a blend is written as a species file, or into a folder if the path \
                 ends in a slash",
                path.display()
            );
        }
        Ok(Some(path.to_owned()))
    }

    fn write_row(
        &self,
        names: &[String; 2],
        parts: &[f64],
        mut row: Vec<Made>,
        folder: &Path,
    ) -> anyhow::Result<()> {
        for (number, made) in (1..).zip(&mut row) {
            made.species.name = format!("{}_{number}", self.name.as_deref().unwrap_or("step"));
        }
        let species: Vec<Species> = row.iter().map(|made| made.species.clone()).collect();
        let drawing = Drawing { pixels: 192, detail: Detail::Full };
        let drawn = silhouettes(&species, self.seed, drawing)?;
        files::make_folder(folder)?;
        for (number, made) in (1..).zip(&row) {
            let path = folder.join(format!("{number}.toml"));
            files::write_text(&path, &made.species.to_toml(&made.comments()))?;
        }
        let last = parts.len() - 1;
        let cells: Vec<_> = parts
            .iter()
            .enumerate()
            .zip(drawn)
            .map(|((i, at), bitmap)| {
                let label = match i {
                    0 => names[0].clone(),
                    i if i == last => names[1].clone(),
                    _ => format!("{:.3}", at).trim_end_matches('0').to_owned(),
                };
                (label, bitmap)
            })
            .collect();
        let columns = cells.len().min(11);
        let picture = sheet(&cells, columns);
        files::write_whole(&folder.join("row.png"), |file| Ok(picture.write_png(file)?))?;
        if self.json {
            output::json(&json!(row.iter().map(Made::report).collect::<Vec<_>>()))?;
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

/// Built-in species in their own order, before others in the order given: where a count has to go to one
/// of two equal shares, A with B is then the same as B with A.
fn in_order(mut species: Vec<Species>) -> Vec<Species> {
    let known = pleach_generators::names();
    species.sort_by_key(|s| known.iter().position(|name| *name == s.name).unwrap_or(known.len()));
    species
}

/// The blend on the line from one dot of the map to another.
fn across(map: &BlendMap, [first, second]: &[String; 2], at: f64) -> anyhow::Result<Made> {
    let landmarks = map.landmarks();
    let point = map.between(landmarks.named(first)?, landmarks.named(second)?, at)?;
    let blend = map.at(point).with_context(|| format!("there is no tree {at} of the way"))?;
    Ok(Made::new(landmarks, blend, Some((point, map.dots().len()))))
}
