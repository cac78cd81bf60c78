//! What a person shows of the tree in a photograph, as it is typed.

use pleach::MaskHints;

/// A box around the tree, and points or strokes on it and beside it.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct HintArgs {
    /// All of the tree is in this box: first column, first row, columns and rows, in pixels of the photograph
    #[arg(long = "box", value_name = "X,Y,W,H", value_parser = numbers::<4>, conflicts_with = "mask_command")]
    region: Option<[u32; 4]>,
    /// A pixel of the tree: column and row, from 0; repeatable
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, conflicts_with = "mask_command")]
    include: Vec<[u32; 2]>,
    /// A pixel of something else; repeatable
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, conflicts_with = "mask_command")]
    exclude: Vec<[u32; 2]>,
    /// A picture of the photograph's size: what is painted green in it is tree, what is red is not
    #[arg(long, value_name = "FILE", conflicts_with = "mask_command")]
    strokes: Option<String>,
}

impl HintArgs {
    /// Whether nothing is shown.
    pub(super) fn is_empty(&self) -> bool {
        self.hints().is_empty()
    }

    /// What the library is told.
    pub(super) fn hints(&self) -> MaskHints {
        let Self { region, include, exclude, strokes } = self.clone();
        MaskHints { region, include, exclude, strokes }
    }
}

/// `N` whole numbers between commas.
fn numbers<const N: usize>(text: &str) -> Result<[u32; N], String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| {
        format!("expected {N} whole numbers such as {}", if N == 4 { "120,40,600,760" } else { "300,500" })
    })
}
