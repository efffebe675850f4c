import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** Directions from which the load is looked at, by key; x, y, z towards the camera. */
export const VIEWS: readonly { name: string; from: [number, number, number] }[] = [
  { name: "whole", from: [0.72, -1, 0.62] },
  { name: "left", from: [0, -1, 0.0001] },
  { name: "right", from: [0, 1, 0.0001] },
  { name: "top", from: [0, -0.0001, 1] },
  { name: "front", from: [-1, 0, 0.0001] },
  { name: "door", from: [1, 0, 0.0001] },
];

/** One camera, moved by the pointers of one or two pictures, so that both show the same. */
export class CameraRig {
  readonly camera = new THREE.PerspectiveCamera(26, 1, 0.05, 200);
  readonly target = new THREE.Vector3();
  private readonly controls: OrbitControls[] = [];
  private size: readonly [number, number, number] = [6, 2.4, 2.4];
  private aspect = 1.6;

  constructor(private readonly changed: () => void) {
    this.camera.up.set(0, 0, 1);
  }

  /** Lets the pointer move the camera in a picture. */
  attach(element: HTMLElement): void {
    const controls = new OrbitControls(this.camera, element);
    controls.target = this.target;
    controls.zoomToCursor = true;
    controls.maxPolarAngle = Math.PI * 0.62;
    controls.minDistance = 0.3;
    controls.maxDistance = 80;
    controls.addEventListener("change", this.changed);
    this.controls.push(controls);
  }

  /** Whether the pointer moves the camera: not while it moves something else. */
  enable(enabled: boolean): void {
    for (const controls of this.controls) controls.enabled = enabled;
  }

  detach(): void {
    for (const controls of this.controls) controls.dispose();
    this.controls.length = 0;
  }

  setAspect(aspect: number): void {
    if (Math.abs(aspect - this.aspect) < 1e-6) return;
    this.aspect = aspect;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  setContainer(size: readonly [number, number, number]): void {
    this.size = size;
  }

  /**
   * Shows the whole container from a side.
   * @param outside places that are to be seen too
   */
  view(index: number, outside: readonly THREE.Vector3[] = []): void {
    const [length, width, height] = this.size;
    const from = new THREE.Vector3(...VIEWS[index].from).normalize();
    this.target.set(length / 2, width / 2, height * 0.42);
    this.camera.position.copy(this.target).add(from);
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld();
    const corners = [0, length].flatMap((x) =>
      [0, width].flatMap((y) => [0, height * 1.12].map((z) => new THREE.Vector3(x, y, z))),
    );
    // The distance at which all corners are within the picture, with a margin.
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    const tall = Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = tall * this.aspect;
    let distance = 1;
    for (const place of [...corners, ...outside]) {
      const corner = place.clone().sub(this.target);
      const depth = corner.dot(from);
      distance = Math.max(
        distance,
        depth + Math.abs(corner.dot(right)) / wide,
        depth + Math.abs(corner.dot(up)) / tall,
      );
    }
    this.camera.position.copy(this.target).addScaledVector(from, distance * 1.1);
    this.update();
  }

  /** Looks as another camera does. */
  lookAs(other: CameraRig): void {
    this.target.copy(other.target);
    this.camera.position.copy(other.camera.position);
    this.update();
  }

  /** Goes near a place, from the same direction. */
  focus(place: THREE.Vector3, radius: number): void {
    const from = this.camera.position.clone().sub(this.target).normalize();
    this.target.copy(place);
    this.camera.position.copy(place).addScaledVector(from, Math.max(1.2, radius * 6));
    this.update();
  }

  private update(): void {
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld();
    for (const controls of this.controls) controls.update();
    this.changed();
  }
}
