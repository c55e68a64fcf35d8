import type { Field } from "./wire.js";

/** The declaration of the View's fields, which the server writes (app/view_field.py). */
export const VIEW: Field[];
