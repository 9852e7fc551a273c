/** How far two points of the picture are apart: origins of links, or points of what is drawn. */

import { Group, Mesh, MeshBasicMaterial, type Object3D, SphereGeometry, type Vector2, Vector3 } from "three";

import { shownChain } from "../robot/chain.ts";
import type { RobotModel } from "../robot/model.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import { button, element } from "../ui/dom.ts";
import { column, measured, type Units, UNITS } from "../ui/quantity.ts";
import { pointerOf, project, sightThrough } from "./aiming.ts";
import { colour } from "./colours.ts";
import { Length } from "./dimensions.ts";
import { clear, overlay } from "./shapes.ts";
import type { View } from "./view.ts";

/** Nearer than this to a link's origin, the origin is meant, [px]. */
const NEAR = 12;
/** A press that moves farther turns the picture, [px]. */
const STILL = 4;
const DECIMALS = 4;
const DOT = new SphereGeometry(1, 16, 12);
const ENDS = ["from", "to"] as const;
type End = (typeof ENDS)[number];

/** A point that goes with a thing. */
interface Spot {
  on: Object3D;
  local: Vector3;
  /** The link whose origin it is; null for another point. */
  link: string | null;
}

export class Measuring {
  readonly host: HTMLElement;
  #group = new Group();
  #line: Length | null = null;
  #spots: Record<End, Spot | null> = { from: null, to: null };
  #selects: Record<End, HTMLSelectElement>;
  #result = element("output", { class: "numbers", "data-measured": "" });
  #pressed: Vector2 | null = null;

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
  ) {
    this.#selects = { from: this.#select("from"), to: this.#select("to") };
    this.host = element(
      "div",
      { class: "measure", role: "group", "aria-label": t("Measure"), hidden: true },
      element("span", { class: "muted small" }, t("Choose two points in the picture, or two frames.")),
      element(
        "span",
        { class: "bar" },
        this.#selects.from,
        "→",
        this.#selects.to,
        button(t("Clear"), () => this.#clear()),
      ),
      this.#result,
    );
    view.scene.add(this.#group);
    view.before.add(() => this.#place());
    view.canvas.addEventListener("pointerdown", (event) => (this.#pressed = pointerOf(view, event)));
    view.canvas.addEventListener("pointerup", (event) => this.#released(pointerOf(view, event)));
    store.watch(["model"], () => this.#clear());
    store.watch(["unit", "dark", "meshes", ...UNITS], () => this.#draw());
    store.watch(["positions", "base", "tip"], () => this.#say());
  }

  get isOn(): boolean {
    return this.view.isPicking;
  }

  flip(): void {
    this.view.isPicking = !this.isOn;
    this.host.hidden = !this.isOn;
    this.#clear();
    if (this.isOn) this.#selects.from.focus();
  }

  #select(end: End): HTMLSelectElement {
    const select = element("select", {
      class: "select plain",
      "aria-label": end === "from" ? t("Measure from") : t("Measure to"),
      onchange: () => this.#take(end, select.value === "" ? null : originOf(this.store.value.model!, select.value)),
    });
    return select;
  }

  #clear(): void {
    this.#spots = { from: null, to: null };
    const links = this.store.value.model?.links ?? [];
    for (const end of ENDS) {
      const first = element("option", { value: "" }, end === "from" ? t("From …") : t("To …"));
      const others = links.map((link) => element("option", { value: link }, link));
      this.#selects[end].replaceChildren(first, ...others);
    }
    this.#draw();
  }

  #released(at: Vector2): void {
    const pressed = this.#pressed;
    this.#pressed = null;
    if (!this.isOn || !pressed || pressed.distanceTo(at) > STILL) return;
    const spot = this.#spotAt(at);
    // A third point begins anew.
    if (spot && this.#spots.from && this.#spots.to) this.#clear();
    if (spot) this.#take(this.#spots.from ? "to" : "from", spot);
  }

  #take(end: End, spot: Spot | null): void {
    this.#spots[end] = spot;
    const select = this.#selects[end];
    for (const option of [...select.options].filter(({ value }) => value === "*")) option.remove();
    if (spot && spot.link === null) select.append(element("option", { value: "*" }, t("A point")));
    select.value = spot ? (spot.link ?? "*") : "";
    this.#draw();
  }

  /** The origin of a link that the pointer is near to, or the point of a surface that is seen there. */
  #spotAt(pointer: Vector2): Spot | null {
    const { model } = this.store.value;
    if (!model) return null;
    const origins = model.links.map((link) => {
      const spot = originOf(model, link);
      return { spot, px: project(this.view, worldOf(spot)).distanceTo(pointer) };
    });
    const nearest = origins.reduce((best, other) => (other.px < best.px ? other : best), origins[0]!);
    if (nearest.px < NEAR) return nearest.spot;
    const hits = sightThrough(this.view, pointer).intersectObject(this.view.scene);
    const hit = hits.find(({ object }) => object instanceof Mesh && isSeen(object) && isSurface(object));
    return hit ? { on: hit.object, local: hit.object.worldToLocal(hit.point.clone()), link: null } : null;
  }

  #draw(): void {
    clear(this.#group);
    this.#line = null;
    const { from, to } = this.#spots;
    const tone = colour("accent");
    for (const _ of [from, to].filter(Boolean)) this.#group.add(new Mesh(DOT, overlay(tone)));
    if (from && to) {
      this.#line = new Length("measured", this.store.value.unit, tone);
      this.#group.add(this.#line.group, this.#line.label);
      this.#line.show("plain", tone);
    }
    this.#place();
    this.#say();
    this.view.draw();
  }

  #place(): void {
    const spots = ENDS.flatMap((end) => this.#spots[end] ?? []).map(worldOf);
    const size = this.store.value.unit * 0.06;
    for (const [i, at] of spots.entries()) {
      this.#group.children[i]!.position.copy(at);
      this.#group.children[i]!.scale.setScalar(size);
    }
    if (!this.#line) return;
    const text = lengthText(spots[0]!.distanceTo(spots[1]!), this.store.value);
    this.#line.place(spots[0]!, spots[1]!, text, text);
    this.#line.face(this.view.camera.getWorldDirection(new Vector3()), spots[0]!);
  }

  /** The distance, and its parts along the axes of the chain's base; `data-measured` has them to the last digit. */
  #say(): void {
    const { from, to } = this.#spots;
    const units = this.store.value;
    const chain = shownChain(units);
    this.#result.textContent = "";
    this.#result.dataset["measured"] = "";
    if (!from || !to || !chain) return;
    const T_base_world = chain.model.link(chain.base).matrixWorld.clone().invert();
    const [start, end] = [from, to].map((spot) => worldOf(spot).applyMatrix4(T_base_world));
    const way = end!.sub(start!);
    const parts = (["x", "y", "z"] as const).map((axis) => `Δ${axis} ${column(way[axis], "length", units, DECIMALS)}`);
    this.#result.textContent = t("{way} · {parts} in {base}", {
      way: lengthText(way.length(), units),
      parts: parts.join(" "),
      base: chain.base,
    });
    this.#result.dataset["measured"] = JSON.stringify([way.length(), ...way.toArray()]);
  }
}

function originOf(model: RobotModel, link: string): Spot {
  return { on: model.link(link), local: new Vector3(), link };
}

function worldOf({ on, local }: Spot): Vector3 {
  return on.localToWorld(local.clone());
}

/** Whether a mesh is in the picture: a ray meets hidden ones too, such as the planes that handles are dragged along. */
function isSeen(mesh: Mesh): boolean {
  let isShown = mesh.visible && [mesh.material].flat().every(({ visible }) => visible);
  mesh.traverseAncestors(({ visible }) => (isShown &&= visible));
  return isShown;
}

/** Whether a mesh is a thing, and not a mark on one. */
function isSurface({ material }: Mesh): boolean {
  return [material].flat().every((made) => !(made instanceof MeshBasicMaterial && !made.depthTest));
}

function lengthText(length: number, units: Units): string {
  return measured(length, "length", units, DECIMALS);
}
