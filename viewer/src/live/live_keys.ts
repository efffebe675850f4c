import type { Keymap } from "../ui/keys";
import type { Store } from "../ui/state";
import type { LiveDriver } from "./live_driver";
import type { LivePanel } from "./live_panel";
import type { LivePointer } from "./live_pointer";

/** g per press of a key */
const NUDGE = 0.1;

/** Keys of a live world, which come before those of a recorded one. */
export function liveKeys(driver: LiveDriver, panel: LivePanel, pointer: LivePointer, store: Store): Keymap {
  return {
    " ": () => driver.toggle(),
    ".": () => void driver.step(),
    r: () => void driver.reset(),
    b: () => void driver.restart("replay").then(() => driver.play()),
    l: () => store.update({ live: false }),
    "0": () => driver.accelerate([0, 0, 0]),
    ArrowRight: () => panel.nudge(0, NUDGE),
    ArrowLeft: () => panel.nudge(0, -NUDGE),
    ArrowUp: () => panel.nudge(1, NUDGE),
    ArrowDown: () => panel.nudge(1, -NUDGE),
    PageUp: () => panel.nudge(2, NUDGE),
    PageDown: () => panel.nudge(2, -NUDGE),
    "shift+ArrowRight": () => pointer.pushBox([1, 0]),
    "shift+ArrowLeft": () => pointer.pushBox([-1, 0]),
    "shift+ArrowUp": () => pointer.pushBox([0, 1]),
    "shift+ArrowDown": () => pointer.pushBox([0, -1]),
    Home: () => driver.seek(0),
    End: () => driver.seek(driver.time),
  };
}
