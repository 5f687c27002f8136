//! A run written, read, damaged and resumed.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use serde_json::json;

use super::sealed::{FRAME, Kind, seal, unseal};
use super::state::frame_bytes;
use super::*;
use crate::math::SymTensor2;
use crate::mesh::{Id, Mesh, RawMesh, VertexId};
use crate::scene::{Pose, Surface};
use crate::sim::{Frame, FrameReport, StageCounts, StageSeconds};

mod resumed;

fn info() -> RunInfo {
    let settings = json!({"fps": 25.0, "viewers": [{"name": "close-up"}]});
    RunInfo {
        shotsilk_run: RUN_FORMAT,
        program_version: env!("CARGO_PKG_VERSION").into(),
        shot: "solo".into(),
        sizing_mode: "view".into(),
        fps: 25.0,
        first_frame: 1001,
        garments: vec!["dress".into()],
        obstacles: vec!["body".into()],
        input_hash: InputHasher::new(&settings).finish(),
        cpu_features: cpu_features(),
        adapter: None,
        settings,
    }
}

/// Two sewn triangles with values that no decimal form shortens.
fn garment(number: u32) -> Mesh {
    let third = f64::from(number + 1) / 3.0;
    let raw = RawMesh {
        positions: vec![DVec3::new(-0.0, third, 1e-300), DVec3::X, DVec3::Y, DVec3::ONE * third],
        velocities: vec![DVec3::splat(f64::MIN_POSITIVE / 4.0); 4],
        vertices: vec![
            (0, DVec2::ZERO),
            (1, DVec2::X),
            (2, DVec2::Y),
            (1, DVec2::new(3.0, 0.0)),
            (3, DVec2::new(4.0, 0.1)),
            (2, DVec2::new(3.0, 1.0 / 3.0)),
        ],
        faces: vec![[0, 1, 2], [3, 4, 5]],
        rest_angles: vec![([1, 2], 0.1 + 0.2)],
    };
    let mut mesh = Mesh::from_raw(&raw, &[]).unwrap();
    mesh.metric[VertexId::from_index(2)] = SymTensor2::new(third, -0.0, 1.0 / 7.0);
    mesh
}

fn frame(number: u32) -> Frame {
    let stages = StageSeconds { dynamics: 0.25, remesh: 0.5, ..StageSeconds::default() };
    Frame {
        number,
        time: f64::from(number) / 25.0,
        garments: vec![Arc::new(garment(number))],
        obstacle_poses: vec![Pose {
            scale: 2.0,
            rotation: DQuat::from_rotation_z(0.3),
            translation: DVec3::Z,
        }],
        obstacle_points: [(0, Arc::new(vec![DVec3::ZERO, DVec3::X / 3.0, DVec3::Y, DVec3::Z]))]
            .into(),
        handle_anchors: vec![vec![None, Some(DVec3::new(-0.0, 1.0 / 3.0, 2.0))], Vec::new()],
        report: FrameReport {
            stages,
            counts: StageCounts { contacts: 5, splits: 2, ..StageCounts::default() },
            cpu_seconds: 0.875,
            view_factor_min: 0.01,
            view_factor_mean: 0.5,
            intersections: (number > 0).then_some(3),
            steps_taken: 8,
            largest_stretch: 0.125,
            elastic_energy: 0.5,
            kinetic_energy: 0.25,
            trapped_nodes: 2,
            warnings: vec!["strain limit missed by 1 % — kept".into()],
        },
    }
}

fn body() -> Vec<Arc<Surface>> {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z / 3.0];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    vec![Arc::new(Surface { positions, triangles })]
}

fn write_run(dir: &Path, frame_count: u32, options: WriteOptions) -> Result<(), RunError> {
    let mut writer = RunWriter::create(dir, &info(), &body(), options)?;
    for number in 0..frame_count {
        writer.write(&frame(number))?;
    }
    writer.finish()
}

fn run(frame_count: u32) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    write_run(dir.path(), frame_count, WriteOptions::default()).unwrap();
    dir
}

/// The message as the program prints it.
fn chain(error: &dyn Error) -> String {
    let causes = std::iter::successors(Some(error), |&e| e.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_run_comes_back_bit_for_bit() {
    let dir = run(3);
    let reader = RunReader::open(dir.path()).unwrap();
    assert_eq!(*reader.info(), info());
    assert_eq!(reader.frames(), [0, 1, 2]);
    assert_eq!(reader.obstacles(), body());
    for number in 0..3 {
        let back = reader.frame(number).unwrap();
        assert_eq!(frame_bytes(&back), frame_bytes(&frame(number)));
        assert_eq!(back.garments, frame(number).garments);
        assert_eq!(back.report, frame(number).report);
        back.garments[0].check().unwrap();
    }
}

#[test]
fn the_same_frames_make_the_same_files() {
    let (first, second) = (run(2), run(2));
    for name in ["frames/000001.sfr", "obstacles.bin", "run.json"] {
        let read = |dir: &tempfile::TempDir| fs::read(dir.path().join(name)).unwrap();
        assert_eq!(read(&first), read(&second), "{name}");
    }
}

/// The CPU seconds of each row cut to the frame's own 0.875: what writing takes is never the same.
fn without_writing_time(stats: &str) -> String {
    let cut = |line: &str| {
        let mut fields: Vec<&str> = line.split(',').collect();
        if let Ok(seconds) = fields[6].parse::<f64>() {
            assert!((0.875..1.875).contains(&seconds), "{seconds} s");
            fields[6] = "0.875";
        }
        fields.join(",") + "\n"
    };
    stats.lines().map(cut).collect()
}

#[test]
fn statistics_have_the_agreed_columns_and_the_frame_numbers_of_the_shot() {
    let dir = run(2);
    let text = fs::read_to_string(dir.path().join("stats.csv")).unwrap();
    assert_eq!(
        without_writing_time(&text),
        format!(
            "frame,time_s,faces,vertices,nodes,wall_s,cpu_s,obstacles_s,proximity_s,dynamics_s,\
         collision_s,sizing_s,view_s,remesh_s,untangle_s,other_s,view_factor_min,\
         view_factor_mean,intersections,steps_taken,largest_stretch,stretch_99,\
         trapped_nodes,contacts,impacts,degenerate_hinges,splits,collapses,flips,vetoes,\
         solutions,solver_iterations,factorisations,unconverged_steps,\
         elastic_energy,kinetic_energy\n\
         1001,0,2,6,4,0.75,0.875,0,0,0.25,0,0,0,0.5,0,0,0.01,0.5,,8,0.125,{},2,5,0,0,2,0,0,0,0,0,0,0,0.5,0.25\n\
         1002,0.04,2,6,4,0.75,0.875,0,0,0.25,0,0,0,0.5,0,0,0.01,0.5,3,8,0.125,{},2,5,0,0,2,0,0,0,0,0,0,0,0.5,0.25\n",
            frame(0).stretch_of_all_but(0.01),
            frame(1).stretch_of_all_but(0.01)
        )
    );
}

#[test]
fn a_row_is_in_the_file_as_soon_as_its_frame_is_written() {
    let dir = tempfile::tempdir().unwrap();
    let mut writer =
        RunWriter::create(dir.path(), &info(), &body(), WriteOptions::default()).unwrap();
    for rows in 1..4 {
        writer.write(&frame(rows - 1)).unwrap();
        let text = fs::read_to_string(dir.path().join("stats.csv")).unwrap();
        assert_eq!(text.lines().count(), rows as usize + 1);
    }
}

#[test]
fn obj_files_carry_shown_frame_numbers_and_read_back_to_the_same_bits() {
    let dir = tempfile::tempdir().unwrap();
    let options = WriteOptions { obj: true, obj_obstacles: true, overwrite: false };
    write_run(dir.path(), 1, options).unwrap();
    let objs = dir.path().join("obj");
    assert_eq!(names(&objs), ["1001_00.obj", "1001_obs_00.obj"]);
    let text = fs::read_to_string(objs.join("1001_00.obj")).unwrap();
    assert!(text.ends_with("f 1/1 2/2 3/3\nf 2/4 4/5 3/6\n"), "{text}");
    let numbers: Vec<f64> =
        text.lines().next().unwrap().split(' ').skip(1).map(|n| n.parse().unwrap()).collect();
    let expected = garment(0).position.as_slice()[0].to_array();
    assert_eq!(numbers.iter().map(|n| n.to_bits()).collect::<Vec<_>>(), expected.map(f64::to_bits));
    let text = fs::read_to_string(objs.join("1001_obs_00.obj")).unwrap();
    assert!(text.starts_with("v 0 0 1\n") && text.ends_with("f 3 1 4\n"), "{text}");
    // Where its points are at the frame, not at rest.
    let top = text.lines().nth(3).and_then(|line| line.rsplit(' ').next()).unwrap();
    assert!((top.parse::<f64>().unwrap() - 3.0).abs() < 1e-12, "{top}");
}

#[test]
fn a_state_cut_short_anywhere_is_refused() {
    let file = seal(FRAME, &frame_bytes(&frame(1))).unwrap();
    for length in 0..file.len() {
        assert!(unseal(FRAME, &file[..length]).is_err(), "{length} bytes");
    }
}

#[test]
fn a_state_with_any_byte_changed_is_refused() {
    let file = seal(FRAME, &frame_bytes(&frame(1))).unwrap();
    for index in 0..file.len() {
        let mut damaged = file.clone();
        damaged[index] ^= 0x10;
        assert!(unseal(FRAME, &damaged).is_err(), "byte {index}");
    }
}

#[test]
fn contents_cut_short_or_too_long_are_refused_even_with_a_right_checksum() {
    let content = frame_bytes(&frame(1));
    for length in 0..content.len() {
        assert!(state::frame_from_bytes(2, &content[..length]).is_err(), "{length} bytes");
    }
    let surplus = state::frame_from_bytes(2, &[&content[..], b"x"].concat()).unwrap_err();
    assert_eq!(surplus.to_string(), "1 bytes follow the end of the state");
}

#[test]
fn damage_is_reported_with_file_thing_and_value() {
    let dir = run(2);
    let path = dir.path().join("frames/000001.sfr");
    let whole = fs::read(&path).unwrap();
    let message = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        chain(&RunReader::open(dir.path()).unwrap().frame(1).unwrap_err())
    };
    let cannot_read = format!("cannot read \"{}\": ", path.display());

    let short = message(&whole[..20]);
    assert_eq!(
        short,
        cannot_read.clone() + "it is too short: the full length needs 8 bytes, 4 are left"
    );
    let mut later = whole.clone();
    later[8] = 9;
    assert_eq!(
        message(&later),
        cannot_read.clone() + "it has format version 9; this program reads versions 1 to 2"
    );
    let mut damaged = whole.clone();
    *damaged.last_mut().unwrap() ^= 1;
    assert!(message(&damaged).starts_with(&(cannot_read.clone() + "its checksum is ")));
    assert!(message(b"v 0 0 0 and so on").contains("does not start with \"SILKFRAM\" but with"));
}

#[test]
fn a_frame_under_another_frames_name_is_refused() {
    let dir = run(2);
    let frames = dir.path().join("frames");
    fs::copy(frames.join("000001.sfr"), frames.join("000005.sfr")).unwrap();
    let reader = RunReader::open(dir.path()).unwrap();
    assert!(matches!(reader.frame(5), Err(RunError::WrongFrame { found: 1, expected: 5, .. })));
    assert!(matches!(
        reader.frame(3),
        Err(RunError::NoSuchFrame { number: 3, first_and_last: Some([0, 5]), .. })
    ));
}

#[test]
fn a_run_of_a_later_format_and_a_folder_without_run_json_are_refused() {
    let dir = run(1);
    let path = dir.path().join("run.json");
    fs::write(&path, r#"{"shotsilk_run": 2, "something": "else"}"#).unwrap();
    let error = RunReader::open(dir.path()).unwrap_err();
    assert!(chain(&error).ends_with("has run format 2; this program reads formats 1 to 1"));
    fs::remove_file(&path).unwrap();
    assert!(matches!(RunReader::open(dir.path()), Err(RunError::NotARun { .. })));
    assert!(!RunReader::is_run(dir.path()));
}

#[test]
fn a_folder_with_other_things_in_it_is_never_written_to() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("thesis.tex"), "x").unwrap();
    for overwrite in [false, true] {
        let options = WriteOptions { overwrite, ..WriteOptions::default() };
        let error = write_run(dir.path(), 1, options).unwrap_err();
        assert!(matches!(error, RunError::Occupied { .. }));
    }
    assert_eq!(names(dir.path()), ["thesis.tex"]);
}

#[test]
fn an_earlier_run_is_replaced_only_on_request_and_foreign_files_stay() {
    let dir = run(3);
    fs::write(dir.path().join("frames/notes.txt"), "mine").unwrap();
    let error = write_run(dir.path(), 1, WriteOptions::default()).unwrap_err();
    assert!(matches!(error, RunError::AlreadyARun { .. }));
    assert_eq!(RunReader::open(dir.path()).unwrap().frames(), [0, 1, 2]);

    let options = WriteOptions { overwrite: true, ..WriteOptions::default() };
    write_run(dir.path(), 1, options).unwrap();
    assert_eq!(names(&dir.path().join("frames")), ["000000.sfr", "notes.txt"]);
}

#[test]
fn an_output_that_cannot_be_created_is_an_error_before_the_first_frame() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    fs::write(&file, "x").unwrap();
    let error = write_run(&file.join("run"), 1, WriteOptions::default()).unwrap_err();
    assert!(chain(&error).starts_with("cannot create \""), "{}", chain(&error));
}

#[test]
fn a_frame_that_cannot_be_written_is_an_error() {
    let dir = tempfile::tempdir().unwrap();
    let mut writer =
        RunWriter::create(dir.path(), &info(), &body(), WriteOptions::default()).unwrap();
    fs::remove_dir_all(dir.path().join("frames")).unwrap();
    let error = writer.write(&frame(0)).unwrap_err();
    assert!(chain(&error).starts_with("cannot write \""), "{}", chain(&error));
}
