/** cm: the shortest number that is the same bits in m, which any length that was read from a layout file has. */
export function centimetres(metres: number): string {
  for (let digits = 6; digits < 17; ++digits) {
    const text = String(Number((100 * metres).toPrecision(digits)));
    if (Number(text) / 100 === metres) return text;
  }
  return String(100 * metres);
}
