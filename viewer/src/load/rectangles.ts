import * as THREE from "three";

/** Rectangles across the axes, seen from one side, as geometry. */
export class Rectangles {
  /** Corners of each, m: smallest and largest coordinates. */
  readonly corners: { low: readonly number[]; high: readonly number[] }[] = [];
  private readonly triangles: number[] = [];
  private readonly lines: number[] = [];

  /**
   * @param low corner with the smallest coordinates, m
   * @param high the opposite one, equal to it on one axis
   * @param towards sign of that axis on the side from which it is seen
   */
  add(low: readonly number[], high: readonly number[], towards: 1 | -1): void {
    this.corners.push({ low, high });
    const axis = low.findIndex((value, i) => value === high[i]);
    const [b, c] = [0, 1, 2].filter((other) => other !== axis);
    const corner = (atB: number, atC: number) => {
      const point = [...low];
      point[b] = atB;
      point[c] = atC;
      return point;
    };
    const ring = [corner(low[b], low[c]), corner(high[b], low[c]), corner(high[b], high[c]), corner(low[b], high[c])];
    // x × z is −y.
    if ((axis === 1 ? -1 : 1) !== towards) ring.reverse();
    this.triangles.push(...[0, 1, 2, 0, 2, 3].flatMap((i) => ring[i]));
    this.lines.push(...[0, 1, 1, 2, 2, 3, 3, 0].flatMap((i) => ring[i]));
  }

  faces(): THREE.BufferGeometry {
    return geometry(this.triangles);
  }

  /** The borders of these rectangles and of others. */
  edges(others: Rectangles): THREE.BufferGeometry {
    return geometry([...this.lines, ...others.lines]);
  }
}

function geometry(points: number[]): THREE.BufferGeometry {
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}
