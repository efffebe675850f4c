import * as THREE from "three";
import { isFull, REAR } from "../data/openings";
import { pushedTo } from "../data/push";
import type { Results, World } from "../data/results";
import { accelerationOf } from "../time/acceleration";
import { type PoseSource, Poses } from "../time/poses";
import { element, oncePerFrame } from "../ui/dom";
import type { LegendEntry } from "../ui/legend";
import type { ViewState } from "../ui/state";
import { gravities } from "../ui/text";
import { colour, isDark } from "../ui/theme";
import { BoxGeometry, boxMaterial, ghostMaterial } from "./box_geometry";
import type { CameraRig } from "./camera_rig";
import { paint } from "./colouring";
import { ContainerFrame } from "./container_frame";
import { Labels } from "./labels";
import { Picker } from "./picker";
import { PushArrow } from "./push_arrow";
import { traces } from "./traces";

/** A ghost shows where a box was that is now farther away than this, m. */
const GHOST_FROM = 0.01;

/** Said where a world is to be shown. */
const NO_WEBGL =
  "Worlds cannot be shown here: WebGL is switched off in this browser, or it has no graphics for it. The matrix and Print do without.";

/** Throws a sentence for the user where the browser draws nothing in three dimensions. */
function createRenderer(): THREE.WebGLRenderer {
  try {
    return new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch {
    throw new Error(NO_WEBGL);
  }
}

/** The picture of one world: container, boxes, and what is drawn over them. It is drawn when something changed. */
export class LoadScene {
  readonly node: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  legend: LegendEntry[] = [];
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly geometry: BoxGeometry;
  private readonly material = boxMaterial();
  private readonly ghostGeometry: BoxGeometry;
  private readonly ghostMaterial = ghostMaterial();
  private readonly ghosts: THREE.Mesh;
  private readonly frame: ContainerFrame;
  private readonly arrow: PushArrow;
  private readonly centre = new THREE.Points(
    new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(6, 3)),
    new THREE.PointsMaterial({
      size: 11,
      sizeAttenuation: false,
      depthTest: false,
      transparent: true,
      vertexColors: true,
    }),
  );
  private traces: THREE.Group;
  private readonly labels: Labels;
  private readonly picker: Picker;
  private readonly poses: PoseSource;
  private readonly distance: Float32Array;
  private painted = "";
  private traced = true;
  private hovered: number | null = null;
  readonly redraw = oncePerFrame(() => this.render());
  /** Runs after a picture is drawn: the video is recorded from there. */
  drawn: () => void = () => {};

  constructor(
    private readonly results: Results,
    readonly world: World,
    private readonly rig: CameraRig,
    private state: ViewState,
    poses?: PoseSource,
  ) {
    this.poses = poses ?? new Poses(world);
    const boxes = world.boxes.id.length;
    this.distance = new Float32Array(boxes);
    this.renderer = createRenderer();
    this.renderer.setPixelRatio(devicePixelRatio);
    this.canvas = this.renderer.domElement;
    const { size, openings } = world.container;
    this.frame = new ContainerFrame(size, openings);
    this.arrow = new PushArrow(size);
    this.geometry = new BoxGeometry(boxes);
    this.ghostGeometry = new BoxGeometry(boxes);
    this.geometry.size.copyArray(world.boxes.size);
    this.ghostGeometry.size.copyArray(world.boxes.size);
    for (let box = 0; box < boxes; ++box) this.ghostGeometry.rotation.setXYZW(box, 0, 0, 0, 1);
    this.picker = new Picker(this.renderer, this.geometry);
    const mesh = new THREE.Mesh(this.geometry, this.material);
    mesh.frustumCulled = false;
    this.ghosts = new THREE.Mesh(this.ghostGeometry, this.ghostMaterial);
    this.ghosts.frustumCulled = false;
    this.ghosts.renderOrder = 1;
    this.traces = traces(world);
    this.centre.geometry.setAttribute("color", new THREE.Float32BufferAttribute(6, 3));
    this.centre.frustumCulled = false;
    this.centre.renderOrder = 3;
    this.scene.add(this.frame, mesh, this.ghosts, this.traces, this.arrow, this.centre);
    const hasDoor = isFull(openings, REAR, size[2]);
    this.labels = new Labels(size, hasDoor ? "door" : "rear");
    this.node = element("div", { class: "scene" }, this.canvas, this.labels.node);
    this.recolour();
    this.show(state);
  }

  /** Takes in what has been simulated since: verdicts, and the paths. */
  refresh(): void {
    this.painted = "";
    this.traced = false;
    this.show(this.state);
  }

  /** The paths, as far as they are known. */
  private trace(): void {
    this.traced = true;
    this.scene.remove(this.traces);
    for (const child of this.traces.children) (child as THREE.Line).geometry.dispose();
    this.traces = traces(this.world);
    this.colourTraces();
    this.scene.add(this.traces);
  }

  /** m: length, width, height */
  get container(): readonly [number, number, number] {
    return this.world.container.size;
  }

  /** Shows more than the load. */
  add(object: THREE.Object3D): void {
    this.scene.add(object);
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.node;
    if (clientWidth === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.rig.setAspect(clientWidth / clientHeight);
    this.redraw();
  }

  recolour(): void {
    this.frame.recolour();
    this.arrow.recolour();
    const edge = new THREE.Color(colour("edge"));
    this.material.uniforms.edge.value = edge;
    this.material.uniforms.chosen.value = new THREE.Color(colour("chosen"));
    this.material.uniforms.dark.value = isDark() ? 1 : 0;
    this.ghostMaterial.uniforms.edge.value = new THREE.Color(colour("faint"));
    this.colourTraces();
    const mark = new THREE.Color(colour("ink"));
    const before = new THREE.Color(colour("faint"));
    this.centreColumn("color").copyArray(Float32Array.of(...before.toArray(), ...mark.toArray()));
    this.centre.geometry.attributes.color.needsUpdate = true;
    this.painted = "";
    this.show(this.state);
  }

  private colourTraces(): void {
    for (const child of this.traces.children)
      ((child as THREE.Line | THREE.Points).material as THREE.LineBasicMaterial).color.set(colour("accent"));
  }

  /** Brings places and colours to what the state says. */
  show(state: ViewState): void {
    this.state = state;
    const { boxes } = this.world;
    const count = boxes.id.length;
    this.poses.set(state.time);
    const [length, width] = this.container;
    const place = this.geometry.place.array as Float32Array;
    const ghost = this.ghostGeometry.place.array as Float32Array;
    const ghostSize = this.ghostGeometry.size.array as Float32Array;
    const middle = [length / 2, width / 2, 0];
    const weight = [0, 0, 0];
    const before = [0, 0, 0];
    let mass = 0;
    const centre = new THREE.Vector3();
    const rotation = new THREE.Quaternion();
    for (let box = 0; box < count; ++box) {
      let squares = 0;
      // Places are those of centres of mass, and boxes are drawn about their middles.
      centre.fromArray(boxes.centre, 3 * box).applyQuaternion(rotation.fromArray(this.poses.rotation, 4 * box));
      const counted = boxes.fixed[box] ? 0 : boxes.mass[box];
      mass += counted;
      for (let axis = 0; axis < 3; ++axis) {
        const i = 3 * box + axis;
        const apart = state.exploded * (boxes.reference[i] - middle[axis]);
        const displacement = this.poses.displacement[i];
        squares += displacement * displacement;
        const from = boxes.reference[i] + apart;
        ghost[i] = from - boxes.centre[i];
        place[i] = from + displacement - centre.getComponent(axis);
        before[axis] += counted * boxes.reference[i];
        weight[axis] += counted * (boxes.reference[i] + displacement);
      }
      this.distance[box] = Math.sqrt(squares);
      const seen = this.distance[box] > GHOST_FROM ? 1 : 0;
      for (let axis = 0; axis < 3; ++axis) ghostSize[3 * box + axis] = seen * boxes.size[3 * box + axis];
    }
    this.geometry.rotation.copyArray(this.poses.rotation);
    this.geometry.place.needsUpdate = true;
    this.geometry.rotation.needsUpdate = true;
    this.ghostGeometry.place.needsUpdate = true;
    this.ghostGeometry.size.needsUpdate = true;
    this.ghosts.visible = state.ghost;
    const traced = state.traces && state.exploded === 0;
    if (traced && !this.traced) this.trace();
    this.traces.visible = traced;
    this.centre.visible = state.centre && mass > 0;
    const centres = [...before, ...weight].map((sum) => sum / mass);
    this.centreColumn("position").copyArray(Float32Array.from(centres));
    this.centre.geometry.attributes.position.needsUpdate = true;
    this.arrow.set(new THREE.Vector3(...accelerationOf(this.world, state.time)));
    const clip = this.clipAt();
    this.material.uniforms.clip.value = clip;
    this.ghostMaterial.uniforms.clip.value = clip;
    this.paint();
    this.mark();
    this.redraw();
  }

  private centreColumn(name: string): THREE.BufferAttribute {
    return this.centre.geometry.getAttribute(name) as THREE.BufferAttribute;
  }

  private clipAt(): number {
    return this.state.clip > 0 ? this.container[0] * (1 - this.state.clip) : 1e9;
  }

  private paint(): void {
    const { colouring, time } = this.state;
    const key = `${colouring} ${isDark()}`;
    if (this.painted === key) return;
    const painted = paint(colouring, this.results, this.world, time, this.distance);
    this.legend = painted.legend;
    this.painted = painted.moving ? "" : key;
    const known = new Map<string, THREE.Color>();
    for (const [box, css] of painted.fills.entries()) {
      const fill = known.get(css) ?? new THREE.Color(css);
      known.set(css, fill);
      this.geometry.fill.setXYZ(box, fill.r, fill.g, fill.b);
    }
    this.geometry.fill.needsUpdate = true;
  }

  hover(box: number | null): void {
    if (box === this.hovered) return;
    this.hovered = box;
    this.mark();
    this.redraw();
  }

  private mark(): void {
    const { mark } = this.geometry;
    (mark.array as Float32Array).fill(0);
    if (this.hovered !== null) mark.setX(this.hovered, 1);
    if (this.state.box !== null && this.state.box < mark.count) mark.setX(this.state.box, 2);
    mark.needsUpdate = true;
  }

  /** Box under a pointer's event. */
  pick(event: { clientX: number; clientY: number }): number | null {
    const box = this.canvas.getBoundingClientRect();
    return this.picker.at(
      event.clientX - box.left,
      event.clientY - box.top,
      box.width,
      box.height,
      this.rig.camera,
      this.clipAt(),
    );
  }

  /** Ray from the camera through a pointer's event. */
  rayAt(event: { clientX: number; clientY: number }): THREE.Ray {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.rig.camera);
    return caster.ray;
  }

  /** A box as it is drawn now: its middle, its centre of mass, its rotation and its edges. */
  boxAt(box: number): {
    place: THREE.Vector3;
    centre: THREE.Vector3;
    rotation: THREE.Quaternion;
    size: THREE.Vector3;
  } {
    const place = new THREE.Vector3().fromBufferAttribute(this.geometry.place, box);
    const rotation = new THREE.Quaternion().fromArray(this.geometry.rotation.array, 4 * box);
    const offset = new THREE.Vector3().fromArray(this.world.boxes.centre, 3 * box).applyQuaternion(rotation);
    return {
      place,
      centre: place.clone().add(offset),
      rotation,
      size: new THREE.Vector3().fromBufferAttribute(this.geometry.size, box),
    };
  }

  /** Where a box is now, and half its diagonal. */
  placeOf(box: number): { place: THREE.Vector3; radius: number } {
    const place = new THREE.Vector3().fromBufferAttribute(this.geometry.place, box);
    return { place, radius: new THREE.Vector3().fromBufferAttribute(this.geometry.size, box).length() / 2 };
  }

  render(): void {
    const { clientWidth, clientHeight } = this.node;
    this.renderer.setClearColor(colour("scene"), 1);
    this.renderer.render(this.scene, this.rig.camera);
    const to = pushedTo(accelerationOf(this.world, this.state.time));
    const push = this.arrow.visible
      ? `pushed ${to === "" ? "" : `to the ${to} `}with ${gravities(this.arrow.size)}`
      : "";
    this.labels.place(this.rig.camera, clientWidth, clientHeight, push, this.arrow.tip());
    this.drawn();
  }

  /** The picture in another size, on a canvas of its own. */
  picture(scale: number): HTMLCanvasElement {
    const { clientWidth, clientHeight } = this.node;
    this.renderer.setPixelRatio(scale);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.render();
    const copy = element("canvas", { width: this.canvas.width, height: this.canvas.height });
    const context = copy.getContext("2d")!;
    context.drawImage(this.canvas, 0, 0);
    context.scale(scale, scale);
    this.paintLabels(context);
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.render();
    return copy;
  }

  /** What is written over the picture, on a canvas. */
  paintLabels(context: CanvasRenderingContext2D): void {
    this.labels.paint(context);
  }

  dispose(): void {
    this.drawn = () => {};
    this.picker.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
