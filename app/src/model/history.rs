//! Undo history of settled states, after egui's `Undoer`: a drag is one step, regardless of its frames.

/// History of the states for undo and redo.
///
/// The caller passes every state to [`History::observe`]; a state becomes a step only once it is *settled*,
/// when no gesture is in progress.
#[derive(Clone, Debug)]
pub struct History<T> {
    committed: T,
    undo: Vec<T>,
    redo: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    /// Maximum number of undo steps.
    pub const CAPACITY: usize = 200;

    /// Creates a history that starts at `state`.
    #[must_use]
    pub fn new(state: T) -> Self {
        Self { committed: state, undo: Vec::new(), redo: Vec::new() }
    }

    /// Observes the present state. Returns whether it differs from the last step and is not settled yet.
    pub fn observe(&mut self, state: &T, settled: bool) -> bool {
        if *state == self.committed {
            return false;
        }
        self.redo.clear();
        if !settled {
            return true;
        }
        self.undo.push(std::mem::replace(&mut self.committed, state.clone()));
        if self.undo.len() > Self::CAPACITY {
            self.undo.remove(0);
        }
        false
    }

    /// Returns the state before `state`, if any; `state` becomes the next redo.
    pub fn undo(&mut self, state: &T) -> Option<T> {
        self.observe(state, true);
        let previous = self.undo.pop()?;
        self.redo.push(std::mem::replace(&mut self.committed, previous));
        Some(self.committed.clone())
    }

    /// Returns the state that the last undo reverted, if there was no edit since.
    pub fn redo(&mut self, state: &T) -> Option<T> {
        self.observe(state, true);
        let next = self.redo.pop()?;
        self.undo.push(std::mem::replace(&mut self.committed, next));
        Some(self.committed.clone())
    }

    /// Whether [`History::undo`] would return a state.
    #[must_use]
    pub fn can_undo(&self, state: &T) -> bool {
        !self.undo.is_empty() || *state != self.committed
    }

    /// Whether [`History::redo`] would return a state.
    #[must_use]
    pub fn can_redo(&self, state: &T) -> bool {
        !self.redo.is_empty() && *state == self.committed
    }
}

#[cfg(test)]
mod tests {
    use super::History;

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::new(0);
        for value in 1..10 {
            assert!(history.observe(&value, false));
        }
        assert!(!history.observe(&9, true));
        assert_eq!(history.undo(&9), Some(0));
        assert_eq!(history.undo(&0), None);
        assert_eq!(history.redo(&0), Some(9));
        assert_eq!(history.redo(&9), None);
    }

    #[test]
    fn undo_reverts_an_unsettled_edit_and_an_edit_clears_redo() {
        let mut history = History::new("a");
        assert!(history.can_undo(&"b"));
        assert_eq!(history.undo(&"b"), Some("a"));
        assert!(history.can_redo(&"a"));
        history.observe(&"c", true);
        assert!(!history.can_redo(&"c"));
        assert_eq!(history.undo(&"c"), Some("a"));
    }

    #[test]
    fn the_oldest_steps_are_dropped() {
        let mut history = History::new(0);
        for value in 1..=History::<usize>::CAPACITY + 5 {
            history.observe(&value, true);
        }
        let mut state = History::<usize>::CAPACITY + 5;
        while let Some(previous) = history.undo(&state) {
            state = previous;
        }
        assert_eq!(state, 5);
    }
}
