/** A part of the worked solution on the page: formulas are set once, numbers follow the joints. */

import { t } from "../../texts/index.ts";
import type { SolutionNumbers } from "../../types.ts";
import { copyButton } from "../../ui/copy.ts";
import { button, element, reaching } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { matrixLatex } from "../../ui/matrices.ts";
import { NumberMatrix } from "./matrix.ts";
import type { Line, Section } from "./solution.ts";

/** Characters of a formula that fills the width for sure: it is laid out when it comes into sight. */
const LARGE = 500;

/** Of a column of a matrix, as KaTeX sets it, from above. */
const CELLS = ":scope > .vlist-t > .vlist-r:first-child > .vlist > span";

const NOTHING = t("There is nothing to write down here; the remarks below say why.");

export class Sheet {
  readonly host = element("div", { class: "sheet" });
  #numbers: SolutionNumbers | null = null;
  #follow: ((all: SolutionNumbers) => void)[] = [];
  #watch = reaching();
  #hues: readonly string[] = [];

  /** @param go moves the robot to a configuration, in the order of the table's joints. */
  constructor(private readonly go: (positions: number[]) => void) {}

  /** Set the formulas of some sections in the place of those before; what belongs to a row has its colour. */
  show(sections: readonly Section[], numbers: SolutionNumbers, hues: readonly string[]): void {
    this.clear();
    this.#hues = hues;
    this.host.replaceChildren(...sections.map((section) => this.#section(section)));
    if (!sections.length) this.host.append(element("p", { class: "section muted" }, NOTHING));
    this.update(numbers);
  }

  /** Write the numbers beside the formulas. */
  update(numbers: SolutionNumbers): void {
    this.#numbers = numbers;
    for (const follow of this.#follow) follow(numbers);
  }

  clear(): void {
    this.#watch.disconnect();
    this.#follow = [];
    this.host.replaceChildren();
  }

  #section(section: Section): HTMLElement {
    const copy = copyButton(() => asLatex(section, this.#numbers), t("{title} as LaTeX", { title: section.title }));
    return element(
      "section",
      { class: "section step" },
      element("div", { class: "step-head" }, element("h2", {}, section.title), copy),
      section.text && element("p", { class: "muted small" }, section.text),
      element("div", { class: "lines" }, ...section.lines.map((line) => this.#line(line))),
    );
  }

  #line(line: Line): HTMLElement {
    const { name, numbers, example, row } = line;
    const region = element("div", { class: "wide", role: "group", "aria-label": name });
    this.#watch.observe(region);
    const isLarge = (line.latex?.length ?? 0) > LARGE;
    const host = element("div", { class: "line" }, region);
    if (row !== undefined) host.classList.add("tinted", this.#hues[row]!);
    host.classList.toggle("large", isLarge);
    host.classList.toggle("unbroken", isLarge || numbers !== undefined);
    this.#set(line, region);
    if (numbers) {
      const matrix = new NumberMatrix(t("{name} in numbers", { name }));
      this.#follow.push((all) => matrix.set(numbers(all)));
      host.append(element("div", { class: "numeric" }, element("span", { class: "approximately" }, "≈"), matrix.host));
    }
    if (example)
      host.append(
        button(t("Go there"), () => this.go(example.positions), {
          class: "button small",
          title: t("A configuration of this kind, {title}", { title: example.title }),
        }),
      );
    return host;
  }

  /** Give each column or row of a matrix the colour of its joint. */
  #tint(matrix: HTMLElement, each: Line["each"]): void {
    for (const [i, column] of matrix.querySelectorAll(".mtable > [class^='col-align']").entries()) {
      if (each === "column") column.classList.add("toned", this.#hues[i]!);
      if (each === "row")
        for (const [k, cell] of column.querySelectorAll(CELLS).entries())
          if (k > 0) cell.classList.add("toned", this.#hues[k - 1]!);
    }
  }

  #set(line: Line, region: HTMLElement): void {
    if (!line.isLong) {
      region.replaceChildren(formula(written(line), false, (made) => this.#tint(made, line.each)));
      return;
    }
    const more = button(t("Write it out"), () => this.#set({ ...line, isLong: false }, region), {
      class: "button small",
    });
    region.replaceChildren(formula(line.symbol), " ", more);
  }
}

/** Both sides of it, or its name where only numbers follow. */
function written({ symbol, latex }: Line): string {
  return latex === null || symbol === "" ? (latex ?? symbol) : `${symbol} = ${latex}`;
}

/** A section for a LaTeX document with amsmath. */
function asLatex({ title, text, lines }: Section, numbers: SolutionNumbers | null): string {
  const formulas = lines.map((line) => {
    const value = numbers && line.numbers ? ` \\approx ${matrixLatex(line.numbers(numbers))}` : "";
    return `\\[ ${written(line)}${value} \\]`;
  });
  return [`\\paragraph{${title}}`, escaped(text), ...formulas].filter(Boolean).join("\n");
}

/** Words of the service as LaTeX text. */
function escaped(text: string): string {
  return text
    .replace(/[_%&#$]/g, "\\$&")
    .replaceAll("°", "\\textdegree{}")
    .replaceAll("×", "$\\times$")
    .replaceAll("…", "\\dots{}");
}
