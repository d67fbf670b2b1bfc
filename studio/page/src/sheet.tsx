// A sheet of readings as a table to type or paste into, and the numbers of an experiment's protocol:
// checked by the program as they are typed, saved on request.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {NumbersCheck, SheetCheck, SheetData, Study, StudyExperiment} from './study_api';
import {coefficientName, studies} from './study_api';

const kPause_ms = 250;  // after the last key, before checking
const kFewestRows = 10;

const isBlank = (row: string[]) => row.every((cell) => cell.trim() === '');

// Without the empty rows at the end.
const filledOf = (rows: string[][]) => {
  let count = rows.length;
  while (count > 0 && isBlank(rows[count - 1]!)) --count;
  return rows.slice(0, count);
};

// With empty rows below to type into.
const withRoom = (rows: string[][], columns: number) => {
  const filled = filledOf(rows);
  const wanted = Math.max(kFewestRows, filled.length + 1);
  return [...filled, ...Array.from({length: wanted - filled.length}, () => Array<string>(columns).fill(''))];
};

// The clipboard text of spreadsheets: rows of cells separated by tabs.
const pasted = (text: string) => text.replace(/\r\n?/g, '\n').replace(/\n$/, '').split('\n').map((line) => line.split('\t'));

interface Props { study: string; experiment: string; sheet: SheetData; reload: () => Promise<void> }

export const Sheet = ({study, experiment, sheet, reload}: Props) => {
  const names = sheet.columns.map(({name}) => name);
  const [rows, setRows] = useState(() => withRoom(sheet.rows, names.length));
  const [version, setVersion] = useState(sheet.version);
  const [is_changed, setIsChanged] = useState(false);
  const [check, setCheck] = useState<SheetCheck | null>(null);
  const [trouble, setTrouble] = useState('');
  const [told, setTold] = useState('');
  const table = useRef<HTMLTableElement>(null);
  const newest = useRef(0);

  // Changed in the folder but not here.
  useEffect(() => {
    if (sheet.version === version || is_changed) return;
    setRows(withRoom(sheet.rows, names.length));
    setVersion(sheet.version);
  }, [sheet.version]);
  useEffect(() => {
    const number = ++newest.current;
    const timer = setTimeout(() => {
      studies.checkSheet(study, experiment, {columns: names, rows: filledOf(rows)}).then(
        (found) => { if (number === newest.current) { setCheck(found); setTrouble(''); } },
        (error) => { if (number === newest.current) setTrouble((error as Error).message); });
    }, kPause_ms);
    return () => clearTimeout(timer);
  }, [rows]);

  // A newly started row is filled with the study's values for the bench.
  const begun = (row: string[], r: number) =>
    isBlank(rows[r] ?? []) && !isBlank(row) ? row.map((cell, c) => (cell === '' ? sheet.columns[c]!.usual ?? '' : cell)) : row;
  const change = (next: string[][]) => {
    setRows(withRoom(next.map(begun), names.length));
    setIsChanged(true);
    setTold('');
  };
  const type = (r: number, c: number, text: string) => change(rows.map((row, k) => (k === r ? row.map((cell, j) => (j === c ? text : cell)) : row)));
  const paste = (event: ClipboardEvent, r: number, c: number) => {
    const cells = pasted(event.clipboardData?.getData('text/plain') ?? '');
    if (cells.length === 1 && cells[0]!.length === 1) return;  // a single cell: default handling
    event.preventDefault();
    const next = rows.map((row) => [...row]);
    cells.forEach((line, i) => {
      next[r + i] ??= Array<string>(names.length).fill('');
      line.forEach((cell, j) => { if (c + j < names.length) next[r + i]![c + j] = cell.trim(); });
    });
    change(next);
  };
  const go = (event: KeyboardEvent, r: number, c: number) => {
    const step = event.key === 'ArrowUp' ? -1 : event.key === 'ArrowDown' || event.key === 'Enter' ? 1 : 0;
    if (step === 0) return;
    event.preventDefault();
    table.current?.querySelector<HTMLInputElement>(`input[data-cell="${r + step},${c}"]`)?.focus();
  };
  const save = async () => {
    try {
      const saved = await studies.saveSheet(study, experiment, {columns: names, rows: filledOf(rows), version});
      setVersion(saved.version!);
      setCheck(saved);
      setIsChanged(false);
      setTrouble('');
      setTold(`saved in ${sheet.name}`);
      await reload();
    } catch (error) {
      setTrouble((error as Error).message);
    }
  };
  const again = () => {
    setIsChanged(false);
    setRows(withRoom(sheet.rows, names.length));
    setVersion(sheet.version);
    void reload();
  };

  if (sheet.fault) return <p class="reason">{sheet.fault}</p>;
  const faultsOf = (r: number) => check?.faults.filter(({row}) => row === r) ?? [];
  const others = check?.faults.filter(({row}) => row === null) ?? [];
  return (
    <div class="sheet">
      <div class="scrolled" tabIndex={0} role="region" aria-label={`Sheet of ${experiment}`}>
        <table ref={table}>
          <caption class="unseen">Readings of {experiment}. Arrow keys and Enter go from row to row; rows copied in a spreadsheet can be pasted.</caption>
          <thead><tr><th scope="col">no.</th>{sheet.columns.map(({name, what, standing}) => (
            <th key={name} scope="col" class={standing}><code>{name}</code><small>{what}</small></th>
          ))}</tr></thead>
          <tbody>
            {rows.map((row, r) => {
              const faults = faultsOf(r);
              return [
                <tr key={r}>
                  <th scope="row">{r + 1}</th>
                  {row.map((cell, c) => {
                    const is_wrong = faults.some(({column}) => column === c || column === null);
                    return (
                      <td key={c}>
                        <input type="text" inputMode="decimal" value={cell} placeholder={sheet.columns[c]!.usual ?? ''} data-cell={`${r},${c}`} aria-label={`${names[c]}, row ${r + 1}`}
                          aria-invalid={is_wrong} aria-describedby={is_wrong ? `${experiment}-fault-${r}` : undefined}
                          onInput={(event) => type(r, c, event.currentTarget.value)} onPaste={(event) => paste(event, r, c)} onKeyDown={(event) => go(event, r, c)} />
                      </td>
                    );
                  })}
                </tr>,
                faults.length > 0 && (
                  <tr key={`${r}-fault`} class="faults"><td /><td colSpan={names.length} id={`${experiment}-fault-${r}`}>
                    {faults.map(({text}) => <span key={text} class="fault">{text}</span>)}</td></tr>
                ),
              ];
            })}
          </tbody>
        </table>
      </div>
      {others.map(({text}) => <span key={text} class="fault">{text}</span>)}
      {check?.notes.map((note) => <p key={note} class="warning">{note}</p>)}
      {trouble && <p class="trouble" role="alert">{trouble} <button type="button" onClick={again}>Load it again</button></p>}
      <div class="actions">
        <button type="button" class="main" disabled={!is_changed} onClick={() => void save()}>Save the readings</button>
        <span role="status" class="hint">
          {told || (is_changed ? 'not saved yet' : `${check?.readings ?? sheet.rows.length} readings in ${sheet.name}`)}
          {check && check.faults.length > 0 && `, ${check.faults.length} to correct`}
        </span>
      </div>
    </div>
  );
};

// A number in the study file that may be changed.
interface StudyNumber { section: string; key: string; label: string; value: string; absence: string | null; rule: string }

const StudyNumbers = ({study, name, summary, numbers, reload}: {study: Study; name: string; summary: string; numbers: StudyNumber[]; reload: () => Promise<void>}) => {
  const [typed, setTyped] = useState<Record<string, Record<string, string>>>({});
  const [check, setCheck] = useState<NumbersCheck | null>(null);
  const [trouble, setTrouble] = useState('');
  const is_changed = Object.keys(typed).length > 0;
  useEffect(() => {
    if (!is_changed) return;
    const timer = setTimeout(() => {
      studies.checkNumbers(study.study, typed).then(setCheck, (error) => setTrouble((error as Error).message));
    }, kPause_ms);
    return () => clearTimeout(timer);
  }, [typed]);
  const save = async () => {
    try {
      const done = await studies.saveNumbers(study.study, typed, study.version!);
      setCheck(done);
      if (done.saved) setTyped({});
      setTrouble('');
      await reload();
    } catch (error) {
      setTrouble((error as Error).message);
    }
  };
  if (numbers.length === 0) return null;
  const others = check?.faults.filter(({key}) => !numbers.some((one) => key === `${one.section}.${one.key}`)) ?? [];
  return (
    <details class={`protocol ${name}`}>
      <summary>{summary}</summary>
      <table>
        <thead><tr><th scope="col">key of the study</th><th scope="col">value</th><th scope="col">what it may be</th></tr></thead>
        <tbody>
          {numbers.map(({section, key, label, value, absence, rule}) => {
            const faults = check?.faults.filter((fault) => fault.key === `${section}.${key}`) ?? [];
            return (
              <tr key={`${section}.${key}`}>
                <th scope="row"><code>{label}</code></th>
                <td><input type="text" inputMode="decimal" aria-label={`${label} of ${name}`} value={typed[section]?.[key] ?? value} placeholder={absence ?? ''}
                  aria-invalid={faults.length > 0} onInput={(event) => setTyped({...typed, [section]: {...typed[section], [key]: event.currentTarget.value}})} /></td>
                <td class="hint">{rule}{absence !== null && `; empty: ${absence}`}
                  {faults.map(({text}) => <span key={text} class="fault">{text}</span>)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
      {is_changed && others.map(({text}) => <span key={text} class="fault">{text}</span>)}
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      <div class="actions">
        <button type="button" class="main" disabled={!is_changed} onClick={() => void save()}>Save in the study</button>
        <span role="status" class="hint">{is_changed ? 'not saved yet' : check?.saved ? `saved in ${study.study}` : ''}</span>
      </div>
    </details>
  );
};

export const Protocol = ({study, experiment, reload}: {study: Study; experiment: StudyExperiment; reload: () => Promise<void>}) => (
  <StudyNumbers study={study} name={experiment.experiment} reload={reload}
    summary={`How it was done: ${experiment.keys.filter(({value}) => value !== '').map(({key, value}) => `${key} ${value}`).join(', ')}`}
    numbers={experiment.keys.map(({key, value, example, rule, absence}) => ({section: `experiment.${experiment.experiment}`, key, label: key, value, absence, rule: `${rule}, such as ${example}`}))} />
);

// The bounds of each fitted coefficient, and its value before the fit.
export const Bounds = ({study, reload}: {study: Study; reload: () => Promise<void>}) => (
  <StudyNumbers study={study} name="bounds" reload={reload} summary="Which coefficients are sought, and between which bounds"
    numbers={(study.sought ?? []).flatMap((one) => (['value', 'min', 'max'] as const).filter((key) => one[key] !== null).map((key) => (
      {section: one.name, key, label: `${coefficientName(one.name)}: ${key}`, value: `${one[key]}`, absence: null,
        rule: key === 'value' ? 'for simulations before it is fitted' : key === 'min' ? 'lower bound' : 'upper bound'})))} />
);
