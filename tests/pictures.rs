//! External images with every reader: windows, primaries, invalid texels.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use exr::meta::attribute::{Chromaticities, EnvironmentMap};
use exr::prelude::*;
use majorant_core::compare::Reference;
use majorant_core::io::{Library, picture};
use majorant_core::light;
use majorant_core::scene::{LightDoc, SceneDoc, build};
use std::path::{Path, PathBuf};
use std::sync::Arc;

type Colour = [f32; 3];

/// Properties of a written image.
#[derive(Clone, Copy)]
struct Written {
    /// First pixel and size of the display window.
    display: ([i32; 2], [usize; 2]),
    /// First pixel and size of the data window.
    data: ([i32; 2], [usize; 2]),
    encoding: Encoding,
    chromaticities: Option<Chromaticities>,
    cube: bool,
}

const SIZE: [usize; 2] = [8, 4];

impl Default for Written {
    fn default() -> Self {
        Self {
            display: ([0, 0], SIZE),
            data: ([0, 0], SIZE),
            encoding: Encoding::UNCOMPRESSED,
            chromaticities: None,
            cube: false,
        }
    }
}

impl Written {
    /// Writes the colour of every pixel as a function of its position, with standard errors of 1 % of it.
    fn to(self, path: &Path, colour: impl Fn([i32; 2]) -> Colour) {
        let ([x, y], [width, height]) = self.data;
        let mut channels = SmallVec::new();
        for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
            let plane = |scale: f32| {
                let rows = (y..).take(height).flat_map(|y| (x..).take(width).map(move |x| [x, y]));
                FlatSamples::F32(rows.map(|at| scale * colour(at)[c]).collect())
            };
            channels.push(AnyChannel::new(name, plane(1.0)));
            channels.push(AnyChannel::new(format!("stderr.{name}").as_str(), plane(0.01)));
        }
        let attributes = LayerAttributes {
            layer_position: Vec2(x, y),
            environment_map: self.cube.then_some(EnvironmentMap::Cube),
            ..LayerAttributes::default()
        };
        let layer = Layer::new((width, height), attributes, self.encoding, AnyChannels::sort(channels));
        let mut image = Image::from_layer(layer);
        let ([x, y], [width, height]) = self.display;
        image.attributes.display_window = IntegerBounds::new((x, y), (width, height));
        image.attributes.chromaticities = self.chromaticities;
        image.write().to_file(path).unwrap();
    }
}

/// A unique colour per pixel, never black.
fn plane([x, y]: [i32; 2]) -> Colour {
    [1.0 + (x + 100) as f32, 2.0 + (y + 100) as f32, 0.5 + (x * y + 10_000) as f32]
}

fn folder() -> (tempfile::TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().to_owned();
    (folder, move |name: &str| root.join(name))
}

/// Full content of a panorama: its texels and their sampling distribution.
fn contents(path: &Path) -> String {
    format!("{:?}", picture::read_panorama(path).unwrap().0)
}

fn notices(path: &Path) -> Vec<String> {
    picture::read_panorama(path).unwrap().1
}

#[test]
fn a_picture_is_its_display_window_for_every_reader() {
    let (_folder, path) = folder();
    let tiles = Encoding {
        compression: Compression::RLE,
        blocks: Blocks::Tiles(Vec2(3, 2)),
        line_order: LineOrder::Increasing,
    };
    let cases = [
        ("the same window", ([0, 0], SIZE), ([0, 0], SIZE)),
        ("both windows elsewhere", ([-3, 7], SIZE), ([-3, 7], SIZE)),
        ("the left half", ([0, 0], SIZE), ([0, 0], [4, 4])),
        ("the right half", ([0, 0], SIZE), ([4, 0], [4, 4])),
        ("a crop inside", ([0, 0], SIZE), ([2, 1], [3, 2])),
        ("overscan", ([0, 0], SIZE), ([-2, -1], [12, 6])),
        ("a crop with overscan", ([0, 0], SIZE), ([-2, 1], [5, 9])),
        ("a crop of a window elsewhere", ([-20, 5], SIZE), ([-19, 4], [3, 3])),
    ];
    for (name, display, data) in cases {
        for encoding in [Encoding::UNCOMPRESSED, tiles, Encoding::SMALL_LOSSLESS] {
            let (file, whole) = (path("windows.exr"), path("whole.exr"));
            Written { display, data, encoding, ..Written::default() }.to(&file, plane);
            let stored = |at: [i32; 2]| {
                let ([x, y], [width, height]) = data;
                (x..x + width as i32).contains(&at[0]) && (y..y + height as i32).contains(&at[1])
            };
            let ([x, y], [width, height]) = display;
            let places: Vec<_> =
                (y..).take(height).flat_map(|y| (x..).take(width).map(move |x| [x, y])).collect();
            let is_crop = !places.iter().all(|at| stored(*at));

            let read = picture::read(&file).unwrap();
            let black: Vec<Colour> =
                places.iter().map(|at| if stored(*at) { plane(*at) } else { [0.0; 3] }).collect();
            assert_eq!(([read.width, read.height], &read.pixels), (SIZE, &black), "{name}");

            // The panorama equals that of a full image with black pixels.
            let shifted = |[u, v]: [i32; 2]| black[(v * 8 + u) as usize];
            Written::default().to(&whole, shifted);
            assert_eq!(contents(&file), contents(&whole), "{name}");
            let differ = display != data;
            assert_eq!(notices(&file).len(), usize::from(differ), "{name}: {:?}", notices(&file));
            assert_eq!(notices(&file).iter().any(|n| n.contains("are black")), is_crop, "{name}");

            // Missing pixels of a reference are unknown.
            let reference = Reference::read(&file).unwrap();
            assert_eq!([reference.width, reference.height], SIZE);
            let errors = reference.standard_error().unwrap();
            for ((at, mean), error) in places.iter().zip(reference.mean()).zip(errors) {
                if stored(*at) {
                    assert_eq!((*mean, *error), (plane(*at), plane(*at).map(|x| 0.01 * x)), "{name} {at:?}");
                } else {
                    assert!(mean.iter().chain(error).all(|x| x.is_nan()), "{name} {at:?}");
                }
            }
            assert_eq!(reference.notices.len(), usize::from(differ), "{name}: {:?}", reference.notices);

            let info = picture::exr_info(&file).unwrap();
            assert_eq!([info.width, info.height], SIZE, "{name}");
            assert_eq!(
                (info.display_window == info.data_window, info.notices.is_empty()),
                (!differ, !differ)
            );
        }
    }
    // An image without pixels in the display window is neither a panorama nor a reference.
    let nowhere = path("nowhere.exr");
    Written { data: ([100, 100], SIZE), ..Written::default() }.to(&nowhere, plane);
    assert!(picture::read_panorama(&nowhere).is_err());
    assert!(Reference::read(&nowhere).unwrap_err().to_string().contains("display window"));
}

#[test]
fn a_display_window_beyond_memory_is_refused() {
    let (_folder, path) = folder();
    let file = path("huge.exr");
    Written { display: ([0, 0], [1 << 20, 1 << 20]), ..Written::default() }.to(&file, plane);
    for error in
        [picture::read(&file).err(), picture::read_panorama(&file).err(), picture::exr_info(&file).err()]
    {
        assert!(error.unwrap().to_string().contains("128000000 pixels"));
    }
    assert!(Reference::read(&file).is_err());
}

#[test]
fn texels_that_are_no_radiance_are_repaired_by_kind_and_told() {
    let (_folder, path) = folder();
    let with = |name: &str, texel: Colour| {
        let file = path(name);
        Written::default().to(&file, |at| if at == [3, 2] { texel } else { [0.5, 0.25, 0.125] });
        file
    };
    let largest = 65504.0;
    for (texel, becomes, words) in [
        ([f32::INFINITY; 3], [largest; 3], &["1 infinite texel(s) set to 65504"][..]),
        ([f32::INFINITY, 2.0, 1.0], [largest, 2.0, 1.0], &["infinite"]),
        ([f32::MAX; 3], [largest; 3], &["infinite"]),
        ([f32::NAN, 2.0, 1.0], [0.0, 2.0, 1.0], &["1 texel(s) with a channel that is not a number"]),
        ([-1.0, 2.0, 1.0], [0.0, 2.0, 1.0], &["1 texel(s) with a channel below 0"]),
        ([f32::NEG_INFINITY, 2.0, 1.0], [0.0, 2.0, 1.0], &["below 0"]),
        ([f32::NAN, f32::INFINITY, -1.0], [0.0, largest, 0.0], &["infinite", "not a number", "below 0"]),
        ([1e6, 2e7, 1e29], [1e6, 2e7, 1e29], &[]),
    ] {
        let (file, expected) = (with("sun.exr", texel), with("expected.exr", becomes));
        assert_eq!(contents(&file), contents(&expected), "{texel:?}");
        let told = notices(&file);
        assert_eq!(told.len(), words.len(), "{told:?}");
        for (notice, word) in told.iter().zip(words) {
            assert!(notice.contains(word) && notice.contains("sun.exr"), "{told:?}");
        }
    }
    // Half floats give the same texel, and the illuminance of such a map is finite.
    let half = path("half.exr");
    let texel = |at: Vec2<usize>| if at == Vec2(3, 2) { f32::INFINITY } else { 0.5 };
    let pixel = |x: usize, y: usize| [texel(Vec2(x, y)); 3].map(f16::from_f32).into();
    let pixel = |x, y| -> (f16, f16, f16) { pixel(x, y) };
    write_rgb_file(&half, 8, 4, pixel).unwrap();
    let whole = path("float.exr");
    Written::default().to(&whole, |at| if at == [3, 2] { [largest; 3] } else { [0.5; 3] });
    assert_eq!(contents(&half), contents(&whole));
    let all = path("all.exr");
    Written::default().to(&all, |_| [f32::MAX; 3]);
    for file in [half, all] {
        let panorama = Arc::new(picture::read_panorama(&file).unwrap().0);
        let map = light::EnvironmentMap { panorama, scale: 1.0, rotate: 0.0 };
        assert!(map.illuminance().is_finite() && map.illuminance() > 100.0, "{}", map.illuminance());
    }
}

const AP0: Chromaticities = Chromaticities {
    red: Vec2(0.7347, 0.2653),
    green: Vec2(0.0, 1.0),
    blue: Vec2(0.0001, -0.077),
    white: Vec2(0.32168, 0.33767),
};

/// Published conversion from ACES2065-1 to linear Rec. 709 with Bradford adaptation.
fn srgb_of_ap0([r, g, b]: Colour) -> Colour {
    let row = |m: [f32; 3]| m[0] * r + m[1] * g + m[2] * b;
    [
        row([2.521_686, -1.134_131, -0.387_555]),
        row([-0.276_480, 1.372_719, -0.096_239]),
        row([-0.015_378, -0.152_975, 1.168_353]),
    ]
}

#[test]
fn foreign_primaries_become_linear_srgb_for_every_reader() {
    let (_folder, path) = folder();
    let file = path("ap0.exr");
    let colour = |[x, y]: [i32; 2]| [1.0 + x as f32, 2.0 + y as f32, 3.0];
    Written { chromaticities: Some(AP0), ..Written::default() }.to(&file, colour);
    let at = |i: usize| [(i % 8) as i32, (i / 8) as i32];
    let close = |found: &[Colour], word: &str| {
        for (i, found) in found.iter().enumerate() {
            let expected = srgb_of_ap0(colour(at(i)));
            assert!(
                found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-3),
                "{word}: {found:?} {expected:?}"
            );
        }
    };
    close(&picture::read(&file).unwrap().pixels, "read");
    let reference = Reference::read(&file).unwrap();
    close(reference.mean(), "reference");
    // Standard errors are bounds: at least those of fully correlated channels.
    for (mean, error) in reference.mean().iter().zip(reference.standard_error().unwrap()) {
        assert!(mean.iter().zip(error).all(|(m, e)| *e >= 0.0099 * m.abs()), "{mean:?} {error:?}");
    }
    for notices in [notices(&file), reference.notices.clone(), picture::exr_info(&file).unwrap().notices] {
        assert!(notices[0].contains("0.7347") && notices[0].contains("Bradford"), "{notices:?}");
    }
    // As a light, colours out of gamut are clamped and counted.
    let clamped: Vec<Colour> =
        picture::read(&file).unwrap().pixels.iter().map(|p| p.map(|x| x.max(0.0))).collect();
    let expected = path("srgb.exr");
    Written::default().to(&expected, |[x, y]| clamped[(y * 8 + x) as usize]);
    assert_eq!(contents(&file), contents(&expected));
    let negative = picture::read(&file).unwrap().pixels.iter().filter(|p| p.iter().any(|x| *x < 0.0)).count();
    assert!(
        negative > 0 && notices(&file)[1].contains(&format!("{negative} texel(s)")),
        "{:?}",
        notices(&file)
    );
    // An infinite texel in other primaries is clamped before it is converted.
    Written { chromaticities: Some(AP0), ..Written::default() }
        .to(&file, |at| if at == [3, 2] { [f32::INFINITY; 3] } else { [0.5; 3] });
    let repaired = format!("{:?}", picture::read_panorama(&file).unwrap());
    assert!(!repaired.contains("inf,") && !repaired.contains("NaN,"), "{repaired}");

    // Explicit and implicit sRGB primaries give identical results.
    let rec709 = Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.3, 0.6),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.329),
    };
    let degenerate = Chromaticities { red: Vec2(0.0, 0.0), green: Vec2(0.0, 0.0), ..rec709 };
    let unsaid = path("unsaid.exr");
    Written::default().to(&unsaid, plane);
    for (chromaticities, notice) in [(rec709, None), (degenerate, Some("span no colour space"))] {
        Written { chromaticities: Some(chromaticities), ..Written::default() }.to(&file, plane);
        assert_eq!(contents(&file), contents(&unsaid));
        assert_eq!(Reference::read(&file).unwrap().mean(), Reference::read(&unsaid).unwrap().mean());
        let told = notices(&file);
        assert_eq!(told.len(), usize::from(notice.is_some()), "{told:?}");
        assert!(notice.is_none_or(|notice| told[0].contains(notice)), "{told:?}");
    }
}

#[test]
fn a_cube_map_is_no_panorama() {
    let (_folder, path) = folder();
    let file = path("cube.exr");
    Written { cube: true, ..Written::default() }.to(&file, plane);
    let error = picture::read_panorama(&file).unwrap_err().to_string();
    assert!(error.contains("cube map") && error.contains("cube.exr"), "{error}");
}

/// Images of other writers, see `pictures/README.md`.
#[test]
fn the_files_of_other_writers_are_what_they_mean() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures");
    let path = |name: &str| folder.join(name);
    for (file, same, word) in [
        ("left_half.exr", "whole.exr", "are black"),
        ("sun_half_inf.exr", "sun_65504.exr", "65504"),
        ("luminance.exr", "white.exr", "luminance"),
    ] {
        assert_eq!(contents(&path(file)), contents(&path(same)), "{file}");
        assert!(notices(&path(file))[0].contains(word), "{:?}", notices(&path(file)));
        assert!(notices(&path(same)).is_empty());
    }
    for pixel in picture::read(&path("ap0.exr")).unwrap().pixels {
        assert!(pixel.iter().zip([0.5, 1.0, 2.0]).all(|(a, b)| (a - b).abs() < 1e-3), "{pixel:?}");
    }
}

#[test]
fn a_scene_tells_what_its_picture_was_made_of() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures");
    let notices = |file: &str| {
        let light = LightDoc::EnvironmentMap {
            file: file.into(),
            rotate_deg: 0.0,
            scale: 1.0,
            visible: true,
            enabled: true,
        };
        let doc = SceneDoc { lights: vec![light], ..SceneDoc::default() };
        let mut library = Library::default().with_base(&folder);
        // The second time from the cache.
        build(&doc, &mut library).unwrap();
        build(&doc, &mut library).unwrap().notices
    };
    for (file, word) in
        [("left_half.exr", "black"), ("sun_half_inf.exr", "infinite"), ("ap0.exr", "Bradford")]
    {
        let told = notices(file);
        assert!(told.len() == 1 && told[0].contains(word) && told[0].contains(file), "{told:?}");
    }
    assert!(notices("whole.exr").is_empty());
}
