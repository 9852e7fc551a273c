/** Which calculator is open, and its inputs; a link restores both. */

import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { Calculator, Inputs } from "./calculator.ts";
import { CALCULATORS } from "./calculators.ts";

const TASK = "course.task";
const INPUTS = "course.inputs";

export interface Place {
  calculator: Calculator;
  inputs: Inputs;
}

export function placeOf({ options }: Readonly<State>): Place {
  const calculator = CALCULATORS.find(({ id }) => id === options[TASK]) ?? CALCULATORS[0]!;
  return { calculator, inputs: inputsOf(options[INPUTS]) ?? calculator.examples[0]!.inputs };
}

/** Go to a calculator with inputs; those of its first example need not be in the link. */
export function go(store: Store<State>, { calculator, inputs }: Place): void {
  const { [INPUTS]: _, ...others } = store.value.options;
  const isFirst = JSON.stringify(inputs) === JSON.stringify(calculator.examples[0]!.inputs);
  const own = isFirst ? {} : { [INPUTS]: JSON.stringify(inputs) };
  store.set({ options: { ...others, [TASK]: calculator.id, ...own } });
}

function inputsOf(text: string | undefined): Inputs | null {
  try {
    const given: unknown = JSON.parse(text ?? "null");
    return typeof given === "object" && given !== null && !Array.isArray(given) ? (given as Inputs) : null;
  } catch {
    return null;
  }
}
