// How charts look, in the page's colours.
import type uPlot from "uplot";
import { cssVariable, isDark } from "./dom";

export function axesOf(x_label: string, y_label: string, y: uPlot.Axis = {}): uPlot.Axis[] {
  const stroke = cssVariable("--soft");
  const grid = { stroke: cssVariable("--line"), width: 1 };
  const family = getComputedStyle(document.body).fontFamily;
  const axis = { stroke, grid, ticks: grid, font: `11px ${family}`, labelFont: `12px ${family}` };
  return [{ ...axis, label: x_label, labelSize: 18, size: 34 }, { ...axis, ...y, label: y_label, labelSize: 20, size: 46 }];
}

const valueText = (_plot: uPlot, value: number | null): string => value === null ? "–" : value.toFixed(1);

export function xSeries(label: string): uPlot.Series { return { label, value: valueText }; }

export function lineSeries(label: string, color: string, dash: number[] = []): uPlot.Series {
  return { label, stroke: isDark() ? lighter(color) : color, width: 1.6, dash, spanGaps: false, points: { show: false }, value: valueText };
}

/** Line colours are made for paper; on a dark background they are mixed with white. */
function lighter(color: string): string {
  const n = parseInt(color.slice(1), 16);
  const mix = (c: number) => Math.round(c + (255 - c) * 0.45);
  return `rgb(${mix(n >> 16)} ${mix(n >> 8 & 255)} ${mix(n & 255)})`;
}
