//! What a file holds where the options leave it open.

use super::forms::LeafForm;
use super::options::Export;
use pleach_mesh::write::Format;

/// Pixels a side of pictures.
const SIDE: u32 = 1024;

impl Export {
    /// The budget of a GLB file in triangles, where no option says how finely the tree is drawn: that of a tree which
    /// stands near in a game.
    pub const USUAL_TRIANGLES: u32 = 50_000;

    /// Whether the file has [`Export::USUAL_TRIANGLES`], and not what an option says.
    pub(super) fn has_usual_budget(&self, format: Format) -> bool {
        let is_open = !self.finest
            && self.lod.is_none()
            && self.triangles.is_empty()
            && self.tolerance.is_none()
            && self.weld.is_none()
            && !self.sway
            && matches!(self.leaves, None | Some(LeafForm::None));
        is_open && format == Format::Glb
    }

    /// These options with all that they leave open filled in.
    pub(super) fn completed(&self, format: Format) -> Self {
        let mut export = self.clone();
        if self.has_usual_budget(format) {
            export.triangles = vec![Self::USUAL_TRIANGLES];
        }
        if format == Format::Glb && !self.finest && (self.weld.is_none() || !self.triangles.is_empty()) {
            export.textures = self.textures.or(Some(SIDE));
        }
        export
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_says_how_finely_a_tree_is_drawn_takes_the_place_of_the_budget() {
        let usual = |change: fn(&mut Export)| {
            let mut export = Export::default();
            change(&mut export);
            assert_eq!(export.check(Format::Glb), Ok(()));
            let completed = export.completed(Format::Glb);
            (completed.triangles == [Export::USUAL_TRIANGLES], completed.side())
        };
        assert_eq!(usual(|_| ()), (true, Some(1024)));
        assert_eq!(usual(|e| e.leaves = Some(LeafForm::None)), (true, Some(1024)));
        assert_eq!(usual(|e| (e.wind, e.billboard) = (true, 2)), (true, Some(1024)));
        assert_eq!(usual(|e| e.level = Some(0)), (true, Some(1024)));
        assert_eq!(usual(|e| e.textures = Some(512)), (true, Some(512)));
        assert_eq!(usual(|e| e.textures = Some(0)), (true, None));
        assert_eq!(usual(|e| e.lod = Some(1)), (false, Some(1024)));
        assert_eq!(usual(|e| e.triangles = vec![900]), (false, Some(1024)));
        assert_eq!(usual(|e| e.tolerance = Some(2.0)), (false, Some(1024)));
        assert_eq!(usual(|e| e.leaves = Some(LeafForm::Outline)), (false, Some(1024)));
        assert_eq!(usual(|e| e.sway = true), (false, Some(1024)));
        assert_eq!(usual(|e| e.weld = Some(30.0)), (false, None));
        assert_eq!(usual(|e| (e.weld, e.textures) = (Some(30.0), Some(512))), (false, Some(512)));
        assert_eq!(usual(|e| (e.weld, e.triangles) = (Some(30.0), vec![900])), (false, Some(1024)));
        assert_eq!(usual(|e| e.finest = true), (false, None));
        assert_eq!(usual(|e| (e.finest, e.textures) = (true, Some(512))), (false, Some(512)));
    }

    #[test]
    fn formats_for_other_programs_hold_the_whole_tree() {
        for format in Format::ALL.into_iter().filter(|format| *format != Format::Glb) {
            assert_eq!(Export::default().completed(format), Export::default(), "{format:?}");
        }
    }
}
