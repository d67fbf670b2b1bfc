// Comparison of two sets of heaps: ticked pictures, or folders within this one.
import {useEffect, useState} from 'preact/hooks';
import type {Compared, Comparison, HeapFolders, SetOfHeaps} from './api';
import {api} from './api';
import {Command} from './result';
import {differenceText, meanText} from './text';

const kPrint_px = 2800;  // 23.7 cm at 300 dots an inch

const Numbers = ({comparison}: {comparison: Comparison}) => (
  <>
    <p class="verdict">{comparison.verdict}</p>
    <p>{differenceText(comparison)}</p>
    {comparison.heaps_to_tell !== null &&
      <p class="hint">If the difference stays as it is, {comparison.heaps_to_tell} heaps in each set would decide.</p>}
    {comparison.sets.map((set, k) => (
      <p><strong>{k === 0 ? 'First set' : 'Second set'}</strong>{set.name.includes('/') && ` (${set.name})`}: {meanText(set)}</p>
    ))}
    {comparison.warnings.map(({code, message}) => <p class="warning" key={code}>{message}</p>)}
  </>
);

const Result = ({compared}: {compared: Compared}) => (
  <>
    <div role="status" aria-live="polite">
      <Numbers comparison={compared.comparison} />
      {compared.notes.map((note) => <p class="hint">{note}</p>)}
    </div>
    {compared.has_figure && (
      <img class="figure" src={api.comparisonFigure(compared.number, 1400)}
        alt={`Both sets' mean outlines and angles. ${differenceText(compared.comparison)}`} />
    )}
    <p class="downloads">
      {compared.has_figure && <a href={api.comparisonFigure(compared.number, kPrint_px)} download="sets.png">Figure for print (PNG)</a>}
      <a href={api.comparisonNumbers(compared.number)} download="sets.json">Numbers (JSON)</a>
    </p>
    <Command text={compared.command} />
  </>
);

export const ComparisonView = ({ticked}: {ticked: [string[], string[]]}) => {
  const [known, setKnown] = useState<HeapFolders | null>(null);
  const [folders, setFolders] = useState<[string, string]>(['', '']);
  const [margin, setMargin] = useState<number | null>(null);
  const [compared, setCompared] = useState<Compared | null>(null);
  const [is_busy, setIsBusy] = useState(false);
  const [error, setError] = useState('');
  useEffect(() => { api.sets().then(setKnown, (why: Error) => setError(why.message)); }, []);
  if (!known) return error ? <p class="reason">{error}</p> : null;

  const setOf = (side: 0 | 1): SetOfHeaps => (folders[side] ? {folder: folders[side]} : {files: ticked[side]});
  const compare = async () => {
    setIsBusy(true);
    setError('');
    try {
      setCompared(await api.compare(setOf(0), setOf(1), margin ?? known.margin_deg));
    } catch (why) {
      setCompared(null);
      setError((why as Error).message);
    }
    setIsBusy(false);
  };
  return (
    <section class="compare" aria-label="Set against set">
      <h2>Set against set</h2>
      <p class="hint">Tick the pictures of the first and of the second set in the table{known.folders.length > 0 && ', or choose folders'}.</p>
      <div class="sides">
        {([0, 1] as const).map((side) => (
          <label>{side === 0 ? 'First set' : 'Second set'}
            <select value={folders[side]} onChange={({currentTarget: {value}}) => setFolders(side === 0 ? [value, folders[1]] : [folders[0], value])}>
              <option value="">ticked in the table: {ticked[side].length}</option>
              {known.folders.map(({folder, kind, heaps}) => <option value={folder}>{folder}: {heaps} {kind}</option>)}
            </select>
          </label>
        ))}
        <label>Negligible, °
          <input type="number" min="0" step="any" value={margin ?? known.margin_deg}
            onChange={({currentTarget}) => setMargin(Number.isFinite(currentTarget.valueAsNumber) ? currentTarget.valueAsNumber : null)} />
        </label>
        <button type="button" class="main" disabled={is_busy} onClick={() => void compare()}>{is_busy ? 'comparing …' : 'Compare'}</button>
      </div>
      {error && <p class="reason" role="alert">{error}</p>}
      {compared && <Result compared={compared} />}
    </section>
  );
};
