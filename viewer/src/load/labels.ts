import * as THREE from "three";
import { element } from "../ui/dom";
import { colour } from "../ui/theme";

interface Label {
  node: HTMLElement;
  place: THREE.Vector3;
}

/** Names of front and door, and how hard the load is pushed, beside what they name. */
export class Labels {
  readonly node = element("div", { class: "labels", "aria-hidden": "true" });
  private readonly labels: Label[];

  /** @param rear what the far end is called */
  constructor(
    private readonly container: readonly [number, number, number],
    rear: string,
  ) {
    const [length, width] = container;
    const label = (text: string, kind: string, ...at: [number, number, number]) => {
      const node = element("span", { class: kind }, text);
      this.node.append(node);
      return { node, place: new THREE.Vector3(...at) };
    };
    this.labels = [
      label("front", "side", -0.28, width / 2, 0),
      label(rear, "side", length + 0.28, width / 2, 0),
      label("", "push", 0, 0, 0),
    ];
  }

  place(camera: THREE.Camera, width: number, height: number, push: string, above: THREE.Vector3): void {
    // Names of the ends stand on the floor, on the side of the camera.
    const across = this.container[1];
    const near = camera.position.y < across / 2 ? -0.12 : across + 0.12;
    const along = Math.abs(camera.position.y - across / 2) < 0.5 ? across / 2 : near;
    for (const { place } of this.labels.slice(0, 2)) place.y = along;
    this.labels[2].node.textContent = push;
    this.labels[2].place.copy(above);
    for (const { node, place } of this.labels) {
      const at = place.clone().project(camera);
      node.hidden = at.z > 1 || node.textContent === "";
      node.style.transform = `translate(-50%, -50%) translate(${((at.x + 1) / 2) * width}px, ${((1 - at.y) / 2) * height}px)`;
    }
  }

  /** The same on a canvas, for pictures. */
  paint(context: CanvasRenderingContext2D): void {
    const home = this.node.getBoundingClientRect();
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (const { node } of this.labels) {
      if (node.hidden) continue;
      const box = node.getBoundingClientRect();
      context.font = getComputedStyle(node).font;
      context.fillStyle = colour(node.className === "push" ? "accent" : "faint");
      context.fillText(
        node.textContent ?? "",
        box.left - home.left + box.width / 2,
        box.top - home.top + box.height / 2,
      );
    }
  }
}
