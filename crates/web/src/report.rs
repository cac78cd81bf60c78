//! What a fit has found, for the page's score card.

use crate::error::thrown;
use pleach::{Bitmap, COLUMNS, Fitted, Foliage, Profile, ScoreCard, Species};
use serde_json::{Map, Value, json};
use wasm_bindgen::JsError;

/// The report on `species`, whose tree draws `picture`: JSON.
pub(crate) fn of(
    species: &Species,
    picture: &Bitmap,
    goal: &Bitmap,
    fitted: &Fitted,
) -> Result<String, JsError> {
    let card = ScoreCard::new(picture, goal).map_err(thrown)?;
    let mut scores = serde_json::to_value(card).map_err(thrown)?;
    if let Value::Object(scores) = &mut scores {
        scores.insert("ellipse_iou".to_owned(), json!(card.best_ellipse_iou));
    }
    let space = species.generator.space();
    let parameters = fitted.judged.iter().flat_map(|judged| &judged.profiles);
    let parameters: Vec<Value> = parameters
        .map(|Profile { slot, seen, .. }| {
            json!({"slot": space.slot_name(*slot), "value": species.params.get(*slot), "seen": seen})
        })
        .collect();
    let history: Map<String, Value> = COLUMNS
        .iter()
        .map(|column| {
            let name = if column.name == "best_cost" { "cost" } else { column.name };
            (name.to_owned(), fitted.outcome.history.iter().map(column.value).collect())
        })
        .collect();
    let fresh = fitted.judged.as_ref().and_then(|judged| judged.held_out.as_ref());
    let names: Vec<_> = fitted.guess.iter().flat_map(|guess| &guess.names).collect();
    Ok(json!({
        "toml": species.to_toml(&[]),
        "name": species.name,
        "looks_like": names,
        "leaves": fitted.problem.foliage != Foliage::None,
        "evaluations": fitted.outcome.evaluations,
        "generations": fitted.outcome.generations,
        "seconds": fitted.outcome.elapsed.as_secs_f64(),
        "stop": fitted.outcome.stop.to_string(),
        "card": scores,
        "verdict": fitted.verdict(&card).map(|verdict| verdict.to_string()),
        "fresh": fresh,
        "references": fitted.references().map(references),
        "parameters": parameters,
        "history": history,
    })
    .to_string())
}

/// What the likeness stands beside, one after the other.
fn references(known: &pleach_fit::References) -> Vec<Value> {
    let one = |what: &str, of: &pleach_fit::Reference| json!({"what": what, "likeness": of.likeness, "iou": of.iou});
    let mut list = Vec::new();
    list.extend(known.same_species.as_ref().map(|of| one("another tree of the species", of)));
    list.extend(known.other_species.as_ref().map(|of| one("a tree of another species", of)));
    list.push(one("the best ellipse", &known.best_ellipse));
    list
}
