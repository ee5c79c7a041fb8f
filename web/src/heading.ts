// The heading of the vehicle: a slider with, above it, the shares of verdicts at every heading.
import { byId, cssVariable, degrees, el, fitted, headingWords, percent, turnOf, wind } from "./dom";
import { bearingWords, courseWords, northUp } from "./earth";
import { codesInOrder, countsAt, nearestHeading, type PageRecord, type VerdictInfo } from "./record";
import type { Tiles } from "./layers";
import { reachWord, verdictNames } from "./whose";

export class HeadingSlider {
  index = 0;
  private playing = 0;
  private last = 0;
  private shares: ImageData | null = null;

  /** `strips`: whose shares the strips above the slider show, one above the other. */
  constructor(private readonly record: PageRecord, private readonly tiles: () => Tiles, private readonly strips: () => VerdictInfo[], private readonly changed: () => void) {
    const range = byId<HTMLInputElement>("heading-range");
    this.count();
    range.addEventListener("input", () => { this.stop(); this.turnTo(Number(range.value)); });
    // The arrow keys wrap round: after the last heading comes the first.
    range.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowRight" || event.key === "ArrowUp" ? 1
        : event.key === "ArrowLeft" || event.key === "ArrowDown" ? -1 : 0;
      if (step === 0) return;
      event.preventDefault();
      this.stop();
      this.turnBy(step);
    });
    byId("heading-play").addEventListener("click", () => this.playing ? this.stop() : this.play());
    this.dial();
  }

  private count(): void {
    const n = this.record.verdicts?.heading_rad.length ?? 72;
    byId<HTMLInputElement>("heading-range").max = String(n - 1);
    // Where the thumb is at these headings: half a thumb short of the ends.
    const ticks = [0, 90, 180, 270].map((degrees) => degrees / 360 * n).filter(Number.isInteger).concat(n > 4 ? [n - 1] : []);
    byId("heading-ticks").replaceChildren(...ticks.map((k) => {
      const tick = el("span", {}, `${Math.round(360 * k / n)}°`);
      tick.style.left = `calc(8px + ${k / Math.max(1, n - 1)} * (100% - 16px))`;
      return tick;
    }));
  }

  /** For other verdicts, or none: keeps the heading as near as possible. */
  reset(rad: number): void {
    this.count();
    this.shares = null;
    this.index = this.indexOf(rad);
    this.show();
  }

  get rad(): number { return this.record.verdicts?.heading_rad[this.index] ?? this.index * Math.PI / 36; }
  private get headings(): number { return Number(byId<HTMLInputElement>("heading-range").max) + 1; }

  turnBy(steps: number): void { this.turnTo((this.index + steps + this.headings) % this.headings); }

  turnTo(index: number): void {
    if (index === this.index) return;
    this.index = index;
    this.show();
    this.changed();
  }

  /** The heading nearest to an angle. */
  turnToRad(rad: number): void {
    this.stop();
    this.turnTo(this.indexOf(rad));
  }

  private indexOf(rad: number): number { return Math.round(degrees(rad) / 360 * this.headings) % this.headings; }

  private play(): void {
    byId("heading-play").setAttribute("aria-pressed", "true");
    const step = (now: number) => {
      if (now - this.last > 85) {
        this.last = now;
        this.turnBy(1);
      }
      this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
  }

  stop(): void {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    byId("heading-play").setAttribute("aria-pressed", "false");
  }

  private dial(): void {
    const dial = byId("heading-dial");
    const ticks = Array.from({ length: 24 }, (_, k) => {
      const a = k * Math.PI / 12, inner = k % 6 === 0 ? 23 : 26;
      return `M${inner * Math.cos(a)} ${inner * Math.sin(a)}L${29 * Math.cos(a)} ${29 * Math.sin(a)}`;
    }).join("");
    dial.innerHTML = `<path d="${ticks}" stroke="var(--faint)" fill="none"/>` +
      `<g id="heading-needle"><path d="M-17 0H12" stroke="var(--accent)" stroke-width="3" stroke-linecap="round"/>` +
      `<path d="M22 0L9 6.5V-6.5Z" fill="var(--accent)"/></g>`;
  }

  show(): void {
    const range = byId<HTMLInputElement>("heading-range");
    range.value = String(this.index);
    const words = `${bearingWords(this.record, this.rad)}, ${wind(this.rad)}`;
    range.setAttribute("aria-valuetext", words);
    byId("heading-needle").setAttribute("transform", `rotate(${-degrees(this.rad)})`);
    const output = byId("heading-words");
    const big = document.createElement("b");
    big.textContent = headingWords(this.rad);
    const small = document.createElement("span");
    // Of the degrees shown: the sampled heading is off them by half a thousandth of a radian.
    const shown_rad = turnOf(parseFloat(headingWords(this.rad)));
    small.textContent = (northUp(this.record) ? `course ${courseWords(this.rad)}, ` : "") + `${wind(this.rad)} · ${shown_rad.toFixed(3)} rad`;
    const proved = document.createElement("span");
    const shares = this.strips().map((info) => {
      const count = info.count[nearestHeading(info, this.rad)];
      return percent(count[this.record.codes.reach] / Math.max(1, count.reduce((a, b) => a + b, 0)));
    });
    const [first, second] = shares;
    const { short, reach } = verdictNames(this.record);
    if (shares.length === 1) proved.textContent = `${first} of places ${reachWord(this.record, this.strips()[0])}`;
    if (shares.length > 1) proved.textContent = `places that ${reach[0]}: ${first}, ${short[1]}${reach[1] === short[1] ? ":" : ""} ${second}`;
    output.replaceChildren(big, small, proved);
    this.strip();
  }

  /** Shares of verdicts by heading, stacked, with the current heading marked. */
  strip(): void {
    const canvas = byId<HTMLCanvasElement>("heading-strip");
    const info = this.record.verdicts;
    canvas.classList.toggle("none", !info);
    canvas.classList.toggle("two", this.strips().length > 1);
    if (!info) return;
    if (fitted(canvas) || !this.shares) this.shares = this.paintShares(canvas);
    const context = canvas.getContext("2d")!;
    const { width, height } = canvas;
    context.putImageData(this.shares, 0, 0);
    const inset = this.inset(canvas);
    const x = inset + this.index / Math.max(1, info.heading_rad.length - 1) * (width - 2 * inset);
    context.fillStyle = cssVariable("--accent");
    context.fillRect(x - 1, 0, 2.5, height);
  }

  /** A slider's thumb stays within it: its centre stops half a thumb short of either end. */
  private inset(canvas: HTMLCanvasElement): number { return 8 * canvas.width / Math.max(1, canvas.clientWidth); }

  private paintShares(canvas: HTMLCanvasElement): ImageData {
    const { width, height } = canvas;
    const image = new ImageData(width, height);
    const out = new Uint32Array(image.data.buffer);
    const strips = this.strips();
    const gap = strips.length > 1 ? Math.round(height / 16) : 0;
    const each = Math.floor((height - gap * (strips.length - 1)) / Math.max(1, strips.length));
    strips.forEach((info, k) => this.paintStrip(out, canvas, info, k * (each + gap), k + 1 < strips.length ? k * (each + gap) + each : height));
    return image;
  }

  private paintStrip(out: Uint32Array, canvas: HTMLCanvasElement, info: VerdictInfo, above: number, below: number): void {
    const { width } = canvas;
    const order = codesInOrder(this.record, info);
    const { size, pixels } = this.tiles();
    const steps = this.headings - 1;
    const inset = this.inset(canvas);
    const counts = info.heading_rad.map((_, k) => countsAt(this.record, info, k));
    for (let x = 0; x < width; ++x) {
      // The heading under the thumb there, of these verdicts the nearest.
      const at = Math.min(steps, Math.max(0, (x - inset) / Math.max(1, width - 2 * inset) * steps));
      const count = counts[nearestHeading(info, at / this.headings * 2 * Math.PI)];
      const all = Math.max(1, count.reduce((a, b) => a + b, 0));
      let y = below, sum = 0;
      for (const verdict of order) {  // from below
        sum += count[verdict];
        const top = verdict === this.record.codes.undecided ? above : Math.round(above + (below - above) * (1 - sum / all));
        while (y > top) {
          --y;
          out[y * width + x] = pixels[verdict * size * size + y % size * size + x % size];
        }
      }
    }
  }
}
