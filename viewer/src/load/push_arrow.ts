import * as THREE from "three";
import { colour } from "../ui/theme";

/** m of arrow per g */
const LENGTH = 1.2;
const GRAVITY = 9.81;

/** The container's acceleration, as an arrow above its middle. */
export class PushArrow extends THREE.ArrowHelper {
  /** g */
  size = 0;

  constructor(private readonly container: readonly [number, number, number]) {
    super(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1);
    this.visible = false;
  }

  set(acceleration: THREE.Vector3): void {
    this.size = acceleration.length() / GRAVITY;
    this.visible = this.size > 0.005;
    if (!this.visible) return;
    const length = LENGTH * this.size;
    const direction = acceleration.clone().normalize();
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
