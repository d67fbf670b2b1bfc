'use strict';
// The text that was packed with gzip (RFC 1951, 1952), less gzip's header of ten bytes, and written as
// base64: the library that draws charts is less than half as long so. Browsers unpack by themselves only
// in the background, and a page that is printed at once would be without its charts.
const inflatedText = (base64) => {
  const packed = Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0));
  const kTrailer = 8, kLongest_bits = 15;  // of the trailer, the last four bytes are the length
  const view = new DataView(packed.buffer);
  const text = new Uint8Array(view.getUint32(packed.length - 4, true));
  let at = 0, held = 0, heldBits = 0, end = 0;
  const hold = (count) => {
    for (; heldBits < count; heldBits += 8) held |= packed[at++] << heldBits;
  };
  const drop = (count) => {
    held >>>= count;
    heldBits -= count;
  };
  const bits = (count) => {
    hold(count);
    const value = held & ((1 << count) - 1);
    drop(count);
    return value;
  };
  // Of a canonical Huffman code: the symbol that begins each possible sequence of bits, and its length.
  const codeOf = (lengths) => {
    const table = new Uint16Array(1 << kLongest_bits);
    for (let length = 1, code = 0; length <= kLongest_bits; ++length, code <<= 1) {
      lengths.forEach((its, symbol) => {
        if (its !== length) return;
        let turned = 0;
        for (let k = 0; k < length; ++k) turned |= ((code >> k) & 1) << (length - 1 - k);
        for (let k = turned; k < table.length; k += 1 << length) table[k] = (symbol << 4) | length;
        ++code;
      });
    }
    return table;
  };
  const symbolOf = (table) => {
    hold(kLongest_bits);
    const entry = table[held & (table.length - 1)];
    if (!entry) throw new Error('the page is damaged');
    drop(entry & 15);
    return entry >> 4;
  };
  const fixed = () => [codeOf([...Array(288)].map((_, k) => (k < 144 ? 8 : k < 256 ? 9 : k < 280 ? 7 : 8))), codeOf(Array(30).fill(5))];
  const kOrder = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
  const own = () => {
    const literals = bits(5) + 257, distances = bits(5) + 1, listed = bits(4) + 4;
    const short = Array(19).fill(0);
    for (let k = 0; k < listed; ++k) short[kOrder[k]] = bits(3);
    const code = codeOf(short), lengths = [];
    while (lengths.length < literals + distances) {
      const symbol = symbolOf(code);
      const [value, times] = symbol < 16 ? [symbol, 1] : symbol === 16 ? [lengths[lengths.length - 1], 3 + bits(2)] :
        symbol === 17 ? [0, 3 + bits(3)] : [0, 11 + bits(7)];
      for (let k = 0; k < times; ++k) lengths.push(value);
    }
    return [codeOf(lengths.slice(0, literals)), codeOf(lengths.slice(literals))];
  };
  // Lengths and distances have a base and some more bits.
  const based = (count, first, perStep, start) => {
    const base = [], more = [];
    for (let k = 0, value = first; k < count; ++k) {
      more.push(Math.max(0, Math.floor(k / perStep) - start));
      base.push(value);
      value += 1 << more[k];
    }
    return {base, more};
  };
  const length = based(28, 3, 4, 1), distance = based(30, 1, 2, 1);
  length.base.push(258);
  length.more.push(0);
  for (let isLast = 0; !isLast;) {
    isLast = bits(1);
    const kind = bits(2);
    if (kind === 0) {
      at -= heldBits >> 3;
      held = heldBits = 0;
      const size = view.getUint16(at, true);
      text.set(packed.subarray(at + 4, at + 4 + size), end);
      at += 4 + size;
      end += size;
      continue;
    }
    const [literals, distances] = kind === 1 ? fixed() : own();
    for (let symbol = symbolOf(literals); symbol !== 256; symbol = symbolOf(literals)) {
      if (symbol < 256) {
        text[end++] = symbol;
        continue;
      }
      const times = length.base[symbol - 257] + bits(length.more[symbol - 257]);
      const step = symbolOf(distances);
      const back = distance.base[step] + bits(distance.more[step]);
      for (let k = 0; k < times; ++k, ++end) text[end] = text[end - back];
    }
  }
  if (end !== text.length || at - (heldBits >> 3) !== packed.length - kTrailer) throw new Error('the page is damaged');
  return new TextDecoder().decode(text);
};
