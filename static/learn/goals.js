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
 * @param {{goal: Goal, accepted: Record<string, [number, number]>}} task accepted: for each threshold, the least and the largest right value
 * @param {State} state @param {Trace} trace @param {Params} start thresholds at the beginning of the task
 * @param {import("../wire.js").Knob[]} knobs @param {Text} text @returns {string[]}
 */
export function missing({ goal, accepted }, state, trace, start, knobs, text) {
  const { lines, together, either, apart, inside, outside, changed, at, selected, count } = goal;
  const lineOf = (/** @type {number} */ beam) => state.segments.findIndex((line) => holds(line, beam));
  const joined = (/** @type {[number, number]} */ [one, other]) => lineOf(one) >= 0 && lineOf(one) === lineOf(other);
  const found = state.segments.length;
  const stray = changed.length ? straying(changed, state.params, start, text) : "";
  if (stray) return [stray];
  /** @type {string[]} */
  const lacks = [];
  if (lines && (found < lines[0] || found > lines[1])) lacks.push(text.lines(found, lines));
  for (const pair of together) if (!joined(pair)) lacks.push(text.together(...pair));
  if (either.length && !either.some(joined)) lacks.push(text.either(either));
  for (const [one, other] of apart)
    if (lineOf(one) < 0 || lineOf(other) < 0 || lineOf(one) === lineOf(other)) lacks.push(text.apart(one, other));
  for (const beam of inside) if (lineOf(beam) < 0) lacks.push(text.inside(beam));
  for (const beam of outside) if (lineOf(beam) >= 0) lacks.push(text.outside(beam));
  if (lacks.length && changed.length) lacks.unshift(...sides(changed, accepted, state.params, start, knobs, text));
  const shown = at && wrongDecision(at, state.step, trace, knobs, text);
  if (shown) lacks.push(shown);
  const chosen = selected.length && wrongBeam(selected, state.selected, text);
  if (chosen) lacks.push(chosen);
  if (count) {
    const [which, least, most] = count;
    const n = matches(trace, which).length;
    if (n < least || n > most) lacks.push(text.count(n, which.kind));
  }
  return lacks;
}

/** Why the changed thresholds are not what the task asks for, or "". @param {readonly string[]} changed @param {Params} params @param {Params} start @param {Text} text */
function straying(changed, params, start, text) {
  const others = Object.entries(params)
    .filter(([name, value]) => value !== start[name])
    .map(([name]) => name);
  if (!others.length) return text.nothingChanged;
  if (others.some((name) => !changed.includes(name))) return text.wrongThreshold;
  return others.length > 1 ? text.onlyOne : "";
}

/**
 * On which side of the right values a threshold is.
 * @param {readonly string[]} changed @param {Record<string, [number, number]>} accepted @param {Params} params @param {Params} start
 * @param {import("../wire.js").Knob[]} knobs @param {Text} text
 */
function sides(changed, accepted, params, start, knobs, text) {
  const name = changed.find((each) => params[each] !== start[each]) ?? "";
  const symbol = knobs.find((knob) => knob.name === name)?.symbol ?? name;
  const range = accepted[name];
  if (!range) return [text.useless(symbol)];
  const value = Number(params[name]);
  return value < range[0] ? [text.tooSmall(symbol)] : value > range[1] ? [text.tooLarge(symbol)] : [];
}

/** How the shown decision differs from the right one, and where that is. @param {Find} at @param {number | null} step @param {Trace} trace @param {import("../wire.js").Knob[]} knobs @param {Text} text */
function wrongDecision(at, step, trace, knobs, text) {
  if (step === null) return text.noDecision;
  const fits = matches(trace, at);
  const right = at.nth ? fits.slice(at.nth).slice(0, 1) : fits;
  if (right.includes(step)) return "";
  const { kind, check, direction } = trace.at(step);
  const symbol = (/** @type {string} */ name) => knobs.find((knob) => knob.name === name)?.symbol ?? name;
  const what =
    kind !== at.kind
      ? text.otherKind(kind, at.kind)
      : at.check && check !== at.check
        ? text.otherCheck(symbol(check), symbol(at.check))
        : at.direction && direction !== at.direction
          ? text.otherWay(direction)
          : text.another(kind);
  const where = right.every((index) => index > step)
    ? text.later
    : right.every((index) => index < step)
      ? text.earlier
      : text.bothWays;
  return `${what} ${where}`;
}

/** @param {readonly number[]} right @param {number | null} selected @param {Text} text */
function wrongBeam(right, selected, text) {
  if (selected === null) return text.selectOne;
  if (right.includes(selected)) return "";
  const where = right.every((beam) => beam > selected)
    ? text.higher
    : right.every((beam) => beam < selected)
      ? text.lower
      : text.between;
  return `${text.notThis(selected)} ${where}`;
}

/** @param {{first: number, last: number}} line @param {number} beam */
function holds({ first, last }, beam) {
  return first <= last ? first <= beam && beam <= last : beam >= first || beam <= last;
}
