import * as THREE from "three";
import type { Changes } from "../engine/messages";
import type { LoadScene } from "../load/load_scene";
import { colour } from "../ui/theme";
import { hitBox } from "./box_hit";
import { pullForce } from "./spring";

/** A box that the pointer pulls at: where it was taken, and where the pointer is. Drawn as a line. */
export class Pull {
  readonly line = new THREE.Group();
  box: number | null = null;
  /** N, of the latest step */
  strength = 0;
  private readonly shaft = new THREE.Line(
    new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(6, 3)),
    new THREE.LineBasicMaterial({ depthTest: false, transparent: true }),
  );
  private readonly ends = new THREE.Points(
    this.shaft.geometry,
    new THREE.PointsMaterial({ size: 7, sizeAttenuation: false, depthTest: false, transparent: true }),
  );
  /** the point of the box, from its middle, in its own axes */
  private readonly grip = new THREE.Vector3();
  private readonly plane = new THREE.Plane();
  private readonly target = new THREE.Vector3();

  constructor(private readonly scene: LoadScene) {
    this.shaft.frustumCulled = false;
    this.ends.frustumCulled = false;
    this.line.renderOrder = 4;
    this.line.add(this.shaft, this.ends);
    this.line.visible = false;
    scene.add(this.line);
  }

  /** Takes a box where a ray meets it; whether it does. */
  begin(box: number, ray: THREE.Ray, away: THREE.Vector3): boolean {
    const at = this.scene.boxAt(box);
    const hit = hitBox(ray, at);
    if (!hit) return false;
    this.box = box;
    this.grip.copy(hit).sub(at.place).applyQuaternion(at.rotation.clone().invert());
    this.plane.setFromNormalAndCoplanarPoint(away, hit);
    this.target.copy(hit);
    for (const part of [this.shaft, this.ends]) part.material.color.set(colour("accent"));
    this.draw();
    return true;
  }

  move(ray: THREE.Ray): void {
    ray.intersectPlane(this.plane, this.target);
    this.draw();
  }

  end(): void {
    this.box = null;
    this.line.visible = false;
    this.strength = 0;
  }

  /** The point of the box that is pulled at, now. */
  private point(): THREE.Vector3 {
    const at = this.scene.boxAt(this.box!);
    return this.grip.clone().applyQuaternion(at.rotation).add(at.place);
  }

  draw(): void {
    if (this.box === null) return;
    const positions = this.shaft.geometry.getAttribute("position") as THREE.BufferAttribute;
    positions.setXYZ(0, ...this.point().toArray());
    positions.setXYZ(1, ...this.target.toArray());
    positions.needsUpdate = true;
    this.line.visible = true;
  }

  /**
   * What the engine is told.
   * @param velocities rows of six, of all boxes
   */
  force(mass: ArrayLike<number>, velocities: Float64Array): Changes["force"] {
    const { box } = this;
    if (box === null) return undefined;
    const point = this.point();
    const arm = point.clone().sub(this.scene.boxAt(box).centre);
    const [vx, vy, vz, wx, wy, wz] = velocities.subarray(6 * box, 6 * box + 6);
    const velocity = new THREE.Vector3(wx, wy, wz).cross(arm).add(new THREE.Vector3(vx, vy, vz));
    const force = pullForce(this.target.clone().sub(point), velocity, mass[box]);
    this.strength = force.length();
    return { box, force: force.toArray(), point: point.toArray() };
  }
}
