/**
 * Where the centre of mass of a box is, from its middle along its axes, m: as the load says of the box, else of its material.
 * @param own      of the load; NaN or nothing: it does not say it
 * @param settings of the run
 */
export function centreOfMass(
  own: ArrayLike<number> | undefined,
  material: string,
  settings: Readonly<Record<string, string>>,
): number[] {
  if (own && Number.isFinite(own[0])) return Array.from(own);
  const given = settings[`Material ${material}/CentreOfMass`];
  return given ? given.split(/\s+/).map((length) => Number(length) / 100) : [0, 0, 0];
}
