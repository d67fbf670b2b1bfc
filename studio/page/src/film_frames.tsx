// A film frame by frame, with a slider, the grain's position, and a known length to be drawn.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {FileEntry, Line} from './api';
import type {FilmFrames, Tracked} from './film_api';
import {films} from './film_api';

interface Props {
  entry: FileEntry;
  tracked: Tracked | null;
  time_s: number;
  look: (time_s: number) => void;
  line: Line | null;  // of a known length
  draw: ((line: Line) => void) | null;  // null: no scale is needed
}

// Index of the nearest time in a list.
const nearest = (times_s: number[], time_s: number) =>
  times_s.reduce((best, one, k) => (Math.abs(one - time_s) < Math.abs(times_s[best]! - time_s) ? k : best), 0);

export const Frames = ({entry, tracked, time_s, look, line, draw}: Props) => {
  const [film, setFilm] = useState<FilmFrames | null>(null);
  const [trouble, setTrouble] = useState('');
  const svg = useRef<SVGSVGElement>(null);
  const from = useRef<[number, number] | null>(null);
  useEffect(() => {
    setFilm(null);
    films.frames(entry.file).then(setFilm, (error: Error) => setTrouble(error.message));
  }, [entry.file, entry.version]);
  if (!film) return <p role="status">{trouble || 'reading the frames …'}</p>;
  const number = nearest(film.times_s, time_s);
  const shown_s = film.times_s[number] ?? 0;
  const path = tracked?.track?.path ?? [];
  const seen = path.length > 0 ? path[nearest(path.map(([at_s]) => at_s), shown_s)]! : null;
  // Shown within 1.5 frames of where it was seen; before and after that its position is unknown.
  const step_s = film.times_s.length > 1 ? film.times_s[film.times_s.length - 1]! / (film.times_s.length - 1) : 1;
  const is_seen = seen !== null && Math.abs(seen[0] - shown_s) <= 1.5 * step_s;
  const placeAt = (event: PointerEvent): [number, number] => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return [Math.round(at.x), Math.round(at.y)];
  };
  const drawTo = (event: PointerEvent) => {
    const to = placeAt(event);
    if (from.current && draw && Math.hypot(to[0] - from.current[0], to[1] - from.current[1]) > 3) draw([...from.current, ...to]);
  };
  return (
    <div class="frames">
      <div class="viewer">
        <svg ref={svg} viewBox={`0 0 ${film.width} ${film.height}`} style={{aspectRatio: `${film.width} / ${film.height}`}}
          class={draw ? 'tool-length' : ''} role="img" aria-label={`${entry.file} at ${shown_s.toFixed(3)} s`}
          onPointerDown={(event) => { if (draw) { from.current = placeAt(event); svg.current!.setPointerCapture(event.pointerId); } }}
          onPointerMove={drawTo} onPointerUp={(event) => { drawTo(event); from.current = null; }} onPointerCancel={() => { from.current = null; }}>
          <image href={films.frame(entry, number)} width={film.width} height={film.height} preserveAspectRatio="none" />
          {path.length > 1 && <polyline class="way" points={path.map(([, x, y]) => `${x},${y}`).join(' ')} />}
          {is_seen && <circle class="grain" cx={seen[1]} cy={seen[2]} r={film.width / 60} />}
          {line && <line class="length" x1={line[0]} y1={line[1]} x2={line[2]} y2={line[3]} />}
        </svg>
      </div>
      <label class="slider">Frame at {shown_s.toFixed(3)} s
        <input type="range" min="0" max={film.times_s.length - 1} step="1" value={number} aria-valuetext={`${shown_s.toFixed(3)} s`}
          onInput={(event) => look(film.times_s[Number(event.currentTarget.value)]!)} />
      </label>
    </div>
  );
};
