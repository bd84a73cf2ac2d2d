//! Table 1: speeds against the kd-tree's single rays in the same round.

use super::Settings;
use super::frames::Frame;
use super::methods::{Method, Way};
use super::published::{self, PublishedSpeeds};
use crate::measure::{self, Timings};
use crate::rays::Question;
use crate::report::document::{DocumentTable, Figure, TableRow};
use crate::report::model::Spread;

/// By method, then by frame, what the rounds gave; nothing where a method is not
/// timed.
pub(super) struct Speeds {
    timings: Vec<Vec<Timings>>,
}

/// Where the methods stand that others are compared with.
const KD_TREE: usize = 0;
const KD_TREE_PACKETS: usize = 5;

impl Speeds {
    /// Times all methods on all frames, interleaved.
    pub(super) fn new(methods: &[Method], frames: &[Frame], settings: &Settings) -> Self {
        let structures: Vec<_> = methods
            .iter()
            .map(|method| method.structure.as_ref())
            .collect();
        let sets: Vec<_> = frames.iter().map(|frame| frame.set.clone()).collect();
        let is_timed = |method: usize, frame: usize| match methods[method].way {
            Way::Single | Way::AnyPackets => true,
            Way::Unconfirmed => frames[frame].set.kind.question() == Question::Closest,
            Way::Packets => frames[frame].is_coherent,
        };
        Self {
            timings: measure::time_rounds(&structures, &sets, settings.rounds, is_timed, || ()),
        }
    }

    /// The speed of a method over that of another, round by round.
    fn ratio(&self, method: usize, base: usize, frame: usize) -> Option<Spread> {
        let own = &self.timings[method][frame].mrays_per_second;
        let other = &self.timings[base][frame].mrays_per_second;
        let ratios: Vec<f64> = own
            .iter()
            .zip(other)
            .map(|(own, other)| own / other)
            .collect();
        (!ratios.is_empty()).then(|| Spread::with_confidence(&ratios))
    }

    fn mrays_per_second(&self, method: usize, frame: usize) -> Option<f64> {
        let own = &self.timings[method][frame].mrays_per_second;
        (!own.is_empty()).then(|| Spread::of(own).median)
    }

    /// A row for every method, with a column for every frame and one for packets
    /// against the kd-tree's; the published figures below.
    pub(super) fn table(&self, scene: &str, methods: &[Method], frames: &[Frame]) -> DocumentTable {
        let percent = |ratio: Option<Spread>| ratio.map_or(Figure::None, Figure::Percent);
        let mut rows = Vec::new();
        for (position, method) in methods.iter().enumerate() {
            let mut figures = vec![Figure::Text(method.name.to_owned())];
            for frame in 0..frames.len() {
                let speed = self.mrays_per_second(position, frame);
                figures.push(speed.map_or(Figure::None, |speed| Figure::number(speed, 3, "")));
                figures.push(percent(self.ratio(position, KD_TREE, frame)));
            }
            let is_packet = matches!(method.way, Way::Packets | Way::AnyPackets);
            let of_packets = is_packet.then(|| self.ratio(position, KD_TREE_PACKETS, 0));
            figures.push(percent(of_packets.flatten()));
            rows.push(TableRow {
                is_published: false,
                figures,
            });
        }
        let mut headings = vec!["method"];
        for frame in frames {
            let [speed, ratio] = match frame.name {
                "ray cast" => ["ray cast\nMrays/s", "of the\nkd-tree"],
                "path traced" => ["path traced\nMrays/s", "of the\nkd-tree"],
                "hot spot" => ["hot spot\nMrays/s", "of the\nkd-tree"],
                _ => ["transparent\nMrays/s", "of the\nkd-tree"],
            };
            headings.extend([speed, ratio]);
        }
        headings.push("ray cast, of\nits packets");
        let mut caption = "Table 1: speed".to_owned();
        if let Some(published) = published::find(scene) {
            caption = format!(
                "{caption}; in italics {} of {}, transparent its truck",
                published.name,
                super::SOURCE
            );
            rows.extend(published_rows(methods, frames, |frame| match frame {
                "ray cast" => Some(published.ray_cast),
                "path traced" => published.path_traced,
                "transparent" => Some(published::TRUCK),
                _ => None,
            }));
        }
        DocumentTable {
            caption,
            headings,
            rows,
        }
    }
}

fn published_rows(
    methods: &[Method],
    frames: &[Frame],
    speeds: impl Fn(&str) -> Option<PublishedSpeeds>,
) -> Vec<TableRow> {
    let speed_of = |method: &str, speeds: &PublishedSpeeds| match method {
        "kd-tree" => Some(speeds.single[3]),
        "BSP-orig" => Some(speeds.single[0]),
        "BSP" => Some(speeds.single[1]),
        "BSP-tri unconfirmed" => Some(speeds.single[2]),
        "BSP packets" => speeds.packets[0],
        "kd-tree packets" => speeds.packets[1],
        "BVH packets" => speeds.packets[2],
        _ => None,
    };
    let percent = |own: Option<f64>, base: Option<f64>| match own.zip(base) {
        Some((own, base)) => Figure::number(100.0 * own / base, 0, " %"),
        None => Figure::None,
    };
    let mut rows = Vec::new();
    for method in methods {
        let of = |frame: &Frame| speed_of(method.name, &speeds(frame.name)?);
        if frames.iter().all(|frame| of(frame).is_none()) {
            continue;
        }
        let mut figures = vec![Figure::Text(format!("{}, published", method.name))];
        for frame in frames {
            let base = speeds(frame.name).map(|speeds| speeds.single[3]);
            figures.extend([Figure::None, percent(of(frame), base)]);
        }
        let packets = speeds("ray cast").and_then(|speeds| speeds.packets[1]);
        let is_packet = matches!(method.way, Way::Packets | Way::AnyPackets);
        let own = frames.first().and_then(of).filter(|_| is_packet);
        figures.push(percent(own, packets));
        rows.push(TableRow {
            is_published: true,
            figures,
        });
    }
    rows
}
