//! Files that were cut, changed or forged.

use super::*;
use crate::method::{Hewitt, HewittSettings, Start};
use crate::problem::{Genome, Score, Scored};

fn sample() -> Checkpoint<Hewitt> {
    let mut search =
        SearchState::new(Hewitt::new(HewittSettings::default(), 7, Start::Random), &Start::Random);
    let genome =
        Genome { nuisances: vec![40.0 / 3.0], ..Genome::new(vec![0.1 + 0.2, -0.0, 1e-300], u64::MAX) };
    search.best = Some(Scored {
        genome,
        score: Score { cost: f64::INFINITY, iou: 1.0 / 3.0, ..Score::from_cost(0.0) },
    });
    let fingerprint = Fingerprint::named("palm-trees/hewitt").with("goal", &1).with("settings", &2);
    Checkpoint { fingerprint, search, history: Vec::new(), elapsed_s: 0.3, before_search_s: 0.1 }
}

#[test]
fn what_is_written_comes_back_exactly() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let sample = sample();
    for _ in 0..2 {
        sample.write(&path).unwrap();
    }
    let back = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap();
    assert_eq!(back, sample);
    let zero = back.search.best.unwrap().genome.values[1];
    assert!(zero == 0.0 && zero.is_sign_negative());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
}

#[test]
fn every_way_to_cut_or_change_it_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let sample = sample();
    sample.write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
        assert!(
            matches!(error, CheckpointError::NotACheckpoint { .. } | CheckpointError::WrongLength { .. }),
            "{length}: {error}"
        );
    }
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 4;
        fs::write(&path, damaged).unwrap();
        assert!(Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).is_err(), "byte {at}");
    }
}

#[test]
#[cfg(unix)]
fn links_under_the_temporary_name_are_not_followed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, victim) = (folder.path().join("checkpoint"), folder.path().join("victim"));
    fs::write(&victim, "precious").unwrap();
    std::os::unix::fs::symlink(&victim, folder.path().join("checkpoint.tmp")).unwrap();
    // Nor is a link at the checkpoint's own name: it is replaced.
    std::os::unix::fs::symlink(&victim, &path).unwrap();
    sample().write(&path).unwrap();
    assert_eq!(fs::read_to_string(&victim).unwrap(), "precious");
    assert!(fs::symlink_metadata(&path).unwrap().is_file());
}

#[test]
fn what_no_run_can_have_written_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let read = |checkpoint: &Checkpoint<Hewitt>| {
        checkpoint.write(&path).unwrap();
        Checkpoint::<Hewitt>::read(&path, &checkpoint.fingerprint)
    };
    let row = Row {
        generation: 1,
        evaluations: 20,
        best_cost: 0.5,
        generation_best_cost: 0.5,
        iou: 0.5,
        accuracy: 0.5,
        likeness: None,
        elapsed_s: 0.1,
    };
    let mut good = Checkpoint { history: vec![row], ..sample() };
    good.search.generation = 1;
    good.search.evaluations = 25;
    assert_eq!(read(&good).unwrap(), good);
    let with = |change: fn(&mut Checkpoint<Hewitt>)| {
        let mut forged = good.clone();
        change(&mut forged);
        let error = read(&forged).unwrap_err();
        assert!(matches!(error, CheckpointError::WrongBody { .. }), "{error}");
        error.to_string()
    };
    assert!(with(|c| c.elapsed_s = -1.0).contains("`elapsed_s` is -1"));
    assert!(with(|c| c.elapsed_s = 1e308).contains("expected 0 to 1e10"));
    assert!(with(|c| c.before_search_s = 5.0).contains("more than `elapsed_s`"));
    assert!(with(|c| c.history.clear()).contains("0 rows for 1 generations"));
    assert!(with(|c| c.history[0].generation = 7).contains("row 1 of the history is of generation 7"));
    assert!(with(|c| c.search.evaluations = 3).contains("do not add up"));
    assert!(with(|c| c.search.best = None).contains("no best individual"));
}

#[test]
fn other_runs_versions_and_missing_files_say_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let sample = sample();
    let missing = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
    assert!(missing.to_string().contains("cannot be read"), "{missing}");
    sample.write(&path).unwrap();
    let other = Fingerprint::default().with("goal", &5).with("settings", &2);
    let error = Checkpoint::<Hewitt>::read(&path, &other).unwrap_err().to_string();
    assert!(error.ends_with("it differs in goal"), "{error}");
    // As earlier versions of pleach wrote them, and as later ones may.
    for (format, body) in [("3", " 2 00000000000000ff\n{}"), ("9", " whatever\n\u{1}")] {
        fs::write(&path, format!("pleach-checkpoint {format}{body}")).unwrap();
        let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
        assert!(matches!(&error, CheckpointError::OtherFormat { found, .. } if found == format), "{error}");
        let error = error.to_string();
        assert!(error.contains("reads format 6") && error.contains("or start over"), "{error}");
    }
    let nowhere = folder.path().join("no/such/folder");
    assert!(matches!(sample.write(&nowhere), Err(CheckpointError::Io { .. })));
}

#[test]
fn the_header_says_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    sample().write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let header = bytes.split(|&byte| byte == b'\n').next().unwrap();
    let header = std::str::from_utf8(header).unwrap();
    assert!(header.starts_with("pleach-checkpoint 6 palm-trees/hewitt "), "{header}");
}

/// Bodies that were forged, checksum and all: errors or states, never panics and never much memory.
#[test]
fn forged_bodies_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let sample = sample();
    let body = postcard::to_stdvec(&sample).unwrap();
    let mut refused = 0;
    for at in 0..body.len() {
        for byte in [0, 1, 0x7f, 0x80, 0xff] {
            let mut forged = body.clone();
            forged[at] = byte;
            fs::write(&path, envelope::sealed("x", &forged)).unwrap();
            refused += usize::from(Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).is_err());
        }
        fs::write(&path, envelope::sealed("x", &body[..at])).unwrap();
        let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
        assert!(matches!(error, CheckpointError::WrongBody { .. }), "{at}: {error}");
    }
    assert!(refused > body.len(), "{refused} of {}", 5 * body.len());
    // Lists that say they are longer than any memory.
    let endless = [&[0xff; 9][..], &[0x01], &body].concat();
    fs::write(&path, envelope::sealed("x", &endless)).unwrap();
    assert!(Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).is_err());
    fs::write(&path, envelope::sealed("x", &[&body[..], b"more"].concat())).unwrap();
    let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err().to_string();
    assert!(error.ends_with("4 bytes too many"), "{error}");
}
