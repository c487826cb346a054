//! Completion scripts offer the names of the registries.

use fovqa_emulate::EmulationSpec;
use fovqa_methods::Method;
use fovqa_vision::displays;

use crate::fovqa::Folder;

/// A completion script.
struct Script {
    shell: &'static str,
    text: String,
}

impl Script {
    fn new(folder: &Folder, shell: &'static str) -> Self {
        Self { shell, text: folder.run(&["completions", shell]).ok().stdout }
    }

    /// The part of the script that offers the values.
    fn part(&self, command: &str, option: &str) -> &str {
        let (begin, at, end) = match self.shell {
            "bash" => (format!(" fovqa__subcmd__{command})\n"), format!("--{option})"), "return 0"),
            "zsh" => (format!("({command})\n_arguments"), format!("--{option}=["), "\n'"),
            _ => {
                let at = format!("__fish_fovqa_using_subcommand {command}\" -l {option} ");
                (String::new(), at, "\ncomplete ")
            }
        };
        let of_command = &self.text[self.text.find(&begin).unwrap()..];
        let of_option = of_command.find(&at).unwrap_or_else(|| panic!("{command} --{option}"));
        let of_option = &of_command[of_option + at.len()..];
        let end = of_option.find(end).unwrap_or(of_option.len());
        &of_option[..end]
    }

    #[track_caller]
    fn offers(&self, command: &str, option: &str, names: &[String]) {
        let part = self.part(command, option);
        let is_of_name = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        let words: Vec<&str> = part.split(|c: char| !is_of_name(c)).collect();
        assert!(!names.is_empty());
        for name in names {
            let found = words.contains(&name.as_str());
            assert!(found, "{}, {command} --{option}: {name} is not in\n{part}", self.shell);
        }
    }
}

fn dashed(names: impl IntoIterator<Item = impl AsRef<str>>) -> Vec<String> {
    names.into_iter().map(|name| name.as_ref().replace('_', "-")).collect()
}

#[test]
fn every_registered_name_is_offered() {
    let folder = Folder::new();
    let list = folder.run(&["list", "metrics"]).ok().stdout;
    let listed = list.lines().filter(|line| !line.is_empty() && !line.starts_with(' '));
    let keys: Vec<String> =
        listed.filter_map(|line| Some(line.split_whitespace().next()?.to_owned())).collect();
    let displays = dashed(displays().iter().map(|display| &display.name));
    let acuity = dashed(["piecewise", "linear_mar", "geisler_perry"]);
    let emulated = dashed(EmulationSpec::methods().iter().map(|info| info.key));
    for shell in ["bash", "zsh", "fish"] {
        let script = Script::new(&folder, shell);
        script.offers("score", "metrics", &dashed(&keys));
        script.offers("score", "display", &displays);
        script.offers("score", "luminance", &dashed(["htc_vive_pro"]));
        script.offers("score", "motion", &dashed(["auto", "none", "blender", "falcor", "unreal"]));
        script.offers("foveate", "display", &displays);
        script.offers("foveate", "method", &emulated);
        script.offers("curves", "method", &dashed(Method::all().iter().map(Method::key)));
        script.offers("curves", "acuity", &acuity);
        script.offers("score", "tonemap", &dashed(["clamp", "reinhard", "aces"]));
    }
}

#[test]
fn lists_and_other_values_are_still_accepted() {
    let folder = Folder::with_pair();
    let with = |arguments: &[&str]| folder.score(&[&["a.png", "b.png"], arguments].concat());
    with(&["--metrics", "psnr,ssim"]).ok();
    with(&["--metrics", "psnr, ssim", "--metrics", "mse"]).ok();
    let values = ["--metrics", "pu-psnr", "--luminance", "peak_cd_m2=100,contrast=1000"];
    with(&values).ok();
    with(&["--motion", "X,Y", "--depth", "Z", "--metrics", "psnr"]).ok();
    with(&["--metrics", "psnr,pnsr"]).fails(
        2,
        &["there is no such metric (did you mean psnr?); the metrics are mse, psnr, ssim"],
    );
}
