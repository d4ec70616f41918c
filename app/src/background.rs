//! Background work on a separate thread, so that no frame waits for it.
//!
//! A [`Background`] owns one named thread, which is started with its first order. Orders arrive through an
//! [`Inbox`]; answers are sent through a [`Reply`] and are queued until the window polls. Every answer
//! belongs to an epoch: cancellation begins a new epoch, in which the answers to older orders are dropped.

use majorant_core::transport::CancelToken;
use std::collections::VecDeque;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Callback that requests another frame from the window.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

struct State<Order, Answer> {
    orders: VecDeque<(u64, Order)>,
    answers: VecDeque<Answer>,
    /// Number of completed orders of this epoch.
    done: usize,
    closed: bool,
    wake: Wake,
}

struct Shared<Order, Answer> {
    state: Mutex<State<Order, Answer>>,
    changed: Condvar,
    epoch: AtomicU64,
}

impl<Order, Answer> Shared<Order, Answer> {
    /// Locks the state. Every change leaves it consistent, so that a poisoned lock remains valid.
    fn lock(&self) -> MutexGuard<'_, State<Order, Answer>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn epoch(&self) -> u64 {
        self.epoch.load(Ordering::Acquire)
    }

    /// Waits for an order, and at least until `rested`. `None` once the [`Background`] is dropped.
    fn next(&self, rested: Instant) -> Option<(u64, Order)> {
        let mut state = self.lock();
        loop {
            if state.closed {
                return None;
            }
            let left = rested.saturating_duration_since(Instant::now());
            state = match (state.orders.is_empty(), left.is_zero()) {
                (false, true) => return state.orders.pop_front(),
                (false, false) => {
                    self.changed.wait_timeout(state, left).unwrap_or_else(PoisonError::into_inner).0
                }
                (true, _) => self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
            };
        }
    }

    /// Changes the state unless the epoch has ended, and wakes the window.
    fn report(&self, epoch: u64, change: impl FnOnce(&mut State<Order, Answer>)) {
        let mut state = self.lock();
        if epoch == self.epoch() {
            change(&mut state);
        }
        let wake = Arc::clone(&state.wake);
        drop(state);
        wake();
    }
}

/// Sending end for orders; cheap to clone and usable from any thread.
pub struct Inbox<Order, Answer>(Arc<Shared<Order, Answer>>);

impl<Order, Answer> Clone for Inbox<Order, Answer> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<Order, Answer> Default for Inbox<Order, Answer> {
    fn default() -> Self {
        let state = State {
            orders: VecDeque::new(),
            answers: VecDeque::new(),
            done: 0,
            closed: false,
            wake: Arc::new(|| {}),
        };
        Self(Arc::new(Shared { state: Mutex::new(state), changed: Condvar::new(), epoch: AtomicU64::new(0) }))
    }
}

impl<Order, Answer> Inbox<Order, Answer> {
    /// Replaces all queued orders by this one; the order in progress is completed.
    pub fn replace(&self, order: Order) {
        let mut state = self.0.lock();
        state.orders.clear();
        state.orders.push_back((self.0.epoch(), order));
        drop(state);
        self.0.changed.notify_one();
    }

    fn push(&self, order: Order) {
        self.0.lock().orders.push_back((self.0.epoch(), order));
        self.0.changed.notify_one();
    }
}

/// Sending end of the worker for the answers to one order.
pub struct Reply<'a, Order, Answer> {
    shared: &'a Shared<Order, Answer>,
    epoch: u64,
}

impl<Order, Answer> Reply<'_, Order, Answer> {
    /// Adds an answer and wakes the window.
    pub fn send(&self, answer: Answer) {
        self.shared.report(self.epoch, |state| state.answers.push_back(answer));
    }

    /// Merges an answer with the last unpolled one, so that the queue does not grow while the window is
    /// hidden.
    pub fn merge(&self, answer: Answer, merged: impl FnOnce(Answer, Answer) -> Answer) {
        self.shared.report(self.epoch, |state| {
            let answer = match state.answers.pop_back() {
                Some(older) => merged(older, answer),
                None => answer,
            };
            state.answers.push_back(answer);
        });
    }

    /// Token that is cancelled together with the order.
    #[must_use]
    pub fn cancel(&self) -> CancelToken<'_> {
        CancelToken::new(&self.shared.epoch, self.epoch)
    }
}

type Work<Order, Answer> = Arc<dyn Fn(Order, &Reply<'_, Order, Answer>) + Send + Sync>;

/// Handle of one worker thread. Dropping it cancels the order in progress and joins the thread.
pub struct Background<Order, Answer> {
    name: &'static str,
    inbox: Inbox<Order, Answer>,
    work: Work<Order, Answer>,
    /// Minimum time between the starts of two orders, as a function of the duration of the first.
    rest: Arc<dyn Fn(Duration) -> Duration + Send + Sync>,
    thread: Option<JoinHandle<()>>,
    /// Number of orders of this epoch.
    submitted: usize,
    /// Number of orders of this epoch that were complete at the last poll.
    done: usize,
    failed: bool,
}

impl<Order, Answer> fmt::Debug for Background<Order, Answer> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Background").field("name", &self.name).field("submitted", &self.submitted).finish()
    }
}

impl<Order: Send + 'static, Answer: Send + 'static> Background<Order, Answer> {
    /// Creates a worker that executes every order with `work`; its thread is called `majorant-{name}`.
    #[must_use]
    pub fn new(
        name: &'static str,
        work: impl Fn(Order, &Reply<'_, Order, Answer>) + Send + Sync + 'static,
    ) -> Self {
        Self {
            name,
            inbox: Inbox::default(),
            work: Arc::new(work),
            rest: Arc::new(|_| Duration::ZERO),
            thread: None,
            submitted: 0,
            done: 0,
            failed: false,
        }
    }

    /// Takes orders from an existing inbox.
    #[must_use]
    pub fn with_inbox(mut self, inbox: Inbox<Order, Answer>) -> Self {
        self.inbox = inbox;
        self
    }

    /// Sets the minimum time between the starts of two orders, as a function of the duration of the first.
    #[must_use]
    pub fn resting(mut self, rest: impl Fn(Duration) -> Duration + Send + Sync + 'static) -> Self {
        self.rest = Arc::new(rest);
        self
    }

    /// Sets the callback that is called after every answer.
    pub fn set_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.inbox.0.lock().wake = Arc::new(wake);
    }

    /// Starts the thread if it does not exist or has ended.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn start(&mut self) -> std::io::Result<()> {
        if self.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
            return Ok(());
        }
        let (shared, work, rest) =
            (Arc::clone(&self.inbox.0), Arc::clone(&self.work), Arc::clone(&self.rest));
        let run = move || {
            let mut rested = Instant::now();
            while let Some((epoch, order)) = shared.next(rested) {
                let started = Instant::now();
                work(order, &Reply { shared: &shared, epoch });
                rested = started + rest(started.elapsed());
                shared.report(epoch, |state| state.done += 1);
            }
        };
        self.thread = Some(std::thread::Builder::new().name(format!("majorant-{}", self.name)).spawn(run)?);
        Ok(())
    }

    /// Sending end for orders.
    #[must_use]
    pub fn inbox(&self) -> &Inbox<Order, Answer> {
        &self.inbox
    }

    /// Cancels all orders and submits this one.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn submit(&mut self, order: Order) -> std::io::Result<()> {
        self.cancel();
        self.queue(order)
    }

    /// Appends an order to the queue.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn queue(&mut self, order: Order) -> std::io::Result<()> {
        self.start()?;
        self.failed = false;
        self.submitted += 1;
        self.inbox.push(order);
        Ok(())
    }

    /// Cancels all orders and drops unpolled answers.
    pub fn cancel(&mut self) {
        let mut state = self.inbox.0.lock();
        self.inbox.0.epoch.fetch_add(1, Ordering::AcqRel);
        state.orders.clear();
        state.answers.clear();
        state.done = 0;
        (self.submitted, self.done) = (0, 0);
    }

    /// Returns the answers since the last call.
    pub fn poll(&mut self) -> Vec<Answer> {
        // Read before the answers: a thread that ends later is detected by the next poll.
        let dead = self.thread.as_ref().is_some_and(JoinHandle::is_finished);
        let mut state = self.inbox.0.lock();
        self.done = state.done;
        let answers = std::mem::take(&mut state.answers).into();
        drop(state);
        if dead && self.is_running() {
            self.failed = true;
            self.cancel();
        }
        answers
    }

    /// Whether an order was queued or in progress at the last poll.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.submitted > self.done
    }

    /// Whether the last order ended in a panic of the worker.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.failed
    }
}

impl<Order, Answer> Drop for Background<Order, Answer> {
    fn drop(&mut self) {
        {
            let mut state = self.inbox.0.lock();
            self.inbox.0.epoch.fetch_add(1, Ordering::AcqRel);
            state.closed = true;
            state.wake = Arc::new(|| {});
        }
        self.inbox.0.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // A panic of the worker is reported by `poll`.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finish<O: Send + 'static, A: Send + 'static>(background: &mut Background<O, A>) -> Vec<A> {
        let mut answers = background.poll();
        while background.is_running() {
            std::thread::yield_now();
            answers.extend(background.poll());
        }
        answers
    }

    #[test]
    fn orders_are_carried_out_in_their_sequence_and_wake_the_window() {
        let woken = Arc::new(AtomicU64::new(0));
        let mut background = Background::new("test", |n: u32, reply: &Reply<'_, u32, u32>| reply.send(2 * n));
        let count = Arc::clone(&woken);
        background.set_wake(move || _ = count.fetch_add(1, Ordering::Relaxed));
        for n in 0..5 {
            background.queue(n).unwrap();
        }
        assert_eq!(finish(&mut background), [0, 2, 4, 6, 8]);
        assert!(woken.load(Ordering::Relaxed) >= 5 && !background.has_failed());
    }

    #[test]
    fn a_submitted_order_cancels_the_one_in_progress_and_drops_its_answers() {
        let mut background = Background::new("test", |endless: bool, reply: &Reply<'_, bool, bool>| {
            reply.send(endless);
            while endless && reply.cancel().is_active() {
                std::thread::yield_now();
            }
            reply.send(endless);
        });
        background.submit(true).unwrap();
        background.submit(false).unwrap();
        assert_eq!(finish(&mut background), [false, false]);
    }

    #[test]
    fn a_panic_ends_the_order_and_the_next_one_gets_a_new_thread() {
        let mut background = Background::new("test", |n: u32, reply: &Reply<'_, u32, u32>| {
            assert!(n > 0, "a deliberate panic");
            reply.send(n);
        });
        background.submit(0).unwrap();
        assert!(finish(&mut background).is_empty());
        assert!(background.has_failed());
        background.submit(1).unwrap();
        assert_eq!(finish(&mut background), [1]);
        assert!(!background.has_failed());
    }

    #[test]
    fn merged_answers_do_not_pile_up() {
        let mut background = Background::new("test", |n: u32, reply: &Reply<'_, u32, u32>| {
            for _ in 0..n {
                reply.merge(1, |a, b| a + b);
            }
        });
        background.submit(100).unwrap();
        assert_eq!(finish(&mut background).iter().sum::<u32>(), 100);
    }
}
