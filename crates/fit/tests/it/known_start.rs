//! Searches that begin at a known species begin at its prediction too.

use pleach_fit::{
    Control, FitProblem, FitSettings, Freedom, GoalSettings, GoalView, GuessLibrary, Guessing, Predictors,
    Prior, Start, Stepwise,
};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

#[test]
fn a_search_from_a_known_species_starts_from_its_prediction_too_but_for_what_is_fixed() {
    let palm = pleach_generators::preset("palm").unwrap().clone();
    let stop = AtomicBool::new(false);
    let bytes = Predictors::record(std::slice::from_ref(&palm), 200, &(), &stop, |_, _| ()).unwrap();
    let predictors = Predictors::from_bytes(&bytes).unwrap();
    let (_, tree) = Prior::new(&palm, &Freedom::default(), 0.2).unwrap().sample(9, 1).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 96, 96);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    let problem = FitProblem::new(palm.clone(), GoalView::new(goal, View::FRONT, frame));
    let own = palm.params.values().to_vec();
    let lists = |library: GuessLibrary, fix: &[&str], optimizer: &str| {
        let fix = fix.iter().map(|&pattern| pattern.to_owned()).collect();
        let search = FitSettings {
            start: Start::Lists(vec![own.clone()]),
            freedom: Freedom { free: Vec::new(), fix },
            optimizer: optimizer.parse().unwrap(),
            ..FitSettings::default()
        };
        let settings =
            GoalSettings { search, guess: Guessing::Off, ..GoalSettings::new(vec![palm.clone().into()]) };
        let control = Control::new(&|| Duration::ZERO, &stop);
        let fit = Stepwise::begin(&problem, &settings, library, control).unwrap();
        fit.prepared().settings.start.lists().to_vec()
    };
    let known = || GuessLibrary::new().with_predictors(predictors.clone());
    assert_eq!(lists(GuessLibrary::new(), &[], "evolution"), std::slice::from_ref(&own));
    assert_eq!(
        lists(known(), &[], "hewitt"),
        std::slice::from_ref(&own),
        "the dissertation's algorithm stays as it is"
    );
    let both = lists(known(), &[], "evolution");
    assert!(both.len() == 2 && both[0] == own && both[1] != own);
    let slot = palm.params.space().select("base_size[0]").unwrap()[0].index();
    assert_ne!(both[1][slot], own[slot]);
    let fixed = lists(known(), &["base_size"], "evolution");
    assert_eq!((fixed.len(), fixed[1][slot]), (2, own[slot]));
}
