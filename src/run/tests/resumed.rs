//! A run that ended before its time, taken up again.

use std::collections::BTreeMap;

use super::*;
use crate::run::sealed::OBSTACLES;
use crate::run::state::obstacle_bytes;

fn resume(dir: &Path, last: u32) -> Result<ResumedRun, RunError> {
    resume_with(dir, 0, last, WriteOptions::default())
}

fn resume_with(
    dir: &Path,
    first: u32,
    last: u32,
    options: WriteOptions,
) -> Result<ResumedRun, RunError> {
    RunWriter::resume(dir, &info(), &body(), first..=last, options)
}

/// Goes on to the last frame wanted, and returns the frame after which, if there is one.
fn finish(run: ResumedRun, last: u32) -> Option<u32> {
    let (mut writer, after) = (run.writer, last_done(&run.remainder));
    for number in after.map_or(0, |n| n + 1)..=last {
        writer.write(&frame(number)).unwrap();
    }
    writer.finish().unwrap();
    after
}

fn last_done(remainder: &Remainder) -> Option<u32> {
    match remainder {
        Remainder::All => None,
        Remainder::After(frame) => Some(frame.number),
        Remainder::Nothing => Some(u32::MAX - 1),
    }
}

/// Every file below a folder and what is in it, without what writing took.
fn contents(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for folder in ["", "frames", "obj"] {
        let dir = dir.join(folder);
        for name in if dir.is_dir() { names(&dir) } else { Vec::new() } {
            let path = dir.join(&name);
            if path.is_file() {
                let mut bytes = fs::read(&path).unwrap();
                if name == "stats.csv" {
                    bytes = without_writing_time(&String::from_utf8(bytes).unwrap()).into_bytes();
                }
                all.push((format!("{folder}/{name}"), bytes));
            }
        }
    }
    all
}

#[track_caller]
fn assert_same_run(resumed: &tempfile::TempDir, straight: &tempfile::TempDir) {
    let [a, b] = [resumed, straight].map(|dir| contents(dir.path()));
    let names = |all: &[(String, Vec<u8>)]| all.iter().map(|(n, _)| n.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for (file, other) in a.iter().zip(&b) {
        assert!(file.1 == other.1, "{}", file.0);
    }
}

#[test]
fn a_resumed_run_has_the_files_of_a_straight_one() {
    let dir = run(4);
    // As if killed: a half-written state, a row cut short, the row before it lost.
    fs::write(dir.path().join("frames/000004.sfr.partial"), "half").unwrap();
    let stats = dir.path().join("stats.csv");
    let text = fs::read_to_string(&stats).unwrap();
    fs::write(&stats, &text[..text.find("1003,").unwrap() + 7]).unwrap();

    let resumed = resume(dir.path(), 4).unwrap();
    assert!(resumed.warnings.is_empty());
    assert_eq!(finish(resumed, 4), Some(3));
    assert_same_run(&dir, &run(5));
}

/// What a kill leaves at any time before the first state, each with what came before it.
#[test]
fn a_run_killed_before_its_first_frame_starts_over() {
    let straight = run(2);
    let steps: [fn(&Path); 5] = [
        |dir| fs::write(dir.join("run.lock"), "").unwrap(),
        |dir| fs::write(dir.join("run.json.partial"), "{\"shots").unwrap(),
        |dir| {
            fs::write(dir.join("run.json"), info().to_json()).unwrap();
            fs::remove_file(dir.join("run.json.partial")).unwrap();
        },
        |dir| {
            fs::create_dir(dir.join("frames")).unwrap();
            fs::write(dir.join("obstacles.bin.partial"), "half").unwrap();
        },
        |dir| {
            fs::remove_file(dir.join("obstacles.bin.partial")).unwrap();
            let file = seal(OBSTACLES, &obstacle_bytes(&body())).unwrap();
            fs::write(dir.join("obstacles.bin"), file).unwrap();
            fs::write(dir.join("stats.csv"), "frame,ti").unwrap();
        },
    ];
    for count in 1..=steps.len() {
        let dir = tempfile::tempdir().unwrap();
        steps[..count].iter().for_each(|step| step(dir.path()));
        assert_eq!(finish(resume(dir.path(), 1).unwrap(), 1), None, "{count} steps");
        assert_same_run(&dir, &straight);
    }
}

#[test]
fn damaged_frames_are_named_and_computed_again() {
    let straight = run(5);
    for damage in [
        |path: &Path| fs::write(path, "").unwrap(),
        |path: &Path| {
            let mut bytes = fs::read(path).unwrap();
            *bytes.last_mut().unwrap() ^= 1;
            fs::write(path, bytes).unwrap();
        },
    ] {
        for (damaged, after) in [(4, Some(3)), (2, Some(1)), (0, None)] {
            let dir = run(5);
            damage(&dir.path().join(format!("frames/{damaged:06}.sfr")));
            let resumed = resume(dir.path(), 4).unwrap();
            let [warning] = &resumed.warnings[..] else { panic!("{:?}", resumed.warnings) };
            assert!(warning.contains(&format!("{damaged:06}.sfr")), "{warning}");
            assert_eq!(finish(resumed, 4), after);
            assert_same_run(&dir, &straight);
        }
    }
}

#[test]
fn a_frame_that_is_missing_ends_what_stands() {
    let dir = run(5);
    fs::remove_file(dir.path().join("frames/000002.sfr")).unwrap();
    assert_eq!(finish(resume(dir.path(), 4).unwrap(), 4), Some(1));
    assert_same_run(&dir, &run(5));
}

#[test]
fn a_finished_run_is_left_alone_but_for_lost_rows() {
    let dir = run(5);
    let before = contents(dir.path());
    for last in [4, 2] {
        let resumed = resume(dir.path(), last).unwrap();
        assert!(matches!(resumed.remainder, Remainder::Nothing));
        drop(resumed);
        assert_eq!(contents(dir.path()), before);
    }
    // Killed after the last state was in place, before its row was.
    let text = fs::read_to_string(dir.path().join("stats.csv")).unwrap();
    fs::write(dir.path().join("stats.csv"), &text[..text.find("1005,").unwrap()]).unwrap();
    assert!(matches!(resume(dir.path(), 4).unwrap().remainder, Remainder::Nothing));
    assert_eq!(contents(dir.path()), before);
}

#[test]
fn a_run_can_be_made_longer() {
    let dir = run(2);
    assert_eq!(finish(resume(dir.path(), 4).unwrap(), 4), Some(1));
    assert_same_run(&dir, &run(5));
}

#[test]
fn a_run_of_some_frames_goes_on_from_them() {
    let part = |numbers: std::ops::Range<u32>| {
        let dir = tempfile::tempdir().unwrap();
        let mut writer =
            RunWriter::create(dir.path(), &info(), &body(), WriteOptions::default()).unwrap();
        numbers.for_each(|number| writer.write(&frame(number)).unwrap());
        dir
    };
    let options = WriteOptions::default();
    let dir = part(2..4);
    let after = last_done(&resume_with(dir.path(), 2, 5, options).unwrap().remainder);
    assert_eq!(after, Some(3));
    // None is there to go on from.
    let none = part(0..0);
    let after = last_done(&resume_with(none.path(), 2, 5, options).unwrap().remainder);
    assert_eq!(after, None);
    // Those before the frames wanted will do, too.
    let before = part(0..2);
    let after = last_done(&resume_with(before.path(), 4, 5, options).unwrap().remainder);
    assert_eq!(after, Some(1));
    // But not those after them.
    let error = resume_with(dir.path(), 0, 5, options).err().unwrap();
    assert!(matches!(error, RunError::BeginsLater { held: 2, wanted: 0, .. }), "{error}");
    assert_eq!(RunReader::open(dir.path()).unwrap().frames(), [2, 3]);
}

#[test]
fn obj_files_are_made_good_and_those_of_forgotten_frames_go() {
    let options = WriteOptions { obj: true, obj_obstacles: true, overwrite: false };
    let written = |count| {
        let dir = tempfile::tempdir().unwrap();
        write_run(dir.path(), count, options).unwrap();
        dir
    };
    let dir = written(4);
    fs::remove_file(dir.path().join("obj/1002_00.obj")).unwrap();
    fs::write(dir.path().join("obj/1005_00.obj"), "of a frame whose state is not there").unwrap();
    fs::write(dir.path().join("obj/1005_obs_00.obj.partial"), "half").unwrap();
    fs::write(dir.path().join("obj/mine.obj"), "mine").unwrap();
    let resumed = resume_with(dir.path(), 0, 4, options).unwrap();
    assert!(!dir.path().join("obj/1005_00.obj").exists());
    assert_eq!(finish(resumed, 4), Some(3));
    fs::remove_file(dir.path().join("obj/mine.obj")).unwrap();
    assert_same_run(&dir, &written(5));
    // Asked for only now.
    let late = run(5);
    finish(resume_with(late.path(), 0, 4, options).unwrap(), 0);
    assert_same_run(&late, &written(5));
}

#[test]
fn a_run_of_other_input_or_another_version_is_not_resumed() {
    let dir = run(2);
    let before = contents(dir.path());
    let options = WriteOptions::default();
    let error = |info: &RunInfo| {
        RunWriter::resume(dir.path(), info, &body(), 0..=4, options).err().unwrap()
    };
    let input = error(&RunInfo { input_hash: "0".repeat(64), ..info() });
    assert!(matches!(input, RunError::OtherInput { .. }), "{input}");
    let version = error(&RunInfo { program_version: "9.0.0".into(), ..info() });
    assert!(matches!(version, RunError::OtherVersion { .. }), "{version}");
    assert_eq!(contents(dir.path()), before);
}

#[test]
fn another_processor_is_worth_a_warning() {
    let dir = run(2);
    let other = RunInfo { cpu_features: vec!["abacus".into()], ..info() };
    let run =
        RunWriter::resume(dir.path(), &other, &body(), 0..=4, WriteOptions::default()).unwrap();
    assert!(run.warnings[0].contains("(abacus)"), "{:?}", run.warnings);
}

#[test]
fn what_is_no_run_is_not_resumed_and_stays_as_it_is() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name);
    fs::create_dir(path("mine")).unwrap();
    fs::write(path("mine/run.lock"), "of something else").unwrap();
    fs::write(path("mine/notes.txt"), "x").unwrap();
    fs::write(path("file"), "x").unwrap();
    for name in ["mine", "file"] {
        let error = resume(&path(name), 1).err().unwrap();
        assert!(matches!(error, RunError::NotARun { .. }), "{name}: {error}");
    }
    assert_eq!(names(dir.path()), ["file", "mine"]);
    assert_eq!(names(&path("mine")), ["notes.txt", "run.lock"]);
}

#[test]
fn where_there_is_nothing_yet_a_run_is_begun() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("empty")).unwrap();
    for name in ["missing", "empty"] {
        let path = dir.path().join(name);
        let resumed = resume(&path, 1).unwrap();
        assert!(matches!(resumed.remainder, Remainder::All), "{name}");
        resumed.writer.finish().unwrap();
        assert!(RunReader::open(&path).unwrap().frames().is_empty());
    }
}

#[test]
fn a_run_is_written_by_one_program_at_a_time() {
    let dir = tempfile::tempdir().unwrap();
    let overwrite = WriteOptions { overwrite: true, ..WriteOptions::default() };
    let writer = RunWriter::create(dir.path(), &info(), &body(), WriteOptions::default()).unwrap();
    let is_in_use = |error: Option<RunError>| matches!(error, Some(RunError::InUse { .. }));
    assert!(is_in_use(resume(dir.path(), 1).err()));
    assert!(is_in_use(RunWriter::create(dir.path(), &info(), &body(), overwrite).err()));
    drop(writer);
    let resumed = resume(dir.path(), 1).unwrap();
    assert!(is_in_use(resume(dir.path(), 1).err()));
    drop(resumed);
    assert!(!dir.path().join("run.lock").exists());
}

#[test]
fn a_run_half_removed_for_another_is_none() {
    let dir = run(3);
    fs::rename(dir.path().join("run.json"), dir.path().join("run.json.partial")).unwrap();
    fs::remove_file(dir.path().join("frames/000002.sfr")).unwrap();
    assert!(!RunReader::is_run(dir.path()));
    // No need to say --overwrite again.
    write_run(dir.path(), 1, WriteOptions::default()).unwrap();
    assert_same_run(&dir, &run(1));
}

/// What a power cut leaves of a file: nothing, zeros, or its beginning.
fn broken(info: &[u8]) -> [Vec<u8>; 3] {
    [Vec::new(), vec![0; info.len()], info[..info.len() / 2].to_vec()]
}

#[test]
fn a_run_that_has_lost_its_run_json_is_replaced_on_request_only() {
    let whole = run(1);
    let whole_info = fs::read(whole.path().join("run.json")).unwrap();
    for info in broken(&whole_info) {
        let dir = run(3);
        fs::write(dir.path().join("run.json"), &info).unwrap();
        assert!(!RunReader::is_run(dir.path()));
        let error = resume(dir.path(), 3).err().unwrap();
        assert!(matches!(error, RunError::Broken { .. }), "{error}");
        let error = write_run(dir.path(), 1, WriteOptions::default()).unwrap_err();
        assert!(matches!(error, RunError::AlreadyARun { .. }), "{error}");
        assert_eq!(names(&dir.path().join("frames")).len(), 3);
        let overwrite = WriteOptions { overwrite: true, ..WriteOptions::default() };
        write_run(dir.path(), 1, overwrite).unwrap();
        assert_same_run(&dir, &whole);
    }
}

#[test]
fn a_run_json_of_someone_else_is_never_written_over() {
    let overwrite = WriteOptions { overwrite: true, ..WriteOptions::default() };
    for (name, text) in [("frames", "{ // mine\n}"), ("frames", "[1]"), ("notes.txt", "")] {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join("run.json"), text).unwrap();
        fs::create_dir(dir.path().join(name)).unwrap();
        let error = write_run(dir.path(), 1, overwrite).unwrap_err();
        assert!(matches!(error, RunError::Occupied { .. }), "{error}");
        assert_eq!(names(dir.path()), [name, "run.json"]);
        assert_eq!(fs::read_to_string(dir.path().join("run.json")).unwrap(), text);
    }
}

#[test]
fn a_state_of_version_1_is_read_without_anchors() {
    let mut whole =
        Frame { handle_anchors: Vec::new(), obstacle_points: BTreeMap::new(), ..frame(1) };
    whole.report.elastic_energy = 0.0;
    whole.report.kinetic_energy = 0.0;
    let mut content = frame_bytes(&whole);
    // Version 2 added the counts of handles and of deforming obstacles at the end, of which there are
    // none here, four counts after frame number, time, nine stages and seven counts, and two
    // energies after the four measures that follow.
    assert_eq!(content.split_off(content.len() - 8), [0; 8]);
    let counts = 4 + 8 + 9 * 8 + 7 * 8;
    assert!(content.drain(counts..counts + 4 * 8).all(|byte| byte == 0));
    let energies = counts + 4 * 8;
    assert!(content.drain(energies..energies + 2 * 8).all(|byte| byte == 0));
    let dir = run(2);
    let file = seal(Kind { version: 1, ..FRAME }, &content).unwrap();
    fs::write(dir.path().join("frames/000001.sfr"), file).unwrap();
    let back = RunReader::open(dir.path()).unwrap().frame(1).unwrap();
    assert_eq!(frame_bytes(&back), frame_bytes(&whole));
}
