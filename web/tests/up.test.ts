import { expect, it } from "vitest";
import { boxOf, guessUp, roundLength, type Box } from "../src/geometry/up";

const box = (x: [number, number], y: [number, number], z: [number, number]): Box => ({
  min: [x[0], y[0], z[0]],
  max: [x[1], y[1], z[1]],
});
const about = (size: number): [number, number] => [-size / 2, size / 2];

it("the box has all points in it", () => {
  expect(boxOf([1, 2, 3, -1, 5, 0])).toEqual(box([-1, 1], [2, 5], [0, 3]));
});

it("z is up unless the box speaks for y", () => {
  expect(guessUp(box(about(1), about(1), about(1)))).toBe("z"); // a ball
  expect(guessUp(box(about(3), about(2), about(1)))).toBe("z"); // an asteroid
  expect(guessUp(box(about(0.6), about(1), about(0.75)))).toBe("y"); // a head
  expect(guessUp(box(about(0.6), about(0.75), about(1)))).toBe("z");
  expect(guessUp(box(about(4), about(0.1), about(4)))).toBe("y"); // a landscape
  expect(guessUp(box(about(4), about(4), about(0.1)))).toBe("z"); // a plate
  expect(guessUp(box(about(2), [0, 1], about(2)))).toBe("y"); // stands on y = 0
  expect(guessUp(box(about(1), about(2), [0, 0.9]))).toBe("z"); // stands on z = 0, for any proportions
  expect(guessUp(box([0, 2], [0, 1], [0, 2]))).toBe("z"); // lies in a corner: no indication
});

it("bars have round lengths, as long as they may be", () => {
  expect([0.99, 1, 1.9, 2, 4.9, 5, 9.9, 12].map(roundLength)).toEqual([0.5, 1, 1, 2, 2, 5, 5, 10]);
  expect(roundLength(3.2e-9)).toBe(2e-9);
  expect(roundLength(0)).toBe(0);
  expect(roundLength(Infinity)).toBe(0);
});
