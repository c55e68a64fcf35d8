// @ts-check
// Words of the editor of a world.

export const drawText = {
  label: "Draw a world",
  open: "Draw your own world",
  openHint: "Place walls, circles and a laser. The scan and its lines update while you drag.",
  addWall: "Add wall",
  addCircle: "Add circle",
  remove: "Delete (Del)",
  undo: "Undo (Ctrl+Z)",
  redo: "Redo (Ctrl+Shift+Z)",
  another: "New noise",
  anotherHelp: "Measure the same world again with new noise",
  save: "Save as NPZ",
  saveHelp: "Save the scan and its true walls as a recording",
  hint: "Drag the end or middle of a wall, a circle, or the laser. Arrow keys move what you selected.",
  full: (/** @type {number} */ walls, /** @type {number} */ circles) =>
    `A drawing has at most ${walls} walls and ${circles} circles. Delete one to add another.`,
  notANumber: (/** @type {string} */ typed) => `“${typed}” is not a number. Enter one such as 1.5.`,
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
