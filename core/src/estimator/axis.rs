//! Settings that only some estimators use.

use crate::scene::{
    Absorption, Bookkeeping, DistanceSampling, Fault, Heuristics, LightSampling, LightSelection, LightWalk,
    Tracking,
};
use crate::transmittance::TransmittanceKind;
use crate::transport::PathSettings;

/// A setting that only some estimators use. Settings that every estimator uses (mode, sampler, directions,
/// depth, roulette) are not axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Treatment of absorption ([`crate::scene::Absorption`]).
    Absorption,
    /// Distance sampling ([`crate::scene::DistanceSampling`]).
    Distances,
    /// MIS heuristic among components.
    Components,
    /// MIS heuristic between techniques.
    Techniques,
    /// Form of the path weights ([`crate::scene::Bookkeeping`]).
    Bookkeeping,
    /// Event probabilities of spectral tracking ([`crate::scene::Tracking`]).
    Tracking,
    /// Choice of the light of a connection ([`crate::scene::LightSelection`]).
    Lights,
    /// Sampling of a direction towards a light ([`crate::scene::LightSampling`]).
    LightSampling,
    /// Transmittance estimator of connections ([`TransmittanceKind`]).
    Transmittance,
    /// Walk that finds lights ([`crate::scene::LightWalk`]).
    LightWalk,
    /// Deliberate error in the path weights ([`crate::scene::Fault`]).
    Fault,
}

impl Axis {
    /// All axes.
    pub const ALL: [Self; 11] = [
        Self::Absorption,
        Self::Distances,
        Self::Components,
        Self::Techniques,
        Self::Bookkeeping,
        Self::Tracking,
        Self::Lights,
        Self::LightSampling,
        Self::Transmittance,
        Self::LightWalk,
        Self::Fault,
    ];

    /// Reason why the setting has no effect on an estimator that does not use it.
    #[must_use]
    pub fn reason_unused(self) -> &'static str {
        match self {
            Self::Absorption => "this estimator always weights scattering by the albedo",
            Self::Distances => "this estimator always uses delta tracking",
            Self::Components => "this estimator does not combine path densities of several components",
            Self::Techniques => "this estimator does not combine techniques by a selectable heuristic",
            Self::Bookkeeping => "only Uni+NEE MIS supports other forms of the path weights",
            Self::Tracking => "only spectral tracking draws events for all components at once",
            Self::Lights | Self::LightSampling => "this estimator does not connect to lights",
            Self::Transmittance => {
                "this estimator makes no connections, or weights them by the density of every null collision, which \
                 other transmittance estimates do not have"
            }
            Self::LightWalk => "only Uni+NEE MIS supports a separate walk to find lights",
            Self::Fault => "faults can be enabled in Uni+NEE MIS only",
        }
    }

    /// The scene key that holds the choice.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Absorption => "estimator.absorption",
            Self::Distances => "estimator.distances",
            Self::Components => "estimator.heuristics.components",
            Self::Techniques => "estimator.heuristics.techniques",
            Self::Bookkeeping => "estimator.bookkeeping",
            Self::Tracking => "estimator.tracking",
            Self::Lights => "estimator.lights",
            Self::LightSampling => "estimator.light_sampling",
            Self::Transmittance => "estimator.transmittance",
            Self::LightWalk => "estimator.light_walk",
            Self::Fault => "estimator.fault",
        }
    }

    const fn bit(self) -> u32 {
        1 << self as u32
    }
}

/// Set of axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisSet(u32);

impl AxisSet {
    /// Creates the set of the listed axes.
    #[must_use]
    pub const fn of(axes: &[Axis]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < axes.len() {
            bits |= axes[i].bit();
            i += 1;
        }
        Self(bits)
    }

    /// Whether the set contains an axis.
    #[must_use]
    pub const fn contains(self, axis: Axis) -> bool {
        self.0 & axis.bit() != 0
    }
}

impl PathSettings {
    /// Returns the settings with every axis that is not in `used` at its default, so that it cannot change an
    /// image.
    #[must_use]
    #[inline]
    pub fn limited_to(mut self, used: AxisSet) -> Self {
        let default = Heuristics::default();
        let unused = |axis| !used.contains(axis);
        if unused(Axis::Absorption) {
            self.absorption = Absorption::default();
        }
        if unused(Axis::Distances) {
            self.distances = DistanceSampling::default();
        }
        if unused(Axis::Components) {
            self.heuristics.components = default.components;
        }
        if unused(Axis::Techniques) {
            self.heuristics.techniques = default.techniques;
        }
        if unused(Axis::Bookkeeping) {
            self.bookkeeping = Bookkeeping::default();
        }
        if unused(Axis::Tracking) {
            self.tracking = Tracking::default();
        }
        if unused(Axis::Lights) {
            self.lights = LightSelection::default();
        }
        if unused(Axis::LightSampling) {
            self.light_sampling = LightSampling::default();
        }
        if unused(Axis::Transmittance) {
            self.transmittance = TransmittanceKind::ALONG_THE_PATH;
        }
        if unused(Axis::LightWalk) {
            self.light_walk = LightWalk::default();
        }
        if unused(Axis::Fault) {
            self.fault = Fault::default();
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::EstimatorDoc;
    use crate::scene::keys::{self, Affects};

    /// Each axis names a row of the table that affects the estimate, and no two axes name the same one.
    #[test]
    fn every_axis_names_a_key_of_its_own() {
        let mut named: Vec<_> = Axis::ALL.map(Axis::key).to_vec();
        for path in &named {
            let key = keys::find(path, None).unwrap_or_else(|| panic!("{path} is no key"));
            assert_eq!(key.affects, Affects::Estimate, "{path}");
        }
        named.sort_unstable();
        named.dedup();
        assert_eq!(named.len(), Axis::ALL.len());
    }

    /// An estimator that uses no axis, or every axis but one, is given the default of that axis and no other change.
    #[test]
    fn an_unused_axis_is_put_to_its_default() {
        let settings = |doc: &EstimatorDoc| crate::estimator::Settings::new(doc, 0).path;
        for axis in Axis::ALL {
            let key = keys::find(axis.key(), None).unwrap();
            let others: Vec<_> = Axis::ALL.into_iter().filter(|other| *other != axis).collect();
            for value in key.values() {
                let name = axis.key().trim_start_matches("estimator.");
                let chosen = settings(&toml::from_str(&format!("{name} = \"{value}\"")).unwrap());
                let default = settings(&EstimatorDoc::default());
                let is_default = key.default_value() == Some(value.into());
                assert_eq!(chosen == default, is_default, "{} = {value}", axis.key());
                assert_eq!(chosen.limited_to(AxisSet::of(&[axis])), chosen, "{} = {value}", axis.key());
                assert_eq!(chosen.limited_to(AxisSet::of(&others)), default, "{} = {value}", axis.key());
                assert_eq!(chosen.limited_to(AxisSet::of(&[])), default, "{} = {value}", axis.key());
            }
        }
    }
}
