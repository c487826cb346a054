//! Text for LaTeX.

use crate::text_table::printable;

/// Characters of Latin scripts that pdflatex cannot print with the fonts that it uses by default
/// (encoding OT1).
const NOT_IN_OT1: &str = "«»ÐÞðþĄąĐđĘęĦħĮįĸĿŀŉŊŋŦŧŲųſ";
/// Punctuation outside Latin scripts that pdflatex prints.
const PUNCTUATION: &str = "‐‑‒–—―‖‘’“”†‡•…‰™";

/// Greek letters in Unicode's order, from U+03B1. The names are commands of LaTeX.
const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "o", "pi", "rho", "varsigma", "sigma", "tau", "upsilon", "phi",
    "chi", "psi", "omega",
];

/// Escapes text so that LaTeX prints it unchanged. The text may begin a cell of a table.
pub(crate) fn escaped(text: &str) -> String {
    let mut plain = String::new();
    let mut before = None;
    for (at, c) in printable(text).chars().enumerate() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => plain.extend(['\\', c]),
            '~' => plain.push_str("\\textasciitilde{}"),
            '^' => plain.push_str("\\textasciicircum{}"),
            '\\' => plain.push_str("\\textbackslash{}"),
            '<' => plain.push_str("\\textless{}"),
            '>' => plain.push_str("\\textgreater{}"),
            '|' => plain.push_str("\\textbar{}"),
            '"' => plain.push_str("''"),
            // The end of the row before would take these as its own arguments.
            '[' | ']' => plain.extend(['{', c, '}']),
            '*' if at == 0 => plain.push_str("{*}"),
            // Two of these in a row would become one other character.
            '-' | ',' if before == Some(c) => plain.extend(['{', '}', c]),
            '`' if matches!(before, Some('!' | '?')) => plain.push_str("{}`"),
            '\u{a0}' => plain.push('~'),
            '\u{2009}' | '\u{202f}' => plain.push_str("\\,"),
            c => match in_mathematics(c) {
                Some(command) => plain.extend(["$", &command, "$"]),
                None => plain.push(c),
            },
        }
        before = Some(c);
    }
    // Superscripts that follow each other are one exponent.
    plain.replace("}$$^{", "")
}

/// The command that prints a character in mathematics, if text has none.
fn in_mathematics(c: char) -> Option<String> {
    let command = match c {
        '⁰' => "^{0}",
        '¹' => "^{1}",
        '⁴' => "^{4}",
        '⁵' => "^{5}",
        '⁶' => "^{6}",
        '⁷' => "^{7}",
        '⁸' => "^{8}",
        '⁹' => "^{9}",
        '⁻' => "^{-}",
        '°' => "^{\\circ}",
        'µ' => "\\mu",
        '²' => "^{2}",
        '³' => "^{3}",
        '×' => "\\times",
        '±' => "\\pm",
        '·' => "\\cdot",
        '−' => "-",
        '∞' => "\\infty",
        '≈' => "\\approx",
        '≠' => "\\neq",
        '≤' => "\\leq",
        '≥' => "\\geq",
        '→' => "\\rightarrow",
        '←' => "\\leftarrow",
        '↑' => "\\uparrow",
        '↓' => "\\downarrow",
        'Γ' => "\\Gamma",
        'Δ' => "\\Delta",
        'Θ' => "\\Theta",
        'Λ' => "\\Lambda",
        'Ξ' => "\\Xi",
        'Π' => "\\Pi",
        'Σ' => "\\Sigma",
        'Φ' => "\\Phi",
        'Ψ' => "\\Psi",
        'Ω' => "\\Omega",
        'ο' => "o",
        'α'..='ω' => {
            let index = c as usize - 'α' as usize;
            return Some(format!("\\{}", GREEK[index]));
        }
        _ => return None,
    };
    Some(command.to_owned())
}

/// Whether pdflatex prints the escaped character without further packages.
fn is_printed(c: char) -> bool {
    c.is_ascii()
        || ('\u{a0}'..='\u{17f}').contains(&c) && !NOT_IN_OT1.contains(c)
        || PUNCTUATION.contains(c)
        || matches!(c, '\u{2009}' | '\u{202f}')
        || in_mathematics(c).is_some()
}

/// The characters of a text that pdflatex cannot print without further packages, each once.
pub(super) fn not_printed(text: &str) -> Vec<char> {
    let mut found: Vec<char> = printable(text).chars().filter(|c| !is_printed(*c)).collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_with_a_meaning_are_escaped() {
        assert_eq!(escaped("a_b % & # $ {c}"), "a\\_b \\% \\& \\# \\$ \\{c\\}");
        assert_eq!(
            escaped("~^\\<>|\""),
            "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}\\textless{}\\textgreater{}\\textbar{}''"
        );
        assert_eq!(escaped("[1] a*b"), "{[}1{]} a*b");
        assert_eq!(escaped("*a"), "{*}a");
        assert_eq!(escaped("a--b,,?`"), "a-{}-b,{},?{}`");
        assert_eq!(escaped("a\nb"), "a\\textbackslash{}nb");
        assert_eq!(escaped("σ = 2.6×, 5°"), "$\\sigma$ = 2.6$\\times$, 5$^{\\circ}$");
        assert_eq!(escaped("10⁻¹² m²"), "10$^{-12}$ m$^{2}$");
        assert_eq!(escaped("ως"), "$\\omega$$\\varsigma$");
        assert_eq!(escaped("606\u{202f}533"), "606\\,533");
    }

    #[test]
    fn characters_that_need_another_program_are_named() {
        assert_eq!(not_printed("Zürich, Łódź, β"), Vec::<char>::new());
        assert_eq!(not_printed("部屋 и 部, ð"), ['ð', 'и', '屋', '部']);
    }
}
