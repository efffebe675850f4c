import * as THREE from "three";
import type { World } from "../data/results";

/** Boxes that end or pass farther from their place than this, m, leave a trace. */
const LEAST = 0.01;

/** Paths of the centres of mass, straight from sample to sample, with a point at each sample. */
export function traces(world: World): THREE.Group {
  const group = new THREE.Group();
  const { series, boxes } = world;
  if (!series) return group;
  const count = boxes.id.length;
  const lines: number[] = [];
  const points: number[] = [];
  for (let box = 0; box < count; ++box) {
    if (boxes.peak.displacement[box] < LEAST) continue;
    const at = (sample: number) =>
      [0, 1, 2].map((axis) => boxes.reference[3 * box + axis] + series.displacement[3 * (sample * count + box) + axis]);
    for (let sample = 0; sample < series.time.length; ++sample) {
      points.push(...at(sample));
      if (sample > 0) lines.push(...at(sample - 1), ...at(sample));
    }
  }
  const positions = (values: number[]) =>
    new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(values, 3));
  group.add(
    new THREE.LineSegments(positions(lines), new THREE.LineBasicMaterial({ depthTest: false, transparent: true })),
    new THREE.Points(
      positions(points),
      new THREE.PointsMaterial({ size: 3, sizeAttenuation: false, depthTest: false, transparent: true }),
    ),
  );
  group.renderOrder = 2;
  return group;
}
