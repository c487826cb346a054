//! The gaze of the viewer: fixations, smooth pursuit and saccades.
//!
//! A saccade of A degrees follows the main sequence: its peak velocity is V = 551 (1 - exp(-A / 14))
//! degrees per second (Baloh, Sills, Kumley and Honrubia 1975, Quantitative measurement of saccade
//! amplitude, duration, and velocity, Neurology 25). Its course is the smoothest one, 10 s³ - 15 s⁴ +
//! 6 s⁵, whose peak velocity is 1.875 A / duration, so that the duration is 1.875 A / V. The lengths of
//! fixations and pursuits, and where they lead, are our choice.

use crate::noise::random;

/// The peak velocity of a saccade in degrees per second, by its amplitude in degrees.
pub(crate) fn peak_velocity_deg_s(amplitude_deg: f64) -> f64 {
    551.0 * (1.0 - libm::exp(-amplitude_deg / 14.0))
}

/// The gaze relative to the head, in degrees to the right and down.
pub(crate) type Angles = [f64; 2];

/// The course of the gaze up to some time.
#[derive(Debug, Clone)]
pub(crate) struct GazeCourse {
    /// The phases, each with the time in seconds at which it begins; there is one behind the last.
    phases: Vec<(f64, Phase)>,
}

/// The farthest that the gaze turns from the axis, in degrees.
const FARTHEST: Angles = [17.0, 11.0];

/// What the gaze does for a while: it stays or follows something, then jumps to the next target.
#[derive(Debug, Clone, Copy)]
struct Phase {
    from: Angles,
    /// Degrees per second while it follows something; 0 for a fixation.
    velocity: Angles,
    /// Seconds before the saccade.
    hold_s: f64,
}

impl GazeCourse {
    /// The course from 0 to a time in seconds.
    pub(crate) fn new(seed: u64, until_s: f64) -> Self {
        let (mut begin, mut phase) = (0.0, phase(seed, 0));
        let mut phases = vec![(begin, phase)];
        while begin <= until_s {
            let next = self::phase(seed, phases.len() as i64);
            begin += phase.hold_s + saccade_s(phase.at(phase.hold_s), next.from);
            phase = next;
            phases.push((begin, phase));
        }
        Self { phases }
    }

    /// The gaze at a time in seconds within the course.
    pub(crate) fn at(&self, time_s: f64) -> Angles {
        let behind = self.phases.partition_point(|(begin, _)| *begin <= time_s);
        let index = behind.clamp(1, self.phases.len() - 1);
        let ((begin, phase), (_, next)) = (self.phases[index - 1], self.phases[index]);
        let since = time_s - begin;
        if since < phase.hold_s {
            return phase.at(since);
        }
        let end = phase.at(phase.hold_s);
        let s = ((since - phase.hold_s) / saccade_s(end, next.from)).min(1.0);
        let share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
        [0, 1].map(|i| end[i] + (next.from[i] - end[i]) * share)
    }
}

/// How long a saccade takes, in seconds.
fn saccade_s(from: Angles, to: Angles) -> f64 {
    let [x, y] = [0, 1].map(|i| to[i] - from[i]);
    let amplitude = (x * x + y * y).sqrt();
    if amplitude > 0.0 { 1.875 * amplitude / peak_velocity_deg_s(amplitude) } else { 0.0 }
}

fn phase(seed: u64, index: i64) -> Phase {
    let number = |of: i64| random(index, of, 1, seed);
    // The first fixation is near the axis; every third phase is a pursuit.
    let reach = if index == 0 { 0.2 } else { 1.0 };
    let from = [0, 1].map(|i| FARTHEST[i as usize] * reach * (2.0 * number(i) - 1.0));
    let follows = index % 3 == 2;
    let hold_s = if follows { 0.5 + 0.5 * number(2) } else { 0.22 + 0.33 * number(2) };
    // Towards the axis, so that the gaze stays in the field.
    let speed = 4.0 + 8.0 * number(3);
    let length = (from[0] * from[0] + from[1] * from[1]).sqrt().max(1e-9);
    let velocity = from.map(|part| if follows { -part / length * speed } else { 0.0 });
    Phase { from, velocity, hold_s }
}

impl Phase {
    fn at(&self, since_s: f64) -> Angles {
        [0, 1].map(|i| self.from[i] + self.velocity[i] * since_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds in degrees per second, a thousand a second.
    fn speeds(seconds: usize) -> Vec<f64> {
        let course = GazeCourse::new(1, 13.0);
        let at = |i: usize| course.at(i as f64 / 1000.0);
        let speed = |i: usize| {
            let (a, b) = (at(i), at(i + 1));
            1000.0 * ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt()
        };
        (0..1000 * seconds).map(speed).collect()
    }

    #[test]
    fn there_are_fixations_pursuits_and_saccades() {
        let speeds = speeds(12);
        let share = |range: std::ops::Range<f64>| {
            speeds.iter().filter(|speed| range.contains(speed)).count() as f64 / speeds.len() as f64
        };
        assert!(share(0.0..1e-9) > 0.3, "fixations");
        assert!(share(3.9..12.1) > 0.2, "pursuits");
        assert!((0.02..0.2).contains(&share(30.0..600.0)), "saccades");
        assert!(speeds.iter().all(|speed| *speed < 551.0));
    }

    /// Peak velocity and amplitude of each saccade are those of the main sequence.
    #[test]
    fn saccades_follow_the_main_sequence() {
        let (course, speeds) = (GazeCourse::new(1, 13.0), speeds(12));
        let mut begun: Option<(usize, f64)> = None;
        let mut saccades = 0;
        for (i, speed) in speeds.iter().enumerate() {
            begun = match begun {
                None if *speed > 20.0 => Some((i, *speed)),
                Some((from, peak)) if *speed > 20.0 => Some((from, peak.max(*speed))),
                Some((from, peak)) => {
                    let (a, b) = (
                        course.at(from as f64 / 1000.0 - 0.004),
                        course.at(i as f64 / 1000.0 + 0.004),
                    );
                    let amplitude = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
                    let wanted = peak_velocity_deg_s(amplitude);
                    assert!((peak / wanted - 1.0).abs() < 0.06, "{amplitude}: {peak} {wanted}");
                    saccades += 1;
                    None
                }
                None => None,
            };
        }
        assert!(saccades > 10, "{saccades}");
        assert!((peak_velocity_deg_s(10.0) - 281.0).abs() < 1.0);
    }
}
