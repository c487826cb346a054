use super::super::levels::Level;
use super::super::model::Model;
use super::likelihood::{dispersion, level, normaliser};
use super::table::{Nuisance, Tables};
use super::*;

/// The group `stable` of the golden values.
fn blocks() -> Vec<Level> {
    let correct = [24, 22, 30, 38, 39, 39, 40, 40];
    let levels = correct.iter().enumerate();
    levels.map(|(i, &correct)| Level { level: 0.5 * (i + 1) as f64, correct, trials: 40 }).collect()
}

#[test]
fn tables_are_the_log_likelihood() {
    let model = Model::default();
    let trials = Trials::new(&blocks(), model.sigmoid);
    let span = trials.span().unwrap();
    let target =
        Target { model: &model, trials: &trials, span: &span, lapse: None, overdispersion: true };
    let nuisance = Nuisance { lapses: vec![0.002, 0.1], etas: vec![0.01, 0.3, 0.7] };
    let tables = Tables::new(&target, &target.support(), &nuisance);
    let mut sums = vec![0.0; 6];
    for (position, width) in [(1.5, 1.8), (2.2, 0.7), (0.9, 5.0)] {
        tables.sum(position, width, &mut sums);
        for (l, &lapse) in nuisance.lapses.iter().enumerate() {
            for (e, &eta) in nuisance.etas.iter().enumerate() {
                let delta = dispersion(eta);
                let exact: f64 = trials
                    .iter()
                    .map(|(x, correct, count)| {
                        let point = model.sigmoid.at((x - position) / width);
                        let (right, wrong) = model.outcomes(point, lapse);
                        level(correct, count, right, wrong, delta) - normaliser(count, delta)
                    })
                    .sum();
                let fast = f64::from(sums[l * 3 + e]) + tables.offsets[e];
                assert!((fast - exact).abs() < 5e-3, "{position} {lapse} {eta}: {fast} {exact}");
            }
        }
    }
}

#[test]
fn summaries_are_those_of_a_sum_over_a_plain_grid() {
    let options = Options { lapse: Some(0.02), overdispersion: false, ..Options::default() };
    let trials = Trials::new(&blocks(), options.model.sigmoid);
    let span = trials.span().unwrap();
    let start = Curve { position: 1.5, width: 1.5, lapse: 0.02 };
    let posterior = fit(&options, &trials, &span, &start, 0.95).unwrap();
    let target = Target {
        model: &options.model,
        trials: &trials,
        span: &span,
        lapse: options.lapse,
        overdispersion: false,
    };
    let (mut sum, mut m, mut w, mut below) = (0.0, 0.0, 0.0, 0.0);
    for i in 0..300 {
        for j in 0..300 {
            let position = 0.5 + 2.0 * (f64::from(i) + 0.5) / 300.0;
            let width = 0.5 + 5.0 * (f64::from(j) + 0.5) / 300.0;
            let curve = Curve { position, width, lapse: 0.02 };
            let density = (target.log_density(&Parameters { curve, eta: 0.0 }) + 100.0).exp();
            sum += density;
            m += density * position;
            w += density * width;
            if position < posterior.intervals.threshold[0] {
                below += density;
            }
        }
    }
    assert!((posterior.mean.threshold - m / sum).abs() < 1e-3, "{}", m / sum);
    assert!((posterior.mean.width - w / sum).abs() < 5e-3, "{}", w / sum);
    assert!((below / sum - 0.025).abs() < 0.003, "{}", below / sum);
    assert_eq!((posterior.mean.lapse.to_bits(), posterior.map.eta), (0.02_f64.to_bits(), 0.0));
}
