// What the two sets of verdicts of a page are called: the exact vehicle's and, under a contract, those
// of every vehicle that keeps it; of a path, that it is touched and that it is followed.
import type { PageRecord, VerdictInfo } from "./record";

export type Whose = "exact" | "contract" | "both";

export interface VerdictNames {
  choices: [Whose, string][];  // which of them the map shows
  maps: [string, string];
  rows: [string, string];  // over their figures
  short: [string, string];  // over columns
  reach: [string, string];  // what the verdict `reach` says
  after: string;  // that a verdict is one of the second set: "under the contract"
}

export function verdictNames({ follow, exact_contract }: PageRecord): VerdictNames {
  const under = exact_contract ? "" : ", under the contract";
  if (!follow) {
    return {
      choices: [["exact", "Exact vehicle"], ["contract", "Under the contract"], ["both", "Side by side"]],
      maps: ["Exact vehicle", "Under the contract"],
      rows: ["The exact vehicle", "Every vehicle that keeps the contract"],
      short: ["exact", "under the contract"], reach: ["reach", "reach"], after: "under the contract" };
  }
  return {
    choices: [["exact", "Touches the path"], ["contract", "Follows it"], ["both", "Side by side"]],
    maps: [`Touches the path${exact_contract ? "" : ", exact vehicle"}`, `Follows it${under}`],
    rows: [`Touching the path${exact_contract ? "" : ": the exact vehicle"}`, `Following it${exact_contract ? "" : ": every vehicle that keeps the contract"}`],
    short: ["touch", "follow"], reach: ["touch", "follow"], after: `following the path${under}` };
}

/** What the verdict `reach` says: "reach"; of a path, "touch" or "follow". */
export function reachWord(record: PageRecord, info: VerdictInfo): string {
  return verdictNames(record).reach[info === record.contract_verdicts ? 1 : 0];
}
