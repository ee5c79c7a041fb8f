// Heading and distance over time of the flights chosen.
import uPlot from "uplot";
import { byId, el, short } from "./dom";
import type { Pose, ShownFlight } from "./flights";
import { axesOf, lineSeries, xSeries } from "./plot_style";
import type { Mission, PageRecord } from "./record";
import { TubeChart } from "./tube_chart";

function distanceToSegment(p: Pose, a: [number, number], b: [number, number]): number {
  const dx = b[0] - a[0], dy = b[1] - a[1];
  const squared = dx * dx + dy * dy;
  const t = squared === 0 ? 0 : Math.min(Math.max(((p.x - a[0]) * dx + (p.y - a[1]) * dy) / squared, 0), 1);
  return Math.hypot(p.x - a[0] - t * dx, p.y - a[1] - t * dy);
}

export function distanceToMission(mission: Mission, pose: Pose): number {
  if (mission.kind === "goal") return Math.hypot(pose.x - mission.goal_m[0], pose.y - mission.goal_m[1]);
  const v = mission.vertices_m;
  let least = Infinity;
  for (let k = 0; k + 1 < v.length; ++k) least = Math.min(least, distanceToSegment(pose, v[k], v[k + 1]));
  if (mission.closed) least = Math.min(least, distanceToSegment(pose, v[v.length - 1], v[0]));
  return least;
}

interface Curve { name: string; color: string; dash: number[]; t: number[]; heading: (number | null)[]; distance: (number | null)[] }

/** In (-180, 180]. */
export function wrappedDegrees(rad: number): number {
  const turned = rad * 180 / Math.PI % 360;
  return turned > 180 ? turned - 360 : turned <= -180 ? turned + 360 : turned;
}

/** Curves of several flights on one axis of times. */
function joined(curves: Curve[], of: (curve: Curve) => (number | null)[]): uPlot.AlignedData {
  return uPlot.join(curves.map((curve) => [curve.t, of(curve)] as uPlot.AlignedData));
}

export class Charts {
  private plots: uPlot[] = [];
  private curves: Curve[] = [];
  private flights: ShownFlight[] = [];

  private readonly tube: TubeChart | null;

  /** `flown`: all flights of the page. */
  constructor(private readonly record: PageRecord, flown: ShownFlight[], private readonly moved: (time_s: number) => void) {
    this.tube = record.follow ? new TubeChart(record, flown) : null;
    new ResizeObserver(() => {
      const { width } = this;
      this.plots.forEach((plot) => { if (Math.abs(plot.width - width) > 1) plot.setSize({ width, height: plot.height }); });
      this.tube?.resize(width);
    }).observe(byId("charts"));
  }

  private get width(): number { return byId("charts").clientWidth || 600; }

  /** With the current colours and width. */
  redraw(): void { this.show(this.flights); }

  show(flights: ShownFlight[]): void {
    this.flights = flights;
    this.plots.forEach((plot) => plot.destroy());
    this.plots = [];
    this.curves = flights.map((flight, k) => this.curve(flight, k));
    const goal = this.record.mission.kind === "goal";
    const boxes = [el("div"), el("div")];
    byId("charts").replaceChildren(...boxes, ...(this.tube ? [this.tube.box] : []));
    this.tube?.show(flights.length === 1 ? flights[0] : null, this.width);
    if (this.curves.length === 0) return;
    this.plots = [
      this.plot(boxes[0], "Heading, degrees", joined(this.curves, (c) => c.heading), { y: { range: () => [-180, 180] } }),
      this.plot(boxes[1], `Distance to the ${goal ? "goal" : "path"}, m`, joined(this.curves, (c) => c.distance),
        { y: { range: (_plot, _min, max) => [0, (max || 1) * 1.05] } }),
    ];
  }

  private curve(flight: ShownFlight, k: number): Curve {
    const t: number[] = [];
    const heading: (number | null)[] = [], distance: (number | null)[] = [];
    let last = 0;
    for (const { t: time, pose } of flight.track.samples(700)) {
      if (t.length > 0 && time <= t[t.length - 1]) continue;
      const turned = wrappedDegrees(pose.h);
      const apart = distanceToMission(this.record.mission, pose);
      // The line is broken where the heading wraps.
      if (t.length > 0 && Math.abs(turned - last) > 180) {
        t.push((t[t.length - 1] + time) / 2);
        heading.push(null);
        distance.push(apart);
      }
      t.push(time);
      heading.push(turned);
      distance.push(apart);
      last = turned;
    }
    const [x, y] = flight.record.start;
    const series = this.record.styles.series;
    return { name: `from (${short(x)}, ${short(y)})`, color: this.flights.length === 1 ? flight.line.color : series[k % series.length],
      dash: k >= series.length ? [5, 3] : [], t, heading, distance };
  }

  private plot(box: HTMLElement, title: string, data: uPlot.AlignedData, scales: uPlot.Scales): uPlot {
    const turns = title.startsWith("Heading") ? { splits: () => [-180, -90, 0, 90, 180] } : {};
    box.setAttribute("role", "img");
    box.setAttribute("aria-label", `${title} over time, ${this.curves.length} flight${this.curves.length === 1 ? "" : "s"}`);
    return new uPlot({
      width: this.width,
      height: 205,
      title: undefined,
      cursor: { y: false, sync: { key: "fairway" }, drag: { x: false, y: false }, bind: { click: (plot, _target, handler) => (event) => {
        handler(event);
        const left = plot.cursor.left ?? -1;
        if (left >= 0) this.moved(plot.posToVal(left, "x"));
        return null;
      } } },
      scales: { x: { time: false }, ...scales },
      axes: axesOf("time, s", title, turns),
      series: [xSeries("time, s"), ...this.curves.map((curve) => lineSeries(curve.name, curve.color, curve.dash))],
    }, data, box);
  }

  /** Puts the cursors at a time. */
  mark(time_s: number): void {
    for (const plot of this.plots) plot.setCursor({ left: plot.valToPos(time_s, "x"), top: 10 }, false);
  }
}
