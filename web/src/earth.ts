// Headings as compass courses, and places as latitude and longitude.
import { degrees, headingWords } from "./dom";
import type { PageRecord } from "./record";

export type Place = [number, number];

/** "045°": clockwise from north. */
export function courseWords(rad: number): string {
  return `${String(Math.round((450 - degrees(rad)) % 360) % 360).padStart(3, "0")}°`;
}

/** "45° (course 045°)"; without the course where y is not north. */
export function bearingWords(record: PageRecord, rad: number): string {
  return headingWords(rad) + (northUp(record) ? ` (course ${courseWords(rad)})` : "");
}

export function northUp(record: PageRecord): boolean { return record.frame.yaw_rad === 0; }

/** Interpolated on the record's lattice; null when not georeferenced, or outside the grid. */
export function latitudeLongitude(record: PageRecord, [x, y]: Place): [number, number] | null {
  const { earth } = record.frame;
  if (!earth) return null;
  const { nx, ny, x0_m, y0_m, cell_m } = record.grid;
  const last = earth.across - 1;
  const u = (x - x0_m) / (nx * cell_m) * last, v = (y - y0_m) / (ny * cell_m) * last;
  if (!(u >= 0 && u <= last && v >= 0 && v <= last)) return null;
  const i = Math.min(Math.floor(u), last - 1), j = Math.min(Math.floor(v), last - 1);
  const [s, t] = [u - i, v - j];
  const at = (values: number[]) => {
    const value = (di: number, dj: number) => values[(j + dj) * earth.across + i + di];
    return (1 - t) * ((1 - s) * value(0, 0) + s * value(1, 0)) + t * ((1 - s) * value(0, 1) + s * value(1, 1));
  };
  const longitude = at(earth.lon_deg);
  return [at(earth.lat_deg), longitude - 360 * Math.round(longitude / 360)];
}

/** "47.402500, 8.556500", as in a scenario. */
export function earthWords(record: PageRecord, place: Place): string | null {
  return latitudeLongitude(record, place)?.map((degrees) => degrees.toFixed(6).replace("-", "−")).join(", ") ?? null;
}
