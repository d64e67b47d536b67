//! Dialects of a shop: known to an engine that was given them, each read once.

use ncc_engine::Engine;
use ncc_engine::dialects::{Dictionary, NotKnown, Shop};

const SHOP: &str = "id = \"shop\"\ntitle = \"Shop\"\nbase = \"fanuc\"\n[[code]]\ncode = \"M277\"\nmeans = \"FLOOD_ON\"\nsource = \"its maker\"\n";
const CELL: &str = "id = \"cell\"\ntitle = \"Cell\"\nbase = \"shop\"\n";
const PART: &str = "G21 G90 G17 G40 G54\nT1 M06\nM277\nG00 X1. Y1. Z5.\nM30\n";

fn shop(texts: &[&str]) -> Shop {
    let dictionary =
        |text: &&str| Dictionary { file: format!("{}.toml", text.len()), text: (*text).to_owned() };
    Shop::of(texts.iter().map(dictionary).collect())
}

/// The code of a check in a dialect, and its messages.
fn check(shop: &Shop, from: &str) -> (u8, String) {
    let mut engine = Engine::default();
    engine.put("part.nc", PART.into());
    engine.know(shop.dialects.clone());
    let code = engine
        .run(&format!(r#"{{ "verb": "translate", "file": "part.nc", "from": "{from}", "to": "haas" }}"#));
    (code, String::from_utf8_lossy(engine.output("messages").unwrap_or_default()).into_owned())
}

#[test]
fn dialects_of_a_shop_are_known_by_their_names() {
    // A dictionary may stand before the one that it builds on.
    let shop = shop(&[CELL, SHOP]);
    assert_eq!(shop.not_known, [None, None]);
    for from in ["shop", "cell"] {
        let (code, messages) = check(&shop, from);
        assert_eq!(code, 0, "{from}: {messages}");
    }
    let hashes: Vec<_> = shop.dialects.hashes("cell").into_iter().map(|own| (own.name, own.file)).collect();
    let file = |text: &str| Some(format!("{}.toml", text.len()));
    let expected = [("cell", file(CELL)), ("shop", file(SHOP)), ("fanuc", None)];
    assert_eq!(hashes, expected.map(|(name, file)| (name.to_owned(), file)));
    let (code, messages) = check(&Shop::default(), "shop");
    assert_eq!(code, 2);
    assert!(messages.contains("there is no dialect `shop`"), "{messages}");
}

#[test]
fn a_dialect_of_a_shop_is_never_recognised() {
    let (code, messages) = check(&shop(&[SHOP]), "auto");
    assert!(code != 0 && messages.contains("not certain"), "{messages}");
}

#[test]
fn a_dictionary_is_read_once() {
    let [first, other, again] = [[SHOP, CELL], [SHOP, SHOP], [SHOP, CELL]].map(|texts| shop(&texts));
    let of = |shop: &Shop, id: &str| shop.dialects.get(id).map(std::ptr::from_ref);
    assert_eq!(of(&first, "shop"), of(&again, "shop"));
    assert_eq!(of(&first, "cell"), of(&again, "cell"));
    // Alone or beside others it is the same; what builds on it is another one with each text of the shop.
    assert_eq!(of(&first, "shop"), of(&other, "shop"));
    assert!(matches!(other.not_known[..], [None, Some(NotKnown::Faulty(_))]), "a name is one dialect's");
    let changed = shop(&[&SHOP.replace("M277", "M278"), CELL]);
    assert_ne!(of(&first, "cell"), of(&changed, "cell"));
}

/// A fault of one dictionary is none of those beside it, and one of those that build on it.
#[test]
fn a_faulty_dictionary_is_not_known() {
    let faulty = SHOP.replace("FLOOD_ON", "FLOD_ON");
    let other = "id = \"other\"\ntitle = \"\"\nbase = \"haas\"\n";
    let shop = shop(&[&faulty, other, CELL]);
    assert!(matches!(shop.not_known[..], [Some(NotKnown::Faulty(_)), None, Some(NotKnown::Faulty(_))]));
    assert!(shop.dialects.get("other").is_some() && shop.dialects.get("cell").is_none());
}
