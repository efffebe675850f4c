import { loadText } from "../data/load_text";
import { withCorners } from "../data/loaded_layout";
import { STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { verdictText } from "../data/verdict";
import type { EngineClient } from "../engine/engine_client";
import { download } from "../ui/dom";
import type { LiveDriver } from "./live_driver";
import { accelerationText, settingsText } from "./saved_files";

/** Gives the user a file of what was driven; what the program makes of such files, as a sentence. */
export async function saveFile(
  kind: "load" | "acceleration" | "settings",
  driver: LiveDriver,
  file: Results,
  of: World,
  client: EngineClient,
): Promise<string> {
  const boxes = driver.mode === "replay" ? of.loaded!.boxes : driver.record.boxes;
  const end = driver.mode === "replay" ? of.endTime : driver.time;
  const segments = driver.segments(end);
  if (kind !== "load" && segments.length === 0) return "Nothing has been driven yet.";
  const settings = driver.settings(driver.mode, true);
  const load = loadText(withCorners(of.loaded!.load, boxes));
  const acceleration = accelerationText(segments, `driven in the page, from ${of.layout} of ${file.name}`);
  const name = of.layout.replace(/\.\w+$/, "").replaceAll(/[^\w.-]+/g, "-");
  const texts = {
    load: { name: `${name}-live.json`, text: load },
    acceleration: { name: `${name}-driven.txt`, text: acceleration },
    settings: { name: `${name}-live.ini`, text: settingsText(settings, `as driven in the page, from ${file.name}`) },
  };
  const { name: saved, text } = texts[kind];
  try {
    const outcome = segments.length > 0 ? await client.ask("screen", { load, acceleration, settings }) : null;
    download(saved, new Blob([text], { type: kind === "load" ? "application/json" : "text/plain" }));
    if (!outcome) return `${saved} is saved.`;
    const verdict = verdictText(VERDICT_CODES[outcome.verdict], STOP_REASON_CODES[outcome.stopReason]);
    return `${saved}: holdfast screen says ${verdict}, hash ${outcome.stateHash}. Pulls, and changes of friction on the way, are in no file.`;
  } catch (error) {
    return (error as Error).message;
  }
}
