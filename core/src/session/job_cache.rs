//! Files, built scenes and thread pools that the coordinator keeps between jobs.

use crate::io::Library;
use crate::scene::{MAX_VIEWS, Scene, SceneDoc, build};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::SystemTime;

/// Cache of objects that are expensive to create.
pub(super) struct JobCache {
    resources: Library,
    pools: BTreeMap<usize, Arc<ThreadPool>>,
    /// Most recently built scenes, the newest last.
    frozen: Vec<Frozen>,
}

/// A built scene, with its document and the modification times of its files.
struct Frozen {
    doc: SceneDoc,
    stamps: Vec<Option<SystemTime>>,
    scene: Arc<Scene>,
}

/// Maximum number of built scenes: views of one scene may each have a different majorant or camera.
const KEPT: usize = MAX_VIEWS + 1;

impl JobCache {
    pub fn new(resources: Library) -> Self {
        Self { resources, pools: BTreeMap::new(), frozen: Vec::new() }
    }

    /// Builds the scene of a document, or returns the cached scene.
    pub fn scene(&mut self, doc: &SceneDoc) -> Result<Arc<Scene>, String> {
        let (key, stamps) = (doc.scene_part(), self.resources.stamps(doc));
        if let Some(known) = self.frozen.iter().find(|f| f.doc == key && f.stamps == stamps) {
            return Ok(Arc::clone(&known.scene));
        }
        // The fingerprint is computed in parallel with the build, so that hashing the files adds no time.
        let mut copy = self.resources.clone();
        let (built, ()) = rayon::join(|| build(doc, &mut self.resources), || _ = copy.fingerprint(doc));
        self.resources.learn(copy);
        let scene = Arc::new(built.map_err(|e| e.to_string())?);
        // Scenes that no view renders are dropped first.
        if self.frozen.len() >= KEPT {
            self.frozen.retain(|f| Arc::strong_count(&f.scene) > 1);
            self.frozen.truncate(KEPT - 1);
        }
        self.frozen.push(Frozen { doc: key, stamps, scene: Arc::clone(&scene) });
        Ok(scene)
    }

    /// Fingerprint of the image that unbiased estimates of the document converge to.
    pub fn target(&mut self, doc: &SceneDoc) -> String {
        self.resources.fingerprint(doc)
    }

    /// Pool of `threads` worker threads; one per core if `None`.
    pub fn pool(&mut self, threads: Option<usize>) -> Result<Arc<ThreadPool>, String> {
        let threads =
            threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
        if let Some(pool) = self.pools.get(&threads) {
            return Ok(Arc::clone(pool));
        }
        // Pools that no view uses are dropped, which ends their threads.
        self.pools.retain(|_, pool| Arc::strong_count(pool) > 1);
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("majorant-worker-{i}"))
            .build()
            .map_err(|e| format!("{threads} worker threads could not be started: {e}"))?;
        let pool = Arc::new(pool);
        self.pools.insert(threads, Arc::clone(&pool));
        Ok(pool)
    }
}
