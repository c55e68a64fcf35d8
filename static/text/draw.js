// @ts-check
// Words of the editor of a world.

export const drawText = {
  label: "Draw a world",
  open: "Draw your own world",
  openHint: "Walls, circles and a laser; the scan and its lines follow while you drag.",
  addWall: "Add wall",
  addCircle: "Add circle",
  remove: "Delete (Del)",
  undo: "Undo (Ctrl+Z)",
  redo: "Redo (Ctrl+Shift+Z)",
  another: "Other noise",
  anotherHelp: "The same world measured once more",
  save: "Save as NPZ",
  saveHelp: "The scan with its true walls, as a recording",
  hint: "Drag the ends of a wall, its middle, a circle or the laser; arrow keys move what is chosen.",
  full: (/** @type {number} */ walls, /** @type {number} */ circles) =>
    `A drawing has at most ${walls} walls and ${circles} circles.`,
  notANumber: (/** @type {string} */ typed) => `“${typed}” is not a number.`,
  handle: {
    wallStart: (/** @type {number} */ n) => `Wall ${n}, start`,
    wallEnd: (/** @type {number} */ n) => `Wall ${n}, end`,
    wall: (/** @type {number} */ n) => `Wall ${n}`,
    circle: (/** @type {number} */ n) => `Circle ${n}`,
    radius: (/** @type {number} */ n) => `Circle ${n}, radius`,
    laser: "Laser",
  },
  fields: {
    wall: /** @type {[string, string][]} */ ([
      ["x₁", "m"],
      ["y₁", "m"],
      ["x₂", "m"],
      ["y₂", "m"],
    ]),
    circle: /** @type {[string, string][]} */ ([
      ["x", "m"],
      ["y", "m"],
      ["radius", "m"],
    ]),
    laser: /** @type {[string, string][]} */ ([
      ["x", "m"],
      ["y", "m"],
      ["heading", "°"],
    ]),
    beams: /** @type {[string, string][]} */ ([
      ["first", "°"],
      ["last", "°"],
      ["step", "°"],
      ["range", "m"],
      ["σ", "m"],
    ]),
  },
  beams: "Beams",
};
