//! Where a fit starts, and how it goes on from there: what options say without the goal's picture.

use super::effort::Effort;
use super::error::PrepareError;
use super::options::FitOptions;
use super::source::FitSource;
use super::words::{Leaves, StartFrom};
use crate::option_error::OptionError;
use crate::plan::{Origin, Shares, has_individuals, plan, usual_start};
use pleach_fit::{Budget, FitSettings, Freedom, GoalSettings, IndividualSettings, RulesSettings};
use pleach_generators::{GeneratorChoice, RegistryError};
use pleach_least_cost_path::LeastCostPathFamily;
use pleach_tree::{Family as _, Foliage, Species, SpeciesDoc};

/// Where a fit starts, and its settings.
#[derive(Clone, Debug)]
pub struct FitStart {
    /// The generators that take part.
    pub generator: GeneratorChoice,
    /// The species that the search starts from, unless a first guess has a better one.
    pub species: Species,
    /// The leaves that trees have, unless a first guess sees it otherwise.
    pub foliage: Foliage,
    /// Whether a first guess looks for leaves.
    pub detects_leaves: bool,
    /// The whole fit.
    pub settings: GoalSettings,
    /// How its time is shared out, where it is bounded.
    pub(super) shares: Option<Shares>,
}

impl FitOptions {
    /// Checks the options and resolves those that are not about pictures: the generator, the species to start from, and
    /// the settings of all parts of the fit. Of `source`, only [`FitSource::start`] is looked at.
    ///
    /// With [`FitOptions::volume_from`] the species is one of its generator, and [`FitOptions::prepare`] replaces it.
    ///
    /// # Errors
    /// A [`PrepareError`] that is not about pictures.
    pub fn start(&self, source: &FitSource) -> Result<FitStart, PrepareError> {
        self.check()?;
        let given = self.given_species(source)?;
        let given_foliage = given.as_ref().map_or(Foliage::All, |species| species.foliage);
        let generator = self.generator_of(given.as_ref())?;
        let species = self.start_species(given, generator)?;
        let individual = self.individual_settings(generator)?;
        let shares = self.whole_time().map(|whole| Shares::new(whole, individual.as_ref()));
        let search = self.search_settings(shares.as_ref());
        let detects_leaves = self.from == StartFrom::Auto
            && self.volume_from.is_none()
            && !self.evolve_rules
            && self.leaves == Leaves::Auto;
        let origin = match self.from {
            _ if self.volume_from.is_some() => Origin::Start,
            StartFrom::Species(_) => Origin::Start,
            StartFrom::Auto if !self.evolve_rules => Origin::Guess { detect_leaves: detects_leaves },
            StartFrom::Auto | StartFrom::Random => Origin::Random,
        };
        let planned = plan(origin, generator, &species, search)?;
        let settings = GoalSettings { individual, posterior: self.posterior_settings()?, ..planned };
        let foliage = match self.leaves {
            Leaves::Off => Foliage::None,
            Leaves::On => Foliage::All,
            // What a fit has found of a bare tree says so.
            Leaves::Auto => given_foliage,
        };
        Ok(FitStart { generator, species, foliage, detects_leaves, settings, shares })
    }

    /// The species that `from` names.
    fn given_species(&self, source: &FitSource) -> Result<Option<Species>, RegistryError> {
        let StartFrom::Species(name) = &self.from else { return Ok(None) };
        let species = match &source.start {
            Some(species) => species.clone(),
            None => pleach_generators::species(name)?,
        };
        Ok(Some(species.kind()))
    }

    /// The generators that take part: those that `generator` says, the one of the `given` species, or the default one.
    fn generator_of(&self, given: Option<&Species>) -> Result<GeneratorChoice, OptionError> {
        if self.volume_from.is_some() {
            let family = GeneratorChoice::Family(LeastCostPathFamily.name());
            return match self.generator {
                Some(other) if other != family => Err(OptionError::new(
                    "volume_from",
                    format!("makes a tree of the generator {family}, and `generator` says {other}"),
                )),
                _ => Ok(family),
            };
        }
        Ok(match (self.generator, given) {
            (None, None) if self.evolve_rules => varied_family()?,
            (Some(generator), _) => generator,
            (None, Some(species)) => GeneratorChoice::Family(species.generator.family()),
            (None, None) => GeneratorChoice::default(),
        })
    }

    fn start_species(
        &self,
        given: Option<Species>,
        generator: GeneratorChoice,
    ) -> Result<Species, PrepareError> {
        if let Some(species) = &given
            && !generator.takes(species)
        {
            let family = species.generator.family();
            let problem = format!(
                "{} is a species of the generator {family}, and `generator` says {generator}",
                self.from
            );
            return Err(OptionError::new("from", problem).into());
        }
        if self.evolve_rules {
            return varied_species(given, generator);
        }
        let usual = || {
            usual_start(generator)
                .ok_or_else(|| OptionError::new("generator", "has no species to start from").into())
        };
        given.map_or_else(usual, Ok)
    }

    fn individual_settings(
        &self,
        generator: GeneratorChoice,
    ) -> Result<Option<IndividualSettings>, OptionError> {
        // Where a generator is known to have no stems that can be sampled again one by one, its search gets the time.
        if self.evolve_rules || !has_individuals(generator) {
            let asks = self.individuals > 1 || !matches!(self.individual, Effort::Share | Effort::Off);
            let trees = if self.evolve_rules { "evolved grammars" } else { generator.name() };
            return if asks {
                let problem = format!(
                    "does not apply: single stems of {trees} cannot be sampled again; leave out `individual` and `individuals`"
                );
                Err(OptionError::new("individual", problem))
            } else {
                Ok(None)
            };
        }
        self.effort_settings()
    }

    /// The settings of the search alone, but for its start, its limits and its share of the time: what individuals are
    /// scored by, for a search whose individuals are scored elsewhere.
    #[must_use]
    pub fn search(&self) -> FitSettings {
        self.search_settings(None)
    }

    fn search_settings(&self, shares: Option<&Shares>) -> FitSettings {
        FitSettings {
            optimizer: self.optimizer.clone(),
            rules: self.evolve_rules.then(RulesSettings::default),
            budget: Budget {
                timeout: shares.map(|shares| shares.search),
                evaluations: self.evaluations,
                generations: self.generations,
                target_iou: self.target_iou,
                reserve: None,
            },
            seed: self.seed,
            tree_seed: self.tree_seed,
            robust: self.robust,
            objective: self.whole_objective(),
            freedom: Freedom { free: self.free.clone(), fix: self.fix.clone() },
            ..FitSettings::default()
        }
    }
}

/// The family whose structures can be searched.
fn varied_family() -> Result<GeneratorChoice, OptionError> {
    let family = pleach_generators::families().iter().find(|family| family.blank().is_some());
    family
        .map(|family| GeneratorChoice::Family(family.name()))
        .ok_or_else(|| OptionError::new("evolve_rules", "is about grammars, and no generator has them"))
}

/// The species that a search over rules starts from: the `given` one, or one without rules.
fn varied_species(given: Option<Species>, generator: GeneratorChoice) -> Result<Species, PrepareError> {
    let no_rules = |generator: &str| {
        let problem =
            format!("is about grammars, and the generator is {generator}, expected `generator` lsystem");
        OptionError::new("evolve_rules", problem)
    };
    let family = match (&given, generator) {
        (Some(species), _) => species.generator.family(),
        (None, GeneratorChoice::Family(name)) => name,
        (None, several @ (GeneratorChoice::Auto | GeneratorChoice::Trees)) => {
            return Err(no_rules(several.name()).into());
        }
    };
    let families = pleach_generators::families();
    let blank =
        families.iter().find(|known| known.name() == family).and_then(|known| Some((known, known.blank()?)));
    let Some((family, blank)) = blank else { return Err(no_rules(family).into()) };
    let start = match given {
        Some(species) => species,
        None => SpeciesDoc::parse("blank", blank)
            .and_then(|doc| doc.species(*family))
            .map_err(RegistryError::Species)?,
    };
    if start.generator.variation().is_none() {
        let problem = format!("cannot start from {}: its grammar is too long", start.name);
        return Err(OptionError::new("evolve_rules", problem).into());
    }
    Ok(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_species_is_bare_where_its_file_says_so_and_nothing_else_is_said() {
        let foliage = |species: &Species, leaves| {
            let options =
                FitOptions { from: StartFrom::Species("palm".to_owned()), leaves, ..FitOptions::default() };
            let source = FitSource { start: Some(species.clone()), ..FitSource::from("goal.png") };
            options.start(&source).unwrap().foliage
        };
        let palm = pleach_generators::species("palm").unwrap();
        let bare_palm = Species { foliage: Foliage::None, ..palm.clone() };
        assert_eq!(foliage(&palm, Leaves::Auto), Foliage::All);
        assert_eq!(foliage(&bare_palm, Leaves::Auto), Foliage::None);
        assert_eq!(foliage(&bare_palm, Leaves::On), Foliage::All);
        assert_eq!(foliage(&palm, Leaves::Off), Foliage::None);
    }
}
