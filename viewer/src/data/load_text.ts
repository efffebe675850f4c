import type { Load } from "holdfast-engine";

/** A load as a file of JSON, which the page and the program read. */
export const loadText = (load: Load) => `${JSON.stringify({ holdfast: 1, loads: [load] })}\n`;
