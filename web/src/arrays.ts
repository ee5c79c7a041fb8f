// The page's arrays: base64, then a small header, then a zlib stream for each array or layer
// (fairway/report/page_payload.hpp). Arrays are inflated only on request.

interface Entry { dtype: "U8" | "U16" | "U32" | "F32"; shape: number[]; filter: "none" | "planes" | "delta"; at: number[] }
export type Numbers = Uint8Array | Uint16Array | Uint32Array | Float32Array;

const types = { U8: Uint8Array, U16: Uint16Array, U32: Uint32Array, F32: Float32Array };

function bytesOfBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function unfiltered(bytes: Uint8Array<ArrayBuffer>, entry: Entry): Numbers {
  const type = types[entry.dtype];
  const width = type.BYTES_PER_ELEMENT;
  if (entry.filter === "none") return new type(bytes.buffer);
  const n = bytes.length / width;
  const raw = new Uint8Array(bytes.length);
  for (let b = 0; b < width; ++b) {
    for (let i = 0; i < n; ++i) raw[i * width + b] = bytes[b * n + i];
  }
  const values = new type(raw.buffer);
  if (entry.filter === "delta") {
    for (let i = 1; i < n; ++i) values[i] += values[i - 1];  // modulo the element's size
  }
  return values;
}

export class Arrays {
  private readonly bytes: Uint8Array<ArrayBuffer>;
  private readonly entries: Record<string, Entry>;
  private readonly begin: number;
  private readonly whole = new Map<string, Promise<Numbers>>();

  constructor(base64: string) {
    if (typeof DecompressionStream === "undefined") {
      throw new Error("this browser cannot decompress the page's data (it lacks DecompressionStream); use one from 2023 or later");
    }
    this.bytes = bytesOfBase64(base64);
    const length = Number(new DataView(this.bytes.buffer).getBigUint64(0, true));
    this.begin = 8 + length;
    this.entries = JSON.parse(new TextDecoder().decode(this.bytes.subarray(8, this.begin)));
  }

  private stream(name: string, k: number): Uint8Array<ArrayBuffer> {
    const { at } = this.entries[name];
    return this.bytes.subarray(this.begin + at[k], this.begin + at[k + 1]);
  }

  has(name: string): boolean { return name in this.entries; }

  array(name: string): Promise<Numbers> {
    let found = this.whole.get(name);
    if (!found) {
      found = inflated(this.stream(name, 0)).then((bytes) => unfiltered(bytes, this.entries[name]));
      this.whole.set(name, found);
    }
    return found;
  }

  /** Layer k of an array that is compressed layer by layer. */
  layer(name: string, k: number): Promise<Uint8Array> { return inflated(this.stream(name, k)); }
}
