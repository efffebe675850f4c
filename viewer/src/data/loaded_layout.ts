import type { Load, LoadBox } from "holdfast-engine";
import { centimetres } from "./lengths";
import type { Container, LoadedLayout } from "./results";

/**
 * A load as the engine takes a world that is taken forward in pieces.
 * @param settings of the run
 * @param own      the container, where the load has one
 */
export function loadedLayout(
  load: Load,
  settings: Readonly<Record<string, string>>,
  own: Container | undefined,
): LoadedLayout {
  const { boxes } = load;
  const { materials, made } = numbered(boxes, settings);
  const known = (value: (box: LoadBox) => number | undefined) => {
    const values = Float64Array.from(boxes, (box) => value(box) ?? Number.NaN);
    return values.some(Number.isFinite) ? values : null;
  };
  return {
    load,
    boxes: Float64Array.from(
      boxes.flatMap(({ corner_min, corner_max }, box) => [...corner_min, ...corner_max, materials[box]]),
    ),
    masses: known((box) => box.mass),
    mats: known((box) => box.mat),
    settings: { ...made, ...own?.settings },
  };
}

/** The load with its boxes elsewhere. @param rows as of `LoadedLayout` */
export function withCorners(load: Load, rows: Float64Array): Load {
  const corner = (begin: number) => [...rows.subarray(begin, begin + 3)] as LoadBox["corner_min"];
  const boxes = load.boxes.map((box, i) => ({ ...box, corner_min: corner(7 * i), corner_max: corner(7 * i + 3) }));
  return { ...load, boxes };
}

/**
 * The materials of boxes as numbers. Materials with names get one, and so do boxes that are fixed or have their own centre of mass,
 * with the settings of these numbers. Those of the names stay: no box has them.
 */
function numbered(
  boxes: readonly LoadBox[],
  settings: Readonly<Record<string, string>>,
): { materials: number[]; made: Record<string, string> } {
  const numbers = new Map<string, { number: number; name: string; fixed: boolean; centre: string }>();
  const given = boxes.map(({ material }) => Number(material)).filter(Number.isFinite);
  let next = given.reduce((most, number) => Math.max(most, number), 0) + 1;
  const materials = boxes.map(({ material, fixed = false, centre_of_mass }) => {
    const centre = centre_of_mass?.map(centimetres).join(" ") ?? "";
    if (typeof material === "number" && !fixed && centre === "") return material;
    const name = String(material);
    const key = JSON.stringify([name, fixed, centre]);
    const known = numbers.get(key) ?? { number: next++, name, fixed, centre };
    numbers.set(key, known);
    return known.number;
  });
  const made: Record<string, string> = {};
  const all = [...numbers.values()];
  /** the names of a material in the rows of the engine */
  const namesOf = (name: string) => [
    name,
    ...all.filter((one) => one.name === name).map(({ number }) => String(number)),
  ];
  for (const [key, value] of Object.entries(settings)) {
    const material = /^Material (.+)\/(\w+)$/.exec(key);
    if (material)
      for (const { number, name } of all) if (name === material[1]) made[`Material ${number}/${material[2]}`] = value;
    const pair = /^Friction\/(.+), (.+)$/.exec(key);
    if (!pair) continue;
    for (const a of namesOf(pair[1]))
      for (const b of namesOf(pair[2])) if (a !== pair[1] || b !== pair[2]) made[`Friction/${a}, ${b}`] = value;
  }
  for (const { number, fixed, centre } of all) {
    if (fixed) made[`Material ${number}/Fixed`] = "true";
    if (centre !== "") made[`Material ${number}/CentreOfMass`] = centre;
  }
  return { materials, made };
}
