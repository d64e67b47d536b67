//! Tools that a Sinumerik calls by name, with the radius of their edges.

use std::fs;

use super::*;

/// Two tools, one of them beside a contour.
const NAMED: &str = "G17 G71 G90 G54 G40\nT=\"MILL\"\nM6\nD1 S3000 M3 F1000\nG0 X-78 Y-30\nZ50\nG1 Z-5\nG1 G41 X-48\nY10\n\
                     X48\nG1 G40 X80\nG0 Z50\nT=\"DRILL\" M6\nD1 S1000 M3\nG0 Z10\nM30\n";

/// One whose contour is begun in a loop.
const LOOP: &str = "G17 G71 G90 G54 G40\nT=\"MILL\" M6\nD1 S3000 M3 F1000\nR1=10\nG0 X0 Y0\nZ5\nG1 Z-1\nWHILE R1<=12\n\
                    G1 G41 Y=R1\nG2 X0 Y=R1 I0 J=-R1\nG1 G40 X0 Y0\nR1=R1+1\nENDWHILE\nG0 Z50\nM30\n";

fn say(folder: &Path, line: &str) -> Done {
    ncc(folder, &line.split(' ').collect::<Vec<_>>())
}

#[test]
fn the_radius_of_a_tool_by_name_is_that_of_its_number() {
    let folder = folder();
    let at = folder.path();
    for (name, text) in [("named.mpf", NAMED), ("loop.mpf", LOOP)] {
        fs::write(at.join(name), text).unwrap();
        for to in ["fanuc", "haas", "linuxcnc"] {
            let done = say(at, &format!("siemens to {to} {name}")).exits(0);
            assert!(done.out.contains("G41 D1 "), "{name} to {to}: {}", done.out);
        }
    }
    // By the profile's numbers; and where the profile has another entry for the length, in the order of use.
    for (entry, says) in [("", "G41 D7 "), ("length_entry = 27\n", "G41 D1 ")] {
        let machine = format!(
            "id = \"shop\"\ntitle = \"Shop\"\ndialect = \"fanuc\"\n[[tool]]\nnumber = 7\nname = \"MILL\"\n{entry}\
             [[tool]]\nnumber = 3\nname = \"DRILL\"\n"
        );
        fs::write(at.join("shop.toml"), machine).unwrap();
        let done = say(at, "siemens to fanuc named.mpf --machine-to shop.toml").exits(0);
        assert!(done.out.contains(says), "{}", done.out);
    }
}
