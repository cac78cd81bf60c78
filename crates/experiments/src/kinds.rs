//! The kinds of experiments, each with the options of its file.

use super::bench::BenchSpec;
use super::families::FamiliesSpec;
use super::individual::IndividualSpec;
use super::likeness::LikenessSpec;
use super::needle::NeedleSpec;
use super::perturbed::PerturbedSpec;
use super::photographs::PhotographsSpec;
use super::posterior::PosteriorSpec;
use super::reading::ReadingSpec;
use super::robustness::RobustnessSpec;
use super::rules::RulesSpec;
use super::spec::{BlendSpec, FitsSpec, GrowthSpec, Kind, Source};
use super::stylised::StylisedSpec;
use super::treefit::TreefitSpec;
use super::yao::YaoSpec;

/// An experiment of any kind.
#[derive(Clone, Debug)]
pub(super) enum Spec {
    Fits(FitsSpec),
    Growth(GrowthSpec),
    Blend(BlendSpec),
    Likeness(LikenessSpec),
    Treefit(TreefitSpec),
    Needle(NeedleSpec),
    Robustness(RobustnessSpec),
    Rules(RulesSpec),
    Families(FamiliesSpec),
    Individual(IndividualSpec),
    Yao(YaoSpec),
    Stylised(StylisedSpec),
    Reading(ReadingSpec),
    Photographs(PhotographsSpec),
    Posterior(PosteriorSpec),
    Perturbed(PerturbedSpec),
    Bench(BenchSpec),
}

impl Spec {
    /// Reads and checks all options of `source`.
    pub(super) fn read(source: &Source) -> anyhow::Result<Self> {
        Ok(match source.head()?.kind {
            Kind::Fits => Self::Fits(source.parse::<FitsSpec>()?.checked(source)?),
            Kind::Growth => Self::Growth(source.parse::<GrowthSpec>()?.checked(source)?),
            Kind::Blend => Self::Blend(source.parse::<BlendSpec>()?.checked(source)?),
            Kind::Likeness => Self::Likeness(source.parse::<LikenessSpec>()?.checked(source)?),
            Kind::Treefit => Self::Treefit(source.parse::<TreefitSpec>()?.checked(source)?),
            Kind::Needle => Self::Needle(source.parse::<NeedleSpec>()?.checked(source)?),
            Kind::Families => Self::Families(source.parse::<FamiliesSpec>()?.checked(source)?),
            Kind::Individual => Self::Individual(source.parse::<IndividualSpec>()?.checked(source)?),
            Kind::Robustness => Self::Robustness(source.parse::<RobustnessSpec>()?.checked(source)?),
            Kind::Rules => Self::Rules(source.parse::<RulesSpec>()?.checked(source)?),
            Kind::Yao => Self::Yao(source.parse::<YaoSpec>()?.checked(source)?),
            Kind::Photographs => Self::Photographs(source.parse::<PhotographsSpec>()?.checked(source)?),
            Kind::Posterior => Self::Posterior(source.parse::<PosteriorSpec>()?.checked(source)?),
            Kind::Perturbed => Self::Perturbed(source.parse::<PerturbedSpec>()?.checked(source)?),
            Kind::Bench => Self::Bench(source.parse::<BenchSpec>()?.checked(source)?),
            Kind::Reading => Self::Reading(source.parse::<ReadingSpec>()?.checked(source)?),
            Kind::Stylised => Self::Stylised(source.parse::<StylisedSpec>()?.checked(source)?),
        })
    }
}
