//! What the assessment of a result says in its species file and in `parameters.csv`.

use pleach::{FitReport, IdentifiabilityCounts, Interval, ParameterReport};
use pleach_fit::{Assessment, Fitted, Identifiability, PROFILE_STEPS};
use pleach_tree::{ParamSpace, Slot};

/// Comments of the species file: what the goal does not show.
pub(super) fn comments(fitted: &Fitted, space: &ParamSpace) -> Vec<String> {
    let settled = fitted.assessment.as_ref().map_or(&[][..], |assessment| &assessment.settled);
    let sentences = [
        ("One picture shows one size, so no other is grown: 0 are", settled),
        ("The picture is as like with these where they are expected:", &fitted.as_expected),
    ];
    let of = |(start, slots): (&str, &[Slot])| {
        let names: Vec<String> = slots.iter().map(|&slot| space.slot_name(slot)).collect();
        (!names.is_empty()).then(|| format!("{start} {}.", names.join(", ")))
    };
    sentences.into_iter().filter_map(of).collect()
}

/// Rows of `parameters.csv`, the header first.
pub(super) fn table(assessment: &Assessment, parameters: &[ParameterReport]) -> Vec<Vec<String>> {
    let [small, large] = PROFILE_STEPS.map(|step| format!("{:.0}%", 100.0 * step));
    let mut header: Vec<String> =
        ["parameter", "value", "seen", "shrunk", "low", "median", "high", "low_before", "high_before"]
            .map(str::to_owned)
            .into();
    for step in [small, large] {
        header.extend([format!("cost_rise_down_{step}"), format!("cost_rise_up_{step}")]);
    }
    let text = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let rows = assessment.profiles.iter().zip(parameters).map(|(profile, parameter)| {
        let ParameterReport { slot, value, seen, shrunk, interval, before } = parameter;
        let shrunk = shrunk.map_or_else(String::new, |shrunk| format!("{shrunk:.3}"));
        let mut row = vec![slot.clone(), value.to_string(), word(*seen).to_owned(), shrunk];
        row.extend(
            [interval.map(|of| of.low), interval.map(|of| of.median), interval.map(|of| of.high)].map(text),
        );
        row.extend([before.map(|of| of.low), before.map(|of| of.high)].map(text));
        row.extend(profile.rises.iter().flatten().map(|rise| {
            rise.filter(|rise| rise.is_finite()).map_or_else(String::new, |rise| format!("{rise:.5}"))
        }));
        row
    });
    std::iter::once(header).chain(rows).collect()
}

const fn word(seen: Identifiability) -> &'static str {
    match seen {
        Identifiability::Determined => "determined",
        Identifiability::Loosely => "loosely",
        Identifiability::NotSeen => "not-seen",
        Identifiability::NotTried => "not-tried",
    }
}

/// Parameters that are said with their intervals, those that the picture tells most about.
const SHOWN: usize = 5;

/// Which parameters the goal determines, in words; nothing if the result was not judged.
pub(super) fn said(report: &FitReport) -> String {
    let Some(IdentifiabilityCounts { determined, loosely, not_seen, not_tried }) = report.determined else {
        return String::new();
    };
    let late =
        if not_tried > 0 { format!(", {not_tried} were not tried for want of time") } else { String::new() };
    let mut said = format!(
        "of the parameters the goal determines {determined}, loosely {loosely}; {not_seen} are not seen{late}\n"
    );
    let Some(known) = &report.intervals else { return said };
    if !known.is_familiar {
        said += &format!("no intervals: the picture is unlike those of trees around {}\n", known.species);
        return said;
    }
    let mut told: Vec<(f64, &str, &Interval)> = Vec::new();
    for ParameterReport { slot, seen, shrunk, interval, .. } in &report.parameters {
        if let (Identifiability::Determined | Identifiability::Loosely, Some(shrunk), Some(interval)) =
            (seen, shrunk, interval)
        {
            told.push((*shrunk, slot, interval));
        }
    }
    told.sort_by(|a, b| b.0.total_cmp(&a.0));
    let parts: Vec<String> = told
        .iter()
        .take(SHOWN)
        .map(|(_, slot, of)| format!("{slot} {} to {}", readable(of.low), readable(of.high)))
        .collect();
    if !parts.is_empty() {
        said +=
            &format!("nine in ten trees around {} that look so have {}\n", known.species, parts.join(", "));
    }
    said
}

/// Three digits that count.
pub(super) fn readable(value: f64) -> String {
    let decimals = if value == 0.0 { 0.0 } else { (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) };
    format!("{value:.*}", decimals as usize)
}
