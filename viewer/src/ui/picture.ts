import { element } from "./dom";
import { colour } from "./theme";

/** Pictures side by side with captions below, as PNG. */
export function pictureOf(pictures: HTMLCanvasElement[], captions: string[], common: string): Promise<Blob> {
  const height = Math.max(...pictures.map((picture) => picture.height));
  const width = pictures.reduce((sum, picture) => sum + picture.width, 0);
  const size = Math.round(height / 48);
  const canvas = element("canvas", { width, height: height + 5 * size });
  const context = canvas.getContext("2d")!;
  context.fillStyle = colour("scene");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.font = `${size}px ui-sans-serif, system-ui, sans-serif`;
  let x = 0;
  for (const [i, picture] of pictures.entries()) {
    context.drawImage(picture, x, 0);
    context.fillStyle = colour("ink");
    context.fillText(captions[i], x + 1.5 * size, height + 1.5 * size);
    x += picture.width;
  }
  context.fillStyle = colour("faint");
  context.fillText(common, 1.5 * size, height + 3.3 * size);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The picture cannot be made."))), "image/png"),
  );
}
