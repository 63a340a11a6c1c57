// Rings on the surface: at the brush, at the source of a texture, and at its target.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import type { Rgb } from "../geometry/colors";

export interface Ring {
  center: [number, number, number];
  normal: [number, number, number]; // normal of the surface there
  radius: number;
  color: Rgb;
  handle?: number; // a ball on the ring to drag, at this angle from the ring's first direction, radians
}

const up = new Vector3(0, 0, 1);
const segments = 96; // chosen: looks like a circle

// Returns the rotation from the plane of the ring to space.
export function ringFrame(ring: Ring): Quaternion {
  return new Quaternion().setFromUnitVectors(up, new Vector3(...ring.normal).normalize());
}

export function handlePlace(ring: Ring): Vector3 {
  const angle = ring.handle ?? 0;
  return new Vector3(Math.cos(angle), Math.sin(angle), 0)
    .multiplyScalar(ring.radius)
    .applyQuaternion(ringFrame(ring))
    .add(new Vector3(...ring.center));
}

function circle(): BufferGeometry {
  const points = new Float32Array(3 * segments);
  for (let k = 0; k < segments; ++k) {
    const angle = (2 * Math.PI * k) / segments;
    points.set([Math.cos(angle), Math.sin(angle), 0], 3 * k);
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
}

// A line and a ball that are reused for all rings, because
// disposing of a material also disposes of its compiled program.
class Marker {
  readonly line: LineLoop<BufferGeometry, LineBasicMaterial>;
  readonly ball: Mesh<BufferGeometry, MeshBasicMaterial>;

  constructor(loop: BufferGeometry, ball: BufferGeometry) {
    this.line = new LineLoop(loop, new LineBasicMaterial({ depthTest: false }));
    this.line.renderOrder = 1;
    this.ball = new Mesh(ball, new MeshBasicMaterial({ depthTest: false }));
    this.ball.renderOrder = 2;
  }

  show(ring: Ring | undefined): void {
    this.line.visible = ring !== undefined;
    this.ball.visible = ring?.handle !== undefined;
    if (!ring) return;
    this.line.material.color.setRGB(...ring.color);
    this.line.position.set(...ring.center);
    this.line.quaternion.copy(ringFrame(ring));
    this.line.scale.setScalar(ring.radius);
    this.ball.material.color.setRGB(...ring.color);
    this.ball.position.copy(handlePlace(ring));
    this.ball.scale.setScalar(ring.radius / 8);
  }

  dispose(): void {
    this.line.material.dispose();
    this.ball.material.dispose();
  }
}

export class Markers {
  readonly group = new Group();
  private readonly loop = circle();
  private readonly ball = new SphereGeometry(1, 24, 16);
  private readonly markers: Marker[] = [];

  show(rings: readonly Ring[]): void {
    while (this.markers.length < rings.length) {
      const made = new Marker(this.loop, this.ball);
      this.markers.push(made);
      this.group.add(made.line, made.ball);
    }
    this.markers.forEach((marker, i) => marker.show(rings[i]));
  }

  dispose(): void {
    this.markers.forEach((marker) => marker.dispose());
    this.loop.dispose();
    this.ball.dispose();
  }
}
