import * as THREE from "three";
import { GRAVITY } from "../data/push";
import { colour } from "../ui/theme";

/** m of arrow per g */
const LENGTH = 1.2;

/** Where the load is pushed, and how hard, as an arrow above the middle of the container. */
export class PushArrow extends THREE.ArrowHelper {
  /** g */
  size = 0;

  constructor(private readonly container: readonly [number, number, number]) {
    super(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1);
    this.visible = false;
  }

  /** @param acceleration of the container, m/s²: the load is pushed against it */
  set(acceleration: THREE.Vector3): void {
    this.size = acceleration.length() / GRAVITY;
    this.visible = this.size > 0.005;
    if (!this.visible) return;
    const length = LENGTH * this.size;
    const direction = acceleration.clone().negate().normalize();
    const [x, y, z] = this.container;
    this.position.set(x / 2, y / 2, z + 0.15).addScaledVector(direction, -length / 2);
    this.setDirection(direction);
    this.setLength(length, Math.min(0.22, 0.4 * length), 0.1);
  }

  recolour(): void {
    this.setColor(colour("accent"));
  }

  /** Where its label stands. */
  tip(): THREE.Vector3 {
    const [x, y, z] = this.container;
    return new THREE.Vector3(x / 2, y / 2, z + 0.36);
  }
}
