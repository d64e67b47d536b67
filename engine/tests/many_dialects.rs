//! Dictionaries that a process keeps, in a process of its own: they stay to its end.

use ncc_engine::dialects::{Dictionary, MOST, NotKnown, Shop};

#[test]
fn a_process_keeps_so_many_dictionaries() {
    let all = (0..=MOST).map(|number| Dictionary {
        file: String::new(),
        text: format!("id = \"shop-{number}\"\ntitle = \"\"\nbase = \"mach9\"\n"),
    });
    let shop = Shop::of(all.collect());
    assert_eq!(shop.not_known[MOST - 1], None);
    assert_eq!(shop.not_known[MOST], Some(NotKnown::TooMany));
    // Those that are kept are known as before.
    let first = Dictionary {
        file: String::new(),
        text: "id = \"shop-0\"\ntitle = \"\"\nbase = \"mach9\"\n".to_owned(),
    };
    assert!(Shop::of(vec![first]).dialects.get("shop-0").is_some());
}
