import * as THREE from "three";
import { colour } from "../ui/theme";

/** m between lines of the grid on the floor */
const GRID = 0.5;

/** The container: edges, floor grid, and walls of which only those behind the load are seen. */
export class ContainerFrame extends THREE.Group {
  private readonly edges: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly grid: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly walls: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;

  constructor([length, width, height]: readonly [number, number, number]) {
    super();
    const box = new THREE.BoxGeometry(length, width, height);
    box.translate(length / 2, width / 2, height / 2);
    this.edges = new THREE.LineSegments(new THREE.EdgesGeometry(box), new THREE.LineBasicMaterial());
    // Seen from inside only: a wall between the camera and the load turns its back.
    this.walls = new THREE.Mesh(
      box,
      new THREE.MeshBasicMaterial({
        side: THREE.BackSide,
        polygonOffset: true,
        polygonOffsetFactor: 2,
        polygonOffsetUnits: 2,
      }),
    );
    const points: number[] = [];
    for (let x = GRID; x < length; x += GRID) points.push(x, 0, 0, x, width, 0);
    for (let y = GRID; y < width; y += GRID) points.push(0, y, 0, length, y, 0);
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.grid = new THREE.LineSegments(lines, new THREE.LineBasicMaterial());
    this.add(this.walls, this.grid, this.edges);
  }

  recolour(): void {
    this.edges.material.color.set(colour("frame"));
    this.grid.material.color.set(colour("grid"));
    this.walls.material.color.set(colour("wall"));
  }
}
