//! Keys of limits, random numbers and display.

use super::{Affects, Default, Key, POSITIVE, Range, SAMPLES, SEEDS, Type};
use Default::{Absent, Is};

const NO_LIMIT: Default = Absent("no limit");
const LEAVE_OUT: &str = "leave it out for no limit";

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "render.spp",
        Type::Integer(SAMPLES),
        NO_LIMIT,
        "Stop at",
        "Rendering stops after this many samples per pixel; more can be added later",
    )
    .unit("spp")
    .cure(LEAVE_OUT)
    .affects(Affects::Limits),
    Key::new(
        "render.seconds",
        Type::Number(POSITIVE),
        NO_LIMIT,
        "Stop after",
        "Rendering stops after this many seconds",
    )
    .unit("s")
    .cure(LEAVE_OUT)
    .affects(Affects::Limits),
    Key::new(
        "render.cpu_seconds",
        Type::Number(POSITIVE),
        NO_LIMIT,
        "CPU time",
        "Rendering stops after this many CPU seconds of path tracing, summed over all worker threads",
    )
    .unit("s")
    .cure(LEAVE_OUT)
    .affects(Affects::Limits),
    Key::new(
        "render.relative_error",
        Type::Number(POSITIVE),
        NO_LIMIT,
        "Error",
        "Rendering stops when the root mean square of the standard error is this fraction of the image's mean",
    )
    .cure("0.01 is one percent of the mean; leave it out for no limit")
    .affects(Affects::Limits),
    Key::new(
        "render.seed",
        Type::Integer(SEEDS),
        Is("0"),
        "Seed",
        "Seed of the random numbers; nothing else is random",
    )
    .affects(Affects::Estimate),
    Key::new(
        "render.threads",
        Type::Integer(Range::closed(1.0, 1024.0)),
        Absent("one per core"),
        "Threads",
        "Number of worker threads; the image does not depend on it",
    )
    .cure("leave it out for one per core")
    .affects(Affects::Limits),
    Key::new(
        "view.exposure_ev",
        Type::Number(Range::closed(-64.0, 64.0)),
        Is("0.0"),
        "Exposure",
        "Displayed value = 2^EV · radiance. E and Shift + E change it by half a stop",
    )
    .unit("EV")
    .affects(Affects::View),
    Key::new(
        "view.tone",
        Type::Choice(&["linear", "reinhard", "filmic"]),
        Is("\"filmic\""),
        "Tone curve",
        "Tone mapping of radiance into the display's range",
    )
    .affects(Affects::View),
    Key::new(
        "view.gamma",
        Type::Number(Range::closed(0.1, 10.0)),
        Absent("sRGB curve"),
        "Gamma",
        "Display gamma instead of the sRGB curve",
    )
    .cure("leave it out for the sRGB curve")
    .affects(Affects::View),
];
