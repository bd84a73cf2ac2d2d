//! Reports show what was measured, and withhold what was not verified.

use accel_bench::report::model::{
    Bytes, Cell, Environment, HeatMap, MeanMax, Pictures, Quantity, RayRow, Report, Spread,
    Statistics, Verified,
};
use accel_bench::report::{csv, html, json, table};

fn row(kind: &str, disagreements: usize) -> RayRow {
    RayRow {
        kind: kind.to_owned(),
        count: 1000,
        note: Some("t_max = 1.5".to_owned()),
        mrays_per_second: (disagreements == 0).then_some(Spread {
            median: 12.34,
            min: 11.11,
            max: 13.57,
        }),
        nodes_per_ray: MeanMax {
            mean: 20.5,
            max: 99,
        },
        box_tests_per_ray: MeanMax {
            mean: 40.25,
            max: 180,
        },
        plane_tests_per_ray: MeanMax {
            mean: 241.5,
            max: 1080,
        },
        primitive_tests_per_ray: MeanMax {
            mean: 2.75,
            max: 31,
        },
        hits: 640,
        verified: Verified {
            rays: 100,
            disagreements,
        },
    }
}

fn report() -> Report {
    let cell = |structure: &str, disagreements| Cell {
        scene: "<script>alert(1)</script>".to_owned(),
        triangles: 69_451,
        structure: structure.to_owned(),
        settings: "default".to_owned(),
        build_seconds: 0.0615,
        bytes: Bytes {
            nodes: 2_000_000,
            references: 300_000,
            primitives: 2_700_000,
            total: 5_000_000,
        },
        statistics: Statistics {
            nodes: 75_000,
            leaves: 37_500,
            references: 69_451,
            mean_leaf_size: 1.85,
            depth: 18,
            sah_cost: 31.16,
            overlap: 3.84,
            epo: None,
        },
        rays: vec![row("primary", 0), row("ao", disagreements)],
    };
    let mut report = Report::new(Environment::default());
    report.cells = vec![cell("bvh-sweep", 0), cell("bvh-broken", 3)];
    report
}

fn pictures() -> Pictures {
    let map = |structure: &str, quantity| HeatMap {
        scene: report().cells[0].scene.clone(),
        structure: structure.to_owned(),
        quantity,
        width: 2,
        height: 1,
        values: vec![1, 7],
    };
    let maps = ["bvh-sweep", "bvh-broken"]
        .into_iter()
        .flat_map(|structure| Quantity::ALL.map(|quantity| map(structure, quantity)));
    Pictures {
        heat_maps: maps.collect(),
        shaded: Vec::new(),
    }
}

fn printed(is_coloured: bool) -> String {
    let mut out = Vec::new();
    table::print(&report(), &mut out, table::TableStyle { is_coloured }).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn tables_fit_a_terminal_and_name_disagreements() {
    let text = printed(false);
    let widest = text.lines().map(|line| line.chars().count()).max();
    assert!(widest <= Some(120), "{widest:?} columns");
    assert!(
        text.contains("12.34 [11.11, 13.57]") && text.contains("3 of 100 DIFFER"),
        "{text}"
    );
    assert!(text.contains("3 rays DISAGREE"), "{text}");
    // Three of four rows have a speed.
    assert_eq!(text.matches("12.34").count(), 3);
    assert!(
        !text.contains('\u{1b}'),
        "colours only where a person watches"
    );
}

#[test]
fn json_has_the_documented_keys_and_is_read_back() {
    let mut out = Vec::new();
    json::write(&report(), &mut out).unwrap();
    let value: serde_json::Value = serde_json::from_slice(&out).unwrap();
    let keys = |value: &serde_json::Value| -> Vec<String> {
        let mut keys: Vec<String> = value.as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys
    };
    assert_eq!(keys(&value), ["cells", "environment", "schema"]);
    let cell = &value["cells"][1];
    let cell_keys = [
        "build_seconds",
        "bytes",
        "rays",
        "scene",
        "settings",
        "statistics",
        "structure",
        "triangles",
    ];
    assert_eq!(keys(cell), cell_keys);
    assert_eq!(
        keys(&cell["bytes"]),
        ["nodes", "primitives", "references", "total"]
    );
    for key in [
        "nodes",
        "leaves",
        "references",
        "depth",
        "sah_cost",
        "overlap",
        "epo",
    ] {
        assert!(cell["statistics"].get(key).is_some(), "{key}");
    }
    let row = &cell["rays"][1];
    for key in ["nodes", "box_tests", "plane_tests", "primitive_tests"] {
        assert_eq!(keys(&row[format!("{key}_per_ray")]), ["max", "mean"]);
    }
    assert_eq!(keys(&row["verified"]), ["disagreements", "rays"]);
    assert!(row["mrays_per_second"].is_null());
    assert_eq!(
        keys(&cell["rays"][0]["mrays_per_second"]),
        ["max", "median", "min"]
    );
    assert_eq!(serde_json::from_slice::<Report>(&out).unwrap(), report());
}

#[test]
fn csv_has_a_line_per_cell_and_kind_with_as_many_fields_as_its_header() {
    let mut out = Vec::new();
    csv::write(&report(), &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let fields: Vec<usize> = text.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(fields, [30; 5]);
}

#[test]
fn the_page_escapes_names_and_withholds_unverified_speeds() {
    let mut out = Vec::new();
    html::write_html(&report(), &pictures(), &mut out).unwrap();
    let page = String::from_utf8(out).unwrap();
    assert!(!page.contains("<script>alert") && page.contains("&lt;script&gt;alert"));
    assert!(page.contains("3 of 100 differ") && page.contains("withheld"));
    for figure in ["12.34", "241.5", "31.16", "20.5", "2.75", "61.5"] {
        assert!(page.contains(figure), "{figure}");
    }
}
