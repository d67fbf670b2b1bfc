// All files as repeats of one experiment: their mean, a dot for each, a table to sort.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {Answer, FileEntry, Folder, Measured, SetSummary} from './api';
import {api} from './api';
import {ComparisonView} from './comparison';
import {savePicture, saveVector} from './figure';
import {Badge, Command} from './result';
import {angleText, meanText} from './text';

interface Row {
  entry: FileEntry;
  measured: Measured;
  rotate_deg: number;
}

// Stacks dots that would overlap.
const stacked = (rows: Row[], low: number, wide: number) => {
  const ends: number[] = [];
  return rows.map((row) => {
    const from = (row.measured.angle_deg! - (row.measured.uncertainty_deg ?? 0) - low) / wide;
    const to = (row.measured.angle_deg! + (row.measured.uncertainty_deg ?? 0) - low) / wide;
    let level = ends.findIndex((end) => end < from - 0.02);
    if (level < 0) level = ends.length;
    ends[level] = to;
    return {row, level};
  });
};

const steps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20];

const DotPlot = ({rows, set, choose}: {rows: Row[]; set: SetSummary; choose: (file: string) => void}) => {
  const measured = rows.filter(({measured: {angle_deg}}) => angle_deg !== null)
    .sort((a, b) => a.measured.angle_deg! - b.measured.angle_deg!);
  if (measured.length === 0) return null;
  const ends = measured.flatMap(({measured: {angle_deg, uncertainty_deg}}) =>
    [angle_deg! - (uncertainty_deg ?? 0), angle_deg! + (uncertainty_deg ?? 0)]);
  const low = Math.min(...ends, set.interval_deg?.[0] ?? Infinity), high = Math.max(...ends, set.interval_deg?.[1] ?? -Infinity);
  const wide = Math.max(high - low, 1);
  const kLeft = 24, kWidth = 752, kRow = 16;
  const dots = stacked(measured, low, wide);
  const levels = Math.max(...dots.map(({level}) => level)) + 1;
  const bottom = 30 + levels * kRow;
  const at = (angle: number) => kLeft + kWidth * (angle - low) / wide;
  const step = steps.find((one) => wide / one <= 8) ?? 20;
  const ticks: number[] = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high; tick += step) ticks.push(tick);
  return (
    <svg class="dots" viewBox={`0 0 800 ${bottom + 44}`} role="img" aria-label={`Angles of ${measured.length} pictures: ${meanText(set)}`}>
      {set.interval_deg && <rect class="mean" x={at(set.interval_deg[0])} width={at(set.interval_deg[1]) - at(set.interval_deg[0])} y="8" height={bottom - 8} />}
      {set.mean_deg !== null && <line class="mean" x1={at(set.mean_deg)} x2={at(set.mean_deg)} y1="8" y2={bottom} />}
      {dots.map(({row: {entry, measured: one}, level}) => {
        const y = bottom - 12 - level * kRow;
        const half = one.uncertainty_deg ?? 0;
        return (
          <g class={`dot ${one.status}`} onClick={() => choose(entry.file)}>
            <title>{`${entry.file}: ${angleText(one)}, ${one.status}`}</title>
            <line x1={at(one.angle_deg! - half)} x2={at(one.angle_deg! + half)} y1={y} y2={y} />
            <circle cx={at(one.angle_deg!)} cy={y} r="5" />
          </g>
        );
      })}
      <line class="axis" x1={kLeft} x2={kLeft + kWidth} y1={bottom} y2={bottom} />
      {ticks.map((tick) => (
        <g class="tick"><line x1={at(tick)} x2={at(tick)} y1={bottom} y2={bottom + 5} />
          <text x={at(tick)} y={bottom + 20}>{tick.toFixed(step < 1 ? 1 : 0)}</text></g>
      ))}
      <text class="title" x={kLeft + kWidth / 2} y={bottom + 40}>angle of repose, °; lines: 95 % intervals of single heaps; band: of the mean</text>
    </svg>
  );
};

type Key = 'file' | 'status' | 'angle' | 'left' | 'right';

const valueOf = ({entry, measured}: Row, key: Key): string | number => {
  switch (key) {
    case 'file': return entry.file;
    case 'status': return measured.status;
    case 'angle': return measured.angle_deg ?? Infinity;
    case 'left': return measured.left?.angle_deg ?? Infinity;
    case 'right': return measured.right?.angle_deg ?? Infinity;
  }
};

const kColumns: {key: Key; name: string}[] = [
  {key: 'file', name: 'picture'}, {key: 'status', name: 'status'}, {key: 'angle', name: 'angle'},
  {key: 'left', name: 'left'}, {key: 'right', name: 'right'},
];

interface Props {
  folder: Folder;
  files: FileEntry[];
  answers: Map<string, Answer>;
  choose: (file: string) => void;
}

export const SetView = ({folder, files, answers, choose}: Props) => {
  const [set, setSet] = useState<SetSummary | null>(null);
  const [error, setError] = useState('');
  const [ticked, setTicked] = useState<[Set<string>, Set<string>]>([new Set(), new Set()]);
  const plot = useRef<HTMLDivElement>(null);
  const [order, setOrder] = useState<{key: Key; down: boolean}>({key: 'file', down: false});
  const tick = (side: 0 | 1, file: string) => setTicked((before) => {
    const after = new Set(before[side]);
    if (!after.delete(file)) after.add(file);
    return side === 0 ? [after, before[1]] : [before[0], after];
  });
  const inOrder = (side: 0 | 1) => files.map(({file}) => file).filter((file) => ticked[side].has(file));
  const versions = files.map(({version}) => version).join();
  const missing = files.filter(({file}) => !answers.has(file)).length;
  useEffect(() => {
    if (missing > 0) return;
    let is_wanted = true;
    api.set().then((found) => is_wanted && setSet(found), (why: Error) => is_wanted && setError(why.message));
    return () => { is_wanted = false; };
  }, [versions, missing]);
  const rows = files.flatMap((entry): Row[] => {
    const answer = answers.get(entry.file);
    return answer ? [{entry, measured: answer.measured, rotate_deg: answer.told?.rotate_deg ?? 0}] : [];
  });
  const sorted = [...rows].sort((a, b) => {
    const [one, other] = [valueOf(a, order.key), valueOf(b, order.key)];
    const sign = one < other ? -1 : one > other ? 1 : 0;
    return order.down ? -sign : sign;
  });
  const cell = (measured: Measured, side: 'left' | 'right') => {
    const one = measured[side];
    return !one ? '–' : one.angle_deg === null ? one.status : angleText(one);
  };
  return (
    <section class="set" aria-label="Set">
      <div role="status" aria-live="polite">
        {error && <p class="reason">{error}</p>}
        {missing > 0 ? <p>{missing} of {files.length} still to be measured …</p> : set && <>
          <p class="angle">{set.mean_deg === null ? 'no mean' : `${set.mean_deg.toFixed(2)}°`}</p>
          <p>{meanText(set)}</p>
          <p class="hint">{[
            set.flagged ? `${set.flagged} of these flagged: look at them` : '',
            set.refused ? `${set.refused} refused` : '', set.not_read ? `${set.not_read} not read` : '',
            set.copies ? `${set.copies} copies of others, counted once` : '',
            ...set.outliers.map((one) => `${one.file.split('/').pop()} is an outlier${one.counted ? ', counted' : ', left out'}`),
          ].filter(Boolean).join('; ')}</p>
        </>}
      </div>
      {set && missing === 0 && <div ref={plot}><DotPlot rows={rows} set={set} choose={choose} /></div>}
      <p class="downloads">
        {set?.mean_deg != null && missing === 0 && <>
          <button type="button" class="link" onClick={() => saveVector(plot.current!.querySelector('svg')!, 'angles.svg')}>Plot as SVG</button>
          <button type="button" class="link" onClick={() => void savePicture(plot.current!.querySelector('svg')!, 'angles.png')}>Plot as PNG</button>
        </>}
        <a href="/files/angles.xlsx" download="angles.xlsx">Table as XLSX</a>
        <a href="/files/angles.csv" download="angles.csv">Table as CSV</a>
        <a href="/files/photos.html" download="photos.html">Photo report</a>
      </p>
      <Command text={folder.command} />
      <ComparisonView ticked={[inOrder(0), inOrder(1)]} />
      <div class="scrolled" tabIndex={0} role="region" aria-label="Table of pictures">
        <table>
          <thead><tr><th><span class="unseen">look</span></th>
            {kColumns.map(({key, name}) => (
              <th aria-sort={order.key === key ? (order.down ? 'descending' : 'ascending') : 'none'}>
                <button type="button" onClick={() => setOrder({key, down: order.key === key && !order.down})}>
                  {name}{order.key === key ? (order.down ? ' ↓' : ' ↑') : ''}</button>
              </th>
            ))}
            <th>1st set</th><th>2nd set</th></tr></thead>
          <tbody>
            {sorted.map(({entry, measured, rotate_deg}) => (
              <tr key={entry.file}>
                <td><img src={api.picture(entry, 160, rotate_deg)} alt="" loading="lazy" /></td>
                <td><button type="button" class="link" onClick={() => choose(entry.file)}>{entry.file}</button></td>
                <td><Badge status={measured.status} /></td>
                <td>{angleText(measured)}</td>
                <td>{cell(measured, 'left')}</td>
                <td>{cell(measured, 'right')}</td>
                {([0, 1] as const).map((side) => (
                  <td class="tick"><input type="checkbox" checked={ticked[side].has(entry.file)} onChange={() => tick(side, entry.file)}
                    aria-label={`${entry.file} in the ${side === 0 ? 'first' : 'second'} set`} /></td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
};
