// A film of a drop, a roll or a tilt: tracked when viewed; its readings go into a study's sheet.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {FileEntry, Line} from './api';
import type {Bounce, Experiment, FilmTold, TrackAnswer, Tracked} from './film_api';
import {films} from './film_api';
import {Frames} from './film_frames';
import {Badge, Command} from './result';
import {studies} from './study_api';
import {Numbers} from './tools';

const kPause_ms = 250;  // after the last change, before tracking

export type Filmed = 'heap' | Experiment;

const kFilmed: [Filmed, string][] = [['heap', 'Heap'], ['drop', 'Drop'], ['roll', 'Roll'], ['tilt', 'Tilt']];

/** Guessed from the file name until the user chooses. */
export const filmedByName = (file: string): Filmed =>
  kFilmed.find(([filmed]) => filmed !== 'heap' && file.toLowerCase().startsWith(filmed))?.[0] ?? 'heap';

export const FilmedChoice = ({filmed, choose}: {filmed: Filmed; choose: (filmed: Filmed) => void}) => (
  <div class="tools" role="group" aria-label="What is filmed">
    {kFilmed.map(([one, name]) => <button key={one} type="button" aria-pressed={one === filmed} onClick={() => choose(one)}>{name}</button>)}
  </div>
);

const within = (value: number, half: number, digits: number) => `${value.toFixed(digits)} ± ${half.toFixed(digits)}`;

const Bounces = ({bounces, chosen, choose, look}: {bounces: Bounce[]; chosen: number[]; choose: (chosen: number[]) => void; look: (time_s: number) => void}) => (
  <div class="scrolled" tabIndex={0} role="region" aria-label="Bounces">
    <table class="bounces">
      <thead><tr><th scope="col">counts</th><th scope="col">bounce</th><th scope="col">drop [mm]</th><th scope="col">rebound [mm]</th><th scope="col">restitution</th></tr></thead>
      <tbody>
        {bounces.map((bounce) => {
          const is_chosen = chosen.includes(bounce.number);
          return (
            <tr key={bounce.number} class={is_chosen ? '' : 'struck'}>
              <td class="tick"><input type="checkbox" checked={is_chosen} aria-label={`Bounce ${bounce.number} counts`}
                onChange={() => choose(is_chosen ? chosen.filter((one) => one !== bounce.number) : [...chosen, bounce.number])} /></td>
              <th scope="row"><button type="button" class="link" onClick={() => look(bounce.time_s)}>{bounce.number}, at {bounce.time_s.toFixed(3)} s</button></th>
              <td>{within(bounce.drop_mm, bounce.drop_uncertainty_mm, 1)}</td>
              <td>{within(bounce.rebound_mm, bounce.rebound_uncertainty_mm, 1)}</td>
              <td>{within(bounce.restitution, bounce.restitution_uncertainty, 3)}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  </div>
);

const kRead: Record<Experiment, string> = {drop: 'restitution', roll: 'along the flat', tilt: 'slides at'};

const headline = ({experiment, bounces, roll, tilt}: Tracked) => {
  const first = bounces?.find(({number}) => number === 1);
  if (experiment === 'drop') return first ? within(first.restitution, first.restitution_uncertainty, 3) : 'no first bounce';
  if (experiment === 'roll') return roll ? `${within(roll.stopped_mm, roll.stopped_uncertainty_mm, 1)} mm` : 'no roll';
  return tilt ? `${within(tilt.angle_deg, tilt.angle_uncertainty_deg, 2)}°` : 'no slide';
};

// Further results of a roll or a tilt besides its reading.
const Besides = ({tracked: {roll, tilt}, look}: {tracked: Tracked; look: (time_s: number) => void}) => (
  <table>
    <tbody>
      {roll && <tr><th scope="row">incline</th><td>{within(roll.incline_deg, roll.incline_uncertainty_deg, 1)}°</td></tr>}
      {roll && <tr><th scope="row">released</th><td>{within(roll.released_mm, roll.released_uncertainty_mm, 1)} mm up the incline</td></tr>}
      {roll && <tr><th scope="row">stopped</th><td><button type="button" class="link" onClick={() => look(roll.stopped_s)}>at {roll.stopped_s.toFixed(2)} s</button></td></tr>}
      {tilt && <tr><th scope="row">tilted at</th><td>{within(tilt.rate_deg_s, tilt.rate_uncertainty_deg_s, 3)} °/s</td></tr>}
      {tilt && <tr><th scope="row">slides</th><td><button type="button" class="link" onClick={() => look(tilt.onset_s)}>from {tilt.onset_s.toFixed(2)} s on</button></td></tr>}
    </tbody>
  </table>
);

const ToSheet = ({answer, chosen}: {answer: TrackAnswer; chosen: number[]}) => {
  const [heads, setHeads] = useState<{study: string; title: string}[]>([]);
  const [study, setStudy] = useState('');
  const [told, setTold] = useState('');
  const [trouble, setTrouble] = useState('');
  useEffect(() => {
    studies.list().then(({studies: all}) => {
      const known = all.filter(({is_table}) => !is_table);
      setHeads(known);
      setStudy(known[0]?.study ?? '');
    }, (error: Error) => setTrouble(error.message));
  }, []);
  useEffect(() => { setTold(''); setTrouble(''); }, [answer.number, chosen.join(), study]);
  if (heads.length === 0) return <p class="hint">{trouble || 'Once there is a study in this folder, its sheet can be given these readings.'}</p>;
  const give = async () => {
    try {
      const given = await films.toSheet(answer.number, study, chosen);
      setTrouble('');
      setTold(`${given.rows === 1 ? 'One reading' : `${given.rows} readings`} put into ${given.sheet}`);
    } catch (error) {
      setTold('');
      setTrouble((error as Error).message);
    }
  };
  const {experiment, bounces, roll, tilt} = answer.tracked;
  const has_reading = experiment === 'drop' ? (bounces ?? []).some(({number}) => chosen.includes(number)) : !!(roll ?? tilt);
  return (
    <section class="to-sheet" aria-label="Into a study">
      <h3>Into a study</h3>
      <div class="actions">
        <label>Study <select value={study} onChange={(event) => setStudy(event.currentTarget.value)}>{heads.map((head) => <option key={head.study} value={head.study}>{head.title}</option>)}</select></label>
        <button type="button" class="main" disabled={!has_reading} onClick={() => void give()}>Put into its sheet</button>
      </div>
      <p role="status" class="hint">{told || (has_reading ? 'A film that is there already is replaced.' : 'There is no reading that counts.')}</p>
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
    </section>
  );
};

// Where the scale comes from.
const Millimetres = ({told, line, tell, draw}: {told: FilmTold; line: Line | null; tell: (part: Partial<FilmTold>) => void; draw: (line: Line | null) => void}) => (
  <section class="fields" aria-label="Millimetres">
    <h3>Millimetres</h3>
    <p class="hint">{told.experiment === 'drop' ? 'By gravity and the frame rate, unless a length is known: drag along it in a frame, and say below how many mm it is.'
      : 'Say how far up the incline the grain was let go; or drag along a known length in a frame, and say how many mm it is.'}</p>
    <Numbers label="Known length: x1, y1, x2, y2" value={line ?? []} counts={(n) => n === 4} tell={(n) => draw(n.length ? n as Line : null)} />
    {line && <Numbers label="Its length, mm" value={told.scale ? [told.scale.length_mm] : []} counts={(n) => n === 1}
      tell={(n) => tell({scale: n.length ? {line, length_mm: n[0]!} : null, board: false})} />}
    {told.experiment === 'roll' && <Numbers label="Released, mm up the incline from its foot" value={told.released_mm === null ? [] : [told.released_mm]} counts={(n) => n === 1}
      tell={(n) => tell({released_mm: n[0] ?? null})} />}
    <label class="check"><input type="checkbox" checked={told.board} onChange={(event) => tell({board: event.currentTarget.checked, scale: null})} />
      a printed board stands in the picture</label>
  </section>
);

export const FilmView = ({entry, experiment, choose}: {entry: FileEntry; experiment: Experiment; choose: (filmed: Filmed) => void}) => {
  const [told, setTold] = useState<FilmTold>({experiment, scale: null, board: false, released_mm: null});
  const [line, setLine] = useState<Line | null>(null);  // as drawn; its length may not be given yet
  const [answer, setAnswer] = useState<TrackAnswer | null>(null);
  const [reason, setReason] = useState('');
  const [chosen, setChosen] = useState<number[]>([]);
  const [time_s, setTime] = useState(0);
  const newest = useRef(0);
  useEffect(() => {
    const number = ++newest.current;
    const is_mine = () => number === newest.current;
    setAnswer(null);
    setReason('');
    const timer = setTimeout(() => void films.track(entry.file, told).then((found) => {
      if (!is_mine()) return;
      setAnswer(found);
      // Only the first bounce follows a fall from the height that the study states.
      setChosen((found.tracked.bounces ?? []).filter((bounce) => bounce.number === 1).map((bounce) => bounce.number));
    }, (error: Error) => { if (is_mine()) setReason(error.message); }), kPause_ms);
    return () => clearTimeout(timer);
  }, [entry.file, entry.version, told]);
  const tracked = answer?.tracked ?? null;
  // The length is kept if the line is redrawn.
  const draw = (drawn: Line | null) => {
    setLine(drawn);
    if (told.scale || told.board) setTold({...told, scale: drawn && told.scale && {...told.scale, line: drawn}, board: false});
  };
  return (
    <>
      <section class="picture" aria-label={entry.file}>
        <h2>{entry.file}</h2>
        <FilmedChoice filmed={experiment} choose={choose} />
        {answer ? <div class="viewer strobe"><img src={films.overlay(answer.number)} alt={`${entry.file} with what was tracked`} /></div> : <p role="status">{reason ? '' : 'tracking …'}</p>}
        <Frames entry={entry} tracked={tracked} time_s={time_s} look={setTime} line={line} draw={experiment === 'tilt' ? null : draw} />
      </section>
      <aside>
        <section class="result" aria-label="Result">
          <div role="status" aria-live="polite">
            {tracked && <p class="hint">{kRead[experiment]}</p>}
            {tracked && <p class="angle">{headline(tracked)} <Badge status={tracked.status} /></p>}
            {(tracked?.reason ?? reason) && <p class="reason">{tracked?.reason ?? reason}</p>}
          </div>
          {tracked?.bounces && tracked.bounces.length > 0 && <Bounces bounces={tracked.bounces} chosen={chosen} choose={setChosen} look={setTime} />}
          {tracked?.unread_bounces?.map(({number, time_s: at_s}) => <p key={number} class="hint">Bounce {number}{at_s !== null && `, at about ${at_s.toFixed(2)} s,`} was not read.</p>)}
          {tracked && (tracked.roll ?? tracked.tilt) && <Besides tracked={tracked} look={setTime} />}
          {tracked?.warnings.map(({code, message}) => <p class="warning" key={code}>{message}</p>)}
          {experiment !== 'tilt' && <Millimetres told={told} line={line} tell={(part) => setTold({...told, ...part})} draw={draw} />}
          {answer && <ToSheet answer={answer} chosen={chosen} />}
          {answer && <Command text={answer.command} />}
        </section>
      </aside>
    </>
  );
};
