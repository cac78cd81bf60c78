//! The generator: a parameter space, what trees are pruned against, and growing.

use crate::grow::{Scratch, grow};
use crate::model::Model;
use crate::params::space;
use crate::solid::{Solid, Surroundings};
use pleach_tree::{CheckedParams, Generator, GrowError, Growth, ParamSpace, Tree, Workspace};

/// Weber and Penn's model, with the surroundings that its trees are pruned against.
#[derive(Clone, Debug, Default)]
pub struct WeberPenn {
    /// What pruning tests points against.
    pub surroundings: Surroundings,
}

impl Generator for WeberPenn {
    fn family(&self) -> &'static str {
        "weber-penn"
    }

    fn space(&self) -> &ParamSpace {
        space()
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let model = Model::new(params.values());
        grow(&model, &self.surroundings, growth, workspace.scratch::<Scratch>(), tree)
    }

    fn reads(&self, values: &[f64], slot: usize) -> bool {
        let model = Model::new(values);
        let slot_of = space().slots()[slot];
        reads(&model, &self.surroundings, &space().params()[slot_of.param].name, slot_of.index)
    }

    fn regimes(&self, slot: usize) -> &'static [f64] {
        match space().param_of(slot).name.as_ref() {
            "taper" => &[1.0, 2.0],
            "branch_dist" => &[1.0],
            _ => &[],
        }
    }

    fn plausible(&self, slot: usize) -> (f64, f64) {
        let (low, high) = space().search_range(slot);
        let most = match space().param_of(slot).name.as_ref() {
            // Above it stems are pipes with round ends and strings of beads.
            "taper" => 1.0,
            // Half a metre is a large leaf; fronds of palms and fans are longer, where a fit starts there.
            "leaf_scale" => 0.5,
            _ => high,
        };
        (low, high.min(most))
    }

    fn redeals(&self, slot: usize) -> bool {
        let param = space().param_of(slot);
        let feeds_counts = matches!(param.name.as_ref(), "base_size" | "branch_dist" | "seg_splits");
        param.kind.is_whole() || feeds_counts || param.name == "rotate"
    }

    fn size_variations(&self, values: &[f64]) -> Vec<usize> {
        // Several trunks show them: no two are of one size.
        if Model::new(values).trunks > 1 {
            return Vec::new();
        }
        let first = |name| Some(space().slots_of(space().find(name)?.0).start);
        ["g_scale_v", "length_v"].into_iter().filter_map(first).collect()
    }

    fn extra_toml(&self) -> String {
        let mut text = String::new();
        if let Some(inside) = &self.surroundings.inside {
            text.push_str(&format!("prune_inside = {}\n", Solid::write_list(inside)));
        }
        if !self.surroundings.obstacles.is_empty() {
            text.push_str(&format!(
                "prune_obstacles = {}\n",
                Solid::write_list(&self.surroundings.obstacles)
            ));
        }
        text
    }
}

/// Whether number `index` of parameter `name` can change a tree of this model.
fn reads(model: &Model, surroundings: &Surroundings, name: &str, index: usize) -> bool {
    let levels = model.level_count;
    let level = &model.levels[index];
    let has_stems = index < levels;
    let forks = level.seg_splits > 0.0 || (index == 0 && model.base_splits != 0);
    let has_leaves = levels > 1 && model.leaf_blos_num != 0.0;
    // Leaves use the level after the deepest, at most the last.
    let places_children = index > 0 && (index < levels || (has_leaves && index == levels.min(3)));
    let fan = if index < levels { level.branches < 0.0 } else { model.leaf_blos_num < 0.0 };
    let custom = model.shape == 8;
    let prunes = model.prune.ratio > 0.0;
    let envelope = prunes && surroundings.inside.is_none();
    match name {
        "shape" | "ratio_power" => levels > 1,
        "floor_splits" | "g_scale" | "g_scale_v" | "levels" | "ratio" | "flare" => true,
        "base_splits" => !model.levels[0].is_helix(),
        "base_size" => has_stems,
        "down_angle" | "down_angle_v" | "rotate" | "rotate_v" => places_children,
        "branches" => index < levels,
        "branch_dist" => places_children && !(fan && index + 1 > levels),
        "length" => has_stems,
        "length_v" => has_stems,
        "taper" | "curve_res" | "curve_v" | "radius_mod" => has_stems,
        "seg_splits" | "curve" | "curve_back" | "bend_v" => has_stems && !level.is_helix(),
        "split_angle" | "split_angle_v" => has_stems && forks && !level.is_helix(),
        "tropism" => index < 2 || levels > 2,
        "leaf_shape" | "leaf_scale" | "leaf_scale_x" => has_leaves && model.blossom_rate < 1.0,
        "leaf_bend" | "blossom_rate" => has_leaves,
        "blossom_shape" | "blossom_scale" => has_leaves && model.blossom_rate > 0.0,
        "leaf_blos_num" => levels > 1,
        "prune_ratio" => true,
        "prune_width" => envelope,
        "prune_width_peak" | "prune_power_low" | "prune_power_high" => envelope || (custom && levels > 1),
        _ => true,
    }
}
