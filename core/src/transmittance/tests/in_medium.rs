//! Rays through media against quadrature along the same ray; majorants, means and gaps are those of
//! [`InMedium`].

use super::*;
use crate::math::Ray;
use crate::medium::*;
use crate::spectrum::{Components, Quantity, RgbChannels, Spectrum, SpectrumDoc};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

const SIZE: usize = 12;

/// Grid of noise, empty in the middle third.
fn grid<const C: usize>() -> Arc<Grid<C>> {
    let mut random = Sampler::new(4, 0, 0);
    let value = |i: usize| {
        let empty = (i % SIZE) / 4 == 1;
        std::array::from_fn(|_| if empty { 0.0 } else { random.next_1d() })
    };
    let values: Vec<[f32; C]> = (0..SIZE.pow(3)).map(value).collect();
    Arc::new(Grid::new([SIZE; 3], values, Lattice::CellCentred).unwrap())
}

fn bounds<const C: usize>(grid: &Grid<C>, cells: usize) -> Arc<MajorantGrid<C>> {
    Arc::new(MajorantGrid::new(grid, cells, Interpolation::Trilinear))
}

fn rgb(rgb: [f32; 3]) -> Spectrum {
    Spectrum::new(&SpectrumDoc::Rgb(rgb), Quantity::Coefficient)
}

fn agrees(medium: AnyMedium, what: &str) {
    let placed = PlacedMedium::new(medium, Region::Cube(Affine3A::IDENTITY));

    // The hero is green.
    let components = RgbChannels::sample(0.5, None);
    let media = Several::<3>::new([&placed], &components, false);
    let direction = Vec3::new(1.0, 0.25, 0.4).normalize();
    let ray = Ray { origin: Vec3::new(-0.5, 0.3, 0.2), direction };
    let profile = InMedium::new(media.traverse(&ray, f32::INFINITY).unwrap().1);
    let steps = 4000u16;
    let mut depth = [0.0f64; 3];
    for piece in profile.pieces() {
        for i in 0..steps {
            let t = piece.segment.t0 + piece.length() * (f32::from(i) + 0.5) / f32::from(steps);
            let found = profile.extinction(t, &piece);
            for (sum, value) in depth.iter_mut().zip(found.0) {
                *sum += f64::from(value * piece.length()) / f64::from(steps);
            }
        }
    }
    let truth = depth.map(|d| (-d).exp());
    assert!(truth.iter().all(|t| (0.02..0.9).contains(t)), "{what}: {truth:?}");
    for kind in unbiased() {
        let found = Measured::of(100_000, 2, |sampler| kind.estimate(&profile, sampler));
        let id = kind.entry().id;
        assert!(
            found.deviation(truth) < LIMIT,
            "{what}, {id}: {:?} ± {:?} {truth:?}",
            found.mean,
            found.error
        );
        assert!(found.blur(truth) < 0.03, "{what}, {id}: {:?}", found.error);
    }
}

#[test]
fn rays_through_a_density_have_the_transmittance_of_their_quadrature() {
    let density = grid::<1>();
    let weighted = WhenExceeded::Weighted;
    for (cells, factor, shared, when_exceeded) in [
        (1, 1.0, false, weighted),
        (6, 1.0, false, weighted),
        (6, 1.0, true, weighted),
        (12, 0.7, false, weighted),
        // The clamped medium has a transmittance of its own.
        (6, 0.5, false, WhenExceeded::Clamp),
    ] {
        let doc = MajorantDoc { factor, shared, when_exceeded, ..MajorantDoc::default() };
        let medium = DensityGrid {
            density: Arc::clone(&density),
            interpolation: Interpolation::Trilinear,
            bounds: bounds(&density, cells),
            extinction: rgb([6.0, 3.0, 1.5]),
            albedo: Spectrum::constant(0.5),
            majorant: MajorantPolicy::new(&doc),
        };
        agrees(AnyMedium::DensityGrid(medium), &format!("density, {cells} cells, {doc:?}"));
    }
}

#[test]
fn rays_through_other_media_do_as_well() {
    let policy = MajorantPolicy::new(&MajorantDoc { factor: 1.3, ..MajorantDoc::default() });
    let field = grid::<3>();
    let extinction = ExtinctionField::Rgb(Arc::clone(&field), bounds(&field, 6), 5.0);
    let albedo = AlbedoField::Uniform(Spectrum::constant(0.5));
    let medium = RgbGrids::new(extinction, albedo, Interpolation::Trilinear, policy);
    agrees(AnyMedium::RgbGrids(medium), "rgb grid");
    let extinction = rgb([2.0, 1.0, 0.5]);
    let medium = Homogeneous { extinction, albedo: Spectrum::constant(0.5), majorant: policy };
    agrees(AnyMedium::Homogeneous(medium), "homogeneous");
}
