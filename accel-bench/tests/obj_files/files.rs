//! Files on a disk: paths, progress, size, and that no other file is opened.

use std::fs;

use accel_bench::scene::obj::{FaultKind, ObjError, ObjLimits, load, load_with};
use tempfile::tempdir;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_missing_file_is_named() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("missing.obj");
    let error = load(&path, &ObjLimits::default()).unwrap_err();
    assert!(matches!(error, ObjError::Unreadable { .. }), "{error}");
    assert!(
        error.to_string().starts_with(&path.display().to_string()),
        "{error}"
    );
}

#[test]
fn a_directory_is_named() {
    let folder = tempdir().unwrap();
    let error = load(folder.path(), &ObjLimits::default()).unwrap_err();
    let expected = format!(
        "{}: is a directory, not an OBJ file",
        folder.path().display()
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_line_of_ten_megabytes_is_named() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("long.obj");
    fs::write(&path, format!("{TRIANGLE}f {}", "1 ".repeat(5_000_000))).unwrap();
    let mut bytes_read = 0;
    let observe = &mut |read, _| bytes_read = read;
    let error = load_with(&path, &ObjLimits::default(), observe).unwrap_err();
    assert!(
        error.to_string().contains("long.obj:5: the line holds "),
        "{error}"
    );
    assert!(bytes_read < 2_000_000, "{bytes_read} bytes were read");
}

#[test]
fn a_file_over_the_limit_is_refused_before_it_is_read() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("large.obj");
    fs::write(&path, TRIANGLE).unwrap();
    let limits = ObjLimits {
        bytes: 10,
        ..Default::default()
    };
    let error = load_with(&path, &limits, &mut |_, _| panic!("it was read")).unwrap_err();
    assert!(
        matches!(error, ObjError::FileTooLarge { limit: 10, .. }),
        "{error}"
    );
}

#[test]
fn materials_are_never_opened() {
    let folder = tempdir().unwrap();
    // Each of these makes tobj's own loader panic.
    fs::write(folder.path().join("a.mtl"), "newmtl a\nKd 1 1\n").unwrap();
    fs::write(folder.path().join("b.mtl"), "newmtl b\nKe\n").unwrap();
    let path = folder.path().join("scene.obj");
    let text = format!(
        "mtllib a.mtl b.mtl\nmtllib {0}/a.mtl\nusemtl a\n{TRIANGLE}",
        folder.path().display()
    );
    fs::write(&path, text).unwrap();
    let loaded = load(&path, &ObjLimits::default()).unwrap();
    assert_eq!(loaded.mesh.triangles, [[0, 1, 2]]);
    assert!(loaded.faults.is_empty());
}

#[test]
fn progress_rises_to_the_size_of_the_file() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("scene.obj");
    let text =
        format!("{}{TRIANGLE}", "v 3 4 5\n".repeat(100_000)).replace("f 1 2 3", "f -1 -2 -3");
    fs::write(&path, &text).unwrap();
    let mut steps = Vec::new();
    let observe = &mut |read, total| steps.push((read, total));
    let loaded = load_with(&path, &ObjLimits::default(), observe).unwrap();
    let size = text.len() as u64;
    assert!(steps.is_sorted() && steps.len() > 3, "{steps:?}");
    assert_eq!(steps.last(), Some(&(size, size)));
    assert_eq!(loaded.faults.count(FaultKind::UnusedVertex), 100_000);
}
