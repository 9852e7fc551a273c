/** The 3-D view: one scene, z up, drawn when something has changed and not otherwise. */

import {
  AmbientLight,
  Box3,
  DirectionalLight,
  GridHelper,
  Group,
  HemisphereLight,
  type Material,
  Mesh,
  type Object3D,
  PerspectiveCamera,
  Scene,
  Sphere,
  type Texture,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";

import type { RobotModel } from "../robot/model.ts";
import { colour } from "./colours.ts";
import type { Look } from "./looking.ts";
import { arrange } from "./placing.ts";

const DIRECTION = new Vector3(1.05, -1.35, 0.75).normalize();
const CELLS = 20;
/** Most pixels of the picture to one of the page, along each side. */
const FINEST = 2;
/** The same for software when nothing moves, and how long that must be, [ms]. */
const AT_REST = 2;
const REST = 250;

export class View {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  /** Length that suits marks on the robot on the screen, [m]. */
  unit = 0.1;
  #renderer: WebGLRenderer;
  #isSoftware: boolean;
  #rest = 0;
  #labels = new CSS2DRenderer();
  #model: RobotModel | null = null;
  #around: Sphere | null = null;
  #grid = new Group();
  #floor = { level: 0, cell: 0.1 };
  #asked = false;
  /** Where it is looked at from, where that has been chosen; else the whole robot is fitted. */
  #look: Look | null = null;
  /** Is told of each choice. */
  looked: (look: Look | null) => void = () => {};

  /** Throws where the browser has no WebGL. */
  constructor(host: HTMLElement) {
    this.#isSoftware = isDrawnBySoftware();
    this.#renderer = makeRenderer(!this.#isSoftware);
    this.#renderer.localClippingEnabled = true;
    this.#renderer.setPixelRatio(this.#isSoftware ? 1 : Math.min(window.devicePixelRatio, FINEST));
    this.canvas = this.#renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The robot in space. Arrow keys turn the view, plus and minus zoom.");
    this.#labels.domElement.className = "labels";
    this.#labels.domElement.setAttribute("aria-hidden", "true");
    host.append(this.canvas, this.#labels.domElement);
    this.camera.up.set(0, 0, 1);
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
    delete this.canvas.dataset["drawn"];
    this.scene.add(model.root);
    if (before && before !== model) dispose(before.root);
    this.settle();
  }

  /** The scene of the robot has got another size: a mesh has arrived, or another configuration is far away. */
  settle(): void {
    this.#aim();
    this.draw();
  }

  /** Look from there; null for the whole robot. */
  look(look: Look | null): void {
    if (look === this.#look) return;
    this.#look = look;
    this.settle();
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
      if (held) this.#look = this.#here();
      this.draw();
    });
    this.controls.addEventListener("end", () => {
      held = false;
      if (this.#look !== before) this.looked(this.#look);
    });
  }

  /** What is to be seen besides the robot, in the world; null for nothing. */
  surround(sphere: Sphere | null): void {
    this.#around = sphere;
    this.settle();
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

  #aim(direction = DIRECTION): void {
    if (!this.#model) return;
    const box = extent(this.#model);
    const size = Math.max(box.getSize(new Vector3()).length(), 0.05);
    // Meshes that arrive change the size a little; marks stay as they are until it has changed much.
    if (Math.abs(size * 0.09 - this.unit) > 0.15 * this.unit) this.unit = size * 0.09;
    const seen = new Sphere(box.getCenter(new Vector3()), size / 2);
    if (this.#around) seen.union(this.#around);
    const { center: centre, radius } = seen;
    const distance = (radius * 1.24) / Math.tan((this.camera.fov * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.camera.near = size / 200;
    this.camera.far = size * 60;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, distance);
    if (this.#look) {
      this.controls.target.set(...this.#look.at);
      this.camera.position.set(...this.#look.eye);
    }
    this.camera.updateProjectionMatrix();
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
    requestAnimationFrame(() => {
      this.#asked = false;
      if (this.#isSoftware) this.#smoothLater();
      this.#render();
    });
  }

  /** Draw now; `data-drawn` of the canvas then names the robot that is to be seen. */
  #render(): void {
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
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
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

function makeRenderer(antialias: boolean): WebGLRenderer {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", { alpha: true, depth: true, stencil: false, antialias });
  if (!context) throw new Error("no WebGL");
  return new WebGLRenderer({ canvas, context });
}

/** Whether no graphics card draws: then smooth edges and fine pixels cost much of the time of a picture. Some browsers
 * do not count that as a "major performance caveat", so that the renderer's name is asked too. */
function isDrawnBySoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!probe) return true;
  const named = probe.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = probe.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : probe.RENDERER);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name));
}

/** What the robot takes up: its links' origins, and the meshes that have arrived. */
function extent(model: RobotModel): Box3 {
  const box = new Box3().setFromObject(model.root);
  const point = new Vector3();
  for (const name of model.links) box.expandByPoint(point.setFromMatrixPosition(model.link(name).matrixWorld));
  return box;
}

function dispose(root: Object3D): void {
  root.removeFromParent();
  root.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    node.geometry.dispose();
    for (const material of [node.material].flat() as (Material & { map?: Texture | null })[]) {
      material.map?.dispose();
      material.dispose();
    }
  });
}
