import * as THREE from "three";
import { GRAVITY } from "../data/push";
import type { Changes } from "../engine/messages";
import type { CameraRig } from "../load/camera_rig";
import type { LoadScene } from "../load/load_scene";
import { oncePerFrame } from "../ui/dom";
import type { Store } from "../ui/state";
import { hitBox } from "./box_hit";
import type { LiveDriver } from "./live_driver";
import { dragged, placed } from "./placing";
import { Pull } from "./pull";

/** Pixels from where a click becomes a drag. */
const CLICK = 4;

/** s that a push by key lasts */
const PUSH = 0.2;

/** What the pointer does with boxes: chooses one, puts it elsewhere before the start, pulls at it afterwards. */
export class LivePointer {
  private readonly pull: Pull;
  private down: [number, number] | null = null;
  private moved = false;
  /** a box that is put elsewhere: the layout when it was taken, and where */
  private placing: { box: number; boxes: Float64Array; from: THREE.Vector3; plane: THREE.Plane } | null = null;
  private push: { box: number; direction: readonly number[]; until: number } | null = null;

  constructor(
    private readonly scene: LoadScene,
    private readonly rig: CameraRig,
    private readonly driver: LiveDriver,
    private readonly store: Store,
    private readonly point: (box: number | null, event: PointerEvent | null) => void,
  ) {
    this.pull = new Pull(scene);
    const { canvas } = scene;
    let at: PointerEvent | null = null;
    const hover = oncePerFrame(() => {
      if (this.down === null) point(at ? scene.pick(at) : null, at);
    });
    canvas.addEventListener("pointermove", (event) => {
      at = event.buttons === 0 ? event : null;
      if (this.down) this.drag(event);
      else hover();
    });
    canvas.addEventListener("pointerleave", () => {
      at = null;
      hover();
    });
    // Before the camera's own listeners: what takes a box does not turn the picture.
    canvas.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    for (const kind of ["pointerup", "pointercancel"] as const) canvas.addEventListener(kind, () => this.drop());
    canvas.addEventListener("click", (event) => {
      if (!this.moved) store.update({ box: scene.pick(event) });
    });
  }

  /** N, of the pull */
  get strength(): number {
    return this.pull.strength;
  }

  draw(): void {
    this.pull.draw();
  }

  private take(event: PointerEvent): void {
    this.down = [event.clientX, event.clientY];
    this.moved = false;
    const { scene, driver, store } = this;
    if (event.button !== 0 || event.shiftKey || driver.mode === "replay" || store.state.exploded > 0) return;
    const box = scene.pick(event);
    if (box === null) return;
    const ray = scene.rayAt(event);
    if (driver.atStart) {
      const from = hitBox(ray, scene.boxAt(box));
      if (!from) return;
      const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(new THREE.Vector3(0, 0, 1), from);
      this.placing = { box, boxes: driver.choices.boxes, from, plane };
    } else {
      const away = this.rig.camera.getWorldDirection(new THREE.Vector3());
      if (this.isFixed(box) || !this.pull.begin(box, ray, away)) return;
      store.update({ time: driver.time, box });
    }
    this.rig.enable(false);
    this.point(null, null);
    scene.canvas.setPointerCapture(event.pointerId);
  }

  private drag(event: PointerEvent): void {
    const [x, y] = this.down!;
    if (Math.hypot(event.clientX - x, event.clientY - y) > CLICK) this.moved = true;
    if (!this.moved) return;
    const ray = this.scene.rayAt(event);
    if (this.pull.box !== null) {
      this.pull.move(ray);
      this.scene.redraw();
    }
    const { placing, driver } = this;
    if (!placing) return;
    const to = ray.intersectPlane(placing.plane, new THREE.Vector3());
    if (!to) return;
    const by: [number, number] = [to.x - placing.from.x, to.y - placing.from.y];
    driver.choices.boxes = dragged(placing.boxes, placing.box, by, this.scene.container);
    this.store.update({ box: placing.box });
    this.scene.show(this.store.state);
  }

  private drop(): void {
    this.down = null;
    this.rig.enable(true);
    if (this.placing && this.moved) this.driver.rechoose();
    this.placing = null;
    if (this.pull.box === null) return;
    this.pull.end();
    this.scene.redraw();
  }

  /** Pushes the chosen box for a moment, by its weight; before the start it is moved by a centimetre. */
  pushBox(direction: readonly [number, number]): void {
    const { driver, store } = this;
    const { box } = store.state;
    if (box === null || driver.mode === "replay") return;
    if (driver.atStart) {
      const by: [number, number] = [0.01 * direction[0], 0.01 * direction[1]];
      // By key a box goes as far as is asked for: no stop draws it near.
      const { boxes } = driver.choices;
      const corner = [boxes[7 * box] + by[0], boxes[7 * box + 1] + by[1], boxes[7 * box + 2]];
      driver.choices.boxes = placed(boxes, box, corner);
      driver.rechoose();
    } else if (!this.isFixed(box)) this.push = { box, direction, until: driver.time + PUSH };
  }

  /** Whether a box is part of the container: nothing can move it while the world runs. */
  private isFixed(box: number): boolean {
    return this.driver.record.world.boxes.fixed[box] === 1;
  }

  force(time: number): Changes["force"] {
    const { record } = this.driver;
    const { mass } = record.world.boxes;
    const pull = this.pull.force(mass, record.velocities);
    if (pull || !this.push) return pull;
    const { box, direction, until } = this.push;
    if (time >= until) {
      this.push = null;
      return undefined;
    }
    const point = this.scene.boxAt(box).centre.toArray();
    return { box, force: [direction[0] * GRAVITY * mass[box], direction[1] * GRAVITY * mass[box], 0], point };
  }
}
