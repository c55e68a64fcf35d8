// @ts-check
// Words of what is taken along: pictures, failure packs, segments.

export const exportText = {
  frame: "This frame",
  png: "Picture (PNG)",
  svg: "Picture (SVG)",
  pack: "Failure pack…",
  all: "Segments of all frames",
  formats: /** @type {Record<string, string>} */ ({ jsonl: "JSON lines", csv: "CSV", geojson: "GeoJSON" }),
  making: (/** @type {string} */ label) => `Writing the segments of ${label}`,
  drawing: "Drawing the frame",
  broken: "This could not be fetched: the connection broke.",
  noPicture: "The browser could not draw this picture.",
  note: {
    title: "Failure pack",
    hint: "A zip with this frame, its parameters, segments, every decision and a picture. Dropped on this page, it opens again as you see it now.",
    label: "What is wrong here?",
    placeholder: "e.g. the door at the left is bridged since ε was raised",
    save: "Save",
    close: "Close",
  },
  card: {
    label: "Failure pack",
    from: (/** @type {string} */ recording, /** @type {number} */ frame) =>
      `frame ${frame.toLocaleString("en")} of ${recording}`,
    noNote: "no note",
    taken: "The parameters of the pack are taken. Ctrl+Z takes it back.",
    take: "Its parameters",
    takeHelp: "Take the method and the thresholds with which it was packed",
  },
};
