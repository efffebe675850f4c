import { STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { verdictText } from "../data/verdict";
import type { EngineClient } from "../engine/engine_client";
import { download } from "../ui/dom";
import type { LiveDriver } from "./live_driver";
import { whyNotSaved } from "./live_words";
import { accelerationText, layoutText, settingsText } from "./saved_files";

/** Gives the user a file of what was driven; what the program makes of such files, as a sentence. */
export async function saveFile(
  kind: "layout" | "acceleration" | "settings",
  driver: LiveDriver,
  file: Results,
  of: World,
  client: EngineClient,
): Promise<string> {
  const boxes = driver.mode === "replay" ? of.loaded!.boxes : driver.record.boxes;
  const end = driver.mode === "replay" ? of.endTime : driver.time;
  const segments = driver.segments(end);
  if (kind !== "layout" && segments.length === 0) return "Nothing has been driven yet.";
  const why = whyNotSaved(of);
  if (why && kind !== "acceleration") return why;
  const settings = driver.settings(driver.mode, true);
  const layout = layoutText(of.loaded!.header, boxes, file.settings["Container/UpAxis"] ?? "z", of.container.size[1]);
  const acceleration = accelerationText(segments, `driven in the page, from ${of.layout} of ${file.name}`);
  const name = of.layout.replace(/\.\w+$/, "");
  const texts = {
    layout: { name: `${name}-live.txt`, text: layout },
    acceleration: { name: `${name}-driven.txt`, text: acceleration },
    settings: { name: `${name}-live.ini`, text: settingsText(settings, `as driven in the page, from ${file.name}`) },
  };
  const { name: saved, text } = texts[kind];
  try {
    if (segments.length > 0 && !why) {
      const { outcome, same } = await client.ask("screen", { layout, acceleration, boxes, settings });
      if (!same) throw new Error("The layout cannot be written as a layout file.");
      download(saved, new Blob([text], { type: "text/plain" }));
      const verdict = verdictText(VERDICT_CODES[outcome.verdict], STOP_REASON_CODES[outcome.stopReason]);
      return `${saved}: holdfast screen says ${verdict}, hash ${outcome.stateHash}. Pulls, and changes of friction on the way, are in no file.`;
    }
    download(saved, new Blob([text], { type: "text/plain" }));
    return `${saved} is saved.`;
  } catch (error) {
    return (error as Error).message;
  }
}
