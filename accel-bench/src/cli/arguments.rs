//! What can be asked for.

use std::path::PathBuf;

use accel_core::InvalidPrimitives;
use clap::builder::RangedU64ValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::paper::sbvh;
use crate::rays::RayKind;
use crate::scene::camera::Camera;
use crate::scene::rotation::Rotation;

/// Compares ray-tracing acceleration structures. No row is printed unless its
/// hits equal brute force's, bit for bit.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub compare: CompareOptions,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Compare structures: build time, memory, speed, counts (the default)
    Compare(CompareOptions),
    /// Compare hits with brute force, ray by ray, and list any that differ
    Verify(VerifyOptions),
    /// Draw a scene, or what its rays cost, as a picture
    Render(RenderOptions),
    /// Measure what a paper measured, beside its published figures
    Paper(PaperOptions),
    /// List the embedded scenes, or write them as OBJ files
    Scenes(ScenesOptions),
}

/// What every command that loads scenes takes.
#[derive(Debug, Args)]
pub(super) struct SceneOptions {
    /// Where to look from: "eye;look-at;vertical-fov[;up]", each of eye, look-at
    /// and up as x,y,z, the field of view in degrees. Chosen to see the scene if
    /// left out.
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true)]
    pub camera: Option<Camera>,
    /// Turn the scene and its camera about the axes, in degrees: first about x,
    /// then about y, then about z
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub rotate: Option<Rotation>,
    /// Leave out triangles with corners that are not finite numbers
    #[arg(long)]
    pub skip_invalid: bool,
    /// Threads to use; 0 means all
    #[arg(long, default_value_t = 0, value_parser = between(0, MOST_THREADS), value_name = "N")]
    pub threads: usize,
    /// Seed of everything random
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub seed: u64,
}

impl SceneOptions {
    pub(super) fn invalid(&self) -> InvalidPrimitives {
        if self.skip_invalid {
            InvalidPrimitives::Skip
        } else {
            InvalidPrimitives::Reject
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct CompareOptions {
    /// Embedded scenes by name, `name@count` for another size, or OBJ files; three embedded ones if left out
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Structures by name, or `all`; one or a few of each crate if left out
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub structures: Vec<String>,
    /// Kinds of rays: primary, shadow, ao, path, random, transparent
    #[arg(long, value_delimiter = ',', value_name = "KIND")]
    pub rays: Vec<RayKind>,
    /// Pixels, across and down
    #[arg(long, default_value = "256x192", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
    /// Rounds of timing; every round goes around all structures
    #[arg(long, default_value_t = 5, value_parser = between(1, MOST_ROUNDS), value_name = "N")]
    pub rounds: usize,
    /// Write all figures as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write all figures as CSV
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Where to write the report: index.html, report.json, report.csv
    #[arg(long, default_value = "accel-report", value_name = "DIR")]
    pub report: PathBuf,
    #[command(flatten)]
    pub scene: SceneOptions,
}

#[derive(Debug, Args)]
pub(super) struct VerifyOptions {
    /// Embedded scenes by name, `name@count` for another size, or OBJ files
    #[arg(value_name = "SCENE", required = true)]
    pub scenes: Vec<String>,
    /// Rays of each kind
    #[arg(long, default_value_t = 10_000, value_parser = between(1, MOST_RAYS), value_name = "N")]
    pub rays: usize,
    /// Kinds of rays by the names that `verify` prints, such as `path,edges`; all if left out
    #[arg(long, value_delimiter = ',', value_name = "KIND")]
    pub kinds: Vec<String>,
    /// Structures by name, or `all`
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub structures: Vec<String>,
    #[command(flatten)]
    pub scene: SceneOptions,
}

#[derive(Debug, Args)]
pub(super) struct RenderOptions {
    /// An embedded scene by name, or an OBJ file
    #[arg(value_name = "SCENE")]
    pub scene_name: String,
    /// The structure to trace with
    #[arg(long, default_value = "bvh-sweep", value_name = "NAME")]
    pub structure: String,
    /// What to show
    #[arg(long, value_enum, default_value_t = Show::Shaded)]
    pub show: Show,
    /// The picture to write
    #[arg(short, long, default_value = "render.png", value_name = "FILE")]
    pub output: PathBuf,
    /// Pixels, across and down
    #[arg(long, default_value = "960x720", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
    #[command(flatten)]
    pub scene: SceneOptions,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Show {
    /// The scene, lit from the camera
    Shaded,
    /// Geometric normals as colours
    Normals,
    /// Nodes visited per pixel
    Nodes,
    /// Planes tested per pixel; a box counts six
    Planes,
    /// Triangles tested per pixel
    Tests,
    /// Nodes visited plus triangles tested per pixel
    Cost,
    /// Time per pixel
    Time,
}

#[derive(Debug, Args)]
pub(super) struct PaperOptions {
    /// The paper
    #[arg(value_enum)]
    pub paper: Paper,
    /// Embedded scenes by name, `name@count` for another size, or OBJ files; the paper's cases among the
    /// embedded ones if left out
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Pixels of each viewpoint, across and down
    #[arg(long, default_value = "256x192", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
    /// Viewpoints: the camera, and as many more around it; `dual-split` and `bsp` have one
    #[arg(long, default_value_t = 4, value_parser = between(1, MOST_VIEWPOINTS), value_name = "N")]
    pub viewpoints: usize,
    /// How long ambient occlusion rays are, in diagonals of the scene
    #[arg(long, default_value_t = sbvh::AMBIENT_LENGTH, value_name = "LENGTH")]
    pub ambient_length: f32,
    /// Rounds of timing; every round goes around all structures
    #[arg(long, default_value_t = 9, value_parser = between(1, MOST_ROUNDS), value_name = "N")]
    pub rounds: usize,
    /// Where to write the report: index.html, report.json
    #[arg(long, default_value = "accel-report", value_name = "DIR")]
    pub report: PathBuf,
    #[command(flatten)]
    pub scene: SceneOptions,
}

/// A paper whose tables can be measured again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Paper {
    /// Stich, Friedrich and Dietrich 2009: Table 1, Figure 5 and the memory limit
    Sbvh,
    /// Lin, Shkurko, Mallett and Yuksel 2019: Tables 1 to 3 and Figure 10
    DualSplit,
    /// Ize, Wald and Parker 2008: Tables 1 to 3, Figure 3, sweeps of C_i and epsilon, a hot
    /// spot, transparent rays
    Bsp,
}

#[derive(Debug, Args)]
pub(super) struct ScenesOptions {
    /// Write every embedded scene as an OBJ file into this folder
    #[arg(long, value_name = "DIR")]
    pub export: Option<PathBuf>,
}

/// The most threads that can be asked for.
const MOST_THREADS: u64 = 1024;

/// The most rounds of timing: as many as the interval around a median is worked
/// out for.
const MOST_ROUNDS: u64 = 1000;

/// The most rays of a kind that are compared with brute force.
const MOST_RAYS: u64 = 1_000_000;

/// The most viewpoints.
const MOST_VIEWPOINTS: u64 = 1024;

/// Parses a number from `least` to `most`.
fn between(least: u64, most: u64) -> RangedU64ValueParser<usize> {
    RangedU64ValueParser::new().range(least..=most)
}

/// The most pixels that a side may have.
const LARGEST_SIDE: u32 = 16_384;

/// Parses "WxH".
fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']);
    let parsed = sides.map(|(width, height)| (width.trim().parse(), height.trim().parse()));
    match parsed {
        Some((Ok(width), Ok(height)))
            if (1..=LARGEST_SIDE).contains(&width) && (1..=LARGEST_SIDE).contains(&height) =>
        {
            Ok((width, height))
        }
        _ => Err(format!(
            "`{text}` is not WxH with sides of 1 to {LARGEST_SIDE} pixels, such as 640x480"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_are_two_numbers_within_limits() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for bad in ["640", "0x5", "5x0", "x", "99999x1", "-1x1", "1x1x1"] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn numbers_of_what_takes_time_and_memory_have_limits() {
        let parsed = |option, value: &str| {
            Arguments::try_parse_from(["accel-bench", "paper", "sbvh", option, value])
        };
        let most = [
            ("--viewpoints", MOST_VIEWPOINTS),
            ("--rounds", MOST_ROUNDS),
            ("--threads", MOST_THREADS),
        ];
        for (option, most) in most {
            assert!(parsed(option, &most.to_string()).is_ok());
            for bad in ["many", "18446744073709551615", &(most + 1).to_string()] {
                let error = parsed(option, bad).unwrap_err().to_string();
                assert!(error.contains(option) && error.contains(bad), "{error}");
            }
        }
        assert!(parsed("--rounds", "0").is_err() && parsed("--viewpoints", "0").is_err());
    }

    #[test]
    fn compare_is_the_default_command() {
        let bare = Arguments::try_parse_from(["accel-bench", "--rays", "ao,path"]).unwrap();
        assert!(bare.command.is_none());
        assert_eq!(
            bare.compare.rays,
            [RayKind::AmbientOcclusion, RayKind::Path]
        );
    }
}
