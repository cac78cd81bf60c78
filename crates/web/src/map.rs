//! The map of species.

use crate::error::thrown;
use crate::species::Species;
use pleach::{BlendMap as Plane, MapSettings, Point};
use pleach_blend::picture::{Switch, extent, switch_lines};
use pleach_blend::{looks, notes};
use serde_json::json;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The fifteen species on a plane, with a tree for every point of it.
#[wasm_bindgen]
pub struct BlendMap {
    plane: Plane,
}

/// Samples across the plane for lines where choices switch.
const COLUMNS: usize = 120;
/// Parameters that are named for each axis.
const HEAVIEST: usize = 6;

#[wasm_bindgen]
impl BlendMap {
    /// Laid out by `numbers`, as `pleach map` does, or by `looks`.
    #[wasm_bindgen(constructor)]
    pub fn new(layout: &str) -> Result<Self, JsError> {
        let known = pleach::HEWITT_2017.iter().map(|name| pleach::species(name).map_err(thrown));
        let species = known.collect::<Result<Vec<_>, JsError>>()?;
        let dots = match layout {
            "numbers" => None,
            "looks" => Some(looks::scale(&looks::unlikeness(&species).map_err(thrown)?)),
            _ => return Err(thrown(format!("the layout is `{layout}`, expected numbers or looks"))),
        };
        let settings = MapSettings { dots, ..MapSettings::default() };
        Ok(Self { plane: Plane::new(species, settings).map_err(thrown)? })
    }

    /// Dots, hull, axes and lines where choices switch: JSON.
    pub fn plane(&self) -> Result<String, JsError> {
        let map = &self.plane;
        let named = map.landmarks().species().iter().zip(map.dots());
        let dots: Vec<_> =
            named.map(|(one, dot)| json!({"name": one.name, "x": dot.x, "y": dot.y})).collect();
        let pair = |point: &Point| [point.x, point.y];
        let [low, high] = extent(map);
        let features = map.landmarks().coding().features();
        let axis = |axis: usize| {
            let heavy = map.top_loadings(axis).into_iter().take(HEAVIEST);
            let sign = |loading: f64| if loading > 0.0 { "+" } else { "−" };
            heavy
                .map(|one| format!("{}{}", sign(one.loading), features[one.feature].name))
                .collect::<Vec<_>>()
        };
        let lines = switch_lines(map, COLUMNS).map_err(thrown)?;
        let lines: Vec<_> =
            lines.iter().map(|Switch { ends: [a, b], count }| json!([pair(a), pair(b), count])).collect();
        Ok(json!({
            "dots": dots,
            "hull": map.hull().corners().iter().map(pair).collect::<Vec<_>>(),
            "box": [low.x, low.y, high.x, high.y],
            "explained": map.pca().explained(),
            "axes": if map.is_by_components() { vec![axis(0), axis(1)] } else { Vec::new() },
            "switches": lines,
        })
        .to_string())
    }

    /// The species at a point.
    pub fn at(&self, x: f64, y: f64, name: &str) -> Result<Species, JsError> {
        pleach::species::check_name(name).map_err(thrown)?;
        let blend = self.plane.at(Point { x, y }).map_err(thrown)?;
        Ok(self.plane.species_at(&blend, name).into())
    }

    /// What the tree at a point is made of, and how far outside the hull of the species it is: JSON.
    pub fn about(&self, x: f64, y: f64) -> Result<String, JsError> {
        let blend = self.plane.at(Point { x, y }).map_err(thrown)?;
        let species = self.plane.landmarks().species();
        let mut weights: Vec<_> =
            blend.weights.present().map(|(one, weight)| (species[one].name.as_str(), weight)).collect();
        weights.sort_by(|a, b| b.1.total_cmp(&a.1));
        Ok(json!({"weights": weights, "outside": blend.outside}).to_string())
    }

    /// The species file of a point, as `pleach blend --point X,Y --name NAME` prints it.
    pub fn toml(&self, x: f64, y: f64, name: &str) -> Result<String, JsError> {
        pleach::species::check_name(name).map_err(thrown)?;
        let point = Point { x, y };
        let blend = self.plane.at(point).map_err(thrown)?;
        let species = self.plane.species_at(&blend, name);
        let place = Some((point, self.plane.dots().len()));
        Ok(species.to_toml(&notes(&species.description, place, blend.outside)))
    }
}
