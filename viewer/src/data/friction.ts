/** Coefficients of friction, from the keys of the settings that act. */

type Settings = Readonly<Record<string, string>>;

const ofPairs = (settings: Settings) => settings["Contact/FrictionModel"] === "pairs";
const number = (settings: Settings, key: string) => Number(settings[key] || Number.NaN);
const container = (settings: Settings) => number(settings, "Simulation Settings/ContainerFriction");

/** A material's factor of a product: its own, or that of all boxes. */
const factor = (settings: Settings, material?: string) =>
  number(
    settings,
    settings[`Material ${material}/Friction`] ? `Material ${material}/Friction` : "Simulation Settings/BoxFriction",
  );

/** The first of some rows of [Friction] that the settings have. */
const firstRow = (settings: Settings, rows: readonly (readonly [string | undefined, string])[]) => {
  const found = rows.find(([material, other]) => settings[`Friction/${material}, ${other}`]);
  return found && number(settings, `Friction/${found[0]}, ${found[1]}`);
};

/** The coefficient of two boxes without a mat, by their materials; NaN where the settings do not say it. */
export function betweenBoxes(settings: Settings, a: string, b: string): number {
  if (!ofPairs(settings)) return factor(settings, a) * factor(settings, b);
  const rows = [
    [a, b],
    [b, a],
    [a, "any"],
    [b, "any"],
  ] as const;
  return firstRow(settings, rows) ?? number(settings, "Contact/BoxBox");
}

/** The coefficient of a box and the floor, of a material without one of its own where none is named; NaN as above. */
export function onFloor(settings: Settings, material?: string): number {
  if (!ofPairs(settings)) return factor(settings, material) * container(settings);
  const rows = [
    [material, "floor"],
    [material, "any"],
  ] as const;
  return firstRow(settings, rows) ?? number(settings, "Contact/BoxFloor");
}

const text = (value: number) => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : "–");

/** The coefficients of boxes without materials of their own, in the words of the program. */
export function usualFriction(settings: Settings): string {
  if (ofPairs(settings)) {
    const of = (key: string) => text(number(settings, `Contact/${key}`));
    return `box on box ${of("BoxBox")}, on the floor ${of("BoxFloor")}, on walls ${of("BoxWall")}`;
  }
  const box = factor(settings);
  return `box on box ${text(box * box)}, on floor and walls ${text(box * container(settings))}`;
}

/** The coefficients of materials that have their own, a text for each. */
export function frictionOfMaterials(settings: Settings): string[] {
  const own = (pattern: RegExp) =>
    Object.entries(settings).flatMap(([key, value]): [string, number][] => {
      const name = pattern.exec(key)?.[1];
      return name && value !== "" ? [[name, Number(value)]] : [];
    });
  if (ofPairs(settings)) return own(/^Friction\/(.+)$/).map(([pair, value]) => `${pair} ${text(value)}`);
  return own(/^Material (.+)\/Friction$/).map(
    ([name, value]) =>
      `${name} on ${name} ${text(value * value)}, on floor and walls ${text(value * container(settings))}`,
  );
}

/** The coefficients that act, and how many materials have others. */
export function frictionText(settings: Settings): string {
  const own = frictionOfMaterials(settings).length;
  if (own === 0) return usualFriction(settings);
  const pairs = own === 1 ? "; one pair of materials has its own" : `; ${own} pairs of materials have their own`;
  return usualFriction(settings) + (ofPairs(settings) ? pairs : ", others where a material has its own");
}
