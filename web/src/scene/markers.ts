// Rings on the surface: where the brush is, where a texture comes from and where it goes.
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
  normal: [number, number, number]; // of the surface there
  radius: number;
  color: Rgb;
  handle?: number; // a ball on the ring to take hold of, at this angle from its own first direction, radians
}

const up = new Vector3(0, 0, 1);
const segments = 96; // chosen: a circle to the eye

// From the plane of the ring to space.
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

export class Markers {
  readonly group = new Group();
  private readonly loop = circle();
  private materials: (LineBasicMaterial | MeshBasicMaterial)[] = [];
  private readonly ball = new SphereGeometry(1, 24, 16);

  show(rings: readonly Ring[]): void {
    this.group.clear();
    this.materials.forEach((material) => material.dispose());
    this.materials = [];
    for (const ring of rings) this.add(ring);
  }

  private add(ring: Ring): void {
    const line = new LineLoop(this.loop, new LineBasicMaterial({ depthTest: false }));
    line.material.color.setRGB(...ring.color);
    line.position.set(...ring.center);
    line.quaternion.copy(ringFrame(ring));
    line.scale.setScalar(ring.radius);
    line.renderOrder = 1;
    this.group.add(line);
    this.materials.push(line.material);
    if (ring.handle === undefined) return;
    const ball = new Mesh(this.ball, new MeshBasicMaterial({ depthTest: false }));
    ball.material.color.setRGB(...ring.color);
    ball.position.copy(handlePlace(ring));
    ball.scale.setScalar(ring.radius / 8);
    ball.renderOrder = 2;
    this.group.add(ball);
    this.materials.push(ball.material);
  }

  dispose(): void {
    this.show([]);
    this.loop.dispose();
    this.ball.dispose();
  }
}
