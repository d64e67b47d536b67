//! `--args`: what variables hold before a program begins; and what a program asks of the machine.

use std::fs;

use super::*;

/// A macro that its operator sets two variables for: how deep, and by how much at a time.
const OPEN: &str = "%\nO0100\nG21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\n#1=0\n\
    WHILE [#1 LT #500] DO1\nG1 Z-#1 F100.\nX[#1*10.]\n#1=#1+#501\nEND1\nG0 Z50.\nM5\nM30\n%\n";

fn open() -> tempfile::TempDir {
    let folder = folder();
    write(&folder, "open.nc", OPEN);
    write(&folder, "one.toml", "[variables]\n\"#500\" = 4\n\"#501\" = 1\nR500 = 4\nR501 = 1\n");
    write(
        &folder,
        "some.toml",
        "[variables]\n\"#500\" = { from = 1, to = 4, step = 1 }\n\"#501\" = [1, 2]\n",
    );
    folder
}

fn write(folder: &tempfile::TempDir, name: &str, text: &str) {
    std::fs::write(folder.path().join(name), text).unwrap();
}

#[test]
fn what_they_hold_is_told_to_every_verb_that_executes() {
    let folder = open();
    let run = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        ncc(folder.path(), &arguments)
    };
    run("fanuc to siemens open.nc --args some.toml -o open.mpf").exits(0);
    run("fanuc to mach9 open.nc --args one.toml --pass flatten -o open.cn").exits(0);
    run("fanuc to mach9 open.nc --args some.toml --pass flatten").exits(1);
    for verb in ["time open.nc --from fanuc", "check fanuc:open.nc", "verify fanuc:open.nc siemens:open.mpf"]
    {
        // Without, nobody knows what they hold.
        let without = run(verb);
        assert!(
            without.code != 0 && without.err.contains("NC0232") | without.out.contains("NC0232"),
            "{verb}"
        );
        run(&format!("{verb} --args some.toml")).exits(2).says("more than one value");
    }
    let timed = run("time open.nc --from fanuc --args one.toml").exits(0).out;
    assert!(timed.contains("0:00:22.916"), "{timed}");
    run("check fanuc:open.nc --args one.toml").exits(0);
    run("verify fanuc:open.nc siemens:open.mpf --args one.toml").exits(0);
    run("diff fanuc:open.nc siemens:open.mpf --args one.toml").exits(0);
    write(&folder, "deep.toml", "[variables]\n\"#500\" = 4\n\"#501\" = 1\nR500 = 5\nR501 = 1\n");
    run("verify fanuc:open.nc siemens:open.mpf --args deep.toml").exits(1);
    run("verify fanuc:open.nc siemens:open.mpf --args one.toml --cert a.json")
        .exits(2)
        .says("leave out --args");
    run("time open.nc --from fanuc --args nosuch.toml").exits(4);
}

/// What a machine's offsets hold is not the same on two machines: where a program moves by it, one that does not is
/// another one, although both do the same where all offsets are nothing.
#[test]
fn what_a_program_asks_of_the_machine_differs_between_machines() {
    let folder = open();
    let of = |x: &str| OPEN.replace("X0. Y0.", x).replace("#500", "4.").replace("#501", "1.");
    write(&folder, "asks.nc", &of("X#5221 Y0."));
    write(&folder, "says.nc", &of("X0. Y0."));
    write(
        &folder,
        "decides.nc",
        &of("Y0.\nIF [#5221 GT 0] THEN #2=1.\nX0.\nIF [#5221 GT 0] GOTO 5\nX1.\nN5 X0."),
    );
    let run = |verb: &str, a: &str, b: &str| ncc(folder.path(), &[verb, "--from", "fanuc", a, b]);
    run("diff", "asks.nc", "asks.nc").exits(0);
    run("diff", "asks.nc", "says.nc").exits(1);
    run("verify", "asks.nc", "says.nc").exits(1);
    run("diff", "decides.nc", "says.nc").exits(5).says("the machine decides this branch");
    let timed = ncc(folder.path(), &["time", "--from", "fanuc", "asks.nc"]).exits(0).out;
    assert!(timed.contains("the machine's offset.1.x, which the program asks for"), "{timed}");
}

/// A subprogram that stands alone: its caller says how long and how often.
const ALONE: &str = "PROC PASSES(REAL LENGTH, INT TIMES, BOOL DRY)\nDEF INT II\nG17 G90 G94 G71 G54\nG0 X0 Y0\n\
    IF DRY==FALSE\nM8\nENDIF\nFOR II=1 TO TIMES\nG1 X=LENGTH F500\nG0 X0\nENDFOR\nRET\n";

#[test]
fn a_subprogram_by_itself_is_given_its_parameters() {
    let folder = folder();
    write(&folder, "passes.spf", ALONE);
    write(
        &folder,
        "some.toml",
        "[variables]\nLENGTH = { from = 5, to = 50 }\nTIMES = [1, 3]\nDRY = [0, 1]\n",
    );
    write(&folder, "one.toml", "[variables]\nLENGTH = 20\nTIMES = 2\nDRY = 0\n");
    let run = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        ncc(folder.path(), &arguments)
    };
    let kept = run("siemens to siemens passes.spf --args some.toml").exits(0);
    assert!(kept.out.contains("\nPROC PASSES(REAL LENGTH, INT TIMES, BOOL DRY)\n"), "{}", kept.out);
    assert!(!kept.err.contains("NC0604"), "{}", kept.err);
    // Without, values are made up for them, and that is told.
    assert!(run("siemens to siemens passes.spf").exits(0).err.contains("NC0604"));
    let macro_b = run("siemens to fanuc passes.spf --args some.toml").exits(0);
    assert!(macro_b.out.contains("G01 X#1 F500."), "{}", macro_b.out);
    let placed = run("siemens to linuxcnc passes.spf --args some.toml").exits(0);
    let head = "\no<passes> sub\n#<dry> = #3\n#<times> = #2\n#<length> = #1\n";
    assert!(placed.out.contains(head) && !placed.err.contains("NC0604"), "{}", placed.out);
    let straight = run("siemens to linuxcnc passes.spf --pass flatten --args one.toml").exits(0);
    assert_eq!(straight.out.matches("G1 X20").count(), 2, "{}", straight.out);
    for verb in ["siemens to fanuc passes.spf --pass flatten", "time passes.spf --from siemens"] {
        let without = run(verb);
        assert!(without.code != 0 && without.err.contains("NC0232"), "{verb}: {}", without.err);
    }
    run("time passes.spf --from siemens --args one.toml").exits(0);
}

/// A macro that stands alone: its arguments are parameters in the output, which is called as the macro is.
#[test]
fn a_macro_by_itself_has_its_arguments_as_parameters() {
    let folder = folder();
    let head = "%\nO9012 (ROW)\n#30=0\nWHILE [#30 LT #11] DO1\nG90 G0 X[#24+#30*#18]\n";
    let text = format!("{head}G1 Z-#26 F#9\nG0 Z#7\n#30=#30+1\nEND1\nM99\n%\n");
    write(&folder, "row.nc", &text);
    let run = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        ncc(folder.path(), &arguments)
    };
    let kept = run("fanuc to siemens row.nc").exits(0);
    let written = "\nPROC L9012(REAL V_D, REAL V_F, REAL V_H, REAL V_R, REAL V_X, REAL V_Z)\nDEF REAL V_30\nMCALL\nV_30=0\n";
    assert!(kept.out.contains(written), "{}", kept.out);
    assert!(kept.out.contains("\nM17\n") && !kept.out.contains("M30"), "{}", kept.out);
    assert!(!kept.out.contains("G54\n") && !kept.out.contains("G71"), "{}", kept.out);
    // One message for all of them.
    assert_eq!(kept.err.matches("warning[NC0608]").count(), 1, "{}", kept.err);
    assert!(kept.err.contains("every call must pass #11, #18, #24, #26, #9, #7\n"), "{}", kept.err);
    // Its caller has the unit that is stated for it.
    run("haas to siemens row.nc --units mm").exits(0);
    let placed = run("fanuc to linuxcnc row.nc").exits(0).says("every call must pass #24 in place 5");
    assert!(placed.out.contains("\no9012 sub\n#26 = #6\n#24 = #5\n"), "{}", placed.out);
    // It is read again as what it is.
    std::fs::write(folder.path().join("row.spf"), &kept.out).unwrap();
    run("siemens to fanuc row.spf --units mm").exits(0);
    // Whether an argument is there is answered by what is told; by what it was put into, nobody is told.
    let asking = |ask: &str| {
        write(&folder, "asks.nc", &text.replace("#30=0\n", &format!("#30=0\n{ask}\n")));
        run("fanuc to fanuc asks.nc").exits(0);
        run("fanuc to siemens asks.nc")
    };
    for (ask, told) in [
        ("IF [#7 EQ #0] THEN #7=5.", "one that relied on this default must pass 5\n"),
        ("IF [#7 NE #0] GOTO 8\n#7=-2.50\nN8", "one that relied on this default must pass -2.5\n"),
        ("IF [#7 EQ #0] THEN #3000=1(NEED D)", "ncc does not translate one that omits"),
        ("IF [#7 EQ #0] GOTO 8\n#29=1\nN8", "ncc does not translate one that omits"),
    ] {
        let kept = asking(ask).exits(0).says("check left out: ").says(told);
        assert!(!kept.out.contains("IF ") && !kept.out.contains("SETAL"), "{ask}: {}", kept.out);
        assert_eq!(kept.err.matches("warning[NC0608]").count(), 2, "{}", kept.err);
        assert!(!kept.err.contains("NC0605"), "{}", kept.err);
    }
    asking("#31=#7\nIF [#0 NE #31] GOTO 8\n#7=5.\nN8")
        .exits(1)
        .says("siemens cannot ask whether a call passes 31");
    asking("IF [#27 EQ #0] THEN #27=5.").exits(1).says("siemens cannot ask whether a call passes 27");
    write(&folder, "none.toml", "[variables]\n\"#7\" = { among = [1], vacant = true }\n");
    asking("IF [#7 EQ #0] THEN #7=5.").exits(0);
    run("fanuc to siemens asks.nc --args none.toml").exits(1).says("argument 7 has no value in `--args`");
    // A number that is computed may be that of an argument.
    write(&folder, "number.nc", &text.replace("Z-#26", "Z-#[#30+26]"));
    run("fanuc to siemens number.nc").exits(1).says("a computed variable number among macro arguments");
    // Ways that meet again have what the caller has in force.
    let ways = "%\nO9044\nIF [#11 EQ 1] GOTO 10\nG90 G0 Y#25\nGOTO 99\nN10 G90 G0 X#24\nN99 M99\n%\n";
    write(&folder, "ways.nc", ways);
    run("fanuc to siemens ways.nc").exits(0);
    // What no letter gives is no argument.
    write(&folder, "rest.nc", &text.replace("#26", "#27"));
    run("fanuc to siemens rest.nc").exits(1).says("variable 27 may be empty where it is read");
}

/// A subprogram that only moves goes back to its caller, and states nothing of what that has in force.
#[test]
fn a_subprogram_by_itself_goes_back() {
    let folder = folder();
    write(&folder, "sub.nc", "%\nO1000\nG90 G0 X10. Y10.\nG1 Z-5. F100.\nG0 Z5.\nM99\n%\n");
    let run = |to: &str| ncc(folder.path(), &["fanuc", "to", to, "sub.nc", "--units", "mm"]);
    let kept = run("siemens").exits(0);
    assert!(kept.out.ends_with("\nMCALL\nG90 G0 X10 Y10\nG1 Z-5 F100\nG0 Z5\nM17\n"), "{}", kept.out);
    let named = run("linuxcnc").exits(0).out;
    let whole = "\no1000 sub\nG90 G0 X10 Y10\nG1 Z-5 F100\nG0 Z5\no1000 endsub\nM2\n%\n";
    assert!(named.ends_with(whole), "{named}");
    run("mach9").exits(1);
    // Whether its caller goes on with a cycle depends on the control.
    for (z, end) in [("-5.", ""), ("-#26", ""), ("-5.", "G80\n")] {
        let text = format!("%\nO1000\nG90 G99 G81 X10. Z{z} R2. F100.\n{end}M99\n%\n");
        write(&folder, "sub.nc", &text);
        run("siemens").exits(u8::from(end.is_empty()).into());
        run("linuxcnc").exits(u8::from(end.is_empty()).into());
        run("fanuc").exits(0);
    }
    // On one of two ways it does.
    let either = "IF [#1 EQ 1] GOTO 5\nG80\nGOTO 6\nN5 G4 P10\nN6";
    write(&folder, "sub.nc", &format!("%\nO1000\nG90 G99 G81 X10. Z-5. R2. F100.\n{either}\nM99\n%\n"));
    run("linuxcnc").exits(1).says("the cycle stays active for a caller");
}

/// What nothing in a program calls is not executed, and that is told; what it is given, nobody knows.
#[test]
fn what_nothing_calls_is_told() {
    let folder = folder();
    let main = "%\nO0001\nG21 G90 G54 G17 G94 G0 X0 Y0\nM30\nO0500\n";
    write(&folder, "plain.nc", &format!("{main}G1 Z-1. F100.\nG0 Z5.\nM99\n%\n"));
    write(&folder, "macro.nc", &format!("{main}G1 Z-1. F#9\nG0 Z#7\nM99\n%\n"));
    let run = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        ncc(folder.path(), &arguments)
    };
    for to in ["fanuc", "haas", "siemens", "linuxcnc"] {
        let told = run(&format!("fanuc to {to} plain.nc")).exits(0).err;
        assert!(told.contains("NC0607"), "{to}: {told}");
    }
    run("fanuc to fanuc macro.nc").exits(0);
    for to in ["siemens", "linuxcnc"] {
        run(&format!("fanuc to {to} macro.nc")).exits(1).says("variable 9 may be empty where it is read");
    }
}

#[test]
fn an_elseif_that_may_stop_its_control_is_told() {
    let folder = folder();
    let folder = folder.path();
    let program = |condition: &str| {
        format!(
            "G21 G90 G54 G94 F100\n#1 = 2\no1 if [#1 GT 1]\nG0 X1\no1 elseif [{condition} GT 2]\nG0 X2\no1 endif\nM2\n"
        )
    };
    fs::write(folder.join("stops.ngc"), program("4 / #1")).unwrap();
    fs::write(folder.join("goes.ngc"), program("4 * #1")).unwrap();
    let told = "elseif has a value where it is passed over = yes";
    ncc(folder, &["linuxcnc", "to", "fanuc", "stops.ngc"]).exits(0).says(told);
    ncc(folder, &["linuxcnc", "to", "fanuc", "stops.ngc", "-v"]).exits(0).says("stops.ngc:5:");
    let goes = ncc(folder, &["linuxcnc", "to", "fanuc", "goes.ngc"]).exits(0).err;
    assert!(!goes.contains("elseif"), "{goes}");
}

#[test]
fn a_macro_with_several_sets_of_arguments_is_told() {
    let folder = folder();
    let folder = folder.path();
    let calls = "G65 P9100 X1. Y1.\nG65 P9100 X2. Y2. Z-1.\nG65 P9100 X3. Y3.\n";
    let program = format!(
        "%\nO1\nG21 G17 G40 G49 G80 G94 G90 G54\nG0 X0 Y0\nF99\n{calls}M30\nO9100\nG0 X#24 Y#25\n\
         IF [#26 EQ #0] GOTO 9\nG1 Z#26\nN9 M99\n%\n"
    );
    fs::write(folder.join("p.nc"), program).unwrap();
    let whole = ncc(folder, &["fanuc", "to", "siemens", "p.nc"]).exits(0);
    let whole = whole.says("the macro 9100, as 9100, 9101: one for each set of arguments");
    assert!(whole.out.contains("\nL9100(1.,1.)\nL9101(2.,2.,-1.)\nL9100(3.,3.)\n"), "{}", whole.out);
    // A Fanuc knows missing arguments.
    let own = ncc(folder, &["fanuc", "to", "fanuc", "p.nc"]).exits(0).out;
    assert!(own.contains("IF [#26 EQ #0] GOTO 9") && !own.contains("9101"), "{own}");
}
