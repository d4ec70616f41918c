//! Tests of bricks against the plain array that they represent.

use super::*;
use crate::math::Sampler;

fn ramp(lattice: Lattice) -> Grid<1> {
    let values = (0..2 * 3 * 4).map(|i| [i as f32]).collect();
    Grid::new([2, 3, 4], values, lattice).expect("the sizes agree")
}

#[test]
fn samples_are_at_the_positions_of_the_lattice() {
    let cell = ramp(Lattice::CellCentred);
    let vertex = ramp(Lattice::VertexCentred);
    let mut i = 0.0;
    for z in 0..4u8 {
        for y in 0..3u8 {
            for x in 0..2u8 {
                let p = Vec3::new(x.into(), y.into(), z.into());
                let n = Vec3::new(2.0, 3.0, 4.0);
                assert!((cell.at((p + 0.5) / n)[0] - i).abs() < 1e-4);
                assert!((vertex.at(p / (n - 1.0))[0] - i).abs() < 1e-4);
                i += 1.0;
            }
        }
    }
}

#[test]
fn values_are_linear_between_and_held_at_the_border() {
    let cell = ramp(Lattice::CellCentred);
    assert!((cell.at(Vec3::new(0.5, 0.5, 0.5))[0] - 11.5).abs() < 1e-5);
    assert_eq!(cell.at(Vec3::ZERO)[0], 0.0);
    assert_eq!(cell.at(Vec3::ONE)[0], 23.0);
    assert_eq!(cell.max(), [23.0]);
}

#[test]
fn sizes_that_do_not_fit_are_refused() {
    assert!(Grid::<1>::new([2, 2, 2], vec![[0.0]; 7], Lattice::CellCentred).is_none());
    assert!(Grid::<1>::new([0, 2, 2], vec![], Lattice::CellCentred).is_none());
    assert!(Grid::<1>::new([usize::MAX, 2, 2], vec![], Lattice::CellCentred).is_none());
}

/// Noise in a ball, zero around it.
fn ball<const C: usize>(size: [usize; 3], random: &mut Sampler) -> Vec<[f32; C]> {
    let n = Vec3::from(size.map(|n| n as f32));
    (0..size.iter().product())
        .map(|i: usize| {
            let at = [i % size[0], i / size[0] % size[1], i / size[0] / size[1]];
            let place = Vec3::from(at.map(|i| i as f32 + 0.5)) / n - 0.5;
            let inside = place.length() < 0.45;
            std::array::from_fn(|_| if inside { random.next_1d() } else { 0.0 })
        })
        .collect()
}

/// Trilinear interpolation in the plain array, in double precision.
fn plain<const C: usize>(size: [usize; 3], values: &[[f32; C]], lattice: Lattice, unit: Vec3) -> [f64; C] {
    let mut sum = [0.0; C];
    let axes: [_; 3] = std::array::from_fn(|a| {
        let n = size[a] as f64;
        let x = match lattice {
            Lattice::CellCentred => f64::from(unit[a]) * n - 0.5,
            Lattice::VertexCentred => f64::from(unit[a]) * (n - 1.0),
        };
        let x = x.clamp(0.0, n - 1.0);
        (x.floor() as usize, x.fract())
    });
    for corner in 0..8usize {
        let mut weight = 1.0;
        let at: [usize; 3] = std::array::from_fn(|a| {
            let (i, f) = axes[a];
            let upper = corner >> a & 1;
            weight *= if upper == 1 { f } else { 1.0 - f };
            (i + upper).min(size[a] - 1)
        });
        let value = values[at[0] + size[0] * (at[1] + size[1] * at[2])];
        for c in 0..C {
            sum[c] += weight * f64::from(value[c]);
        }
    }
    sum
}

fn agrees<const C: usize>(size: [usize; 3], packing: Packing, lattice: Lattice) {
    let mut random = Sampler::new(2, 7, 1);
    let values = ball::<C>(size, &mut random);
    let grid = Grid::packed(size, &values, lattice, packing).expect("the sizes agree");
    let bound = match packing.precision {
        Precision::F32 => 0.0,
        Precision::F16 => 1.0 / 2048.0,
        Precision::U8 => 1.0 / 510.0,
    };
    assert!(grid.storage_error() <= bound * 1.001, "{packing:?}: {}", grid.storage_error());
    assert_eq!(grid.storage_error() > 0.0, packing.precision != Precision::F32);
    let tolerance = f64::from(grid.storage_error()) + 2e-5;
    for _ in 0..4000 {
        let unit = Vec3::new(random.next_1d(), random.next_1d(), random.next_1d()) * 1.02 - 0.01;
        let (found, truth) = (grid.at(unit), plain(size, &values, lattice, unit));
        for c in 0..C {
            assert!(
                (f64::from(found[c]) - truth[c]).abs() < tolerance,
                "{packing:?} {unit}: {found:?} {truth:?}"
            );
        }
    }
    for (i, value) in values.iter().enumerate().step_by(7) {
        let kept = grid.sample([i % size[0], i / size[0] % size[1], i / size[0] / size[1]]);
        for c in 0..C {
            assert!((kept[c] - value[c]).abs() <= grid.storage_error());
        }
    }
    assert_eq!(grid.occupied(), values.iter().filter(|v| **v != [0.0; C]).count());
}

#[test]
fn bricks_hold_the_field_of_the_array_they_represent() {
    for precision in [Precision::F32, Precision::F16, Precision::U8] {
        for (size, phase) in [([19, 8, 33], [0, 0, 0]), ([19, 8, 33], [7, 3, 5]), ([1, 9, 16], [1, 0, 7])] {
            for lattice in [Lattice::CellCentred, Lattice::VertexCentred] {
                agrees::<1>(size, Packing { precision, phase }, lattice);
                agrees::<3>(size, Packing { precision, phase }, lattice);
            }
        }
    }
}

#[test]
fn one_fetch_is_the_trilinear_value_in_the_mean() {
    let mut random = Sampler::new(3, 1, 1);
    let size = [9, 10, 11];
    let values = ball::<1>(size, &mut random);
    let grid = Grid::new(size, values.clone(), Lattice::CellCentred).expect("the sizes agree");
    for unit in [Vec3::new(0.31, 0.52, 0.47), Vec3::new(0.0, 1.0, 0.5), Vec3::splat(0.61)] {
        let n = 20u8;
        let number = |i: u8| (f32::from(i) + 0.5) / f32::from(n);
        let mut mean = 0.0;
        for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
            let [value] = grid.at_stochastic(unit, Vec3::new(number(i), number(j), number(k)));
            assert!(values.contains(&[value]), "{value} is no sample");
            mean += value / f32::from(n).powi(3);
        }
        assert!((mean - grid.at(unit)[0]).abs() < 0.03, "{unit}: {mean} {:?}", grid.at(unit));
    }
}

#[test]
fn memory_is_that_of_the_voxels_that_hold_something() {
    // A ball in one corner of an otherwise empty box, aligned with bricks and unaligned.
    let (n, r) = (160usize, 56.0f32);
    for phase in [0, 3] {
        let value = |i: usize| {
            let at = Vec3::new((i % n) as f32, (i / n % n) as f32, (i / n / n) as f32);
            [if at.distance(Vec3::splat(60.0)) < r { 1.0 } else { 0.0 }]
        };
        let values: Vec<_> = (0..n * n * n).map(value).collect();
        let packing = |precision| Packing { precision, phase: [phase; 3] };
        let grid = |p| Grid::packed([n; 3], &values, Lattice::VertexCentred, packing(p)).expect("it fits");
        let full = grid(Precision::F32);
        let needed = 4 * full.occupied();
        assert!(full.bytes() * 2 < needed * 3, "{} bytes where {needed} are needed", full.bytes());
        assert!(full.bytes() * 4 < 4 * n * n * n, "no better than the array");
        let mut row = Vec::new();
        assert!(!full.row([140, 140], &mut row) && full.row([60, 61], &mut row) && row.len() == n);
        assert!((0..n).all(|x| row[x] == full.sample([x, 60, 61])));
        let quarter = grid(Precision::U8).bytes() - 4 * n.div_ceil(BRICK_EDGE).pow(3);
        assert!(quarter * 4 <= full.bytes() && grid(Precision::F16).bytes() * 19 < full.bytes() * 10);
    }
}
