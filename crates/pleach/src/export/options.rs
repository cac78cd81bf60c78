//! What a mesh file is to hold.

use super::forms::{Compression, LeafForm};
use crate::option_error::{OptionError, from_json};
use pleach_mesh::weld::WeldSettings;
use pleach_mesh::write::{Feature, Format};
use pleach_mesh::{MeshSettings, Palette, lod};
use pleach_render::{bark_picture, billboard};
use pleach_tree::{Parts, Season, Species};
use serde::{Deserialize, Serialize};

/// How far bark may stray from its true surface, in millimetres, where nothing says so.
const TOLERANCE: f64 = 2.0;

/// What a mesh file is to hold; the defaults are those of `pleach grow -o tree.glb`.
///
/// Without options a GLB file is for engines: [`Export::USUAL_TRIANGLES`], with pictures of bark and leaves. `finest`, `lod`,
/// `triangles`, `tolerance`, `weld`, `sway` and `leaves` (but for `none`) say how finely the tree is drawn, and take the
/// place of that budget. A tree that does not fit into it is written whole, which [`Written::note`] tells. OBJ, USDA,
/// PLY and STL files hold the whole tree.
///
/// [`Written::note`]: super::Written::note
///
/// In JSON the keys are the names of the fields; a key that is left out has its default, and one that is not known is
/// refused.
///
/// ```
/// use pleach::{Export, MeshFormat, Season};
///
/// let species = pleach::species("acer")?;
/// let tree = species.grow(1)?;
/// let export = Export { lod: Some(3), season: Some(Season::Autumn), ..Export::default() };
/// let mut glb = std::io::Cursor::new(Vec::new());
/// export.write(MeshFormat::Glb, &species, 1, &tree, None, &mut glb)?;
/// # assert!(glb.into_inner().starts_with(b"glTF"));
/// assert!(export.check(MeshFormat::Stl).is_err(), "STL holds triangles and nothing else");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Export {
    /// Whether every leaf and twig is drawn, where nothing else says how finely: without a budget and, unless
    /// `textures` asks for them, without pictures.
    pub finest: bool,
    /// Levels of detail of fixed coarseness, every leaf and twig the finest, 1 to 6.
    pub lod: Option<u32>,
    /// Budgets of levels of detail in triangles, the largest first, up to 6, instead of `lod`; twigs become cards where
    /// leaves have no room.
    pub triangles: Vec<u32>,
    /// Only this level of detail, counted from 0; cards that show the whole tree are the last.
    pub level: Option<u32>,
    /// Whether coarser levels hang on the finest by `MSFT_lod`, out of sight, instead of standing in the scene as nodes.
    pub lod_extension: bool,
    /// A last level of detail: this many crossing cards that show the tree, 1 to 8; 0 for none.
    pub billboard: u32,
    /// How far bark may stray from its true surface, in millimetres, 0.01 to 1000; by default 2, or as a budget of
    /// triangles allows.
    pub tolerance: Option<f64>,
    /// Weld all stems into one surface, on a grid with cells of this many millimetres, 1 to 1000; what is thinner becomes as
    /// thick as a cell. Without `textures` it is watertight; with them corners are there more than once. With
    /// `triangles` only stems that are thicker than a cell are welded, into as many triangles as their tubes have.
    pub weld: Option<f64>,
    /// Round the corners where welded stems meet: width of the fillet over the radius of the thinner stem, 0 to 4.
    pub fillet: f64,
    /// Whether roots are drawn, where the generator grows any.
    pub roots: bool,
    /// How leaves are drawn; by default their outlines, or as a budget of triangles allows.
    pub leaves: Option<LeafForm>,
    /// Pictures of bark, leaves and blossoms of so many pixels a side, 512, 1024 or 2048, or 0 for none: colour and normals,
    /// and of bark roughness and occlusion. By default 1024 in a GLB file, but for the finest and for welded stems without a
    /// budget, and none in others.
    pub textures: Option<u32>,
    /// How the file is made smaller; by default not at all.
    pub compress: Option<Compression>,
    /// Season; by default the species file's own, or summer with all its blossom. In JSON its name.
    #[serde(with = "season")]
    pub season: Option<Season>,
    /// Whether each vertex has the data that shaders need for wind.
    pub wind: bool,
    /// Whether each vertex has the data that shaders need to let the tree grow, in the place of `wind`.
    pub growth: bool,
    /// Whether each vertex names a pixel of two textures beside the file, from which Unreal's material functions *Pivot
    /// Painter 2* know about which points it turns: of a GLB file of one tree, in the place of `wind` and `growth`.
    pub pivot_painter: bool,
    /// Whether there are joints, and a looping animation of the tree in wind.
    pub sway: bool,
    /// Whether there are convex pieces around trunk and thick limbs that things bump into, as nodes and meshes of their
    /// own called `UCX_NAME_00` and so on, NAME being that of the finest mesh.
    pub collision: bool,
}

/// A season by name.
mod season {
    use super::*;
    use serde::de::Error;
    use serde::{Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(season: &Option<Season>, to: S) -> Result<S::Ok, S::Error> {
        season.map(Season::name).serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Season>, D::Error> {
        let Some(name) = Option::<String>::deserialize(from)? else { return Ok(None) };
        let known = || D::Error::custom(format!("expected {}", Season::NAMES.join(", ")));
        Season::from_name(&name).map(Some).ok_or_else(known)
    }
}

impl Export {
    /// Reads options from JSON, as the type's own `Deserialize` does, and tells which of them is wrong.
    ///
    /// # Errors
    /// The first key that is not an option, or whose value cannot be read.
    pub fn from_json(text: &str) -> Result<Self, OptionError> {
        from_json(text)
    }

    /// Checks everything that can be checked without a tree: ranges, options that exclude each other, and whether
    /// `format` can hold what is asked for.
    ///
    /// # Errors
    /// The first option that is wrong.
    pub fn check(&self, format: Format) -> Result<(), OptionError> {
        self.check_ranges()?;
        self.check_together()?;
        for (option, feature) in self.completed(format).features() {
            if !format.holds(feature) {
                let others = Format::ALL.into_iter().filter(|other| other.holds(feature));
                let others: Vec<String> = others.map(|other| format!(".{}", other.suffix())).collect();
                let problem =
                    format!("is for {}, and .{} cannot hold it", others.join(" and "), format.suffix());
                return Err(OptionError::new(option, problem));
            }
        }
        Ok(())
    }

    fn check_ranges(&self) -> Result<(), OptionError> {
        let error = |option, problem: String| Err(OptionError::new(option, problem));
        if let Some(lod) = self.lod.filter(|lod| !(1..=lod::MAX_LEVELS).contains(lod)) {
            return error("lod", format!("is {lod}, expected from 1 to {} levels", lod::MAX_LEVELS));
        }
        let (least, most) = (*lod::BUDGETS.start(), *lod::BUDGETS.end());
        if let Some(wrong) = self.triangles.iter().find(|budget| !lod::BUDGETS.contains(budget)) {
            return error("triangles", format!("has a level of {wrong}, expected from {least} to {most}"));
        }
        if let Some(pair) = self.triangles.windows(2).find(|pair| pair[1] >= pair[0]) {
            return error("triangles", format!("has {} after {}, expected fewer", pair[1], pair[0]));
        }
        if self.triangles.len() > lod::MAX_LEVELS as usize {
            let (found, most) = (self.triangles.len(), lod::MAX_LEVELS);
            return error("triangles", format!("has {found} levels, expected up to {most}"));
        }
        if let Some(level) = self.level.filter(|level| *level >= self.level_count()) {
            let last = self.level_count() - 1;
            return error("level", format!("is {level}, expected from 0 to {last}"));
        }
        if self.billboard > billboard::MAX_SIDES {
            let most = billboard::MAX_SIDES;
            return error("billboard", format!("is {}, expected up to {most} cards", self.billboard));
        }
        if let Some(tolerance) = self.tolerance.filter(|tolerance| !(0.01..=1000.0).contains(tolerance)) {
            return error("tolerance", format!("is {tolerance} mm, expected from 0.01 to 1000"));
        }
        if let Some(cell) = self.weld.filter(|cell| !(1.0..=1000.0).contains(cell)) {
            return error("weld", format!("has cells of {cell} mm, expected from 1 to 1000"));
        }
        if let Some(side) = self.side().filter(|side| !bark_picture::SIDES.contains(side)) {
            let sides = bark_picture::SIDES.map(|side| side.to_string()).join(", ");
            return error("textures", format!("is {side} pixels, expected one of {sides}, or 0 for none"));
        }
        if !(0.0..=WeldSettings::MAX_FILLET).contains(&self.fillet) {
            let most = WeldSettings::MAX_FILLET;
            return error("fillet", format!("is {}, expected a ratio from 0 to {most}", self.fillet));
        }
        Ok(())
    }

    fn check_together(&self) -> Result<(), OptionError> {
        let has_budget = !self.triangles.is_empty();
        if has_budget && self.finest {
            return Err(OptionError::new("triangles", "gives each level a budget: leave out `finest`"));
        }
        if has_budget && self.lod.is_some_and(|lod| lod > 1) {
            return Err(OptionError::new("triangles", "gives each level a budget: leave out `lod`"));
        }
        if has_budget && !matches!(self.leaf_form(), LeafForm::Outline | LeafForm::None) {
            return Err(OptionError::new("triangles", "decides how leaves are drawn: leave out `leaves`"));
        }
        if self.lod_extension && self.shown_levels() < 2 {
            return Err(OptionError::new(
                "lod_extension",
                "is about several levels of detail, and there is one",
            ));
        }
        let asks = [
            ("lod", self.lod.is_some_and(|lod| lod > 1)),
            ("triangles", has_budget),
            ("billboard", self.billboard > 0),
            ("sway", self.sway),
            ("wind", self.wind),
            ("growth", self.growth),
            ("pivot_painter", self.pivot_painter),
        ];
        let asked = |names: &[&str]| {
            asks.iter().find(|(name, asked)| *asked && names.contains(name)).map(|(name, _)| *name)
        };
        if self.weld.is_some()
            && let Some(other) = asked(&["lod", "sway", "growth", "pivot_painter"])
        {
            let problem = match other {
                "lod" => "is drawn in levels by budgets: give `triangles` in the place of `lod`".to_owned(),
                other => format!("makes one surface, which `{other}` cannot move"),
            };
            return Err(OptionError::new("weld", problem));
        }
        if self.sway
            && let Some(other) = asked(&["lod", "triangles", "billboard"])
        {
            return Err(OptionError::new("sway", format!("is of one mesh: leave out `{other}`")));
        }
        if self.compress.is_some()
            && let Some(other) = asked(&["wind", "growth", "pivot_painter", "sway"])
        {
            let problem = format!("moves vertices into a frame that `{other}` does not know: leave one out");
            return Err(OptionError::new("compress", problem));
        }
        if self.growth && self.wind {
            return Err(OptionError::new("growth", "takes the texture coordinates of `wind`: leave one out"));
        }
        if self.pivot_painter
            && let Some(other) = asked(&["wind", "growth"])
        {
            let problem = format!("takes the texture coordinates of `{other}`: leave one out");
            return Err(OptionError::new("pivot_painter", problem));
        }
        if self.pivot_painter && self.sway {
            return Err(OptionError::new("pivot_painter", "moves what `sway` moves: leave one out"));
        }
        let of_vertices = [("growth", self.growth), ("pivot_painter", self.pivot_painter)];
        if let Some((option, _)) = of_vertices.into_iter().find(|(_, asked)| *asked)
            && self.leaf_form() == LeafForm::Instances
        {
            let problem = "is of vertices, which `leaves` as instances do not have";
            return Err(OptionError::new(option, problem));
        }
        if self.fillet > 0.0 && self.weld.is_none() {
            return Err(OptionError::new("fillet", "is about welded stems, and `weld` is not given"));
        }
        Ok(())
    }

    /// The options that ask for something that only some formats can hold.
    fn features(&self) -> impl Iterator<Item = (&'static str, Feature)> {
        let asked = [
            ("leaves", self.leaf_form().feature()),
            ("textures", self.side().map(|_| Feature::Textures)),
            ("wind", self.wind.then_some(Feature::Wind)),
            ("growth", self.growth.then_some(Feature::Growth)),
            ("pivot_painter", self.pivot_painter.then_some(Feature::PivotPainter)),
            ("triangles", (!self.triangles.is_empty()).then_some(Feature::Budget)),
            ("triangles", (self.triangles.len() > 1 && self.level.is_none()).then_some(Feature::Levels)),
            ("lod", (self.lod.is_some_and(|lod| lod > 1) && self.level.is_none()).then_some(Feature::Levels)),
            ("lod_extension", self.lod_extension.then_some(Feature::Levels)),
            ("billboard", (self.billboard > 0 && self.shows_billboard()).then_some(Feature::Billboard)),
            ("sway", self.sway.then_some(Feature::Sway)),
            ("compress", self.compress.map(|_| Feature::Compression)),
            ("collision", self.collision.then_some(Feature::Collision)),
        ];
        asked.into_iter().filter_map(|(option, feature)| feature.map(|feature| (option, feature)))
    }

    /// How many levels of detail there are, the cards that show the whole tree included, whichever are written.
    #[must_use]
    pub fn level_count(&self) -> u32 {
        self.tree_levels() + u32::from(self.billboard > 0)
    }

    /// Levels without the cards that show the whole tree.
    pub(super) fn tree_levels(&self) -> u32 {
        self.lod.unwrap_or(1).max(self.triangles.len() as u32)
    }

    /// How many levels are written.
    pub(super) fn shown_levels(&self) -> u32 {
        if self.level.is_some() { 1 } else { self.level_count() }
    }

    /// Whether the cards that show the whole tree are written.
    pub(super) fn shows_billboard(&self) -> bool {
        self.billboard > 0 && self.level.is_none_or(|level| level == self.tree_levels())
    }

    /// How leaves are drawn, where no budget decides it.
    pub(super) fn leaf_form(&self) -> LeafForm {
        self.leaves.unwrap_or_default()
    }

    /// Pixels a side of the pictures of the bark.
    pub(super) fn side(&self) -> Option<u32> {
        self.textures.filter(|side| *side > 0)
    }

    /// What of a tree is drawn.
    #[must_use]
    pub const fn parts(&self) -> Parts {
        if self.roots { Parts::ALL } else { Parts::LEAFY }
    }

    /// The colours of the season.
    #[must_use]
    pub fn palette(&self, species: &Species) -> Palette {
        Palette::new(&species.appearance, self.season)
    }

    /// Whether leaves and blossoms show pictures.
    pub(super) fn shows_leaves(&self) -> bool {
        self.side().is_some() || self.leaf_form() == LeafForm::Cards
    }

    pub(super) fn settings(&self) -> MeshSettings {
        MeshSettings {
            tolerance: self.tolerance.unwrap_or(TOLERANCE) / 1000.0,
            leaves: if self.side().is_some() {
                self.leaf_form().style().pictured()
            } else {
                self.leaf_form().style()
            },
            pictured: self.shows_leaves(),
            wind: self.wind,
            growth: self.growth,
            parts: self.parts(),
            ..MeshSettings::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_read_back_from_json_and_unknown_ones_are_refused() {
        let other = r#"{ "finest": true, "lod": 2, "triangles": [900], "level": 0, "lod_extension": true, "billboard": 3, "tolerance": 5.0, "weld": 30.0, "fillet": 1.0, "roots": true,
            "leaves": "cards", "textures": 512, "compress": "quantize", "season": "autumn", "wind": true, "growth": true, "pivot_painter": true, "sway": true, "collision": true }"#;
        let other = Export::from_json(other).unwrap();
        let written = serde_json::to_value(&other).unwrap();
        assert_eq!(serde_json::from_value::<Export>(written.clone()).unwrap(), other);
        let usual = serde_json::to_value(Export::default()).unwrap();
        for (name, value) in usual.as_object().unwrap() {
            assert_ne!(written[name], *value, "{name} is lost, or has its default in the list of others");
        }
        assert_eq!(Export::from_json("{}").unwrap(), Export::default());
        let error = |text| Export::from_json(text).unwrap_err().to_string();
        assert!(error(r#"{"lodd": 3}"#).starts_with("`lodd` is 3: unknown field"));
        assert!(error(r#"{"season": "fall"}"#).contains("spring, summer, autumn, winter"));
        assert!(error(r#"{"leaves": "round"}"#).contains("`leaves` is \"round\""));
        assert!(error(r#"{"wind": 1}"#).contains("true or false"));
    }

    #[test]
    fn each_wrong_option_is_named() {
        fn wrong(format: Format, change: impl FnOnce(&mut Export)) -> String {
            let mut export = Export::default();
            change(&mut export);
            export.check(format).unwrap_err().option.into_owned()
        }
        for format in Format::ALL {
            assert_eq!(Export::default().check(format), Ok(()));
            assert_eq!(wrong(format, |e| e.lod = Some(0)), "lod");
            assert_eq!(wrong(format, |e| e.lod = Some(7)), "lod");
            assert_eq!(wrong(format, |e| e.billboard = 9), "billboard");
            for triangles in [
                &[0][..],
                &[10],
                &[2_000, 2_000],
                &[21_000_000],
                &[7_000, 6_000, 5_000, 4_000, 3_000, 2_000, 1_000],
            ] {
                assert_eq!(wrong(format, |e| e.triangles = triangles.to_vec()), "triangles", "{triangles:?}");
            }
            assert_eq!(wrong(format, |e| (e.triangles, e.lod) = (vec![2_000], Some(2))), "triangles");
            assert_eq!(
                wrong(format, |e| (e.triangles, e.leaves) = (vec![2_000], Some(LeafForm::Cards))),
                "triangles"
            );
            assert_eq!(wrong(format, |e| (e.triangles, e.finest) = (vec![2_000], true)), "triangles");
            assert_eq!(wrong(format, |e| (e.lod, e.weld) = (Some(2), Some(5.0))), "weld");
            assert_eq!(wrong(format, |e| e.level = Some(1)), "level");
            assert_eq!(wrong(format, |e| e.lod_extension = true), "lod_extension");
            assert_eq!(wrong(format, |e| e.tolerance = Some(f64::NAN)), "tolerance");
            assert_eq!(wrong(format, |e| e.weld = Some(0.5)), "weld");
            assert_eq!(wrong(format, |e| (e.weld, e.fillet) = (Some(5.0), 4.5)), "fillet");
            assert_eq!(wrong(format, |e| e.fillet = 1.0), "fillet");
            assert_eq!(wrong(format, |e| e.textures = Some(65_536)), "textures");
            let small = Some(Compression::Quantize);
            assert_eq!(wrong(format, |e| (e.compress, e.wind) = (small, true)), "compress");
            assert_eq!(wrong(format, |e| (e.compress, e.growth) = (small, true)), "compress");
            assert_eq!(wrong(format, |e| (e.weld, e.sway) = (Some(5.0), true)), "weld");
            assert_eq!(wrong(format, |e| (e.weld, e.growth) = (Some(5.0), true)), "weld");
            assert_eq!(wrong(format, |e| (e.wind, e.growth) = (true, true)), "growth");
            let instances = Some(LeafForm::Instances);
            assert_eq!(wrong(format, |e| (e.leaves, e.growth) = (instances, true)), "growth");
            assert_eq!(wrong(format, |e| (e.leaves, e.pivot_painter) = (instances, true)), "pivot_painter");
            assert_eq!(wrong(format, |e| (e.wind, e.pivot_painter) = (true, true)), "pivot_painter");
            assert_eq!(wrong(format, |e| (e.growth, e.pivot_painter) = (true, true)), "pivot_painter");
            assert_eq!(wrong(format, |e| (e.sway, e.pivot_painter) = (true, true)), "pivot_painter");
            assert_eq!(wrong(format, |e| (e.compress, e.pivot_painter) = (small, true)), "compress");
            assert_eq!(wrong(format, |e| (e.weld, e.pivot_painter) = (Some(5.0), true)), "weld");
            assert_eq!(wrong(format, |e| (e.compress, e.sway) = (small, true)), "compress");
            assert_eq!(wrong(format, |e| (e.sway, e.lod) = (true, Some(2))), "sway");
        }
        assert_eq!(wrong(Format::Stl, |e| e.lod = Some(2)), "lod");
        assert_eq!(wrong(Format::Stl, |e| e.triangles = vec![2_000]), "triangles");
        assert_eq!(wrong(Format::Obj, |e| e.triangles = vec![4_000, 2_000]), "triangles");
        let one_level = Export { triangles: vec![4_000, 2_000], level: Some(1), ..Export::default() };
        assert_eq!(one_level.check(Format::Obj), Ok(()));
        assert_eq!(wrong(Format::Obj, |e| e.wind = true), "wind");
        assert_eq!(wrong(Format::Stl, |e| e.growth = true), "growth");
        assert_eq!(wrong(Format::Ply, |e| e.pivot_painter = true), "pivot_painter");
        assert_eq!(wrong(Format::Ply, |e| e.leaves = Some(LeafForm::Cards)), "leaves");
        assert_eq!(wrong(Format::Usda, |e| e.billboard = 2), "billboard");
        assert_eq!(wrong(Format::Usda, |e| e.compress = Some(Compression::Quantize)), "compress");
        assert_eq!(wrong(Format::Stl, |e| e.textures = Some(512)), "textures");
        assert_eq!(wrong(Format::Ply, |e| e.textures = Some(512)), "textures");
        let message =
            Export { lod: Some(2), ..Export::default() }.check(Format::Obj).unwrap_err().to_string();
        assert_eq!(message, "`lod` is for .glb, and .obj cannot hold it");
    }
}
