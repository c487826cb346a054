//! Sweeps and budgets that are not possible.

use super::{HEAD, METRICS, RMFR, SCENE, folder};

#[track_caller]
fn refused(methods: &str, rest: &str, words: &[&str]) {
    let folder = folder(&format!("{HEAD}{SCENE}{methods}{METRICS}{rest}"));
    folder.run(&["run", "e.toml", "--output", "out"]).fails(2, words);
    assert!(!folder.path("out").exists());
}

#[test]
fn a_sweep_over_what_does_not_exist_is_refused() {
    let disk = "[[method]]\nname = \"D\"\ntest = \"other.png\"\n";
    refused(
        &format!("{RMFR}{disk}"),
        "[sweep]\n\"D.fx\" = [0.1]\n",
        &["method \"D\" has frames that were rendered", "sweep a method that is emulated"],
    );
    refused(
        RMFR,
        "[sweep]\n\"R.sigm\" = [2]\n",
        &[
            "method \"R\" has no `sigm` to sweep",
            "did you mean sigma?",
            "the keys are sigma, fx, fy",
        ],
    );
    refused(
        RMFR,
        "[sweep]\n\"Q.fx\" = [0.1]\n",
        &["there is no method \"Q\" to sweep", "the methods are \"R\""],
    );
    refused(RMFR, "[sweep]\nsigma = [2]\n", &["there is no method \"sigma\" to sweep"]);
    refused(RMFR, "[sweep]\n", &["[sweep] names nothing to sweep"]);
    refused(
        "[[method]]\nname = \"F\"\nemulate = { model = \"full\" }\n",
        "[sweep]\nbudget = [0.1, 0.2]\n",
        &["budget is swept, but no method has a parameter that it could set"],
    );
    refused(
        RMFR,
        "[[plot]]\nkind = \"sweep\"\n",
        &["the plot shows a sweep, but none of its methods is swept"],
    );
}

#[test]
fn values_that_are_not_possible_are_refused_where_they_are() {
    for (sweep, words) in [
        ("\"R.fx\" = []", "sweep.fx must be a list of values"),
        ("\"R.fx\" = 0.1", "sweep.fx must be a list of values"),
        ("\"R.fx\" = [0.1, 0.2, 0.1]", "sweep.fx has the value 0.1 twice"),
        ("\"R.fx\" = [0.1, -1]", "fx"),
        ("\"R.fx\" = [0.1, \"wide\"]", "fx"),
        (
            "\"R.sampling\" = [\"point\", \"points\"]",
            "sampling cannot be \"points\": write one of \"point\", \"area\"",
        ),
        ("\"R.filter\" = [\"none\", \"own\"]", "rmfr has no"),
        ("\"R.fx\" = { from = 0.1, to = 1 }", "has no steps"),
        ("\"R.fx\" = { from = 0.1, to = 1, steps = 1 }", "steps cannot be 1"),
        ("\"R.fx\" = { from = 0.5, to = 0.5, steps = 3 }", "from and to are the same"),
        (
            "\"R.fx\" = { from = 0, to = 1, steps = 3, scale = \"log\" }",
            "a logarithmic scale needs from and to above 0",
        ),
        ("\"R.fx\" = { from = 0.1, to = 1, step = 3 }", "did you mean steps?"),
        ("\"R.fx\" = [0.1]\nR.fx = [0.2]", "`fx` of method \"R\" is swept twice"),
    ] {
        refused(RMFR, &format!("[sweep]\n{sweep}\n"), &[words]);
    }
}

#[test]
fn a_budget_beside_the_parameter_that_it_solves_is_refused() {
    let own = "[[method]]\nname = \"R\"\nemulate = { model = \"rmfr\", sigma = 2, budget = 0.2 }\n";
    refused(own, "", &["sigma", "leave one of them out"]);
    let sigma = "[[method]]\nname = \"R\"\nemulate = { model = \"rmfr\", sigma = 2 }\n";
    let folder = folder(&format!("budget = 0.2\n{HEAD}{SCENE}{sigma}{METRICS}"));
    folder
        .run(&["run", "e.toml", "--output", "out"])
        .fails(2, &["sigma", "the budget is that of the experiment", "budget = \"none\""]);
    refused(RMFR, "[sweep]\n\"R.sigma\" = [2, 3]\n\"R.budget\" = [0.1, 0.2]\n", &["sigma"]);
    refused(sigma, "[sweep]\nbudget = [0.1, 0.2]\n", &["sigma"]);
    let full = "[[method]]\nname = \"F\"\nemulate = { model = \"full\" }\n";
    let folder = super::folder(&format!("budget = 0.2\n{HEAD}{SCENE}{full}{METRICS}"));
    folder
        .run(&["run", "e.toml", "--output", "out"])
        .fails(2, &["no method has a parameter that the budget of the experiment could set"]);
}

/// The size of the frames is known before a frame is read, and with it the budgets that are possible.
#[test]
fn a_budget_that_cannot_be_reached_states_the_range() {
    let cps = "[[method]]\nname = \"C\"\nemulate = { model = \"cps\", budget = 0.01 }\n";
    let folder = folder(&format!("{HEAD}{SCENE}{cps}{METRICS}"));
    folder.run(&["run", "e.toml", "--output", "out"]).fails(
        2,
        &["cps cannot reach a budget of 0.01 of the frame's pixels: transition_deg allows 0."],
    );
}

#[test]
fn a_sweep_of_too_many_runs_is_refused_with_its_size() {
    let range = "{ from = 0.01, to = 4, steps = 400 }";
    refused(
        RMFR,
        &format!("[sweep]\n\"R.fx\" = {range}\n\"R.fy\" = {range}\n"),
        &["the sweep has 160000 runs, counting all methods and scenes: at most 100000 are allowed"],
    );
    let most = "{ from = 0.01, to = 4, steps = 100000 }";
    refused(
        RMFR,
        &format!("[sweep]\n\"R.fx\" = {most}\n\"R.fy\" = {most}\n\"R.sigma\" = {most}\n"),
        &["runs, counting all methods and scenes"],
    );
}

#[test]
fn a_method_may_not_be_named_like_a_point() {
    let like = "[[method]]\nname = \"R (fx=0.1)\"\nemulate = { model = \"kfr\" }\n";
    refused(
        &format!("{RMFR}{like}"),
        "[sweep]\n\"R.fx\" = [0.1, 0.2]\n",
        &["a method has the name of a point of the sweep, \"R (fx=0.1)\""],
    );
}
