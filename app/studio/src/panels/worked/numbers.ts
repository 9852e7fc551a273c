/** The numbers of a worked solution, computed here: they follow a slider without asking anybody. */

import { Matrix4, Vector3 } from "three";

import { transforms } from "../../robot/dh.ts";
import { asMatrix, rows } from "../../robot/pose.ts";
import type { Positions } from "../../state.ts";
import type { DeriveAnswer, DhTable, SolutionNumbers } from "../../types.ts";

const ROWS = ["v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z"];

/** The block of the Jacobian that a determinant is of. */
type Block = DeriveAnswer["determinant"];

/** Everything at a configuration; vectors and the Jacobian in the axes of the base. */
export function numbersAt(table: DhTable, positions: Positions, block: Block): SolutionNumbers {
  const A = transforms(table, positions);
  const T_0 = A.reduce<Matrix4[]>(
    (found, next) => [...found, (found.at(-1) ?? new Matrix4()).clone().multiply(next)],
    [],
  );
  const base = asMatrix(table.base);
  const inBase = [base, ...T_0.map((T) => base.clone().multiply(T))];
  const tip = inBase.at(-1)!.clone().multiply(asMatrix(table.tool));
  const columns = table.joints.map((row, index) => {
    const frame = inBase[table.convention === "standard" ? index : index + 1]!;
    return column(frame, tip, row.type === "revolute");
  });
  const halves = [...columns.map((one) => [...one.linear, ...one.angular])];
  const jacobian = ROWS.map((_, i) => halves.map((half) => half[i]!));
  return {
    A: A.map(rows),
    T_0: T_0.map(rows),
    T_base_tool: rows(tip),
    columns,
    jacobian,
    determinant: block && determinant(turned(jacobian, inBase[block.frame]!, block.rows)),
  };
}

/** What a joint does to the tip: z × p and z where it turns, z and nothing where it slides. */
function column(frame: Matrix4, tip: Matrix4, turns: boolean): SolutionNumbers["columns"][number] {
  const z = new Vector3().setFromMatrixColumn(frame, 2);
  const arm = new Vector3().setFromMatrixPosition(tip).sub(new Vector3().setFromMatrixPosition(frame));
  return {
    axis: z.toArray(),
    arm: arm.toArray(),
    linear: (turns ? z.clone().cross(arm) : z).toArray(),
    angular: turns ? z.toArray() : [0, 0, 0],
  };
}

/** Some rows of the Jacobian, in the axes of a frame. */
function turned(jacobian: number[][], frame: Matrix4, names: readonly string[]): number[][] {
  const R = rows(frame);
  return names.map((name) => {
    const index = ROWS.indexOf(name);
    const first = index < 3 ? 0 : 3;
    const axis = index - first;
    return jacobian[0]!.map((_, j) => [0, 1, 2].reduce((sum, k) => sum + R[k]![axis]! * jacobian[first + k]![j]!, 0));
  });
}

/** By elimination, the largest of each column first. */
export function determinant(matrix: number[][]): number {
  const left = matrix.map((row) => [...row]);
  let product = 1;
  for (let k = 0; k < left.length; k += 1) {
    const size = (row: number[]) => Math.abs(row[k]!);
    const pivot = left.slice(k).reduce((best, row) => (size(row) > size(best) ? row : best));
    const place = left.indexOf(pivot);
    if (pivot[k] === 0) return 0;
    if (place !== k) {
      [left[k], left[place]] = [pivot, left[k]!];
      product = -product;
    }
    product *= pivot[k]!;
    for (const row of left.slice(k + 1)) {
      const times = row[k]! / pivot[k]!;
      for (let j = k; j < row.length; j += 1) row[j] = row[j]! - times * pivot[j]!;
    }
  }
  return product;
}

/** The largest difference of two numbers in the same place. */
export function apart(one: SolutionNumbers, other: SolutionNumbers): number {
  const [here, there] = [flat(one), flat(other)];
  if (here.length !== there.length) return Infinity;
  return here.reduce((most, value, index) => Math.max(most, Math.abs(value - there[index]!)), 0);
}

function flat({ A, T_0, T_base_tool, columns, jacobian, determinant: det }: SolutionNumbers): number[] {
  const vectors = columns.flatMap(({ axis, arm, linear, angular }) => [axis, arm, linear, angular]);
  return [A, T_0, T_base_tool, vectors, jacobian, det ?? []].flat(3) as number[];
}
