//! Run folders.

use super::reel::*;
use crate::app::export::*;
use crate::run::RunReader;

#[test]
fn a_run_folder_has_the_frames_bit_for_bit() {
    let folder = folder();
    let to = folder.path().join("run");
    let reel = Reel::new(5);
    let wanted = reel.frames[&3].clone();
    assert_eq!(done(request(ExportKind::Run { first: 2, last: 4 }, &to), reel), 3);
    let reader = RunReader::open(&to).unwrap();
    assert_eq!((reader.frames(), reader.info().first_frame), (&[2, 3, 4][..], FIRST_FRAME));
    let read = reader.frame(3).unwrap();
    assert_eq!(read.garments[0].position, wanted.garments[0].position);
}

#[test]
fn a_run_of_mixed_settings_is_refused_before_anything_is_written() {
    let folder = folder();
    let to = folder.path().join("run");
    let mut reel = Reel::new(5);
    reel.other_hashes.insert(3, "ffffffffffffffff".to_owned());
    let why = why_not(request(ExportKind::Run { first: 0, last: 4 }, &to), reel);
    assert!(why.contains("frame 1004") && why.contains("ffffffffffff"), "{why}");
    assert!(!to.exists());
}
