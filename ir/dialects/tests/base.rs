//! Dictionaries that build on others: what is merged how, and where a fault is reported.

use ncc_dialects::{
    Dialect, DialectError, DialectFault, Meaning, Quantity, RowFault, Text, builtin, load, parse,
};

fn shop(rest: &str) -> Result<Dialect, DialectError> {
    parse(&format!("id = \"shop\"\ntitle = \"A shop\"\nbase = \"fanuc\"\n{rest}"))
}

/// The line and column of an error, counted from 1, in the first of the texts.
fn at(error: &DialectError, text: &str) -> (usize, usize) {
    let place = error.place.as_ref().expect("a place");
    assert_eq!(place.text, Text::File(0), "{error}");
    let before = &text[..place.span.start];
    (
        before.lines().count().max(1) + usize::from(before.ends_with('\n')),
        before.len() - before.rfind('\n').map_or(0, |n| n + 1) + 1,
    )
}

#[test]
fn a_file_that_says_nothing_is_its_base() {
    let (shop, base) = (shop("").unwrap(), builtin("fanuc").unwrap());
    assert_eq!((shop.id.as_str(), shop.title.as_str()), ("shop", "A shop"));
    assert_eq!(shop.base.as_deref(), Some("fanuc"));
    assert_eq!(format!("{:?}", shop.code), format!("{:?}", base.code));
    assert_eq!(format!("{:?}", shop.number), format!("{:?}", base.number));
    assert_eq!(shop.caps, base.caps);
}

#[test]
fn tables_are_merged_field_by_field() {
    let shop = shop("[number.length]\nbare = \"units\"\n[power_on]\nunits = { value = \"inch\" }\n").unwrap();
    let length = shop.numbers(Quantity::Length);
    assert_eq!((length.decimals, length.bare), (3, ncc_dialects::Bare::Units));
    let units = shop.power_on.units.unwrap();
    assert_eq!(units.value, ncc_dialects::UnitsName::Inch);
    assert!(units.source.starts_with("parameter"), "{}", units.source);
}

#[test]
fn rows_are_merged_by_their_key() {
    let shop = shop("[[code]]\ncode = \"M8\"\nsource = \"shop\"\n[[code]]\ncode = \"M24\"\nmeans = \"FLOOD_ON\"\nwrite = false\nsource = \"shop\"\n").unwrap();
    let flood = shop.code_for(Meaning::FloodOn).unwrap();
    // The key is as this file writes it, the meaning is the base's.
    assert_eq!((flood.code.as_str(), flood.source.as_str()), ("M8", "shop"));
    assert_eq!(shop.code_row(b'M', 240).unwrap().means, Some(Meaning::FloodOn));
    assert_eq!(shop.code.len(), builtin("fanuc").unwrap().code.len() + 1);
}

#[test]
fn meaning_and_refusal_exclude_each_other() {
    let shop = shop("[[code]]\ncode = \"M19\"\nmeans = \"MIST_ON\"\nsource = \"shop\"\n[[code]]\ncode = \"M07\"\nrefuse = \"shower\"\n").unwrap();
    assert_eq!(shop.code_row(b'M', 190).unwrap().refuse, None);
    let shower = shop.code_row(b'M', 70).unwrap();
    assert_eq!(
        (shower.means, shower.refuse.as_deref(), shower.source.as_str()),
        (None, Some("shower"), "16-C")
    );
}

#[test]
fn rows_and_tables_are_removed_and_replaced() {
    let text = "[power_on]\nplane = { remove = true }\n[[code]]\ncode = \"G05\"\nremove = true\n[[address]]\nletter = \"L\"\nrole = \"parameter\"\nquantity = \"integer\"\nsource = \"shop\"\nreplace = true\n";
    let shop = shop(text).unwrap();
    assert!(shop.code_row(b'G', 50).is_none() && shop.code_row(b'G', 51).is_some());
    assert_eq!(shop.address_row(b'L').unwrap().refuse, None);
    assert!(shop.power_on.plane.is_none());
}

#[test]
fn bases_of_bases_in_any_order() {
    let texts = [
        "id = \"ours\"\ntitle = \"Ours\"\nbase = \"theirs\"\n[[code]]\ncode = \"M08\"\nremove = true\n",
        "id = \"theirs\"\ntitle = \"Theirs\"\nbase = \"fanuc\"\n[program]\nnumber_digits = 5\n",
    ];
    let all = load(&texts).unwrap();
    assert_eq!((all[0].program.number_digits, all[1].program.number_digits), (5, 5));
    assert!(all[0].code_row(b'M', 80).is_none() && all[1].code_row(b'M', 80).is_some());
}

#[test]
fn cycles_of_bases_are_refused() {
    let on = |id: &str, base: &str| format!("id = \"{id}\"\ntitle = \"\"\nbase = \"{base}\"\n");
    let own = on("aa", "aa");
    let error = load(&[&own]).unwrap_err();
    assert_eq!(error.fault, DialectFault::BaseCycle { chain: vec!["aa".into(), "aa".into()] });
    assert_eq!(at(&error, &own), (3, 8));
    let (a, b, c) = (on("aa", "bb"), on("bb", "cc"), on("cc", "aa"));
    let error = load(&[&a, &b, &c]).unwrap_err();
    assert_eq!(
        error.fault,
        DialectFault::BaseCycle { chain: ["aa", "bb", "cc", "aa"].map(String::from).into() }
    );
}

#[test]
fn names_are_free_or_refused() {
    let fault = |texts: &[&str]| load(texts).unwrap_err().fault;
    let named = |id: &str| format!("id = \"{id}\"\ntitle = \"\"\nbase = \"fanuc\"\n");
    assert_eq!(fault(&[&named("fanuc")]), DialectFault::BuiltInId { id: "fanuc".into() });
    assert_eq!(fault(&[&named("aa"), &named("aa")]), DialectFault::IdTwice { id: "aa".into() });
    for bad in ["a", "9a", "a b", "a-", ""] {
        assert_eq!(fault(&[&named(bad)]), DialectFault::BadId { id: bad.into() });
    }
    assert_eq!(fault(&["title = \"\"\nbase = \"fanuc\"\n"]), DialectFault::Missing { field: "id" });
    let unknown = "id = \"aa\"\ntitle = \"\"\nbase = \"fanux\"\n";
    assert_eq!(fault(&[unknown]), DialectFault::NoBase { base: "fanux".into() });
    let other = "id = \"aa\"\ntitle = \"\"\nbase = \"fanuc\"\nfamily = \"ir\"\n";
    assert_eq!(fault(&[other]), DialectFault::OtherFamily);
}

#[test]
fn faults_point_into_the_file() {
    let head = "id = \"shop\"\ntitle = \"A shop\"\nbase = \"fanuc\"\n";
    for (rest, place, told) in [
        ("[[code]]\ncode = \"M24\"\nmeans = \"FLOD_ON\"\nsource = \"s\"\n", (6, 9), "no meaning: FLOD_ON"),
        ("[block]\nblank = true\n", (5, 1), "unknown field `blank`"),
        ("[[code]]\ncode = \"M24\"\nsource = \"s\"\n", (5, 8), "Row { row: \"M24\", wrong: MeansOrRefuse }"),
        (
            "[[code]]\ncode = \"M97\"\nrefuse = \"a call\"\nblocks = \"p\"\nsource = \"s\"\n",
            (5, 8),
            "Row { row: \"M97\", wrong: BlockLetters }",
        ),
        (
            "[[code]]\ncode = \"M8\"\nsource = \"s\"\n[[code]]\ncode = \"M08\"\n",
            (8, 8),
            "RowTwice { row: \"M08\" }",
        ),
        (
            "[[code]]\ncode = \"M24\"\nremove = true\n",
            (6, 10),
            "NothingThere { row: \"M24\", word: \"remove\" }",
        ),
        ("[[code]]\nsource = \"s\"\n", (4, 1), "NoKey { table: \"code\", key: \"code\" }"),
        (
            "[[cycle]]\ncode = \"G88\"\nkind = \"drill\"\ndepth = \"Z\"\nretract = \"R\"\nsource = \"s\"\n",
            (5, 8),
            "Row { row: \"G88\", wrong: CycleNotStarted }",
        ),
        ("[comment\n", (4, 9), ""),
    ] {
        let text = format!("{head}{rest}");
        let error = parse(&text).unwrap_err();
        assert!(error.to_string().contains(told), "{error}");
        assert_eq!(at(&error, &text), place, "{error}");
        assert_eq!(error.inherited_by, None);
    }
}

#[test]
fn faults_in_the_base_name_it() {
    let text =
        "id = \"shop\"\ntitle = \"A shop\"\nbase = \"fanuc\"\n[[cycle]]\ncode = \"G81\"\nremove = true\n";
    let error = parse(text).unwrap_err();
    let row = "G81".to_owned();
    assert_eq!(error.fault, DialectFault::Row { row, wrong: RowFault::NoCycleRow });
    let fanuc = ncc_dialects::builtin_ids().position(|id| id == "fanuc").unwrap();
    let place = error.place.unwrap();
    assert_eq!(place.text, Text::BuiltIn(fanuc));
    assert_eq!(&ncc_dialects::builtin_text(fanuc).unwrap().1[place.span], "\"G81\"");
    assert_eq!(&text[error.inherited_by.unwrap().span], "\"fanuc\"");
}
