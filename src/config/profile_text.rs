//! The text of a profile, changed so that people's own words in it stay.
#![forbid(unsafe_code)]

/// The text of a profile without rules for a program.
#[must_use]
pub fn new(program: &str) -> String {
    let name = toml::Value::from(program);
    format!("# Written by `manyview profile save`.\nexecutable = {name}\n")
}

/// The text with other values, in the words of TOML, for some keys that stand before the rules. Everything else stays as it is, and so do comments beside the values.
#[must_use]
pub fn with_values(text: &str, values: &[(&str, &str)]) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let key = |line: &str| line.split('=').next().map(|key| key.trim().to_owned());
    for (name, value) in values {
        let end = lines
            .iter()
            .position(|line| {
                line.trim_start().starts_with('[') || key(line).as_deref() == Some("rule")
            })
            .unwrap_or(lines.len());
        let set = format!("{name} = {value}");
        let found = lines
            .iter_mut()
            .take(end)
            .find(|line| line.contains('=') && key(line).as_deref() == Some(*name));
        match found {
            Some(line) => {
                let comment = line.find('#').and_then(|at| line.get(at..));
                *line = comment.map_or(set.clone(), |comment| format!("{set}    {comment}"));
            }
            None => lines.insert(end, set),
        }
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_changed_and_the_rest_stays() {
        let text = "# A room.\nexecutable = [\"room\", \"room.x86_64\"]\nhud-depth = 0.5 # a little behind\n\nrule = [\n    { draw = 3, class = \"flat\" }, # hud-depth = 2\n]\n";
        let changed = with_values(text, &[("hud-depth", "-0.25"), ("focal-depth", "8")]);
        assert_eq!(
            changed,
            "# A room.\nexecutable = [\"room\", \"room.x86_64\"]\nhud-depth = -0.25    # a little behind\n\nfocal-depth = 8\nrule = [\n    { draw = 3, class = \"flat\" }, # hud-depth = 2\n]\n"
        );
        assert_eq!(with_values(&changed, &[]), changed);
        assert_eq!(
            with_values("[[rule]]\nclass = \"flat\"\n", &[("hud-depth", "1")]),
            "hud-depth = 1\n[[rule]]\nclass = \"flat\"\n"
        );
    }

    #[test]
    fn a_new_profile_names_its_program() {
        let text = with_values(&new("a \"b\""), &[("hud-depth", "0.25")]);
        let table: toml::Table = text.parse().expect("TOML");
        assert_eq!(table["executable"].as_str(), Some("a \"b\""));
        assert_eq!(table["hud-depth"].as_float(), Some(0.25));
    }
}
