import * as THREE from "three";

/**
 * All boxes of a world as instances of one cube: place, rotation, size and colour are attributes, so that ten thousand of them are
 * one draw call. Edges and dots are drawn by the fragment shader, in metres on each face.
 */

const VERTEX = /* glsl */ `
  attribute vec3 place;
  attribute vec4 rotation;
  attribute vec3 size;
  attribute vec3 fill;
  attribute float mark;
  attribute float number;
  uniform float grown;
  varying vec3 vFill;
  varying vec3 vLocal;
  varying vec3 vFace;
  varying vec3 vHalf;
  varying vec3 vNormal;
  varying vec3 vWorld;
  varying float vMark;
  varying float vNumber;
  vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
  void main() {
    vLocal = position * (size + grown);
    vHalf = 0.5 * size;
    vFace = normal;
    vNormal = turned(rotation, normal);
    vWorld = place + turned(rotation, vLocal);
    vFill = fill;
    vMark = mark;
    vNumber = number;
    gl_Position = projectionMatrix * viewMatrix * vec4(vWorld, 1.0);
  }
`;

const SURFACE = /* glsl */ `
  varying vec3 vFill;
  varying vec3 vLocal;
  varying vec3 vFace;
  varying vec3 vHalf;
  varying vec3 vNormal;
  varying vec3 vWorld;
  varying float vMark;
  varying float vNumber;
  uniform float clip;
  // Coordinates on the face, and its half lengths.
  void onFace(out vec2 at, out vec2 halfs) {
    vec3 n = abs(vFace);
    if (n.x > 0.5) { at = vLocal.yz * vec2(vFace.x, 1.0); halfs = vHalf.yz; }
    else if (n.y > 0.5) { at = vLocal.xz * vec2(-vFace.y, 1.0); halfs = vHalf.xz; }
    else { at = vLocal.xy * vec2(vFace.z, 1.0); halfs = vHalf.xy; }
  }
  // How much of the pixel lies in the line along the face's border.
  float border(vec2 at, vec2 halfs, float pixels) {
    vec2 inside = (halfs - abs(at)) / max(fwidth(at), vec2(1e-6));
    return 1.0 - smoothstep(pixels - 0.5, pixels + 0.5, min(inside.x, inside.y));
  }
`;

const FRAGMENT = /* glsl */ `
  ${SURFACE}
  uniform vec3 edge;
  uniform vec3 chosen;
  uniform float dark;
  uniform float faded;
  void main() {
    if (vWorld.x > clip) discard;
    vec2 at, halfs;
    onFace(at, halfs);
    // Two lamps that stand still: each face of a box at rest has its own tone.
    vec3 n = normalize(vNormal);
    float tone = 0.80 + 0.16 * n.z + 0.06 * n.y - 0.05 * n.x;
    tone = mix(tone, tone * 0.94, dark);
    vec3 colour = vFill * tone;
    // A dot in one corner of each face, two on the top as loaded: a turned box shows it.
    float radius = 0.07 * min(halfs.x, halfs.y) + 0.006;
    vec2 corner = halfs - 0.32 * min(halfs.x, halfs.y);
    float far = distance(at, corner);
    if (vFace.z > 0.5) far = min(far, distance(at, corner - vec2(3.2 * radius, 0.0)));
    float soft = max(fwidth(far), 1e-5);
    colour = mix(colour, edge, 0.55 * (1.0 - smoothstep(radius - soft, radius + soft, far)));
    float line = border(at, halfs, vMark > 0.5 ? 2.0 : 1.1);
    colour = mix(colour, vMark > 0.5 ? chosen : edge, line * (vMark > 0.5 ? 1.0 : 0.62));
    if (vMark > 1.5) colour = mix(colour, chosen, 0.12);
    gl_FragColor = vec4(colour, 1.0 - faded);
    #include <colorspace_fragment>
  }
`;

const GHOST = /* glsl */ `
  ${SURFACE}
  uniform vec3 edge;
  void main() {
    if (vWorld.x > clip) discard;
    vec2 at, halfs;
    onFace(at, halfs);
    float line = border(at, halfs, 1.2);
    gl_FragColor = vec4(edge, 0.05 + 0.6 * line);
    #include <colorspace_fragment>
  }
`;

const NUMBER = /* glsl */ `
  ${SURFACE}
  void main() {
    if (vWorld.x > clip) discard;
    float n = vNumber + 1.0;
    gl_FragColor = vec4(mod(n, 256.0), mod(floor(n / 256.0), 256.0), floor(n / 65536.0), 255.0) / 255.0;
  }
`;

export class BoxGeometry extends THREE.InstancedBufferGeometry {
  readonly place: THREE.InstancedBufferAttribute;
  readonly rotation: THREE.InstancedBufferAttribute;
  readonly size: THREE.InstancedBufferAttribute;
  readonly fill: THREE.InstancedBufferAttribute;
  readonly mark: THREE.InstancedBufferAttribute;

  constructor(boxes: number) {
    super();
    const cube = new THREE.BoxGeometry(1, 1, 1);
    this.index = cube.index;
    this.setAttribute("position", cube.attributes.position);
    this.setAttribute("normal", cube.attributes.normal);
    const column = (name: string, width: number) => {
      const attribute = new THREE.InstancedBufferAttribute(new Float32Array(width * boxes), width);
      attribute.setUsage(THREE.DynamicDrawUsage);
      this.setAttribute(name, attribute);
      return attribute;
    };
    this.place = column("place", 3);
    this.rotation = column("rotation", 4);
    this.size = column("size", 3);
    this.fill = column("fill", 3);
    this.mark = column("mark", 1);
    column("number", 1).copyArray(Float32Array.from({ length: boxes }, (_, i) => i));
    this.instanceCount = boxes;
    // Boxes move: nothing is left out for being out of sight.
    this.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Number.POSITIVE_INFINITY);
  }
}

const uniforms = (extra: Record<string, unknown> = {}) => {
  const values: Record<string, THREE.IUniform> = { clip: { value: 1e9 }, grown: { value: 0 } };
  for (const [name, value] of Object.entries(extra)) values[name] = { value };
  return values;
};

export const boxMaterial = () =>
  new THREE.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: uniforms({ edge: new THREE.Color(), chosen: new THREE.Color(), dark: 0, faded: 0 }),
  });

/** Outlines of where boxes were. */
export const ghostMaterial = () =>
  new THREE.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: GHOST,
    uniforms: uniforms({ edge: new THREE.Color() }),
    transparent: true,
    depthWrite: false,
  });

/** Each box in a colour that says its number, for picking. */
export const numberMaterial = () =>
  new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: NUMBER, uniforms: uniforms() });
