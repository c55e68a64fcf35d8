// @ts-check
// Every word of the page, by part. Another language is another folder with the same keys.
import { drawText } from "./draw.js";
import { exportText } from "./export.js";
import { inspectText } from "./inspect.js";
import { labelText } from "./label.js";
import { learnText } from "./learn.js";
import { liveText } from "./live.js";
import { pageText } from "./page.js";
import { rerunText } from "./rerun.js";
import { tuningText } from "./tuning.js";

export const words = {
  page: pageText,
  tuning: tuningText,
  learn: learnText,
  inspect: inspectText,
  label: labelText,
  draw: drawText,
  export: exportText,
  live: liveText,
  rerun: rerunText,
};
