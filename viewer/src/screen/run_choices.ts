import type { GivenSettings, ReadChoices, RunSettings } from "holdfast-engine";

/** What a user sets for a screening. Empty texts: as the program has it without a word of it. */
export interface RunChoices {
  /** name of a norm; with a colon behind it, one whose size is given */
  norm: string;
  /** K, g, of such a norm */
  normSize: string;
  /** name in the catalogue, for all loads; `OWN_SIZE`; or empty: as each load says */
  container: string;
  /** m, of `OWN_SIZE` */
  length: string;
  width: string;
  height: string;
  /** unit of lengths and axes, where files do not say it */
  unit: string;
  format: string;
  axes: string;
  /** coefficients of friction, or names of pairs of the table: of boxes on the floor, on boxes, on walls */
  floor: string;
  boxes: string;
  walls: string;
  /** limits: cm, cm, degree */
  move: string;
  drop: string;
  tilt: string;
  accuracy: string;
  margins: boolean;
}

/** In place of the name of a container: one of another size. */
export const OWN_SIZE = "size";

/** Behind the name of a norm whose size is given; the size follows. */
const SIZED = ":";
/** A norm as a choice. */
export const normChoice = (name: string, takesSize: boolean) => (takesSize ? `${name}${SIZED}` : name);
/** Whether a size is to be given with a choice. */
export const takesSize = (norm: string) => norm.endsWith(SIZED);
/** g: the least and the largest size that the program takes. */
export const NORM_SIZES = [0.01, 2] as const;

export const USUAL: RunChoices = {
  norm: "road",
  normSize: "",
  container: "",
  length: "",
  width: "",
  height: "",
  unit: "",
  format: "",
  axes: "",
  floor: "",
  boxes: "",
  walls: "",
  move: "",
  drop: "",
  tilt: "",
  accuracy: "",
  margins: true,
};

/** A comma may be the decimal mark. */
export const withPoint = (number: string) => number.trim().replace(",", ".");

/** The number in another unit; what is none stays, for the engine to refuse. */
const times = (factor: number) => (text: string) => {
  const number = Number(withPoint(text));
  return text.trim() === "" || !Number.isFinite(number) ? text : String(Number((factor * number).toPrecision(12)));
};
const inCentimetres = times(100);
const inMetres = times(0.01);

/** Settings of the program by what was chosen. */
function settingsOf(choices: RunChoices): NonNullable<GivenSettings["settings"]> {
  const { norm } = choices;
  const isOwn = choices.container === OWN_SIZE;
  const all: [string, string, string][] = [
    ["Screening", "Norm", takesSize(norm) ? `${norm}${withPoint(choices.normSize)}` : norm],
    ["Container", "Length", isOwn ? inCentimetres(choices.length) : ""],
    ["Container", "Width", isOwn ? inCentimetres(choices.width) : ""],
    ["Container", "Height", isOwn ? inCentimetres(choices.height) : ""],
    ["Contact", "BoxFloor", withPoint(choices.floor)],
    ["Contact", "BoxBox", withPoint(choices.boxes)],
    ["Contact", "BoxWall", withPoint(choices.walls)],
    ["Screening", "MoveThreshold", inMetres(choices.move)],
    ["Simulation Settings", "DropThreshold", inMetres(choices.drop)],
    ["Screening", "TiltThreshold", withPoint(choices.tilt)],
    ["Native", "Accuracy", choices.accuracy],
    ["Screening", "Margins", choices.margins ? "true" : ""],
  ];
  return all.filter(([, , value]) => value.trim() !== "");
}

/** Why choices cannot be used, as a sentence, where the program would speak of the text of a setting; null: it judges them. */
export function whyNotUsed({ norm, normSize }: RunChoices): string | null {
  const [least, largest] = NORM_SIZES;
  const size = Number(withPoint(normSize));
  if (!takesSize(norm) || (size >= least && size <= largest)) return null;
  return `${norm.slice(0, -SIZED.length)} needs a size K: a number of g from ${least} to ${largest}.`;
}

/** What worlds are simulated with. */
export const runSettings = (choices: RunChoices): RunSettings => ({
  settings: settingsOf(choices),
  container: choices.container === OWN_SIZE ? "" : choices.container,
});

/** What files are read with. */
export const readChoices = (choices: RunChoices): GivenSettings & ReadChoices => ({
  ...runSettings(choices),
  unit: choices.unit,
  axes: choices.axes,
  format: choices.format,
});

/** What may be said of a single file, where it is not said of all. */
export type FileChoices = Partial<Pick<RunChoices, "container" | "unit" | "format" | "axes">>;

/** The same in words. */
export const fileChoicesText = ({ container, unit, format, axes }: FileChoices): string =>
  [
    container && `the container ${container}`,
    unit && `lengths in ${unit}`,
    format && `a file of ${format}`,
    axes && `the axes ${axes}`,
  ]
    .filter(Boolean)
    .join(", ");

/** A choice that would help, and what a button says of it. */
export interface Advice {
  text: string;
  change: FileChoices;
}

/** What a message of a reader names as options of the program that would help. */
export function advicesOf(accepted: string): Advice[] {
  const unit = /--unit (mm|cm|m|in|ft)\b/.exec(accepted)?.[1];
  const container = /--container (\S+)/.exec(accepted)?.[1];
  if (unit && container)
    return [{ text: `Take lengths as ${unit} and the container ${container}`, change: { unit, container } }];
  if (container) return [{ text: `Take the container ${container}, which holds them`, change: { container } }];
  if (unit) return [{ text: `Take lengths as ${unit}`, change: { unit } }];
  const format = /--format (\S+)/.exec(accepted)?.[1];
  if (format) return [{ text: `Read it as a file of ${format}`, change: { format, axes: "" } }];
  // Where a file may count from two ends or sides, each has its axes.
  return [...accepted.matchAll(/--axes "([-xyz ]+)"(?: where it counts)?(?: from the (\w+))?/g)].map(
    ([, axes, from]) => ({
      text: `Take the axes ${axes}${from ? `, counted from the ${from}` : " as length, width, height"}`,
      change: { axes, format: "" },
    }),
  );
}

/** The same choices in an address: those that are not usual. */
export const toText = (choices: RunChoices): string =>
  Object.entries(choices)
    .filter(([key, value]) => value !== USUAL[key as keyof RunChoices])
    .map(([key, value]) => `${key}:${value}`)
    .join(";");

/** The choices of an address; what it does not have is usual. */
export function fromText(text: string): RunChoices {
  const choices: Record<string, string | boolean> = { ...USUAL };
  for (const part of text.split(";")) {
    const colon = part.indexOf(":");
    const key = part.slice(0, colon);
    if (colon < 0 || !(key in USUAL)) continue;
    const value = part.slice(colon + 1);
    choices[key] = key === "margins" ? value !== "false" : value;
  }
  return choices as unknown as RunChoices;
}
