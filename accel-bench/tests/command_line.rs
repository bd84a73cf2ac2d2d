//! The command as a user meets it: exit status, messages, files.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use accel_bench::report::model::Report;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_accel-bench"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the command starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn assert_refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = run(folder, arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    for word in words {
        assert!(
            message.contains(word),
            "{arguments:?} lacks `{word}`: {message}"
        );
    }
    assert!(!message.contains("panicked"), "{message}");
}

const QUICK: [&str; 5] = ["--size", "24x16", "--rounds", "2", "--report"];

#[test]
fn compare_writes_a_verified_report_in_every_form() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = vec![
        "compare",
        "cylinder",
        "room",
        "--structures",
        "bvh-sweep,sbvh",
    ];
    arguments.extend(["--rays", "primary,shadow,ao,path,random,transparent"]);
    arguments.extend(["--json", "figures.json", "--csv", "figures.csv"]);
    arguments.extend(QUICK);
    arguments.push("report");
    let output = run(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    assert!(
        printed.contains("bvh-sweep") && printed.contains("report/index.html"),
        "{printed}"
    );

    let json = fs::read_to_string(folder.path().join("figures.json")).unwrap();
    let report: Report = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (report.schema.as_str(), report.cells.len()),
        ("accel-bench/1", 4)
    );
    for cell in &report.cells {
        assert_eq!(cell.rays.len(), 6);
        for row in &cell.rays {
            assert!(
                row.verified.rays > 0 && row.verified.disagreements == 0,
                "{row:?}"
            );
            assert!(
                row.mrays_per_second.is_some_and(|rate| rate.min > 0.0),
                "{row:?}"
            );
            assert!(row.plane_tests_per_ray.mean >= 6.0 * row.box_tests_per_ray.mean - 1e-9);
        }
    }
    let csv = fs::read_to_string(folder.path().join("figures.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + 4 * 6);
    let page = fs::read_to_string(folder.path().join("report/index.html")).unwrap();
    assert!(page.contains("all equal, bit for bit") && page.contains(";base64,"));
    for external in ["src=\"http", "href=\"http", "@import", "url(http"] {
        assert!(!page.contains(external), "{external}");
    }
}

#[test]
fn a_users_own_obj_is_compared_verified_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v -1 0 -5\nv 1 0 -5\nv 0 1 -5\nv 0 1 -6\nf 1 2 3\nf 1 2 4\nl 1 2\n";
    fs::write(folder.path().join("my <odd> scene.obj"), obj).unwrap();
    let scene = "my <odd> scene.obj";
    let mut arguments = vec!["compare", scene, "--camera", "0,0.5,0;0,0.5,-5;40"];
    arguments.extend(QUICK);
    arguments.push("out");
    let output = run(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("line 7"),
        "{}",
        text(&output.stderr)
    );
    let page = fs::read_to_string(folder.path().join("out/index.html")).unwrap();
    assert!(page.contains("my &lt;odd&gt; scene") && !page.contains("<odd>"));

    let output = run(
        folder.path(),
        &["verify", scene, "--rays", "200", "--structures", "all"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
    assert!(text(&output.stdout).contains(" 0 disagreements"));

    let two = [
        "verify",
        scene,
        "--rays",
        "10",
        "--kinds",
        "path,far origins",
    ];
    let output = run(folder.path(), &two);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let lines = text(&output.stdout);
    // A kind of the bench, an adversarial one for closest and any hit.
    let of_kinds = lines.lines().filter(|line| line.starts_with("  "));
    assert_eq!(of_kinds.count(), 3, "{lines}");

    for show in [
        "shaded", "normals", "nodes", "planes", "tests", "cost", "time",
    ] {
        let arguments = [
            "render", scene, "--show", show, "-o", "a.png", "--size", "9x7",
        ];
        let output = run(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let bytes = fs::read(folder.path().join("a.png")).unwrap();
        assert_eq!(&bytes[1..4], b"PNG");
    }
}

#[test]
fn what_can_not_be_done_is_refused_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("bad.obj"), "v 0 0 0\nv 1 x 0\n").unwrap();
    fs::write(here.join("empty.obj"), "").unwrap();
    fs::write(
        here.join("nan.obj"),
        "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    fs::write(here.join("file"), "").unwrap();
    assert_refused(
        here,
        &["compare", "no-such-scene"],
        &["no-such-scene", "colonnade"],
    );
    assert_refused(here, &["compare", "missing.obj"], &["missing.obj"]);
    assert_refused(here, &["compare", "."], &["."]);
    for name in ["room@0", "room@many", "room@999999999"] {
        assert_refused(here, &["compare", name], &[name, "20000000"]);
    }
    assert_refused(here, &["compare", "bad.obj"], &["bad.obj", "2"]);
    assert_refused(here, &["compare", "empty.obj"], &["empty.obj"]);
    assert_refused(
        here,
        &["compare", "nan.obj"],
        &["--skip-invalid", "triangle 0"],
    );
    assert_refused(here, &["--structures", "bvh"], &["bvh", "bvh-sweep"]);
    assert_refused(here, &["--rays", "gamma"], &["gamma", "primary"]);
    assert_refused(here, &["--rounds", "0"], &["--rounds"]);
    assert_refused(here, &["--threads", "9999"], &["9999", "1024"]);
    assert_refused(here, &["--size", "0x9"], &["0x9"]);
    assert_refused(here, &["--camera", "1,2;3"], &["1,2;3"]);
    assert_refused(here, &["verify", "cylinder", "--rays", "0"], &["--rays"]);
    let arguments = ["verify", "cylinder", "--kinds", "edges,gamma"];
    assert_refused(here, &arguments, &["gamma", "primary", "far origins"]);
    assert_refused(
        here,
        &["render", "cylinder", "-o", "no/folder/a.png"],
        &["no/folder/a.png"],
    );
    let many = "18446744073709551615";
    for option in ["--viewpoints", "--rounds", "--threads"] {
        assert_refused(here, &["paper", "sbvh", option, many], &[option, many]);
    }
    assert_refused(here, &["verify", "room", "--rays", many], &["--rays", many]);
    let mut large = vec!["paper", "sbvh", "cylinder", "--size", "4096x2048"];
    large.extend(["--viewpoints", "2"]);
    assert_refused(here, &large, &["4096x2048", "16777216", "8388608"]);
}

#[test]
fn reports_that_can_not_be_written_are_refused_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    fs::create_dir_all(folder.path().join("taken/index.html")).unwrap();
    for report in ["file", "file/below", "taken"] {
        for command in [["compare"].as_slice(), &["paper", "sbvh"]] {
            let mut arguments = [command, &["cylinder"]].concat();
            arguments.extend(QUICK);
            arguments.push(report);
            assert_refused(folder.path(), &arguments, &[report]);
            let printed = text(&run(folder.path(), &arguments).stdout);
            assert!(printed.is_empty(), "{printed}");
        }
    }
}

#[test]
fn invalid_triangles_are_left_out_and_counted_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 nan\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 4 3\n";
    fs::write(folder.path().join("nan.obj"), obj).unwrap();
    let mut arguments = vec!["compare", "nan.obj", "--skip-invalid"];
    arguments.extend(QUICK);
    arguments.push("out");
    let output = run(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("left out 1"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn triangles_that_a_rotation_makes_invalid_are_refused_or_left_out_and_counted() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 3e38 3e38 0\nv 3e38 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\nf 3 4 5\n";
    fs::write(folder.path().join("large.obj"), obj).unwrap();
    let mut arguments = vec!["compare", "large.obj", "--rotate", "45,45,45"];
    arguments.extend(QUICK);
    arguments.push("out");
    let words = ["--skip-invalid", "triangle 0", "rotated 45,45,45"];
    assert_refused(folder.path(), &arguments, &words);
    arguments.push("--skip-invalid");
    let output = run(folder.path(), &arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert!(message.contains("left out 1"), "{message}");
}

#[test]
fn a_scene_with_nothing_to_hit_is_compared_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("nan.obj"), "v nan 0 0\nf 1 1 1\n").unwrap();
    fs::write(folder.path().join("point.obj"), "v 1 2 3\nf 1 1 1\n").unwrap();
    for scene in ["nan.obj", "point.obj"] {
        let mut arguments = vec!["compare", scene, "--skip-invalid"];
        arguments.extend(QUICK);
        arguments.push("out");
        let output = run(folder.path(), &arguments);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{scene}: {}",
            text(&output.stderr)
        );
    }
}

#[test]
fn paper_sbvh_tells_the_limits_intervals_and_references_of_its_figures() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = vec!["paper", "sbvh", "cylinder", "colonnade-45@600"];
    arguments.extend(["--viewpoints", "1"]);
    arguments.extend(QUICK);
    arguments.push("out");
    let output = run(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    let words = [
        "at most 200 % references",
        "at most 400 % references",
        "refused by",
        "their range",
        "for which this scene stands",
    ];
    for words in words {
        assert!(printed.contains(words), "no `{words}` in {printed}");
    }
    assert!(!printed.contains("the interval that holds"), "{printed}");

    let json = fs::read_to_string(folder.path().join("out/report.json")).unwrap();
    let document: serde_json::Value = serde_json::from_str(&json).unwrap();
    let figure = |section: usize, table: usize, row: usize, column: usize| {
        let table = &document["sections"][section]["tables"][table];
        table["rows"][row]["figures"][column]["value"]
            .as_f64()
            .unwrap()
    };
    // The cylinder takes all that it is allowed: in Table 1, and in Figure 5 where
    // alpha is 1e-5.
    assert!(figure(0, 0, 0, 1) > 199.0 && figure(0, 0, 0, 1) <= 200.0);
    assert!(figure(0, 1, 5, 2) > 399.0 && figure(0, 1, 5, 5) > 0.0);
    // With alpha 1 there is nothing to refuse.
    assert_eq!((figure(0, 1, 0, 2), figure(0, 1, 0, 5)), (100.0, 0.0));
    // References of the edge volume heuristic are those in the tree.
    let (sbvh, evh) = (figure(1, 0, 0, 1), figure(1, 0, 2, 1));
    assert!(evh < 0.99 * sbvh, "{evh} % of {sbvh} %");
    assert!(
        printed.contains("are left in leaves without duplicates"),
        "{printed}"
    );
}

#[test]
fn embedded_scenes_are_listed_and_exported() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &["scenes", "--export", "objs"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("cylinder"));
    let cylinder = fs::read_to_string(folder.path().join("objs/cylinder.obj")).unwrap();
    assert_eq!(
        cylinder
            .lines()
            .filter(|line| line.starts_with('f'))
            .count(),
        596
    );
}

#[test]
fn paper_bsp_sets_published_figures_and_pictures_beside_measured_ones() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = vec!["paper", "bsp", "cylinder@100"];
    arguments.extend(QUICK);
    arguments.push("report");
    let output = run(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    let expected = [
        "Table 1",
        "Table 2",
        "Table 3",
        "BSP-tri tuned",
        "C_i",
        "2^-24",
        "Hot spot",
        "182.4",
    ];
    for words in expected {
        assert!(printed.contains(words), "no `{words}` in {printed}");
    }
    let page = fs::read_to_string(folder.path().join("report/index.html")).unwrap();
    assert_eq!(page.matches("data:image/png;base64,").count(), 3);
}
