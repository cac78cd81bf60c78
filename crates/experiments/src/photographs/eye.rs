//! How good trees look to a person, and how well numbers agree with that.

use anyhow::{Context, bail};
use pleach_table::{Row, Table, TableError};
use std::path::{Path, PathBuf};

/// The best that a person can say; 0 is the worst.
const BEST: f64 = 5.0;

/// What a person says of the trees of a picture: 0 to 5, empty where one was not looked at.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Eye {
    pub(super) picture: String,
    /// Of the kind's own tree.
    pub(super) kind: Option<f64>,
    /// Of this very tree.
    pub(super) tree: Option<f64>,
}

/// Where they are kept.
pub(super) fn path(folder: &Path) -> PathBuf {
    folder.join("eye.csv")
}

/// What a person said of pictures called `names`; empty if nothing was written down.
pub(super) fn read(folder: &Path, names: &[String]) -> anyhow::Result<Vec<Eye>> {
    let path = path(folder);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let unreadable = || format!("cannot use {}", path.display());
    let bytes = pleach_table::load(&path).with_context(unreadable)?;
    let name = path.display().to_string();
    let table = Table::new(&name, &bytes)?;
    if let Some(other) = table.others(&["picture", "kind", "tree"]).next() {
        let other = pleach_tree::param::shown(other);
        bail!("{name}: `{other}` is not a column of scores, expected picture, kind and tree");
    }
    let picture = table.expect_column(&["picture"])?;
    let [kind, tree] = [table.column(&["kind"])?, table.column(&["tree"])?];
    let eye = |row: Row| -> Result<Eye, TableError> {
        let score = |column: Option<usize>| Ok(column.map(|at| row.number(at)).transpose()?.flatten());
        Ok(Eye { picture: row.text(picture).to_owned(), kind: score(kind)?, tree: score(tree)? })
    };
    let said: Vec<Eye> = table.rows().map(|row| eye(row?)).collect::<Result<_, _>>()?;
    for eye in &said {
        let place = || format!("{}: {}", path.display(), pleach_tree::param::shown(&eye.picture));
        if !names.contains(&eye.picture) {
            bail!("{} is not a picture of the experiment", place());
        }
        if let Some(wrong) =
            [eye.kind, eye.tree].into_iter().flatten().find(|score| !(0.0..=BEST).contains(score))
        {
            bail!("{} has the score {wrong}, expected a number from 0 to {BEST}", place());
        }
    }
    Ok(said)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_of_unknown_pictures_and_beyond_the_scale_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["oak".to_owned(), "elm".to_owned()];
        let read = |text: &str| {
            std::fs::write(path(folder.path()), text).unwrap();
            read(folder.path(), &names).map_err(|error| format!("{error:#}"))
        };
        let said = read("picture,kind,tree\noak,3,4.5\nelm,,2\n").unwrap();
        let eye = |picture: &str, kind, tree| Eye { picture: picture.to_owned(), kind, tree };
        assert_eq!(read("Picture;Kind;Tree\noak;3;4,5\nelm;;2\n").unwrap(), said);
        assert_eq!(said, [eye("oak", Some(3.0), Some(4.5)), eye("elm", None, Some(2.0))]);
        assert!(read("picture,kind,tree\nash,3,4\n").unwrap_err().contains("ash is not a picture"));
        assert!(
            read("picture,kind,tree\noak,3,6\n").unwrap_err().contains("6, expected a number from 0 to 5")
        );
        assert!(read("picture,kind,looks\noak,3,3\n").unwrap_err().contains("looks"));
        std::fs::remove_file(path(folder.path())).unwrap();
        assert_eq!(super::read(folder.path(), &names).unwrap(), []);
    }
}
