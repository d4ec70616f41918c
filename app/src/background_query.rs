//! Answers to questions, computed in the background.

use crate::background::{Background, Reply};
use majorant_core::transport::CancelToken;
use std::sync::Arc;

/// Computation of one answer; returns `None` once it is cancelled.
type Job<A> = Box<dyn FnOnce(CancelToken<'_>) -> Option<A> + Send>;

/// Answer to the newest question, computed in the background.
pub struct BackgroundQuery<Q, A> {
    background: Background<Job<A>, A>,
    asked: Option<Q>,
    answered: Option<(Q, Option<Arc<A>>)>,
}

impl<Q, A: Send + 'static> Default for BackgroundQuery<Q, A> {
    fn default() -> Self {
        let work = |job: Job<A>, reply: &Reply<'_, Job<A>, A>| {
            if let Some(answer) = job(reply.cancel()) {
                reply.send(answer);
            }
        };
        Self { background: Background::new("query", work), asked: None, answered: None }
    }
}

impl<Q: PartialEq + Clone, A: Send + Sync + 'static> BackgroundQuery<Q, A> {
    /// Returns the answer to a question, or the previous answer while it is being computed, and whether the
    /// answer belongs to this question. `work` returns no answer once it is cancelled; `wake` is called when
    /// it is done.
    pub fn ask(
        &mut self,
        question: &Q,
        wake: impl Fn() + Send + Sync + 'static,
        work: impl FnOnce(CancelToken<'_>) -> Option<A> + Send + 'static,
    ) -> Option<(Arc<A>, bool)> {
        self.poll();
        let last = self.asked.as_ref().or(self.answered.as_ref().map(|(q, _)| q));
        if last != Some(question) {
            self.background.set_wake(wake);
            // If no thread can be started, there is no answer.
            self.asked = self.background.submit(Box::new(work)).is_ok().then(|| question.clone());
        }
        let (of, answer) = self.answered.as_ref()?;
        Some((Arc::clone(answer.as_ref()?), of == question))
    }

    /// Answer to this question, if it is the newest answer.
    #[must_use]
    pub fn answer_to(&self, question: &Q) -> Option<&Arc<A>> {
        let (of, answer) = self.answered.as_ref()?;
        answer.as_ref().filter(|_| of == question)
    }

    /// Newest answer to any question.
    #[must_use]
    pub fn newest(&self) -> Option<&Arc<A>> {
        self.answered.as_ref()?.1.as_ref()
    }

    /// Whether an answer is being computed.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.asked.is_some()
    }

    fn poll(&mut self) {
        let answer = self.background.poll().pop();
        if answer.is_some() || !self.background.is_running() {
            // A question without an answer is not repeated.
            if let Some(question) = self.asked.take() {
                self.answered = Some((question, answer.map(Arc::new)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_question_is_answered_and_the_last_answer_stays_until_then() {
        fn wait(query: &mut BackgroundQuery<u32, u32>, question: u32) -> u32 {
            loop {
                let answer = query.ask(&question, || {}, move |_| Some(question * 2));
                if let Some((answer, true)) = answer {
                    return *answer;
                }
                std::thread::yield_now();
            }
        }
        let mut query = BackgroundQuery::default();
        assert_eq!(wait(&mut query, 1), 2);
        // This question is computed without end, until another one cancels it.
        let endless = |cancel: CancelToken<'_>| {
            while cancel.is_active() {
                std::thread::yield_now();
            }
            None
        };
        let meanwhile = query.ask(&2, || {}, endless);
        assert_eq!(meanwhile.map(|(answer, current)| (*answer, current)), Some((2, false)));
        assert!(query.is_running());
        assert_eq!(wait(&mut query, 3), 6);
    }
}
