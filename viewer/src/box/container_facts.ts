import { openingsText } from "../data/openings";
import type { Container } from "../data/results";
import { fixed } from "../ui/text";

/** What a container is, as names and texts. */
export function containerFactsOf({ type, size, openings }: Container): [string, string][] {
  const metres = `${size.map((side) => fixed(side, 2)).join(" × ")} m`;
  const sides = openingsText(openings, size[2]);
  return [
    ["container", type === "" ? metres : `${type}, ${metres}`],
    ...(sides ? [["sides", sides] as [string, string]] : []),
  ];
}
