import type { Segment } from "../data/results";
import type { LiveInputs } from "../engine/messages";

/** Files that `holdfast screen` reads, from what was driven. */

export function accelerationText(segments: readonly Segment[], what: string): string {
  const lines = segments.map(({ start, duration, value }) => [start, duration, ...value].join("\t"));
  return `# ${what}\n# s, s, m/s2 along x, y, z\n${lines.join("\n")}\n`;
}

/** Keys that name files and runs, or say how files are read, and not the world. */
const OF_THE_RUN =
  /^(Renderer Engine|Export Settings|OpenCL|Bullet|Loads)\/|\/(Batch\w+|Layout|Acceleration|Norm|Threads|Scheduler|Margins|Replicas|FirstFailure|Indicators|Damage)$/;

/** Keys that one model of friction has, and the other one warns of. */
const OF_PAIRS = /^Contact\/Box(Box|Floor|Wall)$/;
const OF_PRODUCTS = /\/(BoxFriction|ContainerFriction)$|^Material .+\/Friction$/;
/** The coefficient of all pairs, and rows of pairs of materials, which come before it. */
const OF_ALL_PAIRS = "Contact/BoxBox";
const ROWS = /^Friction\//;

/** Settings with others in their place; the friction of all pairs is also that of pairs that have their own. */
export function changedSettings(
  settings: Readonly<Record<string, string>>,
  changed: Readonly<Record<string, string>>,
): Record<string, string> {
  const kept = Object.entries(settings).filter(([key]) => !(OF_ALL_PAIRS in changed && ROWS.test(key)));
  return { ...Object.fromEntries(kept), ...changed };
}

/** Settings of a results file as the engine of this page takes them. */
export function engineSettings(
  settings: Readonly<Record<string, string>>,
  changed: Readonly<Record<string, string>>,
): LiveInputs["settings"] {
  const all = changedSettings(settings, { "Screening/Engine": "native", ...changed });
  const unused = all["Contact/FrictionModel"] === "pairs" ? OF_PRODUCTS : OF_PAIRS;
  return Object.entries(all)
    .filter(([key, value]) => value !== "" && !unused.test(key) && (key in changed || !OF_THE_RUN.test(key)))
    .map(([key, value]) => {
      const slash = key.indexOf("/");
      return [key.slice(0, slash), key.slice(slash + 1), value] as const;
    });
}

/** The same as a configuration file. */
export function settingsText(settings: LiveInputs["settings"], what: string): string {
  const sections = new Map<string, string[]>();
  for (const [section, key, value] of settings)
    sections.set(section, [...(sections.get(section) ?? []), `${key} = ${value}`]);
  const blocks = [...sections].map(([section, lines]) => `[${section}]\n${lines.join("\n")}\n`);
  return `# ${what}\n\n${blocks.join("\n")}`;
}
