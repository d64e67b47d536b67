//! Facts of a program as one line for people.

use std::fmt::Write;

use ncc_driver::time::duration::short;
use serde_json::Value;

/// A line of facts: `T1 T3, 0:04:12, cutting 0:02:40, X -10…90, Y 0…50, Z -8…3, 132 blocks, 4 assumptions`.
pub(crate) fn line(facts: &Value) -> String {
    if facts["refused"] == true {
        let code = facts["code"].as_str().map(|code| format!(" ({code})")).unwrap_or_default();
        return format!("not executed: {}{code}", facts["reason"].as_str().unwrap_or_default());
    }
    let mut line = String::new();
    let tools = facts["tools"].as_array().into_iter().flatten();
    let tools: Vec<String> = tools.map(|tool| format!("T{tool}")).collect();
    if !tools.is_empty() {
        line = tools.join(" ") + ", ";
    }
    let seconds = |name: &str| duration(facts[name].as_f64().unwrap_or_default());
    // Writing to a string cannot fail.
    let _ = write!(line, "{}, cutting {}", seconds("seconds"), seconds("cutting_seconds"));
    for axis in ["x", "y", "z"] {
        let end = |at: usize| facts["extents"][axis][at].as_f64();
        if let (Some(least), Some(most)) = (end(0), end(1)) {
            let _ = write!(line, ", {} {}…{}", axis.to_uppercase(), short(least, 3), short(most, 3));
        }
    }
    let _ = write!(line, ", {} blocks", facts["blocks"]);
    match facts["assumed"].as_array().map_or(0, Vec::len) {
        0 => {}
        1 => line += ", 1 assumption",
        many => _ = write!(line, ", {many} assumptions"),
    }
    line
}

/// Hours, minutes and seconds.
pub(crate) fn duration(seconds: f64) -> String {
    let all = seconds.round() as u64;
    format!("{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn facts_are_one_line() {
        let facts = json!({
            "refused": false, "tools": [1, 3], "seconds": 252.4, "assumed": ["no machine is named", "…"], "cutting_seconds": 3660.0, "blocks": 132,
            "extents": { "x": [-10.0, 90.5], "y": [0.0, 50.0], "z": [-8.0004, -0.0001] },
        });
        assert_eq!(
            line(&facts),
            "T1 T3, 0:04:12, cutting 1:01:00, X -10…90.5, Y 0…50, Z -8…0, 132 blocks, 2 assumptions"
        );
        let refused = json!({ "refused": true, "code": "NC0217", "reason": "no O2001" });
        assert_eq!(line(&refused), "not executed: no O2001 (NC0217)");
    }
}
