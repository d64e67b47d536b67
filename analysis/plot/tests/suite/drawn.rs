//! What charts and views show, found in the SVG.

use ncc_plot::{Chart, Record, Stroke, View, charts, later, project, view};

use crate::made::{Made, part};
use crate::svg::{Element, elements, pieces};

fn count(text: &str, what: &str) -> usize {
    text.matches(what).count()
}

/// Attribute `d` of the path of a class.
fn path<'t>(svg: &'t str, class: &str) -> &'t str {
    let element = svg.split("<path ").find(|element| element.starts_with(&format!("class=\"{class}\"")));
    let element = element.unwrap_or_else(|| panic!("no {class}"));
    element.split(" d=\"").nth(1).unwrap().split('"').next().unwrap()
}

/// Texts of a picture.
fn texts(picture: &str) -> Vec<String> {
    let texts = elements(picture).into_iter().filter(|element| element.name == "text");
    texts.map(|element| element.text).collect()
}

/// What every picture has to be.
fn sound(svg: &str) {
    assert!(svg.starts_with("<svg width=") && svg.ends_with("</svg>\n"));
    assert!(elements(svg).len() > 1);
    for wrong in ["NaN", "inf", "--"] {
        assert!(!svg.contains(wrong), "{wrong}");
    }
}

#[test]
fn a_record_tells_what_happened() {
    let record = part();
    assert!((record.end - 36.6).abs() < 1e-9);
    assert_eq!((record.sums.holes, record.sums.changes, record.sums.moves), (3, 2, 12));
    assert!((record.sums.cutting - 16.0).abs() < 1e-9 && (record.sums.rapid - 1.1).abs() < 1e-9);
    assert!((record.sums.idle - 19.5).abs() < 1e-9);
    assert_eq!(record.way.extent.low, [0.0, 0.0, -8.0]);
    // The circle's ends are at its right; its top and bottom are of its chords.
    assert!((record.way.extent.high[1] - 30.0).abs() < 1e-6);
    let tenths = |time: f64| (time * 10.0).round() as i64;
    let tools: Vec<_> = record.tools.iter().map(|t| (t.tool, tenths(t.start), tenths(t.end))).collect();
    assert_eq!(tools, [(1, 70, 210), (12, 280, 366)]);
    // A value that is set is so when its function is over; a move has its rate while it lasts.
    assert_eq!(record.speed.polyline(36.6)[..3], [(0.0, 0.0), (9.0, 0.0), (9.0, 1263.0)]);
    let rate = (40.0f64.powi(2) + 36.0).sqrt() / 4.0 * 60.0;
    let feed = record.feed.polyline(36.6);
    assert!(feed.iter().any(|p| p.0 == 9.5 && (p.1 - rate).abs() < 1e-6));
    assert!(feed.iter().any(|p| p.0 == 13.5 && (p.1 - rate).abs() < 1e-6));
}

#[test]
fn charts_have_what_is_asked_for() {
    let record = part();
    let svg = charts(&[&record], &Chart::ALL, "a machine");
    sound(&svg);
    let texts = texts(&svg);
    for text in
        ["made.nc", "Spindle (rev/min)", "Tool", "T1", "T12", "Position (mm)", "Time (s)", "X", "Y", "Z"]
    {
        assert!(texts.iter().any(|t| t == text), "{text}: {texts:?}");
    }
    assert_eq!(count(&svg, "class=\"curve"), 5);
    let speed = charts(&[&record], &[Chart::Speed], "");
    sound(&speed);
    assert_eq!(count(&speed, "class=\"curve"), 1);
    assert!(!speed.contains("Tool"));
    // 0 until 9 s, up, and down when the spindle has stopped.
    let curve = path(&speed, "curve p0");
    assert_eq!(pieces(curve)[0].len(), 5, "{curve}");
}

#[test]
fn a_plan_has_one_scale_and_all_holes() {
    let record = part();
    let svg = view(&[&record], View::Plan, "a machine");
    sound(&svg);
    assert_eq!(count(path(&svg, "holes"), "M"), 3);
    // A hole goes straight down: from above there is only its mark.
    assert_eq!(count(&svg, "class=\"hole\""), 0);
    // The circle is as wide as it is high.
    let (xs, ys): (Vec<i32>, Vec<i32>) = pieces(path(&svg, "arc")).into_iter().flatten().unzip();
    let size = |v: &[i32]| v.iter().max().unwrap() - v.iter().min().unwrap();
    assert!((size(&xs) - size(&ys)).abs() <= 4, "{} {}", size(&xs), size(&ys));
    let texts = texts(&svg);
    for text in ["rapid", "feed", "arc", "hole", "start", "end", "X (mm)", "Y (mm)"] {
        assert!(texts.iter().any(|t| t == text), "{text}");
    }
}

/// Mm and units of an axis: how a position on the page becomes a coordinate again, from two numbers
/// at its marks. `along` is the attribute of a text that changes from mark to mark.
fn back(marks: &[&Element], along: &str) -> impl Fn(f64) -> f64 {
    let known = |mark: &Element| {
        let value: f64 = mark.text.replace('\u{2212}', "-").replace('\u{202f}', "").parse().unwrap();
        (value, mark.number(along))
    };
    let (first, last) = (known(marks[0]), known(marks[marks.len() - 1]));
    move |at| first.0 + (at - first.1) * (last.0 - first.0) / (last.1 - first.1)
}

#[test]
fn a_plan_shows_every_leg_and_label_and_the_whole_extent() {
    // Points apart from each other and no straight run, so that each leg is a line of the picture.
    let mut made = Made::new();
    made.rapid([-20.0, 10.0, 5.0], 1.0);
    made.feed([35.0, 10.0, 5.0], 1.0);
    made.feed([35.0, 42.5, 5.0], 1.0);
    made.feed([10.0, 30.0, 5.0], 1.0);
    made.rapid([0.0, 0.0, 5.0], 1.0);
    made.feed([5.0, -7.0, 5.0], 1.0);
    let record = made.finish();
    let svg = view(&[&record], View::Plan, "a machine");
    sound(&svg);
    for (stroke, class) in [(Stroke::Rapid, "rapid"), (Stroke::Feed, "feed")] {
        let legs = record.way.legs.iter().filter(|leg| leg.stroke == stroke).count();
        let lines: usize = pieces(path(&svg, class)).iter().map(|piece| piece.len() - 1).sum();
        assert_eq!(lines, legs, "{class}");
    }
    let all = elements(&svg);
    let texts: Vec<&Element> = all.iter().filter(|element| element.name == "text").collect();
    // Numbers of the level axis hang below their marks, those of the upright axis end left of them.
    let level: Vec<&Element> = texts.iter().copied().filter(|t| t.get("dy") == "0.76em").collect();
    let upright: Vec<&Element> = texts.iter().copied().filter(|t| t.get("text-anchor") == "end").collect();
    let words = |marks: &[&Element]| marks.iter().map(|mark| mark.text.clone()).collect::<Vec<_>>().join(" ");
    assert_eq!(words(&level), "\u{2212}20 \u{2212}10 0 10 20 30");
    assert_eq!(words(&upright), "0 10 20 30 40");
    let others: Vec<&str> = texts
        .iter()
        .filter(|t| !level.contains(t) && !upright.contains(t))
        .map(|t| t.text.as_str())
        .collect();
    assert_eq!(
        others,
        ["made.nc, plan", "6.000 s \u{b7} a machine", "Y (mm)", "X (mm)", "rapid", "feed", "start", "end",]
    );
    // A line of the grid for each number, and a mark.
    let marks = level.len() + upright.len();
    assert_eq!(pieces(path(&svg, "grid")).len(), marks);
    assert_eq!(pieces(path(&svg, "axis")).len(), marks + 2);
    // The lines in mm are the program's extent.
    let (x, y) = (back(&level, "x"), back(&upright, "y"));
    let points = ["rapid", "feed"].map(|class| pieces(path(&svg, class))).into_iter().flatten().flatten();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points {
        for (i, value) in [x(f64::from(point.0)), y(f64::from(point.1))].into_iter().enumerate() {
            low[i] = low[i].min(value);
            high[i] = high[i].max(value);
        }
    }
    for i in 0..2 {
        assert!((low[i] - record.way.extent.low[i]).abs() < 0.02, "{low:?}");
        assert!((high[i] - record.way.extent.high[i]).abs() < 0.02, "{high:?}");
    }
}

#[test]
fn an_isometric_view_shows_depth() {
    let svg = view(&[&part()], View::Isometric, "a machine");
    sound(&svg);
    assert_eq!(count(path(&svg, "hole"), "M"), 3);
    assert_eq!(count(path(&svg, "holes"), "M"), 3);
    // All three axes at one scale: unit vectors are of one length on paper.
    let long = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|p| {
        let [x, y] = project(View::Isometric, p);
        x.hypot(y)
    });
    assert!(long.iter().all(|l| (l - (2.0f64 / 3.0).sqrt()).abs() < 1e-12));
}

#[test]
fn degrees_are_no_way() {
    let mut made = Made::new();
    made.turn(90.0, 3.0);
    let record = made.finish();
    assert_eq!((record.sums.rapid, record.sums.rapid_way, record.stands_still()), (3.0, 0.0, true));
    assert!(!part().stands_still());
}

#[test]
fn pictures_of_little_are_pictures_still() {
    let nothing = || {
        let mut record = Record::new("");
        record.finish();
        record
    };
    let standing = || {
        let mut made = Made::new();
        made.tool(3, 5.0);
        made.finish()
    };
    let point = || {
        let mut made = Made::new();
        made.feed([0.0; 3], 0.0);
        made.finish()
    };
    let timeless = || {
        let mut made = Made::new();
        made.rapid([10.0, 0.0, 0.0], 0.0);
        made.rapid([10.0, 10.0, 0.0], 0.0);
        made.finish()
    };
    let upright = || {
        let mut made = Made::new();
        made.feed([0.0, 0.0, -5.0], 2.0);
        made.finish()
    };
    for record in [nothing(), standing(), point(), timeless(), upright()] {
        sound(&charts(&[&record], &Chart::ALL, ""));
        sound(&charts(&[&record, &part()], &Chart::ALL, ""));
        sound(&charts(&[&record], &[], ""));
        for from in [View::Plan, View::Isometric] {
            sound(&view(&[&record], from, ""));
            sound(&view(&[&part(), &record], from, ""));
        }
    }
}

#[test]
fn text_does_not_become_markup() {
    let mut record = part();
    record.name = "a</text><script>alert(1)</script>&\"'\u{1}.nc".to_owned();
    for svg in [
        charts(&[&record], &Chart::ALL, "<b>&"),
        view(&[&record], View::Plan, "<b>&"),
        charts(&[&record, &record], &Chart::ALL, "<b>&"),
    ] {
        sound(&svg);
        assert!(!svg.contains("<script") && !svg.contains("<b>"));
    }
}

#[test]
fn two_programs_lie_over_each_other() {
    let (a, mut b) = (part(), Made::new());
    // The same moves, the change of the tool a second longer.
    b.tool(1, 8.0);
    b.spindle(1263, 2.0);
    b.rapid([0.0, 20.0, 5.0], 0.5);
    b.feed([40.0, 20.0, -1.0], 4.0);
    b.circle([30.0, 20.0], 6.0);
    b.dwell(1.5);
    b.tool(12, 8.0);
    for x in [10.0, 20.0, 30.0] {
        b.hole([x, 5.0], -8.0);
    }
    b.spindle(0, 2.0);
    let b = b.finish();
    let off = later(&a, &b).unwrap();
    assert_eq!(off.first().map(|p| p.1), Some(0.0));
    assert!((off[1].1 - 1.0).abs() < 1e-9 && (off[off.len() - 1].1 - 2.0).abs() < 1e-9);
    let svg = charts(&[&a, &b], &Chart::ALL, "");
    sound(&svg);
    // Speed, feed, X, Y and Z of both, and how much later.
    assert_eq!(count(&svg, "class=\"curve"), 11);
    assert!(texts(&svg).iter().any(|text| text.contains("+2.000 s")), "{:?}", texts(&svg));
    let mut longer = Made::new();
    longer.rapid([1.0, 0.0, 0.0], 1.0);
    let longer = longer.finish();
    assert!(later(&a, &longer).is_none());
    assert!(!charts(&[&a, &longer], &Chart::ALL, "").contains("Later"));
}
