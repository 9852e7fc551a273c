/** The second robot in the picture, beside the first or over it, and how far their frames are apart. */

import { Group, type Material, Matrix4, type MeshBasicMaterial, Sphere, Vector3 } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { type ShownChain, shownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { measured, type Units, UNITS } from "../../ui/quantity.ts";
import { colour } from "../../view/colours.ts";
import { drawFigures } from "../../view/figure.ts";
import { Ghost } from "../../view/ghosts.ts";
import { clear, label, put, rod, stretch, triad } from "../../view/shapes.ts";
import { extent } from "../../view/stage.ts";
import type { View } from "../../view/view.ts";
import type { Pair } from "./pairs.ts";
import type { Second } from "./second.ts";
import { valuesOf } from "./verdicts.ts";

const FAINT = 0.45;
/** Of lines between frames, in the picture's unit. */
const THICK = 0.035;
const THIN = 0.012;
const WIDE = 0.06;
/** Room between the two robots, in the sum of half their sizes. */
const APART = 1.1;

export class Picture {
  /** Frames with their names, and lines between those that differ. */
  readonly marks = new Group();
  #ghost: Ghost | null = null;
  #name = label("", "compared");
  /** The number that differs, along its length, or where its angle is. */
  #wrong = { line: rod(new Vector3(), new Vector3(), 1, colour("bad")), text: label("", "apart") };
  #marks: Mark[] = [];
  /** From the first to the second, in the world. */
  #shift = new Vector3();
  #stops: (() => void)[];

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
    private readonly second: Second,
  ) {
    this.marks.name = "comparison";
    this.#wrong.line.name = "first difference";
    view.scene.add(this.marks, this.#name, this.#wrong.line, this.#wrong.text);
    const { own, facts } = second;
    drawFigures(view, own);
    this.#stops = [
      own.watch(["model", "meshes", "dark"], () => this.#arrange()),
      store.watch(["model", "meshes", "options"], () => this.#arrange()),
      facts.watch(["tables"], () => this.#build()),
      own.watch(["model", "unit", "dark"], () => this.#build()),
      facts.watch(["pairs", "verdict"], () => this.#follow()),
      own.watch(UNITS, () => this.#follow()),
    ];
  }

  close(): void {
    for (const stop of this.#stops) stop();
    this.#ghost?.remove();
    clear(this.marks);
    this.marks.removeFromParent();
    for (const part of [this.#name, this.#wrong.line, this.#wrong.text]) part.removeFromParent();
    (this.#wrong.line.material as Material).dispose();
    this.view.surround("compare", null);
  }

  get #isOver(): boolean {
    return this.second.wanted.placing === "over";
  }

  /** Put the second where there is room for it, or over the first. */
  #arrange(): void {
    const { model } = this.second.own.value;
    const first = this.store.value.model;
    this.#ghost?.remove();
    this.#ghost = null;
    this.#name.visible = model !== null;
    if (!model || !first) return this.view.surround("compare", null);
    this.view.scene.add(model.root);
    model.root.visible = !this.#isOver;
    this.#shift.set(0, 0, 0);
    this.#place();
    if (this.#isOver) {
      this.#ghost = new Ghost(model, shownChain(this.second.own.value)!.joints, "accent", FAINT);
      this.view.scene.add(this.#ghost.group);
    } else {
      const [one, other] = [extent(first), extent(model)].map((box) => box.getBoundingSphere(new Sphere()));
      const along = this.view.right;
      const between = other!.center.clone().sub(one!.center).dot(along);
      this.#shift.copy(along).multiplyScalar(APART * (one!.radius + other!.radius) - between);
    }
    this.#place();
    this.view.surround("compare", extent(model).getBoundingSphere(new Sphere()));
    this.#follow();
  }

  /** The base of the second where the first one's is and the comparison has it, aside by the shift. */
  #place(): void {
    const [one, other] = [shownChain(this.store.value)!, shownChain(this.second.own.value)!];
    const { root } = other.model;
    const T_root_base = root.matrixWorld.clone().invert().multiply(other.model.link(other.base).matrixWorld);
    const T = this.#base(one).multiply(this.second.alignment.base).multiply(T_root_base.invert());
    put(root, T);
    root.updateMatrixWorld(true);
  }

  /** Where the first one's base would be at the second. */
  #base({ model, base }: ShownChain): Matrix4 {
    const T = model.link(base).matrixWorld.clone();
    return new Matrix4().makeTranslation(this.#shift).multiply(T);
  }

  #build(): void {
    clear(this.marks);
    this.#name.element.textContent = titleOf(this.second);
    const { unit } = this.second.own.value;
    const count = this.second.facts.value.pairs.length;
    this.#marks = Array.from({ length: count }, () => new Mark(unit));
    for (const mark of this.#marks) this.marks.add(...mark.parts);
    this.#follow();
  }

  #follow(): void {
    const { pairs } = this.second.facts.value;
    if (pairs.length !== this.#marks.length) return this.#build();
    const chain = shownChain(this.store.value);
    const { model, positions, unit } = this.second.own.value;
    if (chain && model) {
      this.#place();
      this.#ghost?.place(positions, positions);
      const differing = pairs.find(({ meets }) => !meets);
      for (const [i, found] of pairs.entries()) {
        const isNamed = found === differing || found.index === null;
        this.#marks[i]!.place(found, chain, this.#base(chain), { isOver: this.#isOver, isNamed, ...this.store.value });
      }
      this.#name.position.setFromMatrixPosition(this.#base(chain)).addScaledVector(this.view.camera.up, -unit);
    }
    this.#point();
    this.view.draw();
  }

  /** Show the number that the service finds to differ. */
  #point(): void {
    const { line, text } = this.#wrong;
    const found = this.second.wrong;
    const chain = shownChain(this.store.value);
    line.visible = text.visible = found !== null && chain !== null;
    if (!found || !chain) return;
    const { unit } = this.second.own.value;
    const T = found.isOfSecond ? this.#base(chain) : chain.model.link(chain.base).matrixWorld;
    const [from, to] = [found.from, found.to].map((point) => point.clone().applyMatrix4(T));
    (line.material as MeshBasicMaterial).color = colour("bad");
    stretch(line, from!, to!, unit * WIDE);
    text.position.copy(from!).lerp(to!, 0.5);
    const { symbol, value, expected } = valuesOf(found.difference, this.store.value);
    text.element.textContent = `${symbol}: ${value} ≠ ${expected}`;
  }
}

interface Placing extends Units {
  isOver: boolean;
  /** Whether it says how far the two are apart. */
  isNamed: boolean;
}

/** A frame of the first and the one of the second, with a line between them where they differ. */
class Mark {
  readonly parts;
  #ours: Group;
  #theirs: Group;
  #line = rod(new Vector3(), new Vector3(), 1, colour("bad"));
  #names = [label("", "frame"), label("", "frame")] as const;
  #length: CSS2DObject = label("", "apart");

  constructor(private readonly unit: number) {
    [this.#ours, this.#theirs] = [triad(0.7 * unit, ["x", "z"]), triad(0.7 * unit, ["x", "z"])];
    this.#line.name = "frames apart";
    this.parts = [this.#ours, this.#theirs, this.#line, ...this.#names, this.#length];
  }

  /** @param base where the first one's base would be at the second. */
  place({ index, first, second, position, angle, meets }: Pair, chain: ShownChain, base: Matrix4, how: Placing): void {
    const ours = chain.model.link(chain.base).matrixWorld.clone().multiply(first);
    const wanted = base.clone().multiply(first);
    const theirs = base.clone().multiply(second);
    put(this.#ours, ours);
    put(this.#theirs, theirs);
    const [from, to] = [wanted, theirs].map((T) => new Vector3().setFromMatrixPosition(T));
    stretch(this.#line, from!, to!, this.unit * (how.isNamed ? THICK : THIN));
    this.#line.visible &&= !meets;
    const name = index === null ? t("Tip") : String(index);
    const isOne = how.isOver && meets;
    const [own, other] = this.#names;
    own.element.textContent = isOne ? `${name} = ${name}′` : name;
    other.element.textContent = `${name}′`;
    own.position.setFromMatrixPosition(ours);
    other.position.copy(to!);
    other.visible = !isOne;
    other.element.classList.toggle("bad", !meets);
    this.#length.visible = how.isNamed && !meets;
    this.#length.position.copy(from!).lerp(to!, 0.5);
    this.#length.element.textContent = `${name} ≠ ${name}′: ${apart(position, angle, how)}`;
  }
}

/** `3 mm, 0.2°`: what is not zero of the two. */
export function apart(position: number, angle: number, units: Units): string {
  return [measured(position, "length", units, 4), measured(angle, "angle", units, 4)].join(", ");
}

export function titleOf({ own, facts }: Second): string {
  const { model } = own.value;
  if (model?.name) return model.name;
  const convention = facts.value.tables?.second.dh.convention;
  return convention === "modified" ? t("Modified table") : t("Standard table");
}
