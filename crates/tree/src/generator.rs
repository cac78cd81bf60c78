//! What a generator promises, and how searches change its structure.
//!
//! Each sentence of [`Generator`]'s documentation, and of [`Family`](crate::Family)'s, is a check of the
//! `conformance` suite, which every family passes.

use crate::grow_error::{Conflict, GrowError};
use crate::growth::{Growth, Workspace};
use crate::leafless::Leafless;
use crate::model::ModelId;
use crate::param::{CheckedParams, ParamSpace, Slot};
use pleach_plant::Key;
use pleach_plant::Tree;
use pleach_plant::{Individual, Spread};
use std::fmt;
use std::sync::Arc;

/// What is known of how a tree stands, as seen from the front. Lengths are over its height, from the ground to the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stature {
    /// Trunks from the ground.
    pub trunks: Option<u32>,
    /// Width of the thickest trunk above its flare.
    pub thickness: Option<f64>,
    /// Lean of the trunk in degrees, positive towards +x.
    pub lean: Option<f64>,
    /// Height up to which the trunk bears nothing.
    pub bare_height: Option<f64>,
    /// Height of the first fork.
    pub first_fork: Option<f64>,
    /// How far the crown reaches towards -x and +x from the trunk's foot, at even heights from the ground to the top.
    pub crown: Option<[Vec<f64>; 2]>,
}

/// A growth model with everything settled but its numbers.
///
/// Shared between threads behind an `Arc`; cheap to call, since all memory comes from the caller.
pub trait Generator: Send + Sync + fmt::Debug {
    /// The family's name, as in `generator = "weber-penn"`.
    fn family(&self) -> &'static str;

    /// The numbers that it takes, and everything that is declared about them.
    fn space(&self) -> &Arc<ParamSpace>;

    /// Grows a tree into `tree`, whose former content is dropped and whose memory is kept.
    ///
    /// The same parameters and the same seed give the same tree, bit for bit, on any number of
    /// threads and whatever `workspace` was used for before. Stems do not depend on whether there are
    /// leaves. No tree has more parts, or takes more work, than `growth` allows.
    ///
    /// # Errors
    /// See [`GrowError`]; `tree` is then in an unspecified but valid state. Values of another space
    /// are refused ([`CheckedParams::values_in`]), and so are those that [`Generator::check`] refuses,
    /// with the same conflict.
    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError>;

    /// How far draws of single stems may lie from their own ([`Growth::draws`]) in trees of these `values`, level
    /// by level; empty where stems have no addresses.
    ///
    /// Where it is not empty, every stem of a tree has another [path](Tree::path_of), other draws of a stem change
    /// that stem and what it carries, and no other part of the tree.
    fn spreads(&self, values: &[f64]) -> Vec<Spread> {
        let _ = values;
        Vec::new()
    }

    /// The height in metres that the lengths of a [hull](pleach_plant::Hull) are over in trees of these `values`; `None`
    /// where crowns do not grow into hulls.
    fn hull_height(&self, values: &[f64]) -> Option<f64> {
        let _ = values;
        None
    }

    /// The generator without the draws that make one of its trees an individual, if it has such.
    fn kind(&self) -> Option<Arc<dyn Generator>> {
        None
    }

    /// The draws that make one of its trees an individual, if it has such.
    fn individual(&self) -> Option<&Individual> {
        None
    }

    /// The parts of a species file beside the numbers (solids, a grammar), as TOML lines that
    /// follow the parameters; empty if there are none. Two generators of a family with the same
    /// structure grow the same trees from the same numbers.
    fn structure(&self) -> String {
        String::new()
    }

    /// The structure as its author wrote it, with comments, for species files: what it reads as is
    /// [`Generator::structure`].
    fn written(&self) -> String {
        self.structure()
    }

    /// How searches may change the structure; `None` if they may not.
    fn variation(&self) -> Option<&dyn Variation> {
        None
    }

    /// What it is, apart from its numbers: the same for generators of one family with the same
    /// structure, and for no others.
    fn model(&self) -> ModelId {
        ModelId::new(self.family(), &self.structure())
    }

    /// Whether the value in `slot` can change any tree grown with these `values`, one for each slot.
    ///
    /// False for levels that a species does not have, or for the shape of blossoms at a rate of 0.
    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        let _ = (values, slot);
        true
    }

    /// The number of trunks of every tree of these `values`; `None` where seeds differ in it, or where it is not declared.
    fn trunks(&self, values: &[f64]) -> Option<u32> {
        let _ = values;
        None
    }

    /// Changes `values`, whose tree stands as `grown` says, so that their tree stands more as `wanted` does, where
    /// measures of a tree follow from single numbers. What is not known is left as it is. The new values may lie outside
    /// of their ranges.
    fn adapt(&self, values: &mut [f64], wanted: &Stature, grown: &Stature) {
        let _ = (values, wanted, grown);
    }

    /// Lists of values whose trees are those of `values` with more and smaller leaves, and of about the same
    /// silhouettes, the finest first. Empty where leaves are small already, or where the generator cannot.
    fn finer_leaves(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let _ = values;
        Vec::new()
    }

    /// Checks what no declaration of a single parameter can say: rules between the numbers.
    ///
    /// # Errors
    /// The first rule that these `values`, each allowed by its declaration, break.
    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        let _ = values;
        Ok(())
    }

    /// The number because of which no tree of these `values`, each allowed by its declaration, has leaves, if
    /// others ask for leaves: most likely a mistake. `None` where leaves grow or are not asked for.
    fn leafless(&self, values: &[f64]) -> Option<Leafless> {
        let _ = values;
        None
    }

    /// Changes `values` so that their tree grows `factor` times as large and nearly the same in all
    /// else; if that is not possible, leaves them and returns false: where the space has no
    /// [size](crate::param::Effect::Size), or one would leave its allowed range.
    ///
    /// Only nearly, since models have sizes of their own: Weber and Penn's stems are never thinner
    /// than a centimetre.
    fn resize(&self, values: &mut [f64], factor: f64) -> bool {
        let space = self.space();
        let resized = |value: f64| value * factor;
        let fits = space.sizes().all(|slot| space.check_slot(slot, resized(values[slot.index()])).is_ok());
        let can = fits && space.sizes().next().is_some();
        if can {
            space.sizes().for_each(|slot| values[slot.index()] = resized(values[slot.index()]));
        }
        can
    }

    /// Whether a tree of [resized](Generator::resize) values is, but for rounding, the same tree scaled about
    /// the origin, so that it need not be grown again to know how it looks.
    fn grows_in_proportion(&self) -> bool {
        false
    }

    /// Whether a single tree grown with these `values` shows by how much trees of other seeds are
    /// larger or smaller ([`Effect::SizeJitter`](crate::param::Effect::SizeJitter)): where it has
    /// several trunks, for example, no two of them alike.
    ///
    /// A search that has one tree's picture, and does not see the jitter in it, sets it to zero.
    fn shows_size_jitter(&self, values: &[f64]) -> bool {
        let _ = values;
        false
    }
}

/// What a family offers to searches that change the structure of a generator (a grammar) and not only
/// its numbers.
///
/// A structure is a text that the family writes and reads. Every structure that comes out of
/// [`Variation::fresh`], [`Variation::vary`] or [`Variation::cross`] is one that
/// [`Variation::generator`] takes; whether its trees grow within limits is not promised. The generators
/// of all structures that descend from one have equal parameter spaces.
///
/// The same arguments give the same structure.
pub trait Variation: Send + Sync + fmt::Debug {
    /// The structure of the generator that offers the variation.
    fn own(&self) -> String;

    /// A structure that is drawn from nothing: one that descends from [`Family::blank`](crate::Family::blank).
    fn fresh(&self, key: Key) -> String;

    /// `structure`, changed in one place or a few; the same if no change that was tried is valid.
    fn vary(&self, structure: &str, key: Key) -> String;

    /// `one` with a part of `other`; `one` if no part that was tried fits.
    fn cross(&self, one: &str, other: &str, key: Key) -> String;

    /// How long `structure` is for a reader, in words and signs.
    fn length(&self, structure: &str) -> usize;

    /// The generator with this structure; `None` if `structure` is not one.
    fn generator(&self, structure: &str) -> Option<Arc<dyn Generator>>;
}
