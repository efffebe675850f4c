import { unpacked } from "./packed";

/** Address of a script that the page carries packed, for a worker: a page opened from a disk can load no other. */
export async function workerScript(element: string): Promise<string> {
  const script = await unpacked(document.getElementById(element)?.textContent ?? "");
  return URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
}
