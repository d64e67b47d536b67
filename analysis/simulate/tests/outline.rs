//! Outlines of tools lie on their surface.

use ncc_simulate::{Cutter, Shape};

#[test]
fn an_outline_goes_from_the_axis_to_the_radius_on_the_surface() {
    let shapes = [
        (Shape::Flat, 0.0),
        (Shape::Ball, 5.0),
        (Shape::BullNose { corner: 1.0 }, 1.0),
        (Shape::Drill { point: 90.0 }, 5.0),
        (Shape::Chamfer { tip: 4.0, angle: 90.0 }, 3.0),
    ];
    for (shape, top) in shapes {
        let cutter = Cutter::new(&shape, 10.0, 30.0).expect("a tool");
        let outline = cutter.outline();
        assert_eq!(outline[0][0], 0.0, "{shape:?}");
        let last = outline.last().expect("points");
        assert!((last[0] - 5.0).abs() < 1e-9 && (last[1] - top).abs() < 1e-9, "{shape:?}: {last:?}");
        for [radius, height] in outline {
            let own = cutter.height(radius).expect("within the tool");
            assert!((own - height).abs() < 1e-9, "{shape:?} at {radius}: {own}, {height}");
        }
    }
}
