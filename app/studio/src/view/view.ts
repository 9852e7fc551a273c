/** The 3-D view: one scene, z up, drawn when something has changed and not otherwise. */

import {
  AmbientLight,
  type Box3,
  type Camera,
  DirectionalLight,
  GridHelper,
  Group,
  HemisphereLight,
  Mesh,
  OrthographicCamera,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  type WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";

import type { RobotModel } from "../robot/model.ts";
import { t } from "../texts/index.ts";
import { colour } from "./colours.ts";
import type { Look } from "./looking.ts";
import { arrange } from "./placing.ts";
import { acrossOf, dispose, extent, isDrawnBySoftware, makeRenderer } from "./stage.ts";

const DIRECTION = new Vector3(1.05, -1.35, 0.75).normalize();
/** How much is seen of the height at a distance of 1: twice the tangent of half the angle, [°]. */
export const FIELD = 35;
const HALF = Math.tan((FIELD * Math.PI) / 360);
const CELLS = 20;
/** Most pixels of the picture to one of the page, along each side. */
const FINEST = 2;
/** The same for software when nothing moves, and how long that must be, [ms]. */
const AT_REST = 2;
const REST = 250;
/** How long a picture waits for an answer that changes it too, [ms]: less than a frame of most screens. */
const PATIENCE = 15;

export class View {
  readonly scene = new Scene();
  #central = new PerspectiveCamera(FIELD, 1, 0.01, 100);
  #parallel = new OrthographicCamera();
  /** Whichever of the two draws: as the eye sees, or as drawings are made. */
  camera: PerspectiveCamera | OrthographicCamera = this.#central;
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  /** Length that suits marks on the robot on the screen, [m]. */
  unit = 0.1;
  /** What has handles of its own in the picture; one with an axis has the pointer. */
  readonly handles = new Set<{ axis: string | null; enabled: boolean; camera: Camera }>();
  /** Whether a press chooses a point, and moves nothing. */
  isPicking = false;
  #renderer: WebGLRenderer;
  #isSoftware: boolean;
  #rest = 0;
  #labels = new CSS2DRenderer();
  #model: RobotModel | null = null;
  /** From where the whole robot is looked at. */
  #usual = DIRECTION;
  #around = new Map<string, Sphere>();
  #grid = new Group();
  #floor = { level: 0, cell: 0.1 };
  #asked = false;
  #heldUntil = 0;
  /** Where it is looked at from, where that has been chosen; else the whole robot is fitted. */
  #look: Look | null = null;
  #isDragged = false;
  /** Whether the camera would have moved but for what is dragged. */
  #isLate = false;
  /** Is told of each choice. */
  looked: (look: Look | null) => void = () => {};
  /** What is to be done right before each picture: what depends on the camera, or is drawn beforehand. `isMoving`: software
   * draws it, and in haste. */
  readonly before = new Set<(renderer: WebGLRenderer, isMoving: boolean) => void>();

  /** Throws where the browser has no WebGL. */
  constructor(host: HTMLElement) {
    this.#isSoftware = isDrawnBySoftware();
    this.#renderer = makeRenderer(!this.#isSoftware);
    this.#renderer.localClippingEnabled = true;
    this.#renderer.setPixelRatio(this.#isSoftware ? 1 : Math.min(window.devicePixelRatio, FINEST));
    this.canvas = this.#renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", t("The robot in space. Arrow keys turn the view, plus and minus zoom."));
    this.#labels.domElement.className = "labels";
    this.#labels.domElement.setAttribute("aria-hidden", "true");
    host.append(this.canvas, this.#labels.domElement);
    for (const camera of [this.#central, this.#parallel]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.#listen();
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    this.canvas.addEventListener("dblclick", () => this.fit());
    this.#light();
    this.scene.add(this.#grid);
    new ResizeObserver(() => this.#resize(host)).observe(host);
    this.#resize(host);
    this.dress();
  }

  /** Put a robot in the place of the one before. */
  show(model: RobotModel): void {
    const before = this.#model;
    this.#model = model;
    this.#usual = acrossOf(model, DIRECTION) ?? DIRECTION;
    delete this.canvas.dataset["drawn"];
    this.scene.add(model.root);
    if (before && before !== model) dispose(before.root);
    this.settle();
  }

  /** The scene of the robot has got another size: a mesh has arrived, or another configuration is far away. */
  settle(): void {
    this.#isLate = this.#isDragged;
    this.#aim();
    this.draw();
  }

  /** Look from there; null for the whole robot. */
  look(look: Look | null): void {
    if (look === this.#look) return;
    this.#look = look;
    this.settle();
  }

  /** Whether something in the picture is dragged: the camera then stays, though what is to be seen grows or shrinks. */
  get isDragged(): boolean {
    return this.#isDragged;
  }

  set isDragged(isDragged: boolean) {
    this.#isDragged = isDragged;
    this.controls.enabled = !isDragged;
    if (!isDragged && this.#isLate) this.settle();
  }

  /** Keep the camera where a hand has put it, also while it is held: meshes may arrive meanwhile. */
  #listen(): void {
    let held = false;
    let before: Look | null = null;
    this.controls.addEventListener("start", () => {
      held = true;
      before = this.#look;
    });
    this.controls.addEventListener("change", () => {
      this.#frame();
      if (held) this.#look = this.#here();
      this.draw();
    });
    this.controls.addEventListener("end", () => {
      held = false;
      if (this.#look !== before) this.looked(this.#look);
    });
  }

  /** What is to be seen besides the robot, in the world, by who draws it; null for nothing. */
  surround(by: string, sphere: Sphere | null): void {
    if (sphere) this.#around.set(by, sphere);
    else this.#around.delete(by);
    this.settle();
  }

  /** Draw in parallel projection, or as the eye sees; from the same place, what is looked at as large as before. */
  project(isParallel: boolean): void {
    const next = isParallel ? this.#parallel : this.#central;
    if (next === this.camera) return;
    next.position.copy(this.camera.position);
    next.quaternion.copy(this.camera.quaternion);
    this.camera = this.controls.object = next;
    for (const handle of this.handles) handle.camera = next;
    this.settle();
  }

  /** How much of the world is in the picture: in parallel projection as much as at the distance of what is looked at. */
  #frame(): void {
    const { position, zoom } = this.#parallel;
    if (this.camera === this.#parallel) {
      const { target } = this.controls;
      // The camera's controls enlarge; here that is to come nearer, as in the other projection and in a link.
      if (zoom !== 1) position.sub(target).divideScalar(zoom).add(target);
      const half = position.distanceTo(target) * HALF;
      Object.assign(this.#parallel, { zoom: 1, top: half, bottom: -half });
      Object.assign(this.#parallel, { left: -half * this.#central.aspect, right: half * this.#central.aspect });
    }
    this.camera.updateProjectionMatrix();
  }

  /** Where the right of the picture is, seen from the usual side; in the world, level, of length 1. */
  get right(): Vector3 {
    return new Vector3().crossVectors(this.camera.up, this.#usual).normalize();
  }

  /** Look at the whole robot from the usual side. */
  fit(): void {
    this.#look = null;
    this.settle();
    this.looked(null);
  }

  /** Look at the whole robot from a direction. */
  from(direction: Vector3): void {
    this.#look = null;
    this.#aim(direction);
    this.draw();
    this.#look = this.#here();
    this.looked(this.#look);
  }

  #aim(direction = this.#usual): void {
    if (!this.#model) return;
    const box = extent(this.#model);
    const size = Math.max(box.getSize(new Vector3()).length(), 0.05);
    // Meshes that arrive change the size a little; marks stay as they are until it has changed much.
    if (Math.abs(size * 0.09 - this.unit) > 0.15 * this.unit) this.unit = size * 0.09;
    const seen = new Sphere(box.getCenter(new Vector3()), size / 2);
    for (const sphere of this.#around.values()) seen.union(sphere);
    const { center: centre, radius } = seen;
    const distance = (radius * 1.24) / HALF / Math.min(1, this.#central.aspect);
    // In parallel projection what is behind the camera is seen too.
    this.#central.near = size / 200;
    this.#central.far = this.#parallel.far = size * 60;
    this.#parallel.near = -this.#parallel.far;
    if (this.#look) {
      this.controls.target.set(...this.#look.at);
      this.camera.position.set(...this.#look.eye);
    } else if (!this.#isDragged) {
      this.controls.target.copy(centre);
      this.camera.position.copy(centre).addScaledVector(direction, distance);
    }
    this.#frame();
    this.controls.update();
    this.#lay(box, size);
  }

  /** Take the colours of the page's theme. */
  dress(): void {
    this.scene.background = colour("view");
    this.#lay(null, 0);
    this.draw();
  }

  /** Draw once before the next frame of the screen. */
  draw(): void {
    if (this.#asked) return;
    this.#asked = true;
    const render = (): void => {
      if (performance.now() < this.#heldUntil) {
        requestAnimationFrame(render);
        return;
      }
      this.#asked = false;
      if (this.#isSoftware) this.#smoothLater();
      this.#render();
    };
    requestAnimationFrame(render);
  }

  /** Draw nothing before an answer that comes at once, so that what was moved and what follows it are in one picture:
   * a picture that is drawn by software would keep the answer waiting. */
  hold(answer: Promise<unknown>): void {
    const until = (this.#heldUntil = performance.now() + PATIENCE);
    void answer.finally(() => {
      if (this.#heldUntil === until) this.#heldUntil = 0;
    });
  }

  /** How high the floor is, [m]. */
  get level(): number {
    return this.#floor.level;
  }

  #prepare(): void {
    const isMoving = this.#isSoftware && this.#renderer.getPixelRatio() < AT_REST;
    for (const prepare of this.before) prepare(this.#renderer, isMoving);
  }

  /** Draw now; `data-drawn` of the canvas then names the robot that is to be seen. */
  #render(): void {
    this.#prepare();
    this.#renderer.render(this.scene, this.camera);
    this.#labels.render(this.scene, this.camera);
    arrange(this.#labels.domElement);
    if (this.#model) this.canvas.dataset["drawn"] = this.#model.title;
  }

  /** What software draws is coarse while it moves, and has smooth edges when it has come to rest. */
  #smoothLater(): void {
    clearTimeout(this.#rest);
    if (this.#renderer.getPixelRatio() !== 1) this.#renderer.setPixelRatio(1);
    this.#rest = window.setTimeout(() => {
      this.#renderer.setPixelRatio(AT_REST);
      this.#render();
    }, REST);
  }

  /** What is drawn, as a PNG; without the labels, which are elements above it. */
  picture(): Promise<Blob> {
    // What has been drawn is gone with the frame of the screen.
    this.#renderer.render(this.scene, this.camera);
    return new Promise((done, fail) =>
      this.canvas.toBlob((png) => (png ? done(png) : fail(new Error("the browser made no picture")))),
    );
  }

  /** Draw what is to be seen now, without the labels, as large as a context's canvas. */
  paint(context: CanvasRenderingContext2D): void {
    if (this.#isSoftware) this.#smoothLater();
    this.#prepare();
    this.#renderer.render(this.scene, this.camera);
    context.drawImage(this.canvas, 0, 0, context.canvas.width, context.canvas.height);
  }

  /** Geometries that the graphics card holds. */
  memory(): number {
    return this.#renderer.info.memory.geometries;
  }

  /** Meshes of the robot that are on the screen, primitives included. */
  countMeshes(): number {
    let count = 0;
    this.#model?.root.traverse((node) => (count += node instanceof Mesh ? 1 : 0));
    return count;
  }

  #light(): void {
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(2, -3, 5);
    const fill = new DirectionalLight(0xffffff, 0.5);
    fill.position.set(-3, 2, 1);
    this.scene.add(new HemisphereLight(0xffffff, 0xb8b8c0, 1.1), new AmbientLight(0xffffff, 0.25), key, fill);
  }

  /** The grid on the floor: where z is 0, or at the feet of what reaches below. */
  #lay(box: Box3 | null, size: number): void {
    if (box) {
      const decade = 10 ** Math.floor(Math.log10(size / 4));
      const cell = [1, 2, 5, 10].map((step) => step * decade).find((step) => step >= size / 8) ?? decade;
      this.#floor = { level: box.min.z < -0.02 * size ? box.min.z : 0, cell };
    }
    for (const grid of this.#grid.children as GridHelper[]) grid.dispose();
    this.#grid.clear();
    const width = this.#floor.cell * CELLS;
    const grid = new GridHelper(width, CELLS, colour("grid-strong"), colour("grid"));
    grid.rotation.x = Math.PI / 2;
    grid.position.z = this.#floor.level;
    this.#grid.add(grid);
  }

  #resize(host: HTMLElement): void {
    const { clientWidth: width, clientHeight: height } = host;
    if (!width || !height) return;
    this.#central.aspect = width / height;
    this.#renderer.setSize(width, height);
    this.#labels.setSize(width, height);
    this.settle();
    this.#render(); // another size has wiped the canvas, which would stay blank until the next frame
  }

  #key(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, -1],
      ArrowDown: [0, 1],
    };
    const zooms: Record<string, number> = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 };
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (event.key === "Home") {
      this.fit();
    } else if (zooms[event.key]) {
      offset.multiplyScalar(zooms[event.key]!);
    } else if (turns[event.key]) {
      const [around, over] = turns[event.key]!;
      const polar = Math.acos(offset.z / offset.length()) + over * 0.1;
      offset.applyAxisAngle(this.camera.up, around * 0.12);
      if (polar > 0.05 && polar < Math.PI - 0.05) {
        const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
        offset.applyAxisAngle(side, over * 0.1);
      }
    } else {
      return;
    }
    event.preventDefault();
    if (event.key === "Home") return;
    this.camera.position.copy(this.controls.target).add(offset);
    this.#frame();
    this.controls.update();
    this.draw();
    this.#look = this.#here();
    this.looked(this.#look);
  }

  /** Where the camera stands, to so many digits as a link has. */
  #here(): Look {
    const [eye, at] = [this.camera.position, this.controls.target].map(
      (point) => point.toArray().map((value) => Number(value.toPrecision(5))) as [number, number, number],
    );
    return { eye: eye!, at: at! };
  }
}
