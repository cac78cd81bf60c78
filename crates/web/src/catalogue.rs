//! The known species.

use serde_json::json;
use wasm_bindgen::prelude::wasm_bindgen;

/// All generators with their species, in order: JSON.
#[must_use]
#[wasm_bindgen]
#[allow(unreachable_pub, reason = "JavaScript calls it")]
pub fn catalogue() -> String {
    let species: Vec<pleach::Species> =
        pleach::species_names().into_iter().filter_map(|name| pleach::species(name).ok()).collect();
    let families = pleach::families().iter().map(|family| {
        let own = species.iter().filter(|one| one.generator.family() == family.name());
        let own: Vec<_> = own.map(|one| json!({"name": one.name, "description": one.description})).collect();
        json!({"family": family.name(), "species": own})
    });
    json!(families.collect::<Vec<_>>()).to_string()
}
