// The picture with its measurement drawn in, and the tools for hints: zoomed by wheel, pinch and keys,
// moved by dragging.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {Box, BrushStroke, FileEntry, Line, Marks, Place, Told} from './api';
import {api} from './api';

export type Tool = 'move' | 'box' | 'ground' | 'keep' | 'drop' | 'paint' | 'exclude' | 'length';

// What the brush marks, and its width as a fraction of the picture's height.
export interface Brush {
  says: BrushStroke['says'];
  width: number;
}

// The visible part of the picture.
interface View {
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Props {
  entry: FileEntry;
  marks: Marks | null;
  told: Told | null;
  tool: Tool;
  brush: Brush;
  // Called when the hints change; `ends` when the pointer is released.
  tell: (told: Told, ends: boolean) => void;
}

const whole = (marks: Marks): View => ({x: 0, y: 0, width: marks.width, height: marks.height});
const points = (places: Place[]) => places.map(([x, y]) => `${x},${y}`).join(' ');
const round = (value: number) => Math.round(value);

const boxBetween = ([x1, y1]: Place, [x2, y2]: Place): Box =>
  [round(Math.min(x1, x2)), round(Math.min(y1, y2)), round(Math.abs(x2 - x1)), round(Math.abs(y2 - y1))];

// The hints after dragging from one position to another.
const toldByDrag = (tool: Tool, told: Told, from: Place, to: Place): Told => {
  const line: Line = [round(from[0]), round(from[1]), round(to[0]), round(to[1])];
  switch (tool) {
    case 'box': return {...told, heap: boxBetween(from, to)};
    case 'exclude': return {...told, exclude: [...told.exclude, boxBetween(from, to)]};
    case 'ground': return {...told, ground: line};
    case 'length': return {...told, board: false, scale: {line, length_mm: told.scale?.length_mm ?? null}};
    default: return told;
  }
};

const toldByClick = (tool: Tool, told: Told, [x, y]: Place): Told => {
  const place: Place = [round(x), round(y)];
  if (tool === 'keep') return {...told, keep: [...told.keep, place]};
  if (tool === 'drop') return {...told, drop: [...told.drop, place]};
  return told;
};

const Stroke = ({line, name}: {line: Line | null; name: string}) =>
  line && <line class={name} x1={line[0]} y1={line[1]} x2={line[2]} y2={line[3]} />;

const Drawn = ({marks}: {marks: Marks}) => (
  <g class="drawn">
    {marks.outline.length > 2 && <polygon class="outline" points={points(marks.outline)} />}
    <Stroke line={marks.ground} name="ground" />
    <Stroke line={marks.left.apron_line} name="apron left" />
    <Stroke line={marks.right.apron_line} name="apron right" />
    <Stroke line={marks.left.line} name="flank left" />
    <Stroke line={marks.right.line} name="flank right" />
  </g>
);

const Said = ({told, size}: {told: Told; size: number}) => (
  <g class="said">
    {told.heap && <rect class="heap" x={told.heap[0]} y={told.heap[1]} width={told.heap[2]} height={told.heap[3]} />}
    {told.exclude.map(([x, y, width, height]) => (
      <g class="exclude">
        <rect x={x} y={y} width={width} height={height} />
        <line x1={x} y1={y} x2={x + width} y2={y + height} />
        <line x1={x} y1={y + height} x2={x + width} y2={y} />
      </g>
    ))}
    {told.keep.map(([x, y]) => <circle class="keep" cx={x} cy={y} r={size} />)}
    {told.drop.map(([x, y]) => (
      <path class="drop" d={`M${x - size},${y - size}l${2 * size},${2 * size}m0,${-2 * size}l${-2 * size},${2 * size}`} />
    ))}
    <Stroke line={told.scale?.line ?? null} name="length" />
  </g>
);

// Painted areas: those saved as a mask, whose grey does not show, and those not saved yet.
const Painted = ({entry, told, marks}: {entry: FileEntry; told: Told; marks: Marks}) => (
  <g class="painted">
    {told.has_mask && (
      <image class="mask" href={api.mask(entry.file, entry.version)} width={marks.width} height={marks.height} preserveAspectRatio="none" />
    )}
    {told.painted.map(({says, width, path}) => (
      <polyline class={says} points={points(path.length === 1 ? [...path, ...path] : path)} style={{strokeWidth: `${width}px`}} />
    ))}
  </g>
);

// The draggable ends of a line.
const Ends = ({line, name, size}: {line: Line; name: string; size: number}) => (
  <>
    <circle class={`handle ${name}`} data-end="0" cx={line[0]} cy={line[1]} r={size} />
    <circle class={`handle ${name}`} data-end="1" cx={line[2]} cy={line[3]} r={size} />
  </>
);

export const Viewer = ({entry, marks, told, tool, brush, tell}: Props) => {
  const svg = useRef<SVGSVGElement>(null);
  const [view, setView] = useState<View | null>(null);
  // Positions of the pointers, and the state when they went down.
  const hands = useRef(new Map<number, Place>());
  const drag = useRef<{from: Place; told: Told; view: View; end: number | null} | null>(null);
  const stroke = useRef<Place[]>([]);  // being painted
  const shape = marks ? `${marks.width}x${marks.height}` : '';
  useEffect(() => setView(null), [entry.file, shape]);

  const shown = view ?? (marks ? whole(marks) : null);
  const placeAt = (event: PointerEvent | WheelEvent, within: View): Place => {
    const area = svg.current!.getBoundingClientRect();
    const scale = Math.min(area.width / within.width, area.height / within.height);
    return [within.x + within.width / 2 + (event.clientX - area.x - area.width / 2) / scale,
      within.y + within.height / 2 + (event.clientY - area.y - area.height / 2) / scale];
  };
  const zoomed = (from: View, factor: number, [x, y]: Place): View => {
    const most = marks!.width;
    const by = Math.min(Math.max(factor, most / 40 / from.width), most / from.width);
    return {x: x - (x - from.x) * by, y: y - (y - from.y) * by, width: from.width * by, height: from.height * by};
  };

  // Not passive: the page must not scroll.
  useEffect(() => {
    const element = svg.current;
    if (!element || !shown) return;
    const turn = (event: WheelEvent) => {
      event.preventDefault();
      setView(zoomed(shown, Math.exp(event.deltaY / 400), placeAt(event, shown)));
    };
    element.addEventListener('wheel', turn, {passive: false});
    return () => element.removeEventListener('wheel', turn);
  });

  if (!marks || !told || !shown) {
    return <div class="viewer"><img src={api.picture(entry, 1600, 0)} alt={`${entry.file} with what was measured`} /></div>;
  }
  const area = svg.current?.getBoundingClientRect();
  const pixel = area && area.width > 0 ? Math.max(shown.width / area.width, shown.height / area.height) : shown.width / 800;
  const ground = told.ground ?? marks.ground;
  const moved = (line: Line, end: number, [x, y]: Place): Line =>
    end === 0 ? [round(x), round(y), line[2], line[3]] : [line[0], line[1], round(x), round(y)];

  const paintedTo = (from: Told, place: Place): Told => {
    stroke.current = [...stroke.current, [round(place[0]), round(place[1])]];
    return {...from, painted: [...from.painted, {says: brush.says, width: round(brush.width * marks.height), path: stroke.current}]};
  };
  const down = (event: PointerEvent) => {
    const place = placeAt(event, shown);
    stroke.current = [];
    hands.current.set(event.pointerId, [event.clientX, event.clientY]);
    svg.current!.setPointerCapture(event.pointerId);
    const end = (event.target as Element).getAttribute('data-end');
    drag.current = {from: place, told, view: shown, end: end === null ? null : Number(end)};
  };
  const move = (event: PointerEvent) => {
    const before = hands.current.get(event.pointerId);
    const began = drag.current;
    if (!before || !began) return;
    if (hands.current.size === 2) {
      const other = [...hands.current].find(([id]) => id !== event.pointerId)![1];
      const apart = (hand: Place) => Math.hypot(hand[0] - other[0], hand[1] - other[1]);
      const now: Place = [event.clientX, event.clientY];
      setView(zoomed(shown, apart(before) / Math.max(1, apart(now)), placeAt(event, shown)));
      hands.current.set(event.pointerId, now);
      return;
    }
    const place = placeAt(event, tool === 'move' && began.end === null ? began.view : shown);
    if (began.end !== null && tool === 'ground' && ground) {
      tell({...began.told, ground: moved(began.told.ground ?? marks.ground ?? ground, began.end, place)}, false);
    } else if (began.end !== null && tool === 'length' && told.scale) {
      tell({...began.told, scale: {...told.scale, line: moved(told.scale.line, began.end, place)}}, false);
    } else if (tool === 'paint') {
      tell(paintedTo(began.told, place), false);
    } else if (tool === 'move') {
      setView({...began.view, x: began.view.x + began.from[0] - place[0], y: began.view.y + began.from[1] - place[1]});
    } else if (Math.hypot(place[0] - began.from[0], place[1] - began.from[1]) > 4 * pixel) {
      tell(toldByDrag(tool, began.told, began.from, place), false);
    }
  };
  const up = (event: PointerEvent) => {
    const began = drag.current;
    hands.current.delete(event.pointerId);
    if (hands.current.size > 0 || !began) return;
    drag.current = null;
    const place = placeAt(event, shown);
    const click = tool === 'paint' ? paintedTo(began.told, place) : toldByClick(tool, told, place);
    if (click !== told || told !== began.told) tell(click, true);
  };

  return (
    <div class="viewer">
      <svg ref={svg} viewBox={`${shown.x} ${shown.y} ${shown.width} ${shown.height}`} class={`tool-${tool}`}
        style={{aspectRatio: `${marks.width} / ${marks.height}`}} role="img" aria-label={`${entry.file} with what was measured`}
        onPointerDown={down} onPointerMove={move} onPointerUp={up} onPointerCancel={up}>
        <image href={api.picture(entry, 2400, told.rotate_deg)} width={marks.width} height={marks.height} preserveAspectRatio="none" />
        <Painted entry={entry} told={told} marks={marks} />
        <Drawn marks={marks} />
        <Said told={told} size={7 * pixel} />
        {tool === 'ground' && ground && <Ends line={ground} name="ground" size={9 * pixel} />}
        {tool === 'length' && told.scale && <Ends line={told.scale.line} name="length" size={9 * pixel} />}
      </svg>
      <div class="zoom" role="group" aria-label="Zoom">
        <button type="button" onClick={() => setView(zoomed(shown, 0.7, [shown.x + shown.width / 2, shown.y + shown.height / 2]))} aria-label="Larger">+</button>
        <button type="button" onClick={() => setView(zoomed(shown, 1.4, [shown.x + shown.width / 2, shown.y + shown.height / 2]))} aria-label="Smaller">−</button>
        <button type="button" onClick={() => setView(null)}>Whole</button>
      </div>
    </div>
  );
};
