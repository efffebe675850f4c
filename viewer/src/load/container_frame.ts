import * as THREE from "three";
import { isClosed, type Openings } from "../data/openings";
import { colour } from "../ui/theme";
import { bedOf, insideOf, type Size } from "./container_faces";

/** m between lines of the grid on the floor */
const GRID = 0.5;
/** m around the container that the ground is drawn for, and m in which it fades beyond that. */
const GROUND = 3;
const FADE = 5;

type Lines = THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
type Faces = THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;

/**
 * The container: edges, floor grid, and walls of which only those behind the load are seen. Where a side is open or low, also the
 * floor as a block on the ground.
 */
export class ContainerFrame extends THREE.Group {
  private readonly edges: Lines;
  private readonly grid: Lines;
  private readonly walls: Faces;
  private readonly bed: Faces;
  private readonly ground: Faces;

  constructor(size: Size, openings: Openings) {
    super();
    const [length, width, height] = size;
    const inside = insideOf(size, openings);
    const bed = bedOf(size, openings);
    // Seen from inside only: a wall between the camera and the load turns its back.
    this.walls = new THREE.Mesh(inside.faces(), surface(2));
    this.edges = new THREE.LineSegments(inside.edges(bed), new THREE.LineBasicMaterial());
    // What fell behind the floor is seen through it.
    this.bed = new THREE.Mesh(bed.faces(), surface(2));
    Object.assign(this.bed.material, { transparent: true, opacity: 0.55, depthWrite: false });
    this.bed.renderOrder = 0.5;
    this.ground = new THREE.Mesh(groundOf(size, -openings.bedHeight), surface(4));
    Object.assign(this.ground.material, { transparent: true, vertexColors: true, depthWrite: false });
    this.ground.visible = !isClosed(openings, height);
    const points: number[] = [];
    for (let x = GRID; x < length; x += GRID) points.push(x, 0, 0, x, width, 0);
    for (let y = GRID; y < width; y += GRID) points.push(0, y, 0, length, y, 0);
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.grid = new THREE.LineSegments(lines, new THREE.LineBasicMaterial());
    this.add(this.ground, this.walls, this.bed, this.grid, this.edges);
  }

  recolour(): void {
    this.edges.material.color.set(colour("frame"));
    this.grid.material.color.set(colour("grid"));
    this.walls.material.color.set(colour("wall"));
    this.bed.material.color.set(colour("bed"));
    this.ground.material.color.set(colour("outside"));
  }
}

/** Behind lines and boxes that lie in it. */
const surface = (offset: number) =>
  new THREE.MeshBasicMaterial({ polygonOffset: true, polygonOffsetFactor: offset, polygonOffsetUnits: offset });

/** A plane that fades towards its border. */
function groundOf([length, width]: Size, z: number): THREE.BufferGeometry {
  const along = [-GROUND - FADE, -GROUND, length + GROUND, length + GROUND + FADE];
  const across = [-GROUND - FADE, -GROUND, width + GROUND, width + GROUND + FADE];
  const points: number[] = [];
  const colours: number[] = [];
  const corners: number[] = [];
  for (const [i, x] of along.entries())
    for (const [j, y] of across.entries()) {
      points.push(x, y, z);
      colours.push(1, 1, 1, i % 3 === 0 || j % 3 === 0 ? 0 : 1);
      if (i === 3 || j === 3) continue;
      const at = 4 * i + j;
      // The diagonal of a corner's square goes to its one corner that is not faded.
      const [a, b, c, d] = [at, at + 4, at + 5, at + 1];
      corners.push(...(i === j ? [a, b, c, a, c, d] : [a, b, d, b, c, d]));
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
  geometry.setIndex(corners);
  return geometry;
}
