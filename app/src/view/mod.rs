//! The picture: where it is on the canvas, how it becomes a texture, how the mouse moves the camera.

pub mod camera_control;
pub mod canvas;
pub mod cells_overlay;
pub mod image_view;
pub mod readout;
pub mod tone_mapper;
