//! Figures of random values, which must stay inside the picture.

use proptest::prelude::*;

use super::*;

/// Usual values, or any float at all: infinite, tiny, not a number.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![-50.0..50.0, Just(0.0), prop::num::f64::ANY]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 40, failure_persistence: None, ..ProptestConfig::default()
    })]
    #[test]
    fn no_value_breaks_a_figure(
        values in prop::collection::vec(value(), 0..40), series in 1..5usize,
    ) {
        let points: Vec<_> = values.chunks(2).map(|v| (v[0], v.get(1).copied())).collect();
        let curves = line(vec![points; series]);
        check(&curves);
        prop_assert!(curves.print(&Style::default()).unwrap().png(48.0).is_ok());
        let options: Vec<_> = values.iter().map(|v| Some(*v)).collect();
        check(&bars(vec![options.clone(); series], false));
        check(&bars(vec![options; series], true));
        check(&spread(vec![values.chunks(12).map(<[f64]>::to_vec).collect(); series]));
    }

    #[test]
    fn no_value_breaks_panels(
        values in prop::collection::vec(value(), 0..40),
        count in 1..9usize,
        columns in 1..5usize,
        ticks in prop::collection::vec(value(), 0..4),
    ) {
        let points: Vec<_> = values.chunks(2).map(|v| (v[0], v.get(1).copied())).collect();
        let mut figure = panels(&[points.clone(), points], count, columns);
        let Figure::Panels(chart) = &mut figure else { unreachable!() };
        for (i, panel) in chart.panels.iter_mut().enumerate() {
            let shift = |(x, y): &mut (f64, Option<f64>)| (*x, y.map(|y| y / 10f64.powi(i as i32)));
            panel.series.iter_mut().flat_map(|s| &mut s.points).for_each(|p| *p = shift(p));
            panel.x_ticks = (i % 2 == 1).then(|| ticks.clone());
            let fill = |v: &[f64]| (v[0], v[v.len() / 2], v[v.len() - 1]);
            let kind = if i % 3 == 0 { FillKind::Deficit } else { FillKind::Surplus };
            let points = values.chunks(3).map(fill).collect();
            panel.fills = vec![Fill { name: name(i), kind, points }];
            panel.y.min = values.get(i).copied();
            panel.y.max = values.get(i + 1).copied();
            panel.x.min = values.get(i + 2).copied().filter(|_| i % 3 == 1);
            panel.series[0].smooth = i % 2 == 1;
            panel.y.log = i % 4 == 2;
            panel.x.log = i % 3 == 2;
            panel.spans = values.chunks(2).map(|v| span(v[0], v[v.len() - 1])).collect();
        }
        check(&figure);
        let Figure::Panels(chart) = figure else { unreachable!() };
        check(&Figure::Line(chart.panels[0].clone()));
    }
}
