/**
 * SHA-256, hexadecimal. Browsers have it for pages from a disk, from this machine and of https; elsewhere it is empty, as
 * that of a file that cannot be read.
 */
export async function sha256(content: string | Uint8Array<ArrayBuffer>): Promise<string> {
  if (!crypto.subtle) return "";
  const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
  const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
