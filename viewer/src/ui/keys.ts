/** What a key does; the name is that of the event, with `shift+` before it where that matters. */
export type Keymap = Record<string, () => void>;

/** Fields that keys belong to while they have the focus. */
const TYPING = /^(INPUT|SELECT|TEXTAREA)$/;

/** @param keymapNow what keys do at the moment */
export function listenToKeys(keymapNow: () => Keymap): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target as HTMLElement;
    const typing = TYPING.test(target.tagName) && (target as HTMLInputElement).type !== "range";
    if (typing && event.key !== "Escape") return;
    // A button with the focus is pressed by space; everywhere else space plays.
    if (event.key === " " && target.tagName === "BUTTON") return;
    const keymap = keymapNow();
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = (event.shiftKey ? keymap[`shift+${name}`] : undefined) ?? keymap[name];
    if (!action) return;
    if (typing) target.blur();
    event.preventDefault();
    action();
  });
}
