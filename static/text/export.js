// @ts-check
// Words of what the page exports: pictures, failure packs, segments.

export const exportText = {
  frame: "This frame",
  png: "Picture (PNG)",
  svg: "Picture (SVG)",
  page: "Interactive page (HTML)",
  lessonPage: "This lesson as an interactive page (HTML)",
  sheet: "This lesson as a sheet to print",
  pack: "Failure pack…",
  all: "Segments of all frames",
  formats: /** @type {Record<string, string>} */ ({ jsonl: "JSON lines", csv: "CSV", geojson: "GeoJSON" }),
  map: "Line map",
  maps: /** @type {Record<string, string>} */ ({ geojson: "GeoJSON", svg: "SVG", dxf: "DXF (CAD)", npz: "NPZ" }),
  mapping: "Merging the lines of all frames",
  making: (/** @type {string} */ label) => `Writing the segments of ${label}`,
  drawing: "Drawing the frame",
  storing: "Storing every decision, and the results over the range of each threshold",
  broken: "Nothing was downloaded: the connection was lost. Try again.",
  noPicture: "This browser could not draw the picture. Save it as SVG instead.",
  note: {
    title: "Failure pack",
    hint: "A zip file with this frame, its labels, parameters, segments, every decision and a picture. Drop it on this page to see the frame again as it is now.",
    label: (/** @type {boolean} */ known) => (known ? "Note of this frame" : "What is wrong here?"),
    placeholder: "e.g. since ε was raised, a line crosses the door on the left",
    save: "Save",
    close: "Close",
  },
  card: {
    label: "Failure pack",
    from: (/** @type {string} */ recording, /** @type {number} */ frame) =>
      `frame ${frame.toLocaleString("en")} of ${recording}`,
    noNote: "no note",
    taken: "The parameters of the pack are set. Ctrl+Z undoes this.",
    take: "Use its parameters",
    takeHelp: "Set the method and the thresholds that are saved in the pack",
  },
};
