// @ts-check
// The formulas behind a decision, with its numbers put in. Terms carry the name of their geometry (shapes.js).
import { h, scrollInPanel } from "../widgets/dom.js";
import { symbols } from "../widgets/symbols.js";
import { fit, lengthOf } from "./geometry.js";
import { fraction, math, num, power, root, row, signed, term, words } from "./mathml.js";

/** @typedef {import("./trace.js").Event} Event */
/** @typedef {import("./trace.js").Trace} Trace */
/** @typedef {import("./trace.js").Line} Line */
/** @typedef {import("../wire.js").Knob} Knob */
/** @typedef {{title: string, rows: Element[]}} Formula */
/** @typedef {typeof import("../text/learn.js").learnText.formulas} Text */

/**
 * @param {Text} text
 * @param {(term: string | null) => void} onTerm a term is under the pointer or has the focus
 */
export function createFormulas(text, onTerm) {
  const body = h("div", { class: "formula-body" });
  const legend = h("div", { class: "terms", role: "group", "aria-label": text.terms });
  const element = h("section", { class: "formulas", "aria-label": text.label }, body, legend);

  const termAt = (/** @type {EventTarget | null} */ target) =>
    /** @type {Element | null} */ (target)?.closest?.("[data-term]")?.getAttribute("data-term") ?? null;
  /** @type {string | null} */
  let lit = null;
  const light = (/** @type {string | null} */ name) => {
    if (name === lit) return;
    lit = name;
    for (const part of element.querySelectorAll("[data-term]"))
      part.classList.toggle("lit", part.getAttribute("data-term") === name);
    onTerm(name);
  };
  element.addEventListener("pointerover", (event) => light(termAt(event.target)));
  element.addEventListener("pointerleave", () => light(null));
  element.addEventListener("focusin", (event) => light(termAt(event.target)));
  element.addEventListener("focusout", () => light(null));

  return {
    element,
    /** @type {string[]} the terms of the current formulas */
    names: [],
    /** Highlights a term, as if the pointer were on it. @param {string | null} name */
    light(name) {
      light(name);
      if (name) scrollInPanel(body.querySelector(`[data-term="${name}"]`));
    },
    /** @param {Event | null} event @param {Trace | null} trace @param {import("../wire.js").Params} params @param {Knob[]} knobs */
    set(event, trace, params, knobs) {
      lit = null;
      const shown = event && trace ? formulasOf(event, trace, params, knobs, text) : [];
      element.hidden = shown.length === 0;
      body.replaceChildren(
        ...shown.map(({ title, rows }) =>
          h(
            "div",
            { class: "formula" },
            h("h3", {}, ...symbols(title)),
            ...rows.map((row) => h("div", { class: "formula-row" }, row)),
          ),
        ),
      );
      this.names = [
        ...new Set([...body.querySelectorAll("[data-term]")].map((part) => part.getAttribute("data-term") ?? "")),
      ];
      legend.replaceChildren(
        ...this.names.map((name) =>
          h("button", { type: "button", class: "chip term-chip", "data-term": name }, text.names[name]),
        ),
      );
    },
  };
}

/**
 * @param {Event} event @param {Trace} trace @param {import("../wire.js").Params} params @param {Knob[]} knobs @param {Text} text
 * @returns {Formula[]}
 */
function formulasOf(event, trace, params, knobs, text) {
  const { kind, check, line, beam } = event;
  if (kind === "seed found") return [fitted(event, trace, text)];
  if (check === "delta" && line) return [predictedPoint(event, trace, line, text)];
  if (check === "epsilon" && line && beam >= 0) {
    const compare = toLine(event, trace, line, params, text);
    return kind === "point added" ? [compare, fitted(event, trace, text)] : [compare];
  }
  if (kind === "line kept" || (kind === "line dropped" && check !== "nearer")) return [acceptance(event, trace, text)];
  const first = check === "merge_angle" && trace.compared(event);
  if (first && event.other) return [angle(event, first, event.other, text)];
  if (check === "merge_rms") return [spread(event, text)];
  if (kind === "overlap cut") return [cut(event, text)];
  if (kind === "endpoints" && line) return [endpoint(event, trace, line, text)];
  const knob = knobs.find(({ name }) => name === check);
  return knob ? [refused(event, knob, text)] : [];
}

/**
 * @param {Event} event @param {Trace} trace @param {Line} line @param {import("../wire.js").Params} params @param {Text} text
 * @returns {Formula}
 */
function toLine({ beam, value, limit, kind }, trace, [a, b, c], params, text) {
  const [x, y] = trace.point(beam) ?? [NaN, NaN];
  const d = term("distance", "d");
  const normal = row(term("normal", "a"), term("point", "x"), "+", term("normal", "b"), term("point", "y"), "+ c");
  const sign = value < limit ? "<" : value > limit ? ">" : "=";
  return {
    title: text.toLine,
    rows: [
      math(d, "=", fraction(row("|", normal, "|"), root(row(power("a", "2"), "+", power("b", "2"))))),
      math("= |", signed(a), "·", signed(x), "+", signed(b), "·", signed(y), "+", signed(c), "|"),
      math("=", num(value), sign, term("band", "ε"), "=", num(limit), words(` m: ${verdict(kind, text)}`)),
      ...(params.epsilon_growth ? [epsilonAt(Math.hypot(x, y), params)] : []),
    ],
  };
}

/** ε at a range, where it grows with the range. @param {number} range @param {import("../wire.js").Params} params */
function epsilonAt(range, { epsilon, epsilon_growth: growth }) {
  const grown = power(row("(", num(growth, 4), "·", num(range), ")"), "2");
  return math(term("band", "ε"), "=", root(row(power(num(epsilon), "2"), "+", grown)), words(" m"));
}

/** @param {string} kind @param {Text} text */
function verdict(kind, text) {
  return kind === "point added" ? text.joins : kind === "growth stopped" ? text.stops : text.noSeed;
}

/** @param {Event} event @param {Trace} trace @param {Line} line @param {Text} text @returns {Formula} */
function predictedPoint({ beam, limit, value }, trace, line, text) {
  const [a, b, c] = line;
  const { range, bearing, meets } = trace.predicted(beam, line);
  const over = row("a", words(" cos "), term("beam", "θ"), "+ b", words(" sin "), term("beam", "θ"));
  return {
    title: text.predicted,
    rows: [
      math(
        term("predicted", "ρ′"),
        "=",
        fraction(row("− c"), over),
        "=",
        fraction(row(num(-c)), row(num(a * Math.cos(bearing) + b * Math.sin(bearing)))),
        "=",
        num(meets),
        words(" m"),
      ),
      math("| P P′ | = |", term("point", "ρ"), "−", term("predicted", "ρ′"), "| = |", num(range), "−", num(meets), "|"),
      math("=", num(value), value > limit ? ">" : "≤", "δ =", num(limit), words(` m: ${text.noSeed}`)),
    ],
  };
}

/** @param {Event} event @param {Trace} trace @param {Text} text @returns {Formula} */
function fitted({ first, last }, trace, text) {
  const { n, x, y, xx, xy, yy, phi, line } = fit(trace, trace.span(first, last));
  const [a, b, c] = line;
  const squares = trace.span(first, last).reduce((sum, beam) => sum + trace.distance(beam, line) ** 2, 0);
  return {
    title: text.fit(n),
    rows: [
      math(term("mean", "x̄"), "=", num(x), words(",  "), term("mean", "ȳ"), "=", num(y)),
      math("S_xx =", num(xx), words(",  "), "S_xy =", num(xy), words(",  "), "S_yy =", num(yy)),
      math(row("Σ", power(term("distance", "d"), "2")), "=", num(squares, 6), words(" m²")),
      math(
        words(text.solved),
        "=",
        fraction("2 S_xy", "S_xx − S_yy"),
        "→ φ =",
        num((phi * 180) / Math.PI, 1),
        words("°"),
      ),
      math(
        "(",
        term("normal", "a , b"),
        ") ⟂",
        term("line", "φ"),
        "= (",
        num(a),
        ",",
        num(b),
        ") ,",
        "c = − ( a x̄ + b ȳ ) =",
        num(c),
      ),
    ],
  };
}

/** @param {Event} event @param {Trace} trace @param {Text} text @returns {Formula} */
function acceptance({ kind, check, points, value, limit, first, last, line }, trace, text) {
  const counted = kind === "line dropped" && check === "min_points";
  const count = counted
    ? math(
        term("window", "P_l"),
        "=",
        String(points),
        value < limit ? "<" : "≥",
        "P_min =",
        String(limit),
        words(` : ${text.dropped}`),
      )
    : math(term("window", "P_l"), "=", String(points), words(` ${text.enough}`));
  if (counted || !line) return { title: text.accepted, rows: [count] };
  const length = lengthOf(trace, first, last, line);
  const sign = length >= limit ? "≥" : "<";
  return {
    title: text.accepted,
    rows: [
      count,
      math(term("length", "L_l"), "=", root(row(power("( x_e − x_s )", "2"), "+", power("( y_e − y_s )", "2")))),
      math(
        "=",
        num(length),
        sign,
        "L_min =",
        num(limit),
        words(` m: ${kind === "line kept" ? text.kept : text.dropped}`),
      ),
    ],
  };
}

/** @param {Event} event @param {Line} line @param {Line} other @param {Text} text @returns {Formula} */
function angle({ value, limit, kind }, [a, b], [a2, b2], text) {
  const degrees = (/** @type {number} */ v) => num((v * 180) / Math.PI, 1);
  return {
    title: text.angle,
    rows: [
      math(
        words("sin "),
        "α = |",
        term("line", "a_1"),
        term("other", "b_2"),
        "−",
        term("line", "b_1"),
        term("other", "a_2"),
        "|",
      ),
      math("= |", signed(a), "·", signed(b2), "−", signed(b), "·", signed(a2), "|"),
      math(
        "α =",
        degrees(value),
        words("°"),
        value < limit ? "<" : "≥",
        degrees(limit),
        words(`°: ${kind === "lines merged" ? text.oneLine : text.twoLines}`),
      ),
    ],
  };
}

/** @param {Event} event @param {Text} text @returns {Formula} */
function spread({ value, limit }, text) {
  return {
    title: text.spread,
    rows: [
      math("rms =", root(fraction(row("Σ", power("d", "2")), "P_l")), "=", num(value), words(" m")),
      math(num(value), ">", num(limit), words(` m, ${text.times}: ${text.twoLines}`)),
    ],
  };
}

/** @param {Event} event @param {Text} text @returns {Formula} */
function cut({ value, limit, beam, last }, text) {
  // If the first line keeps all shared points, the numbers are those of the last one.
  const kept = value < limit;
  return {
    title: text.cut,
    rows: [
      math(
        term("point", "P_k"),
        words(`, k = ${kept ? last : beam}:`),
        term("line", "d_1"),
        "=",
        num(value),
        kept ? "<" : "≥",
        term("other", "d_2"),
        "=",
        num(limit),
        words(" m"),
      ),
    ],
  };
}

/** @param {Event} event @param {Trace} trace @param {Line} line @param {Text} text @returns {Formula} */
function endpoint({ first, ends }, trace, [a, b, c], text) {
  const [x, y] = trace.point(first) ?? [NaN, NaN];
  const [x1, y1] = ends ?? [NaN, NaN];
  const bottom = () => row(power("a", "2"), "+", power("b", "2"));
  return {
    title: text.endpoint(first),
    rows: [
      math(
        term("ends", "x_s"),
        "=",
        fraction(row(power("b", "2"), term("outermost", "x_0"), "− a b", term("outermost", "y_0"), "− a c"), bottom()),
        "=",
        num(x1),
        words(" m"),
      ),
      math(
        term("ends", "y_s"),
        "=",
        fraction(row(power("a", "2"), term("outermost", "y_0"), "− a b", term("outermost", "x_0"), "− b c"), bottom()),
        "=",
        num(y1),
        words(" m"),
      ),
      math(words("P₀ = ("), num(x), ",", num(y), ")"),
      math(words("(a, b, c) = ("), num(a), ",", num(b), ",", num(c), ")"),
    ],
  };
}

/** What any other threshold refused. @param {Event} event @param {Knob} knob @param {Text} text @returns {Formula} */
function refused({ value, limit }, { symbol, unit, kind, label, extension }, text) {
  const digits = kind === "int" ? 0 : 3;
  const sign = value > limit ? ">" : "<";
  return {
    title: text.refused(symbol, label, extension),
    rows: [math(num(value, digits), sign, `${symbol} =`, num(limit, digits), words(unit && ` ${unit}`))],
  };
}
