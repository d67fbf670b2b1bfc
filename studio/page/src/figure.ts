// Saves a drawing of the page as a file, in print colours whatever the page's theme.

const kInk = '#1c1d20', kSoft = '#55585e', kMean = '#00538f', kOk = '#00614a', kFlagged = '#8a4b00';
const kPaint: [string, Record<string, string>][] = [
  ['text', {fill: kSoft, 'font-size': '13', 'font-family': 'sans-serif', 'text-anchor': 'middle'}],
  ['.axis, .tick line', {stroke: kSoft}],
  ['rect.mean', {fill: kMean, opacity: '0.18'}],
  ['line.mean', {stroke: kMean, 'stroke-width': '2'}],
  ['.dot line', {stroke: kInk, 'stroke-width': '2'}],
  ['.dot.ok line', {stroke: kOk}], ['.dot.ok circle', {fill: kOk}],
  ['.dot.flagged line', {stroke: kFlagged}], ['.dot.flagged circle', {fill: kFlagged}],
];
// 16.9 cm, the text width of a printed page, at 300 dpi.
const kPrint_px = 2000;
const kWide_mm = 169;

const printed = (drawing: SVGSVGElement) => {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  for (const [where, attributes] of kPaint) {
    for (const element of copy.querySelectorAll(where)) {
      for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    }
  }
  const {width, height} = drawing.viewBox.baseVal;
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  copy.setAttribute('width', `${kWide_mm}mm`);
  copy.setAttribute('height', `${kWide_mm * height / width}mm`);
  return {blob: new Blob([new XMLSerializer().serializeToString(copy)], {type: 'image/svg+xml'}), shape: height / width};
};

const save = (blob: Blob, name: string) => {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
};

export const saveVector = (drawing: SVGSVGElement, name: string) => save(printed(drawing).blob, name);

export const savePicture = async (drawing: SVGSVGElement, name: string) => {
  const {blob, shape} = printed(drawing);
  const address = URL.createObjectURL(blob);
  const picture = new Image();
  picture.src = address;
  await picture.decode();
  URL.revokeObjectURL(address);
  const canvas = document.createElement('canvas');
  canvas.width = kPrint_px;
  canvas.height = Math.round(kPrint_px * shape);
  const paper = canvas.getContext('2d')!;
  paper.fillStyle = '#ffffff';
  paper.fillRect(0, 0, canvas.width, canvas.height);
  paper.drawImage(picture, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((png) => png && save(png, name), 'image/png');
};
