//! A part as a file: a picture (PNG, SVG) or a body (STL), and bodies from files.

use std::io::{self, Cursor, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ncc_simulate::{AlarmKind, COLOURS, HeightMap, Look, Picture, RAW, Triangle, draw, mesh};

use super::cut::CutProgram;
use super::told;

/// Corners along a side of the body in a file, at most: half a million triangles are what other programs open at once.
const CORNERS: usize = 512;

/// Where the body ends below: the lowest place of the raw part, mm.
pub fn floor(cut: &CutProgram) -> f32 {
    cut.simulation.setup().stock.extent()[0][2] as f32
}

/// A picture of the part as it is shown, so many pixels along its longer side.
pub fn picture(cut: &CutProgram, look: Look, pixels: usize) -> Picture {
    let moves = cut.simulation.moves();
    let tool = |number: u32| moves.get(number as usize - 1).map_or(0, |own| own.tool);
    draw(cut.simulation.map(), floor(cut), look, pixels, &tool)
}

/// A picture as PNG.
///
/// # Errors
/// What the encoder says of its size.
pub fn png(picture: &Picture) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let [width, height] = [picture.width, picture.height].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// A sheet: the part from above and from a corner, its tools, and where there are alarms.
///
/// # Errors
/// As of [`png()`].
pub fn svg(cut: &CutProgram, title: &str) -> io::Result<String> {
    let [plan, corner] = [Look::Plan, Look::Corner].map(|look| picture(cut, look, 900));
    let grid = cut.simulation.map().grid;
    let scale = 480.0 / (grid.cells[0].max(grid.cells[1]) as f64 * grid.cell);
    let sides = grid.cells.map(|cells| cells as f64 * grid.cell * scale);
    let aside = 480.0 * corner.height as f64 / corner.width.max(corner.height) as f64;
    let wide = 480.0 * corner.width as f64 / corner.width.max(corner.height) as f64;
    let high = sides[1].max(aside);
    let legend = cut.path.tools.len() + 1;
    let total = 72.0 + high + 20.0 * legend as f64 + 16.0;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1040\" height=\"{total:.0}\" \
         viewBox=\"0 0 1040 {total:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"24\" y=\"30\" font-size=\"16\">{}</text>\n",
        escaped(title)
    );
    let mut image = |own: &Picture, x: f64, width: f64, height: f64| -> io::Result<()> {
        let data = BASE64_STANDARD.encode(png(own)?);
        text.push_str(&format!(
            "<image x=\"{x:.1}\" y=\"48\" width=\"{width:.1}\" height=\"{height:.1}\" \
             href=\"data:image/png;base64,{data}\"/>\n"
        ));
        Ok(())
    };
    image(&plan, 24.0, sides[0], sides[1])?;
    image(&corner, 536.0, wide, aside)?;
    text.push_str(&format!(
        "<rect x=\"24\" y=\"48\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#888\"/>\n",
        sides[0], sides[1]
    ));
    for alarm in cut.alarms() {
        let at = [alarm.place[0] - grid.low[0], alarm.place[1] - grid.low[1]].map(|at| at * scale);
        let colour = if alarm.kind == AlarmKind::Rapid { "#d00" } else { "#a0a" };
        text.push_str(&format!(
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"6\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\">\
             <title>{}</title></circle>\n",
            24.0 + at[0],
            48.0 + sides[1] - at[1],
            escaped(&told::headline(alarm, cut))
        ));
    }
    let mut y = 72.0 + high;
    let rows = std::iter::once((RAW, told::raw_headline(cut))).chain(
        told::tool_headlines(cut).into_iter().enumerate().map(|(n, name)| (COLOURS[n % COLOURS.len()], name)),
    );
    for ([r, g, b], name) in rows {
        text.push_str(&format!(
            "<rect x=\"24\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>\
             <text x=\"44\" y=\"{y:.1}\">{}</text>\n",
            y - 11.0,
            escaped(&name)
        ));
        y += 20.0;
    }
    text.push_str("</svg>\n");
    Ok(text)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The part as a body of triangles, binary.
///
/// # Errors
/// As of writing to memory.
pub fn stl(map: &HeightMap, floor: f32) -> io::Result<Vec<u8>> {
    let step = map.grid.cells[0].max(map.grid.cells[1]).div_ceil(CORNERS);
    let mut all = Vec::new();
    mesh(map, floor, step, &mut |triangle| all.push(solid(triangle)));
    let mut bytes = Cursor::new(Vec::new());
    stl_io::write_stl(&mut bytes, all.iter())?;
    bytes.flush()?;
    Ok(bytes.into_inner())
}

fn solid(corners: Triangle) -> stl_io::Triangle {
    let [a, b, c] = corners;
    let along = |to: [f32; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (along(b), along(c));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = normal.iter().map(|part| part * part).sum::<f32>().sqrt().max(f32::MIN_POSITIVE);
    stl_io::Triangle {
        normal: stl_io::Normal::new(normal.map(|part| part / length)),
        vertices: corners.map(stl_io::Vertex::new),
    }
}

/// The triangles of a file, text or binary.
///
/// # Errors
/// It is no such file.
pub fn read_stl(bytes: &[u8]) -> io::Result<Vec<Triangle>> {
    let mut bytes = Cursor::new(bytes);
    let all = stl_io::create_stl_reader(&mut bytes)?;
    all.map(|own| own.map(|own| own.vertices.map(|corner| [corner[0], corner[1], corner[2]]))).collect()
}
