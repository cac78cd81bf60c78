//! The species files that come with pleach, compiled in: an installed program needs no checkout.
//!
//! Each list is one folder, a generator's or that of [`NATURAL`] species: of each file its name and its text. A file that is put into a folder is added
//! to the list here, at the place where it is to be shown.
//!
//! ```
//! let (name, text) = pleach_species::FRACTAL[0];
//! assert!(text.contains(&format!("name = \"{name}\"")) && text.contains("generator = \"fractal\""));
//! ```

/// Name and text of each file of a folder beside this file.
macro_rules! files {
    ($folder:literal: $($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!($folder, "/", $name, ".toml")))),*]
    };
}

/// Species of Weber and Penn's generator, as the dissertation of Hewitt orders them; then others.
pub const WEBER_PENN: &[(&str, &str)] = files!["weber-penn":
    "quaking_aspen",
    "weeping_willow",
    "bamboo",
    "palm",
    "lombardy_poplar",
    "small_pine",
    "acer",
    "silver_birch",
    "douglas_fir",
    "apple",
    "black_tupelo",
    "black_oak",
    "european_larch",
    "hill_cherry",
    "balsam_fir",
    "cambridge_oak",
    "fan_palm",
    "sassafras",
    "sphere_tree",
    "weeping_willow_o",
];

/// Grammars.
pub const LSYSTEM: &[(&str, &str)] = files!["lsystem":
    "hewitt_palm",
    "hewitt_lombardy_poplar",
    "hewitt_quaking_aspen",
    "aspen_falling_profile",
    "grammar_pine",
    "grammar_acer",
    "steen_tree",
    "abop_monopodial_a",
    "abop_monopodial_b",
    "abop_monopodial_c",
    "abop_monopodial_d",
    "abop_sympodial_a",
    "abop_sympodial_b",
    "abop_sympodial_c",
    "abop_sympodial_d",
    "abop_ternary_a",
    "abop_ternary_b",
    "abop_ternary_c",
    "abop_ternary_d",
    "abop_plant_a",
    "abop_plant_b",
    "abop_plant_c",
    "abop_plant_d",
    "abop_plant_e",
    "abop_plant_f",
    "abop_plant_stochastic",
    "abop_bush",
    "abop_flowering_plant",
    "abop_hilbert",
    "abop_hilbert_space",
    "abop_sierpinski",
    "abop_gosper",
    "abop_dragon",
    "abop_koch_island",
    "abop_row_of_trees",
];

/// Fractal trees.
pub const FRACTAL: &[(&str, &str)] = files!["fractal":
    "coffey_umbrella",
    "coffey_fan",
    "coffey_turned_crown",
    "coffey_winter_oak",
    "coffey_pine",
    "coffey_turned_fork",
    "coffey_long_arms",
    "coffey_whorls",
    "coffey_young_tree",
    "coffey_old_tree",
];

/// Trees of least-cost paths.
pub const LEAST_COST_PATH: &[(&str, &str)] = files!["least-cost-path":
    "fan_elm",
    "vase_elm",
    "weeping_crown",
    "forked_apple",
    "mop_shrub",
    "drooping_spruce",
    "leaning_pine",
    "spreading_oak",
    "tiered_fir",
    "broom_shrub",
    "upright_cypress",
    "young_larch",
    "round_maple",
    "oval_hornbeam",
    "tufted_acacia",
    "taproot_elm",
    "shallow_root_oak",
    "tilted_tree",
    "leafy_elm",
    "leafy_maple",
    "leafy_conifer",
    "leafy_oak",
    "leafy_willow",
];

/// Trees that fill a volume.
pub const SPACE_COLONIZATION: &[(&str, &str)] = files!["space-colonization":
    "english_oak",
    "field_elm",
    "common_ash",
    "field_maple",
    "old_olive",
    "velvet_mesquite",
    "umbrella_acacia",
    "scots_pine",
    "lebanon_cedar",
    "weeping_beech",
    "common_hawthorn",
    "multi_stem_birch",
    "caucasian_fir",
];

/// Species of Weber and Penn's generator with leaves of natural size, which are of no family's list: they have four to ten
/// times as many leaves as others of their kind, and in a silhouette of a few hundred pixels they show no more.
pub const NATURAL: &[(&str, &str)] = files!["natural":
    "natural_aspen",
    "natural_oak",
    "natural_maple",
    "natural_larch",
];

/// Stylised trees.
pub const STYLISED: &[(&str, &str)] = files!["stylised":
    "stylised_oak",
    "stylised_round",
    "stylised_birch",
    "stylised_cherry",
    "stylised_bonsai",
    "stylised_baobab",
    "stylised_poplar",
    "stylised_willow",
    "stylised_dead",
    "stylised_twins",
    "stylised_spruce",
    "stylised_palm",
    "stylised_bush",
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    #[test]
    fn every_file_of_a_folder_is_in_its_list() {
        let lists = [
            ("fractal", super::FRACTAL),
            ("least-cost-path", super::LEAST_COST_PATH),
            ("lsystem", super::LSYSTEM),
            ("natural", super::NATURAL),
            ("space-colonization", super::SPACE_COLONIZATION),
            ("stylised", super::STYLISED),
            ("weber-penn", super::WEBER_PENN),
        ];
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        for (folder, list) in lists {
            let files = std::fs::read_dir(here.join(folder)).unwrap();
            let files = files.map(|file| file.unwrap().file_name().into_string().unwrap());
            let listed = list.iter().map(|(name, _)| format!("{name}.toml"));
            assert_eq!(files.collect::<BTreeSet<_>>(), listed.collect(), "{folder}");
        }
        let folders =
            std::fs::read_dir(here).unwrap().filter(|entry| entry.as_ref().unwrap().path().is_dir());
        assert_eq!(folders.count(), lists.len());
    }
}
