//! Names of programs: text of 1 to 255 bytes.

use crate::client::{PROGRAM, Server};

/// A name in an address, and the same as text; `None` is one that is refused.
const NAMES: &[(&str, Option<&str>)] = &[
    ("teste.cn", Some("teste.cn")),
    ("a%20b.cn", Some("a b.cn")),
    ("a+b", Some("a+b")),
    ("a%26b", Some("a&b")),
    ("a%3Fb%23c", Some("a?b#c")),
    ("pe%C3%A7a.cn", Some("peça.cn")),
    ("%E9%8A%91%E5%89%8A", Some("銑削")),
    ("%F0%9F%94%A9", Some("🔩")),
    ("%25", Some("%")),
    ("%2525", Some("%25")),
    ("a%22b%27c", Some("a\"b'c")),
    ("'%3B%20DROP%20TABLE%20document%3B--", Some("'; DROP TABLE document;--")),
    ("%25_", Some("%_")),
    ("-", Some("-")),
    ("mach9", Some("mach9")),
    ("romi-discovery-4022", Some("romi-discovery-4022")),
    ("a%5Cb", Some("a\\b")),
    ("...", Some("...")),
    ("a%00", None),
    ("a%0D%0ASet-Cookie:%20x", None),
    ("a%7F", None),
    ("a%2Fb", None),
    ("..%2F..%2Fetc%2Fpasswd", None),
    ("%2e%2e", None),
    (".", None),
    ("..", None),
    ("%FF", None),
    ("%C3%28", None),
    ("%ED%A0%80", None),
];

#[test]
fn a_name_is_kept_and_comes_back() {
    let server = Server::all();
    let longest = "x".repeat(255);
    let longer = "x".repeat(256);
    // 127 letters of 2 bytes, and one byte.
    let wide = format!("{}a", "%C3%A7".repeat(127));
    let wide_text = format!("{}a", "ç".repeat(127));
    let wider = "%C3%A7".repeat(128);
    let long: [(&str, Option<&str>); 4] =
        [(&longest, Some(&longest)), (&longer, None), (&wide, Some(&wide_text)), (&wider, None)];
    for (address, name) in NAMES.iter().copied().chain(long) {
        let target = format!("/transpiler/{address}?dialect=mach9");
        let made = server.program("POST", &target, PROGRAM);
        let Some(name) = name else {
            for (method, place) in [
                ("GET", "transpiler"),
                ("GET", "persistence"),
                ("GET", "output"),
                ("DELETE", "persistence"),
                ("GET", "api/v1/machines"),
                ("DELETE", "api/v1/machines"),
            ] {
                let answer = server.ask(method, &format!("/{place}/{address}"), &[], b"");
                assert_eq!(answer.status, 400, "{method} {place} {address}: {}", answer.text());
                assert_eq!(answer.header("content-type"), "application/problem+json", "{address}");
            }
            assert_eq!(made.status, 400, "{address}: {}", made.text());
            continue;
        };
        assert_eq!(made.status, 201, "{address}: {}", made.text());
        assert_eq!(made.json()["prog_name"], name);
        // The address of the answer leads there.
        let place = made.header("location");
        assert!(place.is_ascii(), "{place}");
        assert_eq!(server.get(place).json()["prog_name"], name, "{address}");
        assert_eq!(server.get(&format!("/output/{address}&type=csv")).status, 200, "{address}");
        let listed = server.get("/persistence").json();
        let listed = listed["documents"].as_array().expect("documents").clone();
        assert!(listed.iter().any(|document| document["prog_name"] == name), "{address}");
        assert_eq!(server.delete(place).status, 204, "{address}");
        assert_eq!(server.delete(place).status, 404, "{address}");
    }
    assert!(server.is_well());
}
