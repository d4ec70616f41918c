//! Something that is worked out on a thread of its own for whoever asks last.

use majorant_core::transport::CancelToken;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread::JoinHandle;

/// A question that is being answered.
struct Running<Q, A> {
    question: Q,
    generation: Arc<AtomicU64>,
    answer: Receiver<A>,
    thread: JoinHandle<()>,
}

/// The answer to the newest question, or the way to it.
pub struct Errand<Q, A> {
    running: Option<Running<Q, A>>,
    done: Option<(Q, Option<Arc<A>>)>,
    leaving: Vec<JoinHandle<()>>,
}

impl<Q, A> Default for Errand<Q, A> {
    fn default() -> Self {
        Self { running: None, done: None, leaving: Vec::new() }
    }
}

/// The program waits for its threads when it ends.
impl<Q, A> Drop for Errand<Q, A> {
    fn drop(&mut self) {
        self.cancel();
        for thread in self.leaving.drain(..) {
            // A panic in it has ended its answer.
            let _ = thread.join();
        }
    }
}

impl<Q, A> Errand<Q, A> {
    fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.generation.store(1, Ordering::Relaxed);
            self.leaving.push(running.thread);
        }
    }

    fn poll(&mut self) {
        self.leaving.retain(|thread| !thread.is_finished());
        let Some(running) = &self.running else { return };
        let answer = match running.answer.try_recv() {
            Ok(answer) => Some(Arc::new(answer)),
            Err(TryRecvError::Empty) => return,
            // There is none; asking again would not help.
            Err(TryRecvError::Disconnected) => None,
        };
        if let Some(running) = self.running.take() {
            self.leaving.push(running.thread);
            self.done = Some((running.question, answer));
        }
    }
}

impl<Q: PartialEq + Clone, A: Send + Sync + 'static> Errand<Q, A> {
    /// The answer to a question, or to the last one while this is worked out; says whether it is this one's. `work` gives
    /// no answer once it is not wanted any more; `wake` is called when there is one.
    pub fn ask(
        &mut self,
        question: &Q,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(CancelToken<'_>) -> Option<A> + Send + 'static,
    ) -> Option<(Arc<A>, bool)> {
        self.poll();
        let asked = self.running.as_ref().map(|r| &r.question).or(self.done.as_ref().map(|(q, _)| q));
        if asked != Some(question) {
            self.cancel();
            self.start(question.clone(), wake, work);
        }
        let (of, answer) = self.done.as_ref()?;
        Some((Arc::clone(answer.as_ref()?), of == question))
    }

    /// The answer to this question, if it is the newest.
    #[must_use]
    pub fn answer_to(&self, question: &Q) -> Option<&Arc<A>>
    where
        Q: PartialEq,
    {
        let (of, answer) = self.done.as_ref()?;
        answer.as_ref().filter(|_| of == question)
    }

    /// The newest answer, whatever it is of.
    #[must_use]
    pub fn newest(&self) -> Option<&Arc<A>> {
        self.done.as_ref()?.1.as_ref()
    }

    /// Whether an answer is being worked out.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    fn start(
        &mut self,
        question: Q,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(CancelToken<'_>) -> Option<A> + Send + 'static,
    ) {
        let generation = Arc::new(AtomicU64::new(0));
        let theirs = Arc::clone(&generation);
        let (sender, answer) = channel();
        let run = move || {
            if let Some(answer) = work(CancelToken::new(&theirs, 0)) {
                // The window may be gone by now; then nobody wants to know.
                let _ = sender.send(answer);
            }
            drop(sender);
            wake();
        };
        // Without a thread there is no answer, and the place for it stays empty.
        if let Ok(thread) = std::thread::Builder::new().name("majorant-errand".into()).spawn(run) {
            self.running = Some(Running { question, generation, answer, thread });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait(errand: &mut Errand<u32, u32>, question: u32) -> u32 {
        loop {
            let answer = errand.ask(&question, || {}, move |_| Some(question * 2));
            if let Some((answer, true)) = answer {
                return *answer;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn the_newest_question_is_answered_and_the_last_answer_stays_until_then() {
        let mut errand = Errand::default();
        assert_eq!(wait(&mut errand, 1), 2);
        // A question that takes for ever, until another one is asked.
        let endless = |cancel: CancelToken<'_>| {
            while cancel.is_active() {
                std::thread::yield_now();
            }
            None
        };
        let meanwhile = errand.ask(&2, || {}, endless);
        assert_eq!(meanwhile.map(|(answer, current)| (*answer, current)), Some((2, false)));
        assert!(errand.is_running());
        assert_eq!(wait(&mut errand, 3), 6);
    }
}
