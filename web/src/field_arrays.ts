// A plan's arrays as the map draws them.
import type { Arrays } from "./arrays";
import type { FieldArrays, GridLines } from "./overlay";

export async function fieldOf(arrays: Arrays): Promise<FieldArrays> {
  const lines = async (name: string): Promise<GridLines> => {
    const [x, y, begin] = await Promise.all(["x", "y", "begin"].map((part) => arrays.array(`${name}_${part}`)));
    return { x, y, begin };
  };
  const [region, heading, cost, contour_level_m] = await Promise.all(["region", "heading", "cost", "contour_level_m"].map((name) => arrays.array(name)));
  const [streamlines, contours] = await Promise.all([lines("streamline"), lines("contour")]);
  return { region, heading, cost, streamlines, contours, contour_level_m, tube: arrays.has("tube_x") ? await lines("tube") : null };
}
