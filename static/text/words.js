// @ts-check
// The words of the page, by part; all of them are in this folder. Names and help texts of thresholds, methods, scores and
// recordings, and sentences about a frame come from the server; the pseudocode is in learn/listing.json, the data sheets of
// lasers are in tune/presets.js.
import { drawText } from "./draw.js";
import { exportText } from "./export.js";
import { inspectText } from "./inspect.js";
import { labelText } from "./label.js";
import { learnText } from "./learn.js";
import { liveText } from "./live.js";
import { pageText } from "./page.js";
import { readingText } from "./reading.js";
import { rerunText } from "./rerun.js";
import { shownText } from "./shown.js";
import { tuningText } from "./tuning.js";

export const words = {
  page: pageText,
  tuning: tuningText,
  learn: learnText,
  shown: shownText,
  inspect: inspectText,
  label: labelText,
  draw: drawText,
  export: exportText,
  live: liveText,
  reading: readingText,
  rerun: rerunText,
};
