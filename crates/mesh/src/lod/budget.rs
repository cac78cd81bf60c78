//! Levels of so many triangles.
//!
//! What a level spends its triangles on: leaves as they are, as long as they fit; then leaves of fewer triangles, and
//! then pairs of leaves drawn as one, which is no leaf of more than 1.5 times its size; and below that cards, each of
//! which shows the picture of a twig with its leaves. With cards the thin stems go, since the pictures show them. Bark
//! gets the finest tolerance that is left to pay for.

use super::cards;
use super::groups::Hangs;
use super::ink::Ink;
use super::merge::merge;
use super::stems::Kept;
use super::{Level, blobs};
use crate::foliage::UnitMesh;
use crate::mesher::Mesher;
use crate::settings::{LeafStyle, MeshSettings};
use crate::twigs::{Sheet, Twigs};
use pleach_plant::{Leaf, Parts, Tree};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::{Range, RangeInclusive};

/// Budgets that a level may have, in triangles.
pub const BUDGETS: RangeInclusive<u32> = 200..=20_000_000;
/// Part of a budget that is kept for bark, if bark needs it, while it is decided how leaves are drawn.
const BARK: f64 = 0.3;
/// Part of a budget that bark may take beside cards.
const BARK_BESIDE_CARDS: f64 = 0.35;
/// The same of trees without leaves: a twig alone is better drawn than shown.
const BARK_OF_BARE_TREES: f64 = 0.7;
/// The same where the coarsest bark takes more.
const BARK_AT_MOST: f64 = 0.8;
/// How much finer bark may get than the settings say, to use what is left of a budget.
const FINER: f64 = 16.0;
/// Most leaves that are drawn as one: their size grows by the root of this.
const RUN: f64 = 2.0;
/// The same of leaves that have more than two triangles: there are simpler ones.
const FEW: f64 = 1.25;
/// Stems thinner than this part of the tolerance go.
const THIN: f64 = 0.2;
/// The same beside cards, which show thin stems.
const THIN_BESIDE_CARDS: f64 = 0.5;
/// Halvings of the range in which a tolerance is looked for.
const STEPS: u32 = 14;
/// Coarsest tolerance of bark, in metres.
const COARSEST: f64 = 1.0;

/// A budget that a tree cannot be drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the tree does not fit into a level of {asked} triangles: it has {fewest} at the least")]
pub struct TooFew {
    /// The budget.
    pub asked: u32,
    /// The fewest triangles that the tree can be drawn with.
    pub fewest: u64,
}

/// Levels of each of `trees`, one for each of `budgets`, in triangles: never more than that, and less only by the little
/// that no part fits into, or where the tree at its finest, as of `settings`, has fewer. How leaves are drawn is chosen
/// here, unless `settings` has none at all. Cards of one level show the twigs of one tree, and those of all levels share
/// one picture.
///
/// ```
/// use pleach_mesh::{MeshSettings, lod};
///
/// let tree = pleach_generators::species("quaking_aspen")?.grow(1)?;
/// let levels = &lod::budgets(&[&tree], MeshSettings::default(), &[30_000, 2_000])?[0];
/// let triangles: Vec<u64> = levels.iter().map(|level| level.mesher().count().triangles).collect();
/// assert!((25_500..=30_000).contains(&triangles[0]) && (1_700..=2_000).contains(&triangles[1]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TooFew`] for the first budget that is too small for a tree.
pub fn budgets<'a>(
    trees: &[&'a Tree],
    settings: MeshSettings,
    budgets: &[u32],
) -> Result<Vec<Vec<Level<'a>>>, TooFew> {
    let of_tree = |tree: &&'a Tree| {
        let ink = OnceCell::new();
        budgets.iter().map(|&budget| level(tree, settings, budget, &ink)).collect()
    };
    let mut levels = trees.iter().map(of_tree).collect::<Result<Vec<Vec<Level<'a>>>, TooFew>>()?;
    let mut cells = 0;
    for level in 0..budgets.len() {
        let mut shared: Option<Twigs> = None;
        for twigs in levels.iter_mut().filter_map(|levels| levels[level].twigs.as_mut()) {
            match &shared {
                Some(shared) => twigs.show(shared),
                None => {
                    twigs.first_cell = cells;
                    cells += twigs.models.len();
                    shared = Some(Twigs { cards: Vec::new(), ..twigs.clone() });
                }
            }
        }
    }
    let sheet = Sheet::with_room(cells);
    let all = levels.iter_mut().flatten().filter_map(|level| level.twigs.as_mut());
    all.for_each(|twigs| twigs.sheet = sheet);
    Ok(levels)
}

/// The twigs to paint for the cards of `levels`, which [`budgets`] made of `trees`, each with the tree that it is of.
pub fn painted<'l>(
    trees: &'l [&'l Tree],
    levels: &'l [Vec<Level<'_>>],
) -> impl Iterator<Item = (&'l Tree, &'l Twigs)> {
    let count = levels.first().map_or(0, Vec::len);
    (0..count).filter_map(move |level| {
        trees.iter().zip(levels).find_map(|(tree, levels)| Some((*tree, levels[level].twigs.as_ref()?)))
    })
}

/// A level of at most so many triangles; `ink` is what the tree covers, once that was asked for.
fn level<'a>(
    tree: &'a Tree,
    settings: MeshSettings,
    budget: u32,
    ink: &OnceCell<Ink>,
) -> Result<Level<'a>, TooFew> {
    let settings = settings.clamped();
    let whole = Mesher::new(tree, settings).count().triangles;
    if whole <= u64::from(budget) {
        return Ok(Level { whole: tree, tree: Cow::Borrowed(tree), settings, twigs: None });
    }
    let mut bark = Bark::new(tree, settings);
    let for_bark = bark.finest().min((BARK * f64::from(budget)) as u64);
    let for_leaves = u64::from(budget) - for_bark;
    let has_blobs =
        settings.parts.contains(Parts::BLOBS) && settings.leaves != LeafStyle::None && !tree.blobs.is_empty();
    if has_blobs {
        return with_blobs(tree, &mut bark, for_leaves, budget);
    }
    let styles = leaf_styles(tree, settings, for_leaves);
    let leafy = styles.into_iter().find_map(|(style, run)| with_leaves(tree, &mut bark, style, run, budget));
    leafy.map_or_else(|| with_cards(tree, &mut bark, budget, ink), Ok)
}

/// The styles in which leaves can have at most so many triangles, the finest first, and how many leaves are then drawn
/// as one.
fn leaf_styles(tree: &Tree, settings: MeshSettings, most: u64) -> Vec<(LeafStyle, f64)> {
    if settings.leaves == LeafStyle::None {
        return vec![(LeafStyle::None, 1.0)];
    }
    let styles = [(LeafStyle::Outline, FEW), (LeafStyle::Reduced, FEW), (LeafStyle::Simple, RUN)];
    let has_place = |(style, _): &(LeafStyle, f64)| !settings.pictured || style.pictured() == *style;
    let pictures = settings.pictured.then_some((LeafStyle::Card, RUN));
    let styles = styles.into_iter().filter(has_place).chain(pictures);
    let fitting = styles.filter_map(|(style, most_run)| {
        let run =
            leaf_triangles(tree, MeshSettings { leaves: style, ..settings }) as f64 / most.max(1) as f64;
        (run <= most_run).then_some((style, run.max(1.0)))
    });
    fitting.collect()
}

fn leaf_triangles(tree: &Tree, settings: MeshSettings) -> u64 {
    let of = |leaves: &[Leaf], shapes: &[UnitMesh]| -> u64 {
        leaves.iter().map(|leaf| shapes[usize::from(leaf.shape)].count().triangles).sum()
    };
    let style = settings.leaves;
    let leaves: Vec<_> = tree.leaf_shapes.iter().map(|shape| UnitMesh::leaf(shape, style)).collect();
    let blossoms: Vec<_> = tree.blossom_shapes.iter().map(|&shape| UnitMesh::blossom(shape, style)).collect();
    let has = |part, count: u64| if settings.parts.contains(part) { count } else { 0 };
    has(Parts::LEAVES, of(&tree.leaves, &leaves)) + has(Parts::BLOSSOMS, of(&tree.blossoms, &blossoms))
}

/// All stems, and every leaf or every few leaves as one; `None` where that would leave bark too coarse.
fn with_leaves<'a>(
    tree: &'a Tree,
    bark: &mut Bark<'a>,
    style: LeafStyle,
    run: f64,
    budget: u32,
) -> Option<Level<'a>> {
    let settings = MeshSettings { leaves: style, min_sides: 3, ..bark.settings };
    let mut coarse = tree.clone();
    merge(&mut coarse.leaves, run);
    merge(&mut coarse.blossoms, run);
    let for_bark = u64::from(budget).saturating_sub(leaf_triangles(&coarse, settings));
    let finest = bark.settings.tolerance;
    let all = Kept::new(tree, 0.0);
    let (tolerance, _) = bark.within(for_bark, finest / FINER..10.0 * finest, |_| all.clone())?;
    Some(Level {
        whole: tree,
        tree: Cow::Owned(coarse),
        settings: MeshSettings { tolerance, ..settings },
        twigs: None,
    })
}

/// Closed surfaces of foliage with fewer triangles, and the stems that are thick enough.
fn with_blobs<'a>(
    tree: &'a Tree,
    bark: &mut Bark<'a>,
    for_blobs: u64,
    budget: u32,
) -> Result<Level<'a>, TooFew> {
    let mut coarse = tree.clone();
    blobs::reduce(&mut coarse, for_blobs as usize);
    let blobs = coarse.blob_triangles.len() as u64;
    let style = if bark.settings.pictured { LeafStyle::Card } else { LeafStyle::Simple };
    let settings = MeshSettings { min_sides: 3, leaves: style, ..bark.settings };
    let leaves = leaf_triangles(tree, settings);
    if leaves > 0 {
        let run = leaves as f64 / for_blobs.saturating_sub(blobs).max(1) as f64;
        merge(&mut coarse.leaves, run);
        merge(&mut coarse.blossoms, run);
    }
    let foliage = blobs + leaf_triangles(&coarse, settings);
    let for_bark = u64::from(budget).saturating_sub(foliage);
    let thick = |tolerance: f64| Kept::new(tree, THIN * tolerance);
    let fitted = bark.within(for_bark, bark.settings.tolerance / FINER..COARSEST, thick);
    let (tolerance, kept) = fitted.ok_or_else(|| bark.too_few(budget, foliage))?;
    kept.thin(&mut coarse);
    Ok(Level {
        whole: tree,
        tree: Cow::Owned(coarse),
        settings: MeshSettings { tolerance, ..settings },
        twigs: None,
    })
}

/// The thick stems, and cards for all others and the leaves.
fn with_cards<'a>(
    tree: &'a Tree,
    bark: &mut Bark<'a>,
    budget: u32,
    ink: &OnceCell<Ink>,
) -> Result<Level<'a>, TooFew> {
    let finest = bark.settings.tolerance;
    let is_bare = leaf_triangles(tree, MeshSettings { leaves: LeafStyle::Simple, ..bark.settings }) == 0
        || bark.settings.leaves == LeafStyle::None;
    let part = if is_bare { BARK_OF_BARE_TREES } else { BARK_BESIDE_CARDS };
    let mut thin = THIN_BESIDE_CARDS;
    // Every stem that is drawn has cards of its own, so that fewer cards may need fewer stems.
    let (tolerance, kept, groups) = loop {
        let thick = |tolerance: f64| Kept::new(tree, thin * tolerance);
        let mut within = |part: f64| bark.within((part * f64::from(budget)) as u64, finest..COARSEST, thick);
        let fitted = within(part).or_else(|| within(BARK_AT_MOST));
        let (tolerance, kept) = fitted.ok_or_else(|| bark.too_few(budget, 0))?;
        let room = (u64::from(budget) - bark.count(tolerance, &kept)) as usize / 2;
        let groups = Hangs::new(tree, &kept, bark.settings).groups(room);
        if groups.len() <= room {
            break (tolerance, kept, groups);
        }
        if kept.is_one() {
            return Err(bark.too_few(budget, 2 * groups.len() as u64));
        }
        thin *= 2.0;
    };
    // Where there are fewer twigs than there is room for, bark has the rest.
    let rest = u64::from(budget) - 2 * groups.len() as u64;
    let finer = bark.within(rest, finest / FINER..tolerance, |_| kept.clone());
    let tolerance = finer.map_or(tolerance, |(finer, _)| finer);
    let mut twigs = cards::twigs(tree, &Hangs::new(tree, &kept, bark.settings), &groups, &kept.number);
    let coarse = Tree { stems: kept.stems(tree), knots: tree.knots.clone(), ..Tree::default() };
    let settings = MeshSettings { tolerance, min_sides: 3, leaves: LeafStyle::None, ..bark.settings };
    let ink = ink.get_or_init(|| Ink::new(tree, bark.settings));
    ink.fit(&mut twigs, tree, &Mesher::new(&coarse, settings));
    Ok(Level {
        whole: tree,
        tree: Cow::Owned(coarse),
        settings,
        twigs: (!twigs.cards.is_empty()).then_some(twigs),
    })
}

/// The stems of a tree, counted at one tolerance after the other.
struct Bark<'a> {
    tree: &'a Tree,
    settings: MeshSettings,
    /// The knots, with some of the stems.
    bare: Tree,
}

impl<'a> Bark<'a> {
    fn new(tree: &'a Tree, settings: MeshSettings) -> Self {
        Self { tree, settings, bare: Tree { knots: tree.knots.clone(), ..Tree::default() } }
    }

    fn finest(&mut self) -> u64 {
        self.count(self.settings.tolerance, &Kept::new(self.tree, 0.0))
    }

    fn count(&mut self, tolerance: f64, kept: &Kept) -> u64 {
        self.bare.stems = kept.stems(self.tree);
        let settings = MeshSettings { tolerance, min_sides: 3, ..self.settings };
        Mesher::new(&self.bare, settings).count().triangles
    }

    /// Stems of at most so many triangles: the finest tolerance in `range`, in metres, that gives them, and what is then
    /// kept.
    fn within(&mut self, most: u64, range: Range<f64>, keep: impl Fn(f64) -> Kept) -> Option<(f64, Kept)> {
        let mut fits = |tolerance: f64| {
            let kept = keep(tolerance);
            (self.count(tolerance, &kept) <= most).then_some((tolerance, kept))
        };
        let mut best = fits(range.end)?;
        let (mut low, mut high) = (range.start, range.end);
        for _ in 0..STEPS {
            let middle = (low * high).sqrt();
            match fits(middle) {
                Some(finer) => (best, high) = (finer, middle),
                None => low = middle,
            }
        }
        Some(best)
    }

    /// The error of a budget that the coarsest stems are too many for, beside so many other triangles.
    fn too_few(&mut self, asked: u32, others: u64) -> TooFew {
        let fewest = self.count(COARSEST, &Kept::new(self.tree, f64::INFINITY));
        TooFew { asked, fewest: (fewest as f64 / BARK_AT_MOST).ceil() as u64 + others }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(name: &str, all: &[u32]) -> Vec<u64> {
        let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        let levels = budgets(&[&tree], MeshSettings::default(), all).unwrap().remove(0);
        levels.iter().for_each(|level| level.tree.well_formed().unwrap());
        levels.iter().map(|level| level.mesher().count().triangles).collect()
    }

    #[test]
    fn levels_keep_to_their_budgets() {
        for name in ["acer", "hill_cherry", "stylised_oak", "fan_elm"] {
            let asked = [30_000, 8_000, 2_000];
            let whole = triangles(name, &[u32::MAX])[0];
            for (budget, found) in asked.into_iter().zip(triangles(name, &asked)) {
                let least = (f64::from(budget) * 0.85).min(whole as f64) as u64;
                assert!((least..=u64::from(budget)).contains(&found), "{name} {budget}: {found} of {whole}");
            }
        }
    }

    #[test]
    fn what_is_finer_than_there_is_is_the_tree_as_it_is() {
        let tree = pleach_generators::preset("palm").unwrap().grow(1).unwrap();
        let levels = budgets(&[&tree], MeshSettings::default(), &[1_000_000]).unwrap().remove(0);
        assert!(*levels[0].tree == tree && levels[0].twigs.is_none());
    }

    #[test]
    fn leaves_hardly_grow() {
        let tree = pleach_generators::preset("acer").unwrap().grow(1).unwrap();
        let largest = |tree: &Tree| tree.leaves.iter().map(|leaf| leaf.along.length()).fold(0.0, f32::max);
        let all = [40_000, 20_000, 10_000, 6_000];
        for level in budgets(&[&tree], MeshSettings::default(), &all).unwrap().remove(0) {
            assert!(largest(&level.tree) <= 1.5 * largest(&tree));
        }
    }

    #[test]
    fn a_budget_below_the_trunks_is_an_error() {
        let tree = pleach_generators::preset("acer").unwrap().grow(1).unwrap();
        let error = budgets(&[&tree], MeshSettings::default(), &[10]).unwrap_err();
        assert_eq!(error.asked, 10);
        let again = budgets(&[&tree], MeshSettings::default(), &[error.fewest as u32]);
        assert!(again.is_ok(), "{error}");
    }

    /// Roots are not asked for, and leaves are left out.
    #[test]
    fn cards_show_what_is_drawn() {
        let tree = pleach_generators::preset("stylised_dead").unwrap().grow(1).unwrap();
        assert!(tree.stems.iter().any(|stem| stem.kind == pleach_plant::StemKind::Root));
        let shown = |tree: &Tree, settings| -> Vec<_> {
            let levels = budgets(&[tree], settings, &[800]).unwrap().remove(0);
            levels.into_iter().filter_map(|level| level.twigs).flat_map(|twigs| twigs.models).collect()
        };
        for model in shown(&tree, MeshSettings::default()) {
            let is_root = |i: &u32| tree.stems[*i as usize].kind == pleach_plant::StemKind::Root;
            assert!(!model.stems.iter().any(is_root));
        }
        let acer = pleach_generators::preset("acer").unwrap().grow(1).unwrap();
        let models = shown(&acer, MeshSettings { leaves: LeafStyle::None, ..MeshSettings::default() });
        assert!(!models.is_empty() && models.iter().all(|model| model.leaves.is_empty()));
    }

    #[test]
    fn trees_of_a_forest_show_the_twigs_of_one() {
        let species = pleach_generators::preset("quaking_aspen").unwrap();
        let grown = [1, 2, 3].map(|seed| species.grow(seed).unwrap());
        let trees = grown.each_ref();
        let levels = budgets(&trees, MeshSettings::default(), &[8_000, 2_000]).unwrap();
        let twigs = |tree: usize, level: usize| levels[tree][level].twigs.as_ref().unwrap();
        for level in 0..2 {
            for tree in 0..3 {
                let own = twigs(tree, level);
                assert_eq!((own.first_cell, own.sheet), (twigs(0, level).first_cell, twigs(0, 0).sheet));
                assert!(own.models == twigs(0, level).models);
                assert!(own.cards.iter().all(|card| usize::from(card.shape) < own.models.len()));
            }
        }
        assert!(twigs(0, 1).first_cell > 0);
        let painted: Vec<_> = painted(&trees, &levels).collect();
        assert!(painted.len() == 2 && painted.iter().all(|(tree, _)| **tree == grown[0]));
    }
}
