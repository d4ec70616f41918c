//! User interface of Majorant: window and command line. All estimates are computed by [`majorant_core`].
//!
//! ```text
//!   panels, image ──► Command ──► lab::logic ──► Document (undo, file)  ──► Session (renders)
//!        ▲                                            │                        │
//!        └──────────── ui draws ◄── ViewState ◄───────┴──── wake() ◄───────────┘
//! ```
//!
//! Widgets edit a draft of the document, which is returned as one command and applied after the frame is
//! drawn. The comparison of documents alone determines what has to be rendered again.

mod background;
mod background_query;
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
