// @ts-check
// Where the time goes between a hand and what it sees: performance marks that profilers show.
// tests/benchmarks/hand_to_picture.py prints the times between them.

/**
 * changed: an input changed the View; sent: the server is asked for it; answered: the drawn state has arrived; shown:
 * every part of the page has it.
 * @typedef {"changed" | "sent" | "answered" | "shown"} Stage
 */

/** Marks a stage of a revision. Only the newest mark of each stage is kept, so that they cannot pile up. @param {Stage} stage @param {number} rev @param {number} [startTime] */
export function markStage(stage, rev, startTime = performance.now()) {
  const name = `lineseg ${stage}`;
  performance.clearMarks(name);
  performance.mark(name, { detail: rev, startTime });
}
