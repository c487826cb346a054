//! Makes the output of plotters shorter without a change of the picture: the dashes of a line become one
//! path, and attributes that say what is so anyway go.

/// The attribute of a mark that nothing shines through, which is the default.
const OPAQUE: &str = " opacity=\"1\"";
const LINE: &str = "<polyline ";
const POINTS: &str = " points=\"";
const END: &str = " \"/>";

/// Joins neighbouring lines of the same colour and width to one path.
pub(crate) fn joined(elements: &str) -> String {
    let mut text = String::with_capacity(elements.len());
    // The style of the path that is open.
    let mut open: Option<String> = None;
    for element in elements.lines() {
        let element = element.replace(OPAQUE, "");
        let line = element
            .strip_prefix(LINE)
            .and_then(|rest| rest.strip_suffix(END))
            .and_then(|rest| rest.split_once(POINTS))
            // Where a line that shines through crosses itself, it matters whether it is one.
            .filter(|(style, _)| !style.contains("opacity"));
        match line {
            Some((style, points)) if open.as_deref() == Some(style) => {
                text.push('M');
                text.push_str(points);
            }
            Some((style, points)) => {
                close(&mut text, open.take().is_some());
                text.push_str("<path ");
                text.push_str(style);
                text.push_str(" d=\"M");
                text.push_str(points);
                open = Some(style.to_owned());
            }
            None => {
                close(&mut text, open.take().is_some());
                text.push_str(&element);
                text.push('\n');
            }
        }
    }
    close(&mut text, open.is_some());
    text
}

fn close(text: &mut String, is_open: bool) {
    if is_open {
        text.push_str("\"/>\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_one_style_become_one_path() {
        let line = |colour: &str, points: &str| {
            format!(
                "<polyline fill=\"none\" opacity=\"1\" stroke=\"{colour}\" points=\"{points} \"/>\n"
            )
        };
        let disc = "<circle cx=\"1\" opacity=\"1\"/>\n";
        let text = [
            line("#00F", "1,2 3,4"),
            line("#00F", "5,6 7,8"),
            line("#F00", "1,1 2,2"),
            disc.to_owned(),
            line("#F00", "3,3 4,4"),
        ]
        .concat();
        assert_eq!(
            joined(&text),
            "<path fill=\"none\" stroke=\"#00F\" d=\"M1,2 3,4M5,6 7,8\"/>\n\
             <path fill=\"none\" stroke=\"#F00\" d=\"M1,1 2,2\"/>\n<circle cx=\"1\"/>\n\
             <path fill=\"none\" stroke=\"#F00\" d=\"M3,3 4,4\"/>\n"
        );
    }

    #[test]
    fn lines_that_shine_through_stay_apart() {
        let text = "<polyline opacity=\"0.5\" points=\"1,2 3,4 \"/>\n".repeat(2);
        assert_eq!(joined(&text), text);
    }
}
