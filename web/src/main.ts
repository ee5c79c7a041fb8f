// The page: shows its record and arrays as a map with layers, and below it flights, the body of
// states that reach, and what all of it rests on.
import { Arrays } from "./arrays";
import { byId } from "./dom";
import { fieldOf } from "./field_arrays";
import { flightsOf, type ShownFlight } from "./flights";
import { connect } from "./live";
import { MapPage } from "./map_page";
import { showChokes, showFacts, showNumbers, showTitle, showTrust, showVolumes, showWarnings, showWords } from "./numbers";
import { preparePrinting } from "./print";
import { recordOfPage, type PageRecord } from "./record";
import { showSolid } from "./solid";
import { stateOfHash } from "./state_link";

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
  const field = await fieldOf(arrays);
  const map = new MapPage(record, arrays, field, await flightsIn(record, arrays));
  showChokes(record, (x, y) => void map.visit(x, y));
  const { verdicts } = map;
  const exact = { ...record };  // the map's record changes with what it shows
  await map.show();
  if (map.verdict_tiles) showVolumes(record, map.verdict_tiles);
  const follow = () => {
    const asked = stateOfHash(location.hash);
    if (asked) map.goTo(asked);
  };
  follow();
  window.addEventListener("hashchange", follow);
  preparePrinting(() => map.relayout());
  document.documentElement.dataset.ready = String(Math.round(performance.now()));

  // The rest, in the background.
  if (verdicts) {
    await map.needCounts();
    void verdicts.askAll();
    map.turned = showSolid(exact, verdicts, field.tube);
  } else {
    byId("solid-section").hidden = true;
  }
  const live = await connect(record, map);
  if (live) {
    map.liveTool = live;
    follow();
  }
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
