//! Where a file comes from.

use pleach_tree::Species;
use serde_json::{Map, Value, json};

/// Species, parameters and seed, for anyone who finds the file without its history.
pub(super) fn extras(species: &Species, seed: Value) -> Value {
    let space = species.generator.space();
    let parameters: Map<String, Value> = space
        .params()
        .iter()
        .enumerate()
        .map(|(i, param)| {
            let values = species.params.list(i);
            let value = if let [one] = values { json!(one) } else { json!(values) };
            (param.name.to_string(), value)
        })
        .collect();
    json!({
        "species": species.name,
        "generator": species.generator.family(),
        "seed": seed,
        "units": "metres",
        "parameters": parameters,
    })
}
