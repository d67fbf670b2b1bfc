// A calibration: time estimate, start, progress, stop and resume; its results and files.
import {useState} from 'preact/hooks';
import type {Calibration, Estimate, FoundParameter, Progress, Study, Task} from './study_api';
import {coefficientName, durationText, isAtWork, studies} from './study_api';
import {useCalibration} from './watched';


// Bounds as a line, an interval as a bar on it, the value as a dot.
const Strip = ({bounds, interval, value, label}: {bounds: [number, number]; interval: [number, number] | null; value: number | null; label: string}) => {
  const at = (number: number) => 4 + 192 * Math.min(1, Math.max(0, (number - bounds[0]) / (bounds[1] - bounds[0])));
  return (
    <svg class="strip" viewBox="0 0 200 20" role="img" aria-label={label}>
      <line class="all" x1="4" x2="196" y1="10" y2="10" />
      {interval && <line class="interval" x1={at(interval[0])} x2={at(interval[1])} y1="10" y2="10" />}
      {value !== null && <circle cx={at(value)} cy="10" r="5" />}
    </svg>
  );
};

// How each coefficient narrows, round by round: mean of its plausible values ± twice their scatter.
const Narrowing = ({progress}: {progress: Progress}) => {
  const kWidth = 300, kHeight = 110, kEdge = 40;
  const rounds = progress.rounds;
  if (rounds.length === 0) return <p class="hint">After the first round it shows here how the coefficients narrow.</p>;
  const x = (k: number) => kEdge + (kWidth - kEdge - 10) * (rounds.length === 1 ? .5 : k / (rounds.length - 1));
  return (
    <div class="narrowing">
      {progress.parameters.map(({name, bounds}, p) => {
        const y = (value: number) => 8 + (kHeight - 26) * (1 - (Math.min(bounds[1], Math.max(bounds[0], value)) - bounds[0]) / (bounds[1] - bounds[0]));
        const last = rounds[rounds.length - 1]!;
        const said = `${coefficientName(name)}: ${last.values[p]!.toPrecision(3)} ± ${(2 * last.sd[p]!).toPrecision(2)} after round ${rounds.length}`;
        return (
          <figure key={name}>
            <figcaption>{coefficientName(name)}</figcaption>
            <svg viewBox={`0 0 ${kWidth} ${kHeight}`} role="img" aria-label={said}>
              {bounds.map((bound) => <g key={bound}><line class="axis" x1={kEdge} x2={kWidth - 4} y1={y(bound)} y2={y(bound)} /><text x={kEdge - 4} y={y(bound) + 4} text-anchor="end">{bound}</text></g>)}
              {rounds.map((round, k) => (
                <g key={round.round}>
                  <line class="interval" x1={x(k)} x2={x(k)} y1={y(round.values[p]! - 2 * round.sd[p]!)} y2={y(round.values[p]! + 2 * round.sd[p]!)} />
                  <circle cx={x(k)} cy={y(round.values[p]!)} r="3" />
                  <text x={x(k)} y={kHeight - 2} text-anchor="middle">{k + 1}</text>
                </g>
              ))}
            </svg>
            <p class="hint">{last.values[p]!.toPrecision(3)} ± {(2 * last.sd[p]!).toPrecision(2)}</p>
          </figure>
        );
      })}
    </div>
  );
};

const AtWork = ({task, progress, stop}: {task: Task; progress: Progress | null; stop: () => void}) => {
  // Progress left by an earlier start is not shown; this one has yet to write its own.
  const is_current = progress !== null && task.state !== 'waiting' && progress.seconds <= task.seconds + 2;
  const shown = is_current ? progress : null;
  return (
    <section class="at-work" aria-label="At work">
      <h3>{task.state === 'waiting' ? 'Waits until the one before it has ended' : task.state === 'stopping' ? 'Stops in good order …' : shown?.stage ?? 'begins …'}</h3>
      {shown && (
        <>
          <progress max={1} value={shown.fraction} aria-label="Done" />
          <p role="status">{shown.done} of {shown.of} simulations{shown.seconds_left !== null && `, at most ${durationText(shown.seconds_left)} left`}</p>
          <Narrowing progress={shown} />
          {shown.notes.length > 0 && <details><summary>{shown.notes.length} notes</summary>{shown.notes.map((note) => <p key={note}>{note}</p>)}</details>}
        </>
      )}
      <div class="actions"><button type="button" disabled={task.state === 'stopping'} onClick={stop}>{task.state === 'waiting' ? 'Do not start it' : 'Stop'}</button>
        <span class="hint">It goes on if you close the page. What is simulated is kept: it resumes from there.</span></div>
    </section>
  );
};

const verdictClass = (verdict: string) => (verdict === 'determined' || verdict === 'bounded' ? 'ok' : 'flagged');
const three = (value: number | null) => (value === null ? '–' : value.toPrecision(3));

const Coefficient = ({found}: {found: FoundParameter}) => (
  <tr>
    <th scope="row">{coefficientName(found.name)}</th>
    <td>{three(found.value)}</td>
    <td>{found.interval ? `${three(found.interval[0])} … ${three(found.interval[1])}` : '–'}</td>
    <td>{found.bounds && <Strip bounds={found.bounds} interval={found.interval} value={found.value} label={`between ${found.bounds[0]} and ${found.bounds[1]}`} />}</td>
    <td><span class={`badge ${verdictClass(found.verdict)}`}>{found.verdict}</span></td>
  </tr>
);

const Found = ({state, look}: {state: Calibration; look: () => Promise<void>}) => {
  const result = state.result!;
  const [to, setTo] = useState(state.targets[0]?.name ?? '');
  const [is_approximate, setIsApproximate] = useState(false);
  const [told, setTold] = useState<{command: string; is_done: boolean; lines: string[]} | null>(null);
  const take = async () => {
    try {
      setTold(await studies.exported(state.study, to, is_approximate));
    } catch (error) {
      setTold({command: '', is_done: false, lines: [(error as Error).message]});
    }
    await look();
  };
  const target = state.targets.find(({name}) => name === to);
  const exports = state.files.filter(({name}) => name.startsWith('export/'));
  const own = state.files.filter(({name}) => !name.startsWith('export/') && !name.startsWith('tables/'));
  const Files = ({files}: {files: Calibration['files']}) => (
    <ul class="files-list">{files.map(({name, bytes}) => <li key={name}><a href={studies.fileAddress(state.study, name)} download>{name}</a> <span class="hint">{bytes < 2048 ? `${bytes} bytes` : bytes < 2 ** 21 ? `${Math.round(bytes / 1024)} kB` : `${(bytes / 2 ** 20).toFixed(1)} MB`}</span></li>)}</ul>
  );
  return (
    <section class="found" aria-label="What was found">
      {state.state === 'changed' && <p class="warning">The study or its readings were changed since: this is what was found before. Calibrate again.</p>}
      <div class="scrolled" tabIndex={0} role="region" aria-label="Coefficients">
        <table>
          <caption>Coefficients, with 95 % intervals within their bounds</caption>
          <thead><tr><th scope="col">coefficient</th><th scope="col">value</th><th scope="col">interval</th><th scope="col" class="of-strip">within its bounds</th><th scope="col">verdict</th></tr></thead>
          <tbody>{result.parameters.map((found) => <Coefficient key={found.name} found={found} />)}</tbody>
        </table>
      </div>
      {result.parameters.filter(({advice}) => advice).map(({name, advice}) => <p key={name} class="hint">{coefficientName(name)}: {advice}</p>)}
      <div class="scrolled" tabIndex={0} role="region" aria-label="Bench and simulation">
        <table>
          <caption>Bench and simulation{result.verdict && <>: <b>{result.verdict}</b></>}</caption>
          <thead><tr><th scope="col">reading</th><th scope="col">measured</th><th scope="col">simulated</th></tr></thead>
          <tbody>{result.observables.map((one) => (
            <tr key={one.name}><th scope="row">{one.name} [{one.unit}]</th><td>{three(one.measured)} ± {three(one.measured_uncertainty)}</td><td>{three(one.simulated)} ± {three(one.simulated_uncertainty)}</td></tr>
          ))}</tbody>
        </table>
      </div>
      <p><a class="button" href={studies.reportAddress(state.study)} target="_blank" rel="noreferrer">Open the report</a></p>
      <h3>For other programs</h3>
      <div class="row">
        <label>Program
          <select value={to} onChange={(event) => setTo(event.currentTarget.value)}>{state.targets.map(({name}) => <option key={name}>{name}</option>)}</select>
        </label>
        <label class="check"><input type="checkbox" checked={is_approximate} onChange={(event) => setIsApproximate(event.currentTarget.checked)} />values that are equivalent on average, where its laws differ</label>
        <button type="button" onClick={() => void take()}>Export</button>
      </div>
      {target && <p class="hint">{target.summary}</p>}
      {told && <div role="status" class={told.is_done ? 'done' : 'reason'}>{told.is_done ? <code>{told.command}</code> : told.lines.map((line) => <p key={line}>{line}</p>)}</div>}
      <h3>Files to save</h3>
      <Files files={own} />
      {exports.length > 0 && <details><summary>{exports.length} files of exports</summary><Files files={exports} /></details>}
    </section>
  );
};

const kUsualMinutes = '20min';
const minutesIn = (budget: string) => (budget.endsWith('min') ? budget.slice(0, -3) : null);
const budgetOption = (budget: string) => (minutesIn(budget) === null ? `--budget ${budget}` : `--minutes ${minutesIn(budget)}`);

const Budgets = ({estimate, budget, choose}: {estimate: Estimate | null; budget: string; choose: (budget: string) => void}) => {
  const known = estimate?.budgets ?? [{budget: 'quick', description: '', seconds: 0, experiments: []}, {budget: 'standard', description: '', seconds: 0, experiments: []}];
  return (
    <fieldset class="budgets">
      <legend>How much is simulated</legend>
      {known.map((one) => (
        <label key={one.budget} class="choice">
          <input type="radio" name="budget" value={one.budget} checked={one.budget === budget} onChange={() => choose(one.budget)} />
          <span><b>{one.budget}</b>{estimate && <>: at most {durationText(one.seconds)} on {estimate.cores} cores of this machine
            <small>{one.experiments.map((runs) => `${runs.experiment} ${runs.fit_runs} + ${runs.check_runs}`).join(', ')} simulations, for the fit + for its checks</small></>}</span>
        </label>
      ))}
      <label class="choice">
        <input type="radio" name="budget" value="minutes" checked={minutesIn(budget) !== null} onChange={() => choose(kUsualMinutes)} />
        <span><b>minutes</b>: all of it within <input type="number" min="1" step="1" aria-label="Minutes" value={minutesIn(budget) ?? ''} onInput={(event) => { if (event.currentTarget.value) choose(`${event.currentTarget.value}min`); }} /></span>
      </label>
    </fieldset>
  );
};

const lastOf = (tasks: Task[], name: string) => tasks.find(({task}) => task === name) ?? null;

const Ended = ({task}: {task: Task}) => {
  if (task.state === 'done' || isAtWork(task)) return null;
  return (
    <section class="ended" role="status" aria-label="How it ended">
      <h3>{task.state === 'stopped' ? 'Stopped: it can be resumed.' : `It did not come to its end${task.end && ` (${task.end})`}.`}</h3>
      {task.state === 'failed' && task.lines.map((line) => <p key={line}>{line}</p>)}
    </section>
  );
};

export const CalibrationView = ({study, tasks, refresh}: {study: Study; tasks: Task[]; refresh: () => Promise<void>}) => {
  const {state, trouble, look, act} = useCalibration(study.study, refresh);
  const [budget, setBudget] = useState('quick');
  if (!state) return <p role="status">{trouble || 'looking into the folder …'}</p>;
  const run = lastOf(state.tasks, 'calibrate');
  const estimating = lastOf(state.tasks, 'estimate');
  const is_at_work = isAtWork(run);
  const is_estimating = isAtWork(estimating);
  const before = tasks.filter((task) => task.study !== study.study && isAtWork(task)).length;
  const start = (task: string) => void act(studies.startTask(study.study, task, task === 'calibrate' ? budget : ''));
  const word = state.state === 'unfinished' ? 'Resume' : state.state === 'finished' ? 'Calibrate again' : 'Start the calibration';
  return (
    <div class="calibration">
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      {study.faults.length > 0 && <p class="warning">{study.faults.length === 1 ? 'One thing is' : `${study.faults.length} things are`} missing or wrong: see the readings.</p>}
      {run && is_at_work && <AtWork task={run} progress={state.progress} stop={() => void act(studies.stopTask(study.study, 'calibrate'))} />}
      {!is_at_work && state.is_elsewhere && <p class="warning" role="status">Another program is at work in {state.folder}, perhaps a terminal. {state.progress && `${state.progress.stage}: ${state.progress.done} of ${state.progress.of} simulations.`}</p>}
      {state.result && !is_at_work && <Found state={state} look={look} />}
      {!is_at_work && !state.is_elsewhere && (
        <section class="start" aria-label="Start">
          {state.state === 'unfinished' && <p class="hint">{state.runs} simulations are made; there is no result yet. <a href={studies.reportAddress(study.study)} target="_blank" rel="noreferrer">What is known so far</a></p>}
          <Budgets estimate={state.estimate} budget={budget} choose={setBudget} />
          <div class="actions">
            <button type="button" class={state.state === 'finished' ? '' : 'main'} onClick={() => start('calibrate')}>{word}</button>
            <button type="button" disabled={is_estimating} onClick={() => start('estimate')}>{is_estimating ? 'timing a run of each …' : 'How long would it take?'}</button>
            {before > 0 && <span class="hint">{before} other{before > 1 ? 's are' : ' is'} before it.</span>}
          </div>
        </section>
      )}
      {run && <Ended task={run} />}
      {estimating && <Ended task={estimating} />}
      <section class="command" aria-label="The same on the command line">
        <h3>The same on the command line</h3>
        <code>repose calibrate {study.study} {budgetOption(budget)}</code>
        <code>repose report {state.folder}</code>
      </section>
    </div>
  );
};
