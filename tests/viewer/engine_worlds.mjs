// What the tests of the page's engine share: the bundled layouts and accelerations, and what the program makes of them.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

export const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "../..");
export const ENGINE = process.env.HOLDFAST_ENGINE ?? path.join(root, "build/viewer/engine.mjs");
export const PROGRAM = process.env.HOLDFAST ?? path.join(root, "build/release/bin/holdfast");
const CONFIG = path.join(root, "configs/demo.ini");
const LAYOUTS = ["configs/layouts", "bench/layouts"];
const ACCELERATIONS = "configs/accelerations";

const textsOf = (folder) =>
  readdirSync(path.join(root, folder))
    .filter((name) => name.endsWith(".txt"))
    .map((name) => ({ name, text: readFileSync(path.join(root, folder, name), "utf8") }));

export const config = readFileSync(CONFIG, "utf8");
/** Beyond the config, as the option of the program sets it. */
export const settings = [["Native", "Accuracy", "screening"]];
export const layouts = LAYOUTS.flatMap(textsOf);
export const accelerations = textsOf(ACCELERATIONS);

/** What `holdfast screen --json` says of every bundled layout under every bundled acceleration. */
export function screenedByProgram() {
  const folder = mkdtempSync(path.join(tmpdir(), "holdfast-engine-"));
  try {
    const words = ["screen", "-c", CONFIG, "--accuracy", "screening", "--layouts"];
    words.push(...LAYOUTS.map((name) => path.join(root, name)), "--accelerations", path.join(root, ACCELERATIONS));
    words.push("--threads", "1", "--no-series", "--json", "--quiet", "-o", path.join(folder, "results.h5"));
    const lines = execFileSync(PROGRAM, words, { encoding: "utf8", maxBuffer: 1 << 28 })
      .trim()
      .split("\n");
    return lines.map((line) => JSON.parse(line));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Inputs of a world of the engine, by names as the program prints them. */
export function inputsOf(engine, world) {
  const byName = (all, name) => all.find((one) => one.name === name).text;
  return {
    config,
    settings,
    boxes: engine.readLayout(byName(layouts, world.layout), { config, settings, name: world.layout }),
    segments: engine.readAcceleration(byName(accelerations, world.acceleration), world.acceleration),
  };
}
