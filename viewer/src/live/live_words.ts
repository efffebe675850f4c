import { VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { engineCarried } from "../engine/engine_client";

/** Why a world cannot run here, as a sentence; null: it can. */
export function whyNotLive(world: World): string | null {
  if (!engineCarried()) return "This page has no engine in it: make viewer-engine, and then make viewer, put it in.";
  if (world.boxes.id.length === 0) return "This world was not simulated: there is nothing to drive.";
  if (!world.loaded) return "The layout of this world is in another part of the run.";
  return null;
}

/** What a world that was replayed to its end says of the file. */
export function bitsSentence(
  file: Pick<Results, "software"> & Partial<Pick<Results, "size">>,
  world: Pick<World, "engine" | "stateHash" | "verdict" | "endTime">,
  version: string,
  hash: string,
): { same: boolean; text: string } {
  if (world.engine !== "native")
    return { same: false, text: `The file's world is of the engine ${world.engine}: there are no bits to compare.` };
  if (world.endTime < 0)
    return { same: false, text: "The file's world ended while it settled: there are no bits of that here." };
  if (hash === world.stateHash)
    return {
      same: true,
      text: file.size === null ? "The same bits as when it was screened" : "The same bits as the file",
    };
  if (file.software !== `holdfast ${version}`)
    return { same: false, text: `Other bits than the file's: it is of ${file.software}, this page of ${version}.` };
  if (world.verdict === VERDICT_CODES.failed)
    return { same: false, text: "Other bits than the file's, whose world failed." };
  return { same: false, text: `Other bits than the file's, whose hash is ${world.stateHash}.` };
}
