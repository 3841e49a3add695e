// Particles in three dimensions or two: points of their true size, coloured by a table, cut by a plane.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { ColourMap } from "./colours";
import { css } from "./dom";

const vertexShader = /* glsl */ `
attribute float value;
attribute float plain;
uniform float low, high, diameter, pixels, clipAt, clipSide, opened;
uniform int chosen, clipAxis;
uniform vec3 boxLow, boxHigh;
uniform float wallDepth;
varying float at, isPlain, isChosen;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * seen;
  float size = diameter * pixels * projectionMatrix[1][1] / (opened > 0.0 ? -seen.z : 1.0) * 0.5;
  at = high > low ? (value - low) / (high - low) : 0.5;
  isPlain = plain + (value == value ? 0.0 : 1.0);
  isChosen = gl_VertexID == chosen ? 1.0 : 0.0;
  gl_PointSize = max(size, 1.5) * (isChosen > 0.5 ? 1.6 : 1.0) + isChosen * 6.0;
  if (isChosen > 0.5) gl_Position.z = -0.999 * gl_Position.w;  // before all others, so that it is found
  bool front = false, behind = false;
  for (int k = 0; k < 3; ++k) {
    if (position[k] > boxHigh[k] - wallDepth) { if (cameraPosition[k] > boxHigh[k]) front = true; else behind = true; }
    if (position[k] < boxLow[k] + wallDepth) { if (cameraPosition[k] < boxLow[k]) front = true; else behind = true; }
  }
  if (wallDepth > 0.0 && plain > 0.5 && front && !behind) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (clipAxis >= 0 && (position[clipAxis] - clipAt) * clipSide > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragmentShader = /* glsl */ `
uniform sampler2D table;
uniform vec3 plainColour;
uniform float shade;
varying float at, isPlain, isChosen;
void main() {
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float r2 = dot(place, place);
  if (r2 > 1.0) discard;
  if (isChosen > 0.5 && r2 > 0.45) { gl_FragColor = vec4(r2 > 0.72 ? vec3(1.0) : vec3(0.85, 0.0, 0.55), 1.0); return; }
  vec3 colour = isPlain > 0.5 ? plainColour : texture2D(table, vec2(clamp(at, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb;
  float facing = sqrt(1.0 - r2);
  float light = 0.55 + 0.45 * clamp(0.85 * facing - 0.35 * place.y - 0.2 * place.x, 0.0, 1.0);
  gl_FragColor = vec4(colour * mix(1.0, light, shade), 1.0);
}`;

export interface SceneSetup {
  dimensions: number;
  low: number[];
  high: number[];
  spacing: number;
  up: three.Vector3;
}

export class Scene {
  readonly canvas: HTMLCanvasElement;
  private renderer: three.WebGLRenderer;
  private scene = new three.Scene();
  private camera: three.PerspectiveCamera | three.OrthographicCamera;
  private controls: OrbitControls;
  private geometry = new three.BufferGeometry();
  private material: three.ShaderMaterial;
  private box: three.LineSegments;
  private pending = false;
  private sized = false;
  private centre: three.Vector3;
  private radius: number;

  constructor(private parent: HTMLElement, private setup: SceneSetup) {
    this.renderer = new three.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.canvas = this.renderer.domElement;
    parent.append(this.canvas);
    const low = new three.Vector3(...(setup.low as [number, number, number]));
    const high = new three.Vector3(...(setup.high as [number, number, number]));
    this.centre = low.clone().add(high).multiplyScalar(0.5);
    this.radius = Math.max(high.clone().sub(low).length() / 2, setup.spacing);
    const flat = setup.dimensions < 3;
    this.camera = flat ? new three.OrthographicCamera() : new three.PerspectiveCamera(35, 1, this.radius / 100, this.radius * 100);
    this.camera.up.copy(flat ? new three.Vector3(0, 1, 0) : setup.up);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.enableRotate = !flat;
    if (flat) this.controls.mouseButtons.LEFT = three.MOUSE.PAN;
    if (flat) this.controls.touches.ONE = three.TOUCH.PAN;
    this.controls.addEventListener("change", () => this.render());
    this.material = new three.ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: {
        low: { value: 0 }, high: { value: 1 }, diameter: { value: setup.spacing }, pixels: { value: 1 },
        clipAt: { value: 0 }, clipSide: { value: 1 }, clipAxis: { value: -1 }, chosen: { value: -1 },
        boxLow: { value: low }, boxHigh: { value: high }, wallDepth: { value: 0 },
        opened: { value: flat ? 0 : 1 }, table: { value: null }, plainColour: { value: new three.Color() }, shade: { value: flat ? 0.35 : 1 },
      },
    });
    const points = new three.Points(this.geometry, this.material);
    points.frustumCulled = false;
    this.scene.add(points);
    const edges = new three.EdgesGeometry(new three.BoxGeometry(...high.clone().sub(low).toArray()));
    this.box = new three.LineSegments(edges, new three.LineBasicMaterial());
    this.box.position.copy(this.centre);
    this.scene.add(this.box);
    this.theme();
    this.reset();
    new ResizeObserver(() => this.resize()).observe(parent);
  }

  theme(): void {
    const colour = (name: string) => new three.Color().setStyle(css(name), three.LinearSRGBColorSpace);
    this.renderer.setClearColor(new three.Color().setStyle(css("--scene")));
    (this.box.material as three.LineBasicMaterial).color.setStyle(css("--line"));
    this.material.uniforms.plainColour.value = colour("--wall");
    this.render();
  }

  setParticles(position: Float32Array, plain: Float32Array): void {
    this.geometry.setAttribute("position", new three.BufferAttribute(position, 3));
    this.geometry.setAttribute("plain", new three.BufferAttribute(plain, 1));
    this.geometry.setDrawRange(0, position.length / 3);
  }

  setValues(value: Float32Array): void {
    this.geometry.setAttribute("value", new three.BufferAttribute(value, 1));
  }

  setColours(map: ColourMap, low: number, high: number): void {
    const uniforms = this.material.uniforms;
    uniforms.table.value?.dispose();
    const texture = new three.DataTexture(map.rgba, 256, 1);
    texture.minFilter = texture.magFilter = three.LinearFilter;
    texture.needsUpdate = true;
    uniforms.table.value = texture;
    uniforms.low.value = low;
    uniforms.high.value = high;
  }

  /** Hides what lies beyond `at` along the axis (side 1), or before it (side -1); axis -1: nothing. */
  setClip(axis: number, at: number, side: number): void {
    Object.assign(this.material.uniforms.clipAxis, { value: axis });
    Object.assign(this.material.uniforms.clipAt, { value: at });
    Object.assign(this.material.uniforms.clipSide, { value: side });
  }

  /** Leaves out grey particles of the given depth behind those faces of the box that the viewer looks at; 0: none. */
  setOpenWalls(depth: number): void {
    this.material.uniforms.wallDepth.value = depth;
  }

  private opened(i: number): boolean {
    const depth = this.material.uniforms.wallDepth.value as number;
    if (depth <= 0 || this.geometry.getAttribute("plain").getX(i) === 0) return false;
    const position = this.geometry.getAttribute("position");
    let front = false, behind = false;
    for (let k = 0; k < 3; ++k) {
      const at = position.getComponent(i, k), eye = this.camera.position.getComponent(k), { low, high } = this.setup;
      if (at > high[k] - depth) [front, behind] = eye > high[k] ? [true, behind] : [front, true];
      if (at < low[k] + depth) [front, behind] = eye < low[k] ? [true, behind] : [front, true];
    }
    return front && !behind;
  }

  setDiameter(diameter: number): void {
    this.material.uniforms.diameter.value = diameter;
  }

  choose(index: number): void {
    this.material.uniforms.chosen.value = index;
  }

  reset(): void {
    const away = this.setup.dimensions < 3 ? new three.Vector3(0, 0, 1) : this.viewDirection();
    this.camera.zoom = 1;
    this.camera.position.copy(this.centre).addScaledVector(away, this.radius * 3.4);
    this.controls.target.copy(this.centre);
    this.controls.update();
    this.resize();
    if (this.camera instanceof three.PerspectiveCamera) this.approach(this.camera, away);
    this.controls.update();
    this.render();
  }

  /** Goes so near that the corners of the box just fit. */
  private approach(camera: three.PerspectiveCamera, away: three.Vector3): void {
    const { low, high } = this.setup;
    let distance = this.radius * 3.4;
    for (let k = 0; k < 8; ++k) {
      camera.position.copy(this.centre).addScaledVector(away, distance);
      camera.updateMatrixWorld();
      let reach = 0;
      for (let c = 0; c < 8; ++c) {
        const corner = new three.Vector3(...[0, 1, 2].map((axis) => (c >> axis & 1 ? high : low)[axis]) as [number, number, number]).project(camera);
        reach = Math.max(reach, Math.abs(corner.x), Math.abs(corner.y));
      }
      distance = Math.max(distance * (0.5 + 0.5 * reach / 0.92), this.radius * 1.2);
    }
  }

  /** From the front, a little from the right and from above; the longest side of the box across. */
  private viewDirection(): three.Vector3 {
    const up = this.setup.up;
    const extent = this.setup.high.map((value, k) => (Math.abs(up.getComponent(k)) > 0.5 ? -1 : value - this.setup.low[k]));
    const across = extent.indexOf(Math.max(...extent));
    const right = new three.Vector3().setComponent(across, 1);
    const front = right.clone().cross(up).normalize();
    return front.multiplyScalar(1).addScaledVector(right, 0.35).addScaledVector(up, 0.4).normalize();
  }

  /** Turns (3-D) or shifts (2-D) the view; x to the right and y upwards, in steps. */
  nudge(x: number, y: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (this.setup.dimensions < 3) {
      const shift = new three.Vector3(x, y, 0).multiplyScalar((this.radius * 0.1) / this.camera.zoom);
      this.camera.position.add(shift);
      this.controls.target.add(shift);
    } else {
      const up = this.camera.up;
      offset.applyAxisAngle(up, 0.1 * x);
      const side = up.clone().cross(offset).normalize();
      const tilted = offset.clone().applyAxisAngle(side, -0.1 * y);
      const angle = tilted.angleTo(up);
      if (angle > 0.05 && angle < Math.PI - 0.05) offset.copy(tilted);
      this.camera.position.copy(this.controls.target).add(offset);
    }
    this.controls.update();
    this.render();
  }

  zoom(factor: number): void {
    if (this.camera instanceof three.OrthographicCamera) {
      this.camera.zoom *= factor;
      this.camera.updateProjectionMatrix();
    } else {
      this.camera.position.sub(this.controls.target).multiplyScalar(1 / factor).add(this.controls.target);
    }
    this.controls.update();
    this.render();
  }

  /** The particle nearest to the viewer under a place of the canvas (CSS pixels), or -1. */
  pick(x: number, y: number): number {
    const position = this.geometry.getAttribute("position");
    if (!position) return -1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { clipAxis, clipAt, clipSide, diameter } = this.material.uniforms;
    const view = this.camera.matrixWorldInverse.clone().premultiply(this.camera.projectionMatrix);
    const point = new three.Vector4();
    let found = -1, nearest = Infinity;
    for (let i = 0; i < position.count; ++i) {
      point.set(position.getX(i), position.getY(i), position.getZ(i), 1);
      const axis = clipAxis.value as number;
      if (axis >= 0 && (point.getComponent(axis) - clipAt.value) * clipSide.value > 0) continue;
      if (this.opened(i)) continue;
      point.applyMatrix4(view);
      if (point.w <= 0) continue;
      const dx = ((point.x / point.w + 1) / 2) * width - x, dy = ((1 - point.y / point.w) / 2) * height - y;
      const radius = Math.max(4, (diameter.value * height * this.camera.projectionMatrix.elements[5]) / point.w / 4);
      const depth = point.z / point.w + (dx * dx + dy * dy) / (radius * radius) * 1e-3;
      if (dx * dx + dy * dy < radius * radius && depth < nearest) [found, nearest] = [i, depth];
    }
    return found;
  }

  render(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => this.draw());
  }

  draw(): void {
    this.pending = false;
    this.material.uniforms.pixels.value = this.renderer.getDrawingBufferSize(new three.Vector2()).y;
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const width = Math.max(1, this.parent.clientWidth), height = Math.max(1, this.parent.clientHeight);
    this.renderer.setSize(width, height);
    const aspect = width / height;
    if (this.camera instanceof three.OrthographicCamera) {
      const [sx, sy] = [0, 1].map((k) => this.setup.high[k] - this.setup.low[k] + 2 * this.setup.spacing);
      const half = 0.52 * Math.max(sy, sx / aspect);
      Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: -1e6 * this.radius, far: 1e6 * this.radius });
    } else {
      this.camera.aspect = aspect;
      this.camera.fov = aspect > 1.3 ? 35 : (2 * Math.atan((Math.tan((35 * Math.PI) / 360) * 1.3) / aspect) * 180) / Math.PI;
    }
    this.camera.updateProjectionMatrix();
    this.render();
    if (this.sized || this.parent.clientWidth === 0) return;
    this.sized = true;
    this.reset();  // now that the room is known
  }
}
