//! Prints what every transmittance technique costs and how noisy it is, on profiles whose answer is known.
//!
//! `cargo run --release -p majorant-core --example transmittance`
//!
//! Columns: mean look-ups, relative standard deviation of one estimate, their product variance × look-ups (what a
//! given error costs: smaller is better), and the bias in percent with its standard error.
#![allow(clippy::print_stdout, reason = "it prints a table")]

use majorant_core::math::Sampler;
use majorant_core::transmittance::{Analytic, Marching, Offset, Shape, TransmittanceKind, UnbiasedMarching};

const SAMPLES: u32 = 200_000;

fn row(name: &str, kind: TransmittanceKind, profile: &Analytic<1>) {
    let [truth] = profile.transmittance();
    let (mut sum, mut squares, mut lookups) = (0.0, 0.0, 0.0);
    for i in 0..SAMPLES {
        let found = kind.estimate(profile, &mut Sampler::new(7, u64::from(i), 0));
        // About the truth, so that no digits are lost where there is hardly any variance.
        let off = f64::from(found.weight[0]) / truth - 1.0;
        sum += off;
        squares += off * off;
        lookups += f64::from(found.lookups);
    }
    let n = f64::from(SAMPLES);
    let bias = sum / n;
    let variance = (squares / n - bias * bias).max(0.0);
    println!(
        "  {name:<26} {:>9.2} {:>11.5} {:>13.3e} {:>10.3} ± {:.3}",
        lookups / n,
        variance.sqrt(),
        variance * lookups / n,
        100.0 * bias,
        100.0 * (variance / n).sqrt()
    );
}

fn main() {
    let unmatched = UnbiasedMarching { match_ends: false, ..UnbiasedMarching::default() };
    let others = [
        ("unbiased-marching, no ends", TransmittanceKind::UnbiasedMarching(unmatched)),
        (
            "marching 0.05 midpoint",
            TransmittanceKind::Marching(Marching { step: 0.05, offset: Offset::Midpoint }),
        ),
        (
            "marching 0.25 jittered",
            TransmittanceKind::Marching(Marching { step: 0.25, offset: Offset::Jittered }),
        ),
    ];
    for shape in Shape::ALL {
        for depth in [0.1, 1.0, 4.0, 12.0] {
            for cells in [1, 8] {
                let extinction = (depth / shape.integral(1.0)) as f32;
                let profile = Analytic::new(shape, [extinction], cells);
                println!("{}, optical depth {depth}, {cells} majorant cells", shape.name());
                let all = TransmittanceKind::all().into_iter().map(|kind| (kind.entry().id, kind));
                for (name, kind) in all.chain(others) {
                    row(name, kind, &profile);
                }
            }
        }
    }
}
