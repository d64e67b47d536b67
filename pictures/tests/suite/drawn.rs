//! What charts and views show, found in the SVG.

use ncc_pictures::{Chart, Record, View, charts, later, project, view};

use crate::made::{Made, part};

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
fn texts(svg: &str) -> Vec<&str> {
    svg.split("<text ")
        .skip(1)
        .map(|t| t.split_once(">\n").unwrap().1.split("\n</text>").next().unwrap())
        .collect()
}

/// What every picture has to be.
fn sound(svg: &str) {
    assert!(svg.starts_with("<svg width=") && svg.ends_with("</svg>\n"));
    assert_eq!(count(svg, "<svg"), 1);
    assert_eq!(count(svg, "</svg>"), 1);
    assert_eq!(count(svg, "<text"), count(svg, "</text>"));
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
    let svg = charts(&[&record], &Chart::ALL, "a machine").unwrap();
    sound(&svg);
    let texts = texts(&svg);
    for text in
        ["made.nc", "Spindle (rev/min)", "Tool", "T1", "T12", "Position (mm)", "Time (s)", "X", "Y", "Z"]
    {
        assert!(texts.contains(&text), "{text}: {texts:?}");
    }
    assert_eq!(count(&svg, "class=\"curve"), 5);
    let speed = charts(&[&record], &[Chart::Speed], "").unwrap();
    sound(&speed);
    assert_eq!(count(&speed, "class=\"curve"), 1);
    assert!(!speed.contains("Tool"));
    // 0 until 9 s, up, and down when the spindle has stopped.
    let curve = path(&speed, "curve p0");
    assert_eq!(numbers(curve).len(), 2 * 5, "{curve}");
}

#[test]
fn a_plan_has_one_scale_and_all_holes() {
    let record = part();
    let svg = view(&[&record], View::Plan, "a machine").unwrap();
    sound(&svg);
    assert_eq!(count(path(&svg, "holes"), "M"), 3);
    // A hole goes straight down: from above there is only its mark.
    assert_eq!(count(&svg, "class=\"hole\""), 0);
    // The circle is as wide as it is high.
    let (mut x, mut y) = (0, 0);
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for pair in numbers(path(&svg, "arc")).chunks(2) {
        (x, y) = (x + pair[0], y + pair[1]);
        xs.push(x);
        ys.push(y);
    }
    let size = |v: &[i32]| v.iter().max().unwrap() - v.iter().min().unwrap();
    assert!((size(&xs) - size(&ys)).abs() <= 4, "{} {}", size(&xs), size(&ys));
    let texts = texts(&svg);
    for text in ["rapid", "feed", "arc", "hole", "start", "end", "X (mm)", "Y (mm)"] {
        assert!(texts.contains(&text), "{text}");
    }
}

/// Numbers of a path, where a minus may stand for the space between two.
fn numbers(d: &str) -> Vec<i32> {
    let apart = d.replace('-', " -");
    apart.split(['M', 'l', ' ']).filter_map(|number| number.parse().ok()).collect()
}

#[test]
fn an_isometric_view_shows_depth() {
    let svg = view(&[&part()], View::Isometric, "a machine").unwrap();
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
        sound(&charts(&[&record], &Chart::ALL, "").unwrap());
        sound(&charts(&[&record, &part()], &Chart::ALL, "").unwrap());
        sound(&charts(&[&record], &[], "").unwrap());
        for from in [View::Plan, View::Isometric] {
            sound(&view(&[&record], from, "").unwrap());
            sound(&view(&[&part(), &record], from, "").unwrap());
        }
    }
}

#[test]
fn text_does_not_become_markup() {
    let mut record = part();
    record.name = "a</text><script>alert(1)</script>&\"'.nc".to_owned();
    for svg in [
        charts(&[&record], &Chart::ALL, "<b>&").unwrap(),
        view(&[&record], View::Plan, "<b>&").unwrap(),
        charts(&[&record, &record], &Chart::ALL, "<b>&").unwrap(),
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
    let svg = charts(&[&a, &b], &Chart::ALL, "").unwrap();
    sound(&svg);
    // Speed, feed, X, Y and Z of both, and how much later.
    assert_eq!(count(&svg, "class=\"curve"), 11);
    assert!(texts(&svg).iter().any(|text| text.contains("+2.000 s")), "{:?}", texts(&svg));
    let mut longer = Made::new();
    longer.rapid([1.0, 0.0, 0.0], 1.0);
    let longer = longer.finish();
    assert!(later(&a, &longer).is_none());
    assert!(!charts(&[&a, &longer], &Chart::ALL, "").unwrap().contains("Later"));
}
