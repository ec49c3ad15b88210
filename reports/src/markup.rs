//! Text inside HTML and SVG.

/// Text with the characters that markup reserves replaced.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Words with the marks of plain text set: `code` between backticks, and what follows an underscore as an index.
pub(crate) fn inline(text: &str) -> String {
    let part = |(k, part): (usize, &str)| match k % 2 {
        0 => with_indices(&escaped(part)),
        _ => format!("<code>{}</code>", escaped(part)),
    };
    text.split('`').enumerate().map(part).collect()
}

fn with_indices(text: &str) -> String {
    let mut parts = text.split('_');
    let mut set = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let end =
            part.find(|c: char| !c.is_alphanumeric() || "²³".contains(c)).unwrap_or(part.len());
        set.push_str(&format!("<sub>{}</sub>{}", &part[..end], &part[end..]));
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_plain_text_are_set() {
        assert_eq!(
            inline("a < b: `x_1 & y` and ω_SPH², h_i/s_i"),
            "a &lt; b: <code>x_1 &amp; y</code> and ω<sub>SPH</sub>², h<sub>i</sub>/s<sub>i</sub>"
        );
    }
}
