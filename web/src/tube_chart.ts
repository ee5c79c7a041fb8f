// Distance from the path that is followed, over its station: the proved tube, and flights in it.
import uPlot from "uplot";
import { el, grouped, isDark, short } from "./dom";
import type { ShownFlight } from "./flights";
import { FollowedPath, type Lap } from "./following";
import { axesOf, lineSeries, xSeries } from "./plot_style";
import type { PageRecord } from "./record";

export const tube_color = "#aa3377";
const most_lines = 5;
const seconds = (s: number): string => short(Math.round(s));

export class TubeChart {
  readonly box = el("div", { id: "tube-chart" });
  private readonly path: FollowedPath;
  private readonly words = el("p", { class: "hint", id: "tube-words" });
  private plot: uPlot | null = null;

  /** `flown`: all of the page, whose laps are measured when the page is idle. */
  constructor(private readonly record: PageRecord, private readonly flown: ShownFlight[]) {
    this.path = new FollowedPath(record);
    this.words.textContent = this.provedWords();
    setTimeout(() => { this.words.textContent = `${this.provedWords()} ${this.flownWords()}`; }, 300);
  }

  private provedWords(): string {
    const { tube_m, lap_time_s: [least, most] } = this.path.proved;
    const lap = this.record.follow!.closed ? `a lap takes ${seconds(Math.floor(least))} to ${seconds(Math.ceil(most))} s` : `it comes to the path's end within ${seconds(Math.ceil(most))} s`;
    return `Proved of whoever follows: it stays within the tube, nowhere farther than ${(Math.ceil(10 * tube_m) / 10).toFixed(1)} m from the line, and ${lap}.`;
  }

  private flownWords(): string {
    const laps = this.flown.map((flight) => this.path.lapOf(flight)).filter((lap): lap is Lap => lap !== null);
    const times = laps.map((lap) => lap.time_s).filter((time): time is number => time !== null);
    const leaves = " Where a line is above the tube, that flight did not follow yet: who does stays within.";
    if (laps.length === 0) return "No flight of this page comes within it.";
    if (!this.record.follow!.closed) return leaves.trim();
    if (times.length === 0) return `No flight of this page flies a whole lap.${leaves}`;
    const less = laps.length - times.length;
    return `Flown: the last lap took ${seconds(Math.min(...times))} to ${seconds(Math.max(...times))} s in ${grouped(times.length)} flights of this page` +
      `${less > 0 ? `; ${grouped(less)} more fly less than a lap` : ""}.${leaves}`;
  }

  /** A flight that was chosen, or the first few that come within the tube, those of the scenario before others. */
  private charted(chosen: ShownFlight | null): { flight: ShownFlight; lap: Lap }[] {
    const given = (flight: ShownFlight) => flight.record.group === "given";
    const flights = chosen ? [chosen] : [...this.flown.filter(given), ...this.flown.filter((flight) => !given(flight))];
    const found: { flight: ShownFlight; lap: Lap }[] = [];
    for (const flight of flights) {
      const lap = found.length < most_lines ? this.path.lapOf(flight) : null;
      if (lap) found.push({ flight, lap });
    }
    return found;
  }

  show(chosen: ShownFlight | null, width: number): void {
    this.plot?.destroy();
    const shown = this.charted(chosen);
    const { series } = this.record.styles;
    const { station_m, tube_m } = this.path;
    const most = Math.max(...tube_m);
    const title = "Distance from the line, m";
    this.box.replaceChildren();
    this.plot = new uPlot({
      width, height: 205,
      cursor: { y: false, drag: { x: false, y: false } },
      scales: { x: { time: false, range: () => [0, this.path.proved.length_m] }, y: { range: (_plot, _min, max) => [0, 1.08 * Math.max(most, max || 0)] } },
      axes: axesOf("station along the line, m", title),
      series: [xSeries("station, m"),
        { ...lineSeries("proved tube", tube_color), fill: `rgb(170 51 119 / ${isDark() ? 34 : 16}%)` },
        ...shown.map(({ flight: { record, line } }, k) => lineSeries(`from (${short(record.start[0])}, ${short(record.start[1])})`, chosen ? line.color : series[k % series.length]))],
    }, [station_m, tube_m, ...shown.map(({ lap }) => lap.distance_m)] as uPlot.AlignedData, this.box);
    this.plot.root.setAttribute("role", "img");
    this.plot.root.setAttribute("aria-label", `${title}, over the station: the proved tube and ${shown.length} flight${shown.length === 1 ? "" : "s"}`);
    this.box.append(this.words);
  }

  resize(width: number): void { this.plot?.setSize({ width, height: 205 }); }
}
