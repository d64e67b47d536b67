//! Subprograms that are files of their own, known by the extension of their names.

use std::fs;

use super::*;

const SLOT: &str = "G90 G0 X5 Y5\nG1 X10 F100\nM17\n";

#[test]
fn a_sinumerik_knows_a_subprogram_by_its_extension() {
    let folder = folder();
    let folder = folder.path();
    for name in ["slot.spf", "slot.mpf", "slot.txt"] {
        fs::write(folder.join(name), SLOT).unwrap();
    }
    // It says nothing that would be its caller's, and goes back to that.
    let sub = ncc(folder, &["siemens", "to", "fanuc", "slot.spf", "--units", "mm"]).exits(0).out;
    assert!(sub.contains("\nM99\n") && !sub.contains("M30") && !sub.contains("\nG54"), "{sub}");
    let main = ncc(folder, &["siemens", "to", "fanuc", "slot.mpf", "--units", "mm"]).exits(0).out;
    assert!(main.contains("\nM30\n") && main.contains("\nG54\n"), "{main}");
    let told = ncc(folder, &["siemens", "to", "fanuc", "slot.txt", "--units", "mm"]).exits(0);
    assert!(told.out.contains("\nM30\n"), "{}", told.out);
    told.says("M17 ends a main program = yes");
    // Back again, and into a control that calls a file by its name.
    let again = ncc(folder, &["siemens", "to", "siemens", "slot.spf", "--units", "mm"]).exits(0).out;
    assert!(again.ends_with("\nM17\n") && !again.contains("\nG54"), "{again}");
    let called = ncc(folder, &["siemens", "to", "linuxcnc", "slot.spf", "--units", "mm"]).exits(0).out;
    let whole = "\no<slot> sub\nG90 G0 X5 Y5\nG1 X10 F100\no<slot> endsub\nM2\n%\n";
    assert!(called.ends_with(whole) && !called.contains("G54\n"), "{called}");
    ncc(folder, &["siemens", "to", "mach9", "slot.spf"]).exits(1).says("but the text has no main program");
    // One of a Fanuc goes back too.
    fs::write(folder.join("slot.nc"), "%\nO9001\nG90 G0 X5. Y5.\nG1 X10. F100.\nM99\n%\n").unwrap();
    let other = ncc(folder, &["fanuc", "to", "siemens", "slot.nc", "--units", "mm"]).exits(0).out;
    assert!(other.ends_with("\nM17\n") && !other.contains("\nG54"), "{other}");
}

/// One that is longer than what is read at once states no modes either: they are its caller's.
#[test]
fn a_long_subprogram_states_no_modes() {
    let folder = folder();
    let folder = folder.path();
    let moves: String = (0..2000).map(|at| format!("X{at}. Y{}.\n", at % 7)).collect();
    let text = format!("%\nO9001\nG90 G01 X5. Y5. F100.\n{moves}M99\n%\n");
    fs::write(folder.join("long.nc"), text).unwrap();
    for to in ["haas", "siemens"] {
        let sub = ncc(folder, &["fanuc", "to", to, "long.nc", "--units", "mm", "--no-head"]).exits(0).out;
        assert!(!sub.contains("G54") && !sub.contains("M30"), "{sub}");
    }
}

/// A program that begins with a tool in the spindle, and its output, hold by themselves with what was stated.
#[test]
fn a_stated_tool_is_in_the_spindle_of_both() {
    let folder = folder();
    let folder = folder.path();
    let text = "%\nO0001\nG21 G17 G90 G94 G54 G40 G80\nG00 X0. Y0.\nG43 Z50.\nG01 Z40. F500.\nM30\n%\n";
    fs::write(folder.join("a.nc"), text).unwrap();
    let stated = ["--value", "#4120=2", "--value", "#4111=2"];
    let call = [&["fanuc", "to", "siemens", "a.nc", "-o", "a.mpf"][..], &stated].concat();
    ncc(folder, &call).exits(0);
    fs::write(folder.join("a.toml"), "[variables]\n\"#4120\" = 2\n\"#4111\" = 2\n").unwrap();
    ncc(folder, &["verify", "fanuc:a.nc", "siemens:a.mpf", "--args", "a.toml"]).exits(0);
    fs::write(folder.join("a.toml"), "[variables]\n\"#4120\" = 2\n\"#4111\" = 3\n").unwrap();
    ncc(folder, &["verify", "fanuc:a.nc", "siemens:a.mpf", "--args", "a.toml"]).exits(1);
}

/// A macro with all that a call of it may leave out.
const MACRO: &str = "%\nO9180 (SLOT)\nG21\nIF [#24 EQ #0] THEN #3000=1(NO X)\nIF [#7 EQ #0] THEN #7=2.5\n\
    G90 G0 X#24 Y#25\nZ#18\nG1 Z#26 F#9\nX[#24+#4]\nG0 Z[#18+#7]\nM99\n%\n";

#[test]
fn a_macro_is_a_file_that_a_linuxcnc_calls() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir(folder.join("lib")).unwrap();
    fs::write(folder.join("lib/O9180.nc"), MACRO).unwrap();
    let call = "G65 P9180 X10. Y20. D2. F300. I40. R5. Z-4.";
    fs::write(folder.join("main.nc"), format!("%\nO1\nG21 G90 G54\n{call}\nM30\n%\n")).unwrap();
    let alone = ncc(folder, &["fanuc", "to", "linuxcnc", "lib/O9180.nc"]).exits(0);
    // Which place each letter has.
    for (letter, place) in [(4, 1), (7, 2), (9, 3), (18, 4), (24, 5), (25, 6), (26, 7)] {
        let told = format!("every call must pass #{letter} in place {place}\n");
        assert!(alone.err.contains(&told), "{told}{}", alone.err);
    }
    assert!(alone.err.contains("one that relied on this default must pass 2.5"), "{}", alone.err);
    let after = |text: &str, mark: &str| text.split_once(mark).unwrap().1.to_owned();
    let own = after(&alone.out, "o9180 sub\n");
    assert!(own.starts_with("#26 = #7\n") && own.ends_with("\no9180 endsub\nM2\n%\n"), "{own}");
    // With its main program, which gives all of them, it is called in the same order.
    let whole = ncc(folder, &["fanuc", "to", "linuxcnc", "main.nc", "-I", "lib"]).exits(0).out;
    assert!(whole.contains("\no9180 call [40.] [2.] [300.] [5.] [10.] [20.] [-4.]\n"), "{whole}");
    let theirs = after(&whole, "o9180 sub (SLOT)\n");
    let heads = |text: &str| text.lines().take(8).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(heads(&theirs), heads(&own));
    // Put together, the one in the file in the place of the other, it makes the same cut.
    let (head, rest) = whole.split_once("o9180 sub").unwrap();
    let behind = after(rest, "o9180 endsub\n");
    let sub = own.strip_suffix("M2\n%\n").unwrap();
    fs::write(folder.join("one.ngc"), &whole).unwrap();
    fs::write(folder.join("two.ngc"), format!("{head}o9180 sub\n{sub}{behind}")).unwrap();
    ncc(folder, &["diff", "one.ngc", "two.ngc", "--from", "linuxcnc"]).exits(0);
    // Without a number, and without a file, nobody could call it.
    let nameless = MACRO.replace("O9180 (SLOT)\n", "");
    fs::write(folder.join("Slot.nc"), &nameless).unwrap();
    let named = ncc(folder, &["fanuc", "to", "linuxcnc", "Slot.nc"]).exits(0).out;
    assert!(named.contains("\no<slot> sub\n"), "{named}");
    fs::write(folder.join("a slot.nc"), &nameless).unwrap();
    ncc(folder, &["fanuc", "to", "linuxcnc", "a slot.nc"])
        .exits(1)
        .says("linuxcnc has no subprogram called a slot");
}

#[test]
fn parameters_of_a_sinumerik_are_the_places_of_a_call() {
    let folder = folder();
    let folder = folder.path();
    let text = "PROC RUNS(REAL LENGTH, INT TIMES)\nDEF INT NUM\nG90\nFOR NUM=1 TO TIMES\n\
        G1 X=LENGTH*NUM F500\nENDFOR\nG0 X0\nRET\n";
    fs::write(folder.join("RUNS.SPF"), text).unwrap();
    let kept = ncc(folder, &["siemens", "to", "linuxcnc", "RUNS.SPF", "--units", "mm"]).exits(0);
    assert!(kept.out.contains("\no<runs> sub\n#<times> = #2\n#<length> = #1\n"), "{}", kept.out);
    assert!(kept.out.contains("G1 X[#<length> * #<num>] F500\n"), "{}", kept.out);
    // Its caller's variables are not its own: a name of its own stays one, and a number of a Fanuc's too.
    let scratch = "%\nO9\n#33=#24+1.\nG90 G0 X#33\nM99\n%\n";
    fs::write(folder.join("9.nc"), scratch).unwrap();
    let own = ncc(folder, &["fanuc", "to", "linuxcnc", "9.nc", "--units", "mm"]).exits(0).out;
    assert!(!own.contains("#133") && !own.contains("#33"), "{own}");
    fs::write(folder.join("8.nc"), scratch.replace("#24+1.", "4.")).unwrap();
    let own = ncc(folder, &["fanuc", "to", "linuxcnc", "8.nc", "--units", "mm"]).exits(0).out;
    assert!(!own.contains("#133") && !own.contains("#33"), "{own}");
}

/// Files have the names by which callers look for them.
#[test]
fn a_subprogram_has_the_name_that_it_is_called_by() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir_all(folder.join("in/lib")).unwrap();
    fs::create_dir(folder.join("one")).unwrap();
    let sub = "%\nO0300\nG90 G0 X5.\nM99\n%\n";
    fs::write(folder.join("in/lib/part.nc"), sub).unwrap();
    fs::write(folder.join("in/slot.nc"), MACRO).unwrap();
    fs::write(folder.join("in/main.nc"), "%\nO1\nG21 G90 G54 G0 X1.\nM30\n%\n").unwrap();
    let there = |name: &str| {
        assert!(folder.join(name).is_file(), "{name}");
        fs::read_to_string(folder.join(name)).unwrap()
    };
    for (to, names) in [
        ("linuxcnc", ["main.ngc", "9180.ngc", "lib/300.ngc"]),
        ("siemens", ["main.MPF", "L9180.SPF", "lib/L300.SPF"]),
        ("fanuc", ["main.nc", "slot.nc", "lib/part.nc"]),
    ] {
        let out = format!("out-{to}");
        ncc(folder, &["fanuc", "to", to, "in", "-o", &out, "--units", "mm"]).exits(0);
        names.iter().for_each(|name| drop(there(&format!("{out}/{name}"))));
    }
    ncc(folder, &["fanuc", "to", "linuxcnc", "in/lib/part.nc", "-o", "one", "--units", "mm"]).exits(0);
    assert!(there("one/300.ngc").contains("\no300 sub\n"));
    ncc(folder, &["fanuc", "to", "siemens", "in/lib/part.nc", "-o", "one", "--units", "mm"]).exits(0);
    there("one/L300.SPF");
    fs::write(folder.join("L300.SPF"), SLOT).unwrap();
    ncc(folder, &["siemens", "to", "linuxcnc", "L300.SPF", "-o", "one", "--units", "mm"]).exits(0);
    assert!(there("one/300.ngc").contains("\no300 sub\nG90 G0 X5 Y5\n"));
    let number = ncc(folder, &["siemens", "to", "fanuc", "L300.SPF", "--units", "mm"]).exits(0).out;
    assert!(number.contains("\nO0300"), "{number}");
    // Where a program of the same command has it itself, that one is kept: it was verified with it.
    fs::write(folder.join("in/lib/calls.nc"), "%\nO2\nG21 G90 G54 G0 X1.\nM98 P300\nM30\n%\n").unwrap();
    fs::rename(folder.join("in/lib/part.nc"), folder.join("in/lib/O0300.nc")).unwrap();
    ncc(folder, &["fanuc", "to", "siemens", "in/lib", "-I", "in/lib", "-o", "both", "--units", "mm"])
        .exits(0);
    assert!(!there("both/L300.SPF").contains("ncc:") && there("both/O0300.MPF").contains("ncc:"));
}

#[test]
fn a_linuxcnc_knows_a_subprogram_by_the_name_of_its_file() {
    let folder = folder();
    let folder = folder.path();
    let text = "(SLOT)\no<slot> sub\nG21 G90 G0 X#1 Y5\no1 if [#2 LT 1]\no<slot> return\no1 endif\n\
        G1 Z-#2 F200\nG0 Z5\no<slot> endsub\nM2\n";
    for name in ["slot.ngc", "other.ngc"] {
        fs::write(folder.join(name), text).unwrap();
    }
    let own = ncc(folder, &["linuxcnc", "to", "siemens", "slot.ngc"]).exits(0);
    assert!(own.out.contains("\nPROC SLOT(REAL V_1, REAL V_2)\n"), "{}", own.out);
    assert!(own.out.ends_with("\nM17\n") && !own.err.contains("NC0607"), "{}{}", own.out, own.err);
    // An argument that is left out is zero there, and nothing for a Fanuc.
    let letters = ncc(folder, &["linuxcnc", "to", "fanuc", "slot.ngc"]).exits(0);
    assert!(letters.out.contains("X#1 Y5.") && letters.out.contains("\nM99\n"), "{}", letters.out);
    assert_eq!(
        letters.err.matches("an argument that a call omits is empty on fanuc").count(),
        1,
        "{}",
        letters.err
    );
    let again = ncc(folder, &["linuxcnc", "to", "linuxcnc", "slot.ngc"]).exits(0).out;
    assert!(again.contains("\no<slot> sub\n") && again.ends_with("\no<slot> endsub\nM2\n%\n"), "{again}");
    // No letter gives the tenth.
    fs::write(folder.join("slot.ngc"), text.replace("#2", "#10")).unwrap();
    ncc(folder, &["linuxcnc", "to", "fanuc", "slot.ngc"])
        .exits(1)
        .says("fanuc has no letter for argument 10");
    // Under another name, or with more in the file, it is a program with a subprogram in it.
    ncc(folder, &["linuxcnc", "to", "siemens", "other.ngc"]).says("NC0607");
    fs::write(folder.join("slot.ngc"), text.replace("M2\n", "o<slot> call [1] [2]\nM2\n")).unwrap();
    let main = ncc(folder, &["linuxcnc", "to", "siemens", "slot.ngc"]).exits(0).out;
    assert!(main.contains("SLOT(1"), "{main}");
}
