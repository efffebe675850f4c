import type { Columns, Load, ReadLoad, RunFacts, WorldOutcome } from "holdfast-engine";
import { centreOfMass } from "../data/centre_of_mass";
import { containerOf } from "../data/containers";
import { excursionsTo } from "../data/excursions";
import { loadedLayout } from "../data/loaded_layout";
import { STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import type { BoxColumns, Excursions, Margins, Results, Series, World, WorldColumns } from "../data/results";
import { emptyWorlds, PENDING } from "../data/results";
import { notSimulated } from "./not_simulated";

/** Results in the form of a results file, of worlds that the engine of this page simulates. */

/** What is known before any world is simulated: loads that cannot be used have failed. */
export function newResults(
  name: string,
  version: string,
  facts: RunFacts,
  loads: readonly ReadLoad[],
  withMargins: boolean,
): Results {
  const { settings } = facts;
  const accelerations = facts.norm?.accelerations ?? [];
  const own = loads.flatMap(({ load }, layout) =>
    load.container ? [[layout, containerOf(load.container)] as const] : [],
  );
  const results: Results = {
    name,
    size: null,
    complete: true,
    firstWorld: 0,
    engine: settings["Screening/Engine"],
    software: `holdfast ${version}`,
    created: new Date().toISOString().replace(/\.\d+Z$/, "Z"),
    settings,
    thresholds: facts.limits,
    judgedAtEnd: false,
    container: containerOf(facts.container),
    ownContainers: new Map(own),
    layouts: loads.map((load) => load.name),
    layoutBoxes: Uint32Array.from(loads, ({ load }) => load.boxes.length),
    accelerations: accelerations.map((acceleration) => acceleration.name),
    segments: accelerations.map(({ segments }) => segments),
    worlds: newColumns(loads.length, accelerations.length),
    hasSeries: true,
    hasWalls: false,
    margins: withMargins ? newMargins(loads.length) : null,
    replicas: null,
  };
  const { worlds } = results;
  for (const [world, layout] of worlds.layout.entries()) {
    if (loads[layout].errors.length > 0) putWorld(results, world, notSimulated(), 0);
  }
  return results;
}

function newColumns(layouts: number, accelerations: number): WorldColumns {
  const count = layouts * accelerations;
  return {
    ...emptyWorlds(count),
    layout: Uint32Array.from({ length: count }, (_, world) => Math.floor(world / accelerations)),
    acceleration: Uint32Array.from({ length: count }, (_, world) => world % accelerations),
    verdict: new Uint8Array(count).fill(PENDING),
  };
}

function newMargins(layouts: number): Margins {
  const columns = () => ({
    margin: new Float64Array(4 * layouts).fill(Number.NaN),
    criticalBox: new Uint32Array(4 * layouts),
  });
  return { inPlace: columns(), withinLimits: columns() };
}

/** Puts what became of a world into the columns. */
export function putWorld({ worlds }: Results, world: number, outcome: WorldOutcome, seconds: number): void {
  worlds.verdict[world] = VERDICT_CODES[outcome.verdict];
  worlds.stopReason[world] = STOP_REASON_CODES[outcome.stopReason];
  worlds.cpuSeconds[world] = seconds;
  worlds.peakEnergy[world] = outcome.peakKineticEnergy;
  const same = [
    "status",
    "statusTime",
    "caveats",
    "boxes",
    "fallen",
    "unstable",
    "moved",
    "tilted",
    "fallenAtEnd",
    "criticalBox",
    "peakDisplacement",
    "peakDrop",
    "peakTilt",
    "endDisplacement",
    "endTime",
  ] as const;
  for (const name of same) worlds[name][world] = outcome[name];
}

/** Puts the margins of a load into the columns. */
export function putMargins({ margins }: Results, layout: number, found: Columns): void {
  if (!margins?.withinLimits) return;
  margins.inPlace.margin.set(found.margin, 4 * layout);
  margins.inPlace.criticalBox.set(found.critical_box, 4 * layout);
  margins.withinLimits.margin.set(found.margin_within_limits, 4 * layout);
  margins.withinLimits.criticalBox.set(found.critical_box_within_limits, 4 * layout);
}

/** The world of a load that cannot be used, and why. */
export function badWorld(results: Results, index: number, read: ReadLoad): World {
  return { ...worldHead(results, index, { ...read.load, boxes: [] }), statusText: read.errors[0].message };
}

function worldHead(results: Results, index: number, load: Load): World {
  const { worlds } = results;
  const layout = worlds.layout[index];
  const acceleration = worlds.acceleration[index];
  return {
    index,
    layout: results.layouts[layout],
    container: results.ownContainers.get(layout) ?? results.container,
    acceleration: results.accelerations[acceleration],
    segments: results.segments[acceleration],
    engine: results.engine,
    status: worlds.status[index],
    statusText: "",
    verdict: worlds.verdict[index],
    stopReason: worlds.stopReason[index],
    accelerated: true,
    criticalBox: worlds.criticalBox[index],
    beginTime: 0,
    endTime: worlds.endTime[index],
    boxes: boxColumns(load, {}, true, results.settings),
    series: null,
    walls: null,
    stateHash: "",
    loaded: null,
  };
}

/** A world whose columns of boxes and samples are there; its row in the results is. */
export function worldOf(
  results: Results,
  index: number,
  read: ReadLoad,
  outcome: WorldOutcome,
  columns: Columns,
): World {
  const { settings } = results;
  const head = worldHead(results, index, read.load);
  const accelerated = outcome.verdict !== "unstable" && !(outcome.endTime < 0);
  const boxes = boxColumns(read.load, columns, accelerated, settings);
  return {
    ...head,
    accelerated,
    beginTime: accelerated ? 0 : -Number(settings["Screening/SettleSeconds"]),
    boxes,
    series: seriesOf(columns),
    stateHash: outcome.stateHash,
    loaded: loadedLayout(read.load, settings, results.ownContainers.get(results.worlds.layout[index])),
  };
}

function seriesOf(columns: Columns): Series {
  return {
    time: columns["series/time"],
    acceleration: Float32Array.from(columns["series/container_acceleration"]),
    energy: Float32Array.from(columns["series/total_kinetic_energy"]),
    fallen: Uint32Array.from(columns["series/fallen_count"]),
    displacement: Float32Array.from(columns["series/displacement"]),
    orientation: Float32Array.from(columns["series/orientation"]),
  };
}

/** Columns of a load's boxes; those that the engine has not given are empty. */
function boxColumns(
  load: Load,
  columns: Columns,
  accelerated: boolean,
  settings: Readonly<Record<string, string>>,
): BoxColumns {
  const { boxes } = load;
  const float = (name: string) => Float32Array.from(columns[name] ?? []);
  const flags = (name: string) => Uint8Array.from(columns[`verdict/${name}`] ?? []);
  const optional = (value: (box: (typeof boxes)[number]) => number | undefined) =>
    Float64Array.from(boxes, (box) => value(box) ?? Number.NaN);
  const excursions = (name: string): Excursions => ({
    displacement: float(`boxes/${name}_displacement`),
    drop: float(`boxes/${name}_drop`),
    tilt: float(`boxes/${name}_tilt`),
  });
  const initial = float("boxes/initial_position");
  const reference = initial.slice();
  const settling = columns["boxes/settling_displacement"] ?? [];
  if (accelerated && settings["Screening/ReferencePose"] === "settled")
    for (let i = 0; i < reference.length; ++i) reference[i] += settling[i];
  const peak = excursions("peak");
  const endDisplacement = float("boxes/end_displacement");
  return {
    id: Uint32Array.from(boxes, (_, index) => index + 1),
    name: boxes.map((box) => box.name ?? ""),
    material: boxes.map((box) => String(box.material)),
    mat: optional((box) => box.mat),
    bearingLimit: optional((box) => box.bearing_limit),
    mass: float("boxes/mass"),
    fixed: Uint8Array.from(columns["boxes/fixed"] ?? []),
    size: float("boxes/size"),
    centre: Float32Array.from(boxes.flatMap((box) => centreOfMass(box.centre_of_mass, String(box.material), settings))),
    initial,
    reference,
    endDisplacement,
    end: excursionsTo(endDisplacement, float("boxes/end_tilt")),
    peak,
    settling: excursions("settling_peak"),
    judged: peak,
    peakEnergy: float("boxes/peak_kinetic_energy"),
    firstBeyond: float("verdict/first_beyond"),
    fallen: flags("fallen"),
    moved: flags("moved"),
    tilted: flags("tilted"),
    unstable: flags("unstable"),
  };
}
