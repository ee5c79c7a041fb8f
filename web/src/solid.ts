// The sampled states of a verdict as a body over (x, y, heading), cut at the slider's heading.
import { BufferAttribute, BufferGeometry, CanvasTexture, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial,
  NearestFilter, PerspectiveCamera, Plane, PlaneGeometry, Scene, Sprite, SpriteMaterial, SRGBColorSpace, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { oneOf } from "./choices";
import { byId, cssVariable, el, headingWords, pixelRatio } from "./dom";
import { obstacleColor, verdictsOfKind, type VerdictLayers } from "./layers";
import type { GridLines } from "./overlay";
import type { PageRecord } from "./record";
import { boundary } from "./solid_mesh";
import { tube_color } from "./tube_chart";

const most_across = 128;
const height = 0.62;  // of the longer side of the map

const lowest_view = 0.49 * Math.PI;  // from the vertical: never from below the floor

const body_names = ["reach", "fail", "undecided"] as const;  // in the order of share_kinds

class Solid {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.01, 20);
  private readonly controls: OrbitControls;
  private readonly cutting = new Plane(new Vector3(0, 0, -1), height);
  private readonly slice: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly floor: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private kind = 0;
  private readonly marks: (LineSegments | Sprite)[] = [];
  private body: Mesh<BufferGeometry, MeshBasicMaterial> | null = null;
  private outline: LineSegments | null = null;
  private readonly width: number;
  private readonly depth: number;
  private readonly colors: string[];
  private asked = false;
  private turned = false;  // by hand: then the view is left alone

  constructor(private readonly box: HTMLElement, private readonly record: PageRecord, private readonly layers: VerdictLayers, private heading: number) {
    const { nx, ny } = record.verdicts!;
    this.width = nx / Math.max(nx, ny);
    this.depth = ny / Math.max(nx, ny);
    this.colors = record.styles.verdict.map((style) => style.ground);
    this.colors[record.codes.obstacle] = obstacleColor(record);
    this.colors[record.codes.target] = record.styles.goal_pattern;
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.setPixelRatio(pixelRatio());
    this.renderer.localClippingEnabled = true;
    this.renderer.domElement.setAttribute("aria-hidden", "true");
    box.append(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-1.05, -1.78, 1.4);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.set(0, 0, 0.4 * height);
    this.controls.enableZoom = false;  // the wheel scrolls the page until the view has the focus
    this.controls.maxPolarAngle = lowest_view;
    this.controls.update();
    this.controls.addEventListener("change", () => this.redraw());
    this.controls.addEventListener("start", () => { this.turned = true; });
    this.slice = this.cellsPlane();
    this.floor = this.cellsPlane();
    this.floor.position.z = -0.001;
    this.frame();
    new ResizeObserver(() => this.resize()).observe(box);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { this.frame(); this.redraw(); });
    this.resize();
  }

  /** A horizontal plane of the map's size with a pixel for each sample; see paintCells. */
  private cellsPlane(): Mesh<PlaneGeometry, MeshBasicMaterial> {
    const canvas = document.createElement("canvas");
    canvas.width = this.record.verdicts!.nx;
    canvas.height = this.record.verdicts!.ny;
    const map = new CanvasTexture(canvas);
    map.colorSpace = SRGBColorSpace;
    map.magFilter = NearestFilter;
    const plane = new Mesh(new PlaneGeometry(this.width, this.depth), new MeshBasicMaterial({ map, side: DoubleSide, alphaTest: 0.5 }));
    this.scene.add(plane);
    return plane;
  }

  private paintCells(plane: Mesh<PlaneGeometry, MeshBasicMaterial>, codes: Uint8Array, shown: (code: number) => boolean): void {
    const { nx, ny } = this.record.verdicts!;
    const image = new ImageData(nx, ny);
    const out = new Uint32Array(image.data.buffer);
    const colors = this.colors.map((hex, code) => {
      const n = parseInt(hex.slice(1), 16);
      return shown(code) ? (0xff000000 | (n & 255) << 16 | (n & 0xff00) | n >> 16) >>> 0 : 0;
    });
    for (let y = 0; y < ny; ++y) {
      for (let x = 0; x < nx; ++x) out[(ny - 1 - y) * nx + x] = colors[codes[y * nx + x]];
    }
    const map = plane.material.map as CanvasTexture;
    (map.image as HTMLCanvasElement).getContext("2d")!.putImageData(image, 0, 0);
    map.needsUpdate = true;
  }

  private label(text: string, x: number, y: number, z: number): void {
    const canvas = document.createElement("canvas");
    canvas.width = 256;
    canvas.height = 64;
    const context = canvas.getContext("2d")!;
    context.font = "500 34px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillStyle = cssVariable("--soft");
    context.fillText(text, 128, 32);
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    const sprite = new Sprite(new SpriteMaterial({ map: texture, depthTest: false }));
    sprite.scale.set(0.2, 0.05, 1);
    sprite.position.set(x, y, z);
    this.marks.push(sprite);
    this.scene.add(sprite);
  }

  /** The proved tube's outline, at the height of the cut: it is about places, whatever the heading. */
  set tube({ x, y, begin }: GridLines) {
    const { grid } = this.record;
    const { nx, ny, cells_per_sample } = this.record.verdicts!;
    const [across, up] = [grid.nx / (nx * cells_per_sample) * this.width, grid.ny / (ny * cells_per_sample) * this.depth];
    const points: number[] = [];
    const put = (i: number) => points.push(x[i] / 65535 * across - this.width / 2, y[i] / 65535 * up - this.depth / 2, 0.002);
    for (let k = 0; k + 1 < begin.length; ++k) for (let i = begin[k] + 1; i < begin[k + 1]; ++i) { put(i - 1); put(i); }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
    this.outline = new LineSegments(geometry, new LineBasicMaterial({ color: new Color(tube_color) }));
    this.scene.add(this.outline);
  }

  /** The box's edges and axis labels. */
  private frame(): void {
    for (const mark of this.marks.splice(0)) this.scene.remove(mark);
    const [x, y] = [this.width / 2, this.depth / 2];
    const points: number[] = [];
    const line = (...p: number[]) => points.push(...p);
    for (const [a, b] of [[-x, -y], [x, -y], [x, y], [-x, y]]) line(a, b, 0, a, b, height);
    for (const z of [0, height]) line(-x, -y, z, x, -y, z, x, -y, z, x, y, z, x, y, z, -x, y, z, -x, y, z, -x, -y, z);
    for (let k = 0; k <= 4; ++k) line(-x, y, height * k / 4, -x - 0.02, y, height * k / 4);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
    const edges = new LineSegments(geometry, new LineBasicMaterial({ color: new Color(cssVariable("--faint")), transparent: true, opacity: 0.7 }));
    this.marks.push(edges);
    this.scene.add(edges);
    for (let k = 0; k <= 4; ++k) this.label(`${90 * k}°`, -x - 0.09, y, height * k / 4);
    this.label("x, east", 0, -y - 0.07, 0);
    this.label("y, north", -x - 0.1, 0, 0);
    this.label("heading", -x - 0.09, y, height + 0.06);
  }

  private resize(): void {
    const width = this.box.clientWidth, tall = this.box.clientHeight;
    if (width === 0 || tall === 0) return;
    this.renderer.setSize(width, tall, false);
    this.camera.aspect = width / tall;
    if (!this.turned) this.fill();
    this.camera.updateProjectionMatrix();
    this.redraw();
  }

  /** Moves the camera so near that the box with its labels just fits. */
  private fill(): void {
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const [x, y] = [this.width / 2, this.depth / 2];
    const corners: Vector3[] = [];
    for (const cx of [-x - 0.16, x + 0.02]) for (const cy of [-y - 0.1, y]) for (const cz of [0, height + 0.07]) corners.push(new Vector3(cx, cy, cz));
    const extent = (far: number): number => {
      this.camera.position.copy(this.controls.target).addScaledVector(direction, far);
      this.camera.lookAt(this.controls.target);
      this.camera.updateMatrixWorld();
      this.camera.updateProjectionMatrix();
      return Math.max(...corners.map((corner) => {
        const seen = corner.clone().project(this.camera);
        return Math.max(Math.abs(seen.x), seen.y > 0 ? seen.y / 0.84 : -seen.y);  // the tools stand above
      }));
    };
    let near = 0.6, far = 12;
    for (let k = 0; k < 30; ++k) {
      const middle = (near + far) / 2;
      if (extent(middle) > 0.95) near = middle; else far = middle;
    }
    this.box.dataset.extent = extent(far).toFixed(3);
    this.controls.update();
  }

  redraw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.box.dataset.polar = this.controls.getPolarAngle().toFixed(4);
      this.renderer.render(this.scene, this.camera);
    });
  }

  async show(kind: number): Promise<void> {
    this.kind = kind;
    const { nx, ny, heading_rad } = this.record.verdicts!;
    const step = Math.ceil(Math.max(nx, ny) / most_across);
    const [mx, my, mz] = [Math.floor(nx / step), Math.floor(ny / step), heading_rad.length];
    const inside = new Uint8Array(mx * my * mz);
    const verdicts = verdictsOfKind(this.record, kind);
    for (let k = 0; k < mz; ++k) {
      const codes = await this.layers.ask(k);
      for (let y = 0; y < my; ++y) {
        for (let x = 0; x < mx; ++x) {
          if (verdicts.includes(codes[(y * step + (step >> 1)) * nx + x * step + (step >> 1)])) inside[(k * my + y) * mx + x] = 1;
        }
      }
    }
    const quads = boundary({ nx: mx, ny: my, nz: mz, inside });
    const color = new Color(this.colors[verdicts[0]]);
    const position = quads.position;
    const tint = new Float32Array(position.length);
    const sx = this.width / mx, sy = this.depth / my, sz = height / mz;
    for (let v = 0; v < position.length; v += 3) {
      // A little darker towards the floor, so that depth is seen.
      const shade = quads.shade[Math.floor(v / 12)] * (0.78 + 0.22 * position[v + 2] / mz);
      position[v] = position[v] * sx - this.width / 2;
      position[v + 1] = position[v + 1] * sy - this.depth / 2;
      position[v + 2] *= sz;
      tint[v] = color.r * shade;
      tint[v + 1] = color.g * shade;
      tint[v + 2] = color.b * shade;
    }
    const index = new Uint32Array(quads.count * 6);
    for (let q = 0; q < quads.count; ++q) index.set([0, 1, 2, 0, 2, 3].map((k) => 4 * q + k), 6 * q);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("color", new BufferAttribute(tint, 3));
    geometry.setIndex(new BufferAttribute(index, 1));
    if (this.body) {
      this.scene.remove(this.body);
      this.body.geometry.dispose();
    }
    this.body = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, clippingPlanes: [this.cutting] }));
    this.scene.add(this.body);
    await this.cut(this.heading);
    this.box.dataset.quads = String(quads.count);
  }

  async cut(heading: number): Promise<void> {
    this.heading = heading;
    const codes = await this.layers.ask(heading);
    if (this.heading !== heading) return;
    const z = height * (heading + 1) / this.layers.length;
    this.cutting.constant = z - 1e-4;
    this.slice.position.z = z;
    this.outline?.position.setZ(z);
    const { obstacle, target } = this.record.codes;
    const verdicts = verdictsOfKind(this.record, this.kind);
    const in_map = (code: number) => code === obstacle || code === target;
    // For a thin body the cut shows only the body, so that its inside can be seen.
    this.paintCells(this.slice, codes, (code) => this.kind === 0 || in_map(code) && heading + 1 === this.layers.length || verdicts.includes(code));
    this.paintCells(this.floor, codes, in_map);
    this.redraw();
  }

  turn(azimuth: number, polar: number, nearer = 1): void {
    const from = this.camera.position.clone().sub(this.controls.target);
    const r = from.length() / nearer;
    const a = Math.atan2(from.y, from.x) + azimuth;
    const p = Math.min(Math.max(Math.acos(from.z / from.length()) + polar, 0.05), lowest_view);
    this.turned = true;
    from.set(r * Math.sin(p) * Math.cos(a), r * Math.sin(p) * Math.sin(a), r * Math.cos(p));
    this.camera.position.copy(this.controls.target).add(from);
    this.controls.update();
    this.redraw();
  }

  set zooms(on: boolean) { this.controls.enableZoom = on; }
}

/** Builds the view when it scrolls into sight; returns what to call when the heading changes. */
export function showSolid(record: PageRecord, layers: VerdictLayers, tube: GridLines | null): (heading: number) => void {
  const box = byId("solid");
  const first_cut = Math.round(0.68 * layers.length);
  let follow: (heading: number) => void = () => {};
  box.tabIndex = 0;
  box.setAttribute("role", "application");
  box.setAttribute("aria-label", "Body of states over position and heading; arrow keys turn it, plus and minus zoom");
  let solid: Solid | null = null;
  const begin = () => {
    try {
      // Checked beforehand: the library would complain in the console.
      if (!document.createElement("canvas").getContext("webgl2")) throw new Error("no WebGL");
      solid = new Solid(box, record, layers, first_cut);
      if (tube) solid.tube = tube;
    } catch {
      box.replaceChildren(el("p", { class: "hint" }, "This browser does not support WebGL; the map above shows the same states, heading by heading."));
      return;
    }
    const tools = oneOf(body_names, "Which states", (kind) => void solid!.show(kind));
    tools.classList.add("solid-tools");
    const cut = el("input", { type: "range", min: 0, max: layers.length - 1, value: first_cut, "aria-label": "Heading of the cut" });
    const words = el("output", {}, "");
    const moved = () => {
      words.textContent = `cut at ${headingWords(record.verdicts!.heading_rad[Number(cut.value)])}`;
      cut.setAttribute("aria-valuetext", words.textContent);
      void solid!.cut(Number(cut.value));
    };
    cut.addEventListener("input", moved);
    follow = (index) => { cut.value = String(index); moved(); };
    tools.append(el("label", { class: "cut" }, cut, words));
    box.append(tools, el("p", { class: "solid-note" }, "Drag or use arrow keys to turn, + − to zoom."));
    moved();
    void solid.show(0);
  };
  new IntersectionObserver((entries, observer) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    begin();
  }, { rootMargin: "200px" }).observe(box);
  box.addEventListener("focus", () => { if (solid) solid.zooms = true; });
  box.addEventListener("blur", () => { if (solid) solid.zooms = false; });
  box.addEventListener("pointerdown", () => box.focus({ preventScroll: true }));
  box.addEventListener("keydown", (event) => {
    const turns: Record<string, [number, number, number]> = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, -0.08, 1], ArrowDown: [0, 0.08, 1],
      "+": [0, 0, 1.12], "=": [0, 0, 1.12], "-": [0, 0, 1 / 1.12] };
    const turn = turns[event.key];
    if (!turn || !solid || event.target !== box) return;
    event.preventDefault();
    solid.turn(...turn);
  });
  return (index) => follow(index);
}
