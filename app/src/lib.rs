//! The window of the lab: what a person sees and touches. The numbers come from [`majorant_core`].
//!
//! ```text
//!   panels, image ──► Command ──► lab::logic ──► Document (undo, file)  ──► Session (renders)
//!        ▲                                            │                        │
//!        └──────────── ui draws ◄── ViewState ◄───────┴──── wake() ◄───────────┘
//! ```
//!
//! Widgets edit a draft of the document; the draft comes back as one command and is applied after the
//! frame is drawn. What has to be rendered again is decided by comparing documents, nowhere else.

pub mod cli;
pub mod lab;
pub mod lessons;
pub mod model;
pub mod panels;
pub mod screenshot;
pub mod theme;
pub mod view;
pub mod wall;
pub mod widgets;
