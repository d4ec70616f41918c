//! What the coordinator keeps between jobs: files, the frozen scene, threads.

use crate::io::Library;
use crate::scene::{MAX_VIEWS, Scene, SceneDoc, build};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::SystemTime;

/// Keeps what is expensive to make.
pub(super) struct JobCache {
    resources: Library,
    pools: BTreeMap<usize, Arc<ThreadPool>>,
    /// The newest frozen scenes, the newest last.
    frozen: Vec<Frozen>,
}

/// A frozen scene with the document and the times of the files that it came from.
struct Frozen {
    doc: SceneDoc,
    stamps: Vec<Option<SystemTime>>,
    scene: Arc<Scene>,
}

/// Views of one scene may each have a majorant or camera of their own.
const KEPT: usize = MAX_VIEWS + 1;

impl JobCache {
    pub fn new(resources: Library) -> Self {
        Self { resources, pools: BTreeMap::new(), frozen: Vec::new() }
    }

    /// Freezes a document, or finds it frozen already.
    pub fn scene(&mut self, doc: &SceneDoc) -> Result<Arc<Scene>, String> {
        let (key, stamps) = (doc.scene_part(), self.resources.stamps(doc));
        if let Some(known) = self.frozen.iter().find(|f| f.doc == key && f.stamps == stamps) {
            return Ok(Arc::clone(&known.scene));
        }
        // Files are read to name the image while they are read to freeze it: hashing costs no time of its own.
        let mut copy = self.resources.clone();
        let (built, ()) = rayon::join(|| build(doc, &mut self.resources), || _ = copy.fingerprint(doc));
        self.resources.learn(copy);
        let scene = Arc::new(built.map_err(|e| e.to_string())?);
        // Those that no view renders any more go first.
        if self.frozen.len() >= KEPT {
            self.frozen.retain(|f| Arc::strong_count(&f.scene) > 1);
            self.frozen.truncate(KEPT - 1);
        }
        self.frozen.push(Frozen { doc: key, stamps, scene: Arc::clone(&scene) });
        Ok(scene)
    }

    /// Names the image that a document's unbiased estimates converge to.
    pub fn target(&mut self, doc: &SceneDoc) -> String {
        self.resources.fingerprint(doc)
    }

    /// A pool of worker threads; one per core if no number is given.
    pub fn pool(&mut self, threads: Option<usize>) -> Result<Arc<ThreadPool>, String> {
        let threads =
            threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));
        if let Some(pool) = self.pools.get(&threads) {
            return Ok(Arc::clone(pool));
        }
        // Threads of pools that no view uses any more end here.
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
