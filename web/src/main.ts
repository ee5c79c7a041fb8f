// The page: the record and the arrays it carries, shown as a map with layers, and below it flights,
// the body of states that reach, and what all of it rests on.
import { Arrays } from "./arrays";
import { byId } from "./dom";
import { flightsOf, type ShownFlight } from "./flights";
import { connect } from "./live";
import { MapPage } from "./map_page";
import { showFacts, showNumbers, showTitle, showTrust, showVolumes, showWarnings, showWords } from "./numbers";
import type { FieldArrays, GridLines } from "./overlay";
import { recordOfPage, type PageRecord } from "./record";
import { showSolid } from "./solid";

async function fieldOf(arrays: Arrays): Promise<FieldArrays> {
  const lines = async (name: string): Promise<GridLines> => {
    const [x, y, begin] = await Promise.all(["x", "y", "begin"].map((part) => arrays.array(`${name}_${part}`)));
    return { x, y, begin };
  };
  const [region, heading, cost, contour_level_m] = await Promise.all(["region", "heading", "cost", "contour_level_m"].map((name) => arrays.array(name)));
  const [streamlines, contours] = await Promise.all([lines("streamline"), lines("contour")]);
  return { region, heading, cost, streamlines, contours, contour_level_m };
}

async function flightsIn(record: PageRecord, arrays: Arrays): Promise<ShownFlight[]> {
  const [x_m, y_m, heading_rad, length_m, curvature_per_m] = await Promise.all(
    ["x_m", "y_m", "heading_rad", "length_m", "curvature_per_m"].map((name) => arrays.array(`piece_${name}`)));
  return flightsOf(record, { x_m, y_m, heading_rad, length_m, curvature_per_m });
}

async function show(record: PageRecord, arrays: Arrays): Promise<void> {
  showTitle(record);
  showWarnings(record);
  showFacts(record);
  showWords(record);
  showTrust(record);
  showNumbers(record);
  const map = new MapPage(record, arrays, await fieldOf(arrays), await flightsIn(record, arrays));
  await map.show();
  if (map.verdict_tiles) showVolumes(record, map.verdict_tiles);
  document.documentElement.dataset.ready = String(Math.round(performance.now()));

  // The rest, while nobody waits for it.
  if (map.verdicts) {
    await map.needCounts();
    void map.verdicts.askAll();
    map.turned = showSolid(record, map.verdicts);
  } else {
    byId("solid-section").hidden = true;
  }
  const live = await connect(record, {
    redraw: () => map.redrawMarks(), heading: () => map.heading_rad(), turnTo: (rad) => map.slider.turnToRad(rad) });
  if (live) map.liveTool = live;
}

function fail(error: unknown): void {
  const trouble = byId("trouble");
  trouble.textContent = `This page could not be shown: ${error instanceof Error ? error.message : String(error)}.`;
  trouble.hidden = false;
  console.error(error);
}

try {
  show(recordOfPage(), new Arrays(byId("arrays").textContent!)).catch(fail);
} catch (error) {
  fail(error);
}
