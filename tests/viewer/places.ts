import path from "node:path";

/** The tests run from build/viewer/tests, bundled. */
const BUILD = path.resolve(path.dirname(new URL(import.meta.url).pathname), "..");
export const RESULTS = path.join(BUILD, "results");
export const PAGE = path.join(BUILD, "viewer.html");
/** Packages are looked up from here. */
export const PACKAGES = path.resolve(BUILD, "../../viewer/package.json");
/** The engine in WebAssembly, where `make viewer-engine` has built it. */
export const ENGINE = path.join(BUILD, "engine.mjs");
export const PROGRAM = process.env.HOLDFAST ?? path.resolve(BUILD, "../release/bin/holdfast");
/** The sources. */
export const ROOT = path.resolve(BUILD, "../..");
/** Pictures of the documentation. */
export const PICTURES = path.join(ROOT, "docs/guide/viewer");
/** The export of a load planner, whose axes are others. */
export const PLANNER = path.join(ROOT, "tests/io/loads/formats/planner_export.csv");
/** Loads with everything that a load may say. */
export const LOADS = path.join(ROOT, "tests/viewer/loads.json");
