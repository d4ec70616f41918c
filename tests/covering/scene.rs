//! Scenes of the covering array: a box with one of four densities, and its reference image.

use super::truth::{self, Field};
use majorant_core::check::{Answer, Layout};
use majorant_core::estimator::Entry;
use majorant_core::io::{Library, scene_file};
use majorant_core::scene::SceneDoc;
use majorant_tests::fixture::npy;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Kind of scene, each with a known reference image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// Absorption only: the transmittance.
    Transmittance,
    /// Single scattering, by quadrature.
    Single,
    /// Radiance 1 from all directions, albedo 1, background hidden: one minus the transmittance.
    Furnace,
}

impl Known {
    /// Kinds of scene for an estimator; one with connections skips the scene without scattering.
    pub fn of(entry: &Entry) -> &'static [Self] {
        const ALL: [Known; 3] = [Known::Single, Known::Furnace, Known::Transmittance];
        if entry.connects() { &ALL[..2] } else { &ALL }
    }
}

/// Source of the density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Density {
    Uniform,
    Constant,
    Rough,
    Colours,
}

impl Density {
    pub const ALL: [Self; 4] = [Self::Uniform, Self::Constant, Self::Rough, Self::Colours];

    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Constant => "constant",
            Self::Rough => "rough",
            Self::Colours => "colours",
        }
    }

    /// Kind of density in a scene file, and the grid file if there is one.
    pub fn kind(self) -> (&'static str, Option<&'static str>) {
        match self {
            Self::Uniform => ("uniform", None),
            Self::Constant => ("grid", Some("constant.npy")),
            Self::Rough => ("grid", Some("rough.npy")),
            Self::Colours => ("rgb-grid", Some("colours.npy")),
        }
    }
}

/// Boundary of the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Boundary {
    Own,
    Box,
    Mesh,
}

impl Boundary {
    pub const ALL: [Self; 3] = [Self::Own, Self::Box, Self::Mesh];

    pub fn name(self) -> &'static str {
        match self {
            Self::Own => "own box",
            Self::Box => "box",
            Self::Mesh => "mesh",
        }
    }

    /// Object of this extent, and the region of the medium.
    fn toml(self, extent: [f64; 3]) -> (String, &'static str) {
        let shape = match self {
            Self::Own => return (String::new(), "grid"),
            Self::Box => format!("kind = \"box\"\ncenter = [0.0, 0.0, 0.0]\nsize = {extent:?}"),
            Self::Mesh => {
                format!("kind = \"mesh\"\nfile = \"cube.obj\"\nplacement = {{ scale = {extent:?} }}")
            }
        };
        let object =
            format!("[[objects]]\nname = \"boundary\"\n{shape}\nmaterial = {{ kind = \"interface\" }}");
        (object, "boundary")
    }
}

/// The unit cube about the origin.
const CUBE: &str = "v -.5 -.5 -.5\nv .5 -.5 -.5\nv -.5 .5 -.5\nv .5 .5 -.5\nv -.5 -.5 .5\nv .5 -.5 .5\nv -.5 .5 .5\nv .5 .5 .5
f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub known: Known,
    pub density: Density,
    /// Whether extinction and albedo depend on the wavelength or channel.
    pub chromatic: bool,
    pub spectral: bool,
    /// Density scale in per cent.
    pub percent: u32,
    /// Length scale in per cent; optical depths are unchanged.
    pub size: u32,
    /// Whether the medium is the sum of two.
    pub two: bool,
    pub boundary: Boundary,
}

const EXTINCTION_NM: [(f64, f64); 3] = [(430.0, 1.2), (540.0, 0.5), (620.0, 0.9)];
const ALBEDO_NM: [(f64, f64); 2] = [(430.0, 0.5), (620.0, 0.9)];
const EXTINCTION_RGB: [f64; 3] = [0.9, 0.5, 1.2];
const ALBEDO_RGB: [f64; 3] = [0.9, 0.7, 0.5];
const EXTINCTION_GREY: f64 = 0.9;
const ALBEDO_GREY: f64 = 0.7;

/// Share of the first of two media in the extinction.
const SHARE: f64 = 0.4;
/// Ratio of its albedo to that of both together.
const BRIGHTER: f64 = 1.1;

impl Place {
    /// Whether the renderer may carry one component for all.
    pub fn achromatic(&self) -> bool {
        !self.chromatic && self.density != Density::Colours
    }

    fn scale(&self) -> f64 {
        f64::from(self.percent) / 100.0
    }

    pub fn toml(&self) -> String {
        let extinction = match (self.chromatic, self.spectral) {
            (false, _) => EXTINCTION_GREY.to_string(),
            (true, false) => format!("{{ rgb = {EXTINCTION_RGB:?} }}"),
            (true, true) => points(&EXTINCTION_NM),
        };
        let albedo = |by: f64| match (self.known, self.chromatic, self.spectral) {
            (Known::Transmittance, ..) => "0.0".into(),
            (Known::Furnace, ..) => "1.0".into(),
            (Known::Single, false, _) => (ALBEDO_GREY * by).to_string(),
            (Known::Single, true, false) => format!("{{ rgb = {:?} }}", ALBEDO_RGB.map(|a| a * by)),
            (Known::Single, true, true) => points(&ALBEDO_NM.map(|(l, a)| (l, a * by))),
        };
        let (kind, file) = self.density.kind();
        let (file, fit) = match file {
            Some(file) => (format!(", file = {file:?}"), "fit = 1.0, "),
            None => (String::new(), ""),
        };
        let size = f64::from(self.size) / 100.0;
        let (sky, lamp, seen, depth) = match self.known {
            Known::Transmittance => (1.0, 1.0, true, ""),
            Known::Furnace => (1.0, 1.0, false, ""),
            Known::Single => (truth::SKY_RADIANCE, truth::LAMP_RADIANCE, false, "max_depth = 2"),
        };
        let (object, within) = self.boundary.toml(truth::EXTENT.map(|x| x * size));
        let medium = |name: &str, share: f64, albedo: String| {
            format!(
                "[[media]]
                name = \"{name}\"
                within = \"{within}\"
                scale = {}
                extinction = {extinction}
                albedo = {albedo}
                phase = {{ kind = \"henyey-greenstein\", g = {} }}
                density = {{ kind = \"{kind}\"{file} }}
                placement = {{ {fit}scale = {:?} }}",
                share * self.scale() / size,
                truth::ASYMMETRY,
                truth::EXTENT.map(|x| x * size),
            )
        };
        let media = if self.two {
            // Shares and albedos of the parts add up to those of the whole.
            let rest = (1.0 - SHARE * BRIGHTER) / (1.0 - SHARE);
            [medium("part", SHARE, albedo(BRIGHTER)), medium("rest", 1.0 - SHARE, albedo(rest))].join("\n")
        } else {
            medium("whole", 1.0, albedo(1.0))
        };
        format!(
            "majorant = 2
            [camera]
            origin = [0.0, 0.0, {:?}]
            target = [0.0, 0.0, 0.0]
            fov_deg = 0.001
            [film]
            width = 2
            height = 2
            {media}
            {object}
            [[lights]]
            kind = \"environment\"
            scale = {sky:?}
            visible = {seen}
            [[lights]]
            kind = \"sphere\"
            center = {:?}
            radius = {:?}
            scale = {lamp:?}
            [estimator]
            {depth}",
            60.0 * size,
            truth::LAMP.map(|x| x * size),
            truth::LAMP_RADIUS * size,
        )
    }

    pub fn document(&self) -> SceneDoc {
        scene_file::parse(&self.toml(), "covering").unwrap_or_else(|e| panic!("{e}"))
    }

    pub fn answer(&self) -> Answer {
        static KNOWN: Mutex<BTreeMap<Place, [f64; 3]>> = Mutex::new(BTreeMap::new());
        let mut known = KNOWN.lock().unwrap();
        let colour = *known.entry(*self).or_insert_with(|| self.colour());
        Answer::uniform(colour, Layout::WHOLE).within(truth::QUADRATURE)
    }

    /// Transmittance of a homogeneous achromatic medium along the axis.
    pub fn transmittance(&self) -> f64 {
        (-self.scale() * EXTINCTION_GREY * truth::EXTENT[2]).exp()
    }

    fn colour(&self) -> [f64; 3] {
        let field: &Field = match self.density {
            Density::Uniform | Density::Constant => &truth::CONSTANT,
            Density::Rough => &truth::ROUGH,
            Density::Colours => &truth::COLOURS,
        };
        let brings = |sigma: [f64; 3], albedo: f64| {
            let sigma = sigma.map(|s| s * self.scale());
            match self.known {
                Known::Furnace => 1.0 - field.transmittance(sigma),
                Known::Transmittance => field.transmittance(sigma),
                Known::Single => albedo * field.single(sigma),
            }
        };
        if self.spectral {
            return truth::film(|lambda| {
                let at = f64::from(lambda);
                let (extinction, albedo) = if self.chromatic {
                    (truth::by_points(&EXTINCTION_NM, at), truth::by_points(&ALBEDO_NM, at))
                } else {
                    (EXTINCTION_GREY, ALBEDO_GREY)
                };
                let sigma = match self.density {
                    Density::Colours => truth::basis(lambda),
                    _ => [extinction, 0.0, 0.0],
                };
                brings(sigma, albedo)
            });
        }
        std::array::from_fn(|c| {
            let (extinction, albedo) = if self.chromatic {
                (EXTINCTION_RGB[c], ALBEDO_RGB[c])
            } else {
                (EXTINCTION_GREY, ALBEDO_GREY)
            };
            let sigma = match self.density {
                Density::Colours => std::array::from_fn(|i| if i == c { 1.0 } else { 0.0 }),
                _ => [extinction, 0.0, 0.0],
            };
            brings(sigma, albedo)
        })
    }
}

fn points(points: &[(f64, f64)]) -> String {
    let points: Vec<_> = points.iter().map(|(l, v)| format!("{l}:{v}")).collect();
    format!("\"{}\"", points.join(", "))
}

pub fn files() -> Library {
    let n = truth::SIZE;
    Library::default()
        .with_volume("constant.npy", npy([n; 3], 1, &vec![1.0; n.pow(3)]))
        .with_volume("rough.npy", npy([n; 3], 1, &truth::rough_values(1)))
        .with_volume("colours.npy", npy([n; 3], 3, &truth::rough_values(3)))
        .with_volume("cube.obj", CUBE.as_bytes())
}
