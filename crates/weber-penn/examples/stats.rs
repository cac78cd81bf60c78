use pleach_tree::TreeStats;
fn main() {
    println!(
        "species,seed,ms,l0,l1,l2,l3,len0,len1,len2,len3,r0,r1,r2,r3,leaves,blossoms,height,wx,wy,lowest,leaf_area"
    );
    for (name, _) in pleach_tree::Family::presets(&pleach_weber_penn::WeberPennFamily) {
        let s = pleach_weber_penn::preset(name).unwrap();
        let mut ws = pleach_tree::Workspace::default();
        let mut tree = pleach_tree::Tree::default();
        for seed in 1..=20 {
            let t = std::time::Instant::now();
            s.generator.grow(&s.params, &pleach_tree::Growth::seed(seed), &mut ws, &mut tree).unwrap();
            let ms = t.elapsed().as_secs_f64() * 1e3;
            let st = TreeStats::of(&tree);
            let g = |v: &Vec<f64>, i: usize| v.get(i).copied().unwrap_or(0.0);
            let c = |i: usize| st.stems.get(i).copied().unwrap_or(0);
            println!(
                "{name},{seed},{ms:.2},{},{},{},{},{:.3},{:.3},{:.3},{:.3},{:.4},{:.4},{:.4},{:.4},{},{},{:.3},{:.3},{:.3},{:.3},{:.3}",
                c(0),
                c(1),
                c(2),
                c(3),
                g(&st.length_mean_m, 0),
                g(&st.length_mean_m, 1),
                g(&st.length_mean_m, 2),
                g(&st.length_mean_m, 3),
                g(&st.radius_mean_m, 0),
                g(&st.radius_mean_m, 1),
                g(&st.radius_mean_m, 2),
                g(&st.radius_mean_m, 3),
                st.leaves,
                st.blossoms,
                st.height_m,
                st.crown_width_x_m,
                st.crown_width_y_m,
                st.lowest_branch_m,
                st.leaf_area_m2
            );
        }
    }
}
