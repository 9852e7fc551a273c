/** A soft shadow on the floor below the robot: darkest where it touches, fading with the height. Made anew only when the
 * robot has moved; where software draws, only what is at rest has it. */

import {
  CustomBlending,
  DoubleSide,
  MaxEquation,
  Mesh,
  MeshBasicMaterial,
  NoBlending,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  Vector2,
  Vector3,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";

import type { RobotModel } from "../robot/model.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { colour } from "./colours.ts";
import { extent } from "./stage.ts";
import type { View } from "./view.ts";

/** The layer of what casts it. */
const CASTING = 1;
/** Pixels along a side. */
const FINE = 256;
/** Shares of the robot's size: how far up it fades to nothing, how soft its edge is, and how far above the floor it lies,
 * so that the lines of the grid do not come through. */
const FADES = 0.8;
const SOFT = 0.03;
const ABOVE = 1e-3;

/** How dark, by the height above the floor; of things above each other the lowest. */
const HEIGHTS = {
  vertexShader: `varying float height;
    void main() {
      vec4 place = modelMatrix * vec4(position, 1.0);
      height = place.z;
      gl_Position = projectionMatrix * viewMatrix * place;
    }`,
  fragmentShader: `uniform float level, reach;
    varying float height;
    void main() {
      float near = clamp(1.0 - (height - level) / reach, 0.0, 1.0);
      gl_FragColor = vec4(near * near);
    }`,
};
/** A mean along a line, of Gaussian weights. */
const BLUR = {
  vertexShader: `varying vec2 at;
    void main() {
      at = uv;
      gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
    }`,
  fragmentShader: `uniform sampler2D source;
    uniform vec2 along;
    varying vec2 at;
    void main() {
      vec4 sum = vec4(0.0);
      float total = 0.0;
      for (int i = -6; i <= 6; i += 1) {
        float x = float(i) / 3.0;
        float weight = exp(-0.5 * x * x);
        sum += weight * texture2D(source, at + x * along);
        total += weight;
      }
      gl_FragColor = sum / total;
    }`,
};

/** Keep it as the robot stands, from now on. */
export function castShadow(view: View, store: Store<State>): void {
  const shadow = new Shadow();
  view.scene.add(shadow.plane);
  let isMade = false;
  store.watch(["model", "positions", "meshes", "unit"], () => {
    isMade = false;
    view.draw();
  });
  store.watch(["dark"], () => shadow.plane.material.color.copy(colour("shadow")));
  view.before.add((renderer, isMoving) => {
    const { model } = store.value;
    if (!isMade && model && !isMoving) shadow.make(renderer, view.scene, model, view.level);
    isMade ||= !isMoving;
    shadow.plane.visible = !isMoving && model !== null;
  });
}

class Shadow {
  readonly plane = new Mesh(
    new PlaneGeometry(),
    new MeshBasicMaterial({ transparent: true, depthWrite: false, opacity: 0.7 }),
  );
  /** What is drawn, and the same softened along one side. */
  #drawn = new WebGLRenderTarget(FINE, FINE);
  #between = new WebGLRenderTarget(FINE, FINE, { depthBuffer: false });
  #above = new OrthographicCamera();
  #heights = new ShaderMaterial({
    ...HEIGHTS,
    uniforms: { level: { value: 0 }, reach: { value: 1 } },
    side: DoubleSide,
    blending: CustomBlending,
    blendEquation: MaxEquation,
    depthTest: false,
  });
  #blur = new ShaderMaterial({
    ...BLUR,
    uniforms: { source: { value: null }, along: { value: new Vector2() } },
    blending: NoBlending,
    depthTest: false,
  });
  #sheet = new Scene().add(new Mesh(new PlaneGeometry(), this.#blur));

  constructor() {
    this.plane.name = "shadow";
    this.plane.raycast = () => {}; // nothing to take hold of, or to measure
    this.plane.renderOrder = -1;
    this.plane.material.alphaMap = this.#drawn.texture;
    this.#above.layers.set(CASTING);
    const [sheet] = this.#sheet.children;
    sheet!.layers.set(CASTING);
    sheet!.frustumCulled = false;
  }

  /** Draw it anew, for a robot as it stands on a floor of that height. */
  make(renderer: WebGLRenderer, scene: Scene, model: RobotModel, level: number): void {
    const box = extent(model);
    const [size, centre] = [box.getSize(new Vector3()), box.getCenter(new Vector3())];
    const tall = size.length();
    const soft = tall * SOFT;
    const half = Math.max(size.x, size.y) / 2 + 3 * soft;
    this.plane.position.set(centre.x, centre.y, level + tall * ABOVE);
    this.plane.scale.setScalar(2 * half);
    Object.assign(this.#above, { left: -half, right: half, top: half, bottom: -half, near: 0, far: 3 * tall });
    this.#above.position.set(centre.x, centre.y, box.max.z + tall);
    this.#above.updateProjectionMatrix();
    this.#heights.uniforms["level"]!.value = level;
    this.#heights.uniforms["reach"]!.value = tall * FADES;
    model.root.traverse((node) => node instanceof Mesh && node.layers.enable(CASTING));
    this.#paint(renderer, scene, soft / (2 * half));
  }

  #paint(renderer: WebGLRenderer, scene: Scene, soft: number): void {
    const { background } = scene;
    Object.assign(scene, { background: null, overrideMaterial: this.#heights });
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(this.#drawn);
    renderer.render(scene, this.#above);
    Object.assign(scene, { background, overrideMaterial: null });
    for (const [from, to, x, y] of [
      [this.#drawn, this.#between, soft, 0],
      [this.#between, this.#drawn, 0, soft],
    ] as const) {
      this.#blur.uniforms["source"]!.value = from.texture;
      (this.#blur.uniforms["along"]!.value as Vector2).set(x, y);
      renderer.setRenderTarget(to);
      renderer.render(this.#sheet, this.#above);
    }
    renderer.setRenderTarget(null);
    renderer.setClearColor(0, 1);
  }
}
