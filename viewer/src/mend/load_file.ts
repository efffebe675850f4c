import type { Load } from "holdfast-engine";

/** A file with a load, which the program reads: docs/start/loads.md. */
export const fileOf = (load: Load): string => `${JSON.stringify({ holdfast: 1, loads: [load] })}\n`;
