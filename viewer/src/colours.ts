// Colour maps, from the one table that `undine picture` reads too.
import table from "../colour_maps.json";

export interface ColourMap {
  name: string;
  signed: boolean;
  /** 256 colours, RGBA. */
  rgba: Uint8Array;
}

function expand(hex: string): Uint8Array {
  const nodes = hex.length / 6;
  const rgba = new Uint8Array(256 * 4).fill(255);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (nodes - 1), k = Math.min(Math.floor(at), nodes - 2);
    for (let c = 0; c < 3; ++c) {
      const a = parseInt(hex.slice(6 * k + 2 * c, 6 * k + 2 * c + 2), 16);
      const b = parseInt(hex.slice(6 * k + 6 + 2 * c, 6 * k + 8 + 2 * c), 16);
      rgba[4 * i + c] = Math.round(a + (b - a) * (at - k));
    }
  }
  return rgba;
}

export const colourMaps: ColourMap[] = table.maps.map((map) => ({
  name: map.name,
  signed: "signed" in map,
  rgba: expand(map.colours),
}));

export const colourMap = (name: string): ColourMap => colourMaps.find((map) => map.name === name) ?? colourMaps[0];
