//! Legal but unusual files: their exact vertices, triangles and faults.

use accel_bench::scene::obj::FaultKind;
use glam::Vec3;

use crate::accept;

const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Name, a file of the triangle [`CORNERS`], and its fault report.
const TRIANGLE: &[(&str, &[u8], &str)] = &[
    ("plain", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""),
    ("no line end at the end", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", ""),
    ("byte order mark", b"\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""),
    ("CR line ends", b"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", ""),
    ("CRLF line ends", b"v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 3\r\n", ""),
    ("mixed line ends", b"v 0 0 0\rv 1 0 0\r\nv 0 1 0\n\rf 1 2 3", ""),
    (
        "tabs and many spaces",
        b"\tv  0\t0   0 \n  v 1\t\t0 0\nv\t0 1 0\n\n \t\nf \t1  2\t3  \n",
        "",
    ),
    (
        "all forms of numbers",
        b"v -0e5 .0 +0.\nv +1.0 0.0e-3 0\nv 0E0 10.0e-1 -0\nf +1 02 3\n",
        "",
    ),
    (
        "trailing comments",
        b"# head\nv 0 0 0 # a\nv 1 0 0# b\nv 0 1 0 #\nf 1 2 3 # quad\n",
        "",
    ),
    (
        "continuations",
        b"v 0 0 \\\n 0\nv 1 \\\r\n0 \\\r\n 0\nv 0 1 0\nf 1\\\n 2 \\ \n3 # c\n",
        "",
    ),
    (
        "backslash in a comment",
        b"v 0 0 0 # C:\\models\\\nv 1 0 0\n# D:\\\nv 0 1 0\nf 1 2 3\n",
        "",
    ),
    (
        "continuation at the end of the file",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\",
        "continuations of the last line (nothing follows): 1 (line 4)",
    ),
    ("negative indices", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", ""),
    (
        "texture and normal indices",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1\n",
        "",
    ),
    (
        "normal index that makes tobj panic",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//6148914691236517206 2//-7 3//0\n",
        "",
    ),
    (
        "one-dimensional texture coordinates",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nvt\nvt a b\nvn 1\nf 1/1 2/1 3/1\n",
        "",
    ),
    (
        "weights",
        b"v 0 0 0 1\nv 1 0 0 0\nv 0 1 0 2.0\nf 1 2 3\n",
        "vertices with a weight or colour (left out): 3 (line 1, 2, 3)",
    ),
    (
        "some vertices with colours",
        b"v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 0 1 1\nf 1 2 3\n",
        "vertices with a weight or colour (left out): 2 (line 1, 3)",
    ),
    (
        "names that are not UTF-8, with spaces",
        b"o Stra\xDFe 7 \xFF\ng caf\xE9 au lait\nusemtl \xC3\x28\n# \xE9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "",
    ),
    (
        "groups, smoothing and materials",
        b"mtllib a.mtl\no\ng\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng a b\ns 1\nusemtl m\nf 1 2 3\ns off\no x\ng y\n",
        "",
    ),
    (
        "points and polylines",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2 3\nf 1 2 3\nl 9/9 -9/1\n",
        "points and polylines (left out): 3 (line 4, 5, 7)",
    ),
    (
        "free-form curves and surfaces",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvp 0 1\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3\nparm u 0 1\nend\nsurf 0 1 0 1 1\nf 1 2 3\n",
        "statements of free-form curves and surfaces (left out): 7 (line 4, 5, 6, 7, 8, ...)",
    ),
    (
        "unknown statements and calls",
        b"call other.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nfaces 1\nF 1 2 3\nf 1 2 3\n",
        "calls of other files or commands (not followed): 1 (line 1)\n\
         lines that are no OBJ statements (left out): 2 (line 5, 6)",
    ),
    ("faces of the format's first version", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n", ""),
    (
        "unused vertices",
        b"v 9 9 9\nv 0 0 0\nv 1 0 0\n\nv 8 8 8\nv 0 1 0\nf 2 3 5\n",
        "vertices that no face uses (left out): 2 (line 1, 5)",
    ),
];

#[test]
fn odd_files_of_one_triangle_load_exactly() {
    let mut failures = Vec::new();
    for (name, bytes, faults) in TRIANGLE {
        let loaded = accept(bytes);
        let positions = loaded.mesh.positions.iter().map(Vec3::to_array);
        let right = positions.eq(CORNERS) && loaded.mesh.triangles == [[0, 1, 2]];
        if !right || loaded.faults.to_string() != *faults {
            failures.push(format!("{name}: {loaded:?}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn vertices_and_triangles_keep_the_order_of_the_file() {
    let loaded = accept(
        b"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 4 3 2\no next\nv 4 0 0\nv 5 0 0\nf -1 -2 1\nf 6 4 2\n",
    );
    let x: Vec<f32> = loaded.mesh.positions.iter().map(|point| point.x).collect();
    assert_eq!(x, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(loaded.mesh.triangles, [[3, 2, 1], [5, 4, 0], [5, 3, 1]]);
    assert_eq!(
        loaded.mesh.corners(1).map(|corner| corner.x),
        [5.0, 4.0, 0.0]
    );
}

#[test]
fn negative_indices_count_back_from_their_own_line() {
    let loaded = accept(b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf -3 -2 -1\nv 3 0 0\nf -3 -2 -1\n");
    assert_eq!(loaded.mesh.triangles, [[0, 1, 2], [1, 2, 3]]);
}

#[test]
fn values_that_are_not_finite_load_and_are_reported() {
    let loaded = accept(b"v 0 0 0\nv nan 0 0\nv 0 -inf 1e39\nv 1e38 1e-60 0\nf 1 2 3\nf 1 3 4\n");
    let [_, nan, infinite, large] = loaded.mesh.positions[..] else {
        panic!("{loaded:?}");
    };
    assert!(nan.x.is_nan());
    assert_eq!(infinite.to_array(), [0.0, f32::NEG_INFINITY, f32::INFINITY]);
    assert_eq!(large.to_array(), [1e38, 0.0, 0.0]);
    let fault = loaded
        .faults
        .non_finite_vertices()
        .expect("two such vertices");
    assert_eq!(
        (fault.count, fault.first_lines.as_slice()),
        (2, &[2, 3][..])
    );
}

#[test]
fn degenerate_triangles_are_kept() {
    let loaded = accept(b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\nf 1 2 1\nf 1 2 2 3\n");
    let expected = [[0, 1, 2], [0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 1, 2]];
    assert_eq!(loaded.mesh.triangles, expected);
    let repeated = loaded
        .faults
        .of(FaultKind::RepeatedCorner)
        .expect("three faces");
    assert_eq!(
        (repeated.count, repeated.first_lines.as_slice()),
        (3, &[5, 6, 7][..])
    );
}
