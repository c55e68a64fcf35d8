// @ts-check
// Whether the task of a lesson is done; what it asks for is data (app/shelf/lessons.py).

/** @typedef {import("../wire.js").State} State */
/** @typedef {import("../wire.js").Params} Params */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("../wire.js").Find} Find */
/** @typedef {import("../wire.js").Goal} Goal */
/** @typedef {typeof import("../text/learn.js").learnText.goals} Text */

/** All decisions that match a description. @param {Trace} trace @param {Find} find */
export function matches(trace, { kind, check, direction, beam }) {
  const { columns: c } = trace;
  const [kindAt, checkAt] = [c.kinds.indexOf(kind), check === null ? -1 : c.checks.indexOf(check)];
  return c.kind.flatMap((each, k) =>
    each === kindAt &&
    (check === null || c.check[k] === checkAt) &&
    (direction === null || c.direction[k] === direction) &&
    (beam === null || c.beam[k] === beam)
      ? [k]
      : [],
  );
}

/** The described decision, or −1. @param {Trace} trace @param {Find} find */
export function find(trace, find) {
  return matches(trace, find).at(find.nth) ?? -1;
}

/**
 * What is still missing, in sentences; the task is done if there are none.
 * @param {Goal} goal @param {State} state @param {Trace} trace @param {Params} start thresholds at the beginning of the task
 * @param {number | null} step @param {Text} text @returns {string[]}
 */
export function missing(goal, state, trace, start, step, text) {
  const { lines, together, apart, inside, outside, changed, at, selected, count } = goal;
  const lineOf = (/** @type {number} */ beam) => state.segments.findIndex((line) => holds(line, beam));
  /** @type {string[]} */
  const lacks = [];
  const found = state.segments.length;
  const others = Object.entries(state.params)
    .filter(([name, value]) => value !== start[name])
    .map(([name]) => name);
  if (changed.length && !others.length) lacks.push(text.nothingChanged);
  const stray = changed.length ? others.filter((name) => !changed.includes(name)) : [];
  if (stray.length) lacks.push(text.wrongThreshold);
  if (changed.length && others.length > 1) lacks.push(text.onlyOne);
  if (lines && (found < lines[0] || found > lines[1])) lacks.push(text.lines(found, lines));
  for (const [one, other] of together)
    if (lineOf(one) < 0 || lineOf(one) !== lineOf(other)) lacks.push(text.together(one, other));
  for (const [one, other] of apart)
    if (lineOf(one) < 0 || lineOf(other) < 0 || lineOf(one) === lineOf(other)) lacks.push(text.apart(one, other));
  for (const beam of inside) if (lineOf(beam) < 0) lacks.push(text.inside(beam));
  for (const beam of outside) if (lineOf(beam) >= 0) lacks.push(text.outside(beam));
  if (at) {
    const fits = matches(trace, at);
    const right = step !== null && (at.nth ? fits.at(at.nth) === step : fits.includes(step));
    if (!right) lacks.push(text.at);
  }
  if (selected.length) {
    if (state.selected === null) lacks.push(text.selectOne);
    else if (!selected.includes(state.selected)) lacks.push(text.notThis(state.selected));
  }
  if (count) {
    const [which, least, most] = count;
    const n = matches(trace, which).length;
    if (n < least || n > most) lacks.push(text.count(n, which.kind));
  }
  return lacks;
}

/** @param {{first: number, last: number}} line @param {number} beam */
function holds({ first, last }, beam) {
  return first <= last ? first <= beam && beam <= last : beam >= first || beam <= last;
}
