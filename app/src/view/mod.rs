//! Image display: pan and zoom on the canvas, tone mapping to textures, camera gestures and overlays.

pub mod camera_control;
pub mod canvas;
pub mod cells_overlay;
pub mod image_view;
pub mod readout;
pub mod tone_mapper;
