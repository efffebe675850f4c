/** Coefficients of friction, from the keys of the settings that act. */

type Settings = Readonly<Record<string, string>>;

const ofPairs = (settings: Settings) => settings["Contact/FrictionModel"] === "pairs";
const number = (settings: Settings, key: string) => Number(settings[key] || Number.NaN);
const container = (settings: Settings) => number(settings, "Simulation Settings/ContainerFriction");

/** A material's factor of a product: its own, or that of all boxes. */
const factor = (settings: Settings, material?: number) =>
  number(
    settings,
    settings[`Material ${material}/Friction`] ? `Material ${material}/Friction` : "Simulation Settings/BoxFriction",
  );

/** The coefficient of two boxes, by their materials; NaN where the settings do not say it. */
export const betweenBoxes = (settings: Settings, a: number, b: number) =>
  ofPairs(settings) ? number(settings, "Contact/BoxBox") : factor(settings, a) * factor(settings, b);

/** The coefficient of a box and the floor, of a material without one of its own where none is named; NaN as above. */
export const onFloor = (settings: Settings, material?: number) =>
  ofPairs(settings) ? number(settings, "Contact/BoxFloor") : factor(settings, material) * container(settings);

/** The coefficients that act, in the words of the program. */
export function frictionText(settings: Settings): string {
  const text = (value: number) => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : "–");
  const of = (key: string) => text(number(settings, `Contact/${key}`));
  if (ofPairs(settings)) {
    const rows = Object.keys(settings).filter((key) => key.startsWith("Friction/")).length;
    const ownRows = rows === 1 ? "; one pair of materials has its own" : `; ${rows} pairs of materials have their own`;
    return (
      `box on box ${of("BoxBox")}, on the floor ${of("BoxFloor")}, on walls ${of("BoxWall")}` +
      (rows > 0 ? ownRows : "")
    );
  }
  const box = number(settings, "Simulation Settings/BoxFriction");
  const own = Object.keys(settings).some((key) => /^Material .+\/Friction$/.test(key) && settings[key] !== "");
  return (
    `box on box ${text(box * box)}, on floor and walls ${text(box * container(settings))}` +
    (own ? ", others where a material has its own" : "")
  );
}
